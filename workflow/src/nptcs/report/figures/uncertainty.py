"""Figure of the shares of the variance: which test or tolerance makes a response uncertain."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from nptcs.language import tr
from nptcs.report.figures.style import BESIDE_LABELS, mark_synthetic, panel, styled
from nptcs.report.figures.theme import COLOURS, PAPER
from nptcs.report.tables.headings import heading

if TYPE_CHECKING:
    from matplotlib.figure import Figure

KINDS = {
    "test": COLOURS[0],
    "stated": COLOURS[1],
    "tolerance": COLOURS[2],
    "surface": COLOURS[4],
}
HATCHES = {"test": "", "stated": "///", "tolerance": "\\\\\\", "surface": "xx"}


@styled
def share_bars(shares: pd.DataFrame, title: str, synthetic: bool = False) -> Figure:
    """Draw the shares of one response, the largest at the top, coloured by kind of source.

    Parameters
    ----------
    shares : DataFrame
        Rows of ``uncertainty_shares.csv`` of one response that have a share.
    title : str
    synthetic : bool
        Whether the materials are synthetic.
    """
    names = [inputs_in_lines(str(text)) for text in shares["quantities"]]
    lines = max(name.count("\n") + 1 for name in names)
    height = 1.3 + (0.15 + 0.13 * lines) * len(names)
    figure, axes = panel(title, tr("share of the variance [%]"), "", (4.3, height), BESIDE_LABELS)
    place = np.arange(len(shares))[::-1]
    for kind, colour in KINDS.items():
        mine = (shares["kind"] == kind).to_numpy()
        if mine.any():
            axes.barh(
                place[mine],
                shares["share_percent"].to_numpy()[mine],
                color=colour,
                hatch=HATCHES[kind],
                edgecolor=PAPER,
                label=tr(kind),
            )
    for bar, share in zip(place, shares["share_percent"], strict=True):
        axes.annotate(
            share_text(share),
            (share, bar),
            (3, 0),
            textcoords="offset points",
            va="center",
            fontsize=7.5,
        )
    figure.data = shares
    axes.set_yticks(place, names, fontsize=7.5)
    axes.set_xlim(0, max(1.0, 1.12 * float(shares["share_percent"].max())))
    axes.grid(visible=False, axis="y")
    figure.legend(loc="outside lower center", ncols=4)
    mark_synthetic(figure, synthetic)
    return figure


def share_text(percent: float) -> str:
    """Write a share in percent: whole, or to one digit if small, or as less than a hundredth.

    Examples
    --------
    >>> share_text(83.4), share_text(0.07), share_text(4e-7)
    ('83', '0.07', '< 0.01')
    """
    if percent >= 1:
        return f"{percent:.0f}"
    return f"{percent:.1g}" if percent >= 0.01 else "< 0.01"


def inputs_in_lines(quantities: str) -> str:
    """Write quantities and their standard deviations for a reader, each on its own line.

    Examples
    --------
    >>> print(inputs_in_lines("e1_mpa ± 2.04e+03, nu12 ± 0.01"))
    E1 ± 2040 MPa
    ν12 ± 0.01
    """
    lines = []
    for part in quantities.split(", "):
        name, between, spread = part.partition(" ± ")
        try:
            number = float(f"{float(spread):.3g}")
        except ValueError:
            lines.append(tr(part))
            continue
        written = heading(name)
        gap = "" if written.unit == "°" else " "
        lines.append(f"{written.name}{between}{number:g}{gap}{written.unit}".rstrip())
    return "\n".join(lines)
