# SPDX-License-Identifier: Apache-2.0
"""The summaries on the pages of the examples equal the program's output."""

import os
import pathlib
import re

import pytest

SOURCE = pathlib.Path(os.environ.get("BUCKENS_SOURCE_DIR", pathlib.Path(__file__).parents[1]))

BLOCK = re.compile(r"^```\n(.*?)^```", re.DOTALL | re.MULTILINE)
COMMAND = re.compile(r"^ {4}buckens (run examples/\S+\.yaml) -o \S+$", re.MULTILINE)
NUMBER = re.compile(r"^-?\d+(\.\d+)?(e[+-]?\d+)?$")

# Permitted deviation of a number from the page, as a factor. Counts of the small iteration and residuals depend on rounding and
# on the order of operations; everything else is exact.
LOOSE = {"Newton": 1.3, "constraint": 20, "sieve": 20, "energy": 2, "solves": 1.02}


def pages():
    """(command, summary on the page) of each example whose page shows one."""
    for page in sorted((SOURCE / "examples").glob("*/README.md")):
        text = page.read_text()
        blocks = [block for block in BLOCK.findall(text) if "steps to t =" in block]
        # Meshes of STEP files depend on the version of Gmsh.
        if blocks and page.parent.name != "connecting_rod":
            yield pytest.param(COMMAND.search(text).group(1), blocks[0], id=page.parent.name)


def split(line):
    """Words of a line, without the times of the first one and with the numbers removed."""
    words = re.sub(r" in [\d.e+-]+ s, .*", "", line).split()
    return [word for word in words if not NUMBER.match(word)], [float(word) for word in words if NUMBER.match(word)]


def agrees(shown, printed):
    (words, numbers), (other_words, other_numbers) = split(shown), split(printed)
    if words != other_words or len(numbers) != len(other_numbers):
        return False
    # A body's line: DOF and factorisations are counts, solves follow from repeated steps.
    factor = LOOSE.get(words[0], LOOSE["solves"] if "full" in words else 1)
    if words[0] in ("constraint", "sieve", "energy"):
        return all(found <= factor * number for number, found in zip(numbers, other_numbers))
    return all(number / factor <= found <= factor * number for number, found in zip(numbers, other_numbers))


def test_pages_with_a_summary_are_found():
    assert len(list(pages())) >= 7


@pytest.mark.parametrize("command, block", pages())
def test_the_page_shows_what_the_program_prints(buckens, tmp_path, command, block):
    verb, model = command.split()
    printed = buckens(verb, str(SOURCE / model), "-o", "out").must(0).out.splitlines()
    for line in block.splitlines():
        assert any(agrees(line, other) for other in printed), (line, printed)
