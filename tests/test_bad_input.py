# SPDX-License-Identifier: Apache-2.0
"""Bad input gets a clear message and the right exit code: 2 bad input, 3 model that cannot be
solved, 4 numerical failure, 5 files. One test per kind of mistake."""

import json
import resource
import stat

import h5py
import pytest

from conftest import heed_permissions

BEAM = "beam: {to: [1 m, 0, 0], elements: 4, section: {circle: {diameter: 6 mm}}, material: steel}"


@pytest.fixture
def model(models):
    """The text of the pendulum, with something replaced."""

    def make(old="", new=""):
        text = (models / "pendulum.yaml").read_text()
        assert old in text
        return text.replace(old, new, 1) if old else text

    return make


@pytest.fixture
def run(buckens, tmp_path):
    """Writes a model text and runs it."""

    def call(text, *arguments, **options):
        (tmp_path / "model.yaml").write_text(text)
        return buckens("run", "model.yaml", "-o", tmp_path / "out", *arguments, **options)

    return call


def place(text, word):
    """ "model.yaml:line:" of the first line with this word."""
    lines = text.split("\n")
    return f"model.yaml:{next(i for i, line in enumerate(lines, 1) if word in line)}:"


def test_missing_file(buckens):
    buckens("run", "nowhere.yaml").must(5, "nowhere.yaml", "no such file")
    buckens("check", "nowhere.yaml").must(5, "nowhere.yaml", "no such file")


def test_directory_in_place_of_a_file(buckens, tmp_path):
    buckens("run", tmp_path).must(5, "directory")


def test_unreadable_directory(buckens, tmp_path, model):
    closed = tmp_path / "closed"
    closed.mkdir()
    (closed / "model.yaml").write_text(model())
    closed.chmod(0)
    try:
        buckens("run", closed / "model.yaml", preexec_fn=heed_permissions).must(
            5, "closed/model.yaml", "ermission denied")
    finally:
        closed.chmod(stat.S_IRWXU)


def test_unreadable_file(buckens, tmp_path, model):
    (tmp_path / "model.yaml").write_text(model())
    (tmp_path / "model.yaml").chmod(0)
    buckens("run", "model.yaml", preexec_fn=heed_permissions).must(
        5, "model.yaml", "ermission denied")


@pytest.mark.parametrize("text", ["bodies: [1, 2\n", "a: b: c\n", "bodies:\n\trod: 1\n", "{", "\0"])
def test_yaml_syntax(run, text):
    run(text).must(2, "model.yaml:")


def test_empty_file(run):
    run("").must(2, "model.yaml")


def test_unknown_key(run, model):
    text = model("inertia", "inertai")
    run(text).must(2, place(text, "inertai"), "inertai", "inertia")


def test_wrong_unit(run, model):
    text = model("mass: 2 kg", "mass: 2 mm")
    run(text).must(2, place(text, "2 mm"), "mm", "mass")


def test_negative_mass(run, model):
    text = model("mass: 2 kg", "mass: -2 kg")
    run(text).must(2, place(text, "-2 kg"), "mass", "-2")


def test_zero_length_beam(run):
    text = ("buckens: 1\nmaterials: {steel: {E: 200 GPa, nu: 0.3, rho: 7870}}\n"
            "bodies:\n  rod:\n    " + BEAM.replace("1 m", "0")
            + "\nsimulation: {duration: 1 s, step: 1 ms}\n")
    run(text).must(2, "model.yaml:5:", "length")


def test_unknown_body(run, model):
    text = model("rod/pin", "rud/pin")
    run(text).must(2, place(text, "rud/pin"), "rud", "rod")


def test_unknown_marker(run, model):
    text = model("rod/pin", "rod/pni")
    run(text).must(2, place(text, "rod/pni"), "pni", "pin")


def test_unknown_material(run):
    text = ("buckens: 1\nmaterials: {stele: {E: 200 GPa, nu: 0.3, rho: 7870}}\n"
            "bodies:\n  rod:\n    " + BEAM + "\nsimulation: {duration: 1 s, step: 1 ms}\n")
    run(text).must(2, "model.yaml:5:", "material", "steel", "stele")


def test_joint_that_cannot_be_assembled(buckens, models):
    # The gap is 1 m; one of the three joints stays open.
    result = buckens("run", models / "gap.yaml", "-o", "out").must(3, "_pin")
    assert any(word in result.err for word in ("closed", "assembled")), result.err
    buckens("check", models / "gap.yaml").must(3, "_pin")


def test_free_body_without_inertia(run):
    text = ("buckens: 1\nbodies:\n  ghost: {rigid: {mass: 0 kg}}\n"
            "simulation: {duration: 1 s, step: 1 ms}\n")
    run(text).must(3, place(text, "ghost"), "ghost", "no mass")


def test_nan_in_an_expression(run, model):
    text = model("L: 1 m", "L: sqrt(-1)")
    run(text).must(2, place(text, "sqrt"), "sqrt(-1)")


def test_divide_by_zero_in_an_expression(run, model):
    text = model("L: 1 m", "L: 1/0")
    run(text).must(2, place(text, "1/0"), "1/0")


def test_nan_that_shows_only_on_the_way(buckens, models, tmp_path):
    text = (models / "fails_midway.yaml").read_text()
    line = next(i for i, line in enumerate(text.split("\n"), 1) if "sqrt" in line)
    result = buckens("run", models / "fails_midway.yaml", "-o", "out").must(
        4, f"fails_midway.yaml:{line}:", "sqrt(0.05 - t)", "kept in out")
    assert "t = 0.05" in result.err
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["status"] == "interrupted" and not summary["finished"]
    assert "sqrt(0.05 - t)" in summary["interrupted"]
    # One record per step of 1 ms, from t = 0 to the last successful step.
    rows = (tmp_path / "out" / "sensors.csv").read_text().splitlines()[1:]
    assert 49 <= len(rows) <= 51
    with h5py.File(tmp_path / "out" / "results.h5", "r") as file:
        assert len(file["time"]) == len(rows)
    assert "sqrt(0.05 - t)" in (tmp_path / "out" / "log.txt").read_text()


def test_divide_by_zero_on_the_way(buckens, models):
    buckens("run", models / "fails_midway.yaml", "-o", "out",
            "--set", 'loads.motor.torque.value=[0, 0, "1/(t - 0.05)"]',
            "--set", "simulation.step=50 ms").must(4, "1/(t - 0.05)", "t = 0.05")


def test_output_below_a_file(run, model, buckens, tmp_path):
    (tmp_path / "file").write_text("")
    run(model()).must(0)
    buckens("run", "model.yaml", "-o", "file").must(5, "file")
    buckens("run", "model.yaml", "-o", "file/out").must(5, "file/out")


def test_output_directory_not_writable(run, model, buckens, tmp_path):
    run(model()).must(0)
    closed = tmp_path / "closed"
    closed.mkdir()
    closed.chmod(stat.S_IRUSR | stat.S_IXUSR)
    for out in ("closed", "closed/out"):
        buckens("run", "model.yaml", "-o", out, preexec_fn=heed_permissions).must(
            5, out, "ermission denied")
    buckens("run", "model.yaml", "-o", "/proc/out").must(5, "/proc/out")
    assert list(closed.iterdir()) == []


def test_output_directory_of_others_is_left_alone(run, model, tmp_path):
    out = tmp_path / "out"
    out.mkdir()
    (out / "thesis.txt").write_text("precious")
    run(model()).must(5, "out")
    assert [path.name for path in out.iterdir()] == ["thesis.txt"]


def test_disk_full(buckens, models, tmp_path):
    """A limit on the file size simulates a full disk: the same system call fails."""

    def limit():
        resource.setrlimit(resource.RLIMIT_FSIZE, (200_000, 200_000))

    result = buckens("run", models / "endless.yaml", "-o", "out", preexec_fn=limit).must(
        5, "out/", "kept in out")
    assert "File too large" in result.err or "limit" in result.err or "full" in result.err
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["status"] == "interrupted"
    with h5py.File(tmp_path / "out" / "results.h5", "r", swmr=True) as file:
        assert len(file["time"]) > 10


@pytest.mark.parametrize("step", ["0 s", "-1 ms", "2 s", "0"])
def test_step_size(run, model, step):
    text = model("step: 1 ms", f"step: {step}")
    run(text).must(2, place(text, "simulation"), "step")


@pytest.mark.parametrize("text", [
    "  rod:\n    rigid: {mass: 1 kg}\njoints:",
    "  hinge: {fixed: {between: [ground, rod]}}\nsimulation:",
])
def test_duplicate_names(run, model, text):
    following = text.split("\n")[-1]
    doubled = model(following, text)
    run(doubled).must(2, "model.yaml:", "twice", text.split(":")[0].strip())


def test_no_simulation(run, model):
    run(model("simulation: {duration: 0.1 s, step: 1 ms}\n")).must(2, "simulation")


def test_bad_models_leave_no_directory(run, model, tmp_path):
    run(model("mass: 2 kg", "mass: -2 kg")).must(2)
    assert not (tmp_path / "out").exists()
