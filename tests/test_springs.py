# SPDX-License-Identifier: Apache-2.0
"""Forces of springs, dampers and bushings as sensors; drives by their speed; deflections from chords and
markers; bodies that start deformed."""

import math
import pathlib

import numpy
import pytest


# ---- springs

STRUT = """
buckens: 1
bodies:
  mass: {rigid: {mass: 2 kg, inertia: [1, 1, 1]}, at: {position: [1, 0, 0]}}
joints:
  rail: {prismatic: {between: [ground, mass], axis: [1, 0, 0]}}
loads:
  strut: {spring-damper: {between: [ground, mass], stiffness: 800 N/m, damping: 6 N s/m, length: 0.9 m, force: "3*t N"}}
simulation: {duration: 0.2 s, step: 0.5 ms}
output:
  every: 10 ms
  sensors:
    strut: {spring-force: strut}
    x: {position: {of: mass, along: [1, 0, 0]}}
    v: {velocity: {of: mass, along: [1, 0, 0]}}
    a: {acceleration: {of: mass, along: [1, 0, 0]}}
"""


def test_the_force_of_a_spring_damper_is_its_tension(sensors):
    out = sensors(STRUT)
    expected = 800 * (out["x"] - 0.9) + 6 * out["v"] + 3 * out["t"]
    assert out["strut"] == pytest.approx(expected, rel=1e-9, abs=1e-9)
    # Tension pulls the mass back: Newton's law of the mass, another route through the program.
    assert out["strut"][0] == pytest.approx(80, rel=1e-12)
    assert -out["strut"] == pytest.approx(2 * out["a"], rel=1e-6, abs=1e-6)


def test_the_torque_of_a_torsional_spring_turns_back(sensors):
    out = sensors("""
buckens: 1
planar: xy
bodies: {wheel: {rigid: {mass: 1 kg, inertia: [0, 0, 0.5]}}}
joints: {hub: {revolute: {between: [ground, wheel]}}}
loads: {coil: {torsional-spring: {between: [ground, wheel], stiffness: 20 N m/rad, damping: 0.3 N m s/rad, angle: -0.4}}}
simulation: {duration: 0.2 s, step: 0.5 ms}
output:
  every: 10 ms
  sensors:
    coil: {spring-torque: coil}
    angle: {relative: {between: [ground, wheel], quantity: angle}}
    spin: {relative: {between: [ground, wheel], quantity: angular-velocity}}
""")
    expected = 20 * (out["angle"] + 0.4) + 0.3 * out["spin.z"]
    assert out["coil"] == pytest.approx(expected, rel=1e-9, abs=1e-9)
    assert out["coil"][0] == pytest.approx(8, rel=1e-12) and out["spin.z"][3] < 0


def test_bushings_have_components_in_the_axes_of_their_first_marker(sensors):
    out = sensors("""
buckens: 1
bodies:
  base: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}, at: {orientation: {axis: [0, 0, 1], angle: 90 deg}}}
  block: {rigid: {mass: 2 kg, inertia: [1, 1, 1]}, at: {orientation: {axis: [0, 0, 1], angle: 90 deg}}}
joints:
  held: {fixed: {between: [ground, base]}}
  mount:
    bushing: {between: [base, block], stiffness: [1000 N/m, 2000 N/m, 3000 N/m],
              rotational-stiffness: [10 N m/rad, 20 N m/rad, 30 N m/rad]}
loads:
  push: {force: {on: block, value: [4, 0, 0]}}
  twist: {torque: {on: block, value: [0, 0, 0.6]}}
initial: {start: static}
simulation: {duration: 1 ms, step: 0.1 ms}
output: {every: 1 ms, sensors: {force: {spring-force: mount}, torque: {spring-torque: mount}, turn: {rotation: block}}}
""")
    # The load along world x is along -y of the base; equilibrium: the bushing balances it.
    assert [out[f"force.{c}"][0] for c in "xyz"] == pytest.approx([0, -4, 0], abs=1e-6)
    assert [out[f"torque.{c}"][0] for c in "xyz"] == pytest.approx([0, 0, 0.6], abs=1e-7)


@pytest.mark.parametrize("sensor, words", [
    ("{spring-force: strutt}", ["model.yaml:13:", "strutt", "\"strut\""]),
    ("{spring-force: rail}", ["no spring-damper or bushing \"rail\"", "strut"]),
    ("{spring-torque: strut}", ["no torsional-spring or bushing \"strut\""]),
    ("{joint-force: strut}", ["\"strut\" is a load, not a joint", "`spring-force`"]),
    ("{load-force: strut}", ["\"strut\"", "opposite forces", "`spring-force`"]),
])
def test_springs_are_asked_for_by_their_sensor(buckens, tmp_path, sensor, words):
    (tmp_path / "model.yaml").write_text(STRUT.replace("{spring-force: strut}", sensor))
    buckens("check", "model.yaml").must(2, *words)


# ---- drives by speed

WHEEL = """
buckens: 1
planar: xy
bodies: {wheel: {rigid: {mass: 1 kg, inertia: [0, 0, 0.5]}}}
joints:
  hub: {revolute: {between: [ground, wheel]}}
  motor: {prescribed-rotation: {between: [ground, wheel], LAW}}
simulation: {duration: 0.5 s, step: 1 ms}
output:
  every: 10 ms
  sensors:
    angle: {relative: {between: [ground, wheel], quantity: angle}}
    spin: {angular-velocity: {of: wheel, along: [0, 0, 1]}}
    torque: {joint-torque: motor}
"""


@pytest.mark.parametrize("speed, angle", [
    ("150", lambda t: 150 * t),
    ("3000 rpm", lambda t: 100 * math.pi * t),
    ("\"80*t - 300*t^2\"", lambda t: 40 * t**2 - 100 * t**3),
    ("\"20*cos(40*t) + 5\"", lambda t: 0.5 * numpy.sin(40 * t) + 5 * t),
    ("{table: [[0, 0], [0.2, 30], [0.5, 30]]}", lambda t: numpy.where(t < 0.2, 75 * t**2, 3 + 30 * (t - 0.2))),
])
def test_a_speed_is_integrated_to_its_angle(sensors, speed, angle):
    out = sensors(WHEEL.replace("LAW", "speed: " + speed))
    assert out["angle"] == pytest.approx(angle(out["t"]), rel=1e-10, abs=1e-11)
    # Driving the angle instead gives the same motion and torque.
    if speed == "\"80*t - 300*t^2\"":
        same = sensors(WHEEL.replace("LAW", "angle: \"40*t^2 - 100*t^3\""))
        assert out["spin"] == pytest.approx(same["spin"], rel=1e-9, abs=1e-9)
        assert out["torque.z"] == pytest.approx(same["torque.z"], rel=1e-5, abs=1e-6)
        assert same["torque.z"][10] == pytest.approx(0.5 * (80 - 600 * out["t"][10]), rel=1e-4)


@pytest.mark.parametrize("law, words", [
    ("speed: 3, angle: 4", ["model.yaml:7:", "exactly one of the keys angle, speed and acceleration"]),
    ("axis: [0, 0, 1]", ["exactly one of the keys angle, speed and acceleration"]),
    ("speed: 50 Hz", ["hertz count turns"]),
])
def test_a_drive_has_one_law(buckens, tmp_path, law, words):
    (tmp_path / "model.yaml").write_text(WHEEL.replace("LAW", law))
    buckens("check", "model.yaml").must(2, *words)


# ---- deflections

ARM = """
buckens: 1
planar: xy
materials: {steel: {E: 200 GPa, nu: 0.3, rho: 7850}}
bodies:
  arm:
    beam: {from: [0, 0, 0], to: [1, 0, 0], elements: 8, section: {circle: {diameter: 10 mm}}, material: steel}
    markers: {quarter: {position: [0.25, 0, 0]}, root: {at: start, orientation: {axis: [0, 0, 1], angle: 90 deg}}}
    FRAMES
  block: {rigid: {mass: 1 kg, inertia: [0, 0, 1]}, at: {position: [3, 0, 0]}}
joints: {wall: {fixed: {between: [ground, arm/start]}}, rail: {fixed: {between: [ground, block]}}}
loads: {tip: {force: {on: arm/end, value: [0, -2 N, 0]}}}
initial: {start: static}
simulation: {duration: 1 ms, step: 0.1 ms}
output:
  every: 1 ms
  sensors:
    root: {deflection: {of: arm/end, from: arm/start}}
    turned: {deflection: {of: arm/end, from: arm/root}}
    mid: {deflection: {of: arm/mid, chord: [arm/start, arm/end]}}
    usual: {deflection: arm/mid}
    short: {deflection: {of: arm/quarter, chord: [arm/start, arm/mid]}}
"""


@pytest.mark.parametrize("frames", ["", "frames: 4"])
def test_deflections_from_markers_and_chords(sensors, frames):
    out = sensors(ARM.replace("FRAMES", frames))
    EI = 2e11 * math.pi * 0.01**4 / 64

    def sag(x):  # of the cantilever under its tip force
        return -2 * x * x * (3 - x) / (6 * EI)

    # Small deflections of linear theory: the difference is of third order, (w/L)^2.
    near = 2 * sag(1.0)**2
    assert out["root.y"][0] == pytest.approx(sag(1.0), rel=near)
    # Axes of a marker that is turned by 90 degrees: y is seen along x.
    assert out["turned.x"][0] == pytest.approx(out["root.y"][0], rel=1e-12)
    assert out["turned.y"][0] == pytest.approx(-out["root.x"][0], rel=1e-6, abs=1e-9)
    assert out["mid.y"][0] == pytest.approx(sag(0.5) - 0.5 * sag(1.0), rel=5 * near)
    assert out["mid.y"][0] == out["usual.y"][0]
    assert out["short.y"][0] == pytest.approx(sag(0.25) - 0.5 * sag(0.5), rel=5 * near)


@pytest.mark.parametrize("old, new, words", [
    ("from: arm/start", "from: block", ["not on body \"arm\"", "`relative`"]),
    ("from: arm/start", "from: arm/end", ["observed marker itself"]),
    ("from: arm/start", "from: frme", ["unknown body \"frme\""]),
    ("chord: [arm/start, arm/end]", "chord: [arm/start, block]", ["not on body \"arm\""]),
    ("chord: [arm/start, arm/end]", "chord: [arm/start, arm/end], from: frame", ["`from: chord`"]),
])
def test_deflections_need_places_on_the_body(buckens, tmp_path, old, new, words):
    assert old in ARM
    (tmp_path / "model.yaml").write_text(ARM.replace("FRAMES", "").replace(old, new, 1))
    buckens("check", "model.yaml").must(2, "model.yaml:", *words)


# ---- deformed starts

# First free-free bending mode of a beam of length 1 about its middle: cos(b x) + r cosh(b x).
B = 0.5 * 4.7300407448627040
R = math.cos(B) / math.cosh(B)
MODE = f"0.1*(cos({2 * B}*(x - 0.5)) + {R}*cosh({2 * B}*(x - 0.5)))"
SLOPE = f"0.1*{2 * B}*(-sin({2 * B}*(x - 0.5)) + {R}*sinh({2 * B}*(x - 0.5)))"

FREE = f"""
buckens: 1
planar: xy
bodies:
  arm:
    beam: {{from: [0, 0, 0], to: [1, 0, 0], elements: 16, section: {{circle: {{diameter: 10 mm}}}},
           material: {{E: 200 GPa, nu: 0.3, rho: 7850}}}}
    FRAMES
initial: {{bodies: {{arm: {{nodal-displacement: {{y: "{MODE} mm", rz: "{SLOPE} mrad"}}}}}}}}
simulation: {{duration: 40 ms, step: 0.05 ms, rho-inf: 1}}
output: {{every: 0.5 ms, sensors: {{tip: {{deflection: {{of: arm/end, from: frame}}}}, place: {{position: arm}}}}}}
"""


@pytest.mark.parametrize("frames", ["", "frames: 2"])
def test_a_beam_that_starts_in_a_mode_vibrates_in_it(sensors, frames):
    out = sensors(FREE.replace("FRAMES", frames))
    omega = (2 * B)**2 * math.sqrt(2e11 * math.pi * 0.01**4 / 64 / (7850 * math.pi * 0.01**2 / 4))
    amplitude = 1e-4 * 2 * math.cos(B)
    # Two and a half periods; the phase error of the step, (h omega)^2/12 per radian, and of the mesh
    # stay below 1e-3; other modes that the nodal values excite are as small.
    assert omega * 0.04 > 10
    assert out["tip.y"] == pytest.approx(amplitude * numpy.cos(omega * out["t"]), abs=4e-3 * abs(amplitude))
    if not frames:  # of several frames the mass centre as placed is a point of the mesh
        assert abs(out["place.y"]).max() < 1e-12


def test_rigid_motion_in_a_shape_is_sieved(sensors):
    moved = FREE.replace("FRAMES", "").replace("y: \"", "y: \"3 + 0.2*x + ").replace("rz: \"", "rz: \"0.2 + ")
    a, b = sensors(moved), sensors(FREE.replace("FRAMES", ""))
    assert a["tip.y"] == pytest.approx(b["tip.y"], abs=1e-9)


def test_joints_close_with_the_deformed_body(sensors):
    pinned = FREE.replace("FRAMES", "").replace("initial:", "joints: {pin: {revolute: {between: [ground, arm/start]}}}\ninitial:")
    out = sensors(pinned.replace("place: {position: arm}", "place: {position: arm/start}, turn: {rotation: arm/start}"))
    assert abs(out["place.y"]).max() < 1e-11
    # The frame gives way: its start is displaced by the amplitude as before.
    assert out["tip.y"][0] == pytest.approx(2e-4 * math.cos(B), rel=1e-3)


@pytest.mark.parametrize("old, new, words", [
    ("y: \"", "y: \"1 + ", None),
    ("initial: {", "initial: {start: static, ", ["\"arm\"", "static equilibrium", "nodal-displacement"]),
    ("    FRAMES", "    flexibility: quasi-static", ["\"arm\"", "quasi-static", "nodal-displacement"]),
    (" mrad", " mm", ["rz", "an angle"]),
])
def test_shapes_that_cannot_be(buckens, tmp_path, old, new, words):
    assert old in FREE
    (tmp_path / "model.yaml").write_text(FREE.replace(old, new).replace("FRAMES", ""))
    if words is None:
        buckens("check", "model.yaml").must(0)
    else:
        buckens("check", "model.yaml").must(2, *words)
