# SPDX-License-Identifier: Apache-2.0
"""Curves of lines and arcs: points that are guided along them, and followers that they only push."""

import math
import re

import h5py
import numpy
import pytest

# A track of two straights and two half circles, once around; how arcs are given does not matter.
L, R, V = 0.4, 0.1, 2.0
TRACKS = {
    "through": "[{line: [400 mm, 0]}, {arc: [400 mm, 200 mm], through: [500 mm, 100 mm]}, {line: [0, 200 mm]}, {arc: [0, 0], through: [-100 mm, 100 mm]}]",
    "smooth": "[{line: [400 mm, 0]}, {arc: [400 mm, 200 mm]}, {line: [0, 200 mm]}, {arc: [0, 0]}]",
    "centre": "[{line: [400 mm, 0]}, {arc: [500 mm, 100 mm], centre: [400 mm, 100 mm]}, {arc: [400 mm, 200 mm], centre: [400 mm, 100 mm]}, "
              "{line: [0, 200 mm]}, {arc: [-100 mm, 100 mm], centre: [0, 100 mm]}, {arc: [0, 0], centre: [0, 100 mm]}]",
}
TRACK = """
buckens: 1
PLANAR
bodies: {bead: {rigid: {mass: 0.5 kg, inertia: [1, 1, 1]}, at: {position: [100 mm, 0, 0]}}}
joints: {track: {slot: {between: [ground, bead], segments: SEGMENTS, closed: on}}}
initial: {bodies: {bead: {velocity: [2, 0, 0]}}}
simulation: {duration: 0.8 s, step: STEP, METHOD}
output: {every: 2 ms, sensors: {x: {position: bead}, v: {velocity: bead}, f: {joint-force: track}, e: {energy: total}}}
"""


def around(way):
    """Place, direction and curvature on the track, `way` from its start."""
    way = way % (2 * L + 2 * math.pi * R)
    if way < L:
        return (way, 0), (1, 0), 0
    half = L + math.pi * R
    if way < half:
        a = (way - L) / R
        return (L + R * math.sin(a), R - R * math.cos(a)), (math.cos(a), math.sin(a)), 1 / R
    place, direction, bend = around(way - half)
    return (L - place[0], 2 * R - place[1]), (-direction[0], -direction[1]), bend


def in_space(segments):
    """Points of two numbers get a third."""
    return re.sub(r"\[([^\[\]{}]*?,[^\[\]{}]*?)\]", r"[\1, 0]", segments)


@pytest.mark.parametrize("kind", TRACKS)
@pytest.mark.parametrize("planar", ["planar: xy", ""])
def test_a_bead_runs_around_a_track(sensors, kind, planar):
    """At constant speed; the track pushes with m v²/R on arcs and with nothing on straights."""
    text = TRACK.replace("STEP", "0.1 ms").replace("METHOD", "method: newmark").replace("PLANAR", planar)
    out = sensors(text.replace("SEGMENTS", in_space(TRACKS[kind])))
    error, force = 0, 0
    for k, t in enumerate(out["t"]):
        way = 0.1 + V * t
        place, direction, bend = around(way)
        error = max(error, math.hypot(out["x.x"][k] - place[0], out["x.y"][k] - place[1]))
        if t > 0 and around(way - 2e-3)[2] == bend == around(way + 2e-3)[2]:
            push = (-direction[1] * bend * 0.5 * V**2, direction[0] * bend * 0.5 * V**2)
            force = max(force, math.hypot(out["f.x"][k] - push[0], out["f.y"][k] - push[1]))
    # Steps of 0.2 mm, 2e-3 rad on an arc: second order, and half a step at each joint with its jump of curvature.
    assert error < 1e-4
    assert force < 0.05 * 0.5 * V**2 / R
    assert numpy.hypot(out["v.x"], out["v.y"]) == pytest.approx(V, rel=1e-3)


def test_they_agree_to_the_last_digits(sensors):
    runs = [sensors(TRACK.replace("STEP", "1 ms").replace("METHOD", "method: newmark").replace("PLANAR", "planar: xy")
                    .replace("SEGMENTS", in_space(TRACKS[kind]))) for kind in TRACKS]
    for other in runs[1:]:
        assert other["x.x"] == pytest.approx(runs[0]["x.x"], abs=1e-9)


WRONG = {
    "a kink": ("[{line: [1, 0, 0]}, {line: [1, 1, 0]}]", 3, ["joint \"track\"", "pieces 1 and 2", "a kink of 90 degrees", "round it"]),
    "a kink at the end": ("[{line: [1, 0, 0]}, {arc: [1, 1, 0]}, {arc: [0, 0, 0], through: [0.1, 0.3, 0]}]", 3, ["kink"]),
    "open": ("[{line: [1, 0, 0]}, {arc: [1, 1, 0]}, {line: [0, 1, 0]}]", 3, ["ends 1 m from `start`", "`closed`"]),
    "nothing before": ("[{arc: [1, 0, 0]}]", 3, ["piece 1", "nothing to go on from", "`through`"]),
    "no circle": ("[{arc: [1, 0, 0], through: [0.5, 0, 0]}]", 3, ["piece 1", "lie on one line"]),
    "two radii": ("[{arc: [1, 0, 0], centre: [0.4, 0.3, 0]}]", 3, ["0.5 m from its start", "0.67082 m from its end"]),
    "half a circle": ("[{arc: [1, 0, 0], centre: [0.5, 0, 0]}]", 3, ["half a circle", "`through`"]),
    "no way": ("[{line: [0, 0, 0]}]", 3, ["piece 1", "ends where it begins"]),
    "back": ("[{line: [1, 0, 0]}, {arc: [0.5, 0, 0]}]", 3, ["piece 2", "straight behind"]),
    "both": ("[{line: [1, 0, 0], arc: [1, 0, 0]}]", 2, ["segments.0", "exactly one of the keys line and arc"]),
    "line about": ("[{line: [1, 0, 0], centre: [1, 0, 0]}]", 2, ["segments.0.centre", "belongs to an `arc`"]),
    "twice": ("[{arc: [1, 0, 0], centre: [1, 0, 0], through: [1, 1, 1]}]", 2, ["remove one of them"]),
    "path as well": ("[{line: [1, 0, 0]}], path: [[0, 0, 0], [1, 0, 0]]", 2, ["exactly one of the keys path and segments"]),
    "lines that miss": ("[], start: [0, 0, 0], path: [[0, 0, 0], [1, 0, 0], [1, 1, 0]]", 2, ["start", "belongs to `segments`"]),
}


@pytest.mark.parametrize("name", WRONG)
def test_curves_that_make_no_sense_are_told(buckens, tmp_path, name):
    segments, code, words = WRONG[name]
    text = TRACK.replace("STEP", "1 ms").replace("METHOD", "method: newmark").replace("PLANAR", "planar: xy")
    (tmp_path / "model.yaml").write_text(text.replace("SEGMENTS", segments))
    buckens("check", "model.yaml").must(code, "model.yaml:5:", *words)


# An eccentric disc lifts a follower with a point, or a roller, that only gravity and a spring hold on it.
ECCENTRIC, DISC, MASS = 0.02, 0.1, 0.4
CAM = """
buckens: 1
planar: xy
gravity: [0, -9.81, 0]
bodies:
  disc: {rigid: {mass: 1 kg, inertia: [0, 0, 0.01]}}
  follower: {rigid: {mass: 0.4 kg, inertia: [0, 0, 1e-4]}, at: {position: [0, HEIGHT, 0]}}
joints:
  shaft: {revolute: {between: [ground, disc/origin]}}
  motor: {prescribed-rotation: {between: [ground, disc/origin], speed: SPEED}}
  guide: {prismatic: {between: [ground, follower], axis: [0, 1, 0]}}
loads:
  cam: {cam: {between: [disc/origin, follower], closed: on, start: [120 mm, 0, 0], roller: ROLLER,
              segments: [{arc: [-80 mm, 0, 0], through: [20 mm, 100 mm, 0]}, {arc: [120 mm, 0, 0], through: [20 mm, -100 mm, 0]}], MORE}}
  spring: {slide-spring: {joint: guide, stiffness: 0, characteristic: "PRELOAD + 0*displacement N"}}
initial: {bodies: {disc: {angular-velocity: [0, 0, SPEED]}, follower: {velocity: [0, RISE, 0]}}}
simulation: {duration: DURATION, step: STEP}
output: {every: EVERY, sensors: {y: {position: {of: follower, along: [0, 1, 0]}}, v: {velocity: {of: follower, along: [0, 1, 0]}}, push: {spring-force: cam}, turn: {joint-coordinate: shaft},
                                 lost: {energy: dissipated}, balance: {energy: balance}}}
"""


def height(angle, roller):
    """Of the follower above the shaft: the centre of the disc is at (e cos a, e sin a)."""
    r = DISC + roller
    return ECCENTRIC * numpy.sin(angle) + numpy.sqrt(r**2 - (ECCENTRIC * numpy.cos(angle))**2)


def cam(share, roller, preload, duration, step, more="restitution: 0", every=None):
    """`share` of the speed at which it lifts off: at the top height'' = -e (1 + e/r)."""
    lift = ECCENTRIC * (1 + ECCENTRIC / (DISC + roller))
    speed = share * math.sqrt((9.81 + preload / MASS) / lift)
    text = CAM
    for key, value in (("HEIGHT", repr(float(height(0, roller)))), ("SPEED", repr(speed)), ("ROLLER", repr(roller)),
                       ("PRELOAD", repr(preload)), ("RISE", repr(speed * ECCENTRIC)), ("DURATION", repr(duration)),
                       ("STEP", step), ("EVERY", every or step), ("MORE", more)):
        text = text.replace(key, value)
    return text, speed, lift


@pytest.mark.parametrize("roller, preload", [(0.0, 0.0), (0.015, 12.0)])
def test_a_follower_stays_on_its_cam_below_the_exact_speed(sensors, roller, preload):
    text, speed, lift = cam(0.999, roller, preload, 0.5, "0.5 ms")
    out = sensors(text)
    # It touches at first; the row is closed by the end of the first step and holds at the end of all others.
    assert out["y"][:2] == pytest.approx(height(speed * out["t"][:2], roller), abs=3e-6)
    assert out["y"][2:] == pytest.approx(height(speed * out["t"][2:], roller), abs=1e-9)
    push = -out["push"]  # as of springs, tension is positive
    assert push[2:].min() > 0
    # At the top it is 0.2 % of the weight; steps pass the top within w h / 2.
    weight = MASS * 9.81 + preload
    assert push[2:].min() == pytest.approx((1 - 0.999**2) * weight, abs=2e-3 * weight)
    # It is pressed there from the start: nothing strikes, nothing is lost.
    assert abs(out["lost"][-1]) < 1e-12
    assert numpy.ptp(out["lost"][2:]) < 1e-9


@pytest.mark.parametrize("roller, preload", [(0.0, 0.0), (0.015, 12.0)])
def test_it_lifts_off_above(sensors, roller, preload):
    """It leaves where the acceleration of the cam is that of its fall, and flies along a parabola until it meets the cam again."""
    text, speed, lift = cam(1.3, roller, preload, 0.2, "20 us")
    out = sensors(text)
    fall = 9.81 + preload / MASS
    angles = numpy.linspace(0, 2 * math.pi, 2000001)
    step = angles[1]
    h = height(angles, roller)
    slope = numpy.gradient(h, step)
    bend = numpy.gradient(slope, step)
    off = int(numpy.argmax(bend[2:] * speed**2 < -fall)) + 2
    t = (angles - angles[off]) / speed
    flight = h[off] + slope[off] * speed * t - 0.5 * fall * t**2
    later = numpy.arange(len(angles)) > off + 1000
    back = int(numpy.argmax(later & (flight < h)))
    assert off < back
    turned = speed * out["t"]
    free = (turned > angles[off]) & (turned < angles[back])
    exact = numpy.interp(turned[free], angles, flight)
    # It is let go at the end of a step and lands in one: first order in 20 us of a flight of 20 ms.
    assert out["y"][free] == pytest.approx(exact, abs=2e-3 * (flight - h)[off:back].max())
    inside = (turned > angles[off] + 0.01) & (turned < angles[back] - 0.01)
    assert abs(out["push"][inside]).max() == 0
    # What the blow takes without restitution: the speed at which they meet.
    meet = (flight[back] - flight[back - 1]) / (step / speed) - slope[back] * speed
    assert out["lost"][numpy.argmax(turned > angles[back] + 0.02)] == pytest.approx(0.5 * MASS * meet**2, rel=0.02)
    on = (turned > angles[back] + 0.02) & (turned < angles[off] + 2 * math.pi - 0.1)
    assert out["y"][on] == pytest.approx(height(turned[on], roller), abs=1e-9)


def test_an_elastic_one_gives_way_by_its_stiffness(sensors):
    text, speed, lift = cam(0.8, 0.015, 12.0, 0.3, "0.2 ms", "stiffness: 1e7 N/m, damping: 2 kN s/m")
    out = sensors(text)
    weight = MASS * 9.81 + 12
    rigid = height(speed * out["t"], 0.015)
    # It sinks in by some N over 1e7 N/m; the start has to settle.
    late = out["t"] > 0.02
    assert (rigid - out["y"])[late].max() < 2 * weight / 1e7
    assert (rigid - out["y"])[late].min() > 0


def test_inside_of_a_ring(sensors):
    """A ball in a ring hangs at its lowest place and swings as a pendulum of the length R - r."""
    out = sensors("""
buckens: 1
gravity: [0, 0, -9.81]
bodies: {ball: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}, at: {position: ["0.4*sin(0.01)", 0, "-0.4*cos(0.01)"]}}}
joints: {plane: {point-in-plane: {between: [ground, ball], axis: [0, 1, 0]}}}
loads:
  ring: {cam: {between: [ground, ball], normal: [0, 1, 0], closed: on, side: SIDE, roller: 100 mm, start: [0.5, 0, 0],
               segments: [{arc: [-0.5, 0, 0], through: [0, 0, 0.5]}, {arc: [0.5, 0, 0], through: [0, 0, -0.5]}]}}
simulation: {duration: 2 s, step: 1 ms}
output: {every: 1 ms, sensors: {x: {position: {of: ball, along: [1, 0, 0]}}}}
""".replace("SIDE", "right"))
    t = out["t"]
    # sin for the angle: (0.01)²/6 of the size; (w h)²/12 of the phase.
    assert out["x"] == pytest.approx(0.004 * numpy.cos(math.sqrt(9.81 / 0.4) * t), abs=1e-6)


def test_cams_and_slots_are_drawn(buckens, tmp_path):
    """A cam as a disc with the roller beside it, a slot as a curve, both with their points in axes of the marker."""
    (tmp_path / "model.yaml").write_text(cam(0.5, 0.015, 12.0, 0.01, "1 ms")[0])
    buckens("run", "model.yaml", "-q", "-o", "out").must(0)
    with h5py.File(tmp_path / "out" / "results.h5") as file:
        shapes = file["geometry/shapes"]
        assert list(shapes["kinds"].asstr()) == ["cam", "wheel"]
        numbers, points = shapes["numbers"][:], shapes["points"][:].reshape(-1, 3)
    assert numpy.linalg.norm(points - [0.02, 0, 0], axis=1) == pytest.approx(0.1, abs=1e-12)
    # Across the plane, and the radius.
    assert abs(numbers[0][9]) == 1 and abs(numbers[1][9]) == 1 and numbers[1][10] == 0.015
    text = TRACK.replace("STEP", "1 ms").replace(", METHOD", "").replace("PLANAR", "").replace("SEGMENTS", in_space(TRACKS["smooth"]))
    (tmp_path / "model.yaml").write_text(text)
    buckens("run", "model.yaml", "-q", "-o", "slot").must(0)
    with h5py.File(tmp_path / "slot" / "results.h5") as file:
        assert list(file["geometry/shapes/kinds"].asstr()) == ["curve"]
        points = file["geometry/shapes/points"][:].reshape(-1, 3)
    assert points[0] == pytest.approx(points[-1], abs=1e-12)
    assert points.max(axis=0) == pytest.approx([0.5, 0.2, 0], abs=1e-4)


def test_messages_of_cams(buckens, tmp_path):
    text = cam(1, 0.0, 0.0, 0.1, "1 ms")[0]
    for change, code, words in (
            (("restitution: 0", "stiffness: 1e6, restitution: 0.2"), 2, ["loads.cam.cam.restitution", "rigid stops, ropes and cams"]),
            (("restitution: 0", "normal: [1, 0, 0]"), 2, ["load \"cam\"", "plane"]),
            (("through: [20 mm, 100 mm, 0]", "through: [20 mm, 90 mm, 0]"), 3, ["load \"cam\"", "kink"]),
            (("between: [disc/origin, follower], c", "between: [follower, follower], c"), 2, ["loads.cam.cam.between", "two different bodies"])):
        (tmp_path / "model.yaml").write_text(text.replace(*change))
        buckens("check", "model.yaml").must(code, *words)
    (tmp_path / "model.yaml").write_text(text.replace(f"position: [0, {float(height(0, 0.0))!r}, 0]", "position: [0, 0.05, 0]"))
    buckens("run", "model.yaml", "-o", "out").must(3, "load \"cam\"", "beyond the end of its free travel")
