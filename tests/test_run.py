# SPDX-License-Identifier: Apache-2.0
"""`buckens run`: what it prints, what it writes, and what it promises."""

import csv
import json
import os
import pty
import re
import resource
import time

import h5py
import numpy
import pytest


def summary_of(directory):
    return json.loads((directory / "summary.json").read_text())


def sensors_of(directory):
    rows = list(csv.reader((directory / "sensors.csv").open()))
    return rows[0], numpy.array(rows[1:], dtype=float), rows[1:]


def test_run_directory_is_complete(buckens, models, tmp_path):
    result = buckens("run", models / "pendulum.yaml", "-o", "out").must(0)
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == [
        "checkpoint.h5", "log.txt", "model.yaml", "results.h5", "sensors.csv", "summary.json"]
    for word in ["Test pendulum", "100 steps", "t = 0.1 s", "Newton iterations",
                 "residual, position", "residual, velocity", "sieve", "energy", "set-up", "stepping", "trust",
                 "buckens view out"]:
        assert word in result.out, word
    log = (tmp_path / "out" / "log.txt").read_text()
    assert "Newton iterations" in log and "pendulum.yaml" in log


def test_default_directory_has_the_name_of_the_model(buckens, models, tmp_path):
    result = buckens("run", models / "pendulum.yaml").must(0)
    assert "pendulum.out" in result.out
    assert (tmp_path / "pendulum.out" / "results.h5").exists()


def test_summary_has_what_is_documented(buckens, models, tmp_path):
    buckens("run", models / "beam.yaml", "-o", "out").must(0)
    summary = summary_of(tmp_path / "out")
    assert {"steps", "wall_seconds", "bodies", "setup_solves", "newton_iterations", "residuals",
            "energy_error", "trust", "warnings"} <= set(summary)
    wall = summary["wall_seconds"]
    assert {"total", "setup", "stepping", "phases", "preparation"} <= set(wall)
    before = {"model", "meshes", "assembly"}
    assert before | {"initial_state", "order", "factor", "responses", "records", "rest"} <= set(wall["preparation"])
    parts = [seconds for name, seconds in wall["preparation"].items() if name not in before]
    assert min(parts) >= 0 and abs(sum(parts) - wall["setup"]) < 1e-3 * wall["setup"] + 1e-5
    assert {"dof", "factorisations", "solves"} <= set(summary["bodies"]["beam"])
    assert {"position", "velocity", "sieve"} <= set(summary["residuals"])
    assert summary["status"] == "finished" and summary["finished"]
    assert summary["steps"] == 100
    # Position rows are solved to rounding, velocity rows to the Newton tolerance of 1e-10 relative
    # to speeds below 10 m/s.
    assert summary["residuals"]["position"] < 1e-9
    assert summary["residuals"]["velocity"] < 1e-8
    assert summary["residuals"]["sieve"] < 1e-12


def test_one_factorisation_and_one_solve_per_step(buckens, models, tmp_path):
    """The promise of the method; exactly one solve holds with coupling `none`."""
    buckens("run", models / "beam.yaml", "-o", "out").must(0)
    summary = summary_of(tmp_path / "out")
    beam = summary["bodies"]["beam"]
    assert beam["dof"] == 27
    assert beam["factorisations"] == 1
    assert beam["solves"] == summary["steps"] == 100
    buckens("run", models / "beam.yaml", "-o", "full", "--set", "bodies.beam.coupling=full").must(0)
    full = summary_of(tmp_path / "full")["bodies"]["beam"]
    assert full["factorisations"] == 1
    assert full["solves"] >= 100


def test_rigid_bodies_are_not_factorised(buckens, models, tmp_path):
    buckens("run", models / "pendulum.yaml", "-o", "out").must(0)
    rod = summary_of(tmp_path / "out")["bodies"]["rod"]
    assert rod["dof"] == 0 and rod["factorisations"] == 0 and rod["solves"] == 0


def test_sensors_have_names_units_and_17_digits(buckens, models, tmp_path):
    buckens("run", models / "beam.yaml", "-o", "out").must(0)
    header, values, texts = sensors_of(tmp_path / "out")
    assert header[0] == "t [s]"
    assert {"tip.x [m]", "tip.y [m]", "bearing.x [N]", "bend.y [m]"} <= set(header)
    for name in header:
        assert re.fullmatch(r"[\w-]+(\.[\w-]+)* \[.+\]", name), name
    assert values.shape == (51, len(header))
    assert numpy.allclose(values[:, 0], numpy.arange(51) * 1e-3, rtol=0, atol=1e-15)
    # 17 significant digits reproduce every double: text -> number -> text changes nothing.
    digits = max(len(re.sub(r"e.*|[^0-9]", "", text).lstrip("0")) for row in texts for text in row)
    assert digits == 17
    with h5py.File(tmp_path / "out" / "results.h5", "r") as file:
        tip = file["sensors/tip"][:]
        assert file["sensors/tip"].attrs["unit"] in ("m", b"m")
    columns = [header.index("tip.x [m]"), header.index("tip.y [m]")]
    assert numpy.array_equal(values[:, columns], tip[:, :2])


def test_two_runs_give_the_same_numbers(buckens, models, tmp_path):
    for out in ("one", "two"):
        buckens("run", models / "beam.yaml", "-o", out,
                "--set", "bodies.beam.coupling=full").must(0)
    assert ((tmp_path / "one" / "sensors.csv").read_bytes()
            == (tmp_path / "two" / "sensors.csv").read_bytes())


def test_threads_change_no_bit(buckens, models, tmp_path):
    for threads in ("1", "2", "3"):
        buckens("run", models / "twin_beams.yaml", "-o", threads, "--threads", threads).must(0)
    alone = (tmp_path / "1" / "sensors.csv").read_bytes()
    assert alone.count(b"\n") > 10
    assert (tmp_path / "2" / "sensors.csv").read_bytes() == alone
    assert (tmp_path / "3" / "sensors.csv").read_bytes() == alone
    bodies = summary_of(tmp_path / "2")["bodies"]
    assert bodies["left"]["factorisations"] + bodies["right"]["factorisations"] == 1


def test_a_number_of_threads_that_makes_no_sense(buckens, models):
    buckens("run", models / "pendulum.yaml", "--threads", "0").must(2, "--threads")
    buckens("run", models / "pendulum.yaml", "--threads", "many").must(2, "--threads")


def test_a_second_run_replaces_the_first(buckens, models, tmp_path):
    buckens("run", models / "beam.yaml", "-o", "out").must(0)
    buckens("run", models / "pendulum.yaml", "-o", "out").must(0)
    assert summary_of(tmp_path / "out")["title"] == "Test pendulum"
    header, values, _ = sensors_of(tmp_path / "out")
    assert "energy [J]" in header and len(values) == 11
    with h5py.File(tmp_path / "out" / "results.h5", "r") as file:
        assert "sensors/bend" not in file and len(file["time"]) == 11


def test_a_model_with_a_mistake_leaves_the_earlier_run(buckens, models, tmp_path):
    buckens("run", models / "pendulum.yaml", "-o", "out").must(0)
    before = (tmp_path / "out" / "summary.json").read_bytes()
    buckens("run", models / "pendulum.yaml", "-o", "out",
            "--set", "bodies.rod.rigid.mass=-1").must(2)
    assert (tmp_path / "out" / "summary.json").read_bytes() == before


def test_a_set_up_that_fails_leaves_the_earlier_run(buckens, models, tmp_path):
    buckens("run", models / "pendulum.yaml", "-o", "out").must(0)
    before = {path.name: path.read_bytes() for path in (tmp_path / "out").iterdir()}
    # The tip cannot be that far out: found when the mechanism is assembled, after OUT was opened.
    model = (models / "pendulum.yaml").read_text().replace(
        "joints:", "joints:\n  far: {fixed: {between: [{ground: [9 m, 0, 0]}, rod/tip]}}")
    (tmp_path / "far.yaml").write_text(model)
    buckens("run", "far.yaml", "-o", "out").must(3, "cannot be assembled", "earlier run in out is as it was")
    assert {path.name: path.read_bytes() for path in (tmp_path / "out").iterdir()} == before
    buckens("static", "far.yaml", "-o", "out").must(3, "earlier run in out is as it was")
    assert {path.name: path.read_bytes() for path in (tmp_path / "out").iterdir()} == before
    # If there is none, the directory contains the reason.
    buckens("run", "far.yaml", "-o", "new").must(3, "cannot be assembled")
    assert "cannot be assembled" in summary_of(tmp_path / "new")["interrupted"]


def test_json_is_the_summary_and_nothing_else(buckens, models, tmp_path):
    result = buckens("run", models / "pendulum.yaml", "-o", "out", "--json").must(0)
    assert result.json == summary_of(tmp_path / "out")
    assert result.err == ""


def test_quiet_says_nothing(buckens, models):
    result = buckens("run", models / "pendulum.yaml", "--quiet").must(0)
    assert result.out == "" and result.err == ""


def test_set_changes_the_run_and_is_recorded(buckens, models, tmp_path):
    buckens("run", models / "pendulum.yaml", "-o", "out", "--set", "simulation.duration=20 ms",
            "--set", "gravity=[0, 0, 0]").must(0)
    assert summary_of(tmp_path / "out")["steps"] == 20
    model = (tmp_path / "out" / "model.yaml").read_text()
    assert "simulation.duration=20 ms" in model and "Test pendulum" in model
    _, values, _ = sensors_of(tmp_path / "out")
    assert numpy.all(values[:, 1] == values[0, 1]), "nothing falls without gravity"


def test_the_pendulum_swings_as_it_should(buckens, models, tmp_path):
    """θ'' = -m g s cos θ / I from θ = 0, s = L/2 = 0.5 m, I = 0.2 + 2*0.25 kg m²; integrated here
    by Runge-Kutta with steps whose error is far below the tolerance."""
    buckens("run", models / "pendulum.yaml", "-o", "out").must(0)

    def slope(y):
        return numpy.array([y[1], -2 * 9.81 * 0.5 * numpy.cos(y[0]) / 0.7])

    y, h = numpy.zeros(2), 1e-4
    for _ in range(1000):
        a = slope(y)
        b = slope(y + h / 2 * a)
        c = slope(y + h / 2 * b)
        d = slope(y + h * c)
        y = y + h / 6 * (a + 2 * b + 2 * c + d)
    _, values, _ = sensors_of(tmp_path / "out")
    # Order 2 with a step of 1 ms: about h² θ''' t² / 12 < 1e-6.
    assert values[-1, 1:3] == pytest.approx([numpy.cos(y[0]), numpy.sin(y[0])], abs=2e-6)


def test_a_step_that_is_too_long_gets_advice(buckens, models, tmp_path):
    result = buckens("run", models / "beam.yaml", "-o", "out",
                     "--set", "simulation.step=10 ms").must(0)
    advice = summary_of(tmp_path / "out")["warnings"]
    assert any("beam" in text and "step of" in text for text in advice), advice
    assert "warning: " + advice[0] in result.err
    buckens("run", models / "beam.yaml", "-o", "fine", "--set", "simulation.step=20 us").must(0)
    assert summary_of(tmp_path / "fine")["warnings"] == []


def test_failure_as_json(buckens, models):
    result = buckens("run", models / "fails_midway.yaml", "-o", "out", "--json").must(4)
    error = result.json["error"]
    assert error["kind"] == "numerical"
    assert "fails_midway.yaml:" in error["message"] and "sqrt(0.05 - t)" in error["message"]


def test_out_of_memory(buckens, models):

    def limit():
        resource.setrlimit(resource.RLIMIT_AS, (1 << 30, 1 << 30))

    options = {"preexec_fn": limit, "env": {**os.environ, "OPENBLAS_NUM_THREADS": "1"}}
    if buckens("version", **options).code != 0:
        pytest.skip("programs with sanitizers need more address space than the limit")
    buckens("run", models / "beam.yaml", "-o", "out", "--set", "bodies.beam.beam.elements=2000000",
            **options).must(4, "memory")


def test_plain_lines_tell_how_far_it_is(start, models, tmp_path):
    process = start("run", models / "endless.yaml", "-o", "out")
    # Where results go, at once; a line comes every five seconds.
    err = process.stderr.readline() + process.stderr.readline()
    process.terminate()
    err += process.communicate(timeout=60)[1]
    line = r"t = \S+ of 1e\+06 s \(\d+ %\), step \d+ of 1000000000, \S+ steps/s, ETA [\d:]+"
    assert re.search(line, err), err
    assert "\r" not in err and "\033" not in err


def test_a_terminal_gets_a_bar(start, models):
    main, terminal = pty.openpty()
    process = start("run", models / "endless.yaml", "-o", "out", stderr=terminal,
                    env={**os.environ, "TERM": "xterm"})
    os.close(terminal)
    time.sleep(2)
    process.terminate()
    process.wait(timeout=60)
    shown = b""
    try:
        while piece := os.read(main, 65536):
            shown += piece
    except OSError:  # how Linux tells the end of a terminal
        pass
    os.close(main)
    bars = re.findall(rb"\[[#.]+\] +\d+ %  t = \S+ of 1e\+06 s  \S+ steps/s  ETA \S+", shown)
    assert len(bars) >= 3, shown
    assert len(bars) <= 25, "redrawn at most ten times a second"


@pytest.mark.parametrize("method", ["generalized-alpha", "newmark"])
def test_both_methods_run(buckens, models, tmp_path, method):
    buckens("run", models / "beam.yaml", "-o", "out",
            "--set", f"simulation.method={method}").must(0)
    beam = summary_of(tmp_path / "out")["bodies"]["beam"]
    assert beam["factorisations"] == 1 and beam["solves"] == 100
