# SPDX-License-Identifier: Apache-2.0
"""Balls that wedge each other between walls: blows are found, without energy from nowhere."""

import math
import pathlib

import numpy
import pytest

TRAY = pathlib.Path(__file__).parents[1] / "examples" / "balls_in_tray" / "balls_in_tray.yaml"


def test_balls_that_wedge_themselves_in_a_tray_go_on(buckens, tmp_path):
    """Three in a row between two walls, nearly straight, are struck again and again: at 0.546 s no impulses were found."""
    buckens("run", TRAY, "-q", "-o", "out", "--set", "bodies.wood_1.at.position=[-11.05 mm, -21 mm, 70 mm]",
            "--set", "simulation.duration=0.55 s").must(0)
    out = numpy.genfromtxt(tmp_path / "out" / "sensors.csv", delimiter=",", names=True, deletechars="", replace_space=" ")
    assert out["t [s]"][-1] == pytest.approx(0.55)
    # Steps of 0.5 ms with several blows in one leave a thousandth open (docs/theory/25-contact.md, section 5).
    assert numpy.abs(out["balance [J]"]).max() < 3e-3 * out["lost [J]"][-1]


def six_balls(places, duration):
    """Of wood and glass, one after the other, into a box of 104 mm: two of wood are 112 mm."""
    kinds = {"w": "mass: 64.37 g, inertia: [20.19 kg mm^2, 20.19 kg mm^2, 20.19 kg mm^2]",
             "g": "mass: 83.78 g, inertia: [13.4 kg mm^2, 13.4 kg mm^2, 13.4 kg mm^2]"}
    bodies = "\n".join(f"  {'wg'[k % 2]}{k}: {{rigid: {{{kinds['wg'[k % 2]]}}}, at: {{position: [{place} mm, {32 + 50 * k} mm]}}}}"
                       for k, place in enumerate(places))
    walls = "\n".join(
        f"        - {{on: {{ground: [{place}]}}, box: [{sides}]}}"
        for place, sides in (("0, 0, -10 mm", "200 mm, 200 mm, 20 mm"),
                             ("-62 mm, 0, 100 mm", "20 mm, 200 mm, 200 mm"), ("62 mm, 0, 100 mm", "20 mm, 200 mm, 200 mm"),
                             ("0, -62 mm, 100 mm", "200 mm, 20 mm, 200 mm"), ("0, 62 mm, 100 mm", "200 mm, 20 mm, 200 mm")))
    return f"""
buckens: 1
gravity: [0, 0, -9.81]
bodies:
{bodies}
loads:
  heap:
    contacts:
      among:
{walls}
        - {{bodies: "w*", sphere: 28 mm}}
        - {{bodies: "g*", sphere: 20 mm}}
      restitution: 0.3
      static: 0.3
simulation: {{duration: {duration} s, step: 0.5 ms}}
output: {{every: 0.5 ms, sensors: {{lost: {{energy: dissipated}}, balance: {{energy: balance}}}}}}
"""


# Places in millimetres; at 0.21 s and at 0.2785 s impulses satisfy Coulomb's law with the restitution and give hundreds of
# joules to what has 0.4 J.
@pytest.mark.parametrize("places, duration", [
    (["-12 mm, -18", "-6 mm, -21", "-20 mm, -5", "26 mm, 19", "12 mm, -13", "2 mm, -14"], 0.225),
    (["21 mm, 21", "-27 mm, -26", "15 mm, 11", "11 mm, -12", "5 mm, 5", "5 mm, -21"], 0.279),
    # Two that ended by "diverged", at 0.2305 s and 0.2755 s: four places of two balls, walls and ground stick in a ring that is
    # plane to 3e-6 rad, and gaps of 7 micrometres were closed by rolling 0.09 m.
    (["-12 mm, 2", "-5 mm, 19", "-1 mm, 4", "10 mm, -22", "16 mm, -11", "-14 mm, -14"], 0.24),
    (["1 mm, 14", "-5 mm, -10", "12 mm, 9", "14 mm, -10", "19 mm, -12", "24 mm, 11"], 0.28),
    # Impulses of 84 N s that cancel each other, each for its own rest of the step, moved a ball by 0.68 m at 0.1945 s: 0.04 J open.
    (["21 mm, 21", "-25 mm, -19", "-6 mm, -15", "23 mm, 8", "-9 mm, 5", "10 mm, -21"], 0.2),
    # Slips that turn round in each iteration at places that wedge each other: at 0.2895 s loads grew without bound at any step,
    # until how places stand was decided before the first iteration.
    (["-15 mm, 7", "-7 mm, -12", "21 mm, 6", "-17 mm, -1", "-2 mm, -11", "-12 mm, 18"], 0.295),
    # The load of a place that slides between balls which fall side by side has tended to nothing, by 1e-10 in each iteration: at
    # 0.4945 s it had no inverse, and "stiffnesses differ too much".
    (["-12 mm, -18", "-3 mm, -1", "-19 mm, -22", "7 mm, 19", "14 mm, 12", "-14 mm, 1"], 0.5),
    # Iterations that had gone astray came back from 1e80 m as their places let go, and ended 2 m beside: at 0.1656 s and at 0.2925 s.
    (["8 mm, -20", "-9 mm, 17", "17 mm, 15", "9 mm, -3", "19 mm, -12", "-18 mm, 4"], 0.17),
    (["-14 mm, 14", "26 mm, 23", "-18 mm, -6", "-21 mm, 3", "6 mm, 8", "13 mm, -4"], 0.295),
    # At 0.328 s forces after a blow were decided again and again without changing how any place stands: 450 times 0.2 s.
    (["21 mm, 7", "-29 mm, 12", "9 mm, 7", "-27 mm, -7", "-20 mm, -11", "21 mm, 8"], 0.33),
])
def test_a_heap_between_narrow_walls_gains_nothing(sensors, places, duration):
    out = sensors(six_balls(places, duration))
    assert out["t"][-1] == pytest.approx(duration)
    # Slips of what rests, on the motion that weight brings within a step, count against the loss.
    assert numpy.diff(out["lost"]).min() > -1e-3 * out["lost"][-1]
    # Several blows in a step of 0.5 ms: two hundredths at single records.
    assert numpy.abs(out["balance"]).max() < 0.03 * out["lost"][-1]


def two_balls(side, spin):
    """The upper one falls into the gap between the lower one and a wall, with an angle of 33.4 degrees, twice that of friction."""
    half = side / 2
    x = half - 28
    height = math.sqrt(56**2 - (2 * x) ** 2) + 0.1
    ball = "mass: 64.37 g, inertia: [20.19 kg mm^2, 20.19 kg mm^2, 20.19 kg mm^2]"
    walls = "\n".join(
        f"        - {{on: {{ground: [{place}]}}, box: [{sides}]}}"
        for place, sides in (("0, 0, -10 mm", "200 mm, 200 mm, 20 mm"),
                             (f"{-half - 10} mm, 0, 100 mm", "20 mm, 200 mm, 200 mm"),
                             (f"{half + 10} mm, 0, 100 mm", "20 mm, 200 mm, 200 mm")))
    return f"""
buckens: 1
gravity: [0, 0, -9.81]
bodies:
  a: {{rigid: {{{ball}}}, at: {{position: [{-x} mm, 0, 28 mm]}}}}
  b: {{rigid: {{{ball}}}, at: {{position: [{x} mm, 0, {28 + height} mm]}}}}
loads:
  heap:
    contacts:
      among:
{walls}
        - {{bodies: "*", sphere: 28 mm}}
      restitution: 0.3
      static: 0.3
initial: {{bodies: {{b: {{velocity: [0, 0, -0.5], angular-velocity: [0, {spin}, 0]}}}}}}
simulation: {{duration: 20 ms, step: 0.5 ms}}
output: {{every: 0.5 ms, sensors: {{kinetic: {{energy: kinetic}}, lost: {{energy: dissipated}}, balance: {{energy: balance}}}}}}
"""


@pytest.mark.parametrize("side", [102.73, 102.75, 102.77])
@pytest.mark.parametrize("spin", [-12, -20])
def test_a_ball_that_nearly_jams_gains_nothing(sensors, side, spin):
    """Impulses that part the bodies with their restitution grow without bound there, up to 26 J for what has 0.01 J."""
    out = sensors(two_balls(side, spin))
    start = out["kinetic"][0]
    # The work of its weight over 0.1 mm and the way on.
    assert out["kinetic"].max() < 1.1 * start
    # Less than nothing is lost where a body is lifted out of what it was in before.
    assert numpy.diff(out["lost"]).min() > -1e-4 * start
    # To first order in the step.
    assert numpy.abs(out["balance"]).max() < 0.05 * start
