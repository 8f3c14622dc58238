# SPDX-License-Identifier: Apache-2.0
"""Elements of decks against closed forms, or against those that they stand for."""

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
