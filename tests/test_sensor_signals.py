# SPDX-License-Identifier: Apache-2.0
"""Signals of sensors: within the step where they follow from the motion, else held from the end of the last step."""

import json

import h5py
import numpy
import pytest
from scipy.linalg import expm

PRESS = """
buckens: 1
bodies: {platen: {rigid: {mass: 4 kg, inertia: [1e-2, 1e-2, 1e-2]}}}
joints: {way: {prismatic: {between: [ground, platen], axis: [1, 0, 0]}}}
signals:
  force: {FORCE}
  error: "50 - force"
  area: {integral: {input: error}}
loads:
  work: {WORK}
  ram: {slide-motor: {joint: way, force: "1.5*error + 60*area"}}
simulation: {duration: 0.5 s, step: STEP, METHOD}
output: {every: 10 ms, sensors: {x: {joint-coordinate: way}, cell: {spring-force: work}, force: {signal: force}}}
"""


def press(force="sensor: cell", work="slide-spring: {joint: way, stiffness: 3000 N/m, damping: 80 N s/m}", step="1 ms",
          method="method: generalized-alpha"):
    return PRESS.replace("FORCE", force).replace("WORK", work).replace("STEP", step).replace("METHOD", method)


@pytest.mark.parametrize("work", [
    "slide-spring: {joint: way, stiffness: 3000 N/m, damping: 80 N s/m}",
    "spring-damper: {between: [{ground: [-1, 0, 0]}, platen], stiffness: 3000 N/m, damping: 80 N s/m}",
], ids=["slide-spring", "spring-damper"])
def test_a_press_under_control_of_its_force(sensors, work):
    """m x'' = u - F, F = k x + c x', u = P e + I ∫e: the error falls with h², as nothing is late by a step."""
    m, k, c, P, I, wanted = 4.0, 3000.0, 80.0, 1.5, 60.0, 50.0
    # x, v, area, 1
    A = numpy.array([[0, 1, 0, 0], [-(1 + P) * k / m, -(1 + P) * c / m, I / m, P * wanted / m], [-k, -c, 0, wanted], [0, 0, 0, 0]])
    errors = []
    text = press(work=work)
    for step, method in (("2 ms", "rho-inf: 0.8"), ("1 ms", "rho-inf: 0.8"), ("1 ms", "method: newmark")):
        out = sensors(text.replace("step: 1 ms", f"step: {step}").replace("method: generalized-alpha", method))
        exact = numpy.array([(expm(A * t) @ [0, 0, 0, 1])[:2] for t in out["t"]])
        errors.append(abs(k * exact[:, 0] + c * exact[:, 1] - out["force"]).max())
        # The signal is what the sensor records.
        assert out["force"] == pytest.approx(out["cell"], abs=1e-10)
    # A step of delay would be (1 + P) k/m h = 2 % of 50 N.
    assert errors[1] < 0.05 and errors[2] < 0.05
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.15)
    assert out["force"][-1] == pytest.approx(wanted, abs=0.6)


def test_a_stiff_press_converges(sensors):
    """Gains on the force of a spring of the same coordinate are part of the tangent: k h²/m is 750 here."""
    stiff = "slide-spring: {joint: way, stiffness: 3e9 N/m, damping: 1e5 N s/m}"
    out = sensors(press(work=stiff))
    same = sensors(press(work=stiff, force="value: \"3e9*way + 1e5*pace\"").replace(
        "signals:\n", "signals:\n  way: {joint-displacement: way}\n  pace: {joint-velocity: way}\n"))
    # Both are the same equations; positions close to 1e-10 of the motion in a step, times the stiffness.
    assert out["force"] == pytest.approx(same["force"], abs=1e-3)


CELL = """
buckens: 1
bodies:
  sled: {rigid: {mass: 3 kg, inertia: [1e-2, 1e-2, 1e-2]}}
  tool: {rigid: {mass: 1 kg, inertia: [1e-2, 1e-2, 1e-2]}}
joints:
  way: {prismatic: {between: [ground, sled], axis: [1, 0, 0]}}
  cell: {fixed: {between: [sled, tool]}}
signals:
SIGNALSloads: {LOADS}
EVENTSsimulation: {duration: 0.2 s, step: 5 ms, METHOD}
output: {every: 5 ms, sensors: {x: {joint-coordinate: way}, cell: {joint-force: cell}, a: {acceleration: {of: tool, along: [1, 0, 0]}}, SENSORS}}
"""


def cell(signals, loads="", events="", seen=(), method="method: generalized-alpha"):
    text = "".join(f"  {line}\n" for line in signals)
    return (CELL.replace("SIGNALS", text).replace("LOADS", loads).replace("EVENTS", events).replace("METHOD", method)
            .replace("SENSORS", ", ".join(f"{name}: {{signal: {name}}}" for name in seen)))


def test_a_reaction_is_that_of_the_end_of_the_last_step(sensors):
    """The tool takes a quarter of the force: R = m₂ u/(m₁ + m₂), u⁺ = P (R₀ - R), an exact recursion."""
    out = sensors(cell(["r: {sensor: {of: cell, component: x}}", "u: \"2.4*(10 - r)\""],
                       "push: {slide-motor: {joint: way, force: u}}", seen=("r", "u")))
    r, exact = 0.0, []
    for _ in out["t"]:
        r = 2.4 * (10 - r) / 4  # of the force that acts on the step that ends here
        exact.append(r)
    # Rounding of multipliers of 10 N.
    assert out["r"] == pytest.approx(exact, abs=1e-10)
    assert out["cell.x"] == pytest.approx(exact, abs=1e-10)
    assert out["u"] == pytest.approx(2.4 * (10 - out["r"]), abs=1e-12)


def test_samples_see_the_readings_of_their_instant(sensors):
    out = sensors(cell(["r: {sensor: {of: cell, component: x}}", "acc: {sensor: a}",
                        "kept: {sample-hold: {input: r, sample: 20 ms}}"],
                       "push: {slide-motor: {joint: way, force: \"40*sin(9*t)\"}}", seen=("r", "acc", "kept")))
    # The tool feels its mass times its acceleration; both are the record's, to the last bit.
    assert numpy.array_equal(out["r"], out["cell.x"]) and numpy.array_equal(out["acc"], out["a"])
    assert out["acc"] == pytest.approx(10 * numpy.sin(9 * out["t"]), abs=1e-10)
    last = 4 * (numpy.arange(len(out["t"])) // 4)
    assert numpy.array_equal(out["kept"], out["r"][last])


@pytest.mark.parametrize("method", ["method: generalized-alpha", "method: hht", "tolerance: 1e-4"])
def test_a_brake_lets_go_when_a_reaction_exceeds_a_limit(sensors, tmp_path, method):
    """The cell feels the force on the tool, 40 t, while a brake holds the sled; it lets go at 4 N, at t = 0.1 s."""
    out = sensors(cell(["r: {sensor: {of: cell, component: x}}", "over: \"-r - 4\""],
                       "hold: {slide-friction: {joint: way, static: 0, preload: 50 N, stick: rigid}}, "
                       "pull: {force: {on: tool, value: [\"40*t N\", 0 N, 0 N]}}",
                       "events: {slip: {when: over, direction: rising, switch-off: hold}}\n", ("r",), method))
    notes = json.loads((tmp_path / "out" / "summary.json").read_text())["notes"]
    told = next(note for note in notes if note.startswith("event"))
    t0 = float(told.split("t = ")[1].split(" s")[0])
    # Readings are joined by a straight line, and the force is one.
    assert t0 == pytest.approx(0.1, abs=1e-9)
    free = out["t"] >= 0.105
    # Switched at most 5 ms/16 late: that much times the acceleration of 1 m/s² of the speed.
    assert out["x.rate"][free] == pytest.approx(5 * (out["t"][free] ** 2 - 0.01), abs=3.2e-4)
    assert abs(out["x.rate"][out["t"] < 0.1 - 1e-9]).max() < 1e-12
    # Then the sled follows: of 40 t it takes three quarters.
    assert out["r"][free] == pytest.approx(-30 * out["t"][free], abs=1e-9)


EVERYTHING = """
buckens: 1
gravity: [0, -9.81, 0]
bodies:
  arm: {rigid: {mass: 2 kg, inertia: [0.1, 0.1, 0.1]}, at: {position: [0.3, 0, 0]}, markers: {tip: {position: [0.3, 0, 0]}, pivot: {position: [-0.3, 0, 0]}}}
  bob: {rigid: {mass: 1 kg, inertia: [0.01, 0.01, 0.01]}, at: {position: [0.6, -0.2, 0]}, markers: {top: {position: [0, 0.2, 0]}}}
joints:
  pin: {spherical: {between: [ground, arm/pivot]}}
  pad: {bushing: {between: [arm/tip, bob/top], stiffness: [8e3, 8e3, 8e3], damping: [20, 20, 20],
                  rotational-stiffness: [30, 30, 30], rotational-damping: [0.1, 0.1, 0.1]}}
signals:
SIGNALSloads:
  strut: {spring-damper: {between: [{ground: [0.6, 0.6, 0]}, arm/tip], stiffness: 400 N/m, damping: 3 N s/m, length: 0.65}}
  breeze: {force: {on: bob, value: ["2*sin(20*t) N", 0 N, 0 N]}}
  land: {contact: {between: [{ground: [0, -0.301, 0]}, bob], shapes: [{plane: [0, 1, 0]}, {sphere: 0.1}], stiffness: 2e4 N/m, static: 0.3}}
simulation: {duration: 0.25 s, step: 0.5 ms}
output: {every: 1.7 ms, sensors: {SENSORS}}
"""


def test_every_sensor_is_read_as_it_is_recorded(sensors):
    seen = {"place": ("position: {of: bob, in: arm}", "xy"), "high": ("position: {of: bob, along: [0, 2, 0]}", ""),
            "fast": ("velocity: bob", "yz"), "spin": ("angular-velocity: {of: arm, in: bob}", "z"),
            "apart": ("relative: {between: [arm, bob], quantity: distance}", ""),
            "beside": ("relative: {between: [arm, bob], quantity: position}", "x"),
            "drift": ("relative: {between: [arm, bob], quantity: velocity}", "y"),
            "twist": ("relative: {between: [arm, bob], quantity: rotation}", "z"),
            "whirl": ("relative: {between: [arm, bob], quantity: angular-velocity}", "z"),
            "tension": ("spring-force: strut", ""), "give": ("spring-force: pad", "xy"), "wring": ("spring-torque: pad", "z"),
            "pull": ("joint-force: {joint: pad, in: arm}", "y"), "touch": ("contact: land", ("normal", "friction", "gap"))}
    held = {"shake": ("acceleration: bob", "y"), "moved": ("displacement: bob", "y"), "turned": ("rotation: arm", "z"),
            "counted": ("relative: {between: [arm, bob], quantity: angle, axis: [0, 0, 1]}", ""),
            "bearing": ("joint-force: pin", "xy"), "wind": ("load-force: breeze", "x"),
            "stored": ("energy: strain", ""), "all": ("energy: total", "")}
    lines, columns, asked = "", "", []
    for name, (spec, components) in (seen | held).items():
        columns += f"{name}: {{{spec}}}, "
        for k, one in enumerate(components or [""]):
            what = f"{{of: {name}, component: {one}}}" if one else name
            lines += f"  s_{name}{k}: {{sensor: {what}}}\n"
            columns += f"q_{name}{k}: {{signal: s_{name}{k}}}, "
            asked.append((f"q_{name}{k}", f"{name}.{one}" if one else name, name in held))
    out = sensors(EVERYTHING.replace("SIGNALS", lines).replace("SENSORS", columns.rstrip(", ")))
    assert out["touch.normal"].max() > 1
    steps = out["t"] / 0.5e-3
    at_step = abs(steps - numpy.round(steps)) < 1e-6
    for signal, sensor, is_held in asked:
        scale = abs(out[sensor]).max() + 1e-9
        if is_held:
            # Equal at the ends of steps, up to the rounding of rotations that are interpolated to them.
            assert out[signal][at_step] == pytest.approx(out[sensor][at_step], abs=1e-11 * scale), sensor
            assert numpy.ptp(out[signal]) > 0 or numpy.ptp(out[sensor]) == 0, sensor
        else:
            # The same formula at the same instant, also between steps.
            assert out[signal] == pytest.approx(out[sensor], abs=1e-12 * scale), sensor
    assert at_step.sum() >= 8


@pytest.mark.parametrize("method", ["method: generalized-alpha", "method: newmark", "method: hht"])
def test_a_run_with_readings_goes_on_bit_for_bit(buckens, tmp_path, method):
    text = cell(["r: {sensor: {of: cell, component: x}}", "acc: {sensor: a}",
                 "turns: {sensor: way}", "slow: {lag: {input: r, time-constant: 8 ms}}",
                 "kept: {sample-hold: {input: acc, sample: 20 ms}}"],
                "push: {slide-motor: {joint: way, force: \"40*sin(90*t) - 0.5*slow - 0.2*kept + turns\"}}", seen=("r", "acc", "slow"),
                method=method).replace("SENSORS", "").replace(", r: {signal", ", way: {energy: work}, r: {signal")
    (tmp_path / "model.yaml").write_text(text)
    buckens("run", "model.yaml", "-q", "-o", "whole").must(0)
    buckens("run", "model.yaml", "-q", "-o", "parts", "--set", "simulation.duration=0.08 s").must(0)
    buckens("run", "--continue", "parts", "--until", 0.14, "-q").must(0)
    buckens("run", "--continue", "parts", "--until", 0.2, "-q").must(0)
    with h5py.File(tmp_path / "whole/results.h5") as one, h5py.File(tmp_path / "parts/results.h5") as other:
        names = [f"sensors/{name}" for name in ("cell", "a", "r", "acc", "slow", "way")]
        assert one["sensors/r"][:].size > 20
        for name in names:
            assert one[name][:].tobytes() == other[name][:].tobytes(), name


ACCELERATION = """
buckens: 1
bodies: {cart: {rigid: {mass: 1 kg, inertia: [1e-2, 1e-2, 1e-2]}}}
joints: {rail: {prismatic: {between: [ground, cart], axis: [1, 0, 0]}}}
signals:
  acc: {sensor: a}
  u: FORCE
loads: {motor: {slide-motor: {joint: rail, force: v}}}
simulation: {duration: 100 ms, step: 1 ms, METHOD}
output: {every: 1 ms, sensors: {a: {acceleration: {of: cart, along: [1, 0, 0]}}}}
"""


def acceleration(gain, follow="value: u", method="method: generalized-alpha"):
    return (ACCELERATION.replace("FORCE", f"\"{gain}*acc + 1\"\n  v: {{{follow}}}").replace("METHOD", method))


@pytest.mark.parametrize("gain, told", [(-2, "-2"), (-1.5, "-1.5"), (3, "3")])
@pytest.mark.parametrize("method", ["method: generalized-alpha", "method: newmark"])
def test_a_feedback_of_the_step_before_that_diverges_is_named(buckens, tmp_path, gain, told, method):
    """a⁺ = g a + 1 grows by g in every step, whatever its length: the run ended with 8e29 m/s² and code 0."""
    (tmp_path / "model.yaml").write_text(acceleration(gain, method=method))
    buckens("run", "model.yaml", "-o", "out").must(
        4, "model.yaml:6:", "signal \"acc\", read from sensor \"a\"", f"about {told} times the one before", "whatever the step", "`lag`")
    # Long before 1e30: growth by 1e9 from the first change is enough.
    with h5py.File(tmp_path / "out" / "results.h5") as file:
        assert 1e6 < abs(file["sensors/a"][:]).max() < 1e13


@pytest.mark.parametrize("gain", [-2, 3])
def test_a_feedback_that_diverges_under_step_control_is_named(buckens, tmp_path, gain):
    """Here steps become shorter and shorter, which does not help, until one fails."""
    (tmp_path / "model.yaml").write_text(acceleration(gain, method="tolerance: 1e-4"))
    buckens("run", "model.yaml", "-o", "out").must(4, "model.yaml:6:", "signal \"acc\" has grown exponentially", "seems to diverge", "gains")


@pytest.mark.parametrize("gain", [-0.9, -0.5, 0.5])
def test_a_feedback_of_the_step_before_that_settles_is_let_be(sensors, gain):
    out = sensors(acceleration(gain))
    assert out["a"][-1] == pytest.approx(1 / (1 - gain), rel=2 * 0.9 ** 100)


def test_the_remedies_of_a_feedback_that_diverges(sensors):
    """With a lag of ten steps the same feedback settles, where the force is -2 a + 1 = a."""
    out = sensors(acceleration(-2, "lag: {input: u, time-constant: 10 ms}"))
    assert out["a"][-1] == pytest.approx(1 / 3, rel=1e-6)


def test_a_feedback_that_jumps_out_of_all_bounds_is_named(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(acceleration(-1e4))
    buckens("run", "model.yaml", "-o", "out").must(4, "model.yaml:6:", "signal \"acc\" has grown to", "diverges", "`lag`")


def test_a_continued_run_remembers_how_readings_have_grown(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(acceleration(-2))
    whole = buckens("run", "model.yaml", "-o", "whole").must(4, "since t = ")
    buckens("run", "model.yaml", "-o", "short", "-q", "--set", "simulation.duration=25 ms").must(0)
    told = [line.split("signal ")[1] for line in whole.err.splitlines() if "error:" in line]
    buckens("run", "--continue", "short", "--until", "100 ms").must(4, told[0])


BAD = {
    "r: {sensor: sell}": ["unknown sensor \"sell\"", "cell"],
    "r: {sensor: cell}": ["signal \"r\": sensor \"cell\" has 3 values", "`component` one of x, y, z"],
    "r: {sensor: {of: cell, component: w}}": ["sensor \"cell\" has no component \"w\"", "x, y, z"],
    "r: {sensor: {of: a, component: x}}": ["sensor \"a\" has no component \"x\"", "single value, leave `component` out"],
    "r: {sensor: s}": ["sensor \"s\" records signal \"q\"", "use that signal itself"],
}


@pytest.mark.parametrize("verb", ["run", "check"])
@pytest.mark.parametrize("signal", list(BAD))
def test_messages(buckens, tmp_path, signal, verb):
    (tmp_path / "model.yaml").write_text(cell(["q: {setting: 0}", signal]).replace(", }}", ", s: {signal: q}}}"))
    buckens(verb, "model.yaml").must(2, "model.yaml:", *BAD[signal])


def test_loops_at_one_instant_are_refused_by_name(buckens, tmp_path):
    text = cell(["m: {sensor: f}", "u: \"2*m + 1\""], "push: {slide-motor: {joint: way, force: u}}").replace(
        ", }}", ", f: {spring-force: push}}}")
    (tmp_path / "model.yaml").write_text(text)
    buckens("run", "model.yaml").must(3, "algebraic loop", "\"m\" needs \"u\" needs \"m\"", "`lag`")
    # A drive needs the rate of what it follows, which a force has not.
    text = cell(["m: {sensor: f}"], "keep: {slide-spring: {joint: way, stiffness: 1 N/m}}").replace(
        ", }}", ", f: {spring-force: keep}}}").replace("fixed: {between: [sled, tool]}",
                                                        "prescribed-translation: {between: [sled, tool], axis: [1, 0, 0], velocity: m}")
    (tmp_path / "model.yaml").write_text(text)
    buckens("run", "model.yaml").must(3, "\"m\"", "measured speed or force")
