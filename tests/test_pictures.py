# SPDX-License-Identifier: Apache-2.0
"""tests/tools/make_pictures.py lists every picture on the pages, and its models exist."""

import os
import pathlib
import re
import sys

SOURCE = pathlib.Path(os.environ.get("BUCKENS_SOURCE_DIR", pathlib.Path(__file__).parents[1]))
sys.path.insert(0, str(SOURCE / "tests" / "tools"))
from make_pictures import DRAWINGS, PICTURES  # noqa: E402


def made():
    """Files that the script writes, from the root of the project."""
    return {f"docs/pictures/{picture.name}.png" for picture in PICTURES} | {
        name for drawing in DRAWINGS for name in drawing.names}


def shown():
    """Pictures on pages, except the figures of the theory, whose scripts are beside them."""
    found = set()
    for page in [SOURCE / "README.md", *SOURCE.glob("docs/**/*.md"), *SOURCE.glob("examples/**/*.md")]:
        for target in re.findall(r"!\[[^]]*\]\(([^)]+)\)", page.read_text()):
            found.add((page.parent / target).resolve().relative_to(SOURCE.resolve()).as_posix())
    return {name for name in found if not name.startswith("docs/figures/")}


def test_every_picture_is_made_by_the_script_and_shown_on_a_page():
    kept = {path.relative_to(SOURCE).as_posix() for path in (SOURCE / "docs" / "pictures").iterdir()}
    assert made() == shown()
    assert kept == {name for name in made() if name.startswith("docs/pictures/")}


def test_the_gallery_lists_every_example_and_shows_its_picture():
    """Each example has a picture of the viewer by its name."""
    text = (SOURCE / "docs" / "gallery.md").read_text()
    link, image = r"\(\.\./examples/(\w+)/README\.md\)", r"!\[[^]]*\]\(pictures/(\w+)\.png\)"
    entries = text.split("\n## ")[1:]
    pictured = {re.search(link, entry)[1] for entry in entries}
    # Each entry has the picture of its own example.
    assert [re.findall(image, entry) for entry in entries] == [re.findall(link, entry) for entry in entries]
    assert pictured == {path.name for path in (SOURCE / "examples").iterdir() if path.is_dir()}
    assert all((SOURCE / "docs" / "pictures" / f"{name}.png").exists() for name in pictured)


def test_models_scripts_and_moments_exist():
    for picture in PICTURES:
        assert sum(map(bool, (picture.fixture, picture.runs, picture.script, picture.cpp))) == 1
        assert not picture.script or (SOURCE / picture.script).exists()
        assert not picture.cpp or (SOURCE / "examples" / "cpp" / f"{picture.cpp}.cpp").exists()
        assert 0 <= picture.time <= 1
        for _, model, *_ in picture.runs:
            assert (SOURCE / model).exists(), model
    for drawing in DRAWINGS:
        assert (SOURCE / drawing.script[0]).exists(), drawing.script[0]
