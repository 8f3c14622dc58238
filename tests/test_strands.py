# SPDX-License-Identifier: Apache-2.0
"""Small bodies that step side by side move like those that step one by one.

A signal that nobody uses sends a model through the general route, without changing anything else.
"""

import csv
import json
import pathlib
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from test_save_state import LINKS, ON_ROD, PLANAR, SPATIAL, model  # noqa: E402

# Two branches, one of them rigid at its end.
TREE = """buckens: 1
gravity: [1, 0, -9.81]
materials: {steel: {E: 200 GPa, nu: 0.3, rho: 7850}}
sections: {pipe: {circle: {diameter: 20 mm}}}
bodies:
  tree:
    frames: per-element
    structure:
      nodes: {a: [0, 0, 0], b: [0, 0, 1], c: [0.5, 0, 1.5], d: [-0.5, 0.2, 1.5]}
      beams:
        - {between: [a, b], elements: 4, section: pipe, material: steel}
        - {between: [b, c], elements: 3, section: pipe, material: steel}
        - {between: [b, d], elements: 3, section: pipe, material: steel}
  ball: {rigid: {mass: 2, inertia: [1e-3, 1e-3, 1e-3]}, at: {position: [-0.5, 0.2, 1.5]}}
joints:
  foot: {fixed: {between: [ground, tree/a]}}
  weld: {fixed: {between: [tree/d, ball]}}
simulation: {duration: 60 ms, step: 0.2 ms}
output: {every: 0.7 ms, sensors: {c: {position: tree/c}, ball: {position: ball}, foot: {joint-force: foot}, balance: {energy: balance}}}
"""

# Forces that turn with links, by laws of time.
ON_LINKS = """loads:
  pull: {force: {on: b9/b, value: [20 N, 0, 5 N]}}
  push: {force: {on: b4, value: [0, "10 * cos(20 * t) N", 0], axes: following}}
  twist: {torque: {on: b6/a, value: [0.3 N m, 0, -0.1 N m]}}
"""

CASES = {"plane": model(PLANAR), "space": model(SPATIAL), "links": model(LINKS), "tree": TREE,
         "hht": model(PLANAR, step="method: hht"), "step control": model(PLANAR, step="tolerance: 1e-5").replace("60 ms", "6 ms"),
         "first-order": model(SPATIAL).replace("frames:", "coupling: first-order\n    frames:"),
         "loads in the plane": model(PLANAR) + ON_ROD, "loads in space": model(SPATIAL) + ON_ROD,
         "loads on links": model(LINKS) + ON_LINKS}


def columns(directory):
    with open(directory / "sensors.csv") as file:
        rows = [row for row in csv.reader(file) if row and not row[0].startswith("#")]
    return rows[0], [[float(row[k]) for row in rows[1:]] for k in range(len(rows[0]))]


@pytest.mark.parametrize("name", CASES)
def test_side_by_side_is_one_by_one(buckens, tmp_path, name):
    text = CASES[name]
    (tmp_path / "together.yaml").write_text(text)
    (tmp_path / "alone.yaml").write_text(text + "signals: {unused: \"t\"}\n")
    for way in ("together", "alone"):
        buckens("run", f"{way}.yaml", "-q", "-o", way).must(0)
    (names, together), (_, alone) = (columns(tmp_path / way) for way in ("together", "alone"))
    assert len(names) > 4
    for label, one, other in zip(names, together, alone):
        # A step leaves 1e-10 of its motion open, and forces that much over h^2.
        scale = max(map(abs, other), default=0.0)
        share = 1e-5 if "[N" in label else 1e-7
        if "balance" in label:
            continue  # of rounding itself
        assert one == pytest.approx(other, rel=share, abs=share * max(scale, 1e-3)), label
    steps = [json.loads((tmp_path / way / "summary.json").read_text())["steps"] for way in ("together", "alone")]
    assert steps[0] == steps[1]
