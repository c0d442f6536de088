"""Tables whose columns use two decimal marks, rewritten with one."""

from __future__ import annotations

import re
from collections.abc import Sequence

_DELIMITERS = ("\t", ";", "|")
_PROBE = 20
_NUMBER = re.compile(r"[+-]?(?:\d+([.,])?\d*|([.,])\d+)(?:[eE][+-]?\d+)?", re.ASCII)
_THOUSANDS = re.compile(r"[+-]?[1-9]\d{0,2}[.,]\d{3}", re.ASCII)


def one_decimal_mark(lines: list[str]) -> tuple[list[str], str]:
    """Write a decimal point in every column of a table that has some with a comma.

    A spreadsheet writes such a file when some of its numbers are text. It is done only where the
    delimiter is neither of the two marks, each column has one mark throughout, and in each a
    number proves that its mark is not one of thousands (``0,5``, ``12.50``).

    Parameters
    ----------
    lines : list of str
        All lines of a file.

    Returns
    -------
    lines : list of str
        The same, or with the commas of the rows of numbers replaced.
    note : str
        What was done; empty if nothing.
    """
    start = max(len(lines) // 2 - _PROBE // 2, 0)
    probe = [line for line in lines[start : start + _PROBE] if line.strip()]
    if len(probe) < 3 or "," not in probe[0] or "." not in probe[0]:
        return lines, ""
    for delimiter in _DELIMITERS:
        width = probe[0].count(delimiter) + 1
        if width < 2 or not _is_mixed([line.split(delimiter) for line in probe], width):
            continue
        rows = {
            row: cells
            for row, line in enumerate(lines)
            if line.count(delimiter) == width - 1 and _is_row(cells := line.split(delimiter))
        }
        if _is_mixed(list(rows.values()), width, proven=True):
            changed = list(lines)
            for row, cells in rows.items():
                changed[row] = delimiter.join(cells).replace(",", ".")
            note = "columns with a decimal point and with a comma: each read with its own mark"
            return changed, note
    return lines, ""


def _is_row(cells: Sequence[str]) -> bool:
    filled = [cell.strip() for cell in cells if cell.strip()]
    return len(filled) >= 2 and all(map(_NUMBER.fullmatch, filled))


def _is_mixed(rows: Sequence[Sequence[str]], width: int, proven: bool = False) -> bool:
    """Tell whether each column has one decimal mark and not all have the same."""
    marks: list[str] = []
    for place in range(width):
        cells = [row[place].strip() for row in rows if place < len(row)]
        found = {mark for cell in cells for mark in ".," if mark in cell}
        if len(found) > 1 or not all(cell == "" or _NUMBER.fullmatch(cell) for cell in cells):
            return False
        if not found:
            continue
        if proven and all(_THOUSANDS.fullmatch(cell) for cell in cells if found & set(cell)):
            return False
        marks += found
    return len(set(marks)) == 2
