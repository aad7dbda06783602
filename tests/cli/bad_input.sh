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
printf '{"format": "gridcull.frames/7"}\n{"time": 1}\n' >f.jsonl
refused "wrong version of frames" "format" run s.json --frames f.jsonl "${everything[@]}"
printf '{"format": "gridcull.frames/1"}\n{"time": 1}\n' >f.jsonl
refused "no such frame to draw" "only 1 frame" run s.json --frames f.jsonl --out out/p.jsonl --picture 1:1:out/view.svg
refused "no such viewer to draw" "viewer 5" run s.json --frames f.jsonl --out out/p.jsonl --picture 0:5:out/view.svg

# Files
refused "no such scene" "missing.json" run missing.json "${everything[@]}"
refused "no such frames" "missing.jsonl" run s.json --frames missing.jsonl "${everything[@]}"
refused "a folder as scene" "out" run out
gzip -c s.json >whole.json.gz
head -c 60 whole.json.gz >cut.json.gz
refused "truncated .gz" "cut.json.gz" run cut.json.gz "${everything[@]}"
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
if [ -e /dev/full ]; then
  checks=$((checks + 1))
  "$program" run s.json --out - >/dev/full 2>stderr.txt
  [ $? -eq 2 ] && [ "$(wc -l <stderr.txt)" -eq 1 ] || fail "a full device: $(cat stderr.txt)"
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
head -c 150 fcd.xml >cut.xml
refused "FCD cut in the middle" "cut.xml" import sumo --fcd cut.xml --out out/town
gzip -c fcd.xml | head -c 60 >cut.xml.gz
refused "FCD .gz cut in the middle" "cut.xml.gz" import sumo --fcd cut.xml.gz --out out/town
refused "no FCD" "missing.xml" import sumo --fcd missing.xml --out out/town
refused "no buildings" "missing.xml" import sumo --fcd fcd.xml --buildings missing.xml --out out/town
refused "a box of three" "box" import sumo --fcd fcd.xml --box 0,0,1 --out out/town
refused "a viewer that never comes" "nobody" import sumo --fcd fcd.xml --viewers nobody --out out/town
printf '# framerate: 25 fps\n# id frame x/m y/m z/m\n1 0 0.5\n' >tracks.txt
refused "a track cut in the middle" "tracks.txt" import petrack --trajectories tracks.txt --out out/p

# Usage
refused "no command" "command" --
refused "unknown command" "fly" fly
refused "unknown option" "wings" run s.json --wings
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
refused "every 0th" "every" check s.json --every 0
refused "no rays" "rays" check s.json --rays 0
refused "picture without a file" "picture" run s.json --picture 1:2
refused "picture twice" "twice" run s.json --picture 0:1:out/a.svg --picture 0:1:out/a.svg
refused "unknown scene to make" "volcano" make volcano --out out/v
refused "make nowhere" "out" make town
refused "make with a negative count" "count" make town --out out/t --count -5
refused "make with a cell of 0" "cell" make town --out out/t --cell 0
refused "baked for a method that does not bake" "reads no baked file" run s.json --baked x --method voxel "${everything[@]}"
refused "standard input twice" "standard input" run - --frames -

finish
