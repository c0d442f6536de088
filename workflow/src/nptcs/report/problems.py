"""Everything that gave no result, in one list: sheet rows, specimens, cases, fits."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import pandas as pd

from nptcs.tables.laboratory.curves import IngestRecord
from nptcs.tables.problems import Problem, problems_table
from nptcs.tables.status import has_result


def all_problems(
    sheet_errors: Iterable[Sequence[str]],
    records: Iterable[IngestRecord],
    cases: pd.DataFrame,
    found: pd.DataFrame,
) -> pd.DataFrame:
    """Join the problems of all stages, in the order of the stages, as `Problems`.

    Parameters
    ----------
    sheet_errors : iterable of (name, message)
        Rows of the specimen sheet that cannot be used.
    records : iterable of IngestRecord
        How each specimen was read.
    cases : DataFrame
        `nptcs.tables.tyres.cases.Cases`.
    found : DataFrame
        The `Problems` that the reduction and the surfaces have written.
    """
    rows: list[Problem] = [("sheet", name, "", "error", text) for name, text in sheet_errors]
    rows += [
        ("ingest", record.specimen, "", record.status, record.message)
        for record in records
        if not record.understood
    ]
    rows += [
        ("solve", case["case_id"], case["solver"], case["status"], case["message"])
        for case in cases[~has_result(cases["status"])].to_dict("records")
    ]
    return pd.concat([problems_table(rows), found], ignore_index=True)
