# SPDX-License-Identifier: Apache-2.0
"""buckens.sweep on executors: the rows of a sweep by the program, bit for bit, whatever happens to the workers."""

import concurrent.futures as cf
import csv
import json
import multiprocessing
import os
import pathlib
import random
import resource
import signal
import subprocess
import sys
import threading
import time

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent / "support"))
from python_module import PACKAGES, buckens, source  # noqa: E402 (found after the path is set)

MODEL = source("tests/models/pendulum.yaml")
BLOCK = source("tests/models/soft_block.yaml")
TABLE = {"gravity.1": ["-9.81 m/s^2", "-1.62 m/s^2", 0, 2.5], "simulation.duration": ["10 ms", "20 ms", "30 ms"]}
MANY = {"gravity.1": [-0.01 * k for k in range(400)]}
SHORT = {"simulation.duration": "20 ms"}


@pytest.fixture(autouse=True)
def workers_find_the_module(monkeypatch):
    monkeypatch.setenv("PYTHONPATH", f"{PACKAGES}{os.pathsep}{pathlib.Path(__file__).parent}")


def pool(processes=2, **options):
    return cf.ProcessPoolExecutor(processes, multiprocessing.get_context("forkserver"), **options)


def text_of(out):
    return (out / "sweep.csv").read_text()


def statuses(answer):
    return [variant["status"] for variant in answer["variants"]]


@pytest.fixture(scope="module")
def serial(tmp_path_factory):
    """The table that the program makes of MANY."""
    out = tmp_path_factory.mktemp("serial")
    buckens.sweep(MODEL, {key: values[:40] for key, values in MANY.items()}, out, set=SHORT)
    return list(csv.DictReader((out / "sweep.csv").open()))


def agree_with(serial, out):
    rows = list(csv.DictReader((out / "sweep.csv").open()))
    for mine, other in zip(rows, serial):
        for row in (mine, other):
            row.pop("name", None), row.pop("status", None)  # numbered otherwise, or kept
        assert mine == other


def test_executors_make_the_table_of_the_program(tmp_path):
    buckens.sweep(MODEL, TABLE, tmp_path / "serial")
    expected = text_of(tmp_path / "serial")
    for name, executor in {"pool": pool(), "threads": cf.ThreadPoolExecutor(2), "count": 2, "made": pool}.items():
        answer = buckens.sweep(MODEL, TABLE, tmp_path / name, executor=executor)
        assert set(statuses(answer)) == {"done"}
        assert text_of(tmp_path / name) == expected
        if isinstance(executor, cf.Executor):
            executor.shutdown()
        again = buckens.sweep(MODEL, TABLE, tmp_path / name, executor=cf.ThreadPoolExecutor(1))
        assert set(statuses(again)) == {"kept"} and again["workers"] == {}
        assert text_of(tmp_path / name) == expected.replace(",done,", ",kept,")


def test_columns_of_the_hdf5_table_have_units(tmp_path):
    """In attributes: names of data sets have none, as in results.h5."""
    h5py = pytest.importorskip("h5py")
    buckens.sweep(MODEL, {"gravity.1": [1, 2]}, tmp_path, executor=cf.ThreadPoolExecutor(1), set=SHORT)
    rows = list(csv.DictReader((tmp_path / "sweep.csv").open()))
    units = {}
    with h5py.File(tmp_path / "sweep.h5") as file:
        for data in file.values():
            column, unit = (value.decode() if isinstance(value, bytes) else value for value in (data.attrs["column"], data.attrs.get("unit", "")))
            units[column] = unit
            if "[" in column:
                assert unit == column.partition("[")[2].partition("]")[0]
                assert list(data[:]) == [float(row[column]) for row in rows]
    assert set(units) == set(rows[0]) and units["tip.y [m] max"] == "m" and units["status"] == ""


def test_models_and_tables_of_all_kinds(tmp_path):
    pandas = pytest.importorskip("pandas")
    model = buckens.load(MODEL, set=SHORT)
    frame = pandas.DataFrame({"name": ["slow", "fast"], "gravity.1": [-1.625, -9.81]})
    with cf.ThreadPoolExecutor(1) as executor:
        buckens.sweep(model, frame, tmp_path / "threads", executor=executor)
    buckens.sweep(model, frame, tmp_path / "program")
    assert text_of(tmp_path / "threads") == text_of(tmp_path / "program")
    assert "slow" in text_of(tmp_path / "program") and (tmp_path / "program" / "fast" / "results.h5").exists()
    samples = buckens.study.sobol({"parameters.L": "1 m +- 1 mm", "gravity.1": "-9.9 to -9.7 m/s^2"}, 8)
    with cf.ThreadPoolExecutor(1) as executor:
        answer = buckens.sweep(model, samples, tmp_path / "samples", executor=executor)
    assert len(answer["variants"]) == 8 and len(set(buckens.study.results(answer, "tip.y last"))) == 8


def test_factors_are_made_once_per_worker(tmp_path):
    table = {"parameters.g": [-9.81, -1, 0, 1, 2, 3, 4, 5], "parameters.E": [1e8, 2e8]}
    with cf.ThreadPoolExecutor(1) as executor:
        answer = buckens.sweep(BLOCK, table, tmp_path / "one", executor=executor, together=1)
    buckens.sweep(BLOCK, table, tmp_path / "serial", together=1)
    assert text_of(tmp_path / "one") == text_of(tmp_path / "serial")
    assert answer["factorisations"] == 2  # sixteen variants with two materials, in turn in the table


def test_reasons_of_failures(tmp_path):
    table = {"parameters.L": [1, 0, 2], "bodies.rod.rigid.mass": [1, -1]}
    with cf.ThreadPoolExecutor(1) as executor:
        answer = buckens.sweep(MODEL, table, tmp_path / "out", executor=executor, set=SHORT)
        assert statuses(answer)[1::2] == ["failed"] * 3 and "mass" in answer["variants"][1]["message"]
        again = buckens.sweep(MODEL, table, tmp_path / "out", executor=executor, set=SHORT)
    assert statuses(again)[0] == "kept" and statuses(again)[1] == "failed"


def kill_now_and_then(stop, killed, pids, rows):
    """Four times a worker chosen at random, each time that some more variants are finished."""
    engine, size = random.Random(1), 0
    while not stop.wait(0.005) and len(killed) < 4:
        there = pids()
        now = sum(file.stat().st_size for file in list(rows.glob("*.jsonl")))
        if there and now > size + 20_000:
            size = now
            os.kill(engine.choice(there), signal.SIGKILL)
            killed.append(1)


def children_of(pool_):
    return [process.pid for process in list((pool_._processes or {}).values()) if process.is_alive()]


def test_killed_workers_lose_nothing(tmp_path, serial):
    """Processes get SIGKILL at random; a function that makes pools replaces them."""
    pools, stop, killed = [], threading.Event(), []

    def make():
        pools.append(pool())
        return pools[-1]

    killer = threading.Thread(target=kill_now_and_then, args=(
        stop, killed, lambda: children_of(pools[-1]) if pools else [], tmp_path / "out" / ".rows"))
    killer.start()
    try:
        answer = buckens.sweep(MODEL, MANY, tmp_path / "out", executor=make, set=SHORT, together=2)
    finally:
        stop.set()
        killer.join()
    assert set(statuses(answer)) == {"done"} and len(answer["variants"]) == 400
    assert killed and len(pools) > 1
    agree_with(serial, tmp_path / "out")


def test_a_killed_master_goes_on(tmp_path, serial):
    """The process that hands out variants is killed; the same call takes up what its workers had finished."""
    code = (f"import buckens\nif __name__ == '__main__':\n    buckens.sweep({MODEL!r}, {{'gravity.1': "
            f"[-0.01 * k for k in range(400)]}}, {str(tmp_path / 'out')!r}, executor=2, set={SHORT!r}, together=1)\n")
    (tmp_path / "call.py").write_text(code)
    process = subprocess.Popen([sys.executable, tmp_path / "call.py"], env={**os.environ, "PYTHONPATH": str(PACKAGES)},
                               start_new_session=True)
    rows = tmp_path / "out" / ".rows"
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline and sum(file.stat().st_size for file in rows.glob("*.jsonl")) < 20_000:
        time.sleep(0.02)
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    before = buckens.study.status(tmp_path / "out")
    assert before.variants == 400 and 0 < before.done < 400
    with cf.ThreadPoolExecutor(1) as executor:
        answer = buckens.sweep(MODEL, MANY, tmp_path / "out", executor=executor, set=SHORT, together=1)
    assert statuses(answer).count("kept") == before.done and statuses(answer).count("done") == 400 - before.done
    agree_with(serial, tmp_path / "out")
    assert sorted(path.name for path in rows.glob("*.jsonl")) == ["kept.jsonl"]


def small_disk():
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (3000, 3000))


def test_a_full_disk_of_workers_loses_nothing(tmp_path, serial):
    """Workers cannot write more than 3000 bytes: the process that hands out variants keeps what they could not."""
    with pool(initializer=small_disk) as executor:
        answer = buckens.sweep(MODEL, MANY, tmp_path / "out", executor=executor, set=SHORT)
    assert set(statuses(answer)) == {"done"}
    agree_with(serial, tmp_path / "out")


def die(*_):
    os.kill(os.getpid(), signal.SIGKILL)


def deadly_when_negative():
    """In workers: variants with upward gravity kill their process, as one would that is too large for the memory."""
    import buckens.study_worker as worker

    class Deadly:
        def __init__(self, *arguments):
            self.rows = buckens._core.VariantRows(*arguments)
            self.source, self.forget_factors = self.rows.source, self.rows.forget_factors
            self.num_factorisations = 0

        def run(self, variants):
            if any(values[0] == "3" for _, values in variants):
                die()
            return self.rows.run(variants)

    class Core:
        version, VariantRows = buckens._core.version, Deadly

    worker._core = Core


def test_a_variant_that_kills_its_workers_is_given_up(tmp_path):
    def make():
        return pool(1, initializer=deadly_when_negative)

    answer = buckens.sweep(MODEL, {"gravity.1": [1, 2, 3, 4, 5]}, tmp_path / "out", executor=make, set=SHORT, together=5)
    assert statuses(answer) == ["done", "done", "failed", "done", "done"]
    assert "lost 4 times" in answer["variants"][2]["message"] and "memory" in answer["variants"][2]["message"]


def test_a_pool_that_breaks_keeps_what_is_finished(tmp_path):
    with pool(1, initializer=deadly_when_negative) as executor:
        with pytest.raises(buckens.IoError, match="takes no more work.*what is finished is kept"):
            buckens.sweep(MODEL, {"gravity.1": [1, 2, 3, 4]}, tmp_path / "out", executor=executor, set=SHORT, together=1)
    assert buckens.study.status(tmp_path / "out").done >= 1
    assert "interrupted" in text_of(tmp_path / "out")


def test_says_what_is_wrong(tmp_path, monkeypatch):
    def call(match, kind=buckens.InputError, model=MODEL, table=TABLE, executor=None, out="out", **options):
        with cf.ThreadPoolExecutor(1) as threads, pytest.raises(kind, match=match):
            buckens.sweep(model, table, tmp_path / out, executor=executor or threads, **options)

    call("no variants", table={})
    call("no variants", table=__import__("pandas").DataFrame({"gravity.1": []}))
    (tmp_path / "table.csv").write_text("gravity.1,gravity.1\n1,2\n")
    call("appears twice", table=tmp_path / "table.csv")
    call("nowhere.yaml", kind=buckens.IoError, model=tmp_path / "nowhere.yaml")
    call("together: expected .* 1 to 32, found 0", together=0)
    call("expected a number of processes or something with `submit`.*found 'four'", executor="four")
    call("1 to 4096 processes, found -1", executor=-1)
    with pytest.raises(buckens.InputError, match="no study here"):
        buckens.study.status(tmp_path)
    model = buckens.load(MODEL)
    model.force("rod")(lambda t, x, v: (0, 0, 0))
    call("cannot call", model=model)
    # A quantity that the model does not know: every variant says so.
    with cf.ThreadPoolExecutor(1) as threads:
        answer = buckens.sweep(MODEL, {"simulation.durration": [1]}, tmp_path / "unknown", executor=threads)
    assert statuses(answer) == ["failed"] and "durration" in answer["variants"][0]["message"]


def test_workers_elsewhere_are_checked(tmp_path):
    """Another version, a model file that is not there, and one with another content."""
    from buckens.study_worker import Study, Task, run_task

    copy = tmp_path / "model.yaml"
    copy.write_text(pathlib.Path(MODEL).read_text())
    good = Study(buckens.__version__, "s", str(copy), "?", [], ["gravity.1"], str(tmp_path))
    task = Task("t", 0, [])
    with pytest.raises(buckens.InputError, match="has Buckens .* started by Buckens 9.9.9; install one version"):
        run_task(good._replace(version="9.9.9"), task)
    with pytest.raises(buckens.IoError, match="cannot see the model file /nowhere/model.yaml"):
        run_task(good._replace(model="/nowhere/model.yaml"), task)
    with pytest.raises(buckens.IoError, match="sees a different version"):
        run_task(good, task)


def test_one_study_at_a_time(tmp_path):
    import fcntl

    buckens.sweep(MODEL, {"gravity.1": [1]}, tmp_path / "out", executor=cf.ThreadPoolExecutor(1))
    with open(tmp_path / "out" / ".rows" / "lock", "a") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        with pytest.raises(buckens.InputError, match="another process runs a study"):
            buckens.sweep(MODEL, {"gravity.1": [1]}, tmp_path / "out", executor=cf.ThreadPoolExecutor(1))


def test_damaged_records_are_run_again(tmp_path):
    out = tmp_path / "out"
    buckens.sweep(MODEL, TABLE, out, executor=cf.ThreadPoolExecutor(1))
    expected = text_of(out)
    kept = out / ".rows" / "kept.jsonl"
    lines = kept.read_text().splitlines(keepends=True)
    kept.write_text("".join(lines[:5]) + lines[5][:40] + "\n[1, 2]\n" + json.dumps({"key": 3}) + "\n" + lines[7][:30])
    answer = buckens.sweep(MODEL, TABLE, out, executor=cf.ThreadPoolExecutor(1))
    assert statuses(answer).count("kept") == 5
    assert text_of(out).replace(",kept,", ",done,") == expected


def test_tables_of_other_shapes_are_refused(tmp_path):
    """A text is one value, not as many variants as it has letters."""
    for values in ("12", "1 to 5 m/s^2", 5, None, {"a": 1}):
        for executor in (1, None):
            with pytest.raises(buckens.InputError, match=r"gravity.1: expected a list of values, found .* buckens.study"):
                buckens.sweep(MODEL, {"gravity.1": values}, tmp_path / "out", executor=executor)
    with pytest.raises(buckens.InputError, match="gravity.1: the list of values is empty"):
        buckens.sweep(MODEL, {"gravity.1": []}, tmp_path / "out", executor=1)


def test_executors_made_by_what_is_given(tmp_path):
    with pytest.raises(buckens.InputError, match="creates something with `submit`.*it returned 5"):
        buckens.sweep(MODEL, {"gravity.1": [1]}, tmp_path / "out", executor=lambda: 5)
    answer = buckens.sweep(MODEL, {"gravity.1": [1]}, tmp_path / "out", executor=cf.ThreadPoolExecutor, set=SHORT)
    assert statuses(answer) == ["done"]


def test_results_say_why_there_are_none(tmp_path):
    with pytest.raises(buckens.IoError, match="nowhere: cannot read the table of a sweep: No such file"):
        buckens.study.results(tmp_path / "nowhere", "tip.y max")
    table = {"bodies.rod.rigid.mass": [-1, -2]}
    answer = buckens.sweep(MODEL, table, tmp_path / "out", executor=cf.ThreadPoolExecutor, set=SHORT)
    with pytest.raises(buckens.InputError, match="all 2 variants failed, the first because of: .*mass"):
        buckens.study.results(answer, "tip.y max")
