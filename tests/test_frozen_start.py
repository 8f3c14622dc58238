# SPDX-License-Identifier: Apache-2.0
"""Runs that start from statics with frozen friction of elastic contacts: what holds there goes on holding from the first instant."""

import math

import numpy
import pytest

G = 9.81
STIFFNESS = 1e6  # of each corner


ALONE = "contact: {between: [ground, b], shapes: [{plane: [0, 0, 1]}, {box: [0.4, 0.4, 0.2]}]"
AMONG = "contacts: {among: [{on: ground, plane: {}}, {bodies: [b], box: [0.4, 0.4, 0.2]}]"


def incline(angle, height, mu, touch=ALONE, more=""):
    """A body of 1 kg on an incline; gravity is turned instead."""
    slope = math.radians(angle)
    return f"""
buckens: 1
gravity: [{G * math.sin(slope)!r}, 0, {-G * math.cos(slope)!r}]
bodies: {{b: {{rigid: {{mass: 1, inertia: [0.004, 0.004, 0.004]}}, at: {{position: [0, 0, {height}]}}}}}}
loads:
  c: {{{touch}, static: {mu}, stiffness: {STIFFNESS}}}}}
{more}initial: {{start: static, friction: frozen}}
simulation: {{duration: 1 s, step: 1 ms}}
output: {{every: 10 ms, sensors: {{p: {{position: b}}, r: {{rotation: b}}, c: {{contact: c}}, rubbed: {{energy: contact-friction}}}}}}
"""


# Just touching, within an overlap, a hair's breadth above, and far above.
@pytest.mark.parametrize("height", [0.1, 0.099999, 0.100001, 0.3])
def test_a_box_stays_where_it_starts(sensors, height):
    angle = 30
    out = sensors(incline(angle, height, 0.578))  # tan 30° = 0.57735
    slope = math.radians(angle)
    # It tilts as it sinks in: the lower corners carry the moment of friction, M = m g sin(30°) 0.1 m, over 4 corners 0.2 m from the
    # middle. The middle of the box moves with it, 0.1 m above the surface.
    tilt = G * math.sin(slope) * 0.1 / (4 * STIFFNESS * 0.2**2)
    # From afar it falls the way its weight points until it touches; nearer than 1e-5 of the model's length, 1 m, it is held at once.
    # In each step a row along a surface gives by 1e-10 of that length, and a fall ends within 1e-9 of the surface.
    gap = height - 0.1
    fallen = gap * math.tan(slope) if gap > 1e-5 else 0.0
    assert out["p.x"][0] == pytest.approx(fallen + 0.1 * tilt, abs=1e-9 if gap > 1e-5 else 2e-10 if gap >= 0 else 1e-10)
    assert out["c.normal"][0] == pytest.approx(G * math.cos(slope), rel=1e-8)  # Newton: 1e-9 of the largest force
    assert out["c.friction"][0] == pytest.approx(G * math.sin(slope), rel=1e-8)
    for name in ("p.x", "p.y", "p.z"):
        # What Newton leaves open, 1e-9 m g, moves it by less than 1e-14 m; the moment that levels of its corners have about 1e-12 m.
        assert numpy.abs(out[name] - out[name][0]).max() < 1e-11, name
    assert out["c.friction"] == pytest.approx(G * math.sin(slope) * numpy.ones(101), rel=1e-6)
    assert numpy.abs(out["rubbed"]).max() < 1e-11


def test_contacts_among_many_start_as_single_ones(sensors):
    single = sensors(incline(30, 0.1, 0.578))
    many = sensors(incline(30, 0.1, 0.578, AMONG))
    for name in ("p.x", "p.z", "c.normal", "c.friction"):
        assert many[name] == pytest.approx(single[name], rel=1e-9, abs=1e-12), name
    assert numpy.abs(many["p.x"] - many["p.x"][0]).max() < 1e-11


def test_a_box_that_is_turned_by_a_couple_is_held(sensors):
    """A couple about the normal: corners carry it beside the weight, and together they hold both."""
    out = sensors(incline(15, 0.1, 0.6, more="  turn: {torque: {on: b, value: [0, 0, 0.5]}}\n"))
    moving = [name for name in out if name[:2] in ("p.", "r.") and "rate" not in name]
    assert len(moving) >= 6
    for name in moving:
        assert numpy.abs(out[name] - out[name][0]).max() < 1e-11, name


def test_beyond_its_angle_of_friction_it_slides_and_says_so(buckens, sensors, tmp_path):
    """From the first instant with all friction that there is: a = g (sin α − μ cos α)."""
    mu, slope = 0.4, math.radians(30)
    (tmp_path / "box.yaml").write_text(incline(30, 0.1, mu))
    ratio = math.tan(slope) / mu
    buckens("run", "box.yaml", "-o", "again").must(0, "frozen friction \"c\" holds 4.905 N", f"ratio {ratio:.6g}", "it would slide; give it more friction")
    out = sensors(incline(30, 0.1, mu))
    assert out["c.friction"][0] == pytest.approx(mu * G * math.cos(slope), rel=1e-8)
    gone = out["p.x"][-1] - out["p.x"][0]
    # The tilt changes with friction as it begins to slide: a few 1e-7 m.
    assert gone == pytest.approx(0.5 * G * (math.sin(slope) - mu * math.cos(slope)), abs=2e-5)


TWO = """  floor: {contact: {between: [ground, a], shapes: [{plane: [0, 0, 1]}, {box: [0.4, 0.4, 0.2]}], LAW}}
  upper: {contact: {between: [a, b], shapes: [{box: [0.4, 0.4, 0.2]}, {box: [0.4, 0.4, 0.2]}], LAW}}
"""
TWO_AMONG = "  floor: {contacts: {among: [{on: ground, plane: {}}, {bodies: [a, b], box: [0.4, 0.4, 0.2]}], LAW}}\n"


@pytest.mark.parametrize("gap", [0, 1e-5])
@pytest.mark.parametrize("together", [False, True])
def test_a_pile_of_two_stays_where_it_touches(sensors, together, gap):
    """Boxes of 1 kg that touch, or lie a hair's breadth above each other, at 20°: they sink in without sliding, and friction between
    them is that of statics, without self-stress among the corners of a face."""
    slope, mu = math.radians(20), 0.5
    loads = (TWO_AMONG if together else TWO).replace("LAW", f"static: {mu}, stiffness: {STIFFNESS}")
    contacts = "floor: {contact: floor}" if together else "floor: {contact: floor}, upper: {contact: upper}"
    out = sensors(f"""
buckens: 1
gravity: [{G * math.sin(slope)!r}, 0, {-G * math.cos(slope)!r}]
bodies:
  a: {{rigid: {{mass: 1, inertia: [0.004, 0.004, 0.004]}}, at: {{position: [0, 0, {0.1 + gap}]}}, markers: {{top: {{position: [0, 0, 0.1]}}}}}}
  b: {{rigid: {{mass: 1, inertia: [0.004, 0.004, 0.004]}}, at: {{position: [0, 0, {0.3 + 2 * gap}]}}, markers: {{top: {{position: [0, 0, 0.1]}}}}}}
loads:
{loads}initial: {{start: static, friction: frozen}}
simulation: {{duration: 1 s, step: 1 ms}}
output:
  every: 100 ms
  sensors: {{a: {{position: a}}, b: {{position: b}}, ta: {{position: a/top}}, tb: {{position: b/top}}, {contacts}}}
""")
    # They tilt on the springs, the centres 0.1 m above or below the place where they are held. Two gaps are to be fallen by the upper one.
    along, across = G * math.sin(slope), G * math.cos(slope)
    fallen = gap * math.tan(slope)
    lower, upper = (10 * (out[f"t{name}.x"][0] - out[f"{name}.x"][0]) for name in "ab")
    assert lower == pytest.approx(0.4 * along / (4 * STIFFNESS * 0.2**2), rel=1e-3)  # both weights, at 0.1 and 0.3 m
    assert out["a.x"][0] == pytest.approx(fallen + 0.1 * lower, abs=2e-9)
    assert out["b.x"][0] == pytest.approx(2 * fallen + 0.2 * lower + 0.1 * upper, abs=3e-9)
    for name in [name for name in out if name.split(".")[0] in ("a", "b", "ta", "tb")]:
        assert numpy.abs(out[name] - out[name][0]).max() < 1e-10, name
    if together:
        assert out["floor.normal"][0] == pytest.approx(3 * across, rel=1e-4)
        assert out["floor.friction"][0] == pytest.approx(3 * along, rel=1e-4)  # the upper box is tilted by 1e-5
    else:
        assert out["floor.normal"][0] == pytest.approx(2 * across, rel=1e-8)
        assert out["floor.friction"][0] == pytest.approx(2 * along, rel=1e-8)
        assert out["upper.normal"][0] == pytest.approx(across, rel=1e-4)
        assert out["upper.friction"][0] == pytest.approx(along, rel=1e-4)


def test_a_wall_that_nothing_presses_holds_nothing(sensors):
    """A box on a floor and beside a wall that it touches: it sinks into the floor along the wall, which carries none of its weight."""
    out = sensors(f"""
buckens: 1
gravity: [0, 0, -10]
bodies: {{b: {{rigid: {{mass: 1, inertia: [0.004, 0.004, 0.004]}}, at: {{position: [0.25, 0, 0.25]}}}}}}
loads:
  floor: {{contact: {{between: [ground, b], shapes: [{{plane: [0, 0, 1]}}, {{box: [0.5, 0.5, 0.5]}}], static: 0.5, stiffness: {STIFFNESS}}}}}
  wall: {{contact: {{between: [ground, b], shapes: [{{plane: [1, 0, 0]}}, {{box: [0.5, 0.5, 0.5]}}], static: 0.5, stiffness: {STIFFNESS}}}}}
initial: {{start: static, friction: frozen}}
simulation: {{duration: 10 ms, step: 1 ms}}
output: {{sensors: {{p: {{position: b}}, floor: {{contact: floor}}, wall: {{contact: wall}}}}}}
""")
    assert out["floor.normal"][0] == pytest.approx(10, rel=1e-8)
    assert out["wall.normal"][0] == 0 and out["wall.friction"][0] == 0
    assert out["p.z"][0] == pytest.approx(0.25 - 10 / (4 * STIFFNESS), abs=1e-12)
