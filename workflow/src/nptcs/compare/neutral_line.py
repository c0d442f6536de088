"""Neutral lines of the cases that a study names, figure 14 of the paper."""

from __future__ import annotations

from collections.abc import Collection, Sequence

import pandas as pd

from nptcs.campaign.record import CaseRecord
from nptcs.tables.neutral_line import NeutralLine


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
