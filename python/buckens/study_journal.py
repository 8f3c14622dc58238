# SPDX-License-Identifier: Apache-2.0
"""Finished variants of a study on disk: lines of JSON that workers append, one file per worker and task.

Readers skip lines that are incomplete because their writer was killed or its disk was full. Nothing finished is lost, and no
row is read in part. The folder is OUT/.rows; `study.json` in it identifies the study.
"""

from __future__ import annotations

import fcntl
import hashlib
import json
import os
import pathlib
import socket
import time
from contextlib import contextmanager
from typing import Any, Dict, Iterable, Iterator, List, Optional, Sequence, Set, Tuple

from .errors import InputError
from .study_files import FileContents

Cells = List[Tuple[str, str]]
FOLDER, STUDY, KEPT = ".rows", "study.json", "kept.jsonl"


def key_of(study: str, values: Sequence[str]) -> str:
    """Returns a key that depends on everything that determines the row of a variant."""
    text = "\0".join([study, *values])
    return hashlib.sha256(text.encode()).hexdigest()[:24]


def replace_file(path: pathlib.Path, text: str) -> None:
    """Replaces a file atomically: readers see the old contents or the new."""
    part = path.with_name(f"{path.name}.{os.getpid()}.part")
    with open(part, "w", encoding="utf-8") as file:
        file.write(text)
        file.flush()
        os.fsync(file.fileno())
    os.replace(part, path)


class TaskJournal:
    """The file of one worker for one task."""

    def __init__(self, folder: pathlib.Path, study: str, task: str) -> None:
        self._folder, self._task = folder, task
        self._file: Optional[int] = None
        # A worker that does not see the disk of the study must not make a folder of its own.
        self._is_shared = _study_in(folder).get("study") == study

    def finished(self) -> Dict[str, Dict[str, Any]]:
        """Returns rows of this task from workers that were lost before its end."""
        out: Dict[str, Dict[str, Any]] = {}
        if self._is_shared:
            for path in self._folder.glob(f"{self._task}-*.jsonl"):
                out.update({line["key"]: line for line in _lines(path.read_bytes()) if "cells" in line})
        return out

    def begin(self, keys: Sequence[str]) -> None:
        """Records which variants are being run, in case the worker is lost."""
        self._append([{"begin": list(keys), "at": time.time(), "worker": worker_name()}])

    def add(self, rows: Sequence[Dict[str, Any]]) -> bool:
        """Stores finished rows. Returns whether they are on disk."""
        return self._append(rows)

    def close(self) -> None:
        if self._file is not None:
            os.close(self._file)
            self._file = None

    def _append(self, lines: Sequence[Dict[str, Any]]) -> bool:
        if not self._is_shared:
            return False
        text = "".join(json.dumps(line) + "\n" for line in lines).encode()
        try:
            if self._file is None:
                name = f"{self._task}-{socket.gethostname()}-{os.getpid()}-{time.monotonic_ns():x}.jsonl"
                self._file = os.open(self._folder / name, os.O_WRONLY | os.O_CREAT | os.O_APPEND | os.O_EXCL, 0o666)
            if os.write(self._file, text) == len(text):
                return True
        except OSError:
            pass
        self.close()  # half a line may be there: the next one goes to another file
        return False


class StudyJournal:
    """All files of a study, for the process that distributes its variants."""

    def __init__(self, out: pathlib.Path, study: str) -> None:
        self.folder = out / FOLDER
        self.folder.mkdir(parents=True, exist_ok=True)
        self._study = study
        self._places: Dict[str, int] = {}
        self.rows: Dict[str, Dict[str, Any]] = {}
        self.begun: Dict[str, Tuple[float, str]] = {}  # key: since when, by which worker
        self._own: Optional[TaskJournal] = None
        self._contents = FileContents()

    def begin_study(self, about: Dict[str, Any]) -> None:
        replace_file(self.folder / STUDY, json.dumps({"study": self._study, **about}))
        self._own = TaskJournal(self.folder, self._study, "handed-in")

    def read(self) -> None:
        """Reads the lines added since the last call."""
        for path in sorted(self.folder.glob("*.jsonl")):
            place = self._places.get(path.name, 0)
            try:
                with open(path, "rb") as file:
                    file.seek(place)
                    text = file.read()
            except FileNotFoundError:
                continue
            whole = text.rfind(b"\n") + 1
            self._places[path.name] = place + whole
            for line in _lines(text[:whole]):
                self.take(line)

    def last_change(self) -> float:
        """Returns when a worker last stored something, as time.time() does; 0 if none has."""
        times = [0.0]
        for path in self.folder.glob("*.jsonl"):
            try:
                times.append(path.stat().st_mtime)
            except FileNotFoundError:  # being merged
                pass
        return max(times)

    def changed_file(self, row: Dict[str, Any]) -> Optional[str]:
        """Returns a file that had another content when the variant of a row read it; None if there is none."""
        return self._contents.changed_since(row)

    def take(self, line: Dict[str, Any]) -> None:
        if "cells" in line and "key" in line:
            if self.changed_file(line) is not None:
                return  # of an earlier call: to be run again
            self.rows[line["key"]] = line
            self.begun.pop(line["key"], None)
        elif "begin" in line:
            self.begun.update({key: (line["at"], line["worker"]) for key in line["begin"] if key not in self.rows})

    def keep(self, row: Dict[str, Any]) -> None:
        """Stores a row that its worker could not store."""
        self.take(row)
        if self._own is None or not self._own.add([row]):
            raise OSError(f"{self.folder}: neither the worker nor this process can write the result of a variant; free disk "
                          "space and call again; finished results are kept")

    def tidy(self) -> None:
        """Merges all files into one, once no worker is writing."""
        if self._own is not None:
            self._own.close()
        text = "".join(json.dumps(row) + "\n" for row in self.rows.values())
        replace_file(self.folder / KEPT, text)
        for path in self.folder.glob("*.jsonl"):
            if path.name != KEPT:
                path.unlink(missing_ok=True)


@contextmanager
def hold(folder: pathlib.Path) -> Iterator[None]:
    """Prevents other processes from running the same study.

    Raises
    ------
    InputError
        If another process already runs it.
    """
    with open(folder / "lock", "a", encoding="utf-8") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise InputError(f"{folder.parent}: another process runs a study in this directory; wait for it, or give another "
                             "directory") from None
        except OSError:  # a file system without locks
            pass
        yield


def unfinished_of(keys: Iterable[str], known: Set[str]) -> List[str]:
    """Returns the keys that are not known, in order."""
    return [key for key in keys if key not in known]


def worker_name() -> str:
    return f"{socket.gethostname()}:{os.getpid()}"


def _study_in(folder: pathlib.Path) -> Dict[str, Any]:
    try:
        about = json.loads((folder / STUDY).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return about if isinstance(about, dict) else {}


def _lines(text: bytes) -> Iterator[Dict[str, Any]]:
    for line in text.split(b"\n"):
        try:
            found = json.loads(line)
        except ValueError:  # cut off
            continue
        if isinstance(found, dict):
            yield found
