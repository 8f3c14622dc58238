# SPDX-License-Identifier: Apache-2.0
"""Vectors of large bodies over several processes: those that have their rows work on them, and the first one gets sums."""

import json
import re

import numpy
import pytest
import yaml

from models_of_many_variables import (BLOW, CUBE, FELT, LARGEST, LARGEST_AND_ONE, LARGEST_OF_SHELLS, SHAFTS, SHELL_SIDE, SHELLS, SIDE, SPUN,
                                      STRESSED, TWINS, stressed_grid)
from mpi_runs import expect_same_energies, expect_same_stresses, mpirun, must, several, sets  # noqa: F401
from test_mpi_matrices import scalar_mass
from test_solver import largest_difference, sensors


DAMPED = "materials.steel.damping={mass: 20, stiffness: 0.01 ms}"


@several
@pytest.mark.parametrize("change", [(), (DAMPED,)], ids=["undamped", "damped"])
def test_a_blow_to_a_body_whose_vectors_others_have(buckens, mpirun, tmp_path, change):
    """Vectors come to the first process where blows change rates, and what dampers take is known on both sides of that."""
    (tmp_path / "blow.yaml").write_text(BLOW)
    buckens("run", "blow.yaml", "-o", "one", *sets(*change)).must(0)
    must(mpirun(3, "run", "blow.yaml", "-o", "several", *sets(*change)))
    one = sensors(tmp_path / "one")
    assert abs(one["lost"][-1]) > 1e-3 and one["speed.x"][-1] > -0.9, "it was struck"
    assert largest_difference(sensors(tmp_path / "several"), one) < 1e-9
    expect_same_energies(tmp_path / "several", tmp_path / "one")
    expect_same_stresses(tmp_path / "several", tmp_path / "one")


@several
@pytest.mark.parametrize("count", [2, 3])
def test_vectors_of_a_step_stay_with_the_other_processes(mpirun, tmp_path, count):
    """The first process sends what is to be done with them, and receives sums.

    Programs take an order, what it says, and sums: for values at the start of a step, the right-hand side, what follows from its solution, the
    end of the step, and interface values for the account of work. A solve takes an order and tells twice whether a process has failed. What the
    level of coupling leaves out is found in each tenth step, by two programs. A record asks for interface values by two programs, for itself and
    for the energies, and for these by a third, brings displacements, and asks for its stresses by an order.
    """
    (tmp_path / "cube.yaml").write_text(CUBE)
    change = sets("bodies.cube.coupling=none", "simulation.duration=1 ms", "output.every=1 ms")
    must(mpirun(count, "run", "cube.yaml", "-o", "out", *change))
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    steps, dof = summary["steps"], summary["bodies"]["cube"]["dof"]
    assert summary["bodies"]["cube"]["solves"] == steps == 10
    others = count - 1
    program, solve = 3 * others, 5 * others
    # Of the first process's rows of the factor, from all and back to all.
    through_factor = 2 * others
    record = 3 * program + 2 * others + 3 * others
    neglected = 2 * program
    # Displacements and rates are the same zeros at first, and both accelerations are the same.
    start = 2 * (4 * others)
    messages = summary["measures"]["messages_per_step"] * steps
    assert messages == pytest.approx(steps * (5 * program + solve + through_factor) + record + neglected + start, rel=1e-12)
    if count > 2:  # borders between rows of products are counted twice
        return
    # A vector, and the rows of stresses times it; and two vectors at first.
    stresses = 6 * SIDE**3
    of_record = 8 * (2 * dof + stresses)
    per_step = (summary["measures"]["bytes_per_step"] * steps - of_record - 2 * 8 * dof) / steps
    # Each way what the first process has of the factor: subtrees of the order of elimination, which differ in size.
    assert 2 * 8 * 0.25 * dof < per_step < 2 * 8 * 0.75 * dof


def bytes_per_solve(directory, of_records):
    """Of a run's steps, without those of its records [numbers of eight bytes]."""
    summary = json.loads((directory / "summary.json").read_text())
    body = next(iter(summary["bodies"].values()))
    return (summary["measures"]["bytes_per_step"] * summary["steps"] - 8 * of_records) / body["solves"]


@several
def test_kept_pairs_are_combined_where_their_rows_are(mpirun, tmp_path):
    """Changes of the coupling load do not come to the first process, whether pairs answer them or not."""
    (tmp_path / "cube.yaml").write_text(CUBE)
    must(mpirun(2, "run", "cube.yaml", "-o", "out", *sets("simulation.duration=3 ms", "output.every=3 ms")))
    body = json.loads((tmp_path / "out" / "summary.json").read_text())["bodies"]["cube"]
    dof, made = body["dof"], body["solves"] - 30
    assert body["recycled"] >= 15 and made >= 8, "there are changes of both kinds"
    # Two records as above, and two vectors at first.
    per_solve = bytes_per_solve(tmp_path / "out", 2 * (2 * dof + 6 * SIDE**3) + 2 * dof)
    # Each way what the first process has of the factor. Changes would add twelve numbers per variable.
    assert 2 * 8 * 0.25 * dof < per_solve < 2 * 8 * 0.75 * dof


@several
def test_vectors_of_shells_stay_with_the_other_processes(mpirun, tmp_path):
    """Of bodies whose inertia does not act node by node, too, and their products with M."""
    (tmp_path / "plate.yaml").write_text(SHELLS)
    must(mpirun(2, "run", "plate.yaml", "-o", "out", *sets("simulation.duration=2 ms", "output.every=2 ms", "bodies.plate.coupling=none")))
    body = json.loads((tmp_path / "out" / "summary.json").read_text())["bodies"]["plate"]
    dof = body["dof"]
    assert body["solves"] == 20
    # Two records with stresses of two layers of each shell, and two vectors at first.
    per_solve = bytes_per_solve(tmp_path / "out", 2 * (2 * dof + 12 * SHELL_SIDE**2) + 2 * dof)
    assert 2 * 8 * 0.25 * dof < per_solve < 2 * 8 * 0.75 * dof


@several
@pytest.mark.parametrize("programs, change", [(1, ()), (1, ("simulation.method=newmark",)), (5, ("simulation.tolerance=0.01",))],
                         ids=["dampers", "dampers by products with C", "errors of steps"])
def test_work_of_dampers_and_errors_of_steps_take_no_vectors(buckens, mpirun, tmp_path, programs, change):
    """They are sums: one program for dampers, and four for the error of a step. A vector would take two messages."""
    (tmp_path / "cube.yaml").write_text(CUBE)
    messages, steps = [], []
    for end in ("2 ms", "4 ms"):
        changes = sets(DAMPED, *change, "bodies.cube.coupling=none", "simulation.checkpoint=1 h", f"simulation.duration={end}",
                       f"output.every={end}")
        buckens("run", "cube.yaml", "-o", "one", *changes).must(0)
        must(mpirun(2, "run", "cube.yaml", "-o", "out", *changes))
        assert largest_difference(sensors(tmp_path / "out"), sensors(tmp_path / "one")) < 1e-9
        expect_same_energies(tmp_path / "out", tmp_path / "one")
        summary = json.loads((tmp_path / "out" / "summary.json").read_text())
        messages.append(summary["measures"]["messages_per_step"] * summary["steps"])
        steps.append(summary["steps"])
    # Both runs have the same two records and the same start. Steps alone take five programs and a solve, as above.
    assert (messages[1] - messages[0]) / (steps[1] - steps[0]) < 22 + 3 * programs + 1


def of_further_steps(buckens, mpirun, tmp_path, text, *changes, times=("2 ms", "4 ms")):
    """Of two runs that differ in length but not in their records and their start: what a further solve adds to the numbers that the first process
    sends and receives, per variable, and what a further step adds to its messages. Results are compared with those of one process.
    """
    (tmp_path / "model.yaml").write_text(text)
    numbers, messages, steps, solves = [], [], [], []
    for end in times:
        change = sets(*changes, "simulation.checkpoint=1 h", f"simulation.duration={end}", f"output.every={end}")
        buckens("run", "model.yaml", "-o", "one", *change).must(0)
        must(mpirun(2, "run", "model.yaml", "-o", "two", *change))
        assert largest_difference(sensors(tmp_path / "two"), sensors(tmp_path / "one")) < 1e-9
        expect_same_energies(tmp_path / "two", tmp_path / "one")
        summary = json.loads((tmp_path / "two" / "summary.json").read_text())
        body = next(body for body in summary["bodies"].values() if body["dof"] > 100)
        steps.append(summary["steps"])
        solves.append(body["solves"])
        messages.append(summary["measures"]["messages_per_step"] * summary["steps"])
        numbers.append(summary["measures"]["bytes_per_step"] * summary["steps"] / 8 / body["dof"])
    return (numbers[1] - numbers[0]) / (solves[1] - solves[0]), (messages[1] - messages[0]) / (steps[1] - steps[0])


# Each way what the first process has of the factor, which differs. A vector would add one.
LEAST, MOST = 2 * 0.25, 2 * 0.75


@several
@pytest.mark.parametrize("text, level, change", [
    (CUBE, "none", ()),
    (CUBE, "none", (DAMPED, "simulation.method=newmark")),
    (SPUN, "first-order", ()),
    (SHELLS, "none", ()),
], ids=["none", "by products with K and C", "first order", "shells"])
def test_levels_of_coupling_are_chosen_by_sums(buckens, mpirun, tmp_path, text, level, change):
    """Loads that are left out are formed and sieved where the vectors are, by two programs per step. Dampers take one more."""
    name = "plate" if text is SHELLS else "cube"
    per_solve, messages = of_further_steps(buckens, mpirun, tmp_path, text, f"bodies.{name}.coupling=auto", *change)
    one, two = (json.loads((tmp_path / run / "summary.json").read_text())["bodies"][name] for run in ("one", "two"))
    assert one["coupling"] == two["coupling"] == f"auto: {level}"
    assert one["largest_neglected_share"] > 0
    assert two["largest_neglected_share"] == pytest.approx(one["largest_neglected_share"], rel=1e-9)
    assert LEAST < per_solve < MOST
    assert messages == pytest.approx(22 + 3 * (2 + (DAMPED in change)), abs=1e-9)


@several
def test_signals_of_sensors_take_no_vectors(buckens, mpirun, tmp_path):
    """Accelerations of markers are products with interface rows, and those of meshes jump with forces where they are."""
    per_solve, _ = of_further_steps(buckens, mpirun, tmp_path, FELT, "bodies.cube.coupling=none")
    pushed = sensors(tmp_path / "one")["push"]
    assert abs(pushed[-1] - pushed[0]) > 1e-3
    assert LEAST < per_solve < MOST


def numbers_of_stresses(buckens, mpirun, tmp_path, text, name):
    """What a step takes more than with signals of work, of which the first process keeps account in any case: messages, and bytes."""
    other = yaml.safe_load(re.sub(r"\bon:", '"on":', text))  # a word for truth in YAML 1.1
    of_elements = [name for name, kind in other["output"]["sensors"].items() if {"stress", "section-force"} & set(kind)]
    for sensor in of_elements:
        other["output"]["sensors"][sensor] = {"energy": "work"}
    for signal in other["signals"].values():
        if isinstance(signal, dict) and isinstance(signal["sensor"], dict):
            signal["sensor"] = signal["sensor"]["of"]
    found = []
    for model in (json.dumps(other), text):
        numbers, messages = of_further_steps(buckens, mpirun, tmp_path, model, f"bodies.{name}.coupling=none", times=("1 ms", "2 ms"))
        dof = json.loads((tmp_path / "two" / "summary.json").read_text())["bodies"][name]["dof"]
        found.append((messages, 8 * dof * numbers))
    pushed = sensors(tmp_path / "one")["push"]
    assert numpy.ptp(pushed) > 1e-3 * numpy.abs(pushed).max(), "what they read matters"
    return [after - before for before, after in zip(*found, strict=True)]


# An order, where a program begins, what it does, and whether it was done.
PROGRAM_BYTES = 56 + 8 + 16 + 8


@several
@pytest.mark.parametrize("text, name, numbers", [(STRESSED, "cube", 3 * (2 * (SIDE + 1) ** 2 + 8)), (stressed_grid(), "grid", 6 * 6)],
                         ids=["solids", "those whose nodes follow others"])
def test_signals_of_stresses_take_the_numbers_of_their_elements(buckens, mpirun, tmp_path, text, name, numbers):
    """One program, with a row there and a number back for each variable on which they depend."""
    messages, size = numbers_of_stresses(buckens, mpirun, tmp_path, text, name)
    assert messages == pytest.approx(3, abs=1e-9)
    assert size == pytest.approx(PROGRAM_BYTES + 12 * numbers, abs=30)


@several
@pytest.mark.parametrize("text, name", [(LARGEST, "cube"), (LARGEST_OF_SHELLS, "plate")], ids=["solids", "shells"])
def test_signals_of_the_largest_stress_take_one_number(buckens, mpirun, tmp_path, text, name):
    """The others have the stresses, and numbers beside theirs, and find the largest."""
    messages, size = numbers_of_stresses(buckens, mpirun, tmp_path, text, name)
    assert messages == pytest.approx(3, abs=1e-9)
    assert size == pytest.approx(PROGRAM_BYTES + 36 * 8 + 8, abs=30)


@several
@pytest.mark.parametrize("text", [STRESSED, stressed_grid(), LARGEST, LARGEST_OF_SHELLS, LARGEST_AND_ONE],
                         ids=["solids", "those whose nodes follow others", "largest", "largest of shells", "largest and one"])
def test_stresses_of_several_processes_are_read(buckens, mpirun, tmp_path, text):
    """Elements are with two others, and so are the nodes of some."""
    (tmp_path / "model.yaml").write_text(text)
    changes = sets("simulation.duration=1 ms", "output.every=0.5 ms")
    buckens("run", "model.yaml", "-o", "one", *changes).must(0)
    must(mpirun(3, "run", "model.yaml", "-o", "three", *changes))
    assert largest_difference(sensors(tmp_path / "three"), sensors(tmp_path / "one")) < 1e-9
    expect_same_energies(tmp_path / "three", tmp_path / "one")


@several
def test_shafts_of_crosses_take_no_vectors(buckens, mpirun, tmp_path):
    per_solve, _ = of_further_steps(buckens, mpirun, tmp_path, SHAFTS, "bodies.cube.coupling=none")
    assert LEAST < per_solve < MOST


@several
def test_large_deformation_is_noticed_by_sums(buckens, mpirun, tmp_path):
    """From how many instants coupling is extrapolated depends on what deformation adds to the inertia."""
    per_solve, _ = of_further_steps(buckens, mpirun, tmp_path, CUBE, "materials.steel.E=20 kPa", "simulation.step=3 ms", times=("60 ms", "90 ms"))
    assert LEAST < per_solve < MOST


@several
@pytest.mark.parametrize("text, change", [(SPUN, "bodies.cube.coupling=auto"), (SHELLS, "bodies.plate.coupling=auto"),
                                          (FELT, "bodies.cube.coupling=full"), (SHAFTS, "bodies.cube.coupling=full")],
                         ids=["solids", "shells", "signals", "shafts"])
def test_sums_of_two_processes_are_added(buckens, mpirun, tmp_path, text, change):
    """The others are one where there are two."""
    (tmp_path / "model.yaml").write_text(text)
    changes = sets(change, "simulation.duration=1 ms", "output.every=0.5 ms")
    buckens("run", "model.yaml", "-o", "one", *changes).must(0)
    must(mpirun(3, "run", "model.yaml", "-o", "three", *changes))
    assert largest_difference(sensors(tmp_path / "three"), sensors(tmp_path / "one")) < 1e-9
    expect_same_energies(tmp_path / "three", tmp_path / "one")
    one, three = (next(iter(json.loads((tmp_path / run / "summary.json").read_text())["bodies"].values())) for run in ("one", "three"))
    assert three["largest_neglected_share"] == pytest.approx(one["largest_neglected_share"], rel=1e-9)


def solves_of(directory):
    bodies = json.loads((directory / "summary.json").read_text())["bodies"]
    return {name: (body["solves"], body.get("recycled", 0)) for name, body in bodies.items()}


@several
def test_equal_bodies_learn_from_each_other(buckens, mpirun, tmp_path):
    """What one has just learned is taken from what the other learns in the same step."""
    (tmp_path / "twins.yaml").write_text(TWINS)
    change = sets("simulation.duration=2 ms", "output.every=1 ms")
    buckens("run", "twins.yaml", "-o", "one", *change).must(0)
    must(mpirun(2, "run", "twins.yaml", "-o", "two", *change))
    assert largest_difference(sensors(tmp_path / "two"), sensors(tmp_path / "one")) < 1e-9
    one, two = solves_of(tmp_path / "one"), solves_of(tmp_path / "two")
    assert sum(recycled for _, recycled in one.values()) >= 10
    for name, counts in one.items():
        # The same but for loads whose remainder is at its limit.
        assert two[name] == pytest.approx(counts, abs=1), name


@several
def test_pairs_that_were_just_made_are_saved(mpirun, tmp_path):
    (tmp_path / "cube.yaml").write_text(CUBE)
    change = sets("output.every=0.1 ms")
    must(mpirun(2, "run", "cube.yaml", "-o", "whole", *change, "--set", "simulation.duration=2 ms"))
    must(mpirun(2, "run", "cube.yaml", "-o", "parts", *change, "--set", "simulation.duration=0.3 ms"))
    assert solves_of(tmp_path / "parts") == {"cube": (6, 0)}, "each change was solved for"
    must(mpirun(2, "run", "--continue", "parts", "--until", "2 ms"))
    (solves, recycled), (rest, recycled_there) = solves_of(tmp_path / "whole")["cube"], solves_of(tmp_path / "parts")["cube"]
    assert (6 + rest, recycled_there) == (solves, recycled)
    whole, parts = sensors(tmp_path / "whole"), sensors(tmp_path / "parts")
    assert largest_difference(parts, whole) < 1e-12


def bytes_of_whole_matrices(directory):
    return json.loads((directory / "summary.json").read_text())["measures"]["bytes_of_whole_matrices"]


@several
def test_the_scalar_mass_matrix_comes_again_where_something_needs_it(buckens, mpirun, tmp_path):
    """The first process lets go of it once others have its columns, of two equal bodies both; a blow needs it."""
    for name, text in (("twins", TWINS), ("blow", BLOW)):
        (tmp_path / f"{name}.yaml").write_text(text)
    once = scalar_mass(SIDE)
    halved = sets("simulation.tolerance=1e-7", "simulation.step=0.2 ms")
    must(mpirun(2, "run", "twins.yaml", "-o", "steps", *halved))
    assert bytes_of_whole_matrices(tmp_path / "steps") == 2 * once, "factors for other lengths of step need it no more"
    must(mpirun(2, "run", "blow.yaml", "-o", "two"))
    assert bytes_of_whole_matrices(tmp_path / "two") == 2 * once
    buckens("run", "blow.yaml", "-o", "one").must(0)
    assert largest_difference(sensors(tmp_path / "two"), sensors(tmp_path / "one")) < 1e-9
