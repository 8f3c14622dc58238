# SPDX-License-Identifier: Apache-2.0
"""Shells with nodes on their sides, generated and from decks, through the program."""

import base64
import csv
import math

import h5py
import numpy
import pytest
import vtk

from conftest import MODELS, SOURCE
from test_page_shapes import page_of, view  # noqa: F401

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
    # Half a unit of the last digit; shear and rotary inertia; and the error of four elements on a side, of
    # fourth order of the wave number k, as in shell_benchmark_test.
    for k, exact in enumerate(FV12):
        squared = 2 * math.pi * exact * math.sqrt(8000 * 0.05 / (200e9 * 0.05**3 / 12 / 0.91))
        certain = 0.0005 / exact + 0.185 * squared * 0.05**2
        assert found[k] == pytest.approx(exact, rel=certain + 0.004 * (squared * 2.5**2)**2)
    # The same mesh by other ways: equal but for the order of the nodes, and so for the rounding that a
    # plate of a two hundredth has, and the 1e-7 to which modes are iterated.
    assert frequencies(buckens, "deck.yaml") == pytest.approx(found, rel=1e-6)
    (tmp_path / "plate.bdf").write_text(as_nastran((tmp_path / "plate.inp").read_text()))
    (tmp_path / "bulk.yaml").write_text(DECK.replace("plate.inp", "plate.bdf"))
    assert frequencies(buckens, "bulk.yaml") == pytest.approx(found, rel=1e-6)


def test_one_s8r_of_a_deck_is_a_body(buckens, tmp_path):
    (tmp_path / "plate.inp").write_text((SOURCE / "tests/decks/abaqus/foreign/s8.inp").read_text())
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
    # cannot represent the shape, but quadratic deflections come within a few per cent.
    D = 2.1e11 * 0.01**3 / 12 / 0.91
    lowest = 13.468 * math.sqrt(D / (7800 * 0.01)) / (2 * math.pi)
    assert frequencies(buckens, "model.yaml", 1)[0] == pytest.approx(lowest, rel=0.1)


@pytest.mark.parametrize("kind, nodes, cell, pieces", [("quad8", 18 + 25, 23, 5), ("tri6", 18 + 33, 22, 4)])
def test_a_strip_has_the_stresses_of_a_beam(buckens, page_of, tmp_path, kind, nodes, cell, pieces):
    (tmp_path / "model.yaml").write_text((MODELS / "strip.yaml").read_text().replace("quad4", kind))
    buckens("run", "model.yaml", "-o", "out", "-q").must(0)
    with h5py.File(tmp_path / "out" / "results.h5", "r", swmr=True) as file:
        force = file["fields/bodies/strip/shells/section_force"][-1]
        stress = file["fields/bodies/strip/nodes/stress"][-1]
        at = file["fields/bodies/strip/nodes/von_mises"][-1]
        place = file["geometry/bodies/strip/nodes"][:]
    N, M, T = 20 / 0.1, 0.01 / 0.1, 0.01
    # The pull acts on the deflected tip; forces at the ends do not stand as stresses do, but that is
    # forgotten in the middle, four widths away.
    arm = N / (2 * 210e9 * T**3 / 12)
    middle = slice(len(force) // 2 - 1, len(force) // 2 + 1)
    assert force[middle, 0] == pytest.approx(N, rel=1e-4)
    assert force[middle, 3] == pytest.approx(M, rel=1e-4 + arm)
    assert len(stress) == len(place) == nodes
    inner = numpy.abs(place[:, 0] - place[:, 0].mean()) < 0.13
    assert inner.sum() >= 8
    assert stress[inner, 0] == pytest.approx(N / T + 6 * M / T**2, rel=1e-4 + arm)
    assert at[inner] == pytest.approx(N / T + 6 * M / T**2, rel=1e-4 + arm)
    # Exported files: the cells as they are, with the plate's area; the page: their pieces.
    buckens("export", "out", "--vtk", "--csv", "--glb").must(0)
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(sorted((tmp_path / "out" / "export").glob("*.vtu"))[-1]))
    reader.Update()
    grid = reader.GetOutput()
    assert {grid.GetCellType(c) for c in range(grid.GetNumberOfCells())} == {cell}
    body = page_of("out")[0]["bodies"][0]
    faces = numpy.frombuffer(base64.b64decode(body["faces"]), dtype="<i4").reshape(-1, 4)
    assert len(faces) == pieces * len(force)


LOADED = """
buckens: 1
gravity: [0, 0, -9.81]
bodies:
  flap:
    mesh:
      plate: {from: [0, -0.1 m, 0], size: [0.5 m, 0.2 m], divisions: [4, 2], thickness: 5 mm, element: quad8}
      material: {E: 70 GPa, nu: 0.3, rho: 2700}
    interfaces: {root: {set: [x0], kind: rigid}}
joints:
  wall: {fixed: {between: [ground, flap/root]}}
loads:
  push: {pressure: {on: flap/top, value: 500 Pa}}
initial: {start: static}
simulation: {duration: 1 us, step: 1 us}
output:
  every: 1 us
  sensors: {tip: {position: flap/edge_x1}}
"""


@pytest.mark.parametrize("kind", ["quad8", "tri6"])
def test_a_flap_hangs_under_pressure_and_weight(buckens, tmp_path, kind):
    (tmp_path / "model.yaml").write_text(LOADED.replace("quad8", kind))
    buckens("run", "model.yaml", "-o", "out", "-q").must(0)
    rows = list(csv.DictReader((tmp_path / "out" / "sensors.csv").open()))
    drop = -float(next(value for key, value in rows[-1].items() if key.startswith("tip.z")))
    # Between a plate that cannot become narrower at its clamped root and a beam that can.
    beam = (500 + 2700 * 9.81 * 0.005) * 0.5**4 / (8 * 70e9 * 0.005**3 / 12)
    assert (1 - 0.3**2) * beam < drop < beam
