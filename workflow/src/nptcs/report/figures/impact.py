"""Figure of the comprehensive impact values, table 9 of the paper."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from nptcs.language import tr
from nptcs.report.figures.style import BESIDE_LABELS, HATCHES, mark_synthetic, panel, styled
from nptcs.report.figures.theme import COLOURS, INK, PAPER
from nptcs.report.tables.headings import words

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@styled
def impact_bars(
    impact: pd.DataFrame,
    labels: Mapping[tuple[str, str], str],
    rules: Sequence[str],
    synthetic: bool = False,
) -> Figure:
    """Draw the impact values of one solver, one bar for each rule, the published value as a mark.

    Parameters
    ----------
    impact : DataFrame
        Rows of ``impact.csv`` of one solver.
    labels : mapping of (study, factor) to str
        Names of the bars.
    rules : sequence of str
        Averaging rules; the first one gives the order.
    synthetic : bool
        Whether the materials are synthetic.
    """
    order = ranked(impact, rules[0])
    solver = impact["solver"].iloc[0]
    height = 1.3 + 0.24 * len(order) * (len(rules) + 1)
    figure, axes = panel(
        tr("Impact of each factor, {solver}", solver=solver),
        tr("impact on the vertical stiffness [N/mm]"),
        "",
        (4.3, height),
        BESIDE_LABELS,
    )
    place = np.arange(len(order))[::-1].astype(float)
    width = 0.8 / len(rules)
    by_rule = {
        rule: rows.set_index(["study", "factor"]).loc[order]
        for rule, rows in impact.groupby("rule")
    }
    for number, rule in enumerate(rules):
        axes.barh(
            place + width * ((len(rules) - 1) / 2 - number),
            by_rule[rule]["impact"].to_numpy(),
            height=width,
            color=COLOURS[number % len(COLOURS)],
            hatch=HATCHES[number % len(HATCHES)],
            edgecolor=PAPER,
            label=words(rule),
        )
    published = by_rule[rules[0]]["published_impact"].to_numpy()
    if np.isfinite(published).any():
        axes.plot(published, place, "|", color=INK, ms=26, mew=1.6)
        axes.plot([], [], "|", color=INK, ms=8, mew=1.6, label=tr("published, table 9 (FE)"))
    axes.axvline(0, color=INK, linewidth=0.8)
    axes.set_yticks(place, [labels[key] for key in order])
    axes.grid(visible=False, axis="y")
    columns = ["study", "factor", "rule", "impact", "published_impact", "rank", "published_rank"]
    figure.data = impact[columns]
    figure.legend(loc="outside lower left", ncols=2)
    mark_synthetic(figure, synthetic)
    return figure


def ranked(impact: pd.DataFrame, rule: str) -> list[tuple[str, str]]:
    """List (study, factor) of one solver's rows, the largest impact by `rule` first."""
    rows = impact[impact["rule"] == rule]
    rows = rows.iloc[np.argsort(-rows["impact"].abs().to_numpy(), kind="stable")]
    return list(zip(rows["study"], rows["factor"], strict=True))
