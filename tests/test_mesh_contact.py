# SPDX-License-Identifier: Apache-2.0
"""Surfaces of triangles that touch planes, spheres, capsules and boxes, from STL files and from meshes of bodies."""

import math
import os
import pathlib
import shutil
import sys

import numpy
import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent / "support"))

import triangle_meshes  # noqa: E402

EXAMPLES = pathlib.Path(os.environ.get("BUCKENS_SOURCE_DIR", pathlib.Path(__file__).parents[1])) / "examples"
G = 9.81
BALL = "rigid: {mass: 0.5 kg, inertia: [5e-4, 5e-4, 5e-4]}"  # 2/5 m r^2 with r = 50 mm


def ball_on(surface, position, velocity, law, duration="0.6 s", gravity=(0, 0, -G), step="0.5 ms"):
    return f"""
buckens: 1
gravity: [{gravity[0]!r}, {gravity[1]!r}, {gravity[2]!r}]
bodies: {{ball: {{{BALL}, at: {{position: [{", ".join(map(repr, position))}]}}}}}}
loads: {{c: {{contact: {{between: [ground, ball], shapes: [{surface}, {{sphere: 50 mm}}], {law}}}}}}}
initial: {{bodies: {{ball: {{velocity: [{", ".join(map(repr, velocity))}]}}}}}}
simulation: {{duration: {duration}, step: {step}}}
output: {{every: 10 ms, sensors: {{p: {{position: ball}}, v: {{velocity: ball}}, w: {{angular-velocity: ball}}, c: {{contact: c}}, balance: {{energy: balance}}}}}}
"""


@pytest.mark.parametrize(("text", "unit"), [(False, 1e-3), (True, 1.0)])
def test_a_sphere_rolls_over_triangles_as_over_a_plane(sensors, tmp_path, text, unit):
    """Thrown obliquely: it hits, slides, rolls, over a hundred borders of triangles, none of which catches."""
    points, triangles = triangle_meshes.plate(3.0, 12)
    triangle_meshes.write_stl(tmp_path / "ground.stl", points / unit, triangles, text)
    law = "stiffness: 2e4, restitution: 0.6, static: 0.2, threshold: 10 mm/s"
    start = ([-1.2, -0.6, 0.07], [2.5, 1.0, -0.5])
    triangulated = sensors(ball_on(f"{{stl: {{file: ground.stl, unit: {unit} m}}}}", *start, law))
    plane = sensors(ball_on("{plane: {}}", *start, law))
    assert plane["p.x"][-1] - plane["p.x"][0] > 1.0
    for name in ("p.x", "p.y", "p.z", "v.x", "w.y", "c.normal", "c.friction"):
        # Distances differ by rounding of 1e-16 m, forces by the stiffness times that, and by the step's tolerance.
        assert triangulated[name] == pytest.approx(plane[name], rel=1e-7, abs=1e-9), name


def box_on_plane(cells, tmp_path, tilt=0.0, law="damping: 1e3", shape=None, torque=0.0):
    triangle_meshes.write_stl(tmp_path / "block.stl", *triangle_meshes.box([0.2, 0.2, 0.2], cells), text=True)
    shape = shape or "{stl: {file: block.stl, unit: 1 m}}"
    gravity = (G * math.sin(tilt), 0, -G * math.cos(tilt))
    return f"""
buckens: 1
gravity: [{gravity[0]!r}, 0, {gravity[2]!r}]
bodies: {{block: {{rigid: {{mass: 2 kg, inertia: [0.0133, 0.0133, 0.0133]}}, at: {{position: [0, 0, 0.1]}}}}}}
loads:
  c: {{contact: {{between: [ground, block], shapes: [{{plane: {{}}}}, {shape}], stiffness: 1e6, {law}}}}}
  turn: {{torque: {{on: block, value: [0, {torque!r}, 0]}}}}
simulation: {{duration: 1 s, step: 1 ms}}
output: {{every: 20 ms, sensors: {{p: {{position: block}}, r: {{rotation: block}}, c: {{contact: c}}, balance: {{energy: balance}}}}}}
"""


@pytest.mark.parametrize("cells", [1, 6])
def test_a_box_of_triangles_rests_on_a_plane(sensors, tmp_path, cells):
    out = sensors(box_on_plane(cells, tmp_path, torque=0.3))
    # The face of 0.04 m^2 is a sixth of the surface: four quarters of 1e6 N/m each, whatever its triangles.
    # Tilted by 2e-5 rad its middle is lower by 2e-11 m.
    assert out["p.z"][-1] == pytest.approx(0.1 - 2 * G / 4e6, abs=1e-10)
    # Springs spread over the face resist a tilt with 4 K a^2/12, less what the raised weight adds.
    assert out["r.y"][-1] == pytest.approx(0.3 / (4e6 * 0.04 / 12 - 2 * G * 0.1), rel=1e-6)
    assert out["c.normal"][-1] == pytest.approx(2 * G, rel=1e-9)


def test_a_box_of_triangles_sticks_and_slides_on_an_incline(sensors, tmp_path):
    tilt = math.radians(20)
    hold = sensors(box_on_plane(3, tmp_path, tilt, f"damping: 1e3, static: {1.01 * math.tan(tilt)!r}"))
    late = hold["t"] > 0.49
    assert numpy.abs(hold["p.x"][late] - hold["p.x"][late][0]).max() < 1e-9
    slide = sensors(box_on_plane(3, tmp_path, tilt, f"damping: 1e3, static: {0.8 * math.tan(tilt)!r}"))
    a = 2 * numpy.polyfit(slide["t"][late], slide["p.x"][late], 2)[0]
    assert a == pytest.approx(0.2 * G * math.sin(tilt), rel=1e-3)


def test_a_globe_of_triangles_sinks_in_as_its_volume_says(sensors, tmp_path):
    """Springs over the plane push with the volume below it; finer triangles are closer to the sphere by the square of their size."""
    radius, depth, stiffness = 0.1, 0.02, 1e4
    errors = []
    for levels in (2, 3, 4):
        points, triangles = triangle_meshes.globe(radius, levels)
        triangle_meshes.write_stl(tmp_path / "globe.stl", points, triangles, text=True)
        out = sensors(f"""
buckens: 1
bodies: {{globe: {{rigid: {{mass: 1e6 kg, inertia: [1e4, 1e4, 1e4]}}, at: {{position: [0, 0, {radius - depth}]}}}}}}
loads: {{c: {{contact: {{between: [ground, globe], shapes: [{{plane: {{}}}}, {{stl: {{file: globe.stl, unit: 1 m}}}}], stiffness: {stiffness}}}}}}}
simulation: {{duration: 1 ms, step: 1 ms}}
output: {{sensors: {{c: {{contact: c}}}}}}
""")
        exact = 4 * stiffness / (4 * math.pi * radius**2 / 6) * math.pi * depth**2 * (radius - depth / 3)
        errors.append(out["c.normal"][0] / exact - 1)
    assert abs(errors[2]) < 0.01
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.35)
    assert errors[1] / errors[2] == pytest.approx(4, rel=0.35)


def period(t, x):
    """Between the first and the last crossing of zero upwards, linear between records."""
    at = [t[k] - x[k] * (t[k + 1] - t[k]) / (x[k + 1] - x[k]) for k in range(len(t) - 1) if x[k] < 0 <= x[k + 1]]
    return (at[-1] - at[0]) / (len(at) - 1)


def test_a_ball_swings_in_a_bowl_of_triangles_with_the_exact_period(sensors, tmp_path):
    """Without friction it is a pendulum of the length R - r; rolling, one 7/5 times as slow in the square. Finer triangles are nearer."""
    radius, amplitude, stiffness = 0.4, math.radians(25), 1e6
    arm = radius - 0.05
    start = [arm * math.sin(amplitude), 0.003, -arm * math.cos(amplitude)]
    arm += 0.5 * G / stiffness  # it sinks in by its weight
    # 4 K(sin a/2) by the arithmetic-geometric mean.
    a, b = 1.0, math.cos(amplitude / 2)
    for _ in range(8):
        a, b = (a + b) / 2, math.sqrt(a * b)
    exact = 2 * math.pi * math.sqrt(arm / G) / a
    errors = []
    for cells in (8, 16, 32):
        triangle_meshes.write_stl(tmp_path / "bowl.stl", *triangle_meshes.bowl(radius, cells), text=True)
        out = sensors(ball_on("{stl: {file: bowl.stl, unit: 1 m}}", start, [0, 0, 0], f"stiffness: {stiffness}", "6 s"))
        errors.append(abs(period(out["t"], out["p.x"]) / exact - 1))
        assert numpy.abs(out["balance"]).max() < 2e-3
    # 128 triangles are as good as the crossings are found; those of 0.5 mm steps by a few 1e-6.
    assert max(errors) < 2e-4 and errors[2] < 2e-5, errors
    rolling = sensors(ball_on("{stl: {file: bowl.stl, unit: 1 m}}", start, [0, 0, 0], f"stiffness: {stiffness}, static: 0.5", "6 s"))
    assert period(rolling["t"], rolling["p.x"]) == pytest.approx(exact * math.sqrt(7 / 5), rel=1e-3)


def test_a_ball_lies_between_two_planes(sensors, tmp_path):
    """Both are touched at once, each by its own force."""
    triangle_meshes.write_stl(tmp_path / "groove.stl", *triangle_meshes.groove(1.0, 0.5, 8), text=True)
    out = sensors(ball_on("{stl: {file: groove.stl, unit: 1 m}}", [0, 0.002, 0.05 * math.sqrt(2)], [0.3, 0, 0],
                          "stiffness: 2e4, damping: 40", "1 s"))
    assert out["c.normal"][-1] == pytest.approx(0.5 * G * math.sqrt(2), rel=1e-6)
    assert abs(out["p.y"][-1]) < 1e-9
    assert out["p.x"][-1] == pytest.approx(0.3, abs=1e-9)  # nothing catches along it


def test_energy_is_kept_over_edges_and_corners(sensors, tmp_path):
    """A ball bounces without loss on the edges and corners of a box, also where patches meet."""
    triangle_meshes.write_stl(tmp_path / "block.stl", *triangle_meshes.box([0.3, 0.3, 0.3], 2), text=True)
    for x, y in [(0.17, 0.02), (0.16, 0.165), (0.152, 0.153)]:
        out = sensors(ball_on("{stl: {file: block.stl, unit: 1 m}}", [x, y, 0.25], [0, 0, 0], "stiffness: 1e5", "0.4 s", step="50 us"))
        speed = numpy.sqrt(out["v.x"]**2 + out["v.y"]**2 + out["v.z"]**2)
        energy = 0.5 * 0.5 * speed[-1]**2 + 0.5 * G * (out["p.z"][-1] - out["p.z"][0])
        assert abs(energy) < 1e-4 * 0.5 * G * 0.1
        fallen = math.sqrt(2 * G * numpy.maximum(0, out["p.z"][0] - out["p.z"]).max())
        assert abs(out["v.x"][-1]) + abs(out["v.y"][-1]) > 0.01 * fallen  # it was turned aside


def test_capsules_and_boxes_lie_on_triangles(sensors, tmp_path):
    triangle_meshes.write_stl(tmp_path / "ground.stl", *triangle_meshes.plate(2.0, 9), text=True)
    for shape, half, spots in [("{capsule: {radius: 50 mm, length: 200 mm, axis: [1, 0, 0]}}", 0.05, 2), ("{box: [0.2, 0.1, 0.1]}", 0.05, 4)]:
        text = ball_on("{stl: {file: ground.stl, unit: 1 m}}", [0.01, 0.02, half], [0, 0, 0], "stiffness: 1e5, damping: 200", "0.5 s")
        out = sensors(text.replace("{sphere: 50 mm}", shape))
        assert out["p.z"][-1] == pytest.approx(half - 0.5 * G / (spots * 1e5), abs=1e-9)


def test_balls_of_a_group_touch_triangles_and_each_other(sensors, tmp_path):
    triangle_meshes.write_stl(tmp_path / "bowl.stl", *triangle_meshes.bowl(0.4, 10), text=True)
    balls = "".join(f"  b{k}: {{{BALL}, at: {{position: [{0.11 * (k - 1)}, 0, -0.3]}}}}\n" for k in range(3))
    law = "stiffness: 2e4, damping: 30, static: 0.3"
    surface, ball = "stl: {file: bowl.stl, unit: 1 m}", "sphere: 50 mm"
    group = f"  g: {{contacts: {{among: [{{on: ground, {surface}}}, {{bodies: \"b*\", {ball}}}], {law}}}}}\n"
    pairs = "".join(f"  p{k}: {{contact: {{between: [ground, b{k}], shapes: [{{{surface}}}, {{{ball}}}], {law}}}}}\n" for k in range(3))
    pairs += "".join(f"  q{i}{j}: {{contact: {{between: [b{i}, b{j}], shapes: [{{{ball}}}, {{{ball}}}], {law}}}}}\n" for i, j in [(0, 1), (0, 2), (1, 2)])
    out = []
    for loads in (group, pairs):
        out.append(sensors(f"""
buckens: 1
gravity: [0, 0, -{G}]
bodies:
{balls}loads:
{loads}simulation: {{duration: 0.5 s, step: 0.5 ms}}
output: {{every: 10 ms, sensors: {{a: {{position: b0}}, b: {{position: b1}}, c: {{rotation: b2}}}}}}
"""))
    for name in out[0]:
        assert out[0][name] == pytest.approx(out[1][name], rel=1e-6, abs=1e-8), name


SOFT = """
buckens: 1
gravity: [0, 0, -9.81]
materials: {rubber: {E: 5 MPa, nu: 0.3, rho: 1200}}
bodies:
  block:
    mesh: {box: {size: [0.1, 0.1, 0.1], divisions: [3, 3, 3]}, material: rubber}
    interfaces: {foot: {face: z0}}
    at: {position: [0, 0, START]}
"""


def test_the_surface_of_a_flexible_body_rests_on_a_plane(sensors, buckens, tmp_path):
    text = SOFT.replace("START", "0") + """
loads: {c: {contact: {between: [ground, block/foot], shapes: [{plane: {}}, {surface: {}}], stiffness: 1e5, damping: 200}}}
simulation: {duration: 1 s, step: 1 ms}
output: {every: 50 ms, sensors: {c: {contact: c}, p: {position: block/foot}}}
"""
    out = sensors(text)
    assert out["c.normal"][-1] == pytest.approx(1.2 * G, rel=1e-3)  # it still vibrates by itself
    assert out["p.z"][-1] == pytest.approx(-1.2 * G / 4e5, rel=1e-3)


def broken(tmp_path, name, change):
    points, triangles = triangle_meshes.box([0.2, 0.2, 0.2])
    triangle_meshes.write_stl(tmp_path / name, points, change(list(triangles)), text=True)


@pytest.mark.parametrize(("shapes", "words"), [
    ("{stl: {file: no.stl, unit: 1 mm}}, {sphere: 0.1}", ["no.stl", "there is no such file"]),
    ("{stl: {file: good.stl}}, {sphere: 0.1}", ["unit"]),
    ("{stl: {file: inward.stl, unit: 1 m}}, {sphere: 0.1}", ["look inwards", "turn them over"]),
    ("{stl: {file: mixed.stl, unit: 1 m}}, {sphere: 0.1}", ["look to different sides", "repair it"]),
    ("{stl: {file: cut.stl, unit: 1 m}}, {sphere: 0.1}", ["cut.stl", "is truncated", "export it again"]),
    ("{stl: {file: empty.stl, unit: 1 m}}, {sphere: 0.1}", ["no triangles"]),
    ("{stl: {file: word.stl, unit: 1 m}}, {sphere: 0.1}", ["word.stl:4", "expected vertex, found corner"]),
    ("{stl: {file: good.stl, unit: 1 m}}, {socket: 1 m}", ["a mesh and a socket cannot touch", "mesh–sphere"]),
    ("{stl: {file: good.stl, unit: 1 m}}, {bore: 1 m}", ["a mesh and a bore cannot touch", "mesh–mesh"]),
    ("{surface: {}}, {sphere: 0.1}", ["the ground has no mesh", "stl"]),
    ("{plane: {}}, {surface: {}}", ["its body is rigid and has no mesh"]),
    ("{plane: {}}, {stl: {file: good.stl, unit: 1 m}}, exponent: 2", ["a plane and a mesh touch with an area"]),
    ("{stl: {file: good.stl, unit: 1 m}}, {sphere: 0.1}, modulus", ["Hertz's theory gives no force between a mesh and a sphere"]),
    ("{bore: 1 m}, {stl: {file: good.stl, unit: 1 m}}, rigid", ["a bore and a mesh cannot touch", "mesh–cylinder"]),
])
def test_bad_surfaces_are_refused(buckens, tmp_path, shapes, words):
    broken(tmp_path, "good.stl", lambda t: t)
    broken(tmp_path, "inward.stl", lambda t: [x[::-1] for x in t])
    broken(tmp_path, "mixed.stl", lambda t: [t[0][::-1], *t[1:]])
    broken(tmp_path, "empty.stl", lambda _: [])
    (tmp_path / "word.stl").write_text("solid a\nfacet normal 0 0 1\nouter loop\ncorner 0 0 0\n")
    triangle_meshes.write_stl(tmp_path / "cut.stl", *triangle_meshes.box([0.2, 0.2, 0.2]))
    (tmp_path / "cut.stl").write_bytes((tmp_path / "cut.stl").read_bytes()[:-7])
    law = "stiffness: 1e5"
    for word, other in [(", exponent: 2", "stiffness: 1e5, exponent: 2"), (", modulus", "modulus: [1 GPa, 1 GPa]"), (", rigid", "restitution: 0.5")]:
        if shapes.endswith(word):
            shapes, law = shapes[:-len(word)], other
    (tmp_path / "model.yaml").write_text(f"""
buckens: 1
bodies: {{ball: {{rigid: {{mass: 1 kg, inertia: [1, 1, 1]}}, at: {{position: [0, 0, 0.5]}}}}}}
loads: {{c: {{contact: {{between: [ground, ball], shapes: [{shapes}], {law}}}}}}}
simulation: {{duration: 1 s, step: 1 ms}}
""")
    buckens("check", "model.yaml").must(2, "model.yaml:" if "word" not in shapes else "word.stl", *words)


def test_meshes_have_no_section(buckens, tmp_path):
    triangle_meshes.write_stl(tmp_path / "good.stl", *triangle_meshes.box([0.2, 0.2, 0.2]))
    (tmp_path / "model.yaml").write_text("""
buckens: 1
planar: xy
bodies: {ball: {rigid: {mass: 1 kg, inertia: [0, 0, 1]}, at: {position: [0, 1, 0]}}}
loads: {c: {contact: {between: [ground, ball], shapes: [{stl: {file: good.stl, unit: 1 m}}, {sphere: 0.1}], stiffness: 1e5}}}
simulation: {duration: 1 s, step: 1 ms}
""")
    buckens("check", "model.yaml").must(2, "model.yaml:", "in a planar model meshes are not supported; use a `sphere`")


def test_the_marbles_of_the_examples(sensors, tmp_path):
    shutil.copy(EXAMPLES / "marble_bowl/bowl.stl", tmp_path)
    out = sensors((EXAMPLES / "marble_bowl/marble_bowl").with_suffix(".yaml").read_text())
    # Borders of triangles give and take nothing.
    assert numpy.abs(out["balance"]).max() < 1e-3 * out["lost"][-1]
    # Once both roll without slip, nothing more is lost.
    rolling = out["t"] > 1
    assert numpy.ptp(out["lost"][rolling]) < 1e-3 * out["lost"][-1]
    for name in ("first", "second"):
        # On the bowl: the centre is a radius of 12 mm off z = (r - 10 mm)^2/400 mm along its normal.
        r = numpy.hypot(out[f"{name}.x"], out[f"{name}.y"])[rolling]
        foot = r.copy()
        for _ in range(50):
            slope = numpy.maximum(0, foot - 0.01) / 0.2
            foot = r + 0.012 * slope / numpy.sqrt(1 + slope**2)
        height = numpy.maximum(0, foot - 0.01)**2 / 0.4 + 0.012 / numpy.sqrt(1 + slope**2)
        # Parts of 18 degrees stand off the circle by up to 1.2 % of the radius where they are flat; patches bulge.
        assert out[f"{name}.z"][rolling] == pytest.approx(height, abs=1e-3)
