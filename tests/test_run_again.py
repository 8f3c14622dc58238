# SPDX-License-Identifier: Apache-2.0
"""The model.yaml of a run is the model that was run: with the changes by --set, and finding its files from
any directory. Running it again gives the same numbers to the last bit."""

import json
import pathlib
import shutil

import h5py
import numpy
import pytest

from conftest import SOURCE

PARTS = SOURCE / "tests" / "parts"

WEB = """\
# A crank web on a hinge, turned by a measured torque.
buckens: 1
title: Web   # a comment
materials: {steel: {E: 210 GPa, nu: 0.3, rho: 7850 kg/m^3}}
bodies:
  web:
    mesh: {file: parts/web.msh, length-unit: mm, material: steel}
    interfaces:
      # the bore of the shaft
      shaft: {face: SHAFT, kind: rigid}
      pin: {face: PIN, kind: rigid}
    reduction: {craig-bampton: 4, file: web.basis}
joints:
  hinge: {revolute: {between: [ground, web/shaft], axis: [0, 0, 1]}}
loads:
  motor:
    torque:
      on: web/pin
      value: [0, 0, {file: tables/torque.csv, unit: N m}]
simulation: {duration: 4 ms, step: 1 ms}
output: {sensors: {pin: {position: web/pin}}}
"""


def same_run(one, other):
    assert (one / "sensors.csv").read_bytes() == (other / "sensors.csv").read_bytes()
    with h5py.File(one / "results.h5") as a, h5py.File(other / "results.h5") as b:
        names = []
        a["bodies"].visit(names.append)
        assert len(a["time"]) == len(b["time"]) > 1 and names
        for name in names:
            if isinstance(a["bodies"][name], h5py.Dataset):
                assert numpy.array_equal(a["bodies"][name], b["bodies"][name]), name


CHANGES = ["simulation.step=0.25 ms", "gravity.1=-2*4.905 m/s^2", "bodies.beam.beam.elements=6",
           "loads.push.force.value=[0, \"max(0, 0.7*sin(50*t)) N\", 0]", "title=\"With: changes\"",
           "sections.strip={circle: {diameter: 8 mm}}", "simulation.rho-inf=0.9",
           "output.sensors.tip={velocity: beam/end}", "output.sensors.more={position: beam/mid}",
           "loads.extra={force: {on: beam/end, value: [1 N, 0, 0]}}"]


def options(changes):
    return [word for change in changes for word in ("--set", change)]


def test_changes_by_set_are_in_the_model_of_the_run(buckens, models, tmp_path):
    buckens("run", "-q", models / "beam.yaml", "-o", "out", *options(CHANGES)).must(0)
    buckens("run", "-q", "out/model.yaml", "-o", "again").must(0)
    same_run(tmp_path / "out", tmp_path / "again")
    # It differs from the unchanged model, and keeps its title and comments.
    buckens("run", "-q", models / "beam.yaml", "-o", "plain").must(0)
    assert (tmp_path / "plain" / "sensors.csv").read_text() != (tmp_path / "out" / "sensors.csv").read_text()
    text = (tmp_path / "out" / "model.yaml").read_text()
    assert "# A flexible beam swings about a hinge" in text and "--set simulation.step" in text
    assert 'title: "With: changes"' in text and "E: 200 GPa" in text
    assert (tmp_path / "again" / "model.yaml").read_text() == text
    # Everything not changed stays as it was written.
    assert (tmp_path / "plain" / "model.yaml").read_text() == (models / "beam.yaml").read_text()


def test_each_change_alone(buckens, models, tmp_path):
    for change in CHANGES:
        buckens("run", "-q", models / "beam.yaml", "-o", "out", "--set", change).must(0)
        buckens("run", "-q", "out/model.yaml", "-o", "again").must(0)
        same_run(tmp_path / "out", tmp_path / "again")


JSON_MODEL = {
    "buckens": 1, "title": "A \"quoted\" title: {1, 2}", "gravity": [0, "-9.81 m/s^2", 0],
    "planar": "xy", "parameters": {"L": "500 mm", "push": "max(1, 2)"},
    "materials": {"steel": {"E": "200 GPa", "nu": 0.3, "rho": 7870}},
    "bodies": {"beam": {"beam": {"to": ["L", 0, 0], "elements": 4, "material": "steel",
                                 "section": {"circle": {"diameter": "8 mm"}}}}},
    "joints": {"hinge": {"revolute": {"between": ["ground", "beam/start"]}}},
    "loads": {"push": {"force": {"on": "beam/end", "value": [0, "push*sin(40*t) N", 0]}}},
    "simulation": {"duration": 0.01, "step": "1 ms"},
    "output": {"sensors": {"tip": {"position": "beam/end"}}}}


def test_a_model_in_json(buckens, tmp_path):
    for text in (json.dumps(JSON_MODEL), json.dumps(JSON_MODEL, indent=2)):
        (tmp_path / "model.json").write_text(text)
        buckens("run", "-q", "model.json", "-o", "out", "--set", "simulation.step=0.25 ms").must(0)
        buckens("run", "-q", "out/model.yaml", "-o", "again").must(0)
        same_run(tmp_path / "out", tmp_path / "again")
        assert len((tmp_path / "again" / "sensors.csv").read_text().splitlines()) > 10


@pytest.fixture
def web(tmp_path):
    place = tmp_path / "a place" / "project"
    (place / "parts").mkdir(parents=True)
    (place / "tables").mkdir()
    shutil.copy(PARTS / "crank_web_41.msh", place / "parts" / "web.msh")
    (place / "tables" / "torque.csv").write_text("t,M\n0,0\n0.002,5\n0.004,-3\n")
    (place / "web.yaml").write_text(WEB)
    return place


def test_files_are_found_from_the_model_of_the_run(buckens, web, tmp_path):
    """Relative names in it refer to the original directory, wherever the run, the user and the copy are."""
    out = tmp_path / "runs" / "first"
    buckens("run", "-q", "web.yaml", "-o", out, "--set", "simulation.step=0.5 ms", cwd=web).must(0)
    assert (web / "web.basis").is_file()
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    buckens("run", "-q", out / "model.yaml", "-o", "again", cwd=elsewhere).must(0)
    same_run(out, elsewhere / "again")
    shutil.copytree(out, tmp_path / "copy")
    buckens("run", "-q", "copy/model.yaml", "-o", "third").must(0)
    same_run(out, tmp_path / "third")
    text = (out / "model.yaml").read_text()
    assert "file: parts/web.msh" in text and "# the bore of the shaft" in text
    assert f'base: "{web}"' in text
    assert (tmp_path / "third" / "model.yaml").read_text() == text
    # No basis beside the copies: they use that of the project.
    assert [path.relative_to(tmp_path) for path in tmp_path.rglob("web.basis")] == \
        [pathlib.Path("a place/project/web.basis")]


def test_files_may_begin_anywhere(buckens, web, tmp_path):
    buckens("run", "-q", "web.yaml", "-o", tmp_path / "beside", cwd=web).must(0)
    (tmp_path / "models").mkdir()
    for base in ("../a place/project", str(web)):
        text = WEB.replace("buckens: 1\n", f"buckens: 1\nbase: {base}\n")
        (tmp_path / "models" / "web.yaml").write_text(text)
        buckens("run", "-q", "models/web.yaml", "-o", "based").must(0)
        same_run(tmp_path / "beside", tmp_path / "based")
        buckens("run", "-q", "based/model.yaml", "-o", "again").must(0)
        same_run(tmp_path / "beside", tmp_path / "again")
    (tmp_path / "models" / "web.yaml").write_text(WEB)
    buckens("run", "-q", "models/web.yaml", "-o", "out").must(2, "parts/web.msh")
    buckens("run", "-q", "models/web.yaml", "-o", "out", "--set", f"base={web}").must(0)
    same_run(tmp_path / "beside", tmp_path / "out")


def test_variants_of_a_sweep_run_again(buckens, web, tmp_path):
    arguments = ["sweep", web / "web.yaml", "--set", "gravity=[0, -1, 0]",
                 "--vary", "simulation.step=[0.5 ms, 1 ms]", "-o", "sweep"]
    buckens(*arguments).must(0)
    variants = sorted((tmp_path / "sweep").glob("*/model.yaml"))
    assert len(variants) == 2
    for variant in variants:
        buckens("run", "-q", variant, "-o", "again").must(0)
        same_run(variant.parent, tmp_path / "again")
    # Resumed, it keeps intact runs and repeats damaged ones.
    damaged = variants[0].parent / "results.h5"
    kept = variants[1].parent / "results.h5"
    before = kept.stat().st_mtime_ns
    damaged.write_bytes(damaged.read_bytes()[:3000])
    buckens(*arguments).must(0)
    assert kept.stat().st_mtime_ns == before
    with h5py.File(damaged) as file:
        assert len(file["time"]) > 1
