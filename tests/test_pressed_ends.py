# SPDX-License-Identifier: Apache-2.0
"""Ends of beams that are pressed on something rigid with restitution: they come to rest there, and the account of a motor closes."""

import json

import numpy
import pytest

# A disc off its centre turns under a lever that a spring presses on it; the follower is the end of the lever.
FOLLOWER = """
buckens: 1
gravity: [0, 0, -9.81]
materials: {steel: {E: 210 GPa, nu: 0.3, rho: 7850, damping: {stiffness: 2e-5 s}}}
bodies:
  disc: {rigid: {mass: 1, inertia: [0.01, 0.01, 0.01]}}
  lever: {beam: {from: [-0.3, 0, 0.1], to: [0, 0, 0.1], elements: 6, section: {circle: {diameter: 10 mm}}, material: steel}FRAMES}
joints:
  shaft: {revolute: {between: [ground, disc/origin], axis: [0, 1, 0]}}
  root: {revolute: {between: [{ground: [-0.3, 0, 0.1]}, lever/start], axis: [0, 1, 0]}}
loads:
  cam: {cam: {between: [disc/origin, lever/end], normal: [0, 1, 0], closed: on, start: [120 mm, 0, 0], restitution: E,
              segments: [{arc: [-80 mm, 0, 0], through: [20 mm, 0, -100 mm]}, {arc: [120 mm, 0, 0], through: [20 mm, 0, 100 mm]}]}}
  drive: {hinge-motor: {joint: shaft, speed: 20, torque-limit: 3}}
  press: {hinge-spring: {joint: root, stiffness: 5, angle: 20 deg}}
simulation: {duration: 0.2 s, step: 0.1 ms}
output: {every: 2 ms, sensors: {x: {joint-coordinate: root}, push: {spring-force: cam}, kinetic: {energy: kinetic}, balance: {energy: balance}}}
"""


@pytest.mark.parametrize("frames", ["", ", frames: 3"])
def test_a_pressed_end_of_a_beam_comes_to_rest(sensors, tmp_path, frames):
    """With restitution it bounces a few times at the start, and then follows the cam as it does without."""
    found = {}
    for e in ("0", "0.3"):
        found[e] = sensors(FOLLOWER.replace("E,", f"{e},", 1).replace("FRAMES", frames))
        measures = json.loads((tmp_path / "out" / "summary.json").read_text())["measures"]
        # It was struck in nine of ten steps, 1784 times.
        assert measures["impacts"] < 150
        # Of 2.5 J; it was 0.1 J, whatever the step.
        assert numpy.abs(found[e]["balance"]).max() < 5e-3
    late = found["0"]["t"] > 0.1
    assert found["0.3"]["x.value"][late] == pytest.approx(found["0"]["x.value"][late], abs=1e-4)
    assert (found["0.3"]["push"][late] < 0).all()
