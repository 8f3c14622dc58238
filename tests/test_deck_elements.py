# SPDX-License-Identifier: Apache-2.0
"""Elements of decks against closed forms, or against those that they stand for."""

import csv
import math

import pytest

MODEL = """buckens: 1
bodies:
  b:
    mesh: {{file: {}, length-unit: m, mass-unit: kg}}
"""
E, NU, RHO = 210e9, 0.3, 7850.0


def frequencies(buckens, directory, deck, count, name="deck.bdf"):
    """Of the free body [Hz]."""
    (directory / name).write_text(deck)
    (directory / "model.yaml").write_text(MODEL.format(name))
    report = buckens("modes", "model.yaml", "--count", count, "--json").must(0).json
    return [mode["frequency"] for mode in report["analyses"][0]["modes"]]


def plates(*rectangles):
    """Area and principal second moments of a section of plates (centre y, centre z, width, height)."""
    area = sum(w * h for _, _, w, h in rectangles)
    y0 = sum(y * w * h for y, _, w, h in rectangles) / area
    z0 = sum(z * w * h for _, z, w, h in rectangles) / area
    yy = sum(w * h**3 / 12 + w * h * (z - z0)**2 for _, z, w, h in rectangles)
    zz = sum(h * w**3 / 12 + w * h * (y - y0)**2 for y, _, w, h in rectangles)
    yz = sum(w * h * (y - y0) * (z - z0) for y, z, w, h in rectangles)
    mean, half = (yy + zz) / 2, math.hypot((yy - zz) / 2, yz)
    return area, mean - half, mean + half


def ring(outer, inner):
    second = math.pi * (outer**4 - inner**4) / 4
    return math.pi * (outer**2 - inner**2), second, second


# Dimensions in the order of PBARL, and the plates of the same section [m].
SHAPES = {
    "BAR": ((0.05, 0.08), plates((0, 0, 0.05, 0.08))),
    "TUBE": ((0.04, 0.03), ring(0.04, 0.03)),
    "BOX": ((0.08, 0.06, 0.004, 0.006), plates((0, 0.028, 0.08, 0.004), (0, -0.028, 0.08, 0.004),
                                               (0.037, 0, 0.006, 0.052), (-0.037, 0, 0.006, 0.052))),
    "I": ((0.09, 0.05, 0.07, 0.006, 0.008, 0.008),
          plates((0, 0.004, 0.05, 0.008), (0, 0.045, 0.006, 0.074), (0, 0.086, 0.07, 0.008))),
    "T": ((0.08, 0.07, 0.008, 0.006), plates((0, 0.066, 0.08, 0.008), (0, 0.031, 0.006, 0.062))),
    "L": ((0.06, 0.08, 0.008, 0.008), plates((0.03, 0.004, 0.06, 0.008), (0.004, 0.044, 0.008, 0.072))),
    "CHAN": ((0.05, 0.08, 0.006, 0.008), plates((0.003, 0.04, 0.006, 0.064), (0.025, 0.004, 0.05, 0.008),
                                                (0.025, 0.076, 0.05, 0.008))),
    "Z": ((0.03, 0.008, 0.08, 0.096), plates((0, 0, 0.008, 0.096), (0.019, 0.044, 0.03, 0.008),
                                             (-0.019, -0.044, 0.03, 0.008))),
}


@pytest.mark.parametrize("card", ["CBAR", "CBEAM"])
@pytest.mark.parametrize("shape", SHAPES)
def test_free_beams_of_each_shape_vibrate_as_their_sections_say(buckens, tmp_path, shape, card):
    """The lowest frequency about either principal axis is 4.73004²/2π √(E I/(ρ A L⁴))."""
    length, parts = 6.0, 16
    sizes, (area, least, most) = SHAPES[shape]
    deck = "".join(f"GRID,{k + 1},,{k * length / parts!r},0.,0.\n" for k in range(parts + 1))
    deck += "".join(f"{card},{k + 1},1,{k + 1},{k + 2},0.,0.,1.\n" for k in range(parts))
    words = [f"{size!r}" for size in sizes]
    deck += f"{'PBARL' if card == 'CBAR' else 'PBEAML'},1,1,,{shape}\n," + ",".join(words)
    deck += f"\nMAT1,1,{E / 1e9!r}+9,,{NU},{RHO}\nENDDATA\n"
    found = frequencies(buckens, tmp_path, deck, 12)
    for second in (least, most):
        exact = 4.730041**2 / (2 * math.pi) * math.sqrt(E * second / (RHO * area * length**4))
        # Rotary inertia lowers it by half of 49.5 I/(A L²), where 49.5 is L² ∫w'²/∫w² of the mode; shear by no more
        # than E/(κG) times that, κ ≥ 0.2 for thin plates. The mesh raises it by (4.73/16)⁴/720.
        lower = 0.5 * 49.5 * (1 + 2 * (1 + NU) / 0.2) * second / (area * length**2)
        assert min(abs(f / exact - 1) for f in found) < lower + 1e-5, (exact, found)


def brick(kind):
    nodes, number, solids = [], {}, []
    for i in range(9):
        for j in range(3):
            for k in range(3):
                number[i, j, k] = len(number) + 1
                nodes.append(f"{number[i, j, k]}, {i / 8}, {0.1 * j}, {0.15 * k}")
    for i in range(8):
        for j in range(2):
            for k in range(2):
                corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
                solids.append(f"{len(solids) + 1}, " + ", ".join(str(number[i + a, j + b, k + c])
                                                                for a, b, c in corners))
    return "\n".join(["*NODE", *nodes, f"*ELEMENT, TYPE={kind}, ELSET=E", *solids,
                      "*SOLID SECTION, ELSET=E, MATERIAL=M", "*MATERIAL, NAME=M", "*ELASTIC", f"{E}, {NU}",
                      "*DENSITY", f"{RHO}", "*CONDUCTIVITY", "50.", "*SPECIFIC HEAT", "450.", "*EXPANSION", "1.2E-5",
                      "*PHYSICAL CONSTANTS, ABSOLUTE ZERO=0", ""])


@pytest.mark.parametrize("kind", ["C3D8T", "C3D8RT", "C3D8P", "DC3D8"])
def test_solids_with_temperature_or_pore_pressure_vibrate_as_those_without(buckens, tmp_path, kind):
    """The same element by another name: equal to the last bit."""
    plain = frequencies(buckens, tmp_path, brick("C3D8"), 6, "deck.inp")
    assert frequencies(buckens, tmp_path, brick(kind), 6, "deck.inp") == plain
    told = buckens("mesh-info", "deck.inp", "--json").must(0).json
    assert told["kinds"] == [{"kind": "hex8", "source": kind, "count": 32}]
    # A free bar of one metre: longitudinal waves at c/2L, a few parts in a thousand lower by the
    # lateral inertia, ½ (π ν r/L)² with r² = (0.2² + 0.3²)/12, and higher by the mesh, (π/8)²/24.
    wave = math.sqrt(E / RHO) / 2
    more = frequencies(buckens, tmp_path, brick(kind), 12, "deck.inp")
    assert min(abs(f / wave - 1) for f in more) < 0.5 * (math.pi * NU)**2 * 0.13 / 12 + (math.pi / 8)**2 / 24


TAPERED = """buckens: 1
gravity: [0, 0, 0]
bodies:
  arm:
    mesh: {{file: arm.inp, length-unit: m, mass-unit: kg}}
joints:
  wall: {{fixed: {{between: [ground, arm/n1]}}}}
loads:
  push: {{force: {{on: arm/n41, value: {force}}}}}
initial: {{start: static}}
simulation: {{duration: 1 us, step: 1 us}}
output:
  every: 1 us
  sensors: {{tip: {{position: arm/n41}}}}
"""


@pytest.mark.parametrize("force, width, height", [("[0, 0, 100 N]", 0, 1), ("[0, 100 N, 0]", 1, 0)])
def test_a_tapered_arm_bends_as_its_nodal_thicknesses_say(buckens, tmp_path, force, width, height):
    """Two measures at each node: the deflection of Euler and Timoshenko with I(x), by quadrature."""
    length, count = 1.0, 40
    measures = [lambda x: 0.04 - 0.02 * x / length, lambda x: 0.06 - 0.04 * x / length]
    nodes = [k * length / count for k in range(count + 1)]
    deck = "*NODE\n" + "".join(f"{k + 1}, {x!r}, 0, 0\n" for k, x in enumerate(nodes))
    deck += "*ELEMENT, TYPE=B31, ELSET=E\n" + "".join(f"{k}, {k}, {k + 1}\n" for k in range(1, count + 1))
    deck += f"*MATERIAL, NAME=M\n*ELASTIC\n{E}, {NU}\n*DENSITY\n{RHO}\n"
    # Direction 1 along y; the line of measures is empty.
    deck += "*BEAM SECTION, ELSET=E, MATERIAL=M, SECTION=RECT, NODAL THICKNESS\n,\n0, 1, 0\n*NODAL THICKNESS\n"
    deck += "".join(f"{k + 1}, {measures[0](x)!r}, {measures[1](x)!r}\n" for k, x in enumerate(nodes))
    (tmp_path / "arm.inp").write_text(deck)
    (tmp_path / "model.yaml").write_text(TAPERED.format(force=force))
    body = buckens("check", "model.yaml", "--json").must(0).json["bodies"]["arm"]
    means = [[(m(a) + m(b)) / 2 for m in measures] for a, b in zip(nodes, nodes[1:])]
    assert body["mass"] == pytest.approx(RHO * length / count * sum(b * h for b, h in means), rel=1e-9)
    # Of a volume without steps: 1 − (Δb Δh) / (12 n² b h) at most.
    exact = RHO * length * (0.04 * 0.06 - (0.04 * 0.04 + 0.02 * 0.06) / 2 + 0.02 * 0.04 / 3)
    assert body["mass"] == pytest.approx(exact, rel=1e-4)
    buckens("run", "model.yaml", "-o", "out", "-q").must(0)
    rows = list(csv.DictReader((tmp_path / "out" / "sensors.csv").open()))
    axis = "z" if height else "y"
    moved = float(next(value for key, value in rows[-1].items() if key.startswith(f"tip.{axis}")))
    fine = 20000
    deflection = 0.0
    for k in range(fine):
        x = (k + 0.5) * length / fine
        along, across = (measures[1](x), measures[0](x)) if height else (measures[0](x), measures[1](x))
        deflection += ((length - x)**2 / (E * across * along**3 / 12) + 1.2 / (E / (2 + 2 * NU) * along * across)) * length / fine
    # Steps in place of a slope: an error of (Δh/h)²/12 per element, largest 0.05²/12 near the tip.
    assert moved == pytest.approx(100 * deflection, rel=1e-3)


def test_each_shell_has_its_thickness_by_distribution(buckens, tmp_path):
    """A strip of two thicknesses, by *DISTRIBUTION and by two sections: the same body."""
    nodes = "*NODE\n" + "".join(f"{1 + i + 9 * j}, {0.1 * i}, {0.1 * j}, 0\n" for j in (0, 1) for i in range(9))
    quads = "".join(f"{i + 1}, {i + 1}, {i + 2}, {i + 11}, {i + 10}\n" for i in range(8))
    sets = "*ELSET, ELSET=THIN, GENERATE\n1, 4\n*ELSET, ELSET=THICK, GENERATE\n5, 8\n"
    deck = nodes + "*ELEMENT, TYPE=S4, ELSET=E\n" + quads + sets + f"*MATERIAL, NAME=M\n*ELASTIC\n{E}, {NU}\n*DENSITY\n{RHO}\n"
    two = deck + "*SHELL SECTION, ELSET=THIN, MATERIAL=M\n0.004\n*SHELL SECTION, ELSET=THICK, MATERIAL=M\n0.01\n"
    own = deck + ("*SHELL SECTION, ELSET=E, MATERIAL=M, SHELL THICKNESS=T\n0.02\n"
                  "*DISTRIBUTION, NAME=T, LOCATION=ELEMENT, TABLE=TT\n, 0.004\nTHICK, 0.01\n")
    wanted = frequencies(buckens, tmp_path, two, 6, "two.inp")
    assert frequencies(buckens, tmp_path, own, 6, "own.inp") == pytest.approx(wanted, rel=1e-9)
    body = buckens("check", "model.yaml", "--json").must(0).json["bodies"]["b"]
    assert body["mass"] == pytest.approx(RHO * 0.04 * (0.004 + 0.01), rel=1e-9)
