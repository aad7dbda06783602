#!/usr/bin/env bash
# `gridcull info --advise`: what it says of small cities in 2D and 3D and of walls that no cell catches, what it refuses,
# Ctrl-C.
source "$(dirname "$0")/library.sh"

# said WHAT PATTERN: a line of standard output.
said() {
  checks=$((checks + 1))
  grep -Eq -e "$2" stdout.txt || fail "$1: no line '$2': $(cat stdout.txt)"
}
# The rows without times, and without what hangs on them: who is on the frontier and what is advised.
steady() { sed -nE '/^method/,/^Fastest/{/^Fastest/q;s/^(silhouette|voxel)( .*)( +[0-9.]+){2}(( +[0-9.]+){3} +[0-9.]+ [kM]?B) .*/\1\2\4/;p}' stdout.txt | tr -s " "; }

"$program" make town --out town --count 25 --viewers 3 --range 60 --frames 90 --seed 7 >/dev/null || fail "make town"
"$program" make city --out city --blocks 2 --count 20 --viewers 2 --range 60 --frames 6 >/dev/null || fail "make city"

good "a town" info town/scene.json --frames town/frames.jsonl --advise
said "a town" "^grid  "
said "a town" "^measured +30 frames of 90: 0, 3 \.\. 87 "
said "a town" "^judged +5 frames of them, at most 10 viewers in each, against the exact sets$"
said "a town" "^silhouette +default .* on the frontier$"
is "rows of voxel" "$(grep -c '^voxel  *cell ' stdout.txt)" 5
is "misses" "$(grep -E '^(voxel|silhouette) ' stdout.txt | grep -cE ' 0  +[0-9.]+ [kM]?B  ')" 6
said "a town" "^Fastest"
said "a town" "--method silhouette$"
steady >first.txt
good "a town again" info town/scene.json --frames town/frames.jsonl --advise
steady >second.txt
same "what is no time" first.txt second.txt
is "rows that were compared" "$(grep -cE "^(silhouette|voxel) " first.txt)" 6
good "every tenth frame" info town/scene.json --frames town/frames.jsonl --advise --every 10 --threads 2
said "every tenth frame" "^measured +9 frames of 90: 0, 10 \.\. 80 "
said "every tenth frame" "^asked by +3 viewers, 2 threads$"
good "a town that stands still" info town/scene.json --advise
said "a town that stands still" "^measured +the scene as it stands, asked 10 times"

good "a city" info city/scene.json --frames city/frames.jsonl --advise
said "a city" "^measured +all 6 frames;"
for pixels in default "64 pixels" "1024 pixels"; do said "a city" "^silhouette +$pixels .*(frontier|beaten by .*)$"; done
if grep -q "^judged .*built without Embree" stdout.txt; then
  said "a city without reference" "^voxel .* - +- "
else
  said "a city" "^judged +5 frames .* 256 rays"
fi
said "a city" "(--method silhouette( --resolution [0-9]+)?|--method voxel.*)$"

# What is too fine for the memory allowed is told, and the others run.
good "little memory" info city/scene.json --frames city/frames.jsonl --advise --max-memory 300000
said "little memory" "^voxel +cell .* refused: cells of .* need "
said "little memory" "^Fastest"

# Walls of 0.3 m fill no cell of 0.5 m, fences of no width none at all.
walls=
for i in 1 2 3 4 5 6 7; do
  walls+="{\"id\": 1$i, \"shape\": {\"type\": \"box\", \"size\": [6, 0.3]}, \"position\": [${i}0, 4.2]},"
  walls+="{\"id\": $i, \"shape\": {\"type\": \"box\", \"size\": [6, 6]}, \"position\": [${i}0, 14]},"
done
scene walls.json "$walls {\"id\": 90, \"name\": \"fence\", \"shape\": {\"type\": \"polyline\", \"vertices\": [[0, 0], [9, 0]]}, \"position\": [1, 1]}" \
  '{"id": 1, "position": [0, 9]}' '"grid": {"cell": 0.5},'
good "walls" info walls.json --advise
said "walls" "^cell-less +7 occluders hold no whole cell: 11, 12, 13, 14, 15, 16, 17; 1 without an interior never does: 90 \(fence\)$"
said "walls" "^occluders +14 with an interior"
said "walls" "^  cell 0.5 m +7: 11, 12, 13, 14, 15, \.\.\.$"
said "walls" "^  thin +1, which fill none whatever the cell: 90 \(fence\)$"

scene empty.json '' '{"id": 4, "position": [0, 0]}'
good "an empty scene" info empty.json --advise
said "an empty scene" "^Fastest.* PVS 0\.00\)"

scene nobody.json '{"id": 1, "shape": {"type": "disc", "radius": 1}, "position": [0, 0]}'
refused "nobody looks" "^gridcull: --advise: expected viewers.*none in nobody.json$" info nobody.json --advise
refused "frames from a pipe" "--advise: expected a frames file" info town/scene.json --frames - --advise
refused "--every alone" "--every requires --advise" info town/scene.json --every 2
refused "--threads alone" "--threads requires --advise" info town/scene.json --threads 2
refused "every 0" "every: expected a whole number, 1 or more" info town/scene.json --advise --every 0
refused "0 threads" "threads: expected 1 .. 256" info town/scene.json --advise --threads 0

# Ctrl-C in the middle of the work.
set -m
"$program" make town --out big --count 2000 --viewers 300 --frames 40 >/dev/null || fail "make big"
env --default-signal=INT "$program" info big/scene.json --frames big/frames.jsonl --advise >stdout.txt 2>stderr.txt &
child=$!
for _ in $(seq 200); do grep -q '^memory' stdout.txt && break; sleep 0.05; done
kill -INT "$child"
wait "$child"
is "status after Ctrl-C" "$?" 130
grep -q '^gridcull: stopped' stderr.txt || fail "Ctrl-C: said: $(cat stderr.txt)"

finish
