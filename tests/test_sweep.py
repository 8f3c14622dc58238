# SPDX-License-Identifier: Apache-2.0
"""`buckens sweep`: concurrent variants give the same results as alone, and nothing is lost."""

import csv
import json
import subprocess

import numpy
import pytest

from conftest import PROGRAM

# Solids: a factor large enough that reading it once for several variants pays.
LARGE_BLOCK = """
buckens: 1
gravity: [0, "-g", 0]
parameters: {g: 9.81 m/s^2, push: 0 N}
materials: {soft: {E: 1e8 Pa, nu: 0.3, rho: 1000 kg/m^3}}
bodies:
  block: {mesh: {box: {size: [1 m, 0.1 m, 0.1 m], divisions: [16, 4, 4]}, material: soft}}
joints: {pin: {spherical: {between: [ground, block/face_x0]}}}
loads: {push: {force: {on: block/face_x1, value: [0, "push*sin(200*t)", 0]}}}
simulation: {duration: 4 ms, step: 0.2 ms}
output: {every: 1 ms, sensors: {tip: {position: block/face_x1}, pin: {joint-force: pin}}}
"""


@pytest.fixture
def large_block(tmp_path):
    (tmp_path / "block.yaml").write_text(LARGE_BLOCK)
    return tmp_path / "block.yaml"


def sensors_of(directory):
    return numpy.loadtxt(directory / "sensors.csv", delimiter=",", skiprows=1)


def table_of(directory):
    return list(csv.DictReader((directory / "sweep.csv").open()))


def test_variants_are_what_they_are_alone(buckens, large_block, tmp_path):
    (tmp_path / "table.csv").write_text(
        "name,parameters.g,parameters.push\n"
        "plain,9.81 m/s^2,0 N\nmoon,1.62 m/s^2,0 N\npushed,9.81 m/s^2,5 N\n"
        "nudged,9.81,1 N\n")
    result = buckens("sweep", large_block, "table.csv", "-o", "out", "--json").must(0)
    rows = table_of(tmp_path / "out")
    assert [row["name"] for row in rows] == ["plain", "moon", "pushed", "nudged"]
    assert {row["status"] for row in rows} == {"done"}
    # One factor for the four; every pass over it serves all that are waiting.
    assert result.json["factorisations"] == 1
    assert result.json["passes"] <= result.json["solves"] / 3
    for row in rows:
        buckens("run", large_block, "-o", "alone", "-q", "--set", "parameters.g=" + row["parameters.g"],
                "--set", "parameters.push=" + row["parameters.push"]).must(0)
        together, alone = sensors_of(tmp_path / "out" / row["name"]), sensors_of(tmp_path / "alone")
        # Another number of columns may round differently; the documented tolerance is 1e-10 of the largest.
        for column in range(together.shape[1]):
            scale = abs(alone[:, column]).max()
            assert abs(together[:, column] - alone[:, column]).max() <= 1e-10 * scale + 1e-14
        assert float(row["tip.y [m] last"]) == together[-1, 2]
        assert float(row["tip.y [m] min"]) == together[:, 2].min()
        assert int(row["steps"]) == 20


def test_variants_do_not_depend_on_how_many_go_together(buckens, tmp_path):
    # Large enough for passes over common tables to be made together.
    (tmp_path / "block.yaml").write_text(LARGE_BLOCK.replace("[16, 4, 4]", "[30, 8, 8]"))
    (tmp_path / "table.csv").write_text(
        "name,parameters.push\na,0 N\nb,5 N\nc,1 N\nd,-20 N\n")
    for count in ("2", "4"):
        buckens("sweep", "block.yaml", "table.csv", "-o", "by" + count, "--together", count, "-q").must(0)
    for name in "abcd":
        assert numpy.array_equal(sensors_of(tmp_path / "by2" / name), sensors_of(tmp_path / "by4" / name))


# Friction, contact, a controller with a state and an event: everything here has a state of its own besides the motion.
MACHINE = """
buckens: 1
planar: xy
parameters: {goal: 0.6, rub: 0.1, gain: 8}
gravity: [0, -9.81, 0]
materials: {steel: {E: 210 GPa, nu: 0.3, rho: 7850, damping: {stiffness: 2e-5 s}}}
bodies:
  arm: {beam: {to: [0.5, 0, 0], elements: 6, section: {rectangle: {width: 20 mm, height: 6 mm}}, material: steel}}
  load: {rigid: {mass: 0.1 kg, inertia: [0, 0, 1e-5]}, at: {position: [0.5, 0.2, 0]}}
joints:
  hinge: {revolute: {between: [ground, arm/start]}}
  clamp: {fixed: {between: [load, {ground: [0.5, 0.2, 0]}]}}
signals:
  angle: {joint-angle: hinge}
  error: "goal - angle"
  hold: {setting: 1}
  past: "angle - 0.15"
  far: "angle - 0.16"
  drive: {pid: {input: error, proportional: gain, integral: 20, derivative: 0.4, filter: 5 ms, limits: [-6, 6], tracking-time: 50 ms}}
events:
  drop: {when: past, direction: rising, release: clamp}
  weaken: {when: far, direction: rising, set: {hold: 0.5}}
loads:
  motor: {hinge-motor: {joint: hinge, torque: "drive*hold N m"}}
  friction: {hinge-friction: {joint: hinge, static: rub, radius: 20 mm, preload: 0.1 N m, slip: 1e-5 rad}}
  bed: {contact: {between: [load, arm/end], shapes: [{sphere: 20 mm}, {sphere: 20 mm}], stiffness: 1e5, restitution: 0.5, static: 0.3}}
simulation: {duration: 0.6 s, step: 0.2 ms}
output: {every: 1 ms, sensors: {hinge: {joint-coordinate: hinge}, load: {position: load}, drive: {signal: drive}, hold: {signal: hold}, bed: {contact: bed}, torque: {spring-torque: friction}}}
"""


def test_variants_of_a_machine_are_single_runs_to_the_last_bit(buckens, tmp_path):
    (tmp_path / "machine.yaml").write_text(MACHINE)
    (tmp_path / "table.csv").write_text("name,parameters.goal,parameters.rub,parameters.gain\n"
                                        "a,0.6,0.1,8\nb,0.6,0.4,8\nc,0.9,0.1,16\nd,0.5,0.2,6\n")
    buckens("sweep", "machine.yaml", "table.csv", "-o", "out", "-q").must(0)
    last = set()
    for row in table_of(tmp_path / "out"):
        settings = [part for key in ("goal", "rub", "gain") for part in ("--set", f"parameters.{key}={row['parameters.' + key]}")]
        buckens("run", "machine.yaml", "-o", "alone", "-q", *settings).must(0)
        together, alone = (tmp_path / "out" / row["name"], tmp_path / "alone")
        assert (together / "sensors.csv").read_bytes() == (alone / "sensors.csv").read_bytes()
        columns = next(csv.reader((alone / "sensors.csv").open()))
        out = dict(zip((name.split(" [")[0] for name in columns), sensors_of(alone).T))
        # In each of them the load was let go and struck, friction acted, and the second event came.
        assert out["load.y"].min() < 0.1999 and out["bed.normal"].max() > 1
        assert numpy.abs(out["torque"]).max() > 0.1 and out["hold"][-1] == 0.5
        last.add(out["hinge.value"][-1])
    assert len(last) == 4


def test_combinations_of_ranges(buckens, models, tmp_path):
    buckens("sweep", models / "pendulum.yaml", "-o", "out", "--vary", "simulation.duration=[0.01, 0.02]",
            "--vary", "gravity.1=[-9.81 m/s^2, -1.62 m/s^2, 0]").must(0)
    rows = table_of(tmp_path / "out")
    assert len(rows) == 6
    assert rows[1]["gravity.1"] == "-1.62 m/s^2" and float(rows[5]["end_time [s]"]) == 0.02
    assert (tmp_path / "out" / "006" / "results.h5").exists()


def test_failed_variants_do_not_stop_the_rest(buckens, models, tmp_path):
    result = buckens("sweep", models / "beam.yaml", "-o", "out",
                     "--vary", "bodies.beam.beam.elements=[2, -1, 4]").must(4, "elements")
    rows = table_of(tmp_path / "out")
    assert [row["status"] for row in rows] == ["done", "failed", "done"]
    assert "-1" in rows[1]["message"]
    assert "2 done" in result.out and "1 failed" in result.out


def test_continues_after_an_interruption(buckens, models, tmp_path):
    call = ("sweep", models / "pendulum.yaml", "-o", "out", "--json")
    buckens(*call, "--vary", "simulation.duration=[0.01, 0.02]").must(0)
    # One run is incomplete, one has a different value now.
    summary = tmp_path / "out" / "001" / "summary.json"
    summary.write_text(json.dumps({**json.loads(summary.read_text()), "status": "interrupted"}))
    result = buckens(*call, "--vary", "simulation.duration=[0.01, 0.02, 0.03]").must(0)
    assert [v["status"] for v in result.json["variants"]] == ["done", "kept", "done"]
    result = buckens(*call, "--vary", "simulation.duration=[0.01, 0.04, 0.03]").must(0)
    assert [v["status"] for v in result.json["variants"]] == ["kept", "done", "kept"]


def test_runs_of_another_version_are_run_again(buckens, models, tmp_path):
    h5py = pytest.importorskip("h5py")
    call = ("sweep", models / "pendulum.yaml", "-o", "out", "--json", "--vary", "simulation.duration=[0.01, 0.02]")
    buckens(*call).must(0)
    with h5py.File(tmp_path / "out" / "001" / "results.h5", "r+") as file:
        file.attrs["version"] = "0.0.9"
    assert [variant["status"] for variant in buckens(*call).must(0).json["variants"]] == ["done", "kept"]


DECK = """*INCLUDE, INPUT=nodes.inp
*ELEMENT, TYPE=C3D8, ELSET=ALL
1, 1, 2, 3, 4, 5, 6, 7, 8
*MATERIAL, NAME=STEEL
*ELASTIC
2.1e11, 0.3
*DENSITY
7850.
*SOLID SECTION, ELSET=ALL, MATERIAL=STEEL
"""
NODES = "*NODE\n" + "".join(f"{k + 1}, {x}, {y}, {z}\n" for k, (x, y, z) in enumerate(
    (x, y, z) for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))))
CUBE = """
buckens: 1
bodies: {cube: {mesh: {file: cube.inp, length-unit: m}}}
loads: {push: {force: {on: cube/n7, value: [{table: push.csv}, 0, 0]}}}
simulation: {duration: 2 ms, step: 1 ms}
"""


def test_changed_files_are_noticed(buckens, tmp_path):
    """Decks, their included files, and tables belong to a variant like its values."""
    (tmp_path / "parts").mkdir()
    files = {"cube.yaml": CUBE, "cube.inp": DECK, "nodes.inp": NODES, "push.csv": "0, 0\n1, 1\n"}
    for name, text in files.items():
        (tmp_path / "parts" / name).write_text(text)
    call = ("sweep", "parts/cube.yaml", "-o", "out", "--json", "--vary", "simulation.duration=[2 ms, 3 ms]")

    def status():
        return [variant["status"] for variant in buckens(*call).must(0).json["variants"]]

    assert status() == ["done", "done"]
    assert status() == ["kept", "kept"]
    model = (tmp_path / "out" / "001" / "model.yaml").read_text()
    assert all(f"#   {name} " in model for name in ("cube.inp", "nodes.inp", "push.csv"))
    for name in ("cube.inp", "nodes.inp", "push.csv"):
        (tmp_path / "parts" / name).write_text(files[name].replace("1, 1\n", "1, 2\n").replace("7850.", "7800.")
                                               .replace("7, 1, 1, 1", "7, 1, 1, 1.1"))
        assert status() == ["done", "done"], name
        assert status() == ["kept", "kept"], name


def test_bases_and_modes_chosen_by_trial(buckens, models, tmp_path):
    """A variant is reduced as a separate run would be."""
    model = models / "beam.yaml"
    (tmp_path / "beam.yaml").write_text(model.read_text())
    basis = "bodies.beam.reduction={craig-bampton: 3, file: beam.h5}"
    buckens("run", "beam.yaml", "-o", "alone", "-q", "--set", basis).must(0)
    made = (tmp_path / "beam.h5").read_bytes()
    # The second variant has another mesh; the file that belongs to the first is left alone.
    buckens("sweep", "beam.yaml", "-o", "out", "--set", basis,
            "--vary", "bodies.beam.beam.elements=[8, 16]").must(0)
    assert (tmp_path / "beam.h5").read_bytes() == made
    assert numpy.array_equal(sensors_of(tmp_path / "out" / "001"), sensors_of(tmp_path / "alone"))
    auto = "bodies.beam.reduction={auto: 5 %}"
    buckens("run", "beam.yaml", "-o", "alone", "-q", "--set", auto).must(0)
    buckens("sweep", "beam.yaml", "-o", "chosen", "--set", auto, "--vary", "simulation.rho-inf=[0.9]").must(0)
    assert numpy.array_equal(sensors_of(tmp_path / "chosen" / "001"), sensors_of(tmp_path / "alone"))
    summary = json.loads((tmp_path / "chosen" / "001" / "summary.json").read_text())
    assert any("in a trial run" in text for text in summary["warnings"])


def test_says_what_is_wrong(buckens, models, tmp_path):
    model = models / "pendulum.yaml"
    buckens("sweep", model).must(2, "--vary")
    buckens("sweep", model, "--vary", "a").must(2, "PATH=[VALUE")
    buckens("sweep", model, "none.csv").must(5, "none.csv")
    buckens("sweep", "none.yaml", "--vary", "a=[1]").must(5, "none.yaml")
    (tmp_path / "table.csv").write_text("simulation.duration\n1,2\n")
    buckens("sweep", model, "table.csv").must(2, "table.csv:2", "2 cells")
    # A path unknown to the format is named in every variant's message.
    buckens("sweep", model, "-o", "out", "--vary", "simulation.durration=[1]").must(4, "duration")


def test_a_variant_too_large_for_the_memory_says_so(tmp_path):
    """And not std::bad_alloc; the others are run."""
    (tmp_path / "block.yaml").write_text("""buckens: 1
parameters: {n: 2}
materials: {steel: {E: 210 GPa, nu: 0.3, rho: 7850}}
bodies: {block: {mesh: {box: {size: [1, 1, 1], divisions: [n, n, n]}, material: steel}}}
simulation: {duration: 1 ms, step: 0.5 ms}
""")
    limited = ["sh", "-c", "ulimit -v 1000000; exec \"$@\"", "sh", PROGRAM]
    result = subprocess.run([*limited, "sweep", "block.yaml", "--vary", "parameters.n=[2, 90, 3]", "-o", "out", "--json"], cwd=tmp_path,
                            capture_output=True, text=True, timeout=120, check=False, stdin=subprocess.DEVNULL)
    assert result.returncode == 4, result.stderr
    variants = json.loads(result.stdout)["variants"]
    assert [variant["status"] for variant in variants] == ["done", "failed", "done"]
    assert "not enough memory" in variants[1]["message"] and "run fewer together" in variants[1]["message"]
