# SPDX-License-Identifier: Apache-2.0
"""Rigid contacts among many bodies: rows that come and go with the pairs that are near each other."""

import random

import numpy
import pytest

G = 9.81
BALL = "  {name}: {{rigid: {{mass: {m}, inertia: [{j}, {j}, {j}]}}, at: {{position: {at}}}}}\n"


def ball(name, at, m=0.5, r=0.05):
    return BALL.format(name=name, m=m, j=0.4 * m * r**2, at=list(at))


def model(bodies, loads, seen, duration="0.5 s", step="1 ms", gravity=(0, 0, -G), initial="{}", more="", every="10 ms"):
    return (f"buckens: 1\ngravity: {list(gravity)}\nbodies:\n{bodies}loads:\n{loads}{more}initial: {{bodies: {initial}}}\n"
            f"simulation: {{duration: {duration}, step: {step}}}\noutput: {{every: {every}, sensors: {{{seen}}}}}\n")


def same(sensors, bodies, group, pairs, seen, **more):
    """Runs both, and returns the group's results, which are those of its pairs."""
    together, apart = sensors(model(bodies, group, seen, **more)), sensors(model(bodies, pairs, seen, **more))
    for name in apart:
        # The same rows in another order: rounding, which blows spread a little.
        assert together[name] == pytest.approx(apart[name], rel=1e-9, abs=1e-10), name
    return together


LAW = "restitution: 0.6, static: 0.3"


def test_two_bodies_do_what_a_single_contact_does(sensors):
    """A ball with spin falls on a plane, bounces, rolls; a box slides down it and stops."""
    bodies = ball("b", [0, 0, 0.2]) + "  box: {rigid: {mass: 2, inertia: [0.01, 0.012, 0.015]}, at: {position: [1, 0, 0.05]}}\n"
    group = f"  g: {{contacts: {{among: [{{on: ground, plane: {{}}}}, {{on: b, sphere: 50 mm}}, {{on: box, box: [0.3, 0.2, 0.1]}}], {LAW}}}}}\n"
    pairs = (f"  f: {{contact: {{between: [ground, b], shapes: [{{plane: {{}}}}, {{sphere: 50 mm}}], {LAW}}}}}\n"
             f"  s: {{contact: {{between: [ground, box], shapes: [{{plane: {{}}}}, {{box: [0.3, 0.2, 0.1]}}], {LAW}}}}}\n")
    out = same(sensors, bodies, group, pairs, "p: {position: b}, w: {angular-velocity: b}, q: {position: box}, v: {velocity: box}, lost: {energy: dissipated}, balance: {energy: balance}",
               initial="{b: {velocity: [0.3, 0, 0], angular-velocity: [0, -20, 5]}, box: {velocity: [0.5, 0.2, 0]}}", duration="0.8 s")
    assert out["lost"][-1] > 0.5 and numpy.abs(out["balance"]).max() < 1e-3 * out["lost"][-1]
    assert out["p.z"][-1] == pytest.approx(0.05, abs=1e-9) and abs(out["v.x"][-1]) < 1e-9


def test_bodies_with_joints_and_events_are_struck_alike(sensors):
    """A pendulum swings against a row of two balls on the floor; then the group lets go of everything."""
    bodies = ball("bob", [-0.3, 0, 0.42], r=0.06) + ball("b0", [0.0, 0, 0.05]) + ball("b1", [0.1005, 0.004, 0.05])
    group = f"  g: {{contacts: {{among: [{{on: ground, plane: {{}}}}, {{bodies: \"b?\", sphere: 50 mm}}, {{on: bob, sphere: 60 mm}}], {LAW}}}}}\n"
    pairs = "".join(f"  f{b}: {{contact: {{between: [ground, {b}], shapes: [{{plane: {{}}}}, {{sphere: {r} mm}}], {LAW}}}}}\n" for b, r in (("bob", 60), ("b0", 50), ("b1", 50)))
    pairs += "".join(f"  {a}{b}: {{contact: {{between: [{a}, {b}], shapes: [{{sphere: {r} mm}}, {{sphere: 50 mm}}], {LAW}}}}}\n" for a, b, r in (("b0", "b1", 50), ("b0", "bob", 50), ("b1", "bob", 50))).replace("bob], shapes: [{sphere: 50 mm}, {sphere: 50 mm}]", "bob], shapes: [{sphere: 50 mm}, {sphere: 60 mm}]")
    more = "joints: {pin: {revolute: {between: [{ground: [0, 0, 0.42]}, bob/eye], axis: [0, 1, 0]}}}\nsignals: {late: t - 0.7}\nevents: {off: {when: late, switch-off: NAMES}}\n"
    bodies = bodies.replace("at: {position: [-0.3, 0, 0.42]}}", "at: {position: [-0.3, 0, 0.42]}, markers: {eye: {position: [0.3, 0, 0]}}}")
    seen = "bob: {position: bob}, a: {position: b0}, b: {position: b1}, pin: {joint-force: pin}, lost: {energy: dissipated}"
    names = "[fbob, fb0, fb1, b0b1, b0bob, b1bob]"
    together = sensors(model(bodies, group, seen, more=more.replace("NAMES", "[g]"), duration="0.8 s"))
    apart = sensors(model(bodies, pairs, seen, more=more.replace("NAMES", names), duration="0.8 s"))
    for name in apart:
        assert together[name] == pytest.approx(apart[name], rel=1e-8, abs=1e-9), name
    assert together["b.x"][-1] > 0.15 and together["lost"][-1] > 0.1
    assert together["a.z"][-1] < 0.02  # falls


def row(gap, count=5, m=0.1, r=0.01):
    return "".join(ball(f"b{k}", [k * (2 * r + gap), 0, 0], m, r) for k in range(count))


def strike(sensors, gap):
    seen = ", ".join(f"v{k}: {{velocity: b{k}}}" for k in range(5)) + ", kinetic: {energy: kinetic}"
    bodies = row(gap).replace(f"at: {{position: [{0.0}, 0, 0]}}", "at: {position: [-1 mm, 0, 0]}")
    out = sensors(model(bodies, "  g: {contacts: {among: [{bodies: \"b*\", sphere: 10 mm}], restitution: 1}}\n", seen,
                        gravity=(0, 0, 0), initial="{b0: {velocity: [1, 0, 0]}}", duration="10 ms", step="0.1 ms", every="1 ms"))
    assert out["kinetic"] == pytest.approx(0.05, rel=1e-12)
    return [out[f"v{k}.x"][-1] for k in range(5)]


def test_balls_with_gaps_hand_the_impulse_on(sensors):
    """Blows one after the other: each pair exchanges its velocities."""
    assert strike(sensors, 0.5e-3) == pytest.approx([0, 0, 0, 0, 1], abs=1e-12)


def test_balls_that_touch_are_one_body_in_the_blow(sensors):
    """At the same instant (I1) holds for all: what touches without approach stays together. One ball against four."""
    assert strike(sensors, 0.0) == pytest.approx([-0.6, 0.4, 0.4, 0.4, 0.4], abs=1e-12)


@pytest.mark.parametrize(("shape", "size", "friction"), [("sphere: 0.1", 0.2, 0), ("sphere: 0.1", 0.2, 0.4), ("box: [0.3, 0.3, 0.2]", 0.2, 0.4)])
def test_a_stack_carries_what_is_above(sensors, shape, size, friction):
    masses = [1.0, 2.0, 0.5, 3.0, 1.5]
    bodies = "".join(f"  b{k}: {{rigid: {{mass: {m}, inertia: [{0.01 * m}, {0.01 * m}, {0.01 * m}]}}, at: {{position: [0, 0, {(k + 0.5) * size}]}}}}\n" for k, m in enumerate(masses))
    loads = f"  g: {{contacts: {{among: [{{on: ground, plane: {{}}}}, {{bodies: \"b*\", {shape}}}], static: {friction}}}}}\n"
    seen = "g: {contact: g}, top: {position: b4}, balance: {energy: balance}"
    out = sensors(model(bodies, loads, seen, duration="0.1 s"))
    above = sum(sum(masses[k:]) for k in range(5)) * G
    assert out["g.normal"] == pytest.approx(above, rel=1e-9)
    assert out["g.touching"] == pytest.approx(5)
    assert numpy.abs(out["top.z"] - 4.5 * size).max() < 1e-12
    assert numpy.abs(out["top.x"]).max() < 1e-12
    assert numpy.abs(out["balance"]).max() < 1e-9


def cloud(count, seed, r=0.05):
    chance = random.Random(seed)
    side = int(count ** (1 / 3)) + 1
    places = [(i, j, k) for i in range(side) for j in range(side) for k in range(side)][:count]
    bodies = "".join(ball(f"b{n}", [round(2.6 * r * x + 0.3 * r * chance.random(), 6) for x in place], m=round(chance.uniform(0.3, 1), 3), r=r) for n, place in enumerate(places))
    speeds = ", ".join(f"b{n}: {{velocity: {[round(2 * (side / 2 - x) + chance.uniform(-1, 1), 3) for x in place]}, angular-velocity: {[round(chance.uniform(-9, 9), 3) for _ in range(3)]}}}" for n, place in enumerate(places))
    return bodies, "{" + speeds + "}"


@pytest.mark.parametrize(("law", "is_lossless"), [("restitution: 1", True), ("restitution: 0.5, static: 0.4", False)])
def test_free_balls_keep_their_momentum(sensors, law, is_lossless):
    """Thirty balls of different masses fly into each other."""
    bodies, speeds = cloud(30, 7)
    seen = "p: {momentum: {}}, kinetic: {energy: kinetic}, lost: {energy: dissipated}, balance: {energy: balance}"
    seen = ", ".join(f"v{k}: {{velocity: b{k}}}, x{k}: {{position: b{k}}}, w{k}: {{angular-velocity: b{k}}}" for k in range(30)) + ", " + seen.split("}, ", 2)[1] + "}, lost: {energy: dissipated}, balance: {energy: balance}"
    out = sensors(model(bodies, f"  g: {{contacts: {{among: [{{bodies: \"b*\", sphere: 50 mm}}], {law}}}}}\n", seen,
                        gravity=(0, 0, 0), initial=speeds, duration="0.25 s"))
    masses = [float(line.split("mass: ")[1].split(",")[0]) for line in bodies.splitlines()]
    total, spin, size = numpy.zeros((len(out["t"]), 3)), numpy.zeros((len(out["t"]), 3)), 0
    for k, m in enumerate(masses):
        v, x, w = (numpy.stack([out[f"{name}{k}.{axis}"] for axis in "xyz"], axis=1) for name in "vxw")
        total += m * v
        spin += m * numpy.cross(x, v) + 0.4 * m * 0.05**2 * w
        size += m * numpy.linalg.norm(v[0])
    assert numpy.abs(total - total[0]).max() < 1e-12 * size
    # Impulses act where bodies touched; what several of them in one step share is of the order of what they move in it.
    assert numpy.abs(spin - spin[0]).max() < 1e-3 * size
    if is_lossless:
        # Instants are those of cubics through gaps, which of balls that graze each other are no cubics.
        assert out["kinetic"] == pytest.approx(out["kinetic"][0], rel=1e-5)
    else:
        assert out["lost"][-1] > 0.1 * out["kinetic"][0]
        # Several blows on one body in a step share it; 0.2 % here.
        assert numpy.abs(out["balance"]).max() < 5e-3 * out["lost"][-1]


def heap(count, law, duration="0.6 s", step="1 ms"):
    walls = "".join(f", {{on: {{ground: {p}}}, plane: {n}}}" for p, n in (("[-0.2, 0, 0]", "[1, 0, 0]"), ("[0.2, 0, 0]", "[-1, 0, 0]"), ("[0, -0.2, 0]", "[0, 1, 0]"), ("[0, 0.2, 0]", "[0, -1, 0]")))
    bodies = "".join(ball(f"b{k}", [round((k % 9 % 3 - 1) * 0.11 + 0.002 * (k % 4), 6), round((k % 9 // 3 - 1) * 0.11 + 0.0015 * (k % 3), 6), round(0.06 + 0.11 * (k // 9), 6)]) for k in range(count))
    return model(bodies, f"  heap: {{contacts: {{among: [{{on: ground, plane: {{}}}}{walls}, {{bodies: \"b*\", sphere: 50 mm}}], {law}}}}}\n",
                 f"heap: {{contact: heap}}, balance: {{energy: balance}}, lost: {{energy: dissipated}}, kinetic: {{energy: kinetic}}, last: {{position: b{count - 1}}}",
                 duration=duration, step=step)


@pytest.mark.parametrize("law", ["restitution: 0.3", "restitution: 0.3, static: 0.3"])
def test_balls_fall_into_a_box(sensors, law):
    out = sensors(heap(12, law, "0.8 s"))
    # Twelve balls in two layers; the floor carries all at rest, and they are no deeper in it than rounding.
    assert out["lost"][-1] > 0.5
    assert numpy.abs(out["balance"]).max() < 0.02 * out["lost"][-1]
    if "static" in law:  # without friction balls slide to and fro
        assert out["kinetic"][-1] < 0.1 * out["kinetic"].max()
    assert out["heap.touching"][-1] >= 9
    assert out["last.z"].min() > 0.05 - 1e-6


def test_a_springy_beam_is_struck_alike(sensors):
    """A ball falls on the interface of a flexible beam, bounces, and rests there."""
    bodies = ("  beam: {beam: {from: [-0.5, 0, 0], to: [0.5, 0, 0], elements: 4, section: {rectangle: {width: 40 mm, height: 10 mm}}, material: steel}}\n"
              + ball("b", [0.01, 0, 0.08], r=0.05))
    more = ("materials: {steel: {E: 200 GPa, nu: 0.3, rho: 7850}}\njoints: {left: {fixed: {between: [{ground: [-0.5, 0, 0]}, beam/start]}}, right: {fixed: {between: [{ground: [0.5, 0, 0]}, beam/end]}}}\n")
    law = "restitution: 0.5"
    group = f"  g: {{contacts: {{among: [{{on: beam/mid, box: [0.3, 0.1, 0.02]}}, {{on: b, sphere: 50 mm}}], {law}}}}}\n"
    pair = f"  c: {{contact: {{between: [beam/mid, b], shapes: [{{box: [0.3, 0.1, 0.02]}}, {{sphere: 50 mm}}], {law}}}}}\n"
    out = same(sensors, bodies, group, pair, "p: {position: b}, mid: {position: beam/mid}, lost: {energy: dissipated}", more=more, duration="0.2 s", step="0.2 ms")
    assert out["lost"][-1] > 0.01 and out["mid.z"].min() < -1e-5


def test_a_run_that_goes_on_is_the_same(buckens, tmp_path):
    """Bit for bit, with pairs that came and went before and after."""
    text = heap(12, "restitution: 0.4, static: 0.3", "0.3 s")
    (tmp_path / "model.yaml").write_text(text)
    buckens("run", "model.yaml", "-o", "whole").must(0)
    buckens("run", "model.yaml", "-o", "part", "--set", "simulation.duration=0.15").must(0)
    buckens("run", "--continue", "part", "--until", "0.3").must(0)
    whole, part = ((tmp_path / run / "sensors.csv").read_text() for run in ("whole", "part"))
    assert part == whole


@pytest.mark.parametrize(("spec", "code", "words"), [
    ("among: [{bodies: \"b*\", sphere: 0.1}], damping: 3", 2, ["the contact is rigid, and this key has no effect"]),
    ("among: [{bodies: \"b*\", sphere: 0.1}], tangential-stiffness: 3e4, static: 0.3", 2, ["the contact is rigid"]),
    ("among: [{bodies: \"b*\", sphere: 0.2}], restitution: 0.3", 2, ["b0 and b1 overlap by 0.1 m as placed; place them apart"]),
    ("among: [{bodies: \"b*\", socket: 0.1}]", 2, ["a socket and a socket cannot touch", "`against`"]),
    ("among: [{bodies: \"x*\", sphere: 0.1}]", 2, ["there is no body \"x*\""]),
    ("among: [{bodies: \"b*\", cube: 0.1}]", 2, ["cube"]),
])
def test_wrong_contacts_are_refused(buckens, tmp_path, spec, code, words):
    bodies = ball("b0", [0, 0, 0.1]) + ball("b1", [0, 0, 0.4])
    (tmp_path / "model.yaml").write_text(model(bodies, f"  c: {{contacts: {{{spec}}}}}\n", ""))
    buckens("check", "model.yaml").must(code, "model.yaml:", *words)


def test_methods_that_hold_within_steps_are_refused(buckens, tmp_path):
    text = model(ball("b0", [0, 0, 0.05]), "  c: {contacts: {among: [{on: ground, plane: {}}, {bodies: \"b*\", sphere: 50 mm}]}}\n", "")
    (tmp_path / "newmark.yaml").write_text(text.replace("step: 1 ms", "step: 1 ms, method: newmark"))
    buckens("run", "newmark.yaml").must(2, "load \"c\" holds rigidly", "generalized-alpha")


def test_many_with_friction_are_warned_of(buckens, tmp_path):
    bodies = "".join(ball(f"b{k}", [round(0.2 * (k % 20), 3), round(0.2 * (k // 20), 3), 1]) for k in range(251))
    for law, is_told in (("static: 0.3", True), ("restitution: 0.3", False), ("static: 0.3, stiffness: 1e5", False)):
        (tmp_path / "model.yaml").write_text(model(bodies, f"  heap: {{contacts: {{among: [{{bodies: \"b*\", sphere: 50 mm}}], {law}}}}}\n", "", duration="1 ms"))
        said = buckens("run", "model.yaml", "-o", "out").must(0).err
        assert ("load \"heap\": 251 shapes without a stiffness, but with friction" in said) == is_told


def test_bricks_and_planks_in_the_plane_keep_their_energy(sensors):
    """Twelve bodies fall on each other between walls: corners at sides, none of which jumps to another side."""
    chance = random.Random(4)
    kinds = {"brick": ("box: [60 mm, 40 mm, 40 mm]", "67.2 g", "29.12"), "ball": ("sphere: 20 mm", "23.46 g", "3.753"), "plank": ("box: [100 mm, 40 mm, 20 mm]", "56 g", "48.53")}
    bodies = ""
    for k in range(12):
        kind = list(kinds)[k % 3]
        bodies += (
            f"  {kind}_{k}: {{rigid: {{mass: {kinds[kind][1]}, inertia: [0, {kinds[kind][2]} kg mm^2, 0]}}, at: {{position: [{chance.uniform(-40, 40)} mm, 0, {60 + 80 * k} mm], "
            f"orientation: {{axis: [0, 1, 0], angle: {chance.uniform(-90, 90)} deg}}}}}}\n"
        )
    walls = "".join(f"        - {{on: {{ground: [{x} mm, 0, 0]}}, plane: [{n}, 0, 0]}}\n" for x, n in ((-90, 1), (90, -1)))
    shapes = "".join(f'        - {{bodies: "{kind}_*", {shape}}}\n' for kind, (shape, _, _) in kinds.items())
    out = sensors(
        f"buckens: 1\nplanar: zx\ngravity: [0, 0, -9.81]\nbodies:\n{bodies}loads:\n  heap:\n    contacts:\n      among:\n        - {{on: ground, plane: [0, 0, 1]}}\n"
        f"{walls}{shapes}      restitution: 0.3\nsimulation: {{duration: 0.6 s, step: 0.5 ms}}\n"
        "output: {every: 5 ms, sensors: {lost: {energy: dissipated}, moving: {energy: kinetic}, balance: {energy: balance}}}\n"
    )
    assert out["lost"][-1] > 1.5
    # Blows that share a step have one instant: of first order in it, a twentieth of the loss here (theory 25 section 5).
    assert numpy.abs(out["balance"]).max() < 0.1 * out["lost"][-1]
