"""Numbers and lists in words, as the report prints them."""

from __future__ import annotations

import math
import re
import unicodedata
from collections.abc import Iterable

from nptcs.language import tr

DIGITS = 5
"""Significant digits of numbers in the report; the CSV files and the workbook have all digits."""


def number_text(value: float, digits: int = DIGITS) -> str:
    """Write a number to some significant digits; digits before the point are never dropped."""
    if not math.isfinite(value):
        return "–" if math.isnan(value) else str(value)
    if float(value).is_integer() and abs(value) < 1e15:
        return str(int(value))
    text = f"{value:.{digits}g}"
    return f"{value:.0f}" if "e+" in text and abs(value) < 1e9 else text


def with_error(value: float, error: float | None, unit: str = "1") -> str:
    """Write a value and its standard error to the error's second significant digit."""
    suffix = "" if unit == "1" else f" {unit}"
    if error is None or not error > 0:
        return f"{value:.4g}{suffix}"
    return f"{rounded(value, error)} ± {rounded(error, error)}{suffix}"


def decimals_by(error: float) -> int:
    """Return the decimals that show the second significant digit of an error; negative: tens."""
    return 1 - math.floor(math.log10(error))


def rounded(value: float, error: float | None) -> str:
    """Write a value to the second significant digit of its error.

    Examples
    --------
    >>> rounded(263.71441528, 2.79)
    '263.7'
    >>> rounded(127741.96, 2042.8)
    '127700'
    """
    if error is None or not 0 < error < math.inf or not math.isfinite(value):
        return number_text(value)
    decimals = decimals_by(error)
    return f"{round(value, decimals):.{max(0, decimals)}f}"


WIDE = 1.75
"""Width of a Chinese character, in characters of Latin text."""


PIECE = re.compile(r"\s*(?:[\u2e80-\u9fff]|[^\s\u2e80-\u9fff]+)")
"""A blank with what follows it: a Chinese character, or a run of others without a blank."""

CLOSING = "，。；：）、"
"""Signs that must not begin a line."""


def is_wide(character: str) -> bool:
    """Tell whether a character is as wide as it is high, like Chinese ones."""
    return unicodedata.east_asian_width(character) in "WF"


def text_width(text: str) -> float:
    """Return the width of a text in characters of Latin text.

    Examples
    --------
    >>> text_width("T 1.8 mm"), text_width("板厚 T")
    (8.0, 5.5)
    """
    if text.isascii():
        return float(len(text))
    return float(sum(WIDE if is_wide(character) else 1 for character in text))


def wrapped(text: str, width: int) -> str:
    r"""Break a text into lines: at blanks, and anywhere next to a Chinese character.

    Examples
    --------
    >>> wrapped("Impact of each factor", 12)
    'Impact of\neach factor'
    >>> wrapped("各因子对刚度的影响", 10)
    '各因子对刚\n度的影响'
    """
    pieces = PIECE.findall(text)
    lines: list[str] = [""]
    for piece in pieces:
        if lines[-1] and text_width(lines[-1] + piece) > width and piece[:1] not in CLOSING:
            lines.append(piece.lstrip())
        else:
            lines[-1] += piece
    return "\n".join(lines)


def joined(words: Iterable[str]) -> str:
    """Join words as ``a, b and c``."""
    parts = list(words)
    if len(parts) < 2:
        return "".join(parts)
    return tr("{several} and {last}", several=tr(", ").join(parts[:-1]), last=parts[-1])
