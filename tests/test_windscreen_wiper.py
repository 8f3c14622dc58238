# SPDX-License-Identifier: Apache-2.0
"""The loop in space of the example `windscreen_wiper`, with friction."""

import math

import numpy
import pytest

from conftest import SOURCE


def rocker_angles(cranks):
    """Of the loop with a rigid rod, followed from its start."""
    tilt, crank, rocker, base = math.radians(10), 0.04, 0.06, 0.3
    axis = numpy.array([0, math.sin(tilt), math.cos(tilt)])
    arm = numpy.array([0, math.cos(tilt), -math.sin(tilt)])
    side = numpy.cross(axis, arm)

    def place(angle):
        return numpy.array([base, 0, 0]) + rocker * (math.cos(angle) * arm + math.sin(angle) * side)

    length = numpy.linalg.norm(place(0) - [0, crank, 0])
    angles, angle = [], 0.0
    for turned in cranks:
        pin = crank * numpy.array([-math.sin(turned), math.cos(turned), 0])
        for _ in range(20):
            away = place(angle) - pin
            slope = away @ (rocker * (math.cos(angle) * side - math.sin(angle) * arm))
            angle -= 0.5 * (away @ away - length ** 2) / slope
        angles.append(angle)
    return numpy.array(angles)


def test_the_wiper_follows_its_crank(sensors):
    out = sensors((SOURCE / "examples" / "windscreen_wiper/windscreen_wiper").with_suffix(".yaml").read_text())
    expected = rocker_angles(out["crank.value"])
    assert 80 < math.degrees(numpy.ptp(expected)) < 100
    # The rod stretches and bends by micrometres.
    assert out["wipe.value"] == pytest.approx(expected, abs=1e-3)
    moving = numpy.abs(out["wipe.rate"]) > 0.5
    # The drag and at least something of the pin's friction; the sensor shows what resists.
    assert (out["glass"][moving] * out["wipe.rate"][moving] > 0).all()
    assert numpy.abs(out["glass"][moving]).min() > 1.5
    # 1.5 N m over two wipes there and back.
    assert out["lost"][-1] > 1.5 * 4 * numpy.ptp(expected) * 0.99
    assert abs(out["balance"]).max() < 1e-2 * out["lost"][-1]
