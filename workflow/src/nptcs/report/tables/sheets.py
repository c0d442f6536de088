"""The tables of the results in reading order: what the workbook contains and the report lists."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import assert_never

import pandas as pd
import pandera.pandas as pa

from nptcs.report.data import Results
from nptcs.report.tables import entries
from nptcs.report.tables.entries import Entry, result_entry
from nptcs.report.tables.materials import ply_table, rubber_table
from nptcs.report.tables.names import factor_headings
from nptcs.report.tables.provenance import inputs_table, software_table
from nptcs.report.tables.row_classes import RowClass, no_row, row_class
from nptcs.report.tables.specimens import conditioning_table, sheet_table
from nptcs.tables.catalogue import file_of, result_files
from nptcs.tables.laboratory.files import Files
from nptcs.tables.laboratory.hyperelastic import ModelComparison
from nptcs.tables.laboratory.properties import PropertiesTable
from nptcs.tables.result_table import ReportSection, RowMark, SyntheticBy
from nptcs.tables.tyres.cases import Cases

LONGEST_SHEET = 5000
"""Rows of the longest table that is a sheet of the workbook; a longer one is only a CSV file."""


@dataclass(frozen=True)
class Sheet:
    """One table with all that its layout needs.

    Parameters
    ----------
    entry : Entry
        What is said about the table.
    table : DataFrame
        Finished values.
    mark : callable
        Gives the class of a row (`nptcs.report.tables.row_classes`).
    synthetic : bool
        Whether it rests on synthetic specimens.
    section : ReportSection, optional
        Section of the report that shows it by default; none for a table that a section names.
    raw : bool
        Whether it contains curves, shapes or fields point by point.
    """

    entry: Entry
    table: pd.DataFrame
    mark: RowClass = no_row
    synthetic: bool = False
    section: ReportSection | None = None
    raw: bool = False

    @property
    def in_workbook(self) -> bool:
        """Tell whether the workbook has it; points of curves and shapes are files next to it."""
        return not self.raw and len(self.table) <= LONGEST_SHEET


Sheets = Mapping[str, Sheet]
"""Tables by the name of their sheet."""


def sheet_of(sheets: Sheets, contract: type[pa.DataFrameModel], study: str = "") -> Sheet:
    """Return the sheet of a result table; for a table of one study, that of the study."""
    file = f"results/tables/{file_of(contract, study)}"
    return next(sheet for sheet in sheets.values() if sheet.entry.file == file)


def sheets_of(results: Results) -> Sheets:
    """List all tables of a run by the name of their sheet, in the order of the catalogue.

    A table that the report makes itself comes before the result table that it leads to.
    """
    leading, factors = _leading_sheets(results), factor_headings(results.config.studies)
    sheets: list[Sheet] = []
    for file, row, study in result_files(results.surface_studies):
        table = results.tables[file]
        sheets += leading.get(row.contract, [])
        sheets.append(
            Sheet(
                result_entry(file, row, study),
                table,
                row_class(row.mark, results.left_out()),
                is_synthetic(results, row.synthetic, table, study),
                row.section,
                row.raw,
            )
        )
    sheets.append(Sheet(entries.INPUTS, inputs_table(results)))
    sheets.append(Sheet(entries.SOFTWARE, software_table(results)))
    named = [replace(sheet, entry=sheet.entry.with_factors(factors)) for sheet in sheets]
    return {sheet.entry.sheet: sheet for sheet in named}


def is_synthetic(results: Results, by: SyntheticBy, table: pd.DataFrame, study: str = "") -> bool:
    """Tell whether a table rests on synthetic specimens, by the rule of its row."""
    match by:
        case SyntheticBy.NOTHING:
            return False
        case SyntheticBy.SPECIMENS:
            return results.any_synthetic
        case SyntheticBy.PLIES:
            return results.plies_synthetic
        case SyntheticBy.RUBBERS:
            return results.rubbers_synthetic
        case SyntheticBy.STUDIES:
            named = [results.config.study(study)] if study else results.config.studies
            return any(results.study_is_synthetic(one) for one in named)
        case SyntheticBy.ROWS:
            return results.table_is_synthetic(table)
        case _:
            assert_never(by)


def _leading_sheets(results: Results) -> dict[type[pa.DataFrameModel], list[Sheet]]:
    """List the tables that the report makes itself, by the result table that they lead to."""
    specimens = results.any_synthetic
    include, status, origin = map(row_class, (RowMark.INCLUDE, RowMark.STATUS, RowMark.ORIGIN))
    plies, rubbers = results.plies_synthetic, results.rubbers_synthetic
    designs = [
        Sheet(
            entries.design_entry(name),
            design,
            synthetic=results.study_is_synthetic(results.config.study(name)),
        )
        for name, design in results.designs.items()
    ]
    return {
        Files: [Sheet(entries.SHEET, sheet_table(results), include, specimens)],
        PropertiesTable: [
            Sheet(entries.CONDITIONING, conditioning_table(results), status, specimens)
        ],
        ModelComparison: [
            Sheet(entries.PLY, ply_table(results), origin, plies),
            Sheet(entries.RUBBERS, rubber_table(results), origin, rubbers),
        ],
        Cases: designs,
    }
