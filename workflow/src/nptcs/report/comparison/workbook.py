"""The comparison of two runs as a workbook: a summary with an index, and one sheet per part."""

from __future__ import annotations

import io

from openpyxl import Workbook
from openpyxl.styles import Font
from openpyxl.worksheet.hyperlink import Hyperlink
from openpyxl.worksheet.worksheet import Worksheet

from nptcs.language import tr
from nptcs.report.comparison.parts import TITLE, part_sheet
from nptcs.report.workbook.build import FIXED_DATE, dated
from nptcs.report.workbook.cells import FONT, LINK, WRAPPED, head_row, write_row, write_title
from nptcs.report.workbook.layout import fit_heights, page_for_print
from nptcs.report.workbook.table_sheets import write_table_sheet
from nptcs.runs.compare import ComparedRuns

WIDTHS = {"A": 34, "B": 60, "C": 12, "D": 90}


def comparison_workbook(done: ComparedRuns) -> bytes:
    """Write the comparison of two runs as one XLSX file.

    Parameters
    ----------
    done : ComparedRuns

    Returns
    -------
    bytes
        Content of the XLSX file; the same comparison gives the same bytes.
    """
    workbook = Workbook()
    _write_summary(workbook.active, done)
    for part in done.parts:
        write_table_sheet(workbook.create_sheet(part.name), part_sheet(part, done.synthetic))
    workbook.properties.title, workbook.properties.creator = tr(TITLE), "nptcs"
    workbook.properties.description = f"A = {done.a}; B = {done.b}"
    stream = io.BytesIO()
    workbook.save(stream)
    return dated(stream.getvalue(), FIXED_DATE)


def _write_summary(sheet: Worksheet, done: ComparedRuns) -> None:
    sheet.title = "Summary"
    lines = [f"A = {done.a}", f"B = {done.b}", done.verdict(), *done.sentences()]
    lines.append(
        tr(
            "Numbers within a relative difference of {within} count as the same. Rows: yellow "
            "different, red different by more than the uncertainty, grey in one run only or not "
            "comparable.",
            within=f"{done.within:g}",
        )
    )
    if done.synthetic:
        lines.append(tr("SYNTHETIC example data are among the materials of these runs."))
    row = write_title(sheet, tr(TITLE), lines) + 1
    sheet["A4"].font = Font(name=FONT, bold=True)
    heads = [tr("worksheet"), tr("what was found"), tr("rows"), tr("how it was compared")]
    head_row(sheet, row, heads)
    for place, part in enumerate(done.parts, start=row + 1):
        found = "; ".join([part.headline(), *part.remarks])
        write_row(sheet, place, [part.name, found, len(part.table), part.about])
        cell = sheet.cell(place, 1)
        cell.hyperlink = Hyperlink(ref=cell.coordinate, location=f"'{part.name}'!A1")
        cell.font = LINK
        for column in range(1, 5):
            sheet.cell(place, column).alignment = WRAPPED
    for letter, width in WIDTHS.items():
        sheet.column_dimensions[letter].width = width
    fit_heights(sheet, row + 1, sheet.max_row)
    page_for_print(sheet, None)
