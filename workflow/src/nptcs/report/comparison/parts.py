"""The parts of a comparison as tables of the report: entries, numbers, marks of rows."""

from __future__ import annotations

import pandas as pd

from nptcs.report.tables.entries import Entry
from nptcs.report.tables.row_classes import Row
from nptcs.report.tables.sheets import Sheet
from nptcs.runs.part import RESULT, Found, Part

TITLE = "Comparison of two runs"


def part_sheet(part: Part, synthetic: bool) -> Sheet:
    """Return a part as a table of the report: rows that differ are marked."""
    entry = Entry(
        part.name, part.title, "(this comparison)", "nptcs compare", part.about, part.headings
    )
    table = part.table.assign(**{RESULT: part.table[RESULT].map(str)})
    return Sheet(entry, table.astype(_numbers(table)), mark_row, synthetic)


def _numbers(table: pd.DataFrame) -> dict[str, type[float]]:
    """Return the columns whose values are all numbers or missing, as numbers."""
    found = {}
    for name in table.columns:
        values = table[name].dropna()
        if len(values) and values.map(lambda value: isinstance(value, int | float)).all():
            found[str(name)] = float
    return found


def mark_row(row: Row) -> str:
    """Mark what differs, and what could not be compared."""
    match Found(str(row[RESULT])):
        case Found.SAME:
            return ""
        case Found.DIFFERENT:
            return "bad" if row.get("beyond_uncertainty") == "yes" else "warn"
        case Found.ONLY_A | Found.ONLY_B | Found.NOT_COMPARED:
            return "out"
