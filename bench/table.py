#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the figures of docs/developers/benchmarks.json as tables into docs/developers/benchmarks.md,
between the lines <!-- bench:begin --> and <!-- bench:end -->.

    python3 bench/table.py [FILE.json]
"""

import json
import pathlib
import sys

import goals

ROOT = pathlib.Path(__file__).resolve().parent.parent
BEGIN, END = "<!-- bench:begin -->", "<!-- bench:end -->"


def processor():
    """Name, and the model number if the name is not specific."""
    found = {}
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if ":" in line:
            key, value = line.split(":", 1)
            found.setdefault(key.strip(), value.strip())
    name = found.get("model name", "an unknown processor")
    return f"{name}, family {found.get('cpu family', '?')}, model {found.get('model', '?')}"


def number(value, digits=3):
    """Three significant digits without exponent."""
    if value is None:
        return "–"
    text = f"{value:.{digits}g}"
    return f"{float(text):.0f}" if "e" in text else text


def ms(seconds):
    return "–" if seconds is None else number(1e3 * seconds)


def dofs(count):
    return f"{int(count):,}".replace(",", " ")


def shape(row):
    return f"{row['element']} {row['divisions']}"


def lines_of(head, rows):
    return ["| " + " | ".join(head) + " |", "|" + "---|" * len(head),
            *("| " + " | ".join(cells) + " |" for cells in rows), ""]


def of_section(results, name):
    """Rows of name and name:…, each with its context."""
    for key, section in results.items():
        if key == name or key.startswith(name + ":"):
            for row in section["rows"]:
                yield row


def failures(rows):
    return [f"`{row.get('command', shape(row) if 'element' in row else '')}`: {row['error']}"
            for row in rows if "error" in row] + [""]


def solve_table(results):
    rows = list(of_section(results, "solves"))
    head = ["block", "DOF", "panels [MB]", "CHOLMOD", "panels", "÷ CHOLMOD",
            "bound", "÷ bound", "2 threads", "÷ 1 thread", "bound 2", "6 rhs", "÷ 1 rhs", "32 rhs",
            "CHOLMOD 6 rhs", "residual"]
    cells = []
    for row in rows:
        if "error" in row:
            continue
        panels, one, two = row["panels"], row["panels"]["1"], row["panels"]["2"]
        reference = row.get("cholmod", {}).get("1", {})
        bound = [2.0 * panels["bytes"] / row["bandwidth"][n] for n in ("1", "2")]
        ratio = number(one["1"] / reference["1"], 2) if reference else "–"
        cells.append([
            shape(row), dofs(row["dof"]),
            number(1e-6 * panels["bytes"]), ms(reference.get("1")), ms(one["1"]), ratio,
            ms(bound[0]), number(one["1"] / bound[0], 2), ms(two["1"]),
            number(two["1"] / one["1"], 2), ms(bound[1]), ms(one["6"]),
            number(one["6"] / one["1"], 2), ms(one["32"]), ms(reference.get("6")),
            f"{panels['residual']:.0e}"])
    return ["### Large solves", "",
            "Times in ms. `bound`: twice the bytes of the panels over the bandwidth measured in the "
            "same run; blocks whose factor stays in the cache beat it.", "",
            *lines_of(head, cells), *failures(rows)]


def factor_table(results):
    head = ["block", "DOF", "CHOLMOD, 1 thread [s]", "1 thread [s]", "÷ CHOLMOD", "2 threads [s]",
            "÷ CHOLMOD", "entries ÷ CHOLMOD's", "panels [MB]", "taken at most ÷ panels"]
    cells = []
    for row in of_section(results, "solves"):
        if "error" in row or not isinstance(row["factorisation"], dict):
            continue
        one, two = (row["factorisation"][n] for n in "12")
        reference = row.get("cholmod", {})
        ratio = [number(t / reference["factorisation"], 2) if reference else "–"
                 for t in (one, two)]
        cells.append([
            shape(row), dofs(row["dof"]), number(reference.get("factorisation")), number(one),
            ratio[0], number(two), ratio[1],
            number(row["entries"] / reference["entries"], 3) if reference else "–",
            number(1e-6 * row["panels"]["bytes"]),
            number(row["factor_bytes"] / row["panels"]["bytes"], 3)])
    if not cells:
        return []
    return ["### Factors", "", "Ordering included, on one thread and on two.", "",
            *lines_of(head, cells)]


def tree_table(results):
    """Efficiency of threads: by the structure of the factor, and as measured."""
    rows = list(of_section(results, "tree"))
    counts = [2, 4, 8, 16, 32]
    head = ["block", "DOF", "panels [MB]", "parts",
            *[text for n in counts for text in (f"{n}: balance", f"{n}: efficiency")]]
    cells = []
    for row in rows:
        if "error" in row:
            continue
        by_threads = {entry["threads"]: entry for entry in row["by_threads"]}
        cells.append([shape(row), dofs(row["dof"]), number(1e-6 * row["bytes"]), str(row["parts"])])
        for n in counts:
            entry, one = by_threads[n], by_threads[1]
            cells[-1].append(number(1.0 / (n * entry["share"]), 2))
            cells[-1].append(number(one["seconds"] / (n * entry["seconds"]), 2)
                             if "seconds" in entry else "–")
    if not cells:
        return []
    return ["### Threads of a solve", "",
            "`balance`: 1 ÷ (threads × share of the factor that the busiest thread reads), the efficiency that the tree "
            "allows if memory keeps up. `efficiency`: time on one thread ÷ (threads × time), measured where this machine "
            "has as many processors.", "", *lines_of(head, cells), *failures(rows)]


def step_table(results):
    head = ["block", "DOF", "coupling", "solves per step", "1 thread [ms]", "CHOLMOD's solve [ms]",
            "step ÷ CHOLMOD", "2 threads [ms]", "÷ 1 thread"]
    cells, rows = [], list(of_section(results, "steps"))
    for row in rows:
        if "error" in row:
            continue
        by_level = {}
        for step in row["steps"]["levels"]:
            by_level.setdefault(step["level"], {})[step["threads"]] = step
        reference = row["steps"].get("cholmod")
        for level, threads in by_level.items():
            one, two = threads.get(1), threads.get(2)
            cells.append([
                shape(row), dofs(row["steps"]["dof"]), f"`{level}`", number(one["solves_per_step"]),
                ms(one["step"]), ms(reference),
                number(one["step"] / reference, 2) if reference else "–",
                ms(two["step"]) if two else "–",
                number(two["step"] / one["step"], 2) if two else "–"])
    return ["### Steps of solids", "", *lines_of(head, cells), *failures(rows)]


def setup_table(results):
    rows = list(of_section(results, "setup"))
    cells = [[shape(row), dofs(row["setup"]["dof"]), number(row["setup"]["with_factor"]),
              number(row["setup"]["12"]), number(row["setup"]["60"])]
             for row in rows if "error" not in row]
    head = ["block", "DOF", "factor, no variables [s]", "columns, 12 variables [s]",
            "columns, 60 variables [s]"]
    return ["### Set-up by interface variables", "",
            "The columns are what comes after the factor, which is taken from elsewhere.", "",
            *lines_of(head, cells), *failures(rows)]


def mode_table(results):
    rows = list(of_section(results, "modes"))
    pairs = {}
    for row in rows:
        pairs.setdefault(shape(row), {})[row["method"], row.get("threads", 1)] = row
    cells = []
    for block, methods in pairs.items():
        ours, on_two, spectra = (methods.get(key, {}) for key in (("subspace", 1), ("subspace", 2), ("spectra", 1)))
        if "dof" not in ours:
            continue
        difference = (abs(ours["highest"] / spectra["highest"] - 1.0)
                      if "highest" in spectra else None)
        cells.append([block, dofs(ours["dof"]), number(ours["seconds"]), number(on_two.get("seconds")),
                      number(spectra.get("seconds")), number(ours["solves"], 4),
                      number(spectra.get("solves"), 4),
                      "–" if difference is None else f"{difference:.0e}"])
    head = ["block", "DOF", "`subspace` [s]", "on 2 threads [s]", "`spectra` [s]", "solves", "solves, `spectra`",
            "difference of the 20th"]
    return ["### 20 lowest free vibrations, factorisation included", "", *lines_of(head, cells),
            *failures(rows)]


def google_table(title, results, section, pattern, extra):
    rows = [row for row in of_section(results, section) if row["name"].startswith(pattern)]
    if not rows:
        return []
    head = ["what", "per step [µs]", *extra.values()]
    cells = [[f"`{row['name']}`", number(1e6 * row["seconds"]),
              *(number(scaled(row, key)) for key in extra)] for row in rows]
    return [f"### {title}", "", *lines_of(head, cells)]


def scaled(row, key):
    if key == "per frame":
        return 1e6 * row["seconds"] / row["frames"]
    if key == "per link":
        return 1e6 * row["seconds"] / int(row["name"].split("/")[1])
    if key == "per sphere":
        return 1e6 * row[key] if key in row else None
    return row.get(key)


def variant_table(results):
    cells = []
    for row in of_section(results, "variants"):
        for level in ("none", "full"):
            one, six = row[level]["1"], row[level]["6"]
            many = row[level].get("32")
            cells.append([shape(row), f"`{level}`", ms(one), ms(six), number(six / one, 3),
                          ms(many), number(many / one if many else None, 3)])
    head = ["block", "coupling", "one [ms]", "6 together [ms]", "÷ one", "32 together [ms]", "÷ one"]
    return ["### Variants together", "", *lines_of(head, cells)]


def memory_table(results):
    panels = {shape(row): row["panels"]["bytes"] for row in of_section(results, "solves")
              if "panels" in row}
    rows = list(of_section(results, "memory"))
    cells = []
    for row in rows:
        if "error" in row:
            continue
        size = panels.get(shape(row))
        per = [number(row[key] / size, 3) if size else "–"
               for key in ("resident_bytes", "peak_bytes")]
        wall = row["wall_seconds"]
        cells.append([shape(row), dofs(row["dof"]), number(row["steps"]),
                      number(1e-6 * size, 4) if size else "–",
                      number(1e-6 * row["resident_bytes"], 4), per[0],
                      number(1e-6 * row["peak_bytes"], 4), per[1], number(wall["setup"]),
                      ms(wall["stepping"] / row["steps"])])
    head = ["block", "DOF", "steps", "panels [MB]", "resident [MB]", "÷ panels", "peak [MB]",
            "÷ panels", "set-up [s]", "per step [ms]"]
    return ["### Memory of `buckens run`", "",
            "Resident: median while it steps. A step contains ten records and what the program "
            "accounts for.", "", *lines_of(head, cells), *failures(rows)]


PHASES = ["assembly", "order", "factor", "stored_factors", "lowest_frequency", "responses"]


def preparation_table(results):
    rows = list(of_section(results, "preparation"))
    cells = []
    for row in rows:
        if "error" in row:
            continue
        phases = [row["phases"].get(name) for name in PHASES]
        rest = row["seconds"] - sum(seconds or 0.0 for seconds in phases)
        threads = f"{row['threads']}, factor stored" if row["stored"] else str(row["threads"])
        cells.append([shape(row), dofs(row["dof"]), threads, number(row["seconds"]), *[number(seconds, 2) for seconds in phases],
                      number(rest, 2), ms(row["record"])])
    head = ["block", "DOF", "threads", "to the first step [s]", *[name.replace("_", " ") for name in PHASES], "rest", "record [ms]"]
    return ["### From the model file to the first step", "",
            "Phases of `wall_seconds.preparation` in seconds, the fastest of three runs. A record contains displacements, energies, stresses at centres "
            "and nodes, and what the program accounts for.", "", *lines_of(head, cells), *failures(rows)]


def goal_table(results):
    rows = goals.goal_rows(results)
    if not rows:
        return []
    head = ["what", "goal", "shortest", "median (spread)", "bound", "peer, on another machine", "met"]
    return ["### Goals", "",
            "On one thread unless said otherwise. A goal is met if the shortest time meets it. Spreads are quartiles of steps for solids, and ranges of three repetitions for the others. "
            "`bound`, in the unit of the measured value: for `full`, one solve, at 30 000 variables "
            "and more as its factor is read twice at the bandwidth of the same run, below as measured; for variants, one variant plus "
            "what additional columns of a solve take, and nothing else; for threads, the largest share of the factor that one of them "
            "reads, or the bandwidth of one ÷ that of both, whichever is more. What stays in the cache may beat a bandwidth.", "", *lines_of(head, rows)]


def origin(results):
    """When and where; sections measured elsewhere than most are named."""
    machines = {}
    for name, section in results.items():
        context = section["context"]
        machine = f"{context['processor']}, {context['cores']} cores, Linux {context['system']}"
        machines.setdefault(machine, []).append(name)
    usual, *others = sorted(machines, key=lambda machine: -len(machines[machine]))
    elsewhere = "".join(f"; {', '.join(f'`{name}`' for name in machines[machine])} on {machine}" for machine in others)
    dates = sorted(section["context"]["date"] for section in results.values())
    loads = [section["context"]["load"] for section in results.values()]
    return (f"Measured from {dates[0]} to {dates[-1]} on {usual}{elsewhere}; load when a section began: "
            f"{min(loads):.1f} to {max(loads):.1f}. Times are the shortest of several.")


def tables(results):
    frame = {"frames": "frames", "per frame": "per frame [µs]", "newton/step": "iterations"}
    return [
        origin(results), "", *goal_table(results), *factor_table(results), *solve_table(results), *tree_table(results), *step_table(results), *setup_table(results),
        *preparation_table(results), *mode_table(results),
        *google_table("Reduced body on a ball joint", results, "reduced", "reduced_step",
                      {"solves/step": "divisions by K̂", "newton/step": "iterations"}),
        *variant_table(results),
        *google_table("Rigid chains on revolute joints", results, "chains", "rigid_chain_step",
                      {"per link": "per link [µs]", "newton/step": "iterations"}),
        *google_table("Machines: friction and stops, gears, belts, contact of many bodies", results, "machines", "",
                      {"per sphere": "per sphere [µs]", "near pairs": "near pairs", "newton/step": "iterations"}),
        *google_table("Beams with a frame per element", results, "frames", "", frame),
        *google_table("Beams with one frame", results, "beams", "",
                      {"dof": "DOF", "solves/step": "solves", "newton/step": "iterations"}),
        *memory_table(results)]


def write(path):
    results = json.loads(pathlib.Path(path).read_text())
    page = ROOT / "docs/developers/benchmarks.md"
    text = page.read_text()
    before, rest = text.split(BEGIN)
    after = rest.split(END)[1]
    lines = "\n".join(tables(results)).replace("\n\n\n", "\n\n").rstrip()
    page.write_text(f"{before}{BEGIN}\n{lines}\n{END}{after}")


if __name__ == "__main__":
    write(sys.argv[1] if len(sys.argv) > 1 else ROOT / "docs/developers/benchmarks.json")
