"""Contracts of the response-surface tables."""

from __future__ import annotations

import pandera.pandas as pa
from pandera.typing.pandas import Series

from nptcs.tables.analysis.response_surfaces import ResponseSurfaces


class SurfaceTable(pa.DataFrameModel):
    """``STUDY_surface.csv``: coefficients of the polynomials, one row per solver and term."""

    solver: Series[str]
    term: Series[str]
    coefficient_natural: Series[float] = pa.Field(description="N/mm per unit of the term")
    coefficient_coded: Series[float] = pa.Field(description="N/mm, factors scaled to [-1, 1]")
    standard_error: Series[float] = pa.Field(ge=0, description="Of coefficient_natural")
    standard_error_coded: Series[float] = pa.Field(ge=0)
    published_coefficient: Series[float] = pa.Field(nullable=True, description="As in table 6 or 8")

    class Config:
        """Exactly these columns."""

        strict = True
        coerce = True
        ordered = True


class SurfaceQuality(pa.DataFrameModel):
    """``surface_quality.csv``: how well each polynomial follows its cases."""

    study: Series[str]
    solver: Series[str]
    response: Series[str]
    points: Series[int] = pa.Field(gt=0)
    failed_cases: Series[int] = pa.Field(ge=0, description="Cases of the solver without a result")
    same_cases: Series[int] = pa.Field(
        ge=0, description="Cases left out because the solver made the same tyre for another case"
    )
    realised_factors: Series[str] = pa.Field(
        description="Factors in the values that the solver actually used, not in the given ones"
    )
    terms: Series[int] = pa.Field(gt=0)
    r_squared: Series[float] = pa.Field(le=1)
    adjusted_r_squared: Series[float] = pa.Field(le=1)
    leave_one_out_r_squared: Series[float] = pa.Field(le=1, nullable=True)
    ten_fold_r_squared: Series[float] = pa.Field(le=1)
    press: Series[float] = pa.Field(
        ge=0,
        nullable=True,
        description="(N/mm)², sum of the squared leave-one-out residuals; the leave-one-out R² is "
        "the predicted R²",
    )
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


class SurfaceComparison(pa.DataFrameModel):
    """``surface_comparison.csv``: how each kind of surface predicts cases that it has not seen."""

    study: Series[str]
    solver: Series[str]
    response: Series[str]
    surface: Series[str] = pa.Field(description="Kind, with the mean of a Gaussian process")
    points: Series[int] = pa.Field(gt=0)
    coefficients: Series[int] = pa.Field(
        gt=0, description="Fitted ones; of a Gaussian process those of its mean"
    )
    form: Series[str] = pa.Field(description="Terms or shape parameters that were chosen")
    r_squared: Series[float] = pa.Field(le=1)
    largest_residual: Series[float] = pa.Field(ge=0, description="N/mm, cases of the fit")
    leave_one_out_largest: Series[float] = pa.Field(ge=0, nullable=True, description="N/mm")
    leave_one_out_rms: Series[float] = pa.Field(ge=0, nullable=True, description="N/mm")
    leave_one_out_not_fitted: Series[int] = pa.Field(
        ge=0,
        description="Cases without which the surface cannot be fitted; not in the two columns "
        "before",
    )
    coverage_percent: Series[float] = pa.Field(
        ge=0,
        le=100,
        nullable=True,
        description="Left-out cases within the 95 % prediction interval; empty: not assessed",
    )
    level_out_largest: Series[float] = pa.Field(
        ge=0, nullable=True, description="N/mm, the worst of the levels left out whole"
    )
    level_out_not_fitted: Series[str] = pa.Field(
        description="Factors for which a level cannot be left out"
    )
    outside_the_box: Series[str] = pa.Field(
        isin=["refused", "flagged"], description="What happens to a prediction there"
    )
    fit_cpu_s: Series[float] = pa.Field(ge=0, description="Processor time of one fit")
    leave_one_out_cpu_s: Series[float] = pa.Field(ge=0, description="Processor time of all refits")
    rule: Series[str] = pa.Field(description="How it was fitted and tested")

    class Config:
        """Exactly these columns."""

        strict = True
        coerce = True
        ordered = True


class SurfaceByFactor(pa.DataFrameModel):
    """``surface_by_factor.csv``: each surface along each factor, one row per factor."""

    study: Series[str]
    solver: Series[str]
    surface: Series[str]
    factor: Series[str]
    values_used: Series[str] = pa.Field(
        description="'realised' where the solver used other values of the factor than the given "
        "ones, otherwise 'given'"
    )
    lowest: Series[float] = pa.Field(description="Range of validity, unit of the factor")
    highest: Series[float]
    level_out_largest: Series[float] = pa.Field(
        ge=0, nullable=True, description="N/mm, the worst of its levels, each left out whole"
    )
    not_fitted: Series[str] = pa.Field(description="Levels that cannot be left out, and why")
    rising_percent: Series[float] = pa.Field(
        ge=0, le=100, description="Steps along the factor, over a grid in the box, that rise"
    )
    falling_percent: Series[float] = pa.Field(ge=0, le=100, description="Steps that fall")
    monotone: Series[bool] = pa.Field(description="Nowhere rising, or nowhere falling")

    class Config:
        """Exactly these columns."""

        strict = True
        coerce = True
        ordered = True


JOINED = {
    "quality": SurfaceQuality,
    "comparison": SurfaceComparison,
    "by_factor": SurfaceByFactor,
    "response_surfaces": ResponseSurfaces,
}
"""Tables that each study makes and that are joined over all studies."""
