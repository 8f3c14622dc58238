# SPDX-License-Identifier: Apache-2.0
"""Events that change parameters of springs, dampers, friction, motors and brakes."""

import json
import math

import numpy
import pytest

SLIDE = """buckens: 1
gravity: [0, 0, -10]
bodies: {block: {rigid: {mass: 2 kg, inertia: [2, 2, 2]}, at: {position: [0.5, 0, 0]}}}
joints:
  rail: {prismatic: {between: [{ground: [0.5, 0, 0]}, block], axis: [1, 0, 0]}}
  mount: {bushing: {between: [ground, block]MOUNT}}
signals: {at: {joint-displacement: rail}, armed: {setting: 1}, past: "at - LEVEL + 10*(1 - armed)", twice: "2*at"}
events: {change: {when: past, direction: DIRECTION, set: {SET, armed: 0}, record: on}}
loads: {LOADS}
initial: {joints: {rail: {displacement: START, velocity: SPEED}}}
simulation: {duration: 0.5 s, step: 1 ms}
output:
  every: 10 ms
  sensors:
    x: {signal: at}
    v: {velocity: {of: block, along: [1, 0, 0]}}
    balance: {energy: balance}
    events: {energy: events}
    held: {energy: springs}
    lost: {energy: dissipated}
"""


def filled(loads, change, level="0.01", direction="falling", start="0.02", speed="0", mount=""):
    return (SLIDE.replace("LOADS", loads).replace("SET", change).replace("LEVEL", level).replace("DIRECTION", direction)
            .replace("START", start).replace("SPEED", speed).replace("MOUNT", mount))


def acts(out):
    """The instant at which it acts, which is recorded."""
    extra = out["t"][numpy.abs(out["t"] / 10e-3 - numpy.round(out["t"] / 10e-3)) > 1e-6]
    assert len(extra) == 1
    return extra[0]


SPRINGS = {
    "slide-spring": ("spring: {slide-spring: {joint: rail, stiffness: 800}}", "loads.spring.stiffness: 3200 N/m", ""),
    "spring-damper": ("spring: {spring-damper: {between: [ground, block], stiffness: 800}}", "loads.spring.stiffness: 3200", ""),
    "by a formula": ("spring: {slide-spring: {joint: rail, stiffness: 800}}", "loads.spring.stiffness: \"3200 + 0*twice N/m\"", ""),
    "bushing": ("", "joints.mount.stiffness-factor: 4", ", stiffness: [800, 0, 0]"),
}


@pytest.mark.parametrize("name", SPRINGS)
def test_a_stiffness_changes_at_a_crossing(sensors, tmp_path, name):
    """Two harmonic pieces, joined where the event acts; what the spring gains there is work of events."""
    loads, change, mount = SPRINGS[name]
    out = sensors(filled(loads, change, mount=mount), "-q")
    # 0.02 cos 20 t = 0.01; found between steps, whose period is longer by (w h)^2/24.
    note = next(note for note in json.loads((tmp_path / "out" / "summary.json").read_text())["notes"] if note.startswith("event"))
    crossing = math.pi / 3 / 20
    assert float(note.split("t = ")[1].split(" s")[0]) == pytest.approx(crossing, rel=2e-4)
    t = acts(out)
    assert crossing <= t + 2e-5 and t - crossing < 1e-3 / 16 + 2e-5
    x, v = 0.02 * math.cos(20 * t), -0.4 * math.sin(20 * t)
    after = out["t"] - t
    exact = numpy.where(after < 0, 0.02 * numpy.cos(20 * out["t"]), x * numpy.cos(40 * after) + v / 40 * numpy.sin(40 * after))
    # Of (w h)^2/24 each of 4 + 18 rad.
    assert out["x"] == pytest.approx(exact, abs=4e-5 * 1.2)
    k = numpy.flatnonzero(after == 0)
    jump = 0.5 * 2400 * out["x"][k]**2
    assert out["events"][out["t"] < t] == pytest.approx(0.0, abs=0.0)
    late = out["events"][out["t"] > t]
    assert late == pytest.approx(numpy.full(len(late), jump[0]), rel=1e-12)
    assert numpy.abs(out["balance"]).max() < 2e-4 * jump[0]


def test_a_damper_begins_at_a_crossing(sensors):
    out = sensors(filled("damper: {slide-spring: {joint: rail, damping: 0}}", "loads.damper.damping: 8 N s/m", level="0.0997",
                         direction="rising", start="0", speed="1"), "-q")
    t = acts(out)
    assert t == pytest.approx(math.ceil(0.0997 / (1e-3 / 16)) * 1e-3 / 16, abs=1e-12)
    assert out["v"] == pytest.approx(numpy.exp(-4 * numpy.maximum(out["t"] - t, 0.0)), abs=1e-5)
    assert out["lost"] == pytest.approx(1 - out["v"]**2, abs=2e-5)


@pytest.mark.parametrize("stick", ["", ", stick: rigid"])
def test_friction_changes_at_a_crossing(sensors, stick):
    """Deceleration of 1, then of 3 m/s^2, until it stands."""
    out = sensors(filled(f"rub: {{slide-friction: {{joint: rail, static: 0.1{stick}}}}}", "loads.rub.static: 0.3", level="0.1",
                         direction="rising", start="0", speed="1"), "-q")
    first = (1 - math.sqrt(1 - 2 * 0.1)) / 1
    v = math.sqrt(0.8)
    exact = numpy.where(out["t"] < first, 1 - out["t"], numpy.maximum(v - 3 * (out["t"] - first), 0.0))
    # As late as h/16, and the start and end of sliding within a step.
    assert out["v"] == pytest.approx(exact, abs=2 * 1e-3 / 16 + 2e-3)
    assert abs(out["v"][-1]) < 1e-9


MOTOR = """buckens: 1
gravity: [0, 0, 0]
bodies: {wheel: {rigid: {mass: 1 kg, inertia: [1, 1, 2]}}}
joints: {axle: {revolute: {between: [ground, wheel], axis: [0, 0, 1]}}}
signals: {w: {joint-speed: axle}, fast: "w - 0.25"}
events: {change: {when: fast, direction: rising, set: {loads.motor.KEY}}}
loads: {motor: {KIND: {joint: axle, LAW}}}
initial: {joints: {axle: {speed: START}}}
simulation: {duration: 0.5 s, step: 1 ms}
output: {every: 10 ms, sensors: {w: {signal: w}}}
"""


@pytest.mark.parametrize("law, change", [("speed: 1000, torque-limit: 4 N m", "torque-limit: 1 N m"), ("torque: 4", "torque: 1 N m"),
                                         ("torque: 9, torque-limit: 4", "torque-limit: 1")])
def test_a_motor_changes_at_a_speed(sensors, law, change):
    """J w' = 4 up to w = 1/4, then 1."""
    out = sensors(MOTOR.replace("KIND", "hinge-motor").replace("LAW", law).replace("KEY", change).replace("START", "0"), "-q")
    assert out["w"] == pytest.approx(numpy.where(out["t"] < 0.125, 2 * out["t"], 0.25 + 0.5 * (out["t"] - 0.125)), abs=1.5 * 1e-3)


def test_a_brake_changes_at_a_speed(sensors):
    text = MOTOR.replace("KIND", "hinge-brake").replace("LAW", "torque: 4").replace("KEY", "torque: 1").replace("START", "1")
    out = sensors(text.replace("rising", "falling"), "-q")
    assert out["w"] == pytest.approx(numpy.where(out["t"] < 0.375, 1 - 2 * out["t"], 0.25 - 0.5 * (out["t"] - 0.375)), abs=1.5 * 1e-3)


def test_a_run_goes_on_over_and_after_changes(goes_on):
    text = filled("spring: {slide-spring: {joint: rail, stiffness: 800, damping: 1}}", "loads.spring.stiffness: 3200, loads.spring.damping: \"3 + twice\"")
    goes_on(text, "0.5 s", "0.25 s", 52)
    goes_on(text, "0.5 s", "0.04 s", 52)


def test_a_sweep_varies_what_holds_before(buckens, tmp_path):
    """Every variant is what it is alone, and harmonic with its own frequency up to its own crossing."""
    (tmp_path / "model.yaml").write_text(filled("spring: {slide-spring: {joint: rail, stiffness: 800}}", "loads.spring.stiffness: 3200"))
    (tmp_path / "table.csv").write_text("name,loads.spring.slide-spring.stiffness\nsoft,800\nhard,1800 N/m\n")
    buckens("sweep", "model.yaml", "table.csv", "-o", "out", "-q").must(0)
    for name, k in (("soft", 800), ("hard", 1800)):
        rows = numpy.loadtxt(tmp_path / "out" / name / "sensors.csv", delimiter=",", skiprows=1)
        early = rows[:, 0] < math.pi / 3 / math.sqrt(k / 2)
        assert rows[early, 1] == pytest.approx(0.02 * numpy.cos(math.sqrt(k / 2) * rows[early, 0]), abs=1e-5)
        buckens("run", "model.yaml", "-o", "alone" + name, "-q", "--set", f"loads.spring.slide-spring.stiffness={k}").must(0)
        assert (rows == numpy.loadtxt(tmp_path / ("alone" + name) / "sensors.csv", delimiter=",", skiprows=1)).all()


@pytest.mark.parametrize("change, words", [
    ("loads.spring.stifness: 3", ['events cannot change "loads.spring.stifness"; here they can change', "loads.spring.stiffness"]),
    ("loads.sprng.stiffness: 3", ['events cannot change "loads.sprng.stiffness"', 'Did you mean "loads.spring.stiffness"?']),
    ("joints.rail.axis: 3", ['events cannot change "joints.rail.axis"', "springs and dampers, joint friction, motors and brakes"]),
    ("loads.spring.characteristic: 3", ['events cannot change "loads.spring.characteristic"; here they can change']),
    ("loads.spring.damping: 3 N/m", ["set.loads.spring.damping", "the value is a stiffness or force per length, not a damping constant"]),
    ("loads.spring.damping: -3", ["set.loads.spring.damping", "-3 is not allowed: the value must not be negative"]),
    ("loads.spring.length: 0.5 m", ['"loads.spring.length" is not given in the model; give it a number there']),
    ("loads.driven.stiffness: 5", ["set.loads.driven.stiffness", "it depends on time or signals; let the event change a `setting`"]),
    ("bodies.block.mass: 5", ['events cannot change "bodies.block.mass"']),
])
def test_what_cannot_be_changed_is_refused(buckens, tmp_path, change, words):
    (tmp_path / "model.yaml").write_text(filled("spring: {spring-damper: {between: [ground, block], stiffness: 800}}, "
                                                "driven: {slide-spring: {joint: rail, stiffness: \"800 + at\"}}", change))
    buckens("check", "model.yaml").must(2, "model.yaml:", "events.change", *words)
