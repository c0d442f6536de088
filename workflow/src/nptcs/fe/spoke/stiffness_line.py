"""Straight line through the origin, as table 10 of the paper fits the spoke's stiffness."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nptcs.arrays import Array


@dataclass(frozen=True)
class StiffnessLine:
    """Straight line through the origin.

    Parameters
    ----------
    slope : float
        N/mm.
    r2_uncentred : float
        1 - Σ(f - k d)² / Σ f²: what software prints for a line without intercept.
    r2_centred : float
        1 - Σ(f - k d)² / Σ (f - mean f)².
    """

    slope: float
    r2_uncentred: float
    r2_centred: float


def stiffness_line(displacement_mm: Array, force_n: Array) -> StiffnessLine:
    """Regress force on displacement through the origin: k = Σ f d / Σ d².

    Examples
    --------
    >>> line = stiffness_line(np.array([1.0, 2.0, 4.0]), np.array([31.0, 60.0, 118.0]))
    >>> round(line.slope, 3), round(line.r2_uncentred, 5), round(line.r2_centred, 5)
    (29.667, 0.99986, 0.99932)
    """
    slope = float(displacement_mm @ force_n / (displacement_mm @ displacement_mm))
    misfit = float(np.sum((force_n - slope * displacement_mm) ** 2))
    total = float(force_n @ force_n)
    spread = float(np.sum((force_n - force_n.mean()) ** 2))
    return StiffnessLine(slope, 1.0 - misfit / total, 1.0 - misfit / spread)
