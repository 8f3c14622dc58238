# SPDX-License-Identifier: Apache-2.0
"""Executors of any kind as the workers of a study: their creation, number and failure."""

from __future__ import annotations

import concurrent.futures as cf
import multiprocessing
import os
import time
from typing import Any, Callable, Optional, Union

from .errors import Error, InputError, IoError
from .study_checks import check_count

#: A number of local processes, an executor, a Dask Client, or a function that creates an executor.
ExecutorLike = Union[int, "cf.Executor", Callable[[], Any], Any]

_PATIENCE = 60.0  # for a scheduler that does not answer [s]


class Workers:
    """Submits work to an executor, and replaces a broken one where possible."""

    def __init__(self, executor: ExecutorLike, count: Optional[int] = None) -> None:
        if count is not None:
            check_count(count, 1, "workers", "leave it out where the executor reports how many it has")
        self._make: Optional[Callable[[], Any]] = None
        self._is_own = True
        if isinstance(executor, int) and not isinstance(executor, bool):
            if not 1 <= executor <= 4096:
                raise InputError(f"executor: expected 1 to 4096 processes, found {executor}")
            processes = executor
            # Not copies of this process, which may have threads.
            self._make = lambda: cf.ProcessPoolExecutor(processes, multiprocessing.get_context("forkserver"))
        elif callable(executor) and (isinstance(executor, type) or not hasattr(executor, "submit")):
            self._make = executor
        elif hasattr(executor, "get_executor"):  # a Client of Dask
            self._executor: Any = executor.get_executor(pure=False)
            self._is_own = False
        elif hasattr(executor, "submit"):
            self._executor = executor
            self._is_own = False
        else:
            raise InputError(f"executor: expected a number of processes or something with `submit`, such as an executor of "
                             f"concurrent.futures or a Client of Dask, found {executor!r}")
        if self._make is not None:
            self._executor = self._make()
            if not hasattr(self._executor, "submit"):
                raise InputError(f"executor: expected a function that creates something with `submit`, such as an executor of "
                                 f"concurrent.futures, but it returned {self._executor!r}")
        self._client: Any = executor if hasattr(executor, "get_executor") else getattr(executor, "_client", None)
        self._asked = count
        self._known, self._next_question = 1, 0.0
        self._connection: Any = None  # of the client to the scheduler that was asked last
        #: Changes when the scheduler of Dask is started again, which forgets what it was given.
        self.scheduler = ""

    @property
    def count(self) -> int:
        """Number of tasks that run in parallel, as far as known."""
        if self._asked is not None:
            return self._asked
        if self._client is not None:
            self._ask_scheduler()
            return self._known
        known = getattr(self._executor, "_max_workers", None) or getattr(self._executor, "num_workers", None)
        return int(known) if known else os.cpu_count() or 1

    def _ask_scheduler(self) -> None:
        """Updates the number of threads; keeps the last known one while the scheduler does not answer."""
        now, connection = time.monotonic(), getattr(self._client, "scheduler_comm", None)
        if now < self._next_question and connection is self._connection:
            return
        self._next_question, self._connection = now + 2.0, connection
        if self._client.status == "running":
            try:
                about = self._client.scheduler_info()
                self._known = max(1, sum(int(worker["nthreads"]) for worker in about["workers"].values()))
                self.scheduler = str(about["id"])
            except Exception:  # of a kind that only the client knows; what it means shows when work is handed over
                pass

    def submit(self, function: Callable[..., Any], *arguments: Any) -> "cf.Future[Any]":
        """Submits a call; replaces a broken executor first.

        Raises
        ------
        IoError
            If no executor is left.
        """
        self.await_scheduler()
        deadline = time.monotonic() + _PATIENCE
        while True:
            try:
                future: "cf.Future[Any]" = self._executor.submit(function, *arguments)
                return future
            except Exception as error:  # of a kind that only the executor knows
                if self._make is None or time.monotonic() > deadline:
                    raise _no_more_work(f"{type(error).__name__}: {error}") from error
                self._renew()
                time.sleep(0.1)

    def check(self) -> None:
        """Call this while no results arrive; raises IoError if none can arrive."""
        if self._client is not None and self._client.status == "closed":
            raise _no_more_work("the connection to the Dask scheduler was lost")
        if self._client is not None:
            self._ask_scheduler()

    def await_scheduler(self) -> None:
        """Waits for the scheduler, which may be restarted; work submitted without it would be lost.

        Raises
        ------
        IoError
            If it does not answer.
        """
        deadline = time.monotonic() + _PATIENCE
        while self._client is not None and self._client.status != "running":
            self._next_question = 0.0  # it may be another one then
            if self._client.status == "closed" or time.monotonic() > deadline:
                raise _no_more_work("the connection to the Dask scheduler was lost")
            time.sleep(0.1)
        if self._client is not None:
            self._ask_scheduler()

    def _renew(self) -> None:
        self._executor.shutdown(wait=False)
        assert self._make is not None
        self._executor = self._make()

    def close(self, is_hurried: bool) -> None:
        """Shuts down an executor that was created here."""
        if self._is_own:
            self._executor.shutdown(wait=not is_hurried, cancel_futures=True)


def _no_more_work(reason: str) -> IoError:
    return IoError(f"the executor takes no more work ({reason}); call again with another one: what is finished is kept")


def is_loss(future: "cf.Future[Any]") -> bool:
    """Whether a task failed because its worker or scheduler was lost, not by its own error."""
    if future.cancelled():
        return True
    error = future.exception()
    if error is None or isinstance(error, (Error, ImportError)):
        return False
    if isinstance(error, (cf.BrokenExecutor, cf.CancelledError, ConnectionError, EOFError, BrokenPipeError)):
        return True
    # Those of Dask, which need not be installed here: KilledWorker, CommClosedError, FutureCancelledError.
    return type(error).__module__.split(".")[0] == "distributed"
