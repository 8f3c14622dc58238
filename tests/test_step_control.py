# SPDX-License-Identifier: Apache-2.0
"""Integration methods and step control, from the model file to the summary."""

import csv
import json
import math

import pytest

from elastic_crank import ELASTIC_CRANK

PENDULUM = """buckens: 1
gravity: [0, -9.81, 0]
planar: xy
bodies: {rod: {rigid: {mass: 1 kg, com: [0.5, 0, 0], inertia: [0, 0, 0.1]},
               markers: {pin: {position: [0, 0, 0]}, end: {position: [1, 0, 0]}}}}
joints: {pin: {revolute: {between: [ground, rod/pin]}}}
output: {every: 50 ms, sensors: {end: {position: rod/end}}}
simulation: {duration: 1 s, %s}
"""


@pytest.fixture
def run(buckens, tmp_path):
    def call(options, text=PENDULUM):
        (tmp_path / "model.yaml").write_text(text % options)
        return buckens("run", "model.yaml", "-o", tmp_path / "out")

    return call


def summary(tmp_path):
    return json.loads((tmp_path / "out" / "summary.json").read_text())


def end_position(tmp_path):
    with open(tmp_path / "out" / "sensors.csv") as file:
        rows = [row for row in csv.reader(file) if row and not row[0].startswith("#")]
    return [float(value) for value in rows[-1][1:3]]


@pytest.mark.parametrize("method", ["generalized-alpha", "newmark", "hht", "hht, alpha: -0.3",
                                    "wilson", "wilson, theta: 1.5"])
def test_every_method_reaches_the_same_end(run, tmp_path, method):
    run("step: 0.1 ms").must(0)
    exact = end_position(tmp_path)
    run(f"step: 1 ms, method: {method}").must(0)
    # Of the order (h omega)^2 with omega = 5/s, strongest for the most damped ones.
    assert end_position(tmp_path) == pytest.approx(exact, abs=2e-4)


def test_automatic_steps(run, tmp_path):
    result = run("step: auto, tolerance: 1e-6").must(0)
    assert "step sizes" in result.out
    control = summary(tmp_path)["step_control"]
    assert control["controlled"]
    assert 0 < control["smallest"] <= control["largest"] <= 0.01
    assert sum(size["steps"] for size in control["sizes"]) == summary(tmp_path)["steps"]


ELASTIC_ROD = ELASTIC_CRANK + """
output: {every: 10 ms, sensors: {end: {position: rod/end}}}
simulation: {duration: 0.5 s, %s}
"""


def test_an_elastic_rod_is_released_from_rest(run, tmp_path):
    """Undamped, between joints whose rounding moves it by more than its modes of the first steps.

    Step control gave up at 1.2e-6 s, with steps of 2e-10 s.
    """
    run("step: 5 us", ELASTIC_ROD).must(0)
    exact = end_position(tmp_path)
    run("step: 0.2 ms, tolerance: 1e-3", ELASTIC_ROD).must(0)
    # 2 pi/(omega h) = 2 pi/sqrt(1.2e-3) = 181 steps in each of 128 periods of the rod on two pins,
    # 257 Hz; its faster vibrations may take as many again.
    assert summary(tmp_path)["steps"] < 2 * 181 * 128
    assert end_position(tmp_path) == pytest.approx(exact, abs=0.4e-3)  # of 0.4 m
    assert summary(tmp_path)["trust"] == "ok"


def test_a_given_step_stays_fixed(run, tmp_path):
    result = run("step: 10 ms").must(0)
    assert "step sizes" not in result.out
    control = summary(tmp_path)["step_control"]
    assert not control["controlled"] and control["smallest"] == control["largest"] == 0.01


def test_a_jump_of_a_drive_names_the_law(run):
    text = PENDULUM.replace("joints: {", 'joints: {motor: {prescribed-rotation: {between: '
                            '[ground, rod/pin], angle: "t < 0.503 ? t : t + 0.3"}}, ')
    run("step: 1 ms", text).must(4, "model.yaml:6", '"motor"', "t < 0.503", "jumps")


def test_changed_velocities_are_told(run, tmp_path):
    text = PENDULUM + "initial: {bodies: {rod: {velocity: [0, 1, 0]}}}\n"
    run("step: 1 ms", text).must(0)
    assert any('"rod" cannot start' in warning for warning in summary(tmp_path)["warnings"])


@pytest.mark.parametrize("step", ["5 ms, tolerance: 1e-5", "1.25 ms"])
def test_steps_that_hit_a_dead_centre_go_on(buckens, tmp_path, models, step):
    """Three parallel cranks at 180 degrees, at t = 0.46625 s: a multiple of both steps.

    There two equations of the pins hold nothing; the motion carries the cranks through.
    """
    text = (models / "parallel_cranks.yaml").read_text()
    (tmp_path / "model.yaml").write_text(text.replace("step: 5 ms", f"step: {step}"))
    buckens("run", "model.yaml", "-o", tmp_path / "out").must(0)
    assert summary(tmp_path)["trust"] == "ok"
    with open(tmp_path / "out" / "sensors.csv") as file:
        rows = [row for row in csv.reader(file) if row and row[0][0].isdigit()]
    assert float(rows[-1][0]) == pytest.approx(2.2)
    for row in rows:  # the third crank is parallel to the driven one
        assert float(row[1]) == pytest.approx(math.radians(320 * float(row[0])), abs=1e-12)
