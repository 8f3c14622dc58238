# SPDX-License-Identifier: Apache-2.0
"""The benchmark scripts: the names in them, and that the tables follow from the stored figures."""

import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "bench"))

import table  # noqa: E402


def test_sections_are_named():
    done = subprocess.run([sys.executable, ROOT / "bench/run.py", "--list"], capture_output=True,
                          text=True, check=True)
    sections = done.stdout.split()
    assert {"solves:300000", "steps:slender", "modes:100000", "reduced", "chains"} <= set(sections)


def test_unknown_section_is_refused():
    done = subprocess.run([sys.executable, ROOT / "bench/run.py", "no-such"], capture_output=True,
                          text=True)
    assert done.returncode != 0
    assert "--list" in done.stderr


def test_page_holds_the_tables_of_the_figures():
    results = json.loads((ROOT / "docs/developers/benchmarks.json").read_text())
    page = (ROOT / "docs/developers/benchmarks.md").read_text()
    inside = page.split(table.BEGIN)[1].split(table.END)[0]
    expected = "\n".join(table.tables(results)).replace("\n\n\n", "\n\n")
    assert inside.strip() == expected.strip()
    assert "Large solves" in inside
