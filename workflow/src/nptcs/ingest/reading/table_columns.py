"""The tables of a file: where each begins and ends, its names and its units."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field

from nptcs.ingest.reading.profiles import normalise
from nptcs.ingest.reading.unit_in_name import NO_UNIT, split_unit
from nptcs.ingest.reading.units import is_unit

SMALLEST_TABLE = 5
"""Rows that a table must have to be a test."""


_TYPES = frozenset(
    ["float", "float32", "float64", "double", "real", "int", "integer", "numeric", "number", "dbl"]
)

_TEST_NUMBER = re.compile(r"\d+ *[_-] *\d+")
"""How Trapezium labels the columns of a test: batch and specimen."""


@dataclass
class Column:
    """One column: its position from 0, its name and unit as found, the group above it.

    `clock` says that its cells are times of day; `unit_of_name` is the unit in its name where a row
    of units states another one.
    """

    position: int
    name: str
    unit: str | None = None
    group: str = ""
    clock: bool = False
    unit_of_name: str | None = None


@dataclass
class FoundTable:
    """One table: the rows [first, last) of the file (from 0) and its columns.

    `notes` say how it was read, `doubts` what was assumed and is flagged with every result.
    """

    first: int
    last: int
    width: int
    columns: list[Column] = field(default_factory=list)
    names_row: int | None = None
    part: str = ""
    notes: list[str] = field(default_factory=list)
    doubts: list[str] = field(default_factory=list)
    rows_of_data: list[int] = field(default_factory=list)
    unnamed_at_end: int = 0
    broken: list[int] = field(default_factory=list)

    @property
    def end_of_head(self) -> int:
        """Row of the names; of the first readings where there are no names."""
        return self.first if self.names_row is None else self.names_row


def describe_columns(
    found_table: FoundTable, above: Sequence[tuple[int, list[str]]], unnamed: str
) -> None:
    """Find names, units and groups in the rows above a table and note them in `found_table`.

    Parameters
    ----------
    found_table : FoundTable
        Gets ``columns``, ``names_row`` and ``notes``.
    above : sequence of (int, list of str)
        The filled rows above it with their numbers, nearest first; four are enough.
    unnamed : str
        ``first`` or ``last``: where columns without a name are; empty: not declared.
    """
    rows = [(row, cells) for row, cells in above if not _is_row_of_types(cells)]
    units: list[str] = []
    if rows and _is_unit_row(rows[0][1], found_table.width):
        units = rows.pop(0)[1]
    if not rows or not _is_names_row(rows[0][1]):
        found_table.columns = [
            Column(position, "", _cell(units, position) or None)
            for position in range(found_table.width)
        ]
        return
    found_table.names_row, names = rows.pop(0)
    shift = _shift(found_table, names, unnamed)
    if not units and rows and _holds_units_only(rows[0][1], found_table.width):
        units = rows.pop(0)[1]
    groups = _groups(rows[0][1], len(names)) if rows else []
    for position in range(found_table.width):
        own = _cell(rows[0][1], position - shift) if rows and groups else ""
        text = _cell(names, position - shift) or own
        name, unit = split_unit(text)
        stated = _cell(units, position - shift) or unit
        column = Column(position, name, stated, _cell(groups, position - shift))
        if unit != stated and (unit or "").casefold() not in NO_UNIT:  # 'Ext. 1 (Strain)' above %
            column.unit_of_name = unit
        found_table.columns.append(column)


def _cell(cells: Sequence[str], position: int) -> str:
    return cells[position].strip() if 0 <= position < len(cells) else ""


def _is_unit_row(cells: list[str], width: int) -> bool:
    filled = [cell for cell in cells if cell.strip()]
    known = sum(is_unit(cell) or not cell.strip("()[] ") for cell in filled)
    return bool(filled) and known >= max(1, 0.6 * len(filled)) and len(cells) <= width + 2


def _holds_units_only(cells: list[str], width: int) -> bool:
    """Tell units above the names from an entry of the head, such as ``Thickness, 1, mm``."""
    return _is_unit_row(cells, width) and all(
        is_unit(cell) or not cell.strip("()[] ") for cell in cells if cell.strip()
    )


def _is_row_of_types(cells: Sequence[str]) -> bool:
    """Tell whether a row says how a database stores its columns."""
    filled = [cell.strip().casefold() for cell in cells if cell.strip()]
    return bool(filled) and all(cell in _TYPES for cell in filled)


def _is_names_row(cells: list[str]) -> bool:
    return any(any(letter.isalpha() or letter == "%" for letter in cell) for cell in cells)


def _shift(found_table: FoundTable, names: list[str], unnamed: str) -> int:
    """Count the columns without a name before the first name."""
    while names and not names[-1].strip():
        names.pop()
    surplus = found_table.width - len(names)
    if surplus <= 0:
        return 0
    if unnamed == "first":
        return surplus
    found_table.unnamed_at_end = surplus
    return 0


def _groups(cells: list[str], width: int) -> list[str]:
    """Labels above the names, carried on to the right, if the row is one of labels."""
    filled = [cell for cell in cells if cell.strip()]
    if not filled or len(cells) < max(2, width - 1) or any(is_unit(cell) for cell in filled):
        return []
    if any(cell.endswith(":") for cell in filled):
        return []  # a header entry, such as 'Speed: 500'
    numbered = len(filled) > 1 and all(_TEST_NUMBER.fullmatch(cell) for cell in filled)
    if not numbered and not all(any(mark.isalpha() for mark in cell) for cell in filled):
        return []  # the same without a colon
    labels, label = [], ""
    for position in range(width):
        label = _cell(cells, position) or label
        labels.append(label)
    return labels


def repeated_columns(columns: Sequence[Column]) -> list[str]:
    """Find groups of equal names next to each other: one test each.

    Returns
    -------
    list of str
        Part of each column: the label above it, or the number of the repetition; empty for a
        column whose name is not repeated.
    """
    names = [normalise(column.name) for column in columns]
    repeated = {name for name in names if name and names.count(name) > 1}
    seen: dict[str, int] = {}
    parts = []
    for column, name in zip(columns, names, strict=True):
        if name not in repeated:
            parts.append("")
            continue
        seen[name] = seen.get(name, 0) + 1
        parts.append(column.group or str(seen[name]))
    return parts
