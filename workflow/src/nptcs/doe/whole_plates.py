"""Spacings that divide the width of the tyre among a whole number of plates."""

from __future__ import annotations

import numpy as np

from nptcs.arrays import Array
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.errors import InputError

SPACING = "spacing_mm"


def whole_plates(points: Array, factors: list[str], tyre: TyreGeometry) -> Array:
    """Move each spacing to the nearest pitch that gives a whole number of plates.

    Raises
    ------
    InputError
        When the spacing is not among the factors.
    """
    if SPACING not in factors:
        raise InputError(
            f"whole_plates moves {SPACING}, which is not a factor of this study",
            column="design.whole_plates",
            remedy="leave whole_plates out",
        )
    moved, column = points.copy(), factors.index(SPACING)
    counts = np.arange(1, int(tyre.tread_width_mm / points[:, column].min()) + 2)
    pitches = tyre.tread_width_mm / counts
    nearest = np.abs(points[:, column][:, None] - pitches[None, :]).argmin(axis=1)
    moved[:, column] = pitches[nearest]
    return moved
