"""Leaps of a strain within the range of a slope: a gauge that slipped a little."""

from __future__ import annotations

import numpy as np

from nptcs.arrays import Array
from nptcs.reduce.curve.chord import fit_line

SMALLEST_SHARE = 0.03
"""Share of the range: a smaller leap changes the slope by less than its repeatability."""
CLEAR = 6.0
"""A leap exceeds this many standard deviations of the other steps."""
FEWEST = 20


def leap_within(
    strain: Array, stress: Array, low: float, high: float, *, of_both: bool = False
) -> str:
    """Say where a strain leaps within a range while the stress does not.

    Each reading is compared with the one a fiftieth of the range's readings before it. A strain
    that grows in coarse steps of the logger leaps many times, and is not reported.

    Parameters
    ----------
    strain, stress : ndarray, shape (n,)
        Loading branch in the order of recording, finite.
    low, high : float
        Range of strain.
    of_both : bool
        Whether `stress` is a strain, too, whose leaps count as well.

    Returns
    -------
    str
        The reason not to take a slope; empty where nothing leaps.
    """
    if len(strain) < FEWEST:
        return ""
    stop = int(np.argmax(strain >= high)) + 1 if strain.max(initial=0) >= high else len(strain)
    begin = int(np.argmax(strain >= low)) if strain.max(initial=0) >= low else stop
    x, y = strain[begin:stop], stress[begin:stop]
    if len(x) < FEWEST or not np.ptp(x):
        return ""
    line = fit_line(x, y)
    lag = max(1, len(x) // 50)
    step = x[lag:] - x[:-lag]
    apart = step - (y[lag:] - y[:-lag]) / line.slope if line.slope > 0 else step
    place = int(np.argmax(np.abs(apart)))
    size = abs(float(apart[place]))
    others = np.abs(np.arange(len(apart)) - place) > lag
    usual = float(np.median(step[others])) if others.any() else 0.0
    many = int((np.abs(apart[others]) > size / 2).sum())
    clear = others.any() and size > CLEAR * float(np.std(apart[others])) and not many
    own = of_both or abs(float(step[place]) - usual) > size / 2
    if clear and own and size > SMALLEST_SHARE * (high - low):
        return f"the strain leaps by {size:.2g} at {x[place]:.4g}, within the range: a slip"
    return ""
