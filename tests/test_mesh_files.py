# SPDX-License-Identifier: Apache-2.0
"""Meshes of Gmsh, universal files and STEP files through the program: mesh-info, convert, bodies."""

import csv
import math

import numpy
import pytest

from conftest import SOURCE

PARTS = SOURCE / "tests" / "parts"
ROD = SOURCE / "examples" / "connecting_rod"
CRANK_WEBS = ["crank_web_22.msh", "crank_web_22_binary.msh", "crank_web_41.msh", "crank_web_41_binary.msh",
              "crank_web.unv"]

BODY = """
buckens: 1
materials: {{steel: {{E: 210 GPa, nu: 0.3, rho: 7850 kg/m^3}}}}
bodies:
  part:
    mesh: {{file: "{file}", length-unit: mm, material: steel}}
    interfaces: {{near: {{face: SHAFT}}, far: {{face: PIN}}}}
"""


def info(buckens, *arguments):
    return buckens("mesh-info", *arguments, "--json").must(0).json


@pytest.fixture
def crank_web(buckens):
    return info(buckens, PARTS / "crank_web_41.msh", "--length-unit", "mm")


def test_a_crank_web_is_measured(crank_web):
    # Disc of 25 mm and disc of 18 mm around the bores, web between: values of the drawing, by
    # integrating the half height of the outline, max(sqrt(25^2-x^2), 15 for 0<x<40, sqrt(18^2-(x-40)^2)).
    x = numpy.linspace(-25, 58, 200001)
    height = numpy.maximum.reduce([numpy.sqrt(numpy.maximum(625 - x**2, 0)),
                                   numpy.where((x > 0) & (x < 40), 15.0, 0.0),
                                   numpy.sqrt(numpy.maximum(324 - (x - 40)**2, 0))])
    area = 2 * (height[1:] + height[:-1]).sum() / 2 * (x[1] - x[0])
    volume = 12e-9 * (area - math.pi * (14**2 + 9**2))
    # Parabolas instead of circles with elements of 30 degrees to 45 degrees: relative error below 1e-3.
    assert crank_web["volume"] == pytest.approx(volume, rel=2e-3)
    assert crank_web["kinds"] == [{"kind": "tet10", "source": "tetrahedron with 10 nodes",
                                   "count": crank_web["elements"]}]
    assert crank_web["variables"] == 3 * crank_web["nodes"]
    assert crank_web["pieces"] == 1 and not crank_web["inverted"] and not crank_web["free_nodes"]
    assert crank_web["box"][1] == pytest.approx([0.058, 0.025, 0.012], abs=5e-5)
    assert set(crank_web["face_sets"]) == {"SHAFT", "PIN"}
    # Areas are those of the plane triangles between the corners.
    assert crank_web["face_sets"]["SHAFT"]["area"] == pytest.approx(2 * math.pi * 0.014 * 0.012, rel=0.06)
    assert crank_web["face_sets"]["PIN"]["centre"][0] == pytest.approx(0.04, abs=1e-3)
    assert {"rim", "seat", "WEB"} <= set(crank_web["node_sets"])
    assert crank_web["mass"] == 0 and crank_web["without_density"] == crank_web["elements"]


@pytest.mark.parametrize("name", CRANK_WEBS)
def test_all_formats_hold_the_same_mesh(buckens, crank_web, name):
    other = info(buckens, PARTS / name, "--length-unit", "mm")
    assert [(k["kind"], k["count"]) for k in other["kinds"]] == [("tet10", crank_web["elements"])]
    for key in ("nodes", "elements", "variables", "pieces", "element_sets"):
        assert other[key] == crank_web[key], key
    assert set(other["face_sets"]) == set(crank_web["face_sets"])
    # The universal file rounds to 17 digits of its own, the others are exact.
    assert other["volume"] == pytest.approx(crank_web["volume"], rel=1e-12)
    assert other["worst_aspect_ratio"] == pytest.approx(crank_web["worst_aspect_ratio"], rel=1e-9)


def test_info_is_for_people_too(buckens):
    text = buckens("mesh-info", PARTS / "bracket.msh").must(0).out
    for words in ("Gmsh 4.1 binary", "tet4 (tetrahedron)", "worst aspect ratio", "SCREWS", "EYE", "BRACKET",
                  "without density"):
        assert words in text
    assert "the mesh is 60 m wide; its lengths are probably in mm" in text and "length-unit: mm" in text
    assert "warning" not in buckens("mesh-info", PARTS / "bracket.msh", "--length-unit", "mm").must(0).out
    shell = buckens("mesh-info", PARTS / "housing.msh").must(0).out
    assert "quad4 (quadrangle)" in shell and "WALLS" in shell
    assert "the mesh is 120 m wide" in shell and "length-unit: mm" in shell
    assert "warning" not in buckens("mesh-info", PARTS / "housing.msh", "--length-unit", "mm").must(0).out


def mesh_of(path):
    """Nodes and elements of a text file of version 4.1, read by a separate reader."""
    lines = iter(path.read_text().splitlines())
    nodes, elements = {}, {}
    for line in lines:
        if line == "$Nodes":
            for _ in range(int(next(lines).split()[0])):
                count = int(next(lines).split()[3])
                ids = [int(next(lines)) for _ in range(count)]
                nodes.update({i: tuple(map(float, next(lines).split()[:3])) for i in ids})
        if line == "$Elements":
            for _ in range(int(next(lines).split()[0])):
                _, _, kind, count = map(int, next(lines).split())
                for _ in range(count):
                    number, *of = map(int, next(lines).split())
                    elements[number] = (kind, tuple(of))
    return nodes, elements


@pytest.mark.parametrize("options", [[], ["--binary"], ["--msh-version", "2.2"],
                                     ["--msh-version", "2.2", "--binary"]])
def test_meshes_round_trip(buckens, tmp_path, options):
    source = PARTS / "crank_web_41.msh"
    told = buckens("convert", source, "there.msh", "--length-unit", "mm", *options, "--json").must(0).json
    assert told["model"] == "there.msh.yaml"
    buckens("convert", "there.msh", "back.msh", "--length-unit", "mm").must(0)
    nodes, elements = mesh_of(source)
    nodes_back, elements_back = mesh_of(tmp_path / "back.msh")
    assert nodes_back == nodes  # to the last bit
    solids = {k: v for k, v in elements.items() if v[0] == 11}
    assert {k: v for k, v in elements_back.items() if v[0] == 11} == solids
    first, last = (info(buckens, f, "--length-unit", "mm") for f in (source, "back.msh"))
    for key in ("nodes", "kinds", "volume", "element_sets", "node_sets", "box"):
        assert first[key] == last[key], key
    for name, faces in first["face_sets"].items():
        assert last["face_sets"][name]["faces"] == faces["faces"]
        assert last["face_sets"][name]["area"] == pytest.approx(faces["area"], rel=1e-12)


def test_a_grid_of_vtk_is_read_by_vtk(buckens, tmp_path):
    import vtkmodules.vtkIOXML as io  # noqa: PLC0415 - it takes a second
    told = buckens("convert", PARTS / "bracket.msh", "bracket.vtu", "--json").must(0).json
    assert told["model"] is None
    reader = io.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(tmp_path / "bracket.vtu"))
    reader.Update()
    grid = reader.GetOutput()
    assert grid.GetNumberOfPoints() == told["nodes"]
    assert grid.GetNumberOfCells() == told["elements"]
    assert grid.GetBounds() == pytest.approx((0, 60, 0, 40, 0, 50), abs=1e-9)
    assert grid.GetPointData().HasArray("set EYE") and grid.GetCellData().HasArray("set BRACKET")


def test_a_mesh_with_its_side_car_is_the_same_body(buckens, tmp_path):
    deck = """*NODE
1, 0, 0, 0
2, 100, 0, 0
3, 100, 20, 0
4, 0, 20, 0
5, 0, 0, 10
6, 100, 0, 10
7, 100, 20, 10
8, 0, 20, 10
*ELEMENT, TYPE=C3D8I, ELSET=BAR
1, 1, 2, 3, 4, 5, 6, 7, 8
*SOLID SECTION, ELSET=BAR, MATERIAL=STEEL
*MATERIAL, NAME=STEEL
*ELASTIC
210000, 0.3
*DENSITY
7.85E-9
"""
    (tmp_path / "bar.inp").write_text(deck)
    (tmp_path / "bar.yaml").write_text(
        "buckens: 1\nbodies: {part: {mesh: {file: bar.inp, length-unit: mm}}}\n")
    buckens("convert", "bar.inp", "bar.msh", "--length-unit", "mm").must(0)
    reports = [buckens("check", model, "--json").must(0).json["bodies"]["part"]
               for model in ("bar.yaml", "bar.msh.yaml")]
    for key in ("mass", "com", "principal_inertia", "frequencies"):
        # Constants go through MPa and t and back as text with all digits.
        assert reports[0][key] == pytest.approx(reports[1][key], rel=1e-12, abs=1e-15), key
    assert reports[0]["mass"] == pytest.approx(0.157, rel=1e-12)


def test_a_mesh_becomes_a_body(buckens, tmp_path):
    (tmp_path / "part.yaml").write_text(BODY.format(file=PARTS / "crank_web_22_binary.msh"))
    report = buckens("check", "part.yaml", "--json").must(0).json
    body = report["bodies"]["part"]
    volume = info(buckens, PARTS / "crank_web_41.msh", "--length-unit", "mm")["volume"]
    assert body["mass"] == pytest.approx(7850 * volume, rel=1e-12)
    # Elements of 40 degrees approximate the circle of the bore.
    assert body["interfaces"]["far"]["centre"] == pytest.approx([0.04, 0, 0.006], abs=1e-5)
    assert any("tet10" in note and "worst aspect ratio" in note for note in report["notes"])
    (tmp_path / "wrong.yaml").write_text(BODY.format(file=PARTS / "crank_web_41.msh").replace("PIN", "PINN"))
    buckens("check", "wrong.yaml").must(2, "PINN")


def test_a_step_file_is_told_by_faces(buckens):
    told = info(buckens, ROD / "rod.step", "--size", "12 mm")
    assert told["box"][1][0] - told["box"][0][0] == pytest.approx(0.337, abs=1e-4)
    assert told["face_sets"]["big bore"]["centre"] == pytest.approx([0, 0, 0], abs=1e-3)
    assert told["face_sets"]["color_0_0_255"]["centre"] == pytest.approx([0.3, 0, 0], abs=1e-3)
    assert [p["name"] for p in told["properties"]] == ["rod"]
    assert told["inverted"] == [] and told["warnings"] == []
    linear = info(buckens, ROD / "rod.step", "--size", "12 mm", "--order", "1")
    assert linear["kinds"][0]["kind"] == "tet4"
    assert linear["volume"] == pytest.approx(told["volume"], rel=0.02)
    buckens("mesh-info", ROD / "rod.step", "--size", "5 kg").must(2, "--size", "5 mm")
    buckens("mesh-info", ROD / "rod.step", "--size", "5 mm", "--length-unit", "mm").must(2, "states its units")


def sensors(path):
    rows = list(csv.reader(path.open()))
    values = numpy.array(rows[1:], dtype=float)
    return {name: values[:, i] for i, name in enumerate(rows[0])}


def deflection(columns):
    """Of the middle from the line between the ends, across it in the plane of motion."""
    point = lambda name: numpy.array([columns[f"{name}.{axis} [m]"] for axis in "xy"])
    along = point("small") - point("big")
    from_end = point("middle") - point("big")
    return (along[0] * from_end[1] - along[1] * from_end[0]) / numpy.hypot(*along)


def test_a_rod_from_a_step_file_bends_like_a_beam(buckens, tmp_path):
    """The example "connecting_rod/connecting_rod" beside "connecting_rod/beam", for a shorter time."""
    bends = {}
    for model in ("connecting_rod", "beam"):
        extra = ["--set", "parameters.size=14 mm"] if model == "connecting_rod" else []
        buckens("run", ROD / f"{model}.yaml", "-o", model, "--set", "simulation.duration=10 ms",
                "--set", "simulation.step=0.25 ms", *extra, "-q").must(0)
        bends[model] = deflection(sensors(tmp_path / model / "sensors.csv"))
    largest = numpy.abs(bends["beam"]).max()
    # The beam has no eyes, which are stiffer and heavier than the shank; the page states the difference
    # (3 % of the largest deflection over 50 ms).
    assert numpy.abs(bends["connecting_rod"]).max() == pytest.approx(largest, rel=0.1)
    assert numpy.corrcoef(bends["connecting_rod"], bends["beam"])[0, 1] > 0.97


BROKEN = {
    "empty.msh": (b"", "the file is empty"),
    "picture.msh": (b"\x89PNG\r\n\x1a\n" + bytes(range(256)) * 20, "not a Gmsh mesh"),
    "picture.unv": (b"\x89PNG\r\n\x1a\n" + bytes(range(256)) * 20, "universal file"),
    "picture.step": (b"\x89PNG\r\n\x1a\n" + bytes(range(256)) * 20, "not a STEP file"),
    "huge.msh": (b"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n99999999999999\n", "huge.msh:5:"),
    "missing.msh": (b"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 0 0\n$EndNodes\n$Elements\n1\n"
                    b"1 4 2 0 1 1 2 3 4\n$EndElements\n", "missing.msh:10:"),
    "nan.msh": (b"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 nan 0\n$EndNodes\n", "nan.msh:6:5"),
    "old.msh": (b"$NOD\n1\n1 0 0 0\n$ENDNOD\n", "old.msh:4:1: the file has no section $ELM"),
}


@pytest.mark.parametrize("name", BROKEN)
def test_broken_files_are_refused(buckens, tmp_path, name):
    content, words = BROKEN[name]
    (tmp_path / name).write_bytes(content)
    options = ["--size", "5 mm"] if name.endswith(".step") else []
    buckens("mesh-info", name, *options, timeout=60).must(2, name, words)
    (tmp_path / "part.yaml").write_text(BODY.format(file=name) if not options else
                                        f"buckens: 1\nbodies: {{part: {{geometry: {{step: {name}, size: 5 mm}}}}}}\n")
    buckens("check", "part.yaml", timeout=60).must(2, words)


@pytest.mark.parametrize("name", ["crank_web_22_binary.msh", "crank_web_41_binary.msh", "crank_web_41.msh",
                                  "crank_web.unv"])
def test_files_that_are_cut_off_are_refused(buckens, tmp_path, name):
    content = (PARTS / name).read_bytes()
    for part in (0.1, 0.5, 0.9):
        (tmp_path / name).write_bytes(content[:int(part * len(content))])
        buckens("mesh-info", name, timeout=60).must(2, name)


def test_missing_files_and_wrong_words_are_refused(buckens):
    buckens("mesh-info", "nothing.msh").must(5, "nothing.msh", "no such file")
    buckens("mesh-info", "part.xyz").must(2, ".xyz", ".msh", ".unv")
    buckens("mesh-info", PARTS / "bracket.msh", "--length-unit", "milli").must(2, "--length-unit")
    buckens("convert", PARTS / "bracket.msh", "part.stl").must(2, ".msh and .vtu")
    buckens("convert", PARTS / "bracket.msh", "part.msh", "--msh-version", "3").must(2, "--msh-version")


def test_faces_that_are_not_there_are_refused(buckens, tmp_path):
    text = (ROD / "connecting_rod.yaml").read_text().replace("step: rod.step", f"step: {ROD / 'rod.step'}")
    text = text.replace("size: 8 mm", "size: 20 mm")
    for old, new, words in [("[255, 0, 0]", "[0, 255, 0]", "there are [0, 0, 255], [255, 0, 0]"),
                            ("[255, 0, 0]", "[0, 300, 0]", "from 0 to 255"),
                            ("label: small bore", "label: small boar", 'Did you mean "small bore"?'),
                            ("label: small bore", "numbers: [77]", "no face 77"),
                            ("label: small bore", "sphere: {center: [9, 9, 9], radius: 1 mm}", "lies wholly")]:
        (tmp_path / "rod.yaml").write_text(text.replace(old, new))
        buckens("check", "rod.yaml").must(2, "rod.yaml:", words)


def test_the_line_of_the_model_is_named_where_a_file_cannot_be_a_mesh(buckens, tmp_path):
    (tmp_path / "part.msg").write_text("no mesh")
    (tmp_path / "part.yaml").write_text(BODY.format(file="part.msg"))
    buckens("check", "part.yaml").must(2, "part.yaml:6:", 'files that end in ".msg"', ".inp", ".msh")
