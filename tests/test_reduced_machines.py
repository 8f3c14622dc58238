# SPDX-License-Identifier: Apache-2.0
"""Laws on joints and contact at reduced bodies: the same motion as with the full mesh, the closer the more modes are kept."""

import numpy

# An arm that a motor drives between a stop of its hinge and a roller, both elastic; its hinge rubs.
ARM = """
buckens: 1
planar: xy
gravity: [0, -9.81, 0]
materials: {steel: {E: 210 GPa, nu: 0.3, rho: 7850, damping: {stiffness: 2e-5 s}}}
bodies:
  arm: {beam: {to: [0.5, 0, 0], elements: 8, section: {rectangle: {width: 20 mm, height: 6 mm}}, material: steel}}
joints: {hinge: {revolute: {between: [ground, arm/start]}}}
loads:
  motor: {hinge-motor: {joint: hinge, torque: "4*sin(20*t) N m"}}
  rub: {hinge-friction: {joint: hinge, static: 0.2, radius: 20 mm, preload: 0.2 N m, slip: 1e-5 rad}}
  stop: {hinge-stop: {joint: hinge, from: -0.1 rad, stiffness: 2 kN m/rad, damping: 1 N m s/rad}}
  roller: {contact: {between: [{ground: [0.5, 0.08, 0]}, arm/end], shapes: [{sphere: 20 mm}, {sphere: 20 mm}], stiffness: 1e5, static: 0.3}}
simulation: {duration: 0.5 s, step: 0.1 ms}
output:
  every: 1 ms
  sensors: {hinge: {joint-coordinate: hinge}, tip: {position: arm/end}, rub: {spring-torque: rub}, stop: {spring-torque: stop}, roller: {contact: roller}, lost: {energy: dissipated}}
"""


def test_friction_stops_motors_and_contact_act_on_reduced_bodies(sensors):
    full = sensors(ARM)
    # All of them act, more than once: the stop and the roller push and let go, friction slips both ways.
    for name, size in (("stop", -10), ("roller.normal", 50)):
        pushes = numpy.abs(full[name]) > 0
        assert numpy.diff(pushes.astype(int)).clip(0).sum() >= 2, name
        assert numpy.abs(full[name]).max() > abs(size)
    assert full["rub"].min() < -0.3 and full["rub"].max() > 0.3
    assert full["roller.friction"].max() > 10 and full["lost"][-1] > 0.2

    def differs(modes):
        reduced = sensors(ARM, "--set", f"bodies.arm.reduction={{craig-bampton: {modes}}}")
        return {name: numpy.abs(reduced[name] - full[name]).max() / numpy.abs(full[name]).max() for name in full if name != "tip.z"}

    # With all 21 modes it is the same body in other coordinates: rounding, which impacts multiply.
    everything = differs(21)
    assert all(difference < 1e-7 for name, difference in everything.items() if name != "lost"), everything
    # Work is integrated by the trapezoidal rule, with corners at impacts and where friction turns: order h of its parts.
    assert everything["lost"] < 2e-4
    few, more, many = (differs(modes) for modes in (2, 4, 8))
    for name in ("hinge.value", "tip.y", "stop", "roller.normal"):
        assert many[name] < more[name] < few[name], name
    # Motion is that of the full mesh within 1e-4 of its size with eight modes, forces of impacts within 1 %.
    assert many["hinge.value"] < 1e-4 and many["tip.y"] < 1e-4
    assert many["stop"] < 1e-2 and many["roller.normal"] < 1e-2
