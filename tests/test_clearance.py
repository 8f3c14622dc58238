# SPDX-License-Identifier: Apache-2.0
"""Joints with clearance are contacts: a slide between two faces, a ball in a socket (a pin in a bore: test_contact.py)."""

import math

import numpy
import pytest

G = 9.81


def test_a_slide_with_clearance_tilts_until_it_jams(sensors):
    """A block of 100 mm x 40 mm between faces 40.2 mm apart, turned by a couple: two corners across touch."""
    out = sensors("""
buckens: 1
planar: xy
bodies: {block: {rigid: {mass: 1, inertia: [0, 0, 1e-3]}, at: {position: [0, 0, 0]}}}
loads:
  below: {contact: {between: [{ground: [0, -20.1 mm, 0]}, block], shapes: [{plane: [0, 1, 0]}, {box: [100 mm, 40 mm, 10 mm]}], stiffness: 1e8, damping: 2e3}}
  above: {contact: {between: [{ground: [0, 20.1 mm, 0]}, block], shapes: [{plane: [0, -1, 0]}, {box: [100 mm, 40 mm, 10 mm]}], stiffness: 1e8, damping: 2e3}}
  couple: {torque: {on: block, value: [0, 0, 5]}}
  push: {force: {on: block, value: [1, 0, 0]}}
simulation: {duration: 0.3 s, step: 20 us}
output: {every: 2 ms, sensors: {r: {rotation: block}, p: {position: block}, below: {contact: below}, above: {contact: above}}}
""")
    L, H, c = 0.1, 0.04, 0.0002
    turn = c / L
    for _ in range(20):  # L sin + H cos = H + c
        turn -= (L * math.sin(turn) + H * math.cos(turn) - H - c) / (L * math.cos(turn) - H * math.sin(turn))
    force = 5 / (L * math.cos(turn) - H * math.sin(turn))
    assert out["r.z"][-1] == pytest.approx(turn + 2 * force / 1e8 / L, rel=1e-3)
    assert out["below.normal"][-1] == pytest.approx(force, rel=1e-3)
    assert out["above.normal"][-1] == pytest.approx(force, rel=1e-3)
    assert out["p.x"][-1] == pytest.approx(0.5 * 0.3**2, rel=1e-3)  # it slides freely all the same


def test_a_ball_joint_with_clearance_hangs_lower_by_it(sensors):
    out = sensors("""
buckens: 1
gravity: [0, 0, -9.81]
bodies: {arm: {rigid: {mass: 2, com: [0, 0, -0.3], inertia: [0.02, 0.02, 0.002]}, markers: {ball: {position: [0, 0, 0]}}}}
loads: {joint: {contact: {between: [ground, arm/ball], shapes: [{socket: 10.1 mm}, {sphere: 10 mm}], stiffness: 1e7, damping: 3e3, static: 0.1}}}
initial: {bodies: {arm: {angular-velocity: [1, 0, 0.5]}}}
simulation: {duration: 0.5 s, step: 20 us}
output: {every: 1 ms, sensors: {p: {position: arm/ball}, c: {contact: joint}, balance: {energy: balance}}}
""")
    away = numpy.sqrt(out["p.x"]**2 + out["p.y"]**2 + out["p.z"]**2)
    late = out["t"] > 0.1
    # Swinging, it stays at the socket: off the centre by the clearance and what the contact gives.
    assert away[late] == pytest.approx(1e-4 + out["c.normal"][late] / 1e7, rel=0.03)
    assert numpy.abs(out["balance"]).max() < 1e-3
