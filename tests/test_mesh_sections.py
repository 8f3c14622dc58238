# SPDX-License-Identifier: Apache-2.0
"""Shells and beams of Gmsh and universal files, with sections given in the model file."""

import numpy
import pytest

MATERIALS = """
materials:
  steel: {E: 200 GPa, nu: 0.3, rho: 7850 kg/m^3}
  ply: {orthotropic: {E1: 135 GPa, E2: 10 GPa, E3: 10 GPa, nu12: 0.3, nu13: 0.3, nu23: 0.45, G12: 5 GPa,
                      G13: 5 GPa, G23: 3.4 GPa}, rho: 1600 kg/m^3}
"""


def msh(nodes, elements, names=()):
    """A mesh of version 2.2. elements: (type, group, nodes), names: (dimension, group, name)."""
    out = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
    if names:
        out += f"$PhysicalNames\n{len(names)}\n"
        out += "".join(f'{d} {g} "{n}"\n' for d, g, n in names) + "$EndPhysicalNames\n"
    out += f"$Nodes\n{len(nodes)}\n"
    out += "".join(f"{k + 1} {x!r} {y!r} {z!r}\n" for k, (x, y, z) in enumerate(nodes))
    out += f"$EndNodes\n$Elements\n{len(elements)}\n"
    out += "".join(f"{k + 1} {kind} 2 {group} 1 {' '.join(map(str, ids))}\n"
                   for k, (kind, group, ids) in enumerate(elements))
    return out + "$EndElements\n"


def plate(nx, ny, size, element, group):
    """The plate that `mesh: {plate: ...}` generates, with the ribs of the line y = size/2."""
    number = lambda i, j: 1 + i + (nx + 1) * j
    nodes = [(size[0] * i / nx, size[1] * j / ny, 0.0) for j in range(ny + 1) for i in range(nx + 1)]
    elements = []
    for j in range(ny):
        for i in range(nx):
            a, b, c, d = number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)
            if element == "quad4":
                elements.append((3, group, (a, b, c, d)))
            elif (i + j) % 2 == 0:
                elements += [(2, group, (a, b, c)), (2, group, (a, c, d))]
            else:
                elements += [(2, group, (a, b, d)), (2, group, (b, c, d))]
    ribs = [(1, 2, (number(i, ny // 2), number(i + 1, ny // 2))) for i in range(nx)]
    return nodes, elements, ribs


@pytest.fixture
def frequencies(buckens, tmp_path):
    def call(body, count=8, name="model.yaml"):
        (tmp_path / name).write_text("buckens: 1\n" + MATERIALS + "bodies:\n  part:\n" + body)
        report = buckens("modes", name, "--count", count, "--json").must(0).json
        return numpy.array([mode["frequency"] for mode in report["analyses"][0]["modes"]])

    return call


@pytest.mark.parametrize("element", ["quad4", "tri3"])
@pytest.mark.parametrize("section", [
    "thickness: 10 mm",
    "thickness: 10 mm, offset: 4 mm",
    "layers: [{thickness: 4 mm, angle: 30 deg, material: ply}, {thickness: 2 mm, angle: -60 deg, "
    "material: ply}], direction: [1, 1, 0]"])
def test_a_plate_of_gmsh_vibrates_as_a_generated_one(frequencies, tmp_path, element, section):
    nodes, elements, _ = plate(5, 3, (1.0, 0.6), element, 1)
    (tmp_path / "plate.msh").write_text(msh(nodes, elements, [(2, 1, "skin")]))
    read = frequencies(f"    mesh: {{file: plate.msh, material: steel, sections: {{skin: {{{section}}}}}}}\n")
    made = frequencies("    mesh:\n      plate: {size: [1 m, 0.6 m], divisions: [5, 3], element: "
                       f"{element}, {section}}}\n      material: steel\n")
    assert read == pytest.approx(made, rel=1e-9)  # rounding of another order of the same sums


def test_shells_without_a_group_take_the_section_for_all(frequencies, tmp_path):
    nodes, elements, _ = plate(4, 2, (1000.0, 600.0), "quad4", 0)
    (tmp_path / "plate.msh").write_text(msh(nodes, elements))
    read = frequencies("    mesh: {file: plate.msh, length-unit: mm, section: {thickness: 8 mm, "
                       "material: steel}}\n")
    made = frequencies("    mesh: {plate: {size: [1 m, 0.6 m], divisions: [4, 2], thickness: 8 mm}, "
                       "material: steel}\n")
    assert read == pytest.approx(made, rel=1e-9)


@pytest.mark.parametrize("theory", ["euler-bernoulli", "timoshenko"])
def test_a_beam_of_gmsh_vibrates_as_a_generated_one(frequencies, tmp_path, theory):
    nodes = [(0.125 * k, 0.0, 0.0) for k in range(9)]
    (tmp_path / "beam.msh").write_text(
        msh(nodes, [(1, 7, (k + 1, k + 2)) for k in range(8)], [(1, 7, "spar")]))
    read = frequencies("    mesh: {file: beam.msh, sections: {spar: {beam: {rectangle: {width: 20 mm, height: "
                       f"40 mm}}}}, up: [0, 1, 0], theory: {theory}, material: steel}}}}}}\n")
    made = frequencies("    beam: {to: [1 m, 0, 0], elements: 8, section: {rectangle: {width: 20 mm, height: "
                       f"40 mm}}}}, up: [0, 1, 0], theory: {theory}, material: steel}}\n")
    assert read == pytest.approx(made, rel=1e-9)


def test_ribs_on_a_plate_become_beams(frequencies, tmp_path):
    """Lines that are edges of shells are elements if the model gives them a section."""
    nodes, elements, ribs = plate(2, 2, (1.0, 0.6), "quad4", 1)
    (tmp_path / "plate.msh").write_text(msh(nodes, elements + ribs, [(1, 2, "ribs"), (2, 1, "skin")]))
    read = frequencies("    mesh: {file: plate.msh, material: steel, sections: {skin: {thickness: 5 mm}, "
                       "ribs: {beam: {circle: {diameter: 30 mm}}}}}\n")
    shells = "".join(f"        - {{nodes: [{', '.join(f'p{n}' for n in e[2])}], thickness: 5 mm, material: steel}}\n"
                     for e in elements)
    beams = "".join(f"        - {{between: [p{a}, p{b}], section: {{circle: {{diameter: 30 mm}}}}, material: steel}}\n"
                    for _, _, (a, b) in ribs)
    points = "".join(f"        p{k + 1}: [{x}, {y}, {z}]\n" for k, (x, y, z) in enumerate(nodes))
    made = frequencies(f"    structure:\n      nodes:\n{points}      shells:\n{shells}      beams:\n{beams}")
    assert read == pytest.approx(made, rel=1e-9)
    bare = frequencies("    mesh: {file: plate.msh, material: steel, sections: {skin: {thickness: 5 mm}}}\n")
    assert bare[0] < 0.9 * read[0]


def test_a_skin_on_a_block_adds_its_mass(buckens, tmp_path):
    nodes = [(x, y, z) for z in (0.0, 0.1) for x, y in ((0.0, 0.0), (0.2, 0.0), (0.2, 0.3), (0.0, 0.3))]
    (tmp_path / "block.msh").write_text(msh(
        nodes, [(5, 1, (1, 2, 3, 4, 5, 6, 7, 8)), (3, 2, (5, 6, 7, 8))], [(3, 1, "core"), (2, 2, "skin")]))
    text = "buckens: 1\n" + MATERIALS + ("bodies: {part: {mesh: {file: block.msh, material: steel%s}, interfaces: "
                                         "{top: {face: skin}}}}\n")
    (tmp_path / "bare.yaml").write_text(text % "")
    (tmp_path / "coated.yaml").write_text(text % ", sections: {skin: {thickness: 2 mm}}")
    bare, coated = (buckens("check", f"{name}.yaml", "--json").must(0).json["bodies"]["part"]
                    for name in ("bare", "coated"))
    assert bare["mass"] == pytest.approx(7850 * 0.006, rel=1e-12)
    assert coated["mass"] == pytest.approx(7850 * (0.006 + 0.2 * 0.3 * 0.002), rel=1e-12)
    # The skin is still a face for interfaces.
    assert coated["interfaces"]["top"]["area"] == pytest.approx(0.06, rel=1e-12)


def test_pressure_acts_on_shells_of_gmsh(buckens, tmp_path):
    nodes, elements, _ = plate(2, 2, (1.0, 0.6), "quad4", 1)
    (tmp_path / "plate.msh").write_text(msh(nodes, elements, [(2, 1, "skin")]))
    (tmp_path / "model.yaml").write_text(
        "buckens: 1\n" + MATERIALS + "bodies: {part: {mesh: {file: plate.msh, material: steel, section: "
        "{thickness: 5 mm}}}}\nloads: {wind: {pressure: {on: part/skin, value: 1 kPa}}}\n")
    load = buckens("check", "model.yaml", "--json").must(0).json["distributed_loads"]["wind"]
    # Pressure pushes against the side to which the normals point, here +z.
    assert load["force"] == pytest.approx([0, 0, -600], rel=1e-12, abs=1e-9)


def test_point_masses_and_links_of_the_model(frequencies, tmp_path):
    nodes = [(0.25 * k, 0.0, 0.0) for k in range(5)] + [(0.5, 0.2, 0.0)]
    (tmp_path / "beam.msh").write_text(
        msh(nodes, [(1, 7, (k + 1, k + 2)) for k in range(4)], [(1, 7, "spar")]))
    mesh = ("    mesh: {file: beam.msh, material: steel, section: {beam: {circle: {diameter: 30 mm}}}, "
            "masses: [{at: %s, mass: 2 kg, inertia: [0.1, 0.1, 0.1]%s}]%s}\n")
    beside = frequencies(mesh % ("n3", ", offset: [0, 0.2, 0]", ""))
    # The same with a node of the file that is not used otherwise.
    linked = frequencies(mesh % ("n6", "", ", links: {rigid: [{reference: n3, nodes: [n6]}]}"))
    assert beside == pytest.approx(linked, rel=1e-9)


def test_shells_and_lines_in_no_group(frequencies, buckens, tmp_path):
    """A plate with a beam behind it, without and with groups: the same body; without sections each is asked for."""
    nodes, elements, _ = plate(2, 2, (1.0, 0.6), "quad4", 1)
    corner = max(range(len(nodes)), key=lambda k: nodes[k][0] + nodes[k][1]) + 1
    nodes += [(1.0 + 0.25 * k, 0.6 + 0.1 * k, 0.1) for k in (1, 2)]
    lines = [(1, (corner, len(nodes) - 1)), (1, (len(nodes) - 1, len(nodes)))]
    named = elements + [(kind, 7, ends) for kind, ends in lines]
    (tmp_path / "named.msh").write_text(msh(nodes, named, [(2, 1, "skin"), (1, 7, "spar")]))
    (tmp_path / "bare.msh").write_text(msh(nodes, [(kind, 0, ends) for kind, _, ends in named], []))
    mesh = "    mesh: {file: %s, material: steel, %s}\n"
    beam = "{beam: {rectangle: {width: 20 mm, height: 30 mm}}}"
    wanted = frequencies(mesh % ("named.msh", "sections: {skin: {thickness: 5 mm}, spar: %s}" % beam))
    bare = frequencies(mesh % ("bare.msh", "section: {thickness: 5 mm}, sections: {lines: %s}" % beam))
    assert bare == pytest.approx(wanted, rel=1e-9)
    (tmp_path / "model.yaml").write_text("buckens: 1\n" + MATERIALS + "bodies: {part: {mesh: {file: bare.msh, material: "
                                         "steel, section: {thickness: 5 mm}}}}\n")
    buckens("check", "model.yaml").must(2, 'of "lines" have no cross-section', 'sections: {"lines": {beam:')


WRONG = [
    ("material: steel", ["plate.msh", 'the quadrangle elements of "skin" have no thickness',
                         'sections: {"skin": {thickness: 2 mm}}']),
    ("material: steel, sections: {skim: {thickness: 2 mm}}", ["model.yaml:7:", 'Did you mean "skin"?']),
    ("material: steel, sections: {skin: {beam: {circle: {diameter: 2 mm}}}}", ["no lines in \"skin\""]),
    ("material: steel, sections: {skin: {thickness: 2 mm, beam: {circle: {diameter: 2 mm}}}}",
     ["exactly one of the keys thickness, layers, beam and bar"]),
    ("material: steel, sections: {skin: {bar: {circle: {diameter: 2 mm}}, offset: 1 mm}}",
     ["offset", "belongs to shells"]),
    ("material: steel, sections: {skin: {thickness: 2 mm, up: [0, 0, 1]}}", ["up", "belongs to beams"]),
    ("material: steel, sections: {skin: {thickness: 2 mm, direction: [1, 0, 0], along-first-side: on}}",
     ["along-first-side", "already determines"]),
    ("sections: {skin: {thickness: 2 mm}}", ['the quadrangle elements of "skin" have no material']),
    ("material: steel, section: {thickness: 2 mm}, masses: [{at: n77, mass: 1}]", ['no node "n77"', "such as"]),
]


@pytest.mark.parametrize("keys, words", WRONG)
def test_what_is_wrong_is_said(buckens, tmp_path, keys, words):
    nodes, elements, _ = plate(2, 2, (1.0, 0.6), "quad4", 1)
    (tmp_path / "plate.msh").write_text(msh(nodes, elements, [(2, 1, "skin")]))
    (tmp_path / "model.yaml").write_text("buckens: 1\n" + MATERIALS +
                                         f"bodies: {{part: {{mesh: {{file: plate.msh, {keys}}}}}}}\n")
    buckens("check", "model.yaml").must(2, *words)


def test_generated_meshes_take_no_sections(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(
        "buckens: 1\n" + MATERIALS + "bodies: {part: {mesh: {plate: {size: [1, 1], divisions: [2, 2], thickness: "
        "0.01}, material: steel, section: {thickness: 2 mm}}}}\n")
    buckens("check", "model.yaml").must(2, "section", "only meshes from files")
    (tmp_path / "model.yaml").write_text(
        "buckens: 1\n" + MATERIALS + "bodies: {part: {mesh: {file: plate.msh, material: steel, section: {thickness: "
        "2 mm}}, geometric-stiffness: on}}\n")
    nodes, elements, _ = plate(2, 2, (1.0, 0.6), "quad4", 1)
    (tmp_path / "plate.msh").write_text(msh(nodes, elements))
    buckens("check", "model.yaml").must(2, "geometric-stiffness", "this mesh has none")
