# SPDX-License-Identifier: Apache-2.0
"""Runs killed with SIGKILL at many moments leave a run directory that can be read, in which at most
the last second is missing."""

import concurrent.futures
import csv
import json
import multiprocessing
import os
import pathlib
import random
import signal
import subprocess
import time

import h5py
import numpy
import pytest

SOURCE = pathlib.Path(os.environ.get("BUCKENS_SOURCE_DIR", pathlib.Path(__file__).parents[1]))
BINARY = pathlib.Path(os.environ.get("BUCKENS_BINARY_DIR", SOURCE / "build" / "release"))
WRITER = BINARY / "test" / "kill_writer"
PROGRAM = pathlib.Path(os.environ.get("BUCKENS_PROGRAM", BINARY / "bin" / "buckens"))
MODEL = pathlib.Path(os.environ.get(
    "BUCKENS_KILL_MODEL", SOURCE / "examples" / "slider_crank" / "slider_crank.yaml"))

LOSS = 1.0  # s of records that may be missing: the promise


def run_and_kill(command, out, delay):
    """Starts the program, kills it `delay` seconds after it began to record, and returns the clock
    just before the kill."""
    sensors = out / "sensors.csv"
    sensors.unlink(missing_ok=True)  # an earlier run's; its appearance shows the start
    process = subprocess.Popen([str(part) for part in command], stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE)
    deadline = time.monotonic() + 60
    while not sensors.exists():
        assert process.poll() is None, process.stderr.read().decode()
        assert time.monotonic() < deadline, "the program does not begin to record"
        time.sleep(0.001)
    time.sleep(delay)
    assert process.poll() is None, process.stderr.read().decode()
    killed = time.monotonic()
    process.send_signal(signal.SIGKILL)
    process.wait()
    process.stderr.close()
    return killed


def datasets(file):
    found = {}
    file.visititems(lambda name, item: found.update({name: item})
                    if isinstance(item, h5py.Dataset) and not name.startswith("geometry") else None)
    return found


def visit(path):
    with h5py.File(path, "r", swmr=True) as file:
        file.visititems(lambda name, item: None)


def refuse_torn_file(out):
    """A write cut off in the middle leaves HDF5 waiting for a writer that is gone. The process that
    carries out the writes is there to prevent this; should it ever fail to, the test must not hang:
    another process looks first. It is a copy of this one, since to start Python with h5py anew takes longer than the rest."""
    probe = multiprocessing.get_context("fork").Process(target=visit, args=(out / "results.h5",))
    probe.start()
    probe.join(timeout=30)
    if probe.is_alive():
        probe.kill()
        probe.join()
        pytest.fail("results.h5 cannot be read: the kill tore a metadata write")


def check_results(out):
    """Reads every value of results.h5; returns the times and the data sets."""
    refuse_torn_file(out)
    file = h5py.File(out / "results.h5", "r", swmr=True)
    # Of a record the time is written last. Sizes are those at which a data set was opened, so it is opened first.
    times = file["time"][:]
    found = datasets(file)
    assert numpy.all(numpy.diff(times) > 0), "time increases strictly"
    for name, dataset in found.items():
        assert dataset.shape[0] >= len(times), f"{name} has fewer rows than time"
        assert numpy.all(numpy.isfinite(dataset[:len(times)])), name
        assert "unit" in dataset.attrs, name
    return times, found, file


def check_sensors(out):
    """Reads sensors.csv; every line but the last must be complete."""
    text = (out / "sensors.csv").read_text()
    lines = text.split("\n")
    partial = lines.pop()  # empty if the last line is complete
    rows = list(csv.reader(lines))
    if not rows:
        return [], []
    assert rows[0][0] == "t [s]"
    for row in rows[1:]:
        assert len(row) == len(rows[0])
        [float(value) for value in row]
    assert partial.count(",") < len(rows[0])
    return rows[0], rows[1:]


def check_directory(out):
    assert json.loads((out / "summary.json").read_text())["status"] in ("starting", "running")
    assert (out / "model.yaml").exists() and (out / "log.txt").exists()


# Without pauses; bursts of some records; single records, fast and slow.
RHYTHMS = [(100, 0), (100, 0), (37, 13), (1, 1), (250, 400), (1, 300)]
SEEDS = range(30)


def kill_writer(out, seed):
    burst, pause = RHYTHMS[seed % len(RHYTHMS)]
    return run_and_kill([WRITER, out, burst, pause], out, random.Random(seed).uniform(0, 1.6))


@pytest.fixture(scope="module")
def killed_in_pauses(tmp_path_factory):
    """Writers with pauses, which take less than a tenth of a processor each, run and are killed five at a time.
    Directory and clock of each by its seed."""
    outs = {seed: tmp_path_factory.mktemp("paused") / "out" for seed in SEEDS if RHYTHMS[seed % len(RHYTHMS)][1] > 0}
    with concurrent.futures.ThreadPoolExecutor(5) as threads:
        killed = {seed: threads.submit(kill_writer, out, seed) for seed, out in outs.items()}
    return {seed: (out, killed[seed]) for seed, out in outs.items()}


@pytest.mark.parametrize("seed", SEEDS)
def test_writer_killed_at_any_moment(tmp_path, killed_in_pauses, seed):
    if seed in killed_in_pauses:
        out, at = killed_in_pauses[seed]
        killed = at.result()
    else:
        out = tmp_path / "out"
        killed = kill_writer(out, seed)
    check_directory(out)
    times, found, _file = check_results(out)
    # Every record is the one it should be, and the two copies of its number agree.
    numbers = found["sensors/count"][:len(times)]
    assert numpy.array_equal(numbers[:, 0], numpy.arange(len(times)))
    assert numpy.array_equal(numbers[:, 0], numbers[:, 1])
    names, rows = check_sensors(out)
    if rows:
        assert names == ["t [s]", "clock [s]", "count.x [1]", "count.y [1]"]
    assert len(rows) >= len(times) - 1, "sensors.csv goes to the system line by line"
    # Records in sensors.csv but not in results.h5 were written within the last second.
    for row in rows[len(times):]:
        assert float(row[1]) >= killed - LOSS


@pytest.mark.parametrize("seed", range(30))
def test_writer_killed_while_it_starts(tmp_path, seed):
    out = tmp_path / "out"
    process = subprocess.Popen([str(WRITER), str(out), "100", "0"])
    time.sleep(random.Random(100 + seed).uniform(0, 0.04))
    process.kill()
    process.wait()
    if (out / "summary.json").exists():
        status = json.loads((out / "summary.json").read_text())["status"]
        assert status in ("starting", "running")
        assert status == "starting" or (out / "results.h5").exists()
    if (out / "results.h5").exists():
        check_results(out)
    # Whatever remains, a new run can use the directory.
    run_and_kill([WRITER, out, 100, 0], out, 0.02)
    check_results(out)


def test_records_before_a_long_silence_are_kept(tmp_path):
    """A step that takes long must not hold back the records before it."""
    out = tmp_path / "out"
    run_and_kill([WRITER, out, 37, 0, 1], out, LOSS)
    times, _found, _file = check_results(out)
    assert len(times) == 37


def test_a_reader_follows_a_running_run(tmp_path):
    out = tmp_path / "out"
    process = subprocess.Popen([str(WRITER), str(out), "10", "5"])
    try:
        while not (out / "sensors.csv").exists():
            time.sleep(0.001)
        time.sleep(0.7)
        _times, found, _file = check_results(out)
        seen = [len(found["time"])]
        for _ in range(3):
            time.sleep(0.7)
            for dataset in found.values():
                dataset.refresh()
            seen.append(len(found["time"]))
        assert all(later > earlier for earlier, later in zip(seen, seen[1:])), seen
    finally:
        process.kill()
        process.wait()


def test_a_killed_run_gives_way_to_a_new_one(tmp_path):
    out = tmp_path / "out"
    for _ in range(2):
        run_and_kill([WRITER, out, 100, 0], out, 0.1)
        check_results(out)


@pytest.mark.parametrize("seed", range(20))
def test_program_killed_at_any_moment(tmp_path, seed):
    chance = random.Random(1000 + seed)
    out = tmp_path / "out"
    command = [PROGRAM, "run", MODEL, "-o", out, "--set", "simulation.duration=1000 s"]
    run_and_kill(command, out, chance.uniform(0, 1.5))
    check_directory(out)
    times, _found, _file = check_results(out)
    names, rows = check_sensors(out)
    assert len(rows) >= len(times) - 1
    assert len(times) == 0 or len(names) > 1
