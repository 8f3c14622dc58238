# SPDX-License-Identifier: Apache-2.0
"""Models that can be run but are hardly what was meant: bodies that assembly moves, values in a wrong unit,
sections in the wrong orientation. `check` and `run` warn of them; examples give no warnings."""

import json
import math
import pathlib

import pytest

SOURCE = pathlib.Path(__file__).parents[1]

CRANK = """
buckens: 1
planar: xy
bodies:
  crank:
    rigid: {mass: 1 kg, com: [0.5, 0, 0], inertia: [0, 0, 0.1]}
    markers: {pin: {position: [1, 0, 0]}}
    at: {position: [0, SHIFT, 0]}
  block: {rigid: {mass: 1 kg, inertia: [0, 0, 1]}, at: {position: [1, 0, 0]}}
joints:
  base: {revolute: {between: [ground, crank/origin]}}
  slide: {fixed: {between: [{ground: [1, 0, 0]}, block]}}
simulation: {duration: 1 ms, step: 0.1 ms}
"""


@pytest.fixture
def check(buckens, tmp_path):
    def call(text, code=0):
        (tmp_path / "model.yaml").write_text(text)
        result = buckens("check", "model.yaml", "--json")
        assert result.code == code, result.err
        return result.json if code == 0 else result.err

    return call


# ---- assembly


def test_a_body_that_sinks_is_told_with_the_joint(check, buckens, tmp_path):
    report = check(CRANK.replace("SHIFT", "2 m"))
    (move,) = report["assembly_moves"]
    assert move["body"] == "crank" and move["joint"] == "base" and move["large"]
    # The hinge point moves down by 2 m, by the least motion of crank and mass: the closed form of one
    # free body held at a point is a move of its hinge alone, so translation and turn share it.
    x = [move["translation"][k] for k in range(3)]
    angle = move["angle"] * move["axis"][2]
    hinge = [0.5 + x[0] - 0.5 * math.cos(angle), 2 + x[1] - 0.5 * math.sin(angle)]
    assert hinge == pytest.approx([0, 0], abs=1e-11)
    (warning,) = [w for w in report["warnings"] if "assembly" in w]
    for word in ("model.yaml:11:", "\"crank\"", "joint \"base\"", "2 m apart", "`at`"):
        assert word in warning
    result = buckens("run", "model.yaml", "-o", "out", "-q").must(0, "assembly moved body \"crank\"")
    assert result.err.count("assembly moved") == 1
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert any("joint \"base\"" in text for text in summary["warnings"])


def test_many_moved_bodies_are_told_in_a_few_lines(buckens, tmp_path):
    # Thirteen bodies on one line, all joined to points at its begin: the k-th is moved by k/10 m.
    count = 13
    bodies = "".join(f"  b{k}: {{rigid: {{mass: 1, inertia: [1, 1, 1]}}, at: {{position: [{k / 10}, 0, 0]}}}}\n" for k in range(1, count + 1))
    joints = "".join(f"  j{k}: {{spherical: {{between: [ground, b{k}/com]}}}}\n" for k in range(1, count + 1))
    (tmp_path / "many.yaml").write_text(
        f"buckens: 1\nbodies:\n{bodies}joints:\n{joints}simulation: {{duration: 1 ms, step: 1 ms}}\noutput: {{every: 1 ms}}\n")
    told = buckens("run", "many.yaml", "-o", "out", "-q").must(0, "assembly moved body \"b1\"").err
    assert told.count("assembly moved body") == 10
    assert "assembly moved 3 more bodies; the largest displacement of all is 1.3 m" in told
    listed = json.loads(buckens("check", "many.yaml", "--json").must(0).out)["assembly_moves"]
    assert len(listed) == count


def test_strict_assembly_refuses_large_moves_only(check, buckens, tmp_path):
    strict = CRANK.replace("planar: xy", "planar: xy\nassembly: strict")
    error = check(strict.replace("SHIFT", "5 mm"), code=3)
    for word in ("model.yaml:12:", "\"crank\"", "\"base\"", "strict"):
        assert word in error
    report = check(strict.replace("SHIFT", "0.1 mm"))
    (move,) = report["assembly_moves"]
    assert not move["large"] and not report["warnings"]
    # Bodies that were moved only a little are listed, too.
    text = buckens("check", "model.yaml").must(0).out
    assert "note: assembly moved body \"crank\"" in text
    buckens("run", "model.yaml", "-o", "out").must(0)
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert any("assembly moved body \"crank\"" in note for note in summary["notes"])


def test_bodies_that_fit_are_not_listed(check):
    report = check(CRANK.replace("SHIFT", "0"))
    assert report["assembly_moves"] == [] and report["warnings"] == []


def test_a_drive_that_starts_elsewhere_is_no_fault(check):
    drive = "  motor: {prescribed-rotation: {between: [ground, crank], angle: \"0.5 + t\"}}\n"
    report = check(CRANK.replace("SHIFT", "0").replace("simulation:", drive + "simulation:"))
    (move,) = report["assembly_moves"]
    assert move["angle"] == pytest.approx(0.5, rel=1e-9) and move["joint"] == "motor" and not move["large"]
    assert report["warnings"] == []


def test_static_paths_and_modes_judge_the_assembly_too(buckens, tmp_path):
    strict = CRANK.replace("SHIFT", "5 mm").replace("planar: xy", "planar: xy\nassembly: strict")
    (tmp_path / "model.yaml").write_text(strict + "loads: {push: {force: {on: crank/pin, value: [0, 1, 0]}}}\n")
    buckens("static", "model.yaml").must(3, "\"crank\"", "\"base\"")
    buckens("modes", "model.yaml", "--system").must(3, "\"crank\"", "\"base\"")


# ---- values

ROD = """
buckens: 1
materials:
  steel: {E: 210 GPa, nu: 0.3, rho: 7850}
bodies:
  rod:
    beam: {from: [0, 0, 0], to: [140 mm, 0, 0], elements: 4, section: {circle: {diameter: 6 mm}}, material: steel}
    at: {orientation: {axis: [0, 0, 1], angle: 0.5}}
"""


@pytest.mark.parametrize("old, new, words", [
    ("E: 210 GPa", "E: 210000", ["model.yaml:4:14", "materials.steel.E", "\"210000\"", "did you mean 210000 MPa?"]),
    ("E: 210 GPa", "E: 210", ["materials.steel.E", "did you mean 210 GPa?"]),
    ("E: 210 GPa", "E: 0.2 MPa", ["materials.steel.E", "200000 Pa", "1 MPa", "check the value and its unit"]),
    ("E: 210 GPa", "E: 210e6 MPa", ["2.1e+14 Pa", "2 TPa", "check the value and its unit"]),
    ("rho: 7850", "rho: 7.85", ["model.yaml:4:37", "materials.steel.rho", "did you mean 7.85 g/cm^3?"]),
    ("rho: 7850", "rho: 7.85e-9", ["did you mean 7.85e-09 tonne/mm^3?"]),
    ("rho: 7850", "rho: 7.85 kg/m^3", ["7.85 kg/m^3", "check the value and its unit"]),
    ("rho: 7850", "rho: 30000", ["25000 kg/m^3"]),
    ("angle: 0.5", "angle: 60", ["model.yaml:8:", "bodies.rod.at.orientation.angle", "did you mean 60 deg?"]),
    ("{axis: [0, 0, 1], angle: 0.5}", "{euler: [0, 0, 45]}", ["orientation.euler.2", "did you mean 45 deg?"]),
    ("[140 mm, 0, 0]", "[140, 0, 0]", ["bodies.rod.beam", "140 m", "did you mean 140 mm?"]),
    ("[140 mm, 0, 0]", "[140 m, 0, 0]", ["140 m", "check the value and its unit"]),
    ("[140 mm, 0, 0]", "[8 um, 0, 0]", ["8e-06 m", "less than 10 um"]),
])
def test_doubtful_values_are_named_with_the_likely_unit(check, old, new, words):
    assert old in ROD
    warnings = check(ROD.replace(old, new))["warnings"]
    assert len([w for w in warnings if "rod" in w or "steel" in w]) >= 1
    for word in words:
        assert word in "\n".join(warnings), warnings


@pytest.mark.parametrize("old, new", [
    ("angle: 0.5", "angle: 720 deg"),  # a unit: meant so
    ("angle: 0.5", "angle: -6.28"),
    ("E: 210 GPa", "E: 1 MPa"),
    ("rho: 7850", "rho: 0.02 g/cm^3"),
    ("E: 210 GPa", "E: 2e12"),
])
def test_what_can_be_meant_is_not_doubted(check, old, new):
    assert old in ROD
    assert [w for w in check(ROD.replace(old, new))["warnings"] if "steel" in w or "angle" in w] == []


def test_vibrations_of_micrometres_are_doubted(check):
    warnings = check(ROD.replace("140 mm", "100 um").replace("6 mm", "10 um"))["warnings"]
    assert any("\"rod\"" in w and "above 1 MHz" in w for w in warnings)


def test_a_run_tells_doubts_once_and_sets_them_at_the_override(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(ROD + "simulation: {duration: 1 ms, step: 0.1 ms}\n")
    result = buckens("run", "model.yaml", "-o", "out", "-q", "--set", "materials.steel.rho=7.85")
    result.must(0, "--set materials.steel.rho", "7.85 g/cm^3")
    assert result.err.count("g/cm^3") == 1
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert any("g/cm^3" in text for text in summary["warnings"])


def test_elements_larger_than_the_part_are_doubted(check):
    # A size of 5 mm written without its unit; the rod is 337 mm long.
    rod = SOURCE / "examples" / "connecting_rod" / "rod.step"
    text = (f"buckens: 1\nbodies: {{rod: {{geometry: {{step: {rod}, order: 1, SIZE, "
            "material: {E: 210 GPa, nu: 0.3, rho: 7850}}}}\n")
    (warning,) = check(text.replace("SIZE", "size: 5"))["warnings"]
    for word in ("model.yaml:2:", "elements of 5 m in a part of 0.337 m", "did you mean 5 mm?"):
        assert word in warning
    assert check(text.replace("SIZE", "size: 50 mm"))["warnings"] == []


def test_units_of_files(check, tmp_path):
    # A hexahedron of 140 in the units of its file, constants in N, mm and t.
    nodes = [(x, y, z) for z in (0, 140) for x, y in ((0, 0), (140, 0), (140, 140), (0, 140))]
    rows = "".join(f"{k}, {x}, {y}, {z}\n" for k, (x, y, z) in enumerate(nodes, 1))
    deck = ("*NODE\n" + rows + "*ELEMENT, TYPE=C3D8, ELSET=ALL\n1, 1, 2, 3, 4, 5, 6, 7, 8\n"
            "*SOLID SECTION, ELSET=ALL, MATERIAL=STEEL\n*MATERIAL, NAME=STEEL\n*ELASTIC\n210000, 0.3\n"
            "*DENSITY\n7.85e-9\n")
    (tmp_path / "part.inp").write_text(deck)
    text = "buckens: 1\nbodies: {part: {mesh: {file: part.inp}}}\n"
    warnings = "\n".join(check(text)["warnings"])
    for word in ("\"STEEL\"", "210000 Pa", "7.85e-09 kg/m^3", "140 m", "length-unit: mm"):
        assert word in warnings
    assert check(text.replace("part.inp", "part.inp, length-unit: mm"))["warnings"] == []


def test_runs_tell_the_same_doubts(check, buckens, tmp_path):
    """Hence test_example_warnings.py, which runs every example, finds what `check` would tell of it."""
    text = CRANK.replace("SHIFT", "2 m").replace("bodies:", "materials: {steel: {E: 210, nu: 0.3, rho: 7850}}\nbodies:")
    doubts = check(text)["warnings"]
    assert len(doubts) == 2 and "assembly" in doubts[1] and "did you mean" in doubts[0]
    buckens("run", "model.yaml", "-o", "out", "-q").must(0, *doubts)
    assert json.loads((tmp_path / "out" / "summary.json").read_text())["warnings"] == doubts


# ---- sections

PLANE = """
buckens: 1
planar: PLANE
bodies:
  rod:
    beam: {from: [0, 0, 0], to: [TO], elements: 4, section: {rectangle: {width: 20 mm, height: 5 mm}},
           material: {E: 200 GPa, nu: 0.3, rho: 7850}UP}
    at: {orientation: {axis: [0, 0, 1], angle: 30 deg}}
"""


@pytest.mark.parametrize("up, in_plane", [("", 0.020), (", up: [1, 1, 0]", 0.005), (", up: [0, 1, 1]", None)])
def test_check_says_which_way_a_section_bends(check, buckens, up, in_plane):
    text = PLANE.replace("PLANE", "xy").replace("TO", "1, 0, 0").replace("UP", up)
    (section,) = check(text)["bodies"]["rod"]["sections"]
    planar = section["planar"]
    assert section["elements"] == 4 and planar["axis"] == pytest.approx([0, 0, 1], abs=1e-15)
    if in_plane is None:
        # Turned by 45 degrees: half of both, and the diagonals lie in the plane and across it.
        assert planar["EI"] == pytest.approx(2e11 * (0.02 * 0.005**3 + 0.005 * 0.02**3) / 24, rel=1e-12)
        assert planar["extent_in_plane"] == pytest.approx(0.025 / math.sqrt(2), rel=1e-12)
        return
    across = 0.02 * 0.005 / in_plane
    assert planar["extent_in_plane"] == pytest.approx(in_plane, rel=1e-12)
    assert planar["extent_across"] == pytest.approx(across, rel=1e-12)
    assert planar["EI"] == pytest.approx(2e11 * across * in_plane**3 / 12, rel=1e-12)
    out = buckens("check", "model.yaml").must(0).out
    assert f"{in_plane:g} m in the plane, {across:g} m across it; bends about (0, 0, 1)" in out


def test_check_tells_the_axes_of_sections_in_space(check, buckens):
    text = PLANE.replace("planar: PLANE\n", "").replace("TO", "0, 0, 1").replace("UP", "")
    (section,) = check(text)["bodies"]["rod"]["sections"]
    # Along z the height lies along model y and the width along x.
    assert section["z"] == pytest.approx([0, 1, 0], abs=1e-15)
    assert [abs(c) for c in section["y"]] == pytest.approx([1, 0, 0], abs=1e-15)
    assert section["EI_y"] == pytest.approx(2e11 * 0.02 * 0.005**3 / 12, rel=1e-12)
    assert section["EI_z"] == pytest.approx(2e11 * 0.005 * 0.02**3 / 12, rel=1e-12)
    assert "bends about" in buckens("check", "model.yaml").must(0).out


def test_the_frequency_agrees_with_the_section_that_is_told(check):
    # First free-free bending frequency of a slender beam, (4.73004)^2 sqrt(EI/(rho A L^4)) / 2 pi.
    text = PLANE.replace("PLANE", "xy").replace("TO", "1, 0, 0").replace("UP", "").replace("elements: 4", "elements: 16")
    body = check(text)["bodies"]["rod"]
    EI = body["sections"][0]["planar"]["EI"]
    expected = 4.7300407448627040**2 * math.sqrt(EI / (7850 * 0.02 * 0.005)) / (2 * math.pi)
    # Euler-Bernoulli without rotary inertia; 16 elements are accurate to 1e-5.
    assert body["frequencies"][0] == pytest.approx(expected, rel=1e-4)
