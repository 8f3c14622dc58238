# SPDX-License-Identifier: Apache-2.0
"""Meshes from arrays: nodes, cells and sets, in the conventions of meshio, PyVista and h5py."""

from __future__ import annotations

import io
import re
from typing import Any, Dict, Iterator, List, Mapping, Tuple

import numpy as np
import numpy.typing as npt

from .errors import InputError

Numbers = npt.NDArray[Any]

# Cell kinds as named by meshio, with nodes in VTK order, and the element type of a deck with the same
# node order.
CELLS: Dict[str, Tuple[str, int]] = {
    "tetra": ("C3D4", 4), "tetra10": ("C3D10", 10), "hexahedron": ("C3D8", 8),
    "hexahedron20": ("C3D20", 20), "wedge": ("C3D6", 6), "wedge15": ("C3D15", 15),
    "pyramid": ("C3D5", 5), "triangle": ("S3", 3), "quad": ("S4", 4), "triangle6": ("S6", 6),
    "quad8": ("S8", 8), "line": ("B31", 2)}

# Corners of the faces S1, S2, ... of solids.
_FACES: Dict[str, Tuple[Tuple[int, ...], ...]] = {
    "tetra": ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)),
    "hexahedron": ((0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)),
    "wedge": ((0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)),
    "pyramid": ((0, 1, 2, 3), (0, 4, 1), (1, 4, 2), (2, 4, 3), (3, 4, 0))}

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_.-]{0,78}")


class ArrayMesh:
    """A mesh given as arrays instead of a file: ``buckens.Mesh(file=ArrayMesh(nodes, cells), material=...)``.

    Parameters
    ----------
    nodes : (n, 3)
        Coordinates in model axes, in metres or in the ``length_unit`` of the mesh.
    cells
        Zero-based node numbers by cell kind: ``{"hexahedron": (m, 8)}``. Kinds and node order follow
        meshio and VTK: tetra, tetra10, hexahedron, hexahedron20, wedge, wedge15, pyramid, triangle,
        triangle6, quad, quad8, line.
    node_sets
        Node numbers by name, for ``interfaces: {pin: {set: tip}}``.
    cell_sets
        Cell numbers by name, numbered through all kinds in the order of ``cells``; for ``materials``,
        ``sections`` and ``only``.
    faces
        Faces of solids by name, as rows of node numbers (corner nodes are enough), for
        ``interfaces: {pin: {face: top}}`` and pressures.

    Examples
    --------
    >>> import numpy as np
    >>> block = ArrayMesh(np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]]),
    ...                   {"tetra": [[0, 1, 2, 3]]}, faces={"floor": [[0, 1, 2]]})
    >>> block
    <buckens.ArrayMesh: 4 nodes, 1 tetra, face floor>
    """

    def __init__(self, nodes: npt.ArrayLike, cells: Mapping[str, npt.ArrayLike],
                 node_sets: Mapping[str, npt.ArrayLike] = {},
                 cell_sets: Mapping[str, npt.ArrayLike] = {},
                 faces: Mapping[str, npt.ArrayLike] = {}) -> None:
        self.nodes = _coordinates(nodes)
        if not isinstance(cells, Mapping) or not cells:
            raise InputError(f"cells: expected node numbers by kind, such as {{'tetra': array}}, found {cells!r}")
        self.cells: Dict[str, Numbers] = {}
        for kind, rows in cells.items():
            if kind not in CELLS:
                raise InputError(f"cells: unknown kind {kind!r}; known kinds are {', '.join(CELLS)}")
            table = _numbers(f"cells[{kind!r}]", rows, len(self.nodes), "nodes")
            if table.ndim != 2 or table.shape[1] != CELLS[kind][1]:
                raise InputError(f"cells[{kind!r}]: expected rows of {CELLS[kind][1]} nodes, found an array "
                                 f"of shape {table.shape}")
            self.cells[kind] = table
        count = sum(len(rows) for rows in self.cells.values())
        if count == 0:
            raise InputError("cells: none are given")
        self.node_sets = {name: _set("node_sets", name, v, len(self.nodes), "nodes")
                          for name, v in node_sets.items()}
        self.cell_sets = {name: _set("cell_sets", name, v, count, "cells")
                          for name, v in cell_sets.items()}
        self.faces = {name: _set("faces", name, v, len(self.nodes), "nodes") for name, v in faces.items()}
        folded = [name.upper() for name in [*self.node_sets, *self.cell_sets, *self.faces]]
        for name in folded:
            if folded.count(name) > 1:
                raise InputError(f"the name {name!r} stands for several sets or faces (upper and lower case "
                                 "letters count as the same); names must differ")
        self._sides = dict(self._find_sides()) if self.faces else {}

    def _find_sides(self) -> Iterator[Tuple[str, List[Tuple[int, int]]]]:
        """Yields each face as a list of (element, side) with numbers from 1."""
        sides: Dict[Tuple[int, ...], Tuple[int, int]] = {}
        first = 1
        for kind, rows in self.cells.items():
            for side, corners in enumerate(_FACES.get(kind.rstrip("0123456789"), ())):
                for row, key in enumerate(np.sort(rows[:, corners], axis=1).tolist()):
                    # For a face inside the mesh, either side will do.
                    sides[tuple(key)] = (first + row, side + 1)
            first += len(rows)
        for name, table in self.faces.items():
            num_corners = {3: 3, 4: 4, 6: 3, 8: 4}.get(table.shape[-1], 0)
            if table.ndim != 2 or num_corners == 0:
                raise InputError(f"faces[{name!r}]: expected rows of 3, 4, 6 or 8 nodes, found an array of "
                                 f"shape {table.shape}")
            found: List[Tuple[int, int]] = []
            for row_of_nodes in table[:, :num_corners].tolist():
                its_side = sides.get(tuple(sorted(row_of_nodes)))
                if its_side is None:
                    raise InputError(f"faces[{name!r}]: no solid has a face with the nodes {row_of_nodes}; the "
                                     "numbers count from 0")
                found.append(its_side)
            yield name, found

    def to_deck(self) -> bytes:
        """Returns the mesh as a deck (.inp). Nodes are named n1, n2, ..., one more than their index here."""
        out = io.StringIO()
        out.write("*NODE\n")
        for number, (x, y, z) in enumerate(self.nodes.tolist(), 1):
            out.write(f"{number},{x!r},{y!r},{z!r}\n")
        first = 1
        for kind, rows in self.cells.items():
            out.write(f"*ELEMENT, TYPE={CELLS[kind][0]}, ELSET=cells-{kind}\n")
            for number, row in enumerate((rows + 1).tolist(), first):
                _write_list(out, [number, *row])
            first += len(rows)
        for keyword, sets in (("*NSET, NSET", self.node_sets), ("*ELSET, ELSET", self.cell_sets)):
            for name, members in sets.items():
                out.write(f"{keyword}={name}\n")
                for start in range(0, len(members), 16):
                    out.write(",".join(map(str, (members[start:start + 16] + 1).tolist())) + "\n")
        for name, found in self._sides.items():
            out.write(f"*SURFACE, NAME={name}, TYPE=ELEMENT\n")
            out.writelines(f"{element},S{side}\n" for element, side in found)
        return out.getvalue().encode("ascii")

    def __repr__(self) -> str:
        parts = [f"{len(self.nodes)} nodes"]
        parts += [f"{len(rows)} {kind}" for kind, rows in self.cells.items()]
        for word, sets in (("node set", self.node_sets), ("cell set", self.cell_sets), ("face", self.faces)):
            if sets:
                parts.append(f"{word}{'s' if len(sets) > 1 else ''} {', '.join(sets)}")
        return f"<buckens.ArrayMesh: {', '.join(parts)}>"


def _write_list(out: io.StringIO, numbers: List[int]) -> None:
    """Writes lines of at most 15 entries; a trailing comma continues a line."""
    for start in range(0, len(numbers), 15):
        out.write(",".join(map(str, numbers[start:start + 15])))
        out.write(",\n" if start + 15 < len(numbers) else "\n")


def _coordinates(nodes: npt.ArrayLike) -> Numbers:
    try:
        table = np.asarray(nodes, dtype=np.float64)
    except (TypeError, ValueError):
        raise InputError(f"nodes: expected an array of numbers, found dtype "
                         f"{np.asarray(nodes, dtype=object).dtype}") from None
    if table.ndim != 2 or table.shape[1] != 3 or len(table) == 0:
        raise InputError(f"nodes: expected rows of three coordinates, found an array of shape {table.shape}")
    wrong = np.flatnonzero(~np.isfinite(table).all(axis=1))
    if len(wrong):
        raise InputError(f"nodes[{wrong[0]}]: expected finite coordinates, found {table[wrong[0]].tolist()}")
    return table


def _numbers(what: str, values: npt.ArrayLike, count: int, of: str) -> Numbers:
    """Converts to integers and checks that they are from 0 to count - 1."""
    try:
        table = np.asarray(values)
    except ValueError:
        raise InputError(f"{what}: expected rows of equal length") from None
    if table.size == 0:
        return table.astype(np.int64)
    if table.dtype.kind not in "iu":
        raise InputError(f"{what}: expected whole numbers, found dtype {table.dtype}")
    if table.min() < 0 or table.max() >= count:
        wrong = int(table.min() if table.min() < 0 else table.max())
        raise InputError(f"{what}: found {wrong}; the {count} {of} have the numbers 0 to {count - 1}")
    return table.astype(np.int64)


def _set(kind: str, name: str, values: npt.ArrayLike, count: int, of: str) -> Numbers:
    if not isinstance(name, str) or not _NAME.fullmatch(name):
        raise InputError(f"{kind}: expected a name of letters, digits, '_', '-' and '.', found {name!r}")
    table = _numbers(f"{kind}[{name!r}]", values, count, of)
    if table.size == 0:
        raise InputError(f"{kind}[{name!r}]: it is empty")
    if kind != "faces" and table.ndim != 1:
        raise InputError(f"{kind}[{name!r}]: expected a list of numbers, found an array of shape {table.shape}")
    return table
