# SPDX-License-Identifier: Apache-2.0
"""Interfaces of solid bodies through the program: beam theory, reactions, both kinds, frames, errors."""

import csv
import itertools

import numpy
import pytest

E, NU, RHO, L, B = 2.1e11, 0.3, 7850.0, 1.0, 0.1
G = E / (2 * (1 + NU))
AREA, INERTIA = B * B, B**4 / 12

BAR = """
buckens: 1
gravity: [0, GRAVITY, 0]
materials: {steel: {E: 2.1e11 Pa, nu: 0.3, rho: 7850 kg/m^3}}
bodies:
  bar:
    mesh: {box: {from: [0, -50 mm, -50 mm], size: [1 m, 0.1 m, 0.1 m], divisions: [20, 2, 2]}, material: steel}
    interfaces:
      root: {face: x0, kind: KIND}
      tip: {plane: {point: [1 m, 0, 0], normal: [1, 0, 0]}, kind: KIND}
"""

BEAM = """
buckens: 1
gravity: [0, GRAVITY, 0]
bodies:
  bar:
    beam:
      to: [1 m, 0, 0]
      elements: 20
      theory: timoshenko
      section: {rectangle: {width: 0.1 m, height: 0.1 m}}
      material: {E: 2.1e11 Pa, nu: 0.3, rho: 7850 kg/m^3}
    markers: {root: {at: start}, tip: {at: end}}
"""

HELD = """
joints:
  wall: {fixed: {between: [ground, bar/root]}}
loads:
  push: {force: {on: bar/tip, value: [0, -2 kN, 1 kN]}}
  twist: {torque: {on: bar/tip, value: [300 N m, 0, 0]}}
initial: {start: static}
simulation: {duration: 1 ms, step: 0.1 ms}
output:
  every: 1 ms
  sensors:
    tip: {position: bar/tip}
    wall: {joint-force: wall}
    hold: {joint-torque: wall}
"""

SWINGING = """
joints:
  pin: {revolute: {between: [ground, bar/root], axis: [0, 0, 1]}}
simulation: {duration: 0.1 s, step: 0.2 ms}
output:
  every: 1 ms
  sensors:
    tip: {position: bar/tip}
    pin: {joint-force: pin}
    momentum: {energy: balance}
"""


def model(body, rest, kind="average", gravity=0.0):
    return (body + rest).replace("KIND", kind).replace("GRAVITY", str(gravity))


@pytest.fixture
def sensors(buckens, tmp_path):
    """Runs a model; returns the columns of sensors.csv by name without unit."""
    runs = itertools.count()

    def call(text, *arguments):
        out = f"out{next(runs)}"
        (tmp_path / "model.yaml").write_text(text)
        buckens("run", "model.yaml", "-o", out, *arguments).must(0)
        rows = list(csv.reader((tmp_path / out / "sensors.csv").open()))
        values = numpy.array(rows[1:], dtype=float).T
        return {name.split(" [")[0]: column for name, column in zip(rows[0], values)}

    return call


# A rigid face cannot contract sideways or warp at the clamp as Timoshenko's theory allows: it is
# stiffer by some fraction of B/L.
@pytest.mark.parametrize("kind, bound", [("average", 0.01), ("rigid", 0.02)])
def test_a_cantilever_bends_like_a_timoshenko_beam_and_reactions_equal_loads(sensors, kind, bound):
    out = sensors(model(BAR, HELD, kind))
    kappa = 10 * (1 + NU) / (12 + 11 * NU)
    softness = L**3 / (3 * E * INERTIA) + L / (kappa * G * AREA)
    assert out["tip.y"][0] == pytest.approx(-2000 * softness, rel=bound)
    assert out["tip.z"][0] == pytest.approx(1000 * softness, rel=bound)
    # Loads and reaction balance to the tolerance of the static equilibrium, moments about the wall
    # to what the tip moves along the bar, 1e-7 m.
    force = numpy.array([out[f"wall.{axis}"][0] for axis in "xyz"])
    assert numpy.abs(force) == pytest.approx([0, 2000, 1000], abs=1e-4)
    moment = numpy.array([out[f"hold.{axis}"][0] for axis in "xyz"])
    assert numpy.abs(moment) == pytest.approx([300, 1000, 2000], abs=1e-3)


def test_a_pendulum_swings_like_a_timoshenko_beam(sensors):
    solid = sensors(model(BAR, SWINGING, gravity=-9.81))
    beam = sensors(model(BEAM, SWINGING, gravity=-9.81))
    fall = numpy.abs(beam["tip.y"]).max()
    assert fall > 0.05
    # As rigid bodies both are the same. The first bending vibration, some 1e-6 m at 370 Hz, differs
    # in frequency by less than a per cent, so after 37 periods its phases have come apart.
    for axis in "xy":
        assert numpy.abs(solid[f"tip.{axis}"] - beam[f"tip.{axis}"]).max() < 5e-6
    assert numpy.abs(solid["tip.z"]).max() < 1e-9


def test_rigid_and_average_bearings_give_the_same_swing(sensors):
    average = sensors(model(BAR, SWINGING, gravity=-9.81))
    rigid = sensors(model(BAR, SWINGING, "rigid", gravity=-9.81))
    difference = max(numpy.abs(average[f"tip.{a}"] - rigid[f"tip.{a}"]).max() for a in "xy")
    assert 1e-12 < difference < 1e-6
    assert numpy.abs(rigid["momentum"]).max() < 1e-5


def test_planar_models_take_interfaces(sensors):
    space = sensors(model(BAR, SWINGING, gravity=-9.81))
    plane = sensors(model("planar: xy" + BAR, SWINGING, gravity=-9.81))
    for axis in "xy":
        assert numpy.abs(space[f"tip.{axis}"] - plane[f"tip.{axis}"]).max() < 1e-9


def test_interfaces_work_on_parts_of_a_divided_body(sensors):
    one = sensors(model(BAR, SWINGING, gravity=-9.81))
    two = sensors(model(BAR, SWINGING, gravity=-9.81), "--set", "bodies.bar.frames=2")
    for axis in "xy":
        # Frames differ in the terms that one frame neglects: those of the square of the deflection.
        assert numpy.abs(one[f"tip.{axis}"] - two[f"tip.{axis}"]).max() < 1e-7


def test_check_lists_interfaces(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(model(BAR, HELD))
    text = buckens("check", "model.yaml").must(0).out
    assert "bar/root" in text and "average" in text
    bar = buckens("check", "model.yaml", "--json").must(0).json["bodies"]["bar"]
    root = bar["interfaces"]["root"]
    assert (root["kind"], root["nodes"], root["carries_moment"]) == ("average", 9, True)
    assert root["area"] == pytest.approx(0.01, rel=1e-12)
    assert root["centre"] == pytest.approx([0, 0, 0], abs=1e-15)
    assert "root" in bar["markers"]


@pytest.mark.parametrize("interface, code, words", [
    ("{face: x2}", 2, ["interface \"root\" of body \"bar\"", "no face \"x2\"", "Did you mean \"x0\"?"]),
    ("{sphere: {center: [-1, 0, 0], radius: 0.5}}", 2,
     ["no node lies in the sphere", "0.5 m away", "`tolerance`"]),
    ("{set: [corner_000, corner_001]}", 3,
     ["joint \"wall\"", "it has 2 nodes, but three are needed to carry a moment", "span a surface"]),
    ("{cylinder: {from: [0, -50 mm, 0], to: [0, 50 mm, 0], radius: 1 mm}}", 3,
     ["joint \"wall\"", "3 nodes lie on one line"]),
    ("{face: x0, kind: firm}", 2, ["interfaces.root.kind", "average", "rigid"]),
    ("{plane: {point: [0, 0, 0], normal: [0, 0, 0]}}", 2, ["interfaces.root.plane.normal"]),
])
def test_bad_interfaces_are_refused(buckens, tmp_path, interface, code, words):
    text = model(BAR, HELD).replace("{face: x0, kind: average}", interface)
    (tmp_path / "model.yaml").write_text(text)
    buckens("run", "model.yaml", "-o", "out").must(code, *words)


def test_rigid_interfaces_that_overlap_are_refused(buckens, tmp_path):
    text = model(BAR, HELD, "rigid").replace("plane: {point: [1 m, 0, 0], normal: [1, 0, 0]}", "face: y0")
    (tmp_path / "model.yaml").write_text(text)
    buckens("check", "model.yaml").must(3, "\"root\" (9 nodes)", "\"tip\" (63 nodes)",
                                        "3 nodes in common")
