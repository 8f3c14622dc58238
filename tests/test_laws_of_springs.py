# SPDX-License-Identifier: Apache-2.0
"""Bushings and springs whose force or torque follows a formula or a table of the displacement."""

import math

import numpy
import pytest

MOUNT = """
buckens: 1
bodies: {block: {rigid: {mass: 2 kg, inertia: [0.1, 0.2, 0.3]}, at: {position: [0.1, 0.2, 0.3]}}}
joints:
  mount:
    bushing: {between: [ground, block], LAWS}
loads: {LOADS}
initial: {bodies: {block: {velocity: VELOCITY, angular-velocity: SPIN}}}
simulation: {duration: DURATION, step: STEP, method: newmark}
output:
  every: 1 ms
  sensors:
    p: {displacement: block}
    v: {velocity: block}
    w: {angular-velocity: block}
    turn: {relative: {between: [ground, block], quantity: angle, axis: AXIS}}
    force: {spring-force: mount}
    torque: {spring-torque: mount}
    lost: {energy: dissipated}
    balance: {energy: balance}
"""


def mount(laws, loads="", velocity="[0, 0, 0]", spin="[0, 0, 0]", duration="1 s", step="0.5 ms", axis="[0, 0, 1]"):
    text = MOUNT.replace("LAWS", laws).replace("VELOCITY", velocity).replace("SPIN", spin).replace("AXIS", axis)
    text = text.replace("DURATION", duration).replace("STEP", step)
    return text.replace("loads: {LOADS}\n", f"loads: {{{loads}}}\n" if loads else "")


def rk4(rates, x, t, h=1e-4):
    """An independent route: Runge and Kutta's method."""
    for _ in range(round(t / h)):
        a = rates(x)
        b = rates(x + 0.5 * h * a)
        c = rates(x + 0.5 * h * b)
        x = x + h / 6 * (a + 2 * b + 2 * c + rates(x + h * c))
    return x


@pytest.mark.parametrize("axis", range(3))
def test_a_formula_of_displacement_and_rate_along_each_axis(sensors, axis):
    """x'' = -(200 x + 9e5 x^3 + 3 v |v|)/2, of which 200 x is the bushing's own stiffness."""
    name = "xyz"[axis]
    stiffness = [0, 0, 0]
    stiffness[axis] = 200
    speed = [0, 0, 0]
    speed[axis] = 1.2
    out = sensors(mount(f'stiffness: {stiffness}, force-{name}: "9e5*displacement^3 + 3*rate*abs(rate) N"', velocity=str(speed)))
    end = rk4(lambda y: numpy.array([y[1], -(200 * y[0] + 9e5 * y[0] ** 3 + 3 * y[1] * abs(y[1])) / 2]),
              numpy.array([0, 1.2]), 1.0)
    # (w h)^2/12 of the angle of 40 rad that it goes through, at w = 60/s and steps of 0.5 ms: 3e-3 of 60 mm.
    assert out[f"p.{name}"][-1] == pytest.approx(end[0], abs=2e-4)
    x, v = out[f"p.{name}"], out[f"v.{name}"]
    assert abs(out[f"force.{name}"]) == pytest.approx(abs(200 * x + 9e5 * x ** 3 + 3 * v * abs(v)), rel=1e-9, abs=1e-9)
    others = [k for k in "xyz" if k != name]
    assert all(abs(out[f"p.{k}"]).max() == 0 for k in others)
    # What the formula takes at a rate is lost, the rest is stored.
    energy = v ** 2 + 100 * x ** 2 + 2.25e5 * x ** 4
    assert out["lost"][-1] == pytest.approx(energy[0] - energy[-1], rel=2e-3)
    # The account closes with the square of the step.
    assert abs(out["balance"]).max() < 2e-3


@pytest.mark.parametrize("axis", range(3))
def test_a_table_of_the_angle_about_each_axis(sensors, axis):
    """Softening: the period of the quadrature of the table."""
    name = "xyz"[axis]
    spin = [0, 0, 0]
    spin[axis] = 3
    laws = f"torque-{name}: {{table: [[-1, -14], [-0.1, -5], [0.1, 5], [1, 14]]}}"
    unit = str([int(k == axis) for k in range(3)])
    out = sensors(mount(laws, spin=str(spin), axis=unit, step="0.2 ms"))
    inertia = [0.1, 0.2, 0.3][axis]

    def torque(angle):
        return numpy.interp(angle, [-1, -0.1, 0.1, 1], [-14, -5, 5, 14])

    end = rk4(lambda y: numpy.array([y[1], -torque(y[0]) / inertia]), numpy.array([0, 3.0]), 1.0)
    # As above: at most 25 rad at 22/s, and corners of the table within steps.
    assert out["turn"][-1] == pytest.approx(end[0], abs=1e-4)
    assert out[f"w.{name}"][-1] == pytest.approx(end[1], abs=2e-3)
    assert out[f"torque.{name}"] == pytest.approx(out[f"torque.{name}"][5] / torque(out["turn"][5]) * torque(out["turn"]), abs=1e-8)
    assert abs(out["balance"]).max() < 1e-3


SPRINGS = """
buckens: 1
bodies: {block: {rigid: {mass: 2 kg, inertia: [0.1, 0.2, 0.3]}, at: {position: [0.3, 0.4, 0]}}}
JOINTS
loads: {spring: {SPRING}}
initial: {bodies: {block: {VELOCITY}}}
simulation: {duration: 1 s, step: 0.5 ms, method: newmark}
output:
  every: 1 ms
  sensors: {p: {position: block}, v: {velocity: block}, w: {angular-velocity: block}, FORCE, lost: {energy: dissipated}, balance: {energy: balance}}
"""


def test_a_spring_between_points_hardens(sensors):
    """Along the line of 0.5 m: e'' = -(100 e + 4e5 e^3 + 2 e' |e'|)/2."""
    out = sensors(SPRINGS.replace("JOINTS\n", "").replace("FORCE", "force: {spring-force: spring}").replace("VELOCITY", "velocity: [0.6, 0.8, 0]").replace(
        "SPRING", 'spring-damper: {between: [ground, block], stiffness: 100 N/m, '
        'characteristic: "4e5*displacement^3 + 2*rate*abs(rate) N"}'))
    end = rk4(lambda y: numpy.array([y[1], -(100 * y[0] + 4e5 * y[0] ** 3 + 2 * y[1] * abs(y[1])) / 2]),
              numpy.array([0, 1.0]), 1.0)
    stretch = numpy.hypot(out["p.x"], out["p.y"]) - 0.5
    rate = 0.6 * out["v.x"] + 0.8 * out["v.y"]
    assert stretch[-1] == pytest.approx(end[0], abs=2e-4)
    assert out["force"] == pytest.approx(100 * stretch + 4e5 * stretch ** 3 + 2 * rate * abs(rate), rel=1e-9, abs=1e-9)
    energy = rate ** 2 + 50 * stretch ** 2 + 1e5 * stretch ** 4
    assert out["lost"][-1] == pytest.approx(energy[0] - energy[-1], rel=2e-3)
    assert abs(out["balance"]).max() < 2e-3


def test_a_torsional_spring_by_a_table(sensors):
    """Play of 0.2 rad either way, then 60 N m/rad."""
    out = sensors(SPRINGS.replace("JOINTS", "joints: {pin: {revolute: {between: [ground, {marker: block}], axis: [0, 0, 1]}}}").replace(
        "{marker: block}", "block").replace("[ground, block], axis", "[{ground: [0.3, 0.4, 0]}, block], axis").replace(
        "FORCE", "turn: {joint-coordinate: pin}, torque: {spring-torque: spring}").replace("VELOCITY", "angular-velocity: [0, 0, 4]").replace(
        "SPRING", "torsional-spring: {between: [ground, block], axis: [0, 0, 1], characteristic: "
        "{table: [[-2, -108], [-0.2, 0], [0.2, 0], [2, 108]]}}"))
    # Across the play at 4/s, half a period of sqrt(60/0.3)/s on either side.
    period = 2 * 0.4 / 4 + 2 * math.pi / math.sqrt(200)
    through = [k for k in range(1, len(out["t"])) if out["turn.value"][k - 1] < 0 <= out["turn.value"][k]]
    assert through and out["t"][through[0]] == pytest.approx(period, abs=2e-3)
    assert max(out["turn.value"]) == pytest.approx(0.2 + 4 / math.sqrt(200), abs=1e-3)
    expected = numpy.interp(out["turn.value"], [-2, -0.2, 0.2, 2], [-108, 0, 0, 108])
    assert out["torque"] == pytest.approx(expected, abs=1e-8)
    assert abs(out["balance"]).max() < 5e-3


def test_statics_follow_the_law(sensors):
    """10 N against 1e6 x^3: x = 21.5 mm, to the tolerance of the equilibrium."""
    laws = 'stiffness: [1, 1, 1], rotational-stiffness: [1, 1, 1], force-x: "1e6*displacement^3 N"'
    text = mount(laws, loads="pull: {force: {on: block, value: [10 N, 0, 0]}}", duration="10 ms")
    out = sensors(text.replace("initial: {", "initial: {start: static, "))
    x = out["p.x"]  # displacements count from t = 0
    assert abs(x).max() < 1e-9
    where = numpy.cbrt(10 / 1e6)
    assert abs(out["force.x"]) == pytest.approx(10, rel=1e-9)
    assert 1e6 * where ** 3 + where == pytest.approx(10, rel=3e-3)


WRONG = {
    'force-x: "displacment N"': ["displacment", "displacement"],
    "force-y: {table: [[0, 1], [0, 2]]}": ["force-y"],
    'torque-z: "angle/0 N m"': ["torque-z", "finite"],
    'torque-z: "20*angle N"': ["torque-z", "N"],
    "force: 3 N": ["force", "force-x"],
}


@pytest.mark.parametrize("laws", WRONG)
def test_messages_say_what_is_wrong(buckens, tmp_path, laws):
    (tmp_path / "model.yaml").write_text(mount(laws))
    result = buckens("check", "model.yaml")
    assert result.code == 2, result.out + result.err
    assert "model.yaml:6:" in result.err and "mount" in result.err
    for word in WRONG[laws]:
        assert word in result.err, result.err


def test_a_table_ends_where_it_ends(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(
        mount("force-x: {table: [[-1e-3, -1], [1e-3, 1]]}", velocity="[1, 0, 0]"))
    buckens("run", "model.yaml", "-o", "out").must(4, "mount", "table")
