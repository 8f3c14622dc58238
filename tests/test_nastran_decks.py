# SPDX-License-Identifier: Apache-2.0
"""Decks as others write them: each gives the right result, or a message with the remedy."""

import math

import pytest

MODEL = """buckens: 1
materials: {steel: {E: 210 GPa, nu: 0.3, rho: 7850 kg/m^3}}
bodies:
  b:
    mesh: {file: deck.bdf, length-unit: m, mass-unit: kg%s}
"""

CUBE = "".join(f"GRID,{i + 1},,{x}.,{y}.,{z}.\n" for i, (x, y, z) in enumerate(
    [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]))


@pytest.fixture
def body(buckens, tmp_path):
    """The report of `check` on the body of a deck."""
    def call(deck, more="", code=0):
        (tmp_path / "deck.bdf").write_text(deck)
        (tmp_path / "model.yaml").write_text(MODEL % more)
        result = buckens("check", "model.yaml", "--json")
        result.must(code)
        return result.json["bodies"]["b"] if code == 0 else result

    return call


def test_a_shear_modulus_rounded_in_the_fifth_digit(body):
    deck = CUBE + "CHEXA,1,1,1,2,3,4,5,6\n,7,8\nPSOLID,1,1\nMAT1,1,1.E7,{},0.3,0.1\nENDDATA\n"
    rounded, exact = body(deck.format("3.8462E6")), body(deck.format(""))
    assert rounded["mass"] == pytest.approx(0.1, rel=1e-12)
    # Solids have the G of E and nu, to the last bit.
    assert rounded["frequencies"] == exact["frequencies"]


def stick(last):
    return ("GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,1.,0.\nGRID,4,,1.,0.,0.2\n"
            "CBAR,1,1,1,2,0.,0.,1.\nCBAR,2,1,2,3,0.,0.,1.\nPBAR,1,1,1.E-3,1.E-6,1.E-6,2.E-6\n"
            "MAT1,1,2.1E11,,0.3\nCONM2,11,1,,10.\nCONM2,12,2,,10.\nCONM2,13,3,,10.\n" + last + "ENDDATA\n")


def test_a_stick_model_with_a_rigid_bar(body):
    """Massless beams between point masses, one of them on an arm. The arm is the same as an offset of the mass."""
    with_bar = body(stick("RBAR,5,2,4,123456\nCONM2,14,4,,1.\n"))
    with_offset = body(stick("CONM2,14,2,,1.,0.,0.,0.2\n"))
    assert with_bar["mass"] == pytest.approx(31, rel=1e-12)
    # 10 kg at (0,0,0), (1,0,0), (1,1,0), 1 kg at (1,0,0.2).
    assert with_bar["com"] == pytest.approx([21 / 31, 10 / 31, 0.2 / 31], rel=1e-12)
    # Equal but for rounding, which condensation of the massless rotations multiplies by 1e4 or so.
    assert with_bar["frequencies"] == pytest.approx(with_offset["frequencies"], rel=1e-9)


def test_properties_and_materials_of_the_model_file(body):
    deck = CUBE + "CHEXA,1,1,1,2,3,4,5,6\n,7,8\nCQUAD4,2,5,1,2,3,4\nCBAR,3,6,1,2,0.,0.,1.\nPBAR,6,9,1.E-3\nENDDATA\n"
    body(deck, code=2).must(2, "PSOLID 1", "the deck has no PSOLID 1", "materials")
    body(deck, ", material: steel", code=2).must(2, "PSHELL 5", "the deck has no PSHELL 5", "thickness")
    whole = body(deck, ", material: steel, sections: {PSHELL 5: {thickness: 2 mm}}")
    assert whole["mass"] == pytest.approx(7850 * (1 + 2e-3 + 1e-3), rel=1e-12)


def test_scalar_springs_points_and_masses(body):
    """Two beams end at one place, where scalar springs hold them together, one of them over a scalar point."""
    deck = ("GRID,1,,0.,0.,0.\nGRID,2,,0.,0.,0.\nGRID,3,,1.,0.,0.\nGRID,4,,-1.,0.,0.\n"
            "CBAR,1,1,1,3,0.,0.,1.\nCBAR,2,1,4,2,0.,0.,1.\nPBAR,1,1,1.E-3,1.E-6,1.E-6,2.E-6\nMAT1,1,2.1E11,,0.3,7850.\n"
            "CELAS2,5,1.E6,1,2,2,2\nCELAS2,6,1.E6,1,3,2,3\nCELAS2,7,1.E6,1,4,2,4\nCELAS2,8,1.E6,1,5,2,5\n"
            "CELAS2,9,1.E6,1,6,2,6\nSPOINT,50\nCELAS2,10,{0},1,1,50\nCELAS2,11,{0},50,,2,1\n"
            "CMASS2,12,.5,3,1\nCMASS2,13,.5,3,2\nCMASS2,14,.5,3,3\nENDDATA\n")
    one = body(deck.format("2.E6"))
    plain = body(deck.format("2.E6").replace("SPOINT,50\nCELAS2,10,2.E6,1,1,50\nCELAS2,11,2.E6,50,,2,1",
                                             "CELAS2,10,1.E6,1,1,2,1"))
    assert one["mass"] == pytest.approx(2 * 7.85 + 0.5, rel=1e-12)
    assert one["frequencies"] == pytest.approx(plain["frequencies"], rel=1e-12)


def frame(turn, last, hinge_node, pins):
    """A square of four beams in a plane, turned in space; the first may have pins at its first end."""
    def vector(x, y, z):
        c, s = math.cos(turn), math.sin(turn)
        x, y = c * x - s * y, s * x + c * y
        y, z = c * y - s * z, s * y + c * z
        return f"{x!r},{y!r},{z!r}"

    corners = [(0, 0, 0), (1, 0, 0), (1, 1.5, 0), (0, 1.5, 0)]
    deck = "".join(f"GRID,{i + 1},,{vector(*p)}\n" for i, p in enumerate(corners)) + "GRID,5,,0.,0.,0.\n"
    for i in range(4):
        a = hinge_node if i == 0 else i + 1
        deck += f"CBAR,{i + 1},1,{a},{(i + 1) % 4 + 1},{vector(0, 0, 1)}\n" + (f",{pins}\n" if i == 0 else "")
    return deck + "PBAR,1,1,1.E-4,1.E-9,3.E-9,2.E-9\nMAT1,1,2.1E11,,0.3,7850.\n" + last + "ENDDATA\n"


def test_pins_release_in_the_axes_of_the_beam(body):
    """The same hinge by a second node that follows in all but the rotation about the normal, which is the beam's y."""
    stiff = body(frame(0, "", 1, ""))["frequencies"]
    tied = body(frame(0, "RBE2,9,1,12345,5\n", 5, ""))["frequencies"]
    assert max(abs(a / b - 1) for a, b in zip(tied, stiff)) > 0.05
    for turn in (0.0, 0.7):
        assert body(frame(turn, "", 1, "5"))["frequencies"] == pytest.approx(tied, rel=1e-8)


def test_a_deck_of_nastran_may_end_as_those_of_abaqus(buckens, tmp_path):
    """NASTRAN-95 names its decks so; pipes and directories are no decks of either kind."""
    (tmp_path / "deck.inp").write_text("SOL 1,0\nCEND\nBEGIN BULK\n" + CUBE
                                       + "CHEXA1,1,1,1,2,3,4,5,6\n,7,8\nMAT1,1,1.E7,,0.3,0.1\nENDDATA\n")
    told = buckens("mesh-info", "deck.inp", "--json").must(0).json
    assert told["format"] == "Nastran"
    assert told["mass"] == pytest.approx(0.1, rel=1e-12)
    buckens("mesh-info", "none.inp").must(5, "none.inp")
