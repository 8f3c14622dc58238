#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the figures of docs/theory/09-integration-methods.md from runs of the program.

    python3 docs/figures/integration_methods.py [--program build/release/bin/buckens]

Needs python3-numpy and python3-matplotlib; takes about a minute. Prints the numbers of the page.
"""
import argparse
import csv
import json
import pathlib
import subprocess
import tempfile

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams.update({"svg.hashsalt": "buckens", "svg.fonttype": "none", "font.size": 9,
                            "axes.grid": True, "grid.alpha": 0.3, "lines.linewidth": 1.1})
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent

METHODS = {
    "newmark": ("Newmark", "C0"),
    "generalized-alpha": ("generalised-α, ρ∞ = 0.9", "C1"),
    "hht": ("HHT, α = −0.1", "C2"),
    "wilson": ("Wilson, ϑ = 1.4", "C3"),
}

BAR = """
buckens: 1
planar: xy
materials: {m: {E: 0.08333333333333333 Pa, rho: 1}}
sections: {s: {general: {A: 1, Iy: 1, Iz: 1, J: 1}}}
bodies: {bar: {beam: {to: [1, 0, 0], elements: 1, section: s, material: m}, coupling: none}}
initial: {bodies: {bar: {nodal-velocity: {x: "x - 0.5"}}}}
simulation: {duration: %(duration).17g, step: %(step).17g, method: %(method)s}
output: {every: %(step).17g, sensors: {kinetic: {energy: kinetic}, strain: {energy: strain}}}
"""

PENDULUM = """
buckens: 1
gravity: [0, -9.81, 0]
planar: xy
materials: {soft: {E: 1e8 Pa, nu: 0, rho: 100 kg/m^3}}
sections: {strip: {general: {A: 1e-2, Iy: 1e-6, Iz: 1e-6, J: 2e-6}}}
bodies: {beam: {beam: {to: [1, 0, 0], elements: 8, section: strip, material: soft}}}
joints: {pin: {revolute: {between: [ground, beam/start]}}}
simulation: {duration: 2 s, step: %(step)s, %(options)s}
output:
  every: %(step)s
  sensors:
    pin: {position: beam/start}
    rate: {velocity: beam/start}
    tip: {position: beam/end}
    bearing: {joint-force: pin}
    balance: {energy: balance}
"""


class Program:
    """Runs models and returns their sensors as columns, and the summary."""

    def __init__(self, path):
        self.path = path
        self.directory = tempfile.TemporaryDirectory()

    def run(self, text):
        directory = pathlib.Path(self.directory.name)
        model = directory / "model.yaml"
        model.write_text(text)
        out = directory / "out"
        subprocess.run([self.path, "run", model, "-o", out, "-q"], check=True,
                       stderr=subprocess.DEVNULL)
        with open(out / "sensors.csv", encoding="utf-8") as file:
            rows = list(csv.reader(line for line in file if not line.startswith("#")))
        columns = {name.split(" ")[0]: np.array([float(row[k]) for row in rows[1:]])
                   for k, name in enumerate(rows[0])}
        return columns, json.loads((out / "summary.json").read_text())


def measured_radius(program, method, step, count=60):
    """Factor per step by which a vibration of ω = 1/s decays, late in the run."""
    columns, _ = program.run(BAR % {"duration": count * step, "step": step, "method": method})
    energy = next(v for k, v in columns.items() if "kinetic" in k) + \
        next(v for k, v in columns.items() if "strain" in k)
    late = slice(count // 3, count)
    good = energy[late] > 1e-290
    slope = np.polyfit(np.arange(len(energy))[late][good], np.log(energy[late][good]), 1)[0]
    return np.exp(0.5 * slope)


def exact_radius(method, w):
    """Spectral radius of the method's matrix for ωh = w."""
    if method == "wilson":
        t = 1.4
        b = 1 / (t / w**2 + t**3 / 6)
        a = np.array([[1 - b * t**2 / 3 - 1 / t, -b * t, -b],
                      [1 - 1 / (2 * t) - b * t**2 / 6, 1 - b * t / 2, -b / 2],
                      [0.5 - 1 / (6 * t) - b * t**2 / 18, 1 - b * t / 6, 1 - b / 6]])
        return max(abs(np.linalg.eigvals(a)))
    if method == "newmark":
        return 1.0
    am, af = (0.8 / 1.9, 0.9 / 1.9) if method == "generalized-alpha" else (0.0, 0.1)
    gamma = 0.5 - am + af
    beta = (1 - am + af)**2 / 4
    end = np.array([[1, 0, -beta], [0, 1, -gamma], [(1 - af) * w**2, 0, 1 - am]])
    start = np.array([[1, 1, 0.5 - beta], [0, 1, 1 - gamma], [-af * w**2, 0, -am]])
    return max(abs(np.linalg.eigvals(np.linalg.solve(end, start))))


def draw_damping(program):
    figure, axes = plt.subplots(figsize=(6.4, 3.6), layout="constrained")
    fine = np.logspace(-1, 3, 200)
    points = np.logspace(-0.7, 2.8, 11)
    for method, (label, color) in METHODS.items():
        axes.semilogx(fine, [exact_radius(method, w) for w in fine], color=color, label=label)
        radii = [measured_radius(program, method, h) for h in points]
        axes.semilogx(points, radii, "o", color=color, markersize=3.5)
        difference = max(abs(r - exact_radius(method, h)) for r, h in zip(radii, points))
        print(f"damping {method}: measured and exact radius differ by at most {difference:.1e}")
    axes.set_xlabel("ωh")
    axes.set_ylabel("amplitude after a step / before")
    axes.legend(loc="lower left")
    figure.savefig(HERE / "integration_damping.svg", metadata={"Date": None})


def column(columns, *words):
    """The columns whose names contain all words."""
    return np.array([v for k, v in columns.items() if all(w in k for w in words)])


def draw_pendulum(program):
    step = "1 ms"
    variants = {method: (f"method: {method}", label, color, "-")
                for method, (label, color) in METHODS.items()}
    variants["free"] = ("method: newmark, projection: off", "Newmark, no projection", "C4", "--")
    figure, axes = plt.subplots(4, 1, figsize=(6.4, 9.6), layout="constrained")
    for name, (options, label, color, line) in variants.items():
        columns, summary = program.run(PENDULUM % {"step": step, "options": options})
        t = columns[next(iter(columns))]
        balance = column(columns, "balance")[0]
        drift = np.linalg.norm(column(columns, "pin"), axis=0)
        rate = np.linalg.norm(column(columns, "rate"), axis=0)
        force = column(columns, "bearing")[1]
        axes[0].plot(t[::8], balance[::8], line, color=color, label=label)
        axes[1].semilogy(t[1::8], np.maximum(drift[1::8], 1e-18), line, color=color, label=label)
        axes[2].semilogy(t[1::8], np.maximum(rate[1::8], 1e-18), line, color=color, label=label)
        window = (t > 1.0) & (t < 1.06)
        if name != "free":
            axes[3].plot(t[window], force[window], ".-", color=color, label=label, markersize=3)
        ripple = np.abs(np.diff(force, 2))[t[1:-1] > 1.0].mean()
        print(f"pendulum {name}: energy balance {np.abs(balance).max():.2e} J, "
              f"drift {drift.max():.1e} m, velocity {rate.max():.1e} m/s, "
              f"second difference of the bearing force {ripple:.3g} N, "
              f"rejected {summary['step_control']['failed']}")
    for axis, text in zip(axes, ("energy balance [J]", "gap of the joint [m]",
                                 "velocity in the joint [m/s]", "bearing force y [N]")):
        axis.set_ylabel(text)
        axis.set_xlabel("t [s]")
    axes[0].legend(loc="best", fontsize=7)
    figure.savefig(HERE / "integration_pendulum.svg", metadata={"Date": None})


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default="build/release/bin/buckens")
    program = Program(pathlib.Path(parser.parse_args().program).resolve())
    draw_damping(program)
    draw_pendulum(program)


if __name__ == "__main__":
    main()
