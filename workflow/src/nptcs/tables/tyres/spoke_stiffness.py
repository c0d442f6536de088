"""Contracts of the single spoke: figure 13's curves and table 10's lines, section 4.3.1."""

from __future__ import annotations

import pandera.pandas as pa
from pandera.typing.pandas import Series

from nptcs.tables.status import Status

SPOKE_VALUES = ("spoke_c10_mpa", "spacing_mm", "thickness_mm", "angle_deg")
DIRECTIONS = {"tension": 1.0, "compression": -1.0}


class SpokeLines(pa.DataFrameModel):
    """Single spokes: slopes of the lines through the origin, and table 10.

    Each line is fitted to all points of its curve, k = Σfd/Σd². R² is given in both conventions:
    uncentred, 1 - SSE/Σf², which software prints for a line without intercept, and centred,
    1 - SSE/Σ(f - mean)². The paper does not say which one it prints.
    """

    study: Series[str]
    case_id: Series[str]
    solver: Series[str]
    spoke_c10_mpa: Series[float] = pa.Field(gt=0)
    spacing_mm: Series[float] = pa.Field(gt=0)
    thickness_mm: Series[float] = pa.Field(gt=0)
    angle_deg: Series[float]
    status: Series[str] = pa.Field(isin=list(Status))
    tension_stiffness_n_per_mm: Series[float] = pa.Field(nullable=True, description="k_t")
    published_tension_stiffness_n_per_mm: Series[float] = pa.Field(nullable=True)
    tension_difference_percent: Series[float] = pa.Field(nullable=True)
    tension_r2_uncentred: Series[float] = pa.Field(nullable=True, le=1)
    tension_r2_centred: Series[float] = pa.Field(nullable=True, le=1)
    published_tension_r2: Series[float] = pa.Field(nullable=True, le=1)
    compression_stiffness_n_per_mm: Series[float] = pa.Field(nullable=True, description="k_c")
    published_compression_stiffness_n_per_mm: Series[float] = pa.Field(nullable=True)
    compression_difference_percent: Series[float] = pa.Field(nullable=True)
    compression_r2_uncentred: Series[float] = pa.Field(nullable=True, le=1)
    compression_r2_centred: Series[float] = pa.Field(nullable=True, le=1)
    published_compression_r2: Series[float] = pa.Field(nullable=True, le=1)

    class Config:
        """Exactly these columns, in this order; each spoke once."""

        strict = True
        coerce = True
        ordered = True
        unique = ["solver", "case_id"]


class SpokeCurves(pa.DataFrameModel):
    """Force on single spokes against their displacement (figure 13); tension is positive."""

    study: Series[str]
    case_id: Series[str]
    solver: Series[str]
    spoke_c10_mpa: Series[float] = pa.Field(gt=0)
    displacement_mm: Series[float]
    force_n: Series[float]

    class Config:
        """Exactly these columns, in this order."""

        strict = True
        coerce = True
        ordered = True
