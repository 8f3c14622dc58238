# SPDX-License-Identifier: Apache-2.0
"""Flexible bars that fall on the floor and stay there, with friction at their ends."""

import pytest

BAR = """
buckens: 1
planar: zx
gravity: [0, 0, -9.81 m/s^2]
materials: {alu: {E: 70 GPa, nu: 0.3, rho: 2700 kg/m^3}}
sections: {s: {circle: {diameter: 20 mm}}}
bodies:
  bar:
    beam: {from: [0, 0, 0], to: [1 m, 0, 0], elements: 8, section: s, material: alu}
    at: {position: [0, 0, 0.35], orientation: {axis: [0, 1, 0], angle: 15.2 deg}}
loads:
  a: {contact: {between: [ground, bar/start], shapes: [{plane: [0, 0, 1]}, {sphere: 10 mm}], restitution: 0, static: 0.3}}
  b: {contact: {between: [ground, bar/end], shapes: [{plane: [0, 0, 1]}, {sphere: 10 mm}], restitution: 0, static: 0.3}}
initial: {bodies: {bar: {velocity: [-0.5, 0, -2.8], angular-velocity: [0, 2.1, 0]}}}
simulation: {duration: 0.2 s, step: STEP}
output: {every: 1 ms, sensors: {end: {position: bar/end}, moving: {energy: kinetic}, balance: {energy: balance}}}
"""


@pytest.mark.parametrize("step", ["1 ms", "0.5 ms", "0.2 ms"])
def test_a_bar_that_falls_is_not_thrown_up(sensors, step):
    out = sensors(BAR.replace("STEP", step))
    start = out["moving"][0]
    assert 3 < start < 4
    # It fell by 0.1 m, 0.8 J. What the method does on stops that let go is not explained (theory
    # 23 §4), 1.3 times the energy at 1 ms; the vibration of an end, taken for its acceleration over
    # a whole step, threw it up with 10 000 times of it.
    assert out["moving"].max() < 2.5 * start
    assert abs(out["balance"]).max() < 2 * start
    assert out["end.z"].max() < 0.5


SOFT_BAR = """
buckens: 1
gravity: [0, 0, -9.81 m/s^2]
materials: {soft: {E: 2 GPa, nu: 0.3, rho: 2700 kg/m^3}}
sections: {s: {circle: {diameter: 20 mm}}}
bodies:
  bar:
    beam: {from: [0, 0, 0], to: [1 m, 0, 0], elements: 8, section: s, material: soft}
    at: {position: [0, 0, 0.3], orientation: {axis: [0, 1, 0], angle: 10 deg}}
loads:
  a: {contact: {between: [ground, bar/start], shapes: [{plane: [0, 0, 1]}, {sphere: 10 mm}], restitution: 0.3}}
  b: {contact: {between: [ground, bar/end], shapes: [{plane: [0, 0, 1]}, {sphere: 10 mm}], restitution: 0.3}}
initial: {bodies: {bar: {velocity: [0, 0, -3], angular-velocity: [0, 1, 0]}}}
simulation: {duration: 0.2 s, step: STEP, rho-inf: 1}
output: {every: 1 ms, sensors: {lost: {energy: dissipated}, balance: {energy: balance}}}
"""


def test_what_blows_on_a_soft_bar_take_hardly_depends_on_the_step(sensors):
    """An end that the bar pulls back within a step rests: struck again and again, it lost twice as much at 1 ms."""
    lost = {}
    for step in ("1 ms", "0.2 ms", "0.05 ms"):
        out = sensors(SOFT_BAR.replace("STEP", step))
        lost[step] = out["lost"][-1]
        # Taken out of the floor against weight: measured 0.9 % at 1 ms.
        assert abs(out["balance"]).max() < 0.02 * lost[step]
    # Measured: 2.60, 2.45 and 2.51 J; vibrations decide what is left over at each step.
    assert lost["1 ms"] == pytest.approx(lost["0.05 ms"], rel=0.1)
    assert lost["0.2 ms"] == pytest.approx(lost["0.05 ms"], rel=0.1)


ARM = """
buckens: 1
gravity: [0, 0, -9.81 m/s^2]
materials: {soft: {E: 2 GPa, nu: 0.3, rho: 2700 kg/m^3}}
sections: {s: {circle: {diameter: 20 mm}}}
bodies: {bar: {beam: {from: [0, 0, 0], to: [1 m, 0, 0], elements: 8, section: s, material: soft}}}
joints: {h: {revolute: {between: [ground, bar/start], axis: [0, 1, 0]}}}
loads: {a: {hinge-stop: {joint: h, from: -10 deg, to: 9 deg, restitution: 0.001}}}
initial: {bodies: {bar: {velocity: [0, 0, -0.57], angular-velocity: [0, -1.14, 0]}}}
simulation: {duration: 0.2 s, step: 0.2 ms, rho-inf: 1}
output: {every: 1 ms, sensors: {balance: {energy: balance}, moving: {energy: kinetic}}}
"""


def test_an_arm_that_bends_over_its_stop_is_not_lifted(sensors):
    """Its root, pulled into the stop within every other step, was taken out of it with the whole arm: 1 J from nowhere."""
    out = sensors(ARM)
    assert out["moving"].max() > 0.5
    # Measured: 0.7 %.
    assert abs(out["balance"]).max() < 0.02 * out["moving"].max()
