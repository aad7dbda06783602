#!/usr/bin/env bash
# Static worlds in volume files: the same answers with and without, in both stores; files that are refused.
source "$(dirname "$0")/library.sh"

good "make city" make city --blocks 4 --count 40 --viewers 4 --range 60 --frames 12 --out city
if ! "$program" bake static city/scene.json --out static.vdb >stdout.txt 2>stderr.txt; then
  if grep -q "built without OpenVDB" stderr.txt; then
    echo "skipped: built without OpenVDB"
    exit 77
  fi
  fail "bake static: $(cat stderr.txt)"
fi

# with SCENE FILE [sed EXPRESSION]: the scene, naming the file.
with() { sed -e "s|\"objects\": \\[|\"static_volume\": {\"file\": \"$2\"}, &|" ${3:+-e "$3"} "$1"; }
pvs() {  # pvs NAME OUT COMMAND...: the answers, without the line that names the scene
  local name=$1 out=$2
  shift 2
  good "$name" run "$@" --out pvs.jsonl
  tail -n +2 pvs.jsonl >"$out"
}

cp static.vdb city/static.vdb
with city/scene.json static.vdb >city/with.json
frames=(--frames city/frames.jsonl)
for method in voxel silhouette frustum; do
  pvs "$method without" plain.txt city/scene.json "${frames[@]}" --method $method
  is "answers of $method" "$(wc -l <plain.txt)" 48
  pvs "$method with" stored.txt city/with.json "${frames[@]}" --method $method
  same "$method with and without the file" plain.txt stored.txt
  pvs "$method in arrays" dense.txt city/with.json "${frames[@]}" --method $method --store dense
  same "$method in arrays" plain.txt dense.txt
  pvs "$method in trees" trees.txt city/scene.json "${frames[@]}" --method $method --store openvdb
  same "$method in trees" plain.txt trees.txt
done
good "check with the file" check city/with.json "${frames[@]}" --method voxel --every 6 --rays 64
good "info with the file" info city/with.json "${frames[@]}"
grep -q "those of city/static.vdb" stdout.txt || fail "info does not say where the bounds come from"

# 2D, bounds of its own.
good "make town" make town --count 30 --viewers 3 --range 80 --frames 5 --out town
good "bake the town" bake static town/scene.json --out town/static.vdb
with town/scene.json static.vdb >town/with.json
pvs "town without" plain.txt town/scene.json --frames town/frames.jsonl --method voxel
pvs "town with" stored.txt town/with.json --frames town/frames.jsonl --method voxel
same "the town with and without" plain.txt stored.txt

# A part of the cells only: nobody who is in sight is missed, and nobody out of view is told.
good "check with a part of the cells" check city/with.json "${frames[@]}" --method voxel --every 6 --rays 64 \
  --static-memory 20000
pvs "none of the cells" none.txt city/with.json "${frames[@]}" --method voxel --static-memory 0
pvs "all of the cells" all.txt city/with.json "${frames[@]}" --method voxel --static-memory 1000000000
pvs "without tiles" stored.txt city/with.json "${frames[@]}" --method voxel
same "all tiles" stored.txt all.txt
cmp -s none.txt all.txt && fail "--static-memory 0 hides as much as all cells"
refused "--static-memory without a volume" "expected a scene with a static_volume" run city/scene.json --method voxel \
  --static-memory 1000
refused "--static-memory of silhouette" "silhouette keeps no cells" run city/with.json --static-memory 1000
refused "--static-memory of words" "a whole number of bytes" run city/with.json --static-memory much

# Edits at run time: what moves, goes or comes back is discretised.
cat >edits.jsonl <<'FRAMES'
{"format": "gridcull.frames/1"}
{"time": 1}
{"time": 2, "set": [{"id": 3, "position": [50, 50]}]}
{"time": 3, "remove": [5]}
{"time": 4, "add": [{"id": 5, "static": true, "shape": {"type": "disc", "radius": 4}, "position": [60, 60]}]}
FRAMES
pvs "edits without" plain.txt town/scene.json --frames edits.jsonl --method voxel
pvs "edits with" stored.txt town/with.json --frames edits.jsonl --method voxel
same "edits with and without" plain.txt stored.txt

# A model.
cat >block.obj <<'MODEL'
v 0 0 0
v 9 0 0
v 9 9 0
v 0 9 0
v 0 0 9
v 9 0 9
v 9 9 9
v 0 9 9
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
MODEL
if "$program" bake static block.obj --cell 1 --out block.vdb >stdout.txt 2>stderr.txt; then
  grep -q "1 static object" stdout.txt || fail "the model: $(cat stdout.txt)"
else
  grep -q "assimp" stderr.txt || fail "the model: $(cat stderr.txt)"
fi

# What is refused.
refused "no scene" "expected a scene or a model" bake static --out out/x.vdb
refused "no --out" "--out is required" bake static city/scene.json
refused "a method" "no --method" bake static city/scene.json --method five-d-tree --out out/x.vdb
refused "a setting of a method" "no option of bake static" bake static city/scene.json --s-thresh 0.5 --out out/x.vdb
scene moving.json '{"id": 1, "shape": {"type": "disc", "radius": 1}, "position": [0, 0]}'
refused "nothing static" "expected static objects, found none" bake static moving.json --out out/x.vdb
refused "no room" "larger cells need fewer" bake static city/scene.json --max-memory 1000 --out out/x.vdb
cp static.vdb kept.vdb
refused "no room for lists" "larger cells need fewer" bake static city/scene.json --max-memory 30000 --out kept.vdb
cmp -s static.vdb kept.vdb || fail "a bake that failed touched the file that was there"
refused "no folder" "cannot be written" bake static city/scene.json --out none/x.vdb
with city/scene.json none.vdb >city/bad.json
refused "no such file" "city/bad.json: /static_volume/file: city/none.vdb: there is no such file" run city/bad.json
with city/scene.json ../town/static.vdb >city/bad.json
refused "a file of another dimension" "expected cells of a 3D scene, found 2D" run city/bad.json
with city/scene.json static.vdb 's/"size": \[4/"size": [4.5/' >city/bad.json
good "another car" run city/bad.json
with city/scene.json static.vdb '0,/"height": [0-9.]*/s//"height": 99/;0,/"static": true, "shape": {"type": "box", "size": \[[0-9.]*/s//"static": true, "shape": {"type": "box", "size": [1/' >city/bad.json
refused "another building" "found those of others" run city/bad.json
refused "another cell" "expected cells of 0.7 m, found cells of" run city/with.json --cell 0.7
refused "--store" "--store: expected dense or openvdb, found" run city/with.json --store disk
for place in 900 3000 5000; do
  cp static.vdb city/cut.vdb
  printf '\377' | dd of=city/cut.vdb bs=1 seek=$place conv=notrunc 2>/dev/null
  with city/scene.json cut.vdb >city/bad.json
  refused "altered at $place" "city/cut.vdb: " run city/bad.json --method voxel
done
head -c 3000 static.vdb >city/cut.vdb
with city/scene.json cut.vdb >city/bad.json
refused "cut short" "city/cut.vdb: " run city/bad.json --method voxel
cp city/scene.json city/text.vdb
with city/scene.json text.vdb >city/bad.json
refused "no .vdb" "city/text.vdb: cannot be read as a .vdb file" run city/bad.json
finish
