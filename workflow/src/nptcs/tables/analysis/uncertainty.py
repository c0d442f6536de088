"""Contracts of the uncertainty of responses and of what it comes from."""

from __future__ import annotations

from enum import StrEnum

import pandas as pd
import pandera.pandas as pa
from pandera.typing.pandas import Series


class SourceKind(StrEnum):
    """Where an uncertainty comes from."""

    TEST = "test"
    STATED = "stated"
    TOLERANCE = "tolerance"
    SURFACE = "surface"


class ResponseUncertainty(pa.DataFrameModel):
    """``uncertainty.csv``: distribution of each response, one row per design and response.

    It includes all that scatters or is not known exactly: tests, stated rubbers, tolerances and the
    surface's own error. It does not include the solver's bias, which has its own columns.
    """

    study: Series[str]
    solver: Series[str]
    design: Series[str] = pa.Field(description="reference, or the name of a decision")
    factors: Series[str] = pa.Field(description="Values of the factors, as the solver uses them")
    response: Series[str]
    at: Series[str] = pa.Field(description="Load or displacement, with its unit")
    unit: Series[str]
    nominal: Series[float] = pa.Field(description="At the nominal values")
    mean: Series[float] = pa.Field(description="Over the samples")
    sd: Series[float] = pa.Field(ge=0, description="Standard deviation of the samples")
    low: Series[float] = pa.Field(description="Lower end of the interval, a quantile")
    high: Series[float] = pa.Field(description="Upper end of the interval, a quantile")
    confidence_percent: Series[float] = pa.Field(gt=0, lt=100, description="Of the interval")
    interaction_percent: Series[float] = pa.Field(
        description="Share of the variance that no input explains alone; sampling adds about ± 1"
    )
    bias_mean_percent: Series[float] = pa.Field(
        nullable=True,
        description="Mean difference of the solver from the published stiffness at blind cases of "
        "the study; not part of the interval",
    )
    bias_largest_percent: Series[float] = pa.Field(
        nullable=True, description="The largest such difference"
    )
    blind_cases: Series[pd.Int64Dtype] = pa.Field(
        nullable=True, description="Number of blind cases"
    )
    surface: Series[str] = pa.Field(description="Model of the response")
    cases: Series[int] = pa.Field(gt=0, description="Cases that it was fitted to")
    card: Series[str] = pa.Field(
        description="standard_error or scatter: which uncertainty of the card is meant"
    )
    note: Series[str] = pa.Field(description="What is not assessed, and why")

    class Config:
        """Exactly these columns."""

        strict = True
        coerce = True
        ordered = True
        unique = ["study", "solver", "design", "response", "at"]


class UncertaintyShares(pa.DataFrameModel):
    """``uncertainty_shares.csv``: which tests and tolerances make a response uncertain.

    One row per design, response and source, the largest first. A share is the variance by this
    source alone, the others at their nominal values, over the sum of all.
    """

    study: Series[str]
    solver: Series[str]
    design: Series[str]
    response: Series[str]
    at: Series[str]
    unit: Series[str]
    kind: Series[str] = pa.Field(
        isin=[*SourceKind, "not assessed"],
        description="stated: a number from the configuration in place of a test",
    )
    quantities: Series[str] = pa.Field(description="What varies, with its standard deviation")
    source: Series[str] = pa.Field(description="Specimens, key of the configuration, or reason")
    effect_sd: Series[float] = pa.Field(
        ge=0, nullable=True, description="Standard deviation of the response by this source alone"
    )
    share_percent: Series[float] = pa.Field(ge=0, le=100, nullable=True)

    class Config:
        """Exactly these columns."""

        strict = True
        coerce = True
        ordered = True
