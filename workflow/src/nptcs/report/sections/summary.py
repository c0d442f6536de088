"""The head of the report: first what failed, then the main results and what to know."""

from __future__ import annotations

from nptcs.language import tr, tr_count
from nptcs.report.answer.agreement import agreement_finding
from nptcs.report.answer.governing import governing_finding
from nptcs.report.answer.recommended import recommended_findings
from nptcs.report.answer.stiffness import stiffness_finding
from nptcs.report.answer.tests_behind import tests_finding
from nptcs.report.blocks import Finding, Findings, Listing, PageBlock, Text
from nptcs.report.data import Results
from nptcs.report.sections.refused import all_refused
from nptcs.report.table_view import sheet_view
from nptcs.report.tables.checks import WARNING, check_text
from nptcs.report.tables.sheets import Sheets
from nptcs.report.text import joined
from nptcs.report.words.flags import flag_text
from nptcs.tables.laboratory.files import Files, FileStatus
from nptcs.tables.laboratory.flags import FlagsTable
from nptcs.tables.result_table import ReportSection


def summary_blocks(results: Results, sheets: Sheets) -> tuple[PageBlock, ...]:
    """Build the blocks above the first section: problems, findings, flags, remarks."""
    sound, line = results.verdict()
    blocks: list[PageBlock] = [Text(line, "ok" if sound else "bad")]
    blocks += [
        sheet_view(sheet)
        for sheet in sheets.values()
        if sheet.section is ReportSection.SUMMARY and len(sheet.table)
    ]
    blocks.append(Findings(findings(results)))
    if flags := flag_lines(results):
        lead = tr("Where the tests deviate from their standards, and what they could not determine")
        blocks.append(Listing(lead, flags, "warn"))
    if remarks := _remarks(results):
        blocks.append(Listing(tr("Worth knowing"), remarks, "warn"))
    return tuple(blocks)


def findings(results: Results) -> tuple[Finding, ...]:
    """Answer the questions of the first screen."""
    return (
        stiffness_finding(results),
        governing_finding(results),
        *recommended_findings(results),
        agreement_finding(results),
        tests_finding(results),
    )


def flag_lines(results: Results) -> tuple[str, ...]:
    """Write the collected flags, one line for each standard and kind, with its specimens."""
    return tuple(
        tr_count(
            "{standard}, {count} specimen: {flag} ({names})",
            "{standard}, {count} specimens: {flag} ({names})",
            row["specimens"],
            standard=row["standard"],
            flag=flag_text(row["flag"]),
            names=row["names"],
        )
        for row in results.table(FlagsTable).to_dict("records")
    )


def _remarks(results: Results) -> tuple[str, ...]:
    """Collect what is not a failure but must be seen."""
    remarks = []
    if results.any_synthetic:
        synthetic = [s.specimen for s in results.sheet if s.origin == "synthetic"]
        remarks.append(
            tr(
                "{count} of {total} specimens are SYNTHETIC example data; everything derived "
                "from them carries the badge.",
                count=len(synthetic),
                total=len(results.sheet),
            )
        )
    for name, reason in results.left_out().items():
        remarks.append(
            tr("Specimen {name} is left out by the sheet: {reason}", name=name, reason=reason)
        )
    files = results.table(Files)
    stray = files[files["status"] == FileStatus.NOT_NAMED]
    if len(stray):
        remarks.append(
            tr(
                "No row of the sheet names these files in the folder: {files}",
                files=joined(stray["file"]),
            )
        )
    remarks += all_refused(results)
    remarks += [
        f"{card.name}: {check_text(check)}"
        for card in results.cards
        for check in card.checks
        if check.startswith(WARNING)
    ]
    return tuple(remarks)
