#!/usr/bin/env bash
# A live SUMO simulation in which every step asks who is in line of sight of 40 equipped cars: installs what is missing,
# builds, makes a town (10 x 10 streets, 500 cars, pedestrians), runs a minute of it and holds the answers against the
# exact reference.
#   examples/sumo/run.sh [--service] [--small] [--out FOLDER] [OPTION OF in_sight...]
# --service: gridcull answers in a server of its own (which audits itself) instead of in the simulation's process.
# --small: 4 x 4 streets and ten seconds. --config /PATH/TO.sumocfg: a simulation of yours. in_sight --help tells the
# rest. Without root it names missing packages and stops (status 2).
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../live/example.sh"
example_arguments sumo "$@"

# shellcheck disable=SC2086  # lists are meant to be split
need $packages_program $packages_sumo
export SUMO_HOME=${SUMO_HOME:-/usr/share/sumo}
build_example examples/sumo in_sight

if [[ " ${options[*]} " != *" --config"* ]]; then
  echo "== a town"
  if [ -n "$small" ]; then
    examples/sumo/make_town.sh "$out/town" 4 2 1 60
    options=(--begin 20 --end 30 "${options[@]}")
  else
    examples/sumo/make_town.sh "$out/town" 10 5 2 200
    options=(--begin 120 --end 180 "${options[@]}")
  fi
  options+=(--config "$out/town/town.sumocfg")
fi
run_example "SUMO runs, gridcull says who is in line of sight"
