# SPDX-License-Identifier: Apache-2.0
"""Fields over meshes through the program: what is recorded, where, when, and what is refused."""

import h5py
import numpy
import pytest

E, RHO, G, L = 210e9, 7850.0, 9.81, 1.0

# A bar on a wall, stretched by its weight: sigma = rho g (L - x), exact for nu = 0.
BAR = """
buckens: 1
title: A bar under its weight
gravity: [9.81 m/s^2, 0, 0]
materials: {plain: {E: 210 GPa, nu: 0, rho: 7850 kg/m^3}}
bodies:
  bar:
    mesh: {box: {size: [1 m, 0.1 m, 0.1 m], divisions: [10, 2, 2], element: hex20}, material: plain}
    interfaces: {root: {face: x0, kind: rigid}}
    REDUCTION
joints: {wall: {fixed: {between: [{ground: [0, 0.05 m, 0.05 m]}, bar/root]}}}
initial: {start: static}
simulation: {duration: 10 ms, step: 1 ms}
output:
  every: 1 ms
  fields: FIELDS
"""


@pytest.fixture
def run(buckens, tmp_path):
    """Runs the bar with some fields; returns the open results."""
    files = []

    def call(fields, reduction="flexibility: elastic", text=BAR):
        (tmp_path / "bar.yaml").write_text(text.replace("FIELDS", fields).replace("REDUCTION", reduction))
        buckens("run", "bar.yaml", "-o", "out", "-q").must(0)
        files.append(h5py.File(tmp_path / "out" / "results.h5", "r", swmr=True))
        return files[-1]

    yield call
    for file in files:
        file.close()


def test_stresses_of_a_bar_under_its_weight_are_exact(run):
    file = run("{record: [stress, von-mises, principal-stress, strain, strain-energy-density], at: both}")
    body = file["geometry/bodies/bar"]
    x = body["nodes"][:, 0][body["field_nodes"][:]] + L / 2
    nodes, elements = file["fields/bodies/bar/nodes"], file["fields/bodies/bar/elements"]
    exact = RHO * G * (L - x)
    scale = RHO * G * L
    # Quadratic elements contain the solution u = rho g (L x - x^2/2)/E; 32-bit numbers in the file.
    assert nodes["stress"].shape == (11, len(x), 6)
    assert nodes["stress"].dtype == numpy.float32
    assert numpy.abs(nodes["stress"][0, :, 0] - exact).max() < 1e-5 * scale
    assert numpy.abs(nodes["stress"][0, :, 1:]).max() < 1e-5 * scale
    assert numpy.abs(nodes["von_mises"][0] - exact).max() < 1e-5 * scale
    assert numpy.abs(nodes["principal_stress"][0, :, 0] - exact).max() < 1e-5 * scale
    assert numpy.abs(nodes["strain"][0, :, 0] * E - exact).max() < 1e-5 * scale
    density = nodes["strain_energy_density"][0]
    assert numpy.abs(density - exact**2 / (2 * E)).max() < 1e-5 * scale**2 / (2 * E)
    middles = numpy.repeat(numpy.arange(0.05, 1, 0.1)[None, :], 4, 0).ravel()
    assert numpy.abs(elements["von_mises"][0] - RHO * G * (L - middles)).max() < 1e-5 * scale
    assert nodes["stress"].attrs["unit"] == "Pa"
    assert list(nodes["stress"].attrs["components"]) == ["xx", "yy", "zz", "xy", "yz", "zx"]


def test_fields_follow_a_clock_of_their_own(run):
    file = run("{record: [von-mises], every: 4 ms}")
    # Every fourth record, and the end.
    assert file["fields/time"][:] == pytest.approx([0, 4e-3, 8e-3, 10e-3])
    assert set(file["fields/time"][:]) <= set(file["time"][:])
    assert len(file["fields/bodies/bar/nodes/von_mises"]) == 4
    assert len(file["time"]) == 11


def test_extremes_are_those_of_all_records(run):
    swinging = BAR.replace("initial: {start: static}\n", "")
    every = run("[von-mises]", text=swinging)
    known = every["fields/bodies/bar/nodes/von_mises"][:]
    times = every["fields/time"][:]
    extremes = every["extremes/bodies/bar/nodes"]
    # The largest value is stored in 64 bits.
    assert extremes["von_mises"][:] == pytest.approx(known.max(0), rel=1e-6)
    assert (extremes["von_mises_time"][:] == times[known.argmax(0)]).mean() > 0.99
    every.close()
    rare = run("{record: [von-mises], every: 5 ms}", text=swinging)
    # Fields are written rarely, but every record counts.
    assert rare["extremes/bodies/bar/nodes/von_mises"][:] == pytest.approx(known.max(0), rel=1e-6)
    rare.close()
    steps = run("{record: [von-mises], extremes: steps}", text=swinging.replace("every: 1 ms", "every: 5 ms"))
    assert steps["extremes/bodies/bar/nodes/von_mises"][:] == pytest.approx(known.max(0), rel=1e-6)
    steps.close()
    off = run("{record: [von-mises], extremes: off}", text=swinging)
    assert "extremes" not in off


def test_motion_at_nodes_agrees_with_the_other_records(run):
    file = run("[displacement, velocity, acceleration]", text=BAR.replace("initial: {start: static}\n", ""))
    nodes = file["fields/bodies/bar/nodes"]
    u = file["bodies/bar/displacement"][:, :, :3]
    assert numpy.abs(nodes["displacement"][:] - u).max() < 1e-6 * numpy.abs(u).max()
    # The wall holds its face.
    held = numpy.flatnonzero(file["geometry/bodies/bar/nodes"][:, 0] < -0.5 + 1e-9)
    v = nodes["velocity"][:]
    assert numpy.abs(v[:, held]).max() < 1e-6 * numpy.abs(v).max()
    assert numpy.abs(nodes["acceleration"][:, held]).max() < 1e-5 * numpy.abs(nodes["acceleration"][:]).max()
    # Steps of 1 ms are coarse for 1.3 kHz; velocities and their means agree only roughly.
    assert v[5:, :, 0].max() > 0
    assert "extremes" not in file


def test_places_are_bodies_interfaces_and_faces(run):
    file = run("{record: [von-mises], on: [bar/root, bar/x1, bar/corner_111], at: both}")
    body = file["geometry/bodies/bar"]
    x = body["nodes"][:, 0][body["field_nodes"][:]] + L / 2
    assert sorted(set(x.round(9))) == [0.0, 1.0]
    assert len(x) == 2 * 21
    assert list(body["field_elements"][:]) == [0, 9, 10, 19, 20, 29, 30, 39]
    assert file["fields/bodies/bar/elements/von_mises"].shape == (11, 8)
    places = body["face_places"][:]
    faces = body["faces"][:]
    known = places >= 0
    assert (body["field_nodes"][:][places[known]] == faces[known]).all()
    on_ends = (numpy.abs(numpy.abs(body["nodes"][:, 0][faces]) - 0.5) < 1e-9) & (faces >= 0)
    assert (known == on_ends).all()


# Free-free and quasi-static bases contain the response to the joint's force, which is all that deforms a body under
# uniform gravity. Fixed interface modes approach the weight by one axial mode, 8/pi^2 of the stress at the wall.
@pytest.mark.parametrize("reduction, tolerance", [("reduction: {free-free: 8}", 1e-5),
                                                  ("reduction: {craig-bampton: {modes: 6}}", 0.25),
                                                  ("flexibility: quasi-static", 1e-5)])
def test_reduced_bodies_have_the_stresses_of_their_shape(run, reduction, tolerance):
    text = BAR.replace("kind: rigid", "kind: average").replace("element: hex20", "element: hex8")
    full = run("{record: [von-mises, velocity]}", text=text)
    known = full["fields/bodies/bar/nodes/von_mises"][0]
    full.close()
    file = run("{record: [von-mises, velocity]}", reduction, text)
    found = file["fields/bodies/bar/nodes/von_mises"][0]
    assert numpy.abs(found - known).max() < tolerance * known.max()
    assert file["fields/bodies/bar/nodes/velocity"].shape == (11, 99, 3)


def test_nothing_new_is_recorded_unless_asked_for(buckens, tmp_path):
    (tmp_path / "bar.yaml").write_text(BAR.replace("REDUCTION", "").replace("  fields: FIELDS\n", ""))
    buckens("run", "bar.yaml", "-o", "out", "-q").must(0)
    with h5py.File(tmp_path / "out" / "results.h5", "r", swmr=True) as file:
        assert "fields" not in file and "extremes" not in file
        assert "field_nodes" not in file["geometry/bodies/bar"]
        assert len(file["geometry/bodies/bar/cell_kinds"]) == 40


def test_check_tells_the_size_of_the_results(buckens, tmp_path):
    (tmp_path / "bar.yaml").write_text(BAR.replace("REDUCTION", "").replace("FIELDS", "[stress]"))
    report = buckens("check", "bar.yaml", "--json").must(0).json
    out = buckens("run", "bar.yaml", "-o", "out", "-q").must(0)
    size = (tmp_path / "out" / "results.h5").stat().st_size
    # Bookkeeping, half-filled chunks and the geometry come on top.
    assert size - 600e3 < report["result_bytes"] < size
    assert "size of results.h5" in buckens("check", "bar.yaml").must(0).out
    large = BAR.replace("REDUCTION", "").replace("FIELDS", "[stress]").replace("every: 1 ms", "every: 9e-10 s")
    (tmp_path / "large.yaml").write_text(large)
    buckens("check", "large.yaml", "--json").must(2)
    (tmp_path / "large.yaml").write_text(large.replace("9e-10 s", "2e-9 s").replace("10 ms", "1 ms"))
    warnings = buckens("check", "large.yaml", "--json").must(0).json["warnings"]
    assert any("results.h5 will take about" in text for text in warnings), out


def test_a_face_of_shells_is_a_place(run):
    plate = BAR.replace("box: {size: [1 m, 0.1 m, 0.1 m], divisions: [10, 2, 2], element: hex20}",
                        "plate: {size: [1 m, 0.1 m], divisions: [10, 2], thickness: 1 mm}")
    plate = plate.replace("[0, 0.05 m, 0.05 m]", "[0, 0.05 m, 0]").replace("face: x0", "plane: {point: [0, 0, 0], normal: [1, 0, 0]}")
    file = run("{record: [displacement], on: [bar/top]}", text=plate)
    moved = file["fields/bodies/bar/nodes/displacement"][:]
    assert moved.shape == (11, 33, 3)
    # The free end sinks by rho g L^2 / 2 E = 1.8e-7 m more than the held one.
    assert numpy.ptp(moved[0, :, 0]) == pytest.approx(RHO * G * L**2 / (2 * E), rel=0.05)


@pytest.mark.parametrize("fields, words", [
    ("[von-mises, stres]", ["output.fields", "stres", "stress"]),
    ("{record: [von-mises], every: 1.5 ms}", ["not a multiple", "0.0015"]),
    ("{record: [von-mises], on: [bra]}", ["no body \"bra\"", "\"bar\""]),
    ("{record: [von-mises], on: [bar/roof]}", ["\"roof\"", "\"root\""]),
    ("{on: [bar]}", ["record", "missing"]),
    ("{record: [von-mises], at: edges}", ["edges", "nodes"]),
])
def test_what_does_not_exist_is_refused(buckens, tmp_path, fields, words):
    (tmp_path / "bar.yaml").write_text(BAR.replace("REDUCTION", "").replace("FIELDS", fields))
    buckens("run", "bar.yaml", "-o", "out").must(2, "bar.yaml", *words)


def test_static_paths_record_fields_too(buckens, tmp_path):
    (tmp_path / "bar.yaml").write_text(BAR.replace("REDUCTION", "").replace("FIELDS", "[von-mises]") +
                                       "loads: {pull: {force: {on: bar/corner_111, value: [1 kN, 0, 0]}}}\n")
    buckens("static", "bar.yaml", "-o", "out").must(0)
    with h5py.File(tmp_path / "out" / "results.h5", "r", swmr=True) as file:
        assert len(file["fields/time"]) == len(file["time"])
        largest = file["fields/bodies/bar/nodes/von_mises"][:].max(0)
        assert file["extremes/bodies/bar/nodes/von_mises"][:] == pytest.approx(largest, rel=1e-6)
