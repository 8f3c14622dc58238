# SPDX-License-Identifier: Apache-2.0
"""Springs, dampers, friction and motors whose parameters follow time and signals."""

import numpy
import pytest

# A block of 2 kg on a slider along x, 0.5 m from the ground's origin, and the same inertia on a hinge.
SLIDE = """buckens: 1
gravity: [0, 0, 0]
bodies: {block: {rigid: {mass: 2 kg, inertia: [2, 2, 2]}, at: {position: [0.5, 0, 0]}}}
joints: {rail: {prismatic: {between: [{ground: [0.5, 0, 0]}, block], axis: [1, 0, 0]}}}
signals: {SIGNALS}
loads: {spring: LAW}
initial: {joints: {rail: {displacement: START, velocity: SPEED}}}
simulation: {duration: DURATION, step: STEP}
output:
  every: 10 ms
  sensors:
    x: {relative: {between: [ground, block], quantity: position}}
    v: {velocity: {of: block, along: [1, 0, 0]}}
    total: {energy: total}
    balance: {energy: balance}
    brought: {energy: {kind: loads, of: spring}}
    held: {energy: {kind: springs, of: spring}}
    lost: {energy: {kind: damping, of: spring}}
"""
HINGE = """buckens: 1
gravity: [0, 0, 0]
bodies: {block: {rigid: {mass: 2 kg, inertia: [2, 2, 2]}}}
joints: {rail: {revolute: {between: [ground, block], axis: [0, 0, 1]}}}
signals: {SIGNALS}
loads: {spring: LAW}
initial: {joints: {rail: {angle: START, speed: SPEED}}}
simulation: {duration: DURATION, step: STEP}
output:
  every: 10 ms
  sensors:
    angle: {joint-coordinate: rail}
    v: {angular-velocity: {of: block, along: [0, 0, 1]}}
    total: {energy: total}
    balance: {energy: balance}
    brought: {energy: {kind: loads, of: spring}}
    held: {energy: {kind: springs, of: spring}}
    lost: {energy: {kind: damping, of: spring}}
"""
# Kind: model, law with K, C, FREE (beyond the position as placed) and an addition MORE.
LINE = "{spring-damper: {between: [ground, block], stiffness: K, damping: C, length: FREEMORE}}"
SPRINGS = {
    "spring-damper": (SLIDE, LINE, "0.5 + "),
    "slide-spring": (SLIDE, "{slide-spring: {joint: rail, stiffness: K, damping: C, displacement: FREEMORE}}", ""),
    "hinge-spring": (HINGE, "{hinge-spring: {joint: rail, stiffness: K, damping: C, angle: FREEMORE}}", ""),
    "torsional-spring": (HINGE, "{torsional-spring: {between: [ground, block], axis: [0, 0, 1], stiffness: K, damping: C, angle: FREEMORE}}", ""),
    "with a characteristic": (SLIDE, "{slide-spring: {joint: rail, stiffness: K, damping: C, displacement: FREE, "
                              "characteristic: \"0*displacement N\"MORE}}", ""),
}


def filled(name, signals="", k="0", c="0", free="0", more="", start="0", speed="0", duration="0.5 s", step="1 ms", method=""):
    model, law, rest = SPRINGS[name]
    law = law.replace("K", k).replace("FREE", f"\"{rest}{free}\"").replace("C,", c + ",").replace("MORE", more)
    return (model.replace("SIGNALS", signals).replace("LAW", law).replace("START", start).replace("SPEED", speed)
            .replace("DURATION", duration).replace("STEP", step + method))


def way(out):
    return out["x.x"] - 0.5 if "x.x" in out else out["angle.value"]


@pytest.mark.parametrize("name", SPRINGS)
@pytest.mark.parametrize("law", ["0.01*sin(7*t)", "shift"])
def test_a_driven_free_length_is_a_forced_oscillator(sensors, name, law):
    """m x'' = k (s - x), s = a sin(W t): exact, and of second order; by a law of time and by a signal."""
    w, W, a = numpy.sqrt(800 / 2), 7.0, 0.01
    errors, balances = [], []
    for step in ("2 ms", "1 ms"):
        out = sensors(filled(name, "shift: \"0.01*sin(7*t)\"" if law == "shift" else "", k="800", free=law, step=step), "-q")
        exact = a * w**2 / (w**2 - W**2) * (numpy.sin(W * out["t"]) - W / w * numpy.sin(w * out["t"]))
        errors.append(numpy.abs(way(out) - exact).max())
        balances.append(numpy.abs(out["balance"]).max())
        # All the energy there is came in by the spring; the rest of a step's error is that of the balance.
        assert out["brought"] == pytest.approx(out["total"], abs=1.01 * balances[-1] + 1e-15)
    assert errors[0] < 2e-5 and 3.9 < errors[0] / errors[1] < 4.1
    assert balances[0] < 2e-3 * out["total"].max() and balances[0] / balances[1] > 3.8


@pytest.mark.parametrize("name", SPRINGS)
def test_a_stiffness_follows_a_signal(sensors, name):
    """m x'' = -k0 (1 + p cos 2 t) x against Runge and Kutta; what comes in is 1/2 k' x^2, integrated apart."""
    def rates(t, y):
        return numpy.array([y[1], -400 * (1 + 0.3 * numpy.cos(20 * t)) / 2 * y[0], -0.5 * 400 * 0.3 * 20 * numpy.sin(20 * t) * y[0]**2])

    errors = []
    for step in ("2 ms", "1 ms"):
        out = sensors(filled(name, "stiffer: \"0.3*cos(20*t)\"", k="\"400*(1 + stiffer)\"", start="0.02", step=step), "-q")
        y, exact, h = numpy.array([0.02, 0.0, 0.0]), [], 1e-4
        for n in range(5001):
            if n % 100 == 0:
                exact.append(y)
            t = n * h
            a = rates(t, y)
            b = rates(t + h / 2, y + h / 2 * a)
            c = rates(t + h / 2, y + h / 2 * b)
            d = rates(t + h, y + h * c)
            y = y + h / 6 * (a + 2 * b + 2 * c + d)
        exact = numpy.array(exact)
        errors.append((numpy.abs(way(out) - exact[:, 0]).max() / 0.02, numpy.abs(out["brought"] - exact[:, 2]).max() / 0.08,
                       numpy.abs(out["balance"]).max() / 0.08))
    assert errors[0][0] < 2e-3 and errors[0][1] < 2e-3
    for coarse, fine in zip(*errors):
        assert 3.7 < coarse / fine < 4.3


@pytest.mark.parametrize("name", SPRINGS)
def test_a_damper_is_switched_by_the_motion(sensors, name):
    """Free until x = 0.0995, read at the end of the step at t = 0.1; then v = e^(-c t/m). What it takes is accounted for."""
    position = "joint-angle: rail" if "hinge" in name or "torsional" in name else "joint-displacement: rail"
    out = sensors(filled(name, f"at: {{{position}}}, hard: {{switch: {{input: at, on: 0.0995}}}}", c="\"8*hard\"", speed="1", method=", method: newmark"), "-q")
    after = numpy.maximum(out["t"] - 0.1, 0.0)
    speed = numpy.exp(-4 * after)
    # (c h/m)^2/12 per unit of c t/m of the trapezoidal rule; other methods take a jump of the force half a step late.
    assert out["v"] == pytest.approx(speed, abs=3e-5)
    assert out["lost"] == pytest.approx(1 - out["v"]**2, abs=2e-5)
    assert numpy.abs(out["balance"]).max() < 2e-5


@pytest.mark.parametrize("name", SPRINGS)
def test_a_damper_that_follows_its_own_speed_has_no_delay(sensors, name):
    """c = 6 |v| is the drag m v' = -6 v^2: v = 1/(1 + 3 t). A step of delay would cost an order."""
    rate = "joint-speed: rail" if "hinge" in name or "torsional" in name else "joint-velocity: rail"
    errors = []
    for step in ("10 ms", "5 ms"):
        out = sensors(filled(name, f"v: {{{rate}}}", c="\"6*abs(v)\"", speed="1", step=step), "-q")
        errors.append(numpy.abs(out["v"] - 1 / (1 + 3 * out["t"])).max())
    assert errors[0] < 1e-3 and errors[0] / errors[1] > 3.7


def test_a_stiff_controller_of_a_free_length_converges(sensors):
    """A free displacement of -999 x makes the spring a thousand times as stiff: part of the tangent, at any step."""
    text = filled("slide-spring", "at: {joint-displacement: rail}", k="1000", free="-999*at", start="1e-3", step="5 ms")
    stiff = sensors(text, "-q")
    plain = sensors(filled("slide-spring", k="1e6", start="1e-3", step="5 ms"), "-q")
    # The same motion to what the iteration leaves.
    assert way(stiff) == pytest.approx(way(plain), abs=1e-9)


def test_a_sampled_stiffness_jumps(sensors):
    """Held for 50 ms each: harmonic pieces. What a jump gives is 1/2 dk x^2, where it happens."""
    errors = []
    for step in ("1 ms", "0.5 ms"):
        out = sensors(filled("slide-spring", "k: {sample-hold: {input: \"400 + 300*cos(20*t)\", sample: 50 ms}}", k="k", start="0.02",
                             step=step, method=", method: newmark"), "-q")
        y, brought, exact = numpy.array([0.02, 0.0]), 0.0, []
        for n in range(51):
            t = n * 0.01
            if n % 5 == 0:
                new = 400 + 300 * numpy.cos(20 * t)
                brought += 0.5 * (new - k) * y[0]**2 if n else 0.0
                k = new
            exact.append((y[0], brought))
            w = numpy.sqrt(k / 2)
            c, s = numpy.cos(w * 0.01), numpy.sin(w * 0.01)
            y = numpy.array([c * y[0] + s / w * y[1], -w * s * y[0] + c * y[1]])
        exact = numpy.array(exact)
        errors.append((numpy.abs(way(out) - exact[:, 0]).max() / 0.02, numpy.abs(out["brought"] - exact[:, 1]).max() / 0.1))
        # The energy of Newmark's method is that of the springs at the ends of steps, exactly.
        assert numpy.abs(out["balance"]).max() < 1e-12
    for coarse, fine in zip(*errors):
        assert coarse < 1e-3 and 3.5 < coarse / fine < 4.5


BUSHING = """buckens: 1
gravity: [0, 0, 0]
bodies: {block: {rigid: {mass: 2 kg, inertia: [2, 2, 2]}, at: {position: [0.5, 0, 0]}}}
joints: {mount: {bushing: {between: [{ground: [0.5, 0, 0]}, block], stiffness: [400, 400, 400], damping: [1, 1, 1]FACTORS}}}
signals: {v: {velocity: {of: block, along: [1, 0, 0]}}, stiffer: "0.3*cos(20*t)"}
initial: {bodies: {block: {velocity: [1, 0, 0]}}}
simulation: {duration: 0.5 s, step: STEP}
output:
  every: 10 ms
  sensors: {v: {velocity: {of: block, along: [1, 0, 0]}}, balance: {energy: balance}, brought: {energy: {kind: loads, of: mount}},
            lost: {energy: {kind: damping, of: mount}}, total: {energy: total}}
"""


def test_the_factors_of_a_bushing_follow_signals(sensors):
    drag = []
    for step in ("10 ms", "5 ms"):
        out = sensors(BUSHING.replace("STEP", step).replace("[400, 400, 400]", "[0, 0, 0]")
                      .replace("FACTORS", ", damping-factor: \"6*abs(v)\""), "-q")
        drag.append(numpy.abs(out["v"] - 1 / (1 + 3 * out["t"])).max())
    assert drag[0] < 1e-3 and drag[0] / drag[1] > 3.7
    account = []
    for step in ("2 ms", "1 ms"):
        out = sensors(BUSHING.replace("STEP", step).replace("FACTORS", ", stiffness-factor: \"1 + stiffer\", damping-factor: 0.5"), "-q")
        account.append(numpy.abs(out["balance"]).max())
        assert numpy.abs(out["brought"]).max() > 0.05
        assert out["total"] == pytest.approx(1 + out["brought"] - out["lost"], abs=1.01 * account[-1])
    # The spring of a slider with the same stiffness, by another law.
    slide = sensors(filled("slide-spring", "stiffer: \"0.3*cos(20*t)\"", k="\"400*(1 + stiffer)\"", c="0.5", speed="1"), "-q")
    assert out["v"] == pytest.approx(slide["v"], abs=1e-9)
    assert account[0] < 1e-3 and account[0] / account[1] > 3.7


def test_a_tension_follows_signals(sensors):
    """A damper to the sky: the force -c v of the block itself, here as an additional tension."""
    out = sensors(filled("spring-damper", "v: {joint-velocity: rail}", more=", force: \"8*v N\"", speed="1"), "-q")
    assert out["v"] == pytest.approx(numpy.exp(-4 * out["t"]), abs=1e-5)
    # A force by signals comes from outside, also where it brakes.
    assert out["brought"] == pytest.approx(out["v"]**2 - 1, abs=2e-5)


def test_a_run_goes_on_with_driven_parameters(goes_on):
    goes_on(filled("spring-damper", "k: {sample-hold: {input: \"400 + 300*cos(20*t)\", sample: 50 ms}}, s: {integral: {input: \"0.1*cos(9*t)\"}}, "
                   "at: {joint-displacement: rail}", k="k", c="\"3 + 100*at\"", free="s", start="0.02"), "0.5 s", "0.25 s", 51)


def test_statics_and_vibrations_take_signals_as_they_start(buckens, tmp_path):
    text = filled("slide-spring", "more: {setting: 600}", k="\"200 + more\"", free="0.01").replace("gravity: [0, 0, 0]", "gravity: [4, 0, 0]")
    (tmp_path / "model.yaml").write_text(text.replace("initial: {joints: {rail: {displacement: 0, velocity: 0}}}", "initial: {start: static}"))
    buckens("run", "model.yaml", "-o", "out", "-q").must(0)
    rows = [line.split(",") for line in (tmp_path / "out" / "sensors.csv").read_text().splitlines() if not line.startswith("#")]
    # 8 N on 800 N/m.
    assert float(rows[1][1]) == pytest.approx(0.5 + 0.01 + 8 / 800, abs=1e-9)
    assert float(rows[-1][1]) == pytest.approx(float(rows[1][1]), abs=1e-9)
    modes = buckens("modes", "model.yaml", "--system", "--about", "static", "--count", 1, "--json").must(0).json["analyses"][0]["modes"]
    assert modes[0]["frequency"] == pytest.approx(20 / (2 * numpy.pi), rel=1e-9)


@pytest.mark.parametrize("name, signals, laws, words", [
    ("slide-spring", "pull: {force-of: spring}", {"k": "\"100 + pull\""}, ['"pull" needs "pull"']),
    ("spring-damper", "pull: {sensor: {of: tension}}, twice: \"2*pull\"", {"free": "twice"}, ['"pull" needs "twice" needs "pull"']),
])
def test_loops_are_refused_by_name(buckens, tmp_path, name, signals, laws, words):
    text = filled(name, signals, **laws).replace("    total:", "    tension: {spring-force: spring}\n    total:")
    (tmp_path / "model.yaml").write_text(text)
    buckens("check", "model.yaml").must(3, "signals form an algebraic loop", *words)


def test_forces_of_driven_springs_are_signals(sensors):
    """A spring whose stiffness follows a signal is read within the step, after that signal: x grows by its own force."""
    signals = "k: \"400 + 100*sin(9*t)\", pull: {sensor: {of: tension}}, gone: {integral: {input: pull}}"
    text = filled("spring-damper", signals, k="k", start="0.02").replace("    total:", "    tension: {spring-force: spring}\n    gone: {signal: gone}\n    total:")
    out = sensors(text, "-q")
    # m v = -integral of the tension.
    assert -out["gone"] / 2 == pytest.approx(out["v"], abs=2e-6)


@pytest.mark.parametrize("name, laws, words", [
    ("slide-spring", {"k": "-3 N/m"}, ["loads.spring.slide-spring.stiffness", "-3 N/m is not allowed: the value must not be negative"]),
    ("spring-damper", {"c": "3 N/m"}, ["loads.spring.spring-damper.damping", "3 N/m", "stiffness"]),
    ("spring-damper", {"k": "\"100*stif\""}, ["loads.spring.spring-damper.stiffness", "stif"]),
    ("hinge-spring", {"k": "\"0 - 5\""}, ["loads.spring.hinge-spring.stiffness", "must not be negative"]),
])
def test_what_cannot_be_is_refused(buckens, tmp_path, name, laws, words):
    (tmp_path / "model.yaml").write_text(filled(name, "stiff: \"t\"", **laws))
    buckens("check", "model.yaml").must(2, "model.yaml:", *words)


def test_a_stiffness_below_zero_counts_as_zero(sensors):
    out = sensors(filled("slide-spring", "k: \"100*sin(10*t)\"", k="k", c="\"0 - k\"", start="0.02", duration="0.6 s"), "-q")
    # From pi/10 on the spring has let go, and the damper brakes: before, there is none.
    late = out["t"] > 0.3142
    assert out["held"][late] == pytest.approx(0.0, abs=1e-15)
    assert numpy.abs(out["lost"][~late]).max() < 1e-12 and out["lost"][-1] > 1e-4


FRICTION = """buckens: 1
gravity: [0, 0, -10]
bodies: {block: {rigid: {mass: 2 kg, inertia: [2, 2, 2]}}}
joints: {rail: {prismatic: {between: [ground, block], axis: [1, 0, 0]}}}
signals: {wear: {lag: {input: 0, time-constant: 0.2 s, start: 1}}}
loads: {rub: {slide-friction: {joint: rail, static: "0.1*wear", preload: "2*wear N"STICK}}}
initial: {joints: {rail: {velocity: 1}}}
simulation: {duration: 0.5 s, step: 1 ms}
output: {every: 10 ms, sensors: {v: {velocity: {of: block, along: [1, 0, 0]}}, lost: {energy: {kind: joint-friction, of: rub}}}}
"""


@pytest.mark.parametrize("stick", ["", ", stick: rigid", ", stick: bristles, bristle-stiffness: 1e5"])
def test_friction_follows_a_signal(sensors, stick):
    """m v' = -(0.1 m g + 2) w, w = e^(-t/T): v = 1 - 2 T (1 - w) with the deceleration 2 at the start."""
    out = sensors(FRICTION.replace("STICK", stick), "-q")
    exact = 1 - 2 * 0.2 * (1 - numpy.exp(-out["t"] / 0.2))
    assert out["v"][1:] == pytest.approx(exact[1:], abs=1e-3 if "bristles" in stick else 3e-5)
    # In the first step bristles bend, over 40 um of its 1 mm.
    assert out["lost"] == pytest.approx(1 - out["v"]**2, abs=1e-2 if "bristles" in stick else 3e-5)


def test_statics_take_friction_by_signals(buckens, tmp_path):
    """Frozen, it holds 6 N; by the signals at the start it may hold 0.1 * (20 N + 1 N) + 2 N."""
    text = FRICTION.replace("STICK", "").replace("gravity: [0, 0, -10]", "gravity: [3, 0, -10]")
    text = text.replace("initial: {joints: {rail: {velocity: 1}}}", "initial: {start: static, friction: frozen}")
    (tmp_path / "model.yaml").write_text(text.replace("loads: {", "loads: {none: {slide-brake: {joint: rail, force: \"0*wear\"}}, "
                                                    "push: {force: {on: block, value: [0, 0, -1], signal: wear}}, "))
    buckens("run", "model.yaml", "-o", "out").must(0, "frozen friction \"rub\" holds 6 N, its limit is 4.1 N (ratio 1.46341)")


BALL = """buckens: 1
gravity: [0, 0, 0]
bodies: {ball: {rigid: {mass: 1 kg, inertia: [2, 2, 2]}}}
joints: {socket: {spherical: {between: [ground, ball]}}}
signals: {wear: {lag: {input: 0, time-constant: 0.2 s, start: 1}}}
loads: {rub: {ball-friction: {joint: socket, static: 0.1, radius: 10 mm, preload: "4*wear N m"}}}
initial: {bodies: {ball: {angular-velocity: [0, 0, 1]}}}
simulation: {duration: 0.5 s, step: 1 ms}
output: {every: 10 ms, sensors: {w: {angular-velocity: {of: ball, along: [0, 0, 1]}}, lost: {energy: {kind: joint-friction, of: rub}}}}
"""


def test_friction_of_a_ball_follows_a_signal(sensors):
    """J w' = -4 e^(-t/T)."""
    out = sensors(BALL, "-q")
    assert out["w"] == pytest.approx(1 - 2 * 0.2 * (1 - numpy.exp(-out["t"] / 0.2)), abs=3e-5)
    assert out["lost"] == pytest.approx(1 - out["w"]**2, abs=3e-5)


MOTOR = """buckens: 1
gravity: [0, 0, 0]
bodies: {wheel: {rigid: {mass: 1 kg, inertia: [1, 1, 2]}}}
joints: {axle: {revolute: {between: [ground, wheel], axis: [0, 0, 1]}}}
signals: {left: {lag: {input: 0, time-constant: 0.2 s, start: 1}}}
loads: {motor: {hinge-motor: {joint: axle, LAW}}}
simulation: {duration: 0.5 s, step: 1 ms}
output: {every: 10 ms, sensors: {w: {angular-velocity: {of: wheel, along: [0, 0, 1]}}, work: {energy: {kind: drives, of: motor}}}}
"""


@pytest.mark.parametrize("law", ["speed: 1000, torque-limit: \"4*left N m\"", "speed: 1000, damping: 1000, torque-limit: \"4*left N m\"",
                                 "torque: 9, torque-limit: \"4*left\""])
def test_limits_of_motors_follow_signals(sensors, law):
    """J w' = 4 e^(-t/T)."""
    out = sensors(MOTOR.replace("LAW", law), "-q")
    # h w/12 T of the trapezoidal rule and as much of the method's weights.
    assert out["w"] == pytest.approx(2 * 0.2 * (1 - numpy.exp(-out["t"] / 0.2)), abs=6e-6)
    assert out["work"] == pytest.approx(out["w"]**2, abs=6e-6)


def test_gains_of_motors_follow_signals(sensors):
    """J w' = c(t) (1 - w): w = 1 - exp(-integral of c/J), c = 6 e^(-t/T)."""
    out = sensors(MOTOR.replace("LAW", "speed: 1, damping: \"6*left\""), "-q")
    assert out["w"] == pytest.approx(1 - numpy.exp(-3 * 0.2 * (1 - numpy.exp(-out["t"] / 0.2))), abs=3e-6)
