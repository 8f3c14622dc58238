# SPDX-License-Identifier: Apache-2.0
"""Long use of the Python module: memory does not grow, and arrays outlive what they came from."""

import gc
import pathlib
import sys

import numpy as np
import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent / "support"))
from python_module import buckens  # noqa: E402 (found after the path is set)

if not pathlib.Path("/proc/self/status").exists():
    pytest.skip("memory in use is read from /proc", allow_module_level=True)


def resident():
    """Memory in use [kB]."""
    gc.collect()
    lines = pathlib.Path("/proc/self/status").read_text().splitlines()
    return next(int(line.split()[1]) for line in lines if line.startswith("VmRSS"))


def ball(steps, **others):
    return buckens.Model.from_dict({
        "gravity": [0, 0, -9.81], "bodies": {"ball": {"rigid": {"mass": 1, "inertia": [1, 1, 1]}}},
        "loads": {"push": {"force": {"on": "ball", "value": [0, 0, 0]}}},
        "simulation": {"duration": steps * 1e-4, "step": 1e-4},
        "output": {"every": steps * 1e-4, "sensors": {"place": {"position": "ball"}}}, **others})


def test_steps_do_not_grow():
    """With everything that a step of a user does: a force function, a callback, a load, sensors, views."""
    model = ball(20_000)
    calls = []

    @model.force("ball")
    def drag(t, x, v):
        return -0.1 * v

    sim = buckens.Simulation(model)

    @sim.on_step
    def look(now):
        calls[:] = [now.sensors["place"]]

    before = 0
    while sim.step():
        if sim.num_steps == 4000:
            before = resident()
        sim.set_load("push", [0, 0, 1e-3 * float(sim.bodies["ball"].frame.position[2])])
    # One object of Python lost per step, some 50 bytes, would be 800 kB in the remaining 16 000 steps.
    assert resident() - before < 400


def test_a_million_steps_do_not_grow():
    sim = buckens.Simulation(ball(1_010_000), record=False)
    place = sim.bodies["ball"].frame.position
    for _ in range(10_000):
        sim.step()
    before = resident()
    lowest = 0.0
    for _ in range(1_000_000):
        sim.step()
        lowest = min(lowest, place[2])
    # A single byte lost per step would be 1 MB.
    assert resident() - before < 500 and sim.num_steps == 1_010_000
    # It falls freely; accelerations are constant, which the method integrates exactly, but for the rounding of a million sums.
    assert lowest == place[2] == pytest.approx(-0.5 * 9.81 * sim.time**2, rel=1e-9)


def test_simulations_are_freed():
    model = buckens.Model.from_dict({
        "materials": {"steel": {"E": "200 GPa", "nu": 0.3, "rho": 7850}},
        "bodies": {"rod": {"beam": {"to": [1, 0, 0], "elements": 200, "material": "steel",
                                    "section": {"circle": {"diameter": 0.01}}}}},
        "simulation": {"duration": 1, "step": 1e-3}})
    sim = buckens.Simulation(model)
    sim.step()
    size = sim.bodies["rod"].displacements.nbytes
    del sim
    before = 0
    for count in range(60):
        sim = buckens.Simulation(model)
        sim.step()
        sim.on_step(lambda now: None)
        view = sim.bodies["rod"].velocities
        del sim, view
        if count == 9:
            before = resident()
    # Each holds its nodal variables some dozens of times over, in the state, the factor and its right-hand sides.
    assert resident() - before < 50 * 10 * size / 1024


def test_arrays_outlive_simulation_and_body():
    sim = buckens.Simulation(ball(10))
    position = sim.bodies["ball"].frame.position
    sensor = sim.sensors["place"]
    sim.run()
    with pytest.raises(ValueError, match="read-only"):
        position[2] = 0  # after the end as before
    end = sim.sensors["place"]
    del sim
    gc.collect()
    assert position[2] == end[2] != sensor[2]
    # Exact: gravity alone over 1 ms.
    assert position[2] == pytest.approx(-0.5 * 9.81 * 1e-6, rel=1e-9)
    assert np.array_equal(sensor, [0, 0, 0])
