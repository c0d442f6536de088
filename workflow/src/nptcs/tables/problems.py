"""Contract of the list of everything that went wrong in a run."""

from collections.abc import Sequence

import pandas as pd
import pandera.pandas as pa
from pandera.typing.pandas import Series

STAGES = ("sheet", "ingest", "reduce", "solve", "surface", "uncertainty", "decision")


class Problems(pa.DataFrameModel):
    """``problems.csv``: specimens, fits and cases that gave no result, and why."""

    stage: Series[str] = pa.Field(isin=STAGES)
    name: Series[str] = pa.Field(description="Specimen, case or surface")
    solver: Series[str] = pa.Field(description="Empty where no solver is concerned")
    status: Series[str]
    message: Series[str]

    class Config:
        """Exactly these columns."""

        strict = True
        coerce = True
        ordered = True


Problem = tuple[str, str, str, str, str]
"""Stage, name, solver, status, message."""


def problems_table(problems: Sequence[Problem]) -> pd.DataFrame:
    """Write problems as `Problems`."""
    return pd.DataFrame(list(problems), columns=list(Problems.to_schema().columns), dtype=str)
