# SPDX-License-Identifier: Apache-2.0
"""Decks and matrices of the examples equal what their scripts write."""

import os
import pathlib
import shutil
import subprocess
import sys

import pytest

EXAMPLES = pathlib.Path(os.environ.get("BUCKENS_SOURCE_DIR", pathlib.Path(__file__).parents[1])) / "examples"


WRITTEN = {
    "bracket_inp/make_deck.py": ["bracket.inp"],  # to the standard output
    "plate_bdf/make_deck.py": ["plate.bdf"],
    "marble_bowl/make_bowl.py": ["bowl.stl"],
    "gyro_rotor/make_matrices.py": ["rotor_mass.mtx", "rotor_stiffness.mtx", "rotor_nodes.csv"],
}


@pytest.mark.parametrize("script, files", WRITTEN.items())
def test_files_are_what_their_script_writes(tmp_path, script, files):
    source = EXAMPLES / script
    shutil.copy(source, tmp_path)
    done = subprocess.run([sys.executable, tmp_path / source.name], capture_output=True, text=True,
                          cwd=tmp_path, check=True)
    for name in files:
        written = tmp_path / name
        new = (written.read_text() if written.exists() else done.stdout).split()
        old = (source.parent / name).read_text().split()
        assert len(new) == len(old)
        for a, b in zip(new, old):
            # Sums of products may round differently with another NumPy.
            assert a == b or float(a) == pytest.approx(float(b), rel=1e-13), name


def test_every_script_that_makes_files_is_checked_here_or_needs_gmsh():
    scripts = {f"{path.parent.name}/{path.name}" for path in EXAMPLES.glob("*/make_*.py")}
    assert scripts - set(WRITTEN) == {"connecting_rod/make_rod.py"}
