# SPDX-License-Identifier: Apache-2.0
"""Factors kept on disk: the second run takes them, and no run trusts a file that is not whole."""

import fcntl
import os
import time

import pytest

BLOCK = """\
buckens: 1
title: A block that swings
gravity: [0, -9.81, 0]
materials: {steel: {E: 210 GPa, nu: 0.3, rho: 7850}}
bodies:
  block:
    mesh: {box: {size: [0.1, 0.1, 0.1], divisions: [11, 11, 11], element: hex8}, material: steel}
    interfaces: {bearing: {face: x0}}
joints: {ball: {spherical: {between: [ground, block/bearing]}}}
simulation: {duration: 0.5 ms, step: 0.1 ms}
output: {sensors: {force: {joint-force: ball}}}
"""


@pytest.fixture
def run(buckens, tmp_path):
    (tmp_path / "block.yaml").write_text(BLOCK)

    def call(name, *options):
        result = buckens("run", "block.yaml", "-q", "-o", name, *options).must(0)
        return (tmp_path / name / "sensors.csv").read_bytes(), result.err

    return call


def test_a_second_run_takes_the_factors_of_the_first(run, tmp_path):
    plain, _ = run("plain")
    first, _ = run("first", "--factors", "kept")
    files = sorted((tmp_path / "kept").iterdir())
    assert files and all(file.suffix == ".factor" for file in files)
    before = [file.stat().st_mtime_ns for file in files]
    second, told = run("second", "--factors", "kept", "--threads", 2)
    assert first == second == plain
    assert sorted((tmp_path / "kept").iterdir()) == files
    assert [file.stat().st_mtime_ns for file in files] == before, "read, not written"
    assert "factor" not in told


def test_a_file_that_is_not_whole_is_made_anew(run, tmp_path):
    first, _ = run("first", "--factors", "kept")
    for file in (tmp_path / "kept").iterdir():
        size = file.stat().st_size
        with open(file, "r+b") as stream:
            stream.truncate(size // 2)
        second, told = run("second", "--factors", "kept")
        assert "is cut short" in told and "computed anew" in told
        assert second == first
        assert file.stat().st_size == size


def test_a_folder_that_cannot_be_written_stops_nothing(run, tmp_path):
    plain, _ = run("plain")
    (tmp_path / "kept").write_text("no folder")
    found, told = run("out", "--factors", "kept")
    assert "cannot be written" in told and "the run goes on without it" in told
    assert found == plain


def test_what_killed_runs_left_is_removed(run, tmp_path):
    """Incomplete files of old, which nobody is writing; with every other file of the folder as it is."""
    kept = tmp_path / "kept"
    kept.mkdir()
    names = {"left": "0" * 32 + ".factor.123-0", "new": "1" * 32 + ".factor.124-0", "held": "2" * 32 + ".factor.125-0",
             "whole": "3" * 32 + ".factor", "mine": "my.factor.txt"}
    for what, name in names.items():
        (kept / name).write_text("incomplete")
        if what != "new":
            os.utime(kept / name, (time.time() - 3600,) * 2)
    with open(kept / names["held"]) as held:
        fcntl.flock(held, fcntl.LOCK_EX)
        run("first", "--factors", "kept")
    assert not (kept / names["left"]).exists()
    assert all((kept / names[what]).exists() for what in ("new", "held", "whole", "mine"))
    assert len(list(kept.iterdir())) == 5
