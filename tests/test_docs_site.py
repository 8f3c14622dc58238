# SPDX-License-Identifier: Apache-2.0
"""The documentation site: ./docs.sh makes pages without warnings that open without a server."""

import html.parser
import os
import pathlib
import shutil
import subprocess
import urllib.parse

import pytest

from conftest import BINARY, SOURCE

pytestmark = pytest.mark.skipif(not (shutil.which("sphinx-build") and shutil.which("doxygen")),
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
