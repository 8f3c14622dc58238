# SPDX-License-Identifier: Apache-2.0
"""How far a wheel has rolled: angle and way of `rolling` joints, recorded, driven, braked, sprung, locked, in the plane and in space."""

import math

import numpy
import pytest

G = 9.81
INCLINE = """buckens: 1
PLANAR
gravity: [GX, 0, -9.81]
bodies: {wheel: {rigid: {mass: 2 kg, inertia: [0.06, 0.09, 0.06]}, at: {position: [0, 0, 0.3]}}}
joints: {track: {rolling: {between: [ground, wheel], normal: [0, 0, 1], AXLE radius: 0.3}}MORE}
LOADS
initial: {joints: {track: {START}}}
simulation: {duration: 1 s, step: 2 ms}
output:
  every: 0.1 s
  sensors: {p: {position: wheel}, turn: {angular-velocity: wheel}, angle: {joint-coordinate: {joint: track, which: angle}},
            way: {joint-coordinate: {joint: track, which: displacement}}, balance: {energy: balance}}
"""
# The wheel's mass as it rolls: m + J/R^2.
MASS = 2 + 0.09 / 0.09


def incline(loads="", start="angle: 0", planar=False, gx="0", more=""):
    return (INCLINE.replace("PLANAR", "planar: zx" if planar else "").replace("AXLE", "" if planar else "axle: [0, 1, 0],")
            .replace("LOADS", loads).replace("START", start).replace("GX", gx).replace("MORE", more))


@pytest.mark.parametrize("planar", [False, True])
def test_a_wheel_that_rolls_straight_has_turned_by_its_way_over_its_radius(sensors, planar):
    """Down an incline: constant acceleration, which is exact. After 4 m the wheel has made two turns."""
    out = sensors(incline(planar=planar, gx="12"), "-q")
    x = 0.5 * 12 * 2 / MASS * out["t"]**2
    assert out["p.x"] == pytest.approx(x, abs=1e-11)
    assert out["angle.value"] == pytest.approx(x / 0.3, abs=1e-10) and out["angle.value"][-1] > 4 * math.pi
    assert out["way.value"] == pytest.approx(x, abs=1e-11)
    assert out["angle.rate"] == pytest.approx(out["turn.y"], abs=1e-11)
    assert out["way.rate"] == pytest.approx(0.3 * out["turn.y"], abs=1e-11)


def test_a_wheel_on_an_arm_rolls_around(sensors):
    """A mill: the wheel rolls on a circle of 1.2 m, three times around; angle = arc/R."""
    text = """buckens: 1
gravity: [0, 0, -9.81]
bodies:
  arm: {rigid: {mass: 2 kg, inertia: [1, 1, 1]}, at: {position: [0, 0, 0.3]}, markers: {hub: {position: [1.2, 0, 0]}}}
  wheel: {rigid: {mass: 2 kg, inertia: [0.09, 0.06, 0.06]}, at: {position: [1.2, 0, 0.3]}}
joints:
  pivot: {revolute: {between: [{ground: [0, 0, 0.3]}, arm], axis: [0, 0, 1]}}
  drive: {prescribed-rotation: {between: [{ground: [0, 0, 0.3]}, arm], axis: [0, 0, 1], speed: 2 rad/s}}
  axle: {revolute: {between: [arm/hub, wheel], axis: [1, 0, 0]}}
  floor: {rolling: {between: [ground, wheel], normal: [0, 0, 1], axle: [1, 0, 0], radius: 0.3}}
simulation: {duration: 10 s, step: STEP}
output: {every: 0.5 s, sensors: {angle: {joint-coordinate: {joint: floor, which: angle}}, way: {joint-coordinate: {joint: floor, which: displacement}}, axle: {joint-coordinate: axle}}}
"""
    errors = []
    for step in ("10 ms", "5 ms"):
        out = sensors(text.replace("STEP", step), "-q")
        # Ahead is x cross z, against the way that it goes.
        errors.append(numpy.abs(out["angle.value"] + 2 * out["t"] * 1.2 / 0.3).max())
        assert out["way.value"] == pytest.approx(0.3 * out["angle.value"], abs=1e-12)
        assert out["angle.value"] == pytest.approx(out["axle.value"], abs=1e-9)
    # A share of (h w)^2/6 for the turn of the arm in a step: the axis of the wheel is not that of the step's rotation.
    assert errors[1] == pytest.approx(80 * (2 * 5e-3)**2 / 6, rel=0.05)
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.02)


DISC = """buckens: 1
gravity: [0, 0, -9.81]
bodies: {disc: {rigid: {mass: 1.5 kg, inertia: [A, A, C]}, at: {position: [0, 0, HEIGHT], orientation: {euler: [TILT, 0, 0]}}}}
joints: {floor: {rolling: {between: [ground, disc], normal: [0, 0, 1], axle: [0, 0, 1], radius: 0.3}}}
initial: {bodies: {disc: {velocity: VELOCITY, angular-velocity: TURN}}}
simulation: {duration: 4 s, step: STEP}
output: {every: 0.1 s, sensors: {p: {position: disc}, angle: {joint-coordinate: {joint: floor, which: angle}}, way: {joint-coordinate: {joint: floor, which: displacement}}}}
"""


@pytest.mark.parametrize("degrees", [90, 60])
def test_a_wheel_on_a_circle_has_turned_by_the_length_of_its_trace_over_its_radius(sensors, degrees):
    """Steady circles, upright and leaning: the contact runs on the plane as far as it does on the wheel's edge."""
    R, m, turn = 0.3, 1.5, 2.0
    A, C = R * R / 4, R * R / 2
    s, c = math.sin(math.radians(degrees)), round(math.cos(math.radians(degrees)), 15)
    # As in tests/test_travel.py; upright it rolls as fast as it likes, and falls slowly by what rounding leaves.
    spin = -6.0 if c == 0 else (A * turn**2 * s * c - G * R * c) / ((C + R * R) * turn * s)
    if c == 0:
        turn = 0.0
    a, e = numpy.array([0, -s, c]), numpy.array([0, c, s])
    w = numpy.array([0, 0, turn]) - turn * c * a + spin * a
    v = numpy.cross(w, R * e)
    own = [w[0], c * w[1] + s * w[2], c * w[2] - s * w[1]]
    errors = []
    for step in ("2 ms", "1 ms"):
        text = (DISC.replace("A, A, C", f"{m * A}, {m * A}, {m * C}").replace("HEIGHT", repr(R * s)).replace("TILT", repr(math.radians(degrees)))
                .replace("VELOCITY", str(v.tolist())).replace("TURN", str(own)).replace("STEP", step))
        out = sensors(text, "-q")
        if turn:
            # Angle of the mechanism about the middle of the circle, by the recorded places of the centre.
            middle = numpy.array([0, v[0] / turn])
            angle = numpy.unwrap(numpy.arctan2(out["p.y"] - middle[1], out["p.x"] - middle[0]))
            # The contact begins at p - R e.
            trace = abs(-R * e[1] - middle[1]) * (angle - angle[0])
        else:
            trace = out["p.x"]
        assert abs(trace[-1]) > 4.5
        assert out["way.value"] == pytest.approx(R * out["angle.value"], abs=1e-12)
        errors.append(numpy.abs(numpy.abs(out["way.value"]) - numpy.abs(trace)).max())
    assert errors[0] < 1e-3 and (errors[0] < 1e-9 or errors[0] / errors[1] > 3.5)


@pytest.mark.parametrize("planar", [False, True])
@pytest.mark.parametrize("loads", ["loads: {drive: {hinge-motor: {joint: track, torque: 1.8 N m}}}", "loads: {drive: {slide-motor: {joint: track, force: 6 N}}}"])
def test_a_motor_drives_a_wheel(sensors, planar, loads):
    """A torque along the angle is a force of torque/R at the centre: 2 m/s^2."""
    out = sensors(incline(loads, planar=planar), "-q")
    assert out["p.x"] == pytest.approx(out["t"]**2, abs=1e-10)
    assert out["angle.value"] == pytest.approx(out["t"]**2 / 0.3, abs=1e-9)
    assert numpy.abs(out["balance"]).max() < 1e-9


def test_a_wheel_starts_with_a_speed_and_is_braked(sensors):
    out = sensors(incline("loads: {brake: {slide-brake: {joint: track, force: 6 N}}}", "speed: \"1/0.3 rad/s\""), "-q")
    t = numpy.minimum(out["t"], 0.5)
    # It stops within a step and stays.
    assert out["p.x"] == pytest.approx(t - t**2, abs=1e-5)
    assert abs(out["way.rate"][-1]) < 1e-12


def test_a_wheel_starts_turned_and_swings_on_a_spring(sensors):
    """The period is that of the whole inertia; a turned start rolls the wheel there or turns it on the spot, its angle is what is asked for."""
    errors = []
    for step in ("2 ms", "1 ms"):
        out = sensors(incline("loads: {coil: {hinge-spring: {joint: track, stiffness: 27 N m/rad}}}", "angle: 0.4").replace("step: 2 ms", "step: " + step), "-q")
        # 27 N m/rad / R^2 = 300 N/m on 3 kg.
        errors.append(numpy.abs(out["angle.value"] - 0.4 * numpy.cos(10 * out["t"])).max())
    assert errors[0] < 1e-3 and errors[0] / errors[1] == pytest.approx(4, rel=0.02)


def test_a_wheel_is_driven_along_its_way(sensors):
    out = sensors(incline(more=", ahead: {prescribed-coordinate: {joint: track, which: displacement, displacement: \"0.5*t^2 m\"}}").replace("START", ""), "-q")
    assert out["p.x"] == pytest.approx(0.5 * out["t"]**2, abs=1e-9)
    assert out["angle.value"] == pytest.approx(0.5 * out["t"]**2 / 0.3, abs=1e-8)


def test_signals_read_the_way_and_an_event_locks_the_wheel(sensors):
    """At 0.3 m the wheel is locked: it stands from there on."""
    text = incline("signals: {way: {joint-displacement: track}, angle: {joint-angle: track}, there: \"way - 0.3 + 0*angle\"}\n"
                   "events: {stop: {when: there, direction: rising, lock: track}}", "speed: 5 rad/s")
    out = sensors(text, "-q")
    assert out["way.value"][-1] == pytest.approx(0.3, abs=1.5 * 2e-3 / 16 + 1e-9)
    assert abs(out["way.rate"][-1]) < 1e-12
    assert numpy.ptp(out["p.x"][out["t"] > 0.25]) < 1e-9


def test_two_wheels_are_coupled_by_their_ways(sensors):
    text = """buckens: 1
gravity: [0, 0, -9.81]
bodies:
  a: {rigid: {mass: 2 kg, inertia: [0.06, 0.09, 0.06]}, at: {position: [0, 0, 0.3]}}
  b: {rigid: {mass: 2 kg, inertia: [0.06, 0.09, 0.06]}, at: {position: [0, 2, 0.3]}}
joints:
  first: {rolling: {between: [ground, a], normal: [0, 0, 1], axle: [0, 1, 0], radius: 0.3}}
  second: {rolling: {between: [ground, b], normal: [0, 0, 1], axle: [0, 1, 0], radius: 0.3}}
  both: {coupler: {of: {first: {which: displacement, times: 1}, second: {which: displacement, times: -2}}}}
loads: {push: {force: {on: a, value: [7.5, 0, 0]}}}
simulation: {duration: 1 s, step: 2 ms}
output: {every: 0.1 s, sensors: {a: {position: a}, b: {position: b}}}
"""
    out = sensors(text, "-q")
    # 3 kg and a quarter of 3 kg.
    assert out["a.x"] == pytest.approx(0.5 * 2 * out["t"]**2, abs=1e-9)
    assert out["b.x"] == pytest.approx(0.5 * out["t"]**2, abs=1e-9)


def test_a_run_goes_on_after_turns(goes_on):
    goes_on(incline("loads: {coil: {hinge-spring: {joint: track, stiffness: 0.1 N m/rad}}}", "speed: 20 rad/s"), "1 s", "0.5 s", 11)


@pytest.mark.parametrize("loads, words", [
    ("loads: {s: {hinge-friction: {joint: track, static: 0.1, radius: 0.1}}}", ["joint \"track\" is a rolling, which rubs in a different way"]),
    ("loads: {s: {slide-friction: {joint: track, static: 0.1}}}", ["joint \"track\" is a rolling, which does not slide", "`slide-brake`"]),
])
def test_friction_of_a_wheel_is_refused(buckens, tmp_path, loads, words):
    (tmp_path / "model.yaml").write_text(incline(loads))
    buckens("check", "model.yaml").must(2, "model.yaml:", *words)
