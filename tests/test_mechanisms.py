# SPDX-License-Identifier: Apache-2.0
"""Published benchmarks of rigid mechanisms; see verification/mechanisms/README.md."""

import json
import math

import numpy
import pytest
from scipy import special

from conftest import SOURCE

FOLDER = SOURCE / "verification" / "mechanisms"
REFERENCE = json.loads((FOLDER / "reference.json").read_text())


def ends_with_order_two(coarse, fine, exact, accuracy):
    """A quarter of the error with half the step, and the extrapolated values are right."""
    errors = [numpy.abs(numpy.array(values) - exact).max() for values in (coarse, fine)]
    # Order two, as far as it is reached where the motion is fast.
    assert errors[0] / errors[1] == pytest.approx(4, abs=0.1)
    extrapolated = (4 * numpy.array(fine) - coarse) / 3
    assert numpy.abs(extrapolated - exact).max() < accuracy


def test_andrews_squeezer(sensors):
    case = REFERENCE["andrews"]
    text = (FOLDER / "andrews.yaml").read_text()

    def run(step):
        out = sensors(text, "--set", f"simulation.step={step}")
        assert abs(out["energy"][-1]) < 1e-4 * 0.5  # of the work done: 4e-5 J with the longer step
        return [out[f"{angle}.value"][-1] + case["start"][angle] for angle in case["end"]]

    # Extrapolation leaves h^4: 1/16 of what 20 and 10 us leave, 4e-8 rad after 2.5 turns.
    ends_with_order_two(run("10 us"), run("5 us"), list(case["end"].values()), 1e-7)


def swinging(t):
    """Place of the bob of a pendulum of 1 m that starts level, to the left, at rest; gravity downwards in y. Jacobi's elliptic functions."""
    k = math.sin(math.pi / 4)
    half = k * special.ellipj(special.ellipk(k * k) - math.sqrt(9.81) * t, k * k)[0]
    cosine = 1 - 2 * half**2
    return [-2 * half * math.sqrt(1 - half**2), -cosine]


def test_a_pendulum_swings_for_ten_seconds(sensors):
    """IFToMM A01."""
    case = REFERENCE["pendulum"]
    # The closed form, to the ten digits of the reference.
    for t, place in zip(case["t"], case["bob"]):
        assert swinging(t) == pytest.approx(place, abs=2e-10)
    text = (FOLDER / "pendulum.yaml").read_text()

    def run(step):
        out = sensors(text, "--set", f"simulation.step={step}")
        # The library asks for 5e-5 J.
        assert abs(out["energy"] - out["energy"][0]).max() < 5e-5
        rows = [numpy.argmin(numpy.abs(out["t"] - t)) for t in case["t"]]
        return [[out["bob.x"][row], out["bob.y"][row]] for row in rows]

    ends_with_order_two(run("1 ms"), run("0.5 ms"), numpy.array(case["bob"]), 1e-7)


def test_bricard(sensors):
    case = REFERENCE["bricard"]
    text = (FOLDER / "bricard.yaml").read_text()

    def run(step):
        out = sensors(text, "--set", f"simulation.step={step}")
        assert numpy.abs(out["energy"]).max() < 2e-5  # of 40 J in motion
        rows = [numpy.argmin(numpy.abs(out["t"] - t)) for t in case["t"]]
        return [[out[f"p3.{axis}"][row] for axis in "xyz"] for row in rows]

    ends_with_order_two(run("1 ms"), run("0.5 ms"), numpy.array(case["p3"]), 2e-9)


def windows(number):
    """Cranks at whole metres, joined by bars at their heads."""
    rod = "mass: 1 kg, inertia: [0, 0, 1/12 kg m^2]"
    lines = ["buckens: 1", "planar: xy", "gravity: [0, -9.81 m/s^2, 0]", "bodies:"]
    for k in range(number + 1):
        lines.append(f"  crank_{k}: {{rigid: {{{rod}, com: [0, 0.5 m, 0]}}, at: {{position: [{k} m, 0, 0]}}, "
                     "markers: {foot: {position: [0, 0, 0]}, head: {position: [0, 1 m, 0]}}}")
    for k in range(number):
        lines.append(f"  bar_{k}: {{rigid: {{{rod}, com: [0.5 m, 0, 0]}}, at: {{position: [{k} m, 1 m, 0]}}, "
                     "markers: {left: {position: [0, 0, 0]}, right: {position: [1 m, 0, 0]}}}")
    lines.append("joints:")
    for k in range(number + 1):
        lines.append(f"  foot_{k}: {{revolute: {{between: [{{ground: [{k} m, 0, 0]}}, crank_{k}/foot]}}}}")
    for k in range(number):
        lines.append(f"  left_{k}: {{revolute: {{between: [crank_{k}/head, bar_{k}/left]}}}}")
        lines.append(f"  right_{k}: {{revolute: {{between: [bar_{k}/right, crank_{k + 1}/head]}}}}")
    return "\n".join(lines + ["initial: {joints: {foot_0: {speed: -1 rad/s}}}", "simulation: {duration: 10 s, step: 1 ms}",
                              "output: {every: 1 s, sensors: {head: {position: crank_0/head}}}", ""])


@pytest.mark.parametrize("number", [2, 40])
def test_windows_pass_their_dead_centres(sensors, number):
    """Whenever the cranks lie flat, each window could fold on its own: the rows lose rank there."""
    case = REFERENCE["windows"]

    def run(step):
        out = sensors(windows(number), "--set", f"simulation.step={step}")
        rows = [numpy.argmin(numpy.abs(out["t"] - t)) for t in case["t"]]
        return [[out["head.x"][row], out["head.y"][row]] for row in rows]

    # The next term of the error is a hundredth of the first, 7e-5 m.
    ends_with_order_two(run("1 ms"), run("0.5 ms"), numpy.array(case[str(number)]), 1e-6)
