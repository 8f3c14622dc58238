# SPDX-License-Identifier: Apache-2.0
"""Runs over several processes (mpirun): results of one process, one error message, no hang.

Without the plug-in (build option BUCKENS_MPI) or without mpirun only the message of that is tested.
"""

import concurrent.futures
import json
import os
import pathlib
import signal
import subprocess
import time

import h5py
import numpy
import pytest

from conftest import MODELS, PROGRAM
from models_of_many_variables import CUBE, DECK, SHELLS, TWINS, cube, deck_with_links, grid_of_beams, linked_grid, shells
from mpi_runs import (ENVIRONMENT, MPIRUN, expect_same_displacements, expect_same_energies, expect_same_stresses, mpirun, must,  # noqa: F401
                      several, sets)
from test_solver import ITERATE, largest_difference, missing, sensors

BLOCKS = MODELS / "large_block.yaml"
MUMPS = "{petsc: \"-ksp_type preonly -pc_type cholesky -pc_factor_mat_solver_type mumps\"}"
DISTRIBUTED = ("--set", f"bodies.block.solver={MUMPS}", "--set", f"bodies.arm.solver={MUMPS}")

PULL = "loads: {pull: {force: {on: cube/corner_111, value: [0, 0, 1 kN]}}}\n"

TET10 = sets("bodies.block.mesh.box.element=tet10", "simulation.duration=20 ms")

LARGE = {
    "tet10": ("bodies.cube.mesh.box={size: [0.1, 0.1, 0.1], divisions: [5, 5, 5], element: tet10}",),
    "damped": ("materials.steel.damping={mass: 20, stiffness: 0.01 ms}", "bodies.cube.coupling=first-order"),
    "iterative": ("bodies.cube.solver=iterative",),
    "rigid interface": ("bodies.cube.interfaces.bearing.kind=rigid",),
    # C is no sum of M and K: each step multiplies by C, too.
    "held damping": ("bodies.cube.interfaces.bearing.kind=rigid", "materials.steel.damping={ratio: 2 %, at: [100 Hz, 20 kHz]}"),
    # Corrections of positions change what the strain answers; the equations hold beyond the end of the step.
    "newmark": ("simulation.method=newmark",),
    "wilson": ("simulation.method=wilson",),
    # Each length of step has a factor of its own, of M and K that stay where they are.
    "steps of its own": ("simulation.step=8 us", "simulation.tolerance=1e-4", "simulation.duration=0.1 ms", "output.every=0.05 ms"),
}


RIGID_EDGE = sets("bodies.plate.interfaces.edge.kind=rigid", "materials.steel.damping={mass: 20, stiffness: 0.01 ms}")
COUPLINGS = ("full", "first-order", "none")
# Runs of one process with which others are compared: verb, model or its text, arguments.
ALONE = {
    "cube": ("run", CUBE, ()),
    "3 ms": ("run", CUBE, sets("simulation.duration=3 ms")),
    **{level: ("run", BLOCKS, sets(f"bodies.block.coupling={level}", f"bodies.arm.coupling={level}")) for level in COUPLINGS},
    "block of tet10": ("run", BLOCKS, TET10),
    **{f"large {name}": ("run", CUBE, sets(*changes)) for name, changes in LARGE.items()},
    "twins": ("run", TWINS, ()),
    "shells": ("run", SHELLS, ()),
    "shells with a rigid edge": ("run", SHELLS, RIGID_EDGE),
    "beams": ("run", grid_of_beams(), ()),
    "links": ("run", linked_grid(), ()),
    "links of a deck": ("run", {"model.yaml": DECK, "cube.bdf": deck_with_links()}, ()),
    "static": ("static", CUBE.replace("{spherical:", "{fixed:") + PULL, ()),
}


def write(place, model):
    """A model given by its text, or by files one of which is the model."""
    for name, text in ({"model.yaml": model} if isinstance(model, str) else model).items():
        (place / name).write_text(text)


@pytest.fixture(scope="module")
def alone(tmp_path_factory):
    """Directories of the runs of one process, by their names. All are made at the start, two at a time, since this file has both
    processors for itself."""

    def make(place, verb, model, arguments):
        if not isinstance(model, pathlib.Path):
            write(place, model)
            model = "model.yaml"
        subprocess.run([PROGRAM, verb, model, "-q", "-o", "one", *arguments], cwd=place, check=True, timeout=240, stdin=subprocess.DEVNULL)
        return place / "one"

    with concurrent.futures.ThreadPoolExecutor(2) as threads:
        made = {name: threads.submit(make, tmp_path_factory.mktemp("alone"), *what) for name, what in ALONE.items()}
    return lambda name: made[name].result()


@several
@pytest.mark.parametrize("count", [2, 3, 4])
def test_a_large_body_is_distributed(alone, mpirun, tmp_path, count):
    (tmp_path / "cube.yaml").write_text(CUBE)
    must(mpirun(count, "run", "cube.yaml", "-o", "several"))
    assert largest_difference(sensors(tmp_path / "several"), sensors(alone("cube"))) < 1e-9
    expect_same_displacements(tmp_path / "several", alone("cube"))
    expect_same_energies(tmp_path / "several", alone("cube"))
    expect_same_stresses(tmp_path / "several", alone("cube"))
    with h5py.File(alone("cube") / "results.h5") as one, h5py.File(tmp_path / "several" / "results.h5") as several_:
        names = []
        one.visit(names.append)
        others = []
        several_.visit(others.append)
        assert names == others


@several
@pytest.mark.parametrize("coupling", COUPLINGS)
@pytest.mark.parametrize("options", [DISTRIBUTED, ITERATE])
def test_results_are_those_of_one_process(alone, mpirun, tmp_path, coupling, options):
    _, model, couple = ALONE[coupling]
    must(mpirun(2, "run", model, "-o", "two", *couple, *options))
    limit = 1e-9 if options is DISTRIBUTED else 1e-8
    assert largest_difference(sensors(tmp_path / "two"), sensors(alone(coupling))) < limit


@several
def test_a_block_of_other_elements(alone, mpirun, tmp_path):
    must(mpirun(2, "run", BLOCKS, "-o", "two", *TET10, *DISTRIBUTED[:2]))
    assert json.loads((tmp_path / "two" / "summary.json").read_text())["measures"]["messages_per_step"] > 0
    assert largest_difference(sensors(tmp_path / "two"), sensors(alone("block of tet10"))) < 1e-9


# Products with C go over borders between the rows of two of three; three parts of four have tetrahedra at their borders.
COUNTS = {"held damping": (3,), "tet10": (2, 4)}


@several
@pytest.mark.parametrize("count, name", [(count, name) for name in LARGE for count in COUNTS.get(name, (2,))])
def test_a_large_body_of_another_kind(alone, mpirun, tmp_path, count, name):
    (tmp_path / "cube.yaml").write_text(CUBE)
    must(mpirun(count, "run", "cube.yaml", "-o", "two", *sets(*LARGE[name])))
    one = alone(f"large {name}")
    # Iterations on several processes are others than those on one.
    limit = 1e-8 if name == "iterative" else 1e-9
    assert largest_difference(sensors(tmp_path / "two"), sensors(one)) < limit
    if name != "iterative":
        expect_same_displacements(tmp_path / "two", one)
        expect_same_energies(tmp_path / "two", one)
    factors = json.loads((tmp_path / "two" / "summary.json").read_text())["bodies"]["cube"]["factorisations"]
    assert factors == {"iterative": 0, "steps of its own": 2}.get(name, 1)


@several
def test_equal_bodies_share_what_is_divided(alone, mpirun, tmp_path):
    (tmp_path / "twins.yaml").write_text(TWINS)
    must(mpirun(2, "run", "twins.yaml", "-o", "two"))
    assert largest_difference(sensors(tmp_path / "two"), sensors(alone("twins"))) < 1e-9
    expect_same_energies(tmp_path / "two", alone("twins"))
    counts = json.loads((tmp_path / "two" / "summary.json").read_text())["bodies"]
    assert counts["cube"]["factorisations"] + counts["other"]["factorisations"] == 1


@several
@pytest.mark.parametrize("count, name", [(2, "shells"), (3, "shells"), (4, "shells"), (2, "shells with a rigid edge"), (3, "beams"),
                                         (2, "links"), (3, "links"), (3, "links of a deck")])
def test_shells_beams_and_links(alone, mpirun, tmp_path, count, name):
    _, model, change = ALONE[name]
    write(tmp_path, model)
    must(mpirun(count, "run", "model.yaml", "-o", "several", *change))
    summary = json.loads((tmp_path / "several" / "summary.json").read_text())
    assert next(iter(summary["bodies"].values()))["dof"] >= 2000, "large enough to be distributed"
    assert summary["measures"]["messages_per_step"] > 0
    assert largest_difference(sensors(tmp_path / "several"), sensors(alone(name))) < 1e-9
    expect_same_energies(tmp_path / "several", alone(name))
    expect_same_stresses(tmp_path / "several", alone(name))


@several
@pytest.mark.parametrize("count", [2, 3, 4])
def test_kept_solves_of_other_processes_answer(alone, mpirun, tmp_path, count):
    """Pairs of loads and answers are there; each run in the same number of processes combines them in the same way."""
    (tmp_path / "cube.yaml").write_text(CUBE)
    reference = alone("3 ms")
    must(mpirun(count, "run", "cube.yaml", "-o", "several", *sets("simulation.duration=3 ms")))
    one, several_ = (json.loads((place / "summary.json").read_text())["bodies"]["cube"] for place in (reference, tmp_path / "several"))
    assert one["recycled"] >= 15
    # The same but for loads whose remainder is at its limit.
    assert abs(several_["recycled"] - one["recycled"]) <= 1
    assert largest_difference(sensors(tmp_path / "several"), sensors(reference)) < 1e-9
    expect_same_energies(tmp_path / "several", reference)
    expect_same_stresses(tmp_path / "several", reference)


@several
def test_a_killed_run_goes_on_in_another_number_of_processes(buckens, mpirun, tmp_path):
    """One, two, four and one again; those of two are killed. Kept solves are among what is saved."""
    (tmp_path / "cube.yaml").write_text(CUBE)
    buckens("run", "cube.yaml", "-o", "out", "--set", "simulation.duration=1 ms", "--set", "simulation.checkpoint=0.2 s").must(0)
    kill_one(tmp_path, 1, 2, "--continue", "out", "--until", "3", records=15, seconds=240, out=())
    end = sensors(tmp_path / "out")["t"][-1]
    must(mpirun(4, "run", "--continue", "out", "--until", end + 1e-3))
    buckens("run", "--continue", "out", "--until", end + 1.5e-3).must(0)
    buckens("run", "cube.yaml", "-o", "whole", "--set", f"simulation.duration={end + 1.5e-3} s").must(0)
    whole, parts = sensors(tmp_path / "whole"), sensors(tmp_path / "out")
    assert numpy.allclose(whole["t"], parts["t"], rtol=0, atol=1e-12)
    assert largest_difference(parts, whole) < 1e-9
    expect_same_energies(tmp_path / "out", tmp_path / "whole")
    expect_same_stresses(tmp_path / "out", tmp_path / "whole")


@several
def test_static_equilibrium_of_a_large_body(alone, mpirun, tmp_path):
    (tmp_path / "cube.yaml").write_text(ALONE["static"][1])
    must(mpirun(2, "static", "cube.yaml", "-o", "two"))
    assert largest_difference(sensors(tmp_path / "two"), sensors(alone("static"))) < 1e-9


@several
@pytest.mark.parametrize("count", [2, 3])
def test_messages_and_bytes_of_a_step_are_counted(mpirun, tmp_path, count):
    """A solve: an order to each process, its right-hand side and its answer, whether it failed, and what all say to that."""
    must(mpirun(count, "run", BLOCKS, "-o", "out", *DISTRIBUTED))
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["measures"]["processes"] == count
    solves = sum(body["solves"] for body in summary["bodies"].values()) / summary["steps"]
    others = count - 1
    messages = summary["measures"]["messages_per_step"]
    assert messages == pytest.approx(5 * others * solves, rel=1e-12)
    # 160 nodes of three variables, of which the first process has every second or third.
    sent = 3 * (160 - 160 // count)
    order = 56
    expected = solves * (others * (order + 2 * 4) + 2 * 8 * sent)
    assert summary["measures"]["bytes_per_step"] == pytest.approx(expected, rel=1e-12)


@several
@pytest.mark.parametrize("rank", [0, 1])
def test_a_killed_process_ends_a_run_with_divided_matrices(tmp_path, rank):
    (tmp_path / "cube.yaml").write_text(CUBE)
    kill_one(tmp_path, rank, 3, "cube.yaml", "--set", "simulation.duration=3 s", records=2, seconds=240)
    assert len(sensors(tmp_path / "out")["t"]) >= 1, "what was recorded is there"


@several
def test_the_factor_has_the_order_of_one_process(buckens, mpirun, tmp_path):
    """By the order that MUMPS finds itself without METIS it has 1.24 times the entries for a cube of 31 x 31 x 31."""
    (tmp_path / "cube.yaml").write_text(cube(18))
    arguments = ("modes", "cube.yaml", "--count", 1, "--method", "subspace", "--json")
    one = json.loads(buckens(*arguments).must(0).out)
    two = json.loads(must(mpirun(2, *arguments)).stdout)

    def entries(node):
        if isinstance(node, dict):
            return next((found for key, value in node.items() if (found := value if key == "factor_entries" else entries(value))), None)
        return next((found for value in node if (found := entries(value))), None) if isinstance(node, list) else None

    # MUMPS merges narrow fronts, which adds some.
    assert entries(one) <= entries(two) < 1.05 * entries(one)


def virtual_memory(process):
    lines = pathlib.Path(f"/proc/{process}/status").read_text().splitlines()
    return next(1024 * int(line.split()[1]) for line in lines if line.startswith("VmSize"))


ONE_HEAP = {**ENVIRONMENT, "MALLOC_ARENA_MAX": "1"}  # others reserve more than they use


def memory_of_the_second(place, model, duration):
    """Virtual memory of the second of two processes once they step [bytes]."""
    runs = subprocess.Popen([MPIRUN, "-n", "2", PROGRAM, "run", model, "-o", "enough", "-q", "--set", f"simulation.duration={duration}"],
                            cwd=place, env=ONE_HEAP, stdin=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        deadline = time.monotonic() + 240
        csv = place / "enough" / "sensors.csv"
        while not csv.exists() or len(csv.read_text().splitlines()) < 3:
            assert time.monotonic() < deadline and runs.poll() is None
            time.sleep(0.1)
        return virtual_memory(started(runs, 1))
    finally:
        runs.terminate()
        runs.wait(timeout=60)


def told_with_little_memory(place, most, model="cube.yaml"):
    """What a run says whose second process may have so much memory [bytes]: one line."""
    limited = f"[ $OMPI_COMM_WORLD_RANK = 0 ] || ulimit -v {most // 1024}; exec \"$@\""
    command = [MPIRUN, "-n", "2", "sh", "-c", limited, "sh", PROGRAM, "run", model, "-o", "out"]
    result = subprocess.run(command, cwd=place, capture_output=True, text=True, timeout=240, check=False, env=ONE_HEAP,
                            stdin=subprocess.DEVNULL)
    assert result.returncode != 0
    told = [line for line in result.stderr.splitlines() if line.startswith("buckens: error")]
    assert len(told) == 1 and "too little memory" in told[0], result.stderr
    return told[0]


def libraries(process):
    """Names of the shared libraries that a process has loaded."""
    return {pathlib.Path(line.split()[-1]).name for line in pathlib.Path(f"/proc/{process}/maps").read_text().splitlines() if ".so" in line}


@several
@pytest.mark.parametrize("options, has_petsc", [((), False), (ITERATE, True)], ids=["direct", "iterative"])
def test_petsc_is_loaded_by_those_that_need_it(tmp_path, options, has_petsc):
    """It takes 15 MB of each process, with eighty libraries that it brings along."""
    command = [MPIRUN, "-n", "2", PROGRAM, "run", BLOCKS, "-o", "out", "-q", "--set", "simulation.duration=60 s", *options]
    runs = subprocess.Popen(command, cwd=tmp_path, env=ENVIRONMENT, stdin=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        deadline = time.monotonic() + 120
        csv = tmp_path / "out" / "sensors.csv"
        while not csv.exists() or len(csv.read_text().splitlines()) < 3:
            assert time.monotonic() < deadline and runs.poll() is None
            time.sleep(0.1)
        for rank in (0, 1):
            loaded = libraries(started(runs, rank))
            assert "libbuckens_petsc.so" in loaded
            assert any(name.startswith("libpetsc") for name in loaded) == has_petsc
    finally:
        runs.terminate()
        runs.wait(timeout=60)


@several
def test_too_little_memory_for_a_part_of_the_factor(tmp_path):
    """On one process only: the first one tells it once, and all end."""
    (tmp_path / "cube.yaml").write_text(cube(18))
    needed = memory_of_the_second(tmp_path, "cube.yaml", "3 ms")
    # Its part of the factor and of the fronts takes 80 MB of that, and is what it needs last.
    assert "equations on 2 processes" in told_with_little_memory(tmp_path, needed - 30_000_000)


@several
@pytest.mark.parametrize("model", [cube(18), shells(58), grid_of_beams(60), linked_grid(60)], ids=["solids", "shells", "beams", "links"])
def test_too_little_memory_for_making_columns(tmp_path, model):
    """Processes other than the first assemble M and K, so one of them lacks memory before there is a factor."""
    (tmp_path / "model.yaml").write_text(model)
    idle = memory_of_the_second(tmp_path, BLOCKS, "30 s")
    # Lists of what elements add to M of shells take 20 MB; K of both triangles 20 MB of solids, 13 MB of shells; what elements add to it comes on top.
    told = told_with_little_memory(tmp_path, idle + 16_000_000, "model.yaml")
    assert "equations on 2 processes could not be made" in told and "making the rows" in told


@several
def test_inertia_of_solids_is_integrated_by_others(tmp_path):
    """The scalar mass matrix comes first of all that they make of solids. One without memory for its columns says for how many nodes."""
    (tmp_path / "cube.yaml").write_text(cube(18))
    idle = memory_of_the_second(tmp_path, BLOCKS, "30 s")
    told = told_with_little_memory(tmp_path, idle + 2_000_000)
    assert f"a matrix of {19**3} equations on 2 processes could not be made" in told


@several
@pytest.mark.parametrize("switch", ["ulimit -f 0", "export BUCKENS_MPI_DISK=off"], ids=["no files", "off"])
def test_a_process_without_a_disk_keeps_its_rows(buckens, tmp_path, switch):
    """Others have M, K and their part of the factor on the disk while it is computed."""
    (tmp_path / "cube.yaml").write_text(CUBE)
    limited = f"[ $OMPI_COMM_WORLD_RANK = 0 ] || {switch}; exec \"$@\""
    command = [MPIRUN, "-n", "3", "sh", "-c", limited, "sh", PROGRAM, "run", "cube.yaml", "-o", "three"]
    must(subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=240, check=False, env=ENVIRONMENT,
                        stdin=subprocess.DEVNULL))
    buckens("run", "cube.yaml", "-o", "one").must(0)
    assert largest_difference(sensors(tmp_path / "three"), sensors(tmp_path / "one")) < 1e-9
    expect_same_energies(tmp_path / "three", tmp_path / "one")
    expect_same_stresses(tmp_path / "three", tmp_path / "one")


def test_one_process_counts_nothing(buckens, tmp_path):
    buckens("run", BLOCKS, "-o", "out", "--set", "simulation.duration=2 ms").must(0)
    measures = json.loads((tmp_path / "out" / "summary.json").read_text()).get("measures", {})
    assert not {"processes", "messages_per_step", "bytes_per_step"} & measures.keys()


@several
def test_modes(buckens, mpirun):
    def frequencies(result):
        return [line.split()[1] for line in result.splitlines() if line.strip()[:1].isdigit()]

    arguments = ("modes", BLOCKS, "--count", 4, "--method", "subspace")
    one = frequencies(buckens(*arguments).must(0).out)
    assert len(one) == 8
    assert frequencies(must(mpirun(2, *arguments, *DISTRIBUTED)).stdout) == one


@several
def test_an_error_is_told_once(mpirun):
    for arguments, words in [
        (("run", BLOCKS, "--set", "bodies.block.solver={petsc: \"-pc_gamg_treshold 0.1\"}"), "-pc_gamg_treshold"),
        (("run", BLOCKS, "--set", "bodies.block.solver={petsc: \"-pc_type magic\"}"), "magic"),
        (("run", "nowhere.yaml"), "nowhere.yaml"),
    ]:
        result = mpirun(2, *arguments, timeout=60)
        assert result.returncode != 0
        told = [line for line in result.stderr.splitlines() if line.startswith("buckens: error")]
        assert len(told) == 1 and words in told[0], result.stderr


@several
@pytest.mark.parametrize("given", ["many", "63", "2.5", "99999999999"])
def test_from_how_many_variables_on_bodies_are_shared_is_a_number(mpirun, given):
    result = must(mpirun(2, "run", BLOCKS, environment={"BUCKENS_MPI_VARIABLES": given}, timeout=60), 2)
    told = [line for line in result.stderr.splitlines() if line.startswith("buckens: error")]
    assert len(told) == 1 and f"BUCKENS_MPI_VARIABLES is \"{given}\"" in told[0] and "20000" in told[0], result.stderr


@several
def test_the_disk_is_used_or_not(mpirun):
    result = must(mpirun(2, "run", BLOCKS, environment={"BUCKENS_MPI_DISK": "no"}, timeout=60), 2)
    told = [line for line in result.stderr.splitlines() if line.startswith("buckens: error")]
    assert len(told) == 1 and "BUCKENS_MPI_DISK is \"no\"" in told[0] and "\"on\" or \"off\"" in told[0], result.stderr


@several
def test_bodies_as_small_as_that_are_shared(buckens, mpirun, tmp_path):
    """A beam of 66 variables, beside one of 60 that is not shared."""
    beam = "{{from: [{0}, 0, 0], to: [{0}, 1, 0], elements: {1}, section: round, material: steel}}"
    (tmp_path / "beams.yaml").write_text(f"""\
buckens: 1
gravity: [0, 0, -9.81]
materials: {{steel: {{E: 210 GPa, nu: 0.3, rho: 7850, damping: {{stiffness: 1e-5}}}}}}
sections: {{round: {{circle: {{diameter: 20 mm}}}}}}
bodies: {{large: {{beam: {beam.format(0, 10)}}}, small: {{beam: {beam.format(1, 9)}}}}}
joints:
  first: {{spherical: {{between: [ground, large/start]}}}}
  second: {{spherical: {{between: [ground, small/start]}}}}
simulation: {{duration: 20 ms, step: 0.5 ms}}
output: {{every: 1 ms, sensors: {{tip: {{position: large/end}}, far: {{position: small/end}}, force: {{joint-force: first}}}}}}
""")
    buckens("run", "beams.yaml", "-o", "one").must(0)
    must(mpirun(2, "run", "beams.yaml", "-o", "two", environment={"BUCKENS_MPI_VARIABLES": "64"}))
    summary = json.loads((tmp_path / "two" / "summary.json").read_text())
    assert [body["dof"] for body in summary["bodies"].values()] == [66, 60]
    assert summary["measures"]["messages_per_step"] > 0
    assert largest_difference(sensors(tmp_path / "two"), sensors(tmp_path / "one")) < 1e-9


@several
def test_smaller_bodies_are_not_shared(alone, mpirun, tmp_path):
    (tmp_path / "cube.yaml").write_text(CUBE)
    must(mpirun(2, "run", "cube.yaml", "-o", "two", environment={"BUCKENS_MPI_VARIABLES": ""}))
    assert json.loads((tmp_path / "two" / "summary.json").read_text())["measures"]["messages_per_step"] == 0
    assert largest_difference(sensors(tmp_path / "two"), sensors(alone("cube"))) == 0


@several
@pytest.mark.parametrize("missing_rank, teller", [(1, 0), (0, 1)])
def test_a_process_that_never_joins_is_missed(tmp_path, missing_rank, teller):
    """A script that calls the program in one process only; MPI would wait for ever."""
    script = f"[ $OMPI_COMM_WORLD_RANK = {missing_rank} ] && exec sleep 60; exec \"$@\""
    command = [MPIRUN, "-n", "2", "sh", "-c", script, "sh", PROGRAM, "run", BLOCKS, "-o", "out"]
    result = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=50, check=False, stdin=subprocess.DEVNULL,
                            env={**ENVIRONMENT, "BUCKENS_MPI_SECONDS": "2"})
    assert result.returncode != 0
    told = [line for line in result.stderr.splitlines() if line.startswith("buckens: error")]
    assert len(told) == 1 and "2 processes, but not all have joined" in told[0] and "BUCKENS_MPI_SECONDS" in told[0], result.stderr
    assert f"within {2 + 3 * teller} s" in told[0]


@several
def test_more_processes_than_nodes(mpirun):
    options = ("--set", "bodies.block.mesh.box.divisions=[1, 1, 1]", "--set", f"bodies.block.solver={MUMPS}")
    result = mpirun(9, "run", BLOCKS, *options, timeout=120)
    assert result.returncode != 0
    assert result.stderr.count("8 nodes cannot be divided among 9 processes") == 1, result.stderr


@pytest.mark.skipif(MPIRUN is None, reason="no mpirun")
def test_without_the_plug_in_one_process_says_so(mpirun):
    result = mpirun(2, "run", BLOCKS, timeout=60, environment={"BUCKENS_GRID_PLUGIN": "/nowhere/libbuckens_petsc.so"})
    assert result.returncode == 5
    assert result.stderr.count("mpirun has started 2 processes") == 1, result.stderr
    assert "libpetsc-real-dev" in result.stderr


def test_started_for_several_without_the_plug_in(buckens):
    """What mpirun says in the environment is enough to find out."""
    alone = {**os.environ, "BUCKENS_GRID_PLUGIN": "/nowhere/grid.so", "OMPI_COMM_WORLD_SIZE": "2"}
    buckens("run", BLOCKS, env={**alone, "OMPI_COMM_WORLD_RANK": "0"}).must(5, "2 processes", "without mpirun")
    other = buckens("run", BLOCKS, env={**alone, "OMPI_COMM_WORLD_RANK": "1"}).must(5)
    assert other.err == "" and other.out == ""
    # The first one of another machine, where the plug-in is missing, too.
    there = {**alone, "OMPI_COMM_WORLD_RANK": "1", "OMPI_COMM_WORLD_LOCAL_RANK": "0"}
    buckens("run", BLOCKS, env=there).must(5, "2 processes", "libpetsc-real-dev")
    # Verbs that share nothing run as ever.
    buckens("check", BLOCKS, env={**alone, "OMPI_COMM_WORLD_RANK": "1"}).must(0)


def started(mpirun_process, rank):
    """Process of a rank below mpirun."""
    for entry in pathlib.Path("/proc").iterdir():
        try:
            environment = (entry / "environ").read_bytes().split(b"\0")
            parent = (entry / "stat").read_text().rsplit(")", 1)[1].split()[1]
        except (OSError, IndexError):
            continue
        if f"OMPI_COMM_WORLD_RANK={rank}".encode() in environment and int(parent) == mpirun_process.pid:
            return int(entry.name)
    return None


def kill_one(folder, rank, count, *arguments, records, seconds, needs=(), out=("-o", "out")):
    """Runs a model on some processes and kills one of them once there are so many records, and the files that it needs."""
    command = [MPIRUN, "-n", str(count), PROGRAM, "run", *arguments, *out, "-q"]
    with open(folder / "told", "w") as told:
        process = subprocess.Popen(command, cwd=folder, env=ENVIRONMENT, stdin=subprocess.DEVNULL, stdout=told, stderr=told)
        try:
            deadline = time.monotonic() + seconds
            csv = folder / "out" / "sensors.csv"
            while not csv.exists() or len(csv.read_text().splitlines()) <= records or not all(name.exists() for name in needs):
                assert time.monotonic() < deadline and process.poll() is None, (folder / "told").read_text()
                time.sleep(0.1)
            os.kill(started(process, rank), signal.SIGKILL)
            assert process.wait(timeout=60) != 0
        finally:
            if process.poll() is None:
                process.kill()
    assert "signal 9" in (folder / "told").read_text()


@several
@pytest.mark.parametrize("rank", [0, 1])
def test_a_killed_process_ends_the_run(buckens, tmp_path, rank):
    options = ("--set", "simulation.duration=3 s", "--set", "simulation.checkpoint=0.2 s", *DISTRIBUTED)
    # A quick machine has a hundred records before the first checkpoint is due.
    kill_one(tmp_path, rank, 2, str(BLOCKS), *options, records=99, seconds=120, needs=[tmp_path / "out" / "checkpoint.h5"])
    kept = sensors(tmp_path / "out")
    assert len(kept["t"]) >= 50, "what was recorded is there"
    end = kept["t"][-1] + 0.02
    buckens("run", "--continue", "out", "--until", end).must(0)
    buckens("run", BLOCKS, "-o", "whole", "--set", f"simulation.duration={end} s").must(0)
    whole, parts = sensors(tmp_path / "whole"), sensors(tmp_path / "out")
    assert numpy.allclose(whole["t"], parts["t"], rtol=0, atol=1e-12)
    assert largest_difference(parts, whole) < 1e-9
