# SPDX-License-Identifier: Apache-2.0
"""Forces and torques on bodies, place by place: compared with weights, centrifugal forces and pressures computed by hand."""

import csv

import h5py
import numpy
import pytest

G = 9.81

# A beam held at its start carries a rigid ball at its end; wind presses on the beam, a crane pulls the ball.
HELD = """
buckens: 1
title: A held beam with a ball
gravity: [0, 0, -9.81 m/s^2]
materials: {steel: {E: 210 GPa, nu: 0.3, rho: 7850 kg/m^3}}
bodies:
  beam: {beam: {to: [1 m, 0, 0], elements: 4, section: {rectangle: {width: 20 mm, height: 20 mm}}, material: steel}}
  ball:
    at: {position: [1 m, 0, 0]}
    rigid: {mass: 2 kg, inertia: [1e-3, 1e-3, 1e-3]}
    markers: {hook: {position: [0, 0, 0.1 m]}}
joints:
  wall: {fixed: {between: [ground, beam/start]}}
  weld: {fixed: {between: [beam/end, ball]}}
loads:
  wind: {line-load: {on: beam, value: [0, 3 N/m, 0]}}
  crane: {force: {on: ball/hook, value: [4 N, 0, 5 N]}}
initial: {start: static}
simulation: {duration: 2 ms, step: 1 ms}
output:
  every: 1 ms
  fields: FIELDS
"""

BEAM_WEIGHT = 0.02 * 0.02 * 1.0 * 7850 * G
BALL_WEIGHT = 2 * G

# A rod on a drive at constant speed: only the pin's force keeps it on its circle.
TURNING = """
buckens: 1
title: A turning block
materials: {plain: {E: 210 GPa, nu: 0, rho: 7850 kg/m^3}}
bodies:
  block:
    mesh: {box: {size: [0.4 m, 0.1 m, 0.1 m], divisions: [4, 1, 1]}, material: plain}
    interfaces: {hub: {face: x0, kind: average}}
joints:
  pin:
    revolute: {between: [{ground: [0, 0.05 m, 0.05 m]}, block/hub], axis: [0, 0, 1]}
initial: {bodies: {block: {velocity: [0, 4, 0], angular-velocity: [0, 0, 20]}}}
simulation: {duration: 0.2 s, step: 1 ms, rho-inf: 0}
output: {every: 20 ms, fields: {record: [interface-load], on: [block/hub]}}
"""


def run(buckens, tmp_path, text, *verb):
    (tmp_path / "model.yaml").write_text(text)
    buckens(*(verb or ("run",)), "model.yaml", "-o", "out", "-q").must(0)
    return h5py.File(tmp_path / "out" / "results.h5", "r", swmr=True)


def test_loads_on_a_held_beam_are_its_weights(buckens, tmp_path):
    with run(buckens, tmp_path, HELD.replace("FIELDS", "[interface-load]")) as file:
        beam, ball = file["fields/bodies/beam"], file["fields/bodies/ball"]
        assert set(beam) == {"interfaces", "loads"}
        assert set(beam["interfaces"]) == {"start", "end"} and set(beam["loads"]) == {"wind"}
        assert set(ball["interfaces"]) == {"com", "hook"} and set(ball) == {"interfaces"}
        start = beam["interfaces/start"]
        assert list(start.attrs["components"]) == ["Fx", "Fy", "Fz", "Mx", "My", "Mz"]
        assert start.attrs["unit"] == "N, N m"
        # At rest; 32-bit numbers, and lever arms change by the deflection of some 3 mm (4 N along the beam on it).
        rest = dict(rel=1e-5, abs=0.02)
        assert ball["interfaces/hook"][0] == pytest.approx([4, 0, 5, 0, 0, 0], abs=1e-6)
        assert ball["interfaces/com"][0] == pytest.approx([-4, 0, BALL_WEIGHT - 5, 0, -0.4, 0], **rest)
        assert beam["interfaces/end"][0] == pytest.approx([4, 0, 5 - BALL_WEIGHT, 0, 0.4, 0], **rest)
        assert beam["loads/wind"][0] == pytest.approx([0, 3, 0, 0, 0, 0], abs=1e-4)
        bending = 0.4 + (BALL_WEIGHT - 5) + BEAM_WEIGHT / 2
        assert start[0] == pytest.approx([-4, -3, BALL_WEIGHT - 5 + BEAM_WEIGHT, 0, -bending, -1.5], **rest)


def test_the_pin_of_a_turning_block_holds_its_centrifugal_force(buckens, tmp_path):
    with run(buckens, tmp_path, TURNING) as file:
        # The block starts undeformed and first vibrates along its length; by then rho-inf 0 has damped that out.
        late = file["fields/time"][:] > 0.1
        load = file["fields/bodies/block/interfaces/hub"][late]
        mass, speed, radius = 0.4 * 0.1 * 0.1 * 7850, 20.0, 0.2
        size = numpy.hypot(load[:, 0], load[:, 1])
        # Order 2 of the method: (speed * step)^2 = 4e-4.
        assert size == pytest.approx(mass * speed**2 * radius, rel=1e-3)
        pose = file["bodies/block/pose"][late]
        inwards = -pose[:, :2] + [0.0, 0.05]
        inwards /= numpy.linalg.norm(inwards, axis=1)[:, None]
        assert (load[:, :2] * inwards).sum(1) / size == pytest.approx(1, abs=1e-4)
        # The same as the joint's own channel, whose second marker is the hub.
        assert load[:, :3] == pytest.approx(file["joints/pin/force"][late], rel=1e-5, abs=1e-3)


def test_a_place_that_is_no_node_has_loads_only(buckens, tmp_path):
    text = HELD.replace("  beam: {beam:", "  beam: {markers: {tap: {position: [0.1 m, 0, 0]}}, beam:").replace("ball/hook, value", "beam/tap, value")
    text = text.replace("FIELDS", "{record: [velocity, interface-load], on: [beam/tap]}")
    with run(buckens, tmp_path, text) as file:
        assert set(file["fields/bodies/beam"]) == {"interfaces"}
        assert file["fields/bodies/beam/interfaces/tap"][0, :3] == pytest.approx([4, 0, 5])


def test_loads_at_chosen_times_and_places_are_tables(buckens, tmp_path):
    fields = "{record: [interface-load], on: [ball/hook, beam/start], every: 2 ms}"
    run(buckens, tmp_path, HELD.replace("FIELDS", fields)).close()
    buckens("export", "out", "--csv").must(0)
    with open(tmp_path / "out" / "export" / "ball_loads.csv", newline="") as file:
        rows = list(csv.reader(file))
    assert rows[0] == ["t [s]", "hook.Fx [N]", "hook.Fy [N]", "hook.Fz [N]",
                       "hook.Mx [N m]", "hook.My [N m]", "hook.Mz [N m]"]
    assert [float(row[0]) for row in rows[1:]] == [0.0, 0.002]
    assert [float(x) for x in rows[2][1:]] == pytest.approx([4, 0, 5, 0, 0, 0])
    with open(tmp_path / "out" / "export" / "beam_loads.csv", newline="") as file:
        assert len(next(csv.reader(file))) == 1 + 6


def test_applied_loads_on_a_static_path_take_its_factor(buckens, tmp_path):
    text = HELD.replace("FIELDS", "[interface-load]").replace("gravity: [0, 0, -9.81 m/s^2]", "gravity: [0, 0, 0]")
    with run(buckens, tmp_path, text.replace("every: 1 ms", "every: 1 ms\n  sensors: {pull: {load-force: crane}}"),
             "static") as file:
        factor = file["sensors/load-factor"][:]
        assert factor[0] == 0 and factor[-1] == 1
        assert file["fields/bodies/ball/interfaces/hook"][:, 2] == pytest.approx(5 * factor, abs=1e-6)
        assert file["sensors/pull"][:, 2] == pytest.approx(5 * factor, abs=1e-6)
        # In balance at every point of the path.
        start = file["fields/bodies/beam/interfaces/start"][:]
        assert start[:, :3] == pytest.approx(numpy.outer(factor, [-4, -3, -5]), abs=1e-4)


@pytest.mark.parametrize("fields, words", [
    ("{record: [interface-load], on: [ball/hok]}", ["output.fields.on", "\"ball\"", "\"hok\"", "\"hook\""]),
    ("{record: [interface-load], on: [beam/mid]}", ["output.fields", "no joint and no load"]),
    ("{record: [von-mises], on: [ball]}", ["\"ball\"", "rigid", "interface-load"]),
])
def test_places_without_loads_are_refused(buckens, tmp_path, fields, words):
    (tmp_path / "model.yaml").write_text(HELD.replace("FIELDS", fields))
    buckens("run", "model.yaml", "-o", "out").must(2, "model.yaml", *words)
