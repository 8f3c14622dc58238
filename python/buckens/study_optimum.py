# SPDX-License-Identifier: Apache-2.0
"""Optimisation: minima of results over ranges of quantities, by sweeps."""

from __future__ import annotations

import pathlib
from typing import Any, Callable, Dict, List, Mapping, NamedTuple, Optional

import numpy as np

from .errors import InputError
from .model import ModelLike, Overrides, PathLike
from .study_checks import check_count, check_seed
from .study_distributions import Array, Distribution, distributions_of
from .study_effects import results
from .study_sampling import Samples
from .study_workers import ExecutorLike
from .verbs import sweep


class Optimum(NamedTuple):
    """The minimum: values by path, in the units of the ranges; the result; the number of variants run; SciPy's result."""

    values: Dict[str, float]
    result: float
    num_variants: int
    scipy: Any


def minimize(model: ModelLike, ranges: Mapping[str, Any], result: "str | Callable[[Mapping[str, Any]], Any]", out: PathLike,
             executor: Optional[ExecutorLike] = None, population: Optional[int] = None, generations: int = 20, tolerance: float = 1e-3,
             seed: int = 0, set: Overrides = None) -> Optimum:  # noqa: A002
    """Minimises a result within ranges of quantities, by ``scipy.optimize.differential_evolution``.

    Each generation is one sweep, so that its variants run together or on an executor.

    Parameters
    ----------
    model, executor, set
        As for :func:`buckens.sweep`.
    ranges
        Ranges by path: ``{"parameters.L": "280 mm to 320 mm"}``.
    result
        A column of the table, such as "tip.y max", or a function that takes the return value of :func:`buckens.sweep` and
        returns a number per variant. Failed variants count as infinitely bad.
    out
        Directory, with a folder per generation. Repeating the call skips finished generations.
    population, generations, tolerance
        Variants per generation, at least five per quantity, by default 16 or that; maximum number of generations; relative
        spread of results at which the iteration ends.
    seed
        Of the random numbers.
    """
    from scipy.optimize import differential_evolution

    distributions = distributions_of(ranges)
    for path, distribution in distributions.items():
        if distribution.kind != "uniform":
            raise InputError(f"{path}: expected a range, such as \"9 mm to 11 mm\", found {distribution!r}")
    bounds = [distribution.parameters[:2] for distribution in distributions.values()]
    size = _population(population, len(bounds))
    check_count(generations, 1, "generations")
    check_seed(seed)
    if not isinstance(tolerance, (int, float)) or not 0 <= tolerance < np.inf:
        raise InputError(f"tolerance: expected a number of at least 0, such as 1e-3, found {tolerance!r}")
    folder = pathlib.Path(out)
    sizes: List[int] = []

    def generation(points: Array) -> Array:
        table = np.atleast_2d(points.T)
        place = folder / f"{len(sizes):03}"
        sizes.append(len(table))
        return _run(model, distributions, table, result, place, executor, set)

    start = _start(bounds, size, seed)
    answer = differential_evolution(generation, bounds, maxiter=generations, init=start, tol=tolerance, seed=seed, polish=False,
                                    updating="deferred", vectorized=True)
    return Optimum(dict(zip(distributions, map(float, answer.x))), float(answer.fun), sum(sizes), answer)


def _run(model: ModelLike, distributions: Dict[str, Distribution], table: Array, result: Any, place: pathlib.Path,
         executor: Optional[ExecutorLike], set: Overrides) -> Array:  # noqa: A002
    samples = Samples(distributions, table, "optimum")
    done = sweep(model, samples, place, set=set, executor=executor)
    values = results(done, result) if isinstance(result, str) else np.asarray(result(done), dtype=np.float64)
    if values.shape != (len(table),):
        raise InputError(f"the function `result` gave an array of shape {values.shape} for {len(table)} variants")
    return np.where(np.isfinite(values), values, np.inf)


def _population(population: Optional[int], num_quantities: int) -> int:
    least = 5 * num_quantities
    if population is None:
        return max(16, least)
    check_count(population, least, "population", f"five per quantity, of which there are {num_quantities}")
    return population


def _start(bounds: List[Any], population: int, seed: int) -> Array:
    from scipy.stats import qmc

    low, high = np.array(bounds).T
    return np.asarray(low + (high - low) * qmc.LatinHypercube(len(bounds), seed=seed).random(population))
