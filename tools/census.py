#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Outcome of reading files written by others: each is read separately as a new user would, under limits.

    tools/census.py FOLDER... [--program build/release/bin/buckens] [--json FILE] [--list] [--jobs 1]

"read": `mesh-info` understands the file. "body": `check` makes a body of it, with the file named in the model file
and nothing else (for formats that know no materials: with the material steel). "with help": it makes a body once the
model file gives the materials, thicknesses and cross-sections that the messages ask for, and leaves out (`skip`) what
they offer to leave out. Files that no program could
make a body of (no mesh in them, not complete, other physics) are known by their message: RIGHT below. What remains of
the refusals is still to be done.
"""

import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import re
import resource
import signal
import statistics
import subprocess
import sys
import tempfile
import time

DECKS = {".inp", ".bdf", ".dat", ".nas", ".nastran", ".fem"}
MESHES = {".msh", ".unv"}
STEPS = {".step", ".stp", ".p21"}
MATERIAL = "steel"
MATERIALS = {MATERIAL: {"E": "210 GPa", "nu": 0.3, "rho": "7850 kg/m^3"}}
MOST_ATTEMPTS = 30
A_MINUTE = 60  # of processor time, what a part of a usual size may take

# Messages without a remedy: the file contains no body, or only part of one.
RIGHT = [re.compile(text) for text in (
    r"the deck has no nodes", r"the deck has nodes, but no elements", r"the mesh has no elements", r"the file is empty",
    r"cannot read the included file", r"there is no (GRID|material|PBUSH|node|element) ", r"truncated|cut off|not complete",
    r"there is another (element|property|material)", r"appears twice", r"not a text file|zero byte",
    r"fluid|acoustic|axisymmetric|hyperelastic|superelement", r"parts that nothing holds together",
    r"the mesh has no mass", r"is not a (Gmsh mesh|deck of Nastran|STEP file)", r"is this a deck of Nastran",
    r"is connected to no element",  # a mass in the air, which only supports or contact would hold
    r"the (mass|stiffness) \S+ is negative",
    r"turned inside out", r"is a mechanism in itself",
    r"no element of this deck can be part of a flexible body", r"plane and cannot be part of a three-dimensional body",
    r"and there is no \*NODE|the file has no \*NODE", r"the file has no nodes \(data sets",
    r"there is no solid, only", r"has no solid and no faces",
)]


def limited(memory):
    def apply():
        os.setsid()
        resource.setrlimit(resource.RLIMIT_AS, (memory << 20, memory << 20))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    return apply


class Runner:
    def __init__(self, program, seconds, memory, is_alone):
        self.program, self.seconds, self.memory = str(pathlib.Path(program).resolve()), seconds, memory
        self.is_alone = is_alone  # no other call at the same time, so processor times can be told apart
        self.processor = None

    def run(self, *words):
        """(exit code or "time" or "signal n", message in one line, seconds, output)."""
        self.processor = None
        began = resource.getrusage(resource.RUSAGE_CHILDREN)
        begin = time.monotonic()
        with subprocess.Popen([self.program, *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                              errors="replace", preexec_fn=limited(self.memory)) as process:
            try:
                out, err = process.communicate(timeout=self.seconds)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                process.communicate()
                return "time", f"more than {self.seconds:g} s", time.monotonic() - begin, ""
        ended = resource.getrusage(resource.RUSAGE_CHILDREN)
        if self.is_alone:
            self.processor = ended.ru_utime + ended.ru_stime - began.ru_utime - began.ru_stime
        code = process.returncode if process.returncode >= 0 else f"signal {-process.returncode}"
        text = next((line for line in err.splitlines() if "error:" in line), err.strip().split("\n")[0])
        return code, text.split("error:", 1)[-1].strip() if code else "", time.monotonic() - begin, out


class Model:
    """A model file of one body; extended by what the program's messages ask for, as a user would write it. Shells and
    beams become as thick as a hundredth of the body."""

    def __init__(self, path, ending):
        self.path, self.ending = str(path), ending
        self.mesh = {"file": self.path, "length-unit": "m", "mass-unit": "kg"}
        self.skipped = []
        self.thickness = "1 mm"
        if ending in MESHES:
            self.mesh["material"] = MATERIAL

    def text(self):
        part = {"step": self.path, "material": MATERIAL}
        body = {"geometry": part} if self.ending in STEPS else {"mesh": self.mesh}
        return json.dumps({"buckens": 1, "materials": MATERIALS, "bodies": {"b": body}})

    def add_section(self, text, section):
        group = re.search(r'elements? of "([^"]*)"', text) or re.search(r' of "([^"]*)" have', text)
        place = self.mesh.setdefault("sections", {}) if group else self.mesh
        key = group.group(1) if group else "section"
        if key in place:
            return False
        place[key] = section
        return True

    def skip(self, text):
        """Leaves out what a message offers to leave out. @return whether it does, and that is new"""
        offer = re.search(r"mesh: \{skip: \[([^\]]+)\]\}", text)
        if not offer or offer.group(1) in self.skipped:
            return False
        self.skipped.append(offer.group(1))
        self.mesh["skip"] = self.skipped
        return True

    def help(self, text, properties):
        """Adds what the message asks for. @return whether there was anything to add"""
        if self.ending in STEPS:
            return False
        if self.skip(text):
            return True
        if "have no thickness" in text:
            return self.add_section(text, {"thickness": self.thickness})
        if "have no cross-section" in text:
            return self.add_section(text, {"beam": {"circle": {"diameter": self.thickness}}})
        if re.search(r"no mass|no material|elastic constants|`materials?`", text) and "materials" not in self.mesh:
            self.mesh["materials"] = {name: MATERIAL for name in properties}
            self.mesh.setdefault("material", MATERIAL)
            return True
        return False


def reason(text):
    """A message without the parts that differ from file to file."""
    text = re.sub(r"^model\.yaml:\d+:\d+: ", "", text)
    text = re.sub(r"^(body )?\"b\": ", "", text)
    text = re.sub(r"(/[^/:]+)+\.\w+(:\d+)*: ", "", text)
    text = re.sub(r"\"[^\"]*\"", "\"…\"", text)
    text = re.sub(r"[-+]?\d+(\.\d*)?(e[-+]?\d+)?", "#", text)
    return text[:160]


def examine(runner, path):
    ending = path.suffix.lower()
    out = {"file": str(path), "format": ending, "read": False, "body": False, "helped": False}
    properties = []
    model = Model(path, ending)
    if ending not in STEPS:
        for attempt in range(MOST_ATTEMPTS):
            options = [word for name in model.skipped for word in ("--skip", name)]
            code, text, seconds, told = runner.run("mesh-info", "--json", *options, str(path))
            if attempt == 0:
                out.update(read=code == 0, code=code, seconds=seconds, reason=text)
            if code == 0 or not model.skip(text):
                break
        out["skipped"] = model.skipped
        if code:
            out.update(code=code, reason=text)
            return out
        told = json.loads(told)
        properties = sorted({entry["name"] for entry in told["properties"] if entry["name"]})
        low, high = told["box"]
        model.thickness = f"{max(b - a for a, b in zip(low, high)) / 100:.3g} m"
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, "model.yaml")
        for attempt in range(MOST_ATTEMPTS):
            file.write_text(model.text(), encoding="utf-8")
            code, text, seconds, _ = runner.run("check", str(file))
            text = text.replace(str(file), "model.yaml")
            out.update(code=code, reason=text, check_seconds=seconds, processor=runner.processor, helped=code == 0)
            if attempt == 0:
                if ending in STEPS:
                    out["read"] = code in (0, 3)
                out.update(body=code == 0 and out["read"], check_seconds=seconds)
            if code == 0 or not model.help(text, properties):
                break
    return out


def is_right(text):
    return any(pattern.search(text) for pattern in RIGHT)


def has_crashed(entry):
    return str(entry.get("code", 0)).startswith("signal") or entry.get("code") == 1


def table(entries):
    lines = ["| format | files | read | body | with help | of these skipping | refused rightly | else | time out | crash"
             " | slowest |", "|---|---|---|---|---|---|---|---|---|---|---|"]
    for form in sorted({entry["format"] for entry in entries}):
        own = [entry for entry in entries if entry["format"] == form]
        bad = [entry for entry in own if not entry["helped"]]
        right = [entry for entry in bad if is_right(entry["reason"])]
        late = [entry for entry in bad if entry.get("code") == "time"]
        crash = [entry for entry in own if has_crashed(entry)]
        slowest = max(entry.get("seconds", 0) + entry.get("check_seconds", 0) for entry in own)
        lines.append(f"| `{form}` | {len(own)} | {sum(e['read'] for e in own)} | {sum(e['body'] for e in own)}"
                     f" | {sum(e['helped'] for e in own)} | {sum(e['helped'] and bool(e.get('skipped')) for e in own)} | {len(right)} |"
                     f" {len(bad) - len(right) - len(late) - len(crash)} | {len(late)} | {len(crash)} | {slowest:.1f} s |")
    return "\n".join(lines)


def processor_times(entries):
    """Of the program with all that it starts; only one file after the other can be measured this way."""
    lines = []
    for form in sorted({entry["format"] for entry in entries}):
        taken = [entry["processor"] for entry in entries if entry["format"] == form and entry["read"] and entry.get("processor")]
        if taken:
            lines.append(f"processor time of `check`, {form}: median {statistics.median(taken):.1f} s, most {max(taken):.1f} s, "
                         f"{sum(t <= A_MINUTE for t in taken)} of {len(taken)} within {A_MINUTE} s")
    return "\n".join(lines)


def reasons(entries, with_files):
    out = []
    for form in sorted({entry["format"] for entry in entries}):
        groups = collections.defaultdict(list)
        for entry in entries:
            if entry["format"] == form and not entry["helped"]:
                groups[reason(entry["reason"])].append(entry)
        out.append(f"\n{form}")
        for text, group in sorted(groups.items(), key=lambda item: (-len(item[1]), item[0])):
            stage = "body" if group[0]["read"] else "read"
            mark = "right" if is_right(group[0]["reason"]) else "     "
            out.append(f"{len(group):5d} {stage} {mark} {text}")
            if with_files:
                out += [f"              {entry['file']}: {entry['reason'][:200]}" for entry in group]
    return "\n".join(out)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", type=pathlib.Path)
    parser.add_argument("--program", default="build/release/bin/buckens")
    parser.add_argument("--seconds", type=float, default=60, help="for one call of the program")
    parser.add_argument("--memory", type=int, default=6000, help="megabytes of addresses for one call")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--json", type=pathlib.Path, help="every file with its outcome")
    parser.add_argument("--list", action="store_true", help="the files under every reason")
    args = parser.parse_args()
    if not os.access(args.program, os.X_OK):
        sys.exit(f"{args.program}: there is no such program; build it, or name it with --program")
    known = DECKS | MESHES | STEPS
    files = [path for folder in args.folders for path in ([folder] if folder.is_file() else sorted(folder.rglob("*")))
             if path.is_file() and path.suffix.lower() in known]
    if not files:
        sys.exit("no files with one of the endings " + ", ".join(sorted(known)))
    runner = Runner(args.program, args.seconds, args.memory, args.jobs == 1)
    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        entries = list(pool.map(lambda path: examine(runner, path.resolve()), files))
    if args.json:
        args.json.write_text(json.dumps(entries, indent=1), encoding="utf-8")
    print(table(entries))
    print(processor_times(entries))
    print(reasons(entries, args.list))
    return 1 if any(has_crashed(entry) for entry in entries) else 0


if __name__ == "__main__":
    sys.exit(main())
