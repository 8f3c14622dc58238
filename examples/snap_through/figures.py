#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Figures of this example from the program's own output.

    python3 examples/snap_through/figures.py [--program build/release/bin/buckens] [--out DIR]

Writes displacement_over_load.svg, coupling.svg and single_terms.svg beside this file. The parameters of
the paper's example are not known; those of snap_through.yaml are our own.
"""

import argparse
import csv
import pathlib
import subprocess
import tempfile

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as pyplot
import numpy

HERE = pathlib.Path(__file__).resolve().parent
CRITICAL = 592.1035201526166  # N, closed form for the parameters of the model file
# Without date and random names, so that a figure changes only with what it shows.
matplotlib.rcParams.update({"svg.hashsalt": "buckens", "svg.fonttype": "none", "font.size": 9,
                            "axes.grid": True, "grid.alpha": 0.3, "lines.linewidth": 1.2})


class Runs:
    """Results of the program, each computed once."""

    def __init__(self, program, model, scratch):
        self.program, self.model, self.scratch, self.known = program, model, scratch, {}

    def sensors(self, verb, settings):
        """Columns of sensors.csv by name without unit."""
        key = (verb, *settings)
        if key not in self.known:
            out = self.scratch / f"{len(self.known)}"
            options = [text for setting in settings for text in ("--set", setting)]
            subprocess.run([self.program, verb, self.model, "-o", out, "-q", *options], check=True)
            with open(out / "sensors.csv", newline="") as file:
                rows = list(csv.reader(file))
            columns = numpy.array(rows[1:], dtype=float).T
            self.known[key] = {name.split(" [")[0]: column
                               for name, column in zip(rows[0], columns)}
        return self.known[key]

    def path(self, settings=()):
        """w and load of the static path; factor one is 1000 N."""
        rows = self.sensors("static", list(settings))
        return rows["w"], 1000 * rows["load-factor"]

    def motion(self, rate, settings, last):
        """w over the load while it grows to `last` newtons."""
        rows = self.sensors("run", [f"parameters.rate={rate} N/s",
                                    f"simulation.duration={last / rate}", *settings])
        return rows["w"], rate * rows["t"]


def truss(runs, bars, rate, coupling):
    return runs.motion(rate, [f"parameters.n={bars}", f"bodies.left.coupling={coupling}",
                              f"bodies.right.coupling={coupling}"], 2 * CRITICAL)


def save(figure, out, name):
    figure.tight_layout()
    figure.savefig(out / name, metadata={"Date": None})
    pyplot.close(figure)
    print(out / name)


def displacement_over_load(runs, out):
    figure, axes = pyplot.subplots(figsize=(6.2, 4))
    w, load = runs.path()
    axes.plot(load, w, "k--", label="static path")
    for rate in (1000, 5000, 10000):
        w, load = truss(runs, 2, rate, "full")
        axes.plot(load, w, label=f"{rate} N/s")
    axes.set(xlabel="load [N]", ylabel="displacement of the apex w [m]", xlim=(-650, 1200))
    axes.legend()
    save(figure, out, "displacement_over_load.svg")


def coupling(runs, out):
    figure, panels = pyplot.subplots(1, 2, figsize=(7.6, 3.6))
    for bars, style in ((1, "-"), (2, "--")):
        full, load = truss(runs, bars, 10000, "full")
        none, _ = truss(runs, bars, 10000, "none")
        panels[0].plot(load, full, "C0" + style, label=f"with, elements per bar: {bars}")
        panels[0].plot(load, none, "C3" + style, label=f"without, elements per bar: {bars}")
        panels[1].plot(load, 1e3 * (none - full), "C3" + style,
                       label=f"elements per bar: {bars}")
    panels[0].set(xlabel="load [N]", ylabel="w [m]")
    panels[1].set(xlabel="load [N]", ylabel="w without - w with coupling terms [mm]")
    for axes in panels:
        axes.legend(fontsize=7)
    save(figure, out, "coupling.svg")


def single_terms(runs, out):
    figure, panels = pyplot.subplots(1, 2, figsize=(7.6, 3.6), sharey=True)
    for axes, bars in zip(panels, (1, 2)):
        full, load = truss(runs, bars, 10000, "full")
        for level, label in (("nocent", "without centrifugal terms"),
                             ("nocor", "without Coriolis terms"),
                             ("nojvar", "without variable inertia"), ("none", "without all")):
            w, _ = truss(runs, bars, 10000, level)
            axes.plot(load, 1e3 * (w - full), label=label)
        axes.set(xlabel="load [N]", title=f"elements per bar: {bars}")
    panels[0].set(ylabel="w - w with all terms [mm]")
    panels[0].legend(fontsize=7)
    save(figure, out, "single_terms.svg")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default="build/release/bin/buckens")
    parser.add_argument("--out", type=pathlib.Path, default=HERE)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        runs = Runs(arguments.program, HERE / "snap_through.yaml", pathlib.Path(scratch))
        displacement_over_load(runs, arguments.out)
        coupling(runs, arguments.out)
        single_terms(runs, arguments.out)


if __name__ == "__main__":
    main()
