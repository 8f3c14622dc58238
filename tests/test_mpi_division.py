# SPDX-License-Identifier: Apache-2.0
"""Meshes whose numbers of nodes say nothing about places, divided among processes (PT-Scotch)."""

import json
import random
import shutil

import pytest

from models_of_many_variables import SHELLS
from mpi_runs import expect_same_displacements, expect_same_energies, expect_same_stresses, mpirun, must, several, sets  # noqa: F401
from test_solver import largest_difference, sensors

DIVISIONS = (16, 8, 8)
PENDULUM = """\
buckens: 1
title: A bar of a mesh whose nodes are numbered at random
gravity: [0, 0, -1000]  # forces far above what rounding of positions makes of them
bodies:
  bar:
    mesh: {file: bar.msh, material: {E: 210 GPa, nu: 0.3, rho: 7850 kg/m^3, damping: {mass: 3, stiffness: 1e-6}}}
    interfaces:
      bearing: {plane: {point: [0, 0, 0], normal: [1, 0, 0]}, kind: KIND}
      tip: {plane: {point: [0.16, 0, 0], normal: [1, 0, 0]}}
joints: {hinge: {revolute: {between: [ground, bar/bearing], axis: [0, 1, 0]}}}
simulation: {duration: 2 ms, step: 0.1 ms}
output: {every: 0.5 ms, sensors: {tip: {position: bar/tip}, force: {joint-force: hinge}}}
"""


def pendulum(kind):
    return PENDULUM.replace("KIND", kind)


def shuffled_bricks(divisions):
    """A bar of bricks as a Gmsh file, with nodes and elements in random order."""
    nx, ny, nz = divisions
    places = [(i, j, k) for k in range(nz + 1) for j in range(ny + 1) for i in range(nx + 1)]
    order = random.Random(1)
    order.shuffle(places)
    number = {place: 1 + n for n, place in enumerate(places)}
    corners = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
    cells = [[number[i + a, j + b, k + c] for a, b, c in corners] for i in range(nx) for j in range(ny) for k in range(nz)]
    order.shuffle(cells)
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", str(len(places))]
    lines += [f"{n} {0.01 * i!r} {0.01 * j!r} {0.01 * k!r}" for (i, j, k), n in number.items()]
    lines += ["$EndNodes", "$Elements", str(len(cells))]
    lines += [f"{e + 1} 5 2 1 1 {' '.join(map(str, cell))}" for e, cell in enumerate(cells)]
    return "\n".join(lines + ["$EndElements", ""])


@several
@pytest.mark.parametrize("kind", ["average", "rigid"])
def test_nodes_are_divided_by_place(buckens, mpirun, tmp_path, kind):
    """With a rigid interface, matrices and vectors are of variables that others follow."""
    (tmp_path / "bar.msh").write_text(shuffled_bricks(DIVISIONS))
    (tmp_path / "bar.yaml").write_text(pendulum(kind))
    buckens("run", "bar.yaml", "-o", "one").must(0)
    assert json.loads((tmp_path / "one" / "summary.json").read_text())["bodies"]["bar"]["dof"] > 2000
    for count in (2, 4):
        out = tmp_path / f"of_{count}"
        must(mpirun(count, "run", "bar.yaml", "-o", out))
        assert largest_difference(sensors(out), sensors(tmp_path / "one")) < 1e-9
        expect_same_displacements(out, tmp_path / "one")
        expect_same_energies(out, tmp_path / "one")
        expect_same_stresses(out, tmp_path / "one")
    measures = json.loads((tmp_path / "of_4" / "summary.json").read_text())["measures"]
    # Two cuts through the bar, with two layers of nodes each, of 17; oblique cuts have some more. In runs of numbers all nodes would be at a border.
    assert 0 < measures["border_share"] < 1.5 * 4 / 17


@several
def test_a_run_goes_on_in_another_division(buckens, mpirun, tmp_path):
    """Saved states, kept pairs among them, are by variables."""
    (tmp_path / "bar.msh").write_text(shuffled_bricks(DIVISIONS))
    (tmp_path / "bar.yaml").write_text(pendulum("average"))
    must(mpirun(4, "run", "bar.yaml", "-o", "whole"))
    assert json.loads((tmp_path / "whole" / "summary.json").read_text())["bodies"]["bar"]["recycled"] > 0
    must(mpirun(4, "run", "bar.yaml", "-o", "half", "--set", "simulation.duration=1 ms"))
    for count in (1, 3):
        out = tmp_path / f"more_{count}"
        shutil.copytree(tmp_path / "half", out)
        command = ("run", "--continue", out, "--until", "2 ms")
        if count == 1:
            buckens(*command).must(0)
        else:
            must(mpirun(count, *command))
        assert largest_difference(sensors(out), sensors(tmp_path / "whole")) < 1e-9


@several
def test_a_basis_kept_by_one_process_is_found_by_others(buckens, mpirun, tmp_path):
    """Its key has the content of matrices, to the bit: of shells, whose mass matrices are not symmetric to the bit, with variables that others follow."""
    text = SHELLS.replace("{edge: {set: [x0]}}", "{edge: {set: [x0], kind: rigid}}\n    reduction: {craig-bampton: 2, file: kept.h5}")
    (tmp_path / "plate.yaml").write_text(text)
    buckens("run", "plate.yaml", "-o", "one").must(0)
    kept = (tmp_path / "kept.h5").stat().st_mtime_ns
    must(mpirun(4, "run", "plate.yaml", "-o", "four"))
    assert (tmp_path / "kept.h5").stat().st_mtime_ns == kept
    assert largest_difference(sensors(tmp_path / "four"), sensors(tmp_path / "one")) < 1e-9
