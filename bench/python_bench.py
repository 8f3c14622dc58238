#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What a step costs when it is taken from Python, and what a force function costs per call.

usage: PYTHONPATH=build/release/python python3 bench/python_bench.py
"""

import time

import buckens

STEPS, REPEATS = 20_000, 7
TREE = {
    "gravity": [0, 0, -9.81],
    "bodies": {"ball": {"rigid": {"mass": 1, "inertia": [1, 1, 1]}}},
    "simulation": {"duration": STEPS * 1e-4, "step": 1e-4},
}


def seconds(work):
    start = time.process_time()
    work()
    return time.process_time() - start


def best_per_step(make, advance):
    """Least time per step [us] of several runs, without the set-up."""
    return min(seconds(lambda sim=make(): advance(sim)) for _ in range(REPEATS)) / STEPS * 1e6


def one_by_one(sim):
    while sim.step():
        pass


def with_force(calls):
    model = buckens.Model.from_dict(TREE)

    @model.force("ball")
    def push(t, x, v):
        calls.append(None)
        return (0.0, 0.0, 0.0)

    return buckens.Simulation(model, record=False)


def main():
    plain = buckens.Model.from_dict(TREE)
    inside = best_per_step(lambda: buckens.Simulation(plain, record=False),
                           lambda sim: sim.advance(sim.end_time))
    outside = best_per_step(lambda: buckens.Simulation(plain, record=False), one_by_one)
    calls = []
    forced = best_per_step(lambda: (calls.clear(), with_force(calls))[1],
                           lambda sim: sim.advance(sim.end_time))
    per_step = len(calls) / STEPS
    print(f"step within the library        {inside:7.2f} us")
    print(f"step taken from Python         {outside:7.2f} us   (+{outside - inside:.2f} us)")
    print(f"step with a force in Python    {forced:7.2f} us   {per_step:.1f} calls, "
          f"{(forced - inside) / per_step:.2f} us each")


if __name__ == "__main__":
    main()
