#!/usr/bin/env bash
# A live example, small: embedded and through a server it gives one hash, the files that it leaves replay to the same
# answers, no answer misses anybody, and its bad input is refused in one line.
#   live.sh NAME SOURCE_DIR BUILD_DIR SANITIZERS
set -euo pipefail
name=$1 source_dir=$2 build_dir=$3 sanitizers=${4:-}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "FAILED: $*" >&2; exit 1; }
case "$name" in
  sumo) [ -e /usr/share/sumo/cmake ] && command -v netgenerate >/dev/null || { echo "no SUMO: skipped"; exit 77; } ;;
  crowd) [ -e /usr/include/recastnavigation/DetourCrowd.h ] || { echo "no librecast-dev: skipped"; exit 77; } ;;
esac
"$build_dir/gridcull" serve --help >/dev/null 2>&1 || { echo "serve is not built: skipped"; exit 77; }

cmake --install "$build_dir" --prefix "$work/prefix" >"$work/install.log" || { cat "$work/install.log"; fail "install"; }
export GRIDCULL_PREFIX=$work/prefix GRIDCULL_EXAMPLE_BUILD=$work/build
export CXXFLAGS="${sanitizers:+-fsanitize=$sanitizers}"

for way in embedded --service; do
  options=(--small --out "$work/$way")
  [ "$way" = embedded ] || options+=("$way")
  "$source_dir/examples/$name/run.sh" "${options[@]}" >"$work/$way.log" 2>&1 || { cat "$work/$way.log"; fail "$way"; }
  grep -qx "gridcull run gives the same answers, byte for byte" "$work/$way.log" || fail "$way: no replay"
  grep -qx "misses  *0" "$work/$way.log" || fail "$way: no check without misses"
done
grep -q "^audit_missed_objects_total *0$" "$work/--service.log" || fail "the server's audit"
grep -q "^audited_answers_total *[1-9]" "$work/--service.log" || fail "the server audited nothing"
cmp <(tail -n +2 "$work/embedded/pvs.jsonl") <(tail -n +2 "$work/--service/pvs.jsonl") || fail "the server answers otherwise"
[ "$(grep -c . "$work/embedded/pvs.jsonl")" -gt 100 ] || fail "hardly an answer"

program=$(echo "$work"/build/*/in_*)
program=${program%% *}
[ -x "$program" ] || fail "no program $program"
config=()
[ "$name" = crowd ] || config=(--config "$work/embedded/town/town.sumocfg")
status=0
SUMO_HOME=/usr/share/sumo "$program" "${config[@]}" --server nowhere --out "$work/bad" >"$work/bad.log" 2>"$work/bad.err" || status=$?
[ "$status" -eq 2 ] || fail "--server nowhere: status $status, expected 2"
grep -q "expected HOST:PORT, found 'nowhere'" "$work/bad.err" || { cat "$work/bad.err"; fail "--server nowhere: no such line"; }
[ ! -e "$work/bad" ] || fail "--server nowhere left files behind"
echo "$name: embedded and served agree"
