# SPDX-License-Identifier: Apache-2.0
"""Bodies with several frames over several processes: each part is shared or not, as its own size says."""

import json

from mpi_runs import expect_same_displacements, expect_same_energies, expect_same_stresses, mpirun, must, several  # noqa: F401
from test_solver import largest_difference, sensors

LENGTH, SIDE = 40, 2  # elements
# The bar is placed where its joint closes and parallel to the axes, so that the ties of its nodes are closed exactly. Positions of parts that are
# turned are rounded to 1e-16 m, which changes forces at the cut by that times the stiffness: by 2.5e-7 N of 95 N if assembly turns this bar by
# 0.09 rad, 150 times less if it is a hundred times as soft.
SOLID = f"""\
buckens: 1
title: A bar of solids with two frames
gravity: [0, 0, -9.81]
materials: {{steel: {{E: 210 GPa, nu: 0.3, rho: 7850, damping: {{stiffness: 0.01 ms}}}}}}
bodies:
  bar:
    at: {{position: [0, -0.05, -0.05]}}
    mesh: {{box: {{size: [0.8, 0.1, 0.1], divisions: [{LENGTH}, {SIDE}, {SIDE}], element: hex8}}, material: steel}}
    interfaces: {{bearing: {{face: x0}}}}
    frames: 2
joints: {{hinge: {{revolute: {{between: [ground, bar/bearing], axis: [0, 1, 0]}}}}}}
simulation: {{duration: 0.3 ms, step: 0.1 ms}}
output: {{every: 0.1 ms, sensors: {{force: {{joint-force: hinge}}, corner: {{position: bar/corner_111}}}}}}
"""
# A chain is divided by length: at its middle, into parts of different numbers of variables.
ELEMENTS = (30, 12)
BEAMS = f"""\
buckens: 1
title: A rod of beams with two frames
gravity: [0, 0, -9.81]
materials: {{steel: {{E: 210 GPa, nu: 0.3, rho: 7850, damping: {{stiffness: 1e-5}}}}}}
sections: {{round: {{circle: {{diameter: 20 mm}}}}}}
bodies:
  rod:
    structure:
      nodes: {{start: [0, 0, 0], middle: [1, 0, 0], end: [2, 0, 0]}}
      beams:
        - {{between: [start, middle], elements: {ELEMENTS[0]}, section: round, material: steel}}
        - {{between: [middle, end], elements: {ELEMENTS[1]}, section: round, material: steel}}
    frames: 2
joints: {{hinge: {{revolute: {{between: [ground, rod/start], axis: [0, 1, 0]}}}}}}
simulation: {{duration: 5 ms, step: 0.5 ms}}
output: {{every: 0.5 ms, sensors: {{middle: {{position: rod/middle}}, end: {{position: rod/end}}, force: {{joint-force: hinge}}}}}}
"""


def from_variables(number):
    """Environment in which bodies are shared from so many variables on."""
    return {"BUCKENS_MPI_VARIABLES": str(number)}


def solid_nodes(length):
    return (length + 1) * (SIDE + 1)**2


def scalar_mass(length):
    """What the first process gets of a bar of solids whose inertia others have integrated: entries of the scalar mass matrix [bytes]."""
    return 12 * (3 * (length + 1) - 2) * (3 * (SIDE + 1) - 2)**2 + 4 * (solid_nodes(length) + 1)


def summary_of(directory):
    return json.loads((directory / "summary.json").read_text())


def expect_same(several_, one):
    assert largest_difference(sensors(several_), sensors(one)) < 1e-9
    expect_same_displacements(several_, one)
    expect_same_energies(several_, one)


@several
def test_parts_of_solids_are_distributed(buckens, mpirun, tmp_path):
    (tmp_path / "bar.yaml").write_text(SOLID)
    buckens("run", "bar.yaml", "-o", "one").must(0)
    whole, half = 3 * solid_nodes(LENGTH), 3 * solid_nodes(LENGTH // 2)
    assert summary_of(tmp_path / "one")["bodies"]["bar"]["dof"] == 2 * half, "cut across, at the middle"
    for count in (2, 3):
        out = tmp_path / f"of_{count}"
        must(mpirun(count, "run", "bar.yaml", "-o", out, environment=from_variables(half)))
        expect_same(out, tmp_path / "one")
        expect_same_stresses(out, tmp_path / "one")
        measures = summary_of(out)["measures"]
        # Orders, vectors and answers of each part's solve go to each of the others and back.
        solves = summary_of(out)["bodies"]["bar"]["solves"] / summary_of(out)["steps"]
        assert measures["messages_per_step"] > 5 * (count - 1) * solves
        assert measures["bytes_per_step"] > 0
        assert summary_of(out)["wall_seconds"]["preparation"]["factor"] > 0
        assert measures["bytes_of_whole_matrices"] == scalar_mass(LENGTH) + 2 * scalar_mass(LENGTH // 2)
    assert measures["border_share"] > 0, "parts are divided by place"
    # Here the mesh is large enough until it is cut, and each part is too small.
    must(mpirun(2, "run", "bar.yaml", "-o", "cut", environment=from_variables(whole)))
    measures = summary_of(tmp_path / "cut")["measures"]
    assert measures["messages_per_step"] == 0
    assert measures["bytes_of_whole_matrices"] == scalar_mass(LENGTH)
    expect_same(tmp_path / "cut", tmp_path / "one")


@several
def test_each_part_is_shared_by_its_own_size(buckens, mpirun, tmp_path):
    (tmp_path / "rod.yaml").write_text(BEAMS)
    buckens("run", "rod.yaml", "-o", "one").must(0)
    large, small = (6 * (elements + 1) for elements in ELEMENTS)
    assert summary_of(tmp_path / "one")["bodies"]["rod"]["dof"] == large + small
    messages = {}
    for name, limit in (("both", small), ("larger", small + 1), ("none", large + 1)):
        must(mpirun(2, "run", "rod.yaml", "-o", name, environment=from_variables(limit)))
        expect_same(tmp_path / name, tmp_path / "one")
        messages[name] = summary_of(tmp_path / name)["measures"]["messages_per_step"]
    assert messages["both"] > messages["larger"] > messages["none"] == 0
