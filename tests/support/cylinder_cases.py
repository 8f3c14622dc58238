# SPDX-License-Identifier: Apache-2.0
"""A cylinder b on a first shape, and free collisions of two bodies: models that tests of several first shapes share."""

import math

import numpy
import pytest

G = 9.81
DRUM = "{cylinder: {radius: 0.1, length: 0.2}}"
LOG = "{cylinder: {radius: 0.1, length: 0.3, axis: [0, 1, 0]}}"
ROLLS = "0.02, 0.01, 0.02"  # its inertia about y is half m R^2
SENSORS = "p: {position: b}, v: {velocity: b}, w: {angular-velocity: b}, c: {contact: c}, lost: {energy: dissipated}, balance: {energy: balance}"
STATE = ("p.x", "p.y", "p.z", "v.x", "v.y", "v.z", "w.x", "w.y", "w.z")


def columns(out, name):
    return numpy.stack([out[f"{name}.{axis}"] for axis in "xyz"], axis=1)


def model(shapes, law, at="0, 0, 0.1", turned="", velocity="0, 0, 0", spin="0, 0, 0", inertia="0.02, 0.02, 0.01", gravity=(0, 0, -G), under=0.5,
          duration="1 s", step="1 ms", every="20 ms", start="", push=""):
    """@param under how far the middle of the first shape lies below the ground"""
    return f"""
buckens: 1
gravity: [{gravity[0]!r}, {gravity[1]!r}, {gravity[2]!r}]
bodies: {{b: {{rigid: {{mass: 2 kg, inertia: [{inertia}]}}, at: {{position: [{at}]{turned}}}}}}}
loads:
  c: {{contact: {{between: [{{ground: [0, 0, {-under}]}}, b], shapes: [{shapes}], {law}}}}}
{push}
initial: {{{start}bodies: {{b: {{velocity: [{velocity}], angular-velocity: [{spin}]}}}}}}
simulation: {{duration: {duration}, step: {step}}}
output: {{every: {every}, sensors: {{{SENSORS}}}}}
"""


SLOPE = (G / 2, 0, -G * math.sqrt(3) / 2)
# Shape, law and what else of motions on a plane.
ON_PLANE = {
    "stands": (DRUM, "static: 0.5", {}),
    "slides": (DRUM, "static: 0.3", {"gravity": SLOPE}),
    "sticks": (DRUM, "static: 0.7", {"gravity": SLOPE}),
    "rolls": (LOG, "static: 0.4", {"gravity": SLOPE, "inertia": ROLLS}),
    "slips": (LOG, "static: 0.19", {"gravity": SLOPE, "inertia": ROLLS}),
    "falls-flat": (DRUM, "static: 0.4, restitution: 0.5", {"at": "0, 0, 0.4", "velocity": "0.3, 0.2, 0"}),
    "falls-on-side": (LOG, "static: 0.4, restitution: 0.5", {"at": "0, 0, 0.4", "inertia": ROLLS}),
    "leans": (DRUM, "static: 0.6", {"at": "0, 0, 0.2", "turned": ", orientation: {axis: [0, 1, 0], angle: 70 deg}", "velocity": "0, 1, 0",
                                    "spin": "0, 0, -6", "duration": "0.3 s"}),
}


def check_moves_as_on_a_plane(name, face, plane):
    for column in (*STATE, "c.normal", "c.friction", "lost"):
        # Residuals of steps, 1e-10 of what acts, summed up over a second.
        assert face[column] == pytest.approx(plane[column], abs=1e-9, rel=1e-9), column
    assert numpy.abs(face["balance"]).max() < 1e-3 * max(face["lost"][-1], 1e-3)
    if name == "rolls":
        assert face["p.x"] == pytest.approx(G / 6 * face["t"] ** 2, abs=1e-9)
    if name == "slides":
        assert face["p.x"] == pytest.approx((0.5 - 0.15 * math.sqrt(3)) * G / 2 * face["t"] ** 2, abs=1e-9)


def free_collision(shapes, chance):
    """Two bodies that meet in space, turned and spinning at random, half of them with friction."""

    def vector(size):
        return [chance.uniform(-size, size) for _ in range(3)]

    friction = chance.choice([0, 0.3])
    turns = {one: (vector(1), chance.uniform(0, 3)) for one in "ab"}
    return f"""
buckens: 1
bodies:
  a: {{rigid: {{mass: 3 kg, inertia: [0.04, 0.04, 0.04]}}, at: {{position: [0, 0, 0], orientation: {{axis: {turns["a"][0]}, angle: {turns["a"][1]}}}}}}}
  b: {{rigid: {{mass: 2 kg, inertia: [0.02, 0.02, 0.02]}}, at: {{position: [0.7, {chance.uniform(-0.1, 0.1)}, {chance.uniform(-0.1, 0.1)}], orientation: {{axis: {turns["b"][0]}, angle: {turns["b"][1]}}}}}}}
loads: {{c: {{contact: {{between: [a, b], shapes: [{shapes}], restitution: 0.6, static: {friction}}}}}}}
initial: {{bodies: {{a: {{velocity: [1, 0, 0], angular-velocity: {vector(3)}}}, b: {{velocity: [-2, 0, 0], angular-velocity: {vector(3)}}}}}}}
simulation: {{duration: 0.3 s, step: 0.5 ms}}
output:
  every: 5 ms
  sensors: {{pa: {{position: a}}, pb: {{position: b}}, va: {{velocity: a}}, vb: {{velocity: b}}, wa: {{angular-velocity: a}}, wb: {{angular-velocity: b}}, lost: {{energy: dissipated}}, balance: {{energy: balance}}}}
"""


def check_free_collision(out):
    """Momentum, linear and angular, is kept, and the account closes."""
    linear = 3 * columns(out, "va") + 2 * columns(out, "vb")
    assert linear == pytest.approx(numpy.tile([-1.0, 0, 0], (len(linear), 1)), abs=1e-11)
    angular = sum(m * numpy.cross(columns(out, f"p{one}"), columns(out, f"v{one}")) + inertia * columns(out, f"w{one}")
                  for one, m, inertia in (("a", 3, 0.04), ("b", 2, 0.02)))
    # The rest of a step goes on with the new velocities: h P times the slip, 5e-4 of some 5 N s and 1 m/s, is the bound.
    assert angular == pytest.approx(numpy.tile(angular[0], (len(angular), 1)), abs=1e-4)
    assert out["lost"][-1] > 0.1
    # Errors of first order in the step, where they strike.
    assert numpy.abs(out["balance"]).max() < 5e-3 * out["lost"][-1]
