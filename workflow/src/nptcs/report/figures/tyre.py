"""Figures of the solved tyres: figure 10 of the paper."""

from __future__ import annotations

import pandas as pd
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from nptcs.report.figures.style import COLOURS, GREY, MARKERS, mark_synthetic, panel, styled

PUBLISHED_STRESS_MPA = 89.5
"""Largest stress of a reinforcing plate at 5000 N, section 4.1 of the paper."""


@styled
def load_displacement(curves: pd.DataFrame, title: str, synthetic: bool = False) -> Figure:
    """Draw load against displacement of all tyres, the softest and the stiffest with their names.

    Parameters
    ----------
    curves : DataFrame
        Rows of ``tyre_curves.csv`` of one study and solver.
    title : str
    synthetic : bool
        Whether the materials are synthetic.
    """
    figure, axes = panel(title, "vertical displacement [mm]", "vertical load [kN]")
    cases = {str(name): curve for name, curve in curves.groupby("case_id", sort=False)}
    ends = {name: curve.iloc[-1] for name, curve in cases.items()}
    stiffness = {name: end["force_n"] / end["displacement_mm"] for name, end in ends.items()}
    softest = min(stiffness, key=stiffness.__getitem__)
    stiffest = max(stiffness, key=stiffness.__getitem__)
    named = {stiffest: COLOURS[1], softest: COLOURS[0]}
    for name, curve in cases.items():
        place, load = curve["displacement_mm"], curve["force_n"] / 1000.0
        if name in named:
            label = f"{name}, {stiffness[name]:.0f} N/mm at the end"
            axes.plot(place, load, color=named[name], marker="o", label=label, zorder=3)
        else:
            axes.plot(place, load, color=GREY, linewidth=0.6, alpha=0.6)
    axes.set_xlim(left=0)
    axes.set_ylim(bottom=0)
    axes.legend(loc="lower right")
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
    height = f"height above the rim [mm], at {stress['load_n'].iloc[0]:g} N"
    figure, axes = panel(title, height, "von Mises stress at a face [MPa]")
    worst = stress["spoke"].to_numpy()[int(stress["mises_mpa"].argmax())]
    rows = stress[stress["spoke"] == worst].sort_values("height_mm")
    for number in (0, 1):
        face = rows[rows["face"] == number]
        colour, marker = COLOURS[number], MARKERS[number]
        for leg in (0, 1):
            half = face[face["leg"] == leg]
            label = f"ply {half['ply_deg'].iloc[0]:+g}°" if leg == 0 else None
            place = half["height_mm"]
            axes.plot(place, half["mises_mpa"], color=colour, marker=marker, label=label)
            axes.plot(place, half["mean_mises_mpa"], marker, ms=8, mfc="none", mec=colour)
    axes.axhline(PUBLISHED_STRESS_MPA, color="black", linestyle="--", linewidth=0.9)
    axes.set_ylim(bottom=0)
    handles, _ = axes.get_legend_handles_labels()
    handles += [
        Line2D([], [], linestyle="", marker="o", mfc="none", mec="black", label="element mean"),
        Line2D([], [], color="black", linestyle="--", linewidth=0.9, label="published largest"),
    ]
    figure.legend(handles=handles, ncols=2, loc="outside lower center")
    mark_synthetic(figure, synthetic)
    return figure
