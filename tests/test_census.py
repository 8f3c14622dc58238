# SPDX-License-Identifier: Apache-2.0
"""tools/census.py sorts files by outcome, follows the remedies of messages and groups reasons."""

import json
import re
import subprocess
import sys

from conftest import PROGRAM, SOURCE

DECK = """GRID,1,,0.,0.,0.
GRID,2,,1.,0.,0.
GRID,3,,0.,1.,0.
GRID,4,,0.,0.,1.
CTETRA,1,1,1,2,3,4
PSOLID,1,1
MAT1,1,2.1E11,,0.3{density}
ENDDATA
"""


def test_sorts_files_and_reasons(tmp_path):
    folder = tmp_path / "decks"
    folder.mkdir()
    (folder / "whole.bdf").write_text(DECK.format(density=",7850."))
    (folder / "without_density.bdf").write_text(DECK.format(density=""))
    (folder / "empty.bdf").write_text("ENDDATA\n")
    for name in ("first", "second"):
        (folder / f"{name}.bdf").write_text(f"GRID,{name}\n" + DECK.format(density=""))
    (folder / "skipping.bdf").write_text("CBEND,7,1,1,2\n" + DECK.format(density=",7850."))
    (folder / "note.txt").write_text("not a mesh")
    outcome = tmp_path / "outcome.json"
    done = subprocess.run([sys.executable, SOURCE / "tools" / "census.py", folder, "--program", PROGRAM, "--json", outcome],
                          capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    row = next(line for line in done.stdout.splitlines() if line.startswith("| `.bdf`"))
    # files, read, body, with help, of these skipping, refused rightly, else, time out, crash
    assert [int(cell) for cell in row.split("|")[2:11]] == [6, 2, 1, 3, 1, 1, 2, 0, 0]
    assert sum("GRID, field #" in line and line.strip().startswith("2 read") for line in done.stdout.splitlines()) == 1
    by_name = {entry["file"].rsplit("/", 1)[-1]: entry for entry in json.loads(outcome.read_text())}
    assert set(by_name) == {"whole.bdf", "without_density.bdf", "skipping.bdf", "empty.bdf", "first.bdf", "second.bdf"}
    assert by_name["without_density.bdf"]["helped"] and not by_name["without_density.bdf"]["body"]


def test_tells_of_a_crash(tmp_path):
    """A crash of the program is counted and makes the census fail."""
    program = tmp_path / "program"
    program.write_text("#!/bin/sh\nkill -SEGV $$\n")
    program.chmod(0o755)
    deck = tmp_path / "deck.bdf"
    deck.write_text(DECK)
    done = subprocess.run([sys.executable, SOURCE / "tools" / "census.py", deck, "--program", program],
                          capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert re.search(r"\| 1 \| \d+\.\d s \|", done.stdout)


def test_parts_and_missing_files(tmp_path):
    """STEP parts are meshed as users would; a deck without the files that it includes is not to blame on the reader."""
    (tmp_path / "rod.step").write_text((SOURCE / "examples" / "connecting_rod" / "rod.step").read_text())
    (tmp_path / "cut.step").write_text((tmp_path / "rod.step").read_text()[:5000])
    (tmp_path / "open.inp").write_text("*INCLUDE, INPUT=mesh.inc\n")
    done = subprocess.run([sys.executable, SOURCE / "tools" / "census.py", tmp_path, "--program", PROGRAM],
                          capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    rows = {line.split("|")[1].strip(" `"): [int(cell) for cell in line.split("|")[2:11]]
            for line in done.stdout.splitlines() if line.startswith("| `")}
    # files, read, body, with help, of these skipping, refused rightly, else, time out, crash
    assert rows == {".step": [2, 1, 1, 1, 0, 1, 0, 0, 0], ".inp": [1, 0, 0, 0, 0, 1, 0, 0, 0]}
