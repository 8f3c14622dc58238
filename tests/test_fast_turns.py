# SPDX-License-Identifier: Apache-2.0
"""Wheels that pass several turns in a step: their angles, and whatever is measured or held by them."""

import math

import numpy
import pytest

SPEED = 100_000 * 2 * math.pi / 60  # 10.47 rad in a step of 1 ms

WHEELS = """
buckens: 1
bodies:
  a: {rigid: {mass: 1, inertia: [0.01, 0.01, 0.01]}}
  b: {rigid: {mass: 1, inertia: [0.02, 0.02, 0.02]}, at: {position: [0.3, 0, 0]}, markers: {rim: {position: [0.1, 0, 0]}}}
joints:
  a: {revolute: {between: [ground, a], axis: [0, 0, 1]}}
  b: {revolute: {between: [{ground: [0.3, 0, 0]}, b], axis: [0, 0, 1]}}
  JOINT
LOADS
initial: {joints: {a: {speed: 100000 rpm}}}
simulation: {duration: 0.1 s, step: STEP ms}
output:
  every: 1 ms
  sensors: {a: {joint-coordinate: a}, b: {joint-coordinate: b}, rim: {position: b/rim}, balance: {energy: balance}}
"""

PAIRS = {
    # teeth that do not stand alike after a turn of either wheel
    "gear": ("g: {gear: {between: [a, b], axis: [0, 0, 1], teeth: [20, 30]}}", -20 / 30),
    "belt": ("g: {belt: {between: [a, b], axis: [0, 0, 1], radii: [17 mm, 29 mm]}}", 17 / 29),
    "coupler": ("g: {coupler: {of: {a: 1, b: 0.7}}}", -1 / 0.7),
}


def model(joint, step=1.0, loads=""):
    text = WHEELS.replace("  JOINT\n", f"  {joint}\n" if joint else "").replace("STEP", f"{step:g}")
    return text.replace("LOADS", f"loads: {{{loads}}}" if loads else "")


@pytest.mark.parametrize("method", ["generalized-alpha", "newmark"])
@pytest.mark.parametrize("kind", PAIRS)
def test_wheels_are_held_by_each_other(sensors, kind, method):
    joint, ratio = PAIRS[kind]
    out = sensors(model(joint).replace("step: 1 ms", f"step: 1 ms, method: {method}"))
    # At constant speed the method has no error; angles of 1000 rad are rounded by 1e-13.
    assert out["a.value"] == pytest.approx(SPEED * out["t"], abs=1e-9)
    assert out["b.value"] == pytest.approx(ratio * SPEED * out["t"], abs=1e-9)
    # The body itself, not only how it is counted.
    assert out["rim.x"] == pytest.approx(0.3 + 0.1 * numpy.cos(ratio * SPEED * out["t"]), abs=1e-10)
    assert numpy.abs(out["balance"]).max() < 1e-6 * 0.5 * 0.01 * SPEED**2


ELASTIC = {
    "elastic-belt": ("belt: {elastic-belt: {between: [a, b], axis: [0, 0, 1], radii: [17 mm, 29 mm], stiffness: 2 MN, pretension: 1 kN}}", 17 / 29),
    "elastic-gear": ("teeth: {elastic-gear: {between: [a, b], axis: [0, 0, 1], teeth: [20, 30], stiffness: 1e8 N/m}}", -20 / 30),
    "cable": ("rope: {cable: {pulleys: [{on: a, radius: 17 mm}, {on: b, radius: 29 mm}], axis: [0, 0, 1], stiffness: 2 MN, pretension: 1 kN}}", 17 / 29),
}


@pytest.mark.parametrize("kind", ELASTIC)
def test_elastic_belts_gears_and_cables_follow(sensors, kind):
    """Nothing is stretched at constant speeds; half a turn miscounted would tear the belt by 50 mm."""
    load, ratio = ELASTIC[kind]
    out = sensors(model("", loads=load).replace("rpm}", f"rpm}}, b: {{speed: {ratio * SPEED}}}"))
    # Angles of 1000 rad are rounded by 1e-13, and belts stretched by what is missing.
    assert out["a.value"] == pytest.approx(SPEED * out["t"], abs=1e-10)
    assert out["b.value"] == pytest.approx(ratio * SPEED * out["t"], abs=1e-10)
    assert numpy.abs(out["balance"]).max() < 1e-12 * 0.5 * 0.01 * SPEED**2


RAIL = """
buckens: 1
bodies:
  wheel: {rigid: {mass: 1, inertia: [0.01, 0.01, 0.01]}}
  rail: {rigid: {mass: 1, inertia: [0.01, 0.01, 0.01]}, at: {position: [0, -0.02, 0]}}
joints:
  wheel: {revolute: {between: [ground, wheel], axis: [0, 0, 1]}}
  rail: {prismatic: {between: [{ground: [0, -0.02, 0]}, rail], axis: [1, 0, 0]}}
  g: {rack: {between: [rail, wheel], axis: [0, 0, 1], along: [1, 0, 0], radius: 20 mm}}
simulation: {duration: 0.1 s, step: 1 ms}
output: {every: 1 ms, sensors: {rail: {joint-coordinate: rail}}}
"""


def test_a_rack_passes_under_its_pinion(sensors):
    out = sensors(RAIL.replace("sensors: {", "sensors: {wheel: {joint-coordinate: wheel}, ")
                  + "initial: {joints: {wheel: {speed: 100000 rpm}}}\n")
    assert out["wheel.value"] == pytest.approx(SPEED * out["t"], abs=1e-9)
    assert out["rail.value"] == pytest.approx(-0.02 * SPEED * out["t"], abs=1e-10)


@pytest.mark.parametrize("method", ["generalized-alpha", "hht", "newmark", "wilson"])
def test_a_spring_on_an_angle_sees_all_turns(sensors, method):
    """4000 rad/s are 4 rad in a step; the spring turns the wheel back after some 40 turns."""
    out = sensors(f"""
buckens: 1
bodies: {{a: {{rigid: {{mass: 1, inertia: [0.01, 0.01, 0.01]}}}}}}
joints: {{j: {{cylindrical: {{between: [ground, a], axis: [0, 0, 1]}}}}}}
loads: {{spring: {{hinge-spring: {{joint: j, stiffness: 1.0}}}}}}
initial: {{joints: {{j: {{speed: 4000}}}}}}
simulation: {{duration: 1 s, step: 1 ms, method: {method}}}
output: {{every: 1 ms, sensors: {{j: {{joint-coordinate: {{joint: j, which: angle}}}}, spring: {{spring-torque: spring}}}}}}
""")
    assert out["j.value"] == pytest.approx(400 * numpy.sin(10 * out["t"]), abs=400 * 10 * 0.01**2)  # (w h)² of w t
    assert out["spring"] == pytest.approx(out["j.value"], rel=1e-12, abs=1e-12)


def test_a_wheel_rolls_several_turns_in_a_step(sensors):
    out = sensors("""
buckens: 1
planar: zx
bodies: {wheel: {rigid: {mass: 2 kg, inertia: [0, 1e-4, 0]}, at: {position: [0, 0, 0.01]}}}
joints: {track: {rolling: {between: [ground, wheel], normal: [0, 0, 1], radius: 10 mm}}}
initial: {joints: {track: {speed: 20000}}}
simulation: {duration: 20 ms, step: 1 ms}
output:
  every: 1 ms
  sensors: {p: {position: wheel}, angle: {joint-coordinate: {joint: track, which: angle}}, way: {joint-coordinate: {joint: track, which: displacement}}}
""")
    assert out["angle.value"] == pytest.approx(20000 * out["t"], abs=1e-9)
    assert out["way.value"] == pytest.approx(200 * out["t"], abs=1e-10)
    assert out["p.x"] == pytest.approx(200 * out["t"], abs=1e-10)


SPIN_UP = """
buckens: 1
bodies: {a: {rigid: {mass: 1, inertia: [1e-3, 1e-3, 1e-3]}}}
joints: {j: {revolute: {between: [ground, a], axis: [0, 0, 1]}}}
loads: {motor: {hinge-motor: {joint: j, torque: 1e4}}}
simulation: {duration: 10 ms, step: 1 ms}
output: {every: 1 ms, sensors: {j: {joint-coordinate: j}}}
"""


def test_a_step_in_which_turns_cannot_be_counted_is_shortened(sensors):
    """1e7 rad/s²: 10 000 rad/s more after each step of 1 ms, and 500 rad in all. Constant acceleration is exact."""
    out = sensors(SPIN_UP)
    assert out["j.value"] == pytest.approx(0.5e7 * out["t"] ** 2, abs=1e-9)


def test_a_step_that_cannot_be_shortened_enough_says_so(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(SPIN_UP.replace("1e4", "1e16"))
    run = buckens("run", "model.yaml", "-o", "out")
    assert run.code != 0
    assert 'joint "j" goes from 0 to ' in run.err and "use a smaller step" in run.err


PUSH = "push: {torque: {on: a, value: [0, 0, 1e16]}}"


@pytest.mark.parametrize("text, named", [
    (model(PAIRS["gear"][0], loads=PUSH), 'joint "g": the speed of its first wheel goes from 0 to'),
    (model(PAIRS["belt"][0], loads=PUSH), 'joint "g": the speed of its first wheel goes from 0 to'),
    (RAIL + "loads: {" + PUSH.replace("on: a", "on: wheel") + "}\n", 'joint "g": the speed of its pinion goes from 0 to'),
    (model("", loads=f"{ELASTIC['elastic-belt'][0]}, {PUSH}"), 'load "belt": the speed of its first pulley goes from 0 to'),
    (model("", loads=f"{ELASTIC['elastic-gear'][0]}, {PUSH}"), 'load "teeth": the speed of its first wheel goes from 0 to'),
    (model("", loads=f"{ELASTIC['cable'][0]}, {PUSH}"), 'load "rope": the speed of its pulley 1 goes from 0 to'),
], ids=["gear", "belt", "rack", "elastic belt", "elastic gear", "cable"])
def test_what_counts_turns_of_its_own_says_so(buckens, tmp_path, text, named):
    """Nothing else measures the angles: they are told by the rows or loads."""
    text = text.replace("initial: {joints: {a: {speed: 100000 rpm}}}\n", "")
    text = text.replace("a: {joint-coordinate: a}, b: {joint-coordinate: b}, ", "")
    (tmp_path / "model.yaml").write_text(text)
    buckens("run", "model.yaml", "-o", "out").must(4, named, "use a smaller step than that")
