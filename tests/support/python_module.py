# SPDX-License-Identifier: Apache-2.0
"""The Python module of the build tree; its tests are left out where it was not built."""

import os
import pathlib
import sys

import pytest

SOURCE = pathlib.Path(os.environ.get("BUCKENS_SOURCE_DIR", pathlib.Path(__file__).parents[2]))
BINARY = pathlib.Path(os.environ.get("BUCKENS_BINARY_DIR", SOURCE / "build" / "release"))
PACKAGES = BINARY / "python"

if not list((PACKAGES / "buckens").glob("_core*.so")):
    pytest.skip(f"{PACKAGES}: the Python module is not built", allow_module_level=True)
os.environ.setdefault("BUCKENS_PROGRAM", str(BINARY / "bin" / "buckens"))
sys.path.insert(0, str(PACKAGES))

import buckens  # noqa: E402, F401 (imported from the build tree)


def source(path):
    """A file of the source tree."""
    return str(SOURCE / path)
