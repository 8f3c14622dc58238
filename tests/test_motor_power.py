# SPDX-License-Identifier: Apache-2.0
"""Motors with a limit of power that have far more torque at rest than it lasts for."""

import pytest

J, P = 0.05, 50.0
WHEEL = """
buckens: 1
bodies: {wheel: {rigid: {mass: 2 kg, inertia: [0.1, 0.1, 0.05]}}}
joints: {shaft: {revolute: {between: [ground, wheel], axis: [0, 0, 1]}}}
loads: {motor: {hinge-motor: {joint: shaft, MOTOR, torque-limit: LIMIT, power-limit: 50 W}}}
initial: {joints: {shaft: {speed: START rad/s}}}
simulation: {METHODduration: 0.1 s, step: STEP}
output: {every: 0.1 s, sensors: {energy: {energy: kinetic}}}
"""
STEPS = (("1 ms", 1e-3), ("0.5 ms", 5e-4), ("0.25 ms", 2.5e-4))
GAINS, EXACT = "speed: 1000, damping: 100", "speed: 1000"


def surplus(sensors, motor, method, start, limit, step, time=0.1):
    """Energy beyond what 50 W give in a time, or less than that."""
    text = WHEEL.replace("MOTOR", motor).replace("METHOD", method).replace("START", str(start)).replace("STEP", step)
    # At its limit b the torque brakes for J |w|/b, then accelerates for J P/b²; half of the power is used in that time.
    exact = P * (time - J * abs(start) / limit - 0.5 * J * P / limit**2)
    return sensors(text.replace("LIMIT", str(limit)))["energy"][-1] - exact


# 0.05 P h more are let pass in any one step. Steps after the start follow the root of the time, with 0.09 P h; numerical damping
# adds as much, and accelerations that are linear in time, as in Wilson's method, 0.4 P h.
@pytest.mark.parametrize("motor, method, start, share", [
    (GAINS, "", 0, 0.3), (GAINS, "method: hht, ", 0, 0.3), (GAINS, "method: newmark, ", 0, 0.3), (GAINS, "method: wilson, ", 0, 0.7),
    (GAINS, "rho-inf: 0.5, ", 0, 0.3), (EXACT, "", 0, 0.3), (EXACT, "method: hht, ", 0, 0.3), (GAINS, "", -20, 0.3), (EXACT, "", -20, 0.3),
])
@pytest.mark.parametrize("limit", [50, 500, 5000])
def test_a_motor_from_rest_gives_no_more_than_its_power(sensors, motor, method, start, share, limit):
    """Nor where it turns round: J w²/2 = P t, off by a share of what a step gives."""
    for step, h in STEPS:
        assert abs(surplus(sensors, motor, method, start, limit, step)) < share * P * h, step


@pytest.mark.parametrize("method", ["", "method: newmark, "])
@pytest.mark.parametrize("motor", ["torque: \"1e6*(t > 0.02)\"", "speed: \"1000*(t > 0.02)\", damping: 100"])
def test_a_motor_that_is_switched_on_gives_no_more_than_its_power(sensors, motor, method):
    """Within a step, whose force at the end does not converge with the tangent at rest."""
    for step, h in STEPS:
        # The step in which it starts counts half, by the trapezoidal rule; less than that by Newmark's.
        assert abs(surplus(sensors, motor, method, 0, 5000, step, 0.08)) < 0.8 * P * h, step


@pytest.mark.parametrize("motor", [GAINS, EXACT])
def test_a_motor_on_a_flexible_rod_gives_no_more_than_its_power(sensors, motor):
    """The node that it turns has hardly any inertia of its own."""
    for step, h in STEPS[:2]:
        out = sensors(f"""
buckens: 1
planar: xy
materials: {{steel: {{E: 200 GPa, nu: 0.3, rho: 7870 kg/m^3, damping: {{stiffness: 1e-5 s}}}}}}
bodies: {{rod: {{beam: {{to: [1, 0, 0], elements: 8, section: {{circle: {{diameter: 20 mm}}}}, material: steel}}}}}}
joints: {{shaft: {{revolute: {{between: [ground, rod/start]}}}}}}
loads: {{motor: {{hinge-motor: {{joint: shaft, {motor}, torque-limit: 5000, power-limit: 50 W}}}}}}
simulation: {{duration: 0.2 s, step: {step}}}
output:
  every: 0.2 s
  sensors: {{kinetic: {{energy: kinetic}}, elastic: {{energy: potential}}, lost: {{energy: dissipated}}, work: {{energy: work}}}}
""")
        assert abs(out["kinetic"][-1] + out["elastic"][-1] + out["lost"][-1] - 0.2 * P) < 0.3 * P * h
        assert out["work"][-1] == pytest.approx(0.2 * P, abs=1e-4)
