"""Columns of a workbook whose numbers are stored as text, with or without a unit after them."""

from __future__ import annotations

import re
from collections.abc import Sequence

from nptcs.ingest.reading.native.sheet_cells import WithUnit
from nptcs.ingest.reading.text.dressed_rows import unit_behind_number

_NUMBER = re.compile(r"[+-]?(?:\d+([.,])?\d*|([.,])\d+)(?:[eE][+-]?\d+)?", re.ASCII)
_MAY_BE_THOUSANDS = re.compile(r"[+-]?[1-9]\d{0,2},\d{3}")
FEWEST = 5

Row = tuple[object, ...]


def numbers_of_texts(rows: list[Row]) -> tuple[list[Row], str]:
    """Turn the cells of columns that contain numbers only as text into numbers.

    All such cells of a sheet must have the same decimal mark, and if it is a comma, one of them
    must prove that it is not a thousands mark; otherwise they stay text, which reading refuses. A
    lone text among numbers stays, too: it is somebody's typing error.

    Returns
    -------
    rows : list of tuple
        The same rows, or copies with numbers.
    note : str
        What was done; empty if nothing.
    """
    columns = [column for column in _text_columns(rows) if len(column) >= FEWEST]
    cells = [_bare(rows[row][place]) for column in columns for row, place in column]
    marks = {mark for cell in cells for mark in ".," if mark in cell}
    unproven = all(_MAY_BE_THOUSANDS.fullmatch(cell) for cell in cells if "," in cell)
    if not cells or len(marks) > 1 or ("," in marks and unproven):
        return rows, ""
    changed = [list(row) for row in rows]
    for column in columns:
        for row, place in column:
            changed[row][place] = _number(rows[row][place])
    mark = f", decimal mark '{next(iter(marks))}'" if marks else ""
    note = f"{len(columns)} columns hold numbers stored as text{mark}"
    return [tuple(row) for row in changed], note


def _text_columns(rows: Sequence[Row]) -> list[list[tuple[int, int]]]:
    """Places of the numbers in each column that contains them as text, not as numbers."""
    found: list[list[tuple[int, int]]] = []
    for place in range(max(map(len, rows), default=0)):
        cells = [(row, cells[place]) for row, cells in enumerate(rows) if place < len(cells)]
        if any(isinstance(cell, int | float) and not isinstance(cell, bool) for _, cell in cells):
            continue
        found.append(
            [
                (row, place)
                for row, cell in cells
                if isinstance(cell, str) and _NUMBER.fullmatch(_bare(cell))
            ]
        )
    return found


def _bare(cell: object) -> str:
    """Text of a cell without the unit after its number."""
    text = str(cell).strip()
    unit = unit_behind_number(text)
    return text[: -len(unit)].strip() if unit else text


def _number(cell: object) -> float:
    number = WithUnit(_bare(cell).replace(",", "."))
    number.unit = unit_behind_number(str(cell).strip())
    return number if number.unit else float(number)
