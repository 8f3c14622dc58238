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


def test_rigid_elements_turn_no_node_that_has_springs_alone(body):
    """Six components of three nodes lead a fourth, which carries a mass by springs: nothing there has rotations."""
    deck = stick("GRID,9,,0.,1.,0.\nGRID,10,,0.,1.,0.\nCONM2,14,10,,5.\n"
                 "CELAS2,5,1.E6,9,1,10,1\nCELAS2,6,2.E6,9,2,10,2\nCELAS2,7,3.E6,9,3,10,3\n"
                 "CRIGD3,8,1,123,2,23,3,3\n,MSET,9,{}\n")
    whole, moved = body(deck.format("123456")), body(deck.format("123"))
    assert whole["frequencies"] == pytest.approx(moved["frequencies"], rel=1e-12)


def test_links_that_leave_nothing_to_deform(body):
    """The stiffness of the beams is rounding then, which is no spring to ground."""
    deck = stick("RBE2,5,1,123456,2,3\n").replace("1.,1.,0.", "1.3,1.7,.9").replace("GRID,4,,1.,0.,0.2\n", "")
    body(deck, code=3).must(3, 'body "b": rigid links hold all of its nodes together', "mass: 30 kg", "[0.766667, 0.566667, 0.3]",
                            "take nodes out")


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


def two_cubes(between):
    """A cube from 0 to 1 m and one from 1 to 2 m, of steel, and what joins nodes 2, 3, 6, 7 to 9, 12, 13, 16."""
    second = "".join(f"GRID,{i + 9},,{1 + x}.,{y}.,{z}.\n" for i, (x, y, z) in enumerate(
        [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]))
    return (CUBE + second + "CHEXA,1,1,1,2,3,4,5,6\n,7,8\nCHEXA,2,1,9,10,11,12,13,14\n,15,16\nPSOLID,1,1\n"
            "MAT1,1,2.1E11,,0.3,7850.\n" + between + "ENDDATA\n")


def test_springs_that_turn_nodes_of_solids_turn_them_freely(body, buckens):
    """At one place moments go nowhere; with an arm between, the end on the solid follows like a ball joint."""
    pairs = [(2, 9), (3, 12), (6, 13), (7, 16)]

    def bushes(stiffness):
        cards = "".join(f"CBUSH,{20 + i},7,{a},{b},,,,0\n" for i, (a, b) in enumerate(pairs))
        return two_cubes(cards + f"PBUSH,7,K,{stiffness}\n")

    turning = body(bushes("1.E8,2.E8,3.E8,4.E7,4.E7,4.E7"))
    plain = body(bushes("1.E8,2.E8,3.E8"))
    assert turning["frequencies"] == pytest.approx(plain["frequencies"], rel=1e-9)
    told = buckens("check", "model.yaml").must(0).out
    assert "springs act on the rotations" not in told
    body(bushes("1.E8,2.E8,3.E8,4.E7,4.E7,4.E7"))
    assert "4 springs act on the rotations of nodes of solids" in buckens("check", "model.yaml").must(0).out

    # A beam on the far side has rotations; the spring in the middle of the arm L then is, seen from the solid,
    # 1/(1/k + (L/2)²/k_θ) at its node.
    k, turn, gap = 2e7, 3e6, 0.5

    def with_beam(cards):
        return (CUBE + f"GRID,9,,{1 + gap},0.,0.\nGRID,10,,{2 + gap},0.,0.\nGRID,11,,{1 + gap},1.,0.\n"
                "CHEXA,1,1,1,2,3,4,5,6\n,7,8\nPSOLID,1,1\nMAT1,1,2.1E11,,0.3,7850.\n"
                "CBAR,3,3,9,10,0.,0.,1.\nCBAR,4,3,9,11,0.,0.,1.\nPBAR,3,1,1.E-2,1.E-5,2.E-5,3.E-5\n" + cards
                + f"CBUSH,21,8,3,11,,,,0\n,0.\nCBUSH,22,8,6,9,,,,0\n,0.\nPBUSH,8,K,1.E7,1.E7,1.E7\nENDDATA\n")

    soft = 1 / (1 / k + (gap / 2)**2 / turn)
    one = body(with_beam(f"CBUSH,20,7,2,9,,,,0\n,.5\nPBUSH,7,K,{k},{k},{k},{turn},{turn},{turn}\n"))
    other = body(with_beam(f"CBUSH,20,7,2,9,,,,0\n,0.\nPBUSH,7,K,{k},{soft!r},{soft!r}\n"))
    assert one["frequencies"] == pytest.approx(other["frequencies"], rel=1e-8)


def test_nodes_that_nothing_holds_in_some_directions_follow_the_body(body, buckens):
    """A mean of one direction, and a node on springs along two: neither changes a frequency."""
    tied = "RBE2,5,2,123,9\nRBE2,6,3,123,12\nRBE2,7,6,123,13\nRBE2,8,7,123,16\n"
    bare = body(two_cubes(tied))["frequencies"]
    loose = body(two_cubes(tied + "GRID,30,,2.5,.5,.5\nRBE3,31,,30,1,1.,123,10,11\n,14,15\n"
                           "GRID,40,,2.,0.,0.\nCELAS2,41,1.E6,10,1,40,1\nCELAS2,42,1.E6,10,2,40,2\n"))
    assert loose["frequencies"] == pytest.approx(bare, rel=1e-6)
    assert "move or turn in some directions without mass or stiffness" in buckens("check", "model.yaml").must(0).out
    # Nodes on one line tell no rotation about it, but those of beams have it themselves.
    rotor = ("GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,2.,0.,0.\nCBAR,1,1,1,2,0.,1.,0.\nCBAR,2,1,2,3,0.,1.,0.\n"
             "PBAR,1,1,1.E-3,1.E-6,1.E-6,2.E-6\nMAT1,1,2.1E11,,0.3,7850.\n{}ENDDATA\n")
    bearing = "GRID,9,,0.,0.,0.\nCELAS2,9,1.E6,1,2,9,2\nCELAS2,10,1.E6,1,3,9,3\nRBE2,11,3,123456,12\nGRID,12,,2.1,.1,.2\n"
    assert body(rotor.format(bearing))["frequencies"] == pytest.approx(body(rotor.format(""))["frequencies"], rel=1e-6)


def test_shells_and_solids_without_some_mid_side_nodes(body, buckens):
    deck = ("GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,1.,0.\nGRID,4,,0.,1.,0.\nGRID,5,,.5,0.,0.\nGRID,6,,1.,.5,0.\n"
            "GRID,7,,.5,1.,0.\nGRID,8,,2.,0.,0.\nGRID,9,,2.,1.,0.\nPSHELL,1,1,.02,1\nMAT1,1,2.1E11,,0.3,7850.\n"
            "CQUAD8,1,1,1,2,3,4,5,{}\n,7,{}\nCQUAD4,2,1,2,8,9,3\nENDDATA\n")
    mixed = body(deck.format("", ""))
    assert mixed["mass"] == pytest.approx(7850 * 0.02 * 2, rel=1e-9)
    told = buckens("mesh-info", "deck.bdf").must(0).out
    assert "edges without a mid-side node are straight and move linearly" in told
    # Nearly as a plate of four quadratic elements of the same size: between the coarse mesh and it.
    assert 0.8 < mixed["frequencies"][0] / body(deck.replace("CQUAD4,2,1,2,8,9,3", "CQUAD8,2,1,2,8,9,3,,\n,,6")
                                                 .format("6", ""))["frequencies"][0] < 1.25
