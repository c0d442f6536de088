"""Evidence of failure: a specimen that failed, or a test that was stopped before it did."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nptcs.arrays import Array
from nptcs.loading.cycles import loadings

SMALLEST_DROP = 0.1
"""Share of its largest value that the force must lose: less is noise, relaxation or a slip."""
ABRUPT = 10.0
"""A force that falls this many times faster than it rose is not an unloading by the machine, ..."""
SNAP = 100.0
"""... and this many times even where the strain goes back with it."""
ELASTIC, TOO_LITTLE = 0.7, 0.5
"""Shares of the strain that an elastic unloading gives back: from the first share on, a fall is an
unloading; below the second it is not, since nothing unloads twice as stiffly as it was loaded."""
UNLOADING_ROWS = 4
"""Readings over which strain and force go back together when the machine unloads."""
SLOW_LOGGER_S = 0.4
"""Time between readings within which a machine may return: a fall in one step proves nothing."""
_FEWEST_UP, _FEWEST_DOWN = 20, 2
_WAY_BACK = 5
_LATE = 1
"""Readings by which a strain may lag behind its force."""
STEADY, RETURNED, LEFT = 4.0, 0.6, 0.05
"""A machine returns at one speed, within this factor; the strain goes back by the second share in
all, and by at least the third until the force is gone: a softened rubber has lost its force long
before its strain is back."""
TOO_FEW = "so few readings that a break and a return of the machine look alike"
"""Words for such a fall."""


@dataclass(frozen=True)
class Failure:
    """Whether the record shows that the specimen failed, and in words why or why not."""

    seen: bool
    words: str


def judge_failure(force: Array, strain: Array, time_s: Array | None = None) -> Failure:
    """Judge from the last loading whether the specimen failed.

    A failure is a fall of the force by `SMALLEST_DROP` that is abrupt, or that comes while the
    strain goes on growing. It is not one where strain and force go back together (unloading), where
    the strain is held (relaxation), or where the record ends at its largest force.

    Parameters
    ----------
    force : ndarray, shape (n,)
        Positive in the direction of the test; NaN does not count.
    strain : ndarray, shape (n,)
        Strain or travel in the same direction; NaN where there is none.
    time_s : ndarray, shape (n,), optional
        Times of the readings; without them a fall in one step counts as abrupt.
    """
    kept = np.isfinite(force)
    force, strain = force[kept], strain[kept]
    time_s = None if time_s is None else time_s[kept]
    if len(force) < 3 or not force.max() > 0:
        return Failure(seen=False, words="no load")
    last = loadings(force, strain)[-1]
    start, peak = last.start, last.stop - 1
    largest, rest = float(force[peak]), force[peak:]
    drop = 1 - float(rest.min()) / largest
    if drop < SMALLEST_DROP:
        share = f"{100 * SMALLEST_DROP:g} %"
        return Failure(seen=False, words=f"the force never falls by {share} of its largest value")
    low = peak + int(np.argmax(rest <= (1 - SMALLEST_DROP) * largest))
    # the last reading near the maximum before the fall
    near = peak + int(np.flatnonzero(force[peak:low] >= (1 - SMALLEST_DROP / 2) * largest)[-1])
    rise = (largest - float(force[start])) / max(peak - _onset(force, start, peak), 1)
    ratio = float(force[near] - force[low]) / (low - near) / rise
    change, rows = _strain_after(force, strain, near, largest)
    back = change < -0.02 and rows >= UNLOADING_ROWS
    along = unloads_along(force, strain, near, start, time_s)
    fell = f"the force falls by {100 * drop:.3g} % of its largest value"
    if not along and ratio >= ABRUPT and returns_at_one_speed(force, strain, near, start):
        return Failure(
            seen=False,
            words=f"{fell} and the strain returns at one speed: a break, or a machine that returns "
            "with a softened specimen",
        )
    if not along and (ratio >= SNAP or (ratio >= ABRUPT and not back)):
        return Failure(seen=True, words=f"{fell}, abruptly")
    if not along and ratio >= ABRUPT and max(_given_back(force, strain, near, start)) < TOO_LITTLE:
        words = f"{fell}, abruptly, and the strain goes back by less than in an unloading"
        return Failure(seen=True, words=words)
    if change > 0.01:
        return Failure(seen=True, words=f"{fell} while the strain grows")
    if along and rows < UNLOADING_ROWS:
        return Failure(seen=False, words=f"force and strain go back together in {TOO_FEW}")
    if change < -0.02:
        return Failure(seen=False, words="unloaded: force and strain go back together")
    if np.isfinite(change):
        return Failure(seen=False, words="the force relaxes at a held strain")
    words = f"{fell}, slowly, and without a strain it is not clear whether by unloading"
    return Failure(seen=False, words=words)


def unloads_along(
    force: Array, strain: Array, begin: int, start: int = 0, time_s: Array | None = None
) -> bool:
    """Whether force and strain go back along the way they came: an unloading, however fast.

    Every reading between 85 and 15 % of the force must have a strain within 15 % of the one at
    which the loading had that force: a broken specimen has hardly any, since it breaks within a
    reading of most loggers. It is an unloading, too, if the strain goes back by what the steepest
    part of the loading gives for the fall of the force (`ELASTIC`): a laminate that yielded. Where
    no reading lies between, the fall in one step is a break if the strain does not follow, or the
    readings follow each other so fast that no machine returns between two of them; otherwise the
    two cannot be told apart, and no failure was seen.

    Parameters
    ----------
    force, strain : ndarray, shape (n,)
        Positive in the direction of the test; the strain may contain NaN.
    begin : int
        Last reading before the fall.
    start : int
        First reading of the loading.
    time_s : ndarray, shape (n,), optional
        Times of the readings.
    """
    way = slice(start, begin + 1)
    up = np.isfinite(strain[way])
    if up.sum() < 3:
        return False
    rising = np.maximum.accumulate(force[way][up])
    known = strain[way][up]
    below = np.flatnonzero(force[begin:] < 0.15 * force[begin])
    end = begin + int(below[0]) if len(below) else len(force)
    rows = np.arange(begin + 1, end)
    inner = (force[rows] < 0.85 * force[begin]) & np.isfinite(strain[rows])
    rows = rows[inner]
    if not len(rows):
        if time_s is None or end >= len(force) or not time_s[end] - time_s[begin] > SLOW_LOGGER_S:
            return False
        rows = np.array([end])
    elif len(rows) >= _FEWEST_DOWN and min(_given_back(force, strain, begin, start)) >= ELASTIC:
        return True
    expected = np.interp(force[rows], rising, known)
    return bool((np.abs(strain[rows] - expected) <= 0.15 * abs(known[-1] - known[0])).all())


def _given_back(force: Array, strain: Array, near: int, start: int) -> tuple[float, float]:
    """Shares of the strain of an elastic unloading given back at the middle and end of the fall.

    Elastic is the steepest stretch of the way up, by fifths of the force. The fall goes to the
    lowest force before the next loading, within `_WAY_BACK` times the readings of the fall to
    15 %. NaN where the strain was not read.
    """
    nothing = (float("nan"), float("nan"))
    up = start + np.flatnonzero(np.isfinite(strain[start : near + 1]))
    if len(up) < _FEWEST_UP:
        return nothing
    levels = force[near] * np.linspace(0.1, 0.9, 5)
    reached = strain[up][np.searchsorted(np.maximum.accumulate(force[up]), levels)]
    gained = np.diff(reached)
    if not (gained > 0).any():
        return nothing
    steepest = 0.2 * float(force[near]) / float(gained[gained > 0].min())
    rest = force[near:]
    again = np.flatnonzero(rest[1:] > rest[0])
    rest = rest[: int(again[0]) + 1] if len(again) else rest
    below = np.flatnonzero(rest < 0.15 * rest[0])
    # a softened rubber has lost most of its force long before its strain is back
    window = _WAY_BACK * (int(below[0]) + 1) if len(below) else len(rest)
    end = int(np.argmin(rest[:window]))
    if not end:
        return nothing
    middle = int(np.argmax(rest <= 0.5 * (rest[0] + rest[end])))
    before = float(strain[up[-1]])
    shares = []
    for row in (middle, end):
        later = strain[near + row : near + row + 1 + _LATE]
        later = later[np.isfinite(later)]
        back = before - float(later.min()) if len(later) else float("nan")
        shares.append(back * steepest / float(force[near] - rest[row]))
    return (shares[0], shares[1]) if np.isfinite(shares).all() else nothing


def returns_at_one_speed(force: Array, strain: Array, near: int, start: int) -> bool:
    """Whether the strain goes back at one speed, from the fall of the force to near its start.

    The fall to 15 % of the force must take more than one step between readings: a break hardly
    does, and its strain stands still until the machine returns, or springs back at once.

    Parameters
    ----------
    force, strain : ndarray, shape (n,)
        Positive in the direction of the test; with NaN in the strain after the fall: False.
    near, start : int
        Last reading before the fall; first reading of the loading.
    """
    up = strain[start : near + 1]
    rest = force[near:]
    gone = np.flatnonzero(rest < 0.15 * rest[0])
    if not len(gone) or gone[0] < 2 or not np.isfinite(up).any():
        return False
    fall = int(gone[0])
    later = strain[near : near + _WAY_BACK * fall + 1]
    if not np.isfinite(later).all():
        return False
    gained = float(later[0] - np.nanmin(up))
    back = (later[0] - later) / gained if gained > 0 else np.zeros(len(later))
    end = int(np.argmax(back >= 0.95 * back.max()))
    if back[fall] < LEFT or back.max() < RETURNED or end < 2:  # at once: it springs back
        return False
    # the reading after which the force falls may be half a step before the machine turns
    speeds = back[fall] / (fall - 0.5), (back[end] - back[fall]) / max(end - fall, 1)
    return bool(end <= fall or 1 / STEADY <= speeds[1] / speeds[0] <= STEADY)


def _onset(force: Array, start: int, peak: int) -> int:
    """Row at which a tenth of the rise is reached: before it, slack and idle readings."""
    level = force[start] + 0.1 * (force[peak] - force[start])
    return start + int(np.argmax(force[start : peak + 1] >= level))


def _strain_after(force: Array, strain: Array, near: int, largest: float) -> tuple[float, int]:
    """Relative change of the strain over the fall, and the readings that the fall takes.

    The fall goes to half the largest force, or to the lowest that was recorded.
    """
    rest = force[near:]
    goal = max(0.5 * largest, float(rest.min()))
    end = near + int(np.argmax(rest <= goal))
    seen = np.flatnonzero(np.isfinite(strain[: end + 1]))
    if not len(seen) or seen[-1] <= near:
        return float("nan"), end - near
    base = float(np.nanmin(strain[: near + 1])) if np.isfinite(strain[: near + 1]).any() else 0.0
    before = float(strain[seen[seen <= near][-1]]) - base if (seen <= near).any() else 0.0
    after = float(strain[seen[-1]]) - base
    return ((after - before) / before if before > 0 else float("nan")), end - near
