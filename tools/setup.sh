# shellcheck shell=bash disable=SC2034
# Sourced by tools/build, tools/run and tools/test: finds the project, installs what is missing, builds.
# Needs bash, Debian 12 and, where a package is missing, root or sudo.

root=$(cd -P -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/.." && pwd)
cores=$(nproc)

# What the program needs, and what only the tests need.
build_packages=(
  g++ cmake ninja-build pkg-config
  libeigen3-dev nlohmann-json3-dev libfmt-dev libcli11-dev
  libboost-dev libnlopt-dev libnlopt-cxx-dev libsqlite3-dev libxxhash-dev libgtest-dev libgmock-dev
  gnuplot-nox
)
test_packages=(clang-format clang-tidy)

say() { printf 'repose: %s\n' "$*" >&2; }
stop() { say "$*"; exit 1; }

is_installed() { [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]; }

as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    return 1
  fi
}

apt() {
  as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -y -o Dpkg::Use-Pty=0 -o DPkg::Lock::Timeout=300 "$@"
}

# ensure_packages NAME...: installs those that are missing; names what cannot be installed and stops.
ensure_packages() {
  command -v dpkg-query >/dev/null || stop "these scripts install with apt: they need Debian 12"
  local missing=() failed=() name log
  for name in "$@"; do
    is_installed "$name" || missing+=("$name")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  if [ "$(id -u)" -ne 0 ] && ! command -v sudo >/dev/null; then
    stop "missing packages, and neither root nor sudo to install them: ${missing[*]}"
  fi

  say "installing ${missing[*]}"
  log=$(mktemp)
  # Lists that cannot be refreshed may still do; what they lack is found below.
  apt update >"$log" 2>&1 || say "the package lists could not be updated: $(tail -n 1 "$log")"
  if ! apt install --no-install-recommends "${missing[@]}" >"$log" 2>&1; then
    # One by one, so that the culprit has a name.
    for name in "${missing[@]}"; do
      apt install --no-install-recommends "$name" >>"$log" 2>&1 || failed+=("$name")
    done
  fi
  for name in "${missing[@]}"; do
    is_installed "$name" || [[ " ${failed[*]-} " == *" $name "* ]] || failed+=("$name")
  done
  if [ ${#failed[@]} -gt 0 ]; then
    grep -E '^(E|Err|W|sudo):' "$log" | sort -u | tail -n 5 >&2 || true
    rm -f "$log"
    stop "cannot install: ${failed[*]}"
  fi
  rm -f "$log"
}

# configure PRESET FOLDER [OPTION...]: once; ninja itself sees later changes of the CMake files.
configure() {
  local preset=$1 folder=$root/$2 log
  shift 2
  if [ -e "$folder/build.ninja" ] && grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$folder/CMakeCache.txt" 2>/dev/null; then
    return 0
  fi
  log=$(mktemp)
  (cd "$root" && cmake --preset "$preset" --fresh "$@") >"$log" 2>&1 || {
    cat "$log" >&2
    rm -f "$log"
    stop "CMake could not configure the build (preset $preset)"
  }
  rm -f "$log"
}

# compile FOLDER TARGET...: on all cores, one refreshed line on a terminal, only faults elsewhere.
compile() {
  local folder=$root/$1 quiet=(--quiet) started=$SECONDS
  shift
  if [ -t 1 ]; then quiet=(); fi
  ninja -C "$folder" -j "$cores" -n "$@" | grep -q 'no work to do' && return 0
  say "building ${folder#"$root"/} on $cores cores"
  ninja -C "$folder" -j "$cores" "${quiet[@]}" "$@" >&2 || stop "the build failed"
  say "built ${folder#"$root"/} in $((SECONDS - started)) s"
}

build_program() {
  ensure_packages "${build_packages[@]}"
  configure release build
  compile build repose
}
