# SPDX-License-Identifier: Apache-2.0
"""A study of the slider-crank: bending of the rod and force across the guide, over speed and thickness of the rod.

usage: python3 examples/python/parameter_study.py [OUT]   OUT: directory of the runs, default build/parameter_study

`buckens.sweep` runs all combinations and writes a table with the extremes of every sensor, which pandas reads.
"""

import pathlib
import sys

import pandas

import buckens

MODEL = pathlib.Path(__file__).parents[1] / "slider_crank" / "slider_crank.yaml"
SPEED, DIAMETER = "parameters.speed", "bodies.rod.beam.section.circle.diameter"
FACTORS = {SPEED: [100, 125, 150], DIAMETER: ["6 mm", "8 mm", "10 mm"]}


def study(out):
    """A row per variant: its values, and the extremes of its sensors."""
    sweep = buckens.sweep(MODEL, FACTORS, out, set={"simulation.duration": "0.07 s", "bodies.rod.frames": 4})
    table = pandas.read_csv(sweep["table"])
    largest = {name: table[[f"{name} min", f"{name} max"]].abs().max(axis=1) for name in ("mid.y [m]", "guide.y [N]")}
    table["speed [rad/s]"] = table[SPEED]
    table["diameter [mm]"] = table[DIAMETER].str.removesuffix(" mm").astype(int)
    table["bending [mm]"] = 1e3 * largest["mid.y [m]"]
    table["guide force [N]"] = largest["guide.y [N]"]
    return table


def main():
    out = sys.argv[1] if len(sys.argv) > 1 else "build/parameter_study"
    table = study(out)
    for result in ("bending [mm]", "guide force [N]"):
        print(f"largest {result}")
        print(table.pivot(index="speed [rad/s]", columns="diameter [mm]", values=result).round(3).to_string(), "\n")
    print(f"{len(table)} runs in {out}; {int((table['trust'] == 'ok').sum())} of them are to be trusted")


if __name__ == "__main__":
    main()
