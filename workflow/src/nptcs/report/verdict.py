"""The verdict on a run: one line that counts what gave a result."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import pandas as pd

from nptcs.language import tr, tr_count
from nptcs.tables.laboratory.curves import IngestRecord
from nptcs.tables.laboratory.specimens import Specimen
from nptcs.tables.status import has_result


def verdict(
    problems: pd.DataFrame,
    cases: pd.DataFrame,
    sheet: Sequence[Specimen],
    records: Mapping[str, IngestRecord],
) -> tuple[bool, str]:
    """Say in one line whether everything gave a result, with counts.

    Parameters
    ----------
    problems, cases : DataFrame
        ``problems.csv`` and ``cases.csv``.
    sheet : sequence of Specimen
        Good rows of the specimen sheet; bad rows are problems.
    records : mapping of str to IngestRecord
        How each specimen was read.

    Returns
    -------
    sound : bool
        False if there is any problem.
    line : str
        ``No problems: all 87 cases solved; 33 of 34 specimens used (1 left out by the sheet).``
    """
    with_result, number = int(has_result(cases["status"]).sum()), len(cases)
    share = (
        tr("all {number} cases", number=number)
        if with_result == number
        else tr("{with_result} of {number} cases", with_result=with_result, number=number)
    )
    counts = tr("{share} solved; {specimens}.", share=share, specimens=_specimens(sheet, records))
    if problems.empty:
        return True, tr("No problems: {counts}", counts=counts)
    return False, tr_count(
        "{count} problem: {counts}", "{count} problems: {counts}", len(problems), counts=counts
    )


def problem_lines(problems: pd.DataFrame) -> list[str]:
    """Write one line per row of ``problems.csv``."""
    return [
        f"{row.stage} {row.name} {row.solver} {row.status}: {row.message}"
        for row in problems.itertuples()
    ]


def _specimens(sheet: Sequence[Specimen], records: Mapping[str, IngestRecord]) -> str:
    """Count the specimens used, left out and unreadable."""
    included = [s.specimen for s in sheet if s.include]
    failed = [name for name in included if not records[name].understood]
    notes = []
    if left_out := len(sheet) - len(included):
        notes.append(tr("{left_out} left out by the sheet", left_out=left_out))
    if failed:
        notes.append(tr("{count} could not be read", count=len(failed)))
    text = tr(
        "{used} of {total} specimens used", used=len(included) - len(failed), total=len(sheet)
    )
    return f"{text} ({', '.join(notes)})" if notes else text
