#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares what steps cost with what they cost when it was last stored.

    python3 bench/guard.py            compares; fails where something costs more
    python3 bench/guard.py --store    stores the present counts in bench/guard.json

Counts (factorisations, solves, answers recycled, iterations, numbers read, allocations) do not depend
on the machine's load. Ratios are of times measured in turn in one run, the shortest of 400 steps each;
no absolute time is used.
"""

import argparse
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
STORED = ROOT / "bench/guard.json"

# Counts may differ between processors where rounding decides on an iteration more or less.
COUNT_SLACK = 0.02
# The shortest step is disturbed by other load on caches and memory only.
RATIO_SLACK = 0.5


def measure(build):
    program = pathlib.Path(build) / "bench/step_counts"
    return json.loads(subprocess.run([program], check=True, capture_output=True, text=True).stdout)


def dearer(found, stored):
    """Sentences on everything that costs more than what is stored, or is missing."""
    for case, counts in stored["counts"].items():
        now = found["counts"].get(case)
        if now is None:
            yield f"{case}: not measured any more; run bench/guard.py --store if that is meant"
            continue
        for name, before in counts.items():
            if name == "recycled":  # no cost; solves tell it
                continue
            if now.get(name, float("inf")) > before * (1 + COUNT_SLACK) + 1e-9:
                yield f"{case}: {name} {now.get(name)}, stored {before}"
    for name, before in stored["ratios"].items():
        if found["ratios"].get(name, float("inf")) > before * (1 + RATIO_SLACK):
            yield f"{name}: {found['ratios'].get(name)}, stored {before}"


def cheaper(found, stored):
    """What costs clearly less: to be stored, so that it stays so."""
    for case, counts in stored["counts"].items():
        for name, before in counts.items():
            now = found["counts"].get(case, {}).get(name)
            if now is not None and name != "recycled" and now < before * (1 - 5 * COUNT_SLACK):
                yield f"{case}: {name} {now}, stored {before}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--build", default=ROOT / "build/release", help="build tree")
    parser.add_argument("--store", action="store_true", help="store the present figures")
    arguments = parser.parse_args()
    found = measure(arguments.build)
    if arguments.store:
        STORED.write_text(json.dumps(found, indent=1) + "\n")
        return 0
    stored = json.loads(STORED.read_text())
    for line in cheaper(found, stored):
        print(f"cheaper: {line}")
    failures = list(dearer(found, stored))
    for line in failures:
        print(f"dearer: {line}")
    if not failures:
        print(f"{len(stored['counts'])} mechanisms cost no more than stored")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
