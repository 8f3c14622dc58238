# SPDX-License-Identifier: Apache-2.0
"""Links between the nodes of one body: rigid links, averages, equations, springs."""

import csv

import numpy
import pytest

# Two beams end to end; their connection, and what is attached at the end, is left open.
MODEL = """
buckens: 1
gravity: [0, 0, 0]
materials: {{steel: {{E: 210 GPa, nu: 0.3, rho: 7850}}}}
sections: {{round: {{circle: {{diameter: 30 mm}}}}}}
bodies:
  arm:
    structure:
      nodes: {{a: [0, 0, 0], b: [1, 0, 0], c: [{c}, 0], d: [{d}, 0]}}
      beams:
        - {{between: [a, b], elements: 4, section: round, material: steel}}
        - {{between: [c, d], elements: 4, section: round, material: steel}}
{more}
"""

TOGETHER = {"c": "1, 0", "d": "2, 0.3"}
APART = {"c": "1.2, 0.1", "d": "2.2, 0.4"}


@pytest.fixture
def frequencies(buckens, tmp_path):
    def call(places, more, count=8):
        (tmp_path / "model.yaml").write_text(MODEL.format(**places, more=more))
        report = buckens("modes", "model.yaml", "--count", count, "--json").must(0).json
        return numpy.array([mode["frequency"] for mode in report["analyses"][0]["modes"]])

    return call


def links(text):
    return f"      links:\n        {text}\n"


def test_a_rigid_link_is_the_limit_of_a_stiff_beam(frequencies):
    rigid = frequencies(APART, links("rigid: [{reference: b, nodes: [c]}]"))
    stiff = frequencies(APART, """\
        - {between: [b, c], section: round, rotary-inertia: off,
           material: {E: 2.1e17 Pa, nu: 0.3, rho: 1e-6}}
""")
    # A million times stiffer than steel: the remaining error is the ratio of lengths over that.
    assert rigid == pytest.approx(stiff, rel=1e-5)


def test_equations_say_what_a_rigid_link_says(frequencies):
    def equation(variable):
        return (f"{{terms: [{{node: b, variable: {variable}}}, "
                f"{{node: c, variable: {variable}, coefficient: -1}}]}}")
    link = frequencies(TOGETHER, links("rigid: [{reference: b, nodes: [c]}]"))
    same = frequencies(TOGETHER, links("equations: [" + ", ".join(
        equation(v) for v in ("x", "y", "z", "rotation-x", "rotation-y", "rotation-z")) + "]"))
    # The same matrices in another order.
    assert same == pytest.approx(link, rel=1e-9)


def test_a_free_hinge_inside_a_body_is_a_mechanism(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(MODEL.format(
        **TOGETHER, more=links("rigid: [{reference: b, nodes: [c], variables: [x, y, z]}]")))
    buckens("check", "model.yaml").must(3, "\"arm\"", "mechanism")


def test_stiff_springs_become_rigid_links(frequencies):
    rigid = frequencies(APART, links("rigid: [{reference: b, nodes: [c]}]"))
    spring = frequencies(APART, links(
        "springs: [{between: [b, c], translation: [1e11, 1e11, 1e11], "
        "rotation: [1e10, 1e10, 1e10]}]"))
    # A hundred thousand times stiffer than the beams; more would cost digits.
    assert spring == pytest.approx(rigid, rel=1e-4)
    soft = frequencies(APART, links(
        "springs: [{between: [b, c], translation: [1e11, 1e11, 1e11], rotation: [1e10, 1e10, 1]}]"))
    # Two arms on a weak hinge: far below the first bending mode.
    assert soft[0] < 0.05 * rigid[0]


PLATE = """
buckens: 1
gravity: [0, 0, 0]
materials: {steel: {E: 210 GPa, nu: 0.3, rho: 7850}}
bodies:
  disc:
    structure:
      nodes: {a: [0, 0, 0], b: [1, 0, 0], c: [1, 1, 0], d: [0, 1, 0], e: [0, 0, 0.5], f: [1, 0, 0.5],
              g: [1, 1, 0.5], h: [0, 1, 0.5], hub: [0.5, 0.5, 0.8]}
      solids: [{element: hex8, nodes: [a, b, c, d, e, f, g, h], material: steel}]
      masses: [{at: hub, mass: 100 kg, inertia: [1, 1, 1]}]
      links: {LINK}
joints:
  pin: {revolute: {between: [ground, disc/hub], axis: [0, 0, 1], at: disc/hub}}
initial: {bodies: {disc: {angular-velocity: [0, 0, 3 rad/s]}}}
simulation: {duration: 0.1 s, step: 1 ms}
output:
  sensors: {hub: {position: disc/hub}, corner: {position: disc/g}, hold: {joint-force: pin}}
"""


@pytest.mark.parametrize("link", ["{averages: [{reference: hub, nodes: [e, f, g, h]}]}",
                                  "{averages: [{reference: hub, nodes: [e, f, g, h], variables: [x, "
                                  "y, z, rotation-x, rotation-y, rotation-z]}]}",
                                  "{rigid: [{reference: hub, nodes: [e, f, g, h]}]}"])
def test_reference_nodes_carry_masses_and_joints(buckens, tmp_path, link):
    text = PLATE.replace("{LINK}", link).replace(", at: disc/hub}}", "}}").replace(
        "ground, disc/hub", "{ground: [0.5, 0.5, 0.8]}, disc/hub")
    (tmp_path / "model.yaml").write_text(text)
    disc = buckens("check", "model.yaml", "--json").must(0).json["bodies"]["disc"]
    assert disc["mass"] == pytest.approx(7850 * 0.5 + 100, rel=1e-12)
    buckens("run", "model.yaml", "-o", "out").must(0)
    rows = list(csv.reader((tmp_path / "out" / "sensors.csv").open()))
    out = dict(zip([name.split(" [")[0] for name in rows[0]], numpy.array(rows[1:], float).T))
    assert numpy.abs(out["hub.x"] - 0.5).max() < 1e-9
    # The corner moves around the axis, 1/sqrt 2 away, by 0.3 rad; its stretch is below 1e-6.
    radius = numpy.hypot(out["corner.x"] - 0.5, out["corner.y"] - 0.5)
    assert radius == pytest.approx(0.5**0.5, abs=1e-6)
    angle = numpy.arctan2(out["corner.y"][-1] - 0.5, out["corner.x"][-1] - 0.5)
    assert angle == pytest.approx(numpy.pi / 4 + 0.3, abs=1e-5)


@pytest.mark.parametrize("more, code, words", [
    ("equations: [{terms: [{node: d, variable: z}]}]", 3,
     ["the equation of line", "holds the body against rigid"]),
    ("equations: [{terms: [{node: d, variable: y}, {node: a, variable: y, coefficient: -1}]}]", 3,
     ["the equation of line", "rigid rotation about"]),
    ("rigid: [{reference: b, nodes: [x]}]", 2, ["unknown node \"x\""]),
    ("averages: [{reference: b, nodes: [c, d], weights: [1]}]", 2, ["1 weights", "2 nodes"]),
    ("averages: [{reference: b, nodes: [c, d]}]", 3, ["the average of line", "on one line"]),
    ("springs: [{between: [d, d], translation: [1, 1, 1]}]", 3, ["both ends are the same node"]),
    ("rigid: [{reference: b, nodes: [c], variables: [w]}]", 2, ["variables"]),
    ("averages: [{reference: b, nodes: [c, d], variables: [u]}]", 2, ["variables"]),
])
def test_impossible_links_are_refused(buckens, tmp_path, more, code, words):
    text = more if more.startswith(("rigid", "averages")) else (
        "rigid: [{reference: b, nodes: [c]}]\n        " + more)
    (tmp_path / "model.yaml").write_text(MODEL.format(**APART, more=links(text)))
    buckens("check", "model.yaml").must(code, *words)


def test_links_and_frames_exclude_each_other(buckens, tmp_path):
    text = MODEL.format(**APART, more=links("rigid: [{reference: b, nodes: [c]}]"))
    (tmp_path / "model.yaml").write_text(text + "    frames: 2\n")
    buckens("check", "model.yaml").must(3, "\"arm\"", "links", "frames")


DECK = """BEGIN BULK
GRID,1,,0.,0.,0.
GRID,2,,100.,0.,0.
GRID,3,,100.,100.,0.
GRID,4,,0.,100.,0.
GRID,5,,50.,50.,30.
GRID,6,,50.,50.,0.
GRID,7,,50.,50.,30.
CQUAD4,1,1,1,2,3,4
PSHELL,1,1,5.,1
MAT1,1,210000.,,.3,7.85-9
RBE2,10,5,123456,1,2,3,4
RBE3,11,,6,123456,1.,123,1,2
,3,4
CONM2,12,6,,1.-3,10.,0.,0.
CONM2,13,7,,2.-3
,1.,,1.,,,1.
PBUSH,20,K,100.,100.,100.,1.+5,1.+5,1.+5
CBUSH,21,20,5,7,,,,0
ENDDATA
"""


def test_links_springs_and_masses_of_a_deck_are_used(buckens, tmp_path):
    (tmp_path / "part.bdf").write_text(DECK)
    (tmp_path / "model.yaml").write_text(
        "buckens: 1\nbodies: {part: {mesh: {file: part.bdf, length-unit: mm}}}\n")
    part = buckens("check", "model.yaml", "--json").must(0).json["bodies"]["part"]
    plate, beside, above = 0.3925, 1.0, 2.0
    mass = plate + beside + above
    assert part["mass"] == pytest.approx(mass, rel=1e-9)
    assert part["com"] == pytest.approx(
        [(plate * 0.05 + beside * 0.06 + above * 0.05) / mass, 0.05, above * 0.03 / mass], rel=1e-9)
    # Everything is rigid except the spring between two points: one mass on another, six frequencies.
    report = buckens("modes", "model.yaml", "--count", 6, "--json").must(0).json
    found = [mode["frequency"] for mode in report["analyses"][0]["modes"]]
    along_z = numpy.sqrt(1e5 / (above * (mass - above) / mass)) / (2 * numpy.pi)
    # The mass beside the axis of the spring makes it turn as well: near, and never below 90 %.
    assert min(abs(f - along_z) for f in found) < 0.1 * along_z
