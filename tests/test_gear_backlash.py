# SPDX-License-Identifier: Apache-2.0
"""Rigid gears and racks with backlash: free ways, blows, reversals, equilibria and modes against closed forms, and stiff teeth."""

import json
import math

import h5py
import numpy
import pytest

COS = math.cos(math.radians(20))

# Two wheels on fixed shafts whose rims weigh the same, J/r² = 0.1 kg; pitch circles of 50 and 100 mm.
PAIR = """
buckens: 1
planar: xy
bodies:
  small: {rigid: {mass: 1 kg, inertia: [0, 0, 2.5e-4]}}
  large: {rigid: {mass: 1 kg, inertia: [0, 0, 1e-3]}, at: {position: [0.15, 0, 0]}}
joints:
  a: {revolute: {between: [ground, small]}}
  b: {revolute: {between: [{ground: [0.15, 0, 0]}, large]}}
  mesh: {gear: {between: [small, large], teeth: [20, 40], backlash: 1 mm, restitution: E}}
loads: {on_small: {torque: {on: small, value: [0, 0, TORQUE]}}}
initial: {bodies: {small: {angular-velocity: [0, 0, SPEED]}}}
simulation: {duration: 20 ms, step: STEP}
output:
  every: 0.1 ms
  sensors: {small: {joint-coordinate: a}, large: {joint-coordinate: b}, mesh: {gear: mesh}, lost: {energy: dissipated},
            balance: {energy: balance}, total: {energy: total}, bearing: {joint-force: a}}
"""


def pair(e="0", torque="0", speed="0", step="0.1 ms"):
    return PAIR.replace("E}", f"{e}}}", 1).replace("TORQUE", torque).replace("SPEED", speed).replace("STEP", step)


def rims(times, v, e, play):
    """Where both rims are, and their speeds: from the middle of the play at v and 0, with equal masses."""
    out = []
    for t in times:
        x, y, u, w, now = 0.0, 0.0, v, 0.0, 0.0
        while True:
            gap = play / 2 - (x - y) if u > w else play / 2 + (x - y)
            wait = gap / abs(u - w) if u != w else math.inf
            if now + wait >= t:
                break
            now += wait
            x, y = x + u * wait, y + w * wait
            mean, half = (u + w) / 2, (u - w) / 2
            u, w = mean - e * half, mean + e * half
        out.append((x + u * (t - now), y + w * (t - now), u, w))
    return numpy.array(out).T


@pytest.mark.parametrize("e, blows", [("1", 9), ("0.6", 4)])
def test_rims_rattle_as_their_blows_say(sensors, e, blows):
    """Free between flanks; every blow keeps the momentum of the rims and takes 1 - e² of what moves them apart."""
    out = sensors(pair(e=e, speed="10"))
    x, y, u, w = rims(out["t"], 0.5, float(e), 1e-3)
    # Without forces the instants of blows are exact in any step: rounding.
    assert 0.05 * out["small.value"] == pytest.approx(x, abs=1e-12)
    assert -0.1 * out["large.value"] == pytest.approx(y, abs=1e-12)
    assert 0.05 * out["small.rate"] == pytest.approx(u, abs=1e-10)
    assert -0.1 * out["large.rate"] == pytest.approx(w, abs=1e-10)
    energy = 0.05 * (u**2 + w**2)
    assert out["lost"] == pytest.approx(energy[0] - energy, abs=1e-12)
    assert numpy.abs(out["balance"]).max() < 1e-13
    assert numpy.count_nonzero(numpy.abs(numpy.diff(u)) > 1e-6) >= blows
    assert out["mesh.play"] == pytest.approx(x - y, abs=1e-12)
    assert numpy.abs(out["mesh.play"]).max() <= 0.5e-3 + 1e-12
    assert numpy.abs(out["mesh.force"]).max() == 0.0  # blows are impulses


@pytest.mark.parametrize("sign", [1, -1])
def test_torque_passes_once_teeth_have_met(sensors, sign):
    """Half of the play at T/J, a blow without rebound, then both together; the flank that carries pushes the bearings."""
    out = sensors(pair(torque=str(sign * 0.23)))
    t = out["t"]
    a = 0.23 / 2.5e-4 * 0.05  # of the rim [m/s²]
    met = math.sqrt(2 * 0.5e-3 / a)
    free = t <= met
    assert 5 < free.sum() < len(t) - 50
    way = numpy.where(free, 0.5 * a * t**2, 0.5e-3 + a * met / 2 * (t - met) + 0.25 * a * (t - met) ** 2)
    # Constant forces: parabolas, in which impacts are found exactly; what stays in contact is there at the end of the step.
    late = t > met + 1e-4
    for seen in (free, late):
        assert sign * 0.05 * out["small.value"][seen] == pytest.approx(way[seen], abs=1e-11)
        assert sign * -0.1 * out["large.value"][seen] == pytest.approx(numpy.where(free, 0, way - 0.5e-3)[seen], abs=1e-11)
    assert (out["mesh.force"] == 0)[free].all()
    # One half of the torque accelerates each rim.
    tangential = 0.5 * 0.23 / 0.05
    assert sign * out["mesh.force"][late] == pytest.approx(numpy.full(late.sum(), tangential / COS), rel=1e-9)
    # The bearing holds the small wheel against the push of the large one: away from it, whichever flank carries.
    assert out["bearing.x"][late] == pytest.approx(numpy.full(late.sum(), tangential * math.tan(math.radians(20))), rel=1e-9)
    assert sign * out["bearing.y"][late] == pytest.approx(numpy.full(late.sum(), tangential), rel=1e-9)
    assert sign * out["mesh.play"][late] == pytest.approx(numpy.full(late.sum(), 0.5e-3), abs=1e-12)
    # Half of the energy of the one rim is lost where it takes the other along.
    # What rests at the end of the step in which it strikes takes the speed there: to m (a h)²/2.
    within = 0.5 * 0.1 * (a * 0.1e-3) ** 2
    assert out["lost"][-1] == pytest.approx(0.25 * 0.1 * (a * met) ** 2, abs=within)
    assert numpy.abs(out["balance"]).max() < within
    assert numpy.abs(out["balance"][free]).max() < 1e-15


def test_a_reversal_crosses_the_play(sensors):
    """The torque turns round at 10 ms: the small rim leaves its flank at once and crosses 1 mm, while the other one goes on."""
    text = pair().replace("simulation: {duration: 20 ms", "simulation: {duration: 30 ms")
    text = text.replace("loads:", "signals: {s: {setting: 1}, now: \"t - 0.01\"}\nevents: {turn: {when: now, set: {s: -1}}}\nloads:")
    text = text.replace("torque: {on: small, value: [0, 0, 0]}", "hinge-motor: {joint: a, torque: \"0.23*s\"}")
    out = sensors(text)
    t = out["t"]
    a = 46.0
    met = math.sqrt(2 * 0.5e-3 / a)
    # Events are found to a part of the step: when this one was, the speed of the other rim tells, which it keeps.
    speed = -0.1 * out["large.rate"][105]
    turned = met + 2 * (speed - a * met / 2) / a
    assert turned == pytest.approx(0.01, abs=0.1e-3 / 8)
    crossed = turned + math.sqrt(2 * 1e-3 / a)
    between = (t > turned + 1e-12) & (t < crossed)  # the event may lie at a record, which shows the force before it
    assert between.sum() > 60
    assert out["mesh.play"][between] == pytest.approx(0.5e-3 - 0.5 * a * (t[between] - turned) ** 2, abs=1e-11)
    assert -0.1 * out["large.rate"][between] == pytest.approx(numpy.full(between.sum(), speed), abs=1e-11)
    assert (out["mesh.force"][between] == 0).all()
    after = t > crossed + 1e-4
    assert out["mesh.play"][after] == pytest.approx(numpy.full(after.sum(), -0.5e-3), abs=1e-12)
    tangential = 0.5 * 0.23 / 0.05
    assert out["mesh.force"][after] == pytest.approx(numpy.full(after.sum(), -tangential / COS), rel=1e-9)
    # The bearing is pushed the same way by the other flank.
    assert out["bearing.x"][after] == pytest.approx(numpy.full(after.sum(), tangential * math.tan(math.radians(20))), rel=1e-9)
    assert numpy.abs(out["balance"]).max() < 0.5 * 0.1 * (a * 0.1e-3) ** 2  # m (a h)²/2, from the steps of both blows


def test_stiff_elastic_teeth_come_to_the_same(sensors):
    """They bring rims back by a blow of π √(m/k) instead of none: behind by that, the square root of what they give."""
    rigid = sensors(pair(e="1", speed="10").replace("duration: 20 ms", "duration: 2 ms"))
    behind = []
    for k, step in ((1e8, "0.5 us"), (1e10, "0.05 us")):
        text = pair(e="1", speed="10", step=step).replace("duration: 20 ms", "duration: 2 ms").replace("step: " + step, f"step: {step}, method: newmark")
        text = text.replace("  mesh: {gear: {between: [small, large], teeth: [20, 40], backlash: 1 mm, restitution: 1}}\n", "")
        text = text.replace("loads: {", f"loads: {{mesh: {{elastic-gear: {{between: [small, large], teeth: [20, 40], stiffness: {k:g}, backlash: 1 mm}}}}, ")
        out = sensors(text)
        blow = math.pi * math.sqrt(0.05 / (k * COS**2))
        late = rigid["t"] > 1.5e-3
        lag = (0.05 * (out["small.value"] - rigid["small.value"]) + 0.1 * (out["large.value"] - rigid["large.value"]))[late]
        # (ω h)² of the blow's length, and where in a step it begins.
        assert lag == pytest.approx(numpy.full(late.sum(), 0.5 * blow), rel=0.02)
        behind.append(lag.mean())
    assert behind[0] / behind[1] == pytest.approx(10, rel=0.02)


HELD = """
buckens: 1
bodies:
  wheel: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}}
  pinion: {rigid: {mass: 1 kg, inertia: [1, 1, 0.2]}, at: {position: [6, 0, 0]}}
joints:
  far: {fixed: {between: [ground, wheel]}}
  near: {revolute: {between: [{ground: [6, 0, 0]}, pinion], axis: [0, 0, 1]}}
  teeth: {gear: {between: [wheel, pinion], axis: [0, 0, 1], teeth: [40, 20], helix-angle: 10 deg, backlash: 4 mm}}
loads: {twist: {torque: {on: pinion, value: [0, 0, TORQUE]}}}
simulation: {duration: 20 ms, step: 1 ms}
output:
  every: 1 ms
  sensors: {turn: {joint-coordinate: near}, bearing: {joint-force: near}, teeth: {gear: teeth}, balance: {energy: balance}}
"""


@pytest.mark.parametrize("start", ["", "initial: {start: static}\n"])
@pytest.mark.parametrize("sign", [1, -1])
def test_helical_teeth_carry_on_the_flank_that_the_torque_closes(sensors, sign, start):
    """chrono, utest_CH_gears: radii 4 and 2 m, 1000 N m: 184.7925, 500 and 88.1635 N; in motion, and from the equilibrium."""
    out = sensors(HELD.replace("TORQUE", str(sign * 1000)).replace("simulation:", start + "simulation:"))
    assert sign * out["turn.value"][-1] == pytest.approx(0.5 * 4e-3 / 2, rel=1e-9)
    assert out["bearing.x"][-1] == pytest.approx(-184.7925, abs=5e-5)
    assert out["bearing.y"][-1] == pytest.approx(-sign * 500, rel=1e-9)
    assert abs(out["bearing.z"][-1]) == pytest.approx(88.1635, abs=5e-5)
    # The wheel with 40 teeth is first.
    assert out["teeth.force"][-1] == pytest.approx(sign * 500 / COS / math.cos(math.radians(10)), rel=1e-9)
    if start:
        assert sign * out["turn.value"] == pytest.approx(numpy.full(21, 1e-3), rel=1e-9)
        assert abs(out["bearing.z"]) == pytest.approx(numpy.full(21, 88.1635), abs=5e-5)


def test_an_open_mesh_without_torque_stays_where_it_is(buckens, sensors, tmp_path):
    """Within the play nothing holds the pinion: the equilibrium is told not to be the only one."""
    out = sensors(HELD.replace("TORQUE", "0").replace("simulation:", "initial: {start: static}\nsimulation:"))
    assert numpy.abs(out["turn.value"]).max() == 0.0 and numpy.abs(out["teeth.force"]).max() == 0.0
    told = buckens("check", "model.yaml").must(0)
    assert "the equilibrium is not unique: body \"pinion\"" in told.out + told.err


def test_teeth_with_play_are_drawn_as_one_gear(sensors, tmp_path):
    sensors(HELD.replace("TORQUE", "1"))
    with h5py.File(tmp_path / "out" / "results.h5", "r") as file:
        drawn = file["geometry/joints"]
        assert set(drawn) == {"far", "near", "teeth"}
        assert drawn["teeth"].attrs["type"] == "gear"
        assert [str(name) for name in drawn["teeth"].attrs["bodies"]] == ["wheel", "pinion"]


SPRUNG = """
buckens: 1
planar: xy
bodies:
  small: {rigid: {mass: 1 kg, inertia: [0, 0, 2.5e-4]}}
  large: {rigid: {mass: 1 kg, inertia: [0, 0, 1e-3]}, at: {position: [0.15, 0, 0]}}
joints:
  a: {revolute: {between: [ground, small]}}
  b: {revolute: {between: [{ground: [0.15, 0, 0]}, large]}}
  mesh: {gear: {between: [small, large], teeth: [20, 40]PLAY}}
loads:
  wind: {hinge-spring: {joint: a, stiffness: 2 N m/rad, angle: WOUND}}
  hold: {hinge-spring: {joint: b, stiffness: 30 N m/rad}}
simulation: {duration: 1 ms, step: 1 ms}
"""


def test_modes_about_an_equilibrium_hold_the_flank_that_carries(buckens, tmp_path):
    """Wound against each other the wheels vibrate as one; slack, each by itself."""
    def modes(play, wound):
        (tmp_path / "model.yaml").write_text(SPRUNG.replace("PLAY", play).replace("WOUND", wound))
        out = buckens("modes", "model.yaml", "--system", "--about", "static", "--count", 2, "--json").must(0).json["analyses"][0]
        return [mode["frequency"] * 2 * math.pi for mode in out["modes"]]

    together = math.sqrt((2 + 30 / 4) / (2.5e-4 + 1e-3 / 4))
    for wound in ("5 deg", "-5 deg"):
        assert modes(", backlash: 0.1 mm", wound) == pytest.approx([together], rel=1e-8)
    assert modes("", "5 deg") == pytest.approx([together], rel=1e-8)
    apart = sorted([math.sqrt(2 / 2.5e-4), math.sqrt(30 / 1e-3)])
    assert modes(", backlash: 0.1 mm", "0 deg") == pytest.approx(apart, rel=1e-8)


PLANETARY = """
buckens: 1
bodies:
  sun: {rigid: {mass: 1 kg, inertia: [0.02, 0.02, 0.02]}}
  arm: {rigid: {mass: 1 kg, inertia: [0.3, 0.3, 0.3]}, markers: {pin: {position: [0.2, 0, 0]}}}
  planet: {rigid: {mass: 2 kg, inertia: [0.01, 0.01, 0.01]}, at: {position: [0.2, 0, 0]}}
joints:
  sun_axle: {revolute: {between: [ground, sun], axis: [0, 0, 1]}}
  arm_axle: {revolute: {between: [ground, arm], axis: [0, 0, 1]}}
  planet_axle: {revolute: {between: [arm/pin, planet], axis: [0, 0, 1]}}
  inner: {gear: {between: [sun, planet], axis: [0, 0, 1], teeth: [20, 20], backlash: 0.2 mm}}
  outer: {gear: {between: [ground, planet], axis: [0, 0, 1], teeth: [60, 20], internal: on, backlash: 0.3 mm}}
loads: {on_sun: {torque: {on: sun, value: [0, 0, SIGN 3]}}}
simulation: {duration: 2 s, step: 2 ms}
output:
  every: 0.1 s
  sensors: {sun: {joint-coordinate: sun_axle}, arm: {joint-coordinate: arm_axle}, planet: {joint-coordinate: planet_axle},
            inner: {gear: inner}, outer: {gear: outer}, balance: {energy: balance}}
"""


@pytest.mark.parametrize("sign", ["", "-"])
def test_a_planetary_gear_drives_on_its_flanks(sensors, sign):
    """The ratios of Willis but for half of both plays, whatever the number of turns; no carrier is named."""
    out = sensors(PLANETARY.replace("SIGN ", sign))
    s = -1 if sign else 1
    late = out["t"] > 0.45
    assert abs(out["sun.value"][-1]) > 70  # more than ten turns
    inner = out["inner.play"][late]
    outer = out["outer.play"][late]
    assert numpy.abs(inner) == pytest.approx(numpy.full(late.sum(), 0.1e-3), abs=1e-10)
    assert numpy.abs(outer) == pytest.approx(numpy.full(late.sum(), 0.15e-3), abs=1e-10)
    # On pitch circles, against the arm: the sun of 0.1 m pushes the planet of 0.1 m, which rolls in the ring of 0.3 m.
    sun, arm, planet = (out[f"{name}.value"][late] for name in ("sun", "arm", "planet"))
    assert 0.1 * (sun - arm) + 0.1 * planet == pytest.approx(inner, abs=1e-10)
    assert -0.3 * arm - 0.1 * planet == pytest.approx(outer, abs=1e-10)
    # The arm is taken along: a quarter of the sun's speed. The sun has 3 N m less what accelerates it.
    inertia = 0.02 + (0.3 + 2 * 0.2**2) / 16 + 0.01 / 4
    acceleration = s * 3 / inertia
    tangential = (s * 3 - 0.02 * acceleration) / 0.1
    # As of the planetary gear without play, integrated to (w h)² on the planet's circle.
    assert out["inner.force"][late] * COS == pytest.approx(numpy.full(late.sum(), tangential), rel=2e-3)
    assert numpy.sign(out["outer.force"][late]) == pytest.approx(numpy.sign(outer))
    assert numpy.abs(out["balance"]).max() < 6e-2  # of 390 J, as without play


RACK = """
buckens: 1
bodies:
  pinion: {rigid: {mass: 1 kg, inertia: [0.05, 0.05, 0.05]}, at: {position: [0, 5, 0]}}
  rack: {rigid: {mass: 5 kg, inertia: [1, 1, 1]}, at: {position: [0, 4.9, 0]}}
joints:
  axle: {revolute: {between: [{ground: [0, 5, 0]}, pinion], axis: [0, 0, 1]}}
  bed: {prismatic: {between: [{ground: [0, 4.9, 0]}, rack], axis: [1, 0, 0]}}
  mesh: {rack: {between: [rack, pinion], axis: [0, 0, 1], along: [-1, 0, 0], radius: 100 mm, helix-angle: 8 deg, backlash: 2 mm, restitution: 0.5}}
initial: {bodies: {pinion: {angular-velocity: [0, 0, 4]}}}
simulation: {duration: 50 ms, step: 1 ms}
output:
  every: 1 ms
  sensors: {pinion: {joint-coordinate: axle}, rack: {joint-coordinate: bed}, mesh: {gear: mesh}, balance: {energy: balance}}
"""


def test_a_rack_has_play(sensors):
    """J/r² = 5 kg, as heavy as the rack: rims of equal mass again."""
    out = sensors(RACK)
    x, y, u, w = rims(out["t"], 0.4, 0.5, 2e-3)
    assert numpy.count_nonzero(numpy.abs(numpy.diff(u)) > 1e-6) >= 2
    assert 0.1 * out["pinion.value"] == pytest.approx(x, abs=1e-12)
    assert out["rack.value"] == pytest.approx(y, abs=1e-12)
    assert out["mesh.play"] == pytest.approx(x - y, abs=1e-12)
    assert numpy.abs(out["balance"]).max() < 1e-12


SHAFTS = """
buckens: 1
materials: {alu: {E: 70 GPa, nu: 0.3, rho: 2700 kg/m^3}}
sections: {s: {circle: {diameter: 20 mm}}}
bodies:
  one: {beam: {to: [0.5, 0, 0], elements: 4, section: s, material: alu}}
  two: {beam: {to: [0.5, 0, 0], elements: 4, section: s, material: alu}, at: {position: [0, 0.12, 0]}}
joints:
  a: {revolute: {between: [ground, one/start], axis: [1, 0, 0]}}
  b: {revolute: {between: [{ground: [0, 0.12, 0]}, two/start], axis: [1, 0, 0]}}
  c: {cylindrical: {between: [{ground: [0.5, 0, 0]}, one/end], axis: [1, 0, 0]}}
  d: {cylindrical: {between: [{ground: [0.5, 0.12, 0]}, two/end], axis: [1, 0, 0]}}
  mesh: {gear: {between: [one/mid, two/mid], axis: [1, 0, 0], teeth: [20, 20], helix-angle: 10 deg, backlash: 0.2 mm, restitution: RESTITUTION}}
initial: {bodies: {one: {angular-velocity: [2, 0, 0]}}}
simulation: {duration: 50 ms, step: 0.1 ms, rho-inf: 1}
output: {every: 1 ms, sensors: {balance: {energy: balance}, lost: {energy: dissipated}, E: {energy: total}, a: {joint-coordinate: a}, b: {joint-coordinate: b}, mesh: {gear: mesh}}}
"""


@pytest.mark.parametrize("restitution", [1, 0.5])
def test_flexible_shafts_rattle_without_other_losses(sensors, tmp_path, restitution):
    """Teeth at the middle of two beams that bend and twist: as of other rigid stops, blows take P (1 - e) v/2 and nothing else."""
    out = sensors(SHAFTS.replace("RESTITUTION", str(restitution)))
    measures = json.loads((tmp_path / "out" / "summary.json").read_text())["measures"]
    assert measures["impacts"] >= 5
    assert out["lost"][-1] == pytest.approx(measures["impact_loss"], abs=1e-15)
    assert abs(out["lost"][-1]) < 1e-15 if restitution == 1 else out["lost"][-1] > 0.2 * out["E"][0]
    # Taking flanks out of each other bends the shafts by a little: measured 1.6e-5 of the energy.
    assert numpy.abs(out["balance"]).max() < 5e-5 * out["E"][0]
    # What vibrates into a flank within a step is struck in the next one: at 2 rad/s and 60 mm, 12 um.
    assert numpy.abs(out["mesh.play"]).max() < 0.1e-3 + 2 * 0.06 * 0.1e-3
    # The other shaft is taken along.
    assert numpy.abs(out["b.value"]).max() > 1e-3


@pytest.mark.parametrize("text, whole, half, records", [
    (pair(e="0.6", torque="\"0.3*sin(700*t)\"", speed="10").replace("every: 0.1 ms", "every: 0.5 ms"), "20 ms", "10 ms", 41)])
def test_a_run_goes_on_bit_for_bit(goes_on, text, whole, half, records):
    goes_on(text.replace("duration: 20 ms", "duration: 0.02 s"), "0.02 s", "0.01 s", records)


def test_gears_stand_in_the_nearest_space(sensors):
    """Turned by five teeth and a little, at the start and for a hundred turns: the play is that of the space they stand in."""
    start = "initial: {joints: {a: {angle: \"5*2*pi/20 + 4e-3\", speed: 100}, b: {speed: -50}}}"
    text = pair().replace("initial: {bodies: {small: {angular-velocity: [0, 0, 0]}}}", start).replace("duration: 20 ms", "duration: 7 s").replace(
        "every: 0.1 ms", "every: 0.1 s").replace("step: 0.1 ms", "step: 2 ms")
    out = sensors(text)
    assert out["small.value"][-1] > 100 * 2 * math.pi
    # Rounding of a hundred turns.
    assert out["mesh.play"] == pytest.approx(numpy.full(71, 0.05 * 4e-3), abs=1e-12)


ERRORS = {
    "restitution without play": ("teeth: [20, 40], restitution: 0.3", 2, ["joints.mesh.gear.restitution", "without `backlash`", "0.1 mm"]),
    "threshold without play": ("teeth: [20, 40], threshold: 1 mm/s", 2, ["joints.mesh.gear.threshold", "without `backlash`"]),
    "gains": ("teeth: [20, 40], backlash: 1 mm, restitution: 1.2", 2, ["joints.mesh.gear.restitution", "0 to 1, found 1.2"]),
    "parts of teeth": ("teeth: [20, 40.5], backlash: 1 mm", 2, ["joints.mesh.gear.teeth", "whole numbers of teeth", "40.5"]),
    "negative": ("teeth: [20, 40], backlash: -1 mm", 2, ["joints.mesh.gear.backlash"]),
    "no teeth left": ("teeth: [20, 40], backlash: 8 mm", 3, ["joint \"mesh\"", "0.008 m", "more than a space", "0.00785"]),
}


@pytest.mark.parametrize("name", ERRORS)
def test_messages_say_what_is_wrong(buckens, tmp_path, name):
    fields, code, words = ERRORS[name]
    text = pair().replace("teeth: [20, 40], backlash: 1 mm, restitution: 0", fields).replace("mesh: {gear: mesh}, ", "")
    (tmp_path / "model.yaml").write_text(text)
    buckens("check", "model.yaml").must(code, *words)


@pytest.mark.parametrize("old, new, code, words", [
    ("mesh: {gear: mesh}", "mesh: {joint-force: mesh}", 2, ["\"mesh\" has `backlash`", "{gear: mesh}"]),
    ("loads:", "signals: {s: {joint-angle: mesh}}\nloads:", 2, ["joint \"mesh\" is a gear, which has no angle"]),
    ("loads:", "signals: {s: \"t - 1\"}\nevents: {e: {when: s, release: mesh}}\nloads:", 2, ["events.e", "\"mesh\" has `backlash`", "elastic-gear"]),
    ("loads:", "signals: {s: \"t - 1\"}\nevents: {e: {when: s, attach: mesh}}\nloads:", 2, ["events.e", "\"mesh\" has `backlash`", "elastic-gear"]),
    ("initial: {", "initial: {released: [mesh], ", 2, ["released", "\"mesh\" has `backlash`"]),
    ("mesh: {gear: mesh}", "mesh: {gear: mehs}", 2, ["no elastic-gear \"mehs\"", "mesh"]),
    (", backlash: 1 mm, restitution: 0", "", 2, ["\"mesh\" is a joint", "with rigid teeth and without `backlash`"]),
])
def test_what_play_does_not_admit_is_refused(buckens, tmp_path, old, new, code, words):
    assert old in pair()
    (tmp_path / "model.yaml").write_text(pair().replace(old, new, 1))
    buckens("check", "model.yaml").must(code, *words)


def test_teeth_that_start_on_teeth_are_refused(buckens, tmp_path):
    text = pair().replace("initial: {bodies: {small: {angular-velocity: [0, 0, 0]}}}", "initial: {joints: {a: {angle: 0.02}}}")
    (tmp_path / "model.yaml").write_text(text)
    # 0.05 m × 0.02 = 1 mm, half of it beyond the play, along the line of action.
    buckens("run", "model.yaml", "-o", "out").must(3, "joint \"mesh\"", f"{0.5e-3 * COS:.3g} m beyond the backlash", "elastic-gear")


def test_steps_become_shorter_where_teeth_pass_many_of_each_other(sensors, buckens, tmp_path):
    """20 m/s of the rims, 40 mm a step, at a pitch of 15.7 mm: blows are found all the same, in steps of a part of that."""
    out = sensors(pair(e="1", speed="400", step="2 ms").replace("every: 0.1 ms", "every: 2 ms"))
    # Momentum and energy of the rims, and teeth that stay in their space.
    assert 0.05 * out["small.rate"] - 0.1 * out["large.rate"] == pytest.approx(numpy.full(11, 20), abs=1e-9)
    assert numpy.abs(out["balance"]).max() < 1e-9 * out["total"][0]
    assert numpy.abs(0.05 * out["small.value"] + 0.1 * out["large.value"]).max() < 7.85e-3
    assert numpy.abs(0.1 * out["large.value"])[-1] > 0.1  # of 0.4 m that both go together
    (tmp_path / "model.yaml").write_text(pair(e="1", speed="4e9", step="2 ms"))
    buckens("run", "model.yaml", "-o", "fast").must(4, "joint \"mesh\"", "half of their pitch of 0.0148 m", "smaller `step`")


@pytest.mark.parametrize("method", ["newmark", "wilson"])
def test_methods_within_the_step_are_refused(buckens, tmp_path, method):
    (tmp_path / "model.yaml").write_text(pair(step=f"0.1 ms, method: {method}"))
    buckens("run", "model.yaml", "-o", "out").must(2, "joint \"mesh\" holds rigidly", "generalized-alpha", "`elastic-gear` in its place")


def test_gears_with_play_need_a_common_carrier(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text("""buckens: 1
bodies:
  a: {rigid: {mass: 1, inertia: [1, 1, 1]}}
  b: {rigid: {mass: 1, inertia: [1, 1, 1]}, at: {position: [0.1, 0, 0]}}
joints: {shaft: {revolute: {between: [ground, a], axis: [0, 0, 1]}}, g: {gear: {between: [a, b], axis: [0, 0, 1], teeth: [20, 40], backlash: 0.1 mm}}}
""")
    buckens("check", "model.yaml").must(3, "joint \"g\": its gears have no common carrier", "revolute")
