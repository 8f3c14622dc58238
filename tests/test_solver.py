# SPDX-License-Identifier: Apache-2.0
"""`solver:` of bodies: results without a factor are those with one, and what is refused.

Without the plug-in (build option BUCKENS_PETSC) only the messages are tested; the rest is skipped by name.
"""

import os
import re
import shutil
import subprocess

import numpy
import pytest

from conftest import MODELS, PROGRAM, SOURCE

BLOCKS = MODELS / "large_block.yaml"
ITERATE = ("--set", "bodies.block.solver=iterative", "--set", "bodies.arm.solver=iterative")


def missing():
    told = subprocess.run([PROGRAM, "check", BLOCKS, *ITERATE], capture_output=True, text=True, check=False)
    return "libpetsc-real-dev" in told.stderr


iterates = pytest.mark.skipif(missing(), reason="built without BUCKENS_PETSC")


@pytest.fixture
def run(buckens, tmp_path):
    """Sensors by name, and the summary."""

    def call(name, *options, model=BLOCKS):
        summary = buckens("run", model, "-o", name, "--json", *options).must(0).json
        return sensors(tmp_path / name), summary

    return call


def sensors(directory):
    lines = (directory / "sensors.csv").read_text().splitlines()
    table = numpy.array([line.split(",") for line in lines[1:]], float)
    return {name.split(" [")[0]: table[:, k] for k, name in enumerate(lines[0].split(","))}


def largest_difference(one, two):
    """Of a sensor's components, relative to the largest of all of them."""
    scale = {}
    for name in two:
        sensor = name.split(".")[0]
        scale[sensor] = max(scale.get(sensor, 0), numpy.abs(two[name]).max())
    return max(numpy.abs(one[name] - two[name]).max() / scale[name.split(".")[0]] for name in two)


@iterates
@pytest.mark.parametrize("coupling", ["full", "first-order", "none"])
def test_results_are_those_of_a_factor(run, coupling):
    couple = ("--set", f"bodies.block.coupling={coupling}", "--set", f"bodies.arm.coupling={coupling}")
    expected, direct = run("direct", *couple)
    found, summary = run("iterative", *couple, *ITERATE)
    # A solve leaves 1e-8 of what the extrapolation of the step lacks, and 1e-11 of the motion (docs/theory/26): over
    # 60 damped steps that adds up to less than 60 * 1e-8 of local errors, which are 1e-2 of the motion and less.
    assert largest_difference(found, expected) < 1e-8
    for name in ("block", "arm"):
        body = summary["bodies"][name]
        assert body["factorisations"] == 0
        assert body["solves"] == direct["bodies"][name]["solves"]
        assert 1 < body["iterations_per_solve"] < 40
        assert body["seconds_per_solve"] > 0
        assert "iterations_per_solve" not in direct["bodies"][name]
    assert summary["wall_seconds"]["preparation"]["factor"] > 0, "of the multigrid"
    # They are equal, so that one solver serves both.
    assert summary["bodies"]["block"]["solver_bytes"] > 0 == summary["bodies"]["arm"]["solver_bytes"]


@iterates
def test_the_table_tells_iterations(buckens):
    told = buckens("run", BLOCKS, "-o", "out", *ITERATE, "--set", "simulation.duration=5 ms").must(0).out
    assert "iterations/solve" in told and "s/solve" in told


@iterates
def test_a_run_that_goes_on_repeats_every_bit(run, buckens, tmp_path):
    whole, _ = run("whole", *ITERATE)
    run("parts", *ITERATE, "--set", "simulation.duration=15 ms")
    buckens("run", "--continue", "parts", "--until", "0.03").must(0)
    assert all((sensors(tmp_path / "parts")[name] == whole[name]).all() for name in whole)


@iterates
def test_options_of_petsc(run, buckens):
    expected, _ = run("direct")
    options = ("--set", "bodies.block.solver={petsc: \"-pc_type jacobi\"}")
    found, summary = run("jacobi", *options)
    assert largest_difference(found, expected) < 1e-8
    assert summary["bodies"]["block"]["iterations_per_solve"] > 10
    assert "iterations_per_solve" not in summary["bodies"]["arm"]
    # A factor of PETSc's, which takes no iterations.
    options = ("--set", "bodies.block.solver={petsc: \"-ksp_type preonly -pc_type cholesky\"}")
    found, summary = run("factor", *options)
    assert largest_difference(found, expected) < 1e-8
    assert summary["bodies"]["block"]["iterations_per_solve"] == 1


@iterates
def test_unknown_options_of_petsc_are_named(buckens):
    buckens("run", BLOCKS, "--set", "bodies.block.solver={petsc: \"-pc_gamg_treshold 0.1\"}").must(
        4, "block", "-pc_gamg_treshold", "correct the options of PETSc")


@iterates
@pytest.mark.parametrize("options, words", [
    # Applied once, these preconditioners gave motions that were wrong by more than their own size.
    ("-ksp_type preonly", ["-ksp_type preonly", "does not solve the equations", "-pc_type cholesky"]),
    ("-ksp_type preonly -pc_type jacobi", ["does not solve the equations"]),
    ("-ksp_type preonly -pc_type icc", ["does not solve the equations"]),
    # Without a norm no solve iterated at all; with another one it ended anywhere.
    ("-ksp_norm_type none", ["energy norm", "-ksp_norm_type"]),
    ("-ksp_norm_type unpreconditioned", ["energy norm", "-ksp_norm_type"]),
    # The error of the step decides, so these changed nothing.
    ("-ksp_rtol 1e-3", ["-ksp_rtol would have no effect", "far below that of the step"]),
    ("-KSP_RTOL 1e-3", ["-ksp_rtol would have no effect"]),
    ("-pc_type jacobi -ksp_max_it 3", ["-ksp_max_it would have no effect"]),
    ("-ksp_convergence_test skip", ["-ksp_convergence_test would have no effect"]),
    ("-ksp_type preonly -pc_type cholesky -ksp_atol 1", ["-ksp_atol would have no effect"]),
    # PETSc reads only what has a dash.
    ("pc_type hypre", ["\"pc_type\" is neither an option"]),
    ("-pc_type jacobi pc_view", ["\"pc_view\" is neither an option"])])
def test_options_of_petsc_that_would_not_solve_are_refused(buckens, options, words):
    buckens("run", BLOCKS, "--set", f"bodies.block.solver={{petsc: \"{options}\"}}").must(4, "block", *words, "correct the options of PETSc")


@iterates
def test_factors_of_petsc_solve(run):
    expected, _ = run("direct")
    for options in ("-ksp_type preonly -pc_type lu", "-ksp_type preonly -pc_type redundant", "-pc_type lu"):
        found, _ = run("found", "--set", f"bodies.block.solver={{petsc: \"{options}\"}}")
        assert largest_difference(found, expected) < 1e-8, options


@iterates
def test_the_tutorial(buckens, tmp_path):
    page = (SOURCE / "docs" / "tutorials" / "large.md").read_text()
    (tmp_path / "cube.yaml").write_text(re.search(r"```yaml\n(.*?)```", page, re.DOTALL)[1])
    commands = [line.split()[1:] for line in page.splitlines() if line.startswith("buckens ")]
    assert [words[0] for words in commands] == ["run", "run", "compare"]
    for words in commands[:2]:
        buckens(*words, "--set", "parameters.n=6").must(0)
    buckens(*commands[2], "--tolerance", "1e-8").must(0)


@iterates
def test_statics_and_modes(buckens, tmp_path):
    static = ("--set", "joints.ball={fixed: {between: [ground, block/bearing]}}",
              "--set", "joints.hinge={fixed: {between: [block/end, arm/begin]}}",
              "--set", "loads={pull: {force: {on: arm/corner_111, value: [0, 0, -0.2 N]}}}",
              "--set", "static={method: load, steps: 2}")
    buckens("static", BLOCKS, "-o", "direct", *static).must(0)
    buckens("static", BLOCKS, "-o", "iterative", *static, *ITERATE).must(0)
    assert largest_difference(sensors(tmp_path / "iterative"), sensors(tmp_path / "direct")) < 1e-8

    def frequencies(*options):
        report = buckens("modes", BLOCKS, "--count", 4, "--method", "subspace", "--json", *options).must(0).json
        return [mode["frequency"] for analysis in report["analyses"] for mode in analysis["modes"]]

    assert frequencies(*ITERATE) == pytest.approx(frequencies(), rel=1e-9)
    system = ("--system", *static)
    report = [buckens("modes", BLOCKS, "--count", 4, "--json", *system, *more).must(0).json for more in ((), ITERATE)]
    direct, found = ([mode["frequency"] for mode in r["analyses"][0]["modes"]] for r in report)
    assert found == pytest.approx(direct, rel=1e-9)


def test_an_automatic_choice_says_why(run):
    expected, _ = run("direct")
    found, summary = run("auto", "--set", "bodies.block.solver=auto", "--set", "bodies.arm.solver=auto")
    note = [note for note in summary["notes"] if "solver" in note]
    assert len(note) == 2 and "body \"block\"" in note[0] and "direct, since" in note[0] and "GB" in note[0]
    assert all((found[name] == expected[name]).all() for name in expected)


# The address space that the program believes to have. A real limit so low would leave no room for its own libraries.
LITTLE_MEMORY = """
#define _GNU_SOURCE
#include <stddef.h>
#include <sys/resource.h>
int getrlimit(__rlimit_resource_t resource, struct rlimit* limit) {
  const int failed = prlimit(0, resource, NULL, limit);
  if (resource == RLIMIT_AS) limit->rlim_cur = 600000;
  return failed;
}
"""


@pytest.fixture
def little_memory(tmp_path):
    """An environment in which the program believes that 0.6 MB is all there is."""
    compiler = shutil.which("cc")
    if compiler is None:
        pytest.skip("no C compiler")
    (tmp_path / "limit.c").write_text(LITTLE_MEMORY)
    subprocess.run([compiler, "-shared", "-fPIC", "-o", "limit.so", "limit.c"], cwd=tmp_path, check=True)
    return {**os.environ, "LD_PRELOAD": str(tmp_path / "limit.so")}


AUTO = ("--set", "bodies.block.solver=auto", "--set", "bodies.arm.solver=auto",
        "--set", "bodies.arm.mesh.box.divisions=[4, 1, 1]")


@iterates
def test_an_automatic_choice_iterates_where_memory_is_short(run, buckens, little_memory, tmp_path):
    """The factor of the block takes more than half of the memory, that of the arm does not; results stay the same."""
    expected, _ = run("direct", *AUTO)
    summary = buckens("run", BLOCKS, "-o", "little", "--json", *AUTO, env=little_memory).must(0).json
    block, arm = (note for note in summary["notes"] if "solver" in note)
    sizes = re.search(r"body \"block\": `solver: auto` is iterative, since the factor of 480 variables is predicted to take (\S+) GB, "
                      r"(\S+) GB while it is computed \(usable: 0.0003 GB\)$", block)
    assert sizes and 0.0003 < float(sizes[2]) < 480 * 481 / 2 * 8e-9 and 0 < float(sizes[1]) <= float(sizes[2])
    assert "body \"arm\"" in arm and "direct, since no factor of 60 variables" in arm
    bodies = summary["bodies"]
    assert bodies["block"]["factorisations"] == 0 and bodies["block"]["iterations_per_solve"] > 1
    assert bodies["arm"]["factorisations"] == 1 and "iterations_per_solve" not in bodies["arm"]
    assert 0 < largest_difference(sensors(tmp_path / "little"), expected) < 1e-8


def test_an_automatic_choice_does_without_the_plug_in(run, buckens, little_memory, tmp_path):
    expected, _ = run("direct", *AUTO)
    away = {**little_memory, "BUCKENS_GRID_PLUGIN": "/nowhere/libbuckens_petsc.so"}
    summary = buckens("run", BLOCKS, "-o", "little", "--json", *AUTO, env=away).must(0).json
    assert any("block" in note and "direct, although the factor of 480 variables" in note and "no iterative solver" in note
               for note in summary["notes"])
    found = sensors(tmp_path / "little")
    assert all((found[name] == expected[name]).all() for name in expected)


def test_without_the_plug_in_the_package_is_named(buckens):
    away = {**os.environ, "BUCKENS_GRID_PLUGIN": "/nowhere/libbuckens_petsc.so"}
    for verb in ("check", "run", "modes"):
        buckens(verb, BLOCKS, *ITERATE, env=away).must(
            2, "block", "solver: iterative", "libpetsc-real-dev", "BUCKENS_PETSC", "leave `solver` out")
    # What does not need it does not ask for it.
    buckens("check", BLOCKS, "--set", "bodies.block.solver=auto", env=away).must(0)


@pytest.mark.parametrize("settings, words", [
    (["bodies.block.solver=iterativ"], ["solver", "iterativ", "direct, iterative"]),
    (["bodies.block.solver={kind: direct, petsc: -pc_type jacobi}"], ["petsc", "kind: iterative"]),
    (["bodies.block.solver=iterative", "bodies.block.reduction={free-free: 4}"], ["solver", "reduced", "direct"]),
    (["bodies.block.solver=iterative", "bodies.block.flexibility=quasi-static"], ["solver", "quasi-static"]),
    (["bodies.block.solver=iterative", "bodies.block.frames=2"], ["solver", "several frames", "frames: 1"]),
    (["bodies.block.solver={tolerance: 1}"], ["tolerance", "solver"]),
])
def test_what_does_not_fit_is_refused(buckens, settings, words):
    options = [part for setting in settings for part in ("--set", setting)]
    buckens("check", BLOCKS, *options).must(2, *words)


def test_a_rigid_body_has_nothing_to_solve(buckens, models):
    buckens("check", models / "pendulum.yaml", "--set", "bodies.rod.solver=iterative").must(2, "solver", "rigid body")
