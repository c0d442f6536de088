"""Contracts of the variance-based sensitivities."""

from __future__ import annotations

import pandas as pd
import pandera.pandas as pa
from pandera.typing.pandas import Series


class SobolIndices(pa.DataFrameModel):
    """``sobol_indices.csv``: shares of the variance, one row per surface and factor or pair."""

    study: Series[str]
    solver: Series[str]
    surface: Series[str] = pa.Field(description="Kind of the surface that was sampled")
    inputs: Series[str] = pa.Field(
        isin=["uniform", "given"], description="uniform over the cases, or given distributions"
    )
    factor: Series[str]
    partner: Series[str] = pa.Field(
        description="Second factor of an interaction; empty for a factor alone"
    )
    distribution: Series[str] = pa.Field(description="Of the factor; empty for an interaction")
    cut_percent: Series[float] = pa.Field(
        ge=0,
        le=100,
        nullable=True,
        description="Share of the distribution outside the cases, which is cut off",
    )
    index: Series[float] = pa.Field(description="First-order index, or that of the interaction")
    index_confidence: Series[float] = pa.Field(
        ge=0, nullable=True, description="Half width of its interval"
    )
    total: Series[float] = pa.Field(nullable=True, description="Total index of a factor")
    total_confidence: Series[float] = pa.Field(ge=0, nullable=True)
    effect_n_per_mm: Series[float] = pa.Field(
        ge=0, nullable=True, description="√(total index) × standard deviation of the response"
    )
    rank: Series[pd.Int64Dtype] = pa.Field(
        ge=1, nullable=True, description="By the total index, within the surface"
    )
    near_tie_with: Series[str] = pa.Field(
        description="Factors whose order relative to this one is not settled"
    )
    samples: Series[int] = pa.Field(gt=0, description="Evaluations of the surface")
    cases: Series[int] = pa.Field(gt=0, description="Cases that the surface was fitted to")
    failed_cases: Series[int] = pa.Field(
        ge=0, description="Cases of the solver without a result: they are not in the index"
    )

    class Config:
        """Exactly these columns."""

        strict = True
        coerce = True
        ordered = True


class MainEffects(pa.DataFrameModel):
    """``main_effects.csv``: mean response over the other factors, one row per value of a factor."""

    study: Series[str]
    solver: Series[str]
    surface: Series[str]
    inputs: Series[str] = pa.Field(isin=["uniform", "given"])
    factor: Series[str]
    value: Series[float] = pa.Field(description="Unit of the factor")
    effect_n_per_mm: Series[float] = pa.Field(
        description="Mean over the other factors, minus the mean over all"
    )

    class Config:
        """Exactly these columns."""

        strict = True
        coerce = True
        ordered = True
