"""Figures of the solved tyres: figure 10 of the paper."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd

from nptcs.compare.conditions import PAPER_LOAD_N
from nptcs.language import tr
from nptcs.report.figures.style import (
    DASHES,
    MARKERS,
    line_look,
    line_sign,
    mark_synthetic,
    note_sampled,
    panel,
    sampled,
    styled,
)
from nptcs.report.figures.theme import COLOURS, GREY, INK, RANGE

if TYPE_CHECKING:
    from matplotlib.figure import Figure

WINDOW_MM = 110.0
"""Half the width of the drawn surroundings of the contact."""

PUBLISHED_STRESS_MPA = 89.5
"""Largest stress of a reinforcing plate at 5000 N, section 4.1 of the paper."""


@styled
def load_displacement(
    curves: pd.DataFrame, published: pd.DataFrame, title: str, synthetic: bool = False
) -> Figure:
    """Draw load against displacement of all tyres, figure 10 b of the paper.

    The softest and the stiffest tyre have their names and their secant stiffness at the end;
    crosses are the paper's values at its load.

    Parameters
    ----------
    curves : DataFrame
        Rows of ``tyre_curves.csv`` of one study and solver.
    published : DataFrame
        ``case_id, load_n, displacement_mm`` of the same cases as published; may be empty.
    title : str
    synthetic : bool
        Whether the materials are synthetic.
    """
    figure, axes = panel(title, tr("vertical displacement [mm]"), tr("vertical load [kN]"))
    cases = {str(name): curve for name, curve in curves.groupby("case_id", sort=False)}
    ends = pd.DataFrame({name: curve.iloc[-1] for name, curve in cases.items()}).T
    stiffness = ends["force_n"].astype(float) / ends["displacement_mm"].astype(float)
    looks = {
        str(stiffness.idxmax()): (COLOURS[1], "s"),
        str(stiffness.idxmin()): (COLOURS[0], "o"),
    }
    drawn = {*sampled(ends)["case_id"], *looks}
    for name, curve in cases.items():
        if name not in drawn or name in looks:
            continue
        axes.plot(
            curve["displacement_mm"], curve["force_n"] / 1000, color=GREY, linewidth=0.6, alpha=0.6
        )
    for name, (colour, marker) in looks.items():
        curve = cases[name]
        axes.plot(
            curve["displacement_mm"],
            curve["force_n"] / 1000,
            color=colour,
            marker=marker,
            markevery=max(len(curve) // 10, 1),
            label=f"{name}: {stiffness[name]:.0f} N/mm",
            zorder=3,
        )
    printed = published[published["case_id"].isin(drawn)]
    if not printed.empty:
        axes.plot(
            printed["displacement_mm"],
            printed["load_n"] / 1000,
            "x",
            color=INK,
            ms=5,
            zorder=4,
            label=tr("paper, FEM"),
        )
    note_sampled(axes, len(drawn), len(cases), tr("tyres"))
    axes.set_xlim(left=0)
    axes.set_ylim(bottom=0)
    figure.legend(loc="outside lower center", ncols=2)
    columns = ["case_id", "displacement_mm", "force_n"]
    figure.data = curves.loc[curves["case_id"].isin(drawn), columns]
    mark_synthetic(figure, synthetic)
    return figure


@styled
def deformed_tyre(
    outlines: pd.DataFrame, title: str, near: bool, synthetic: bool = False
) -> Figure:
    """Draw the outlines of a loaded tyre, figure 10 a of the paper.

    Parameters
    ----------
    outlines : DataFrame
        Rows of ``deformed_tyre.csv``.
    title : str
    near : bool
        Whether only the surroundings of the contact are drawn, with the undeformed outlines.
    synthetic : bool
        Whether the materials are synthetic.
    """
    from matplotlib.collections import PolyCollection
    from matplotlib.patches import Patch

    figure, axes = panel(title, "x [mm]", "y [mm]", (4.3, 3.9 if near else 5.2))
    ground, solver = float(outlines["y_mm"].min()), str(outlines["solver"].iloc[0])
    if near:
        around = outlines["x_mm"].abs().lt(WINDOW_MM) & outlines["y_mm"].lt(ground + WINDOW_MM)
        kept = outlines.loc[around, "outline"].unique()
        outlines = outlines[outlines["outline"].isin(kept)]
        axes.set_xlim(-WINDOW_MM, WINDOW_MM)
        axes.set_ylim(ground - 5, ground + 1.25 * WINDOW_MM)
    looks: dict[str, dict[str, Any]] = {
        "spoke": {"facecolor": RANGE, "edgecolor": GREY, "linewidth": 0.5},
        "plate": {"facecolor": COLOURS[1], "edgecolor": "none"},
        "band": {"facecolor": "none", "edgecolor": COLOURS[0], "linewidth": 1.3},
        "rim": {"facecolor": "none", "edgecolor": INK, "linewidth": 0.9},
    }
    for part, look in looks.items():
        rows = outlines[outlines["part"] == part]
        lines = [line[["x_mm", "y_mm"]].to_numpy() for _, line in rows.groupby("outline")]
        axes.add_collection(PolyCollection(lines, zorder=2, **look))
        if near and part in ("spoke", "band"):
            columns = ["x_undeformed_mm", "y_undeformed_mm"]
            before = [line[columns].to_numpy() for _, line in rows.groupby("outline")]
            dotted: dict[str, Any] = {"edgecolor": GREY, "linewidth": 0.6, "linestyle": ":"}
            axes.add_collection(PolyCollection(before, facecolor="none", zorder=1, **dotted))
    axes.axhline(ground, color=INK, linewidth=0.8)
    axes.set_aspect("equal")
    if not near:
        axes.autoscale_view()
    axes.grid(visible=False)
    handles = [
        Patch(fc=RANGE, ec=GREY, label=tr("rubber of a spoke")),
        Patch(fc=COLOURS[1], label=tr("plates of a spoke")),
        line_sign(tr("band and tread"), color=COLOURS[0]),
        line_sign(tr("rim, ground"), color=INK),
    ]
    if near:
        handles.append(line_sign(tr("before loading"), color=GREY, linestyle=":"))
    figure.legend(handles=handles, title=solver, ncols=3, loc="outside lower center")
    places = ["x_mm", "y_mm", *(["x_undeformed_mm", "y_undeformed_mm"] if near else [])]
    figure.data = outlines[["part", "outline", *places]].round(dict.fromkeys(places, 2))
    mark_synthetic(figure, synthetic)
    return figure


@styled
def plate_faces(stress: pd.DataFrame, title: str, synthetic: bool = False) -> Figure:
    """Draw the in-plane von Mises stress at the plates' faces along the height of a spoke.

    Parameters
    ----------
    stress : DataFrame
        Rows of ``plate_stress.csv`` of one case and solver: the spoke with the largest stress is
        drawn. Full lines are values at the elements' centres, hollow marks element means.
    title : str
    synthetic : bool
        Whether the materials are synthetic.
    """
    height = tr("height above the rim [mm], at {load_n:g} N", load_n=stress["load_n"].iloc[0])
    figure, axes = panel(title, height, tr("von Mises stress at a face [MPa]"))
    worst = stress["spoke"].to_numpy()[int(stress["mises_mpa"].argmax())]
    rows = stress[stress["spoke"] == worst].sort_values("height_mm")
    for number in (0, 1):
        face = rows[rows["face"] == number]
        colour, marker = COLOURS[number], MARKERS[number]
        for leg in (0, 1):
            half = face[face["leg"] == leg]
            label = tr("ply {ply_deg:+g}°", ply_deg=half["ply_deg"].iloc[0]) if leg == 0 else None
            place = half["height_mm"]
            look = {**line_look(number), "linestyle": DASHES[number]}
            axes.plot(place, half["mises_mpa"], label=label, **look)
            axes.plot(place, half["mean_mises_mpa"], marker, ms=8, mfc="none", mec=colour)
    compared = bool(np.isclose(stress["load_n"].iloc[0], PAPER_LOAD_N))
    if compared:
        axes.axhline(PUBLISHED_STRESS_MPA, color=INK, linestyle="--", linewidth=0.9)
    axes.set_ylim(bottom=0)
    figure.data = rows.drop(columns=["study", "along_mpa", "across_mpa", "shear_mpa"])
    handles, _ = axes.get_legend_handles_labels()
    mean: dict[str, Any] = {"linestyle": "", "marker": "o", "mfc": "none", "mec": INK}
    handles.append(line_sign(tr("element mean"), **mean))
    if compared:
        largest: dict[str, Any] = {"color": INK, "linestyle": "--", "linewidth": 0.9}
        handles.append(line_sign(tr("paper, largest"), **largest))
    figure.legend(handles=handles, ncols=2, loc="outside lower center")
    mark_synthetic(figure, synthetic)
    return figure
