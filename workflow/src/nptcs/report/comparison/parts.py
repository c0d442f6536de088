"""The parts of a comparison as tables of the report: entries, numbers, marks of rows."""

from __future__ import annotations

from typing import assert_never

import pandas as pd

from nptcs.language import tr, translatable
from nptcs.report.table_view import COLUMN_NAMES, SENTENCE
from nptcs.report.tables.entries import Entry
from nptcs.report.tables.headings import heading
from nptcs.report.tables.row_classes import Row
from nptcs.report.tables.sheets import Sheet
from nptcs.runs.part import RESULT, Found, Part
from nptcs.tables.result_table import Heading

TITLE = translatable("Comparison of two runs")
SIDES = ("a", "b")


KINDS = {
    "columns_only": COLUMN_NAMES,
    "constant": "property",
    "largest_in": COLUMN_NAMES,
    "note": SENTENCE,
    "numbers_missing_in_one": COLUMN_NAMES,
    "texts_that_differ": COLUMN_NAMES,
    "what": COLUMN_NAMES,
}
"""Kinds of the columns of a comparison that the report does not have."""


def part_sheet(part: Part, synthetic: bool) -> Sheet:
    """Return a part as a table of the report: rows that differ are marked."""
    columns = map(str, part.table.columns)
    sides = {name: side for name in columns if (side := side_heading(name)) is not None}
    headings = {**sides, **part.headings}
    entry = Entry(
        part.name, part.title, tr("(this comparison)"), "nptcs compare", part.about, headings
    )
    table = part.table.assign(**{RESULT: part.table[RESULT].map(str)})
    return Sheet(entry, table.astype(_numbers(table)), mark_row, synthetic)


def side_heading(column: str) -> Heading | None:
    """Write the heading of a column that holds the values of one run, with a capital A or B.

    Examples
    --------
    >>> side_heading("stiffness_a_n_per_mm"), side_heading("b"), side_heading("note")
    (Heading(name='stiffness A', unit='N/mm'), Heading(name='B', unit=''), None)
    """
    words_of = column.split("_")
    side = next((letter for letter in SIDES if letter in words_of), None)
    if side is None:
        return None
    rest = "_".join(word for word in words_of if word != side)
    written = heading(rest)
    return Heading(f"{written.name} {side.upper()}".strip(), written.unit)


def cell_kind(column: str, row: Row) -> str:
    """Name the column of the report whose words a cell holds, whichever run it is of.

    Examples
    --------
    >>> cell_kind("design_a", {}), cell_kind("b", {"what": "goals"})
    ('design', 'goals')
    """
    if column in SIDES and "what" in row:
        return str(row["what"])
    base = "_".join(word for word in column.split("_") if word not in SIDES)
    return KINDS.get(base, base)


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
        case found:
            assert_never(found)
