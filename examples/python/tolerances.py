# SPDX-License-Identifier: Apache-2.0
"""Which tolerance of the slider-crank matters: bending of its rod over speed, thickness and stiffness, and the best thickness.

usage: python3 examples/python/tolerances.py [OUT [VARIANTS [PROCESSES]]]   default: build/tolerances, 64 and 2

The samples are a design for Sobol indices: VARIANTS (a power of two) times five runs, which two processes share. Then
differential evolution finds the thickness with the least mass times bending; each generation is one sweep.
"""

import pathlib
import sys

import numpy as np

import buckens
from buckens import study

MODEL = pathlib.Path(__file__).parents[1] / "slider_crank" / "slider_crank.yaml"
DIAMETER = "bodies.rod.beam.section.circle.diameter"
SHORT = {"simulation.duration": "12 ms"}  # a quarter of a turn
QUANTITIES = {
    "parameters.speed": "145 to 155 rad/s",                           # as the drive holds it
    DIAMETER: "6 mm +- 0.03 mm",                                       # as drawn
    "materials.steel.E": study.triangular("195 GPa", "200 GPa", "210 GPa"),  # as data sheets have it
}


def bending(sweep):
    """Largest deflection of the rod's middle in each variant [m]."""
    return np.maximum(np.abs(study.results(sweep, "mid.y max")), np.abs(study.results(sweep, "mid.y min")))


def what_matters(out, count, processes):
    design = study.sensitivity(QUANTITIES, count)
    sweep = buckens.sweep(MODEL, design, out / "samples", set=SHORT, executor=processes)
    values = bending(sweep)
    told = study.statistics(values)
    print(f"{len(design)} variants: bending {1e3 * told.mean:.3f} mm +- {1e3 * told.deviation:.3f} mm, "
          f"95 % below {1e3 * told.quantiles[0.95]:.3f} mm")
    indices = study.sobol_indices(design, values)
    for path in design.columns:
        print(f"{path.rpartition('.')[2]:9} {100 * indices.first[path]:5.1f} % alone, {100 * indices.total[path]:5.1f} % with others "
              f"(+- {100 * indices.total_error[path]:.1f})")
    try:
        study.picture(design, 1e3 * values, "largest bending [mm]", file=out / "tolerances.png")
    except ImportError:
        print("no picture: matplotlib is not installed")


def best_thickness(out, processes):
    def price(sweep):
        thickness = 1e3 * study.results(sweep, DIAMETER)  # without a unit: metres
        return thickness**2 + 1e4 * bending(sweep)

    found = study.minimize(MODEL, {DIAMETER: "0.004 to 0.012"}, price, out / "best", executor=processes, population=6,
                           generations=4, set=SHORT)
    print(f"least price {found.result:.2f} with {1e3 * found.values[DIAMETER]:.2f} mm, after {found.num_variants} variants")


def main():
    out = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "build/tolerances")
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 64
    processes = int(sys.argv[3]) if len(sys.argv) > 3 else 2
    what_matters(out, count, processes)
    best_thickness(out, processes)


if __name__ == "__main__":
    main()
