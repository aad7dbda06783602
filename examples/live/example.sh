# What the live examples' scripts share: their arguments, building against an installed gridcull, a server to ask, and
# holding what came out against the exact reference. Sourced by examples/*/run.sh.
caller=$PWD
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source examples/packages.sh

# example_arguments NAME ARGUMENT...: sets out, service, small and options (what the example's program is given).
example_arguments() {
  local name=$1
  shift
  out=out/$name service= small= options=()
  while [ $# -gt 0 ]; do
    case "$1" in
      --service) service=1; shift ;;
      --small) small=1; shift ;;
      --out) out=$(cd "$caller" && realpath -m "${2:?--out needs a folder}"); shift 2 ;;
      --help|-h) sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//p}' "examples/$name/run.sh"; exit 0 ;;
      *) options+=("$1"); shift ;;
    esac
  done
}

# build_gridcull: sets `gridcull` to the program and `prefix` to where it is installed. GRIDCULL_PREFIX names an installed
# one; without it one is built and installed into build/prefix.
build_gridcull() {
  local fresh=()
  prefix=${GRIDCULL_PREFIX:-}
  if [ -z "$prefix" ]; then
    echo "== building and installing gridcull to build/prefix"
    prefix=$PWD/build/prefix
    [ -e build/release/CMakeCache.txt ] || fresh=(-DBUILD_TESTING=OFF)
    need_page
    cmake --preset release "${fresh[@]}" >/dev/null
    cmake --build --preset release --target gridcull
    cmake --install build/release --prefix "$prefix" >/dev/null
  fi
  gridcull=$prefix/bin/gridcull
}

# build_example FOLDER NAME: the same, and sets `example` to the example's program, built against it.
# GRIDCULL_EXAMPLE_BUILD: where to build, build/examples.
build_example() {
  local binary=${GRIDCULL_EXAMPLE_BUILD:-build/examples}/$2
  build_gridcull
  echo "== building the example"
  cmake -S "$1" -B "$binary" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$prefix" >/dev/null
  cmake --build "$binary"
  example=$binary/$2
}

# run_example WHAT: the program with its options, by a server where --service was given; then the same frames from the
# files it left.
run_example() {
  mkdir -p "$out"
  [ -z "$service" ] || serve_example
  echo "== $1"
  "$example" --out "$out" "${options[@]}"
  [ -z "$service" ] || end_service
  echo "== the same frames from the files, held against the exact reference"
  "$gridcull" run "$out/scene.json" --frames "$out/frames.jsonl" --out "$out/again.jsonl" >/dev/null
  cmp "$out/again.jsonl" "$out/pvs.jsonl"
  echo "gridcull run gives the same answers, byte for byte"
  "$gridcull" check "$out/scene.json" --frames "$out/frames.jsonl" --every 10
}

# A server on any free port that holds every answer against the reference; sets `port`.
serve_example() {
  # A session of its own: Ctrl-C ends the example, which then ends the server.
  setsid "$gridcull" serve --port 0 --audit 1 >"$out/serve.log" &
  server=$!
  trap 'kill "$server" 2>/dev/null || true' EXIT
  for _ in $(seq 100); do
    grep -qs "^listening on" "$out/serve.log" && break
    sleep 0.05
  done
  port=$(sed -n '1s/.*:\([0-9]*\)$/\1/p' "$out/serve.log")
  echo "== gridcull serves: open http://127.0.0.1:$port to watch"
  options+=(--server "127.0.0.1:$port")
}

# Says what the server's audit found and ends it.
end_service() {
  echo
  python3 - "http://127.0.0.1:$port/metrics" <<'PY'
import sys, urllib.request
for line in urllib.request.urlopen(sys.argv[1]).read().decode().splitlines():
    if line.startswith("gridcull_audit"):
        print("{:<35}{}".format(*line.removeprefix("gridcull_").split()))
PY
  kill "$server"
  wait "$server" || true
  trap - EXIT
}
