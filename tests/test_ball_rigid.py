# SPDX-License-Identifier: Apache-2.0
"""Friction of balls and crosses that sticks without any motion: what holds, breaks away, slides about axes that turn, and comes to rest."""

import json
import math
import pathlib
import re
import sys

import numpy
import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent / "support"))
from runge_kutta import runge_kutta  # noqa: E402

# A top that turns about its centre: 20 N press, so that 0.2 x 20 mm x 20 N = 0.08 N m hold.
TOP = """
buckens: 1
gravity: [0, 0, -10]
bodies: {top: {rigid: {mass: 2 kg, inertia: [0.05, 0.05, 0.05]}}}
joints: {ball: {JOINT}}
loads:
  rub: {FRICTION, stick: rigid}}
  twist: {torque: {on: top, value: [0, 0, 0]}}
simulation: {duration: 1 s, step: 1 ms}
output: {every: 10 ms, sensors: {r: {rotation: top}, w: {angular-velocity: top}, rub: {spring-torque: rub}, balance: {energy: balance}, lost: {energy: joint-friction}}}
"""
BALL = "spherical: {between: [ground, top]}", "ball-friction: {joint: ball, static: 0.2, radius: 20 mm"
HINGE = "revolute: {between: [ground, top], axis: [0, 0, 1]}", "hinge-friction: {joint: ball, static: 0.2, axial-radius: 20 mm"
BOUND, INERTIA = 0.08, 0.05
STEADY = numpy.array([0.6, 0.48, 0.64])

# Where values that are changed are found, and what they are.
DEFAULTS = {"twist": (r"value: .*\]", "[0, 0, 0]"), "duration": ("duration: 1 s", "1 s"), "step": ("step: 1 ms", "1 ms"),
            "every": ("every: 10 ms", "10 ms"), "inertia": (r"inertia: \[.*?\]", "[0.05, 0.05, 0.05]")}


def top(kind=BALL, more="", start="", **changes):
    text = TOP.replace("JOINT", kind[0]).replace("FRICTION", kind[1] + more)
    for key, value in changes.items():
        text, count = re.subn(DEFAULTS[key][0], lambda found: found.group(0).replace(DEFAULTS[key][1], value), text)
        assert count == 1
    return text.replace("simulation:", f"initial: {{bodies: {{top: {{angular-velocity: {start}}}}}}}\nsimulation:") if start else text


def vector(out, name):
    return numpy.array([out[f"{name}.{axis}"] for axis in "xyz"])


def failed_steps(tmp_path):
    return json.loads((tmp_path / "out" / "summary.json").read_text())["step_control"]["failed"]


@pytest.mark.parametrize("twist", [
    [f"{0.999 * BOUND * way!r}" for way in STEADY],
    [f'"{0.999 * BOUND!r}*sin(0.7*t) N m"', "0", f'"{0.999 * BOUND!r}*cos(0.7*t) N m"'],
], ids=["steady", "goes round"])
def test_a_held_ball_does_not_move_in_1000_s(sensors, twist):
    out = sensors(top(twist=f"[{', '.join(twist)}]", duration="1000 s", step="0.1 s", every="10 s"))
    assert numpy.abs(vector(out, "r")).max() < 1e-9
    assert numpy.linalg.norm(vector(out, "rub"), axis=0) == pytest.approx(0.999 * BOUND, rel=1e-9)
    assert numpy.abs(out["lost"]).max() < 1e-12


def test_it_breaks_away_at_the_bound(sensors):
    """A torque that grows by the bound each second: at rest for 1 s, and then w = b (t - 1)^2/2J."""
    values = ", ".join(f'"{BOUND * way!r}*t N m"' for way in STEADY)
    out = sensors(top(twist=f"[{values}]", duration="1.5 s"))
    late = numpy.maximum(out["t"] - 1, 0)
    assert numpy.abs(vector(out, "w")[:, out["t"] < 0.9995]).max() < 1e-12
    # It lets go within a step of 1 ms, with an error of the torque of b h at most, over h.
    most = BOUND * 1e-6 / INERTIA
    assert vector(out, "w") == pytest.approx(STEADY[:, None] * (BOUND / INERTIA * late**2 / 2), abs=most)
    assert numpy.linalg.norm(vector(out, "rub"), axis=0) == pytest.approx(BOUND * numpy.minimum(out["t"], 1), abs=1e-9)


@pytest.mark.parametrize("more", ["", ", viscous: 5 mN m s/rad", ", dynamic: 0.15, stribeck-velocity: 0.5 rad/s", ", preload: 20 mN m"])
def test_about_one_axis_it_is_that_of_a_hinge(sensors, more):
    twist = '[0, 0, "0.15*sin(12*t) N m"]'
    ball, hinge = (sensors(top(kind, more, twist=twist, every="2 ms")) for kind in (BALL, HINGE))
    signs = numpy.sign(numpy.round(hinge["w.z"], 12))
    assert numpy.abs(hinge["w.z"]).max() > 0.05 and (numpy.diff(signs) != 0).sum() >= 4
    assert (numpy.abs(hinge["w.z"]) < 1e-12).sum() > 5  # it sticks in between
    assert ball["r.z"] == pytest.approx(hinge["r.z"], abs=1e-9)
    assert ball["w.z"] == pytest.approx(hinge["w.z"], abs=1e-9)
    assert ball["lost"] == pytest.approx(hinge["lost"], abs=1e-9)
    assert ball["rub.z"] == pytest.approx(hinge["rub"], abs=1e-9)
    assert numpy.abs(ball["r.x"]).max() < 1e-12


@pytest.mark.parametrize("kind", [BALL, HINGE], ids=["ball", "hinge"])
def test_backwards_it_slides_as_forwards(sensors, tmp_path, kind):
    runs, iterations = [], []
    for sign in (1, -1):
        runs.append(sensors(top(kind, ", viscous: 5 mN m s/rad", start=f"[0, 0, {3 * sign}]", twist=f'[0, 0, "{0.1 * sign}*sin(3*t) N m"]')))
        iterations.append(json.loads((tmp_path / "out" / "summary.json").read_text())["newton_iterations"]["total"])
    assert runs[0]["w.z"] == pytest.approx(-runs[1]["w.z"], abs=1e-14)
    assert runs[0]["r.z"] == pytest.approx(-runs[1]["r.z"], abs=1e-14)
    assert iterations[0] == iterations[1]


def test_sliding_it_brakes_by_the_bound_against_the_rotation(sensors, tmp_path):
    """0.08 N m of 0.05 kg m2: 1.6 rad/s less each second, until it rests after 3.75 s."""
    way = numpy.array([2, -1, 2]) / 3
    out = sensors(top(start=str(list(6 * way)), duration="5 s"))
    # It stops within a step of 1 ms.
    assert vector(out, "w") == pytest.approx(way[:, None] * numpy.maximum(6 - 1.6 * out["t"], 0), abs=1e-9)
    assert vector(out, "rub")[:, out["t"] < 3.74] == pytest.approx(BOUND * way[:, None] * numpy.ones((out["t"] < 3.74).sum()), abs=1e-12)
    assert numpy.abs(vector(out, "w")[:, out["t"] > 3.76]).max() < 1e-12
    assert out["lost"][-1] == pytest.approx(0.5 * INERTIA * 36, rel=1e-9)
    assert numpy.abs(out["balance"]).max() < 1e-9 and failed_steps(tmp_path) == 0


def pushed(torque, inertia, duration, steps):
    """Angular velocity of a ball that slides from the start, by an integration of its law."""
    def slope(t, w):
        size = numpy.linalg.norm(w)
        drive = torque(t)
        # From rest it starts against the friction, along the torque: all moments of inertia are equal.
        way = w / size if size > 0 else drive / numpy.linalg.norm(drive)
        return (drive - BOUND * way) / inertia

    return runge_kutta(slope, numpy.zeros(3), duration, steps)


def test_it_follows_its_law_with_the_square_of_the_step(sensors):
    """A torque beyond the bound that goes round takes it along about axes that turn."""
    exact = pushed(lambda t: numpy.array([0.2 * math.cos(3 * t), 0.2 * math.sin(3 * t), 0.1]), INERTIA, 1.5, 15000)
    assert numpy.linalg.norm(exact) > 1
    errors = []
    for step in ("4 ms", "2 ms", "1 ms"):
        out = sensors(top(twist='["0.2*cos(3*t) N m", "0.2*sin(3*t) N m", 0.1]', duration="1.5 s", step=step))
        errors.append(numpy.linalg.norm(vector(out, "w")[:, -1] - exact))
    assert errors[2] < 1e-5
    for coarse, fine in zip(errors, errors[1:]):
        assert coarse / fine == pytest.approx(4, abs=0.6)


def test_from_rest_it_starts_against_its_acceleration(sensors):
    """With three moments of inertia that differ, the torque that would have held it does not give the direction of sliding."""
    inertia = numpy.array([0.02, 0.03, 0.04])
    drive = numpy.array([0.2, 0.1, 0.15])
    out = sensors(top(inertia="[0.02, 0.03, 0.04]", twist=str(list(drive)), duration="0.1 s", step="0.1 ms", every="0.1 ms"))
    # J a = T - b a/|a|, whose length is found by a fixed point.
    a = drive / inertia
    for _ in range(500):
        a = drive / (inertia + BOUND / numpy.linalg.norm(a))
    w = vector(out, "w")[:, 1]
    # The direction turns by the gyroscopic torques of w h alone.
    assert w / 1e-4 == pytest.approx(a, rel=1e-5)
    assert vector(out, "rub")[:, 0] == pytest.approx(BOUND * a / numpy.linalg.norm(a), rel=1e-6)


# A pendulum that is thrown sideways, whose axis of sliding turns all the time until it sticks off the vertical.
PENDULUM = """
buckens: 1
gravity: [0, 0, -9.81]
bodies: {bob: {rigid: {mass: 1 kg, inertia: [2e-3, 3e-3, 1e-3]}, at: {position: [0, 0, -0.3]}, markers: {o: {position: [0, 0, 0.3]}}}}
joints: {ball: {spherical: {between: [ground, bob/o]}}}
loads: {rub: {ball-friction: {joint: ball, static: 0.3, radius: 60 mmSTICK}}}
initial: {bodies: {bob: {velocity: [0.45, 0.3, 0], angular-velocity: [-1, 1.5, 4]}}}
simulation: {duration: 2 s, step: STEP}
output: {every: 10 ms, sensors: {p: {position: bob}, w: {angular-velocity: bob}, balance: {energy: balance}, lost: {energy: joint-friction}, held: {energy: springs}}}
"""


def pendulum(stick=", stick: rigid", step="1 ms"):
    return PENDULUM.replace("STICK", stick).replace("STEP", step)


def test_a_pendulum_comes_to_rest_off_the_vertical(sensors, tmp_path):
    out = sensors(pendulum())
    assert failed_steps(tmp_path) == 0
    rest = out["t"] > 1.5
    assert numpy.abs(vector(out, "w")[:, rest]).max() < 1e-12
    place = vector(out, "p")[:, rest]
    assert numpy.ptp(place, axis=1).max() < 1e-13
    assert math.hypot(place[0, -1], place[1, -1]) > 1e-3
    # Bodies that turn about several axes at once keep it to the square of the step.
    finer = sensors(pendulum(step="0.5 ms"))
    balances = [numpy.abs(run["balance"]).max() / run["lost"][-1] for run in (out, finer)]
    assert balances[0] < 1e-6 and balances[0] / balances[1] == pytest.approx(4, abs=0.2)


def test_a_pendulum_is_that_with_elastic_slip_the_smaller_this_is(sensors):
    rigid = sensors(pendulum())
    differences = []
    for slip in ("1e-3 rad", "1e-4 rad", "1e-5 rad"):
        elastic = sensors(pendulum(f", slip: {slip}"))
        differences.append(numpy.abs(vector(rigid, "p") - vector(elastic, "p")).max())
    # Where it turns round it takes a time with the root of the slip until friction is as large again, and that changes its speed.
    assert differences[2] < 3e-4
    for coarse, fine in zip(differences, differences[1:]):
        assert coarse / fine == pytest.approx(math.sqrt(10), rel=0.1)


def test_a_pendulum_converges_with_the_step(sensors):
    places = {step: vector(sensors(pendulum(step=f"{step} ms")), "p")[:, -1] for step in (4, 2, 1, 0.125)}
    errors = [numpy.linalg.norm(places[step] - places[0.125]) for step in (4, 2, 1)]
    # It comes to rest within a step: no power of the step, but at least as fast as it.
    assert errors[2] < 2e-5
    assert errors[2] < 0.5 * errors[0]


def test_step_control_carries_it(sensors, tmp_path):
    fine = sensors(pendulum(step="0.125 ms"))
    out = sensors(pendulum(step="20 ms, tolerance: 1e-4"))
    assert vector(out, "p")[:, -1] == pytest.approx(vector(fine, "p")[:, -1], abs=3e-3)
    assert numpy.abs(vector(out, "w")[:, -1]).max() < 1e-9


def test_a_run_goes_on_to_the_bit(goes_on):
    goes_on(pendulum(), "2 s", "0.5 s", 201)


@pytest.mark.parametrize("method", ["hht", "generalized-alpha, rho-inf: 1"])
def test_methods_that_hold_at_the_end_of_a_step_carry_it(sensors, method):
    out = sensors(pendulum(step=f"1 ms, method: {method}"))
    default = sensors(pendulum())
    assert vector(out, "p") == pytest.approx(vector(default, "p"), abs=2e-4)
    assert numpy.abs(vector(out, "w")[:, -1]).max() < 1e-9


@pytest.mark.parametrize("method", ["newmark", "wilson"])
def test_methods_that_hold_within_a_step_refuse_it(buckens, tmp_path, method):
    (tmp_path / "model.yaml").write_text(pendulum(step=f"1 ms, method: {method}"))
    buckens("run", "model.yaml", "-o", "out").must(2, "\"rub\" holds rigidly", "generalized-alpha or hht")


def test_an_event_lets_it_go(sensors):
    """The coefficient falls at 0.4 s from what holds 0.08 N m to what holds 0.04 N m."""
    text = top(twist=str(list(0.06 * STEADY))).replace("simulation:", 'signals: {late: "t - 0.4"}\nevents: {oil: {when: late, set: {loads.rub.static: 0.1}}}\nsimulation:')
    out = sensors(text)
    late = numpy.maximum(out["t"] - 0.4, 0)
    # An event is found within h/16.
    assert vector(out, "w") == pytest.approx(STEADY[:, None] * (0.02 / INERTIA * late), abs=0.4 * 1e-3)
    assert numpy.abs(vector(out, "w")[:, out["t"] < 0.399]).max() < 1e-12


def test_a_coefficient_by_a_law_lets_it_go(sensors):
    out = sensors(top(twist=str(list(0.06 * STEADY))).replace("static: 0.2", 'static: "0.2 - 0.1*t"'))
    late = numpy.maximum(out["t"] - 0.5, 0)
    assert vector(out, "w") == pytest.approx(STEADY[:, None] * (0.04 / INERTIA * late**2 / 2), abs=0.04 * 1e-6 / INERTIA)


def test_switched_off_it_is_free_and_on_again_it_slides(sensors):
    text = top(twist=str(list(0.06 * STEADY))).replace("simulation:", 'signals: {first: "t - 0.2", second: "t - 0.4"}\nevents: {off: {when: first, switch-off: rub}, on: {when: second, switch-on: rub}}\nsimulation:')
    out = sensors(text)
    t = out["t"]
    speed = 0.06 / INERTIA * numpy.clip(t - 0.2, 0, 0.2)
    speed = numpy.maximum(speed - 0.02 / INERTIA * numpy.maximum(t - 0.4, 0), 0)
    assert vector(out, "w") == pytest.approx(STEADY[:, None] * speed, abs=3e-3)
    assert numpy.abs(out["balance"]).max() < 1e-6


def test_frozen_it_holds_from_the_start(buckens, sensors, tmp_path):
    text = top(twist="[0.03, 0.04, 0.02]").replace("simulation:", "initial: {start: static, friction: frozen}\nsimulation:")
    out = sensors(text)
    assert numpy.abs(vector(out, "r")).max() < 1e-12
    assert vector(out, "rub") == pytest.approx(numpy.array([[0.03], [0.04], [0.02]]) * numpy.ones(len(out["t"])), abs=1e-12)
    (tmp_path / "more.yaml").write_text(text.replace("[0.03, 0.04, 0.02]", "[0.06, 0.08, 0.04]"))
    ratio = math.sqrt(0.06**2 + 0.08**2 + 0.04**2) / BOUND
    buckens("run", "more.yaml", "-o", "more").must(0, "frozen friction \"rub\" holds", f"ratio {ratio:.6g}", "would slide")


CROSS = "universal: {between: [ground, top], axis: [1, 0, 0], second-axis: [0, 1, 0]}", BALL[1]


def test_a_held_cross_does_not_move_and_each_arm_has_its_bound(sensors):
    """Both bearings together hold more than one of them."""
    most = 0.999 * BOUND
    out = sensors(top(CROSS, twist=f"[{most}, {-most}, 0]", duration="1000 s", step="0.1 s", every="10 s"))
    assert numpy.abs(vector(out, "r")).max() < 1e-9
    assert vector(out, "rub")[:2] == pytest.approx(numpy.array([[most], [-most]]) * numpy.ones(len(out["t"])), rel=1e-9)
    out = sensors(top(CROSS, twist=f"[0.1, {-most}, 0]", duration="0.1 s"))
    # The second bearing turns with the body, and still holds.
    assert out["w.x"] == pytest.approx(0.02 / INERTIA * out["t"], abs=1e-9)
    assert numpy.abs(numpy.hypot(out["w.y"], out["w.z"])).max() < 1e-9


def test_frozen_crosses_are_judged_by_arm(buckens, tmp_path):
    text = top(CROSS, twist="[0.07, 0.09, 0]").replace("simulation:", "initial: {start: static, friction: frozen}\nsimulation:")
    (tmp_path / "model.yaml").write_text(text)
    buckens("run", "model.yaml", "-o", "out").must(0, "frozen friction \"rub\" holds 0.09 N m", f"ratio {0.09 / BOUND:.6g}")


def test_a_slip_is_refused(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(top(more=", slip: 1e-5 rad"))
    buckens("check", "model.yaml").must(2, "model.yaml:7:", "friction with `stick: rigid` does not slip")
