# SPDX-License-Identifier: Apache-2.0
"""Progress of a study over all workers: remaining time and slow variants."""

from __future__ import annotations

import json
import pathlib
import sys
import time
from typing import Any, Callable, Dict, List, NamedTuple, Optional, Sequence, Tuple, Union

from .errors import InputError
from .model import PathLike
from .study_journal import FOLDER, STUDY, StudyJournal

_INTERVAL = 2.0  # between lines [s]


class Progress(NamedTuple):
    """Progress of a study.

    Attributes
    ----------
    variants, done, failed, kept
        Numbers of all variants, of those with a result, of failed ones, and of those in `done` that an earlier call had
        finished.
    running
        Name, elapsed time [s] and worker of running variants, the oldest first.
    slowest
        Name and duration [s] of the five slowest variants.
    seconds_each
        Mean duration of a variant [s]; None before the first.
    under_way
        Number of submitted tasks.
    per_second
        Variants per second, without those in `kept`; None before the first.
    seconds_to_go
        Remaining time at this rate [s]; None before the first variant.
    """

    variants: int
    done: int
    failed: int
    kept: int
    running: List[Tuple[str, float, str]]
    slowest: List[Tuple[str, float]]
    seconds_each: Optional[float]
    under_way: int
    per_second: Optional[float] = None
    seconds_to_go: Optional[float] = None

    @classmethod
    def of(cls, variants: int, kept: int, rows: Sequence[Dict[str, Any]], begun: Dict[str, Tuple[float, str]],
           under_way: int, passed: float) -> Progress:
        """Takes the rows that there are, what is being run, and the seconds since the start of the call."""
        failed = sum(1 for row in rows if ["status", "failed"] in [list(cell) for cell in row["cells"]])
        times = [(str(row["cells"][0][1]), float(row["seconds"])) for row in rows]
        slowest = sorted(times, key=lambda item: -item[1])[:5]
        now = time.time()
        running = sorted(((name, now - since, worker) for name, (since, worker) in begun.items()), key=lambda item: -item[1])
        mean = sum(seconds for _, seconds in times) / len(times) if times else None
        rate = (len(rows) - kept) / passed if len(rows) > kept and passed > 0 else None
        left = variants - len(rows)
        to_go = left / rate if rate else None if left else 0.0
        return cls(variants, len(rows) - failed, failed, kept, running, slowest, mean, under_way, rate, to_go)

    @property
    def ended(self) -> int:
        return self.done + self.failed


ProgressLike = Union[bool, Callable[[Progress], object]]


class ProgressDisplay:
    """Shows progress every two seconds, on the standard error stream or by calling a function."""

    def __init__(self, progress: ProgressLike) -> None:
        if progress is not None and not isinstance(progress, bool) and not callable(progress):
            raise InputError(f"progress: expected True, False or a function of a buckens.study.Progress, found {progress!r}")
        self._tell = progress
        self._next = time.monotonic()

    def is_due(self) -> bool:
        return bool(self._tell) and time.monotonic() >= self._next

    def show(self, progress: Progress) -> None:
        """Shows progress now; :meth:`is_due` tells when that is due."""
        self._next = time.monotonic() + _INTERVAL
        if callable(self._tell):
            self._tell(progress)
        else:
            print(text_of(progress), file=sys.stderr, flush=True)


def text_of(progress: Progress) -> str:
    """Returns progress as a line."""
    parts = [f"{progress.ended} of {progress.variants} variants", f"{progress.failed} failed"]
    if progress.per_second is not None and progress.seconds_to_go is not None:
        parts.append(f"{progress.per_second:.1f} per second, {clock(progress.seconds_to_go)} to go")
    if progress.running and progress.seconds_each and progress.running[0][1] > 3 * progress.seconds_each + 1:
        name, age, worker = progress.running[0]
        parts.append(f"slow: {name} for {clock(age)} on {worker}")
    return ", ".join(parts)


def clock(seconds: float) -> str:
    """Returns a duration as text."""
    minutes, rest = divmod(int(seconds + 0.5), 60)
    hours, minutes = divmod(minutes, 60)
    if hours:
        return f"{hours} h {minutes} min"
    return f"{minutes} min {rest} s" if minutes else f"{rest} s"


def status(out: PathLike) -> Progress:
    """Returns the progress of a study that runs in another process or was stopped.

    Parameters
    ----------
    out
        Directory of the study.

    Raises
    ------
    InputError
        If there is no study in the directory.
    """
    folder = pathlib.Path(out)
    try:
        about = json.loads((folder / FOLDER / STUDY).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        raise InputError(f"{folder}: there is no study here; give the directory `out` of a buckens.sweep with an "
                         "executor") from None
    journal = StudyJournal(folder, about["study"])
    journal.read()
    names = about["variants"]
    rows = [row for key, row in journal.rows.items() if key in names]
    begun = {names[key]: value for key, value in journal.begun.items() if key in names}
    # Until the last row: the time since then tells nothing of the rate if the study was stopped.
    passed = journal.last_change() - float(about.get("started", "inf"))
    return Progress.of(len(names), int(about.get("kept", 0)), rows, begun, 0, passed)
