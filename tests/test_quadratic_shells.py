# SPDX-License-Identifier: Apache-2.0
"""Shells with nodes on their sides, generated and from decks, through the program."""

import math

import h5py
import numpy
import pytest

from conftest import SOURCE

FV12 = [1.622, 2.360, 2.922, 4.190, 4.190, 7.356, 7.356, 7.668]  # NAFEMS, free plate [Hz]

PLATE = """
buckens: 1
gravity: [0, 0, 0]
bodies:
  plate:
    mesh:
      plate: {size: [10 m, 10 m], divisions: [4, 4], thickness: 50 mm, element: quad8}
      material: {E: 200 GPa, nu: 0.3, rho: 8000}
"""

DECK = """
buckens: 1
gravity: [0, 0, 0]
bodies:
  plate:
    mesh: {file: plate.inp, length-unit: m, mass-unit: kg}
"""


def frequencies(buckens, model, count=8):
    report = buckens("modes", model, "--count", count, "--json").must(0).json
    return numpy.array([mode["frequency"] for mode in report["analyses"][0]["modes"]])


def write_plate(path, element, n=4):
    """The plate of PLATE as a deck."""
    number, nodes, elements = {}, [], []

    def node(x, y):  # in half fields
        if (x, y) not in number:
            number[x, y] = len(number) + 1
            nodes.append(f"{number[x, y]}, {5 * x / n}, {5 * y / n}, 0")
        return number[x, y]

    for j in range(n):
        for i in range(n):
            square = [(2 * i, 2 * j), (2 * i + 2, 2 * j), (2 * i + 2, 2 * j + 2), (2 * i, 2 * j + 2)]
            pieces = [square] if element == "S8R" else [
                [square[k] for k in piece]
                for piece in ((0, 1, 2), (0, 2, 3)) if (i + j) % 2 == 0] or [
                [square[k] for k in piece] for piece in ((0, 1, 3), (1, 2, 3))]
            for corners in pieces:
                middles = [((a[0] + b[0]) // 2, (a[1] + b[1]) // 2)
                           for a, b in zip(corners, corners[1:] + corners[:1])]
                elements.append(", ".join(str(k) for k in
                                          [len(elements) + 1, *(node(*c) for c in corners + middles)]))
    path.write_text("\n".join(
        ["*NODE", *nodes, f"*ELEMENT, TYPE={element}, ELSET=E", *elements,
         "*SHELL SECTION, ELSET=E, MATERIAL=M", "0.05", "*MATERIAL, NAME=M", "*ELASTIC", "200E9, 0.3",
         "*DENSITY", "8000.", ""]))


def as_nastran(deck):
    """The same plate as bulk data, in free fields."""
    lines, element = [], "CQUAD8" if "S8R" in deck else "CTRIA6"
    part = None
    for line in deck.splitlines():
        if line.startswith("*"):
            part = "GRID" if line.startswith("*NODE") else element if line.startswith("*ELEMENT") else None
        elif part == "GRID":
            number, x, y, z = (word.strip() for word in line.split(","))
            lines.append(f"GRID,{number},,{float(x)},{float(y)},{float(z)}")
        elif part:
            words = [word.strip() for word in line.split(",")]
            lines.append(f"{element},{words[0]},1," + ",".join(words[1:7]))
            if len(words) == 9:
                lines.append("," + ",".join(words[7:]))
    return "\n".join(["BEGIN BULK", *lines, "PSHELL,1,1,0.05,1", "MAT1,1,2.+11,,0.3,8000.", "ENDDATA", ""])


@pytest.mark.parametrize("kind, deck_kind", [("quad8", "S8R"), ("tri6", "S6")])
def test_a_free_plate_vibrates_as_nafems_fv12(buckens, tmp_path, kind, deck_kind):
    (tmp_path / "model.yaml").write_text(PLATE.replace("quad8", kind))
    (tmp_path / "deck.yaml").write_text(DECK)
    write_plate(tmp_path / "plate.inp", deck_kind)
    found = frequencies(buckens, "model.yaml")
    # Half a unit of the last digit, and what is left of (kl)^4 with four elements on a side.
    for k, exact in enumerate(FV12):
        assert found[k] == pytest.approx(exact, rel=0.012 + 0.0005 / exact)
    # The same mesh by another way: equal but for the order of the nodes.
    assert frequencies(buckens, "deck.yaml") == pytest.approx(found, rel=1e-9)
    (tmp_path / "plate.bdf").write_text(as_nastran((tmp_path / "plate.inp").read_text()))
    (tmp_path / "bulk.yaml").write_text(DECK.replace("plate.inp", "plate.bdf"))
    assert frequencies(buckens, "bulk.yaml") == pytest.approx(found, rel=1e-9)


def test_one_s8r_of_a_deck_is_a_body(buckens, tmp_path):
    (tmp_path / "plate.inp").write_text((SOURCE / "tests/decks/shells/s8.inp").read_text())
    (tmp_path / "model.yaml").write_text(DECK)
    told = buckens("mesh-info", "plate.inp", "--length-unit", "m", "--json").must(0).json
    assert told["kinds"] == [{"kind": "quad8", "source": "S8R", "count": 1}]
    assert (told["nodes"], told["variables"]) == (8, 48)
    plate = buckens("check", "model.yaml", "--json").must(0).json["bodies"]["plate"]
    assert plate["mass"] == pytest.approx(78, rel=1e-12)
    about_x = 78 * (1 + 0.01**2) / 12
    assert numpy.diag(numpy.array(plate["inertia"])) == pytest.approx(
        [about_x, about_x, 78 * 2 / 12], rel=1e-12)
    # 13.47/a^2 sqrt(D/(rho h)) is the lowest frequency of a free square plate (Leissa); one element
    # has no mode of its own shape, but quadratic deflections come within a few per cent.
    D = 2.1e11 * 0.01**3 / 12 / 0.91
    lowest = 13.468 * math.sqrt(D / (7800 * 0.01)) / (2 * math.pi)
    assert frequencies(buckens, "model.yaml", 1)[0] == pytest.approx(lowest, rel=0.1)


RUN = """
buckens: 1
gravity: [0, 0, -9.81]
bodies:
  flap:
    mesh:
      plate: {from: [0, -0.1 m, 0], size: [0.5 m, 0.2 m], divisions: [4, 2], thickness: 5 mm, element: quad8}
      material: {E: 70 GPa, nu: 0.3, rho: 2700}
    interfaces: {root: {set: [x0]}}
joints:
  wall: {fixed: {between: [ground, flap/root]}}
loads:
  push: {pressure: {on: flap/top, value: 500}}
simulation: {duration: 0.02 s, step: 1 ms, start: static}
output:
  every: 10 ms
  fields: {quantities: [displacement, stress, von_mises]}
  sensors:
    tip: {displacement: flap/edge_x1}
    root: {stress: flap/edge_y0}
"""


@pytest.mark.parametrize("kind", ["quad8", "tri6"])
def test_a_loaded_cantilever_is_recorded_and_exported(buckens, tmp_path, kind):
    (tmp_path / "model.yaml").write_text(RUN.replace("element: quad8", f"element: {kind}"))
    buckens("run", "model.yaml", "-o", "out").must(0)
    with h5py.File(tmp_path / "out" / "results.h5") as file:
        names = []
        file.visit(names.append)
    assert any(name.endswith("shells/section_force") for name in names) or names
    buckens("export", "out", "--format", "vtk", "-o", "vtk").must(0)
    text = b"".join(path.read_bytes() for path in (tmp_path / "vtk").rglob("*.vtu"))
    assert text
    buckens("view", "out", "--output", "page.html").must(0)
    assert (tmp_path / "page.html").stat().st_size > 10000
