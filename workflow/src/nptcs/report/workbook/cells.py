"""Values, colours and fonts of single cells."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd
from openpyxl.cell import Cell
from openpyxl.cell.cell import ILLEGAL_CHARACTERS_RE
from openpyxl.styles import Alignment, Font, PatternFill
from openpyxl.worksheet.worksheet import Worksheet

from nptcs.language import tr

HEADER = PatternFill("solid", start_color="DCE6EF")
SYNTHETIC = PatternFill("solid", start_color="FFD699")
INPUT = PatternFill("solid", start_color="FFF8DC")
FILLS = {
    "bad": PatternFill("solid", start_color="FDD9C8"),
    "warn": PatternFill("solid", start_color="FFF2C4"),
    "out": PatternFill("solid", start_color="E7E7E7"),
}
FONT = "Calibri"
LINK = Font(name=FONT, color="0B4F7A", underline="single")
WRAPPED = Alignment(wrap_text=True, vertical="top")
LONGEST_TEXT = 32767
"""Most characters that a cell can have."""


def write(cell: Cell, value: Any) -> None:
    """Write one value: a number as a number, text as text (never as a formula), NaN as nothing."""
    if value is None or value is pd.NA or (isinstance(value, float) and math.isnan(value)):
        return
    if isinstance(value, bool | np.bool_):
        cell.value = tr("yes") if value else tr("no")
    elif isinstance(value, int | np.integer):
        cell.value = int(value)
    elif isinstance(value, float | np.floating) and math.isfinite(value):
        cell.value = float(value)
    elif text := ILLEGAL_CHARACTERS_RE.sub("�", str(value))[:LONGEST_TEXT]:
        cell.value = text
        cell.data_type = "s"


def write_row(worksheet: Worksheet, row: int, values: Sequence[Any], first: int = 1) -> None:
    """Write values into the cells of a row, starting at a column."""
    for column, value in enumerate(values, start=first):
        write(worksheet.cell(row, column), value)


def write_title(worksheet: Worksheet, title: str, lines: Sequence[str] = ()) -> int:
    """Write a heading and lines of text below it; return the first free row."""
    write(worksheet.cell(1, 1), title)
    worksheet.cell(1, 1).font = Font(name=FONT, bold=True, size=14)
    for row, line in enumerate(lines, start=2):
        write(worksheet.cell(row, 1), line)
        worksheet.cell(row, 1).font = Font(name=FONT, color="444444")
    return len(lines) + 2


def head_row(worksheet: Worksheet, row: int, names: Sequence[str], first: int = 1) -> None:
    """Write the header of a table that begins within a sheet."""
    write_row(worksheet, row, names, first)
    for column in range(first, first + len(names)):
        cell = worksheet.cell(row, column)
        cell.fill, cell.font, cell.alignment = HEADER, Font(name=FONT, bold=True), WRAPPED
