# SPDX-License-Identifier: Apache-2.0
"""Bodies without rotary inertia that joints turn all the same."""

import csv
import json
import math

import pytest

HEAD = "buckens: 1\ngravity: [0, -9.81, 0]\n"
G = 9.81


@pytest.fixture
def run(buckens, tmp_path):
    def call(text, *options):
        (tmp_path / "model.yaml").write_text(text)
        return buckens("run", "model.yaml", "-o", tmp_path / "out", *options)

    return call


def records(tmp_path):
    with open(tmp_path / "out" / "sensors.csv") as file:
        rows = list(csv.reader(file))
    return rows[0], [[float(x) for x in row] for row in rows[1:]]


def swing(angle, duration, length=1.0, steps=20000):
    """Angle from the vertical of a mathematical pendulum after `duration`, by Runge and Kutta's method."""
    h, x, v = duration / steps, angle, 0.0

    def a(x):
        return -G / length * math.sin(x)

    for _ in range(steps):
        k1, l1 = v, a(x)
        k2, l2 = v + h / 2 * l1, a(x + h / 2 * k1)
        k3, l3 = v + h / 2 * l2, a(x + h / 2 * k2)
        k4, l4 = v + h * l3, a(x + h * k3)
        x, v = x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4), v + h / 6 * (l1 + 2 * l2 + 2 * l3 + l4)
    return x


JOINTS = {
    "planar": ("planar: xy\n", "revolute: {between: [ground, bob/origin]}"),
    "revolute": ("", "revolute: {between: [ground, bob/origin], axis: [0, 0, 1]}"),
    "spherical": ("", "spherical: {between: [ground, bob/origin]}"),
}


def pendulum(kind, simulation):
    head, joint = JOINTS[kind]
    return (HEAD + head + "bodies: {bob: {rigid: {mass: 1, com: [0, -1, 0]}, at: {orientation: {axis: [0, 0, 1], "
            "angle: 90 deg}}}}\n" + f"joints: {{pin: {{{joint}}}}}\n" + f"simulation: {simulation}\n" +
            "output: {every: 0.1 s, sensors: {bob: {position: bob}, pin: {joint-force: pin}, "
            "balance: {energy: balance}}}\n")


@pytest.mark.parametrize("kind", JOINTS)
def test_a_point_mass_swings_with_the_exact_period(run, tmp_path, kind):
    errors = []
    for step in ("2 ms", "1 ms"):
        run(pendulum(kind, f"{{duration: 2 s, step: {step}, rho-inf: 1}}")).must(0)
        header, rows = records(tmp_path)
        x, y = rows[-1][header.index("bob.x [m]")], rows[-1][header.index("bob.y [m]")]
        angle = swing(math.pi / 2, 2.0)
        assert math.hypot(x, y) == pytest.approx(1.0, abs=1e-12)
        errors.append(math.hypot(x - math.sin(angle), y + math.cos(angle)))
        # m l θ'² + m g cos θ along the rod: 3 m g cos θ from rest at the horizontal.
        force = math.hypot(rows[-1][header.index("pin.x [N]")], rows[-1][header.index("pin.y [N]")])
        assert force == pytest.approx(3 * G * abs(y), abs=2e-3)
    # The error of the method, (ωh)²/12 a radian of phase, and nothing else: order two.
    assert errors[1] < 2e-5
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.05)
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["trust"] == "ok"
    assert summary["newton_iterations"]["per_step_mean"] < 10


def test_a_conical_pendulum_keeps_its_cone(run, tmp_path):
    alpha = 0.6
    spin = math.sqrt(G / math.cos(alpha))
    x, y = math.sin(alpha), -math.cos(alpha)
    run(HEAD + f"bodies: {{bob: {{rigid: {{mass: 2, com: [{x}, {y}, 0]}}}}}}\n"
        "joints: {pin: {spherical: {between: [ground, bob/origin]}}}\n"
        f"initial: {{bodies: {{bob: {{velocity: [0, 0, {-spin * x}], angular-velocity: [0, {spin}, 0]}}}}}}\n"
        "simulation: {duration: 2 s, step: 1 ms}\n"
        "output: {every: 50 ms, sensors: {bob: {position: bob}}}\n").must(0)
    header, rows = records(tmp_path)
    for row in rows:
        t, px, py, pz = row[:4]
        assert py == pytest.approx(y, abs=1e-5)
        assert px == pytest.approx(x * math.cos(spin * t), abs=1e-4)
        assert pz == pytest.approx(-x * math.sin(spin * t), abs=1e-4)


def test_modes_of_a_double_point_pendulum(buckens, tmp_path):
    """Equal masses and lengths: ω² = (2 ∓ √2) g/l."""
    (tmp_path / "model.yaml").write_text(
        HEAD + "planar: xy\nbodies:\n"
        "  upper: {rigid: {mass: 1, com: [0, -1, 0]}}\n"
        "  lower: {rigid: {mass: 1, com: [0, -1, 0]}, at: {position: [0, -1, 0]}}\n"
        "joints:\n"
        "  top: {revolute: {between: [ground, upper/origin]}}\n"
        "  middle: {revolute: {between: [upper/com, lower/origin]}}\n"
        "simulation: {duration: 0.1 s, step: 1 ms}\n")
    found = buckens("modes", "model.yaml", "--system", "--about", "static", "--json").must(0).json
    frequencies = [mode["frequency"] for mode in found["analyses"][0]["modes"]]
    exact = [math.sqrt((2 - s * math.sqrt(2)) * G) / (2 * math.pi) for s in (1, -1)]
    assert frequencies == pytest.approx(exact, rel=1e-7)


def test_a_force_beside_a_free_point_mass_is_refused(run):
    run(HEAD + "bodies: {bob: {rigid: {mass: 1}, markers: {side: {position: [0.1, 0, 0]}}}}\n"
        "loads: {push: {force: {on: bob/side, value: [0, 1, 0]}}}\n"
        "simulation: {duration: 1 s, step: 1 ms}\n").must(3, '"push"', '"bob"', "no rotary inertia", "inertia")


def test_a_torque_on_a_free_point_mass_is_refused(run):
    run(HEAD + "bodies: {bob: {rigid: {mass: 1}}}\n"
        'loads: {turn: {torque: {on: bob, value: [0, "(t > 0.4 ? 1 : 0) N m", 0]}}}\n'
        "simulation: {duration: 1 s, step: 1 ms}\n").must(3, '"turn"', '"bob"', "no rotary inertia")


def test_a_clamped_wire_without_inertia_about_its_axis_is_refused(buckens, tmp_path):
    # About its axis a round wire has 3/2 (d/L)^2 of its inertia across: below 1e-10 with d = 50 um and L = 10 m.
    text = (HEAD + "bodies:\n  wire: {beam: {to: [10 m, 0, 0], elements: 2, section: {circle: {diameter: 50 um}}, "
            "material: {E: 200 GPa, nu: 0.3, rho: 7850}}}\n"
            "joints:\n  wall: {KIND: {between: [ground, wire/start]}}\n"
            "simulation: {duration: 1 ms, step: 1 ms}\n")
    (tmp_path / "model.yaml").write_text(text.replace("KIND", "fixed"))
    buckens("check", "model.yaml").must(3, "joint \"wall\" turns body \"wire\" about (1, 0, 0)", "no rotary inertia",
                                        "leaves this rotation free")
    # As it advises: a joint that leaves the rotation free; the frame then does not turn about the axis.
    (tmp_path / "model.yaml").write_text(text.replace("KIND", "spherical"))
    assert "does not turn about this axis" in buckens("check", "model.yaml").must(0).out


def test_a_spring_at_the_mass_centre_is_fine(run, tmp_path):
    run(HEAD + "bodies: {bob: {rigid: {mass: 1}, at: {position: [0, -1, 0]}}}\n"
        "loads: {spring: {spring-damper: {between: [ground, bob], stiffness: 400}}}\n"
        "simulation: {duration: 0.1 s, step: 1 ms}\n"
        "output: {every: 50 ms, sensors: {bob: {position: bob}}}\n").must(0)
    _, rows = records(tmp_path)
    assert rows[-1][2] == pytest.approx(-1 - G / 400 * (1 - math.cos(2.0)), abs=1e-5)
