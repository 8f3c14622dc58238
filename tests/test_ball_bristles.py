# SPDX-License-Identifier: Apache-2.0
"""Bristles of a ball joint: about one axis those of a hinge, about all of them without creep, against an integration of their law, and
where the direction of sliding turns."""

import json
import math
import pathlib
import re
import sys

import numpy
import pytest

from test_friction_settles import BALLS, OUT_OF_PLANE, SPACE_CRANK

sys.path.insert(0, str(pathlib.Path(__file__).parent / "support"))
from runge_kutta import runge_kutta  # noqa: E402

# A top that turns about its centre: 20 N press, so that 0.2 x 20 mm x 20 N = 0.08 N m hold.
TOP = """
buckens: 1
gravity: [0, 0, -10]
bodies: {top: {rigid: {mass: 2 kg, inertia: [0.1, 0.1, 0.02]}}}
joints: {ball: {JOINT}}
loads:
  rub: {FRICTION, stick: bristles, bristle-stiffness: 400 N m/rad, bristle-damping: 0.5 N m s/rad, elastic-share: SHARE}}
  twist: {torque: {on: top, value: [0, 0, "0.2*sin(40*t) N m"]}}
simulation: {duration: 1 s, step: 0.5 ms}
output: {every: 5 ms, sensors: {r: {rotation: top}, w: {angular-velocity: top}, rub: {spring-torque: rub}, balance: {energy: balance}, lost: {energy: dissipated}}}
"""


# Where values that are changed are found, and what they are.
DEFAULTS = {"twist": (r"value: .*\]", '[0, 0, "0.2*sin(40*t) N m"]'), "duration": ("duration: 1 s", "1 s"), "step": ("step: 0.5 ms", "0.5 ms"),
            "every": ("every: 5 ms", "5 ms"), "stiffness": ("bristle-stiffness: 400 N m/rad", "400 N m/rad"),
            "damping": ("bristle-damping: 0.5 N m s/rad", "0.5 N m s/rad"), "inertia": (r"inertia: \[.*?\]", "[0.1, 0.1, 0.02]")}


def ball(share=0.9, **changes):
    text = TOP.replace("SHARE", str(share)).replace("JOINT", "spherical: {between: [ground, top]}").replace(
        "FRICTION", "ball-friction: {joint: ball, static: 0.2, radius: 20 mm")
    for key, value in changes.items():
        text, count = re.subn(DEFAULTS[key][0], lambda found: found.group(0).replace(DEFAULTS[key][1], value), text)
        assert count == 1
    return text


@pytest.mark.parametrize("share", [0, 0.9])
def test_about_one_axis_they_are_those_of_a_hinge(sensors, share):
    out = sensors(ball(share))
    hinge = sensors(TOP.replace("SHARE", str(share)).replace("JOINT", "revolute: {between: [ground, top], axis: [0, 0, 1]}")
                    .replace("FRICTION", "hinge-friction: {joint: ball, static: 0.2, axial-radius: 20 mm"))
    assert numpy.abs(hinge["w.z"]).max() > 0.05 and (hinge["w.z"][1:] * hinge["w.z"][:-1] < 0).sum() > 8
    # Both iterate to 1e-10 of the motion in a step.
    assert out["r.z"] == pytest.approx(hinge["r.z"], abs=1e-9)
    assert out["w.z"] == pytest.approx(hinge["w.z"], abs=1e-7)
    assert out["lost"] == pytest.approx(hinge["lost"], abs=1e-8)
    assert numpy.abs(out["r.x"]).max() < 1e-12


@pytest.mark.parametrize("part", [0.9, 0.99])
def test_a_held_ball_does_not_move_in_1000_s(sensors, part):
    """A load that grows to a part of what holds at most, about an axis between the others."""
    held = [0.08 * part * way for way in (0.6, 0.48, 0.64)]
    twist = ", ".join(f'"{value!r}*(1 - exp(-t)) N m"' for value in held)
    out = sensors(ball(twist=f"[{twist}]", duration="1000 s", step="20 ms", every="1 s"))
    turned = numpy.array([out["r.x"], out["r.y"], out["r.z"]])
    # exp(-40) of the load is still to come, and 50 000 steps round.
    assert numpy.abs(turned[:, 40:] - turned[:, -1:]).max() < 1e-10
    assert numpy.linalg.norm(turned[:, -1]) < 2e-3
    assert numpy.array([out["rub.x"], out["rub.y"], out["rub.z"]])[:, -1] == pytest.approx(held, rel=1e-9)


@pytest.mark.parametrize("share", [0, 0.9])
def test_a_load_that_goes_round_turns_it_on_only_by_lugres_own_law(sensors, share):
    """Rotations about two axes in turn do not commute: a sum of them would turn it by their area, 3e-5 rad each time."""
    out = sensors(ball(share, twist='["0.06*(1 - exp(-t))*cos(2*pi*t) N m", "0.06*(1 - exp(-t))*sin(2*pi*t) N m", "SHARE"]'
                       .replace('"SHARE"', '0' if share else '0.01'),
                       stiffness="20 N m/rad", duration="60 s", step="2 ms", every="20 ms"))

    def mean(column, first):
        return out[column][(out["t"] > first - 0.01) & (out["t"] < first + 0.99)].mean()

    for axis in "xyz":
        moved = abs(mean(f"r.{axis}", 59) - mean(f"r.{axis}", 30))
        if share:
            assert moved < 1e-9
    if not share:
        assert abs(mean("r.z", 59) - mean("r.z", 30)) > 1e-3


def test_sliding_it_brakes_by_the_bound_against_the_rotation(sensors):
    """0.08 N m of 0.05 kg m2: 1.6 rad/s less each second, until it rests after 3.75 s."""
    way = numpy.array([2, -1, 2]) / 3
    start = f"initial: {{bodies: {{top: {{angular-velocity: {list(6 * way)}}}}}}}\nsimulation:"
    out = sensors(ball(twist="[0, 0, 0]", inertia="[0.05, 0.05, 0.05]", damping="0.005 N m s/rad", duration="5 s").replace("simulation:", start))
    w = numpy.array([out["w.x"], out["w.y"], out["w.z"]])
    torque = numpy.array([out["rub.x"], out["rub.y"], out["rub.z"]])
    slides = (out["t"] > 0.1) & (out["t"] < 3.7)
    assert torque[:, slides] == pytest.approx(0.08 * way[:, None] * numpy.ones(slides.sum()), abs=1e-9)
    # They bend within the first step of 0.5 ms, whose mean torque is up to a half of the bound short: 4e-4 rad/s.
    assert w[:, slides] == pytest.approx(way[:, None] * (6 - 1.6 * out["t"][slides]), abs=4e-4)
    # Its bristles of 2e-4 rad give back what they have stored: it swings at 89 rad/s.
    assert numpy.linalg.norm(w[:, out["t"] > 4], axis=0).max() < 2e-4 * 89.5
    assert abs(out["balance"]).max() < 1e-4


def integrated(inertia, torque, bristles, bound, duration):
    """Angular velocity of a ball with equal moments of inertia, and its deflection, by an integration of their law."""
    stiffness, damping, share = bristles
    slid = bound / stiffness

    def bending(z, w):
        across = numpy.cross(z, w)
        out = w - 0.5 * across + numpy.cross(z, across) / 12
        size = numpy.linalg.norm(z)
        along = w @ z / size if size > 0 else 0
        filled = size / slid
        if along <= 0 or filled <= share:
            return out
        alpha = 1 if filled >= 1 else 0.5 + 0.5 * math.sin(math.pi * (filled - 0.5 * (1 + share)) / (1 - share))
        return out - alpha * filled * along * z / size

    def slope(t, y):
        z_dot = bending(y[:3], y[3:])
        return numpy.concatenate([z_dot, (torque(t) - stiffness * y[:3] - damping * z_dot) / inertia])

    return runge_kutta(slope, numpy.zeros(6), duration, round(duration / 2e-4))


def test_they_follow_their_law_with_the_square_of_the_step(sensors):
    """A torque that goes round takes it along: it sticks at first, and then slides about axes that turn."""
    def torque(t):
        return numpy.array([0.2 * math.sin(4 * t), 0.2 * (1 - math.cos(4 * t)), 0.1 * t])

    exact = integrated(0.05, torque, (4, 0.05, 0.5), 0.08, 1.5)
    errors = []
    for step in ("2 ms", "1 ms", "0.5 ms"):
        out = sensors(ball(0.5, twist='["0.2*sin(4*t) N m", "0.2*(1 - cos(4*t)) N m", "0.1*t N m"]', inertia="[0.05, 0.05, 0.05]",
                           stiffness="4 N m/rad", damping="0.05 N m s/rad", duration="1.5 s", step=step))
        w = numpy.array([out[f"w.{axis}"][-1] for axis in "xyz"])
        errors.append(numpy.linalg.norm(w - exact[3:]))
    assert numpy.linalg.norm(exact[3:]) > 1
    assert errors[2] < 2e-4
    for coarse, fine in zip(errors, errors[1:]):
        assert 3 < coarse / fine < 5.5


STIFF = {"radius: 10 mm": 4000, "radius: 8 mm": 3000}  # [N m/rad], about bounds of 0.03 N m that break away after 1e-5 rad


def with_bristles(text, stiffnesses=STIFF):
    for radius, stiffness in stiffnesses.items():
        text = "\n".join(line.replace(radius, f"{radius}, stick: bristles, bristle-stiffness: {stiffness} N m/rad")
                         if "ball-friction" in line else line for line in text.split("\n"))
    return text


def test_stiff_bristles_slide_as_springs_that_break_away(sensors, tmp_path):
    """Two arms on balls whose direction of sliding turns; friction by stiff springs has a test of its own."""
    springs = sensors(BALLS)
    bristles = sensors(with_bristles(BALLS))
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["step_control"]["failed"] == 0
    assert abs(bristles["balance"]).max() < 2e-3 * bristles["lost"][-1]
    # Where it sticks in between, one by a spring of the instant's bound and the other by constant bristles.
    assert bristles["lost"] == pytest.approx(springs["lost"], abs=5e-3 * springs["lost"][-1])
    assert springs["lost"][-1] > 0.1


@pytest.mark.parametrize("coefficient", ["0.1", "0.4"])
def test_a_flexible_crank_in_space_settles(sensors, tmp_path, coefficient):
    """The rod is a beam, which turns freely about its own axis, and both of its balls turn round twice a turn."""
    rod, slider = OUT_OF_PLANE
    text = SPACE_CRANK.replace("ROD", rod).replace("SLIDER", slider).replace("MU", coefficient).replace("BIG", "spherical").replace("AXES", "")
    out = sensors(with_bristles(text, {"radius: 8 mm": 400}))
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["step_control"]["failed"] == 0 and summary["steps"] == 1000
    assert abs(out["balance"]).max() < 2e-3 * out["lost"][-1]


def test_frozen_they_hold_at_rest(sensors):
    out = sensors(ball(twist="[0.03, 0.04, 0.02]").replace("simulation:", "initial: {start: static, friction: frozen}\nsimulation:"))
    for axis in "xyz":
        # It turns about where 0.05 N m bend bristles of 400 N m/rad.
        assert numpy.abs(out[f"r.{axis}"]).max() < 2.1 * 0.054 / 400


CROSS = "universal: {between: [ground, top], axis: [0, 0, 1], second-axis: [0, 1, 0]}"


def cross(twist, stick="bristles", more=""):
    """The arm that the ground holds is upright, that of the body lies along y."""
    text = TOP.replace("SHARE", "0.9").replace("JOINT", CROSS).replace("FRICTION", "ball-friction: {joint: ball, static: 0.2, radius: 20 mm")
    assert 'value: [0, 0, "0.2*sin(40*t) N m"]' in text
    return text.replace('value: [0, 0, "0.2*sin(40*t) N m"]', f"value: [{twist}]").replace("stick: bristles", f"stick: {stick}{more}")


def test_each_arm_of_a_cross_is_a_hinge(sensors):
    out = sensors(cross('0, 0, "0.2*sin(40*t) N m"'))
    hinge = sensors(TOP.replace("SHARE", "0.9").replace("JOINT", "revolute: {between: [ground, top], axis: [0, 0, 1]}")
                    .replace("FRICTION", "hinge-friction: {joint: ball, static: 0.2, axial-radius: 20 mm"))
    assert numpy.abs(hinge["w.z"]).max() > 0.05
    assert out["r.z"] == pytest.approx(hinge["r.z"], abs=1e-9)
    assert out["rub.z"] == pytest.approx(hinge["rub"], abs=1e-6)
    assert out["lost"] == pytest.approx(hinge["lost"], abs=1e-8)
    assert numpy.abs(out["r.y"]).max() < 1e-12


def test_both_arms_of_a_cross_hold_more_than_one(sensors):
    """0.99 of its bound on each: both turn as a hinge does, and nothing creeps. Beyond it, only one arm slides."""
    held = f'"{0.99 * 0.08}*(1 - exp(-5*t)) N m"'
    long = ("duration: 1 s", "duration: 100 s"), ("step: 0.5 ms", "step: 5 ms")
    texts = [cross(f"0, {held}, {held}"), cross(f"0, 0, {held}").replace(CROSS, "revolute: {between: [ground, top], axis: [0, 0, 1]}")
             .replace("ball-friction: {joint: ball, static: 0.2, radius", "hinge-friction: {joint: ball, static: 0.2, axial-radius")]
    for change in long:
        texts = [text.replace(*change) for text in texts]
    out, hinge = map(sensors, texts)
    # The arm about y, with five times the moment of inertia, first comes to rest: while it vibrates, its bristles slip a little.
    late = out["t"] > 60
    # Each turns the other by 0.3 mrad, which counts squared.
    assert out["r.z"][late] == pytest.approx(hinge["r.z"][late], abs=1e-6)
    for way in "yz":
        assert out[f"r.{way}"][late].min() > 0.99 * 0.08 / 400
        assert numpy.ptp(out[f"r.{way}"][late]) < 1e-9
    slides = sensors(cross('0, 0.05, "0.2*sin(40*t) N m"'))
    assert numpy.abs(slides["r.z"]).max() > 10 * numpy.abs(slides["r.y"]).max()


# With much friction one step of a thousand, in which arms and ball turn round together, is repeated with half of its length.
@pytest.mark.parametrize("coefficient, most_failed", [("0.1", 0), ("0.4", 1)])
def test_crosses_of_a_flexible_crank_slide_as_with_stiff_springs(sensors, tmp_path, coefficient, most_failed):
    rod, slider = OUT_OF_PLANE
    text = SPACE_CRANK.replace("ROD", rod).replace("SLIDER", slider).replace("MU", coefficient).replace("BIG", "universal").replace("AXES", ", axis: [0, 0, 1], second-axis: [0, 1, 0]")
    elastic = sensors(text)
    bristles = sensors(text.replace("radius: 8 mm", "radius: 8 mm, stick: bristles, bristle-stiffness: 400 N m/rad"))
    assert json.loads((tmp_path / "out" / "summary.json").read_text())["step_control"]["failed"] <= most_failed
    assert abs(bristles["balance"]).max() < 2e-3 * bristles["lost"][-1]
    # Bristles bend by a milliradian where they turn round, stiff springs by a hundredth of it.
    assert bristles["lost"] == pytest.approx(elastic["lost"], abs=2e-2 * elastic["lost"][-1])
