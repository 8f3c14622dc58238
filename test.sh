#!/usr/bin/env bash
# Installs what is missing, builds everything, runs every test and structural check.
# Arguments go to ctest, e.g. ./test.sh -L unit
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. tools/setup.sh

buckens_setup
# All of it, whatever ./demo.sh left out.
configure_release -DBUCKENS_TESTS=ON -DBUCKENS_BENCH=ON -DBUCKENS_PYTHON_MODULE=ON
if [ "$(werror_setting)" = OFF ]; then
  warn "this is not g++ 12; compiler warnings are shown but do not fail the build."
fi
say "Building (preset release)"
build_release all buckens_headers
say "Testing"
exec ctest --preset release --parallel "$(nproc)" "$@"
