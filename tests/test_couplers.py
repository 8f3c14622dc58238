# SPDX-License-Identifier: Apache-2.0
"""Couplers, gears, racks and belts with exact motions and forces."""

import math

import numpy
import pytest

from conftest import SOURCE

G = 9.81



def test_couplers_act_on_all_bodies(sensors):
    """Shafts coupled by -0.1 on a carrier that turns; a rope over a pulley; a lever that follows a polynomial."""
    out = sensors("""
buckens: 1
gravity: [0, -9.81, 0]
bodies:
  carrier: {rigid: {mass: 1 kg, inertia: [7, 7, 7]}, markers: {a: {position: [0.5, 0, 0]}, b: {position: [-0.5, 0, 0]}}}
  one: {rigid: {mass: 1 kg, inertia: [10, 10, 10]}, at: {position: [0.5, 0, 0]}}
  two: {rigid: {mass: 1 kg, inertia: [100, 100, 100]}, at: {position: [-0.5, 0, 0]}}
  pulley: {rigid: {mass: 1 kg, inertia: [0.01, 0.01, 0.01]}, at: {position: [3, 0, 0]}}
  light: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}, at: {position: [2.9, -1, 0]}}
  heavy: {rigid: {mass: 2 kg, inertia: [1, 1, 1]}, at: {position: [3.1, -1, 0]}}
joints:
  gears: {coupler: {of: {first: -0.1, second: -1}}}    # stands before what it names
  pivot: {revolute: {between: [ground, carrier], axis: [0, 0, 1]}}
  first: {revolute: {between: [carrier/a, one], axis: [0, 0, 1]}}
  second: {revolute: {between: [carrier/b, two], axis: [0, 0, 1]}}
  wheel: {revolute: {between: [{ground: [3, 0, 0]}, pulley], axis: [0, 0, 1]}}
  left: {prismatic: {between: [{ground: [2.9, 0, 0]}, light], axis: [0, 1, 0]}}
  right: {prismatic: {between: [{ground: [3.1, 0, 0]}, heavy], axis: [0, 1, 0]}}
  rope_left: {coupler: {of: {wheel: 0.1, left: 1}}}
  rope_right: {coupler: {of: {left: 1, right: 1}}}
loads: {twist: {torque: {on: one, value: [0, 0, 6]}}}
simulation: {duration: 1 s, step: 1 ms}
output:
  every: 0.1 s
  sensors:
    first: {joint-coordinate: first}
    second: {joint-coordinate: second}
    pivot: {joint-coordinate: pivot}
    coupling: {joint-torque: gears}
    right: {joint-coordinate: right}
    wheel: {joint-coordinate: wheel}
    tension: {joint-force: rope_right}
    balance: {energy: balance}
""")
    # x the angle of the first shaft against the carrier, W the carrier's rate: masses 0.5 m off its axis.
    r, J1, J2, J3 = -0.1, 10, 100, 7 + 2 * 0.25
    M = numpy.array([[J1 + J2 + J3, J1 + r * J2], [J1 + r * J2, J1 + r * r * J2]])
    turn, x = numpy.linalg.solve(M, [6, 6])
    t = out["t"]
    # Constant accelerations are integrated exactly by the method; weights of 1 kg do no work about the pivot's
    # centre, where they balance.
    assert out["pivot.value"] == pytest.approx(0.5 * turn * t**2, abs=1e-9)
    assert out["first.value"] == pytest.approx(0.5 * x * t**2, abs=1e-9)
    assert out["second.value"] == pytest.approx(r * out["first.value"], abs=1e-13)
    assert out["second.rate"] == pytest.approx(r * out["first.rate"], abs=1e-12)
    # On the first shaft the coupler leaves J1 (W' + x') of the 6 N m.
    assert out["coupling.z"][1:] == pytest.approx(J1 * (turn + x) - 6, rel=1e-9)
    # Atwood with the pulley's inertia: (m2 - m1) g/(m1 + m2 + J/r²) = 2.4525.
    a = G / (3 + 0.01 / 0.1**2)
    assert a == pytest.approx(2.4525, abs=1e-12)
    assert out["right.value"] == pytest.approx(-0.5 * a * t**2, abs=1e-11)
    assert out["wheel.value"] == pytest.approx(10 * out["right.value"], abs=1e-10)
    # The row's first coordinate is the light body's: the rope to the heavy one holds it by 2 (g - a) N.
    assert out["tension.y"][1:] == pytest.approx(2 * (G - a), rel=1e-9)
    assert out["balance"] == pytest.approx(0, abs=1e-9)


def test_two_coupled_shafts_have_the_inertia_of_both(sensors):
    """chrono, utest_CH_shafts: J 10 and 100, ratio -0.1, 6 N m: 6/11 rad/s². From ten thousand turns on."""
    out = sensors("""
buckens: 1
bodies:
  one: {rigid: {mass: 1 kg, inertia: [10, 10, 10]}}
  two: {rigid: {mass: 1 kg, inertia: [100, 100, 100]}, at: {position: [1, 0, 0]}}
joints:
  first: {revolute: {between: [ground, one], axis: [0, 0, 1]}}
  second: {revolute: {between: [{ground: [1, 0, 0]}, two], axis: [0, 0, 1]}}
  gears: {coupler: {of: {second: 10, first: 1}}}
loads: {twist: {torque: {on: one, value: [0, 0, 6]}}}
initial: {bodies: {one: {angular-velocity: [0, 0, 1000]}, two: {angular-velocity: [0, 0, -100]}}}
simulation: {duration: 4 s, step: 2 ms}
output:
  every: 0.5 s
  sensors:
    first: {joint-coordinate: first}
    second: {joint-coordinate: second}
    coupling: {joint-torque: gears}
""")
    t = out["t"]
    alpha = 6 / 11
    assert out["first.rate"] == pytest.approx(1000 + alpha * t, abs=1e-9)
    # 4000 rad in steps of 2 rad; 17 digits of the file.
    assert out["first.value"] == pytest.approx(1000 * t + 0.5 * alpha * t**2, abs=1e-8)
    assert 10 * out["second.value"] + out["first.value"] == pytest.approx(0, abs=1e-11)
    # Torque on the second shaft: J2 r alpha. Angles within a turn are known to 1e-15 rad, accelerations to that over h².
    assert out["coupling.z"][1:] == pytest.approx(-0.1 * alpha * 100, rel=1e-8)


CURVE = """
buckens: 1
bodies:
  cam: {rigid: {mass: 1 kg, inertia: [0.5, 0.5, 0.5]}}
  lever: {rigid: {mass: 2 kg, inertia: [1, 1, 1]}, at: {position: [1, 0, 0]}}
joints:
  axle: {revolute: {between: [ground, cam], axis: [0, 0, 1]}}
  motor: {prescribed-rotation: {between: [ground, cam], axis: [0, 0, 1], speed: 2 rad/s}}
  guide: {prismatic: {between: [ground, lever], axis: [0, 1, 0]}}
  track: {coupler: {of: {guide: -1, axle: CURVE}}}
initial: {bodies: {cam: {angular-velocity: [0, 0, 2]}}}
simulation: {duration: 1 s, step: STEP ms}
output:
  every: 0.1 s
  sensors:
    cam: {joint-coordinate: axle}
    lift: {joint-coordinate: guide}
    torque: {joint-torque: motor}
    force: {joint-force: track}
    balance: {energy: balance}
"""


def test_a_lever_follows_a_polynomial(sensors):
    out = sensors(CURVE.replace("CURVE", "{polynomial: [0, 0, 0.3, -0.1]}").replace("STEP", "1"))
    p = numpy.polynomial.Polynomial([0, 0, 0.3, -0.1])
    x = out["cam.value"]
    assert x == pytest.approx(2 * out["t"], abs=1e-12)
    assert out["lift.value"] == pytest.approx(p(x), abs=1e-12)
    assert out["lift.rate"] == pytest.approx(2 * p.deriv()(x), abs=1e-11)
    # m p'' w² on the lever, p' times that on the motor; second order in the step.
    force = 2 * p.deriv(2)(x) * 4
    assert out["force.y"] == pytest.approx(force, abs=2e-2)
    assert out["torque.z"] == pytest.approx(p.deriv()(x) * force, abs=2e-2)
    # At the start accelerations are exact.
    assert out["force.y"][0] == pytest.approx(force[0], rel=1e-9)
    assert out["balance"] == pytest.approx(0, abs=1e-4)


def test_a_lever_follows_a_table(sensors, buckens, tmp_path):
    points = [[x, math.sin(x) ** 2] for x in numpy.linspace(-0.5, 2.2, 55).tolist()]
    text = CURVE.replace("CURVE", f"{{table: {points}}}").replace("STEP", "1")
    out = sensors(text)
    # A cubic spline through points 0.05 apart: 5/384 h⁴ times the fourth derivative, 8; less smooth at its ends.
    assert out["lift.value"] == pytest.approx(numpy.sin(out["cam.value"]) ** 2, abs=2e-6)
    (tmp_path / "short.yaml").write_text(text.replace("duration: 1 s", "duration: 1.2 s"))
    buckens("run", "short.yaml", "-o", "short").must(4, "joint \"track\": its table covers -0.5 to 2.2", "add points")


GEARS = """
buckens: 1
bodies:
  wheel: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}}
  pinion: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}, at: {position: [6, 0, 0]}}
joints:
  far: {revolute: {between: [ground, wheel], axis: [0, 0, 1]}}
  near: {revolute: {between: [{ground: [6, 0, 0]}, pinion], axis: [0, 0, 1]}}
  brake: {prescribed-rotation: {between: [ground, wheel], axis: [0, 0, 1], angle: 0}}
  teeth: {gear: {between: [wheel, pinion], axis: [0, 0, 1], teeth: [40, 20], pressure-angle: 20 deg, helix-angle: 10 deg}}
loads: {twist: {torque: {on: pinion, value: [0, 0, TORQUE]}}}
simulation: {duration: 10 ms, step: 1 ms}
output:
  every: 5 ms
  sensors: {bearing: {joint-force: near}, teeth: {joint-force: teeth}, brake: {joint-torque: brake}}
"""


def test_bearings_feel_the_force_of_teeth(sensors):
    """chrono, utest_CH_gears: radii 4 and 2 m, 1000 N m: 500, 184.7925 and 88.1635 N."""
    tangential = 1000 / 2
    radial = tangential * math.tan(math.radians(20)) / math.cos(math.radians(10))
    axial = tangential * math.tan(math.radians(10))
    assert radial == pytest.approx(184.7925, abs=5e-5)
    assert axial == pytest.approx(88.1635, abs=5e-5)
    for sign in (1, -1):
        out = sensors(GEARS.replace("TORQUE", str(sign * 1000)))
        # A pinion that turns forwards pushes against the wheel's teeth at its left side, and itself forwards.
        # Tangent and axis follow the torque, the push apart does not.
        for name, factor in (("teeth", 1), ("bearing", -1)):
            assert out[f"{name}.x"] == pytest.approx(factor * radial, rel=1e-9)
            assert out[f"{name}.y"] == pytest.approx(factor * sign * tangential, rel=1e-9)
            assert abs(out[f"{name}.z"]) == pytest.approx(axial, rel=1e-9)
        # Left-handed teeth that are kept from going forwards are kept from going along the axis.
        assert numpy.sign(out["teeth.z"][0]) == -sign
        assert out["brake.z"] == pytest.approx(sign * 2000, rel=1e-9)


def test_a_planetary_gear_keeps_the_ratio_of_willis(sensors):
    out = sensors("""
buckens: 1
bodies:
  sun: {rigid: {mass: 1 kg, inertia: [0.02, 0.02, 0.02]}}
  arm: {rigid: {mass: 1 kg, inertia: [0.3, 0.3, 0.3]}, markers: {pin: {position: [0.2, 0, 0]}}}
  planet: {rigid: {mass: 2 kg, inertia: [0.01, 0.01, 0.01]}, at: {position: [0.2, 0, 0]}}
joints:
  sun_axle: {revolute: {between: [ground, sun], axis: [0, 0, 1]}}
  arm_axle: {revolute: {between: [ground, arm], axis: [0, 0, 1]}}
  planet_axle: {revolute: {between: [arm/pin, planet], axis: [0, 0, 1]}}
  inner: {gear: {between: [sun, planet], axis: [0, 0, 1], teeth: [20, 20]}}
  outer: {gear: {between: [ground, planet], axis: [0, 0, 1], teeth: [60, 20], internal: on}}
loads: {on_sun: {torque: {on: sun, value: [0, 0, 3]}}}
simulation: {duration: 2 s, step: 2 ms}
output:
  every: 0.2 s
  sensors:
    sun: {joint-coordinate: sun_axle}
    arm: {joint-coordinate: arm_axle}
    planet: {joint-coordinate: planet_axle}
    balance: {energy: balance}
""")
    # The arm turns at z_sun/(z_sun + z_ring) = 1/4 of the sun, the planet against it at -3/4.
    inertia = 0.02 + (0.3 + 2 * 0.2**2) / 16 + 0.01 / 4
    # The planet's place on its circle is integrated to order h²: (w h)² with 15 rad/s at the end.
    assert out["sun.value"][-1] > 70
    assert out["sun.value"] == pytest.approx(0.5 * 3 / inertia * out["t"]**2, rel=1e-3, abs=1e-9)
    # Whatever the motion, joints are closed to 1e-15 m at base circles of 0.09 m.
    assert out["arm.value"] == pytest.approx(out["sun.value"] / 4, abs=1e-10)
    assert out["planet.value"] == pytest.approx(-0.75 * out["sun.value"], abs=1e-10)
    # Of 390 J; it falls with the square of the step: 0.045 J, 0.0113 J and 0.0028 J at 2, 1 and 0.5 ms.
    assert out["balance"] == pytest.approx(0, abs=6e-2)


def test_belts_and_a_rack(sensors):
    out = sensors("""
buckens: 1
bodies:
  small: {rigid: {mass: 1 kg, inertia: [0.1, 0.1, 0.1]}, at: {position: [0, 2, 0]}}
  large: {rigid: {mass: 1 kg, inertia: [0.5, 0.5, 0.5]}, at: {position: [1, 2, 0]}}
  against: {rigid: {mass: 1 kg, inertia: [0.2, 0.2, 0.2]}, at: {position: [0, 3, 0]}}
  pinion: {rigid: {mass: 1 kg, inertia: [0.05, 0.05, 0.05]}, at: {position: [0, 5, 0]}}
  rack: {rigid: {mass: 4 kg, inertia: [1, 1, 1]}, at: {position: [0, 4.9, 0]}}
joints:
  small_axle: {revolute: {between: [{ground: [0, 2, 0]}, small], axis: [0, 0, 1]}}
  large_axle: {revolute: {between: [{ground: [1, 2, 0]}, large], axis: [0, 0, 1]}}
  against_axle: {revolute: {between: [{ground: [0, 3, 0]}, against], axis: [0, 0, 1]}}
  open: {belt: {between: [small, large], axis: [0, 0, 1], radii: [100 mm, 250 mm]}}
  crossed: {belt: {between: [small, against], axis: [0, 0, 1], radii: [100 mm, 200 mm], crossed: on}}
  pinion_axle: {revolute: {between: [{ground: [0, 5, 0]}, pinion], axis: [0, 0, 1]}}
  bed: {prismatic: {between: [{ground: [0, 4.9, 0]}, rack], axis: [1, 0, 0]}}
  mesh: {rack: {between: [rack, pinion], axis: [0, 0, 1], along: [-1, 0, 0], radius: 100 mm}}
loads:
  on_small: {torque: {on: small, value: [0, 0, 3]}}
  on_pinion: {torque: {on: pinion, value: [0, 0, 3]}}
simulation: {duration: 2 s, step: 2 ms}
output:
  every: 0.2 s
  sensors:
    small: {joint-coordinate: small_axle}
    large: {joint-coordinate: large_axle}
    against: {joint-coordinate: against_axle}
    pinion: {joint-coordinate: pinion_axle}
    rack: {joint-coordinate: bed}
    push: {joint-force: pinion_axle}
    balance: {energy: balance}
""")
    t = out["t"]
    # Belts: 0.1 + 0.5/2.5² + 0.2/2².
    assert out["small.value"] == pytest.approx(0.5 * 3 / (0.1 + 0.5 * 0.16 + 0.2 * 0.25) * t**2, rel=1e-9, abs=1e-9)
    assert out["large.value"] == pytest.approx(out["small.value"] / 2.5, abs=1e-10)
    assert out["against.value"] == pytest.approx(-out["small.value"] / 2, abs=1e-10)
    # a = T r/(J + m r²); the rack below the pinion goes forwards as that turns forwards.
    a = 3 * 0.1 / (0.05 + 4 * 0.01)
    assert out["rack.value"] == pytest.approx(0.5 * a * t**2, rel=1e-9, abs=1e-10)
    assert out["pinion.value"] == pytest.approx(10 * out["rack.value"], abs=1e-9)
    # The bearing holds the pinion against the rack's push, m a along it and tan 20 of that away from it.
    assert out["push.x"][1:] == pytest.approx(4 * a, rel=1e-7)
    assert out["push.y"][1:] == pytest.approx(-4 * a * math.tan(math.radians(20)), rel=1e-7)
    assert out["balance"] == pytest.approx(0, abs=1e-6)


def test_the_gear_train_swings_as_two_inertias_on_a_spring(sensors):
    out = sensors((SOURCE / "examples" / "gear_train/gear_train").with_suffix(".yaml").read_text())
    t = out["t"]
    assert out["wheel.value"] == pytest.approx(-0.4 * out["motor.value"], abs=1e-12)
    # Two inertias on the shaft as a spring G I_p/L, driven by a constant torque from rest.
    k = 206e9 / 2.6 * math.pi * 0.016**4 / 32 / 0.6
    own = 7850 * math.pi * 0.016**4 / 32 * 0.6  # of the shaft; a third goes with either end, to 1e-4
    near, far = 12e-3 + 1.5e-3 * 2.5**2 + own / 3, 0.05 + own / 3
    w = math.sqrt(k * (1 / near + 1 / far))
    mean = 5 * far / (near + far)
    # 8 periods; h² w³ t/12 of phase is 2e-3, the lumped shaft costs as much.
    assert out["twist.z"] == pytest.approx(-mean * (1 - numpy.cos(w * t)), abs=0.01 * mean)
    tangential, radial, axial = out["teeth.y"], out["teeth.x"], out["teeth.z"]
    helix = math.radians(15)
    assert radial == pytest.approx(numpy.abs(tangential) * math.tan(math.radians(20)) / math.cos(helix), rel=1e-6)
    assert numpy.abs(axial) == pytest.approx(numpy.abs(tangential) * math.tan(helix), rel=1e-6)
    # The motor's balance: 2 N m less J alpha goes into the teeth at 30 mm, most of it to the heavier side.
    assert tangential.min() * tangential.max() > 0
    assert out["front.x"] == pytest.approx(-radial, rel=1e-3, abs=1e-3)
    assert out["balance"] == pytest.approx(0, abs=1e-4)


def test_the_cam_drives_its_follower_along_the_pitch_curve(sensors):
    out = sensors((SOURCE / "examples" / "cam_follower/cam_follower").with_suffix(".yaml").read_text())
    angle, w = out["angle.value"], 20 * math.pi
    assert angle == pytest.approx(w * out["t"], abs=1e-10)
    # The pitch curve makes the valve move as a sine; 72 points: h⁴/384 of 40 mm is 6e-9 m, chords are not evenly long.
    assert out["lift.value"] == pytest.approx(-0.01 * numpy.sin(angle), abs=3e-8)
    assert out["lift.rate"] == pytest.approx(-0.01 * w * numpy.cos(angle), abs=3e-5)
    force = 0.3 * (0.01 * w**2 * numpy.sin(angle) + G) + 2000 * (0.015 - 0.01 * numpy.sin(angle))
    # What the step leaves is small against the spline's second derivative between its points: 0.061 N of 12 N at any step.
    assert out["roller.y"] == pytest.approx(force, abs=0.08)
    assert out["side.x"] == pytest.approx(-out["roller.x"], abs=1e-9)
    # Normal to the curve: its slope against the cam's radius is the lift's rate by the angle over the radius.
    radius = 0.04 - 0.01 * numpy.sin(angle)
    assert out["roller.x"] == pytest.approx(out["roller.y"] * 0.01 * numpy.cos(angle) / radius, abs=0.05)
    assert out["torque.z"] == pytest.approx(-0.01 * numpy.cos(angle) * force, abs=1e-3)
    assert out["balance"] == pytest.approx(0, abs=1e-4)


def test_a_bead_slides_on_a_helix_and_leaves_a_path_by_its_end(sensors, buckens, tmp_path):
    points = [[0.3 * math.cos(a), 0.3 * math.sin(a), 0.1 * a] for a in numpy.arange(-45, 3, 0.125).tolist()]
    model = f"""
buckens: 1
gravity: [0, 0, -9.81]
bodies: {{bead: {{rigid: {{mass: 1 kg, inertia: [1, 1, 1]}}, at: {{position: [0.3, 0, 0]}}}}}}
joints: {{wire: {{slot: {{between: [ground, bead], path: {points}}}}}}}
simulation: {{duration: DURATION s, step: 0.5 ms}}
output: {{every: 0.1 s, sensors: {{p: {{position: bead}}, wire: {{joint-force: wire}}, balance: {{energy: balance}}}}}}
"""
    out = sensors(model.replace("DURATION", "2"))
    t = out["t"]
    # Along the wire g sin(slope) is all that is left: tan slope = 0.1/0.3.
    slope = math.atan2(0.1, 0.3)
    assert out["p.z"] == pytest.approx(-0.5 * G * math.sin(slope) ** 2 * t**2, rel=2e-5, abs=1e-7)
    assert numpy.hypot(out["p.x"], out["p.y"]) == pytest.approx(0.3, abs=1e-6)
    # Across it: weight times cos, and the centripetal force v² r/(r² + b²).
    v = G * math.sin(slope) * t
    size = numpy.hypot(G * math.cos(slope), v**2 * 0.3 / 0.1)
    assert numpy.sqrt(out["wire.x"] ** 2 + out["wire.y"] ** 2 + out["wire.z"] ** 2) == pytest.approx(size, rel=2e-3)
    assert out["balance"] == pytest.approx(0, abs=1e-3)
    (tmp_path / "long.yaml").write_text(model.replace("DURATION", "4"))
    buckens("run", "long.yaml", "-o", "long").must(4, "joint \"wire\"", "left its path beyond the start", "lengthen")


ERRORS = {
    "gears on one axis": ("teeth: {gear: {between: [wheel, pinion], axis: [1, 0, 0], teeth: [40, 20]}}",
                          ["joint \"teeth\"", "on one axis", "side by side"]),
    "a ring as large as its gear": ("teeth: {gear: {between: [wheel, pinion], axis: [0, 0, 1], teeth: [20, 20], internal: on}}",
                                    ["model.yaml:10", "both have 20"]),
    "steep teeth": ("teeth: {gear: {between: [wheel, pinion], axis: [0, 0, 1], teeth: [20, 40], helix-angle: 80 deg}}",
                    ["joints.teeth.gear.helix-angle", "at most 60 degrees, found 80 degrees"]),
    "a rack along the axis": ("teeth: {rack: {between: [wheel, pinion], axis: [0, 0, 1], along: [0, 0, 1], radius: 1}}",
                              ["joint \"teeth\"", "across the axis of its pinion", "meet at 0 degrees"]),
    "a path of one point": ("teeth: {slot: {between: [wheel, pinion], path: [[0, 0, 0]]}}", ["has 1 points", "at least 2"]),
    "a path twice at one place": ("teeth: {slot: {between: [wheel, pinion], path: [[0, 0, 0], [1, 0, 0], [1, 0, 0]]}}",
                                  ["points 2 and 3 of `path` are the same"]),
    "a path along its normal": ("teeth: {slot: {between: [wheel, pinion], path: [[6, 0, 0], [6, 0, 1]], normal: [0, 0, 1]}}",
                                ["runs along its `normal`"]),
    "one joint alone": ("teeth: {coupler: {of: {far: 1}}}", ["at least two joints, found 1"]),
    "an unknown joint": ("teeth: {coupler: {of: {far: 1, neer: 2}}}",
                         ["joints.teeth.coupler.of.neer", "unknown joint \"neer\"", "near"]),
    "no displacement": ("teeth: {coupler: {of: {far: 1, near: {which: displacement}}}}",
                        ["joint \"near\" is a revolute, which has no displacement"]),
    "a coupler of couplers": ("teeth: {coupler: {of: {far: 1, teeth: 1}}}", ["joint \"teeth\" is a coupler, which has no"]),
    "a factor of zero": ("teeth: {coupler: {of: {far: 0, near: 1}}}", ["takes the joint out of the sum"]),
    "two laws": ("teeth: {coupler: {of: {far: {times: 2, polynomial: [0, 1]}, near: 1}}}", ["only one of the keys"]),
    "points out of order": ("teeth: {coupler: {of: {far: {table: [[-1, 0], [2, 1], [1, 3]]}, near: 1}}}",
                            ["must increase, but 1 follows 2"]),
    "a table elsewhere": ("teeth: {coupler: {of: {far: {table: [[1, 0], [2, 1]]}, near: 1}}}",
                          ["starts at 0, as placed, outside the table, which runs from 1 to 2"]),
}


@pytest.mark.parametrize("name", ERRORS)
def test_messages_say_what_is_wrong(buckens, tmp_path, name):
    joint, words = ERRORS[name]
    lines = [f"  {joint}" if line.strip().startswith("teeth:") else line for line in GEARS.split("\n")]
    (tmp_path / "model.yaml").write_text("\n".join(lines).replace("TORQUE", "0"))
    result = buckens("check", "model.yaml")
    assert result.code in (2, 3), result.out + result.err
    for word in words:
        assert word in result.err, result.err


RAIL = """
buckens: 1
PLANE
gravity: [0, -9.81, 0]
materials: {steel: {E: 200 GPa, nu: 0.3, rho: 7850 kg/m^3}}
bodies:
  rail: {beam: {to: [2, 0, 0], elements: 12, section: {circle: {diameter: 80 mm}}, material: steel}FRAMES}
  trolley: {rigid: {mass: 2 kg, inertia: [1, 1, 1]}, at: {position: [1.5, 0, 0]}}
  weight: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}, at: {position: [3, -1, 0]}}
joints:
  left: {fixed: {between: [ground, rail/start]}}
  right: {point-on-line: {between: [{ground: [2, 0, 0]}, rail/end], axis: [1, 0, 0]}}
  wheels: {slider-on-beam: {between: [rail, trolley]}}
  shaft: {prismatic: {between: [{ground: [3, 0, 0]}, weight], axis: [0, -1, 0]}}
  string: {coupler: {of: {wheels: 1, shaft: -1}}}
initial: {START}
simulation: {duration: 0.4 s, step: 1 ms}
output:
  every: 10 ms
  fields: [interface-load]
  sensors: {way: {joint-coordinate: wheels}, drop: {joint-coordinate: shaft}, tension: {joint-force: string}, total: {energy: total},
            balance: {energy: balance}, place: {position: trolley}}
"""


@pytest.mark.parametrize("frames", ["", ", frames: 3"])
@pytest.mark.parametrize("plane", ["", "planar: xy"])
def test_a_string_pulls_a_trolley_along_a_flexible_rail(sensors, frames, plane):
    """A weight on a string over an edge: x'' = m g/(m + M) on a straight rail, which bends by hundredths of a millimetre."""
    out = sensors(RAIL.replace("FRAMES", frames).replace("PLANE", plane).replace("initial: {START}\n", ""))
    assert numpy.abs(out["way.value"] - out["drop.value"]).max() < 1e-12
    assert numpy.abs(out["way.rate"] - out["drop.rate"]).max() < 1e-9
    a = G / 3
    # The trolley climbs out of the sag: 2 kg over some 0.1 mm, of 2.6 J; a rail of 30 mm, which sags by seven times as much, takes 2.7e-3.
    assert out["way.value"][-1] == pytest.approx(0.5 * a * 0.4**2, rel=1e-3)
    # The trolley is pulled by M a, and the work of both weights closes the account.
    assert out["tension.x"][20:].mean() == pytest.approx(2 * a, rel=5e-3)
    assert numpy.abs(out["balance"]).max() < 1e-3 * 0.5 * 3 * (a * 0.4) ** 2


def test_a_trolley_hangs_in_balance_on_a_sloping_rail(sensors):
    """Half of the trolley's mass on the string holds it on a slope of 30 degrees, and it stays where it is."""
    text = (RAIL.replace("FRAMES", "").replace("PLANE", "").replace("START", "start: static")
            .replace("gravity: [0, -9.81, 0]", f"gravity: [{-G / 2!r}, {-G * math.sqrt(0.75)!r}, 0]")
            .replace("axis: [0, -1, 0]}}", f"axis: [-0.5, {-math.sqrt(0.75)!r}, 0]}}}}"))
    out = sensors(text)
    assert numpy.abs(out["way.rate"]).max() < 1e-8
    assert out["tension.x"] == pytest.approx(G, rel=1e-3)
