"""Contracts of the design tables and of the results of all cases."""

from __future__ import annotations

import pandera.pandas as pa
from pandera.typing.pandas import Series

from nptcs.tables.status import Status

RESPONSES = ("vertical_stiffness_n_per_mm", "displacement_mm")


def realised_column(factor: str) -> str:
    """Name the column of ``cases.csv`` with the value of a factor that a solver really used."""
    return f"realised_{factor}"


class DesignTable(pa.DataFrameModel):
    """A design table: one row per case, then a column for each factor and each fixed value."""

    case_id: Series[str] = pa.Field(unique=True)
    case: Series[int] = pa.Field(ge=1, unique=True)

    class Config:
        """Factors differ from study to study."""

        strict = False
        coerce = True


class Cases(pa.DataFrameModel):
    """``cases.csv``: how each case ended; factors and further responses are to the right."""

    study: Series[str]
    case_id: Series[str]
    solver: Series[str]
    status: Series[str] = pa.Field(isin=list(Status))
    message: Series[str]
    load_n: Series[float] = pa.Field(nullable=True, gt=0, description="Empty for single spokes")
    vertical_stiffness_n_per_mm: Series[float] = pa.Field(nullable=True, gt=0)
    displacement_mm: Series[float] = pa.Field(nullable=True, gt=0)
    wall_time_s: Series[float] = pa.Field(ge=0)
    solver_version: Series[str]
    key: Series[str]

    class Config:
        """Factors and extra responses differ from study to study."""

        strict = False
        coerce = True
        unique = ["solver", "case_id"]
