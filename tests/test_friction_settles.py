# SPDX-License-Identifier: Apache-2.0
"""Steps of flexible mechanisms with friction in all joints settle, and cost little more than without."""

import json

import pytest

CRANK = """buckens: 1
planar: xy
materials: {steel: {E: 200 GPa, nu: 0.3, rho: 7870 kg/m^3, damping: {stiffness: 1e-6 s}}}
bodies:
  crank: {rigid: {mass: 0.36, com: [0.075, 0, 0], inertia: [0, 0, 2.727e-3]}, markers: {shaft: {position: [0, 0, 0]}, pin: {position: [0.15, 0, 0]}}}
  rod: {beam: {to: [0.3, 0, 0], elements: 8, section: {circle: {diameter: 8 mm}}, material: steel}, at: {position: [0.15, 0, 0]}}
  slider: {rigid: {mass: 0.033, inertia: [0, 0, 1e-6]}, at: {position: [0.45, 0, 0]}}
joints:
  shaft: {revolute: {between: [ground, crank/shaft]}}
  motor: {prescribed-rotation: {between: [ground, crank/shaft], angle: "150*t rad"}}
  big_end: {revolute: {between: [crank/pin, rod/start]}}
  small_end: {revolute: {between: [rod/end, slider]}}
  guide: {prismatic: {between: [ground, slider], axis: [1, 0, 0]}}
LAWS
simulation: {duration: 84 ms, step: 0.1 ms}
output: {every: 1 ms, sensors: {work: {energy: work}, lost: {energy: dissipated}, balance: {energy: balance}}}
"""

FRICTION = """loads:
  f_shaft: {hinge-friction: {joint: shaft, static: 0.1, radius: 10 mm}}
  f_big: {hinge-friction: {joint: big_end, static: 0.1, radius: 8 mm}}
  f_small: {hinge-friction: {joint: small_end, static: 0.1, radius: 8 mm}}
  f_guide: {slide-friction: {joint: guide, static: 0.1}}"""

FOUR_BAR = """buckens: 1
planar: xy
materials: {steel: {E: 200 GPa, nu: 0.3, rho: 7850 kg/m^3}}
bodies:
  crank: {rigid: {mass: 0.4, com: [0.05, 0, 0], inertia: [0, 0, 4e-4]}, markers: {o: {position: [0, 0, 0]}, a: {position: [0.1, 0, 0]}}}
  coupler: {beam: {to: [0.18, 0.24, 0], elements: 8, section: {circle: {diameter: 12 mm}}, material: steel}, at: {position: [0.1, 0, 0]}}
  rocker: {rigid: {mass: 0.8, com: [0.315, 0.12, 0], inertia: [0, 0, 4e-3]}, markers: {b: {position: [0.28, 0.24, 0]}, c: {position: [0.35, 0, 0]}}}
joints:
  o: {revolute: {between: [ground, crank/o]}}
  drive: {prescribed-rotation: {between: [ground, crank/o], angle: "ANGLE"}}
  a: {revolute: {between: [crank/a, coupler/start]}}
  b: {revolute: {between: [coupler/end, rocker/b]}}
  c: {revolute: {between: [{ground: [0.35, 0, 0]}, rocker/c]}}
loads:
  fo: {hinge-friction: {joint: o, static: 0.1, radius: 10 mm}}
  fa: {hinge-friction: {joint: a, static: 0.1, radius: 8 mm}}
  fb: {hinge-friction: {joint: b, static: 0.1, radius: 8 mm}}
  fc: {hinge-friction: {joint: c, static: 0.1, radius: 10 mm}}
simulation: {duration: 0.2 s, step: 0.1 ms}
output: {every: 1 ms, sensors: {work: {energy: work}, lost: {energy: dissipated}, balance: {energy: balance}}}
"""


@pytest.fixture
def summary(buckens, tmp_path):
    def run(text, name):
        (tmp_path / f"{name}.yaml").write_text(text)
        buckens("run", f"{name}.yaml", "-q", "-o", name).must(0)
        return json.loads((tmp_path / name / "summary.json").read_text())
    return run


def test_friction_in_all_joints_costs_few_iterations(summary):
    without = summary(CRANK.replace("LAWS\n", ""), "without")
    rubbed = summary(CRANK.replace("LAWS", FRICTION), "rubbed")
    assert rubbed["step_control"]["failed"] == 0
    assert rubbed["steps"] == without["steps"] == 840
    # The goal of friction in a flexible mechanism: at most 1.3 times the work of a step. Iterations are to be
    # a small part of that: evaluations and small matrices of friction are the rest.
    assert rubbed["newton_iterations"]["total"] <= 1.1 * without["newton_iterations"]["total"]


@pytest.mark.parametrize("angle", ["60*t rad", "60*(t - 0.01*(1 - exp(-t/0.01))) rad"])
def test_a_four_bar_with_friction_runs_without_shortened_steps(summary, angle):
    run = summary(FOUR_BAR.replace("ANGLE", angle), "run")
    assert run["step_control"]["failed"] == 0
    assert [size["step"] for size in run["step_control"]["sizes"]] == [1e-4]


BALLS = """buckens: 1
gravity: [0, 0, -9.81]
bodies:
  arm: {rigid: {mass: 1, inertia: [2e-3, 2e-3, 1e-4]}, at: {position: [0.1, 0, 0]}, markers: {o: {position: [-0.1, 0, 0]}, e: {position: [0.1, 0, 0]}}}
  bob: {rigid: {mass: 0.5, inertia: [1e-4, 2e-4, 2e-4]}, at: {position: [0.25, 0, 0]}, markers: {o: {position: [-0.05, 0, 0]}}}
joints:
  hang: {spherical: {between: [ground, arm/o]}}
  link: {spherical: {between: [arm/e, bob/o]}}
loads:
  a: {ball-friction: {joint: hang, static: 0.2, radius: 10 mm}}
  b: {ball-friction: {joint: link, static: 0.2, radius: 8 mm}}
initial: {bodies: {arm: {velocity: [0, 0.8, -0.2], angular-velocity: [0, 2, 8]}, bob: {velocity: [0, 1.6, -0.4]}}}
simulation: {duration: 2 s, step: 1 ms}
output: {every: 10 ms, sensors: {balance: {energy: balance}, lost: {energy: dissipated}}}
"""


def test_balls_whose_sliding_turns_settle(sensors, tmp_path):
    out = sensors(BALLS)
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["step_control"]["failed"] == 0
    # Some thirty and halved steps, if the tangent does not know that the torque turns with the sliding.
    assert summary["newton_iterations"]["max"] <= 12
    assert abs(out["balance"]).max() < 2e-3 * out["lost"][-1]


SPACE_CRANK = """buckens: 1
gravity: [0, 0, -9.81]
materials: {steel: {E: 200 GPa, nu: 0.3, rho: 7870 kg/m^3, damping: {stiffness: 1e-6 s}}}
bodies:
  crank: {rigid: {mass: 0.36, com: [0.05, 0, 0], inertia: [1e-4, 2e-3, 2e-3]}, markers: {shaft: {position: [0, 0, 0]}, pin: {position: [0.1, 0, 0]}}}
  rod: {beam: {to: ROD, elements: 8, section: {circle: {diameter: 8 mm}}, material: steel}, at: {position: [0.1, 0, 0]}}
  slider: {rigid: {mass: 0.1, inertia: [1e-4, 1e-4, 1e-4]}, at: {position: SLIDER}}
joints:
  shaft: {revolute: {between: [ground, crank/shaft], axis: [0, 0, 1]}}
  motor: {prescribed-rotation: {between: [ground, crank/shaft], axis: [0, 0, 1], angle: "150*t rad"}}
  big_end: {BIG: {between: [crank/pin, rod/start]AXES}}
  small_end: {spherical: {between: [rod/end, slider]}}
  guide: {prismatic: {between: [{ground: SLIDER}, slider], axis: [1, 0, 0]}}
loads:
  f_shaft: {hinge-friction: {joint: shaft, static: MU, radius: 10 mm}}
  f_big: {ball-friction: {joint: big_end, static: MU, radius: 8 mm}}
  f_small: {ball-friction: {joint: small_end, static: MU, radius: 8 mm}}
  f_guide: {slide-friction: {joint: guide, static: MU}}
simulation: {duration: 0.1 s, step: 0.1 ms}
output: {every: 1 ms, sensors: {work: {energy: work}, lost: {energy: dissipated}, balance: {energy: balance}}}
"""
IN_PLANE = ("[0.3, 0, 0]", "[0.4, 0, 0]")
OUT_OF_PLANE = ("[0.2828427124746, 0, 0.1]", "[0.3828427124746, 0, 0.1]")


@pytest.mark.parametrize("joint, axes", [("spherical", ""), ("universal", ", axis: [0, 0, 1], second-axis: [0, 1, 0]")])
@pytest.mark.parametrize("coefficient", ["0.1", "0.4"])
@pytest.mark.parametrize("rod, slider", [IN_PLANE, OUT_OF_PLANE], ids=["in plane", "out of plane"])
def test_balls_that_turn_round_settle(summary, rod, slider, coefficient, joint, axes):
    """Twice a turn the small end stands still against the slider. There its friction turns round within the tiny way of its elastic
    slip, and the thin rod, free to turn about its own axis, is the stiffer to the bound the slower the ball slides."""
    text = SPACE_CRANK.replace("ROD", rod).replace("SLIDER", slider).replace("MU", coefficient).replace("BIG", joint).replace("AXES", axes)
    run = summary(text, "run")
    assert run["step_control"]["failed"] == 0 and run["steps"] == 1000
    # 8.5 in plane to 28 out of plane, all rounds of the inertial coupling together.
    assert run["newton_iterations"]["total"] <= 30 * run["steps"]
