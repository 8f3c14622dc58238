# SPDX-License-Identifier: Apache-2.0
"""The program's verbs as functions, with its options and what `--json` prints.

The dictionaries are described in docs/reference/command-line.md. A model is a :class:`buckens.Model`
or the name of a model file.
"""

from __future__ import annotations

import os
import tempfile
from typing import Any, Dict, List, Mapping, Optional, Sequence, Union

from .model import Overrides, PathLike, overrides_of
from .program import ModelLike, call, file_of
from .study_progress import ProgressLike
from .study_runs import sweep_on
from .study_tables import TableLike, is_frame, ranges_of, write_frame
from .study_workers import ExecutorLike

Quantity = Union[str, float]


def _changes(set: Overrides) -> List[str]:  # noqa: A002
    return [word for change in overrides_of(set) for word in ("--set", change)]


def _options(**options: Any) -> List[str]:
    """Options of the program: underscores become hyphens, None and False are left out."""
    out: List[str] = []
    for key, value in options.items():
        if value is None or value is False:
            continue
        out.append("--" + key.replace("_", "-"))
        if value is not True:
            out.append(os.fspath(value) if isinstance(value, os.PathLike) else str(value))
    return out


def check(model: ModelLike, set: Overrides = None) -> Dict[str, Any]:  # noqa: A002
    """What is known of a model without running it: masses, frequencies, joints, degrees of freedom."""
    with file_of(model) as path:
        return call("check", [path, *_changes(set)])


def modes(model: ModelLike, body: Optional[str] = None, system: bool = False,
          count: Optional[int] = None, about: Optional[str] = None, method: Optional[str] = None,
          tolerance: Optional[float] = None, condition: bool = False,
          out: Optional[PathLike] = None, set: Overrides = None) -> Dict[str, Any]:  # noqa: A002
    """Undamped vibrations of free bodies, or with ``system`` of the joined ones.

    Returns
    -------
    dict
        ``["analyses"][0]["modes"][0]["frequency"]`` is the lowest frequency [Hz].
    """
    with file_of(model) as path:
        return call("modes", [path, *_options(body=body, system=system, count=count, about=about,
                                              method=method, tolerance=tolerance,
                                              condition=condition, out=out), *_changes(set)])


def static(model: ModelLike, out: PathLike, set: Overrides = None) -> Dict[str, Any]:  # noqa: A002
    """Equilibria over a load factor; results go to a run directory, see :func:`buckens.open`."""
    with file_of(model) as path:
        return call("static", [path, *_options(out=out), *_changes(set)])


def sweep(model: ModelLike, table: TableLike, out: PathLike, together: Optional[int] = None,
          set: Overrides = None, executor: Optional[ExecutorLike] = None, progress: ProgressLike = False,  # noqa: A002
          workers: Optional[int] = None) -> Dict[str, Any]:
    """Runs variants of a model.

    Without an executor the program runs them here, each into a directory below ``out``. With one they are
    handed to its workers, which keep no directories, only the rows of the table; see docs/tutorials/studies.md.

    Parameters
    ----------
    table
        A CSV file with a row per variant, a pandas.DataFrame, or values by path, of which all combinations
        are run: ``{"bodies.rod.beam.elements": [4, 8, 16]}``.
    together
        Variants that advance side by side.
    executor
        Who runs them: a number of processes, an executor of concurrent.futures or mpi4py.futures, a Client
        of Dask, or a function that makes an executor, which is then replaced if it loses a process.
    progress
        True: lines on the standard error stream; a function: called with a :class:`buckens.study.Progress`.
    workers
        How many there are, where the executor does not tell.

    Returns
    -------
    dict
        ``["table"]`` is the table in CSV, ``["variants"]`` a list with ``name``, ``status`` and, of those that
        failed, ``message``.

    Raises
    ------
    InputError, IoError
        For what concerns all variants: a bad table, a model that a worker cannot see, workers of other
        versions. The same call later keeps what is finished.
    """
    if executor is not None:
        return sweep_on(executor, model, table, out, together, set, progress, workers)
    with tempfile.TemporaryDirectory(prefix="buckens-") as folder:
        if isinstance(table, Mapping):
            variants = [word for change in ranges_of(table) for word in ("--vary", change)]
        elif is_frame(table):
            variants = [os.path.join(folder, "table.csv")]
            write_frame(table, variants[0])
        else:
            variants = [os.fspath(table)]
        with file_of(model) as path:
            return call("sweep", [path, *variants, *_options(out=out, together=together),
                                  *_changes(set)])


def compare(first: PathLike, second: PathLike, tolerance: Optional[float] = None,
            sensors: bool = False) -> Dict[str, Any]:
    """How far two runs differ.

    Raises
    ------
    DifferenceError
        If a relative difference is larger than ``tolerance``.
    """
    return call("compare", [os.fspath(first), os.fspath(second),
                            *_options(tolerance=tolerance, sensors=sensors)])


def _mesh_options(length_unit: Optional[str], mass_unit: Optional[str], only: Sequence[str],
                  skip: Sequence[str], size: Optional[Quantity], order: Optional[int],
                  solid: Optional[str]) -> List[str]:
    return _options(length_unit=length_unit, mass_unit=mass_unit, only=",".join(only) or None,
                    skip=",".join(skip) or None, size=size, order=order, solid=solid)


def mesh_info(file: PathLike, length_unit: Optional[str] = None, mass_unit: Optional[str] = None,
              only: Sequence[str] = (), skip: Sequence[str] = (), size: Optional[Quantity] = None,
              order: Optional[int] = None, solid: Optional[str] = None) -> Dict[str, Any]:
    """What a mesh file contains, in SI units."""
    return call("mesh-info", [os.fspath(file), *_mesh_options(length_unit, mass_unit, only, skip,
                                                              size, order, solid)])


def convert(file: PathLike, out: PathLike, length_unit: Optional[str] = None,
            mass_unit: Optional[str] = None, only: Sequence[str] = (), skip: Sequence[str] = (),
            size: Optional[Quantity] = None, order: Optional[int] = None, solid: Optional[str] = None,
            msh_version: Optional[str] = None, binary: bool = False) -> Dict[str, Any]:
    """Writes a mesh as .msh with a model file, or as .vtu."""
    return call("convert", [os.fspath(file), os.fspath(out),
                            *_mesh_options(length_unit, mass_unit, only, skip, size, order, solid),
                            *_options(msh_version=msh_version, binary=binary)])


def view(run: PathLike, page: Optional[PathLike] = None, frames: Optional[int] = None) -> Dict[str, Any]:
    """Writes a page for the browser that shows a run; ``["page"]`` says where."""
    arguments = [os.fspath(run)] + ([] if page is None else ["-o", os.fspath(page)])
    return call("view", arguments + _options(frames=frames))
