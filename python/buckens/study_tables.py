# SPDX-License-Identifier: Apache-2.0
"""Converts files, ranges and pandas.DataFrames to tables of variants for the library."""

from __future__ import annotations

import csv
import os
import pathlib
from typing import Any, List, Mapping, NamedTuple, Sequence, Tuple, Union, cast

from . import _core
from .errors import InputError
from .model import PathLike
from .yaml_text import _flow

#: A CSV file, values by path (all combinations are run), or a row per variant: a list of dictionaries or a pandas.DataFrame.
TableLike = Union[PathLike, Mapping[str, Sequence[Any]], Sequence[Mapping[str, Any]], Any]


class VariantTable(NamedTuple):
    """Paths of quantities in the model, and variants with name and values as text."""

    paths: List[str]
    variants: List[Tuple[str, List[str]]]


class _Rows:
    """A list of dictionaries, with what is used of a pandas.DataFrame."""

    def __init__(self, rows: Sequence[Any]) -> None:
        self._rows = rows
        for number, row in enumerate(rows, 1):
            if not isinstance(row, Mapping):
                raise InputError(f"row {number} of the table: expected a dictionary of values by path, such as "
                                 f"{{\"parameters.speed\": 100}}, found {row!r}; for rows without names give "
                                 "pandas.DataFrame(rows, columns=[...])")
        self.columns: List[Any] = list(rows[0]) if rows else []
        for number, row in enumerate(rows, 1):
            odd = sorted(map(str, set(row) ^ set(self.columns)))
            if odd:
                raise InputError(f"row {number} of the table: expected the same quantities as in row 1, but only one of them has "
                                 f"{', '.join(odd)}; repeat the value of the model where a variant does not change it")

    def __len__(self) -> int:
        return len(self._rows)

    def itertuples(self, index: bool = False, name: Any = None) -> Any:
        return (tuple(row[path] for path in self.columns) for row in self._rows)


def frame_of(table: Any) -> Any:
    """Returns a table with a row per variant that is in memory: a pandas.DataFrame or similar, or a list of dictionaries; None for
    a file.

    Raises
    ------
    InputError
        If it is none of these.
    """
    if isinstance(table, (str, os.PathLike)):
        return None
    if hasattr(table, "columns") and hasattr(table, "itertuples"):
        return table
    if isinstance(table, (list, tuple)):
        return _Rows(table)
    raise InputError("table: expected a CSV file, values by path, a list of dictionaries, a pandas.DataFrame or samples of "
                     f"buckens.study, found {table!r}")


def ranges_of(table: Mapping[str, Sequence[Any]]) -> List[str]:
    """Converts values by path to arguments of `--vary`."""
    return [f"{path}={_flow(_values_of(values, path), path)}" for path, values in table.items()]


def _values_of(values: Any, path: str) -> List[Any]:
    """Returns the values of one quantity. A text is one value, not a list of its letters."""
    try:
        out = None if isinstance(values, (str, bytes, Mapping)) else list(values)
    except TypeError:
        out = None
    if out is None:
        raise InputError(f"{path}: expected a list of values, found {values!r}; write [{values!r}] for a single value, and draw "
                         "samples of a distribution with buckens.study, for example latin_hypercube")
    if not out:
        raise InputError(f"{path}: the list of values is empty; give at least one value")
    return out


def write_frame(table: Any, file: PathLike) -> None:
    """Writes a DataFrame as a CSV table for the program; numbers keep all digits."""
    columns = [str(column) for column in table.columns]
    if not len(table):
        raise InputError("the table has no variants; give it a row per variant")
    with open(file, "w", encoding="utf-8", newline="") as out:
        writer = csv.writer(out)
        writer.writerow(columns)
        for row in table.itertuples(index=False, name=None):
            writer.writerow([value if isinstance(value, str) else _flow(value, column)
                             for column, value in zip(columns, row)])


def table_of(table: TableLike, folder: pathlib.Path) -> VariantTable:
    """Returns the variants of any kind of table.

    Parameters
    ----------
    folder
        Folder for the file that passes rows in memory to the library.

    Raises
    ------
    InputError
        If the table has no variants, repeated names and the like.
    """
    if isinstance(table, Mapping):
        if not table:
            raise InputError("the table has no variants; give it values by path, "
                             "{\"parameters.speed\": [100, 150]}")
        return VariantTable(*_core.combinations(ranges_of(table)))
    frame = frame_of(table)
    if frame is not None:
        file = folder / "table.csv"
        write_frame(frame, file)
        return VariantTable(*_core.read_table(str(file)))
    return VariantTable(*_core.read_table(os.fspath(cast(PathLike, table))))
