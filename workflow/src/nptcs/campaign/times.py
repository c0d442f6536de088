"""How long the cases of a study will take, from those that were solved before."""

from __future__ import annotations

from pathlib import Path

from nptcs.tables.cases import Cases
from nptcs.tables.io import read_table


def seconds_per_case(path: Path) -> dict[str, float]:
    """Return the median wall time of a solved case by solver; empty without an earlier run.

    Raises
    ------
    InputError
        For a file that is not a table of cases.
    """
    if not path.is_file():
        return {}
    cases = read_table(path, Cases)
    solved = cases[cases["status"] == "ok"]
    times = solved.groupby("solver")["wall_time_s"].median()
    return {str(solver): float(seconds) for solver, seconds in times.items()}


def time_in_words(cases: int, seconds: float | None) -> str:
    """Say how long cases take one after the other; cases that are kept take nothing.

    Examples
    --------
    >>> time_in_words(63, 40.0)
    '63 cases × 40 s = 42 min on one core, less those that are kept from earlier runs'
    >>> time_in_words(63, None)
    '63 cases, time not known: no earlier run has solved one'
    """
    if seconds is None:
        return f"{cases} cases, time not known: no earlier run has solved one"
    total = cases * seconds
    if total < 100:
        whole = f"{total:.2g} s"
    else:
        whole = f"{total / 60:.0f} min" if total < 6000 else f"{total / 3600:.1f} h"
    return (
        f"{cases} cases × {seconds:.2g} s = {whole} on one core, less those that are kept from "
        "earlier runs"
    )
