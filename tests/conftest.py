# SPDX-License-Identifier: Apache-2.0
"""Calling the program the way a user does, and models to call it with."""

import csv
import ctypes
import json
import os
import pathlib
import signal
import subprocess

import pytest

# Debian's OpenBLAS solves even 16 equations with a thread per processor, which wait for each other in a loop: ten to a hundred
# times as long. How many it may take it asks once, as NumPy loads it. Programs that tests start are told nothing of it.
threads_before = os.environ.get("OMP_NUM_THREADS")
os.environ["OMP_NUM_THREADS"] = "1"
import numpy  # noqa: E402

if threads_before is None:
    del os.environ["OMP_NUM_THREADS"]
else:
    os.environ["OMP_NUM_THREADS"] = threads_before

SOURCE = pathlib.Path(os.environ.get("BUCKENS_SOURCE_DIR", pathlib.Path(__file__).parents[1]))
BINARY = pathlib.Path(os.environ.get("BUCKENS_BINARY_DIR", SOURCE / "build" / "release"))
PROGRAM = os.environ.get("BUCKENS_PROGRAM", str(BINARY / "bin" / "buckens"))
MODELS = SOURCE / "tests" / "models"

PR_CAPBSET_DROP, CAP_DAC_OVERRIDE, CAP_DAC_READ_SEARCH = 24, 1, 2


def pytest_sessionstart():
    """Without the program nothing is tested, and that must not look like success."""
    if not os.access(PROGRAM, os.X_OK):
        pytest.exit(f"{PROGRAM}: the program is not built (BUCKENS_PROGRAM says where it is)", 1)
    # Shells let background jobs ignore SIGINT, and children inherit that. What is caught here has its default in children:
    # a function to be called in each of them would cost more than to start the program (Python then copies itself).
    if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    # The same of SIGHUP and nohup: a function here, so that a terminal that closes still ends nothing.
    if signal.getsignal(signal.SIGHUP) == signal.SIG_IGN:
        signal.signal(signal.SIGHUP, lambda number, frame: None)


def may_mesh_step_files():
    """Builds with BUCKENS_GPL=OFF refuse them."""
    told = subprocess.run([PROGRAM, "version", "--json"], capture_output=True, text=True, check=False)
    return json.loads(told.stdout)["licence"] != "Apache-2.0"


def heed_permissions():
    """For the child process: file permissions apply to root, too."""
    if os.geteuid() == 0:
        libc = ctypes.CDLL(None, use_errno=True)
        for capability in (CAP_DAC_OVERRIDE, CAP_DAC_READ_SEARCH):
            if libc.prctl(PR_CAPBSET_DROP, capability, 0, 0, 0) != 0:
                raise OSError(ctypes.get_errno(), "prctl")


class Result:
    def __init__(self, process):
        self.code, self.out, self.err = process.returncode, process.stdout, process.stderr

    @property
    def json(self):
        return json.loads(self.out)

    def must(self, code, *words):
        """Checks the exit code, and that the error message contains all the words."""
        assert self.code == code, f"exit code {self.code}\n{self.out}\n{self.err}"
        for word in words:
            assert word in self.err, f"no {word!r} in\n{self.err}"
        return self


@pytest.fixture
def heed_ctrl_c():
    """Jobs in the background ignore it, and so do their tests."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture
def buckens(tmp_path):
    """Runs the program to its end in a separate directory."""

    def call(*arguments, **options):
        options.setdefault("cwd", tmp_path)
        options.setdefault("timeout", 300)
        options.setdefault("stdout", subprocess.PIPE)
        return Result(subprocess.run([PROGRAM, *map(str, arguments)], text=True,
                                     stderr=subprocess.PIPE, stdin=subprocess.DEVNULL, **options))

    return call


@pytest.fixture
def sensors(buckens, tmp_path):
    """Runs a model and returns the columns of sensors.csv."""

    def call(text, *arguments):
        (tmp_path / "model.yaml").write_text(text)
        buckens("run", "model.yaml", "-o", "out", *arguments).must(0)
        with open(tmp_path / "out" / "sensors.csv") as file:
            rows = list(csv.reader(line for line in file if not line.startswith("#")))
        return {name.split(" [")[0]: numpy.array([float(row[i]) for row in rows[1:]])
                for i, name in enumerate(rows[0])}

    return call


@pytest.fixture
def static_path(buckens, tmp_path):
    """Columns of a static path, and its summary."""

    def call(text):
        (tmp_path / "path.yaml").write_text(text)
        buckens("static", "path.yaml", "-o", "path").must(0)
        rows = list(csv.reader((tmp_path / "path" / "sensors.csv").open()))
        columns = {name.split(" [")[0]: numpy.array([float(row[i]) for row in rows[1:]]) for i, name in enumerate(rows[0])}
        return columns, json.loads((tmp_path / "path" / "summary.json").read_text())

    return call


@pytest.fixture
def goes_on(buckens, tmp_path):
    """Stops a run halfway, goes on, and compares its records with those of one run: all the same characters."""

    def call(text, whole, half, records):
        def rows(name):
            return [line for line in (tmp_path / name / "sensors.csv").read_text().splitlines() if not line.startswith("#")]

        for name, duration in (("whole", whole), ("half", half)):
            (tmp_path / "model.yaml").write_text(text.replace(f"duration: {whole}", f"duration: {duration}"))
            buckens("run", "model.yaml", "-o", name).must(0)
        assert len(rows("half")) < 1 + records  # with the line of names
        buckens("run", "--continue", "half", "--until", whole.removesuffix(" s")).must(0)
        assert len(rows("whole")) == 1 + records and rows("half") == rows("whole")

    return call


@pytest.fixture
def start(tmp_path):
    """Starts the program and leaves it running; it is killed at the end of the test."""
    running = []

    def call(*arguments, **options):
        options.setdefault("cwd", tmp_path)
        options.setdefault("stdout", subprocess.PIPE)
        options.setdefault("stderr", subprocess.PIPE)
        process = subprocess.Popen([PROGRAM, *map(str, arguments)], text=True,
                                   stdin=subprocess.DEVNULL, **options)
        running.append(process)
        return process

    yield call
    for process in running:
        if process.poll() is None:
            process.kill()
        process.communicate()


@pytest.fixture
def models():
    return MODELS
