# SPDX-License-Identifier: Apache-2.0
"""A build with BUCKENS_GPL=OFF links nothing under the GPL and refuses STEP files with a way out."""

import pathlib
import subprocess

import pytest
from conftest import PROGRAM, may_mesh_step_files

PARTS = pathlib.Path(__file__).parent / "parts"


@pytest.mark.skipif(may_mesh_step_files(), reason="built with BUCKENS_GPL=ON")
def test_nothing_under_the_gpl_is_linked():
    linked = subprocess.run(["ldd", PROGRAM], capture_output=True, text=True, check=True).stdout
    assert "libklu" in linked, "the list is that of the program"
    assert not any(name in linked for name in ("cholmod", "spqr", "gmsh"))


@pytest.mark.skipif(may_mesh_step_files(), reason="built with BUCKENS_GPL=ON")
def test_step_files_are_refused(buckens):
    buckens("mesh-info", PARTS / "assembly.step").must(2, "assembly.step", "BUCKENS_GPL=OFF", "with another program")
