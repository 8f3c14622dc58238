# SPDX-License-Identifier: Apache-2.0
"""The angle of planar joints and of parallel axes, whose bodies also move otherwise."""

import numpy
import pytest

PLATE = """
buckens: 1
gravity: [0, -2, 0]
bodies: {plate: {rigid: {mass: 2 kg, inertia: [0.1, 0.1, 0.05]}}, wheel: {rigid: {mass: 1 kg, inertia: [0.1, 0.1, 0.03]}}}
joints:
  face: {KIND: {between: [ground, plate], axis: [0, 0, 1]}}
  shaft: {revolute: {between: [ground, wheel], axis: [0, 0, 1]}}
MOREsignals:
  angle: {joint-angle: face}
  speed: {joint-speed: face}
loads: {LOADS}
initial: {bodies: {plate: {velocity: [1.5, 0, VZ]}}, joints: {face: {angle: 0.3, speed: SPEED}}}
simulation: {duration: 2 s, step: 1 ms}
output:
  every: 10 ms
  sensors: {face: {joint-coordinate: face}, shaft: {joint-coordinate: shaft}, place: {position: plate}, angle: {signal: angle}, speed: {signal: speed},
            spring: {SPRING}, balance: {energy: balance}}
"""


def plate(kind, loads, more="", speed="0", spring="spring-torque: coil"):
    return (PLATE.replace("KIND", kind).replace("LOADS", loads).replace("MORE", more).replace("SPEED", speed)
            .replace("SPRING", spring).replace("VZ", "0.4" if kind == "parallel" else "0"))


def falls(out, kind):
    """Couples leave the way of the mass centre alone: a parabola, which the method follows exactly."""
    t = out["t"]
    assert out["place.x"] == pytest.approx(1.5 * t, abs=1e-10)
    assert out["place.y"] == pytest.approx(-t ** 2, abs=1e-10)
    assert out["place.z"] == pytest.approx(0.4 * t if kind == "parallel" else 0 * t, abs=1e-10)


@pytest.mark.parametrize("kind", ["planar", "parallel"])
def test_sprung_and_damped(sensors, kind):
    """I w' = -k a - c w with I = 0.05, from 0.3 rad; it falls and slides meanwhile."""
    out = sensors(plate(kind, "coil: {hinge-spring: {joint: face, stiffness: 5 N m/rad, damping: 0.05 N m s/rad}}"))
    t, d, w0 = out["t"], 0.5, 10.0
    w = numpy.sqrt(w0 ** 2 - d ** 2)
    exact = 0.3 * numpy.exp(-d * t) * (numpy.cos(w * t) + d / w * numpy.sin(w * t))
    # The period is off by (w h)²/12, over 20 rad.
    assert out["face.value"] == pytest.approx(exact, abs=1e-4)
    assert numpy.array_equal(out["angle"], out["face.value"]) and numpy.array_equal(out["speed"], out["face.rate"])
    assert out["spring"] == pytest.approx(5 * out["face.value"] + 0.05 * out["face.rate"], abs=1e-12)
    assert abs(out["balance"]).max() < 1e-5
    falls(out, kind)


@pytest.mark.parametrize("kind", ["planar", "parallel"])
def test_driven_counted_and_coupled(sensors, kind):
    """A motor turns it by 12 rad/s, almost four turns, a coupler the wheel half as far."""
    out = sensors(plate(kind, "motor: {hinge-motor: {joint: face, speed: 12, torque-limit: 40 N m}}",
                        "  pair: {coupler: {of: {face: 1, shaft: -2}}}\n", "12", "spring-torque: motor"))
    assert out["face.value"] == pytest.approx(0.3 + 12 * out["t"], abs=1e-9)
    assert out["shaft.value"] - out["shaft.value"][0] == pytest.approx(6 * out["t"], abs=1e-9)
    falls(out, kind)


@pytest.mark.parametrize("kind", ["planar", "parallel"])
def test_limited(sensors, kind):
    """From 0.3 rad with 1 rad/s against a rigid stop at 0.8 rad, and back with half the speed."""
    out = sensors(plate(kind, "end: {hinge-stop: {joint: face, to: 0.8, restitution: 0.5}}", "", "1", "spring-torque: end"))
    t = out["t"]
    # The blow may be a step late.
    assert out["face.value"] == pytest.approx(numpy.minimum(0.3 + t, 0.8 - 0.5 * (t - 0.5)), abs=2e-3)
    assert out["face.rate"][-1] == pytest.approx(-0.5, abs=1e-9)
    falls(out, kind)
