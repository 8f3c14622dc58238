# SPDX-License-Identifier: Apache-2.0
"""Shells, wedges and pyramids through the program."""

import csv
import math

import h5py
import numpy
import pytest

FV12 = [1.622, 2.360, 2.922, 4.190, 4.190, 7.356, 7.356, 7.668]  # NAFEMS [Hz]

PLATE = """
buckens: 1
gravity: [0, 0, 0]
bodies:
  plate:
    mesh:
      plate: {size: [10 m, 10 m], divisions: [16, 16], thickness: 50 mm}
      material: {E: 200 GPa, nu: 0.3, rho: 8000}
"""

# A strip that hangs from one edge and swings.
SWING = """
buckens: 1
gravity: [0, 0, -9.81]
bodies:
  flap:
    mesh:
      plate: {from: [0, -0.1 m, 0], size: [0.5 m, 0.2 m], divisions: [6, 2], thickness: 2 mm,
              element: quad4}
      material: {E: 70 GPa, nu: 0.3, rho: 2700}
    interfaces: {hinge: {set: [x0]}}
joints:
  pin: {revolute: {between: [ground, flap/hinge], axis: [0, 1, 0]}}
simulation: {duration: 0.2 s, step: 1 ms}
output:
  every: 10 ms
  sensors:
    tip: {position: flap/edge_x1}
    peak: {stress: flap}
    root: {stress: flap/edge_y0}
"""


@pytest.fixture
def frequencies(buckens, tmp_path):
    """Free-free frequencies of the only body."""
    def call(text, count, *options):
        (tmp_path / "model.yaml").write_text(text)
        report = buckens("modes", "model.yaml", "--count", count, "--json", *options).must(0).json
        return numpy.array([mode["frequency"] for mode in report["analyses"][0]["modes"]])

    return call


def wave_number_squared(frequency):
    """Of bending waves of the plate, omega sqrt(rho h/D)."""
    return 2 * math.pi * frequency * math.sqrt(8000 * 0.05 / (200e9 * 0.05**3 / 12 / 0.91))


def dispersion(frequency, length):
    """Frequency of a standing wave on elements with tied slopes and consistent mass over the exact one,
    1 + (k l)^2/8 + 0.0123 (k l)^4: docs/theory/15-shells.md."""
    x = 0.5 * length * math.sqrt(wave_number_squared(frequency))
    return math.sin(x) * math.tan(x) / x**2 * math.sqrt(3 / (2 + math.cos(2 * x)))


@pytest.mark.parametrize("element", ["quad4", "tri3"])
def test_a_free_plate_vibrates_as_nafems_fv12(frequencies, element):
    found = {n: frequencies(PLATE, 8, f"--set=bodies.plate.mesh.plate.element={element}",
                            f"--set=bodies.plate.mesh.plate.divisions=[{n}, {n}]") for n in (8, 16)}
    for k, exact in enumerate(FV12):
        # Half a unit of the last digit; shear and rotary inertia of the thickness lower what thin
        # plates have.
        certain = 0.0005 / exact
        lowered = 0.185 * wave_number_squared(exact) * 0.05**2
        for n, values in found.items():
            assert 1 - certain - lowered <= values[k] / exact <= dispersion(exact, 10 / n) + certain
        if k > 4:  # modes 6 to 8 change places between the meshes
            continue
        far, near = (found[n][k] / exact - 1 for n in (8, 16))
        if element == "quad4":
            # Second order: what the next power leaves of the extrapolated value.
            rest = 4 * 0.0123 * wave_number_squared(exact)**2 * (10 / 16)**4
            assert abs((4 * near - far) / 3) <= rest + certain + lowered
        else:
            assert abs(near) <= 0.5 * abs(far) + certain + lowered


def test_a_plate_knows_its_mass_and_inertia(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(PLATE)
    plate = buckens("check", "model.yaml", "--json").must(0).json["bodies"]["plate"]
    mass = 8000 * 100 * 0.05
    assert plate["mass"] == pytest.approx(mass, rel=1e-12)
    assert (plate["nodes"], plate["elements"]) == (289, 256)
    about_x = mass * (100 + 0.05**2) / 12
    assert numpy.diag(numpy.array(plate["inertia"])) == pytest.approx(
        [about_x, about_x, mass * 200 / 12], rel=1e-12)


def columns(directory):
    rows = list(csv.reader((directory / "sensors.csv").open()))
    values = numpy.array(rows[1:], dtype=float).T
    return {name.split(" [")[0]: column for name, column in zip(rows[0], values)}


def test_a_flap_swings_on_its_edge(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(SWING)
    buckens("run", "model.yaml", "-o", "out").must(0)
    out = columns(tmp_path / "out")
    # A rigid flap about its edge: length L swings as a pendulum of 2/3 L.
    drop, turn = -out["tip.z"][-1] / 0.5, None
    angle, rate, h = 0.0, 0.0, 1e-5
    for _ in range(20000):
        rate += h * 1.5 * 9.81 / 0.5 * math.cos(angle)
        angle += h * rate
    turn = math.sin(angle)
    # The flap bends by 4 w l^4/(... E h^2): less than 1 % of its length here.
    assert drop == pytest.approx(turn, abs=0.01)
    # On its way it is bent as a free-ended bar under its own inertia: 12 g rho L^2/h at most.
    assert 0 < out["peak.mises"].max() < 12 * 9.81 * 2700 * 0.25 / 0.002
    with h5py.File(tmp_path / "out" / "results.h5", "r", swmr=True) as file:
        assert file["geometry/bodies/flap/faces"].shape == (12, 4)
        assert file["bodies/flap/solid_stress"].shape == (21, 12)


@pytest.mark.parametrize("side, sign", [("top", -1), ("bottom", 1)])
def test_pressure_pushes_a_plate(buckens, tmp_path, side, sign):
    text = PLATE.replace("[16, 16]", "[2, 2]") + f"""
loads:
  push: {{pressure: {{on: plate/{side}, value: 4 kPa}}}}
simulation: {{duration: 0.1 s, step: 1 ms}}
output: {{sensors: {{com: {{velocity: plate/com}}}}}}
"""
    (tmp_path / "model.yaml").write_text(text)
    buckens("run", "model.yaml", "-o", "out").must(0)
    # 4 kPa over 8000 kg/m^3 x 0.05 m are 10 m/s^2.
    assert columns(tmp_path / "out")["com.z"][-1] == pytest.approx(sign * 1.0, rel=1e-9)


def test_a_flap_swings_in_several_frames(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(SWING)
    drops = []
    for frames in (1, 3):
        buckens("run", "model.yaml", "-o", f"out{frames}", f"--set=bodies.flap.frames={frames}",
                "--set=simulation.duration=20 ms").must(0)
        drops.append(-columns(tmp_path / f"out{frames}")["tip.z"][-1])
    # Deflections of 1e-3 of the length: the frames differ by their square.
    assert drops[1] == pytest.approx(drops[0], rel=1e-3)
    # Between free fall and a rigid flap.
    assert 0.5 * 9.81 * 0.02**2 < drops[0] < 0.75 * 9.81 * 0.02**2


def test_triangles_and_layers_are_read(frequencies):
    # A laminate of layers of one isotropic material is that material.
    text = PLATE.replace("thickness: 50 mm",
                         "layers: [{thickness: 20 mm, angle: 30 deg}, {thickness: 30 mm}]")
    small = "--set=bodies.plate.mesh.plate.divisions=[4,4]"
    assert frequencies(text, 6, small) == pytest.approx(frequencies(PLATE, 6, small), rel=1e-6)


# Cantilever strip of single elements under a load at its end against the Timoshenko beam.
STRIP = """
buckens: 1
gravity: [0, 0, 0]
bodies:
  strip:
    structure:
      nodes: {a0: [0, 0, 0], a1: [0.1, 0, 0], a2: [0.2, 0, 0], a3: [0.3, 0, 0],
              b0: [0, 0.02, 0], b1: [0.1, 0.02, 0], b2: [0.2, 0.02, 0], b3: [0.3, 0.02, 0]}
      shells:
        - {nodes: [a0, a1, b1, b0], thickness: 4 mm, material: steel, offset: 1 mm}
        - {nodes: [a1, a2, b2, b1], thickness: 4 mm, material: steel, offset: 1 mm}
        - {nodes: [a2, a3, b3], thickness: 4 mm, material: steel, offset: 1 mm}
        - {nodes: [a2, b3, b2], thickness: 4 mm, material: steel, offset: 1 mm}
materials: {steel: {E: 210 GPa, nu: 0, rho: 7850}}
joints:
  clamp: {fixed: {between: [ground, strip/a0]}}
  other: {fixed: {between: [{ground: [0, 0.02, 0]}, strip/b0]}}
loads:
  down: {force: {on: strip/a3, value: [0, 0, 1 N]}}
  too: {force: {on: strip/b3, value: [0, 0, 1 N]}}
initial: {start: static}
simulation: {duration: 1 ms, step: 1 ms}
output: {sensors: {tip: {position: strip/a3}}}
"""


def test_a_strip_of_single_shells_bends_as_a_beam(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(STRIP)
    buckens("run", "model.yaml", "-o", "out").must(0)
    tip = columns(tmp_path / "out")["tip.z"][0]
    I = 0.02 * 0.004**3 / 12
    beam = 2 * 0.3**3 / (3 * 210e9 * I) + 2 * 0.3 / (5 / 6 * 105e9 * 0.02 * 0.004)
    # Linear rotations per element: the curvature of a cubic is taken stepwise, 1/(4 n^2) too little.
    assert tip == pytest.approx(beam, rel=0.04)


# A curved strip whose middle surface is offset from its nodes.
ARC = """
buckens: 1
gravity: [0, 0, 0]
materials: {steel: {E: 210 GPa, nu: 0.3, rho: 8000}}
bodies:
  arc:
    structure:
      nodes: {a0: [0, 0, 0], a1: [0.1, 0, 0.02], a2: [0.2, 0, 0.08], a3: [0.27, 0, 0.15],
              b0: [0, 0.1, 0], b1: [0.1, 0.1, 0.02], b2: [0.2, 0.1, 0.08], b3: [0.27, 0.1, 0.15]}
      shells:
        - {nodes: [a0, a1, b1, b0], thickness: 4 mm, material: steel, offset: 10 mm}
        - {nodes: [a1, a2, b2, b1], thickness: 4 mm, material: steel, offset: 10 mm}
        - {nodes: [a2, a3, b3, b2], thickness: 4 mm, material: steel, offset: 10 mm}
loads:
  weight: {body-force: {on: arc, per-volume: [16 kN/m^3, 0, -80 kN/m^3]}}
simulation: {duration: 1 ms, step: 0.1 ms}
output: {sensors: {place: {position: arc/a0}, bend: {deflection: {of: arc/a0, from: frame}}}}
"""


def test_weight_by_volume_leaves_a_free_shell_with_offset_undeformed(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(ARC)
    buckens("run", "model.yaml", "-o", "out").must(0)
    out = columns(tmp_path / "out")
    assert out["place.z"][-1] == pytest.approx(-0.5 * 10 * 1e-6, rel=1e-9)
    # The load has the pattern of the inertia; what remains is rounding of a fall of 5e-6 m.
    assert max(numpy.abs(out[f"bend.{a}"]).max() for a in "xyz") < 1e-18


MIXED = """
buckens: 1
gravity: [0, 0, 0]
materials: {steel: {E: 210 GPa, nu: 0.3, rho: 7850}}
bodies:
  part:
    structure:
      nodes: {a: [0, 0, 0], b: [1, 0, 0], c: [1, 1, 0], d: [0, 1, 0],
              e: [0, 0, 1], f: [1, 0, 1], g: [1, 1, 1], h: [0, 1, 1],
              i: [2, 0, 0], j: [2, 1, 0], k: [2, 0, 1], l: [2, 1, 1], top: [0.5, 0.5, 2],
              mast: [0, 0, 2.5]}
      solids:
        - {element: hex8, nodes: [a, b, c, d, e, f, g, h], material: steel}
        - {element: wedge6, nodes: [b, i, j, f, k, l], material: steel}
        - {element: wedge6, nodes: [b, j, c, f, l, g], material: steel}
        - {element: pyramid5, nodes: [e, f, g, h, top], material: steel}
      shells:
        - {nodes: [e, f, g, h], thickness: 10 mm, material: steel}
      beams:
        - {between: [e, mast], material: steel, section: {circle: {diameter: 50 mm}}}
      masses:
        - {at: mast, mass: 10 kg, inertia: [0.1, 0.1, 0.1]}
"""


def test_solids_shells_beams_and_masses_share_nodes(frequencies, buckens, tmp_path):
    found = frequencies(MIXED, 2)
    # The mast is clamped where the skin restrains its rotation: softer than on a rigid foot.
    stiffness = 3 * 210e9 * math.pi * 0.05**4 / 64 / 1.5**3
    assert 0.05 < found[0] / (math.sqrt(stiffness / 10) / 2 / math.pi) < 1
    part = buckens("check", "model.yaml", "--json").must(0).json["bodies"]["part"]
    mass = 7850 * (1 + 1 + 1 / 3 + 0.01 + 1.5 * math.pi * 0.025**2) + 10
    assert part["mass"] == pytest.approx(mass, rel=1e-12)
    assert part["elements"] == 6


def test_a_beam_alone_on_a_solid_spins(buckens, tmp_path):
    lines = [line for line in MIXED.splitlines() if "thickness" not in line and "shells" not in line]
    (tmp_path / "model.yaml").write_text("\n".join(lines))
    buckens("check", "model.yaml").must(3, "\"part\"", "mechanism", "\"e\"")


@pytest.mark.parametrize("element", ["wedge6", "wedge15", "pyramid5"])
def test_generated_solids_of_other_shapes(buckens, tmp_path, element):
    (tmp_path / "model.yaml").write_text(f"""
buckens: 1
bodies:
  rod:
    mesh:
      cylinder: {{to: [0.3 m, 0, 0], diameter: 20 mm, divisions: [1, 8, 6], element: {element}}}
      material: {{E: 210 GPa, nu: 0.3, rho: 7850}}
""")
    rod = buckens("check", "model.yaml", "--json").must(0).json["bodies"]["rod"]
    # An octagon with straight or curved edges.
    inscribed = 2 * math.sqrt(2) * 0.01**2 * 0.3 * 7850
    full = math.pi * 0.01**2 * 0.3 * 7850
    expected = full if element == "wedge15" else inscribed
    assert rod["mass"] == pytest.approx(expected, rel=2e-3)


@pytest.mark.parametrize("change, code, words", [
    ("thickness=0", 2, ["thickness", "must be positive"]),
    ("layers=[{thickness: 1 mm}]", 2, ["exactly one of the keys thickness and layers"]),
    ("direction=[0, 0, 1]", 3, ["\"plate\"", "is normal to it"]),
    ("direction=[0, 0, 0]", 2, ["direction", "cannot be zero"]),
    ("element=quad9", 2, ["element", "quad4"]),
    ("divisions=[4, 0]", 2, ["divisions.1", "must be positive"]),
])
def test_bad_plates_are_refused(buckens, tmp_path, change, code, words):
    (tmp_path / "model.yaml").write_text(PLATE)
    buckens("check", "model.yaml", f"--set=bodies.plate.mesh.plate.{change}").must(code, *words)


@pytest.mark.parametrize("old, new, code, words", [
    ("[a0, a1, b1, b0]", "[a0, a1]", 2, ["a shell has 3 or 4 nodes, found 2"]),
    ("[a0, a1, b1, b0]", "[a0, a1, b1, x]", 2, ["unknown node \"x\""]),
    ("[a0, a1, b1, b0]", "[a0, a1, b1, a0]", 2, ["appears twice"]),
    ("[a0, a1, b1, b0]", "[a0, b1, a1, b0]", 3, ["shell element 1", "folded"]),
])
def test_bad_shells_are_refused(buckens, tmp_path, old, new, code, words):
    (tmp_path / "model.yaml").write_text(STRIP.replace(old, new, 1))
    buckens("check", "model.yaml").must(code, *words)
