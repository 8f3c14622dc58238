# SPDX-License-Identifier: Apache-2.0
"""The example "spring_leg/spring_leg" against the theory of curved beams, integrated here: the natural
cubic spline of its points, sections that taper along it, and equilibrium in the bent shape."""

import csv
import math
import os
import pathlib

import numpy
import pytest

SOURCE = pathlib.Path(os.environ.get("BUCKENS_SOURCE_DIR", pathlib.Path(__file__).parents[1]))
MODEL = str(SOURCE / "examples/spring_leg/spring_leg.yaml")

POINTS = numpy.array([[0, 0], [-80, 5], [-150, 40], [-180, 110], [-130, 190], [-60, 260], [-40, 380]]) * 1e-3
E, DIAMETERS = 40e9, (12e-3, 16e-3)
MASS = 30.0
WEIGHT = 9.81 * MASS
LIGHT = ["--set", "materials.glass.rho=1"]  # a leg without mass: 0.1 g


class Spline:
    """Natural cubic spline of plane points over the length of their chords, at even places t."""

    def __init__(self, points, pieces):
        knots = numpy.concatenate([[0], numpy.cumsum(numpy.linalg.norm(numpy.diff(points, axis=0), axis=1))])
        width, count = numpy.diff(knots), len(knots)
        matrix, right = numpy.eye(count), numpy.zeros((count, 2))
        for i in range(1, count - 1):
            matrix[i, i - 1:i + 2] = width[i - 1], 2 * (width[i - 1] + width[i]), width[i]
            right[i] = 6 * ((points[i + 1] - points[i]) / width[i] - (points[i] - points[i - 1]) / width[i - 1])
        bend = numpy.linalg.solve(matrix, right)
        # The pieces end at the knots, where the third derivative jumps.
        self.t = numpy.unique(numpy.concatenate([numpy.linspace(a, b, pieces + 1)
                                                 for a, b in zip(knots[:-1], knots[1:])]))
        k = numpy.clip(numpy.searchsorted(knots, self.t, side="right") - 1, 0, count - 2)
        h, c = width[k, None], ((self.t - knots[k]) / width[k])[:, None]
        a = 1 - c
        self.place = (a * points[k] + c * points[k + 1]
                      + h**2 / 6 * ((a**3 - a) * bend[k] + (c**3 - c) * bend[k + 1]))
        first = (points[k + 1] - points[k]) / h + h / 6 * ((3 * c**2 - 1) * bend[k + 1] - (3 * a**2 - 1) * bend[k])
        second = a * bend[k] + c * bend[k + 1]
        self.speed = numpy.linalg.norm(first, axis=1)
        self.angle = numpy.unwrap(numpy.arctan2(first[:, 1], first[:, 0]))
        self.curvature = (first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]) / self.speed**3


class Leg:
    """The leg on a hinge at its foot, its upper end guided along y without rotation."""

    def __init__(self, pieces=40):
        self.line = Spline(POINTS, pieces)
        speed, t = self.line.speed, self.line.t
        # Simpson's rule over pairs of places; halfway by the cubic through the ends of the pair.
        step = t[2::2] - t[:-2:2]
        length = numpy.zeros_like(t)
        length[2::2] = numpy.cumsum(step * (speed[:-2:2] + 4 * speed[1::2] + speed[2::2]) / 6)
        length[1::2] = length[:-2:2] + step * (5 * speed[:-2:2] + 8 * speed[1::2] - speed[2::2]) / 24
        share = length / length[-1]
        diameter = DIAMETERS[0] + share * (DIAMETERS[1] - DIAMETERS[0])
        self.area, self.modulus = math.pi / 4 * diameter**2, math.pi / 32 * diameter**3
        self.EA, self.EI = E * self.area, E * self.modulus * diameter / 2
        self.weights = numpy.zeros_like(t)
        for offset, share in ((0, 1 / 6), (1, 4 / 6), (2, 1 / 6)):
            self.weights[offset:len(t) - 2 + offset:2] += share * step
        self.weights *= speed

    def stiffness(self):
        """Of small motions along y, by Castigliano's theorem with the foot's reaction along x as unknown [N/m]."""
        x, y = (self.line.place - self.line.place[0]).T
        moment = numpy.stack([-y, x])
        along = numpy.stack([numpy.cos(self.line.angle), numpy.sin(self.line.angle)])
        f = (moment / self.EI * self.weights) @ moment.T + (along / self.EA * self.weights) @ along.T
        return 1 / (f[1, 1] - f[0, 1]**2 / f[0, 0])

    def shape(self, unknowns):
        """Columns of (H, V, turn of the foot): upper end (x, y, angle), moments and normal forces along it."""
        H, V, turn = unknowns
        line, t = self.line, self.line.t
        origin = line.place[0]
        state = numpy.stack([origin[0] + 0 * H, origin[1] + 0 * H, line.angle[0] + turn])

        def forces(s):
            return ((s[0] - origin[0]) * V - (s[1] - origin[1]) * H,
                    -(H * numpy.cos(s[2]) + V * numpy.sin(s[2])))

        def slope(i, s):
            moment, normal = forces(s)
            stretch = 1 + normal / self.EA[i]
            return line.speed[i] * numpy.stack([stretch * numpy.cos(s[2]), stretch * numpy.sin(s[2]),
                                                line.curvature[i] + moment / self.EI[i]])

        inner = [forces(state)]
        for i in range(0, len(t) - 2, 2):  # Runge and Kutta, halfway on the places between
            h = t[i + 2] - t[i]
            k1 = slope(i, state)
            k2 = slope(i + 1, state + h / 2 * k1)
            k3 = slope(i + 1, state + h / 2 * k2)
            k4 = slope(i + 2, state + h * k3)
            state = state + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
            inner.append(forces(state))
        return state, inner

    def press(self, depth, guess):
        """Reactions of the foot and its turn, and the largest stress, where the upper end is `depth` lower."""
        line = self.line
        goal = numpy.array([line.place[-1, 0], line.place[-1, 1] - depth, line.angle[-1]])
        unknowns = numpy.array(guess, dtype=float)
        small = numpy.array([1e-3, 1e-3, 1e-7])
        for _ in range(20):
            columns = unknowns[:, None] + numpy.hstack([numpy.zeros((3, 1)), numpy.diag(small)])
            state, inner = self.shape(columns)
            error = state[:, 0] - goal
            if numpy.abs(error).max() < 1e-12:
                break
            unknowns -= numpy.linalg.solve((state[:, 1:] - state[:, :1]) / small, error)
        else:
            raise AssertionError(f"no equilibrium at {depth}")
        stress = [abs(normal[0]) / A + abs(moment[0]) / W
                  for (moment, normal), A, W in zip(inner, self.area[::2], self.modulus[::2])]
        return unknowns, max(stress)


@pytest.fixture(scope="module")
def pressed():
    """Polynomials of the force and of the largest stress over the depth."""
    leg, guess, rows = Leg(), (0, 0, 0), []
    for depth in numpy.linspace(0, 0.055, 9):
        guess, stress = leg.press(depth, guess)
        rows.append((depth, guess[1], stress))
    depth, force, stress = numpy.array(rows).T
    fit = numpy.polynomial.Polynomial.fit
    return fit(depth, force, 6), fit(depth, stress, 6)


@pytest.fixture
def sensors(buckens, tmp_path):
    """Columns of sensors.csv of the example, and the depth by which the machine has sunk."""
    def call(*options):
        out = str(tmp_path / "out")
        buckens("run", MODEL, "-o", out, *options).must(0)
        rows = list(csv.DictReader((tmp_path / "out" / "sensors.csv").open()))
        columns = {name.split(" [")[0]: numpy.array([float(row[name]) for row in rows]) for name in rows[0]}
        return columns | {"depth": POINTS[-1, 1] - columns["machine.y"]}

    return call


def test_its_stiffness_is_that_of_the_curve(buckens):
    found = []
    for elements in (32, 64):
        done = buckens("modes", MODEL, "--system", "--count", "1", "--json", *LIGHT,
                       "--set", "bodies.leg.frames=1", "--set", f"bodies.leg.beam.elements={elements}")
        mode = done.must(0).json["analyses"][0]["modes"][0]
        found.append(MASS * (2 * math.pi * mode["frequency"])**2)
    exact = Leg().stiffness()
    # Chords in place of the curve: an error of h^2, whose next term leaves some 1e-4 of the first.
    errors = [k / exact - 1 for k in found]
    assert 3.5 < errors[0] / errors[1] < 4.5
    assert (4 * found[1] - found[0]) / 3 == pytest.approx(exact, rel=2e-4)


def test_the_machine_stands_where_the_bent_curve_is_in_equilibrium(sensors, pressed):
    force, _ = pressed
    at_rest = sensors(*LIGHT, "--set", "initial={start: static}", "--set", "simulation.duration=1 ms",
                      "--set", "output.every=0.5 ms")
    depth = at_rest["depth"][0]
    # 0.5 % for 32 chords, as in the test above, and 0.1 % for 16 frames, whose error falls with their square.
    assert force(depth) == pytest.approx(WEIGHT, rel=8e-3)
    assert at_rest["foot.y"][0] == pytest.approx(WEIGHT, rel=1e-5)


def test_the_machine_sinks_as_deep_as_the_work_of_its_weight_bends_the_leg(sensors, pressed):
    force, stress = pressed
    work = force.integ()
    bounce = sensors(*LIGHT)
    low, high = 0.03, 0.055
    while high - low > 1e-9:
        middle = 0.5 * (low + high)
        if WEIGHT * middle > work(middle) - work(0):
            low = middle
        else:
            high = middle
    deepest = bounce["depth"].max()
    # As above; records are 5 ms apart, w = 21/s: at most (w t)^2 / 8 = 1.4e-3 is missed.
    assert deepest == pytest.approx(low, rel=8e-3)
    assert bounce["foot.y"].max() == pytest.approx(force(low), rel=8e-3)
    # Sections are taken at the ends of elements, where the moment of the leg is within 1 % of the largest.
    assert bounce["stress.axial"].max() == pytest.approx(stress(low), rel=1.5e-2)
    # It returns to its starting position.
    assert abs(bounce["depth"][bounce["t"] > 0.2].min()) < 1e-3 * deepest
