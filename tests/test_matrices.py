# SPDX-License-Identifier: Apache-2.0
"""Bodies from mass and stiffness matrices, through the program."""

import csv

import numpy
import pytest

from conftest import SOURCE

FOLDER = SOURCE / "examples" / "gyro_rotor"
GYROSCOPE = "gyro_rotor/gyro_rotor"

# The rotor of the example as Buckens assembles it itself.
BEAMS = """
buckens: 1
gravity: [0, 0, -9.81 m/s^2]
sections: {shaft: {circle: {diameter: 30 mm}}}
materials: {steel: {E: 210 GPa, nu: 0.3, rho: 7850 kg/m^3}}
bodies:
  rotor:
    structure:
      nodes: {n1: [0, 0, 0], n7: [150 mm, 0, 0], n9: [200 mm, 0, 0]}
      beams:
        - {between: [n1, n7], elements: 6, section: shaft, material: steel}
        - {between: [n7, n9], elements: 2, section: shaft, material: steel}
      masses:
        - {at: n7, mass: 2 kg, inertia: [10000e-6, 5016.6666666666667e-6, 5016.6666666666667e-6]}
"""


def columns(path):
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    table = numpy.array(rows[1:], dtype=float)
    return {name.split(" [")[0]: table[:, k] for k, name in enumerate(rows[0])}


@pytest.fixture
def rotor(tmp_path):
    """The files of the example in the directory of the test, for changes."""
    for name in ("rotor_mass.mtx", "rotor_stiffness.mtx", "rotor_nodes.csv", "gyro_rotor.yaml"):
        (tmp_path / name).write_text((FOLDER / name).read_text())
    return tmp_path


def frequencies(buckens, model, count=8):
    report = buckens("modes", model, "--count", count, "--json").must(0).json
    return numpy.array([mode["frequency"] for mode in report["analyses"][0]["modes"]])


def test_the_matrices_of_beams_give_the_body_of_the_beams(buckens, tmp_path):
    (tmp_path / "beams.yaml").write_text(BEAMS)
    own = frequencies(buckens, "beams.yaml")
    read = frequencies(buckens, FOLDER / "gyro_rotor.yaml")
    # Both are eigenvalues of the same matrices up to the rounding of 17 digits in the files.
    assert numpy.abs(read / own - 1).max() < 1e-8
    bodies = [buckens("check", model, "--json").must(0).json["bodies"]["rotor"]
              for model in ("beams.yaml", FOLDER / "gyro_rotor.yaml")]
    assert bodies[1]["mass"] == pytest.approx(bodies[0]["mass"], rel=1e-13)


def rigid_gyroscope(times, turn):
    """Place of the disc of a rigid rotor like that of the example: Euler's equations of the heavy
    symmetric top by Runge and Kutta, with the direction of the shaft and the angular momentum."""
    length, torque, along, spin = 0.13215674375, 4.0316820204, 0.01012484886, 300.0
    across = 0.010500217641 + 3.1097676048806 * length**2
    step = 1e-4

    def rate(state):
        shaft, momentum = state
        lengthwise = momentum @ shaft
        turning = (momentum - lengthwise * shaft) / across + lengthwise / along * shaft
        return numpy.array([numpy.cross(turning, shaft), numpy.cross(shaft, [0, 0, -torque])])

    state = numpy.array([[1.0, 0, 0], [along * spin, 0, across * turn * torque / (along * spin)]])
    places = []
    time = 0.0
    for end in times:
        while time < end - 1e-9:
            k1 = rate(state)
            k2 = rate(state + step / 2 * k1)
            k3 = rate(state + step / 2 * k2)
            state = state + step / 6 * (k1 + 2 * k2 + 2 * k3 + rate(state + step * k3))
            time += step
        places.append(0.15 * state[0])
    return numpy.array(places)


def test_the_gyroscope_precesses_steadily(buckens, tmp_path):
    buckens("run", FOLDER / "gyro_rotor.yaml", "-o", "out", "--quiet").must(0)
    run = columns(tmp_path / "out" / "sensors.csv")
    rate = 4.0316820204 / (0.01012484886 * 300)
    azimuth = numpy.unwrap(numpy.arctan2(run["disc.y"], run["disc.x"]))
    slope = numpy.polyfit(run["t"], azimuth, 1)[0]
    # Error of the method of second order: 2.3e-4 at 0.1 ms, 1.2e-3 at 0.25 ms.
    assert slope == pytest.approx(rate, rel=4e-4)
    # The shaft sags and swings by micrometres.
    assert numpy.abs(run["disc.z"]).max() < 1e-5
    assert numpy.abs(run["balance"]).max() < 1e-5


def test_a_gyroscope_let_go_nods(buckens, tmp_path):
    buckens("run", FOLDER / "gyro_rotor.yaml", "-o", "out", "--quiet", "--set", "parameters.turn=0",
            "--set", "simulation.duration=0.3 s", "--set", "output.every=2 ms").must(0)
    run = columns(tmp_path / "out" / "sensors.csv")
    expected = rigid_gyroscope(run["t"], 0.0)
    depth = -expected[:, 2].min()
    assert depth == pytest.approx(8.5e-3, rel=0.01)
    place = numpy.column_stack([run[f"disc.{axis}"] for axis in "xyz"])
    # The shaft is not rigid: the couple of the spinning disc bends it by I ω·l/(E I_b) of the nodding
    # rate, some thousandths, which are seen after two nods.
    assert numpy.abs(place - expected).max() < 0.02 * depth


def test_markers_and_interfaces_stand_on_numbered_nodes(buckens, rotor):
    text = (rotor / "gyro_rotor.yaml").read_text()
    (rotor / "other.yaml").write_text(text.replace(
        "    damping: {ratio", "    interfaces: {ends: {set: [n1, n2, n9]}}\n"
        "    markers: {end: {at: n9}}\n    damping: {ratio"))
    assert "forces" in buckens("check", "other.yaml").must(0).out
    (rotor / "rigid.yaml").write_text((rotor / "other.yaml").read_text().replace(
        "n9]}", "n9], kind: rigid}"))
    buckens("check", "rigid.yaml").must(2, "ends", "lie on one line")
    (rotor / "marker.yaml").write_text(text.replace(
        "    damping: {ratio", "    markers: {end: {position: [0.2, 0, 0]}}\n    damping: {ratio"))
    buckens("check", "marker.yaml").must(0)


@pytest.mark.parametrize("change, code, words", [
    (("stress", "pivot: {joint-force: pivot}", "pivot: {stress: rotor}"), 3,
     ["given by matrices", "neither stresses"]),
    (("frames", "    damping: {ratio", "    frames: 2\n    damping: {ratio"), 2,
     ["cannot be divided"]),
    (("missing", "rotor_mass.mtx", "rotor_mas.mtx"), 2, ["rotor_mas.mtx", "no such file"]),
    (("node", "rotor/n1", "rotor/n17"), 2, ["n17"]),
    (("swapped", "mass: rotor_mass.mtx, stiffness: rotor_stiffness.mtx",
      "mass: rotor_stiffness.mtx, stiffness: rotor_mass.mtx"), 3, ["mass"]),
    (("unit", "nodes: rotor_nodes.csv}", "nodes: rotor_nodes.csv, length-unit: ft, damping: x}"), 2,
     ["damping"]),
], ids=lambda value: value[0] if isinstance(value, tuple) else "")
def test_what_cannot_be_is_refused(buckens, rotor, change, code, words):
    _, old, new = change
    text = (rotor / "gyro_rotor.yaml").read_text()
    assert old in text
    (rotor / "model.yaml").write_text(text.replace(old, new))
    buckens("check", "model.yaml").must(code, *words)


def test_a_held_body_is_refused_with_the_direction(buckens, rotor):
    lines = (rotor / "rotor_stiffness.mtx").read_text().splitlines()
    row = next(k for k, line in enumerate(lines) if line.startswith("3 3 "))
    lines[row] = f"3 3 {float(lines[row].split()[2]) + 1e5:.16e}"
    (rotor / "rotor_stiffness.mtx").write_text("\n".join(lines) + "\n")
    buckens("check", "gyro_rotor.yaml").must(3, "resists the rigid displacement along z", "n1")


def test_a_mechanism_is_refused(buckens, rotor):
    # Without the stiffness of the last element its node is unconnected.
    lines = (rotor / "rotor_stiffness.mtx").read_text().splitlines()
    head, entries = lines[:3], lines[3:]
    from_49 = [line for line in entries if int(line.split()[0]) < 49]
    head[2] = f"54 54 {len(from_49)}"
    (rotor / "rotor_stiffness.mtx").write_text("\n".join(head + from_49) + "\n")
    result = buckens("check", "gyro_rotor.yaml")
    assert result.code in (3, 4), result.err
    assert "stiffness matrix" in result.err


def test_the_run_has_a_page_and_reduced_bodies_work(buckens, rotor):
    buckens("run", "gyro_rotor.yaml", "-o", "out", "--quiet", "--set", "bodies.rotor.reduction.free-free=4",
            "--set", "simulation.duration=0.02 s").must(0)
    buckens("view", "out", "-o", "page.html").must(0)
    assert (rotor / "page.html").stat().st_size > 100000
