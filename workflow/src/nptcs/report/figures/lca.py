"""Figures of the load-bearing model: figures 14 and 15 and table 11 of the paper."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd

from nptcs.language import tr, translatable
from nptcs.report.figures.style import (
    HATCHES,
    line_look,
    line_sign,
    mark_synthetic,
    panel,
    styled,
)
from nptcs.report.figures.theme import COLOURS, GREY, INK, PAPER, RANGE

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from nptcs.report.figures.layout import Chart

SECTION_NAMES = {
    "sandwich": translatable("sandwich section"),
    "printed": translatable("section as printed"),
}
DIFFERENCES = {
    "theta_c_difference_percent": translatable("contact angle θc"),
    "theta_t_difference_percent": translatable("transition angle θt"),
    "displacement_difference_percent": translatable("displacement δ"),
}
CONTACT = {
    "contact_length_mm": translatable("contact length [mm]"),
    "mean_pressure_mpa": translatable("mean contact pressure [MPa]"),
}
REGIONS = {
    "contact": (COLOURS[1], "-"),
    "compression": (COLOURS[4], (0, (4, 1))),
    "tension": (COLOURS[0], "-"),
}
"""Colour and dash of the regions of the load-bearing model."""

LOAD = translatable("vertical load [N]")
RING_MARKS = 60
"""Points of a finite element ring that are marked; the figure's numbers contain all points."""


def _section_panel(table: pd.DataFrame, x_label: str, y_label: str) -> tuple[Chart, Axes]:
    """Make a panel titled with the section of the band to which its rows belong."""
    return panel(f"LCA, {tr(SECTION_NAMES[table['section'].iloc[0]])}", x_label, y_label)


def _line_per_rubber(axes: Axes, table: pd.DataFrame, rubber: str, x: str, y: str) -> None:
    """Draw one column against another, one line per C10 in the column `rubber`."""
    for number, (c10, rows) in enumerate(table.groupby(rubber)):
        rows = rows.sort_values(x)
        axes.plot(rows[x], rows[y], label=f"{c10:g}", **line_look(number))


def _rubber_legend(axes: Axes) -> None:
    """Start the axis at zero and name the lines by the spokes' rubber."""
    axes.set_ylim(bottom=0)
    axes.legend(title=tr("spoke C10 [MPa]"), ncols=2)


@styled
def load_displacement(
    table: pd.DataFrame, finite_elements: pd.DataFrame, synthetic: bool = False
) -> Figure:
    """Draw the displacement against the load by finite elements and by our LCA, figure 15.

    Full lines are our load-bearing model, filled marks our finite elements, hollow ones the
    paper's finite elements, crosses the paper's model.

    Parameters
    ----------
    table : DataFrame
        Rows of ``lca_validation.csv`` of one section.
    finite_elements : DataFrame
        Rows of ``displacement_by_load.csv`` of one solver; may be empty.
    synthetic : bool
        Whether the ply of the finite elements is synthetic.
    """
    first = finite_elements["solver"].iloc[:1]
    solver = "".join(tr(" and {solver}", solver=name) for name in first)
    title = f"LCA, {tr(SECTION_NAMES[table['section'].iloc[0]])},{solver}"
    figure, axes = panel(title.rstrip(","), LOAD, tr("displacement [mm]"), (4.3, 3.7))
    printed: dict[str, Any] = {"mfc": "none", "mec": INK, "linestyle": "", "zorder": 6}
    for number, (c10, rows) in enumerate(table.groupby("spoke_c10_mpa")):
        look, rows = line_look(number), rows.sort_values("load_n")
        fe = finite_elements[finite_elements["spoke_c10_mpa"] == c10].sort_values("load_n")
        axes.plot(rows["load_n"], rows["displacement_mm"], color=look["color"], label=f"{c10:g}")
        axes.plot(fe["load_n"], fe["displacement_mm"], linestyle="", ms=6, **look)
        axes.plot(rows["load_n"], rows["published_displacement_mm"], "x", ms=8, mew=1.4, mec=INK)
        fem = rows["load_n"] / rows["published_fem_stiffness_n_per_mm"]
        axes.plot(rows["load_n"], fem, **printed, marker=look["marker"], ms=9)
    axes.set_ylim(bottom=0)
    axes.legend(title=tr("spoke C10 (S-C) [MPa]"), ncols=3, loc="upper left")
    kinds = [
        line_sign(tr("our LCA"), color=INK),
        line_sign(tr("our FE"), color=INK, linestyle="", marker="o"),
        line_sign(tr("paper, LCA"), color=INK, linestyle="", marker="x"),
        line_sign(tr("paper, FEM"), color=INK, linestyle="", marker="o", mfc="none", ms=8),
    ]
    figure.legend(handles=kinds, ncols=4, loc="outside lower center", columnspacing=1.2)
    figure.data = _loads(table, finite_elements)
    mark_synthetic(figure, not finite_elements.empty and synthetic)
    return figure


def _loads(table: pd.DataFrame, finite_elements: pd.DataFrame) -> pd.DataFrame:
    """Join the rows of both tables by spoke rubber and load."""
    keys = ["spoke_c10_mpa", "load_n"]
    ours = table[[*keys, "displacement_mm", "published_displacement_mm"]].rename(
        columns={
            "displacement_mm": "lca_displacement_mm",
            "published_displacement_mm": "published_lca_displacement_mm",
        }
    )
    named = {"displacement_mm": "fe_displacement_mm"}
    columns = [*keys, "solver", "displacement_mm", "published_fem_displacement_mm"]
    return ours.merge(finite_elements[columns].rename(columns=named), on=keys, how="left")


@styled
def load_errors(table: pd.DataFrame, synthetic: bool = False) -> Figure:
    """Draw how far model and finite elements differ at each load, and the paper's largest error.

    Parameters
    ----------
    table : DataFrame
        Rows of ``displacement_by_load.csv`` of one solver.
    synthetic : bool
        Whether the ply is synthetic.
    """
    title = tr("Difference, LCA and {solver}", solver=table["solver"].iloc[0])
    figure, axes = panel(title, LOAD, tr("size of the difference in stiffness [%]"))
    for number, (c10, rows) in enumerate(table.groupby("spoke_c10_mpa")):
        rows = rows.sort_values("load_n")
        size = rows["lca_difference_percent"].abs()
        axes.plot(rows["load_n"], size, label=f"{c10:g}", **line_look(number))
    printed = table.drop_duplicates("load_n").sort_values("load_n")
    error = printed["published_largest_error_percent"]
    axes.plot(printed["load_n"], error, "_", color=INK, ms=22, mew=1.6, label=tr("paper, largest"))
    axes.set_ylim(bottom=0)
    figure.legend(title=tr("spoke C10 (S-C) [MPa]"), ncols=3, loc="outside lower center")
    figure.data = table[
        [
            "solver",
            "spoke_c10_mpa",
            "load_n",
            "lca_difference_percent",
            "published_largest_error_percent",
        ]
    ]
    mark_synthetic(figure, synthetic)
    return figure


@styled
def contact_against_load(table: pd.DataFrame, column: str) -> Figure:
    """Draw the contact length or the mean contact pressure against the load.

    Parameters
    ----------
    table : DataFrame
        Rows of ``lca_validation.csv`` of one section.
    column : str
        A key of `CONTACT`.
    """
    figure, axes = _section_panel(table, LOAD, CONTACT[column])
    _line_per_rubber(axes, table, "spoke_c10_mpa", "load_n", column)
    _rubber_legend(axes)
    figure.data = table[["section", "spoke_c10_mpa", "load_n", column]]
    return figure


@styled
def differences(table: pd.DataFrame, limit: float) -> Figure:
    """Draw the differences from table 11 of one section, a group of bars for each spoke rubber.

    Parameters
    ----------
    table : DataFrame
        Rows of ``lca_validation.csv`` of one section that have printed values.
    limit : float
        Largest difference on the axis, in percent, the same for all sections.
    """
    figure, axes = _section_panel(table, tr("spoke C10 [MPa]"), tr("computed − published [%]"))
    series = {tr(label): table[column].to_numpy() for column, label in DIFFERENCES.items()}
    _grouped_bars(axes, [f"{c10:g}" for c10 in table["spoke_c10_mpa"]], series)
    axes.axhline(0, color=INK, linewidth=0.8)
    axes.axhspan(-1, 1, color=RANGE, zorder=0, label=tr("within 1 %"))
    axes.set_ylim(-limit, limit)
    figure.legend(loc="outside lower left", ncols=2)
    figure.data = table[["section", "spoke_c10_mpa", "load_n", *DIFFERENCES]]
    return figure


@styled
def stiffness_bars(table: pd.DataFrame) -> Figure:
    """Draw the stiffness of table 11's designs: FEM, the paper's LCA, and ours by section.

    Parameters
    ----------
    table : DataFrame
        Rows of ``lca_validation.csv`` that have printed values.
    """
    figure, axes = panel(
        tr("LCA against FEM, table 11"),
        tr("spoke C10 [MPa]"),
        tr("vertical stiffness [N/mm]"),
        (4.3, 3.7),
    )
    groups = {section: rows for section, rows in table.groupby("section", sort=False)}
    first = next(iter(groups.values()))
    series = {
        tr("FEM, paper"): first["published_fem_stiffness_n_per_mm"].to_numpy(),
        tr("LCA, paper"): first["published_stiffness_n_per_mm"].to_numpy(),
    }
    for section, rows in groups.items():
        name = tr("LCA, computed, {section}", section=tr(SECTION_NAMES[str(section)]))
        series[name] = rows["stiffness_n_per_mm"].to_numpy()
    _grouped_bars(axes, [f"{c10:g}" for c10 in first["spoke_c10_mpa"]], series)
    figure.legend(loc="outside lower left", ncols=2)
    shown = ["stiffness_n_per_mm", "published_stiffness_n_per_mm"]
    figure.data = table[
        ["section", "spoke_c10_mpa", "load_n", *shown, "published_fem_stiffness_n_per_mm"]
    ]
    return figure


@styled
def fem_differences(table: pd.DataFrame, limit: float) -> Figure:
    """Draw the difference of the stiffness from table 7's FE values, a line for each band rubber.

    Parameters
    ----------
    table : DataFrame
        Rows of ``lca_against_fem.csv`` of one section.
    limit : float
        Largest difference on the axis, in percent, the same for all sections.
    """
    figure, axes = _section_panel(table, tr("spoke C10 [MPa]"), tr("LCA − FEM, stiffness [%]"))
    _line_per_rubber(axes, table, "shear_band_c10_mpa", "spoke_c10_mpa", "fem_difference_percent")
    axes.axhline(0, color=INK, linewidth=0.8)
    axes.set_ylim(-limit, limit)
    figure.legend(title=tr("shear band C10 [MPa]"), ncols=5, loc="outside lower center")
    keys = ["section", "shear_band_c10_mpa", "spoke_c10_mpa", "load_n"]
    figure.data = table[[*keys, "fem_difference_percent"]]
    return figure


def _grouped_bars(axes: Axes, groups: Sequence[str], series: dict[str, np.ndarray]) -> None:
    """Draw one bar for each series in each group."""
    width = 0.8 / len(series)
    place = np.arange(len(groups), dtype=float)
    for number, (label, values) in enumerate(series.items()):
        axes.bar(
            place + width * (number - (len(series) - 1) / 2),
            values,
            width,
            color=COLOURS[number % len(COLOURS)],
            hatch=HATCHES[number % len(HATCHES)],
            edgecolor=PAPER,
            label=label,
        )
    axes.set_xticks(place, list(groups))
    axes.grid(visible=False, axis="x")


@styled
def deformed_ring(
    line: pd.DataFrame,
    rim_diameter_mm: float,
    finite_elements: pd.DataFrame,
    synthetic: bool = False,
) -> Figure:
    """Draw the deformed middle line of the band by LCA and by finite elements, figure 14.

    Displacements are to scale. Those of the finite elements, which follow the middle between the
    wire layers, are drawn from the same undeformed circle as those of the model.

    Parameters
    ----------
    line : DataFrame
        Rows of ``lca_neutral_line.csv`` of one design, in the order of the angle.
    rim_diameter_mm : float
        For the rim, drawn to show the scale.
    finite_elements : DataFrame
        Rows of ``neutral_line.csv`` of one FE solver and the case of this design; may be empty.
    synthetic : bool
        Whether the ply of the finite elements is synthetic.
    """
    first = line.iloc[0]
    title = tr(
        "Ring at {load_n:g} N, spoke C10 {spoke_c10_mpa:g} MPa",
        load_n=first["load_n"],
        spoke_c10_mpa=first["spoke_c10_mpa"],
    )
    figure, axes = panel(title, "x [mm]", "y [mm]", (4.3, 4.7))
    axes.plot(
        line["x_undeformed_mm"],
        line["y_undeformed_mm"],
        color=GREY,
        linestyle="--",
        linewidth=0.9,
        label=tr("undeformed"),
    )
    for region, (colour, dash) in REGIONS.items():
        inside = (line["region"] == region).to_numpy()
        # a gap where the line leaves the region, so that arcs are not joined across it
        axes.plot(
            line["x_mm"].where(inside),
            line["y_mm"].where(inside),
            color=colour,
            linewidth=2.2,
            linestyle=dash,
            label=f"LCA, {tr(region)}",
        )
    turn = np.linspace(0, 2 * np.pi, 181)
    rim = rim_diameter_mm / 2
    axes.plot(rim * np.cos(turn), rim * np.sin(turn), color=GREY, linewidth=0.7, label=tr("rim"))
    parts = [line[["x_mm", "y_mm"]].assign(what="LCA", theta_deg=line["theta_deg"])]
    if not finite_elements.empty:
        radius = float(np.hypot(first["x_undeformed_mm"], first["y_undeformed_mm"]))
        points = on_circle(finite_elements, radius)
        solver = finite_elements["solver"].iloc[0]
        few = points.iloc[:: max(len(points) // RING_MARKS, 1)]
        look: dict[str, Any] = {"marker": "o", "ms": 4.5, "mfc": "none", "mec": INK, "mew": 0.9}
        axes.plot(few["x_mm"], few["y_mm"], linestyle="", zorder=5, label=solver, **look)
        parts.append(points.assign(what=solver))
    axes.axhline(line["y_mm"].min(), color=INK, linewidth=0.8)
    axes.set_aspect("equal")
    axes.legend(loc="center")
    figure.data = pd.concat(parts)[["what", "theta_deg", "x_mm", "y_mm"]]
    mark_synthetic(figure, synthetic and not finite_elements.empty)
    return figure


def on_circle(line: pd.DataFrame, radius_mm: float) -> pd.DataFrame:
    """Place displacements of a neutral line on a circle about the hub, y up (mm)."""
    angle = np.radians(line["theta_deg"])
    out, along = radius_mm + line["radial_mm"], line["tangential_mm"]
    x = out * np.sin(angle) + along * np.cos(angle)
    y = -out * np.cos(angle) + along * np.sin(angle)
    return pd.DataFrame({"theta_deg": line["theta_deg"], "x_mm": x, "y_mm": y})
