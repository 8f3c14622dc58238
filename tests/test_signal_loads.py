# SPDX-License-Identifier: Apache-2.0
"""Loads on markers, faces, lines and volumes whose values a signal multiplies."""

import numpy
import pytest

BEAM = """buckens: 1
materials: {plastic: {E: 1 GPa, nu: 0.3, rho: 1400, damping: {stiffness: 1 ms}}}
bodies: {rod: {beam: {to: [0.5, 0, 0], elements: 4, section: {circle: {diameter: 20 mm}}, material: plastic}}}
joints: {root: {fixed: {between: [ground, rod/start]}}}
SIGNALS
loads: {push: LOAD}
simulation: {duration: 0.1 s, step: 1 ms}
output: {every: 1 ms, sensors: {tip: {displacement: TIP}}}
"""
BLOCK = BEAM.replace("{rod: {beam: {to: [0.5, 0, 0], elements: 4, section: {circle: {diameter: 20 mm}}, material: plastic}}}", """
  rod:
    mesh: {box: {size: [0.5, 0.05, 0.05], divisions: [4, 1, 1]}, material: plastic}
    interfaces: {start: {face: x0}, end: {face: x1}}""")
SIGNALS = "signals: {swing: \"sin(40*t)\", ramp: {integral: {input: 5}}}"
# Kind: model, load with a value V (a number), axes.
LOADS = {
    "force": (BEAM, "{force: {on: rod/end, value: [0, V, 0]SIGNAL}}", 20),
    "torque": (BEAM, "{torque: {on: rod/end, value: [0, 0, V], axes: following SIGNAL}}", 2),
    "line load": (BEAM, "{line-load: {on: rod, value: [0, V, 0]SIGNAL}}", 50),
    "body force": (BEAM, "{body-force: {on: rod, per-mass: [0, V, 0]SIGNAL}}", 30),
    "pressure": (BLOCK, "{pressure: {on: rod/y1, value: V SIGNAL}}", 2000),
    "traction": (BLOCK, "{traction: {on: rod/y1, value: [0, V, 0], axes: following SIGNAL}}", 2000),
    "force per volume": (BLOCK, "{body-force: {on: rod, per-volume: [0, V, 0]SIGNAL}}", 3e4),
}


@pytest.mark.parametrize("name", LOADS)
def test_a_signal_multiplies_the_value(sensors, name):
    """The same as the product as a law of time: a formula of t, and the integral of a constant, which is a ramp."""
    text, load, value = LOADS[name]
    text = text.replace("TIP", "rod/end")

    def motion(size, signal):
        return sensors(text.replace("SIGNALS", SIGNALS if signal else "").replace("LOAD", load).replace("SIGNAL", signal and ", signal: " + signal)
                       .replace("V", size), "-q")["tip.y"]

    for signal, law in (("swing", f"\"{value}*sin(40*t)\""), ("ramp", f"\"{value}*5*t\"")):
        by_law, by_signal = motion(law, ""), motion(str(value), signal)
        assert numpy.abs(by_law).max() > 1e-5
        # Rounding, and that of the integral.
        assert by_signal == pytest.approx(by_law, abs=1e-12 * numpy.abs(by_law).max() + 1e-17)


@pytest.mark.parametrize("name", LOADS)
def test_an_unknown_signal_is_refused(buckens, tmp_path, name):
    text, load, value = LOADS[name]
    (tmp_path / "model.yaml").write_text(text.replace("TIP", "rod/end").replace("SIGNALS", SIGNALS).replace("LOAD", load)
                                         .replace("SIGNAL", ", signal: swng").replace("V", str(value)))
    buckens("check", "model.yaml").must(2, "model.yaml:", 'load "push": there is no signal "swng"', 'Did you mean "swing"?')


def test_a_pressure_follows_the_motion(sensors):
    """A valve that opens with the way of its piston: m x'' = p A (1 - x/l), a sine about x = l."""
    out = sensors("""buckens: 1
materials: {steel: {E: 200 GPa, nu: 0.3, rho: 8000}}
bodies:
  piston:
    mesh: {box: {size: [0.1, 0.1, 0.1], divisions: [1, 1, 1]}, material: steel}
    interfaces: {back: {face: x0}}
joints: {way: {prismatic: {between: [ground, piston/back], axis: [1, 0, 0]}}}
signals: {way: {joint-displacement: way}, opening: "1 - way/0.2"}
loads: {gas: {pressure: {on: piston/x0, value: 16 kPa, signal: opening}}}
simulation: {duration: 0.2 s, step: 0.25 ms}
output: {every: 5 ms, sensors: {x: {joint-coordinate: way}}}
""")
    w = (16e3 * 0.01 / 8 / 0.2) ** 0.5  # 10 rad/s
    # (w h)²/12 of the phase w t, 5e-7 of 0.2 m each; the block gives by p A l/(E A), 1e-8 m.
    assert out["x.value"] == pytest.approx(0.2 * (1 - numpy.cos(w * out["t"])), abs=5e-7)
