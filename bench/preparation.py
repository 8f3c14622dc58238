# SPDX-License-Identifier: Apache-2.0
"""What comes before the first step of `buckens run`, by phases, and what a record takes: on one and two threads, and with a stored factor."""

import json
import pathlib
import subprocess
import tempfile

STEPS = 10
LARGER = "hex8:822,10,10"  # 298 749 variables: a second run has its factor on the disk
FIELDS = ["displacement", "stress", "von-mises"]


def block_of(text):
    """Element and divisions of "hex8:31,31,31"."""
    kind, divisions = text.split(":")
    return kind, [int(n) for n in divisions.split(",")]


def model(block):
    kind, counts = block_of(block)
    # Elements of blocks that are longer than they are wide are a little shorter than they are wide.
    length = 0.1 if counts[0] <= 4 * counts[1] else round(counts[0] / counts[1] / 27.4, 3)
    return {
        "buckens": 1,
        "bodies": {"block": {"mesh": {"box": {"size": [length, 0.1, 0.1], "divisions": counts, "element": kind},
                                      "material": {"E": 2.1e11, "nu": 0.3, "rho": 7850}}}},
        "simulation": {"duration": 1e-4 * STEPS, "step": 1e-4},
        "output": {"every": 1e-4, "fields": {"every": 1e-4, "record": FIELDS}}}


def run(program, folder, arguments):
    done = subprocess.run([program, "run", folder / "model.json", "-q", "-o", folder / "out", *arguments], capture_output=True, text=True,
                          check=False)
    if done.returncode != 0:
        return None, (done.stderr or done.stdout).strip().splitlines()[-1]
    return json.loads((folder / "out" / "summary.json").read_text()), None


def rows(program, block, times=3):
    """One per number of threads, then one with the factor that the run before it has stored; each the fastest of several."""
    kind, counts = block_of(block)
    out = []
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        (folder / "model.json").write_text(json.dumps(model(block)))
        stored = ["--factors", folder / "factors"]
        for threads, more in ((1, []), (2, []), (2, stored)):
            row = {"element": kind, "divisions": " x ".join(map(str, counts)), "threads": threads, "stored": bool(more)}
            if more:
                run(program, folder, ["--threads", str(threads), *more])
            for _ in range(times):
                summary, error = run(program, folder, ["--threads", str(threads), *more])
                if error:
                    row["error"] = error
                    break
                wall = summary["wall_seconds"]
                total = sum(wall["preparation"].values())
                row.setdefault("all_seconds", []).append(total)
                row["record"] = min(row.get("record", 1e9), wall["phases"]["recording"] / STEPS)
                if total == min(row["all_seconds"]):
                    row.update(seconds=total, phases=wall["preparation"], dof=summary["bodies"]["block"]["dof"])
            row.get("all_seconds", []).sort()
            out.append(row)
    return out
