# SPDX-License-Identifier: Apache-2.0
"""Runs of thousands of rigid bodies: two tables in place of data sets for each body and joint."""

from __future__ import annotations

from typing import Any, Dict, List, Optional, Tuple

# Columns of /motions and /reactions (docs/reference/run-directory.md).
_XYZ = ["x", "y", "z"]
_COLUMNS: Dict[str, Tuple[str, str, Dict[str, Tuple[slice, str, List[str]]]]] = {
    "bodies": ("motions", "body_names", {
        "pose": (slice(0, 7), "m, 1", [*_XYZ, "qw", "qx", "qy", "qz"]),
        "velocity": (slice(7, 10), "m/s", _XYZ),
        "angular_velocity": (slice(10, 13), "rad/s", _XYZ)}),
    "joints": ("reactions", "joint_names", {
        "force": (slice(0, 3), "N", _XYZ),
        "torque": (slice(3, 6), "N m", _XYZ)})}


class TablePart:
    """What is recorded of one body or joint in a table of all of them, read like a data set."""

    def __init__(self, table: Any, row: int, columns: slice, unit: str, components: List[str]) -> None:
        self._table, self._row, self._columns = table, row, columns
        self.attrs: Dict[str, Any] = {"unit": unit, "components": components}

    def __getitem__(self, records: Any) -> Any:
        return self._table[records, self._row, self._columns]


class RunTables:
    """Finds data sets of a run by the same paths, whether bodies have data sets of their own or rows."""

    def __init__(self) -> None:
        self._rows: Dict[str, Dict[str, int]] = {}

    def find(self, file: Any, path: str) -> Optional[Any]:
        """What is recorded under a path, None if nothing is."""
        if path in file:
            return file[path] if hasattr(file[path], "dtype") else None
        kind, _, rest = path.partition("/")
        name, _, quantity = rest.rpartition("/")
        if kind not in _COLUMNS:
            return None
        table, _, columns = _COLUMNS[kind]
        if table not in file or quantity not in columns:
            return None
        row = self.rows(file, kind).get(name)
        if row is None or row >= file[table].shape[1]:
            return None
        return TablePart(file[table], row, *columns[quantity])

    def rows(self, file: Any, kind: str) -> Dict[str, int]:
        """Numbers of all "bodies" or "joints" by their names, in the order of the model."""
        if kind not in self._rows:
            self._rows[kind] = _rows(file, kind)
        return self._rows[kind]


def _rows(file: Any, kind: str) -> Dict[str, int]:
    names = f"geometry/tables/{_COLUMNS[kind][1]}"
    if names in file:
        texts = file[names].asstr()[:]
        return {str(text): row for row, text in enumerate(texts)}
    if f"geometry/{kind}" not in file:
        return {}
    groups = file[f"geometry/{kind}"]
    return {name: int(groups[name].attrs["index"]) for name in groups}
