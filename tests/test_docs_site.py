# SPDX-License-Identifier: Apache-2.0
"""The documentation site: ./docs.sh makes pages without warnings that open without a server, with typeset formulas."""

import html
import html.parser
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import urllib.parse

import pytest

from conftest import BINARY, SOURCE

sys.path[:0] = [str(SOURCE / "docs" / "site"), str(SOURCE / "tools")]
import check_pages  # noqa: E402
import formulas  # noqa: E402

THEORY = sorted((SOURCE / "docs" / "theory").glob("*.md"))

made_here = pytest.mark.skipif(not (shutil.which("sphinx-build") and shutil.which("doxygen")),
                                reason="./docs.sh installs Sphinx and Doxygen; ./test.sh does not")


class Links(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.targets = []
        self.loaded = []

    def handle_starttag(self, tag, attributes):
        name = {"a": "href", "link": "href", "img": "src", "script": "src"}.get(tag)
        found = [value for key, value in attributes if key == name and value]
        self.targets += found
        if tag != "a":
            self.loaded += found


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


def formulas_of(page):
    """(LaTeX, whether it stands by itself) of the formulas of a page."""
    text = check_pages.CODE.sub(" ", check_pages.blank_fences(page.read_text(encoding="utf-8")))
    for match in check_pages.DISPLAYED.finditer(text):
        yield match.group(1), True
    for match in check_pages.INLINE.finditer(check_pages.DISPLAYED.sub("", text)):
        yield match.group(1), False


@pytest.fixture
def typesetter():
    if not shutil.which("node") or not formulas.KATEX.is_dir():
        pytest.skip("./docs.sh installs libjs-katex; ./test.sh does not")
    made = formulas.Typesetter()
    yield made
    made.close()


def test_all_formulas_are_understood(typesetter):
    pages = [page for folder in ("docs", "examples", "verification", "src", "bench") for page in sorted((SOURCE / folder).rglob("*.md"))]
    count = 0
    for page in pages:
        for tex, display in formulas_of(page):
            assert 'class="katex"' in typesetter.html(tex, display), f"{page}: {tex}"
            count += 1
    # At least one for each labelled equation: the expressions above find formulas.
    assert count > sum(page.read_text(encoding="utf-8").count("\\tag") for page in THEORY) > 50


@pytest.mark.parametrize("tex", [r"\frac{1}{", r"\unknown", "é", r"\text{a}_{b}_{c}"])
def test_a_formula_that_is_no_latex_is_an_error(typesetter, tex):
    with pytest.raises(formulas.FormulaError, match=re.escape(f"in the formula {tex}")):
        typesetter.html(tex)
    assert "katex" in typesetter.html("x")


def test_text_that_touches_a_formula_stays_with_it():
    made = '<span class="katex"><span class="katex-html"><span class="base">x</span></span></span>'
    assert formulas.with_neighbours(made, "(", "<,") == (
        '<span class="katex"><span class="katex-html"><span class="base"><span class="touching">(</span>x'
        '<span class="touching">&lt;,</span></span></span></span>')
    assert formulas.with_neighbours(made, None, None) == made


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    if BINARY.resolve() != (SOURCE / "build" / "release").resolve():
        pytest.skip("docs.sh uses build/release")
    made = tmp_path_factory.mktemp("docs") / "site"
    done = subprocess.run([SOURCE / "docs.sh", made], text=True, capture_output=True, env=os.environ | {"LC_ALL": "C.UTF-8"}, check=False)
    assert done.returncode == 0, done.stderr
    assert "WARNING" not in done.stderr, done.stderr
    return made


@made_here
def test_pages_are_complete(site):
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


@made_here
def test_formulas_are_typeset(site):
    for source in THEORY:
        page = site / source.relative_to(SOURCE).with_suffix(".html")
        text = page.read_text(encoding="utf-8")
        displays = [display for _, display in formulas_of(source)]
        assert text.count('<div class="formula">') == displays.count(True), page
        assert text.count('<span class="katex">') == len(displays), page
        assert "$$" not in text and "katex-error" not in text, page
        loaded = Links()
        loaded.feed(text)
        assert [target for target in loaded.loaded if urllib.parse.urlsplit(target).scheme not in ("", "data")] == [], page
    style = site / "_static" / "katex" / "katex.css"
    addresses = re.findall(r"url\(([^)]+)\)", style.read_text(encoding="utf-8"))
    assert len(addresses) > 10 and all((style.parent / address).is_file() for address in addresses), addresses
    assert sum(path.stat().st_size for path in style.parent.rglob("*") if path.is_file()) < 500_000


# Runs in a page: are the fonts there, and which formulas are wider than the text or have their number somewhere else?
LOOK = """<script>addEventListener("load", () => document.fonts.ready.then(() => {
  const wide = [...document.querySelectorAll(".formula")].filter((formula) => formula.scrollWidth > formula.clientWidth);
  const tags = [...document.querySelectorAll(".formula .tag")].map((tag) => {
    const box = tag.closest(".formula").getBoundingClientRect();
    return Math.abs(tag.getBoundingClientRect().right - box.right);
  });
  const fonts = [...document.fonts].filter((font) => font.family.startsWith("KaTeX") && font.status === "loaded").length;
  const seen = { wide: wide.map((formula) => formula.querySelector("annotation").textContent), tags, fonts };
  document.body.innerHTML = "<pre id=seen></pre>";
  document.getElementById("seen").textContent = JSON.stringify(seen);
}))</script>"""


@made_here
def test_formulas_fit_the_page(site):
    tags = 0
    for source in THEORY:
        page = site / source.relative_to(SOURCE).with_suffix(".html")
        watched = page.with_name(f"watched-{page.name}")
        watched.write_text(page.read_text(encoding="utf-8").replace("</body>", LOOK + "</body>"), encoding="utf-8")
        shown = in_browser(watched.as_uri())
        watched.unlink()
        seen = json.loads(html.unescape(re.search(r'<pre id="seen">(.*?)</pre>', shown, re.DOTALL).group(1)))
        assert seen["fonts"] >= 2, page  # letters and figures, at least
        assert seen["wide"] == [], page
        assert all(distance < 8 for distance in seen["tags"]), page  # pixels: the space around a number
        tags += len(seen["tags"])
    assert tags > 50


def in_browser(address):
    """A page from the disk after its scripts have run, in a browser as wide as a screen."""
    browser = shutil.which("chromium") or shutil.which("google-chrome")
    if browser is None:
        pytest.skip("no browser is installed")
    with tempfile.TemporaryDirectory() as profile:
        return subprocess.run([browser, "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={profile}", "--window-size=1300,1000",
                               "--virtual-time-budget=20000", "--dump-dom", address],
                              text=True, capture_output=True, timeout=120, check=True).stdout


def found_by_search(site, words):
    """Pages that the search shows for some words."""
    shown = in_browser((site / "search.html").as_uri() + "?" + urllib.parse.urlencode({"q": words}))
    links = Links()
    links.feed(shown.partition('id="search-results"')[2])
    return {urllib.parse.urlsplit(target).path for target in links.targets}
