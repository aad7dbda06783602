#!/usr/bin/env bash
# `gridcull bench`: a small run with its files, what it refuses, Ctrl-C.
source "$(dirname "$0")/library.sh"

small=(--scenes discs:40,discs:80 --methods frustum,pairwise-rays --frames 4 --repeats 2 --judge 2)
good "tables only" bench "${small[@]}"
grep -q "pairwise-rays, 1 thread" stdout.txt || fail "no row of pairwise-rays: $(cat stdout.txt)"
is "nothing written" "$(ls -A out)" ""

good "with files" bench "${small[@]}" --out out/b
is "a line a row, and the names" "$(grep -vc '^#' out/b/bench.csv)" 5
for fact in commit compiler flags processor; do
  grep -q "^# $fact: ." out/b/bench.csv || fail "bench.csv does not name its $fact"
done
misses=$(awk -F, '/^scene,/ { for (i = 1; i <= NF; ++i) at[$i] = i } /,frustum,/ { sum += $at["misses"] } END { print sum }' \
  out/b/bench.csv)
is "the view volume misses nobody" "$misses" 0
charts="accuracy-discs-40 accuracy-discs-80 hidden-discs"
if command -v gnuplot >/dev/null; then
  for chart in $charts; do
    for ending in gp svg png; do
      [ -s "out/b/$chart.$ending" ] || fail "$chart.$ending is not there"
    done
    head -c 300 "out/b/$chart.svg" | grep -q '<svg' || fail "$chart.svg is no SVG"
  done
fi
is "nothing but what was meant" "$(ls -A out/b | grep -c '^\.')" 0
rm -rf out/b

# Without gnuplot: the CSV and the scripts, and a line that says so.
PATH=/nonexistent good "without gnuplot" bench "${small[@]}" --out out/b
grep -q "gnuplot was not found" stdout.txt || fail "gnuplot missing, said: $(cat stdout.txt)"
[ -s out/b/bench.csv ] && [ -s out/b/hidden-discs.gp ] && [ ! -e out/b/hidden-discs.svg ] || fail "files without gnuplot"
rm -rf out/b

# A scene from files.
"$program" make discs --count 30 --frames 5 --out world >/dev/null || fail "make"
good "a folder" bench --scenes world --methods frustum --repeats 1
grep -q "^world: 2D, 30 objects" stdout.txt || fail "a folder: $(cat stdout.txt)"
good "files" bench --scenes world/scene.json@world/frames.jsonl --methods frustum --repeats 1

good "bounds" bench --scenes spheres:60 --methods frustum,silhouette --bounds box,sphere --resolutions 64 --frames 2 --repeats 1
for row in "frustum, bounds box" "frustum, bounds sphere" "silhouette, resolution and bounds 64 sphere"; do
  grep -q "^  $row, 1 thread" stdout.txt || fail "no row '$row': $(cat stdout.txt)"
done

good "pulled" bench --scenes spheres:60:hidden=40 --methods voxel,silhouette,frustum --frames 3 --repeats 1 --pull --out out/p
grep -q "^# positions: asked for" out/p/bench.csv || fail "bench.csv does not say that positions were asked for"
good "told" bench --scenes spheres:60:hidden=40 --methods silhouette --frames 3 --repeats 1 --judge 0 --out out/q
hash_of() { awk -F, '/^scene,/ { for (i = 1; i <= NF; ++i) at[$i] = i } /,silhouette,/ { print $at["pvs_hash"]; exit }' "$1"; }
is "pulled or told, the same answers" "$(hash_of out/p/bench.csv)" "$(hash_of out/q/bench.csv)"
rm -rf out/p out/q

r() { refused "$1" "$2" bench "${@:3}" --out out/b; }
r "unknown scene" "volcano" --scenes volcano
r "no such file" "missing" --scenes missing/scene.json
r "a scene twice" "twice" --scenes discs:5,discs:5
r "a bad count" "number" --scenes discs:many
r "unknown method" "magic" --methods magic
r "a method that takes no such scene" "none of them" --scenes discs:5 --methods depth-rays
r "stability, pulled" "pull" --stability --pull
r "0 threads" "threads" --threads 0
r "10,000 threads" "threads" --threads 1,10000
r "0 occluders" "occluders" --occluders 0
r "occluders by name" "occluders" --occluders 1,many
r "resolution 0" "resolution" --resolutions 0
r "resolution below 0" "resolution" --resolutions -5
r "resolution above 8192" "resolution" --resolutions 128x72,8193
r "cell 0" "cells" --cells 0
r "0 repeats" "repeats" --repeats 0
r "0 frames" "frames" --frames 0
r "frames below 0" "frames" --frames -1
r "judge below 0" "judge" --judge -1
r "0 rays" "rays" --rays 0
r "half a repeat" "repeats: expected 1 .. 1000, found 1.5" --repeats 1.5
r "seconds below 0" "seconds" --seconds -1
r "a bound nobody has" "26-dop" --bounds 16-dop
refused "a file as folder" "world/scene.json" bench "${small[@]}" --out world/scene.json
refused "resolution 0 to run" "resolution" run world/scene.json --resolution 0
refused "resolution above 8192 to run" "resolution" run world/scene.json --resolution 9000
"$program" make spheres --count 5 --frames 1 --out solid >/dev/null || fail "make"
refused "R for WxH" "WxH" run solid/scene.json --method depth-rays --resolution 64

# Ctrl-C in the middle of the work.
set -m
"$program" bench --scenes discs:2000 --methods frustum --frames 100 --repeats 1000 --seconds 1000 --judge 0 --out out/b \
  >stdout.txt 2>stderr.txt &
child=$!
for _ in $(seq 100); do grep -q processor stdout.txt 2>/dev/null || [ -n "$(ls -A out/b 2>/dev/null)" ] && break; sleep 0.05; done
kill -INT "$child"
wait "$child"
is "status after Ctrl-C" "$?" 130
is "left behind after Ctrl-C" "$(ls -A out)" ""
grep -q '^gridcull: stopped' stderr.txt || fail "Ctrl-C: said: $(cat stderr.txt)"

# What is worked out in advance is told beside the figures, and leaves nothing behind.
checks=$((checks + 1))
mkdir -p tmp
TMPDIR=$PWD/tmp "$program" bench --bake --scenes town:9:viewers=2:range=50 --methods five-d-tree,frustum --frames 3 \
  --repeats 1 --out out/baked >stdout.txt 2>stderr.txt || fail "bench --bake: $(cat stderr.txt)"
grep -q '^  five-d-tree, sets baked, 1 thread' stdout.txt || fail "bench --bake: no row: $(cat stdout.txt)"
grep -Eq '^  five-d-tree was baked in [0-9.e-]+ s on [0-9]+ threads?: ' stdout.txt || fail "bench --bake: no cost"
is "left behind by bench --bake" "$(ls -A tmp)" ""
column() { grep -v '^#' out/baked/bench.csv | head -1 | tr ',' '\n' | grep -n "^$1\$" | cut -d: -f1; }
for name in bake_seconds bake_threads baked_bytes; do
  grep '^town.*,five-d-tree,' out/baked/bench.csv | cut -d, -f"$(column $name)" | grep -Eq '^[0-9.e-]+$' || fail "$name"
  is "$name of frustum" "$(grep '^town.*,frustum,' out/baked/bench.csv | cut -d, -f"$(column $name)")" ""
done
rm -rf out/baked

# What cannot run at all is bad input.
checks=$((checks + 1))
"$program" bench --scenes spheres:50 --frames 1 --methods voxel --max-memory 1000 --cells 1 --out out/none \
  >stdout.txt 2>stderr.txt
is "status when no method fits" "$?" 2
grep -q "no method ran: .*1000 allowed" stderr.txt || fail "no method fits: said $(cat stderr.txt)"
is "left behind when no method fits" "$(ls -A out/none 2>/dev/null)" ""
GRIDCULL_ISA=neon refused "a set of instructions that nobody has" "GRIDCULL_ISA: unknown set" \
  bench --scenes discs:50 --frames 1 --methods voxel --out out/none
refused "a figure that nobody drew" "expected batagelo-5, speed-accuracy or tbv-upkeep" bench --figure mona-lisa
refused "a figure and scenes" "excludes" bench --figure batagelo-5 --scenes discs:50
refused "the volumes and scenes" "excludes" bench --figure tbv-upkeep --scenes discs:50
refused "a figure of no repeats" "repeats" bench --figure tbv-upkeep --repeats 0
refused "a figure with methods of its own" "no use for --methods" bench --figure batagelo-5 --methods voxel
refused "volumes and baked files" "no use for --bake" bench --figure tbv-upkeep --bake
refused "stability and resolutions" "no use for --resolutions" bench --stability --resolutions 64
refused "discs that stand still" "moving" bench --scenes discs:50:moving=3
refused "stability of what is no method" "found clairvoyance" bench --stability --methods clairvoyance
refused "stability and scenes" "excludes" bench --stability --scenes discs:50

finish
