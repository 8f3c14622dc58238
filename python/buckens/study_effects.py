# SPDX-License-Identifier: Apache-2.0
"""Evaluation of a study: mean and quantiles of results, main effects, Sobol indices, a figure."""

from __future__ import annotations

import csv
import os
from typing import Any, Dict, List, Mapping, NamedTuple, Optional, Sequence, Union

import numpy as np

from .errors import InputError, IoError
from .model import PathLike
from .study_checks import check_count, check_seed, numbers_of
from .study_distributions import Array
from .study_sampling import Samples

#: The return value of :func:`buckens.sweep`, or the directory or table that it has written.
SweepLike = Union[Mapping[str, Any], PathLike]


def results(sweep: SweepLike, column: str) -> Array:
    """Returns a column of a sweep table as numbers, one per variant; NaN for failed variants.

    Parameters
    ----------
    sweep
        What :func:`buckens.sweep` has returned, or the directory or table that it has written.
    column
        Such as "tip.y [m] max"; the unit may be omitted: "tip.y max".

    Raises
    ------
    InputError
        If there is no such column, naming the existing ones, or if all variants failed.
    IoError
        If there is no table.
    """
    path = os.fspath(sweep["table"] if isinstance(sweep, Mapping) else sweep)
    if os.path.isdir(path):
        path = os.path.join(path, "sweep.csv")
    try:
        with open(path, encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
    except OSError as error:
        raise IoError(f"{path}: cannot read the table of a sweep: {error.strerror}") from None
    if rows and all(row.get("status") == "failed" for row in rows):
        raise InputError(f"{path}: all {len(rows)} variants failed, the first because of: {rows[0].get('message')}")
    names = list(rows[0]) if rows else []
    found = [name for name in names if column in (name, _without_unit(name))]
    if not found:
        raise InputError(f"{path}: there is no column {column!r}; the columns are {', '.join(names)}")
    try:
        return np.array([float(row[found[0]] or "nan") for row in rows])
    except ValueError:
        raise InputError(f"{path}: the column {found[0]!r} does not hold numbers") from None


def _without_unit(name: str) -> str:
    before, bracket, rest = name.partition(" [")
    return before + rest.partition("]")[2] if bracket else name


class Statistics(NamedTuple):
    """Statistics of one result over a study."""

    num_values: int     # of successful variants
    mean: float
    deviation: float    # standard deviation; NaN for a single value
    mean_error: float   # standard error of the mean for independent samples; NaN for a single value
    quantiles: Dict[float, float]


def statistics(values: Any, quantiles: Sequence[float] = (0.05, 0.25, 0.5, 0.75, 0.95)) -> Statistics:
    """Returns mean, standard deviation and quantiles.

    Parameters
    ----------
    values : (n,)
        A result per variant, as from :func:`results`; failed variants (NaN) are left out.
    quantiles
        Between 0 and 1.
    """
    shares = numbers_of(quantiles, "quantiles").ravel()
    for share in shares:
        if not 0 <= share <= 1:
            raise InputError(f"quantiles: expected numbers from 0 to 1, found {share:g}; the median is 0.5")
    good = _good(numbers_of(values, "values"))
    deviation = float(np.std(good, ddof=1)) if len(good) > 1 else float("nan")
    return Statistics(len(good), float(np.mean(good)), deviation, deviation / float(np.sqrt(len(good))),
                      {float(share): float(np.quantile(good, share)) for share in shares})


def main_effects(samples: Samples, values: Any, bins: int = 5) -> Dict[str, Array]:
    """Returns how the mean of a result depends on each quantity.

    Parameters
    ----------
    samples
        The design that was run.
    values : (n,)
        A result per row of it, as from :func:`results`.
    bins
        Maximum number of intervals of each quantity.

    Returns
    -------
    dict
        For each path an array (bins, 2): mean of the quantity, in its unit, and mean of the result over the variants in a
        bin. Bins hold equal numbers of variants; a quantity with fewer values than bins has one bin for each.
    """
    check_count(bins, 1, "bins")
    results_ = _rows(samples, values)
    out = {}
    for path, column in zip(samples.columns, samples.values.T):
        parts = [np.flatnonzero(column == value) for value in np.unique(column)]
        if len(parts) > bins:
            parts = np.array_split(np.argsort(column, kind="stable"), bins)
        means = []
        for part in parts:
            part = part[np.isfinite(results_[part])]
            if len(part):
                means.append((float(np.mean(column[part])), float(np.mean(results_[part]))))
        out[path] = np.array(means)
    return out


class SobolIndices(NamedTuple):
    """Contributions of each quantity to the variance of a result.

    Attributes
    ----------
    first
        First-order index: the contribution of a quantity alone.
    total
        Total index: the contribution including interactions with other quantities.
    first_error, total_error
        Half-widths of 95 % confidence intervals, by resampling.
    """

    first: Dict[str, float]
    total: Dict[str, float]
    first_error: Dict[str, float]
    total_error: Dict[str, float]


def sobol_indices(samples: Samples, values: Any, resamples: int = 200, seed: int = 0) -> SobolIndices:
    """Computes Sobol indices from a design of :func:`buckens.study.sensitivity`.

    First-order indices use the estimator of Saltelli et al. (2010), total indices that of Jansen (1999). Failed variants
    are omitted together with their partner rows.

    Parameters
    ----------
    samples
        A design of :func:`sensitivity`.
    values : (n,)
        A result per row of it, as from :func:`results`.
    resamples, seed
        Number of samples for the confidence intervals, and seed of their random numbers.
    """
    if samples.kind != "sensitivity":
        raise InputError(f"sobol_indices: the samples are of the kind {samples.kind!r}; make them by buckens.study.sensitivity")
    check_count(resamples, 0, "resamples")
    check_seed(seed)
    parts = _rows(samples, values).reshape(-1, samples.base)
    parts = parts[:, np.all(np.isfinite(parts), axis=0)]
    if parts.shape[1] < 2:
        raise InputError("sobol_indices: fewer than two rows of the design have results for all their variants")
    first, total = _indices(parts)
    engine = np.random.default_rng(seed)
    drawn = [_indices(parts[:, engine.integers(0, parts.shape[1], parts.shape[1])]) for _ in range(resamples)]
    errors = [1.96 * np.std([pair[k] for pair in drawn], axis=0) if resamples > 1 else np.zeros(len(first)) for k in (0, 1)]
    by_path = [dict(zip(samples.columns, map(float, numbers))) for numbers in (first, total, *errors)]
    return SobolIndices(*by_path)


def _indices(parts: Array) -> "tuple[Array, Array]":
    """Computes indices from rows with the results of A, of B, and of A with one column from B each."""
    # Subtracting the mean does not change the indices, but reduces the scatter of their estimators.
    centred = parts - np.mean(parts[:2])
    a, b, mixed = centred[0], centred[1], centred[2:]
    variance = np.var(centred[:2])
    if variance <= 1e-30 * max(float(np.max(np.abs(parts))) ** 2, 1e-300):
        return np.zeros(len(mixed)), np.zeros(len(mixed))
    first = np.mean(b * (mixed - a), axis=1) / variance
    total = np.mean((a - mixed) ** 2, axis=1) / (2 * variance)
    return first, total


def _rows(samples: Samples, values: Any) -> Array:
    out = numbers_of(values, "values")
    if out.shape != (len(samples),):
        raise InputError(f"expected a result for each of the {len(samples)} samples, found an array of shape {out.shape}")
    return out


def _good(values: Array) -> Array:
    good: Array = values[np.isfinite(values)]
    if not len(good):
        raise InputError("no variant has a result")
    return good


def picture(samples: Samples, values: Any, label: str = "result", file: Optional[PathLike] = None) -> Any:
    """Draws a matplotlib figure: a histogram with mean and quantiles, the result against each quantity with its main
    effect, and Sobol indices, if the design allows them.

    Parameters
    ----------
    samples, values
        As for :func:`main_effects`.
    label
        What the result is called.
    file
        Saves the figure, by its ending as .png, .svg or .pdf.

    Raises
    ------
    InputError
        If the file has another ending that matplotlib does not know.
    IoError
        If the file cannot be written.
    """
    results_ = _rows(samples, values)
    told = statistics(results_)
    has_indices = samples.kind == "sensitivity"
    count = 1 + len(samples.columns) + has_indices
    columns = min(count, 3)
    rows = -(-count // columns)
    figure = _figure(file is not None, figsize=(4.2 * columns, 3.2 * rows), layout="constrained")
    if file is not None:
        _check_ending(file, figure)
    axes = figure.subplots(rows, columns, squeeze=False)
    places = list(axes.ravel())
    _draw_distribution(places[0], _good(results_), told, label)
    for place, (path, effect) in zip(places[1:], main_effects(samples, results_).items()):
        unit = samples.units[path]
        place.plot(samples.values[:, samples.columns.index(path)], results_, ".", markersize=3, alpha=0.5)
        place.plot(effect[:, 0], effect[:, 1], "o-", color="C1")
        place.set_xlabel(f"{path} [{unit}]" if unit else path)
        place.set_ylabel(label)
    if has_indices:
        _draw_indices(places[1 + len(samples.columns)], sobol_indices(samples, results_))
    for place in places[count:]:
        place.set_axis_off()
    if file is not None:
        try:
            figure.savefig(os.fspath(file))
        except OSError as error:
            raise IoError(f"{os.fspath(file)}: cannot write the picture: {error.strerror or error}") from None
    return figure


def _check_ending(file: PathLike, figure: Any) -> None:
    ending = os.path.splitext(os.fspath(file))[1][1:].lower()
    known = figure.canvas.get_supported_filetypes()
    if ending not in known:
        raise InputError(f"{os.fspath(file)}: cannot write a picture of this kind; give the file an ending such as .png, .svg or "
                         f".pdf (matplotlib knows {', '.join(sorted(known))})")


def _figure(for_a_file: bool, **options: Any) -> Any:
    """Returns a new figure; one for a file needs no window, whatever the back end."""
    if for_a_file:
        from matplotlib.figure import Figure
        return Figure(**options)
    import matplotlib.pyplot as plt
    return plt.figure(**options)


def _draw_distribution(place: Any, good: Array, told: Statistics, label: str) -> None:
    place.hist(good, bins=min(40, max(5, int(np.sqrt(len(good))))), color="0.8")
    place.axvline(told.mean, color="C1", label=f"mean {told.mean:.4g}")
    for share in (0.05, 0.5, 0.95):
        place.axvline(told.quantiles[share], linestyle="--", color="C0", label=f"{100 * share:.0f} % {told.quantiles[share]:.4g}")
    place.set_xlabel(label)
    place.set_ylabel("variants")
    place.legend(fontsize="small")


def _draw_indices(place: Any, indices: SobolIndices) -> None:
    names: List[str] = list(indices.first)
    at = np.arange(len(names))
    place.bar(at - 0.2, list(indices.first.values()), 0.4, yerr=list(indices.first_error.values()), label="first order")
    place.bar(at + 0.2, list(indices.total.values()), 0.4, yerr=list(indices.total_error.values()), label="total")
    place.set_xticks(at, [name.rpartition(".")[2] for name in names])
    place.set_ylabel("share of the variance")
    place.legend(fontsize="small")
