"""Figures that compare computed with published results: tables 5 and 7, figure 14."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd

from nptcs.language import tr, translatable
from nptcs.report.factor_labels import FactorLabel
from nptcs.report.figures.style import (
    DASHES,
    line_look,
    mark_synthetic,
    note_sampled,
    panel,
    sampled,
    styled,
)
from nptcs.report.figures.theme import GREY, INK, PAPER
from nptcs.tables.published.stiffness import COMPUTED_STIFFNESS, PUBLISHED_STIFFNESS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

BANDS_PERCENT = {3.0: ":", 8.0: "--"}
"""Differences marked in the parity figure, and the dashes of their lines."""

DISPLACEMENTS = {
    "radial_mm": translatable("radial displacement, outward [mm]"),
    "tangential_mm": translatable("tangential displacement [mm]"),
}

MOST_NUMBERS = 1000
"""Rows of a table beyond which a figure carries only the numbers of its sample."""


def _look(solver: object, order: Sequence[str]) -> dict[str, Any]:
    """Give a solver the same colour and marker in all figures."""
    return {**line_look(list(order).index(str(solver))), "label": str(solver)}


def _finished(figure: Figure, synthetic: bool) -> Figure:
    """Put the legend below, and say so if the data are synthetic."""
    figure.legend(loc="outside lower center", ncols=3)
    mark_synthetic(figure, synthetic)
    return figure


@styled
def parity(
    table: pd.DataFrame, title: str, order: Sequence[str], synthetic: bool = False
) -> Figure:
    """Draw the computed stiffness against the published one, a mark for each solver.

    Cases that a solver was calibrated on are hollow.

    Parameters
    ----------
    table : DataFrame
        Rows of ``stiffness_against_published.csv`` of one study.
    title : str
        Name of the study.
    order : sequence of str
        All solvers of the run: a solver's place in this list gives its colour.
    synthetic : bool
        Whether the materials of any solver are synthetic.
    """
    figure, axes = panel(
        title, tr("published stiffness [N/mm]"), tr("computed stiffness [N/mm]"), (4.3, 4)
    )
    values = table[[COMPUTED_STIFFNESS, PUBLISHED_STIFFNESS]].to_numpy(float)
    ends = np.array([0.97 * np.nanmin(values), 1.03 * np.nanmax(values)])
    axes.plot(ends, ends, color=INK, linewidth=0.9, label=tr("equal"))
    for percent, dashes in BANDS_PERCENT.items():
        for sign in (-1, 1):
            edge = ends * (1 + sign * percent / 100)
            label = f"±{percent:g} %" if sign > 0 else "_other side"
            axes.plot(ends, edge, color=GREY, linestyle=dashes, linewidth=0.9, label=label)
    for (solver, calibrated), rows in table.groupby(["solver", "used_for_calibration"]):
        look = _look(solver, order)
        if calibrated:
            look |= {"mfc": "none", "label": tr("{solver}, calibrated on", solver=solver)}
        drawn = sampled(rows)
        axes.plot(drawn[PUBLISHED_STIFFNESS], drawn[COMPUTED_STIFFNESS], linestyle="", **look)
        note_sampled(axes, len(drawn), len(rows), tr("cases per solver"))
    axes.set(xlim=ends, ylim=ends)
    axes.set_aspect("equal")
    columns = ["case_id", "solver", "used_for_calibration", PUBLISHED_STIFFNESS, COMPUTED_STIFFNESS]
    figure.data = table[columns] if len(table) <= MOST_NUMBERS else sampled(table[columns])
    return _finished(figure, synthetic)


@styled
def main_effect(
    levels: pd.DataFrame, label: FactorLabel, order: Sequence[str], synthetic: bool = False
) -> Figure:
    """Draw the mean stiffness at each level of one factor, published and computed.

    Parameters
    ----------
    levels : DataFrame
        Rows of ``stiffness_by_level.csv`` of one study and factor.
    label : FactorLabel
        Label of the factor.
    order : sequence of str
        All solvers of the run: a solver's place gives its colour.
    synthetic : bool
        Whether the materials of any solver are synthetic.
    """
    figure, axes = panel(
        tr("Mean stiffness, study {study}", study=levels["study"].iloc[0]),
        str(label),
        tr("mean vertical stiffness [N/mm]"),
    )
    # solvers may have been compared over different cases: then each has its own published mean
    same = levels.groupby("level")["published_mean_n_per_mm"].nunique().max() == 1
    for number, (solver, rows) in enumerate(levels.groupby("solver")):
        look = _look(solver, order)
        if number == 0 or not same:
            axes.plot(
                rows["level"],
                rows["published_mean_n_per_mm"],
                color=INK if same else look["color"],
                marker="o",
                mfc=PAPER,
                linestyle="--",
                label=tr("published")
                if same
                else tr("published, cases of {solver}", solver=solver),
            )
        axes.plot(rows["level"], rows["computed_mean_n_per_mm"], **look)
    means = ["published_mean_n_per_mm", "computed_mean_n_per_mm"]
    figure.data = levels[["study", "factor", "level", "solver", *means]]
    return _finished(figure, synthetic)


@styled
def level_differences(
    levels: pd.DataFrame, label: FactorLabel, order: Sequence[str], synthetic: bool = False
) -> Figure:
    """Draw the mean difference at each level of one factor, its bars from lowest to highest.

    Parameters
    ----------
    levels, label, order, synthetic
        As in `main_effect`.
    """
    figure, axes = panel(
        tr("Difference, study {study}", study=levels["study"].iloc[0]),
        str(label),
        tr("computed − published [%]"),
    )
    groups = list(levels.groupby("solver"))
    reach = float(np.ptp(levels["level"])) or 1.0
    for number, (solver, rows) in enumerate(groups):
        mean = rows["mean_difference_percent"]
        axes.errorbar(
            # side by side, so that no bar hides another
            rows["level"] + 0.012 * reach * (2 * number - len(groups) + 1),
            mean,
            yerr=[
                (mean - rows["lowest_difference_percent"]).clip(lower=0),
                (rows["highest_difference_percent"] - mean).clip(lower=0),
            ],
            capsize=3,
            elinewidth=0.9,
            **_look(solver, order),
        )
    axes.axhline(0, color=INK, linewidth=0.8)
    ends = [f"{which}_difference_percent" for which in ("mean", "lowest", "highest")]
    figure.data = levels[["study", "factor", "level", "solver", *ends]]
    return _finished(figure, synthetic)


@styled
def neutral_lines(
    lines: pd.DataFrame, column: str, title: str, order: Sequence[str], synthetic: bool = False
) -> Figure:
    """Draw one displacement of the band's neutral line against the angle, one line per solver.

    Parameters
    ----------
    lines : DataFrame
        Rows of ``neutral_line.csv`` of one case.
    column : str
        A key of `DISPLACEMENTS`.
    title : str
        Name of the case.
    order : sequence of str
        All solvers of the run: a solver's place gives its colour.
    synthetic : bool
        Whether the materials of any solver are synthetic.
    """
    figure, axes = panel(title, tr("θ from the middle of the contact [°]"), DISPLACEMENTS[column])
    for number, (solver, rows) in enumerate(lines.groupby("solver")):
        look = _look(solver, order) | {"marker": "", "linestyle": DASHES[number % len(DASHES)]}
        axes.plot(rows["theta_deg"], rows[column], **look)
    axes.axhline(0, color=INK, linewidth=0.8)
    figure.data = lines[["case_id", "solver", "load_n", "theta_deg", column]]
    axes.set_xticks(np.arange(-180, 181, 60))
    axes.set_xlim(-180, 180)
    return _finished(figure, synthetic)
