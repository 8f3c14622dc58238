# SPDX-License-Identifier: Apache-2.0
"""Second large solves that earlier ones answer: counted, without effect on the motion, and part of saved states."""

import json

import numpy
import pytest
from test_save_state import rows

# A steel block on a bearing, released from the horizontal: it rings, and each step changes its coupling load.
BLOCK = """buckens: 1
gravity: [0, -9.81, 0]
materials: {steel: {E: 210 GPa, nu: 0.3, rho: 7850 kg/m^3}}
bodies:
  block:
    mesh: {box: {size: [1, 0.1, 0.1], divisions: [20, 4, 4]}, material: steel}
    interfaces: {bearing: {face: x0}}
    markers: {tip: {position: [1, 0.05, 0.05]}}
joints: {pin: {revolute: {between: [ground, block/bearing], axis: [0, 0, 1]}}}
simulation: {duration: 30 ms, step: 0.1 ms}
output:
  every: 0.5 ms
  sensors:
    tip: {position: block/tip}
    pin: {joint-force: pin}
    balance: {energy: balance}
"""


@pytest.fixture
def run(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(BLOCK)

    def call(out, *arguments):
        buckens("run", "model.yaml", "-q", "-o", out, *arguments).must(0)
        summary = json.loads((tmp_path / out / "summary.json").read_text())
        return rows(tmp_path / out), summary

    return call


def test_most_second_solves_are_answered_by_earlier_ones(run):
    none, without = run("none", "--set", "simulation.kept-solves=0")
    some, kept = run("some")
    steps = kept["steps"]
    assert "recycled" not in without["bodies"]["block"]
    assert without["bodies"]["block"]["solves"] >= 2 * steps - 10
    counts = kept["bodies"]["block"]
    assert counts["factorisations"] == 1
    assert counts["solves"] <= steps + 80
    assert counts["solves"] + counts["recycled"] >= 2 * steps - 10
    a, b = numpy.array(none, float), numpy.array(some, float)
    largest = numpy.abs(a).max(axis=0)
    # The tip to rounding; forces, which are the tip's rounding over h squared, and the balance of energy,
    # which the step itself keeps to 1e-6 of what moves, to a hundredth of that.
    assert numpy.abs(a - b)[:, 1:4].max() < 1e-13
    assert (numpy.abs(a - b)[:, 4:7].max(axis=0) <= 1e-6 * largest[4:7].max()).all()
    assert without["energy_error"] == pytest.approx(kept["energy_error"], rel=0.02)


def test_threads_change_nothing(run, tmp_path):
    run("one")
    run("two", "--threads", 2)
    assert (tmp_path / "one/sensors.csv").read_bytes() == (tmp_path / "two/sensors.csv").read_bytes()


# 4000 steps of several lengths in the first 6 ms with step control, which has 40 000 in 30 ms.
@pytest.mark.parametrize("changes, half", [((), 0.015), (("tolerance=1e-4", "duration=8 ms"), 0.004)], ids=["", "tolerance=1e-4"])
def test_a_resumed_run_goes_on_with_what_was_kept(run, tmp_path, changes, half):
    control = [word for change in changes for word in ("--set", f"simulation.{change}")]
    whole, summary = run("whole", "--save-state", "whole.state", *control)
    assert summary["bodies"]["block"]["recycled"] > 50
    first, _ = run("first", "--save-state", "half.state", "--save-state-at", half, *control)
    rest, continued = run("rest", "--start-from", "half.state", "--save-state", "end.state", *control)
    assert first == whole
    assert rest == whole[-len(rest):] and len(rest) < len(whole)
    assert continued["bodies"]["block"]["recycled"] > 50
    assert (tmp_path / "end.state").read_bytes() == (tmp_path / "whole.state").read_bytes()


def test_too_many_are_refused(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(BLOCK.replace("step: 0.1 ms", "step: 0.1 ms, kept-solves: 5000"))
    buckens("check", "model.yaml").must(2, "model.yaml:10:", "kept-solves", "5000", "at most 1000")
