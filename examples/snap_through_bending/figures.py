#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Figure of this example from the program's own output.

    python3 examples/snap_through_bending/figures.py [--program build/release/bin/buckens] [--out DIR]

Writes displacement_over_load.svg beside this file.
"""

import argparse
import pathlib
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "snap_through"))
from figures import Runs, pyplot, save  # noqa: E402


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default="build/release/bin/buckens")
    parser.add_argument("--out", type=pathlib.Path, default=HERE)
    arguments = parser.parse_args()
    figure, axes = pyplot.subplots(figsize=(6.2, 4))
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        bars = Runs(arguments.program, HERE.parent / "snap_through" / "snap_through.yaml",
                    scratch / "bars")
        beams = Runs(arguments.program, HERE / "snap_through_bending.yaml", scratch / "beams")
        w, load = bars.path()
        axes.plot(load, w, "k:", label="static path, bars that stay straight")
        w, load = beams.path()
        axes.plot(load, w, "k--", label="static path, bars that bend")
        for rate in (1000, 5000, 10000):
            w, load = beams.motion(rate, [], 1000)
            axes.plot(load, w, label=f"{rate} N/s")
    axes.set(xlabel="load [N]", ylabel="displacement of the apex w [m]", xlim=(-650, 1000))
    axes.legend()
    save(figure, arguments.out, "displacement_over_load.svg")


if __name__ == "__main__":
    main()
