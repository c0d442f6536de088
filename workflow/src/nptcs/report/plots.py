"""Figures as data URIs, so that the page needs no other file."""

from __future__ import annotations

import base64

from matplotlib.figure import Figure

from nptcs.report.blocks import Plot
from nptcs.report.figures.style import to_svg


def plot(figure: Figure, alt: str, synthetic: bool = False) -> Plot:
    """Turn a figure into a data URI."""
    width, height = figure.get_size_inches()
    data = base64.b64encode(to_svg(figure).encode("utf-8")).decode("ascii")
    return Plot(
        f"data:image/svg+xml;base64,{data}", alt, round(96 * width), round(96 * height), synthetic
    )
