# SPDX-License-Identifier: Apache-2.0
"""Solid elements of decks that are inverted at a corner, or where they are integrated."""

import pytest

MODEL = """
buckens: 1
bodies:
  block:
    mesh: {file: block.inp, length-unit: m, mass-unit: kg}
"""


def write_cubes(path, *corners):
    """Unit cubes side by side whose last corner is at (t, t, t); elements 101, 102, …"""
    nodes, elements = [], []
    for k, t in enumerate(corners):
        places = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (t, t, t), (0, 1, 1)]
        first = len(nodes) + 1
        nodes += [f"{first + i}, {x}, {y - k}, {z}" for i, (x, y, z) in enumerate(places)]
        elements.append(f"{101 + k}, " + ", ".join(str(first + i) for i in range(8)))
    ties = []  # the cube behind hangs on the one before by the nodes of their common face
    for k in range(1, len(corners)):
        for a, b in ((0, 3), (1, 2)):
            for axis in (1, 2, 3):
                ties += ["*EQUATION", "2", f"{8 * k - 7 + a}, {axis}, 1., {8 * k + 1 + b}, {axis}, -1."]
    path.write_text("\n".join(
        ["*NODE", *nodes, "*ELEMENT, TYPE=C3D8, ELSET=ALL", *elements,
         "*SOLID SECTION, ELSET=ALL, MATERIAL=M", "*MATERIAL, NAME=M", "*ELASTIC", "2.1E11, 0.3",
         "*DENSITY", "7800.", *ties, ""]))


def test_a_bent_corner_is_told_and_used(buckens, tmp_path):
    write_cubes(tmp_path / "block.inp", 0.6)
    (tmp_path / "model.yaml").write_text(MODEL)
    told = buckens("mesh-info", "block.inp", "--length-unit", "m", "--json").must(0).json
    assert (told["inverted"], told["inverted_at_nodes"]) == ([], [101])
    assert any("at a corner, though not where it is integrated: 101" in text for text in told["warnings"])
    checked = buckens("check", "model.yaml", "--json").must(0)
    # The volume is 1 - (3/4)(1 - t).
    assert checked.json["bodies"]["block"]["mass"] == pytest.approx(0.7 * 7800, rel=1e-12)
    assert "101" in checked.out + checked.err


def test_what_cannot_be_integrated_is_refused_by_its_number(buckens, tmp_path):
    write_cubes(tmp_path / "block.inp", 1.0, 0.3, 0.2)
    (tmp_path / "model.yaml").write_text(MODEL)
    told = buckens("mesh-info", "block.inp", "--length-unit", "m", "--json").must(0).json
    assert (told["inverted"], told["inverted_at_nodes"]) == ([102, 103], [])
    refused = buckens("check", "model.yaml")
    assert refused.code != 0
    for word in ("solid element 102 (hex8)", "and so are 103", "where it is integrated", "move a node"):
        assert word in refused.err
