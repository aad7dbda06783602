# The Debian packages that gridcull needs, and two functions that see to them and to the viewer page's npm packages.
# Sourced by examples/demo.sh and tests/run.sh, in the repository's root.

packages_program="build-essential cmake ninja-build libglm-dev libtbb-dev nlohmann-json3-dev libcli11-dev
  libpugixml-dev zlib1g-dev libboost-dev libembree-dev
  libassimp-dev libopenvdb-dev prometheus-cpp-dev"
packages_sumo="sumo sumo-tools python3"
packages_crowd="librecast-dev python3"
packages_tests="$packages_program $packages_sumo $packages_crowd git doctest-dev libcgal-dev gnuplot-nox
  python3-websockets python3-cbor2 python3-numpy"
packages_page="nodejs npm chromium"

# need PACKAGE...: installs what is missing as root; otherwise names it in one line and stops with status 2.
need() {
  local package missing=()
  command -v dpkg-query >/dev/null || { echo "not Debian: packages are taken to be there: $*" >&2; return 0; }
  for package in "$@"; do
    dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return 0
  if [ "$(id -u)" -ne 0 ]; then
    echo "missing packages: ${missing[*]} (install them with: sudo apt-get install ${missing[*]})" >&2
    exit 2
  fi
  echo "installing: ${missing[*]}" >&2
  export DEBIAN_FRONTEND=noninteractive
  apt-get update -qq && apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

# need_page [PACKAGE...]: three.js and esbuild for the viewer page, by npm, as service/page/package-lock.json pins them.
# The packages (npm, a browser) are tried as root where they are missing. Nothing here fails: without the page the
# program is whole, and its server shows a plain list of sessions.
need_page() {
  if [ $# -gt 0 ] && [ "$(id -u)" -eq 0 ]; then (need "$@") || true; fi
  if ! command -v npm >/dev/null; then
    echo "viewer page: left out, npm is missing (sudo apt-get install npm)" >&2
    return 0
  fi
  cmp -s service/page/package-lock.json service/page/node_modules/.fetched && return 0
  echo "fetching the viewer page's packages" >&2
  (cd service/page && npm ci --ignore-scripts --no-audit --no-fund --loglevel=error >/dev/null &&
    cp package-lock.json node_modules/.fetched) ||
    echo "viewer page: left out, npm ci in service/page failed" >&2
}
