# SPDX-License-Identifier: Apache-2.0
"""Meshes through `buckens convert`: the mesh and the model file beside it make the same body again."""

import pytest

STEEL = "*MATERIAL, NAME=STEEL\n*ELASTIC\n210000, 0.3\n*DENSITY\n7.85E-9\n"
WOOD = ("*MATERIAL, NAME=WOOD\n*ELASTIC, TYPE=ENGINEERING CONSTANTS\n12000, 900, 500, 0.4, 0.45, 0.6, 700, 650\n60\n"
        "*DENSITY\n0.5E-9\n*ORIENTATION, NAME=GRAIN\n0.8, 0.6, 0, -0.6, 0.8, 0\n3, 0.\n")

# Corners of one element and its edges, in the order of mid-side nodes.
TET = ([(0, 0, 0), (50, 4, 0), (6, 40, 2), (8, 9, 45)], [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)])
WEDGE = ([(0, 0, 0), (50, 4, 0), (6, 40, 2), (2, 1, 30), (54, 2, 33), (7, 43, 31)],
         [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)])
HEX = ([(0, 0, 0), (60, 2, 0), (62, 35, 1), (1, 33, 2), (0, 1, 25), (61, 0, 27), (64, 36, 26), (3, 34, 25)],
       [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)])
SOLIDS = {"C3D4": (TET, False), "C3D10": (TET, True), "C3D6": (WEDGE, False), "C3D15": (WEDGE, True),
          "C3D8": (HEX, False), "C3D8I": (HEX, False), "C3D20": (HEX, True)}


def solid_deck(kind, material="STEEL", more=""):
    (corners, edges), is_quadratic = SOLIDS[kind]
    places = [tuple(map(float, c)) for c in corners]
    if is_quadratic:
        places += [tuple(0.5 * (p + q) for p, q in zip(corners[a], corners[b])) for a, b in edges]
    nodes = "".join(f"{k + 1}, {x}, {y}, {z}\n" for k, (x, y, z) in enumerate(places))
    ids = [str(k + 1) for k in range(len(places))]
    rows = ",\n".join(", ".join(ids[k:k + 10]) for k in range(0, len(ids), 10))
    return (f"*NODE\n{nodes}*ELEMENT, TYPE={kind}, ELSET=PART\n7, {rows}\n"
            f"*SOLID SECTION, ELSET=PART, MATERIAL={material}{more}\n" + (STEEL if material == "STEEL" else WOOD))


GRID = "*NODE\n" + "".join(f"{1 + i + 4 * j}, {20.0 * i}, {15.0 * j}, {2.0 * i * j}\n" for j in range(3) for i in range(4))
QUADS = "".join(f"{10 + i + 3 * j}, {1 + i + 4 * j}, {2 + i + 4 * j}, {6 + i + 4 * j}, {5 + i + 4 * j}\n"
                for j in range(2) for i in range(3))
S4 = GRID + "*ELEMENT, TYPE=S4, ELSET=SKIN\n" + QUADS
LINE = "*NODE\n" + "".join(f"{k + 1}, {25.0 * k}, {3.0 * k}, 0.\n" for k in range(5))
B31 = LINE + "*ELEMENT, TYPE=B31, ELSET=SPAR\n" + "".join(f"{k}, {k}, {k + 1}\n" for k in range(1, 5))
BEAM = B31 + "*BEAM SECTION, ELSET=SPAR, SECTION={}, MATERIAL=STEEL\n{}\n0., 0.3, 1.\n" + STEEL

DECKS = {kind: solid_deck(kind) for kind in SOLIDS}
DECKS |= {
    "oriented": solid_deck("C3D20", "WOOD", ", ORIENTATION=GRAIN"),
    "two materials": "*NODE\n" + "".join(f"{k + 1}, {30.0 * (k // 4)}, {(0., 20., 20., 0.)[k % 4]}, {(0., 0., 9., 9.)[k % 4]}\n"
                                         for k in range(12))
    + "*ELEMENT, TYPE=C3D8I, ELSET=ALL\n1, 1, 2, 3, 4, 5, 6, 7, 8\n2, 5, 6, 7, 8, 9, 10, 11, 12\n"
    + "*ELSET, ELSET=END\n2\n*SOLID SECTION, ELSET=ALL, MATERIAL=STEEL\n*SOLID SECTION, ELSET=END, MATERIAL=LIGHT\n"
    + STEEL + "*MATERIAL, NAME=LIGHT\n*ELASTIC\n70000, 0.3\n*DENSITY\n2.7E-9\n",
    "shell with offset": S4 + "*SHELL SECTION, ELSET=SKIN, MATERIAL=STEEL, OFFSET=SPOS\n1.5\n" + STEEL,
    "triangles": GRID + "*ELEMENT, TYPE=S3, ELSET=SKIN\n1, 1, 2, 6\n2, 1, 6, 5\n3, 2, 3, 6\n4, 3, 7, 6\n"
    "*SHELL SECTION, ELSET=SKIN, MATERIAL=STEEL\n1.5\n" + STEEL,
    "laminate": S4 + "*SHELL SECTION, ELSET=SKIN, COMPOSITE, ORIENTATION=GRAIN, OFFSET=0.25\n1., 3, WOOD, 0.\n"
    "2., 3, WOOD, 60.\n0.5, 3, STEEL, 0.\n" + WOOD + STEEL,
    "rectangle": BEAM.format("RECT", "4., 9."), "pipe": BEAM.format("PIPE", "5., 1."),
    "circle": BEAM.format("CIRC", "3."), "box": BEAM.format("BOX", "9., 6., 1., 1., 1., 1."),
    "ribs": S4 + "*ELEMENT, TYPE=B31, ELSET=RIBS\n31, 5, 6\n32, 6, 7\n33, 7, 8\n"
    "*SHELL SECTION, ELSET=SKIN, MATERIAL=STEEL\n1.5\n*BEAM SECTION, ELSET=RIBS, SECTION=RECT, MATERIAL=STEEL\n"
    "2., 5.\n0., 1., 0.\n" + STEEL,
    "point masses": BEAM.format("CIRC", "3.") + "*ELEMENT, TYPE=MASS, ELSET=TIP\n21, 5\n*MASS, ELSET=TIP\n2.E-5\n"
    "*ELEMENT, TYPE=ROTARYI, ELSET=TURN\n22, 4\n*ROTARY INERTIA, ELSET=TURN\n0.01, 0.02, 0.03\n",
    "kinematic coupling": S4.replace("*ELEMENT", "99, 80., 10., 30.\n*ELEMENT", 1)
    + "*SHELL SECTION, ELSET=SKIN, MATERIAL=STEEL\n1.5\n" + STEEL +
    "*KINEMATIC COUPLING, REF NODE=99\n4, 1, 6\n8, 1, 6\n12, 1, 3\n*ELEMENT, TYPE=MASS, ELSET=TIP\n41, 99\n"
    "*MASS, ELSET=TIP\n3.E-5\n",
    "equation": BEAM.format("CIRC", "3.") + "*EQUATION\n2\n3, 6, 1., 2, 6, -1.\n",
}

NASTRAN = "BEGIN BULK\nMAT1,1,2.1+5,,.3,7.85-9\n" + "".join(
    f"GRID,{1 + i + 4 * j},,{20.0 * i},{15.0 * j},{2.0 * i * j}\n" for j in range(3) for i in range(4))
CQUADS = "".join(f"CQUAD4,{10 + i + 3 * j},5,{1 + i + 4 * j},{2 + i + 4 * j},{6 + i + 4 * j},{5 + i + 4 * j},25.\n"
                 for j in range(2) for i in range(3))
BULK = {
    "pyramid": "BEGIN BULK\nMAT1,1,2.1+5,,.3,7.85-9\nPSOLID,3,1\nGRID,1,,0.,0.,0.\nGRID,2,,40.,0.,0.\nGRID,3,,42.,35.,0.\n"
    "GRID,4,,0.,33.,0.\nGRID,5,,20.,15.,30.\nCPYRAM,1,3,1,2,3,4,5\nENDDATA\n",
    "composite": NASTRAN + "MAT8,2,1.4+5,1.+4,.3,5.+3,5.+3,3.+3,1.6-9\nPCOMP,5,,,,,,,SYM\n,2,.25,0.,YES,2,.25,70.,YES\n"
    + CQUADS + "ENDDATA\n",
    "bars and rods": NASTRAN + "PSHELL,5,1,1.5,1,,1\nPBAR,6,1,100.,800.,900.,1200.\nPROD,7,1,20.\n" + CQUADS
    + "CBAR,61,6,5,6,0.,0.,1.\nCBAR,62,6,6,7,0.,0.,1.\nCROD,71,7,1,7\nENDDATA\n",
    "offset mass": NASTRAN + "PSHELL,5,1,1.5,1,,1\n" + CQUADS + "CONM2,31,12,,.0002,1.,2.,3.,\n,.4,.01,.5,.02,.03,.6\nENDDATA\n",
    "spring": NASTRAN + "PSHELL,5,1,1.5,1,,1\n" + CQUADS + "CBUSH,41,40,1,12,,,,0\nPBUSH,40,K,1000.,2000.,3000.,4.+5,5.+5,6.+5\n"
    "ENDDATA\n",
    "mean motion": NASTRAN + "GRID,50,,10.,10.,20.\nPSHELL,5,1,1.5,1,,1\n" + CQUADS
    + "RBE3,52,,50,123456,1.,123,1,2\n,5,6\nCONM2,31,50,,.0002\nENDDATA\n",
}

CASES = [(name, "part.inp", deck) for name, deck in DECKS.items()]
CASES += [(name, "part.bdf", deck) for name, deck in BULK.items()]


def described(buckens, model):
    return buckens("check", model, "--json").must(0).json["bodies"]["part"]


@pytest.mark.parametrize("name, file, deck", CASES, ids=[case[0] for case in CASES])
def test_the_side_car_makes_the_same_body(buckens, tmp_path, name, file, deck):
    (tmp_path / file).write_text(deck)
    (tmp_path / "part.yaml").write_text(
        f"buckens: 1\nbodies: {{part: {{mesh: {{file: {file}, length-unit: mm}}}}}}\n")
    told = buckens("convert", file, "part.msh", "--length-unit", "mm", "--json").must(0).json
    assert told["model"] == "part.msh.yaml"
    assert "# Note" not in (tmp_path / "part.msh.yaml").read_text()
    assert not any("cannot be written to a Gmsh mesh" in note for note in told["notes"])
    first, last = (described(buckens, model) for model in ("part.yaml", "part.msh.yaml"))
    assert first["nodes"] == last["nodes"] and first["elements"] == last["elements"]
    assert first["dof"] == last["dof"]
    # Constants go through MPa and t and back as text with all digits; sums are in another order.
    for key in ("mass", "com", "principal_inertia"):
        assert last[key] == pytest.approx(first[key], rel=1e-11, abs=1e-15), key
    assert last["frequencies"] == pytest.approx(first["frequencies"], rel=1e-8), "of the body"
    told = [buckens("mesh-info", f, "--length-unit", "mm", "--json").must(0).json for f in (file, "part.msh")]
    assert told[0]["node_sets"].items() <= told[1]["node_sets"].items()
    # Lines on edges of shells are elements where a model gives them a section; else sets of nodes.
    lines = {name for name in told[0]["element_sets"] if name not in told[1]["element_sets"]}
    assert lines <= ({"RIBS", "PBAR 6"} & told[1]["node_sets"].keys())
    for name in told[0]["element_sets"].keys() - lines:
        assert told[1]["element_sets"][name] == told[0]["element_sets"][name], name


def test_what_no_file_holds_is_told(buckens, tmp_path):
    # Sections of one group in two orientations, and a spring in oblique axes.
    bulk = ("BEGIN BULK\nMAT1,1,2.1+5,,.3,7.85-9\nGRID,1,,0.,0.,0.\nGRID,2,,40.,0.,0.\nGRID,3,,80.,0.,0.\n"
            "PBARL,6,1,,BAR\n,4.,8.\nCBAR,1,6,1,2,0.,0.,1.\nCBAR,2,6,2,3,0.,1.,0.\n"
            "CORD2R,1,0,0.,0.,0.,0.,0.,1.\n,1.,1.,0.\nPBUSH,40,K,1000.,2000.,3000.\nCBUSH,41,40,1,3,,,,1\nENDDATA\n")
    (tmp_path / "part.bdf").write_text(bulk)
    told = buckens("convert", "part.bdf", "part.msh", "--length-unit", "mm").must(0)
    assert "turned in several ways" in told.out and "springs whose axes" in told.out
    assert "turned in several ways" in (tmp_path / "part.msh.yaml").read_text()
    told = buckens("convert", "part.bdf", "part.vtu", "--json").must(0).json
    assert any("springs cannot be stored in a .vtu file" in note for note in told["notes"])


def test_halves_of_quadratic_beams_get_numbers_of_their_own(buckens, tmp_path):
    deck = ("*NODE\n1, 0., 0., 0.\n2, 20., 0., 0.\n3, 40., 0., 0.\n*ELEMENT, TYPE=B32, ELSET=SPAR\n1, 1, 2, 3\n"
            "*BEAM SECTION, ELSET=SPAR, SECTION=CIRC, MATERIAL=STEEL\n3.\n0., 1., 0.\n" + STEEL)
    (tmp_path / "part.inp").write_text(deck)
    told = buckens("convert", "part.inp", "part.msh", "--length-unit", "mm").must(0)
    assert "are renumbered" in told.out
    assert described(buckens, "part.msh.yaml")["elements"] == 2
