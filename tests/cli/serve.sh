#!/usr/bin/env bash
# `gridcull serve` and `view` as programs: what they print, SIGTERM, and kill -9 in the middle of a recorded session.
#   serve.sh PROGRAM
here=$(cd "$(dirname "$0")" && pwd)
source "$here/library.sh"
"$program" serve --help >/dev/null 2>&1 || { echo "serve is not built: skipped"; exit 77; }
command -v python3 >/dev/null || { echo "no python3: skipped"; exit 77; }

good "make" make town --count 20 --viewers 3 --range 60 --frames 1000 --out town

serve plain serve --port 0
# A port that is taken, an address that is none, files that are no such: refused while another serves.
refused "port taken" "listened" serve --port "$port"
refused "no address" "--address" serve --address nowhere
refused "no token" "expected a token" serve --token-file /dev/null
refused "record" "folder" serve --record /dev/null/x
refused "threads" "--threads" serve --threads 0
for origin in "" "*" example.org https://example.org/ https://example.org/page HTTPS://EXAMPLE.ORG; do
  refused "origin '$origin'" "--allow-origin: expected an origin .*, found ${origin:-nothing}" \
    serve --port 0 --allow-origin "$origin"
done
ended plain

# kill -9 in the middle of 1,000 frames: the record holds at least what was acknowledged, and replays.
serve recording serve --port 0 --record records
python3 "$here/kill_server.py" "$port" "$server" town/scene.json town/frames.jsonl >acknowledged ||
  { fail "kill_server.py"; kill -9 "$server"; }
wait "$server" 2>/dev/null
server=
frames=(records/*/frames.jsonl)
# The line that was being written may be cut.
[ -z "$(tail -c 1 "${frames[0]}")" ] || sed -i '$d' "${frames[0]}"
recorded=$(($(wc -l <"${frames[0]}") - 1))
[ "$recorded" -ge "$(cat acknowledged)" ] || fail "recorded $recorded frames of $(cat acknowledged) acknowledged"
good "record" run "$(dirname "${frames[0]}")/scene.json" --frames "${frames[0]}" --out replayed.jsonl
head -n $((recorded + 1)) town/frames.jsonl >town/part.jsonl
good "direct" run town/scene.json --frames town/part.jsonl --out direct.jsonl
same "record" <(tail -n +2 replayed.jsonl) <(tail -n +2 direct.jsonl)

# view: the files, and the page.
serve viewing view town/scene.json --frames town/frames.jsonl
python3 - "$port" <<'PY' || fail "view: the trace"
import sys, urllib.request
base = f"http://127.0.0.1:{sys.argv[1]}"
get = lambda path: urllib.request.urlopen(base + path).read()
assert get("/v1/trace/scene.json") == open("town/scene.json", "rb").read()
assert get("/v1/trace/frames.jsonl") == open("town/frames.jsonl", "rb").read()
assert b"<html" in get("/")
PY
ended viewing
refused "view" "nothing.json" view nothing.json
finish
