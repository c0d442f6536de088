"""A toe, or slack, that reaches into the range of a modulus: the curve is steeper above it."""

from __future__ import annotations

import numpy as np

from nptcs.arrays import Array
from nptcs.reduce.curve.chord import Line, fit_line

NO_LAMINATE = 1.5
"""Ratio of slopes within a range that no laminate shows, but slack or a toe does."""
STEEPER = 0.03
"""Share by which a curve may be steeper above the range without a remark: less than the
repeatability of a modulus in a laboratory."""
CARBON = 20.0
"""Stiffening of carbon fibres, by some 20 % per percent of strain: share per unit of strain."""
CLEAR = 3.0
"""A difference of slopes counts beyond this many of its standard errors."""
UPPER = (0.4, 0.65, 0.9)
"""Shares of the largest strain that bound the two parts of the curve above the range."""
FEWEST = 4


def stiffening(strain: Array, stress: Array, low: float, high: float) -> float:
    """Slope in the upper half of a range over that in the lower half; 1 where it is not clear."""
    middle = (low + high) / 2
    ratio, error = _ratio(_line(strain, stress, low, middle), _line(strain, stress, middle, high))
    return ratio if ratio - 1 > CLEAR * error else 1.0


def toe_words(strain: Array, stress: Array, low: float, high: float) -> list[str]:
    """Say that a toe may reach into the range: seen within it, or against the curve above it.

    Fibres stiffen, too, but go on doing so, while above a toe the curve is straight. Where it
    clearly does not stiffen from one part above the range to the other, it may be steeper there
    than within the range by `STEEPER`; otherwise by `STEEPER` and what carbon fibres add over
    that strain.

    Parameters
    ----------
    strain, stress : ndarray, shape (n,)
        Loading branch in the order of recording, finite.
    low, high : float
        Range of the modulus.
    """
    within = stiffening(strain, stress, low, high)
    if within - 1 > STEEPER + CARBON * (high - low) / 2:
        by = f"{100 * (within - 1):.2g} %"
        return [f"the curve stiffens by {by} within the range: a toe may remain"]
    if not len(strain):
        return []
    # above the range, up to where the last readings before failure begin
    top = float(strain[int(np.argmax(stress))])
    begin, middle, end = (max(share * top, high) for share in UPPER)
    own, above = _line(strain, stress, low, high), _line(strain, stress, begin, end)
    ratio, error = _ratio(own, above)
    goes_on = _goes_on(_line(strain, stress, begin, middle), _line(strain, stress, middle, end))
    natural = CARBON * ((begin + end) / 2 - (low + high) / 2) if goes_on else 0.0
    if not ratio - 1 > max(STEEPER + natural, CLEAR * error):
        return []
    return [
        f"the curve is {100 * (ratio - 1):.2g} % steeper above the range (strain {begin:.3g} to "
        f"{end:.3g}) than within it: a toe may reach into the range"
    ]


def _line(strain: Array, stress: Array, low: float, high: float) -> Line | None:
    rows = (strain >= low) & (strain <= high)
    if rows.sum() < FEWEST or not np.ptp(strain[rows]):
        return None
    return fit_line(strain[rows], stress[rows])


def _ratio(lower: Line | None, upper: Line | None) -> tuple[float, float]:
    """Slope of the upper line over that of the lower one, and its standard error; 1 if unknown."""
    if lower is None or upper is None:
        return 1.0, 0.0
    if not lower.slope > 0:
        return float("inf"), 0.0
    ratio = upper.slope / lower.slope
    errors = (lower.slope_error / lower.slope, upper.slope_error / lower.slope)
    return ratio, float(np.hypot(ratio * errors[0], errors[1]))


def _goes_on(lower: Line | None, upper: Line | None) -> bool:
    """Tell whether the curve may still stiffen from one part to the other, as fibres do."""
    ratio, error = _ratio(lower, upper)
    known = lower is not None and upper is not None
    return not known or ratio - 1 + CLEAR * error > STEEPER
