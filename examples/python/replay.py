"""Replays a world's files through a server and writes what `gridcull run` would: pvs.jsonl, and the hash of all answers.

    gridcull serve --port 8080 &
    python3 examples/python/replay.py ws://127.0.0.1:8080 town/scene.json town/frames.jsonl pvs.jsonl
"""
import asyncio
import json
import sys

from gridcull_client import Client, moves

MASK = (1 << 64) - 1


def hashed(state, words):
    """FNV-1a over little-endian u32 words, as in gridcull.stats/1."""
    for byte in b"".join(word.to_bytes(4, "little") for word in words):
        state = (state ^ byte) * 0x100000001B3 & MASK
    return state


async def replay(url, scene_file, frames_file, out_file):
    with open(scene_file) as scene, open(frames_file) as frames, open(out_file, "w") as out:
        json.dump({"format": "gridcull.pvs/1", "method": "silhouette", "scene": scene_file}, out)
        state = 0xCBF29CE484222325
        async with await Client.connect(url) as client:
            await client.open(json.load(scene), name=scene_file)
            next(frames)  # the format
            for number, line in enumerate(frames):
                frame = json.loads(line)
                moved = frame.get("set", [])
                if moved and all(set(m) == {"id", "position", "heading"} for m in moved):  # bulk takes whole rows
                    del frame["set"]
                    frame.update(moves(*([m[key] for m in moved] for key in ("id", "position", "heading"))))
                for viewer, visible in (await client.frame(reply="delta", **frame)).items():
                    state = hashed(state, [viewer, len(visible), *visible])
                    line = {"frame": number, "time": frame["time"], "viewer": viewer, "visible": visible}
                    out.write("\n" + json.dumps(line))
            await client.close()
        out.write("\n")
    print(f"{number + 1} frames, pvs_hash {state:016x}")


asyncio.run(replay(*sys.argv[1:5]))
