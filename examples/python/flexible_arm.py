# SPDX-License-Identifier: Apache-2.0
"""A flexible arm is turned by 90 degrees by a controller written in Python.

usage: python3 examples/python/flexible_arm.py [OUT]   OUT: run directory, default build/flexible_arm

The motor gets the torque that a rigid arm would need for a smooth motion, and a feedback of the angle of
its shaft. The tip keeps swinging about the angle that is reached; the feedback damps it. The controller is
evaluated within the steps: it has no delay.
"""

import math
import sys

import buckens

LENGTH, DIAMETER, THICKNESS = 1.0, 0.01, 0.001  # of the tube [m]
ROTOR = 5e-3  # inertia of the motor [kg m^2]
E, RHO = 70e9, 2700.0  # aluminium [Pa, kg/m^3]
ANGLE, DURATION = math.pi / 2, 0.5  # of the motion [rad, s]

aluminium = buckens.Material(E=E, nu=0.33, rho=RHO)
arm = buckens.Beam(to=[LENGTH, 0, 0], elements=8, material="aluminium",
                   section=buckens.TubeSection(outer_diameter=DIAMETER, thickness=THICKNESS))
model = buckens.Model(
    title="Flexible arm, controlled from Python", planar="xy", materials={"aluminium": aluminium},
    bodies={"rotor": buckens.Rigid(mass=0.5, inertia=[0, 0, ROTOR]), "arm": arm},
    joints={"shaft": buckens.Revolute(between=["ground", "rotor"]),
            "flange": buckens.Fixed(between=["rotor", "arm/start"])},
    signals={"angle": {"joint-angle": "shaft"}, "speed": {"joint-speed": "shaft"}, "torque": {"setting": 0}},
    loads={"motor": buckens.HingeMotor(joint="shaft", torque="torque")},
    simulation={"duration": 1.5, "step": 2e-4},
    output={"every": 2e-3, "sensors": {
        "angle": buckens.JointCoordinateSensor(joint="shaft"),
        "tip": buckens.DeflectionSensor(of="arm/end", from_="frame"),
        "torque": buckens.SpringTorqueSensor(spring="motor")}})  # as it opposes the angle

inertia = ROTOR + buckens.check(model)["bodies"]["arm"]["mass"] * LENGTH**2 / 3  # about the shaft [kg m^2]
STIFFNESS, DAMPING = inertia * 15**2, 2 * 0.7 * inertia * 15  # of the feedback [N m/rad, N m s/rad]


def way(t):
    """Angle, rate and acceleration at t: from 0 to ANGLE, smoothly."""
    s = min(t / DURATION, 1.0)
    return (ANGLE * s**3 * (10 - 15 * s + 6 * s * s),
            ANGLE / DURATION * 30 * s * s * (1 - s)**2,
            ANGLE / DURATION**2 * 60 * s * (1 - s) * (1 - 2 * s))


@model.signal()
def torque(t, angle, speed):
    """The signal `torque` at any instant, from the signals that its parameters name."""
    wanted = way(t)
    return inertia * wanted[2] + STIFFNESS * (wanted[0] - angle) + DAMPING * (wanted[1] - speed)


sim = buckens.Simulation(model, out=sys.argv[1] if len(sys.argv) > 1 else "build/flexible_arm")
summary = sim.run(progress=sys.stderr.isatty())

run = buckens.open(sim.directory)
tip, time = run["tip.y"], run.time
largest = float(abs(tip).max())
print(f"angle reached   {math.degrees(sim.sensors['angle.value']):.3f} degrees of {math.degrees(ANGLE):.3f}")
print(f"largest bending of the tip  {1e3 * largest:.2f} mm")
print(f"left at the end {1e3 * float(abs(tip[time > 1.4]).max()):.3f} mm")
print(f"results in {sim.directory}; look at them with: buckens view {sim.directory}")
try:
    run.plot("tip.y").figure.savefig(f"{sim.directory}/tip.png")
except ImportError:
    print("no picture: matplotlib is not installed")
