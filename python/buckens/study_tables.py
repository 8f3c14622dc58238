# SPDX-License-Identifier: Apache-2.0
"""Converts files, ranges and pandas.DataFrames to tables of variants for the library."""

from __future__ import annotations

import csv
import os
import pathlib
from typing import Any, List, Mapping, NamedTuple, Sequence, Tuple, Union

from . import _core
from .errors import InputError
from .model import PathLike
from .yaml_text import _flow

#: A CSV file, values by path (all combinations are run), or a pandas.DataFrame with a row per variant.
TableLike = Union[PathLike, Mapping[str, Sequence[Any]], Any]


class VariantTable(NamedTuple):
    """Paths of quantities in the model, and variants with name and values as text."""

    paths: List[str]
    variants: List[Tuple[str, List[str]]]


def is_frame(table: Any) -> bool:
    """Whether a table is a pandas.DataFrame or similar."""
    return hasattr(table, "columns") and hasattr(table, "itertuples")


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
        Folder for the file that passes a DataFrame to the library.

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
    if is_frame(table):
        file = folder / "table.csv"
        write_frame(table, file)
        return VariantTable(*_core.read_table(str(file)))
    return VariantTable(*_core.read_table(os.fspath(table)))
