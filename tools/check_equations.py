#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that every equation tag in the sources is explained in the theory pages.

`FM (n)` is an equation of Fischer & Mangler (1991): lists and ranges such as `FM (25), (26)` and
`FM (22)–(24)` count with all their numbers. `eq. (L1)` is an equation of Buckens' own, labelled by
`\\tag{L1}` in docs/theory.
"""

import argparse
import re
import sys

import source_files

LAST_EQUATION = 57
PAPER = re.compile(r"FM\s*\((\d+)\)((?:\s*(?:,|–|-|and)\s*(?:///?\s*)?\(\d+\))*)")
FURTHER = re.compile(r"(,|–|-|and)\s*(?:///?\s*)?\((\d+)\)")
OWN = re.compile(r"\beqs?\.\s*\(([A-Z]\d+)\)")
LABEL = re.compile(r"\\tag\{([A-Z]\d+)\}")
SOURCE = re.compile(r"(src|apps|verification|bench)/.+\.(h|cpp)$")


def paper_tags(text):
    """(offset, equation number) of every equation of the paper that a text names."""
    for match in PAPER.finditer(text):
        last = int(match.group(1))
        yield match.start(), last
        for link, number in FURTHER.findall(match.group(2)):
            first = last + 1 if link in "–-" else int(number)
            last = int(number)
            for n in range(first, last + 1):
                yield match.start(), n


def check(root):
    explained, labels, sources = set(), set(), []
    for name in source_files.list_files(root):
        if re.match(r"docs/theory/.+\.md$", name):
            text = source_files.read(root, name)
            explained.update(n for _, n in paper_tags(text))
            labels.update(LABEL.findall(text))
        elif SOURCE.match(name):
            sources.append(name)
    errors = []
    for name in sources:
        text = source_files.read(root, name)
        for offset, n in paper_tags(text):
            place = f"{name}:{source_files.line_of(text, offset)}"
            if not 1 <= n <= LAST_EQUATION:
                errors.append(f"{place}: FM ({n}): the paper has equations 1 to {LAST_EQUATION}")
            elif n not in explained:
                errors.append(f"{place}: FM ({n}) is explained in no page of docs/theory")
        for match in OWN.finditer(text):
            if match.group(1) not in labels:
                errors.append(f"{name}:{source_files.line_of(text, match.start())}: "
                              f"eq. ({match.group(1)}) labels no equation in docs/theory")
    return errors


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("root", nargs="?", default=".")
    sys.exit(source_files.report("equations", check(parser.parse_args().root)))
