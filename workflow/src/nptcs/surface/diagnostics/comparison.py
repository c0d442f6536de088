"""How surfaces of every kind predict cases that they have not seen, tested in the same way."""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np
from scipy import stats

from nptcs.arrays import Array, Mask
from nptcs.errors import InputError
from nptcs.surface.diagnostics.influence import influence
from nptcs.surface.fit import Surface
from nptcs.surface.kinds.linked import INVERSES, LinkedSurface
from nptcs.surface.response_surface import ResponseSurface, box

CONFIDENCE = 0.95
GRID_POINTS = 10_000
"""Points of the grid over the box on which the direction of each factor's effect is read."""

MOST_LEVELS = 10
"""A factor with more values than this has no levels to leave out."""

MANY_CASES = 50
"""Number of cases above which a polynomial's left-out errors come from the leverages of one fit."""
MOST_REFITS = 2000
"""Cases beyond which a surface is not fitted again without each of them."""

FLAT = 1e-9
"""Share of the response's range below which a step along a factor has no direction."""


@dataclass(frozen=True)
class LeftOut:
    """Errors of a surface at cases left out one at a time.

    Parameters
    ----------
    error : ndarray of shape (m,)
        Prediction minus response; NaN where the surface could not be fitted to the other cases.
    covered : ndarray of shape (m,)
        Whether the response lies in the prediction interval.
    cpu_s : float
        Processor time of all refits.
    assessed : bool
        False where there are more than `MOST_REFITS` cases.
    what : str
        What was left out each time.
    """

    error: Array
    covered: Mask
    cpu_s: float
    what: str = "a case"
    assessed: bool = True

    @property
    def known(self) -> Array:
        """Errors of the cases without which the surface could be fitted."""
        return self.error[np.isfinite(self.error)]

    @property
    def largest(self) -> float:
        """Largest error in size; NaN if no case could be left out."""
        return float(np.abs(self.known).max()) if len(self.known) else np.nan

    @property
    def rms(self) -> float:
        """Root mean square error; NaN if no case could be left out."""
        return float(np.sqrt(np.mean(self.known**2))) if len(self.known) else np.nan

    @property
    def coverage_percent(self) -> float:
        """Share of these cases in the prediction interval; NaN if none could be left out."""
        return 100 * float(self.covered.sum()) / len(self.known) if len(self.known) else np.nan


@dataclass(frozen=True)
class LevelError:
    """The largest error at the levels of one factor, each left out whole.

    Parameters
    ----------
    largest : float
        NaN where none could be left out.
    refused : str
        Why the surface could not be fitted without a level; empty if it could without each level.
    """

    largest: float
    refused: str


def leave_one_out(surface: ResponseSurface) -> LeftOut:
    """Fit the surface again without each group of cases, with all parameters, and predict them.

    A group is a single case, or all cases that the kind of surface says belong together
    (`ResponseSurface.groups`): leaving out only one of them would test nothing.
    """
    start = time.process_time()
    if isinstance(surface, Surface | LinkedSurface) and len(surface.y) > MANY_CASES:
        error, covered = _by_leverage(surface)
        return LeftOut(error, covered, time.process_time() - start)
    if len(surface.y) > MOST_REFITS:
        nothing = np.full(len(surface.y), np.nan)
        return LeftOut(nothing, np.zeros(len(surface.y), bool), 0.0, assessed=False)
    error, covered = np.full(len(surface.y), np.nan), np.zeros(len(surface.y), bool)
    groups = surface.groups()
    for group in np.unique(groups.labels):
        out = groups.labels == group
        try:
            other = surface.refit(surface.x[~out], surface.y[~out])
        except InputError:
            continue
        low, high = other.interval(surface.x[out], CONFIDENCE)
        error[out] = other.predict(surface.x[out]) - surface.y[out]
        covered[out] = (low <= surface.y[out]) & (surface.y[out] <= high)
    return LeftOut(error, covered, time.process_time() - start, groups.what)


def _by_leverage(surface: Surface | LinkedSurface) -> tuple[Array, Mask]:
    """Left-out errors and coverage of a polynomial from one fit: e/(1 - h), the same numbers.

    The response of a left-out case is inside its prediction interval if its externally
    studentised residual is not above the quantile of t.
    """
    inner = surface.inner if isinstance(surface, LinkedSurface) else surface
    found = influence(inner)
    freedom = inner.points - inner.coefficients - 1
    limit = stats.t.ppf(0.5 + CONFIDENCE / 2, freedom)
    covered = np.asarray(np.abs(found.studentised) <= limit)
    predicted = inner.y - found.left_out
    if isinstance(surface, LinkedSurface):
        predicted = INVERSES[surface.link](predicted)
    return predicted - surface.y, covered


def leave_one_level_out(surface: ResponseSurface, axis: int) -> LevelError:
    """Fit the surface again without each level of a factor, and predict the cases at that level.

    At the ends of the range this extrapolates: no box is checked here. A factor with many values,
    as in a Latin hypercube, has no levels, and nothing is assessed.
    """
    levels = np.unique(surface.x[:, axis])
    if len(levels) > MOST_LEVELS:
        return LevelError(np.nan, f"not assessed: {len(levels)} values and no levels")
    errors, refusals = [], []
    for level in levels:
        kept = surface.x[:, axis] != level
        try:
            other = surface.refit(surface.x[kept], surface.y[kept])
        except InputError as error:
            refusals.append(f"without {level:g}: {error.message}")
            continue
        errors.append(np.abs(other.predict(surface.x[~kept]) - surface.y[~kept]).max())
    return LevelError(float(max(errors, default=np.nan)), "; ".join(refusals))


def directions(surface: ResponseSurface) -> list[tuple[float, float]]:
    """Share of the steps along each factor, over a grid in the box, that rise and that fall.

    A surface that is monotone in a factor has one of the two at zero.
    """
    lower, upper = box(surface.x)
    cells = max(3, round(GRID_POINTS ** (1 / len(lower))))
    axes = [np.linspace(low, high, cells) for low, high in zip(lower, upper, strict=True)]
    points = np.stack([axis.ravel() for axis in np.meshgrid(*axes, indexing="ij")], axis=1)
    values = surface.predict(points).reshape([cells] * len(lower))
    flat = FLAT * np.ptp(surface.y)
    steps = [np.diff(values, axis=axis) for axis in range(len(lower))]
    return [(float(np.mean(step > flat)), float(np.mean(step < -flat))) for step in steps]
