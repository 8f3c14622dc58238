# SPDX-License-Identifier: Apache-2.0
"""The Python module, used as a user would: models, runs, results."""

import gc
import json
import math
import os
import pathlib
import signal
import sys
import threading
import time

import numpy as np
import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent / "support"))
from python_module import buckens, source  # noqa: E402 (found after the path is set)

CRANK = source("examples/slider_crank/slider_crank.yaml")
STEEL = {"E": "200 GPa", "nu": 0.3, "rho": "7850 kg/m^3"}


@pytest.fixture
def program(request):
    """The fixture `buckens` of all tests, which calls the program; here that is the module's name."""
    return request.getfixturevalue("buckens")


def falling_rod(**changes):
    """A rigid rod of 1 m and 2 kg that falls from the horizontal about a hinge at its end."""
    tree = {
        "title": "Falling rod", "planar": "xy", "gravity": [0, -9.81, 0],
        "bodies": {"rod": {"rigid": {"mass": 2, "com": [0.5, 0, 0], "inertia": [0, 0, 1 / 6]},
                           "markers": {"pin": {"position": [0, 0, 0]},
                                       "tip": {"position": [1, 0, 0]}}}},
        "joints": {"hinge": {"revolute": {"between": ["ground", "rod/pin"]}}},
        "simulation": {"duration": "0.3 s", "step": 1e-3},
        "output": {"every": "10 ms", "sensors": {"tip": {"position": "rod/tip"},
                                                 "angle": {"joint-coordinate": "hinge"}}},
    }
    return {**tree, **changes}


def cantilever(**changes):
    """A steel beam of 0.5 m, clamped, with a force of 10 N on its end."""
    tree = {
        "planar": "xy", "materials": {"steel": STEEL},
        "bodies": {"beam": {"beam": {"to": [0.5, 0, 0], "elements": 4, "material": "steel",
                                     "section": {"circle": {"diameter": "10 mm"}}}}},
        "joints": {"clamp": {"fixed": {"between": ["ground", "beam/start"]}}},
        "loads": {"push": {"force": {"on": "beam/end", "value": [0, "-10 N", 0]}}},
        "simulation": {"duration": "10 ms", "step": "0.1 ms"},
        "output": {"sensors": {"tip": {"position": "beam/end"}}},
    }
    return {**tree, **changes}


def test_a_file_run_from_python_equals_the_program(program, tmp_path):
    changes = {"simulation.duration": "10 ms", "bodies.rod.beam.elements": 4}
    model = buckens.load(CRANK, set=changes)
    assert repr(model) == "<buckens.Model 'Flexible slider-crank': 3 bodies, 5 joints, 0 loads>"
    sim = buckens.Simulation(model, out=tmp_path / "python")
    summary = sim.run()
    assert summary["status"] == "finished" and summary["steps"] == 200
    program("run", CRANK, "-o", "program", *[word for path, value in changes.items()
                                             for word in ("--set", f"{path}={value}")]).must(0)
    csv = [(tmp_path / kind / "sensors.csv").read_bytes() for kind in ("python", "program")]
    assert csv[0] == csv[1]
    difference = buckens.compare(tmp_path / "program", tmp_path / "python")
    assert difference["largest_relative_difference"] == 0
    # Curves in memory are those of the file.
    run = buckens.open(tmp_path / "python")
    assert {"t", "slider.x", "guide.y", "mid.x", "balance"} <= set(sim.curves)
    assert np.array_equal(sim.curves["slider.x"], run["slider.x"])
    assert sim.curves["slider.x"].unit == "m"
    # The model that was run can be read again.
    again = buckens.Model.from_yaml(model.to_yaml(), directory=os.path.dirname(CRANK))
    assert again.bodies == ["crank", "rod", "slider"]


def test_steps_of_a_dictionary_follow_the_exact_motion():
    model = buckens.Model.from_dict(falling_rod())
    sim = buckens.Simulation(model)
    frame = sim.bodies["rod"].frame
    tip, start = frame.position, frame.position.copy()
    assert sim.advance(0.1) and sim.time == pytest.approx(0.1, abs=1e-12)
    assert tip is frame.position and tip[1] < start[1] - 1e-3  # the view has followed
    while sim.step():
        pass
    assert sim.is_done and sim.num_steps == 300
    # ½ J w² = m g (l/2) sin a with J = m l²/3; the method is of second order, h = 1 ms leaves 1e-6.
    angle = sim.sensors["angle.value"]
    assert sim.value("bodies/rod/angular_velocity")[2] == pytest.approx(
        -math.sqrt(3 * 9.81 * math.sin(-angle)), rel=1e-5)
    assert frame.angular_velocity[2] == sim.value("bodies/rod/angular_velocity")[2]
    assert np.allclose(frame.rotation @ [0.5, 0, 0], frame.position, atol=1e-9)
    assert frame.rotation @ frame.rotation.T == pytest.approx(np.eye(3), abs=1e-12)
    assert set(sim.sensors) == {"tip", "angle.value", "angle.rate"} and sim.quantities["sensors/tip"] == "m"
    assert sim.energies["total"] == pytest.approx(0, abs=1e-4 * 9.81)
    assert sim.multipliers.shape == (2,) and sim.multipliers.any()


def test_views_need_no_copy_and_keep_the_simulation_alive():
    sim = buckens.Simulation(buckens.Model.from_dict(cantilever()))
    shape = sim.bodies["beam"].displacements
    rates = sim.bodies["beam"].velocities
    forces = sim.multipliers
    place = shape.__array_interface__["data"][0]
    assert shape.shape == (5, 6) and not shape.flags.writeable and not shape.flags.owndata
    before = shape.copy()
    sim.advance(5e-3)
    assert shape.__array_interface__["data"][0] == place
    assert sim.bodies["beam"].displacements.__array_interface__["data"][0] == place
    assert not np.array_equal(shape, before) and rates[-1, 1] != 0 and forces.any()
    values = shape.copy()
    del sim
    gc.collect()
    buckens.Simulation(buckens.Model.from_dict(cantilever())).run()  # others use the memory that is free
    assert np.array_equal(shape, values)
    with pytest.raises(ValueError, match="read-only"):
        shape[0, 0] = 1


def test_the_state_is_saved_and_resumed_bit_for_bit(tmp_path):
    model = buckens.Model.from_dict(cantilever())
    whole = buckens.Simulation(model)
    whole.advance(4e-3)
    whole.save(tmp_path / "half.h5")
    whole.run()
    rest = buckens.Simulation.resume(tmp_path / "half.h5", model, out=tmp_path / "rest")
    assert rest.time == pytest.approx(4e-3, abs=1e-12)
    rest.run()
    assert np.array_equal(rest.bodies["beam"].displacements, whole.bodies["beam"].displacements)
    assert rest.energies["total"] == whole.energies["total"]
    other = buckens.Model.from_dict(cantilever(gravity=[0, -9.81, 0]))
    with pytest.raises(buckens.InputError, match="gravity|model|differ"):
        buckens.Simulation.resume(tmp_path / "half.h5", other)


def test_loads_are_set_between_steps():
    """A controller as in examples/cpp: a mass on a guide is pushed with F = -k x - c v."""
    tree = {
        "bodies": {"cart": {"rigid": {"mass": 2, "inertia": [1, 1, 1]}}},
        "joints": {"guide": {"prismatic": {"between": ["ground", "cart"], "axis": [1, 0, 0]}}},
        "loads": {"drive": {"force": {"on": "cart", "value": [0, 0, 0]}}},
        "initial": {"joints": {"guide": {"velocity": "1 m/s"}}},
        "simulation": {"duration": 1, "step": 1e-4},
    }
    sim = buckens.Simulation(buckens.Model.from_dict(tree), record=False)
    cart = sim.bodies["cart"].frame
    assert cart.velocity[0] == pytest.approx(1)

    @sim.on_step
    def control(now):
        now.set_load("drive", [-200 * cart.position[0], 0, 0])

    sim.run()
    # x = sin(w t)/w with w = 10. What is measured at the end of a step is held over the next one: a mean
    # delay of h/2, which is a damping of -k h/2 and lets the amplitude grow by e^(w^2 h t/4); what
    # remains is of second order in w h = 1e-3.
    exact = math.sin(10) / 10 * math.exp(100 * 1e-4 / 4)
    assert cart.position[0] == pytest.approx(exact, rel=1e-4)
    assert sim.curves == {}


def test_a_force_in_python_equals_the_spring_of_the_library():
    """A spring of no free length pulls by -k (x - x0) in all directions, as a load or as a function."""
    k, anchor = 4e5, np.array([2.0, 0, 0])
    spring = {"spring-damper": {"between": [{"ground": list(anchor)}, "rod/tip"], "stiffness": k,
                                "length": 0}}
    library = buckens.Simulation(buckens.Model.from_dict(falling_rod(loads={"spring": spring})))
    expected = library.run()
    model = buckens.Model.from_dict(falling_rod())
    ends = []

    @model.force("rod/tip")
    def pull(t, x, v):
        ends.append(t)
        return k * (anchor - x)

    sim = buckens.Simulation(model)
    summary = sim.run()
    # The step's iteration ends at relative changes of about 1e-10, over 300 steps.
    assert sim.sensors["angle.value"] == pytest.approx(library.sensors["angle.value"], abs=1e-8)
    assert ends and max(ends) <= 0.3 + 1e-9
    # At k h^2/m = 0.1 the iteration would need many more without derivatives.
    assert summary["newton_iterations"]["total"] <= 1.5 * expected["newton_iterations"]["total"]
    # The same as a decorator of the simulation, with a list and under a name of its own.
    own = buckens.Simulation(buckens.Model.from_dict(falling_rod()))

    @own.force("rod/tip", name="own")
    def pull_back(t, x, v):
        return [k * (2 - x[0]), -k * x[1], -k * x[2]]

    own.run()
    assert own.sensors["angle.value"] == pytest.approx(sim.sensors["angle.value"], abs=1e-9)


def test_a_damping_force_in_python_slows_a_fall_as_computed():
    """Fall with F = -c v from rest: v = -(m g/c)(1 - e^(-c t/m)); h = 1 ms leaves 1e-7."""
    tree = {"gravity": [0, 0, -9.81], "bodies": {"ball": {"rigid": {"mass": 2, "inertia": [1, 1, 1]}}},
            "simulation": {"duration": 1, "step": 1e-3}}
    model = buckens.Model(**tree)

    @model.force("ball")
    def drag(t, x, v):
        return tuple(-3 * v)

    sim = buckens.Simulation(model)
    sim.run()
    exact = -(2 * 9.81 / 3) * (1 - math.exp(-1.5))
    assert sim.bodies["ball"].frame.velocity[2] == pytest.approx(exact, rel=1e-6)


def test_exceptions_of_functions_come_out_unchanged(tmp_path):
    class Mine(Exception):
        pass

    thrown = Mine("no more")
    sim = buckens.Simulation(buckens.Model.from_dict(falling_rod()), out=tmp_path / "out")

    @sim.force("rod/tip")
    def fail(t, x, v):
        if t > 0.1:
            raise thrown
        return (0, 0, 0)

    with pytest.raises(Mine) as caught:
        sim.run()
    assert caught.value is thrown
    run = buckens.open(tmp_path / "out")
    assert run.status == "interrupted" and "no more" in run.summary["interrupted"]
    assert 0.08 < run.time[-1] <= 0.1 + 1e-9 and len(run["tip"]) == len(run.time)

    stepped = buckens.Simulation(buckens.Model.from_dict(falling_rod()))

    @stepped.on_step
    def end(now):
        if now.num_steps == 5:
            raise thrown

    with pytest.raises(Mine):
        stepped.advance(0.2)
    assert stepped.num_steps == 5
    assert stepped.step() and stepped.num_steps == 6  # goes on after it


def test_ctrl_c_ends_a_run_after_a_step(tmp_path, heed_ctrl_c):
    model = buckens.Model.from_dict(falling_rod(simulation={"duration": 1e4, "step": 1e-3}))
    sim = buckens.Simulation(model, out=tmp_path / "out")
    threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
    before = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        sim.run()
    assert time.monotonic() - before < 60  # the whole run takes minutes
    run = buckens.open(tmp_path / "out")
    assert run.status == "interrupted" and 0 < run.summary["end_time"] < 1e4
    assert json.loads((tmp_path / "out" / "summary.json").read_text())["steps"] == sim.num_steps


def test_progress_is_called_and_other_threads_run():
    model = buckens.Model.from_dict(falling_rod(simulation={"duration": 20, "step": 1e-4}))
    sim = buckens.Simulation(model, record=False)
    calls, counted = [], []
    done = threading.Event()

    def count():
        while not done.is_set():
            counted.append(None)
            time.sleep(1e-3)
            try:
                sim.bodies["rod"].frame
            except buckens.InputError as error:
                assert "within a step" in str(error)

    thread = threading.Thread(target=count)
    thread.start()
    sim.run(progress=lambda t, end, steps: calls.append((t, end, steps)))
    done.set()
    thread.join()
    assert calls[-1] == (sim.end_time, 20.0, sim.num_steps)
    assert len(counted) > 10  # Python's lock was released
