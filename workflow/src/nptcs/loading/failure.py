"""Evidence of failure: a specimen that failed, or a test that was stopped before it did."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nptcs.arrays import Array
from nptcs.loading.cycles import loadings

SMALLEST_DROP = 0.1
"""Share of its largest value that the force must lose: less is noise, relaxation or a slip."""
ABRUPT = 5.0
"""A force that falls so many times faster than it rose is no unloading by the machine, ..."""
SNAP = 50.0
"""... and so many times even where the strain goes back with it."""
UNLOADING_ROWS = 4
"""Readings over which strain and force go back together when the machine unloads."""


@dataclass(frozen=True)
class Failure:
    """Whether the record shows the specimen fail, and in words what shows it or why nothing."""

    seen: bool
    words: str


def judge_failure(force: Array, strain: Array) -> Failure:
    """Judge from the last loading whether the specimen failed.

    A failure is a fall of the force by `SMALLEST_DROP` that is abrupt, or that comes while the
    strain goes on growing. It is none where strain and force go back together (unloading), where
    the strain is held (relaxation), or where the record ends at its largest force.

    Parameters
    ----------
    force : ndarray, shape (n,)
        Positive in the direction of the test; NaN does not count.
    strain : ndarray, shape (n,)
        Strain or travel in the same direction; NaN where there is none.
    """
    kept = np.isfinite(force)
    force, strain = force[kept], strain[kept]
    if len(force) < 3 or not force.max() > 0:
        return Failure(seen=False, words="no load")
    last = loadings(force, strain)[-1]
    start, peak = last.start, last.stop - 1
    largest, rest = float(force[peak]), force[peak:]
    drop = 1 - float(rest.min()) / largest
    if drop < SMALLEST_DROP:
        return Failure(seen=False, words="the record ends at its largest force")
    low = peak + int(np.argmax(rest <= (1 - SMALLEST_DROP) * largest))
    # the last reading near the maximum before the fall
    near = peak + int(np.flatnonzero(force[peak:low] >= (1 - SMALLEST_DROP / 2) * largest)[-1])
    rise = (largest - float(force[start])) / max(peak - _onset(force, start, peak), 1)
    ratio = float(force[near] - force[low]) / (low - near) / rise
    change, rows = _strain_after(force, strain, near, largest)
    back = change < -0.02 and rows >= UNLOADING_ROWS
    fell = f"the force falls by {100 * drop:.3g} % of its largest value"
    if ratio >= SNAP or (ratio >= ABRUPT and not back):
        return Failure(seen=True, words=f"{fell}, abruptly")
    if change > 0.01:
        return Failure(seen=True, words=f"{fell} while the strain grows")
    if change < -0.02:
        return Failure(seen=False, words="unloaded: force and strain go back together")
    if np.isfinite(change):
        return Failure(seen=False, words="the force relaxes at a held strain")
    return Failure(seen=False, words=f"{fell}, slowly, and no strain tells whether by unloading")


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
