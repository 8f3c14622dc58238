# SPDX-License-Identifier: Apache-2.0
"""Simulations: advanced step by step, to an instant or to the end."""

from __future__ import annotations

import json
import os
import sys
import weakref
from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple, Union

import numpy as np

from . import _core
from .curve import Curve
from .errors import InputError
from .messages import tell_messages
from .model import ForceFunction, Model, PathLike
from .present import Array, Bodies, Signals, Values
from .signal_function import SignalFunction, given_signal

Progress = Union[bool, Callable[[float, float, int], object]]


class Simulation:
    """A simulation of a model, set up at once: assembly, one factor per flexible body, a consistent
    start.

    Parameters
    ----------
    model
        What to simulate; it needs a ``simulation``.
    out
        Directory for results (see :func:`buckens.open`); None: no files are written.
    threads
        That advance bodies at the same time. Results do not depend on it.
    record
        Whether sensors are kept in memory at the instants of records, see :attr:`curves`.

    Examples
    --------
    >>> sim = Simulation(load("slider_crank.yaml"))                   # doctest: +SKIP
    >>> while sim.step():                                             # doctest: +SKIP
    ...     print(sim.time, sim.sensors["mid"])
    """

    def __init__(self, model: Model, out: Optional[PathLike] = None, threads: int = 1,
                 record: bool = True, *, _start_from: str = "") -> None:
        if not isinstance(model, Model):
            raise InputError(f"expected a buckens.Model, found {model!r}; buckens.load reads one")
        self._model = model
        self._forces: List[Tuple[str, str, ForceFunction]] = list(model._forces)
        self._signals = list(model._signals)
        self._callbacks: List[Callable[[], object]] = []
        if not isinstance(threads, int) or not 1 <= threads <= 256:
            raise InputError(f"threads: expected a whole number from 1 to 256, found {threads!r}")
        self._options = ("" if out is None else os.fspath(out), threads, record, _start_from)
        self._was_seen = False
        self._bodies: Optional[Bodies] = None
        self._is_over = False
        self._prepare()

    @classmethod
    def resume(cls, path: PathLike, model: Model, out: Optional[PathLike] = None, threads: int = 1,
               record: bool = True, *, until: Optional[float] = None) -> Simulation:
        """Continues bit for bit from a state that :meth:`save` wrote.

        Parameters
        ----------
        path
            The file.
        model, out, threads, record
            As of :class:`Simulation`; the model may have another title and duration than the one that was saved.
        until
            Another end of the run [s]: the ``duration`` of the model for this simulation.

        Raises
        ------
        InputError
            If the model is another one, saying what differs.
        IoError
            If the file cannot be read or is damaged.
        """
        if until is not None:
            model = model.with_changes({"simulation.duration": _number("until", until)})
        return cls(model, out, threads, record, _start_from=os.fspath(path))

    def _prepare(self) -> None:
        out, threads, record, start_from = self._options
        self._core_now: Optional[_core.Simulation] = None
        self._is_preparing = True
        try:
            self._core_now = _core.Simulation(self._model._core, self._forces, self._signals, threads,
                                              out, record, start_from)
        finally:
            self._is_preparing = False
        for callback in self._callbacks:
            self._core_now.on_step(callback)
        if out and self._model._files:
            keep_files(self._model, out)
        tell_messages()

    @property
    def _core(self) -> _core.Simulation:
        """The simulation of the library; set up again if forces or signals were added."""
        if self._core_now is None:
            if self._is_preparing:
                raise InputError("the simulation is being set up, which is within a step; a force "
                                 "function can use its arguments only")
            self._prepare()
            assert self._core_now is not None
        return self._core_now

    # ---- advance
    def step(self) -> bool:
        """Takes one step. Returns False if the end was already reached, then raises.

        Raises
        ------
        NumericalError
            If the step fails, naming the joint or body that resists; the state is as before.
        """
        if self._is_over:
            raise InputError(f"the run ended at t = {self.time:.6g} s; raise `duration`, or begin "
                             "another Simulation")
        self._is_over = not self._core.step()
        return not self._is_over

    def advance(self, t: float) -> bool:
        """Takes steps until one ends at or beyond t [s]; returns False if the end came first."""
        return self._core.advance(_number("the time to advance to", t))

    def run(self, progress: Progress = False) -> Dict[str, Any]:
        """Takes steps until the end and completes the results. Ctrl-C ends it after a step.

        Parameters
        ----------
        progress
            True shows a line on the standard error stream; a function is called with time, end and
            number of steps, ten times a second.

        Returns
        -------
        dict
            The summary, as summary.json of a run directory.
        """
        show: Optional[Callable[[float, float, int], object]] = None
        if callable(progress):
            show = progress
        elif progress:
            show = _show_progress
        try:
            text = self._core.run(show)
        finally:
            tell_messages()
            if show is _show_progress:
                print(file=sys.stderr)
        self._is_over = True
        return dict(json.loads(text))

    def finish(self) -> Dict[str, Any]:
        """Ends the run here, completes the results and returns the summary."""
        text = self._core.finish()
        tell_messages()
        return dict(json.loads(text))

    def stop(self) -> None:
        """Ends the run after the present step; for functions given to :meth:`on_step`."""
        self._core.stop()

    def on_step(self, function: Callable[[Simulation], object]) -> Callable[[Simulation], object]:
        """Decorator: calls the function with the simulation after each step.

        What it raises ends the run after this step and comes out of the call that advances.
        """
        if not callable(function):
            raise InputError(f"on_step: expected a function, found {function!r}")
        myself = weakref.ref(self)

        def call() -> None:
            sim = myself()
            if sim is not None:
                function(sim)

        self._callbacks.append(call)
        if self._core_now is not None:
            self._core_now.on_step(call)
        return function

    # ---- act
    def force(self, marker: str, name: Optional[str] = None) -> Callable[[ForceFunction], ForceFunction]:
        """Decorator: a force on a marker by a function, as :meth:`buckens.Model.force`, of this
        simulation only.

        Must be added before anything else is requested from the simulation, which is then set up again; for
        large models :meth:`buckens.Model.force` saves the time.
        """

        def add(function: ForceFunction) -> ForceFunction:
            self._require_new(f"the force on {marker!r}")
            load = name or str(getattr(function, "__name__", "force"))
            self._forces.append((load, marker, function))
            self._core_now = None
            return function

        return add

    def signal(self, name: Optional[str] = None,
               inputs: Optional[Sequence[str]] = None) -> Callable[[SignalFunction], SignalFunction]:
        """Decorator: the value of a signal by a function, as :meth:`buckens.Model.signal`, of this
        simulation only.

        Must be added before anything else is requested from the simulation, as :meth:`force`.
        """

        def add(function: SignalFunction) -> SignalFunction:
            given = given_signal(function, name, inputs)
            self._require_new(f"the function of signal {given[0]!r}")
            self._signals.append(given)
            self._core_now = None
            return function

        return add

    def _require_new(self, what: str) -> None:
        if self._was_seen or self._core.num_steps > 0:
            raise InputError(f"{what} comes too late: arrays of this simulation are in use or steps were "
                             "taken; add functions first, or to the model")

    def set_signal(self, signal: str, value: float) -> None:
        """Sets a signal with a ``setting`` to a value from now on, which motors and loads that name it
        follow. The value is part of what :meth:`save` writes.

        Parameters
        ----------
        value
            In SI units of what follows it.
        """
        self._core.set_signal(signal, _number(f"signal {signal!r}", value))

    def set_load(self, load: str, value: Sequence[float]) -> None:
        """Replaces the law of a force [N] or torque [N m] of the model with a value from now on.

        Parameters
        ----------
        value : (3,)
            In the axes of the load.
        """
        given = np.asarray(value, dtype=object)
        try:
            numbers = given.astype(np.float64)
        except (TypeError, ValueError):
            numbers = np.empty(0)
        if numbers.shape != (3,):
            raise InputError(f"load {load!r}: expected three numbers, found {value!r}")
        self._core.set_load(load, numbers)

    def release_load(self, load: str) -> None:
        """Returns a load to its law."""
        self._core.release_load(load)

    def save(self, path: PathLike) -> None:
        """Writes everything that :meth:`resume` needs to continue bit for bit."""
        self._core.save(os.fspath(path))

    # ---- look
    @property
    def model(self) -> Model:
        """What is simulated."""
        return self._model

    @property
    def directory(self) -> Optional[str]:
        """Where results go, or None."""
        return self._options[0] or None

    @property
    def time(self) -> float:
        """Present instant [s]."""
        return self._core.time

    @property
    def end_time(self) -> float:
        """End of the run [s]."""
        return self._core.end_time

    @property
    def num_steps(self) -> int:
        """Steps taken since t = 0."""
        return self._core.num_steps

    @property
    def is_done(self) -> bool:
        """Whether the end is reached."""
        return self._core.is_done

    @property
    def bodies(self) -> Bodies:
        """Bodies by name."""
        core = self._core
        self._was_seen = True
        # Made once: of thousands of bodies each is asked for by itself.
        if self._bodies is None or not self._bodies.belong_to(core):
            self._bodies = Bodies(core, self._model.bodies)
        return self._bodies

    @property
    def sensors(self) -> Values:
        """Present values of the sensors by name: numbers, or arrays of components."""
        return Values(self._core, "sensors/")

    @property
    def signals(self) -> Signals:
        """Present values of the signals by name."""
        return Signals(self._core)

    @property
    def energies(self) -> Values:
        """Present energies by name [J]."""
        return Values(self._core, "energies/")

    @property
    def multipliers(self) -> Array:
        """Forces [N] and torques [N m] of the joint equations; follows the simulation, read-only."""
        core = self._core
        self._was_seen = True
        return core.multipliers()

    def value(self, path: str) -> Any:
        """Present value of anything that is recorded, "joints/hinge/force"; a copy."""
        return Values(self._core, "")[path]

    @property
    def quantities(self) -> Dict[str, str]:
        """Paths that :meth:`value` knows, with their units."""
        return {path: unit for path, unit, _ in self._core.quantities()}

    @property
    def curves(self) -> Dict[str, Curve]:
        """Sensors at the instants of records so far, "tip.x"; the instants are "t"."""
        return {name: Curve(values, name=name, unit=unit)
                for name, unit, values in self._core.curves()}

    def __repr__(self) -> str:
        return (f"<buckens.Simulation {self._model.title!r}: t = {self.time:.6g} of "
                f"{self.end_time:.6g} s, {self.num_steps} steps>")


def keep_files(model: Model, out: str) -> None:
    """Meshes and matrices given as arrays go into the run directory, whose model.yaml names them."""
    path = os.path.join(out, "model.yaml")
    with open(path, encoding="utf-8") as file:
        text = file.read()
    with open(path, "w", encoding="utf-8") as file:
        file.write(model._files.write_beside(out, text, is_absolute=True))


def _number(what: str, value: float) -> float:
    """A finite number, or an error that says what it was meant for."""
    if isinstance(value, (str, bytes)):
        raise InputError(f"{what}: expected a number, found {value!r}")
    try:
        return float(value)
    except (TypeError, ValueError):
        raise InputError(f"{what}: expected a number, found {value!r}") from None


def _show_progress(t: float, end: float, steps: int) -> None:
    share = t / end if end > 0 else 1.0
    print(f"\r{share:6.1%}  t = {t:.6g} s  {steps} steps", end="", file=sys.stderr, flush=True)
