"""How numbers are shown: by the unit of the column, its kind, and the size of its values.

A cell always contains the number to 16 digits; its format only says how many of them are shown.
"""

from __future__ import annotations

from math import floor, isfinite, log10

import numpy as np
import pandas as pd

WHOLE = "#,##0"
SCIENTIFIC = "0.0000E+00"
EXACT = "0.0000000000E+00"
"""Format of coefficients: a reader evaluates a polynomial with them."""

DIGITS = 5
"""Significant digits of a typical value of a column."""

MOST_DECIMALS = {
    "N/mm": 3,
    "(N/mm)²": 3,
    "N/mm²": 4,
    "MPa": 4,
    "GPa": 4,
    "N": 2,
    "mm": 4,
    "mm²": 3,
    "°": 3,
    "°C": 1,
    "%": 3,
    "s": 3,
    "Hz": 2,
    "bytes": 0,
    "kg": 4,
}
"""Decimals beyond which a value in this unit has no meaning; other units have `MOST`."""

MOST = 7
SPREAD = 1e6
"""Values of one column that differ by more than this factor are shown in scientific notation."""

BY_ROW = ("unit of the row", "unit of the factor")
"""Units of columns in which each row has its own unit."""


def format_of_column(unit: str, values: pd.Series[float]) -> str | None:
    """Choose the number format of a column.

    Parameters
    ----------
    unit : str
        As the heading states it.
    values : Series
        Values of the column.

    Returns
    -------
    str or None
        A number format; none for text, and for numbers whose unit is that of the row
        (`format_of_number`).

    Examples
    --------
    >>> format_of_column("N/mm", pd.Series([297.81, 263.73]))
    '#,##0.00'
    >>> format_of_column("mm", pd.Series([10.0, 15.0, 20.0]))
    '#,##0'
    >>> format_of_column("", pd.Series([1e-9, 0.5]))
    '0.0000E+00'
    """
    if pd.api.types.is_bool_dtype(values) or not pd.api.types.is_numeric_dtype(values):
        return None
    if pd.api.types.is_integer_dtype(values):
        return WHOLE
    if unit in BY_ROW:
        return None
    if "of the term" in unit:
        return EXACT
    sizes = np.abs(values.dropna().to_numpy(float))
    sizes = sizes[np.isfinite(sizes) & (sizes > 0)]
    if not sizes.size:
        return WHOLE
    if sizes.max() > SPREAD * np.quantile(sizes, 0.1, method="lower"):
        return SCIENTIFIC
    most = MOST_DECIMALS.get(unit, MOST)
    decimals = min(most, max(0, DIGITS - 1 - _exponent(float(np.median(sizes)))))
    return _fixed(min(decimals, _exact_decimals(sizes, decimals)))


def format_of_number(value: float) -> str:
    """Choose the format of a number whose unit is that of its row.

    Examples
    --------
    >>> format_of_number(298.40378), format_of_number(0.927082), format_of_number(1.3e-8)
    ('#,##0.00', '#,##0.00000', '0.0000E+00')
    """
    if not isfinite(value) or value == 0:
        return "General"
    exponent = _exponent(abs(value))
    if not -5 <= exponent <= 9:
        return SCIENTIFIC
    decimals = max(0, DIGITS - 1 - exponent)
    size = abs(value)
    exact = (
        least
        for least in range(decimals)
        if abs(round(size * 10.0**least) / 10.0**least - size) <= 1e-12 * size
    )
    return _fixed(next(exact, decimals))


def shown_number(value: float, number_format: str) -> str:
    """Write a number as a sheet shows it, for the width of its column.

    Examples
    --------
    >>> shown_number(127742.123, "#,##0.00"), shown_number(0.00012, "0.0000E+00")
    ('127,742.12', '1.2000E-04')
    """
    if number_format == "General":
        return f"{value:.10g}"
    decimals = number_format.partition(".")[2].partition("E")[0].count("0")
    return f"{value:.{decimals}E}" if "E" in number_format else f"{value:,.{decimals}f}"


def _exponent(value: float) -> int:
    return floor(log10(value))


def _exact_decimals(sizes: np.ndarray[tuple[int, ...], np.dtype[np.float64]], most: int) -> int:
    """Return the fewest decimals that show every value exactly, at most `most`."""
    for decimals in range(most):
        if (np.abs(np.round(sizes, decimals) - sizes) <= 1e-12 * sizes).all():
            return decimals
    return most


def _fixed(decimals: int) -> str:
    return WHOLE + ("." + "0" * decimals if decimals else "")
