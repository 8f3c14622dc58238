# SPDX-License-Identifier: Apache-2.0
"""Cubes of solids solved by a factor and by iteration: memory, time, and from how many steps on the factor pays.

    bench/large_bodies.py PROGRAM --sides 15 20 25
    bench/large_bodies.py --draw docs/pictures

Each cube is run twice, with few and with more steps; what they differ by are steps, the rest is set-up. Times are processor times, which
other programs disturb less than wall times. Runs are added to the file.
"""

import argparse
import datetime
import json
import os
import pathlib
import subprocess
import tempfile

import numpy

RESULTS = pathlib.Path(__file__).resolve().parent.parent / "docs/developers/large_bodies.json"

MODEL = """\
buckens: 1
title: A cube of steel on a ball joint
gravity: [0, 0, -9.81 m/s^2]
materials: {{steel: {{E: 210 GPa, nu: 0.3, rho: 7850 kg/m^3}}}}
bodies:
  cube:
    at: {{position: [0, -0.05 m, -0.05 m]}}
    mesh: {{box: {{size: [0.1 m, 0.1 m, 0.1 m], divisions: [{side}, {side}, {side}], element: hex8}}, material: steel}}
    interfaces: {{bearing: {{face: x0}}}}
    solver: {solver}
joints: {{ball: {{spherical: {{between: [ground, cube/bearing]}}}}}}
simulation: {{duration: {steps}00 us, step: 0.1 ms}}
output: {{every: 0.1 ms, sensors: {{corner: {{position: cube/corner_111}}, bearing: {{joint-force: ball}}}}}}
"""


def run(program, side, solver, steps):
    """Summary of one run, its processor time and its peak of memory."""
    with tempfile.TemporaryDirectory() as folder:
        model = pathlib.Path(folder) / "cube.yaml"
        model.write_text(MODEL.format(side=side, solver=solver, steps=steps))
        out = pathlib.Path(folder) / "out"
        process = subprocess.Popen([program, "run", model, "-o", out, "--quiet"])
        _, status, usage = os.wait4(process.pid, 0)
        if status != 0:
            raise SystemExit(f"{side}, {solver}: the program ended with {os.waitstatus_to_exitcode(status)}")
        return json.loads((out / "summary.json").read_text()), usage.ru_utime + usage.ru_stime, 1024 * usage.ru_maxrss


def measure(program, side, solver, steps):
    few = max(2, steps // 10)
    _, short, _ = run(program, side, solver, few)
    summary, long, peak = run(program, side, solver, few + steps)
    body = summary["bodies"]["cube"]
    per_step = (long - short) / steps
    return {"side": side, "variables": body["dof"], "solver": solver, "steps": steps,
            "setup_seconds": short - few * per_step, "step_seconds": per_step,
            "solves_per_step": body["solves"] / summary["steps"], "setup_solves": summary["setup_solves"],
            "iterations_per_solve": body.get("iterations_per_solve", 0), "peak_bytes": peak,
            "load": os.getloadavg()[0], "date": datetime.datetime.now().strftime("%Y-%m-%d")}


def tell_break_even(rows):
    """Says from how many steps on the factor takes less time, set-up included."""
    direct = {r["variables"]: r for r in rows if r["solver"] == "direct"}
    for row in rows:
        if row["solver"] == "direct" or row["variables"] not in direct:
            continue
        factor = direct[row["variables"]]
        more = factor["setup_seconds"] - row["setup_seconds"]
        steps = max(0.0, more / (row["step_seconds"] - factor["step_seconds"]))
        print(f"{row['variables']} variables: the factor is quicker from {steps:.0f} steps on")


def law_of_factor(measured, key, power, variables):
    """A figure of the largest cube with a factor, for another number of variables."""
    last = measured[-1]
    return last[key] * (variables / last["variables"]) ** power


def draw_break_even(axis, by_solver):
    """Time of whole runs over their steps, for the largest cube of both solvers and for the largest of all."""
    direct, iterative = by_solver["direct"], by_solver["iterative"]
    steps = numpy.logspace(0, 5, 50)
    largest = iterative[-1]
    both = next(r for r in iterative if r["variables"] == direct[-1]["variables"])
    # Operations of a factor grow as the square, its entries with the power 4/3.
    predicted = {"setup_seconds": law_of_factor(direct, "setup_seconds", 2, largest["variables"]),
                 "step_seconds": law_of_factor(direct, "step_seconds", 4 / 3, largest["variables"])}
    for row, colour, style in ((direct[-1], "tab:blue", "-"), (both, "tab:orange", "-"), (predicted, "tab:blue", "--"),
                               (largest, "tab:orange", "-")):
        axis.loglog(steps, row["setup_seconds"] + steps * row["step_seconds"], style, color=colour)
    at = (predicted["setup_seconds"] - largest["setup_seconds"]) / (largest["step_seconds"] - predicted["step_seconds"])
    axis.plot(at, largest["setup_seconds"] + at * largest["step_seconds"], "ko", markersize=5)
    axis.annotate(f"{at:.0f} steps,\nbut 24 GB are not enough", (at, largest["setup_seconds"] + at * largest["step_seconds"]),
                  xytext=(1.3, 2e5), arrowprops={"arrowstyle": "-", "linewidth": 0.5})
    for row, below in ((both, 0.3), (largest, 0.5)):
        axis.text(1.1, below * row["setup_seconds"], f"{row['variables']:,} variables".replace(",", " "))
    axis.set_ylim(bottom=10)
    axis.set_xlabel("steps")
    axis.set_ylabel("processor time of a run [s]")
    axis.grid(True, which="major", linewidth=0.3)


def draw(rows, file):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot

    by_solver = {name: sorted((r for r in rows if r["solver"] == name), key=lambda r: r["variables"])
                 for name in ("direct", "iterative")}
    figure, ((memory, time), (setup, whole)) = pyplot.subplots(2, 2, figsize=(9, 7), constrained_layout=True)
    n = numpy.logspace(4, 6.6, 50)
    for name, power, colour in (("direct", 4 / 3, "tab:blue"), ("iterative", 1, "tab:orange")):
        measured = by_solver[name]
        x = numpy.array([r["variables"] for r in measured])
        for axis, values, law in ((memory, [r["peak_bytes"] / 1e9 for r in measured], power),
                                  (time, [r["step_seconds"] for r in measured], power)):
            axis.loglog(x, values, "o", color=colour, label=name)
            last = values[-1] / x[-1] ** law
            axis.loglog(n, last * n ** law, "--", color=colour, linewidth=0.8)
    memory.axhline(24, color="grey", linewidth=0.8)
    memory.text(1.1e4, 26, "24 GB")
    memory.set_ylabel("peak memory [GB]")
    time.set_ylabel("processor time per step [s]")
    for name, colour in (("direct", "tab:blue"), ("iterative", "tab:orange")):
        setup.loglog(*zip(*((r["variables"], r["setup_seconds"]) for r in by_solver[name])), "o-", color=colour)
    setup.set_ylabel("processor time of the set-up [s]")
    for axis in (memory, time, setup):
        axis.set_xlabel("nodal variables")
        axis.grid(True, which="major", linewidth=0.3)
    memory.legend()
    draw_break_even(whole, by_solver)
    figure.suptitle("Cubes of hex8 solids: dots measured, dashed lines laws through the last one")
    figure.savefig(file, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", help="buckens, built with BUCKENS_PETSC=ON")
    parser.add_argument("--sides", type=int, nargs="*", default=[15, 20, 25, 31], help="elements along an edge")
    parser.add_argument("--solvers", nargs="*", default=["direct", "iterative"])
    parser.add_argument("--steps", type=int, default=20)
    parser.add_argument("--into", type=pathlib.Path, default=RESULTS, help="file with the figures (docs/developers/large_bodies.json)")
    parser.add_argument("--draw", type=pathlib.Path, metavar="FOLDER", help="draws the figures as FOLDER/large_cubes.png")
    arguments = parser.parse_args()
    rows = json.loads(arguments.into.read_text()) if arguments.into.exists() else []
    if arguments.program:
        for side in arguments.sides:
            for solver in arguments.solvers:
                row = measure(arguments.program, side, solver, arguments.steps)
                rows = [r for r in rows if (r["side"], r["solver"]) != (side, solver)] + [row]
                rows.sort(key=lambda r: (r["solver"], r["variables"]))
                arguments.into.write_text(json.dumps(rows, indent=1) + "\n")
                print(json.dumps(row))
    tell_break_even(rows)
    if arguments.draw:
        draw(rows, arguments.draw / "large_cubes.png")


if __name__ == "__main__":
    main()
