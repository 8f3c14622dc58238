# SPDX-License-Identifier: Apache-2.0
"""STEP parts as supplied: meshed with only a material given, repaired if possible, refused with a reason if not."""

import importlib.util
import json
import math
import os
import pathlib
import pty
import re
import subprocess

import pytest

from conftest import PROGRAM, may_mesh_step_files

pytestmark = pytest.mark.skipif(not may_mesh_step_files(), reason="built without Gmsh (BUCKENS_GPL=OFF)")

PARTS = pathlib.Path(__file__).parent / "parts"
ASSEMBLY = PARTS / "assembly.step"  # a plate of 5000 mm³, a pin that stands on it, a block apart from both
MODEL = "buckens: 1\nbodies: {{part: {{geometry: {{step: {}, material: {{E: 210 GPa, nu: 0.3, rho: 7850}}{}}}}}}}\n"
BOX = 100e-3 * 60e-3 * 40e-3


@pytest.fixture(scope="module")
def bad(tmp_path_factory):
    """Faulty parts by their names in make_bad_parts.py."""
    spec = importlib.util.spec_from_file_location("make_bad_parts", PARTS / "make_bad_parts.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    module.PARTS["sieve"] = module.sieve(6, 6)
    return {path.stem: path for path in module.make(tmp_path_factory.mktemp("bad"))}


def info(buckens, file, *options):
    return buckens("mesh-info", file, *options, "--json").must(0).json


def notes(told):
    return " | ".join(told["notes"])


def test_a_part_needs_no_size(buckens, tmp_path):
    """Twenty elements along the diagonal, more where the part is thin; the ending may be .p21."""
    (tmp_path / "rod.p21").write_text((PARTS.parents[1] / "examples/connecting_rod/rod.step").read_text())
    told = info(buckens, "rod.p21")
    assert 500 < told["elements"] < 5000 and told["pieces"] == 1 and told["notes"] == []
    (tmp_path / "rod.yaml").write_text(MODEL.format("rod.p21", ""))
    body = buckens("check", "rod.yaml", "--json").must(0).json["bodies"]["part"]
    assert body["mass"] == pytest.approx(7850 * told["volume"], rel=1e-9)
    summary = buckens("check", "rod.yaml").must(0).out
    assert "STEP, meshed by Gmsh, size 0.01" in summary and "second-order" in summary, "sizes and times are told"


def test_one_solid_of_several_is_chosen_by_name_or_number(buckens, tmp_path):
    every = info(buckens, ASSEMBLY)
    volumes = {p["name"]: p["size"] for p in every["properties"]}
    assert sum(volumes.values()) == pytest.approx(11e-6, rel=1e-9)
    for choice, name in (("plate", "plate"), ("3", "block")):
        one = info(buckens, ASSEMBLY, "--solid", choice)
        assert [p["name"] for p in one["properties"]] == [name] and one["pieces"] == 1
        assert one["volume"] == pytest.approx(volumes[name], rel=1e-9)
    assert one["face_sets"]["it's below"]["area"] == pytest.approx(100e-6, rel=1e-9), "names stay with their faces"
    (tmp_path / "pin.yaml").write_text(MODEL.format(ASSEMBLY, ", solid: pin, size: 4 mm"))
    body = buckens("check", "pin.yaml", "--json").must(0).json["bodies"]["part"]
    assert body["mass"] == pytest.approx(7850 * volumes["pin"], rel=1e-9)
    buckens("mesh-info", ASSEMBLY, "--solid", "plat").must(2, 'no solid "plat"', 'Did you mean "plate"?')


def test_a_face_that_folds_is_replaced(buckens):
    """The top of the box turns back behind an edge: triangles there lie on each other, and elements between have no volume."""
    told = info(buckens, PARTS / "folded.step", "--size", "10 mm")
    assert told["volume"] == pytest.approx(BOX, rel=1e-6) and told["inverted"] == []
    assert told["face_sets"]["face_1"]["area"] == pytest.approx(6e-3, rel=1e-6)
    assert "the surface of face 1 folds at an edge and was replaced by a smooth one through the same edges" in notes(told)
    assert "elements have no volume, the first near (0, 0.0" in notes(told), "why the usual way failed"


def test_a_face_that_folds_and_bulges_is_replaced_or_refused_soon(buckens, tmp_path):
    """Two points of the same top lie higher, and 894 mm³ more below its surface of Bézier for each millimetre."""
    text = (PARTS / "folded.step").read_text()
    for height, name in ((44, "bulge"), (60, "dome")):
        new = text
        for y in (20, 40):
            new = new.replace(f"(66.666666666667,{y}.,40.)", f"(66.666666666667,{y}.,{height}.)")
        (tmp_path / f"{name}.step").write_text(new)
    told = info(buckens, tmp_path / "bulge.step", "--size", "10 mm")
    assert told["volume"] == pytest.approx(243576e-9, rel=1e-3) and told["inverted"] == []
    assert "was replaced by a smooth one through the same edges and some of its points" in notes(told)
    refused = buckens("mesh-info", tmp_path / "dome.step", "--size", "10 mm").must(2, "dome.step", "face 1 around (0.05",
                                                                                    "changes the volume by", "by a fill or loft")
    assert "way 3" not in refused.err and "other methods were tried" not in refused.err


def test_elements_that_gmsh_cannot_bend_are_straightened(buckens, bad):
    """Large elements in a wall of 0.6 mm around a bore of 20: Gmsh does not reach its target, which is no reason to fail."""
    told = info(buckens, bad["tube"], "--size", "12 mm")
    assert told["inverted"] == [] and told["pieces"] == 1
    assert "would invert have straight edges" in notes(told)
    fine = info(buckens, bad["tube"])
    exact = math.pi * (0.0106**2 - 0.01**2) * 0.06
    assert fine["volume"] == pytest.approx(exact, rel=2e-3), "elements that fit the wall"
    assert f"the elements fill {told['volume']:.4g} m^3, but the solids of the file {exact:.4g} m^3" in notes(told), \
        "straight edges at the bore, curved ones outside"


def test_other_ways_are_tried_before_a_part_is_refused(buckens, bad):
    """Eight elements to a turn cut through a wall of 0.3 mm: smaller ones are used, and that is reported."""
    told = info(buckens, bad["thin_tube"], "--size", "12 mm")
    assert told["inverted"] == [] and told["pieces"] == 1
    assert "elements that fit the walls, since the usual method failed: Gmsh:" in notes(told)
    assert re.search(r"faces cross in \d+ places, the first \(-?0\.0\d+, -?0\.0\d+, 0\.0\d+\) m on faces \d and \d", notes(told))
    assert told["volume"] == pytest.approx(math.pi * (0.0103**2 - 0.01**2) * 0.06, rel=5e-3)


def test_gaps_are_sewn_or_told(buckens, bad):
    told = info(buckens, bad["gap_small"])
    assert "6 faces became 6" in notes(told) and told["pieces"] == 1
    # The upper face lies 0.01 mm above the walls; the position of the seam is the kernel's choice.
    assert told["volume"] == pytest.approx(BOX, rel=0.02 / 40)
    buckens("mesh-info", bad["gap_wide"]).must(2, "gap_wide.step", "only 6 faces", "24 edges", "after which",
                                               "8 edges belong to one face only", "0.04) m", "CAD program")


def test_solids_that_overlap_or_touch_are_one_body(buckens, bad):
    overlap = info(buckens, bad["overlap"])
    assert re.search(r'solids overlap \(".+" and ".+"\): their common volume is counted once', notes(overlap)) and overlap["pieces"] == 1
    assert overlap["volume"] == pytest.approx(1.9 * BOX, rel=1e-9)
    touching = info(buckens, bad["touching"])
    assert touching["notes"] == [] and touching["pieces"] == 1 and touching["duplicate_nodes"] == []
    assert touching["volume"] == pytest.approx(2 * BOX, rel=1e-9)


def test_small_solids_that_nothing_meshes_with_others_are_left_out(buckens, bad):
    """A bolt that cuts its bore in slivers: the block is meshed without it, and each of them alone; a note says how much is missing."""
    block, bolt = 60 * 60 * 40 - math.pi * 5**2 * 40, math.pi * 5**2 * 50  # mm³
    told = info(buckens, bad["screwed"])
    # Elements on the true surface, some of them straight.
    assert told["volume"] == pytest.approx(block * 1e-9, rel=3e-4) and told["pieces"] == 1
    assert "cannot be meshed with them were left out: " in notes(told)
    assert f", {100 * bolt / (block + bolt):.2g} % of the volume" in notes(told)
    assert info(buckens, bad["screwed"], "--solid", "2")["volume"] == pytest.approx(bolt * 1e-9, rel=3e-4)
    # A fifth of the volume is too much to leave out, though each alone can be meshed.
    assert [info(buckens, bad["pressed"], "--solid", solid)["pieces"] for solid in "12"] == [1, 1]
    buckens("mesh-info", bad["pressed"]).must(2, "Solids overlap (", "make each solid a separate body by `solid`")


def test_walls_without_thickness_are_told(buckens, bad):
    told = info(buckens, bad["fin"])
    assert "1 faces bound no solid" in notes(told) and "face_7, near (0.05, 0.03, 0.055) m" in notes(told)
    assert told["volume"] == pytest.approx(BOX, rel=1e-9)


def test_edges_of_more_than_two_faces(buckens, bad):
    """Towers that touch along an edge are one solid where a plate joins them; three sheets enclose nothing."""
    told = info(buckens, bad["pinched"])
    assert told["pieces"] == 1 and told["inverted"] == [] and told["notes"] == []
    assert told["volume"] == pytest.approx((2 * 40 * 40 * 30 + 80 * 80 * 10) * 1e-9, rel=1e-9)
    buckens("mesh-info", bad["three_sheets"]).must(2, "three_sheets.step", "only 3 faces", "9 edges belong to one face only",
                                                   "1 edges belong to three faces or more, the first near (0, 0.03, 0) m")


def test_walls_without_thickness_inside_a_part_are_left_out(buckens, bad):
    """Two rooms side by side, as separate faces: the wall between them has neither mass nor stiffness."""
    told = info(buckens, bad["two_chambers"])
    assert "11 faces became 10" in notes(told) and told["pieces"] == 1
    assert "were left out (1 faces, the first near (0.1, 0.03, 0.02) m)" in notes(told)
    assert told["volume"] == pytest.approx(2 * BOX, rel=1e-9)


def test_files_that_were_cut_off_are_refused(buckens, tmp_path, bad):
    """By what is missing at their end; where an end was put back, by what they no longer hold."""
    text = bad["pinched"].read_text()
    for share in (0.001, 0.1, 0.5, 0.9, 0.9999):
        rest = text[:int(share * len(text))]
        (tmp_path / "part.step").write_text(rest)
        lines = rest.count("\n") + 1
        buckens("mesh-info", "part.step").must(2, f"part.step:{lines}:1: the STEP file is truncated", "END-ISO-10303-21")
    for share in (0.1, 0.5, 0.9):
        (tmp_path / "part.step").write_text(text[:int(share * len(text))] + "\nENDSEC;\nEND-ISO-10303-21;\n")
        buckens("mesh-info", "part.step").must(2, "part.step: cannot be meshed", "entities are missing from the file",
                                               "in line 22", "export it again")


def test_entities_that_nothing_defines_are_told(buckens, tmp_path, bad):
    """A part may well be whole without them: a note, with what stands in strings and comments left out."""
    text = bad["touching"].read_text()
    (tmp_path / "part.step").write_text(text.replace("DATA;", "DATA;\n/* #98 */ #9001=COLOUR('#97',#9002);", 1))
    told = info(buckens, "part.step")
    line = text[:text.index("DATA;")].count("\n") + 2
    assert f"(1 references to them, the first to #9002 in line {line})" in notes(told)
    assert told["volume"] == pytest.approx(2 * BOX, rel=1e-9)


def test_a_foil_is_told_by_its_elements(buckens, bad):
    """A tenth of a micrometre thick: far thinner than any size at which it could be meshed."""
    told = info(buckens, bad["foil"], "--order", "1")
    assert "walls are about 0.0001 mm thick" in notes(told) and "mesh the part with shells" in notes(told)
    assert told["volume"] == pytest.approx(0.1 * 0.06 * 1e-7, rel=1e-6)


def test_doubtful_sizes_are_told(buckens, tmp_path, bad):
    (tmp_path / "part.yaml").write_text(MODEL.format(bad["in_metres"], ""))
    assert "a body of 140 m, more than 100 m" in buckens("check", "part.yaml").must(0).out
    buckens("mesh-info", bad["in_metres"], "--size", "1 mm").must(2, "give a larger size")


def test_solids_that_share_only_an_edge_are_told(buckens, tmp_path, bad):
    """Two boxes could turn about the edge: mesh-info says where, and a body of them is refused with the remedy."""
    told = info(buckens, bad["along_an_edge"])
    assert told["volume"] == pytest.approx(2 * BOX, rel=1e-9)
    assert "meet along an edge only, near (0.1, 0.06, 0.02) m" in notes(told)
    (tmp_path / "part.yaml").write_text(MODEL.format(bad["along_an_edge"], ""))
    buckens("check", "part.yaml").must(3, "mechanism in itself", "share a face or overlap")


def test_many_faces_are_read(buckens, tmp_path, bad):
    """From 3000 faces on, wherever they are named, the kernel reads without two searches, whose time grows with the square of
    the number of faces; so does that to name them by Gmsh's physical groups. Both settings give the same mesh."""
    text = bad["sieve"].read_text()
    assert text.count("ADVANCED_FACE") == 4 * 36 + 6
    (tmp_path / "named.step").write_text(text.replace("END-ISO", "/* ADVANCED_FACE */\n" * 3000 + "END-ISO"))
    told = info(buckens, bad["sieve"], "--order", "1")
    # Plane faces: the mesh has the volume of the part, whose numbers have some 15 digits.
    assert told["volume"] == pytest.approx(2e-9 * (9 * 36 - 36), rel=1e-9) and told["pieces"] == 1
    holes = [face["area"] for face in told["face_sets"].values()]
    assert len(holes) == 4 * 36 + 6 and sum(abs(area - 2e-6) < 1e-12 for area in holes) == 4 * 36, "each has its name"
    quick = info(buckens, "named.step", "--order", "1")
    assert {**told, "file": ""} == {**quick, "file": ""}


def told_on_terminal(program, *arguments):
    """The exit code, what a terminal of 80 columns gets on the standard error stream, and what is printed."""
    ours, theirs = pty.openpty()
    process = subprocess.Popen([program, *map(str, arguments)], stderr=theirs, stdout=subprocess.PIPE, text=True,
                               env={**os.environ, "TERM": "xterm"})
    os.close(theirs)
    out = b""
    while True:
        try:
            piece = os.read(ours, 4096)
        except OSError:  # how Linux says that the other end is closed
            piece = b""
        if not piece:
            break
        out += piece
    os.close(ours)
    printed, _ = process.communicate()  # a few kB, which a pipe holds
    return process.returncode, out.decode(), printed


def number_in(printed, word):
    """The number behind a word at the beginning of a line of mesh-info."""
    return float(re.search(rf"^ +{word} +(\S+)", printed, re.MULTILINE)[1])


def test_terminals_see_how_far_meshing_is():
    """What the mesh will be, before it is made; then stage by stage in one line, which is wiped at the end."""
    file = PARTS.parents[1] / "examples/connecting_rod/rod.step"
    code, shown, printed = told_on_terminal(PROGRAM, "mesh-info", file, "--size", "4 mm")
    assert code == 0 and shown.endswith("\r\x1b[K")
    expected, variables = re.search(r"about (\d+) elements with (\d+) variables are expected\r\n", shown).groups()
    # A factor of two either way is what the estimate promises.
    assert 0.5 < int(expected) / number_in(printed, "elements") < 2
    assert 0.5 < int(variables) / number_in(printed, "variables") < 2
    stages = [shown.find(word) for word in (": reading, 0:0", ": edges, ", "second order, ")]
    assert -1 < stages[0] < stages[1] < stages[2]
    redrawn = [line for line in re.split(r"\r\x1b\[K|\r\n", shown) if not line.startswith("buckens: ")]
    assert 4 < len(redrawn) and max(map(len, redrawn)) < 80
    code, shown, printed = told_on_terminal(PROGRAM, "mesh-info", file, "--size", "20 mm", "--json")
    assert code == 0 and shown == "" and json.loads(printed)["elements"] > 0


def test_the_log_says_what_took_how_long(buckens, tmp_path):
    """From the file to the first step: each phase of meshing, assembly and factor."""
    (tmp_path / "rod.yaml").write_text(MODEL.format(PARTS.parents[1] / "examples/connecting_rod/rod.step", ", size: 4 mm")
                                       + "simulation: {duration: 1 ms, step: 1 ms}\n")
    buckens("run", "rod.yaml", "-o", "out").must(0)
    log = (tmp_path / "out" / "log.txt").read_text()
    for phase in ("read", "names", "surface", "volume", "second-order", "straightening"):
        assert re.search(rf"STEP, meshed by Gmsh.*[;,] {phase} \d+\.\d\d s", log), phase
    assert re.search(r"assembling \d{5} variables: \d+\.\d\d s", log)
    assert re.search(r"factorising \d{5} equations \(factor of 0\.\d+ GB\): \d+\.\d\d s", log)


def test_solids_are_glued_once_for_all_ways(bad):
    """Five ways are tried: the solids are glued in metres and in millimetres, not each time."""
    glued = set()
    for _ in range(5):  # a line is drawn ten times a second at most: on a busy machine a stage can be over before its turn
        code, shown, printed = told_on_terminal(PROGRAM, "mesh-info", bad["capped_tube"], "--size", "12 mm")
        assert code == 0
        assert max(int(number) for number in re.findall(r"way (\d+): ", shown)) >= 4
        glued |= set(re.findall(r"(?:way (\d+): )?gluing 2 solids", shown))
        if len(glued) > 1:
            break
    assert glued == {"", "3"}
    assert "since the usual method failed: Gmsh:" in printed
    exact = math.pi * (0.0103**2 - 0.01**2) * 0.06 + math.pi * 0.0103**2 * 0.01
    assert number_in(printed, "pieces") == 1 and number_in(printed, "volume") == pytest.approx(exact, rel=5e-3)


def test_the_default_size_follows_thin_walls(buckens, tmp_path, bad):
    """One flat element through 0.25 mm: smaller ones, until shells of another kind have the same frequencies."""
    told = info(buckens, bad["sheet"])
    assert "elements down to 2 mm instead of 3.4 mm resolve walls down to 0.25 mm (2 faces)" in notes(told)
    assert told["volume"] == pytest.approx(100 * 20 * 0.25e-9, rel=1e-9) and told["elements"] < 40000
    assert "resolve walls" not in notes(info(buckens, bad["sheet"], "--size", "3.4 mm")), "a given size is kept"

    def frequencies(body):
        (tmp_path / "sheet.yaml").write_text("buckens: 1\nmaterials: {steel: {E: 210 GPa, nu: 0.3, rho: 7850}}\n"
                                             f"bodies: {{sheet: {body}}}\n")
        report = buckens("modes", "sheet.yaml", "--count", 4, "--json", timeout=300).must(0).json
        return [mode["frequency"] for mode in report["analyses"][0]["modes"]]

    shells = frequencies("{mesh: {plate: {size: [100 mm, 20 mm], divisions: [20, 4], thickness: 0.25 mm, element: quad8}, "
                         "material: steel}}")
    # Two per cent: what elements of eight thicknesses are known to be too stiff. Those of 3.4 mm are by 3.5 %.
    followed = frequencies(f"{{geometry: {{step: {bad['sheet']}, material: steel}}}}")
    assert all(-0.003 < a / b - 1 < 0.02 for a, b in zip(followed, shells))


def test_only_faces_with_thin_walls_get_smaller_elements(buckens, bad):
    told = info(buckens, bad["block_with_sheet"])
    assert "resolve walls down to 0.3 mm (2 faces)" in notes(told) and told["pieces"] == 1
    assert told["volume"] == pytest.approx((60 * 60 * 40 + 40 * 60 * 0.3) * 1e-9, rel=1e-9)
    # The elements of first order are the same tetrahedra.
    everywhere = info(buckens, bad["block_with_sheet"], "--size", "2.4 mm", "--order", "1")
    assert 4000 < told["elements"] < everywhere["elements"] / 4
