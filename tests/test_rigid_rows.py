# SPDX-License-Identifier: Apache-2.0
"""Rigid stops, ropes, friction that sticks without any motion: exact motions, energy, messages."""

import json
import math
import pathlib
import sys

import numpy
import pytest

from conftest import SOURCE

sys.path.insert(0, str(pathlib.Path(__file__).parent / "support"))
import bouncing_ball  # noqa: E402 (found after the path is set)

G = 9.81

BALL = """
buckens: 1
gravity: [0, 0, -9.81]
bodies: {ball: {rigid: {mass: 2 kg, inertia: [1, 1, 1]}, at: {position: [0, 0, 1]}}}
joints: {way: {prismatic: {between: [ground, ball], axis: [0, 0, 1]}}}
loads: {floor: {slide-stop: {joint: way, from: -1 m, restitution: 0.9}}}
simulation: {duration: 10 s, step: 5 ms}
output: {every: 50 ms, sensors: {z: {joint-coordinate: way}, f: {spring-force: floor}, lost: {energy: dissipated}, balance: {energy: balance}}}
"""


@pytest.mark.parametrize("control", ["", ", tolerance: 1e-3"])
def test_a_ball_bounces_until_it_rests(sensors, control):
    out = sensors(BALL.replace("step: 5 ms", "step: 5 ms" + control))
    # Free fall and the cubic of the impact's instant are exact for a parabola: only rounding is left.
    flying = out["t"] < 8.5
    exact = numpy.array([bouncing_ball.height(t, 0.9) for t in out["t"]])
    assert numpy.abs(out["z.value"] + 1 - exact)[flying].max() < 1e-9
    # Bounces shorter than a step end; the theory of endless bounces ends at 8.578949179 s.
    resting = out["t"] > 8.6
    assert numpy.abs(out["z.value"] + 1)[resting].max() < 1e-14
    assert out["f"][resting] == pytest.approx(-2 * G, rel=1e-12)  # pressed
    assert out["lost"][-1] == pytest.approx(2 * G, rel=1e-12)
    assert numpy.abs(out["balance"]).max() < 1e-10


def test_an_event_changes_the_restitution(sensors):
    """The third bounce is the first one with another coefficient: heights from then on are those of a ball dropped from there."""
    first, second = 0.9, 0.6
    text = (BALL.replace("restitution: 0.9}}", "restitution: 0.9}}, mat: {slide-stop: {joint: way, from: -1 m, restitution: 0.6}}")
            .replace("simulation:", "signals: {late: \"t - 1.6\"}\nevents: {lay: {when: late, switch-off: floor, switch-on: mat}}\ninitial: {off: [mat]}\nsimulation:")
            .replace("duration: 10 s", "duration: 4 s"))
    out = sensors(text)
    hit = math.sqrt(2 / G)
    hits, speed = [hit], [G * hit]
    while len(hits) < 200:
        # Two hits before 1.6 s, at 0.45 and 1.26 s.
        speed.append(speed[-1] * (first if hits[-1] < 1.6 else second))
        hits.append(hits[-1] + 2 * speed[-1] / G)
    assert hits[1] < 1.6 < hits[2]

    def height(t):
        if t < hit:
            return 1 - 0.5 * G * t * t
        n = numpy.searchsorted(hits, t) - 1
        return max(0.0, speed[n + 1] * (t - hits[n]) - 0.5 * G * (t - hits[n]) ** 2) if n + 1 < len(speed) else 0.0

    flying = out["t"] < hits[8]
    assert out["z.value"][flying] + 1 == pytest.approx(numpy.array([height(t) for t in out["t"]])[flying], abs=1e-9)
    assert out["z.value"][-1] + 1 == pytest.approx(0, abs=1e-12)
    assert abs(out["balance"]).max() < 1e-9


def shaken(times, amplitude, omega, e):
    """Height of a ball on a table that shakes with `amplitude` g: lifted off, it chatters until it rests, and is lifted off again.

    Flights in closed form, impacts by bisection; below 1e-9 m/s it rests. With one start per period errors do not add up."""
    a = amplitude * G
    lift = math.asin(1 / amplitude) / omega

    def push(t, t0, v0):
        # x'' = a sin wt - g relative to the table, from rest on it at t0 with v0.
        c = v0 + a / omega * math.cos(omega * t0) + G * t0
        x = lambda s: -a / omega**2 * math.sin(omega * s) - 0.5 * G * s * s + c * s
        v = -a / omega * math.cos(omega * t) - G * t + c
        return x(t) - x(t0), v

    flights, t, v = [], lift, 0.0
    while t < times[-1]:
        probe = 1e-3 * (v / G if v > 0 else 1 / omega)
        end = t + probe
        while push(end, t, v)[0] > 0:
            end += probe
        low, high = end - probe, end
        for _ in range(80):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if push(middle, t, v)[0] > 0 else (low, middle)
        flights.append((t, high, v))
        t, v = high, -e * push(high, t, v)[1]
        phase = math.fmod(omega * t, 2 * math.pi)
        if v < 1e-9 or t - flights[-1][0] < 1e-9:
            t = (omega * t - phase) / omega + lift + (2 * math.pi / omega if phase > omega * lift else 0)
            v = 0.0
    out = []
    for s in times:
        inside = [f for f in flights if f[0] <= s < f[1]]
        out.append(push(s, inside[0][0], inside[0][2])[0] if inside else 0.0)
    return numpy.array(out)


def test_a_chattering_stop_comes_to_rest_again_and_again(sensors):
    """A ball on a shaking table, in the table's frame: every period it is thrown up, bounces ever shorter and lies still."""
    amplitude, omega, e = 1.3, 2 * math.pi * 5, 0.5
    text = (BALL.replace("position: [0, 0, 1]", "position: [0, 0, 0]").replace("from: -1 m, restitution: 0.9", f"from: 0 m, restitution: {e}, threshold: 0.1 mm/s")
            .replace("simulation:", "  shake: {force: {on: ball, value: [0, 0, SHAKE]}}\nsimulation:".replace("SHAKE", f"\"{2 * amplitude * G}*sin({omega}*t)\""))
            .replace("loads: {floor: {slide-stop", "loads:\n  floor: {slide-stop").replace("0.1 mm/s}}}", "0.1 mm/s}}")
            .replace("duration: 10 s, step: 5 ms", "duration: 2 s, step: STEP").replace("every: 50 ms", "every: 4 ms"))
    errors = []
    for step in ("0.5 ms", "0.25 ms"):
        out = sensors(text.replace("STEP", step))
        exact = shaken(out["t"], amplitude, omega, e)
        errors.append(abs(out["z.value"] - exact).max() / exact.max())
        assert abs(out["balance"]).max() < 1e-3 * out["lost"][-1]
    # Lying still until it is lifted off at the right phase; the first flight has the largest error.
    assert errors[1] < 2e-3 and errors[1] < 0.6 * errors[0]


ROPE = """
buckens: 1
gravity: [0, 0, -9.81]
bodies: {bob: {rigid: {mass: 2 kg, inertia: [1, 1, 1]}, at: {position: [1, 0, 0]}}}
loads: {line: {rope: {between: [ground, bob], length: 1 m}}}
simulation: {duration: 1 s, step: STEP}
output: {every: 0.1 s, sensors: {p: {position: bob}, pull: {spring-force: line}, balance: {energy: balance}}}
"""


def test_a_bob_on_a_taut_rope_is_a_pendulum(sensors):
    # IFToMM A01: from the horizontal, 1 m, at t = 1 s.
    errors = []
    for step in ("2 ms", "1 ms"):
        out = sensors(ROPE.replace("STEP", step))
        errors.append(abs(out["p.x"][-1] + 0.9862917511))
        assert out["p.x"] ** 2 + out["p.z"] ** 2 == pytest.approx(numpy.ones(len(out["t"])), abs=1e-12)
        # Pull of a pendulum from the horizontal: 3 m g sin of the angle below it.
        assert out["pull"][1:] == pytest.approx(3 * 2 * G * -out["p.z"][1:], abs=2e-3)
        assert numpy.abs(out["balance"]).max() < 1e-3
    assert errors[1] < 1e-5
    assert errors[0] / errors[1] == pytest.approx(4, abs=0.3)  # second order


def test_a_rope_lets_fly_and_catches(sensors):
    out = sensors("""
buckens: 1
gravity: [0, 0, -9.81]
bodies: {bob: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}, at: {position: [0.6, 0, 0]}}}
loads: {line: {rope: {between: [ground, bob], length: 1 m}}}
simulation: {duration: 0.5 s, step: 1 ms}
output: {every: 1 ms, sensors: {p: {position: bob}, v: {velocity: bob}, pull: {spring-force: line}, lost: {energy: dissipated}, balance: {energy: balance}}}
""")
    # It falls 0.8 m, where the rope comes taut and takes the speed along it.
    caught = math.sqrt(2 * 0.8 / G)
    speed = G * caught
    before, after = out["t"] < caught - 1e-3, out["t"] > caught + 2e-3
    assert out["p.z"][before] == pytest.approx(-0.5 * G * out["t"][before] ** 2, abs=1e-12)
    assert numpy.abs(out["pull"][before]).max() == 0
    assert out["lost"][-1] == pytest.approx(0.5 * (0.8 * speed) ** 2, rel=2e-3)  # of the step's instant on the arc
    length = numpy.hypot(out["p.x"], out["p.z"])
    assert length[after] == pytest.approx(numpy.ones(after.sum()), abs=1e-12)
    assert out["pull"][after].min() > 0
    assert numpy.abs(out["balance"]).max() < 2e-3 * speed**2


def test_equal_sleds_exchange_their_speeds(sensors):
    # Between bodies: the first hits the second, which stands, and so on to the wall and back.
    out = sensors("""
buckens: 1
bodies:
  a: {rigid: {mass: 3 kg, inertia: [1, 1, 1]}, at: {position: [0, 0, 0]}}
  b: {rigid: {mass: 3 kg, inertia: [1, 1, 1]}, at: {position: [1, 0, 0]}}
joints:
  rail: {prismatic: {between: [ground, a], axis: [1, 0, 0]}}
  way: {prismatic: {between: [a, b], axis: [1, 0, 0]}}
loads:
  buffer: {slide-stop: {joint: way, from: -0.2 m, restitution: 1}}
initial: {bodies: {a: {velocity: [2, 0, 0]}}}
simulation: {duration: 0.5 s, step: 0.7 ms}
output: {every: 10 ms, sensors: {a: {velocity: a}, b: {velocity: b}, xb: {position: b}, balance: {energy: balance}}}
""")
    before, after = out["t"] < 0.0995, out["t"] > 0.101
    assert out["a.x"][before] == pytest.approx(2, rel=1e-12) and out["b.x"][before] == pytest.approx(0, abs=1e-12)
    assert out["b.x"][after] == pytest.approx(2, rel=1e-12) and out["a.x"][after] == pytest.approx(0, abs=1e-12)
    assert out["xb.x"][after] == pytest.approx(1 + 2 * (out["t"][after] - 0.1), rel=1e-12)
    assert numpy.abs(out["balance"]).max() < 1e-11


ELBOW = """
buckens: 1
gravity: [0, -9.81, 0]
planar: xy
bodies:
  upper: {rigid: {mass: 1 kg, com: [0.5, 0, 0], inertia: [0, 0, 0.0833]}, markers: {a: {position: [0, 0, 0]}, b: {position: [1, 0, 0]}}}
  lower: {rigid: {mass: 1 kg, com: [0.5, 0, 0], inertia: [0, 0, 0.0833]}, markers: {a: {position: [0, 0, 0]}}, at: {position: [1, 0, 0]}}
joints:
  shoulder: {revolute: {between: [ground, upper/a]}}
  elbow: {revolute: {between: [upper/b, lower/a]}}
loads: {stop: {hinge-stop: {joint: elbow, from: -40 deg, to: 60 deg, restitution: 0.5}}}
simulation: {duration: 1.5 s, step: STEP}
output: {every: 0.1 s, sensors: {elbow: {joint-coordinate: elbow}, shoulder: {joint-coordinate: shoulder}, lost: {energy: dissipated}, balance: {energy: balance}}}
"""


def test_a_double_pendulum_with_a_stop_converges(sensors):
    runs = [sensors(ELBOW.replace("STEP", step)) for step in ("2 ms", "1 ms", "0.5 ms", "0.05 ms")]
    ends = [numpy.array([out["elbow.value"][-1], out["shoulder.value"][-1], out["lost"][-1]]) for out in runs]
    errors = [numpy.abs(end - ends[-1]).max() for end in ends[:-1]]
    # Instant and what follows an impact are of second order, with a factor that depends on where in a step it falls.
    assert errors[2] < 0.4 * errors[1] < 0.2 * errors[0]
    assert errors[2] < 1e-4
    for out in runs:
        assert out["elbow.value"].max() < math.radians(60) + 1e-4
        assert out["elbow.value"].min() > -math.radians(40) - 1e-4
    assert runs[-1]["lost"][-1] > 0.1
    assert numpy.abs(runs[-1]["balance"]).max() < 1e-3


BAR = """
buckens: 1
materials: {soft: {E: 1e7 Pa, nu: 0, rho: 1000 kg/m^3}}
sections: {s: {rectangle: {width: 10 mm, height: 10 mm}}}
bodies: {bar: {beam: {from: [0, 0, 0], to: [1 m, 0, 0], elements: 60, section: s, material: soft}}}
joints: {way: {prismatic: {between: [ground, bar/start], axis: [1, 0, 0]}}}
loads: {wall: {slide-stop: {joint: way, from: -10 mm}}}
initial: {bodies: {bar: {velocity: [-1 m/s, 0, 0]}}}
simulation: {duration: 60 ms, step: 20 us, rho-inf: 0.8}
output: {every: 0.2 ms, sensors: {x: {joint-coordinate: way}, push: {spring-force: wall}, v: {velocity: bar/com}, lost: {energy: dissipated}}}
"""


def test_an_elastic_bar_rebounds_by_its_own_waves(sensors):
    # With the speed c = 100 m/s of waves the wall feels ρ A c v = 10 N for 2 L/c = 20 ms, and the bar leaves it with its speed reversed.
    out = sensors(BAR)
    hit, gone = 0.01, 0.03
    pressed = (out["t"] > hit + 2e-3) & (out["t"] < gone - 2e-3)
    assert -out["push"][pressed].mean() == pytest.approx(10, rel=0.02)
    assert numpy.abs(out["push"][out["t"] < hit - 1e-4]).max() == 0
    assert numpy.abs(out["push"][out["t"] > gone + 2e-3]).max() == 0
    # Momentum is that of the push; what the mesh of 60 elements disperses of the front stays as vibration.
    assert out["v.x"][-1] == pytest.approx(1, rel=0.02)


STRUCK_BEAM = """
buckens: 1
materials: {alu: {E: 70 GPa, nu: 0.3, rho: 2700 kg/m^3}}
sections: {s: {circle: {diameter: 20 mm}}}
bodies: {bar: {beam: {from: [0, 0, 0], to: [1 m, 0, 0], elements: 10, section: s, material: alu}}}
joints: {guide: {prismatic: {between: [ground, bar/mid], axis: [0, 0, 1]}}}
loads: {floor: {slide-stop: {joint: guide, from: 0, restitution: 1}}}
initial: {bodies: {bar: {velocity: [0, 0, -2 m/s]}}}
simulation: {duration: 50 ms, step: 0.5 ms, rho-inf: 1}
output: {every: 1 ms, sensors: {balance: {energy: balance}, lost: {energy: dissipated}, E: {energy: total}, z: {joint-coordinate: guide}}}
"""


@pytest.mark.parametrize("step", ["1 ms", "0.5 ms", "0.1 ms"])
@pytest.mark.parametrize("restitution", [1, 0.5])
def test_blows_on_a_beam_take_what_restitution_says_and_nothing_else(sensors, restitution, step, tmp_path):
    # Without numerical damping the method keeps the energy of vibrations, whatever the step; so a blow takes the work of its impulse,
    # P (1 - e) v / 2, and nothing at all where e = 1. The scale is m v^2 / 2 = 1.7 J; as the beam
    # is taken out of the floor it gives way by a billionth.
    out = sensors(STRUCK_BEAM.replace("restitution: 1", f"restitution: {restitution}"), "--set", f"simulation.step={step}")
    measures = json.loads((tmp_path / "out" / "summary.json").read_text())["measures"]
    assert measures["impacts"] >= 3
    assert numpy.abs(out["balance"]).max() < 1e-7
    assert out["lost"][-1] == pytest.approx(measures["impact_loss"], abs=1e-12)
    assert out["lost"][-1] < 1e-12 if restitution == 1 else 0.3 < out["lost"][-1] < 1.7
    # What is struck is taken out of the floor; what vibrates into it within a step, at some 5 m/s, is struck in the next one.
    assert out["z.value"].min() > -5 * float(step.split()[0]) * 1e-3


def test_a_beam_that_strikes_with_its_end_keeps_its_energy(sensors):
    # It is free and turns, and has weight: its frame goes on from the instant of the blow and is lifted out of the floor by parts of what
    # it moves in a step, so 1.7 J are kept to the first order. Where shapes went on from the instant as well, 0.1 to 0.4 J came in.
    text = STRUCK_BEAM.replace("buckens: 1", "buckens: 1\ngravity: [0, 0, -9.81 m/s^2]").replace("joints: {guide: {prismatic: {between: [ground, bar/mid], axis: [0, 0, 1]}}}", "").replace(
        "loads: {floor: {slide-stop: {joint: guide, from: 0, restitution: 1}}}",
        "loads: {floor: {contact: {between: [ground, bar/start], shapes: [{plane: [0, 0, 1]}, {sphere: 10 mm}], restitution: 1}}}").replace(
        "bar: {beam", "bar: {at: {position: [0, 0, 40 mm]}, beam").replace(", z: {joint-coordinate: guide}", "").replace("50 ms", "200 ms")
    off = [numpy.abs(sensors(text, "--set", f"simulation.step={step} ms")["balance"]).max() for step in (1, 0.25, 0.0625)]
    assert off[0] < 1.5e-2 and off[1] < 5e-3 and off[2] < 1.5e-3


def test_two_stops_that_hold_the_same_share_the_load(sensors, tmp_path):
    out = sensors(BALL.replace(", restitution: 0.9}", "}").replace(
        "loads: {", "loads: {second: {slide-stop: {joint: way, from: -1 m}}, ").replace(
        "f: {spring-force: floor}", "f: {spring-force: floor}, g: {spring-force: second}").replace("10 s", "2 s"))
    resting = out["t"] > 0.5
    assert numpy.abs(out["z.value"] + 1)[resting].max() < 1e-12
    # Which carries how much is not determined; together they carry the weight.
    assert out["f"][resting] + out["g"][resting] == pytest.approx(-2 * G, rel=1e-9)
    assert out["lost"][-1] == pytest.approx(2 * G, rel=1e-9)
    measures = json.loads((tmp_path / "out" / "summary.json").read_text())["measures"]
    assert measures["impacts"] == 2 and measures["impact_loss"] == pytest.approx(2 * G, rel=1e-9)


INCLINE = """
buckens: 1
gravity: ["9.81*sin(pi/6) m/s^2", 0, "-9.81*cos(pi/6) m/s^2"]
bodies:
  b0: {rigid: {mass: 2 kg, inertia: [1, 1, 1]}, at: {position: [0, 0, 0]}}
  b1: {rigid: {mass: 2 kg, inertia: [1, 1, 1]}, at: {position: [0, 1, 0]}}
  b2: {rigid: {mass: 2 kg, inertia: [1, 1, 1]}, at: {position: [0, 2, 0]}}
joints:
  g0: {prismatic: {between: [{ground: [0, 0, 0]}, b0], axis: [1, 0, 0]}}
  g1: {prismatic: {between: [{ground: [0, 1, 0]}, b1], axis: [1, 0, 0]}}
  g2: {prismatic: {between: [{ground: [0, 2, 0]}, b2], axis: [1, 0, 0]}}
loads:
  f0: {slide-friction: {joint: g0, static: 0.577, stick: rigid}}
  f1: {slide-friction: {joint: g1, static: 0.578, stick: rigid}}
  f2: {slide-friction: {joint: g2, static: 0.7, stick: rigid}}
initial: {bodies: {b2: {velocity: [1, 0, 0]}}}
simulation: {duration: 3 s, step: 1 ms}
output:
  every: 0.1 s
  sensors:
    x0: {joint-coordinate: g0}
    x1: {joint-coordinate: g1}
    x2: {joint-coordinate: g2}
    r0: {spring-force: f0}
    r1: {spring-force: f1}
    r2: {spring-force: f2}
    balance: {energy: balance}
    lost: {energy: dissipated}
"""


def test_rigid_friction_slides_sticks_and_stops(sensors):
    out = sensors(INCLINE)
    down, normal = G * 0.5, G * math.cos(math.pi / 6)
    a = down - 0.577 * normal
    assert out["x0.value"] == pytest.approx(0.5 * a * out["t"] ** 2, abs=1e-9)
    assert out["r0"] == pytest.approx(2 * 0.577 * normal, rel=1e-9)
    # Above tan 30 degrees it holds: not a step of it is a motion.
    assert numpy.abs(out["x1.value"]).max() < 1e-15
    assert out["r1"] == pytest.approx(2 * down, rel=1e-9)
    # Thrown down it slides, and then sticks; the step in which it stops is one of 1 ms at a speed below 1.2 mm/s.
    braking = 0.7 * normal - down
    assert out["x2.value"][-1] == pytest.approx(0.5 / braking, abs=2e-6)
    assert numpy.abs(out["x2.rate"][10:]).max() < 1e-12
    assert out["r2"][-1] == pytest.approx(2 * down, rel=1e-6)
    assert numpy.abs(out["balance"]).max() < 1e-5 * out["lost"][-1]


@pytest.mark.parametrize("old, new, words", [
    ("restitution: 0.9", "restitution: 1.2", ["restitution", "expected 0 to 1", "1.2"]),
    ("restitution: 0.9", "restitution: 0.5, stiffness: 1e5 N/m", ["restitution", "stiffness"]),
    ("restitution: 0.9", "damping: 5 N s/m", ["damping", "stiffness"]),
    ("step: 5 ms", "step: 5 ms, method: newmark", ["floor", "newmark", "generalized-alpha"]),
    ("step: 5 ms", "step: 5 ms, method: wilson", ["load \"floor\" holds rigidly", "method wilson", "generalized-alpha or hht", "a stiffness"]),
    ("from: -1 m", "from: 0.2 m", ["from", "0.2", "outside"]),
])
def test_what_cannot_be_is_refused(buckens, tmp_path, old, new, words):
    assert old in BALL
    (tmp_path / "model.yaml").write_text(BALL.replace(old, new))
    buckens("run", "model.yaml", "-o", "out").must(2, "model.yaml:", *words)


def test_a_rope_that_is_too_short_is_refused(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(ROPE.replace("STEP", "1 ms").replace("length: 1 m", "length: 0.9 m"))
    buckens("run", "model.yaml", "-o", "out").must(2, "model.yaml:5", 'load "line"', "1 m apart", "0.9 m long")


def test_an_equilibrium_beyond_a_rigid_stop_is_on_the_stop(sensors):
    """The spring alone would let it down by 2 m; the floor at 1 m carries what the spring does not."""
    text = BALL.replace("loads: {", "loads: {spring: {slide-spring: {joint: way, stiffness: 10 N/m}}, ")
    out = sensors(text.replace("simulation:", "initial: {start: static}\nsimulation:"))
    assert numpy.abs(out["z.value"] + 1).max() < 1e-12
    assert out["f"] == pytest.approx(-(2 * G - 10), rel=1e-9)
    assert numpy.abs(out["lost"]).max() < 1e-12


def test_a_load_falls_into_its_rope(sensors):
    text = (SOURCE / "examples" / "crane_cable/crane_cable").with_suffix(".yaml").read_text()
    out = sensors(text)
    # Free fall over 200 mm.
    assert out["t"][out["rope"] > 0][0] == pytest.approx(math.sqrt(2 * 0.2 / G), abs=6e-3)  # records every 5 ms
    # As with a fifth of the step, to what the two differ.
    assert out["tip.y"].min() == pytest.approx(-0.46997, abs=5e-5)
    assert out["load.y"].min() == pytest.approx(-0.66990, abs=5e-5)
    assert out["rope"].min() == 0  # slack, and never pushing


def test_rigid_friction_has_no_slip(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(INCLINE.replace("static: 0.577, stick: rigid", "static: 0.577, stick: rigid, slip: 1 um"))
    buckens("run", "model.yaml", "-o", "out").must(2, "model.yaml:13", "slip", "stick: rigid")


AT_REST = """buckens: 1
planar: xy
gravity: [0, -10, 0]
bodies:
  body: {rigid: {mass: 0.5 kg, inertia: [0, 0, 1e-3]}, at: {position: [1.2, -0.5, 0]}}
JOINTS
loads: {held: LOAD}
simulation: {duration: 10 ms, step: 1 ms}
output: {every: 1 ms, sensors: {p: {position: body}, f: FORCE, open: {energy: balance}}}
"""
FLOOR = "between: [{ground: [1.2, -0.6, 0]}, body], shapes: [{plane: {normal: [0, 1, 0]}}, "
WAY = "joints: {way: {prismatic: {between: [{ground: [1.2, -0.5, 0]}, body], axis: [0, 1, 0]}}}"


@pytest.mark.parametrize("joints, load, force, sign", [
    (WAY, "{slide-stop: {joint: way, from: 0 m}}", "{spring-force: held}", -1),
    ("", "{rope: {between: [{ground: [1.2, 0, 0]}, body], length: 0.5 m}}", "{spring-force: held}", 1),
    ("", "{contact: {" + FLOOR + "{sphere: 0.1}], restitution: 0.5}}", "{contact: held}", 1)])
def test_what_rests_at_the_start_presses_from_the_start(sensors, joints, load, force, sign):
    """Not from the end of the first step, which would begin with the acceleration of free fall: g h²/8 of way and a bogus balance."""
    out = sensors(AT_REST.replace("JOINTS", joints).replace("LOAD", load).replace("FORCE", force))
    pressing = out["f.normal"] if "f.normal" in out else out["f"]
    assert pressing == pytest.approx(numpy.full(11, sign * 5.0), rel=1e-9)
    assert numpy.abs(out["p.y"] + 0.5).max() < 1e-15 and numpy.abs(out["open"]).max() < 1e-14


def test_what_touches_and_moves_away_is_let_go(sensors):
    """A spring that pulls off the stop: the row that touches at the start does not hold it back. Free fall upwards, x = a t²/2."""
    text = AT_REST.replace("JOINTS", WAY).replace("LOAD", "{slide-stop: {joint: way, from: 0 m}}").replace("FORCE", "{spring-force: held}")
    out = sensors(text.replace("loads: {", "loads: {up: {force: {on: body, value: [0, 6, 0]}}, "))
    assert numpy.abs(out["f"]).max() == 0.0
    assert out["p.y"][-1] == pytest.approx(-0.5 + 0.5 * 2 * 0.01**2, abs=1e-12)
