# SPDX-License-Identifier: Apache-2.0
"""`buckens view`: where it finds its page and what it writes; viewer/ tests the page itself."""

import os
import pathlib
import shutil
import subprocess

import pytest

from conftest import PROGRAM, Result


@pytest.fixture
def installed(tmp_path):
    """The program in a place of its own, so that the test says whether there is a viewer."""
    program = tmp_path / "prefix" / "bin" / "buckens"
    program.parent.mkdir(parents=True)
    try:
        os.link(pathlib.Path(PROGRAM).resolve(), program)
    except OSError:
        shutil.copy(PROGRAM, program)
    return program


def add_viewer(program):
    """A page with nothing but the place for the data."""
    template = program.parents[1] / "share" / "buckens" / "viewer.html"
    template.parent.mkdir(parents=True)
    template.write_text("<script>const run = /*BUCKENS_DATA*/null;</script>")


def view(program, *arguments, **options):
    return Result(subprocess.run([str(program), "view", *map(str, arguments)], text=True,
                                 capture_output=True, timeout=300, **options))


def test_view_without_the_viewer(buckens, models, installed, tmp_path):
    buckens("run", models / "pendulum.yaml", "-o", "out").must(0)
    view(installed, tmp_path / "out").must(5, "prefix/share/buckens/viewer.html", "buckens_viewer")


def test_view_writes_a_page(buckens, models, installed, tmp_path):
    buckens("run", models / "beam.yaml", "-o", "out").must(0)
    add_viewer(installed)
    result = view(installed, "out", cwd=tmp_path).must(0)
    assert "out/view.html" in result.out and "51" in result.out
    page = (tmp_path / "out" / "view.html").read_text()
    assert "Test beam" in page and "BUCKENS_DATA" not in page
    report = view(installed, "out", "-o", "other.html", "--frames", "10", "--json",
                  cwd=tmp_path).must(0).json
    assert report == {"page": "other.html", "records": 51, "frames": 10}
    assert (tmp_path / "other.html").stat().st_size > 0
    # The page is no obstacle for the next run into the same directory.
    buckens("run", models / "beam.yaml", "-o", "out").must(0)


@pytest.mark.parametrize("name", ["empty", "missing"])
def test_view_of_nothing(installed, tmp_path, name):
    add_viewer(installed)
    (tmp_path / "empty").mkdir()
    error = view(installed, name, "--json", cwd=tmp_path).must(5, name).json["error"]
    assert error["kind"] == "io"


def test_view_into_a_place_that_cannot_be_written(buckens, models, installed, tmp_path):
    add_viewer(installed)
    buckens("run", models / "pendulum.yaml", "-o", "out").must(0)
    view(installed, "out", "-o", "nowhere/page.html", cwd=tmp_path).must(5, "nowhere/page.html")
