"""One sheet per table: native numbers with a format by column, comments on the headings."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import pandas as pd
import pandera.pandas as pa
from openpyxl import Workbook
from openpyxl.comments import Comment
from openpyxl.worksheet.worksheet import Worksheet

from nptcs.language import tr
from nptcs.report.tables.column_words import column_words
from nptcs.report.tables.headings import heading
from nptcs.report.tables.sheets import Sheet
from nptcs.report.workbook.cells import FILLS, HEADER, SYNTHETIC, write, write_row
from nptcs.report.workbook.layout import finish_table
from nptcs.report.workbook.number_formats import BY_ROW, format_of_column, format_of_number

AUTHOR = "nptcs"
UNIT_COLUMN = "unit"
"""Column that states the unit of each row, for the numbers whose heading states none."""

COMMENT_SIZE = (360, 190)
"""Width and height of a comment in pixels."""


def sheet_name(sheet: Sheet, workbook: Workbook) -> str:
    """Name a sheet, at most 31 characters, each name once."""
    name = sheet.entry.sheet[:31]
    number = 2
    while name in workbook.sheetnames:
        name = f"{sheet.entry.sheet[:28]}_{number}"
        number += 1
    return name


def write_table_sheet(worksheet: Worksheet, sheet: Sheet) -> None:
    """Write one table: header with comments in the first row, then one row per record."""
    names = [str(name) for name in sheet.table.columns]
    headings = [heading(name, sheet.entry.headings) for name in names]
    by_row = BY_ROW[0] if UNIT_COLUMN in names else ""
    formats = [
        format_of_column(one.unit or by_row, sheet.table[name])
        for one, name in zip(headings, names, strict=True)
    ]
    write_row(worksheet, 1, [str(one) for one in headings])
    _comment_headings(worksheet, sheet)
    for row, record in enumerate(sheet.table.to_dict("records"), start=2):
        fill = FILLS.get(sheet.mark({str(key): value for key, value in record.items()}))
        for column, (name, shown) in enumerate(zip(names, formats, strict=True), start=1):
            cell = worksheet.cell(row, column)
            write(cell, column_words(name, record[name]))
            if cell.data_type == "n" and cell.value is not None:
                cell.number_format = shown or format_of_number(float(cell.value))
            if fill:
                cell.fill = fill
    finish_table(worksheet, SYNTHETIC if sheet.synthetic else HEADER)


def _comment_headings(worksheet: Worksheet, sheet: Sheet) -> None:
    """Say for each column what it means, which rule made it and which values it has."""
    columns: Mapping[str, Any] = (
        {} if sheet.entry.contract is None else sheet.entry.contract.to_schema().columns
    )
    for place, name in enumerate(map(str, sheet.table.columns), start=1):
        text = heading_comment(sheet, name, columns.get(name))
        comment = Comment(text, AUTHOR, width=COMMENT_SIZE[0], height=COMMENT_SIZE[1])
        worksheet.cell(1, place).comment = comment


def heading_comment(sheet: Sheet, column: str, contract: pa.Column | None) -> str:
    """Write the comment on the heading of a column.

    Parameters
    ----------
    sheet : Sheet
    column : str
        As in the file.
    contract : pandera Column, optional
        What the contract of the table says about it.
    """
    lines = [tr(contract.description or "")] if contract is not None else []
    if contract is not None and (allowed := allowed_values(contract)):
        lines.append(tr("Allowed: {allowed}", allowed=allowed))
    if found := found_values(sheet.table[column]):
        lines.append(tr("In this run: {found}", found=found))
    lines.append(tr("Rule: {rule}", rule=sheet.entry.rule))
    lines.append(tr("Made from: {source}", source=tr(sheet.entry.source)))
    lines.append(tr("Column {column} of {file}", column=column, file=tr(sheet.entry.file)))
    return "\n".join(filter(None, lines))


SIGNS = {
    "greater_than": (">", "min_value"),
    "greater_than_or_equal_to": ("≥", "min_value"),
    "less_than": ("<", "max_value"),
    "less_than_or_equal_to": ("≤", "max_value"),
}
"""Checks of a contract that bound a number, as pandera names them and their bound."""


def allowed_values(contract: pa.Column) -> str:
    """Write the range that a contract allows, such as ``≥ 0, ≤ 100``; empty if it has none."""
    parts = []
    for check in contract.checks:
        if check.name in SIGNS:
            sign, bound = SIGNS[check.name]
            parts.append(f"{sign} {check.statistics[bound]:g}")
        elif check.name == "isin":
            parts.append(
                ", ".join(
                    str(column_words(str(contract.name), one)) or tr("(empty)")
                    for one in check.statistics["allowed_values"]
                )
            )
    if contract.nullable:
        parts.append(tr("may be empty"))
    return ", ".join(parts)


def found_values(values: pd.Series[Any]) -> str:
    """Write the range of the numbers of a column, and how many are missing."""
    if pd.api.types.is_bool_dtype(values) or not pd.api.types.is_numeric_dtype(values):
        return ""
    numbers = values.dropna()
    if numbers.empty:
        return tr("no values") if len(values) else ""
    text = tr("{low} to {high}", low=f"{numbers.min():.6g}", high=f"{numbers.max():.6g}")
    if missing := len(values) - len(numbers):
        return tr(
            "{text}, {missing} of {total} empty", text=text, missing=missing, total=len(values)
        )
    return text
