# SPDX-License-Identifier: Apache-2.0
"""Checks of arguments that several functions of :mod:`buckens.study` have."""

from __future__ import annotations

import numbers
from typing import Any

import numpy as np
import numpy.typing as npt

from .errors import InputError


def check_count(count: Any, least: int, what: str, remedy: str = "") -> None:
    """Accepts whole numbers from a least one; refuses True and False, which Python takes for 1 and 0."""
    if not isinstance(count, numbers.Integral) or isinstance(count, bool) or count < least:
        raise InputError(f"{what}: expected a whole number of at least {least}, found {count!r}{'; ' if remedy else ''}{remedy}")


def check_seed(seed: Any) -> None:
    check_count(seed, 0, "seed", "equal seeds give equal random numbers")


def numbers_of(values: Any, what: str) -> npt.NDArray[np.float64]:
    """Returns an array of numbers."""
    try:
        return np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise InputError(f"{what}: expected an array of numbers, found {_short(values)}; buckens.study.results reads one from the "
                         "table of a sweep") from None


def _short(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= 60 else f"{text[:57]}..."
