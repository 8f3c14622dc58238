# SPDX-License-Identifier: Apache-2.0
"""The program's commands as functions, with its options and the output of `--json`.

docs/reference/command-line.md describes the dictionaries. A model is a :class:`buckens.Model`, a
dictionary with the keys of a model file, or the path of one.
"""

from __future__ import annotations

import os
import tempfile
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union, cast

from .errors import InputError
from .live_page import LivePage
from .live_records import flush_records
from .model import ModelLike, Overrides, PathLike
from .program import call, changes_of, file_of, options_of
from .study_progress import ProgressLike
from .study_runs import sweep_on
from .study_tables import TableLike, frame_of, ranges_of, write_frame
from .study_workers import ExecutorLike

Quantity = Union[str, float]


def check(model: ModelLike, set: Overrides = None, *, view: bool = False,  # noqa: A002
          page: Optional[PathLike] = None, open: bool = False) -> Dict[str, Any]:  # noqa: A002
    """Analyses a model without running it: masses, frequencies, joints, degrees of freedom.

    Parameters
    ----------
    model
        A :class:`buckens.Model`, a dictionary with the keys of a model file, or the path of one.
    set
        Values to replace, as for :func:`buckens.load`.
    view
        Also writes a page of the assembled model to the current directory: ``crank.html`` for ``crank.yaml``,
        ``model.html`` for a :class:`buckens.Model`.
    page
        Writes the page to this file.
    open
        Also opens the page in the browser.
    """
    with file_of(model) as path:
        return call("check", [path, *options_of(view=view, out=page, open=open), *changes_of(set)])


def modes(model: ModelLike, body: Optional[str] = None, system: bool = False,
          count: Optional[int] = None, about: Optional[str] = None, method: Optional[str] = None,
          tolerance: Optional[float] = None, condition: bool = False,
          out: Optional[PathLike] = None, set: Overrides = None, *,  # noqa: A002
          threads: Optional[int] = None) -> Dict[str, Any]:
    """Computes undamped vibrations of free bodies or, with ``system``, of the assembled system.

    Parameters
    ----------
    model, set
        As for :func:`buckens.check`.
    body
        Analyses only this free body.
    system
        Analyses the assembled system instead of free bodies.
    count
        Number of modes, 10 by default.
    about
        With ``system``: the reference position, "initial" or "static".
    method, tolerance, condition
        For free vibrations: the method, the relative error of the mode shapes, and whether to estimate the
        condition number of the factorised matrix.
    out
        Directory for the mode shapes, for :func:`buckens.view`.
    threads
        Number of threads for large bodies, 1 by default. Results are bit-identical.

    Returns
    -------
    dict
        ``["analyses"][0]["modes"][0]["frequency"]`` is the lowest frequency [Hz].
    """
    with file_of(model) as path:
        return call("modes", [path, *options_of(body=body, system=system, count=count, about=about,
                                              method=method, tolerance=tolerance, condition=condition,
                                              threads=threads, out=out), *changes_of(set)])


def static(model: ModelLike, out: PathLike, set: Overrides = None) -> Dict[str, Any]:  # noqa: A002
    """Computes equilibria over a load factor.

    Parameters
    ----------
    model, set
        As for :func:`buckens.check`; the model needs a ``static`` section.
    out
        Directory for results, see :func:`buckens.open`.

    Returns
    -------
    dict
        The summary, as in summary.json of the directory.
    """
    with file_of(model) as path:
        return call("static", [path, *options_of(out=out), *changes_of(set)])


def sweep(model: ModelLike, table: TableLike, out: PathLike, together: Optional[int] = None,
          set: Overrides = None, executor: Optional[ExecutorLike] = None, progress: ProgressLike = False,  # noqa: A002
          workers: Optional[int] = None, *, shard: Optional[Tuple[int, int]] = None) -> Dict[str, Any]:
    """Runs variants of a model.

    Without an executor the program runs them on this machine, each in a directory under ``out``. With an executor
    its workers run them and keep only the rows of the table, no directories; see docs/tutorials/studies.md.

    Parameters
    ----------
    model, set
        As for :func:`buckens.check`.
    out
        Directory for the table and, without an executor, the runs.
    table
        A row per variant, as a CSV file, a pandas.DataFrame or a list of dictionaries
        (``[{"parameters.speed": 100, "gravity.1": 0}, ...]``), or values by path, all combinations of which are run:
        ``{"bodies.rod.beam.elements": [4, 8, 16]}``.
    together
        Number of variants that advance together.
    executor
        A number of processes, an executor of concurrent.futures or mpi4py.futures, a Dask Client, or a function
        that creates an executor, which is then replaced if it loses a process.
    progress
        With an executor: True prints lines on the standard error stream; a function is called with a
        :class:`buckens.study.Progress`.
    workers
        Number of workers, at least 1, if the executor does not report it.
    shard
        (i, n): runs only part i of n, counted from 1, as a task of a job array; :func:`buckens.merge_sweep` joins
        the parts. Not with an executor, which distributes the variants itself.

    Returns
    -------
    dict
        ``["table"]`` is the path of the CSV table, ``["variants"]`` a list with ``name``, ``status`` and, for
        failed variants, ``message``.

    Raises
    ------
    InputError, IoError
        If something affects all variants: an invalid table, a model that a worker cannot read, or workers of other
        versions. Repeating the call keeps finished variants.
    """
    part = None if shard is None else _shard(shard)
    if executor is not None:
        if part is not None:
            raise InputError(f"shard {part} and an executor: the executor distributes the variants itself; leave "
                             "out one of them")
        return sweep_on(executor, model, table, out, together, set, progress, workers)
    with tempfile.TemporaryDirectory(prefix="buckens-") as folder:
        if isinstance(table, Mapping):
            variants = [word for change in ranges_of(table) for word in ("--vary", change)]
        else:
            variants = [_table_file(table, folder)]
        with file_of(model) as path:
            return call("sweep", [path, *variants, *options_of(out=out, together=together, shard=part),
                                  *changes_of(set)])


def _table_file(table: TableLike, folder: str) -> str:
    """Returns the file of a table; writes rows in memory to one in the folder."""
    frame = frame_of(table)
    if frame is None:
        return os.fspath(cast(PathLike, table))
    file = os.path.join(folder, "table.csv")
    write_frame(frame, file)
    return file


def _shard(shard: Tuple[int, int]) -> str:
    """Returns I/N; the program checks the numbers."""
    if len(shard) != 2 or not all(isinstance(number, int) for number in shard):
        raise InputError(f"shard: expected two whole numbers, the part and how many there are, found {shard!r}; "
                         "(1, 4) is the first of four")
    return f"{shard[0]}/{shard[1]}"


def merge_sweep(out: PathLike) -> Dict[str, Any]:
    """Joins the shards of a sweep into ``out``/sweep.csv and sweep.h5.

    Parameters
    ----------
    out
        Directory of the sweep.

    Returns
    -------
    dict
        As for :func:`buckens.sweep`.

    Raises
    ------
    InputError
        If shards are missing, or belong to different models, tables, versions or numbers of shards.
    """
    return call("sweep", options_of(merge=out))


def sweep_status(out: PathLike) -> Dict[str, Any]:
    """Returns the progress of a sweep or its shards, from any process that can read the directory.

    For a sweep with an executor use :func:`buckens.study.status`.

    Parameters
    ----------
    out
        Directory of the sweep.

    Returns
    -------
    dict
        ``variants``, ``finished``, ``failed`` and ``running`` are counts, ``to_go`` is in seconds, ``shards`` is a list.
    """
    return call("sweep", options_of(status=out))


def compare(first: PathLike, second: PathLike, tolerance: Optional[float] = None,
            sensors: bool = False) -> Dict[str, Any]:
    """Compares two runs.

    Parameters
    ----------
    first, second
        Directories of the runs.
    tolerance
        Largest difference that is accepted, relative to the largest value of a quantity; None accepts any.
    sensors
        Compares sensors only.

    Returns
    -------
    dict
        ``["largest_relative_difference"]``, and the differences of each quantity.

    Raises
    ------
    DifferenceError
        If a relative difference is larger than ``tolerance``.
    """
    return call("compare", [os.fspath(first), os.fspath(second),
                            *options_of(tolerance=tolerance, sensors=sensors)])


def _mesh_options(length_unit: Optional[str], mass_unit: Optional[str], only: Sequence[str],
                  skip: Sequence[str], size: Optional[Quantity], order: Optional[int],
                  solid: Optional[str]) -> List[str]:
    return options_of(length_unit=length_unit, mass_unit=mass_unit, only=",".join(only) or None,
                    skip=",".join(skip) or None, size=size, order=order, solid=solid)


def mesh_info(file: PathLike, length_unit: Optional[str] = None, mass_unit: Optional[str] = None,
              only: Sequence[str] = (), skip: Sequence[str] = (), size: Optional[Quantity] = None,
              order: Optional[int] = None, solid: Optional[str] = None) -> Dict[str, Any]:
    """Returns the contents of a mesh file, in SI units.

    Parameters
    ----------
    file
        A mesh of Gmsh, Abaqus, CalculiX or Nastran, a universal file or a STEP file.
    length_unit, mass_unit
        Units of the file, such as "mm" and "t"; by default metres, and kilograms, or tonnes with millimetres.
    only, skip
        Sets, groups or properties to take alone; keywords, cards and element types of decks to leave out.
    size, order, solid
        Of STEP files: element size in metres or such as "3 mm", order 1 or 2 of the elements, and the solid to mesh.

    Returns
    -------
    dict
        Numbers of ``nodes`` and elements, ``volume`` [m³] and sets by name.
    """
    return call("mesh-info", [os.fspath(file), *_mesh_options(length_unit, mass_unit, only, skip,
                                                              size, order, solid)])


def convert(file: PathLike, out: PathLike, length_unit: Optional[str] = None,
            mass_unit: Optional[str] = None, only: Sequence[str] = (), skip: Sequence[str] = (),
            size: Optional[Quantity] = None, order: Optional[int] = None, solid: Optional[str] = None,
            msh_version: Optional[str] = None, binary: bool = False) -> Dict[str, Any]:
    """Converts a mesh to .msh with a model file, or to .vtu.

    Parameters
    ----------
    file, length_unit, mass_unit, only, skip, size, order, solid
        As for :func:`buckens.mesh_info`.
    out
        File to write, by its ending .msh or .vtu.
    msh_version
        "4.1" or "2.2".
    binary
        Writes a binary .msh.

    Returns
    -------
    dict
        As for :func:`buckens.mesh_info`.
    """
    return call("convert", [os.fspath(file), os.fspath(out),
                            *_mesh_options(length_unit, mass_unit, only, skip, size, order, solid),
                            *options_of(msh_version=msh_version, binary=binary)])


def view(run: PathLike, page: Optional[PathLike] = None, frames: Optional[int] = None,
         second: Optional[PathLike] = None, *, fields: Sequence[str] = (), max_size: Optional[int] = None,
         open: bool = False) -> Dict[str, Any]:  # noqa: A002
    """Writes a page that shows a run; ``["page"]`` is its path.

    For a page that follows a run in progress use :func:`buckens.view_live`.

    Parameters
    ----------
    run
        Directory of a run, or ``out`` of :func:`buckens.modes`.
    page
        File name, by default view.html in ``run``.
    frames
        Maximum number of frames, 2000 by default.
    second
        Directory of another run, shown side by side.
    fields
        Fields to include, such as "von_mises" or "stress"; by default all. Fields that were not recorded cause a warning.
    max_size
        Maximum size of the data [MiB], 64 by default; frames are skipped to keep to it.
    open
        Opens the page in the browser.
    """
    return call("view", [*_runs(run, second), *options_of(out=page, open=open), *_page(frames, fields, max_size)])


def view_live(run: PathLike, second: Optional[PathLike] = None, *, frames: Optional[int] = None,
              fields: Sequence[str] = (), max_size: Optional[int] = None, open: bool = False) -> LivePage:  # noqa: A002
    """Serves the page of a run on this machine and updates it during the run.

    Parameters
    ----------
    run, second, frames, fields, max_size
        As for :func:`buckens.view`.
    open
        Opens the page in the browser.

    Returns
    -------
    LivePage
        ``.address`` is the URL; ``.close()`` or the end of a ``with`` block stops serving.
    """
    page = LivePage([*_runs(run, second), *_page(frames, fields, max_size)])
    if open:
        page.open()
    return page


def _runs(run: PathLike, second: Optional[PathLike]) -> List[str]:
    runs = [run] if second is None else [run, second]
    for one in runs:
        flush_records(one)
    return [os.fspath(one) for one in runs]


def _page(frames: Optional[int], fields: Sequence[str], max_size: Optional[int]) -> List[str]:
    if isinstance(fields, str):
        raise InputError(f"fields: expected a list of names, found {fields!r}; give [{fields!r}]")
    return options_of(frames=frames, fields=",".join(fields) or None, max_size=max_size)
