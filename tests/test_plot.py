# SPDX-License-Identifier: Apache-2.0
"""`buckens plot`: curves without leaving the shell."""

import struct
import xml.etree.ElementTree
import zlib

import numpy
import pytest

MODEL = """
buckens: 1
title: A falling & turning <rod>
gravity: [0, -9.81 m/s^2, 0]
planar: xy
bodies:
  rod:
    beam: {to: [1 m, 0, 0], elements: 4, section: {circle: {diameter: 8 mm}}, material: {E: 210 GPa, nu: 0.3, rho: 7850}}
joints: {pin: {revolute: {between: [ground, rod/start]}}}
simulation: {duration: 0.2 s, step: 1 ms}
output:
  sensors:
    tip: {position: rod/end}
    pull: {joint-force: pin}
    energy: {energy: total}
"""


@pytest.fixture
def run(buckens, tmp_path):
    (tmp_path / "rod.yaml").write_text(MODEL)
    buckens("run", "rod.yaml", "-o", "out", "-q").must(0)
    return tmp_path


def lines_of(path):
    """Polylines of an SVG file that have as many points as a curve: [points × 2] each."""
    out = []
    for element in xml.etree.ElementTree.parse(path).getroot().iter():
        words = element.get("d", "").split()
        if not element.tag.endswith("path") or len(words) < 300 or "C" in words:
            continue
        numbers = [float(word) for word in words if word not in ("M", "L", "Z")]
        out.append(numpy.array(numbers).reshape(-1, 2))
    return out


def words_of(path):
    root = xml.etree.ElementTree.parse(path).getroot()
    return {element.tag.split("}")[1]: element.text for element in root if element.text and element.text.strip()}


def sensors_of(directory):
    rows = (directory / "sensors.csv").read_text().splitlines()
    names = [name.split(" [")[0] for name in rows[0].split(",")]
    return dict(zip(names, numpy.array([row.split(",") for row in rows[1:]], dtype=float).T))


def test_svg_shows_the_curve(buckens, run):
    assert buckens("plot", "out", "tip.y", "-o", "tip.svg").must(0).out == "tip.svg (1 curve)\n"
    words = words_of(run / "tip.svg")
    assert words["title"] == "A falling & turning <rod>"
    assert words["desc"] == "tip.y [m] over t [s]"
    curve, = lines_of(run / "tip.svg")
    known = sensors_of(run / "out")
    # Affine maps of time and value; the picture's points have six digits.
    for column, values in ((0, known["t"]), (1, known["tip.y"])):
        fit = numpy.polyfit(values, curve[:, column], 1)
        assert numpy.abs(numpy.polyval(fit, values) - curve[:, column]).max() < 0.01
        assert fit[0] > 0 if column == 0 else fit[0] < 0


def test_curves_of_different_units_get_diagrams_of_their_own(buckens, run):
    report = buckens("plot", "out", "tip.x", "tip.y", "pull.norm", "energies/kinetic", "-o", "all.svg", "--json").must(0).json
    assert report == {"file": "all.svg", "panels": 3, "curves": 4}
    assert "pull.norm [N]" in words_of(run / "all.svg")["desc"]
    assert len(lines_of(run / "all.svg")) == 4


def test_runs_are_compared(buckens, run):
    buckens("run", "rod.yaml", "-o", "heavy", "-q", "--set", "gravity=[0, -20, 0]").must(0)
    buckens("plot", "out", "heavy", "--sensor", "tip.y", "-o", "two.svg", "--title", "Two").must(0)
    assert words_of(run / "two.svg")["desc"] == "out: tip.y [m], heavy: tip.y [m] over t [s]"
    first, second = lines_of(run / "two.svg")
    assert second[-1, 1] > first[-1, 1] + 10  # further down


def test_one_sensor_over_another(buckens, run):
    buckens("plot", "out", "tip.y", "--x", "tip.x", "--from", "0.05", "--to", "0.1", "-o", "xy.svg").must(0)
    assert words_of(run / "xy.svg")["desc"] == "tip.y [m] over tip.x [m]"


def png_pixels(path):
    """Size and pixels of a PNG file of eight bits per channel."""
    raw = path.read_bytes()
    assert raw[:8] == b"\x89PNG\r\n\x1a\n"
    width, height, depth, kind = struct.unpack_from(">2I2B", raw, 16)
    channels = {2: 3, 6: 4}[kind]
    assert depth == 8
    data, at = b"", 8
    while at < len(raw):
        length, name = struct.unpack_from(">I4s", raw, at)
        if name == b"IDAT":
            data += raw[at + 8:at + 8 + length]
        at += 12 + length
    rows = numpy.frombuffer(zlib.decompress(data), numpy.uint8).reshape(height, 1 + width * channels)
    return width, height, rows


def test_png_and_pdf(buckens, run):
    buckens("plot", "out", "tip", "-o", "tip.png", "--size", "400", "300").must(0)
    width, height, rows = png_pixels(run / "tip.png")
    assert (width, height) == (800, 600)  # two pixels per point
    assert len(numpy.unique(rows[:, 1:])) > 20  # lines and letters, not an empty page
    buckens("plot", "out", "tip", "-o", "tip.pdf").must(0)
    assert (run / "tip.pdf").read_bytes().startswith(b"%PDF-")


def test_long_runs_are_thinned_out(buckens, run):
    buckens("run", "rod.yaml", "-o", "long", "-q", "--set", "output.every=10 us").must(0)
    buckens("plot", "long", "tip.y", "-o", "long.svg").must(0)
    assert (run / "long.svg").stat().st_size < 400_000
    curve, = lines_of(run / "long.svg")
    assert len(curve) < 6000


@pytest.mark.parametrize("arguments, code, words", [
    (["out", "tpi.x"], 2, ["no sensor \"tpi.x\"", "\"tip.x\""]),
    (["out", "tip.w"], 2, ["no \"tip.w\"", "tip.x"]),
    (["out"], 2, ["say what to plot", "tip.x", "energy"]),
    (["out", "tip", "-o", "tip.gif"], 2, ["tip.gif", ".svg"]),
    (["out", "tip", "--from", "0.15", "--to", "0.05"], 2, ["no record", "from 0 to 0.2 s"]),
    (["out", "tip.y", "--x", "tip"], 2, ["--x tip", "tip.x"]),
    (["nowhere", "tip"], 5, ["nowhere", "not a run directory"]),
    (["out", "tip", "-o", "missing/tip.svg"], 5, ["missing/tip.svg"]),
])
def test_mistakes_are_explained(buckens, run, arguments, code, words):
    buckens("plot", *arguments).must(code, *words)
