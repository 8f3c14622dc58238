# SPDX-License-Identifier: Apache-2.0
"""`buckens static`: what it prints, what it writes, how it fails."""

import csv
import json
import math

import numpy
import pytest

from conftest import SOURCE

TRUSS = SOURCE / "examples" / "snap_through" / "snap_through.yaml"
B, H, EA = 1.0, 0.2, 2e5
L0 = math.hypot(B, H)
# The limit point of the two-bar truss: L^3 = L0 b^2.
L_LIMIT = (L0 * B * B) ** (1 / 3)
W_LIMIT = H - math.sqrt(L_LIMIT**2 - B * B)


def force(w):
    length = numpy.hypot(B, H - w)
    return 2 * EA * (L0 - length) / L0 * (H - w) / length


def columns_of(directory):
    rows = list(csv.reader((directory / "sensors.csv").open()))
    return dict(zip(rows[0], numpy.array(rows[1:], dtype=float).T))


def test_path_of_the_truss_is_written_as_a_run_directory(buckens, tmp_path):
    result = buckens("static", TRUSS, "-o", "path").must(0)
    assert result.out.count("limit point at load factor") == 2
    columns = columns_of(tmp_path / "path")
    assert list(columns)[:3] == ["t [s]", "load-factor [1]", "w [m]"]
    assert numpy.all(numpy.diff(columns["t [s]"]) > 0)
    w, load = columns["w [m]"], 1000 * columns["load-factor [1]"]
    assert load[0] == 0 and load[-1] == 1000
    # Newton converges to rounding of the forces in the bars.
    assert numpy.max(numpy.abs(load - force(w))) < 1e-9 * force(W_LIMIT)
    assert w[-1] > 2 * H


def test_summary_names_the_limit_points(buckens, tmp_path):
    summary = buckens("static", TRUSS, "-o", "path", "--json").must(0).json
    assert summary == json.loads((tmp_path / "path" / "summary.json").read_text())
    assert summary["status"] == "finished" and summary["trust"] == "ok"
    points = summary["static_path"]["critical_points"]
    assert [point["kind"] for point in points] == ["limit point"] * 2
    for point, sign, w in zip(points, (1, -1), (W_LIMIT, 2 * H - W_LIMIT)):
        assert point["load_factor"] == pytest.approx(sign * force(W_LIMIT) / 1000, rel=1e-10)
        # The load is stationary there; the place is known to about the root of its error.
        assert point["sensors"]["w"] == pytest.approx(w, abs=1e-7)
    assert summary["static_path"]["load_factor"] == 1


def test_directory_without_option_does_not_replace_that_of_run(buckens, tmp_path):
    buckens("static", TRUSS, "--quiet").must(0)
    assert (tmp_path / "snap_through.static.out" / "results.h5").exists()


def test_load_control_stops_at_the_limit_point(buckens, tmp_path):
    result = buckens("static", TRUSS, "-o", "path", "--set", "static.method=load")
    result.must(4, "cannot be followed beyond load factor 0.59", "arc-length", "are kept")
    summary = json.loads((tmp_path / "path" / "summary.json").read_text())
    assert summary["status"] == "interrupted"
    assert len(columns_of(tmp_path / "path")["w [m]"]) > 10


def test_path_ends_where_a_sensor_says(buckens, tmp_path):
    buckens("static", TRUSS, "-o", "path", "--set", "static.stop={sensor: w, at: 300 mm}").must(0)
    w = columns_of(tmp_path / "path")["w [m]"]
    assert w[-1] >= 0.3 > w[-2]


def test_path_that_is_too_long_is_not_called_finished(buckens, tmp_path):
    result = buckens("static", TRUSS, "-o", "path", "--set", "static.max-points=5")
    assert result.code == 4 and "NOT FINISHED: 5 points" in result.out
    assert len(columns_of(tmp_path / "path")["w [m]"]) == 5


@pytest.mark.parametrize("setting, code, words", [
    ("static.load-factor=[1, 1]", 2, ["load-factor", "[0, 1]"]),
    ("static.load-factor=[0, .inf]", 2, ["load-factor"]),
    ("static.steps=0", 2, ["steps"]),
    ("static.steps=100000000", 2, ["steps", "1000000"]),
    ("static.arc-step=-0.1", 2, ["arc-step"]),
    ("static.method=arc", 2, ["arc-length"]),
    ("static.time=0 s", 2, ["no load", "t = 0 s", "time"]),
    ("static.stop={sensor: v, at: 1}", 2, ["\"v\"", "load-factor"]),
    ("output.sensors.w.displacement.along=[0, 0, 0]", 2, ["along", "[0, -1, 0]"]),
    ("output.sensors={load-factor: {energy: total}}", 3, ["load-factor", "taken"]),
])
def test_bad_input(buckens, setting, code, words):
    buckens("static", TRUSS, "-o", "path", "--set", setting).must(code, *words)


def test_mechanism_is_refused_with_the_free_direction(buckens, tmp_path):
    (tmp_path / "door.yaml").write_text("""
buckens: 1
bodies: {door: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}, at: {position: [1 m, 0, 0]},
                markers: {post: {position: [-1 m, 0, 0]}}}}
joints: {hinge: {revolute: {between: [ground, door/post], axis: [0, 0, 1]}}}
loads: {push: {force: {on: door, value: [1 N, 0, 0]}}}
""")
    buckens("static", "door.yaml").must(3, "door", "turns about (0, 0, ", "load-factor")


def test_bars_that_bend_buckle_before_the_truss_snaps(buckens, tmp_path):
    model = SOURCE / "examples" / "snap_through_bending" / "snap_through_bending.yaml"
    points = buckens("static", model, "-o", "path", "--json").must(0).json["static_path"]["critical_points"]
    # With 8 frames per bar the bifurcation of straight bars is at 330 N; 1 % of lateral load takes a
    # few per cent off.
    assert points[0]["kind"] == "limit point" and 0.29 < points[0]["load_factor"] < 0.33
    # The branch of straight bars is passed, too: its limit point is that of the truss.
    assert max(point["load_factor"] for point in points) == pytest.approx(force(W_LIMIT) / 1000, rel=0.02)


def test_an_unloaded_start_of_a_path_is_balanced(buckens, tmp_path):
    """Without gravity all forces are rounding errors there; none can be required to balance to a fraction of the others."""
    model = SOURCE / "examples" / "large_bend" / "large_bend.yaml"
    buckens("static", model, "-o", "path").must(0)
    with open(tmp_path / "path" / "sensors.csv") as file:
        last = list(csv.reader(file))[-1]
    assert float(last[1]) == pytest.approx(1.0)
    # The equilibrium that `initial: {start: static}` finds with 16 elements; its table has three digits.
    tip = [float(last[2]) - 70.711, float(last[3]) - 29.289, float(last[4])]
    assert tip == pytest.approx([-23.808, -13.722, 53.614], abs=1e-3)
