#!/usr/bin/env bash
# Installs what is missing, builds everything, runs every test and structural check.
# With --mpi also what needs PETSc and MPI: iterative solves, runs over several processes.
# Other arguments go to ctest, e.g. ./test.sh -L unit
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. tools/setup.sh

with=()
if [ "${1:-}" = --mpi ]; then
  shift
  buckens_packages+=("${buckens_mpi_packages[@]}")
  with=(-DBUCKENS_MPI=ON)
fi
buckens_setup
# All of it, whatever ./demo.sh left out.
configure_release -DBUCKENS_TESTS=ON -DBUCKENS_BENCH=ON -DBUCKENS_PYTHON_MODULE=ON "${with[@]}"
if [ "$(werror_setting)" = OFF ]; then
  warn "this is neither clang 14 nor g++ 12; compiler warnings are shown but do not fail the build."
fi
say "Building (preset release)"
build_release all buckens_headers
if ! grep -q '^BUCKENS_\(MPI\|PETSC\):BOOL=ON' build/release/CMakeCache.txt; then
  say "Tests of iterative solves and of several processes are skipped: ./test.sh --mpi has them"
fi
python="$(sed -n 's/^BUCKENS_PYTHON:FILEPATH=//p' build/release/CMakeCache.txt)"
if ! "${python:-python3}" -c 'import distributed' 2>/dev/null; then
  say "Tests of studies on a cluster of Dask are skipped: the package python3-distributed is not installed"
fi
say "Testing"
exec ctest --preset release --parallel "$(nproc)" "$@"
