# SPDX-License-Identifier: Apache-2.0
"""Both angles of cross joints: seen, started with, driven, sprung, stopped, coupled, in signals and events."""

import csv
import math
import re

import numpy
import pytest


def turn(axis, angle):
    """Matrix of a rotation about a unit vector."""
    x, y, z = axis
    skew = numpy.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return numpy.eye(3) + math.sin(angle) * skew + (1 - math.cos(angle)) * skew @ skew


# The second marker is not parallel to the first as placed.
PLACED = turn((0, 0.6, 0.8), 0.7)
ARMS = (0.6, 0.8, 0), (-0.8, 0.6, 0)
CROSS = """
buckens: 1
bodies:
  fork:
    rigid: {mass: 2 kg, inertia: [0.02, 0.03, 0.04]}
    at: {orientation: {axis: [0, 0.6, 0.8], angle: 0.7 rad}}
    markers: {far: {position: [0.3, 0.1, 0.2]}}
joints:
  cross: {universal: {between: [ground, fork], axis: [0.6, 0.8, 0], second-axis: [-0.8, 0.6, 0]}}
  MORE
simulation: {duration: DURATION, step: 1 ms, METHOD}
output:
  every: 10 ms
  sensors:
    one: {joint-coordinate: {joint: cross, which: angle}}
    two: {joint-coordinate: {joint: cross, which: second-angle}}
    far: {position: fork/far}
    balance: {energy: balance}
    SENSORS
"""


def model(more="", duration="1 s", method="method: generalized-alpha", sensors=""):
    return (CROSS.replace("  MORE", more).replace("DURATION", duration).replace("METHOD", method)
            .replace("    SENSORS", sensors))


def place(first, second):
    """R_FM = exp(angle b) exp(second c) as placed."""
    return turn(ARMS[0], first) @ turn(ARMS[1], second) @ PLACED @ numpy.array([0.3, 0.1, 0.2])


# The second arm in the fork's axes; between its markers the other way round the drive turns the other way.
OWN_ARM = PLACED.T @ numpy.array(ARMS[1])


@pytest.mark.parametrize("method", ["method: generalized-alpha", "method: newmark", "tolerance: 1e-5"])
def test_both_angles_are_driven_over_turns(sensors, method):
    drives = f"""
  turn: {{prescribed-rotation: {{between: [ground, fork], axis: [0.6, 0.8, 0], angle: "0.8*sin(3*t)"}}}}
  tilt: {{prescribed-rotation: {{between: [fork, ground], axis: {OWN_ARM.tolist()}, angle: "-5*t^2"}}}}
"""
    out = sensors(model(drives, "1.5 s", method))
    t = out["t"]
    # Positions are closed at the end of every step: no order of the method enters.
    assert out["one.value"] == pytest.approx(0.8 * numpy.sin(3 * t), abs=1e-9)
    assert out["two.value"] == pytest.approx(5 * t**2, abs=1e-9)
    assert out["two.value"][-1] > 3.5 * math.pi
    assert out["one.rate"] == pytest.approx(2.4 * numpy.cos(3 * t), abs=1e-7)
    assert out["two.rate"] == pytest.approx(10 * t, abs=1e-7)
    for k in range(0, len(t), 10):
        here = place(0.8 * math.sin(3 * t[k]), 5 * t[k]**2)
        assert [out[f"far.{c}"][k] for c in "xyz"] == pytest.approx(here, abs=1e-9)


def test_it_starts_with_both(sensors):
    start = "\ninitial: {joints: {cross: {angle: 400 deg, speed: 1.5, second-angle: -35 deg, second-speed: -2}}}\n"
    out = sensors(model(start, "1 ms"))
    first, second = math.radians(400), math.radians(-35)
    assert out["one.value"][0] == pytest.approx(first, abs=1e-10)
    assert out["two.value"][0] == pytest.approx(second, abs=1e-10)
    assert out["one.rate"][0] == pytest.approx(1.5, abs=1e-10)
    assert out["two.rate"][0] == pytest.approx(-2, abs=1e-10)
    assert [out[f"far.{c}"][0] for c in "xyz"] == pytest.approx(place(first, second), abs=1e-10)


def test_springs_stops_and_motors_act_on_the_second_angle(sensors):
    """Only the second arm turns: J = n·J n about it; a spring swings it, and a stop sends it back."""
    inertia = OWN_ARM @ numpy.diag([0.02, 0.03, 0.04]) @ OWN_ARM
    speed = 0.5
    # Principal axes are not those of the arm: a lock of the first angle takes the rest.
    hold = """
  hold: {prescribed-rotation: {between: [ground, fork], axis: [0.6, 0.8, 0], angle: 0}}
initial: {joints: {cross: {second-speed: 0.5}}}
loads:
  spring: {hinge-spring: {joint: cross, which: second-angle, stiffness: 3 N m/rad}}
  stop: {hinge-stop: {joint: cross, which: second-angle, to: 20 mrad, restitution: 1}}
"""
    out = sensors(model(hold, "1 s").replace("step: 1 ms", "step: 0.1 ms"))
    w = math.sqrt(3 / inertia)
    size = speed / w
    # From 0 to the stop, back to -size and to the stop again: the motion repeats after that.
    way = 2 * (math.asin(0.02 / size) / w + math.pi / 2 / w)
    t = (out["t"] - math.asin(0.02 / size) / w) % way - way / 2
    expected = -size * numpy.cos(w * t)
    # The period of Newmark's method is long by (w h)²/24, a hit is placed within the step.
    assert out["two.value"] == pytest.approx(expected, abs=2e-3 * size)
    assert abs(out["one.value"]).max() < 1e-12
    assert out["two.value"].max() < 0.02 + 1e-9


def test_signals_events_and_couplers_see_the_second_angle(sensors):
    more = """
  rail: {prismatic: {between: [ground, block], axis: [1, 0, 0]}}
  link: {coupler: {of: {cross: {times: 0.1, which: second-angle}, rail: -1}}}
initial: {joints: {cross: {second-speed: 2, speed: 1}}}
signals: {tilt: {joint-second-angle: cross}, pace: {joint-second-speed: cross}, there: "tilt - 0.5"}
events: {hold: {when: there, lock: cross}}
"""
    text = model(more, "1 s", sensors="    tilt: {signal: tilt}\n    pace: {signal: pace}\n    rail: {joint-coordinate: rail}")
    text = text.replace("bodies:", "bodies:\n  block: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}}")
    out = sensors(text)
    assert (out["tilt"] == out["two.value"]).all()
    assert (out["pace"] == out["two.rate"]).all()
    assert out["rail.value"] == pytest.approx(0.1 * out["two.value"], abs=1e-12)
    # Both angles are held, where an instant of 1/16 of a step found them.
    assert out["two.value"][-1] == pytest.approx(0.5, abs=2e-3)
    late = out["t"] > 0.6
    assert numpy.ptp(out["one.value"][late]) < 1e-10
    assert numpy.ptp(out["two.value"][late]) < 1e-10


@pytest.mark.parametrize("more, code, words", [
    ("  hinge: {revolute: {between: [ground, arm], axis: [0, 0, 1]}}\nloads: {k: {hinge-spring: {joint: hinge, which: second-angle, stiffness: 1}}}",
     2, ["loads.k.hinge-spring.which", "\"hinge\" is a revolute", "no second angle"]),
    ("loads: {k: {hinge-friction: {joint: cross, static: 0.1, radius: 1 mm}}}", 2, ["\"cross\" is a universal", "`ball-friction`"]),
    ("  drive: {prescribed-rotation: {between: [ground, fork], axis: [-0.8, 0.6, 0], angle: \"t\"}}",
     3, ["joint \"drive\"", "arm of joint \"cross\"", "swap the markers"]),
    ("initial: {joints: {hinge: {second-angle: 1}}}\n", 2, ["initial.joints.hinge.second-angle", "no second angle"]),
    ("signals: {s: {joint-second-speed: hinge}}", 2, ["signals.s.joint-second-speed", "no second angle"]),
    ("loads: {k: {hinge-stop: {joint: cross, which: second-angle, from: 0.2}}}", 2, ["starts at 0 rad, as placed", "from 0.2"]),
])
def test_what_cannot_be_is_told(buckens, tmp_path, more, code, words):
    if "hinge" in more and "revolute" not in more:
        more = "  hinge: {revolute: {between: [ground, arm], axis: [0, 0, 1]}}\n" + more
    text = model(more).replace("bodies:", "bodies:\n  arm: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}}")
    (tmp_path / "model.yaml").write_text(text)
    buckens("check", "model.yaml").must(code, *words)


SHAFTS = """
buckens: 1
parameters: {b: BEND}
bodies:
  input: {rigid: {mass: 1 kg, inertia: [0.01, 0.01, 0.01]}}
  output: {rigid: {mass: 1 kg, inertia: [0.01, 0.01, 0.01]}}
joints:
  near: {revolute: {between: [ground, input], axis: [1, 0, 0]}}
  far: {cylindrical: {between: [ground, output], axis: ["cos(b)", "sin(b)", 0]}}
  cross: {universal: {between: [input, output], axis: [0, 1, 0], second-axis: [0, 0, 1]}}
simulation: {duration: 1 ms, step: 1 ms}
"""


def test_shafts_across_each_other_are_refused(buckens, tmp_path):
    for bend in (84, -84, 96.1 + 180):
        (tmp_path / "model.yaml").write_text(SHAFTS.replace("BEND", f"{bend} deg"))
        buckens("check", "model.yaml").must(0)
    for bend in (86, 90, 94, -90):
        (tmp_path / "model.yaml").write_text(SHAFTS.replace("BEND", f"{bend} deg"))
        buckens("check", "model.yaml").must(3, "model.yaml:10:", "joint \"cross\"", "\"near\" and \"far\"",
                                            f"meet at {90 - abs(90 - abs(bend)):.4g} degrees", "singular at 90", "below 85 degrees")


# A bearing that swings, so that the shafts bend more and more.
SWING = """
buckens: 1
bodies:
  input: {rigid: {mass: 1 kg, inertia: [0.01, 0.01, 0.01]}}
  arm: {rigid: {mass: 1 kg, inertia: [0.01, 0.01, 0.01]}}
  output: {rigid: {mass: 1 kg, inertia: [0.01, 0.01, 0.01]}, at: {orientation: {axis: [0, 0, 1], angle: 60 deg}}}
joints:
  near: {revolute: {between: [ground, input], axis: [1, 0, 0]}}
  swing: {revolute: {between: [ground, arm], axis: [0, 0, 1]}}
  far: {cylindrical: {between: [arm, output], axis: [0.5, 0.8660254037844386, 0]}}
  cross: {universal: {between: [input, output], axis: [0, 1, 0], second-axis: [0, 0, 1]}}
  bend: {prescribed-rotation: {between: [ground, arm], axis: [0, 0, 1], angle: "BEND"}}
  turn: {prescribed-rotation: {between: [ground, input], axis: [1, 0, 0], angle: "TURN"}}
simulation: {duration: 1 s, METHOD}
output: {every: 10 ms, sensors: {in: {joint-coordinate: near}, out: {joint-coordinate: far}}}
"""


def swinging(bend, turned="4*t", method="step: 1 ms"):
    return SWING.replace("BEND", bend).replace("TURN", turned).replace("METHOD", method)


@pytest.mark.parametrize("turned", ["4*t", "0"])
@pytest.mark.parametrize("method", ["step: 1 ms", "step: 1 ms, method: newmark", "tolerance: 1e-5"])
def test_shafts_that_come_across_each_other_end_the_run(buckens, tmp_path, turned, method):
    """From 60 to 90 degrees at 1 rad/s; what was computed until then obeys tan(out) = tan(in)/cos(bend)."""
    (tmp_path / "model.yaml").write_text(swinging("t", turned, method))
    end = math.pi / 6
    run = buckens("run", "model.yaml", "-q", "-o", "out")
    run.must(4, "model.yaml:11:", "joint \"cross\"", f"t = {end:.6g}"[:8], "\"near\" and \"far\"", "degrees to each other", "singular at 90",
             "let the bearings swing less", "constant-velocity")
    # Where a step across 90 degrees fails, its start is told.
    told = re.search(r"at t = (\S+) s: .* have come to (\S+) degrees", run.err)
    assert math.degrees(math.pi / 3 + float(told[1])) == pytest.approx(float(told[2]), abs=6e-3)
    assert 89.5 < float(told[2]) <= 90
    lines = list(csv.reader((tmp_path / "out" / "sensors.csv").open()))
    rows = dict(zip((name.split(" ")[0] for name in lines[0]), numpy.array(lines[1:], dtype=float).T))
    t, value = rows["t"], rows["out.value"]
    assert 0.51 <= t[-1] <= end
    bend = math.pi / 3 + t
    turn_in = 4 * t if turned != "0" else 0 * t
    # As placed, the arm that the input holds lies in the plane of both shafts.
    assert numpy.cos(value) * numpy.sin(turn_in) == pytest.approx(numpy.sin(value) * numpy.cos(turn_in) * numpy.cos(bend), abs=1e-9)


def test_shafts_that_bend_by_less_go_on(sensors):
    out = sensors(swinging("0.5*sin(3*t)"))  # at most 88.6 degrees
    assert out["t"][-1] == pytest.approx(1)
