# SPDX-License-Identifier: Apache-2.0
"""The benchmark scripts: the names in them, and that the tables follow from the stored figures."""

import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "bench"))

import goals  # noqa: E402
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


def test_goals_are_compared_as_they_are_shown():
    """A figure meets its goal if it does so to the digits in the table; what was not measured has no row."""
    section = {"context": {}, "rows": [{"name": "planar_beam_step/128", "seconds": 1.404e-4,
                                        "all_seconds": [1.404e-4, 1.5e-4, 1.7e-4]},
                                       {"name": "rigid_chain_step/1000", "seconds": 1.51e-3},
                                       {"name": "rigid_chain_step/10000", "seconds": 1.9e-2}]}
    rows = {row[0]: row[1:] for row in goals.goal_rows({"chains": section})}
    assert rows == {
        "planar beam, 128 frames: step": ["≤ 0.14 ms", "0.14 ms", "0.15 ms (0.14 ms to 0.17 ms)", "–", "Exudyn 0.28 ms", "yes"],
        "rigid chain, 1000 links: step": ["≤ 1.5 ms", "1.51 ms", "–", "–", "Exudyn 7.2, Chrono 15.8 ms", "**no**"],
        "rigid chain, 10 000 links: per link": ["≤ 2 µs", "1.9 µs", "–", "–", "–", "yes"]}


def test_bound_of_variants_is_that_of_the_columns_of_a_solve():
    block = {"element": "hex8", "divisions": "2 x 2 x 2"}
    solve = {**block, "panels": {"1": {"1": 1e-3, "6": 2e-3}}, "factorisation": None}
    variant = {**block, "none": {"1": 4e-3, "6": 5.6e-3}, "full": {"1": 5e-3, "6": 7.5e-3}}
    rows = goals.goal_rows({"solves:1": {"rows": [solve]}, "variants:1": {"rows": [variant]}})
    assert [row[1:] for row in rows] == [["≤ 1.4", "1.4", "–", "1.25", "–", "yes"], ["≤ 1.4", "1.5", "–", "1.2", "–", "**no**"]]
