# SPDX-License-Identifier: Apache-2.0
"""Decks of Abaqus and CalculiX as others write them: sets with numbers as names, parts without mass, omissions."""

import json
import math
import shutil

import numpy
import pytest

from conftest import SOURCE

DECKS = SOURCE / "tests" / "decks" / "abaqus" / "foreign"

MODEL = """
buckens: 1
bodies:
  b:
    mesh: {file: deck.inp, length-unit: m, mass-unit: kg OPTIONS}
"""

STEEL = "*MATERIAL,NAME=ST\n*ELASTIC\n2.1e11,.3\n*DENSITY\n7800\n"


@pytest.fixture
def model(tmp_path):
    """Writes deck.inp and a model file that reads it."""
    def write(deck, options="", rest=""):
        if hasattr(deck, "read_text"):
            shutil.copyfile(deck, tmp_path / "deck.inp")
        else:
            (tmp_path / "deck.inp").write_text(deck)
        text = MODEL.replace(" OPTIONS", f", {options}" if options else "") + rest
        (tmp_path / "model.yaml").write_text(text)
        return "model.yaml"

    return write


def report(buckens, *arguments):
    return buckens("mesh-info", "deck.inp", *arguments, "--json").must(0).json


def block(size, origin=(0, 0, 0), divisions=(1, 1, 1), first_node=1, first_element=1, name="E"):
    """Nodes and C3D8 of a block as lines of a deck, and the numbers of its nodes by place."""
    number, nodes, solids = {}, [], []
    n = divisions
    for i in range(n[0] + 1):
        for j in range(n[1] + 1):
            for k in range(n[2] + 1):
                number[i, j, k] = first_node + len(number)
                x = [o + s * c / d for o, s, c, d in zip(origin, size, (i, j, k), n)]
                nodes.append(f"{number[i, j, k]}, " + ", ".join(map(repr, x)))
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    for i in range(n[0]):
        for j in range(n[1]):
            for k in range(n[2]):
                own = [number[i + a, j + b, k + c] for a, b, c in corners]
                solids.append(f"{first_element + len(solids)}, " + ", ".join(map(str, own)))
    lines = ["*NODE", *nodes, f"*ELEMENT,TYPE=C3D8I,ELSET={name}", *solids]
    return "\n".join(lines) + "\n", number


def frequencies(buckens, model, count):
    report = buckens("modes", model, "--count", count, "--json").must(0).json
    return numpy.array([mode["frequency"] for mode in report["analyses"][0]["modes"]])


def test_sets_whose_names_are_numbers_stand_above_elements_of_these_numbers(buckens, model):
    body = model(DECKS / "setnum.inp")
    told = report(buckens)
    assert {p["name"]: (p["material"], p["mass"]) for p in told["properties"]} == {
        "1": ("HEAVY", pytest.approx(1000)), "2": ("LIGHT", pytest.approx(1))}
    assert told["without_density"] == 0
    # 1000 kg with its centre at z = 0.5, 1 kg at z = 1.5.
    assert told["mass_centre"][2] == pytest.approx((500 + 1.5) / 1001, rel=1e-12)
    assert buckens("check", body, "--json").must(0).json["bodies"]["b"]["mass"] == pytest.approx(1001)
    body = model(DECKS / "setnum2.inp")
    told = report(buckens)
    # Set 2 contains elements 2 and 3, set 10 element 1; 3 is inside out, which is the fault.
    assert {p["name"]: p["elements"] for p in told["properties"]} == {"10": 1, "2": 2}
    assert told["inverted"] == [3]
    assert told["node_sets"] == {"5": 4, "TOP": 1}
    buckens("check", body).must(3, "element 3", "inverted or flat")


def test_layers_without_elastic_constants_keep_their_mass_and_ask_for_a_material(buckens, model):
    body = model(DECKS / "comp.inp")
    # 90 mm of 2350 kg/m³ and 10 mm of 7800 kg/m³ on a square metre.
    assert report(buckens)["mass"] == pytest.approx(0.09 * 2350 + 0.01 * 7800, rel=1e-12)
    buckens("check", body).must(2, "\"CO\"", "no elastic constants", "materials: {\"CO\":")
    body = model(DECKS / "comp.inp", "materials: {CO: {material: {E: 14 GPa, nu: 0.2, rho: 2350 kg/m^3}}}")
    told = buckens("check", body, "--json").must(0).json["bodies"]["b"]
    assert told["mass"] == pytest.approx(289.5, rel=1e-12)


def test_shells_of_second_order_have_mass_and_thickness(buckens, model):
    model(DECKS / "s8.inp")
    told = report(buckens)
    assert told["mass"] == pytest.approx(78, rel=1e-12)
    assert told["kinds"] == [{"kind": "quad8", "source": "S8R", "count": 1}]


def test_beams_weigh_what_the_deck_says(buckens, model):
    deck = ("*NODE\n1,0,0,0\n2,1,0,0\n3,2,0,0\n*ELEMENT,TYPE=B31,ELSET=E\n1,1,2\n2,2,3\n" + STEEL +
            "*BEAM SECTION,ELSET=E,MATERIAL=ST,SECTION=RECT\n.1,.2\n0,0,-1\n")
    body = model(deck)
    told = report(buckens)
    assert told["without_density"] == 0
    assert told["mass"] == pytest.approx(7800 * 0.02 * 2, rel=1e-12)
    assert buckens("check", body, "--json").must(0).json["bodies"]["b"]["mass"] == pytest.approx(
        told["mass"], rel=1e-12)


def test_one_side_makes_a_square(buckens, model):
    model("*NODE\n1,0,0,0\n2,1,0,0\n*ELEMENT,TYPE=B31,ELSET=E\n1,1,2\n" + STEEL +
          "*BEAM SECTION,ELSET=E,MATERIAL=ST,SECTION=RECT\n.1\n0,0,-1\n")
    told = report(buckens)
    assert told["mass"] == pytest.approx(7800 * 0.01, rel=1e-12)
    assert [n for n in told["notes"] if "the side of a square" in n]


def test_beams_of_i_section_and_rigid_tools_beside_them(buckens, model):
    h, b, t, web = 0.2, 0.1, 0.01, 0.006
    deck = ("*NODE\n1,0,0,0\n2,1,0,0\n3,2,0,0\n101,5,0,0\n102,6,0,0\n103,6,1,0\n"
            "*ELEMENT,TYPE=B31,ELSET=E\n1,1,2\n2,2,3\n*ELEMENT,TYPE=R3D3,ELSET=TOOL\n9,101,102,103\n" +
            STEEL + "*BEAM SECTION,ELSET=E,MATERIAL=ST,SECTION=I\n"
            f"{h / 2},{h},{b},{b},{t},{t},{web}\n0,0,-1\n"
            "*RIGID BODY,REF NODE=101,ELSET=TOOL\n*RIGID BODY,ANALYTICAL SURFACE=ROLL,REF NODE=102\n")
    body = model(deck)
    mass = buckens("check", body, "--json").must(0).json["bodies"]["b"]["mass"]
    assert mass == pytest.approx(7800 * 2 * (2 * b * t + (h - 2 * t) * web), rel=1e-9)
    assert "without mass or stiffness is left out" in " ".join(report(buckens)["notes"])


def test_surfaces_of_nodes_and_of_faces_may_share_a_name(buckens, model):
    deck, _ = block((1, 1, 1))
    model(deck + "*SURFACE,NAME=S,TYPE=NODE\n1,\n*SURFACE,NAME=S,TYPE=ELEMENT\n1,S1\n"
          "*SURFACE,NAME=T\n1,S3\n*SURFACE,NAME=BOTH,COMBINE=UNION\nS,T\n")
    told = report(buckens)
    assert told["node_sets"]["S"] == 1
    assert told["face_sets"]["BOTH"]["faces"] == 2
    assert told["face_sets"]["S"]["faces"] == 1 and told["face_sets"]["S"]["area"] == pytest.approx(1)


def test_what_has_mass_or_stiffness_is_left_out_on_request_only(buckens, model, tmp_path):
    deck, _ = block((1, 0.1, 0.1), divisions=(4, 1, 1))
    deck += ("*SOLID SECTION,ELSET=E,MATERIAL=ST\n" + STEEL +
             "*PLASTIC\n200e6,0\n*SURFACE INTERACTION,NAME=I\n*FRICTION\n.1\n"
             "*ELEMENT,TYPE=M3D4,ELSET=M\n101,1,5,6,2,\n*MEMBRANE SECTION,ELSET=M,MATERIAL=ST\n1e-3\n"
             "*NONSTRUCTURAL MASS,ELSET=E,UNITS=TOTAL MASS\n3.\n")
    body = model(deck)
    buckens("check", body).must(2, "deck.inp:", "M3D4", "membranes", "mesh: {skip: [M3D4]}")
    body = model(deck, "skip: [M3D4]")
    buckens("check", body).must(2, "deck.inp:", "*NONSTRUCTURAL MASS is not supported", "skip:")
    run = """
simulation: {duration: 1 ms, step: 1 ms}
"""
    body = model(deck, "skip: [M3D4, non structural mass, CELAS9]", run)
    told = report(buckens, "--skip", "M3D4,NONSTRUCTURAL MASS")
    assert told["mass"] == pytest.approx(78, rel=1e-12)
    assert [n for n in told["notes"] if "1 of M3D4 left out as requested by `skip`" in n]
    checked = buckens("check", body).must(0)
    words = checked.out + checked.err
    assert "1 of M3D4 left out" in words and "no \"CELAS9\" to leave out" in words
    # Contact, heat and the like are no reason for a warning.
    assert "FRICTION" not in words
    buckens("run", body, "-o", "out", "--quiet").must(0)
    trust = json.loads((tmp_path / "out" / "summary.json").read_text())["trust"]
    assert "M3D4" in str(trust) and "non structural mass" in str(trust)
    buckens("check", model("*NODE\n1,0,0,0\n").replace("deck.inp", "x"))
    (tmp_path / "box.yaml").write_text(
        "buckens: 1\nbodies: {b: {mesh: {box: {size: [1,1,1], divisions: [1,1,1]}, skip: [A], "
        "material: {E: 1 GPa, nu: 0.3, rho: 1000 kg/m^3}}}}\n")
    buckens("check", "box.yaml").must(2, "skip", "only meshes from files take this key")


def test_one_part_of_a_deck_is_chosen_with_its_links(buckens, model):
    left, a = block((1, 1, 1))
    right, b = block((1, 1, 1), (1, 0, 0), first_node=101, first_element=11, name="F")
    deck = (left + right + "*NODE\n900,-1,0.5,0.5\n901,0,0,2\n"
            "*SOLID SECTION,ELSET=E,MATERIAL=ST\n*SOLID SECTION,ELSET=F,MATERIAL=ST\n" + STEEL +
            f"*NSET,NSET=ENDS\n{a[0, 0, 0]},{b[1, 0, 0]}\n"
            f"*KINEMATIC COUPLING,REF NODE=900\n{a[0, 0, 0]}\n{a[0, 1, 0]}\n{a[0, 1, 1]}\n"
            f"*ELEMENT,TYPE=MASS,ELSET=M\n99,900\n*MASS,ELSET=M\n22.\n"
            f"*EQUATION\n2\n{a[1, 0, 0]},1,1.,{b[0, 0, 0]},1,-1.\n")
    body = model(deck, "only: e")
    told = buckens("check", body, "--json").must(0).json["bodies"]["b"]
    # The point mass hangs on a link whose other nodes are all of the part.
    assert told["mass"] == pytest.approx(7822, rel=1e-12)
    told = report(buckens, "--only", "F")
    assert told["mass"] == pytest.approx(7800) and told["nodes"] == 9  # 901 belongs to nobody
    assert told["node_sets"] == {"ENDS": 1}
    assert [n for n in told["notes"] if "join the chosen part to the rest" in n]
    assert report(buckens, "--only", "E,F")["mass"] == pytest.approx(2 * 7800 + 22)
    buckens("mesh-info", "deck.inp", "--only", "G").must(2, "no element set, group or property \"G\"")


def tied(divisions, tie):
    """Two halves of a beam of 2 m with non-matching meshes, and their tie."""
    left, _ = block((1, 0.1, 0.1), divisions=divisions[0])
    right, _ = block((1, 0.1, 0.1), (1, 0, 0), divisions=divisions[1], first_node=1001,
                     first_element=1001, name="F")
    return (left + right + "*ELSET,ELSET=ALL\nE,F\n*SOLID SECTION,ELSET=ALL,MATERIAL=ST\n" + STEEL +
            "*SURFACE,NAME=SE\nE,\n*SURFACE,NAME=SF\nF,\n" + tie)


def test_ties_join_meshes_that_do_not_meet(buckens, model):
    tie = "*TIE,NAME=T,POSITION TOLERANCE=1e-3\nSF,SE\n"
    body = model(tied(((10, 2, 2), (10, 3, 3)), tie))
    told = report(buckens)
    assert told["pieces"] == 1
    assert [n for n in told["notes"] if "are not tied" in n]
    own = frequencies(buckens, body, 5)
    left, _ = block((2, 0.1, 0.1), divisions=(20, 2, 2))
    whole = frequencies(
        buckens, model(left + "*SOLID SECTION,ELSET=E,MATERIAL=ST\n" + STEEL), 5)
    # The joint lies in the middle, where the first mode bends most; node-to-face ties of linear
    # faces in a finer cross-section differ by what the section resolves: a few parts in a thousand.
    assert own == pytest.approx(whole, rel=5e-3)
    # Matching meshes are tied exactly: equal up to rounding of eigenvalues.
    same = frequencies(buckens, model(tied(((10, 2, 2), (10, 2, 2)), tie)), 5)
    assert same == pytest.approx(whole, rel=1e-8)
    # Contact that cannot open is equivalent, in the keywords of CalculiX and of Abaqus.
    tied_contact = ("*CONTACT PAIR,INTERACTION=I,TYPE=SURFACE TO SURFACE\nSF,SE\n"
                    "*SURFACE INTERACTION,NAME=i\n*SURFACE BEHAVIOR,PRESSURE-OVERCLOSURE=TIED\n1e9\n")
    for contact in (tied_contact, "*CONTACT PAIR,TIED\nSF,SE\n"):
        same = frequencies(buckens, model(tied(((10, 2, 2), (10, 2, 2)), contact)), 5)
        assert same == pytest.approx(whole, rel=1e-8)
    open_contact = model(tied(((10, 2, 2), (10, 2, 2)), tied_contact.replace("TIED", "HARD")))
    buckens("check", open_contact).must(3, "nothing holds together")
    untied = model(tied(((10, 2, 2), (10, 3, 3)), ""))
    buckens("check", untied).must(3, "nothing holds together")


def test_ties_over_a_gap_strain_nothing_in_rigid_motion(buckens, model):
    # A gap of 1 mm and non-matching edges: a link that blocked a rigid motion would be refused or
    # show as a seventh low frequency.
    deck, _ = block((1, 0.1, 0.1), divisions=(4, 2, 2))
    other, _ = block((1, 0.1, 0.1), (1.001, 0.013, 0.007), divisions=(4, 3, 3), first_node=1001,
                     first_element=1001, name="F")
    body = model(deck + other + "*ELSET,ELSET=ALL\nE,F\n*SOLID SECTION,ELSET=ALL,MATERIAL=ST\n" +
                 STEEL + "*SURFACE,NAME=SE\nE,\n*SURFACE,NAME=SF\nF,\n"
                 "*TIE,NAME=T,POSITION TOLERANCE=2e-3\nSF,SE\n")
    told = report(buckens)
    assert [n for n in told["notes"] if "off the master surface" in n]
    assert frequencies(buckens, body, 1)[0] > 100


def test_plane_elements_and_bars_beside_solids_are_passed_over(buckens, model):
    deck, n = block((1, 1, 1))
    face = [n[0, 0, 0], n[1, 0, 0], n[1, 1, 0], n[0, 1, 0]]
    skin = (f"*ELEMENT,TYPE=CPS4,ELSET=SKIN\n50,{','.join(map(str, face))}\n"
            f"*ELEMENT,TYPE=T3D2,ELSET=LINE\n51,{face[0]},{face[1]}\n"
            "*ELEMENT,TYPE=D,ELSET=GAS\n52,0,1,0\n")
    section = "*SOLID SECTION,ELSET=E,MATERIAL=ST\n" + STEEL
    body = model(deck + skin + section)
    assert buckens("check", body, "--json").must(0).json["bodies"]["b"]["mass"] == pytest.approx(7800)
    notes = " ".join(report(buckens)["notes"])
    assert "CPS4 is left out" in notes and "T3D2 without a section" in notes and "no fluids" in notes
    model(deck + skin + section + "*SOLID SECTION,ELSET=SKIN,MATERIAL=ST\n1.\n")
    buckens("mesh-info", "deck.inp").must(2, "CPS4", "plane", "skip: [CPS4]")
    # Alone they are shells, as in a mesh of Gmsh, and the bars still its edges.
    nodes = deck.split("*ELEMENT")[0]
    body = model(nodes + skin.split("*ELEMENT,TYPE=D")[0],
                 "section: {thickness: 1 mm}, material: {E: 1 GPa, nu: 0.3, rho: 1000 kg/m^3}")
    assert buckens("check", body, "--json").must(0).json["bodies"]["b"]["mass"] == pytest.approx(1)
    model(nodes + "*ELEMENT,TYPE=F3D8\n1,1,2,3,4,5,6,7,8\n")
    buckens("mesh-info", "deck.inp").must(2, "deck.inp:", "no element of this deck", "1 F3D8")


def test_thicknesses_of_nodes_and_materials_that_the_model_file_gives(buckens, model):
    deck = ("*NODE,NSET=N\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,2,0,0\n6,2,1,0\n"
            "*ELEMENT,TYPE=S4,ELSET=E\n1,1,2,3,4\n2,2,5,6,3\n"
            "*SHELL SECTION,ELSET=E,MATERIAL=UNKNOWN,NODAL THICKNESS\n0.5\n"
            "*NODAL THICKNESS\nN,0.01\n5,0.03\n6,0.03\n")
    body = model(deck, "materials: {UNKNOWN: {material: {E: 70 GPa, nu: 0.3, rho: 2700 kg/m^3}}}")
    told = buckens("check", body, "--json").must(0).json["bodies"]["b"]
    assert told["mass"] == pytest.approx(2700 * (0.01 + 0.02), rel=1e-12)
    assert "\"UNKNOWN\" is not defined" in " ".join(report(buckens)["notes"])


def test_nodes_in_a_plane_and_on_a_line_stay_there(buckens, model):
    deck, n = block((1, 0.1, 0.1), divisions=(4, 2, 2))
    section = "*SOLID SECTION,ELSET=E,MATERIAL=ST\n" + STEEL
    end = [n[4, j, k] for j, k in ((0, 0), (2, 0), (0, 2), (1, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 1))]
    line = [n[0, j, 0] for j in (0, 2, 1)]
    mpc = (f"*MPC\nPLANE,{','.join(map(str, end))}\nSTRAIGHT,{','.join(map(str, line))}\n"
           f"MEANROT,{','.join(3 * [str(end[0])])},{','.join(3 * [str(end[1])])},\n{end[2]}\n")
    model(deck + section + mpc)
    told = report(buckens)
    # Six nodes beyond the first three, one beyond the first two: constraints stiffen.
    free = frequencies(buckens, model(deck + section), 6)
    held = frequencies(buckens, model(deck + section + mpc), 6)
    assert (held > free * (1 - 1e-9)).all() and (held[-1] > free[-1] * (1 + 1e-9))
    assert "MEANROT is ignored" in " ".join(told["notes"])


def test_decks_with_stray_lines_and_surplus_nodes(buckens, model):
    deck, n = block((1, 1, 1))
    element = "1, " + ",".join(str(v) for v in n.values())
    surplus = deck.replace("\n1, 1, 5", "\n1, 1, 5", 1)
    solid = [line for line in deck.splitlines() if line.count(",") == 8][0]
    surplus = deck.replace(solid, solid + ", 1, 2,")
    model(">** a stray line\n*\n" + surplus + "*SOLID SECTION,ELSET=E,MATERIAL=ST\n" + STEEL)
    told = report(buckens)
    assert told["mass"] == pytest.approx(7800, rel=1e-12) and element
    notes = " ".join(told["notes"])
    assert "before the first keyword" in notes and "lone star" in notes and "has 8 nodes" in notes


def test_nodes_and_elements_that_are_generated(buckens, model):
    # A block of 4 x 2 x 2 elements, a copy beside it, a mirrored one and a quarter of a ring.
    deck = ("*SYSTEM\n10,0,0,10,1,0\n-1,0,0\n"  # x becomes y, y becomes -x about (10, 0, 0)
            "*NODE\n1,0,0,0\n5,4,0,0\n21,0,1,0\n25,4,1,0\n"
            "*SYSTEM\n*NGEN,NSET=A\n1,5\n*NGEN,NSET=B\n21,25,1\n*NFILL,NSET=BOTTOM\nA,B,2,10\n"
            "*NCOPY,OLD SET=BOTTOM,CHANGE NUMBER=100,SHIFT,MULTIPLE=2,NEW SET=TOP\n0,0,.5\n"
            "*NSET,NSET=ALL\nBOTTOM,TOP\n"
            "*NCOPY,OLD SET=ALL,CHANGE NUMBER=1000,SHIFT\n0,0,7\n0,0,0,0,0,1,90.\n"
            "*ELEMENT,TYPE=C3D8\n1,1,2,12,11,101,102,112,111\n"
            "*ELGEN,ELSET=E\n1,4,1,1,2,10,10,2,100,100\n"
            "*ELCOPY,OLD SET=E,ELEMENT SHIFT=1000,SHIFT NODES=1000,NEW SET=F\n"
            "*NODE,NSET=C1\n5001,30,0,0\n5005,28,2,0\n5021,31,0,0\n5025,28,3,0\n5041,28,0,0\n"
            "*NGEN,LINE=C,NSET=IN\n5001,5005,1,5041\n*NGEN,LINE=C,NSET=OUT\n5021,5025,1,,28,0,0\n"
            "*ELEMENT,TYPE=S4,ELSET=RING\n5001,5001,5021,5022,5002\n*ELGEN,ELSET=RING\n5001,4\n"
            "*SOLID SECTION,ELSET=E,MATERIAL=ST\n*SOLID SECTION,ELSET=F,MATERIAL=ST\n"
            "*SHELL SECTION,ELSET=RING,MATERIAL=ST\n1e-3\n" + STEEL)
    model(deck)
    told = report(buckens, "--only", "E")
    assert told["elements"] == 16 and told["inverted"] == []
    assert told["volume"] == pytest.approx(4, rel=1e-12)
    assert told["mass_centre"] == pytest.approx([9.5, 2, 0.5])
    # Seven up, then a quarter turn about z.
    assert report(buckens, "--only", "F")["mass_centre"] == pytest.approx([-2, 9.5, 7.5])
    # Four chords of a quarter of the ring between radii 2 and 3.
    area = 4 * 0.5 * (9 - 4) * numpy.sin(numpy.pi / 8)
    assert report(buckens, "--only", "RING")["mass"] == pytest.approx(7800e-3 * area, rel=1e-12)


def test_parts_without_an_assembly_are_where_they_were_drawn(buckens, model):
    first, _ = block((1, 1, 1))
    second, _ = block((1, 1, 1), (3, 0, 0))
    section = "*SOLID SECTION,ELSET=E,MATERIAL=ST\n"
    model(f"*PART,NAME=P\n{first}{section}*END PART\n*PART,NAME=Q\n{second}{section}*END PART\n" + STEEL)
    told = report(buckens)
    assert told["mass"] == pytest.approx(2 * 7800) and told["box"][1][0] == pytest.approx(4)
    assert report(buckens, "--only", "Q")["mass_centre"][0] == pytest.approx(3.5)


def test_parts_without_an_end_do_not_take_what_follows(buckens, model):
    """Ended by *PART, *ASSEMBLY or *STEP: the note tells where."""
    first, _ = block((1, 1, 1))
    second, _ = block((1, 1, 1), (3, 0, 0))
    section = "*SOLID SECTION,ELSET=E,MATERIAL=ST\n"
    parts = f"*PART,NAME=P\n{first}{section}*PART,NAME=Q\n{second}{section}"
    model(parts + "*STEP\n*STATIC\n*END STEP\n" + STEEL)
    told = report(buckens)
    assert told["mass"] == pytest.approx(2 * 7800) and told["box"][1][0] == pytest.approx(4)
    notes = buckens("mesh-info", "deck.inp").must(0).out
    line = parts[:parts.index("*PART,NAME=Q")].count("\n") + 1
    assert f"*PART has no *END PART; it is assumed to end before *PART in line {line}" in notes and "before *STEP" in notes
    instances = "".join(f"*INSTANCE,NAME=I{k},PART=P\n{x},0,0\n*END INSTANCE\n" for k, x in enumerate((0, 5)))
    model(f"*PART,NAME=P\n{first}{section}*ASSEMBLY,NAME=A\n{instances}*END ASSEMBLY\n" + STEEL)
    told = report(buckens)
    assert told["mass"] == pytest.approx(2 * 7800) and told["mass_centre"][0] == pytest.approx(3)
    model(f"*PART,NAME=P\n{first}{section}{STEEL}")
    buckens("check", "model.yaml").must(2, "deck.inp:1", "*PART has no *END PART", "add *END PART")


def test_lines_in_no_group_that_hang_on_solids_need_a_section(buckens, tmp_path):
    # A tetrahedron in no group, one of its edges, a chain of two lines attached to it, and a separate line.
    (tmp_path / "part.msh").write_text(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n8\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 2 0 0\n6 3 0 0\n"
        "7 0 0 5\n8 0 0 6\n$EndNodes\n$Elements\n5\n1 4 0 1 2 3 4\n2 1 0 1 2\n3 1 0 2 5\n4 1 0 5 6\n5 1 0 7 8\n"
        "$EndElements\n")
    told = buckens("mesh-info", "part.msh", "--json").must(0).json
    assert {kind["kind"]: kind["count"] for kind in told["kinds"]} == {"tet4": 1, "line2": 2}
    assert [note for note in told["notes"] if "hang on nodes" in note and "(2 times)" in note]
    remedy = 'sections: {"lines": {beam: {circle: {diameter: 6 mm}}}}'
    write = (tmp_path / "part.yaml").write_text
    start = "buckens: 1\nmaterials: {steel: {E: 2.1e11, nu: 0.3, rho: 7800}}\nbodies: {b: {mesh: {file: part.msh, material: steel"
    write(start + "}}}\n")
    buckens("check", "part.yaml").must(2, "no cross-section", remedy)
    # As told: the section is taken. The beams hang on a corner of a solid, which does not hold their rotation.
    write(start + ", " + remedy + "}}}\n")
    buckens("check", "part.yaml").must(3, "mechanism", "can move without straining")


def turned_block(angle, coupling, axes):
    """A bar on end along z, turned about it; nodes of its upper end are coupled as `coupling` says."""
    lines, number = block((0.02, 0.03, 0.1), divisions=(1, 1, 4), name="E")
    c, s = math.cos(angle), math.sin(angle)
    out = []
    for line in lines.splitlines():
        cells = line.split(", ")
        if len(cells) == 4 and "." in line:
            x, y = float(cells[1]), float(cells[2])
            line = f"{cells[0]}, {c * x - s * y!r}, {s * x + c * y!r}, {cells[3]}"
        out.append(line)
    ends = [number[i, j, 4] for i in (0, 1) for j in (0, 1)]
    place = (c * 0.03 - s * 0.05, s * 0.03 + c * 0.05, 0.12)
    return ("\n".join(out) + f"\n*NODE\n500, {place[0]!r}, {place[1]!r}, {place[2]!r}\n"
            + "*SURFACE, NAME=S, TYPE=NODE\n" + "".join(f"{n}\n" for n in ends)
            + "*SOLID SECTION, ELSET=E, MATERIAL=ST\n" + STEEL + axes
            + "*COUPLING, CONSTRAINT NAME=C, REF NODE=500, SURFACE=S" + coupling)


def test_couplings_along_directions_of_their_own(buckens, model):
    """What is coupled along x is coupled along a turned axis of the turned bar."""
    plain = turned_block(0.0, "\n*KINEMATIC\n1, 1\n", "")
    bare = frequencies(buckens, model(plain.split("*COUPLING")[0]), 6)
    own = frequencies(buckens, model(plain), 6)
    assert abs(own / bare - 1).max() > 1e-4
    angle = 0.6
    c, s = math.cos(angle), math.sin(angle)
    axes = f"*ORIENTATION, NAME=O\n{c!r}, {s!r}, 0., {-s!r}, {c!r}, 0.\n"
    turned = frequencies(buckens, model(turned_block(angle, ", ORIENTATION=O\n*KINEMATIC\n1, 1\n", axes)), 6)
    # Coordinates have all their digits; modes are iterated to 1e-8 or better.
    assert turned == pytest.approx(own, rel=1e-7)
    # The reference node has no mass: across and about the axis it follows the body, and a note says so.
    assert "without mass or stiffness" in buckens("check", "model.yaml").must(0).out
    # About a far axis cylindrical directions are those of the rectangular ones.
    far = (-1e7 * c, -1e7 * s)
    axes = f"*ORIENTATION, NAME=O, SYSTEM=CYLINDRICAL\n{far[0]!r}, {far[1]!r}, 0., {far[0]!r}, {far[1]!r}, 1.\n"
    about = frequencies(buckens, model(turned_block(angle, ", ORIENTATION=O\n*KINEMATIC\n1, 1\n", axes)), 6)
    assert about == pytest.approx(own, rel=1e-6)


def test_an_anisotropic_material_with_the_constants_of_an_isotropic_one(buckens, model):
    lines, _ = block((0.02, 0.03, 0.1), divisions=(1, 1, 4))
    E, nu = 2.1e11, 0.3
    a, b, g = E * (1 - nu) / (1 + nu) / (1 - 2 * nu), E * nu / (1 + nu) / (1 - 2 * nu), E / 2 / (1 + nu)
    constants = [a, b, a, b, b, a, 0, 0, 0, g, 0, 0, 0, 0, g, 0, 0, 0, 0, 0, g]
    rows = "".join(", ".join(map(repr, constants[k:k + 8])) + "\n" for k in (0, 8, 16))
    section = "*SOLID SECTION, ELSET=E, MATERIAL=ST\n"
    own = frequencies(buckens, model(lines + section + STEEL.replace("*ELASTIC\n2.1e11,.3\n",
                                                                     f"*ELASTIC, TYPE=ANISOTROPIC\n{rows}")), 6)
    assert own == pytest.approx(frequencies(buckens, model(lines + section + STEEL), 6), rel=1e-7)
