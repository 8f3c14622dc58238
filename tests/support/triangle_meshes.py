# SPDX-License-Identifier: Apache-2.0
"""Surfaces of triangles for tests of contact, and STL files of them."""

import struct

import numpy


def write_stl(path, points, triangles, text=False):
    """Corners counter-clockwise as seen from outside."""
    points = numpy.asarray(points, dtype=float)
    if text:
        lines = ["solid part"]
        for a, b, c in triangles:
            lines += ["facet normal 0 0 0", "outer loop"]
            lines += ["vertex " + " ".join(repr(float(x)) for x in points[k]) for k in (a, b, c)]
            lines += ["endloop", "endfacet"]
        path.write_text("\n".join([*lines, "endsolid part", ""]))
        return
    with open(path, "wb") as file:
        file.write(b"binary".ljust(80, b"\0") + struct.pack("<I", len(triangles)))
        for triangle in triangles:
            file.write(struct.pack("<12fH", 0, 0, 0, *points[list(triangle)].ravel(), 0))


def join(*parts):
    """One mesh of several. @param parts meshes and where they are"""
    points, triangles = [], []
    for (own, cells), at in parts:
        triangles += [tuple(len(points) + k for k in cell) for cell in cells]
        points += list(numpy.asarray(own) + at)
    return numpy.array(points), triangles


def plate(width, cells, seed=0):
    """A square of z = 0, seen from above, its inner points out of line."""
    places = numpy.linspace(-width / 2, width / 2, cells + 1)
    x, y = numpy.meshgrid(places, places, indexing="ij")
    points = numpy.stack([x.ravel(), y.ravel(), numpy.zeros(x.size)], axis=1)
    inside = (numpy.abs(points[:, :2]) < width / 2 - 1e-12).all(axis=1)
    shift = numpy.random.default_rng(seed).uniform(-0.3, 0.3, (len(points), 2)) * width / cells
    points[inside, :2] += shift[inside]
    triangles = []
    for i in range(cells):
        for j in range(cells):
            a, b = i * (cells + 1) + j, (i + 1) * (cells + 1) + j
            triangles += [(a, b, b + 1), (a, b + 1, a + 1)]
    return points, triangles


def box(size, cells=1):
    """Its middle at the origin."""
    size = numpy.asarray(size, dtype=float)
    points, triangles = [], []
    for axis in range(3):
        for side in (-1, 1):
            u, v = (axis + 1) % 3, (axis + 2) % 3
            first = len(points)
            for i in range(cells + 1):
                for j in range(cells + 1):
                    p = numpy.zeros(3)
                    p[axis], p[u], p[v] = side * size[axis] / 2, size[u] * (i / cells - 0.5), size[v] * (j / cells - 0.5)
                    points.append(p)
            for i in range(cells):
                for j in range(cells):
                    a, b = first + i * (cells + 1) + j, first + (i + 1) * (cells + 1) + j
                    both = [(a, b, b + 1), (a, b + 1, a + 1)]
                    triangles += both if side > 0 else [t[::-1] for t in both]
    return numpy.array(points), triangles


def globe(radius, levels):
    """An icosahedron whose triangles are divided into four again and again."""
    g = (1 + 5**0.5) / 2
    points = [numpy.array(p) / numpy.hypot(1, g) for p in
              [(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g), (0, -1, -g), (0, 1, -g),
               (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1)]]
    triangles = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6), (7, 1, 8),
                 (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    for _ in range(levels):
        middles, finer = {}, []

        def middle(a, b):
            key = (min(a, b), max(a, b))
            if key not in middles:
                p = points[a] + points[b]
                middles[key] = len(points)
                points.append(p / numpy.linalg.norm(p))
            return middles[key]

        for a, b, c in triangles:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            finer += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        triangles = finer
    return radius * numpy.array(points), triangles


def bowl(radius, cells):
    """The lower part of a hollow sphere about the origin, seen from inside, to 60 degrees from its lowest point."""
    points, triangles = plate(2.0, cells)
    angle = numpy.radians(60) * numpy.hypot(points[:, 0], points[:, 1])
    around = numpy.arctan2(points[:, 1], points[:, 0])
    return radius * numpy.stack([numpy.sin(angle) * numpy.cos(around), numpy.sin(angle) * numpy.sin(around),
                                 -numpy.cos(angle)], axis=1), triangles


def groove(length, width, cells):
    """Two planes at 45 degrees that meet along the x axis, seen from above."""
    points, triangles = plate(1.0, cells, seed=3)
    x, y = points[:, 0] * length, points[:, 1]
    y = numpy.where(numpy.abs(y) < 0.3 / cells + 1e-9, 0.0, y) if cells % 2 == 0 else y
    return numpy.stack([x, y * width, numpy.abs(y) * width], axis=1), triangles


def tube(radius, length, sides, rows=5):
    """A round bar along the y axis, with this many sides and triangles between as many rings and one more; closed by flat ends, whose borders are straight."""
    angles = 2 * numpy.pi * numpy.arange(sides) / sides
    ring = radius * numpy.stack([numpy.cos(angles), 0 * angles, numpy.sin(angles)], axis=1)
    rings = [ring + [0, y, 0] for y in numpy.linspace(-length / 2, length / 2, rows + 1)]
    points = numpy.concatenate([*rings, numpy.array([[0, -length / 2, 0], [0, length / 2, 0]])])
    triangles = []
    for k in range(sides):
        a, b = k, (k + 1) % sides
        for j in range(rows):
            i, n = j * sides, (j + 1) * sides
            triangles += [(a + i, a + n, b + i), (b + i, a + n, b + n)]
        triangles += [(len(points) - 2, a, b), (len(points) - 1, b + rows * sides, a + rows * sides)]
    return points, triangles
