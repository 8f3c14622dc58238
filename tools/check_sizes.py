#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Sizes: files of at most 600 lines (a warning above 300), functions of at most 60."""

import argparse
import ast
import re
import sys

import source_files

MAX_FILE, WARN_FILE, MAX_FUNCTION = 600, 300, 60
SIZED = re.compile(r"\.(h|cpp|py|ts|mjs|js|css|cmake|sh)$|(^|/)CMakeLists\.txt$")
NAMESPACE = re.compile(r"(\bnamespace\b[\w:\s]*|\bextern\s*)$")
TYPE = re.compile(r"\b(class|struct|union|enum)\b")
# After "Type(...) :" a brace following a name opens a member's initialiser, not the function's body.
MEMBER_INITIALISER = re.compile(r"\)\s*(noexcept\s*)?:(?!:).*[\w>]\s*$", re.DOTALL)


def blank_preprocessor(text):
    """Macros may contain unbalanced braces."""
    return re.sub(r"^[ \t]*#(?:[^\n\\]|\\\n|\\.)*",
                  lambda match: re.sub(r"[^\n]", " ", match.group(0)), text, flags=re.MULTILINE)


def scope_kind(head):
    """The kind of block opened by the brace after this statement head."""
    if NAMESPACE.search(head):
        return "namespace"
    # Parameters may name a struct, template parameters a class: examine the rest.
    flat = re.sub(r"<[^<>]*>", "", re.sub(r"<[^<>]*>", "", head))
    if ")" not in flat:
        return "type" if TYPE.search(flat) else "initialiser"
    outside = re.sub(r"\([^()]*\)", "", re.sub(r"\([^()]*\)", "", flat))
    if TYPE.search(outside) and not re.search(r"[=]", outside) and "(" not in flat.split("{")[0]:
        return "type"
    return "function"


def cpp_functions(text):
    """(name, first line, number of lines) of every function defined in C++ text."""
    text = blank_preprocessor(source_files.blank_comments_and_strings(text))
    scopes, head_start, found = [], 0, []
    for match in re.finditer(r"[{};]", text):
        position, mark = match.start(), match.group(0)
        inside = scopes and scopes[-1][0] in ("function", "initialiser", "skip")
        if mark == "{":
            head = text[head_start:position]
            if inside:
                scopes.append(("skip", position, ""))
                continue
            if MEMBER_INITIALISER.search(head):
                scopes.append(("skip", position, ""))
                continue
            scopes.append((scope_kind(head), head_start, head))
            if scopes[-1][0] in ("namespace", "type"):
                head_start = position + 1
        elif mark == "}" and scopes:
            kind, start, head = scopes.pop()
            if kind == "function":
                start += re.match(r"(\s|(public|private|protected)\s*:)*", head).end()
                first, last = source_files.line_of(text, start), source_files.line_of(text, position)
                name = re.search(r"([\w:~]+|operator\S+)\s*\(", head)
                found.append((name.group(1) if name else "?", first, last - first + 1))
            if kind != "skip":
                head_start = position + 1
        elif mark == ";" and not inside:
            head_start = position + 1
    return found


def python_functions(text):
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            yield node.name, node.lineno, node.end_lineno - node.lineno + 1


def check(root):
    errors, warnings = [], []
    for name in source_files.list_files(root):
        if not SIZED.search(name):
            continue
        text = source_files.read(root, name)
        lines = text.count("\n")
        if lines > MAX_FILE:
            errors.append(f"{name}: {lines} lines; at most {MAX_FILE}, better below {WARN_FILE}")
        elif lines > WARN_FILE:
            warnings.append(f"warning: {name}: {lines} lines; better below {WARN_FILE}")
        functions = ()
        if name.endswith((".h", ".cpp")):
            functions = cpp_functions(text)
        elif name.endswith(".py"):
            functions = python_functions(text)
        errors += [f"{name}:{line}: function {function} has {length} lines; at most {MAX_FUNCTION}"
                   for function, line, length in functions if length > MAX_FUNCTION]
    return errors, warnings


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("root", nargs="?", default=".")
    found_errors, found_warnings = check(parser.parse_args().root)
    print("\n".join(found_warnings), end="\n" if found_warnings else "")
    sys.exit(source_files.report("sizes", found_errors))
