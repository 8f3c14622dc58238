# SPDX-License-Identifier: Apache-2.0
"""`buckens sweep`: variants side by side give what they give alone, and nothing is lost."""

import csv
import json

import numpy
import pytest

# Solids: a factor that is worth reading once for several variants.
LARGE_BLOCK = """
buckens: 1
gravity: [0, "-g", 0]
parameters: {g: 9.81 m/s^2, push: 0 N}
materials: {soft: {E: 1e8 Pa, nu: 0.3, rho: 1000 kg/m^3}}
bodies:
  block: {mesh: {box: {size: [1 m, 0.1 m, 0.1 m], divisions: [16, 4, 4]}, material: soft}}
joints: {pin: {spherical: {between: [ground, block/face_x0]}}}
loads: {push: {force: {on: block/face_x1, value: [0, "push*sin(200*t)", 0]}}}
simulation: {duration: 4 ms, step: 0.2 ms}
output: {every: 1 ms, sensors: {tip: {position: block/face_x1}, pin: {joint-force: pin}}}
"""


@pytest.fixture
def large_block(tmp_path):
    (tmp_path / "block.yaml").write_text(LARGE_BLOCK)
    return tmp_path / "block.yaml"


def sensors_of(directory):
    return numpy.loadtxt(directory / "sensors.csv", delimiter=",", skiprows=1)


def table_of(directory):
    return list(csv.DictReader((directory / "sweep.csv").open()))


def test_variants_are_what_they_are_alone(buckens, large_block, tmp_path):
    (tmp_path / "table.csv").write_text(
        "name,parameters.g,parameters.push\n"
        "plain,9.81 m/s^2,0 N\nmoon,1.62 m/s^2,0 N\npushed,9.81 m/s^2,5 N\n"
        "nudged,9.81,1 N\n")
    result = buckens("sweep", large_block, "table.csv", "-o", "out", "--json").must(0)
    rows = table_of(tmp_path / "out")
    assert [row["name"] for row in rows] == ["plain", "moon", "pushed", "nudged"]
    assert {row["status"] for row in rows} == {"done"}
    # One factor for the four; every pass over it serves all that wait.
    assert result.json["factorisations"] == 1
    assert result.json["passes"] <= result.json["solves"] / 3
    for row in rows:
        buckens("run", large_block, "-o", "alone", "-q", "--set", "parameters.g=" + row["parameters.g"],
                "--set", "parameters.push=" + row["parameters.push"]).must(0)
        together, alone = sensors_of(tmp_path / "out" / row["name"]), sensors_of(tmp_path / "alone")
        # Another number of columns may round differently; 1e-10 of the largest is what is promised.
        for column in range(together.shape[1]):
            scale = abs(alone[:, column]).max()
            assert abs(together[:, column] - alone[:, column]).max() <= 1e-10 * scale + 1e-14
        assert float(row["tip.y [m] last"]) == together[-1, 2]
        assert float(row["tip.y [m] min"]) == together[:, 2].min()
        assert int(row["steps"]) == 20


def test_combinations_of_ranges(buckens, models, tmp_path):
    buckens("sweep", models / "pendulum.yaml", "-o", "out", "--vary", "simulation.duration=[0.01, 0.02]",
            "--vary", "gravity.1=[-9.81 m/s^2, -1.62 m/s^2, 0]").must(0)
    rows = table_of(tmp_path / "out")
    assert len(rows) == 6
    assert rows[1]["gravity.1"] == "-1.62 m/s^2" and float(rows[5]["end_time [s]"]) == 0.02
    assert (tmp_path / "out" / "006" / "results.h5").exists()


def test_failed_variants_do_not_stop_the_rest(buckens, models, tmp_path):
    result = buckens("sweep", models / "beam.yaml", "-o", "out",
                     "--vary", "bodies.beam.beam.elements=[2, -1, 4]").must(4, "elements")
    rows = table_of(tmp_path / "out")
    assert [row["status"] for row in rows] == ["done", "failed", "done"]
    assert "-1" in rows[1]["message"]
    assert "2 done" in result.out and "1 failed" in result.out


def test_continues_after_an_interruption(buckens, models, tmp_path):
    call = ("sweep", models / "pendulum.yaml", "-o", "out", "--json")
    buckens(*call, "--vary", "simulation.duration=[0.01, 0.02]").must(0)
    # One run was cut off, one has another value now.
    summary = tmp_path / "out" / "001" / "summary.json"
    summary.write_text(json.dumps({**json.loads(summary.read_text()), "status": "interrupted"}))
    result = buckens(*call, "--vary", "simulation.duration=[0.01, 0.02, 0.03]").must(0)
    assert [v["status"] for v in result.json["variants"]] == ["done", "kept", "done"]
    result = buckens(*call, "--vary", "simulation.duration=[0.01, 0.04, 0.03]").must(0)
    assert [v["status"] for v in result.json["variants"]] == ["kept", "done", "kept"]


def test_says_what_is_wrong(buckens, models, tmp_path):
    model = models / "pendulum.yaml"
    buckens("sweep", model).must(2, "--vary")
    buckens("sweep", model, "--vary", "a").must(2, "PATH=[VALUE")
    buckens("sweep", model, "none.csv").must(5, "none.csv")
    buckens("sweep", "none.yaml", "--vary", "a=[1]").must(5, "none.yaml")
    (tmp_path / "table.csv").write_text("simulation.duration\n1,2\n")
    buckens("sweep", model, "table.csv").must(2, "table.csv:2", "2 cells")
    # A path that the format does not know is named in every variant's message.
    buckens("sweep", model, "-o", "out", "--vary", "simulation.durration=[1]").must(4, "duration")
