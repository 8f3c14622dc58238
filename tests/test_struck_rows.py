# SPDX-License-Identifier: Apache-2.0
"""Blows on joints with friction that sticks rigidly, brakes, motors and locks: what holds by a bounded force gives way to an impulse,
what holds in any case takes part in the blow."""

import numpy
import pytest

G = 9.81
METHODS = {"generalised-α": "", "generalised-α without damping": ", rho-inf: 1", "HHT": ", method: hht, alpha: -0.2"}


def thrown(t, x_stop, v0, braking, e):
    """Place and speed of what is thrown at one stop, braked all the time, until it rests. Returns also when it rests."""
    v_hit = numpy.sqrt(v0**2 - 2 * braking * x_stop)
    t_hit = (v0 - v_hit) / braking
    back = e * v_hit
    t_rest = t_hit + back / braking
    s = numpy.clip(t - t_hit, 0, back / braking)
    x = numpy.where(t < t_hit, v0 * t - 0.5 * braking * t**2, x_stop - back * s + 0.5 * braking * s**2)
    v = numpy.where(t < t_hit, v0 - braking * t, -back + braking * s)
    return x, v, t_hit, t_rest, 0.5 * (1 - e**2) * v_hit**2


BLOCK = """
buckens: 1
gravity: [0, 0, -9.81]
bodies: {block: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}}}
joints: {way: {prismatic: {between: [ground, block], axis: [1, 0, 0]}}}
loads:
  rub: {slide-friction: {joint: way, static: 0.3, stick: rigid}}
  end: {slide-stop: {joint: way, to: 0.5 m, restitution: 0.8}}
initial: {bodies: {block: {velocity: [4, 0, 0]}}}
simulation: {duration: 1.4 s, step: 1 msMETHOD}
output: {every: 1 ms, sensors: {x: {joint-coordinate: way}, rubbed: {energy: joint-friction}, struck: {energy: impacts}, balance: {energy: balance}}}
"""

WHEEL = """
buckens: 1
bodies: {wheel: {rigid: {mass: 3 kg, inertia: [1, 1, 0.5]}}}
joints: {axle: {revolute: {between: [ground, wheel], axis: [0, 0, 1]}}}
loads:
  rub: {hinge-friction: {joint: axle, static: 0, preload: 1.5 N m, stick: rigid}}
  end: {hinge-stop: {joint: axle, to: 0.5 rad, restitution: 0.8}}
initial: {bodies: {wheel: {angular-velocity: [0, 0, 4]}}}
simulation: {duration: 1.4 s, step: 1 msMETHOD}
output: {every: 1 ms, sensors: {x: {joint-coordinate: axle}, rubbed: {energy: joint-friction}, struck: {energy: impacts}, balance: {energy: balance}}}
"""


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("text, inertia, braking", [(BLOCK, 1, 0.3 * G), (WHEEL, 0.5, 3)], ids=["block", "wheel"])
def test_friction_does_not_stop_a_rebound(sensors, text, inertia, braking, method):
    """An impulse leaves friction no time: the rebound is that of the restitution, and friction brakes the way back."""
    out = sensors(text.replace("METHOD", METHODS[method]))
    x, v, t_hit, t_rest, lost = thrown(out["t"], 0.5, 4.0, braking, 0.8)
    # Exact but for the step in which it comes to rest: there the speed of a step is braked away.
    moves = (out["t"] < t_rest - 2e-3) & (numpy.abs(out["t"] - t_hit) > 1e-3)
    assert numpy.abs(out["x.value"] - x)[moves].max() < 1e-10
    assert numpy.abs(out["x.rate"] - v)[moves].max() < 1e-9
    assert out["struck"][-1] == pytest.approx(inertia * lost, rel=1e-9)
    assert out["rubbed"][-1] == pytest.approx(8 * inertia - inertia * lost, rel=1e-9)
    assert out["x.value"][-1] == pytest.approx(x[-1], abs=5e-6)
    assert abs(out["x.rate"][-1]) < 1e-6
    assert numpy.abs(out["balance"]).max() < 1e-8


# A cart b runs on a cart a against a buffer; a is held on its rail.
CARTS = """
buckens: 1
bodies:
  a: {rigid: {mass: 3 kg, inertia: [1, 1, 1]}}
  b: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}}
joints:
  rail: {prismatic: {between: [ground, a], axis: [1, 0, 0]}}
  way: {prismatic: {between: [a, b], axis: [1, 0, 0]}}
loads:
  buffer: {slide-stop: {joint: way, from: -0.2 m, restitution: 0.5}}
HOLD
initial: {bodies: {b: {velocity: [-2, 0, 0]}}}
simulation: {duration: 0.3 s, step: 0.6 ms}
output: {every: 0.6 ms, sensors: {a: {velocity: a}, b: {velocity: b}, xa: {position: a}, xb: {position: b}, struck: {energy: impacts}, balance: {energy: balance}}}
"""


@pytest.mark.parametrize("hold, most", [
    ("  hold: {slide-friction: {joint: rail, static: 0, preload: 6 N, stick: rigid}}", 1e-9),
    ("  hold: {slide-brake: {joint: rail, force: 6 N}}", 1e-9),
    # What comes from outside is the mean of the powers at both ends of a step: 6 N times 0.75 m/s times half of 0.6 ms.
    ("  hold: {slide-motor: {joint: rail, velocity: 0 m/s, force-limit: 6 N}}", 1.4e-3),
], ids=["friction", "brake", "motor"])
def test_what_holds_by_a_bounded_force_gives_way_to_a_blow(sensors, hold, most):
    out = sensors(CARTS.replace("HOLD", hold))
    t = out["t"]
    before, after = t < 0.0994, t > 0.1007
    assert numpy.abs(out["a.x"][before]).max() < 1e-12
    # Both share the momentum, with half of the speed of approach between them: −0.75 and 0.25 m/s. The force brakes a by 2 m/s².
    assert out["a.x"][after] == pytest.approx(-0.75 + 2 * (t[after] - 0.1), abs=1e-9)
    assert out["b.x"][after] == pytest.approx(0.25, abs=1e-12)
    s = t[after] - 0.1
    assert out["xa.x"][after] == pytest.approx(-0.75 * s + s**2, abs=1e-10)
    assert out["xb.x"][after] == pytest.approx(-0.2 + 0.25 * s, abs=1e-10)
    # 2 J before; the blow leaves ½ 3 0.75² + ½ 0.25².
    assert out["struck"][-1] == pytest.approx(2 - 0.84375 - 0.03125, rel=1e-9)
    assert numpy.abs(out["balance"]).max() < most


def test_a_lock_takes_part_in_a_blow(sensors):
    """It holds by any force, and so by any impulse: the cart b is thrown back alone."""
    out = sensors(CARTS.replace("HOLD", "signals: {soon: \"t - 0.02\"}\nevents: {hold: {when: soon, lock: rail}}"))
    after = out["t"] > 0.1007
    assert numpy.abs(out["a.x"]).max() < 1e-9 and numpy.abs(out["xa.x"]).max() < 1e-10
    assert out["b.x"][after] == pytest.approx(1, rel=1e-9)
    assert out["struck"][-1] == pytest.approx(1.5, rel=1e-9)
    assert numpy.abs(out["balance"]).max() < 1e-9


BAR = """
buckens: 1
gravity: [0, -9.81, 0]
materials: {soft: {E: 1e9 Pa, nu: 0, rho: 1000 kg/m^3}}
sections: {s: {rectangle: {width: 20 mm, height: 20 mm}}}
bodies: {bar: {beam: {from: [0, 0, 0], to: [0.5 m, 0, 0], elements: 10, section: s, material: soft}}}
joints: {way: {prismatic: {between: [ground, bar/start], axis: [1, 0, 0]}}}
loads:
  wall: {slide-stop: {joint: way, from: -10 mm, restitution: 0.8}}
  rub: {slide-friction: {joint: way, static: 0.3STICK}}
initial: {bodies: {bar: {velocity: [-1 m/s, 0, 0]}}}
simulation: {duration: 0.2 s, step: 0.1 ms, rho-inf: 1}
output: {every: 1 ms, sensors: {x: {joint-coordinate: way}, rubbed: {energy: joint-friction}, balance: {energy: balance}}}
"""


def test_a_flexible_bar_rebounds_alike_with_either_stick(sensors):
    rigid, elastic = (sensors(BAR.replace("STICK", stick)) for stick in (", stick: rigid", ""))
    for out in (rigid, elastic):
        # Of 0.1 J; the method damps nothing.
        assert numpy.abs(out["balance"]).max() < 2e-5
        assert out["rubbed"][-1] > 0.06
    # Its end rings at the wall, and some hundred blows at other instants add up to millimetres.
    assert rigid["x.value"][-1] == pytest.approx(elastic["x.value"][-1], abs=2e-3)
