# SPDX-License-Identifier: Apache-2.0
"""Bodies of solid elements through the program."""

import csv
import json

import h5py
import numpy
import pytest

from conftest import SOURCE

FREE_FREE = SOURCE / "verification" / "free_free_hex8"

HANGING = """
buckens: 1
gravity: [0, 0, -9.81 m/s^2]
parameters: {rho: 7850, L: 2 m}
bodies:
  bar:
    mesh:
      box: {size: [0.2 m, 0.2 m, L], divisions: [2, 2, 20], element: hex8, integration: full}
      material: {E: 210 GPa, nu: 0.3, rho: rho}
joints:
  hook: {spherical: {between: [{ground: [0, 0, L]}, bar/corner_001]}}
  nail: {spherical: {between: [{ground: [0.2 m, 0.2 m, L]}, bar/corner_111]}}
initial: {start: static}
simulation: {duration: 1 ms, step: 0.1 ms}
output:
  every: 1 ms
  sensors:
    middle: {stress: bar/centre}
    low: {stress: {of: bar, element: 17}}
    peak: {stress: bar}
    pull: {joint-force: hook}
    hold: {joint-force: nail}
"""


@pytest.fixture
def sensors(buckens, tmp_path):
    """Runs a model; returns the columns of sensors.csv by name without unit."""
    def call(text, *arguments):
        (tmp_path / "model.yaml").write_text(text)
        buckens("run", "model.yaml", "-o", "out", *arguments).must(0)
        rows = list(csv.reader((tmp_path / "out" / "sensors.csv").open()))
        values = numpy.array(rows[1:], dtype=float).T
        return {name.split(" [")[0]: column for name, column in zip(rows[0], values)}

    return call


@pytest.mark.parametrize("model, name", [("block.yaml", "A_4x2x1"), ("cube.yaml", "C_1elem_cube")])
def test_free_blocks_have_the_known_frequencies(buckens, model, name):
    known = json.loads((FREE_FREE / "reference.json").read_text())["hex8"][name]["freq_Hz"]
    report = buckens("modes", FREE_FREE / model, "--count", len(known), "--json").must(0).json
    found = [mode["frequency"] for mode in report["analyses"][0]["modes"]]
    # Tolerance requested; rounding allows eps (omega_max/omega)^2 < 1e-12.
    assert found == pytest.approx(known, rel=1e-10)


def test_a_hanging_bar_carries_what_is_below(sensors):
    out = sensors(HANGING)
    weight = 7850 * 9.81
    # Away from the ends the stress is that of the weight below (Saint-Venant): at five widths from
    # the hooks, and at the centre of the first element of the fifth layer.
    assert out["middle.mises"] == pytest.approx(weight * 1.0, rel=1e-3)
    assert out["low.mises"] == pytest.approx(weight * 0.45, rel=2e-3)
    # It is held at two nodes, where stresses rise.
    assert (out["peak.mises"] > 2 * weight * 2.0).all()
    assert out["pull.z"] + out["hold.z"] == pytest.approx(weight * 2 * 0.04, rel=1e-6)


def test_results_hold_the_surface_and_stresses(sensors, tmp_path):
    sensors(HANGING)
    with h5py.File(tmp_path / "out" / "results.h5", "r", swmr=True) as file:
        body = file["geometry/bodies/bar"]
        assert body.attrs["kind"] in (b"solid", "solid")
        faces = body["faces"][:]
        assert faces.shape == (2 * (4 + 40 + 40), 4)
        nodes = body["nodes"][:]
        corners = nodes[faces]
        areas = 0.5 * numpy.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
        volume = numpy.einsum("fi,fi->", corners.mean(axis=1), areas) / 3
        assert volume == pytest.approx(0.2 * 0.2 * 2, rel=1e-12)
        assert file["bodies/bar/solid_stress"].shape == (2, 80)
        assert "stress" not in file["bodies/bar"]


def test_check_counts_solid_elements(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(HANGING)
    bar = buckens("check", "model.yaml", "--json").must(0).json["bodies"]["bar"]
    assert (bar["nodes"], bar["elements"]) == (189, 80)
    assert bar["mass"] == pytest.approx(7850 * 0.08, rel=1e-12)


@pytest.mark.parametrize("change, code, words", [
    ("bodies.bar.mesh.box.divisions=[2,0,20]", 2, ["divisions.1", "must be positive"]),
    ("bodies.bar.mesh.box.size=[1,-1,1]", 2, ["size.1", "must be positive"]),
    ("bodies.bar.mesh.material.nu=0.5", 3, ["\"bar\"", "use 0.49 for rubber"]),
    ("bodies.bar.mesh.box.divisions=[3,3,20]", 2, ["centre", "has no marker"]),
])
def test_bad_solids_are_refused(buckens, tmp_path, change, code, words):
    (tmp_path / "model.yaml").write_text(HANGING)
    buckens("run", "model.yaml", "-o", "out", "--set", change).must(code, *words)


def test_joints_that_hold_a_direction_need_rotations(buckens, tmp_path):
    hinge = HANGING.replace("hook: {spherical: {", "hook: {fixed: {")
    (tmp_path / "model.yaml").write_text(hinge)
    buckens("run", "model.yaml", "-o", "out").must(
        3, "joint \"hook\"", "solids have no rotations there", "spherical joints at several nodes")


def test_chords_need_ends(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(HANGING)
    sensor = "output.sensors.low={deflection: bar/centre}"
    buckens("check", "model.yaml", "--set", sensor).must(
        2, "from", "no marker \"start\"", "write `from: frame`")
    sensor = "output.sensors.low={deflection: {of: bar/centre, from: frame}}"
    buckens("check", "model.yaml", "--set", sensor).must(0)


MIXED = """
buckens: 1
gravity: [0, 0, -9.81 m/s^2]
materials: {{steel: {{E: 210 GPa, nu: 0.3, rho: 7850}}}}
sections: {{round: {{circle: {{diameter: 50 mm}}}}}}
bodies:
  lump:
    structure:
      nodes: {{a: [0, 0, 0], b: [1, 0, 0], c: [1, 1, 0], d: [0, 1, 0],
              e: [0, 0, 1], f: [1, 0, 1], g: [1, 1, 1], h: [0, 1, 1], tip: [3, 0, 0]}}
      solids: [{{nodes: [a, b, c, d, e, f, g, h], element: hex8, integration: full, material: steel}}]
      beams:
{beams}
joints:
  one: {{spherical: {{between: [ground, lump/a]}}}}
  two: {{spherical: {{between: [{{ground: [0, 1, 0]}}, lump/d]}}}}
  three: {{spherical: {{between: [{{ground: [0, 0, 1]}}, lump/e]}}}}
initial: {{start: static}}
simulation: {{duration: 1 ms, step: 0.1 ms}}
output:
  every: 1 ms
  sensors:
    root: {{section-force: {{of: lump, element: {root}}}}}
    peak: {{stress: lump}}
    corner: {{stress: {{of: lump, element: {solid}}}}}
"""


def beams(*ends):
    return "\n".join(f"        - {{between: [{a}, {b}], elements: 2, section: round, material: steel}}"
                     for a, b in ends)


def test_beams_and_solids_share_nodes(sensors):
    # Edges b-a and b-c turn with the corner b and hold the beam that juts out.
    out = sensors(MIXED.format(beams=beams("ab", "bc", ("b", "tip")), root=5, solid=7))
    weight = 7850 * 9.81 * numpy.pi * 0.025**2 * 2
    # The beam's own weight acts on both nodes of its elements: half an element is missing there.
    # The frame of the sagging body is tilted by 3e-4.
    assert numpy.abs(out["root.force.Qz"]) == pytest.approx(0.75 * weight, rel=1e-3)
    assert (out["peak.mises"] >= out["corner.mises"]).all() and (out["corner.mises"] > 0).all()


def test_a_beam_hinges_at_a_solid(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(MIXED.format(beams=beams(("b", "tip")), root=1, solid=3))
    buckens("run", "model.yaml", "-o", "out").must(3, "\"lump\"", "mechanism in itself")
