# SPDX-License-Identifier: Apache-2.0
"""Where models, meshes and results lie, and in which country the user lives, changes nothing: paths
with blanks and letters of any script, symbolic links, a decimal comma, places that cannot be
written."""

import ctypes
import os
import pathlib
import shutil
import stat
import subprocess
import warnings

import h5py
import pytest

from conftest import PROGRAM, heed_permissions

PARTS = pathlib.Path(__file__).parent / "parts"

def same_files(one, other, name="sensors.csv"):
    return (pathlib.Path(one) / name).read_bytes() == (pathlib.Path(other) / name).read_bytes()


@pytest.fixture
def plain(buckens, models, tmp_path):
    """The run of the beam in a plain place."""
    buckens("run", "-q", models / "beam.yaml", "-o", "plain").must(0)
    return tmp_path / "plain"


STRANGE = ["two words", "Größe μ 速度", "it's \"quoted\" & $HOME", "-o", "a,b;c=d#e%f[g]{h}",
           "new\nline", "e\u0301", "x" * 200]


@pytest.mark.parametrize("name", STRANGE)
def test_names_of_any_letters(buckens, models, plain, tmp_path, name):
    place = tmp_path / name
    place.mkdir()
    shutil.copy(models / "beam.yaml", place / f"{name}.yaml")
    model, out = pathlib.Path(".") / name / f"{name}.yaml", pathlib.Path(".") / name / "out put"
    # A name that begins with a hyphen must be preceded by its directory, as with any program.
    model, out = f"./{model}", f"./{out}"
    buckens("check", model).must(0)
    buckens("run", "-q", model, "-o", out).must(0)
    assert same_files(plain, place / "out put")
    buckens("export", out, "--csv", "--vtk", "--glb", "--out", f"./{name}/files").must(0)
    buckens("plot", out, "tip.y", "-o", f"./{name}/tip.svg").must(0)
    buckens("compare", "plain", out).must(0)
    assert {"tip.svg", "files", "out put"} <= {path.name for path in place.iterdir()}


def test_a_name_that_is_no_text(buckens, models, plain, tmp_path):
    """File names may contain any bytes; messages show the printable ones."""
    place = os.fsencode(tmp_path) + b"/caf\xe9"
    os.mkdir(place)
    shutil.copy(models / "beam.yaml", os.fsdecode(place))
    run = subprocess.run([PROGRAM, "run", "-q",
                          place + b"/beam.yaml", "-o", place + b"/out"], capture_output=True,
                         check=False, timeout=300)
    assert run.returncode == 0, run.stderr
    assert same_files(plain, os.fsdecode(place + b"/out"))


def test_symbolic_links(buckens, models, plain, tmp_path):
    """A model, a directory of results and parts of their paths may be links."""
    real = tmp_path / "real"
    (real / "results").mkdir(parents=True)
    shutil.copy(models / "beam.yaml", real)
    (tmp_path / "link.yaml").symlink_to(real / "beam.yaml")
    (tmp_path / "way").symlink_to(real)
    (tmp_path / "out").symlink_to(real / "results")
    for model, out in [("link.yaml", "a"), ("way/beam.yaml", "way/b"), ("link.yaml", "out")]:
        buckens("run", "-q", model, "-o", out).must(0)
        assert same_files(plain, tmp_path / out)
    assert (real / "results" / "results.h5").is_file() and (tmp_path / "out").is_symlink()
    buckens("run", "-q", "link.yaml", "-o", "out").must(0)  # over the earlier run
    (tmp_path / "nowhere").symlink_to(tmp_path / "missing")
    buckens("run", "nowhere", "-o", "c").must(5, "nowhere")


PLANTED = ["results.h5", "results.h5.part", "sensors.csv", "summary.json.part", "model.yaml.part",
           "model.yaml", "modes.json"]


@pytest.mark.parametrize("name", PLANTED)
def test_links_planted_among_the_results_are_not_followed(buckens, models, plain, tmp_path, name):
    """Somebody who may write into a directory of results cannot have other files overwritten."""
    precious = tmp_path / "precious"
    precious.write_text("precious")
    (plain / name).unlink(missing_ok=True)
    (plain / name).symlink_to(precious)
    result = buckens("run", "-q", models / "beam.yaml", "-o", "plain")
    assert precious.read_text() == "precious"
    result.must(0)
    assert not (plain / name).is_symlink()
    with h5py.File(plain / "results.h5", swmr=True) as file:
        assert len(file["time"]) == 51


def test_a_link_in_place_of_the_log_is_refused(buckens, models, plain, tmp_path):
    precious = tmp_path / "precious"
    precious.write_text("precious")
    (plain / "log.txt").unlink()
    (plain / "log.txt").symlink_to(precious)
    buckens("run", "-q", models / "beam.yaml", "-o", "plain").must(5, "log.txt", "symbolic link")
    assert precious.read_text() == "precious"


def test_a_link_in_place_of_a_basis_is_replaced(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(
        "buckens: 1\nmaterials: {steel: {E: 210 GPa, nu: 0.3, rho: 7850 kg/m^3}}\n"
        "sections: {rod: {circle: {diameter: 6 mm}}}\n"
        "bodies: {rod: {beam: {to: [1 m, 0, 0], elements: 4, section: rod, material: steel},\n"
        "               reduction: {free-free: {modes: 2}, file: kept.basis}}}\n"
        "joints: {pin: {spherical: {between: [ground, rod/start]}}}\n"
        "simulation: {duration: 2 ms, step: 1 ms}\n")
    (tmp_path / "precious").write_text("precious")
    (tmp_path / "kept.basis.part").symlink_to(tmp_path / "precious")
    buckens("run", "-q", "model.yaml", "-o", "out").must(0)
    assert (tmp_path / "precious").read_text() == "precious"
    assert (tmp_path / "kept.basis").is_file() and not (tmp_path / "kept.basis").is_symlink()
    # A stored basis that another program has changed.
    with h5py.File(tmp_path / "kept.basis", "r+", libver="latest") as file:
        shape = file["Z"].shape
        del file["Z"]
        file["Z"] = [1.0, 2.0]
    buckens("run", "-q", "model.yaml", "-o", "out").must(5, "kept.basis", "not complete")
    with h5py.File(tmp_path / "kept.basis", "r+", libver="latest") as file:
        del file["Z"]
        file["Z"] = h5py.ExternalLink("other.h5", "/Z")
    buckens("run", "-q", "model.yaml", "-o", "out").must(5, "kept.basis", "/Z", "link")
    with h5py.File(tmp_path / "kept.basis", "r+", libver="latest") as file:
        del file["Z"]
        rows = shape[1] - 6
        file.create_dataset("Z", (shape[0], rows), "f8")
        counts = file.attrs["counts"]
        counts[2] = rows
        file.attrs["counts"] = counts
    buckens("run", "-q", "model.yaml", "-o", "out").must(5, "kept.basis", f"{rows} rows")


@pytest.fixture(scope="module")
def comma(tmp_path_factory):
    """The environment of a user whose numbers have a decimal comma."""
    place = tmp_path_factory.mktemp("locales")
    (place / "source").write_text('comment_char %\nescape_char /\nLC_NUMERIC\ndecimal_point ","\n'
                                  'thousands_sep "."\ngrouping 3;3\nEND LC_NUMERIC\n')
    # Warns of omitted parts of a locale, also by its exit code.
    subprocess.run(["localedef", "-c", "--quiet", "-i", place / "source", "-f", "ANSI_X3.4-1968",
                    place / "xx_XX"], check=False, capture_output=True)
    environment = {**os.environ, "LOCPATH": str(place), "LC_NUMERIC": "xx_XX"}
    environment.pop("LC_ALL", None)
    shown = subprocess.run(["/usr/bin/printf", "%.1f", "0"], env=environment, check=True,
                           capture_output=True, text=True).stdout
    assert shown == "0,0"
    return environment


def test_a_decimal_comma_changes_nothing(buckens, models, plain, comma, tmp_path):
    buckens("run", "-q", models / "beam.yaml", "-o", "comma", env=comma).must(0)
    assert same_files(plain, tmp_path / "comma")
    assert buckens("compare", "plain", "comma", env=comma).must(0).out == \
        buckens("compare", "plain", "comma").must(0).out
    assert buckens("check", models / "beam.yaml", env=comma).must(0).out == \
        buckens("check", models / "beam.yaml").must(0).out
    for locale, out in [(None, "a"), (comma, "b")]:
        buckens("export", "plain", "--csv", "--vtk", "--out", out, env=locale).must(0)
    names = sorted(path.name for path in (tmp_path / "a").iterdir())
    assert names and names == sorted(path.name for path in (tmp_path / "b").iterdir())
    for name in names:
        assert same_files(tmp_path / "a", tmp_path / "b", name), name
    text = (models / "beam.yaml").read_text().replace("500 mm", "0,5 m")
    (tmp_path / "comma.yaml").write_text(text)
    buckens("check", "comma.yaml", env=comma).must(2, "comma.yaml")


@pytest.mark.parametrize("file", ["crank_web.unv", "crank_web_41.msh", "crank_web_22_binary.msh"])
def test_a_decimal_comma_does_not_change_meshes(buckens, comma, file):
    told = [buckens("mesh-info", PARTS / file, "--json", env=locale) for locale in (None, comma)]
    assert told[0].code == told[1].code and told[0].out == told[1].out
    assert told[0].code == 0, told[0].err


MS_RDONLY, MS_REMOUNT, MS_BIND, CLONE_NEWNS, MS_REC, MS_PRIVATE = 1, 32, 4096, 0x20000, 16384, 1 << 18


def test_a_place_that_cannot_be_written(buckens, models, plain, tmp_path):
    """Nothing can be written, everything can be read: a medium that is mounted read-only where the
    test may mount, a directory without permission to write elsewhere."""
    place = tmp_path / "medium"
    shutil.copytree(plain, place / "run")
    shutil.copy(models / "beam.yaml", place)
    libc = ctypes.CDLL(None, use_errno=True)

    def mount():
        if (libc.unshare(CLONE_NEWNS) != 0
                or libc.mount(None, b"/", None, MS_REC | MS_PRIVATE, None) != 0
                or libc.mount(bytes(place), bytes(place), None, MS_BIND, None) != 0
                or libc.mount(None, bytes(place), None, MS_REMOUNT | MS_BIND | MS_RDONLY, None)):
            raise OSError(ctypes.get_errno(), "mount")

    ways = [heed_permissions]
    if os.geteuid() == 0:
        ways.append(mount)
    before = sorted(path.relative_to(place) for path in place.rglob("*"))
    for path in (place, place / "run"):
        path.chmod(stat.S_IRUSR | stat.S_IXUSR)
    try:
        for way in ways:
            try:
                buckens("version", preexec_fn=way)
            except subprocess.SubprocessError:
                assert way is mount
                warnings.warn("no right to mount here: only permissions were tried", stacklevel=1)
                continue
            for out in ("medium/run", "medium/new"):
                buckens("run", "-q", "medium/beam.yaml", "-o", out, preexec_fn=way).must(5, out)
            buckens("export", "medium/run", "--csv", preexec_fn=way).must(5, "medium/run")
            buckens("plot", "medium/run", "tip.y", "-o", "medium/x.svg", preexec_fn=way).must(
                5, "medium/x.svg")
            # Reading needs no right to write.
            buckens("compare", "plain", "medium/run", preexec_fn=way).must(0)
            buckens("export", "medium/run", "--csv", "--out", f"files{len(before)}",
                    preexec_fn=way).must(0)
            buckens("run", "-q", "medium/beam.yaml", "-o", "out", preexec_fn=way).must(0)
            assert same_files(plain, tmp_path / "out")
    finally:
        for path in (place, place / "run"):
            path.chmod(stat.S_IRWXU)
    assert sorted(path.relative_to(place) for path in place.rglob("*")) == before
