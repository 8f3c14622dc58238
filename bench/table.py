#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Turns files of Google Benchmark (--benchmark_out=FILE.json) into Markdown tables.

Names the date and the processor. `bound` is the time of reading the factor twice with the bandwidth
that the same run measured (read_memory) on the same number of threads.
"""

import json
import pathlib
import re
import sys


def processor():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return "an unknown processor"


def arguments_of(name):
    """solve/panels/block:3/sides:6/threads:2/real_time → ("solve/panels", {"block": 3, …})"""
    parts = [part for part in name.split("/") if part not in ("real_time", "iterations:1")]
    named = {key: int(value) for key, value in (p.split(":") for p in parts if ":" in p)}
    return "/".join(part for part in parts if ":" not in part), named


def bandwidths(benchmarks):
    """GB/s by number of threads."""
    return {int(re.search(r"read_memory/(\d+)", b["name"]).group(1)): b["GB/s"]
            for b in benchmarks if b["name"].startswith("read_memory")}


def solve_rows(benchmarks):
    rows = {}
    for b in benchmarks:
        name, args = arguments_of(b["name"])
        if not name.startswith("solve/"):
            continue
        row = rows.setdefault(args["block"], {"dof": b["dof"]})
        if name == "solve/panels":
            row["MB"] = b["MB"]
        row[name, args["sides"], args["threads"]] = b["real_time"]
    return [rows[block] for block in sorted(rows)]


def print_solves(benchmarks):
    speed = bandwidths(benchmarks)
    print("| DOF | panels [MB] | CHOLMOD, 1 rhs | panels, 1 rhs | of CHOLMOD | bound | 2 threads | of 1 | 6 rhs "
          "| 32 rhs | CHOLMOD, 6 rhs |")
    print("|---" * 11 + "|")
    for row in solve_rows(benchmarks):
        def time(route, sides, threads, row=row):
            return row.get((f"solve/{route}", sides, threads), float("nan"))
        one = time("panels", 1, 1)
        bound = 2.0 * row["MB"] / speed[1] if 1 in speed else float("nan")
        print(f"| {row['dof']:.0f} | {row['MB']:.0f} | {time('cholmod', 1, 1):.2f} | {one:.2f} "
              f"| {one / time('cholmod', 1, 1):.2f} | {bound:.2f} | {time('panels', 1, 2):.2f} "
              f"| {time('panels', 1, 2) / one:.2f} | {time('panels', 6, 1):.2f} "
              f"| {time('panels', 32, 1):.2f} | {time('cholmod', 6, 1):.2f} |")


def print_others(benchmarks):
    known = {"name", "run_name", "run_type", "family_index", "per_family_instance_index",
             "repetitions", "repetition_index", "threads", "iterations", "cpu_time", "real_time",
             "time_unit"}
    for b in benchmarks:
        name, args = arguments_of(b["name"])
        if name.startswith("solve/"):
            continue
        counters = ", ".join(f"{key} {value:.4g}" for key, value in b.items()
                             if key not in known and isinstance(value, (int, float)))
        threads = f", {args['threads']} threads" if "threads" in args else ""
        print(f"| `{name}`{threads} | {b['real_time']:.4g} {b['time_unit']} | {counters} |")


def main(paths):
    for path in paths:
        data = json.loads(pathlib.Path(path).read_text())
        print(f"{data['context']['date'][:10]}, {processor()}, {data['context']['num_cpus']} cores, "
              f"load {data['context']['load_avg'][0]:.1f} at the start. Times in ms.\n")
        benchmarks = [b for b in data["benchmarks"] if b.get("run_type") != "aggregate"]
        if any(b["name"].startswith("solve/") for b in benchmarks):
            print_solves(benchmarks)
            print()
        print("| what | time | |\n|---|---|---|")
        print_others(benchmarks)
        print()


if __name__ == "__main__":
    main(sys.argv[1:])
