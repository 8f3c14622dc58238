# SPDX-License-Identifier: Apache-2.0
"""`buckens modes`: what it prints and writes, and the errors of its command line."""

import math

import h5py
import numpy
import pytest

from conftest import SOURCE

FORK = SOURCE / "examples" / "tuning_fork" / "tuning_fork.yaml"
METHODS = ["subspace", "augmented", "penalty", "spectra", "dense"]


def frequencies(analysis):
    return numpy.array([mode["frequency"] for mode in analysis["modes"]])


def test_free_modes_of_every_flexible_body(buckens, models):
    report = buckens("modes", models / "beam.yaml", "--json").must(0).json
    bodies = [analysis["body"] for analysis in report["analyses"]]
    checked = buckens("check", models / "beam.yaml", "--json").must(0).json["bodies"]
    assert bodies == [name for name, body in checked.items() if body["flexible"]]
    for analysis in report["analyses"]:
        assert analysis["kind"] == "free"
        listed = checked[analysis["body"]]["frequencies"]
        assert frequencies(analysis)[:len(listed)] == pytest.approx(listed, rel=1e-9)


def test_all_methods_agree(buckens):
    found = {}
    for method in METHODS:
        analysis = buckens("modes", FORK, "--count", 12, "--method", method, "--json").must(
            0).json["analyses"][0]
        assert analysis["work"]["method"] == method
        assert analysis["rigid_modes"] == 6
        found[method] = frequencies(analysis)
        assert len(found[method]) == 12
        for mode in analysis["modes"]:
            assert mode["error"] < 1e-7
            assert sum(mode["energy_shares"].values()) == pytest.approx(1, abs=1e-12)
    for method in METHODS[1:]:
        # Rounding of the assembled stiffness, eps (omega_max/omega)^2 = 1e-9 in omega^2.
        assert found[method] == pytest.approx(found["subspace"], rel=1e-8)


def test_a_tuning_fork_sounds_a_and_does_not_feel_the_hand(buckens):
    free = buckens("modes", FORK, "--json").must(0).json["analyses"][0]
    held = buckens("modes", FORK, "--system", "--json").must(0).json["analyses"][0]
    assert held["kind"] == "system" and held["rigid_modes"] == 0
    # The tines move against each other: no force on the handle, hence the same frequency free and held.
    hum = [f for f in frequencies(free) if abs(f - 440) < 5]
    assert len(hum) == 1
    assert numpy.min(numpy.abs(frequencies(held) - hum[0])) < 0.01 * hum[0]
    sums = numpy.sum([mode["effective_mass"] for mode in held["modes"]], axis=0)
    assert (sums < held["mass"]).all() and sums[0] > 0.5 * held["mass"]


def test_shapes_go_to_a_directory_that_can_be_viewed(buckens, tmp_path):
    result = buckens("modes", FORK, "--count", 4, "-o", "shapes").must(0)
    assert "buckens view shapes" in result.out and "440" in result.out
    report = buckens("modes", FORK, "--count", 4, "--json").must(0).json
    with h5py.File(tmp_path / "shapes" / "results.h5", "r", swmr=True) as file:
        assert file["modes/frequency"][:] == pytest.approx(frequencies(report["analyses"][0]))
        shape = file["bodies/fork/displacement"][:]
        assert shape.shape[0] == 4
        largest = numpy.linalg.norm(shape[:, :, :3], axis=2).max(axis=1)
        assert largest == pytest.approx(numpy.ones(4), rel=1e-12)
    assert (tmp_path / "shapes" / "modes.json").stat().st_size > 0
    # A run may reuse the directory; nothing of the modes remains.
    buckens("run", SOURCE / "tests" / "models" / "pendulum.yaml", "-o", "shapes").must(0)
    assert not (tmp_path / "shapes" / "modes.json").exists()


def test_small_motions_of_a_pendulum(buckens):
    model = SOURCE / "examples" / "pendulum" / "pendulum.yaml"

    def about(place):
        return buckens("modes", model, "--system", "--about", place, "--json").must(
            0).json["analyses"][0]

    assert about("initial")["rigid_modes"] == 1 and about("initial")["modes"] == []
    static = about("static")
    assert static["rigid_modes"] == 0 and len(static["modes"]) == 1
    exact = math.sqrt(1.5 * 9.81) / (2 * math.pi)  # uniform rod of 1 m about its end
    assert static["modes"][0]["frequency"] == pytest.approx(exact, rel=1e-8)


@pytest.mark.parametrize("arguments, code, words", [
    (["--body", "frok"], 2, ["--body", '"frok"', 'Did you mean "fork"?']),
    (["--count", "0"], 2, ["--count"]),
    (["--method", "guess"], 2, ["--method", "subspace"]),
    (["--about", "static"], 2, ["--about", "--system"]),
    (["--system", "--body", "fork"], 2, ["--system", "--body"]),
    (["--tolerance", "1"], 2, ["--tolerance"]),
    (["--threads", "0"], 2, ["--threads"]),
])
def test_errors_of_the_command_line(buckens, arguments, code, words):
    buckens("modes", FORK, *arguments).must(code, *words)


def test_rigid_bodies_have_no_free_vibrations(buckens, models):
    buckens("modes", models / "pendulum.yaml").must(3, "all bodies are rigid", "--system")


def test_thin_curved_shells_need_few_sweeps(buckens, tmp_path):
    """A wall of 0.5 mm, 0.6 m across: bends at 4 Hz, far below what smooth displacements would need."""
    n, m, radius, thickness, length = 80, 24, 0.3, 0.0005, 1.0
    deck = ["*NODE"]
    for j in range(m + 1):
        for i in range(n):
            angle = 2 * math.pi * i / n
            deck.append(f"{j * n + i + 1}, {radius * math.cos(angle)!r}, {radius * math.sin(angle)!r}, {length * j / m!r}")
    deck.append("*ELEMENT, TYPE=S3, ELSET=E")
    for k in range(n * m):
        a, b = k + 1, k - k % n + (k % n + 1) % n + 1
        deck += [f"{2 * k + 1}, {a}, {b}, {b + n}", f"{2 * k + 2}, {a}, {b + n}, {a + n}"]
    deck += ["*SHELL SECTION, ELSET=E, MATERIAL=M", f"{thickness}", "*MATERIAL, NAME=M", "*ELASTIC", "210e9, 0.3",
             "*DENSITY", "7850.", ""]
    (tmp_path / "tube.inp").write_text("\n".join(deck))
    (tmp_path / "tube.yaml").write_text(
        "buckens: 1\nbodies: {tube: {mesh: {file: tube.inp, length-unit: m, mass-unit: kg}}}\n")
    told = buckens("modes", "tube.yaml", "--count", 6, "--json").must(0).json["analyses"][0]
    # Rayleigh's motion without stretching, the same all along the tube, of two waves; it comes in pairs. The
    # polygon of flat triangles is off by (π/80)², a few times over; the ends let go of ν.
    lowest = 6 / math.sqrt(5) / (2 * math.pi) * math.sqrt(
        210e9 * thickness**2 / (12 * 7850 * (1 - 0.3**2) * radius**4))
    assert frequencies(told)[:2] == pytest.approx(lowest, rel=5e-3)
    # Before the shift was judged more than once: 212.
    assert told["work"]["sweeps"] < 40
    shared = buckens("modes", "tube.yaml", "--count", 6, "--threads", 2, "--json").must(0).json["analyses"][0]
    assert shared["modes"] == told["modes"]
