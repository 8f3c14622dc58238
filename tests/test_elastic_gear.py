# SPDX-License-Identifier: Apache-2.0
"""Gears with elastic teeth and backlash against closed forms."""

import math

import numpy
import pytest

HELD = """
buckens: 1
bodies:
  wheel: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}}
  pinion: {rigid: {mass: 1 kg, inertia: [1, 1, 0.2]}, at: {position: [6, 0, 0]}}
joints:
  far: {fixed: {between: [ground, wheel]}}
  near: {revolute: {between: [{ground: [6, 0, 0]}, pinion], axis: [0, 0, 1]}}
loads:
  twist: {torque: {on: pinion, value: [0, 0, TORQUE]}}
  teeth: {elastic-gear: {between: [wheel, pinion], axis: [0, 0, 1], teeth: [40, 20], pressure-angle: 20 deg, helix-angle: 10 deg,
                         stiffness: 1e6 N/m, damping: 1 kN s/m, backlash: PLAY}}
simulation: {duration: 1 s, step: 1 ms}
output:
  every: 10 ms
  sensors: {turn: {joint-coordinate: near}, bearing: {joint-force: near}, balance: {energy: balance}}
"""


def test_teeth_give_way_as_their_stiffness_says(sensors):
    """chrono, utest_CH_gears: radii 4 and 2 m, 1000 N m, 1e6 N/m: 2.91921e-4 rad."""
    slip = 1000 / 2 / (1e6 * math.cos(math.radians(20)) ** 2 * math.cos(math.radians(10)) ** 2) / 2
    assert slip == pytest.approx(2.91921e-4, abs=5e-10)
    for play in (0, 0.004):
        for sign in (1, -1):
            out = sensors(HELD.replace("TORQUE", str(sign * 1000)).replace("PLAY", f"{play} m"))
            # Critical is 2 √(k J)/r = 380 N s/m at the base circle: vibrations die out within 10 ms.
            # Half of the play is passed before on the pitch circle of 2 m.
            assert sign * out["turn.value"][-1] == pytest.approx(slip + play / 2 / 2, rel=1e-9)
            assert out["bearing.x"][-1] == pytest.approx(-184.7925, abs=5e-5)
            assert out["bearing.y"][-1] == pytest.approx(-sign * 500, rel=1e-9)
            assert abs(out["bearing.z"][-1]) == pytest.approx(88.1635, abs=5e-5)


def test_its_sensor_tells_force_and_deflection_of_the_teeth(sensors):
    for sign in (1, -1):
        text = HELD.replace("TORQUE", str(sign * 1000)).replace("PLAY", "1 mm")
        out = sensors(text.replace("sensors: {", "sensors: {mesh: {gear: teeth}, "))
        # 500 N on the pitch circle, normal to flanks inclined by 20 and 10 degrees; the wheel with 40 teeth is first.
        force = 500 / math.cos(math.radians(20)) / math.cos(math.radians(10))
        assert out["mesh.force"][-1] == pytest.approx(sign * force, rel=1e-9)
        assert out["mesh.deflection"][-1] == pytest.approx(sign * force / 1e6, rel=1e-9)
        assert out["mesh.force"][0] == out["mesh.deflection"][0] == 0  # in the middle of the play


def test_a_sensor_of_no_elastic_gear_is_refused(buckens, tmp_path):
    text = HELD.replace("TORQUE", "0").replace("PLAY", "0")
    (tmp_path / "model.yaml").write_text(text.replace("sensors: {", "sensors: {mesh: {gear: tooth}, "))
    buckens("check", "model.yaml").must(2, "output.sensors.mesh.gear.gear", "no elastic-gear \"tooth\"", "\"teeth\"")


# Two wheels whose rims are equally heavy, J/r² = 0.1 kg.
RATTLE = """
buckens: 1
planar: xy
bodies:
  small: {rigid: {mass: 1 kg, inertia: [0, 0, 2.5e-4]}}
  large: {rigid: {mass: 1 kg, inertia: [0, 0, 1e-3]}, at: {position: [0.15, 0, 0]}}
joints:
  a: {revolute: {between: [ground, small]}}
  b: {revolute: {between: [{ground: [0.15, 0, 0]}, large]}}
loads: {teeth: {elastic-gear: {between: [small, large], teeth: [20, 40], stiffness: 1e8 N/m, backlash: 1 mm}}}
initial: {bodies: {small: {angular-velocity: [0, 0, 10]}}}
simulation: {duration: 20 ms, step: STEP, method: newmark}
output:
  every: 10 us
  sensors: {small: {joint-coordinate: a}, large: {joint-coordinate: b}, balance: {energy: balance}, total: {energy: total}}
"""


def test_gears_rattle_between_their_flanks(sensors):
    """Rims of equal mass exchange their speeds at every elastic blow, and pass the play in between."""
    out = sensors(RATTLE.replace("STEP", "1 us"))
    # A blow lasts π √(m/k) = 70 us, m being half of 0.1 kg over cos² α.
    blow = math.pi * math.sqrt(0.05 / (1e8 * math.cos(math.radians(20)) ** 2))
    assert blow == pytest.approx(7.5e-5, rel=1e-2)
    first = 0.5e-3 / 0.5  # half of the play at 0.5 m/s
    rim = 0.05 * out["small.rate"]
    other = -0.1 * out["large.rate"]
    again = first + blow + 1e-3 / 0.5
    third = again + blow + 1e-3 / 0.5
    assert third + blow < 0.02
    for begin, end, mine, its in ((0, first, 0.5, 0), (first + blow, again, 0, 0.5), (again + blow, third, 0.5, 0)):
        free = (out["t"] > begin + 2e-5) & (out["t"] < end - 2e-5)
        assert free.sum() > 50
        # The step of 1 us within blows of 75 us, which begin and end between instants: (ω h)² and h ω.
        assert rim[free] == pytest.approx(mine, abs=5e-3)
        assert other[free] == pytest.approx(its, abs=5e-3)
    # Nothing is lost but where blows begin and end within a step.
    assert abs(out["balance"]).max() < 2e-3 * out["total"][0]
    # Momentum of the rims, exactly: the teeth push both alike.
    assert rim + other == pytest.approx(0.5, rel=1e-9)


@pytest.mark.parametrize("start", ["", "off: [teeth], "])
def test_teeth_engage_where_the_gears_are(sensors, start):
    """Out of mesh the gears turn by other numbers of teeth; switched on again, teeth begin in the middle of their play."""
    text = RATTLE.replace("STEP", "2 us").replace("duration: 20 ms", "duration: 0.32 s").replace("every: 10 us", "every: 20 us")
    text = text.replace("initial: {bodies: {small: {angular-velocity: [0, 0, 10]}}}", f"""initial: {{{start}bodies: {{small: {{angular-velocity: [0, 0, 61]}}, large: {{angular-velocity: [0, 0, -29]}}}}}}
signals: {{out: "t - 0.1e-3", in: "t - 0.3"}}
events: {{open: {{when: out, switch-off: teeth}}, close: {{when: in, switch-on: teeth}}}}""")
    out = sensors(text.replace("sensors: {", "sensors: {mesh: {gear: teeth}, "))
    rim, other = 0.05 * out["small.rate"], -0.1 * out["large.rate"]
    t = out["t"]
    # 3.05 and 2.9 m/s: half of the play of 1 mm is passed in 3.3 ms, then the rims exchange their speeds in a blow of 75 us.
    assert out["small.value"][-1] > 6 * math.pi
    assert rim[t < 0.3033] == pytest.approx(3.05, abs=1e-9)
    assert abs(out["mesh.force"][t < 0.3033]).max() == 0
    late = (t > 0.3035) & (t < 0.3098)
    assert rim[late] == pytest.approx(2.9, abs=2e-3)
    assert other[late] == pytest.approx(3.05, abs=2e-3)
    # The blow: √(k m) v with the mass of both rims together, 0.05 kg; records every 20 us miss its top by up to 10 of 75 us.
    largest = 0.15 * math.sqrt(0.05 * 1e8)
    assert math.cos(math.pi * 10 / 75) * largest < out["mesh.force"].max() < 1.001 * largest
    assert abs(out["balance"]).max() < 2e-3 * out["total"][0]


@pytest.mark.parametrize("kind", ["joints: {shaft: {revolute: {between: [ground, a], axis: [0, 0, 1]}}, g: {gear: {GEAR}}}",
                                  "joints: {shaft: {revolute: {between: [ground, a], axis: [0, 0, 1]}}}\n"
                                  "loads: {g: {elastic-gear: {GEAR, stiffness: 1e6}}}"])
def test_gears_need_a_common_carrier(buckens, tmp_path, kind):
    """A wheel on a shaft to the ground, the other one on nothing but its teeth."""
    (tmp_path / "model.yaml").write_text("buckens: 1\nbodies:\n  a: {rigid: {mass: 1, inertia: [1, 1, 1]}}\n"
                                         "  b: {rigid: {mass: 1, inertia: [1, 1, 1]}, at: {position: [0.1, 0, 0]}}\n" +
                                         kind.replace("GEAR", "between: [a, b], axis: [0, 0, 1], teeth: [20, 40]"))
    buckens("check", "model.yaml").must(3, "\"g\": its gears have no common carrier", "connects \"a\" and \"b\"", "revolute")


ERRORS = {
    "one axis": ("axis: [1, 0, 0], teeth: [40, 20], stiffness: 1e6", ["load \"teeth\"", "on one axis", "side by side"]),
    "a ring as large": ("axis: [0, 0, 1], teeth: [20, 20], internal: on, stiffness: 1e6", ["both have 20"]),
    "steep": ("axis: [0, 0, 1], teeth: [20, 40], helix-angle: 80 deg, stiffness: 1e6",
              ["loads.teeth.elastic-gear.helix-angle", "at most 60 degrees, found 80 degrees"]),
    "rigid": ("axis: [0, 0, 1], teeth: [20, 40]", ["loads.teeth.elastic-gear", "stiffness"]),
    "negative play": ("axis: [0, 0, 1], teeth: [20, 40], stiffness: 1e6, backlash: -1 mm", ["backlash"]),
    "no axis": ("teeth: [20, 40], stiffness: 1e6", ["loads.teeth.elastic-gear", "axis"]),
}


@pytest.mark.parametrize("name", ERRORS)
def test_messages_say_what_is_wrong(buckens, tmp_path, name):
    fields, words = ERRORS[name]
    text = HELD.split("  teeth:")[0].replace("TORQUE", "0")
    text += f"  teeth: {{elastic-gear: {{between: [wheel, pinion], {fields}}}}}\nsimulation: {{duration: 1 s, step: 1 ms}}\n"
    (tmp_path / "model.yaml").write_text(text)
    result = buckens("check", "model.yaml")
    assert result.code in (2, 3), result.out + result.err
    for word in words:
        assert word in result.out + result.err, result.out + result.err
