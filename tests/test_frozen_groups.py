# SPDX-License-Identifier: Apache-2.0
"""Frozen friction of contacts among many bodies in statics: that of the same contacts given one by one."""

import itertools
import math

import numpy
import pytest

G = 9.81
LAW = "stiffness: 1e6, static: MU"
PLACES = {"a": 0.1, "b": 0.3, "c": 0.5}


def pile(angle, together, mu, friction="frozen", more=""):
    """Three boxes on each other on an incline: gravity is turned instead. They begin a little off their equilibrium."""
    slope = math.radians(angle)
    bodies = "".join(f"  {name}: {{rigid: {{mass: 10 kg, inertia: [0.2, 0.2, 0.2]}}, at: {{position: [0, 0, {z}]}}}}\n" for name, z in PLACES.items())
    law = LAW.replace("MU", str(mu))
    if together:
        loads = f"  pile: {{contacts: {{among: [{{on: ground, plane: {{}}}}, {{bodies: [a, b, c], box: [0.4, 0.3, 0.2]}}], {law}}}}}\n"
        sensors = "pile: {contact: pile}"
    else:
        loads = "".join(f"  floor_{name}: {{contact: {{between: [ground, {name}], shapes: [{{plane: {{}}}}, {{box: [0.4, 0.3, 0.2]}}], {law}}}}}\n" for name in PLACES)
        loads += "".join(f"  {i}_{j}: {{contact: {{between: [{i}, {j}], shapes: [{{box: [0.4, 0.3, 0.2]}}, {{box: [0.4, 0.3, 0.2]}}], {law}}}}}\n"
                         for i, j in itertools.combinations(PLACES, 2))
        sensors = "floor: {contact: floor_a}, lower: {contact: a_b}, upper: {contact: b_c}"
    seen = ", ".join(f"p{name}: {{position: {name}}}, r{name}: {{rotation: {name}}}" for name in PLACES)
    return f"""buckens: 1
gravity: [{G * math.sin(slope)!r}, 0, {-G * math.cos(slope)!r}]
bodies:
{bodies}loads:
{loads}{more}static: {{friction: {friction}, steps: 4}}
initial: {{start: static, friction: {friction}}}
simulation: {{duration: 5 ms, step: 1 ms}}
output: {{every: 5 ms, sensors: {{{seen}, {sensors}}}}}
"""


@pytest.mark.parametrize("angle", [0, 15])
def test_a_pile_is_held_as_by_its_contacts_one_by_one(static_path, sensors, angle):
    """Three boxes press and pull on the floor, two and one on those below; where they come to rest, and start from."""
    pull = "  pull: {force: {on: c, value: [4, 0, 0]}}\n"
    slope = math.radians(angle)
    together, summary = static_path(pile(angle, True, 0.5, more=pull))
    separate, _ = static_path(pile(angle, False, 0.5, more=pull))
    normal = 10 * G * math.cos(slope)
    along = 10 * G * math.sin(slope)
    pulled = 4 * together["load-factor"]
    ones = numpy.ones(len(pulled))
    assert separate["floor.normal"] == pytest.approx(3 * normal * ones, rel=1e-8)
    # The boxes tilt by about a thousandth as they sink in, and the places between them with them.
    assert separate["upper.friction"] == pytest.approx(along + pulled, rel=2e-3, abs=2e-2)
    for quantity in ("normal", "friction"):
        one_by_one = separate["floor." + quantity] + separate["lower." + quantity] + separate["upper." + quantity]
        assert together["pile." + quantity] == pytest.approx(one_by_one, rel=2e-7, abs=1e-7)  # what Newton leaves
    assert together["pile.friction"] == pytest.approx(6 * along + 3 * pulled, rel=2e-3, abs=5e-2)
    assert (together["pile.touching"] == 3).all() and summary["trust"] == "ok"
    starts = sensors(pile(angle, True, 0.5), "-q"), sensors(pile(angle, False, 0.5), "-q")
    for name in together:
        if name[0] in "pr" and name[1] in PLACES:
            # Rows along a surface hold rates only, and give by 1e-10 of the model's length in each of some steps.
            assert together[name] == pytest.approx(separate[name], abs=1e-8), name
            assert starts[0][name][0] == pytest.approx(starts[1][name][0], abs=1e-8), name


def test_what_takes_more_than_friction_gives_is_named_with_its_ratio(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(pile(20, True, 0.25))
    ratio = math.tan(math.radians(20)) / 0.25
    buckens("run", "model.yaml", "-o", "out").must(0, "frozen friction \"pile\" between \"ground\" and \"a\" holds", "between \"a\" and \"b\"",
                                                     f"ratio {ratio:.6g}", "would slide")


def test_a_path_drags_a_pile(static_path):
    """40 N on the upper box: each of the three places takes them."""
    pull = "  pull: {force: {on: c, value: [40, 0, 0]}}\n"
    together, summary = static_path(pile(0, True, 0.3, more=pull))
    separate, _ = static_path(pile(0, False, 0.3, more=pull))
    # The floor alone does not tilt.
    assert separate["floor.friction"] == pytest.approx(40 * together["load-factor"], rel=1e-8, abs=1e-8)
    for quantity in ("normal", "friction"):
        one_by_one = separate["floor." + quantity] + separate["lower." + quantity] + separate["upper." + quantity]
        assert together["pile." + quantity] == pytest.approx(one_by_one, rel=2e-7, abs=1e-7)  # what Newton leaves
    for name in PLACES:
        # The upper boxes move by tilting, 0.1 mm; rows of rates leave places that depend on the steps of the path.
        assert together[f"p{name}.x"] == pytest.approx(separate[f"p{name}.x"], rel=1e-3, abs=1e-8)
    told = [text for text in summary["trust"] if "frozen friction" in text]
    assert len(told) == 1 and "frozen friction \"pile\" between \"b\" and \"c\"" in told[0]
    # They tilt by less than a thousandth.
    assert float(told[0].split("ratio ")[1].split(")")[0]) == pytest.approx(40 / (0.3 * 10 * G), rel=1e-3)


def test_without_friction_the_pile_slides_off(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(pile(15, True, 0.5, "free"))
    buckens("run", "model.yaml", "-o", "out").must(3, "nothing holds it", "friction: frozen")


def test_a_frozen_group_holds_vibrations_along_its_surfaces(buckens, tmp_path):
    """One box on a floor, on springs at its four corners: up and down, and two ways of tilting."""
    found = []
    for together in (True, False):
        text = pile(0, together, 0.5).replace("[a, b, c]", "[a]")
        text = "\n".join(line for line in text.splitlines() if not line.startswith(("  b:", "  c:", "output", "  floor_b", "  floor_c", "  a_", "  b_")))
        (tmp_path / "model.yaml").write_text(text)
        result = buckens("modes", "model.yaml", "--system", "--about", "static", "--count", 6, "--json").must(0)
        found.append([mode["frequency"] for mode in result.json["analyses"][0]["modes"]])
    assert found[0] == pytest.approx(found[1], rel=1e-9) and len(found[0]) == 3
    # Differences of forces leave 1e-7.
    assert found[0][1] == pytest.approx(math.sqrt(4e6 / 10) / (2 * math.pi), rel=1e-6)


def test_a_static_path_shows_what_a_group_presses_with(static_path):
    """A ball on a guide, without friction: its weight and what is put on it."""
    out, _ = static_path("""buckens: 1
gravity: [0, 0, -10]
bodies: {a: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}, at: {position: [0, 0, 0.1]}}}
joints: {guide: {prismatic: {between: [ground, a], axis: [0, 0, 1]}}}
loads:
  c: {contacts: {among: [{on: ground, plane: {}}, {bodies: [a], sphere: 0.1}], stiffness: 1e5}}
  push: {force: {on: a, value: [0, 0, -5]}}
static: {steps: 2}
output: {sensors: {c: {contact: c}}}
""")
    assert out["c.normal"] == pytest.approx(10 + 5 * out["load-factor"], rel=1e-9)
    assert (out["c.touching"] == 1).all()
