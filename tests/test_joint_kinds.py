# SPDX-License-Identifier: Apache-2.0
"""Joints with exact motions: each kind in a model of its own parts, several parts in one run."""

import math

import numpy
import pytest

G = 9.81


# Two shafts that meet at the origin under an angle, held by bearings; the first one is driven.
SHAFTS = """
buckens: 1
parameters: {b: BEND}
bodies:
  input: {rigid: {mass: 1 kg, inertia: [0.01, 0.01, 0.01]}}
  output: {rigid: {mass: 1 kg, inertia: [0.01, 0.01, 0.01]}}
joints:
  bearing: {revolute: {between: [ground, input], axis: [1, 0, 0]}}
  motor: {prescribed-rotation: {between: [ground, input], axis: [1, 0, 0], speed: 10 rad/s}}
  far: {cylindrical: {between: [ground, output], axis: ["cos(b)", "sin(b)", 0]}}
  JOINT
initial: {bodies: {input: {angular-velocity: [10, 0, 0]}, output: {angular-velocity: ["10*RATIO*cos(b)", "10*RATIO*sin(b)", 0]}}}
simulation: {duration: 0.7 s, step: 1 ms}
output:
  every: 5 ms
  sensors: {one: {joint-coordinate: bearing}, two: {joint-coordinate: far}}
"""

CROSS = "cross: {universal: {between: [input, output], axis: [0, 1, 0], second-axis: [0, 0, 1]}}"


@pytest.mark.parametrize("bend", [10, 30, 45])
def test_a_cross_joint_turns_the_second_shaft_unevenly(sensors, bend):
    b = math.radians(bend)
    # At the start the arm held by the input lies in the plane of the shafts: the ratio is 1/cos b there.
    out = sensors(SHAFTS.replace("BEND", f"{bend} deg").replace("JOINT", CROSS).replace("RATIO", "1/cos(b)"))
    first, second = out["one.value"], out["two.value"]
    assert first == pytest.approx(10 * out["t"], abs=1e-10)
    expected = numpy.arctan2(numpy.sin(first), numpy.cos(first) * math.cos(b))
    expected += 2 * math.pi * numpy.round((first - expected) / (2 * math.pi))
    # Positions and velocities are closed at the end of each step, records every 5 steps: no order enters.
    assert second == pytest.approx(expected, abs=1e-9)
    ratio = math.cos(b) / (1 - (math.sin(b) * numpy.cos(first)) ** 2)
    assert out["two.rate"] == pytest.approx(10 * ratio, abs=1e-7)
    # The largest lead, 4.11719427 degrees at 30; records every 0.05 rad miss it by 2e-3 of itself at most.
    lead = math.atan((1 - math.cos(b)) / (2 * math.sqrt(math.cos(b))))
    assert numpy.abs(second - first).max() == pytest.approx(lead, rel=3e-3)


# A shaft between two crosses: bent back by the second one, so that the outer shafts are parallel, or bent on.
DOUBLE = """
buckens: 1
parameters: {b: BEND, c: "FAR"}
bodies:
  input: {rigid: {mass: 1 kg, inertia: [0.01, 0.01, 0.01]}}
  shaft: {rigid: {mass: 1 kg, inertia: [0.01, 0.01, 0.01]}, markers: {end: {position: ["0.3*cos(b)", "0.3*sin(b)", 0]}}}
  output: {rigid: {mass: 1 kg, inertia: [0.01, 0.01, 0.01]}, at: {position: ["0.3*cos(b)", "0.3*sin(b)", 0]}}
joints:
  bearing: {revolute: {between: [ground, input], axis: [1, 0, 0]}}
  motor: {prescribed-rotation: {between: [ground, input], axis: [1, 0, 0], speed: 10 rad/s}}
  near: {universal: {between: [input, shaft], axis: [0, 1, 0], second-axis: [0, 0, 1]}}
  cross: {universal: {between: [shaft/end, output], FORKS}}
  far: {cylindrical: {between: [{ground: ["0.3*cos(b)", "0.3*sin(b)", 0]}, output], axis: ["cos(c)", "sin(c)", 0]}}
initial:
  bodies:
    input: {angular-velocity: [10, 0, 0]}
    shaft: {angular-velocity: ["10/cos(b)*cos(b)", "10/cos(b)*sin(b)", 0]}
    output: {angular-velocity: ["10*RATIO*cos(c)", "10*RATIO*sin(c)", 0]}
simulation: {duration: 0.7 s, step: 1 ms}
output: {every: 5 ms, sensors: {one: {joint-coordinate: bearing}, two: {joint-coordinate: far}}}
"""


@pytest.mark.parametrize("far", ["0", "2*b"])
@pytest.mark.parametrize("bend", [10, 30, 45])
def test_two_crosses_undo_each_other_or_add_up(sensors, bend, far):
    """Equal angles. Forks of the shaft in line: ratio 1 throughout. Turned by 90 degrees: tan(two) = tan(one)/cos² b."""
    text = DOUBLE.replace("BEND", f"{bend} deg").replace("FAR", far)
    aligned = 'axis: [0, 0, 1], second-axis: ["-sin(c)", "cos(c)", 0]'
    out = sensors(text.replace("FORKS", aligned).replace("RATIO", "1"))
    # Positions and velocities are closed at the end of each step: no order enters.
    assert out["two.value"] == pytest.approx(10 * out["t"], abs=1e-9)
    assert out["two.rate"] == pytest.approx(10, abs=1e-7)
    turned = 'axis: ["-sin(b)", "cos(b)", 0], second-axis: [0, 0, 1]'
    out = sensors(text.replace("FORKS", turned).replace("RATIO", "1/cos(b)^2"))
    first, c = out["one.value"], math.cos(math.radians(bend)) ** 2
    expected = numpy.arctan2(numpy.sin(first), numpy.cos(first) * c)
    expected += 2 * math.pi * numpy.round((first - expected) / (2 * math.pi))
    assert out["two.value"] == pytest.approx(expected, abs=1e-9)
    assert out["two.rate"] == pytest.approx(10 * c / ((c * numpy.cos(first)) ** 2 + numpy.sin(first) ** 2), abs=1e-7)


@pytest.mark.parametrize("bend", [0, 40, 75])
def test_shafts_of_a_constant_velocity_joint_turn_alike(sensors, bend):
    joint = "cv: {constant-velocity: {between: [input, output], axis: [1, 0, 0], second-axis: [\"cos(b)\", \"sin(b)\", 0]}}"
    out = sensors(SHAFTS.replace("BEND", f"{bend} deg").replace("JOINT", joint).replace("RATIO", "1"))
    assert out["two.value"] == pytest.approx(10 * out["t"], abs=1e-9)
    assert out["two.rate"] == pytest.approx(10, abs=1e-7)


def test_a_nut_runs_down_its_screw(sensors):
    """a = m g/(m + J (2 pi/p)²) for m 1 kg, J 1e-4 kg m², p 10 mm: 0.242351371 m/s²."""
    out = sensors("""
buckens: 1
gravity: [0, 0, -9.81]
bodies: {nut: {rigid: {mass: 1 kg, inertia: [1e-4, 1e-4, 1e-4]}}}
joints: {thread: {screw: {between: [ground, nut], axis: [0, 0, -1], pitch: 10 mm}}}
simulation: {duration: 1 s, step: 1 ms}
output:
  every: 0.1 s
  sensors:
    way: {joint-coordinate: {joint: thread, which: displacement}}
    angle: {joint-coordinate: thread}
    torque: {joint-torque: thread}
    balance: {energy: balance}
""")
    a = G / (1 + 1e-4 * (2 * math.pi / 0.01) ** 2)
    assert a == pytest.approx(0.242351371, abs=1e-9)
    # Constant acceleration is integrated exactly by the method.
    assert out["way.value"] == pytest.approx(0.5 * a * out["t"] ** 2, abs=1e-9)
    assert out["way.rate"] == pytest.approx(a * out["t"], abs=1e-9)
    assert out["angle.value"] == pytest.approx(2 * math.pi * out["way.value"] / 0.01, abs=1e-6)
    assert out["angle.value"][-1] > 70  # twelve turns
    # The thread turns the nut by J alpha about the axis, which points down.
    assert out["torque.z"][-1] == pytest.approx(-1e-4 * a * 2 * math.pi / 0.01, rel=1e-6)
    assert out["balance"] == pytest.approx(0, abs=1e-6)


def test_a_rod_keeps_its_length(sensors):
    """IFToMM A01, a point mass on a massless rod: places by Jacobi's elliptic functions."""
    out = sensors("""
buckens: 1
gravity: [0, -9.81, 0]
bodies: {bob: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}, at: {position: [-1, 0, 0]}}}
joints: {rod: {distance: {between: [ground, bob]}}}
simulation: {duration: 5 s, step: 0.5 ms}
output: {every: 1 s, sensors: {p: {position: bob}, rod: {joint-force: rod}, v: {velocity: bob}}}
""")
    # Order h² with w h = 1.6e-3: 1e-6 per radian, 16 rad in 5 s.
    assert [out["p.x"][1], out["p.y"][1]] == pytest.approx([0.9862917511, -0.1650108531], abs=1e-5)
    assert [out["p.x"][5], out["p.y"][5]] == pytest.approx([-0.9423054350, -0.3347543384], abs=5e-5)
    assert numpy.hypot(out["p.x"], out["p.y"]) == pytest.approx(1, abs=1e-11)
    # Tension m (v² + g cos) towards the ground.
    tension = out["v.x"] ** 2 + out["v.y"] ** 2 - G * out["p.y"]
    assert out["rod.x"][1:] == pytest.approx((-tension * out["p.x"])[1:], rel=1e-4, abs=1e-3)


def test_guides_let_go_what_they_are_named_for(sensors):
    """Constant forces and torques on bodies at rest: every motion is ½ a t², exact for the method."""
    kinds = {
        "cylinder": "cylindrical: {between: [ground, NAME], axis: [0, 0, 1]}",
        "face": "planar: {between: [ground, NAME], axis: [0, 0, 1]}",
        "bead": "point-on-line: {between: [ground, NAME], axis: [0, 0, 1]}",
        "puck": "point-in-plane: {between: [ground, NAME], axis: [0, 0, 1]}",
        "top": "parallel: {between: [ground, NAME], axis: [0, 0, 1]}",
        "tray": "orientation: {between: [ground, NAME]}",
    }
    bodies = "\n".join(f"  {n}: {{rigid: {{mass: 2 kg, inertia: [0.5, 0.5, 0.5]}}}}" for n in kinds)
    joints = "\n".join(f"  {n}_joint: {{{k.replace('NAME', n)}}}" for n, k in kinds.items())
    loads = "\n".join(f"  {n}_push: {{force: {{on: {n}, value: [1, 2, 3]}}}}\n"
                      f"  {n}_turn: {{torque: {{on: {n}, value: [0.01, 0.02, 0.03]}}}}" for n in kinds)
    seen = "\n".join(f"    {n}_p: {{displacement: {n}}}\n    {n}_r: {{rotation: {n}}}\n"
                     f"    {n}_f: {{joint-force: {n}_joint}}\n    {n}_t: {{joint-torque: {n}_joint}}" for n in kinds)
    out = sensors(f"""
buckens: 1
bodies:
{bodies}
joints:
{joints}
loads:
{loads}
simulation: {{duration: 0.5 s, step: 1 ms}}
output:
  every: 0.5 s
  sensors:
    way: {{joint-coordinate: {{joint: cylinder_joint, which: displacement}}}}
    turn: {{joint-coordinate: cylinder_joint}}
    along: {{joint-coordinate: bead_joint}}
{seen}
""")
    free = {  # displacements along x, y, z; rotations about x, y, z
        "cylinder": (0, 0, 1, 0, 0, 1), "face": (1, 1, 0, 0, 0, 1), "bead": (0, 0, 1, 1, 1, 1),
        "puck": (1, 1, 0, 1, 1, 1), "top": (1, 1, 1, 0, 0, 1), "tray": (1, 1, 1, 0, 0, 0),
    }
    half = 0.5 * 0.5**2
    for name, mask in free.items():
        for k, axis in enumerate("xyz"):
            force, torque = 1.0 + k, 0.01 * (1 + k)
            assert out[f"{name}_p.{axis}"][-1] == pytest.approx(mask[k] * force / 2 * half, abs=1e-11), name
            assert out[f"{name}_r.{axis}"][-1] == pytest.approx(mask[3 + k] * torque / 0.5 * half, abs=1e-11), name
            # Constrained directions respond to the load; free ones have no reaction.
            assert out[f"{name}_f.{axis}"][-1] == pytest.approx((mask[k] - 1) * force, abs=1e-9), name
            assert out[f"{name}_t.{axis}"][-1] == pytest.approx((mask[3 + k] - 1) * torque, abs=1e-9), name
    assert out["way.value"][-1] == pytest.approx(1.5 * half, abs=1e-11)
    assert out["turn.value"][-1] == pytest.approx(0.06 * half, abs=1e-11)
    assert out["along.value"][-1] == pytest.approx(1.5 * half, abs=1e-11)


PLANE = """
buckens: 1
planar: xy
gravity: [0, -9.81, 0]
bodies:
  bead: {rigid: {mass: 1 kg, inertia: [0, 0, 1]}}
  puck: {rigid: {mass: 1 kg, inertia: [0, 0, 1]}}
  bob: {rigid: {mass: 1 kg, inertia: [0, 0, 1]}, at: {position: [-1, 0, 0]}}
  tray: {rigid: {mass: 1 kg, inertia: [0, 0, 1]}}
joints:
  line: {point-on-line: {between: [ground, bead], axis: ["cos(pi/6)", "-sin(pi/6)", 0]}}
  plane: {point-in-plane: {between: [ground, puck], axis: ["sin(pi/6)", "cos(pi/6)", 0]}}
  rod: {distance: {between: [ground, bob]}}
  level: {orientation: {between: [ground, tray]}}
loads:
  turn: {torque: {on: tray, value: [0, 0, 1]}}
simulation: {duration: 1 s, step: 0.5 ms}
output:
  every: 1 s
  sensors: {line: {joint-coordinate: line}, puck: {displacement: puck}, bob: {position: bob}, tray: {rotation: tray},
            held: {joint-torque: level}}
"""


def test_joints_in_the_plane(sensors):
    out = sensors(PLANE)
    assert out["line.value"][-1] == pytest.approx(0.25 * G, rel=1e-10)
    assert math.hypot(out["puck.x"][-1], out["puck.y"][-1]) == pytest.approx(0.25 * G, rel=1e-10)
    # As in space, order h².
    assert out["bob.x"][-1] == pytest.approx(0.9862917511, abs=1e-5)
    assert out["tray.z"][-1] == pytest.approx(0, abs=1e-14) and out["held.z"][-1] == pytest.approx(-1, rel=1e-9)


@pytest.mark.parametrize("joint, words", [
    ("cylindrical: {between: [ground, bead], axis: [1, 0, 0]}", ["cylindrical", "no place in a planar model", "`prismatic`"]),
    ("planar: {between: [ground, bead], axis: [0, 0, 1]}", ["planar joint", "held by the plane already"]),
    ("universal: {between: [ground, bead], axis: [1, 0, 0], second-axis: [0, 1, 0]}", ["universal", "`revolute`"]),
    ("constant-velocity: {between: [ground, bead], axis: [1, 0, 0]}", ["constant-velocity", "`revolute`"]),
    ("parallel: {between: [ground, bead], axis: [1, 0, 0]}", ["parallel", "remove it"]),
    ("screw: {between: [ground, bead], axis: [1, 0, 0], pitch: 1 mm}", ["screw", "no place in a planar model"]),
    ("point-on-line: {between: [ground, bead], axis: [0, 0, 1]}", ["point-on-line", "must lie in the plane"]),
    ("point-in-plane: {between: [ground, bead], axis: [1, 0, 1]}", ["point-in-plane", "must lie in the plane"]),
])
def test_a_plane_has_no_place_for_some(buckens, tmp_path, joint, words):
    old = "point-on-line: {between: [ground, bead], axis: [\"cos(pi/6)\", \"-sin(pi/6)\", 0]}"
    assert old in PLANE
    (tmp_path / "model.yaml").write_text(PLANE.replace(old, joint).replace("line: {joint-coordinate: line}, ", ""))
    buckens("check", "model.yaml").must(3, "model.yaml:11:", "joint \"line\"", *words)


SPACE = """
buckens: 1
bodies: {disc: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}}}
joints:
  one: {JOINT}
simulation: {duration: 1 ms, step: 1 ms}
"""


@pytest.mark.parametrize("joint, code, words", [
    ("universal: {between: [ground, disc], axis: [1, 0, 0], second-axis: [1, 1, 0]}", 2, ["meet at 45 degrees", "perpendicular"]),
    ("universal: {between: [ground, disc], axis: [1, 0, 0], second-axis: [0, 0, 0]}", 2, ["[0, 0, 0]"]),
    ("universal: {between: [ground, disc], axis: [1, 0, 0]}", 2, ["second-axis"]),
    ("constant-velocity: {between: [ground, disc], axis: [1, 0, 0], second-axis: [0, 1, 0]}", 3, ["85 degrees", "by 90"]),
    ("distance: {between: [ground, disc]}", 3, ["no direction", "coincide", "`spherical`"]),
    ("screw: {between: [ground, disc], axis: [1, 0, 0], pitch: 0}", 2, ["with zero pitch", "`revolute`"]),
    ("cylindrical: {between: [ground, disc], axis: [0, 0, 0]}", 2, ["[0, 0, 0]", "direction"]),
])
def test_joints_that_make_no_sense_are_refused(buckens, tmp_path, joint, code, words):
    (tmp_path / "model.yaml").write_text(SPACE.replace("JOINT", joint))
    buckens("check", "model.yaml").must(code, "model.yaml:5:", *words)
