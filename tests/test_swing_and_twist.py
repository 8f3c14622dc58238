# SPDX-License-Identifier: Apache-2.0
"""Swing and twist of ball joints and of shafts of constant velocity: cones, springs, drives."""

import math

import numpy
import pytest

G = 9.81


# A thin rod that hangs on a ball joint; the second axis is along the rod.
ROD = """
buckens: 1
gravity: GRAVITY
bodies: {rod: {rigid: {mass: 2 kg, com: [0, 0, -0.3], inertia: [0.06, 0.06, 0.001]}, markers: {top: {position: [0, 0, 0]}}, at: {orientation: {euler: [TILT rad, 0, 0]}}}}
joints: {ball: {spherical: {between: [ground, rod/top], axis: [0, 0, -1], second-axis: [0, SINE, COSINE]}}}
MORE
simulation: {duration: DURATION, step: STEP}
output:
  every: 10 ms
  sensors:
    swing: {joint-coordinate: {joint: ball, which: swing}}
    twist: {joint-coordinate: {joint: ball, which: twist}}
    end: {angular-velocity: rod}
    balance: {energy: balance}
"""
ABOUT_PIVOT = 0.06 + 2 * 0.3**2


def rod(more="", tilt=0.0, gravity="[0, 0, -9.81]", duration="1 s", step="1 ms"):
    return (ROD.replace("GRAVITY", gravity).replace("TILT", repr(tilt)).replace("COSINE", repr(-math.cos(tilt)))
            .replace("SINE", repr(math.sin(tilt))).replace("MORE", more).replace("DURATION", duration).replace("STEP", step))


@pytest.mark.parametrize("stiffness", ["stiffness: 1e5", "restitution: 0"])
def test_a_conical_pendulum_leans_on_its_cone(sensors, stiffness):
    """Faster than the pendulum of this cone, it presses with (A - C) w² sin cos - m g l sin."""
    cone, w = 0.5, 8.0
    torque = (ABOUT_PIVOT - 0.001) * w**2 * math.sin(cone) * math.cos(cone) - 2 * G * 0.3 * math.sin(cone)
    assert torque > 2
    start = cone + (torque / 1e5 if "stiff" in stiffness else 0)
    out = sensors(rod(f"""
loads: {{cone: {{hinge-stop: {{joint: ball, which: swing, to: {cone}, {stiffness}}}}}}}
initial: {{bodies: {{rod: {{angular-velocity: [0, {math.sin(start) * w}, {math.cos(start) * w}], velocity: [{0.3 * math.sin(start) * -w}, 0, 0]}}}}}}
""", tilt=start).replace("  sensors:", "  sensors:\n    torque: {spring-torque: cone}\n    ball: {joint-force: ball}"))
    # It leans on the cone all the time; the elastic one's softness differs from the exact one by its square.
    assert out["swing.value"] == pytest.approx(start, abs=1e-8)
    assert numpy.abs(out["torque"][1:]) == pytest.approx(torque, rel=1e-4)
    # Around the vertical, which is against the axis: minus a whole turn of twist per turn, counted.
    assert out["twist.rate"] == pytest.approx(-w, rel=1e-6)
    assert out["twist.value"] == pytest.approx(-w * out["t"], abs=1e-4)
    assert abs(out["twist.value"][-1]) > 2 * math.pi
    assert numpy.abs(out["balance"]).max() < 1e-5


def test_slower_it_leaves_the_cone(sensors):
    out = sensors(rod("""
loads: {cone: {hinge-stop: {joint: ball, which: swing, to: 0.5}}}
initial: {bodies: {rod: {angular-velocity: [0, %r, %r], velocity: [%r, 0, 0]}}}
""" % (math.sin(0.5) * 3, math.cos(0.5) * 3, -0.3 * math.sin(0.5) * 3), tilt=0.5))
    assert out["swing.value"].min() < 0.4
    assert out["swing.value"].max() < 0.5 + 1e-9
    assert numpy.abs(out["balance"]).max() < 1e-4


def test_a_spring_on_the_swing_pulls_through_zero(sensors):
    """I |q|'' = -k |q|: the swing is |q|, and nothing happens where it has no direction."""
    k, w0, h = 6.0, 2.0, 1e-3
    w = math.sqrt(k / ABOUT_PIVOT)
    for tilt in (0.0, 0.3):
        q = tilt * numpy.cos(w * numpy.linspace(0, 2, 201)) + w0 / w * numpy.sin(w * numpy.linspace(0, 2, 201))
        out = sensors(rod(f"""
loads: {{back: {{hinge-spring: {{joint: ball, which: swing, stiffness: {k}}}}}}}
initial: {{bodies: {{rod: {{angular-velocity: [{w0}, 0, 0], velocity: [0, {0.3 * w0 * math.cos(tilt)}, {0.3 * w0 * math.sin(tilt)}]}}}}}}
""", tilt=tilt, gravity="[0, 0, 0]", duration="2 s"))
        # Phase errors of second order: (w h)²/12 of w t, and more.
        assert out["swing.value"] == pytest.approx(numpy.abs(q), abs=w * 2 * (w * h) ** 2)
        assert numpy.abs(out["balance"]).max() < (w * h) ** 2 * 0.5 * ABOUT_PIVOT * w0**2


def test_a_spring_on_the_swing_is_as_soft_in_all_directions(sensors):
    """Started aside, a mass on it runs around an ellipse, whose half axes keep their directions."""
    k, h = 60.0, 1e-3
    w = math.sqrt(k / ABOUT_PIVOT)
    out = sensors(rod(f"""
loads: {{back: {{hinge-spring: {{joint: ball, which: swing, stiffness: {k}}}}}}}
initial: {{bodies: {{rod: {{angular-velocity: [0, {0.01 * w}, 0], velocity: [{-0.3 * 0.01 * w}, 0, 0]}}}}}}
""", tilt=0.02, gravity="[0, 0, 0]", duration="2 s"))
    exact = numpy.hypot(0.02 * numpy.cos(w * out["t"]), 0.01 * numpy.sin(w * out["t"]))
    # Small angles: cubes of them, (0.02)³ w t, and (w h)²/12 of the phase.
    assert out["swing.value"] == pytest.approx(exact, abs=0.02 * w * 2 * ((w * h) ** 2 / 12 + 0.02**2))
    assert numpy.abs(out["balance"]).max() < (w * h) ** 2 * 0.5 * k * 0.02**2


def test_a_twist_is_sprung_and_driven(sensors):
    """About the rod, bent by 0.4 rad as it stays: C'' with C of the rod. And a drive over many turns."""
    k, C = 0.4, 0.001
    hold = "joints: {ball: "
    w = math.sqrt(k / C)
    out = sensors(rod(f"""
loads: {{wind: {{hinge-spring: {{joint: ball, which: twist, stiffness: {k}}}}}}}
initial: {{joints: {{ball: {{twist: 0.3}}}}}}
""", gravity="[0, 0, 0]", duration="0.5 s", step="0.2 ms"))
    assert out["twist.value"] == pytest.approx(0.3 * numpy.cos(w * out["t"]), abs=0.3 * w * 0.5 * (w * 2e-4) ** 2)
    assert numpy.abs(out["balance"]).max() < 1e-9
    out = sensors(rod(tilt=0.4, gravity="[0, 0, 0]").replace(
        hold, "joints: {turn: {prescribed-coordinate: {joint: ball, which: twist, speed: 40 rad/s}}, "
              "bend: {prescribed-coordinate: {joint: ball, which: swing, angle: \"0.4 + 0.2*sin(5*t)\"}}, ball: "))
    assert out["twist.value"] == pytest.approx(40 * out["t"], abs=1e-9)
    assert out["swing.value"] == pytest.approx(0.4 + 0.2 * numpy.sin(5 * out["t"]), abs=1e-10)


def test_shafts_of_constant_velocity_swing(sensors):
    out = sensors("""
buckens: 1
bodies:
  in: {rigid: {mass: 1 kg, inertia: [1e-3, 1e-3, 1e-3]}}
  out: {rigid: {mass: 1 kg, inertia: [1e-3, 1e-3, 1e-3]}}
joints:
  shaft: {revolute: {between: [ground, in], axis: [1, 0, 0]}}
  knuckle: {constant-velocity: {between: [in, out], axis: [1, 0, 0], second-axis: [1, 1, 0]}}
loads: {back: {hinge-spring: {joint: knuckle, which: swing, stiffness: 0.5}}, wide: {hinge-stop: {joint: knuckle, to: 60 deg}}}
simulation: {duration: 0.1 s, step: 1 ms}
output: {every: 1 ms, sensors: {bend: {joint-coordinate: knuckle}, balance: {energy: balance}}}
""")
    assert out["bend.value"][0] == pytest.approx(math.pi / 4, abs=1e-12)
    # Nothing turns: the second body alone swings about its centre.
    w = math.sqrt(0.5 / 1e-3)
    assert out["bend.value"] == pytest.approx(numpy.abs(math.pi / 4 * numpy.cos(w * out["t"])), abs=2e-3)
    assert numpy.abs(out["balance"]).max() < 1e-6


@pytest.mark.parametrize("tilt", [0.0, 0.3])
def test_a_spring_on_the_swing_bends_both_ways_in_modes(buckens, tmp_path, tilt):
    """Also where the swing has no direction; the twist alone is free."""
    k = 60.0
    (tmp_path / "model.yaml").write_text(rod(f"loads: {{back: {{hinge-spring: {{joint: ball, which: swing, stiffness: {k}}}}}}}", tilt=tilt, gravity="[0, 0, 0]"))
    found = buckens("modes", "model.yaml", "--system", "--about", "static", "--json").must(0).json
    exact = math.sqrt(k / ABOUT_PIVOT) / (2 * math.pi)
    assert [mode["frequency"] for mode in found["analyses"][0]["modes"]] == pytest.approx([exact, exact], rel=1e-9)
