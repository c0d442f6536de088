"""Figures of the rubbers' models: figure 5 of the paper."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from nptcs.arrays import Array
from nptcs.language import tr
from nptcs.report.figures.specimens import NORMAL, evenly_spaced
from nptcs.report.figures.style import DASHES, MARKERS, mark_synthetic, panel, styled
from nptcs.report.figures.theme import COLOURS, GREY, INK, PAPER, RANGE

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@styled
def hyperelastic_fit(
    title: str,
    curves: Mapping[str, pd.DataFrame],
    stress: Callable[[Array], Array],
    label: str,
    strain_range: tuple[float, float],
    synthetic: bool = False,
    published_c10_mpa: float = math.nan,
) -> Figure:
    """Draw the tests of a rubber and its model over the range of the fit, figure 5.

    The model continues, dotted, to twice the range, to show where it leaves the data. Hollow marks
    are the neo-Hookean model with the C10 printed in the paper, P = 2 C10 (λ - λ⁻²).

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
    published_c10_mpa : float
        The paper's C10 of this rubber; NaN for none.
    """
    low, high = strain_range
    end = high + (high - low)
    figure, axes = panel(title, NORMAL.strain_words, NORMAL.stress_words)
    axes.axvspan(
        100 * low, 100 * high, color=RANGE, ec=GREY, zorder=0, label=tr("range of the fit")
    )
    parts = []
    for number, (specimen, curve) in enumerate(curves.items()):
        shown = evenly_spaced(curve[curve["strain_axial"].between(low, end)])
        axes.plot(
            100 * shown["strain_axial"],
            shown["stress_mpa"],
            color=COLOURS[number % (len(COLOURS) - 1)],
            linestyle=DASHES[number % len(DASHES)],
            linewidth=1.0,
            label=specimen,
        )
        parts.append(shown[["strain_axial", "stress_mpa"]].assign(what=specimen))
    for start, stop, dash in ((low, high, "-"), (high, end, ":")):
        stretch = np.linspace(1 + start, 1 + stop, 60)
        axes.plot(
            100 * (stretch - 1),
            stress(stretch),
            color=INK,
            linestyle=dash,
            linewidth=1.8,
            label=label if dash == "-" else None,
        )
        model = pd.DataFrame({"strain_axial": stretch - 1, "stress_mpa": stress(stretch)})
        parts.append(model.assign(what="model" if dash == "-" else "model, extrapolated"))
    if math.isfinite(published_c10_mpa):
        stretch = np.linspace(1 + low, 1 + high, 7)[1:]
        level = 2 * published_c10_mpa * (stretch - stretch**-2)
        label = tr("paper: C10 = {published_c10_mpa:g} MPa", published_c10_mpa=published_c10_mpa)
        axes.plot(100 * (stretch - 1), level, "s", ms=5.5, mfc=PAPER, mec=INK, label=label)
        published = pd.DataFrame({"strain_axial": stretch - 1, "stress_mpa": level})
        parts.append(published.assign(what="paper"))
    axes.set_xlim(left=100 * low)
    axes.set_ylim(bottom=0 if low >= 0 else None)
    axes.legend(loc="upper left" if low >= 0 else "lower right")
    columns = ["what", "strain_axial", "stress_mpa"]
    figure.data = pd.concat(parts, ignore_index=True)[columns]
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
        tr("C10 against strain range"), tr("upper end of the strain range [%]"), tr("C10 [MPa]")
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
    axes.plot([], [], "o", mfc="none", mec=GREY, ms=9, label=tr("on the card"))
    axes.set_xlim(left=0)
    axes.set_ylim(bottom=0)
    figure.legend(loc="outside lower center", ncols=2)
    columns = ["rubber", "strain_high", "c10_mpa", "standard_error_mpa", "in_card"]
    figure.data = ranges[columns]
    mark_synthetic(figure, synthetic)
    return figure
