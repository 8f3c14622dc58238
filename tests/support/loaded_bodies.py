# SPDX-License-Identifier: Apache-2.0
"""A bar of solids and a rod of beams under loads, and functions to run them."""

import csv
import itertools

import numpy
import pytest

E, RHO, L, B = 2.1e11, 7850.0, 1.0, 0.1
AREA, INERTIA = B * B, B**4 / 12

BAR = """
buckens: 1
materials:
  steel: {E: 2.1e11 Pa, nu: NU, rho: 7850 kg/m^3}
bodies:
  bar:
    mesh: {box: {from: [0, -50 mm, -50 mm], size: [1 m, 0.1 m, 0.1 m], divisions: [4, 2, 2], element: KIND}, material: steel}
    interfaces:
      root: {face: x0, kind: rigid}
      tip: {face: x1}
      skin: {box: {from: [0, -50 mm, -50 mm], to: [1 m, 50 mm, 50 mm]}}
"""

BEAM = """
buckens: 1
bodies:
  rod:
    beam:
      to: [1 m, 0, 0]
      elements: 4
      section: {rectangle: {width: 0.1 m, height: 0.1 m}}
      material: {E: 2.1e11 Pa, nu: 0.3, rho: 7850 kg/m^3}
"""

SKIN = "      skin: {box: {from: [0, -50 mm, -50 mm], to: [1 m, 50 mm, 50 mm]}}\n"

HELD = """
joints:
  wall: {fixed: {between: [ground, ROOT]}}
initial: {start: static}
simulation: {duration: 1 ms, step: 0.1 ms}
output:
  every: 1 ms
  sensors:
    tip: {position: TIP}
    wall: {joint-force: wall}
    hold: {joint-torque: wall}
"""

FLYING = """
simulation: {duration: 5 ms, step: 0.05 ms}
output:
  every: 1 ms
  sensors:
    place: {position: bar}
    spin: {angular-velocity: bar}
    bend: {deflection: {of: bar/corner_111, from: frame}}
    balance: {energy: balance}
    work: {energy: work}
"""

SIDE = "  wind: {pressure: {on: bar/z1, value: 1 MPa}}\n  drag: {traction: {on: bar/y0, value: [0, 1 MPa, 0]}}\n"


def bar(loads, rest=HELD, kind="hex8", nu=0.0):
    text = BAR + "loads:\n" + loads + rest
    return (text.replace("KIND", kind).replace("NU", str(nu))
            .replace("ROOT", "bar/root").replace("TIP", "bar/tip"))


def rod(loads, rest=HELD):
    return (BEAM + "loads:\n" + loads + rest).replace("ROOT", "rod/start").replace("TIP", "rod/end")


@pytest.fixture
def sensors(buckens, tmp_path):
    """Runs a model; returns the columns of sensors.csv by name without unit."""
    runs = itertools.count()

    def call(text, *arguments):
        out = tmp_path / f"out{next(runs)}"
        (tmp_path / "model.yaml").write_text(text)
        buckens("run", "model.yaml", "-o", out, *arguments).must(0)
        rows = list(csv.reader((out / "sensors.csv").open()))
        values = numpy.array(rows[1:], dtype=float).T
        return {name.split(" [")[0]: column for name, column in zip(rows[0], values)}

    return call


@pytest.fixture
def check(buckens, tmp_path):
    """The report of a model as JSON."""

    def call(text):
        (tmp_path / "model.yaml").write_text(text)
        return buckens("check", "model.yaml", "--json").must(0).json

    return call


@pytest.fixture
def refuse(buckens, tmp_path):
    def call(text, code, *words):
        (tmp_path / "model.yaml").write_text(text)
        buckens("check", "model.yaml").must(code, *words)

    return call


def vector(columns, name, row=0):
    return numpy.array([columns[f"{name}.{axis}"][row] for axis in "xyz"])
