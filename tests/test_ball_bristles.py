# SPDX-License-Identifier: Apache-2.0
"""Bristles of a ball joint: about one axis those of a hinge, about all of them without creep, and as stiff springs."""

import json
import math

import numpy
import pytest

from test_friction_settles import BALLS

# A top that stands on its ball, twisted about the vertical: 20 N press, so that 0.2 x 20 mm x 20 N = 0.08 N m hold.
TOP = """
buckens: 1
gravity: [0, 0, -10]
bodies: {top: {rigid: {mass: 2 kg, inertia: [0.1, 0.1, 0.02]}}}
joints: {ball: {JOINT}}
loads:
  rub: {FRICTION, stick: bristles, bristle-stiffness: 400 N m/rad, bristle-damping: 0.5 N m s/rad, elastic-share: SHARE}}
  twist: {torque: {on: top, value: [0, 0, "0.2*sin(40*t) N m"]}}
simulation: {duration: 1 s, step: 0.5 ms}
output: {every: 5 ms, sensors: {r: {rotation: top}, w: {angular-velocity: top}, rub: {spring-torque: rub}, balance: {energy: balance}, lost: {energy: dissipated}}}
"""


@pytest.mark.parametrize("share", [0, 0.9])
def test_about_one_axis_they_are_those_of_a_hinge(sensors, share):
    ball = sensors(TOP.replace("SHARE", str(share)).replace("JOINT", "spherical: {between: [ground, top]}")
                   .replace("FRICTION", "ball-friction: {joint: ball, static: 0.2, radius: 20 mm"))
    hinge = sensors(TOP.replace("SHARE", str(share)).replace("JOINT", "revolute: {between: [ground, top], axis: [0, 0, 1]}")
                    .replace("FRICTION", "hinge-friction: {joint: ball, static: 0.2, axial-radius: 20 mm"))
    assert numpy.abs(hinge["w.z"]).max() > 0.05 and (hinge["w.z"][1:] * hinge["w.z"][:-1] < 0).sum() > 8
    # Both iterate to 1e-10 of the motion in a step.
    assert ball["r.z"] == pytest.approx(hinge["r.z"], abs=1e-9)
    assert ball["w.z"] == pytest.approx(hinge["w.z"], abs=1e-7)
    assert ball["lost"] == pytest.approx(hinge["lost"], abs=1e-8)
    assert numpy.abs(ball["r.x"]).max() < 1e-12


@pytest.mark.parametrize("share", [0, 0.9])
def test_they_do_not_creep_unless_asked_to(sensors, share):
    """A constant torque about x and one that goes to and fro about y: together 0.89 of what holds at most."""
    text = TOP.replace("SHARE", str(share)).replace("JOINT", "spherical: {between: [ground, top]}").replace(
        "FRICTION", "ball-friction: {joint: ball, static: 0.2, radius: 20 mm").replace(
        '[0, 0, "0.2*sin(40*t) N m"]', '[0.055, "0.045*sin(40*t) N m", 0]').replace("duration: 1 s", "duration: 4 s")
    out = sensors(text)
    late = out["t"] > 2
    moved = abs(out["r.x"][late][-1] - out["r.x"][late][0])
    assert moved < 1e-9 if share else moved > 1e-5
    assert numpy.hypot(out["rub.x"], out["rub.y"]).max() < 0.08


def test_stiff_bristles_slide_as_springs_that_break_away(sensors, tmp_path):
    """Two arms on balls whose direction of sliding turns; friction by stiff springs has a test of its own."""
    springs = sensors(BALLS)
    text = BALLS
    for name, slip in (("radius: 10 mm", 1e-5), ("radius: 8 mm", 1e-5)):
        # The bounds are some 0.03 N m.
        text = text.replace(name, f"{name}, stick: bristles, bristle-stiffness: {0.03 / slip} N m/rad, bristle-damping: 0.2 N m s/rad")
    bristles = sensors(text)
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["step_control"]["failed"] == 0
    assert abs(bristles["balance"]).max() < 2e-3 * bristles["lost"][-1]
    # Where it sticks in between, one by a spring of the instant's bound and the other by constant bristles.
    assert bristles["lost"] == pytest.approx(springs["lost"], abs=5e-3 * springs["lost"][-1])
    assert springs["lost"][-1] > 0.1


def test_frozen_they_hold_at_rest(sensors):
    text = TOP.replace("SHARE", "0.9").replace("JOINT", "spherical: {between: [ground, top]}").replace(
        "FRICTION", "ball-friction: {joint: ball, static: 0.2, radius: 20 mm").replace(
        '[0, 0, "0.2*sin(40*t) N m"]', "[0.03, 0.04, 0.02]")
    out = sensors(text.replace("simulation:", "initial: {start: static, friction: frozen}\nsimulation:"))
    assert numpy.abs(out["r.z"]).max() < math.radians(0.05)


@pytest.mark.parametrize("joint, stick, words", [
    ("spherical: {between: [ground, top]}", "rigid", ["a ball sticks by a stiff spring or by bristles"]),
    ("universal: {between: [ground, top], axis: [1, 0, 0], second-axis: [0, 1, 0]}", "bristles", ["`hinge-friction`", "`second-angle`"]),
])
def test_what_there_is_not_is_told(buckens, tmp_path, joint, stick, words):
    text = TOP.replace("SHARE", "0.9").replace("JOINT", joint).replace("FRICTION", "ball-friction: {joint: ball, static: 0.2, radius: 20 mm")
    (tmp_path / "model.yaml").write_text(text.replace("stick: bristles", f"stick: {stick}"))
    buckens("check", "model.yaml").must(2, "model.yaml:7:", *words)
