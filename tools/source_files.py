# SPDX-License-Identifier: Apache-2.0
"""The files examined by the structural checks, and C++ text without comments and strings."""

import os
import re
import subprocess

SKIPPED_FOLDERS = {".git", "build", "node_modules", "dist", "__pycache__"}

_TOKEN = re.compile(
    r"""//[^\n]*
      | /\*.*?\*/
      | R"(?P<tag>[^()\s]*)\(.*?\)(?P=tag)"
      | "(?:\\.|[^"\\\n])*"
      | '(?:\\.|[^'\\\n])+'""",
    re.DOTALL | re.VERBOSE,
)


def list_files(root):
    """Paths relative to root: what git tracks or would add; every file outside a repository."""
    try:
        listing = subprocess.run(
            ["git", "-C", root, "ls-files", "-co", "--exclude-standard", "-z"],
            check=True, capture_output=True, text=True).stdout
        names = [name for name in listing.split("\0") if name]
    except (OSError, subprocess.CalledProcessError):
        names = []
        for folder, folders, files in os.walk(root):
            folders[:] = [f for f in folders if f not in SKIPPED_FOLDERS]
            names += [os.path.relpath(os.path.join(folder, f), root) for f in files]
    return sorted(name for name in names if os.path.isfile(os.path.join(root, name)))


def read(root, name):
    with open(os.path.join(root, name), encoding="utf-8", errors="replace") as file:
        return file.read()


def blank_comments_and_strings(text, keep_strings=False):
    """Replaces comments (and strings) by blanks; lines and columns are kept."""

    def blank(match):
        token = match.group(0)
        if keep_strings and not token.startswith("/"):
            return token
        # A digit separator (1'000) is not a character literal.
        if token.startswith("'") and match.start() and text[match.start() - 1].isalnum():
            return token
        return re.sub(r"[^\n]", " ", token)

    return _TOKEN.sub(blank, text)


def line_of(text, offset):
    return text.count("\n", 0, offset) + 1


def report(check, errors):
    """Prints the errors and the verdict; returns the exit code."""
    for error in errors:
        print(error)
    print(f"{check}: {len(errors)} error(s)" if errors else f"{check}: ok")
    return 1 if errors else 0
