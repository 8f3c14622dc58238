# SPDX-License-Identifier: Apache-2.0
"""Calls the program `buckens` that belongs to this module."""

from __future__ import annotations

import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
from contextlib import contextmanager
from typing import Any, Dict, Iterator, List, Optional, Sequence

from . import errors
from .messages import logger
from .model import Model, ModelLike, Overrides, model_of, overrides_of

_KINDS = {"usage": errors.InputError, "input": errors.InputError, "model": errors.ModelError,
          "numerical": errors.NumericalError, "io": errors.IoError, "memory": MemoryError}
_INTERRUPTED, _DIFFERENT = 130, 6
_WARNING = "buckens: warning: "
_OF_MPIRUN = ("OMPI_COMM_WORLD_", "OMPI_MCA_ess", "OMPI_MCA_orte_", "OMPI_MCA_pmix", "PMI_", "PMIX_")


def find_program() -> str:
    """Returns the program of the same build or installation; the variable BUCKENS_PROGRAM overrides it.

    Raises
    ------
    IoError
        If no program is found.
    """
    named = os.environ.get("BUCKENS_PROGRAM")
    if named:
        return named
    here = pathlib.Path(__file__).absolute().parent
    for folder in here.parents[:4]:
        candidate = folder / "bin" / "buckens"
        if os.access(candidate, os.X_OK):
            return str(candidate)
    found = shutil.which("buckens")
    if found:
        return found
    raise errors.IoError(f"the program `buckens` was found neither near {here} nor on PATH; set "
                         "BUCKENS_PROGRAM to its path")


@contextmanager
def file_of(model: ModelLike) -> Iterator[str]:
    """Provides a file with the model, and removes it afterwards if it was created here."""
    if isinstance(model, (str, os.PathLike)):
        yield os.fspath(model)
        return
    model = model_of(model)
    if model._forces:
        raise errors.InputError(f"the model has the function {model._forces[0][0]!r} as a force, which "
                                "the program cannot call; simulate it with buckens.Simulation")
    if model._signals:
        raise errors.InputError(f"the model has a function as the signal {model._signals[0][0]!r}, which "
                                "the program cannot call; simulate it with buckens.Simulation")
    with tempfile.TemporaryDirectory(prefix="buckens-") as folder:
        path = os.path.join(folder, "model.yaml")
        directory = os.path.abspath(model._core.directory or ".")
        text = model.to_yaml()
        if "\nbase:" not in "\n" + text:
            text += f"\nbase: {json.dumps(directory)}\n"
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        try:
            yield path
        except errors.Error as error:
            _forget(error, path)
            raise


def _forget(error: errors.Error, path: str) -> None:
    """Takes a place in a file out of an error that nobody but this module has seen."""
    if error.file == path:
        text = str(error).removeprefix(f"{path}:{error.line}:{error.column}: ").removeprefix(f"{path}: ")
        error.args = (text,)
        error.file = error.line = error.column = None


def changes_of(set: Overrides) -> List[str]:  # noqa: A002
    """Returns the options `--set` for changes to a model."""
    return [word for change in overrides_of(set) for word in ("--set", change)]


def options_of(**options: Any) -> List[str]:
    """Returns command-line options: underscores become hyphens, None and False are omitted."""
    out: List[str] = []
    for key, value in options.items():
        if value is None or value is False:
            continue
        out.append("--" + key.replace("_", "-"))
        if value is not True:
            out.append(os.fspath(value) if isinstance(value, os.PathLike) else str(value))
    return out


def environment() -> Optional[Dict[str, str]]:
    """Returns the environment of a command: without that of mpirun in a process that uses MPI itself, since the program would
    otherwise wait for all others to join it."""
    if "mpi4py.MPI" not in sys.modules:
        return None
    return {name: value for name, value in os.environ.items() if not name.startswith(_OF_MPIRUN)}


def call(verb: str, arguments: Sequence[str]) -> Dict[str, Any]:
    """Runs a command with `--json` and returns its output.

    Raises
    ------
    Error
        As raised by the library: InputError, ModelError, NumericalError or IoError.
    KeyboardInterrupt
        After Ctrl-C, once the program has completed its files.
    """
    command: List[str] = [find_program(), verb, *arguments, "--json"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          stdin=subprocess.DEVNULL, text=True, env=environment()) as process:
        try:
            out, err = process.communicate()
        except KeyboardInterrupt:
            _interrupt(process)
            raise
    return answer_of(process.returncode, out, err)


def _interrupt(process: subprocess.Popen[str]) -> None:
    """Passes on Ctrl-C, which notebooks send to Python only, and waits until the program has completed its files.

    It does not matter if the terminal has sent it to both: the program takes one from its parent and one from elsewhere
    as the same. A further Ctrl-C ends the program at once.
    """
    while True:
        process.send_signal(signal.SIGINT)
        try:
            process.communicate()
            return
        except KeyboardInterrupt:
            continue


def answer_of(code: int, out: str, err: str) -> Dict[str, Any]:
    """Returns the output of a command; logs its warnings and raises its errors."""
    for line in err.splitlines():
        if line.startswith(_WARNING):
            logger.warning(line[len(_WARNING):])
    try:
        answer = json.loads(out)
    except ValueError:
        raise errors.Error(f"the program exited with code {code}: {err.strip()}") from None
    if isinstance(answer, dict) and "error" in answer and "message" in answer["error"]:
        failure = answer["error"]
        error = _KINDS.get(failure["kind"], errors.Error)(failure["message"])
        if isinstance(error, errors.Error):
            error.file, error.line = failure["file"], failure["line"]
            error.column = failure["column"]
        raise error
    if code == _INTERRUPTED:
        raise KeyboardInterrupt
    if code == _DIFFERENT:
        raise errors.DifferenceError(f"the runs differ by {answer['largest_relative_difference']:.3g} of "
                                     "the largest value, more than the tolerance; see "
                                     "buckens.compare without one")
    return dict(answer)
