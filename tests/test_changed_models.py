# SPDX-License-Identifier: Apache-2.0
"""Files that are changed during a sweep or between its calls: no table has rows of different models."""

import csv
import json
import pathlib
import sys
import time

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent / "support"))

SWING = """buckens: 1
gravity: [0, -9.81, 0]
planar: xy
parameters: {push: 1 N}
bodies: {rod: {rigid: {mass: 1 kg, com: [1, 0, 0], inertia: [0, 0, 0.1]}}}
joints: {pin: {revolute: {between: [ground, rod/origin]}}}
loads: {push: {force: {on: rod, value: ["push", {file: push.csv, extrapolation: hold}, 0]}}}
simulation: {duration: 20 ms, step: 20 us}
output: {every: 1 ms, sensors: {rod: {position: rod}}}
"""
SHORT = SWING.replace("20 us", "1 ms")
MANY = ("--vary", "title=[" + ", ".join(f"v{k}" for k in range(30)) + "]", "--together", 1)
FILES = ["push.csv", "pull.csv"]


def write(folder, model=SWING, push=1, pull=2):
    (folder / "swing.yaml").write_text(model)
    (folder / "push.csv").write_text(f"0, {push}\n1, {push}\n")
    (folder / "pull.csv").write_text(f"0, {pull}\n1, {pull}\n")


def rows_of(out):
    return list(csv.DictReader((out / "sweep.csv").open()))


def ends(out):
    return [row["rod.y [m] last"] for row in rows_of(out)]


def sweep_disturbed(start, tmp_path, change):
    """Sweeps thirty equal variants, of which the first two precede the change."""
    process = start("sweep", "swing.yaml", "-o", "out", *MANY, "-q")
    for _ in range(2000):
        if (tmp_path / "out" / "003" / "summary.json").exists():
            break
        time.sleep(0.01)
    change()
    told = process.communicate(timeout=60)[1]
    return process.returncode, told


def test_a_model_edited_during_a_sweep_does_not_get_into_it(start, tmp_path):
    write(tmp_path)
    code, told = sweep_disturbed(start, tmp_path, lambda: write(tmp_path, SWING.replace("mass: 1 kg", "mass: 9 kg")))
    assert code == 0, told
    assert len(set(ends(tmp_path / "out"))) == 1


def test_a_file_changed_during_a_sweep_ends_in_no_row(buckens, start, tmp_path):
    write(tmp_path)
    code, told = sweep_disturbed(start, tmp_path, lambda: write(tmp_path, push=50))
    assert code == 4 and "push.csv: the file has changed since the sweep began" in told, told
    rows = rows_of(tmp_path / "out")
    done = [row["status"] == "done" for row in rows]
    assert done[:2] == [True, True] and not done[-1]
    assert len({row["rod.y [m] last"] for row in rows if row["status"] == "done"}) == 1
    buckens("sweep", "swing.yaml", "-o", "out", *MANY, "-q").must(0)
    assert len(set(ends(tmp_path / "out"))) == 1 and rows_of(tmp_path / "out")[0]["status"] == "done"


def test_shards_of_different_files_are_not_merged(buckens, tmp_path):
    """A file that only variants name: the model without variants does not tell that it has changed."""
    write(tmp_path, SHORT)
    call = ("sweep", "swing.yaml", "-o", "out", "--vary", "title=[a, b, c]", "--vary", "loads.push.force.value.1.file=[push.csv, pull.csv]",
            "-q", "--shard")
    for shard in ("1/2", "2/2"):
        buckens(*call, shard).must(0)
    buckens("sweep", "--merge", "out").must(0)
    before = ends(tmp_path / "out")
    write(tmp_path, SHORT, pull=7)
    buckens(*call, "2/2").must(0)
    buckens("sweep", "--merge", "out").must(2, "2-of-2.json", "another content of", "pull.csv", "1-of-2.json", "run both shards again")
    buckens(*call, "1/2").must(0)
    buckens("sweep", "--merge", "out").must(0)
    after = ends(tmp_path / "out")
    assert before[::2] == after[::2] and all(a != b for a, b in zip(before[1::2], after[1::2]))


def test_studies_notice_files_of_variants(tmp_path):
    """A finished variant is kept as long as the file that it names has the content that it had."""
    import concurrent.futures as cf

    from python_module import buckens

    write(tmp_path, SHORT)
    table = {"loads.push.force.value.1.file": FILES}

    def call(out="study"):
        return [variant["status"] for variant in buckens.sweep(tmp_path / "swing.yaml", table, tmp_path / out, executor=threads)["variants"]]

    with cf.ThreadPoolExecutor(1) as threads:
        assert call() == ["done", "done"]
        assert call() == ["kept", "kept"]
        before = ends(tmp_path / "study")
        write(tmp_path, SHORT, pull=7)
        assert buckens.study.status(tmp_path / "study").done == 1
        assert call() == ["kept", "done"]
        assert call() == ["kept", "kept"]
        after = ends(tmp_path / "study")
        assert before[0] == after[0] and before[1] != after[1]
        call("again")
        assert ends(tmp_path / "again") == after
        (tmp_path / "pull.csv").unlink()
        assert call() == ["kept", "failed"]


def test_a_file_changed_during_a_study_ends_it(tmp_path):
    from python_module import buckens
    from buckens.study_worker import Study, Task, run_task

    write(tmp_path, SHORT)
    core = buckens._core
    paths = ["title", "loads.push.force.value.1.file"]
    worker = core.VariantRows(str(tmp_path / "swing.yaml"), [], paths)
    (_, files), = worker.run([("1", ["a", "pull.csv"])])
    assert files == {str(tmp_path / "pull.csv"): core.file_content(str(tmp_path / "pull.csv"))}
    write(tmp_path, SHORT, pull=7)
    (cells, _), = worker.run([("2", ["b", "pull.csv"])])
    assert dict(cells)["status"] == "failed" and "pull.csv: the file has changed since the sweep began" in dict(cells)["message"]
    # A worker that began later reads the new file, the process that handed out the variants has seen the old one.
    import buckens.study_runs as runs

    class Journal:
        def changed_file(self, row):
            return next(iter(row["files"]), None)

    study = Study(buckens.__version__, "s", str(tmp_path / "swing.yaml"), runs.source_hash(worker.source), [], paths, str(tmp_path), "1")
    done = run_task(study, Task("t", 0, [[("k", ("3", ["c", "pull.csv"]))]]))
    assert json.dumps(done.rows) and done.rows[0]["files"]

    class Future:
        def cancelled(self):
            return False

        def exception(self):
            return None

        def result(self):
            return done

    run = runs.StudyRun.__new__(runs.StudyRun)
    run._journal = Journal()
    with pytest.raises(buckens.IoError, match="has read a different content of .*pull.csv.*call again"):
        run._take(Future(), None)
