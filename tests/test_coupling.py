# SPDX-License-Identifier: Apache-2.0
"""Levels of inertial coupling as seen by a user: choice, cost, summary."""

import csv
import json
import pathlib

import numpy
import pytest

EXAMPLES = pathlib.Path(__file__).parents[1] / "examples"


@pytest.fixture
def run(buckens, tmp_path):
    """Runs a model with changed settings: columns of sensors.csv by name, and the summary."""

    def call(model, name="out", **settings):
        changes = [part for path, value in settings.items()
                   for part in ("--set", f"{path.replace('__', '.')}={value}")]
        result = buckens("run", model, "-o", name, *changes).must(0)
        with open(tmp_path / name / "sensors.csv", newline="") as file:
            rows = list(csv.reader(file))
        table = numpy.array(rows[1:], dtype=float)
        columns = {title.split(" [")[0]: table[:, k] for k, title in enumerate(rows[0])}
        return columns, json.loads((tmp_path / name / "summary.json").read_text()), result.out

    return call


def test_first_order_takes_one_solve_per_step(run):
    for level, most in [("first-order", 1.0), ("none", 1.0), ("full", 2.0)]:
        _, summary, out = run(EXAMPLES / "slider_crank" / "slider_crank.yaml",
                              bodies__rod__coupling=level, simulation__duration="20 ms")
        rod = summary["bodies"]["rod"]
        assert rod["coupling"] == level
        assert rod["factorisations"] == 1
        assert rod["solves"] <= most * summary["steps"]
        if most == 1.0:
            assert rod["solves"] == summary["steps"]
        assert level in out


def test_terms_are_dropped_by_name(run):
    model = EXAMPLES / "planar_levels" / "pendulum.yaml"
    by_name, summary, _ = run(model, "one", bodies__beam__coupling="nocent")
    assert summary["bodies"]["beam"]["coupling"] == "nocent"
    by_terms, _, _ = run(model, "two", bodies__beam__coupling="{drop: [cent0, cent1]}")
    assert numpy.array_equal(by_name["tip.x"], by_terms["tip.x"])
    _, summary, _ = run(model, "three", bodies__beam__coupling="{drop: [jvar, eul-fe]}")
    assert summary["bodies"]["beam"]["coupling"] == "drop jvar, eul-fe"
    assert summary["bodies"]["beam"]["largest_neglected_share"] > 1e-3


def test_slow_pendulum_stays_without_coupling(run, models):
    slow, summary, _ = run(models / "auto_beam.yaml")
    beam = summary["bodies"]["beam"]
    assert beam["coupling"] == "auto: none"
    assert beam["solves"] == summary["steps"]
    assert beam["largest_neglected_share"] < 0.01
    assert summary["notes"] == []
    full, _, _ = run(models / "auto_beam.yaml", "full", bodies__beam__coupling="full")
    # The tip swings by 5 mm; the neglected terms are (|w|/w1)^2 = 1e-8 of the size of the beam.
    assert numpy.ptp(full["tip.x"]) > 4e-3
    assert numpy.abs(slow["tip.x"] - full["tip.x"]).max() < 1e-6


def test_spinning_up_moves_up_and_stays_near_full(run, models):
    auto, summary, out = run(models / "spin_up.yaml")
    beam = summary["bodies"]["beam"]
    assert beam["coupling"].startswith("auto: none, then ")
    assert summary["notes"] and "coupling moved up at t = " in summary["notes"][0]
    assert "energy jumps by" in out and "angular momentum" in out
    full, _, _ = run(models / "spin_up.yaml", "full", bodies__beam__coupling="full")
    none, _, _ = run(models / "spin_up.yaml", "none", bodies__beam__coupling="none")
    distance = lambda a, b: numpy.hypot(a["tip.x"] - b["tip.x"], a["tip.y"] - b["tip.y"]).max()
    # Before its level moves up the beam lacks the stretch by centrifugal loads, which then sets in at once.
    assert distance(auto, full) < 0.3 * distance(none, full)


def test_free_body_that_spins_is_coupled_from_the_start(run):
    # |w|/w1 = 3/38: above 0.03 without support nothing may be neglected.
    _, summary, _ = run(EXAMPLES / "planar_levels" / "free_flight.yaml",
                        bodies__beam__coupling="{level: auto, tolerance: 50 %}")
    assert summary["bodies"]["beam"]["coupling"] == "auto: full"
    assert summary["notes"] == []


def test_summary_says_where_linear_elasticity_ends(run):
    _, summary, out = run(EXAMPLES / "planar_levels" / "pendulum.yaml")
    beam = summary["bodies"]["beam"]
    assert beam["spin_over_lowest_frequency"] > 0.1
    assert beam["largest_rotation_rad"] > 0.1
    assert beam["largest_axial_load_over_buckling_load"] > 0.05
    assert any("lowest elastic frequency" in text for text in summary["warnings"])
    for words in ("bends by up to", "of its buckling load"):
        assert any(words in reason for reason in summary["trust"])
    assert "body beam" in out and "|w|/w1" in out


def test_large_bodies_have_a_lowest_frequency_too(run, models):
    # Above 600 DOF it comes from Lanczos steps with the factor of the step.
    small, large = (run(models / "beam.yaml", f"n{n}", bodies__beam__beam__elements=n,
                        simulation__duration="5 ms")[1] for n in (100, 250))
    assert large["bodies"]["beam"]["dof"] > 600
    assert large["bodies"]["beam"]["factorisations"] == 1
    ratio = [s["bodies"]["beam"]["spin_over_lowest_frequency"] for s in (small, large)]
    assert ratio[1] == pytest.approx(ratio[0], rel=0.01)


SMOOTH = """
buckens: 1
title: A steel block is turned from rest to rest in a quarter of a second
materials: {steel: {E: 2.1e11 Pa, nu: 0.3, rho: 7850 kg/m^3}}
bodies:
  block:
    mesh:
      box: {from: [0, -25 mm, -25 mm], size: [0.5 m, 50 mm, 50 mm], divisions: [6, 1, 1], element: hex8}
      material: steel
    interfaces: {shaft: {face: x0}}
joints:
  axle: {revolute: {between: [ground, block/shaft], axis: [0, 0, 1]}}
  drive:
    prescribed-rotation:
      between: [ground, block/shaft]
      axis: [0, 0, 1]
      # The angle between two positions at rest, with three derivatives that begin and end at zero.
      angle: "(35*(4*t)^4 - 84*(4*t)^5 + 70*(4*t)^6 - 20*(4*t)^7) rad"
simulation: {duration: 0.25 s, step: 0.1 ms}
output:
  every: 5 ms
  sensors: {balance: {energy: balance}}
"""


def test_smooth_motion_takes_one_solve_per_step(run, tmp_path):
    (tmp_path / "smooth.yaml").write_text(SMOOTH)
    _, summary, _ = run("smooth.yaml")
    assert summary["bodies"]["block"]["coupling"] == "full"
    # At both ends the load grows from zero, in one step by as much as its own size.
    assert summary["measures"]["steps_with_repeated_solve"] < 0.2
