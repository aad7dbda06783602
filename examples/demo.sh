#!/usr/bin/env bash
# From nothing to a picture on a fresh Debian 12 machine: installs what is missing, builds the program, makes a
# town with moving traffic, replays it and says where the answers are.
#   examples/demo.sh [FOLDER]     (default: out/demo)
# Without root it names missing packages and stops (status 2).
set -euo pipefail
caller=$PWD
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source examples/packages.sh

if [[ "${1:-}" == -* ]]; then
  sed -n '2,5s/^# \{0,1\}//p' examples/demo.sh
  [[ "$1" == -h || "$1" == --help ]] && exit 0 || exit 2
fi
out=out/demo
if [ -n "${1:-}" ]; then out=$(realpath -m "$caller/$1"); [[ "$1" == /* ]] && out=$1; fi

# shellcheck disable=SC2086  # the list is meant to be split
need $packages_program
need_page

echo "== building the program (tests/run.sh adds the tests)"
fresh=()
[ -e build/release/CMakeCache.txt ] || fresh=(-DBUILD_TESTING=OFF)
cmake --preset release "${fresh[@]}" >/dev/null
cmake --build --preset release --target gridcull
gridcull=$PWD/build/release/gridcull

echo "== a town of 400 buildings and 100 cars; ten drivers look 100 m around"
"$gridcull" make town --out "$out/town" --viewers 10 --range 100
echo "== who may be seen by whom, frame by frame"
"$gridcull" run "$out/town/scene.json" --frames "$out/town/frames.jsonl"
"$gridcull" run "$out/town/scene.json" --frames "$out/town/frames.jsonl" --out "$out/pvs.jsonl" \
  --picture "200:404:$out/town.svg" --picture "116:409:$out/town-409.svg"
echo "== held against the exact answer, every 30th frame"
"$gridcull" check "$out/town/scene.json" --frames "$out/town/frames.jsonl" --every 30

echo
echo "answers:   $out/pvs.jsonl (one line a frame and driver)"
echo "pictures:  $out/town.svg, $out/town-409.svg (open them in a browser)"
echo "the town:  $out/town/scene.json, $out/town/frames.jsonl"
echo "live:      $gridcull view $out/town/scene.json --frames $out/town/frames.jsonl (prints an address for your browser)"
