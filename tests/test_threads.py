# SPDX-License-Identifier: Apache-2.0
"""The program starts no unrequested threads."""

import json
import os
import pathlib
import time

import h5py
import numpy as np
import pytest

DOOR = """\
buckens: 1
title: Door on two hinges
gravity: [0, 0, -9.81]
bodies:
  door:
    rigid: {mass: 20 kg, com: [0.4 m, 0, 1 m], inertia: [6.7 kg m^2, 7.8 kg m^2, 1.1 kg m^2]}
    markers: {lower: {position: [0, 0, 0.3 m]}, upper: {position: [0, 0, 1.7 m]}}
joints:
  lower_hinge: {revolute: {between: [{ground: [0, 0, 0.3 m]}, door/lower], axis: [0, 0, 1]}}
  upper_hinge: {revolute: {between: [{ground: [0, 0, 1.7 m]}, door/upper], axis: [0, 0, 1]}}
initial: {bodies: {door: {angular-velocity: [0, 0, 1], velocity: [0, 0.4 m/s, 0]}}}
simulation: {duration: 4 s, step: 1 ms}
output: {every: 2 ms, sensors: {lower: {joint-force: lower_hinge}}}
"""

BLOCK = """\
buckens: 1
title: A block that swings
gravity: [0, -9.81, 0]
materials: {steel: {E: 2.1e11 Pa, nu: 0.3, rho: 7850 kg/m^3}}
bodies:
  block:
    mesh:
      box: {from: [0, -50 mm, -50 mm], size: [1 m, 0.1 m, 0.1 m], divisions: [24, 6, 6], element: hex8}
      material: steel
    interfaces: {bearing: {face: x0}}
joints: {ball: {spherical: {between: [ground, block/bearing]}}}
simulation: {duration: 10 ms, step: 0.1 ms}
"""


def threads_of(process):
    """Largest number of threads seen until the process ends. Those of OpenMP and BLAS stay until then."""
    status = pathlib.Path(f"/proc/{process.pid}/status")
    most = 0
    while process.poll() is None:
        try:
            lines = status.read_text().splitlines()
        except OSError:
            break
        most = max([most, *(int(line.split()[1]) for line in lines if line.startswith("Threads:"))])
        time.sleep(1e-3)
    return most


@pytest.mark.parametrize("model", [DOOR, BLOCK], ids=["redundant_joints", "solid"])
@pytest.mark.parametrize("arguments", [["run", "-q", "-o", "out"],
                                       ["run", "-q", "-o", "out", "--threads", "1"],
                                       ["check"], ["modes", "--system"]], ids=" ".join)
def test_one_thread_unless_asked(start, tmp_path, model, arguments):
    (tmp_path / "model.yaml").write_text(model)
    environment = {**os.environ, "OMP_NUM_THREADS": "4", "OPENBLAS_NUM_THREADS": "4"}
    process = start(arguments[0], "model.yaml", *arguments[1:], env=environment)
    most = threads_of(process)
    _, err = process.communicate(timeout=60)
    assert process.returncode == 0, err
    # Pending results are written once a second: the recorder of a run has its own timer thread.
    assert most == (2 if arguments[0] == "run" else 1)


FIELDS = BLOCK.replace("10 ms, step", "2 ms, step").replace("title: A block", "title: Fields of a block") + (
    "output: {every: 0.5 ms, fields: {every: 0.5 ms, record: [displacement, velocity, stress, strain, von-mises, "
    "principal-stress, strain-energy-density]}}\n")


def test_records_are_the_same_by_threads(buckens, tmp_path):
    """Energies, stresses and fields of a body that is large enough for threads to share its records."""
    (tmp_path / "model.yaml").write_text(FIELDS)
    results = []
    for threads in ("1", "2", "3"):
        buckens("run", "model.yaml", "-q", "-o", threads, "--threads", threads)
        with h5py.File(tmp_path / threads / "results.h5") as file:
            values = {}
            file.visititems(lambda name, found: values.update({name: found[()]}) if isinstance(found, h5py.Dataset) else None)
        results.append(values)
        assert any("principal" in name for name in values) and any("solid_stress" in name for name in values)
        summary = json.loads((tmp_path / threads / "summary.json").read_text())
        results[-1]["measures"] = np.array(json.dumps(summary["bodies"]))
    for other in results[1:]:
        assert other.keys() == results[0].keys()
        for name, values in results[0].items():
            assert np.array_equal(values, other[name], equal_nan=values.dtype.kind == "f"), name


def test_threads_that_were_asked_for(start, tmp_path):
    (tmp_path / "model.yaml").write_text(BLOCK.replace("10 ms", "20 ms"))
    process = start("run", "model.yaml", "-q", "-o", "out", "--threads", "3")
    assert threads_of(process) == 3 + 1  # the clock of the recorder
    assert process.wait(timeout=60) == 0
