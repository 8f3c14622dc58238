# SPDX-License-Identifier: Apache-2.0
"""Towers of boxes that lie askew on each other: standing under a push, sliding and toppling under a larger one."""

import json
import random

import numpy
import pytest

G = 9.81
HEIGHT = 0.1
# Boxes of 1 kg with a friction of 0.5: the topmost slides from 4.905 N on.
BOX = "{box: [0.12, 0.12, 0.1]}"


def tower(seed, push, duration, step="1 ms", count=5):
    chance = random.Random(seed)
    bodies, loads = [], [f"  c0: {{contact: {{between: [ground, b0], shapes: [{{plane: {{}}}}, {BOX}], static: 0.5}}}}"]
    for k in range(count):
        x, y, turn = chance.uniform(-0.01, 0.01), chance.uniform(-0.01, 0.01), chance.uniform(0, 90)
        bodies.append(
            f"  b{k}: {{rigid: {{mass: 1 kg, inertia: [2e-3, 2e-3, 3e-3]}}, at: {{position: [{x}, {y}, "
            f"{HEIGHT * (k + 0.5)}], orientation: {{axis: [0, 0, 1], angle: {turn} deg}}}}}}"
        )
        if k > 0:
            loads.append(
                f"  c{k}: {{contact: {{between: [b{k - 1}, b{k}], shapes: [{BOX}, {BOX}], static: 0.5}}}}"
            )
    loads.append(f"  push: {{force: {{on: b{count - 1}, value: [{push} N, 0, 0]}}}}")
    return (
        f"buckens: 1\ngravity: [0, 0, {-G}]\nbodies:\n"
        + "\n".join(bodies)
        + "\nloads:\n"
        + "\n".join(loads)
        + f"\nsimulation: {{duration: {duration}, step: {step}}}\n"
        + f"output: {{every: 1 ms, sensors: {{top: {{position: b{count - 1}}}, foot: {{position: b0}}, "
        + "lost: {energy: dissipated}, balance: {energy: balance}}}\n"
    )


@pytest.mark.parametrize("seed, push", [(1, 3), (2, 3), (2, 4.7), (3, 4.7)])
def test_a_tower_stands_under_a_push(sensors, tmp_path, seed, push):
    out = sensors(tower(seed, push, "50 ms"))
    for axis in "xyz":
        for body in ("top", "foot"):
            place = out[f"{body}.{axis}"]
            assert numpy.abs(place - place[0]).max() < 1e-13
    # What rests does not strike: places that are out of place by rounding would, in each step.
    summary = json.loads(next(tmp_path.rglob("summary.json")).read_text())
    assert summary["measures"].get("impacts", 0) == 0


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_tower_that_slides_is_not_thrown_up(sensors, seed):
    out = sensors(tower(seed, 7, "80 ms"))
    assert out["top.x"][-1] - out["top.x"][0] > 3e-3
    # Edges roll over edges, by less than a millimetre here; friction that nearly jams threw boxes
    # up by centimetres, with 20 to 80 J from nowhere.
    assert out["top.z"].max() < 0.45 + 5e-3
    assert numpy.abs(out["balance"]).max() < 0.1
    assert numpy.diff(out["lost"]).min() > -1e-9


def test_a_tower_goes_on_where_no_forces_of_an_instant_are_found(sensors):
    """At 0.1 s, after a blow, places jam at the instant; forces over the next step exist."""
    out = sensors(tower(5, 5.5, "0.105 s", step="0.5 ms"))
    assert out["t"][-1] == pytest.approx(0.105, abs=1e-9)
    assert numpy.abs(out["balance"]).max() < 0.03
    assert out["top.z"].max() < 0.45 + 5e-3


@pytest.mark.parametrize("seed, push", [(4, 10), (7, 10), (8, 7), (9, 7), (10, 10)])
def test_a_tower_is_pushed_from_the_start(sensors, seed, push):
    """At rest, with places that tip and slide at once: rounds over their stands find none that hold."""
    out = sensors(tower(seed, push, "20 ms", count=3))
    assert out["t"][-1] == pytest.approx(0.02, abs=1e-9)
    # Friction holds 1 kg with 4.905 N; lower boxes may go with it, and it tips a little.
    gone = out["top.x"][-1] - out["top.x"][0]
    assert gone == pytest.approx(0.5 * (push - 0.5 * G) * 0.02**2, rel=0.15)
    assert numpy.abs(out["top.z"] - out["top.z"][0]).max() < 1e-3
    # Corners that pass from face to edge within a step leave some hundredths to a fifth open in such
    # towers (docs/theory/25-contact.md, section 7).
    assert numpy.abs(out["balance"]).max() < 0.2 * push * gone
