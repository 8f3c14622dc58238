# SPDX-License-Identifier: Apache-2.0
"""Complete runs by the program, with error statements, saved factors and continuation."""

from __future__ import annotations

import os
from typing import Any, Dict, Optional

from .instant import Quantity, instant
from .model import Model, ModelLike, Overrides, PathLike, model_of
from .program import call, changes_of, file_of, options_of
from .run_files import keep_files


def run(model: ModelLike, out: PathLike, set: Overrides = None, *, error: bool = False,  # noqa: A002
        threads: Optional[int] = None, factors: Optional[PathLike] = None,
        save_state: Optional[PathLike] = None, save_state_at: Optional[float] = None,
        start_from: Optional[PathLike] = None) -> Dict[str, Any]:
    """Simulates a model from start to end in a separate process.

    To inspect or influence a run between steps, or to use Python functions, use :class:`buckens.Simulation`.

    Parameters
    ----------
    model
        A :class:`buckens.Model`, a dictionary with the keys of a model file, or the path of one.
    out
        Directory for results, see :func:`buckens.open`. An existing run in it is replaced.
    set
        Values to replace, as for :func:`buckens.load`.
    error
        Repeats the run with one refinement at a time and estimates the uncertainty of each sensor, in
        ``["errors"]["sensors"]``. This takes several times as long, and the run cannot be continued.
    threads
        Number of threads that advance bodies in parallel, 1 by default. Results are bit-identical.
    factors
        Folder in which large factors are stored, so that later runs can reuse them.
    save_state, save_state_at
        File for the final state, or the state after the step that reaches ``save_state_at`` [s].
    start_from
        File from ``save_state`` or :meth:`buckens.Simulation.save` to continue from, with bit-identical results.

    Returns
    -------
    dict
        The summary, as in summary.json of the run directory.

    Raises
    ------
    NumericalError
        If a step fails. Results so far are kept, and :func:`buckens.continue_run` can continue with another step size.
    KeyboardInterrupt
        After Ctrl-C, once the files are complete; :func:`buckens.continue_run` continues the run.
    """
    if not isinstance(model, (str, os.PathLike)):
        model = model_of(model)
    try:
        with file_of(model) as path:
            return call("run", [path, *options_of(out=out, error=error, threads=threads, factors=factors,
                                                  save_state=save_state, save_state_at=save_state_at,
                                                  start_from=start_from), *changes_of(set)])
    finally:
        if isinstance(model, Model) and model._files and os.path.isfile(os.path.join(out, "model.yaml")):
            keep_files(model, os.fspath(out))


def continue_run(out: PathLike, until: Optional[Quantity] = None, set: Overrides = None, *,  # noqa: A002
                 threads: Optional[int] = None, factors: Optional[PathLike] = None,
                 save_state: Optional[PathLike] = None, save_state_at: Optional[float] = None) -> Dict[str, Any]:
    """Continues a run from its last checkpoint.

    Results are bit-identical with those of an uninterrupted run. A run on which functions of Python act, or values set
    from Python, needs :meth:`buckens.Simulation.resume`.

    Parameters
    ----------
    out
        Directory of the run.
    until
        New end of the run, in seconds or such as "30 ms"; a finished run can be extended.
    set
        Changes to ``simulation.step`` and ``simulation.tolerance``, after a step that failed.
    threads, factors, save_state, save_state_at
        As for :func:`buckens.run`.

    Returns
    -------
    dict
        The summary of the complete run.

    Raises
    ------
    InputError
        If there is nothing to continue, or if the model, its files or the version differ, naming the difference.
    """
    end = None if until is None else instant("until", until)
    return call("run", options_of(**{"continue": out}, until=end, threads=threads, factors=factors,
                                  save_state=save_state, save_state_at=save_state_at) + changes_of(set))
