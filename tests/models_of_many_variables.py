# SPDX-License-Identifier: Apache-2.0
"""Bodies large enough to be distributed over processes, of each kind of elements and links (test_mpi.py).

They are as small as tests of results allow (mpi_runs.ENVIRONMENT says from how many variables on bodies are distributed); those
of memory take larger ones.
"""

import json

SHELL_SIDE = 24


def shells(side=SHELL_SIDE):
    return f"""\
buckens: 1
title: A plate large enough to be distributed
gravity: [0, 0, -9.81]
materials: {{steel: {{E: 210 GPa, nu: 0.3, rho: 7850}}}}
bodies:
  plate:
    at: {{position: [0, -0.1, 0]}}
    mesh: {{plate: {{size: [0.2, 0.2], divisions: [{side}, {side}], thickness: 2 mm}}, material: steel}}
    interfaces: {{edge: {{set: [x0]}}}}
joints: {{hinge: {{revolute: {{between: [ground, plate/edge], axis: [0, 1, 0]}}}}}}
simulation: {{duration: 0.5 ms, step: 0.1 ms}}
output: {{every: 0.1 ms, sensors: {{force: {{joint-force: hinge}}, corner: {{position: plate/corner_11}}}}}}
"""


SHELLS = shells()


GRID_SIDE = 26


def grid_of_beams(side=GRID_SIDE):
    """A square grid of beams, with bars, shells, masses and springs: each kind of elements that a body can have but solids."""

    def node(i, j):
        return f"n{i}_{j}"

    places = [(i, j) for i in range(side) for j in range(side)]
    nodes = {node(i, j): [0.01 * i, 0.01 * j, 0.0003 * ((3 * i + 5 * j) % 7)] for i, j in places}
    beams = []
    for i, j in places:
        for a, b in ((i + 1, j), (i, j + 1)):
            if a < side and b < side:
                of = {"end-section": {"rectangle": {"width": 0.002, "height": 0.003}}} if (i + j) % 5 == 0 else {}
                theory = {"theory": "timoshenko"} if j % 3 == 0 else {}
                beams.append({"between": [node(i, j), node(a, b)], "section": "strip", "material": "steel", **of, **theory})
    within = [(i, j) for i, j in places if i + 1 < side and j + 1 < side]
    bars = [{"between": [node(i, j), node(i + 1, j + 1)], "area": 1e-6, "material": "steel"} for i, j in within if i % 4 == 1]
    shells = [{"nodes": [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)], "thickness": 0.0005, "material": "steel"}
              for i, j in within if j % 6 == 2]
    masses = [{"at": node(i, j), "mass": 0.003} for i, j in places if (i * j) % 37 == 5]
    springs = [{"between": [node(i, j), node(i + 1, j + 1)], "translation": [1e4, 2e4, 3e4], "rotation": [1, 2, 3]}
               for i, j in within if j % 9 == 4]
    return json.dumps({
        "buckens": 1, "title": "A grid of beams large enough to be distributed", "gravity": [0, 0, -9.81],
        "materials": {"steel": {"E": 210e9, "nu": 0.3, "rho": 7850, "damping": {"stiffness": 1e-5}}},
        "sections": {"strip": {"rectangle": {"width": 0.003, "height": 0.002}}},
        "bodies": {"grid": {"structure": {"nodes": nodes, "beams": beams, "bars": bars, "shells": shells, "masses": masses,
                                          "links": {"springs": springs}}}},
        "joints": {"hinge": {"revolute": {"between": ["ground", f"grid/{node(0, 0)}"], "axis": [0, 1, 0]}}},
        "simulation": {"duration": 0.0005, "step": 0.0001},
        "output": {"every": 0.0001, "sensors": {"force": {"joint-force": "hinge"}, "corner": {"position": f"grid/{node(side - 1, side - 1)}"}}}})


def linked_grid(side=GRID_SIDE):
    """The same with links of each kind, one of which leaves a node motions that nothing holds."""
    model = json.loads(grid_of_beams(side))
    structure = model["bodies"]["grid"]["structure"]
    half, last = side // 2, side - 3

    def place(i, j, height):
        return [0.01 * i, 0.01 * j, height]

    structure["nodes"].update({"hub": place(half, half, 0.05), "mean": place(half, half - 3, 0.02),
                               "twin": structure["nodes"][f"n5_{last}"], "far": place(5, side, 0.01)})
    structure["beams"].append({"between": ["twin", "far"], "elements": 2, "section": "strip", "material": "steel"})
    structure["masses"].append({"at": "hub", "mass": 0.1, "inertia": [1e-5, 1e-5, 1e-5]})
    variables = ("x", "y", "z", "rotation-x", "rotation-y", "rotation-z")
    structure["links"].update({
        "rigid": [{"reference": "hub", "nodes": [*(f"n{i}_{j}" for i in (half - 1, half + 1) for j in (half - 1, half + 1)), f"n10_{last}"]}],
        "averages": [{"reference": "mean", "nodes": ["n3_3", f"n{last}_3", f"n{half}_{last}", f"n{last}_{last}"], "variables": ["z"]}],
        "equations": [{"terms": [{"node": "twin", "variable": v}, {"node": f"n5_{last}", "variable": v, "coefficient": -1}]} for v in variables]})
    model["output"]["sensors"].update({"hub": {"position": "grid/hub"}, "mean": {"position": "grid/mean"}})
    return json.dumps(model)


def deck_with_links(side=11):
    """A cube of solids with what decks have in place of joints: a spider on one face, a mass on the mean of another."""
    at = {}
    lines = []
    for i, j, k in ((i, j, k) for k in range(side + 1) for j in range(side + 1) for i in range(side + 1)):
        at[i, j, k] = len(at) + 1
        lines.append(f"GRID,{at[i, j, k]},,{0.1 * i / side:.6f},{0.1 * j / side:.6f},{0.1 * k / side:.6f}")
    corners = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
    for e, (i, j, k) in enumerate((i, j, k) for k in range(side) for j in range(side) for i in range(side)):
        nodes = [at[i + a, j + b, k + c] for a, b, c in corners]
        lines.append(f"CHEXA,{e + 1},1,{','.join(map(str, nodes[:6]))}\n,{nodes[6]},{nodes[7]}")

    def continued(card, words):
        words = card.split(",") + [str(word) for word in words]
        return "\n".join([",".join(words[:9])] + ["," + ",".join(words[k:k + 8]) for k in range(9, len(words), 8)])

    def face(i):
        return [at[i, j, k] for j in range(side + 1) for k in range(side + 1)]

    hub, end = len(at) + 1, len(at) + 2
    lines += [f"GRID,{hub},,-0.02,0.05,0.05", f"GRID,{end},,0.13,0.05,0.05", f"CONM2,90001,{end},,0.5"]
    lines += [continued(f"RBE2,90002,{hub},123456", face(0)), continued(f"RBE3,90003,,{end},123456,1.,123", face(side))]
    return "\n".join([*lines, "PSOLID,1,1", "MAT1,1,2.1E11,,0.3,7850.", "ENDDATA", ""])


DECK = """\
buckens: 1
title: A cube of a deck large enough to be distributed
gravity: [0, -9.81, 0]
bodies:
  cube:
    at: {position: [0.02, -0.05, -0.05]}
    mesh: {file: cube.bdf, length-unit: m, mass-unit: kg}
    damping: {mass: 20, stiffness: 0.01 ms}
    markers: {hub: {position: [-0.02, 0.05, 0.05]}, end: {position: [0.13, 0.05, 0.05]}}
joints: {hinge: {revolute: {between: [ground, cube/hub], axis: [0, 0, 1]}}}
simulation: {duration: 0.5 ms, step: 0.1 ms}
output: {every: 0.1 ms, sensors: {force: {joint-force: hinge}, end: {position: cube/end}}}
"""

SIDE = 10


def cube(side=SIDE):
    return f"""\
buckens: 1
title: A cube large enough to be distributed
gravity: [0, -9.81, 0]
materials: {{steel: {{E: 210 GPa, nu: 0.3, rho: 7850}}}}
bodies:
  cube:
    at: {{position: [0, -0.05, -0.05]}}
    mesh: {{box: {{size: [0.1, 0.1, 0.1], divisions: [{side}, {side}, {side}], element: hex8}}, material: steel}}
    interfaces: {{bearing: {{face: x0}}}}
joints: {{ball: {{spherical: {{between: [ground, cube/bearing]}}}}}}
simulation: {{duration: 0.5 ms, step: 0.1 ms}}
output: {{every: 0.1 ms, sensors: {{force: {{joint-force: ball}}, corner: {{position: cube/corner_111}}}}}}
"""


CUBE = cube()

# Two of them, which have one factor.
TWINS = CUBE.replace("joints:", "  other:\n    like: cube\n    at: {position: [0.2, -0.05, -0.05]}\njoints:").replace(
    "{ball: {spherical: {between: [ground, cube/bearing]}}}",
    "{ball: {spherical: {between: [ground, cube/bearing]}}, second: {spherical: {between: [ground, other/bearing]}}}").replace(
    "{position: cube/corner_111}", "{position: cube/corner_111}, far: {position: other/corner_111}")

# A ball strikes the face opposite the bearing within the second step.
BLOW = CUBE.replace("bearing: {face: x0}", "bearing: {face: x0}, struck: {face: x1}").replace("joints:", """\
  shot: {rigid: {mass: 0.2 kg, inertia: [1e-4, 1e-4, 1e-4]}, at: {position: [0.12015, 0, 0]}}
initial: {bodies: {shot: {velocity: [-1, 0, 0]}}}
loads: {hit: {contact: {between: [cube/struck, shot], shapes: [{sphere: 10 mm}, {sphere: 10 mm}], restitution: 0.5}}}
joints:""").replace("sensors: {", "sensors: {speed: {velocity: shot}, lost: {energy: impacts}, ")

# One that turns so fast that loads of its inertia deform it, as it is softer.
SPUN = CUBE.replace("E: 210 GPa", "E: 50 MPa").replace(
    "joints:", "initial: {bodies: {cube: {velocity: [0, 1.5, 0], angular-velocity: [0, 0, 30]}}}\njoints:")

# A force that readings of sensors drive, one of them sampled in each step, with which accelerations jump.
FELT = CUBE.replace("simulation:", """\
signals:
  felt: {sensor: shake}
  held: {sensor: {of: force, component: y}}
  kept: {sample-hold: {input: felt, sample: 0.1 ms}}
  whole: {sensor: all}
  push: "20 - 0.01*kept + 0.05*held + 1e3*whole"
loads: {push: {force: {on: cube/corner_111, value: [0, 1 N, 0], signal: push}}}
simulation:""").replace(
    "sensors: {", "sensors: {shake: {acceleration: {of: cube/corner_011, along: [0, 1, 0]}}, push: {signal: push}, all: {energy: kinetic}, ")

# A force that stresses of some elements drive: of those at a node, of one alone, and of all at the bearing.
STRESSED = CUBE.replace("simulation:", """\
signals: {at_node: {sensor: at_node}, alone: {sensor: alone}, around: {sensor: around}, push: "20 + 1e-3*at_node - 2e-3*alone + 3e-3*around"}
loads: {push: {force: {on: cube/corner_111, value: [0, 1 N, 0], signal: push}}}
simulation:""").replace("sensors: {", """sensors: {at_node: {stress: cube/corner_011}, alone: {stress: {of: cube, element: 500}}, around: {stress: cube/bearing},
    near: {position: cube/corner_011}, push: {signal: push}, """)

# Forces that the largest stress of all elements drives.
LARGEST = CUBE.replace("simulation:", """\
signals: {largest: {sensor: largest}, push: "20 + 1e-6*largest"}
loads: {push: {force: {on: cube/corner_111, value: [0, 1 N, 0], signal: push}}}
simulation:""").replace("sensors: {", "sensors: {largest: {stress: cube}, push: {signal: push}, ")
LARGEST_AND_ONE = LARGEST.replace("push:", "alone: {sensor: alone}, push:", 1).replace("1e-6*largest", "1e-6*largest - 1e-3*alone").replace(
    "{stress: cube}", "{stress: cube}, alone: {stress: {of: cube, element: 500}}")
LARGEST_OF_SHELLS = SHELLS.replace("simulation:", """\
signals: {largest: {sensor: largest}, push: "1 + 1e-7*largest"}
loads: {push: {force: {on: plate/corner_11, value: [0, 0, 1 N], signal: push}}}
simulation:""").replace("sensors: {", "sensors: {largest: {stress: plate}, push: {signal: push}, ")


def stressed_grid():
    """One that section forces and stresses drive of elements whose nodes follow others, among them a shell."""
    model = json.loads(linked_grid())
    half = GRID_SIDE // 2
    # Of each node along x but for the last ones come the beams along x and y; the first of these has a node of the spider.
    at_spider = (2 * GRID_SIDE - 1) * (half - 1) + 2 * (half - 1) + 1
    structure = model["bodies"]["grid"]["structure"]
    first_shell = sum(beam.get("elements", 1) for beam in structure["beams"]) + len(structure["bars"]) + 1
    model["output"]["sensors"].update({
        "section": {"section-force": {"of": "grid", "element": at_spider}}, "beam": {"stress": {"of": "grid", "element": at_spider}},
        "shell": {"stress": {"of": "grid", "element": first_shell + 7}}, "push": {"signal": "push"}})
    model["signals"] = {"shear": {"sensor": {"of": "section", "component": "force.Qz"}},
                        "bending": {"sensor": {"of": "section", "component": "moment.My"}},
                        "beam": {"sensor": {"of": "beam", "component": "mises"}}, "shell": {"sensor": "shell"},
                        "push": "0.1 + 0.1*shear + bending + 1e-8*beam + 1e-8*shell"}
    model["loads"] = {"push": {"force": {"on": f"grid/n{half}_{half}", "value": [0, 0, 1], "signal": "push"}}}
    return json.dumps(model)


# Two shafts with bearings in the cube, which a cross connects.
SHAFTS = CUBE.replace("bearing: {face: x0}", "bearing: {face: x0}, near: {face: y0}, far: {face: y1}").replace("joints: {", """\
  input: {rigid: {mass: 0.5 kg, inertia: [1e-4, 2e-4, 1e-4]}, at: {position: [0.05, -0.05, 0]}, markers: {end: {position: [0, 0.1, 0]}}}
  output: {rigid: {mass: 0.5 kg, inertia: [1e-4, 2e-4, 1e-4]}, at: {position: [0.05, 0.05, 0]}}
initial: {joints: {first: {speed: 50}}}
joints: {first: {revolute: {between: [cube/near, input], axis: [0, 1, 0]}},
  second: {cylindrical: {between: [cube/far, output], axis: [0, 0.96, 0.28]}},
  cross: {universal: {between: [input/end, output], axis: [1, 0, 0], second-axis: [0, -0.28, 0.96]}}, """)
