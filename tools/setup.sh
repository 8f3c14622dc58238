# shellcheck shell=bash
# Set-up shared by demo.sh, test.sh, docs.sh and packages.sh: Debian packages, npm packages, configuring, building.
# Meant to be sourced; run by itself (`bash tools/setup.sh`) it installs what is missing.
# Nothing is compiled or written as root: only apt-get runs under sudo.

buckens_root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"

# Debian packages that program and page are built with; keep consistent with cmake/BuckensDependencies.cmake.
buckens_build_packages=(
  clang-14 lld-14 cmake ninja-build ccache ca-certificates
  libeigen3-dev libfmt-dev libspdlog-dev libyaml-cpp-dev nlohmann-json3-dev libcli11-dev
  libmuparser-dev libhdf5-dev libgmsh-dev zlib1g-dev libsuitesparse-dev libmetis-dev
  libopenblas-openmp-dev libspectra-dev libcairo2-dev libcpp-httplib-dev
)
# All packages: also those of tests, benchmarks, checks and the Python module.
buckens_packages=(
  "${buckens_build_packages[@]}" git
  libgtest-dev libgmock-dev libbenchmark-dev
  clang-format-14 libclang-rt-14-dev
  python3 python3-pytest python3-numpy python3-h5py python3-vtk9
  python3-dev python3-venv pybind11-dev mypy
  python3-matplotlib python3-pandas python3-xarray python3-meshio python3-scipy python3-distributed python3-nbclient python3-ipykernel python3-yaml python3-jsonschema
)
# For large bodies: iterative solves, runs over several processes (-DBUCKENS_MPI=ON), and studies on processes of mpirun.
buckens_mpi_packages=(libpetsc-real-dev libslepc-real-dev libptscotch-dev openmpi-bin python3-mpi4py)
# Whether Node.js and npm belong to them, which make the viewer page, and a browser, which tests it.
buckens_needs_node=yes
buckens_needs_browser=yes

# Object files are cached by the contents of the sources, not by the location of the checkout.
export CCACHE_BASEDIR="$buckens_root"
# What a source includes is taken from the compiler's own list, not from a run of the preprocessor.
export CCACHE_DEPEND=1
# Options that change the compiler's memory, not what it makes.
export CCACHE_IGNOREOPTIONS="--param=ggc-*"

say() {
  if [ -t 1 ]; then printf '\033[1m== %s\033[0m\n' "$*"; else printf '== %s\n' "$*"; fi
}
warn() { printf 'note: %s\n' "$*" >&2; }
fail() { printf 'error: %s\n' "$*" >&2; return 1; }

# Installed packages among the arguments, one per line. Replaced in the test of this script.
installed_packages() {
  # dpkg-query fails if it does not know one of the names; its output is right nevertheless.
  { dpkg-query -W -f '${db:Status-Abbrev}${Package}\n' "$@" 2>/dev/null || true; } |
    sed -n 's/^ii *//p' | sort -u
}

has_command() { command -v "$1" >/dev/null 2>&1; }

# Missing packages, one per line. Programs that are often installed in other ways (node,
# npm, a Chromium) count as installed if the command exists.
missing_packages() {
  local installed package
  installed="$(installed_packages "${buckens_packages[@]}")"
  for package in "${buckens_packages[@]}"; do
    grep -qxF "$package" <<<"$installed" || echo "$package"
  done
  if [ "$buckens_needs_node" = yes ]; then
    has_command node || echo nodejs
    has_command npm || echo npm
  fi
  [ "$buckens_needs_browser" = no ] || find_chromium >/dev/null || printf 'chromium\nfonts-liberation\n'
}

find_chromium() {
  local name
  for name in chromium chromium-browser google-chrome; do
    command -v "$name" 2>/dev/null && return 0
  done
  return 1
}

is_debian() {
  has_command apt-get && has_command dpkg-query
}

# How to become root: nothing, "sudo", or failure.
root_prefix() {
  if [ "$(id -u)" -eq 0 ]; then
    echo ""
  elif has_command sudo; then
    echo sudo
  else
    return 1
  fi
}

install_debian_packages() {
  local missing prefix
  if ! is_debian; then
    warn "this is neither Debian nor Ubuntu. The build needs the equivalents of these packages:"
    printf '  %s\n' "${buckens_packages[@]}" nodejs npm chromium >&2
    warn "going on; configuring will name what is missing."
    return 0
  fi
  missing="$(missing_packages | tr '\n' ' ')"
  missing="${missing% }"
  [ -z "$missing" ] && return 0
  if ! prefix="$(root_prefix)"; then
    fail "these Debian packages are missing, and neither root nor sudo is at hand. Ask for
  apt-get install $missing"
    return 1
  fi
  say "Installing Debian packages: $missing"
  # shellcheck disable=SC2086  # word splitting wanted
  $prefix apt-get update -qq || warn "apt-get update failed; trying with the lists that are there."
  # shellcheck disable=SC2086
  $prefix env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \
    $missing >/dev/null || {
    fail "apt-get could not install: $missing
  Run \`apt-get install $missing\` by hand to see why."
    return 1
  }
}

# Whether npm's packages are those of the lock file.
has_npm_packages() {
  local viewer="$buckens_root/viewer"
  [ "$(cat "$viewer/node_modules/.buckens-lock" 2>/dev/null)" = "$(cksum <"$viewer/package-lock.json")" ]
}

# npm ci only when the lock file changed since the last time.
install_npm_packages() {
  local viewer="$buckens_root/viewer"
  [ -f "$viewer/package-lock.json" ] || return 0
  has_npm_packages && return 0
  say "Installing npm packages of the viewer"
  (cd "$viewer" && npm ci --no-audit --no-fund --loglevel=error) || {
    fail "npm ci failed in viewer/. It needs the network once; see the lines above."
    return 1
  }
  cksum <"$viewer/package-lock.json" >"$viewer/node_modules/.buckens-lock"
}

can_make_page() { has_command node && has_command npm && has_npm_packages; }

# Installs what the viewer page is made with, and makes it, while other work goes on. Only the packages come first where
# sudo would ask for a password. finish_page_setup waits for it.
start_page_setup() {
  page_log="$(mktemp)"
  if [ "$(root_prefix)" = sudo ] && ! sudo -n true 2>/dev/null; then
    install_page_packages
    make_page >"$page_log" 2>&1 &
  else
    { install_page_packages && make_page; } >"$page_log" 2>&1 &
  fi
  page_setup=$!
}

install_page_packages() (
  buckens_packages=()
  buckens_needs_node=yes
  buckens_needs_browser=no
  install_debian_packages && install_npm_packages
)

# The page where the program looks for it, as the target buckens_viewer makes it.
make_page() {
  local page="$buckens_root/build/release/share/buckens/viewer.html"
  mkdir -p "$(dirname "$page")"
  cmake -D VIEWER_DIR="$buckens_root/viewer" -D NPM="$(command -v npm)" -D PAGE="$page" \
    -P "$buckens_root/cmake/build_viewer.cmake"
}

finish_page_setup() {
  local status=0
  if [ -n "${page_setup:-}" ]; then
    wait "$page_setup" || status=$?
    [ "$status" -eq 0 ] || cat "$page_log" >&2
  fi
  rm -f "$page_log"
  return "$status"
}

# The compiler that the build folder has, or will have: as in cmake/BuckensCompiler.cmake, which leaves none in the cache.
compiler() {
  local cached
  cached="$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' "$buckens_root/build/release/CMakeCache.txt" 2>/dev/null)" || true
  if [ -n "$cached" ]; then
    echo "$cached"
  elif [ -n "${CC:-}${CXX:-}" ] || ! has_command clang++-14; then
    echo "${CXX:-c++}"
  else
    echo clang++-14
  fi
}

# Warnings are errors with the compilers that the sources are known to have none with; others may have more.
werror_setting() {
  case "$("$(compiler)" --version 2>/dev/null | head -n 1)" in
    *clang\ version\ 14.* | g++*\ 12.* | c++*\ 12.*) echo ON ;;
    *) echo OFF ;;
  esac
}

# configure_release [OPTION...], such as -DBUCKENS_TESTS=ON
configure_release() {
  say "Configuring (preset release)"
  (cd "$buckens_root" && cmake --preset release -DBUCKENS_WERROR="$(werror_setting)" "$@" \
    --log-level=WARNING >/dev/null) || {
    fail "configuring failed; see the lines above."
    return 1
  }
}

# duration SECONDS, in words
duration() {
  if [ "$1" -lt 100 ]; then echo "$1 s"; else echo "$((($1 + 30) / 60)) min"; fi
}

# progress_text DONE TOTAL SECONDS
progress_text() {
  local text="  $1 of $2 steps, $(duration "$3")"
  if [ "$1" -lt "$2" ] && [ "$1" -gt 0 ] && [ "$3" -ge 5 ]; then
    text+=", about $(duration $(($3 * ($2 - $1) / $1))) to go"
  fi
  echo "$text"
}

# Turns lines "@DONE TOTAL ..." of ninja into progress: one line that is overwritten in a terminal, a line
# now and then elsewhere. Other lines, such as errors, are passed on.
show_progress() {
  local line done total last=-100 start=$SECONDS is_shown=""
  while IFS= read -r line; do
    if [[ ! "$line" =~ ^@([0-9]+)\ ([0-9]+) ]]; then
      [ -z "$is_shown" ] || echo
      is_shown=""
      echo "$line"
      continue
    fi
    done="${BASH_REMATCH[1]}" total="${BASH_REMATCH[2]}"
    if [ -t 1 ]; then
      printf '\r%-60s' "$(progress_text "$done" "$total" $((SECONDS - start)))"
      is_shown=1
    elif [ "$done" -eq "$total" ] || [ $((SECONDS - last)) -ge 15 ]; then
      progress_text "$done" "$total" $((SECONDS - start))
      last=$SECONDS
    fi
  done
  [ -z "$is_shown" ] || echo
}

# build_release TARGET...
# The compiler's memory comes in large pages where the kernel offers them (glibc 2.35). It grows by 64 MB at once, and blocks of
# any size are part of it: those that are mapped one by one would be in small pages.
buckens_compiler_memory=glibc.malloc.hugetlb=1:glibc.malloc.top_pad=67108864:glibc.malloc.mmap_threshold=1073741824
buckens_compiler_memory+=:glibc.malloc.trim_threshold=4294967296
build_release() {
  (cd "$buckens_root" && set -o pipefail &&
    GLIBC_TUNABLES="${GLIBC_TUNABLES:-$buckens_compiler_memory}" NINJA_STATUS='@%f %t ' \
      cmake --build --preset release --target "$@" 2>&1 | show_progress)
}

buckens_setup() {
  install_debian_packages && install_npm_packages
}

if [ "${BASH_SOURCE[0]}" = "$0" ]; then
  set -eu
  buckens_setup
  say "Everything needed is installed"
fi
