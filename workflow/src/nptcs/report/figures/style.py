"""One look for all figures, and figures as SVG text that is the same in each run.

Colours are those of Okabe and Ito, which readers with any colour vision tell apart; lines also
differ in marker or dash. One panel is one figure, so that a phone shows it at its own size.
"""

from __future__ import annotations

import io
import re
from collections.abc import Callable
from functools import wraps
from typing import Any, ParamSpec, TypeVar

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
MARKERS = ("o", "s", "^", "D", "v", "P", "X")
MAP = "cividis"
GREY = "#666666"
PANEL = (4.3, 3.3)
"""Width and height of a panel in inches; the report shows it at 96 pixels an inch or smaller."""

FONT = "'DejaVu Sans'"
FONTS = "'DejaVu Sans', Verdana, sans-serif"
_LONG_NUMBER = re.compile(r"-?\d+\.\d{3,}")

STYLE: Any = {
    "font.family": "DejaVu Sans",
    "font.size": 9.5,
    "axes.titlesize": 10,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#dddddd",
    "grid.linewidth": 0.6,
    "legend.fontsize": 8,
    "legend.frameon": False,
    "lines.linewidth": 1.3,
    "lines.markersize": 4.5,
    "savefig.facecolor": "white",
    "svg.fonttype": "none",
    "svg.hashsalt": "nptcs",
}

P = ParamSpec("P")
R = TypeVar("R")


def styled(function: Callable[P, R]) -> Callable[P, R]:
    """Run a plotting function under `STYLE`."""

    @wraps(function)
    def run(*args: P.args, **kwargs: P.kwargs) -> R:
        with mpl.rc_context(STYLE):
            return function(*args, **kwargs)

    return run


def panel(
    title: str, x_label: str, y_label: str, size: tuple[float, float] = PANEL
) -> tuple[Figure, Axes]:
    """Make one figure with one pair of axes."""
    figure = Figure(figsize=size, layout="constrained")
    axes = figure.add_subplot()
    axes.set(title=title, xlabel=x_label, ylabel=y_label)
    axes.xaxis.set_major_locator(MaxNLocator(7, steps=[1, 2, 2.5, 5, 10]))
    return figure, axes


def line_look(number: int) -> dict[str, Any]:
    """Colour and marker of a figure's line of that number, from 0."""
    return {"color": COLOURS[number % len(COLOURS)], "marker": MARKERS[number % len(MARKERS)]}


def mark_synthetic(figure: Figure, synthetic: bool) -> None:
    """Write across a figure that it shows synthetic data."""
    if synthetic:
        figure.axes[0].text(
            0.99,
            1.015,
            "SYNTHETIC DATA",
            transform=figure.axes[0].transAxes,
            ha="right",
            va="bottom",
            fontsize=7,
            fontweight="bold",
            color="#8a4b00",
        )


@styled
def to_svg(figure: Figure) -> str:
    """Draw a figure as SVG text, without a date and with stable ids.

    Words stay text; a reader without the font sees the next one of the list. Coordinates have
    hundredths of a point.
    """
    FigureCanvasSVG(figure)
    layout = figure.get_layout_engine()
    if layout is not None:
        # savefig would draw the whole figure once more to find the same layout
        layout.execute(figure)
        figure.set_layout_engine("none")
    stream = io.StringIO()
    figure.savefig(stream, format="svg", metadata={"Date": None, "Creator": None})
    return _LONG_NUMBER.sub(_shortened, stream.getvalue()).replace(FONT, FONTS)


def _shortened(number: re.Match[str]) -> str:
    return f"{float(number.group()):.2f}".rstrip("0").rstrip(".")
