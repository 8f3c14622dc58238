# SPDX-License-Identifier: Apache-2.0
"""Joints that start with given coordinates, and drives by speed and acceleration."""

import math

import numpy
import pytest

CRANK = """
buckens: 1
planar: xy
bodies:
  crank: {rigid: {mass: 1 kg, com: [75 mm, 0, 0], inertia: [0, 0, 0.002]}, markers: {pin: {position: [150 mm, 0, 0]}}}
  rod: {rigid: {mass: 0.5 kg, com: [150 mm, 0, 0], inertia: [0, 0, 0.004]}, markers: {pin: {position: [300 mm, 0, 0]}},
        at: {position: [150 mm, 0, 0]}}
  slider: {rigid: {mass: 0.2 kg, inertia: [0, 0, 1e-4]}, at: {position: [450 mm, 0, 0]}}
joints:
  shaft: {revolute: {between: [ground, crank/origin]}}
  big: {revolute: {between: [crank/pin, rod/origin]}}
  small: {revolute: {between: [rod/pin, slider]}}
  guide: {prismatic: {between: [ground, slider], axis: [1, 0, 0]}}
initial: {joints: {START}}
simulation: {duration: 1 ms, step: 1 ms}
output: {every: 1 ms, sensors: {shaft: {joint-coordinate: shaft}, guide: {joint-coordinate: guide}}}
"""


def test_a_loop_closes_about_the_angle_it_starts_with(sensors, buckens, tmp_path):
    """Also through the angle at which rod and crank lie over one another, and over whole turns."""
    r, l, w = 0.15, 0.3, 2.0
    for degrees in (40, -110, 400):
        out = sensors(CRANK.replace("START", f"shaft: {{angle: {degrees} deg, speed: {w} rad/s}}"))
        a = math.radians(degrees)
        root = math.sqrt(l**2 - (r * math.sin(a))**2)
        # Assembly closes to 1e-12 of the model's length.
        assert out["shaft.value"][0] == pytest.approx(a, abs=1e-11)
        assert out["shaft.rate"][0] == pytest.approx(w, abs=1e-9)
        assert out["guide.value"][0] == pytest.approx(r * math.cos(a) + root - 0.45, abs=1e-11)
        assert out["guide.rate"][0] == pytest.approx(
            -r * math.sin(a) * w * (1 + r * math.cos(a) / root), abs=1e-9)
    # Both that fit together, and both that do not.
    out = sensors(CRANK.replace("START", "shaft: {angle: 90 deg}, guide: {displacement: -190.1923788646684 mm}"))
    assert out["guide.value"][0] == pytest.approx(math.sqrt(0.0675) - 0.45, abs=1e-11)
    (tmp_path / "model.yaml").write_text(CRANK.replace("START", "shaft: {angle: 90 deg}, guide: {displacement: 5 mm}"))
    buckens("run", "model.yaml", "-o", "out2").must(
        3, "model.yaml:14:", "initial.joints", "\"shaft\" at", "\"guide\" at", "0.005", "correct or remove")
    (tmp_path / "model.yaml").write_text(CRANK.replace("START", "shaft: {angle: 90 deg, speed: 1}, guide: {velocity: 1}"))
    buckens("run", "model.yaml", "-o", "out3").must(3, "do not allow these speeds", "\"guide\" at", "m/s where 1")


def test_a_screw_starts_after_whole_turns(sensors):
    out = sensors("""
buckens: 1
bodies: {nut: {rigid: {mass: 1 kg, inertia: [1e-4, 1e-4, 1e-4]}}}
joints: {thread: {screw: {between: [ground, nut], axis: [0, 0, 1], pitch: 10 mm}}}
initial: {joints: {thread: {angle: 900 deg, speed: 6.283185307179586}}}
simulation: {duration: 1 ms, step: 1 ms}
output: {sensors: {z: {position: {of: nut, along: [0, 0, 1]}}, v: {velocity: {of: nut, along: [0, 0, 1]}}, turn: {joint-coordinate: thread}}}
""")
    assert out["turn.value"][0] == pytest.approx(5 * math.pi, abs=1e-11)
    assert out["z"][0] == pytest.approx(0.025, abs=1e-12)
    assert out["v"][0] == pytest.approx(0.01, abs=1e-12)


@pytest.mark.parametrize("start, words", [
    ("shaf: {angle: 1}", ["unknown joint \"shaf\"", "shaft"]),
    ("shaft: {displacement: 1}", ["\"shaft\" is a revolute", "no displacement", "guide"]),
    ("shaft: {}", ["at least one of the keys"]),
    ("shaft: {angle: 1}}, start: static, bodies: {", ["equilibrium determines", "\"shaft\""]),
])
def test_starts_that_make_no_sense_are_refused(buckens, tmp_path, start, words):
    (tmp_path / "model.yaml").write_text(CRANK.replace("START", start))
    buckens("check", "model.yaml").must(2, "model.yaml:14:", *words)


def test_stops_are_judged_by_the_start(buckens, tmp_path):
    stop = "loads: {end: {hinge-stop: {joint: shaft, from: 20 deg, to: 60 deg, stiffness: 1e4}}}\ninitial:"
    text = CRANK.replace("initial:", stop)
    (tmp_path / "model.yaml").write_text(text.replace("START", "shaft: {angle: 40 deg}"))
    buckens("check", "model.yaml").must(0)
    (tmp_path / "model.yaml").write_text(text.replace("START", "shaft: {angle: 70 deg}"))
    buckens("check", "model.yaml").must(2, "model.yaml:14:", "starts at 1.22173 rad", "outside its stops")


DRIVES = """
buckens: 1
bodies:
  wheel: {rigid: {mass: 1 kg, inertia: [0.1, 0.1, 0.1]}}
  sled: {rigid: {mass: 2 kg, inertia: [1, 1, 1]}}
  cart: {rigid: {mass: 2 kg, inertia: [1, 1, 1]}}
joints:
  pin: {revolute: {between: [ground, wheel], axis: [0, 0, 1]}}
  way: {prismatic: {between: [ground, sled], axis: [1, 0, 0]}}
  rail: {prismatic: {between: [ground, cart], axis: [0, 1, 0]}}
  spin: {prescribed-rotation: {between: [ground, wheel], axis: [0, 0, 1], acceleration: "6*t rad/s^2"}}
  push: {prescribed-translation: {between: [ground, sled], axis: [1, 0, 0], velocity: "2*cos(3*t) m/s"}}
  pull: {prescribed-translation: {between: [ground, cart], axis: [0, 1, 0], acceleration: 500 mm/s^2}}
simulation: {duration: 2 s, step: 10 ms}
output:
  every: 0.1 s
  sensors: {pin: {joint-coordinate: pin}, way: {joint-coordinate: way}, rail: {joint-coordinate: rail},
            work: {energy: work}, balance: {energy: balance}}
"""


def test_drives_by_speed_and_acceleration_do_not_drift(sensors, buckens, tmp_path):
    out = sensors(DRIVES)
    t = out["t"]
    # Positions are held by the integrals of the laws themselves.
    assert out["pin.value"] == pytest.approx(t**3, abs=1e-11)
    assert out["pin.rate"][-1] == pytest.approx(12, abs=1e-9)
    assert out["way.value"] == pytest.approx(2 / 3 * numpy.sin(3 * t), abs=1e-11)
    assert out["rail.value"] == pytest.approx(0.25 * t**2, abs=1e-11)
    kinetic = 0.5 * 0.1 * 12**2 + (2 * math.cos(6))**2 - 4 + 1
    assert out["work"][-1] == pytest.approx(kinetic, rel=1e-3)  # of the order h²
    (tmp_path / "model.yaml").write_text(DRIVES.replace("velocity: \"2*cos(3*t) m/s\"", "velocity: 1, displacement: 2"))
    buckens("check", "model.yaml").must(2, "model.yaml:12:", "exactly one of the keys displacement, velocity and acceleration")
