# SPDX-License-Identifier: Apache-2.0
"""A slider-crank in the plane with an elastic rod, as the beginning of a model file: joints a, b, c and d from the crank to the slide."""

ELASTIC_CRANK = """
buckens: 1
gravity: [0, -9.81, 0]
planar: xy
bodies:
  crank: {rigid: {mass: 0.2, com: [0.05, 0, 0], inertia: [0, 0, 1e-3]}, markers: {tip: {position: [0.1, 0, 0]}}}
  rod:
    beam:
      from: [0, 0, 0]
      to: [0.3, 0, 0]
      elements: 6
      section: {rectangle: {width: 10 mm, height: 10 mm}}
      material: {E: 70 GPa, nu: 0.3, rho: 2700}
    at: {position: [0.1, 0, 0]}
  sl: {rigid: {mass: 0.3, inertia: [0, 0, 1e-4]}, at: {position: [0.4, 0, 0]}}
joints:
  a: {revolute: {between: [ground, crank/origin]}}
  b: {revolute: {between: [crank/tip, rod/start]}}
  c: {revolute: {between: [rod/end, sl]}}
  d: {prismatic: {between: [ground, sl], axis: [1, 0, 0]}}
initial: {joints: {a: {angle: 30 deg}}}
"""
