# SPDX-License-Identifier: Apache-2.0
"""Events that change what two bodies touch with."""

import math

import numpy
import pytest

BALL = """buckens: 1
gravity: [0, 0, -10]
bodies: {ball: {rigid: {mass: 2 kg, inertia: [1, 1, 1]}, at: {position: [0, 0, START]}}}
loads: {floor: {contact: {between: [ground, ball], shapes: [{plane: [0, 0, 1]}, {sphere: 100 mm}], LAW}}}
signals: {late: "t - WHEN"}
events: {worn: {when: late, direction: rising, set: {SET}, record: on}}
SPEEDsimulation: {duration: LONG s, step: STEP}
output:
  every: EVERY
  sensors: {p: {position: ball}, v: {velocity: ball}, n: {contact: floor}, balance: {energy: balance}, events: {energy: events},
            lost: {energy: dissipated}, held: {energy: springs}}
"""


def ball(law, change, when, start="0.9", speed="", long="1.5", step="1 ms", every="10 ms"):
    return (BALL.replace("START", start).replace("LAW", law).replace("WHEN", when).replace("SET", change).replace("LONG", long)
            .replace("SPEED", f"initial: {{{speed}}}\n" if speed else "").replace("STEP", step).replace("EVERY", every))


def acts(out):
    """The instant at which it acts, which is recorded."""
    extra = out["t"][numpy.abs(out["t"] / 10e-3 - numpy.round(out["t"] / 10e-3)) > 1e-6]
    assert len(extra) == 1
    return extra[0]


def heights(out):
    """Those that the ball rises to with the energy that it has, above where it touches."""
    return out["p.z"] - 0.1 + out["v.z"]**2 / 20


def test_a_rigid_ball_bounces_with_another_restitution(sensors):
    """Falls 0.8 m, bounces at 0.4 and 1.04 s, then with 0.5 in place of 0.8: exact, impacts are found within steps."""
    out = sensors(ball("restitution: 0.8", "loads.floor.restitution: 0.5", "0.6003"), "-q")
    second = 0.4 + 2 * 0.8 * 0.4
    third = second + 2 * 0.4 * 0.4
    after = [(0, 0.4, 1), (0.4, second, 0.8**2), (second, third, 0.8**2 * 0.5**2)]
    for begin, end, share in after:
        during = (out["t"] > begin + 1e-3) & (out["t"] < end - 1e-3)
        assert during.sum() > 20
        # Rounding of 1500 steps.
        assert heights(out)[during] == pytest.approx(0.8 * share, abs=1e-11)
    lost = 2 * 10 * 0.8 * (1 - 0.8**2 * 0.5**2)
    assert out["lost"][(out["t"] > second + 1e-3) & (out["t"] < third - 1e-3)] == pytest.approx(lost, rel=1e-10)
    assert numpy.abs(out["balance"]).max() < 1e-10
    assert numpy.abs(out["events"]).max() == 0.0


def test_an_elastic_ball_bounces_with_another_restitution(sensors):
    out = sensors(ball("stiffness: 1e6, restitution: 0.9", "loads.floor.restitution: 0.5", "0.6003", step="0.1 ms"), "-q")
    first = (out["t"] > 0.42) & (out["t"] < 1.1)
    second = (out["t"] > 1.15) & (out["t"] < 1.45)
    # Impacts take 4.4 ms, so 45 steps, an error of (w h)^2 = 5e-3 of what is lost; weight shifts both by mg/k = 2e-5 m.
    assert heights(out)[first] == pytest.approx(0.8 * 0.81, abs=5e-3)
    assert heights(out)[second] == pytest.approx(0.8 * 0.81 * 0.25, abs=5e-3)


@pytest.mark.parametrize("law", ["stiffness: 2000", "stiffness: 2000, static: 0.2"])
def test_ground_stiffens_below_a_ball_at_rest(sensors, law):
    """At rest 10 mm deep; with 1.5 times the stiffness it swings between 10 and 10/3 mm."""
    out = sensors(ball(law, "loads.floor.stiffness: 3000 N/m", "0.2003", start="0.09", long="1"), "-q")
    t = acts(out)
    w = math.sqrt(3000 / 2)
    late = numpy.maximum(out["t"] - t, 0)
    depth = numpy.where(out["t"] < t, 0.01, 0.01 * (2 + numpy.cos(w * late)) / 3)
    # The method is late by (w h)^2/12 rad each rad: 31 rad of 3.3 mm; and so are energies.
    slow = (w * 1e-3)**2 / 12
    assert 0.1 - out["p.z"] == pytest.approx(depth, abs=3.4e-3 * 31 * slow)
    # What it holds jumps by half of the difference times the square of the depth: work of events, exact.
    assert out["events"][out["t"] > t] == pytest.approx(0.5 * 1000 * (0.1 - out["p.z"][out["t"] == t][0])**2, rel=1e-12)
    assert numpy.abs(out["balance"]).max() < 0.05 * 12 * slow


def test_ground_damps_from_an_event_on(sensors):
    """Swings by 1 mm about 10 mm; from the event on the amplitude falls with exp(-c t/2m)."""
    out = sensors(ball("stiffness: 2000", "loads.floor.damping: 20 N s/m", "0.2003", start="0.09", speed="bodies: {ball: {velocity: [0, 0, 0.03]}}", long="0.6"), "-q")
    t = acts(out)
    w, rate = math.sqrt(1000), 20 / 4
    late = out["t"] - t
    x, v = (0.03 / w) * math.sin(w * t), 0.03 * math.cos(w * t)
    wd = math.sqrt(w**2 - rate**2)
    damped = numpy.exp(-rate * late) * (x * numpy.cos(wd * late) + (v + rate * x) / wd * numpy.sin(wd * late))
    exact = numpy.where(late < 0, (0.03 / w) * numpy.sin(w * out["t"]), damped)
    assert out["p.z"] - 0.09 == pytest.approx(exact, abs=1e-3 * 19 * (w * 1e-3)**2 / 12 * 1.2)
    assert numpy.abs(out["balance"]).max() < 1e-3 * 0.9e-3 * 2


SLIDE = """buckens: 1
gravity: [0, 0, -10]
bodies: {block: {rigid: {mass: 2 kg, inertia: [1e-2, 1e-2, 1e-2]}, at: {position: [0, 0, HEIGHT]}}}
loads: {floor: {contact: {between: [ground, block], shapes: [{plane: [0, 0, 1]}, {box: [0.2, 0.2, 10 mm]}], LAW}}}
signals: {way: {position: {of: block, along: [1, 0, 0]}}, far: "way - 0.1"}
events: {wet: {when: far, direction: rising, set: {SET}, record: on}}
initial: {bodies: {block: {velocity: [1, 0, 0]}}}
simulation: {duration: 0.5 s, step: 1 ms}
output: {every: 10 ms, sensors: {x: {position: block}, v: {velocity: block}, balance: {energy: balance}, events: {energy: events}, lost: {energy: dissipated}}}
"""
FIRST = (1 - math.sqrt(1 - 0.2))  # 0.1 m at 1 m/s less 1 m/s^2


@pytest.mark.parametrize("change, slows", [("loads.floor.static: 0.3", 3), ("loads.floor.static: 0.02", 0.2), ("loads.floor.static: 0", 0)])
def test_a_block_slides_onto_other_ground(sensors, change, slows):
    """Decelerates by 1 m/s^2, from 0.1 m on by another number, until it stands."""
    out = sensors(SLIDE.replace("HEIGHT", "5e-3").replace("LAW", "static: 0.1").replace("SET", change), "-q")
    t = acts(out)
    assert FIRST - 1e-9 < t < FIRST + 1e-3 / 16 + 1e-9
    late = numpy.maximum(out["t"] - t, 0)
    v = numpy.maximum(1 - numpy.minimum(out["t"], t) - slows * late, 0)
    # Rounding; where it comes to rest, as friction ends at an end of a step.
    stops = t + (1 - t) / slows if slows else 1.0
    slides = out["t"] < stops - 1e-3
    assert out["v.x"][slides] == pytest.approx(v[slides], abs=1e-9)
    assert numpy.abs(out["v.x"][out["t"] > stops + 1e-3]).max(initial=0.0) < 1e-9
    assert out["lost"][slides] == pytest.approx(1 - v[slides]**2, abs=1e-8)
    assert numpy.abs(out["balance"][slides]).max() < 1e-9
    # In the step in which it stops friction acts for a part of it: of m (a h)^2/2.
    assert numpy.abs(out["balance"]).max() < (3 * 1e-3)**2
    assert numpy.abs(out["events"]).max() == 0.0


@pytest.mark.parametrize("stiffness, near", [("", 1e-9), (", stiffness: 1e6, damping: 2000", 2e-3)])
@pytest.mark.parametrize("change", ["loads.floor.static: 0.1", "gravity: [7, 0, -10]"])
def test_what_sticks_begins_to_slide(sensors, change, stiffness, near):
    """Held by 0.5 of what presses against 0.3, until less holds it or more pulls: both leave 2 m/s^2."""
    text = SLIDE.replace("HEIGHT", "5e-3").replace("LAW", "static: 0.5" + stiffness).replace("SET", change)
    out = sensors(text.replace("[0, 0, -10]", "[3, 0, -10]").replace('"way - 0.1"', '"t - 0.1003"').replace("velocity: [1, 0, 0]", "velocity: [0, 0, 0]"), "-q")
    t = acts(out)
    # Rounding where the contact is rigid; an elastic one creeps until it holds, and pitches.
    assert out["v.x"] == pytest.approx(2 * numpy.maximum(out["t"] - t, 0), abs=near)


def test_a_coefficient_of_sliding_changes_alone(sensors):
    """Far above the Stribeck velocity it is that of sliding; not more than that of sticking."""
    law = "static: 0.4, dynamic: 0.1, stribeck-velocity: 1 mm/s"
    for change, slows in (("0.2", 2), ("0.9", 4)):
        out = sensors(SLIDE.replace("HEIGHT", "5e-3").replace("LAW", law).replace("SET", f"loads.floor.dynamic: {change}"), "-q")
        t = acts(out)
        v = 1 - numpy.minimum(out["t"], t) - slows * numpy.maximum(out["t"] - t, 0)
        slides = v > 0.05
        assert out["v.x"][slides] == pytest.approx(v[slides], abs=1e-9)


def test_a_block_slides_onto_other_elastic_ground(sensors):
    """Strains that friction holds are 2 mm of 2 N, 1e-4 m long; as it gives less, what they lose is work of events."""
    law = "stiffness: 5e4, static: 0.1, tangential-stiffness: 2e4"
    out = sensors(SLIDE.replace("HEIGHT", "4.9e-3").replace("LAW", law).replace("SET", "loads.floor.static: 0.05"), "-q")
    t = acts(out)
    late = numpy.maximum(out["t"] - t, 0)
    v = 1 - numpy.minimum(out["t"], t) - 0.5 * late
    # It pitches and sinks a little as friction begins and changes.
    assert out["v.x"] == pytest.approx(v, abs=6e-3)
    # Each of four places holds (mu N)^2/2k with N = 5 N; pitching moves loads between them, by up to mu h/l = 1/40 each.
    change = 4 * (5**2 / (2 * 2e4)) * (0.05**2 - 0.1**2)
    assert out["events"][-1] == pytest.approx(change, rel=0.02)
    assert numpy.abs(out["balance"]).max() < 0.02 * 1.0


@pytest.mark.parametrize("law, change", [("restitution: 0.8", "loads.floor.restitution: 0.5"),
                                         ("stiffness: 1e5, restitution: 0.8, static: 0.1", "loads.floor.stiffness: 2e5, loads.floor.restitution: 0.5, loads.floor.static: 0.3"),
                                         ("restitution: 0.6, static: 0.1", "loads.floor.static: 0.4")])
def test_a_run_goes_on_over_and_after_changes(goes_on, law, change):
    text = ball(law, change, "0.6003", speed="bodies: {ball: {velocity: [0.5, 0, 0]}}")
    goes_on(text, "1.5 s", "1 s", 152)
    goes_on(text, "1.5 s", "0.5 s", 152)


@pytest.mark.parametrize("law, change, words", [
    ("restitution: 0.8", "loads.floor.restitution: 1.2", ["set.loads.floor.restitution", "expected 0 to 1, found 1.2"]),
    ("stiffness: 1e5, restitution: 0.8", "loads.floor.restitution: 0", ["set.loads.floor.restitution", "expected 0.01 to 1 for an elastic contact"]),
    ("stiffness: 1e5", "loads.floor.restitution: 0.5", ['"loads.floor.restitution" is not given in the model; give it a number there']),
    ("restitution: 0.8", "loads.floor.stiffness: 1e5", ['events cannot change "loads.floor.stiffness"; here they can change loads.floor.restitution']),
    ("restitution: 0.8", "loads.floor.damping: 10", ['events cannot change "loads.floor.damping"; here they can change']),
    ("stiffness: 1e5", "loads.floor.stiffness: 0", ["set.loads.floor.stiffness", "0 is not allowed: the value must be positive"]),
    ("stiffness: 1e5", "loads.floor.stiffness: 10 N s/m", ["set.loads.floor.stiffness", "the value is a damping constant, not a stiffness"]),
    ("modulus: [210 GPa, 70 GPa]", "loads.floor.stiffness: 1e5", ['"loads.floor.stiffness" is not given in the model']),
    ("restitution: 0", "loads.floor.static: 0.3", ['"loads.floor.static" is not given in the model; give it a number above 0 there']),
    ("static: 0.3", "loads.floor.static: -0.3", ["set.loads.floor.static", "-0.3 is not allowed: the value must not be negative"]),
    ("static: 0.3", "loads.floor.dynamic: 0.2", ['"loads.floor.dynamic" is not given in the model; give it a number, and `stribeck-velocity`, there']),
    ("static: 0.3", "loads.floor.shapes: 1", ['events cannot change "loads.floor.shapes"; here they can change']),
])
def test_what_a_contact_keeps_is_refused(buckens, tmp_path, law, change, words):
    (tmp_path / "model.yaml").write_text(ball(law, change, "0.6"))
    buckens("check", "model.yaml").must(2, "model.yaml:", "events.worn", *words)


def together(text):
    """The same with the contact as one of many bodies."""
    start, end = text.index("contact: {between"), text.index("], ", text.index("shapes: [")) + 3
    before = text[start:end]
    bodies = before[before.index("between: [ground, ") + 18:before.index("], shapes")]
    first, second = before[before.index("shapes: [") + 9:-3].split("}, ", 1)
    return text[:start] + f"contacts: {{among: [{{on: ground, {first[1:]}}}, {{on: {bodies}, {second[1:-1]}}}], " + text[end:]


@pytest.mark.parametrize("law, change", [
    ("restitution: 0.8, static: 0.1", "loads.floor.restitution: 0.5, loads.floor.static: 0.4"),
    ("stiffness: 1e5, restitution: 0.8, damping: 20, static: 0.1, dynamic: 0.05, stribeck-velocity: 0.1",
     "loads.floor.stiffness: 2e5, loads.floor.restitution: 0.5, loads.floor.damping: 100, loads.floor.static: 0.3, loads.floor.dynamic: 0.2"),
])
def test_a_group_changes_as_its_contacts_do(sensors, goes_on, law, change):
    """Bounces with spin, on ground that changes while the ball flies, and again while it touches the ground (at 1.45 s)."""
    text = ball(law, change, "0.6003", speed="bodies: {ball: {velocity: [0.5, 0, 0]}}", start="0.5", long="1.6", step="0.5 ms")
    text = text.replace("events: {worn:", f"events: {{again: {{when: later, direction: rising, set: {{{change.replace('0.5', '0.6').replace('0.4', '0.2')}}}}}, worn:").replace("signals: {", "signals: {later: t - 1.45, ")
    one, group = sensors(text, "-q"), sensors(together(text), "-q")
    for name in one:
        if name.startswith("n."):
            continue  # other quantities
        # The same in another order of operations.
        assert group[name] == pytest.approx(one[name], rel=1e-9, abs=1e-9), name
    assert group["n.normal"] == pytest.approx(one["n.normal"], rel=1e-6, abs=1e-6) and group["n.friction"] == pytest.approx(one["n.friction"], rel=1e-6, abs=1e-6)
    for out in (one, group):
        assert numpy.abs(out["balance"]).max() < 2e-2 * out["lost"][-1]
    goes_on(together(text), "1.6 s", "1 s", len(one["t"]))
    goes_on(together(text), "1.6 s", "0.5 s", len(one["t"]))


@pytest.mark.parametrize("law", ["stiffness: 2e4", "stiffness: 2e4, static: 0.2"])
def test_ground_stiffens_below_two_balls_of_a_group(sensors, law):
    """Each lies 1 mm deep on 2e4 N/m, which holds 10 mJ; twice as stiff the ground holds 20 mJ: work of the event."""
    text = together(ball(law, "loads.floor.stiffness: 4e4", "0.1003", start="0.099", long="0.3"))
    text = text.replace("bodies: {ball:", "bodies: {other: {rigid: {mass: 2 kg, inertia: [1, 1, 1]}, at: {position: [1, 0, 0.099]}}, ball:")
    text = text.replace("{on: ball, sphere: 100 mm}", "{bodies: [ball, other], sphere: 100 mm}")
    out = sensors(text, "-q")
    assert (out["n.touching"][out["t"] < 0.1] == 2).all()
    assert out["events"][-1] == pytest.approx(2 * 0.5 * 2e4 * 1e-6, rel=1e-9)
    assert numpy.abs(out["balance"]).max() < 1e-6
    assert out["n.normal"][-1] != pytest.approx(40, rel=1e-2)  # they swing


def test_what_a_group_keeps_is_refused(buckens, tmp_path):
    for law, change, words in (("restitution: 0.8", "loads.floor.stiffness: 1e5", "here they can change loads.floor.restitution"),
                               ("static: 0.3", "loads.floor.among: 1", "here they can change"),
                               ("restitution: 0.8", "loads.floor.restitution: 1.2", "expected 0 to 1, found 1.2"),
                               ("stiffness: 1e5, restitution: 0.8", "loads.floor.restitution: 0", "expected 0.01 to 1 for an elastic contact"),
                               ("modulus: 210 GPa", "loads.floor.stiffness: 1e5", "is not given in the model")):
        (tmp_path / "model.yaml").write_text(together(ball(law, change, "0.6")))
        buckens("check", "model.yaml").must(2, "model.yaml:", "events.worn", words)
