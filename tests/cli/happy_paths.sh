#!/usr/bin/env bash
# Small worlds from end to end: made, imported, replayed, checked; packed files and standard input and output.
source "$(dirname "$0")/library.sh"

# json KEY FILE: a number or string of a flat key, first occurrence.
json() { sed -n "s/.*\"$1\": *\"\{0,1\}\([^,\"}]*\).*/\1/p" "$2" | head -n 1; }

good "help" --help
good "version" --version
is "version" "$(cat stdout.txt)" "gridcull 0.1.0"
for command in run check info make import "import sumo" "import petrack" methods bake; do
  # shellcheck disable=SC2086
  good "$command --help" $command --help
  grep -q "^  gridcull ${command%% *}" stdout.txt || fail "$command --help holds no example"
done
# What --help gives as an example works in an empty folder (but for what takes long or needs files).
ln -s "$program" gridcull
for command in run check explain make methods; do
  mkdir example
  "$program" "$command" --help | sed -n 's/^  \(gridcull .*\)/\1/p' >example.txt
  while read -r line; do
    checks=$((checks + 1))
    (cd example && PATH=$work:$PATH && eval "$line") >stdout.txt 2>stderr.txt </dev/null || fail "$line: $(cat stderr.txt)"
  done <example.txt
  rm -rf example
done
good "methods" methods
grep -q "^voxel.*Batagelo" stdout.txt || fail "methods does not name voxel and its source"

# A town: table, answers, statistics, picture.
good "make town" make town --out town --count 25 --viewers 3 --range 60 --frames 12 --seed 7
good "run" run town/scene.json --frames town/frames.jsonl
hash=$(sed -n 's/^pvs_hash *//p' stdout.txt)
grep -q "^frames *12 in" stdout.txt || fail "run: no table: $(cat stdout.txt)"
is "length of the hash" "${#hash}" 16
viewer=$(sed -n 's/.*"id": \([0-9]*\), "follows".*/\1/p' town/scene.json | head -n 1)
good "run with outputs" run town/scene.json --frames town/frames.jsonl --out out/pvs.jsonl --stats out/stats.json \
  --picture "5:$viewer:out/view.svg"
is "run with --out prints nothing" "$(cat stdout.txt)" ""
is "lines of answers" "$(wc -l <out/pvs.jsonl)" $((1 + 12 * 3))
is "frames in the statistics" "$(json frames out/stats.json)" 12
is "hash in the statistics" "$(json pvs_hash out/stats.json)" "$hash"
grep -q 'class="region" d="M' out/view.svg || fail "the picture shows nothing of what the viewer sees"
grep -q 'class="met" d="M' out/view.svg || fail "the picture shows no cells"
grep -q '</svg>' out/view.svg || fail "the picture is not whole"
other=$(sed -n 's/.*"id": \([0-9]*\), "follows".*/\1/p' town/scene.json | sed -n 2p)
good "two pictures of one frame" run town/scene.json --frames town/frames.jsonl --threads 2 \
  --picture "5:$viewer:one.svg" --picture "5:$other:other.svg"
same "a picture beside another" one.svg out/view.svg
good "the other picture alone" run town/scene.json --frames town/frames.jsonl --picture "5:$other:alone.svg"
same "the other picture" other.svg alone.svg
good "picture of voxels" run town/scene.json --frames town/frames.jsonl --method voxel --picture "5:$viewer:voxel.svg"
grep -q 'class="opaque" d="M' voxel.svg || fail "the picture shows no opaque cells"
is "files written" "$(ls out | tr '\n' ' ')" "pvs.jsonl stats.json view.svg "

# The same answers however they are asked for.
for way in "--threads 4" "--pull" "--tbv off" "--tbv hollow"; do
  # shellcheck disable=SC2086
  good "run $way" run town/scene.json --frames town/frames.jsonl --stats - $way
  [ "$way" = "--tbv off" ] || [ "$way" = "--tbv hollow" ] || is "hash with $way" "$(json pvs_hash stdout.txt)" "$hash"
done
gzip -k town/scene.json town/frames.jsonl
good "packed" run town/scene.json.gz --frames town/frames.jsonl.gz --out out/pvs.jsonl.gz
gzip -dc out/pvs.jsonl.gz | tail -n +2 >unpacked.jsonl
tail -n +2 out/pvs.jsonl >plain.jsonl
same "packed and plain answers" unpacked.jsonl plain.jsonl
checks=$((checks + 2))
"$program" run - --frames town/frames.jsonl --out - <town/scene.json | tail -n +2 >piped.jsonl || fail "scene from a pipe"
same "scene from a pipe" piped.jsonl plain.jsonl
"$program" run town/scene.json --frames - --out - <town/frames.jsonl | tail -n +2 >piped.jsonl || fail "frames from a pipe"
same "frames from a pipe" piped.jsonl plain.jsonl
# A pipe has no name of its own that could be read twice: bounds and cell are then derived from the scene alone.
sed 's/"bounds": {[^}]*}, *//; s/"grid": {[^}]*}, *//' town/scene.json >derived.json
for pipe in - /dev/stdin; do
  checks=$((checks + 3))
  "$program" run derived.json --frames "$pipe" --out - < <(cat town/frames.jsonl) | tail -n +2 >piped.jsonl ||
    fail "derived bounds, frames from $pipe"
  "$program" info derived.json --frames "$pipe" < <(cat town/frames.jsonl) >info.txt || fail "info, frames from $pipe"
  "$program" check derived.json --frames "$pipe" --json < <(cat town/frames.jsonl) >check.txt || fail "check, frames from $pipe"
  is "answers with frames from $pipe" "$(wc -l <piped.jsonl)" $((12 * 3))
  is "frames judged from $pipe" "$(json judged_frames check.txt)" 12
done

# Links are followed, to what is not there yet too; a scene's name may be any bytes.
ln -s later.jsonl link.jsonl
good "to a link" run town/scene.json --out link.jsonl
[ -L link.jsonl ] && [ -s later.jsonl ] || fail "a link was replaced by a file"
odd=$'town/\xff.json'
cp town/scene.json "$odd"
good "a name that is no UTF-8" run "$odd" --out odd.jsonl --picture "0:$viewer:odd.svg"
checks=$((checks + 1))
iconv -f UTF-8 -t UTF-8 odd.svg >/dev/null || fail "the picture is no UTF-8"
iconv -f UTF-8 -t UTF-8 odd.jsonl >/dev/null || fail "the answers are no UTF-8"

# Checks.
good "bounds" run town/scene.json --frames town/frames.jsonl --method frustum --bounds 26-dop
for method in voxel frustum; do
  good "check $method" check town/scene.json --frames town/frames.jsonl --every 4 --method "$method" --json
  is "judged frames" "$(json judged_frames stdout.txt)" 3
  is "misses of $method" "$(json misses stdout.txt)" 0
done
good "check as text" check town/scene.json --frames town/frames.jsonl --every 4
grep -q "^misses *0$" stdout.txt || fail "check: $(cat stdout.txt)"

# Every generated scene runs and is right.
for made in "spheres --count 200" "city --blocks 2 --count 20 --viewers 2" "discs --count 40" "town --count 16 --viewers 2" \
  "maze --count 8 --viewers 2"; do
  # shellcheck disable=SC2086
  good "make $made" make $made --out made --frames 4
  good "info $made" info made/scene.json --frames made/frames.jsonl
  grep -q "^memory " stdout.txt || fail "info $made tells no memory"
  good "check $made" check made/scene.json --frames made/frames.jsonl --every 2 --rays 64 --json
  is "misses in $made" "$(json misses stdout.txt)" 0
  rm -rf made
done
# The same seed makes the same files, another one others.
good "make again" make town --out again --count 25 --viewers 3 --range 60 --frames 12 --seed 7
same "the same seed" again/frames.jsonl town/frames.jsonl
good "make another" make town --out another --count 25 --viewers 3 --range 60 --frames 12 --seed 8
cmp -s another/frames.jsonl town/frames.jsonl && fail "another seed gives the same frames"

# A scene that names neither bounds nor grid, and one that is empty.
scene s.json '{"id": 1, "shape": {"type": "box", "size": [8, 8]}, "position": [0, 0]},
  {"id": 2, "shape": {"type": "disc", "radius": 0.5}, "position": [20, 0]}' '{"id": 1, "position": [-20, 0]}'
good "info without a grid" info s.json
grep -q "quarter of the median smaller side" stdout.txt || fail "info does not say why: $(cat stdout.txt)"
good "hidden" run s.json --out -
is "behind the box" "$(tail -n 1 stdout.txt)" '{"frame": 0, "time": 0, "viewer": 1, "visible": [1]}'
scene empty.json '' '{"id": 4, "position": [0, 0]}'
good "an empty scene" run empty.json --out -
is "an empty answer" "$(tail -n 1 stdout.txt)" '{"frame": 0, "time": 0, "viewer": 4, "visible": []}'
good "an empty scene checked" check empty.json
good "an empty scene, info" info empty.json
scene nobody.json '' ''
good "nobody looks" run nobody.json

# Imports.
cat >fcd.xml <<'XML'
<fcd-export>
  <timestep time="0.00"><vehicle id="a" x="10" y="2" angle="90" speed="1"/></timestep>
  <timestep time="0.10"><vehicle id="a" x="10.1" y="2" angle="90" speed="1"/><person id="p" x="3" y="4" angle="0"/></timestep>
</fcd-export>
XML
cat >houses.xml <<'XML'
<additional><poly id="h" type="building.house" shape="20,0 30,0 30,10 20,10"/></additional>
XML
good "import sumo" import sumo --fcd fcd.xml --buildings houses.xml --out sumo --viewers all --range 50
good "run what was imported" run sumo/scene.json --frames sumo/frames.jsonl --out -
is "the vehicle sees the house and then the person" "$(tail -n +2 stdout.txt | tr '\n' ' ')" \
  '{"frame": 0, "time": 0, "viewer": 1, "visible": [0]} {"frame": 1, "time": 0.1, "viewer": 1, "visible": [0, 2]} '
printf '# framerate: 25 fps\n# id frame x/m y/m z/m\n1 0 0 0 1.7\n1 1 0.1 0 1.7\n2 0 3 0 1.7\n2 1 2.9 0 1.7\n' >tracks.txt
good "import petrack" import petrack --trajectories tracks.txt --out tracks
good "check what was imported" check tracks/scene.json --frames tracks/frames.jsonl

finish
