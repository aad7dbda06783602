#!/usr/bin/env bash
# The viewer page in Debian's chromium, by playwright-core: two made worlds, watched, stepped and explained.
#   tests/page/run.sh PROGRAM [FOLDER]     (FOLDER: keeps the screenshots page-2d.png and page-3d.png)
# Exit status 77 (skipped) where chromium, node or the page's node modules are missing.
set -euo pipefail
program=$(realpath "${1:?the program}")
pictures=${2:+$(realpath "$2")}
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

skip() {
  echo "skipped: $*"
  exit 77
}
command -v node >/dev/null || skip "node is missing (Debian: nodejs)"
node tests/page/history_test.mjs
[ -e service/page/node_modules/playwright-core/package.json ] || skip "playwright-core is missing (npm ci in service/page)"
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome) || skip "chromium is missing"

"$program" serve --help >/dev/null 2>&1 || skip "the program was built without its server"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$program" make town --count 100 --viewers 6 --range 75 --frames 60 --seed 4 --out "$work/town" >/dev/null
"$program" make city --blocks 3 --count 40 --viewers 3 --range 60 --frames 30 --seed 2 --out "$work/city" >/dev/null
node tests/page/page_test.mjs "$program" "$browser" "$work" "${pictures:-$work}"
