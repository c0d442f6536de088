"""The documentation site: `make docs` builds it from the Markdown pages as they are.

The source folder is the repository, so that the links between docs, README and CHANGELOG lead
somewhere on the site as they do on a forge. The pages are plain Markdown that reads well without
the site. What the site adds is made here: the navigation, which lists whatever pages the folders
hold, and equations as MathML, set when the site is built, so that a page needs no script and no
network for them.
"""

from __future__ import annotations

import re
import sys
from fnmatch import fnmatch
from pathlib import Path
from typing import Any

from docutils import nodes
from docutils.utils.math import MathError
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx.application import Sphinx
from sphinx.errors import ExtensionError

sys.path.insert(0, str(Path(__file__).parents[1] / "workflow" / "src"))
from nptcs import __version__

project = "nptcs"
author = copyright = "The nptcs developers"  # noqa: A001
version = release = __version__
language = "en"
extensions = ["myst_parser"]
root_doc = "docs/index"
include_patterns = ["*.md", "docs/**", "config/README.md", "raw_data/published/README.md"]
exclude_patterns = [".*", "docs/_static", "build", "results", "workflow", "tests", "benchmarks"]

myst_enable_extensions = ["dollarmath"]
myst_fence_as_directive = ["math"]  # ```math, as forges set it
myst_heading_anchors = 5  # the anchors that forges make
suppress_warnings = [
    "misc.highlighting_failure",  # blocks of the how-to pages that show parts of files
    "myst.header",  # pages whose first heading is followed by one of the third level
]

html_theme = "furo"
html_title = f"nptcs {__version__}"
html_static_path = ["_static"]
html_extra_path = ["_extra"]
html_css_files = ["site.css"]
html_copy_source = False
html_show_sourcelink = False
html_math_renderer = "mathml"
html_theme_options = {"navigation_with_keys": True}

linkcheck_timeout = 20
linkcheck_retries = 2

NAVIGATION = {
    "Start": ["/README", "tutorial", "lab-data", "report", "runs", "where-it-runs"],
    "How to": ["how-to/*"],
    "Methods": [
        "methods/ingest",
        "methods/reduction",
        "methods/calibration",
        "methods/lca",
        "methods/fe-theory",
        "methods/ring",
        "methods/surface",
        "methods/*",
    ],
    "Results": ["results/*", "misprints", "/raw_data/published/README"],
    "Reference": ["configuration", "tables", "commands", "/config/README"],
    "Project": ["/CONTRIBUTING", "/CHANGELOG", "decisions/*", "*"],
}
"""Sections of the navigation: pages, and folders from which all remaining pages are taken."""


def navigation(pages: set[str]) -> str:
    """Return the navigation as MyST directives; each page is in the first section that names it."""
    parts = []
    left = pages - {root_doc}
    for caption, patterns in NAVIGATION.items():
        parts += ["", "```{toctree}", ":hidden:", f":caption: {caption}", ""]
        for pattern in patterns:
            path = pattern[1:] if pattern.startswith("/") else f"docs/{pattern}"
            found = sorted(page for page in left if fnmatch(page, path))
            left -= set(found)
            parts += [f"/{page}" for page in found]
        parts += ["```"]
    return "\n".join([*parts, ""])


def add_navigation(app: Sphinx, name: str, source: list[str]) -> None:
    """Append the navigation to the index, which is a plain page everywhere else."""
    if name == root_doc:
        source[0] += navigation(app.env.found_docs)


def primes(tex: str) -> str:
    """Write primes as powers, the form that the converter can typeset."""

    def raised(found: re.Match[str]) -> str:
        power = (found[3] or "").strip("^{}")
        return f"{found[1]}^{{{PRIME * len(found[2])} {power}}}"

    return re.sub(r"(\w|\})('+)(\^(?:\w|\{[^{}]*\}))?", raised, tex)


def mathml(translator: Any, node: nodes.math | nodes.math_block) -> None:
    """Write an equation as MathML; a mistake in its TeX stops the build with the place."""
    block = isinstance(node, nodes.math_block)
    try:
        written = str(tex2mathml(primes(node.astext()), as_block=block))
    except (MathError, SyntaxError) as error:
        place = f"{node.source or translator.builder.current_docname}:{node.line}"
        raise ExtensionError(f"{place}: cannot set {node.astext()!r}: {error}") from error
    translator.body.append(f'<div class="equation">{written}</div>' if block else written)
    raise nodes.SkipNode


PRIME = r"\prime"


def setup(app: Sphinx) -> None:
    """Register the navigation and the equations."""
    app.connect("source-read", add_navigation)
    app.add_html_math_renderer("mathml", (mathml, None), (mathml, None))
