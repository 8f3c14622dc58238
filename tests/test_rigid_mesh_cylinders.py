# SPDX-License-Identifier: Apache-2.0
"""Rigid contact of surfaces of triangles with cylinders and capsules: what they do on boxes, on planes and on rails; exact motions."""

import math
import pathlib
import random
import sys

import numpy
import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent / "support"))

import cylinder_cases  # noqa: E402
import triangle_meshes  # noqa: E402
from cylinder_cases import DRUM, G, LOG, ON_PLANE, ROLLS, STATE, columns, model  # noqa: E402

BASE = "{stl: {file: base.stl, unit: 1 m}}"
BEAM = "{capsule: {radius: 0.1, length: 0.9, axis: [1, 0, 0]}}"
LONG = "9e-3, 0.05, 0.05"


def write(tmp_path, mesh, name="base"):
    triangle_meshes.write_stl(tmp_path / f"{name}.stl", *mesh, text=True)


@pytest.mark.parametrize("name", ON_PLANE)
def test_it_moves_on_a_face_as_on_a_plane(sensors, tmp_path, name):
    shape, law, case = ON_PLANE[name]
    case = {"duration": "0.4 s", **case}
    write(tmp_path, triangle_meshes.box([9, 9, 1], 6))
    face = sensors(model(f"{BASE}, {shape}", law, **case))
    plane = sensors(model(f"{{plane: {{}}}}, {shape}", law, under=0, **case))
    cylinder_cases.check_moves_as_on_a_plane(name, face, plane)


@pytest.mark.parametrize("shape", [DRUM, LOG])
@pytest.mark.parametrize("restitution", [0, 0.5, 0.9])
def test_a_fall_loses_what_restitution_leaves(sensors, tmp_path, shape, restitution):
    write(tmp_path, triangle_meshes.box([3, 2, 1], 3))
    out = sensors(model(f"{BASE}, {shape}", f"restitution: {restitution}", at="0, 0, 0.4", duration="0.26 s"))
    assert out["lost"][-1] == pytest.approx(2 * G * 0.3 * (1 - restitution**2), rel=1e-6, abs=1e-9)
    assert numpy.abs(out["balance"]).max() < 1e-6


def turning(out):
    """Angle about y, summed up from the speed of turning."""
    w, t = out["w.y"], out["t"]
    return numpy.concatenate([[0], numpy.cumsum(0.5 * (w[1:] + w[:-1]) * numpy.diff(t))])


@pytest.mark.parametrize("shape, inertia", [(DRUM, 0.02), (BEAM, 0.05)])
def test_it_tips_over_an_edge(sensors, tmp_path, shape, inertia):
    """Its middle is 0.03 outside of the edge, about which it turns.

    w^2 = 2 m g (s sin a + h (1 - cos a)) / (J + m (h^2 + s^2))."""
    write(tmp_path, triangle_meshes.box([0.2, 2, 1], 2))
    out = sensors(model(f"{BASE}, {shape}", "static: 2", at="0.13, 0, 0.1", inertia="0.02, 0.02, 0.01" if shape == DRUM else LONG, duration="0.3 s", step="0.5 ms",
                        every="0.5 ms"))
    s, h, angle = 0.03, 0.1, turning(out)
    early = (angle < 0.5) & (out["t"] > 0.05)
    assert early.sum() >= 100
    exact = numpy.sqrt(2 * 2 * G * (s * numpy.sin(angle) + h * (1 - numpy.cos(angle))) / (inertia + 2 * (h**2 + s**2)))
    # Summed up in steps of 0.5 ms, in the first of which it begins to turn.
    assert out["w.y"][early] == pytest.approx(exact[early], rel=5e-4)
    assert numpy.abs(out["w.x"][early]).max() < 1e-6 and numpy.abs(out["w.z"][early]).max() < 1e-6
    assert numpy.abs(out["balance"]).max() < 1e-4


def test_a_log_rolls_off_an_edge(sensors, tmp_path):
    """About the edge, without slip until it lets go where m v^2/R = m g cos a: 7 cos a = 4 + 3 v0^2/(g R)."""
    v = 0.3
    write(tmp_path, triangle_meshes.box([0.4, 2, 1], 3))
    out = sensors(model(f"{BASE}, {LOG}", "static: 20", at="0.17, 0, 0.1", velocity=f"{v}, 0, 0", spin=f"0, {v / 0.1}, 0", inertia=ROLLS,
                        duration="0.55 s", step="0.5 ms", every="0.5 ms"))
    rises = out["p.x"] < 0.1999
    assert out["v.x"][rises] == pytest.approx(v, abs=1e-9) and out["p.z"][rises] == pytest.approx(0.1, abs=1e-10)
    lost = math.acos((4 + 3 * v * v / (G * 0.1)) / 7)
    angle = numpy.arctan2(out["p.x"] - 0.2, out["p.z"])
    turns = (angle > 1e-3) & (angle < lost - 0.02)
    assert turns.sum() > 50
    # A place that hands over to the next lets weight act for a part of a step.
    assert out["p.x"][turns] == pytest.approx(0.2 + 0.1 * numpy.sin(angle[turns]), abs=G * 0.5e-3**2)
    # 3/4 m v^2 + m g R cos a is kept.
    speed = numpy.hypot(out["v.x"], out["v.z"])
    assert speed[turns] ** 2 == pytest.approx(v * v + 4 / 3 * G * 0.1 * (1 - numpy.cos(angle[turns])), rel=2e-3)
    assert out["c.normal"][out["t"] > out["t"][turns][-1] + 0.02].max() == 0
    assert numpy.abs(out["balance"]).max() < 1e-4


RAILS = triangle_meshes.join((triangle_meshes.box([0.05, 1, 1], 2), [-0.1, 0, 0]), (triangle_meshes.box([0.05, 1, 1], 1), [0.1, 0, 0]))
# What lies below, what is on it, where, how it is turned.
AT_REST = {
    "drum-over-edge": (triangle_meshes.box([0.4, 0.4, 1], 2), DRUM, "0.19, 0.05, 0.1", 15),
    "drum-over-corner": (triangle_meshes.box([0.4, 0.4, 1], 2), DRUM, "0.18, 0.17, 0.1", 0),
    "drum-on-small-box": (triangle_meshes.box([0.1, 0.1, 1], 1), DRUM, "0.02, 0.01, 0.1", 0),
    "drum-on-rails": (RAILS, DRUM, "0.01, 0.02, 0.1", 10),
    "log-across-beam": (triangle_meshes.box([4, 0.2, 1], 3), LOG, "0, 0.02, 0.1", 0),
    "log-across-rails": (RAILS, "{cylinder: {radius: 0.1, length: 0.5, axis: [1, 0, 0]}}", "0.03, 0.05, 0.1", 20),
    "log-flush": (triangle_meshes.box([1, 0.3, 1], 2), LOG, "0.1, 0, 0.1", 0),
    "log-over-corner": (triangle_meshes.box([0.4, 0.4, 1], 1), LOG, "0.12, 0.12, 0.1", 25),
    "beam-across-rails": (RAILS, BEAM, "0.03, 0.05, 0.1", 20),
    "beam-on-rails-of-balls": (triangle_meshes.join(*((triangle_meshes.globe(0.5, 3), [x, 0, 0]) for x in (-0.6, 0.6))),
                               "{capsule: {radius: 0.1, length: 1.5, axis: [1, 0, 0]}}", "0.1, 0, 0.1", 0),
}


@pytest.mark.parametrize("name", AT_REST)
def test_it_rests(sensors, tmp_path, name):
    mesh, shape, at, angle = AT_REST[name]
    write(tmp_path, mesh)
    out = sensors(model(f"{BASE}, {shape}", "static: 0.5", at=at, turned=f", orientation: {{axis: [0, 0, 1], angle: {angle} deg}}",
                        inertia=ROLLS if "log" in name else LONG if "beam" in name else "0.02, 0.02, 0.01", duration="0.1 s", step="2 ms"))
    where = [float(x) for x in at.split(",")]
    assert numpy.abs(columns(out, "p") - where).max() < 1e-9
    assert numpy.abs(columns(out, "w")).max() < 1e-8
    assert out["c.normal"][1:] == pytest.approx(2 * G, rel=1e-7)
    assert numpy.abs(out["balance"]).max() < 1e-8


def test_a_mesh_rests_on_a_drum(sensors, tmp_path):
    """The surface of triangles moves: a block on the end of a cylinder, over its rim, and wider than it."""
    for sides, radius, at in (([0.2, 0.3, 0.15], 0.3, "0.1, 0.05, 0.075"), ([0.2, 0.3, 0.15], 0.3, "0.22, 0.05, 0.075"), ([0.4, 0.5, 0.15], 0.1, "0.02, 0.03, 0.075")):
        write(tmp_path, triangle_meshes.box(sides, 2))
        out = sensors(model(f"{{cylinder: {{radius: {radius}, length: 1}}}}, {BASE}", "static: 0.5", at=at,
                            turned=", orientation: {axis: [0, 0, 1], angle: 25 deg}", duration="0.1 s", step="2 ms"))
        assert numpy.abs(columns(out, "p") - [float(x) for x in at.split(",")]).max() < 1e-9, at
        assert out["c.normal"][1:] == pytest.approx(2 * G, rel=1e-7)


def test_a_log_lies_in_a_valley(sensors, tmp_path):
    """Between two slopes of 45 degrees: each carries m g/sqrt 2; along the valley it slides with the friction of both."""
    write(tmp_path, triangle_meshes.groove(8, 1, 4))
    gravity = (0.5, 0, -G)
    out = sensors(model(f"{BASE}, {{cylinder: {{radius: 0.1, length: 0.3, axis: [1, 0, 0]}}}}", "static: 0.02", at="0, 0, \"0.1*sqrt(2)\"", under=0,
                        inertia="0.01, 0.02, 0.02", gravity=gravity, duration="0.2 s", step="2 ms"))
    assert out["c.normal"][1:] == pytest.approx(2 * G * math.sqrt(2), rel=1e-8)
    assert out["p.x"] == pytest.approx((0.5 - 0.02 * math.sqrt(2) * G) * out["t"] ** 2 / 2, abs=1e-9)
    assert numpy.abs(out["p.y"]).max() < 1e-10 and out["p.z"] == pytest.approx(0.1 * math.sqrt(2), abs=1e-10)


@pytest.mark.parametrize("shape, inertia", [("{cylinder: {radius: 0.1, length: 0.5, axis: [1, 0, 0]}}", "0.01, 0.05, 0.05"), (BEAM, LONG)])
def test_rails_share_the_load(sensors, tmp_path, shape, inertia):
    """It lies across two of them, 0.02 beside their middle: the lever shares its weight."""
    write(tmp_path, triangle_meshes.box([1e-3, 1, 1], 1))
    out = sensors(f"""
buckens: 1
gravity: [0, 0, -9.81]
bodies: {{b: {{rigid: {{mass: 3 kg, inertia: [{inertia}]}}, at: {{position: [0.02, 0, 0.1]}}}}}}
loads:
  c: {{contact: {{between: [{{ground: [-0.1, 0, -0.5]}}, b], shapes: [{BASE}, {shape}], static: 0.5}}}}
  d: {{contact: {{between: [{{ground: [0.1, 0, -0.5]}}, b], shapes: [{BASE}, {shape}], static: 0.5}}}}
simulation: {{duration: 0.1 s, step: 2 ms}}
output: {{every: 20 ms, sensors: {{p: {{position: b}}, c: {{contact: c}}, d: {{contact: d}}}}}}
""")
    assert numpy.abs(columns(out, "p") - [0.02, 0, 0.1]).max() < 1e-10
    # How both edges of a rail share is not determined, so the lever is known within the width of a rail, 1e-3 of 0.2.
    assert out["c.normal"][1:] == pytest.approx(3 * G * 0.4, rel=1.5e-2)
    assert out["d.normal"][1:] == pytest.approx(3 * G * 0.6, rel=1.5e-2)
    assert out["c.normal"][1:] + out["d.normal"][1:] == pytest.approx(3 * G, rel=1e-8)


FALLS = {
    "drum": (DRUM, {"spin": "2, 3, 1"}),
    "rod": ("{capsule: {radius: 0.1, length: 0.3, axis: [0, 1, 0]}}", {"spin": "2, 3, 1", "inertia": "0.03, 9e-3, 0.03"}),
}


@pytest.mark.parametrize("name", FALLS)
def test_it_tumbles_on_a_mesh_as_on_the_box(sensors, tmp_path, name):
    """The same solid, given by triangles: the same places, in other rows."""
    shape, case = FALLS[name]
    write(tmp_path, triangle_meshes.box([0.9, 0.8, 1], 3))
    fall = {"at": "0, 0, 0.4", "velocity": "0.3, 0.2, 0", "duration": "0.5 s", **case}
    mesh, box = (sensors(model(f"{first}, {shape}", "static: 0.4, restitution: 0.3", **fall)) for first in (BASE, "{box: [0.9, 0.8, 1]}"))
    assert box["lost"][-1] > 2
    for column in STATE:
        # Rounding, which blows of a tumbling body enlarge.
        assert mesh[column] == pytest.approx(box[column], abs=1e-7), column


def test_a_beam_rocks_on_a_tube(sensors, tmp_path):
    """A capsule across a round surface of triangles touches between its ends and rolls: w^2 = m g (R - r)/(J + m r^2) for small angles."""
    r, R, J = 0.1, 0.3, 0.05
    rate = math.sqrt(2 * G * (R - r) / (J + 2 * r * r))
    errors = []
    for sides in (24, 48):
        write(tmp_path, triangle_meshes.tube(R, 1, sides))
        out = sensors(model(f"{BASE}, {BEAM}", "static: 1", at="0, 0, 0.4", velocity="0.005, 0, 0", spin="0, 0.05, 0", inertia=LONG, under=0))
        errors.append(numpy.abs(out["w.y"] - 0.05 * numpy.cos(rate * out["t"])).max())
        assert numpy.abs(out["balance"]).max() < 1e-9
    # The curvature of parabolas between the corners differs from the circle's with the square of their distance.
    assert errors[1] < 1.2e-3 and errors[0] / errors[1] == pytest.approx(4, rel=0.15)


def test_a_beam_strikes_a_tube_between_its_ends(sensors, tmp_path):
    write(tmp_path, triangle_meshes.tube(0.3, 1, 48))
    out = sensors(model(f"{BASE}, {BEAM}", "restitution: 0.6", at="0, 0, 0.6", under=0, inertia=LONG, duration="0.26 s"))
    # The surface bulges up to 1e-5 beside the circle.
    assert out["lost"][-1] == pytest.approx(2 * G * 0.2 * (1 - 0.6**2), rel=1e-4)
    assert numpy.abs(out["balance"]).max() < 1e-9


@pytest.mark.parametrize("shape", [DRUM, BEAM])
def test_runs_go_on_bit_for_bit(goes_on, tmp_path, shape):
    """Places are found from the motion alone: nothing of them has to be saved."""
    write(tmp_path, triangle_meshes.box([0.6, 0.6, 1], 2))
    text = model(f"{BASE}, {shape}", "static: 0.4, restitution: 0.3", at="0, 0, 0.2", velocity="0.5, 0.2, 0", spin="3, -2, 5", duration="0.3 s",
                 every="1 ms")
    goes_on(text, whole="0.3 s", half="0.15 s", records=301)


@pytest.mark.parametrize("seed", range(4))
def test_free_collisions_keep_momentum(sensors, tmp_path, seed):
    """Of an angle made of two bars and a drum or rod, also with friction; the account closes."""
    chance = random.Random(seed)
    shape = "{cylinder: {radius: 0.12, length: 0.3}}" if seed % 2 else "{capsule: {radius: 0.08, length: 0.3}}"
    write(tmp_path, triangle_meshes.join((triangle_meshes.box([0.3, 0.25, 0.1], 2), [0, 0, -0.05]), (triangle_meshes.box([0.1, 0.25, 0.2], 1), [0.1, 0, 0.1])))

    cylinder_cases.check_free_collision(sensors(cylinder_cases.free_collision(f"{BASE}, {shape}", chance)))


# What lies below, what is thrown on it. Of 30 seeds each none ends the run, and three leave the balance open: theory 25 §7.
THROWS = {
    "drum-on-table": (triangle_meshes.box([0.6, 0.6, 1], 2), f"{BASE}, {{cylinder: {{radius: 0.1, length: 0.25}}}}"),
    "block-on-drum": (triangle_meshes.box([0.2, 0.3, 0.15], 2), f"{{cylinder: {{radius: 0.3, length: 1}}}}, {BASE}"),
}


@pytest.mark.parametrize("seed", [0, 2, 6])
@pytest.mark.parametrize("name", THROWS)
def test_what_is_thrown_goes_on(sensors, tmp_path, name, seed):
    """Ends, sides, edges, corners and rims strike, slide and let go; nothing is gained."""
    chance = random.Random(seed)
    mesh, shapes = THROWS[name]
    write(tmp_path, mesh)
    spin = ", ".join(repr(chance.uniform(-5, 5)) for _ in range(3))
    velocity = ", ".join(repr(chance.uniform(-1, 1)) for _ in range(3))
    out = sensors(model(shapes, f"static: {chance.uniform(0.2, 1)}", at="0, 0, 0.4", velocity=velocity, spin=spin, duration="0.6 s"))
    assert out["t"][-1] == pytest.approx(0.6)
    assert out["c.gap"].min() > -1e-4
    # Errors of first order in the step, where it strikes.
    assert numpy.abs(out["balance"]).max() < 0.01 * out["lost"][-1]
