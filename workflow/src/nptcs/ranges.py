"""The values that a quantity of a design can have, whatever is done with it later.

They are wide: they catch slips of units and signs (an angle of 300 degrees, a load in kN), not
unusual designs. What one solver can answer is narrower; that solver says so.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import inf, isfinite


@dataclass(frozen=True)
class Range:
    """An interval of numbers with their unit.

    Parameters
    ----------
    low, high : float
        Ends; infinite where there is none.
    unit : str
        Of the ends, for messages; may be empty.
    open_low, open_high : bool
        Whether that end itself is not allowed.

    Examples
    --------
    >>> Range(0, 20, "mm", open_low=True).fault(-1)
    'must be above 0 and at most 20 mm, got -1'
    >>> Range(0, 20, "mm", open_low=True).fault(1.8)
    ''
    """

    low: float = -inf
    high: float = inf
    unit: str = ""
    open_low: bool = False
    open_high: bool = False

    def __str__(self) -> str:
        closed = not (self.open_low or self.open_high)
        if closed and isfinite(self.low) and isfinite(self.high):
            words = f"between {self.low:g} and {self.high:g}"
        else:
            low = f"{'above' if self.open_low else 'at least'} {self.low:g}"
            high = f"{'below' if self.open_high else 'at most'} {self.high:g}"
            ends = [(self.low, low), (self.high, high)]
            words = " and ".join(text for end, text in ends if isfinite(end))
        return f"{words} {self.unit}".rstrip()

    def fault(self, value: float) -> str:
        """Say what is wrong with a value; empty if it is in the range."""
        above = value > self.low or (value == self.low and not self.open_low)
        below = value < self.high or (value == self.high and not self.open_high)
        return "" if isfinite(value) and above and below else f"must be {self}, got {value:g}"


RANGES: Mapping[str, Range] = {
    "spacing_mm": Range(0, 1000, "mm", open_low=True),
    "thickness_mm": Range(0, 20, "mm", open_low=True),
    "angle_deg": Range(-90, 90, "degrees"),
    "spoke_c10_mpa": Range(0, 1000, "MPa", open_low=True),
    "shear_band_c10_mpa": Range(0, 1000, "MPa", open_low=True),
    "load_n": Range(1, 100_000, "N"),
}
"""Allowed values of the factors of plates and rubbers, and of the load, by their column names."""
