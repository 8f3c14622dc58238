# SPDX-License-Identifier: Apache-2.0
"""Input that is formally valid but makes no sense: it must not lead to nonsense without a warning."""

import csv
import json

import pytest

SPAN = "simulation: {duration: 0.1 s, step: 1 ms}\n"
BEAM = ("buckens: 1\nplanar: xy\nbodies:\n  a:\n    beam: {to: [1, 0, 0], elements: 4,\n"
        "           section: {general: {A: 1e-4, Iy: 1e-9, Iz: 1e-9, J: 1e-9}},\n"
        "           material: {E: 2e11, rho: 7850}}\n")
BLOCK = "buckens: 1\nplanar: xy\nbodies:\n  a: {rigid: {mass: 1 kg, inertia: [0, 0, 1]}}\n"


@pytest.fixture
def run(buckens, tmp_path):
    def call(text, *arguments):
        (tmp_path / "model.yaml").write_text(text)
        return buckens("run", "model.yaml", "-o", tmp_path / "out", *arguments)

    return call


def summary(tmp_path):
    return json.loads((tmp_path / "out" / "summary.json").read_text())


@pytest.mark.parametrize("load", ["force: {on: a, value: [0, 0, 100]}",
                                  "torque: {on: a, value: [0, \"t N m\", 0]}"])
def test_planar_load_out_of_the_plane(run, load):
    run(BLOCK + "loads: {push: {" + load + "}}\n" + SPAN).must(2, "model.yaml:5", "push", "planar")


@pytest.mark.parametrize("motion", ["velocity: [0, 0, 5]", "angular-velocity: [5, 0, 0]"])
def test_planar_velocity_out_of_the_plane(run, motion):
    run(BLOCK + "initial: {bodies: {a: {" + motion + "}}}\n" + SPAN).must(2, "model.yaml:5", "plane")


def test_motion_that_is_no_number(run, tmp_path):
    """An absurdly large load ends the run with its name; no row contains a nan, and trust reports it."""
    text = BEAM + "loads: {push: {force: {on: a/end, value: [0, 1e9, 0]}}}\n" + \
        "output: {sensors: {tip: {position: a/end}}}\n" + SPAN
    run(text).must(4)
    with open(tmp_path / "out" / "sensors.csv") as file:
        rows = list(csv.reader(file))
    assert all("nan" not in cell and "inf" not in cell for row in rows for cell in row)
    assert summary(tmp_path)["trust"] != "ok"


def test_records_without_number(run):
    run(BLOCK + "output: {every: 1e-300 s}\n" + SPAN).must(2, "model.yaml:5", "records")


def test_fast_spin_is_not_trusted(run, tmp_path):
    text = BEAM + "initial: {bodies: {a: {angular-velocity: [0, 0, 200 rad/s]}}}\n" + \
        "simulation: {duration: 10 ms, step: 0.1 ms}\n"
    run(text).must(0)
    assert "lowest elastic frequency" in str(summary(tmp_path)["trust"])


def test_spring_without_length(run):
    text = BLOCK + "loads: {s: {spring-damper: {between: [ground, a], stiffness: 9, length: 1}}}\n"
    run(text + SPAN).must(2, "model.yaml:5", "\"s\"", "coincide")


def test_torsional_spring_beyond_its_range(run):
    text = BLOCK + "loads: {s: {torsional-spring: {between: [ground, a], angle: 200 deg}}}\n"
    run(text + SPAN).must(2, "model.yaml:5", "3 rad")


def test_bars_in_a_row_are_a_mechanism(run):
    bars = ", ".join("{between: [%s], area: 1e-4, material: {E: 1e11, rho: 1000}}" % ends
                     for ends in ("p, q", "q, r"))
    text = ("buckens: 1\nbodies:\n  a: {structure: {nodes: {p: [0, 0, 0], q: [1, 0, 0], "
            "r: [2, 0, 0]}, bars: [" + bars + "]}}\n" + SPAN)
    run(text).must(3, "model.yaml:3", "\"a\"", "mechanism")


def test_dampers_dissipate(run, tmp_path):
    text = BLOCK.replace("planar: xy\n", "") + \
        "loads: {d: {spring-damper: {between: [{ground: [-1, 0, 0]}, a], damping: 4}}}\n" + \
        "initial: {bodies: {a: {velocity: [3, 0, 0]}}}\n" + \
        "output: {sensors: {lost: {energy: dissipated}}}\n" + SPAN
    run(text).must(0)
    with open(tmp_path / "out" / "sensors.csv") as file:
        last = list(csv.reader(file))[-1]
    # v = 3 exp(−4 t): 4.5 (1 − exp(−0.8)) J; the trapezoidal rule errs by h²·4²/12.
    assert float(last[1]) == pytest.approx(4.5 * (1 - 2.718281828459045 ** -0.8), rel=1e-5)


def test_planar_gravity_out_of_the_plane(run):
    text = BLOCK.replace("planar: xy\n", "planar: xy\ngravity: [0, 0, -9.81 m/s^2]\n") + SPAN
    run(text).must(2, "model.yaml:3:", "gravity", "plane")


def test_assembly_gap_names_the_place_of_the_joint(run):
    text = (BLOCK.rstrip("}\n") + "}, markers: {m: {position: [1 m, 0, 0]}}}\n"
            "joints:\n  pin: {revolute: {between: [ground, a/origin]}}\n"
            "  far: {revolute: {between: [{ground: [0, 3 m, 0]}, a/m]}}\n" + SPAN)
    run(text).must(3, "model.yaml:7:", "far", "cannot be assembled")


def test_missing_table_names_the_place_of_its_name(run):
    text = BLOCK + ("joints:\n  pin: {revolute: {between: [ground, a/origin]}}\n"
                    "  turn: {prescribed-rotation: {between: [ground, a/origin], angle: "
                    "{file: none.csv}}}\n") + SPAN
    run(text).must(5, "model.yaml:7:", "none.csv", "no such file")


def test_notes_are_said_once_on_each_stream(run):
    result = run(BLOCK.replace(", inertia: [0, 0, 1]", "") + SPAN)
    note = "has no rotary inertia"
    assert result.err.count(note) == 1, result.err
