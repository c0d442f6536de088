"""Contract of the statistics table: one row per group of specimens and property."""

from __future__ import annotations

from typing import get_args

import pandera.pandas as pa
from pandera.typing.pandas import Series

from nptcs.config.materials.standards.base import Statistic


class StatisticsTable(pa.DataFrameModel):
    """Statistics of groups of specimens (``results/tables/statistics.csv``).

    ``scope`` is "group" (one test, material and orientation) or "pooled" (several tests of one
    material and orientation; the standard deviation is the one within the groups).
    """

    test: Series[str]
    material: Series[str]
    orientation_deg: Series[float] = pa.Field(nullable=True)
    property: Series[str]
    unit: Series[str]
    n: Series[int] = pa.Field(ge=0)
    mean: Series[float] = pa.Field(nullable=True)
    standard_deviation: Series[float] = pa.Field(nullable=True, ge=0)
    cv_percent: Series[float] = pa.Field(nullable=True)
    ci95_low: Series[float] = pa.Field(nullable=True)
    ci95_high: Series[float] = pa.Field(nullable=True)
    mnr: Series[float] = pa.Field(nullable=True, ge=0)
    mnr_critical: Series[float] = pa.Field(nullable=True, ge=0)
    outlier_specimens: Series[str] = pa.Field(description="Only flagged, never left out for it")
    b_basis: Series[float] = pa.Field(nullable=True)
    left_out: Series[str] = pa.Field(description="Specimens that the sheet leaves out, and why")
    rule: Series[str]
    range: Series[str]
    scope: Series[str] = pa.Field(isin=["group", "pooled"])
    median: Series[float] = pa.Field(nullable=True)
    reported_statistic: Series[str] = pa.Field(isin=get_args(Statistic))
    k_b: Series[float] = pa.Field(nullable=True, description="Normal B-basis factor")
    notes: Series[str]
    group_size: Series[int] = pa.Field(ge=0, description="Specimens that count, assessed or not")
    not_assessed: Series[str] = pa.Field(
        description="Specimens without a value, which n does not count, and why"
    )

    class Config:
        """Refuse unknown columns, coerce types, keep the order."""

        strict = True
        coerce = True
        ordered = True
