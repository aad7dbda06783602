#!/usr/bin/env bash
# `gridcull serve` and `view` as programs: what they print, SIGTERM, and kill -9 in the middle of a recorded session.
#   serve.sh PROGRAM
set -uo pipefail
program=$(realpath "$1")
"$program" serve --help >/dev/null 2>&1 || { echo "serve is not built: skipped"; exit 77; }
command -v python3 >/dev/null || { echo "no python3: skipped"; exit 77; }
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d)
server=
trap '[ -z "$server" ] || kill -9 "$server" 2>/dev/null; rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0
fail() { echo "FAILED: $*" >&2; failures=$((failures + 1)); }

# start NAME ARGUMENT...: a server in the background; its port in $port.
start() {
  local out=$1; shift
  "$program" "$@" >"$out" 2>"$out.err" &
  server=$!
  for _ in $(seq 100); do
    grep -q "^listening on http://127.0.0.1:" "$out" && break
    sleep 0.05
  done
  port=$(sed -n '1s/^listening on http:\/\/127.0.0.1:\([0-9]*\)$/\1/p' "$out")
  [ -n "$port" ] || fail "$*: no first line with the address"
}

"$program" make town --count 20 --viewers 3 --range 60 --frames 1000 --out town >/dev/null

# SIGTERM: status 0.
start plain serve --port 0
kill -TERM "$server"
wait "$server"; status=$?
[ "$status" -eq 0 ] || fail "SIGTERM: status $status, expected 0"
[ -s plain.err ] && fail "SIGTERM: something on standard error: $(cat plain.err)"

# A port that is taken, an address that is none, a token file without a token: one line, status 2.
start holder serve --port 0
for arguments in "--port $port" "--address nowhere" "--token-file /dev/null" "--record /dev/null/x" "--threads 0"; do
  # shellcheck disable=SC2086  # the arguments are meant to be split
  timeout 10 "$program" serve $arguments >out 2>err; status=$?
  [ "$status" -eq 2 ] || fail "serve $arguments: status $status, expected 2"
  [ "$(wc -l <err)" -eq 1 ] || fail "serve $arguments: expected one line, found: $(cat err)"
  [ -s out ] && fail "serve $arguments: printed $(cat out)"
done
kill -TERM "$server"; wait "$server"

# kill -9 in the middle of 1,000 frames: the record holds at least what was acknowledged, and replays.
start recording serve --port 0 --record records
python3 "$here/kill_server.py" "$port" "$server" town/scene.json town/frames.jsonl >acknowledged || { fail "kill_server.py"; kill -9 "$server"; }
wait "$server" 2>/dev/null
server=
frames=(records/*/frames.jsonl)
# The line that was being written may be cut.
[ -z "$(tail -c 1 "${frames[0]}")" ] || sed -i '$d' "${frames[0]}"
recorded=$(($(wc -l <"${frames[0]}") - 1))
[ "$recorded" -ge "$(cat acknowledged)" ] || fail "recorded $recorded frames of $(cat acknowledged) acknowledged"
"$program" run "$(dirname "${frames[0]}")/scene.json" --frames "${frames[0]}" --out replayed.jsonl || fail "the record"
head -n $((recorded + 1)) town/frames.jsonl >town/part.jsonl
"$program" run town/scene.json --frames town/part.jsonl --out direct.jsonl
cmp -s <(tail -n +2 replayed.jsonl) <(tail -n +2 direct.jsonl) || fail "the record replays to other answers"

# view: the files, and the page.
start viewing view town/scene.json --frames town/frames.jsonl
python3 - "$port" <<'PY' || fail "view: the trace"
import sys, urllib.request
base = f"http://127.0.0.1:{sys.argv[1]}"
get = lambda path: urllib.request.urlopen(base + path).read()
assert get("/v1/trace/scene.json") == open("town/scene.json", "rb").read()
assert get("/v1/trace/frames.jsonl") == open("town/frames.jsonl", "rb").read()
assert b"<html" in get("/")
PY
kill -TERM "$server"; wait "$server"; server=
"$program" view nothing.json >out 2>err; [ $? -eq 2 ] || fail "view nothing.json: expected status 2"

[ "$failures" -eq 0 ] && echo "all well"
exit $((failures > 0))
