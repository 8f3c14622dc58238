# SPDX-License-Identifier: Apache-2.0
"""`buckens export`: files of a run for other programs."""

import csv
import json
import struct
import xml.etree.ElementTree
import zlib

import h5py
import numpy
import pytest
import vtk
from vtk.util.numpy_support import vtk_to_numpy

# A block of two materials on a turning beam, hit by a stone: solids, lines, a rigid body.
MODEL = """
buckens: 1
title: Beam, block and stone
materials:
  steel: {E: 210 GPa, nu: 0.3, rho: 7850 kg/m^3}
  alloy: {E: 70 GPa, nu: 0.3, rho: 2700 kg/m^3}
bodies:
  block:
    structure:
      nodes:
        a: {at: [0, 0, 0]}
NODES
      solids:
        - {nodes: [n000, n100, n110, n010, n001, n101, n111, n011], material: steel}
        - {nodes: [n100, n200, n210, n110, n101, n201, n211, n111], material: alloy}
  beam:
    at: {position: [0, 0, 0.1 m]}
    beam: {from: [0.2 m, 0, 0], to: [1.2 m, 0, 0], elements: 4, section: {circle: {diameter: 20 mm}}, material: steel}
  stone:
    at: {position: [1.2 m, 0, 0.1 m]}
    rigid: {mass: 1 kg, inertia: [1e-3, 1e-3, 1e-3]}
    markers: {edge: {position: [0, 50 mm, 0]}}
joints:
  tie: {spherical: {between: [block/n201, beam/start]}}
  grip: {fixed: {between: [beam/end, stone]}}
loads:
  push: {force: {on: stone, value: [0, 0, -100]}}
simulation: {duration: 10 ms, step: 0.5 ms}
output:
  every: 1 ms
  sensors: {tip: {position: beam/end}, pull: {joint-force: grip}, all: {energy: total}}
  fields: {record: [von-mises, stress, velocity], every: 2 ms, at: both}
""".replace("        a: {at: [0, 0, 0]}\nNODES", "\n".join(
    f"        n{i}{j}{k}: [{0.1 * i}, {0.1 * j}, {0.1 * k}]"
    for i in range(3) for j in range(2) for k in range(2)))

NAMES = ["block", "beam", "stone"]
HEX8, LINE, VERTEX = 12, 3, 1


@pytest.fixture
def exported(buckens, tmp_path):
    """Runs the model and exports it; returns the directory of the files and the open results."""
    (tmp_path / "model.yaml").write_text(MODEL)
    buckens("run", "model.yaml", "-o", "out", "-q").must(0)
    results = h5py.File(tmp_path / "out" / "results.h5", "r", swmr=True)

    def call(*arguments):
        return buckens("export", "out", *arguments).must(0)

    call.directory = tmp_path / "out" / "export"
    call.results = results
    yield call
    results.close()


def read_grid(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    problems = []
    reader.AddObserver("ErrorEvent", lambda *_: problems.append(path))
    reader.SetFileName(str(path))
    reader.Update()
    assert not problems
    return reader.GetOutput()


def rotation(q):
    w, x, y, z = q
    return numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def world_points(results, body, record):
    """Deformed nodes in the world, as run-directory.md says."""
    pose = results[f"bodies/{body}/pose"][record]
    nodes = results[f"geometry/bodies/{body}/nodes"][:]
    u = results[f"bodies/{body}/displacement"][record][:, :3]
    return pose[:3] + (nodes + u) @ rotation(pose[3:]).T


def test_vtk_reads_the_files_at_every_instant(exported):
    report = json.loads(exported("--vtk", "--json").out)
    assert report["vtk"]["instants"] == 6
    collection = xml.etree.ElementTree.parse(exported.directory / "out.pvd").getroot()
    entries = [(float(e.get("timestep")), e.get("file")) for e in collection.iter("DataSet")]
    results = exported.results
    assert [t for t, _ in entries] == list(results["fields/time"][:])
    for row, (t, name) in enumerate(entries):
        grid = read_grid(exported.directory / name)
        record = int(numpy.flatnonzero(results["time"][:] == t)[0])
        assert vtk_to_numpy(grid.GetFieldData().GetArray("TimeValue"))[0] == t
        # Twelve nodes of the block, the four between both materials twice; five of the beam; the stone.
        points = vtk_to_numpy(grid.GetPoints().GetData())
        assert points.shape == (16 + 5 + 1, 3)
        block = world_points(results, "block", record)
        assert numpy.abs(points[:12] - block).max() < 1e-12
        assert numpy.abs(points[16:21] - world_points(results, "beam", record)).max() < 1e-12
        assert points[21] == pytest.approx(results["bodies/stone/pose"][record][:3])
        kinds = [grid.GetCellType(c) for c in range(grid.GetNumberOfCells())]
        assert kinds == [HEX8, HEX8, LINE, LINE, LINE, LINE, VERTEX]
        # Both bricks have the right orientation and, up to their strain, the original size.
        sizes = vtk.vtkCellSizeFilter()
        sizes.SetInputData(grid)
        sizes.Update()
        volumes = vtk_to_numpy(sizes.GetOutput().GetCellData().GetArray("Volume"))
        assert volumes[:2] == pytest.approx([1e-3, 1e-3], rel=1e-3)
        check_fields(grid, results, row, record)


def check_fields(grid, results, row, record):
    nodes = results["geometry/bodies/block/field_nodes"][:]
    fields = results["fields/bodies/block/nodes"]
    points = vtk_to_numpy(grid.GetPointData().GetArray("von_mises"))
    velocity = vtk_to_numpy(grid.GetPointData().GetArray("velocity"))
    stress = grid.GetPointData().GetArray("stress")
    assert [stress.GetComponentName(k) for k in range(6)] == ["xx", "yy", "zz", "xy", "yz", "zx"]
    # Cells of a material show the stresses of that material at common nodes.
    places = results["geometry/bodies/block/cell_places"][:].reshape(2, 8)
    for cell in range(2):
        corners = [grid.GetCell(cell).GetPointId(k) for k in range(8)]
        assert (points[corners] == fields["von_mises"][row][places[cell]]).all()
        assert (vtk_to_numpy(stress)[corners] == fields["stress"][row][places[cell]]).all()
        assert (velocity[corners] == fields["velocity"][row][places[cell]]).all()
    assert len(nodes) == 16
    assert numpy.isnan(points[16:]).all()  # no such field on beams and rigid bodies
    assert (velocity[16:21] == results["fields/bodies/beam/nodes/velocity"][row]).all()
    cells = vtk_to_numpy(grid.GetCellData().GetArray("von_mises"))
    assert cells[:2] == pytest.approx(results["bodies/block/solid_stress"][record], rel=1e-6)
    assert cells[2:6] == pytest.approx(results["bodies/beam/stress"][record][:, 1], rel=1e-6)
    assert numpy.isnan(cells[6])
    elements = vtk_to_numpy(grid.GetCellData().GetArray("stress"))
    assert (elements[:2] == results["fields/bodies/block/elements/stress"][row]).all()
    assert list(vtk_to_numpy(grid.GetCellData().GetArray("body"))) == [0, 0, 1, 1, 1, 1, 2]


# A wedge of each order, and two strips of shells, one with two layers.
OTHER_CELLS = """
buckens: 1
title: Wedges and shells
materials: {plain: {E: 210 GPa, nu: 0.3, rho: 7850 kg/m^3}}
bodies:
  curved:
    structure:
      nodes: {a: [0, 0, 0], b: [1, 0, 0], c: [0, 1, 0], d: [0, 0, 1], e: [1, 0, 1], f: [0, 1, 1],
              ab: [0.5, 0, 0], bc: [0.5, 0.5, 0], ca: [0, 0.5, 0], de: [0.5, 0, 1], ef: [0.5, 0.5, 1],
              fd: [0, 0.5, 1], ad: [0, 0, 0.5], be: [1, 0, 0.5], cf: [0, 1, 0.5]}
      solids: [{nodes: [a, b, c, d, e, f, ab, bc, ca, de, ef, fd, ad, be, cf], element: wedge15, material: plain}]
  straight:
    structure:
      nodes: {a: [0, 3, 0], b: [1, 3, 0], c: [0, 4, 0], d: [0, 3, 1], e: [1, 3, 1], f: [0, 4, 1]}
      solids: [{nodes: [a, b, c, d, e, f], element: wedge6, material: plain}]
  thin:
    at: {position: [3 m, 0, 0]}
    mesh: {plate: {size: [1 m, 1 m], divisions: [1, 1], thickness: 10 mm}, material: plain}
  layered:
    at: {position: [6 m, 0, 0]}
    mesh: {plate: {size: [1 m, 1 m], divisions: [2, 1], layers: [{thickness: 5 mm}, {thickness: 5 mm}]}, material: plain}
initial: {bodies: {layered: {nodal-velocity: {x: "0.1*x m/s"}}}}
simulation: {duration: 20 us, step: 10 us}
output: {every: 10 us, fields: [stress]}
"""


def test_wedges_and_shells_of_different_layers_read_right(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(OTHER_CELLS)
    buckens("run", "model.yaml", "-o", "out", "-q").must(0)
    buckens("export", "out", "--vtk", "--at", "20e-6").must(0)
    grid = read_grid(tmp_path / "out" / "export" / "out_0000.vtu")
    assert [grid.GetCellType(c) for c in range(2)] == [26, 13]
    sizes = vtk.vtkCellSizeFilter()
    sizes.SetInputData(grid)
    sizes.Update()
    assert vtk_to_numpy(sizes.GetOutput().GetCellData().GetArray("Volume"))[:2] == pytest.approx([0.5, 0.5])
    with h5py.File(tmp_path / "out" / "results.h5", "r", swmr=True) as file:
        thin = file["fields/bodies/thin/shells/stress"][-1]
        layered = file["fields/bodies/layered/shells/stress"][-1]
    assert thin.shape == (1, 2, 3) and layered.shape == (2, 4, 3) and numpy.abs(layered).max() > 1e3
    stress = vtk_to_numpy(grid.GetCellData().GetArray("shell_stress"))
    assert stress.shape == (5, 12)
    assert (stress[2, :6] == thin.ravel()).all() and numpy.isnan(stress[2, 6:]).all()
    assert (stress[3:] == layered.reshape(2, 12)).all()
    assert numpy.isnan(stress[:2]).all()


def test_single_instants_can_be_asked_for(exported):
    report = json.loads(exported("--vtk", "--at", "0.0041", "--at", "0.01", "--json").out)
    assert report["vtk"]["instants"] == 2
    assert (exported.directory / "out_0001.vtu").exists()
    assert not (exported.directory / "out_0002.vtu").exists()
    grid = read_grid(exported.directory / "out_0000.vtu")
    assert vtk_to_numpy(grid.GetFieldData().GetArray("TimeValue"))[0] == pytest.approx(4e-3)


def test_appended_data_decode_without_vtk(exported):
    """The same by hand: header of 64-bit numbers, blocks of zlib."""
    exported("--vtk", "--count", "1")
    raw = (exported.directory / "out_0000.vtu").read_bytes()
    head, data = raw.split(b'<AppendedData encoding="raw">\n_', 1)
    assert b'compressor="vtkZLibDataCompressor"' in head and b'header_type="UInt64"' in head
    root = xml.etree.ElementTree.fromstring(head + b"</VTKFile>")
    array = next(e for e in root.iter("DataArray") if e.get("Name") == "Points")
    at = int(array.get("offset"))
    blocks, size, last = struct.unpack_from("<3Q", data, at)
    lengths = struct.unpack_from(f"<{blocks}Q", data, at + 24)
    at += 24 + 8 * blocks
    out = b""
    for length in lengths:
        out += zlib.decompress(data[at:at + length])
        at += length
    assert len(out) == (blocks - (last > 0)) * size + last == 22 * 3 * 8
    points = numpy.frombuffer(out).reshape(-1, 3)
    assert numpy.abs(points[:12] - world_points(exported.results, "block", -1)).max() < 1e-12


def test_tables_hold_sensors_fields_and_extremes(exported):
    report = json.loads(exported("--csv", "--at", "0.004", "--json").out)
    assert report["csv"]["files"] == ["sensors.csv", "block_nodes.csv", "block_nodes_extremes.csv",
                                      "block_elements.csv", "block_elements_extremes.csv", "beam_nodes.csv"]
    # The sensors equal those written by the run itself.
    assert (exported.directory / "sensors.csv").read_text() == \
        (exported.directory.parent / "sensors.csv").read_text()
    rows = list(csv.reader((exported.directory / "block_nodes.csv").open()))
    assert rows[0][:6] == ["t [s]", "node", "x [m]", "y [m]", "z [m]", "stress.xx [Pa]"]
    values = numpy.array(rows[1:], dtype=float)
    assert values.shape == (16, 2 + 3 + 6 + 3 + 1)
    results = exported.results
    assert (values[:, 1] == results["geometry/bodies/block/field_nodes"][:] + 1).all()
    assert values[:, 5:11] == pytest.approx(results["fields/bodies/block/nodes/stress"][2], rel=1e-6, abs=1)
    extremes = numpy.array(list(csv.reader((exported.directory / "block_nodes_extremes.csv").open()))[1:], dtype=float)
    assert extremes[:, 4] == pytest.approx(results["extremes/bodies/block/nodes/von_mises"][:])
    assert extremes[:, 5] == pytest.approx(results["extremes/bodies/block/nodes/von_mises_time"][:])


class Glb:
    """A binary glTF file, taken apart by the specification."""

    SIZES = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}
    TYPES = {5121: numpy.uint8, 5125: numpy.uint32, 5126: numpy.float32}

    def __init__(self, path):
        raw = path.read_bytes()
        magic, version, length = struct.unpack_from("<4s2I", raw)
        assert (magic, version, length) == (b"glTF", 2, len(raw))
        size, kind = struct.unpack_from("<I4s", raw, 12)
        assert kind == b"JSON" and size % 4 == 0
        self.json = json.loads(raw[20:20 + size])
        binary, kind = struct.unpack_from("<I4s", raw, 20 + size)
        assert kind == b"BIN\0" and 28 + size + binary == len(raw)
        self.data = raw[28 + size:]
        assert self.json["buffers"] == [{"byteLength": len(self.data)}]

    def values(self, accessor):
        a = self.json["accessors"][accessor]
        view = self.json["bufferViews"][a["bufferView"]]
        assert view["byteOffset"] % 4 == 0
        width = self.SIZES[a["type"]]
        kind = self.TYPES[a["componentType"]]
        assert view["byteLength"] == a["count"] * width * kind().itemsize
        out = numpy.frombuffer(self.data, kind, a["count"] * width, view["byteOffset"])
        out = out.reshape(-1, width) if width > 1 else out
        if "min" in a:
            assert numpy.allclose(out.min(0), numpy.squeeze(a["min"]))
            assert numpy.allclose(out.max(0), numpy.squeeze(a["max"]))
        return out


def test_glb_moves_and_deforms_as_the_run(exported):
    report = json.loads(exported("--glb", "--at", "0.006", "--json").out)["glb"]
    glb = Glb(exported.directory / "out.glb")
    results = exported.results
    assert glb.json["asset"]["version"] == "2.0"
    assert [node["name"] for node in glb.json["nodes"]] == NAMES
    assert glb.json["scenes"][glb.json["scene"]]["nodes"] == [0, 1, 2]
    animation = glb.json["animations"][0]
    curves = {}
    for channel in animation["channels"]:
        sampler = animation["samplers"][channel["sampler"]]
        target = channel["target"]
        curves[NAMES[target["node"]], target["path"]] = sampler
        assert "min" in glb.json["accessors"][sampler["input"]]
    times = glb.values(curves["block", "translation"]["input"])
    assert times[0] == 0 and times[-1] == pytest.approx(report["playback"]) and len(times) == 6
    assert report["shape_error"] < 1e-4
    records = [int(numpy.flatnonzero(results["time"][:] == t)[0]) for t in results["fields/time"][:]]
    for body in NAMES:
        pose = results[f"bodies/{body}/pose"][:][records]
        moved = glb.values(curves[body, "translation"]["output"])
        turned = glb.values(curves[body, "rotation"]["output"])
        # Single precision.
        assert moved == pytest.approx(pose[:, :3], abs=1e-6)
        same = numpy.abs((turned[:, [3, 0, 1, 2]] * pose[:, 3:]).sum(1))
        assert same == pytest.approx(numpy.ones(6), abs=1e-6)
    check_block(glb, curves, results, records)
    stone = glb.json["meshes"][glb.json["nodes"][2]["mesh"]]["primitives"][0]
    assert stone["mode"] == 1  # lines to the markers


def check_block(glb, curves, results, records):
    mesh = glb.json["meshes"][glb.json["nodes"][0]["mesh"]]
    primitive = mesh["primitives"][0]
    rest = glb.values(primitive["attributes"]["POSITION"])
    triangles = glb.values(primitive["indices"]).reshape(-1, 3)
    assert len(rest) == 12 and len(triangles) == 20
    # All normals point outwards.
    corners = rest[triangles]
    normals = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert (((corners.mean(1) - rest.mean(0)) * normals).sum(1) > 0).all()
    colours = glb.values(primitive["attributes"]["COLOR_0"])
    assert colours.shape == (12, 4)
    # The beam has by far the larger stresses: the block is dark, the beam changes colour along its length.
    beam = glb.json["meshes"][glb.json["nodes"][1]["mesh"]]["primitives"][0]
    assert len({tuple(c) for c in glb.values(beam["attributes"]["COLOR_0"])}) >= 3
    shapes = numpy.array([glb.values(target["POSITION"]) for target in primitive["targets"]])
    assert len(shapes) == len(mesh["weights"]) <= 8
    weights = glb.values(curves["block", "weights"]["output"]).reshape(6, len(shapes))
    # Vertices in the order of nodes in the file of faces: found by position.
    nodes = results["geometry/bodies/block/nodes"][:]
    order = [int(numpy.abs(nodes - place).sum(1).argmin()) for place in rest]
    u = results["bodies/block/displacement"][:][records][:, order, :3]
    found = numpy.einsum("fk,kvc->fvc", weights, shapes)
    assert numpy.abs(found - u).max() < 2e-4 * numpy.abs(u).max()
    still = numpy.einsum("k,kvc->vc", mesh["weights"], shapes)
    assert numpy.abs(still - u[3]).max() < 2e-4 * numpy.abs(u).max()


def test_exaggeration_stretches_deformations_only(exported):
    exported("--glb")
    plain = Glb(exported.directory / "out.glb")
    exported("--glb", "--exaggerate", "10", "--playback", "3", "-o", exported.directory / "more")
    more = Glb(exported.directory / "more" / "out.glb")

    def deformation(glb):
        mesh = glb.json["meshes"][0]
        shapes = [glb.values(t["POSITION"]) for t in mesh["primitives"][0]["targets"]]
        return numpy.einsum("k,kvc->vc", mesh["weights"], numpy.array(shapes))

    assert deformation(more) == pytest.approx(10 * deformation(plain), rel=1e-3, abs=1e-9)
    assert more.json["nodes"][0]["translation"] == plain.json["nodes"][0]["translation"]
    assert more.json["extras"]["playback"] == 3


def test_runs_without_fields_are_exported_by_records(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(MODEL[:MODEL.index("  fields:")])
    buckens("run", "model.yaml", "-o", "out", "-q").must(0)
    report = buckens("export", "out", "--vtk", "--csv", "--glb", "--json").must(0).json
    assert report["vtk"]["instants"] == 11
    assert report["csv"]["files"] == ["sensors.csv"]
    grid = read_grid(tmp_path / "out" / "export" / "out_0010.vtu")
    assert grid.GetNumberOfPoints() == 12 + 5 + 1
    assert report["glb"]["von_mises_max"] > 0


def test_bad_requests_are_named(exported, buckens, tmp_path):
    buckens("export", "out").must(2, "--vtk", "--csv", "--glb")
    buckens("export", "out", "--vtk", "--at", "1").must(2, "no instant 1 s", "0.01 s")
    buckens("export", "nowhere", "--vtk").must(5, "not a run directory")
    (tmp_path / "file").write_text("")
    buckens("export", "out", "--vtk", "-o", "file/in").must(5, "file/in")
