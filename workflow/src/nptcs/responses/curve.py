"""Stiffness of a tyre from the points of its load–displacement curve."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline

from nptcs.arrays import Array


@dataclass(frozen=True)
class CurvePoint:
    """A point of the curve: displacement mm, load N, secant and tangent stiffness N/mm."""

    displacement_mm: float
    load_n: float
    secant_n_per_mm: float
    tangent_n_per_mm: float


class LoadCurve:
    """The curve through a tyre's solved points: a cubic spline of the displacement by the load.

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
        self.last_load_n = float(load_n[-1])
        self.last_displacement_mm = float(displacement_mm[-1])

    def at_load(self, load_n: float) -> CurvePoint | None:
        """Return the point at a load; None where the curve does not reach it."""
        if not 0.0 < load_n <= self.last_load_n * (1.0 + 1e-9):
            return None
        displacement = float(self._displacement(load_n))
        slope = float(self._displacement(load_n, 1))
        return CurvePoint(displacement, load_n, load_n / displacement, 1.0 / slope)

    def at_displacement(self, displacement_mm: float) -> CurvePoint | None:
        """Return the point at a displacement; None where the curve does not reach it."""
        if not 0.0 < displacement_mm <= self.last_displacement_mm:
            return None
        crossings = self._displacement.solve(displacement_mm, extrapolate=False)
        return self.at_load(float(crossings[0])) if len(crossings) else None
