# SPDX-License-Identifier: Apache-2.0
"""Contact between bodies: Hertz, restitution, friction, rigid impacts, flexible bodies, messages."""

import math
import pathlib
import sys

import numpy
import pytest

from conftest import SOURCE

sys.path.insert(0, str(pathlib.Path(__file__).parent / "support"))
import bouncing_ball  # noqa: E402 (found after the path is set)

G = 9.81


def crossing(t, values, rising=True):
    """First instant at which the values pass zero, on the line between two records."""
    sign = 1 if rising else -1
    k = numpy.nonzero((sign * values[:-1] < 0) & (sign * values[1:] >= 0))[0][0]
    return t[k] - values[k] * (t[k + 1] - t[k]) / (values[k + 1] - values[k])


HERTZ = """
buckens: 1
bodies: {ball: {rigid: {mass: 0.5 kg, inertia: [1e-3, 1e-3, 1e-3]}, at: {position: [0, 0, 0.0501]}}}
loads: {bounce: {contact: {between: [ground, ball], shapes: [{plane: [0, 0, 1]}, {sphere: 50 mm}], modulus: [210 GPa, 70 GPa], poisson-ratio: [0.3, 0.33]}}}
initial: {bodies: {ball: {velocity: [0, 0, -1]}}}
simulation: {duration: 0.8 ms, step: STEP}
output: {every: STEP, sensors: {v: {velocity: ball}, c: {contact: bounce}, balance: {energy: balance}}}
"""


def test_a_ball_hits_a_plane_as_hertz_says(sensors):
    stiffness = 4 / 3 / ((1 - 0.3**2) / 210e9 + (1 - 0.33**2) / 70e9) * math.sqrt(0.05)
    depth = (5 * 0.5 / (4 * stiffness)) ** 0.4  # m v^2/2 = 2/5 K d^(5/2), v = 1 m/s
    lasts = depth * 2 * math.sqrt(math.pi) * math.gamma(1.4) / math.gamma(0.9)  # 2.943 d/v
    errors = []
    for step in ("2 us", "1 us"):
        out = sensors(HERTZ.replace("STEP", step))
        begins = crossing(out["t"], out["c.gap"], rising=False)
        assert begins == pytest.approx(0.1e-3, rel=1e-9)  # free flight is exact
        errors.append((crossing(out["t"], out["c.gap"]) - begins) / lasts - 1)
        k = out["c.normal"].argmax()
        top = out["c.normal"][k - 1:k + 2]
        peak = top[1] + (top[2] - top[0]) ** 2 / 16 / (top[1] - 0.5 * (top[0] + top[2]))  # vertex of a parabola
        assert peak == pytest.approx(stiffness * depth**1.5, rel=4e-3 if step == "2 us" else 1e-3)
        assert out["v.z"][-1] == pytest.approx(1, abs=2e-3 if step == "2 us" else 1e-3)
        assert numpy.abs(out["balance"]).max() < 5e-3 * 0.25
        assert (out["c.normal"] >= 0).all() and out["c.friction"].max() == 0
    # Second order, up to what the place of both kinks within their steps leaves to chance.
    assert abs(errors[0]) < 4e-3 and abs(errors[1]) < 0.5 * abs(errors[0]) + 2e-4


def test_restitution_is_that_of_the_model_file(sensors):
    """Twelve balls at once: six restitutions, linear and Hertzian."""
    wanted = [(e, n) for e in (0.01, 0.2, 0.4, 0.6, 0.8, 1.0) for n in (1, 1.5)]
    bodies = loads = starts = seen = ""
    for k, (e, n) in enumerate(wanted):
        bodies += f"  b{k}: {{rigid: {{mass: 1 kg, inertia: [1e-3, 1e-3, 1e-3]}}, at: {{position: [{k}, 0, 0.1001]}}}}\n"
        loads += (f"  c{k}: {{contact: {{between: [ground, b{k}], shapes: [{{plane: [0, 0, 1]}}, {{sphere: 0.1}}], "
                  f"stiffness: {1e6 if n == 1 else 1e8}, exponent: {n}, restitution: {e}}}}}\n")
        starts += f"b{k}: {{velocity: [0, 0, -1]}}, "
        seen += f"v{k}: {{velocity: {{of: b{k}, along: [0, 0, 1]}}}}, "
    out = sensors(f"buckens: 1\nbodies:\n{bodies}loads:\n{loads}initial: {{bodies: {{{starts}}}}}\n"
                  f"simulation: {{duration: 40 ms, step: 10 us}}\n"
                  f"output: {{every: 1 ms, sensors: {{{seen} lost: {{energy: dissipated}}, balance: {{energy: balance}}}}}}\n")
    for k, (e, n) in enumerate(wanted):
        assert out[f"v{k}"][-1] == pytest.approx(e, abs=1e-3), (e, n)
    lost = sum(0.5 * (1 - e * e) for e, _ in wanted)
    assert out["lost"][-1] == pytest.approx(lost, rel=2e-3)
    assert abs(out["balance"][-1]) < 2e-3 * lost


def test_equal_spheres_part_by_their_restitution(sensors):
    """Chrono's pairs of spheres (0.5 m, 1 kg, 1 m/s against each other, 200 kPa): it asks for 1e-3 of Hertz's law by moduli."""
    wanted = (0.25, 0.5, 0.75, 1.0)
    bodies = loads = starts = seen = ""
    for k, e in enumerate(wanted):
        for name, side in (("l", -1), ("r", 1)):
            bodies += f"  {name}{k}: {{rigid: {{mass: 1 kg, inertia: [0.1, 0.1, 0.1]}}, at: {{position: [{side * 0.501}, {2 * k}, 0]}}}}\n"
            starts += f"{name}{k}: {{velocity: [{-side}, 0, 0]}}, "
            seen += f"{name}{k}: {{velocity: {{of: {name}{k}, along: [1, 0, 0]}}}}, "
        loads += (f"  c{k}: {{contact: {{between: [l{k}, r{k}], shapes: [{{sphere: 0.5}}, {{sphere: 0.5}}], "
                  f"modulus: [200 kPa, 200 kPa], poisson-ratio: [0.3, 0.3], restitution: {e}}}}}\n")
    out = sensors(f"buckens: 1\nbodies:\n{bodies}loads:\n{loads}initial: {{bodies: {{{starts}}}}}\n"
                  f"simulation: {{duration: 60 ms, step: 20 us}}\n"
                  f"output: {{every: 1 ms, sensors: {{{seen} lost: {{energy: dissipated}}, balance: {{energy: balance}}}}}}\n")
    for k, e in enumerate(wanted):
        # Order two of 1200 steps in contact, up to what the place of both kinks within their steps leaves to chance.
        assert out[f"r{k}"][-1] == pytest.approx(e, abs=1e-4), e
        assert out[f"l{k}"][-1] == pytest.approx(-out[f"r{k}"][-1], abs=1e-12)
    assert out["lost"][-1] == pytest.approx(sum(1 - e * e for e in wanted), rel=1e-3)
    assert abs(out["balance"]).max() < 1e-3


# Gravity of an incline of 30 degrees, its plane being the ground.
INCLINE = f"""
buckens: 1
gravity: [{G / 2}, 0, {-G * math.sqrt(3) / 2}]
bodies:
  rolls: {{rigid: {{mass: 1 kg, inertia: [4e-3, 4e-3, 4e-3]}}, at: {{position: [0, 0, ZB]}}}}
  slips: {{rigid: {{mass: 1 kg, inertia: [4e-3, 4e-3, 4e-3]}}, at: {{position: [0, 1, ZB]}}}}
  drum: {{rigid: {{mass: 1 kg, inertia: [5e-3, 5e-3, 5e-3]}}, at: {{position: [0, 2, ZD]}}}}
  slides: {{rigid: {{mass: 1 kg, inertia: [4e-3, 4e-3, 4e-3]}}, at: {{position: [0, 3, ZX]}}}}
  sticks: {{rigid: {{mass: 1 kg, inertia: [4e-3, 4e-3, 4e-3]}}, at: {{position: [0, 4, ZX]}}}}
loads:
  c1: {{contact: {{between: [ground, rolls], shapes: [{{plane: {{}}}}, {{sphere: 0.1}}], stiffness: 1e6, static: 0.17}}}}
  c2: {{contact: {{between: [ground, slips], shapes: [{{plane: {{}}}}, {{sphere: 0.1}}], stiffness: 1e6, static: 0.1}}}}
  c3: {{contact: {{between: [drum, ground], shapes: [{{cylinder: {{radius: 0.1, length: 0.4, axis: [0, 1, 0]}}}}, {{plane: {{}}}}], stiffness: 5e5, static: 0.4}}}}
  c4: {{contact: {{between: [ground, slides], shapes: [{{plane: {{}}}}, {{box: [0.4, 0.2, 0.1]}}], stiffness: 1e6, static: 0.2, damping: 800}}}}
  c5: {{contact: {{between: [ground, sticks], shapes: [{{plane: {{}}}}, {{box: [0.4, 0.2, 0.1]}}], stiffness: 1e6, static: 0.6, damping: 800}}}}
simulation: {{duration: 2 s, step: 0.5 ms}}
output:
  every: 20 ms
  sensors:
    rolls: {{position: rolls}}
    turns: {{angular-velocity: rolls}}
    goes: {{velocity: rolls}}
    slips: {{position: slips}}
    spins: {{angular-velocity: slips}}
    drum: {{position: drum}}
    slides: {{velocity: slides}}
    sticks: {{position: sticks}}
    holds: {{contact: c5}}
    rubs: {{contact: c2}}
    lost: {{energy: dissipated}}
    balance: {{energy: balance}}
"""


def test_bodies_on_an_incline_roll_slip_and_stick(sensors):
    weight = G * math.sqrt(3) / 2
    text = INCLINE.replace("ZB", repr(0.1 - weight / 1e6)).replace("ZD", repr(0.1 - weight / 1e6)).replace("ZX", repr(0.05 - weight / 4e6))
    out = sensors(text)
    t, slope = out["t"], G / 2
    # A sphere rolls where friction exceeds 2/7 of the slope, 0.16496: a = 5/7 g sin; a cylinder with 2/3.
    # They roll about the middle of the overlap, 4e-5 of the radius inside: 2.4e-5 of the acceleration.
    assert out["rolls.x"][-1] == pytest.approx(0.5 * 5 / 7 * slope * 4, rel=4e-5)
    assert out["goes.x"][-1] == pytest.approx((0.1 - weight / 2e6) * out["turns.y"][-1], rel=1e-6)
    assert out["drum.x"][-1] == pytest.approx(0.5 * 2 / 3 * slope * 4, rel=4e-5)
    # Less friction: it slips, and is turned by what friction there is. That is there after 0.1 ms.
    assert out["slips.x"][-1] == pytest.approx(0.5 * (slope - 0.1 * weight) * 4, rel=1e-4)
    assert out["spins.y"][-1] == pytest.approx(0.1 * weight * 0.1 / 4e-3 * 2, rel=2e-4)
    assert out["rubs.normal"][-1] == pytest.approx(weight, rel=1e-6)
    assert out["rubs.friction"][-1] == pytest.approx(0.1 * weight, rel=1e-6)
    # A block: slides with g (sin - mu cos); held at 96 % of its limit it does not creep.
    late = t > 0.99
    a = numpy.polyfit(t[late], out["slides.x"][late], 1)[0]
    assert a == pytest.approx(slope - 0.2 * weight, rel=1e-4)
    moved = out["sticks.x"][late] - out["sticks.x"][late][0]
    assert numpy.abs(moved).max() < 1e-9 and numpy.abs(out["sticks.x"]).max() < 1e-4
    assert out["holds.friction"][-1] == pytest.approx(slope, rel=1e-6)
    assert numpy.abs(out["balance"]).max() < 1e-4 * out["lost"][-1]


def test_an_elastic_ball_bounces_lower_each_time(sensors):
    out = sensors("""
buckens: 1
gravity: [0, 0, -9.81]
planar: zx
bodies: {ball: {rigid: {mass: 1 kg, inertia: [0, 4e-3, 0]}, at: {position: [0, 0, 1.1]}}}
loads: {floor: {contact: {between: [ground, ball], shapes: [{plane: [0, 0, 1]}, {sphere: 0.1}], stiffness: 1e9, exponent: 1.5, restitution: 0.8}}}
simulation: {duration: 2 s, step: 10 us}
output: {every: 1 ms, sensors: {z: {position: ball}, balance: {energy: balance}}}
""")
    height = out["z.z"] - 0.1
    tops = [k for k in range(1, len(height) - 1) if height[k - 1] < height[k] >= height[k + 1]]
    # Heights fall with e^2; weight during the contact and the step that finds the speed of approach change little.
    for n, k in enumerate(tops[:2]):
        assert height[k] == pytest.approx(0.64 ** (n + 1), rel=3e-3)
    assert numpy.abs(out["balance"]).max() < 1e-2


def test_a_rigid_ball_bounces_exactly_until_it_rests(sensors):
    # Siconos' BouncingBallED: ends at 8.578949179 s.
    out = sensors("""
buckens: 1
gravity: [0, 0, -9.81]
bodies: {ball: {rigid: {mass: 2 kg, inertia: [1, 1, 1]}, at: {position: [0, 0, 1.25]}}}
loads: {floor: {contact: {between: [ball, ground], shapes: [{sphere: 0.25}, {plane: [0, 0, 1]}], restitution: 0.9, threshold: 1 mm/s}}}
simulation: {duration: 10 s, step: 5 ms}
output: {every: 50 ms, sensors: {p: {position: ball}, c: {contact: floor}, lost: {energy: dissipated}, balance: {energy: balance}}}
""")
    flying, resting = out["t"] < 8.5, out["t"] > 8.6
    exact = numpy.array([bouncing_ball.height(t, 0.9) for t in out["t"]])
    assert numpy.abs(out["p.z"] - 0.25 - exact)[flying].max() < 1e-9
    assert numpy.abs(out["c.gap"] - exact)[flying].max() < 1e-9
    assert out["c.normal"][resting] == pytest.approx(2 * G, rel=1e-12)
    assert out["lost"][-1] == pytest.approx(2 * G, rel=1e-12)
    assert numpy.abs(out["balance"]).max() < 1e-10


def test_rigid_spheres_strike_obliquely(sensors):
    # Frictionless: speeds along the line of centres change, those across stay.
    out = sensors("""
buckens: 1
bodies:
  a: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}, at: {position: [-1, 0.06, 0]}}
  b: {rigid: {mass: 3 kg, inertia: [1, 1, 1]}}
loads: {knock: {contact: {between: [a, b], shapes: [{sphere: 40 mm}, {sphere: 60 mm}], restitution: 0.7}}}
initial: {bodies: {a: {velocity: [2, 0, 0]}}}
simulation: {duration: 1 s, step: 0.3 ms}
output: {every: 10 ms, sensors: {a: {velocity: a}, b: {velocity: b}, lost: {energy: dissipated}, balance: {energy: balance}}}
""")
    n = numpy.array([0.8, -0.6])  # from a to b as they touch: 0.06 of 0.1 m apart across
    impulse = 1.7 * 2 * 0.8 / (1 + 1 / 3)
    va, vb = numpy.array([2, 0]) - impulse * n, impulse / 3 * n
    # The line of centres is that at the instant within the step, found to second order.
    assert [out["a.x"][-1], out["a.y"][-1]] == pytest.approx(va, abs=1e-5)
    assert [out["b.x"][-1], out["b.y"][-1]] == pytest.approx(vb, abs=1e-5)
    assert out["lost"][-1] == pytest.approx(0.5 * 0.75 * 1.6**2 * (1 - 0.49), rel=1e-5)
    assert numpy.abs(out["balance"]).max() < 1e-6


def test_rough_spheres_keep_their_momenta(sensors):
    out = sensors("""
buckens: 1
bodies:
  a: {rigid: {mass: 1 kg, inertia: [6e-4, 6e-4, 6e-4]}, at: {position: [-0.09, 0.06, 0]}}
  b: {rigid: {mass: 3 kg, inertia: [5e-3, 5e-3, 5e-3]}}
loads: {knock: {contact: {between: [a, b], shapes: [{sphere: 40 mm}, {sphere: 60 mm}], modulus: [100 GPa, 100 GPa], static: 0.1, restitution: 0.9}}}
initial: {bodies: {a: {velocity: [2, 0, 0], angular-velocity: [0, 0, 10]}}}
simulation: {duration: 8 ms, step: 1 us}
output: {every: 0.1 ms, sensors: {pa: {position: a}, pb: {position: b}, va: {velocity: a}, vb: {velocity: b}, wa: {angular-velocity: a}, wb: {angular-velocity: b}, lost: {energy: dissipated}, balance: {energy: balance}}}
""")
    linear = out["va.x"] + 3 * out["vb.x"], out["va.y"] + 3 * out["vb.y"]
    assert linear[0] == pytest.approx(numpy.full(len(linear[0]), 2), rel=1e-11)
    assert numpy.abs(linear[1]).max() < 1e-11
    spin = (out["pa.x"] * out["va.y"] - out["pa.y"] * out["va.x"]
            + 3 * (out["pb.x"] * out["vb.y"] - out["pb.y"] * out["vb.x"]) + 6e-4 * out["wa.z"] + 5e-3 * out["wb.z"])
    # Kept by the forces; the scheme rounds it within its steps at second order.
    assert numpy.abs(spin - spin[0]).max() < 1e-6 * abs(spin[0])
    # Coulomb: it slides throughout, so that the impulse along the surface is 0.1 of that across. The line of centres
    # turns by 0.003 meanwhile, a few per cent of 0.1.
    n = numpy.array([0.8, -0.6])
    change = numpy.array([out["va.x"][-1] - 2, out["va.y"][-1]])
    across = -change @ n
    assert abs(change @ [0.6, 0.8]) == pytest.approx(0.1 * across, rel=4e-2)
    assert across == pytest.approx(1.9 * 1.6 * 0.75, rel=5e-3)
    assert out["lost"][-1] > 0
    assert numpy.abs(out["balance"]).max() < 1e-3 * out["lost"][-1]


BEAM = """
buckens: 1
materials: {steel: {E: 210 GPa, nu: 0.3, rho: 7850}}
bodies:
  beam: {beam: {to: [1, 0, 0], elements: 12, section: {rectangle: {width: 20 mm, height: 20 mm}}, material: steel}, markers: {hit: {position: [0.75, 0, 0]}}}
  ball: {rigid: {mass: 0.5 kg, inertia: [1e-4, 1e-4, 1e-4]}, at: {position: [0.75, 0, 0.0301]}}
loads: {knock: {contact: {between: [beam/hit, ball], shapes: [{plane: {}}, {sphere: 30.1 mm}], stiffness: 1e6, static: 0.3}}}
initial: {bodies: {ball: {velocity: [0.4, 0, -2]}}}
simulation: {duration: 6 ms, step: STEP}
output: {every: 20 us, sensors: {v: {velocity: ball}, c: {contact: knock}, beam: {velocity: beam}, w: {angular-velocity: ball}, strain: {energy: strain}, balance: {energy: balance}, total: {energy: total}}}
"""


def test_a_ball_hits_a_flexible_beam(sensors):
    mass = 7850 * 0.02**2
    runs = []
    for step in ("4 us", "2 us"):
        out = sensors(BEAM.replace("STEP", step))
        runs.append(out)
        # Linear momentum of both; the beam floats freely, its frame is at its mass centre.
        for axis, start in (("x", 0.5 * 0.4), ("z", -0.5 * 2)):
            sum_ = mass * out[f"beam.{axis}"] + 0.5 * out[f"v.{axis}"]
            assert sum_ == pytest.approx(numpy.full(len(sum_), start), rel=1e-9)
        assert out["strain"].max() > 0.05 * out["total"][0]  # the beam bends and rings
        assert numpy.abs(out["balance"]).max() < 5e-3 * out["total"][0]
    assert abs(runs[1]["balance"][-1]) < 0.5 * abs(runs[0]["balance"][-1]) + 1e-5
    force = runs[1]["c.normal"]
    assert numpy.abs(runs[0]["c.normal"] - force).max() < 2e-2 * force.max()
    assert (runs[1]["c.friction"] <= 0.3 * force + 1e-9 * force.max()).all() and runs[1]["c.friction"].max() > 0


def test_shapes_rest_as_they_must(sensors):
    """Resting forces and heights of several shapes, one of them a pin in a bore."""
    out = sensors("""
buckens: 1
gravity: [0, 0, -10]
bodies:
  capsule: {rigid: {mass: 1 kg, inertia: [1e-2, 1e-2, 1e-3]}, at: {position: [0, 0, 0.05]}}
  drum: {rigid: {mass: 1 kg, inertia: [1e-2, 1e-2, 1e-3]}, at: {position: [1, 0, 0.1]}}
  pin: {rigid: {mass: 1 kg, inertia: [1e-2, 1e-2, 1e-3]}, at: {position: [2, 0, 0]}}
  ball: {rigid: {mass: 1 kg, inertia: [1e-2, 1e-2, 1e-2]}, at: {position: [3, 0, 0]}}
  top: {rigid: {mass: 1 kg, inertia: [1e-2, 1e-2, 1e-2]}, at: {position: [4, 0, 0.2]}}
loads:
  c1: {contact: {between: [ground, capsule], shapes: [{plane: {}}, {capsule: {radius: 50 mm, length: 0.2, axis: [0, 1, 0]}}], stiffness: 1e5, damping: 300, static: 0.5}}
  c2: {contact: {between: [ground, drum], shapes: [{plane: {}}, {cylinder: {radius: 80 mm, length: 0.2}}], stiffness: 1e5, damping: 300, static: 0.5}}
  c3: {contact: {between: [{ground: [2, 0, 0]}, pin], shapes: [{bore: {radius: 21 mm, axis: [0, 1, 0]}}, {cylinder: {radius: 20 mm, length: 0.1, axis: [0, 1, 0]}}], stiffness: 1e5, damping: 300, static: 0.5}}
  c4: {contact: {between: [{ground: [3, 0, 0]}, ball], shapes: [{socket: 60 mm}, {sphere: 55 mm}], stiffness: 1e5, damping: 300, static: 0.5}}
  c5: {contact: {between: [{ground: [4, 0, 0]}, top], shapes: [{box: [0.5, 0.5, 0.2]}, {sphere: 0.1}], stiffness: 1e5, damping: 300}}
simulation: {duration: 1.5 s, step: 0.2 ms}
output:
  every: 10 ms
  sensors: {s1: {contact: c1}, s2: {contact: c2}, s3: {contact: c3}, s4: {contact: c4}, s5: {contact: c5},
            p1: {position: capsule}, p2: {position: drum}, p3: {position: pin}, p4: {position: ball}, p5: {position: top}}
""")
    for k, points in ((1, 2), (2, 4), (3, 2), (4, 1), (5, 1)):  # where they stand on
        assert out[f"s{k}.normal"][-1] == pytest.approx(10, rel=1e-6)
        assert out[f"s{k}.gap"][-1] == pytest.approx(-10 / points / 1e5, rel=1e-6)
        assert out[f"s{k}.friction"][-1] < 1e-6
    assert out["p3.z"][-1] == pytest.approx(-1e-3 - 5e-5, rel=1e-6)
    assert out["p4.z"][-1] == pytest.approx(-5e-3 - 1e-4, rel=1e-6)
    assert out["p5.z"][-1] == pytest.approx(0.2 - 1e-4, rel=1e-6)


def test_a_beam_starts_on_its_prop(sensors):
    # Statics know contact: 3/8 of the weight on a prop of stiffness K, and nothing moves afterwards.
    out = sensors("""
buckens: 1
gravity: [0, 0, -9.81]
materials: {steel: {E: 210 GPa, nu: 0.3, rho: 7850}}
bodies:
  beam: {beam: {to: [1, 0, 0], elements: 8, section: {rectangle: {width: 20 mm, height: 5 mm}}, material: steel}}
joints: {root: {fixed: {between: [ground, beam/start]}}}
loads: {prop: {contact: {between: [{ground: [1, 0, -0.001]}, beam/end], shapes: [{plane: {}}, {sphere: 1 mm}], stiffness: 1e6, static: 0.3}}}
initial: {start: static}
simulation: {duration: 10 ms, step: 0.1 ms}
output: {every: 1 ms, sensors: {c: {contact: prop}, balance: {energy: balance}}}
""")
    bending = 210e9 * 0.02 * 0.005**3 / 12
    reaction = 3 / 8 * 7850 * 1e-4 * 9.81 / (1 + 3 * bending / 1e6)
    # Shear takes part by (h/L)^2, 2.5e-5.
    assert out["c.normal"] == pytest.approx(numpy.full(11, reaction), rel=5e-5)
    assert out["c.gap"] == pytest.approx(numpy.full(11, -reaction / 1e6), rel=5e-5)
    assert out["c.friction"].max() < 1e-7 and numpy.abs(out["balance"]).max() < 1e-12


def test_the_dumbbell_comes_to_rest(sensors):
    text = (SOURCE / "examples" / "bouncing_dumbbell/bouncing_dumbbell").with_suffix(".yaml").read_text()
    out = sensors(text)
    # Free fall until the left ball strikes: its share of the rod's bending is nothing then.
    falling = out["t"] < 0.305
    assert out["left.y"][falling] == pytest.approx(0.5 - G / 2 * out["t"][falling] ** 2, abs=1e-9)
    # At rest: each ball carries half of the weight, friction holds both against each other.
    rod = 7850 * math.pi * 0.004**2 * 0.4
    for side in ("left", "right"):
        assert out[f"hit_{side}.normal"][-1] == pytest.approx((1 + rod) / 2 * G, rel=1e-3)
    assert out["hit_left.friction"][-1] == pytest.approx(out["hit_right.friction"][-1], rel=1e-3)
    # All of the energy of the fall is lost, but for the deflection at rest.
    fall = (1 + rod) * G * (0.5 + 0.2 * math.sin(math.radians(25)) - 0.04)
    assert out["lost"][-1] == pytest.approx(fall, rel=2e-3)
    assert numpy.abs(out["balance"]).max() < 2e-3 * fall


def test_a_worn_bearing_strikes(sensors):
    text = (SOURCE / "examples" / "clearance_slider_crank/clearance_slider_crank").with_suffix(".yaml").read_text()
    out = sensors(text.replace("duration: 24 ms", "duration: 3 ms"))
    away = numpy.hypot(out["path.x"], out["path.y"])
    # The pin flies within its clearance of 0.2 mm and presses into the bore where it touches.
    assert out["hit.gap"] == pytest.approx(0.2e-3 - away, abs=1e-9)
    touching = out["hit.gap"] < 0
    assert (out["hit.normal"][touching] >= 0).all() and (out["hit.normal"][~touching] == 0).all()
    assert 0.3 < touching.mean() < 0.95
    assert out["hit.normal"].max() == pytest.approx(14.8e3, rel=0.02)  # the first strike, see the README
    # The slider follows the ideal mechanism within clearance and overlap over the obliquity of the rod.
    angle = 5000 * 2 * math.pi / 60 * out["t"]
    ideal = 0.05 * numpy.cos(angle) + numpy.sqrt(0.12**2 - (0.05 * numpy.sin(angle)) ** 2)
    assert numpy.abs(out["slider.x"] - ideal).max() < 0.4e-3
    assert numpy.abs(out["balance"]).max() < 5e-3


CONTACT = """
buckens: 1
BODIES
loads: {c: {contact: {between: [ground, ball], SPEC}}}
simulation: {duration: 1 s, step: 1 ms}
"""
BALL = "bodies: {ball: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}, at: {position: [0, 0, 0.1]}}}"
PLANE = "shapes: [{plane: {}}, {sphere: 0.1}]"


@pytest.mark.parametrize(("bodies", "spec", "words"), [
    (BALL, "shapes: [{plane: {}}, {plane: {}}]", ["a plane and a plane cannot touch", "plane–sphere"]),
    (BALL, "shapes: [{bore: 50 mm}, {capsule: {radius: 10 mm, length: 0.1}}], stiffness: 1e5", ["a bore and a capsule cannot touch", "box–cylinder"]),
    (BALL, "shapes: [{box: [1, 1, 0.1]}, {cylinder: {radius: 10 mm, length: 0.1}}], stiffness: 1e5, exponent: 1.5", ["a box and a cylinder share a volume", "remove `exponent`"]),
    (BALL, "shapes: [{box: [1, 1, 0.1]}, {cylinder: {radius: 10 mm, length: 0.1}}], exponent: 1.5", ["without `stiffness` or `modulus` the contact is rigid"]),
    (BALL, "shapes: [{socket: 5 mm}, {sphere: 0.1}]", ["0.1 m does not fit into the socket of 0.005 m"]),
    (BALL, "shapes: [{plane: [0, 0, 0]}, {sphere: 0.1}]", ["a normal cannot be [0, 0, 0]"]),
    (BALL, PLANE + ", damping: 3", ["without `stiffness` or `modulus` the contact is rigid"]),
    (BALL, PLANE + ", restitution: 1.2", ["expected 0 to 1, found 1.2", "a rebound cannot be faster"]),
    (BALL, PLANE + ", stiffness: 1e5, restitution: 0", ["0.01", "found 0"]),
    (BALL, PLANE + ", stiffness: 1e5, modulus: [1 GPa, 1 GPa]", ["remove one of them"]),
    (BALL, "shapes: [{plane: {}}, {box: 0.1}], stiffness: 1e5", ["a list of 3 values"]),
    (BALL, "shapes: [{plane: {}}, {box: [0.1, 0.1, 0.1]}], modulus: [1 GPa, 1 GPa]", ["Hertz's theory gives no force between a plane and a box"]),
    (BALL, PLANE + ", stiffness: 1e5, static: 0.2, dynamic: 0.3", ["swap `static` and `dynamic`"]),
    (BALL, PLANE + ", stiffness: 1e5, static: 0.3, dynamic: 0.2", ["stribeck-velocity"]),
    (BALL, PLANE + ", stiffness: 1e5, tangential-stiffness: 1e4", ["requires `static` friction", "add `static`"]),
    (BALL, "shapes: [{plane: {}}, {sphere: 0.2}]", ["overlap by 0.1 m as placed", "turn the plane's normal"]),
    ("planar: xy\n" + BALL, PLANE, ["in a planar model the normal of a plane lies in the plane", "give the `normal`"]),
    ("planar: xy\n" + BALL, "shapes: [{sphere: 0.1}, {sphere: 0.1}]", ["0.1 m apart in the direction normal to the plane"]),
])
def test_wrong_contacts_are_refused(buckens, tmp_path, bodies, spec, words):
    (tmp_path / "model.yaml").write_text(CONTACT.replace("BODIES", bodies).replace("SPEC", spec))
    buckens("check", "model.yaml").must(2, "model.yaml:", *words)


def test_friction_needs_inertia(buckens, tmp_path):
    text = CONTACT.replace("BODIES", BALL.replace("[1, 1, 1]", "[0, 0, 0]"))
    (tmp_path / "model.yaml").write_text(text.replace("SPEC", PLANE + ", stiffness: 1e5, static: 0.3"))
    buckens("check", "model.yaml").must(3, "model.yaml:4", "friction turns body \"ball\"", "no rotary inertia")


def test_a_rigid_box_needs_inertia(buckens, tmp_path):
    text = CONTACT.replace("BODIES", BALL.replace("[1, 1, 1]", "[0, 0, 0]"))
    (tmp_path / "model.yaml").write_text(text.replace("SPEC", "shapes: [{plane: {}}, {box: [0.1, 0.1, 0.1]}]"))
    buckens("check", "model.yaml").must(3, "model.yaml:4", "the contact turns body \"ball\"", "no rotary inertia")


def test_a_sensor_of_no_contact_is_refused(buckens, tmp_path):
    text = CONTACT.replace("BODIES", BALL).replace("SPEC", PLANE) + "output: {sensors: {s: {contact: x}}}"
    (tmp_path / "model.yaml").write_text(text)
    buckens("check", "model.yaml").must(2, "there is no contact \"x\"", "c")


def test_painleves_rod_jams_and_jumps(sensors):
    """A rod pushed along a rough floor: the floor's force turns it into the floor, whatever the force is (Painleve 1895)."""
    angle, friction, stiffness = math.radians(50), 2, 1e6
    out = sensors(f"""
buckens: 1
planar: xy
gravity: [0, -{G}, 0]
bodies:
  rod:
    rigid: {{mass: 1 kg, inertia: [0, 0, "1/3"]}}
    at: {{position: ["-cos(50*pi/180)", "sin(50*pi/180) + 1e-3 - 4e-6", 0], orientation: {{axis: [0, 0, 1], angle: -50 deg}}}}
    markers: {{tip: {{position: [1, 0, 0]}}}}
loads:
  floor: {{contact: {{between: [ground, rod/tip], shapes: [{{plane: [0, 1, 0]}}, {{sphere: 1 mm}}], stiffness: {stiffness}, static: {friction}}}}}
initial: {{bodies: {{rod: {{velocity: [2, 0, 0]}}}}}}
simulation: {{duration: 0.3 s, step: 0.05 ms}}
output: {{every: 0.2 ms, sensors: {{tip: {{position: rod/tip}}, v: {{velocity: rod/tip}}, c: {{contact: floor}}, lost: {{energy: dissipated}}, balance: {{energy: balance}}}}}}
""")
    # While it slides, the overlap has d'' = g - A N with A < 0: no equilibrium, and N grows with cosh(sqrt(-A k) t).
    A = 1 + 3 * math.cos(angle) * (math.cos(angle) - friction * math.sin(angle))
    assert A < -0.7
    early = out["t"] < 1.1e-3
    grows = (4 - G / A) * numpy.cosh(math.sqrt(-A * stiffness) * out["t"][early]) + G / A
    assert out["c.normal"][early] == pytest.approx(grows, rel=2e-3)  # the rod turns meanwhile, by 1e-3 rad
    # Some 600 N stop the tip within 6 ms, sixty times the weight; the rod jumps, and comes down again.
    k = out["c.normal"].argmax()
    assert 5e-3 < out["t"][k] < 6e-3 and out["c.normal"][k] > 500 and out["v.x"][k] < 0
    assert 0.025 < out["tip.y"].max() < 0.032
    # First order in the step where it sticks at once: 2e-3 J with a fifth of the step; 2 J at the start.
    assert numpy.abs(out["balance"]).max() < 0.012
