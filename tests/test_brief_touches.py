# SPDX-License-Identifier: Apache-2.0
"""Elastic stops and contacts that steps do not resolve create or destroy energy: runs say so, with the step that would do."""

import json
import math
import re

import pytest

T = 2 * math.pi * math.sqrt(1 / 4e4)  # of the mass on a spring [s]

STOPS = """
buckens: 1
bodies: {block: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}}}
joints: {way: {prismatic: {between: [ground, block], axis: [1, 0, 0]}}}
loads: {ends: {slide-stop: {joint: way, from: -0.05, to: 0.05, stiffness: 4e4}}}
initial: {bodies: {block: {velocity: [2, 0, 0]}}}
simulation: {duration: DURATION s, step: STEP sMETHOD}
output: {every: EVERY s, sensors: {all: {energy: total}}}
"""

BALL = """
buckens: 1
gravity: [0, 0, -9.81]
bodies: {ball: {rigid: {mass: 1 kg, inertia: [1e-3, 1e-3, 1e-3]}, at: {position: [0, 0, 0.3]}}}
loads: {floor: {contact: {between: [ground, ball], shapes: [{plane: {}}, {sphere: 0.1}], LAW}}}
simulation: {duration: 1 s, step: STEP sMETHOD}
output: {every: 10 ms, sensors: {z: {position: ball}}}
"""

METHODS = ["", ", method: newmark", ", method: hht", ", method: wilson"]


def run(buckens, tmp_path, text):
    (tmp_path / "model.yaml").write_text(text)
    buckens("run", "model.yaml", "-o", "out").must(0)
    return json.loads((tmp_path / "out" / "summary.json").read_text())


def stops(buckens, tmp_path, steps_per_period, method):
    """Some 20 touches."""
    step = T / steps_per_period
    return run(buckens, tmp_path, STOPS.replace("DURATION", f"{round(1.2 / step) * step:.12g}").replace("STEP", f"{step:.12g}")
               .replace("METHOD", method).replace("EVERY", f"{step:.12g}"))


def warnings(summary):
    return [text for text in summary["warnings"] if "touches" in text]


@pytest.mark.parametrize("method", METHODS)
def test_brief_touches_are_named_with_a_step_that_does(buckens, tmp_path, method):
    told = stops(buckens, tmp_path, 3, method)
    (text,) = warnings(told)
    assert text.startswith('load "ends": ')
    step = float(re.search(r"a step of (\S+) s at most", text)[1])
    # A touch lasts T/2, which is a step and a half: ends of one step or two lie in it.
    assert step == pytest.approx(T / 40, rel=0.5)
    (tmp_path / "out").rename(tmp_path / "coarse")
    told = stops(buckens, tmp_path, T / step, method)
    assert warnings(told) == []


@pytest.mark.parametrize("law, lasting", [
    ("stiffness: 1e5", math.pi * math.sqrt(1 / 1e5)),
    ("stiffness: 1e5, restitution: 0.8", math.pi * math.sqrt(1 / 1e5)),
    # Hertz: 2.94 deepest/speed.
    ("stiffness: 1e7, exponent: 1.5", 2.94 * (2.5 * 9.81 * 0.2 / 1e7) ** 0.4 / math.sqrt(2 * 9.81 * 0.2)),
])
@pytest.mark.parametrize("method", METHODS[:2])
def test_a_bouncing_ball(buckens, tmp_path, method, law, lasting):
    def told(step):
        return warnings(run(buckens, tmp_path, BALL.replace("LAW", law).replace("STEP", f"{step:.6g}").replace("METHOD", method)))

    (text,) = told(lasting / 1.5)
    assert '"floor"' in text
    (tmp_path / "out").rename(tmp_path / "coarse")
    assert told(lasting / 15) == []


def test_touches_are_counted_over_a_pause(buckens, tmp_path):
    text = STOPS.replace("DURATION", "0.6").replace("STEP", "10e-3").replace("METHOD", "").replace("EVERY", "0.01")
    told = run(buckens, tmp_path, text)
    buckens("run", "model.yaml", "-o", "half", "--save-state", "half.state", "--save-state-at", "0.3").must(0)
    buckens("run", "model.yaml", "-o", "rest", "--start-from", "half.state").must(0)
    assert warnings(told) and warnings(json.loads((tmp_path / "rest" / "summary.json").read_text())) == warnings(told)
