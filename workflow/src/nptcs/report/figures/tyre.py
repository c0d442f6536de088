"""Figures of the solved tyres: figure 10 of the paper."""

from __future__ import annotations

import pandas as pd
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from nptcs.language import tr
from nptcs.report.figures.style import (
    DASHES,
    MARKERS,
    line_look,
    mark_synthetic,
    note_sampled,
    panel,
    sampled,
    styled,
)
from nptcs.report.figures.theme import COLOURS, GREY, INK

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
    looks = {stiffness.idxmax(): (COLOURS[1], "s"), stiffness.idxmin(): (COLOURS[0], "o")}
    drawn = {*sampled(ends)["case_id"], *looks}
    for name in drawn - set(looks):
        curve = cases[name]
        axes.plot(
            curve["displacement_mm"], curve["force_n"] / 1000, color=GREY, linewidth=0.6, alpha=0.6
        )
    for name, (colour, marker) in looks.items():
        curve = cases[str(name)]
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
    axes.axhline(PUBLISHED_STRESS_MPA, color=INK, linestyle="--", linewidth=0.9)
    axes.set_ylim(bottom=0)
    figure.data = rows.drop(columns=["study", "along_mpa", "across_mpa", "shear_mpa"])
    handles, _ = axes.get_legend_handles_labels()
    handles += [
        Line2D([], [], linestyle="", marker="o", mfc="none", mec=INK, label=tr("element mean")),
        Line2D([], [], color=INK, linestyle="--", linewidth=0.9, label=tr("paper, largest")),
    ]
    figure.legend(handles=handles, ncols=2, loc="outside lower center")
    mark_synthetic(figure, synthetic)
    return figure
