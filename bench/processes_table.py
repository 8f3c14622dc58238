# SPDX-License-Identifier: Apache-2.0
"""The tables of docs/developers/several-processes.md from docs/developers/several_processes.json, and what follows from them for more processes."""

import math
import pathlib

import numpy

ROOT = pathlib.Path(__file__).resolve().parent.parent
RESULTS = ROOT / "docs/developers/several_processes.json"
PAGE = ROOT / "docs/developers/several-processes.md"
BEGIN, END = "<!-- processes:begin -->", "<!-- processes:end -->"


class Law:
    """value = a n^α P^β, fitted to logarithms."""

    def __init__(self, rows, value):
        known = [(math.log(row["variables"]), math.log(row["processes"]), math.log(value(row))) for row in rows]
        columns = numpy.array([[1.0, n, p] for n, p, _ in known])
        self.a, self.of_variables, self.of_processes = numpy.linalg.lstsq(columns, numpy.array([v for _, _, v in known]), rcond=None)[0]
        self.worst = max(math.exp(abs(self.a + self.of_variables * n + self.of_processes * p - v)) for n, p, v in known)

    def __call__(self, variables, processes):
        return math.exp(self.a + self.of_variables * math.log(variables) + self.of_processes * math.log(processes))


def amount(size):
    """Three digits of a number of bytes."""
    for unit, scale in (("GB", 1e9), ("MB", 1e6), ("kB", 1e3)):
        if size >= scale:
            return f"{size / scale:.3g} {unit}"
    return f"{size:.0f} B"


def figures(rows):
    panels = {row["side"]: row for row in rows if row["processes"] == 1 and row["solver"] == "own"}
    lines = ["| variables | processes | factor [s] | a step [s] | ÷ one process | whole run, each process [GB] | in shares [GB] | bytes of a step, all | "
             "of these to and from the first | messages of a step, all |", "|" + "---|" * 10]
    for row in sorted(rows, key=lambda row: (row["side"], row["processes"])):
        one = panels.get(row["side"])
        many = row["processes"] > 1
        lines.append(" | ".join([
            f"| {row['variables']:,}".replace(",", " "), str(row["processes"]), f"{row['factor_seconds']:.3g}", f"{row['step_seconds']:.3g}",
            f"{row['step_seconds'] / one['step_seconds']:.2g}" if one else "–", ", ".join(f"{m / 1e9:.2f}" for m in row["peak_bytes"]),
            ", ".join(f"{m / 1e9:.2f}" for m in row["peak_bytes_in_shares"]), amount(row["bytes_per_step"]) if many else "–",
            amount(row["own_bytes_per_step"]) if many else "–", f"{row['messages_per_step']:.0f} |" if many else "– |"]))
    return lines


def prediction(rows, variables=10**7, processes=64):
    """What a solve takes on more processes than there are here, from laws of the counted numbers. Two processes have one connection and share few fronts:
    their numbers follow no law of more."""
    several = [row for row in rows if row["processes"] >= 4 and row["bytes_per_step"] > 0]
    if len({row["processes"] for row in several}) < 2 or len({row["side"] for row in several}) < 2:
        return ["Not yet: 10⁷ variables need runs on more processes."]
    lines = ["| counted per solve | law | largest deviation | 10⁷ variables, 64 processes |", "|---|---|---|---|"]
    for what, value, shown in (("bytes, all processes", lambda row: row["bytes_per_step"] / row["solves_per_step"], amount),
                               ("messages, all processes", lambda row: row["messages_per_step"] / row["solves_per_step"], lambda x: f"{x:.2g}"),
                               ("bytes to and from the first", lambda row: row["own_bytes_per_step"] / row["solves_per_step"], amount)):
        law = Law(several, value)
        lines.append(f"| {what} | n^{law.of_variables:.2f} P^{law.of_processes:.2f} | {100 * (law.worst - 1):.0f} % | {shown(law(variables, processes))} |")
    return lines


def tables(rows):
    dates = sorted(row["date"] for row in rows)
    span = dates[0] if dates[0] == dates[-1] else f"{dates[0]} to {dates[-1]}"
    return [f"Cubes of hex8, coupling `full`, measured on {span} on {rows[0]['processors']} processors:", "", *figures(rows), "",
            "Predicted from laws that were fitted to those of these runs that have four and more processes:", "", *prediction(rows)]


def write(rows):
    text = PAGE.read_text()
    before, rest = text.split(BEGIN)
    PAGE.write_text(before + BEGIN + "\n" + "\n".join(tables(rows)).rstrip() + "\n" + END + rest.split(END)[1])
