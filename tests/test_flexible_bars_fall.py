# SPDX-License-Identifier: Apache-2.0
"""Flexible bars that fall on the floor and stay there, with friction at their ends."""

import json

import pytest



def bar(kind, modulus, height, angle, numbers, velocity, spin, step):
    """A bar of 1 m above the floor, which it may touch with both of its ends."""
    ends = ", ".join(
        f"{end}: {{contact: {{between: [ground, bar/{end}], shapes: [{{plane: [0, 0, 1]}}, {{sphere: 10 mm}}], {numbers}}}}}"
        for end in ("start", "end")
    )
    return f"""
buckens: 1
{kind}
gravity: [0, 0, -9.81 m/s^2]
materials: {{m: {{E: {modulus}, nu: 0.3, rho: 2700 kg/m^3}}}}
sections: {{s: {{circle: {{diameter: 20 mm}}}}}}
bodies:
  bar:
    beam: {{from: [0, 0, 0], to: [1 m, 0, 0], elements: 8, section: s, material: m}}
    at: {{position: [0, 0, {height}], orientation: {{axis: [0, 1, 0], angle: {angle} deg}}}}
loads: {{{ends}}}
initial: {{bodies: {{bar: {{velocity: {velocity}, angular-velocity: [0, {spin}, 0]}}}}}}
simulation: {{duration: 0.2 s, step: {step}}}
output: {{every: 1 ms, sensors: {{end: {{position: bar/end}}, moving: {{energy: kinetic}}, lost: {{energy: dissipated}}, balance: {{energy: balance}}}}}}
"""


@pytest.mark.parametrize("step", ["1 ms", "0.5 ms", "0.2 ms"])
def test_a_bar_that_falls_is_not_thrown_up(sensors, step):
    out = sensors(bar("planar: zx", "70 GPa", 0.35, 15.2, "restitution: 0, static: 0.3", [-0.5, 0, -2.8], 2.1, step))
    start = out["moving"][0]
    assert 3 < start < 4
    # It falls by less than 0.1 m, 0.8 J, and nothing else is gained; the vibration of an end, taken
    # for its acceleration over a whole step, threw it up with 10 000 times of it.
    assert out["moving"].max() < start + 0.8
    # Left is what the method damps by its rho-inf of 0.9, and what single landings store more than
    # they take, measured 0.05 to 0.15 J; ends that pushed on as they let go gave 0.8 to 1.1 J.
    assert abs(out["balance"]).max() < 0.05 * start
    assert out["end.z"].max() < 0.5


@pytest.mark.parametrize("step", ["1 ms", "0.1 ms"])
def test_a_soft_bar_that_falls_and_stays_keeps_its_balance(sensors, step):
    """Ends that let go pushed on with the forces of unresolved vibrations: 0.8 and 0.3 J from nowhere, of 3.9 J."""
    out = sensors(bar("", "2 GPa", 0.3, 10, "restitution: 0", [0, 0, -3], 1, f"{step}, rho-inf: 1").replace("0.2 s", "0.3 s"))
    assert out["lost"][-1] > 1.5
    # Measured: 0.3 and at most 13 mJ, of single landings that store more than they take.
    assert abs(out["balance"]).max() < 0.01 * out["moving"][0]


def test_what_blows_on_a_soft_bar_take_hardly_depends_on_the_step(sensors):
    """An end that the bar pulls back within a step rests: struck again and again, it lost twice as much at 1 ms."""
    lost = {}
    for step in ("1 ms", "0.2 ms", "0.05 ms"):
        out = sensors(bar("", "2 GPa", 0.3, 10, "restitution: 0.3", [0, 0, -3], 1, f"{step}, rho-inf: 1"))
        lost[step] = out["lost"][-1]
        # Taken out of the floor against weight: measured 0.9 % at 1 ms.
        assert abs(out["balance"]).max() < 0.02 * lost[step]
    # Measured: 2.60, 2.45 and 2.51 J; vibrations decide what is left over at each step.
    assert lost["1 ms"] == pytest.approx(lost["0.05 ms"], rel=0.1)
    assert lost["0.2 ms"] == pytest.approx(lost["0.05 ms"], rel=0.1)


ARM = """
buckens: 1
gravity: [0, 0, -9.81 m/s^2]
materials: {soft: {E: 2 GPa, nu: 0.3, rho: 2700 kg/m^3}}
sections: {s: {circle: {diameter: 20 mm}}}
bodies: {bar: {beam: {from: [0, 0, 0], to: [1 m, 0, 0], elements: 8, section: s, material: soft}}}
joints: {h: {revolute: {between: [ground, bar/start], axis: [0, 1, 0]}}}
loads: {a: {hinge-stop: {joint: h, from: -10 deg, to: 9 deg, restitution: 0.001}}}
initial: {bodies: {bar: {velocity: [0, 0, -0.57], angular-velocity: [0, -1.14, 0]}}}
simulation: {duration: 0.2 s, step: 0.2 ms, rho-inf: 1}
output: {every: 1 ms, sensors: {balance: {energy: balance}, moving: {energy: kinetic}}}
"""


def test_an_arm_that_bends_over_its_stop_is_not_lifted(sensors):
    """Its root, pulled into the stop within every other step, was taken out of it with the whole arm: 1 J from nowhere."""
    out = sensors(ARM)
    assert out["moving"].max() > 0.5
    # Measured: 0.7 %.
    assert abs(out["balance"]).max() < 0.02 * out["moving"].max()


@pytest.mark.parametrize("restitution", [0.01, 0.5])
def test_numerical_damping_gives_no_energy_where_accelerations_are_found_anew(sensors, restitution):
    """Accelerations of vibrations that the step does not resolve, found anew at each of 80 blows, gave 1.25 J at 1 ms."""
    out = sensors(ARM.replace("rho-inf: 1}", "rho-inf: 0.9}"), "--set", "simulation.step=1 ms", "--set",
                  f"loads.a.hinge-stop.restitution={restitution}")
    # Measured: 6 % where the arm bends over its stop at each step.
    assert abs(out["balance"]).max() < 0.1 * out["moving"].max()
    assert out["moving"].max() < 0.82


def test_an_arm_that_falls_on_its_stop_lies_there_and_converges(sensors, buckens, tmp_path):
    """One impact, after which the stop is a joint; what bends goes on as if it had been one from the instant of the blow."""
    runs = {}
    for step in ("0.4 ms", "0.2 ms", "0.1 ms", "0.02 ms"):
        text = ARM.replace("restitution: 0.001", "restitution: 0").replace("balance: {", "end: {position: bar/end}, lost: {energy: dissipated}, balance: {")
        runs[step] = sensors(text, "--set", f"simulation.step={step}")
        assert json.loads((tmp_path / "out" / "summary.json").read_text())["measures"]["impacts"] == 1
        assert abs(runs[step]["balance"]).max() < 1e-3 * runs[step]["moving"].max()
    off = [abs(runs[step]["end.z"] - runs["0.02 ms"]["end.z"]).max() for step in ("0.4 ms", "0.2 ms", "0.1 ms")]
    # Of first order at least, with a factor that depends on where in a step the blow falls.
    assert off[1] < 0.8 * off[0] and off[2] < 0.8 * off[1] and off[2] < 0.35 * off[0]


def test_a_bar_with_damping_comes_to_rest_on_the_floor(sensors, tmp_path):
    text = bar("", "2 GPa", 0.03, 1, "restitution: 0, static: 0.3", [0, 0, 0], 0, "1 ms").replace(
        "rho: 2700 kg/m^3}", "rho: 2700 kg/m^3, damping: {stiffness: 2e-4 s}}").replace(
        "sensors: {", "sensors: {a: {contact: start}, b: {contact: end}, ")
    counts = []
    for duration in ("2 s", "3 s"):
        out = sensors(text.replace("0.2 s", duration))
        counts.append(json.loads((tmp_path / "out" / "summary.json").read_text())["measures"]["impacts"])
    # It bounces by its own vibrations, and then lies with half of its weight on either end.
    assert counts[1] == counts[0] < 60
    weight = 2700 * 3.141592653589793e-4 * 9.81
    assert out["a.normal"][-1] == pytest.approx(weight / 2, rel=1e-2) and out["b.normal"][-1] == pytest.approx(weight / 2, rel=1e-2)
    assert abs(out["balance"]).max() < 0.02 * out["lost"][-1]


def damped_bar(damping, friction, step):
    """A soft bar that is dropped almost flat, and comes to lie on its ends."""
    text = bar("", "2 GPa", 0.03, 1, f"restitution: 0{friction}", [0, 0, 0], 0, step)
    return text.replace("rho: 2700 kg/m^3}", f"rho: 2700 kg/m^3, damping: {{stiffness: {damping}}}}}").replace("0.2 s", "1 s")


@pytest.mark.parametrize("friction", ["", ", static: 0.3"])
@pytest.mark.parametrize("damping, step, open_share, most_impacts", [
    # Measured without friction, and with it: 0.6 and 3, 1.2 and 3.4, 1.9 and 2, 0.6 and 2.3 thousandths of the loss, and
    # 5 and 5, 5 and 5, 23 and 16, 18 and 15 impacts. Damping of what blows move counted twice left 78 thousandths
    # open with friction, differences of K d after blows 26 without; ends that stay, let go since rates of
    # overdamped parts turn, were struck up to 59 times.
    ("2e-3 s", "1 ms", 0.006, 10), ("2e-3 s", "0.1 ms", 0.006, 10), ("2e-4 s", "1 ms", 0.005, 30), ("2e-4 s", "0.1 ms", 0.005, 30),
])
def test_a_damped_bar_that_falls_and_stays_keeps_its_balance(sensors, tmp_path, damping, step, open_share, most_impacts, friction):
    out = sensors(damped_bar(damping, friction, step))
    assert out["lost"][-1] > 0.08
    assert abs(out["balance"]).max() < open_share * out["lost"][-1]
    assert json.loads((tmp_path / "out" / "summary.json").read_text())["measures"]["impacts"] < most_impacts


def test_a_damped_bar_that_falls_and_stays_converges(sensors):
    """With strong damping its ends stay where they land, and shapes go on as they do in short steps."""
    fine = sensors(damped_bar("2e-3 s", ", static: 0.3", "0.02 ms"))
    for step, most in (("1 ms", 6e-5), ("0.1 ms", 4e-6)):
        out = sensors(damped_bar("2e-3 s", ", static: 0.3", step))
        # Measured: 35 and 2 um; 12 um at 0.1 ms with ends that were let go and struck again and again.
        assert abs(out["end.z"] - fine["end.z"]).max() < most


@pytest.mark.parametrize("angle, step, damping", [(10, "1 ms", "2e-3 s"), (1, "1 ms", "2e-3 s"), (1, "0.2 ms", "2e-3 s"), (10, "0.2 ms", "2e-3 s")])
def test_a_soft_bar_that_is_bent_far_stays_in_its_plane(sensors, angle, step, damping):
    """Rounding of its turning about its own axis grew threefold per step, until the run ended as deformed too much."""
    ends = {}
    for kind in ("", "planar: zx"):
        text = bar(kind, "2 GPa", 0.3 if angle == 10 else 0.03, angle, "restitution: 0, static: 0.3", [0, 0, -3], 1, step)
        text = text.replace("rho: 2700 kg/m^3}", f"rho: 2700 kg/m^3, damping: {{stiffness: {damping}}}}}").replace("0.2 s", "0.15 s")
        ends[kind] = sensors(text)
    assert len(ends[""]["t"]) == 151
    # Nothing acts across the plane. Measured: 3e-9 m where a blow more is counted, else 6e-14 m.
    assert abs(ends[""]["end.z"] - ends["planar: zx"]["end.z"]).max() < 1e-7
