"""Contracts of the design tables and of the results of all cases."""

from __future__ import annotations

from collections.abc import Sequence

import pandas as pd
import pandera.pandas as pa
from pandera.typing.pandas import Series

from nptcs.campaign.record import CaseRecord

RESPONSES = ("vertical_stiffness_n_per_mm", "displacement_mm")


class Design(pa.DataFrameModel):
    """A design table: a row a case, then a column for each factor and each fixed value."""

    case_id: Series[str] = pa.Field(unique=True)
    case: Series[int] = pa.Field(ge=1, unique=True)

    class Config:
        """Factors differ from study to study."""

        strict = False
        coerce = True


class Cases(pa.DataFrameModel):
    """``cases.csv``: how each case ended; factors and further responses stand to the right."""

    study: Series[str]
    case_id: Series[str]
    solver: Series[str]
    status: Series[str] = pa.Field(isin=["ok", "diverged", "timeout", "licence", "error"])
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


def cases_table(records: Sequence[CaseRecord]) -> pd.DataFrame:
    """Lay records out as the table `Cases`.

    Parameters
    ----------
    records : sequence of CaseRecord
        Of any number of studies and solvers.

    Returns
    -------
    DataFrame
        ``study, case_id, solver, status, message``, the factors and fixed values of all studies,
        ``load_n``, the responses, what else solvers report, and where each row came from.
    """
    values = list(dict.fromkeys(name for record in records for name in record.values))
    extra = list(dict.fromkeys(name for record in records for name in record.result.extra))
    rows = [
        {
            "study": record.study,
            "case_id": record.case_id,
            "solver": record.solver,
            "status": record.result.status.value,
            "message": record.result.message,
            **{name: record.values.get(name) for name in values},
            "load_n": record.load_n,
            **{name: getattr(record.result, name) for name in RESPONSES},
            **{name: record.result.extra.get(name) for name in extra},
            "wall_time_s": record.wall_time_s,
            "solver_version": record.solver_version,
            "key": record.key,
        }
        for record in records
    ]
    table = pd.DataFrame(rows)
    numbers = [*values, "load_n", *RESPONSES, *extra]
    table[numbers] = table[numbers].astype(float)
    return table
