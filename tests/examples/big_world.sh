#!/usr/bin/env bash
# The example with the big world, small: whole, in tiles and cut out, voxel answers the same and misses nobody.
#   big_world.sh SOURCE_DIR BUILD_DIR
set -euo pipefail
source_dir=$1 build_dir=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "FAILED: $*" >&2; cat "$work/log" >&2; exit 1; }

cmake --install "$build_dir" --prefix "$work/prefix" >"$work/log" || fail "install"
"$work/prefix/bin/gridcull" bake static none.json --out none.vdb >"$work/log" 2>&1 || true
grep -q "built without OpenVDB" "$work/log" && { echo "no OpenVDB: skipped"; exit 77; }
GRIDCULL_PREFIX=$work/prefix "$source_dir/examples/big_world/run.sh" --small --out "$work/out" >"$work/log" 2>&1 ||
  fail "run.sh"
grep -qx "misses  *0" "$work/log" || fail "no check without misses"
grep -qx "all three of voxel give the same answers" "$work/log" || fail "other answers"
echo "the big world: nobody is missed"
