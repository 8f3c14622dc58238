# SPDX-License-Identifier: Apache-2.0
"""A run that was stopped goes on from its checkpoint, and ends as the uninterrupted one, bit for bit."""

import json
import os
import random
import resource
import shutil
import signal
import time

import h5py
import numpy
import pytest

from test_save_state import (BLOCK, CABLES, CONTROL, CLEARANCE, ELBOW, GROUPED, HEAP, LAWS, MESHING, MORE, PAIRS, RIGID, ROUGH,
                             SLIDER_CRANK, model)

# Long enough to be killed on the way (about a second), with a checkpoint every few milliseconds.
FREQUENT = "--set", "simulation.checkpoint=5 ms"
FIELDS = model(BLOCK).replace("duration: 40 ms", "duration: 2.4 s")
CASES = {
    "fields and extremes": FIELDS,
    "step control": model(SLIDER_CRANK, step="tolerance: 1e-2").replace("60 ms", "0.8 s"),
    "friction, stops": model(LAWS).replace("60 ms", "0.8 s"),
    "rigid rows": model(RIGID).replace("60 ms", "0.5 s"),
    "contact": model(CLEARANCE).replace("60 ms", "0.5 s"),
    "surfaces": model(PAIRS).replace("0.24 s", "4 s"),
    "groups": model(GROUPED).replace("0.24 s", "6 s"),
    "heap": model(HEAP).replace("0.3 s", "20 s"),
    "cables": model(CABLES, step="tolerance: 1e-7").replace("0.3 s", "0.8 s"),
    "cams, grips": model(MORE).replace("0.4 s", "4 s"),
    "controllers": model(CONTROL, step="method: newmark").replace("60 ms", "0.8 s"),
    "rigid friction": model(ROUGH).replace("0.6 s", "20 s"),
    "events that attach": model(MESHING).replace("0.4 s", "2 s"),
    "impacts, step control": ELBOW.replace("duration: 2 s", "duration: 20 s"),
}


FAST_CRANK = """buckens: 1
planar: xy
bodies:
  crank: {rigid: {mass: 1 kg, inertia: [0, 0, 0.01 kg m^2]}, markers: {pin: {position: [0.1, 0, 0]}}}
  rod:
    rigid: {mass: 1 kg, com: [0.2, 0, 0], inertia: [0, 0, 0.02]}
    at: {position: [0.1, 0, 0]}
    markers: {a: {position: [0, 0, 0]}, b: {position: [0.4, 0, 0]}}
  slider: {rigid: {mass: 1 kg, inertia: [0, 0, 0.02]}, at: {position: [0.5, 0, 0]}}
joints:
  drive: {prescribed-rotation: {between: [ground, crank], angle: "200*t^2 rad"}}
  shaft: {revolute: {between: [ground, crank]}}
  big_end: {revolute: {between: [crank/pin, rod/a]}}
  small_end: {revolute: {between: [rod/b, slider]}}
  guide: {prismatic: {between: [ground, slider], axis: [1, 0, 0]}}
loads: {spring: {hinge-spring: {joint: big_end, stiffness: 0.1 N m/rad}}}
simulation: {duration: 3 s, step: 1 s}
output: {every: 10 ms, sensors: {x: {position: slider}}}
"""


def datasets(directory):
    """Every number of the results, by path."""
    found = {}
    with h5py.File(directory / "results.h5", "r", swmr=True) as file:
        file.visititems(lambda path, item: found.update({path: item[()]})
                        if isinstance(item, h5py.Dataset) and item.dtype.kind in "fi" else None)
    return found


def check_same(whole, parts):
    assert (parts / "sensors.csv").read_bytes() == (whole / "sensors.csv").read_bytes()
    # Everything on which later steps depend.
    assert (parts / "checkpoint.h5").read_bytes() == (whole / "checkpoint.h5").read_bytes()
    one, other = datasets(whole), datasets(parts)
    assert one.keys() == other.keys()
    for path, values in one.items():
        assert values.tobytes() == other[path].tobytes(), path
    summaries = [json.loads((d / "summary.json").read_text()) for d in (whole, parts)]
    assert [s["status"] for s in summaries] == ["finished", "finished"]
    for key in ("steps", "residuals", "energy_error", "newton_iterations", "trust"):
        assert summaries[0][key] == summaries[1][key], key


def wait_for(path, process, seconds=60):
    deadline = time.monotonic() + seconds
    while not path.exists():
        assert process.poll() is None, process.stderr.read()
        assert time.monotonic() < deadline, f"no {path.name}"
        time.sleep(0.001)


def stop(start, number, delay, out, *arguments):
    """Starts a run and sends it a signal, `delay` seconds after its first checkpoint. @return exit code"""
    before = (out / "checkpoint.h5").stat().st_mtime_ns if (out / "checkpoint.h5").exists() else None
    process = start("run", *arguments, "-q")
    wait_for(out / "checkpoint.h5", process)
    while before and process.poll() is None and (out / "checkpoint.h5").stat().st_mtime_ns == before:
        time.sleep(0.001)
    time.sleep(delay)
    process.send_signal(number)
    process.communicate(timeout=60)
    return process.returncode


def is_finished(out):
    """A run that is killed while the program ends has nothing left to go on with."""
    return json.loads((out / "summary.json").read_text())["status"] == "finished"


@pytest.mark.parametrize("seed", range(int(os.environ.get("BUCKENS_KILLS", "1"))))
@pytest.mark.parametrize("name", CASES)
def test_killed_again_and_again(buckens, start, tmp_path, name, seed):
    (tmp_path / "model.yaml").write_text(CASES[name])
    began = time.monotonic()
    buckens("run", "model.yaml", "-q", "-o", "whole", *FREQUENT).must(0)
    length = time.monotonic() - began
    chance = random.Random(f"{name} {seed}")
    out = tmp_path / "out"
    delay = chance.uniform(0, length / 2)
    while (stop(start, signal.SIGKILL, delay, out, "model.yaml", "-o", "out", *FREQUENT) != -signal.SIGKILL
           or is_finished(out)):
        assert delay > 1e-4
        delay *= 0.5  # it was at its end already
        shutil.rmtree(out)
    # Killed once more while it goes on, then to its end; any number of threads.
    code = stop(start, signal.SIGKILL, chance.uniform(0, length / 4), out, "--continue", "out")
    assert code in (-signal.SIGKILL, 0)
    if not is_finished(out):
        buckens("run", "--continue", "out", "--threads", 2, "-q").must(0)
    check_same(tmp_path / "whole", out)


def test_interrupted_it_goes_on(buckens, start, tmp_path):
    """Also without any checkpoint on the way: Ctrl-C writes one."""
    (tmp_path / "model.yaml").write_text(CASES["friction, stops"])
    buckens("run", "model.yaml", "-q", "-o", "whole").must(0)
    out = tmp_path / "out"
    process = start("run", "model.yaml", "-o", "out", "-q")
    wait_for(out / "sensors.csv", process)
    time.sleep(0.1)
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=60)
    assert process.returncode == 130, err
    stopped = json.loads((out / "summary.json").read_text())
    assert stopped["status"] == "interrupted" and (out / "checkpoint.h5").exists()
    buckens("run", "--continue", "out").must(0, "goes on from", f"t = {stopped['end_time']:.6g} s")
    check_same(tmp_path / "whole", out)


def test_a_full_disk(buckens, tmp_path):
    """Files that cannot grow: the run fails, and goes on once there is room."""
    (tmp_path / "model.yaml").write_text(FIELDS)
    buckens("run", "model.yaml", "-q", "-o", "whole", *FREQUENT).must(0)
    size = (tmp_path / "whole" / "results.h5").stat().st_size

    def limit(bytes):
        return lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (bytes, bytes))

    buckens("run", "model.yaml", "-q", "-o", "out", *FREQUENT, preexec_fn=limit(size // 2)).must(
        5, "results.h5", "File too large")
    out = tmp_path / "out"
    at_failure = (out / "results.h5").read_bytes()
    # No room for a copy: what is there stays as it is.
    buckens("run", "--continue", "out", "-q", preexec_fn=limit(20000)).must(5, "File too large", "is as it was")
    assert (out / "results.h5").read_bytes() == at_failure
    buckens("run", "--continue", "out", "-q").must(0)
    check_same(tmp_path / "whole", out)


def test_another_end(buckens, tmp_path):
    text = CASES["controllers"]
    (tmp_path / "model.yaml").write_text(text)
    duration = "--set", "simulation.duration=0.8 s"
    buckens("run", "model.yaml", "-q", "-o", "whole", *duration).must(0)
    # The end at 0.25 s is no multiple of the 0.7 ms between records: the record there is cut off.
    buckens("run", "model.yaml", "-q", "-o", "out", "--set", "simulation.duration=0.25 s").must(0)
    buckens("run", "--continue", "out", "-q").must(2, "the end of the run", "--until")
    buckens("run", "--continue", "out", "--until", 0.1).must(2, "--until 0.1", "has already reached t = 0.25 s")
    for wrong in ("nan", "inf", "soon", "1 m", "5 mss", ""):
        buckens("run", "--continue", "out", "--until", wrong).must(2, f"--until {wrong}: this is no time", "--until 30ms")
    buckens("run", "--continue", "out", "--until", "500 ms", "-q").must(0)
    buckens("run", "--continue", "out", "--until", 0.8, "-q").must(0)
    one, other = datasets(tmp_path / "whole"), datasets(tmp_path / "out")
    for path, values in one.items():
        assert values.tobytes() == other[path].tobytes(), path
    # The model of the run repeats it.
    buckens("run", "out/model.yaml", "-q", "-o", "again").must(0)
    assert (tmp_path / "again/sensors.csv").read_bytes() == (tmp_path / "out/sensors.csv").read_bytes()


def test_another_end_whose_count_of_steps_rounds(buckens, tmp_path):
    # 0.03 / 600 is not 5e-5 in binary digits, 0.02 / 400 is.
    (tmp_path / "model.yaml").write_text(model(SLIDER_CRANK).replace("step: 0.2 ms", "step: 0.05 ms"))
    buckens("run", "model.yaml", "-q", "-o", "whole", "--set", "simulation.duration=30 ms").must(0)
    buckens("run", "model.yaml", "-q", "-o", "out", "--set", "simulation.duration=20 ms").must(0)
    buckens("run", "--continue", "out", "--until", 0.03, "-q").must(0)
    assert (tmp_path / "whole/sensors.csv").read_bytes() == (tmp_path / "out/sensors.csv").read_bytes()


def test_times_of_records_stay_where_the_model_gives_none(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(model(SLIDER_CRANK).replace("  every: 0.7 ms\n", "").replace(
        "step: 0.2 ms", "step: 0.07 ms"))
    buckens("run", "model.yaml", "-q", "-o", "out").must(0)
    before = datasets(tmp_path / "out")["time"]
    buckens("run", "--continue", "out", "--until", 0.08, "-q").must(0)
    after = datasets(tmp_path / "out")["time"]
    assert numpy.array_equal(after[:len(before)], before)
    assert after[-1] >= 0.08 and numpy.allclose(numpy.diff(after)[:-1], before[1], rtol=1e-9)


def test_a_failed_step_with_other_steps(buckens, models, tmp_path):
    """The law has no value from 0.05 s on: a step across that instant fails, however short."""
    buckens("run", models / "fails_midway.yaml", "-q", "-o", "out").must(4)
    out = tmp_path / "out"
    assert (out / "checkpoint.h5").exists()
    failed = json.loads((out / "summary.json").read_text())
    buckens("run", "--continue", "out", "-q", "--set", "simulation.step=0.3 ms").must(4)
    later = json.loads((out / "summary.json").read_text())
    assert later["end_time"] >= failed["end_time"]
    times = datasets(out)["time"]
    assert numpy.all(numpy.diff(times) > 0)
    # With a law that has values it goes to the end; that is another model, and refused.
    buckens("run", "--continue", "out", "-q", "--set", "loads.motor.torque.value=[0, 0, 1 N m]").must(
        2, "belongs to another model", "loads.motor.torque.value")


def test_a_failed_step_is_rescued_by_another_step(buckens, tmp_path):
    """A crank at 952 rad/s fails with steps of 1 s, also when they are shortened to 1/256: it speeds up by half a turn within each. With 0.5 ms it does not."""
    (tmp_path / "model.yaml").write_text(FAST_CRANK)
    run = buckens("run", "model.yaml", "-q", "-o", "out").must(4, "use a smaller step", "shortened 3 times, down to 0.00391 s")
    out = tmp_path / "out"
    stopped = json.loads((out / "summary.json").read_text())
    assert stopped["status"] == "interrupted" and 2 < stopped["end_time"] < 3, run.err
    before = datasets(out)
    buckens("run", "--continue", "out", "-q", "--set", "simulation.step=0.5 ms").must(0)
    rescued = json.loads((out / "summary.json").read_text())
    assert rescued["status"] == "finished" and rescued["end_time"] == 3
    after = datasets(out)
    # All records before the failure are kept; then the motion is that of the crank, joints closed to rounding.
    kept = len(before["time"]) - 1
    assert numpy.array_equal(after["sensors/x"][:kept], before["sensors/x"][:kept])
    angle = 200 * after["time"][-1]**2
    exact = 0.1 * numpy.cos(angle) + numpy.sqrt(0.4**2 - (0.1 * numpy.sin(angle))**2)
    assert after["time"][-1] == 3 and abs(after["sensors/x"][-1, 0] - exact) < 1e-9
    buckens("run", "--continue", "out", "-q", "--set", "simulation.step=0.2 ms").must(2, "the end of the run", "--until")


def test_other_steps_meet_the_same_motion(buckens, start, tmp_path):
    """Order of the method: a second half with half the step comes closer to the exact motion."""
    text = model(SLIDER_CRANK).replace("motor: {prescribed", "drive: {prescribed")
    (tmp_path / "model.yaml").write_text(text)
    for name, step in (("coarse", "0.2 ms"), ("fine", "0.02 ms")):
        buckens("run", "model.yaml", "-q", "-o", name, "--set", f"simulation.step={step}",
                "--set", "output.every=1 ms").must(0)
    first = "--set", "output.every=1 ms", "--set", "simulation.duration=20 ms"
    for step, tolerance in (("0.1 ms", None), (None, "1e-4")):
        buckens("run", "model.yaml", "-q", "-o", "out", *first).must(0)
        change = f"simulation.step={step}" if step else f"simulation.tolerance={tolerance}"
        buckens("run", "--continue", "out", "-q", "--set", "simulation.duration=60 ms", "--set", change).must(0)
        curves = {name: datasets(tmp_path / name) for name in ("coarse", "fine", "out")}
        t = curves["fine"]["time"]
        assert numpy.allclose(curves["out"]["time"], t, rtol=0, atol=1e-12)
        error = {name: numpy.abs(curves[name]["sensors/moved"] - curves["fine"]["sensors/moved"]).max()
                 for name in ("coarse", "out")}
        # Within that of the coarse run, whose first third it shares.
        assert error["out"] < 1.05 * error["coarse"], error


def test_sampled_signals_keep_their_instants(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(model(CONTROL))
    buckens("run", "model.yaml", "-q", "-o", "out", "--set", "simulation.duration=20 ms").must(0)
    run = "run", "--continue", "out", "-q", "--set", "simulation.duration=60 ms", "--set"
    buckens(*run, "simulation.step=0.15 ms").must(2, 'signal "held"')
    buckens(*run, "simulation.step=0.1 ms").must(0)


def test_what_cannot_go_on_is_refused(buckens, start, models, tmp_path):
    (tmp_path / "model.yaml").write_text(CASES["friction, stops"])
    buckens("run", "--continue", "none").must(5, "none: not a run directory")
    buckens("run", "model.yaml", "-q", "-o", "out", "--set", "simulation.checkpoint=off", "--set",
            "simulation.duration=10 ms").must(0)
    buckens("run", "--continue", "out").must(5, "out: there is no checkpoint", "checkpoint: off")
    short = "--set", "simulation.duration=10 ms"
    buckens("run", "model.yaml", "-q", "-o", "out", *short).must(0)
    out = tmp_path / "out"
    files = {name: (out / name).read_bytes() for name in
             ("results.h5", "sensors.csv", "summary.json", "model.yaml", "checkpoint.h5")}

    def check_untouched():
        for name, content in files.items():
            assert (out / name).read_bytes() == content, name

    go_on = "run", "--continue", "out", "--until", 0.05
    buckens(*go_on, "--set", "bodies.rod.beam.elements=6").must(
        2, "belongs to another model", "bodies.rod.beam.elements was 8, is 6")
    buckens("run", models / "pendulum.yaml", "--continue", "out").must(2, "belongs to another model")
    buckens(*go_on, "-o", "elsewhere").must(2, "--continue and -o")
    buckens(*go_on, "--error").must(2, "--continue and --error")
    buckens(*go_on, "--start-from", "out/checkpoint.h5").must(2, "--continue and --start-from")
    buckens("run", "model.yaml", "--until", 1).must(2, "--until goes with --continue")
    buckens("run").must(2, "MODEL is required")
    check_untouched()
    for place in range(0, len(files["checkpoint.h5"]), len(files["checkpoint.h5"]) // 7):
        damaged = bytearray(files["checkpoint.h5"])
        damaged[place] ^= 1
        (out / "checkpoint.h5").write_bytes(damaged)
        refused = buckens(*go_on).must(5, "checkpoint.h5", "run the model from the start")
        assert "save it again" not in refused.err
    (out / "checkpoint.h5").write_bytes(of_another_version(files["checkpoint.h5"]))
    buckens(*go_on).must(2, "checkpoint.h5: the state was saved by buckens 9.9.9, this is")
    (out / "checkpoint.h5").write_bytes(files["checkpoint.h5"])
    # Results that do not belong to the checkpoint.
    buckens("run", "model.yaml", "-q", "-o", "other", "--set", "simulation.duration=2 ms").must(0)
    (out / "results.h5").write_bytes((tmp_path / "other/results.h5").read_bytes())
    buckens(*go_on).must(5, "results.h5: the record at t = 0.0098 s", "is missing")
    (out / "results.h5").write_bytes(files["results.h5"])
    check_untouched()
    buckens(*go_on, "-q").must(0)


def of_another_version(state):
    """The bytes of a saved state as another version would have written them."""
    from conftest import SOURCE
    version = (SOURCE / "VERSION").read_text().strip().encode()
    content = state[:-80]
    assert content.count(version + b"\0") == 1
    content = content.replace(version + b"\0", b"9.9.9"[:len(version)].ljust(len(version), b"0") + b"\0")
    checksum = 0xcbf29ce484222325
    for byte in content:
        checksum = ((checksum ^ byte) * 0x100000001b3) % 2**64
    trailer = f"\nbuckens state\nformat 1\nbytes {len(content)}\nchecksum {checksum:016x}".encode()
    return content + trailer.ljust(79) + b"\n"


def test_a_sweep_goes_on(buckens, start, tmp_path):
    (tmp_path / "model.yaml").write_text(CASES["controllers"])
    sweep = "sweep", "model.yaml", "--vary", "parameters.speed=[120, 150]", "--together", 2, "-q", *FREQUENT
    buckens(*sweep, "-o", "whole").must(0)
    process = start(*sweep, "-o", "out")
    wait_for(tmp_path / "out" / "002" / "checkpoint.h5", process)
    process.send_signal(signal.SIGKILL)
    process.communicate(timeout=60)
    buckens(*sweep, "-o", "out").must(0)
    for variant in ("001", "002"):
        check_same(tmp_path / "whole" / variant, tmp_path / "out" / variant)
    notes = json.loads((tmp_path / "out" / "002" / "summary.json").read_text())["notes"]
    assert any("goes on from a state" in note for note in notes), notes


LONG = {
    "buckens": 1, "gravity": [0, -9.81, 0],
    "bodies": {"block": {"coupling": "full", "mesh": {
        "box": {"size": [0.1, 0.1, 0.1], "divisions": [12, 12, 12], "element": "hex8"},
        "material": {"E": 2e9, "nu": 0.3, "rho": 7850}}}},
    "joints": {"pin": {"spherical": {"between": ["ground", "block/corner_000"]}}},
    "initial": {"bodies": {"block": {"angular-velocity": [50, 100, 150]}}},
    "simulation": {"duration": 0.002, "step": 1e-4},
    "output": {"every": 2e-4, "sensors": {"tip": {"position": "block/corner_100"}}}}


def test_long_lists_are_read_as_they_are_restored(buckens, start, tmp_path):
    """Displacements and kept solves of 6591 variables stay in the checkpoint until the visit of what is saved asks for them."""
    (tmp_path / "model.json").write_text(json.dumps(LONG))
    buckens("run", "model.json", "-q", "-o", "whole").must(0)
    with h5py.File(tmp_path / "whole/checkpoint.h5", "r") as file:
        assert sum(length == 6591 for length in file["numbers/lengths"][:]) > 20
    buckens("run", "model.json", "-q", "-o", "out", "--set", "simulation.duration=1 ms").must(0)
    out = tmp_path / "out"
    buckens("run", "--continue", "out", "--until", "2 ms", "-q").must(0)
    check_same(tmp_path / "whole", out)
    # The checkpoint is closed once it has been read: the run writes others.
    process = start("run", "--continue", "out", "--until", 100, "-q", *FREQUENT)
    before = (out / "checkpoint.h5").stat().st_ino
    while (out / "checkpoint.h5").stat().st_ino == before:
        assert process.poll() is None, process.stderr.read()
        time.sleep(0.01)
    looks = []
    for _ in range(50):  # a checkpoint that is being written is open, too
        files = []
        for descriptor in os.listdir(f"/proc/{process.pid}/fd"):
            try:
                files.append(os.readlink(f"/proc/{process.pid}/fd/{descriptor}"))
            except OSError:  # closed in the meantime
                pass
        assert any("results.h5" in file or "log" in file for file in files), files
        looks.append([file for file in files if "checkpoint.h5" in file])
        time.sleep(0.01)
    assert [] in looks, looks
    assert process.poll() is None


def test_a_run_in_progress_is_left_alone(buckens, start, models, tmp_path):
    process = start("run", models / "endless.yaml", "-o", "out", "-q", *FREQUENT)
    wait_for(tmp_path / "out" / "checkpoint.h5", process)
    buckens("run", "--continue", "out").must(5, "another run is writing into this directory")
    assert process.poll() is None


def test_a_new_run_leaves_no_checkpoint_of_the_old_one(buckens, models, tmp_path):
    buckens("run", models / "pendulum.yaml", "-q", "-o", "out").must(0)
    buckens("run", models / "pendulum.yaml", "-q", "-o", "out", "--set", "simulation.checkpoint=off").must(0)
    assert not (tmp_path / "out" / "checkpoint.h5").exists()


def test_a_run_of_a_mesh_goes_on_by_itself(buckens, tmp_path):
    """model.yaml of the run says where its mesh lies, which the model that was read had no need to."""
    from conftest import SOURCE
    shutil.copytree(SOURCE / "examples" / "bracket_inp", tmp_path / "bracket")
    changes = "-q", "--set", "simulation.duration=0.2 ms", "--set", "simulation.step=0.1 ms", "--set", "output.every=0.1 ms"
    buckens("run", "bracket/bracket_inp.yaml", "-o", "out", *changes).must(0)
    buckens("run", "--continue", "out", "--until", 4e-4, "-q").must(0)
    buckens("run", "bracket/bracket_inp.yaml", "-o", "whole", *changes, "--set", "simulation.duration=0.4 ms").must(0)
    assert (tmp_path / "out/sensors.csv").read_bytes() == (tmp_path / "whole/sensors.csv").read_bytes()
