# SPDX-License-Identifier: Apache-2.0
"""Signals, blocks with states, and controllers."""

import json
import math
import re

import numpy
import pytest
from scipy.linalg import expm
from scipy.optimize import brentq

from conftest import SOURCE

WHEEL = """
buckens: 1
bodies: {wheel: {rigid: {mass: 2 kg, inertia: [0.1, 0.1, 0.05]}}}
joints: {shaft: {revolute: {between: [ground, wheel], axis: [0, 0, 1]}}}
signals:
  angle: {joint-angle: shaft}
  speed: {joint-speed: shaft}
SIGNALS
loads:
  motor: {hinge-motor: {joint: shaft, MOTOR}}
simulation: {duration: 0.5 s, step: STEP, METHOD}
output:
  every: 10 ms
  sensors: {shaft: {joint-coordinate: shaft}, balance: {energy: balance}SENSORS}
"""


def wheel(signals, motor, step="1 ms", method="method: generalized-alpha", sensors=()):
    seen = "".join(f", {name}: {{signal: {name}}}" for name in sensors)
    lines = "\n".join("  " + line for line in signals)
    return (WHEEL.replace("SIGNALS", lines).replace("MOTOR", motor).replace("STEP", step)
            .replace("METHOD", method).replace("SENSORS", seen))


def test_a_controller_of_signals_has_no_delay(sensors):
    """The same as the motor's own gains, which are part of the iteration. A step of delay would be 1 % off."""
    # Signals may use those below them.
    out = sensors(wheel(["u: \"20*error - 0.4*speed\"", "error: \"0.5 - angle\""], "torque: \"u\"", sensors=("u", "error")))
    own = sensors(wheel([], "angle: 0.5, stiffness: 20, damping: 0.4"))
    # Iterations end at 1e-10 of the motion in a step.
    assert out["shaft.value"] == pytest.approx(own["shaft.value"], abs=1e-9)
    assert out["error"] == pytest.approx(0.5 - out["shaft.value"], abs=1e-12)
    assert out["u"] == pytest.approx(20 * out["error"] - 0.4 * out["shaft.rate"], abs=1e-12)
    # Stiff ones stay stable, because they are part of the tangent.
    out = sensors(wheel(["u: \"2e7*(0.5 - angle) - 4e5*speed\""], "torque: \"u\""))
    assert out["shaft.value"][-1] == pytest.approx(0.5, abs=1e-6)


def test_a_direct_current_motor(sensors):
    """L i' = V - R i - K w and J w' = K i - b w: (L s + R)(J s + b) + K² = 0; the error falls with h²."""
    L, R, K, J, b, V = 0.02, 0.5, 0.4, 0.05, 0.01, 6.0
    A = numpy.array([[-R / L, -K / L], [K / J, -b / J]])
    values, vectors = numpy.linalg.eig(A)
    rest = numpy.linalg.solve(A, [-V / L, 0])
    share = numpy.linalg.solve(vectors, -rest)
    errors = []
    for step, method in (("2 ms", "rho-inf: 0.8"), ("1 ms", "rho-inf: 0.8"), ("1 ms", "method: newmark")):
        # The state feeds on itself.
        out = sensors(wheel([f"i: {{integral: {{input: \"({V} - {R}*i - {K}*speed)/{L}\"}}}}"],
                            f"torque: \"{K}*i - {b}*speed\"", step, method, ("i",)))
        exact = numpy.array([(vectors @ (share * numpy.exp(values * t)) + rest).real for t in out["t"]])
        errors.append(max(numpy.abs(out["i"] - exact[:, 0]).max() / 10, numpy.abs(out["shaft.rate"] - exact[:, 1]).max() / 10))
    assert errors[1] < 1e-3
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.15)
    assert errors[2] < 1e-3


def test_blocks_answer_as_their_transfer_functions(sensors):
    out = sensors(wheel(["sine: \"sin(30*t)\"",
                         "slow: {lag: {input: \"sine\", time-constant: 20 ms, start: 0.3}}",
                         "same: {transfer-function: {input: \"sine\", numerator: [1], denominator: [0.02, 1]}}",
                         "lead: {transfer-function: {input: \"sine\", numerator: [0.1, 1], denominator: [0.02, 1]}}",
                         "second: {transfer-function: {input: \"1\", numerator: [400], denominator: [1, 4, 400]}}",
                         "twin: {state-space: {input: \"1\", A: [[0, 1], [-400, -4]], B: [0, 1], C: [400, 0]}}",
                         "area: {integral: {input: \"slow\", start: 1}}"], "torque: 0", "0.25 ms", "rho-inf: 1",
                        ("slow", "same", "lead", "second", "twin", "area")))
    t, T, w = out["t"], 0.02, 30.0
    forced = (numpy.sin(w * t) - w * T * numpy.cos(w * t)) / (1 + (w * T)**2)
    same = forced + w * T / (1 + (w * T)**2) * numpy.exp(-t / T)
    # Of the order (h/T)²/12 = 1.3e-5 and (20 h)²/12 t 20 = 2e-5.
    assert out["same"] == pytest.approx(same, abs=2e-5)
    assert out["slow"] == pytest.approx(same + 0.3 * numpy.exp(-t / T), abs=2e-5)
    # (0.1 s + 1)/(0.02 s + 1) = 5 - 4/(0.02 s + 1)
    assert out["lead"] == pytest.approx(5 * numpy.sin(w * t) - 4 * same, abs=1e-4)
    d, w0 = 0.1, 20.0
    wd = w0 * math.sqrt(1 - d * d)
    step = 1 - numpy.exp(-d * w0 * t) * (numpy.cos(wd * t) + d * w0 / wd * numpy.sin(wd * t))
    assert out["second"] == pytest.approx(step, abs=5e-5)
    assert out["twin"] == pytest.approx(out["second"], abs=1e-10)
    # T x' = u - x, so the integral of x is that of u less T (x - 0.3).
    area = (1 - numpy.cos(w * t)) / w - T * (out["slow"] - 0.3)
    assert out["area"] - 1 == pytest.approx(area, abs=2e-5)


def pid(e, x, P, I, D, T, filter_time, limit):
    """One sample as the theory page has it; x holds integral, derivative and last input."""
    x[1] = (filter_time * x[1] + D * (e - x[2] if x[2] is not None else 0)) / (filter_time + T)
    wanted = P * e + x[0] + x[1]
    u = min(max(wanted, -limit), limit)
    if not (abs(wanted) > limit and wanted * I * e > 0):
        x[0] += I * T * e
    x[2] = e
    return u


@pytest.mark.parametrize("method", ["newmark", "generalized-alpha", "hht", "wilson"])
def test_a_sampled_pid_is_the_discrete_transfer_function(sensors, method):
    """Forces that are held are integrated exactly, and accelerations jump with them where a method carries them."""
    P, I, D, T, N, J, limit = 30.0, 60.0, 1.2, 0.005, 0.002, 0.05, 8.0
    angle, speed, held, x, exact = 0.0, 0.0, 0.0, [0.0, 0.0, None], []
    for _ in range(101):
        exact.append((angle, speed))
        held = pid(0.5 - angle, x, P, I, D, T, N, limit)
        angle, speed = angle + speed * T + 0.5 * T * T * held / J, speed + T * held / J
    exact = numpy.array(exact)[::2]
    block = (f"u: {{pid: {{input: \"0.5 - angle\", proportional: {P}, integral: {I}, derivative: {D}, filter: {N} s, "
             f"limits: [-{limit}, {limit}], sample: {T} s}}}}")
    for step in ("5 ms", "1 ms"):
        out = sensors(wheel([block], "torque: \"u\"", step, f"method: {method}", ("u",)))
        # Rounding in 500 steps, and the end of iterations.
        assert out["shaft.value"] == pytest.approx(exact[:, 0], abs=1e-9)
        assert out["shaft.rate"] == pytest.approx(exact[:, 1], abs=1e-7)
    assert abs(out["u"]).max() == pytest.approx(8)


def test_steps_that_the_program_chooses_fit_the_samples(sensors):
    """250 samples do not fit the hundred steps that a controlled run has at least; each was 0.4 steps."""
    P, D, T, N, J = 30.0, 1.2, 0.002, 0.004, 0.05
    angle, speed, x, exact = 0.0, 0.0, [0.0, 0.0, None], []
    for _ in range(251):
        exact.append((angle, speed))
        held = pid(0.5 - angle, x, P, 0.0, D, T, N, math.inf)
        angle, speed = angle + speed * T + 0.5 * T * T * held / J, speed + T * held / J
    exact = numpy.array(exact)[::5]
    block = f"u: {{pid: {{input: \"0.5 - angle\", proportional: {P}, derivative: {D}, filter: {N} s, sample: {T} s}}}}"
    out = sensors(wheel([block], "torque: \"u\"", "auto", "method: newmark"))
    # Constant forces are integrated exactly, whatever the step.
    assert out["shaft.value"] == pytest.approx(exact[:, 0], abs=1e-9)
    assert out["shaft.rate"] == pytest.approx(exact[:, 1], abs=1e-7)


def test_a_pid_with_limits_does_not_wind_up(sensors):
    """Against an integration of the same equations by steps of 20 us."""
    P, I, D, N, J, limit, tracking = 30.0, 90.0, 1.2, 0.004, 0.05, 5.0, 0.1

    def rates(y):
        angle, speed, integral, seen = y
        e = 1.5 - angle
        wanted = P * e + integral + D * (e - seen) / N
        u = min(max(wanted, -limit), limit)
        return numpy.array([speed, u / J, I * e + (u - wanted) / tracking, (e - seen) / N]), u

    y, h, exact = numpy.zeros(4), 2e-5, []
    for k in range(25001):
        if k % 500 == 0:
            exact.append(y.copy())
        k1 = rates(y)[0]
        k2 = rates(y + h / 2 * k1)[0]
        y = y + h * rates(y + h / 2 * k2)[0]
    exact = numpy.array(exact)
    block = (f"u: {{pid: {{input: \"1.5 - angle\", proportional: {P}, integral: {I}, derivative: {D}, filter: {N} s, "
             f"limits: [-{limit}, {limit}], tracking-time: {tracking} s}}}}")
    out = sensors(wheel([block], "torque: \"u\"", "0.25 ms", sensors=("u",)))
    assert abs(out["u"]).max() == pytest.approx(limit)
    # Where the limit is left the force has a kink within a step: errors of h² u'/J.
    assert out["shaft.value"] == pytest.approx(exact[:, 0], abs=2e-3)
    assert out["shaft.value"].max() < 1.7


def test_loads_and_places_as_signals(sensors):
    """A magnet that holds a ball against gravity by where it is; the force of a spring as a signal."""
    out = sensors("""
buckens: 1
gravity: [0, 0, -10]
bodies: {ball: {rigid: {mass: 0.5 kg, inertia: [1, 1, 1]}, at: {position: [0, 0, 0.2]}}, sled: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}}}
joints: {way: {prismatic: {between: [ground, sled], axis: [0, 1, 0]}}}
signals:
  up: {position: {of: ball, along: [0, 0, 2]}}
  vz: {velocity: {of: ball, along: [0, 0, 1]}}
  lift: "5 + 200*(0.25 - up) - 10*vz"
  pull: {force-of: coil}
  push: {force-of: drive}
loads:
  magnet: {force: {on: ball, value: [0, 0, 1 N], signal: lift}}
  coil: {slide-spring: {joint: way, stiffness: 100 N/m}}
  drive: {slide-motor: {joint: way, force: "3 - 0.1*pull N"}}
simulation: {duration: 2 s, step: 1 ms}
output: {every: 10 ms, sensors: {z: {position: {of: ball, along: [0, 0, 1]}}, seen: {signal: up}, way: {joint-coordinate: way},
                                 pull: {signal: pull}, push: {signal: push}, lift: {load-force: magnet}, force: {signal: lift}}}
""")
    t = out["t"]
    # 0.5 z'' = 200 (0.25 - z) - 10 z'; from 0.2 at rest.
    d, w = 10.0, math.sqrt(400 - 100)
    z = 0.25 - 0.05 * numpy.exp(-d * t) * (numpy.cos(w * t) + d / w * numpy.sin(w * t))
    assert out["z"] == pytest.approx(z, abs=1e-5)
    assert out["seen"] == pytest.approx(out["z"], abs=1e-14)
    assert out["lift.z"] == pytest.approx(out["force"], abs=1e-12)
    # y'' = 3 - 110... : the spring pulls by -100 y, the drive by 3 + 10 y.
    assert out["way.value"] == pytest.approx(3 / 90 * (1 - numpy.cos(math.sqrt(90) * t)), abs=2e-5)
    assert out["pull"] == pytest.approx(-100 * out["way.value"], abs=1e-12)
    assert out["push"] == pytest.approx(3 + 10 * out["way.value"], abs=1e-9)


@pytest.mark.parametrize("signals, words", [
    (["a: \"b + 1\"", "b: \"2*a\""], ["algebraic loop", "\"a\" needs \"b\" needs \"a\"", "lag"]),
    (["a: \"2*a\""], ["algebraic loop", "\"a\" needs \"a\""]),
    (["f: {force-of: motor}"], ["algebraic loop", "\"u\" needs \"f\" needs \"u\""]),
    (["f: {force-of: moto}"], ["there is no load \"moto\""]),
    (["a: \"2*b\""], ["unknown name \"b\""]),
    (["sin: 2"], ["\"sin\" already has a meaning"]),
    (["a-b: 2"], ["\"a-b\" cannot be used in expressions"]),
    (["a: {joint-angle: shaf}"], ["unknown joint \"shaf\""]),
    (["a: {joint-displacement: shaft}"], ["no displacement"]),
    (["a: {value: 1, joint-angle: shaft}"], ["exactly one of the keys"]),
    (["a: {position: {of: wheel, along: [0, 0, 0]}}"], ["not a direction"]),
    (["a: {transfer-function: {input: 1, numerator: [1, 0], denominator: [1]}}"], ["exceeds that of the denominator"]),
    (["a: {state-space: {input: 1, A: [[1, 2]], B: [1], C: [1]}}"], ["1 states", "2 entries"]),
    (["a: {pid: {input: 1, derivative: 1}}"], ["\"filter\" is missing"]),
    (["a: {pid: {input: 1, proportional: 1, limits: [1, -1]}}"], ["swap"]),
])
def test_signals_that_make_no_sense_are_refused(buckens, tmp_path, signals, words):
    u = "u: \"angle\"" if "motor" not in signals[0] else "u: \"f\""
    (tmp_path / "model.yaml").write_text(wheel([u, *signals], "torque: \"u\""))
    result = buckens("check", "model.yaml")
    assert result.code in (2, 3), result.out + result.err
    for word in ["model.yaml:", *words]:
        assert word in result.err, result.err


def test_samples_have_to_fit_the_steps(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(wheel(["u: {sample-hold: {input: \"angle\", sample: 2.5 ms}}"], "torque: \"u\""))
    buckens("run", "model.yaml", "-o", "out").must(2, "model.yaml:", "\"u\"", "0.0025 s", "2.5 steps", "0.001 s")


SWITCH = """
buckens: 1
gravity: [0, 0, -10]
bodies: {ball: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}, at: {position: [0, 0, 2]}}}
joints: {way: {prismatic: {between: [ground, ball], axis: [0, 0, 1]}}}
signals:
  up: {position: {of: ball, along: [0, 0, 1]}}
  low: "up - 1.2"
  height: "up - 0.05"
  brake: {switch: {input: up, on: 1.2, off: 5}}
  thrust: "12*brake"
events:
  braked: {when: low, direction: falling}
  landed: {when: height, direction: falling, do: stop}
loads: {jet: {force: {on: ball, value: [0, 0, 1 N], signal: thrust}}}
simulation: {duration: 5 s, step: 5 ms}
output: {every: 10 ms, sensors: {z: {position: {of: ball, along: [0, 0, 1]}}, brake: {signal: brake}}}
"""


def test_an_event_stops_the_run_and_a_switch_sets_a_load(sensors, tmp_path):
    """Free fall from 2 m; below 1.2 m a jet pushes upwards by 2 m/s² more than the weight."""
    out = sensors(SWITCH)
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    braked, landed = (float(note.split("t = ")[1].split(" s")[0]) for note in summary["notes"] if note.startswith("event"))
    # Motion within a step is known to h⁴; here it is a parabola, exactly.
    assert braked == pytest.approx(0.4, abs=1e-9)
    # The jet sets in at the end of the step in which the level is reached: here at its end exactly.
    assert out["brake"][out["t"] < 0.395].max() == 0 and out["brake"][out["t"] > 0.405].min() == 1
    # 1.15 = 4 s - s²; the jet may be late by a step: 2 * 12 h²/(2 * 2.9).
    assert landed - 0.4 == pytest.approx(2 - math.sqrt(4 - 1.15), abs=3e-2)
    assert summary["finished"] and summary["end_time"] == pytest.approx(landed, abs=5e-3)
    assert out["t"][-1] == pytest.approx(summary["end_time"], abs=1e-12)


def test_a_controller_that_diverges_is_named(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text("""
buckens: 1
planar: xy
bodies: {arm: {rigid: {mass: 1, inertia: [0, 0, 0.01]}}}
joints: {rail: {prismatic: {between: [ground, arm], axis: [1, 0, 0]}}}
signals:
  place: {joint-coordinate: rail}
  error: "0.1 - place"
  u: {integral: {input: "60*u + error"}}
loads: {motor: {slide-motor: {joint: rail, force: "u"}}}
simulation: {duration: 5 s, step: 1 ms}
""")
    buckens("run", "model.yaml", "-o", "out").must(4, "model.yaml:9:", "signal \"u\" has grown to", "diverges", "`limits`")


DIVERGING = """
buckens: 1
bodies: {b: {rigid: {mass: 1, com: [0.5, 0, 0], inertia: [0.01, 0.01, 0.01]}}}
joints: {hinge: {revolute: {between: [ground, b/origin], axis: [0, 1, 0]}}}
signals:
SIGNALS
loads:
  motor: {hinge-motor: {joint: hinge, torque: "u"}}
  spring: {hinge-spring: {joint: hinge, stiffness: 1}}
simulation: {duration: 5 s, step: 1 ms}
"""


@pytest.mark.parametrize("signals, named, others", [
    ("""  angle: {joint-angle: hinge}
  u: {transfer-function: {input: "1 - angle", numerator: [1e6], denominator: [1e-3, 1, 0]}}""", "u", ["angle"]),
    ("""  speed: {joint-speed: hinge}
  u: 1 + 500*speed""", "u", ["speed"]),
])
def test_a_controller_that_diverges_is_named_where_a_step_fails(buckens, tmp_path, signals, named, others):
    """Long before its states leave all bounds: the joint turns too fast for any step, and only its name was told."""
    (tmp_path / "model.yaml").write_text(DIVERGING.replace("SIGNALS", signals))
    buckens("run", "model.yaml", "-o", "out").must(
        4, "model.yaml:7:", f"signal \"{named}\" has grown exponentially", *[f"\"{one}\"" for one in others],
        "seems to diverge", "`limits`", "then the step at t =", "joint \"hinge\"")


def test_a_continued_run_remembers_what_has_grown(buckens, tmp_path):
    """The doublings of a signal are part of a checkpoint: one that fails soon after it was continued names it, too."""
    signals = DIVERGING.replace("SIGNALS", "  speed: {joint-speed: hinge}\n  u: 1 + 500*speed")
    (tmp_path / "model.yaml").write_text(signals)
    failed = buckens("run", "model.yaml", "-o", "out").must(4, "signal \"u\" has grown exponentially")
    since = re.search(r"from [0-9.e+]+ at t = 0.005 s", failed.err)[0]
    (tmp_path / "model.yaml").write_text(signals.replace("5 s", "11 ms"))
    buckens("run", "model.yaml", "-o", "short", "-q").must(0)
    buckens("run", "--continue", "short", "--until", "5 s").must(4, "signal \"u\" has grown exponentially", since)


def test_an_event_that_chatters_is_named(buckens, tmp_path):
    text = SWITCH.replace("low: \"up - 1.2\"", "low: \"sin(600*t)\"")
    (tmp_path / "model.yaml").write_text(text)
    buckens("run", "model.yaml", "-o", "out").must(4, "event \"braked\"", "21 times", "\"low\" chatters")
    (tmp_path / "model.yaml").write_text(SWITCH.replace("when: low", "when: lo"))
    buckens("check", "model.yaml").must(2, "model.yaml:13:", "unknown signal \"lo\"", "low")
    (tmp_path / "model.yaml").write_text(SWITCH.replace("off: 5", "off: 1.2"))
    buckens("check", "model.yaml").must(2, "model.yaml:10:", "two different levels")


def test_a_robot_arm_gets_where_it_should(sensors, tmp_path):
    text = (SOURCE / "examples" / "robot_arm/robot_arm").with_suffix(".yaml").read_text()
    out = sensors(text)
    there = out["t"] > 1.5
    assert out["shoulder.value"][there] == pytest.approx(1.2, abs=2e-3)
    assert out["elbow.value"][there] == pytest.approx(-0.9, abs=2e-3)
    # What the motors gave is in height and losses.
    assert abs(out["balance"]).max() < 0.01 * out["work"].max()
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    times = [float(note.split("t = ")[1].split(" s")[0]) for note in summary["notes"] if "event \"there\"" in note]
    assert times == pytest.approx([1.2808], abs=2e-3)  # as its page says


CURVES = """
buckens: 1
bodies: {cart: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}}}
joints: {rail: {prismatic: {between: [ground, cart], axis: [1, 0, 0]}}}
signals:
  at: {joint-displacement: rail}
  pull: {table: {input: at, points: [[0, 3], [0.5, 1], [1, 1]], EXTRA}}
  slow: {rate-limit: {input: "t < 0.5 ? 1 : 0", rising: 4, falling: 10}}
loads: {motor: {slide-motor: {joint: rail, force: "pull"}}}
simulation: {duration: 1 s, step: 1 ms}
output: {every: 5 ms, sensors: {x: {joint-coordinate: rail}, pull: {signal: pull}, slow: {signal: slow}}}
"""


def test_a_table_and_a_limit_of_rates(sensors):
    out = sensors(CURVES.replace("EXTRA", "extrapolation: hold"))
    assert out["pull"] == pytest.approx(numpy.interp(out["x.value"], [0, 0.5, 1], [3, 1, 1]), abs=1e-12)
    # x'' = 3 - 4 x until 0.5, so x = 0.75 (1 - cos 2t) to h^2.
    first = out["x.value"] < 0.5
    assert out["x.value"][first] == pytest.approx(0.75 * (1 - numpy.cos(2 * out["t"][first])), abs=1e-5)
    # Up by 4 per second to 1, from 0.5 s down by 10 per second; a lag of 1 ms at the corners.
    ramp = numpy.where(out["t"] < 0.5, numpy.minimum(4 * out["t"], 1), numpy.maximum(1 - 10 * (out["t"] - 0.5), 0))
    assert out["slow"] == pytest.approx(ramp, abs=1e-2)
    steady = (out["t"] > 0.02) & (out["t"] < 0.24) | (out["t"] > 0.52) & (out["t"] < 0.59)
    assert out["slow"][steady] == pytest.approx(ramp[steady], abs=1e-2)
    # Where the limit ends within a step the method of second order overshoots: 1e-7 with 1 ms.
    assert max(out["slow"]) <= 1 + 1e-6


@pytest.mark.parametrize("wrong, words", [
    ("points: [[0, 3], [0.5, 1], [1, 1]], EXTRA", ["covers inputs from 0 to 1", "extrapolation: hold"]),
    ("points: [[0, 3], [0, 1]]", ["signals.pull.table.points", "inputs of a table must increase", "0 follows 0"]),
    ("points: [[0, 3]]", ["signals.pull.table.points", "a table with a single point"]),
    ("falling: -1", ["falling", "positive"]),
])
def test_tables_and_limits_say_what_is_wrong(buckens, tmp_path, wrong, words):
    text = CURVES
    if wrong.startswith("falling"):
        text = text.replace("falling: 10", wrong).replace(", EXTRA", "")
    else:
        text = text.replace("points: [[0, 3], [0.5, 1], [1, 1]], EXTRA", wrong).replace(", EXTRA", "").replace("[1, 1]", "[1, 1]")
    (tmp_path / "model.yaml").write_text(text.replace("duration: 1 s", "duration: 3 s"))
    result = buckens("run", "model.yaml", "-o", "out")
    assert result.code in (2, 4), result.out + result.err
    for word in words:
        assert word in result.err, result.err


def test_a_relay_oscillates_with_the_period_of_its_hysteresis(sensors):
    """T x' = u - x with u = 1 below -c and -1 above c: a period of 2 T ln((1 + c)/(1 - c))."""
    c, T = 0.4, 0.05
    text = """
buckens: 1
bodies: {cart: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}}}
joints: {rail: {prismatic: {between: [ground, cart], axis: [1, 0, 0]}}}
signals:
  heat: {switch: {input: warm, on: -0.4, off: 0.4, start: on}}
  warm: {lag: {input: "2*heat - 1", time-constant: 50 ms}}
simulation: {duration: 1 s, step: STEP}
output: {every: STEP, sensors: {x: {signal: warm}}}
"""
    period = 2 * T * math.log((1 + c) / (1 - c))
    errors = []
    for step in (1e-3, 0.25e-3):
        out = sensors(text.replace("STEP", f"{step} s"))
        x, t = out["x"], out["t"]
        crossed = [t[k] + step * x[k] / (x[k] - x[k + 1]) for k in range(len(x) - 1) if x[k] < 0 <= x[k + 1]]
        errors.append(numpy.diff(crossed[1:]).mean() - period)
        assert abs(x).max() < c + 1.5 * step / T
    # It switches at the end of a step: each half of a period is late by up to a step, half a step on average.
    assert 0 <= errors[0] < 2e-3 and 0 <= errors[1] < 0.5e-3


def cycle_of_relay(late):
    """Period and maximum of y''' + 2 y'' + 3 y' = -sgn y where the sign changes `late`: x(T) = -x(0) and y(T - late) = 0."""
    M = numpy.zeros((4, 4))
    M[:3] = [[0, 1, 0, 0], [0, 0, 1, 0], [0, -3, -2, -1]]

    def start(T):
        E = expm(M * T)
        return numpy.append(numpy.linalg.solve(numpy.eye(3) + E[:3, :3], -E[:3, 3]), 1)

    half = brentq(lambda T: (expm(M * (T - late)) @ start(T))[0], 1.5, 2.2, xtol=1e-14)
    top = brentq(lambda t: (expm(M * t) @ start(half))[1], 0.1 * half, 0.9 * half, xtol=1e-14)
    return 2 * half, (expm(M * top) @ start(half))[0]


def test_a_relay_oscillator_has_the_cycle_of_siconos(sensors):
    """Its example RelayOscillator: verification/mechanisms/reference.json."""
    case = json.loads((SOURCE / "verification" / "mechanisms" / "reference.json").read_text())["relay"]
    text = f"""
buckens: 1
bodies: {{cart: {{rigid: {{mass: 1 kg, inertia: [1, 1, 1]}}}}}}
joints: {{rail: {{prismatic: {{between: [ground, cart], axis: [1, 0, 0]}}}}}}
signals:
  below: {{switch: {{input: out, on: -1e-12, off: 1e-12}}}}
  out: {{state-space: {{input: "2*below - 1", A: [[0, 1, 0], [0, 0, 1], [0, -3, -2]], B: [0, 0, 1], C: [1, 0, 0], start: {case["start"]}}}}}
simulation: {{duration: 40 s, step: STEP s}}
output: {{every: STEP s, sensors: {{y: {{signal: out}}}}}}
"""
    for step in (0.01, 0.0025):
        out = sensors(text.replace("STEP", str(step)))
        t, y = out["t"], out["y"]
        # Before it switches for the first time, of order two as Siconos' own rule: (w h)²/12 of 0.4.
        early = [y[round(at / step)] for at in case["t"]]
        assert early == pytest.approx(case["y"], abs=1.5e-5)
        up = numpy.flatnonzero((y[:-1] < 0) & (y[1:] >= 0) & (t[:-1] > 25))
        crossed = t[up] + step * y[up] / (y[up] - y[up + 1])
        assert len(crossed) >= 3
        # It switches at the end of a step: late by part of it, which is chance. Of order two besides.
        soonest, latest = (numpy.array(cycle_of_relay(late)) for late in (0, step))
        slack = 1e-4 * (step / 0.01) ** 2
        found = numpy.array([numpy.diff(crossed).mean(), y[t > 25].max()])
        assert (soonest - slack < found).all() and (found < latest + slack).all()
    # Siconos switches at ends of its steps, too, and before its output has changed its sign.
    assert cycle_of_relay(-case["step"])[1] < case["amplitude"] < cycle_of_relay(case["step"])[1]
