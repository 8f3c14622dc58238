# SPDX-License-Identifier: Apache-2.0
"""Drives of joints that follow signals: by position, speed and acceleration."""

import math

import numpy
import pytest

TURN = """
buckens: 1
bodies:
  arm: {rigid: {mass: 2 kg, com: [0.3, 0, 0], inertia: [0.01, 0.05, 0.05]}}
joints:
  hinge: {revolute: {between: [ground, arm/origin], axis: [0, 0, 1]}}
  drive: {prescribed-rotation: {between: [ground, arm/origin], axis: [0, 0, 1], LAW}}
signals: {SIGNALS}
simulation: {duration: 1 s, step: 1 ms, METHOD}
output:
  every: 5 ms
  sensors: {hinge: {joint-coordinate: hinge}, torque: {joint-torque: drive}, balance: {energy: balance}, work: {energy: work}}
"""


def turn(law, signals, method="method: generalized-alpha"):
    return TURN.replace("LAW", law).replace("{SIGNALS}", "{" + signals + "}").replace("METHOD", method)


METHODS = ["method: generalized-alpha", "method: newmark", "method: hht", "tolerance: 1e-5"]
INERTIA = 0.05 + 2 * 0.09


@pytest.mark.parametrize("method", METHODS)
def test_a_position_behind_a_second_order_filter(sensors, method):
    """Step response of 400/(s^2 + 40 s + 400): 1 - (1 + 20 t) exp(-20 t), its torque by the second derivative."""
    out = sensors(turn("angle: \"0.5*p\"", "p: {transfer-function: {input: \"1\", numerator: [400], denominator: [1, 40, 400]}}", method))
    t = out["t"]
    # Integrating the filter has the order of the method: (20 h)^2/12 and (20 h)^2/3 in accelerations.
    assert out["hinge.value"] == pytest.approx(0.5 * (1 - (1 + 20 * t) * numpy.exp(-20 * t)), abs=1e-4)
    assert out["hinge.rate"] == pytest.approx(0.5 * 400 * t * numpy.exp(-20 * t), abs=2e-3)
    late = t > 0.02
    torque = INERTIA * 0.5 * 400 * (1 - 20 * t) * numpy.exp(-20 * t)
    assert abs(out["torque.z"][late]) == pytest.approx(abs(torque[late]), abs=0.01 * abs(torque).max())
    assert abs(out["balance"]).max() < 2e-3


@pytest.mark.parametrize("method", METHODS)
def test_a_speed_by_feedback(sensors, method):
    """speed = 8 (0.6 - angle): the angle goes to 0.6 with the time constant 1/8 s."""
    out = sensors(turn("speed: \"8*(goal - angle)\"", "angle: {joint-angle: hinge}, goal: {setting: 0.6}", method))
    t = out["t"]
    assert out["hinge.value"] == pytest.approx(0.6 * (1 - numpy.exp(-8 * t)), abs=3e-5)
    assert out["hinge.rate"] == pytest.approx(4.8 * numpy.exp(-8 * t), abs=3e-4)
    # The drive begins with its speed; from there on it does all the work.
    assert out["work"][-1] == pytest.approx(0.5 * INERTIA * (out["hinge.rate"][-1] ** 2 - 4.8 ** 2), abs=2e-3)


def test_an_acceleration_by_measured_speed(sensors):
    """acceleration = 5 - 2 speed: the speed goes to 2.5 with the time constant 1/2 s."""
    out = sensors(turn("acceleration: \"5 - 2*w rad/s^2\"", "w: {joint-speed: hinge}"))
    t = out["t"]
    assert out["hinge.rate"] == pytest.approx(2.5 * (1 - numpy.exp(-2 * t)), abs=3e-5)
    assert abs(out["torque.z"][5:]) == pytest.approx(INERTIA * 5 * numpy.exp(-2 * t[5:]), abs=2e-3)


def test_the_same_as_by_a_law_of_time(sensors):
    """Without states, a signal of time drives as the law itself."""
    by_law = sensors(turn("angle: \"0.3*sin(7*t)\"", "s: \"sin(7*t)\""))
    by_signal = sensors(turn("angle: \"0.3*s\"", "s: \"sin(7*t)\""))
    for name in ("hinge.value", "hinge.rate", "torque.z"):
        # Derivatives of formulas come from differences of 1e-11.
        assert by_signal[name] == pytest.approx(by_law[name], abs=1e-7 * abs(by_law[name]).max())


def test_a_start_away_from_zero_and_a_step_by_an_event(sensors):
    """A filter that starts at 0.2; an event changes the goal, and the speed has a corner there."""
    text = turn("angle: p", "goal: {setting: 0.2}, half: \"t - 0.5\", p: {lag: {input: q, time-constant: 50 ms, start: 0.2}}, "
                "q: {lag: {input: goal, time-constant: 50 ms, start: 0.2}}")
    out = sensors(text.replace("simulation:", "events: {go: {when: half, set: {goal: 0.7}}}\nsimulation:"))
    t = out["t"]
    after = numpy.maximum(t - 0.5, 0)
    assert out["hinge.value"] == pytest.approx(0.7 - 0.5 * (1 + 20 * after) * numpy.exp(-20 * after), abs=5e-4)
    assert numpy.ptp(out["hinge.value"][t < 0.499]) < 1e-12


SLIDE = """
buckens: 1
planar: xy
gravity: [0, -9.81, 0]
materials: {steel: {E: 70 GPa, nu: 0.3, rho: 2700 kg/m^3, damping: {stiffness: 5e-3 s}}}
bodies:
  cart: {rigid: {mass: 3 kg, inertia: [0, 0, 0.1]}}
  mast: {beam: {to: [0, 0.8, 0], elements: 6, section: {rectangle: {width: 10 mm, height: 6 mm}}, material: steel}}
joints:
  rail: {prismatic: {between: [ground, cart], axis: [1, 0, 0]}}
  foot: {fixed: {between: [cart, mast/start]}}
  drive: {prescribed-translation: {between: [ground, cart], axis: [1, 0, 0], velocity: u}}
signals:
  tip: {position: {of: mast/end, along: [1, 0, 0]}}
  u: {pid: {input: "0.3 - tip", proportional: 2, integral: 1, limits: [-0.4, 0.4]}}
simulation: {duration: 10 s, step: 2 ms}
output: {every: 10 ms, sensors: {x: {joint-coordinate: rail}, tip: {position: {of: mast/end, along: [1, 0, 0]}}, u: {signal: u}}}
"""


def test_a_cart_under_a_flexible_mast(sensors):
    """Its speed is what the controller of the tip says, at every instant; with less damping of the mast the loop is unstable."""
    out = sensors(SLIDE)
    assert out["x.rate"] == pytest.approx(out["u"], abs=1e-9)
    assert max(out["u"]) == 0.4  # at its limit first
    # Free of its limit the error obeys e'' + 2 e' + e = 0: t e^-t, 1e-3 m after eight seconds or so.
    assert out["tip"][-1] == pytest.approx(0.3, abs=2e-3)


REFUSED = {
    ("angle: a", "a: {joint-angle: other}"): ["`angle` follows signal \"a\"", "measured position", "coupler", "`speed`"],
    ("angle: \"2*g\"", "g: {setting: 1}"): ["follows signal \"g\"", "jumps", "`lag`"],
    ("angle: p", "p: {pid: {input: \"t\", proportional: 1, limits: [-1, 1]}}"): ["\"p\"", "corners"],
    ("speed: \"2*w\"", "w: {joint-speed: other}"): ["`speed` follows signal \"w\"", "speed or force", "`acceleration`"],
    ("speed: u", "w: {joint-speed: other}, u: \"3*w\""): ["follows signal \"w\""],
    ("angle: p", "w: {joint-speed: other}, p: {lag: {input: w, time-constant: 1 s}}"): ["`angle` follows signal \"w\"", "`speed`"],
    ("speed: nix", "w: {joint-speed: other}"): ["nix"],
}


@pytest.mark.parametrize("case", range(len(REFUSED)))
def test_what_no_drive_can_follow_is_refused_by_name(buckens, tmp_path, case):
    law, signals = list(REFUSED)[case]
    text = turn(law, signals).replace("joints:\n", "  disc: {rigid: {mass: 1, inertia: [1, 1, 1]}}\njoints:\n"
                                      "  other: {revolute: {between: [ground, disc], axis: [0, 0, 1]}}\n", 1)
    (tmp_path / "model.yaml").write_text(text)
    result = buckens("check", "model.yaml")
    assert result.code in (2, 3), result.out + result.err
    for word in REFUSED[law, signals]:
        assert word in result.err, result.err
