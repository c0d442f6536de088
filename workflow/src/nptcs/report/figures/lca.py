"""Figures of the load-bearing model: figures 14 and 15 and table 11 of the paper."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from nptcs.report.figures.style import COLOURS, GREY, line_look, panel, styled

SECTION_NAMES = {"sandwich": "sandwich section", "printed": "section as printed"}
DIFFERENCES = {
    "theta_c_difference_percent": "contact angle θc",
    "theta_t_difference_percent": "transition angle θt",
    "displacement_difference_percent": "displacement δ",
}
CONTACT = {
    "contact_length_mm": "contact length [mm]",
    "mean_pressure_mpa": "mean contact pressure [MPa]",
}
REGION_COLOURS = {"contact": COLOURS[1], "compression": COLOURS[4], "tension": COLOURS[0]}
HATCHES = ("", "//", "..", "xx")


def _section_panel(table: pd.DataFrame, x_label: str, y_label: str) -> tuple[Figure, Axes]:
    """Make a panel titled with the section of the band to which its rows belong."""
    return panel(f"Our LCA, {SECTION_NAMES[table['section'].iloc[0]]}", x_label, y_label)


def _line_per_rubber(axes: Axes, table: pd.DataFrame, rubber: str, x: str, y: str) -> None:
    """Draw one column against another, one line per C10 in the column `rubber`."""
    for number, (c10, rows) in enumerate(table.groupby(rubber)):
        rows = rows.sort_values(x)
        axes.plot(rows[x], rows[y], label=f"{c10:g}", **line_look(number))


def _rubber_legend(axes: Axes) -> None:
    """Begin the axis at zero and name the lines by the spokes' rubber."""
    axes.set_ylim(bottom=0)
    axes.legend(title="spoke C10 [MPa]", title_fontsize=8, ncols=2)


@styled
def load_displacement(table: pd.DataFrame) -> Figure:
    """Draw the displacement against the load, a line for each spoke rubber, figure 15.

    Hollow marks are the displacements that table 11 prints.

    Parameters
    ----------
    table : DataFrame
        Rows of ``lca_validation.csv`` of one section.
    """
    figure, axes = _section_panel(table, "vertical load [N]", "displacement [mm]")
    _line_per_rubber(axes, table, "spoke_c10_mpa", "load_n", "displacement_mm")
    published = table["published_displacement_mm"]
    axes.plot(table["load_n"], published, "o", mfc="none", mec="black", ms=9, label="_published")
    axes.plot([], [], "o", mfc="none", mec="black", ms=8, label="printed")
    _rubber_legend(axes)
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
    figure, axes = _section_panel(table, "vertical load [N]", CONTACT[column])
    _line_per_rubber(axes, table, "spoke_c10_mpa", "load_n", column)
    _rubber_legend(axes)
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
    figure, axes = _section_panel(table, "spoke C10 [MPa]", "computed − published [%]")
    series = {label: table[column].to_numpy() for column, label in DIFFERENCES.items()}
    _grouped_bars(axes, [f"{c10:g}" for c10 in table["spoke_c10_mpa"]], series)
    axes.axhline(0, color="black", linewidth=0.8)
    axes.axhspan(-1, 1, color="#f1f1f1", zorder=0, label="within 1 %")
    axes.set_ylim(-limit, limit)
    figure.legend(loc="outside lower left", ncols=2)
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
        "LCA against FEM, table 11", "spoke C10 [MPa]", "vertical stiffness [N/mm]", (4.3, 3.7)
    )
    groups = {section: rows for section, rows in table.groupby("section", sort=False)}
    first = next(iter(groups.values()))
    series = {
        "FEM, paper": first["published_fem_stiffness_n_per_mm"].to_numpy(),
        "LCA, paper": first["published_stiffness_n_per_mm"].to_numpy(),
    }
    for section, rows in groups.items():
        name = f"LCA, computed, {SECTION_NAMES[str(section)]}"
        series[name] = rows["stiffness_n_per_mm"].to_numpy()
    _grouped_bars(axes, [f"{c10:g}" for c10 in first["spoke_c10_mpa"]], series)
    figure.legend(loc="outside lower left", ncols=2)
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
    figure, axes = _section_panel(table, "spoke C10 [MPa]", "LCA − FEM, stiffness [%]")
    _line_per_rubber(axes, table, "shear_band_c10_mpa", "spoke_c10_mpa", "fem_difference_percent")
    axes.axhline(0, color="black", linewidth=0.8)
    axes.set_ylim(-limit, limit)
    figure.legend(
        title="shear band C10 [MPa]", title_fontsize=8, ncols=5, loc="outside lower center"
    )
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
            edgecolor="white",
            label=label,
        )
    axes.set_xticks(place, list(groups))
    axes.grid(visible=False, axis="x")


@styled
def deformed_ring(line: pd.DataFrame, rim_diameter_mm: float) -> Figure:
    """Draw the deformed middle line of the band over the undeformed one, figure 14.

    Parameters
    ----------
    line : DataFrame
        Rows of ``lca_neutral_line.csv`` of one design, in the order of the angle.
    rim_diameter_mm : float
        For the rim, drawn to show the scale.
    """
    first = line.iloc[0]
    title = f"spoke C10 {first['spoke_c10_mpa']:g} MPa, {first['load_n']:g} N, {first['section']}"
    figure, axes = panel(title, "x [mm]", "y [mm]", (4.3, 4.4))
    axes.plot(
        line["x_undeformed_mm"],
        line["y_undeformed_mm"],
        color=GREY,
        linestyle="--",
        linewidth=0.9,
        label="undeformed",
    )
    for region, colour in REGION_COLOURS.items():
        inside = (line["region"] == region).to_numpy()
        # a gap where the line leaves the region, so that arcs are not joined across it
        axes.plot(
            line["x_mm"].where(inside),
            line["y_mm"].where(inside),
            color=colour,
            linewidth=2.2,
            label=region,
        )
    turn = np.linspace(0, 2 * np.pi, 181)
    axes.plot(
        rim_diameter_mm / 2 * np.cos(turn),
        rim_diameter_mm / 2 * np.sin(turn),
        color=GREY,
        linewidth=0.7,
        label="rim",
    )
    axes.axhline(line["y_mm"].min(), color="black", linewidth=0.8)
    axes.set_aspect("equal")
    axes.legend(loc="center")
    return figure
