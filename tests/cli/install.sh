#!/usr/bin/env bash
# Installs a build to a temporary prefix and builds two programs against it with find_package(gridcull):
# examples/embed, whose output is known, and tests/consumer, which uses every part.
#   install.sh SOURCE_DIR BUILD_DIR SANITIZERS
set -euo pipefail
source_dir=$1 build_dir=$2 sanitizers=${3:-}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "FAILED: $*" >&2; exit 1; }

cmake --install "$build_dir" --prefix "$work/prefix" >"$work/install.log" || { cat "$work/install.log"; fail "install"; }
[ -x "$work/prefix/bin/gridcull" ] || fail "the program is not installed"
[ "$("$work/prefix/bin/gridcull" --version)" = "gridcull 0.1.0" ] || fail "the installed program does not run"
for part in core grid methods sim; do
  [ -d "$work/prefix/include/gridcull/$part" ] || fail "no headers of $part"
done

build() {  # build FOLDER NAME
  cmake -S "$1" -B "$work/$2" -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_PREFIX_PATH="$work/prefix" \
    ${sanitizers:+-DCMAKE_CXX_FLAGS=-fsanitize=$sanitizers} >"$work/$2.log" 2>&1 &&
    cmake --build "$work/$2" >>"$work/$2.log" 2>&1 || { cat "$work/$2.log"; fail "$2 does not build"; }
}

build "$source_dir/examples/embed" embed
"$work/embed/embed" >"$work/embed.txt" || fail "embed does not run"
diff -u "$source_dir/examples/embed/expected.txt" "$work/embed.txt" || fail "embed says something else"

build "$source_dir/tests/consumer" consumer
[ "$("$work/consumer/consumer")" = "3 frames, 6 queries" ] || fail "consumer says something else"
echo "installed, built against, run"
