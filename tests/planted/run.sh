#!/usr/bin/env bash
# Would the tests notice? Each PATCH (default: all in tests/planted) plants one bug. In a copy of the tree each is applied in
# turn, and the test files that its line "Caught by:" names must turn red, every one of them.
#   tests/planted/run.sh [--work FOLDER] [--jobs N] [--table FILE] [--check] [PATCH...]
# --check plants nothing: does each patch apply, and are the tests there that it names?
# FOLDER (default build/planted) keeps the copy and its build, so that a second run compiles what changed only. The table
# goes to standard output and to FILE. Status 1 when a bug is not caught, a patch does not apply or does not build, or a
# test is red without any bug.
set -uo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
here=$root/tests/planted
work=$root/build/planted jobs=$(nproc) table=/dev/null check=no patches=()
while [ $# -gt 0 ]; do
  case "$1" in
    --work) work=$(realpath -m "${2:?--work needs a folder}"); shift 2 ;;
    --jobs) jobs="${2:?--jobs needs a number}"; shift 2 ;;
    --table) table=$(realpath -m "${2:?--table needs a file}"); shift 2 ;;
    --check) check=yes; shift ;;
    --help|-h) sed -n '2,9s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 0 ;;
    -*) echo "tests/planted/run.sh: unknown option $1 (see --help)" >&2; exit 2 ;;
    *) patches+=("$(realpath "$1")"); shift ;;
  esac
done
[ ${#patches[@]} -gt 0 ] || patches=("$here"/*.patch)
# field NAME PATCH: the words of its header line.
field() { sed -n "/^diff\|^---/q; s/^$1: *//p" "$2"; }

if [ "$check" = yes ]; then
  status=0
  for patch in "${patches[@]}"; do
    patch -p1 --batch --forward --dry-run -d "$root" -i "$patch" >/dev/null || { echo "$patch does not apply" >&2; status=1; }
    for file in $(field 'Caught by' "$patch"); do
      [ -f "$root/tests/$file" ] || { echo "$patch: no test $file" >&2; status=1; }
    done
  done
  echo "${#patches[@]} patches"
  exit $status
fi
tree=$work/tree build=$work/build log=$work/log
mkdir -p "$tree" "$build" || exit 2
: >"$table"
: >"$log"
# Objects of a copy elsewhere serve here too.
export CCACHE_BASEDIR=$work CCACHE_NOHASHDIR=1
# The first fault is enough, and nobody reads the smallest example.
export GRIDCULL_PROPERTY_SHRINK=0
failures=0

say() { printf '%s\n' "$*" | tee -a "$table"; }

# The tree's files, without what was built.
files() { (cd "$1" && find . \( -path ./build -o -path ./out -o -path ./.git \) -prune -o -type f -print | LC_ALL=C sort); }

# Brings the copy up to date by content: a file put back gets a new time, so that what was built from a planted bug is
# built again.
copy_tree() {
  local file
  while IFS= read -r file; do
    cmp -s "$root/$file" "$tree/$file" && continue
    mkdir -p "$tree/$(dirname "$file")" && cp "$root/$file" "$tree/$file" || return 1
  done < <(files "$root")
  comm -13 <(files "$root") <(files "$tree") | (cd "$tree" && xargs -r -d '\n' rm -f)
}

all_tests() { for patch in "${patches[@]}"; do field 'Caught by' "$patch"; done | tr ' ' '\n' | LC_ALL=C sort -u; }

configure() {
  local names
  names=$(all_tests | sed 's/\.cpp$//' | paste -sd '|')
  cmake -S "$tree" -B "$build" -DCMAKE_BUILD_TYPE=Release -DGRIDCULL_BUILD_PROGRAM=OFF \
    "-DGRIDCULL_ONLY_TESTS=($names)[.]cpp" >>"$log" 2>&1
}

compile() { cmake --build "$build" --target gridcull_tests -j "$jobs" >>"$log" 2>&1; }

# green FILE: runs the tests of one file. Status 0: all passed; 124: they took too long, which says nothing.
green() {
  local out=$work/out.txt status
  timeout 600 "$build/gridcull_tests" "--source-file=*/$1" --abort-after=1 >"$out" 2>&1
  status=$?
  cat "$out" >>"$log"
  if grep -q 'test cases: *0 ' "$out"; then
    echo "no test in $1" >&2
    exit 1
  fi
  return $status
}

# plant PATCH: one row.
plant() {
  local name red=() missing=() verdict=red file
  name=$(basename "$1" .patch)
  echo "==== $name" >>"$log"
  if ! patch -p1 --batch --forward --no-backup-if-mismatch -d "$tree" -i "$1" >>"$log" 2>&1; then
    verdict='DOES NOT APPLY'
  elif ! compile; then
    verdict='DOES NOT BUILD'
  else
    for file in $(field 'Caught by' "$1"); do
      green "$file"
      case $? in
        0) missing+=("$file") ;;
        124) missing+=("$file (too slow)") ;;
        *) red+=("${file%.cpp}") ;;
      esac
    done
    [ ${#missing[@]} -eq 0 ] && [ ${#red[@]} -gt 0 ] || verdict="NOT CAUGHT by ${missing[*]}"
  fi
  [ "$verdict" = red ] || failures=$((failures + 1))
  say "| $name | $(field Bug "$1") | ${red[*]:-} | $verdict |"
  copy_tree
}

copy_tree && configure || { echo "cannot copy or configure: see $log" >&2; exit 1; }
compile || { echo "the tree does not build without any bug: see $log" >&2; exit 1; }
for file in $(all_tests); do
  green "$file" || { echo "$file is red without any bug: see $log" >&2; exit 1; }
done
say '| patch | bug | caught by | |'
say '|---|---|---|---|'
for patch in "${patches[@]}"; do plant "$patch"; done
printf '%d planted, %d not caught\n' "${#patches[@]}" "$failures"
[ "$failures" -eq 0 ]
