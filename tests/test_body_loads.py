# SPDX-License-Identifier: Apache-2.0
"""Loads on bodies through the program: pressure, traction, line loads, body forces, base
acceleration against exact solutions; reduction, frames, statics, counts of solves."""

import csv
import json
import math
import pathlib
import sys

import numpy
import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent / "support"))
from loaded_bodies import (AREA, B, E, FLYING, HELD, INERTIA, L, RHO, SIDE, SKIN, bar, check,  # noqa: E402, F401
                           rod, sensors, vector)

# ---- exact solutions


@pytest.mark.parametrize("kind", ["hex8", "hex20", "tet4", "tet10"])
@pytest.mark.parametrize("load", ["traction: {on: bar/x1, value: [10 MPa, 0, 0]}",
                                  "pressure: {on: bar/tip, value: -10 MPa}"])
def test_a_bar_under_end_traction_stretches_exactly(sensors, kind, load):
    """Without lateral contraction the stress is uniform: every element represents the exact solution."""
    out = sensors(bar(f"  pull: {{{load}}}\n", kind=kind))
    # The static equilibrium is found to 1e-9 of the force.
    assert out["tip.x"][0] - L == pytest.approx(1e7 * L / E, rel=1e-8)
    assert vector(out, "tip")[1:] == pytest.approx([0, 0], abs=1e-12)
    assert vector(out, "wall") == pytest.approx([-1e7 * AREA, 0, 0], rel=1e-8, abs=1e-4)
    # A run started in equilibrium stays there.
    assert numpy.ptp(out["tip.x"]) < 1e-12


@pytest.mark.parametrize("axes", ["fixed", "following"])
def test_a_cantilever_under_a_line_load_bends_exactly(sensors, axes):
    """Cubic elements with consistent end moments are exact at the nodes: q L⁴ / 8 E I."""
    load = f"  snow: {{line-load: {{on: rod, value: [0, 0, -500 N/m], axes: {axes}}}}}\n"
    out = sensors(rod(load))
    # The body frame turns by 1e-4, and its deflection moves the load by as much.
    assert out["tip.z"][0] == pytest.approx(-500 * L**4 / (8 * E * INERTIA), rel=1e-6)
    assert vector(out, "wall") == pytest.approx([0, 0, 500], abs=0.1)
    assert abs(out["hold.y"][0]) == pytest.approx(250, rel=1e-6)


def test_a_beam_of_a_structure_takes_a_line_load_by_its_number(sensors):
    text = """
buckens: 1
bodies:
  rod:
    structure:
      nodes: {a: [0, 0, 0], b: [0.5 m, 0, 0], c: [1 m, 0, 0]}
      beams:
        - {between: [a, b], elements: 2, section: {rectangle: {width: 0.1 m, height: 0.1 m}}, material: steel}
        - {between: [b, c], elements: 2, section: {rectangle: {width: 0.1 m, height: 0.1 m}}, material: steel}
materials: {steel: {E: 2.1e11 Pa, nu: 0.3, rho: 7850 kg/m^3}}
loads:
  snow: {line-load: {on: rod/2, value: [0, 0, -800 N/m]}}
"""
    text += HELD.replace("ROOT", "rod/a").replace("TIP", "rod/c")
    out = sensors(text)
    # Load on the outer half: tip 41 q L⁴ / 384 E I.
    assert out["tip.z"][0] == pytest.approx(-41 * 800 / (384 * E * INERTIA), rel=1e-6)
    assert abs(out["hold.y"][0]) == pytest.approx(0.75 * 400, rel=1e-6)


TUBE = """
buckens: 1
bodies:
  pipe:
    mesh: {tube: {to: [0, 0, 50 mm], outer-diameter: 0.2 m, inner-diameter: 0.1 m, divisions: [RADIAL, AROUND, 1], element: hex20}, material: {E: 2.1e11 Pa, nu: 0.3, rho: 7850 kg/m^3}}
    interfaces: {foot: {face: bottom}}
    markers:
      bore: {position: [50 mm, 0, 0]}
      rim: {position: [0.1 m, 0, 0]}
joints:
  wall: {fixed: {between: [ground, pipe/foot]}}
loads:
  gas: {pressure: {on: pipe/inner, value: 100 MPa}}
initial: {start: static}
simulation: {duration: 1 ms, step: 0.1 ms}
output:
  every: 1 ms
  sensors:
    bore: {deflection: {of: pipe/bore, from: frame}}
    rim: {deflection: {of: pipe/rim, from: frame}}
    hold: {joint-force: wall}
"""


def test_a_pressurised_cylinder_converges_to_lame(sensors):
    a, b, p, nu = 0.05, 0.1, 1e8, 0.3

    def lame(r):  # ends free: plane stress
        return p * a**2 / (E * (b**2 - a**2)) * ((1 - nu) * r + (1 + nu) * b**2 / r)

    errors = []
    for radial, around in ((1, 8), (3, 16)):
        out = sensors(TUBE.replace("RADIAL", str(radial)).replace("AROUND", str(around)))
        errors.append([abs(out["bore.x"][0] / lame(a) - 1), abs(out["rim.x"][0] / lame(b) - 1)])
        # The joint carries no load: the resultant of the pressure is zero.
        assert numpy.abs(vector(out, "hold")).max() < 1e-3
    assert max(errors[1]) < 1e-3
    # Quadratic elements, three across instead of one: third order gives a factor of 27.
    assert max(errors[1]) < max(errors[0]) / 20


SQUEEZED = """
initial: {start: as-given}
simulation: {duration: 2 ms, step: 0.1 ms}
output:
  every: 1 ms
  sensors:
    corner: {deflection: {of: bar/corner_111, from: frame}}
    place: {position: bar}
    spin: {angular-velocity: bar}
    force: {load-force: gas}
    torque: {load-torque: {load: gas, about: bar}}
"""


@pytest.mark.parametrize("kind", ["hex8", "tet10"])
def test_pressure_all_around_has_no_resultant_and_squeezes_evenly(sensors, check, kind):
    text = bar("  gas: {pressure: {on: bar/skin, value: 100 MPa}}\n", SQUEEZED, kind, nu=0.3)
    text = text.replace("    interfaces:\n", "    flexibility: quasi-static\n    interfaces:\n")
    text = text.replace("root: {face: x0, kind: rigid}", "root: {face: x0}")
    report = check(text)["distributed_loads"]["gas"]
    assert report["extent"] == pytest.approx(4 * L * B + 2 * AREA, rel=1e-12)
    assert report["unit"] == "m^2"
    # Areas add up to 0.4 m², 4e7 N: rounding.
    assert numpy.abs(report["force"]).max() < 1e-6
    assert numpy.abs(report["torque"]).max() < 1e-6
    out = sensors(text)
    squeeze = -1e8 * (1 - 2 * 0.3) / E
    expected = squeeze * numpy.array([L / 2, B / 2, B / 2])
    assert vector(out, "corner") == pytest.approx(expected, rel=1e-8)
    for row in range(len(out["place.x"])):
        assert vector(out, "place", row) == pytest.approx([L / 2, 0, 0], abs=1e-12)
        assert numpy.abs(vector(out, "spin", row)).max() < 1e-9
        assert numpy.abs(vector(out, "force", row)).max() < 1e-6


# ---- free flight


@pytest.mark.parametrize("load", [
    "body-force: {on: bar, per-mass: [3, 0, -9.81 m/s^2]}",
    "base-acceleration: {value: [-3, 0, 9.81 m/s^2]}",
])
@pytest.mark.parametrize("kind", ["hex8", "tet10"])
def test_a_uniform_acceleration_never_excites_the_mesh(sensors, load, kind):
    out = sensors(bar(f"  fall: {{{load}}}\n", FLYING, kind, 0.3))
    for row, t in enumerate(out["t"]):
        expected = [L / 2 + 1.5 * t**2, 0, -0.5 * 9.81 * t**2]
        assert vector(out, "place", row) == pytest.approx(expected, abs=1e-12)
        assert numpy.array_equal(vector(out, "bend", row), numpy.zeros(3))


def test_gravity_and_weight_by_elements_leave_an_unsupported_body_undeformed(sensors):
    """Nodal weights of all elements together lie in the span of P: what the sieve leaves is
    rounding of 0.6 kN over the stiffness of the bar."""
    load = "  fall: {body-force: {on: bar, per-volume: [0, 0, -77 kN/m^3]}}\n"
    out = sensors(bar(load, FLYING, "hex8", 0.3))
    bend = max(numpy.abs(out[f"bend.{a}"]).max() for a in "xyz")
    assert bend < 1e-18 * 77e3
    gravity = sensors(bar(load, FLYING, "hex8", 0.3), "--set", "gravity=[0, 0, -9.81]")
    assert max(numpy.abs(gravity[f"bend.{a}"]).max() for a in "xyz") < 1e-18 * 77e3
    beam = rod("  fall: {base-acceleration: {value: [\"3*sin(400*t)\", 0, \"9*t/0.005\"]}}\n",
               FLYING.replace("bar/corner_111", "rod/end").replace("bar", "rod"))
    beam = sensors(beam, "--set", "gravity=[0, -9.81, 0]")
    assert max(numpy.abs(beam[f"bend.{a}"]).max() for a in "xyz") == 0.0


def test_a_free_body_under_uniform_traction_accelerates_as_a_rigid_one(sensors, check):
    text = bar("  push: {traction: {on: bar/x1, value: [0, 2 MPa, 0]}}\n", FLYING, "hex8", 0.3)
    report = check(text)["distributed_loads"]["push"]
    assert report["force"] == pytest.approx([0, 2e6 * AREA, 0], rel=1e-12, abs=1e-6)
    assert report["torque"] == pytest.approx([0, 0, 2e6 * AREA * L / 2], rel=1e-12, abs=1e-6)
    out = sensors(text)
    mass = RHO * AREA * L
    for row, t in enumerate(out["t"]):
        # Linear momentum is exact: constant force, constant acceleration.
        expected = [L / 2, 0.5 * 2e6 * AREA / mass * t**2, 0]
        assert vector(out, "place", row) == pytest.approx(expected, abs=1e-11)
    # The mean rotation is that of the rigid body; bending, 1e-3 of the length, changes its inertia
    # and the lever arm by less.
    J = mass * (L**2 + B**2) / 12
    assert out["spin.z"][-1] == pytest.approx(2e6 * AREA * L / 2 / J * 5e-3, rel=2e-3)
    assert out["work"][-1] > 100


@pytest.mark.parametrize("load", [
    "pressure: {on: bar/z1, value: \"4e6*sin(600*t)^2\"}",
    "traction: {on: bar/x1, value: [0, \"2e6*sin(600*t)^2\", 0], axes: following}",
])
def test_the_work_of_following_loads_closes_the_energy_balance(sensors, load):
    """The error of the balance is that of the time steps and falls with their square."""
    text = bar(f"  push: {{{load}}}\n", FLYING, "hex8", 0.3)
    errors = []
    for step in ("0.04 ms", "0.02 ms"):
        out = sensors(text, "--set", f"simulation.step={step}", "--set", "simulation.method=newmark")
        errors.append(numpy.abs(out["balance"]).max() / numpy.abs(out["work"]).max())
    assert errors[1] < 0.4 * errors[0] or errors[1] < 1e-9
    assert errors[1] < 1e-3


# ---- reduction, frames, statics

TORSO = """
joints:
  wall: {fixed: {between: [ground, bar/root]}}
initial: {start: static}
simulation: {duration: 2 ms, step: 0.02 ms}
output:
  every: 0.5 ms
  sensors:
    tip: {deflection: {of: bar/corner_111, from: frame}}
    wall: {joint-force: wall}
"""


@pytest.mark.parametrize("reduction", ["{free-free: 6}", "{craig-bampton: {modes: 4}}"])
@pytest.mark.parametrize("interface", ["rigid", "average"])
def test_a_reduced_body_answers_slow_distributed_loads_like_the_full_one(sensors, reduction, interface):
    text = bar(SIDE, TORSO, "hex8", 0.3).replace("kind: rigid", f"kind: {interface}")
    full = sensors(text)
    reduced = sensors(text, "--set", f"bodies.bar.reduction={reduction}")
    # The responses to the load patterns are in the basis, so the equilibrium is that of the mesh. What
    # remains, 1e-8 of the deflection, scales with its square: the load turns with the held end.
    whole = numpy.linalg.norm(vector(full, "tip"))
    assert vector(reduced, "tip") == pytest.approx(vector(full, "tip"), abs=1e-7 * whole)
    assert vector(reduced, "wall") == pytest.approx(vector(full, "wall"), rel=1e-6, abs=1e-3)


def test_without_static_correction_something_is_missing(sensors):
    text = bar(SIDE, TORSO, "hex8", 0.3)
    full = sensors(text)
    reduced = sensors(text, "--set",
                      "bodies.bar.reduction={craig-bampton: {modes: 4, static-correction: off}}")
    error = numpy.abs(vector(reduced, "tip") / vector(full, "tip") - 1)[1:].max()
    assert 1e-6 < error < 0.05


def test_a_divided_body_takes_the_same_loads(sensors):
    average = bar(SIDE, TORSO, "hex8", 0.3).replace("kind: rigid", "kind: average")
    average = average.replace("1 MPa", "50 kPa").replace(SKIN, "").replace("{deflection: {of: bar/corner_111, from: frame}}",
                              "{position: bar/corner_111}")
    one = sensors(average)
    two = sensors(average, "--set", "bodies.bar.frames=2")
    # Deflections of 4e-4 of the length: frames differ by their squares.
    assert vector(two, "tip") == pytest.approx(vector(one, "tip"), abs=1e-7)
    load = "  snow: {line-load: {on: rod, value: [0, 0, -500 N/m]}}\n"
    ends = [sensors(rod(load), "--set", f"bodies.rod.frames={k}")["tip.z"][0] for k in (1, 2, 4)]
    assert ends[1:] == pytest.approx([ends[0]] * 2, rel=1e-6)


def test_the_load_factor_multiplies_distributed_loads(buckens, tmp_path):
    text = bar("  pull: {pressure: {on: bar/x1, value: -10 MPa}}\n")
    (tmp_path / "model.yaml").write_text(text + "static: {load-factor: [0, 2], steps: 4}\n")
    buckens("static", "model.yaml", "-o", "out").must(0)
    rows = list(csv.reader((tmp_path / "out" / "sensors.csv").open()))
    column = next(i for i, name in enumerate(rows[0]) if name.startswith("tip.x"))
    factor = next(i for i, name in enumerate(rows[0]) if name.startswith("load-factor"))
    for row in rows[1:]:
        stretch = float(row[column]) - L
        assert stretch == pytest.approx(float(row[factor]) * 1e7 / E, rel=1e-7, abs=1e-13)


def test_a_base_that_accelerates_shakes_an_oscillator(sensors):
    """m ẍ + k x = −m a(t), from rest: x = A (sin Ωt − Ω/ω sin ωt) with A = −a/(ω² − Ω²)."""
    out = sensors("""
buckens: 1
bodies: {cart: {rigid: {mass: 2 kg, inertia: [1, 1, 1]}}}
joints: {rail: {prismatic: {between: [ground, cart], axis: [1, 0, 0]}}}
loads:
  spring: {spring-damper: {between: [{ground: [-1 m, 0, 0]}, cart], stiffness: 800 N/m}}
  shake: {base-acceleration: {value: ["5*sin(30*t) m/s^2", 0, 0]}}
simulation: {duration: 1 s, step: 0.2 ms, method: newmark}
output:
  every: 10 ms
  sensors:
    x: {position: cart}
    push: {load-force: shake}
    balance: {energy: balance}
""")
    w, W, t = math.sqrt(400.0), 30.0, out["t"]
    x = -5 / (w**2 - W**2) * (numpy.sin(W * t) - W / w * numpy.sin(w * t))
    # Newmark shifts the frequency by (ωh)²/24 = 7e-7, 2e-5 rad over the run.
    assert numpy.abs(out["x.x"] - x).max() < 5e-5 * numpy.abs(x).max()
    assert numpy.abs(out["push.x"] + 10 * numpy.sin(W * t)).max() < 1e-9
    assert numpy.abs(out["balance"]).max() < 1e-5


# ---- counts

PATTERNS = {
    "  gas: {pressure: {on: bar/x1, value: \"1e6*sin(900*t)\"}}\n": 1,
    "  wind: {traction: {on: bar/z1, value: [\"1e4*t\", 0, 2 kPa]}}\n": 3,
    "  drag: {traction: {on: bar/y0, value: [0, 1 kPa, 0], axes: following}}\n": 3,
    "  field: {body-force: {on: bar, per-volume: [0, \"5e3*cos(70*t)\", 0]}}\n": 3,
    "  fall: {body-force: {on: bar, per-mass: [0, 0, -9.81]}}\n": 0,
    "  shake: {base-acceleration: {value: [\"5*sin(30*t)\", 0, 0]}}\n": 0,
}


@pytest.mark.parametrize("coupling", ["none", "first-order"])
def test_loads_are_columns_made_once_and_steps_keep_their_one_solve(buckens, tmp_path, coupling):
    def run(loads):
        (tmp_path / "model.yaml").write_text(bar("".join(loads), FLYING, "hex8", 0.3))
        buckens("run", "model.yaml", "-o", "out", "--set", f"bodies.bar.coupling={coupling}").must(0)
        return json.loads((tmp_path / "out" / "summary.json").read_text())

    # One force, so that the list of loads is never empty; it needs three columns.
    force = "  push: {force: {on: bar/corner_000, value: [1, 0, 0]}}\n"
    bare = run([force])
    for loads in [[load] for load in PATTERNS] + [list(PATTERNS)]:
        summary = run([force] + loads)
        body = summary["bodies"]["bar"]
        assert body["factorisations"] == 1
        assert body["solves"] == summary["steps"] == 100, loads
        columns = sum(PATTERNS[load] for load in loads)
        # Generalised-alpha solves for each column a second time, for position corrections.
        assert summary["setup_solves"] - bare["setup_solves"] == 2 * columns, loads
