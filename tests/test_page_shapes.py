# SPDX-License-Identifier: Apache-2.0
"""What the page draws of beams and solids, and how it names runs: cross-sections with their axes, edges of quadratic
elements, directories and changes."""

import base64
import json
import shutil
import subprocess

import h5py
import numpy
import pytest

from conftest import PROGRAM, Result

BEAMS = """
buckens: 1
title: Sections
materials: {plain: {E: 210 GPa, nu: 0.3, rho: 7850 kg/m^3}}
sections:
  flat: {rectangle: {width: 40 mm, height: 10 mm}}
  thin: {rectangle: {width: 20 mm, height: 10 mm}}
  hollow: {box: {width: 60 mm, height: 40 mm, thickness: 5 mm}}
  pipe: {tube: {outer-diameter: 50 mm, inner-diameter: 30 mm}}
  profile: {general: {A: 300 mm^2, Iy: 4e4 mm^4, Iz: 1e4 mm^4, J: 2e4 mm^4,
            stress-points: [[10 mm, 20 mm], [-10 mm, 20 mm], [-10 mm, -20 mm], [10 mm, -20 mm], [0, 0]]}}
bodies:
  tapered: {beam: {to: [1 m, 0, 0], elements: 2, section: flat, end-section: thin, material: plain}}
  long: {beam: {from: [0, 5 m, 0], to: [1 m, 5 m, 0], elements: 7, section: flat, end-section: thin, material: plain}}
  upright: {beam: {from: [0, 1 m, 0], to: [1 m, 1 m, 0], up: [0, 1, 0], elements: 1, section: hollow, material: plain}}
  round: {beam: {from: [0, 2 m, 0], to: [0, 2 m, 1 m], elements: 1, section: pipe, material: plain}}
  given: {beam: {from: [0, 3 m, 0], to: [1 m, 3 m, 0], elements: 1, section: profile, material: plain}}
  arc:
    beam: {from: [0, 4 m, 0], through: [[0.5 m, 4.5 m, 0]], to: [1 m, 4 m, 0], path: arc, elements: 6, section: flat,
           material: plain, up: [0, 0, 1]}
simulation: {duration: 1 ms, step: 1 ms}
"""


def ints(text):
    return numpy.frombuffer(base64.b64decode(text), "<i4")


def floats(text):
    return numpy.frombuffer(base64.b64decode(text), "<f4")


@pytest.fixture
def view(tmp_path):
    """`buckens view` with a page that contains only the data."""
    program = tmp_path / "prefix" / "bin" / "buckens"
    template = program.parents[1] / "share" / "buckens" / "viewer.html"
    for file in (program, template):
        file.parent.mkdir(parents=True)
    shutil.copy(PROGRAM, program)
    template.write_text("<script>const run = /*BUCKENS_DATA*/null;</script>")
    return lambda *directories: Result(subprocess.run(
        [str(program), "view", *directories, "-o", "page.html"], text=True, capture_output=True, timeout=300,
        cwd=tmp_path))


@pytest.fixture
def page_of(view, tmp_path):
    """The runs in the page of run directories."""
    def call(*directories):
        view(*directories).must(0)
        text = (tmp_path / "page.html").read_text()
        return json.loads(text.split("const run = ")[1].split(";</script>")[0])["runs"]
    return call


def size(points):
    """Extents along the local axes y and z."""
    return points.max(axis=0) - points.min(axis=0)


def test_sections_are_kept_as_they_are(buckens, page_of, tmp_path):
    buckens("run", write(tmp_path, BEAMS), "-o", "out", "-q").must(0)
    bodies = {body["name"]: body for body in page_of("out")[0]["bodies"]}
    outline = {name: [[floats(loop).reshape(-1, 2) for loop in section] for section in body["sections"]]
               for name, body in bodies.items()}
    # Three nodes of the taper have three sections; the page contains float32.
    assert numpy.array([size(section[0]) for section in outline["tapered"]]) == pytest.approx(
        numpy.array([[0.04, 0.01], [0.03, 0.01], [0.02, 0.01]]), rel=1e-6)
    assert list(ints(bodies["tapered"]["elementSections"])) == [0, 1, 1, 2]
    # Neighbours share a section even if their positions along the beam are rounded.
    long = ints(bodies["long"]["elementSections"])
    assert list(long[1:-1:2]) == list(long[2::2]) and len(outline["long"]) == 8
    (hollow,) = outline["upright"]
    assert size(hollow[0]) == pytest.approx([0.06, 0.04]) and size(hollow[1]) == pytest.approx([0.05, 0.03])
    (pipe,) = outline["round"]
    assert [numpy.hypot(*loop.T).max() for loop in pipe] == pytest.approx([0.025, 0.015])
    assert len(pipe[0]) == len(pipe[1]) >= 16
    # The hull of the stress points.
    (profile,) = outline["given"]
    assert len(profile) == 1 and len(profile[0]) == 4 and size(profile[0]) == pytest.approx([0.02, 0.04])
    # y = z × x with z near `up`.
    assert floats(bodies["tapered"]["elementAxes"])[:3] == pytest.approx([0, 1, 0])
    assert floats(bodies["upright"]["elementAxes"]) == pytest.approx([0, 0, -1])
    arc = floats(bodies["arc"]["elementAxes"]).reshape(-1, 3)
    nodes = floats(bodies["arc"]["nodes"]).reshape(-1, 3)
    along = numpy.array([nodes[b] - nodes[a] for a, b in bodies["arc"]["elements"]])
    assert len(arc) == 6 and abs(arc[:, 2]).max() < 1e-6
    assert abs((arc * along).sum(axis=1)).max() < 1e-6
    assert len(outline["arc"]) == 1


def write(tmp_path, text):
    (tmp_path / "model.yaml").write_text(text)
    return "model.yaml"


def test_runs_without_sections_are_still_drawn(buckens, page_of, tmp_path):
    """Files of older versions have no outlines: the page falls back on radii."""
    buckens("run", write(tmp_path, BEAMS), "-o", "out", "-q").must(0)
    with h5py.File(tmp_path / "out" / "results.h5", "r+") as file:
        for body in file["geometry/bodies"].values():
            for name in ("section_loops", "section_points", "element_sections", "element_y"):
                del body[name]
    (upright,) = [body for body in page_of("out")[0]["bodies"] if body["name"] == "upright"]
    assert "sections" not in upright
    assert upright["radius"] == [[pytest.approx(0.5 * numpy.hypot(0.06, 0.04))] * 2]


def test_sections_that_do_not_fit_are_refused(buckens, view, tmp_path):
    buckens("run", write(tmp_path, BEAMS), "-o", "out", "-q").must(0)
    with h5py.File(tmp_path / "out" / "results.h5", "r+") as file:
        file["geometry/bodies/upright/element_sections"][0] = [0, 7]
    view("out").must(5, "cross-sections", "upright")


QUADRATIC = """
buckens: 1
title: Quadratic
materials: {plain: {E: 1 MPa, nu: 0.3, rho: 1000 kg/m^3}}
bodies:
  block: {mesh: {box: {size: [1 m, 1 m, 1 m], divisions: [1, 1, 1], element: KIND}, material: plain}}
simulation: {duration: 1 ms, step: 1 ms}
"""


@pytest.mark.parametrize("kind, faces, edges", [("hex8", 6, 12), ("hex20", 6, 12), ("tet10", 12, 18)])
def test_edges_of_quadratic_elements_are_told_from_pieces_of_their_faces(buckens, page_of, tmp_path, kind, faces, edges):
    buckens("run", write(tmp_path, QUADRATIC.replace("KIND", kind)), "-o", "out", "-q").must(0)
    block = page_of("out")[0]["bodies"][0]
    pieces = ints(block["faces"]).reshape(-1, 4)
    if kind == "hex8":
        assert block["faceEdges"] is None and len(pieces) == faces
        return
    bits = ints(block["faceEdges"])
    found = set()
    for piece, own in zip(pieces, bits):
        corners = [node for node in piece if node >= 0]
        for k, node in enumerate(corners):
            if own >> k & 1:
                found.add(frozenset((node, corners[(k + 1) % len(corners)])))
    # Every edge of the surface in two halves, and nothing across a face: V − E + F = 2 of a closed surface.
    nodes = set().union(*found)
    assert len(found) == 2 * edges
    assert len(nodes) - len(found) + faces == 2


def test_runs_are_named_by_directory_and_changes(buckens, page_of, models):
    buckens("run", models / "beam.yaml", "-o", "a/out", "-q").must(0)
    buckens("run", models / "beam.yaml", "-o", "b/out", "-q", "--set", "bodies.beam.beam.elements=4").must(0)
    first, second = page_of("a/out", "b/out")
    assert (first["directory"], second["directory"]) == ("a/out", "b/out")
    assert first["changes"] == [] and second["changes"] == ["bodies.beam.beam.elements=4"]
    assert page_of("a/out")[0]["directory"] == "out"
