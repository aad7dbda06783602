"""Tells a server the frames of a file over a plain socket and kills it in the middle. Prints how many were acknowledged.

    kill_server.py PORT PID SCENE FRAMES
Nothing but Python's own library: a WebSocket needs little when one end is known.
"""
import json
import os
import signal
import socket
import struct
import sys

port, pid, scene_file, frames_file = int(sys.argv[1]), int(sys.argv[2]), sys.argv[3], sys.argv[4]
stream = socket.create_connection(("127.0.0.1", port), timeout=30).makefile("rwb", buffering=0)
stream.write(b"GET /v1/stream HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
             b"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n")
while stream.readline() != b"\r\n":
    pass


def exact(count):
    data = b""
    while len(data) < count:
        piece = stream.read(count - len(data))
        if not piece:
            raise EOFError
        data += piece
    return data


def tell(message):
    data = json.dumps(message).encode()
    n = len(data)
    size = bytes([128 | n]) if n < 126 else b"\xfe" + struct.pack(">H", n) if n < 1 << 16 else b"\xff" + struct.pack(">Q", n)
    stream.write(b"\x81" + size + bytes(4) + data)  # masked with zeros


def ask(message):
    tell(message)
    size = exact(2)[1]
    if size == 126:
        size, = struct.unpack(">H", exact(2))
    elif size == 127:
        size, = struct.unpack(">Q", exact(8))
    return json.loads(exact(size))


with open(scene_file) as scene, open(frames_file) as frames:
    assert ask({"type": "open", "scene": json.load(scene)})["type"] == "opened"
    lines = list(frames)[1:]
acknowledged = 0
for number, line in enumerate(lines, 1):
    if number == 500:
        # One more on its way, and the end.
        tell({"type": "frame", "seq": number, **json.loads(line)})
        os.kill(pid, signal.SIGKILL)
        break
    answer = ask({"type": "frame", "seq": number, "reply": "none", **json.loads(line)})
    assert answer == {"type": "ok", "seq": number}, answer
    acknowledged = number
print(acknowledged)
