# SPDX-License-Identifier: Apache-2.0
"""Boxes that lie on boxes: areas, stacks, friction on a tilted face, in space and in the plane."""

import math

import numpy
import pytest

G = 9.81
BLOCK = "rigid: {mass: 2 kg, inertia: [8.333e-3, 8.333e-3, 1.333e-2]}"
TABLE = "{ground: [0, 0, -0.5]}"
SIZE, FACE = "[0.2, 0.2, 0.1]", (0.2 * 0.2 + 2 * 0.2 * 0.1) / 3


def on_table(gravity, law, moved=(0, 0), turn=0, extra=""):
    sunk = 0.05 - 2 * -gravity[2] / (4 * 1e6 * 0.04 / FACE)
    return f"""
buckens: 1
gravity: [{gravity[0]}, {gravity[1]}, {gravity[2]}]
bodies: {{block: {{{BLOCK}, at: {{position: [{moved[0]}, {moved[1]}, {sunk}], orientation: {{axis: [0, 0, 1], angle: {turn} deg}}}}}}}}
loads: {{c: {{contact: {{between: [{TABLE}, block], shapes: [{{box: [2, 2, 1]}}, {{box: {SIZE}}}], stiffness: 1e6, damping: 1e3{law}}}}}}}
simulation: {{duration: 1 s, step: 1 ms}}
output: {{every: 20 ms, sensors: {{p: {{position: block}}, v: {{velocity: block}}, w: {{angular-velocity: block}}, c: {{contact: c}}, balance: {{energy: balance}}, lost: {{energy: dissipated}}}}}}
{extra}"""


@pytest.mark.parametrize("turn", [0, 30, 45])
def test_a_box_lies_still_on_a_box(sensors, turn):
    out = sensors(on_table((0, 0, -G), "", turn=turn))
    # Started at its equilibrium: the area is 0.04 m^2, the mean face 0.02667.
    assert numpy.abs(out["p.z"] - out["p.z"][0]).max() < 1e-13
    assert out["c.normal"] == pytest.approx(2 * G, rel=1e-9)
    assert numpy.abs(out["p.x"]).max() < 1e-13 and numpy.abs(out["w.z"]).max() < 1e-11


def test_friction_holds_a_box_on_a_tilted_face_up_to_its_bound(sensors):
    angle = math.radians(20)
    gravity = (G * math.sin(angle), 0, -G * math.cos(angle))
    hold, slide = 1.01 * math.tan(angle), 0.8 * math.tan(angle)
    out = sensors(on_table(gravity, f", static: {hold}"))
    late = out["t"] > 0.49
    assert numpy.abs(out["p.x"][late] - out["p.x"][late][0]).max() < 1e-9  # it does not creep
    assert out["c.friction"][-1] == pytest.approx(2 * G * math.sin(angle), rel=1e-6)
    out = sensors(on_table(gravity, f", static: {slide}", moved=(-0.5, 0.1), turn=20))
    late = out["t"] > 0.49
    a = numpy.polyfit(out["t"][late], out["v.x"][late], 1)[0]
    assert a == pytest.approx(0.2 * G * math.sin(angle), rel=1e-4)
    assert numpy.abs(out["balance"]).max() < 1e-3 * out["lost"][-1]


def test_five_boxes_stand_on_each_other(sensors):
    """Equal boxes, edge upon edge, as a group: each carries those above, and nothing moves."""
    sunk = [m * G / (4 * 1e6 * 0.04 / FACE) for m in (10, 8, 6, 4, 2)]
    height = 0
    bodies = ""
    for k in range(5):
        height += (0.05 if k == 0 else 0.1) - sunk[k]
        bodies += f"  box{k}: {{{BLOCK}, at: {{position: [0, 0, {height!r}]}}}}\n"
    out = sensors(f"""
buckens: 1
gravity: [0, 0, -{G}]
bodies:
{bodies}loads: {{c: {{contacts: {{among: [{{on: {TABLE}, box: [2, 2, 1]}}, {{bodies: "box*", box: {SIZE}}}], stiffness: 1e6, damping: 1e3, static: 0.5}}}}}}
simulation: {{duration: 1 s, step: 1 ms}}
output: {{every: 20 ms, sensors: {{top: {{position: box4}}, turned: {{rotation: box4}}, c: {{contact: c}}}}}}
""")
    assert numpy.abs(out["top.z"] - height).max() < 1e-10
    assert numpy.abs(out["top.x"]).max() < 1e-10
    assert out["c.normal"][-1] == pytest.approx((10 + 8 + 6 + 4 + 2) * G, rel=1e-7)
    assert out["c.touching"][-1] == 5


def test_a_box_topples_where_its_edge_ends(sensors):
    """A box half over the edge of a table stays; with its mass centre beyond, it falls."""
    text = on_table((0, 0, -G), ", static: 0.6").replace("duration: 1 s", "duration: 0.4 s")
    stays = sensors(text.replace("position: [0, 0,", "position: [0.97, 0,"))
    assert stays["p.z"][-1] > 0.0499
    falls = sensors(text.replace("position: [0, 0,", "position: [1.03, 0,"))
    assert falls["p.z"][-1] < 0 and falls["w.y"].max() > 1


def test_boxes_of_planar_models_are_rectangles(sensors):
    out = sensors(f"""
buckens: 1
planar: xy
gravity: [0, -{G}, 0]
bodies:
  block: {{rigid: {{mass: 2 kg, inertia: [0, 0, 1e-2]}}, at: {{position: [0.1, 0.0502, 0]}}}}
loads: {{c: {{contact: {{between: [{{ground: [0, -0.5, 0]}}, block], shapes: [{{box: [2, 1, 1]}}, {{box: [0.2, 0.1, 0.1]}}], stiffness: 1e6, damping: 2e3, static: 0.5}}}}}}
simulation: {{duration: 0.5 s, step: 1 ms}}
output: {{every: 20 ms, sensors: {{p: {{position: block}}, c: {{contact: c}}}}}}
""")
    # Mean of both faces in the plane, 0.15 wide; it lies on one of 0.2.
    assert out["p.y"][-1] == pytest.approx(0.05 - 2 * G / (4e6 * 0.2 / 0.15), abs=1e-9)
    assert out["c.normal"][-1] == pytest.approx(2 * G, rel=1e-6)
