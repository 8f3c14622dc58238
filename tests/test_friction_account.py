# SPDX-License-Identifier: Apache-2.0
"""What friction in joints takes within a step is what the method has done, so that the energy account closes at any step length."""

import numpy
import pytest

from test_energy_account import STRUCK_CRANK, account

METHODS = {
    "generalised-α": "",
    "generalised-α without damping": ", rho-inf: 1",
    "HHT": ", method: hht, alpha: -0.2",
    "Newmark": ", method: newmark",
    "Wilson": ", method: wilson",
}

METHODS_OF_CRANK = ["generalised-α", "generalised-α without damping"]

STICKS = ["", ", stick: rigid", ", stick: bristles, bristle-stiffness: 1e6 N/m"]

BLOCK = """
buckens: 1
gravity: [0, 0, -9.81]
bodies: {block: {rigid: {mass: 2 kg, inertia: [1, 1, 1]}}}
joints: {way: {prismatic: {between: [ground, block], axis: [1, 0, 0]}}}
initial: {bodies: {block: {velocity: [3, 0, 0]}}}
"""

# It is thrown to and fro between its stops, and ends at rest.
THROWN = BLOCK + """
loads:
  rub: {slide-friction: {joint: way, static: 0.4, dynamic: 0.3, stribeck-velocity: 1 m/s, viscous: 0.5STICK}}
STOPS
simulation: {duration: 1.4 s, step: 7 msMETHOD}
output: {every: 7 ms, sensors: {x: {joint-coordinate: way}, rubbed: {energy: {kind: joint-friction, of: rub}}, struck: {energy: impacts}, balance: {energy: balance}}}
"""
BETWEEN = "  ends: {slide-stop: {joint: way, from: -0.1 m, to: 0.15 m, restitution: 0.8}}"


@pytest.mark.parametrize("method, stick", [(method, stick) for stick in STICKS for method in METHODS
                                           if stick != ", stick: rigid" or method not in ("Newmark", "Wilson")])
def test_a_block_that_friction_stops_keeps_its_balance(sensors, tmp_path, method, stick):
    """No spring and no mesh loses energy to the method: nothing is left open, however long the steps, and though friction falls by
    a quarter as the block comes to rest. (Newmark and Wilson refuse rigid stick.)"""
    out = sensors(THROWN.replace("STICK", stick).replace("STOPS\n", "").replace("METHOD", METHODS[method]))
    # What still trembles on the spring of sticking.
    assert abs(out["x.rate"][-1]) < 0.02
    assert numpy.abs(out["balance"]).max() < 1e-9
    assert out["rubbed"][-1] == pytest.approx(9, abs=1e-3)
    assert account(tmp_path)["unexplained"] == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize("method", ["generalised-α without damping", "generalised-α", "HHT"])
@pytest.mark.parametrize("law, most", [("static: 0.3", 2e-9), (None, 2e-4)])
@pytest.mark.parametrize("stick", ["", ", stick: rigid"])
def test_blows_do_not_open_it(sensors, method, law, most, stick):
    """In the step of a blow friction does what it did before it, along the way that the block has made, and what changes of it acts over
    the rest of the step. Afterwards the method begins anew, with the friction of that instant."""
    text = THROWN.replace("STICK", stick).replace("STOPS", BETWEEN).replace("METHOD", METHODS[method])
    if law:
        text = text.replace("static: 0.4, dynamic: 0.3, stribeck-velocity: 1 m/s, viscous: 0.5", law)
    out = sensors(text)
    assert abs(out["x.rate"][-1]) < 1e-6 and out["struck"][-1] > 4
    # Of 9 J. Friction that depends on the rate changes once more as the change acts.
    assert numpy.abs(out["balance"]).max() < most


@pytest.mark.parametrize("method", METHODS)
def test_friction_that_jumps_with_samples_keeps_its_balance(sensors, method):
    """Where a sample changes the preload, accelerations jump with the friction, and what the account carries along does as well."""
    text = THROWN.replace("STICK", "").replace("STOPS\n", "").replace("METHOD", METHODS[method]).replace(
        "static: 0.4, dynamic: 0.3, stribeck-velocity: 1 m/s, viscous: 0.5", "preload: held").replace(
        "loads:", "signals:\n  wave: \"6 + 5*sin(40*t)\"\n  held: {sample-hold: {input: wave, sample: 35 ms}}\nloads:")
    out = sensors(text)
    assert out["rubbed"][-1] > 8
    # At the instant of a sample the energy of the spring of sticking follows the preload at once, the account in the next step: half
    # of 10 N times 1 um. 0.04 of 9 J were open as long as the account did not follow.
    assert numpy.abs(out["balance"]).max() < 5e-6
    assert numpy.median(numpy.abs(out["balance"])) < 1e-11


# A spring with 3.2 rad per step, so that the block turns round in nearly each of them.
RINGING = BLOCK + """
loads:
  rub: {slide-friction: {joint: way, static: 0.3}}
  spring: {slide-spring: {joint: way, stiffness: 8e5}}
simulation: {duration: 0.5 s, step: 5 msMETHOD}
output: {every: 5 ms, sensors: {rubbed: {energy: joint-friction}, balance: {energy: balance}}}
"""


@pytest.mark.parametrize("method", ["generalised-α without damping", "Newmark"])
def test_a_block_that_turns_round_in_each_step_keeps_its_balance(sensors, method):
    out = sensors(RINGING.replace("METHOD", METHODS[method]))
    assert numpy.abs(out["balance"]).max() < 1e-10
    assert out["rubbed"][-1] > 0.01


@pytest.mark.parametrize("method", ["generalised-α", "HHT", "Wilson"])
def test_what_is_open_is_what_the_method_damps(sensors, method):
    """These lose energy of the spring, most of it before friction has had its share: the balance tells how much."""
    out = sensors(RINGING.replace("METHOD", METHODS[method]))
    assert -9 < out["balance"][-1] < -1


@pytest.mark.parametrize("step", ["0.2 ms", "0.1 ms", "0.05 ms"])
@pytest.mark.parametrize("method", METHODS_OF_CRANK)
def test_a_crank_that_rings_after_blows_is_open_by_little(sensors, method, step):
    """A flexible rod rings after each of some hundred blows of the slider, so that its pins turn round within steps. By the trapezoidal
    rule 0.22, 0.09 and 0.02 J of 1.09 J were open."""
    out = sensors(STRUCK_CRANK.replace("STEP", step + METHODS[method]))
    assert abs(out["balance"]).max() < 0.02 * out["work"][-1]
