#!/usr/bin/env bash
# The Python client against a real server: the same answers and hash as `gridcull run`, a resume, refusals.
#   python_client.sh PROGRAM
clients=$(cd "$(dirname "$0")/../../examples/python" && pwd)
source "$(dirname "$0")/library.sh"
"$program" serve --help >/dev/null 2>&1 || { echo "serve is not built: skipped"; exit 77; }
python=
for candidate in python3 /usr/bin/python3; do
  "$candidate" -c "import websockets, cbor2, numpy" 2>/dev/null && python=$candidate && break
done
[ -n "$python" ] || { echo "no python3 with websockets, cbor2 and numpy: skipped"; exit 77; }

good "make" make town --count 40 --viewers 5 --range 80 --frames 60 --out town
good "run" run town/scene.json --frames town/frames.jsonl --out run.jsonl --stats stats.json
serve server serve --port 0
url=ws://127.0.0.1:$port
hash=$(sed -n 's/.*"pvs_hash": "\([0-9a-f]*\)".*/\1/p' stats.json)
is "replay.py" "$("$python" "$clients/replay.py" "$url" town/scene.json town/frames.jsonl python.jsonl)" \
  "60 frames, pvs_hash $hash"
"$python" - run.jsonl python.jsonl <<'PY' || fail "the answers differ"
import json, sys
a, b = ([json.loads(line) for line in open(name)][1:] for name in sys.argv[1:])
assert a == b and a
PY

PYTHONPATH=$clients "$python" - "$url" <<'PY' || fail "the client's other verbs"
import asyncio, json, sys
from gridcull_client import Client, Refused

async def main():
    scene = json.load(open("town/scene.json"))
    for binary in (True, False):
        async with await Client.connect(sys.argv[1], binary=binary) as client:
            await client.open(scene)
            first = await client.frame(time=0.0)
            try:
                await client.frame(time=-1.0)
                raise AssertionError("time went back")
            except Refused as refusal:
                assert (refusal.code, refusal.pointer) == ("bad_frame", "/time")
            await client.socket.close()
            assert await client.resume() == 1
            assert await client.frame(time=1.0, reply="delta") == first
            viewer, seen = next(iter(first.items()))
            assert (await client.explain(viewer, seen[0]))["verdict"] == "visible"
            assert (await client.close())["type"] == "closed"

asyncio.run(main())
PY
ended server
finish
