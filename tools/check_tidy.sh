#!/usr/bin/env bash
# Faults and names in the C++ sources: clang-tidy 14 with the .clang-tidy of the repository.
#   tools/check_tidy.sh              sources that differ from the last commit, or that it changed
#   tools/check_tidy.sh REVISION     sources changed since then
#   tools/check_tidy.sh --all        the whole library and program, piece by piece: 20 minutes of processor time
# Needs build/release as ./test.sh configures it. Not part of ./test.sh, since parsing alone takes as long as building.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
if ! command -v clang-tidy-14 >/dev/null; then
  echo "tidy: clang-tidy-14 is not installed; install the package clang-tidy-14" >&2
  exit 1
fi
build=build/release
if [ ! -f "$build/compile_commands.json" ]; then
  echo "tidy: $build is not configured; run ./test.sh first" >&2
  exit 1
fi

if [ "${1:-}" = --all ]; then
  mapfile -t files < <(printf '%s\n' "$build"/pieces/buckens_*/*.cpp)
else
  mapfile -t files < <(git diff --name-only --diff-filter=d "${1:-HEAD~1}" -- 'src/*.cpp' 'apps/*.cpp')
fi
if [ ${#files[@]} -eq 0 ]; then
  echo "tidy: no source has changed"
  exit 0
fi
# The compilation database lists unity pieces, not sources: so flags are given here.
flags=(-std=c++20 -DBUCKENS_GMSH_LIBRARY=\"libgmsh.so\" -I. -Isrc -Iapps "-I$build/generated" -isystem /usr/include/eigen3
  -isystem /usr/include/hdf5/serial -isystem /usr/include/suitesparse -isystem /usr/include/cairo
  -isystem "/usr/include/$(clang-14 -print-multiarch)/openblas-openmp")
if ! printf '%s\0' "${files[@]}" |
  xargs -0 --max-args 1 --max-procs "$(nproc)" -I '{}' clang-tidy-14 --quiet '{}' -- "${flags[@]}" 2>/dev/null; then
  echo "tidy: errors" >&2
  exit 1
fi
echo "tidy: ok"
