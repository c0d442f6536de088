"""Stiffness of a tyre from the points of its load–displacement curve."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline

from nptcs.arrays import Array

LEAST_POINTS = 6
LEAST_SPAN = 0.3
"""Points of the curve that a tangent needs at least, and the share of the last load they span."""


@dataclass(frozen=True)
class CurvePoint:
    """A point of the curve: displacement mm, load N, secant and tangent stiffness N/mm."""

    displacement_mm: float
    load_n: float
    secant_n_per_mm: float
    tangent_n_per_mm: float


class LoadCurve:
    """The curve through a tyre's solved points: displacement as a cubic spline of the load.

    Its tangent is not the spline's. A mesh touches the ground point by point, so that the slope of
    a solved curve rises and falls by a few per cent over a few hundred newtons, and a spline
    exaggerates this at its end. The tangent is that of a smoothed curve: the least-squares parabola
    of the logarithm of the displacement against that of the load, over the nearest points
    (Savitzky and Golay, Analytical Chemistry 36, 1964, 1627).

    Parameters
    ----------
    displacement_mm, load_n : arrays (points,)
        Both rising from 0.

    Raises
    ------
    ValueError
        If there are fewer than four points, or they do not rise.
    """

    def __init__(self, displacement_mm: Array, load_n: Array) -> None:
        rising = bool(np.all(np.diff(load_n) > 0.0) and np.all(np.diff(displacement_mm) > 0.0))
        if len(load_n) < 4 or not rising:
            raise ValueError("the curve has fewer than four points, or they do not rise")
        self._displacement = CubicSpline(load_n, displacement_mm)
        loaded = load_n > 0.0
        self._logarithms = np.log(load_n[loaded]), np.log(displacement_mm[loaded])
        self.last_load_n = float(load_n[-1])
        self.last_displacement_mm = float(displacement_mm[-1])

    def at_load(self, load_n: float) -> CurvePoint | None:
        """Return the point at a load; None if the curve does not reach it."""
        if not 0.0 < load_n <= self.last_load_n * (1.0 + 1e-9):
            return None
        displacement = float(self._displacement(load_n))
        secant = load_n / displacement
        return CurvePoint(displacement, load_n, secant, secant / self._exponent(load_n))

    def _exponent(self, load_n: float) -> float:
        """Relative change of the displacement over that of the load, smoothed."""
        loads, displacements = self._logarithms
        away = np.abs(np.exp(loads) - load_n)
        order = np.argsort(away, kind="stable")
        count = next(
            (n for n in range(LEAST_POINTS, len(order)) if self._wide(np.exp(loads[order[:n]]))),
            len(order),
        )
        near = order[:count]
        fitted = np.polynomial.Polynomial.fit(loads[near], displacements[near], 2)
        return float(fitted.deriv()(np.log(load_n)))

    def _wide(self, loads_n: Array) -> bool:
        return bool(np.ptp(loads_n) >= LEAST_SPAN * self.last_load_n)

    def at_displacement(self, displacement_mm: float) -> CurvePoint | None:
        """Return the point at a displacement; None if the curve does not reach it."""
        if not 0.0 < displacement_mm <= self.last_displacement_mm:
            return None
        crossings = self._displacement.solve(displacement_mm, extrapolate=False)
        return self.at_load(float(crossings[0])) if len(crossings) else None
