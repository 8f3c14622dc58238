# SPDX-License-Identifier: Apache-2.0
"""Meshes and matrices that are given as arrays, and meshes that come back."""

import importlib.util
import itertools
import pathlib
import shutil
import sys
import time
import types

import numpy as np
import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent / "support"))
from python_module import buckens  # noqa: E402 (found after the path is set)

STEEL = {"E": "200 GPa", "nu": 0.3, "rho": 7850}
SIZE, DIVISIONS = np.array([0.2, 0.02, 0.01]), np.array([4, 2, 1])


def block(order=1, **sets):
    """A block of hexahedra as `mesh: {box: ...}` makes it, nodes along x first."""
    counts = DIVISIONS + 1
    grid = [np.arange(n) for n in counts]
    number = {ijk: k for k, ijk in enumerate((i, j, m) for m in grid[2] for j in grid[1] for i in grid[0])}
    nodes = np.array(list(number)) * SIZE / DIVISIONS
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    cells = [[number[i + a, j + b, m + c] for a, b, c in corners]
             for m in range(DIVISIONS[2]) for j in range(DIVISIONS[1]) for i in range(DIVISIONS[0])]
    face = [[number[0, j, m], number[0, j, m + 1], number[0, j + 1, m + 1], number[0, j + 1, m]]
            for m in range(DIVISIONS[2]) for j in range(DIVISIONS[1])]
    tip = [k for ijk, k in number.items() if ijk[0] == DIVISIONS[0]]
    return buckens.ArrayMesh(nodes, {"hexahedron": np.array(cells)}, faces={"root": face},
                             node_sets={"tip": tip}, cell_sets={"Housing": np.arange(len(cells))}, **sets)


def model(mesh, **others):
    interfaces = {"root": {"face": "root" if "file" in mesh else "x0", "kind": "rigid"},
                  "tip": {"set": "tip"} if "file" in mesh else {"face": "x1"}}
    return buckens.Model(
        title="Block", gravity=[0, 0, -9.81], materials={"steel": STEEL},
        bodies={"block": {"mesh": mesh, "interfaces": interfaces}},
        joints={"clamp": {"fixed": {"between": ["ground", "block/root"]}}},
        simulation={"duration": "2 ms", "step": "0.1 ms"},
        output={"every": "0.5 ms", "sensors": {"tip": {"position": "block/n15"} if "file" in mesh else
                                               {"position": "block/tip"}}}, **others)


def test_a_block_of_arrays_is_the_generated_one():
    ours = buckens.check(model({"file": block(), "material": "steel"}))
    made = buckens.check(model({"box": {"size": list(SIZE), "divisions": [4, 2, 1]}, "material": "steel"}))
    first, second = ours["bodies"]["block"], made["bodies"]["block"]
    assert first["mass"] == pytest.approx(np.prod(SIZE) * 7850, rel=1e-12)
    assert first["nodes"] == second["nodes"] == 30 and first["elements"] == second["elements"] == 8
    # The same elements in the same order: to the rounding of an eigenvalue problem.
    for key in ("mass", "frequencies", "lowest_frequency"):
        if key in second:
            assert first[key] == pytest.approx(second[key], rel=1e-9)
    by_set = model({"file": block(), "materials": {"Housing": "steel"}})
    assert buckens.check(by_set)["bodies"]["block"]["mass"] == pytest.approx(first["mass"], rel=1e-14)


def test_a_run_holds_its_arrays(tmp_path):
    built = model({"file": block(), "material": "steel"})
    sim = buckens.Simulation(built, out=tmp_path / "out")
    sim.run()
    del sim, built
    first = buckens.open(tmp_path / "out")
    # Its model file can be run again, here after nothing else is left of the arrays.
    decks = list((tmp_path / "out").glob("*.inp"))
    assert len(decks) == 1
    again = buckens.load(tmp_path / "out" / "model.yaml")
    buckens.Simulation(again, out=tmp_path / "again").run()
    assert np.array_equal(first["tip"], buckens.open(tmp_path / "again")["tip"])


def test_a_saved_model_takes_its_arrays_along(tmp_path):
    built = model({"file": block(), "material": "steel"})
    (tmp_path / "first").mkdir()
    built.save(tmp_path / "first" / "block.yaml")
    names = sorted(file.name for file in (tmp_path / "first").iterdir())
    assert len(names) == 2 and names[0].startswith("block-mesh-") and names[1] == "block.yaml"
    assert f"file: {names[0]}" in (tmp_path / "first" / "block.yaml").read_text()
    shutil.move(tmp_path / "first", tmp_path / "second")
    loaded = buckens.load(tmp_path / "second" / "block.yaml")
    assert buckens.check(loaded)["bodies"] == buckens.check(built)["bodies"]
    # Changes keep the arrays as well.
    (tmp_path / "law.csv").write_text("0,0\n1,1\n")
    with_others = model({"file": block(), "material": "steel"}, loads={"push": {"force": {
        "on": "block/n15", "value": [0, {"table": tmp_path / "law.csv", "unit": "N"}, 0]}}})
    with_others.save(tmp_path / "others.yaml")
    assert buckens.check(tmp_path / "others.yaml")["bodies"] == buckens.check(with_others)["bodies"]
    finer = built.with_changes({"simulation.step": "0.05 ms"})
    del built
    sim = buckens.Simulation(finer)
    assert sim.run()["steps"] == 40


def test_a_state_continues_with_arrays_of_another_model(tmp_path):
    """Where the files of arrays lie is no part of the model."""
    def make():
        return model({"file": block(), "material": "steel"})

    whole = buckens.Simulation(make())
    whole.run()
    half = buckens.Simulation(make())
    half.advance(1e-3)
    half.save(tmp_path / "half.h5")
    rest = buckens.Simulation.resume(tmp_path / "half.h5", make())
    rest.run()
    assert np.array_equal(rest.sensors["tip"], whole.sensors["tip"])


def tetrahedron(mass, stiffness):
    """Four equal masses at the corners of a regular tetrahedron, and springs along its edges."""
    nodes = 0.1 * np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1.0]])
    k = np.zeros((12, 12))
    for a, b in itertools.combinations(range(4), 2):
        n = (nodes[b] - nodes[a]) / np.linalg.norm(nodes[b] - nodes[a])
        for i, j, sign in ((a, a, 1), (b, b, 1), (a, b, -1), (b, a, -1)):
            k[3 * i:3 * i + 3, 3 * j:3 * j + 3] += sign * stiffness * np.outer(n, n)
    return nodes, mass * np.eye(12), k


@pytest.mark.parametrize("kind", ["sparse", "array", "matrix"])
def test_matrices_of_a_tetrahedron(kind, tmp_path):
    nodes, m, k = tetrahedron(0.25, 4000.0)
    if kind == "sparse":
        sparse = pytest.importorskip("scipy.sparse")
        m, k = sparse.csr_matrix(m), sparse.coo_matrix(k)
    elif kind == "matrix":
        m, k = np.matrix(m), np.matrix(k)
    built = buckens.Model(bodies={"cage": buckens.Matrices(mass=m, stiffness=k, nodes=nodes)})
    found = [mode["frequency"] for mode in buckens.modes(built, body="cage", count=6)["analyses"][0]["modes"]]
    # Stretching alone: w^2 m/k is 1 (twice), 2 (three times) and 4, as in the molecule P4.
    exact = np.sqrt(np.array([1, 1, 2, 2, 2, 4]) * 4000.0 / 0.25) / (2 * np.pi)
    assert found == pytest.approx(exact, rel=1e-9)
    built.save(tmp_path / "cage.yaml")
    assert sorted(file.suffix for file in tmp_path.iterdir()) == [".csv", ".mtx", ".mtx", ".yaml"]
    assert buckens.check(tmp_path / "cage.yaml")["bodies"]["cage"]["mass"] == pytest.approx(1.0)


def test_matrices_that_do_not_fit_name_their_body():
    nodes, m, k = tetrahedron(0.25, 4000.0)
    skew = k.copy()
    skew[0, 1] += 1
    nine = np.eye(9)
    for change, words in (({"mass": m + np.triu(m, 0) + np.eye(12, k=1)}, "bodies.cage.matrices.mass: the matrix is not symmetric"),
                          ({"stiffness": skew}, "bodies.cage.matrices.stiffness: the matrix is not symmetric"),
                          ({"damping": skew}, "bodies.cage.matrices.damping: the matrix is not symmetric"),
                          ({"stiffness": nine}, "bodies.cage.matrices.stiffness: the matrix has 9 rows"),
                          ({"mass": nine, "stiffness": nine}, "bodies.cage.matrices.stiffness: the matrix has 9 rows, the table 4 nodes")):
        with pytest.raises(buckens.InputError) as caught:
            buckens.Model(bodies={"cage": {"matrices": {"mass": m, "stiffness": k, "nodes": nodes, **change}}})
        assert words in str(caught.value)


def test_the_mesh_of_a_run(tmp_path):
    given = block()
    run_of = buckens.Simulation(model({"file": given, "material": "steel"}), out=tmp_path / "out")
    run_of.run()
    run = buckens.open(tmp_path / "out")
    mesh = run.mesh("block")
    assert repr(mesh) == "<buckens.ResultMesh: 30 nodes, 8 hexahedron>"
    assert np.array_equal(mesh.cells["hexahedron"], given.cells["hexahedron"])
    # The frame's origin is the mass centre; axes are those of the model.
    assert mesh.points + SIZE / 2 == pytest.approx(given.nodes, abs=1e-12)
    for row, t in enumerate(run.time):
        assert run.mesh("block", t=t).points[14] == pytest.approx(np.asarray(run["tip"][row]), abs=1e-12)
    rows, kinds = mesh.to_vtk()
    assert len(rows) == 8 * 9 and set(rows[::9]) == {8} and set(kinds) == {12}
    with pytest.raises(buckens.InputError, match="no body 'blok'; the run has block"):
        run.mesh("blok")


@pytest.fixture
def deformed(tmp_path):
    """The mesh of a run at its end."""
    buckens.Simulation(model({"file": block(), "material": "steel"}), out=tmp_path / "out").run()
    return buckens.open(tmp_path / "out").mesh("block", t=2e-3)


def test_a_mesh_for_meshio(deformed, tmp_path):
    meshio = pytest.importorskip("meshio")
    deformed.to_meshio().write(tmp_path / "block.vtu")
    again = meshio.read(tmp_path / "block.vtu")
    assert np.array_equal(again.points, deformed.points)
    assert np.array_equal(again.cells_dict["hexahedron"], deformed.cells["hexahedron"])


def test_a_mesh_for_pyvista(deformed, monkeypatch):
    """Where PyVista is not installed: its class takes cells, kinds and points, and is one of VTK, which measures them here."""
    vtk = pytest.importorskip("vtkmodules.vtkCommonDataModel")
    quality = pytest.importorskip("vtkmodules.vtkFiltersVerdict")
    support = pytest.importorskip("vtkmodules.util.numpy_support")
    core = pytest.importorskip("vtkmodules.vtkCommonCore")

    def grid(rows, kinds, points):
        places, cells, made = core.vtkPoints(), vtk.vtkCellArray(), vtk.vtkUnstructuredGrid()
        places.SetData(support.numpy_to_vtk(points, deep=True))
        cells.ImportLegacyFormat(support.numpy_to_vtkIdTypeArray(np.asarray(rows, dtype=np.int64), deep=True))
        made.SetPoints(places)
        made.SetCells(support.numpy_to_vtk(kinds, deep=True), cells)
        return made

    if importlib.util.find_spec("pyvista") is None:
        monkeypatch.setitem(sys.modules, "pyvista", types.SimpleNamespace(UnstructuredGrid=grid))
    measure = quality.vtkCellSizeFilter()
    measure.SetInputData(deformed.to_pyvista())
    measure.Update()
    volumes = support.vtk_to_numpy(measure.GetOutput().GetCellData().GetArray("Volume"))
    # Micrometres of sag over 200 mm.
    assert len(volumes) == 8 and volumes == pytest.approx(np.prod(SIZE) / 8, rel=1e-3)


def test_the_mesh_of_a_beam(tmp_path):
    sim = buckens.Simulation(buckens.Model(
        materials={"steel": STEEL},
        bodies={"rod": buckens.Beam(to=[1, 0, 0], elements=4, material="steel",
                                    section=buckens.CircleSection(diameter=0.01))},
        simulation={"duration": "1 ms", "step": "1 ms"}), out=tmp_path / "out")
    sim.run()
    mesh = buckens.open(tmp_path / "out").mesh("rod", t=0)
    # From one end to the other, whatever the numbers of the nodes between.
    assert mesh.points[mesh.cells["line"], 0] == pytest.approx(
        np.array([[0, 0.25], [0.25, 0.5], [0.5, 0.75], [0.75, 1]]))


def test_a_page_in_a_notebook_while_the_run_goes_on(tmp_path):
    sim = buckens.Simulation(model({"file": block(), "material": "steel"}), out=tmp_path / "out")
    sim.advance(1e-3)
    run = buckens.open(tmp_path / "out")
    assert run.status == "running"
    while len(run.time) == 0:  # records reach the file within half a second
        time.sleep(0.05)
    page = run.view()
    assert page == str(tmp_path / "out" / "view.html") and "<iframe srcdoc=" in page._repr_html_()
    sim.finish()


TETRA = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])


@pytest.mark.parametrize("arguments, words", [
    (([[0, 0], [1, 0]], {"tetra": [[0, 1, 2, 3]]}), r"nodes: expected rows of three .* shape \(2, 2\)"),
    (([["a", "b", "c"]], {"tetra": [[0, 1, 2, 3]]}), "nodes: expected an array of numbers"),
    ((TETRA * np.array([[1], [1], [np.nan], [1]]), {"tetra": [[0, 1, 2, 3]]}), r"nodes\[2\].*finite"),
    ((TETRA, [[0, 1, 2, 3]]), "node numbers by kind, such as {'tetra'"),
    ((TETRA, {"tet4": [[0, 1, 2, 3]]}), "unknown kind 'tet4'; known kinds are tetra, tetra10"),
    ((TETRA, {"tetra": [[0, 1, 2]]}), r"rows of 4 nodes, found an array of shape \(1, 3\)"),
    ((TETRA, {"tetra": [[0.0, 1, 2, 3]]}), "whole numbers, found dtype float64"),
    ((TETRA, {"tetra": [[1, 2, 3, 4]]}), "found 4; the 4 nodes have the numbers 0 to 3"),
    ((TETRA, {"tetra": np.empty((0, 4), dtype=int)}), "cells: none are given"),
    ((TETRA, {"tetra": [[0, 1, 2, 3]]}, {"a b": [1]}), "expected a name of letters.*'a b'"),
    ((TETRA, {"tetra": [[0, 1, 2, 3]]}, {"a": []}), r"node_sets\['a'\]: it is empty"),
    ((TETRA, {"tetra": [[0, 1, 2, 3]]}, {"a": [1]}, {"A": [0]}), "'A' stands for several"),
    ((TETRA, {"tetra": [[0, 1, 2, 3]]}, {}, {}, {"f": [[0, 1]]}), "rows of 3, 4, 6 or 8 nodes"),
    ((np.vstack([TETRA, [[1, 1, 1]]]), {"tetra": [[0, 1, 2, 3]]}, {}, {}, {"f": [[0, 1, 4]]}),
     r"no solid has a face with the nodes \[0, 1, 4\]"),
])
def test_arrays_that_are_no_mesh(arguments, words):
    with pytest.raises(buckens.InputError, match=words):
        buckens.ArrayMesh(*arguments)


def test_arrays_in_the_wrong_place():
    mesh = buckens.ArrayMesh(TETRA, {"tetra": [[0, 1, 2, 3]]})
    with pytest.raises(buckens.InputError, match="bodies.b.mesh: .*`file` of a `mesh`"):
        buckens.Model(bodies={"b": {"mesh": mesh}})
    nodes, m, k = tetrahedron(1.0, 1.0)
    for change, words in (
            ({"nodes": nodes[:, :2]}, r"bodies.b.matrices.nodes: .*\(nodes, 3\).*\(4, 2\)"),
            ({"mass": m[:6]}, r"matrices.mass: expected a square matrix, found one of shape \(6, 12\)"),
            ({"mass": m[0]}, r"matrices.mass: expected a matrix, found an array of shape \(12,\)"),
            ({"stiffness": k * 1j}, "matrices.stiffness: .*real numbers, found dtype complex128"),
            ({"stiffness": k * np.nan}, "matrices.stiffness: expected finite numbers, found nan in row 0, column 0"),
            ({"nodes": nodes * np.inf}, "matrices.nodes: expected finite coordinates.* in row 0")):
        with pytest.raises(buckens.Error, match=words):
            buckens.Simulation(buckens.Model(
                bodies={"b": {"matrices": {"mass": m, "stiffness": k, "nodes": nodes, **change}}},
                simulation={"duration": 1, "step": 1}))
