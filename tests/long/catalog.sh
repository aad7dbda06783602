#!/usr/bin/env bash
# The large scene catalog: every conservative method against the exact reference, as a table in Markdown.
#   tests/long/catalog.sh PROGRAM made|real [TABLE]
# `made`: generated scenes. `real`: recordings in the folder that GRIDCULL_DATA names (status 77 without it, which
# ctest shows as skipped). The table goes to standard output and to the file TABLE. Status 1 when a method missed anybody,
# or a command failed. GRIDCULL_METHODS="voxel silhouette" takes only these methods, GRIDCULL_ONLY=REGEX only scenes
# whose label matches. Takes some minutes and 300 MB for a while in the folder for temporary files.
set -uo pipefail
[ $# -ge 2 ] || { sed -n '2,7s/^# \{0,1\}//p' "$0" >&2; exit 2; }
program=$(realpath "$1") part=$2
table=$(realpath -m "${3:-/dev/null}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
: >"$table"
failures=0 rows=0

fail() {
  failures=$((failures + 1))
  printf 'FAILED: %s\n' "$*" >&2
}

say() { printf '%s\n' "$*" | tee -a "$table"; }

# methods DIMENSION: "NAME TBV..." a line for each conservative method that takes it; the modes of its volumes, or "off".
methods() {
  "$program" methods | awk -v takes="${1}D" -v only=" ${GRIDCULL_METHODS:-} " '
    /^[^ ]/ { name = $1; sub(/:$/, "", name); if (only ~ /[^ ]/) wanted = index(only, " " name " "); else wanted = 1 }
    /^  [23]D/ { fits = index($0, takes) > 0 && /conservative/ }
    /^  options:/ && fits && wanted { print name, (/hollow/ ? "off solid hollow" : /--tbv/ ? "off solid" : "off") }'
}

# number FILE KEY [AFTER]: the number at KEY, the first after the text AFTER, in a JSON file of ours.
number() {
  tr -d ' \n' <"$1" | sed "s/.*${3:-}\(\"$2\":\)/\1/; s/\"$2\":\([-0-9.e+a-z]*\).*/\1/"
}

# judge LABEL FOLDER METHOD TBV EVERY [OPTION...]: one row.
judge() {
  local label=$1 folder=$2 method=$3 tbv=$4 every=$5
  shift 5
  local world=("$folder/scene.json" --frames "$folder/frames.jsonl" --method "$method" --tbv "$tbv" "$@")
  "$program" check "${world[@]}" --every "$every" --json >check.json
  local status=$?
  if [ $status -gt 1 ] || [ ! -s check.json ]; then
    fail "$label, $method: check ended with status $status"
    return
  fi
  "$program" run "${world[@]}" --stats stats.json >/dev/null || { fail "$label, $method: run"; return; }
  [ $status -eq 0 ] || fail "$label, $method, TBVs $tbv: $(cat check.json)"
  rows=$((rows + 1))
  say "$(printf '| %s | %s | %s | %s | %d | %d | %s%.1f | %.1f | %s%.2f | %d | %s |' "$label" "$method" "$tbv" \
    "$(number stats.json cell)" "$(number check.json judged_frames)" "$(number check.json queries)" \
    "$(grep -q '"exact_is_lower_bound":true' check.json && echo '≥ ')" "$(number check.json exact_mean)" \
    "$(number check.json pvs_mean)" "$(grep -q '"exact_is_lower_bound":true' check.json && echo '≤ ')" \
    "$(number check.json over_estimation)" "$(number check.json misses)" \
    "$(number stats.json median '"total":{' | awk '{ printf ($1 < 1e5 ? "%.3g" : "%.0f"), $1 / 1000 }')")"
}

# all LABEL FOLDER EVERY MODES [OPTION...]: a row for every method; MODES "each" takes every mode of TBVs, "one" only
# solid ones where there is a choice.
all() {
  local label=$1 folder=$2 every=$3 modes=$4 dimension method tbvs tbv
  shift 4
  dimension=$(grep -o '"dimension": *[23]' "$folder/scene.json" | head -n 1 | grep -o '[23]$')
  while read -r method tbvs; do
    [ "$modes" = one ] && [[ $tbvs == *solid* ]] && tbvs=solid
    for tbv in $tbvs; do judge "$label" "$folder" "$method" "$tbv" "$every" "$@"; done
  done < <(methods "$dimension")
}

# made LABEL EVERY MODES ARGUMENT...: makes a scene, judges it and throws it away.
made() {
  local label=$1 every=$2 modes=$3
  shift 3
  [[ $label =~ ${GRIDCULL_ONLY:-} ]] || return
  "$program" make "$@" --out scene >/dev/null || { fail "make $*"; return; }
  all "$label" scene "$every" "$modes"
  rm -rf scene
}

real() {
  if [ ! -d "${GRIDCULL_DATA:-}" ]; then
    echo "skipped: GRIDCULL_DATA names no folder with bad-hersfeld/ and bottleneck/" >&2
    exit 77
  fi
  if "$program" import sumo --fcd "$GRIDCULL_DATA/bad-hersfeld/fcd.xml.gz" --out town --viewers 40 --range 150 \
    --buildings "$GRIDCULL_DATA/bad-hersfeld/buildings.poly.xml" >/dev/null; then
    all "Bad Hersfeld, 40 drivers, 150 m" town 20 each
  else
    fail "import sumo"
  fi
  if "$program" import petrack --trajectories "$GRIDCULL_DATA/bottleneck/040_c_56_h.txt" --viewers 10 --out crowd \
    >/dev/null; then
    all "bottleneck, 10 pedestrians, 170°" crowd 10 each
  else
    fail "import petrack"
  fi
}

say '| scene | method | TBVs | cell, m | frames judged | queries | exact mean | PVS mean | over-estimation | misses | median frame, ms |'
say '|---|---|---|--:|--:|--:|--:|--:|--:|--:|--:|'
case $part in
  made)
    made "spheres, 5,000" 10 each spheres
    made "spheres, 5,000" 10 each spheres --cell 1
    made "city, 50 x 50 blocks, 5,000 cars, 20 riders" 40 one city --viewers 20 --frames 41
    made "city, camera" 10 one city
    made "discs, 300" 10 each discs
    made "discs, 10,000" 10 one discs --count 10000
    made "town, 400 buildings, 10 drivers" 10 each town
    made "maze, 20 x 20, 10 walkers" 10 each maze
    made "maze, 40 x 40, 10 walkers" 10 one maze --count 40
    ;;
  real) real ;;
  *) fail "expected made or real, found $part" ;;
esac
[ "$rows" -gt 0 ] && [ "$failures" -eq 0 ]
