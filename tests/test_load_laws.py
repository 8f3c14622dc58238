# SPDX-License-Identifier: Apache-2.0
"""Time functions and tables of loads, what is recorded and reported of loads, what is refused."""

import csv
import math
import pathlib
import sys

import h5py
import numpy
import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent / "support"))
from loaded_bodies import AREA, B, FLYING, L, SIDE, bar, refuse, rod, sensors  # noqa: E402, F401

# ---- tables

RAMP = "  gas: {pressure: {on: bar/x1, value: VALUE}}\n"


def test_tables_and_expressions_are_the_same_load(sensors, tmp_path):
    (tmp_path / "gas.csv").write_text("time,pressure\n0,0\n2.5e-3,1000\n5e-3,2000\n")
    flying = FLYING.replace("sensors:", "sensors:\n    force: {load-force: gas}")
    values = ["\"4e8*t\"", "{table: [[0, 0], [5e-3, 2e6]]}",
              "{table: gas.csv, unit: kPa}", "{file: gas.csv, unit: kPa}",
              "{table: gas.csv, unit: kPa, interpolation: spline}"]
    runs = [sensors(bar(RAMP.replace("VALUE", value), flying)) for value in values]
    assert runs[0]["force.x"][-1] == pytest.approx(-2e6 * AREA, rel=1e-12)
    for run in runs[1:]:
        # A wave of 1e-5 m after 100 steps, each with rounding errors.
        assert numpy.abs(run["bend.x"] - runs[0]["bend.x"]).max() < 1e-15
        assert numpy.abs(run["place.x"] - runs[0]["place.x"]).max() < 1e-13


def test_a_spline_passes_through_its_points(sensors, tmp_path):
    times = numpy.linspace(0, 5e-3, 6)
    (tmp_path / "gas.csv").write_text("".join(f"{t!r};{1e6 * math.sin(300 * t)!r}\n" for t in times.tolist()))
    flying = FLYING.replace("sensors:", "sensors:\n    force: {load-force: gas}")
    out = sensors(bar(RAMP.replace("VALUE", "{table: gas.csv, interpolation: spline}"), flying))
    expected = -1e6 * AREA * numpy.sin(300 * times)
    assert out["force.x"] == pytest.approx(expected, rel=1e-6, abs=1e-6)


def test_a_table_is_not_extrapolated_unless_asked_for(buckens, tmp_path, sensors):
    short = bar(RAMP.replace("VALUE", "{table: [[0, 0], [4 ms, 2 MPa]]}"), FLYING)
    short = short.replace("4 ms", "4e-3").replace("2 MPa", "2e6")
    (tmp_path / "model.yaml").write_text(short)
    line = next(i for i, row in enumerate(short.split("\n"), 1) if "table:" in row)
    buckens("run", "model.yaml", "-o", "out").must(
        2, f"model.yaml:{line}:", "from t = 0 s to 0.004 s", "0 to 0.005 s", "extrapolation: hold")
    late = short.replace("[0, 0]", "[1e-3, 0]").replace("4e-3", "9e-3")
    (tmp_path / "model.yaml").write_text(late)
    buckens("check", "model.yaml").must(2, "from t = 0.001 s", "extrapolation: hold")
    held = short.replace("2e6]]", "2e6]], extrapolation: hold")
    out = sensors(held.replace("sensors:", "sensors:\n    force: {load-force: gas}"))
    assert out["force.x"][-2:] == pytest.approx([-2e6 * AREA] * 2, rel=1e-12)
    # Driven joints have tables, too.
    (tmp_path / "model.yaml").write_text("""
buckens: 1
bodies: {wheel: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}}}
joints: {motor: {prescribed-rotation: {between: [ground, wheel], axis: [0, 0, 1], angle: {table: [[0, 0], [1, 1]]}}}}
simulation: {duration: 2 s, step: 10 ms}
""")
    buckens("run", "model.yaml", "-o", "out").must(2, "model.yaml:4:", "0 to 2 s")


def test_wilsons_method_looks_beyond_the_end_of_a_run(buckens, tmp_path):
    """It evaluates loads at t + 1.4 h: the end of a table that ends with the run is reported when it is reached."""
    text = bar(RAMP.replace("VALUE", "{table: [[0, 0], [5e-3, 2e6]]}"), FLYING)
    (tmp_path / "model.yaml").write_text(text.replace("step: 0.05 ms", "step: 0.05 ms, method: wilson"))
    buckens("run", "model.yaml", "-o", "out").must(4, "load \"gas\"", "extrapolation: hold")


# ---- what is recorded


def test_loads_and_their_values_are_in_the_run_directory(buckens, tmp_path):
    loads = """  gas: {pressure: {on: bar/x1, value: "1e6*t"}}
  wind: {traction: {on: bar/y0, value: [0, "2e3*t", 0], axes: following}}
  shake: {base-acceleration: {value: [0, 0, 1]}}
  push: {force: {on: bar/corner_000, value: [1, 0, 0]}}
"""
    (tmp_path / "model.yaml").write_text(bar(loads, FLYING))
    buckens("run", "model.yaml", "-o", "out").must(0)
    with h5py.File(tmp_path / "out" / "results.h5") as file:
        group = file["geometry/loads"]
        gas = group["gas"]
        assert sorted(group) == ["gas", "push", "shake", "wind"]
        assert (gas.attrs["kind"], gas.attrs["body"], gas.attrs["unit"]) == ("pressure", "bar", "Pa")
        assert gas.attrs["follows"] == 1 and group["shake"].attrs["follows"] == 0
        positions = gas["positions"][:]
        assert len(positions) == 4
        assert positions[:, 0] == pytest.approx([L / 2] * 4)
        assert gas["directions"][:] == pytest.approx(numpy.array([[-1.0, 0, 0]] * 4))
        nodes = file["geometry/bodies/bar/nodes"][:]
        assert numpy.linalg.norm(nodes[gas["nodes"][0]] - positions[0]) < B
        assert "directions" not in group["wind"]
        assert group["push"]["positions"][:] == pytest.approx(numpy.array([[-L / 2, -B / 2, -B / 2]]))
        t = file["time"][:] if "time" in file else file["times"][:]
        value = file["loads/gas/value"]
        assert value[:] == pytest.approx(1e6 * t)
        assert file["loads/wind/value"][:, 1] == pytest.approx(2e3 * t)


def test_the_report_lists_distributed_loads(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(bar(SIDE, FLYING))
    out = buckens("check", "model.yaml").must(0).out
    assert "wind" in out and "pressure" in out and "bar/z1" in out and "0.1 m^2" in out
    assert "0, 0, -1e+05" in out and "0, 1e+05, 0" in out


# ---- errors


@pytest.mark.parametrize("load, words", [
    ("pressure: {on: bar/x3, value: 1 MPa}", ["no face \"x3\"", "Did you mean"]),
    ("pressure: {on: bar, value: 1 MPa}", ["a face is needed", "bar/x0"]),
    ("pressure: {on: bra/x1, value: 1 MPa}", ["no body \"bra\"", "\"bar\""]),
    ("pressure: {on: bar/x1, value: 5 N}", ["\"5 N\"", "a force", "a stress"]),
    ("pressure: {on: bar/x1}", ["\"value\" is missing"]),
    ("traction: {on: bar/x1, value: [1 MPa, 0]}", ["3 values"]),
    ("traction: {on: bar/x1, value: [1, 0, 0], axes: body}", ["must be one of fixed, following, not \"body\""]),
    ("line-load: {on: bar, value: [1, 0, 0]}", ["no beams or bars", "traction"]),
    ("body-force: {on: bar}", ["exactly one", "per-mass"]),
    ("body-force: {on: bar, per-mass: [1, 0, 0], per-volume: [1, 0, 0]}", ["exactly one"]),
    ("body-force: {on: bar/core, per-mass: [1, 0, 0]}", ["no element set \"core\""]),
    ("body-force: {on: bar, per-volume: [1 m, 0, 0]}", ["a length"]),
    ("base-acceleration: {value: [1 m, 0, 0]}", ["a length", "acceleration"]),
    ("pressure: {on: bar/x1, value: {table: nowhere.csv}}", ["nowhere.csv"]),
    ("pressure: {on: bar/x1, value: {table: [[0, 1], [-1, 2]]}}", ["must increase"]),
    ("pressure: {on: bar/x1, value: {table: [[-1, 1], [-0.5, 2]]}}", ["needed from 0"]),
])
def test_bad_loads_are_named(refuse, load, words):
    refuse(bar(f"  gas: {{{load}}}\n"), 5 if "nowhere" in load else 2, "model.yaml:", "table" if "needed from" in words[0] else "gas", *words)


def test_pressure_belongs_to_faces_and_meshes(refuse, buckens, tmp_path):
    refuse(rod("  gas: {pressure: {on: rod, value: 1 MPa}}\n"), 2, "no faces", "line-load")
    refuse("""
buckens: 1
bodies: {stone: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}}}
loads: {gas: {pressure: {on: stone/top, value: 1 MPa}}}
""", 2, "model.yaml:4:", "\"stone\" is rigid", "pressure")
    refuse(bar("  gas: {pressure: {on: bar/x1, value: 1}}\n").replace("{joint-force: wall}", "{load-force: gaz}"),
           2, "unknown load \"gaz\"", "gas")
    spring = rod("  pull: {spring-damper: {between: [ground, rod/end], stiffness: 1}}\n")
    (tmp_path / "model.yaml").write_text(spring.replace("{joint-force: wall}", "{load-force: pull}"))
    buckens("run", "model.yaml", "-o", "out").must(2, "opposite forces", "spring-force")


def test_planar_models_refuse_loads_out_of_their_plane(refuse):
    refuse("planar: xy" + rod("  snow: {line-load: {on: rod, value: [0, 0, 1 N/m]}}\n"), 2,
           "planar", "component z")


def test_pressure_across_a_planar_model_is_refused_but_may_cancel(refuse, sensors):
    across = "planar: xy" + bar("  gas: {pressure: {on: bar/z1, value: 1 MPa}}\n", FLYING)
    refuse(across, 2, "model.yaml:", "load \"gas\"", "planar", "along z")
    out = sensors("planar: xy" + bar("  gas: {pressure: {on: bar/skin, value: 1 MPa}}\n", FLYING))
    assert numpy.abs(out["place.x"] - L / 2).max() < 1e-12
    assert numpy.abs(out["bend.z"]).max() > 1e-8


def test_a_load_that_nothing_can_take_is_refused(buckens, tmp_path):
    """A body of matrices has mass, but no elements with a volume."""
    source = pathlib.Path(__file__).parents[1] / "examples" / "gyro_rotor"
    for file in source.iterdir():
        (tmp_path / file.name).write_bytes(file.read_bytes())
    model = tmp_path / "gyro_rotor.yaml"
    load = "\nloads:\n  field: {body-force: {on: rotor, KIND: [0, 0, 1]}}\n"
    bare = model.read_text()
    model.write_text(bare + load.replace("KIND", "per-volume"))
    buckens("check", "gyro_rotor.yaml").must(2, "gyro_rotor.yaml:", "load \"field\" on \"rotor\"",
                                             "no volume", "per-mass")
    model.write_text(bare + load.replace("KIND", "per-mass"))
    buckens("check", "gyro_rotor.yaml").must(0)


# ---- drives at t = 0

DRIVEN = """
buckens: 1
bodies:
  wheel: {rigid: {mass: 1 kg, inertia: [0.1, 0.1, 0.2]}}
joints:
  hinge: {revolute: {between: [ground, wheel], axis: [0, 0, 1]}}
  motor: {prescribed-rotation: {between: [ground, wheel], axis: [0, 0, 1], angle: "LAW"}}
simulation: {duration: 0.1 s, step: 1 ms}
output: {every: 10 ms, sensors: {turn: {joint-coordinate: hinge}, kinetic: {energy: kinetic}, torque: {joint-torque: motor}}}
"""


def test_a_drive_with_a_kink_at_the_start_moves_as_after_it(buckens, tmp_path):
    # The law before t = 0 is not part of the motion: full speed from the first instant on, no torque.
    (tmp_path / "model.yaml").write_text(DRIVEN.replace("LAW", "3*max(t, 0)"))
    buckens("run", "model.yaml", "-o", "out").must(0)
    rows = [[float(x) for x in row] for row in list(csv.reader((tmp_path / "out" / "sensors.csv").open()))[1:]]
    for t, angle, rate, kinetic, _, _, torque in rows:
        # One-sided differences over 1e-7 s are accurate to 1e-9 of the rate.
        assert angle == pytest.approx(3 * t, abs=1e-9) and rate == pytest.approx(3, rel=1e-8)
        assert kinetic == pytest.approx(0.5 * 0.2 * 9, rel=1e-8) and abs(torque) < 1e-4


@pytest.mark.parametrize("law, code, words", [
    ("sqrt(t)", 4, ["model.yaml:7:", "joint \"motor\"", "unbounded speed", "t^2"]),
    ("t^1.5", 0, ["joint \"motor\"", "acceleration", "unbounded at t = 0"]),
    ("t^2.5", 0, []),
])
def test_drives_with_singular_derivatives_at_the_start(buckens, tmp_path, law, code, words):
    (tmp_path / "model.yaml").write_text(DRIVEN.replace("LAW", law))
    result = buckens("run", "model.yaml", "-o", "out").must(code, *words)
    assert words or "motor" not in result.err
