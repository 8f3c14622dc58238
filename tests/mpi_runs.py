# SPDX-License-Identifier: Apache-2.0
"""Runs of the program over several processes (mpirun), and what their results are compared by."""

import os
import shutil
import subprocess

import h5py
import numpy
import pytest

from conftest import PROGRAM
from test_solver import missing

MPIRUN = shutil.which("mpirun")
# As root and with more processes than cores: what a container of a CI has. Bodies are shared that are much smaller than those
# that are worth it (20 000 variables).
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "OMPI_MCA_rmaps_base_oversubscribe": "1",
               "BUCKENS_MPI_VARIABLES": "2000", "OMPI_MCA_mpi_yield_when_idle": "1", "OMPI_MCA_btl_vader_single_copy_mechanism": "none"}

several = pytest.mark.skipif(missing() or MPIRUN is None, reason="built without BUCKENS_MPI, or no mpirun")


def sets(*changes):
    return [word for change in changes for word in ("--set", change)]


@pytest.fixture
def mpirun(tmp_path):
    """Runs the program in several processes; a hang is a failure."""

    def call(count, *arguments, timeout=240, environment=None):
        command = [MPIRUN, "-n", str(count), PROGRAM, *map(str, arguments)]
        return subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=timeout, check=False,
                              env={**ENVIRONMENT, **(environment or {})}, stdin=subprocess.DEVNULL)

    return call


def must(result, code=0):
    assert result.returncode == code, f"exit code {result.returncode}\n{result.stdout}\n{result.stderr}"
    return result


def energies(directory):
    with h5py.File(directory / "results.h5") as file:
        return {name: values[()] for name, values in file["energies"].items()}


def expect_same_displacements(several_, one):
    """Of all nodes, in the records of bodies: their inertia is integrated by other processes."""
    with h5py.File(several_ / "results.h5") as found, h5py.File(one / "results.h5") as expected:
        for name in expected["bodies"]:
            values = expected[f"bodies/{name}/displacement"][()]
            scale = numpy.abs(values).max()
            assert scale > 0
            assert numpy.abs(found[f"bodies/{name}/displacement"][()] - values).max() < 1e-9 * scale, name


def expect_same_energies(several_, one):
    """Products with M, K and C, which other processes have."""
    expected = energies(one)
    scale = max(numpy.abs(values).max() for values in expected.values())
    assert scale > 0
    for name, values in energies(several_).items():
        assert numpy.abs(values - expected[name]).max() < 1e-9 * scale, name


def expect_same_stresses(several_, one):
    """Products with rows that other processes have."""
    with h5py.File(several_ / "results.h5") as found, h5py.File(one / "results.h5") as expected:
        bodies = [name for name in expected["bodies"] if "solid_stress" in expected[f"bodies/{name}"]]
        assert bodies
        for name in bodies:
            values = expected[f"bodies/{name}/solid_stress"][()]
            scale = numpy.abs(values).max()
            assert scale > 0
            assert numpy.abs(found[f"bodies/{name}/solid_stress"][()] - values).max() < 1e-9 * scale, name
