#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the block pendulum with several meshes and reduced bases and prints the table of README.md.

    python3 examples/block_pendulum/table.py build/release/bin/buckens [--meshes 3] [--modes 8,32]
"""

import argparse
import csv
import json
import math
import pathlib
import subprocess
import tempfile

MODEL = pathlib.Path(__file__).with_name("block_pendulum.yaml")
MESHES = [(10, 2, 2), (110, 2, 2), (133, 4, 4), (274, 10, 10)]


def run(program, out, *settings):
    command = [program, "run", MODEL, "-o", out, "--quiet"]
    for setting in settings:
        command += ["--set", setting]
    subprocess.run([str(part) for part in command], check=True)
    rows = list(csv.reader((out / "sensors.csv").open()))
    values = dict(zip((name.split(" [")[0] for name in rows[0]), zip(*rows[1:])))
    tip = [[float(x) for x in values[f"tip.{axis}"]] for axis in "xyz"]
    return json.loads((out / "summary.json").read_text()), tip


def apart(one, other):
    return max(math.dist(a, b) for a, b in zip(zip(*one), zip(*other)))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("--meshes", type=int, default=len(MESHES), help="how many of the four")
    parser.add_argument("--modes", default="", help="numbers of modes of reduced bodies")
    arguments = parser.parse_args()
    modes = [int(n) for n in arguments.modes.split(",") if n]
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for divisions in MESHES[:arguments.meshes]:
            mesh = f"bodies.block.mesh.box.divisions=[{','.join(map(str, divisions))}]"
            name = "{} × {} × {}".format(*divisions)
            cases = [("full", [])] + [
                (f"{n} modes", [f"bodies.block.reduction={{free-free: {n}}}"]) for n in modes]
            full = None
            for case, settings in cases:
                out = pathlib.Path(folder) / f"{len(rows)}"
                summary, tip = run(arguments.program, out, mesh, *settings)
                full = tip if full is None else full
                steps = summary["steps"]
                rows.append((name, case, summary["bodies"]["block"], steps,
                             summary["wall_seconds"]["stepping"] / steps, tip, apart(tip, full)))
    print("| mesh | body | variables | time per step [ms] | tip.y at the end [m] | "
          "largest distance from the full body [m] |")
    print("|---|---|---|---|---|---|")
    for name, case, effort, _, seconds, tip, distance in rows:
        print(f"| {name} | {case} | {effort['dof']} | {1e3 * seconds:.3g} | {tip[1][-1]:.7f} | "
              f"{'-' if case == 'full' else f'{distance:.1e}'} |")


if __name__ == "__main__":
    main()
