"""Section of the report on provenance: rule and source of each table, input files, software."""

from __future__ import annotations

from nptcs.language import tr, translatable
from nptcs.report.blocks import Folded, PageBlock, Section, Text
from nptcs.report.data import Results
from nptcs.report.sections.ply import ply_words
from nptcs.report.table_view import sheet_view, table_view
from nptcs.report.tables import entries
from nptcs.report.tables.provenance import configuration_text, entries_table
from nptcs.report.tables.sheets import Sheets
from nptcs.runs.identity import RunIdentity
from nptcs.tables.result_table import Heading, ReportSection

TABLES = entries.Entry(
    "about",
    translatable("Which rule made which table"),
    translatable("this report"),
    "report",
    translatable("the catalogue of tables"),
    {"sheet": Heading(translatable("worksheet"))},
)


def provenance_section(results: Results, sheets: Sheets) -> Section:
    """Build the section."""
    ply = ply_words(results)
    blocks: list[PageBlock] = [Text(identity_words(results.identity))] if results.identity else []
    blocks += [Text(ply)] if ply else []
    blocks += [
        table_view(entries_table([sheet.entry for sheet in sheets.values()]), TABLES),
        sheet_view(sheets[entries.INPUTS.sheet]),
        sheet_view(sheets[entries.SOFTWARE.sheet]),
        Folded(tr("The configuration, with all defaults"), configuration_text(results)),
    ]
    return Section(ReportSection.PROVENANCE, tr("Where the numbers came from"), tuple(blocks))


def identity_words(identity: RunIdentity) -> str:
    """Name the run by its content, and say when its tables were complete."""
    return tr(
        "Run {short}: SHA-256 {identity} over {inputs} input files, the configuration, the code "
        "and {tables} tables; the tables were complete on {made}. The command nptcs compare says "
        "what differs from another run.",
        short=identity.short,
        identity=identity.identity,
        inputs=len(identity.inputs),
        tables=len(identity.tables),
        made=identity.made_text,
    )
