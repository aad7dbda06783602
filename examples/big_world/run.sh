#!/usr/bin/env bash
# A world of 10 km x 10 km x 200 m in cells of 1 m, with a town of 50,000 houses: discretised once into a .vdb file, opened
# from it, whole and with a limit on the memory for cells, and held against the square kilometre that is cut out of it.
# Installs what is missing, builds gridcull, makes the world.
#   examples/big_world/run.sh [--small] [--out FOLDER]
# --small: 1,000 houses, three viewers. Without root it names missing packages and stops (status 2).
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../live/example.sh"
example_arguments big_world "$@"
houses=50000 viewers=20
[ -z "$small" ] || houses=1000 viewers=3

# shellcheck disable=SC2086  # lists are meant to be split
need $packages_program python3
build_gridcull
mkdir -p "$out"
frames=$out/frames.jsonl

# told COMMAND...: what `gridcull run` says of its frames, and the memory that it took at most.
told() {
  python3 - "$@" <<'PY'
import resource, subprocess, sys
lines = subprocess.run(sys.argv[1:], check=True, capture_output=True, text=True).stdout.splitlines()
print("\n".join(line for line in lines if line.startswith(("frames", "mean PVS", "time a frame", "pvs_hash"))))
print(f"memory          {resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024:.0f} MiB at most")
PY
}

echo "== $houses houses, and the square kilometre in the middle"
python3 examples/big_world/world.py "$out" --buildings "$houses" --viewers "$viewers" --frames 4
echo "== their cells, once"
"$gridcull" bake static "$out/scene.json" --out "$out/static.vdb"
echo "== voxel from the file"
told "$gridcull" run "$out/baked.json" --frames "$frames" --method voxel | tee "$out/whole.txt"
echo "== the same with at most 20 MB for cells: the tiles about the viewers"
told "$gridcull" run "$out/baked.json" --frames "$frames" --method voxel --static-memory 20000000 | tee "$out/tiles.txt"
echo "== the square kilometre alone"
told "$gridcull" run "$out/crop.json" --frames "$frames" --method voxel | tee "$out/crop.txt"
echo "== silhouette, which needs no cells, in the world and in the square kilometre"
told "$gridcull" run "$out/baked.json" --frames "$frames" --method silhouette
told "$gridcull" run "$out/crop.json" --frames "$frames" --method silhouette
for part in tiles crop; do
  cmp -s <(grep pvs_hash "$out/whole.txt") <(grep pvs_hash "$out/$part.txt") || { echo "$part answers otherwise" >&2; exit 1; }
done
echo "all three of voxel give the same answers"
echo "== held against the exact reference (rays)"
"$gridcull" check "$out/baked.json" --frames "$frames" --method voxel --every 4
