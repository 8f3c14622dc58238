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


# Just touching, within an overlap, and far above.
@pytest.mark.parametrize("height", [0.1, 0.099999, 0.3])
def test_a_box_stays_where_it_starts(sensors, height):
    angle = 30
    out = sensors(incline(angle, height, 0.578))  # tan 30° = 0.57735
    slope = math.radians(angle)
    # It tilts as it sinks in: the lower corners carry the moment of friction, M = m g sin(30°) 0.1 m, over 4 corners 0.2 m from the
    # middle. The middle of the box moves with it, 0.1 m above the surface.
    tilt = G * math.sin(slope) * 0.1 / (4 * STIFFNESS * 0.2**2)
    if height < 0.1:  # it is held before the first step; in each a row along a surface gives by 1e-10 of the model's length
        assert out["p.x"][0] == pytest.approx(0.1 * tilt, abs=1e-10)
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
