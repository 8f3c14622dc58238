# SPDX-License-Identifier: Apache-2.0
"""Sphinx settings of the documentation site. The pages are the Markdown files of the repository, where they are; ./docs.sh builds."""

import os
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs" / "site"))
sys.path.insert(0, os.environ.get("BUCKENS_PYTHON_PATH", str(ROOT / "build" / "release" / "python")))

project = "Buckens"
author = "the Buckens developers"
copyright = author  # noqa: A001  # Sphinx's name for it
release = (ROOT / "VERSION").read_text(encoding="utf-8").strip()

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "formulas"]
myst_heading_anchors = 4
myst_enable_extensions = ["deflist", "dollarmath"]
myst_dmath_allow_labels = False
myst_dmath_allow_space = False
html_math_renderer = "katex"
# Pages link to sources, folders and models as on a forge; these are not documents.
suppress_warnings = ["myst.header", "myst.xref_missing"]
source_suffix = {".md": "markdown"}
root_doc = "docs/site/index"
exclude_patterns = ["build", "build/**", "viewer/node_modules", "viewer/node_modules/**", ".pytest_cache/**", "**/.pytest_cache/**", ".git", "tests/**", "**/*.out/**"]

autodoc_member_order = "bysource"
autodoc_typehints = "description"
napoleon_google_docstring = False

html_theme = "furo"
html_title = f"Buckens {release}"
html_copy_source = False
html_show_sourcelink = False
html_static_path = ["static"]
html_extra_path = [path for path in [os.environ.get("BUCKENS_CPP_PAGES", "")] if path]


def escape_stars(_app, _what, _name, _object, _options, lines):
    """Keywords of decks such as *MATRIX are not emphasis."""
    lines[:] = [re.sub(r"(?<![*\w])\*(?=[A-Z])", r"\\*", line) for line in lines]


def setup(app):
    # Before napoleon, which makes other lines of these.
    app.connect("autodoc-process-docstring", escape_stars, priority=100)
