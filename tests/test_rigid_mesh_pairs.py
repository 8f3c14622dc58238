# SPDX-License-Identifier: Apache-2.0
"""Rigid contact of surfaces of triangles with each other and with boxes: what boxes do, and solids that are not convex."""

import math
import pathlib
import random
import sys

import numpy
import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent / "support"))

import triangle_meshes  # noqa: E402

G = 9.81
PART = "{stl: {file: part.stl, unit: 1 m}}"
BASE = "{stl: {file: base.stl, unit: 1 m}}"
BRICK = "rigid: {mass: 2 kg, inertia: [0.0217, 0.0333, 0.0417]}"  # 0.4 x 0.3 x 0.2
SENSORS = ("p: {position: b}, v: {velocity: b}, w: {angular-velocity: b}, c: {contact: c}, lost: {energy: dissipated}, "
           "balance: {energy: balance}")


def model(shapes, law="", body=BRICK, at="0, 0, 0.1", velocity="0, 0, 0", spin="0, 0, 0", gravity=(0, 0, -G), duration="1 s", step="1 ms",
          every="20 ms", first="{ground: [0, 0, -0.1]}", start=""):
    return f"""
buckens: 1
gravity: [{gravity[0]!r}, {gravity[1]!r}, {gravity[2]!r}]
bodies: {{b: {{{body}, at: {{position: [{at}]}}}}}}
loads: {{c: {{contact: {{between: [{first}, b], shapes: [{shapes}]{law}}}}}}}
initial: {{{start}bodies: {{b: {{velocity: [{velocity}], angular-velocity: [{spin}]}}}}}}
simulation: {{duration: {duration}, step: {step}}}
output: {{every: {every}, sensors: {{{SENSORS}}}}}
"""


def write(tmp_path, **meshes):
    for name, mesh in meshes.items():
        triangle_meshes.write_stl(tmp_path / f"{name}.stl", *mesh, text=True)


def join(*parts):
    """@param parts meshes and where they are"""
    points, triangles = [], []
    for (own, cells), at in parts:
        triangles += [tuple(len(points) + k for k in cell) for cell in cells]
        points += list(numpy.asarray(own) + at)
    return numpy.array(points), triangles


# On a table 0.2 thick, whose top is at z = 0: 12, 48 and 972 triangles.
TABLE = [3.0, 2.0, 0.2]
SHAPES = [(BASE, PART), (BASE, "{box: [0.4, 0.3, 0.2]}"), ("{box: [3, 2, 0.2]}", PART)]


@pytest.mark.parametrize("shapes", SHAPES, ids=["meshes", "mesh-box", "box-mesh"])
@pytest.mark.parametrize("cells", [1, 2, 9])
def test_a_box_of_triangles_slides_and_sticks_on_another(sensors, tmp_path, cells, shapes):
    write(tmp_path, part=triangle_meshes.box([0.4, 0.3, 0.2], cells), base=triangle_meshes.box(TABLE, cells))
    slope = (G / 2, 0, -G * math.sqrt(3) / 2)
    out = sensors(model(", ".join(shapes), ", static: 0.3", gravity=slope, step="2 ms", duration="0.6 s"))
    a = G / 2 - 0.3 * G * math.sqrt(3) / 2
    assert out["p.x"] == pytest.approx(0.5 * a * out["t"] ** 2, abs=1e-12)
    assert out["p.z"] == pytest.approx(0.1, abs=1e-14)
    assert out["c.normal"][1:] == pytest.approx(G * math.sqrt(3), rel=1e-9)
    assert numpy.abs(out["balance"]).max() < 1e-11
    out = sensors(model(", ".join(shapes), ", static: 0.7", gravity=slope, step="2 ms", duration="0.6 s"))
    assert numpy.abs(out["p.x"]).max() < 1e-15 and numpy.abs(out["v.x"]).max() < 1e-14
    assert out["c.friction"][1:] == pytest.approx(G, rel=1e-9)


@pytest.mark.parametrize("cells", [1, 2, 9])
def test_it_tumbles_as_a_box_on_a_plane_does(sensors, tmp_path, cells):
    """Only corners of the box strike, which is far from the borders of the table: the same places, the same rows."""
    write(tmp_path, part=triangle_meshes.box([0.4, 0.3, 0.2], cells), base=triangle_meshes.box(TABLE, cells))
    fall = {"at": "0, 0, 0.5", "velocity": "1, -0.5, 0", "spin": "2, 3, 1", "law": ", restitution: 0.5, static: 0.5", "duration": "0.8 s"}
    plane = sensors(model("{plane: {}}, {box: [0.4, 0.3, 0.2]}", first="ground", **fall))
    assert plane["lost"][-1] > 5 and numpy.ptp(plane["p.y"]) > 0.1
    for shapes in SHAPES:
        out = sensors(model(", ".join(shapes), **fall))
        for name in ("p.x", "p.y", "p.z", "v.x", "w.x", "w.y", "w.z"):
            # The same rows among others that are open: rounding, which blows of a tumbling body enlarge.
            assert out[name] == pytest.approx(plane[name], abs=1e-9), name


@pytest.mark.parametrize("cells", [1, 5])
@pytest.mark.parametrize("shift", [0, 0.0003, 0.05])
def test_a_cube_falls_on_a_cube(sensors, tmp_path, cells, shift):
    """Flat on its face, flush or not: it loses m g h (1 - e^2) at the first blow and rests on the other one in the end."""
    cube = "rigid: {mass: 2 kg, inertia: [0.0133, 0.0133, 0.0133]}"
    write(tmp_path, part=triangle_meshes.box([0.2, 0.2, 0.2], cells), base=triangle_meshes.box([0.2, 0.2, 0.2], cells))
    out = sensors(model(f"{BASE}, {PART}", ", restitution: 0.5, static: 0.3", body=cube, at=f"{shift}, 0, 0.4", duration="0.45 s", every="1 ms"))
    first = math.sqrt(2 * 0.3 / G)
    since = out["t"][out["t"] > first + 1e-3] - first
    assert out["lost"][-1] == pytest.approx(2 * G * 0.3 * (1 - 0.5**2), rel=1e-12)
    assert out["p.z"][-len(since):] == pytest.approx(0.1 + 0.5 * G * first * since - G / 2 * since**2, abs=1e-12)
    assert numpy.abs(out["w.x"]).max() < 1e-9 and numpy.abs(out["balance"]).max() < 1e-12
    out = sensors(model(f"{BASE}, {PART}", ", restitution: 0.2, static: 0.3", body=cube, at=f"{shift}, 0, 0.2", duration="1 s"))
    rests = out["t"] > 0.8
    assert out["p.z"][rests] == pytest.approx(0.1, abs=1e-9)
    assert out["c.normal"][rests] == pytest.approx(2 * G, rel=1e-9)
    assert max(numpy.abs(out[f"v.{axis}"][rests]).max() for axis in "xyz") < 1e-6
