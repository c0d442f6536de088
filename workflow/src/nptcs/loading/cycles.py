"""Loadings of a test: where it was loaded, unloaded and loaded again."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nptcs.arrays import Array

REVERSAL = 0.2
"""Share of the last rise that strain and force must lose before it counts as an unloading."""
SMALLEST_REVERSAL = 0.02
"""The same as a share of the channel's whole range: less is noise or a stick-slip."""


@dataclass(frozen=True)
class Loading:
    """Rows of one loading: the first, and the one after that of its largest force."""

    start: int
    stop: int

    @property
    def rows(self) -> slice:
        """As a slice."""
        return slice(self.start, self.stop)


def loadings(force: Array, strain: Array) -> list[Loading]:
    """Find the loadings of a test, in the order of time.

    A new loading begins where strain and force have both lost `REVERSAL` of what they had gained
    and then both gain again. A break (nothing is gained after it), a serrated force (the strain
    goes on) or a slipping gauge (the force goes on) does not begin one.

    Parameters
    ----------
    force : ndarray, shape (n,)
        Positive in the direction of the test; finite.
    strain : ndarray, shape (n,)
        Strain or travel in the same direction; NaN where there is none.

    Returns
    -------
    list of Loading
        At least one. Each ends with its largest force.
    """
    seen = np.isfinite(strain)
    rows = np.flatnonzero(seen) if seen.sum() >= 3 else np.arange(len(force))
    course = strain[rows] if seen.sum() >= 3 else force
    starts = [0]
    for peak, trough in _reversals(course):
        first, last = rows[peak], rows[trough]
        gained = force[first] - force[starts[-1]]
        lost = force[first] - force[first : last + 1].min()
        again = force[last:].max() - force[first : last + 1].min()
        floor = SMALLEST_REVERSAL * float(np.ptp(force))
        later = starts[-1] < last < len(force) - 1
        if later and min(lost, again) >= max(REVERSAL * gained, floor) > 0:
            starts.append(int(last))
    stops = [*starts[1:], len(force)]
    return [
        Loading(start, start + int(np.argmax(force[start:stop])) + 1)
        for start, stop in zip(starts, stops, strict=True)
    ]


def _reversals(course: Array) -> list[tuple[int, int]]:
    """Pairs (peak, trough) of a zigzag, each trough followed by a rise that counts."""
    floor = max(SMALLEST_REVERSAL * float(np.ptp(course)), 6.0 * noise_of(course))
    found: list[tuple[int, int]] = []
    low = peak = trough = 0
    falling = False
    for i, value in enumerate(course.tolist()):
        if not falling:
            if value > course[peak]:
                peak = i
            if course[peak] - value >= max(REVERSAL * (course[peak] - course[low]), floor):
                falling, trough = True, i
            continue
        if value < course[trough]:
            trough = i
        if value - course[trough] >= max(REVERSAL * (course[peak] - course[trough]), floor):
            found.append((peak, trough))
            falling, low, peak = False, trough, i
    return found


def noise_of(course: Array) -> float:
    """Return the standard deviation of the readings' noise, from their second differences.

    Parameters
    ----------
    course : ndarray, shape (n,)
        Finite readings in the order of time; fewer than five give 0.
    """
    if len(course) < 5:
        return 0.0
    # the median of |second difference| of a normal noise s is 0.6745 √6 s
    return float(np.median(np.abs(np.diff(course, 2)))) / (0.6745 * 6**0.5)
