# SPDX-License-Identifier: Apache-2.0
"""Reduced and quasi-static bodies as seen by a user."""

import csv
import json
import pathlib

import h5py
import numpy
import pytest

from elastic_crank import ELASTIC_CRANK
from test_view import add_viewer, installed, view  # noqa: F401 - a fixture

EXAMPLES = pathlib.Path(__file__).parents[1] / "examples"
CRANK = EXAMPLES / "slider_crank" / "slider_crank.yaml"


@pytest.fixture
def run(buckens, tmp_path):
    """Runs a model with changed settings: columns of sensors.csv by name, and the summary."""

    def call(model, name="out", **settings):
        changes = [part for path, value in settings.items()
                   for part in ("--set", f"{path.replace('__', '.')}={value}")]
        buckens("run", model, "-o", name, *changes).must(0)
        with open(tmp_path / name / "sensors.csv", newline="") as file:
            rows = list(csv.reader(file))
        table = numpy.array(rows[1:], dtype=float)
        columns = {title.split(" [")[0]: table[:, k] for k, title in enumerate(rows[0])}
        return columns, json.loads((tmp_path / name / "summary.json").read_text())

    return call


def short(**settings):
    return {"simulation__duration": "6 ms", **settings}


def reduced(basis, **settings):
    return short(bodies__rod__reduction=basis, **settings)


def largest_difference(one, two, names):
    return max(numpy.abs(one[n] - two[n]).max() / numpy.abs(two[n]).max() for n in names)


SEEN = ["mid.y", "slider.x", "guide.y", "stress.axial"]


@pytest.mark.parametrize("coupling", ["full", "first-order", "none", "auto"])
def test_all_modes_move_like_the_full_mesh(run, coupling):
    full, summary = run(CRANK, "full", **short(bodies__rod__coupling=coupling))
    for name, basis in [("free", "{free-free: 1000}"), ("held", "{craig-bampton: 1000}")]:
        other, reduced_summary = run(CRANK, name, **reduced(basis, bodies__rod__coupling=coupling))
        rod = reduced_summary["bodies"]["rod"]
        # 17 nodes of three variables, less three rigid motions.
        assert rod["dof"] == 48
        assert rod["factorisations"] == 0, "a diagonal matrix needs none"
        assert rod["solves"] == summary["bodies"]["rod"]["solves"]
        # Rounding of 1e-16 times the spread of the eigenvalues, (ω_max/ω_1)² = 2e7.
        assert largest_difference(other, full, SEEN) < 1e-7


def test_deflection_converges_with_the_number_of_modes(run):
    full, _ = run(CRANK, "full", **short())
    errors = []
    for modes in (2, 4, 8):
        other, summary = run(CRANK, f"m{modes}", **reduced(f"{{free-free: {modes}}}"))
        assert summary["bodies"]["rod"]["kept_modes"] == modes
        errors.append(largest_difference(other, full, ["mid.y"]))
    assert all(b < a for a, b in zip(errors, errors[1:])), errors
    assert errors[-1] < 1e-4
    bare, summary = run(CRANK, "bare",
                        **reduced("{free-free: {modes: 2, static-correction: off}}"))
    assert summary["bodies"]["rod"]["static_shapes"] == 0
    assert largest_difference(bare, full, ["mid.y"]) > 3 * errors[0], "the correction is worth it"


def test_held_modes_converge(run):
    full, _ = run(CRANK, "full", **short())
    errors = []
    for modes in (1, 4, 12):
        other, _ = run(CRANK, f"m{modes}", **reduced(f"{{craig-bampton: {modes}}}"))
        errors.append(largest_difference(other, full, ["mid.y"]))
    assert errors[2] < errors[1] < errors[0]
    assert errors[2] < 1e-3


def test_check_says_what_is_kept(buckens):
    arguments = ("check", CRANK, "--set", "bodies.rod.reduction={free-free: 4}")
    text = buckens(*arguments).must(0).out
    assert "reduced bodies" in text
    assert "free-free" in text and "4 vibrations" in text and "of 51 variables" in text
    rod = buckens(*arguments, "--json").must(0).json["bodies"]["rod"]
    kept = rod["reduction"]
    assert kept["modes"] == 4 and kept["full_dof"] == 51
    assert rod["dof"] == kept["modes"] + kept["static_shapes"]
    full = buckens("check", CRANK, "--json").must(0).json["bodies"]["rod"]
    assert rod["frequencies"][:4] == pytest.approx(full["frequencies"][:4], rel=1e-9)
    assert kept["highest_mode"] == pytest.approx(full["frequencies"][3], rel=1e-9)
    assert 0 < kept["static_share"] <= 1, "these four bend; none stretches"


def test_modes_of_a_reduced_body(buckens, tmp_path):
    full = buckens("modes", CRANK, "--count", "4", "--json").must(0).json
    other = buckens("modes", CRANK, "--count", "4", "--json", "-o", "shapes",
                    "--set", "bodies.rod.reduction={free-free: 4}").must(0).json
    frequencies = [[v["frequency"] for v in report["analyses"][0]["modes"]]
                   for report in (full, other)]
    assert frequencies[0] == pytest.approx(frequencies[1], rel=1e-9)
    assert (tmp_path / "shapes" / "results.h5").exists()
    system = [buckens("modes", CRANK, "--system", "--count", "3", "--json", *more).must(0).json
              for more in ((), ("--set", "bodies.rod.reduction={free-free: 8}"))]
    lowest = [[v["frequency"] for v in report["analyses"][0]["modes"]] for report in system]
    assert lowest[1] == pytest.approx(lowest[0], rel=1e-4)


def test_results_are_those_of_nodes(run, tmp_path):
    fields = {}
    for name, settings in [("full", short()), ("reduced", reduced("{free-free: 1000}"))]:
        run(CRANK, name, **settings)
        with h5py.File(tmp_path / name / "results.h5") as file:
            fields[name] = {key: file[f"bodies/rod/{key}"][()]
                            for key in ("displacement", "section_force", "stress")}
    for key, expected in fields["full"].items():
        found = fields["reduced"][key]
        assert found.shape == expected.shape
        assert numpy.abs(found - expected).max() < 1e-6 * numpy.abs(expected).max()


def test_a_reduced_run_can_be_viewed(run, installed, tmp_path):
    run(CRANK, "out", **reduced("{free-free: 4}"))
    add_viewer(installed)
    view(installed, "out", cwd=tmp_path).must(0)


def test_like_is_reduced_on_its_own(buckens, tmp_path):
    (tmp_path / "two.yaml").write_text("""
buckens: 1
materials: {steel: {E: 200 GPa, nu: 0.3, rho: 7870 kg/m^3}}
bodies:
  one: {beam: {to: [1 m, 0, 0], elements: 4, section: {circle: {diameter: 1 cm}}, material: steel}}
  two: {like: one, at: {position: [0, 1 m, 0]}, reduction: {free-free: 2}}
""")
    bodies = buckens("check", "two.yaml", "--json").must(0).json["bodies"]
    assert "reduction" not in bodies["one"]
    assert bodies["two"]["dof"] == 2 and bodies["two"]["reduction"]["static_shapes"] == 0


def test_static_start_and_interface_loads_are_exact(run, buckens, tmp_path):
    (tmp_path / "cantilever.yaml").write_text("""
buckens: 1
planar: xy
materials: {steel: {E: 200 GPa, nu: 0.3, rho: 7870 kg/m^3}}
bodies:
  arm: {beam: {to: [1 m, 0, 0], elements: 6, section: {circle: {diameter: 2 cm}}, material: steel}}
joints: {clamp: {fixed: {between: [ground, arm/start]}}}
loads: {tip: {force: {on: arm/end, value: [0, -10 N, 0]}}}
initial: {start: static}
simulation: {duration: 10 ms, step: 1 ms}
output: {sensors: {tip: {displacement: arm/end}}}
""")
    full, _ = run("cantilever.yaml", "full")
    for basis in ("{free-free: 2}", "{craig-bampton: 0}"):
        other, _ = run("cantilever.yaml", "other", bodies__arm__reduction=basis)
        # The deflection is due to an interface load: contained in both bases. Rounding: 1e-16·cond(K).
        assert other["tip.y"] == pytest.approx(full["tip.y"], rel=1e-7)


def test_free_flight_of_a_reduced_body_conserves(run):
    model = EXAMPLES / "planar_levels" / "free_flight.yaml"
    errors = [run(model, f"h{k}", bodies__beam__reduction="{free-free: 2}",
                  simulation__step=f"{step} ms")[1]["energy_error"]
              for k, step in enumerate((2, 1))]
    assert errors[1] < 1e-6
    # Order two of the method.
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.2)


# ---- quasi-static


def spun(**settings):
    return {"bodies__rod__flexibility": "quasi-static", **settings}


def test_quasi_static_rod_stretches_as_theory_says(run, models):
    columns, summary = run(models / "spun_rod.yaml", **spun())
    L, w, rho, E = 1.0, 20.0, 1000.0, 1e9
    length = numpy.hypot(columns["tip.x"], columns["tip.y"])
    # (tan a / a) L with a = ωL√(ρ/E) is exact for linear elasticity in the turning axes; ρω²L³/3E alone
    # is the load of the undeformed rod.
    a = w * L * numpy.sqrt(rho / E)
    exact = (numpy.tan(a) / a - 1.0) * L
    # The start is exact but for the mesh of eight linear elements; steps of h add (hω)²/6 to the load.
    assert length[0] - L == pytest.approx(exact, rel=2e-5)
    assert length - L == pytest.approx(exact, rel=(1e-3 * w)**2 / 6 + 2e-5)
    assert summary["bodies"]["rod"]["largest_strain"] == pytest.approx(rho * w**2 / (2 * E), rel=0.05)
    # Nothing vibrates from the first record on.
    assert numpy.ptp(length) < 1e-8, "of the step, see above"
    mass = rho * numpy.pi * 0.03**2
    force = numpy.hypot(columns["force.x"], columns["force.y"])
    assert force == pytest.approx(mass * w**2 * (L / 2 + 0.4 * (exact)), rel=1e-3)


def test_quasi_static_deformation_is_the_full_one_of_slow_motion(run):
    # A drive without jerk at the start leaves the rod without vibration: two radians in T, φ = k t⁵.
    differences = []
    for T, k in ((0.25, 2000), (0.5, 62.5)):
        settings = {"joints__motor__prescribed-rotation__angle": f'"{k}*t^5 rad"',
                    "simulation__duration": f"{T} s", "simulation__step": f"{T} ms"}
        full, _ = run(CRANK, "full", **settings)
        still, summary = run(CRANK, "still", bodies__rod__flexibility="quasi-static", **settings)
        assert summary["trust"] == "ok"
        differences.append(largest_difference(still, full, ["mid.y"]))
    # Centrifugal loads grow with t⁸. What is left is their second derivative over the square of
    # the pinned rod's frequency: 56/T²/(829 rad/s)² = 1.3e-3, a few times over as the rod turns.
    assert differences[0] < 5e-3
    assert differences[0] / differences[1] == pytest.approx(4, rel=0.15), "of second order in 1/T"


def test_quasi_static_crank_solves_once_or_twice_and_closes_its_joints(run):
    columns, summary = run(CRANK, bodies__rod__flexibility="quasi-static",
                           simulation__duration="20 ms")
    rod = summary["bodies"]["rod"]
    assert rod["factorisations"] == 0
    assert rod["solves"] <= 2 * summary["steps"]
    assert summary["residuals"]["position"] < 1e-11
    assert numpy.abs(columns["mid.y"]).max() > 1e-3


@pytest.mark.parametrize("changes, words", [
    ({"bodies.rod.reduction": "{free-free: 4}", "bodies.rod.frames": "4"}, ["frames", "one frame"]),
    ({"bodies.rod.flexibility": "quasi-static", "bodies.rod.frames": "4"}, ["one frame"]),
    ({"bodies.rod.reduction": "{free-free: 4}", "bodies.rod.geometric-stiffness": "on"},
     ["geometric-stiffness", "full mesh"]),
    ({"bodies.rod.reduction": "{craig-bampton: 4}", "bodies.rod.flexibility": "quasi-static"},
     ["reduction", "free-free"]),
    ({"bodies.rod.reduction": "{craig-bampton: {modes: 4, cutoff: 2 kHz}}"}, ["modes", "cutoff"]),
    ({"bodies.rod.reduction": "{free-free: -1}"}, ["free-free", "-1", "positive"]),
    ({"bodies.rod.flexibility": "quasi-static", "simulation.method": "newmark"},
     ["newmark", "rod", "generalized-alpha"]),
    ({"bodies.rod.flexibility": "quasi-static",
      "initial": "{bodies: {rod: {nodal-velocity: {y: 1}}}}"}, ["rod", "nodal-velocity"]),
])
def test_contradictions_are_refused(buckens, changes, words):
    settings = [part for path, value in changes.items() for part in ("--set", f"{path}={value}")]
    buckens("run", CRANK, "-o", "out", *settings).must(2, *words)


def test_quasi_static_bodies_have_no_modes(buckens):
    buckens("modes", CRANK, "--body", "rod", "--set",
            "bodies.rod.flexibility=quasi-static").must(3, "rod", "quasi-static")


# ---- bases in files, modes chosen by trial


@pytest.fixture
def rod(tmp_path):
    """The slider-crank in the test's own directory, where files may be written."""
    path = tmp_path / "crank.yaml"
    path.write_text(CRANK.read_text())
    return path


def test_a_basis_is_made_once(run, rod, tmp_path, buckens):
    basis = "{craig-bampton: 4, file: rod.basis.h5}"
    first, _ = run(rod, "one", **reduced(basis))
    file = tmp_path / "rod.basis.h5"
    made = file.stat().st_mtime_ns
    again, _ = run(rod, "two", **reduced(basis))
    assert file.stat().st_mtime_ns == made, "read, not written"
    for name in SEEN:
        assert numpy.array_equal(first[name], again[name])
    assert not list(tmp_path.glob("*.part"))
    for change in ("materials.steel.E=210 GPa", "bodies.rod.beam.elements=8",
                   "bodies.rod.reduction={craig-bampton: 6, file: rod.basis.h5}"):
        settings = ("--set", f"bodies.rod.reduction={basis}", "--set", change)
        buckens("check", rod, *settings).must(2, "rod.basis.h5", "remove the file", "reduction.file")
    assert file.stat().st_mtime_ns == made
    file.write_text("no HDF5")
    buckens("check", rod, "--set", f"bodies.rod.reduction={basis}").must(2, "crank.yaml:", "rod.basis.h5", "not a reduced basis")


SQUARE_BLOCK = """
buckens: 1
gravity: [0, -9.81 m/s^2, 0]
materials: {soft: {E: 1e8 Pa, nu: 0.3, rho: 1000 kg/m^3}}
bodies:
  block:
    mesh: {box: {from: [0, -50 mm, -50 mm], size: [1 m, 0.1 m, 0.1 m], divisions: [8, 2, 2]}, material: soft}
joints: {pin: {spherical: {between: [ground, block/face_x0]}}}
simulation: {duration: 20 ms, step: 1 ms}
output: {every: 1 ms, sensors: {pin: {joint-force: pin}}}
"""


@pytest.mark.parametrize("kind, cut", [("free-free", [1, 3, 7]), ("craig-bampton", [1, 4])])
def test_equal_frequencies_stay_together(run, tmp_path, kind, cut):
    """The fall of a square block is a plane motion, whatever the number of modes."""
    (tmp_path / "block.yaml").write_text(SQUARE_BLOCK)
    for asked in range(1, max(cut) + 1):
        columns, summary = run(tmp_path / "block.yaml", "out",
                               bodies__block__reduction=f"{{{kind}: {asked}}}")
        # Rounding of 40 N through sums over 243 variables and equal modes that mix at 1e-9.
        assert numpy.abs(columns["pin.z"]).max() < 1e-7
        assert numpy.abs(columns["pin.y"]).max() > 30
        taken = asked + 1 if asked in cut else asked
        assert summary["bodies"]["block"]["kept_modes"] == taken
        told = [text for text in summary["warnings"] if "must be kept together" in text]
        assert len(told) == (1 if asked in cut else 0)
        assert all(f"{asked} modes were requested; {taken} are in" in text for text in told)


def test_trial_runs_have_a_clock_of_their_own(buckens, rod):
    """Fields of the run need not fit the records of the trials."""
    report = buckens("run", rod, "-o", "out", "--set", "simulation.duration=6 ms", "--set", "output.every=0.4 ms",
                     "--set", "output.fields={record: [displacement], every: 1.6 ms}",
                     "--set", "bodies.rod.reduction={auto: 20 %}").must(0)
    warnings = [line for line in report.err.splitlines() if "warning: step" in line]
    assert len(warnings) == len(set(warnings)), "trials keep theirs to themselves"


def test_modes_are_chosen_by_trial(run, rod, buckens):
    chosen = {}
    full, _ = run(rod, "full", **short())
    for tolerance in ("20 %", "0.01 %"):
        columns, summary = run(rod, "auto", **short(bodies__rod__reduction=f"{{auto: {tolerance}}}"))
        chosen[tolerance] = summary["bodies"]["rod"]["kept_modes"]
        note = next(text for text in summary["warnings"] if "craig-bampton" in text)
        assert "\"rod\"" in note and f"{int(chosen[tolerance])} modes" in note
        off = numpy.abs(columns["mid.y"] - full["mid.y"]).max()
        # The markers of joints stay within the tolerance; the middle is one of them.
        limit = {"20 %": 0.2, "0.01 %": 1e-4}[tolerance]
        assert off < 2 * limit * numpy.abs(full["mid.y"]).max()
    assert 1 <= chosen["20 %"] < chosen["0.01 %"]
    short_form, summary = run(rod, "short", **short(bodies__rod__reduction="20 %"))
    assert summary["bodies"]["rod"]["kept_modes"] == chosen["20 %"]
    buckens("check", rod, "--set", "bodies.rod.reduction={auto: 1 %, file: a.h5}").must(
        2, "auto", "number of modes")


PINNED_ROD = ELASTIC_CRANK + """
loads:
  fc: {hinge-friction: {joint: c, static: 0.1, radius: 5 mm}}
  mo: {torque: {on: crank, value: [0, 0, 1]}}
simulation: {duration: 0.15 s, step: 0.2 ms}
output: {every: 1 ms, sensors: {a: {joint-coordinate: a}, d: {joint-coordinate: d}}}
"""


def test_friction_holds_a_joint_of_a_quasi_static_rod(sensors):
    """The pin at its end turns round at 89° and sticks for an instant, with a damper that exceeds the bending stiffness many times
    over a short step. The damper sees no rate of the shape: as long as the iteration took it to, no step of any length converged."""
    still = sensors(PINNED_ROD, "--set", "bodies.rod.flexibility=quasi-static")
    full = sensors(PINNED_ROD)
    # Without vibrations, of 1e-4 of the deflection and less.
    assert still["a.value"] == pytest.approx(full["a.value"], rel=1e-4)
    assert still["d.value"] == pytest.approx(full["d.value"], abs=1e-5)
