# SPDX-License-Identifier: Apache-2.0
"""Runs of Python that were killed or stopped go on from their checkpoint, and end as the uninterrupted ones, bit for bit."""

import json
import os
import pathlib
import random
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent / "support"))
from python_module import PACKAGES, buckens  # noqa: E402 (found after the path is set)
from test_continue import CASES, check_same, datasets, wait_for  # noqa: E402

ENVIRONMENT = {**os.environ, "PYTHONPATH": str(PACKAGES), "PYTHONDONTWRITEBYTECODE": "1"}


@pytest.fixture
def program(request):
    """The fixture `buckens` of all tests, which calls the program; here that is the module's name."""
    return request.getfixturevalue("buckens")


# A pendulum with a motor: a force, a signal and a load by functions of Python.
STEERED = """
import os, sys
import buckens

model = buckens.Model.from_dict({
    "title": "Steered", "planar": "xy", "gravity": [0, -9.81, 0],
    "bodies": {"arm": {"rigid": {"mass": 2, "com": [0.5, 0, 0], "inertia": [0, 0, 0.2]},
                       "markers": {"pin": {"position": [0, 0, 0]}, "tip": {"position": [1, 0, 0]}}}},
    "joints": {"shaft": {"revolute": {"between": ["ground", "arm/pin"]}}},
    "signals": {"angle": {"joint-angle": "shaft"}, "speed": {"joint-speed": "shaft"}, "command": {"setting": 0}},
    "loads": {"motor": {"hinge-motor": {"joint": "shaft", "torque": "command"}},
              "push": {"force": {"on": "arm/tip", "value": [0, 0, 0]}}},
    "simulation": {"duration": float(sys.argv[2]), "step": "1 ms", "checkpoint": "5 ms"},
    "output": {"every": "7 ms", "sensors": {"tip": {"position": "arm/tip"}, "angle": {"joint-coordinate": "shaft"}}}})


@model.signal()
def command(t, angle, speed):
    return -15 * angle - 1.5 * speed


@model.force("arm/tip")
def drag(t, x, v):
    return -0.3 * v


sim = buckens.Simulation.resume(sys.argv[1], model) if "resume" in sys.argv else buckens.Simulation(model, out=sys.argv[1])


@sim.on_step
def gusts(now):
    now.set_load("push", [0, 3 if int(now.time * 10) % 2 else -2, 0])


if "loop" in sys.argv:
    while sim.step():
        pass
else:
    sim.run()
"""

PLAIN = """
import sys
import buckens

sim = buckens.Simulation(buckens.load(sys.argv[2], set={"simulation.checkpoint": "5 ms"}), out=sys.argv[1])
sim.run()
"""


def python(text, *arguments):
    return subprocess.Popen([sys.executable, "-c", text, *map(str, arguments)], env=ENVIRONMENT, stdin=subprocess.DEVNULL,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def finish(process):
    out, err = process.communicate(timeout=300)
    assert process.returncode == 0, err
    return out


def kill(process, out, delay):
    """SIGKILL some time after the next checkpoint. @return whether it was still running"""
    before = (out / "checkpoint.h5").stat().st_mtime_ns if (out / "checkpoint.h5").exists() else None
    wait_for(out / "checkpoint.h5", process)
    while before and process.poll() is None and (out / "checkpoint.h5").stat().st_mtime_ns == before:
        time.sleep(0.001)
    time.sleep(delay)
    process.kill()
    process.communicate(timeout=60)
    return process.returncode == -signal.SIGKILL and status_of(out) == "running"


def status_of(out):
    return json.loads((out / "summary.json").read_text())["status"]


@pytest.mark.parametrize("seed", range(int(os.environ.get("BUCKENS_KILLS", "1"))))
@pytest.mark.parametrize("how", ["run", "loop"])
def test_a_steered_run_is_killed_again_and_again(program, tmp_path, how, seed):
    chance = random.Random(f"steered {how} {seed}")
    whole, out = tmp_path / "whole", tmp_path / "out"
    finish(python(STEERED, whole, 4, how))
    kills = kill(python(STEERED, out, 4, how), out, chance.uniform(0, 0.05))
    for _ in range(2):
        if status_of(out) == "running":
            kills += kill(python(STEERED, out, 4, how, "resume"), out, chance.uniform(0, 0.05))
    assert kills >= 1
    # The program does not have the functions, and says so.
    refused = program("run", "--continue", out).must(2, f'buckens.Simulation.resume("{out}", model)')
    assert "Python" in refused.err
    with pytest.raises(buckens.InputError, match="Simulation.resume"):
        buckens.continue_run(out)
    if status_of(out) == "running":
        finish(python(STEERED, out, 4, how, "resume"))
    check_same(whole, out)


@pytest.mark.parametrize("name", ["fields and extremes", "friction, stops"])
def test_the_program_goes_on_with_a_run_that_only_python_watched(program, tmp_path, name):
    (tmp_path / "model.yaml").write_text(CASES[name])
    program("run", "model.yaml", "-q", "-o", "whole", "--set", "simulation.checkpoint=5 ms").must(0)
    out = tmp_path / "out"
    assert kill(python(PLAIN, out, tmp_path / "model.yaml"), out, 0.05)
    program("run", "--continue", "out", "-q").must(0)
    check_same(tmp_path / "whole", out)


def test_ctrl_c_leaves_a_checkpoint(tmp_path, heed_ctrl_c):
    # It takes a second or more.
    model = buckens.Model.from_yaml(CASES["friction, stops"].replace("0.8 s", "3 s"))
    whole = buckens.Simulation(model, out=tmp_path / "whole")
    whole.run()
    sim = buckens.Simulation(model, out=tmp_path / "out")
    threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        sim.run()
    assert status_of(tmp_path / "out") == "interrupted" and 0 < sim.time < whole.end_time
    rest = buckens.Simulation.resume(tmp_path / "out")
    assert rest.time == sim.time and rest.num_steps == sim.num_steps
    rest.run()
    check_same(tmp_path / "whole", tmp_path / "out")


def test_a_loop_that_was_left_goes_on(tmp_path):
    model = buckens.Model.from_yaml(CASES["friction, stops"].replace("0.8 s", "0.1 s"))
    buckens.Simulation(model, out=tmp_path / "whole").run()
    sim = buckens.Simulation(model.with_changes({"simulation.checkpoint": "1 us"}), out=tmp_path / "out")
    for _ in range(100):
        sim.step()
    with pytest.raises(buckens.IoError, match="another run is writing"):
        buckens.Simulation.resume(tmp_path / "out")
    del sim  # without finish()
    assert status_of(tmp_path / "out") == "interrupted"
    rest = buckens.Simulation.resume(tmp_path / "out", model)
    assert rest.num_steps == 100
    rest.run()
    check_same(tmp_path / "whole", tmp_path / "out")


def test_another_end(tmp_path):
    # Step and times of records follow from the duration unless the model has them.
    text = CASES["friction, stops"].replace("  every: 0.7 ms\n", "")
    model = buckens.Model.from_yaml(text).with_changes({"simulation.duration": "20 ms"})
    buckens.Simulation(model, out=tmp_path / "out").run()
    before = datasets(tmp_path / "out")
    with pytest.raises(buckens.InputError, match="has reached its end, t = 0.02 s.*until="):
        buckens.Simulation.resume(tmp_path / "out")
    with pytest.raises(buckens.InputError, match="until: 0.01 s is over, the run has reached t = 0.02 s"):
        buckens.Simulation.resume(tmp_path / "out", until="10 ms")
    sim = buckens.Simulation.resume(tmp_path / "out", until="30 ms")
    assert sim.end_time == 0.03
    sim.run()
    after = datasets(tmp_path / "out")
    rows = len(before["time"])
    assert np.array_equal(after["time"][:rows], before["time"]) and after["time"][-1] == pytest.approx(0.03, rel=1e-12)
    assert np.allclose(np.diff(after["time"])[:-1], before["time"][1], rtol=1e-9)
    long = buckens.Simulation(model.with_changes({"simulation.duration": "30 ms"}))
    long.run()
    assert np.array_equal(long.bodies["rod"].displacements, sim.bodies["rod"].displacements)


def test_a_failed_step_goes_on_with_another_step(models, tmp_path):
    """The law has no value from 0.05 s on: a step across that instant fails, however short."""
    model = buckens.load(models / "fails_midway.yaml")
    with pytest.raises(buckens.NumericalError):
        buckens.Simulation(model, out=tmp_path / "out").run()
    before = datasets(tmp_path / "out")
    with pytest.raises(buckens.NumericalError):
        buckens.Simulation.resume(tmp_path / "out", model.with_changes({"simulation.step": "0.3 ms"})).run()
    after = datasets(tmp_path / "out")
    kept = len(before["time"]) - 1  # the last may be the end of the run between two that were due
    assert np.array_equal(after["time"][:kept], before["time"][:kept]) and np.all(np.diff(after["time"]) > 0)


def test_what_cannot_go_on_is_refused(tmp_path):
    text = CASES["friction, stops"].replace("0.8 s", "10 ms")
    model = buckens.Model.from_yaml(text)
    out = tmp_path / "out"
    with pytest.raises(buckens.IoError, match="not a run directory"):
        buckens.Simulation.resume(tmp_path)
    buckens.Simulation(model.with_changes({"simulation.checkpoint": "off"}), out=out).run()
    assert not (out / "checkpoint.h5").exists()
    with pytest.raises(buckens.IoError, match="out: there is no checkpoint.*checkpoint: off"):
        buckens.Simulation.resume(out, until=0.02)
    sim = buckens.Simulation(model, out=out)
    sim.run()
    sim.save(tmp_path / "state.h5")
    with pytest.raises(buckens.InputError, match="state.h5 holds a state only; give the model"):
        buckens.Simulation.resume(tmp_path / "state.h5")
    files = {path.name: path.read_bytes() for path in out.iterdir()}
    with pytest.raises(buckens.InputError, match="belongs to another model: bodies.rod.beam.elements was 8, is 6"):
        buckens.Simulation.resume(out, model.with_changes({"bodies.rod.beam.elements": 6}), until=0.02)
    other = buckens.Model.from_yaml(text)
    other.force("rod/mid")(lambda t, x, v: (0, 0, 0))
    with pytest.raises(buckens.InputError, match="belongs to another model: load <lambda>|load .*was missing, is"):
        buckens.Simulation.resume(out, other, until=0.02)
    for name, content in files.items():
        assert (out / name).read_bytes() == content, name


def test_a_run_of_arrays_goes_on(program, tmp_path):
    """Also when nothing is left of the arrays but what the directory holds."""
    corners = np.array([[x, y, z] for z in (0, 0.01) for y in (0, 0.02) for x in (0, 0.1)])
    block = buckens.ArrayMesh(corners, {"hexahedron": [[0, 1, 3, 2, 4, 5, 7, 6]]}, faces={"root": [[0, 2, 6, 4]]})
    model = buckens.Model(
        materials={"steel": buckens.Material(E="200 GPa", nu=0.3, rho=7850)}, gravity=[0, 0, -9.81],
        bodies={"bar": buckens.Mesh(file=block, material="steel", interfaces={"root": {"face": "root"}})},
        joints={"clamp": buckens.Fixed(between=["ground", "bar/root"])}, simulation={"duration": "1 ms", "step": "10 us"})
    buckens.Simulation(model, out=tmp_path / "whole").run()
    for given in (model, None):
        sim = buckens.Simulation(model, out=tmp_path / "out")
        sim.advance(0.4e-3)
        sim.finish()
        rest = buckens.Simulation.resume(tmp_path / "out", given)
        rest.run()
        one, other = datasets(tmp_path / "whole"), datasets(tmp_path / "out")
        for path, values in one.items():
            assert values.tobytes() == other[path].tobytes(), path
    del model, given, sim, rest
    program("run", "out/model.yaml", "-q", "-o", "again").must(0)
    assert (tmp_path / "again" / "sensors.csv").read_bytes() == (tmp_path / "out" / "sensors.csv").read_bytes()
    assert buckens.continue_run(tmp_path / "out", until=2e-3)["steps"] == 200
