# SPDX-License-Identifier: Apache-2.0
"""Rigid contact of surfaces of triangles with planes and spheres: what analytic shapes do, on exact motions."""

import math
import pathlib
import random
import sys

import numpy
import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent / "support"))

import triangle_meshes  # noqa: E402

G = 9.81
STL = "{stl: {file: part.stl, unit: 1 m}}"
SENSORS = "p: {position: b}, v: {velocity: b}, w: {angular-velocity: b}, c: {contact: c}, lost: {energy: dissipated}, balance: {energy: balance}"


def model(shapes, law="", body="rigid: {mass: 2 kg, inertia: [0.0217, 0.0333, 0.0417]}", at="0, 0, 0.1", velocity="0, 0, 0", spin="0, 0, 0",
          gravity=(0, 0, -G), duration="1 s", step="1 ms", every="20 ms", first="ground"):
    return f"""
buckens: 1
gravity: [{gravity[0]!r}, {gravity[1]!r}, {gravity[2]!r}]
bodies: {{b: {{{body}, at: {{position: [{at}]}}}}}}
loads: {{c: {{contact: {{between: [{first}, b], shapes: [{shapes}]{law}}}}}}}
initial: {{bodies: {{b: {{velocity: [{velocity}], angular-velocity: [{spin}]}}}}}}
simulation: {{duration: {duration}, step: {step}}}
output: {{every: {every}, sensors: {{{SENSORS}}}}}
"""


def write(tmp_path, mesh):
    triangle_meshes.write_stl(tmp_path / "part.stl", *mesh, text=True)


@pytest.mark.parametrize("cells", [1, 2, 29])
def test_a_box_of_triangles_slides_and_sticks_on_an_incline(sensors, tmp_path, cells):
    write(tmp_path, triangle_meshes.box([0.4, 0.3, 0.2], cells))
    slope = (G / 2, 0, -G * math.sqrt(3) / 2)
    out = sensors(model(f"{{plane: {{}}}}, {STL}", ", static: 0.3", gravity=slope, step="2 ms"))
    a = G / 2 - 0.3 * G * math.sqrt(3) / 2
    assert out["p.x"] == pytest.approx(0.5 * a * out["t"] ** 2, abs=1e-12)
    assert out["p.z"] == pytest.approx(0.1, abs=1e-14)
    assert out["c.normal"][1:] == pytest.approx(G * math.sqrt(3), rel=1e-9)
    assert numpy.abs(out["balance"]).max() < 1e-11
    out = sensors(model(f"{{plane: {{}}}}, {STL}", ", static: 0.7", gravity=slope, step="2 ms"))
    assert numpy.abs(out["p.x"]).max() < 1e-15 and numpy.abs(out["v.x"]).max() < 1e-14
    assert out["c.friction"][1:] == pytest.approx(G, rel=1e-9)


@pytest.mark.parametrize("cells", [1, 2, 10])
def test_a_box_of_triangles_tumbles_like_a_box(sensors, tmp_path, cells):
    """Only its eight corners are places, however its faces are divided; one step after the other is the same."""
    write(tmp_path, triangle_meshes.box([0.4, 0.3, 0.2], cells))
    fall = {"at": "0, 0, 0.5", "velocity": "1, -0.5, 0", "spin": "2, 3, 1"}
    mesh = sensors(model(f"{{plane: {{}}}}, {STL}", ", restitution: 0.5, static: 0.5", **fall))
    box = sensors(model("{plane: {}}, {box: [0.4, 0.3, 0.2]}", ", restitution: 0.5, static: 0.5", **fall))
    assert box["lost"][-1] > 5 and numpy.ptp(box["p.y"]) > 0.1
    for name in ("p.x", "p.y", "p.z", "v.x", "w.x", "w.y", "w.z"):
        # The same rows in another order: rounding, which blows of a tumbling body enlarge.
        assert mesh[name] == pytest.approx(box[name], abs=1e-9), name


def test_a_box_of_triangles_loses_what_its_restitution_says(sensors, tmp_path):
    write(tmp_path, triangle_meshes.box([0.2, 0.2, 0.2], 5))
    out = sensors(model(f"{{plane: {{}}}}, {STL}", ", restitution: 0.5", at="0, 0, 0.4", duration="0.4 s", every="1 ms"))
    first = math.sqrt(2 * 0.3 / G)
    since = out["t"][out["t"] > first + 1e-3] - first
    assert out["lost"][-1] == pytest.approx(2 * G * 0.3 * (1 - 0.5**2), rel=1e-12)
    assert out["p.z"][-len(since):] == pytest.approx(0.1 + 0.5 * G * first * since - G / 2 * since**2, abs=1e-12)
    assert numpy.abs(out["w.x"]).max() == 0
    assert numpy.abs(out["balance"]).max() < 1e-12


@pytest.mark.parametrize("friction", ["", ", static: 0.4"])
def test_a_stool_stands_on_three_legs(sensors, tmp_path, friction):
    legs = [(triangle_meshes.box([0.05, 0.05, 0.3], 4), [0.2 * math.cos(a), 0.2 * math.sin(a), 0]) for a in (0.1, 2.2, 4.3)]
    write(tmp_path, triangle_meshes.join(*legs, (triangle_meshes.box([0.5, 0.5, 0.05], 3), [0, 0, 0.2])))
    out = sensors(model(f"{{plane: {{}}}}, {STL}", f", restitution: 0.2{friction}", at="0, 0, 0.2", duration="1.5 s"))
    rests = out["t"] > 1
    assert out["p.z"][rests] == pytest.approx(0.15, abs=1e-12)
    assert out["c.normal"][rests] == pytest.approx(2 * G, rel=1e-9)
    for name in ("v.x", "v.y", "v.z", "w.x", "w.y", "w.z"):
        assert numpy.abs(out[name][rests]).max() < 1e-13
    assert numpy.ptp(out["p.x"][rests]) < 1e-14
    # Blows one shortly after the other have errors of the order of a step.
    assert numpy.abs(out["balance"]).max() < 1e-4


@pytest.mark.parametrize("levels", [1, 4])
def test_a_globe_of_triangles_rolls(sensors, tmp_path, levels):
    """42 corners, and 2562 in 24 groups: it rolls over its facets, slower the larger they are."""
    write(tmp_path, triangle_meshes.globe(0.1, levels))
    out = sensors(model(f"{{plane: {{}}}}, {STL}", ", static: 0.6", body="rigid: {mass: 2 kg, inertia: [8e-3, 8e-3, 8e-3]}", at="0, 0, 0.15",
                        velocity="1.5, 0.2, 0", duration="0.8 s"))
    assert out["c.gap"].min() > -G * 1e-6
    assert numpy.all(out["c.friction"] <= 0.6 * out["c.normal"] * (1 + 1e-6) + 1e-9)
    # Errors of first order in the step, where it strikes.
    assert numpy.abs(out["balance"]).max() < 0.02 * out["lost"][-1]
    if levels == 4:
        # Of a sphere 5/7 of its speed remain; facets inclined by some 0.03 take a thousandth each, of which it passes 200.
        late = out["t"] > 0.6
        assert numpy.all((out["v.x"][late] > 0.8 * 1.5 * 5 / 7) & (out["v.x"][late] < 1.5 * 5 / 7))
        assert out["w.y"][late] == pytest.approx(out["v.x"][late] / 0.1, rel=0.02)


BALL = "rigid: {mass: 0.5 kg, inertia: [5e-4, 5e-4, 5e-4]}"  # 2/5 m r^2 with r = 50 mm


def test_a_sphere_bounces_and_rolls_over_a_plate_as_over_a_plane(sensors, tmp_path):
    write(tmp_path, triangle_meshes.plate(3.0, 12))
    mesh, plane = (sensors(model(f"{shape}, {{sphere: 50 mm}}", ", restitution: 0.6, static: 0.2", body=BALL, at="-1.2, -0.6, 0.07",
                                 velocity="2.5, 1, -0.5", duration="0.6 s")) for shape in (STL, "{plane: {}}"))
    assert plane["p.x"][-1] - plane["p.x"][0] > 0.4
    for name in ("p.x", "p.y", "p.z", "v.x", "v.z"):
        # The places of blows differ: on planes that of the sphere, else halfway, while a step goes on into the surface.
        assert mesh[name] == pytest.approx(plane[name], abs=1e-5), name
    assert numpy.abs(mesh["balance"]).max() < 1e-5


@pytest.mark.parametrize("friction, close", [(0, 3e-5), (0.3, 5e-3)])
def test_a_sphere_goes_over_the_edge_of_a_block_as_over_that_of_a_box(sensors, tmp_path, friction, close):
    """At the edge both faces are places, each of which sticks or slides with its share: with friction it leaves otherwise by some of the step."""
    write(tmp_path, triangle_meshes.box([0.4, 0.4, 0.4], 4))
    mesh, box = (sensors(model(f"{shape}, {{sphere: 50 mm}}", f", static: {friction}", body=BALL, at="0, 0, 0.05", velocity="0.5, 0.1, 0",
                               first="{ground: [0, 0, -0.2]}", duration="0.8 s")) for shape in (STL, "{box: [0.4, 0.4, 0.4]}"))
    assert box["p.z"][-1] < -0.1
    for name in ("p.x", "p.y", "p.z", "v.x", "v.z"):
        assert mesh[name] == pytest.approx(box[name], abs=close), name
    assert numpy.abs(mesh["balance"]).max() < 3e-5


def test_a_sphere_in_a_groove_touches_both_walls(sensors, tmp_path):
    write(tmp_path, triangle_meshes.groove(2.0, 1.0, 6))
    out = sensors(model(f"{STL}, {{sphere: 50 mm}}", ", static: 0.2", body=BALL, at="0, 0.02, 0.2", duration="0.8 s"))
    late = out["t"] > 0.6
    assert out["p.z"][late] == pytest.approx(0.05 * math.sqrt(2), abs=1e-12)
    assert numpy.abs(out["p.y"][late]).max() < 1e-12
    # Walls at 45 degrees: the least they carry is that without friction, which the blow may leave stuck in between.
    assert numpy.all(out["c.normal"][late] >= 0.5 * G * math.sqrt(2) / (1 + 0.2) - 1e-9)
    assert max(numpy.abs(out[f"v.{axis}"][late]).max() for axis in "xyz") < 1e-12


def test_a_sphere_rolls_in_a_bowl_of_triangles_as_in_a_socket(sensors, tmp_path):
    """Facets bulge: of a sphere the error falls with more than the third power of their size."""
    start = {"at": f"{0.449 * math.sin(0.5)!r}, 0, {-0.449 * math.cos(0.5)!r}", "duration": "0.8 s", "body": BALL}
    socket = sensors(model("{socket: 0.5}, {sphere: 50 mm}", ", static: 0.5", **start))
    errors = []
    for cells in (12, 24):
        write(tmp_path, triangle_meshes.bowl(0.5, cells))
        mesh = sensors(model(f"{STL}, {{sphere: 50 mm}}", ", static: 0.5", **start))
        errors.append(max(numpy.abs(mesh[name] - socket[name]).max() for name in ("p.x", "p.y", "p.z")))
    assert errors[1] < 2e-4 and errors[1] < errors[0] / 3


def test_runs_go_on_bit_for_bit(goes_on, tmp_path):
    """Places are found from the motion alone: nothing of them has to be saved."""
    write(tmp_path, triangle_meshes.globe(0.1, 2))
    text = model(f"{{plane: {{}}}}, {STL}", ", restitution: 0.3, static: 0.4", at="0, 0, 0.2", velocity="1, 0, 0", spin="3, -2, 5", duration="0.4 s",
                 every="1 ms")
    goes_on(text, whole="0.4 s", half="0.2 s", records=401)


def test_what_overlaps_as_placed_is_refused(buckens, tmp_path):
    """In binary STL files, which have seven digits, 0.1 is 0.1000000015."""
    triangle_meshes.write_stl(tmp_path / "part.stl", *triangle_meshes.box([0.2, 0.2, 0.2], 3))
    (tmp_path / "digits.yaml").write_text(model(f"{{plane: {{}}}}, {STL}"))
    buckens("check", "digits.yaml").must(2, "digits.yaml:5", "overlap by 1.49e-09 m as placed", "place them apart")
    (tmp_path / "apart.yaml").write_text(model(f"{{plane: {{}}}}, {STL}", at="0, 0, 0.100001"))
    buckens("check", "apart.yaml").must(0)
    (tmp_path / "inside.yaml").write_text(model(f"{STL}, {{sphere: 50 mm}}", body=BALL, at="0, 0, 0"))
    buckens("check", "inside.yaml").must(2, "inside.yaml:5", "overlap by", "place them apart")


def thrown(seed, mesh, inertia):
    chance = random.Random(seed)
    return model(f"{{plane: {{}}}}, {STL}", f", static: {chance.uniform(0.4, 1)}", body=f"rigid: {{mass: 2 kg, inertia: {inertia}}}", at="0, 0, 0.3",
                 velocity="0.5, -0.3, 0", spin=", ".join(repr(chance.uniform(-5, 5)) for _ in range(3)), duration="1.2 s", every="10 ms"), mesh


def prism(sides, radius, height):
    corners = [(radius * math.cos(2 * math.pi * k / sides), radius * math.sin(2 * math.pi * k / sides), z) for z in (-height / 2, height / 2)
               for k in range(sides)] + [(0, 0, -height / 2), (0, 0, height / 2)]
    cells = []
    for k in range(sides):
        after = (k + 1) % sides
        cells += [(k, after, sides + after), (k, sides + after, sides + k), (2 * sides, after, k), (2 * sides + 1, sides + k, sides + after)]
    return numpy.array(corners), cells


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("sides", [3, 12, 40])
def test_prisms_tumble_and_come_to_rest(sensors, tmp_path, sides, seed):
    text, mesh = thrown(seed, prism(sides, 0.1, 0.12), [6e-3, 6e-3, 8e-3])
    write(tmp_path, mesh)
    out = sensors(text)
    assert out["t"][-1] == pytest.approx(1.2)
    # A record may fall on the end of a step with a blow.
    assert out["c.gap"].min() > -4e-3 and out["c.gap"][-1] > -G * 1e-6
    assert numpy.abs(out["balance"]).max() < 0.02 * out["lost"][-1]
