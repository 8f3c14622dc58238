# SPDX-License-Identifier: Apache-2.0
"""Tapered and curved beams through the program. Orders and single numbers are tested in
src/buckens/fem/test/tapered_beam_test.cpp."""

import csv
import math

import pytest

E, RHO = 210e9, 7850

TAPER = """
buckens: 1
gravity: [0, 0, 0]
bodies:
  mast:
    beam: {to: [1 m, 0, 0], elements: 2, section: {circle: {diameter: 50 mm}},
           end-section: {circle: {diameter: 20 mm}}, material: {E: 210 GPa, nu: 0.3, rho: 7850}}
joints: {foot: {fixed: {between: [ground, mast/start]}}}
loads: {push: {force: {on: mast/end, value: [0, 0, 1 N]}}}
initial: {start: static}
simulation: {duration: 1 us, step: 1 us}
output: {sensors: {tip: {position: mast/end}}}
"""

# A quarter of a circle, from its foot along z to its tip along x.
HOOK = """
buckens: 1
gravity: [0, 0, 0]
bodies:
  hook:
    structure:
      nodes: {foot: [0, 0, 0], tip: [1 m, 0, 1 m]}
      beams:
        - {between: [foot, tip], elements: 32, through: [[1 - sqrt(0.5), 0, sqrt(0.5)]], path: arc,
           section: {circle: {diameter: 10 mm}}, material: {E: 210 GPa, nu: 0.25, rho: 7850}}
joints: {foot: {fixed: {between: [ground, hook/foot]}}}
loads: {push: {force: {on: hook/tip, value: [0, 0, -0.01 N]}}}
initial: {start: static}
simulation: {duration: 1 us, step: 1 us}
output: {sensors: {tip: {position: hook/tip}}}
"""


@pytest.fixture
def tip(buckens, tmp_path):
    """Last position of the tip."""
    def call(text, *options):
        (tmp_path / "model.yaml").write_text(text)
        buckens("run", "model.yaml", "-o", "out", *options).must(0)
        last = list(csv.DictReader((tmp_path / "out" / "sensors.csv").open()))[-1]
        return [float(last[f"tip.{axis} [m]"]) for axis in "xyz"]

    return call


def test_a_cone_bends_as_a_cone(tip):
    exact = 64 / (3 * math.pi * E * 0.02 * 0.05**3)
    # The static start stops at 1e-10 of the length, 3e-6 of the deflection.
    assert tip(TAPER)[2] == pytest.approx(exact, rel=1e-5)


def test_a_cone_weighs_a_cone(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(TAPER)
    mast = buckens("check", "model.yaml", "--json").must(0).json["bodies"]["mast"]
    assert mast["mass"] == pytest.approx(RHO * math.pi / 12 * (0.05**2 + 0.05 * 0.02 + 0.02**2), rel=1e-12)


@pytest.mark.parametrize("first, last", [
    ("tube: {outer-diameter: 50 mm, thickness: 5 mm}", "tube: {outer-diameter: 30 mm, inner-diameter: 24 mm}"),
    ("rectangle: {width: 20 mm, height: 40 mm}", "rectangle: {width: 20 mm, height: 10 mm}"),
    ("box: {width: 40 mm, height: 60 mm, thickness: 3 mm}", "box: {width: 20 mm, height: 30 mm, thickness: 2 mm}"),
    ("general: {A: 300 mm^2, Iy: 4e4 mm^4, Iz: 1e4 mm^4, J: 2e4 mm^4}",
     "general: {A: 100 mm^2, Iy: 4e3 mm^4, Iz: 1e3 mm^4, J: 2e3 mm^4}")])
def test_every_shape_tapers(tip, first, last):
    text = TAPER.replace("circle: {diameter: 50 mm}", first).replace("circle: {diameter: 20 mm}", last)
    end_only, other = "end-section: {" + last + "},", "section: {" + first + "}"
    stiff, soft = (tip(text.replace(end_only, "").replace(other, "section: {" + part + "}"))[2]
                   for part in (first, last))
    assert stiff < tip(text)[2] < soft


def test_a_hook_bends_as_castigliano_says(tip):
    I, A = math.pi * 0.01**4 / 64, math.pi * 0.01**2 / 4
    exact = 0.01 * math.pi / 4 * (1 / (E * I) + 1 / (E * A))
    # Chords instead of the arc: at most h^2/6 of it, h = pi/64.
    assert 1 - tip(HOOK)[2] == pytest.approx(exact, rel=(math.pi / 64)**2 / 6 + 1e-4)


def test_a_tapered_hook_is_divided_into_frames(tip):
    text = HOOK.replace("section: {circle: {diameter: 10 mm}},",
                        "section: {circle: {diameter: 20 mm}}, end-section: {circle: {diameter: 10 mm}},")
    whole, parts = (1 - tip(text, f"--set=bodies.hook.frames={frames}")[2] for frames in (1, 4))
    # Deflections of 1e-5 of the length; the frames differ by their square, and the static start stops at 1e-10.
    assert parts == pytest.approx(whole, rel=1e-4)


@pytest.mark.parametrize("old, new, words", [
    ("end-section: {circle: {diameter: 20 mm}}", "end-section: {rectangle: {width: 20 mm, height: 20 mm}}",
     ["end-section", "from a circle to a rectangle", "model.yaml:7"]),
    ("elements: 2", "elements: 2, path: arc", ["path", "through"]),
    ("elements: 2", "elements: 2, path: arc, through: [[0.2, 0.1, 0], [0.5, 0.1, 0]]", ["one point between its ends"]),
    ("elements: 2", "elements: 2, path: arc, through: [[0.5, 0, 0]]", ["lie on one line", "mast"]),
    ("elements: 2", "elements: 2, path: spline, through: [[0.2, 0.1, 0], [0.5, 0.1, 0]]",
     ["2 elements", "give at least 3"]),
    ("elements: 2", "elements: 2, through: [[0, 0, 0]]", ["two points in a row"]),
    ("elements: 2", "elements: 2, path: circle", ["path", "polyline"]),
])
def test_impossible_beams_are_refused(buckens, tmp_path, old, new, words):
    (tmp_path / "model.yaml").write_text(TAPER.replace(old, new))
    buckens("check", "model.yaml").must(2, *words)
