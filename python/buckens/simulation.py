# SPDX-License-Identifier: Apache-2.0
"""Simulations that are advanced step by step, to an instant or to the end."""

from __future__ import annotations

import json
import os
import sys
import weakref
from typing import Any, Callable, Dict, List, Optional, Sequence, Union

import numpy as np

from . import _core
from .curve import Curve
from .errors import Error, InputError
from .messages import tell_messages
from .instant import Quantity, instant
from .live_records import flush_before_reading
from .model import Model, ModelLike, PathLike, model_of
from .present import Array, Bodies, Signals, Values
from .run_files import checkpoint_of, keep_files, kept_text
from .signal_function import ForceFunction, SignalFunction, given_force, given_signal, require_function, require_new_force, require_text

Progress = Union[bool, Callable[[float, float, int], object]]


class Simulation:
    """A simulation of a model.

    Creating it assembles the mechanism, factorises one matrix per flexible body and computes consistent
    initial values.

    Parameters
    ----------
    model
        A :class:`buckens.Model`, a dictionary with the keys of a model file, or the path of one; it needs a
        ``simulation`` section.
    out
        Directory for results (see :func:`buckens.open`); None writes no files.
    threads
        Number of threads that advance bodies in parallel. Results do not depend on it.
    record
        Whether sensor records are kept in memory, see :attr:`curves`.

    Examples
    --------
    >>> sim = Simulation("slider_crank.yaml")                         # doctest: +SKIP
    >>> while sim.step():                                             # doctest: +SKIP
    ...     print(sim.time, sim.sensors["mid"])
    """

    def __init__(self, model: ModelLike, out: Optional[PathLike] = None, threads: int = 1,
                 record: bool = True, *, _start_from: str = "", _continues: bool = False) -> None:
        model = model_of(model)
        self._model = model
        self._forces = list(model._forces)
        self._signals = list(model._signals)
        self._num_sound = (len(self._forces), len(self._signals))  # with which it was set up
        self._callbacks: List[Callable[[], object]] = []
        if not isinstance(threads, int) or not 1 <= threads <= 256:
            raise InputError(f"threads: expected a whole number from 1 to 256, found {threads!r}")
        self._options = ("" if out is None else os.fspath(out), threads, record, _start_from, _continues)
        self._was_seen = False
        self._bodies: Optional[Bodies] = None
        self._is_over = False
        self._prepare()

    @classmethod
    def resume(cls, path: PathLike, model: Optional[ModelLike] = None, out: Optional[PathLike] = None,
               threads: int = 1, record: bool = True, *, until: Optional[Quantity] = None) -> Simulation:
        """Continues from a state saved by :meth:`save`, or a run from its last checkpoint, with bit-identical results.

        Parameters
        ----------
        path
            File with the state, or directory of a run that ended early, whose results go on.
        model
            The model may differ from the saved one in title and duration, that of a run also in ``step`` and
            ``tolerance``. By default the one in the directory of the run.
        out, threads, record
            As for :class:`Simulation`. With ``out`` the results of a run go on in that directory instead, without
            those before the checkpoint.
        until
            New end of the run, in seconds or such as "30 ms", which replaces the ``duration`` of the model.

        Raises
        ------
        InputError
            If the model differs from the saved one, naming the difference.
        IoError
            If the file cannot be read or is damaged, or the run has left no checkpoint.

        Notes
        -----
        Forces and signals by functions are given to the model, functions for :meth:`on_step` to the simulation that is
        returned, as before.
        """
        place = os.fspath(path)
        is_run = os.path.isdir(place)
        if is_run:
            start_from = checkpoint_of(place)
            model = os.path.join(place, "model.yaml") if model is None else model
        elif model is None:
            raise InputError(f"resume: {place} holds a state only; give the model with which it was saved")
        else:
            start_from = place
        if until is not None:
            model, end = model_of(model), instant("until", until)
            model = model.with_changes(_core.changes_until(start_from, model._core, end) if is_run else
                                       {"simulation.duration": end})
        continues = is_run and out is None
        return cls(model, place if continues else out, threads, record, _start_from=start_from, _continues=continues)

    def _prepare(self) -> None:
        out, threads, record, start_from, continues = self._options
        self._core_now: Optional[_core.Simulation] = None
        self._is_preparing = True
        try:
            text = kept_text(self._model, out) if continues else ""
            self._core_now = _core.Simulation(self._model._core, self._forces, self._signals, threads,
                                              out, record, start_from, continues, text)
        finally:
            self._is_preparing = False
        for callback in self._callbacks:
            self._core_now.on_step(callback)
        if out:
            flush_before_reading(out, self._core_now)
        if out and not continues and self._model._files:
            keep_files(self._model, out)
        tell_messages()

    @property
    def _core(self) -> _core.Simulation:
        """The library's simulation, set up again if forces or signals were added."""
        if self._core_now is None:
            if self._is_preparing:
                raise InputError("the simulation is being set up, which is within a step; a force "
                                 "function can use its arguments only")
            try:
                self._prepare()
            except Exception as error:
                dropped = self._drop_added()
                if isinstance(error, Error):
                    error.args = (f"{error}; dropped from the simulation: {dropped}",)
                raise
            assert self._core_now is not None
            self._num_sound = (len(self._forces), len(self._signals))
        return self._core_now

    def _drop_added(self) -> str:
        """Removes the functions with which the simulation could not be set up, and names them."""
        forces, signals = self._num_sound
        names = [f"force {load!r} on {marker!r}" for load, marker, _ in self._forces[forces:]]
        names += [f"function of signal {signal!r}" for signal, _, _ in self._signals[signals:]]
        del self._forces[forces:], self._signals[signals:]
        return ", ".join(names)

    # ---- advance
    def step(self) -> bool:
        """Takes one step. Returns False if the end was already reached; further calls raise an error.

        Raises
        ------
        NumericalError
            If the step fails, naming the joint or body at fault; the state is unchanged.
        """
        if self._is_over:
            raise InputError(f"the run ended at t = {self.time:.6g} s; raise `duration`, or begin "
                             "another Simulation")
        self._is_over = not self._core.step()
        return not self._is_over

    def advance(self, t: float) -> bool:
        """Takes steps until one ends at or after an instant; returns False if the run ended first.

        Parameters
        ----------
        t
            Time [s]. Steps keep their length, so that the last one may end after it.
        """
        return self._core.advance(_number("the time to advance to", t))

    def run(self, progress: Progress = False) -> Dict[str, Any]:
        """Runs to the end and completes the results. Ctrl-C stops the run after the current step.

        Parameters
        ----------
        progress
            True shows a line on the standard error stream. A function is called with time, end time and
            number of steps, at most ten times a second.

        Returns
        -------
        dict
            The summary, as in summary.json of a run directory.

        Raises
        ------
        InputError
            If the run was ended before: by :meth:`finish`, :meth:`stop` or an exception. A run that has reached its
            end returns its summary again.
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
        """Ends the run now, completes the results and returns the summary."""
        text = self._core.finish()
        tell_messages()
        return dict(json.loads(text))

    def stop(self) -> None:
        """Ends the run after the current step; for use in functions passed to :meth:`on_step`."""
        self._core.stop()

    def on_step(self, function: Callable[[Simulation], object]) -> Callable[[Simulation], object]:
        """Decorator: calls the function with the simulation after each step.

        An exception in the function ends the run after this step, and the call that advances the
        simulation raises it.

        Parameters
        ----------
        function
            Called as ``function(sim)``. What it sets acts from the next step on.
        """
        require_function("on_step", function)
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
        """Decorator: as :meth:`buckens.Model.force`, for this simulation only.

        Use it before the simulation takes a step or hands out arrays. It sets the simulation up again;
        for large models :meth:`buckens.Model.force` avoids that.

        Parameters
        ----------
        marker, name
            As for :meth:`buckens.Model.force`.
        """

        require_text("force", marker, 'sim.force("rod/end")')
        if name is not None:
            require_text("force: name", name, f'sim.force({marker!r}, name="push")')

        def add(function: ForceFunction) -> ForceFunction:
            given = given_force(function, marker, name)
            require_new_force(given, self._forces, self._model.loads)
            self._require_new(f"the force on {marker!r}")
            self._forces.append(given)
            self._core_now = None
            return function

        return add

    def signal(self, name: Optional[str] = None,
               inputs: Optional[Sequence[str]] = None) -> Callable[[SignalFunction], SignalFunction]:
        """Decorator: as :meth:`buckens.Model.signal`, for this simulation only.

        Use it before the simulation takes a step or hands out arrays, as :meth:`force`.

        Parameters
        ----------
        name, inputs
            As for :meth:`buckens.Model.signal`.
        """

        if name is not None:
            require_text("signal", name, "sim.signal()")

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
        """Sets a signal with a ``setting`` from now on; motors and loads that name it follow it.

        :meth:`save` saves the value, too.

        Parameters
        ----------
        signal
            Name of a signal with a ``setting``.
        value
            In SI units of the quantity that follows it.
        """
        self._core.set_signal(signal, _number(f"signal {signal!r}", value))

    def set_load(self, load: str, value: Sequence[float]) -> None:
        """Sets a force or torque of the model, in place of its law, from now on.

        Parameters
        ----------
        load
            Name of a ``force`` or ``torque`` of the model.
        value : (3,)
            Components in the axes of the load [N] or [N m].
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
        """Returns a load to its law.

        Parameters
        ----------
        load
            Name of a load that :meth:`set_load` has set.
        """
        self._core.release_load(load)

    def save(self, path: PathLike) -> None:
        """Saves the state, from which :meth:`resume` continues with bit-identical results.

        Parameters
        ----------
        path
            Such as "half.h5"; an existing file is replaced once the new one is complete.
        """
        self._core.save(os.fspath(path))

    def __enter__(self) -> Simulation:
        return self

    def __exit__(self, *error: object) -> None:
        """Completes the results, whatever has ended the block."""
        self.finish()

    # ---- look
    @property
    def model(self) -> Model:
        """The simulated model."""
        return self._model

    @property
    def directory(self) -> Optional[str]:
        """Directory for results, or None."""
        return self._options[0] or None

    @property
    def time(self) -> float:
        """Current time [s]."""
        return self._core.time

    @property
    def end_time(self) -> float:
        """End of the run [s]."""
        return self._core.end_time

    @property
    def num_steps(self) -> int:
        """Number of steps taken since t = 0."""
        return self._core.num_steps

    @property
    def is_done(self) -> bool:
        """Whether the run has reached its end."""
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
        """Current values of the sensors by name: numbers, or arrays of components."""
        return Values(self._core, "sensors/")

    @property
    def signals(self) -> Signals:
        """Current values of the signals by name."""
        return Signals(self._core)

    @property
    def energies(self) -> Values:
        """Current energies by name [J]."""
        return Values(self._core, "energies/")

    @property
    def multipliers(self) -> Array:
        """Forces [N] and torques [N m] of the joint equations, as a read-only array that follows the simulation."""
        core = self._core
        self._was_seen = True
        return core.multipliers()

    def value(self, path: str) -> Any:
        """Returns a copy of the current value of any recorded quantity.

        Parameters
        ----------
        path
            Such as "joints/hinge/force"; :attr:`quantities` lists all, with their units.
        """
        return Values(self._core, "")[path]

    @property
    def quantities(self) -> Dict[str, str]:
        """Paths accepted by :meth:`value`, with their units."""
        return {path: unit for path, unit, _ in self._core.quantities()}

    @property
    def curves(self) -> Dict[str, Curve]:
        """Sensor records so far, by name such as "tip.x"; times are "t"."""
        return {name: Curve(values, name=name, unit=unit)
                for name, unit, values in self._core.curves()}

    def __repr__(self) -> str:
        return (f"<buckens.Simulation {self._model.title!r}: t = {self.time:.6g} of "
                f"{self.end_time:.6g} s, {self.num_steps} steps>")


def _number(what: str, value: float) -> float:
    """Returns a finite number, or raises an error that names its purpose."""
    if isinstance(value, (str, bytes)):
        raise InputError(f"{what}: expected a number, found {value!r}")
    try:
        return float(value)
    except (TypeError, ValueError):
        raise InputError(f"{what}: expected a number, found {value!r}") from None


def _show_progress(t: float, end: float, steps: int) -> None:
    share = t / end if end > 0 else 1.0
    print(f"\r{share:6.1%}  t = {t:.6g} s  {steps} steps", end="", file=sys.stderr, flush=True)
