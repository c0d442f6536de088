"""Section of the report on specimens and files."""

from __future__ import annotations

import math
from collections.abc import Sequence

import pandas as pd

from nptcs.language import tr
from nptcs.mechanical_tests import TestType, is_property
from nptcs.reduce.standards.shear import shear_curve
from nptcs.report.blocks import Plot, Plots, Section, Text
from nptcs.report.data import Results
from nptcs.report.figures.specimens import NORMAL, SHEAR, Moduli, rubber_curves, stress_strain
from nptcs.report.plots import plot
from nptcs.report.table_view import sheet_view
from nptcs.report.tables import entries
from nptcs.report.tables.sheets import Sheets, sheet_of
from nptcs.report.text import joined
from nptcs.tables.laboratory.files import Files
from nptcs.tables.laboratory.material_card import PUBLISHED_PLY
from nptcs.tables.laboratory.properties import PropertiesTable
from nptcs.tables.laboratory.specimen import Specimen
from nptcs.tables.laboratory.statistics import StatisticsTable
from nptcs.tables.result_table import ReportSection

PUBLISHED_MODULI = {
    (TestType.TENSION, 0.0): ("E1", PUBLISHED_PLY["e1_mpa"]),
    (TestType.TENSION, 90.0): ("E2", PUBLISHED_PLY["e2_mpa"]),
    (TestType.SHEAR, 45.0): ("G12", PUBLISHED_PLY["g12_mpa"]),
    (TestType.COMPRESSION, 0.0): ("E1c", math.nan),
    (TestType.COMPRESSION, 90.0): ("E2c", math.nan),
}
"""Symbol and the paper's value (table 2, MPa) by test and direction; none in compression."""
FIGURE_4 = frozenset({TestType.RUBBER_TENSION})
"""Tests of rubbers that figure 4 of the paper draws in one panel."""


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
        tr(
            "Stress–strain curves of each series after signal conditioning (figures 2 and 4 of "
            "the paper). The bold part of a curve is the chord of its modulus; lines through the "
            "origin have the mean modulus and the one printed in table 2 of the paper. Dashed "
            "grey: left out by the specimen sheet. Compression is negative."
        ),
        tuple(_series_plots(results)),
    )
    return Section(
        ReportSection.SPECIMENS,
        tr("Specimens and files"),
        (_counts(results), curves, *map(sheet_view, tables)),
        results.any_synthetic,
    )


def _counts(results: Results) -> Text:
    counts = results.table(Files)["status"].value_counts()
    files = ", ".join(
        f"{number} {tr(str(status))}" for status, number in counts.sort_index().items()
    )
    failed, left_out = len(results.failed()), len(results.left_out())
    return Text(
        tr(
            "{specimens} specimens in {series} series; {left_out} left out by the sheet, "
            "{failed} could not be read. Files in the folder: {files}.",
            specimens=len(results.sheet),
            series=len(results.series()),
            left_out=left_out,
            failed=failed,
            files=files,
        )
    )


def _series_plots(results: Results) -> list[Plot]:
    left_out = list(results.left_out())
    plots = []
    for specimens in results.series().values():
        curves = {
            s.specimen: results.curves[s.specimen]
            for s in specimens
            if len(results.curves[s.specimen])
        }
        if not curves:
            continue
        synthetic = any(s.origin == "synthetic" for s in specimens)
        title, moduli, axis = series_title(specimens[0]), moduli_of(results, specimens), NORMAL
        if is_property(specimens[0].test, "shear_modulus"):
            curves, axis = {name: with_shear(curve) for name, curve in curves.items()}, SHEAR
        given = (title, curves, left_out, synthetic, moduli, axis)
        alt = tr(
            "{stress} over {strain}, {title}, {count} specimens",
            stress=tr(axis.stress_words),
            strain=tr(axis.strain_words),
            title=title,
            count=len(curves),
        )
        plots.append(plot(alt, synthetic, stress_strain, *given))
    return plots + _rubber_plot(results)


def _rubber_plot(results: Results) -> list[Plot]:
    """Draw the tension tests of all rubbers in one panel; nothing for fewer than two rubbers."""
    tests: dict[str, dict[str, pd.DataFrame]] = {}
    for specimen in results.sheet:
        curve = results.curves[specimen.specimen]
        if specimen.test in FIGURE_4 and specimen.include and len(curve):
            tests.setdefault(specimen.material, {})[specimen.specimen] = curve
    if len(tests) < 2:
        return []
    alt = tr("Stress over strain of {names} in tension, all specimens", names=joined(tests))
    synthetic = results.rubbers_synthetic
    return [plot(alt, synthetic, rubber_curves, tests, synthetic)]


def series_title(specimen: Specimen) -> str:
    """Name a series for a reader, such as "cfrp, tension at 90°"."""
    test = specimen.test.value.removeprefix("rubber_").replace("_", " ")
    if specimen.orientation_deg is None:
        return tr("{material}, {test}", material=specimen.material, test=tr(test))
    sign = "±" if is_property(specimen.test, "shear_modulus") else ""
    return tr(
        "{material}, {test} at {angle}°",
        material=specimen.material,
        test=tr(test),
        angle=f"{sign}{specimen.orientation_deg:g}",
    )


def with_shear(curve: pd.DataFrame) -> pd.DataFrame:
    """Add shear strain and shear stress to a curve of a ±45° laminate (ASTM D3518)."""
    gamma, tau = shear_curve(curve)
    return pd.DataFrame({SHEAR.strain: gamma, SHEAR.stress: tau})


def moduli_of(results: Results, specimens: Sequence[Specimen]) -> Moduli | None:
    """Gather the chords of a series, their mean and the paper's modulus; None without chords."""
    first, table = specimens[0], results.table(PropertiesTable)
    name = "shear_modulus" if is_property(first.test, "shear_modulus") else "modulus"
    chords = table[
        table["specimen"].isin([s.specimen for s in specimens])
        & table["property"].eq(name)
        & table[["value", "range_low", "range_high"]].notna().all(axis=1)
    ]
    if chords.empty or first.test.is_rubber:
        return None
    angle = math.nan if first.orientation_deg is None else first.orientation_deg
    symbol, published = PUBLISHED_MODULI.get((first.test, angle), ("E", math.nan))
    if first.material not in results.card.plies:
        published = math.nan
    groups = results.table(StatisticsTable)
    groups = groups[
        groups["test"].eq(first.test.value)
        & groups["material"].eq(first.material)
        & groups["property"].eq(name)
        & groups["scope"].eq("group")
        & groups["orientation_deg"].eq(angle)
    ]
    mean = float(groups["mean"].iloc[0]) if len(groups) == 1 else math.nan
    columns = ["specimen", "value", "range_low", "range_high"]
    return Moduli(chords[columns], mean, published, symbol, first.test.load_sign)
