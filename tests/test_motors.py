# SPDX-License-Identifier: Apache-2.0
"""Motors on joint coordinates, and springs with characteristics."""

import math

import numpy
import pytest

# A wheel on a shaft; loads and the rest are put in.
WHEEL = """
buckens: 1
bodies: {wheel: {rigid: {mass: 2 kg, inertia: [0.1, 0.1, 0.05]}}}
joints: {shaft: {revolute: {between: [ground, wheel], axis: [0, 0, 1]}}}
LOADS
simulation: {duration: DURATION, step: STEP}
output:
  every: EVERY
  sensors: {shaft: {joint-coordinate: shaft}, torque: {spring-torque: motor}, energy: {energy: kinetic},
            work: {energy: work}, lost: {energy: dissipated}, balance: {energy: balance}}
"""


def wheel(loads, duration, step, every):
    return (WHEEL.replace("LOADS", loads).replace("DURATION", duration).replace("STEP", step)
            .replace("EVERY", every))


def test_gains_are_those_of_an_oscillator(sensors):
    """J a'' = k (a0 − a) − c a', exact; the error falls with the square of the step."""
    J, k, c, aim = 0.05, 20.0, 0.4, 0.5
    w0, d = math.sqrt(k / J), c / (2 * math.sqrt(k * J))
    w = w0 * math.sqrt(1 - d * d)
    errors = []
    for step in ("2 ms", "1 ms"):
        out = sensors(wheel("loads: {motor: {hinge-motor: {joint: shaft, angle: 0.5, stiffness: 20, damping: 0.4}}}",
                            "0.5 s", step, "10 ms"))
        t = out["t"]
        exact = aim * (1 - numpy.exp(-d * w0 * t) * (numpy.cos(w * t) + d * w0 / w * numpy.sin(w * t)))
        errors.append(numpy.abs(out["shaft.value"] - exact).max())
        assert numpy.abs(out["balance"]).max() < 2e-3  # of order h², as the work of loads is
    assert errors[1] < 5e-4
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.1)
    # Gains a million times as large: the wheel is there and rests, with the same step.
    out = sensors(wheel("loads: {motor: {hinge-motor: {joint: shaft, angle: 0.5, stiffness: 2e7, damping: 4e5}}}",
                        "0.5 s", "1 ms", "10 ms"))
    assert out["shaft.value"][-1] == pytest.approx(0.5, abs=1e-6)


def test_a_motor_stalls_at_its_limit_against_a_stop(sensors):
    out = sensors(wheel("""loads:
  motor: {hinge-motor: {joint: shaft, angle: 2, stiffness: 500, damping: 8, torque-limit: 3 N m}}
  end: {hinge-stop: {joint: shaft, to: 0.4, stiffness: 600, damping: 30}}
""", "2 s", "0.5 ms", "10 ms"))
    # All the way it gives the limit: 3 N m turn the wheel by t² 3/(2 J); then it leans on the stop.
    t = out["t"]
    free = t < math.sqrt(2 * 0.4 * 0.05 / 3)
    assert free.sum() > 8
    # A constant acceleration is integrated exactly.
    assert out["shaft.value"][free] == pytest.approx(0.5 * 3 / 0.05 * t[free] ** 2, abs=1e-9)
    assert out["torque"] == pytest.approx(-3, abs=1e-12)
    assert out["shaft.value"][-1] == pytest.approx(0.4 + 3 / 600, abs=1e-9)
    assert abs(out["shaft.rate"][-1]) < 1e-8
    # The torque is constant: its work is that times the way, however the wheel bounces.
    assert out["work"][-1] == pytest.approx(3 * out["shaft.value"][-1], rel=1e-3)


def test_a_motor_gives_its_power_and_brakes_beyond_it(sensors):
    out = sensors(wheel("""loads: {motor: {hinge-motor: {joint: shaft, speed: 200, damping: 5, torque-limit: 4, power-limit: 100 W}}}
initial: {joints: {shaft: {speed: 50 rad/s}}}
""", "5 s", "1 ms", "0.1 s"))
    # 100 W from 62.5 J on; the speed aimed at has 1000 J.
    limited = out["t"] < 9
    t = out["t"][limited]
    assert out["energy"][limited] == pytest.approx(0.5 * 0.05 * 2500 + 100 * t, rel=1e-6)
    assert out["work"][limited] == pytest.approx(100 * t, rel=1e-5, abs=1e-4)
    assert numpy.abs(out["balance"]).max() < 1e-3
    out = sensors(wheel("""loads: {motor: {hinge-motor: {joint: shaft, speed: 0, damping: 5, torque-limit: 4, power-limit: 10 W}}}
initial: {joints: {shaft: {speed: 50 rad/s}}}
""", "0.5 s", "1 ms", "10 ms"))
    # Braking is by the torque alone.
    assert out["shaft.rate"][:50] == pytest.approx(50 - 80 * out["t"][:50], abs=1e-6)


def test_a_motor_without_gains_has_its_speed_exactly(sensors):
    """It starts up at its limit, holds a speed that changes, gives way to a load beyond its limit, and takes it up again."""
    J, limit, load = 0.05, 3.0, 4.0
    out = sensors(wheel("""loads:
  motor: {hinge-motor: {joint: shaft, speed: "10 + 5*sin(8*t) rad/s", torque-limit: 3 N m}}
  load: {torque: {on: wheel, value: [0, 0, "-4*(t > 1)*(t < 1.1) N m"]}}
""", "2 s", "1 ms", "10 ms"))
    t, rate, torque = out["t"], out["shaft.rate"], out["torque"]
    aim = 10 + 5 * numpy.sin(8 * t)
    # Up at 60 rad/s² until it has 10 + 5 sin 8t: at 0.233 s.
    rising = t < 0.22
    assert rate[rising] == pytest.approx(limit / J * t[rising], abs=1e-9)
    holds = ((t > 0.25) & (t < 0.99)) | (t > 1.6)
    assert numpy.abs(rate[holds] - aim[holds]).max() < 1e-9
    # J times the acceleration that it is told, to the square of the step.
    # The sensor has the sign of a spring.
    assert torque[holds] == pytest.approx(-J * 40 * numpy.cos(8 * t[holds]), abs=2e-3)
    stalls = (t > 1.005) & (t < 1.095)
    assert torque[stalls] == pytest.approx(-limit, abs=1e-12)
    assert numpy.diff(rate[stalls]) == pytest.approx((limit - load) / J * 0.01, abs=1e-9)
    assert numpy.abs(torque).max() <= limit
    # The load comes and goes at 10 rad/s within a step: 40 W for a millisecond.
    assert numpy.abs(out["balance"]).max() < 0.05


def test_a_motor_without_gains_starts_at_its_speed(sensors):
    """Started with it, from the first step on: the acceleration that the law of time says is there."""
    out = sensors(wheel("""loads: {motor: {slide-motor: {joint: way, velocity: "0.2 + 3*t m/s", force-limit: 50 N}}}
initial: {joints: {way: {velocity: 0.2 m/s}}}
""", "0.2 s", "2 ms", "2 ms").replace("shaft: {revolute: {between: [ground, wheel], axis: [0, 0, 1]}}",
                                      "way: {prismatic: {between: [ground, wheel], axis: [1, 0, 0]}}")
                  .replace("shaft: {joint-coordinate: shaft}", "way: {joint-coordinate: way}").replace("spring-torque", "spring-force"))
    assert out["torque"] == pytest.approx(-6.0, abs=1e-9)
    assert out["way.value"] == pytest.approx(0.2 * out["t"] + 1.5 * out["t"] ** 2, abs=1e-12)


def test_a_motor_without_gains_follows_an_angle(sensors):
    """Held exactly, it gives way to a load beyond its limit, and comes back by e' = -e/T."""
    J, T = 0.05, 0.2
    out = sensors(wheel("""loads:
  motor: {hinge-motor: {joint: shaft, angle: "0.4*sin(3*t)", return-time: 200 ms, torque-limit: 3 N m}}
  load: {torque: {on: wheel, value: [0, 0, "-5*(t > 0.2)*(t < 0.3) N m"]}}
initial: {joints: {shaft: {speed: 1.2}}}
""", "1.2 s", "0.5 ms", "5 ms"))
    t, torque = out["t"], out["torque"]
    error = 0.4 * numpy.sin(3 * t) - out["shaft.value"]
    before = t < 0.2
    # Positions are integrals of the exact speed, by the method: T times the h² of it, (3 h)²/12 of 1.2.
    assert abs(error[before]).max() < 1e-7
    # J times the acceleration; the sensor has the sign of a spring.
    assert torque[before][1:] == pytest.approx(3.6 * J * numpy.sin(3 * t[before][1:]), abs=2e-3)
    stalls = (t > 0.205) & (t < 0.295)
    assert torque[stalls] == pytest.approx(-3.0, abs=1e-12)
    assert numpy.diff(out["shaft.rate"][stalls]) == pytest.approx(-2 / J * 5e-3, abs=1e-9)
    assert abs(torque).max() <= 3.0
    # It has the return speed again once it has turned round: from then on the error fades.
    back = numpy.flatnonzero((t > 0.31) & (abs(torque) < 2.99))[1]
    assert error[back] > 0.2
    fades = error[back] * numpy.exp(-(t[back:] - t[back]) / T)
    # Of second order in h/T: (h/T)² t/(12 T) = 2e-6 of the error, and 1e-7 as before.
    assert error[back:] == pytest.approx(fades, abs=1e-5 * error[back])


def test_a_motor_on_its_way_back_has_its_torque_from_the_start(sensors):
    """x' = (a - x)/T, so x'' = -x'/T from t = 0 on, though the angle aimed at does not move."""
    J, T, a = 0.05, 0.2, 0.1
    out = sensors(wheel("""loads: {motor: {hinge-motor: {joint: shaft, angle: 0.1, return-time: 200 ms, torque-limit: 3 N m}}}
initial: {joints: {shaft: {speed: 0.5}}}
""", "0.2 s", "0.5 ms", "5 ms"))
    exact = a * (1 - numpy.exp(-out["t"] / T))
    # Of second order in h/T: (h/T)² t/(12 T) of 0.1, 5e-8.
    assert out["shaft.value"] == pytest.approx(exact, abs=1e-7)
    # The multiplier finds its way in the first steps: 3e-5, and a quarter of it with half the step.
    assert out["torque"] == pytest.approx(J * 0.5 / T * numpy.exp(-out["t"] / T), rel=5e-5)


def test_a_motor_without_gains_has_a_limit_of_power(sensors):
    """J w w' = P once P/w is below the limit, 3 N m up to 20 rad/s; then it holds its speed; braking has no such limit."""
    J, P = 0.05, 60.0
    out = sensors(wheel("""loads:
  motor: {hinge-motor: {joint: shaft, speed: "t < 1.6 ? 40 : 25", torque-limit: 3 N m, power-limit: 60 W}}
""", "2.5 s", "1 ms", "10 ms"))
    t, rate, torque = out["t"], out["shaft.rate"], out["torque"]
    full = t < 0.33
    assert rate[full] == pytest.approx(60 * t[full], abs=1e-9)
    # From w = 20 at t = 1/3: w² = 400 + 2 P (t - 1/3)/J, up to 40 at 0.833 s.
    drives = (t > 0.34) & (t < 0.82)
    # By (h/t)²; the corner lies within a step.
    assert rate[drives] == pytest.approx(numpy.sqrt(400 + 2 * P / J * (t[drives] - 1 / 3)), rel=2e-5)
    assert -torque[drives] * rate[drives] == pytest.approx(P, rel=1e-6)
    holds = (t > 0.85) & (t < 1.59)
    assert rate[holds] == pytest.approx(40, abs=1e-9) and abs(torque[holds]).max() < 1e-7
    brakes = (t > 1.61) & (t < 1.84)
    assert torque[brakes] == pytest.approx(3, abs=1e-12)
    assert rate[-1] == pytest.approx(25, abs=1e-9)


def test_stiff_gains_stall_at_their_limit(sensors):
    """Where the torque leaves its limit depends on 1e-5 of the speed aimed at, and on less with higher gains."""
    for gain in (1e4, 1e6, 1e9):
        out = sensors(wheel(f"loads: {{motor: {{hinge-motor: {{joint: shaft, speed: 10, damping: {gain}, torque-limit: 3}}}}}}",
                            "0.3 s", "1 ms", "10 ms"))
        assert out["shaft.rate"][:16] == pytest.approx(60 * out["t"][:16], abs=1e-9)
        assert out["shaft.rate"][-1] == pytest.approx(10, abs=1e-8)


def test_characteristics_store_what_they_give(sensors):
    text = """
buckens: 1
bodies: {a: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}}, b: {like: a}, c: {like: a}, d: {like: a}}
joints:
  a: {prismatic: {between: [ground, a], axis: [1, 0, 0]}}
  b: {prismatic: {between: [ground, b], axis: [1, 0, 0]}}
  c: {prismatic: {between: [ground, c], axis: [1, 0, 0]}}
  d: {revolute: {between: [ground, d], axis: [0, 0, 1]}}
loads:
  two: {slide-spring: {joint: a, characteristic: {table: [[-1, -100], [0, 0], [1, 1000]]}}}
  hard: {slide-spring: {joint: b, stiffness: 10 N/m, characteristic: "90*displacement + 4000*displacement^3 N"}}
  drag: {slide-spring: {joint: c, characteristic: "0.5*rate*abs(rate) N"}}
  wind: {hinge-spring: {joint: d, angle: 0.1, characteristic: "5*sin(angle) + 0.1*rate N m"}}
initial: {joints: {a: {velocity: 1}, b: {velocity: 1}, c: {velocity: 2}, d: {angle: 2.1}}}
simulation: {duration: 1.6 s, step: 0.1 ms}
output: {every: 1 ms, sensors: {a: {joint-coordinate: a}, b: {joint-coordinate: b}, c: {joint-coordinate: c}, f: {spring-force: hard},
                                d: {joint-coordinate: d}, potential: {energy: potential}, kinetic: {energy: kinetic}, balance: {energy: balance}}}
"""
    out = sensors(text)
    t = out["t"]
    # Two springs, 100 and 1000 N/m: the period is pi (1/10 + 1/sqrt 1000). Zeros upwards of the displacement.
    x = out["a.value"]
    up = [t[k] + (0 - x[k]) / (x[k + 1] - x[k]) * 1e-3 for k in range(1, len(t) - 1) if x[k] < 0 <= x[k + 1]]
    assert len(up) >= 3
    assert numpy.diff(up) == pytest.approx(math.pi * (0.1 + 1 / math.sqrt(1000)), rel=1e-5)
    # Duffing: v²/2 + 50 x² + 1000 x⁴ = 1/2.
    y, v = out["b.value"], out["b.rate"]
    assert 0.5 * v**2 + 50 * y**2 + 1000 * y**4 == pytest.approx(0.5, rel=1e-5)
    assert out["f"] == pytest.approx(100 * y + 4000 * y**3, abs=1e-9)
    # v' = −v²/2 from 2: v = 2/(1 + t).
    assert out["c.rate"] == pytest.approx(2 / (1 + t), rel=1e-6)
    s, w = out["d.value"] - 0.1, out["d.rate"]
    stored = 0.5 * x**2 * numpy.where(x > 0, 1000, 100) + 50 * y**2 + 1000 * y**4 + 5 * (1 - numpy.cos(s))
    # A spring of zero stiffness stores nothing at its free end, and energies by quadrature are exact.
    assert out["potential"] == pytest.approx(stored, abs=1e-9)
    assert numpy.abs(out["balance"]).max() < 1e-5


@pytest.mark.parametrize("law, words", [
    ("hinge-motor: {joint: shaft}", ["does nothing", "`torque`"]),
    ("hinge-motor: {joint: shaft, angle: 1}", ["without `stiffness`"]),
    ("hinge-motor: {joint: shaft, stiffness: 1}", ["needs a target `angle`"]),
    ("hinge-motor: {joint: shaft, angle: 1, stiffness: 5, speed: 1}", ["without `damping`"]),
    ("hinge-motor: {joint: shaft, speed: 1}", ["without `damping`", "`torque-limit`, which is missing", "`prescribed-rotation`"]),
    ("hinge-motor: {joint: shaft, speed: 1, torque: 2, torque-limit: 5}", ["applies whatever force is needed", "remove this key"]),
    ("hinge-motor: {joint: shaft, speed: 9, damping: 2, power-limit: 50 W}", ["does not limit the torque at rest", "`torque-limit`"]),
    ("hinge-motor: {joint: shaft, angle: 1, return-time: 0.1}", ["without `stiffness`", "`torque-limit`, which is missing"]),
    ("hinge-motor: {joint: shaft, speed: 1, return-time: 0.1, torque-limit: 5}", ["no target `angle` to return to"]),
    ("hinge-motor: {joint: shaft, angle: 1, stiffness: 3, return-time: 0.1}", ["applies to a motor without gains"]),
    ("hinge-motor: {joint: shaft, angle: 1, speed: 2, return-time: 0.1, torque-limit: 5}", ["rate of `angle` follows from its law", "remove the key"]),
    ("hinge-motor: {joint: shaft, angle: 1, return-time: 4 ms, torque-limit: 5}", ["0.004 s is less than 5 steps of 0.001 s", "at least 0.005 s"]),
    ("hinge-motor: {joint: shaft, torque: 1, damping: 1}", ["needs a target `speed`"]),
    ("hinge-motor: {joint: shaft, torque: 1, torque-limit: -1}", ["be positive", "torque-limit"]),
    ("slide-motor: {joint: shaft, force: 1}", ["\"shaft\" is a revolute", "no displacement"]),
    ("hinge-spring: {joint: shaft, characteristic: \"3*x N m\"}", ["unknown name \"x\"", "characteristic"]),
    ("hinge-spring: {joint: shaft, characteristic: \"1/angle N m\"}", ["at angle = 0", "finite"]),
    ("hinge-spring: {joint: shaft, characteristic: \"3*angle N\"}", ["a force", "torque"]),
    ("hinge-spring: {joint: shaft, characteristic: {table: [[0, 1], [-1, 2]]}}", ["must increase"]),
])
def test_motors_that_make_no_sense_are_refused(buckens, tmp_path, law, words):
    (tmp_path / "model.yaml").write_text(wheel(f"loads: {{motor: {{{law}}}}}", "1 s", "1 ms", "1 s"))
    buckens("check", "model.yaml").must(2, "model.yaml:5:", *words)


def test_a_table_that_ends_says_where(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(wheel(
        "loads: {motor: {hinge-spring: {joint: shaft, characteristic: {table: [[-0.1, -1], [0.1, 1]]}}}}\n"
        "initial: {joints: {shaft: {speed: 50 rad/s}}}", "1 s", "1 ms", "1 s"))
    buckens("run", "model.yaml", "-o", "out").must(4, "model.yaml:5:", "\"motor\"", "covers -0.1 to 0.1", "extrapolation: hold")
