#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes plate.bdf: a steel plate of 600 x 400 x 4 mm in CQUAD4 of Nastran, in mm, t, N."""

import pathlib

SIZE, THICKNESS, DIVISIONS = (600.0, 400.0), 4.0, (18, 12)


def small(name, *fields):
    """A card in small field, eight fields to a line."""
    rows = [fields[k:k + 8] for k in range(0, len(fields), 8)]
    return "".join((name if k == 0 else "+").ljust(8) + "".join(f"{field!s:8}" for field in row)
                   .rstrip() + "\n" for k, row in enumerate(rows))


def deck():
    nx, ny = (count + 1 for count in DIVISIONS)
    yield "SOL 103\nCEND\nTITLE = PLATE\nBEGIN BULK\n"
    yield '$HMNAME PROP                   1"plate" 4\n$HMNAME MAT                    1"steel"\n'
    for j in range(ny):
        for i in range(nx):
            x, y = SIZE[0] * i / DIVISIONS[0], SIZE[1] * (j / DIVISIONS[1] - 0.5)
            yield small("GRID", 1 + i + nx * j, "", f"{x:.3f}", f"{y:.3f}", "0.")
    for j in range(DIVISIONS[1]):
        for i in range(DIVISIONS[0]):
            a = 1 + i + nx * j
            yield small("CQUAD4", 1 + i + DIVISIONS[0] * j, 1, a, a + 1, a + 1 + nx, a + nx)
    yield small("PSHELL", 1, 1, f"{THICKNESS:g}.", 1)
    yield small("MAT1", 1, "2.1+5", "", ".3", "7.85-9")
    yield "ENDDATA\n"


if __name__ == "__main__":
    pathlib.Path(__file__).with_name("plate.bdf").write_text("".join(deck()))
