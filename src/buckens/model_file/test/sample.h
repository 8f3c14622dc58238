// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace buckens::model_file {

/// A model file that uses every part of the format at least once.
inline constexpr const char* kSampleModel = R"(# every part of the format
buckens: 1
title: "Sample: all keys"
gravity: [0, -9.81 m/s^2, 0]
planar: xy
parameters: {L: 300 mm, speed: 150, half: L/2}
materials:
  steel: {E: 200 GPa, nu: 0.3, rho: 7870 kg/m^3, damping: {mass: 0, stiffness: 1e-7 s}}
  soft: {E: 2 GPa, G: 0.8 GPa, rho: 1100, damping: {ratio: 2 %, at: [10 Hz, 200 Hz]}}
  ply: {rho: 1600, orthotropic: {E1: 135 GPa, E2: 10 GPa, E3: 8 GPa, nu12: 0.3, nu13: 0.25, nu23: 0.45, G12: 5 GPa, G13: 4 GPa, G23: 3 GPa, axis-1: [0, 0, 2], axis-2: [1, 0, 1]}}
sections:
  rod6: {circle: {diameter: 6 mm}}
  tube: {tube: {outer-diameter: 40 mm, thickness: 3 mm}}
bodies:
  crank:
    rigid: {mass: 0.36 kg, com: [75 mm, 0, 0], inertia: [0, 0, 2.727e-3 kg m^2]}
    at: {position: [0, 0, 0], orientation: {axis: [0, 0, 1], angle: 30 deg}}
    markers: {pin: {position: [150 mm, 0, 0]}}
  rod:
    beam:
      from: [0, 0, 0]
      to: [L, 0, 0]
      elements: 16
      section: rod6
      material: steel
      up: [0, 0, 1]
      theory: timoshenko
      rotary-inertia: off
      masses: [{at: end, mass: 33 g, inertia: [1e-6, 1e-6, 1e-6 kg m^2]}]
    at: {position: [150 mm, 0, 0]}
    coupling: none
    damping: {mass: 2 1/s}
  frame:
    structure:
      nodes: {a: [0, 0, 0], b: [1 m, 0, 0], c: [1, 1, 0]}
      beams: [{between: [a, b], elements: 2, section: {box: {width: 40 mm, height: 60 mm, thickness: 3 mm}}, material: soft}]
      bars: [{between: [b, c], area: 100 mm^2, material: steel}, {between: [a, c], section: tube, material: steel}]
      masses: [{at: c, mass: 1 kg}]
    markers: {top: {at: c, orientation: {euler: [0, 0, 90 deg]}}}
  block:
    mesh:
      box: {from: [2 m, 2 m, 0], size: [1 m, 0.2 m, 0.2 m], divisions: [4, 2, 2], element: hex8, integration: full}
      material: steel
      masses: [{at: centre, mass: 1 kg}]
    markers: {corner: {at: corner_111}, middle: {position: [2.5 m, 2.1 m, 0.1 m]}, turned: {at: left, orientation: {axis: [1, 0, 0], angle: 10 deg}}}
    interfaces:
      left: {face: x0, kind: rigid, at: [2 m, 2.1 m, 50 mm], orientation: {axis: [0, 0, 1], angle: 30 deg}}
      edge: {set: [corner_100, corner_101]}
      lump: {sphere: {center: [3 m, 2.2 m, 0], radius: 60 mm, tolerance: 1 mm}}
      top: {box: {from: [2 m, 2 m, 0.2 m], to: [3 m, 2.2 m, 0.2 m]}}
      bore: {cylinder: {from: [2.5 m, 2 m, 0.1 m], to: [2.5 m, 2.2 m, 0.1 m], radius: 10 mm}}
      cut: {plane: {point: [2.5 m, 0, 0], normal: [1, 0, 0]}}
  lump:
    structure:
      nodes: {a: [4, 0, 0], b: [5, 0, 0], c: [5, 1, 0], d: [4, 1, 0], e: [4, 0, 1], f: [5, 0, 1], g: [5, 1, 1], h: [4, 1, 1]}
      solids: [{nodes: [a, b, c, d, e, f, g, h], element: hex8, integration: full, material: steel}]
  shaft:
    mesh: {cylinder: {from: [7, 0, 0], to: [8, 0, 0], diameter: 0.2, divisions: [1, 8, 4], element: tet10}, material: ply}
    markers: {end: {at: top_centre}}
  sleeve: {mesh: {tube: {to: [0, 0, 1], outer-diameter: 40 mm, inner-diameter: 30 mm, divisions: [1, 12, 3]}, material: steel}}
  wheel: {mesh: {disc: {axis: [0, 1, 0], diameter: 1, bore: 0.2, thickness: 0.1, divisions: [2, 16, 1], element: hex20, integration: full}, material: steel}}
  twin: {like: rod, at: {position: [0, 1, 0], orientation: {quaternion: [1, 0, 0, 0]}}}
joints:
  base: {revolute: {between: [ground, crank/origin]}}
  pin: {spherical: {between: [crank/pin, rod/start]}}
  slide: {prismatic: {between: [ground, rod/end], axis: [1, 0, 0]}}
  weld: {fixed: {between: [{ground: [0, 2 m, 0]}, frame/a]}}
  soft: {bushing: {between: [frame/top, twin/mid], stiffness: [1e6 N/m, 1 kN/mm, 0], rotational-stiffness: [0, 0, 20 N m/rad], damping: [1 N s/m, 0, 0], rotational-damping: [0, 0, 0.1]}}
  motor: {prescribed-rotation: {between: [ground, crank], axis: [0, 0, 1], angle: "speed*t"}}
  shift: {prescribed-translation: {between: [ground, twin/end], axis: [1, 0, 0], displacement: {table: [[0, 0], [0.1, 2], [0.5, 2]], unit: mm, interpolation: spline}}}
loads:
  push: {force: {on: rod/end, value: [0, "10*sin(20*t) N", 0], axes: following}}
  turn: {torque: {on: crank, value: [0, 0, 2 N m]}}
  spring: {spring-damper: {between: [ground, rod/mid], stiffness: 2 kN/m, damping: 5 N s/m, length: 120 mm, force: "3*t N"}}
  coil: {torsional-spring: {between: [ground, twin], stiffness: 20 N m/rad, angle: 10 deg}}
initial:
  bodies:
    crank: {velocity: [1 m/s, 0, 0], angular-velocity: [0, 0, 60 rpm]}
    rod: {nodal-velocity: {y: "0.1*sin(pi*x/L) m/s", rz: "2*x"}}
  start: static
  preload: true
simulation: {duration: 0.1 s, step: 0.1 ms, method: newmark, rho-inf: 0.8, projection: off}
output:
  every: 1 ms
  sensors:
    tip: {position: rod/end}
    way: {displacement: {of: rod/mid, in: crank}}
    bend: {deflection: {of: rod/mid, from: chord}}
    angle: {relative: {between: [crank, rod], quantity: angle}}
    pull: {joint-force: base}
    twist: {joint-torque: {joint: base, in: crank}}
    cut: {section-force: {of: rod, element: 3}}
    peak: {stress: rod}
    local: {stress: block/corner_000}
    sum: {energy: balance}
)";

}  // namespace buckens::model_file
