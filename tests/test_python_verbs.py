# SPDX-License-Identifier: Apache-2.0
"""Options of the program's verbs from Python: runs, continuation, shards, pages."""

import json
import logging
import os
import pathlib
import signal
import subprocess
import sys
import threading
import time
import urllib.error
import urllib.request
import webbrowser

import numpy as np
import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent / "support"))
from python_module import buckens, source  # noqa: E402 (found after the path is set)

CRANK = source("examples/slider_crank/slider_crank.yaml")
SHORT = {"simulation.duration": "5 ms", "bodies.rod.beam.elements": 4}


@pytest.fixture(scope="module")
def crank():
    return buckens.load(CRANK, set=SHORT)


@pytest.fixture(scope="module")
def done(crank, tmp_path_factory):
    """Directory of a run."""
    out = tmp_path_factory.mktemp("verbs") / "out"
    buckens.run(crank, out)
    return out


def test_a_check_writes_a_page(crank, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    told = buckens.check(crank)
    assert not list(tmp_path.iterdir())
    assert buckens.check(crank, page="assembled.html") == told
    assert buckens.check(CRANK, set=SHORT, view=True) == told
    for name in ("assembled.html", "slider_crank.html"):
        assert "Flexible slider-crank" in (tmp_path / name).read_text(encoding="utf-8")


def test_threads_change_no_modes(crank):
    one, two = (buckens.modes(crank, system=True, count=3, threads=threads)["analyses"][0]["modes"] for threads in (1, 2))
    assert one == two and len(one) == 3
    with pytest.raises(buckens.InputError, match="--threads"):
        buckens.modes(crank, threads=0)


def test_shards_make_the_table_of_the_whole(crank, tmp_path):
    table = {"parameters.speed": [100, 120, 140]}
    whole = buckens.sweep(crank, table, tmp_path / "whole")
    first = buckens.sweep(crank, table, tmp_path / "parts", shard=(1, 2))
    assert 0 < len(first["variants"]) < 3
    status = buckens.sweep_status(tmp_path / "parts")
    assert status["finished"] == len(first["variants"]) and [part["state"] for part in status["shards"]] == ["ended", "not begun"]
    with pytest.raises(buckens.InputError, match="2 of 2|2-of-2|2/2"):
        buckens.merge_sweep(tmp_path / "parts")
    buckens.sweep(crank, table, tmp_path / "parts", shard=(2, 2))
    merged = buckens.merge_sweep(tmp_path / "parts")
    assert [variant["name"] for variant in merged["variants"]] == [variant["name"] for variant in whole["variants"]]
    assert (tmp_path / "parts" / "sweep.csv").read_bytes() == (tmp_path / "whole" / "sweep.csv").read_bytes()


def test_wrong_shards_are_refused(crank, tmp_path):
    for shard in ("1/2", (1,), (1.0, 2)):
        with pytest.raises(buckens.InputError, match=r"shard: expected two whole numbers.*\(1, 4\)"):
            buckens.sweep(crank, {"parameters.speed": [100]}, tmp_path / "out", shard=shard)
    with pytest.raises(buckens.InputError, match="3/2"):
        buckens.sweep(crank, {"parameters.speed": [100]}, tmp_path / "out", shard=(3, 2))
    with pytest.raises(buckens.InputError, match="shard 1/2 and an executor"):
        buckens.sweep(crank, {"parameters.speed": [100]}, tmp_path / "out", executor=2, shard=(1, 2))


def test_a_run_goes_on_to_the_end_of_the_long_one(crank, tmp_path):
    short = buckens.run(crank, tmp_path / "out", threads=2)
    assert short["status"] == "finished" and short["steps"] == 100
    longer = buckens.continue_run(tmp_path / "out", until=7e-3)
    assert longer["steps"] == 140 and longer["end_time"] == pytest.approx(7e-3, rel=1e-12)
    buckens.run(crank, tmp_path / "whole", {"simulation.duration": "7 ms"})
    assert (tmp_path / "out" / "sensors.csv").read_bytes() == (tmp_path / "whole" / "sensors.csv").read_bytes()
    with pytest.raises(buckens.InputError, match="already reached"):
        buckens.continue_run(tmp_path / "out", until=6e-3)
    with pytest.raises(buckens.InputError, match="rod.beam.elements was 4, is 6"):
        buckens.continue_run(tmp_path / "out", until=8e-3, set={"bodies.rod.beam.elements": 6})


def test_a_run_starts_from_a_saved_state(crank, tmp_path):
    buckens.run(crank, tmp_path / "whole", save_state=tmp_path / "half.h5", save_state_at=2e-3)
    rest = buckens.run(crank, tmp_path / "rest", start_from=tmp_path / "half.h5")
    assert rest["end_time"] == pytest.approx(5e-3, rel=1e-12)
    ends = [buckens.open(tmp_path / name)["mid"][-1] for name in ("whole", "rest")]
    assert np.array_equal(*ends)
    # A Simulation reads the same files, also to another end.
    sim = buckens.Simulation.resume(tmp_path / "half.h5", crank, until=7e-3)
    sim.run()
    long = buckens.Simulation(crank.with_changes({"simulation.duration": "7 ms"}))
    long.run()
    assert sim.end_time == long.end_time == 7e-3 and sim.num_steps == long.num_steps
    assert np.array_equal(sim.bodies["rod"].displacements, long.bodies["rod"].displacements)
    assert buckens.Simulation.resume(tmp_path / "half.h5", crank, until="7 ms").end_time == 7e-3
    for wrong in ("7 m", "soon", float("nan"), float("inf"), [1], True):
        with pytest.raises(buckens.InputError, match="until: expected a time in seconds or such as '30 ms', found"):
            buckens.Simulation.resume(tmp_path / "half.h5", crank, until=wrong)
        with pytest.raises(buckens.InputError, match="until: expected a time in seconds or such as '30 ms', found"):
            buckens.continue_run(tmp_path / "rest", until=wrong)
    with pytest.raises(buckens.InputError, match="the state is that at t = .* s, after the end of the run at t = 0.001 s"):
        buckens.Simulation.resume(tmp_path / "half.h5", crank, until="1 ms")


def test_ctrl_c_that_reaches_only_python_ends_a_run(tmp_path, heed_ctrl_c):
    """As notebooks send it: to the kernel, not to its children."""
    # Unless it is ended, it takes half a minute on a fast machine.
    model = buckens.load(source("tests/models/endless.yaml"), set={"simulation.duration": 3000})
    watch = threading.Thread(target=interrupt_at_records, args=(tmp_path / "out",))
    watch.start()
    with pytest.raises(KeyboardInterrupt):
        buckens.run(model, tmp_path / "out")
    watch.join()
    run = buckens.open(tmp_path / "out")
    assert run.status == "interrupted" and 0 < run.summary["end_time"] < 3000


def interrupt_at_records(out):
    deadline = time.monotonic() + 60
    sensors = out / "sensors.csv"
    while time.monotonic() < deadline and (not sensors.exists() or sensors.read_text().count("\n") < 5):
        time.sleep(0.02)
    os.kill(os.getpid(), signal.SIGINT)


def test_a_run_states_its_errors(crank, tmp_path):
    summary = buckens.run(crank, tmp_path / "out", error=True)
    errors = summary["errors"]
    assert errors["complete"] and {run["source"] for run in errors["runs"]} >= {"time step", "mesh"}
    slider = errors["sensors"]["slider.x"]["final"]
    fine = buckens.run(crank, tmp_path / "fine", {"simulation.step": "12.5 us", "bodies.rod.beam.elements": 16})
    assert fine["status"] == "finished"
    # The statement bounds what finer steps and meshes change.
    change = buckens.open(tmp_path / "fine")["slider.x"][-1] - slider["value"]
    assert 0 < abs(change) < slider["uncertainty"]


def test_large_factors_are_kept_in_a_folder(tmp_path):
    """The second run takes those of the first; what they say: test_factors.py."""
    block = buckens.Model.from_dict({
        "gravity": [0, -9.81, 0], "materials": {"steel": {"E": "210 GPa", "nu": 0.3, "rho": 7850}},
        "bodies": {"block": {"mesh": {"box": {"size": [0.1, 0.1, 0.1], "divisions": [11, 11, 11], "element": "hex8"},
                                      "material": "steel"}, "interfaces": {"bearing": {"face": "x0"}}}},
        "joints": {"ball": {"spherical": {"between": ["ground", "block/bearing"]}}},
        "simulation": {"duration": "0.2 ms", "step": "0.1 ms"},
        "output": {"sensors": {"force": {"joint-force": "ball"}}}})
    kept = []
    for name in ("first", "second"):
        buckens.run(block, tmp_path / name, factors=tmp_path / "factors")
        kept.append({file.name: file.stat().st_mtime_ns for file in (tmp_path / "factors").iterdir()})
    assert kept[0] and kept[0] == kept[1]
    assert (tmp_path / "first/sensors.csv").read_bytes() == (tmp_path / "second/sensors.csv").read_bytes()


def test_a_run_of_arrays_goes_on_without_them(tmp_path):
    """The directory keeps what was given as arrays, also for another process."""
    corners = np.array([[x, y, z] for z in (0, 0.01) for y in (0, 0.02) for x in (0, 0.1)])
    block = buckens.ArrayMesh(corners, {"hexahedron": [[0, 1, 3, 2, 4, 5, 7, 6]]}, faces={"root": [[0, 2, 6, 4]]})

    def bar(duration):
        return buckens.Model(materials={"steel": buckens.Material(E="200 GPa", nu=0.3, rho=7850)},
                             bodies={"bar": buckens.Mesh(file=block, material="steel", interfaces={"root": {"face": "root"}})},
                             joints={"clamp": buckens.Fixed(between=["ground", "bar/root"])}, gravity=[0, 0, -9.81],
                             simulation={"duration": duration, "step": "10 us"})

    model = bar("0.5 ms")
    buckens.run(model, tmp_path / "out")
    del model
    assert buckens.continue_run(tmp_path / "out", until=1e-3)["steps"] == 100
    buckens.run(bar("1 ms"), tmp_path / "whole")
    last = [buckens.open(tmp_path / name)["energies/total"][-1]
            for name in ("out", "whole")]
    assert last[0] == last[1]


def test_functions_need_a_simulation(crank, tmp_path):
    model = buckens.load(CRANK, set=SHORT)

    @model.force("rod/mid")
    def push(t, x, v):
        return (0, 0, 0)

    with pytest.raises(buckens.InputError, match="'push' as a force.*buckens.Simulation"):
        buckens.run(model, tmp_path / "out")


def test_a_page_shows_two_runs(done, tmp_path, caplog):
    told = buckens.view(done, tmp_path / "both.html", frames=5, second=done, max_size=8)
    assert told["frames"] == told["second"]["frames"] == 5 and told["records"] > 5
    assert (tmp_path / "both.html").stat().st_size > 1000
    with caplog.at_level(logging.WARNING, logger="buckens"):
        buckens.view(done, tmp_path / "one.html", fields=["von_mise"])
    assert [record.message for record in caplog.records if "no field" in record.message][0].startswith('--fields: no field "von_mise"')
    with pytest.raises(buckens.InputError, match=r"fields: expected a list.*give \['stress'\]"):
        buckens.view(done, fields="stress")
    with pytest.raises(buckens.InputError, match="--max-size"):
        buckens.view(done, max_size=0)


def test_pages_are_opened_in_the_browser(crank, done, tmp_path, monkeypatch):
    opener = tmp_path / "xdg-open"
    opener.write_text(f"#!/bin/sh\necho \"$1\" >> {tmp_path}/opened.part && mv {tmp_path}/opened.part {tmp_path}/opened\n")
    opener.chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(buckens.IoError, match="xdg-open"):
        monkeypatch.setenv("PATH", str(tmp_path / "none"))
        buckens.view(done, tmp_path / "page.html", open=True)
    monkeypatch.setenv("PATH", f"{tmp_path}:/usr/bin:/bin")
    assert buckens.view(done, tmp_path / "page.html", open=True)["page"] == str(tmp_path / "page.html")
    assert buckens.check(crank, page=tmp_path / "model.html", open=True)["title"] == "Flexible slider-crank"
    opened = []
    monkeypatch.setattr(webbrowser, "open", lambda address: opened.append(address) or True)
    with buckens.view_live(done, open=True) as page:
        assert opened == [page.address]
    monkeypatch.setattr(webbrowser, "open", lambda address: False)
    with buckens.view_live(done) as page, pytest.raises(buckens.IoError, match="no browser"):
        page.open()


def test_a_live_page_lasts_until_it_is_closed(done):
    with buckens.view_live(done, done, frames=5) as page:
        assert page.is_open and page.address in repr(page) and page.address.startswith("http://127.0.0.1:")
        with urllib.request.urlopen(page.address + "state", timeout=30) as answer:
            assert json.load(answer)["status"] == "finished"
        with urllib.request.urlopen(page.address + "page", timeout=30) as answer:
            assert b"Flexible slider-crank" in answer.read()
    assert not page.is_open and repr(page) == "<buckens.LivePage closed>"
    page.close()
    with pytest.raises(urllib.error.URLError):
        urllib.request.urlopen(page.address, timeout=30)
    with pytest.raises(buckens.IoError, match="nothing: not a run directory"):
        buckens.view_live("nothing")


def test_a_live_page_ends_with_python(done):
    text = ("import sys, buckens\n"
            "page = buckens.view_live(sys.argv[1])\n"
            "print(page._process.pid)\n")
    call = subprocess.run([sys.executable, "-c", text, done], capture_output=True, text=True, timeout=120, check=True,
                          env={**os.environ, "PYTHONPATH": str(pathlib.Path(buckens.__file__).parents[1])})
    with pytest.raises(ProcessLookupError):
        os.kill(int(call.stdout), 0)


def test_a_verb_called_by_a_process_of_mpi_does_not_wait_for_the_others(tmp_path, monkeypatch):
    """The program would take itself for the process that mpirun has started, and wait for the rest to join."""
    for name, value in {"OMPI_COMM_WORLD_SIZE": "2", "OMPI_COMM_WORLD_RANK": "0", "PMIX_RANK": "0", "BUCKENS_MPI_SECONDS": "2"}.items():
        monkeypatch.setenv(name, value)
    monkeypatch.setitem(sys.modules, "mpi4py.MPI", object())
    assert buckens.run(source("tests/models/pendulum.yaml"), tmp_path / "out")["status"] == "finished"
    from buckens.program import environment
    assert "OMPI_COMM_WORLD_SIZE" not in environment() and "PMIX_RANK" not in environment() and "PATH" in environment()
    monkeypatch.delitem(sys.modules, "mpi4py.MPI")
    assert environment() is None
