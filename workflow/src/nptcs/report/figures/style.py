"""The same look for all figures, and figures as SVG text that is the same in each run.

Lines differ in marker or dash as well as in colour. One panel is one figure, so that a phone shows
it at its own size. A figure carries the numbers that it shows, which the page offers as CSV.
"""

from __future__ import annotations

import io
from collections.abc import Callable
from functools import wraps
from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar

import numpy as np
import pandas as pd
from cycler import cycler

from nptcs.language import tr
from nptcs.report.figures.theme import COLOURS, GREY, GRID, WARNING
from nptcs.report.text import text_width, wrapped

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.figure import Figure

    from nptcs.report.figures.layout import Chart

MARKERS = ("o", "s", "^", "D", "v", "P", "X")
DASHES: tuple[Any, ...] = ("-", (0, (5, 1.5)), (0, (1.5, 1.5)), (0, (6, 1.5, 1.5, 1.5)))
HATCHES = ("", "///", "\\\\\\", "xx")
MAP = "cividis"
PANEL = (4.3, 3.3)
"""Width and height of a panel in inches; the report shows it at 96 pixels an inch or smaller."""

FIRST_PLACE = (0.15, 0.17, 0.8, 0.7)
"""Left, bottom, width and height of the axes as shares of the panel, before its words are known."""

BAR_PLACE = (0.9, 0.17, 0.03, 0.7)
"""The same of a colour bar."""

TITLE_CHARACTERS = 36
"""Characters of a title that fit on one line above the axes of a panel."""

BESIDE_LABELS = 24
"""The same where long labels on the left leave less room."""

BESIDE_SYNTHETIC = 22
"""Characters of a title that leave room on its line for the label of synthetic data."""

MOST_MARKS = 300
"""Most cases that a figure draws; of more it draws a sample, and says so."""

STYLE: Any = {
    "font.family": "DejaVu Sans",
    "font.size": 9.5,
    "axes.titlesize": 10,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.titley": 1.0,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.facecolor": "none",
    "axes.prop_cycle": cycler(color=COLOURS),
    "grid.color": GRID,
    "grid.linewidth": 0.6,
    "hatch.linewidth": 0.7,
    "legend.fontsize": 8,
    "legend.frameon": False,
    "legend.title_fontsize": 8,
    "lines.linewidth": 1.3,
    "lines.markersize": 4.5,
    "figure.facecolor": "none",
    "svg.fonttype": "none",
    "svg.hashsalt": "nptcs",
}

P = ParamSpec("P")
R = TypeVar("R")


def data_of(figure: Figure) -> pd.DataFrame | None:
    """Return the numbers that a figure shows; None for a figure that has none."""
    from nptcs.report.figures.layout import Chart

    return figure.data if isinstance(figure, Chart) else None


def styled(function: Callable[P, R]) -> Callable[P, R]:
    """Run a plotting function under `STYLE`."""

    @wraps(function)
    def run(*args: P.args, **kwargs: P.kwargs) -> R:
        import matplotlib as mpl

        with mpl.rc_context(STYLE):
            return function(*args, **kwargs)

    return run


def panel(
    title: str,
    x_label: str,
    y_label: str,
    size: tuple[float, float] = PANEL,
    fitting: int = TITLE_CHARACTERS,
) -> tuple[Chart, Axes]:
    """Make one figure with one pair of axes, with round numbers on both.

    Parameters
    ----------
    title, x_label, y_label : str
    size : tuple of float
        Width and height in inches.
    fitting : int
        Characters of the title that fit on one line.
    """
    from nptcs.report.figures.layout import Chart, PanelLayout

    figure = Chart(figsize=size, layout=PanelLayout())
    axes = figure.add_axes(FIRST_PLACE)
    lines = [wrapped(line, fitting) for line in title.split("\n")]
    axes.set(title="\n".join(lines), xlabel=tr(x_label), ylabel=tr(y_label))
    for axis in (axes.xaxis, axes.yaxis):
        round_ticks(axis)
    return figure, axes


def round_ticks(axis: Axis, most: int = 7) -> None:
    """Put at most `most` ticks at round numbers; for an angle at multiples of 15 or 30 degrees."""
    from matplotlib.ticker import MaxNLocator

    angle = axis.get_label_text().endswith(("[deg]", "[°]"))
    steps = [1, 1.5, 3, 4.5, 6, 9, 10] if angle else [1, 2, 5, 10]
    axis.set_major_locator(MaxNLocator(most, steps=steps))


def line_look(number: int) -> dict[str, Any]:
    """Colour and marker of the line with this number in a figure, counted from 0."""
    return {"color": COLOURS[number % len(COLOURS)], "marker": MARKERS[number % len(MARKERS)]}


def line_sign(label: str, **look: Any) -> Artist:
    """Make the sign of a line or of a mark for a legend."""
    from matplotlib.lines import Line2D

    return Line2D([], [], label=label, **look)


def mark_synthetic(figure: Figure, synthetic: bool) -> None:
    """Write above the axes that a figure shows synthetic data, where the title leaves room."""
    if not synthetic:
        return
    axes = figure.axes[0]
    lines = axes.get_title(loc="left").split("\n")
    above = len(lines) if text_width(lines[-1]) > BESIDE_SYNTHETIC or len(lines) > 1 else 0
    axes.annotate(
        tr("SYNTHETIC DATA"),
        (1, 1),
        (0, 5 + 13 * above),
        xycoords="axes fraction",
        textcoords="offset points",
        ha="right",
        va="bottom",
        fontsize=7,
        fontweight="bold",
        color=WARNING,
    )


def sampled(table: pd.DataFrame, most: int = MOST_MARKS) -> pd.DataFrame:
    """Take at most `most` rows of a table, in even steps, with the first and the last."""
    if len(table) <= most:
        return table
    return table.iloc[np.linspace(0, len(table) - 1, most).round().astype(int)]


def note_sampled(axes: Axes, drawn: int, of: int, what: str) -> None:
    """Write into a figure that it draws only a sample."""
    if drawn < of:
        axes.annotate(
            tr("sampled: {drawn:,} of {of:,} {what}", drawn=drawn, of=of, what=what),
            (1, 0),
            (-3, 4),
            xycoords="axes fraction",
            textcoords="offset points",
            ha="right",
            fontsize=7,
            color=GREY,
        )


@styled
def to_svg(figure: Figure) -> str:
    """Draw a figure as Matplotlib writes SVG, without a date; words stay text."""
    from nptcs.report.figures.canvas import WideCanvas

    stream = io.StringIO()
    WideCanvas(figure).write(stream)
    return stream.getvalue()
