# SPDX-License-Identifier: Apache-2.0
"""buckens.study: samples with units, statistics, main effects, Sobol indices against closed forms."""

import pathlib
import sys

import numpy as np
import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent / "support"))
from python_module import buckens  # noqa: E402 (found after the path is set)

pytest.importorskip("scipy")
from buckens.study_distributions import distribution_of  # noqa: E402 (found after the path is set)

study = buckens.study


def test_distributions_are_read_with_their_units():
    samples = study.latin_hypercube({"L": "10 mm +- 100 um", "E": "200 to 210 GPa", "f": "3 Hz +- 2 %", "n": study.uniform(0, 1)},
                                    400, seed=1)
    assert samples.units == {"L": "mm", "E": "GPa", "f": "Hz", "n": ""}
    table = dict(zip(samples.columns, samples.values.T))
    # A Latin hypercube has one value in each of 400 ranges, so that means are far better than 1/20 of the deviation.
    assert table["L"].mean() == pytest.approx(10, abs=0.1 / 20 / 5)
    assert table["L"].std() == pytest.approx(0.1, rel=0.02)
    assert table["E"].min() >= 200 and table["E"].max() <= 210 and table["E"].mean() == pytest.approx(205, abs=0.1)
    assert table["f"].std() == pytest.approx(0.06, rel=0.02)
    texts = next(samples.itertuples())
    assert texts[0].endswith(" mm") and float(texts[0].split()[0]) == samples.values[0, 0] and " " not in texts[3]
    skewed = study.lognormal("2 kg", 0.5)
    assert skewed.at(0.5) == pytest.approx(2) and skewed.at(0.8413447) == pytest.approx(2 * np.exp(0.5), rel=1e-6)
    # Triangular over 0, 1, 4: a quarter of the area lies below the peak.
    assert study.triangular("0 m", "1 m", "400 cm").at(0.25) == pytest.approx(1)
    with pytest.raises(buckens.InputError, match="L: '10 mm' is in m, '1 s' in s"):
        study.sobol({"L": "10 mm +- 1 s"}, 4)
    with pytest.raises(buckens.InputError, match="L: \"fast\" is not a quantity"):
        study.sobol({"L": "fast to 10 mm"}, 4)
    with pytest.raises(buckens.InputError, match="L: expected a distribution.*found '10 mm'"):
        study.sobol({"L": "10 mm"}, 4)
    with pytest.raises(buckens.InputError, match="low < high"):
        study.grid({"L": "10 mm to 9 mm"})
    with pytest.raises(buckens.InputError, match="nothing varies; give"):
        study.grid({})


def test_designs_fill_the_space():
    ranges = {"a": study.uniform(0, 1), "b": study.uniform("0 mm", "1 mm")}
    grid = study.grid(ranges, 4)
    assert len(grid) == 16 and sorted(set(grid.values[:, 0])) == [0.125, 0.375, 0.625, 0.875]
    cube = study.latin_hypercube(ranges, 32, seed=3)
    for column in cube.values.T:
        assert sorted(np.floor(32 * column).astype(int)) == list(range(32))
    even = study.sobol(ranges, 64, seed=3)
    # Each of 8 x 8 fields holds one of 64 points of the sequence: that is what distinguishes it.
    assert len({tuple(point) for point in np.floor(8 * even.values).astype(int)}) == 64
    assert np.array_equal(even.values, study.sobol(ranges, 64, seed=3).values)
    assert not np.array_equal(even.values, study.sobol(ranges, 64, seed=4).values)
    design = study.sensitivity(ranges, 8)
    first, second, mixed = design.values[:8], design.values[8:16], design.values[16:24]
    assert len(design) == 32 and np.array_equal(mixed[:, 0], second[:, 0]) and np.array_equal(mixed[:, 1], first[:, 1])
    with pytest.raises(buckens.InputError, match="power of two as count, found 12"):
        study.sensitivity(ranges, 12)
    with pytest.raises(buckens.InputError, match="more than 100000"):
        study.grid(ranges, 400)


def ishigami(x, a=7.0, b=0.1):
    return np.sin(x[:, 0]) + a * np.sin(x[:, 1]) ** 2 + b * x[:, 2] ** 4 * np.sin(x[:, 0])


def test_sobol_indices_are_those_of_the_ishigami_function():
    """Closed form: Ishigami and Homma (1990), with a = 7, b = 0.1."""
    names = ("x1", "x2", "x3")
    design = study.sensitivity({name: study.uniform(-np.pi, np.pi) for name in names}, 4096)
    found = study.sobol_indices(design, ishigami(design.values))
    by_x1, by_x2 = (1 + 0.1 * np.pi**4 / 5) ** 2 / 2, 7**2 / 8
    together = 0.1**2 * np.pi**8 * (1 / 18 - 1 / 50)
    variance = by_x1 + by_x2 + together
    first = np.array([by_x1, by_x2, 0]) / variance
    total = np.array([by_x1 + together, by_x2, together]) / variance
    # Quasi-random points: far better than chance, whose half widths are given beside the indices.
    for exact, values, widths in ((first, found.first, found.first_error), (total, found.total, found.total_error)):
        for name, value in zip(names, exact):
            assert 0.005 < widths[name] < 0.06
            assert abs(values[name] - value) < 0.5 * widths[name]
    # A result that does not vary has no shares; one that adds up has first = total.
    assert set(study.sobol_indices(design, np.full(len(design), 3.0)).total.values()) == {0.0}
    sums = study.sobol_indices(design, design.values @ [1.0, 2.0, 0.0])
    assert sums.first["x1"] == pytest.approx(0.2, abs=0.005) and sums.total["x2"] == pytest.approx(0.8, abs=0.005)
    # Variants that failed are left out with their partners.
    values = ishigami(design.values)
    values[5] = np.nan
    assert study.sobol_indices(design, values).first["x1"] == pytest.approx(found.first["x1"], abs=2e-3)
    with pytest.raises(buckens.InputError, match="make them by buckens.study.sensitivity"):
        study.sobol_indices(study.grid({"x1": study.uniform(0, 1)}), np.zeros(5))
    with pytest.raises(buckens.InputError, match=r"each of the 20480 samples, found an array of shape \(3,\)"):
        study.sobol_indices(design, [1, 2, 3])


def test_statistics_and_main_effects(tmp_path):
    samples = study.latin_hypercube({"a": "0 to 1", "b": "0 m to 1 m"}, 2000)
    told = study.statistics(np.append(samples.values[:, 0], np.nan))
    assert told.num_values == 2000 and told.mean == pytest.approx(0.5, abs=1e-4)
    assert told.deviation == pytest.approx(1 / np.sqrt(12), rel=1e-3) and told.quantiles[0.95] == pytest.approx(0.95, abs=1e-3)
    with pytest.raises(buckens.InputError, match="no variant has a result"):
        study.statistics([np.nan])
    assert told.mean_error == pytest.approx(told.deviation / np.sqrt(2000), rel=1e-12)
    # A single value tells nothing of how values spread; equal ones do.
    single = study.statistics([3.0, np.nan])
    assert single.num_values == 1 and single.mean == single.quantiles[0.05] == 3.0
    assert np.isnan(single.deviation) and np.isnan(single.mean_error)
    assert study.statistics([3.0, 3.0])[1:4] == (3.0, 0.0, 0.0)
    values = samples.values[:, 0] ** 2
    effects = study.main_effects(samples, values, bins=10)
    # The mean of a^2 over a range of width h about m is m^2 + h^2/12.
    assert effects["a"][:, 1] == pytest.approx(effects["a"][:, 0] ** 2 + 0.01 / 12, abs=1e-4)
    assert np.ptp(effects["b"][:, 1]) < 0.1  # chance: deviation 0.3 over the root of 200 rows is 0.02 each
    pytest.importorskip("matplotlib")
    design = study.sensitivity({"a": "0 to 1", "b": "0 m to 1 m"}, 64)
    study.picture(design, design.values[:, 0], "a", file=tmp_path / "study.png")
    assert (tmp_path / "study.png").read_bytes().startswith(b"\x89PNG") and (tmp_path / "study.png").stat().st_size > 10_000


def test_a_picture_shows_results_effects_and_indices(tmp_path):
    pytest.importorskip("matplotlib")
    design = study.sensitivity({"a": "0 to 1", "rod.b": "0 m to 1 m"}, 64)
    values = 3 * design.values[:, 0]
    figure = study.picture(design, values, "height [m]", file=tmp_path / "study.svg")
    histogram, by_a, by_b, shares = figure.axes[:4]
    assert [(place.get_xlabel(), place.get_ylabel()) for place in (histogram, by_a, by_b)] == [
        ("height [m]", "variants"), ("a", "height [m]"), ("rod.b [m]", "height [m]")]
    assert shares.get_ylabel() == "share of the variance" and [text.get_text() for text in shares.get_xticklabels()] == ["a", "b"]
    assert sum(bar.get_height() for bar in histogram.patches) == len(design)
    told = study.statistics(values)
    legend = [text.get_text() for text in histogram.get_legend().get_texts()]
    assert legend == [f"mean {told.mean:.4g}"] + [f"{100 * share:.0f} % {told.quantiles[share]:.4g}" for share in (0.05, 0.5, 0.95)]
    points, effect = by_a.lines
    assert np.array_equal(points.get_xdata(), design.values[:, 0]) and np.array_equal(points.get_ydata(), values)
    assert np.array_equal(effect.get_xydata(), study.main_effects(design, values)["a"])
    heights = [bar.get_height() for bar in shares.patches]
    indices = study.sobol_indices(design, values)
    assert heights == [indices.first["a"], indices.first["rod.b"], indices.total["a"], indices.total["rod.b"]]
    assert "<!-- rod.b [m] -->" in (tmp_path / "study.svg").read_text()
    # Without indices there are three, all in use.
    assert len(study.picture(study.sobol({"a": "0 to 1", "b": "0 to 1"}, 8), range(8), file=tmp_path / "even.svg").axes) == 3


def test_columns_of_a_table_are_found(tmp_path):
    (tmp_path / "sweep.csv").write_text("name,status,tip.y [m] max\n001,done,0.5\n002,failed,\n")
    for table in (tmp_path, tmp_path / "sweep.csv", {"table": str(tmp_path / "sweep.csv")}):
        for column in ("tip.y max", "tip.y [m] max"):
            values = study.results(table, column)
            assert values[0] == 0.5 and np.isnan(values[1])
    with pytest.raises(buckens.InputError, match="no column 'tip.z max'; the columns are name, status"):
        study.results(tmp_path, "tip.z max")
    with pytest.raises(buckens.InputError, match="does not hold numbers"):
        study.results(tmp_path, "status")


@pytest.mark.parametrize("text, a, b, unit", [
    ("10 mm +- 2 %", 10, 0.2, "mm"), ("10 +- 2 %", 10, 0.2, ""), ("-5 mm +- 2 %", -5, 0.1, "mm"),
    # Of a quantity that is a percentage itself, the deviation is one, too: not 2 % of 1, with a deviation of 100 %.
    ("2 % +- 1", 2, 1, "%"), ("2 % +- 0.5 %", 2, 0.5, "%"),
    # A range has no mean: 20 % is no share of 1.
    ("1 to 20 %", 1, 20, "%"), ("1 % to 20", 1, 20, "%"), ("0 % to 0.2 %", 0, 0.2, "%")])
def test_percentages(text, a, b, unit):
    found = distribution_of("x", text)
    assert found.parameters == pytest.approx((a, b), rel=1e-15) and found.unit == unit


def test_percentages_of_nothing_are_refused():
    for text in ("2 % +- 1 mm", "2 % to 10 mm", "10 mm to 20 %"):
        with pytest.raises(buckens.InputError, match="write both in units of one kind"):
            distribution_of("x", text)
    assert study.lognormal("10 mm", "5 %").parameters == pytest.approx((10, 0.05), rel=1e-15)
    for call in (lambda: study.lognormal("10 mm", "5 mm"), lambda: study.lognormal("10 mm", 0)):
        with pytest.raises(buckens.InputError, match="lognormal: expected .* such as 0.1 or \"10 %\""):
            call()
    for call in (lambda: study.uniform(1, np.inf), lambda: study.normal(np.nan, 1)):
        with pytest.raises(buckens.InputError, match="expected a finite number"):
            call()
