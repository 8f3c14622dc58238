# SPDX-License-Identifier: Apache-2.0
"""The machine of docs/tutorials/machines.md, put together from the parts that the page shows."""

import json
import re

import pytest

from conftest import SOURCE


def test_the_parts_of_the_page_make_a_machine(sensors, tmp_path):
    page = (SOURCE / "docs" / "tutorials" / "machines.md").read_text()
    mechanism, laws, motor, signals, events = re.findall(r"```yaml\n(.*?)```", page, re.S)
    sensors_of = ", u: {signal: u}, motor: {spring-torque: motor}, y: {position: load}, hook: {joint-force: hook}, balance: {energy: balance}, lost: {energy: dissipated}}}"
    assert mechanism.endswith("}}}\n")
    out = sensors(mechanism[:-4] + "}" + sensors_of + "\n" + signals + events.removeprefix("signals:\n") + laws + motor.removeprefix("loads:\n"))
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    notes = [note for note in summary["notes"] if note.startswith("event")]
    assert [note.split('"')[1] for note in notes] == ["arrived", "drop"]
    assert abs(out["motor"]).max() <= 45 * (1 + 1e-12)
    held = (out["t"] > 1.1) & (out["t"] < 1.2)
    # The integral of the controller is still going down: 4.8 mrad above the goal, with any step.
    assert out["arm.value"][held] == pytest.approx(0.5, abs=6e-3)
    # After 1.2 s the load falls freely.
    free = out["t"] > 1.205
    y, t = out["y.y"][free], out["t"][free]
    fall = (y[2:] - 2 * y[1:-1] + y[:-2]) / 0.005 ** 2
    assert fall == pytest.approx(-9.81, abs=1e-6)
    assert abs(out["hook.y"][free]).max() == 0
    # What rings when the load lets go, too fast for the step, dies out by the method: 0.034 J with 1 ms, half of it with half the step.
    assert abs(out["balance"]).max() < 0.04
