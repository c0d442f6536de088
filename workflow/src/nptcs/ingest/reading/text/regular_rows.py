"""Rows of a text that are all numbers, checked many at a time."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import lru_cache

import numpy as np
import numpy.typing as npt

from nptcs.ingest.reading.text.dialect import Dialect

_HEAD, _CHUNK, _TAIL = 60, 5000, 20
_NEWLINE = 10


def chunk_edges(lines: int) -> list[int]:
    """Edges of the chunks that are checked together, head and tail apart.

    A chunk that is not regular is read line by line; a header should not make a long one irregular.
    """
    inner = range(min(_HEAD, lines), max(lines - _TAIL, _HEAD), _CHUNK)
    return sorted({0, *inner, max(lines - _TAIL, 0), lines})


def regular_width(lines: Sequence[str], dialect: Dialect) -> int:
    """Return the number of cells of each line, if every cell of every line is a bare number.

    The same grammar as that of a single number (sign, digits, decimal mark, exponent), but for
    all lines in a few passes over their bytes.

    Returns
    -------
    int
        0 if the lines are not regular, or the dialect needs quotes or groups digits by blanks.
    """
    if len(dialect.delimiter) > 1 or dialect.delimiter in (dialect.decimal, dialect.thousands):
        return 0
    text = "\n" + "\n".join(lines) + "\n"
    allowed, odd = _grammar(dialect.delimiter, dialect.decimal)
    raw = text.encode()
    if len(raw) != len(text) or raw.translate(None, allowed):
        return 0
    data = np.frombuffer(raw, dtype=np.uint8)
    decimal = ord(dialect.decimal)
    if "e" in text or "E" in text:
        if odd.search(text):
            return 0
    elif _odd_sign(data, ord(dialect.delimiter), decimal):
        return 0
    marks = np.flatnonzero(
        (data == ord(dialect.delimiter)) | (data == _NEWLINE) | (data == decimal)
    )
    is_decimal = data[marks] == decimal
    if (is_decimal[1:] & is_decimal[:-1]).any():
        return 0  # two decimal marks in one cell
    bounds = marks[~is_decimal]
    lengths = np.diff(bounds) - 1
    if not (lengths > 0).all():
        return 0
    lone = is_decimal[1:-1] & (np.diff(marks)[:-1] == 1) & (np.diff(marks)[1:] == 1)
    if lone.any():
        return 0  # a decimal mark without a digit
    ends = np.flatnonzero(data[bounds] == _NEWLINE)
    widths = np.diff(ends)
    return int(widths[0]) if (widths == widths[0]).all() else 0


def _odd_sign(data: npt.NDArray[np.uint8], delimiter: int, decimal: int) -> bool:
    """Tell whether a sign does not begin a number; there are no exponents."""
    signs = np.flatnonzero((data == ord("+")) | (data == ord("-")))
    before, after = data[signs - 1], data[signs + 1]
    begins = (before == delimiter) | (before == _NEWLINE)
    digit = (after >= ord("0")) & (after <= ord("9"))
    second = data[np.minimum(signs + 2, len(data) - 1)]
    fraction = (after == decimal) & (second >= ord("0")) & (second <= ord("9"))
    return not (begins & (digit | fraction)).all()


@lru_cache
def _grammar(delimiter: str, decimal: str) -> tuple[bytes, re.Pattern[str]]:
    """Bytes that may occur, and what signs and exponents must not look like."""
    allowed = f"0123456789+-eE{decimal}{delimiter}\n".encode()
    d, point = re.escape(delimiter), re.escape(decimal)
    sign = rf"(?<=[+\-])(?:(?<![{d}\neE][+\-])|(?!\d|{point}\d))"
    exponent = rf"(?<=[eE])(?:(?<!\d[eE])(?<!\d{point}[eE])|(?![+\-]?\d)|(?=[^{d}\n]*[eE{point}]))"
    return allowed, re.compile(rf"[+\-eE](?:{sign}|{exponent})")
