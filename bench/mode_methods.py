#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares the methods of free vibration: FM (28), (29), (31), Lanczos, dense.

    python3 bench/mode_methods.py [--program build/release/bin/buckens] [--count 20] [--quick]

Prints a Markdown table: work, fill, time against `subspace`, condition of the factored matrix, and how
far the frequencies are from those of `subspace`.
"""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

METHODS = ["subspace", "augmented", "penalty", "spectra", "dense"]


def beam(elements):
    return f"beam, {elements} elements", {
        "beam": {"to": [1, 0, 0], "elements": elements, "material": STEEL,
                 "section": {"rectangle": {"width": 0.01, "height": 0.02}}}}


def grid(cells):
    """A square grid of beams in the x-y plane."""
    nodes, beams = {}, []
    for i in range(cells + 1):
        for j in range(cells + 1):
            nodes[f"n{i}_{j}"] = [0.1 * i, 0.1 * j, 0]
            for k, l in [(i + 1, j), (i, j + 1)]:
                if k <= cells and l <= cells:
                    beams.append({"between": [f"n{i}_{j}", f"n{k}_{l}"], "elements": 3,
                                  "section": {"circle": {"diameter": 0.008}}, "material": STEEL})
    return f"grid of beams, {cells} x {cells} cells", {
        "structure": {"nodes": nodes, "beams": beams}}


def block(n):
    """A solid with a quadratic cross-section."""
    return f"solid block, {4 * n} x {n} x {n} hex8", {
        "mesh": {"box": {"size": [0.4, 0.1, 0.1], "divisions": [4 * n, n, n]}, "material": STEEL}}


STEEL = {"E": 2.1e11, "nu": 0.3, "rho": 7850}


def analyse(program, body, method, count, *options):
    """The analysis, or the reason why there is none."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "model.json"
        path.write_text(json.dumps({"buckens": 1, "bodies": {"b": body}}))
        done = subprocess.run([program, "modes", path, "--json", "--count", str(count),
                               "--method", method, *options], capture_output=True, text=True)
    answer = json.loads(done.stdout)
    if "error" in answer:
        return answer["error"]["message"]
    return answer["analyses"][0]


def difference(modes, reference):
    pairs = zip(modes, reference)
    return max(abs(a["frequency"] / b["frequency"] - 1) for a, b in pairs)


def rows(program, body, count):
    """Cells of the methods' rows, and the degrees of freedom; 0 where no method gives anything."""
    cells, reference = [], None
    for method in METHODS:
        found = analyse(program, body, method, count)
        if isinstance(found, str):
            cells.append([method] + 6 * ["–"] + [found.split(";")[0].split(": ", 1)[-1]])
            continue
        reference = reference or found
        work = found["work"]
        condition = "–"
        if method != "dense":  # factorises no matrix of the equation
            judged = analyse(program, body, method, count, "--condition")
            condition = f"{judged['work']['condition']:.0e}"
        cells.append([method, work["factorisations"], work["sweeps"] or "–", work["solves"],
                      f"{work['factor_entries']:.2g}",
                      f"{work['seconds'] / reference['work']['seconds']:.1f}", condition,
                      f"{difference(found['modes'], reference['modes']):.0e}"])
    return cells, reference["dof"] if reference else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--program", default="build/release/bin/buckens")
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--quick", action="store_true", help="small models only")
    arguments = parser.parse_args()
    models = [beam(40), grid(6)] if arguments.quick else [beam(40), grid(6), grid(16), block(4),
                                                          block(10)]
    print("| model | method | factors | sweeps | solves | entries | time | condition | difference |")
    print("|---|---|---|---|---|---|---|---|---|")
    for name, body in models:
        cells, dof = rows(arguments.program, body, arguments.count)
        if dof == 0:
            print(f"{name}: {cells[0][-1]}", file=sys.stderr)
            continue
        for row in cells:
            title = f"{name}, {dof} DOF" if row[0] == "subspace" else ""
            print("| " + " | ".join(str(cell) for cell in [title, *row]) + " |", flush=True)


if __name__ == "__main__":
    main()
