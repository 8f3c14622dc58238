# SPDX-License-Identifier: Apache-2.0
"""Records of simulations of this process, which reach their files with a delay, up to date for readers."""

from __future__ import annotations

import atexit
import contextlib
import os
import weakref

from . import _core
from .errors import IoError
from .model import PathLike

_writing: "weakref.WeakValueDictionary[str, _core.Simulation]" = weakref.WeakValueDictionary()


def flush_before_reading(directory: PathLike, simulation: _core.Simulation) -> None:
    """Notes which simulation writes into a directory, as long as it lives."""
    _writing[os.path.realpath(directory)] = simulation


@atexit.register
def leave_simulations() -> None:
    """Completes the files of runs that were not finished.

    At the end of Python, functions given to a simulation may keep it alive: those of a module refer to all its variables.
    """
    for simulation in list(_writing.values()):
        simulation.leave()


def flush_records(directory: PathLike) -> None:
    """Brings the records so far into a run directory, if a simulation of this process writes into it."""
    simulation = _writing.get(os.path.realpath(directory))
    if simulation is not None:
        # What cannot be written is reported by the call that advances the simulation.
        with contextlib.suppress(IoError):
            simulation.flush()
