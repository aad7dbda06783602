"""Buildings for a grid of streets: in every block a closed row around a yard, an L, or four houses. SUMO polygons.

    python3 buildings.py STREETS PITCH >buildings.poly.xml      (streets a side, metres between them)
"""
import random
import sys

SETBACK = 9.0  # from the middle of a street to the walls: lanes, pavements and a front garden
DEPTH = 12.0   # of a building


def rectangle(x0, y0, x1, y1):
    return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]


def row(lo, hi, gap):
    """Four wings around a yard, with a gateway through the one in the south."""
    inner_lo, inner_hi = lo + DEPTH, hi - DEPTH
    return [
        [(gap, lo), (hi, lo), (hi, inner_lo), (gap, inner_lo)],
        [(lo, lo), (gap - 4, lo), (gap - 4, inner_lo), (lo, inner_lo)],
        rectangle(lo, inner_lo, inner_lo, hi),
        rectangle(inner_hi, inner_lo, hi, hi),
        rectangle(inner_lo, inner_hi, inner_hi, hi),
    ]


def corner(lo, hi):
    return [[(lo, lo), (hi, lo), (hi, lo + DEPTH), (lo + DEPTH, lo + DEPTH), (lo + DEPTH, hi), (lo, hi)]]


def houses(lo, hi, dice):
    third = (hi - lo) / 3
    for x in (lo, hi - third):
        for y in (lo, hi - third):
            dx, dy = dice.uniform(0, third / 2), dice.uniform(0, third / 2)
            yield rectangle(x + dx / 2, y + dy / 2, x + third - dx / 2, y + third - dy / 2)


def main(streets, pitch):
    dice = random.Random(1)
    print("<additional>")
    for i in range(streets - 1):
        for j in range(streets - 1):
            lo, hi = SETBACK, pitch - SETBACK
            kind = dice.choice("rrch")
            block = (row(lo, hi, dice.uniform(lo + 20, hi - 20)) if kind == "r"
                     else corner(lo, hi) if kind == "c" else houses(lo, hi, dice))
            for number, outline in enumerate(block):
                shape = " ".join(f"{i * pitch + x:.2f},{j * pitch + y:.2f}" for x, y in outline)
                print(f'  <poly id="b{i}_{j}_{number}" type="building" color="160,160,160" fill="1" shape="{shape}"/>')
    print("</additional>")


main(int(sys.argv[1]), float(sys.argv[2]))
