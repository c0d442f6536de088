"""Where cases failed or are missing, and what that does to the terms of the polynomial."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import pandas as pd

from nptcs.errors import InputError
from nptcs.surface.cases import as_realised
from nptcs.surface.fit import coding, refuse_aliased
from nptcs.surface.response_surface import box
from nptcs.tables.status import has_result
from nptcs.tables.tyres.coverage import CaseCoverage
from nptcs.terms import parse

MANY_VALUES = 10
"""A factor with more values than this is shown by quarters of its range."""

NO_TERMS = "no surface is requested"


@dataclass(frozen=True)
class Planned:
    """What a study should have solved.

    Parameters
    ----------
    design : DataFrame
        `nptcs.tables.tyres.cases.DesignTable`.
    factors, solvers, terms : sequences of str
        As the configuration names them.
    least_cases : int
        Solved cases below which no surface is fitted.
    """

    design: pd.DataFrame
    factors: Sequence[str]
    solvers: Sequence[str]
    terms: Sequence[str]
    least_cases: int


def coverage_table(cases: pd.DataFrame, studies: Mapping[str, Planned]) -> pd.DataFrame:
    """Make `CaseCoverage` of all studies.

    Parameters
    ----------
    cases : DataFrame
        `nptcs.tables.tyres.cases.Cases`.
    studies : mapping of str to Planned
        By name of the study.
    """
    rows = []
    for study, planned in studies.items():
        for solver in planned.solvers:
            records = cases[(cases["study"] == study) & (cases["solver"] == solver)]
            status = planned.design["case_id"].map(records.set_index("case_id")["status"])
            status = status.fillna("missing")
            key = {"study": study, "solver": solver}
            solved = as_realised(records[has_result(records["status"])], planned.factors)
            whole = {"factor": "", "level": "", "estimable": estimable(solved, planned)}
            rows.append({**key, **whole, **_counts(status)})
            for factor in planned.factors:
                groups = status.groupby(_levels(planned.design[factor]), sort=False)
                rows += [
                    {**key, "factor": factor, "level": str(level), "estimable": "", **_counts(part)}
                    for level, part in groups
                ]
    return pd.DataFrame(rows, columns=list(CaseCoverage.to_schema().columns))


def estimable(solved: pd.DataFrame, planned: Planned) -> str:
    """Say whether the solved cases, factors as realised, determine all terms."""
    if not planned.terms:
        return NO_TERMS
    if len(solved) < planned.least_cases:
        return (
            f"no surface: {len(solved)} of {len(planned.design)} cases solved, at least "
            f"{planned.least_cases} are required"
        )
    x = solved[list(planned.factors)].to_numpy(float)
    lower, upper = box(x)
    constant = [name for name, same in zip(planned.factors, lower == upper, strict=True) if same]
    if constant:
        return f"no surface: one level left of {', '.join(constant)}"
    polynomial = parse(planned.terms, planned.factors)
    centre, half = coding(x)
    try:
        refuse_aliased(polynomial.matrix((x - centre) / half), polynomial.names)
    except InputError as error:
        return f"no surface: {error.message}"
    return f"all {len(polynomial)} terms"


def _levels(values: pd.Series) -> pd.Series:
    """Name the level of each case, or the quarter of the range that it is in."""
    if values.nunique() <= MANY_VALUES:
        return values.map("{:.6g}".format)
    low, high = values.min(), values.max()
    edges = [low + (high - low) * part / 4 for part in range(5)]
    quarter = ((values - low) / (high - low) * 4).astype(int).clip(upper=3)
    return quarter.map(lambda part: f"{edges[part]:.6g} to {edges[part + 1]:.6g}")


def _counts(status: pd.Series) -> dict[str, object]:
    """Count the cases of a level by how they ended."""
    counts = status.value_counts()
    solved, missing = int(has_result(status).sum()), int(counts.get("missing", 0))
    failed = status[~has_result(status) & status.ne("missing")].value_counts()
    return {
        "cases": len(status),
        "solved": solved,
        "failed": int(failed.sum()),
        "missing": missing,
        "solved_percent": 100 * solved / len(status),
        "statuses": ", ".join(f"{name} {number}" for name, number in sorted(failed.items())),
    }
