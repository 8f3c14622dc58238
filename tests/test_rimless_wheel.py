# SPDX-License-Identifier: Apache-2.0
"""A wheel of spokes without a rim walks down a slope: its feet are pinned by events as they land."""

import math

import numpy
import pytest

SPOKES, SLOPE, G = 8, 0.08, 9.81
ALPHA = math.pi / SPOKES
STEP = 2 * math.sin(ALPHA)


def wheel(speed, steps, settings):
    """All its mass at the hub; x runs down the slope, and gravity is turned in its place."""
    feet = "".join(f"      f{k}: {{position: [{math.sin(ALPHA * (1 + 2 * k))!r}, {-math.cos(ALPHA * (1 + 2 * k))!r}, 0]}}\n"
                   for k in range(SPOKES))
    pins = "".join(f"  p{k}: {{revolute: {{between: [{{ground: [{k * STEP!r}, 0, 0]}}, wheel/f{k % SPOKES}]}}}}\n"
                   for k in range(steps + 1))
    heights = "".join(f"  h{k}: {{position: {{of: wheel/f{k % SPOKES}, along: [0, 1, 0]}}}}\n  low{k}: \"h{k} - 1e-9\"\n"
                      for k in range(1, steps + 1))
    lands = "".join(f"  land{k}: {{when: low{k}, direction: falling, release: p{k - 1}, attach: p{k}, record: on}}\n"
                    for k in range(1, steps + 1))
    hub = -math.sin(ALPHA), math.cos(ALPHA)
    return f"""
buckens: 1
planar: xy
gravity: [{G * math.sin(SLOPE)!r}, {-G * math.cos(SLOPE)!r}, 0]
bodies:
  wheel:
    rigid: {{mass: 1 kg, inertia: [0, 0, 1e-9]}}
    at: {{position: [{hub[0]!r}, {hub[1]!r}, 0]}}
    markers:
{feet}joints:
{pins}signals:
{heights}events:
{lands}initial:
  released: [{", ".join(f"p{k}" for k in range(1, steps + 1))}]
  bodies: {{wheel: {{velocity: [{speed * hub[1]!r}, {-speed * hub[0]!r}, 0], angular-velocity: [0, 0, {-speed!r}]}}}}
simulation: {{duration: 5.3 s, {settings}}}
output:
  every: 1 ms
  sensors: {{hub: {{position: wheel}}, w: {{angular-velocity: wheel}}, energy: {{energy: total}}, lost: {{energy: dissipated}}, balance: {{energy: balance}}}}
"""


FIXED = math.sqrt(4 * G * math.sin(ALPHA) * math.sin(SLOPE)) / math.tan(2 * ALPHA)


@pytest.mark.parametrize("start, settings", [(FIXED, "step: 1 ms"), (1.4, "step: 1 ms"), (1.4, "step: 1 ms, method: newmark"),
                                             (1.4, "step: 1 ms, tolerance: 1e-6")])
def test_a_rimless_wheel_comes_to_its_gait(sensors, start, settings):
    """Every landing leaves cos(2 alpha) of the speed; from landing to landing the slope adds 4 g/l sin alpha sin gamma."""
    assert FIXED == pytest.approx(1.09546284, abs=5e-9)
    out = sensors(wheel(start, 7, settings))
    t, w = out["t"], -out["w.z"]
    jumps = [k for k in range(1, len(t)) if w[k] < w[k - 1] - 0.15 * w[k - 1]]
    assert len(jumps) >= 5
    after = start
    for k in jumps:
        before = math.sqrt(after**2 + 4 * G * math.sin(ALPHA) * math.sin(SLOPE))
        after = before * math.cos(2 * ALPHA)
        # Landings are located to h/16; within a record of 1 ms the speed changes by up to 4 rad/s² more.
        assert w[k - 1] == pytest.approx(before, abs=5e-3)
        assert w[k] == pytest.approx(after, abs=5e-3)
    if start == FIXED:
        assert after == pytest.approx(FIXED, rel=1e-9)
        # From landing to landing it takes always the same time.
        assert numpy.diff(t[jumps]) == pytest.approx(numpy.diff(t[jumps])[0], abs=2.5e-3)
    else:
        assert after == pytest.approx(FIXED, abs=abs(start - FIXED) * 0.5**len(jumps) * 1.5)
    # The hub runs on arcs about the feet, from one landing to the next.
    foot = numpy.searchsorted(t[jumps], t, side="right")
    assert numpy.hypot(out["hub.x"] - foot * STEP, out["hub.y"])[5:] == pytest.approx(1, abs=2e-4)
    # Nothing but the landings loses energy.
    assert abs(out["balance"]).max() < 1e-3 * abs(out["lost"][-1]) + 1e-5
