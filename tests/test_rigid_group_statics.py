# SPDX-License-Identifier: Apache-2.0
"""Equilibria and vibrations with rigid contacts among many bodies: those of the same contacts given one by one."""

import itertools
import math

import numpy
import pytest

from test_contacts import TUBE, tube_of_groups, tube_one_by_one
from test_frozen_groups import G, PLACES

RADIUS = 0.05
WALLS = {"floor": ("[0, 0, 0]", "[0, 0, 1]"), "west": ("[-0.11, 0, 0]", "[1, 0, 0]"), "east": ("[0.11, 0, 0]", "[-1, 0, 0]"),
         "south": ("[0, -0.11, 0]", "[0, 1, 0]"), "north": ("[0, 0.11, 0]", "[0, -1, 0]")}


def placed(places, shape="sphere: 50 mm"):
    """Bodies of which number k weighs 0.5 + 0.1 k kg; boxes are named c and balls b."""
    letter = "b" if shape.startswith("sphere") else "c"
    return "".join(f"  {letter}{k}: {{rigid: {{mass: {0.5 + 0.1 * k:g}, inertia: [1e-3, 1e-3, 1e-3]}}, at: {{position: {list(at)}}}}}\n"
                   for k, at in enumerate(places))


def groups(shapes, walls, law=""):
    """What stands on the floor, leans on walls, and on others: three groups."""
    own = ", ".join(f"{{on: {name}, {shape}}}" for name, shape in shapes.items())
    plane = {name: f"{{on: {{ground: {WALLS[name][0]}}}, plane: {WALLS[name][1]}}}" for name in walls}
    sides = ", ".join(plane[name] for name in walls if name != "floor")
    return (f"  floor: {{contacts: {{among: [{own}], against: [{plane['floor']}]{law}}}}}\n"
            f"  walls: {{contacts: {{among: [{own}], against: [{sides}]{law}}}}}\n  each: {{contacts: {{among: [{own}]{law}}}}}\n")


def one_by_one(shapes, walls, law=""):
    out = ""
    for wall, (name, shape) in itertools.product(walls, shapes.items()):
        point, normal = WALLS[wall]
        out += f"  {wall}_{name}: {{contact: {{between: [{{ground: {point}}}, {name}], shapes: [{{plane: {normal}}}, {{{shape}}}]{law}}}}}\n"
    for (a, one), (b, other) in itertools.combinations(shapes.items(), 2):
        out += f"  {a}_{b}: {{contact: {{between: [{a}, {b}], shapes: [{{{one}}}, {{{other}}}]{law}}}}}\n"
    return out


def heap(bodies, loads, seen, initial="{start: static}", duration="20 ms"):
    return f"""buckens: 1
gravity: [0, 0, -{G}]
bodies:
{bodies}loads:
{loads}initial: {initial}
simulation: {{duration: {duration}, step: 1 ms}}
output: {{every: 2 ms, sensors: {{{seen}}}}}
"""


def apart(tube):
    """The balls of test_contacts.py, which are pressed together there, a little away from each other and the walls."""
    for k, z in enumerate([0.04999, 0.12998, 0.20997, 0.28996]):
        tube = tube.replace(f"{z}]", f"{0.05 + 0.1 * k}]")
    return tube.replace("0.03, 0,", "0.029, 0,")


def positions(shapes):
    return ", ".join(f"p{name}: {{position: {name}}}, v{name}: {{velocity: {name}}}" for name in shapes)


READ = "floor: {contact: floor}, walls: {contact: walls}, each: {contact: each}"

# Four balls in the corners of a tray, one between and above them, as they lie, and above their places. Ten: a second layer
# of the same, turned, cannot stand; so two trays beside each other, with five each.
FIVE = [(-0.055, -0.055, 0.05), (0.055, -0.053, 0.05), (0.054, 0.055, 0.05), (-0.053, 0.054, 0.05), (0.004, 0.003, 0.125)]


@pytest.mark.parametrize("lift", [0.0, 0.03])
def test_balls_lie_in_a_tray_as_by_their_contacts_one_by_one(sensors, lift):
    """The uppermost ball spreads the four below it against the walls. They begin where they fall together."""
    places = [(x, y, z + lift * (1 + k)) for k, (x, y, z) in enumerate(FIVE)]
    shapes = {f"b{k}": "sphere: 50 mm" for k in range(5)}
    out = sensors(heap(placed(places), groups(shapes, WALLS), positions(shapes) + ", " + READ))
    pairs = sensors(heap(placed(places), one_by_one(shapes, WALLS), positions(shapes)))
    weight = sum(0.5 + 0.1 * k for k in range(5)) * G
    assert out["floor.normal"] == pytest.approx(numpy.full(len(out["t"]), weight), rel=1e-9)
    assert out["pb4.z"][0] - 0.05 > 0.02 and (out["floor.touching"] == 4).all() and (out["walls.touching"] == 8).all()
    for name in shapes:
        for axis in "xyz":
            assert out[f"p{name}.{axis}"] == pytest.approx(numpy.full(len(out["t"]), pairs[f"p{name}.{axis}"][0]), abs=1e-11), name
            assert numpy.abs(out[f"v{name}.{axis}"]).max() < 1e-10
    # Whatever holds the uppermost ball points from the others' centres to its own, and four such forces carry it.
    centre = numpy.array([out[f"pb4.{a}"][0] for a in "xyz"])
    lines = numpy.array([centre - [out[f"pb{k}.{a}"][0] for a in "xyz"] for k in range(4)])
    assert numpy.linalg.norm(lines, axis=1) == pytest.approx(2 * RADIUS, abs=1e-11)
    assert out["each.normal"][0] == pytest.approx(0.9 * G * 2 * RADIUS / lines[0, 2], rel=1e-9)  # all are equally steep


BRICKS = [(-0.06, 0, 0.05), (-0.06, 0, 0.15), (-0.055, 0, 0.25), (-0.06, 0, 0.35)]
BALLS = [(0.055, -0.06, 0.05), (0.056, 0.058, 0.06), (0.06, 0.002, 0.15), (0.055, -0.06, 0.23), (0.055, 0.06, 0.24)]


@pytest.mark.parametrize("bricks, balls", [(3, 0), (2, 3), (2, 5), (4, 3)])
def test_a_heap_of_balls_and_boxes_stands(sensors, bricks, balls):
    """Boxes on boxes beside balls between walls, without friction: what they press the floor with is their weight, and they stay."""
    shapes = {**{f"c{k}": "box: [0.1, 0.2, 0.1]" for k in range(bricks)}, **{f"b{k}": "sphere: 50 mm" for k in range(balls)}}
    bodies = placed(BRICKS[:bricks], "box") + placed(BALLS[:balls])
    out = sensors(heap(bodies, groups(shapes, WALLS), positions(shapes) + ", " + READ, duration="8 ms"))
    weight = G * (sum(0.5 + 0.1 * k for k in range(bricks)) + sum(0.5 + 0.1 * k for k in range(balls)))
    # Rows give by 1e-10 of what changes in a step; those that share a load are found anew with 1e-6.
    assert out["floor.normal"] == pytest.approx(numpy.full(len(out["t"]), weight), rel=1e-8)
    for name in shapes:
        for axis in "xyz":
            place = out[f"p{name}.{axis}"]
            assert place == pytest.approx(numpy.full(len(place), place[0]), abs=1e-9), name
    assert [out[f"pc{k}.z"][0] for k in range(bricks)] == pytest.approx([0.05 + 0.1 * k for k in range(bricks)], abs=1e-9)


@pytest.mark.parametrize("law", ["restitution: 0", "static: 0.3"])
def test_balls_stand_zigzag_in_a_tube(sensors, law):
    """Each ball leans on a wall and carries those above; they fall together from 20 mm above each other."""
    text = apart(TUBE)
    out = sensors(text.replace("LOADS", tube_of_groups(law)).replace(
        "SENSORS", "floor: {contact: floor}, walls: {contact: walls}, balls: {contact: balls}"))
    pairs = sensors(text.replace("LOADS", tube_one_by_one(law)).replace("SENSORS", "floor: {contact: f}"))
    assert out["floor.normal"][0] == pytest.approx(3.2 * 9.81, rel=1e-10)
    for name in set(pairs) & set(out) - {"t"}:
        assert out[name][0] == pytest.approx(pairs[name][0], rel=1e-11, abs=1e-13), name
        assert out[name] == pytest.approx(numpy.full(len(out[name]), out[name][0]), rel=1e-9, abs=1e-12), name
    # Centres stand 59.98 mm apart sideways, so 80.0149... mm above each other.
    rise = math.sqrt(0.1**2 - 0.05998**2)
    assert [out[f"p{k}.z"][0] for k in range(4)] == pytest.approx([0.05 + rise * k for k in range(4)], abs=1e-12)
    above = 9.81 * numpy.array([2.7, 2.0, 1.1])
    assert out["balls.normal"][0] == pytest.approx((above * 0.1 / rise).sum(), rel=1e-10)
    sideways = above * 0.05998 / rise
    assert out["walls.normal"][0] == pytest.approx(2 * sideways.sum(), rel=1e-10)
    assert (out["floor.touching"] == 1).all() and (out["walls.touching"] == 4).all() and (out["balls.touching"] == 3).all()
    assert numpy.abs(out["floor.friction"] + out["walls.friction"] + out["balls.friction"]).max() < 1e-9


BOXES = {"a": "box: [0.4, 0.3, 0.2]", "b": "box: [0.36, 0.28, 0.2]", "c": "box: [0.32, 0.26, 0.2]"}


def pile(angle, together, mu, more="", friction="frozen", lift=0.0):
    """Three boxes on each other on an incline: gravity is turned instead. Faces of equal boxes would hold each other at their sides."""
    slope = math.radians(angle)
    bodies = "".join(f"  {name}: {{rigid: {{mass: 10 kg, inertia: [0.2, 0.2, 0.2]}}, at: {{position: [0, 0, {z + lift * (1 + k)}]}}}}\n"
                     for k, (name, z) in enumerate(PLACES.items()))
    if together:
        members = ", ".join(f"{{on: {name}, {box}}}" for name, box in BOXES.items())
        loads = f"  pile: {{contacts: {{among: [{{on: ground, plane: {{}}}}, {members}], static: {mu}}}}}\n"
        sensors = "pile: {contact: pile}"
    else:
        loads = "".join(f"  floor_{name}: {{contact: {{between: [ground, {name}], shapes: [{{plane: {{}}}}, {{{box}}}], static: {mu}}}}}\n" for name, box in BOXES.items())
        loads += "".join(f"  {i}_{j}: {{contact: {{between: [{i}, {j}], shapes: [{{{one}}}, {{{other}}}], static: {mu}}}}}\n"
                         for (i, one), (j, other) in itertools.combinations(BOXES.items(), 2))
        sensors = "floor: {contact: floor_a}, lower: {contact: a_b}, upper: {contact: b_c}"
    seen = ", ".join(f"p{name}: {{position: {name}}}" for name in PLACES)
    return f"""buckens: 1
gravity: [{G * math.sin(slope)!r}, 0, {-G * math.cos(slope)!r}]
bodies:
{bodies}loads:
{loads}{more}static: {{friction: {friction}, steps: 4}}
initial: {{start: static, friction: {friction}}}
simulation: {{duration: 5 ms, step: 1 ms}}
output: {{every: 5 ms, sensors: {{{seen}, {sensors}}}}}
"""


@pytest.mark.parametrize("angle, lift", [(0, 0.0), (15, 0.0), (0, 0.01)])
def test_a_pile_is_held_as_by_its_contacts_one_by_one(static_path, sensors, angle, lift):
    pull = "  pull: {force: {on: c, value: [4, 0, 0]}}\n"
    slope = math.radians(angle)
    together, summary = static_path(pile(angle, True, 0.5, pull, lift=lift))
    separate, _ = static_path(pile(angle, False, 0.5, pull, lift=lift))
    normal, along = 10 * G * math.cos(slope), 10 * G * math.sin(slope)
    pulled = 4 * together["load-factor"]
    assert separate["load-factor"] == pytest.approx(together["load-factor"], abs=1e-12)
    assert together["pile.normal"] == pytest.approx(numpy.full(len(pulled), 6 * normal), rel=1e-9)
    assert together["pile.friction"] == pytest.approx(6 * along + 3 * pulled, rel=1e-9, abs=1e-8)
    for quantity in ("normal", "friction"):
        singly = separate["floor." + quantity] + separate["lower." + quantity] + separate["upper." + quantity]
        assert together["pile." + quantity] == pytest.approx(singly, rel=1e-9, abs=1e-8)
    assert (together["pile.touching"] == 3).all() and summary["trust"] == "ok"
    starts = sensors(pile(angle, True, 0.5, lift=lift), "-q"), sensors(pile(angle, False, 0.5, lift=lift), "-q")
    for name in (f"p{body}.{axis}" for body in PLACES for axis in "xyz"):
        assert together[name] == pytest.approx(separate[name], abs=1e-11), name
        assert starts[0][name] == pytest.approx(starts[1][name], abs=1e-11), name
        assert starts[0][name] == pytest.approx(numpy.full(2, starts[0][name][0]), abs=1e-11), name
    assert starts[0]["pile.normal"] == pytest.approx(6 * normal * numpy.ones(2), rel=1e-9)


def test_what_friction_cannot_hold_is_named_by_its_bodies(buckens, tmp_path):
    """On 15 degrees mu = 0.2 is too little: all three pairs ask for 0.268."""
    (tmp_path / "pile.yaml").write_text(pile(15, True, 0.2))
    buckens("run", "pile.yaml", "-o", "out").must(0, 'frozen friction "pile" between "a" and "b"', 'between "ground" and "a"', "ratio 1.339")


def test_nothing_holds_what_no_pair_carries(buckens, tmp_path):
    (tmp_path / "pile.yaml").write_text(pile(15, True, 0.2, friction="free"))
    buckens("run", "pile.yaml", "-o", "out").must(3, "no static equilibrium", "`friction: frozen`")


GUIDED = f"""buckens: 1
gravity: [0, 0, -{G}]
bodies:
  upper: {{rigid: {{mass: 1 kg, inertia: [0.01, 0.01, 0.01]}}, at: {{position: [0, 0, 0.5]}}}}
  lower: {{rigid: {{mass: 2 kg, inertia: [0.01, 0.01, 0.01]}}, at: {{position: [0, 0, 0.2]}}}}
joints:
  way: {{prismatic: {{between: [ground, upper], axis: [0, 0, 1]}}}}
  other: {{prismatic: {{between: [ground, lower], axis: [0, 0, 1]}}}}
loads:
  hangs: {{spring-damper: {{between: [{{ground: [0, 0, 1.5]}}, upper], stiffness: 100 N/m, length: 1 m}}}}
  stands: {{spring-damper: {{between: [{{ground: [0, 0, -1]}}, lower], stiffness: 200 N/m, length: 1.3 m}}}}
  LOADS
  push: {{force: {{on: upper, value: [0, 0, -80]}}}}
static: {{steps: 20, method: METHOD}}
output: {{sensors: {{p: {{position: upper}}, q: {{position: lower}}SEEN}}}}
"""


@pytest.mark.parametrize("method", ["load", "arc-length"])
def test_a_path_leads_bodies_together_that_were_apart(static_path, method):
    """The upper ball sinks onto the lower one, and both onto the floor: pairs come on the way. Heights are piecewise linear."""
    group = "c: {contacts: {among: [{on: ground, plane: {}}, {bodies: [upper, lower], sphere: 50 mm}]}}"
    single = ("c: {contact: {between: [lower, upper], shapes: [{sphere: 50 mm}, {sphere: 50 mm}]}}\n  d: {contact: {between: [ground, lower], shapes: [{plane: {}}, {sphere: 50 mm}]}}\n"
              "  e: {contact: {between: [ground, upper], shapes: [{plane: {}}, {sphere: 50 mm}]}}")
    text = GUIDED.replace("METHOD", method)
    out, _ = static_path(text.replace("LOADS", group).replace("SEEN", ", c: {contact: c}"))
    alone, _ = static_path(text.replace("LOADS", single).replace("SEEN", ", c: {contact: c}, d: {contact: d}"))
    mu = out["load-factor"]
    free = 0.5 - (G + 80 * mu) / 100
    below = 0.3 - 2 * G / 200  # the lower one alone
    joint = numpy.maximum((100 * 0.5 + 200 * (0.3 + 0.1) - 3 * G - 80 * mu) / 300, 0.15)  # the upper one on the lower one, at most down to the floor
    meet = free < below + 0.1
    assert out["p.z"] == pytest.approx(numpy.where(meet, joint, free), abs=1e-10)
    assert out["q.z"] == pytest.approx(numpy.where(meet, joint - 0.1, below), abs=1e-10)
    assert (~meet).sum() > 2 and (meet & (joint > 0.15)).sum() > 2 and (joint == 0.15).sum() > 2
    assert out["c.normal"][-1] == pytest.approx(alone["c.normal"][-1] + alone["d.normal"][-1], rel=1e-9)
    assert out["p.z"][-1] == pytest.approx(alone["p.z"][-1], abs=1e-12)


def test_vibrations_about_an_equilibrium_with_groups(buckens, tmp_path):
    """Balls in a tube that a spring each holds sideways: rows that press are joints, whoever gives them."""
    found, notes = [], []
    springs = "".join(f"\n  s{k}: {{spring-damper: {{between: [{{ground: [0, 0, {1 + k}]}}, b{k}], stiffness: {100 + 30 * k} N/m, length: 0.5 m}}}}" for k in range(4))
    for loads in (tube_of_groups("restitution: 0"), tube_one_by_one("restitution: 0")):
        text = apart(TUBE).replace("LOADS", loads + springs).replace(", SENSORS", "")
        (tmp_path / "model.yaml").write_text(text)
        reports = [buckens("modes", "model.yaml", "--system", "--about", about, "--count", 6, "--json").must(0).json["analyses"][0]
                   for about in ("static", "initial")]
        found.append([(r["rigid_modes"], [mode["frequency"] for mode in r["modes"]]) for r in reports])
    for one, other in zip(*found):
        assert one[0] == other[0]
        assert one[1] == pytest.approx(other[1], rel=1e-7)  # what differences of 1e-5 leave
