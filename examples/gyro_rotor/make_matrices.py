#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the matrices of a gyroscope as another finite-element program would: rotor_mass.mtx and
rotor_stiffness.mtx (Matrix Market) and rotor_nodes.csv.

The rotor is a steel shaft along x of Euler-Bernoulli beam elements with consistent mass, six variables
per node, and a disc that is rigid and sits on a node as a mass with rotary inertia.

    /usr/bin/python3 make_matrices.py     # needs numpy
"""

import pathlib

import numpy

E, NU, RHO = 210e9, 0.3, 7850.0
DIAMETER, LENGTH, ELEMENTS = 0.03, 0.2, 8
DISC_NODE, DISC_MASS = 6, 2.0             # at x = 150 mm
DISC_RADIUS, DISC_WIDTH = 0.1, 0.01

AREA = numpy.pi / 4 * DIAMETER**2
I = numpy.pi / 64 * DIAMETER**4


def beam(l):
    """Mass and stiffness of an element along x; variables u, v, w, θx, θy, θz at each end."""
    m, k = numpy.zeros((12, 12)), numpy.zeros((12, 12))
    pull = numpy.array([[1.0, -1.0], [-1.0, 1.0]])
    share = numpy.array([[2.0, 1.0], [1.0, 2.0]]) / 6
    k[numpy.ix_([0, 6], [0, 6])] = E * AREA / l * pull
    m[numpy.ix_([0, 6], [0, 6])] = RHO * AREA * l * share
    k[numpy.ix_([3, 9], [3, 9])] = E / (2 * (1 + NU)) * 2 * I / l * pull
    m[numpy.ix_([3, 9], [3, 9])] = RHO * 2 * I * l * share
    bend = E * I / l**3 * numpy.array([[12, 6 * l, -12, 6 * l], [6 * l, 4 * l**2, -6 * l, 2 * l**2],
                                       [-12, -6 * l, 12, -6 * l], [6 * l, 2 * l**2, -6 * l, 4 * l**2]])
    swing = RHO * AREA * l / 420 * numpy.array(
        [[156, 22 * l, 54, -13 * l], [22 * l, 4 * l**2, 13 * l, -3 * l**2],
         [54, 13 * l, 156, -22 * l], [-13 * l, -3 * l**2, -22 * l, 4 * l**2]])
    # Deflection along y turns about +z, that along z about -y.
    for places, sign in (([1, 5, 7, 11], 1.0), ([2, 4, 8, 10], -1.0)):
        turn = numpy.diag([1.0, sign, 1.0, sign])
        k[numpy.ix_(places, places)] += turn @ bend @ turn
        m[numpy.ix_(places, places)] += turn @ swing @ turn
    return m, k


def rotor():
    nodes = numpy.linspace(0.0, LENGTH, ELEMENTS + 1)
    n = 6 * len(nodes)
    m, k = numpy.zeros((n, n)), numpy.zeros((n, n))
    for e in range(ELEMENTS):
        own = slice(6 * e, 6 * e + 12)
        me, ke = beam(LENGTH / ELEMENTS)
        m[own, own] += me
        k[own, own] += ke
    polar = DISC_MASS * DISC_RADIUS**2 / 2
    across = DISC_MASS * (DISC_RADIUS**2 / 4 + DISC_WIDTH**2 / 12)
    at = 6 * DISC_NODE
    m[range(at, at + 6), range(at, at + 6)] += [DISC_MASS] * 3 + [polar, across, across]
    return nodes, m, k


def write(path, matrix, comment):
    rows, columns = numpy.nonzero(numpy.tril(matrix))
    with open(path, "w") as file:
        file.write("%%MatrixMarket matrix coordinate real symmetric\n")
        file.write(f"% {comment}\n{len(matrix)} {len(matrix)} {len(rows)}\n")
        for i, j in zip(rows, columns):
            file.write(f"{i + 1} {j + 1} {matrix[i, j]:.16e}\n")


def main():
    folder = pathlib.Path(__file__).parent
    nodes, m, k = rotor()
    write(folder / "rotor_mass.mtx", m, "mass of the rotor, kg and m")
    write(folder / "rotor_stiffness.mtx", k, "stiffness of the rotor, N and m")
    with open(folder / "rotor_nodes.csv", "w") as file:
        file.write("node,x,y,z,ux,uy,uz,rx,ry,rz\n")
        for n, x in enumerate(nodes):
            file.write(f"{n + 1},{x:g},0,0," + ",".join(str(6 * n + v + 1) for v in range(6)) + "\n")


if __name__ == "__main__":
    main()
