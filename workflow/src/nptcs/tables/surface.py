"""Contracts of the response-surface tables."""

from __future__ import annotations

import pandera.pandas as pa
from pandera.typing.pandas import Series


class SurfaceTable(pa.DataFrameModel):
    """``STUDY_surface.csv``: coefficients of the response surfaces, one row per solver and term."""

    solver: Series[str]
    term: Series[str]
    coefficient_natural: Series[float] = pa.Field(description="N/mm per unit of the term")
    coefficient_coded: Series[float] = pa.Field(description="N/mm, factors scaled to [-1, 1]")
    standard_error: Series[float] = pa.Field(ge=0, description="Of coefficient_natural")
    standard_error_coded: Series[float] = pa.Field(ge=0)
    published_coefficient: Series[float] = pa.Field(nullable=True, description="As printed")

    class Config:
        """Exactly these columns."""

        strict = True
        coerce = True
        ordered = True


class SurfaceQuality(pa.DataFrameModel):
    """``surface_quality.csv``: how well each surface follows its cases."""

    study: Series[str]
    solver: Series[str]
    response: Series[str]
    points: Series[int] = pa.Field(gt=0)
    terms: Series[int] = pa.Field(gt=0)
    r_squared: Series[float] = pa.Field(le=1)
    adjusted_r_squared: Series[float] = pa.Field(le=1)
    leave_one_out_r_squared: Series[float] = pa.Field(le=1)
    ten_fold_r_squared: Series[float] = pa.Field(le=1)
    residual_sd: Series[float] = pa.Field(ge=0, description="N/mm, √(SSE / (points - terms))")
    largest_residual: Series[float] = pa.Field(ge=0, description="N/mm")
    condition_number_natural: Series[float] = pa.Field(ge=1)
    condition_number_coded: Series[float] = pa.Field(ge=1)
    rule: Series[str] = pa.Field(description="How it was fitted")

    class Config:
        """Exactly these columns."""

        strict = True
        coerce = True
        ordered = True
