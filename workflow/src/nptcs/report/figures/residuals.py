"""Figures of a polynomial's residuals: over its value, and against a normal."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd
from scipy.special import ndtri

from nptcs.language import tr
from nptcs.report.figures.style import mark_synthetic, note_sampled, panel, sampled, styled
from nptcs.report.figures.theme import COLOURS, GREY

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FAR = 3.0
"""Studentised residual beyond which a case is named."""


@styled
def residuals_over_value(influence: pd.DataFrame, title: str, synthetic: bool = False) -> Figure:
    """Draw residuals over the value of the surface; the area of a mark grows with its leverage.

    Curvature shows a term that is missing, a funnel a response that should be transformed.

    Parameters
    ----------
    influence : DataFrame
        Rows of ``surface_influence.csv`` of one study and solver.
    title : str
    synthetic : bool
        Whether the materials are synthetic.
    """
    figure, axes = panel(title, tr("value of the surface [N/mm]"), tr("residual [N/mm]"))
    far = influence["studentised_residual"].abs() > FAR
    drawn = pd.concat([sampled(influence[~far]), sampled(influence[far])])
    numbers = pd.DataFrame(
        {
            "point": drawn["point"],
            "value_n_per_mm": drawn["response"] - drawn["residual"],
            "residual_n_per_mm": drawn["residual"],
            "studentised_residual": drawn["studentised_residual"],
            "leverage": drawn["leverage"],
        }
    )
    axes.axhline(0, color=GREY, linewidth=0.8)
    for size, rows in numbers.groupby(numbers["leverage"].mul(5).round()):
        axes.plot(
            rows["value_n_per_mm"],
            rows["residual_n_per_mm"],
            "o",
            color=COLOURS[0],
            alpha=0.8,
            mew=0,
            ms=3.0 + 1.2 * float(str(size)),
        )
    if far.any():
        rows = numbers[numbers["studentised_residual"].abs() > FAR]
        axes.plot(
            rows["value_n_per_mm"],
            rows["residual_n_per_mm"],
            "o",
            mfc="none",
            color=COLOURS[1],
            ms=10,
            mew=1.2,
            label=tr("studentised residual beyond {far:g}", far=FAR),
        )
        figure.legend(loc="outside lower center")
    note_sampled(axes, len(drawn), len(influence), tr("cases"))
    figure.data = numbers
    mark_synthetic(figure, synthetic)
    return figure


@styled
def residual_quantiles(influence: pd.DataFrame, title: str, synthetic: bool = False) -> Figure:
    """Draw sorted studentised residuals over normal quantiles (Blom's positions).

    Parameters
    ----------
    influence, title, synthetic
        As in `residuals_over_value`.
    """
    figure, axes = panel(title, tr("normal quantile"), tr("studentised residual"))
    ordered = np.sort(influence["studentised_residual"].dropna().to_numpy())
    ranks = np.arange(1, len(ordered) + 1)
    quantiles = ndtri((ranks - 0.375) / (len(ordered) + 0.25))
    if len(ordered):
        ends = np.array([quantiles[0], quantiles[-1]])
        axes.plot(ends, ends, color=GREY, linewidth=0.8)
    drawn = sampled(pd.DataFrame({"normal_quantile": quantiles, "studentised_residual": ordered}))
    axes.plot(drawn["normal_quantile"], drawn["studentised_residual"], "o", color=COLOURS[0])
    note_sampled(axes, len(drawn), len(ordered), tr("cases"))
    figure.data = drawn
    mark_synthetic(figure, synthetic)
    return figure
