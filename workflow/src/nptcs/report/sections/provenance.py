"""Section 8 of the report: which rule made which table, from which files, with which software."""

from __future__ import annotations

from nptcs.report.data import Results
from nptcs.report.sections.ply import ply_words
from nptcs.report.tables import catalogue
from nptcs.report.tables.provenance import configuration_text, entries_table
from nptcs.report.tables.sheets import Sheets
from nptcs.report.view import Folded, PageBlock, Section, Text, sheet_view, table_view

TABLES = catalogue.Entry(
    "about", "Which rule made which table", "this report", "report", "the catalogue of tables"
)


def provenance_section(results: Results, sheets: Sheets) -> Section:
    """Build the section."""
    entries = [sheet.entry for sheet in sheets.values()]
    ply = ply_words(results)
    blocks: list[PageBlock] = [Text(ply)] if ply else []
    blocks += [
        table_view(entries_table(entries), TABLES),
        sheet_view(sheets[catalogue.INPUTS.sheet]),
        sheet_view(sheets[catalogue.SOFTWARE.sheet]),
        Folded("The configuration, with all defaults", configuration_text(results)),
    ]
    return Section("provenance", "Where the numbers came from", tuple(blocks))
