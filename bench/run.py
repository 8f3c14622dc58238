#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures the speed of Buckens and stores the figures.

    python3 bench/run.py                      all sections, about 25 minutes
    python3 bench/run.py solves:3 steps       single ones; `--list` names them

Every section is measured in one go and replaces what docs/developers/benchmarks.json held of it, with
its date, processor and the load of the machine before it began. Afterwards bench/table.py writes the
tables in docs/developers/benchmarks.md.
"""

import argparse
import datetime
import json
import os
import pathlib
import platform
import subprocess
import sys
import tempfile
import time

import preparation
import table

ROOT = pathlib.Path(__file__).resolve().parent.parent
RESULTS = ROOT / "docs/developers/benchmarks.json"

# Blocks by number of variables: cubes, and a slender one of 1 x 0.1 x 0.1 m.
BLOCKS = {
    "3000": ["hex8:9,9,9", "tet10:5,5,4"],
    "10000": ["hex8:14,14,14", "tet10:7,7,7"],
    "30000": ["hex8:21,21,21", "tet10:11,10,10"],
    "slender": ["hex8:274,10,10", "tet10:137,5,5"],
    "100000": ["hex8:31,31,31", "tet10:16,16,15"],
    "300000": ["hex8:45,45,45", "tet10:23,23,22"],
}
SMALL = ["3000", "10000", "30000"]


class Programs:
    def __init__(self, build):
        self.build = pathlib.Path(build).resolve()

    def bench(self, name, *arguments):
        """The JSON output of a program of bench/."""
        command = [str(self.build / "bench" / name), *map(str, arguments)]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            return {"command": " ".join(command[1:]), "error": reason(done)}
        return json.loads(done.stdout)

    def google(self, name, pattern):
        """Results of Google Benchmark: name, time [s], counters."""
        out = self.bench(name, f"--benchmark_filter={pattern}", "--benchmark_format=json",
                         "--benchmark_repetitions=3", "--benchmark_min_time=0.1")
        if "error" in out:
            sys.exit(f"{out['command']}: {out['error']}")
        best, times = {}, {}
        for entry in out["benchmarks"]:
            if entry["run_type"] == "aggregate" or entry.get("error_occurred"):
                continue
            scale = {"us": 1e-6, "ms": 1e-3, "ns": 1e-9, "s": 1.0}[entry["time_unit"]]
            row = {key: value for key, value in entry.items()
                   if key not in TIMING and isinstance(value, (int, float))}
            row.update(name=entry["run_name"], seconds=scale * entry["real_time"])
            times.setdefault(row["name"], []).append(row["seconds"])
            if row["name"] not in best or row["seconds"] < best[row["name"]]["seconds"]:
                best[row["name"]] = row
        for name, row in best.items():
            row["all_seconds"] = sorted(times[name])
        return list(best.values())

    @property
    def buckens(self):
        return str(self.build / "bin" / "buckens")


TIMING = {"family_index", "per_family_instance_index", "repetitions", "repetition_index", "threads",
          "iterations", "cpu_time", "real_time"}


def reason(done):
    text = (done.stderr or done.stdout).strip().splitlines()
    return text[-1] if text else f"ended with {done.returncode}"


def solves(programs, size):
    budget = 0.3 if size in SMALL else 1.0
    return [programs.bench("solve_bench", block, "--budget", budget) for block in BLOCKS[size]]


def tree(programs, size):
    budget = 0.3 if size in SMALL else 1.0
    return [programs.bench("tree_bench", block, "--budget", budget) for block in BLOCKS[size]]


def steps(programs, size):
    budget = 0.5 if size in SMALL else 2.0
    options = ["--budget", budget]
    if size == "300000":  # three more factorisations of each would take long
        options += ["--levels", "full", "--threads", "1", "--before", 4, "--no-reference"]
    return [programs.bench("solid_step_bench", block, *options) for block in BLOCKS[size]]


def setup(programs, size):
    return [programs.bench("solid_step_bench", block, "--setup") for block in BLOCKS[size]]


def variants(programs, size):
    block = BLOCKS[size][0]
    steps = 10 if size == "slender" else 30
    return [programs.bench("variant_bench", block, "--steps", steps, "--together", "6,32")]


def vibrations(programs, body, method, threads):
    """20 lowest free vibrations of a body, as `buckens modes --json` prints them; or what it says of an error."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "model.json"
        path.write_text(json.dumps({"buckens": 1, "bodies": {"b": body}}))
        done = subprocess.run([programs.buckens, "modes", path, "--json", "--count", "20", "--method", method,
                               "--threads", str(threads)],
                              capture_output=True, text=True, check=False)
    if done.returncode != 0:
        return None, reason(done)
    return json.loads(done.stdout)["analyses"][0], None


def modes(programs, size):
    """20 lowest free vibrations, factorisation included, by both methods; three times by that of the goals, also on two threads."""
    out = []
    for block in BLOCKS[size]:
        kind, divisions = block.split(":")
        counts = [int(n) for n in divisions.split(",")]
        length = 1.0 if counts[0] > 4 * counts[1] else 0.1
        body = {"mesh": {"box": {"size": [length, 0.1, 0.1], "divisions": counts, "element": kind},
                         "material": {"E": 2.1e11, "nu": 0.3, "rho": 7850}}}
        for method, threads, times in (("subspace", 1, 3), ("subspace", 2, 3), ("spectra", 1, 1)):
            row = {"element": kind, "divisions": " x ".join(map(str, counts)), "method": method, "threads": threads}
            seconds = []
            for _ in range(times):
                found, error = vibrations(programs, body, method, threads)
                if error:
                    row["error"] = error
                    break
                seconds.append(found["work"]["seconds"])
                row.update(dof=found["dof"], solves=found["work"]["solves"],
                           highest=found["modes"][-1]["frequency"])
            if "error" not in row:
                row.update(seconds=min(seconds), all_seconds=sorted(seconds))
            out.append(row)
    return out


def reduced(programs):
    return programs.google("step_bench", "reduced_step")


def chains(programs):
    return programs.google("step_bench", "rigid_chain_step")


def machines(programs):
    return programs.google("machine_bench", "_step")


def frames(programs):
    return programs.google("step_bench", "planar_beam_step|divided_beam_step|divided_tree_step")


def beams(programs):
    return programs.google("step_bench", "beam_solve|^beam_step")


def prepare(programs, size):
    blocks = [preparation.LARGER] if size == "300000" else BLOCKS[size][:1]
    return [row for block in blocks for row in preparation.rows(programs.buckens, block)]


def processes_memory(pid):
    """Resident bytes of a process; 0 if it has ended."""
    try:
        for line in pathlib.Path(f"/proc/{pid}/status").read_text().splitlines():
            if line.startswith("VmRSS"):
                return 1024 * int(line.split()[1])
    except OSError:
        pass
    return 0


def memory(programs, size):
    """100 steps of `buckens run`: resident memory towards the end, and its peak."""
    out = []
    for block in BLOCKS[size]:
        kind, divisions = block.split(":")
        counts = [int(n) for n in divisions.split(",")]
        length = 1.0 if counts[0] > 4 * counts[1] else 0.1
        model = {
            "buckens": 1, "gravity": [0, -9.81, 0],
            "bodies": {"block": {"mesh": {
                "box": {"size": [length, 0.1, 0.1], "divisions": counts, "element": kind},
                "material": {"E": 2.1e11, "nu": 0.3, "rho": 7850}}}},
            "joints": {"pin": {"spherical": {"between": ["ground", "block/corner_000"]}}},
            "simulation": {"duration": 0.01, "step": 1e-4},
            "output": {"every": 0.001, "sensors": {"tip": {"position": "block/corner_100"}}}}
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "model.json"
            path.write_text(json.dumps(model))
            run = subprocess.Popen([programs.buckens, "run", path, "-o", f"{folder}/out", "--quiet"],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            seen = []
            while run.poll() is None:
                seen.append(processes_memory(run.pid))
                time.sleep(0.05)
            row = {"element": kind, "divisions": " x ".join(map(str, counts)),
                   "peak_bytes": max(seen)}
            summary = pathlib.Path(folder) / "out" / "summary.json"
            if run.returncode == 0:
                told = json.loads(summary.read_text())
                # The samples of the second half of the run are taken while stepping.
                stepping = told["wall_seconds"]["stepping"]
                last = seen[-max(2, int(0.5 * stepping / 0.05)):-1] or seen[-1:]
                row.update(resident_bytes=sorted(last)[len(last) // 2], steps=told["steps"],
                           dof=told["bodies"]["block"]["dof"], wall_seconds=told["wall_seconds"])
            else:
                row["error"] = (run.stderr.read() or "").strip()[-200:]
            out.append(row)
    return out


SECTIONS = {}
for key in BLOCKS:
    SECTIONS[f"solves:{key}"] = lambda p, size=key: solves(p, size)
    SECTIONS[f"tree:{key}"] = lambda p, size=key: tree(p, size)
    SECTIONS[f"steps:{key}"] = lambda p, size=key: steps(p, size)
    if key != "300000":
        SECTIONS[f"setup:{key}"] = lambda p, size=key: setup(p, size)
        SECTIONS[f"modes:{key}"] = lambda p, size=key: modes(p, size)
    if key in ("30000", "slender"):
        SECTIONS[f"variants:{key}"] = lambda p, size=key: variants(p, size)
    if key in ("slender", "100000", "300000"):
        SECTIONS[f"preparation:{key}"] = lambda p, size=key: prepare(p, size)
    if key in ("30000", "slender", "100000", "300000"):
        SECTIONS[f"memory:{key}"] = lambda p, size=key: memory(p, size)
SECTIONS.update({"reduced": reduced, "chains": chains, "machines": machines, "frames": frames, "beams": beams})


def context():
    return {"date": datetime.datetime.now().strftime("%Y-%m-%d %H:%M"),
            "processor": table.processor(), "cores": os.cpu_count(),
            "system": platform.release(), "load": os.getloadavg()[0]}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("sections", nargs="*", help="names, or what they begin with; default all")
    parser.add_argument("--build", default=ROOT / "build/release", help="build directory")
    parser.add_argument("--results", default=RESULTS, type=pathlib.Path)
    parser.add_argument("--list", action="store_true")
    arguments = parser.parse_args()
    if arguments.list:
        print("\n".join(SECTIONS))
        return
    wanted = [name for name in SECTIONS if not arguments.sections or any(
        name == begin or name.startswith(begin + ":") for begin in arguments.sections)]
    if not wanted:
        sys.exit("no such section; --list names them")
    programs = Programs(arguments.build)
    for name in wanted:
        about = context()
        start = time.monotonic()
        rows = SECTIONS[name](programs)
        about["seconds"] = time.monotonic() - start
        print(f"{name}: {about['seconds']:.0f} s", file=sys.stderr, flush=True)
        results = json.loads(arguments.results.read_text()) if arguments.results.exists() else {}
        results[name] = {"context": about, "rows": rows}
        arguments.results.write_text(json.dumps(results, indent=1) + "\n")
    table.write(arguments.results)


if __name__ == "__main__":
    main()
