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


def speeds_after_landings(out, start):
    """Differences of the speed that the wheel has after each landing from theirs that follow from `start`, and their spread.

    Simulated: what any record between two landings makes of it, as energy is kept about a foot."""
    w, x, y = -out["w.z"], out["hub.x"], out["hub.y"]
    jumps = 1 + numpy.flatnonzero(w[1:] < 0.85 * w[:-1])
    foot = numpy.searchsorted(jumps, numpy.arange(len(w)), side="right")
    x = x - foot * STEP
    gained = 2 * G * (math.cos(SLOPE) * (y - math.cos(ALPHA)) - math.sin(SLOPE) * (x + math.sin(ALPHA)))
    after = numpy.sqrt(w**2 + gained)
    exact, errors, spread = start, [], []
    for k in range(len(jumps) + 1):
        here = numpy.flatnonzero(foot == k)[2:-2]
        assert numpy.hypot(x[here], y[here]) == pytest.approx(1, abs=1e-8)  # what Drake asks of the foot
        errors.append(after[here].mean() - exact)
        spread.append(numpy.ptp(after[here]))
        exact = math.sqrt(exact**2 + 4 * G * math.sin(ALPHA) * math.sin(SLOPE)) * math.cos(2 * ALPHA)
    return numpy.array(errors), max(spread)


def test_speeds_after_landings_converge(sensors):
    steps, smooth, landed = (2, 0.5), [], []
    for step in steps:
        errors = []
        for start in (FIXED, 1.4):
            out = sensors(wheel(start, 7, f"step: {step} ms").replace("every: 1 ms", f"every: {step} ms"))
            found, spread = speeds_after_landings(out, start)
            assert len(found) >= 6
            # Drake asks for 1e-5 of the energy between landings; that is of order two.
            assert 1.5 * spread < 1e-5 * (step / 2) ** 2
            smooth.append(found[0])
            errors += list(found[1:])
        # A landing is late by at most a sixteenth of a step, in which the speed gains 4.5 rad/s², and the leg gets as much
        # further: with both, and what earlier landings hand on, at most 0.6 rad/s² h.
        assert numpy.abs(errors).max() < 0.6e-3 * step
        landed.append(numpy.sqrt(numpy.mean(numpy.square(errors))))
    # Before the first landing of order two; after landings of order one, of which chance decides what share: eleven of them.
    assert numpy.log2(numpy.array(smooth[:2]) / smooth[2:]) / 2 == pytest.approx(2, abs=0.05)
    assert numpy.log2(landed[0] / landed[1]) / 2 == pytest.approx(1, abs=0.3)
