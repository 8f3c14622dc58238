# SPDX-License-Identifier: Apache-2.0
"""Verbs that need no simulation, help, and the command line itself."""

import csv
import json
import os
import re
import subprocess

import h5py
import pytest

from conftest import PROGRAM, SOURCE

VERBS = ["run", "sweep", "static", "check", "modes", "compare", "mesh-info", "convert", "view", "export",
         "plot", "schema", "reference", "version"]


def test_version_is_that_of_the_file(buckens):
    version = (SOURCE / "VERSION").read_text().strip()
    first, second = buckens("version").must(0).out.splitlines()
    assert first == f"buckens {version}"
    told = buckens("version", "--json").must(0).json
    assert (told["program"], told["version"]) == ("buckens", version)
    name = {"GPL-3.0-or-later": "GNU GPL, version 3", "Apache-2.0": "Apache License 2.0"}
    assert name[told["licence"]] in second
    assert set(told) == {"program", "version", "licence"}
    assert version in buckens("--version").must(0).out


def test_schema_is_json_schema(buckens):
    schema = buckens("schema").must(0).json
    assert schema["$schema"].startswith("https://json-schema.org/")
    assert {"bodies", "joints", "simulation"} <= set(schema["properties"])
    assert buckens("schema", "--json").must(0).json == schema


def test_reference_is_markdown(buckens):
    page = buckens("reference").must(0).out
    assert page.startswith("#") and "revolute" in page
    assert buckens("reference", "--json").must(0).json["reference"] == page


@pytest.mark.parametrize("verb", VERBS)
def test_every_verb_explains_itself(buckens, verb):
    page = buckens(verb, "--help").must(0).out
    assert "--json" in page
    if verb != "version":
        assert f"buckens {verb}" in page, "a worked example"


@pytest.mark.parametrize("verb", VERBS)
def test_every_option_stands_in_the_reference(buckens, verb):
    """In the list at the head of the page, or in the section of the verb."""
    page = (SOURCE / "docs" / "reference" / "command-line.md").read_text()
    section = re.search(rf"\n## [^\n]*\b{verb}\b[^\n]*\n(.*?)(?=\n## |\Z)", page, re.DOTALL)
    lines = [line for line in page.split("\n") if line.startswith(f"buckens {verb}")]
    assert section and lines, f"the page does not know {verb}"
    told = section.group(1) + "".join(lines)
    options = set(re.findall(r"(?<![\w-])--[a-z][a-z-]*", buckens(verb, "--help").must(0).out))
    # Documented once for all verbs: --json prints the same as text; -o is --out on the pages.
    assert {option for option in options - {"--help", "--json", "--out"} if option not in told} == set()


def test_help_names_verbs_and_exit_codes(buckens):
    page = buckens("--help").must(0).out
    assert set(re.findall(r"^  ([a-z][a-z-]*)  ", page, re.MULTILINE)) == set(VERBS)
    for code in ["0", "1", "2", "3", "4", "5", "130"]:
        assert re.search(rf"^  {code} ", page, re.MULTILINE), code
    assert "docs/reference/command-line.md" in page


def test_without_a_verb_the_help_is_shown(buckens):
    assert buckens().must(2).out == buckens("--help").out


@pytest.mark.parametrize("arguments, words", [
    (["rnu"], ["no verb", '"rnu"', '"run"']),
    (["run"], ["MODEL", "buckens run --help"]),
    (["run", "a.yaml", "--sett", "x=1"], ["--sett", "buckens run --help"]),
    (["check", "a.yaml", "b.yaml"], ["b.yaml"]),
    (["view"], ["OUT"]),
    (["view", "x", "--frames", "1"], ["--frames"]),
    (["compare", "a", "b", "--tolerance", "0"], ["--tolerance: 0 is not a positive number. See"]),
    (["compare", "a", "b", "--tolerance", "nan"], ["nan is not a positive number"]),
    (["modes", "a.yaml", "--tolerance", "nan"], ["nan is not a number from 1e-14 to 0.01"]),
    (["export", "a", "--glb", "--exaggerate", "inf"], ["inf is not a number from 0"]),
    (["export", "a", "--vtk", "--count", "-1"], ["-1 is not a number from 0"]),
    (["plot", "a", "b", "--from", "nan"], ["--from: nan is not a number"]),
    (["plot", "a", "b", "--size", "9000", "9000"], ["9000 is not a number from 150 to 4000"]),
    (["mesh-info", "a.step", "--size", "1 mm", "--order", "3"], ["--order", "3", "1 to 2"]),
])
def test_wrong_command_line(buckens, arguments, words):
    buckens(*arguments).must(2, "buckens: error:", *words)
    error = buckens(*arguments, "--json").must(2).json["error"]
    assert error["kind"] == "usage"
    assert error["file"] is None and error["line"] is None and error["column"] is None


def limited(limit, *arguments, threads=None):
    environment = {name: value for name, value in os.environ.items() if name != "OMP_NUM_THREADS"}
    if threads:
        environment["OMP_NUM_THREADS"] = str(threads)
    return subprocess.run(["sh", "-c", f"ulimit {limit}; exec \"$@\"", "sh", PROGRAM, *map(str, arguments)], capture_output=True, text=True,
                          timeout=60, check=False, stdin=subprocess.DEVNULL, env=environment)


@pytest.mark.parametrize("threads", [1, None])
@pytest.mark.parametrize("limit", ["-v 200000", "-d 100000"])
def test_too_little_memory_for_the_libraries_is_told(limit, threads):
    """OpenBLAS asks again and again for what it does not get before the program begins: it hung."""
    for arguments in (["version"], ["run", "nowhere.yaml", "--json"]):
        told = limited(limit, *arguments, threads=threads)
        assert told.returncode == 4
        assert told.stderr.startswith("buckens: error: not enough memory: OpenBLAS") and "ulimit -v" in told.stderr
        assert threads or os.cpu_count() == 1 or "OMP_NUM_THREADS=1" in told.stderr
    error = json.loads(told.stdout)["error"]
    assert error["kind"] == "memory" and f"buckens: error: {error['message']}\n" == told.stderr
    assert set(error) == {"kind", "message", "file", "line", "column"}


@pytest.mark.parametrize("threads", [1, None])
def test_the_memory_that_is_told_is_enough(models, tmp_path, threads):
    least = re.search(r"at least (\d+) kB", limited("-v 200000", "version", threads=threads).stderr)[1]
    told = limited(f"-v {least}", "run", models / "pendulum.yaml", "-o", tmp_path / "out", "-q", threads=threads)
    assert told.returncode == 0, told.stderr


def test_full_disk_behind_the_standard_output(buckens):
    with open("/dev/full", "w") as full:
        buckens("schema", stdout=full).must(5, "standard output", "No space left")


def test_closed_pipe_is_an_error_not_a_crash(buckens):
    reader, writer = os.pipe()
    os.close(reader)
    try:
        buckens("schema", stdout=writer).must(5, "standard output", "Broken pipe")
    finally:
        os.close(writer)


@pytest.mark.parametrize("stream", ["full", "closed"])
def test_messages_that_nobody_can_read_do_not_end_the_program(models, tmp_path, stream):
    """A run under nohup continues when the disk of its messages is full; without a standard error stream
    no file takes its number and gets the messages."""
    def call(*arguments):
        with open("/dev/full", "w") as full:
            options = {"stderr": full} if stream == "full" else {"preexec_fn": lambda: os.close(2)}
            return subprocess.run([PROGRAM, *map(str, arguments)], cwd=tmp_path, timeout=60,
                                  stdout=subprocess.PIPE, stdin=subprocess.DEVNULL, **options).returncode
    assert call("check", "nowhere.yaml") == 5
    assert call("run", models / "pendulum.yaml", "-o", "out") == 0
    assert json.loads((tmp_path / "out" / "summary.json").read_text())["finished"]
    rows = list(csv.reader((tmp_path / "out" / "sensors.csv").read_text().splitlines()))
    assert len(rows) > 2 and all(len(row) == len(rows[0]) for row in rows)
    with h5py.File(tmp_path / "out" / "results.h5", "r") as file:
        assert len(file["time"]) == len(rows) - 1


def test_help_into_a_full_disk(buckens):
    for arguments in (["--help"], ["run", "--help"], ["--version"]):
        with open("/dev/full", "w") as full:
            buckens(*arguments, stdout=full).must(5, "standard output", "No space left")


def test_check_tells_what_the_model_is(buckens, models):
    page = buckens("check", models / "pendulum.yaml").must(0).out
    for word in ["Test pendulum", "rod", "1 joint", "degrees of freedom"]:
        assert word in page
    report = buckens("check", models / "pendulum.yaml", "--json").must(0).json
    rod = report["bodies"]["rod"]
    assert rod["mass"] == 2
    assert rod["com"] == [0.5, 0, 0]
    assert not rod["flexible"]
    assert {"pin", "tip"} <= set(rod["markers"])
    assert report["constraint_rows"] == 2 and report["redundant_rows"] == 0
    assert report["degrees_of_freedom"] == 1
    assert report["step"] == 1e-3


def test_check_of_a_beam(buckens, models):
    report = buckens("check", models / "beam.yaml", "--json").must(0).json
    beam = report["bodies"]["beam"]
    # ρ A L; exact up to rounding.
    assert beam["mass"] == pytest.approx(7870 * 0.02 * 0.004 * 0.5, rel=1e-12)
    assert beam["elements"] == 8 and beam["nodes"] == 9 and beam["dof"] == 27
    assert beam["frame_coordinates"] == 3
    assert beam["com"] == pytest.approx([0.25, 0, 0], abs=1e-15)
    # First free-free bending frequency of an Euler-Bernoulli beam, βL = 4.73004; eight elements are
    # good to 1e-4. Bending in the plane is about the axis in which the section is 20 mm wide or
    # 4 mm high, whichever `up` makes it.
    bending = [4.730040744862704 ** 2 / (2 * 3.141592653589793 * 0.5 ** 2)
               * (200e9 / 7870) ** 0.5 * height / 12 ** 0.5 for height in (0.02, 0.004)]
    assert any(beam["frequencies"][0] == pytest.approx(f, rel=1e-4) for f in bending)
    page = buckens("check", models / "beam.yaml").must(0).out
    assert "Hz" in page and "27" in page


def test_check_writes_nothing(buckens, models, tmp_path):
    buckens("check", models / "beam.yaml").must(0)
    assert list(tmp_path.iterdir()) == []


def test_check_names_redundant_joints(buckens):
    model = SOURCE / "examples" / "door" / "door.yaml"
    report = buckens("check", model, "--json").must(0).json
    assert report["constraint_rows"] == 10 and report["redundant_rows"] == 5
    assert any("hinge" in text for text in report["redundant"])
    assert report["degrees_of_freedom"] == 1


def test_set_replaces_values(buckens, models):
    report = buckens("check", models / "pendulum.yaml", "--json",
                     "--set", "bodies.rod.rigid.mass=3 kg",
                     "--set", "parameters.L=4 m").must(0).json
    assert report["bodies"]["rod"]["mass"] == 3
    assert report["bodies"]["rod"]["com"] == [2, 0, 0]


@pytest.mark.parametrize("assignment, words", [
    ("bodies.rod.rigid.mas=3", ["mas", "mass"]),
    ("bodies.rud.rigid.mass=3", ["rud", "rod"]),
    ("parameters.M=3", ["M"]),
    ("simulation.step", ["simulation.step"]),
    ("simulation.step=1 kg", ["step", "kg"]),
])
def test_set_refuses_what_does_not_exist(buckens, models, assignment, words):
    buckens("check", models / "pendulum.yaml", "--set", assignment).must(2, *words)


def test_errors_as_json_name_the_place(buckens, tmp_path):
    model = tmp_path / "bad.yaml"
    model.write_text("buckens: 1\nbodies:\n  a: {rigid: {mass: -1 kg}}\n")
    error = buckens("check", model, "--json").must(2).json["error"]
    assert set(error) == {"kind", "message", "file", "line", "column"}
    assert error["kind"] == "input"
    assert error["file"] == str(model) and error["line"] == 3 and error["column"] > 0
    assert f"{model}:3:{error['column']}" in error["message"]
