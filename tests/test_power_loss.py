# SPDX-License-Identifier: Apache-2.0
"""A loss of power at any moment: of what was written after the last checkpoint, the disk has any part."""

import os
import random
import shutil
import signal
import time

import pytest

from conftest import BINARY
from test_continue import CASES, FREQUENT, check_same, wait_for

SHADOW = BINARY / "test" / "libkept_by_disk.so"
PAGE = 4096
SEEDS = range(int(os.environ.get("BUCKENS_LOSSES", "1")))


def as_synced(chance, synced, later):
    """Nothing of what came later."""
    return synced


def cut(chance, synced, later):
    """The length is the old one, what was changed within it is there."""
    return later[:len(synced)]


def zeroed(chance, synced, later):
    """The length is the new one, the blocks were not written."""
    return later[:len(synced)] + bytes(max(0, len(later) - len(synced)))


def any_pages(chance, synced, later):
    """Each page has come to the disk, or not; the length is any between."""
    pages = []
    for at in range(0, len(later), PAGE):
        before = synced[at:at + PAGE].ljust(len(later[at:at + PAGE]), b"\0")
        pages.append(later[at:at + PAGE] if chance.random() < 0.5 else before)
    return b"".join(pages)[:chance.randint(len(synced), max(len(synced), len(later)))]


def lose_power(directory, kept, loss, chance, to):
    """The run directory as the disk has it."""
    to.mkdir()
    for file in directory.iterdir():
        synced = (kept / file.name).read_bytes() if (kept / file.name).exists() else b""
        later = file.read_bytes()
        if file.name == "checkpoint.h5":
            later = synced  # it is replaced as a whole
        (to / file.name).write_bytes(loss(chance, synced, later))


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("loss", [as_synced, cut, zeroed, any_pages])
@pytest.mark.parametrize("name", ["fields and extremes", "friction, stops"])
def test_power_goes(buckens, start, tmp_path, name, loss, seed):
    if not SHADOW.exists():
        pytest.skip("the file that keeps what is synced is not built")
    chance = random.Random(f"{name} {seed}")
    (tmp_path / "model.yaml").write_text(CASES[name])
    began = time.monotonic()
    buckens("run", "model.yaml", "-q", "-o", "whole", *FREQUENT).must(0)
    length = time.monotonic() - began
    kept, out = tmp_path / "kept", tmp_path / "out"
    delay = chance.uniform(0, length / 2)
    for _ in range(10):
        shutil.rmtree(kept, ignore_errors=True)
        kept.mkdir()
        process = start("run", "model.yaml", "-q", "-o", "out", *FREQUENT,
                        env=os.environ | {"LD_PRELOAD": str(SHADOW), "DISK_KEEPS": str(kept)})
        wait_for(kept / "checkpoint.h5", process)
        time.sleep(delay)
        process.send_signal(signal.SIGKILL)
        process.communicate(timeout=60)
        if process.returncode == -signal.SIGKILL:
            break
        delay *= 0.5  # it was at its end already
    assert process.returncode == -signal.SIGKILL
    lose_power(out, kept, loss, chance, tmp_path / "lost")
    shutil.rmtree(out)
    buckens("run", "--continue", "lost", "-q").must(0)
    check_same(tmp_path / "whole", tmp_path / "lost")
