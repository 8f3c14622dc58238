# SPDX-License-Identifier: Apache-2.0
"""Damping ratios: as requested in the model file, as reported by `check`, and as shown by a run."""

import csv
import math

import numpy
import pytest

L, E, RHO, B = 1.0, 2e11, 7850.0, 0.01
ROOTS = (1.8751040687119611, 4.6940911329741746)
# Bending of a clamped beam: omega = (beta L)^2 sqrt(E I / rho A) / L^2.
CLAMPED = [root**2 * math.sqrt(E * B**2 / 12 / RHO) / L**2 / (2 * math.pi) for root in ROOTS]

MODEL = """
buckens: 1
planar: xy
materials:
  steel: {E: 2e11 Pa, nu: 0.3, rho: 7850 kg/m^3}
bodies:
  beam:
    beam:
      to: [1 m, 0, 0]
      elements: 8
      section: {rectangle: {width: 10 mm, height: 10 mm}}
      material: steel
    damping: DAMPING
joints:
  clamp: {fixed: {between: [ground, beam/start]}}
initial:
  bodies:
    beam: {nodal-velocity: {y: "0.1*SHAPE m/s", rz: "0.1*SLOPE rad/s"}}
# No numerical damping: all decay is due to the material.
simulation: {duration: DURATION s, step: STEP s, rho-inf: 1}
output:
  every: EVERY s
  sensors:
    tip: {position: beam/end}
"""


def mode(k):
    """Shape of a clamped beam over x, and its slope."""
    a = ROOTS[k]
    ratio = (math.cosh(a) + math.cos(a)) / (math.sinh(a) + math.sin(a))
    shape = f"(cosh({a}*x)-cos({a}*x)-{ratio}*(sinh({a}*x)-sin({a}*x)))"
    slope = f"{a}*(sinh({a}*x)+sin({a}*x)-{ratio}*(cosh({a}*x)-cos({a}*x)))"
    return shape, slope


def model(damping, k=0, periods=12):
    shape, slope = mode(k)
    step = 1 / CLAMPED[k] / 200
    values = {"DAMPING": damping, "SHAPE": shape, "SLOPE": slope, "STEP": repr(step),
              "EVERY": repr(step), "DURATION": repr(200 * periods * step)}
    out = MODEL
    for key, value in values.items():
        out = out.replace(key, value)
    return out


@pytest.fixture
def check(buckens, tmp_path):
    def call(text):
        (tmp_path / "model.yaml").write_text(text)
        return buckens("check", "model.yaml", "--json").must(0).json

    return call


def decrement(buckens, tmp_path, text):
    """Damping ratio from the extremes of the tip, once other vibrations have died down."""
    (tmp_path / "model.yaml").write_text(text)
    buckens("run", "model.yaml", "-o", "out").must(0)
    rows = list(csv.reader((tmp_path / "out" / "sensors.csv").open()))
    values = numpy.array(rows[1:], dtype=float)
    y = values[:, rows[0].index("tip.y [m]")]
    inner = numpy.flatnonzero((numpy.abs(y[1:-1]) >= numpy.abs(y[:-2]))
                              & (numpy.abs(y[1:-1]) > numpy.abs(y[2:]))) + 1
    peaks = numpy.abs(y[inner])
    first, last = 4, len(peaks) - 1
    delta = math.log(peaks[first] / peaks[last]) / ((last - first) / 2)
    return delta / math.sqrt(4 * math.pi**2 + delta**2)


def test_a_clamped_beam_decays_as_it_was_asked_to(buckens, tmp_path, check):
    asked = f"{{ratio: 2 %, at: [{CLAMPED[0]} Hz, {CLAMPED[1]} Hz]}}"
    listed = check(model(asked))["damping"]
    # Elements move the frequencies by 1e-5; damping shifts nothing in this formula.
    assert [m["frequency"] for m in listed[:2]] == pytest.approx(CLAMPED, rel=1e-4)
    assert [m["ratio"] for m in listed[:2]] == pytest.approx([0.02, 0.02], rel=1e-4)
    assert [m["asked"] for m in listed[:2]] == pytest.approx([0.02, 0.02], rel=1e-4)
    assert {m["body"] for m in listed} == {"beam"}
    # Sampled peaks are 1 - cos(pi/200) = 1e-4 low, but all equally; what remains of the other
    # vibrations after two periods is 1e-3.
    assert decrement(buckens, tmp_path, model(asked, 0)) == pytest.approx(0.02, rel=0.01)
    assert decrement(buckens, tmp_path, model(asked, 1)) == pytest.approx(0.02, rel=0.02)


def test_of_free_is_what_check_says_it_is(buckens, tmp_path, check):
    asked = f"{{ratio: 2 %, at: [{CLAMPED[0]} Hz, {CLAMPED[1]} Hz], of: free}}"
    report = check(model(asked))
    first = report["damping"][0]
    # 1 % of the kinetic energy is relative to the frame (docs/theory/20-damping.md).
    assert 0.0025 < first["ratio"] < 0.0035
    assert any("of: held" in note and "\"beam\"" in note for note in report["notes"])
    ran = decrement(buckens, tmp_path, model(asked, 0, periods=30))
    assert ran == pytest.approx(first["ratio"], rel=0.02)


def test_one_frequency_grows_in_proportion(buckens, tmp_path, check):
    asked = f"{{ratio: 2 %, at: [{CLAMPED[0]} Hz]}}"
    listed = check(model(asked))["damping"]
    assert listed[0]["ratio"] == pytest.approx(0.02, rel=1e-4)
    assert listed[1]["ratio"] == pytest.approx(0.02 * CLAMPED[1] / CLAMPED[0], rel=1e-3)
    assert decrement(buckens, tmp_path, model(asked)) == pytest.approx(0.02, rel=0.01)


def test_the_table_of_check(buckens, tmp_path):
    asked = f"{{ratio: 2 %, at: [{CLAMPED[0]} Hz, {CLAMPED[1]} Hz]}}"
    (tmp_path / "model.yaml").write_text(model(asked))
    text = buckens("check", "model.yaml").must(0).out
    line = next(line for line in text.splitlines() if line.strip().startswith("8.15"))
    assert line.split()[1:3] == ["2", "2"]
    modes = buckens("modes", "model.yaml", "--system").must(0).out
    assert "damping [%]" in modes


def test_what_cannot_be_had_is_refused(buckens, tmp_path):
    two = f"{{ratio: 2 %, at: [{CLAMPED[0]} Hz, {CLAMPED[1]} Hz]}}\n    frames: 2"
    (tmp_path / "model.yaml").write_text(model(two))
    buckens("check", "model.yaml").must(3, "\"beam\"", "several frames", "at: [f]", "of: free")
    (tmp_path / "model.yaml").write_text(model("{ratio: 2 %, at: [1 Hz, 2 Hz, 3 Hz]}"))
    buckens("check", "model.yaml").must(2, "one or two frequencies")
    (tmp_path / "model.yaml").write_text(model("{mass: 2 1/s, of: free}"))
    buckens("check", "model.yaml").must(2, "of", "remove the key")


def test_a_damper_counts_too(check):
    # A mass on a spring and damper: zeta = c/(2 sqrt(k m)).
    report = check("""
buckens: 1
planar: xy
bodies:
  block: {rigid: {mass: 2 kg, inertia: [0, 0, 1 kg m^2]}, at: {position: [1 m, 0, 0]}}
joints:
  guide: {prismatic: {between: [ground, block], axis: [1, 0, 0]}}
loads:
  strut: {spring-damper: {between: [ground, block], stiffness: 800 N/m, damping: 4 N s/m}}
simulation: {duration: 1 s, step: 1 ms}
""")
    assert report["damping"][0]["ratio"] == pytest.approx(4 / (2 * math.sqrt(800 * 2)), rel=1e-9)
    assert report["damping"][0]["asked"] is None
