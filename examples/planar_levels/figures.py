#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs both models at every level and draws how far the tip gets from `full`.

    python3 examples/planar_levels/figures.py build/release/bin/buckens docs/pictures

Writes planar_levels_pendulum.svg and planar_levels_free_flight.svg, and prints the table of README.md.
"""

import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).parent
LEVELS = ["full", "first-order", "noquad", "nocent", "nocor", "nojvar", "none"]
COLOURS = ["", "#0072b2", "#009e73", "#d55e00", "#cc79a7", "#e69f00", "#000000"]
WIDTH, HEIGHT, LEFT, BOTTOM, TOP, RIGHT = 720, 400, 70, 45, 30, 130


def run(program, model, level):
    """Times, tips, and the summary of one run."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out"
        subprocess.run([program, "run", HERE / f"{model}.yaml", "-o", out, "--quiet",
                        "--set", f"bodies.beam.coupling={level}"], check=True)
        with open(out / "sensors.csv", newline="") as file:
            rows = list(csv.reader(file))
        names = [name.split(" [")[0] for name in rows[0]]
        table = [[float(x) for x in row] for row in rows[1:]]
        column = {name: [row[k] for row in table] for k, name in enumerate(names)}
        summary = json.loads((out / "summary.json").read_text())
    return column["t"], list(zip(column["tip.x"], column["tip.y"])), summary


def figure(title, times, curves):
    """An SVG of distances [m] over time, logarithmic."""
    low, high = -5, 0
    x_of = lambda t: LEFT + (WIDTH - LEFT - RIGHT) * t / times[-1]
    y_of = lambda v: TOP + (HEIGHT - TOP - BOTTOM) * (high - v) / (high - low)
    svg = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" '
           'font-family="sans-serif" font-size="13">',
           f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#fff"/>',
           f'<text x="{LEFT}" y="18">{title}</text>']
    for e in range(low, high + 1):
        y = y_of(e)
        svg.append(f'<path d="M{LEFT} {y:.1f}H{WIDTH - RIGHT}" stroke="#ddd"/>'
                   f'<text x="{LEFT - 8}" y="{y + 4:.1f}" text-anchor="end">1e{e} m</text>')
    for k in range(6):
        t = times[-1] * k / 5
        svg.append(f'<text x="{x_of(t):.1f}" y="{HEIGHT - BOTTOM + 18}" '
                   f'text-anchor="middle">{t:g} s</text>')
    for k, (level, values) in enumerate(curves.items()):
        colour = COLOURS[LEVELS.index(level)]
        points = [(x_of(t), y_of(min(high, math.log10(max(v, 10.0 ** low)))))
                  for t, v in zip(times, values)]
        path = "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in points)
        svg.append(f'<path d="{path}" fill="none" stroke="{colour}" stroke-width="1.6"/>')
        y = TOP + 14 + 20 * k
        svg.append(f'<path d="M{WIDTH - RIGHT + 12} {y - 4}h22" stroke="{colour}" '
                   'stroke-width="2.5"/>'
                   f'<text x="{WIDTH - RIGHT + 40}" y="{y}">{level}</text>')
    return "\n".join([*svg, "</svg>"]) + "\n"


def main(program, folder):
    for model, title in [("pendulum", "Pendulum: distance of the tip from coupling full"),
                         ("free_flight", "Free flight: distance of the tip from coupling full")]:
        times, full, _ = run(program, model, "full")
        curves = {}
        for level in LEVELS[1:]:
            _, tips, summary = run(program, model, level)
            curves[level] = [math.dist(a, b) for a, b in zip(tips, full)]
            print(f"{model:12} {level:12} tip off by {max(curves[level]):.2g} m at most, "
                  f"energy balance {summary['energy_error']:.2g}")
        path = pathlib.Path(folder) / f"planar_levels_{model}.svg"
        path.write_text(figure(title, times, curves), encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
