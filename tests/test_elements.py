# SPDX-License-Identifier: Apache-2.0
"""Force elements, drives and planes of motion through the program, against exact solutions."""

import csv
import math

import numpy
import pytest

STEP = 1e-3
SPAN = "simulation: {duration: 1 s, step: 1 ms, rho-inf: 1}\n"


@pytest.fixture
def sensors(buckens, tmp_path):
    """Runs a model; returns the columns of sensors.csv by name without unit."""
    def call(text, *arguments):
        (tmp_path / "model.yaml").write_text("buckens: 1\n" + text)
        buckens("run", "model.yaml", "-o", "out", *arguments).must(0)
        rows = list(csv.reader((tmp_path / "out" / "sensors.csv").open()))
        values = numpy.array(rows[1:], dtype=float).T
        return {name.split(" [")[0]: column for name, column in zip(rows[0], values)}

    return call


def oscillation(t, omega, decay, start):
    """Damped free oscillation from `start` at rest."""
    nu = math.sqrt(omega**2 - decay**2)
    return start * numpy.exp(-decay * t) * (numpy.cos(nu * t) + decay / nu * numpy.sin(nu * t))


# The method has order 2: phase error (ωh)²/12 per radian, here below 3e-5 of ωt = 20 rad.
def close(omega, amplitude):
    return amplitude * 3 * omega * 1.0 * (omega * STEP)**2 / 12


def test_spring_damper(sensors):
    k, c, m, omega = 400.0, 4.0, 1.0, 20.0
    out = sensors(f"""
bodies:
  slider: {{rigid: {{mass: {m} kg}}, at: {{position: [1.1 m, 0, 0]}}}}
joints:
  rail: {{prismatic: {{between: [ground, slider], axis: [1, 0, 0]}}}}
loads:
  spring: {{spring-damper: {{between: [ground, slider], stiffness: {k} N/m, damping: {c} N s/m, length: 1 m}}}}
planar: xy
output: {{every: 1 ms, sensors: {{place: {{position: slider}}}}}}
""" + SPAN)
    exact = 1 + oscillation(out["t"], omega, c / (2 * m), 0.1)
    assert numpy.abs(out["place.x"] - exact).max() < close(omega, 0.1)
    assert numpy.ptp(out["place.x"]) > 0.15  # it does swing


def test_torsional_spring(sensors):
    k, c, inertia, omega = 8.0, 0.04, 0.02, 20.0
    out = sensors(f"""
bodies:
  wheel: {{rigid: {{mass: 1 kg, inertia: [0, 0, {inertia} kg m^2]}}, at: {{orientation: {{axis: [0, 0, 1], angle: 0.2 rad}}}},
           markers: {{rim: {{position: [1 m, 0, 0]}}}}}}
joints:
  pin: {{revolute: {{between: [ground, wheel]}}}}
loads:
  spring: {{torsional-spring: {{between: [ground, wheel], stiffness: {k} N m/rad, damping: {c} N m s/rad,
                              angle: -0.2 rad}}}}
planar: xy
output: {{every: 1 ms, sensors: {{rim: {{position: wheel/rim}}}}}}
""" + SPAN)
    exact = oscillation(out["t"], omega, c / (2 * inertia), 0.2)
    angle = numpy.arctan2(out["rim.y"], out["rim.x"])
    assert numpy.abs(angle - exact).max() < close(omega, 0.2)


def test_bushing_in_all_six_directions(sensors):
    """Each direction vibrates at its own frequency; the marker is at the mass centre. The push is small, so
    that rotations about three axes do not mix: their squares are 1e-6 of them."""
    rates, turns = (100.0, 400.0, 225.0), (2.0, 0.5, 4.5)
    out = sensors(f"""
bodies:
  block: {{rigid: {{mass: 1 kg, inertia: [0.02, 0.02, 0.02 kg m^2]}},
           markers: {{x: {{position: [1 m, 0, 0]}}, y: {{position: [0, 1 m, 0]}}}}}}
joints:
  mount:
    bushing: {{between: [ground, block], stiffness: {list(rates)}, rotational-stiffness: {list(turns)}}}
initial:
  bodies: {{block: {{velocity: [1 mm/s, 1 mm/s, 1 mm/s], angular-velocity: [1e-6, 1e-6, 1e-6]}}}}
output: {{every: 1 ms, sensors: {{at: {{position: block}}, x: {{position: block/x}}, y: {{position: block/y}}}}}}
""" + SPAN)
    t = out["t"]
    for axis, k in zip("xyz", rates):
        omega = math.sqrt(k)
        exact = 1e-3 / omega * numpy.sin(omega * t)
        assert numpy.abs(out[f"at.{axis}"] - exact).max() < close(omega, 1e-3 / omega), axis
    small_turns = {"x": out["y.z"] - out["at.z"], "y": out["at.z"] - out["x.z"],
                   "z": out["x.y"] - out["at.y"]}
    for axis, k in zip("xyz", turns):
        omega = math.sqrt(k / 0.02)
        exact = 1e-6 / omega * numpy.sin(omega * t)
        # Differences of positions of 1 m have a rounding error of 1e-15.
        assert numpy.abs(small_turns[axis] - exact).max() < close(omega, 1e-6 / omega) + 1e-14, axis


WHEEL = """
buckens: 1
title: A wheel on a hinge with a bushing
planar: xy
bodies:
  wheel: {rigid: {mass: 1 kg, inertia: [0, 0, 0.1 kg m^2]}}
joints:
  pin: {revolute: {between: [ground, wheel]}}
  coil: {bushing: {between: [ground, wheel], rotational-stiffness: [0, 0, STIFFNESS]}}
initial: {bodies: {wheel: {angular-velocity: [0, 0, 20]}}}
simulation: {duration: 0.4 s, step: 1 ms}
output: {every: 10 ms, sensors: {w: {angular-velocity: wheel}}}
"""


def test_bushing_wound_too_far_stops_the_run(buckens, tmp_path):
    """Beyond half a turn the rotation vector changes its sign, and the spring would unwind."""
    model = tmp_path / "wheel.yaml"
    model.write_text(WHEEL.replace("STIFFNESS", "1 N m/rad"))
    buckens("run", model, "-o", tmp_path / "out").must(
        4, 'joint "coil": a bushing is turned by 3.0', "limit the motion")
    model.write_text(WHEEL.replace("STIFFNESS", "0"))
    buckens("run", model, "-o", tmp_path / "free").must(0)


def test_prescribed_translation(sensors):
    out = sensors("""
bodies:
  slider: {rigid: {mass: 2 kg}}
joints:
  rail: {prismatic: {between: [ground, slider], axis: [1, 0, 0]}}
  drive: {prescribed-translation: {between: [ground, slider], axis: [1, 0, 0], displacement: "0.1*sin(20*t)"}}
initial: {bodies: {slider: {velocity: [2 m/s, 0, 0]}}}
planar: xy
output: {every: 1 ms, sensors: {place: {position: slider}, push: {joint-force: drive}}}
""" + SPAN.replace("rho-inf: 1", "rho-inf: 0.9"))
    t = out["t"]
    assert numpy.abs(out["place.x"] - 0.1 * numpy.sin(20 * t)).max() < 1e-13
    # m a = -80 sin 20 t. The force follows with order 2: (20 h)² of 80 N, from the third step on,
    # when the start-up transient has decayed.
    force = numpy.abs(out["push.x"]) if "push.x" in out else numpy.abs(out["push"])
    assert numpy.abs(force - numpy.abs(80 * numpy.sin(20 * t)))[20:].max() < 80 * 0.02**2


PENDULUM = """
planar: {plane}
gravity: {gravity}
materials: {{soft: {{E: 1e8 Pa, nu: 0, rho: 100 kg/m^3}}}}
bodies:
  beam:
    beam: {{to: {to}, elements: 4, section: {{circle: {{diameter: 50 mm}}}}, material: soft}}
joints:
  pin: {{revolute: {{between: [ground, beam/start]}}}}
simulation: {{duration: 0.2 s, step: 1 ms}}
output: {{every: 2 ms, sensors: {{tip: {{position: beam/end}}, bend: {{deflection: {{of: beam/mid, from: chord}}}}}}}}
"""


@pytest.mark.parametrize("plane, axes", [("yz", "yzx"), ("zx", "zxy")])
def test_every_plane_moves_like_xy(sensors, plane, axes):
    """The same soft pendulum in another plane: the same numbers along the permuted axes."""
    def vector(first, second, names):
        parts = dict.fromkeys("xyz", "0")
        parts[names[0]], parts[names[1]] = first, second
        return "[" + ", ".join(parts[name] for name in "xyz") + "]"

    def run(plane, names):
        return sensors(PENDULUM.format(plane=plane, gravity=vector("0", "-9.81", names),
                                       to=vector("1", "0", names)))

    flat, other = run("xy", "xyz"), run(plane, axes)
    for sensor in ("tip", "bend"):
        for mine, theirs in zip("xyz", axes):
            # The same sums in another order: rounding, magnified over 200 steps.
            difference = flat[f"{sensor}.{mine}"] - other[f"{sensor}.{theirs}"]
            assert numpy.abs(difference).max() < 1e-10, (sensor, mine)
    assert numpy.abs(flat["bend.y"]).max() > 1e-4  # it does bend
