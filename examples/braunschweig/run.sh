#!/usr/bin/env bash
# A real town in 3D: the model of Braunschweig that comes with Debian's sumo-tools, and SUMO's traffic driving through it.
# Installs what is missing, builds gridcull, reads the model, lets SUMO drive for thirty seconds, says whom twenty drivers
# may see, holds the answers against the exact reference, and tells how to look at it.
#   examples/braunschweig/run.sh [--small] [--out FOLDER]
# --small: three seconds. Without root it names missing packages and stops (status 2).
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../live/example.sh"
example_arguments braunschweig "$@"
seconds=30
[ -z "$small" ] || seconds=3

# shellcheck disable=SC2086  # lists are meant to be split
need $packages_program $packages_sumo
export SUMO_HOME=${SUMO_HOME:-/usr/share/sumo}
build_gridcull
model=$SUMO_HOME/tools/game/bs3d
mkdir -p "$out"

echo "== the model: 48,907 faces; its axes are east, south and down, a little turned against the net's"
"$gridcull" import mesh "$model/bs3.3ds" --orientation 0,1,0,0 --heading-degrees 1.30 --move 660,679,0 --out "$out/model"
echo "== SUMO's traffic"
python3 "$SUMO_HOME/tools/randomTrips.py" --net-file "$model/bs.net.xml" --output-trip-file "$out/trips.xml" \
  --route-file "$out/routes.xml" --end 300 --period 0.5 --seed 1 --min-distance 200 --validate >"$out/trips.log" 2>&1 || { cat "$out/trips.log" >&2; exit 1; }
sumo --net-file "$model/bs.net.xml" --route-files "$out/trips.xml" --end 300 --step-length 0.1 --no-warnings --no-step-log \
  --ignore-route-errors --fcd-output "$out/fcd.xml" --device.fcd.begin $((300 - seconds)) >"$out/sumo.log" 2>&1 ||
  { cat "$out/sumo.log" >&2; exit 1; }
"$gridcull" import sumo --fcd "$out/fcd.xml" --static "$out/model/scene.json" --viewers 20 --range 200 --out "$out"
echo "== whom twenty drivers may see, frame by frame"
"$gridcull" run "$out/scene.json" --frames "$out/frames.jsonl"
"$gridcull" run "$out/scene.json" --frames "$out/frames.jsonl" --out "$out/pvs.jsonl"
echo "== held against the exact reference (rays), every 60th frame"
"$gridcull" check "$out/scene.json" --frames "$out/frames.jsonl" --every 60
echo
echo "answers:  $out/pvs.jsonl"
echo "look:     $gridcull view $out/scene.json --frames $out/frames.jsonl (prints an address for your browser)"
