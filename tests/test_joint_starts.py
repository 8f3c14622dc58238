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


SLIDER = """
buckens: 1
planar: xy
materials: {steel: {E: 200 GPa, nu: 0.3, rho: 7870 kg/m^3}}
bodies:
  wire: {beam: {to: [2, 0, 0], elements: 16, section: {circle: {diameter: 20 mm}}, material: steel}}
  bead: {rigid: {mass: 0.1 kg, inertia: [0, 0, 1e-3]}, at: {position: [0.4, 0, 0]}}
joints:
  JOINTS
  hole: {slider-on-beam: {between: [wire, bead]}}
initial: {joints: {START}BODIES}
simulation: {duration: 1 ms, step: STEP}
output:
  every: STEP
  sensors:
    way: {joint-coordinate: hole}
    p: {position: bead}
    v: {velocity: bead}
    root: {position: wire/start}
    root_v: {velocity: wire/start}
"""
SWINGS = "root: {revolute: {between: [ground, wire/start]}}"


def slider(start, bodies="", joints=SWINGS, step="1 ms"):
    return (SLIDER.replace("JOINTS", joints).replace("START", start).replace("BODIES", bodies).replace("STEP", step))


@pytest.mark.parametrize("frames", ["", ", frames: 4"])
def test_a_slider_starts_along_its_beam(sensors, frames):
    """Over nodes and parts, on a beam that swings, too: from its own place and with its own speed there."""
    text = slider("hole: {displacement: 0.93, velocity: 1.5}, root: {angle: 30 deg, speed: 2}")
    out = sensors(text.replace("material: steel}}", f"material: steel}}{frames}}}"))
    s, c, n = 1.33, math.cos(math.pi / 6), 0.5
    # Assembly closes to 1e-12 of the model's length; rates to rounding of 1e-10.
    assert out["way.value"][0] == pytest.approx(0.93, abs=1e-11)
    assert out["way.rate"][0] == pytest.approx(1.5, abs=1e-9)
    assert (out["p.x"][0], out["p.y"][0]) == pytest.approx((s * c, s * n), abs=1e-11)
    assert (out["v.x"][0], out["v.y"][0]) == pytest.approx((1.5 * c - 2 * s * n, 1.5 * n + 2 * s * c), abs=1e-9)
    # To the node at the end of the beam; the speed alone; the place alone.
    out = sensors(slider("hole: {displacement: 1.6}, root: {angle: 0, speed: 0}"))
    assert (out["way.value"][0], out["way.rate"][0]) == pytest.approx((1.6, 0), abs=1e-9)
    out = sensors(slider("hole: {velocity: -0.7}, root: {speed: 0}"))
    assert (out["way.value"][0], out["way.rate"][0], out["v.x"][0]) == pytest.approx((0, -0.7, -0.7), abs=1e-9)


def test_a_beam_starts_under_its_slider(sensors):
    """The bead rests; the beam is free to slide through."""
    out = sensors(slider("hole: {displacement: 0.5, velocity: 0.3}",
                         joints="guide: {prismatic: {between: [ground, wire/start], axis: [1, 0, 0]}}\n"
                                "  held: {fixed: {between: [{ground: [0.4, 0, 0]}, bead]}}"))
    assert (out["p.x"][0], out["v.x"][0]) == pytest.approx((0.4, 0), abs=1e-11)
    assert (out["root.x"][0], out["root_v.x"][0]) == pytest.approx((-0.5, -0.3), abs=1e-9)
    assert (out["way.value"][0], out["way.rate"][0]) == pytest.approx((0.5, 0.3), abs=1e-9)


def bent(by):
    """y = by x², a cubic that beam elements hold exactly."""
    shape = f", bodies: {{wire: {{nodal-displacement: {{y: \"{by}*x^2 m\", rz: \"{2 * by}*x rad\"}}}}}}"
    return slider("hole: {displacement: 0.77, velocity: 1.5}, root: {angle: 0, speed: 2}", shape)


def test_a_slider_starts_on_a_beam_that_is_bent_and_moves(sensors):
    """It is on the line as bent, and its velocity is that of the motion that follows."""
    out = sensors(bent(0.001))
    assert out["way.value"][0] == pytest.approx(0.77, abs=1e-11)
    assert out["way.rate"][0] == pytest.approx(1.5, abs=1e-9)
    # Along the undeformed beam; nodes do not move back as they turn by angles up to 4 mrad, whose squares are 2e-5.
    assert (out["p.x"][0], out["p.y"][0]) == pytest.approx((1.17, 0.001 * 1.17**2), abs=2e-6)
    errors = []
    for step, h in (("2 us", 2e-6), ("1 us", 1e-6)):
        text = bent(0.05).replace("1 ms, step: 1 ms", "20 us, step: " + step).replace("every: 1 ms", "every: " + step)
        out = sensors(text)
        found = numpy.array([(out[k][1] - out[k][0]) / h for k in ("p.x", "p.y", "way.value")])
        errors.append(numpy.abs(found - [out["v.x"][0], out["v.y"][0], 1.5]).max())
    # Half the acceleration times the step: a beam that is bent by 0.2 m springs back with thousands of m/s².
    assert errors[0] / errors[1] == pytest.approx(2, rel=0.1)
    assert errors[1] < 0.01


@pytest.mark.parametrize("law, start, words", [
    ("", "hole: {displacement: 1.7}", ["joint \"hole\" would start 0.1 m beyond the end of its beam of 2 m", "from -0.4 to 1.6 m"]),
    ("", "hole: {displacement: -0.5}", ["0.1 m beyond the start"]),
    (", velocity: 2 m/s", "hole: {displacement: 0.5}", ["\"hole\" is a drive"]),
    ("", "hole: {angle: 1}", ["\"hole\" is a slider-on-beam", "no angle"]),
])
def test_sliders_that_cannot_start_there_are_refused(buckens, tmp_path, law, start, words):
    text = slider(start).replace("[wire, bead]", "[wire, bead]" + law)
    (tmp_path / "model.yaml").write_text(text)
    buckens("check", "model.yaml").must(2, "model.yaml:11:", *words)
