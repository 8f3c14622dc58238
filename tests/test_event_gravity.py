# SPDX-License-Identifier: Apache-2.0
"""Events that change gravity."""

import json
import math

import numpy
import pytest

FALL = """buckens: 1
gravity: [1, 0, -10]
bodies: {stone: {rigid: {mass: 2 kg, inertia: [1, 1, 1]}}}
signals: {late: "t - 0.2003"}
events: {moon: {when: late, direction: rising, set: {gravity: GRAVITY}, record: on}}
initial: {bodies: {stone: {velocity: [0, 0, 1]}}}
simulation: {duration: 0.5 s, step: 1 msMETHOD}
output:
  every: 10 ms
  sensors: {p: {position: stone}, v: {velocity: stone}, balance: {energy: balance}, events: {energy: events}, total: {energy: total}, kinetic: {energy: kinetic}}
"""


def acts(out):
    """The instant at which it acts, which is recorded."""
    extra = out["t"][numpy.abs(out["t"] / 10e-3 - numpy.round(out["t"] / 10e-3)) > 1e-6]
    assert len(extra) == 1
    return extra[0]


@pytest.mark.parametrize("method", ["", ", method: newmark", ", method: hht"])
@pytest.mark.parametrize("gravity", ["[0, 2 m/s^2, \"-1.62 + 0*t\"]", "[0, 2, -1.62 m/s^2]"])
def test_a_stone_falls_along_two_parabolas(sensors, gravity, method):
    out = sensors(FALL.replace("METHOD", method).replace("GRAVITY", gravity), "-q")
    t = acts(out)
    assert 0.2003 < t < 0.2003 + 1e-3 / 16
    g = numpy.array([[1.0, 0.0, -10.0], [0.0, 2.0, -1.62]])
    early, late = numpy.minimum(out["t"], t), numpy.maximum(out["t"] - t, 0.0)
    for k, axis in enumerate("xyz"):
        at_event = g[0, k] * t + (k == 2)
        v = g[0, k] * early + (k == 2) + g[1, k] * late
        p = g[0, k] * early**2 / 2 + (k == 2) * early + at_event * late + g[1, k] * late**2 / 2
        # Rounding of up to 600 steps; the method is exact for constant forces.
        assert out[f"v.{axis}"] == pytest.approx(v, abs=1e-12)
        assert out[f"p.{axis}"] == pytest.approx(p, abs=1e-12)
    # The work is that of the weight as it changes, at the place where it does.
    where = numpy.array([out[f"p.{axis}"][out["t"] == t][0] for axis in "xyz"])
    jump = -2 * (g[1] - g[0]) @ where
    assert numpy.abs(out["events"][out["t"] < t]).max() == 0.0
    assert out["events"][out["t"] > t] == pytest.approx(jump, rel=1e-12)
    after = numpy.array([out[f"p.{axis}"][-1] for axis in "xyz"])
    assert out["total"][-1] - out["kinetic"][-1] == pytest.approx(-2 * g[1] @ after, rel=1e-12)
    # Of energies of 30 J, rounded in each of 600 steps.
    assert numpy.abs(out["balance"]).max() < 1e-12


def test_the_summary_names_the_work_of_events(sensors, tmp_path):
    out = sensors(FALL.replace("METHOD", "").replace("GRAVITY", "[0, 0, 0]"), "-q")
    account = json.loads((tmp_path / "out" / "summary.json").read_text())["energy_account"]
    assert list(account["brought_in"]) == ["events"]
    assert list(account["brought_in"]["events"].values()) == pytest.approx([out["events"][-1]], rel=1e-12)


PENDULUM = """buckens: 1
gravity: [0, -10, 0]
PLANARbodies: {bob: {rigid: {mass: 2 kg, inertia: [2, 2, 2]}, at: {position: [0, -2, 0]}, markers: {top: {position: [0, 2, 0]}}}}
joints: {pin: {revolute: {between: [ground, bob/top], axis: [0, 0, 1]}}}
signals: {angle: {joint-angle: pin}, armed: {setting: 1}, first: "angle + 10*(1 - armed)"}
events: {heavy: {when: first, direction: falling, set: {gravity: [0, -90 m/s^2, 0], armed: 0}, record: on}}
initial: {joints: {pin: {angle: 1e-3}}}
simulation: {duration: 4 s, step: 2 ms}
output: {every: 10 ms, sensors: {angle: {signal: angle}, balance: {energy: balance}, events: {energy: events}, y: {position: {of: bob, along: [0, 1, 0]}}}}
"""


@pytest.mark.parametrize("planar", ["", "planar: xy\n"])
def test_a_pendulum_swings_faster(sensors, planar):
    """Two harmonic pieces of 2 and 6 rad/s, joined at the lowest point."""
    out = sensors(PENDULUM.replace("PLANAR", planar), "-q")
    t = acts(out)
    assert t == pytest.approx(math.pi / 4, abs=2e-3 / 16 + 1e-6)
    angle, rate = 1e-3 * math.cos(2 * t), -2e-3 * math.sin(2 * t)
    late = out["t"] - t
    exact = numpy.where(late < 0, 1e-3 * numpy.cos(2 * out["t"]), angle * numpy.cos(6 * late) + rate / 6 * numpy.sin(6 * late))
    # The method is late by (w h)^2/12 rad each rad at most: 20 rad of an amplitude of 3e-4.
    assert out["angle"] == pytest.approx(exact, abs=3.4e-4 * 20 * (6 * 2e-3)**2 / 12)
    crossings = out["t"][1:][(out["angle"][:-1] > 0) != (out["angle"][1:] > 0)]
    assert numpy.diff(crossings[1:]).mean() == pytest.approx(math.pi / 6, rel=0.01)
    work = 2 * 80 * out["y"][out["t"] == t][0]
    assert out["events"][-1] == pytest.approx(work, rel=1e-12)
    # Of the energy of the swing, 10 (2e-3)^2/2 = 2e-5 J, as much as the period is longer; and
    # rounding of 360 J.
    assert numpy.abs(out["balance"]).max() < 2e-5 * (6 * 2e-3)**2 + 1e-12


def test_a_swing_goes_on_over_and_after_a_change(goes_on):
    text = PENDULUM.replace("PLANAR", "").replace("angle: 1e-3", "angle: 1")
    goes_on(text, "4 s", "2 s", 402)
    goes_on(text, "4 s", "0.4 s", 402)


BEAM = """buckens: 1
GRAVITYmaterials: {steel: {E: 210 GPa, nu: 0.3, rho: 7850 kg/m^3}}
bodies:
  arm: {beam: {to: [1 m, 0, 0], elements: 6, section: {circle: {diameter: 10 mm}}, material: steel}, damping: {stiffness: 1e-4 s}FRAMES}
  weight: {rigid: {mass: 0.2 kg, inertia: [1e-3, 1e-3, 1e-3]}, at: {position: [1.1, 0, 0]}}
joints:
  hinge: {revolute: {between: [ground, arm/start], axis: [0, 1, 0]}}
  weld: {fixed: {between: [arm/end, weight]}}
signals: {late: "t - 0.05", on: {setting: 0}}
EVENT
simulation: {duration: 0.2 s, step: 1 ms}
output: {every: 5 ms, sensors: {tip: {position: weight}, spin: {angular-velocity: weight}, hinge: {joint-force: hinge}, bend: {deflection: {of: arm/end}}, balance: {energy: balance}, strain: {energy: strain}}}
"""


@pytest.mark.parametrize("frames", ["", ", reduction: {free-free: 4}", ", frames: 3", ", coupling: none"])
def test_bodies_of_all_kinds_get_their_weight(sensors, frames):
    """Weightless up to an event; against a body force per mass that the same event switches on."""
    text = BEAM.replace("FRAMES", frames)
    by_gravity = sensors(text.replace("GRAVITY", "gravity: [0, 0, 0]\n").replace(
        "EVENT", "events: {fall: {when: late, direction: rising, set: {gravity: [0, 0, -9.81]}}}"), "-q")
    force = "{per-mass: [0, 0, -9.81], signal: on}"
    by_force = sensors(text.replace("GRAVITY", "").replace("EVENT", f"""loads:
  pull: {{body-force: {{on: arm, {force[1:]}}}
  tow: {{body-force: {{on: weight, {force[1:]}}}
events: {{fall: {{when: late, direction: rising, set: {{on: 1}}}}}}"""), "-q")
    assert by_gravity["tip.z"][-1] < -0.1 and by_gravity["strain"].max() > 5e-4
    for name in ("tip.x", "tip.z", "spin.y", "hinge.x", "hinge.z", "bend.z"):
        # Rounding, and what is left by iterations of tolerance 1e-10.
        assert by_gravity[name] == pytest.approx(by_force[name], abs=1e-8 * (1 + numpy.abs(by_force[name]).max())), name
    # Of 0.3 J, to the order of the step; the work of the force has an error of its own.
    assert numpy.abs(by_gravity["balance"]).max() < 1e-6


def test_a_beam_sags_less_on_the_moon(sensors):
    """From the equilibrium with one gravity to that with another, in its ratio."""
    text = """buckens: 1
gravity: [0, 0, -9.81]
materials: {steel: {E: 210 GPa, nu: 0.3, rho: 7850 kg/m^3}}
bodies: {arm: {beam: {to: [1 m, 0, 0], elements: 6, section: {circle: {diameter: 10 mm}}, material: steel}, damping: {stiffness: 20 ms}}}
joints: {root: {fixed: {between: [ground, arm/start]}}}
signals: {late: "t - 0.05"}
events: {moon: {when: late, direction: rising, set: {gravity: [0, 0, -1.62]}}}
initial: {start: static}
simulation: {duration: 3 s, step: 2 ms}
output: {every: 50 ms, sensors: {tip: {position: arm/end}, root: {joint-force: root}}}
"""
    out = sensors(text, "-q")
    weight = 7850 * math.pi * 5e-3**2
    stiffness = 210e9 * math.pi * 5e-3**4 / 4
    assert out["tip.z"][0] == pytest.approx(-weight * 9.81 / (8 * stiffness), rel=2e-3)  # shortening by arc and shear
    # Damped to exp(-w^2 T/2 t) with w = 44 rad/s; nonlinear by (z/L)^2.
    assert out["tip.z"][-1] / out["tip.z"][0] == pytest.approx(1.62 / 9.81, rel=1e-3)
    assert abs(out["root.z"][-1]) == pytest.approx(weight * 1.62, rel=1e-6)


def test_weight_presses_on_rough_ground(sensors):
    """A block that slides on rigid ground stops 4 times as fast with 4 times the gravity."""
    out = sensors("""buckens: 1
gravity: [0, 0, -2.5]
bodies: {block: {rigid: {mass: 2 kg, inertia: [1e-2, 1e-2, 1e-2]}, at: {position: [0, 0, 5e-3]}}}
loads: {floor: {contact: {between: [ground, block], shapes: [{plane: [0, 0, 1]}, {box: [0.2, 0.2, 10 mm]}], static: 0.1}}}
signals: {late: "t - 0.1003"}
events: {heavy: {when: late, direction: rising, set: {gravity: [0, 0, -10]}, record: on}}
initial: {bodies: {block: {velocity: [1, 0, 0]}}}
simulation: {duration: 0.5 s, step: 1 ms}
output: {every: 20 ms, sensors: {v: {velocity: block}, n: {contact: floor}, balance: {energy: balance}}}
""", "-q")
    t = acts(out)
    late = numpy.maximum(out["t"] - t, 0)
    # Rounding, and the directions of friction in four places.
    assert out["v.x"] == pytest.approx(1 - 0.25 * numpy.minimum(out["t"], t) - late, abs=1e-9)
    assert numpy.abs(out["balance"]).max() < 1e-9


@pytest.mark.parametrize("change, planar, words", [
    ("gravity: [0, 0, -1.62]", "xy", ["set.gravity.2", "gravity of a planar model must lie in its plane; set this component"]),
    ("gravity: [0, -1.62, \"0*t\"]", "xy", ["set.gravity.2", "must lie in its plane"]),
    ("gravity: [0, -1.62 m/s, 0]", "", ["set.gravity.1", "the value is a velocity, not an acceleration"]),
    ("gravity: -1.62", "", ["set.gravity", "gravity has three components; give for example [0, -1.62 m/s^2, 0]"]),
    ("gravity: [0, -1.62]", "", ["set.gravity", "expected a list of 3 values"]),
    ("gravity.1: -1.62", "", ['events cannot change "gravity.1" by itself; change all of it, gravity: [0, -1.62 m/s^2, 0]']),
    ("late: [1, 2, 3]", "", ["set.late", "only gravity takes three values"]),
    ("gravity: {value: 3, vector: [0, 0, 1]}", "", ["set.gravity", "give either `value`"]),
    ("gravity: {}", "", ["set.gravity", "give either `value`"]),
    ("loads.gravity.x: 3", "", ['events cannot change "loads.gravity.x"', "and gravity"]),
])
def test_what_gravity_cannot_be_is_refused(buckens, tmp_path, change, planar, words):
    text = FALL.replace("METHOD", "").replace("gravity: [1, 0, -10]", "gravity: [0, -10, 0]" + (f"\nplanar: {planar}" if planar else ""))
    text = text.replace("[0, 0, 1]", "[0, 1, 0]")
    (tmp_path / "model.yaml").write_text(text.replace("gravity: GRAVITY", change))
    buckens("check", "model.yaml").must(2, "model.yaml:", "events.moon", *words)


def test_a_sweep_and_an_override_change_a_component(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(FALL.replace("METHOD", "").replace("GRAVITY", "[0, 0, -1.62]"))
    buckens("run", "model.yaml", "-o", "out", "-q", "--set", "events.moon.set.gravity.2=-3.7").must(0)
    rows = numpy.loadtxt(tmp_path / "out" / "sensors.csv", delimiter=",", skiprows=1)
    t = 0.2003 + 1e-3 / 16
    assert rows[-1, 6] == pytest.approx(1 - 10 * t - 3.7 * (0.5 - t), abs=6.3 * 1e-3 / 16 * 1.01)
