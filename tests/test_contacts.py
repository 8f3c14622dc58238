# SPDX-License-Identifier: Apache-2.0
"""Contacts among many bodies: found by themselves, equal to contacts given one by one."""

import itertools

import numpy
import pytest

BALL = "  b{k}: {{rigid: {{mass: {m}, inertia: [{j}, {j}, {j}]}}, at: {{position: [{x}, {y}, {z}]}}}}\n"
LAW = "stiffness: 2e4, restitution: 0.6, static: 0.3"
WALLS = [("[0, 0, 0]", "[0, 0, 1]"), ("[-0.2, 0, 0]", "[1, 0, 0]"), ("[0.2, 0, 0]", "[-1, 0, 0]"),
         ("[0, -0.2, 0]", "[0, 1, 0]"), ("[0, 0.2, 0]", "[0, -1, 0]")]


def spheres(count, radius=0.05, spacing=0.11, height=0.06):
    """Layers of nine, slightly out of line."""
    out = ""
    for k in range(count):
        layer, place = divmod(k, 9)
        row, column = divmod(place, 3)
        out += BALL.format(k=k, m=0.5, j=0.4 * 0.5 * radius**2, x=round((column - 1) * spacing + 0.002 * (k % 4), 6),
                           y=round((row - 1) * spacing + 0.0015 * (k % 3), 6), z=round(height + spacing * layer, 6))
    return out


def box_of(count, loads, step="0.5 ms", duration="0.3 s", sensors=""):
    return (f"buckens: 1\ngravity: [0, 0, -9.81]\nbodies:\n{spheres(count)}loads:\n{loads}"
            f"simulation: {{duration: {duration}, step: {step}}}\noutput: {{every: 10 ms, sensors: {{{sensors}}}}}\n")


def group(law=LAW):
    walls = ", ".join(f"{{on: {{ground: {point}}}, plane: {normal}}}" for point, normal in WALLS)
    return f"  heap: {{contacts: {{among: [{walls}, {{bodies: \"b*\", sphere: 50 mm}}], {law}}}}}\n"


def one_by_one(count):
    out = ""
    for k in range(count):
        for w, (point, normal) in enumerate(WALLS):
            out += f"  w{w}_{k}: {{contact: {{between: [{{ground: {point}}}, b{k}], shapes: [{{plane: {normal}}}, {{sphere: 50 mm}}], {LAW}}}}}\n"
    for i, j in itertools.combinations(range(count), 2):
        out += f"  c{i}_{j}: {{contact: {{between: [b{i}, b{j}], shapes: [{{sphere: 50 mm}}, {{sphere: 50 mm}}], {LAW}}}}}\n"
    return out


def test_a_group_is_what_its_pairs_are(sensors):
    """Twelve balls fall into a box, bounce, roll and rub: 126 contacts given one by one, and one group."""
    seen = ", ".join(f"p{k}: {{position: b{k}}}, r{k}: {{rotation: b{k}}}" for k in (0, 5, 11)) + ", lost: {energy: dissipated}"
    separate = sensors(box_of(12, one_by_one(12), sensors=seen))
    together = sensors(box_of(12, group(), sensors=seen))
    assert (separate["lost"][-1]) > 0.1  # they have hit each other
    for name in separate:
        # Both solve the same equations, to the step's tolerance of 1e-10 of the motion; impacts spread differences.
        assert together[name] == pytest.approx(separate[name], rel=1e-5, abs=1e-7), name


def test_balls_come_to_rest_in_a_box(sensors):
    out = sensors(box_of(27, group("stiffness: 2e4, restitution: 0.3, static: 0.3"), duration="1.2 s", step="1 ms",
                         sensors="heap: {contact: heap}, balance: {energy: balance}, lost: {energy: dissipated}, all: {position: b26}"))
    # The floor carries all, walls and balls press against each other in addition.
    assert out["heap.normal"][-1] > 27 * 0.5 * 9.81
    assert out["heap.touching"][-1] >= 3 * 9
    assert out["all.z"][-1] > 0.05
    assert numpy.abs(out["balance"]).max() < 0.02 * out["lost"][-1]


def test_a_cradle_hands_its_impulse_on(sensors):
    """Hertzian balls in a row, equal masses: the last leaves with (nearly) the speed of the first."""
    bodies = "".join(BALL.format(k=k, m=0.1, j=1e-5, x=0.0201 * k, y=0, z=0) for k in range(5))
    out = sensors(f"""
buckens: 1
bodies:
{bodies}loads: {{row: {{contacts: {{among: [{{bodies: [b0, "b[1-4]"], sphere: 10 mm}}], modulus: 200 GPa}}}}}}
initial: {{bodies: {{b0: {{velocity: [1, 0, 0]}}}}}}
simulation: {{duration: 1.4 ms, step: 0.5 us}}
output: {{every: 0.1 ms, sensors: {{first: {{velocity: b0}}, last: {{velocity: b4}}, kinetic: {{energy: kinetic}}}}}}
""")
    # Gaps of 0.1 mm: each impact is over before the next begins, so all of it is handed on. Second order: a thousandth.
    assert out["last.x"][-1] == pytest.approx(1, abs=1e-3)
    assert abs(out["first.x"][-1]) < 1e-3
    assert out["kinetic"][-1] == pytest.approx(0.05, rel=2e-3)


def test_lists_separate_what_touches(sensors):
    """Balls of one list pass through each other and hit the floor of the other."""
    bodies = "".join(BALL.format(k=k, m=1, j=1e-3, x=0.01 * k, y=0, z=0.12) for k in range(2))
    out = sensors(f"""
buckens: 1
gravity: [0, 0, -9.81]
bodies:
{bodies}loads: {{row: {{contacts: {{among: [{{bodies: "b*", sphere: 0.1}}], against: [{{on: ground, plane: {{}}}}], stiffness: 1e5, damping: 300}}}}}}
simulation: {{duration: 0.5 s, step: 1 ms}}
output: {{every: 50 ms, sensors: {{p: {{position: b0}}, v: {{velocity: b0}}, c: {{contact: row}}}}}}
""")
    assert out["p.x"][-1] == 0  # exactly: nothing pushes across
    assert out["p.z"][-1] == pytest.approx(0.1 - 9.81 / 1e5, abs=1e-6)
    assert out["c.touching"][-1] == 2 and out["c.normal"][-1] == pytest.approx(2 * 9.81, rel=1e-4)


def test_joined_bodies_do_not_touch_each_other(sensors):
    out = sensors("""
buckens: 1
gravity: [0, 0, -9.81]
bodies:
  a: {rigid: {mass: 1, inertia: [1e-2, 1e-2, 1e-2]}, at: {position: [0, 0, 0.3]}}
  b: {rigid: {mass: 1, inertia: [1e-2, 1e-2, 1e-2]}, at: {position: [0.15, 0, 0.3]}}
joints: {weld: {fixed: {between: [a, b]}}}
loads: {c: {contacts: {among: [{on: ground, plane: {}}, {bodies: [a, b], sphere: 0.1}], stiffness: 1e5}}}
simulation: {duration: 0.1 s, step: 1 ms}
output: {every: 10 ms, sensors: {c: {contact: c}, force: {joint-force: weld}}}
""")
    assert (out["c.touching"] == 0).all()
    assert numpy.abs(out["force.x"]).max() < 1e-9  # free fall


MODEL = """
buckens: 1
BODIES
loads: {c: {contacts: {SPEC}}}
simulation: {duration: 1 s, step: 1 ms}
"""
TWO = ("bodies: {b0: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}, at: {position: [0, 0, 0.1]}}, "
       "b1: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}, at: {position: [0, 0, 0.4]}}}")


@pytest.mark.parametrize(("spec", "code", "words"), [
    ("among: [{sphere: 0.1}], stiffness: 1e5", 2, ["needs exactly one of `on` (a marker) and `bodies`"]),
    ("among: [{on: b0, bodies: b1, sphere: 0.1}], stiffness: 1e5", 2, ["needs exactly one of `on`"]),
    ("among: [{bodies: \"bal*\", sphere: 0.1}], stiffness: 1e5", 2, ["there is no body \"bal*\""]),
    ("among: [{bodies: \"b*\", socket: 0.1}], stiffness: 1e5", 2, ["a socket and a socket cannot touch", "`against`"]),
    ("among: [{bodies: \"b*\", cylinder: {radius: 0.1, length: 0.1}}], stiffness: 1e5, exponent: 1.5", 2, ["a cylinder and a cylinder share a volume", "remove `exponent`"]),
    ("among: [{bodies: \"b*\", sphere: 0.4}], stiffness: 1e5", 2, ["b0 and b1 overlap by 0.5 m as placed"]),
    ("among: [{on: ground, plane: [0, 0, -1]}, {bodies: \"b*\", sphere: 0.1}], stiffness: 1e5", 2, ["overlap by 0.2 m", "turn the plane's normal"]),
    ("among: [{on: ground, plane: {}}, {bodies: \"b*\", box: [0.1, 0.1, 0.1]}], modulus: 1 GPa", 2, ["Hertz's theory gives no force between a plane and a box"]),
    ("among: [{bodies: \"b*\", sphere: 0.1}], stiffness: 1e5, modulus: 1 GPa", 2, ["remove one of them"]),
    ("among: [{bodies: \"b*\", sphere: 0.1}], stiffness: 1e5, restitution: 1.5", 2, ["a rebound cannot be faster"]),
    ("among: [{bodies: \"b*\", sphere: 0.1}], stiffness: 1e5, dynamic: 0.2", 2, ["swap `static` and `dynamic`"]),
])
def test_wrong_contacts_are_refused(buckens, tmp_path, spec, code, words):
    (tmp_path / "model.yaml").write_text(MODEL.replace("BODIES", TWO).replace("SPEC", spec))
    buckens("check", "model.yaml").must(code, "model.yaml:", *words)


def test_friction_needs_inertia(buckens, tmp_path):
    text = MODEL.replace("SPEC", "among: [{bodies: \"b*\", sphere: 0.1}], stiffness: 1e5, static: 0.3")
    (tmp_path / "model.yaml").write_text(text.replace("BODIES", TWO.replace("[1, 1, 1]", "[0, 0, 0]")))
    buckens("check", "model.yaml").must(3, "model.yaml:", "body \"b0\", which has no rotary inertia")


def test_flexible_bodies_of_a_group_are_what_its_pairs_are(sensors):
    """Two balls fall on a springy beam, roll on it and hit each other; then the same by single contacts."""
    shapes = {"beam/mid": "box: [0.3, 0.1, 0.02]", "b0": "sphere: 50 mm", "b1": "sphere: 50 mm"}
    law = "stiffness: 2e4, restitution: 0.7, static: 0.3"
    group = "  g: {contacts: {among: [" + ", ".join(f"{{on: {on}, {shape}}}" for on, shape in shapes.items()) + f"], {law}}}}}\n"
    pairs = "".join(f"  c{i}{j}: {{contact: {{between: [{a}, {b}], shapes: [{{{shapes[a]}}}, {{{shapes[b]}}}], {law}}}}}\n"
                    for i, a in enumerate(shapes) for j, b in enumerate(shapes) if i < j)
    out = [sensors(f"""
buckens: 1
gravity: [0, 0, -9.81]
materials: {{steel: {{E: 210 GPa, nu: 0.3, rho: 7850}}}}
bodies:
  beam: {{beam: {{to: [1, 0, 0], elements: 8, section: {{rectangle: {{width: 100 mm, height: 4 mm}}}}, material: steel}}}}
{BALL.format(k=0, m=0.5, j=5e-4, x=0.42, y=0, z=0.1)}{BALL.format(k=1, m=0.5, j=5e-4, x=0.54, y=0.001, z=0.13)}joints:
  a: {{fixed: {{between: [ground, beam/start]}}}}
loads:
{loads}simulation: {{duration: 0.3 s, step: 0.2 ms}}
output: {{every: 10 ms, sensors: {{p0: {{position: b0}}, p1: {{position: b1}}, tip: {{position: beam/end}}}}}}
""") for loads in (group, pairs)]
    assert numpy.abs(out[0]["tip.z"]).max() > 5e-3
    for name in out[0]:
        assert out[0][name] == pytest.approx(out[1][name], rel=1e-5, abs=1e-7), name


TUBE = """
buckens: 1
planar: zx
gravity: [0, 0, -9.81]
bodies:
  b0: {rigid: {mass: 0.5, inertia: [0, 1e-3, 0]}, at: {position: [-0.03, 0, 0.04999]}}
  b1: {rigid: {mass: 0.7, inertia: [0, 1e-3, 0]}, at: {position: [0.03, 0, 0.12998]}}
  b2: {rigid: {mass: 0.9, inertia: [0, 1e-3, 0]}, at: {position: [-0.03, 0, 0.20997]}}
  b3: {rigid: {mass: 1.1, inertia: [0, 1e-3, 0]}, at: {position: [0.03, 0, 0.28996]}}
loads:
LOADS
initial: {start: static}
simulation: {duration: 20 ms, step: 1 ms}
output: {every: 1 ms, sensors: {p0: {position: b0}, p1: {position: b1}, p2: {position: b2}, p3: {position: b3}, SENSORS}}
"""
TUBE_WALLS = [("[-0.07999, 0, 0]", "[1, 0, 0]"), ("[0.07999, 0, 0]", "[-1, 0, 0]")]


def tube_of_groups(law):
    walls = ", ".join(f"{{on: {{ground: {point}}}, plane: {normal}}}" for point, normal in TUBE_WALLS)
    return (f"  floor: {{contacts: {{among: [{{bodies: \"b*\", sphere: 50 mm}}], against: [{{on: ground, plane: [0, 0, 1]}}], {law}}}}}\n"
            f"  walls: {{contacts: {{among: [{{bodies: \"b*\", sphere: 50 mm}}], against: [{walls}], {law}}}}}\n"
            f"  balls: {{contacts: {{among: [{{bodies: \"b*\", sphere: 50 mm}}], {law}}}}}")


def tube_one_by_one(law):
    out = f"  f: {{contact: {{between: [ground, b0], shapes: [{{plane: [0, 0, 1]}}, {{sphere: 50 mm}}], {law}}}}}\n"
    for k, (point, normal) in enumerate(TUBE_WALLS):
        for b in range(4):
            out += f"  w{k}{b}: {{contact: {{between: [{{ground: {point}}}, b{b}], shapes: [{{plane: {normal}}}, {{sphere: 50 mm}}], {law}}}}}\n"
    for i, j in itertools.combinations(range(4), 2):
        out += f"  c{i}{j}: {{contact: {{between: [b{i}, b{j}], shapes: [{{sphere: 50 mm}}, {{sphere: 50 mm}}], {law}}}}}\n"
    return out


@pytest.mark.parametrize("law", ["stiffness: 1e5", "stiffness: 2e7, exponent: 1.5"])
def test_balls_stand_zigzag_in_a_tube(sensors, law):
    """Statics: each ball leans on a wall and carries those above; groups equal pairs given one by one."""
    out = sensors(TUBE.replace("LOADS", tube_of_groups(law)).replace(
        "SENSORS", "floor: {contact: floor}, walls: {contact: walls}, balls: {contact: balls}"))
    pairs = sensors(TUBE.replace("LOADS", tube_one_by_one(law)).replace("SENSORS", "floor: {contact: f}"))
    assert out["floor.normal"][0] == pytest.approx(3.2 * 9.81, rel=1e-9)
    for name in set(pairs) & set(out):
        assert out[name][0] == pytest.approx(pairs[name][0], rel=1e-9, abs=1e-10), name
        assert out[name] == pytest.approx(numpy.full(len(out[name]), out[name][0]), rel=1e-7, abs=1e-9) or name == "t"
    # Forces between balls carry the weight above along their lines; walls take what these push sideways.
    place = numpy.array([[out[f"p{k}.x"][0], out[f"p{k}.z"][0]] for k in range(4)])
    lines = numpy.diff(place, axis=0)
    above = 9.81 * numpy.array([2.7, 2.0, 1.1])
    force = above * numpy.linalg.norm(lines, axis=1) / lines[:, 1]
    sideways = numpy.abs(above * lines[:, 0] / lines[:, 1])
    assert out["balls.normal"][0] == pytest.approx(force.sum(), rel=1e-8)
    walls = sideways[0] + (sideways[0] + sideways[1]) + (sideways[1] + sideways[2]) + sideways[2]
    assert out["walls.normal"][0] == pytest.approx(walls, rel=1e-8)
    assert (out["floor.touching"] == 1).all() and (out["walls.touching"] == 4).all() and (out["balls.touching"] == 3).all()


def test_vibrations_of_balls_in_a_tube(buckens, tmp_path):
    found = []
    for loads in (tube_of_groups("stiffness: 1e5"), tube_one_by_one("stiffness: 1e5")):
        text = TUBE.replace("LOADS", loads).replace(", SENSORS", "")
        (tmp_path / "model.yaml").write_text(text)
        report = buckens("modes", "model.yaml", "--system", "--count", 12, "--json").must(0).json
        found.append([mode["frequency"] for mode in report["analyses"][0]["modes"]])
    # Central differences over 1e-5 of the model's length in a linear law: curvature of the lines of centres is left.
    assert len(found[0]) == 8 and found[0] == pytest.approx(found[1], rel=1e-6)
    assert found[0][-1] > 50
