# SPDX-License-Identifier: Apache-2.0
"""buckens.sweep on the processes of mpirun: `mpirun -n 3 python3 -m mpi4py.futures study.py`, as docs/tutorials/studies.md has it."""

import json
import os
import pathlib
import subprocess
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent / "support"))
from conftest import BINARY  # noqa: E402 (found after the path is set)
from python_module import PACKAGES, buckens, source  # noqa: E402 (found after the path is set)

CACHE = BINARY / "CMakeCache.txt"
if "BUCKENS_MPI:BOOL=ON" not in (CACHE.read_text() if CACHE.exists() else ""):
    pytest.skip("built without BUCKENS_MPI", allow_module_level=True)

from mpi_runs import ENVIRONMENT, MPIRUN  # noqa: E402 (asks the program, which takes a while)

MODEL = source("tests/models/pendulum.yaml")
TABLE = {"gravity.1": [-0.1 * k for k in range(10)]}
SHORT = {"simulation.duration": "20 ms"}
STUDY = f"""
import json
import os
import buckens
from mpi4py.futures import MPIPoolExecutor

if __name__ == "__main__":
    with MPIPoolExecutor() as executor:
        answer = buckens.sweep({MODEL!r}, {TABLE!r}, "out", executor=executor, set={SHORT!r}, together=1)
    with open("answer.json", "w") as file:
        json.dump({{**answer, "own": os.getpid()}}, file)
"""


def test_processes_of_mpirun_are_workers(tmp_path):
    (tmp_path / "study.py").write_text(STUDY)
    # Without mpi4py (Debian: python3-mpi4py, which ./test.sh --mpi installs) this fails.
    call = subprocess.run([MPIRUN, "-n", "3", sys.executable, "-m", "mpi4py.futures", "study.py"], cwd=tmp_path, capture_output=True,
                          text=True, timeout=240, check=False, stdin=subprocess.DEVNULL,
                          env={**ENVIRONMENT, "PYTHONPATH": f"{PACKAGES}{os.pathsep}{os.environ.get('PYTHONPATH', '')}"})
    assert call.returncode == 0, call.stdout + call.stderr
    answer = json.loads((tmp_path / "answer.json").read_text())
    assert [variant["status"] for variant in answer["variants"]] == ["done"] * 10
    # The first process hands out variants; the other two run them.
    workers = {int(name.rpartition(":")[2]) for name in answer["workers"]}
    assert 1 <= len(workers) <= 2 and answer["own"] not in workers
    buckens.sweep(MODEL, TABLE, tmp_path / "serial", set=SHORT)
    assert (tmp_path / "out" / "sweep.csv").read_text() == (tmp_path / "serial" / "sweep.csv").read_text()
