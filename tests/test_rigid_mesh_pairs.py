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


@pytest.mark.parametrize("cells", [1, 3])
def test_a_tall_box_topples_over_its_edge(sensors, tmp_path, cells):
    """On 30 degrees, 0.2 wide and 0.6 high: it turns about the lower edge, which does not slip; energy alone gives the speed of turning."""
    write(tmp_path, part=triangle_meshes.box([0.2, 0.3, 0.6], cells), base=triangle_meshes.box(TABLE, cells))
    out = sensors(model(f"{BASE}, {PART}", ", static: 2", body="rigid: {mass: 3 kg, inertia: [0.1, 0.1, 0.1]}", at="0, 0, 0.3",
                        gravity=(G / 2, 0, -G * math.sqrt(3) / 2), duration="0.35 s", step="0.5 ms", every="5 ms"))
    height = (out["p.x"] - out["p.x"][0]) * G / 2 - (out["p.z"] - out["p.z"][0]) * G * math.sqrt(3) / 2
    # About the edge the inertia is 0.1 + 3 (0.1^2 + 0.3^2).
    assert out["w.y"] ** 2 == pytest.approx(2 * 3 * height / 0.4, abs=1e-5)
    assert out["w.y"][-1] > 2 and numpy.abs(out["balance"]).max() < 1e-5


@pytest.mark.parametrize("shift", [0, 0.02])
def test_a_cube_slides_off_a_cube(sensors, tmp_path, shift):
    """Over the edge, also where both are flush on the way: as boxes, up to what weight does within the step in which a corner lets go."""
    cube = "rigid: {mass: 2 kg, inertia: [0.0133, 0.0133, 0.0133]}"
    write(tmp_path, part=triangle_meshes.box([0.2, 0.2, 0.2], 2), base=triangle_meshes.box([0.2, 0.2, 0.2], 3))
    start = {"body": cube, "at": f"-0.05, {shift}, 0.1", "velocity": "0.5, 0, 0", "duration": "0.5 s"}
    mesh = sensors(model(f"{BASE}, {PART}", **start))
    box = sensors(model("{box: [0.2, 0.2, 0.2]}, {box: [0.2, 0.2, 0.2]}", **start))
    assert box["p.z"][-1] < 0.09 and box["w.y"][-1] > 3
    # With sides in line rounding decides which of two corners that slide along a border lets go first: it drifts aside.
    for name in ("p.x", "p.z") + (("p.y",) if shift else ()):
        assert mesh[name] == pytest.approx(box[name], abs=1e-3), name
    assert numpy.abs(mesh["p.y"] - shift).max() < 5e-3
    assert numpy.abs(mesh["balance"]).max() < 5e-3  # of 0.25 J


@pytest.mark.parametrize("cells", [1, 4])
def test_crossed_bars_rest_as_boxes_do(sensors, tmp_path, cells):
    """No corner of either touches: its four places are crossings of edges."""
    body = "rigid: {mass: 2 kg, inertia: [8e-4, 0.06, 0.06]}"
    write(tmp_path, part=triangle_meshes.box([0.6, 0.05, 0.05], cells), base=triangle_meshes.box([0.05, 0.6, 0.05], cells))
    start = {"body": body, "at": "0.005, 0, 0.15", "law": ", restitution: 0.4, static: 0.3", "first": "ground", "duration": "0.8 s"}
    mesh = sensors(model(f"{BASE}, {PART}", **start))
    box = sensors(model("{box: [0.05, 0.6, 0.05]}, {box: [0.6, 0.05, 0.05]}", **start))
    for name in ("p.x", "p.y", "p.z", "v.z", "w.x", "w.y", "lost"):
        assert mesh[name] == pytest.approx(box[name], abs=1e-9), name
    assert mesh["p.z"][-1] == pytest.approx(0.05, abs=1e-12) and mesh["c.normal"][-1] == pytest.approx(2 * G, rel=1e-9)


@pytest.mark.parametrize("restitution", [0.7, 1])
def test_edges_strike_edges(sensors, tmp_path, restitution):
    """Two free bars on edge, crossed at right angles: the impulse along both edges' normal, from the answers of both bodies."""
    write(tmp_path, part=triangle_meshes.box([0.6, 0.05, 0.05], 3), base=triangle_meshes.box([0.05, 0.6, 0.05], 3))
    out = sensors(f"""
buckens: 1
bodies:
  a: {{rigid: {{mass: 3 kg, inertia: [0.09, 1.2e-3, 0.09]}}, at: {{position: [0, 0, 0], orientation: {{axis: [0, 1, 0], angle: 45 deg}}}}}}
  b: {{rigid: {{mass: 2 kg, inertia: [8e-4, 0.06, 0.06]}}, at: {{position: [0.1, 0.05, 0.08], orientation: {{axis: [1, 0, 0], angle: 45 deg}}}}}}
loads: {{c: {{contact: {{between: [a, b], shapes: [{BASE}, {PART}], restitution: {restitution}}}}}}}
initial: {{bodies: {{b: {{velocity: [0, 0, -1]}}}}}}
simulation: {{duration: 0.03 s, step: 0.1 ms}}
output: {{every: 1 ms, sensors: {{va: {{velocity: a}}, vb: {{velocity: b}}, wa: {{angular-velocity: a}}, wb: {{angular-velocity: b}}, lost: {{energy: dissipated}},
  balance: {{energy: balance}}}}}}
""")
    # It is reached above a at (0, 0.05), below b at (0 - 0.1, 0) from its middle: levers along the edges.
    answer = 1 / 3 + 0.05**2 / 0.09 + 1 / 2 + 0.1**2 / 0.06
    P = (1 + restitution) / answer
    last = {name: column[-1] for name, column in out.items()}
    assert last["va.z"] == pytest.approx(-P / 3, rel=1e-9) and last["vb.z"] == pytest.approx(P / 2 - 1, rel=1e-9)
    # Turning about x, the axis of a is across it; about y, that of b is.
    assert last["wa.x"] == pytest.approx(-0.05 * P / 0.09, rel=1e-6) and last["wb.y"] == pytest.approx(0.1 * P / 0.06, rel=1e-6)
    assert last["lost"] == pytest.approx(0.5 * (1 - restitution**2) / answer, rel=1e-9, abs=1e-12)
    assert numpy.abs(out["balance"]).max() < 1e-9


def test_a_peg_goes_into_a_slot(sensors, tmp_path):
    """With 1 mm on either side of it, tilted and turned: it rattles between the walls down to the ground, which is no part of them."""
    walls = [(triangle_meshes.box([0.4, 0.1, 0.3], 2), [0, y, 0]) for y in (0.101, -0.101)]
    write(tmp_path, part=triangle_meshes.box([0.3, 0.1, 0.2], 3), base=triangle_meshes.join(*walls, (triangle_meshes.box([0.4, 0.3, 0.1], 2), [0, 0, -0.2])))
    out = sensors(model(f"{BASE}, {PART}", ", restitution: 0.2, static: 0.3", at="0, 0, 0.2", spin="0.5, 0, 0.2", first="ground"))
    assert out["p.z"][0] > 0.19 and out["p.z"][-1] == pytest.approx(-0.05, abs=1e-9)
    # Tilted by what fits, it leans to one side while its middle is above the slot.
    assert numpy.abs(out["p.y"]).max() < 2e-3 and numpy.abs(out["p.y"][out["p.z"] < 0]).max() < 1.1e-3
    assert out["c.gap"].min() > -1e-4
    assert max(numpy.abs(out[f"v.{axis}"][-1]) for axis in "xyz") < 1e-9


def test_a_box_rests_from_the_start_and_runs_go_on_bit_for_bit(sensors, goes_on, tmp_path):
    write(tmp_path, part=triangle_meshes.box([0.4, 0.3, 0.2], 2), base=triangle_meshes.box(TABLE, 2))
    rest = model(f"{BASE}, {PART}", ", static: 0.4", duration="0.2 s", start="start: static, ").replace(
        ", bodies: {b: {velocity: [0, 0, 0], angular-velocity: [0, 0, 0]}}", "")
    out = sensors(rest)
    assert numpy.abs(out["p.z"] - 0.1).max() < 1e-12 and numpy.abs(out["v.z"]).max() < 1e-12
    assert out["c.normal"] == pytest.approx(2 * G, rel=1e-9)
    text = model(f"{BASE}, {PART}", ", restitution: 0.3, static: 0.4", at="0, 0, 0.2", velocity="1, 0, 0", spin="3, -2, 5", duration="0.4 s", every="1 ms")
    goes_on(text, whole="0.4 s", half="0.2 s", records=401)


@pytest.mark.parametrize("seed", range(4))
def test_tumbling_solids_keep_their_momentum(sensors, tmp_path, seed):
    """Free in space: two blocks that are not convex strike each other again and again with e = 1 towards each other."""
    chance = random.Random(seed)

    def bent(a):
        return triangle_meshes.join((triangle_meshes.box([0.3, 0.1, 0.1], 1), [0, 0, -a / 2]), (triangle_meshes.box([0.08, 0.1, 0.2], 2), [0.1, 0, 0.15 - a / 2]))

    write(tmp_path, part=bent(0.1), base=bent(0.06))
    spin = [[chance.uniform(-6, 6) for _ in range(3)] for _ in range(2)]
    # Starts off the origin in both, so that orbital angular momentum counts.
    out = sensors(f"""
buckens: 1
bodies:
  a: {{rigid: {{mass: 3 kg, inertia: [0.02, 0.03, 0.03]}}, at: {{position: [0, 0, 0]}}}}
  b: {{rigid: {{mass: 2 kg, inertia: [0.02, 0.02, 0.025]}}, at: {{position: [0.6, 0.05, 0.02]}}}}
loads: {{c: {{contact: {{between: [a, b], shapes: [{BASE}, {PART}], restitution: 0.8, static: 0.3}}}}}}
initial: {{bodies: {{a: {{velocity: [1, 0, 0], angular-velocity: {spin[0]}}}, b: {{velocity: [-1.5, 0, 0], angular-velocity: {spin[1]}}}}}}}
simulation: {{duration: 0.4 s, step: 0.2 ms}}
output: {{every: 2 ms, sensors: {{va: {{velocity: a}}, vb: {{velocity: b}}, lost: {{energy: dissipated}}, balance: {{energy: balance}}}}}}
""")
    assert out["lost"][-1] > 0.1
    for axis, total in zip("xyz", (3 * 1 - 2 * 1.5, 0, 0)):
        assert 3 * out[f"va.{axis}"] + 2 * out[f"vb.{axis}"] == pytest.approx(total, abs=1e-10)
    # Errors of the order of a step in those with blows.
    assert numpy.abs(out["balance"]).max() < 0.02 * out["lost"][-1]


@pytest.mark.parametrize("seed", range(4))
def test_thrown_boxes_come_to_rest_on_a_table(sensors, tmp_path, seed):
    chance = random.Random(seed)
    sides = [chance.uniform(0.05, 0.3) for _ in range(3)]
    inertia = [2 / 12 * (sides[(k + 1) % 3] ** 2 + sides[(k + 2) % 3] ** 2) for k in range(3)]
    spin = ", ".join(repr(chance.uniform(-5, 5)) for _ in range(3))
    write(tmp_path, part=triangle_meshes.box(sides, 2), base=triangle_meshes.box(TABLE, 3))
    out = sensors(model(f"{BASE}, {PART}", f", static: {chance.uniform(0.4, 1.2)}", body=f"rigid: {{mass: 2 kg, inertia: {inertia}}}", at="0, 0, 0.3",
                        velocity="0.5, -0.3, 0", spin=spin, duration="1.2 s", every="10 ms"))
    assert out["t"][-1] == pytest.approx(1.2)
    assert out["c.gap"].min() > -2e-4
    assert numpy.abs(out["balance"]).max() < 0.01 * out["lost"][-1]
    assert min(abs(out["p.z"][-1] - side / 2) for side in sides) < G * 1e-6


def test_what_overlaps_as_placed_is_refused(buckens, tmp_path):
    write(tmp_path, part=triangle_meshes.box([0.4, 0.3, 0.2], 2), base=triangle_meshes.box(TABLE, 2))
    (tmp_path / "deep.yaml").write_text(model(f"{BASE}, {PART}", at="0, 0, 0.099"))
    buckens("check", "deep.yaml").must(2, "deep.yaml:5", "overlap by 0.001 m as placed", "place them apart")
