#!/usr/bin/env bash
# The example with the 3D model of a town, small: nobody is missed, and no mesh with a hole gets an interior.
#   braunschweig.sh SOURCE_DIR BUILD_DIR
set -euo pipefail
source_dir=$1 build_dir=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "FAILED: $*" >&2; cat "$work/log" >&2; exit 1; }
[ -e /usr/share/sumo/tools/game/bs3d/bs3.3ds ] && command -v sumo >/dev/null || { echo "no SUMO: skipped"; exit 77; }

cmake --install "$build_dir" --prefix "$work/prefix" >"$work/log" || fail "install"
GRIDCULL_PREFIX=$work/prefix "$source_dir/examples/braunschweig/run.sh" --small --out "$work/out" >"$work/log" 2>&1 ||
  fail "run.sh"
grep -qx "misses  *0" "$work/log" || fail "no check without misses"
grep -q "^2245 static objects -> " "$work/log" || fail "the model's parts"
grep -q "862 of 2245 have holes" "$work/log" || fail "the model's holes"
[ "$(grep -c . "$work/out/pvs.jsonl")" -gt 500 ] || fail "hardly an answer"
echo "Braunschweig: nobody is missed"
