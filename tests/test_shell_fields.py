# SPDX-License-Identifier: Apache-2.0
"""Fields of shells through the program: centres, nodes, levels, axes."""

import h5py
import numpy
import pytest

from conftest import MODELS

STRIP = (MODELS / "strip.yaml").read_text()
N, M, T = 20 / 0.1, 0.01 / 0.1, 0.01  # forces and moments per length, thickness
# Fields have single precision. The pull acts on the deflected tip: it takes N w/M = N L^2/(2 D) of the moment.
CLOSE = 1e-5
ARM = N / (2 * 210e9 * T**3 / 12)


@pytest.fixture
def fields(buckens, tmp_path):
    def call(text, *options):
        (tmp_path / "model.yaml").write_text(text)
        buckens("run", "model.yaml", "-o", "out", *options).must(0)
        found = {}
        with h5py.File(tmp_path / "out" / "results.h5", "r", swmr=True) as file:
            body = file["fields/bodies/strip"]
            body.visititems(lambda name, item: found.update({name: item[-1]})
                            if isinstance(item, h5py.Dataset) else None)
            geometry = file["geometry/bodies/strip"]
            for name in ("field_nodes", "face_places", "nodes"):
                if name in geometry:
                    found[name] = geometry[name][:]
            for name in ("von_mises", "von_mises_time"):
                found[f"largest_{name}"] = file[f"extremes/bodies/strip/nodes/{name}"][:]
        return found

    return call


def test_a_strip_has_the_stresses_of_a_beam(fields):
    found = fields(STRIP)
    bend, pull = 6 * M / T**2, N / T
    force = found["shells/section_force"]
    # A torque about y stretches the top: M_x > 0 there.
    assert force[:, 0] == pytest.approx(N, rel=CLOSE)
    assert force[:, 3] == pytest.approx(M, rel=1.01 * ARM)
    assert numpy.abs(force[:, [1, 2, 4, 5, 6]]).max() < CLOSE * N
    stress, about = found["shells/stress"], 1.01 * ARM
    assert stress[:, 0, 0] == pytest.approx(pull - bend, rel=1.01 * ARM)
    assert stress[:, 1, 0] == pytest.approx(pull + bend, rel=1.01 * ARM)
    assert found["shells/von_mises"] == pytest.approx(pull + bend, rel=1.01 * ARM)
    # At nodes: the side the normal points to, in body axes.
    assert found["nodes/stress"][:, 0] == pytest.approx(pull + bend, rel=1.01 * ARM)
    assert numpy.abs(found["nodes/stress"][:, 1:]).max() < ARM * pull
    assert found["nodes/strain"][:, 0] == pytest.approx((pull + bend) / 210e9, rel=about)
    assert found["nodes/strain_energy_density"] == pytest.approx((pull + bend)**2 / 420e9, rel=2 * about)
    assert found["nodes/von_mises"] == pytest.approx(pull + bend, rel=1.01 * ARM)
    assert found["largest_von_mises"] == pytest.approx(pull + bend, rel=1.01 * ARM)
    assert (found["face_places"][:, :3] >= 0).all()
    assert len(found["field_nodes"]) == 18


def test_von_mises_is_that_of_the_worse_side(fields):
    found = fields(STRIP, "--set=loads.bend.torque.value=[0, -0.01 N m, 0]")
    bend, pull = 6 * M / T**2, N / T
    # The bottom is stretched by bending and pull, the top compressed.
    assert found["nodes/stress"][:, 0] == pytest.approx(pull - bend, rel=1.01 * ARM)
    assert found["nodes/von_mises"] == pytest.approx(pull + bend, rel=1.01 * ARM)


def test_bodies_in_parts_have_the_stresses_of_the_whole(fields):
    found = fields(STRIP, "--set=bodies.strip.frames=2")
    assert found["nodes/von_mises"] == pytest.approx(6 * M / T**2 + N / T, rel=1.01 * ARM)
    # The two nodes of the cut belong to both parts.
    assert len(found["field_nodes"]) == 20
    assert (found["face_places"] >= 0).all()


STEP = """
buckens: 1
gravity: [0, 0, 0]
materials: {steel: {E: 210 GPa, nu: 0, rho: 7850}}
bodies:
  strip:
    structure:
      nodes: {a0: [0, 0, 0], a1: [0.1, 0, 0], a2: [0.2, 0, 0], b0: [0, 0.1, 0], b1: [0.1, 0.1, 0], b2: [0.2, 0.1, 0]}
      shells:
        - {nodes: [a0, a1, b1, b0], thickness: 10 mm, material: steel}
        - {nodes: [a1, a2, b2, b1], thickness: 5 mm, material: steel}
joints: {wall: {fixed: {between: [ground, strip/a0]}}}
loads:
  hold: {force: {on: strip/b0, value: [-10 N, 0, 0]}}
  pull: {force: {on: strip/a2, value: [10 N, 0, 0]}}
  too: {force: {on: strip/b2, value: [10 N, 0, 0]}}
initial: {start: static}
simulation: {duration: 1 us, step: 1 us}
output: {fields: [stress, von-mises]}
"""


def test_nodes_where_the_thickness_changes_have_both_stresses(fields):
    found = fields(STEP)
    nodes, stress = found["field_nodes"], found["nodes/stress"][:, 0]
    thick, thin = 20 / 0.1 / 0.01, 20 / 0.1 / 0.005
    for node, expected in (0, [thick]), (1, [thick, thin]), (2, [thin]), (4, [thick, thin]):
        assert sorted(stress[nodes == node]) == pytest.approx(expected, rel=CLOSE)
    # Each face points to its own places.
    for face, expected in zip(found["face_places"], (thick, thin)):
        assert stress[face] == pytest.approx(expected, rel=CLOSE)


def test_stresses_at_nodes_can_be_left_out(fields):
    text = STRIP.replace("fields: {", "fields: {at: elements, extremes: off, ")
    with pytest.raises(KeyError):  # no extremes at nodes
        fields(text)
