#!/usr/bin/env bash
# A crowd in an office building: 1,000 people steered by DetourCrowd, each of whom looks ahead with 170 degrees; after
# every step gridcull says whom each may see. Installs what is missing, builds, runs 30 s of it and holds the answers
# against the exact reference.
#   examples/crowd/run.sh [--service] [--small] [--out FOLDER] [OPTION OF in_the_building...]
# --service: gridcull answers in a server of its own (which audits itself) instead of in the crowd's process.
# --small: 100 people, three seconds. in_the_building --help tells the rest.
# Without root it names missing packages and stops (status 2).
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../live/example.sh"
example_arguments crowd "$@"
[ -z "$small" ] || options+=(--people 100 --viewers 100 --corridors 2 --rooms 5 --seconds 3)

# shellcheck disable=SC2086  # lists are meant to be split
need $packages_program $packages_crowd
build_example examples/crowd in_the_building
run_example "people walk, gridcull says whom each may see"
