"""The workbook: one sheet per table, native numbers at full precision, units in the headers."""

from __future__ import annotations

import io
import math
import re
import zipfile
from collections.abc import Sequence
from textwrap import wrap
from typing import Any

import numpy as np
import pandas as pd
from openpyxl import Workbook
from openpyxl.cell import Cell
from openpyxl.cell.cell import ILLEGAL_CHARACTERS_RE
from openpyxl.styles import Alignment, Font, PatternFill
from openpyxl.utils import get_column_letter
from openpyxl.worksheet.worksheet import Worksheet

from nptcs.report.data import Results
from nptcs.report.tables.dictionary import dictionary_table
from nptcs.report.tables.headings import heading
from nptcs.report.tables.sheets import Sheet, sheets_of

HEADER = PatternFill("solid", start_color="DCE6EF")
SYNTHETIC = PatternFill("solid", start_color="FFD699")
FILLS = {
    "bad": PatternFill("solid", start_color="FDD9C8"),
    "warn": PatternFill("solid", start_color="FFF2C4"),
    "out": PatternFill("solid", start_color="E7E7E7"),
}
FONT = "Calibri"
WIDEST = 60
LINE_HEIGHT = 15.0
LONGEST_TEXT = 32767
"""Characters that a cell can hold."""
SCIENTIFIC = "0.0000000000E+00"
"""Format of coefficients, which span many orders of magnitude."""
ABOUT = ("sheet", "what it says", "rows", "synthetic", "file", "rule", "made from")
LEFT_OUT = " (not a sheet of this workbook: too long, see its file)"
FIXED_DATE = (1980, 1, 1, 0, 0, 0)


def build_workbook(results: Results) -> bytes:
    """Write all results as one XLSX file.

    Numbers are stored to 16 significant digits and shown in the general format, coefficients
    in scientific notation. The same results give the same bytes.

    Parameters
    ----------
    results : Results
        Everything that a run has made.

    Returns
    -------
    bytes
        Content of the XLSX file.
    """
    listed = list(sheets_of(results).values())
    sheets = [sheet for sheet in listed if sheet.in_workbook]
    workbook = Workbook()
    about = workbook.active
    _write_about(about, results, listed)
    for sheet in sheets:
        _write_table(workbook.create_sheet(_name(sheet, workbook)), sheet)
    columns = workbook.create_sheet("columns")
    _write_rows(columns, 1, ["sheet", "column", "unit", "column in the file", "meaning"])
    for row, values in enumerate(dictionary_table(sheets).itertuples(index=False), start=2):
        _write_rows(columns, row, list(values))
    _finish(columns, 1)
    stream = io.BytesIO()
    workbook.save(stream)
    return without_times(stream.getvalue())


def _name(sheet: Sheet, workbook: Workbook) -> str:
    """Name a sheet, at most 31 characters, each name once."""
    name = sheet.entry.sheet[:31]
    number = 2
    while name in workbook.sheetnames:
        name = f"{sheet.entry.sheet[:28]}_{number}"
        number += 1
    return name


def _write_about(about: Worksheet, results: Results, sheets: Sequence[Sheet]) -> None:
    """Write the first sheet: the verdict, and what each sheet is."""
    about.title = "About"
    sound, line = results.verdict()
    settings = results.config.report
    lines = [settings.title, results.config.laboratory.name, line]
    if results.any_synthetic:
        lines.append("SYNTHETIC example data: sheets with an orange header rest on it.")
    lines.append(
        "Rows: red failed, yellow flagged, grey left out, assumed or calibrated on. "
        "Units: in brackets."
    )
    for row, text in enumerate(filter(None, lines), start=1):
        _write(about.cell(row, 1), text)
        about.cell(row, 1).font = Font(name=FONT, bold=row <= 3, size=14 if row == 1 else 11)
        if text == line and not sound:
            about.cell(row, 1).fill = FILLS["bad"]
    top = about.max_row + 2
    _write_rows(about, top, ABOUT)
    for row, sheet in enumerate(sheets, start=top + 1):
        entry = sheet.entry
        _write_rows(
            about,
            row,
            [
                entry.sheet,
                entry.title + LEFT_OUT * (not sheet.in_workbook),
                len(sheet.table),
                "yes" if sheet.synthetic else "no",
                entry.file,
                entry.rule,
                entry.source,
            ],
        )
        if sheet.in_workbook:
            about.cell(row, 1).hyperlink = f"#'{entry.sheet[:31]}'!A1"
            about.cell(row, 1).font = Font(name=FONT, color="0B4F7A", underline="single")
    _finish(about, top, freeze=False)


def _write_table(worksheet: Worksheet, sheet: Sheet) -> None:
    """Write one table: header in the first row, then one row per record."""
    names = [str(name) for name in sheet.table.columns]
    coefficients = "coefficient_natural" in names
    _write_rows(worksheet, 1, [str(heading(name, sheet.entry.headings)) for name in names])
    for row, record in enumerate(sheet.table.to_dict("records"), start=2):
        fill = FILLS.get(sheet.mark({str(key): value for key, value in record.items()}))
        for column, name in enumerate(names, start=1):
            cell = worksheet.cell(row, column)
            _write(cell, record[name])
            if coefficients and cell.data_type == "n":
                cell.number_format = SCIENTIFIC
            if fill:
                cell.fill = fill
    _finish(worksheet, 1, SYNTHETIC if sheet.synthetic else HEADER)


def _write_rows(worksheet: Worksheet, row: int, values: Sequence[Any]) -> None:
    for column, value in enumerate(values, start=1):
        _write(worksheet.cell(row, column), value)


def _write(cell: Cell, value: Any) -> None:
    """Write one value: numbers as numbers, text as text (never as a formula), no value as none."""
    if value is None or value is pd.NA or (isinstance(value, float) and math.isnan(value)):
        return
    if isinstance(value, bool | np.bool_):
        cell.value = "yes" if value else "no"
    elif isinstance(value, int | np.integer):
        cell.value = int(value)
    elif isinstance(value, float | np.floating) and math.isfinite(value):
        cell.value = float(value)
    elif text := ILLEGAL_CHARACTERS_RE.sub("�", str(value))[:LONGEST_TEXT]:
        cell.value = text
        cell.data_type = "s"


def _finish(
    worksheet: Worksheet, header: int, fill: PatternFill = HEADER, freeze: bool = True
) -> None:
    """Style the header, freeze it, set filter and column widths, and page for print."""
    for cell in worksheet[header]:
        cell.fill = fill
        cell.font = Font(name=FONT, bold=True)
        cell.alignment = Alignment(wrap_text=True, vertical="top")
    if freeze:
        worksheet.freeze_panes = worksheet.cell(header + 1, 2)
        worksheet.auto_filter.ref = worksheet.dimensions
    lines = 1
    for column in range(1, worksheet.max_column + 1):
        cells = [worksheet.cell(row, column) for row in range(header, worksheet.max_row + 1)]
        width = max(_width(cell) for cell in cells)
        width = min(WIDEST, width + 2)
        worksheet.column_dimensions[get_column_letter(column)].width = width
        lines = max(lines, len(wrap(str(cells[0].value or ""), width - 1)))
    worksheet.row_dimensions[header].height = LINE_HEIGHT * lines
    if fill is SYNTHETIC:
        worksheet.sheet_properties.tabColor = "FFD699"
        worksheet.oddHeader.center.text = "SYNTHETIC DATA"
    worksheet.page_setup.orientation = "landscape"
    worksheet.page_setup.fitToHeight = 0
    worksheet.sheet_properties.pageSetUpPr.fitToPage = True
    worksheet.print_title_rows = f"{header}:{header}"


def _width(cell: Cell) -> int:
    """Estimate the characters that a cell shows; headers may wrap at spaces."""
    if cell.value is None:
        return 0
    if cell.font.bold:
        return max(len(part) for part in str(cell.value).split())
    if cell.number_format == SCIENTIFIC:
        return 18
    return min(12, len(str(cell.value))) if cell.data_type == "n" else len(str(cell.value))


def without_times(content: bytes) -> bytes:
    """Replace the times that openpyxl writes into a workbook by a fixed one.

    Parameters
    ----------
    content : bytes
        An XLSX file.

    Returns
    -------
    bytes
        The same workbook; equal workbooks have equal bytes.
    """
    stream = io.BytesIO()
    with (
        zipfile.ZipFile(io.BytesIO(content)) as source,
        zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as target,
    ):
        for name in source.namelist():
            data = source.read(name)
            if name == "docProps/core.xml":
                data = re.sub(rb"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", b"1980-01-01T00:00:00Z", data)
            entry = zipfile.ZipInfo(name, FIXED_DATE)
            entry.compress_type = zipfile.ZIP_DEFLATED
            target.writestr(entry, data)
    return stream.getvalue()
