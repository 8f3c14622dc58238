# SPDX-License-Identifier: Apache-2.0
"""What goes wrong in one of several processes, while others wait for it: one message, and all end."""

import subprocess

import pytest

from conftest import BINARY, PROGRAM
from mpi_runs import ENVIRONMENT, MPIRUN, several
from test_mpi_modes import write_model

LIBRARIES = BINARY / "test"


def library(name):
    file = LIBRARIES / f"lib{name}.so"
    if not file.exists():
        pytest.skip("built without tests")
    return file


def modes(place, ranks, preloaded, *options, count=3, variables=""):
    """Modes on some processes, of which those with `ranks` have the library loaded."""
    chosen = "|".join(map(str, ranks))
    script = f"case $OMPI_COMM_WORLD_RANK in {chosen}) export LD_PRELOAD={preloaded} {variables};; esac; exec \"$@\""
    command = [MPIRUN, "-n", str(count), "sh", "-c", script, "sh", PROGRAM, "modes", "model.yaml", *options]
    return subprocess.run(command, cwd=place, capture_output=True, text=True, timeout=240, check=False, env=ENVIRONMENT, stdin=subprocess.DEVNULL)


def told_once(result):
    told = [line for line in result.stderr.splitlines() if line.startswith("buckens: error")]
    assert result.returncode == 4 and len(told) == 1, f"exit code {result.returncode}\n{result.stderr}"
    return told[0]


@several
@pytest.mark.parametrize("ranks", [(0,), (1,), (0, 1, 2)], ids=["first", "other", "all"])
def test_a_search_that_fails_is_told_once(tmp_path, ranks):
    """On one process while the others search, or on all, which then end together."""
    write_model(tmp_path, "hex8")
    told = told_once(modes(tmp_path, ranks, library("failing_search"), "--count", "4"))
    assert "take the method subspace" in told
    if len(ranks) == 1:
        assert f"process {ranks[0]} cannot go on" in told
    else:
        assert "the search for 4 modes" in told


@several
def test_too_little_memory_for_a_matrix_that_is_brought_back(tmp_path):
    """The method augmented has K in the first process; that others list their columns for it is the last that takes memory there."""
    write_model(tmp_path, "hex8")
    options = ("--method", "augmented", "--count", "1")
    requests = tmp_path / "requests"
    enough = modes(tmp_path, [1], library("lacking_memory"), *options, count=2, variables=f"LACKING_COUNT={requests}")
    assert enough.returncode == 0, enough.stderr
    last = int(requests.read_text())
    for lacking in (last - 1, last):  # rows, values
        told = told_once(modes(tmp_path, [1], library("lacking_memory"), *options, count=2, variables=f"LACKING_AT={lacking}"))
        assert "process 1 cannot go on" in told and "too little memory for a matrix that goes to the first process" in told
