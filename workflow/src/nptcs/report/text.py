"""Numbers and lists in words, as the report prints them."""

from __future__ import annotations

import math
from collections.abc import Iterable

from nptcs.language import tr

DIGITS = 5
"""Significant digits of numbers in the report; the CSV files and the workbook have all."""


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


def joined(words: Iterable[str]) -> str:
    """Join words as ``a, b and c``."""
    parts = list(words)
    if len(parts) < 2:
        return "".join(parts)
    return tr("{several} and {last}", several=tr(", ").join(parts[:-1]), last=parts[-1])
