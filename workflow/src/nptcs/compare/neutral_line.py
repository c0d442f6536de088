"""Neutral lines of the cases that a study names, figure 14 of the paper."""

from __future__ import annotations

from collections.abc import Collection, Sequence

import pandas as pd

from nptcs.campaign.record import CaseRecord
from nptcs.tables.tyres.neutral_line import NeutralLine


def case_ids(designs: Sequence[pd.DataFrame], numbers: Sequence[Collection[int]]) -> set[str]:
    """Name the cases with these numbers, study by study.

    Parameters
    ----------
    designs : sequence of DataFrame
        `nptcs.tables.tyres.cases.DesignTable` of each study.
    numbers : sequence of a collection of int
        Numbers of the cases, in the same order of studies.
    """
    return {
        str(case_id)
        for design, of_study in zip(designs, numbers, strict=True)
        for case_id in design.loc[design["case"].isin(list(of_study)), "case_id"]
    }


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
