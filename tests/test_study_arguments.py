# SPDX-License-Identifier: Apache-2.0
"""Arguments of buckens.sweep with an executor and of buckens.study: what is wrong is said, and rows of dictionaries are a table."""

import concurrent.futures as cf
import os
import pathlib
import sys

import numpy as np
import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent / "support"))
from python_module import buckens, source  # noqa: E402 (found after the path is set)

pytest.importorskip("scipy")

study = buckens.study
MODEL = source("tests/models/pendulum.yaml")
SHORT = {"simulation.duration": "10 ms"}
RANGES = {"parameters.L": "1 m to 2 m", "gravity.1": "-9.9 to -9.7 m/s^2"}


def sweep(tmp_path, table=None, **options):
    with cf.ThreadPoolExecutor(1) as threads:
        return buckens.sweep(MODEL, table or {"gravity.1": [1, 2]}, tmp_path / "out", executor=threads, set=SHORT, **options)


@pytest.mark.parametrize("options, words", [
    ({"workers": -3}, "workers: expected a whole number of at least 1, found -3; leave it out"),
    ({"workers": 0}, "workers: .* at least 1, found 0"),
    ({"workers": True}, "workers: .* at least 1, found True"),
    ({"workers": "a"}, "workers: .* at least 1, found 'a'"),
    ({"workers": 1.5}, "workers: .* at least 1, found 1.5"),
    ({"progress": 3}, "progress: expected True, False or a function .*, found 3"),
    ({"progress": "yes"}, "progress: expected True, False or a function .*, found 'yes'")])
def test_options_of_sweeps(tmp_path, options, words):
    with pytest.raises(buckens.InputError, match=words):
        sweep(tmp_path, **options)


def test_a_number_of_workers_is_taken(tmp_path):
    for count in (1, np.int64(2)):
        assert [variant["status"] for variant in sweep(tmp_path / str(count), workers=count)["variants"]] == ["done"] * 2


def test_a_list_of_dictionaries_is_a_table(tmp_path):
    """The same variants as from a file, by the program and by an executor."""
    rows = [{"name": "slow", "gravity.1": "-1.62 m/s^2", "parameters.L": 1}, {"name": "fast", "parameters.L": 2, "gravity.1": -9.81}]
    (tmp_path / "table.csv").write_text("name,gravity.1,parameters.L\nslow,-1.62 m/s^2,1\nfast,-9.81,2\n")
    buckens.sweep(MODEL, tmp_path / "table.csv", tmp_path / "file", set=SHORT)
    buckens.sweep(MODEL, rows, tmp_path / "program", set=SHORT)
    sweep(tmp_path, rows)
    expected = (tmp_path / "file" / "sweep.csv").read_text()
    assert "slow" in expected and "fast" in expected
    assert (tmp_path / "program" / "sweep.csv").read_text() == (tmp_path / "out" / "sweep.csv").read_text() == expected


@pytest.mark.parametrize("table, words", [
    ([(1, 2), (3, 4)], r"row 1 of the table: expected a dictionary .*, found \(1, 2\); .* pandas.DataFrame\(rows, columns="),
    ([{"gravity.1": 1}, [2]], r"row 2 of the table: expected a dictionary .*, found \[2\]"),
    ([{"gravity.1": 1}, {"gravity.2": 1}], "row 2 of the table: .* only one of them has gravity.1, gravity.2; repeat the value"),
    ([{"gravity.1": 1}, {}], "row 2 of the table: .* only one of them has gravity.1"),
    ([], "no variants"),
    (5, "table: expected a CSV file, .* a list of dictionaries, .*found 5"),
    (np.zeros((2, 2)), "table: expected a CSV file")])
def test_tables_that_are_none(tmp_path, table, words):
    for executor in (1, None):
        with pytest.raises(buckens.InputError, match=words):
            buckens.sweep(MODEL, table, tmp_path / "out", executor=executor)


def cube():
    return study.latin_hypercube({"a": "0 to 1"}, 4)


def minimum(**options):
    return study.minimize(MODEL, options.pop("ranges", RANGES), options.pop("result", "tip.y max"), "nowhere", **options)


@pytest.mark.parametrize("call, words", [
    (lambda: study.statistics([1, 2], quantiles=[0.5, 1.5]), "quantiles: expected numbers from 0 to 1, found 1.5; the median is 0.5"),
    (lambda: study.statistics([1, 2], quantiles=[np.nan]), "quantiles: expected numbers from 0 to 1, found nan"),
    (lambda: study.statistics([1, 2], quantiles="median"), "quantiles: expected an array of numbers, found 'median'"),
    (lambda: study.statistics(["a"]), r"values: expected an array of numbers, found \['a'\]; buckens.study.results"),
    (lambda: study.main_effects(cube(), [1, 2, 3, 4], bins=0), "bins: expected a whole number of at least 1, found 0"),
    (lambda: study.main_effects(cube(), "1234"), "values: expected an array of numbers, found '1234'|of shape"),
    (lambda: study.latin_hypercube({"a": "0 to 1"}, 4, seed=-1), "seed: expected a whole number of at least 0, found -1; equal seeds"),
    (lambda: study.sobol({"a": "0 to 1"}, 4, seed=-1), "seed: .* at least 0, found -1"),
    (lambda: study.sensitivity({"a": "0 to 1"}, 4, seed="x"), "seed: .* at least 0, found 'x'"),
    (lambda: study.sobol_indices(study.sensitivity({"a": "0 to 1"}, 4), range(12), seed=-1), "seed: .* at least 0, found -1"),
    (lambda: study.sobol_indices(study.sensitivity({"a": "0 to 1"}, 4), range(12), resamples=-1), "resamples: .* at least 0, found -1"),
    (lambda: study.latin_hypercube("a", 4), "quantities: expected distributions by path, such as .*1 m \\+- 1 mm.*, found 'a'"),
    (lambda: study.grid(["a"]), r"quantities: expected distributions by path, .*, found \['a'\]"),
    (lambda: study.latin_hypercube({"a": "0 to 1"}, "4"), "count: expected a whole number of at least 1, found '4'"),
    (lambda: minimum(ranges="a"), "quantities: expected distributions by path, .*, found 'a'"),
    (lambda: minimum(generations=0), "generations: expected a whole number of at least 1, found 0"),
    (lambda: minimum(population=9), "population: expected a whole number of at least 10, found 9; five per quantity, of which there are 2"),
    (lambda: minimum(seed=-1), "seed: .* at least 0, found -1"),
    (lambda: minimum(tolerance=-1), "tolerance: expected a number of at least 0, such as 1e-3, found -1"),
    (lambda: minimum(tolerance="fine"), "tolerance: .* found 'fine'")])
def test_arguments_of_studies(call, words, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(buckens.InputError, match=words):
        call()
    assert not list(tmp_path.iterdir())


def test_populations_by_default_are_large_enough(tmp_path, monkeypatch):
    """Five per quantity, where that is more than 16."""
    from buckens import study_optimum

    sizes = []

    def counted(model, samples, *arguments, **options):
        sizes.append(len(samples))
        return samples

    monkeypatch.setattr(study_optimum, "sweep", counted)
    four = {f"parameters.{name}": "0 to 1" for name in "abcd"}
    found = study.minimize(MODEL, four, lambda samples: samples.values.sum(axis=1), tmp_path, generations=1)
    assert sizes == [20, 20] and found.num_variants == 40
    study.minimize(MODEL, RANGES, lambda samples: samples.values.sum(axis=1), tmp_path, generations=1)
    assert sizes[2:] == [16, 16]


def test_pictures_that_cannot_be_written(tmp_path):
    pytest.importorskip("matplotlib")
    values = [1, 2, 3, 4]
    for name in ("x.foo", "x"):
        with pytest.raises(buckens.InputError, match=f"{name}: cannot write a picture of this kind; .* such as .png, .svg or .pdf"):
            study.picture(cube(), values, file=tmp_path / name)
    with pytest.raises(buckens.IoError, match="nowhere/x.png: cannot write the picture: No such file or directory"):
        study.picture(cube(), values, file=tmp_path / "nowhere" / "x.png")
    assert not os.listdir(tmp_path)
