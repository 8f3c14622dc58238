# SPDX-License-Identifier: Apache-2.0
"""A run continued from a saved state equals the uninterrupted one, bit for bit."""

import csv
import json
import pathlib
import shutil

import pytest

MODELS = pathlib.Path(__file__).parent / "models"

SLIDER_CRANK = """buckens: 1
planar: xy
parameters: {r: 150 mm, L: 300 mm, speed: 150}
materials: {steel: {E: 200 GPa, nu: 0.3, rho: 7870 kg/m^3, damping: {stiffness: 1e-6 s}}}
bodies:
  crank:
    rigid: {mass: 0.36 kg, com: ["r/2", 0, 0], inertia: [0, 0, 2.727e-3 kg m^2]}
    markers: {shaft: {position: [0, 0, 0]}, pin: {position: [r, 0, 0]}}
  rod:
    beam: {to: [L, 0, 0], elements: 8, section: {circle: {diameter: 8 mm}}, material: steel}
    at: {position: [r, 0, 0]}
    ROD
  slider:
    rigid: {mass: 33 g, inertia: [0, 0, 1e-6 kg m^2]}
    at: {position: ["r + L", 0, 0]}
joints:
  shaft: {revolute: {between: [ground, crank/shaft]}}
  motor: {prescribed-rotation: {between: [ground, crank/shaft], angle: "speed*t rad"}}
  big_end: {revolute: {between: [crank/pin, rod/start]}}
  small_end: {revolute: {between: [rod/end, slider]}}
  guide: {prismatic: {between: [ground, slider], axis: [1, 0, 0]}}
loads:
  leg: {spring-damper: {between: [ground, slider], stiffness: 2000 N/m, damping: 1 N s/m, length: 0.4 m}}
simulation: {duration: 60 ms, step: 0.2 ms, STEP}
output:
  every: 0.7 ms
  sensors:
    turned: {relative: {between: [ground, crank], quantity: angle}}
    moved: {displacement: slider}
    mid: {deflection: {of: rod/mid, from: chord}}
    guide: {joint-force: guide}
    balance: {energy: balance}
"""

# Three parallel cranks on one coupler: which of the joint equations are independent changes as they
# turn, so that others are chosen in between (verification/row_selection).
CRANKS = (MODELS / "parallel_cranks.yaml").read_text().replace("step: 5 ms", "step: 5 ms, STEP")

# A block on a hinge in space, with stresses and their extremes over the run.
BLOCK = """buckens: 1
gravity: [0, 0, -9.81]
materials: {steel: {E: 2 GPa, nu: 0.3, rho: 7870 kg/m^3}}
bodies:
  block:
    mesh: {box: {size: [0.4, 0.05, 0.05], divisions: [4, 1, 1]}, material: steel}
    interfaces: {root: {face: x0}}
    ROD
joints: {hinge: {revolute: {between: [ground, block/root], axis: [0, 1, 0]}}}
simulation: {duration: 40 ms, step: 0.5 ms, STEP}
output:
  every: 1 ms
  fields: {record: [von-mises], every: 3 ms, extremes: steps}
  sensors: {hinge: {joint-force: hinge}}
"""


def model(text, rod="", step=""):
    return text.replace("ROD", rod).replace(", STEP", ", " + step if step else "")


# Laws with memory: friction that sticks and slides, a stop, and an angle counted over turns.
LAWS = SLIDER_CRANK.replace("simulation:", """  rub: {slide-friction: {joint: guide, static: 0.2, dynamic: 0.1, stribeck-velocity: 1 m/s}}
  drag: {hinge-friction: {joint: big_end, static: 0.3, radius: 10 mm, preload: 0.1 N m}}
  stop: {slide-stop: {joint: guide, from: -290 mm, stiffness: 2e4 N/m, damping: 20 N s/m}}
simulation:""", 1).replace("  sensors:", "  sensors:\n    turns: {joint-coordinate: shaft}", 1)


# Rigid rows: a stop with impacts, friction that sticks without motion, a rope that comes taut.
RIGID = SLIDER_CRANK.replace("simulation:", """  rub: {hinge-friction: {joint: big_end, static: 0.3, radius: 10 mm, preload: 0.1 N m, stick: rigid}}
  buffer: {slide-stop: {joint: way, from: -20 mm, to: 20 mm, restitution: 0.6}}
  leash: {rope: {between: [crank/shaft, ball], length: 0.48 m, restitution: 0.3}}
simulation:""", 1).replace("joints:\n", """  ball: {rigid: {mass: 50 g, inertia: [0, 0, 1e-6]}, at: {position: ["r + L", 0, 0]}}
joints:
  way: {prismatic: {between: [slider, ball], axis: [1, 0, 0]}}
""", 1)


# A pin with clearance: the strain of friction, the speed of approach and where the bodies stood are states.
CLEARANCE = SLIDER_CRANK.replace("joints:", """  idler: {rigid: {mass: 50 g, inertia: [0, 0, 1e-6]}, at: {position: ["r + L", 0, 0]}}
joints:""", 1).replace("simulation:", """  worn: {contact: {between: [slider, idler], shapes: [{socket: 11 mm}, {sphere: 10 mm}], stiffness: 1e7, exponent: 1.5, restitution: 0.7, static: 0.2}}
simulation:""", 1).replace("  sensors:", "  sensors:\n    hit: {contact: worn}", 1)


# Balls with spin that bounce, slide and roll on a rigid floor, and strike each other.
ROUGH = """buckens: 1
gravity: [0, 0, -9.81]
bodies:
  a: {rigid: {mass: 1 kg, inertia: [4e-3, 4e-3, 4e-3]}, at: {position: [0, 0, 0.12]}}
  b: {rigid: {mass: 2 kg, inertia: [8e-3, 8e-3, 8e-3]}, at: {position: [0.5, 0.02, 0.1]}}
loads:
  under: {contact: {between: [ground, a], shapes: [{plane: {}}, {sphere: 0.1}], restitution: 0.4, static: 0.3}}
  below: {contact: {between: [ground, b], shapes: [{plane: {}}, {sphere: 0.1}], static: 0.1}}
  knock: {contact: {between: [a, b], shapes: [{sphere: 0.1}, {sphere: 0.1}], restitution: 0.8, static: 0.2}}
initial: {bodies: {a: {velocity: [2, 0.1, 0], angular-velocity: [3, -30, 5]}, b: {velocity: [0.2, 0, 0]}}}
simulation: {duration: 0.6 s, step: 1 ms, STEP}
output: {every: 7 ms, sensors: {a: {position: a}, b: {velocity: b}, w: {angular-velocity: a}, c: {contact: under}, lost: {energy: dissipated}}}
"""

# A double pendulum whose elbow strikes its stop.
ELBOW = """buckens: 1
gravity: [0, -9.81, 0]
planar: xy
bodies:
  upper: {rigid: {mass: 1 kg, com: [0.5, 0, 0], inertia: [0, 0, 0.08]}, markers: {b: {position: [1, 0, 0]}}}
  lower: {rigid: {mass: 1 kg, com: [0.5, 0, 0], inertia: [0, 0, 0.08]}, at: {position: [1, 0, 0]}}
joints:
  shoulder: {revolute: {between: [ground, upper/origin]}}
  elbow: {revolute: {between: [upper/b, lower/origin]}}
loads: {stop: {hinge-stop: {joint: elbow, from: -40 deg, to: 60 deg, restitution: 0.5}}}
simulation: {duration: 2 s, step: 5 ms, tolerance: 1e-4}
output: {every: 20 ms, sensors: {elbow: {joint-coordinate: elbow}, lost: {energy: dissipated}}}
"""

# Blocks with states, sampled ones among them, and a motor at its limit.
CONTROL = SLIDER_CRANK.replace("  motor: {prescribed", "  drive: {prescribed").replace("loads:", """signals:
  way: {joint-displacement: guide}
  i: {integral: {input: "(0.1 + way - 2*i)/0.002"}}
  u: {pid: {input: "-0.2 - way", proportional: 500, integral: 4e4, derivative: 0.5, filter: 1 ms, limits: [-60, 60]}}
  held: {sample-hold: {input: "20*way", sample: 0.4 ms}}
loads:
  servo: {slide-motor: {joint: guide, force: "u + 100*i + held", force-limit: 40 N}}""", 1).replace(
      "  sensors:", "  sensors:\n    i: {signal: i}\n    u: {signal: u}", 1)


# A drive whose speed follows a controller, and gears that rattle in their backlash.
DRIVEN = SLIDER_CRANK.replace('angle: "speed*t rad"', 'speed: w').replace("loads:", """  pin: {revolute: {between: [{ground: [0, 0.1, 0]}, wheel]}}
signals:
  way: {joint-displacement: guide}
  w: {lag: {input: "speed*(1 + 2*way)", time-constant: 5 ms}}
loads:
  teeth: {elastic-gear: {between: [crank/shaft, wheel], teeth: [30, 20], stiffness: 1e6 N/m, damping: 20 N s/m, backlash: 0.2 mm}}""", 1).replace(
    "joints:", "  wheel: {rigid: {mass: 1 kg, inertia: [0, 0, 1e-3]}, at: {position: [0, 0.1, 0]}}\njoints:", 1)


# Settings, locks and switches by events before and after the state is saved, and a joint that lets go.
EVENTS = SLIDER_CRANK.replace("loads:", """  way: {prismatic: {between: [slider, ball], axis: [1, 0, 0]}}
  hook: {fixed: {between: [rod/mid, weight]}}
signals:
  push: {setting: 0}
  early: "t - 0.0153"
  late: "t - 0.0411"
events:
  one: {when: early, set: {push: 3}, lock: way, release: hook}
  two: {when: late, set: {push: "-2*push"}, unlock: way, switch-off: leg, record: on}
loads:
  shove: {slide-motor: {joint: way, force: "push"}}""", 1).replace("joints:", """  ball: {rigid: {mass: 50 g, inertia: [0, 0, 1e-6]}, at: {position: ["r + L", 0, 0]}}
  weight: {rigid: {mass: 5 g, inertia: [0, 0, 1e-7]}, at: {position: ["r + L/2", 0, 0]}}
joints:""", 1)


# A slider that passes nodes of a flexible rail, on a spring along it.
SLIDER = """buckens: 1
gravity: [0, 0, -9.81]
materials: {steel: {E: 200 GPa, nu: 0.3, rho: 7870 kg/m^3}}
bodies:
  rail: {beam: {to: [1, 0.2, -0.1], elements: 10, section: {circle: {diameter: 20 mm}}, material: steel}ROD}
  bead: {rigid: {mass: 0.3 kg, inertia: [1e-3, 1e-3, 1e-3]}, at: {position: [0.1, 0.02, -0.01]}}
  disc: {rigid: {mass: 0.2 kg, inertia: [1e-3, 1e-3, 2e-3]}, at: {position: [0, 0, "0.1*sin(80*pi/180)"], orientation: {euler: [80 deg, 0, 0]}}}
joints:
  root: {fixed: {between: [ground, rail/start]}}
  hole: {slider-on-beam: {between: [rail, bead]}}
  floor: {rolling: {between: [ground, disc], normal: [0, 0, 1], axle: [0, 0, 1], radius: 0.1}}
loads: {spring: {slide-spring: {joint: hole, stiffness: 30 N/m, displacement: 0.4 m}}}
initial: {bodies: {bead: {velocity: [1, 0.2, -0.1]}, disc: {velocity: [0.5, 0, 0], angular-velocity: [0, 1, -5]}}}
simulation: {duration: 0.4 s, step: 1 ms, STEP}
output: {every: 7 ms, sensors: {way: {joint-coordinate: hole}, hole: {joint-force: hole}, disc: {position: disc}}}
"""

# A slider that bounces between rigid stops on a flexible rail, rubs without slip, is locked and set free, and pulls a sled.
BUFFERS = """buckens: 1
gravity: [0, 0, -9.81]
materials: {steel: {E: 200 GPa, nu: 0.3, rho: 7870 kg/m^3, damping: {stiffness: 1e-5 s}}}
bodies:
  rail: {beam: {to: [1, 0.2, -0.1], elements: 10, section: {circle: {diameter: 20 mm}}, material: steel}, ROD}
  bead: {rigid: {mass: 0.3 kg, inertia: [1e-3, 1e-3, 1e-3]}, at: {position: [0.1, 0.02, -0.01]}}
  sled: {rigid: {mass: 0.1 kg, inertia: [1e-3, 1e-3, 1e-3]}, at: {position: [0, 1, 0]}}
joints:
  root: {fixed: {between: [ground, rail/start]}}
  hole: {slider-on-beam: {between: [rail, bead]}}
  way: {prismatic: {between: [ground, sled], axis: [1, 0, 0]}}
  string: {coupler: {of: {hole: 1, way: -1}}}
signals: {early: "t - 0.101", late: "t - 0.153"}
events: {catch: {when: early, lock: hole}, free: {when: late, unlock: hole}}
loads:
  spring: {slide-spring: {joint: hole, stiffness: 400 N/m, displacement: 0.3 m}}
  ends: {slide-stop: {joint: hole, from: -50 mm, to: 0.2 m, restitution: 0.5}}
  rub: {slide-friction: {joint: hole, static: 0.2, stick: rigid}}
initial: {joints: {hole: {velocity: 1}}}
simulation: {duration: 0.3 s, step: 1 ms, STEP}
output: {every: 7 ms, sensors: {way: {joint-coordinate: hole}, hole: {joint-force: hole}, ends: {spring-force: ends}, lost: {energy: dissipated}}}
"""

# Two arms on balls that rub by bristles.
BRISTLES = """buckens: 1
gravity: [0, 0, -9.81]
bodies:
  arm: {rigid: {mass: 1, inertia: [2e-3, 2e-3, 1e-4]}, at: {position: [0.1, 0, 0]}, markers: {o: {position: [-0.1, 0, 0]}, e: {position: [0.1, 0, 0]}}}
  bob: {rigid: {mass: 0.5, inertia: [1e-4, 2e-4, 2e-4]}, at: {position: [0.25, 0, 0]}, markers: {o: {position: [-0.05, 0, 0]}}}
joints: {hang: {spherical: {between: [ground, arm/o]}}, link: {spherical: {between: [arm/e, bob/o]}}}
loads:
  a: {ball-friction: {joint: hang, static: 0.2, radius: 10 mm, stick: bristles, bristle-stiffness: 200 N m/rad, bristle-damping: 0.1 N m s/rad}}
  b: {ball-friction: {joint: link, static: 0.2, radius: 8 mm, stick: bristles, bristle-stiffness: 100 N m/rad, elastic-share: 0}}
initial: {bodies: {arm: {velocity: [0, 0.8, -0.2], angular-velocity: [0, 2, 8]}, bob: {velocity: [0, 1.6, -0.4]}}}
simulation: {duration: 0.3 s, step: 1 ms, STEP}
output: {every: 7 ms, sensors: {p: {position: bob}, w: {angular-velocity: arm}, rub: {spring-torque: a}, lost: {energy: dissipated}}}
"""

# A bead that is driven around a closed spline, one that a spring pulls over laps and a stop throws back, a puck and a ball joint.
COORDINATES = """buckens: 1
gravity: [0, 0, -9.81]
bodies:
  led: {rigid: {mass: 0.3 kg, inertia: [1e-3, 1e-3, 1e-3]}, at: {position: [0.1, 0, 0]}}
  free: {rigid: {mass: 0.2 kg, inertia: [1e-3, 1e-3, 1e-3]}, at: {position: [0.1, 0, 0]}}
  puck: {rigid: {mass: 0.2 kg, inertia: [1e-3, 1e-3, 2e-3]}, at: {position: [0, 1, 0]}}
  rod: {rigid: {mass: 1 kg, com: [0, 0, -0.3], inertia: [0.03, 0.03, 0.001]}, markers: {top: {position: [0, 0, 0]}}, at: {orientation: {euler: [0.3 rad, 0, 0]}}}
joints:
  hoop: {slot: {between: [ground, led], closed: on, path: [[0.1, 0, 0], [0, 0.08, 0.02], [-0.1, 0, 0], [0, -0.12, 0.01]]}}
  loop: {slot: {between: [ground, free], closed: on, path: [[0.1, 0, 0], [0, 0.08, 0.02], [-0.1, 0, 0], [0, -0.12, 0.01]]}}
  ice: {planar: {between: [ground, puck], axis: [0, 0, 1]}}
  ball: {spherical: {between: [ground, rod/top], axis: [0, 0, -1], second-axis: [0, 0.29552020666133955, -0.955336489125606]}}
  drive: {prescribed-coordinate: {joint: hoop, velocity: "3 + lagged"}}
signals:
  swing: {joint-coordinate: {joint: ball, which: swing}}
  lagged: {lag: {input: "5*swing", time-constant: 20 ms}}
loads:
  pull: {slide-spring: {joint: loop, stiffness: 4 N/m, displacement: 2 m}}
  end: {slide-stop: {joint: loop, to: 1.2 m, restitution: 0.6}}
  wide: {slide-spring: {joint: ice, which: x, stiffness: 40 N/m}}
  long: {slide-spring: {joint: ice, which: "y", stiffness: 90 N/m}}
  wind: {hinge-spring: {joint: ball, which: twist, stiffness: 0.2}}
  cone: {hinge-stop: {joint: ball, which: swing, to: 0.35, stiffness: 500 N m/rad, damping: 1 N m s/rad}}
initial: {joints: {ice: {x: 20 mm, y-velocity: 0.3, speed: 9}, ball: {twist: 0.5}}, bodies: {rod: {velocity: [0.4, 0, 0]}}}
simulation: {duration: 0.6 s, step: 1 ms, STEP}
output: {every: 7 ms, sensors: {led: {joint-coordinate: hoop}, way: {joint-coordinate: loop}, puck: {position: puck}, twist: {joint-coordinate: {joint: ball, which: twist}}, swing: {joint-coordinate: {joint: ball, which: swing}}, hoop: {joint-force: hoop}}}
"""

# Six balls meet, hit a floor and one another.
HEAP = """buckens: 1
gravity: [0, 0, -9.81]
bodies:
  b0: {rigid: {mass: 0.5, inertia: [5e-4, 5e-4, 5e-4]}, at: {position: [0.0, 0.0, 0.06]}}
  b1: {rigid: {mass: 0.5, inertia: [5e-4, 5e-4, 5e-4]}, at: {position: [0.03, 0.01, 0.165]}}
  b2: {rigid: {mass: 0.5, inertia: [5e-4, 5e-4, 5e-4]}, at: {position: [0.0, 0.02, 0.27]}}
  b3: {rigid: {mass: 0.5, inertia: [5e-4, 5e-4, 5e-4]}, at: {position: [0.03, 0.0, 0.375]}}
  b4: {rigid: {mass: 0.5, inertia: [5e-4, 5e-4, 5e-4]}, at: {position: [0.0, 0.01, 0.48]}}
  b5: {rigid: {mass: 0.5, inertia: [5e-4, 5e-4, 5e-4]}, at: {position: [0.03, 0.02, 0.585]}}
loads: {heap: {contacts: {among: [{on: ground, plane: {}}, {bodies: "b*", sphere: 50 mm}], stiffness: 2e4, restitution: 0.6, static: 0.3}}}
simulation: {duration: 0.3 s, step: 1 ms, STEP}
output: {every: 7 ms, sensors: {p: {position: b3}, v: {velocity: b5}, heap: {contact: heap}}}
"""

# The surface of a soft block on a plane, and balls that hit both: patches that touch, speeds of approach and strains of friction.
SURFACES = """buckens: 1
gravity: [0, 0, -9.81]
materials: {rubber: {E: 5 MPa, nu: 0.3, rho: 1200}}
bodies:
  block:
    mesh: {box: {size: [0.1, 0.1, 0.1], divisions: [2, 2, 2]}, material: rubber}
    interfaces: {foot: {face: z0}}
    at: {position: [0, 0, 0.003]}
    ROD
  b1: {rigid: {mass: 0.2, inertia: [1e-4, 1e-4, 1e-4]}, at: {position: [0.052, 0.048, 0.16]}}
  b2: {rigid: {mass: 0.2, inertia: [1e-4, 1e-4, 1e-4]}, at: {position: [0.16, 0.04, 0.05]}}
loads: CONTACT
initial: {bodies: {b1: {velocity: [0.1, -0.05, -0.5]}, b2: {velocity: [-0.4, 0, 0]}}}
simulation: {duration: 0.24 s, step: 1 ms, STEP}
output: {every: 7 ms, sensors: {p: {position: b1}, v: {velocity: b2}, w: {angular-velocity: b1}, foot: {position: block/foot}}}
"""
LAW = "stiffness: 2e4, restitution: 0.5, static: 0.3"
GROUPED = SURFACES.replace("CONTACT", f"""
  all: {{contacts: {{among: [{{on: ground, plane: {{}}}}, {{on: block/foot, surface: {{}}}}, {{bodies: "b?", sphere: 40 mm}}], {LAW}}}}}""")
PAIRS = SURFACES.replace("CONTACT", f"""
  floor: {{contact: {{between: [ground, block/foot], shapes: [{{plane: {{}}}}, {{surface: {{}}}}], {LAW}}}}}
  top: {{contact: {{between: [block/foot, b1], shapes: [{{surface: {{}}}}, {{sphere: 40 mm}}], {LAW}}}}}
  side: {{contact: {{between: [block/foot, b2], shapes: [{{surface: {{}}}}, {{sphere: 40 mm}}], {LAW}}}}}
  under: {{contact: {{between: [ground, b2], shapes: [{{plane: {{}}}}, {{sphere: 40 mm}}], {LAW}}}}}""")

# A rope that slips over two pulleys while an end swings around one of them, and a closed belt.
CABLES = """buckens: 1
planar: xy
gravity: [0, -9.81, 0]
bodies:
  light: {rigid: {mass: 1, inertia: [0, 0, 1e-3]}, at: {position: [-0.1, -1, 0]}}
  heavy: {rigid: {mass: 4, inertia: [0, 0, 1e-3]}, at: {position: [0.6, -1, 0]}}
  wheel: {rigid: {mass: 1, inertia: [0, 0, 0.01]}}
  fan: {rigid: {mass: 1, inertia: [0, 0, 0.02]}, at: {position: [0, 0.5, 0]}}
joints:
  axle: {revolute: {between: [ground, wheel]}}
  shaft: {revolute: {between: [{ground: [0, 0.5, 0]}, fan]}}
loads:
  rope: {cable: {ends: [light, heavy], pulleys: [{on: wheel, radius: 0.1, side: right}, {on: {ground: [0.5, 0, 0]}, radius: 0.1, side: right}], stiffness: 1e5, damping-time: 0.2 ms, pretension: 15, friction: 0.3}}
  belt: {cable: {pulleys: [{on: wheel, radius: 0.05}, {on: fan, radius: 0.08}], stiffness: 1e4, damping-time: 1 ms, pretension: 5, friction: 0.2}}
initial: {bodies: {light: {velocity: [0.3, 0, 0]}}}
simulation: {duration: 0.3 s, step: 0.5 ms, STEP}
output: {every: 7 ms, sensors: {a: {position: light}, rope: {cable: rope}, belt: {cable: belt}, w: {angular-velocity: fan}}}
"""

# A follower that flies off its cam, a cross joint turned about both arms, a weld where an event found its bodies.
MORE = """buckens: 1
gravity: [0, -9.81, 0]
bodies:
  disc: {rigid: {mass: 1, inertia: [0.01, 0.01, 0.01]}}
  follower: {rigid: {mass: 0.4, inertia: [1e-4, 1e-4, 1e-4]}, at: {position: [0, 0.0979795897113271, 0]}}
  fork: {rigid: {mass: 1, com: [0.1, 0, 0], inertia: [0.01, 0.02, 0.03]}, at: {position: [1, 0, 0]}, markers: {hole: {position: [0, 0, 0]}, tip: {position: [0.2, 0.1, 0]}}}
  stone: {rigid: {mass: 0.1, inertia: [1e-4, 1e-4, 1e-4]}, at: {position: [1.4, 0.5, 0.1]}}
joints:
  shaft: {revolute: {between: [ground, disc/origin], axis: [0, 0, 1]}}
  motor: {prescribed-rotation: {between: [ground, disc/origin], axis: [0, 0, 1], speed: 30 rad/s}}
  guide: {prismatic: {between: [ground, follower], axis: [0, 1, 0]}}
  cross: {universal: {between: [{ground: [1, 0, 0]}, fork/hole], axis: [0, 1, 0], second-axis: [0, 0, 1]}}
  grip: {fixed: {between: [fork/tip, stone], as-found: on}}
signals: {now: "t - 0.05", tilt: {joint-second-angle: cross}}
events: {take: {when: now, attach: grip}}
loads:
  cam: {cam: {between: [disc/origin, follower], normal: [0, 0, 1], closed: on, start: [120 mm, 0, 0], restitution: 0.3,
              segments: [{arc: [-80 mm, 0, 0], through: [20 mm, 100 mm, 0]}, {arc: [120 mm, 0, 0], through: [20 mm, -100 mm, 0]}]}}
  twist: {hinge-motor: {joint: cross, torque: "2 + tilt"}}
  spring: {hinge-spring: {joint: cross, which: second-angle, stiffness: 2, damping: 0.01}}
initial: {released: [grip], bodies: {disc: {angular-velocity: [0, 0, 30]}, follower: {velocity: [0, 0.6, 0]}, stone: {velocity: [0, 0.5, 0]}}}
simulation: {duration: 0.4 s, step: 0.5 ms, STEP}
output: {every: 7 ms, sensors: {y: {position: follower}, push: {spring-force: cam}, one: {joint-coordinate: cross}, two: {joint-coordinate: {joint: cross, which: second-angle}}, stone: {position: stone}}}
"""

# Gears, belts, racks, nuts and sliders that events attach wherever they have come to.
MESHING = """buckens: 1
gravity: [0, -10, 0]
materials: {steel: {E: 200 GPa, nu: 0.3, rho: 7850 kg/m^3, damping: {stiffness: 2e-4 s}}}
bodies:
  one: {rigid: {mass: 2, inertia: [0.03, 0.03, 0.03]}}
  two: {rigid: {mass: 3, inertia: [0.05, 0.05, 0.05]}, at: {position: [0.3, 0, 0]}}
  fan: {rigid: {mass: 1, inertia: [0.02, 0.02, 0.02]}, at: {position: [0, 0.5, 0]}}
  bar: {rigid: {mass: 1, inertia: [0.02, 0.02, 0.02]}, at: {position: [0, -0.1, 0]}}
  nut: {rigid: {mass: 1, inertia: [0.01, 0.01, 0.01]}, at: {position: [0, 0, 2]}}
  wire: {beam: {from: [0, 2, 0], to: [4, 2, 0], elements: 8, section: {circle: {diameter: 60 mm}}, material: steel}}
  bead: {rigid: {mass: 1, inertia: [1e-3, 1e-3, 1e-3]}, at: {position: [0.5, 2.2, 0]}}
joints:
  a: {revolute: {between: [ground, one], axis: [0, 0, 1]}}
  b: {revolute: {between: [{ground: [0.3, 0, 0]}, two], axis: [0, 0, 1]}}
  c: {revolute: {between: [{ground: [0, 0.5, 0]}, fan], axis: [0, 0, 1]}}
  way: {prismatic: {between: [{ground: [0, -0.1, 0]}, bar], axis: [1, 0, 0]}}
  rod: {cylindrical: {between: [{ground: [0, 0, 2]}, nut], axis: [0, 0, 1]}}
  left: {fixed: {between: [{ground: [0, 2, 0]}, wire/start]}}
  teeth: {gear: {between: [one, two], axis: [0, 0, 1], teeth: [20, 40], pressure-angle: 20 deg, helix-angle: 10 deg}}
  belt: {belt: {between: [one, fan], axis: [0, 0, 1], radii: [0.1, 0.05]}}
  rack: {rack: {between: [bar, one], axis: [0, 0, 1], along: [1, 0, 0], radius: 0.1}}
  thread: {screw: {between: [{ground: [0, 0, 2]}, nut], axis: [0, 0, 1], pitch: 20 mm}}
  hole: {slider-on-beam: {between: [wire, bead]}}
signals: {first: "t - 0.0513", second: "t - 0.0771", third: "t - 0.11", low: {position: {of: bead, along: [0, 1, 0]}}, above: "low - 2"}
events: {go: {when: first, attach: [teeth, thread]}, on: {when: second, attach: [belt, rack]}, off: {when: third, release: [teeth, belt]},
         catch: {when: above, direction: falling, attach: hole, tolerance: 20 mm}}
initial: {released: [teeth, belt, rack, thread, hole], joints: {a: {speed: 40}, b: {speed: -7}, c: {speed: 3}, rod: {speed: 31, velocity: 0.4}}, bodies: {bead: {velocity: [1.5, 0, 0]}}}
simulation: {duration: 0.4 s, step: 0.5 ms, STEP}
output: {every: 7 ms, sensors: {a: {joint-coordinate: a}, b: {joint-coordinate: b}, c: {joint-coordinate: c}, way: {joint-coordinate: way}, nut: {position: nut}, bead: {position: bead}, teeth: {joint-force: teeth}}}
"""

# Small bodies that step side by side: the parts of a beam, with more frames than lanes, and links in space.
BEAM = """buckens: 1
PLANE
gravity: [0, -9.81, 0]
bodies:
  rod:
    beam: {to: [0.6, 0.3, 0], elements: 11, section: {circle: {diameter: 8 mm}}, material: {E: 70 GPa, nu: 0.3, rho: 2700, damping: {mass: 0.1}}}
    frames: per-element
joints: {pin: {PIN: {between: [ground, rod/start]}}}
simulation: {duration: 60 ms, step: 0.2 ms, STEP}
output: {every: 0.7 ms, sensors: {tip: {position: rod/end}, mid: {deflection: {of: rod/mid, from: chord}}, pin: {joint-force: pin}, balance: {energy: balance}}}
"""
ON_ROD = """loads:
  push: {force: {on: rod/end, value: [0, "2 * sin(200 * t) N", 0], axes: following}}
  twist: {torque: {on: rod/mid, value: [0, 0, 0.1 N m]}}
  wind: {line-load: {on: rod, value: [1 N/m, "-3 * (1 - exp(-100 * t)) N/m", 0]}}
"""
PLANAR = BEAM.replace("PLANE", "planar: xy").replace("PIN", "revolute")
SPATIAL = BEAM.replace("PLANE\n", "").replace("PIN", "spherical")
LINKS = "buckens: 1\ngravity: [0, -9.81, 2]\nbodies:\n" + "".join(
    f"  b{k}: {{rigid: {{mass: 1, com: [0.05, 0, 0], inertia: [1e-4, 1e-3, 1e-3]}}, at: {{position: [{k / 10}, 0, 0]}}, "
    "markers: {a: {position: [0, 0, 0]}, b: {position: [0.1, 0, 0]}}}\n" for k in range(10)) + "joints:\n" + "".join(
        f"  j{k}: {{revolute: {{between: [{f'b{k - 1}/b' if k else 'ground'}, b{k}/a], axis: [0, {k % 2}, {1 - k % 2}]}}}}\n"
        for k in range(10)) + """simulation: {duration: 0.3 s, step: 1 ms, STEP}
output: {every: 7 ms, sensors: {tip: {position: b9}, turns: {joint-coordinate: j3}, j5: {joint-force: j5}}}
"""

CASES = {
    "strands in the plane": (model(PLANAR), 0.0301),
    "strands in the plane, step control": (model(PLANAR.replace("60 ms", "10 ms"), step="tolerance: 1e-4"), 0.0051),
    "strands in the plane, hht": (model(PLANAR, step="method: hht"), 0.0301),
    "strands in space": (model(SPATIAL), 0.0301),
    "strands in space, threads": (model(SPATIAL), 0.0301),
    "strands of links": (model(LINKS), 0.1501),
    "strands with loads": (model(PLANAR) + ON_ROD, 0.0301),
    "strands of links, step control": (model(LINKS, step="tolerance: 1e-4"), 0.1501),
    "surfaces in contact": (model(PAIRS), 0.1011),
    "surfaces in contact, reduced": (model(PAIRS, "reduction: {craig-bampton: 4}"), 0.1011),
    "surfaces in contact, step control": (model(PAIRS, step="tolerance: 1e-2"), 0.1011),
    "surfaces in groups": (model(GROUPED), 0.1011),
    "surfaces in groups, newmark": (model(GROUPED, step="method: newmark"), 0.1011),
    "cables": (model(CABLES), 0.1501),
    "cables, newmark": (model(CABLES, step="method: newmark"), 0.1501),
    "cables, step control": (model(CABLES, step="tolerance: 1e-4"), 0.1501),
    "cams, crosses, grips": (model(MORE), 0.1501),
    "cams, crosses, grips before": (model(MORE), 0.0301),
    "cams, crosses, grips, step control": (model(MORE, step="tolerance: 1e-4"), 0.1501),
    "meshing before": (model(MESHING), 0.0301),
    "meshing": (model(MESHING), 0.0901),
    "meshing, released again": (model(MESHING), 0.1501),
    "meshing, newmark": (model(MESHING, step="method: newmark"), 0.0901),
    "meshing, step control": (model(MESHING, step="tolerance: 1e-4"), 0.1501),
    "a slider and a wheel": (model(SLIDER), 0.2),
    "a slider and a wheel, newmark": (model(SLIDER, step="method: newmark"), 0.2),
    "rigid rows along a rail": (model(BUFFERS), 0.051),
    "rigid rows along a rail, locked": (model(BUFFERS, "frames: 3"), 0.12),
    "rigid rows along a rail, hht": (model(BUFFERS, step="method: hht"), 0.2),
    "bristles of balls": (model(BRISTLES), 0.15),
    "bristles of balls, hht": (model(BRISTLES, step="method: hht"), 0.15),
    "bristles of balls, step control": (model(BRISTLES, step="tolerance: 1e-4"), 0.15),
    "coordinates by name": (model(COORDINATES), 0.3),
    "coordinates by name, hht": (model(COORDINATES, step="method: hht"), 0.3),
    "coordinates by name, step control": (model(COORDINATES, step="tolerance: 1e-4"), 0.3),
    "rigid rows": (model(RIGID), 0.0301),
    "rigid contact with friction": (model(ROUGH), 0.3001),
    "rigid contact with friction, step control": (model(ROUGH, step="tolerance: 1e-4"), 0.3001),
    "rigid rows, step control": (model(ELBOW), 1.31),
    "laws of joint coordinates": (model(LAWS), 0.0301),
    "contact": (model(CLEARANCE), 0.0301),
    "contacts of many bodies": (model(HEAP), 0.151),
    "contacts of many bodies, step control": (model(HEAP, step="tolerance: 1e-4"), 0.151),
    "blocks": (model(CONTROL), 0.03),
    "a drive by signals and gears with backlash": (model(DRIVEN), 0.0301),
    "a drive by signals and gears, newmark": (model(DRIVEN, step="method: newmark"), 0.0301),
    "a drive by signals and gears, step control": (model(DRIVEN, step="tolerance: 1e-2"), 0.0301),
    "events": (model(EVENTS), 0.0301),
    "events, step control": (model(EVENTS, step="tolerance: 1e-2"), 0.0301),
    "blocks, newmark": (model(CONTROL, step="method: newmark"), 0.03),
    "laws, newmark": (model(LAWS, step="method: newmark"), 0.0301),
    "laws, step control": (model(LAWS, step="tolerance: 1e-2"), 0.03),
    **{f"method {m}": (model(SLIDER_CRANK, step=f"method: {m}"), 0.0301)
       for m in ("generalized-alpha", "newmark", "hht", "wilson")},
    "without projection": (model(SLIDER_CRANK, step="method: newmark, projection: off"), 0.03),
    "iterated coupling": (model(SLIDER_CRANK, step="iterate-coupling: on"), 0.03),
    # Half a turn, in which steps become longer and shorter.
    "step control": (model(SLIDER_CRANK.replace("60 ms", "20 ms"), step="tolerance: 1e-4"), 0.01),
    "step control early": (model(SLIDER_CRANK.replace("60 ms", "20 ms"), step="tolerance: 1e-4"), 1e-6),
    "step control, newmark": (model(SLIDER_CRANK.replace("60 ms", "20 ms"), step="tolerance: 1e-4, method: newmark"), 0.007),
    "frames": (model(SLIDER_CRANK, "frames: 3"), 0.03),
    "frames per element": (model(SLIDER_CRANK, "frames: per-element"), 0.03),
    "free-free": (model(SLIDER_CRANK, "reduction: {free-free: 4}"), 0.03),
    "craig-bampton": (model(SLIDER_CRANK, "reduction: {craig-bampton: 4}"), 0.03),
    "quasi-static": (model(SLIDER_CRANK, "flexibility: quasi-static"), 0.03),
    **{f"coupling {level}": (model(SLIDER_CRANK, f"coupling: {level}"), 0.03)
       for level in ("full", "first-order", "none", "auto", "noquad", "nocor")},
    "geometric stiffness": (model(SLIDER_CRANK, "geometric-stiffness: on"), 0.03),
    "first step": (model(SLIDER_CRANK), 0.0002),
    "cranks before": (model(CRANKS), 0.1),
    "cranks, other rows": (model(CRANKS), 0.3),
    "cranks after": (model(CRANKS), 1.0),
    "cranks late": (model(CRANKS), 2.0),
    "cranks, hht": (model(CRANKS, step="method: hht"), 1.0),
    "cranks, step control": (model(CRANKS, step="tolerance: 1e-5"), 1.2),
    # 180 degrees: the state is saved where fewer rows are in use, for one step.
    "cranks, at the dead centre": (model(CRANKS, step="tolerance: 1e-5"), 0.46625),
    "block": (model(BLOCK), 0.0102),
    "block, free-free": (model(BLOCK, "reduction: {free-free: 6}"), 0.02),
    "block, threads": (model(BLOCK, step="tolerance: 1e-4"), 0.02),
}


def rows(directory):
    with open(directory / "sensors.csv") as file:
        lines = [row for row in csv.reader(file) if row and not row[0].startswith("#")]
    return [row for row in lines if row[0][0].isdigit()]


@pytest.fixture(scope="module")
def uninterrupted(tmp_path_factory):
    """Where the whole run of a model and the state at its end are: several cases stop the same one at different times."""
    made = {}

    def call(buckens, text):
        if text not in made:
            place = made[text] = tmp_path_factory.mktemp("whole")
            (place / "model.yaml").write_text(text)
            buckens("run", "model.yaml", "-q", "-o", "whole", "--save-state", "whole.state", cwd=place).must(0)
        return made[text]

    return call


@pytest.mark.parametrize("name", CASES)
def test_a_resumed_run_is_the_uninterrupted_one(buckens, uninterrupted, tmp_path, name):
    text, t = CASES[name]
    (tmp_path / "model.yaml").write_text(text)
    threads = ("--threads", 2) if "threads" in name else ()
    end = uninterrupted(buckens, text)
    buckens("run", "model.yaml", "-q", "-o", "first", "--save-state", "half.state",
            "--save-state-at", t).must(0)
    buckens("run", "model.yaml", "-q", "-o", "rest", "--start-from", "half.state", "--save-state",
            "end.state", *threads).must(0)

    whole, rest = rows(end / "whole"), rows(tmp_path / "rest")
    assert rows(tmp_path / "first") == whole  # saving changes nothing
    assert 1 < len(rest) < len(whole) or t < 1e-3
    assert float(rest[0][0]) > t
    assert rest == whole[-len(rest):]
    # Everything on which later steps depend, and what the summary reports of the whole run.
    assert (tmp_path / "end.state").read_bytes() == (end / "whole.state").read_bytes()
    summaries = [json.loads((d / "summary.json").read_text()) for d in (end / "whole", tmp_path / "rest")]
    for key in ("steps", "residuals", "energy_error", "newton_iterations"):
        assert summaries[0][key] == summaries[1][key], key


def test_rows_were_chosen_anew(buckens, tmp_path):
    """Checks the purpose of the case of the cranks: other rows are in use later than at the start."""
    h5py = pytest.importorskip("h5py")
    (tmp_path / "model.yaml").write_text(model(CRANKS))
    chosen = []
    for t in (0.1, 0.3, 0.6, 1.1, 1.6):
        buckens("run", "model.yaml", "-q", "-o", "out", "--save-state", "s", "--save-state-at",
                t).must(0)
        with h5py.File(tmp_path / "s") as file:
            names = bytes(file["counts/names"][:]).decode().split("\n")
            lengths = file["counts/lengths"][:]
            at = names.index("march/ladder/rung/0/rows_in_use")
            first = sum(lengths[:at])
            chosen.append(list(file["counts/values"][first:first + lengths[at]]))
    assert any(rows != chosen[0] for rows in chosen)


def test_a_finished_run_goes_on_when_it_is_made_longer(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(model(SLIDER_CRANK))
    buckens("run", "model.yaml", "-q", "-o", "long").must(0)
    short = ("--set", "simulation.duration=30 ms")
    buckens("run", "model.yaml", "-q", "-o", "a", *short, "--save-state", "s").must(0)
    buckens("run", "model.yaml", "-q", "-o", "b", *short, "--start-from", "s").must(
        2, "s: the state is that at the end of the run", "simulation.duration")
    buckens("run", "model.yaml", "-q", "-o", "b", "--start-from", "s").must(0)
    rest = rows(tmp_path / "b")
    assert rest == rows(tmp_path / "long")[-len(rest):]


def test_another_model_is_refused_by_name(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(model(SLIDER_CRANK))
    buckens("run", "model.yaml", "-q", "-o", "out", "--save-state", "s", "--save-state-at",
            0.01).must(0)
    run = ("run", "model.yaml", "-q", "-o", "next", "--start-from", "s")
    buckens(*run, "--set", "bodies.rod.beam.elements=6").must(
        2, "s: the state belongs to another model", "bodies.rod.beam.elements was 8, is 6")
    buckens(*run, "--set", "simulation.step=0.1 ms").must(2, "simulation.step was 0.0002, is 0.0001")
    buckens(*run, "--set", "joints.motor.prescribed-rotation.angle=140*t rad").must(
        2, "joints.motor.prescribed-rotation.angle was")


def test_files_that_are_no_states_are_refused(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(model(SLIDER_CRANK))
    buckens("run", "model.yaml", "-q", "-o", "out", "--save-state", "s", "--save-state-at",
            0.01).must(0)
    run = ("run", "model.yaml", "-q", "-o", "next", "--start-from")
    buckens(*run, "none").must(5, "none")
    buckens(*run, "model.yaml").must(5, "this is no saved state")
    buckens(*run, "out/results.h5").must(5, "this is no saved state")
    state = (tmp_path / "s").read_bytes()
    (tmp_path / "cut").write_bytes(state[:-100])
    buckens(*run, "cut").must(5, "the end of the file is missing")
    for place in range(0, len(state) - 80, len(state) // 20):
        damaged = bytearray(state)
        damaged[place] ^= 0x10
        (tmp_path / "damaged").write_bytes(damaged)
        buckens(*run, "damaged").must(5, "is damaged")
    later = state.replace(b"\nformat 1\n", b"\nformat 2\n")
    (tmp_path / "later").write_bytes(later)
    buckens(*run, "later").must(5, "another format than 1")
    (tmp_path / "empty").write_bytes(b"")
    buckens(*run, "empty").must(5, "this is no saved state")


def test_times_are_checked(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(model(SLIDER_CRANK))
    run = ("run", "model.yaml", "-q", "-o", "out")
    buckens(*run, "--save-state-at", 0.01).must(2, "add --save-state FILE")
    buckens(*run, "--save-state", "s", "--save-state-at", 1).must(2, "goes from 0 to 0.06 s")
    buckens(*run, "--save-state", "s", "--save-state-at", 0.02).must(0)
    buckens("run", "model.yaml", "-q", "-o", "next", "--start-from", "s", "--save-state", "s2",
            "--save-state-at", 0.01).must(2, "give a later time")
    shutil.rmtree(tmp_path / "out")
