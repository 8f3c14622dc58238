# SPDX-License-Identifier: Apache-2.0
"""The benchmark scripts: the names in them, and that the tables follow from the stored figures."""

import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "bench"))

import goals  # noqa: E402
import processes_table  # noqa: E402
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


def test_set_up_is_compared_by_threads_and_with_a_stored_factor():
    def row(threads, stored, seconds):
        return {"element": "hex8", "divisions": "9 x 1 x 1", "threads": threads, "stored": stored, "seconds": seconds, "dof": 300000,
                "all_seconds": [seconds, 1.1 * seconds, 1.2 * seconds], "phases": {"assembly": 1.0, "factor": 2.0}, "record": 0.02}

    results = {"preparation:1": {"rows": [row(1, False, 8.0), row(2, False, 4.4), row(2, True, 12.0)]}}
    rows = {row[0]: row[1:] for row in goals.goal_rows(results)}
    assert rows == {"hex8 9 x 1 x 1: set-up on 2 threads ÷ on one": ["≤ 0.556", "0.55", "–", "–", "–", "yes"],
                    "hex8 9 x 1 x 1: first step with a stored factor": ["≤ 10 s", "12 s", "13.2 s (12 s to 14.4 s)", "–", "–", "**no**"]}
    table_lines = table.preparation_table(results)
    assert any("2, factor stored" in line and "20" in line for line in table_lines)


def test_page_of_several_processes_holds_its_figures():
    rows = json.loads(processes_table.RESULTS.read_text())
    inside = processes_table.PAGE.read_text().split(processes_table.BEGIN)[1].split(processes_table.END)[0]
    assert inside.strip() == "\n".join(processes_table.tables(rows)).strip()
    assert "10⁷ variables" in inside


def test_laws_of_messages_are_found_again():
    rows = [{"variables": n, "processes": p, "value": 3.0 * n ** 0.7 * p ** 1.2} for n in (1e3, 1e4, 1e5) for p in (2, 4)]
    law = processes_table.Law(rows, lambda row: row["value"])
    assert abs(law(10**7, 64) / (3.0 * 1e7 ** 0.7 * 64 ** 1.2) - 1) < 1e-9  # three numbers of six
    assert abs(law.worst - 1) < 1e-9
