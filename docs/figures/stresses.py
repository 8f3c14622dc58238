#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Draws docs/figures/stresses.svg from stresses.csv: largest errors of recorded stresses relative to the largest stress, as
tests/test_stresses.py computes them from runs of the models in verification/stresses.

    python3 docs/figures/stresses.py

Needs python3-matplotlib.
"""
import csv
import pathlib

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams.update({"svg.hashsalt": "buckens", "svg.fonttype": "none", "font.size": 9,
                            "axes.grid": True, "grid.alpha": 0.3, "lines.linewidth": 1.1})
import matplotlib.pyplot as plt  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
STYLES = {"hex8": ("o", "C0"), "hex20": ("s", "C1"), "tet10": ("^", "C2")}

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
