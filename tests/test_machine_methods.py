# SPDX-License-Identifier: Apache-2.0
"""Machines by every integrator: each converges to what generalized-alpha gives with short steps, or refuses by name."""

import numpy
import pytest

from test_save_state import CABLES, GROUPED, LAWS, MESHING, MORE, RIGID, ROUGH, model

METHODS = ["generalized-alpha", "newmark", "hht", "wilson"]
# Machine: model, and sensors that are compared. The rod of LAWS is damped, or what decides is the start's axial vibration at 1e5 Hz,
# which no step here follows.
MACHINES = {
    "cables that slip": (model(CABLES), ["a.x", "a.y", "w.z"]),
    "contacts of surfaces": (model(GROUPED), ["p.z", "foot.z"]),
    "joints that events attach": (model(MESHING), ["a.value", "b.value", "c.value", "way.value", "nut.z", "bead.y"]),
    "joint friction and a stop": (model(LAWS).replace("1e-6 s", "1e-4 s"), ["turned", "moved.x"]),
}
HELD = {"rigid contact with friction": (model(ROUGH), "under"), "a rope and a rigid stop": (model(RIGID), "leash"),
        "a follower on a cam": (model(MORE), "cam")}


@pytest.mark.parametrize("name", MACHINES)
def test_every_method_converges_to_the_same_motion(sensors, name):
    """Corners of laws (a contact that closes, a rope that begins to slip, the instant of an event) fall somewhere within a step: the
    order is one, and irregular. An eighth of the step therefore leaves an eighth of the error, or up to three where it is irregular."""
    text, compared = MACHINES[name]

    def motion(method, step):
        return sensors(text, "-q", "--set", f"simulation.method={method}", "--set", f"simulation.step={step} ms")

    exact = motion("generalized-alpha", 0.0125)
    for method in METHODS:
        errors = []
        for step in (0.4, 0.05):
            found = motion(method, step)
            errors.append(max(numpy.abs(found[s] - exact[s]).max() / numpy.ptp(exact[s]) for s in compared))
        assert errors[1] < 0.3 * errors[0] and errors[0] < 5e-3, (method, errors)


@pytest.mark.parametrize("name", HELD)
def test_rows_at_the_end_of_steps_are_refused_by_methods_without_them(buckens, tmp_path, name):
    """What holds rigidly needs the equations at the end of a step; Newmark's and Wilson's methods have them within."""
    text, load = HELD[name]
    (tmp_path / "model.yaml").write_text(text)
    for method in METHODS:
        done = buckens("run", "model.yaml", "-q", "-o", "out", "--set", f"simulation.method={method}")
        if method in ("newmark", "wilson"):
            done.must(2, f"method {method} satisfies the equations within a step", f'load "{load}" holds rigidly',
                      "use generalized-alpha or hht")
        else:
            done.must(0)
