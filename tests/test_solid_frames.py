# SPDX-License-Identifier: Apache-2.0
"""Blocks of solids divided into parts with a frame each, and the monitoring of their frequencies."""

import csv
import json

import numpy
import pytest

BLOCK = """
buckens: 1
gravity: [0, 0, -9.81 m/s^2]
bodies:
  block:
    mesh:
      box: {{size: [1 m, 0.1 m, 0.1 m], divisions: [12, 2, 2], element: hex8, integration: full}}
      material: {{E: 20 GPa, nu: 0.3, rho: 2000}}
    frames: {frames}
{rest}
simulation: {{duration: {duration}, step: 1 ms}}
output:
  every: 10 ms
  sensors:
    tip: {{position: block/face_x1}}
    com: {{position: block}}
    peak: {{stress: block}}
"""


@pytest.fixture
def run(buckens, tmp_path):
    """Runs a model; returns the columns of sensors.csv and the summary."""
    def call(text, *arguments):
        (tmp_path / "model.yaml").write_text(text)
        buckens("run", "model.yaml", "-o", "out", *arguments).must(0)
        rows = list(csv.reader((tmp_path / "out" / "sensors.csv").open()))
        values = numpy.array(rows[1:], dtype=float).T
        columns = {name.split(" [")[0]: column for name, column in zip(rows[0], values)}
        return columns, json.loads((tmp_path / "out" / "summary.json").read_text())

    return call


def vector(columns, name):
    return numpy.column_stack([columns[f"{name}.{axis}"] for axis in "xyz"])


def test_a_cut_block_falls_like_a_stone(run):
    rest = "initial: {bodies: {block: {velocity: [1 m/s, 0, 2 m/s], angular-velocity: [0, 0, 0]}}}"
    columns, summary = run(BLOCK.format(frames=4, duration="0.3 s", rest=rest))
    t = columns["t"]
    start = vector(columns, "com")[0]
    path = start + numpy.outer(t, [1, 0, 2]) + numpy.outer(0.5 * t**2, [0, 0, -9.81])
    # Uniform acceleration: the method is exact, only rounding through the ties remains.
    assert numpy.abs(vector(columns, "com") - path).max() < 1e-9
    assert numpy.abs(vector(columns, "tip") - vector(columns, "com") - [0.5, 0, 0]).max() < 1e-9
    # All parts fall equally and nothing is strained: E times 1e-9 of strain.
    assert columns["peak.mises"].max() < 20e9 * 1e-9


def test_a_cut_block_swings_like_a_whole_one(run):
    rest = "joints: {ball: {spherical: {between: [{ground: [0, 0.05, 0.05]}, block/face_x0]}}}"
    found = {k: run(BLOCK.format(frames=k, duration="0.5 s", rest=rest)) for k in (1, 3)}
    whole, cut = found[1][0], found[3][0]
    gap = numpy.abs(vector(whole, "tip") - vector(cut, "tip")).max()
    travel = numpy.linalg.norm(vector(whole, "tip") - vector(whole, "tip")[0], axis=1).max()
    assert travel > 1.0
    # Both are models of one mechanism. They differ by products of the bending angle, about
    # 3 rho g L^3/(E t^2) = 3e-4 rad, with itself and with |w|/w_1 = 0.01: 1e-5 of the length.
    assert gap < 1e-5
    assert whole["peak.mises"].max() == pytest.approx(cut["peak.mises"].max(), rel=0.02)
    for _, summary in found.values():
        assert summary["energy_error"] < 1e-4


@pytest.mark.parametrize("step", ["1 ms", "0.05 ms"])
def test_the_watch_knows_the_lowest_frequency_of_a_larger_solid(buckens, run, step):
    rest = "initial: {bodies: {block: {angular-velocity: [0, 0, 30 rad/s]}}}"
    text = BLOCK.format(frames=1, duration="10 ms", rest=rest)
    finer = "bodies.block.mesh.box.divisions=[40, 4, 4]"
    _, summary = run(text, "--set", finer, "--set", f"simulation.step={step}")
    report = buckens("modes", "model.yaml", "--set", finer, "--count", 1, "--json").must(0).json
    lowest = 2 * numpy.pi * report["analyses"][0]["modes"][0]["frequency"]
    body = summary["bodies"]["block"]
    assert body["dof"] == 3 * 41 * 5 * 5
    # Without a separate factor; 1 % is accurate enough for a warning, at short steps, too.
    assert summary["setup_solves"] <= 6 + 100
    assert body["spin_over_lowest_frequency"] == pytest.approx(30 / lowest, rel=0.01)
