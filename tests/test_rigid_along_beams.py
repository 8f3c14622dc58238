# SPDX-License-Identifier: Apache-2.0
"""What acts rigidly along a flexible beam: stops with impacts, friction that sticks without any motion, locks."""

import json
import math

import numpy
import pytest

G = 9.81
WIRE = """
buckens: 1
PLANE
GRAVITY
materials: {hard: {E: 1e16 Pa, nu: 0.3, rho: 10 kg/m^3}, steel: {E: 200 GPa, nu: 0.3, rho: 7850 kg/m^3}}
bodies:
  wire: {beam: {to: [4, 1, -2], elements: 16, section: {circle: {diameter: 20 mm}}, material: hard}FRAMES}
  bead: {rigid: {mass: 0.1 kg, inertia: [1, 1, 1]}, at: {position: [0.4, 0.1, -0.2]}}
joints:
  LEFT
  hole: {slider-on-beam: {between: [wire, bead]}}
loads: {LOADS}
MORE
simulation: {duration: 1 s, step: STEP}
output: {every: 10 ms, sensors: {way: {joint-coordinate: hole}, v: {velocity: bead}, u: {velocity: wire}, push: {spring-force: law},
                                 lost: {energy: dissipated}, balance: {energy: balance}}}
"""
SLOPE = 2 / math.sqrt(21)


def wire(law, step="1 ms", more="", left="left: {fixed: {between: [ground, wire/start]}}", gravity=f"gravity: [0, 0, -{G}]", frames="", plane=""):
    return (WIRE.replace("LOADS", f"law: {{{law}}}").replace("STEP", step).replace("MORE", more).replace("LEFT", left)
            .replace("GRAVITY", gravity).replace("FRAMES", frames).replace("PLANE", plane))


@pytest.mark.parametrize("frames", ["", ", frames: 4"])
def test_a_bead_bounces_at_the_end_of_its_way(sensors, frames):
    """Down the wire by a t²/2, back with half of the speed, and so on: an impact is of first order where a mesh takes part."""
    a, end, e = G * SLOPE, 0.5, 0.5
    first = math.sqrt(2 * end / a)

    def exact(t):
        if t < first:
            return 0.5 * a * t * t
        hit, v = first, e * a * first
        while t > hit + 2 * v / a and v > 1e-3:
            hit, v = hit + 2 * v / a, e * v
        return end - max(0.0, v * (t - hit) - 0.5 * a * (t - hit) ** 2)

    errors = []
    for step in ("1 ms", "0.25 ms"):
        out = sensors(wire(f"slide-stop: {{joint: hole, to: {end} m, restitution: {e}}}", step, frames=frames))
        errors.append(numpy.abs(out["way.value"] - [exact(t) for t in out["t"]]).max())
        assert out["way.value"].max() < end + 2e-3
        v = a * first
        assert out["lost"][-1] == pytest.approx(0.5 * 0.1 * v * v * (1 - e**4), rel=3e-3)  # of two impacts
    assert errors[0] < 3e-3 and errors[1] < 0.5 * errors[0]
    # In the end it leans on the stop.
    out = sensors(wire("slide-stop: {joint: hole, to: 50 mm}", frames=frames))
    assert out["way.value"][-1] == pytest.approx(0.05, abs=1e-9)
    assert out["push"][-1] == pytest.approx(0.1 * G * SLOPE, rel=1e-3)


@pytest.mark.parametrize("e", [1, 0.4, 0])
@pytest.mark.parametrize("frames", ["", ", frames: 3"])
def test_bead_and_free_beam_keep_their_momentum(sensors, tmp_path, e, frames):
    """Without anything to hold the beam: it is taken along, and both part with e times their speed."""
    s = numpy.array([4, 1, -2]) / math.sqrt(21)
    start = ", ".join(repr(float(x)) for x in 1.5 * s)
    text = wire(f"slide-stop: {{joint: hole, to: 0.6 m, restitution: {e}}}", left="", gravity="", frames=frames,
                more=f"initial: {{bodies: {{bead: {{velocity: [{start}]}}}}}}")
    out = sensors(text.replace("joints:\n  \n", "joints:\n"))
    mass = 10 * math.pi * 0.01**2 * math.sqrt(21)
    before, after = out["t"] < 0.39, out["t"] > 0.41
    bead = numpy.array([out[f"v.{axis}"] for axis in "xyz"]).T @ s
    beam = numpy.array([out[f"u.{axis}"] for axis in "xyz"]).T @ s
    assert bead[before] == pytest.approx(1.5, rel=1e-9)
    # With frames the sensor tells the velocity of one of them, which rings a little for some hundredths of a second.
    settled = before | (out["t"] > 0.6) if frames else out["t"] >= 0
    assert (0.1 * bead + mass * beam)[settled] == pytest.approx(0.15, rel=1e-9)
    assert (beam - bead)[after] == pytest.approx(1.5 * e, abs=2e-3)
    lost = 0.5 * 0.1 * mass / (0.1 + mass) * 1.5**2 * (1 - e * e)
    assert out["lost"][-1] == pytest.approx(lost, abs=2e-3 * 0.1)
    assert json.loads((tmp_path / "out" / "summary.json").read_text())["measures"]["impacts"] == 1


def test_friction_along_a_wire_sticks_without_any_motion_or_slides(sensors):
    mu = SLOPE / math.sqrt(1 - SLOPE**2)
    # From rest, because a wire that begins to vibrate lifts the bead's weight off it in between.
    out = sensors(wire(f"slide-friction: {{joint: hole, static: {1.01 * mu!r}, stick: rigid}}", more="initial: {start: static, friction: frozen}"))
    assert numpy.abs(out["way.value"]).max() < 1e-9
    assert abs(out["push"][-1]) == pytest.approx(0.1 * G * SLOPE, rel=1e-3)
    out = sensors(wire(f"slide-friction: {{joint: hole, static: {0.5 * mu!r}, stick: rigid}}"))
    a = 0.5 * G * SLOPE
    # The wire of 1e16 Pa vibrates by 4e-7 m, and the reaction with it.
    assert out["way.value"] == pytest.approx(0.5 * a * out["t"] ** 2, abs=1e-4)
    assert out["lost"][-1] == pytest.approx(0.1 * a * out["way.value"][-1], rel=1e-3)


@pytest.mark.parametrize("frames", ["", ", frames: 3"])
def test_an_event_locks_a_slider_on_its_beam_and_frees_it(sensors, frames):
    """Nothing holds the beam: locked, both go on together, and so they do when it is free again."""
    s = numpy.array([4, 1, -2]) / math.sqrt(21)
    start = ", ".join(repr(float(x)) for x in 1.5 * s)
    more = f"""initial: {{bodies: {{bead: {{velocity: [{start}]}}}}}}
signals: {{way: {{joint-displacement: hole}}, far: "way - 0.45", late: "t - 0.6"}}
events: {{catch: {{when: far, direction: rising, lock: hole}}, free: {{when: late, unlock: hole}}}}"""
    out = sensors(wire("slide-spring: {joint: hole, stiffness: 1e-9 N/m}", left="", gravity="", frames=frames, more=more).replace("joints:\n  \n", "joints:\n"))
    mass = 10 * math.pi * 0.01**2 * math.sqrt(21)
    bead = numpy.array([out[f"v.{axis}"] for axis in "xyz"]).T @ s
    beam = numpy.array([out[f"u.{axis}"] for axis in "xyz"]).T @ s
    assert 0.1 * bead + mass * beam == pytest.approx(0.15, rel=1e-9)
    caught = out["t"] > 0.31
    assert bead[caught] == pytest.approx(0.15 / (0.1 + mass), abs=1e-3)
    assert numpy.ptp(out["way.value"][caught & (out["t"] < 0.59)]) < 1e-9
    assert out["way.value"][-1] == pytest.approx(0.45, abs=1e-3)
    assert out["lost"][-1] == pytest.approx(0.5 * 0.1 * mass / (0.1 + mass) * 1.5**2, rel=2e-3)


@pytest.mark.parametrize("step", ["1 ms", "0.2 ms"])
@pytest.mark.parametrize("frames", ["", ", frames: 4"])
def test_a_trolley_between_buffers_on_a_soft_rail_keeps_its_energy(sensors, tmp_path, frames, step):
    """Restitution 1 and no numerical damping: blows between a trolley and the rail that bends beneath it take nothing."""
    text = wire("slide-stop: {joint: hole, from: -0.2 m, to: 0.2 m, restitution: 1}", step, frames=frames,
                more="initial: {joints: {hole: {velocity: 2}}}").replace("material: hard", "material: steel").replace("mass: 0.1", "mass: 2").replace("20 mm", "60 mm")
    text = text.replace("step: " + step, f"step: {step}, rho-inf: 1").replace("sensors: {", "sensors: {total: {energy: total}, ")
    text = text.replace("left:", "right: {point-on-line: {between: [{ground: [4, 1, -2]}, wire/end], axis: [4, 1, -2]}}\n  left:")
    out = sensors(text)
    measures = json.loads((tmp_path / "out" / "summary.json").read_text())["measures"]
    assert measures["impacts"] >= 3
    assert numpy.abs(out["way.value"]).max() < 0.2 + 2.5 * float(step.split()[0]) * 1e-3
    assert numpy.abs(out["lost"]).max() < 1e-9
    assert numpy.ptp(out["total"]) < 0.02 * 4
