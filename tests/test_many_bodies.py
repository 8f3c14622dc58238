# SPDX-License-Identifier: Apache-2.0
"""Runs of thousands of rigid bodies: page, exports, curves, comparison and Python read the tables of all bodies."""

import base64
import json
import pathlib
import re
import shutil
import struct
import subprocess
import sys

import h5py
import numpy as np
import pytest
import vtk
from vtk.util.numpy_support import vtk_to_numpy

from conftest import PROGRAM

LINKS = 1501  # and as many joints: more than 3000
RECORDS = 3


def chain(links):
    """A chain that is let go as a slanting line, so that every number differs from its neighbours."""
    bodies, joints = [], []
    for k in range(links):
        at = 0.1 * k + 0.05
        bodies.append(f"  link_{k}: {{rigid: {{mass: 1 kg, inertia: [1e-3, 1e-3, 1e-3]}}, at: {{position: [{0.6 * at}, {0.8 * at}, 0], "
                      f"orientation: {{axis: [0, 0, 1], angle: {np.arctan2(0.8, 0.6)!r}}}}}, "
                      "markers: {a: {position: [-0.05, 0, 0]}, b: {position: [0.05, 0, 0]}}}")
        before = f"link_{k - 1}/b" if k else "ground"
        joints.append(f"  pin_{k}: {{revolute: {{between: [{before}, link_{k}/a], axis: [0, 0, 1]}}}}")
    return "\n".join(["buckens: 1", "title: Chain", "gravity: [0, -9.81, 0]", "bodies:", *bodies, "joints:", *joints,
                      f"simulation: {{duration: {RECORDS - 1} ms, step: 1 ms}}",
                      f"output: {{every: 1 ms, sensors: {{tip: {{position: {{of: link_{links - 1}/b}}}}}}}}"])


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """A run, and what its tables hold: motions and reactions."""
    directory = tmp_path_factory.mktemp("crowd")
    (directory / "chain.yaml").write_text(chain(LINKS))
    subprocess.run([PROGRAM, "run", "chain.yaml", "-o", "out", "-q"], cwd=directory, check=True, timeout=300)
    with h5py.File(directory / "out" / "results.h5", "r", swmr=True) as file:
        assert "bodies" not in file and "bodies" not in file["geometry"]
        return directory, file["motions"][:], file["reactions"][:]


def page_of(path):
    (text,) = re.findall(r"BUCKENS_DATA = (\{.*?\})\s*;?\s*</script>", path.read_text(), re.DOTALL)
    return json.loads(text)["runs"][0]


def numbers(text, width):
    return np.frombuffer(base64.b64decode(text), "<f4").reshape(-1, width)


def test_the_page_moves_all_bodies(run, buckens, tmp_path):
    directory, motions, reactions = run
    buckens("view", directory / "out", "-o", tmp_path / "view.html").must(0)
    page = page_of(tmp_path / "view.html")
    assert [body["name"] for body in page["bodies"]] == [f"link_{k}" for k in range(LINKS)]
    for k in (0, 700, LINKS - 1):
        # Single precision of numbers up to 150.
        assert numbers(page["bodies"][k]["pose"], 7) == pytest.approx(motions[:, k, :7], abs=1e-5)
        assert [marker["name"] for marker in page["bodies"][k]["markers"]] == ["a", "b"]
        joint = page["joints"][k]
        assert joint["name"] == f"pin_{k}" and joint["between"][1]["body"] == k
        largest = np.abs(reactions).max()
        assert numbers(joint["force"], 3) == pytest.approx(reactions[:, k, :3], abs=1e-6 * largest)
        assert numbers(joint["torque"], 3) == pytest.approx(reactions[:, k, 3:], abs=1e-6 * largest)
    assert page["summary"]["rigid_bodies"] == LINKS and page["summary"]["bodies"] == {}
    assert np.ptp(numbers(page["bodies"][-1]["pose"], 7)[:, 1]) > 1e-6


def test_exports_hold_all_bodies_at_their_places(run, buckens, tmp_path):
    directory, motions, _ = run
    buckens("export", directory / "out", "--vtk", "--count", RECORDS, "-o", tmp_path / "vtk").must(0)
    files = sorted((tmp_path / "vtk").glob("*.vtu"))
    assert len(files) == RECORDS
    for record, path in enumerate(files):
        points = points_of(path)
        # Single precision of numbers up to 150.
        assert points == pytest.approx(motions[record, :, :3], abs=1e-5)
    buckens("export", directory / "out", "--glb", "-o", tmp_path / "glb").must(0)
    (path,) = (tmp_path / "glb").glob("*.glb")
    data = path.read_bytes()
    (length,) = struct.unpack_from("<I", data, 12)
    scene = json.loads(data[20:20 + length])
    binary = data[20 + length + 8:]
    assert len(scene["nodes"]) == LINKS
    assert scene["nodes"][700]["translation"] == pytest.approx(motions[-1, 700, :3], rel=1e-12)
    animation = scene["animations"][0]
    (channel,) = [c for c in animation["channels"] if c["target"] == {"node": 700, "path": "translation"}]
    accessor = scene["accessors"][animation["samplers"][channel["sampler"]]["output"]]
    view = scene["bufferViews"][accessor["bufferView"]]
    begin = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    moved = np.frombuffer(binary, "<f4", 3 * RECORDS, begin).reshape(RECORDS, 3)
    assert moved == pytest.approx(motions[:, 700, :3], abs=1e-5)


def points_of(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    return vtk_to_numpy(reader.GetOutput().GetPoints().GetData())


def test_curves_and_comparison(run, buckens, tmp_path):
    directory, _, _ = run
    out = directory / "out"
    buckens("plot", out, "bodies/link_700/pose.y", "joints/pin_3/force.norm", "-o", tmp_path / "p.svg").must(0)
    assert "link_700" in (tmp_path / "p.svg").read_text()
    buckens("plot", out, "bodies/link_9999/pose.y", "-o", tmp_path / "p.svg").must(2, "bodies/link_9999/pose")
    found = buckens("compare", out, out, "--json").must(0).json
    units = {q["quantity"]: q["unit"] for q in found["quantities"]}
    assert units["motions"] == "m" and units["motions rotation"] == "1"
    assert units["motions velocity"] == "m/s" and units["motions angular velocity"] == "rad/s"
    assert units["reactions"] == "N" and units["reactions moment"] == "N m"
    assert found["largest_relative_difference"] == 0.0


def test_a_run_goes_on(run, buckens, tmp_path):
    directory, motions, reactions = run
    shutil.copytree(directory / "out", tmp_path / "out")
    buckens("run", "--continue", "out", "--until", "0.004", "-q").must(0)
    with h5py.File(tmp_path / "out" / "results.h5", "r", swmr=True) as file:
        assert file["motions"].shape == (5, LINKS, 13) and len(file["geometry/tables/body_names"]) == LINKS
        assert np.array_equal(file["motions"][:RECORDS], motions)
        assert np.array_equal(file["reactions"][:RECORDS], reactions)
    summary = buckens("run", directory / "chain.yaml", "-o", "again").must(0).out
    assert "link_19 " in summary and "link_20 " not in summary and f"{LINKS - 20} more" in summary


def test_python_finds_each_body_and_joint(run):
    sys.path.insert(0, str(pathlib.Path(__file__).parent / "support"))
    from python_module import buckens

    directory, motions, reactions = run
    results = buckens.open(directory / "out")
    pose = results["bodies/link_700/pose"]
    assert np.array_equal(pose, motions[:, 700, :7]) and pose.components[-1] == "qz" and pose.unit == "m, 1"
    assert np.array_equal(results["bodies/link_700/velocity.y"], motions[:, 700, 8])
    assert np.array_equal(results["joints/pin_3/torque"], reactions[:, 3, 3:])
    mesh = results.mesh("link_5", t=1e-3)
    assert mesh.points.shape == (0, 3) and mesh.cells == {}
    with pytest.raises(buckens.InputError, match="did you mean 'link_150'"):
        results.mesh("link_150O")
    with pytest.raises(buckens.InputError, match="nothing is recorded"):
        results["bodies/link_700/displacement"]
    assert results.view() == str(directory / "out" / "view.html")

    simulation = buckens.Simulation(buckens.load(directory / "chain.yaml"))
    simulation.run()
    assert simulation.bodies is simulation.bodies  # made once, not for each body that is asked for
    assert np.array_equal(simulation.value("bodies/link_700/pose"), motions[-1, 700, :7])
    assert np.array_equal(simulation.value("joints/pin_3/force"), reactions[-1, 3, :3])


@pytest.mark.parametrize("name, row, value", [("joint_sides", (7, 0), LINKS), ("joint_sides", (7, 1), 4),
                                              ("marker_counts", 3, -1), ("marker_counts", 3, 10**6)])
def test_damaged_tables_are_refused(run, buckens, tmp_path, name, row, value):
    directory, _, _ = run
    shutil.copytree(directory / "out", tmp_path / "bad")
    with h5py.File(tmp_path / "bad" / "results.h5", "r+") as file:
        file["geometry/tables"][name][row] = value
    buckens("export", "bad", "--csv", "-o", "csv").must(5, "/geometry/tables", "damaged")


def test_motions_of_other_bodies_are_refused(run, buckens, tmp_path):
    directory, motions, _ = run
    shutil.copytree(directory / "out", tmp_path / "bad")
    with h5py.File(tmp_path / "bad" / "results.h5", "r+") as file:
        del file["motions"]
        file["motions"] = motions[:, 1:]
    buckens("export", "bad", "--csv", "-o", "csv").must(5, "/motions", "extents")
