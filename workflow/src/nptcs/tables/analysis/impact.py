"""Contract of the comprehensive impact values."""

from __future__ import annotations

import pandas as pd
import pandera.pandas as pa
from pandera.typing.pandas import Series


class Impact(pa.DataFrameModel):
    """``impact.csv``: average gradient × range, computed and published (table 9)."""

    solver: Series[str]
    study: Series[str]
    factor: Series[str]
    rule: Series[str] = pa.Field(description="How the gradient is averaged")
    gradient: Series[float] = pa.Field(description="N/mm per unit of the factor")
    range: Series[float] = pa.Field(
        gt=0, description="Highest minus lowest value that the solver realised"
    )
    impact: Series[float] = pa.Field(description="gradient × range, N/mm")
    nominal_range: Series[float] = pa.Field(gt=0, description="Highest minus lowest level")
    values_used: Series[str] = pa.Field(
        description="'realised' where the solver used other values of the factor than the given "
        "ones, otherwise 'given'"
    )
    cases: Series[int] = pa.Field(gt=0, description="Cases that the surface was fitted to")
    failed_cases: Series[int] = pa.Field(
        ge=0, description="Cases of the design without a result: they are not in the index"
    )
    near_tie_with: Series[str] = pa.Field(
        description="Factors of the study whose order relative to this one is not settled: near "
        "in size, or in another order by another rule or solver"
    )
    published_gradient: Series[float] = pa.Field(nullable=True)
    published_impact: Series[float] = pa.Field(nullable=True)
    difference_percent: Series[float] = pa.Field(
        nullable=True, description="(|impact| - published) / published"
    )
    rank: Series[pd.Int64Dtype] = pa.Field(
        nullable=True,
        ge=1,
        description="By |impact|, among the solver's factors that have a published value",
    )
    published_rank: Series[pd.Int64Dtype] = pa.Field(
        nullable=True, ge=1, description="By the published impact, among the same factors"
    )

    class Config:
        """Exactly these columns."""

        strict = True
        coerce = True
        ordered = True
