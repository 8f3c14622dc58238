# SPDX-License-Identifier: Apache-2.0
"""The Python module as it is delivered: the example, an installation, and a wheel."""

import importlib.util
import json
import os
import pathlib
import re
import subprocess
import sys
import zipfile

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent / "support"))
from python_module import BINARY, PACKAGES, SOURCE, buckens  # noqa: E402 (found after the path is set)

PYTHON = sys.executable


def call(*command, path, **options):
    environment = {**os.environ, "PYTHONPATH": str(path), "PYTHONDONTWRITEBYTECODE": "1"}
    environment.pop("BUCKENS_PROGRAM", None)
    return subprocess.run([str(part) for part in command], env=environment, capture_output=True, text=True,
                          timeout=300, **options)


def test_the_example_turns_its_arm(tmp_path):
    """examples/python/flexible_arm.py: the angle is reached, the tip comes to rest."""
    script = SOURCE / "examples" / "python/flexible_arm"
    done = call(PYTHON, script.with_suffix(".py"), tmp_path / "out", path=PACKAGES)
    assert done.returncode == 0, done.stderr
    numbers = [float(text) for text in re.findall(r"([0-9.]+) (?:degrees|mm)", done.stdout)]
    angle, largest, left = numbers
    assert angle == pytest.approx(90, abs=0.01)
    # Turned with up to 36 rad/s^2, the tip of a tube of 1 m and 10 mm lags by millimetres; half a second
    # of feedback with a damping ratio of 0.7 leaves e^(-0.7 15 0.9) of what remains after the motion.
    assert 0.1 < largest < 10 and left < 0.02 * largest
    run = buckens.open(tmp_path / "out")
    assert run.status == "finished" and run.summary["trust"] == "ok"
    assert run["torque"].unit == "N m"


def test_an_installation_is_found(tmp_path):
    done = call("cmake", "--install", BINARY, "--prefix", tmp_path, "--component", "python", path="")
    assert done.returncode == 0, done.stderr
    package = next(tmp_path.rglob("buckens/__init__.py")).parent
    assert package.parent.name in ("dist-packages", "site-packages")
    names = {file.name for file in package.iterdir()}
    assert {"objects.py", "py.typed", "_core.pyi", "simulation.py"} <= names
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin" / "buckens").symlink_to(BINARY / "bin" / "buckens")
    done = call(PYTHON, "-c", "import buckens, buckens.program as p; print(buckens.__file__, "
                "buckens.__version__, p.find_program())", path=package.parent, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert str(package) in done.stdout and str(tmp_path / "bin" / "buckens") in done.stdout
    assert (SOURCE / "VERSION").read_text().split()[0] in done.stdout


def test_a_wheel_is_packed_without_a_network(tmp_path):
    code = ("import sys, pathlib; sys.path.insert(0, sys.argv[1]); import cmake_wheel; "
            "print(cmake_wheel.pack(pathlib.Path(sys.argv[2]), sys.argv[3]))")
    done = call(PYTHON, "-c", code, SOURCE / "python", BINARY, tmp_path, path="")
    assert done.returncode == 0, done.stderr
    wheel = tmp_path / done.stdout.strip()
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
        record = archive.read(next(name for name in names if name.endswith("RECORD"))).decode()
        archive.extractall(tmp_path / "site")
    assert sorted(line.split(",")[0] for line in record.splitlines()) == sorted(names)
    assert any(name.endswith(".data/scripts/buckens") for name in names)
    done = call(PYTHON, "-c", "import buckens; print(buckens.Model(bodies={'b': buckens.Rigid(mass=1, "
                "inertia=[1, 1, 1])}))", path=tmp_path / "site", cwd=tmp_path)
    assert done.returncode == 0 and "1 body" in done.stdout, done.stderr


USE = """
import buckens, buckens.program, json, pathlib, sys
model = buckens.load(sys.argv[1], set={"simulation.duration": "2 ms"})
summary = buckens.Simulation(model, out="out").run()
run = buckens.open("out")
page = buckens.view("out")
print(json.dumps({"module": buckens.__file__, "program": buckens.program.find_program(), "steps": summary["steps"],
                  "records": len(run.time), "shown": "<iframe" in run.view()._repr_html_()}))
"""


def test_pip_installs_the_source_tree(tmp_path):
    """`pip install .` as docs/tutorials/install.md has it, without a network; the build tree is used again."""
    if importlib.util.find_spec("ensurepip") is None:
        pytest.skip("python3-venv is not installed")
    environment = tmp_path / "env"
    made = call(PYTHON, "-m", "venv", "--system-site-packages", environment, path="")
    if made.returncode != 0:
        pytest.skip(f"no environment can be made here: {made.stdout}{made.stderr}")
    python = environment / "bin" / "python"
    done = subprocess.run([environment / "bin" / "pip", "install", "--no-build-isolation", "--no-index", SOURCE],
                          env={**os.environ, "BUCKENS_BUILD_DIR": str(BINARY), "PIP_CONFIG_FILE": os.devnull},
                          capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "Successfully installed buckens" in done.stdout
    done = call(python, "-c", USE, SOURCE / "examples" / "slider_crank" / "slider_crank.yaml", path="", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    told = json.loads(done.stdout.splitlines()[-1])
    assert told["module"].startswith(str(environment)) and told["program"] == str(environment / "bin" / "buckens")
    assert told["steps"] > 0 and told["records"] > 1 and told["shown"]
    page = (tmp_path / "out" / "view.html").read_text(encoding="utf-8")
    assert len(page) > 500_000 and "Flexible slider-crank" in page
    # And away again.
    gone = call(environment / "bin" / "pip", "uninstall", "-y", "buckens", path="")
    assert gone.returncode == 0, gone.stderr
    left = [file for file in environment.rglob("*") if "buckens" in file.name]
    assert left == []
