# SPDX-License-Identifier: Apache-2.0
"""Friction in rigid contact: rolling, sliding, impacts with spin; exact motions, momenta, energy."""

import json
import math

import numpy
import pytest

G = 9.81

# Gravity of an incline of 30 degrees, its plane being the ground; solid spheres.
INCLINE = f"""
buckens: 1
gravity: [{G / 2}, 0, {-G * math.sqrt(3) / 2}]
bodies:
  rolls: {{rigid: {{mass: 1 kg, inertia: [4e-3, 4e-3, 4e-3]}}, at: {{position: [0, 0, 0.1]}}}}
  grips: {{rigid: {{mass: 2 kg, inertia: [8e-3, 8e-3, 8e-3]}}, at: {{position: [0, 1, 0.1]}}}}
  slips: {{rigid: {{mass: 1 kg, inertia: [4e-3, 4e-3, 4e-3]}}, at: {{position: [0, 2, 0.1]}}}}
  slides: {{rigid: {{mass: 3 kg, inertia: [12e-3, 12e-3, 12e-3]}}, at: {{position: [0, 3, 0.1]}}}}
loads:
  c1: {{contact: {{between: [ground, rolls], shapes: [{{plane: {{}}}}, {{sphere: 0.1}}], static: 0.2}}}}
  c2: {{contact: {{between: [grips, ground], shapes: [{{sphere: 0.1}}, {{plane: {{}}}}], static: 0.16496}}}}
  c3: {{contact: {{between: [ground, slips], shapes: [{{plane: {{}}}}, {{sphere: 0.1}}], static: 0.16495}}}}
  c4: {{contact: {{between: [ground, slides], shapes: [{{plane: {{}}}}, {{sphere: 0.1}}], static: 0.05}}}}
simulation: {{duration: 2 s, step: 5 ms}}
output:
  every: 20 ms
  sensors:
    rolls: {{position: rolls}}
    turns: {{angular-velocity: rolls}}
    grips: {{position: grips}}
    slips: {{position: slips}}
    slides: {{position: slides}}
    spins: {{angular-velocity: slides}}
    holds: {{contact: c1}}
    rubs: {{contact: c4}}
    lost: {{energy: dissipated}}
    balance: {{energy: balance}}
"""


def test_spheres_on_an_incline_roll_or_slide(sensors):
    out = sensors(INCLINE)
    t, slope, weight = out["t"], G / 2, G * math.sqrt(3) / 2
    # Above 2/7 tan 30 = 0.16495722 a sphere rolls with 5/7 of the slope.
    for name in ("rolls.x", "grips.x"):
        assert out[name] == pytest.approx(0.5 * 3.50357142857 * t**2, abs=1e-10)
    assert out["turns.y"] == pytest.approx(35.0357142857 * t, abs=1e-9)
    assert out["holds.friction"][1:] == pytest.approx(2 / 7 * slope, rel=1e-9)
    assert out["holds.normal"][1:] == pytest.approx(weight, rel=1e-9)
    # Below, friction is what there is.
    assert out["slips.x"] == pytest.approx(0.5 * (slope - 0.16495 * weight) * t**2, abs=1e-9)
    assert out["slips.x"][-1] > out["rolls.x"][-1] + 1e-5
    assert out["slides.x"] == pytest.approx(0.5 * (slope - 0.05 * weight) * t**2, abs=1e-9)
    assert out["spins.y"] == pytest.approx(0.05 * weight * 2.5 / 0.1 * t, abs=1e-8)
    assert out["rubs.friction"][1:] == pytest.approx(0.05 * 3 * weight, rel=1e-9)
    # What is lost is friction times slip.
    slip = slope - 3.5 * 0.05 * weight
    little = slope - 3.5 * 0.16495 * weight
    lost = 0.5 * t**2 * (0.05 * 3 * weight * slip + 0.16495 * weight * little)
    assert out["lost"] == pytest.approx(lost, abs=1e-5)
    assert numpy.abs(out["balance"]).max() < 1e-5


BILLIARDS = """
buckens: 1
gravity: [0, 0, -9.81]
bodies: {ball: {rigid: {mass: 0.17 kg, inertia: [6.12e-5, 6.12e-5, 6.12e-5]}, at: {position: [0, 0, 30 mm]}}}
loads: {cloth: {contact: {between: [ground, ball], shapes: [{plane: {}}, {sphere: 30 mm}], static: 0.2}}}
initial: {bodies: {ball: {velocity: VELOCITY, angular-velocity: SPIN}}}
simulation: {duration: 1.2 s, step: STEP}
output: {every: 10 ms, sensors: {p: {position: ball}, v: {velocity: ball}, w: {angular-velocity: ball}, c: {contact: cloth}, lost: {energy: dissipated}, balance: {energy: balance}}}
"""


@pytest.mark.parametrize("velocity, spin, accuracy", [
    ([2, 0, 0], [0, -60, 0], 1e-9),    # backspin
    ([1, 0, 0], [0, -200, 0], 1e-9),   # so much of it that it comes back
    # Massé: it curves, and the spin about the normal stays. As the axis turns, so does the error of second order in it.
    ([1.5, 0.5, 0], [40, -30, 20], 1e-5),
])
def test_a_ball_with_spin_slides_until_it_rolls(sensors, velocity, spin, accuracy):
    out = sensors(BILLIARDS.replace("VELOCITY", str(velocity)).replace("SPIN", str(spin)).replace("STEP", "1 ms"))
    t, radius, mu = out["t"], 0.03, 0.2
    v, w = numpy.array(velocity[:2], float), numpy.array(spin, float)
    slip = v + radius * numpy.array([-w[1], w[0]])  # v + w x (-R z)
    u = slip / numpy.linalg.norm(slip)
    end = 2 * numpy.linalg.norm(slip) / (7 * mu * G)  # until 7/2 mu g t has stopped the slip
    assert 0.1 < end < 1.1
    rolling = v - 2 / 7 * slip
    path = numpy.where(t[:, None] < end, v * t[:, None] - 0.5 * mu * G * u * t[:, None] ** 2,
                       v * end - 0.5 * mu * G * u * end**2 + rolling * (t[:, None] - end))
    found = numpy.stack([out["p.x"], out["p.y"]], axis=1)
    # Exact while it slides; the step in which it begins to roll moves it by up to mu g h^2.
    assert numpy.abs(found - path)[t < end - 2e-3].max() < accuracy
    assert numpy.abs(found - path).max() < max(2 * mu * G * 1e-3**2, 10 * accuracy)
    assert [out["v.x"][-1], out["v.y"][-1]] == pytest.approx(rolling, abs=15 * accuracy)
    assert out["w.z"] == pytest.approx(numpy.full(len(t), w[2]), abs=1e3 * accuracy)
    assert out["c.friction"][(t > 0) & (t < end - 2e-3)] == pytest.approx(mu * 0.17 * G, rel=1e-9)
    assert numpy.abs(out["c.friction"][t > end + 2e-3]).max() < 1e-9
    # Friction takes the energy of the slip with the reduced mass 2/7 m.
    lost = 0.5 * 2 / 7 * 0.17 * slip @ slip
    assert out["lost"][-1] == pytest.approx(lost, rel=max(1e-4, 30 * accuracy))
    assert numpy.abs(out["balance"]).max() < max(1e-4, 30 * accuracy) * lost


BOUNCE = """
buckens: 1
gravity: [0, 0, GRAVITY]
bodies:
  grips: {rigid: {mass: 2 kg, inertia: [8e-3, 8e-3, 8e-3]}, at: {position: [0, 0, 0.35]}}
  slips: {rigid: {mass: 2 kg, inertia: [8e-3, 8e-3, 8e-3]}, at: {position: [0, 5, 0.35]}}
loads:
  c1: {contact: {between: [ground, grips], shapes: [{plane: {}}, {sphere: 0.1}], restitution: 0.7, static: 0.4}}
  c2: {contact: {between: [ground, slips], shapes: [{plane: {}}, {sphere: 0.1}], restitution: 0.7, static: 0.1}}
initial:
  bodies:
    grips: {velocity: [2, 1, -3], angular-velocity: [4, -5, 6]}
    slips: {velocity: [2, 1, -3], angular-velocity: [4, -5, 6]}
simulation: {duration: 0.2 s, step: 0.9 ms}
output: {every: 1.8 ms, sensors: {p1: {position: grips}, v1: {velocity: grips}, w1: {angular-velocity: grips}, p2: {position: slips}, v2: {velocity: slips}, w2: {angular-velocity: slips}, lost: {energy: dissipated}, balance: {energy: balance}}}
"""


@pytest.mark.parametrize("gravity", [0.0, 9.81])
def test_a_ball_with_spin_bounces_obliquely(sensors, gravity, tmp_path):
    out = sensors(BOUNCE.replace("GRAVITY", repr(-gravity)))
    m, radius, fall = 2, 0.1, 0.25
    speed = math.sqrt(9 + 2 * gravity * fall)
    instant = fall / 3 if gravity == 0 else (speed - 3) / gravity
    slip = numpy.array([2, 1.0]) + radius * numpy.array([5, 4.0])
    lost = 0
    after = out["t"] > instant
    for name, mu in (("1", 0.4), ("2", 0.1)):
        press = 1.7 * m * speed
        size = min(mu * press, 2 / 7 * m * numpy.linalg.norm(slip))
        assert (size == mu * press) == (mu == 0.1)
        along = -size * slip / numpy.linalg.norm(slip)
        v = numpy.array([2, 1]) + along / m
        # The torque (-R z) x P about the centre.
        w = numpy.array([4, -5]) + radius * numpy.array([along[1], -along[0]]) / 8e-3
        assert out[f"v{name}.x"][after] == pytest.approx(v[0], abs=1e-11)
        assert out[f"v{name}.y"][after] == pytest.approx(v[1], abs=1e-11)
        assert out[f"w{name}.x"][after] == pytest.approx(w[0], abs=1e-10)
        assert out[f"w{name}.y"][after] == pytest.approx(w[1], abs=1e-10)
        assert out[f"w{name}.z"][after] == pytest.approx(6, abs=1e-10)
        since = out["t"][after] - instant
        assert out[f"v{name}.z"][after] == pytest.approx(0.7 * speed - gravity * since, abs=1e-10)
        assert out[f"p{name}.x"][after] == pytest.approx(2 * instant + v[0] * since, abs=1e-10)
        assert out[f"p{name}.z"][after] == pytest.approx(0.1 + 0.7 * speed * since - gravity / 2 * since**2, abs=1e-10)
        lost += 0.5 * m * speed**2 * (1 - 0.49) - along @ (slip + along * 3.5 / m / 2)
    assert out["lost"][-1] == pytest.approx(lost, rel=1e-10)
    measures = json.loads((tmp_path / "out" / "summary.json").read_text())["measures"]
    assert measures["impacts"] == 2 and measures["impact_loss"] == pytest.approx(lost, rel=1e-10)
    assert numpy.abs(out["balance"]).max() < 1e-10


KNOCK = """
buckens: 1
bodies:
  a: {rigid: {mass: 1 kg, inertia: [6.4e-4, 6.4e-4, 6.4e-4]}, at: {position: [-1, 0.06, 0.01]}}
  b: {rigid: {mass: 3 kg, inertia: [4.32e-3, 4.32e-3, 4.32e-3]}}
loads: {knock: {contact: {between: [a, b], shapes: [{sphere: 40 mm}, {sphere: 60 mm}], restitution: 0.7, static: MU}}}
initial: {bodies: {a: {velocity: [2, 0, 0], angular-velocity: [3, 8, -20]}, b: {angular-velocity: [5, -7, 10]}}}
simulation: {duration: 1 s, step: 0.3 ms}
output: {every: 10 ms, sensors: {pa: {position: a}, pb: {position: b}, va: {velocity: a}, vb: {velocity: b}, wa: {angular-velocity: a}, wb: {angular-velocity: b}, lost: {energy: dissipated}, balance: {energy: balance}}}
"""


@pytest.mark.parametrize("mu, sticks", [(0.05, False), (0.9, True)])
def test_rough_rigid_spheres_strike_each_other(sensors, mu, sticks):
    out = sensors(KNOCK.replace("MU", repr(mu)))

    def all_of(name):
        return numpy.stack([out[f"{name}.{axis}"] for axis in "xyz"], axis=1)

    linear = all_of("va") + 3 * all_of("vb")
    assert linear == pytest.approx(numpy.tile([2, 0, 0], (len(linear), 1)), abs=1e-12)
    spin = (numpy.cross(all_of("pa"), all_of("va")) + 3 * numpy.cross(all_of("pb"), all_of("vb"))
            + 6.4e-4 * all_of("wa") + 4.32e-3 * all_of("wb"))
    # Kept by the impulses; the place of the impact within the step is known to second order.
    assert spin == pytest.approx(numpy.tile(spin[0], (len(spin), 1)), abs=1e-6)
    # The impact by hand: n from a to b as they touch.
    y, z = 0.06, 0.01
    n = numpy.array([math.sqrt(0.01 - y * y - z * z), -y, -z]) / 0.1
    va, wa, wb = numpy.array([2, 0, 0.0]), numpy.array([3, 8, -20.0]), numpy.array([5, -7, 10.0])
    v = numpy.cross(wb, -0.06 * n) - va - numpy.cross(wa, 0.04 * n)  # of b over a
    along = v - n * (v @ n)
    press = 1.7 * (va @ n) * 0.75
    size = min(mu * press, 2 / 7 * 0.75 * numpy.linalg.norm(along))
    assert (size < mu * press) == sticks
    P = press * n - size * along / numpy.linalg.norm(along)  # on b
    assert all_of("va")[-1] == pytest.approx(va - P, abs=2e-5)
    assert all_of("vb")[-1] == pytest.approx(P / 3, abs=2e-5)
    assert all_of("wa")[-1] == pytest.approx(wa - numpy.cross(0.04 * n, P) / 6.4e-4, abs=5e-3)
    assert all_of("wb")[-1] == pytest.approx(wb + numpy.cross(-0.06 * n, P) / 4.32e-3, abs=2e-3)
    assert numpy.abs(out["balance"]).max() < 1e-6 * out["lost"][-1]


BOWL = """
buckens: 1
planar: zx
gravity: [0, 0, -9.81]
bodies: {ball: {rigid: {mass: 1 kg, inertia: [0, 4e-3, 0]}, at: {position: [POSITION]}}}
loads: {bowl: {contact: {between: [ground, ball], shapes: [{SHAPE: 1}, {sphere: 0.1}], static: MU}}}
simulation: {duration: DURATION, step: STEP}
output: {every: EVERY, sensors: {p: {position: ball}, v: {velocity: ball}, w: {angular-velocity: ball}, c: {contact: bowl}, lost: {energy: dissipated}, balance: {energy: balance}}}
"""


@pytest.mark.parametrize("shape", ["socket", "bore"])
def test_a_ball_rolls_in_a_bowl(sensors, shape):
    """Planar. 7/10 m v^2 is what it has fallen by, and N, f follow from the path."""
    errors = []
    for step in ("4 ms", "2 ms"):
        out = sensors(BOWL.replace("POSITION", '"0.9*sin(pi/3)", 0, "-0.9*cos(pi/3)"').replace("SHAPE", shape)
                      .replace("MU", "0.8").replace("DURATION", "2 s").replace("STEP", step).replace("EVERY", "20 ms"))
        speed = numpy.hypot(out["v.x"], out["v.z"])
        fallen = -0.45 - out["p.z"]
        late = out["t"] > 0
        # Put down on the curve to second order of the first step, which the next one closes.
        assert numpy.hypot(out["p.x"], out["p.z"]) == pytest.approx(0.9, abs=2e-9)
        errors.append(numpy.abs(0.7 * speed**2 - G * fallen).max())
        # It turns against its way along the bowl.
        assert numpy.abs(out["w.y"]) == pytest.approx(speed / 0.1, abs=1e-9)
        sine, cosine = out["p.x"] / 0.9, -out["p.z"] / 0.9
        assert out["c.friction"][late] == pytest.approx(2 / 7 * G * numpy.abs(sine)[late], abs=3e-3)
        assert out["c.normal"][late] == pytest.approx((G * cosine + speed**2 / 0.9)[late], abs=3e-3)
        assert abs(out["lost"][-1]) < 1e-4
    assert errors[1] < 1e-4
    assert errors[0] / errors[1] == pytest.approx(4, abs=0.5)


def test_a_ball_rolls_off_a_ball_and_slips(sensors):
    """From 10 degrees off the top it rolls until 2 sin a = mu (17 cos a - 10 cos a0), and then slips."""
    mu, start = 0.6, math.radians(10)
    out = sensors(BOWL.replace("POSITION", f'"1.1*sin({start})", 0, "1.1*cos({start})"').replace("SHAPE", "sphere")
                  .replace("MU", repr(mu)).replace("DURATION", "1.4 s").replace("STEP", "1 ms").replace("EVERY", "10 ms"))
    angle = numpy.arctan2(out["p.x"], out["p.z"])
    touches = out["c.normal"] > 0
    slips = touches & (out["c.friction"] > mu * out["c.normal"] * (1 - 1e-9))
    rolls = touches & ~slips & (out["t"] > 0)
    begin = min((a for a in numpy.linspace(0.3, 1, 70001)
                 if 2 * math.sin(a) >= mu * (17 * math.cos(a) - 10 * math.cos(start))))
    assert angle[rolls].max() < begin + 1e-3 and angle[slips].min() > begin - 1e-3
    assert rolls.sum() > 20 and slips.sum() > 2
    N = G * (17 * numpy.cos(angle) - 10 * math.cos(start)) / 7
    assert out["c.normal"][rolls] == pytest.approx(N[rolls], abs=2e-3)
    assert out["c.friction"][rolls] == pytest.approx(2 / 7 * G * numpy.sin(angle)[rolls], abs=2e-3)
    assert out["lost"][-1] > 0 and out["c.normal"][-1] == 0  # it has flown off
    assert numpy.abs(out["balance"]).max() < 1e-3 * out["lost"][-1] + 1e-4


def test_step_control_goes_through_friction(sensors):
    text = BILLIARDS.replace("VELOCITY", "[2, 0, 0.5]").replace("SPIN", "[0, -100, 0]")
    fixed = sensors(text.replace("STEP", "0.1 ms"))
    adapted = sensors(text.replace("STEP", "2 ms, tolerance: 1e-5"))
    for name in ("p.x", "v.x", "w.y"):
        assert adapted[name][-1] == pytest.approx(fixed[name][-1], abs=5e-5 if name != "w.y" else 5e-3)
    assert numpy.abs(adapted["balance"]).max() < 1e-3 * adapted["lost"][-1]


BEAM = """
buckens: 1
materials: {steel: {E: 210 GPa, nu: 0.3, rho: 7850}}
bodies:
  beam: {beam: {to: [1, 0, 0], elements: 12, section: {rectangle: {width: 20 mm, height: 20 mm}}, material: steel}, markers: {hit: {position: [0.75, 0, 0]}}}
  ball: {rigid: {mass: 0.5 kg, inertia: [1e-4, 1e-4, 1e-4]}, at: {position: [0.75, 0, 0.032]}}
loads: {knock: {contact: {between: [beam/hit, ball], shapes: [{plane: {}}, {sphere: 30 mm}], restitution: 0.5, static: 0.1}}}
initial: {bodies: {ball: {velocity: [3, 0.4, -2], angular-velocity: [0, 20, 0]}}}
simulation: {duration: 6 ms, step: 5 us}
output: {every: 20 us, sensors: {v: {velocity: ball}, w: {angular-velocity: ball}, beam: {velocity: beam}, strain: {energy: strain}, lost: {energy: dissipated}, balance: {energy: balance}, total: {energy: total}}}
"""


def test_a_spinning_ball_strikes_a_flexible_beam(sensors):
    out = sensors(BEAM)
    mass = 7850 * 0.02**2
    for axis, start in (("x", 1.5), ("y", 0.2), ("z", -1.0)):
        sum_ = mass * out[f"beam.{axis}"] + 0.5 * out[f"v.{axis}"]
        assert sum_ == pytest.approx(numpy.full(len(sum_), start), abs=1e-9)
    # It slides: friction against the slip, as much as the impulse across allows, and turns the ball. The beam bends
    # meanwhile and is hit again, so that its normal turns: a thousandth of 0.1.
    change = numpy.array([out["v.x"][-1] - 3, out["v.y"][-1] - 0.4, out["v.z"][-1] + 2]) * 0.5
    assert numpy.hypot(change[0], change[1]) == pytest.approx(0.1 * change[2], rel=2e-3)
    assert out["w.y"][-1] - 20 == pytest.approx(-0.03 * change[0] / 1e-4, rel=1e-3)
    assert out["strain"].max() > 0 and out["lost"][-1] > 0.1
    # First order with meshes: 0.10, 0.014, 0.002 J at 10, 5 and 1 us.
    assert numpy.abs(out["balance"]).max() < 0.04 * out["lost"][-1]


@pytest.mark.parametrize("spec, words", [
    ("static: 0.1, dynamic: 0.2", ["dynamic", "exceeds static friction, 0.1"]),
    ("static: 0.2, dynamic: 0.1", ["stribeck-velocity", "missing"]),
    ("static: 0.2, tangential-stiffness: 1e5", ["tangential-stiffness", "rigid"]),
])
def test_wrong_friction_is_refused(buckens, tmp_path, spec, words):
    (tmp_path / "model.yaml").write_text(INCLINE.replace("static: 0.2}", spec + "}"))
    buckens("check", "model.yaml").must(2, "model.yaml:", *words)


def test_rigid_friction_needs_inertia(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(INCLINE.replace("[12e-3, 12e-3, 12e-3]", "[0, 0, 0]"))
    buckens("check", "model.yaml").must(3, 'friction turns body "slides"', "no rotary inertia")


@pytest.mark.parametrize("guide", ["prismatic: {between: [ground, ram], axis: [0, 0, 1]}", "cylindrical: {between: [ground, ram], axis: [0, 0, 1]}",
                                   "planar: {between: [ground, ram], axis: [1, 0, 0]}"])
@pytest.mark.parametrize("height", [0.1, 0.35])
def test_a_guided_body_strikes_and_rests_with_friction(sensors, guide, height):
    """A ram that cannot slip: friction has nothing to do, whether it lies there or falls."""
    out = sensors(f"""
buckens: 1
gravity: [0, 0, -9.81]
bodies: {{ram: {{rigid: {{mass: 2 kg, inertia: [4e-3, 4e-3, 4e-3]}}, at: {{position: [0, 0, {height}]}}}}}}
joints: {{guide: {{{guide}}}}}
loads: {{c: {{contact: {{between: [ground, ram], shapes: [{{plane: {{}}}}, {{sphere: 0.1}}], static: 0.3, restitution: 0.5}}}}}}
simulation: {{duration: 1.5 s, step: 1 ms}}
output: {{every: 50 ms, sensors: {{p: {{position: ram}}, c: {{contact: c}}, lost: {{energy: dissipated}}, balance: {{energy: balance}}}}}}
""")
    assert out["p.z"][-1] == pytest.approx(0.1, abs=1e-12)
    assert out["c.normal"][-1] == pytest.approx(2 * 9.81, rel=1e-9)
    assert out["lost"][-1] == pytest.approx(2 * 9.81 * (height - 0.1), abs=1e-9)
    assert abs(out["balance"]).max() < 1e-9


def test_a_stack_rests_from_the_start(sensors):
    """Spheres: those above are not struck by anything, but what strikes the floor presses them together."""
    out = sensors("""
buckens: 1
gravity: [0, 0, -9.81]
bodies:
  a: {rigid: {mass: 2 kg, inertia: [8e-3, 8e-3, 8e-3]}, at: {position: [0, 0, 0.1]}}
  b: {rigid: {mass: 1 kg, inertia: [4e-3, 4e-3, 4e-3]}, at: {position: [0, 0, 0.3]}}
  c: {rigid: {mass: 4 kg, inertia: [16e-3, 16e-3, 16e-3]}, at: {position: [0, 0, 0.5]}}
loads:
  floor: {contact: {between: [ground, a], shapes: [{plane: {}}, {sphere: 0.1}], static: 0.3}}
  ab: {contact: {between: [a, b], shapes: [{sphere: 0.1}, {sphere: 0.1}], static: 0.3}}
  bc: {contact: {between: [b, c], shapes: [{sphere: 0.1}, {sphere: 0.1}], static: 0.3}}
simulation: {duration: 20 ms, step: 2 ms}
output: {every: 2 ms, sensors: {a: {position: a}, b: {position: b}, c: {position: c}, f: {contact: floor}, ab: {contact: ab}, bc: {contact: bc}}}
""")
    for body, height, under, load in (("a", 0.1, "f", 7), ("b", 0.3, "ab", 5), ("c", 0.5, "bc", 4)):
        # Rounding may put one of them down a step later, and the next step closes what that opens.
        assert numpy.abs(out[f"{body}.z"] - height)[3:].max() < 1e-12
        assert out[f"{under}.normal"][3:] == pytest.approx(load * G, rel=1e-9)


PINNED = """
buckens: 1
gravity: [0, 0, -9.81]
bodies: {arm: {rigid: {mass: 1 kg, inertia: [0.01, 0.01, 0.01]}, at: {position: [0.4, 0, 0.12]}, markers: {pin: {position: [-0.4, 0, 0.45]}}}}
joints: {pin: {revolute: {between: [{ground: [0, 0, 0.57]}, arm/pin], axis: [0, 1, 0]}}}
loads: {c: {contact: {between: [ground, arm], shapes: [{plane: {}}, {sphere: 0.1}], restitution: 0.5, static: MU}}}
simulation: {duration: 0.3 s, step: 0.5 ms}
output: {every: 0.5 ms, sensors: {p: {position: arm}, v: {velocity: arm}, lost: {energy: dissipated}, balance: {energy: balance}}}
"""


@pytest.mark.parametrize("friction", [1.4, 0.9, 0.2])
def test_a_pendulum_that_friction_holds_does_not_bounce(sensors, tmp_path, friction):
    """It strikes with one way to move; beyond 0.7, the ratio of the arms about the pin, friction holds all that would part."""
    out = sensors(PINNED.replace("MU", str(friction)))
    struck = numpy.argmax(out["lost"] > 0)
    before = 9.81 * (0.12 - out["p.z"][struck])
    assert numpy.abs(out["balance"]).max() < 1e-3 * before
    told = json.loads((tmp_path / "out" / "summary.json").read_text())
    if friction < 0.7:
        assert 0.2 * before < out["lost"][struck] < 0.9 * before and out["v.z"][struck:].max() > 0.1
        assert "jammed_impacts" not in told["measures"] and not told["warnings"]
        return
    assert told["measures"]["jammed_impacts"] == 1
    assert "friction jammed" in told["warnings"][0] and "without a rebound" in told["warnings"][0]
    assert out["lost"][-1] == pytest.approx(9.81 * 0.02, rel=1e-2)  # it stops within half a step's way of the floor
    assert numpy.abs(out["v.z"][struck + 2:]).max() < 1e-9
