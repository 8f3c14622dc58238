# SPDX-License-Identifier: Apache-2.0
"""The example that compares methods, in its short form: it checks itself."""

import pathlib
import subprocess
import sys

from conftest import PROGRAM

EXAMPLES = pathlib.Path(__file__).parents[1] / "examples"
MODEL = (EXAMPLES / "method_comparison/method_comparison").with_suffix(".yaml")
COMPARE = MODEL.with_name("compare.py")


def test_methods_compare_as_the_page_says():
    done = subprocess.run([sys.executable, COMPARE, PROGRAM, "--short"], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    rows = [line for line in done.stdout.splitlines() if line.startswith("| ")]
    assert len(rows) == 11, "a heading and ten methods"
