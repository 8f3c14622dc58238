#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws how the cost of a step grows, from the figures of docs/developers/benchmarks.json.

    python3 bench/draw_costs.py docs/pictures

Writes cost_variables.svg, cost_frames.svg and cost_sharing.svg for docs/developers/cost.md. `run.py` is what measures.
"""

import argparse
import json
import pathlib

import matplotlib

matplotlib.use("svg")
import numpy  # noqa: E402
from matplotlib import pyplot  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
RESULTS = ROOT / "docs" / "developers" / "benchmarks.json"


def rows(results, section):
    """Rows of all sections `section` and `section:…`."""
    return [row for name, one in results.items() if name.split(":")[0] == section for row in one["rows"]]


def steps_of(results, level, threads, slender):
    """Variables and seconds of steps of hex8 blocks, by variables."""
    out = []
    for row in rows(results, "steps"):
        if row["element"] != "hex8" or row["slender"] != slender or "steps" not in row:
            continue
        for one in row["steps"]["levels"]:
            if one["level"] == level and one["threads"] == threads:
                out.append((row["steps"]["dof"], one["step"]))
    return sorted(out)


def draw_variables(results, file):
    figure, axis = pyplot.subplots(figsize=(6.4, 4.2), constrained_layout=True)
    for slender, power, marker in ((False, 4 / 3, "o"), (True, 1, "s")):
        shape = "slender" if slender else "cubes"
        for level, colour in (("none", "tab:blue"), ("full", "tab:orange")):
            points = steps_of(results, level, 1, slender)
            if not points:
                continue
            n, seconds = numpy.array(points).T
            axis.loglog(n, seconds, marker + "-", color=colour, markerfacecolor="none" if slender else colour,
                        label=f"{shape}, coupling `{level}`")
            if level == "full":
                far = numpy.logspace(numpy.log10(n[-1]), 7, 20)
                axis.loglog(far, seconds[-1] * (far / n[-1]) ** power, "--", color=colour, linewidth=0.8,
                            label=f"{shape}, predicted as n^{'4/3' if power > 1 else '1'}")
    axis.set_xlabel("nodal variables n")
    axis.set_ylabel("time per step [s]")
    axis.grid(True, linewidth=0.3)
    axis.legend(fontsize=8)
    figure.savefig(file, metadata={"Date": None})


def named(results, section, prefix):
    points = [(int(row["name"].split("/")[-1]), row["seconds"]) for row in rows(results, section)
              if row["name"].startswith(prefix + "/")]
    return numpy.array(sorted(points)).T


def draw_frames(results, file):
    figure, axis = pyplot.subplots(figsize=(6.4, 4.2), constrained_layout=True)
    for section, prefix, label in (("frames", "planar_beam_step", "beam in the plane, over frames"),
                                   ("frames", "divided_beam_step", "beam in space, over frames"),
                                   ("chains", "rigid_chain_step", "rigid chain in space, over links")):
        n, seconds = named(results, section, prefix)
        axis.loglog(n, seconds / n * 1e6, "o-", label=label)
    axis.set_xlabel("frames or links")
    axis.set_ylabel("time per step and frame or link [µs]")
    axis.grid(True, which="both", linewidth=0.3)
    axis.legend(fontsize=8)
    figure.savefig(file, metadata={"Date": None})


def draw_sharing(results, file):
    figure, (threads, sides) = pyplot.subplots(1, 2, figsize=(9, 3.8), constrained_layout=True)
    for level, colour in (("none", "tab:blue"), ("full", "tab:orange")):
        for slender in (False, True):
            alone = dict(steps_of(results, level, 1, slender))
            both = dict(steps_of(results, level, 2, slender))
            n = [k for k in alone if k in both]
            if n:
                threads.semilogx(n, [both[k] / alone[k] for k in n], "s" if slender else "o-", color=colour,
                                 markerfacecolor="none" if slender else colour,
                                 label=f"{'slender' if slender else 'cubes'}, `{level}`")
    threads.axhline(0.5, color="grey", linewidth=0.8)
    threads.set_ylim(bottom=0)
    threads.set_xlabel("nodal variables")
    threads.set_ylabel("step on two threads ÷ step on one")
    threads.legend(fontsize=8)
    for row in rows(results, "solves"):
        one = row["panels"]["1"]
        if row["element"] == "hex8" and "32" in one:
            sides.plot([1, 6, 32], [one[k] / one["1"] for k in ("1", "6", "32")], "o-",
                       label=f"{row['dof']:,}".replace(",", " "))
    sides.plot([1, 32], [1, 32], color="grey", linewidth=0.8)
    sides.set_xscale("log")
    sides.set_yscale("log")
    sides.set_xlabel("right-hand sides solved together")
    sides.set_ylabel("time ÷ that of one")
    sides.legend(title="nodal variables", fontsize=8)
    for axis in (threads, sides):
        axis.grid(True, linewidth=0.3)
    figure.savefig(file, metadata={"Date": None})


def main():
    matplotlib.rcParams["svg.hashsalt"] = "buckens"  # the same figures make the same file
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=pathlib.Path, help="folder of the pictures")
    out = parser.parse_args().out
    results = json.loads(RESULTS.read_text())
    draw_variables(results, out / "cost_variables.svg")
    draw_frames(results, out / "cost_frames.svg")
    draw_sharing(results, out / "cost_sharing.svg")


if __name__ == "__main__":
    main()
