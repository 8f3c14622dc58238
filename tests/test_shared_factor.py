# SPDX-License-Identifier: Apache-2.0
"""The factor that several processes share, by the plug-in alone: its order, its answers, and what it cannot factorise."""

import os
import pathlib
import subprocess
import sys

import pytest

from conftest import PROGRAM

from test_mpi import ENVIRONMENT, MPIRUN, several

PLUGIN = os.environ.get("BUCKENS_GRID_PLUGIN") or pathlib.Path(PROGRAM).resolve().parent.parent / "lib" / "libbuckens_petsc.so"
SCRIPT = pathlib.Path(__file__).parent / "support" / "shared_factor.py"


def factorise(count, *arguments):
    command = [MPIRUN, "-n", str(count), sys.executable, SCRIPT, PLUGIN, *arguments]
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=120, check=False,
                            env=ENVIRONMENT, stdin=subprocess.DEVNULL)
    assert result.returncode == 0, result.stderr
    return dict(line.split(": ", 1) for line in result.stdout.splitlines())


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
