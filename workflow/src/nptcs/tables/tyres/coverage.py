"""Contract of the map of failed and missing cases."""

from __future__ import annotations

import pandera.pandas as pa
from pandera.typing.pandas import Series


class CaseCoverage(pa.DataFrameModel):
    """``case_coverage.csv``: solved, failed and missing cases, one row per level of a factor."""

    study: Series[str]
    solver: Series[str]
    factor: Series[str] = pa.Field(description="Empty in the row for the whole study")
    level: Series[str] = pa.Field(
        description="Given level, or a quarter of the range where a factor has many values"
    )
    cases: Series[int] = pa.Field(ge=0, description="Cases of the design")
    solved: Series[int] = pa.Field(ge=0)
    failed: Series[int] = pa.Field(ge=0, description="Cases that ended without a result")
    missing: Series[int] = pa.Field(ge=0, description="Cases without a record")
    solved_percent: Series[float] = pa.Field(ge=0, le=100)
    statuses: Series[str] = pa.Field(description="How the failed cases ended")
    estimable: Series[str] = pa.Field(
        description="Whole study: whether the solved cases determine the polynomial's terms"
    )

    class Config:
        """Exactly these columns."""

        strict = True
        coerce = True
        ordered = True
