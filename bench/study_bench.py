#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What a study costs beyond its variants, and how it grows with the number of workers.

usage: PYTHONPATH=build/release/python python3 bench/study_bench.py [--variants N] [--duration SECONDS] [--processes 1,2,4,8,16]
           [--rounds N]

Prints a table: processes, wall time, efficiency against one process that runs the same variants in a loop (as far as there are
processors), and overhead per variant. `bare` is what the machine allows: as many loops at the same time, each with its share of
the variants and nothing to hand out. Other users of the host change its speed, so each round measures all of it again, ratios
are formed within a round, and medians of the rounds are shown, with the least and the largest efficiency. Then the load of the
process that hands out variants, measured with variants that do nothing, and from it how long variants have to last for 1000
workers: a prediction.
"""

import argparse
import concurrent.futures as cf
import os
import pathlib
import tempfile
import time

from buckens import _core, study_runs
from buckens.study_worker import Done
from buckens.verbs import sweep

MODEL = """
buckens: 1
gravity: [0, -9.81 m/s^2, 0]
planar: xy
parameters: {push: 1 N}
materials: {steel: {E: 210 GPa, nu: 0.3, rho: 7850 kg/m^3}}
bodies: {rod: {beam: {to: [1 m, 0, 0], elements: 8, section: {circle: {diameter: 8 mm}}, material: steel}}}
joints: {pin: {revolute: {between: [ground, rod/start]}}}
loads: {push: {force: {on: rod/end, value: [0, push, 0]}}}
simulation: {duration: 20 ms, step: 0.1 ms}
output: {every: 1 ms, sensors: {tip: {position: rod/end}}}
"""
PATH = "parameters.push"


def table(count):
    return {PATH: [0.001 * k for k in range(count)]}


def seconds_in_a_loop(model, count, changes):
    """The variants alone, in this process."""
    rows = _core.VariantRows(str(model), changes, [PATH])
    variants = [(str(k), [str(0.001 * k)]) for k in range(count)]
    rows.run(variants[:6])
    start = time.perf_counter()
    for k in range(0, count, 6):
        rows.run(variants[k:k + 6])
    return time.perf_counter() - start


def seconds_of_loops(processes, model, count, changes):
    """So many loops at the same time, from the first to begin to the last to end."""
    import multiprocessing

    context = multiprocessing.get_context("forkserver")
    with cf.ProcessPoolExecutor(processes, context) as executor:
        share = count // processes
        loops = [executor.submit(seconds_in_a_loop, model, share, changes) for _ in range(processes)]
        return max(loop.result() for loop in loops) * count / (share * processes)


def seconds_with(processes, model, count, folder, changes):
    """By a pool that is already there: its start is the same for ten variants and ten thousand."""
    import multiprocessing

    with cf.ProcessPoolExecutor(processes, multiprocessing.get_context("forkserver")) as executor:
        sweep(model, table(12 * processes), folder / f"warm{processes}", set=changes, executor=executor)
        start = time.perf_counter()
        answer = sweep(model, table(count), folder / f"out{processes}", set=changes, executor=executor)
        passed = time.perf_counter() - start
    assert all(variant["status"] == "done" for variant in answer["variants"])
    return passed, sum(answer["workers"].values())


def empty_task(study, task):
    """What run_task would return if variants took no time; the row is as long as a real one."""
    cells = [("name", "1"), (PATH, "1"), ("status", "done"), ("message", "")] + [
        (f"tip.{axis} [m] {kind}", "0.12345678901234567") for axis in "xyz" for kind in ("last", "min", "max")]
    rows = [{"key": key, "cells": cells, "seconds": 0.02} for wave in task.waves for key, _ in wave]
    return Done(rows, [], "nobody", 0.0, 0)


class Nobody(cf.Executor):
    """Runs tasks at once, in the process itself."""

    num_workers = 100

    def submit(self, function, *arguments):
        future = cf.Future()
        future.set_result(function(*arguments))
        return future


def load_of_the_master(model, count, folder):
    """Processor time per variant and per task of handing out, taking back and noting [s]."""
    real, tasks = study_runs.run_task, []
    study_runs.run_task = lambda study, task: tasks.append(1) or empty_task(study, task)
    try:
        start = time.process_time()
        sweep(model, table(count), folder / "empty", executor=Nobody())
        total = time.process_time() - start
    finally:
        study_runs.run_task = real
    return total / count, total / len(tasks), count / len(tasks)


def median(values):
    return sorted(values)[len(values) // 2]


def table_of(rounds, variants, processors):
    """Lines of the table. @param rounds one dictionary each: by number of processes (wall, wall of bare loops), and `alone`"""
    lines = ["processes   wall [s]   efficiency (range)    bare   overhead per variant [ms]"]
    for processes in (key for key in rounds[0] if key != "alone"):
        busy = min(processes, processors)
        efficiencies = sorted(one["alone"] / busy / one[processes][0] for one in rounds)
        bare = median([one["alone"] / busy / one[processes][1] for one in rounds])
        extra = median([one[processes][0] - one["alone"] / busy for one in rounds])
        lines.append(f"{processes:9}   {median([one[processes][0] for one in rounds]):8.2f}   {median(efficiencies):.3f} "
                     f"({efficiencies[0]:.3f}-{efficiencies[-1]:.3f})   {bare:5.3f}   {1e3 * extra / variants:10.2f}")
    return lines


def measured(given, model, folder, changes):
    """One round."""
    out = {"alone": seconds_in_a_loop(model, given.variants, changes)}
    for processes in map(int, given.processes.split(",")):
        place = pathlib.Path(tempfile.mkdtemp(dir=folder))
        out[processes] = (seconds_with(processes, model, given.variants, place, changes)[0],
                          seconds_of_loops(processes, model, given.variants, changes))
    return out


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--variants", type=int, default=600)
    arguments.add_argument("--duration", type=float, default=0.02, help="of a variant, simulated [s]")
    arguments.add_argument("--processes", default="1,2,4,8,16")
    arguments.add_argument("--rounds", type=int, default=1)
    given = arguments.parse_args()
    changes = [f"simulation.duration={given.duration!r} s"]
    processors = len(os.sched_getaffinity(0))
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        model = folder / "model.yaml"
        model.write_text(MODEL)
        print(f"{given.variants} variants, {processors} processors, load {os.getloadavg()[0]:.1f}", flush=True)
        rounds = [measured(given, model, folder, changes) for _ in range(given.rounds)]
        alone = median([one["alone"] for one in rounds])
        print(f"in a loop: {alone:.2f} s, {1e3 * alone / given.variants:.2f} ms each")
        print("\n".join(table_of(rounds, given.variants, processors)))
        variant, task, each = load_of_the_master(model, max(given.variants, 100), folder)
        print(f"handing out: {1e3 * variant:.3f} ms per variant, {1e3 * task:.2f} ms per task of {each:.0f}")
        print(f"prediction: with 1000 workers it is busy all the time if variants last {1000 * variant:.2f} s, a tenth of it if they "
              f"last {10000 * variant:.1f} s")


if __name__ == "__main__":
    main()
