"""Figures of what a polynomial leaves of its cases: over its value, and against a normal."""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from scipy import stats

from nptcs.report.figures.style import COLOURS, GREY, mark_synthetic, panel, styled

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
    figure, axes = panel(title, "value of the surface [N/mm]", "residual [N/mm]")
    value = influence["response"] - influence["residual"]
    sizes = 8 + 60 * influence["leverage"].to_numpy()
    axes.axhline(0, color=GREY, linewidth=0.8)
    axes.scatter(value, influence["residual"], s=sizes, color=COLOURS[0], alpha=0.8, linewidths=0)
    far = influence["studentised_residual"].abs() > FAR
    if far.any():
        axes.scatter(
            value[far],
            influence["residual"][far],
            s=90,
            facecolors="none",
            edgecolors=COLOURS[1],
            linewidths=1.2,
            label=f"studentised residual beyond {FAR:g}",
        )
        figure.legend(loc="outside lower center")
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
    figure, axes = panel(title, "normal quantile", "studentised residual")
    ordered = np.sort(influence["studentised_residual"].dropna().to_numpy())
    ranks = np.arange(1, len(ordered) + 1)
    quantiles = stats.norm.ppf((ranks - 0.375) / (len(ordered) + 0.25))
    if len(ordered):
        ends = np.array([quantiles[0], quantiles[-1]])
        axes.plot(ends, ends, color=GREY, linewidth=0.8)
    axes.plot(quantiles, ordered, "o", color=COLOURS[0])
    mark_synthetic(figure, synthetic)
    return figure
