# SPDX-License-Identifier: Apache-2.0
"""Decks of Nastran through the program."""

import csv
import math

import numpy
import pytest

from conftest import SOURCE

DECKS = SOURCE / "tests" / "decks" / "nastran"
SIZE, DIVISIONS = (0.3, 0.04, 0.05), (6, 1, 2)

BOX = """
buckens: 1
bodies:
  block:
    mesh:
      box: {size: [0.3 m, 0.04 m, 0.05 m], divisions: [6, 1, 2]}
      material: {E: 210 GPa, nu: 0.3, rho: 7850 kg/m^3}
"""

FILE = """
buckens: 1
bodies:
  block:
    mesh: {file: block.bdf, length-unit: mm}
"""


def write_card(form, name, *fields):
    fields = ["" if field is None else str(field) for field in fields]
    width, per_line = {"small": (8, 8), "large": (16, 4), "free": (0, 8)}[form]
    rows = [fields[k:k + per_line] for k in range(0, len(fields), per_line)]
    if form == "free":
        return "".join(",".join([name if k == 0 else ""] + row) + "\n"
                       for k, row in enumerate(rows))
    star = "*" if form == "large" else ""
    heads = [name + star] + [star or "+"] * (len(rows) - 1)
    return "".join(head.ljust(8) + "".join(field.ljust(width) for field in row) + "\n"
                   for head, row in zip(heads, rows))


def box_deck(form, unit=1000.0, stress="2.1+5", density="7.85-9"):
    """The box of BOX in millimetres and tonnes, numbered from 1, x fastest."""
    nx, ny, nz = (n + 1 for n in DIVISIONS)
    deck = "SOL 103\nCEND\nSET 5 = 1, 8 THRU 15\nBEGIN BULK\n"
    for k in range(nx * ny * nz):
        place = (k % nx, k // nx % ny, k // (nx * ny))
        x = [f"{unit * size * i / n:.4f}" for i, size, n in zip(place, SIZE, DIVISIONS)]
        deck += write_card(form, "GRID", k + 1, None, *x)
    number = 0
    for z in range(DIVISIONS[2]):
        for y in range(DIVISIONS[1]):
            for x in range(DIVISIONS[0]):
                a = 1 + x + nx * (y + ny * z)
                ring = [a, a + 1, a + 1 + nx, a + nx]
                number += 1
                deck += write_card(form, "CHEXA", number, 1, *ring, *(b + nx * ny for b in ring))
    deck += write_card(form, "PSOLID", 1, 1)
    deck += write_card(form, "MAT1", 1, stress, None, ".3", density)
    return deck + "ENDDATA\n"


@pytest.fixture
def solved(buckens, tmp_path):
    """Mass properties and free-free frequencies of a body."""
    def call(model, count=9):
        (tmp_path / "model.yaml").write_text(model)
        body = buckens("check", "model.yaml", "--json").must(0).json["bodies"]["block"]
        modes = buckens("modes", "model.yaml", "--count", count, "--json").must(0).json
        return body, numpy.array([mode["frequency"] for mode in modes["analyses"][0]["modes"]])

    return call


@pytest.mark.parametrize("form", ["small", "large", "free"])
def test_a_box_is_the_same_as_a_deck(solved, tmp_path, form):
    (tmp_path / "block.bdf").write_text(box_deck(form))
    body, found = solved(FILE)
    expected_body, expected = solved(BOX)
    assert body["mass"] == pytest.approx(expected_body["mass"], rel=1e-12)
    assert body["principal_inertia"] == pytest.approx(expected_body["principal_inertia"], rel=1e-12)
    # Coordinates such as 33.3333 do not occur: all divide evenly, so only rounding remains.
    assert found == pytest.approx(expected, rel=1e-9)


def test_decks_with_weights_in_inches(solved, tmp_path):
    # lbf, inch: PARAM,WTMASS turns weight into slinch.
    inch, psi, g = 0.0254, 6894.757293168, 386.0885826772
    stress, weight = 210e9 / psi, 7850 / 175.126835246 * inch**3 * g
    deck = box_deck("large", 1 / inch, f"{stress:.9E}", f"{weight:.9E}")
    deck = deck.replace("ENDDATA", f"PARAM,WTMASS,{1 / g:.6E}\nENDDATA")
    (tmp_path / "block.bdf").write_text(deck)
    body, found = solved(FILE.replace("length-unit: mm", "length-unit: in, mass-unit: slinch"))
    expected_body, expected = solved(BOX)
    # Four decimals of coordinates in inches: 2e-5 of the height.
    assert body["mass"] == pytest.approx(expected_body["mass"], rel=1e-4)
    assert found == pytest.approx(expected, rel=1e-4)


def test_sets_are_interfaces(buckens, tmp_path):
    (tmp_path / "block.bdf").write_text(box_deck("free"))
    (tmp_path / "model.yaml").write_text(FILE + """
    interfaces: {end: {set: [SET 5]}}
joints:
  weld: {fixed: {between: [ground, block/end]}}
simulation: {duration: 1 ms, step: 0.5 ms}
""")
    buckens("check", "model.yaml").must(0)


def test_names_of_comments_choose_materials(solved, buckens, tmp_path):
    deck = '$HMNAME PROP                   1"beam" 4\n' + box_deck("small")
    (tmp_path / "block.bdf").write_text(deck)
    heavy = FILE.replace("length-unit: mm", "length-unit: mm, materials: {beam: heavy}") + """
materials:
  heavy: {E: 210 GPa, nu: 0.3, rho: 15700 kg/m^3}
"""
    body, found = solved(heavy)
    expected_body, expected = solved(BOX)
    assert body["mass"] == pytest.approx(2 * expected_body["mass"], rel=1e-12)
    # Twice the mass; rounding as above.
    assert math.sqrt(2) * found == pytest.approx(expected, rel=1e-9)
    (tmp_path / "model.yaml").write_text(heavy.replace("{beam:", "{bean:"))
    buckens("check", "model.yaml").must(2, "bean", 'Did you mean "beam"?')


@pytest.mark.parametrize("change, words", [
    (lambda deck: deck.replace("GRID,7,", "GRID,7000,"), ["CHEXA 6", "there is no GRID 7"]),
    (lambda deck: deck.replace("2.1+5", "nan"), ["block.bdf:", "MAT1 1, field 3", '"nan"']),
    (lambda deck: deck[:deck.index("CHEXA,7") + 20], ["block.bdf:", "CHEXA 7", "is blank"]),
    (lambda deck: deck[:deck.index("CHEXA,1")], ["block.bdf", "no elements", "complete"]),
    (lambda deck: deck.replace("ENDDATA", "INCLUDE 'block.bdf'"), ["block.bdf:", "must not include each other"]),
    (lambda deck: deck.replace("ENDDATA", "CSHEAR,99"), ["block.bdf:", "shear panels", "skip: [CSHEAR]"]),
    (lambda deck: "\x00\x01\x02" + deck, ["block.bdf:1:1", "zero byte"]),
    (lambda deck: "", ["block.bdf", "no nodes"]),
], ids=["missing node", "nan", "truncated", "without elements", "cycle", "refused card", "binary", "empty"])
def test_bad_decks_say_where(buckens, tmp_path, change, words):
    (tmp_path / "block.bdf").write_text(change(box_deck("free")))
    (tmp_path / "model.yaml").write_text(FILE)
    buckens("check", "model.yaml").must(2, *words)


def test_a_mean_takes_the_components_that_count(solved, buckens, tmp_path):
    # A mass that follows the four corners of the end face, at their middle.
    corners = [7 * (k + 1) for k in (0, 1, 4, 5)]
    more = write_card("free", "GRID", 900, None, "300.", "20.", "25.")
    more += write_card("free", "CONM2", 901, 900, None, "1.-3")

    def write_mean(*fields):
        card = write_card("free", "RBE3", *fields)
        (tmp_path / "block.bdf").write_text(
            box_deck("free").replace("ENDDATA", more + card + "ENDDATA"))
    write_mean(902, None, 900, 123456, "1.", 123, *corners)
    _, full = solved(FILE)
    # In the middle the mean displacement needs no rotation, so single components give the same result.
    write_mean(902, None, 900, 123, "1.", 1, *corners, "1.", 2, *corners, "1.", 3, *corners)
    _, same = solved(FILE)
    assert same == pytest.approx(full, rel=1e-9)
    write_mean(902, None, 900, 123456, "1.", 1, *corners)
    buckens("check", "model.yaml").must(3, "RBE3 902", "do not determine the displacement along y")


def test_a_missing_deck_is_named(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(FILE)
    buckens("check", "model.yaml").must(2, "model.yaml:5", "block.bdf", "there is no such file")


PLATE = "plate_bdf/plate_bdf"


def test_the_plate_vibrates_as_leissa_says(buckens):
    report = buckens("modes", SOURCE / "examples" / f"{PLATE}.yaml", "--count", 6, "--json").must(0)
    found = [mode["frequency"] for mode in report.json["analyses"][0]["modes"]]
    # Leissa (1973), free rectangle with sides as 3 to 2, nu = 0.3: omega a^2 sqrt(rho h / D).
    leissa = numpy.array([20.128, 21.603, 46.654, 50.293, 58.201, 67.494])
    stiffness, mass = 210e9 * 0.004**3 / (12 * (1 - 0.3**2)), 7850 * 0.004
    expected = leissa / (2 * math.pi * 0.6**2) * math.sqrt(stiffness / mass)
    # 18 x 12 elements: 0.7 % at the sixth shape, less before; it goes with h^2.
    assert found == pytest.approx(expected, rel=1e-2)


def test_the_plate_swings_as_a_pendulum(buckens, tmp_path):
    buckens("run", SOURCE / "examples" / f"{PLATE}.yaml", "-o", "out").must(0)
    rows = list(csv.reader((tmp_path / "out" / "sensors.csv").open()))
    values = {name.split(" [")[0]: column
              for name, column in zip(rows[0], numpy.array(rows[1:], dtype=float).T)}
    # A rigid plate passes the lowest point after sqrt(2a/3g) K(sin 45 deg).
    fall = math.sqrt(2 * 0.6 / (3 * 9.81)) * 1.8540746773
    x = numpy.interp(fall, values["t"], values["edge.x"])
    # The plate bends by 0.15 mm during the motion.
    assert abs(x) < 2e-4
    assert values["edge.z"].min() == pytest.approx(-0.6, abs=2e-4)
