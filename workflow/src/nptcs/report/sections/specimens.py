"""Section of the report on specimens and files."""

from __future__ import annotations

from nptcs.report.blocks import Plot, Plots, Section, Text
from nptcs.report.data import Results
from nptcs.report.figures.materials import stress_strain
from nptcs.report.plots import plot
from nptcs.report.table_view import sheet_view
from nptcs.report.tables import entries
from nptcs.report.tables.sheets import Sheets, sheet_of
from nptcs.tables.files import Files
from nptcs.tables.properties import PropertiesTable
from nptcs.tables.result_table import ReportSection
from nptcs.tables.statistics import StatisticsTable


def specimens_section(results: Results, sheets: Sheets) -> Section:
    """Build the section."""
    tables = (
        sheet_of(sheets, StatisticsTable),
        sheet_of(sheets, PropertiesTable),
        sheets[entries.SHEET.sheet],
        sheets[entries.CONDITIONING.sheet],
        sheet_of(sheets, Files),
    )
    curves = Plots(
        "Stress–strain curves of each series after signal conditioning. Dashed grey: left out by "
        "the specimen sheet. Compression is negative.",
        tuple(_series_plots(results)),
    )
    return Section(
        ReportSection.SPECIMENS,
        "Specimens and files",
        (_counts(results), curves, *map(sheet_view, tables)),
        results.any_synthetic,
    )


def _counts(results: Results) -> Text:
    counts = results.table(Files)["status"].value_counts()
    files = ", ".join(f"{number} {status}" for status, number in counts.sort_index().items())
    failed, left_out = len(results.failed()), len(results.left_out())
    return Text(
        f"{len(results.sheet)} specimens in {len(results.series())} series; "
        f"{left_out} left out by the sheet, {failed} that could not be read. "
        f"Files of the folder: {files}."
    )


def _series_plots(results: Results) -> list[Plot]:
    left_out = list(results.left_out())
    plots = []
    for name, specimens in results.series().items():
        curves = {
            s.specimen: results.curves[s.specimen]
            for s in specimens
            if len(results.curves[s.specimen])
        }
        if not curves:
            continue
        synthetic = any(s.origin == "synthetic" for s in specimens)
        alt = f"Stress over strain of {len(curves)} specimens, series {name}"
        plots.append(plot(alt, synthetic, stress_strain, name, curves, left_out, synthetic))
    return plots
