# SPDX-License-Identifier: Apache-2.0
"""Models with contradictions or impossible values: loads, time functions, interfaces, meshes, output, reduction,
sweeps. Every message names the place in the file, what is wrong with which value, and what to do."""

import pytest

MODEL = """
buckens: 1
materials:
  steel: {E: 2.1e11 Pa, nu: 0.3, rho: 7850 kg/m^3}
bodies:
  bar:
    mesh: {box: {size: [1 m, 0.1 m, 0.1 m], divisions: [4, 2, 2]}, material: steel}
    interfaces:
      root: {face: x0, kind: rigid}
      tip: {face: x1}
  stone: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}}
joints:
  wall: {fixed: {between: [ground, bar/root]}}
loads:
  gas: {pressure: {on: bar/x1, value: 1 MPa}}
simulation: {duration: 1 ms, step: 0.1 ms}
output:
  every: 1 ms
  sensors:
    tip: {position: bar/tip}
"""

TABLES = {
    "falls.csv": "t,p\n0,1\n1,2\n0.5,2\n",
    "text.csv": "t,p\n0,1\n1,abc\n2,3\n",
    "comma.csv": "t;p\n0;1,5\n1;2,5\n",
    "one.csv": "0\n1\n",
    "empty.csv": "",
    "binary.csv": "".join(chr(k) for k in range(1, 127)),
    "first.csv": "0s,1\n1,2\n",
    "short.csv": "t,p\n0,1\n0.5e-3,2\n",
}


@pytest.fixture
def refuse(buckens, tmp_path):
    """Runs MODEL with `old` replaced by `new`; it must fail with these words, naming a line, and leave
    no run directory."""

    def call(old, new, code, *words):
        assert old in MODEL
        for name, text in TABLES.items():
            (tmp_path / name).write_text(text)
        (tmp_path / "model.yaml").write_text(MODEL.replace(old, new, 1))
        buckens("run", "model.yaml", "-o", "out").must(code, *words)
        assert not (tmp_path / "out").exists()

    return call


@pytest.mark.parametrize("value, words", [
    ("[1 MPa, 0, 0]", ["model.yaml:15:", "loads.gas.pressure.value", "a list", "expected a stress"]),
    ("1 MPaa", ["model.yaml:15:", "\"MPaa\"", "\"MPa\""]),
    ("\"1e6*sin(w*t)\"", ["model.yaml:15:", "unknown name \"w\"", "Known are: t"]),
    ("\"1/t\"", ["model.yaml:15:", "inf at t = 0", "division by zero"]),
    ("{table: falls.csv}", ["model.yaml:15:", "must increase", "row 3 has 0.5 s after 1 s", "sort"]),
    ("{table: text.csv}", ["text.csv:3:3:", "\"abc\"", "decimals"]),
    ("{table: comma.csv}", ["comma.csv:2:3:", "\"1,5\"", "with a point"]),
    ("{table: one.csv}", ["one.csv:1:1:", "1 column,", "column 2", "commas"]),
    ("{table: empty.csv}", ["empty.csv", "no rows", "a time in seconds"]),
    ("{table: binary.csv}", ["binary.csv:", "???", "is not a number"]),
    ("{table: short.csv}", ["model.yaml:15:", "to 0.0005 s", "0 to 0.001 s", "extrapolation: hold"]),
    ("{table: short.csv, column: 9}", ["short.csv:2:1:", "2 columns", "column 9", "`column`"]),
    ("{table: short.csv, unit: kg}", ["model.yaml:15:", "\"kg\"", "stress"]),
    ("{table: [[0, 1, 2], [1, 2, 3]]}", ["model.yaml:15:", "value.table.0", "list of 2 values"]),
])
def test_values_of_loads(refuse, value, words):
    refuse("value: 1 MPa", f"value: {value}", 2, *words)


@pytest.mark.parametrize("value, words", [
    ("1e400 Pa", ["model.yaml:15:", "1e400 is outside", "range of numbers"]),
    ("1e300 Pa", ["model.yaml:15:", "1e300 Pa is not allowed", "not exceed 1e+60"]),
    ("\"1e305*1 GPa\"", ["model.yaml:15:", "has the value inf"]),
    ("\"10*sin(2*pi*t)kPa\"", ["model.yaml:15:", "unknown name \"kPa\"", "at the end after a space"]),
    ("\"2 pi*t Pa\"", ["model.yaml:15:", "unknown unit \"pi*t Pa\""]),
    ("\"5\u00b7t Pa\"", ["model.yaml:15:", "U+00B7", "write * instead"]),
    ("\u22125 Pa", ["model.yaml:15:", "U+2212", "write - instead"]),
    ("5\u00a0Pa", ["model.yaml:15:", "U+00A0", "write a blank instead"]),
    ("\"t = 3\"", ["model.yaml:15:", "equality is =="]),
    ("\"random(t)\"", ["model.yaml:15:", "unknown name \"random\""]),
    ("{table: []}", ["model.yaml:15:", "loads.gas.pressure.value", "at least one point"]),
    ("{table: [[0, 1], [1, 2]], column: 2}", ["model.yaml:15:", "value.column", "applies to files only"]),
    ("{table: [[0 s, 1], [1 s, 2]]}", ["model.yaml:15:", "table.0.0", "\"0 s\" is a time"]),
    ("{table: first.csv}", ["first.csv:1:1:", "\"0s\" is not a number"]),
    ("{table: short.csv, extrapolation: linear}", ["model.yaml:15:", "must be one of refuse, hold"]),
    ("", ["model.yaml:15:", "found no value"]),
])
def test_more_values_of_loads(refuse, value, words):
    refuse("value: 1 MPa", f"value: {value}", 2, *words)


@pytest.mark.parametrize("body, words", [
    ("{like: stone, geometric-stiffness: on}", ["bodies.two.geometric-stiffness", "a rigid body has no stiffness"]),
    ("{like: bar, geometric-stiffness: on}", ["bodies.two.geometric-stiffness", "applies to beams and bars"]),
    ("{like: two}", ["unknown body \"two\"", "above this one"]),
    ("{rigid: {mass: 1e300 kg}}", ["two.rigid.mass", "not exceed 1e+60"]),
    ("{rigid: {mass: 1 kg, com: [1e200 m, 0, 0]}}", ["two.rigid.com.0", "not exceed"]),
    ("{rigid: {mass: 1 kg, inertia: [1, 1]}}", ["two.rigid.inertia", "found 2", "3", "6"]),
    ("{rigid: {mass: 1 kg, inertia: [1, 1, 3]}}", ["two.rigid.inertia", "exceeds the sum"]),
    ("{rigid: {mass: 0.2-0.5}}", ["two.rigid.mass: 0.2-0.5 = -0.3 is not allowed"]),
    ("{rigid: {mass: 1 kg}, at: {orientation: {quaternion: [0, 1e-200, 0, 0]}}}", ["quaternion", "cannot be zero"]),
    ("{rigid: {mass: 1 kg}, at: {orientation: [1, 0, 0]}}", ["two.at.orientation", "axis, angle, euler, quaternion"]),
    ("{rigid: {mass: 1 kg}, frames: 1/2}", ["two.frames: 1/2 = 0.5 is not a whole number"]),
    ("", ["model.yaml:12:3: bodies.two: expected"]),
])
def test_bodies(refuse, body, words):
    stone = "  stone: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}}"
    refuse(stone, f"{stone}\n  two: {body}", 2, "model.yaml:12:", *words)


@pytest.mark.parametrize("assignment, words", [
    ("gravity.1=0", ["nothing at \"gravity\"", "gravity=[0, -9.81 m/s^2, 0]"]),
    ("bodies.bar.mesh.material.E=1", ["holds \"steel\"", "entry of that name"]),
    ("bodies.bar.mesh.box.divisions.3=1", ["not an item of bodies.bar.mesh.box.divisions", "3 items"]),
    ("bodies..x=1", ["no \"\" in bodies", "bar, stone"]),
    ("title=", ["--set title", "missing"]),
    ("title=&a b", ["anchors"]),
    ("joints.wall.revolute.between=[ground, stone]", ["joints.wall", "only one of these keys"]),
    ("simulation.step=1e-20 s", ["1e+17 steps"]),
    ("simulation.max-iterations=2.5", ["2.5 is not a whole number"]),
])
def test_changes_from_the_command_line(buckens, tmp_path, assignment, words):
    (tmp_path / "model.yaml").write_text(MODEL)
    buckens("check", "model.yaml", "--set", assignment).must(2, *words)


def test_a_sweep_of_a_bad_model_leaves_no_directory(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(MODEL.replace("1 MPa", "1 kg"))
    buckens("sweep", "model.yaml", "--vary", "simulation.step=[0.1 ms, 0.2 ms]", "-o", "out").must(
        2, "model.yaml:15:", "\"1 kg\" is a mass")
    assert not (tmp_path / "out").exists()


def test_files_of_other_systems(buckens, tmp_path):
    """A byte order mark and Windows line endings do no harm, nor does a changed model."""
    (tmp_path / "model.yaml").write_bytes(b"\xef\xbb\xbf" + MODEL.replace("\n", "\r\n").encode())
    buckens("run", "model.yaml", "-o", "out", "--set", "simulation.step=0.5 ms").must(0)
    buckens("check", "out/model.yaml").must(0)
    for text in (b"\xff\xfe" + MODEL.encode("utf-16le"), MODEL.encode() + b"title: \xed\xa0\x80\n"):
        (tmp_path / "model.yaml").write_bytes(text)
        buckens("check", "model.yaml").must(2, "model.yaml:", "not UTF-8")


def test_files_of_tables(refuse):
    refuse("value: 1 MPa", "value: {table: nowhere.csv}", 5, "model.yaml:15:", "loads.gas.pressure.value:",
           "nowhere.csv", "no such file")
    refuse("value: 1 MPa", "value: {table: .}", 5, "model.yaml:15:", "directory", "name a file")


@pytest.mark.parametrize("load, words", [
    ("{pressure: {on: bar/, value: 1}}", ["a face is needed", "\"bar/x0\""]),
    ("{pressure: {on: bar/corner_000, value: 1}}", ["no face \"corner_000\"", "x0, x1"]),
    ("{pressure: {on: [bar/x1], value: 1}}", ["loads.gas.pressure.on", "a list", "a text"]),
    ("{presure: {on: bar/x1, value: 1}}", ["unknown key \"presure\"", "\"pressure\""]),
    ("{pressure: {on: bar/x1, value: 1}, force: {on: stone, value: [1, 0, 0]}}", ["only one of these keys"]),
    ("{body-force: {on: bar}}", ["loads.gas.body-force: exactly one", "per-mass"]),
    ("{body-force: {on: ground, per-mass: [0, 0, 1]}}", ["no body \"ground\"", "bar, stone"]),
    ("{body-force: {on: stone, per-volume: [0, 0, 1]}}", ["\"stone\" is rigid", "per mass"]),
    ("{base-acceleration: {on: bar, value: [1, 2, 0]}}", ["unknown key \"on\"", "value"]),
])
def test_loads(refuse, load, words):
    refuse("{pressure: {on: bar/x1, value: 1 MPa}}", load, 2, "model.yaml:15:", *words)


@pytest.mark.parametrize("interface, code, words", [
    ("{face: w0}", 2, ["model.yaml:9:", "no face \"w0\"", "\"x0\""]),
    ("{face: x0, kind: stiff}", 2, ["model.yaml:9:", "\"stiff\"", "average, rigid"]),
    ("{sphere: {center: [9 m, 0, 0], radius: 1 mm}}", 2, ["model.yaml:9:", "no node lies in the sphere", "8 m away", "enlarge"]),
    ("{sphere: {center: [0, 0, 0], radius: -1 mm}}", 2, ["model.yaml:9:", "-1 mm", "not be negative"]),
    ("{set: [corner_000, corner_001], kind: rigid}", 2, ["model.yaml:9:", "2 nodes", "span a surface"]),
    ("{set: [corner_00]}", 2, ["model.yaml:9:", "no node or set \"corner_00\"", "\"corner_000\""]),
    ("{face: y0, kind: rigid}\n      more: {face: x0, kind: rigid}", 3, ["model.yaml:6:", "\"root\"", "\"more\"", "in common", "average"]),
])
def test_interfaces(refuse, interface, code, words):
    refuse("{face: x0, kind: rigid}", interface, code, *words)


@pytest.mark.parametrize("box, words", [
    ("divisions: [0, 2, 2]", ["divisions.0", "0", "positive"]),
    ("divisions: [4, 2]", ["2 values", "3 values"]),
    ("divisions: [40000, 20000, 20000]", ["1.6e+13 elements", "use fewer"]),
    ("divisions: [4.5, 2, 2]", ["4.5", "whole number"]),
    ("divisions: [4, 2, 2], element: hex9", ["\"hex9\"", "\"hex8\""]),
])
def test_meshes(refuse, box, words):
    refuse("divisions: [4, 2, 2]", box, 2, "model.yaml:7:", *words)


@pytest.mark.parametrize("output, words", [
    ("fields: {record: [stress], every: 0.3 ms}", ["0.0003 s", "not a multiple", "0.001 s"]),
    ("fields: [mises]", ["\"mises\"", "von-mises"]),
    ("fields: {record: [stress], on: [bar/xx]}", ["\"xx\"", "\"x0\""]),
])
def test_output(refuse, output, words):
    """An earlier run in the directory is kept, too: nothing is opened before everything is checked."""
    refuse("  every: 1 ms", f"  every: 1 ms\n  {output}", 2, "model.yaml:19:", *words)


def test_tabs(refuse):
    refuse("  gas:", "\tgas:", 2, "model.yaml:15:", "YAML syntax", "begins with a tab")


# ---- reduction

REDUCED = "material: steel}\n    reduction: "


@pytest.mark.parametrize("reduction, code, words", [
    ("{craig-bampton: 4, free-free: 4}", 2, ["one basis"]),
    ("{craig-bampton: {modes: 3, cutoff: 2 kHz}}", 2, ["exactly one", "modes", "cutoff"]),
    ("{craig-bampton: {modes: 0, static-correction: off}}", 3, ["\"bar\"", "no deformation", "rigid"]),
    ("{free-free: 3, file: text.csv}", 2, ["\"bar\"", "text.csv", "not a reduced basis", "reduction.file"]),
])
def test_reductions(refuse, reduction, code, words):
    refuse("material: steel}", REDUCED + reduction, code, "model.yaml:", *words)


def test_bases_without_vibrations_or_with_all_of_them(buckens, tmp_path):
    for reduction in ("{craig-bampton: 0}", "{craig-bampton: {cutoff: 1e-3 Hz}}"):
        (tmp_path / "model.yaml").write_text(MODEL.replace("material: steel}", REDUCED + reduction))
        report = buckens("check", "model.yaml", "--json").must(0).json["bodies"]["bar"]["reduction"]
        assert report["modes"] == 0 and report["static_shapes"] > 0
    (tmp_path / "model.yaml").write_text(MODEL.replace("material: steel}", REDUCED + "{craig-bampton: 100000}"))
    notes = buckens("check", "model.yaml", "--json").must(0).json["notes"]
    assert any("100000 modes were requested" in note and "its mesh has only" in note for note in notes)


@pytest.mark.parametrize("load", ["pressure: {on: bar/z1, value: 1 MPa}",
                                  "traction: {on: bar/z1, value: [0, 0, \"1e5*sin(3e4*t)\"]}",
                                  "base-acceleration: {value: [0, \"9e3*sin(3e4*t)\", 0]}"])
def test_modes_are_chosen_under_loads_on_bodies(buckens, tmp_path, load):
    text = MODEL.replace("pressure: {on: bar/x1, value: 1 MPa}", load)
    (tmp_path / "model.yaml").write_text(text.replace("material: steel}", REDUCED + "{auto: 2 %}"))
    notes = buckens("check", "model.yaml", "--json").must(0).json["notes"]
    assert any("all markers stay within" in note for note in notes), notes
