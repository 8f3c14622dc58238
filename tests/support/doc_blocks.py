# SPDX-License-Identifier: Apache-2.0
"""Blocks of code on the pages: fenced ones, and indented ones that are commands."""

import dataclasses
import re
import shlex

FENCE = re.compile(r"^```(\S*)[ \t]*\n(.*?)^```", re.DOTALL | re.MULTILINE)
INDENTED = re.compile(r"(?<=\n\n)(?: {4,}\S[^\n]*\n(?:[ \t]*\n(?= {4}))*)+")
# Before a block that cannot be run: <!-- not run: REASON -->
NOT_RUN = re.compile(r"<!-- not run: ([^>]+) -->\s*\Z")
COMMAND = re.compile(r"(?:build/release/bin/)?buckens [a-z]")


@dataclasses.dataclass
class Block:
    page: str      # relative to the sources
    line: int      # of its first line
    language: str  # of a fence; "" for plain and indented ones
    text: str
    reason: str    # why it is not run, or ""

    @property
    def name(self):
        return f"{self.page}:{self.line}"


def blocks_of(page, text):
    """Blocks of a page in their order."""
    found = []
    blanked = text
    for match in FENCE.finditer(text):
        found.append((match.start(2), match.start(), match[1], match[2]))
        blank = re.sub(r"[^\n]", "#", match[0])
        blanked = blanked[:match.start()] + blank + blanked[match.end():]
    for match in INDENTED.finditer(blanked):
        lines = match[0].splitlines()
        if not any(re.match(r" {4}(\./|buckens |build/|python3|cmake|ctest|export|tests/|tools/|/usr/)", line)
                   for line in lines):
            continue
        found.append((match.start(), match.start(), "", "".join(line[4:] + "\n" for line in lines)))
    for start, before, language, content in sorted(found):
        marker = NOT_RUN.search(text[:before])
        yield Block(page, text.count("\n", 0, start) + 1, language, content, marker[1] if marker else "")


def commands_of(block):
    """Words of each command line of `buckens` in a block, without comments; continued lines are joined."""
    text = re.sub(r"\\\n\s*", "", block.text)
    for line in text.splitlines():
        if COMMAND.match(line):
            words = shlex.split(line, comments=True)
            yield ["buckens", *words[1:]]
