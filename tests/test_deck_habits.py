# SPDX-License-Identifier: Apache-2.0
"""Decks in the habits of pre-processors: tests/decks/habits."""

import math

import numpy
import pytest

from conftest import SOURCE

HABITS = SOURCE / "tests" / "decks" / "habits"

MODEL = """buckens: 1
materials: {{steel: {{E: 210 GPa, nu: {nu}, rho: {rho}}}}}
bodies:
  bar:
    mesh: {{box: {{size: [0.1 m, 0.02 m, 0.01 m], divisions: [4, 1, 1]}}, material: steel}}
  deck:
    mesh: {{file: {path}, {units}}}
"""
MM = "length-unit: mm"
METRES = "length-unit: m, mass-unit: kg, material: steel"


@pytest.fixture
def bodies(buckens, tmp_path):
    """What `check` tells of the bar and of the body of a deck, and what `mesh-info` notes."""
    def call(name, units=MM, nu=0.3, rho=7850):
        path = HABITS / name
        (tmp_path / "model.yaml").write_text(MODEL.format(path=path, units=units, nu=nu, rho=rho))
        told = buckens("check", "model.yaml", "--json").must(0).json["bodies"]
        notes = buckens("mesh-info", str(path), "--json").must(0).json["notes"]
        return told["bar"], told["deck"], notes

    return call


@pytest.mark.parametrize("name, more", [
    ("freecad.inp", {"rho": 7900}), ("salome.unv", {"units": METRES}),
    ("nx.unv", {"units": "length-unit: mm, material: steel"})])
def test_a_bar_is_the_bar(bodies, name, more):
    bar, deck, notes = bodies(name, **more)
    # Elements are those of the generated bar; places and constants have up to seven digits.
    assert deck["mass"] == pytest.approx(bar["mass"], rel=1e-9)
    assert deck["frequencies"] == pytest.approx(bar["frequencies"], rel=1e-6)
    if name == "nx.unv":
        assert any("lumped masses are left out" in text for text in notes)
        assert any("rigid elements are left out" in text for text in notes)


def test_a_rigid_body_in_the_way_of_prepomax(bodies):
    bar, deck, _ = bodies("prepomax.inp", nu=0.28, rho=7800)
    assert deck["mass"] == pytest.approx(bar["mass"], rel=1e-9)
    # One end is rigid: stiffer, but with all six motions of the rest.
    assert all(1 < a / b < 1.1 for a, b in zip(deck["frequencies"], bar["frequencies"]))


def test_masses_in_the_way_of_femap_and_hypermesh(bodies):
    """2 kg on a spring behind an average, or in a rigid link, at x = 132 and 120 mm."""
    for name, place in (("femap.nas", 0.132), ("hypermesh.fem", 0.12)):
        bar, deck, _ = bodies(name)
        assert deck["mass"] == pytest.approx(bar["mass"] + 2, rel=1e-9)
        assert deck["com"][0] == pytest.approx((bar["mass"] * 0.05 + 2 * place) / deck["mass"], rel=1e-9)


def test_two_instances_a_tie_and_a_coupling_in_the_way_of_cae(bodies):
    bar, deck, _ = bodies("cae.inp")
    assert deck["mass"] == pytest.approx(2 * bar["mass"] + 2, rel=1e-9)
    # 2 kg at x = −10 mm, bars from 0 to 100 and, turned about their axis, from 100 to 200 mm.
    assert deck["com"] == pytest.approx([(bar["mass"] * 0.2 - 0.02) / deck["mass"], 0.01, 0.005], rel=1e-9)


def test_a_sandwich_in_the_way_of_patran(bodies):
    _, deck, _ = bodies("patran.bdf", units="length-unit: mm, mass-unit: t")
    area, faces, core = 100 * 40, 4 * 0.125, 1.5  # mm
    mass = area * (faces * 1.6e-9 + core * 5e-11) * 1000
    assert deck["mass"] == pytest.approx(mass, rel=1e-9)


def l_moments(width, height, t_low, t_side):
    """Second moments of an angle, y up and z to the right, from many small squares of its area."""
    n = 400
    y, z = numpy.meshgrid((numpy.arange(n) + 0.5) * height / n, (numpy.arange(n) + 0.5) * width / n)
    inside = (y < t_low) | (z < t_side)
    y, z, dA = y[inside], z[inside], height * width / n**2
    y, z = y - y.mean(), z - z.mean()
    return numpy.array([[(z * z).sum(), -(y * z).sum()], [-(y * z).sum(), (y * y).sum()]]) * dA


def test_beams_of_all_kinds(bodies):
    _, deck, _ = bodies("beams.bdf", units="length-unit: m, mass-unit: kg")
    angle = next(s for s in deck["sections"] if s["EI_z"] == pytest.approx(44869, rel=0.02))
    # The bar runs along y, its section's y along x of the mesh and z against z.
    moments, axes = numpy.linalg.eigh(70e9 * l_moments(0.06, 0.08, 0.006, 0.006))
    # Squares of 0.15 and 0.2 mm follow walls of 6 mm exactly.
    assert angle["EI_y"] == pytest.approx(moments[0], rel=1e-3)
    assert angle["EI_z"] == pytest.approx(moments[1], rel=1e-3)
    about = axes[:, 1]
    assert abs(numpy.dot(angle["z"], [about[0], 0, -about[1]])) == pytest.approx(1, rel=1e-6)
    # Cards of non-structural mass that the case control asks for, 1.5 kg/m on three bars of 1 m, and that of the PBEAM,
    # 0.375 kg/m as the mean of both ends.
    areas = [1.5e-3, 2 * 0.06 * 0.008 + 0.084 * 0.005, 0.06 * 0.006 + 0.074 * 0.006,
             math.pi * (0.03**2 - 0.025**2), 0.003 * (0.03 + 2 * 0.044 + 2 * 0.023)]
    assert deck["mass"] == pytest.approx(2700 * sum(areas) + 4.5 + 0.375, rel=1e-9)
