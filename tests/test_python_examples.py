# SPDX-License-Identifier: Apache-2.0
"""The programs and notebooks of examples/python: they run, and what they find is right.

flexible_arm.py is in test_python_package.py.
"""

import base64
import os
import pathlib
import re
import subprocess
import sys

import numpy as np
import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent / "support"))
from python_module import PACKAGES, SOURCE, buckens  # noqa: E402, F401 (found after the path is set)

FOLDER = SOURCE / "examples" / "python"
ENVIRONMENT = {**os.environ, "PYTHONPATH": f"{PACKAGES}{os.pathsep}{FOLDER}", "PYTHONDONTWRITEBYTECODE": "1",
               "MPLBACKEND": "agg"}


def run(script, *arguments):
    done = subprocess.run([sys.executable, FOLDER / script, *map(str, arguments)], env=ENVIRONMENT, capture_output=True,
                          text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    return done.stdout


def quasi_static_bending(ratio):
    """Of the tip of examples/python/rod_taper.py under the largest angular acceleration, by the beam's differential equation."""
    length, diameter, gripper, e, rho, duration = 0.4, 0.01, 0.1, 200e9, 7850.0, 0.4
    acceleration = np.pi / 2 * 10 / np.sqrt(3) / duration**2  # largest of the smooth motion
    x = np.linspace(0, length, 2001)
    middle = (x[1:] + x[:-1]) / 2
    dx = x[1] - x[0]
    first = diameter * np.sqrt(3 / (1 + ratio + ratio**2))
    d = first * (1 + (ratio - 1) * middle / length)
    load = rho * np.pi * d**2 / 4 * acceleration * middle
    moment = np.array([np.sum(load[middle > s] * (middle[middle > s] - s)) * dx for s in middle])
    moment += gripper * acceleration * length * (length - middle)
    return np.sum(moment / (e * np.pi * d**4 / 64) * (length - middle)) * dx


def test_the_taper_that_bends_least(tmp_path):
    optimize = pytest.importorskip("scipy.optimize")
    pytest.importorskip("matplotlib")
    shown = run("rod_taper.py", tmp_path / "taper.png")
    ratio, bending = map(float, re.search(r"ratio ([\d.]+): bends by ([\d.]+) mm", shown).groups())
    uniform = float(re.search(r"uniform rod .*bends by ([\d.]+) mm", shown)[1])
    exact = optimize.minimize_scalar(quasi_static_bending, bounds=(0.2, 1.0), method="bounded")
    # The motion lasts some eleven periods of the rod (about 27 Hz). What it adds to the quasi-static bending is of the order
    # of the jerk's share, 60/10 sqrt(3)/(2 pi 11) = 15 %, and much the same for all rods, so that it hardly moves the best one.
    assert 1e3 * exact.fun == pytest.approx(bending, rel=0.15)
    assert 1e3 * quasi_static_bending(1.0) == pytest.approx(uniform, rel=0.15)
    assert ratio == pytest.approx(exact.x, abs=0.08)
    assert quasi_static_bending(ratio) < 1.02 * exact.fun  # the minimum is flat
    assert (tmp_path / "taper.png").stat().st_size > 5000


def test_the_study_is_a_table(tmp_path):
    pytest.importorskip("pandas")
    shown = run("parameter_study.py", tmp_path / "study")
    rows = re.findall(r"^(\d{3}) +([\d.]+) +([\d.]+) +([\d.]+) *$", shown, re.MULTILINE)
    assert [row[0] for row in rows] == ["100", "125", "150"] * 2
    bending = np.array(rows[:3], dtype=float)[:, 1:]
    # Faster bends more, thicker less.
    assert (np.diff(bending, axis=0) > 0).all() and (np.diff(bending, axis=1) < 0).all()
    assert "9 runs in" in shown and shown.rstrip().endswith("9 of them are to be trusted")


def test_the_tolerance_that_matters(tmp_path):
    pytest.importorskip("scipy")
    shown = run("tolerances.py", tmp_path, 32, 2)
    mean, deviation = map(float, re.search(r"160 variants: bending ([\d.]+) mm \+- ([\d.]+) mm", shown).groups())
    # Forces go with the square of the speed, whose deviation is 10/sqrt(12)/150 = 1.9 %; stiffness against mass with the square of the
    # thickness (0.5 %), and with E (1.6 %): 4.2 % together, where vibration may add as much again.
    assert 0.03 < deviation / mean < 0.09
    shares = {name: float(share) for name, share in re.findall(r"^(\w+) +([\d.-]+) % alone", shown, re.MULTILINE)}
    assert shares["speed"] > 50 > shares["diameter"] and shares["E"] < 50
    # d^2 + c/d^2 is least where both are equal; c from the mean bending at 6 mm.
    best = float(re.search(r"least price [\d.]+ with ([\d.]+) mm", shown)[1])
    assert best == pytest.approx((36 * 10 * mean) ** 0.25, rel=0.06)


def executed(name, folder):
    """A notebook with its outputs."""
    nbformat = pytest.importorskip("nbformat")
    nbclient = pytest.importorskip("nbclient")
    for needed in ("ipykernel", "matplotlib", "pandas"):
        pytest.importorskip(needed)
    notebook = nbformat.read(FOLDER / name, as_version=4)
    assert all(not cell.outputs for cell in notebook.cells if cell.cell_type == "code"), "stored without outputs"
    client = nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3",
                                     resources={"metadata": {"path": str(folder)}})
    # matplotlib shows figures in the notebook unless the environment says otherwise.
    client.execute(env={key: value for key, value in ENVIRONMENT.items() if key != "MPLBACKEND"})
    outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
    text = "".join(output.text for output in outputs if output.output_type == "stream" and output.name == "stdout")
    data = [output.data for output in outputs if "data" in output]
    pictures = [base64.b64decode(part["image/png"]) for part in data if "image/png" in part]
    return text, pictures, [part["text/html"] for part in data if "text/html" in part]


def test_the_notebook_of_the_arm(tmp_path):
    text, pictures, pages = executed("flexible_arm.ipynb", tmp_path)
    found = re.findall(r"(with\w*) feedback: ([\d.]+) degrees at the end, the tip still swings by ([\d.]+) mm", text)
    values = {name: (float(angle), float(left)) for name, angle, left in found}
    # A tube of 10 mm and 1 mm: pi (5^2 - 4^2) mm^2 times 1 m of aluminium.
    assert f"arm of {2.7e6 * np.pi * 9e-6:.1f} g" in text
    assert values["with"][0] == pytest.approx(90, abs=0.05)
    assert values["with"][1] < values["without"][1]
    assert len(pictures) == 1 and pictures[0].startswith(b"\x89PNG")
    assert len(pages) == 1 and pages[0].startswith("<iframe srcdoc=") and "Flexible arm in a notebook" in pages[0]
    (tmp_path / "arm.png").write_bytes(pictures[0])


def test_the_notebook_of_the_study(tmp_path):
    text, pictures, tables = executed("parameter_study.ipynb", tmp_path)
    # Inertia goes with the second power of the diameter and stiffness with the fourth; vibration changes it somewhat.
    assert float(re.search(r"power of (-[\d.]+)", text)[1]) == pytest.approx(-2, abs=0.6)
    assert len(pictures) == 1 and len(tables) == 1 and "bending [mm]" in tables[0]
    (tmp_path / "study.png").write_bytes(pictures[0])
