# SPDX-License-Identifier: Apache-2.0
"""Directions of materials in decks: layers with orientations of their own, anisotropic constants in turned axes, and
sections of beams that are turned and beside their nodes."""

import csv
import math

import numpy
import pytest

MODEL = """buckens: 1
bodies:
  b:
    mesh: {file: NAME, length-unit: m, mass-unit: kg}
"""
LAMINA = "*MATERIAL, NAME=M\n*ELASTIC, TYPE=LAMINA\n1.35e11, 1e10, 0.3, 5e9, 5e9, 3e9\n*DENSITY\n1600\n"
CONSTANTS = (1.35e11, 1e10, 1.2e10, 0.3, 0.25, 0.4, 5e9, 6e9, 3.5e9)  # E1 E2 E3 ν12 ν13 ν23 G12 G13 G23
PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))  # in the order of Abaqus


@pytest.fixture
def frequencies(buckens, tmp_path):
    def of(deck, name="deck.inp", count=8):
        (tmp_path / name).write_text(deck)
        (tmp_path / "model.yaml").write_text(MODEL.replace("NAME", name))
        modes = buckens("modes", "model.yaml", "--count", count, "--json").must(0).json["analyses"][0]["modes"]
        return numpy.array([mode["frequency"] for mode in modes])

    return of


@pytest.fixture
def refuse(buckens, tmp_path):
    def of(deck, *words, name="deck.inp"):
        (tmp_path / name).write_text(deck)
        (tmp_path / "model.yaml").write_text(MODEL.replace("NAME", name))
        return buckens("check", "model.yaml").must(2, *words)

    return of


def rotation(axis, degrees):
    """By the formula of Rodrigues."""
    a = numpy.array(axis, float) / numpy.linalg.norm(axis)
    cross = numpy.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])
    angle = math.radians(degrees)
    return numpy.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross


def numbers(values):
    return ", ".join(repr(float(value)) for value in values)


def orientation(name, axes, last="3, 0.\n"):
    return f"*ORIENTATION, NAME={name}\n{numbers(axes[:, 0])}, {numbers(axes[:, 1])}\n{last}"


# ---- layers


def plate(turn, height=lambda x: 0.0, count=6):
    """A plate with its middle surface at a height over x, all of it turned; and its element's normals."""
    nodes = numpy.array([[0.1 * i, 0.1 * j, height(0.1 * i)] for j in range(4) for i in range(count + 1)]) @ turn.T
    quads = [[i + (count + 1) * j, i + 1 + (count + 1) * j, i + 1 + (count + 1) * (j + 1), i + (count + 1) * (j + 1)]
             for j in range(3) for i in range(count)]
    deck = "*NODE\n" + "".join(f"{k + 1}, {numbers(x)}\n" for k, x in enumerate(nodes))
    deck += "*ELEMENT, TYPE=S4, ELSET=E\n" + "".join(
        f"{k + 1}, " + ", ".join(str(n + 1) for n in quad) + "\n" for k, quad in enumerate(quads))
    normals = [numpy.cross(nodes[q[2]] - nodes[q[0]], nodes[q[3]] - nodes[q[1]]) for q in quads]
    return deck + LAMINA, [n / numpy.linalg.norm(n) for n in normals]


ANGLES = (10.0, 55.0, -35.0)


def test_layers_have_orientations_of_their_own(frequencies):
    """Each by an orientation is each by its angle from that of the section; CalculiX writes no second line."""
    turn = rotation((1, 2, 3), 40)
    deck, _ = plate(turn)
    section = "*SHELL SECTION, ELSET=E, COMPOSITE{}\n"

    def by_angle(first):
        axes = turn @ rotation((0, 0, 1), first)
        return deck + orientation("O", axes) + section.format(", ORIENTATION=O") + "".join(
            f"0.002, 3, M, {angle - first}\n" for angle in ANGLES)

    # Without an orientation of the section angles are counted from the first layer.
    wanted = frequencies(by_angle(ANGLES[0]))
    for last in ("3, 0.\n", ""):
        own = "".join(orientation(f"O{k}", turn @ rotation((0, 0, 1), angle), last) for k, angle in enumerate(ANGLES))
        rows = "".join(f"0.002, , M, O{k}\n" for k in range(3))
        assert frequencies(deck + own + section.format("") + rows) == pytest.approx(wanted, rel=1e-8)
    # From other axes all is the same but for the correction of transverse shear, made along the shell's two axes.
    about = frequencies(by_angle(0.0))
    assert about == pytest.approx(wanted, rel=1e-3)
    # By axes in another order, of which the second is near the normal; beside layers with angles.
    swapped = turn @ rotation((0, 0, 1), ANGLES[1])
    mixed = deck + orientation("O", turn) + orientation("P", swapped[:, [1, 2, 0]], "2, 0.\n")
    mixed += section.format(", ORIENTATION=O") + f"0.002, , M, {ANGLES[0]}\n0.002, , M, P\n0.002, , M, {ANGLES[2]}\n"
    assert frequencies(mixed) == pytest.approx(about, rel=1e-8)
    # It matters.
    other = by_angle(0.0).replace("M, 55.0", "M, 0.0")
    assert abs(frequencies(other) / wanted - 1).max() > 0.02


def test_orientations_of_layers_are_projected_onto_each_element(frequencies):
    """On a curved shell each element has angles of its own, here worked out one by one."""
    turn = rotation((2, -1, 1), 65)
    deck, normals = plate(turn, lambda x: 2.0 * x * (0.6 - x))
    axes = [turn @ rotation((0, 0, 1), angle) for angle in ANGLES]
    own = deck + "".join(orientation(f"O{k}", a) for k, a in enumerate(axes))
    own += "*SHELL SECTION, ELSET=E, COMPOSITE\n" + "".join(f"0.002, , M, O{k}\n" for k in range(3))
    one_by_one = deck + orientation("O", axes[0])
    for k, n in enumerate(normals):
        first, *others = [a[:, 0] - a[:, 0] @ n * n for a in axes]
        angles = [0.0] + [math.degrees(math.atan2(n @ numpy.cross(first, d), first @ d)) for d in others]
        one_by_one += f"*ELSET, ELSET=E{k}\n{k + 1}\n*SHELL SECTION, ELSET=E{k}, COMPOSITE, ORIENTATION=O\n"
        one_by_one += "".join(f"0.002, , M, {angle!r}\n" for angle in angles)
    assert frequencies(own) == pytest.approx(frequencies(one_by_one), rel=1e-8)


def test_orientations_of_layers_that_are_none(refuse):
    deck, _ = plate(numpy.eye(3))
    section = "*SHELL SECTION, ELSET=E, COMPOSITE\n0.002, , M, O\n"
    refuse(deck + section, "deck.inp", "there is no orientation \"O\"")
    tilted = rotation((1, 0, 0), 30)
    refuse(deck + orientation("O", tilted, "") + section, "its second line must say which of its axes")
    refuse(deck + orientation("O", numpy.eye(3), "1, 0.\n") + orientation("P", numpy.eye(3)) +
           "*SHELL SECTION, ELSET=E, COMPOSITE, ORIENTATION=P\n0.002, , M, O\n0.002, , M, Q\n", "no orientation \"Q\"")
    refuse(deck + "*ORIENTATION, NAME=O, SYSTEM=CYLINDRICAL\n0, 0, 0, 0, 0, 1\n3, 0.\n" + section.replace("SITE", "SITE, ORIENTATION=P")
           + orientation("P", numpy.eye(3)), "\"O\" of CYLINDRICAL", "SYSTEM=RECTANGULAR")


# ---- anisotropic constants


def block():
    nodes = [(0.02 * i, 0.03 * j, 0.025 * k) for k in range(5) for j in range(2) for i in range(2)]
    deck = "*NODE\n" + "".join(f"{n + 1}, {numbers(x)}\n" for n, x in enumerate(nodes))
    deck += "*ELEMENT, TYPE=C3D8I, ELSET=E\n"
    for k in range(4):
        a = 4 * k + 1
        deck += f"{k + 1}, {a}, {a + 1}, {a + 3}, {a + 2}, {a + 4}, {a + 5}, {a + 7}, {a + 6}\n"
    return deck


def tensor(constants):
    E1, E2, E3, n12, n13, n23, G12, G13, G23 = constants
    S = numpy.array([[1 / E1, -n12 / E1, -n13 / E1], [-n12 / E1, 1 / E2, -n23 / E2], [-n13 / E1, -n23 / E2, 1 / E3]])
    C = numpy.zeros((3, 3, 3, 3))
    for (i, j), value in numpy.ndenumerate(numpy.linalg.inv(S)):
        C[i, i, j, j] = value
    for (i, j), G in zip(PAIRS[3:], (G12, G13, G23)):
        C[i, j, i, j] = C[i, j, j, i] = C[j, i, i, j] = C[j, i, j, i] = G
    return C


def turned(C, R):
    return numpy.einsum("ai,bj,ck,dl,ijkl->abcd", R, R, R, R, C)


def anisotropic(C):
    values = [C[PAIRS[row] + PAIRS[column]] for column in range(6) for row in range(column + 1)]
    rows = "".join(numbers(values[k:k + 8]) + "\n" for k in (0, 8, 16))
    return f"*MATERIAL, NAME=M\n*ELASTIC, TYPE=ANISOTROPIC\n{rows}*DENSITY\n1600\n"


def engineering(constants):
    return (f"*MATERIAL, NAME=M\n*ELASTIC, TYPE=ENGINEERING CONSTANTS\n{numbers(constants[:8])}\n{numbers(constants[8:])}\n"
            "*DENSITY\n1600\n")


MATERIALS = {
    "orthotropic": CONSTANTS,
    "transversely isotropic": (1.35e11, 1e10, 1e10, 0.3, 0.3, 0.4, 5e9, 5e9, 1e10 / 2.8),
    "cubic": (1.3e11, 1.3e11, 1.3e11, 0.36, 0.36, 0.36, 7.6e10, 7.6e10, 7.6e10),
}


@pytest.mark.parametrize("kind", MATERIALS)
def test_anisotropic_constants_in_any_axes_are_those_of_an_orthotropic_material(frequencies, kind):
    constants, R = MATERIALS[kind], rotation((1, -2, 0.5), 50)
    section = "*SOLID SECTION, ELSET=E, MATERIAL=M{}\n"
    wanted = frequencies(block() + engineering(constants) + orientation("O", R) + section.format(", ORIENTATION=O"))
    own = block() + anisotropic(turned(tensor(constants), R))
    assert frequencies(own + section.format("")) == pytest.approx(wanted, rel=1e-6)
    # In axes of their own.
    Q = rotation((0, 1, 1), -70)
    both = block() + anisotropic(turned(tensor(constants), Q.T @ R)) + orientation("Q", Q)
    assert frequencies(both + section.format(", ORIENTATION=Q")) == pytest.approx(wanted, rel=1e-6)
    upright = frequencies(block() + engineering(constants) + section.format(""))
    assert abs(upright / wanted - 1).max() > 0.02


def test_constants_of_nastran_in_any_axes(frequencies):
    """MAT9 that couples tension and shear, and one without that CORDM turns."""
    R = rotation((1, -2, 0.5), 50)
    order = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0))

    def deck(C, system):
        values = [C[order[row] + order[column]] for row in range(6) for column in range(row, 6)]
        fields = ["MAT9", "1", *(f"{value:.8e}" if value else "0." for value in values), "1600."]
        lines = [",".join(fields[:9])] + ["," + ",".join(fields[k:k + 8]) for k in range(9, len(fields), 8)]
        text = "\n".join(lines) + f"\nPSOLID,1,1,{system}\n"
        text += f"CORD2R,7,,0.,0.,0.,{R[0, 2]!r},{R[1, 2]!r},{R[2, 2]!r}\n,{R[0, 0]!r},{R[1, 0]!r},{R[2, 0]!r}\n"
        for n, line in enumerate(block().split("*ELEMENT")[0].splitlines()[1:]):
            text += f"GRID,{n + 1},,{','.join(line.split(', ')[1:])}\n"
        for k in range(4):
            a = 4 * k + 1
            text += f"CHEXA,{k + 1},1,{a},{a + 1},{a + 3},{a + 2},{a + 4},{a + 5}\n,{a + 7},{a + 6}\n"
        return text + "ENDDATA\n"

    C = tensor(CONSTANTS)
    wanted = frequencies(deck(C, 7), "deck.bdf")
    # Nine digits of the constants.
    assert frequencies(deck(turned(C, R), 0), "deck.bdf") == pytest.approx(wanted, rel=1e-6)


def test_materials_without_planes_of_symmetry_are_refused(refuse):
    section = "*SOLID SECTION, ELSET=E, MATERIAL=M\n"
    C = tensor(CONSTANTS)
    for i, j, k, l in ((0, 0, 0, 1), (1, 1, 0, 2), (2, 2, 1, 2)):
        for a, b in ((i, j), (j, i)):
            for c, d in ((k, l), (l, k)):
                C[a, b, c, d] += 1e9
                C[c, d, a, b] += 1e9
    refuse(block() + anisotropic(C) + section, "deck.inp:", "couples stretch and shear in all axes", "materials: {\"M\": …}")
    deck, _ = plate(numpy.eye(3))
    shell = "*SHELL SECTION, ELSET=E, MATERIAL=M\n0.002\n"
    text = deck.replace(LAMINA, anisotropic(turned(tensor(CONSTANTS), rotation((1, 1, 0), 30))))
    refuse(text + shell, "solids only", "ENGINEERING CONSTANTS")


# ---- boxes

WIDTH, HEIGHT, WALLS = 0.08, 0.06, (0.012, 0.004, 0.003, 0.009)  # walls on the sides of 1, 2, −1, −2
LENGTH, PARTS, YOUNG, NU, DENSITY = 6.0, 24, 2.1e11, 0.3, 7850.0

PUSHED = """buckens: 1
bodies:
  b:
    mesh: {file: deck.inp, length-unit: m, mass-unit: kg}
joints:
  wall: {fixed: {between: [ground, b/n1]}}
loads:
  push: {force: {on: b/n25, value: [0, 100 N, 0]}}
initial: {start: static}
simulation: {duration: 1 us, step: 1 us}
output:
  every: 1 us
  sensors: {tip: {position: b/n25}}
"""


def unequal_box():
    deck = "*NODE\n" + "".join(f"{k + 1}, {LENGTH * k / PARTS!r}, 0, 0\n" for k in range(PARTS + 1))
    deck += "*ELEMENT, TYPE=B31, ELSET=E\n" + "".join(f"{k}, {k}, {k + 1}\n" for k in range(1, PARTS + 1))
    deck += f"*MATERIAL, NAME=M\n*ELASTIC\n{YOUNG}, {NU}\n*DENSITY\n{DENSITY}\n"
    # Direction 1 along y, 2 along z.
    return deck + f"*BEAM SECTION, ELSET=E, MATERIAL=M, SECTION=BOX\n{WIDTH}, {HEIGHT}, {numbers(WALLS)}\n0, 1, 0\n"


def box_plates():
    """Area, centroid and second moments of four plates (centre y, centre z, width, height)."""
    right, top, left, bottom = WALLS
    upright = HEIGHT - top - bottom
    middle = (bottom - top) / 2
    plates = [(WIDTH / 2 - right / 2, middle, right, upright), (left / 2 - WIDTH / 2, middle, left, upright),
              (0, HEIGHT / 2 - top / 2, WIDTH, top), (0, bottom / 2 - HEIGHT / 2, WIDTH, bottom)]
    area = sum(w * h for _, _, w, h in plates)
    y0 = sum(y * w * h for y, _, w, h in plates) / area
    z0 = sum(z * w * h for _, z, w, h in plates) / area
    yy = sum(h * w**3 / 12 + w * h * (y - y0)**2 for y, _, w, h in plates)  # ∫ y²
    zz = sum(w * h**3 / 12 + w * h * (z - z0)**2 for _, z, w, h in plates)
    yz = sum(w * h * (y - y0) * (z - z0) for y, z, w, h in plates)
    return area, (y0, z0), numpy.array([[yy, yz], [yz, zz]])


def test_a_box_with_unequal_walls_lies_and_bends_as_its_plates_say(buckens, frequencies, tmp_path):
    area, centroid, second = box_plates()
    found = frequencies(unequal_box(), count=12)
    for moment in numpy.linalg.eigvalsh(second):
        exact = 4.730041**2 / (2 * math.pi) * math.sqrt(YOUNG * moment / (DENSITY * area * LENGTH**4))
        # Rotary inertia and shear lower it by half of 49.5 I/(A L²) (1 + E/(κG)), κ ≥ 0.3.
        lower = 0.5 * 49.5 * (1 + 2 * (1 + NU) / 0.3) * moment / (area * LENGTH**2)
        assert any(exact * (1 - lower) < f < exact * 1.0001 for f in found), (exact, lower, found)
    told = buckens("mesh-info", "deck.inp", "--json").must(0).json
    assert told["mass"] == pytest.approx(DENSITY * area * LENGTH, rel=1e-9)
    assert told["mass_centre"][1:] == pytest.approx(centroid, rel=1e-9)
    assert "unequal walls" in buckens("mesh-info", "deck.inp").must(0).out
    # A force along y moves the tip along z as well: by the inverse of the second moments.
    (tmp_path / "model.yaml").write_text(PUSHED)
    buckens("run", "model.yaml", "-o", "out", "-q").must(0)
    row = list(csv.DictReader((tmp_path / "out" / "sensors.csv").open()))[-1]
    moved = [float(next(value for key, value in row.items() if key.startswith(f"tip.{axis}"))) for axis in "yz"]
    exact = numpy.linalg.inv(second) @ (100.0, 0.0) * LENGTH**3 / (3 * YOUNG)
    # Shear adds 3 E I/(κ G A L²), κ ≥ 0.3, and 1/(4 n²) is missing in straight elements of shear.
    assert moved == pytest.approx(exact, rel=3e-3)


def test_boxes_without_a_hole_are_refused(refuse):
    refuse(unequal_box().replace(numbers(WALLS), "0.05, 0.004, 0.03, 0.009"), "deck.inp:", "the walls are thicker")
