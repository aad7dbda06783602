#!/usr/bin/env bash
# Everything a fresh Debian 12 machine needs to say whether gridcull works: packages, build, all tests.
#   tests/run.sh [--preset release|debug|asan|tsan] [--long] [--jobs N] [-- CTEST_OPTION...]
# --long runs the larger scene catalog as well. Without root it names missing packages and stops (status 2).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source examples/packages.sh

preset=release
configuration=()
jobs=$(nproc)
while [ $# -gt 0 ]; do
  case "$1" in
    --preset) preset="${2:?--preset needs a name}"; shift 2 ;;
    --long) configuration=(-C long); shift ;;
    --jobs) jobs="${2:?--jobs needs a number}"; shift 2 ;;
    --help|-h) sed -n '2,4s/^# \{0,1\}//p' tests/run.sh; exit 0 ;;
    --) shift; break ;;
    *) echo "tests/run.sh: unknown option $1 (see --help)" >&2; exit 2 ;;
  esac
done

# shellcheck disable=SC2086  # the list is meant to be split
need $packages_tests
# npm may come with a nodejs from elsewhere, which is as good as Debian's.
command -v npm >/dev/null && packages_page=chromium
# shellcheck disable=SC2086
need_page $packages_page

cmake --preset "$preset" -DBUILD_TESTING=ON
cmake --build --preset "$preset" -j "$jobs"
export UBSAN_OPTIONS="${UBSAN_OPTIONS:-print_stacktrace=1}"
ctest --preset "$preset" -j "$jobs" "${configuration[@]}" "$@"
