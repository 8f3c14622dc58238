# SPDX-License-Identifier: Apache-2.0
"""Steps cost no more solves, iterations, numbers read and allocations than when that was last stored."""

import copy
import json
import subprocess
import sys

import pytest
from conftest import BINARY, SOURCE

sys.path.insert(0, str(SOURCE / "bench"))
import guard  # noqa: E402


def test_steps_cost_no_more_than_stored():
    if not (BINARY / "bench" / "step_counts").exists():
        pytest.skip("the benchmark programs are not built (BUCKENS_BENCH)")
    found = guard.measure(BINARY)
    stored = json.loads(guard.STORED.read_text())
    assert list(guard.dearer(found, stored)) == []
    # What the figures stand for: one solve per step at all levels, and none of a rigid chain.
    counts = found["counts"]
    assert counts["block hex8 20 x 4 x 4, none"]["solves"] == 1
    assert counts["block hex8 20 x 4 x 4, first-order"]["solves"] == 1
    assert counts["block hex8 20 x 4 x 4, full"]["solves"] < 1.3
    assert counts["rigid chain, 100 links"]["solves"] == 0


def test_the_guard_tells_what_has_become_dearer():
    stored = json.loads(guard.STORED.read_text())
    assert list(guard.dearer(stored, stored)) == []
    worse = copy.deepcopy(stored)
    worse["counts"]["block hex8 20 x 4 x 4, full"]["solves"] *= 1.5
    worse["counts"]["rigid chain, 100 links"]["allocations"] += 1
    del worse["counts"]["beam in the plane, 64 frames"]
    worse["ratios"]["full over first-order, block hex8 20 x 4 x 4"] *= 2
    lines = list(guard.dearer(worse, stored))
    assert len(lines) == 4
    assert any("solves" in line for line in lines) and any("not measured" in line for line in lines)
    assert len(list(guard.cheaper(stored, worse))) == 2


def test_the_guard_says_what_it_does():
    done = subprocess.run([sys.executable, SOURCE / "bench" / "guard.py", "--help"], capture_output=True,
                          text=True, check=True)
    assert "--store" in done.stdout
