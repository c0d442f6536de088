"""Figure of a decision: the best designs with their intervals, and what was required."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from nptcs.language import tr
from nptcs.report.factor_labels import SYMBOLS
from nptcs.report.figures.style import BESIDE_LABELS, mark_synthetic, panel, styled
from nptcs.report.figures.theme import COLOURS
from nptcs.report.tables.headings import words
from nptcs.report.tables.names import in_words

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def design_names(designs: Sequence[str]) -> list[str]:
    r"""Name designs by the values in which they differ; by their rank if they do not differ.

    Examples
    --------
    >>> design_names(["22 plates, angle_deg 0", "22 plates, angle_deg 8"])
    ['A\xa00°', 'A\xa08°']
    """
    parts = [design.split(", ") for design in designs]
    count = min(map(len, parts))
    told = [place for place in range(count) if len({one[place] for one in parts}) > 1]
    if not told:
        return [tr("design {rank}", rank=rank) for rank, _ in enumerate(designs, start=1)]
    return [in_words(", ".join(one[place] for place in told), SYMBOLS) for one in parts]


def design_in_lines(name: str) -> str:
    r"""Write a design with more than two values on several lines, two on each.

    Examples
    --------
    >>> design_in_lines("13 plates, S 16.54 mm, T 1.2 mm")
    '13 plates, S 16.54 mm,\nT 1.2 mm'
    """
    parts = name.split(", ")
    pairs = [", ".join(parts[place : place + 2]) for place in range(0, len(parts), 2)]
    return ",\n".join(pairs)


@styled
def goal_intervals(designs: pd.DataFrame, synthetic: bool = False) -> Figure:
    """Draw one response of the best designs, and the range that a target or bound requires.

    Parameters
    ----------
    designs : DataFrame
        Rows of ``decision_designs.csv`` of one decision and goal.
    synthetic : bool
        Whether the materials are synthetic.
    """
    first = designs.iloc[0]
    at = tr(" at {at}", at=first["at"]) if first["at"] else ""
    unit = f" [{first['unit']}]" if first["unit"] not in ("", "1") else ""
    names = [design_in_lines(name) for name in design_names(designs["design"].tolist())]
    lines = max(name.count("\n") + 1 for name in names)
    figure, axes = panel(
        in_words(str(first["goal"]), {}),
        f"{words(str(first['response']))}{at}{unit}",
        "",
        (4.3, 2.6 + 0.13 * (lines - 1) * len(names)),
        BESIDE_LABELS,
    )
    place = np.arange(len(designs))[::-1]
    mean = designs["mean"].to_numpy()
    ends = np.vstack([mean - designs["low"], designs["high"] - mean])
    chosen = designs["chosen"].to_numpy(bool)
    for mine, colour, label in (
        (chosen, COLOURS[1], tr("chosen")),
        (~chosen, COLOURS[0], tr("other designs")),
    ):
        if mine.any():
            axes.errorbar(
                mean[mine],
                place[mine],
                xerr=ends[:, mine],
                fmt="s" if mine is chosen else "o",
                color=colour,
                capsize=3,
                label=label,
            )
    low, high = axes.get_xlim()
    limits = first[["smallest_accepted", "largest_accepted"]].to_numpy(float)
    if np.isfinite(limits).any():
        start, end = np.where(np.isfinite(limits), limits, [low, high])
        axes.axvspan(start, end, color=COLOURS[2], alpha=0.15, label=tr("required"))
        axes.set_xlim(low, high)
    axes.set_yticks(place, names)
    figure.data = designs
    axes.grid(visible=False, axis="y")
    figure.legend(loc="outside lower center", ncols=3)
    mark_synthetic(figure, synthetic)
    return figure
