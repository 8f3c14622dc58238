#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes STEP parts with typical faults of drawings, using the Gmsh library: make_bad_parts.py DIRECTORY.

The tests regenerate them each time. Lengths are in millimetres; the box has edges of 100, 60 and 40."""

import ctypes
import ctypes.util
import math
import pathlib
import sys

BOX = (100.0, 60.0, 40.0)


class Kernel:
    """The few functions of gmshc.h that are needed."""

    def __init__(self):
        name = next((n for n in ("libgmsh.so", "libgmsh.so.4.8", ctypes.util.find_library("gmsh")) if n), None)
        self.library = ctypes.CDLL(name)
        self.call("gmshInitialize", 0, None, 0)
        self.call("gmshOptionSetNumber", b"General.Terminal", ctypes.c_double(0))

    def call(self, function, *arguments):
        error = ctypes.c_int(0)
        result = getattr(self.library, function)(*arguments, ctypes.byref(error))
        if error.value:
            raise RuntimeError(f"{function}: error {error.value}")
        return result

    def box(self, corner, size):
        return self.call("gmshModelOccAddBox", *map(ctypes.c_double, (*corner, *size)), -1)

    def face(self, corners):
        """A separate plane face: it shares no edge with others."""
        points = [self.call("gmshModelOccAddPoint", *map(ctypes.c_double, (*p, 0.0)), -1) for p in corners]
        return self.plane([self.line(a, b) for a, b in zip(points, points[1:] + points[:1])])

    def line(self, first, last):
        return self.call("gmshModelOccAddLine", first, last, -1)

    def plane(self, lines):
        array = (ctypes.c_int * len(lines))(*lines)
        loop = self.call("gmshModelOccAddCurveLoop", array, ctypes.c_size_t(len(lines)), -1)
        return self.call("gmshModelOccAddPlaneSurface", (ctypes.c_int * 1)(loop), ctypes.c_size_t(1), -1)

    def ends(self, dimension, tag):
        """What bounds a face or a curve."""
        out, count = ctypes.POINTER(ctypes.c_int)(), ctypes.c_size_t(0)
        self.call("gmshModelGetBoundary", (ctypes.c_int * 2)(dimension, tag), ctypes.c_size_t(2), ctypes.byref(out),
                  ctypes.byref(count), 0, 0, 0)
        return [out[k] for k in range(1, count.value, 2)]

    def corner(self, point):
        out = [ctypes.c_double(0) for _ in range(6)]
        self.call("gmshModelGetBoundingBox", 0, point, *map(ctypes.byref, out))
        return [number.value for number in out[:3]]

    def join(self, operation, objects, tools):
        """A Boolean operation between lists of dimensions and tags."""
        size = ctypes.c_size_t
        out, table = ctypes.POINTER(ctypes.c_int)(), ctypes.POINTER(ctypes.POINTER(ctypes.c_int))()
        lengths, counts = ctypes.POINTER(size)(), [size(0), size(0)]
        first, second = ((ctypes.c_int * len(tags))(*tags) for tags in (objects, tools))
        self.call(operation, first, size(len(objects)), second, size(len(tools)), ctypes.byref(out),
                  ctypes.byref(counts[0]), ctypes.byref(table), ctypes.byref(lengths), ctypes.byref(counts[1]),
                  -1, 1, 1)

    def part(self, path, build):
        self.call("gmshModelAdd", path.stem.encode())
        build(self)
        self.call("gmshModelOccSynchronize")
        self.call("gmshWrite", str(path).encode())


def shell_with_gap(gap):
    """Six faces of the box, the top one above the upper edges of the walls."""
    def build(kernel):
        x, y, z = BOX
        low = [(0, 0, 0), (x, 0, 0), (x, y, 0), (0, y, 0)]
        high = [(a, b, z) for a, b, _ in low]
        kernel.face(low)
        kernel.face([(a, b, c + gap) for a, b, c in high])
        for k in range(4):
            n = (k + 1) % 4
            kernel.face([low[k], low[n], high[n], high[k]])
    return build


def boxes(*places):
    return lambda kernel: [kernel.box(corner, size) for corner, size in places]


def solid_with_fin(kernel):
    """A wall without thickness stands on the box."""
    kernel.box((0, 0, 0), BOX)
    kernel.face([(20, 30, 40), (80, 30, 40), (80, 30, 70), (20, 30, 70)])


def three_sheets(kernel):
    """Three faces leave one edge: they enclose nothing."""
    for far in ((100, 0, 0), (-100, 0, 0), (0, 0, 100)):
        x, y, z = far
        kernel.face([(0, 0, 0), (x, y, z), (x, y + 60, z), (0, 60, 0)])


def two_chambers(kernel):
    """Eleven separate faces: a box of twice BOX with a wall of no thickness in its middle."""
    x, y, z = BOX
    for begin in (0, x):
        low = [(begin, 0, 0), (begin + x, 0, 0), (begin + x, y, 0), (begin, y, 0)]
        high = [(a, b, z) for a, b, _ in low]
        kernel.face(low)
        kernel.face(high)
        for k in range(4):
            n = (k + 1) % 4
            if begin == 0 or k != 3:
                kernel.face([low[k], low[n], high[n], high[k]])


def pinched(kernel):
    """One solid whose two towers touch along an edge, where four faces meet; a plate joins them below."""
    boxes = [kernel.box(corner, size) for corner, size in (
        ((0, 0, 0), (40, 40, 30)), ((40, 40, 0), (40, 40, 30)), ((0, 0, -10), (80, 80, 10)))]
    kernel.join("gmshModelOccFuse", [3, boxes[0]], [3, boxes[1], 3, boxes[2]])


def tube(wall):
    """A wall around a bore of 20: elements that are larger than the wall reach through it."""
    def build(kernel):
        outer, bore = (kernel.call("gmshModelOccAddCylinder",
                                   *map(ctypes.c_double, (0, 0, 0, 0, 0, 60, radius)), -1,
                                   ctypes.c_double(2 * math.pi)) for radius in (10 + wall, 10))
        kernel.join("gmshModelOccCut", [3, outer], [3, bore])
    return build


def capped_tube(wall):
    """The tube on a disc: two solids that touch."""
    def build(kernel):
        tube(wall)(kernel)
        kernel.call("gmshModelOccAddCylinder", *map(ctypes.c_double, (0, 0, 0, 0, 0, -10, 10 + wall)), -1,
                    ctypes.c_double(2 * math.pi))
    return build


def screwed(width, height, tilt):
    """A block with a bolt in its bore, tilted: where the two are cut, slivers remain that run out to nothing."""
    def build(kernel):
        block = kernel.box((0, 0, 0), (width, width, height))
        def cylinder(bottom, top, radius):
            axis = [b - a for a, b in zip(bottom, top)]
            return kernel.call("gmshModelOccAddCylinder", *map(ctypes.c_double, (*bottom, *axis, radius)), -1,
                               ctypes.c_double(2 * math.pi))
        kernel.join("gmshModelOccCut", [3, block], [3, cylinder((width / 2, width / 2, 0), (width / 2, width / 2, height), 5)])
        cylinder((width / 2 - tilt, width / 2, 0), (width / 2 + tilt, width / 2, 1.25 * height), 5)
    return build


def folded(kernel):
    """The box, its top a Bezier surface whose parameters turn back behind one edge: triangles there lie on each other."""
    x, y, z = BOX
    grid = [(-20 if i == 1 and j in (1, 2) else i * x / 3, j * y / 3, z) for j in range(4) for i in range(4)]
    point = [kernel.call("gmshModelOccAddPoint", *map(ctypes.c_double, (*p, 0.0)), -1) for p in grid]
    size = ctypes.c_size_t
    top = kernel.call("gmshModelOccAddBezierSurface", (ctypes.c_int * 16)(*point), size(16), 4, -1, None, size(0), 0)
    kernel.call("gmshModelOccSynchronize")
    ends = {curve: kernel.ends(1, curve) for curve in kernel.ends(2, top)}
    corners = {corner for pair in ends.values() for corner in pair}
    below = {}
    for corner in corners:
        box = kernel.corner(corner)
        below[corner] = kernel.call("gmshModelOccAddPoint", *map(ctypes.c_double, (box[0], box[1], 0.0, 0.0)), -1)
    upright = {corner: kernel.line(below[corner], corner) for corner in corners}
    bottom = {curve: kernel.line(below[a], below[b]) for curve, (a, b) in ends.items()}
    faces = [top, kernel.plane(list(bottom.values()))]
    faces += [kernel.plane([bottom[c], upright[b], c, upright[a]]) for c, (a, b) in ends.items()]
    shell = kernel.call("gmshModelOccAddSurfaceLoop", (ctypes.c_int * 6)(*faces), size(6), -1, 0)
    kernel.call("gmshModelOccAddVolume", (ctypes.c_int * 1)(shell), size(1), -1)
    flat = [number for face in faces for number in (2, face)]
    kernel.call("gmshModelOccRemove", (ctypes.c_int * 12)(*flat), size(12), 0)


def sieve(columns, rows):
    """A plate of 2 mm with square holes of 1 mm, 3 mm apart: four faces each."""
    def loop(kernel, corner, side_x, side_y):
        x, y = corner
        corners = [(x, y), (x + side_x, y), (x + side_x, y + side_y), (x, y + side_y)]
        points = [kernel.call("gmshModelOccAddPoint", *map(ctypes.c_double, (*p, 0.0, 0.0)), -1) for p in corners]
        lines = [kernel.call("gmshModelOccAddLine", a, b, -1) for a, b in zip(points, points[1:] + points[:1])]
        return kernel.call("gmshModelOccAddCurveLoop", (ctypes.c_int * 4)(*lines), ctypes.c_size_t(4), -1)

    def build(kernel):
        loops = [loop(kernel, (0, 0), 3 * columns, 3 * rows)]
        loops += [loop(kernel, (3 * i + 1, 3 * j + 1), 1, 1) for i in range(columns) for j in range(rows)]
        face = kernel.call("gmshModelOccAddPlaneSurface", (ctypes.c_int * len(loops))(*loops),
                           ctypes.c_size_t(len(loops)), -1)
        out, count, none = ctypes.POINTER(ctypes.c_int)(), ctypes.c_size_t(0), ctypes.c_size_t(0)
        kernel.call("gmshModelOccExtrude", (ctypes.c_int * 2)(2, face), ctypes.c_size_t(2),
                    *map(ctypes.c_double, (0, 0, 2)), ctypes.byref(out), ctypes.byref(count), None, none, None, none, 0)
    return build


PARTS = {
    "tube": tube(0.6),
    "thin_tube": tube(0.3),
    "capped_tube": capped_tube(0.3),
    "gap_small": shell_with_gap(0.01),
    "gap_wide": shell_with_gap(1.0),
    "overlap": boxes(((0, 0, 0), BOX), ((90, 0, 0), BOX)),
    "touching": boxes(((0, 0, 0), BOX), ((100, 0, 0), BOX)),
    "along_an_edge": boxes(((0, 0, 0), BOX), ((100, 60, 0), BOX)),
    "in_metres": boxes(((0, 0, 0), (140e3, 60e3, 40e3))),
    "fin": solid_with_fin,
    "screwed": screwed(60, 40, 0.02),
    "pressed": screwed(22, 5, 0.05),
    "foil": boxes(((0, 0, 0), (100, 60, 1e-4))),
    "sheet": boxes(((0, 0, 0), (100, 20, 0.25))),
    "block_with_sheet": boxes(((0, 0, 0), (60, 60, 40)), ((60, 0, 20), (40, 60, 0.3))),
    "three_sheets": three_sheets,
    "two_chambers": two_chambers,
    "pinched": pinched,
}
# Kept beside this file, since tests in C++ read it.
KEPT = {"folded": folded}


def make(directory, *names):
    """@return the files, in the order of the names; without names all of PARTS"""
    kernel = Kernel()
    paths = [pathlib.Path(directory) / f"{name}.step" for name in names or PARTS]
    for path in paths:
        kernel.part(path, {**PARTS, **KEPT}[path.stem])
    return paths


if __name__ == "__main__":
    for made in make(sys.argv[1]):
        print(made)
