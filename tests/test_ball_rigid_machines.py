# SPDX-License-Identifier: Apache-2.0
"""Friction of balls and crosses that sticks without any motion, in mechanisms: several balls, flexible arms and cranks, and blows."""

import json
import random

import numpy
import pytest

from test_ball_rigid import failed_steps, vector
from test_friction_settles import BALLS, OUT_OF_PLANE, SPACE_CRANK


def test_two_arms_on_balls_slide_as_with_stiff_springs(sensors, tmp_path):
    """The direction of sliding turns, and the thin second arm is light against its bound."""
    elastic = sensors(BALLS)
    text = BALLS.replace("radius: 10 mm", "radius: 10 mm, stick: rigid").replace("radius: 8 mm", "radius: 8 mm, stick: rigid")
    rigid = sensors(text)
    assert failed_steps(tmp_path) == 0
    assert rigid["lost"] == pytest.approx(elastic["lost"], abs=2e-3 * elastic["lost"][-1])
    # Bodies that turn about several axes at once keep it to the square of the step only.
    assert abs(rigid["balance"]).max() < 1e-4


# A rod between two balls turns freely about its own axis, but for the friction of both: 0.3 x 10 mm and 0.3 x 20 mm times 5 N.
ROD = """
buckens: 1
gravity: [0, 0, -10]
bodies:
  rod: {rigid: {mass: 1 kg, inertia: [1e-4, 2e-2, 2e-2]}, markers: {a: {position: [-0.3, 0, 0]}, b: {position: [0.3, 0, 0]}}}
  nut: {rigid: {mass: 1 g, inertia: [1e-7, 1e-7, 1e-7]}, at: {position: [0.3, 0, 0]}}
joints:
  a: {spherical: {between: [{ground: [-0.3, 0, 0]}, rod/a]}}
  b: {spherical: {between: [rod/b, nut]}}
  slide: {prismatic: {between: [{ground: [0.3, 0, 0]}, nut], axis: [1, 0, 0]}}
loads:
  fa: {ball-friction: {joint: a, static: 0.3, radius: 10 mm, stick: rigid}}
  fb: {ball-friction: {joint: b, static: 0.3, radius: 20 mm, stick: rigid}}
  spin: {torque: {on: rod, value: ["0.1*t N m", 0, 0]}}
simulation: {duration: 1 s, step: 1 ms}
output: {every: 1 ms, sensors: {w: {angular-velocity: rod}, a: {spring-torque: fa}, b: {spring-torque: fb}, balance: {energy: balance}}}
"""


def test_both_balls_of_a_rod_hold_its_spin(sensors, tmp_path):
    out = sensors(ROD)
    both = 0.3 * 5 * (0.01 + 0.02)
    held = out["t"] < both / 0.1 - 1e-3
    assert numpy.abs(out["w.x"][held]).max() < 1e-9
    assert out["a.x"][held] - out["b.x"][held] == pytest.approx(0.1 * out["t"][held], abs=1e-9)
    late = numpy.maximum(out["t"] - both / 0.1, 0)
    # Within the step in which it lets go, as above.
    assert out["w.x"] == pytest.approx(0.1 / 1e-4 * late**2 / 2, abs=0.1 * 1e-6 / 1e-4 * 2)
    assert failed_steps(tmp_path) == 0


@pytest.mark.parametrize("coefficient", ["0.1", "0.4"])
def test_a_flexible_crank_in_space_settles(sensors, tmp_path, coefficient):
    """The rod is a beam, which turns freely about its own axis, and both of its balls turn round twice a turn."""
    rod, slider = OUT_OF_PLANE
    text = SPACE_CRANK.replace("ROD", rod).replace("SLIDER", slider).replace("MU", coefficient).replace("BIG", "spherical").replace("AXES", "")
    elastic = sensors(text)
    rigid = sensors(text.replace("radius: 8 mm", "radius: 8 mm, stick: rigid"))
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["step_control"]["failed"] == 0 and summary["steps"] == 1000
    assert abs(rigid["balance"]).max() < 2e-3 * rigid["lost"][-1]
    assert rigid["lost"] == pytest.approx(elastic["lost"], abs=5e-3 * elastic["lost"][-1])


# A flexible arm on a ball, held by its friction, with a tip that is pushed around.
ARM = """
buckens: 1
gravity: [0, 0, -9.81]
materials: {steel: {E: 200 GPa, nu: 0.3, rho: 7850 kg/m^3, damping: {stiffness: 1e-5 s}}}
bodies: {arm: {beam: {to: [0.6, 0, 0], elements: 6, section: {circle: {diameter: 10 mm}}, material: steel}FRAMES}}
joints: {ball: {spherical: {between: [ground, arm/start]}}}
loads:
  rub: {ball-friction: {joint: ball, static: 0, preload: 1.3 N m, stick: rigid}}
  push: {force: {on: arm/end, value: [0, "0.4*sin(9*t) N", "0.3*sin(5*t) N"]}}
simulation: {duration: 1 s, step: 1 ms}
output: {every: 10 ms, sensors: {p: {position: arm/end}, w: {angular-velocity: arm/start}, rub: {spring-torque: rub}, balance: {energy: balance}, lost: {energy: joint-friction}}}
"""


@pytest.mark.parametrize("frames", ["", ", frames: 2"])
def test_a_flexible_arm_is_held(sensors, tmp_path, frames):
    """1.09 N m of its weight and up to 0.3 N m of the push: below the bound at first, and beyond it later."""
    out = sensors(ARM.replace("FRAMES", frames).replace("1.3 N m", "3 N m"))
    assert failed_steps(tmp_path) == 0
    assert numpy.abs(vector(out, "w")).max() < 1e-9
    assert numpy.abs(out["lost"]).max() < 1e-9
    slides = sensors(ARM.replace("FRAMES", frames))
    # It vibrates, and where it breaks away and sticks several times within a step, that may be halved.
    assert failed_steps(tmp_path) <= 3
    assert slides["lost"][-1] > 1e-3
    assert numpy.linalg.norm(vector(slides, "rub"), axis=0).max() < 1.3 * (1 + 1e-9)
    assert abs(slides["balance"]).max() < 2e-2 * slides["lost"][-1]


def test_parts_of_a_flexible_arm_move_alike(sensors):
    one, two = (sensors(ARM.replace("FRAMES", frames)) for frames in ("", ", frames: 2"))
    assert vector(one, "p") == pytest.approx(vector(two, "p"), abs=2e-3)


# A ball of 1 kg strikes the end of an arm that its own ball joint holds by a preload.
BLOW = """
buckens: 1
gravity: [0, 0, 0]
bodies:
  arm: {rigid: {mass: 1 kg, inertia: [0.01, 0.04, 0.04]}, at: {position: [0.3, 0, 0]}, markers: {o: {position: [-0.3, 0, 0]}, tip: {position: [0.3, 0, 0]}}}
  shot: {rigid: {mass: 1 kg, inertia: [1e-3, 1e-3, 1e-3]}, at: {position: [0.6, -0.3, 0.0]}}
joints: {ball: {spherical: {between: [ground, arm/o]}}}
loads:
  rub: {ball-friction: {joint: ball, static: 0, preload: 0.26 N m, stick: rigid}}
  hit: {contact: {between: [arm/tip, shot], shapes: [{sphere: 50 mm}, {sphere: 50 mm}], restitution: 0.5}}
initial: {bodies: {shot: {velocity: [0, 2, 0]}}}
simulation: {duration: 0.5 s, step: 0.6 ms}
output: {every: 0.6 ms, sensors: {w: {angular-velocity: arm}, v: {velocity: shot}, struck: {energy: impacts}, balance: {energy: balance}}}
"""


def test_a_blow_leaves_friction_no_time(sensors):
    out = sensors(BLOW)
    inertia = 0.04 + 0.09
    # They meet after 0.1 s at the end of an arm of 0.6 m: the common speed, and half of the speed of approach apart.
    p = 1.5 * 2 / (1 / 1 + 0.36 / inertia)
    w = 0.6 * p / inertia
    before, after = out["t"] < 0.0994, out["t"] > 0.1007
    assert numpy.abs(vector(out, "w")[:, before]).max() < 1e-12
    # Both have moved on by up to a step when they are seen to have met, and with them the line of the blow: by (0.6 ms x 2 m/s / 0.1 m)^2.
    assert out["v.y"][after] == pytest.approx(2 - p, abs=1.5e-4)
    assert out["w.z"][after] == pytest.approx(w - 2 * (out["t"][after] - 0.1), abs=1.5e-4 * w)
    assert numpy.abs(out["w.x"]).max() < 1e-12
    hinge = sensors(BLOW.replace("spherical: {between: [ground, arm/o]", "revolute: {between: [ground, arm/o], axis: [0, 0, 1]").replace("ball-friction", "hinge-friction"))
    for name in ("w.z", "v.y", "struck", "balance"):
        assert out[name] == pytest.approx(hinge[name], abs=1e-9)


@pytest.mark.parametrize("coefficient", ["0.1", "0.4"])
def test_crosses_of_a_flexible_crank_slide_as_with_stiff_springs(sensors, tmp_path, coefficient):
    rod, slider = OUT_OF_PLANE
    text = SPACE_CRANK.replace("ROD", rod).replace("SLIDER", slider).replace("MU", coefficient).replace("BIG", "universal").replace("AXES", ", axis: [0, 0, 1], second-axis: [0, 1, 0]")
    # With 0.1 ms both differ by 6e-3 of the loss, with half of that by a fifth of it: it is the error of the step.
    text = text.replace("step: 0.1 ms", "step: 0.05 ms")
    elastic = sensors(text)
    rigid = sensors(text.replace("radius: 8 mm", "radius: 8 mm, stick: rigid"))
    assert failed_steps(tmp_path) == 0
    assert abs(rigid["balance"]).max() < 2e-3 * rigid["lost"][-1]
    assert rigid["lost"] == pytest.approx(elastic["lost"], abs=3e-3 * elastic["lost"][-1])


def test_in_the_plane_it_is_that_of_a_hinge(sensors):
    text = """
buckens: 1
planar: zx
gravity: [0, 0, -9.81]
bodies: {bob: {rigid: {mass: 1 kg, inertia: [0, 3e-3, 0]}, at: {position: [0.3, 0, 0]}, markers: {o: {position: [-0.3, 0, 0]}}}}
joints: {j: {JOINT: {between: [ground, bob/o]}}}
loads: {rub: {KIND: {joint: j, static: 0.3, radius: 30 mm, stick: rigid}}}
simulation: {duration: 3 s, step: 1 ms}
output: {every: 10 ms, sensors: {p: {position: bob}, balance: {energy: balance}, lost: {energy: joint-friction}}}
"""
    ball = sensors(text.replace("JOINT", "spherical").replace("KIND", "ball-friction"))
    hinge = sensors(text.replace("JOINT", "revolute").replace("KIND", "hinge-friction"))
    assert hinge["lost"][-1] > 1
    for name in ("p.x", "p.z", "lost", "balance"):
        assert ball[name] == pytest.approx(hinge[name], abs=1e-9)


@pytest.mark.parametrize("bush", ["rotational-stiffness: [300, 300, 300], rotational-damping: [0.1, 0.1, 0.1]", "rotational-damping: [0.3, 0.3, 0.3]"],
                         ids=["spring", "damper"])
def test_beside_a_stiff_bushing_it_settles(sensors, tmp_path, bush):
    """Within a step the bushing resists by three times the inertia of the bob, and the decision about the ball must know of it."""
    text = BALLS.replace("joints:\n", f"joints:\n  bush: {{bushing: {{between: [arm/e, bob/o], {bush}}}}}\n").replace("{energy: dissipated}", "{energy: joint-friction}")
    elastic = sensors(text.replace("step: 1 ms", "step: 0.25 ms"))
    rigid = sensors(text.replace("radius: 10 mm", "radius: 10 mm, stick: rigid").replace("radius: 8 mm", "radius: 8 mm, stick: rigid"))
    assert failed_steps(tmp_path) == 0
    # Elastic slip itself changes by 3e-3 from steps of 1 ms to those of 0.25 ms.
    assert rigid["lost"] == pytest.approx(elastic["lost"], abs=2e-3 * elastic["lost"][-1])


def chain(seed):
    """Four links on balls with random sizes, thrown into a tumble."""
    chance = random.Random(seed)
    bodies, joints, rubs, speeds, place = [], [], [], [], 0
    for k in range(4):
        length, mass = chance.uniform(0.1, 0.3), chance.uniform(0.2, 2)
        most = mass * length**2 * chance.uniform(0.05, 0.2)
        inertia = [most * chance.uniform(0.3, 1), most, most * chance.uniform(0.8, 1)]
        bodies.append(f"  b{k}: {{rigid: {{mass: {mass}, inertia: {inertia}}}, at: {{position: [{place + length / 2}, 0, 0]}}, "
                      f"markers: {{o: {{position: [{-length / 2}, 0, 0]}}, e: {{position: [{length / 2}, 0, 0]}}}}}}\n")
        joints.append(f"  j{k}: {{spherical: {{between: [{f'b{k - 1}/e' if k else 'ground'}, b{k}/o]}}}}\n")
        rubs.append(f"  f{k}: {{ball-friction: {{joint: j{k}, static: 0.8, radius: {chance.uniform(5, 40)} mmSTICK}}}}\n")
        speeds.append(f"b{k}: {{angular-velocity: {[chance.uniform(-5, 5) for _ in range(3)]}}}")
        place += length
    return ("buckens: 1\ngravity: [0, 0, -9.81]\nbodies:\n" + "".join(bodies) + "joints:\n" + "".join(joints) + "loads:\n" + "".join(rubs)
            + f"initial: {{bodies: {{{', '.join(speeds)}}}}}\nsimulation: {{duration: 1 s, step: 1 ms}}\n"
            + "output: {every: 10 ms, sensors: {p: {position: b3/e}, balance: {energy: balance}, lost: {energy: joint-friction}}}\n")


@pytest.mark.parametrize("seed", range(4))
def test_random_chains_tumble_as_with_stiff_springs(sensors, tmp_path, seed):
    elastic = sensors(chain(seed).replace("STICK", ""))
    rigid = sensors(chain(seed).replace("STICK", ", stick: rigid"))
    assert failed_steps(tmp_path) == 0
    assert rigid["lost"] == pytest.approx(elastic["lost"], abs=3e-3 * elastic["lost"][-1])
    assert abs(rigid["balance"]).max() < 2e-3 * rigid["lost"][-1]
