# SPDX-License-Identifier: Apache-2.0
"""Events that act: settings, switches, locks and joints that let go, at instants found on shorter steps."""

import json
import math

import numpy
import pytest

BALL = """
buckens: 1
gravity: [0, 0, -10]
bodies: {ball: {rigid: {mass: 1 kg, inertia: [1e-3, 1e-3, 1e-3]}, at: {position: [0, 0, 2]}}}
signals:
  up: {position: {of: ball, along: [0, 0, 1]}}
  low: "up - 1.15"
  thrust: {setting: 0}
SIGNALSevents:
  fire: {when: low, direction: falling, set: {thrust: "12 + 0*up"}}
EVENTSloads: {jet: {force: {on: ball, value: [0, 0, 1 N], signal: thrust}}}
simulation: {duration: 0.8 s, step: 5 ms, METHOD}
output: {every: 10 ms, sensors: {z: {position: {of: ball, along: [0, 0, 1]}}, thrust: {signal: thrust}, balance: {energy: balance}}}
"""


def ball(signals="", events="", method="method: generalized-alpha"):
    return BALL.replace("SIGNALS", signals).replace("EVENTS", events).replace("METHOD", method)


def event_times(tmp_path):
    notes = json.loads((tmp_path / "out" / "summary.json").read_text())["notes"]
    return {note.split('"')[1]: float(note.split("t = ")[1].split(" s")[0]) for note in notes if note.startswith("event")}


@pytest.mark.parametrize("method", ["method: generalized-alpha", "method: newmark", "method: hht"])
def test_a_setting_changes_at_an_instant_located_within_the_step(sensors, tmp_path, method):
    """Free fall, then 2 m/s² upwards: parabolas, which the methods follow exactly."""
    out = sensors(ball(method=method))
    crossing = math.sqrt(0.17)
    # Interpolation within a step is exact for a parabola.
    assert event_times(tmp_path)["fire"] == pytest.approx(crossing, abs=1e-9)
    # It acts at the end of the step of h/16 that contains it.
    acts = math.ceil(crossing / (5e-3 / 16)) * 5e-3 / 16
    after = numpy.maximum(out["t"] - acts, 0.0)
    z = 2 - 5 * numpy.minimum(out["t"], acts) ** 2 - 10 * acts * after + after ** 2
    assert out["z"] == pytest.approx(z, abs=1e-10)
    assert set(out["thrust"]) == {0.0, 12.0}
    assert abs(out["balance"]).max() < 1e-9


def test_steps_under_control_locate_events_too(sensors, tmp_path):
    out = sensors(ball(method="tolerance: 1e-5"))
    assert event_times(tmp_path)["fire"] == pytest.approx(math.sqrt(0.17), abs=1e-9)
    acts = math.sqrt(0.17)
    late = 5e-3 / 16
    after = 0.8 - acts
    # Acting later by up to h/16 leaves the ball lower by 12 late after.
    assert out["z"][-1] == pytest.approx(2 - 5 * acts ** 2 - 10 * acts * after + after ** 2, abs=12 * late * after)


def test_events_follow_from_what_others_set(sensors, tmp_path):
    """One event changes a mode, and the next fires by that mode at the same instant; a record is made."""
    out = sensors(ball("  mode: {setting: 1}\n  armed: \"mode - 1.5\"\n",
                       "  first: {when: low, set: {mode: \"mode + 1\"}, record: on}\n"
                       "  second: {when: armed, direction: rising, do: stop}\n"))
    times = event_times(tmp_path)
    acts = math.ceil(math.sqrt(0.17) / (5e-3 / 16)) * 5e-3 / 16
    assert times["second"] == pytest.approx(acts, abs=1e-12)
    assert out["t"][-1] == pytest.approx(acts, abs=1e-12)
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert any("jumps through zero; the run ends here" in note for note in summary["notes"])


def test_an_event_records_its_instant(sensors):
    out = sensors(ball("", "  look: {when: low, record: on}\n"))
    acts = math.ceil(math.sqrt(0.17) / (5e-3 / 16)) * 5e-3 / 16
    extra = out["t"][numpy.abs(out["t"] / 10e-3 - numpy.round(out["t"] / 10e-3)) > 1e-6]
    assert extra == pytest.approx([acts], abs=1e-12)


SPRING = """
buckens: 1
bodies: {block: {rigid: {mass: 1 kg, inertia: [1e-3, 1e-3, 1e-3]}}}
joints: {way: {prismatic: {between: [ground, block], axis: [1, 0, 0]}}}
signals:
  moved: {joint-displacement: way}
  gone: "moved - 0.05"
  back: "moved - 0.25"
events:
  cut: {when: gone, direction: rising, switch-off: [spring, rub]}
  hook: {when: back, direction: rising, switch-on: spring}
loads:
  spring: {slide-spring: {joint: way, stiffness: 100 N/m}}
  rub: {slide-friction: {joint: way, static: 0, preload: 2 N, slip: 1 um}}
initial: {bodies: {block: {velocity: [1, 0, 0]}}, OFF}
simulation: {duration: 0.5 s, step: 1 ms}
output:
  every: 5 ms
  sensors: {x: {joint-coordinate: way}, force: {spring-force: spring}, balance: {energy: balance}, work: {energy: work}}
"""


def test_springs_and_friction_are_switched(sensors, tmp_path):
    """A spring is taken away at x = 0.05 with its energy, and put on again at 0.25 with the energy it has there."""
    out = sensors(SPRING.replace("OFF", "off: [rub]"))
    times = event_times(tmp_path)
    # x = sin(10 t)/10 to h² (w h)²/12 of the way.
    assert times["cut"] == pytest.approx(math.asin(0.5) / 10, abs=1e-6)
    free = (out["t"] > times["cut"] + 1e-3) & (out["t"] < times["hook"])
    # Switched at most h/16 late: -5 m/s² changes the speed by 3e-4.
    assert out["x.rate"][free] == pytest.approx(math.cos(math.pi / 6), abs=4e-4)
    assert numpy.ptp(out["x.rate"][free]) < 1e-12
    assert abs(out["force"][free]).max() == 0
    # Then it swings about zero again: half a square of speed and force keep what they are.
    held = out["t"] > times["hook"] + 1e-3
    total = 0.5 * out["x.rate"][held] ** 2 + 50 * out["x.value"][held] ** 2
    assert total == pytest.approx(0.375 + 50 * 0.25 ** 2, abs=5e-3)
    # The account closes with h²: what the springs bring along is work from outside.
    assert abs(out["balance"]).max() < 1e-4
    assert out["work"][-1] == pytest.approx(-0.125 + 50 * 0.25 ** 2, abs=5e-3)


def test_friction_acts_until_it_is_switched_off(sensors):
    out = sensors(SPRING.replace("stiffness: 100 N/m", "stiffness: 1e-9 N/m").replace(", OFF", ""))
    # 2 N over 50 mm: v² = 1 - 2 * 2 * 0.05.
    assert out["x.rate"][-1] == pytest.approx(math.sqrt(0.8), abs=2e-4)


CLUTCH = """
buckens: 1
bodies:
  engine: {rigid: {mass: 1 kg, inertia: [1, 1, 0.1]}}
  drum: {rigid: {mass: 1 kg, inertia: [1, 1, 0.3]}}
joints:
  shaft: {revolute: {between: [ground, engine], axis: [0, 0, 1]}}
  clutch: {revolute: {between: [engine, drum], axis: [0, 0, 1]}}
signals:
  angle: {joint-angle: shaft}
  slip: {joint-angle: clutch}
  near: "angle - 3"
  far: "angle - 4"
events:
  engage: {when: near, direction: rising, lock: clutch}
  open: {when: far, direction: rising, unlock: clutch}
loads: {motor: {torque: {on: engine, value: [0, 0, 0.4 N m]}}}
initial: {bodies: {engine: {angular-velocity: [0, 0, 10]}}}
simulation: {duration: 1 s, step: 2 ms}
output:
  every: 4 ms
  sensors: {shaft: {joint-coordinate: shaft}, clutch: {joint-coordinate: clutch}, balance: {energy: balance}, lost: {energy: dissipated}}
"""


def test_a_clutch_locks_by_an_impact_and_opens(sensors, tmp_path):
    """Two wheels keep their momentum and lose the energy that a plastic impact takes."""
    out = sensors(CLUTCH.replace("value: [0, 0, 0.4 N m]", "value: [0, 0, 0]"))
    times = event_times(tmp_path)
    assert times["engage"] == pytest.approx(0.3, abs=1e-9)
    locked = (out["t"] > 0.302) & (out["t"] < times["open"])
    assert out["shaft.rate"][locked] == pytest.approx(2.5, abs=1e-9)  # 0.1 * 10/0.4
    # Held where it was, up to 1e-10 of the motion in each step.
    assert numpy.ptp(out["clutch.value"][locked]) < 1e-9
    assert out["lost"][-1] == pytest.approx(0.5 * 0.1 * 100 - 0.5 * 0.4 * 6.25, abs=1e-9)
    assert abs(out["balance"]).max() < 1e-9


def test_a_lock_carries_torque_until_it_opens(sensors, tmp_path):
    out = sensors(CLUTCH)
    times = event_times(tmp_path)
    locked = (out["t"] > times["engage"] + 2e-3) & (out["t"] < times["open"])
    slope = numpy.polyfit(out["t"][locked], out["shaft.rate"][locked], 1)[0]
    assert slope == pytest.approx(1.0, abs=1e-8)  # 0.4 N m on 0.4 kg m²
    free = out["t"] > times["open"] + 2e-3
    assert numpy.polyfit(out["t"][free], out["shaft.rate"][free], 1)[0] == pytest.approx(4.0, abs=1e-8)
    assert numpy.ptp(out["shaft.rate"][free] + out["clutch.rate"][free]) < 1e-9  # the drum runs on


PENDULUM = """
buckens: 1
gravity: [0, 0, -9.81]
materials: {steel: {E: 2 GPa, nu: 0.3, rho: 7870 kg/m^3}}
bodies:
  rod: {BODY}
joints:
  hook: {revolute: {between: [ground, rod/start], axis: [0, 1, 0]}}
signals:
  side: {position: {of: rod/start_mate, along: [1, 0, 0]}}
events:
  off: {when: side, direction: falling, release: hook}
simulation: {duration: 1 s, step: 1 ms}
output:
  every: 5 ms
  sensors: {v: {velocity: rod/com}, w: {angular-velocity: rod/com}, hook: {joint-force: hook}, total: {energy: total}, balance: {energy: balance}}
"""


def rod(body):
    return PENDULUM.replace("BODY", body)


def test_a_joint_lets_go(sensors, tmp_path):
    """A rigid rod swings to its lowest point and flies on: a parabola with a constant spin."""
    out = sensors(rod("rigid: {mass: 3 kg, com: [0.5, 0, 0], inertia: [0.01, 0.25, 0.25]}, "
                      "markers: {start: {position: [0, 0, 0]}, start_mate: {position: [1, 0, 0]}}"))
    let_go = event_times(tmp_path)["off"]
    spin = math.sqrt(2 * 3 * 9.81 * 0.5 / (0.25 + 3 * 0.25))  # m g l = J w²/2
    free = out["t"] > let_go + 1e-3
    # Swinging has errors of h²: 1e-6 of the speed.
    assert out["w.y"][free] == pytest.approx(spin, abs=1e-4)
    assert out["v.x"][free] == pytest.approx(-0.5 * spin, abs=1e-3)
    for constant in (out["w.y"], out["v.x"], out["v.z"] + 9.81 * out["t"]):
        assert numpy.ptp(constant[free]) < 1e-9
    assert abs(out["hook.z"][free]).max() == 0 and out["hook.z"][~free].max() > 60
    assert abs(out["balance"]).max() < 1e-3


@pytest.mark.parametrize("frames", ["", ", frames: 3"])
def test_a_flexible_body_is_let_go(sensors, tmp_path, frames):
    """Its mass centre flies on a parabola while it vibrates; the parts of a divided body stay tied."""
    out = sensors(rod("beam: {to: [1 m, 0, 0], elements: 6, section: {circle: {diameter: 20 mm}}, material: steel}, "
                      "markers: {start_mate: {position: [1, 0, 0]}}" + frames)
                  .replace("v: {velocity: rod/com}, w: {angular-velocity: rod/com}", "p: {position: rod/start_mate}"))
    let_go = event_times(tmp_path)["off"]
    free = out["t"] > let_go + 1e-3
    assert free.sum() > 20 and abs(out["hook.z"][free]).max() == 0
    # Nothing holds it, so only rounding and the method change its energy.
    assert numpy.ptp(out["total"][free]) < 1e-3
    assert abs(out["balance"]).max() < 2e-2


WRONG = {
    "set: {low: 1}": ("signal \"low\" follows from the motion", "setting"),
    "set: {trust: 1}": ("unknown signal \"trust\"", "thrust"),
    "switch-off: [get]": ("unknown load \"get\"", "jet"),
    "switch-on: [pin]": ("\"pin\" is a joint", "`release`"),
    "lock: [pin]": ("joint \"pin\" is a spherical", "no angle or displacement to hold"),
    "unlock: [pim]": ("unknown joint \"pim\"", "pin"),
    "lock: [drive]": ("joint \"drive\" is a prescribed-rotation", "follows its law of time"),
    "release: [soft]": ("joint \"soft\" is a bushing", "`switch-off`"),
    "release: [pim]": ("unknown joint \"pim\"", "pin"),
}


@pytest.mark.parametrize("action", WRONG)
def test_what_cannot_be_done_is_named(buckens, tmp_path, action):
    joints = """joints:
  pin: {spherical: {between: [ground, ball]}}
  drive: {prescribed-rotation: {between: [ground, ball], axis: [0, 0, 1], angle: 0}}
  soft: {bushing: {between: [ground, ball], stiffness: [1, 1, 1]}}
"""
    text = ball("", f"  wrong: {{when: low, {action}}}\n").replace("signals:", joints + "signals:", 1)
    (tmp_path / "model.yaml").write_text(text)
    line = next(k for k, row in enumerate(text.splitlines(), 1) if "wrong:" in row)
    buckens("check", "model.yaml").must(2, f"model.yaml:{line}:", *WRONG[action])


def test_what_starts_switched_off_must_exist_and_move(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(SPRING.replace("OFF", "off: [rubb]"))
    buckens("check", "model.yaml").must(2, "unknown load \"rubb\"", "rub")
    (tmp_path / "model.yaml").write_text(SPRING.replace("OFF", "off: [rub], start: static"))
    buckens("check", "model.yaml").must(2, "the equilibrium is computed with all loads", "\"rub\"")


def test_events_that_set_each_other_off_are_named(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(ball(
        "  side: {setting: 1}\n  sense: \"side*low\"\n", "  flip: {when: sense, set: {side: \"-side\"}}\n"))
    buckens("run", "model.yaml", "-o", "out").must(4, "event \"flip\"", "\"sense\" chatters")
