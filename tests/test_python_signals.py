# SPDX-License-Identifier: Apache-2.0
"""Signals and commands of motors that Python sets between steps, or gives by functions within them."""

import copy
import math
import pathlib
import sys

import numpy as np
import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent / "support"))
from python_module import buckens  # noqa: E402 (found after the path is set)

# A wheel of 0.5 kg m^2 on a shaft with a motor that gets its torque from the signal `command`.
WHEEL = {
    "title": "Wheel", "planar": "xy",
    "bodies": {"wheel": {"rigid": {"mass": 1, "inertia": [0, 0, 0.5]}}},
    "joints": {"shaft": {"revolute": {"between": ["ground", "wheel"]}}},
    "signals": {"angle": {"joint-angle": "shaft"}, "speed": {"joint-speed": "shaft"},
                "command": {"setting": 0}, "effort": {"force-of": "motor"}},
    "loads": {"motor": {"hinge-motor": {"joint": "shaft", "torque": "command"}}},
    "simulation": {"duration": 1, "step": "1 ms"},
    "output": {"every": "10 ms", "sensors": {"angle": {"joint-coordinate": "shaft"}}},
}


def wheel(**changes):
    return buckens.Model.from_dict({**copy.deepcopy(WHEEL), **changes})


def test_a_command_is_set_between_steps():
    sim = buckens.Simulation(wheel())
    assert list(sim.signals) == ["angle", "speed", "command", "effort"] and sim.model.signals == list(sim.signals)
    sim.set_signal("command", 2)  # before the first step all follows at once
    assert sim.signals["command"] == 2 and sim.signals["effort"] == pytest.approx(2, rel=1e-12)
    sim.advance(0.5)
    sim.set_signal("command", np.float64(-2.0))
    summary = sim.run()
    # 4 rad/s^2 for half a second, then back to rest: constant torques are integrated exactly, and the
    # acceleration jumps with the torque.
    assert sim.signals["angle"] == pytest.approx(1.0, abs=1e-9)
    assert sim.signals["speed"] == pytest.approx(0.0, abs=1e-9)
    assert abs(summary["energy_error"]) < 1e-2


def test_a_controller_between_steps_lags_by_half_of_one():
    """Torque -k angle, held over a step: a mean delay of h/2 lets the swing grow by e^(w^2 h t/4)."""
    sim = buckens.Simulation(wheel(initial={"joints": {"shaft": {"speed": "1 rad/s"}}},
                                   simulation={"duration": 1, "step": "0.1 ms"}), record=False)

    @sim.on_step
    def control(now):
        now.set_signal("command", -50 * now.signals["angle"])

    sim.run()
    # w = 10; what remains is of second order in w h = 1e-3.
    assert sim.signals["angle"] == pytest.approx(math.sin(10) / 10 * math.exp(100 * 1e-4 / 4), rel=1e-4)


def test_a_function_is_the_formula_without_delay():
    signals = {**WHEEL["signals"], "command": "200*(0.5 - angle) - 4*speed + 3*sin(20*t)"}
    library = buckens.Simulation(wheel(signals=signals))
    expected = library.run()
    model = wheel()

    @model.signal()
    def command(t, angle, speed, gain=200):  # what has a default is no signal
        return gain * (0.5 - angle) - 4 * speed + 3 * math.sin(20 * t)

    sim = buckens.Simulation(model)
    summary = sim.run()
    # The same arithmetic up to the rounding of two evaluations.
    assert sim.curves["angle.value"] == pytest.approx(library.curves["angle.value"], abs=1e-12)
    # Derivatives by differences as of a formula: 200 N m/rad and 1 ms would need many more iterations without.
    assert summary["newton_iterations"] == expected["newton_iterations"]

    own = buckens.Simulation(wheel())

    @own.signal("command", inputs=["angle", "speed"])
    def anything(t, *values):
        return np.array(200.0) * (0.5 - values[0]) - 4 * values[1] + 3 * math.sin(20 * t)

    own.run()
    assert own.curves["angle.value"] == pytest.approx(sim.curves["angle.value"], abs=1e-12)
    with pytest.raises(buckens.InputError, match='"command" is given by a function'):
        sim.set_signal("command", 1)
    with pytest.raises(buckens.InputError, match="function as the signal 'command'"):
        buckens.check(model)
    assert "setting" in model.to_yaml() and model.with_changes({"title": "again"})._signals == model._signals


def test_functions_of_functions_and_blocks():
    """A function may feed blocks and take their values: a lag of T = 0.1 s in front of the motor."""
    signals = {"speed": {"joint-speed": "shaft"}, "demand": 0, "late": {"lag": {"input": "demand", "time-constant": 0.1}},
               "command": {"setting": 0}}
    model = wheel(signals=signals)

    @model.signal("demand")
    def step(t):
        return 3.0

    @model.signal()
    def command(t, late):
        return 0.5 * late

    sim = buckens.Simulation(model)
    sim.run()
    # dw/dt = 3 (1 - e^(-t/T)); h = 1 ms leaves (h/T)^2/12.
    assert sim.signals["late"] == pytest.approx(3 * (1 - math.exp(-10)), rel=1e-5)
    assert sim.signals["speed"] == pytest.approx(3 * (1 - 0.1 * (1 - math.exp(-10))), rel=1e-4)


def test_settings_are_saved(tmp_path):
    model = wheel()
    whole = buckens.Simulation(model)
    whole.advance(0.2)
    whole.set_signal("command", 0.7)
    whole.save(tmp_path / "state.h5")
    rest = buckens.Simulation.resume(tmp_path / "state.h5", model)
    assert rest.signals["command"] == 0.7
    for sim in (whole, rest):
        sim.advance(0.6)
        sim.set_signal("command", -0.3)
        sim.run()
    assert rest.signals["angle"] == whole.signals["angle"] and rest.energies["total"] == whole.energies["total"]
    assert np.array_equal(rest.bodies["wheel"].frame.rotation, whole.bodies["wheel"].frame.rotation)
    # A model whose signal is given by a function is another one.
    other = wheel()
    other.signal("command")(lambda t, angle: -angle)
    with pytest.raises(buckens.InputError, match="signal command was missing, is function of t, angle"):
        buckens.Simulation.resume(tmp_path / "state.h5", other)


def test_what_functions_raise_comes_out_unchanged(tmp_path):
    thrown = RuntimeError("no more")
    sim = buckens.Simulation(wheel(), out=tmp_path / "out")

    @sim.signal()
    def command(t, angle):
        if t > 0.1:
            raise thrown
        return 1.0

    with pytest.raises(RuntimeError) as caught:
        sim.run()
    assert caught.value is thrown
    run = buckens.open(tmp_path / "out")
    assert run.status == "interrupted" and 0.08 < run.time[-1] <= 0.1 + 1e-9


@pytest.mark.parametrize("function, error, words", [
    (lambda t: "far", TypeError, "value of signal \"command\" must be a number, found 'far'"),
    (lambda t: None, TypeError, "must be a number, found None"),
    (lambda t, angle: float("nan"), buckens.NumericalError, "\"command\": its function gives nan at t = 0 s, angle = 0"),
    (lambda t, angel: 0, buckens.InputError, '"command" takes "angel", and there is no such signal.*"angle"'),
    (lambda t, command: 0, buckens.ModelError, 'algebraic loop: "command" needs "command"'),
    (lambda t, effort: 0, buckens.ModelError, 'algebraic loop: .*"effort"'),
    (lambda *all: 0, buckens.InputError, "do not say which signals it takes; write f.t, angle, speed."),
    (lambda: 0, buckens.InputError, "do not say which signals it takes"),
    (3, buckens.InputError, "signal: expected a function, found 3"),
])
def test_functions_of_the_wrong_kind(function, error, words):
    with pytest.raises(error, match=words):
        model = wheel()
        model.signal("command")(function)
        buckens.Simulation(model).run()


def test_names_of_signals():
    sim = buckens.Simulation(wheel())
    with pytest.raises(buckens.InputError, match='no signal "comand".*"command"'):
        sim.set_signal("comand", 1)
    with pytest.raises(buckens.InputError, match='no signal "angel".*"angle"'):
        sim.signals["angel"]
    with pytest.raises(buckens.InputError, match='"angle" follows from the motion; only signals with a `setting`'):
        sim.set_signal("angle", 1)
    for wrong in ("2 N m", None, [1, 2]):
        with pytest.raises(buckens.InputError, match="signal 'command': expected a number, found"):
            sim.set_signal("command", wrong)
    with pytest.raises(buckens.InputError, match='"command": its value inf is not finite'):
        sim.set_signal("command", math.inf)
    with pytest.raises(buckens.InputError, match='"motor" acts on the coordinate of a joint.*`setting`'):
        sim.set_load("motor", [0, 0, 1])
    model = wheel()
    with pytest.raises(buckens.InputError, match=r"inputs are a list of names, found 'angle'; write \['angle'\]"):
        model.signal("command", inputs="angle")(lambda t, a: 0)
    model.signal("angle")(lambda t: 0)
    with pytest.raises(buckens.ModelError, match='"angle" follows from the motion or has states'):
        buckens.Simulation(model)
    events = {"far": {"when": "angle", "set": {"command": 1}}}
    model = wheel(events=events)
    model.signal("command")(lambda t: 0)
    with pytest.raises(buckens.ModelError, match='event "far" sets the signal "command", which a function gives'):
        buckens.Simulation(model)
    bare = buckens.Simulation(wheel(signals={}, loads={}))
    with pytest.raises(buckens.InputError, match='"command": the model has none; add `signals: {command: {setting: 0}}`'):
        bare.set_signal("command", 1)
    assert dict(bare.signals) == {}
    sim.step()
    with pytest.raises(buckens.InputError, match="function of signal 'command' comes too late"):
        sim.signal("command")(lambda t: 0)
