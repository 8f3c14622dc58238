# SPDX-License-Identifier: Apache-2.0
"""Progress of buckens.sweep with an executor: what is told on the way, and by buckens.study.status."""

import concurrent.futures as cf
import pathlib
import re
import sys
import time

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent / "support"))
from python_module import buckens, source  # noqa: E402 (found after the path is set)

MODEL = source("tests/models/pendulum.yaml")
TABLE = {"gravity.1": ["-9.81 m/s^2", "-1.62 m/s^2", 0, 2.5], "simulation.duration": ["10 ms", "20 ms", "30 ms"]}
SHORT = {"simulation.duration": "20 ms"}


def test_progress_is_told(tmp_path, capfd):
    told = []
    buckens.sweep(MODEL, TABLE, tmp_path / "out", executor=cf.ThreadPoolExecutor(1), progress=told.append)
    assert told and told[0].variants == 12 and told[0].done == 0 and told[0].seconds_to_go is None
    buckens.sweep(MODEL, TABLE, tmp_path / "more", executor=cf.ThreadPoolExecutor(1), progress=True)
    assert "0 of 12 variants, 0 failed" in capfd.readouterr().err
    seen = buckens.study.status(tmp_path / "out")
    assert (seen.variants, seen.done, seen.failed, seen.running) == (12, 12, 0, [])
    assert len(seen.slowest) == 5 and seen.slowest[0][1] >= seen.slowest[4][1] > 0 and seen.seconds_each > 0
    assert seen.seconds_to_go == 0 and seen.per_second > 0


def test_progress_tells_what_remains_and_what_is_slow(tmp_path, monkeypatch, capfd):
    """A variant in the middle waits for 2.5 s: more than three times the mean of the others and a second."""
    from buckens import study_progress, study_worker

    monkeypatch.setattr(study_progress, "_INTERVAL", 0.5)
    out, seen = tmp_path / "out", []

    class Waits(buckens._core.VariantRows):
        def run(self, variants):
            if any(values[0] == "3" for _, values in variants):
                time.sleep(1.2)
                seen.append(buckens.study.status(out))
                time.sleep(1.3)
            return super().run(variants)

    class Core:
        version, VariantRows = buckens._core.version, Waits

    monkeypatch.setattr(study_worker, "_core", Core)
    answer = buckens.sweep(MODEL, {"gravity.1": [1, 2, 3, 4, 5]}, out, executor=cf.ThreadPoolExecutor(1), set=SHORT, together=1,
                           progress=True)
    assert {variant["status"] for variant in answer["variants"]} == {"done"}
    lines = [line for line in capfd.readouterr().err.splitlines() if "slow: " in line]
    assert lines and re.match(r"2 of 5 variants, 0 failed, \d\.\d per second, \d+ s to go, slow: 003 for \d s on \S+:\d+$", lines[0])
    (half,) = seen
    assert half.done == 2 and half.running[0][0] == "003" and 1 < half.running[0][1] < 30
    assert half.seconds_to_go == pytest.approx(3 / half.per_second, rel=1e-12)


def test_rates_leave_out_what_an_earlier_call_has_finished():
    from buckens.study_progress import Progress, text_of

    rows = [{"cells": [["name", f"{k}"], ["status", "failed" if k == 3 else "done"]], "seconds": 2.0} for k in range(4)]
    begun = Progress.of(10, 4, rows, {}, 0, 5.0)
    assert (begun.ended, begun.failed, begun.per_second, begun.seconds_to_go) == (4, 1, None, None)
    assert text_of(begun) == "4 of 10 variants, 1 failed"
    later = Progress.of(10, 2, rows, {}, 0, 5.0)  # two in five seconds, six to come
    assert later.per_second == 0.4 and later.seconds_to_go == pytest.approx(15, rel=1e-15)
    assert text_of(later) == "4 of 10 variants, 1 failed, 0.4 per second, 15 s to go"
    assert Progress.of(4, 4, rows, {}, 0, 5.0).seconds_to_go == 0
