"""Talk to `gridcull serve` from Python: open a world, tell its frames, get who may see whom (gridcull.wire/1).

    async with await Client.connect("ws://127.0.0.1:8080") as client:
        await client.open(scene)
        answers = await client.frame(time=0.0, set=[{"id": 9, "position": [13.0, 7.0]}])   # {viewer: [object ids]}

Needs websockets and cbor2 (Debian: python3-websockets, python3-cbor2), and NumPy for `moves` (python3-numpy).
"""
import json

import cbor2
import websockets


class Refused(Exception):
    """An answer of type "error"; `code` and `pointer` as in the protocol."""

    def __init__(self, answer):
        super().__init__(f"{answer['code']}: {answer['message']}")
        self.code = answer["code"]
        self.pointer = answer.get("pointer", "")


class Client:
    """One session. Every call waits for its answer; refusals are raised as Refused and change nothing."""

    def __init__(self, url, socket, binary):
        self.url, self.socket, self.binary = url, socket, binary
        self.session = self.token = None
        self.seq = 0
        self.seen = {}  # viewer -> set of ids, by the answers so far
        self.last = None  # the last frame's message

    @classmethod
    async def connect(cls, url, binary=True):
        """`binary`: CBOR messages, which bulk moves need; else JSON."""
        return cls(url, await websockets.connect(url + "/v1/stream", max_size=None), binary)

    async def __aenter__(self):
        return self

    async def __aexit__(self, *_):
        await self.socket.close()

    async def ask(self, message):
        """Sends one message and gives its answer."""
        await self.socket.send(cbor2.dumps(message) if self.binary else json.dumps(message))
        answer = await self.socket.recv()
        answer = json.loads(answer) if isinstance(answer, str) else cbor2.loads(answer)
        if answer["type"] == "error":
            raise Refused(answer)
        return answer

    async def open(self, scene, method="silhouette", **more):
        """`scene`: gridcull.scene/1 as a dict. `more`: options, name, token."""
        answer = await self.ask({"type": "open", "scene": scene, "method": method, **more})
        self.session, self.token, self.seq, self.seen = answer["session"], answer["token"], 0, {}
        return answer

    async def frame(self, time, reply="full", **parts):
        """One frame; `parts` as in gridcull.frames/1, or what moves() gives. Gives {viewer: sorted ids}."""
        parts["bulk"] = self.binary and parts.get("bulk", True)
        self.last = {"type": "frame", "seq": self.seq + 1, "time": time, "reply": reply, **parts}
        return self._answers(await self.ask(self.last))

    async def repeat(self):
        """After resume(): sends the last frame again, since nobody knows whether it or its answer was lost, and gives
        its answers. The server applies a frame once."""
        return self._answers(await self.ask(self.last))

    def _answers(self, answer):
        if answer["seq"] != self.last["seq"]:
            raise RuntimeError(f"frame {self.last['seq']} got another's answer: was a call cancelled? resume()")
        self.seq = answer["seq"]
        bulk = self.last["bulk"]
        return {entry["viewer"]: self._take(entry, bulk) for entry in answer.get("answers", [])}

    def _take(self, entry, bulk):
        def ids(key):
            value = entry.get(key, b"" if bulk else [])
            return memoryview(value).cast("I").tolist() if bulk else value

        seen = set(ids("visible")) if "visible" in entry else self.seen.get(entry["viewer"], set()) - set(ids("removed"))
        seen.update(ids("added"))
        self.seen[entry["viewer"]] = seen
        return sorted(seen)

    async def explain(self, viewer, object):
        """Why the viewer sees the object in the last frame, or does not."""
        return await self.ask({"type": "explain", "viewer": viewer, "object": object})

    async def resume(self):
        """After a lost connection: a new one to the same session. Gives the number of the last frame it applied."""
        await self.socket.close()
        self.socket = await websockets.connect(self.url + "/v1/stream", max_size=None)
        answer = await self.ask({"type": "resume", "session": self.session, "token": self.token})
        self.seq = answer["seq"]
        return self.seq

    async def close(self):
        """Ends the session."""
        return await self.ask({"type": "close"})


def moves(ids, positions, headings=None, orientations=None):
    """Moves of many objects in bulk, from NumPy arrays: `ids` (n), `positions` (n x dimension, metres), `headings` (n,
    radians, 2D) or `orientations` (n x 4, unit quaternions w x y z, 3D). For frame(**moves(...)); f64, so that answers
    are the same in every bit as from a file."""
    import numpy

    ids = numpy.asarray(ids)
    if ids.size and (ids.min() < 0 or ids.max() > 2**32 - 2):
        raise ValueError("ids: expected whole numbers 0 .. 2^32 - 2")
    out = {"set_ids": numpy.ascontiguousarray(ids, "<u4").tobytes(),
           "set_positions64": numpy.ascontiguousarray(positions, "<f8").tobytes()}
    if headings is not None:
        out["set_headings64"] = numpy.ascontiguousarray(headings, "<f8").tobytes()
    if orientations is not None:
        out["set_orientations64"] = numpy.ascontiguousarray(orientations, "<f8").tobytes()
    return out
