"""The cases of a study as a surface sees them: in the values that the solver really used."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

from nptcs.tables.status import has_result
from nptcs.tables.tyres.cases import realised_column


@dataclass(frozen=True)
class SolvedCases:
    """The cases of one solver that a surface is fitted to.

    Parameters
    ----------
    table : DataFrame
        Rows of ``cases.csv`` with the status ok, factors as realised, one row per tyre.
    changed : tuple of str
        Factors for which the solver used values other than the given ones.
    same : int
        Cases left out because the solver made the same tyre for another case's values.
    failed : int
        Cases of the solver that gave no result.
    """

    table: pd.DataFrame
    changed: tuple[str, ...]
    same: int
    failed: int


def solved_cases(cases: pd.DataFrame, solver: str, factors: Sequence[str]) -> SolvedCases:
    """Take the cases of a solver to which a surface can be fitted.

    Cases whose given values differ but whose realised values do not are one point: the solver
    has computed the same tyre twice. Cases with equal given values are replicates and are all kept.

    Parameters
    ----------
    cases : DataFrame
        Rows of one study in ``cases.csv`` (`nptcs.tables.tyres.cases.Cases`).
    solver : str
        Name of the solver.
    factors : sequence of str
        Factors of the study.

    Returns
    -------
    SolvedCases
    """
    rows = cases[cases["solver"] == solver]
    solved = rows[has_result(rows["status"])]
    used = as_realised(solved, factors)
    names = list(factors)
    # the given values of a case as one number: equal numbers, equal values
    given = solved.groupby(names, sort=False).ngroup()
    first_given = given.groupby([used[name] for name in names], sort=False).transform("first")
    kept = given == first_given if len(solved) else pd.Series(dtype=bool)
    return SolvedCases(
        table=used[kept.to_numpy(bool)],
        changed=tuple(changed_factors(solved, factors)),
        same=int((~kept).sum()),
        failed=len(rows) - len(solved),
    )


def as_realised(cases: pd.DataFrame, factors: Sequence[str]) -> pd.DataFrame:
    """Replace the given values of the factors by those that the solver reports as used.

    Returns the same rows of ``cases.csv``; a case without a reported value was solved at the
    given one.
    """
    table = cases.copy()
    for factor in factors:
        column = realised_column(factor)
        if column in table:
            table[factor] = table[column].fillna(table[factor])
    return table


def changed_factors(cases: pd.DataFrame, factors: Sequence[str]) -> list[str]:
    """Name the factors for which a solver used values other than the given ones."""
    used = as_realised(cases, factors)
    return [
        factor
        for factor in factors
        if not np.allclose(used[factor], cases[factor], rtol=1e-9, atol=0.0)
    ]
