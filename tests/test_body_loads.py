# SPDX-License-Identifier: Apache-2.0
"""Loads on bodies through the program: pressure, traction, line loads, body forces, base
acceleration against exact solutions; reduction, frames, statics, tables, reports, errors."""

import csv
import itertools
import math

import h5py
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


# ---- exact solutions


@pytest.mark.parametrize("kind", ["hex8", "hex20", "tet4", "tet10"])
@pytest.mark.parametrize("load", ["traction: {on: bar/x1, value: [10 MPa, 0, 0]}",
                                  "pressure: {on: bar/tip, value: -10 MPa}"])
def test_a_bar_under_end_traction_stretches_exactly(sensors, kind, load):
    """Without lateral contraction the stress is uniform: every element has the exact solution."""
    out = sensors(bar(f"  pull: {{{load}}}\n", kind=kind))
    # The static equilibrium is found to 1e-9 of the force.
    assert out["tip.x"][0] - L == pytest.approx(1e7 * L / E, rel=1e-8)
    assert vector(out, "tip")[1:] == pytest.approx([0, 0], abs=1e-12)
    assert vector(out, "wall") == pytest.approx([-1e7 * AREA, 0, 0], rel=1e-8, abs=1e-4)
    # A run from the equilibrium stays there.
    assert numpy.ptp(out["tip.x"]) < 1e-12


@pytest.mark.parametrize("axes", ["fixed", "following"])
def test_a_cantilever_under_a_line_load_bends_exactly(sensors, axes):
    """Cubic elements with consistent end moments are exact at the nodes: q L⁴ / 8 E I."""
    load = f"  snow: {{line-load: {{on: rod, value: [0, 0, -500 N/m], axes: {axes}}}}}\n"
    out = sensors(rod(load))
    # The body frame turns by 1e-4, and its sagging moves the load by as much.
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
        # The joint holds nothing: the resultant of the pressure is zero.
        assert numpy.abs(vector(out, "hold")).max() < 1e-3
    assert max(errors[1]) < 1e-3
    # Quadratic elements, three across in place of one: third order makes it 27.
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
SIDE = "  wind: {pressure: {on: bar/z1, value: 1 MPa}}\n  drag: {traction: {on: bar/y0, value: [0, 1 MPa, 0]}}\n"


@pytest.mark.parametrize("reduction", ["{free-free: 6}", "{craig-bampton: {modes: 4}}"])
@pytest.mark.parametrize("interface", ["rigid", "average"])
def test_a_reduced_body_answers_slow_distributed_loads_like_the_full_one(sensors, reduction, interface):
    text = bar(SIDE, TORSO, "hex8", 0.3).replace("kind: rigid", f"kind: {interface}")
    full = sensors(text)
    reduced = sensors(text, "--set", f"bodies.bar.reduction={reduction}")
    # The answers to the load patterns are in the basis, so the equilibrium is that of the mesh. What
    # stays, 1e-8 of the deflection, goes with its square: the load turns with the held end.
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


# ---- tables

RAMP = "  gas: {pressure: {on: bar/x1, value: VALUE}}\n"


def test_tables_and_expressions_are_the_same_load(sensors, tmp_path):
    (tmp_path / "gas.csv").write_text("time,pressure\n0,0\n2.5e-3,1000\n5e-3,2000\n")
    flying = FLYING.replace("sensors:", "sensors:\n    force: {load-force: gas}")
    values = ["\"4e8*t\"", "{table: [[0, 0], [5e-3, 2e6]]}",
              "{table: gas.csv, unit: kPa}", "{file: gas.csv, unit: kPa}",
              "{table: gas.csv, unit: kPa, interpolation: spline}"]
    runs = [sensors(bar(RAMP.replace("VALUE", value), flying)) for value in values]
    assert runs[0]["force.x"][-1] == pytest.approx(-2e6 * AREA, rel=1e-12)
    for run in runs[1:]:
        # A wave of 1e-5 m after 100 steps, each with rounding.
        assert numpy.abs(run["bend.x"] - runs[0]["bend.x"]).max() < 1e-15
        assert numpy.abs(run["place.x"] - runs[0]["place.x"]).max() < 1e-13


def test_a_spline_passes_through_its_points(sensors, tmp_path):
    times = numpy.linspace(0, 5e-3, 6)
    (tmp_path / "gas.csv").write_text("".join(f"{t!r};{1e6 * math.sin(300 * t)!r}\n" for t in times.tolist()))
    flying = FLYING.replace("sensors:", "sensors:\n    force: {load-force: gas}")
    out = sensors(bar(RAMP.replace("VALUE", "{table: gas.csv, interpolation: spline}"), flying))
    expected = -1e6 * AREA * numpy.sin(300 * times)
    assert out["force.x"] == pytest.approx(expected, rel=1e-6, abs=1e-6)


def test_a_table_is_not_extrapolated_unless_asked_for(buckens, tmp_path, sensors):
    short = bar(RAMP.replace("VALUE", "{table: [[0, 0], [4 ms, 2 MPa]]}"), FLYING)
    short = short.replace("4 ms", "4e-3").replace("2 MPa", "2e6")
    (tmp_path / "model.yaml").write_text(short)
    line = next(i for i, row in enumerate(short.split("\n"), 1) if "table:" in row)
    buckens("run", "model.yaml", "-o", "out").must(
        2, f"model.yaml:{line}:", "from t = 0 s to 0.004 s", "0 to 0.005 s", "extrapolation: hold")
    late = short.replace("[0, 0]", "[1e-3, 0]").replace("4e-3", "9e-3")
    (tmp_path / "model.yaml").write_text(late)
    buckens("check", "model.yaml").must(2, "from t = 0.001 s", "extrapolation: hold")
    held = short.replace("2e6]]", "2e6]], extrapolation: hold")
    out = sensors(held.replace("sensors:", "sensors:\n    force: {load-force: gas}"))
    assert out["force.x"][-2:] == pytest.approx([-2e6 * AREA] * 2, rel=1e-12)
    # Driven joints have tables, too.
    (tmp_path / "model.yaml").write_text("""
buckens: 1
bodies: {wheel: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}}}
joints: {motor: {prescribed-rotation: {between: [ground, wheel], axis: [0, 0, 1], angle: {table: [[0, 0], [1, 1]]}}}}
simulation: {duration: 2 s, step: 10 ms}
""")
    buckens("run", "model.yaml", "-o", "out").must(2, "model.yaml:4:", "0 to 2 s")


def test_wilsons_method_looks_beyond_the_end_of_a_run(buckens, tmp_path):
    """It evaluates loads at t + 1.4 h: a table that ends with the run says so when it is reached."""
    text = bar(RAMP.replace("VALUE", "{table: [[0, 0], [5e-3, 2e6]]}"), FLYING)
    (tmp_path / "model.yaml").write_text(text.replace("step: 0.05 ms", "step: 0.05 ms, method: wilson"))
    buckens("run", "model.yaml", "-o", "out").must(4, "load \"gas\"", "extrapolation: hold")


# ---- what is recorded


def test_loads_and_their_values_are_in_the_run_directory(buckens, tmp_path):
    loads = """  gas: {pressure: {on: bar/x1, value: "1e6*t"}}
  wind: {traction: {on: bar/y0, value: [0, "2e3*t", 0], axes: following}}
  shake: {base-acceleration: {value: [0, 0, 1]}}
  push: {force: {on: bar/corner_000, value: [1, 0, 0]}}
"""
    (tmp_path / "model.yaml").write_text(bar(loads, FLYING))
    buckens("run", "model.yaml", "-o", "out").must(0)
    with h5py.File(tmp_path / "out" / "results.h5") as file:
        group = file["geometry/loads"]
        gas = group["gas"]
        assert sorted(group) == ["gas", "push", "shake", "wind"]
        assert (gas.attrs["kind"], gas.attrs["body"], gas.attrs["unit"]) == ("pressure", "bar", "Pa")
        assert gas.attrs["follows"] == 1 and group["shake"].attrs["follows"] == 0
        positions = gas["positions"][:]
        assert len(positions) == 4
        assert positions[:, 0] == pytest.approx([L / 2] * 4)
        assert gas["directions"][:] == pytest.approx(numpy.array([[-1.0, 0, 0]] * 4))
        nodes = file["geometry/bodies/bar/nodes"][:]
        assert numpy.linalg.norm(nodes[gas["nodes"][0]] - positions[0]) < B
        assert "directions" not in group["wind"]
        assert group["push"]["positions"][:] == pytest.approx(numpy.array([[-L / 2, -B / 2, -B / 2]]))
        t = file["time"][:] if "time" in file else file["times"][:]
        value = file["loads/gas/value"]
        assert value[:] == pytest.approx(1e6 * t)
        assert file["loads/wind/value"][:, 1] == pytest.approx(2e3 * t)


def test_the_report_lists_distributed_loads(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(bar(SIDE, FLYING))
    out = buckens("check", "model.yaml").must(0).out
    assert "wind" in out and "pressure" in out and "bar/z1" in out and "0.1 m^2" in out
    assert "0, 0, -1e+05" in out and "0, 1e+05, 0" in out


# ---- errors


@pytest.mark.parametrize("load, words", [
    ("pressure: {on: bar/x3, value: 1 MPa}", ["no face \"x3\"", "Did you mean"]),
    ("pressure: {on: bar, value: 1 MPa}", ["a face is needed", "bar/x0"]),
    ("pressure: {on: bra/x1, value: 1 MPa}", ["no body \"bra\"", "\"bar\""]),
    ("pressure: {on: bar/x1, value: 5 N}", ["\"5 N\"", "a force", "a stress"]),
    ("pressure: {on: bar/x1}", ["\"value\" is missing"]),
    ("traction: {on: bar/x1, value: [1 MPa, 0]}", ["3 values"]),
    ("traction: {on: bar/x1, value: [1, 0, 0], axes: body}", ["\"body\" is none of fixed, following"]),
    ("line-load: {on: bar, value: [1, 0, 0]}", ["no beams and bars", "traction"]),
    ("body-force: {on: bar}", ["exactly one", "per-mass"]),
    ("body-force: {on: bar, per-mass: [1, 0, 0], per-volume: [1, 0, 0]}", ["exactly one"]),
    ("body-force: {on: bar/core, per-mass: [1, 0, 0]}", ["no element set \"core\""]),
    ("body-force: {on: bar, per-volume: [1 m, 0, 0]}", ["a length"]),
    ("base-acceleration: {value: [1 m, 0, 0]}", ["a length", "acceleration"]),
    ("pressure: {on: bar/x1, value: {table: nowhere.csv}}", ["nowhere.csv"]),
    ("pressure: {on: bar/x1, value: {table: [[0, 1], [-1, 2]]}}", ["must increase"]),
    ("pressure: {on: bar/x1, value: {table: [[-1, 1], [-0.5, 2]]}}", ["needed from 0"]),
])
def test_bad_loads_are_named(refuse, load, words):
    refuse(bar(f"  gas: {{{load}}}\n"), 5 if "nowhere" in load else 2, "model.yaml:", "table" if "needed from" in words[0] else "gas", *words)


def test_pressure_belongs_to_faces_and_meshes(refuse, buckens, tmp_path):
    refuse(rod("  gas: {pressure: {on: rod, value: 1 MPa}}\n"), 2, "no faces", "line-load")
    refuse("""
buckens: 1
bodies: {stone: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}}}
loads: {gas: {pressure: {on: stone/top, value: 1 MPa}}}
""", 2, "model.yaml:4:", "\"stone\" is rigid", "pressure")
    refuse(bar("  gas: {pressure: {on: bar/x1, value: 1}}\n").replace("{joint-force: wall}", "{load-force: gaz}"),
           2, "unknown load \"gaz\"", "gas")
    spring = rod("  pull: {spring-damper: {between: [ground, rod/end], stiffness: 1}}\n")
    (tmp_path / "model.yaml").write_text(spring.replace("{joint-force: wall}", "{load-force: pull}"))
    buckens("run", "model.yaml", "-o", "out").must(2, "opposite forces", "joint-force")


def test_planar_models_refuse_loads_out_of_their_plane(refuse):
    refuse("planar: xy" + rod("  snow: {line-load: {on: rod, value: [0, 0, 1 N/m]}}\n"), 2,
           "planar", "component z")
