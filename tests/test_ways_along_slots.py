# SPDX-License-Identifier: Apache-2.0
"""The way along a slot: recorded, driven, sprung, rubbed, limited and locked, over laps of a closed curve."""

import math

import numpy
import pytest
from scipy.integrate import solve_ivp

G, R = 9.81, 0.2
LAP = 2 * math.pi * R

# A bead on an upright circle, at its lowest place; x is the direction in which the curve begins.
RING = f"""
buckens: 1
GRAVITY
PLANAR
bodies: {{bead: {{rigid: {{mass: 0.5 kg, inertia: [1e-3, 1e-3, 1e-3]}}, at: {{position: [0, 0, -{R}]}}}}}}
joints:
  wire: {{slot: {{between: [ground, bead], start: [0, 0, -{R}], closed: on, segments: [{{arc: [0, 0, {R}], through: [{R}, 0, 0]}}, {{arc: [0, 0, -{R}], through: [-{R}, 0, 0]}}]}}}}
MORE
simulation: {{duration: DURATION, step: STEP}}
output:
  every: EVERY
  sensors:
    way: {{joint-coordinate: wire}}
    x: {{position: bead}}
    push: {{joint-force: wire}}
    balance: {{energy: balance}}
    total: {{energy: total}}
"""


def ring(more="", gravity="gravity: [0, 0, -9.81]", planar="", duration="2 s", step="1 ms", every="10 ms"):
    return (RING.replace("GRAVITY", gravity).replace("PLANAR", planar).replace("MORE", more).replace("DURATION", duration)
            .replace("STEP", step).replace("EVERY", every))


def is_on_the_ring(out):
    """The place follows from the way."""
    angle = out["way.value"] / R
    assert out["x.x"] == pytest.approx(R * numpy.sin(angle), abs=1e-10)  # steps close to 1e-12 of the model's length
    assert out["x.z"] == pytest.approx(-R * numpy.cos(angle), abs=1e-10)


@pytest.mark.parametrize("planar", ["", "planar: zx"])
def test_a_bead_on_a_ring_is_a_pendulum(sensors, planar):
    amplitude = 1.0
    times = numpy.linspace(0, 2, 201)
    exact = solve_ivp(lambda t, y: [y[1], -G / R * math.sin(y[0])], (0, 2), [amplitude, 0], t_eval=times,
                      rtol=1e-12, atol=1e-13, method="DOP853").y[0]
    errors, balances = [], []
    for step in (2, 1):
        out = sensors(ring(f"initial: {{joints: {{wire: {{displacement: {amplitude * R} m, velocity: 0}}}}}}", planar=planar, step=f"{step} ms"))
        assert out["way.value"][0] == pytest.approx(amplitude * R, abs=1e-12)
        is_on_the_ring(out)
        errors.append(numpy.abs(out["way.value"] / R - exact).max())
        balances.append(numpy.abs(out["balance"]).max())
    # The method is of second order.
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.1)
    assert balances[0] / balances[1] == pytest.approx(4, rel=0.1)
    assert balances[1] < 1e-5 * 0.5 * G * R  # (w h)² = 5e-5 of the energy m g R
    assert errors[1] < 2e-3


def test_a_spring_along_the_ring_pulls_over_laps(sensors):
    """Without gravity: m s'' = -k (s - 5 m), four laps there and back."""
    m, k, far = 0.5, 2.0, 5.0
    w = math.sqrt(k / m)
    errors, balances = [], []
    for step in (2, 1):
        out = sensors(ring(f"loads: {{pull: {{slide-spring: {{joint: wire, stiffness: {k}, displacement: {far} m}}}}}}", gravity="", step=f"{step} ms",
                           duration="4 s").replace("  sensors:", "  sensors:\n    pull: {spring-force: pull}"))
        exact = far * (1 - numpy.cos(w * out["t"]))
        assert exact.max() > 7 * LAP
        errors.append(numpy.abs(out["way.value"] - exact).max())
        balances.append(numpy.abs(out["balance"]).max())
        assert out["pull"] == pytest.approx(k * (out["way.value"] - far), abs=1e-9)
        is_on_the_ring(out)
    # Around the ring it turns at up to 50 rad/s: (50 h)² = 0.25 % of the way and of the energy, of second order.
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.02)
    assert errors[1] < 0.0025 * 2 * far
    assert balances[0] / balances[1] == pytest.approx(4, rel=0.02)
    assert balances[1] < 0.0025 * 0.5 * k * far**2


@pytest.mark.parametrize("planar", ["", "planar: zx"])
def test_a_bead_that_is_driven_around_needs_the_centripetal_force(sensors, planar):
    v = 2.0
    drive = f"joints:\n  drive: {{prescribed-coordinate: {{joint: wire, velocity: {v} m/s}}}}"
    text = ring(gravity="", planar=planar, duration="5 s").replace("joints:", drive, 1)
    out = sensors(text.replace("  sensors:", "  sensors:\n    drive: {joint-force: drive}"))
    assert out["way.value"] == pytest.approx(v * out["t"], abs=1e-10)  # eight laps
    assert out["way.value"][-1] > 7 * LAP
    assert out["way.rate"] == pytest.approx(v, abs=1e-10)
    is_on_the_ring(out)
    force = numpy.hypot(out["push.x"], out["push.z"])
    # It turns at 10 rad/s: the method averages the direction of the force over steps, (10 h)²/12 = 8.3e-6 of it.
    assert force[20:] == pytest.approx(0.5 * v**2 / R * (1 + 1e-4 / 12), rel=1e-6)
    assert force[:20] == pytest.approx(0.5 * v**2 / R, rel=1e-4)
    assert numpy.hypot(out["drive.x"], out["drive.z"]).max() < 1e-3 * 10


def test_a_bead_that_is_accelerated(sensors):
    """By a law of time, and by one of a signal; the drive takes m a along the curve, and its work is the kinetic energy."""
    a = 3.0
    for law in (f"acceleration: {a} m/s^2", "velocity: ramp", f"displacement: \"{a}*t^2/2 m\""):
        drive = f"joints:\n  drive: {{prescribed-coordinate: {{joint: wire, {law}}}}}"
        signals = f"signals: {{ramp: {{integral: {{input: \"{a}\"}}}}}}" if "ramp" in law else ""
        out = sensors(ring(signals, gravity="", step="1 ms").replace("joints:", drive, 1)
                      .replace("  sensors:", "  sensors:\n    drive: {joint-force: drive}"))
        # Exactly by laws of time; signals are integrated by the method, which starts with an error of a h³.
        assert out["way.value"] == pytest.approx(0.5 * a * out["t"] ** 2, abs=1e-8 if signals else 1e-10)
        angle = out["way.value"] / R
        along = out["drive.x"] * numpy.cos(angle) + out["drive.z"] * numpy.sin(angle)
        assert along[10:] == pytest.approx(0.5 * a, rel=1e-3)  # of second order in the step of a turning force
        assert out["total"][-1] == pytest.approx(0.25 * (a * 2) ** 2, rel=1e-5)
        # It ends at 30 rad/s: (30 h)²/4 = 2.3e-4 of the work.
        assert abs(out["balance"][-1]) < 2.3e-4 * out["total"][-1]


def test_friction_on_a_ring_slows_by_what_the_curve_pushes(sensors):
    """N = m v²/R, so that v falls by exp(-mu s/R)."""
    mu, v = 0.1, 2.0
    out = sensors(ring(f"loads: {{rub: {{slide-friction: {{joint: wire, static: {mu}}}}}}}\ninitial: {{joints: {{wire: {{velocity: {v}}}}}}}",
                       gravity="", step="0.2 ms", duration="1 s"))
    s = R / mu * numpy.log(1 + mu * v * out["t"] / R)
    assert s[-1] > LAP
    # Second order in the step: (mu v/R)² h² of the way, and the slip of 1e-6 of the model's length.
    assert out["way.value"] == pytest.approx(s, abs=1e-5)
    assert out["way.rate"] == pytest.approx(v * numpy.exp(-mu * out["way.value"] / R), rel=1e-4)
    assert numpy.abs(out["balance"]).max() < 1e-6


def test_stops_and_locks_on_a_ring(sensors):
    """A rigid stop a lap and a half away throws back; an event locks the bead where it is."""
    v, far = 2.0, 1.5 * LAP
    out = sensors(ring(f"""
loads: {{end: {{slide-stop: {{joint: wire, to: {far} m, restitution: 0.5}}}}}}
signals: {{way: {{joint-displacement: wire}}, rate: {{joint-rate: wire}}, back: "{far - 0.3} - way + 0*rate"}}
events: {{hold: {{when: back, direction: rising, lock: wire}}}}
initial: {{joints: {{wire: {{velocity: {v}}}}}}}""", gravity="", step="1 ms", duration="2 s"))
    hit = far / v
    before = out["t"] < hit - 1e-3
    # It turns at 10 rad/s, so that a step cuts (10 h)²/12 = 8.3e-6 of the way.
    assert out["way.value"][before] == pytest.approx(v * out["t"][before], rel=1e-5)
    after = (out["t"] > hit + 2e-3) & (out["t"] < hit + 0.29)
    assert out["way.rate"][after] == pytest.approx(-0.5 * v, rel=1e-4)  # the blow is somewhere within a step: (10 h)²
    assert out["way.value"][after] == pytest.approx(far - 0.5 * v * (out["t"][after] - hit), rel=2e-5)
    # Found on the line between two ends of steps, which cuts (10 h)²/8 of the radius.
    assert out["way.value"][-1] == pytest.approx(far - 0.3, abs=1e-5)
    assert abs(out["way.rate"][-1]) < 1e-9
    is_on_the_ring(out)


def test_a_way_along_a_spline_is_its_length(sensors):
    """A parabola through points that are unevenly far apart: the rate is the speed of the bead, the way its integral."""
    points = ", ".join(f"[{x}, 0, {x * x}]" for x in (-0.5, -0.3, -0.25, 0.0, 0.1, 0.35, 0.5))
    out = sensors(f"""
buckens: 1
gravity: [0, 0, -9.81]
bodies: {{bead: {{rigid: {{mass: 0.5 kg, inertia: [1e-3, 1e-3, 1e-3]}}, at: {{position: [-0.3, 0, 0.09]}}}}}}
joints: {{wire: {{slot: {{between: [ground, bead], path: [{points}]}}}}}}
simulation: {{duration: 1 s, step: 0.2 ms}}
output: {{every: 0.2 ms, sensors: {{way: {{joint-coordinate: wire}}, x: {{position: bead}}, v: {{velocity: bead}}, balance: {{energy: balance}}}}}}
""")
    speed = numpy.hypot(out["v.x"], out["v.z"]) * numpy.sign(out["v.x"])
    assert out["way.rate"] == pytest.approx(speed, abs=1e-9)
    chords = numpy.hypot(numpy.diff(out["x.x"]), numpy.diff(out["x.z"])) * numpy.sign(numpy.diff(out["x.x"]))
    # Chords of half a millimetre miss κ² h²/24 of the length; where it turns back within a step, a part of that one.
    assert out["way.value"][1:] == pytest.approx(numpy.cumsum(chords), abs=1e-6)
    assert numpy.ptp(out["way.value"]) > 0.6
    assert numpy.abs(out["balance"]).max() < 1e-6 * 0.5 * G * 0.25  # of second order, of m g times the largest height


def test_vibrations_along_a_ring(buckens, tmp_path):
    """Spring and gravity: w² = k/m + g/R."""
    (tmp_path / "model.yaml").write_text(ring("loads: {pull: {slide-spring: {joint: wire, stiffness: 100}}}"))
    found = buckens("modes", "model.yaml", "--system", "--about", "static", "--json").must(0).json
    frequencies = [mode["frequency"] for mode in found["analyses"][0]["modes"]]
    # The stiffness of rows and laws is found by differences.
    assert frequencies == pytest.approx([math.sqrt(100 / 0.5 + G / R) / (2 * math.pi)], rel=1e-8)


def test_a_bead_rests_where_its_spring_holds_it(sensors):
    """k (s - 0.1 m) = -m g sin(s/R)."""
    out = sensors(ring("loads: {pull: {slide-spring: {joint: wire, stiffness: 10, displacement: 0.1}}}\ninitial: {start: static}", duration="0.1 s"))
    s = out["way.value"]
    assert 10 * (s - 0.1) == pytest.approx(-0.5 * G * numpy.sin(s / R), abs=1e-8)
    assert numpy.ptp(s) < 1e-8 and s[0] > 0.02


def test_a_bead_that_comes_back_is_counted_on(sensors):
    """Let go on the side of the ring, it flies straight up, falls back, is caught where it was, and swings on."""
    text = ring("""
signals: {high: {position: {of: bead, along: [0, 0, 1]}}}
events: {caught: {when: high, direction: falling, attach: wire}}
initial: {released: [wire], bodies: {bead: {velocity: [0, 0, 1]}}}""", duration="1 s").replace(f"position: [0, 0, -{R}]", f"position: [{R}, 0, 0]")
    out = sensors(text)
    back = 2 / G
    free = out["t"] < back
    # Above the side its nearest place on the ring is by atan(z/R) ahead.
    z = out["t"] - 0.5 * G * out["t"] ** 2
    assert out["way.value"][free] == pytest.approx(R * numpy.arctan2(z[free], R), abs=1e-6)
    swing = out["t"] > back + 1e-3
    angle = out["way.value"][swing] / R
    assert out["x.x"][swing] == pytest.approx(R * numpy.cos(angle), abs=1e-9)
    assert out["x.z"][swing] == pytest.approx(R * numpy.sin(angle), abs=1e-9)
    # It goes on with 1 m/s downwards, and so up to 1 m²/s² / (2 g) above the side on the other one.
    assert angle.min() == pytest.approx(-math.pi - math.asin(1 / (2 * G * R)), abs=1e-3)
