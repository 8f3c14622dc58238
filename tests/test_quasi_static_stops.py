# SPDX-License-Identifier: Apache-2.0
"""A slider-crank with a quasi-static rod that runs against rigid stops: it goes on as a stiff rod would, or says what holds it."""

import numpy
import pytest

from elastic_crank import ELASTIC_CRANK

STIFF = "7e6 GPa"
SOFT = "70 GPa"


def crank(flexibility, modulus, stop="", more="", duration="0.15 s"):
    """The crank starts at 30° and 20 rad/s; its slider runs against a stop 50 mm further."""
    return (ELASTIC_CRANK.replace("E: 70 GPa", f"E: {modulus}")
            .replace("    at: {position: [0.1, 0, 0]}\n", f"    flexibility: {flexibility}\n    at: {{position: [0.1, 0, 0]}}\n")
            .replace("{angle: 30 deg}", "{angle: 30 deg, speed: 20 rad/s}") + f"""
loads:
  stop: {{slide-stop: {{joint: d, from: -50 mm{stop}}}}}
{more}simulation: {{duration: {duration}, step: 0.1 ms}}
output:
  every: 1 ms
  sensors: {{a: {{joint-coordinate: a}}, d: {{joint-coordinate: d}}, balance: {{energy: balance}}, lost: {{energy: impacts}}, total: {{energy: total}},
    stop: {{spring-force: stop}}}}
""")


@pytest.mark.parametrize("stop, same", [("", 1e-5), (", restitution: 0.5", 5e-4)])
def test_a_blow_is_that_of_a_stiff_rod(sensors, stop, same):
    """With restitution, the stiff rod is struck by the impulse of a step, which knows the instant to a step of 0.1 ms."""
    still = sensors(crank("quasi-static", SOFT, stop))
    stiff = sensors(crank("elastic", "7e10 GPa", stop))
    assert still["d.value"].min() == pytest.approx(-0.05, abs=2e-4)
    assert still["a.value"] == pytest.approx(stiff["a.value"], abs=same)
    assert still["lost"][-1] == pytest.approx(stiff["lost"][-1], rel=1e-4)
    assert still["lost"][-1] > 0.4
    # The work of its deformation is not part of the balance.
    assert numpy.abs(still["balance"]).max() < 2e-5 * numpy.abs(still["total"]).max()


MOTOR = "  m: {hinge-motor: {joint: a, speed: 20 rad/s, torque-limit: 30 N m}}\n"


@pytest.mark.parametrize("modulus, stop", [(SOFT, ""), (SOFT, ", restitution: 0.5"), ("2 GPa", ""), ("2 GPa", ", restitution: 0.5"), (STIFF, "")])
def test_a_motor_stalls_at_the_stop(sensors, modulus, stop):
    """The blow tears the motor from its speed; it then presses the slider against the stop with its limit, as statics say."""
    out = sensors(crank("quasi-static", modulus, stop, MOTOR, "0.1 s"))
    stiff = sensors(crank("quasi-static", STIFF, "", MOTOR, "0.1 s"))
    assert out["d.value"][-1] == pytest.approx(-0.05, abs=1e-9)
    # The softest rod is shortened by 1.5 mm/(2 GPa/70 GPa), which turns the crank and changes its lever.
    same = {"2 GPa": 5e-3}.get(modulus, 2e-4)
    assert out["stop"][-1] == pytest.approx(stiff["stop"][-1], rel=same)
    assert out["a.value"][-1] == pytest.approx(stiff["a.value"][-1], rel=2 * same)
    assert out["lost"][-1] == pytest.approx(1.0, rel=0.06)


def test_the_balance_of_a_stalling_motor_closes_with_the_step(sensors):
    """The motor pulls with its limit from the end of the step of the blow on: an error of first order."""
    opened = []
    for step in ("0.1 ms", "0.025 ms"):
        out = sensors(crank("quasi-static", STIFF, "", MOTOR, "0.03 s").replace("step: 0.1 ms", f"step: {step}"))
        opened.append(numpy.abs(out["balance"]).max())
    assert opened[0] < 0.011 and opened[1] < 0.35 * opened[0]  # of 1 J


DRIVE = "  push: {prescribed-rotation: {between: [ground, crank/origin], angle: \"0.5 + 20*t rad\"}}\n"


@pytest.mark.parametrize("stop", ["", ", restitution: 0.5"])
def test_a_drive_that_nothing_stops_is_named(buckens, tmp_path, stop):
    """A crank driven by a law and a rigid stop hold a rod that does not yield to a blow."""
    text = crank("quasi-static", SOFT, stop).replace("  b: {revolute", DRIVE + "  b: {revolute")
    text = text.replace("initial: {joints: {a: {angle: 30 deg, speed: 20 rad/s}}}\n", "")
    (tmp_path / "model.yaml").write_text(text)
    buckens("run", "model.yaml", "-o", "out").must(4, "load \"stop\" at t = 0.0", "joints and drives hold", "quasi-static body \"rod\" does not yield",
                                                   "`stiffness`", "`flexibility: elastic`")


def test_a_load_beyond_what_a_soft_rod_takes_is_named(buckens, tmp_path):
    """300 N m press with 3 kN, where the rod of 2 GPa buckles under 183 N: its deformation is that of no equilibrium."""
    (tmp_path / "model.yaml").write_text(crank("quasi-static", "2 GPa", "", MOTOR.replace("30 N m", "300 N m"), "0.1 s"))
    result = buckens("run", "model.yaml", "-o", "out").must(4, "t = 0.0", "quasi-static", "`flexibility: elastic`")
    assert "initial" not in result.err
