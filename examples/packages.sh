# The Debian packages that gridcull needs, and one function that sees to them. Sourced by examples/demo.sh and
# tests/run.sh.

packages_program="build-essential cmake ninja-build libglm-dev libtbb-dev nlohmann-json3-dev libcli11-dev
  libpugixml-dev zlib1g-dev libboost-dev libembree-dev prometheus-cpp-dev"
packages_tests="$packages_program git doctest-dev libcgal-dev gnuplot-nox"

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
