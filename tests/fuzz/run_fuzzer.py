#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs a libFuzzer program for some seconds on its seeds; shows the input that broke it."""

import argparse
import pathlib
import re
import subprocess
import sys
import tempfile


def arguments_of(options, scratch):
    """All options of libFuzzer. New inputs and artifacts go to the scratch directory."""
    (scratch / "found").mkdir()
    arguments = [options.program, f"-max_total_time={options.seconds}", f"-seed={options.seed}",
                 # A reader of a few kilobytes needs neither; with the sanitizer's own share. Inputs
                 # take milliseconds, but time is that of the clock and machines have other work.
                 "-rss_limit_mb=1024", "-malloc_limit_mb=256", "-timeout=30", "-max_len=8192",
                 "-print_final_stats=1", f"-artifact_prefix={scratch}/"]
    if options.dictionary:
        arguments.append(f"-dict={options.dictionary}")
    return arguments + [scratch / "found", options.corpus]


def show_input(path):
    content = path.read_bytes()
    print(f"input that broke it, {len(content)} bytes:\n{content!r}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("corpus", type=pathlib.Path)
    parser.add_argument("--dictionary", type=pathlib.Path)
    parser.add_argument("--seconds", type=int, default=5)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", type=pathlib.Path, help="directory for new inputs")
    options = parser.parse_args()
    if not any(options.corpus.iterdir()):
        sys.exit(f"{options.corpus}: there are no seeds")
    with tempfile.TemporaryDirectory() as name:
        scratch = pathlib.Path(name)
        process = subprocess.run(list(map(str, arguments_of(options, scratch))),
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                 errors="replace", text=True, check=False)
        runs = re.search(r"stat::number_of_executed_units: (\d+)", process.stdout)
        artifacts = [path for path in scratch.iterdir() if path.is_file()]
        if options.keep:
            options.keep.mkdir(parents=True, exist_ok=True)
            for path in [*artifacts, *(scratch / "found").iterdir()]:
                (options.keep / path.name).write_bytes(path.read_bytes())
        # "slow-unit" is a remark, not a failure; a time-out ends with an error code.
        if process.returncode == 0 and runs and int(runs.group(1)) > 0:
            print(f"{options.program.name}: {runs.group(1)} inputs")
            return
        print(process.stdout[-8000:])
        for path in artifacts:
            show_input(path)
    sys.exit(f"{options.program.name}: failed, exit code {process.returncode}")


if __name__ == "__main__":
    main()
