# SPDX-License-Identifier: Apache-2.0
"""A sweep on the workers of an executor: distribution of variants, lost workers and results."""

from __future__ import annotations

import concurrent.futures as cf
import math
import os
import pathlib
import time
import uuid
from collections import deque
from typing import Any, Deque, Dict, List, Optional, Set, Tuple

from . import _core
from .errors import Error, InputError, IoError
from .messages import tell_messages
from .model import ModelLike, Overrides, PathLike, model_of, overrides_of
from .program import file_of
from .study_journal import FOLDER, StudyJournal, hold, key_of, replace_file, unfinished_of
from .study_progress import Progress, ProgressDisplay
from .study_tables import TableLike, VariantTable, table_of
from .study_worker import Done, Study, Task, Variant, run_task, source_hash
from .study_workers import ExecutorLike, Workers, is_loss

TASK_SECONDS = 0.5    # that a task should last: long against handing it over, short against what a loss costs
TASKS_AHEAD = 2       # tasks per worker that are under way
MOST_LOSSES = 4       # of workers with the same variant

Wave = List[Tuple[str, Variant]]


class StudyRun:
    """One sweep: distributes waves of variants until each has a row."""

    def __init__(self, study: Study, table: VariantTable, workers: Workers, together: int, display: ProgressDisplay) -> None:
        self._study, self._table, self._workers, self._display = study, table, workers, display
        self._out = pathlib.Path(study.out)
        self._keys = [key_of(study.name, values) for _, values in table.variants]
        self._journal = StudyJournal(self._out, study.name)
        self._journal.read()
        for key in [key for key, row in self._journal.rows.items() if _status(row) == "failed"]:
            del self._journal.rows[key]  # runs again, as it does in a sweep of the program
        self.kept = set(self._keys) & set(self._journal.rows)
        self._start = time.monotonic()
        self._journal.begin_study({"variants": dict(zip(self._keys, (name for name, _ in table.variants))),
                                   "started": time.time(), "kept": len(self.kept)})
        self._queue = self._waves(together)
        self._num_queued = sum(len(wave) for _, wave in self._queue)
        self._returned: Set[str] = set()  # first keys of queued waves that a worker may have begun
        self._losses: Dict[str, int] = {}
        self._flying: Dict["cf.Future[Done]", Tuple[Task, str]] = {}  # with the scheduler that has it
        self._per_variant: Optional[float] = None
        self._number = 0
        self.factorisations = 0
        self.work_seconds: Dict[str, float] = {}  # by worker

    def _waves(self, together: int) -> Deque[Tuple[int, Wave]]:
        """Returns the waves to run, by group. They do not depend on what is finished, so that large bodies give the same bits."""
        groups = _core.matrix_groups(self._study.model, self._study.overrides, self._table.paths, self._table.variants)
        by_group: Dict[int, Dict[str, Variant]] = {}
        for key, group, variant in zip(self._keys, groups, self._table.variants):
            by_group.setdefault(group, {}).setdefault(key, variant)
        out: Deque[Tuple[int, Wave]] = deque()
        for group in sorted(by_group):
            members = list(by_group[group].items())
            for k in range(0, len(members), together):
                wave = members[k:k + together]
                if any(key not in self._journal.rows for key, _ in wave):
                    out.append((group, wave))
        return out

    def run(self) -> None:
        """Returns when every variant has ended; raises errors that concern the whole study."""
        is_hurried = True
        try:
            self._show()
            while self._queue or self._flying:
                while len(self._flying) < TASKS_AHEAD * self._workers.count and self._has_waves():
                    task = self._next_task()
                    future = self._workers.submit(run_task, self._study, task)
                    self._flying[future] = (task, self._workers.scheduler)
                ended, _ = cf.wait(self._flying, timeout=1.0, return_when=cf.FIRST_COMPLETED)
                for future in ended:
                    self._take(future, self._flying.pop(future)[0])
                if not ended:
                    self._look_after()
                self._show()
            is_hurried = False
        finally:
            for future in self._flying:
                future.cancel()
            self._workers.close(is_hurried)
            if not is_hurried:
                self._journal.read()
        self._journal.tidy()

    def _look_after(self) -> None:
        """Resubmits tasks that the scheduler has lost; called when nothing has been returned for a while."""
        self._workers.check()
        for future, (task, scheduler) in list(self._flying.items()):
            if scheduler != self._workers.scheduler and not future.done():
                del self._flying[future]
                future.cancel()
                self._take_loss(task)

    def _show(self) -> None:
        if self._display.is_due():
            self._journal.read()
            self._display.show(self.progress())

    def progress(self) -> Progress:
        rows = [self._journal.rows[key] for key in self._keys if key in self._journal.rows]
        names = dict(zip(self._keys, (name for name, _ in self._table.variants)))
        begun = {names[key]: value for key, value in self._journal.begun.items() if key in names}
        kept = sum(1 for key in self._keys if key in self.kept)
        return Progress.of(len(self._keys), kept, rows, begun, len(self._flying), time.monotonic() - self._start)

    def _has_waves(self) -> bool:
        """Whether there are waves to hand out, now that they can be. Some of those of lost tasks may have been finished since: by
        workers that had only lost their scheduler, or that were about to be ended."""
        if self._queue:
            self._workers.await_scheduler()
        if self._returned:
            self._journal.read()
            self._queue = deque((group, wave) for group, wave in self._queue
                                if any(key not in self._journal.rows for key, _ in wave))
            self._num_queued = sum(len(wave) for _, wave in self._queue)
            self._returned &= {wave[0][0] for _, wave in self._queue}
        return bool(self._queue)

    def _next_task(self) -> Task:
        """Returns waves of one group for one task: enough for its intended duration, but no more than a worker's share."""
        group = self._queue[0][0]
        size = len(self._queue[0][1])
        share = math.ceil(self._num_queued / (4 * self._workers.count) / size)
        wanted = share if self._per_variant is None else math.ceil(TASK_SECONDS / max(self._per_variant, 1e-6) / size)
        most = 1 if self._per_variant is None else max(1, min(wanted, share))
        waves: List[Wave] = []
        while self._queue and self._queue[0][0] == group and len(waves) < most:
            waves.append(self._queue.popleft()[1])
            self._num_queued -= len(waves[-1])
        self._number += 1
        return Task(f"{self._study.call}-{self._number}", group, waves)

    def _take(self, future: "cf.Future[Done]", task: Task) -> None:
        if is_loss(future):
            return self._take_loss(task)
        error = future.exception()
        if error is not None:
            raise _explained(error)
        done = future.result()
        unkept = set(done.unkept)
        for row in done.rows:
            changed = self._journal.changed_file(row)
            if changed is not None:
                raise IoError(f"worker {done.worker} has read a different content of {changed} than the process that started the "
                              "study; put the file where all workers see the same one, do not change it during a study, and call "
                              "again")
            if row["key"] in unkept:
                self._journal.keep(row)
            self._journal.take(row)
        self.factorisations += done.factorisations
        self.work_seconds[done.worker] = self.work_seconds.get(done.worker, 0.0) + done.seconds
        if done.rows:
            mean = sum(row["seconds"] for row in done.rows) / len(done.rows)
            self._per_variant = mean if self._per_variant is None else 0.7 * self._per_variant + 0.3 * mean

    def _take_loss(self, task: Task) -> None:
        """Reads what the lost worker had finished. Gives up variants with which workers were lost too often."""
        self._journal.read()
        group = task.group
        for wave in task.waves:
            left = unfinished_of((key for key, _ in wave), set(self._journal.rows))
            if not left:
                continue
            for key in left:
                if key in self._journal.begun:
                    self._journal.begun.pop(key)
                    self._losses[key] = self._losses.get(key, 0) + 1
            tired = [key for key in left if self._losses.get(key, 0) >= MOST_LOSSES]
            if tired and len(wave) > 1:  # one of them; which one shows when they run alone
                for key in left:
                    self._losses[key] = MOST_LOSSES - 1
                self._return(*((group, [item]) for item in wave if item[0] in left))
            elif tired:
                self._give_up(*wave[0])
            else:
                self._return((group, wave))

    def _return(self, *waves: Tuple[int, Wave]) -> None:
        self._queue.extendleft(waves)
        self._returned |= {wave[0][0] for _, wave in waves}
        self._num_queued += sum(len(wave) for _, wave in waves)

    def _give_up(self, key: str, variant: Variant) -> None:
        name, values = variant
        reason = (f"the worker that ran this variant was lost {MOST_LOSSES} times: killed, perhaps for want of memory; run the "
                  "variant by itself to see why")
        cells = [("name", name), *zip(self._study.paths, values), ("status", "failed"), ("message", reason)]
        self._journal.take({"key": key, "cells": cells, "seconds": 0.0})

    def rows(self) -> List[List[Tuple[str, str]]]:
        """Returns the cells of each variant in the order of the table."""
        out = []
        for key, (name, values) in zip(self._keys, self._table.variants):
            row = self._journal.rows.get(key)
            cells = [("name", name), *zip(self._study.paths, values)]
            if row is None:
                cells += [("status", "interrupted"), ("message", "")]
            else:
                found = [(str(column), str(cell)) for column, cell in row["cells"]][len(cells):]
                cells += [("status", "kept") if column == "status" and key in self.kept else (column, cell)
                          for column, cell in found]
            out.append(cells)
        return out


def _status(row: Dict[str, Any]) -> str:
    return next((str(cell) for column, cell in row["cells"] if column == "status"), "")


def _explained(error: BaseException) -> BaseException:
    if isinstance(error, ImportError):
        return IoError(f"a worker cannot load the module: {error}; install the same Buckens on all machines, or set PYTHONPATH "
                       "where the workers are started")
    return error if isinstance(error, (Error, KeyboardInterrupt, MemoryError)) else Error(
        f"a worker failed: {type(error).__name__}: {error}")


def sweep_on(executor: ExecutorLike, model: ModelLike, table: TableLike, out: PathLike, together: Optional[int],
             set: Overrides, progress: Any, workers: Optional[int]) -> Dict[str, Any]:  # noqa: A002
    """Runs :func:`buckens.sweep` with an executor."""
    folder = pathlib.Path(out).absolute()
    try:
        (folder / FOLDER).mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise IoError(f"{folder}: cannot create the directory of the study: {error.strerror}") from None
    together = 6 if together is None else together
    if not isinstance(together, int) or not 1 <= together <= 32:
        raise InputError(f"together: expected a whole number from 1 to 32, found {together!r}")
    with hold(folder / FOLDER):
        path = _lasting(model, folder / FOLDER)
        variants = table_of(table, folder / FOLDER)
        overrides = overrides_of(set)
        source = source_hash(_core.VariantRows(path, overrides, variants.paths).source)
        study = Study(_core.version, key_of(_core.version + source, variants.paths), path, source, overrides, variants.paths,
                      str(folder), uuid.uuid4().hex[:8])
        run = StudyRun(study, variants, Workers(executor, workers), together, ProgressDisplay(progress))
        try:
            run.run()
        finally:
            rows = run.rows()
            _core.write_table(str(folder), rows)
            tell_messages()
    return _answer(run, rows, folder)


def _lasting(model: ModelLike, folder: pathlib.Path) -> str:
    """Returns the model file; writes a model in memory next to the results, where workers can read it."""
    if isinstance(model, (str, os.PathLike)):
        return os.path.abspath(model)
    model = model_of(model)
    with file_of(model) as file:
        text = pathlib.Path(file).read_text(encoding="utf-8")
    replace_file(folder / "model.yaml", model._files.write_beside(str(folder), text, is_absolute=True))
    return str(folder / "model.yaml")


def _answer(run: StudyRun, rows: List[List[Tuple[str, str]]], folder: pathlib.Path) -> Dict[str, Any]:
    variants = []
    for row in rows:
        cells = dict(row)
        variants.append({"name": cells["name"], "status": cells["status"]})
        if cells["message"]:
            variants[-1]["message"] = cells["message"]
    return {"table": str(folder / "sweep.csv"), "variants": variants, "factorisations": run.factorisations,
            "workers": {name: round(seconds, 3) for name, seconds in sorted(run.work_seconds.items())}}
