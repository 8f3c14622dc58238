# SPDX-License-Identifier: Apache-2.0
"""Bodies with several frames, as seen by users."""

import csv
import json

import h5py
import numpy
import pytest


BEAM = """
buckens: 1
gravity: [0, 0, -9.81]
bodies:
  rod:
    beam: {{to: [1 m, 0, 0], elements: 8, material: {{E: 200 GPa, nu: 0.3, rho: 7850}},
           section: {{circle: {{diameter: 20 mm}}}}}}
    frames: {frames}
    markers: {{grip: {{position: [700 mm, 0, 0]}}}}
joints:
  pin: {{spherical: {{between: [ground, rod/start]}}}}
loads:
  pull: {{force: {{on: rod/grip, value: [0, 50 N, 0]}}}}
simulation: {{duration: 50 ms, step: 0.5 ms}}
output:
  every: 5 ms
  sensors:
    tip: {{position: rod/end}}
    com: {{position: rod}}
    sag: {{deflection: {{of: rod/mid, from: chord}}}}
    root: {{section-force: {{of: rod, element: 1}}}}
    stress: {{stress: rod}}
    pin: {{joint-force: pin}}
"""

TRUSS = """
buckens: 1
planar: xy
bodies:
  truss:
    structure:
      nodes: {{left: [-1, 0, 0], top: [0, 0.2, 0], right: [1, 0, 0]}}
      bars:
        - {{between: [left, top], elements: {n}, area: 1e-3, material: {{E: 2e8, rho: 1000}}}}
        - {{between: [top, right], elements: {n}, area: 1e-3, material: {{E: 2e8, rho: 1000}}}}
    frames: {frames}
joints:
  a: {{revolute: {{between: [{{ground: [-1, 0, 0]}}, truss/left]}}}}
  b: {{revolute: {{between: [{{ground: [1, 0, 0]}}, truss/right]}}}}
loads:
  push: {{force: {{on: truss/top, value: [0, -300, 0]}}}}
initial: {{start: static}}
simulation: {{duration: 1 ms, step: 0.1 ms}}
output: {{every: 0.5 ms, sensors: {{top: {{position: truss/top}}}}}}
"""


@pytest.fixture
def run(buckens, tmp_path):
    def call(text, name="model"):
        (tmp_path / f"{name}.yaml").write_text(text)
        buckens("run", f"{name}.yaml", "-o", name).must(0)
        rows = list(csv.reader((tmp_path / name / "sensors.csv").open()))
        columns = dict(zip([title.split(" ")[0] for title in rows[0]],
                           numpy.array(rows[1:], dtype=float).T))
        summary = json.loads((tmp_path / name / "summary.json").read_text())
        return columns, summary, h5py.File(tmp_path / name / "results.h5")

    return call


def test_frames_do_not_change_what_bends_little(run):
    one, _, _ = run(BEAM.format(frames=1), "one")
    many, summary, _ = run(BEAM.format(frames="per-element"), "many")
    # Deflections of some millimetres: frames differ by their squares.
    for name in ("tip.x", "tip.y", "tip.z"):
        assert numpy.abs(one[name] - many[name]).max() < 5e-5, name
    assert numpy.abs(one["com.z"] - many["com.z"]).max() < 2e-3  # a point of the mesh, not the frame
    assert numpy.abs(one["sag.z"] - many["sag.z"]).max() < 0.02 * numpy.abs(one["sag.z"]).max()
    assert numpy.abs(one["pin.y"] - many["pin.y"]).max() < 0.02 * numpy.abs(one["pin.y"]).max()
    assert summary["bodies"]["rod"]["frames"] == 8
    assert summary["bodies"]["rod"]["factorisations"] <= 8
    assert list(summary["bodies"]) == ["rod"]


def test_results_show_one_body(run):
    _, _, results = run(BEAM.format(frames=4))
    rod = results["bodies/rod"]
    assert rod["displacement"].shape[1:] == (9, 6)
    assert rod["section_force"].shape[1:] == (8, 12)
    assert rod["cut_force"].shape[1:] == (3, 6)
    assert list(results["joints"]) == ["pin"]
    # Section and cut give the same force: body axes are beam axes here. The element's own inertia
    # makes the difference.
    cut = rod["cut_force"][-1, 1]
    section = rod["section_force"][-1, 3]
    assert abs(abs(cut[0]) - abs(section[6])) < 0.2 * abs(section[6]) + 1.0


def test_truss_of_divided_bars(run):
    one, _, _ = run(TRUSS.format(n=1, frames="per-element"), "one")
    two, summary, _ = run(TRUSS.format(n=2, frames="per-element"), "two")
    # In equilibrium a divided bar equals the undivided one.
    assert two["top.y"][0] == pytest.approx(one["top.y"][0], abs=1e-12)
    assert summary["bodies"]["truss"]["frames"] == 4


def test_check_reports_the_whole(buckens, tmp_path):
    (tmp_path / "m.yaml").write_text(BEAM.format(frames=4))
    report = buckens("check", "m.yaml", "--json").must(0).json
    rod = report["bodies"]["rod"]
    assert rod["frames"] == 4 and rod["elements"] == 8 and rod["nodes"] == 9
    assert len(rod["frequencies"]) == 10 and rod["frequencies"][0] > 80
    assert not any("#" in name for name in rod["markers"])
    assert report["redundant_rows"] == 0 if "redundant_rows" in report else True


@pytest.mark.parametrize("text, words", [
    (BEAM.format(frames=9), ["9 frames for 8 elements", "model.yaml"]),
    (BEAM.format(frames=0), ["must be positive"]),
    (BEAM.format(frames="per-node"), ["is not a number of frames", "per-element"]),
    (TRUSS.format(n=2, frames=1), ["a chain of bars in one frame", "per-element"]),
    (BEAM.format(frames=2).replace("between: [ground, rod/start]", "between: [rod/end, rod/start]"),
     ["are on the same body"]),
], ids=["too-many", "zero", "word", "bars", "itself"])
def test_wrong_frames(buckens, tmp_path, text, words):
    (tmp_path / "model.yaml").write_text(text)
    code = 3 if "9 frames" in words[0] else 2
    buckens("run", "model.yaml", "-o", "out").must(code, *words)
