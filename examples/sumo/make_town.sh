#!/usr/bin/env bash
# Makes a town for SUMO with its own tools: a grid of streets with pavements, buildings in every block, cars and
# pedestrians. run.sh runs it.
#   make_town.sh FOLDER STREETS CARS_A_SECOND PEOPLE_A_SECOND UNTIL
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
folder=$1 streets=$2 cars=$3 people=$4 until=$5
export SUMO_HOME=${SUMO_HOME:-/usr/share/sumo}
mkdir -p "$folder"
cd "$folder"

netgenerate --grid --grid.number "$streets" --grid.length 100 --default.lanenumber 1 --default-junction-type priority \
  --sidewalks.guess --crossings.guess --seed 1 --output-file net.xml >net.log 2>&1 || { cat net.log >&2; exit 1; }
python3 "$here/buildings.py" "$streets" 100 >buildings.poly.xml
trips() {  # trips NAME A_SECOND OPTION...
  local name=$1 period
  period=$(awk "BEGIN { print 1 / $2 }")
  shift 2
  python3 "$SUMO_HOME/tools/randomTrips.py" --net-file net.xml --output-trip-file "$name.xml" --end "$until" \
    --period "$period" --seed 1 --prefix "$name" "$@" >"$name.log" 2>&1 || { cat "$name.log" >&2; exit 1; }
}
trips car "$cars" --min-distance 300
trips walker "$people" --pedestrians --max-distance 400

cat >town.sumocfg <<'XML'
<configuration>
  <input>
    <net-file value="net.xml"/>
    <route-files value="car.xml,walker.xml"/>
    <additional-files value="buildings.poly.xml"/>
  </input>
  <processing><time-to-teleport value="120"/></processing>
</configuration>
XML
