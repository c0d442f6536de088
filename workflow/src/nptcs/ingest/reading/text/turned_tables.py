"""Tables that are written along the rows: a name, then all of its readings."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

_FEWEST_READINGS = 20
_MOST_ROWS = 60
_DELIMITERS = (";", "\t", ",")
_NUMBER = re.compile(r"\s*[+-]?(?:\d+[.,]?\d*|[.,]\d+)(?:[eE][+-]?\d+)?\s*", re.ASCII)
NOTE = "the table is written along the rows, one quantity per row: transposed"


def upright_lines(lines: list[str]) -> list[str]:
    """Turn a text of a few long rows, such as ``Load (N);0;12.5;…``, into one of columns.

    Returns
    -------
    list of str
        `lines` itself where they are not such a table.
    """
    if len(lines) > _MOST_ROWS:
        return lines
    filled = [line for line in lines if line.strip()]
    for delimiter in _DELIMITERS:
        rows = [line.split(delimiter) for line in filled]
        turned = upright_rows(rows, lambda cell: bool(_NUMBER.fullmatch(str(cell))))
        if turned is not rows:
            return [delimiter.join(map(str, row)) for row in turned]
    return lines


def upright_rows(
    rows: Sequence[Sequence[object]], is_number: Callable[[object], bool]
) -> Sequence[Sequence[object]]:
    """Turn the rows that begin with a name, or name and unit, and go on with numbers.

    Parameters
    ----------
    rows : sequence of sequences
        Cells of each row.
    is_number : callable
        Whether a cell is a number.

    Returns
    -------
    sequence of sequences
        What is above these rows, then a row for each reading; `rows` itself if they are not such
        a table.
    """
    if not 2 <= len(rows) <= _MOST_ROWS:
        return rows
    labels = [_labels(row, is_number) for row in rows]
    first = next((row for row, count in enumerate(labels) if count), None)
    if first is None:
        return rows
    block = []
    for row, count in zip(rows[first:], labels[first:], strict=True):
        if count != labels[first]:
            break
        block.append(list(_trimmed(row)))
    lengths = {len(row) for row in block}
    if len(block) < 2 or len(lengths) > 1:
        return rows
    return [*rows[:first], *map(list, zip(*block, strict=True))]


def _trimmed(row: Sequence[object]) -> Sequence[object]:
    """Leave out the empty cells at the end of a row."""
    end = len(row)
    while end and (row[end - 1] is None or not str(row[end - 1]).strip()):
        end -= 1
    return row[:end]


def _labels(row: Sequence[object], is_number: Callable[[object], bool]) -> int:
    """Count the texts before the numbers of such a row: 1 or 2; 0 if it is not one."""
    cells = _trimmed(row)
    texts = next((place for place, cell in enumerate(cells) if is_number(cell)), 0)
    if texts not in (1, 2) or len(cells) - texts < _FEWEST_READINGS:
        return 0
    named = all(isinstance(cell, str) and cell.strip() for cell in cells[:texts])
    return texts if named and all(map(is_number, cells[texts:])) else 0
