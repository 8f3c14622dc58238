# SPDX-License-Identifier: Apache-2.0
"""Error statements: `buckens run --error` against exact answers."""

import json
import math
import signal
import subprocess
import time

import numpy
import pytest

from conftest import PROGRAM, SOURCE


@pytest.fixture
def state(buckens, tmp_path):
    """Runs a model with an error statement; its summary."""

    def call(text, *arguments):
        (tmp_path / "model.yaml").write_text(text)
        buckens("run", "model.yaml", "-o", "out", "--error", "-q", *arguments).must(0)
        return json.loads((tmp_path / "out" / "summary.json").read_text())

    return call


def covers(stated, exact):
    """The uncertainty is at least the true error and at most ten times as large."""
    error = abs(stated["value"] - exact)
    assert error <= stated["uncertainty"] <= 10 * error, (stated, exact, error)
    assert sum(stated["parts"].values()) <= stated["uncertainty"]


def sources(summary):
    assert summary["errors"]["complete"]
    return [run["source"] for run in summary["errors"]["runs"]]


# ---- six cases and more with known answers

PENDULUM = """
buckens: 1
gravity: [0, -9.81 m/s^2, 0]
planar: xy
bodies:
  rod:
    rigid: {mass: 1 kg, com: [0.5 m, 0, 0], inertia: [0, 0, "1/12 kg m^2"]}
    markers: {pin: {position: [0, 0, 0]}, tip: {position: [1 m, 0, 0]}}
joints:
  pin: {revolute: {between: [ground, rod/pin]}}
simulation: {duration: 2 s, step: 10 ms}
output:
  sensors:
    tip: {position: rod/tip}
    angle: {relative: {between: [ground, rod], quantity: angle}}
"""


def pendulum_angle(t):
    """theta'' = -3g/(2L) cos(theta) from the horizontal, classical Runge-Kutta: 1e-12."""
    def rate(y):
        return numpy.array([y[1], -1.5 * 9.81 * math.cos(y[0])])

    y, steps = numpy.zeros(2), 20000
    h = t / steps
    for _ in range(steps):
        a = rate(y)
        b = rate(y + h / 2 * a)
        c = rate(y + h / 2 * b)
        d = rate(y + h * c)
        y = y + h / 6 * (a + 2 * b + 2 * c + d)
    return y[0]


def test_a_pendulum(state):
    summary = state(PENDULUM)
    assert sources(summary) == ["time step"]
    errors = summary["errors"]["sensors"]
    exact = pendulum_angle(2.0)
    covers(errors["angle"]["final"], exact)
    covers(errors["tip.x"]["final"], math.cos(exact))
    # The tip is at -1 m at the lowest point; an energy error of order h^2 moves that a little.
    assert abs(errors["tip.y"]["peak"]["value"] + 1) <= errors["tip.y"]["peak"]["uncertainty"]
    # z does not move at all: only the tolerance of iterations remains.
    assert errors["tip.z"]["curve"]["uncertainty"] < 1e-8


def test_a_pendulum_with_step_control(state):
    summary = state(PENDULUM.replace("step: 10 ms", "step: auto, tolerance: 1e-4"))
    run = summary["errors"]["runs"][0]
    assert run["source"] == "time step" and 1.2 < run["refinement"] < 4
    stated = summary["errors"]["sensors"]["angle"]["final"]
    error = abs(stated["value"] - pendulum_angle(2.0))
    assert error <= stated["uncertainty"] <= 20 * error  # steps are no uniform refinement


def test_a_spinning_top_that_nothing_holds(state):
    A, C, spin, t = 0.02, 0.03, numpy.array([3.0, 0.0, 8.0]), 1.0
    summary = state(f"""
buckens: 1
bodies:
  top:
    rigid: {{mass: 1 kg, inertia: [{A} kg m^2, {A} kg m^2, {C} kg m^2]}}
    markers: {{rim: {{position: [0.1 m, 0, 0]}}}}
initial: {{bodies: {{top: {{angular-velocity: [{spin[0]} rad/s, 0, {spin[2]} rad/s]}}}}}}
simulation: {{duration: {t} s, step: 5 ms}}
output: {{sensors: {{rim: {{position: top/rim}}}}}}
""")

    def turn(vector):
        angle = numpy.linalg.norm(vector)
        k = numpy.cross(numpy.eye(3), vector / angle)
        return numpy.eye(3) + math.sin(angle) * k + (1 - math.cos(angle)) * k @ k

    # L = A w + (C - A) w3 e3, hence R = exp(t L/A) exp(-t (C - A)/A w3 e3).
    momentum = numpy.array([A, A, C]) * spin
    rotation = turn(t * momentum / A) @ turn(numpy.array([0, 0, -t * (C - A) / A * spin[2]]))
    exact = rotation @ [0.1, 0, 0]
    for axis, value in zip("xyz", exact):
        covers(summary["errors"]["sensors"][f"rim.{axis}"]["final"], value)


def test_a_damped_oscillator(state):
    m, k, c, t = 2.0, 800.0, 4.0, 0.5
    summary = state(f"""
buckens: 1
planar: xy
bodies:
  block: {{rigid: {{mass: {m} kg, inertia: [0, 0, 1 kg m^2]}}, at: {{position: [1 m, 0, 0]}}}}
joints:
  guide: {{prismatic: {{between: [ground, block], axis: [1, 0, 0]}}}}
loads:
  strut: {{spring-damper: {{between: [ground, block], stiffness: {k} N/m, damping: {c} N s/m}}}}
initial: {{bodies: {{block: {{velocity: [1 m/s, 0, 0]}}}}}}
simulation: {{duration: {t} s, step: 5 ms, rho-inf: 1}}
output: {{sensors: {{way: {{displacement: block}}, speed: {{velocity: block}}}}}}
""")
    decay, omega = c / (2 * m), math.sqrt(k / m - (c / (2 * m)) ** 2)
    errors = summary["errors"]["sensors"]
    covers(errors["way.x"]["final"], math.exp(-decay * t) / omega * math.sin(omega * t))
    first = math.atan2(omega, decay) / omega
    covers(errors["way.x"]["peak"], math.exp(-decay * first) / omega * math.sin(omega * first))
    assert errors["way.x"]["curve"]["uncertainty"] >= errors["way.x"]["final"]["uncertainty"]


def test_a_beam_bent_to_a_quarter_circle(state):
    # EI = 100 N m^2, bent by M = EI pi/2 along 1 m: the tip is at R (1, 1), R = 2/pi.
    summary = state(f"""
buckens: 1
planar: xy
bodies:
  beam:
    frames: per-element
    beam:
      to: [1 m, 0, 0]
      elements: 8
      section: {{general: {{A: 1e-2 m^2, Iy: 1e-6 m^4, Iz: 1e-6 m^4, J: 2e-6 m^4}}}}
      material: {{E: 1e8 Pa, nu: 0, rho: 100 kg/m^3}}
joints: {{clamp: {{fixed: {{between: [ground, beam/start]}}}}}}
loads: {{bend: {{torque: {{on: beam/end, value: [0, 0, {50 * math.pi} N m]}}}}}}
initial: {{start: static}}
simulation: {{duration: 4 ms, step: 1 ms}}
output: {{sensors: {{tip: {{position: beam/end}}}}}}
""")
    assert sources(summary) == ["time step", "mesh"]
    errors = summary["errors"]["sensors"]
    for axis in "xy":
        covers(errors[f"tip.{axis}"]["final"], 2 / math.pi)
    # It does not move: the step contributes nothing.
    parts = errors["tip.x"]["final"]["parts"]
    assert parts["time step"] < 1e-3 * parts["mesh"]


def test_a_plate_pulled_at_its_edge(state):
    E, h, b, length, force = 70e9, 5e-3, 0.1, 0.5, 0.02
    summary = state(f"""
buckens: 1
bodies:
  strip:
    mesh:
      plate: {{size: [{length} m, {b} m], divisions: [4, 1], thickness: {h} m}}
      material: {{E: {E} Pa, nu: 0, rho: 2700 kg/m^3}}
    interfaces: {{wall: {{set: [x0], kind: rigid}}}}
    markers: {{left: {{position: [{length} m, 0, 0]}}, right: {{position: [{length} m, {b} m, 0]}}}}
joints: {{clamp: {{fixed: {{between: [ground, strip/wall]}}}}}}
loads:
  left: {{force: {{on: strip/left, value: [0, 0, {force / 2} N]}}}}
  right: {{force: {{on: strip/right, value: [0, 0, {force / 2} N]}}}}
initial: {{start: static}}
simulation: {{duration: 4 ms, step: 1 ms}}
output: {{sensors: {{tip: {{position: strip/left}}}}}}
""")
    assert sources(summary) == ["time step", "mesh"]
    # Without lateral contraction a strip is a beam: F L^3/3EI with shear.
    exact = force * length**3 / (E * b * h**3 / 4) + force * length / (5 / 6 * E / 2 * b * h)
    covers(summary["errors"]["sensors"]["tip.z"]["final"], exact)


REDUCED = """
buckens: 1
planar: xy
bodies:
  beam:
    beam:
      to: [1 m, 0, 0]
      elements: 4
      section: {rectangle: {width: 10 mm, height: 10 mm}}
      material: {E: 2e11 Pa, nu: 0.3, rho: 7850 kg/m^3}
    reduction: {free-free: {modes: 4, static-correction: off}}
joints: {clamp: {fixed: {between: [ground, beam/start]}}}
loads: {pull: {force: {on: beam/end, value: [0, 1 N, 0]}}}
initial: {start: static}
simulation: {duration: 4 ms, step: 1 ms}
output: {sensors: {tip: {position: beam/end}}}
"""


def test_a_reduced_beam(state):
    summary = state(REDUCED)
    assert sources(summary) == ["time step", "mesh", "modes"]
    stated = summary["errors"]["sensors"]["tip.y"]["final"]
    covers(stated, 1.0 / (3 * 2e11 * 0.01**4 / 12))
    assert max(stated["parts"], key=stated["parts"].get) == "modes"


def test_the_slider_crank_with_one_frame(buckens, tmp_path):
    model = SOURCE / "examples" / "slider_crank" / "slider_crank.yaml"
    buckens("run", model, "-o", "out", "--error", "-q", "--set=simulation.duration=8 ms",
            "--set=simulation.step=0.1 ms").must(0)
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    stated = dict(summary["errors"]["sensors"]["mid.y"]["peak"])
    stated["value"] = abs(stated["value"])
    # Geometrically exact beams: the first peak is 0.01541 L (two programs, 64 elements).
    covers(stated, 0.01541 * 0.3)
    assert max(stated["parts"], key=stated["parts"].get) == "frames"
    assert any("frames" in reason for reason in summary["trust"])


def tetrahedra(nx, ny, nz, size):
    """A block of tetrahedra, six to a brick, as a Gmsh file."""
    def number(i, j, k):
        return 1 + i + (nx + 1) * (j + (ny + 1) * k)

    nodes = [(number(i, j, k), i * size[0] / nx, j * size[1] / ny, k * size[2] / nz)
             for k in range(nz + 1) for j in range(ny + 1) for i in range(nx + 1)]
    cells = []
    for k in range(nz):
        for j in range(ny):
            for i in range(nx):
                c = [number(i + a, j + b, k + d) for d in (0, 1) for b in (0, 1) for a in (0, 1)]
                cells += [(c[0], c[p], c[q], c[7]) for p, q in
                          ((1, 3), (3, 2), (2, 6), (6, 4), (4, 5), (5, 1))]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", str(len(nodes))]
    lines += [f"{n} {x!r} {y!r} {z!r}" for n, x, y, z in nodes]
    lines += ["$EndNodes", "$Elements", str(len(cells))]
    lines += [f"{e + 1} 4 2 1 1 {' '.join(map(str, cell))}" for e, cell in enumerate(cells)]
    return "\n".join(lines + ["$EndElements", ""])


def test_a_mesh_from_a_file(state, tmp_path):
    E, length, b, force = 2e11, 1.0, 0.1, 1000.0
    (tmp_path / "bar.msh").write_text(tetrahedra(20, 3, 3, (length, b, b)))
    summary = state(f"""
buckens: 1
bodies:
  bar:
    mesh: {{file: bar.msh, material: {{E: {E} Pa, nu: 0, rho: 7850 kg/m^3}}}}
    interfaces:
      wall: {{plane: {{point: [0, 0, 0], normal: [1, 0, 0]}}, kind: rigid}}
      tip: {{plane: {{point: [{length} m, 0, 0], normal: [1, 0, 0]}}}}
joints: {{clamp: {{fixed: {{between: [ground, bar/wall]}}}}}}
loads: {{pull: {{force: {{on: bar/tip, value: [0, {force} N, 0]}}}}}}
initial: {{start: static}}
simulation: {{duration: 4 ms, step: 1 ms}}
output: {{sensors: {{tip: {{position: bar/tip}}}}}}
""")
    assert sources(summary) == ["time step", "mesh of files"]
    inertia, area = b**4 / 12, b * b
    exact = force * length**3 / (3 * E * inertia) + force * length / (5 / 6 * area * E / 2)
    # The clamp moves the centre of the face to the origin.
    covers(summary["errors"]["sensors"]["tip.y"]["final"], exact)


# ---- what goes with it

def test_the_model_file_can_ask_for_it(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(PENDULUM.replace("step: 10 ms", "step: 10 ms, error: on"))
    result = buckens("run", "model.yaml", "-o", "out").must(0)
    assert "error statement" in result.out and "time step: half the step" in result.out
    assert "run 1 of 1: time step" in result.err
    assert "error statement" in (tmp_path / "out" / "log.txt").read_text()
    quiet = buckens("run", "model.yaml", "-o", "out", "-q").must(0)
    assert quiet.out == "" and quiet.err == ""
    without = buckens("run", "model.yaml", "-o", "out", "--set=simulation.error=off").must(0)
    assert "error statement" not in without.out
    assert "errors" not in json.loads((tmp_path / "out" / "summary.json").read_text())
    told = buckens("run", "model.yaml", "-o", "out", "--json").must(0).json
    assert told["errors"]["sensors"]["angle"]["unit"] == "rad"


def test_the_run_itself_is_as_without(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(PENDULUM)
    buckens("run", "model.yaml", "-o", "plain").must(0)
    buckens("run", "model.yaml", "-o", "stated", "--error").must(0)
    assert ((tmp_path / "plain" / "sensors.csv").read_text()
            == (tmp_path / "stated" / "sensors.csv").read_text())


def test_it_needs_sensors(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(PENDULUM[:PENDULUM.index("output:")])
    buckens("run", "model.yaml", "-o", "out", "--error").must(2, "sensors", "model.yaml")
    assert not (tmp_path / "out").exists()


def test_levels_of_coupling_count(state):
    text = REDUCED.replace("    reduction: {free-free: {modes: 4, static-correction: off}}\n",
                           "    coupling: none\n")
    assert sources(state(text)) == ["time step", "mesh", "frames", "coupling"]


def test_what_cannot_be_assessed_is_named(state):
    text = REDUCED.replace("reduction: {free-free: {modes: 4, static-correction: off}}",
                           "damping: {ratio: 2 %, at: [8 Hz, 50 Hz]}")
    summary = state(text)
    assert "frames" not in sources(summary)
    note = next(note for note in summary["errors"]["notes"] if note.startswith("frames"))
    assert "several frames" in note


SHELLS = """*NODE
1, 0, 0, 0
2, 1, 0, 0
3, 2, 0, 0
4, 0, 1, 0
5, 1, 1, 0
6, 2, 1, 0
*ELEMENT, TYPE=S4, ELSET=PLATE
1, 1, 2, 5, 4
2, 2, 3, 6, 5
"""


@pytest.mark.parametrize("body", ["shells", "matrices"])
def test_sensors_say_which_error_they_lack(buckens, state, tmp_path, body):
    # A shell from a file and a body of given matrices: no further run shows the error of their meshes.
    if body == "shells":
        (tmp_path / "plate.inp").write_text(SHELLS)
        text = ("buckens: 1\ngravity: [0, 0, -9.81]\nbodies: {part: {mesh: {file: plate.inp, section: {thickness: 20 mm, "
                "material: {E: 210 GPa, nu: 0.3, rho: 7850}}}}}\njoints: {hold: {fixed: {between: [ground, part/n1]}}}\n"
                "simulation: {duration: 2 ms, step: 0.1 ms}\noutput: {sensors: {tip: {position: part/n6}}}\n")
        reason = "comes from a file"
    else:
        folder = SOURCE / "examples" / "gyro_rotor"
        for name in ("rotor_mass.mtx", "rotor_stiffness.mtx", "rotor_nodes.csv"):
            (tmp_path / name).write_text((folder / name).read_text())
        text = ("buckens: 1\ngravity: [0, 0, -9.81]\nbodies: {part: {matrices: {mass: rotor_mass.mtx, "
                "stiffness: rotor_stiffness.mtx, nodes: rotor_nodes.csv}}}\n"
                "joints: {hold: {fixed: {between: [ground, part/n1]}}}\n"
                "simulation: {duration: 2 ms, step: 0.1 ms}\noutput: {sensors: {tip: {position: part/n9}}}\n")
        reason = "matrices, which have no elements"
    summary = state(text)
    for stated in summary["errors"]["sensors"].values():
        assert stated["not_assessed"] == ['mesh of "part"'] and list(stated["peak"]["parts"]) == ["time step"]
    assert [note for note in summary["errors"]["notes"] if 'mesh of "part"' in note and reason in note]
    # The table shows them as lower bounds; a run that assesses everything has none.
    assert ">= " in buckens("run", "model.yaml", "-o", "again", "--error").must(0).out
    assert all(s["not_assessed"] == [] for s in state(PENDULUM)["errors"]["sensors"].values())


def test_chaos_is_not_resolved(state):
    model = (SOURCE / "examples" / "double_pendulum" / "double_pendulum.yaml").read_text()
    summary = state(model, "--set=simulation.duration=20 s", "--set=simulation.step=20 ms")
    resolved = [s["resolved"] for s in summary["errors"]["sensors"].values()]
    assert not all(resolved)
    assert any("chaotic" in reason for reason in summary["trust"])


def test_ctrl_c_keeps_the_run(tmp_path):
    (tmp_path / "model.yaml").write_text(
        PENDULUM.replace("duration: 2 s, step: 10 ms", "duration: 20 s, step: 0.1 ms"))
    process = subprocess.Popen([PROGRAM, "run", "model.yaml", "-o", "out", "--error"], cwd=tmp_path,
                               stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True)
    for line in process.stderr:
        if "run 1 of" in line:
            break
    time.sleep(0.05)
    process.send_signal(signal.SIGINT)
    process.stderr.read()
    assert process.wait(timeout=60) == 130
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["finished"] and not summary["errors"]["complete"]


def test_a_jump_has_no_peak_beyond_it(buckens, tmp_path):
    """Two equal balls exchange their speeds: a parabola through the records would reach 56."""
    (tmp_path / "model.yaml").write_text("""
buckens: 1
bodies:
  a: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}, at: {position: [-0.5, 0, 0]}}
  b: {rigid: {mass: 1 kg, inertia: [1, 1, 1]}}
loads: {hit: {contact: {between: [a, b], shapes: [{sphere: 10 mm}, {sphere: 10 mm}], restitution: 1}}}
initial: {bodies: {a: {velocity: [50, 0, 0]}}}
simulation: {duration: 0.1 s, step: 1 ms}
output: {sensors: {b: {velocity: b}}}
""")
    result = buckens("run", "model.yaml", "-o", "out", "--error").must(0)
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    peak = summary["errors"]["sensors"]["b.x"]["peak"]
    assert peak["value"] == pytest.approx(50, rel=1e-9), result.out
