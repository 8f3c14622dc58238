# SPDX-License-Identifier: Apache-2.0
"""Files made from arrays for a model: meshes, matrices and node tables."""

from __future__ import annotations

import hashlib
import io
import json
import os
import tempfile
from typing import Any, Dict, Iterator, Mapping, Optional

import numpy as np

from .array_mesh import ArrayMesh
from .errors import InputError

_MATRICES = (".matrices.mass", ".matrices.stiffness", ".matrices.damping")


class ModelFiles:
    """Files of a model, in a temporary folder that exists as long as this object."""

    def __init__(self) -> None:
        self._folder: Optional[tempfile.TemporaryDirectory[str]] = None
        self._contents: Dict[str, bytes] = {}

    def __bool__(self) -> bool:
        return bool(self._contents)

    def name_of(self, value: Any, place: str) -> Optional[str]:
        """Writes a value that must be a file and returns the file name; None for all other values."""
        content, suffix = _content(value, place)
        if content is None:
            return None
        if self._folder is None:
            self._folder = tempfile.TemporaryDirectory(prefix="buckens-")
        # "bodies.rod.mesh.file" becomes rod-mesh-...; the hash keeps different ones apart.
        words = [word for word in place.split(".")[1:] if word not in ("file", "matrices")]
        stem = "".join(c if c.isalnum() or c in "-_" else "-" for c in "-".join(words)) or "file"
        name = f"{stem}-{hashlib.sha256(content).hexdigest()[:8]}{suffix}"
        if name not in self._contents:
            with open(os.path.join(self._folder.name, name), "wb") as file:
                file.write(content)
            self._contents[name] = content
        return name

    def with_places(self, text: str, tree: Mapping[str, Any], directory: str) -> "tuple[str, str]":
        """Returns the text of a model that can find its files, and the directory for relative names.

        Our file names stay relative, so that a saved state fits the same model in another process. If the model also names
        files of the user, relative names refer to their directory and ours become absolute.
        """
        if self._folder is None:
            return text, directory
        if "base" not in tree and not any(_is_file(value, directory) for value in _texts(tree)):
            return text, self._folder.name
        for name in self._contents:
            text = text.replace(name, os.path.join(self._folder.name, name))
        return text, directory

    def write_beside(self, directory: str, text: str, is_absolute: bool = False) -> str:
        """Writes the files into a directory and returns the model text with their new paths."""
        if self._folder is None:
            return text
        for name, content in self._contents.items():
            if name in text:
                with open(os.path.join(directory, name), "wb") as file:
                    file.write(content)
        place = os.path.abspath(directory)
        text = text.replace(self._folder.name + os.sep, place + os.sep)
        base = f"base: {json.dumps(self._folder.name)}\n"
        return text.replace(base, f"base: {json.dumps(place)}\n" if is_absolute else "")


def _texts(value: Any) -> Iterator[str]:
    """Yields all strings in a tree."""
    if isinstance(value, (str, os.PathLike)):
        yield os.fspath(value)
    elif isinstance(value, Mapping):
        for part in value.values():
            yield from _texts(part)
    elif isinstance(value, (list, tuple)):
        for part in value:
            yield from _texts(part)
    elif hasattr(value, "to_tree"):
        yield from _texts(value.to_tree())


def _is_file(text: str, directory: str) -> bool:
    return len(text) < 1000 and "\0" not in text and os.path.isfile(os.path.join(directory, text))


def _content(value: Any, place: str) -> "tuple[Optional[bytes], str]":
    """Returns content and suffix of the file for a value, or None and an empty suffix."""
    if isinstance(value, ArrayMesh):
        if not place.endswith(".mesh.file"):
            raise InputError(f"{place}: a mesh in arrays stands for the `file` of a `mesh`")
        return value.to_deck(), ".inp"
    is_sparse = hasattr(value, "tocoo")
    if place.endswith(_MATRICES) and (is_sparse or isinstance(value, np.ndarray)):
        return _matrix_market(value, place), ".mtx"
    if is_sparse:
        raise InputError(f"{place}: a sparse matrix stands for `mass`, `stiffness` or `damping` of "
                         "`matrices`, and for nothing else")
    if place.endswith(".matrices.nodes") and not isinstance(value, (str, os.PathLike)):
        return _node_table(value, place), ".csv"
    return None, ""


def _matrix_market(value: Any, place: str) -> bytes:
    """Returns a matrix in Matrix Market format, with all digits of each number."""
    if hasattr(value, "tocoo"):
        table = value.tocoo(copy=True)
        if hasattr(table, "sum_duplicates"):
            table.sum_duplicates()
        rows, columns, numbers = table.row, table.col, table.data
    else:
        if value.ndim != 2:
            raise InputError(f"{place}: expected a matrix, found an array of shape {value.shape}")
        value = np.asarray(value)  # of a numpy.matrix, rows would stay matrices
        rows, columns = np.nonzero(value)
        numbers = value[rows, columns]
    if value.shape[0] != value.shape[1]:
        raise InputError(f"{place}: expected a square matrix, found one of shape {value.shape}")
    if numbers.dtype.kind not in "biuf":
        raise InputError(f"{place}: expected a matrix of real numbers, found dtype {numbers.dtype}")
    wrong = np.flatnonzero(~np.isfinite(numbers))
    if len(wrong):
        raise InputError(f"{place}: expected finite numbers, found {numbers[wrong[0]]} in row {rows[wrong[0]]}, "
                         f"column {columns[wrong[0]]}, counted from 0")
    out = io.StringIO()
    out.write("%%MatrixMarket matrix coordinate real general\n")
    out.write(f"{value.shape[0]} {value.shape[1]} {len(numbers)}\n")
    for row, column, number in zip((rows + 1).tolist(), (columns + 1).tolist(),
                                   numbers.astype(np.float64).tolist()):
        out.write(f"{row} {column} {number!r}\n")
    return out.getvalue().encode("ascii")


def _node_table(value: Any, place: str) -> bytes:
    """Returns coordinates (n, 3) as the table `node,x,y,z`, with node numbers from 1."""
    try:
        table = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError):
        table = np.empty(0)
    if table.ndim != 2 or table.shape[1] != 3:
        raise InputError(f"{place}: expected coordinates, an array of shape (nodes, 3), or the name of a file; "
                         f"found {type(value).__name__}{f' of shape {np.shape(value)}' if np.ndim(value) else ''}")
    wrong = np.flatnonzero(~np.isfinite(table).all(axis=1))
    if len(wrong):
        raise InputError(f"{place}: expected finite coordinates, found {table[wrong[0]].tolist()} in row "
                         f"{wrong[0]}, counted from 0")
    lines = [f"{i},{x!r},{y!r},{z!r}" for i, (x, y, z) in enumerate(table.tolist(), 1)]
    return ("node,x,y,z\n" + "\n".join(lines) + "\n").encode("ascii")
