"""Section of the report on the load-bearing model against the published numbers."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd

from nptcs.language import tr
from nptcs.report.blocks import PageBlock, Plot, Plots, Section, Text
from nptcs.report.data import Results
from nptcs.report.figures.lca import (
    CONTACT,
    DIFFERENCES,
    SECTION_NAMES,
    contact_against_load,
    deformed_ring,
    differences,
    fem_differences,
    load_displacement,
    load_errors,
    stiffness_bars,
)
from nptcs.report.plots import plot
from nptcs.report.sections.key_facts import lca_facts
from nptcs.report.table_view import sheet_view
from nptcs.report.tables.sheets import Sheets, sheet_of
from nptcs.responses.displacement_by_load import same_tyres
from nptcs.tables.published.lca_validation import LcaAgainstFem, LcaNeutralLine, LcaValidation
from nptcs.tables.result_table import ReportSection
from nptcs.tables.tyres.cases import Cases
from nptcs.tables.tyres.displacement_by_load import DisplacementByLoad
from nptcs.tables.tyres.neutral_line import NeutralLine


def lca_section(results: Results, sheets: Sheets) -> Section:
    """Build the section."""
    blocks: list[PageBlock] = [
        Text(
            tr(
                "The model is solved with the spoke stiffness of table 10. The section constants "
                "printed in the paper belong to another bending axis. Both sections are shown "
                "here, the sandwich section and the one as printed, each next to the printed "
                "results of table 11 (shear band C10 = {shear_band_c10_mpa:g} MPa).",
                shear_band_c10_mpa=results.config.lca_validation.shear_band_c10_mpa,
            )
        ),
        *lca_facts(results),
        Plots(
            tr(
                "Differences from the printed angles and displacements of table 11. The "
                "grey band is 1 %; the scale is the same for both sections."
            ),
            tuple(_difference_plots(results)),
        ),
        Plots(
            tr(
                "Vertical stiffness of table 11's designs, and displacement against load at the "
                "loads of figure 15, by our load-bearing model and our finite elements. The "
                "paper draws figure 15 as curves without numbers, so printed displacements exist "
                "only at table 11's load; for the other loads it prints the largest error of its "
                "model, without a sign."
            ),
            (_stiffness_plot(results), *_load_plots(results)),
            shown=2,
        ),
        Plots(
            tr("Difference of the stiffness from the FE values of table 7, on the same scale."),
            tuple(_fem_plots(results)),
        ),
        sheet_view(sheet_of(sheets, LcaValidation)),
        sheet_view(sheet_of(sheets, LcaAgainstFem)),
        Plots(
            tr(
                "Deformed middle line of the shear band (figure 14 of the paper), by the "
                "load-bearing model, region by region, and by finite elements where the "
                "study of this rubber names the case in neutral_line_cases. "
                "Displacements are to scale, on the same undeformed circle; the rim is "
                "drawn for orientation."
            ),
            tuple(_neutral_line_plots(results)),
            shown=2,
        ),
    ]
    return Section(
        ReportSection.LCA, tr("Load-bearing model (LCA) against the paper"), tuple(blocks)
    )


def _difference_plots(results: Results) -> list[Plot]:
    table = _with_published(results)
    largest = float(table[list(DIFFERENCES)].abs().max().max())
    limit = math.ceil(largest + 0.5)
    return [
        plot(
            tr(
                "Differences from table 11 in percent, section {section}",
                section=tr(SECTION_NAMES[str(section)]),
            ),
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
        plot(
            tr(
                "Differences from table 7, section {section}",
                section=tr(SECTION_NAMES[str(section)]),
            ),
            False,
            fem_differences,
            rows,
            limit,
        )
        for section, rows in table.groupby("section", sort=False)
    ]


def _stiffness_plot(results: Results) -> Plot:
    alt = tr("Stiffness by FEM, printed LCA and our LCA")
    return plot(alt, False, stiffness_bars, _with_published(results))


def _load_plots(results: Results) -> list[Plot]:
    sections = [rows for _, rows in results.table(LcaValidation).groupby("section", sort=False)]
    by_solver = results.table(DisplacementByLoad).groupby("solver", sort=False)
    solved = [rows for _, rows in by_solver if rows["displacement_mm"].notna().any()]
    nothing, synthetic = results.table(DisplacementByLoad).iloc[:0], results.plies_synthetic
    plots = []
    for rows in sections:
        for fe in solved or [nothing]:
            by = "" if fe.empty else tr(" and {solver}", solver=fe["solver"].iloc[0])
            alt = tr(
                "Displacement against load, LCA, {section}{by}",
                section=tr(SECTION_NAMES[str(rows["section"].iloc[0])]),
                by=by,
            )
            marked = synthetic and not fe.empty
            plots.append(plot(alt, marked, load_displacement, rows, fe, synthetic))
    for fe in solved:
        alt = tr(
            "Stiffness of the LCA against {solver} at each load, in percent",
            solver=fe["solver"].iloc[0],
        )
        plots.append(plot(alt, synthetic, load_errors, fe, synthetic))
    return plots + [
        plot(
            tr("{label} against load", label=tr(label)),
            False,
            contact_against_load,
            sections[0],
            column,
        )
        for column, label in CONTACT.items()
    ]


def _neutral_line_plots(results: Results) -> list[Plot]:
    rim, synthetic = results.config.tyre.rim_diameter_mm, results.plies_synthetic
    plots = []
    for (load, c10), rows in results.table(LcaNeutralLine).groupby(
        ["load_n", "spoke_c10_mpa"], sort=False
    ):
        fe = finite_element_ring(results, float(str(load)), float(str(c10)))
        by = "" if fe.empty else tr(" and {solver}", solver=fe["solver"].iloc[0])
        alt = tr(
            "Deformed ring at {load:g} N for spoke C10 of {c10:g} MPa by LCA{by}",
            load=load,
            c10=c10,
            by=by,
        )
        marked = synthetic and not fe.empty
        plots.append(plot(alt, marked, deformed_ring, rows, rim, fe, synthetic))
    return plots


def finite_element_ring(results: Results, load_n: float, spoke_c10_mpa: float) -> pd.DataFrame:
    """Take the neutral line of a tyre of table 11 by the first FE solver that gave one."""
    lines, cases = results.table(NeutralLine), results.table(Cases)
    band = results.config.lca_validation.shear_band_c10_mpa
    tyres = same_tyres(cases, lines, band)
    tyres = tyres[tyres["load_n"].eq(load_n) & np.isclose(tyres["spoke_c10_mpa"], spoke_c10_mpa)]
    if tyres.empty:
        return lines.iloc[:0]
    first = tyres.iloc[0]
    return lines[lines["case_id"].eq(first["case_id"]) & lines["solver"].eq(first["solver"])]


def _with_published(results: Results) -> pd.DataFrame:
    table = results.table(LcaValidation)
    return table[table["published_displacement_mm"].notna()]
