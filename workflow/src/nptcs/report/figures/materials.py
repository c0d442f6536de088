"""Figures of specimens and materials: figures 2, 4 and 5 of the paper."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from nptcs.arrays import Array
from nptcs.report.figures.style import COLOURS, GREY, MARKERS, mark_synthetic, panel, styled

DRAWN_POINTS = 400
"""Readings of a curve that are drawn; the curve files hold all of them."""

STRAIN = "nominal strain [%]"
STRESS = "nominal stress [MPa]"


def thinned(curve: pd.DataFrame) -> pd.DataFrame:
    """Take evenly spaced readings with a strain, and the one of largest stress."""
    curve = curve[curve["strain_axial"].notna()]
    if len(curve) <= DRAWN_POINTS:
        return curve
    rows = np.linspace(0, len(curve) - 1, DRAWN_POINTS).round().astype(int)
    largest = int(np.argmax(np.abs(curve["stress_mpa"].to_numpy())))
    return curve.iloc[np.union1d(rows, [largest])]


@styled
def stress_strain(
    title: str,
    curves: Mapping[str, pd.DataFrame],
    left_out: Sequence[str],
    synthetic: bool = False,
) -> Figure:
    """Draw the curves of one series; specimens that the sheet leaves out are dashed grey.

    Parameters
    ----------
    title : str
        Name of the series.
    curves : mapping of str to DataFrame
        Curves (``strain_axial, stress_mpa``) by specimen.
    left_out : sequence of str
        Specimens that enter no result.
    synthetic : bool
        Whether any of them is synthetic.
    """
    figure, axes = panel(title, STRAIN, STRESS)
    used = 0
    for specimen, curve in curves.items():
        drawn = thinned(curve)
        if drawn.empty:
            continue
        out = specimen in left_out
        colour = GREY if out else COLOURS[used % len(COLOURS)]
        dash = "--" if out or used >= len(COLOURS) else "-"
        label = f"{specimen} (left out)" if out else specimen
        axes.plot(
            100 * drawn["strain_axial"],
            drawn["stress_mpa"],
            color=colour,
            linestyle=dash,
            linewidth=1.6 if out else 1.0,
            marker="x" if out else None,
            markevery=[len(drawn) - 1],
            markersize=7,
            zorder=3 if out else 2,
            label=label,
        )
        used += not out
    if 0 < len(axes.get_lines()) <= 8:
        axes.legend(loc="best", fontsize=7)
    mark_synthetic(figure, synthetic)
    return figure


@styled
def hyperelastic_fit(
    title: str,
    curves: Mapping[str, pd.DataFrame],
    stress: Callable[[Array], Array],
    label: str,
    strain_range: tuple[float, float],
    synthetic: bool = False,
) -> Figure:
    """Draw the tests of a rubber and its model over the range of the fit, figure 5.

    The model goes on, dotted, to twice the range, to show where it leaves the data.

    Parameters
    ----------
    title : str
        Rubber and test.
    curves : mapping of str to DataFrame
        Curves (``strain_axial, stress_mpa``) of the specimens of the fit.
    stress : callable
        Nominal stress (MPa) of the model at a stretch.
    label : str
        Name and constants of the model.
    strain_range : tuple of float
        Nominal strain range of the fit.
    synthetic : bool
        Whether any specimen is synthetic.
    """
    low, high = strain_range
    end = high + (high - low)
    figure, axes = panel(title, STRAIN, STRESS)
    axes.axvspan(100 * low, 100 * high, color="#efefef", zorder=0, label="range of the fit")
    for number, (specimen, curve) in enumerate(curves.items()):
        shown = thinned(curve[curve["strain_axial"].between(low, end)])
        axes.plot(
            100 * shown["strain_axial"],
            shown["stress_mpa"],
            color=COLOURS[number % (len(COLOURS) - 1)],
            linewidth=1.0,
            label=specimen,
        )
    for start, stop, dash in ((low, high, "-"), (high, end, ":")):
        stretch = np.linspace(1 + start, 1 + stop, 60)
        axes.plot(
            100 * (stretch - 1),
            stress(stretch),
            color="black",
            linestyle=dash,
            linewidth=1.8,
            label=label if dash == "-" else None,
        )
    axes.legend(loc="best")
    mark_synthetic(figure, synthetic)
    return figure


@styled
def c10_against_range(ranges: pd.DataFrame, synthetic: bool = False) -> Figure:
    """Draw C10 with its standard error against the upper end of the strain range.

    Parameters
    ----------
    ranges : DataFrame
        Rows of ``c10_against_range.csv`` of the joint fits (``specimen`` is "all").
    synthetic : bool
        Whether any specimen is synthetic.
    """
    figure, axes = panel(
        "C10 against strain range", "upper end of the strain range [%]", "C10 [MPa]"
    )
    for number, (rubber, table) in enumerate(ranges.groupby("rubber", sort=True)):
        colour = COLOURS[number % len(COLOURS)]
        axes.errorbar(
            100 * table["strain_high"],
            table["c10_mpa"],
            yerr=table["standard_error_mpa"],
            color=colour,
            marker=MARKERS[number % len(MARKERS)],
            capsize=2.5,
            label=str(rubber),
        )
        used = table[table["in_card"]]
        axes.plot(100 * used["strain_high"], used["c10_mpa"], "o", mfc="none", mec=colour, ms=11)
    axes.plot([], [], "o", mfc="none", mec=GREY, ms=9, label="on the card")
    axes.set_ylim(bottom=0)
    figure.legend(loc="outside lower center", ncols=2)
    mark_synthetic(figure, synthetic)
    return figure
