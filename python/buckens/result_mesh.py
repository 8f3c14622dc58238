# SPDX-License-Identifier: Apache-2.0
"""The mesh of a body in a run, for meshio, PyVista or user code."""

from __future__ import annotations

from typing import Any, Dict, List, Tuple

import numpy as np
import numpy.typing as npt

from .other_packages import package

Numbers = npt.NDArray[Any]

# Cell kinds of results.h5, meshio's names and VTK's cell types; the node order is the same.
_KINDS: Dict[str, Tuple[str, int, int]] = {
    "line2": ("line", 3, 2), "tri3": ("triangle", 5, 3), "tri6": ("triangle6", 22, 6),
    "quad4": ("quad", 9, 4), "quad8": ("quad8", 23, 8), "tet4": ("tetra", 10, 4),
    "tet10": ("tetra10", 24, 10), "pyramid5": ("pyramid", 14, 5), "wedge6": ("wedge", 13, 6),
    "wedge15": ("wedge15", 26, 15), "hex8": ("hexahedron", 12, 8), "hex20": ("hexahedron20", 25, 20)}


class ResultMesh:
    """Nodes and cells of a body.

    Attributes
    ----------
    points : (n, 3) array
        Node coordinates [m]: undeformed in body axes, or at an instant in world axes.
    cells : dict
        Zero-based node numbers by cell kind, ``{"hexahedron": (m, 8)}``, with the names and node order of meshio
        and VTK. Beams and bars are "line".
    """

    def __init__(self, points: Numbers, cells: Dict[str, Numbers]) -> None:
        self.points = points
        self.cells = cells

    def to_meshio(self) -> Any:
        """Converts to a meshio.Mesh."""
        return package("meshio", "to_meshio").Mesh(self.points, list(self.cells.items()))

    def to_pyvista(self) -> Any:
        """Converts to a pyvista.UnstructuredGrid."""
        pyvista = package("pyvista", "to_pyvista")
        rows, kinds = self.to_vtk()
        return pyvista.UnstructuredGrid(rows, kinds, self.points)

    def to_vtk(self) -> "tuple[Numbers, Numbers]":
        """Returns cells for VTK, each preceded by its number of nodes, and VTK's cell types."""
        numbers = {name: (vtk, count) for name, vtk, count in _KINDS.values()}
        rows: List[Numbers] = []
        kinds: List[Numbers] = []
        for name, table in self.cells.items():
            vtk, count = numbers[name]
            rows.append(np.insert(table, 0, count, axis=1).ravel())
            kinds.append(np.full(len(table), vtk, dtype=np.uint8))
        if not rows:
            return np.empty(0, dtype=np.int64), np.empty(0, dtype=np.uint8)
        return np.concatenate(rows), np.concatenate(kinds)

    def __repr__(self) -> str:
        parts = [f"{len(self.points)} nodes"] + [f"{len(rows)} {kind}" for kind, rows in self.cells.items()]
        return f"<buckens.ResultMesh: {', '.join(parts)}>"


def read_mesh(file: Any, body: str) -> "ResultMesh":
    """The undeformed mesh of a body, from an open results.h5. Rigid bodies have none."""
    if "geometry/tables" in file:
        return ResultMesh(np.empty((0, 3)), {})
    geometry = file[f"geometry/bodies/{body}"]
    cells: Dict[str, List[Numbers]] = {}
    if "elements" in geometry and len(geometry["elements"]):
        cells["line"] = [np.asarray(geometry["elements"][:], dtype=np.int64)]
    if "cell_kinds" in geometry:
        names = [text.decode() if isinstance(text, bytes) else str(text)
                 for text in geometry["cell_kinds"].attrs["kinds"]]
        nodes = np.asarray(geometry["cell_nodes"][:], dtype=np.int64)
        kinds = [_KINDS[names[kind]] for kind in geometry["cell_kinds"][:]]
        ends = np.cumsum([0] + [count for _, _, count in kinds])
        for i, (name, _, _) in enumerate(kinds):
            cells.setdefault(name, []).append(nodes[ends[i]:ends[i + 1]][None])
    points = geometry["nodes"][:] if "nodes" in geometry else np.empty((0, 3))
    return ResultMesh(np.asarray(points, dtype=np.float64),
                      {name: np.concatenate(rows) for name, rows in cells.items()})


def placed(mesh: ResultMesh, pose: Numbers, displacement: Numbers) -> ResultMesh:
    """Returns the deformed mesh in world axes."""
    w, x, y, z = pose[3:7]
    rotation = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                         [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                         [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])
    return ResultMesh(pose[:3] + (mesh.points + displacement) @ rotation.T, mesh.cells)
