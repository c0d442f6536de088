"""Section of the report on the load-bearing model against the published numbers."""

from __future__ import annotations

import math

import pandas as pd

from nptcs.report.blocks import PageBlock, Plot, Plots, Section, Text
from nptcs.report.data import Results
from nptcs.report.figures.lca import (
    CONTACT,
    DIFFERENCES,
    contact_against_load,
    deformed_ring,
    differences,
    fem_differences,
    load_displacement,
    stiffness_bars,
)
from nptcs.report.plots import plot
from nptcs.report.sections.key_facts import lca_facts
from nptcs.report.table_view import sheet_view
from nptcs.report.tables.sheets import Sheets, sheet_of
from nptcs.tables.lca_validation import LcaAgainstFem, LcaNeutralLine, LcaValidation
from nptcs.tables.result_table import ReportSection


def lca_section(results: Results, sheets: Sheets) -> Section:
    """Build the section."""
    blocks: list[PageBlock] = [
        Text(
            "The model is solved with the spoke stiffness of table 10. The section constants that "
            "the paper prints are those of another bending axis. Both sections are shown here, the "
            "sandwich section and the one as printed, each next to the printed results of table "
            f"11 (shear band C10 = {results.config.lca_validation.shear_band_c10_mpa:g} MPa)."
        ),
        *lca_facts(results),
        Plots(
            "Differences from the printed angles and displacements of table 11. The grey band is "
            "1 %; the scale is the same for both sections.",
            tuple(_difference_plots(results)),
        ),
        Plots(
            "Vertical stiffness of table 11's designs, and displacement against load at the loads "
            "of figure 15. The paper draws figure 15 as curves without numbers, so that printed "
            "values exist at table 11's load only.",
            (_stiffness_plot(results), *_load_plots(results)),
        ),
        Plots(
            "Difference of the stiffness from the FE values of table 7, on the same scale.",
            tuple(_fem_plots(results)),
        ),
        sheet_view(sheet_of(sheets, LcaValidation)),
        sheet_view(sheet_of(sheets, LcaAgainstFem)),
        Plots(
            "Deformed middle line of the shear band by region (figure 14 of the paper). "
            "Displacements are to scale; the rim is drawn for orientation.",
            tuple(_neutral_line_plots(results)),
        ),
    ]
    return Section(ReportSection.LCA, "Load-bearing model (LCA) against the paper", tuple(blocks))


def _difference_plots(results: Results) -> list[Plot]:
    table = _with_published(results)
    largest = float(table[list(DIFFERENCES)].abs().max().max())
    limit = math.ceil(largest + 0.5)
    return [
        plot(
            f"Differences from table 11 in percent, section {section}",
            False,
            differences,
            rows,
            limit,
        )
        for section, rows in table.groupby("section", sort=False)
    ]


def _fem_plots(results: Results) -> list[Plot]:
    table = results.table(LcaAgainstFem)
    limit = math.ceil(float(table["fem_difference_percent"].abs().max()) + 0.5)
    return [
        plot(f"Differences from table 7, section {section}", False, fem_differences, rows, limit)
        for section, rows in table.groupby("section", sort=False)
    ]


def _stiffness_plot(results: Results) -> Plot:
    alt = "Stiffness by FEM, printed LCA and our LCA"
    return plot(alt, False, stiffness_bars, _with_published(results))


def _load_plots(results: Results) -> list[Plot]:
    sections = [rows for _, rows in results.table(LcaValidation).groupby("section", sort=False)]
    plots = [
        plot(
            f"Displacement against load, section {rows['section'].iloc[0]}",
            False,
            load_displacement,
            rows,
        )
        for rows in sections
    ]
    return plots + [
        plot(f"{label} against load", False, contact_against_load, sections[0], column)
        for column, label in CONTACT.items()
    ]


def _neutral_line_plots(results: Results) -> list[Plot]:
    rim = results.config.tyre.rim_diameter_mm
    return [
        plot(
            f"Deformed ring at {load:g} N for spoke C10 of {c10:g} MPa",
            False,
            deformed_ring,
            rows,
            rim,
        )
        for (_, load, c10), rows in results.table(LcaNeutralLine).groupby(
            ["section", "load_n", "spoke_c10_mpa"], sort=False
        )
    ]


def _with_published(results: Results) -> pd.DataFrame:
    table = results.table(LcaValidation)
    return table[table["published_displacement_mm"].notna()]
