# SPDX-License-Identifier: Apache-2.0
"""Models read from a file, or made from a dictionary or objects with the same keys."""

from __future__ import annotations

import os
from typing import Any, Callable, List, Mapping, Optional, Sequence, Union

from . import _core
from .errors import InputError
from .messages import tell_messages
from .model_files import ModelFiles
from .signal_function import (ForceFunction, GivenForce, GivenSignal, SignalFunction, given_force, given_signal,
                              require_new_force, require_text)
from .yaml_text import _flow, to_yaml

Overrides = Union[Mapping[str, Any], Sequence[str], None]
PathLike = Union[str, "os.PathLike[str]"]
#: A model, a dictionary with the keys of a model file, or the path of one.
ModelLike = Union["Model", Mapping[str, Any], PathLike]


def overrides_of(changes: Overrides) -> List[str]:
    """Converts changes to arguments of `--set`, such as "bodies.rod.beam.elements=32"."""
    if changes is None:
        return []
    if isinstance(changes, str):
        return [changes]
    if isinstance(changes, Mapping):
        return [f"{path}={_flow(value, path)}" for path, value in changes.items()]
    return [str(change) for change in changes]


class Model:
    """A model, with the contents of a model file. They never change; :meth:`with_changes` returns a changed copy.

    Parameters
    ----------
    tree
        The model as a dictionary, in place of ``keys``; see :meth:`from_dict`.
    **keys
        Keys of a model file: ``bodies``, ``joints``, ``loads``, ``simulation``, ... Hyphens are not
        converted to underscores: pass such keys to :meth:`from_dict`. Values are numbers in SI units,
        strings with units ("10 mm"), expressions, arrays, lists, dictionaries, or objects such as
        :class:`buckens.Beam`. The ``file`` of a mesh may be a :class:`buckens.ArrayMesh`; matrices of
        a body may be arrays or SciPy sparse matrices.

    Examples
    --------
    >>> rod = {"beam": {"to": ["500 mm", 0, 0], "elements": 8, "material": "steel",
    ...                 "section": {"circle": {"diameter": "10 mm"}}}}
    >>> steel = {"E": "200 GPa", "nu": 0.3, "rho": 7850}
    >>> model = Model(gravity=[0, -9.81, 0], materials={"steel": steel}, bodies={"rod": rod},
    ...               joints={"clamp": {"fixed": {"between": ["ground", "rod/start"]}}},
    ...               simulation={"duration": "1 s", "step": "1 ms"})
    """

    def __init__(self, tree: Optional[Mapping[str, Any]] = None, /, **keys: Any) -> None:
        if tree is not None:
            if not isinstance(tree, Mapping):
                raise InputError(f"Model: expected a dictionary or keys of a model file, found {tree!r}; buckens.load "
                                 "reads a file")
            if keys:
                raise InputError(f"Model: a dictionary and the keys {', '.join(keys)}; put them into the dictionary")
            keys = dict(tree)
        files = ModelFiles()
        self._take(_parse(keys, ".", files), files)

    def _take(self, core: _core.Model, files: ModelFiles,
              forces: Sequence[GivenForce] = (),
              signals: Sequence[GivenSignal] = ()) -> None:
        self._core = core
        self._files = files
        self._forces = list(forces)
        self._signals = list(signals)

    @classmethod
    def _of(cls, core: _core.Model, files: ModelFiles,
            forces: Sequence[GivenForce] = (),
            signals: Sequence[GivenSignal] = ()) -> Model:
        out = cls.__new__(cls)
        out._take(core, files, forces, signals)
        return out

    @classmethod
    def from_dict(cls, tree: Mapping[str, Any], directory: PathLike = ".") -> Model:
        """Creates a model from a dictionary with the keys of a model file.

        Parameters
        ----------
        tree
            Contents as read from a YAML model file; the key ``buckens`` may be omitted.
        directory
            Directory of the files that the model names.

        Raises
        ------
        InputError
            Naming the path of the key, the value and a remedy.
        """
        files = ModelFiles()
        return cls._of(_parse(tree, directory, files), files)

    @classmethod
    def from_yaml(cls, text: str, directory: PathLike = ".") -> Model:
        """Creates a model from the text of a model file.

        Parameters
        ----------
        text
            The model file, in YAML or JSON.
        directory
            Directory of the files that the model names.
        """
        name = os.path.join(os.fspath(directory), "model.yaml")
        return cls._of(_core.Model.parse(text, name, [], False), ModelFiles())

    def with_changes(self, changes: Overrides) -> Model:
        """Returns a copy of the model with changed values.

        Parameters
        ----------
        changes
            Values by path, ``{"bodies.rod.beam.elements": 32}``, as for the option `--set`.
        """
        name = os.path.join(self._core.directory, "model.yaml")
        core = _core.Model.parse(self._core.source, name, overrides_of(changes), True)
        return Model._of(core, self._files, self._forces, self._signals)

    def force(self, marker: str, name: Optional[str] = None) -> Callable[[ForceFunction], ForceFunction]:
        """Decorator: computes the force on a marker by a function, within each time step.

        The function is called as ``f(t, x, v)`` with the time [s] and the marker's position [m] and
        velocity [m/s] (world axes, arrays of 3), several times per step. It returns three numbers [N],
        world axes, and must return the same value for the same arguments. Derivatives with respect to
        position and velocity are computed by finite differences.

        Parameters
        ----------
        marker
            Such as "rod/end", or "rod" for the origin of the body frame.
        name
            Name of the load in the results; by default that of the function.
        """

        require_text("force", marker, 'model.force("rod/end")')
        if name is not None:
            require_text("force: name", name, f'model.force({marker!r}, name="push")')

        def add(function: ForceFunction) -> ForceFunction:
            given = given_force(function, marker, name)
            require_new_force(given, self._forces, self.loads)
            self._forces.append(given)
            return function

        return add

    def signal(self, name: Optional[str] = None,
               inputs: Optional[Sequence[str]] = None) -> Callable[[SignalFunction], SignalFunction]:
        """Decorator: computes the value of a signal by a function, within each time step.

        The function is called with the time [s] and the values of other signals at the same instant,
        several times per step. It returns a number, and must return the same value for the same
        arguments. Its effect on motors and loads is part of the step's iteration, with derivatives by
        finite differences: a controller has no delay.

        Parameters
        ----------
        name
            Name of a signal with a ``setting`` or a formula, which the function replaces; by default the
            name of the function.
        inputs
            Names of the signals that the function takes; by default the names of its parameters after
            the first, except those with default values.

        Examples
        --------
        >>> @model.signal()                                           # doctest: +SKIP
        ... def command(t, angle, speed):
        ...     return 20 * (0.5 - angle) - 3 * speed
        """

        if name is not None:
            require_text("signal", name, "model.signal()")

        def add(function: SignalFunction) -> SignalFunction:
            self._signals.append(given_signal(function, name, inputs))
            return function

        return add

    def to_yaml(self) -> str:
        """Returns the model as the text of a model file, without forces and signals computed by functions.

        Meshes and matrices given as arrays appear as names of files that exist as long as the model;
        :meth:`save` writes them, too.
        """
        return self._core.source

    def save(self, path: PathLike) -> None:
        """Writes a model file, and next to it the meshes and matrices that were given as arrays.

        Parameters
        ----------
        path
            Such as "rod.yaml"; an existing file is replaced.
        """
        text = self._files.write_beside(os.path.dirname(os.fspath(path)) or ".", self.to_yaml())
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)

    @property
    def title(self) -> str:
        """Title of the model."""
        return self._core.title

    @property
    def bodies(self) -> List[str]:
        """Names of the bodies."""
        return self._core.bodies

    @property
    def joints(self) -> List[str]:
        """Names of the joints."""
        return self._core.joints

    @property
    def loads(self) -> List[str]:
        """Names of loads and force laws, without forces computed by functions."""
        return self._core.loads

    @property
    def signals(self) -> List[str]:
        """Names of the signals."""
        return self._core.signals

    @property
    def sensors(self) -> List[str]:
        """Names of the sensors."""
        return self._core.sensors

    @property
    def warnings(self) -> List[str]:
        """Warnings about implausible values."""
        return self._core.warnings

    def __repr__(self) -> str:
        counts = ", ".join(f"{len(names)} {kind if len(names) != 1 else singular}"
                           for names, kind, singular in ((self.bodies, "bodies", "body"),
                                                         (self.joints, "joints", "joint"),
                                                         (self.loads, "loads", "load")))
        return f"<buckens.Model {self.title!r}: {counts}>"


def _parse(tree: Mapping[str, Any], directory: PathLike, files: ModelFiles) -> _core.Model:
    text = to_yaml(tree if "buckens" in tree else {"buckens": 1, **tree}, files)
    text, place = files.with_places(text, tree, os.fspath(directory))
    return _core.Model.parse(text, os.path.join(place, "model.yaml"), [], True)


def load(path: Union[PathLike, Mapping[str, Any]], set: Overrides = None) -> Model:  # noqa: A002 (the program's word)
    """Reads a model file.

    Parameters
    ----------
    path
        A model file in YAML or JSON, or a dictionary with its contents.
    set
        Values to replace, ``{"bodies.rod.beam.elements": 32, "parameters.L": "280 mm"}``, as for the
        option `--set`.

    Raises
    ------
    InputError
        Citing file:line:column, the path of the key, the value and a remedy.
    IoError
        If a file cannot be read.
    """
    if isinstance(path, Mapping):
        model = Model.from_dict(path)
        return model.with_changes(set) if set else model
    if not isinstance(path, (str, os.PathLike)):
        raise InputError(f"load: expected the path of a model file or a dictionary, found {path!r}")
    model = Model._of(_core.Model.read(os.fspath(path), overrides_of(set)), ModelFiles())
    tell_messages()
    return model


def model_of(model: ModelLike) -> Model:
    """Returns a model as it is, and reads any other: a dictionary or a file."""
    if isinstance(model, Model):
        return model
    if isinstance(model, (str, os.PathLike, Mapping)):
        return load(model)
    raise InputError(f"expected a buckens.Model, a dictionary or the path of a model file, found {model!r}")
