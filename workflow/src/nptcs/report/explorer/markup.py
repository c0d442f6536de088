"""The explorer as a part of the page: its data, styles and scripts in one piece."""

from __future__ import annotations

import json
from importlib import resources
from typing import Any

SCRIPTS = (
    "surfaces.js",
    "lca.js",
    "wheel.js",
    "model.js",
    "address.js",
    "copy.js",
    "plots.js",
    "map.js",
    "space.js",
    "ring.js",
    "controls.js",
    "layout.js",
    "results.js",
    "profiles.js",
    "plane.js",
    "models.js",
    "page.js",
)
"""In the order in which they build on each other; together they are one module."""


def explorer_markup(payload: dict[str, Any], without_script: str) -> str:
    """Return the explorer as HTML.

    Parameters
    ----------
    payload : dict
        What `nptcs.report.explorer.payload.explorer_payload` returns.
    without_script : str
        What a reader without scripts is told.
    """
    data = json.dumps(payload, separators=(",", ":"), allow_nan=False, ensure_ascii=False)
    # neither a closing tag nor a comment in a text may end the block of data
    data = data.replace("<", "\\u003c")
    return (
        f"<style>\n{asset('explorer.css')}</style>\n"
        f'<div id="explorer" class="explorer"><p>{without_script}</p></div>\n'
        f'<script type="application/json" id="explorer-data">{data}</script>\n'
        f'<script type="module">\n{scripts()}</script>\n'
    )


def scripts() -> str:
    """Return all scripts as one text, without indentation and lines that only comment."""
    lines = (line.strip() for name in SCRIPTS for line in asset(name).splitlines())
    return "\n".join(line for line in lines if line and not line.startswith("//"))


def asset(name: str) -> str:
    """Read a file of the explorer as it is."""
    return resources.files("nptcs.report.explorer").joinpath("assets", name).read_text("utf-8")
