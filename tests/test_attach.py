# SPDX-License-Identifier: Apache-2.0
"""Events that attach joints again, and joints that begin released."""

import numpy
import pytest

# A ball falls past a plate on a rail and is caught by it.
CATCH = """
buckens: 1
gravity: [0, 0, -10]
bodies:
  plate: {rigid: {mass: 3 kg, inertia: [0.1, 0.1, 0.1]}}
  ball: {rigid: {mass: 1 kg, inertia: [1e-2, 1e-2, 1e-2]}, at: {position: [0, 0, 1.25]}}
joints:
  rail: {prismatic: {between: [ground, plate], axis: [0, 0, 1]}}
  hand: {fixed: {between: [plate, {marker: ball}]}}
signals:
  above: {position: {of: ball, along: [0, 0, 1]}}
  under: {position: {of: plate, along: [0, 0, 1]}}
  met: "above - under"
  later: "t - 0.8"
events:
  catch: {when: met, direction: falling, attach: hand, TOLERANCE}
  drop: {when: later, release: hand}
loads: {lift: {force: {on: plate, value: [0, 0, 30 N]}}}
initial: {released: [hand]}
simulation: {duration: 1 s, step: 1 ms, METHOD}
output:
  every: 5 ms
  sensors: {ball: {position: ball}, plate: {position: plate}, v: {velocity: ball}, w: {velocity: plate}, hand: {joint-force: hand}, lost: {energy: dissipated}, balance: {energy: balance}}
""".replace("{marker: ball}", "ball")


@pytest.mark.parametrize("method", ["method: generalized-alpha", "method: newmark", "tolerance: 1e-5"])
def test_a_ball_is_caught_and_let_go(sensors, method):
    """It falls 1.25 m in 0.5 s; both go on with a quarter of its 5 m/s, at -10/4 m/s²."""
    out = sensors(CATCH.replace("METHOD", method).replace(", TOLERANCE", ", tolerance: 5 mm"))
    t = out["t"]
    held = (t > 0.502) & (t < 0.799)
    # Caught at most h/16 late.
    assert out["v.z"][held] == pytest.approx(-1.25 - 2.5 * (t[held] - 0.5), abs=2e-3)
    assert numpy.ptp((out["v.z"] - out["w.z"])[held]) < 1e-9
    # Closed by the first step to rounding, also if it was a little past.
    assert abs(out["ball.z"] - out["plate.z"])[held].max() < 1e-9
    assert out["hand.z"][held] == pytest.approx(10 - 2.5, abs=1e-6)
    # The impact takes the relative energy: 1/2 * 0.75 * 5².
    assert out["lost"][-1] == pytest.approx(0.5 * 0.75 * 25, abs=2e-2)
    free = t > 0.802
    assert numpy.polyfit(t[free], out["v.z"][free], 1)[0] == pytest.approx(-10, abs=1e-8)
    assert abs(out["hand.z"][free]).max() == 0
    # Moving bodies over the last fraction of a millimetre takes no energy into account.
    assert abs(out["balance"]).max() < 0.03


def test_it_must_have_met(buckens, tmp_path):
    text = CATCH.replace("METHOD", "method: newmark").replace(", TOLERANCE", ", tolerance: 1 mm").replace('"above - under"', '"above - under - 0.1"')
    (tmp_path / "model.yaml").write_text(text)
    buckens("run", "model.yaml", "-o", "out").must(4, "event \"catch\"", "joint \"hand\" cannot be attached", "m apart", "`tolerance`")


MASTS = """
buckens: 1
planar: xy
materials: {steel: {E: 2 GPa, nu: 0.3, rho: 7870 kg/m^3}}
bodies:
  rod: {beam: {to: [1 m, 0, 0], elements: 4, section: {circle: {diameter: 20 mm}}, material: steel}}
joints:
  root: {revolute: {between: [ground, rod/start]}}
  tip: {revolute: {between: [{ground: [1, 0, 0]}, rod/end]}}
signals: {now: "t - 0.1", again: "t - 0.2"}
events: {off: {when: now, release: tip}, on: {when: again, attach: tip, tolerance: 50 mm}}
gravity: [0, -0.5, 0]
simulation: {duration: 0.4 s, step: 0.5 ms, STEP}
output: {every: 2 ms, sensors: {tip: {position: rod/end}, force: {joint-force: tip}}}
"""


@pytest.mark.parametrize("step", ["method: generalized-alpha", "method: newmark"])
def test_a_flexible_body_is_attached_again(sensors, step):
    out = sensors(MASTS.replace("STEP", step))
    t = out["t"]
    free = (t > 0.102) & (t < 0.199)
    assert out["tip.y"][free].min() < -2e-3 and abs(out["force.y"][free]).max() == 0
    held = t > 0.202
    assert abs(out["tip.y"][held]).max() < 1e-9 and abs(out["tip.x"][held] - 1).max() < 1e-9
    assert abs(out["force.y"][held]).max() > 0.1


WRONG = {
    "attach: [hend]": ("unknown joint \"hend\"", "hand"),
    "attach: [gears]": ("joint \"gears\" is a gear", "cannot be attached"),
    "attach: [soft]": ("\"soft\" is a bushing", "switched on"),
    "attach: [hand], tolerance: -1 mm": ("tolerance",),
}


@pytest.mark.parametrize("action", WRONG)
def test_what_cannot_be_attached_is_named(buckens, tmp_path, action):
    more = """  gears: {gear: {between: [plate, ball], axis: [1, 0, 0], teeth: [20, 30]}}
  soft: {bushing: {between: [ground, ball], stiffness: [1, 1, 1]}}
signals:"""
    text = CATCH.replace("METHOD", "method: newmark").replace("signals:", more, 1).replace("attach: hand, TOLERANCE", action)
    (tmp_path / "model.yaml").write_text(text)
    buckens("check", "model.yaml").must(2, "model.yaml:", *WRONG[action])


def test_what_starts_released_must_exist(buckens, tmp_path):
    text = CATCH.replace("METHOD", "method: newmark").replace(", TOLERANCE", "")
    (tmp_path / "model.yaml").write_text(text.replace("released: [hand]", "released: [hnd]"))
    buckens("check", "model.yaml").must(2, "unknown joint \"hnd\"", "hand")
    (tmp_path / "model.yaml").write_text(text.replace("released: [hand]", "released: [hand], start: static"))
    buckens("check", "model.yaml").must(2, "the equilibrium counts all joints", "\"hand\"")
