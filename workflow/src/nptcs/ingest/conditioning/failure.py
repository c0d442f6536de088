"""Where a specimen breaks, as opposed to an unloading, or to a record that just ends."""

from __future__ import annotations

import numpy as np

from nptcs.arrays import Array
from nptcs.loading.failure import returns_at_one_speed, unloads_along

_SUDDEN_SHARE = 0.01
_FEWEST_SUDDEN = 3
_RETURNED = 0.1
_SMALL_PEAK = 0.5


def failure_row(
    force: Array, elongation: Array | None, drop: float, time_s: Array | None = None
) -> int | None:
    """Find the first reading after failure.

    A fall of the force by `drop` of its maximum is failure if it is sudden (within 1 % of the
    readings up to the maximum, at least three) or if the specimen does not shorten meanwhile. A
    gradual fall with a strain that goes back is an unloading: the search goes on after it, since
    the final pull of a cyclic test may stay below the first cycle.

    Parameters
    ----------
    force : ndarray, shape (n,)
        In any unit and sign; NaN are skipped.
    elongation : ndarray, shape (n,), or None
        Strain or travel in any unit and sign; None: only a sudden fall counts as failure.
    drop : float
        Share of the maximum.
    time_s : ndarray, shape (n,), optional
        Times of the readings, which tell whether a machine may return between two of them.

    Returns
    -------
    int or None
        None if no failure was recorded.
    """
    rows = np.flatnonzero(~np.isnan(force))
    load = np.abs(force[rows])
    stretch = None if elongation is None else elongation[rows]
    time = None if time_s is None else time_s[rows]
    start, highest = 0, float(load.max(initial=0.0))
    while start < len(load):
        peak = start + int(np.argmax(load[start:]))
        if load[peak] < _SMALL_PEAK * highest or not load[peak]:
            return None
        fallen = np.flatnonzero(load[peak:] < (1 - drop) * load[peak])
        if not len(fallen):
            return None
        end = peak + int(fallen[0])
        begin = peak + int(np.flatnonzero(load[peak:end] >= 0.95 * load[peak])[-1])
        back = stretch is not None and _goes_back(load, np.abs(stretch), begin, start, time)
        if not back and _is_failure(stretch, begin, end, peak):
            return int(rows[end])
        # to the end of the unloading: the rest of it is not another fall
        start = end
        while start + 1 < len(load) and load[start + 1] <= load[start]:
            start += 1
    return None


def _goes_back(load: Array, stretch: Array, begin: int, start: int, time_s: Array | None) -> bool:
    """Tell whether this is an unloading, elastic or of a softened specimen, however fast."""
    return unloads_along(load, stretch, begin, start, time_s) or returns_at_one_speed(
        load, stretch, begin, start
    )


def _is_failure(stretch: Array | None, begin: int, end: int, peak: int) -> bool:
    """Tell a failure from an unloading, by how fast the force falls and what the strain does."""
    if end - begin <= max(_FEWEST_SUDDEN, _SUDDEN_SHARE * peak):
        return True
    if stretch is None:
        return False
    before, during = stretch[: begin + 1], stretch[begin : end + 1]
    before, during = before[~np.isnan(before)], during[~np.isnan(during)]
    if len(before) < 2 or len(during) < 2:
        return False
    gained = during[0] - before[0]
    return bool((during[-1] - before[0]) * np.sign(gained) > (1 - _RETURNED) * abs(gained))
