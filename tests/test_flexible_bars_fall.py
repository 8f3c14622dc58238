# SPDX-License-Identifier: Apache-2.0
"""Flexible bars that fall on the floor and stay there, with friction at their ends."""

import pytest



def bar(kind, modulus, height, angle, numbers, velocity, spin, step):
    """A bar of 1 m above the floor, which it may touch with both of its ends."""
    ends = ", ".join(
        f"{end}: {{contact: {{between: [ground, bar/{end}], shapes: [{{plane: [0, 0, 1]}}, {{sphere: 10 mm}}], {numbers}}}}}"
        for end in ("start", "end")
    )
    return f"""
buckens: 1
{kind}
gravity: [0, 0, -9.81 m/s^2]
materials: {{m: {{E: {modulus}, nu: 0.3, rho: 2700 kg/m^3}}}}
sections: {{s: {{circle: {{diameter: 20 mm}}}}}}
bodies:
  bar:
    beam: {{from: [0, 0, 0], to: [1 m, 0, 0], elements: 8, section: s, material: m}}
    at: {{position: [0, 0, {height}], orientation: {{axis: [0, 1, 0], angle: {angle} deg}}}}
loads: {{{ends}}}
initial: {{bodies: {{bar: {{velocity: {velocity}, angular-velocity: [0, {spin}, 0]}}}}}}
simulation: {{duration: 0.2 s, step: {step}}}
output: {{every: 1 ms, sensors: {{end: {{position: bar/end}}, moving: {{energy: kinetic}}, lost: {{energy: dissipated}}, balance: {{energy: balance}}}}}}
"""


@pytest.mark.parametrize("step", ["1 ms", "0.5 ms", "0.2 ms"])
def test_a_bar_that_falls_is_not_thrown_up(sensors, step):
    out = sensors(bar("planar: zx", "70 GPa", 0.35, 15.2, "restitution: 0, static: 0.3", [-0.5, 0, -2.8], 2.1, step))
    start = out["moving"][0]
    assert 3 < start < 4
    # It fell by 0.1 m, 0.8 J. What the method does on stops that let go is not explained (theory
    # 23 §4), 1.3 times the energy at 1 ms; the vibration of an end, taken for its acceleration over
    # a whole step, threw it up with 10 000 times of it.
    assert out["moving"].max() < 2.5 * start
    assert abs(out["balance"]).max() < 2 * start
    assert out["end.z"].max() < 0.5


def test_what_blows_on_a_soft_bar_take_hardly_depends_on_the_step(sensors):
    """An end that the bar pulls back within a step rests: struck again and again, it lost twice as much at 1 ms."""
    lost = {}
    for step in ("1 ms", "0.2 ms", "0.05 ms"):
        out = sensors(bar("", "2 GPa", 0.3, 10, "restitution: 0.3", [0, 0, -3], 1, f"{step}, rho-inf: 1"))
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
