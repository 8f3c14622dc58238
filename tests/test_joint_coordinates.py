# SPDX-License-Identifier: Apache-2.0
"""Coordinates of planes and free translations, drives of any coordinate, and what joints do not have."""

import math

import numpy
import pytest

from test_ways_along_slots import ring


def test_a_puck_on_springs_has_two_frequencies(sensors):
    """Springs along x and y of the joint, which is turned by 30 degrees; the puck spins meanwhile."""
    m, kx, ky, h = 1.0, 100.0, 400.0, 1e-3
    c, s = math.cos(math.pi / 6), math.sin(math.pi / 6)
    out = sensors(f"""
buckens: 1
bodies: {{puck: {{rigid: {{mass: {m} kg, inertia: [1e-3, 1e-3, 2e-3]}}}}}}
joints: {{ice: {{planar: {{between: [ground, puck], axis: [0, 0, 1], along: [{c}, {s}, 7]}}}}}}
loads:
  wide: {{slide-spring: {{joint: ice, which: x, stiffness: {kx}}}}}
  long: {{slide-spring: {{joint: ice, which: y, stiffness: {ky}}}}}
signals: {{px: {{joint-coordinate: {{joint: ice, which: x}}}}, vy: {{joint-rate: {{joint: ice, which: y}}}}, both: "2*px + vy"}}
initial: {{joints: {{ice: {{x: 10 mm, y-velocity: 0.2 m/s, speed: 3 rad/s}}}}}}
simulation: {{duration: 1 s, step: {h}}}
output:
  every: 10 ms
  sensors:
    x: {{joint-coordinate: {{joint: ice, which: x}}}}
    y: {{joint-coordinate: {{joint: ice, which: "y"}}}}
    turn: {{joint-coordinate: ice}}
    p: {{position: puck}}
    both: {{signal: both}}
    balance: {{energy: balance}}
""")
    t = out["t"]
    x, y = 0.01 * numpy.cos(10 * t), 0.01 * numpy.sin(20 * t)
    # Phase errors of second order: (w h)²/12 of w t.
    assert out["x.value"] == pytest.approx(x, abs=0.01 * 10 * (10 * h) ** 2 / 6)
    assert out["y.value"] == pytest.approx(y, abs=0.01 * 20 * (20 * h) ** 2 / 6)
    assert out["p.x"] == pytest.approx(c * out["x.value"] - s * out["y.value"], abs=1e-12)
    assert out["p.y"] == pytest.approx(s * out["x.value"] + c * out["y.value"], abs=1e-12)
    assert out["turn.value"] == pytest.approx(3 * t, abs=1e-10)
    assert out["both"] == pytest.approx(2 * out["x.value"] + out["y.rate"], abs=1e-12)
    assert numpy.abs(out["balance"]).max() < (20 * h) ** 2 * 0.5 * m * 0.2**2


def test_planes_and_translations_count_along_their_axes(sensors):
    """A point in a plane and a body that only translates, both driven along one coordinate and free along the others."""
    out = sensors("""
buckens: 1
bodies:
  ball: {rigid: {mass: 1 kg, inertia: [1e-3, 1e-3, 1e-3]}}
  cage: {rigid: {mass: 2 kg, inertia: [1e-3, 1e-3, 1e-3]}}
joints:
  table: {point-in-plane: {between: [ground, ball], axis: [1, 0, 0]}}
  frame: {orientation: {between: [ground, cage]}}
  push: {prescribed-coordinate: {joint: table, which: x, displacement: "0.1*sin(5*t) m"}}
  lift: {prescribed-coordinate: {joint: frame, which: z, acceleration: 2 m/s^2}}
  same: {coupler: {of: {frame: {times: 1, which: x}, table: {times: -3, which: y}}}}
initial: {joints: {frame: {y-velocity: 0.5}, table: {y-velocity: 0.1}}}
simulation: {duration: 1 s, step: 1 ms}
output:
  every: 10 ms
  sensors:
    b: {position: ball}
    c: {position: cage}
    bx: {joint-coordinate: {joint: table, which: x}}
    by: {joint-coordinate: {joint: table, which: y}}
    cx: {joint-coordinate: {joint: frame, which: x}}
    cy: {joint-coordinate: {joint: frame, which: y}}
    cz: {joint-coordinate: {joint: frame, which: z}}
    same: {joint-force: same}
""")
    t = out["t"]
    # The normal is the marker's x axis, so that x is the marker's y axis and y its z axis.
    assert out["b.y"] == pytest.approx(0.1 * numpy.sin(5 * t), abs=1e-10)
    assert out["bx.value"] == pytest.approx(out["b.y"], abs=1e-13)
    assert out["by.value"] == pytest.approx(out["b.z"], abs=1e-13)
    assert out["b.z"] == pytest.approx(0.1 * t, abs=1e-10)
    assert out["c.z"] == pytest.approx(t**2, abs=1e-9)
    assert out["cx.value"] == pytest.approx(3 * out["by.value"], abs=1e-10)
    for axis in "xyz":
        assert out[f"c{axis}.value"] == pytest.approx(out[f"c.{axis}"], abs=1e-13)
    assert out["cy.value"] == pytest.approx(0.5 * t, abs=1e-10)


def test_the_second_angle_is_driven(sensors):
    out = sensors("""
buckens: 1
bodies: {cage: {rigid: {mass: 1 kg, inertia: [1e-3, 2e-3, 3e-3]}}}
joints:
  cross: {universal: {between: [ground, cage], axis: [0, 0, 1], second-axis: [1, 0, 0]}}
  turn: {prescribed-coordinate: {joint: cross, speed: 30 rad/s}}
  tilt: {prescribed-coordinate: {joint: cross, which: second-angle, angle: "0.5*sin(3*t)"}}
simulation: {duration: 1 s, step: 1 ms}
output: {every: 10 ms, sensors: {a: {joint-coordinate: cross}, b: {joint-coordinate: {joint: cross, which: second-angle}}, balance: {energy: balance}}}
""")
    assert out["a.value"] == pytest.approx(30 * out["t"], abs=1e-10)
    assert out["b.value"] == pytest.approx(0.5 * numpy.sin(3 * out["t"]), abs=1e-10)


def test_an_event_locks_all_translations(sensors):
    out = sensors("""
buckens: 1
bodies: {cage: {rigid: {mass: 2 kg, inertia: [1e-3, 1e-3, 1e-3]}}}
joints: {frame: {orientation: {between: [ground, cage]}}}
signals: {late: "t - 0.5005"}
events: {hold: {when: late, lock: frame}}
initial: {joints: {frame: {x-velocity: 1, y-velocity: -2, z-velocity: 3}}}
simulation: {duration: 1 s, step: 1 ms}
output: {every: 10 ms, sensors: {c: {position: cage}}}
""")
    for axis, v in zip("xyz", (1, -2, 3)):
        assert out[f"c.{axis}"][-1] == pytest.approx(0.5005 * v, abs=1e-9)
        assert out[f"c.{axis}"][55] == pytest.approx(0.5005 * v, abs=1e-9)


# ---- what makes no sense

@pytest.mark.parametrize("more, words", [
    ("loads: {s: {slide-spring: {joint: ice, stiffness: 1}}}", ["joint \"ice\" is a planar, whose coordinates are `angle`, `x`, `y`", "`which`"]),
    ("loads: {s: {slide-spring: {joint: ice, which: z, stiffness: 1}}}", ["which has no displacement z", "its coordinates are `angle`, `x`, `y`"]),
    ("loads: {s: {slide-spring: {joint: ball, which: swing, stiffness: 1}}}", ["`swing` is an angle, but this entry acts on displacements", "`hinge-spring`"]),
    ("loads: {s: {hinge-spring: {joint: ice, which: x, stiffness: 1}}}", ["`x` is a displacement, but this entry acts on angles", "`slide-spring`"]),
    ("loads: {s: {hinge-spring: {joint: ball, stiffness: 1}}}", ["is a spherical, whose coordinates are `swing`, `twist`", "`which`"]),
    ("loads: {s: {slide-friction: {joint: ice, which: x, static: 0.1}}}", ["is a planar, whose friction acts in the direction of sliding", "`contact`"]),
    ("loads: {s: {hinge-friction: {joint: ball, which: swing, static: 0.1, radius: 0.1}}}", ["is a spherical, which rubs about all axes", "`ball-friction`"]),
    ("loads: {s: {hinge-friction: {joint: knuckle, static: 0.1, radius: 0.1}}}", ["is a constant-velocity, which rubs in a different way", "`damping`"]),
    ("loads: {s: {hinge-spring: {joint: link, stiffness: 1}}}", ["joint \"link\" is a distance, which has no angle: a rod moves as its ends do", "`relative`"]),
    ("loads: {s: {slide-stop: {joint: wheel, which: x, to: 1}}}", ["which has no displacement x; its coordinates are `angle`, `displacement`"]),
    ("signals: {s: {joint-angle: pair}}", ["joint \"pair\" is a gear, which has no angle: a gear couples the angles of two joints"]),
    ("signals: {s: {joint-displacement: bar}}", ["joint \"bar\" is a rack, which has no displacement: a rack couples"]),
    ("signals: {s: {joint-rate: strap}}", ["joint \"strap\" is a belt, which has no angle: a belt couples"]),
    ("loads: {s: {hinge-spring: {joint: weld, stiffness: 1}}}", ["joint \"weld\" is a fixed, which has no angle; name one that turns about an axis: ice"]),
    ("loads: {s: {hinge-spring: {joint: rubber, stiffness: 1}}}", ["joint \"rubber\" is a bushing, which has no angle: its springs are fields of its own"]),
    ("signals: {s: {joint-coordinate: both}}", ["joint \"both\" is a coupler, which has no angle: name one of the joints that it couples"]),
    ("signals: {s: {joint-angle: drive}}", ["joint \"drive\" is a prescribed-coordinate, which has no angle: name the joint that it drives"]),
    ("signals: {s: {joint-coordinate: {joint: ball, which: x}}}", ["which has no displacement x; its coordinates are `swing`, `twist`"]),
    ("signals: {s: {joint-coordinate: none}}", ["unknown joint \"none\""]),
    ("initial: {joints: {ball: {angle: 1}}}", ["joint \"ball\" is a spherical, which has no angle"]),
    ("initial: {joints: {ice: {z-velocity: 1}}}", ["initial.joints.ice.z-velocity", "which has no displacement z"]),
    ("initial: {joints: {drive: {angle: 1}}}", ["joint \"drive\" is a drive, whose law determines where it starts"]),
    ("signals: {late: \"t - 1\"}\nevents: {e: {when: late, lock: drive}}", ["joint \"drive\" is a prescribed-coordinate", "law of time"]),
    ("signals: {late: \"t - 1\"}\nevents: {e: {when: late, lock: ball}}", ["joint \"ball\" is a spherical, which has no angle or displacement to hold", "`as-found`"]),
    ("signals: {late: \"t - 1\"}\nevents: {e: {when: late, attach: drive}}", ["joint \"drive\" is a prescribed-coordinate", "cannot be attached", "`slide-motor`"]),
])
def test_what_a_joint_does_not_have_is_told(buckens, tmp_path, more, words):
    text = """buckens: 1
bodies:
  a: {rigid: {mass: 1 kg, inertia: [1, 1, 1], com: [0, 0, 1]}}
  b: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}, at: {position: [1, 0, 0]}}
joints:
  ice: {planar: {between: [ground, a], axis: [0, 0, 1]}}
  ball: {spherical: {between: [ground, a/origin]}}
  link: {distance: {between: [a, b]}}
  wheel: {rolling: {between: [ground, b], normal: [0, 0, 1], axle: [1, 0, 0], radius: 0.1}}
  pair: {gear: {between: [a, b], axis: [0, 0, 1], teeth: [20, 30]}}
  bar: {rack: {between: [a, b], axis: [0, 0, 1], along: [1, 0, 0], radius: 0.1}}
  strap: {belt: {between: [a, b], axis: [0, 0, 1], radii: [0.1, 0.1]}}
  drive: {prescribed-coordinate: {joint: ice, angle: "t"}}
  weld: {fixed: {between: [a, b]}}
  rubber: {bushing: {between: [a, b], stiffness: [1e3, 1e3, 1e3]}}
  knuckle: {constant-velocity: {between: [a, b], axis: [1, 0, 0]}}
  both: {coupler: {of: {ice: 1, ball: {which: twist}}}}
simulation: {duration: 1 s, step: 1 ms}
"""
    (tmp_path / "model.yaml").write_text(text + more + "\n")
    buckens("check", "model.yaml").must(2, "model.yaml:", *words)


@pytest.mark.parametrize("drive, words", [
    ("{joint: wire}", ["exactly one of the keys angle, speed, angular-acceleration, displacement, velocity and acceleration"]),
    ("{joint: wire, velocity: 1, acceleration: 1}", ["exactly one of the keys"]),
    ("{joint: wire, speed: 1}", ["joint \"wire\" is a slot, which has no angle"]),
    ("{joint: wire, which: displacement, speed: 1}", ["`displacement` is a displacement, but this entry acts on angles", "a drive by `displacement` or `velocity`"]),
    ("{joint: wir, velocity: 1}", ["unknown joint \"wir\"", "wire"]),
    ("{joint: other, velocity: 1}", ["joint \"other\" is driven already"]),
    ("{joint: hole, velocity: 1}", ["joint \"hole\" is a slider-on-beam, which is driven by its own"]),
])
def test_drives_that_make_no_sense(buckens, tmp_path, drive, words):
    others = """other: {prescribed-translation: {between: [ground, bead], axis: [0, 1, 0], displacement: 0}}
  hole: {slider-on-beam: {between: [rail, bead]}}"""
    rail = """materials: {steel: {E: 200 GPa, nu: 0.3, rho: 7870 kg/m^3}}
bodies:
  rail: {beam: {to: [1, 0, 0], elements: 2, section: {circle: {diameter: 20 mm}}, material: steel}}
  bead: {"""
    text = ring().replace("joints:", f"joints:\n  drive: {{prescribed-coordinate: {drive}}}\n  {others}", 1)
    text = text.replace("bodies: {bead: {", rail).replace("]}}}\njoints", "]}}\njoints", 1)
    (tmp_path / "model.yaml").write_text(text)
    buckens("check", "model.yaml").must(2, "model.yaml:", *words)


@pytest.mark.parametrize("joint, sensor, code, words", [
    ("spherical: {between: [ground, b]}", "{joint: j, which: swing}", 3, ["joint \"j\" is a spherical, which has no `swing` in a planar model", "`revolute`"]),
    ("orientation: {between: [ground, b]}", "{joint: j, which: z}", 3, ["which has no `z` in a planar model; it has `x`, `y`"]),
    ("orientation: {between: [ground, b]}", "{joint: j, which: x}", 0, []),
    ("point-in-plane: {between: [ground, b], axis: [0, 1, 0]}", "{joint: j, which: x}", 0, []),
    ("point-in-plane: {between: [ground, b], axis: [0, 1, 0]}", "{joint: j, which: y}", 3, ["which has no `y` in a planar model; it has `x`"]),
    ("point-in-plane: {between: [ground, b], axis: [0, 1, 0], along: [0, 2, 0]}", "{joint: j, which: x}", 3, ["`along` is normal to the plane"]),
])
def test_planar_models_have_what_lies_in_the_plane(buckens, tmp_path, joint, sensor, code, words):
    (tmp_path / "model.yaml").write_text(f"""buckens: 1
planar: xy
bodies: {{b: {{rigid: {{mass: 1 kg, inertia: [1, 1, 1]}}}}}}
joints: {{j: {{{joint}}}}}
initial: {{bodies: {{b: {{velocity: [1, 0, 0]}}}}}}
simulation: {{duration: 10 ms, step: 1 ms}}
output: {{sensors: {{s: {{joint-coordinate: {sensor}}}}}}}
""")
    result = buckens("run", "model.yaml", "-o", "out").must(code, *words)
    if code == 0:
        assert "s.value" in (tmp_path / "out" / "sensors.csv").read_text(), result.out
