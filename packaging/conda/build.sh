#!/usr/bin/env bash
# Called by conda-build: program, page, library and Python module into the environment.
set -euo pipefail
(cd viewer && npm ci --no-audit --no-fund --loglevel=error)
cmake -S . -B build/conda -G Ninja $CMAKE_ARGS -DCMAKE_BUILD_TYPE=Release -DBUCKENS_TESTS=OFF -DBUCKENS_UNITY=ON \
  -DPython_EXECUTABLE="$PYTHON" -DBUCKENS_PYTHON_DIR="${SP_DIR#"$PREFIX"/}"
cmake --build build/conda
cmake --install build/conda --prefix "$PREFIX"
