# SPDX-License-Identifier: Apache-2.0
"""`buckens view`: where it finds its page and what it writes; viewer/ contains tests of the page itself."""

import base64
import json
import os
import pathlib
import shutil
import subprocess

import h5py
import numpy
import pytest

from conftest import PROGRAM, Result


@pytest.fixture
def installed(tmp_path):
    """The program in a separate directory, so that the test decides whether there is a viewer."""
    program = tmp_path / "prefix" / "bin" / "buckens"
    program.parent.mkdir(parents=True)
    try:
        os.link(pathlib.Path(PROGRAM).resolve(), program)
    except OSError:
        shutil.copy(PROGRAM, program)
    return program


def add_viewer(program):
    """A page with only the placeholder for the data."""
    template = program.parents[1] / "share" / "buckens" / "viewer.html"
    template.parent.mkdir(parents=True)
    template.write_text("<script>const run = /*BUCKENS_DATA*/null;</script>")


def view(program, *arguments, **options):
    return Result(subprocess.run([str(program), "view", *map(str, arguments)], text=True,
                                 capture_output=True, timeout=300, **options))


def test_view_without_the_viewer(buckens, models, installed, tmp_path):
    buckens("run", models / "pendulum.yaml", "-o", "out").must(0)
    view(installed, tmp_path / "out").must(5, "prefix/share/buckens/viewer.html", "buckens_viewer")


def test_view_writes_a_page(buckens, models, installed, tmp_path):
    buckens("run", models / "beam.yaml", "-o", "out").must(0)
    add_viewer(installed)
    result = view(installed, "out", cwd=tmp_path).must(0)
    assert "out/view.html" in result.out and "51" in result.out
    page = (tmp_path / "out" / "view.html").read_text()
    assert "Test beam" in page and "BUCKENS_DATA" not in page
    report = view(installed, "out", "-o", "other.html", "--frames", "10", "--json",
                  cwd=tmp_path).must(0).json
    assert report == {"page": "other.html", "records": 51, "frames": 10, "rounded": False}
    assert (tmp_path / "other.html").stat().st_size > 0
    # The page is no obstacle for the next run into the same directory.
    buckens("run", models / "beam.yaml", "-o", "out").must(0)


def test_curves_stand_in_the_order_of_the_model(buckens, models, installed, tmp_path):
    sensors = "{zenith: {position: rod/tip}, force: {joint-force: hinge}, all: {energy: total}}"
    buckens("run", models / "pendulum.yaml", "-o", "out", "--set", f"output.sensors={sensors}").must(0)
    add_viewer(installed)
    view(installed, "out", cwd=tmp_path).must(0)
    text = (tmp_path / "out" / "view.html").read_text()
    run = json.loads(text.split("const run = ")[1].split(";</script>")[0])["runs"][0]
    assert [sensor["name"] for sensor in run["sensors"]] == ["zenith", "force", "all"]


def test_view_of_two_runs(buckens, models, installed, tmp_path):
    buckens("run", models / "beam.yaml", "-o", "out").must(0)
    buckens("run", models / "pendulum.yaml", "-o", "other").must(0)
    add_viewer(installed)
    report = view(installed, "out", "other", "-o", "both.html", "--frames", "10", "--json",
                  cwd=tmp_path).must(0).json
    assert report["frames"] == 10 and report["second"]["frames"] == 10
    text = (tmp_path / "both.html").read_text()
    data = json.loads(text.split("const run = ")[1].split(";</script>")[0])
    assert data["format"] == 2 and len(data["runs"]) == 2
    view(installed, "out", "other", "third", cwd=tmp_path).must(2)


def test_runs_and_vibrations_are_not_shown_side_by_side(buckens, models, installed, tmp_path):
    buckens("run", models / "beam.yaml", "-o", "out").must(0)
    buckens("modes", models / "beam.yaml", "-o", "modes").must(0)
    add_viewer(installed)
    view(installed, "out", "modes", cwd=tmp_path).must(5, "out", "modes", "side by side")


def test_fields_of_a_page_are_chosen(buckens, models, installed, tmp_path):
    buckens("run", models / "beam.yaml", "-o", "out").must(0)
    add_viewer(installed)
    for wanted, names in (("von_mises", ["von_mises"]), ("nothing", []), ("", ["axial_stress", "section_force",
                                                                              "section_moment", "von_mises"])):
        view(installed, "out", "--fields", wanted, cwd=tmp_path).must(0)
        text = (tmp_path / "out" / "view.html").read_text()
        data = json.loads(text.split("const run = ")[1].split(";</script>")[0])
        assert sorted(f["name"] for f in data["runs"][0]["bodies"][0]["fields"]) == names
    assert view(installed, "out", "--fields", "von_mises", cwd=tmp_path).err == ""
    misspelt = view(installed, "out", "--fields", "von_misses,section_force", cwd=tmp_path)
    misspelt.must(0, 'no field "von_misses" was recorded', 'Did you mean "von_mises"?')


# A block on a wall that is pressed at its end; fields at every fourth record.
BLOCK = """
buckens: 1
title: A pressed block
materials: {plain: {E: 210 GPa, nu: 0, rho: 7850 kg/m^3}}
bodies:
  block:
    mesh: {box: {size: [1 m, 0.1 m, 0.1 m], divisions: [4, 2, 2]}, material: plain}
    interfaces: {root: {face: x0, kind: rigid}, end: {face: x1}}
joints: {wall: {fixed: {between: [{ground: [0, 0.05 m, 0.05 m]}, block/root]}}}
loads: {push: {force: {on: block/end, value: ["-1000*sin(300*t) N", 0, 0]}}}
simulation: {duration: 100 ms, step: 1 ms}
output:
  every: 1 ms
  fields: {record: [stress, von-mises], every: EVERY}
"""


def numbers(field, kind):
    return numpy.frombuffer(base64.b64decode(field), kind)


@pytest.mark.parametrize("every, frames", [("4 ms", 26), ("50 ms", 101)])
def test_fields_over_meshes_go_into_the_page(buckens, installed, tmp_path, every, frames):
    """Frames at the fields' instants if these suffice for an animation, else all frames with fields interpolated."""
    (tmp_path / "block.yaml").write_text(BLOCK.replace("EVERY", every))
    buckens("run", "block.yaml", "-o", "out", "-q").must(0)
    add_viewer(installed)
    report = view(installed, "out", "--json", cwd=tmp_path).must(0).json
    assert report["frames"] == frames
    text = (tmp_path / "out" / "view.html").read_text()
    run = json.loads(text.split("const run = ")[1].split(";</script>")[0])["runs"][0]
    body = run["bodies"][0]
    places = numbers(body["facePlaces"], "<i4")
    assert len(places) == len(numbers(body["faces"], "<i4")) and places.min() == 0
    fields = {(f["name"], f["on"]): f for f in body["fields"]}
    stress = fields["stress", "places"]
    assert stress["components"] == ["xx", "yy", "zz", "xy", "yz", "zx"]
    if frames == 26:
        assert "frames" not in stress
    else:
        assert list(numbers(stress["frames"], "<i4")) == [0, 50, 100]
    mises = numbers(fields["von_mises", "places"]["values"]["values"], "<f4")
    mises = mises.reshape(-1, places.max() + 1)
    with h5py.File(tmp_path / "out" / "results.h5", "r", swmr=True) as file:
        exact = file["fields/bodies/block/nodes/von_mises"][:]
        on_surface = numpy.unique(file["geometry/bodies/block/face_places"][:])
        assert numpy.array_equal(mises, exact[:, on_surface[on_surface >= 0]])
        most = file["extremes/bodies/block/nodes/von_mises"][:][on_surface[on_surface >= 0]]
    largest = numbers(fields["von_mises_largest", "places"]["values"]["values"], "<f4")
    assert numpy.allclose(largest, most, rtol=1e-6)  # float32
    assert fields["von_mises_time", "places"]["unit"] == "s"
    # The load: along −x at first, of 1000 N at most.
    (load,) = run["loads"]
    assert (load["name"], load["kind"], load["width"]) == ("push", "force", 3)
    values = numbers(load["values"], "<f4").reshape(-1, 3)
    assert len(values) == frames and 990 < abs(values[:, 0]).max() <= 1000


# A cantilever of beams with a force at its end, and a strip of two layers of shells, both at rest in balance.
LINES_AND_SHELLS = """
buckens: 1
title: A beam and a strip
materials: {plain: {E: 210 GPa, nu: 0, rho: 7850 kg/m^3}}
bodies:
  rod: {beam: {to: [1 m, 0, 0], elements: 4, section: {rectangle: {width: 20 mm, height: 20 mm}}, material: plain}}
  strip:
    mesh:
      plate:
        from: [0, 1 m, 0]
        size: [0.4 m, 0.1 m]
        divisions: [4, 1]
        layers: [{thickness: 1 mm}, {thickness: 1 mm}]
      material: plain
    interfaces: {root: {plane: {point: [0, 0, 0], normal: [1, 0, 0]}, kind: rigid},
                 end: {plane: {point: [0.4 m, 0, 0], normal: [1, 0, 0]}, kind: average}}
joints:
  wall: {fixed: {between: [ground, rod/start]}}
  edge: {fixed: {between: [{ground: [0, 1.05 m, 0]}, strip/root]}}
loads:
  hang: {force: {on: rod/end, value: [0, 0, -10 N]}}
  pull: {force: {on: strip/end, value: [100 N, 0, 0]}}
initial: {start: static}
simulation: {duration: 2 ms, step: 1 ms}
output: {every: 1 ms, fields: [stress, von-mises]}
"""


def test_section_forces_layers_and_joint_forces_go_into_the_page(buckens, installed, tmp_path):
    (tmp_path / "model.yaml").write_text(LINES_AND_SHELLS)
    buckens("run", "model.yaml", "-o", "out", "-q").must(0)
    add_viewer(installed)
    view(installed, "out", cwd=tmp_path).must(0)
    text = (tmp_path / "out" / "view.html").read_text()
    run = json.loads(text.split("const run = ")[1].split(";</script>")[0])["runs"][0]
    rod, strip = run["bodies"]
    frames = run["time"]["n"]
    # A force of 10 N at the end: bending moments fall from 10 N m to zero, from end to end of every element.
    moment = next(f for f in rod["fields"] if f["name"] == "section_moment")
    assert (moment["on"], moment["unit"], moment["components"]) == ("lineEnds", "N m", ["Mt", "My", "Mz"])
    ends = numbers(moment["values"]["values"], "<f4").reshape(frames, 4, 2, 3)
    assert numpy.linalg.norm(ends[0], axis=2) == pytest.approx(
        numpy.array([[10, 7.5], [7.5, 5], [5, 2.5], [2.5, 0]]), abs=1e-3)
    force = next(f for f in rod["fields"] if f["name"] == "section_force")
    across = numbers(force["values"]["values"], "<f4").reshape(frames, 8, 3)
    assert numpy.linalg.norm(across[0], axis=1) == pytest.approx(10, rel=1e-4)
    # 100 N over 0.1 m by 2 mm: 0.5 MPa on all sides of both layers.
    levels = {f["level"]: f for f in strip["fields"] if f["name"] == "shell_stress"}
    assert list(levels) == ["layer 1, bottom", "layer 1, top", "layer 2, bottom", "layer 2, top"]
    for field in levels.values():
        assert (field["on"], field["components"]) == ("elements", ["x", "y", "xy"])
        stress = numbers(field["values"]["values"], "<f4").reshape(frames, 4, 3)
        assert stress[0, 1:3] == pytest.approx(numpy.array([[0.5e6, 0, 0]] * 2), abs=1e3)
    membrane = next(f for f in strip["fields"] if f["name"] == "shell_force")
    assert membrane["unit"] == "N/m"
    assert numbers(membrane["values"]["values"], "<f4").reshape(frames, 4, 3)[0, 1, 0] == pytest.approx(1000, rel=2e-3)
    largest = next(f for f in strip["fields"] if f["name"] == "von_mises_largest" and f["on"] == "elements")
    with h5py.File(tmp_path / "out" / "results.h5", "r", swmr=True) as file:
        exact = file["extremes/bodies/strip/shells/von_mises"][:]
        joint = file["joints/wall/force"][:]
    assert numbers(largest["values"]["values"], "<f4") == pytest.approx(exact, rel=1e-6)
    assert any(f["name"] == "von_mises_time" and f["on"] == "elements" for f in strip["fields"])
    wall = next(j for j in run["joints"] if j["name"] == "wall")
    assert numbers(wall["force"], "<f4").reshape(frames, 3) == pytest.approx(joint, rel=1e-6)
    assert wall["torque"] is not None


@pytest.mark.parametrize("name", ["empty", "missing"])
def test_view_of_nothing(installed, tmp_path, name):
    add_viewer(installed)
    (tmp_path / "empty").mkdir()
    error = view(installed, name, "--json", cwd=tmp_path).must(5, name).json["error"]
    assert error["kind"] == "io"


def test_view_into_a_place_that_cannot_be_written(buckens, models, installed, tmp_path):
    add_viewer(installed)
    buckens("run", models / "pendulum.yaml", "-o", "out").must(0)
    view(installed, "out", "-o", "nowhere/page.html", cwd=tmp_path).must(5, "nowhere/page.html")
