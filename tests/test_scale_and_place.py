# SPDX-License-Identifier: Apache-2.0
"""Results depend neither on the units in which a machine is described nor on its position."""

import csv
import json

import pytest

# Factors that convert a machine of ordinary size to other units of length, mass and time.
UNITS = {"micrometres": (1e-6, 1, 1), "thousand km": (1e6, 1, 1), "milligrams": (1, 1e-6, 1),
         "kilotons": (1, 1e6, 1), "microseconds": (1, 1, 1e-6), "weeks": (1, 1, 1e6),
         "all small": (1e-6, 1e-6, 1e-6), "all large": (1e6, 1e6, 1e6)}


def at(place, x, y=0.0):
    return [place[0] + x, place[1] + y, place[2]]


def steel(a, b, c, E=2e11):
    return {"E": E * b / (a * c * c), "nu": 0.3, "rho": 7870 * b / a**3}


def crank(unit=(1, 1, 1), place=(0, 0, 0)):
    """A driven crank, a flexible rod of 0.7 m, a slider: 150 rad/s."""
    a, b, c = unit
    r, L = 0.15 * a, 0.7 * a
    ground = {"ground": at(place, 0)}
    return {
        "buckens": 1, "planar": "xy", "gravity": [0, -9.81 * a / c**2, 0],
        "materials": {"steel": steel(a, b, c)},
        "bodies": {
            "crank": {"rigid": {"mass": 0.36 * b, "com": [r / 2, 0, 0],
                                "inertia": [0, 0, 2.727e-3 * b * a * a]},
                      "markers": {"pin": {"position": [r, 0, 0]}}, "at": {"position": at(place, 0)}},
            "rod": {"beam": {"to": [L, 0, 0], "elements": 8, "material": "steel",
                             "section": {"circle": {"diameter": 0.012 * a}}},
                    "at": {"position": at(place, r)}},
            "slider": {"rigid": {"mass": 0.033 * b, "inertia": [0, 0, 1e-6 * b * a * a]},
                       "at": {"position": at(place, r + L)}}},
        "joints": {
            "shaft": {"revolute": {"between": [ground, "crank/origin"]}},
            "motor": {"prescribed-rotation": {"between": [ground, "crank/origin"],
                                              "angle": f"{150 / c!r}*t rad"}},
            "big_end": {"revolute": {"between": ["crank/pin", "rod/start"]}},
            "small_end": {"revolute": {"between": ["rod/end", "slider"]}},
            "guide": {"prismatic": {"between": [ground, "slider"], "axis": [1, 0, 0]}}},
        "simulation": {"duration": 0.02 * c, "step": 5e-5 * c},
        "output": {"every": 1e-3 * c, "sensors": {
            "length": {"deflection": {"of": "rod/mid", "from": "chord"}},
            "force": {"joint-force": "big_end"},
            "energy": {"energy": "kinetic"}}}}


def pendulum(unit=(1, 1, 1), place=(0, 0, 0)):
    """A soft beam in space on a ball joint, with a spring that turns its end."""
    a, b, c = unit
    force = a * b / c**2
    return {
        "buckens": 1, "gravity": [0, -9.81 * a / c**2, 2 * a / c**2],
        "materials": {"soft": steel(a, b, c, 2e9)},
        "bodies": {"beam": {"beam": {"to": [a, 0, 0], "elements": 8, "material": "soft",
                                     "section": {"rectangle": {"width": 0.02 * a, "height": 0.03 * a}}},
                            "at": {"position": at(place, 0)}}},
        "joints": {"ball": {"spherical": {"between": [{"ground": at(place, 0)}, "beam/start"]}}},
        "loads": {"turn": {"torsional-spring": {"between": [{"ground": at(place, 0)}, "beam/end"],
                                                "axis": [0, 0, 1], "stiffness": 2.0 * force * a}}},
        "simulation": {"duration": 0.2 * c, "step": 1e-3 * c},
        "output": {"every": 1e-2 * c, "sensors": {
            "length": {"displacement": "beam/end"},
            "force": {"joint-force": "ball"},
            "energy": {"energy": "kinetic"}}}}


@pytest.fixture
def measured(buckens, tmp_path):
    def call(model, unit=(1, 1, 1)):
        (tmp_path / "model.json").write_text(json.dumps(model))
        buckens("run", "model.json", "-q", "-o", tmp_path / "out").must(0)
        summary = json.loads((tmp_path / "out" / "summary.json").read_text())
        with open(tmp_path / "out" / "sensors.csv") as file:
            header, *rows = csv.reader(file)
        a, b, c = unit
        scales = {"length": a, "force": a * b / c**2, "energy": b * a * a / c**2}
        curves = {}
        for k, name in enumerate(header[1:], 1):
            scale = scales[name.split(".")[0].split(" ")[0]]
            curves[name] = [float(row[k]) / scale for row in rows]
        return curves, summary

    return call


def largest_difference(curves, reference):
    """Relative to the largest value of each quantity (all its components together)."""
    out = {}
    for name, curve in curves.items():
        family = name.split(".")[0].split(" ")[0]
        size = max(abs(x) for other in reference if other.startswith(family) for x in reference[other])
        change = max(abs(x - y) for x, y in zip(curve, reference[name], strict=True)) / size
        out[family] = max(out.get(family, 0.0), change)
    return out


@pytest.mark.parametrize("machine", [crank, pendulum])
@pytest.mark.parametrize("unit", UNITS.values(), ids=UNITS)
def test_units_change_nothing(measured, machine, unit):
    reference, effort = measured(machine())
    curves, summary = measured(machine(unit), unit)
    assert summary["newton_iterations"]["total"] == pytest.approx(effort["newton_iterations"]["total"], rel=0.01)
    assert summary["steps"] == effort["steps"]
    assert summary["trust"] == effort["trust"]
    # Rounding of the data, 1e-16, times what the stiffest mode against the motion makes of it.
    for family, change in largest_difference(curves, reference).items():
        assert change < 1e-6, family


@pytest.mark.parametrize("machine", [crank, pendulum])
@pytest.mark.parametrize("place", [(1e4, -3e3, 0), (2e4, 0, 0), (1e7, -4e6, 0), (-3e5, 1e7, 0)], ids=str)
def test_the_place_changes_nothing(measured, machine, place):
    reference, effort = measured(machine())
    curves, summary = measured(machine(place=place))
    assert summary["newton_iterations"]["total"] == pytest.approx(effort["newton_iterations"]["total"], rel=0.01)
    assert summary["steps"] == effort["steps"]
    # Numbers in the model file are rounded to 1e-16 of the distance: relative to 0.7 m, and times the ratio of
    # axial stiffness to forces for strains.
    rounding = 2e-16 * max(abs(x) for x in place) / 0.7
    for family, change in largest_difference(curves, reference).items():
        assert change < 1e-6 + 3e4 * rounding, family


def test_positions_are_those_of_the_world(buckens, tmp_path):
    model = pendulum(place=(1e7, -4e6, 0))
    model["output"]["sensors"] = {"end": {"position": "beam/end"}, "height": {"energy": "potential"}}
    (tmp_path / "model.json").write_text(json.dumps(model))
    buckens("run", "model.json", "-q", "-o", tmp_path / "out").must(0)
    with open(tmp_path / "out" / "sensors.csv") as file:
        header, first, *_ = csv.reader(file)
    row = dict(zip(header, map(float, first)))
    assert row["end.x [m]"] == pytest.approx(1e7 + 1, abs=1e-8)
    assert row["end.y [m]"] == pytest.approx(-4e6, abs=1e-8)
    mass = 7870 * 0.02 * 0.03
    assert row["height [J]"] == pytest.approx(-mass * 9.81 * 4e6, rel=1e-9)


@pytest.mark.parametrize("unit", [(1e-6, 1, 1), (1e6, 1, 1), (1, 1, 1e-6)], ids=str)
def test_units_change_no_vibration_about_a_static_position(buckens, tmp_path, unit):
    """Statics, its linearisation and the pencil: the end turns by some 0.1 rad under its load."""
    def frequencies(unit):
        model = pendulum(unit)
        (tmp_path / "model.json").write_text(json.dumps(model))
        found = buckens("modes", "model.json", "--system", "--about", "static", "--count", "8", "--json").must(0)
        return [mode["frequency"] * unit[2] for mode in found.json["analyses"][0]["modes"]]

    assert frequencies(unit) == pytest.approx(frequencies((1, 1, 1)), rel=1e-7, abs=1e-7)
