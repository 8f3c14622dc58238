# SPDX-License-Identifier: Apache-2.0
"""STEP parts as supplied: meshed with only a material given, repaired if possible, refused with a reason if not."""

import importlib.util
import math
import pathlib

import pytest

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
    return {path.stem: path for path in module.make(tmp_path_factory.mktemp("bad"))}


def info(buckens, file, *options):
    return buckens("mesh-info", file, *options, "--json", timeout=120).must(0).json


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
    (tmp_path / "pin.yaml").write_text(MODEL.format(ASSEMBLY, ", solid: pin"))
    body = buckens("check", "pin.yaml", "--json").must(0).json["bodies"]["part"]
    assert body["mass"] == pytest.approx(7850 * volumes["pin"], rel=1e-9)
    buckens("mesh-info", ASSEMBLY, "--solid", "plat").must(2, 'no solid "plat"', 'Did you mean "plate"?')


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
    assert "elements that fit the walls, for the usual way failed: Gmsh:" in notes(told)
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
    assert "solids overlap" in notes(overlap) and overlap["pieces"] == 1
    assert overlap["volume"] == pytest.approx(1.9 * BOX, rel=1e-9)
    touching = info(buckens, bad["touching"])
    assert touching["notes"] == [] and touching["pieces"] == 1 and touching["duplicate_nodes"] == []
    assert touching["volume"] == pytest.approx(2 * BOX, rel=1e-9)


def test_walls_without_thickness_are_told(buckens, bad):
    told = info(buckens, bad["fin"])
    assert "1 faces bound no solid" in notes(told) and "face_7, near (0.05, 0.03, 0.055) m" in notes(told)
    assert told["volume"] == pytest.approx(BOX, rel=1e-9)


def test_doubtful_sizes_are_told(buckens, tmp_path, bad):
    (tmp_path / "part.yaml").write_text(MODEL.format(bad["in_metres"], ""))
    assert "a body of 140 m, more than 100 m" in buckens("check", "part.yaml").must(0).out
    buckens("mesh-info", bad["in_metres"], "--size", "1 mm").must(2, "give a larger size")
