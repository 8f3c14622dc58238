# SPDX-License-Identifier: Apache-2.0
"""The documentation site: ./docs.sh makes pages without warnings that open without a server."""

import html.parser
import os
import pathlib
import shutil
import subprocess
import tempfile
import urllib.parse

import pytest

from conftest import BINARY, SOURCE

made_here = pytest.mark.skipif(not (shutil.which("sphinx-build") and shutil.which("doxygen")),
                                reason="./docs.sh installs Sphinx and Doxygen; ./test.sh does not")


class Links(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.targets = []

    def handle_starttag(self, tag, attributes):
        name = {"a": "href", "link": "href", "img": "src", "script": "src"}.get(tag)
        self.targets += [value for key, value in attributes if key == name and value]


def dead_links(site, page):
    links = Links()
    links.feed(page.read_text(encoding="utf-8"))
    for target in links.targets:
        parts = urllib.parse.urlsplit(target)
        if parts.scheme or not parts.path:
            continue
        if not (page.parent / urllib.parse.unquote(parts.path)).exists():
            yield f"{page.relative_to(site)} -> {target}"


def test_every_page_is_in_the_table_of_contents():
    """What Sphinx would warn about, also where it is not installed."""
    index = SOURCE / "docs" / "site" / "index.md"
    listed = set()
    for line in index.read_text().splitlines():
        if line.startswith(".."):
            listed.update(path.resolve() for path in index.parent.parent.glob(line.removeprefix("../") + ".md"))
    pages = {page.resolve() for folder in ("tutorials", "reference", "theory", "developers")
             for page in (SOURCE / "docs" / folder).glob("*.md")}
    assert sorted(str(page.relative_to(SOURCE.resolve())) for page in pages - listed) == []


@made_here
def test_pages_are_complete(tmp_path):
    if BINARY.resolve() != (SOURCE / "build" / "release").resolve():
        pytest.skip("docs.sh uses build/release")
    site = tmp_path / "site"
    made = subprocess.run([SOURCE / "docs.sh", site], text=True, capture_output=True, env=os.environ | {"LC_ALL": "C.UTF-8"}, check=False)
    assert made.returncode == 0, made.stderr
    assert "WARNING" not in made.stderr, made.stderr
    # Search works without a server: its index is a script, not a file to be fetched.
    assert "Search.setIndex" in (site / "searchindex.js").read_text(encoding="utf-8")
    assert 'id="buckens.Simulation.step"' in (site / "docs/site/python-api.html").read_text(encoding="utf-8")
    assert list((site / "cpp").glob("*Simulation*.html"))
    pages = [page for page in site.rglob("*.html") if "cpp" not in page.relative_to(site).parts[0]]
    sources = [path for path in pathlib.Path(SOURCE / "docs").rglob("*.md")]
    assert len(pages) >= len(sources)
    assert [link for page in pages for link in dead_links(site, page)] == []
    for words, page in (("checkpoint", "docs/tutorials/continue.html"), ("set_signal", "docs/tutorials/python.html")):
        assert page in found_by_search(site, words), words


def found_by_search(site, words):
    """Pages that the search shows for some words, in a browser that has the pages from the disk."""
    browser = shutil.which("chromium") or shutil.which("google-chrome")
    if browser is None:
        pytest.skip("no browser is installed")
    address = (site / "search.html").as_uri() + "?" + urllib.parse.urlencode({"q": words})
    with tempfile.TemporaryDirectory() as profile:
        shown = subprocess.run([browser, "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={profile}",
                                "--virtual-time-budget=20000", "--dump-dom", address],
                               text=True, capture_output=True, timeout=120, check=True)
    links = Links()
    links.feed(shown.stdout.partition('id="search-results"')[2])
    return {urllib.parse.urlsplit(target).path for target in links.targets}
