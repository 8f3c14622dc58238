# SPDX-License-Identifier: Apache-2.0
"""Whole runs by the program, with what only it offers: error statements, kept factors, continuation."""

from __future__ import annotations

import os
from typing import Any, Dict, Optional

from .model import Model, Overrides, PathLike
from .program import ModelLike, call, changes_of, file_of, options_of
from .simulation import keep_files


def run(model: ModelLike, out: PathLike, set: Overrides = None, *, error: bool = False,  # noqa: A002
        threads: Optional[int] = None, factors: Optional[PathLike] = None,
        save_state: Optional[PathLike] = None, save_state_at: Optional[float] = None,
        start_from: Optional[PathLike] = None) -> Dict[str, Any]:
    """Simulates a model from start to end in a process of its own.

    To look at a run or to act on it between steps, use :class:`buckens.Simulation`, which also calls functions.

    Parameters
    ----------
    out
        Directory for results, see :func:`buckens.open`. An earlier run in it is replaced.
    error
        Repeats the run with one thing improved at a time and states how far each sensor may be off, under
        ``["errors"]["sensors"]``; takes several times as long. Such a run cannot be continued.
    threads
        That advance bodies at the same time, 1 if not given. Results are the same to the last bit.
    factors
        Folder in which large factors are kept and looked for, so that later runs need not compute them.
    save_state, save_state_at
        A file for the state at the end, or at the end of the step that reaches ``save_state_at`` [s].
    start_from
        A file of ``save_state`` or :meth:`buckens.Simulation.save` from which to go on, bit for bit.

    Returns
    -------
    dict
        The summary, as summary.json of the run directory.

    Raises
    ------
    NumericalError
        If a step fails; the results up to it are kept, and :func:`buckens.continue_run` goes on with another step.
    KeyboardInterrupt
        After Ctrl-C, once the files are complete; :func:`buckens.continue_run` goes on.
    """
    try:
        with file_of(model) as path:
            return call("run", [path, *options_of(out=out, error=error, threads=threads, factors=factors,
                                                  save_state=save_state, save_state_at=save_state_at,
                                                  start_from=start_from), *changes_of(set)])
    finally:
        if isinstance(model, Model) and model._files and os.path.isfile(os.path.join(out, "model.yaml")):
            keep_files(model, os.fspath(out))


def continue_run(out: PathLike, until: Optional[float] = None, set: Overrides = None, *,  # noqa: A002
                 threads: Optional[int] = None, factors: Optional[PathLike] = None,
                 save_state: Optional[PathLike] = None, save_state_at: Optional[float] = None) -> Dict[str, Any]:
    """Goes on with the run of the program in a directory where its last checkpoint is.

    The results are those of a run that nobody interrupted, bit for bit. Checkpoints are written by :func:`buckens.run` and
    the program; a :class:`buckens.Simulation` goes on from what its ``save`` has written, by its ``resume``.

    Parameters
    ----------
    out
        The directory of the run.
    until
        Another end of the run [s], also of one that is finished.
    set
        ``simulation.step`` and ``simulation.tolerance`` may change, after a step that failed.
    threads, factors, save_state, save_state_at
        As of :func:`buckens.run`.

    Returns
    -------
    dict
        The summary of the whole run.

    Raises
    ------
    InputError
        If there is nothing to continue, or the model, its files or the version are others, saying what differs.
    """
    return call("run", options_of(**{"continue": out}, until=until, threads=threads, factors=factors,
                                  save_state=save_state, save_state_at=save_state_at) + changes_of(set))
