# SPDX-License-Identifier: Apache-2.0
"""Modes of large bodies over several processes, by SLEPc: those of one process, none of a multiple frequency missing."""

import json
import subprocess

import h5py
import numpy
import pytest

from conftest import PROGRAM
from mpi_runs import ENVIRONMENT, MPIRUN, mpirun, must, several  # noqa: F401

MODEL = """\
buckens: 1
title: A free body large enough to be distributed
materials: {{steel: {{E: 210 GPa, nu: 0.3, rho: 7850}}}}
bodies: {{body: {{mesh: {mesh}}}}}
simulation: {{duration: 1 ms, step: 1 ms}}
"""
# Frequencies of a cube are double and triple, those of a square plate single and double.
MESHES = {
    "hex8": "{box: {size: [0.1, 0.1, 0.1], divisions: [10, 10, 10], element: hex8}, material: steel}",
    "tet10": "{box: {size: [0.1, 0.1, 0.1], divisions: [5, 5, 5], element: tet10}, material: steel}",
    "shells": "{plate: {size: [0.2, 0.2], divisions: [24, 24], thickness: 2 mm}, material: steel}",
}
WANTED = 14


def write_model(place, name):
    (place / "model.yaml").write_text(MODEL.format(mesh=MESHES[name]))


def analysis(told):
    return json.loads(told)["analyses"][0]


def squares(of):
    return numpy.array([mode["omega_squared"] for mode in of["modes"]])


def shapes(directory):
    """Displacements of all nodes, one row per mode."""
    with h5py.File(directory / "results.h5") as file:
        values = file["bodies/body/displacement"][()]
    return values.reshape(len(values), -1)


@pytest.fixture(scope="module")
def alone(tmp_path_factory):
    """Modes of one process by its own iteration, each model once: what is told, and shapes."""
    known = {}

    def call(name):
        if name not in known:
            place = tmp_path_factory.mktemp("alone")
            write_model(place, name)
            result = subprocess.run([PROGRAM, "modes", "model.yaml", "--count", str(WANTED), "--json", "-o", "out"], cwd=place, check=True,
                                    capture_output=True, text=True, timeout=240)
            known[name] = analysis(result.stdout), shapes(place / "out")
        return known[name]

    return call


def groups(values):
    """Ranges of equal frequencies. The last one may go on beyond the modes wanted, so it is left out."""
    ends = [k for k in range(1, len(values)) if values[k] > values[k - 1] * (1 + 1e-6)]
    return list(zip([0, *ends], ends))


def largest_difference(found, expected, of):
    """From the shapes of groups to the space of those expected, relative to their length."""
    differences = []
    for first, end in of:
        basis = numpy.linalg.qr(expected[first:end].T)[0]
        rows = found[first:end]
        rest = rows - (rows @ basis) @ basis.T
        differences += list(numpy.linalg.norm(rest, axis=1) / numpy.linalg.norm(rows, axis=1))
    return max(differences)


@several
@pytest.mark.parametrize("count, name", [(2, "hex8"), (3, "hex8"), (2, "tet10"), (3, "shells")])
def test_modes_are_those_of_one_process(alone, mpirun, tmp_path, count, name):
    write_model(tmp_path, name)
    expected, expected_shapes = alone(name)
    assert expected["work"]["method"] == "subspace"
    of_one = squares(expected)
    equal = groups(of_one)
    assert any(end - first > 1 for first, end in equal)
    found = analysis(must(mpirun(count, "modes", "model.yaml", "--count", WANTED, "--json", "-o", "out")).stdout)
    assert found["work"]["method"] == "slepc"
    assert found["work"]["factorisations"] == 1
    assert len(found["modes"]) == WANTED
    numpy.testing.assert_allclose(squares(found), of_one, rtol=1e-9, atol=0)
    # What --tolerance asks for.
    assert max(mode["error"] for mode in found["modes"]) < 1e-9
    assert largest_difference(shapes(tmp_path / "out"), expected_shapes, equal) < 1e-7


@several
def test_no_mode_of_a_multiple_frequency_is_missed(alone, mpirun, tmp_path):
    """With so few modes wanted that a group is cut, and a single one: each has a space of searches of its own."""
    write_model(tmp_path, "hex8")
    of_one = squares(alone("hex8")[0])
    for count in (1, 4):
        found = analysis(must(mpirun(2, "modes", "model.yaml", "--count", count, "--json")).stdout)
        numpy.testing.assert_allclose(squares(found), of_one[:count], rtol=1e-9, atol=0)


@several
def test_our_own_iteration_on_request(alone, mpirun, tmp_path):
    write_model(tmp_path, "hex8")
    found = analysis(must(mpirun(2, "modes", "model.yaml", "--count", 4, "--method", "subspace", "--json")).stdout)
    assert found["work"]["method"] == "subspace"
    numpy.testing.assert_allclose(squares(found), squares(alone("hex8")[0])[:4], rtol=1e-9, atol=0)


def test_one_process_refuses_slepc(buckens, tmp_path):
    write_model(tmp_path, "hex8")
    buckens("modes", "model.yaml", "--method", "slepc").must(3, "method slepc", "mpirun", "method subspace")


@several
def test_bodies_that_are_not_shared(mpirun, tmp_path):
    """An iterative solver has no factor: automatic takes our own iteration, and SLEPc is refused."""
    write_model(tmp_path, "hex8")
    options = ("--set", "bodies.body.solver=iterative", "--count", 1)
    found = analysis(must(mpirun(2, "modes", "model.yaml", "--json", *options)).stdout)
    assert found["work"]["method"] == "subspace"
    refused = must(mpirun(2, "modes", "model.yaml", "--method", "slepc", *options), 3)
    assert refused.stderr.count("method slepc") == 1, refused.stderr


@several
def test_too_little_memory_for_the_vectors_of_a_search(tmp_path):
    """On one process only, which finds out before the search: the first one tells it once, and all end."""
    write_model(tmp_path, "hex8")
    (tmp_path / "model.yaml").write_text((tmp_path / "model.yaml").read_text().replace("[10, 10, 10]", "[18, 18, 18]"))
    limited = "[ $OMPI_COMM_WORLD_RANK = 0 ] || ulimit -v 1500000; exec \"$@\""
    command = [MPIRUN, "-n", "2", "sh", "-c", limited, "sh", PROGRAM, "modes", "model.yaml", "--count", "3000"]
    result = must(subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=240, check=False, env=ENVIRONMENT,
                                 stdin=subprocess.DEVNULL), 4)
    told = [line for line in result.stderr.splitlines() if line.startswith("buckens: error")]
    assert len(told) == 1 and "3000 modes" in told[0] and "too little memory" in told[0], result.stderr
