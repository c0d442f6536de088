"""The tables of the results in reading order: what the workbook holds and the report lists."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import pandas as pd

from nptcs.report.data import Results
from nptcs.report.tables import catalogue
from nptcs.report.tables import row_classes as marks
from nptcs.report.tables.catalogue import Entry
from nptcs.report.tables.materials import ply_table, rubber_table
from nptcs.report.tables.provenance import inputs_table, software_table
from nptcs.report.tables.row_classes import RowClass
from nptcs.report.tables.specimens import conditioning_table, sheet_table


@dataclass(frozen=True)
class Sheet:
    """One table with all that its layout needs."""

    entry: Entry
    table: pd.DataFrame
    mark: RowClass = marks.nothing
    synthetic: bool = False


Sheets = Mapping[str, Sheet]
"""Tables by the name of their sheet."""


def sheets_of(results: Results) -> Sheets:
    """List all tables of a run by the name of their sheet, problems first."""
    sheets = [
        Sheet(catalogue.PROBLEMS, results.problems, marks.always_bad),
        *_laboratory_sheets(results),
        *_material_sheets(results),
        *_study_sheets(results),
        *_compared_sheets(results),
        Sheet(catalogue.LCA_VALIDATION, results.lca_validation),
        Sheet(catalogue.LCA_AGAINST_FEM, results.lca_against_fem),
        Sheet(catalogue.LCA_SHAPE, results.lca_neutral_line),
        Sheet(catalogue.INPUTS, inputs_table(results)),
        Sheet(catalogue.SOFTWARE, software_table(results)),
    ]
    return {sheet.entry.sheet: sheet for sheet in sheets}


def _laboratory_sheets(results: Results) -> list[Sheet]:
    synthetic = results.any_synthetic
    of_specimens = marks.of_specimens(results.left_out())
    return [
        Sheet(catalogue.SHEET, sheet_table(results), marks.by_include, synthetic),
        Sheet(catalogue.FILES, results.files, marks.by_file_status, synthetic),
        Sheet(catalogue.CONDITIONING, conditioning_table(results), marks.by_status, synthetic),
        Sheet(catalogue.SPECIMENS, results.specimens, of_specimens, synthetic),
        Sheet(catalogue.STATISTICS, results.statistics, marks.by_outliers, synthetic),
    ]


def _material_sheets(results: Results) -> list[Sheet]:
    plies, rubbers = results.plies_synthetic, results.rubbers_synthetic
    return [
        Sheet(catalogue.PLY, ply_table(results), marks.by_origin, plies),
        Sheet(catalogue.RUBBERS, rubber_table(results), marks.by_origin, rubbers),
        Sheet(catalogue.MODELS, results.models, marks.nothing, rubbers),
        Sheet(catalogue.RANGES, results.ranges, marks.nothing, rubbers),
    ]


def _study_sheets(results: Results) -> list[Sheet]:
    synthetic = {s.name: results.study_is_synthetic(s) for s in results.config.studies}
    any_synthetic = any(synthetic.values())
    per_study: list[tuple[Callable[[str], Entry], dict[str, pd.DataFrame]]] = [
        (catalogue.design_entry, dict(results.designs)),
        (catalogue.surface_entry, dict(results.coefficients)),
    ]
    designs, surfaces = (
        [Sheet(entry(name), table, synthetic=synthetic[name]) for name, table in tables.items()]
        for entry, tables in per_study
    )
    return [
        *designs,
        Sheet(catalogue.CASES, results.cases, marks.by_status, any_synthetic),
        *surfaces,
        Sheet(catalogue.QUALITY, results.quality, synthetic=any_synthetic),
        Sheet(catalogue.IMPACT, results.impact, synthetic=any_synthetic),
    ]


def _compared_sheets(results: Results) -> list[Sheet]:
    """List what stands beside the paper's finite elements; each is synthetic by its solvers."""
    tables: list[tuple[Entry, pd.DataFrame, RowClass]] = [
        (catalogue.SPOKE_STIFFNESS, results.spoke_stiffness, marks.by_status),
        (catalogue.SPOKE_CURVES, results.spoke_curves, marks.nothing),
        (catalogue.STIFFNESS_ERRORS, results.stiffness_errors, marks.nothing),
        (catalogue.STIFFNESS_AGAINST_PUBLISHED, results.compare_published, marks.by_calibration),
        (catalogue.STIFFNESS_BY_LEVEL, results.stiffness_by_level, marks.nothing),
        (catalogue.NEUTRAL_LINE, results.neutral_line, marks.nothing),
    ]
    return [
        Sheet(entry, table, mark, results.table_is_synthetic(table))
        for entry, table, mark in tables
    ]
