# SPDX-License-Identifier: Apache-2.0
"""Modes, statics and reductions of large bodies over several processes: M and K stay with those that have them."""

import json
import subprocess

import pytest

from conftest import PROGRAM

from models_of_many_variables import CUBE, SHELLS, SIDE, cube
from mpi_runs import ENVIRONMENT, MPIRUN, expect_same_displacements, expect_same_energies, mpirun, must, several, sets  # noqa: F401
from test_solver import largest_difference, sensors

FIXED = CUBE.replace("{spherical:", "{fixed:")
PULL = "loads: {pull: {force: {on: cube/corner_111, value: [0, 0, 1 kN]}}}\n"


def scalar_mass(side):
    """What the first process brings of a solid while the model is built: entries of the scalar mass matrix [bytes]."""
    nodes = side + 1  # along each edge of the cube
    return 12 * (3 * nodes - 2)**3 + 4 * (nodes**3 + 1)


def modes(result):
    (report,) = json.loads(result)["analyses"]
    return [mode["omega_squared"] for mode in report["modes"]], report["work"]


def summary_of(directory):
    return json.loads((directory / "summary.json").read_text())


ANALYSES = {
    "subspace": ("cube.yaml", "--method", "subspace"),
    "penalty": ("cube.yaml", "--method", "penalty", "--condition"),
    "spectra": ("cube.yaml", "--method", "spectra"),
    "system": ("fixed.yaml", "--system"),
    "system in equilibrium": ("fixed.yaml", "--system", "--about", "static"),
    "shells": ("plate.yaml",),
}


@several
@pytest.mark.parametrize("name", ANALYSES)
def test_modes_leave_matrices_where_they_are(buckens, mpirun, tmp_path, name):
    """The first process receives products and solutions, and no matrix."""
    for file, text in (("cube", CUBE), ("fixed", FIXED), ("plate", SHELLS)):
        (tmp_path / f"{file}.yaml").write_text(text)
    arguments = ("modes", *ANALYSES[name], "--count", 3, "--json")
    expected, alone = modes(buckens(*arguments).must(0).out)
    found, work = modes(must(mpirun(2, *arguments)).stdout)
    assert len(expected) >= 3
    assert found == pytest.approx(expected, rel=1e-8)
    assert work["processes"] == 2 and work["bytes"] > 0
    assert work["bytes_of_whole_matrices"] == 0
    assert "bytes" not in alone and "processes" not in alone


@several
def test_a_static_path_leaves_matrices_where_they_are(buckens, mpirun, tmp_path):
    (tmp_path / "cube.yaml").write_text(FIXED + PULL)
    buckens("static", "cube.yaml", "-o", "one").must(0)
    must(mpirun(2, "static", "cube.yaml", "-o", "two"))
    assert largest_difference(sensors(tmp_path / "two"), sensors(tmp_path / "one")) < 1e-9
    assert summary_of(tmp_path / "two")["measures"]["bytes_of_whole_matrices"] == 0


@several
def test_an_automatic_solver_leaves_matrices_where_they_are(tmp_path):
    """Where it is not certain that the factor fits into memory, its size is predicted from the graph that the processes find together."""
    side = 18
    (tmp_path / "cube.yaml").write_text(cube(side))
    dof = 3 * (side + 1)**3
    # Half of this is usable, and less than a full triangle.
    limited = 3_000_000
    assert 4 * dof**2 > 1024 * limited / 2
    notes = {}
    for name, program in (("one", [PROGRAM]), ("two", [MPIRUN, "-n", "2", PROGRAM])):
        command = ["sh", "-c", f"ulimit -v {limited}; exec \"$@\"", "sh", *program, "run", "cube.yaml", "-o", name,
                   *sets("bodies.cube.solver=auto", "simulation.duration=0.1 ms")]
        must(subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=240, check=False, env=ENVIRONMENT,
                            stdin=subprocess.DEVNULL))
        notes[name] = [note for note in summary_of(tmp_path / name)["notes"] if "solver" in note]
    assert f"direct, since the factor of {dof} variables is predicted to take" in notes["one"][0]
    assert notes["two"] == notes["one"], "the same graph, the same order"
    assert summary_of(tmp_path / "two")["measures"]["bytes_of_whole_matrices"] == scalar_mass(side)


REDUCTIONS = {
    "craig-bampton": "reduction: {craig-bampton: 4, file: kept.h5}",
    "free-free": "reduction: {free-free: 4, file: kept.h5}",
    "quasi-static": "flexibility: quasi-static",
}


@several
@pytest.mark.parametrize("count, name", [(2, "craig-bampton"), (3, "craig-bampton"), (2, "free-free"), (2, "quasi-static")])
def test_reductions_leave_matrices_where_they_are(buckens, mpirun, tmp_path, count, name):
    """And what one process has kept of a basis belongs to the same body for several, and the other way round."""
    text = CUBE.replace("    interfaces:", f"    {REDUCTIONS[name]}\n    interfaces:")
    for place in ("one", "several"):
        (tmp_path / place).mkdir()
        (tmp_path / place / "cube.yaml").write_text(text)
    buckens("run", "one/cube.yaml", "-o", "one/out").must(0)
    must(mpirun(count, "run", "several/cube.yaml", "-o", "several/out"))
    # Groups of equal frequencies are kept whole, so that the basis spans the same on any number of processes, whose iterations differ by rounding.
    assert largest_difference(sensors(tmp_path / "several" / "out"), sensors(tmp_path / "one" / "out")) < 1e-9
    expect_same_displacements(tmp_path / "several" / "out", tmp_path / "one" / "out")
    expect_same_energies(tmp_path / "several" / "out", tmp_path / "one" / "out")
    measures = summary_of(tmp_path / "several" / "out")["measures"]
    assert measures["bytes_of_whole_matrices"] == scalar_mass(SIDE)
    assert measures["processes"] == count
    if name == "quasi-static":
        return
    kept = (tmp_path / "one" / "kept.h5").stat().st_mtime_ns
    must(mpirun(count, "run", "one/cube.yaml", "-o", "one/again"))
    buckens("run", "several/cube.yaml", "-o", "several/again").must(0)
    assert (tmp_path / "one" / "kept.h5").stat().st_mtime_ns == kept
    for place in ("one", "several"):
        assert largest_difference(sensors(tmp_path / place / "again"), sensors(tmp_path / place / "out")) < 1e-12


def hinged_blocks(side=8):
    """A deck of two blocks that have one edge in common, about which they turn without strain."""
    at, lines, elements = {}, [], []
    corners = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
    for shift in (0, side):
        for i, j, k in ((i, j, k) for k in range(side) for j in range(shift, shift + side) for i in range(shift, shift + side)):
            elements.append([at.setdefault((i + a, j + b, k + c), len(at) + 1) for a, b, c in corners])
    lines += [f"GRID,{number},,{0.01 * i:.6f},{0.01 * j:.6f},{0.01 * k:.6f}" for (i, j, k), number in at.items()]
    lines += [f"CHEXA,{e + 1},1,{','.join(map(str, nodes[:6]))}\n,{nodes[6]},{nodes[7]}" for e, nodes in enumerate(elements)]
    return "\n".join([*lines, "PSOLID,1,1", "MAT1,1,2.1E11,,0.3,7850.", "ENDDATA", ""])


HINGED = """\
buckens: 1
bodies: {blocks: {mesh: {file: blocks.bdf, length-unit: m, mass-unit: kg}}}
joints: {ball: {spherical: {between: [ground, blocks]}}}
simulation: {duration: 1 ms, step: 0.1 ms}
"""


@several
def test_a_mesh_that_is_a_mechanism_is_told_by_any_number_of_processes(buckens, mpirun, tmp_path):
    """Its K + μM is definite by little; a factor that fails for that is taken for what it is."""
    (tmp_path / "blocks.bdf").write_text(hinged_blocks())
    (tmp_path / "blocks.yaml").write_text(HINGED)
    words = "\"blocks\" is a mechanism in itself"
    buckens("check", "blocks.yaml").must(3, words)
    assert words in must(mpirun(2, "modes", "blocks.yaml"), 3).stderr
