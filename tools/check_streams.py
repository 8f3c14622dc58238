#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The library (src/buckens without its tests) never prints, never ends the process, and takes no
unrepeatable random numbers: no std::cout/cerr/clog, printf, abort, exit, rand in it. Nor does it
choose a locale, which belongs to the whole process."""

import argparse
import re
import sys

import source_files

FORBIDDEN = [
    (re.compile(r"\bstd\s*::\s*w?(cout|cerr|clog)\b|#\s*include\s*<iostream>"),
     "writes to the terminal; give the text to the log of base, or throw"),
    (re.compile(r"(?<![\w.>])(std\s*::\s*)?(v?printf|puts|putchar|perror)\s*\("),
     "writes to the terminal; give the text to the log of base, or throw"),
    (re.compile(r"\bv?fprintf\s*\(\s*std(out|err)\b|\bfmt\s*::\s*print(ln)?\s*\("),
     "writes to the terminal; give the text to the log of base, or throw"),
    (re.compile(r"(?<![\w.>])(std\s*::\s*)?(abort|_?[eE]xit|quick_exit|terminate)\s*\("),
     "ends the process; throw an exception of base/errors.h"),
    (re.compile(r"(?<![\w.>])(std\s*::\s*)?(rand|srand|random_device)\b(?=\s*[({])"
                r"|\bstd\s*::\s*random_device\b|::\s*Random\s*\("),
     "is not repeatable; use a local engine with a fixed seed"),
    (re.compile(r"\b(set|use)locale\s*\(|\blocale\s*::\s*global\s*\("),
     "changes how the whole process writes numbers; use fmt and std::from_chars"),
]

# These end child processes started by this project, not the user's process.
FORKED = ("src/buckens/files/write_process.cpp", "src/buckens/files/isolated_work.cpp")


def check(root):
    errors = []
    for name in source_files.list_files(root):
        if not re.match(r"src/buckens/.+\.(h|cpp)$", name) or "/test/" in name:
            continue
        text = source_files.blank_comments_and_strings(source_files.read(root, name))
        for pattern, reason in FORBIDDEN:
            for match in pattern.finditer(text):
                if name in FORKED and match.group(0).startswith("_exit"):
                    continue
                line = source_files.line_of(text, match.start())
                errors.append(f"{name}:{line}: `{match.group(0).strip()}` {reason}")
    return errors


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("root", nargs="?", default=".")
    sys.exit(source_files.report("streams", check(parser.parse_args().root)))
