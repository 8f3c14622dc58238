# SPDX-License-Identifier: Apache-2.0
"""Samples of varying quantities, as tables for :func:`buckens.sweep`."""

from __future__ import annotations

from typing import Any, Dict, List, Mapping, Optional, Sequence

import numpy as np

from .errors import InputError
from .study_checks import check_count, check_seed
from .study_distributions import Array, Distribution, distributions_of


class Samples:
    """A design: rows of values by path, to be run by :func:`buckens.sweep`.

    Attributes
    ----------
    columns
        Paths in the model file.
    values
        Array (rows, paths), in the units of the distributions.
    units
        Units by path.
    kind
        "grid", "latin-hypercube", "sobol" or "sensitivity".
    """

    def __init__(self, distributions: Mapping[str, Distribution], values: Array, kind: str, base: int = 0) -> None:
        self.columns: List[str] = list(distributions)
        self.values = values
        self.units = {path: distribution.unit for path, distribution in distributions.items()}
        self.kind = kind
        self.base = base  # rows of each part of a design for sensitivities
        self._distributions = dict(distributions)

    def __len__(self) -> int:
        return len(self.values)

    def itertuples(self, index: bool = False, name: Optional[str] = None) -> Any:
        """Returns rows as strings with units, like those of a pandas.DataFrame."""
        texts = [distribution.texts(column) for distribution, column in zip(self._distributions.values(), self.values.T)]
        return zip(*texts)

    def to_pandas(self) -> Any:
        """Returns a pandas.DataFrame of numbers, in the units of the distributions."""
        import pandas

        return pandas.DataFrame(self.values, columns=[f"{path} [{self.units[path]}]" if self.units[path] else path
                                                      for path in self.columns])

    def __repr__(self) -> str:
        return f"<buckens.study.Samples: {len(self)} rows of {', '.join(self.columns)} ({self.kind})>"


def grid(quantities: Mapping[str, Any], count: int = 5) -> Samples:
    """Returns all combinations of some values of each quantity.

    Parameters
    ----------
    quantities
        Distributions by path: ``{"parameters.L": "300 mm +- 1 mm"}``.
    count
        Number of values of each quantity, at the medians of intervals of equal probability.
    """
    distributions = distributions_of(quantities)
    check_count(count, 1, "count")
    if count ** len(distributions) > 100_000:
        raise InputError(f"grid: {count} values of {len(distributions)} quantities are {count ** len(distributions)} "
                         "variants, more than 100000; take fewer, or a Latin hypercube")
    shares = (np.arange(count) + 0.5) / count
    tables = np.meshgrid(*[distribution.at(shares) for distribution in distributions.values()], indexing="ij")
    return Samples(distributions, np.stack([table.ravel() for table in tables], axis=1), "grid")


def latin_hypercube(quantities: Mapping[str, Any], count: int, seed: int = 0) -> Samples:
    """Returns a Latin hypercube.

    Parameters
    ----------
    quantities
        As for :func:`grid`.
    count
        Number of rows, with one value of each quantity in each of as many intervals of equal probability.
    seed
        Of the random numbers.
    """
    from scipy.stats import qmc

    distributions = distributions_of(quantities)
    check_count(count, 1, "count")
    check_seed(seed)
    return _from_shares(distributions, qmc.LatinHypercube(len(distributions), seed=seed).random(count), "latin-hypercube")


def sobol(quantities: Mapping[str, Any], count: int, seed: int = 0) -> Samples:
    """Returns the first points of a scrambled Sobol sequence, which fill the space more evenly than random points.

    Parameters
    ----------
    quantities, seed
        As for :func:`latin_hypercube`.
    count
        Number of rows; a power of two is best.
    """
    distributions = distributions_of(quantities)
    check_count(count, 1, "count")
    check_seed(seed)
    return _from_shares(distributions, _sobol_points(len(distributions), count, seed), "sobol")


def sensitivity(quantities: Mapping[str, Any], count: int, seed: int = 0) -> Samples:
    """Returns a design for :func:`sobol_indices`.

    Saltelli's design: two independent samples A and B of `count` rows (a power of two), then for each quantity A with the
    column of that quantity taken from B. In total count (quantities + 2) rows.

    Parameters
    ----------
    quantities, count, seed
        As for :func:`sobol`.
    """
    distributions = distributions_of(quantities)
    check_count(count, 2, "count")
    check_seed(seed)
    if count & (count - 1):
        raise InputError(f"sensitivity: expected a power of two as count, found {count}; for example 64, 128 or 256")
    size = len(distributions)
    points = _sobol_points(2 * size, count, seed)
    first, second = points[:, :size], points[:, size:]
    parts = [first, second]
    for k in range(size):
        mixed = first.copy()
        mixed[:, k] = second[:, k]
        parts.append(mixed)
    return _from_shares(distributions, np.concatenate(parts), "sensitivity", count)


def _from_shares(distributions: Dict[str, Distribution], shares: Array, kind: str, base: int = 0) -> Samples:
    columns: Sequence[Array] = [distribution.at(column) for distribution, column in zip(distributions.values(), shares.T)]
    return Samples(distributions, np.stack(columns, axis=1), kind, base)


def _sobol_points(dimensions: int, count: int, seed: int) -> Array:
    from scipy.stats import qmc

    sequence = qmc.Sobol(dimensions, scramble=True, seed=seed)
    # SciPy warns about counts that are not powers of two; the points are the same.
    power = int(np.ceil(np.log2(max(count, 1))))
    return np.asarray(sequence.random_base2(power)[:count])
