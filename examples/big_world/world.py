#!/usr/bin/env python3
"""A big static world: 10 km x 10 km x 200 m, a town of 50,000 buildings, some cars and viewers in its streets; and the
square kilometre about the viewers cut out of it.

    world.py FOLDER [--cell METRES] [--buildings N] [--viewers N] [--frames N]

writes FOLDER/scene.json, FOLDER/baked.json (the same, naming static.vdb, which gridcull bake static makes),
FOLDER/crop.json and FOLDER/frames.jsonl. The same numbers give the same files."""
import argparse
import json
import math
import os
import random

SIDE, HEIGHT = 10000.0, 200.0
CROP = (4500.0, 5500.0)
PITCH = 20.0


def buildings(count, rng):
    """Houses of 10 x 8 m, jittered on a pitch of 20 m: dense in the middle, thinning out."""
    plots = [(x, y) for x in range(int(SIDE / PITCH)) for y in range(int(SIDE / PITCH))]
    middle = SIDE / PITCH / 2
    plots.sort(key=lambda p: math.hypot(p[0] - middle, p[1] - middle) * rng.uniform(0.7, 1.5))
    for number, (x, y) in enumerate(plots[:count]):
        far = math.hypot(x - middle, y - middle) / middle
        height = rng.uniform(4, 12) + max(0.0, 1 - 2 * far) * rng.uniform(0, 30)
        yield {"id": number, "static": True, "heading": round(rng.uniform(-0.3, 0.3), 6),
               "shape": {"type": "prism", "vertices": outline(10, 8), "height": round(height, 3)},
               "position": [round((x + 0.5) * PITCH + rng.uniform(-2, 2), 3),
                            round((y + 0.5) * PITCH + rng.uniform(-2, 2), 3), 0]}


def outline(length, width):
    """An L, as houses with a yard have."""
    a, b = round(length / 2, 3), round(width / 2, 3)
    return [[-a, -b], [a, -b], [a, 0], [0, 0], [0, b], [-a, b]]


def cars(first, count, rng):
    """On the streets between plots; those in front, who look around, well within the square kilometre."""
    for number in range(count):
        x = 4720 + PITCH * rng.randrange(28)
        yield {"id": first + number, "shape": {"type": "box", "size": [4.5, 1.8, 1.5]}, "max_speed": 15,
               "position": [round(x, 3), round(rng.uniform(4720, 5260), 3), 0.75], "heading": 1.5707963267948966}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder")
    parser.add_argument("--cell", type=float, default=1.0)
    parser.add_argument("--buildings", type=int, default=50000)
    parser.add_argument("--viewers", type=int, default=20)
    parser.add_argument("--frames", type=int, default=40)
    arguments = parser.parse_args()
    rng = random.Random(10)
    houses = list(buildings(arguments.buildings, rng))
    moving = list(cars(len(houses), 500, rng))
    viewers = [{"id": i, "follows": moving[i]["id"], "offset": [0, 0, 0.75], "range": 200} for i in range(arguments.viewers)]

    def write(name, low, high, volume=None):
        inside = [o for o in houses if all(low - 10 <= c <= high + 10 for c in o["position"][:2])]
        scene = {"format": "gridcull.scene/1", "dimension": 3,
                 # Opaque cells begin a 32nd of a cell above the ground, clear of the houses' feet.
                 "bounds": {"min": [low, low, -31 / 32 * arguments.cell], "max": [high, high, HEIGHT]},
                 "grid": {"cell": arguments.cell}, "objects": inside + moving, "viewers": viewers}
        if volume:
            scene["static_volume"] = {"file": volume}
        with open(os.path.join(arguments.folder, name), "w") as file:
            json.dump(scene, file)

    os.makedirs(arguments.folder, exist_ok=True)
    write("scene.json", 0.0, SIDE)
    write("baked.json", 0.0, SIDE, "static.vdb")
    write("crop.json", *CROP)
    with open(os.path.join(arguments.folder, "frames.jsonl"), "w") as file:
        file.write('{"format": "gridcull.frames/1"}\n')
        for step in range(arguments.frames):
            moves = [{"id": o["id"], "position": [o["position"][0], round(o["position"][1] + 0.5 * step, 3), 0.75]}
                     for o in moving]
            file.write(json.dumps({"time": 0.1 * step, "set": moves}) + "\n")


main()
