#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Draws docs/figures/stresses.svg from stresses.csv: largest errors of recorded stresses relative to the largest stress, as
tests/test_stresses.py computes them from runs of the models in verification/stresses.

    python3 docs/figures/stresses.py [--measure [--program build/release/bin/buckens]]

With --measure all runs are made first and stresses.csv is written (half a minute). Needs python3-matplotlib.
"""
import argparse
import csv
import pathlib
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams.update({"svg.hashsalt": "buckens", "svg.fonttype": "none", "font.size": 9,
                            "axes.grid": True, "grid.alpha": 0.3, "lines.linewidth": 1.1})
import matplotlib.pyplot as plt  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tests" / "support"))

import stress_errors  # noqa: E402

CASES = {"Bar in free flight": "spinning_bar", "Rotating disc": "disc", "Cantilever under gravity": "cantilever"}
MESHES = [  # case, element, elements along, divisions
    *[("Bar in free flight", element, n, f"[{n},{n // 4},{n // 4}]") for element in ("hex8", "hex20") for n in (4, 8)],
    *[("Bar in free flight", "tet10", n, f"[{n},{n // 4},{n // 4}]") for n in (4, 8, 12)],
    *[("Rotating disc", element, n, f"[{n},{16 * n // 3},1]") for element, last in (("hex8", 24), ("hex20", 12))
      for n in (3, 6, 12, 24) if n <= last],
    *[("Cantilever under gravity", element, n, f"[{n},{n // 5},1]") for element in ("hex8", "hex20") for n in (10, 20, 40)],
]
STYLES = {"hex8": ("o", "C0"), "hex20": ("s", "C1"), "tet10": ("^", "C2")}



def measure(program):
    """Runs all meshes and writes stresses.csv."""
    lines = ["case,element,elements_along,nodes,centres"]
    for case, element, along, divisions in MESHES:
        with tempfile.TemporaryDirectory() as directory:
            out = pathlib.Path(directory) / "out"
            subprocess.run([program, *stress_errors.arguments(CASES[case], divisions, element, out)], check=True,
                           stderr=subprocess.DEVNULL)
            nodes, centres = stress_errors.errors(CASES[case], out)
        lines.append(f"{case},{element},{along},{nodes:.3e},{centres:.3e}")
        print(lines[-1], flush=True)
    (HERE / "stresses.csv").write_text("\n".join(lines) + "\n")


def draw():
    rows = list(csv.DictReader((HERE / "stresses.csv").open()))
    cases = list(dict.fromkeys(row["case"] for row in rows))
    figure, axes = plt.subplots(1, len(cases), figsize=(9, 3.1), sharey=True)
    for plot, case in zip(axes, cases):
        for element, (marker, colour) in STYLES.items():
            for place, line in (("nodes", "-"), ("centres", ":")):
                points = [(1 / float(row["elements_along"]), float(row[place])) for row in rows
                          if row["case"] == case and row["element"] == element and row[place]]
                if points:
                    plot.loglog(*zip(*points), line, marker=marker, color=colour, label=f"{element}, {place}",
                                markerfacecolor=colour if place == "nodes" else "none")
        plot.set_title(case)
        plot.set_xlabel("1 / elements along")
        plot.legend(fontsize=6.5)
    axes[0].set_ylabel("largest error / largest stress")
    figure.tight_layout()
    figure.savefig(HERE / "stresses.svg", metadata={"Date": None})


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--measure", action="store_true")
    parser.add_argument("--program", default="build/release/bin/buckens")
    options = parser.parse_args()
    if options.measure:
        measure(options.program)
    draw()
