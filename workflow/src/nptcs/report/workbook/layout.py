"""Widths, frozen panes, filters and print pages, the same on every sheet."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from math import ceil

from openpyxl.cell import Cell
from openpyxl.styles import Alignment, Font, PatternFill
from openpyxl.utils import get_column_letter
from openpyxl.worksheet.worksheet import Worksheet

from nptcs.language import tr
from nptcs.report.text import text_width, wrapped
from nptcs.report.workbook.cells import FONT, HEADER, SYNTHETIC, WRAPPED
from nptcs.report.workbook.number_formats import shown_number

WIDEST = 60
BOLD = 1.15
"""Width of bold characters over that of plain ones."""
LINE_HEIGHT = 15.0
MOST_LINES = 27
"""Lines of the highest row that a spreadsheet can show (409 points)."""

TOP = Alignment(vertical="top")
HEADER_OF_NUMBERS = Alignment(horizontal="right", wrap_text=True, vertical="top")
PAGE_WIDTH = 330.0
"""Most characters across a page at which a table is still readable: about 5 points high."""


@cache
def indented(vertical: str | None, wrap_text: bool | None) -> Alignment:
    """Return the alignment of a text that keeps a distance from the number to its left."""
    return Alignment(horizontal="left", indent=1, vertical=vertical, wrap_text=wrap_text)


INDENTED_WRAPPED = indented("top", True)


def finish_table(worksheet: Worksheet, fill: PatternFill = HEADER) -> None:
    """Style a sheet that is one table: header in the first row, frozen, with a filter."""
    for cell in worksheet[1]:
        cell.fill, cell.font, cell.alignment = fill, Font(name=FONT, bold=True), WRAPPED
    worksheet.freeze_panes = worksheet.cell(2, 2)
    worksheet.auto_filter.ref = worksheet.dimensions
    fit_widths(worksheet, 1)
    wrap_long_texts(worksheet, 2)
    keep_numbers_apart(worksheet, 1)
    page_for_print(worksheet, header=1)
    if fill is SYNTHETIC:
        mark_synthetic(worksheet)


def fit_widths(worksheet: Worksheet, header: int) -> None:
    """Make each column as wide as its header and cells need, and the header high enough."""
    lines = 1
    for column, cells in enumerate(worksheet.iter_cols(min_row=header), start=1):
        widths = [_header_width(cells[0]), *map(_width, cells[1:])]
        width = min(WIDEST, max(widths) + 2)
        worksheet.column_dimensions[get_column_letter(column)].width = width
        lines = max(lines, _lines(str(cells[0].value or ""), width - 1))
    worksheet.row_dimensions[header].height = LINE_HEIGHT * lines


def wrap_long_texts(worksheet: Worksheet, first: int) -> None:
    """Wrap the texts that are longer than the widest column, which printing would cut off."""
    for row in worksheet.iter_rows(min_row=first):
        long = [cell.data_type == "s" and text_width(str(cell.value)) > WIDEST for cell in row]
        if any(long):
            for cell, is_long in zip(row, long, strict=True):
                cell.alignment = WRAPPED if is_long else TOP
            _fit_height(worksheet, row)


def keep_numbers_apart(worksheet: Worksheet, header: int) -> None:
    """Put the headers of numbers over them, and a gap between numbers and text to their right."""
    after_numbers = False
    for cells in worksheet.iter_cols(min_row=header):
        values = [cell for cell in cells[1:] if cell.value is not None]
        numbers = bool(values) and all(cell.data_type == "n" for cell in values)
        if numbers:
            cells[0].alignment = HEADER_OF_NUMBERS
        elif after_numbers:
            for cell in cells:
                cell.alignment = indented(cell.alignment.vertical, cell.alignment.wrap_text)
        after_numbers = numbers


def fit_heights(worksheet: Worksheet, first: int, last: int) -> None:
    """Make rows high enough for their wrapped cells; programs do so only when a cell is edited."""
    for row in worksheet.iter_rows(min_row=first, max_row=last):
        _fit_height(worksheet, row)


def _fit_height(worksheet: Worksheet, row: Sequence[Cell]) -> None:
    lines = 1
    for cell in row:
        if cell.value is not None and cell.alignment.wrap_text:
            width = int(_width_of(worksheet, cell)) - 1
            lines = max(lines, _lines(str(cell.value), width))
    worksheet.row_dimensions[row[0].row].height = LINE_HEIGHT * min(lines, MOST_LINES)


def _width_of(worksheet: Worksheet, cell: Cell) -> float:
    """Width of a cell, or of the cells that it is merged with."""
    span = next(
        (one for one in worksheet.merged_cells.ranges if cell.coordinate in one),
        None,
    )
    columns = [cell.column] if span is None else range(span.min_col, span.max_col + 1)
    return sum(worksheet.column_dimensions[get_column_letter(one)].width for one in columns)


def page_for_print(worksheet: Worksheet, header: int | None, area: str = "") -> None:
    """Set up the pages of a sheet: landscape, with its header on each of them.

    A sheet is as wide as one page; a table that would be too small to read on one page is spread
    over several, with its first column on each.
    """
    worksheet.print_area = area or worksheet.dimensions
    worksheet.page_setup.orientation = "landscape"
    worksheet.page_setup.paperSize = worksheet.PAPERSIZE_A4
    wide = sum(one.width for one in worksheet.column_dimensions.values() if one.customWidth)
    if header is not None and wide > PAGE_WIDTH:
        worksheet.page_setup.fitToWidth = ceil(wide / PAGE_WIDTH)
        worksheet.print_title_cols = "A:A"
    worksheet.page_setup.fitToHeight = 0
    worksheet.sheet_properties.pageSetUpPr.fitToPage = True
    if header is not None:
        worksheet.print_title_rows = f"{header}:{header}"
    worksheet.oddFooter.left.text = "&A"
    worksheet.oddFooter.right.text = "&P / &N"


def mark_synthetic(worksheet: Worksheet) -> None:
    """Say on the tab and on each printed page that a sheet rests on synthetic data."""
    worksheet.sheet_properties.tabColor = "FFD699"
    worksheet.oddHeader.center.text = tr("SYNTHETIC DATA")


def _header_width(cell: Cell) -> int:
    """Return the width of the longest word of a header, which may wrap at spaces."""
    words = str(cell.value or "").split()
    return max((ceil(BOLD * text_width(word)) for word in words), default=0)


def _width(cell: Cell) -> int:
    """Estimate the characters that a cell shows."""
    if cell.value is None:
        return 0
    if cell.data_type == "n":
        return len(shown_number(float(cell.value), cell.number_format))
    return ceil(text_width(str(cell.value)))


def _lines(text: str, width: int) -> int:
    """Count the lines of a text in a column; a word longer than a line is broken."""
    lines = [line for part in text.splitlines() for line in wrapped(part, width).splitlines()]
    return sum(max(1, ceil(text_width(line) / width)) for line in lines)
