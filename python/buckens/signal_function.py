# SPDX-License-Identifier: Apache-2.0
"""Functions that compute forces and the values of signals."""

from __future__ import annotations

import inspect
from typing import Callable, List, Optional, Sequence, Tuple

from .errors import InputError

#: f(t, x, v): time [s], position [m] and velocity [m/s] of the marker; returns a force [N].
ForceFunction = Callable[..., Sequence[float]]
#: Name of the load, marker, and the function.
GivenForce = Tuple[str, str, ForceFunction]
#: f(t, ...): time [s] and the values of signals; returns a number.
SignalFunction = Callable[..., float]
#: Name of the signal, names of its inputs, and the function.
GivenSignal = Tuple[str, List[str], SignalFunction]


def given_signal(function: SignalFunction, name: Optional[str],
                 inputs: Optional[Sequence[str]]) -> GivenSignal:
    """Returns a function with its name and inputs, by default its own name and parameters.

    Raises
    ------
    InputError
        If it is not callable, or its parameters do not define the inputs.
    """
    require_function("signal", function)
    signal = name or str(getattr(function, "__name__", "signal"))
    if inputs is None:
        return signal, _parameters(function, signal), function
    if isinstance(inputs, str):
        raise InputError(f"signal {signal!r}: inputs are a list of names, found {inputs!r}; write [{inputs!r}]")
    return signal, [str(one) for one in inputs], function


def require_function(what: str, function: object) -> None:
    """Raises an error that names the purpose unless a function is given."""
    if not callable(function):
        raise InputError(f"{what}: expected a function, found {function!r}")


def require_text(what: str, text: object, example: str) -> None:
    """Raises an error unless a name is given, as when a decorator is written without parentheses."""
    if callable(text):
        found = getattr(text, "__name__", repr(text))
        raise InputError(f"{what}: expected a name, found the function {found!r}; write @{example} above it")
    if not isinstance(text, str):
        raise InputError(f"{what}: expected a name, found {text!r}; write @{example}")


def given_force(function: ForceFunction, marker: str, name: Optional[str]) -> GivenForce:
    """Returns the name, the marker and the function of a force; it must be callable."""
    require_function(f"the force on {marker!r}", function)
    return name or str(getattr(function, "__name__", "force")), marker, function


def require_new_force(force: GivenForce, others: Sequence[GivenForce], loads: Sequence[str]) -> None:
    """Raises an error if the name is taken, as when a cell of a notebook is executed twice, which would double the force."""
    name = force[0]
    if name in loads or any(name == other for other, _, _ in others):
        raise InputError(f"the force on {force[1]!r}: the model has a load {name!r} already; give another name: "
                         f"force({force[1]!r}, name=...), or make the model anew if this is to replace it")


def _parameters(function: SignalFunction, signal: str) -> List[str]:
    """Returns the names of the parameters after the first, without those that have a default value."""
    try:
        parameters = list(inspect.signature(function).parameters.values())
    except (TypeError, ValueError):
        parameters = []
    kinds = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)
    needed = [one for one in parameters if one.default is inspect.Parameter.empty]
    if not needed or any(one.kind not in kinds for one in needed):
        raise InputError(f"signal {signal!r}: the parameters of its function do not say which signals it takes; "
                         "write f(t, angle, speed), or give inputs=[\"angle\", \"speed\"]")
    return [one.name for one in needed[1:]]
