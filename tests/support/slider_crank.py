# SPDX-License-Identifier: Apache-2.0
"""The flexible slider-crank by an independent route.

One Buckens frame in the plane, FM (44)-(49), with an assembly of its own: FM (55) by quadrature, the
condition P'v = 0 by multipliers, all constraints on acceleration level, classical Runge-Kutta. It
shares no formula of a step with the program. Short runs only: constraints drift.
"""

import numpy

LENGTH, DIAMETER, YOUNG, DENSITY = 0.3, 0.006, 2e11, 7870.0
SLIDER, RADIUS, SPEED = 0.033, 0.15, 150.0
TURN = numpy.array([[0.0, -1.0], [1.0, 0.0]])


def element(l):
    """M, K and h of one Euler-Bernoulli element."""
    area, second = numpy.pi * DIAMETER**2 / 4, numpy.pi * DIAMETER**4 / 64
    mass, M, K, h = DENSITY * area * l, *numpy.zeros((3, 6, 6))
    axial, bending = numpy.ix_([0, 3], [0, 3]), numpy.ix_([1, 2, 4, 5], [1, 2, 4, 5])
    M[axial] = mass / 6 * numpy.array([[2, 1], [1, 2]])
    K[axial] = YOUNG * area / l * numpy.array([[1, -1], [-1, 1]])
    M[bending] = mass / 420 * numpy.array(
        [[156, 22 * l, 54, -13 * l], [22 * l, 4 * l * l, 13 * l, -3 * l * l],
         [54, 13 * l, 156, -22 * l], [-13 * l, -3 * l * l, -22 * l, 4 * l * l]])
    K[bending] = YOUNG * second / l**3 * numpy.array(
        [[12, 6 * l, -12, 6 * l], [6 * l, 4 * l * l, -6 * l, 2 * l * l],
         [-12, -6 * l, 12, -6 * l], [6 * l, 2 * l * l, -6 * l, 4 * l * l]])
    points, weights = numpy.polynomial.legendre.leggauss(6)
    for s, w in zip((points + 1) / 2, weights / 2):
        u = numpy.array([1 - s, 0, 0, s, 0, 0])
        v = numpy.array([0, 1 - 3 * s**2 + 2 * s**3, l * (s - 2 * s**2 + s**3),
                         0, 3 * s**2 - 2 * s**3, l * (s**3 - s**2)])
        h += mass * w * (numpy.outer(u, v) - numpy.outer(v, u))
    return M, K, h


class Rod:
    def __init__(self, elements):
        nodes = elements + 1
        self.n = n = 3 * nodes
        self.M, self.K, self.h = numpy.zeros((3, n, n))
        for e in range(elements):
            place = numpy.ix_(range(3 * e, 3 * e + 6), range(3 * e, 3 * e + 6))
            for whole, part in zip((self.M, self.K, self.h), element(LENGTH / elements)):
                whole[place] += part
        self.x0 = numpy.zeros(n)
        self.x0[0::3] = numpy.linspace(-LENGTH / 2, LENGTH / 2, nodes)
        Q = numpy.zeros((n, 3))
        Q[0::3, 0] = Q[1::3, 1] = Q[2::3, 2] = 1
        Q[1::3, 2] = self.x0[0::3]
        self.P = self.M @ Q
        self.mass, self.J0, self.moment = Q[:, 0] @ self.P[:, 0], Q[:, 2] @ self.P[:, 2], self.M @ self.x0

    def accelerations(self, t, q, v, q_rate, v_rate):
        """Of (x, y, phi, slider) and v."""
        n, w = self.n, q_rate[2]
        A, f = numpy.zeros((n + 11, n + 11)), numpy.zeros(n + 11)
        A[0, 0] = A[1, 1] = self.mass
        A[2, 2] = self.J0 + 2 * self.moment @ v + v @ self.M @ v
        A[3, 3] = SLIDER
        A[4:n + 4, 4:n + 4] = self.M
        A[2, 4:n + 4] = v @ self.h
        A[4:n + 4, 2] = -self.h @ v
        f[2] = -2 * (self.moment + self.M @ v) @ v_rate * w
        f[4:n + 4] = 2 * w * self.h @ v_rate + w * w * (self.moment + self.M @ v) - self.K @ v
        A[4:n + 4, n + 4:n + 7] = -self.P
        A[n + 4:n + 7, 4:n + 4] = self.P.T
        rows, f[n + 7:] = self.joints(t, q, v, w, v_rate)
        A[n + 7:, :n + 4], A[:n + 4, n + 7:] = rows, -rows.T
        x = numpy.linalg.solve(A, f)
        return x[:4], x[4:n + 4]

    def joints(self, t, q, v, w, v_rate):
        """Both ends: on the crank's pin, and on the slider's line at the slider."""
        c, s = numpy.cos(q[2]), numpy.sin(q[2])
        R = numpy.array([[c, -s], [s, c]])
        G, right = numpy.zeros((4, self.n + 4)), numpy.zeros(4)
        for k, first in enumerate((0, self.n - 3)):
            z, z_rate = (self.x0 + v)[first:first + 2], v_rate[first:first + 2]
            part = slice(2 * k, 2 * k + 2)
            G[part, 0:2], G[part, 2] = numpy.eye(2), R @ TURN @ z
            G[part, 4 + first:6 + first] = R
            right[part] = R @ (w * w * z - 2 * w * TURN @ z_rate)
        G[2, 3] = -1
        angle = SPEED * t
        right[:2] -= RADIUS * SPEED**2 * numpy.array([numpy.cos(angle), numpy.sin(angle)])
        return G, right

    def deflection(self, v):
        """Of the middle from the chord, relative to the length."""
        p = (self.x0 + v).reshape(-1, 3)[:, :2]
        chord = (p[-1] - p[0]) / numpy.linalg.norm(p[-1] - p[0])
        return (TURN @ chord) @ (p[len(p) // 2] - p[0]) / LENGTH


def middle_deflections(elements, duration, steps):
    """Times and deflections; the rod starts straight with the velocities of a rigid one."""
    rod, n = Rod(elements), 3 * (elements + 1)
    y = numpy.zeros(2 * (n + 4))
    y[0], y[3] = RADIUS + LENGTH / 2, RADIUS + LENGTH
    y[n + 5], y[n + 6] = RADIUS * SPEED / 2, -RADIUS * SPEED / LENGTH

    def rate(t, y):
        motion = y[n + 4:]
        return numpy.concatenate(
            [motion, *rod.accelerations(t, y[:4], y[4:n + 4], motion[:4], motion[4:])])

    h = duration / steps
    found = [0.0]
    for k in range(steps):
        t = k * h
        a = rate(t, y)
        b = rate(t + h / 2, y + h / 2 * a)
        c = rate(t + h / 2, y + h / 2 * b)
        y = y + h / 6 * (a + 2 * b + 2 * c + rate(t + h, y + h * c))
        found.append(rod.deflection(y[4:n + 4]))
    return numpy.linspace(0.0, duration, steps + 1), numpy.array(found)
