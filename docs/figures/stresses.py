#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Draws docs/figures/stresses.svg: errors of recorded stresses over the mesh, from runs of the program.

    python3 docs/figures/stresses.py [--program build/release/bin/buckens]

Needs python3-numpy, python3-h5py and python3-matplotlib; takes some minutes. Prints the table of docs/theory/18-stresses.md.
"""
import argparse
import importlib.util
import math
import pathlib
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams.update({"svg.hashsalt": "buckens", "svg.fonttype": "none", "font.size": 9,
                            "axes.grid": True, "grid.alpha": 0.3, "lines.linewidth": 1.1})
import h5py  # noqa: E402
import matplotlib.pyplot as plt  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
CASES = ROOT / "verification" / "stresses"

# Case: body, kind of mesh, and per element the divisions from coarse to fine.
MESHES = {
    "spinning_bar": ("bar", "box", "Bar in free flight", {
        "hex8": [[4, 1, 1], [8, 2, 2], [16, 4, 4]],
        "hex20": [[4, 1, 1], [8, 2, 2], [16, 4, 4]],
        "tet10": [[4, 1, 1], [8, 2, 2], [16, 4, 4]]}),
    "disc": ("disc", "disc", "Rotating disc", {
        "hex8": [[3, 16, 1], [6, 32, 1], [12, 64, 1]],
        "hex20": [[3, 16, 1], [6, 32, 1], [12, 64, 1]],
        "tet10": [[3, 16, 1], [6, 32, 1]]}),
    "cantilever": ("bar", "box", "Cantilever under gravity", {
        "hex8": [[10, 2, 1], [20, 4, 1], [40, 8, 1]],
        "hex20": [[10, 2, 1], [20, 4, 1], [40, 8, 1]],
        "tet10": [[10, 2, 1], [20, 4, 1], [40, 8, 1]]}),
}
STYLES = {"hex8": "o-", "hex20": "s-", "tet10": "^-"}


def test_module():
    """The formulas are those of the test."""
    sys.path.insert(0, str(ROOT / "tests"))
    spec = importlib.util.spec_from_file_location("test_stresses", ROOT / "tests" / "test_stresses.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def errors(program, case, element, divisions, measure):
    body, shape, _, _ = MESHES[case]
    with tempfile.TemporaryDirectory() as scratch:
        path = f"bodies.{body}.mesh.{shape}"
        subprocess.run([program, "run", CASES / f"{case}.yaml", "-o", f"{scratch}/out", "-q", "--set",
                        f"{path}.divisions={divisions}", "--set", f"{path}.element={element}"], check=True)
        with h5py.File(f"{scratch}/out/results.h5", "r", swmr=True) as file:
            geometry = file[f"geometry/bodies/{body}"]
            nodes = geometry["nodes"][:]
            cells = geometry["cell_nodes"][:].reshape(len(geometry["cell_kinds"]), -1)
            corners = cells[:, :4 if element.startswith("tet") else 8]
            fields = file[f"fields/bodies/{body}"]
            return (measure(nodes[geometry["field_nodes"][:]], fields["nodes/stress"][-1]),
                    measure(nodes[corners].mean(1), fields["elements/stress"][-1]))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", default=str(ROOT / "build" / "release" / "bin" / "buckens"))
    program = parser.parse_args().program
    tests = test_module()
    measures = {"spinning_bar": tests.bar_error, "disc": tests.disc_error, "cantilever": tests.cantilever_error}
    figure, axes = plt.subplots(1, 3, figsize=(9, 3.1), sharey=True)
    print("| case | element | meshes | nodes | order | centres | order |\n|---|---|---|---|---|---|---|")
    for plot, (case, (_, _, title, meshes)) in zip(axes, MESHES.items()):
        for element, divisions in meshes.items():
            found = [errors(program, case, element, d, measures[case]) for d in divisions]
            sizes = [1 / d[0] for d in divisions]
            line, = plot.loglog(sizes, [f[0] for f in found], STYLES[element], label=f"{element}, nodes")
            plot.loglog(sizes, [f[1] for f in found], STYLES[element].replace("-", ":"), color=line.get_color(),
                        markerfacecolor="none", label=f"{element}, centres")
            orders = [math.log(found[-2][k] / found[-1][k], 2) for k in (0, 1)]
            print(f"| {title} | {element} | {' × '.join(map(str, divisions[0]))} … {' × '.join(map(str, divisions[-1]))} | "
                  f"{found[-1][0]:.1e} | {orders[0]:.1f} | {found[-1][1]:.1e} | {orders[1]:.1f} |")
        plot.set_title(title)
        plot.set_xlabel("1 / elements along")
    axes[0].set_ylabel("largest error / largest stress")
    axes[0].legend(fontsize=6.5)
    figure.tight_layout()
    figure.savefig(HERE / "stresses.svg", metadata={"Date": None})


if __name__ == "__main__":
    main()
