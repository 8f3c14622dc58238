# SPDX-License-Identifier: Apache-2.0
"""Instants in seconds, or with a unit as in a model file."""

from __future__ import annotations

import math
from typing import Union

from . import _core
from .errors import InputError

Quantity = Union[float, str]


def instant(what: str, value: Quantity) -> float:
    """Returns a time in seconds.

    Raises
    ------
    InputError
        If it is no time, naming its purpose.
    """
    try:
        seconds = _of_text(value) if isinstance(value, str) else math.nan if isinstance(value, bool) else float(value)
    except (TypeError, ValueError, InputError):
        seconds = math.nan
    if not math.isfinite(seconds):
        raise InputError(f"{what}: expected a time in seconds or such as '30 ms', found {value!r}")
    return seconds


def _of_text(text: str) -> float:
    number, unit, factor, dimension = _core.quantity(text)
    return number * factor if not unit or dimension == "s" else math.nan
