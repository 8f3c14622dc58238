# SPDX-License-Identifier: Apache-2.0
"""What several processes share, by the plug-in alone: a factor, matrices that multiply, and pairs of loads and answers."""

import os
import pathlib
import subprocess
import sys

import pytest

from conftest import PROGRAM

from mpi_runs import ENVIRONMENT, MPIRUN, several

PLUGIN = os.environ.get("BUCKENS_GRID_PLUGIN") or pathlib.Path(PROGRAM).resolve().parent.parent / "lib" / "libbuckens_petsc.so"
SUPPORT = pathlib.Path(__file__).parent / "support"


def call(script, count, *arguments):
    command = [MPIRUN, "-n", str(count), sys.executable, SUPPORT / script, PLUGIN, *arguments]
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=120, check=False,
                            env=ENVIRONMENT, stdin=subprocess.DEVNULL)
    assert result.returncode == 0, result.stderr
    return dict(line.split(": ", 1) for line in result.stdout.splitlines())


def factorise(count, *arguments):
    return call("shared_factor.py", count, *arguments)


@several
@pytest.mark.parametrize("count", [2, 3])
def test_order_and_answers(count):
    found = factorise(count)
    # 400 variables in a row, every second one first: these have themselves and two neighbours, the last of them one; the
    # others, a row of 200 by then, themselves and one. In the order of the row itself it would be 799.
    assert float(found["entries"]) == 200 + 399 + 200 + 199
    # Condition 6.5e4 times the precision, times components of 5.
    assert float(found["difference"]) < 1e-10


@several
@pytest.mark.parametrize("negative", [0, 399])
def test_a_negative_pivot_is_an_error(negative):
    """Which MUMPS itself passes over; on the first and on the second process."""
    assert factorise(2, negative) == {"error": "the matrix is not positive definite"}


@several
@pytest.mark.parametrize("count", [2, 3, 5])
def test_matrices_and_pairs_of_the_others(count):
    """All numbers are whole and small, so that every order of sums gives the same. Runs of rows differ in length."""
    found = call("shared_rows.py", count)
    # PT-Scotch divides a row of bars: a cut between two parts, and hardly one more.
    assert count - 2 <= int(found.pop("cuts")) <= 2 * (count - 2)
    assert found == {"rows": "0.0", "symmetric": "0.0", "facts": "True", "gathered": "True",
                     "lopsided": "-1 it has entries on one side of the diagonal that are not on the other",
                     "along": "0.0", "left": "0.0 0.0", "combined": "0.0", "taken": "0.0 0.0",
                     "sizes": "True", "again": "True"}
