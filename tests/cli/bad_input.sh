#!/usr/bin/env bash
# Bad input gets one clear line and exit status 2, and leaves nothing half-written.
source "$(dirname "$0")/library.sh"

everything=(--out out/pvs.jsonl --stats out/stats.json --picture 0:1:out/view.svg)
box='{"id": 1, "shape": {"type": "box", "size": [4, 2]}, "position": [3, 3]}'
eye='{"id": 1, "position": [0, 0]}'

# bad_scene NAME WORD OBJECTS [VIEWERS [MORE_KEYS]]
bad_scene() {
  scene s.json "$3" "${4:-$eye}" "${5:-}"
  refused "$1" "$2" run s.json "${everything[@]}"
  refused "$1 (check)" "$2" check s.json
  refused "$1 (info)" "$2" info s.json
}
bad_text() {
  printf '%s\n' "$3" >s.json
  refused "$1" "$2" run s.json "${everything[@]}"
}
object() { printf '{"id": 1, "shape": %s, "position": %s%s}' "$1" "${2:-[0, 0]}" "${3:-}"; }

# Text and structure
bad_text "not JSON" "s.json" 'this is no scene'
bad_text "empty file" "s.json" ''
bad_text "cut in the middle" "s.json" '{"format": "gridcull.scene/1", "dimension": 2, "objects": [{"id": 1,'
bad_text "wrong format" "format" '{"format": "gridcull.frames/1", "dimension": 2, "objects": [], "viewers": []}'
bad_text "wrong version" "format" '{"format": "gridcull.scene/2", "dimension": 2, "objects": [], "viewers": []}'
bad_text "no format" "format" '{"dimension": 2, "objects": [], "viewers": []}'
bad_text "an array" "s.json" '[1, 2, 3]'
bad_text "dimension 4" "dimension" '{"format": "gridcull.scene/1", "dimension": 4, "objects": []}'
bad_scene "unknown key" "colour" '{"id": 1, "shape": {"type": "disc", "radius": 1}, "position": [0, 0], "colour": 3}'
bad_scene "unknown key at the top" "weather" "$box" "$eye" '"weather": "fine",'
bad_scene "missing key" "position" '{"id": 1, "shape": {"type": "disc", "radius": 1}}'
bad_scene "missing radius" "radius" "$(object '{"type": "disc"}')"
bad_scene "unknown shape" "blob" "$(object '{"type": "blob", "radius": 1}')"
bad_scene "duplicate id" "id" "$box, $box"
bad_scene "duplicate viewer" "id" "$box" "$eye, $eye"
bad_scene "unknown id" "77" "$box" '{"id": 1, "follows": 77}'
bad_scene "negative id" "id" '{"id": -1, "shape": {"type": "disc", "radius": 1}, "position": [0, 0]}'
bad_scene "id too large" "id" '{"id": 4294967295, "shape": {"type": "disc", "radius": 1}, "position": [0, 0]}'
bad_scene "mesh" "mesh" "$(object '{"type": "mesh", "file": "a.obj"}')"

# Numbers
bad_scene "NaN" "s.json" "$(object '{"type": "disc", "radius": NaN}')"
bad_scene "infinite" "s.json" "$(object '{"type": "disc", "radius": Infinity}')"
bad_scene "1e999" "s.json" "$(object '{"type": "disc", "radius": 1}' '[1e999, 0]')"
bad_scene "1e300" "position" "$(object '{"type": "disc", "radius": 1}' '[1e300, 0]')"
bad_scene "1e300 as a radius" "radius" "$(object '{"type": "disc", "radius": 1e300}')"
bad_scene "negative radius" "radius" "$(object '{"type": "disc", "radius": -1}')"
bad_scene "zero size" "size" "$(object '{"type": "box", "size": [0, 2]}')"
bad_scene "polygon with two points" "three distinct points, found 2" "$(object '{"type": "polygon", "vertices": [[0, 0], [1, 1]]}')"
bad_scene "polygon of one repeated point" "vertices|polygon" "$(object '{"type": "polygon", "vertices": [[0, 0], [0, 0], [0, 0]]}')"
bad_scene "three coordinates in 2D" "position" "$(object '{"type": "disc", "radius": 1}' '[0, 0, 0]')"
bad_scene "a 3D shape in 2D" "sphere" "$(object '{"type": "sphere", "radius": 1}')"
bad_scene "negative speed" "max_speed" "$(object '{"type": "disc", "radius": 1}' '[0, 0]' ', "max_speed": -1')"
bad_scene "a range of 0" "range" "$box" '{"id": 1, "position": [0, 0], "range": 0}'
bad_scene "a field of view of 400 degrees" "fov" "$box" '{"id": 1, "position": [0, 0], "fov_degrees": 400}'
bad_scene "cell of 0" "cell" "$box" "$eye" '"grid": {"cell": 0},'
bad_scene "bounds upside down" "bounds" "$box" "$eye" '"bounds": {"min": [10, 0], "max": [0, 10]},'
for aspect in 9e-7 1000001 1e300; do
  bad_text "aspect $aspect" "s.json: /viewers/0/frustum/aspect: expected" '{"format": "gridcull.scene/1", "dimension": 3,
    "objects": [], "viewers": [{"id": 1, "position": [0, 0, 0], "frustum": {"fov_y_degrees": 60, "aspect": '"$aspect"'}}]}'
done
bad_text "quaternion of length 0" "orientation" '{"format": "gridcull.scene/1", "dimension": 3, "objects": [{"id": 1,
  "shape": {"type": "box", "size": [1, 1, 1]}, "position": [0, 0, 0], "orientation": [0, 0, 0, 0]}], "viewers": []}'

# A grid that needs too much memory: the line says what cell size would fit, and that one does.
scene s.json "$box" "$eye" '"bounds": {"min": [0, 0], "max": [100000, 100000]}, "grid": {"cell": 0.01},'
refused "too large a grid" "would fit" run s.json "${everything[@]}"
for method in $("$program" methods | sed -n 's/^\([a-z-]*\).*:.*/\1/p'); do
  refused "too large a grid for $method" "would fit" run s.json --method "$method" "${everything[@]}"
done
scene s.json "$box" "$eye" '"bounds": {"min": [0, 0], "max": [1000, 1000]}, "grid": {"cell": 1},'
refused "--max-memory" "would fit" run s.json --max-memory 100000 "${everything[@]}"
fits=$(sed -n 's/.*a cell of \([0-9.e+-]*\) m would fit.*/\1/p' stderr.txt)
good "a cell of $fits fits" info s.json --cell "$fits" --max-memory 100000

# So do masks and maps, which are held against it before any of them is made.
printf '%s\n' '{"format": "gridcull.scene/1", "dimension": 3, "bounds": {"min": [0, 0, 0], "max": [20, 20, 20]},
  "grid": {"cell": 2}, "objects": [{"id": 1, "static": true, "shape": {"type": "box", "size": [4, 2, 3]},
  "position": [9, 9, 9]}], "viewers": [{"id": 1, "position": [3, 3, 3]}]}' >solid.json
too_large() { refused "too large: $1" "$2, more than the [0-9]+ allowed$3" "${@:4}"; }
too_large "a cube of masks" "resolution: 8192 pixels .* need [0-9]+ bytes" "; 4096 would fit" \
  run solid.json --resolution 8192 --max-memory 40000000 "${everything[@]}"
too_large "masks of many threads" "a mask .* \(256\) need [0-9]+ bytes" "; 4096 would fit" \
  run solid.json --resolution 8192 --threads 256 "${everything[@]}"
too_large "masks (check)" "resolution: 8192 .* bytes" "" check solid.json --resolution 8192 --max-memory 40000000
good "a cube of masks that fits" run solid.json --resolution 4096 --max-memory 40000000
too_large "maps of cells" "the maps of three cells, .* need [0-9]+ bytes" "; 2048 would fit" \
  run solid.json --method extended-projections --resolution 8192 "${everything[@]}"
too_large "maps to bake with" "--map: maps of 4096 pixels .* need [0-9]+ bytes" "" \
  bake --method extended-projections solid.json --map 4096 --planes 16 --out out/x
too_large "sets to bake" "--cells: 1048576 cells with 1048576 motion boxes may take [0-9]+ bytes" "" \
  bake --method five-d-tree solid.json --cells 1048576 --boxes 1048576 --out out/x
good "a file to read" bake --method five-d-tree solid.json --cells 8 --boxes 8 --out small.baked
too_large "a baked file" "small.baked: [0-9]+ bytes" "" \
  run solid.json --method five-d-tree --cell 20 --baked small.baked --max-memory 200
if "$program" check solid.json --method depth-rays >stdout.txt 2>&1; then  # built with Embree
  too_large "pictures" "resolution: the six pictures .* need [0-9]+ bytes" "" \
    run solid.json --method depth-rays --resolution 8192x8192 --max-memory 1000000000 "${everything[@]}"
fi

# Frames
scene s.json "$box" "$eye"
bad_frames() {
  printf '{"format": "gridcull.frames/1"}\n%s\n' "$3" >f.jsonl
  refused "$1" "$2" run s.json --frames f.jsonl "${everything[@]}"
}
bad_frames "time goes back" "f.jsonl:3" $'{"time": 1}\n{"time": 0.5}'
bad_frames "time stands still" "f.jsonl:3" $'{"time": 1}\n{"time": 1}'
bad_frames "no time" "time" '{"set": []}'
bad_frames "unknown object" "9" '{"time": 1, "set": [{"id": 9, "position": [0, 0]}]}'
bad_frames "unknown object removed" "9" '{"time": 1, "remove": [9]}'
bad_frames "an id that is there already" "1" "{\"time\": 1, \"add\": [$box]}"
bad_frames "an id twice" "1" '{"time": 1, "set": [{"id": 1, "position": [0, 0]}, {"id": 1, "heading": 0}]}'
bad_frames "unknown viewer dropped" "9" '{"time": 1, "drop_viewers": [9]}'
bad_frames "unknown key in a frame" "wind" '{"time": 1, "wind": 3}'
bad_frames "a frame that is no JSON" "f.jsonl" 'frame'
bad_frames "a late fault" "f.jsonl:4" $'{"time": 1}\n{"time": 2}\n{"time": "three"}'
printf '%s\n' '{"format": "gridcull.scene/1", "dimension": 3, "objects": [], "viewers": []}' >s.json
bad_frames "too flat a frustum" "f.jsonl:3: /viewers/0/frustum/aspect" '{"time": 1}
{"time": 2, "viewers": [{"id": 1, "position": [0, 0, 0], "frustum": {"fov_y_degrees": 60, "aspect": 1e-7}}]}'
scene s.json "$box" "$eye"
printf '{"format": "gridcull.frames/7"}\n{"time": 1}\n' >f.jsonl
refused "wrong version of frames" "format" run s.json --frames f.jsonl "${everything[@]}"
printf '{"format": "gridcull.frames/1"}\n{"time": 1}\n' >f.jsonl
refused "no such frame to draw" "only 1 frame" run s.json --frames f.jsonl --out out/p.jsonl --picture 1:1:out/view.svg
refused "no such viewer to draw" "viewer 5 is not there in that frame, but 1$" run s.json --frames f.jsonl --out out/p.jsonl --picture 0:5:out/view.svg

# Files
refused "no such scene" "missing.json" run missing.json "${everything[@]}"
refused "no such frames" "missing.jsonl" run s.json --frames missing.jsonl "${everything[@]}"
refused "a folder as scene" "out" run out
gzip -c s.json >whole.json.gz
head -c 60 whole.json.gz >cut.json.gz
refused "truncated .gz" "cut.json.gz" run cut.json.gz "${everything[@]}"
cp whole.json.gz packed.json
refused "packed by another name" "packed.json: expected JSON, found gzip data" run packed.json "${everything[@]}"
cp s.json plain.json.gz
refused "a .gz that is none" "plain.json.gz" run plain.json.gz "${everything[@]}"
{ printf '{"format": "gridcull.frames/1"}\n'; for i in $(seq 2000); do printf '{"time": %s.%s}\n' "$i" "$RANDOM"; done; } |
  gzip -c >whole.jsonl.gz
head -c 4000 whole.jsonl.gz >cut.jsonl.gz
refused "truncated frames" "cut.jsonl.gz" run s.json --frames cut.jsonl.gz "${everything[@]}"
refused "output in no folder" "nowhere" run s.json --out nowhere/pvs.jsonl
refused "output is a folder" "out" run s.json --out out
refused "stats in no folder" "nowhere" run s.json --out out/pvs.jsonl --stats nowhere/stats.json
refused "picture in no folder" "nowhere" run s.json --out out/pvs.jsonl --picture 0:1:nowhere/view.svg
refused "made below a file" "s.json" make town --out s.json/town
# An endless file: its name, not only that memory is out. (The sanitizers need more room than is given here.)
if [ -z "${GRIDCULL_SANITIZE:-}" ]; then
  checks=$((checks + 1))
  (ulimit -v 1500000 && exec "$program" info /dev/zero >/dev/null 2>stderr.txt)
  [ $? -eq 2 ] && grep -q "^gridcull: /dev/zero: more than fits into memory" stderr.txt ||
    fail "an endless file: $(cat stderr.txt)"
fi

if [ -e /dev/full ]; then
  checks=$((checks + 1))
  "$program" run s.json --out - >/dev/full 2>stderr.txt
  [ $? -eq 2 ] && [ "$(wc -l <stderr.txt)" -eq 1 ] || fail "a full device: $(cat stderr.txt)"
  for command in "--version" "run --help"; do
    # shellcheck disable=SC2086
    "$program" $command >/dev/full 2>stderr.txt
    [ $? -eq 2 ] && [ "$(wc -l <stderr.txt)" -eq 1 ] || fail "$command on a full device: $(cat stderr.txt)"
  done
  "$program" run s.json >/dev/full 2>stderr.txt
  [ $? -eq 2 ] && [ "$(wc -l <stderr.txt)" -eq 1 ] || fail "a table on a full device: $(cat stderr.txt)"
fi

# Imports
cat >fcd.xml <<'XML'
<fcd-export>
  <timestep time="0.00"><vehicle id="a" x="1" y="2" angle="90" speed="1"/></timestep>
  <timestep time="0.10"><vehicle id="a" x="1.1" y="2" angle="90" speed="1"/></timestep>
</fcd-export>
XML
for size in 0 5 150 $(($(stat -c %s fcd.xml) - 5)); do
  head -c "$size" fcd.xml >cut.xml
  refused "FCD cut behind byte $size" "cut.xml:[0-9]+: .*cut short" import sumo --fcd cut.xml --out out/town
done
gzip -c fcd.xml | head -c 60 >cut.xml.gz
refused "FCD .gz cut in the middle" "cut.xml.gz" import sumo --fcd cut.xml.gz --out out/town
refused "no FCD" "missing.xml" import sumo --fcd missing.xml --out out/town
refused "no buildings" "missing.xml" import sumo --fcd fcd.xml --buildings missing.xml --out out/town
scene flat.json ""
refused "a 2D scene beside a height" "--static: expected a 3D scene" import sumo --fcd fcd.xml --static flat.json --height 3 --out out/town
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >one.obj
refused "no mesh" "missing.obj: cannot be read as a mesh" import mesh missing.obj --out out/m
refused "a mesh of text" "fcd.xml: cannot be read as a mesh" import mesh fcd.xml --out out/m
refused "a mesh in no way split" "--split: expected parts, groups or whole, found 'faces'" import mesh one.obj --split faces --out out/m
refused "a mesh turned by nothing" "--orientation: expected a quaternion" import mesh one.obj --orientation 0,0,0,0 --out out/m
refused "a mesh moved in the plane" "--move: expected three numbers" import mesh one.obj --move 1,2 --out out/m
refused "a mesh above the limit" "of --max-memory" import mesh one.obj --max-memory 16 --out out/m
scene3='{"format": "gridcull.scene/1", "dimension": 3, "objects": [{"id": 0, "static": true, "shape": %s, "position": [0, 0, 0]}], "viewers": []}'
printf "$scene3" '{"type": "mesh", "file": ""}' >unnamed.json
refused "a scene whose mesh has no name" "/objects/0/shape/file: expected a file name, found \"\"$" info unnamed.json
printf "$scene3" '{"type": "mesh", "file": "missing.obj"}' >mesh.json
refused "a scene whose mesh is missing" "mesh.json: /objects/0/shape/file: " info mesh.json
printf "$scene3" '{"type": "mesh", "file": "one.obj", "group": "roof"}' >mesh.json
refused "a scene whose mesh lacks the group" "expected one of its groups .*found 'roof'" info mesh.json
# The same lines where OpenVDB is not built in, but for what the file is.
refused "no volume" "(missing.vdb: there is no such file|OpenVDB)" import volume missing.vdb --inside-below 0 --out out/v
refused "a volume of text" "(fcd.xml: cannot be read as a .vdb file|OpenVDB)" import volume fcd.xml --inside-below 0 --out out/v
refused "a volume without a value" "found neither" import volume fcd.xml --out out/v
refused "a volume of two values" "found both" import volume fcd.xml --inside-below 0 --inside-above 1 --out out/v
refused "a volume's value in words" "--inside-below" import volume fcd.xml --inside-below sea --out out/v
printf "$scene3" '{"type": "volume", "file": "missing.vdb", "inside_below": 0}' >volume.json
refused "a scene whose volume is missing" "volume.json: /objects/0/shape/file: " info volume.json
printf "$scene3" '{"type": "volume", "file": "missing.vdb"}' >volume.json
refused "a scene whose volume has no value" "volume.json: /objects/0/shape: expected either" info volume.json
refused "a box of three" "box" import sumo --fcd fcd.xml --box 0,0,1 --out out/town
refused "a viewer that never comes" "nobody" import sumo --fcd fcd.xml --viewers nobody --out out/town
: >empty.txt
printf '# framerate: 25 fps\n# id frame x/m y/m z/m\n1 0 0.5\n' >tracks.txt
refused "no tracks at all" "^gridcull: empty.txt: expected .*an empty file$" import petrack --trajectories empty.txt --out out/p
refused "a track cut in the middle" "tracks.txt" import petrack --trajectories tracks.txt --out out/p

# Usage
refused "no command" "command" --
refused "unknown command" "fly" fly
refused "unknown option" "^gridcull: --wings 5 --tail: not expected \(see gridcull run --help\)$" run s.json --wings 5 --tail
refused "one file too many" "^gridcull: t.json: not expected \(see gridcull run --help\)$" run s.json t.json
refused "an option without its value" "--threads.*\(see gridcull run --help\)$" run s.json --threads
refused "an option twice" "--tbv.*\(see gridcull run --help\)$" run s.json --tbv off --tbv off
refused "an option of an import that is none" "--fcds x: not expected \(see gridcull import sumo --help\)$" \
  import sumo --fcd fcd.xml --out out/t --fcds x
refused "no scene" "SCENE" run
refused "unknown method" "voxel" run s.json --method magic "${everything[@]}"
refused "unknown bounds" "box, sphere, obb, 14-dop" run s.json --bounds 16-dop "${everything[@]}"
refused "unknown bounds (check)" "bounds" check s.json --bounds BOX
refused "bounds for a method that tests none" "voxel tests no bounds" run s.json --method voxel --bounds box "${everything[@]}"
refused "bounds for silhouettes in 2D" "2D" run s.json --bounds box "${everything[@]}"
refused "cell 0" "cell" run s.json --cell 0 "${everything[@]}"
refused "cell nan" "cell" run s.json --cell nan "${everything[@]}"
refused "cell inf" "cell" run s.json --cell inf "${everything[@]}"
refused "cell -1" "cell" run s.json --cell -1 "${everything[@]}"
refused "cell word" "cell" run s.json --cell wide "${everything[@]}"
refused "0 threads" "threads" run s.json --threads 0 "${everything[@]}"
refused "257 threads" "threads" run s.json --threads 257 "${everything[@]}"
refused "unknown kind of TBV" "tbv" run s.json --tbv square "${everything[@]}"
refused "unknown kind of TBV, frustum" "tbv" run s.json --method frustum --tbv square "${everything[@]}"
for bad in 0 -3 65 many 8.5 ""; do
  refused "occluders '$bad'" "occluders" run s.json --method shadow-frusta --occluders "$bad" "${everything[@]}"
done
refused "ranked by nothing known" "--criteria: expected some of area-angle, sampled and recent, found size" \
  run s.json --method shadow-frusta --criteria size "${everything[@]}"
refused "ranked twice by one" "--criteria" run s.json --method shadow-frusta --criteria recent,recent "${everything[@]}"
refused "unions of a kind" "--unions: expected on or off, found some" \
  run s.json --method shadow-frusta --unions some "${everything[@]}"
refused "an overlap of a kind" "--overlap: expected planes or exact" \
  run s.json --method shadow-frusta --overlap nearly "${everything[@]}"
refused "another method's option" "--unions: no option of voxel" run s.json --method voxel --unions off "${everything[@]}"
refused "another method's resolution" "--resolution: no option of voxel" \
  run s.json --method voxel --resolution 64 "${everything[@]}"
refused "another method's picture" "--resolution: no option of frustum" \
  run s.json --method frustum --resolution 64x64 "${everything[@]}"
refused "another method's occluders" "--occluders: no option of silhouette" run s.json --occluders 4 "${everything[@]}"
refused "another method's box" "--view-box: no option of silhouette" run s.json --view-box 4 "${everything[@]}"
refused "another scene's blocks" "--blocks: no option of town" make town --blocks 3 --out out/t
refused "no rays" "rays" check s.json --rays 0
refused "picture without a file" "picture" run s.json --picture 1:2
refused "unknown scene to make" "volcano" make volcano --out out/v
refused "make nowhere" "out" make town
refused "make with a negative count" "count" make town --out out/t --count -5
refused "make with a cell of 0" "cell" make town --out out/t --cell 0
refused "baked for a method that does not bake" "reads no baked file" run s.json --baked x --method voxel "${everything[@]}"
refused "bake without a method" "one that bakes" bake s.json --out out/x
refused "bake with one that does not" "does not bake" bake s.json --method voxel --out out/x
: >kept.txt
refused "bake over the scene" "expected an output of its own" bake s.json --method five-d-tree --out s.json
refused "bake with 0 threads" "--threads: expected 1 .. 256, found 0$" bake s.json --method five-d-tree --out out/x --threads 0
refused "answers over the baked file" "expected an output of its own" run s.json --method five-d-tree --baked kept.txt --out kept.txt
refused "bake static" "expected static objects" bake static s.json --out out/x.vdb

# Values: what was expected and found, by the option as typed.
for value in x 1.5 -3 "" 1e2; do
  refused "threads '$value'" "--threads: expected 1 .. 256, found ${value:-nothing}$" run s.json --threads "$value"
done
for value in 1e10 inf -1 abc 2m ""; do
  refused "cell '$value'" "--cell: expected metres above 0 and at most 1e9, found ${value:-nothing}$" run s.json --cell "$value"
  refused "cell '$value' to make" "--cell: expected metres .*, found ${value:-nothing}$" make town --out out/t --cell "$value"
  refused "range '$value' to make" "--range: expected metres .*, found ${value:-nothing}$" make town --out out/t --range "$value"
  refused "range '$value' to import" "--range: expected metres .*, found ${value:-nothing}$" \
    import sumo --fcd fcd.xml --out out/t --range "$value"
done
for value in -1 0 4GiB 4e9 99999999999999999999; do
  refused "max-memory $value" "--max-memory: expected a whole number of bytes, 1 or more, found $value$" run s.json --max-memory "$value"
  refused "max-memory $value to bench" "--max-memory: .*found $value$" bench --scenes discs:5 --max-memory "$value"
done
for value in -1 0 x; do
  refused "every ${value}th" "--every: expected a whole number, 1 or more, found $value$" check s.json --every "$value"
  refused "every ${value}th of an import" "--every: .*found $value$" import sumo --fcd fcd.xml --out out/t --every "$value"
done
refused "a negative seed" "--seed: expected a whole number .*found -1$" make town --out out/t --seed -1
refused "too many corridors" "--count: expected 1 .. 2000 .*found 2001$" make maze --out out/t --count 2001
refused "no blocks" "--blocks: expected 1 .. 2000, found 0$" make city --out out/t --blocks 0
refused "no frames to make" "--frames: expected .*found 0$" make town --out out/t --frames 0
refused "a radius of -1" "--radius: expected metres .*found -1$" import petrack --trajectories tracks.txt --out out/p --radius -1
refused "too wide a view" "--fov-degrees: expected degrees .*found 400$" \
  import petrack --trajectories tracks.txt --out out/p --fov-degrees 400
refused "a box of words" "--box: expected four numbers .*found 0,0,x,1$" import sumo --fcd fcd.xml --box 0,0,x,1 --out out/t
refused "a box inside out" "--box: expected x0,y0,x1,y1 .*found 5,0,1,9$" import sumo --fcd fcd.xml --box 5,0,1,9 --out out/t
refused "a flat vehicle" "--vehicle-size: width: .*found 0$" import sumo --fcd fcd.xml --vehicle-size 5,0 --out out/t
refused "an empty choice of viewers" "--viewers: expected .*found" import sumo --fcd fcd.xml --viewers , --out out/t
refused "a viewer that never comes, by option" "--viewers: expected ids" import sumo --fcd fcd.xml --viewers nobody --out out/t
for value in 7 0 9000; do
  refused "resolution $value" "expected R of 8 .. 8192 pixels, or WxH of 1 .. 8192 rays each, found $value$" \
    run s.json --resolution "$value"
done
for option in --out --stats --frames --method --tbv --resolution; do
  refused "an empty $option" "$option: expected .*found nothing$" run s.json "$option" ""
done
refused "an empty name of a scene" "SCENE: expected a file name, found nothing" run ""
refused "an empty folder to make" "--out: expected a folder, found nothing" make town --out ""
refused "an empty folder to import" "--out: expected a folder" import sumo --fcd fcd.xml --out ""
refused "no name of buildings" "--buildings: expected a file name" import sumo --fcd fcd.xml --buildings "" --out out/t
refused "a picture of a frame too late" "there is only 1 frame, counted from 0" run s.json --picture 5:1:out/view.svg

# Cells that no grid can have: by option, or by file and pointer.
for value in 1e-300 5e-324; do
  refused "cell $value" "--cell: expected at least 1e-12 of the bounds" run s.json --cell "$value"
  refused "cell $value to make" "--cell: " make discs --out out/t --cell "$value"
  scene tiny.json "$box" "$eye" "\"grid\": {\"cell\": $value},"
  refused "cell $value in a scene" "tiny.json: /grid/cell: expected at least" run tiny.json "${everything[@]}"
done
refused "a fine cell to make" "--cell: cells of 0.001 m need .*would fit" make discs --out out/t --cell 0.001
refused "a fine cell to run" "--cell: cells of .*would fit" run s.json --cell 1e-5
scene fine.json "$box" "$eye" '"grid": {"cell": 1e-5},'
refused "a fine cell in a scene" "fine.json: /grid/cell: cells of .*would fit" run fine.json "${everything[@]}"

# Each output its own file, and none that is read.
cp s.json kept.json
cp f.jsonl kept.jsonl
ln -s s.json link.json
apart() { refused "$1" "expected an output of its own" run s.json --frames f.jsonl "${@:2}"; }
apart "answers and statistics" --out out/x --stats out/x
apart "two spellings" --out out/o.jsonl --stats ./out/../out/o.jsonl
apart "answers and picture" --out out/o --picture 0:1:out/o
apart "statistics and picture" --stats out/o --picture "0:1:$work/out/o"
apart "two pictures" --picture 0:1:out/a.svg --picture 0:1:out/a.svg
apart "standard output for answers and statistics" --out - --stats -
apart "standard output for answers and picture" --out - --picture 0:1:-
apart "standard output for statistics and picture" --stats - --picture 0:1:-
apart "standard output by two names" --out - --stats /dev/stdout
apart "answers over the scene" --out s.json
apart "answers over the scene, by a link" --out link.json
apart "statistics over the frames" --stats ./f.jsonl
apart "a picture over the scene" --picture 0:1:s.json
mkdir town
cp fcd.xml town/frames.jsonl
refused "an import over its source" "expected an output of its own" import sumo --fcd town/frames.jsonl --out town
same "the import's source is as it was" town/frames.jsonl fcd.xml
ln -s target.jsonl dangling.jsonl
apart "a link and what it names" --out dangling.jsonl --stats target.jsonl
same "the scene is as it was" s.json kept.json
same "the frames are as they were" f.jsonl kept.jsonl
good "/dev/null as often as one likes" run s.json --out /dev/null --stats /dev/null --picture 0:1:/dev/null
refused "standard input twice" "read once" run - --frames -
refused "standard input twice, by two names" "read once" run - --frames /dev/stdin
ln -s nowhere/x.jsonl astray.jsonl
refused "a link into no folder" "astray.jsonl: cannot be written" run s.json --out astray.jsonl

finish
