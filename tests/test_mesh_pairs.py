# SPDX-License-Identifier: Apache-2.0
"""Surfaces of triangles that touch each other, and cylinders on them."""

import math
import pathlib
import sys

import numpy
import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent / "support"))

import triangle_meshes  # noqa: E402

G = 9.81
SIDE, MASS, STIFFNESS = 0.2, 2.0, 1e6
CUBE = "rigid: {mass: 2 kg, inertia: [0.0133333333, 0.0133333333, 0.0133333333]}"
BLOCK = "{stl: {file: block.stl, unit: 1 m}}"
TABLE = "{stl: {file: table.stl, unit: 1 m}}"


@pytest.fixture
def shapes(tmp_path):
    """A cube, and a table whose top is the plane z = 0."""
    triangle_meshes.write_stl(tmp_path / "block.stl", *triangle_meshes.box([SIDE] * 3), text=True)
    points, triangles = triangle_meshes.box([1.0, 1.0, 0.2])
    triangle_meshes.write_stl(tmp_path / "table.stl", points - numpy.array([0, 0, 0.1]), triangles, text=True)


def cube_on_table(law, tilt=0.0, torque=0.0, spin=0.0, height=0.5 * SIDE, duration="0.5 s", step="1 ms"):
    gravity = (G * math.sin(tilt), 0, -G * math.cos(tilt))
    return f"""
buckens: 1
gravity: [{gravity[0]!r}, 0, {gravity[2]!r}]
bodies: {{block: {{{CUBE}, at: {{position: [0.05, 0.02, {height!r}]}}}}}}
loads:
  c: {{contact: {{between: [ground, block], shapes: [{TABLE}, {BLOCK}], stiffness: {STIFFNESS}, {law}}}}}
  turn: {{torque: {{on: block, value: [0, {torque!r}, 0]}}}}
initial: {{bodies: {{block: {{angular-velocity: [0, 0, {spin!r}]}}}}}}
simulation: {{duration: {duration}, step: {step}}}
output: {{every: 10 ms, sensors: {{p: {{position: block}}, r: {{rotation: block}}, w: {{angular-velocity: block}}, c: {{contact: c}}, balance: {{energy: balance}}}}}}
"""


def test_a_cube_rests_on_a_table(sensors, shapes):
    out = sensors(cube_on_table("damping: 1e3", torque=0.3))
    # Four quarters of the face, as between boxes; tilted by 2e-5 rad its middle is lower by 2e-11 m.
    assert out["p.z"][-1] == pytest.approx(0.5 * SIDE - MASS * G / (4 * STIFFNESS), abs=1e-10)
    # Springs at points, the outermost at the edges, resist a tilt by a little more than springs spread evenly.
    evenly = 0.3 / (4 * STIFFNESS * SIDE**2 / 12 - MASS * G * 0.5 * SIDE)
    assert 0.95 * evenly < out["r.y"][-1] < evenly
    assert out["c.normal"][-1] == pytest.approx(MASS * G, rel=1e-9)


def test_a_cube_sticks_and_slides_on_an_inclined_table(sensors, shapes):
    tilt = math.radians(20)
    hold = sensors(cube_on_table(f"damping: 1e3, static: {1.01 * math.tan(tilt)!r}", tilt))
    late = hold["t"] > 0.29
    assert numpy.abs(hold["p.x"][late] - hold["p.x"][late][0]).max() < 1e-9
    slide = sensors(cube_on_table(f"damping: 1e3, static: {0.8 * math.tan(tilt)!r}", tilt))
    late = slide["t"] > 0.2
    a = 2 * numpy.polyfit(slide["t"][late], slide["p.x"][late], 2)[0]
    assert a == pytest.approx(0.2 * G * math.sin(tilt), rel=1e-3)


def test_friction_stops_a_spinning_cube(sensors, shapes):
    """Three places in the distance that the face's spread has stand for it."""
    out = sensors(cube_on_table("damping: 1e3, static: 0.3", spin=8.0, duration="0.3 s", step="2 ms"))
    radius = SIDE / math.sqrt(6)
    spread = MASS * SIDE**2 / 6
    late = (out["t"] > 0.05) & (out["t"] < 0.18)
    slope = numpy.polyfit(out["t"][late], out["w.z"][late], 1)[0]
    # The points' distance makes the spread of the face a little larger.
    assert slope == pytest.approx(-0.3 * MASS * G * radius / spread, rel=0.03)
    assert abs(out["w.z"][-1]) < 1e-6


def test_a_thrown_cube_keeps_its_energy(sensors, shapes):
    """It strikes with corners and edges, without a loss: what is left falls with the square of the step."""
    worst = []
    for step in (200, 50):
        text = cube_on_table("restitution: 1", height=0.3, duration="0.4 s", step=f"{step} us")
        text = text.replace("position: [0.05, 0.02, 0.3]", "position: [0.05, 0.02, 0.3], orientation: {axis: [1, 2, 0.5], angle: 40 deg}")
        out = sensors(text.replace("angular-velocity: [0, 0, 0.0]", "angular-velocity: [2, -1, 1]"))
        assert out["c.normal"].max() > 100
        worst.append(numpy.abs(out["balance"]).max())
    assert worst[1] < 1e-3
    assert worst[0] / worst[1] > 8, worst


def test_round_meshes_meet_as_spheres(sensors, tmp_path):
    """Of two equal spheres the one that comes stops and the other one goes on."""
    triangle_meshes.write_stl(tmp_path / "globe.stl", *triangle_meshes.globe(0.1, 3), text=True)
    globe = "{stl: {file: globe.stl, unit: 1 m, spacing: 20 mm}}"
    ball = "rigid: {mass: 1 kg, inertia: [4e-3, 4e-3, 4e-3]}"
    out = sensors(f"""
buckens: 1
bodies:
  a: {{{ball}}}
  b: {{{ball}, at: {{position: [0.21, 0, 0]}}}}
loads: {{c: {{contact: {{between: [a, b], shapes: [{globe}, {globe}], stiffness: 1e6}}}}}}
initial: {{bodies: {{a: {{velocity: [1, 0, 0]}}}}}}
simulation: {{duration: 22 ms, step: 100 us}}
output: {{every: 1 ms, sensors: {{va: {{velocity: a}}, vb: {{velocity: b}}, wb: {{angular-velocity: b}}, c: {{contact: c}}, balance: {{energy: balance}}}}}}
""")
    assert out["vb.x"][-1] == pytest.approx(1, abs=1e-4)
    assert out["va.x"][-1] == pytest.approx(0, abs=1e-4)
    # They meet at a corner of both: all is symmetric.
    assert abs(out["vb.y"][-1]) < 1e-9 and abs(out["wb.z"][-1]) < 1e-8
    assert numpy.abs(out["balance"]).max() < 1e-3


def test_a_pile_of_meshes_in_a_group(sensors, shapes):
    """Three cubes on a table: each face carries what is above it."""
    bodies = "\n".join(f"  b{k}: {{{CUBE}, at: {{position: [0, 0, {(k + 0.5) * SIDE!r}]}}}}" for k in range(3))
    out = sensors(f"""
buckens: 1
gravity: [0, 0, {-G}]
bodies:
{bodies}
loads:
  all: {{contacts: {{among: [{{bodies: "b*", {BLOCK[1:-1]}}}, {{on: ground, {TABLE[1:-1]}}}], stiffness: {STIFFNESS}, damping: 4e3, static: 0.5}}}}
simulation: {{duration: 0.1 s, step: 1 ms}}
output: {{every: 10 ms, sensors: {{p0: {{position: b0}}, p1: {{position: b1}}, p2: {{position: b2}}, all: {{contact: all}}, balance: {{energy: balance}}}}}}
""")
    sink = MASS * G / (4 * STIFFNESS)
    gap = [0.5 * SIDE - out["p0.z"][-1]]
    gap += [SIDE - (out[f"p{k}.z"][-1] - out[f"p{k - 1}.z"][-1]) for k in (1, 2)]
    assert gap == pytest.approx([3 * sink, 2 * sink, sink], rel=1e-6)
    assert out["all.normal"][-1] == pytest.approx(6 * MASS * G, rel=1e-6)


def test_a_cylinder_rolls_over_triangles_as_over_a_plane(sensors, tmp_path):
    triangle_meshes.write_stl(tmp_path / "ground.stl", *triangle_meshes.plate(3.0, 12))
    results = []
    for surface in ("{stl: {file: ground.stl, unit: 1 m}}", "{plane: {}}"):
        results.append(sensors(f"""
buckens: 1
gravity: [1.0, 0, {-G}]
bodies: {{drum: {{rigid: {{mass: 3 kg, inertia: [0.02, 0.015, 0.02]}}, at: {{position: [-1.1, 0.1, 0.1]}}}}}}
loads: {{c: {{contact: {{between: [ground, drum], shapes: [{surface}, {{cylinder: {{radius: 100 mm, length: 0.3, axis: [0, 1, 0]}}}}], stiffness: 1e5, damping: 300, static: 0.4}}}}}}
initial: {{bodies: {{drum: {{velocity: [0.5, 0, -0.2], angular-velocity: [0.1, 0, 0.3]}}}}}}
simulation: {{duration: 0.8 s, step: 1 ms}}
output: {{every: 20 ms, sensors: {{p: {{position: drum}}, v: {{velocity: drum}}, w: {{angular-velocity: drum}}, c: {{contact: c}}, balance: {{energy: balance}}}}}}
"""))
    mesh, plane = results
    assert plane["p.x"][-1] - plane["p.x"][0] > 0.4
    for name in ("p.x", "p.y", "p.z", "v.x", "w.x", "w.y", "w.z", "c.normal", "c.friction"):
        # As of spheres: distances differ by rounding.
        assert mesh[name] == pytest.approx(plane[name], rel=1e-6, abs=1e-8), name


@pytest.mark.parametrize(("shapes_and_law", "words"), [
    (f"{BLOCK}], exponent: 1.5, stiffness: 1e6", ["a mesh and a mesh touch with an area", "remove `exponent`"]),
    ("{socket: 50 mm}]", ["a mesh and a socket cannot touch", "mesh–cylinder"]),
    ("{cylinder: {radius: 50 mm, length: 0.1}}], exponent: 1.5", ["without `stiffness` or `modulus` the contact is rigid"]),
    ("{stl: {file: block.stl, unit: 1 m, spacing: 1 um}}], stiffness: 1e6", ["block.stl", "`spacing` of 1e-06 m over 0.24 m²", "give a larger spacing"]),
    ("{stl: {file: block.stl, unit: 1 m, spacing: -1 mm}}], stiffness: 1e6", ["spacing", "positive"]),
])
def test_what_does_not_fit_is_refused(buckens, shapes, tmp_path, shapes_and_law, words):
    (tmp_path / "model.yaml").write_text(f"""
buckens: 1
bodies: {{block: {{{CUBE}, at: {{position: [0, 0, 0.2]}}}}}}
loads: {{c: {{contact: {{between: [ground, block], shapes: [{TABLE}, {shapes_and_law}}}}}}}
simulation: {{duration: 1 ms, step: 1 ms}}
""")
    buckens("check", "model.yaml").must(2, "model.yaml:", *words)
