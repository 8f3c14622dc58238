# SPDX-License-Identifier: Apache-2.0
"""buckens.sweep on a cluster of Dask here: two workers, some of them killed, a scheduler that is started again.

    BUCKENS_STUDY_VARIANTS=10000 python3 -m pytest tests/test_study_dask.py

runs the size for which the rest of the study is made; here a few hundred variants show the same.
"""

import collections
import json
import os
import pathlib
import random
import signal
import socket
import subprocess
import sys
import threading
import time

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent / "support"))
from python_module import PACKAGES, buckens, source  # noqa: E402 (found after the path is set)

distributed = pytest.importorskip("distributed", reason="python3-distributed is not installed")

MODEL = source("tests/models/pendulum.yaml")
SHORT = {"simulation.duration": "20 ms"}
COUNT = int(os.environ.get("BUCKENS_STUDY_VARIANTS", "300"))
TABLE = {"gravity.1": [-0.001 * k for k in range(COUNT)]}


class Cluster:
    """A scheduler and workers as processes, which can be killed one by one; workers come back, as a batch system would have it."""

    def __init__(self, folder):
        self.folder, self.processes = folder, {}
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.address = f"127.0.0.1:{free.getsockname()[1]}"
        self.start_scheduler()
        for number in (1, 2):
            self.start_worker(number)

    def start(self, name, *words):
        log = open(self.folder / f"{name}.log", "a")
        self.processes[name] = subprocess.Popen(
            [sys.executable, "-m", *words], stdout=log, stderr=log, cwd=self.folder, start_new_session=True,
            env={**os.environ, "PYTHONPATH": str(PACKAGES), "DASK_DISTRIBUTED__ADMIN__SYSTEM_MONITOR__INTERVAL": "10s",
                 "DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES": "3"})

    def start_scheduler(self):
        host, port = self.address.split(":")
        self.start("scheduler", "distributed.cli.dask_scheduler", "--host", host, "--port", port, "--no-dashboard",
                   "--idle-timeout", "120")  # should the tests be killed: workers end with it

    def start_worker(self, number):
        self.start(f"worker{number}", "distributed.cli.dask_worker", self.address, "--nthreads", "1", "--no-nanny",
                   "--no-dashboard", "--death-timeout", "60", "--local-directory", str(self.folder))

    def kill(self, name):
        process = self.processes[name]
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()

    def await_scheduler(self):
        """Until it listens: on a busy machine it takes longer to start than a client of little patience waits."""
        host, port = self.address.split(":")
        deadline = time.monotonic() + 60
        while True:
            try:
                return socket.create_connection((host, int(port))).close()
            except OSError:
                assert time.monotonic() < deadline, "the scheduler does not start"
                time.sleep(0.05)

    def close(self):
        for process in self.processes.values():
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGKILL)
            process.wait()


@pytest.fixture
def cluster(tmp_path):
    made = Cluster(tmp_path)
    yield made
    made.close()


@pytest.fixture
def stored(monkeypatch):
    """How often workers have begun each variant, and stored its row: of the calls that end, before their files become one."""
    from buckens.study_journal import StudyJournal

    begun, ended, tidy = collections.Counter(), collections.Counter(), StudyJournal.tidy

    def counted(journal):
        for path in journal.folder.glob("*.jsonl"):
            for line in map(json.loads, path.read_text().splitlines()):  # none is cut off: workers write lines at once
                begun.update(line.get("begin", []))
                ended.update([line["key"]] if "cells" in line else [])
        tidy(journal)

    monkeypatch.setattr(StudyJournal, "tidy", counted)
    return begun, ended


@pytest.fixture(scope="module")
def serial(tmp_path_factory):
    """The table by one process, which test_study_runs.py compares with the program's."""
    import concurrent.futures as cf

    out = tmp_path_factory.mktemp("serial")
    with cf.ThreadPoolExecutor(1) as executor:
        buckens.sweep(MODEL, TABLE, out, executor=executor, set=SHORT)
    return (out / "sweep.csv").read_text()


def size_of(rows):
    """Of the files of finished variants [bytes], or 0 while one of them goes: they become one when a study ends."""
    try:
        return sum(file.stat().st_size for file in list(rows.glob("*.jsonl")))
    except FileNotFoundError:
        return 0


def now_and_then(stop, rows, act, most, every):
    """Acts each time that some more variants are finished."""
    size, acts = 0, 0
    while not stop.wait(0.005) and acts < most:
        now = size_of(rows)
        if now > size + every:
            size, acts = now, acts + 1
            act()


def sweep_disturbed(cluster, out, act, most, every, patience=60):
    stop = threading.Event()
    thread = threading.Thread(target=now_and_then, args=(stop, out / ".rows", act, most, every))
    cluster.await_scheduler()
    with distributed.Client(cluster.address, timeout=patience) as client:
        client.wait_for_workers(2, timeout=60)
        thread.start()
        try:
            return buckens.sweep(MODEL, TABLE, out, executor=client, set=SHORT)
        finally:
            stop.set()
            thread.join()


def expect_nothing_done_twice(stored, lost):
    """What was finished is not run again; begun twice is at most the wave of six that a lost worker had before it."""
    begun, ended = stored
    assert len(ended) == COUNT and set(ended.values()) == {1}
    assert COUNT <= sum(begun.values()) <= COUNT + 6 * lost and set(begun) == set(ended)


def test_workers_killed_at_random(cluster, serial, tmp_path, stored):
    engine, killed = random.Random(2), []

    def kill_one():
        number = engine.choice((1, 2))
        cluster.kill(f"worker{number}")
        killed.append(number)
        cluster.start_worker(number)

    answer = sweep_disturbed(cluster, tmp_path / "out", kill_one, most=max(3, COUNT // 500), every=COUNT * 60)
    assert len(killed) >= 3
    assert {variant["status"] for variant in answer["variants"]} == {"done"}
    assert (tmp_path / "out" / "sweep.csv").read_text() == serial
    expect_nothing_done_twice(stored, lost=len(killed))


def test_a_scheduler_that_is_started_again(cluster, serial, tmp_path, stored):
    restarts = []

    def restart():
        restarts.append(1)
        for name in ("scheduler", "worker1", "worker2"):
            cluster.kill(name)
        time.sleep(0.2)
        cluster.start_scheduler()
        for number in (1, 2):
            cluster.start_worker(number)

    answer = sweep_disturbed(cluster, tmp_path / "out", restart, most=1, every=COUNT * 100)
    assert restarts and {variant["status"] for variant in answer["variants"]} == {"done"}
    assert (tmp_path / "out" / "sweep.csv").read_text() == serial
    expect_nothing_done_twice(stored, lost=2)


def test_a_scheduler_that_is_gone(cluster, serial, tmp_path):
    """The call ends with a message, and the next one, elsewhere, keeps what is finished."""
    import concurrent.futures as cf

    def end():
        for name in ("scheduler", "worker1", "worker2"):
            cluster.kill(name)

    with pytest.raises(buckens.IoError, match="takes no more work.*what is finished is kept"):
        sweep_disturbed(cluster, tmp_path / "out", end, most=1, every=COUNT * 100, patience=5)
    before = buckens.study.status(tmp_path / "out").done
    assert 0 < before < COUNT
    with cf.ThreadPoolExecutor(1) as executor:
        answer = buckens.sweep(MODEL, TABLE, tmp_path / "out", executor=executor, set=SHORT)
    assert [variant["status"] for variant in answer["variants"]].count("kept") == before
    assert (tmp_path / "out" / "sweep.csv").read_text().replace(",kept,", ",done,") == serial
