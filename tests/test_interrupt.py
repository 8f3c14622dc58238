# SPDX-License-Identifier: Apache-2.0
"""Runs that are read while in progress, and runs that are asked to stop."""

import json
import signal
import subprocess
import time

import h5py
import numpy
import pytest

INTERRUPTED = 130


def wait_for_records(process, out, lines=20):
    """Waits until sensors.csv has some lines."""
    deadline = time.monotonic() + 60
    sensors = out / "sensors.csv"
    while not sensors.exists() or sensors.read_text().count("\n") < lines:
        assert process.poll() is None, process.communicate()
        assert time.monotonic() < deadline, "no records"
        time.sleep(0.02)


def check_ended_in_order(out):
    summary = json.loads((out / "summary.json").read_text())
    assert summary["status"] == "interrupted" and not summary["finished"]
    assert "interrupted by the user" in summary["interrupted"]
    assert summary["steps"] > 0
    assert summary["end_time"] == pytest.approx(summary["steps"] * 1e-3, rel=1e-12)
    text = (out / "sensors.csv").read_text()
    assert text.endswith("\n")
    rows = len(text.splitlines()) - 1
    with h5py.File(out / "results.h5", "r") as file:
        times = file["time"][:]
    assert len(times) == rows
    # Records are made every 100 ms; all that were due are there.
    assert summary["end_time"] - times[-1] < 100e-3 + 1e-9
    return summary


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_ends_the_run_in_order(start, models, tmp_path, number):
    process = start("run", models / "endless.yaml", "-o", "out")
    wait_for_records(process, tmp_path / "out")
    process.send_signal(number)
    out, err = process.communicate(timeout=60)
    assert process.returncode == INTERRUPTED, err
    summary = check_ended_in_order(tmp_path / "out")
    assert "interrupted by the user" in out
    assert f"{summary['steps']} steps" in out, "says how far it came"
    assert "Newton iterations" in (tmp_path / "out" / "log.txt").read_text()


def test_interrupted_run_as_json(start, models, tmp_path):
    process = start("run", models / "endless.yaml", "-o", "out", "--json")
    wait_for_records(process, tmp_path / "out")
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=60)
    assert process.returncode == INTERRUPTED, err
    assert json.loads(out) == check_ended_in_order(tmp_path / "out")


def test_a_second_signal_ends_it_at_once(start, models, tmp_path):
    process = start("run", models / "endless.yaml", "-o", "out")
    wait_for_records(process, tmp_path / "out")
    process.send_signal(signal.SIGSTOP)  # so that both wait for it together
    process.send_signal(signal.SIGINT)
    process.send_signal(signal.SIGTERM)
    process.send_signal(signal.SIGCONT)
    process.communicate(timeout=60)
    assert process.returncode in (-signal.SIGINT, -signal.SIGTERM)


def test_a_signal_that_the_parent_passes_on_is_the_same_request(start, models, tmp_path):
    """Ctrl-C at a terminal reaches the program and its parent, which may send it on."""
    process = start("run", models / "endless.yaml", "-o", "out")
    wait_for_records(process, tmp_path / "out")
    process.send_signal(signal.SIGSTOP)  # so that both wait for it together
    process.send_signal(signal.SIGINT)
    subprocess.run(["sh", "-c", f"kill -TERM {process.pid}"], check=True)  # somebody else
    process.send_signal(signal.SIGCONT)
    process.communicate(timeout=60)
    assert process.returncode == INTERRUPTED
    check_ended_in_order(tmp_path / "out")


def test_ignored_signals_stay_ignored(start, models, tmp_path):
    """As with nohup and background jobs of scripts."""
    process = start("run", models / "endless.yaml", "-o", "out",
                    preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
    wait_for_records(process, tmp_path / "out")
    process.send_signal(signal.SIGHUP)
    time.sleep(0.5)
    assert process.poll() is None
    process.send_signal(signal.SIGTERM)
    process.communicate(timeout=60)
    assert process.returncode == INTERRUPTED


def test_results_can_be_read_while_the_run_goes_on(start, buckens, models, tmp_path):
    process = start("run", models / "endless.yaml", "-o", "out")
    out = tmp_path / "out"
    wait_for_records(process, out)
    assert json.loads((out / "summary.json").read_text())["status"] == "running"
    deadline = time.monotonic() + 30
    seen = []
    while len(set(seen)) < 2:  # it grows while it is read
        assert time.monotonic() < deadline, seen
        with h5py.File(out / "results.h5", "r", swmr=True) as file:
            times = file["time"][:]
            tip = file["sensors/tip"][:len(times)]
        assert numpy.all(numpy.diff(times) > 0)
        assert numpy.allclose(numpy.linalg.norm(tip, axis=1), 1.0, atol=1e-6)  # stays on its circle
        seen.append(len(times))
        time.sleep(0.2)
    assert process.poll() is None


def test_two_runs_do_not_share_a_directory(start, buckens, models, tmp_path):
    process = start("run", models / "endless.yaml", "-o", "out")
    wait_for_records(process, tmp_path / "out")
    buckens("run", models / "pendulum.yaml", "-o", "out").must(5, "out", "another run")
    assert process.poll() is None


def test_a_killed_run_can_be_replaced(start, buckens, models, tmp_path):
    process = start("run", models / "endless.yaml", "-o", "out")
    wait_for_records(process, tmp_path / "out")
    process.kill()
    process.wait()
    with h5py.File(tmp_path / "out" / "results.h5", "r", swmr=True) as file:
        assert "time" in file
    buckens("run", models / "pendulum.yaml", "-o", "out").must(0)
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["status"] == "finished" and summary["title"] == "Test pendulum"
