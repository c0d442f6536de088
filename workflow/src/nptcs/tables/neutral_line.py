"""Contract of the deformed neutral line of the band, figure 14 of the paper."""

from __future__ import annotations

from collections.abc import Collection, Sequence

import pandas as pd
import pandera.pandas as pa
from pandera.typing.pandas import Series

from nptcs.campaign.record import CaseRecord


class NeutralLine(pa.DataFrameModel):
    """Displacement of the band's neutral line, of the cases that ``neutral_line_cases`` names.

    The finite elements follow the middle between the wire layers, the load-bearing model the
    ring of its radius R. A case that failed has no rows.
    """

    study: Series[str]
    case_id: Series[str]
    solver: Series[str]
    load_n: Series[float] = pa.Field(gt=0)
    theta_deg: Series[float] = pa.Field(
        ge=-180, le=180, description="Before the load, 0 at the middle of the contact"
    )
    radial_mm: Series[float] = pa.Field(description="Relative to the rim, outward positive")
    tangential_mm: Series[float] = pa.Field(description="Towards larger angles")

    class Config:
        """Exactly these columns, in this order."""

        strict = True
        coerce = True
        ordered = True


def neutral_lines(records: Sequence[CaseRecord], case_ids: Collection[str]) -> pd.DataFrame:
    """Gather the neutral lines of these cases by all solvers that give one, as `NeutralLine`."""
    tables = [
        pd.DataFrame(
            {
                "study": record.study,
                "case_id": record.case_id,
                "solver": record.solver,
                "load_n": record.load_n,
                **record.result.neutral_line,
            }
        )
        for record in records
        if record.case_id in case_ids and record.result.neutral_line is not None
    ]
    columns = list(NeutralLine.to_schema().columns)
    return (
        pd.concat(tables, ignore_index=True)[columns] if tables else pd.DataFrame(columns=columns)
    )
