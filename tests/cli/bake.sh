#!/usr/bin/env bash
# Baking: a file that run, check, info and bench take, breaks that cost nothing, and files that are refused.
source "$(dirname "$0")/library.sh"
set -m  # jobs of their own, so that they do not ignore SIGINT
# A shell that was itself started with SIGINT ignored (a background job) cannot give it back to its jobs; env can.
heeding=(env --default-signal=INT)

good "make town" make town --out town --count 64 --viewers 3 --range 80 --frames 6
good "make another" make town --out other --count 64 --viewers 3 --range 80 --frames 6 --seed 9
quick=(--method five-d-tree --s-thresh 0.05 --cells 64 --boxes 64)

# The file and who reads it.
good "bake" bake "${quick[@]}" town/scene.json --out town.baked
grep -q "^members  *64 static objects, 64 motion boxes" stdout.txt || fail "bake says: $(cat stdout.txt)"
is "codings reported" "$(grep -c '^coding ' stdout.txt)" 3
grep '^coding ' stdout.txt >codings.txt
good "info of the file" info town/scene.json --frames town/frames.jsonl --baked town.baked
grep '^coding ' stdout.txt >again.txt
same "codings that bake and info report" again.txt codings.txt
good "bake with one thread" bake "${quick[@]}" --threads 1 town/scene.json --out one.baked
same "files by one and by several threads" one.baked town.baked
good "run" run town/scene.json --frames town/frames.jsonl --method five-d-tree --baked town.baked --out out/pvs.jsonl
good "run without" run town/scene.json --frames town/frames.jsonl --method five-d-tree --out out/small.jsonl
cmp -s out/pvs.jsonl out/small.jsonl && fail "the file makes no difference"
good "check" check town/scene.json --frames town/frames.jsonl --method five-d-tree --baked town.baked --json
good "check about a box" check town/scene.json --frames town/frames.jsonl --method five-d-tree --baked town.baked --view-box 2
good "bench" bench --scenes town/scene.json@town/frames.jsonl --methods five-d-tree,frustum --frames 3 --repeats 1 \
  --baked town.baked
rm -f out/*

# A break: FILE.part, and the same file in the end. slow.baked.part is left to look at.
slow=(--method five-d-tree --s-thresh 0.002 --cells 300 --boxes 128 town/scene.json)
broken_off() {  # broken_off NAME ARGUMENTS...
  local name=$1 child
  shift
  checks=$((checks + 1))
  "${heeding[@]}" "$program" bake "$@" --out out/slow.baked >stdout.txt 2>stderr.txt &
  child=$!
  sleep 0.7
  kill -s INT "$child"
  wait "$child"
  is "$name: status after Ctrl-C" $? 130
  is "$name: left after Ctrl-C" "$(ls out)" "slow.baked.part"
  grep -q '^gridcull: stopped; out/slow.baked.part holds the work so far' stderr.txt || fail "$name: $(cat stderr.txt)"
  cp out/slow.baked.part .
  good "$name: the same command again" bake "$@" --out out/slow.baked
  grep -q "gone on from out/slow.baked.part" stdout.txt || fail "$name: it did not go on: $(cat stdout.txt)"
  is "$name: left in the end" "$(ls out)" "slow.baked"
  good "$name: without a break" bake "$@" --out whole.baked
  same "$name: with and without a break" out/slow.baked whole.baked
  rm -f out/*
}
good "make city" make city --out city --blocks 3 --count 20 --frames 2
broken_off "cells" --method extended-projections --map 128 --threads 1 city/scene.json
mv slow.baked.part cells.part
mv whole.baked cells.baked
broken_off "tree" "${slow[@]}"

# Unfinished work of something else.
unfinished() {  # unfinished NAME WORD ARGUMENTS...: FILE.part stays as it is
  local name=$1 word=$2
  shift 2
  cp slow.baked.part part.baked.part
  refused "$name" "$word" bake "$@" --out part.baked
  same "$name leaves the unfinished file alone" part.baked.part slow.baked.part
  rm -f part.baked.part
}
unfinished "unfinished with other options" "other options" "${quick[@]}" town/scene.json
unfinished "unfinished with another cell size" "other options" "${slow[@]}" --cell 3.5
unfinished "unfinished of another world" "another world" "${quick[@]}" other/scene.json
head -c 200 slow.baked.part >cut.part
cp cut.part slow.baked.part
unfinished "unfinished and cut short" "cut short" "${slow[@]}"

# Files that are no good.
reading=(run town/scene.json --frames town/frames.jsonl --method five-d-tree --out out/pvs.jsonl)
head -c 1000 town.baked >cut.baked
refused "cut short" "cut.baked: cut short" "${reading[@]}" --baked cut.baked
refused "cut short (info)" "cut.baked: cut short" info town/scene.json --baked cut.baked
refused "cut short (bench)" "cut.baked: cut short" bench --scenes town:64 --methods five-d-tree --baked cut.baked
{ head -c 1000 town.baked; printf 'x'; tail -c +1002 town.baked; } >altered.baked
refused "altered" "altered.baked: altered" "${reading[@]}" --baked altered.baked
{ head -c 8 town.baked; printf '\x07'; tail -c +10 town.baked; } >future.baked
refused "from the future" "version 7 of baked files" "${reading[@]}" --baked future.baked
refused "a scene instead" "no baked file" "${reading[@]}" --baked town/scene.json
refused "no such file" "missing.baked" "${reading[@]}" --baked missing.baked
refused "another world" "another world" run other/scene.json --method five-d-tree --baked town.baked --out out/pvs.jsonl
refused "another world (check)" "another world" check other/scene.json --method five-d-tree --baked town.baked
refused "another world (info)" "another world" info other/scene.json --baked town.baked
refused "another world (bench)" "none of the scenes" bench --scenes other/scene.json --methods five-d-tree --baked town.baked
refused "a method that does not bake" "reads no baked file" run town/scene.json --method frustum --baked town.baked

# Those of the other method that bakes.
good "make another city" make city --out elsewhere --blocks 3 --count 20 --frames 2 --seed 9
looking=(run city/scene.json --method extended-projections --out out/pvs.jsonl)
good "cells" "${looking[@]}" --baked cells.baked
rm -f out/*
head -c 1000 cells.baked >cut.baked
refused "cells cut short" "cut.baked: cut short" "${looking[@]}" --baked cut.baked
{ head -c 1000 cells.baked; printf 'x'; tail -c +1002 cells.baked; } >altered.baked
refused "cells altered" "altered.baked: altered" "${looking[@]}" --baked altered.baked
{ head -c 8 cells.baked; printf '\x07'; tail -c +10 cells.baked; } >future.baked
refused "cells from the future" "version 7 of baked files" "${looking[@]}" --baked future.baked
refused "cells of another world" "another world" \
  run elsewhere/scene.json --method extended-projections --baked cells.baked --out out/pvs.jsonl
refused "cells for the tree" "for the method extended-projections" \
  run city/scene.json --method five-d-tree --baked cells.baked --out out/pvs.jsonl
refused "cells of a flat world" "does not take 2D" bake --method extended-projections town/scene.json --out out/x
cp cells.part out/other.baked.part
checks=$((checks + 1))
"$program" bake --method extended-projections --map 64 --threads 1 city/scene.json --out out/other.baked 2>stderr.txt
[ $? -eq 2 ] && grep -q "other options" stderr.txt || fail "unfinished cells with another map: $(cat stderr.txt)"
rm -f out/*

# Command lines that are no good.
refused "no method" "one that bakes: .*five-d-tree" bake town/scene.json --out out/x
refused "a method that cannot" "frustum does not bake" bake --method frustum town/scene.json --out out/x
refused "no file to write" "out" bake "${quick[@]}" town/scene.json
refused "standard output" "out" bake "${quick[@]}" town/scene.json --out -
refused "in no folder" "nowhere" bake "${quick[@]}" town/scene.json --out nowhere/x
refused "a share of nothing" "s-thresh" bake --method five-d-tree --s-thresh 0 town/scene.json --out out/x
refused "half a cell" "cells" bake --method five-d-tree --cells 2.5 town/scene.json --out out/x
refused "three intervals" "intervals" bake --method five-d-tree --intervals 3 town/scene.json --out out/x
refused "no height" "high" bake --method five-d-tree --low 2 --high 1 town/scene.json --out out/x
refused "two scenes" "one scene" bake "${quick[@]}" town/scene.json other/scene.json --out out/x
refused "a box of less than nothing" "view-box" run town/scene.json --method five-d-tree --view-box -1

finish
