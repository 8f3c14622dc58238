#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Pages: links, headings, pictures and paths that they name exist; every page of docs/ is reached from
docs/README.md, every example from docs/tutorials/README.md; no table is torn by an empty line; formulas
are written so that every viewer of Markdown passes them on unharmed. No file holds a path of one machine
or a mark of unfinished work."""

import argparse
import os
import posixpath
import re
import sys

import source_files

LINK = re.compile(r"\[[^\]]*\]\(([^()\s]+)\)")
FENCE = re.compile(r"^```.*?^```", re.DOTALL | re.MULTILINE)
HEADING = re.compile(r"^#+ +(.*)$", re.MULTILINE)
# A path of the checkout in backticks; capitals as in TARGET_fuzz.cpp stand for any name.
OWN_PATH = re.compile(r"`((?:src|tests|verification|examples|docs|bench|tools|apps|viewer|cmake|schema)/[\w./-]+)`")
ANY_NAME = re.compile(r"[A-Z]{4,}(?![a-z])")
TORN_TABLE = re.compile(r"^\|.*\|\n\n(?=\|.*\|\n(?!\|[-:| ]+\|\n))", re.MULTILINE)

CODE = re.compile(r"`[^`\n]*`")
# Formulas: between $$ on lines of their own, and in lines. docs/developers/writing.md has the rules.
DISPLAYED = re.compile(r"^\$\$\n(.*?)\n\$\$$", re.DOTALL | re.MULTILINE)
INLINE = re.compile(r"(?<![\\$])\$([^$\n]+)\$(?!\$)")
WORDS = re.compile(r"\\(?:text|tag\*?)\{[^{}]*\}")
HARMED = re.compile(r"\\[^A-Za-z\s\\]|[<>]|[^\x00-\x7f]")

TEXT = re.compile(r"\.(h|cpp|py|sh|cmake|ts|mjs|js|css|html|md|yaml|yml|json|inp|bdf|geo|csv|toml)$"
                  r"|(^|/)(CMakeLists\.txt|NOTICE|CITATION\.cff)$")
# Written so that this file does not contain what it searches for.
MACHINE_PATH = re.compile(r"(?<![\w.])/(?:work|home|root|Users)/\w|/tm" r"p/\w|\.\./shar" "ed")
UNFINISHED = re.compile(r"\b(TO" r"DO|FIX" r"ME|HA" r"CK|XX" r"X)\b")


def anchor(heading):
    """The anchor of a heading."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading.strip())
    return re.sub(r"[^\w\- ]", "", text.lower()).replace(" ", "-")


def blanked(match):
    """Spaces for what was found; line numbers are kept."""
    return re.sub(r"[^\n]", " ", match.group(0))


def blank_fences(text):
    """Removes blocks of code."""
    return FENCE.sub(blanked, text)


def formula_faults(text):
    """(offset, what is wrong) of the formulas of a page without its fences."""
    text = CODE.sub(blanked, text)
    for kind in (DISPLAYED, INLINE):
        for match in kind.finditer(text):
            formula = WORDS.sub("", match.group(1))
            for sign in HARMED.findall(formula):
                yield match.start(), f"`{sign}` in a formula may get lost; write a command of letters, such as \\lbrace or \\lt"
            line_start = text.rfind("\n", 0, match.start()) + 1
            if kind is INLINE and text.startswith("|", line_start) and "|" in formula:
                yield match.start(), "| in a formula divides the row of a table; write \\vert"
            if kind is INLINE and re.search(r"[^\s(|*]$", text[line_start:match.start()]):
                yield match.start(), "a formula begins after a space or an opening bracket, or GitHub shows its source"
        text = kind.sub(blanked, text)
    for match in re.finditer(r"^.*\$\$.*$", text, re.MULTILINE):
        yield match.start(), "$$ stands on a line of its own before and after a formula"


def exists(names, path):
    return path in names or any(name.startswith(path.rstrip("/") + "/") for name in names)


def links(root, names, page, text):
    """(offset, target inside the checkout, error or None) of every link of a page."""
    for match in LINK.finditer(text):
        path, _, heading = match.group(1).partition("#")
        if re.match(r"[a-z]+:", path):
            continue
        target = posixpath.normpath(posixpath.join(posixpath.dirname(page), path)) if path else page
        error = None
        if not exists(names, target):
            error = f"the link to {match.group(1)} leads nowhere"
        elif heading and target.endswith(".md"):
            known = [anchor(h) for h in HEADING.findall(blank_fences(source_files.read(root, target)))]
            if heading not in known:
                error = f"{target} has no heading #{heading}"
        yield match.start(), target, error


def check_page(root, names, page):
    """Errors of one page, and the targets of its links."""
    errors, targets = [], set()
    text = blank_fences(source_files.read(root, page))

    def report(offset, what):
        errors.append(f"{page}:{source_files.line_of(text, offset)}: {what}")

    for offset, target, error in links(root, names, page, text):
        targets.add(target)
        if error:
            report(offset, error)
    for match in OWN_PATH.finditer(text):
        if not ANY_NAME.search(match.group(1)) and not exists(names, match.group(1)):
            report(match.start(), f"there is no {match.group(1)}")
    for match in TORN_TABLE.finditer(text):
        report(match.end(), "an empty line tears the table; remove it or give the rows a head")
    for offset, fault in formula_faults(text):
        report(offset, fault)
    return errors, targets


def check_marks(root, names):
    errors = []
    for name in names:
        if not TEXT.search(name):
            continue
        text = source_files.read(root, name)
        for pattern, what in ((MACHINE_PATH, "is a path of one machine"),
                              (UNFINISHED, "marks unfinished work")):
            for match in pattern.finditer(text):
                errors.append(f"{name}:{source_files.line_of(text, match.start())}: "
                              f"`{match.group(0)}` {what}")
    return errors


def check(root):
    names = set(source_files.list_files(root))
    errors, targets = [], {}
    for page in sorted(name for name in names if name.endswith(".md")):
        found, targets[page] = check_page(root, names, page)
        errors += found
    index = targets.get("docs/README.md", set())
    for page in sorted(targets):
        if page.startswith("docs/") and page != "docs/README.md" and page not in index:
            errors.append(f"docs/README.md: does not lead to {page}")
    list_page = "docs/tutorials/README.md"
    examples = {name.split("/")[1] for name in names if re.match(r"examples/[^/]+/", name)}
    for example in sorted(examples):
        if f"examples/{example}/README.md" not in targets.get(list_page, set()):
            errors.append(f"{list_page}: does not lead to examples/{example}/README.md")
    return errors + check_marks(root, sorted(names))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("root", nargs="?", default=".")
    sys.exit(source_files.report("pages", check(os.path.abspath(parser.parse_args().root))))
