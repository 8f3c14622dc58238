# SPDX-License-Identifier: Apache-2.0
"""The taper of a swinging rod that bends least for its mass, found with scipy.optimize.

usage: python3 examples/python/rod_taper.py [PICTURE]

A steel rod with a gripper at its end is turned by 90 degrees. Thicker at the shaft and thinner at the gripper it bends less,
until the thin end bends more. The function to be minimised is a simulation: the largest bending of the tip.
"""

import sys

import numpy as np
from scipy.optimize import minimize_scalar

import buckens

LENGTH, DIAMETER = 0.4, 0.01  # of the rod, uniform [m]
GRIPPER = 0.1  # mass [kg]
E, RHO = 200e9, 7850.0  # steel [Pa, kg/m^3]
DURATION = 0.4  # of the motion [s]


def ends(ratio):
    """Diameters at shaft and gripper with a given ratio, for the mass of the uniform rod."""
    first = DIAMETER * np.sqrt(3 / (1 + ratio + ratio**2))
    return first, ratio * first


def model(ratio):
    """A rod whose ends have a ratio of diameters."""
    first, last = ends(ratio)
    s = f"(t/{DURATION})"
    return buckens.Model(
        title="Swinging rod with a gripper", planar="xy",
        materials={"steel": buckens.Material(E=E, nu=0.3, rho=RHO)},
        bodies={"rod": buckens.Beam(to=[LENGTH, 0, 0], elements=8, material="steel",
                                    section=buckens.CircleSection(diameter=first),
                                    end_section=buckens.CircleSection(diameter=last)),
                "gripper": buckens.Rigid(mass=GRIPPER, inertia=[0, 0, 1e-6], at={"position": [LENGTH, 0, 0]})},
        joints={"shaft": buckens.Revolute(between=["ground", "rod/start"]),
                "motor": buckens.PrescribedRotation(between=["ground", "rod/start"],
                                                    angle=f"pi/2*{s}^3*(10 - 15*{s} + 6*{s}^2) rad"),
                "grip": buckens.Fixed(between=["rod/end", "gripper"])},
        simulation={"duration": DURATION, "step": 2.5e-4},
        output={"sensors": {"tip": buckens.DeflectionSensor(of="rod/end", from_="rod/start")}})


def largest_bending(ratio):
    """Of the tip, from the straight line that the rod would be [m]."""
    sim = buckens.Simulation(model(ratio))
    sim.run()
    return float(np.abs(sim.curves["tip.y"]).max())


def main():
    ratios = np.linspace(0.3, 1.1, 9)
    table = [largest_bending(ratio) for ratio in ratios]
    found = minimize_scalar(largest_bending, bounds=(0.2, 1.0), method="bounded", options={"xatol": 1e-3})
    uniform = largest_bending(1.0)
    first, last = ends(found.x)
    print(f"uniform rod  {1e3 * DIAMETER:.2f} mm: bends by {1e3 * uniform:.3f} mm")
    print(f"best taper   {1e3 * first:.2f} mm to {1e3 * last:.2f} mm, ratio {found.x:.3f}: bends by {1e3 * found.fun:.3f} mm")
    print(f"{100 * (1 - found.fun / uniform):.0f} % less for the same mass, after {found.nfev} simulations")
    if len(sys.argv) > 1:
        import matplotlib.pyplot as plt

        axes = plt.subplots()[1]
        axes.plot(ratios, 1e3 * np.array(table), "o-", label="table")
        axes.plot(found.x, 1e3 * found.fun, "*", markersize=14, label="minimum found")
        axes.set_xlabel("diameter at the gripper / diameter at the shaft")
        axes.set_ylabel("largest bending of the tip [mm]")
        axes.legend()
        axes.figure.savefig(sys.argv[1])


if __name__ == "__main__":
    main()
