# SPDX-License-Identifier: Apache-2.0
"""Cylinders and capsules on boxes and on each other: resting, rolling, falling, in pairs and in groups."""

import math

import numpy
import pytest

G = 9.81
DRUM = "rigid: {mass: 2 kg, inertia: [7e-3, 7e-3, 1e-2]}"  # 0.1 in radius, 0.1 long
TABLE = "{ground: [0, 0, -0.5]}"


def segment(depth, radius=0.1):
    half = math.acos(1 - depth / radius)
    return radius**2 * (half - math.sin(half) * math.cos(half))


def depth_under(load, per_volume, length, radius=0.1):
    """Overlap of a lying cylinder whose segment carries a load, by halving."""
    low, high = 0.0, radius
    for _ in range(100):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if per_volume * length * segment(middle, radius) < load else (low, middle)
    return low


def on_table(gravity, at, law, axis="[0, 0, 1]", duration="0.5 s"):
    return f"""
buckens: 1
gravity: [{gravity[0]}, {gravity[1]}, {gravity[2]}]
bodies: {{drum: {{{DRUM if axis == "[0, 0, 1]" else "rigid: {mass: 2 kg, inertia: [7e-3, 1e-2, 7e-3]}"}, at: {{position: [0, 0, {at!r}]}}}}}}
loads: {{c: {{contact: {{between: [{TABLE}, drum], shapes: [{{box: [8, 2, 1]}}, {{cylinder: {{radius: 0.1, length: 0.1, axis: {axis}}}}}], stiffness: 1e6{law}}}}}}}
simulation: {{duration: {duration}, step: 1 ms}}
output: {{every: 20 ms, sensors: {{p: {{position: drum}}, w: {{angular-velocity: drum}}, c: {{contact: c}}, balance: {{energy: balance}}}}}}
"""


def test_a_cylinder_stands_on_four_springs(sensors):
    out = sensors(on_table((0, 0, -G), 0.05 - 2 * G / 4e6, ", damping: 1e3"))
    assert numpy.abs(out["p.z"] - out["p.z"][0]).max() < 1e-12
    assert out["c.normal"] == pytest.approx(2 * G, rel=1e-9)
    assert out["c.gap"][-1] == pytest.approx(-2 * G / 4e6, rel=1e-7)
    # Friction holds it where it is on a slope.
    slope = (G * math.sin(0.2), 0, -G * math.cos(0.2))
    out = sensors(on_table(slope, 0.05 - 2 * G / 4e6, ", damping: 1e3, static: 0.25"))
    late = out["t"] > 0.29
    assert numpy.abs(out["p.x"][late] - out["p.x"][late][0]).max() < 1e-8
    assert out["c.friction"][-1] == pytest.approx(2 * G * math.sin(0.2), rel=1e-5)


def test_a_cylinder_lies_and_rolls_on_a_box(sensors):
    per_volume = 4e6 / (math.pi * 0.1**2)
    depth = depth_under(2 * G, per_volume, 0.1)
    out = sensors(on_table((0, 0, -G), 0.1 - depth, "", axis="[0, 1, 0]"))
    assert numpy.abs(out["p.z"] - out["p.z"][0]).max() < 1e-10
    assert out["c.normal"][-1] == pytest.approx(2 * G, rel=1e-6)
    # Down a slope of 0.2 with 2/3 of its gravity, by m R^2/2; as on a plane it rolls about the middle of the overlap.
    depth = depth_under(2 * G * math.cos(0.2), per_volume, 0.1)
    out = sensors(on_table((G * math.sin(0.2), 0, -G * math.cos(0.2)), 0.1 - depth, ", static: 0.5", axis="[0, 1, 0]", duration="1 s"))
    assert out["p.x"][-1] == pytest.approx(0.5 * 2 / 3 * G * math.sin(0.2), rel=2e-3)
    assert numpy.abs(out["p.z"] - out["p.z"][0]).max() < 1e-7 and numpy.abs(out["p.y"]).max() < 1e-9


FALL = """
buckens: 1
gravity: [0, 0, -9.81]
bodies: {{body: {{rigid: {{mass: 2 kg, inertia: [{ix}, {iy}, {iz}]}}, at: {{position: [0.3, 0.2, {height}], orientation: {{axis: [{turn}], angle: {tilt} rad}}}}}}}}
loads: {{c: {{contact: {{between: [{table}, body], shapes: [{{box: [2, 1, 1]}}, {{{shape}}}], stiffness: 1e5}}}}}}
simulation: {{duration: {duration}, step: STEP}}
output: {{every: 2 ms, sensors: {{p: {{position: body}}, v: {{velocity: body}}, w: {{angular-velocity: body}}, c: {{contact: c}}, balance: {{energy: balance}}}}}}
"""
ROD = dict(ix=4e-3, iy=0.06, iz=0.06, shape="capsule: {radius: 50 mm, length: 0.6, axis: [1, 0, 0]}", table=TABLE)


def test_a_rod_falls_flat_on_a_box_and_comes_back(sensors):
    out = sensors(FALL.format(**ROD, turn="0, 1, 0", tilt=0, height=0.1, duration="0.3 s").replace("STEP", "0.1 ms"))
    # Both ends are springs of 1e5: it comes back as it was, level; deepest by energy.
    depth = 2 * G / 2e5
    deepest = depth + math.sqrt(depth**2 + 2 * depth * 0.05)
    assert out["c.gap"].min() == pytest.approx(-deepest, rel=2e-2)  # records are 2 ms apart
    assert numpy.abs(out["w.y"]).max() < 1e-9
    assert out["p.z"][100:].max() == pytest.approx(0.1, abs=2e-4)


@pytest.mark.parametrize("case", [
    dict(ROD, turn="0, 1, 0", tilt=0.1, height=0.14),
    dict(ix=7e-3, iy=7e-3, iz=1e-2, shape="cylinder: {radius: 0.1, length: 0.1}", table=TABLE, turn="0.6, 0.8, 0", tilt=0.3, height=0.12),
    dict(ROD, turn="0, 0, 1", tilt=0.5, height=0.1, table="{ground: [1.2, 0.1, -0.5]}"),  # over an edge
], ids=["rod", "rim", "edge"])
def test_energy_is_kept_with_the_order_of_the_step(sensors, case):
    """Frictionless falls, tilted and over an edge: what is lost vanishes with the step."""
    lost = []
    for step in ("0.4 ms", "0.1 ms"):
        out = sensors(FALL.format(**case, duration="0.3 s").replace("STEP", step))
        assert out["c.normal"].max() > 20
        assert numpy.abs(out["w.x"]).max() + numpy.abs(out["w.y"]).max() > 0.5
        lost.append(numpy.abs(out["balance"]).max())
    # Sixteen times less by order two; contact that begins and ends within steps leaves some of it to chance.
    assert lost[1] < 0.2 * lost[0] + 1e-5
    assert lost[1] < 1e-3  # of 1 J or more


def test_capsules_side_by_side_keep_momentum_and_energy(sensors):
    """They strike obliquely with their whole length, roll up on each other, and part."""
    rod = "rigid: {mass: 2 kg, inertia: [4e-3, 0.06, 0.06]}"
    text = f"""
buckens: 1
bodies:
  a: {{{rod}, at: {{position: [0, 0, 0]}}}}
  b: {{{rod}, at: {{position: [0.1, 0.02, 0.101], orientation: {{axis: [0, 1, 0], angle: 0.02 rad}}}}}}
loads: {{c: {{contact: {{between: [a, b], shapes: [{{capsule: {{radius: 50 mm, length: 0.6, axis: [1, 0, 0]}}}}, {{capsule: {{radius: 50 mm, length: 0.5, axis: [1, 0, 0]}}}}], stiffness: 1e5}}}}}}
initial: {{bodies: {{b: {{velocity: [0.2, 0, -1]}}}}}}
simulation: {{duration: 40 ms, step: STEP}}
output: {{every: 1 ms, sensors: {{a: {{velocity: a}}, b: {{velocity: b}}, pa: {{position: a}}, pb: {{position: b}}, wa: {{angular-velocity: a}}, wb: {{angular-velocity: b}}, c: {{contact: c}}, balance: {{energy: balance}}}}}}
"""
    lost = []
    for step in ("0.2 ms", "50 us"):
        out = sensors(text.replace("STEP", step))
        assert out["c.normal"].max() > 100 and out["c.normal"][-1] == 0
        for axis, start in (("x", 0.2), ("y", 0), ("z", -1)):
            assert out[f"a.{axis}"] + out[f"b.{axis}"] == pytest.approx(numpy.full(len(out["t"]), start), abs=1e-9)
        lost.append(numpy.abs(out["balance"]).max())
    assert lost[1] < 0.2 * lost[0] + 1e-6 and lost[1] < 1e-3


def test_solids_of_a_group_come_to_rest_on_each_other(sensors):
    """Drums on a table and on each other, rods across them and beside: found by themselves."""
    out = sensors(f"""
buckens: 1
gravity: [0, 0, -{G}]
bodies:
  lower: {{{DRUM}, at: {{position: [0, 0, 0.05]}}}}
  upper: {{{DRUM}, at: {{position: [0.02, 0, 0.15]}}}}
  top: {{rigid: {{mass: 1 kg, inertia: [1e-3, 1e-2, 1e-2]}}, at: {{position: [0.02, 0, 0.22], orientation: {{axis: [0, 0, 1], angle: 0.5 rad}}}}}}
  rod: {{rigid: {{mass: 1 kg, inertia: [1e-3, 1e-2, 1e-2]}}, at: {{position: [0.3, 0.3, 0.02]}}}}
loads: {{heap: {{contacts: {{among: [{{on: {TABLE}, box: [2, 2, 1]}}, {{bodies: [lower, upper], cylinder: {{radius: 0.1, length: 0.1}}}}, {{bodies: [top, rod], capsule: {{radius: 20 mm, length: 0.12, axis: [1, 0, 0]}}}}], stiffness: 1e6, damping: 500, static: 0.4}}}}}}
simulation: {{duration: 0.3 s, step: 1 ms}}
output: {{every: 10 ms, sensors: {{c: {{contact: heap}}, p: {{position: upper}}, q: {{position: top}}, v: {{velocity: top}}}}}}
""")
    # Table and lower, lower and upper, upper and top, table and rod.
    assert out["c.touching"][-1] == 4
    assert out["c.normal"][-1] == pytest.approx((5 + 3 + 1 + 1) * G, rel=1e-4)
    # Springs over the end of the lower one, and over the lens between both, which carries 3 kg beside its middle: both tilt.
    x = numpy.linspace(-0.08, 0.1, 200001)
    chord = 2 * numpy.sqrt(numpy.clip(numpy.minimum(0.01 - x**2, 0.01 - (x - 0.02)**2), 0, None)) * (x[1] - x[0])
    per_area = 4e6 / (math.pi * 0.01)
    sunk = 5 * G / 4e6 + 3 * G * 0.02 / (4e6 * 0.01 / 4) * 0.02
    sunk += 3 * G / (per_area * chord.sum()) + 3 * G * 0.01 / (per_area * (chord * (x - 0.01)**2).sum()) * 0.01
    assert out["p.z"][-1] == pytest.approx(0.15 - sunk, abs=5e-8)
    assert abs(out["v.z"][-1]) < 1e-6 and abs(out["q.x"][-1] - 0.02) < 3e-5  # carried along by both tilts


def test_capsules_of_planar_models_lie_on_rectangles(sensors):
    out = sensors(f"""
buckens: 1
planar: xy
gravity: [0, -{G}, 0]
bodies: {{rod: {{rigid: {{mass: 2 kg, inertia: [0, 0, 1e-2]}}, at: {{position: [0.1, 0.0501, 0]}}}}}}
loads: {{c: {{contact: {{between: [{{ground: [0, -0.5, 0]}}, rod], shapes: [{{box: [2, 1, 1]}}, {{capsule: {{radius: 50 mm, length: 0.2, axis: [1, 0, 0]}}}}], stiffness: 1e6, damping: 2e3, static: 0.5}}}}}}
simulation: {{duration: 0.3 s, step: 1 ms}}
output: {{every: 20 ms, sensors: {{p: {{position: rod}}, c: {{contact: c}}}}}}
""")
    assert out["p.y"][-1] == pytest.approx(0.05 - 2 * G / 2e6, abs=1e-9)
    assert out["c.normal"][-1] == pytest.approx(2 * G, rel=1e-6)


def test_restitution_is_that_of_the_model_file_on_lines_and_volumes(sensors):
    """Ends, sides, and crossed ones: each leaves with half of the speed it comes with."""
    box, drum, rod = "box: [0.4, 0.4, 0.1]", "cylinder: {{radius: 50 mm, length: 0.1, axis: {}}}", "capsule: {{radius: 50 mm, length: 0.1, axis: {}}}"
    x, y, z = "[1, 0, 0]", "[0, 1, 0]", "[0, 0, 1]"
    pairs = [(box, drum.format(z), 1e6), (box, drum.format(x), 1e6), (box, rod.format(x), 1e6), (rod.format(y), rod.format(x), 1e6),
             (drum.format(y), drum.format(x), 1e7), (drum.format(x), drum.format(x), 1e7), (drum.format(y), rod.format(x), 1e6)]
    bodies = loads = starts = seen = ""
    for k, (lower, upper, stiffness) in enumerate(pairs):
        bodies += f"  b{k}: {{rigid: {{mass: 1, inertia: [1e-2, 1e-2, 1e-2]}}, at: {{position: [{k}, 0, 0.1005]}}}}\n"
        loads += f"  c{k}: {{contact: {{between: [{{ground: [{k}, 0, 0]}}, b{k}], shapes: [{{{lower}}}, {{{upper}}}], stiffness: {stiffness}, restitution: 0.5}}}}\n"
        starts += f"b{k}: {{velocity: [0, 0, -1]}}, "
        seen += f"v{k}: {{velocity: b{k}}}, "
    out = sensors(f"buckens: 1\nbodies:\n{bodies}loads:\n{loads}initial: {{bodies: {{{starts}}}}}\nsimulation: {{duration: 15 ms, step: 20 us}}\n"
                  f"output: {{every: 1 ms, sensors: {{{seen}lost: {{energy: dissipated}}}}}}\n")
    for k in range(len(pairs)):
        # The instants of the beginning and the end within their steps.
        assert out[f"v{k}.z"][-1] == pytest.approx(0.5, abs=5e-4), pairs[k]
        assert abs(out[f"v{k}.x"][-1]) + abs(out[f"v{k}.y"][-1]) < 1e-9
    assert out["lost"][-1] == pytest.approx(len(pairs) * 0.375, rel=1e-3)
