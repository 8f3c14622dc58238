# SPDX-License-Identifier: Apache-2.0
"""Equilibria with rows that only push, rigid stops, ropes and contacts, and with frozen friction: exact reactions and places."""

import csv
import itertools
import json
import math

import numpy
import pytest

from conftest import SOURCE

G = 9.81
ROUNDING = 1e-10  # relative: converged by Newton to some ten roundings of the forces


@pytest.fixture
def at_start(sensors):
    """What the sensors say in the equilibrium from which a run starts, and at its end."""

    def call(text, *arguments):
        out = sensors(text, *arguments)
        return {name: values[0] for name, values in out.items()}, {name: values[-1] for name, values in out.items()}

    return call


@pytest.fixture
def path(buckens, tmp_path):
    """Columns of a static path, its summary, and what was printed."""

    def call(text, *arguments):
        (tmp_path / "path.yaml").write_text(text)
        result = buckens("static", "path.yaml", "-o", "path", *arguments).must(0)
        rows = list(csv.reader((tmp_path / "path" / "sensors.csv").open()))
        columns = {name.split(" [")[0]: numpy.array([float(row[i]) for row in rows[1:]]) for i, name in enumerate(rows[0])}
        return columns, json.loads((tmp_path / "path" / "summary.json").read_text()), result

    return call


BALL = f"""
buckens: 1
gravity: [0, 0, -{G}]
bodies: {{ball: {{rigid: {{mass: 3 kg, inertia: [0.01, 0.01, 0.01]}}, at: {{position: [0, 0, HEIGHT]}}}}}}
loads: {{floor: {{contact: {{between: [ground, ball], shapes: [{{plane: {{}}}}, {{sphere: 0.1}}], static: 0.3}}}}}}
initial: {{start: static}}
simulation: {{duration: 0.2 s, step: 5 ms}}
output: {{every: 50 ms, sensors: {{p: {{position: ball}}, f: {{contact: floor}}}}}}
"""


@pytest.mark.parametrize("height", ["0.1", "0.35"])  # as placed: it touches, or hangs above
def test_a_ball_rests_on_a_plane(at_start, height):
    first, last = at_start(BALL.replace("HEIGHT", height))
    for now in (first, last):  # and stays at rest as the motion begins
        assert now["f.normal"] == pytest.approx(3 * G, rel=ROUNDING)
        assert now["p.z"] == pytest.approx(0.1, abs=1e-12)
        assert now["f.gap"] == pytest.approx(0, abs=1e-12)


def test_what_assembly_moves_into_another_is_pushed_out_and_named(buckens, sensors):
    """Closing the hinge moves the rod down by a quarter of the 50 mm, and the ball at its middle into the floor."""
    text = f"""
buckens: 1
planar: xy
gravity: [0, -{G}, 0]
bodies: {{rod: {{rigid: {{mass: 2 kg, com: [0.5, 0, 0], inertia: [0, 0, {2 / 12}]}}, at: {{position: [0, 0.1, 0]}}, markers: {{o: {{position: [0, 0, 0]}}, m: {{position: [0.5, 0, 0]}}}}}}}}
joints: {{hinge: {{revolute: {{between: [{{ground: [0, 0.05, 0]}}, rod/o]}}}}}}
loads: {{floor: {{contact: {{between: [ground, rod/m], shapes: [{{plane: [0, 1, 0]}}, {{sphere: 0.1}}]}}}}}}
initial: {{start: static}}
simulation: {{duration: 10 ms, step: 5 ms}}
output: {{every: 10 ms, sensors: {{p: {{position: rod/m}}, f: {{contact: floor}}, h: {{joint-force: hinge}}}}}}
"""
    out = sensors(text)
    assert out["f.normal"] == pytest.approx(2 * G, rel=1e-9)  # right below the middle: the hinge carries nothing
    assert out["p.y"] == pytest.approx(0.1, abs=1e-12)
    assert abs(out["h.y"]).max() < 1e-8
    # The work of the least motion in the mass metric, of a uniform rod moved at its end.
    buckens("run", "model.yaml", "-o", "again").must(0, "load \"floor\"", "beyond its end", "begins by pushing it out")


def test_vibrations_of_a_ball_on_a_plane(buckens, tmp_path):
    """Pressed by its weight it cannot leave the plane: five motions without resistance, and one across a spring."""
    spring = "  side: {spring-damper: {between: [{ground: [-1, 0, 0.1]}, ball], stiffness: 1200 N/m, length: 1 m}}\n"
    text = BALL.replace("HEIGHT", "0.1").replace("loads: {floor:", "loads:\n  floor:").replace("static: 0.3}}}", "static: 0.3}}\n" + spring)
    (tmp_path / "ball.yaml").write_text(text)

    def about(where):
        return buckens("modes", "ball.yaml", "--system", "--about", where, "--count", 1, "--json").must(0).json["analyses"][0]

    pressed = about("static")
    assert pressed["rigid_modes"] == 4  # along y, and three rotations
    assert pressed["modes"][0]["frequency"] == pytest.approx(math.sqrt(1200 / 3) / (2 * math.pi), rel=1e-8)
    # Unloaded, nothing presses, and the ball may rise.
    assembled = about("initial")
    assert assembled["rigid_modes"] == 5
    assert any("\"floor\" touch, but no contact force acts" in note for note in assembled["notes"])


GUIDED = f"""
buckens: 1
gravity: [0, 0, -{G}]
bodies: {{ball: {{rigid: {{mass: 3 kg, inertia: [0.01, 0.01, 0.01]}}, at: {{position: [0, 0, 0.1]}}}}}}
joints: {{way: {{prismatic: {{between: [ground, ball], axis: [0, 0, 1]}}}}}}
loads:
  floor: {{contact: {{between: [ground, ball], shapes: [{{plane: {{}}}}, {{sphere: 0.1}}]}}}}
  push: {{force: {{on: ball, value: [0, 0, -10]}}}}
static: {{steps: 5}}
simulation: {{duration: 1 s, step: 5 ms}}
output: {{every: 50 ms, sensors: {{p: {{position: ball}}, f: {{contact: floor}}}}}}
"""


@pytest.mark.parametrize("method", ["load", "arc-length"])
def test_a_path_presses_a_ball_on_a_plane(path, method):
    columns, summary, _ = path(GUIDED, "--set", f"static.method={method}")
    assert columns["f.normal"] == pytest.approx(3 * G + 10 * columns["load-factor"], rel=ROUNDING)
    assert numpy.abs(columns["p.z"] - 0.1).max() < 1e-12
    assert summary["status"] == "finished" and columns["load-factor"][-1] == 1


PENDULUM = f"""
buckens: 1
planar: xy
gravity: [0, -{G}, 0]
bodies: {{arm: {{rigid: {{mass: 2 kg, com: [0.4, 0, 0], inertia: [0, 0, 0.1]}}, markers: {{o: {{position: [0, 0, 0]}}}}}}}}
joints: {{hinge: {{revolute: {{between: [ground, arm/o]}}}}}}
loads: {{LOADS}}
initial: {{start: static}}
simulation: {{duration: 0.1 s, step: 1 ms}}
output: {{every: 10 ms, sensors: {{phi: {{joint-coordinate: hinge}}, m: {{spring-torque: stop}}, f: {{joint-force: hinge}}}}}}
"""


@pytest.mark.parametrize("count", [1, 2])
def test_a_pendulum_rests_on_its_stop(at_start, count):
    """Placed level it falls on the stop at -30 degrees. Two equal stops share the moment."""
    stop = "{hinge-stop: {joint: hinge, from: -30 deg, to: 80 deg}}"
    loads = ", ".join(f"{name}: {stop}" for name in ["stop", "other"][:count])
    for now in at_start(PENDULUM.replace("LOADS", loads)):
        assert now["phi.value"] == pytest.approx(-math.pi / 6, abs=1e-12)
        # The sensor counts forces against the coordinate.
        assert now["m"] == pytest.approx(-2 * G * 0.4 * math.cos(math.pi / 6) / count, rel=1e-9)
        assert now["f.y"] == pytest.approx(2 * G, rel=ROUNDING)


def test_a_pendulum_that_does_not_reach_its_stop_hangs(at_start):
    first, _ = at_start(PENDULUM.replace("LOADS", "stop: {hinge-stop: {joint: hinge, from: -100 deg}}"))
    assert first["phi.value"] == pytest.approx(-math.pi / 2, abs=1e-9)
    assert first["m"] == 0


def test_a_stop_that_contradicts_a_joint_is_named(buckens, tmp_path):
    """A drive holds the arm beyond its stop: no force of the stop helps."""
    text = PENDULUM.replace("LOADS", "stop: {hinge-stop: {joint: hinge, from: -10 deg}}").replace(
        "joints: {hinge:", "joints: {drive: {prescribed-rotation: {between: [ground, arm/o], angle: -20 deg}}, hinge:")
    (tmp_path / "model.yaml").write_text(text)
    buckens("run", "model.yaml", "-o", "out").must(4, "no static equilibrium", "load \"stop\" does not close")


def test_a_weight_falls_into_its_rope(at_start):
    text = f"""
buckens: 1
gravity: [0, 0, -{G}]
bodies: {{weight: {{rigid: {{mass: 5 kg, inertia: [1, 1, 1]}}, at: {{position: [0.3, 0.1, -0.5]}}}}}}
loads: {{rope: {{rope: {{between: [ground, weight], length: 2 m}}}}}}
initial: {{start: static}}
simulation: {{duration: 50 ms, step: 5 ms}}
output: {{every: 50 ms, sensors: {{p: {{position: weight}}, f: {{spring-force: rope}}}}}}
"""
    for now in at_start(text):
        assert [now["p.x"], now["p.y"], now["p.z"]] == pytest.approx([0, 0, -2], abs=1e-8)  # where it is flat
        assert now["f"] == pytest.approx(5 * G, rel=1e-9)


# Bending stiffness and line mass of the beams below.
LENGTH, SIDE, E, RHO = 1.0, 0.02, 2e11, 7800
EI, MASS_PER_LENGTH = E * SIDE**4 / 12, RHO * SIDE**2

BEAM = f"""
buckens: 1
planar: xy
gravity: [0, -GRAVITY, 0]
materials: {{steel: {{E: 200 GPa, nu: 0.3, rho: {RHO}}}}}
bodies:
  beam:
    beam: {{to: [{LENGTH}, 0, 0], elements: 16, section: {{rectangle: {{width: {SIDE}, height: {SIDE}}}}}, material: steel}}
    markers: {{middle: {{position: [{LENGTH / 2}, 0, 0]}}}}
joints: {{clamp: {{fixed: {{between: [ground, beam/start]}}}}}}
loads:
  rest: {{contact: {{between: [{{ground: [{LENGTH}, -GAP, 0]}}, beam/end], shapes: [{{plane: [0, 1, 0]}}, {{sphere: 1e-9}}]}}}}
  push: {{force: {{on: beam/middle, value: [0, -4, 0]}}}}
static: {{steps: 8}}
simulation: {{duration: 1 s, step: 5 ms}}
output:
  every: 50 ms
  sensors:
    tip: {{position: beam/end}}
    middle: {{position: beam/middle}}
    f: {{contact: rest}}
"""


@pytest.mark.parametrize("method", ["load", "arc-length"])
def test_a_beam_comes_to_rest_on_a_support(path, method):
    """Loaded in the middle, a cantilever reaches a support below its tip and is propped from there on: two straight lines."""
    full = 5 * 4 * LENGTH**3 / (48 * EI)  # tip without the support
    gap = 0.4 * full
    columns, summary, _ = path(BEAM.replace("GRAVITY", "0").replace("GAP", f"{gap + 1e-9:.15e}"), "--set", f"static.method={method}")
    load = 4 * columns["load-factor"]
    free = load * LENGTH**3 / EI
    reaction = numpy.maximum(0, (5 / 48 * free - gap) * 3 * EI / LENGTH**3)
    # Rotations of 1e-4 rad change lengths by their squares.
    assert columns["f.normal"] == pytest.approx(reaction, abs=1e-6)
    assert -columns["tip.y"] == pytest.approx(numpy.minimum(5 / 48 * free, gap), abs=1e-6 * gap)
    middle = free / 24 - reaction * 5 * LENGTH**3 / (48 * EI)
    assert -columns["middle.y"] == pytest.approx(middle, abs=1e-6 * gap)
    assert (reaction == 0).sum() >= 3 and (reaction > 0.1).sum() >= 3
    assert summary["trust"] == "ok"


def test_a_beam_lifts_off_again(path):
    """The same path the other way: what was pressed lets go."""
    gap = 0.4 * 5 * 4 * LENGTH**3 / (48 * EI)
    columns, _, _ = path(BEAM.replace("GRAVITY", "0").replace("GAP", f"{gap + 1e-9:.15e}"), "--set", "static.load-factor=[1, 0]")
    free = 4 * columns["load-factor"] * LENGTH**3 / EI
    assert -columns["tip.y"] == pytest.approx(numpy.minimum(5 / 48 * free, gap), abs=1e-6 * gap)
    assert -columns["tip.y"][0] == pytest.approx(gap, rel=1e-6) and abs(-columns["tip.y"][-1]) < 1e-12


def test_a_beam_on_a_support_vibrates_as_a_propped_one(buckens, tmp_path):
    (tmp_path / "beam.yaml").write_text(BEAM.replace("GRAVITY", str(G)).replace("GAP", "1e-9").replace("-4, 0", "0, 0"))

    def first(where):
        out = buckens("modes", "beam.yaml", "--system", "--about", where, "--count", 2, "--json").must(0).json["analyses"][0]
        return out["modes"][0]["frequency"] * 2 * math.pi * math.sqrt(MASS_PER_LENGTH * LENGTH**4 / EI), out

    # Roots of tan x = tanh x, and of cos x cosh x = -1. 16 elements: (kh)^4/720 = 5e-8; sag of 0.1 mm couples along and across.
    propped, report = first("static")
    assert propped == pytest.approx(15.41820572, rel=1e-5)
    assert not any("touch" in note for note in report["notes"])
    free, report = first("initial")
    assert free == pytest.approx(3.51601527, rel=1e-5)
    assert any("\"rest\" touch, but no contact force acts" in note for note in report["notes"])


def box(angle, friction, mu, mass_centre=(0, 0, 0), loads="", more=""):
    """A box of 0.4 x 0.3 x 0.2 m on a plane that is inclined along x: gravity is turned instead."""
    slope = math.radians(angle)
    return f"""
buckens: 1
gravity: [{G * math.sin(slope)!r}, 0, {-G * math.cos(slope)!r}]
bodies: {{box: {{rigid: {{mass: 10 kg, com: {list(mass_centre)}, inertia: [0.2, 0.2, 0.2]}}, at: {{position: [0, 0, 0.1]}}, markers: {{m: {{position: [0, 0, 0]}}}}}}}}
loads:
  floor: {{contact: {{between: [ground, box/m], shapes: [{{plane: {{}}}}, {{box: [0.4, 0.3, 0.2]}}], static: {mu}}}}}
{loads}
initial: {{start: static, friction: {friction}}}
static: {{friction: {friction}, steps: 4{more}}}
simulation: {{duration: 50 ms, step: 5 ms}}
output: {{every: 50 ms, sensors: {{p: {{position: box/m}}, f: {{contact: floor}}}}}}
"""


@pytest.mark.parametrize("centre", [(0, 0, 0), (0.05, -0.08, 0.02), (0.19, 0.14, 0)])
def test_a_box_rests_on_its_four_corners(at_start, centre):
    """Four corners for three equations: their sum is the weight wherever it is."""
    for now in at_start(box(0, "free", 0, centre)):
        assert now["f.normal"] == pytest.approx(10 * G, rel=1e-9)
        assert now["p.z"] == pytest.approx(0.1, abs=1e-11)


@pytest.mark.parametrize("mu, words", [(0.5, []), (0.25, ["frozen friction \"floor\" holds", "ratio 1.45588", "would slide"])])
def test_a_box_on_an_incline_is_held_by_frozen_friction(buckens, sensors, tmp_path, mu, words):
    text = box(20, "frozen", mu)
    out = sensors(text)
    slope = math.radians(20)
    assert out["f.normal"][0] == pytest.approx(10 * G * math.cos(slope), rel=1e-9)
    assert math.tan(slope) / 0.25 == pytest.approx(1.45588, abs=1e-5)
    if mu > math.tan(slope):  # and friction goes on holding
        assert out["f.friction"] == pytest.approx(10 * G * math.sin(slope), rel=1e-9)
        # In the first step a row along a surface gives by 1e-10 of the model's length, and is not put back.
        assert numpy.abs(out["p.x"]).max() < 1e-10
    (tmp_path / "box.yaml").write_text(text)
    shown = buckens("run", "box.yaml", "-o", "again").must(0, *words)
    assert ("frozen friction" in shown.err) == bool(words)


def test_a_path_drags_a_box_to_the_limit_of_its_friction(path):
    """Friction is the load; the summary tells how far beyond its limit it goes."""
    columns, summary, _ = path(box(0, "frozen", 0.3, loads="  pull: {force: {on: box/m, value: [40, 0, 0]}}"))
    assert columns["f.friction"] == pytest.approx(40 * columns["load-factor"], rel=1e-9, abs=1e-9)
    assert columns["f.normal"] == pytest.approx(10 * G, rel=1e-9)
    told = [text for text in summary["trust"] if "frozen friction \"floor\"" in text]
    assert len(told) == 1 and "at load factor 1 " in told[0]
    assert f"ratio {40 / (0.3 * 10 * G):.6g}" in told[0]


def test_without_friction_a_box_slides_off(buckens, tmp_path):
    (tmp_path / "box.yaml").write_text(box(20, "free", 0.5))
    buckens("run", "box.yaml", "-o", "out").must(3, "body \"box\"", "nothing holds it", "friction: frozen")


def test_a_ladder_leans_on_a_smooth_wall(at_start):
    """Floor and wall touch small balls at both ends; the floor alone is rough. Statically determined."""
    length, radius, angle, mass = 3.0, 0.01, math.radians(65), 12.0
    top = [radius, radius + length * math.sin(angle), 0]
    foot = [radius + length * math.cos(angle), radius, 0]
    centre = [(a + b) / 2 for a, b in zip(top, foot)]
    local = [[f - c for f, c in zip(end, centre)] for end in (foot, top)]
    text = f"""
buckens: 1
planar: xy
gravity: [0, -{G}, 0]
bodies:
  ladder:
    rigid: {{mass: {mass}, inertia: [0, 0, 9]}}
    at: {{position: {centre}}}
    markers: {{foot: {{position: {local[0]}}}, top: {{position: {local[1]}}}}}
loads:
  floor: {{contact: {{between: [ground, ladder/foot], shapes: [{{plane: [0, 1, 0]}}, {{sphere: {radius}}}], static: 0.4}}}}
  wall: {{contact: {{between: [ground, ladder/top], shapes: [{{plane: [1, 0, 0]}}, {{sphere: {radius}}}]}}}}
initial: {{start: static, friction: frozen}}
simulation: {{duration: 20 ms, step: 1 ms}}
output: {{every: 20 ms, sensors: {{floor: {{contact: floor}}, wall: {{contact: wall}}, p: {{position: ladder}}}}}}
"""
    # Moments about the place on the floor: the wall pushes at the height of its ball.
    wall = mass * G * length / 2 * math.cos(angle) / (length * math.sin(angle) + radius)
    for now in at_start(text):
        assert now["floor.normal"] == pytest.approx(mass * G, rel=1e-9)
        assert now["wall.normal"] == pytest.approx(wall, rel=1e-9)
        assert now["floor.friction"] == pytest.approx(wall, rel=1e-9)
        # In the first step a row along a surface gives by 1e-10 of the model's length, and is not put back.
        assert [now["p.x"], now["p.y"]] == pytest.approx(centre[:2], abs=1e-10 * length)


ARM = f"""
buckens: 1
planar: xy
gravity: [0, -{G}, 0]
bodies: {{arm: {{rigid: {{mass: 2 kg, com: [0.4, 0, 0], inertia: [0, 0, 0.1]}}, markers: {{o: {{position: [0, 0, 0]}}, tip: {{position: [0.8, 0, 0]}}}}}}}}
joints: {{hinge: {{revolute: {{between: [ground, arm/o]}}}}}}
loads:
  rub: {{hinge-friction: {{joint: hinge, static: 0.2, radius: RADIUS, stick: STICK}}}}
  push: {{force: {{on: arm/tip, value: [0, -5, 0]}}}}
static: {{friction: frozen, steps: 4}}
initial: {{start: static, friction: frozen}}
simulation: {{duration: 10 ms, step: 1 ms}}
output: {{every: 10 ms, sensors: {{phi: {{joint-coordinate: hinge}}, m: {{spring-torque: rub}}, f: {{joint-force: hinge}}}}}}
"""


@pytest.mark.parametrize("stick", ["elastic", "rigid"])
def test_frozen_friction_holds_an_arm(path, stick):
    columns, summary, _ = path(ARM.replace("STICK", stick).replace("RADIUS", "3"))
    factor = columns["load-factor"]
    assert numpy.abs(columns["phi.value"]).max() < 1e-12
    assert -columns["m"] == pytest.approx(2 * G * 0.4 + 5 * 0.8 * factor, rel=1e-9)
    assert columns["f.y"] == pytest.approx(2 * G + 5 * factor, rel=ROUNDING)
    assert summary["trust"] == "ok"


def test_an_arm_beyond_the_limit_of_its_friction_is_named_with_the_ratio(path, buckens, tmp_path):
    _, summary, _ = path(ARM.replace("STICK", "rigid").replace("RADIUS", "20 mm"))
    # Most at the start: the reaction grows faster than the moment.
    ratio = max((2 * G * 0.4 + 4 * f) / (0.2 * 0.02 * (2 * G + 5 * f)) for f in (0, 1))
    assert len(summary["trust"]) == 1 and f"ratio {ratio:.6g}" in summary["trust"][0]
    assert "\"rub\"" in summary["trust"][0]


def test_a_frozen_joint_does_not_vibrate(buckens, tmp_path):
    """A slide on a spring with friction: frozen it is a joint, free it swings."""
    text = f"""
buckens: 1
gravity: [0, 0, -{G}]
bodies:
  table: {{rigid: {{mass: 4 kg, inertia: [1, 1, 1]}}, at: {{position: [0, 0, 0]}}}}
  cart: {{rigid: {{mass: 1 kg, inertia: [1, 1, 1]}}, at: {{position: [0, 0, 0.1]}}}}
joints:
  rail: {{prismatic: {{between: [ground, table], axis: [1, 0, 0]}}}}
  slide: {{prismatic: {{between: [table, cart], axis: [1, 0, 0]}}}}
loads:
  big: {{slide-spring: {{joint: rail, stiffness: 500 N/m}}}}
  small: {{slide-spring: {{joint: slide, stiffness: 80 N/m}}}}
  rub: {{slide-friction: {{joint: slide, static: 0.2}}}}
"""
    (tmp_path / "cart.yaml").write_text(text)

    def frequencies(*more):
        out = buckens("modes", "cart.yaml", "--system", "--about", "static", "--count", 2, "--json", *more).must(0).json["analyses"][0]
        return [mode["frequency"] * 2 * math.pi for mode in out["modes"]]

    assert frequencies("--set", "initial.friction=frozen") == pytest.approx([math.sqrt(500 / 5)], rel=1e-8)
    assert len(frequencies()) == 2


def carts_by_trial(K, force, low, high):
    """Positions and forces of stops for carts in a row: of all combinations of open, at the low and at the high stop, the one that has the right signs."""
    n = len(force)
    for choice in itertools.product((0, 1, 2), repeat=n):
        x = numpy.where(numpy.array(choice) == 1, low, numpy.where(numpy.array(choice) == 2, high, 0.0))
        open_ = numpy.array(choice) == 0
        if open_.any():
            x[open_] = numpy.linalg.solve(K[numpy.ix_(open_, open_)], force[open_] - K[numpy.ix_(open_, ~open_)] @ x[~open_])
        push = K @ x - force  # of the stops
        push[open_] = 0
        at = numpy.array(choice)
        if (x >= low - 1e-12).all() and (x <= high + 1e-12).all() and (push[at == 1] >= 0).all() and (push[at == 2] <= 0).all():
            return x, push
    raise AssertionError("no combination")


@pytest.mark.parametrize("seed", range(6))
def test_carts_in_a_row_find_their_stops(at_start, seed):
    """Five carts coupled by springs, each between two rigid stops: against all 243 combinations."""
    random = numpy.random.default_rng(seed)
    n = 5
    own, between = random.uniform(50, 200, n), random.uniform(100, 1000, n - 1)
    force = random.uniform(-200, 200, n)
    low, high = -random.uniform(0.01, 0.15, n), random.uniform(0.01, 0.15, n)
    K = numpy.diag(own)
    for i, k in enumerate(between):
        K[i:i + 2, i:i + 2] += k * numpy.array([[1, -1], [-1, 1]])
    names = range(n)
    text = "buckens: 1\nbodies:\n"
    text += "".join(f"  c{i}: {{rigid: {{mass: 1 kg, inertia: [1, 1, 1]}}, at: {{position: [{i}, 0, 0]}}}}\n" for i in names)
    text += "joints:\n" + "".join(f"  g{i}: {{prismatic: {{between: [{{ground: [{i}, 0, 0]}}, c{i}], axis: [1, 0, 0]}}}}\n" for i in names)
    text += "loads:\n"
    for i in names:
        text += f"  own{i}: {{slide-spring: {{joint: g{i}, stiffness: {own[i]!r} N/m}}}}\n"
        text += f"  pull{i}: {{force: {{on: c{i}, value: [{force[i]!r}, 0, 0]}}}}\n"
        text += f"  stop{i}: {{slide-stop: {{joint: g{i}, from: {low[i]!r} m, to: {high[i]!r} m}}}}\n"
    text += "".join(f"  s{i}: {{spring-damper: {{between: [c{i}, c{i + 1}], stiffness: {k!r} N/m, length: 1 m}}}}\n" for i, k in enumerate(between))
    text += "initial: {start: static}\nsimulation: {duration: 1 ms, step: 1 ms}\noutput: {every: 1 ms, sensors: {"
    text += ", ".join(f"x{i}: {{joint-coordinate: g{i}}}, f{i}: {{spring-force: stop{i}}}" for i in names) + "}}\n"
    first, _ = at_start(text)
    x, push = carts_by_trial(K, force, low, high)
    assert [first[f"x{i}.value"] for i in names] == pytest.approx(x, abs=1e-11)
    assert [-first[f"f{i}"] for i in names] == pytest.approx(push, abs=1e-8)
    assert (push != 0).any()


def test_frozen_friction_of_an_elastic_contact_holds_a_box(path):
    """The box sinks in by its springs and is held along; the pull adds to what the incline asks for."""
    text = box(20, "frozen", 0.9, loads="  pull: {force: {on: box/m, value: [40, 0, 0]}}").replace("static: 0.9", "static: 0.9, stiffness: 1e6")
    columns, summary, _ = path(text)
    slope = math.radians(20)
    factor = columns["load-factor"]
    assert columns["f.normal"] == pytest.approx(10 * G * math.cos(slope), rel=1e-9)
    assert columns["f.friction"] == pytest.approx(10 * G * math.sin(slope) + 40 * factor, rel=1e-9)
    # Springs differ by the moment of the friction, 0.1 m below the middle; the place of the middle is that of their mean.
    assert columns["p.z"] == pytest.approx(0.1 - 10 * G * math.cos(slope) / 4e6, abs=1e-8)
    assert summary["trust"] == "ok"


@pytest.mark.parametrize("among", [False, True])
@pytest.mark.parametrize("angle", [0, 20])
def test_a_box_held_by_friction_rocks_on_its_springs(buckens, tmp_path, angle, among):
    """Friction holds two ways along the face and the turn about its normal, so that heaving and two ways of rocking are left."""
    text = box(angle, "frozen", 0.9).replace("static: 0.9", "static: 0.9, stiffness: 1e6")
    if among:
        text = text.replace("contact: {between: [ground, box/m], shapes: [{plane: {}}, {box: [0.4, 0.3, 0.2]}]",
                            "contacts: {among: [{on: ground, plane: {}}, {on: box/m, box: [0.4, 0.3, 0.2]}]").replace(", f: {contact: floor}", "")
    (tmp_path / "box.yaml").write_text(text)
    out = buckens("modes", "box.yaml", "--system", "--about", "static", "--json").must(0).json["analyses"][0]
    k, weight = 4e6, 10 * G * math.cos(math.radians(angle))
    height = 0.1 - weight / k
    rocking = [math.sqrt((k * a**2 - weight * height) / (0.2 + 10 * height**2)) for a in (0.15, 0.2)]
    expected = sorted([*rocking, math.sqrt(k / 10)])
    assert out["rigid_modes"] == 0
    # Friction tilts the box by 2e-5 rad, and so changes the height of the middle above the held corner by 1e-4 of it.
    assert [mode["frequency"] * 2 * math.pi for mode in out["modes"]] == pytest.approx(expected, rel=1e-4)
    assert not any("unstable" in note for note in out.get("notes", []))


def test_a_truss_that_snaps_meets_a_stop(path):
    """Beyond its limit load the apex comes to rest on a stop: the load falls down to there, and then only presses on the stop."""
    text = (SOURCE / "examples" / "snap_through" / "snap_through.yaml").read_text()
    text = text.replace("loads:\n", "loads:\n  rest: {contact: {between: [{ground: [0, 0.1, 0]}, left/apex], shapes: [{plane: [0, 1, 0]}, {sphere: 1e-9}]}}\n")
    text = text.replace("    force: {joint-force: left_foot}\n", "    stop: {contact: rest}\n")
    columns, summary, _ = path(text)
    at, placed = 0.1 - 1e-9, math.hypot(1, 0.2)  # where the small ball touches; length of a bar

    def carried(w):
        return 2 * 2e5 * (placed - numpy.hypot(1, 0.2 - w)) / placed * (0.2 - w) / numpy.hypot(1, 0.2 - w)

    load = 1000 * columns["load-factor"]
    # Newton's method ends at rounding of the forces in the bars, of 3 kN.
    assert columns["stop.normal"] == pytest.approx(load - carried(columns["w"]), abs=1e-5)
    assert columns["w"].max() == pytest.approx(at, abs=1e-11)
    on_stop = columns["stop.normal"] > 1e-3
    assert on_stop.sum() >= 4 and (columns["w"][on_stop] == pytest.approx(at, abs=1e-11))
    assert load[-1] == 1000
    kinds = [(point["kind"], point["load_factor"]) for point in summary["static_path"]["critical_points"]]
    assert [kind for kind, _ in kinds] == ["limit point", "limit point"]
    assert kinds[1][1] == pytest.approx(carried(at) / 1000, rel=1e-9)
    assert summary["status"] == "finished"
