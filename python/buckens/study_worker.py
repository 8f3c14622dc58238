# SPDX-License-Identifier: Apache-2.0
"""Workers of a study: they run variants and store their rows. Factors are reused by later tasks."""

from __future__ import annotations

import hashlib
import os
import pathlib
import threading
import time
from typing import Any, Dict, List, NamedTuple, Tuple

from . import _core
from .errors import InputError, IoError
from .study_journal import FOLDER, TaskJournal, worker_name

Variant = Tuple[str, List[str]]


class Study(NamedTuple):
    """Data common to all tasks of a study."""

    version: str
    name: str          # hash of model and changes
    model: str         # absolute path
    source: str        # hash of the model with all its files
    overrides: List[str]
    paths: List[str]
    out: str
    call: str = ""     # one call of buckens.sweep: its workers expect files that do not change


class Task(NamedTuple):
    """Waves that one worker runs in sequence; the variants of a wave advance together."""

    name: str
    group: int
    waves: List[List[Tuple[str, Variant]]]  # key and variant


class Done(NamedTuple):
    """The result of a task: all rows, and keys of those that are not on disk."""

    rows: List[Dict[str, Any]]
    unkept: List[str]
    worker: str
    seconds: float
    factorisations: int


_here = threading.local()  # a worker process may have several threads


def run_task(study: Study, task: Task) -> Done:
    """Runs those variants of a task that no earlier worker has finished."""
    start = time.perf_counter()
    journal = TaskJournal(pathlib.Path(study.out) / FOLDER, study.name, task.name)
    rows = journal.finished()
    runner = _runner(study, task.group)
    before = runner.num_factorisations
    unkept: List[str] = []
    try:
        for wave in task.waves:
            left = [(key, variant) for key, variant in wave if key not in rows]
            if not left:
                continue
            journal.begin([key for key, _ in left])
            began = time.perf_counter()
            found = runner.run([variant for _, variant in left])
            seconds = (time.perf_counter() - began) / len(left)
            new: List[Dict[str, Any]] = [{"key": key, "cells": cells, "seconds": round(seconds, 6), "files": files}
                                         for (key, _), (cells, files) in zip(left, found)]
            if not journal.add(new):
                unkept += [key for key, _ in left]
            rows.update({row["key"]: row for row in new})
    finally:
        journal.close()
    return Done(list(rows.values()), unkept, worker_name(), time.perf_counter() - start,
                runner.num_factorisations - before)


def source_hash(source: str) -> str:
    return hashlib.sha256(source.encode()).hexdigest()


def _runner(study: Study, group: int) -> _core.VariantRows:
    """Returns the runner of the previous task if it belongs to the same study, else a new one."""
    kept = getattr(_here, "kept", None)
    if kept is not None and kept[0] == study:
        runner: _core.VariantRows = kept[1]
        if kept[2] != group:
            runner.forget_factors()
            _here.kept = (study, runner, group)
        return runner
    _here.kept = None
    if _core.version != study.version:
        raise InputError(f"worker {worker_name()} has Buckens {_core.version}, the study was started by Buckens "
                         f"{study.version}; install one version on all machines")
    if not os.path.exists(study.model):
        raise IoError(f"worker {worker_name()} cannot see the model file {study.model}; put it where all workers see it "
                      "under this name")
    runner = _core.VariantRows(study.model, study.overrides, study.paths)
    if source_hash(runner.source) != study.source:
        raise IoError(f"worker {worker_name()} sees a different version of {study.model} or of a file that it names than "
                      "the process that started the study; put these files where all workers see the same ones, do not change them "
                      "during a study, and call again")
    _here.kept = (study, runner, group)
    return runner
