# SPDX-License-Identifier: Apache-2.0
"""Formulas of the pages, typeset by KaTeX while the site is made: what is read needs no script and no network.

A Sphinx extension: `$...$` and `$$...$$` become HTML; style sheet and fonts of KaTeX are copied to the site.
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
from html import escape

KATEX = pathlib.Path("/usr/share/javascript/katex")  # Debian's package libjs-katex
SCRIPT = pathlib.Path(__file__).with_name("formulas.js")


class FormulaError(ValueError):
    """A formula that KaTeX does not understand."""


class Typesetter:
    """KaTeX in a process of Node.js that answers one formula after the other."""

    def __init__(self, katex=KATEX):
        self.process = subprocess.Popen(["node", SCRIPT, katex / "katex.js"], text=True, encoding="utf-8",
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE)

    def html(self, tex, display=False):
        self.process.stdin.write(json.dumps({"tex": tex, "display": display}) + "\n")
        self.process.stdin.flush()
        answer = self.process.stdout.readline()
        if not answer:
            raise FormulaError("node ended without an answer; is libjs-katex installed?")
        answer = json.loads(answer)
        if "error" in answer:
            raise FormulaError(f"{answer['error']}, in the formula {tex}")
        return answer["html"]

    def close(self):
        self.process.stdin.close()
        self.process.wait()
        self.process.stdout.close()


def copy_fonts(folder, katex=KATEX):
    """The style sheet with the one format of its fonts that all browsers of today read."""
    (folder / "fonts").mkdir(parents=True, exist_ok=True)
    style = (katex / "katex.min.css").read_text(encoding="utf-8")
    style = re.sub(r',url\([^)]*\.(?:woff|ttf)\) format\([^)]*\)', "", style)
    (folder / "katex.css").write_text(style, encoding="utf-8")
    for font in re.findall(r"url\((fonts/[^)]+)\)", style):
        shutil.copyfile(katex / font, folder / font)


def bind(doctree):
    """Gives a formula what touches it in the text, so that no line begins with a comma or ends with a bracket."""
    from docutils import nodes

    for formula in doctree.findall(nodes.math):
        parent = formula.parent
        place = parent.index(formula)
        for key, neighbour, pattern in (("before", place - 1, r"[^\s)]+$"), ("after", place + 1, r"^[^\s(]+")):
            text = parent[neighbour] if 0 <= neighbour < len(parent) else ""
            touching = re.search(pattern, text) if isinstance(text, nodes.Text) else None
            if touching:
                formula[key] = touching.group(0)
                parent[neighbour] = nodes.Text(text[:touching.start()] + text[touching.end():])


def with_neighbours(html, before, after):
    """Puts text into the first and the last piece of a formula: lines break between the pieces only."""
    if before:
        html = html.replace('<span class="base">', f'<span class="base"><span class="touching">{escape(before)}</span>', 1)
    if after:
        end = "</span></span></span>"
        html = f'{html.removesuffix(end)}<span class="touching">{escape(after)}</span>{end}'
    return html


def setup(app):
    from docutils.nodes import SkipNode
    from sphinx.errors import ExtensionError

    typesetters = {}  # one in each process: with -j, Sphinx writes pages in copies of itself

    def write(translator, node, display):
        if os.getpid() not in typesetters:
            typesetters[os.getpid()] = Typesetter()
        try:
            html = typesetters[os.getpid()].html(node.astext(), display)
        except FormulaError as error:
            raise ExtensionError(f"{node.source}:{node.line}: {error}") from error
        if display:
            html = f'<div class="formula">{html}</div>\n'
        else:
            html = with_neighbours(html, node.get("before"), node.get("after"))
        translator.body.append(html)
        raise SkipNode

    def finish(built, error):
        for typesetter in typesetters.values():
            typesetter.close()
        if not error and built.builder.format == "html":
            copy_fonts(pathlib.Path(built.outdir) / "_static" / "katex")

    app.add_html_math_renderer("katex", (lambda translator, node: write(translator, node, False), None),
                               (lambda translator, node: write(translator, node, True), None))
    app.connect("doctree-resolved", lambda _app, doctree, _name: bind(doctree))
    app.connect("build-finished", finish)
    # All pages are written anew when this file changes.
    app.add_config_value("formulas_source", pathlib.Path(__file__).read_text(encoding="utf-8"), "html")
    app.add_css_file("katex/katex.css")
    app.add_css_file("formulas.css")
    return {"parallel_read_safe": True, "parallel_write_safe": True}
