"""Contracts of the diagnostics of polynomials."""

from __future__ import annotations

import pandera.pandas as pa
from pandera.typing.pandas import Series


class SurfaceTests(pa.DataFrameModel):
    """``surface_tests.csv``: tests of the coded coefficients, one row per solver and term."""

    study: Series[str]
    solver: Series[str]
    term: Series[str]
    coefficient_coded: Series[float]
    t_value: Series[float] = pa.Field(nullable=True, description="Coefficient / standard error")
    p_value: Series[float] = pa.Field(ge=0, le=1, nullable=True, description="Two-sided")
    confidence_low: Series[float] = pa.Field(description="95 % confidence interval")
    confidence_high: Series[float]
    vif: Series[float] = pa.Field(
        nullable=True, description="Variance inflation by the other coded terms"
    )
    noise: Series[str] = pa.Field(description="What the cases say about the noise")
    p_meaning: Series[str] = pa.Field(description="What the p-value is")

    class Config:
        """Exactly these columns."""

        strict = True
        coerce = True
        ordered = True


class SurfaceAnova(pa.DataFrameModel):
    """``surface_anova.csv``: analysis of variance, one row per solver and source."""

    study: Series[str]
    solver: Series[str]
    source: Series[str] = pa.Field(description="Group of terms, term, residual and its parts")
    kind: Series[str] = pa.Field(isin=["group", "term", "rest"])
    df: Series[int] = pa.Field(ge=0, description="Degrees of freedom")
    sequential_ss: Series[float] = pa.Field(ge=0, description="Added to the sources before it")
    partial_ss: Series[float] = pa.Field(
        ge=0, nullable=True, description="Added to all other terms"
    )
    mean_square: Series[float] = pa.Field(
        ge=0, nullable=True, description="Of the sequential sum of squares"
    )
    f_value: Series[float] = pa.Field(
        ge=0,
        nullable=True,
        description="Group: sequential, term: partial sum of squares against the residual; lack of "
        "fit against the pure error",
    )
    p_value: Series[float] = pa.Field(ge=0, le=1, nullable=True)
    noise: Series[str] = pa.Field(description="What the cases say about the noise")
    p_meaning: Series[str] = pa.Field(description="What the p-value is")

    class Config:
        """Exactly these columns."""

        strict = True
        coerce = True
        ordered = True


class SurfaceInfluence(pa.DataFrameModel):
    """``surface_influence.csv``: what each case does to the polynomial."""

    study: Series[str]
    solver: Series[str]
    point: Series[str] = pa.Field(description="Values of the factors that the solver used")
    response: Series[float]
    residual: Series[float] = pa.Field(description="Response minus surface")
    leverage: Series[float] = pa.Field(ge=0, le=1 + 1e-9)
    left_out_residual: Series[float] = pa.Field(nullable=True, description="e/(1 - leverage)")
    standardised_residual: Series[float] = pa.Field(nullable=True, description="e/(s √(1 - h))")
    studentised_residual: Series[float] = pa.Field(nullable=True, description="s without the case")
    cook_distance: Series[float] = pa.Field(ge=0, nullable=True)

    class Config:
        """Exactly these columns."""

        strict = True
        coerce = True
        ordered = True


class SurfaceStationary(pa.DataFrameModel):
    """``surface_stationary.csv``: stationary points, ridge paths; one row per point and factor."""

    study: Series[str]
    solver: Series[str]
    path: Series[str] = pa.Field(
        isin=["stationary point", "path of the maximum", "path of the minimum"]
    )
    number: Series[int] = pa.Field(ge=1, description="Of the point")
    radius_coded: Series[float] = pa.Field(
        ge=0, description="Distance from the centre, factors scaled to [-1, 1]"
    )
    factor: Series[str]
    value: Series[float] = pa.Field(description="Unit of the factor")
    response: Series[float]
    kind: Series[str] = pa.Field(description="maximum, minimum, saddle or ridge")
    curvatures: Series[str] = pa.Field(
        description="Eigenvalues of half the Hessian in coded units, N/mm"
    )
    inside_box: Series[bool]

    class Config:
        """Exactly these columns."""

        strict = True
        coerce = True
        ordered = True


class SurfaceSelection(pa.DataFrameModel):
    """``surface_selection.csv``: terms dropped one by one, the hierarchy kept."""

    study: Series[str]
    solver: Series[str]
    criterion: Series[str] = pa.Field(isin=["aicc", "press"])
    step: Series[int] = pa.Field(ge=0)
    dropped: Series[str] = pa.Field(description="Term dropped in this step; empty in the first")
    terms: Series[int] = pa.Field(gt=0, description="Terms that are left")
    aicc: Series[float] = pa.Field(description="Corrected Akaike criterion")
    press: Series[float] = pa.Field(
        ge=0, nullable=True, description="Sum of squared leave-one-out residuals"
    )
    chosen: Series[bool] = pa.Field(description="Smallest criterion")

    class Config:
        """Exactly these columns."""

        strict = True
        coerce = True
        ordered = True
