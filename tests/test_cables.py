# SPDX-License-Identifier: Apache-2.0
"""Cables over pulleys: Atwood's machine, tackles, capstans, closed belts, hoists."""

import json
import math
import os
import pathlib

import numpy
import pytest

EXAMPLES = pathlib.Path(os.environ.get("BUCKENS_SOURCE_DIR", pathlib.Path(__file__).parents[1])) / "examples"
G = 9.81


def acceleration(t, x, since):
    late = t > since
    return 2 * numpy.polyfit(t[late], x[late], 2)[0]


def test_atwoods_machine_with_a_pulley_of_its_own_inertia(sensors):
    out = sensors("""
buckens: 1
planar: xy
gravity: [0, -9.81, 0]
bodies:
  light: {rigid: {mass: 1, inertia: [0, 0, 1e-3]}, at: {position: [-0.1, -1, 0]}}
  heavy: {rigid: {mass: 2, inertia: [0, 0, 1e-3]}, at: {position: [0.1, -1, 0]}}
  wheel: {rigid: {mass: 1, inertia: [0, 0, 0.01]}}
joints: {axle: {revolute: {between: [ground, wheel]}}}
loads: {rope: {cable: {ends: [light, heavy], pulleys: [{on: wheel, radius: 0.1, side: right}], stiffness: 1e7, damping-time: 1 ms, pretension: 13}}}
simulation: {duration: 0.6 s, step: 0.2 ms}
output: {every: 2 ms, sensors: {a: {position: light}, b: {position: heavy}, rope: {cable: rope}, w: {angular-velocity: wheel}, balance: {energy: balance}}}
""")
    # (m2 - m1) g/(m1 + m2 + J/r^2); the rope gives by 1e-6 of its length.
    assert acceleration(out["t"], out["a.y"], 0.1) == pytest.approx(2.4525, rel=1e-4)
    assert acceleration(out["t"], out["b.y"], 0.1) == pytest.approx(-2.4525, rel=1e-4)
    assert out["rope.tension1"][-1] == pytest.approx(1 * (G + 2.4525), rel=1e-4)
    assert out["rope.tension2"][-1] == pytest.approx(2 * (G - 2.4525), rel=1e-4)
    assert out["w.z"][-1] == pytest.approx(-2.4525 * 0.6 / 0.1, rel=1e-3)
    assert out["rope.wrap1"] == pytest.approx(math.pi, abs=1e-9)
    assert numpy.abs(out["rope.slip1"]).max() == 0
    assert numpy.abs(out["balance"]).max() < 1e-5


def test_a_tackle_doubles_the_force(sensors):
    """From the ceiling around a sheave on the load, over one on the ceiling, to a counterweight."""
    out = sensors("""
buckens: 1
planar: xy
gravity: [0, -9.81, 0]
bodies:
  load: {rigid: {mass: 3, inertia: [0, 0, 0.01]}, at: {position: [0, -1, 0]}}
  weight: {rigid: {mass: 2, inertia: [0, 0, 0.01]}, at: {position: [0.3, -1, 0]}}
loads:
  rope:
    cable:
      ends: [{ground: [-0.05, 0, 0]}, weight]
      pulleys: [{on: load, radius: 50 mm, side: left}, {on: {ground: [0.175, 0, 0]}, radius: 125 mm, side: right}]
      stiffness: 1e7
      damping-time: 1 ms
      friction: 0
      pretension: 17
simulation: {duration: 0.5 s, step: 0.2 ms}
output: {every: 2 ms, sensors: {load: {position: load}, weight: {position: weight}, rope: {cable: rope}}}
""")
    a = (2 * 2 - 3) * G / (3 + 4 * 2)
    assert acceleration(out["t"], out["load.y"], 0.1) == pytest.approx(a, rel=1e-3)
    assert acceleration(out["t"], out["weight.y"], 0.1) == pytest.approx(-2 * a, rel=1e-3)
    for n in (2, 3):  # nothing rubs
        assert out[f"rope.tension{n}"] == pytest.approx(out["rope.tension1"], rel=1e-12)
    assert out["rope.tension1"][-1] == pytest.approx(2 * (G - 2 * a), rel=1e-3)
    assert out["rope.wrap1"] == pytest.approx(math.pi, abs=1e-4)


def test_a_rope_slips_on_a_drum_by_eulers_law(sensors):
    text = """
buckens: 1
planar: xy
gravity: [0, -9.81, 0]
bodies:
  light: {rigid: {mass: 1, inertia: [0, 0, 1e-3]}, at: {position: [-0.1, -1, 0]}}
  heavy: {rigid: {mass: MASS, inertia: [0, 0, 1e-3]}, at: {position: [0.1, -1, 0]}}
loads: {rope: {cable: {ends: [light, heavy], pulleys: [{on: ground, radius: 0.1, side: right}], stiffness: 1e5, damping-time: 0.2 ms, pretension: 10, friction: 0.3}}}
simulation: {duration: 0.3 s, step: STEP}
output: {every: 2 ms, sensors: {a: {position: light}, rope: {cable: rope}, balance: {energy: balance}, lost: {energy: dissipated}}}
"""
    out = sensors(text.replace("MASS", "4").replace("STEP", "0.1 ms"))
    ratio = math.exp(0.3 * math.pi)
    assert ratio == pytest.approx(2.566332, abs=1e-6)
    slips = numpy.gradient(out["rope.slip1"], out["t"]) > 0.01
    assert slips[5:].all()
    # Exact within steps; records take the stiffness E A/l anew, with l shorter by what has slipped in the last step, 1e-4.
    assert out["rope.wrap1"] == pytest.approx(math.pi, abs=1e-3)
    assert out["rope.tension2"][slips] / out["rope.tension1"][slips] == pytest.approx(numpy.exp(0.3 * out["rope.wrap1"][slips]), rel=2e-4)
    a = (4 - ratio) * G / (4 + ratio)
    assert acceleration(out["t"], out["a.y"], 0.1) == pytest.approx(a, rel=2e-3)
    # What rubs is T2 - T1 along the slip.
    work = numpy.trapezoid if hasattr(numpy, "trapezoid") else numpy.trapz
    rubbed = work(out["rope.tension2"] - out["rope.tension1"], out["rope.slip1"])
    assert out["lost"][-1] == pytest.approx(rubbed, rel=0.02)
    assert numpy.abs(out["balance"]).max() < 1e-3
    # Below the bound it holds, and does not creep.
    out = sensors(text.replace("MASS", "2.5").replace("STEP", "0.1 ms").replace("damping-time: 0.2 ms", "damping-time: 5 ms"))
    assert abs(out["rope.slip1"][-1] - out["rope.slip1"][len(out["t"]) // 2]) < 1e-9
    assert abs(out["a.y"][-1] - out["a.y"][len(out["t"]) // 2]) < 1e-4


def test_a_whole_turn_holds_more(sensors):
    out = sensors("""
buckens: 1
planar: xy
bodies:
  left: {rigid: {mass: 1, inertia: [0, 0, 1e-3]}, at: {position: [-1, 0.1, 0]}}
  right: {rigid: {mass: 1, inertia: [0, 0, 1e-3]}, at: {position: [1, 0.1, 0]}}
loads:
  rope: {cable: {ends: [left, right], pulleys: [{on: ground, radius: 0.1, side: right, turns: 1}], stiffness: 1e5, damping-time: 0.2 ms, pretension: 1, friction: 0.3}}
  pull: {force: {on: right, value: [20, 0, 0]}}
  hold: {force: {on: left, value: [-1, 0, 0]}}
simulation: {duration: 0.2 s, step: 0.1 ms}
output: {every: 2 ms, sensors: {rope: {cable: rope}}}
""")
    slips = numpy.gradient(out["rope.slip1"], out["t"]) > 0.01
    assert slips[10:].all()
    assert out["rope.wrap1"] == pytest.approx(2 * math.pi, abs=1e-3)
    assert math.exp(0.6 * math.pi) == pytest.approx(6.586062, abs=1e-6)
    assert out["rope.tension2"][slips] / out["rope.tension1"][slips] == pytest.approx(numpy.exp(0.3 * out["rope.wrap1"][slips]), rel=2e-4)


def test_a_closed_cable_is_a_belt(sensors):
    """Over two pulleys it is what elastic-belt is, but for the change of E A/l by the pretension, 4e-5 here."""
    frame = """
buckens: 1
planar: xy
bodies:
  driver: {rigid: {mass: 1, inertia: [0, 0, 2e-3]}}
  fan: {rigid: {mass: 2, inertia: [0, 0, 0.02]}, at: {position: [0.4, 0, 0]}}
joints:
  a: {revolute: {between: [ground, driver]}}
  b: {revolute: {between: [{ground: [0.4, 0, 0]}, fan]}}
loads:
  LAW
  motor: {torque: {on: driver, value: [0, 0, "2*sin(20*t) N m"]}}
simulation: {duration: 0.4 s, step: 0.1 ms}
output: {every: 2 ms, sensors: {a: {joint-coordinate: a}, b: {joint-coordinate: b}}}
"""
    rest = "stiffness: 5e6, damping-time: 0.2 ms, pretension: 200"
    for crossed in (False, True):
        belt = sensors(frame.replace("LAW", f"belt: {{elastic-belt: {{between: [driver, fan], radii: [50 mm, 100 mm], crossed: {'on' if crossed else 'off'}, {rest}}}}}"))
        side = "right" if crossed else "left"
        cable = sensors(frame.replace("LAW", f"belt: {{cable: {{pulleys: [{{on: driver, radius: 50 mm}}, {{on: fan, radius: 100 mm, side: {side}}}], {rest}}}}}"))
        assert len(belt) == 5
        for name in belt:
            # The half wraps of the belt share its spans' stiffness alike, the cable's do not stretch: both are this stiff.
            assert cable[name] == pytest.approx(belt[name], rel=1e-3, abs=1e-6), name
        assert cable["b.value"][-1] / cable["a.value"][-1] == pytest.approx(-0.5 if crossed else 0.5, rel=1e-3)


def test_a_pulley_behind_another_is_damped_by_its_rope(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text("""
buckens: 1
planar: xy
bodies:
  block: {rigid: {mass: 2, inertia: [0, 0, 0.01]}, at: {position: [0, -1, 0]}}
joints:
  guide: {prismatic: {between: [ground, block], axis: [0, 1, 0]}}
loads:
  rope:
    cable:
      ends: [{ground: [-0.4, 0, 0]}, {ground: [0.1, 0, 0]}]
      pulleys: [{on: {ground: [-0.15, 0.2, 0]}, radius: 50 mm, side: right}, {on: block, radius: 100 mm}]
      stiffness: 1e4
      damping-time: 1 ms
      pretension: 1 mN
simulation: {duration: 1, step: 1e-3}
""")
    mode, = buckens("modes", "model.yaml", "--system", "--json").must(0).json["analyses"][0]["modes"]
    # Nothing slips: both spans beside the block, 1.2 m and 1 m long and upright, resist it.
    omega = math.sqrt(1e4 * (1 / 1.2 + 1) / 2)
    # Without its tension, 1e-7 of the stiffness, it would be slack.
    assert mode["frequency"] == pytest.approx(omega / (2 * math.pi), rel=1e-6)
    assert mode["damping_ratio"] == pytest.approx(1e-3 * omega / 2, rel=1e-6)


def test_pulleys_in_a_row_vibrate_together(buckens, tmp_path):
    """Over a wheel, under a block, over another wheel: spans of 2, 1, 1 and 2 m, all upright."""
    (tmp_path / "model.yaml").write_text("""
buckens: 1
planar: xy
bodies:
  wheel: {rigid: {mass: 1, inertia: [0, 0, 0.02]}, at: {position: [-0.3, 0, 0]}}
  block: {rigid: {mass: 2, inertia: [0, 0, 0.01]}, at: {position: [-0.1, -1, 0]}}
  other: {rigid: {mass: 1, inertia: [0, 0, 0.01]}, at: {position: [0.1, 0, 0]}}
joints:
  axle: {revolute: {between: [{ground: [-0.3, 0, 0]}, wheel]}}
  guide: {prismatic: {between: [{ground: [-0.1, 0, 0]}, block], axis: [0, 1, 0]}}
  pin: {revolute: {between: [{ground: [0.1, 0, 0]}, other]}}
loads:
  rope:
    cable:
      ends: [{ground: [-0.4, -2, 0]}, {ground: [0.2, -2, 0]}]
      pulleys: [{on: wheel, radius: 0.1, side: right}, {on: block, radius: 0.1}, {on: other, radius: 0.1, side: right}]
      stiffness: 1e4
      pretension: 10
simulation: {duration: 1, step: 1e-3}
""")
    found = buckens("modes", "model.yaml", "--system", "--json").must(0).json["analyses"][0]["modes"]
    stiffness = numpy.diag([1e4 * (1 + 10 / 1e4) / length for length in (2, 1, 1, 2)])
    # Elongations of the spans by the angles of the wheels and the height of the block.
    by = numpy.array([[-0.1, 0, 0], [0.1, -1, 0], [0, -1, -0.1], [0, 0, 0.1]])
    squares = numpy.linalg.eigvals(numpy.linalg.solve(numpy.diag([0.02, 2, 0.01]), by.T @ stiffness @ by)).real
    assert [mode["frequency"] for mode in found] == pytest.approx(list(numpy.sqrt(numpy.sort(squares)) / (2 * math.pi)), rel=1e-9)


TO_AND_FRO = """
buckens: 1
planar: xy
gravity: [0, -9.81, 0]
materials: {plastic: {E: 1 GPa, nu: 0.3, rho: 1400, damping: {stiffness: 1e-4 s}}}
bodies:
  bracket: {beam: {to: [0.5, 0, 0], elements: 3, section: {circle: {diameter: 20 mm}}, material: plastic}}
  wheel: {rigid: {mass: 1, inertia: [0, 0, 0.002]}}
  fan: {rigid: {mass: 0.5, inertia: [0, 0, 0.003]}, at: {position: [0.5, 0, 0]}}
  light: {rigid: {mass: 0.4, inertia: [0, 0, 1e-3]}, at: {position: [0.42, -0.4, 0]}}
  heavy: {rigid: {mass: 1, inertia: [0, 0, 1e-3]}, at: {position: [0.58, -0.5, 0]}}
joints:
  root: {fixed: {between: [ground, bracket/start]}}
  axle: {revolute: {between: [ground, wheel]}}
  shaft: {revolute: {between: [bracket/end, fan]}}
loads:
  belt: {cable: {pulleys: [{on: wheel, radius: 0.05}, {on: fan, radius: 0.03}], stiffness: 2e4, damping-time: 1 ms, pretension: 20, friction: 0.3}}
  rope: {cable: {ends: [light, heavy], pulleys: [{on: fan, radius: 0.08, side: right}], stiffness: 2e4, damping-time: 0.5 ms, pretension: 6, friction: 0.2}}
  twist: {torque: {on: wheel, value: [0, 0, "0.4*sin(60*t)"]}}
simulation: {duration: 0.1, step: 0.5 ms, newton-tolerance: TOLERANCE}
output: {every: 1 ms, sensors: {rope: {cable: rope}, belt: {cable: belt}, a: {position: light}}}
"""


def test_tolerances_do_not_change_ropes_that_slip_to_and_fro(buckens, tmp_path):
    """Where a span begins to slip anew, its pulley changes between two regimes by rounding alone."""
    found = []
    for tolerance in ("1e-8", "1e-10", "1e-13", "1e-15"):
        (tmp_path / "model.yaml").write_text(TO_AND_FRO.replace("TOLERANCE", tolerance))
        buckens("run", "model.yaml", "-o", "out-" + tolerance, "--quiet").must(0)
        summary = json.loads((tmp_path / ("out-" + tolerance) / "summary.json").read_text())
        assert summary["step_control"]["failed"] == 0
        assert summary["newton_iterations"]["max"] <= 10
        found.append(numpy.genfromtxt(
            tmp_path / ("out-" + tolerance) / "sensors.csv", delimiter=",", names=True, comments=None))
    slip = numpy.diff(found[0]["ropeslip1_m"])
    assert (slip != 0).any() and (slip == 0).any()  # it slips and sticks
    for other in found[:-1]:
        for name in ("ax_m", "ay_m", "ropeslip1_m", "beltslip1_m"):
            # A share of 1e-8 of what each of 200 steps moves, some 1 mm.
            assert other[name] == pytest.approx(found[-1][name], abs=200 * 1e-8 * 1e-3)


def test_a_hoist_winds_its_rope_up(sensors):
    """Ten turns of the drum lift the hook by 2 pi r each; three pulleys, and a load that hangs on a spring of 1/3 of the length."""
    out = sensors("""
buckens: 1
planar: xy
gravity: [0, -9.81, 0]
bodies:
  drum: {rigid: {mass: 5, inertia: [0, 0, 0.01]}}
  hook: {rigid: {mass: 10, inertia: [0, 0, 0.1]}, at: {position: [1.0, -9, 0]}}
joints:
  axle: {revolute: {between: [ground, drum]}}
  motor: {prescribed-rotation: {between: [ground, drum], angle: "-2*pi*10*(t/5 - sin(2*pi*t/5)/(2*pi))"}}
loads:
  rope:
    cable:
      ends: [drum, hook]
      pulleys: [{on: drum, radius: 100 mm, side: left}, {on: {ground: [0.5, 1, 0]}, radius: 80 mm, side: right, friction: 0}, {on: {ground: [0.9, 1.2, 0]}, radius: 100 mm, side: right, friction: 0}]
      stiffness: 1e6
      damping-time: 5 ms
      pretension: 98.1
simulation: {duration: 5 s, step: 2 ms}
output: {every: 10 ms, sensors: {hook: {position: hook}, rope: {cable: rope}}}
""")
    assert out["hook.y"][-1] == pytest.approx(-9 + 2 * math.pi, abs=2e-3)


def test_a_cable_bends_a_beam(sensors):
    """Its end on a flexible mast: the tip gives way as a beam under the tension does."""
    out = sensors("""
buckens: 1
planar: xy
gravity: [0, -9.81, 0]
materials: {steel: {E: 210 GPa, nu: 0.3, rho: 7850}}
bodies:
  mast: {beam: {to: [0, 1, 0], elements: 4, section: {circle: {diameter: 12 mm}}, material: steel}, damping: {stiffness: 5e-3 s}}
  weight: {rigid: {mass: 1, inertia: [0, 0, 1e-3]}, at: {position: [1.1, 0.5, 0]}}
joints: {foot: {fixed: {between: [ground, mast/start]}}}
loads: {rope: {cable: {ends: [mast/end, weight], pulleys: [{on: {ground: [1.0, 0.9, 0]}, radius: 100 mm, side: right}], stiffness: 1e6, damping-time: 10 ms, friction: 0}}}
simulation: {duration: 6 s, step: 2 ms}
output: {every: 50 ms, sensors: {tip: {displacement: mast/end}, rope: {cable: rope}}}
""")
    I = math.pi * 0.012**4 / 64
    assert out["rope.tension1"][-1] == pytest.approx(G, rel=2e-2)
    assert out["tip.x"][-1] == pytest.approx(out["rope.tension1"][-1] / (3 * 210e9 * I), rel=3e-2)


BAD = """
buckens: 1
planar: xy
bodies: {a: {rigid: {mass: 1, inertia: [0, 0, 1e-3]}, at: {position: [0, -1, 0]}}, b: {rigid: {mass: 1, inertia: [0, 0, B]}, at: {position: [0.3, -1, 0]}}}
loads: {rope: {cable: {SPEC, stiffness: 1e5}}}
SENSORS
simulation: {duration: 1 s, step: 1 ms}
"""


@pytest.mark.parametrize(("spec", "code", "words"), [
    ("ends: [ground, a], pulleys: []", 2, ["a cable needs a pulley", "`rope`"]),
    ("pulleys: [{on: a, radius: 0.1}]", 2, ["a closed cable needs two pulleys"]),
    ("pulleys: [{on: a, radius: 0.2}, {on: b, radius: 0.2, side: right}]", 2, ["its span 1 cannot be formed", "0.3 m apart", "more than 0.4 m"]),
    ("ends: [a, {ground: [0.05, 0, 0]}], pulleys: [{on: ground, radius: 0.1}]", 2, ["its span 2 cannot be formed", "`side` and `radius`"]),
    ("pulleys: [{on: a, radius: 0.1}, {on: {ground: [1, 0, 0]}, radius: 0.1}], friction: 0.3", 2, ["a closed cable with `friction` transmits no force without pretension"]),
    ("ends: [a, ground], pulleys: [{on: b, radius: 0.1}]", 3, ["turns body \"b\", which has no rotary inertia"]),
    ("ends: [a, ground], pulleys: [{on: c, radius: 0.1}]", 2, ["c"]),
    ("ends: [a, ground], pulleys: [{on: b, radius: 0.1, side: up}]", 2, ["left", "right"]),
])
def test_wrong_cables_are_refused(buckens, tmp_path, spec, code, words):
    (tmp_path / "model.yaml").write_text(BAD.replace("SPEC", spec).replace("SENSORS", "").replace("B]", "0]" if code == 3 else "1e-3]"))
    buckens("check", "model.yaml").must(code, "model.yaml:", *words)


def test_a_sensor_needs_its_cable(buckens, tmp_path):
    text = BAD.replace("B]", "1e-3]").replace("SPEC", "ends: [a, ground], pulleys: [{on: {ground: [0.5, 0, 0]}, radius: 0.1}]")
    (tmp_path / "model.yaml").write_text(text.replace("SENSORS", "output: {sensors: {s: {cable: rop}}}"))
    buckens("check", "model.yaml").must(2, "there is no cable \"rop\"", "rope")


def test_a_cable_that_leaves_its_pulley_ends_the_run_by_name(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text("""
buckens: 1
planar: xy
bodies: {a: {rigid: {mass: 1, inertia: [0, 0, 1e-3]}, at: {position: [-1, -0.2, 0]}}}
loads: {rope: {cable: {ends: [a, {ground: [1, -0.2, 0]}], pulleys: [{on: ground, radius: 0.1, side: right}], stiffness: 1e3}}}
initial: {bodies: {a: {velocity: [0, 2, 0]}}}
simulation: {duration: 1 s, step: 1 ms}
""")
    buckens("run", "model.yaml").must(4, "load \"rope\"", "left its pulley 1")


def test_the_block_and_tackle_of_the_examples(sensors):
    out = sensors((EXAMPLES / "block_and_tackle/block_and_tackle").with_suffix(".yaml").read_text())
    risen, wound = out["load.y"] + 3.25, -0.15 * out["winch.value"]
    # Four parts of rope share what the drum winds up; they give by a share of 3e-4 of 13 m while the load is sped up.
    assert risen == pytest.approx(wound / 4, abs=1e-3)
    # What the drum takes up is stretched by the tension, 490.5 N over 1.5 MN.
    assert risen[-1] == pytest.approx(wound[-1] / 4 * (1 + 490.5 / 1.5e6), abs=1e-5)
    assert wound[-1] == pytest.approx(8 * math.pi * 0.15, rel=5e-3)  # the drum lags behind its law
    tensions = numpy.array([out[f"rope.tension{k}"] for k in range(1, 6)])
    # No friction: the same everywhere, at rest a quarter of the weight.
    assert numpy.ptp(tensions, axis=0).max() < 1e-8 * tensions.max()
    assert tensions[:, -1] == pytest.approx(200 * G / 4, rel=1e-3)
    assert abs(out["turn.z"]).max() < 1e-9


@pytest.mark.parametrize("friction, holds", [(0.221, True), (0.2, False)])
def test_a_rope_holds_at_rest_up_to_eulers_law(buckens, tmp_path, friction, holds):
    """Two to one, over half a turn: ln 2/pi = 0.2206."""
    (tmp_path / "model.yaml").write_text(f"""
buckens: 1
planar: xy
gravity: [0, -9.81, 0]
bodies:
  light: {{rigid: {{mass: 1, inertia: [0, 0, 1e-3]}}, at: {{position: [-0.1, -1, 0]}}}}
  heavy: {{rigid: {{mass: 2, inertia: [0, 0, 1e-3]}}, at: {{position: [0.1, -1, 0]}}}}
joints:
  a: {{prismatic: {{between: [{{ground: [-0.1, 0, 0]}}, light], axis: [0, 1, 0]}}}}
  b: {{prismatic: {{between: [{{ground: [0.1, 0, 0]}}, heavy], axis: [0, 1, 0]}}}}
loads:
  rope: {{cable: {{ends: [light, heavy], pulleys: [{{on: ground, radius: 0.1, side: right}}], stiffness: 1e5, damping-time: 5 ms, pretension: 13, friction: {friction}}}}}
initial: {{start: static}}
simulation: {{duration: 50 ms, step: 1 ms}}
output: {{every: 10 ms, sensors: {{rope: {{cable: rope}}}}}}
""")
    result = buckens("run", "model.yaml", "-o", "out", "--quiet")
    if not holds:
        assert result.code != 0 or "not stable" in result.err
        return
    result.must(0)
    out = numpy.genfromtxt(tmp_path / "out" / "sensors.csv", delimiter=",", names=True, comments=None)
    assert out["ropetension1_N"] == pytest.approx(G, rel=1e-7)
    assert out["ropetension2_N"] == pytest.approx(2 * G, rel=1e-7)
