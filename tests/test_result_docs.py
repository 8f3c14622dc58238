# SPDX-License-Identifier: Apache-2.0
"""The pages on results describe the files: their programs run, and their lists match real files."""

import os
import pathlib
import re
import subprocess
import sys

import h5py
import pytest

SOURCE = pathlib.Path(os.environ.get("BUCKENS_SOURCE_DIR", pathlib.Path(__file__).parents[1]))
RUN_DIRECTORY = SOURCE / "docs" / "reference" / "run-directory.md"
RESULTS = SOURCE / "docs" / "tutorials" / "results.md"
SNIPPET = re.compile(r"^```python\n(.*?)^```", re.DOTALL | re.MULTILINE)
FIRST_CELL = re.compile(r"^\| ([^|]*`[^|]*) \|", re.MULTILINE)
NODES = "\n".join(f"        n{i}{j}{k}: [{0.1 * i}, {0.1 * j}, {0.1 * k}]"
                  for i in range(3) for j in range(2) for k in range(2))

# Everything that a run can record: beams, solids of two materials, shells of two layers, loads on nodes and on faces.
EVERYTHING = f"""
buckens: 1
title: Everything that a run can record
materials:
  steel: {{E: 210 GPa, nu: 0.3, rho: 7850 kg/m^3}}
  alloy: {{E: 70 GPa, nu: 0.3, rho: 2700 kg/m^3}}
bodies:
  part:
    structure:
      nodes:
{NODES}
      solids:
        - {{nodes: [n000, n100, n110, n010, n001, n101, n111, n011], material: steel}}
        - {{nodes: [n100, n200, n210, n110, n101, n201, n211, n111], material: alloy}}
    interfaces: {{root: {{plane: {{point: [0, 0, 0], normal: [1, 0, 0]}}, kind: rigid}}}}
  strip:
    mesh: {{plate: {{from: [0, 1 m, 0], size: [0.4 m, 0.1 m], divisions: [4, 1],
                   layers: [{{thickness: 1 mm}}, {{thickness: 1 mm}}]}}, material: steel}}
    interfaces: {{edge: {{plane: {{point: [0, 0, 0], normal: [1, 0, 0]}}, kind: rigid}}}}
  rod: {{beam: {{from: [0.2 m, 0, 0], to: [1.2 m, 0, 0], elements: 4, section: {{circle: {{diameter: 20 mm}}}},
               material: steel}}}}
  cube: {{mesh: {{box: {{from: [3 m, 0, 0], size: [1 m, 1 m, 1 m], divisions: [1, 1, 1]}}, material: steel}}}}
joints:
  wall: {{fixed: {{between: [{{ground: [0, 0.05 m, 0.05 m]}}, part/root]}}}}
  clamp: {{fixed: {{between: [{{ground: [0, 1.05 m, 0]}}, strip/edge]}}}}
  tie: {{spherical: {{between: [part/n200, rod/start]}}}}
loads:
  push: {{force: {{on: rod/end, value: [0, 0, -1 N]}}}}
  gas: {{pressure: {{on: cube/x0, value: 1 kPa}}}}
simulation: {{duration: 2 ms, step: 1 ms}}
output:
  every: 1 ms
  sensors: {{tip: {{position: rod/end}}}}
  fields: {{record: [stress, strain, von-mises, principal-stress, strain-energy-density, displacement, velocity,
                    acceleration, interface-load], at: both}}
"""


# More bodies and joints than have data sets of their own: links side by side, each on the ground.
MANY = 1600
CROWD = "buckens: 1\nbodies:\n" + "".join(f"  b{k}: {{rigid: {{mass: 1, inertia: [1, 1, 1]}}}}\n" for k in range(MANY)) + "joints:\n" + "".join(
    f"  j{k}: {{revolute: {{between: [ground, b{k}], axis: [0, 0, 1]}}}}\n" for k in range(MANY)) + "simulation: {duration: 1 ms, step: 1 ms}\noutput: {every: 1 ms}\n"


def documented():
    """Patterns of the paths that run-directory.md lists, from the first cells of its tables."""
    paths, group = [], ""
    text = RUN_DIRECTORY.read_text().split("## results.h5")[1].split("## sensors.csv")[0]
    for cell in FIRST_CELL.findall(text):
        last = ""
        for name in re.findall(r"`(/[^`]+)`", cell):
            if cell.startswith("…"):
                path = group + name
            elif last and name.count("/") == 1:
                path = last.rsplit("/", 1)[0] + name  # beside the one before
            else:
                path = last = name
            paths.append(path)
        if not cell.startswith("…"):
            group = last
    return [(path, re.compile(re.sub(r"<\w+>", "[^/]+", path) + "$")) for path in paths]


def contents(path):
    """Paths of all data sets and groups with attributes of a results.h5."""
    sets, groups = set(), {"/geometry"}
    with h5py.File(path, "r", swmr=True) as file:
        file.visititems(lambda name, thing: (sets if isinstance(thing, h5py.Dataset) else groups).add("/" + name))
    return sets, groups


@pytest.fixture
def readme_rod(buckens, tmp_path):
    """The run directory of the model in the main README."""
    model = re.search(r"```yaml\n(.*?)```", (SOURCE / "README.md").read_text(), re.DOTALL).group(1)
    (tmp_path / "rod.yaml").write_text(model)
    return lambda out: buckens("run", "rod.yaml", "-o", out, "-q").must(0)


def executed(text, directory):
    """The output of a program run in a directory."""
    done = subprocess.run([sys.executable, "-c", text], cwd=directory, text=True, capture_output=True, timeout=120)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_programs_on_the_pages_run(buckens, readme_rod, tmp_path):
    beam, solid = SNIPPET.findall(RESULTS.read_text())
    readme_rod("out")
    printed = executed(beam, tmp_path)
    # It prints the largest value recorded by the sensor of the README.
    with h5py.File(tmp_path / "out" / "results.h5", "r", swmr=True) as file:
        largest = file["sensors/stress"][:].max()
    assert float(printed.split()[0]) == pytest.approx(largest, rel=1e-12)
    (tmp_path / "model.yaml").write_text(EVERYTHING)
    buckens("run", "model.yaml", "-o", "out", "-q").must(0)
    assert re.match(r"\d\S* Pa at \[.*\] of 0\.002 s$", executed(solid, tmp_path))
    (reading,) = SNIPPET.findall(RUN_DIRECTORY.read_text())
    readme_rod("OUT")
    assert executed(reading, tmp_path) == "m ['x', 'y', 'z']\n"


def test_the_list_of_data_sets_is_that_of_the_files(buckens, readme_rod, tmp_path):
    readme_rod("rod")
    (tmp_path / "model.yaml").write_text(EVERYTHING)
    buckens("run", "model.yaml", "-o", "everything", "-q").must(0)
    buckens("modes", "rod.yaml", "--count", "2", "-o", "modes").must(0)
    path = SOURCE / "examples" / "snap_through" / "snap_through.yaml"
    buckens("static", str(path), "-o", "path", "-q").must(0)
    for name in ("bouncing_dumbbell", "block_and_tackle"):  # shapes of contact, cables
        buckens("run", str(SOURCE / "examples" / name / f"{name}.yaml"), "-o", name, "-q").must(0)
    surface = SOURCE / "examples" / "marble_bowl" / "marble_bowl.yaml"
    buckens("run", str(surface), "-o", "marbles", "-q", "--set", "simulation.duration=10 ms").must(0)
    (tmp_path / "crowd.yaml").write_text(CROWD)
    buckens("run", "crowd.yaml", "-o", "crowd", "-q").must(0)
    sets, groups = set(), set()
    for run in ("rod", "everything", "modes", "path", "bouncing_dumbbell", "block_and_tackle", "marbles", "crowd"):
        more, around = contents(tmp_path / run / "results.h5")
        sets |= more
        groups |= around
    patterns = documented()
    missing = sorted(name for name in sets if not any(pattern.match(name) for _, pattern in patterns))
    assert not missing, f"run-directory.md does not mention {missing}"
    with h5py.File(tmp_path / "crowd" / "results.h5", "r", swmr=True) as file:
        assert file["motions"].shape == (2, MANY, 13) and file["reactions"].shape == (2, MANY, 6)
    absent = [path for path, pattern in patterns if not any(map(pattern.match, sets | groups))]
    assert not absent, f"run-directory.md lists {absent}, which no file has"
