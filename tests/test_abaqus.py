# SPDX-License-Identifier: Apache-2.0
"""Decks of Abaqus and CalculiX, through the program."""

import csv
import math

import numpy
import pytest

from conftest import SOURCE

BRACKET = SOURCE / "examples" / "bracket_inp"
BRACKET_MODEL = "bracket_inp/bracket_inp"

BOX = """
buckens: 1
bodies:
  block:
    mesh:
      box: {from: [10 mm, 0, 0], size: [100 mm, 20 mm, 30 mm], divisions: [8, 2, 2]}
      material: {E: 210 GPa, nu: 0.3, rho: 7850 kg/m^3}
"""

DECK_MODEL = """
buckens: 1
bodies:
  block:
    mesh: {file: block.inp, length-unit: mm}
"""


def write_block(path, element="C3D8I", extra=""):
    """The block of BOX as a deck in mm and tonnes."""
    number, lines, solids = {}, [], []
    for i in range(9):
        for j in range(3):
            for k in range(3):
                number[i, j, k] = len(number) + 1
                lines.append(f"{number[i, j, k]}, {10 + 12.5 * i}, {10 * j}, {15 * k}")
    for i in range(8):
        for j in range(2):
            for k in range(2):
                corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0),
                           (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
                nodes = [number[i + a, j + b, k + c] for a, b, c in corners]
                solids.append(f"{len(solids) + 1}, " + ", ".join(map(str, nodes)))
    path.write_text("\n".join(
        ["*HEADING", "block", "*NODE, NSET=ALL", *lines, f"*ELEMENT, TYPE={element}, ELSET=BLOCK",
         *solids, "*SOLID SECTION, ELSET=BLOCK, MATERIAL=STEEL", "*MATERIAL, NAME=STEEL", "*ELASTIC",
         "210000., 0.3", "*DENSITY", "7.85E-9", "*NSET, NSET=END, GENERATE", "1, 9, 1", extra, ""]))


def frequencies(buckens, model, count=8):
    report = buckens("modes", model, "--count", count, "--json").must(0).json
    return numpy.array([mode["frequency"] for mode in report["analyses"][0]["modes"]])


def columns(path):
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    table = numpy.array(rows[1:], dtype=float)
    return {name.split(" [")[0]: table[:, k] for k, name in enumerate(rows[0])}


def test_a_deck_gives_the_body_of_the_generated_box(buckens, tmp_path):
    write_block(tmp_path / "block.inp")
    (tmp_path / "deck.yaml").write_text(DECK_MODEL)
    (tmp_path / "box.yaml").write_text(BOX)
    deck, box = (buckens("check", name, "--json").must(0).json["bodies"]["block"]
                 for name in ("deck.yaml", "box.yaml"))
    assert deck["mass"] == pytest.approx(box["mass"], rel=1e-12)
    assert deck["mass"] == pytest.approx(7850 * 0.1 * 0.02 * 0.03, rel=1e-12)
    # Equal up to rounding: the eigenvalues agree to about 1e-12 times the spread of the spectrum.
    assert numpy.abs(frequencies(buckens, "deck.yaml") / frequencies(buckens, "box.yaml")
                     - 1).max() < 1e-8


def test_reduced_integration_becomes_incompatible_modes(buckens, tmp_path):
    (tmp_path / "deck.yaml").write_text(DECK_MODEL)
    write_block(tmp_path / "block.inp", "C3D8R")
    first = frequencies(buckens, "deck.yaml", 3)
    write_block(tmp_path / "block.inp", "C3D8I")
    assert first == pytest.approx(frequencies(buckens, "deck.yaml", 3), rel=1e-12)


def test_materials_of_the_model_file_stand_above_those_of_the_deck(buckens, tmp_path):
    write_block(tmp_path / "block.inp")
    (tmp_path / "deck.yaml").write_text(DECK_MODEL.replace(
        "length-unit: mm", "length-unit: mm, materials: {BLOCK: aluminium}").replace(
            "bodies:", "materials: {aluminium: {E: 70 GPa, nu: 0.33, rho: 2700 kg/m^3}}\nbodies:"))
    body = buckens("check", "deck.yaml", "--json").must(0).json["bodies"]["block"]
    assert body["mass"] == pytest.approx(2700 * 0.1 * 0.02 * 0.03, rel=1e-12)


def test_mistakes_in_decks_are_named_with_file_and_line(buckens, tmp_path):
    (tmp_path / "deck.yaml").write_text(DECK_MODEL)
    write_block(tmp_path / "block.inp", extra="*ELEMENT, TYPE=C3D8\n99, 1, 2, 3\n")
    buckens("check", "deck.yaml").must(2, "block.inp:", "C3D8 has 8 nodes, found 3")
    write_block(tmp_path / "block.inp", extra="*INCLUDE, INPUT=block.inp\n")
    buckens("check", "deck.yaml").must(2, "block.inp:", "includes itself")
    (tmp_path / "block.inp").write_bytes(bytes(range(256)) * 100)
    buckens("check", "deck.yaml").must(2, "block.inp:1:1")


def test_the_bracket_follows_the_shaken_table(buckens, tmp_path):
    buckens("run", BRACKET / "bracket_inp.yaml", "-o", "out", "--quiet").must(0)
    run = columns(tmp_path / "out" / "sensors.csv")
    modes = buckens("modes", BRACKET / "bracket_inp.yaml", "--system", "--count", 1,
                    "--json").must(0).json
    first = modes["analyses"][0]["modes"][0]["frequency"]
    f, amplitude = 130.0, 1e-4
    late = run["t"] >= 0.04
    t = run["t"][late]
    waves = numpy.column_stack([numpy.sin(2 * numpy.pi * f * t), numpy.cos(2 * numpy.pi * f * t),
                                numpy.ones_like(t)])

    def swing(signal):
        (s, c, _), *_ = numpy.linalg.lstsq(waves, signal[late], rcond=None)
        return math.hypot(s, c)

    # Three periods of records, 38 to a period; what remains of the start-up oscillates at the bracket's
    # own frequency.
    assert swing(run["table.x"]) == pytest.approx(amplitude, rel=1e-3)
    # One mass on a spring: r²/(1 - r²) of the amplitude. The upright weighs half as much as the
    # device and moves with it; that and the higher modes add 5.5 percent.
    r2 = (f / first) ** 2
    bend = swing(run["edge.x"] - run["table.x"])
    assert bend == pytest.approx(amplitude * r2 / (1 - r2), rel=0.08)
