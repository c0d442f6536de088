"""Figure of the single spoke: figure 13 of the paper."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from nptcs.language import tr, translatable
from nptcs.report.figures.style import MARKERS, line_sign, mark_synthetic, panel, styled
from nptcs.report.figures.theme import COLOURS, INK, PAPER
from nptcs.tables.tyres.spoke_stiffness import DIRECTIONS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

TRAVEL = {
    "tension": translatable("elongation [mm]"),
    "compression": translatable("shortening [mm]"),
}


@styled
def force_displacement(
    curves: pd.DataFrame, lines: pd.DataFrame, direction: str, synthetic: bool = False
) -> Figure:
    """Draw force against displacement for each C10, with the lines through the origin.

    Full lines are computed, dashed ones go through the origin; a hollow mark is where the line of
    table 10 ends.

    Parameters
    ----------
    curves : DataFrame
        Rows of ``spoke_curves.csv`` of one study and solver.
    lines : DataFrame
        The same of ``spoke_stiffness.csv``.
    direction : {"tension", "compression"}
        Half of the curves to draw.
    synthetic : bool
        Whether the materials are synthetic.
    """
    solver, stiffness = curves["solver"].iloc[0], f"{direction}_stiffness_n_per_mm"
    figure, axes = panel(
        tr("One spoke in {direction}, {solver}", direction=tr(direction), solver=solver),
        TRAVEL[direction],
        tr("force [N]"),
    )
    by_case = {line["case_id"]: line for line in lines.to_dict("records")}
    parts = []
    for number, (case_id, curve) in enumerate(curves.groupby("case_id", sort=False)):
        line = by_case[case_id]
        place = DIRECTIONS[direction] * curve["displacement_mm"]
        half = pd.DataFrame({"x": place, "f": DIRECTIONS[direction] * curve["force_n"]})
        half = half[half["x"] >= 0].sort_values("x")
        end = float(half["x"].max())
        colour = COLOURS[number % len(COLOURS)]
        marker = MARKERS[number % len(MARKERS)]
        axes.plot(
            half["x"],
            half["f"],
            color=colour,
            marker=marker,
            markevery=max(len(half) // 5, 1),
            label=f"{line['spoke_c10_mpa']:g}",
        )
        axes.plot([0, end], [0, end * line[stiffness]], color=colour, linestyle="--", linewidth=0.9)
        if np.isfinite(line[f"published_{stiffness}"]):
            axes.plot(
                [end],
                [end * line[f"published_{stiffness}"]],
                marker,
                mfc=PAPER,
                mec=colour,
                ms=8,
                clip_on=False,
            )
        parts.append(
            pd.DataFrame(
                {
                    "case_id": case_id,
                    "spoke_c10_mpa": line["spoke_c10_mpa"],
                    "displacement_mm": DIRECTIONS[direction] * half["x"],
                    "force_n": DIRECTIONS[direction] * half["f"],
                    stiffness: line[stiffness],
                    f"published_{stiffness}": line[f"published_{stiffness}"],
                }
            )
        )
    figure.data = pd.concat(parts, ignore_index=True)
    axes.set_xlim(left=0)
    axes.set_ylim(bottom=0)
    axes.legend(title=tr("spoke C10 [MPa]"), ncols=2, loc="upper left")
    kinds = [
        line_sign(tr("computed"), color=INK),
        line_sign(tr("line through origin"), color=INK, linestyle="--", linewidth=0.9),
    ]
    if lines[f"published_{stiffness}"].notna().any():
        end_of_line = tr("paper, end of table 10's line")
        kinds.append(line_sign(end_of_line, linestyle="", marker="o", mfc="none", mec=INK))
    figure.legend(handles=kinds, ncols=2, loc="outside lower center")
    mark_synthetic(figure, synthetic)
    return figure
