#!/usr/bin/env bash
# Installs what is missing, builds everything, runs every test and structural check.
# Arguments go to ctest, e.g. ./test.sh -L unit
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. tools/setup.sh

buckens_setup
configure_release
if [ "$(werror_setting)" = OFF ]; then
  warn "this is not g++ 12; compiler warnings are shown but do not fail the build."
fi
say "Building (preset release)"
cmake --build --preset release --target all buckens_headers
say "Testing"
exec ctest --preset release --parallel "$(nproc)" "$@"
