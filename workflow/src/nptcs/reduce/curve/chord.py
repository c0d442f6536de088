"""Chord slopes: modulus, Poisson's ratio, shear modulus, by one of three named methods."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import assert_never

import numpy as np

from nptcs.arrays import Array, Mask
from nptcs.config.materials.reduction import ChordMethod


@dataclass(frozen=True)
class Line:
    """Least-squares line y = intercept + slope x with the scatter about it."""

    slope: float
    intercept: float
    r_squared: float
    residual_deviation: float
    slope_error: float
    points: int


@dataclass(frozen=True)
class Chord:
    """Slope over a range and the points it is based on.

    Parameters
    ----------
    slope, intercept : float
        Line through the two ends (or the regression line); NaN where not assessed.
    x_low, x_high : float
        Ends that were used.
    points : int
        Recorded points that the slope is based on.
    r_squared : float
        R² of the least-squares line over all points in the range, whatever the method.
    standard_error : float
        Standard error of the slope from the scatter s of the points about that line:
        s/√Σ(x - x̄)² for least squares, √2 s/Δx for a chord between two points.
    flags : tuple of str
        Why there is no value, or what is unusual.
    """

    slope: float
    intercept: float
    x_low: float
    x_high: float
    points: int
    r_squared: float
    standard_error: float
    flags: tuple[str, ...] = ()


def not_assessed(reason: str) -> Chord:
    """Return a chord without a value that says why."""
    nan = float("nan")
    return Chord(nan, nan, nan, nan, 0, nan, nan, (f"not assessed: {reason}",))


def fit_line(x: Array, y: Array) -> Line:
    """Fit y = a + b x by least squares, centred for accuracy.

    Parameters
    ----------
    x, y : ndarray, shape (n,)
        At least two different abscissae.

    Returns
    -------
    Line
        R² and errors are NaN where n leaves no degree of freedom.

    Examples
    --------
    >>> line = fit_line(np.array([0.0, 1.0, 2.0]), np.array([1.0, 3.0, 5.0]))
    >>> line.slope, line.intercept
    (2.0, 1.0)
    """
    x_mean, y_mean = float(x.mean()), float(y.mean())
    dx, dy = x - x_mean, y - y_mean
    sxx, syy = float(dx @ dx), float(dy @ dy)
    slope = float(dx @ dy) / sxx
    residual = dy - slope * dx
    rss = float(residual @ residual)
    free = len(x) - 2
    deviation = float(np.sqrt(rss / free)) if free > 0 else float("nan")
    r_squared = 1.0 - rss / syy if free > 0 and syy > 0 else float("nan")
    error = deviation / float(np.sqrt(sxx))
    return Line(slope, y_mean - slope * x_mean, r_squared, deviation, error, len(x))


def chord_slope(
    x: Array,
    y: Array,
    low: float,
    high: float,
    method: ChordMethod,
    end_tolerance: float = 0.1,
) -> Chord:
    """Slope Δy/Δx between `low` and `high`.

    Parameters
    ----------
    x, y : ndarray, shape (n,)
        Loading branch in the order of recording, x growing; finite values only.
    low, high : float
        Nominal range of x.
    method : {"nearest_points", "interpolated", "least_squares"}
        Recorded points nearest to the ends, linear interpolation at the ends, or the
        regression line over the points inside the range.
    end_tolerance : float
        Distance between a recorded point and its end of the range, as a fraction of the
        range's width, beyond which the value is flagged.

    Returns
    -------
    Chord
        With NaN and a flag "not assessed: …" where the data do not cover the range.

    Examples
    --------
    The chord modulus of a straight curve of 128 GPa, and a curve that ends too soon:

    >>> strain = np.linspace(0, 0.004, 41)
    >>> chord = chord_slope(strain, 128000 * strain, 0.001, 0.003, "nearest_points")
    >>> round(chord.slope), chord.points
    (128000, 2)
    >>> chord_slope(strain[:20], 128000 * strain[:20], 0.001, 0.003, "nearest_points").flags
    ('not assessed: the curve ends at 0.0019, before 0.003',)
    """
    width = high - low
    if len(x) < 2:
        return not_assessed("fewer than two recorded points")
    ends, margin = _ends(method, end_tolerance * width)
    if x.max() < high - margin:
        return not_assessed(f"the curve ends at {x.max():.4g}, before {high:.4g}")
    if x.min() > low + margin:
        return not_assessed(f"the curve begins at {x.min():.4g}, after {low:.4g}")
    stop = int(np.argmax(x >= high)) + 1 if x.max() >= high else len(x)
    inside = (x[:stop] >= low) & (x[:stop] <= high)
    line = _line_or_none(x[:stop][inside], y[:stop][inside])
    unloading = _unloading_flag(x[:stop], inside, end_tolerance * width)
    if ends is None:
        return _regression(line, x[:stop][inside], unloading)
    (x_low, y_low), (x_high, y_high), points, flags = ends(x, y, low, high, end_tolerance)
    if not x_high > x_low:
        return not_assessed("both ends of the range fall on the same recorded point")
    slope = (y_high - y_low) / (x_high - x_low)
    nan = float("nan")
    error = 2.0**0.5 * line.residual_deviation / (x_high - x_low) if line else nan
    return Chord(
        slope,
        y_low - slope * x_low,
        x_low,
        x_high,
        points,
        line.r_squared if line else nan,
        error,
        (*flags, *unloading),
    )


def _line_or_none(x: Array, y: Array) -> Line | None:
    return fit_line(x, y) if len(x) >= 2 and np.ptp(x) > 0 else None


def _regression(line: Line | None, x: Array, flags: tuple[str, ...]) -> Chord:
    if line is None or line.points < 3:
        return not_assessed("fewer than three recorded points in the range")
    return Chord(
        line.slope,
        line.intercept,
        float(x.min()),
        float(x.max()),
        line.points,
        line.r_squared,
        line.slope_error,
        flags,
    )


Point = tuple[float, float]
Ends = Callable[[Array, Array, float, float, float], tuple[Point, Point, int, tuple[str, ...]]]


def _ends(method: ChordMethod, tolerance: float) -> tuple[Ends | None, float]:
    """Return the finder of the two ends (None: regression) and how far outside they may be."""
    match method:
        case "nearest_points":
            return _nearest_ends, tolerance
        case "interpolated":
            return _interpolated_ends, 0.0
        case "least_squares":
            return None, 0.0
        case _:
            assert_never(method)


def _nearest_ends(
    x: Array, y: Array, low: float, high: float, end_tolerance: float
) -> tuple[Point, Point, int, tuple[str, ...]]:
    ends, flags = [], []
    for end in (low, high):
        i = int(np.argmin(np.abs(x - end)))
        ends.append((float(x[i]), float(y[i])))
        if abs(x[i] - end) > end_tolerance * (high - low):
            flags.append(f"the recorded point nearest to {end:.4g} is {x[i]:.4g}")
    return ends[0], ends[1], 2, tuple(flags)


def _interpolated_ends(
    x: Array, y: Array, low: float, high: float, end_tolerance: float
) -> tuple[Point, Point, int, tuple[str, ...]]:
    ends, used = [], set()
    for end in (low, high):
        after = int(np.argmax(x >= end))
        before = max(after - 1, 0)
        used |= {before, after}
        if after == before or x[after] == end:
            ends.append((float(x[after]), float(y[after])))
            continue
        share = (end - x[before]) / (x[after] - x[before])
        ends.append((end, float(y[before] + share * (y[after] - y[before]))))
    return ends[0], ends[1], len(used), ()


def _unloading_flag(x: Array, inside: Mask, tolerance: float) -> tuple[str, ...]:
    drop = (np.maximum.accumulate(x) - x)[inside]
    if drop.size and drop.max() > tolerance:
        return (f"the curve goes back by {drop.max():.2g} inside the range",)
    return ()
