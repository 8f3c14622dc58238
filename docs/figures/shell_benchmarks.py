#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Draws docs/figures/shell_benchmarks.svg from what the unit tests of shells measure.

    python3 docs/figures/shell_benchmarks.py [--tests build/release/test/fem_test]

Needs python3-matplotlib; takes a few seconds. Prints the table of docs/theory/15-shells.md.
"""
import argparse
import pathlib
import re
import subprocess

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams.update({"svg.hashsalt": "buckens", "svg.fonttype": "none", "font.size": 9,
                            "axes.grid": True, "grid.alpha": 0.3, "lines.linewidth": 1.1})
import matplotlib.pyplot as plt  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
LINE = re.compile(r"^shell (\w+) n=(\d+)((?: [\w-]+=[-\d.e+]+)+)$", re.MULTILINE)


def measure(tests):
    """{element: {problem: [(n, ratio), ...]}}"""
    output = subprocess.run([tests, "--gtest_filter=*ShellProblems*"], check=True, text=True,
                            capture_output=True).stdout
    out = {}
    for element, n, values in LINE.findall(output):
        for entry in values.split():
            name, value = entry.split("=")
            out.setdefault(element, {}).setdefault(name, []).append((int(n), float(value)))
    return out


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--tests", default="build/release/test/fem_test")
    found = measure(parser.parse_args().tests)
    figure, panels = plt.subplots(1, 4, figsize=(12, 3), sharey=True)
    for panel, (element, problems) in zip(panels, found.items()):
        for name, points in problems.items():
            panel.plot(*zip(*points), "o-", markersize=3, label=name)
        panel.set_xscale("log", base=2)
        panel.set_title(element)
        panel.set_xlabel("elements per side")
        panel.axhline(1.0, color="black", linewidth=0.6)
    panels[0].set_ylabel("over the reference")
    panels[1].legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(HERE / "shell_benchmarks.svg", metadata={"Date": None})
    for element, problems in found.items():
        counts = [n for n, _ in next(iter(problems.values()))]
        print(f"\n| {element} | " + " | ".join(f"n = {n}" for n in counts) + " |")
        print("|---" * (len(counts) + 1) + "|")
        for name, points in problems.items():
            values = dict(points)
            print(f"| {name} | " + " | ".join(f"{values[n]:.4f}" if n in values else ""
                                              for n in counts) + " |")


if __name__ == "__main__":
    main()
