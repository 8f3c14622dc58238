# SPDX-License-Identifier: Apache-2.0
"""The program's verbs as functions, with its options and what `--json` prints.

The dictionaries are described in docs/reference/command-line.md. A model is a :class:`buckens.Model`
or the name of a model file.
"""

from __future__ import annotations

import os
import tempfile
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union

from .errors import InputError
from .live_page import LivePage
from .model import Overrides, PathLike
from .program import ModelLike, call, changes_of, file_of, options_of
from .study_progress import ProgressLike
from .study_runs import sweep_on
from .study_tables import TableLike, is_frame, ranges_of, write_frame
from .study_workers import ExecutorLike

Quantity = Union[str, float]


def check(model: ModelLike, set: Overrides = None, *, view: bool = False,  # noqa: A002
          page: Optional[PathLike] = None, open: bool = False) -> Dict[str, Any]:  # noqa: A002
    """What is known of a model without running it: masses, frequencies, joints, degrees of freedom.

    Parameters
    ----------
    view
        Also writes a page that shows the assembled model, in the current directory: ``crank.html`` for
        ``crank.yaml``, ``model.html`` for a :class:`buckens.Model`.
    page
        The same into this file.
    open
        The same, and opens it in the browser.
    """
    with file_of(model) as path:
        return call("check", [path, *options_of(view=view, out=page, open=open), *changes_of(set)])


def modes(model: ModelLike, body: Optional[str] = None, system: bool = False,
          count: Optional[int] = None, about: Optional[str] = None, method: Optional[str] = None,
          tolerance: Optional[float] = None, condition: bool = False,
          out: Optional[PathLike] = None, set: Overrides = None, *,  # noqa: A002
          threads: Optional[int] = None) -> Dict[str, Any]:
    """Undamped vibrations of free bodies, or with ``system`` of the joined ones.

    Parameters
    ----------
    body
        Only this one of the free bodies.
    count
        Modes wanted, 10 if not given.
    about
        With ``system``: the position, "initial" or "static".
    method, tolerance, condition
        Of free vibrations: how they are computed, the relative error of the shapes, and whether the
        condition number of the factored matrix is estimated.
    out
        Directory for the shapes, for :func:`buckens.view`.
    threads
        That share large bodies, 1 if not given. Results are the same to the last bit.

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
    """Equilibria over a load factor; results go to a run directory, see :func:`buckens.open`."""
    with file_of(model) as path:
        return call("static", [path, *options_of(out=out), *changes_of(set)])


def sweep(model: ModelLike, table: TableLike, out: PathLike, together: Optional[int] = None,
          set: Overrides = None, executor: Optional[ExecutorLike] = None, progress: ProgressLike = False,  # noqa: A002
          workers: Optional[int] = None, *, shard: Optional[Tuple[int, int]] = None) -> Dict[str, Any]:
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
    shard
        (i, n): only the i-th of n parts of the variants, counted from 1, as tasks of a job array run them;
        :func:`buckens.merge_sweep` joins the parts. Not with an executor, which shares them out itself.

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
    part = None if shard is None else _shard(shard)
    if executor is not None:
        if part is not None:
            raise InputError(f"shard {part} and an executor: the executor distributes the variants itself; leave "
                             "out one of them")
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
            return call("sweep", [path, *variants, *options_of(out=out, together=together, shard=part),
                                  *changes_of(set)])


def _shard(shard: Tuple[int, int]) -> str:
    """I/N; what the two may be says the program."""
    if len(shard) != 2 or not all(isinstance(number, int) for number in shard):
        raise InputError(f"shard: expected two whole numbers, the part and how many there are, found {shard!r}; "
                         "(1, 4) is the first of four")
    return f"{shard[0]}/{shard[1]}"


def merge_sweep(out: PathLike) -> Dict[str, Any]:
    """Joins the parts of a sweep that was run in shards into ``out``/sweep.csv and sweep.h5.

    Returns
    -------
    dict
        As :func:`buckens.sweep`.

    Raises
    ------
    InputError
        While shards are missing, or if parts belong to different models, tables, versions or numbers of shards.
    """
    return call("sweep", options_of(merge=out))


def sweep_status(out: PathLike) -> Dict[str, Any]:
    """How far a sweep of the program or its shards are, from any process that sees the directory.

    Of a sweep with an executor tells :func:`buckens.study.status`.

    Returns
    -------
    dict
        ``variants``, ``finished``, ``failed`` and ``running`` are counts, ``to_go`` is in s, ``shards`` a list.
    """
    return call("sweep", options_of(status=out))


def compare(first: PathLike, second: PathLike, tolerance: Optional[float] = None,
            sensors: bool = False) -> Dict[str, Any]:
    """How far two runs differ.

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
                            *options_of(msh_version=msh_version, binary=binary)])


def view(run: PathLike, page: Optional[PathLike] = None, frames: Optional[int] = None,
         second: Optional[PathLike] = None, *, fields: Sequence[str] = (), max_size: Optional[int] = None,
         open: bool = False) -> Dict[str, Any]:  # noqa: A002
    """Writes a page for the browser that shows a run; ``["page"]`` says where.

    A page that follows a run while it goes on: :func:`buckens.view_live`.

    Parameters
    ----------
    run
        Directory of a run, or of :func:`buckens.modes` with ``out``.
    page
        The file, view.html in ``run`` if not given.
    frames
        Most frames in the page, 2000 if not given.
    second
        Directory of another run, shown beside it.
    fields
        Only these: "von_mises", "stress"; without it all. Names that were not recorded give a warning.
    max_size
        Most numbers in the page [MiB], 64 if not given; fewer frames are taken to keep it.
    open
        Opens it in the browser.
    """
    return call("view", [*_runs(run, second), *options_of(out=page, open=open), *_page(frames, fields, max_size)])


def view_live(run: PathLike, second: Optional[PathLike] = None, *, frames: Optional[int] = None,
              fields: Sequence[str] = (), max_size: Optional[int] = None, open: bool = False) -> LivePage:  # noqa: A002
    """Serves the page of a run on this machine and renews it while the run goes on.

    Parameters
    ----------
    second, frames, fields, max_size
        As of :func:`buckens.view`.
    open
        Opens it in the browser.

    Returns
    -------
    LivePage
        ``.address`` is for the browser; ``.close()`` or the end of a ``with`` block ends it.
    """
    page = LivePage([*_runs(run, second), *_page(frames, fields, max_size)])
    if open:
        page.open()
    return page


def _runs(run: PathLike, second: Optional[PathLike]) -> List[str]:
    return [os.fspath(run)] + ([] if second is None else [os.fspath(second)])


def _page(frames: Optional[int], fields: Sequence[str], max_size: Optional[int]) -> List[str]:
    if isinstance(fields, str):
        raise InputError(f"fields: expected a list of names, found {fields!r}; give [{fields!r}]")
    return options_of(frames=frames, fields=",".join(fields) or None, max_size=max_size)
