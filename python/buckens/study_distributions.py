# SPDX-License-Identifier: Apache-2.0
"""Varying quantities: distributions with units."""

from __future__ import annotations

import re
from typing import Any, Dict, List, Mapping, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _core
from .errors import InputError

Array = npt.NDArray[np.float64]
Quantity = Union[str, float]


class Distribution:
    """A varying quantity, created by :func:`uniform`, :func:`normal`, :func:`lognormal`, :func:`triangular` or from text.

    Attributes
    ----------
    kind
        Name of the distribution.
    parameters
        Parameters in the unit as written.
    unit
        Such as "mm"; empty for SI units or dimensionless values.
    """

    def __init__(self, kind: str, parameters: Sequence[float], unit: str) -> None:
        self.kind, self.parameters, self.unit = kind, tuple(float(value) for value in parameters), unit

    def at(self, shares: Any) -> Array:
        """Returns quantiles, in the unit as written.

        Parameters
        ----------
        shares : (n,)
            Probabilities, 0 to 1.
        """
        from scipy import stats

        # Probabilities of exactly 0 or 1, which designs may contain, would give infinite values.
        p = np.clip(np.asarray(shares, dtype=np.float64), 1e-12, 1 - 1e-12)
        a, b = self.parameters[:2]
        if self.kind == "uniform":
            return np.asarray(a + (b - a) * p)
        if self.kind == "normal":
            return np.asarray(stats.norm.ppf(p, a, b))
        if self.kind == "lognormal":
            return np.asarray(a * np.exp(b * stats.norm.ppf(p)))
        low, peak, high = self.parameters
        return np.asarray(stats.triang.ppf(p, (peak - low) / (high - low), low, high - low))

    def texts(self, values: Any) -> List[str]:
        """Returns values as in a model file, with all digits and the unit.

        Parameters
        ----------
        values : (n,)
            In the unit as written.
        """
        return [f"{float(value)!r} {self.unit}".rstrip() for value in values]

    def __repr__(self) -> str:
        numbers = ", ".join(f"{value:g}" for value in self.parameters)
        return f"<{self.kind} distribution {numbers}{' ' + self.unit if self.unit else ''}>"


def uniform(low: Quantity, high: Quantity) -> Distribution:
    """Returns a uniform distribution: ``uniform("9 mm", "11 mm")``.

    Parameters
    ----------
    low, high
        Its ends: numbers in SI units, or with a unit.
    """
    (a, b), unit = _in_one_unit(low, high)
    if not a < b:
        raise InputError(f"uniform: expected low < high, found {low!r} and {high!r}")
    return Distribution("uniform", (a, b), unit)


def normal(mean: Quantity, deviation: Quantity) -> Distribution:
    """Returns a normal distribution.

    Parameters
    ----------
    mean, deviation
        Mean and standard deviation: numbers in SI units, or with a unit.
    """
    (a, b), unit = _in_one_unit(mean, deviation)
    if not b > 0:
        raise InputError(f"normal: expected a standard deviation above 0, found {deviation!r}")
    return Distribution("normal", (a, b), unit)


def lognormal(median: Quantity, deviation: Quantity) -> Distribution:
    """Returns a lognormal distribution.

    Parameters
    ----------
    median
        A number in SI units, or with a unit.
    deviation
        Standard deviation of the logarithm; 0.1 is about 10 %.
    """
    (a,), unit = _in_one_unit(median)
    (b,), unit_of_b = _in_one_unit(deviation)
    b *= _core.quantity(f"1 {unit_of_b}")[2] if unit_of_b == "%" else 1.0
    if not (a > 0 and b > 0 and unit_of_b in ("", "%")):
        raise InputError(f"lognormal: expected a median above 0 and a deviation of its logarithm above 0, such as 0.1 or \"10 %\", "
                         f"found {median!r} and {deviation!r}")
    return Distribution("lognormal", (a, b), unit)


def triangular(low: Quantity, peak: Quantity, high: Quantity) -> Distribution:
    """Returns a triangular distribution.

    Parameters
    ----------
    low, peak, high
        Its ends and its mode between them: numbers in SI units, or with a unit.
    """
    (a, b, c), unit = _in_one_unit(low, peak, high)
    if not (a <= b <= c and a < c):
        raise InputError(f"triangular: expected low <= peak <= high, found {low!r}, {peak!r} and {high!r}")
    return Distribution("triangular", (a, b, c), unit)


_RANGE = re.compile(r"(.+?)\s+(?:\+-|\+/-|±)\s*(.+)|(.+?)\s+(?:to|…|\.\.\.)\s+(.+)")


def distribution_of(path: str, given: Any) -> Distribution:
    """Returns a distribution from a distribution or text: "10 mm +- 0.1 mm" is normal with mean and standard deviation,
    "9 mm to 11 mm" is uniform. Write a tolerance that contains all values as a range.

    Raises
    ------
    InputError
        If it is not a distribution, naming the path.
    """
    if isinstance(given, Distribution):
        return given
    if isinstance(given, str):
        match = _RANGE.fullmatch(given.strip())
        try:
            if match is not None and match[1] is not None:
                return normal(_mean(match[1], match[2]), _deviation(match[2], match[1]))
            if match is not None:
                return uniform(_with_unit_of(match[3], match[4]), _with_unit_of(match[4], match[3]))
        except InputError as error:
            raise InputError(f"{path}: {error}") from None
    raise InputError(f"{path}: expected a distribution, such as \"10 mm +- 0.1 mm\", \"9 mm to 11 mm\" or "
                     f"buckens.study.triangular(...), found {given!r}")


def _with_unit_of(one: str, other: str) -> str:
    """Adds a missing unit from the other value: "9 to 11 mm", "1 to 20 %"."""
    _, unit, _, _ = _core.quantity(one)
    _, missing, _, _ = _core.quantity(other)
    return one if unit or not missing else f"{one} {missing}"


def _mean(text: str, deviation: str) -> str:
    """Adds a missing unit, "10 +- 0.1 mm", but no percent sign: the percentage is one of the mean."""
    return text if _core.quantity(deviation)[1] == "%" else _with_unit_of(text, deviation)


def _deviation(text: str, mean: str) -> str:
    """Resolves a percentage of the mean, "10 mm +- 2 %", unless the mean is a percentage itself."""
    number, unit, factor, _ = _core.quantity(text)
    value, of_mean, _, _ = _core.quantity(mean)
    if unit == "%" and of_mean != "%":
        return f"{abs(value) * number * factor!r} {of_mean}".rstrip()
    return _with_unit_of(text, mean)


def _in_one_unit(*quantities: Quantity) -> Tuple[List[float], str]:
    """Returns numbers in the unit of the first, and that unit."""
    parts = [_core.quantity(text) if isinstance(text, str) else (float(text), "", 1.0, "") for text in quantities]
    _, unit, factor, dimension = parts[0]
    for text, (number, _, _, other) in zip(quantities, parts):
        if not np.isfinite(number):
            raise InputError(f"expected a finite number, found {text!r}")
        if other != dimension:
            raise InputError(f"{quantities[0]!r} is in {dimension or 'pure numbers'}, {text!r} in {other or 'pure numbers'}; "
                             "write both in units of one kind")
    return [number * (size / factor if size != factor else 1.0) for number, _, size, _ in parts], unit


def distributions_of(quantities: Any) -> Dict[str, Distribution]:
    if not isinstance(quantities, Mapping):
        raise InputError(f"quantities: expected distributions by path, such as {{\"parameters.L\": \"1 m +- 1 mm\"}}, "
                         f"found {quantities!r}")
    if not quantities:
        raise InputError("nothing varies; give distributions by path, {\"parameters.L\": \"1 m +- 1 mm\"}")
    return {path: distribution_of(path, given) for path, given in quantities.items()}
