# SPDX-License-Identifier: Apache-2.0
"""Writes bowl.stl: a bowl of revolution in millimetres, z = r^2/400 beyond a flat bottom, seen from above."""

import math
import pathlib

RINGS, PARTS, FLAT, WIDE = 20, 20, 10.0, 150.0


def point(ring, part):
    radius = FLAT * ring if ring <= 1 else FLAT + (WIDE - FLAT) * (ring - 1) / (RINGS - 1)
    angle = 2 * math.pi * (part % PARTS + 0.5 * (ring % 2)) / PARTS
    return radius * math.cos(angle), radius * math.sin(angle), max(0.0, radius - FLAT)**2 / 400


with open(pathlib.Path(__file__).with_name("bowl.stl"), "w") as file:
    file.write("solid bowl\n")
    for ring in range(RINGS):
        for part in range(PARTS):
            shift = ring % 2
            inner, outer = (point(ring, part), point(ring, part + 1)), (point(ring + 1, part + shift), point(ring + 1, part + 1 + shift))
            halves = [(inner[0], outer[0], inner[1]), (inner[1], outer[0], outer[1])]
            for half in halves[1:] if ring == 0 else halves:
                file.write("facet normal 0 0 0\nouter loop\n")
                file.writelines("vertex " + " ".join(f"{x:.6g}" for x in corner) + "\n" for corner in half)
                file.write("endloop\nendfacet\n")
    file.write("endsolid bowl\n")
