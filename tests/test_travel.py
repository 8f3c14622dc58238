# SPDX-License-Identifier: Apache-2.0
"""Sliders on flexible beams and rolling wheels, with exact motions and forces."""

import json
import math

import h5py
import numpy
import pytest

from conftest import SOURCE

G = 9.81

RAIL = (SOURCE / "examples" / "trolley_on_flexible_rail/trolley_on_flexible_rail").with_suffix(".yaml")
L, P = 10.0, 100.0
EI, MU = 210e9 * 0.1**4 / 12, 7850 * 0.01  # of the example's section
FIRST = (math.pi / L) ** 2 * math.sqrt(EI / MU)


def moving_force(t, v, modes=40):
    """Middle of a simply supported Euler-Bernoulli beam under a force P that moves with v from its end; exact series."""
    w = numpy.zeros_like(t)
    for n in range(1, modes, 2):
        natural, forced = n * n * FIRST, n * math.pi * v / L
        w += (2 * P / (MU * L) * math.sin(n * math.pi / 2) / (natural**2 - forced**2)
              * (numpy.sin(forced * t) - forced / natural * numpy.sin(natural * t)))
    return w


def moving_mass(times, v, m, modes=16, steps=4000):
    """The same with a mass m that follows the beam: Galerkin's equations by the series' shapes, Runge-Kutta of order 4."""
    n = numpy.arange(1, modes + 1)
    k = n * math.pi / L
    natural = n**2 * FIRST

    def rates(t, x):
        q, q_dot = x
        s, c = numpy.sin(k * v * t), k * numpy.cos(k * v * t)
        # Acceleration of the beam's point under the mass: w_tt + 2 v w_xt + v² w_xx.
        push = P - m * (2 * v * c @ q_dot - v * v * (k**2 * s) @ q)
        M = MU * L / 2 * numpy.eye(modes) + m * numpy.outer(s, s)
        return numpy.array([q_dot, numpy.linalg.solve(M, push * s - MU * L / 2 * natural**2 * q)])

    x, h, out, at = numpy.zeros((2, modes)), times[-1] / steps, [], 0.0
    middle = numpy.sin(k * L / 2)
    for i in range(steps + 1):
        if len(out) < len(times) and abs(at - times[len(out)]) < h / 2:
            out.append(middle @ x[0])
        a = rates(at, x)
        b = rates(at + h / 2, x + h / 2 * a)
        c = rates(at + h / 2, x + h / 2 * b)
        d = rates(at + h, x + h * c)
        x, at = x + h / 6 * (a + 2 * b + 2 * c + d), at + h
    return numpy.array(out)


# A quarter, half and all but the critical speed: where Ω₁ = ω₁, 46.9 m/s.
@pytest.mark.parametrize("ratio, divided", [(0.25, ""), (0.5, ""), (0.9, ""), (0.5, ", frames: 4")])
def test_a_force_moves_along_a_flexible_beam(sensors, tmp_path, ratio, divided):
    v = ratio * FIRST * L / math.pi
    text = RAIL.read_text().replace("mass: 157 kg", "mass: 1 g").replace("speed: 23.45", f"speed: {v!r}")
    text = text.replace("material: steel}}", f"material: steel}}{divided}}}").replace("[10, 10, 10]", "[1, 1, 1]")
    duration = 0.98 * L / v
    text = text.replace("duration: 0.42 s, step: 0.2 ms", f"duration: {duration!r} s, step: {duration / 2000!r} s")
    out = sensors(text.replace("every: 4.2 ms", f"every: {duration / 100!r} s"))
    exact = -moving_force(out["t"], v)
    # Twenty cubic elements know the fifth mode to 5e-4, and it has 1/625 of the first one's share; deflections of 1e-4 of the
    # length act back by their square. The method's period error at 2000 steps is below all that.
    assert out["mid.y"] == pytest.approx(exact, abs=1e-3 * numpy.max(numpy.abs(exact)))
    assert out["way.value"] == pytest.approx(v * out["t"], abs=1e-9)
    assert out["way.rate"] == pytest.approx(v, rel=1e-6)
    # A gram on the rail leaves P but for its own inertia.
    assert out["contact.y"][1:] == pytest.approx(P, rel=1e-3)
    assert out["balance"] == pytest.approx(0, abs=1e-4)
    # Nineteen nodes were passed: still one factorisation; of four parts, one for those at the ends and one for those between.
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["steps"] == 2000
    for body in summary["bodies"].values():
        assert body["factorisations"] <= (2 if divided else 1), body


def test_the_trolley_crosses_the_flexible_rail_with_its_mass(sensors):
    out = sensors(RAIL.read_text())
    exact = -moving_mass(out["t"], 23.45, 157.0)
    assert out["mid.y"] == pytest.approx(exact, abs=2e-3 * numpy.max(numpy.abs(exact)))
    # The mass makes the difference: without it the rail deflects otherwise by far more than this tolerance.
    assert numpy.max(numpy.abs(exact + moving_force(out["t"], 23.45))) > 0.1 * numpy.max(numpy.abs(exact))
    assert out["balance"] == pytest.approx(0, abs=1e-4)


def test_a_slider_leaves_its_beam_with_a_message(buckens, tmp_path):
    (tmp_path / "long.yaml").write_text(RAIL.read_text().replace("duration: 0.42 s", "duration: 0.84 s"))
    buckens("run", "long.yaml", "-o", "long").must(4, "joint \"wheel\" at t = 0.426", "left its beam of 10 m", "beyond the end",
                                                   "slide-stop")


STEERED = """
buckens: 1
planar: xy
materials: {steel: {E: 200 GPa, nu: 0.3, rho: 7870 kg/m^3, damping: {stiffness: 1e-4 s}}}
bodies:
  rail: {beam: {to: [3, 0, 0], elements: 12, section: {circle: {diameter: 20 mm}}, material: steelROD}}
  bead: {rigid: {mass: 0.1 kg, inertia: [0, 0, 1e-3]}, at: {position: [0.4, 0, 0]}}
joints:
  left: {fixed: {between: [ground, rail/start]}}
  hole: {slider-on-beam: {between: [rail, bead], LAW}}
signals: {SIGNALS}
simulation: {duration: 1 s, step: 1 ms, METHOD}
output: {every: 10 ms, sensors: {way: {joint-coordinate: hole}, x: {position: bead}, push: {joint-force: hole}, balance: {energy: balance}}}
"""


def steered(law, signals, method="method: generalized-alpha", rod=""):
    return (STEERED.replace("LAW", law).replace("{SIGNALS}", "{" + signals + "}").replace("METHOD", method)
            .replace("steelROD}", "steel}" + rod))


@pytest.mark.parametrize("method, rod", [("method: generalized-alpha", ""), ("method: newmark", ""),
                                         ("tolerance: 1e-5", ""), ("tolerance: 1e-5", ", frames: 3"),
                                         ("method: generalized-alpha", ", frames: 3")])
def test_signals_drive_a_slider(sensors, method, rod):
    """By feedback to a goal, over nodes and borders of parts; and by a measured velocity."""
    out = sensors(steered('velocity: "4*(goal - s)"', "s: {joint-displacement: hole}, goal: {setting: 1.5}", method, rod))
    t = out["t"]
    # The drive is as good as the method integrates its signal: (4 h)²/12 over a second.
    assert out["way.value"] == pytest.approx(1.5 * (1 - numpy.exp(-4 * t)), abs=3e-5)
    assert out["way.rate"] == pytest.approx(6 * numpy.exp(-4 * t), abs=3e-4)
    assert out["x.x"] == pytest.approx(0.4 + out["way.value"], abs=1e-6)
    # It brakes the bead, m x'', once what its start shakes in the rail has died out.
    late = t > 0.1
    assert out["push.x"][late] == pytest.approx(-2.4 * numpy.exp(-4 * t[late]), abs=2e-2)
    out = sensors(steered('acceleration: "5 - 2*v"', "v: {joint-velocity: hole}", method, rod))
    assert out["way.rate"] == pytest.approx(2.5 * (1 - numpy.exp(-2 * t)), abs=1e-4)


def test_a_setting_moves_a_slider_behind_a_filter(sensors):
    out = sensors(steered('displacement: "p"', "step: {setting: 1}, p: {transfer-function: {input: step, numerator: [400], denominator: [1, 40, 400]}}"))
    t = out["t"]
    assert out["way.value"] == pytest.approx(1 - (1 + 20 * t) * numpy.exp(-20 * t), abs=1e-4)


def test_a_slider_cannot_follow_what_jumps(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(steered('displacement: "p"', "p: {setting: 1}"))
    buckens("check", "model.yaml").must(3, "joint \"hole\"", "`displacement` follows signal \"p\"", "`velocity`")


BEAD = """
buckens: 1
gravity: [0, 0, -9.81]
materials: {hard: {E: 1e16 Pa, nu: 0.3, rho: 10 kg/m^3}}
bodies:
  wire: {beam: {FROM, elements: 32, section: {circle: {diameter: 20 mm}}, material: hard}}
  bead: {rigid: {mass: 0.1 kg, inertia: [1, 1, 1]}, at: {position: PLACE}}
joints:
  left: {fixed: {between: [ground, wire/start]}}
  hole: {slider-on-beam: {between: [wire, bead]}}
loads: LOADS
simulation: {duration: DURATION s, step: 1 ms}
output: {every: 20 ms, sensors: {p: {position: bead}, way: {joint-coordinate: hole}, hole: {joint-force: hole}, balance: {energy: balance}}}
"""


def test_a_bead_slides_down_an_inclined_wire_and_against_a_spring(sensors):
    wire = BEAD.replace("FROM", "from: [0, 0, 0], to: [4, 1, -2]").replace("PLACE", "[0.4, 0.1, -0.2]")
    out = sensors(wire.replace("LOADS", "{}").replace("DURATION", "1"))
    t, slope = out["t"], 2 / math.sqrt(21)
    # The wire of 1e16 Pa bends by 4e-7 m over its length of 4.6 m.
    assert out["way.value"] == pytest.approx(0.5 * G * slope * t**2, abs=2e-6)
    # It starts unbent, so it vibrates with that amplitude at first; the method damps it.
    assert out["way.rate"] == pytest.approx(G * slope * t, abs=5e-5)
    across = 0.1 * G * math.sqrt(1 - slope**2)
    assert numpy.sqrt(out["hole.x"]**2 + out["hole.y"]**2 + out["hole.z"]**2)[10:] == pytest.approx(across, rel=1e-3)
    # On a spring and a damper along the wire: x = x₀ (1 − e^(−Dωt)(cos ω_d t + D ω/ω_d sin ω_d t)).
    law = "{spring: {slide-spring: {joint: hole, stiffness: 40 N/m, damping: 0.4 N s/m}}}"
    out = sensors(wire.replace("LOADS", law).replace("DURATION", "2"))
    x0, w, D = 0.1 * G * slope / 40, 20.0, 0.4 / (2 * 0.1 * 20)
    wd = w * math.sqrt(1 - D * D)
    exact = x0 * (1 - numpy.exp(-D * w * out["t"]) * (numpy.cos(wd * out["t"]) + D * w / wd * numpy.sin(wd * out["t"])))
    # Steps of 1 ms: (ωh)²/12 of the phase over 40 rad.
    assert out["way.value"] == pytest.approx(exact, abs=2e-3 * x0)
    assert out["balance"] == pytest.approx(0, abs=1e-5)


def test_a_bead_on_a_bent_wire_is_a_pendulum(sensors):
    arc = "from: [1, 0, 0], to: [-1, 0, 0], through: [[0, 0, -1]], path: arc"
    a = math.radians(60)
    text = BEAD.replace("FROM", arc).replace("PLACE", f"[{math.sin(a)!r}, 0, {-math.cos(a)!r}]").replace("LOADS", "{}")
    ends = "left: {fixed: {between: [{ground: [1, 0, 0]}, wire/start]}}\n  right: {fixed: {between: [{ground: [-1, 0, 0]}, wire/end]}}"
    out = sensors(text.replace("left: {fixed: {between: [ground, wire/start]}}", ends).replace("DURATION", "2"))
    # Runge-Kutta of order 4 with 2e5 steps in place of elliptic functions.
    angle, rate, h, exact = a, 0.0, 1e-4, []
    for i in range(20001):
        if i % 200 == 0:
            exact.append(angle)
        k1 = (rate, -G * math.sin(angle))
        k2 = (rate + h / 2 * k1[1], -G * math.sin(angle + h / 2 * k1[0]))
        k3 = (rate + h / 2 * k2[1], -G * math.sin(angle + h / 2 * k2[0]))
        k4 = (rate + h * k3[1], -G * math.sin(angle + h * k3[0]))
        angle += h / 6 * (k1[0] + 2 * k2[0] + 2 * k3[0] + k4[0])
        rate += h / 6 * (k1[1] + 2 * k2[1] + 2 * k3[1] + k4[1])
    # 32 elements of 5.6 degrees: the line through their nodes is the circle to h⁴/128 = 7e-7, counted along chords.
    assert numpy.arctan2(out["p.x"], -out["p.z"]) == pytest.approx(exact, abs=2e-4)
    assert numpy.hypot(out["p.x"], out["p.z"]) == pytest.approx(1, abs=2e-6)
    assert out["p.y"] == pytest.approx(0, abs=1e-9)
    assert out["balance"] == pytest.approx(0, abs=1e-4)


def test_laws_along_a_bent_wire_tell_their_forces(sensors):
    arc = "from: [1, 0, 0], to: [-1, 0, 0], through: [[0, 0, -1]], path: arc"
    a = math.radians(60)
    laws = "{spring: {slide-spring: {joint: hole, stiffness: 2 N/m, damping: 0.1 N s/m}}, rub: {slide-friction: {joint: hole, static: 0.1}}}"
    text = BEAD.replace("FROM", arc).replace("PLACE", f"[{math.sin(a)!r}, 0, {-math.cos(a)!r}]").replace("LOADS", laws)
    text = text.replace("left: {fixed: {between: [ground, wire/start]}}", "left: {fixed: {between: [{ground: [1, 0, 0]}, wire/start]}}")
    text = text.replace("sensors: {", "sensors: {spring: {spring-force: spring}, rub: {spring-force: rub}, lost: {energy: {kind: dissipated, of: rub}}, ")
    out = sensors(text.replace("DURATION", "1"))
    assert out["spring"] == pytest.approx(2 * out["way.value"] + 0.1 * out["way.rate"], abs=1e-9)
    # It slides with a tenth of what the wire pushes, to the change of that within an iteration.
    slides = numpy.abs(out["way.rate"]) > 0.05
    push = numpy.sqrt(out["hole.x"] ** 2 + out["hole.y"] ** 2 + out["hole.z"] ** 2)
    assert slides.sum() > 30
    assert (out["rub"] * numpy.sign(out["way.rate"]))[slides] == pytest.approx(0.1 * push[slides], rel=1e-6)
    assert out["lost"][-1] > 0.01


ERRORS = {
    "a rigid rail": ("hole: {slider-on-beam: {between: [bead, wire/end]}}", ["joint \"hole\"", "\"bead\" has no beams", "slot"]),
    "two drives": ("hole: {slider-on-beam: {between: [wire, bead], velocity: 1 m/s, displacement: 1 m}}",
                   ["joints.hole.slider-on-beam", "only one of the keys displacement, velocity and acceleration"]),
    "one node": ("hole: {slider-on-beam: {between: [wire, bead], from: end, to: end}}", ["joint \"hole\"", "`from` and `to` are the same node"]),
    "an unknown node": ("hole: {slider-on-beam: {between: [wire, bead], from: ende}}", ["ende", "end"]),
    "a wheel without axle": ("hole: {rolling: {between: [ground, bead], normal: [0, 0, 1], radius: 1}}", ["axle", "missing"]),
    "a flat wheel": ("hole: {rolling: {between: [ground, bead], normal: [0, 0, 1], axle: [0, 0, 1], radius: 1}}",
                     ["joint \"hole\"", "lies flat on its plane as placed"]),
    "a thick edge": ("hole: {rolling: {between: [ground, bead], normal: [0, 0, 1], axle: [0, 1, 0], radius: 1, edge-radius: 2}}",
                     ["at most the radius of the wheel, 1 m, found 2 m"]),
}


@pytest.mark.parametrize("name", ERRORS)
def test_messages(buckens, tmp_path, name):
    joint, words = ERRORS[name]
    text = BEAD.replace("FROM", "to: [1, 0, 0]").replace("PLACE", "[0.5, 0, 0]").replace("LOADS", "{}").replace("DURATION", "1")
    text = text.replace("hole: {slider-on-beam: {between: [wire, bead]}}", joint)
    (tmp_path / "model.yaml").write_text(text.replace(", way: {joint-coordinate: hole}", ""))
    result = buckens("check", "model.yaml")
    result.must(3 if "joint \"hole\"" in result.err else 2, *words)


# ---- rolling

INCLINE = """
buckens: 1
PLANAR
gravity: ["9.81*sin(pi/6)", 0, "-9.81*cos(pi/6)"]
bodies: {wheel: {rigid: {mass: 2 kg, inertia: [I2, I1, I2]}, at: {position: [0, 0, 0.3]}}}
joints: {track: {rolling: {between: [ground, wheel], normal: [0, 0, 1], AXLE radius: 0.3}}}
simulation: {duration: 1 s, step: 2 ms, METHOD}
output: {every: 0.1 s, sensors: {p: {position: wheel}, v: {velocity: wheel}, turn: {angular-velocity: wheel}, track: {joint-force: track}, balance: {energy: balance}}}
"""


# Sphere, cylinder and hoop: J = κ m R².
@pytest.mark.parametrize("kappa, a, planar", [(0.4, 3.50357143, False), (0.5, 3.27, False), (1.0, 2.4525, False), (1.0, 2.4525, True)])
def test_wheels_roll_down_an_incline(sensors, kappa, a, planar):
    J = kappa * 2 * 0.3**2
    text = INCLINE.replace("I1", repr(J)).replace("I2", repr(J if kappa == 0.4 else 0.6 * J)).replace(", METHOD", "")
    out = sensors(text.replace("PLANAR", "planar: zx" if planar else "").replace("AXLE", "" if planar else "axle: [0, 1, 0],"))
    t = out["t"]
    assert a == pytest.approx(G * 0.5 / (1 + kappa), abs=1e-8)
    # Constant accelerations are integrated exactly.
    exact = G * 0.5 / (1 + kappa)
    assert out["p.x"] == pytest.approx(0.5 * exact * t**2, abs=1e-11)
    assert out["p.z"] == pytest.approx(0.3, abs=1e-13)
    assert out["turn.y"] == pytest.approx(exact * t / 0.3, abs=1e-10)
    # Friction m κ a up the incline, and the weight's share across.
    assert out["track.x"] == pytest.approx(-2 * kappa * exact, rel=1e-8)
    assert out["track.z"] == pytest.approx(2 * G * math.cos(math.pi / 6), rel=1e-8)
    assert out["balance"] == pytest.approx(0, abs=1e-11)


DISC = """
buckens: 1
gravity: [0, 0, -9.81]
bodies:
  disc: {rigid: {mass: 1.5 kg, inertia: INERTIA}, at: {position: [0, 0, HEIGHT], orientation: {euler: [TILT, 0, 0]}}}
joints: {floor: {rolling: {between: [ground, disc], normal: [0, 0, 1], axle: [0, 0, 1], radius: RADIUS}}}
initial: {bodies: {disc: {velocity: VELOCITY, angular-velocity: TURN}}}
simulation: {duration: DURATION s, step: STEP ms}
output: {every: 0.05 s, sensors: {p: {position: disc}, turn: {angular-velocity: disc}, balance: {energy: balance}}}
"""


def disc(theta, spin, turn, R, step, duration=2.0):
    """A disc whose axis has the angle theta against the vertical, turning by spin about it while that turns by turn."""
    m = 1.5
    A, C = m * R * R / 4, m * R * R / 2
    # Tilted about x: axis a = (0, -sin, cos). Contact at -R e, e = (n - a cos)/sin = (0, cos, sin).
    a = numpy.array([0, -math.sin(theta), math.cos(theta)])
    e = numpy.array([0, math.cos(theta), math.sin(theta)])
    # Of the axis: the vertical turn without its share along the axis, which is spin.
    w = numpy.array([0, 0, turn]) - turn * math.cos(theta) * a + spin * a
    v = numpy.cross(w, R * e)
    # In axes of the body, which is turned about x by theta.
    w = numpy.array([w[0], math.cos(theta) * w[1] + math.sin(theta) * w[2], math.cos(theta) * w[2] - math.sin(theta) * w[1]])
    text = DISC.replace("INERTIA", str([A, A, C])).replace("HEIGHT", repr(R * math.sin(theta))).replace("TILT", repr(theta))
    text = text.replace("RADIUS", repr(R)).replace("VELOCITY", str(v.tolist())).replace("TURN", str(w.tolist()))
    return text.replace("DURATION", repr(duration)).replace("STEP", repr(step))


def test_a_wheel_is_drawn_with_its_radius_and_axle(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(disc(math.pi / 4, -6.0, 2.0, 0.3, 2.0, 0.1))
    buckens("run", "model.yaml", "-q", "-o", "out").must(0)
    with h5py.File(tmp_path / "out" / "results.h5") as file:
        shapes = file["geometry/shapes"]
        assert list(shapes["kinds"].asstr()) == ["wheel"] and list(shapes["contacts"].asstr()) == ["floor"]
        numbers = shapes["numbers"][0]
    # Position, turn of the marker, axle in axes of the body, radius, thickness of the edge.
    assert numbers[:12] == pytest.approx([0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0.3, 0], abs=1e-12)


def steady_error(out, theta, spin, turn, R):
    """Distance of the centre from its circle, machines.md: radius R |spin/turn|, angle turn t."""
    t = out["t"]
    speed = -R * spin  # along x at the start
    x, y = speed / turn * numpy.sin(turn * t), speed / turn * (1 - numpy.cos(turn * t))
    return numpy.max(numpy.hypot(out["p.x"] - x, out["p.y"] - y)), numpy.max(numpy.abs(out["p.z"] - R * math.sin(theta)))


def test_a_disc_rolls_in_a_steady_circle(sensors):
    R, theta, turn = 0.3, math.radians(60), 2.0
    A, C = R * R / 4, R * R / 2
    # A Ω² sin θ cos θ − (C + R²) ω₃ Ω sin θ − g R cos θ = 0 per mass.
    spin = (A * turn**2 * math.sin(theta) * math.cos(theta) - G * R * math.cos(theta)) / ((C + R * R) * turn * math.sin(theta))
    assert spin == pytest.approx(-6.1264512675, abs=1e-9)
    errors = []
    for step in (2.0, 1.0):
        out = sensors(disc(theta, spin, turn, R, step))
        errors.append(steady_error(out, theta, spin, turn, R))
        assert out["balance"] == pytest.approx(0, abs=1e-5)
    # Second order in the step.
    assert errors[1][0] < 1e-4
    assert math.log2(errors[0][0] / errors[1][0]) == pytest.approx(2, abs=0.2)
    assert errors[1][1] < 1e-5


# 5, 10 and 30 degrees of the axis against the vertical; rad/s of machines with R = 37.5 mm.
@pytest.mark.parametrize("degrees, known", [(5, 109.572321), (10, 77.627169), (30, 45.747131)])
def test_a_coin_spins_on_its_edge_with_its_centre_at_rest(sensors, degrees, known):
    """Euler's disc: Ω² = 4 g/(R sin θ), no turn about the axis in space."""
    R, theta = 0.0375, math.radians(degrees)
    turn = math.sqrt(4 * G / (R * math.sin(theta)))
    assert turn == pytest.approx(known, abs=1e-6)
    step = 4.5747131 / turn  # ms
    out = sensors(disc(theta, 0.0, turn, R, step, 3000 * step / 1000).replace("0.05 s", f"{300 * step / 1000} s"))
    # The centre rests while the axis turns twice around; h² Ω² is 2e-5.
    for axis, place in (("x", 0.0), ("y", 0.0), ("z", R * math.sin(theta))):
        assert out[f"p.{axis}"] == pytest.approx(place, abs=1e-4 * R)
    assert out["turn.z"] == pytest.approx(turn * math.sin(theta) ** 2, rel=1e-4)


# A disc that is all but upright leans by e: e'' = -p² (e - rest). Without slip
# p² = (3 v²/R² - g/R)/1.25 where it rolls, so it is stable from v² = g R/3 on, and
# p² = W² - 4 g/(5 R) where it turns about the vertical: its centre moves aside, and m R² adds to the inertia that W turns.
@pytest.mark.parametrize("share", [0.9, 1.1])
@pytest.mark.parametrize("rolls", [True, False])
def test_an_upright_disc_falls_below_a_speed_only(sensors, rolls, share):
    R, lean = 0.3, 1e-4
    if rolls:
        spin, turn = -math.sqrt(share * G / (3 * R)), 0.0
        p2, given = (3 * spin**2 - G / R) / 1.25, 3 * spin**2 / 1.25
    else:
        spin, turn = 0.0, math.sqrt(share * 0.8 * G / R)
        p2, given = turn**2 - 0.8 * G / R, 0.8 * turn**2
    # Started leaning and with no other turn: the turns that it gains by e - lean hold it about a place of rest.
    rest = given / p2 * lean
    duration = 2.0
    out = sensors(disc(math.pi / 2 - lean, spin, turn, R, 2.0, duration))
    e = rest + (lean - rest) * numpy.cos(numpy.sqrt(p2 + 0j) * out["t"]).real
    found = numpy.arccos(out["p.z"] / R)
    # Squares of e, 1.2e-2 where it falls. Order two in h = 2 ms: 3e-6 of a term that is eleven times p², 3e-4 of e seen.
    assert found == pytest.approx(e, abs=4e-4 * numpy.abs(e).max())
    assert e.max() > 90 * lean if share < 1 else e.max() < 21.001 * lean


@pytest.mark.parametrize("share", [0.9, 1.1])
def test_an_upright_disc_turns_on_smooth_ground_from_a_higher_speed_on(sensors, share):
    """Its centre stays above the same place, so that p² = W² - 4 g/R. One end of a cylinder is the rim as long as it leans that way."""
    R, lean = 0.3, 1e-3
    turn = math.sqrt(share * 4 * G / R)
    text = disc(math.pi / 2 - lean, 0.0, turn, R, 1.0, 0.4)
    start = text.index("joints:")
    text = text[:start] + ("loads: {floor: {contact: {between: [ground, disc/side], shapes: [{plane: {}}, {cylinder: {radius: 0.3, length: 0.1}}]}}}"
                           ) + text[text.index("\n", start):]
    text = text.replace("disc: {rigid:", "disc: {markers: {side: {position: [0, 0, 0.05]}}, rigid:")
    # The centre of mass does not move aside.
    start = text.index("velocity: [", text.index("initial:"))
    text = text[:start] + "velocity: [0, 0, 0" + text[text.index("]", start):]
    out = sensors(text)
    e = lean * numpy.cos(numpy.sqrt(turn**2 - 4 * G / R + 0j) * out["t"]).real
    # Squares of 2e-3 times p² over W², and order two likewise: 1e-4. In 0.43 s it would come over to the other side.
    assert numpy.arccos(out["p.z"] / R) == pytest.approx(e, abs=2e-4 * lean)
    assert e[-1] > 2 * lean if share < 1 else e[-1] < 0.2 * lean


def test_the_wheel_of_the_example_runs_on_its_circle(sensors):
    out = sensors((SOURCE / "examples" / "wheel/wheel").with_suffix(".yaml").read_text())
    # To the left of a centre that starts at the origin along x, after one turn of 3.14 s.
    radius = 0.9189676901
    assert numpy.hypot(out["centre.x"], out["centre.y"] - radius) == pytest.approx(radius, abs=1e-4)
    assert out["centre.z"] == pytest.approx(0.3 * math.sin(math.pi / 3), abs=1e-5)
    assert numpy.abs(out["balance"]).max() < 1e-4  # of 4 J, order two in the step


def test_wheels_that_cannot_roll(buckens, tmp_path):
    planar = INCLINE.replace("I1", "1").replace("I2", "1").replace(", METHOD", "").replace("PLANAR", "planar: zx")
    (tmp_path / "model.yaml").write_text(planar.replace("AXLE", "axle: [1, 0, 0],"))
    buckens("check", "model.yaml").must(2, "axle", "turn about the normal of its plane")
    (tmp_path / "model.yaml").write_text(planar.replace("AXLE", "").replace("normal: [0, 0, 1]", "normal: [0, 1, 0]"))
    buckens("check", "model.yaml").must(3, "model.yaml:6:", "the normal of a rolling joint", "turn `normal` into it")
    # A disc that falls over: which one, and when.
    (tmp_path / "model.yaml").write_text("""
buckens: 1
gravity: [0, 0, -10 m/s^2]
bodies: {disc: {rigid: {mass: 2 kg, inertia: [0.01, 0.02, 0.01]}, at: {position: [0, 0, 0.1]}}}
joints: {edge: {rolling: {between: [ground, disc], normal: [0, 0, 1], axle: [0, 1, 0], radius: 0.1}}}
initial: {bodies: {disc: {velocity: [0, -0.1, 0], angular-velocity: [1, 0, 0]}}}
simulation: {duration: 0.6 s, step: 1 ms}
""")
    buckens("run", "model.yaml", "-o", "out").must(4, "model.yaml:5:", "joint \"edge\" at t = 0.40", "lies flat")
