# SPDX-License-Identifier: Apache-2.0
"""One large cube of solids whose factor is distributed over several processes: memory of each, time of a step.

    bench/several_processes.py PROGRAM --side 31 --processes 1 2 4
    bench/several_processes.py                                      writes the tables again

Adds the runs to docs/developers/several_processes.json and writes the tables of docs/developers/several-processes.md; with `--into FILE`, only to that
file. One process has the factor of the program itself; `--mumps` lets it use MUMPS, too. Times are wall times: several processes on fewer processors
share them. Messages and bytes are those of all processes, MUMPS included, as Open MPI counts them (its component `monitoring`); those of a step are the
difference of a long and a short run.
"""

import argparse
import datetime
import json
import os
import pathlib
import subprocess
import tempfile
import time

import processes_table
from large_bodies import MODEL

MUMPS = "{petsc: \"-ksp_type preonly -pc_type cholesky -pc_factor_mat_solver_type mumps\"}"
# As root, and with more processes than processors.
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_mpi_yield_when_idle": "1",
               "OMPI_MCA_btl_vader_single_copy_mechanism": "none"}


def memory_now(started):
    """Memory of the processes that serve, by rank: largest so far, now, and now if pages that several of them have, of program and libraries,
    count in equal shares [bytes]."""
    found = {}
    for entry in pathlib.Path("/proc").iterdir():
        try:
            environment = (entry / "environ").read_bytes().split(b"\0")
            if f"BUCKENS_BENCH_RUN={started}".encode() not in environment:
                continue
            ranks = [int(v.split(b"=")[1]) for v in environment if v.startswith(b"OMPI_COMM_WORLD_RANK=")]
            status = (entry / "status").read_text() + (entry / "smaps_rollup").read_text()
        except (OSError, IndexError):
            continue
        values = {line.split(":")[0]: 1024 * int(line.split()[1]) for line in status.splitlines() if line.startswith(("VmHWM", "VmRSS", "Pss:"))}
        if len(values) < 3 or "Name:\tbuckens" not in status:
            continue
        rank = ranks[0] if ranks else 0
        of_rank = (values["VmHWM"], values["VmRSS"], values["Pss"])
        found[rank] = tuple(max(pair) for pair in zip(found.get(rank, (0, 0, 0)), of_rank))
    return found


def number_of_records(out):
    """So far."""
    file = out / "sensors.csv"
    return max(0, len(file.read_text().splitlines()) - 1) if file.exists() else 0


def traffic(folder):
    """Messages and bytes that all processes have sent, those within collective calls included."""
    messages, size = 0, 0
    for profile in pathlib.Path(folder).glob("sent.*.prof"):
        for line in profile.read_text().splitlines():
            words = line.split()
            if words[0] in ("E", "I"):
                size += int(words[3])
                messages += int(words[5])
    return messages, size


def run(program, side, processes, steps, solver):
    with tempfile.TemporaryDirectory() as folder:
        model = pathlib.Path(folder) / "cube.yaml"
        model.write_text(MODEL.format(side=side, solver=solver, steps=steps))
        out = pathlib.Path(folder) / "out"
        command = [program, "run", str(model), "-o", str(out), "--quiet"]
        if processes > 1:
            command = ["mpirun", "-n", str(processes), "--bind-to", "none", "--mca", "pml_monitoring_enable", "2",
                       "--mca", "pml_monitoring_enable_output", "3", "--mca", "pml_monitoring_filename", folder + "/sent", *command]
        process = subprocess.Popen(command, env={**ENVIRONMENT, "BUCKENS_BENCH_RUN": folder})
        memory, while_stepping, in_shares = {}, {}, {}
        while process.poll() is None:
            records = number_of_records(out)
            for rank, (most, now, share) in memory_now(folder).items():
                memory[rank] = max(memory.get(rank, 0), most)
                in_shares[rank] = max(in_shares.get(rank, 0), share)
                # Not the end of a run, where its state is saved.
                if 2 <= records < steps:
                    while_stepping[rank] = max(while_stepping.get(rank, 0), now)
            time.sleep(0.05)
        if process.returncode != 0:
            raise SystemExit(f"{processes} processes: the program ended with {process.returncode}")
        summary = json.loads((out / "summary.json").read_text())
        return summary, [[of[rank] for rank in sorted(of)] for of in (memory, while_stepping, in_shares)], traffic(folder)


def measure(program, side, processes, steps, solver):
    few = max(2, steps // 4)
    short, _, sent_before = run(program, side, processes, few, solver) if processes > 1 else ({}, [[], [], []], (0, 0))
    summary, memory, sent = run(program, side, processes, few + steps, solver)
    per_step = [(a - b) / steps for a, b in zip(sent, sent_before)]
    body = summary["bodies"]["cube"]
    return {"side": side, "variables": body["dof"], "processes": processes,
            "solver": "MUMPS" if solver == MUMPS or processes > 1 else "own",
            "setup_seconds": summary["wall_seconds"]["setup"],
            "factor_seconds": summary["wall_seconds"]["preparation"]["factor"],
            "solve_seconds": summary["wall_seconds"]["phases"]["large_solves"] / body["solves"],
            "step_seconds": summary["wall_seconds"]["stepping"] / summary["steps"],
            "solves": body["solves"], "steps": summary["steps"], "peak_bytes": memory[0], "stepping_bytes": memory[1],
            "peak_bytes_in_shares": memory[2],
            "messages_per_step": per_step[0], "bytes_per_step": per_step[1],
            "solves_per_step": (body["solves"] - (short["bodies"]["cube"]["solves"] if short else 0)) / steps if short else
            body["solves"] / summary["steps"],
            "own_messages_per_step": summary.get("measures", {}).get("messages_per_step", 0),
            "own_bytes_per_step": summary.get("measures", {}).get("bytes_per_step", 0),
            "all_messages": sent[0], "all_bytes": sent[1],
            "processors": os.cpu_count(), "load": os.getloadavg()[0],
            "date": datetime.datetime.now().strftime("%Y-%m-%d")}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", help="buckens, built with BUCKENS_MPI=ON; none: no run")
    parser.add_argument("--side", type=int, default=31, help="elements along an edge")
    parser.add_argument("--processes", type=int, nargs="*", default=[1, 2, 4])
    parser.add_argument("--steps", type=int, default=20)
    parser.add_argument("--mumps", action="store_true", help="MUMPS for one process, too")
    parser.add_argument("--into", type=pathlib.Path, default=processes_table.RESULTS, help="file with the figures")
    arguments = parser.parse_args()
    rows = json.loads(arguments.into.read_text()) if arguments.into.exists() else []
    for processes in arguments.processes if arguments.program else []:
        row = measure(arguments.program, arguments.side, processes, arguments.steps,
                      MUMPS if arguments.mumps else "direct")
        key = (row["side"], row["solver"], row["processes"])
        rows = [r for r in rows if (r["side"], r["solver"], r["processes"]) != key] + [row]
        rows.sort(key=lambda r: (r["side"], r["processes"], r["solver"]))
        arguments.into.write_text(json.dumps(rows, indent=1) + "\n")
        print("| {variables} | {processes} | {solver} | {setup_seconds:.1f} | {solve_seconds:.3f} | {step_seconds:.3f} | ".format(**row)
              + " | ".join(", ".join(f"{m / 1e9:.2f}" for m in row[key]) for key in ("peak_bytes", "peak_bytes_in_shares", "stepping_bytes"))
              + " | {messages_per_step:.0f} | {0:.2f} |".format(row["bytes_per_step"] / 1e6, **row), flush=True)
    if arguments.into == processes_table.RESULTS:
        processes_table.write(rows)


if __name__ == "__main__":
    main()
