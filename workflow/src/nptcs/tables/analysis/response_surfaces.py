"""Contracts of the surfaces of every response: how they predict, and what each factor does."""

from __future__ import annotations

import pandas as pd
import pandera.pandas as pa
from pandera.typing.pandas import Series


class ResponseSurfaces(pa.DataFrameModel):
    """``response_surfaces.csv``: surfaces of every response, one row per response and surface."""

    study: Series[str]
    solver: Series[str]
    response: Series[str]
    at: Series[str] = pa.Field(description="Load or displacement of the response, with its unit")
    unit: Series[str] = pa.Field(description="Of the response and of all errors in the row")
    surface: Series[str] = pa.Field(description="Kind, with the mean of a Gaussian process")
    points: Series[int] = pa.Field(gt=0, description="Cases of the fit")
    not_assessed_cases: Series[int] = pa.Field(
        ge=0, description="Solved cases without this response; tyre_responses.csv says why"
    )
    failed_cases: Series[int] = pa.Field(ge=0, description="Cases of the solver without a result")
    coefficients: Series[int] = pa.Field(
        gt=0, description="Fitted ones; of a Gaussian process those of its mean"
    )
    form: Series[str] = pa.Field(description="Terms, shape parameters or hyperparameters")
    smallest: Series[float] = pa.Field(description="Smallest value among the cases")
    largest: Series[float] = pa.Field(description="Largest value among the cases")
    r_squared: Series[float] = pa.Field(le=1)
    largest_residual: Series[float] = pa.Field(ge=0, description="Among the cases of the fit")
    left_out: Series[str] = pa.Field(
        description="What is left out at a time: a case, or all cases that share a spoke"
    )
    left_out_largest: Series[float] = pa.Field(ge=0, nullable=True)
    left_out_rms: Series[float] = pa.Field(ge=0, nullable=True)
    left_out_largest_percent: Series[float] = pa.Field(
        ge=0, nullable=True, description="Largest error in per cent of the value that was left out"
    )
    left_out_rms_percent: Series[float] = pa.Field(ge=0, nullable=True)
    coverage_percent: Series[float] = pa.Field(
        ge=0, le=100, nullable=True, description="Left-out cases in the 95 % prediction interval"
    )
    outside_the_box: Series[str] = pa.Field(
        isin=["refused", "flagged"], description="What happens to a prediction there"
    )

    class Config:
        """Exactly these columns."""

        strict = True
        coerce = True
        ordered = True
        unique = ["study", "solver", "response", "at", "surface"]


class ResponseImpact(pa.DataFrameModel):
    """``response_impact.csv``: what each factor does to each response, one row per factor.

    From the surface that predicts left-out cases best. Factors are independent and uniform over the
    range of the cases.
    """

    study: Series[str]
    solver: Series[str]
    response: Series[str]
    at: Series[str]
    unit: Series[str] = pa.Field(description="Of the response, the impact and the effect")
    surface: Series[str]
    factor: Series[str]
    lowest: Series[float] = pa.Field(description="Range of the factor")
    highest: Series[float]
    impact: Series[float] = pa.Field(
        ge=0, description="Mean of |∂f/∂x| over the box × range of the factor"
    )
    signed_impact: Series[float] = pa.Field(description="Mean of ∂f/∂x over the box × range")
    first_index: Series[float] = pa.Field(description="First-order Sobol index")
    total_index: Series[float] = pa.Field(description="Total Sobol index")
    total_confidence: Series[float] = pa.Field(ge=0, description="Half width of its interval")
    effect: Series[float] = pa.Field(
        ge=0, description="√(total index) × standard deviation of the response"
    )
    rank: Series[pd.Int64Dtype] = pa.Field(ge=1, description="By the total index")
    near_tie_with: Series[str] = pa.Field(
        description="Factors whose order relative to this one is not settled"
    )
    cases: Series[int] = pa.Field(gt=0, description="Cases that the surface was fitted to")
    not_assessed_cases: Series[int] = pa.Field(ge=0)
    failed_cases: Series[int] = pa.Field(ge=0)

    class Config:
        """Exactly these columns."""

        strict = True
        coerce = True
        ordered = True
        unique = ["study", "solver", "response", "at", "factor"]
