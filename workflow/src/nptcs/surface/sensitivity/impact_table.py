"""Impact values of all surfaces by every averaging rule, as one table."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd

from nptcs.config.studies.sensitivity import AveragingRule
from nptcs.surface.fit import Surface
from nptcs.surface.sensitivity.gradients import impact
from nptcs.surface.sensitivity.ties import near_ties

COLUMNS = [
    "solver", "study", "factor", "rule", "gradient", "range", "impact", "nominal_range",
    "values_used", "cases", "failed_cases", "near_tie_with",
]  # fmt: skip


def impact_table(
    surfaces: Mapping[str, Mapping[str, Surface]],
    designs: Mapping[str, pd.DataFrame],
    qualities: pd.DataFrame,
    rules: Sequence[AveragingRule],
    near_tie_ratio: float,
) -> pd.DataFrame:
    """Compute the impact values of every study, solver and rule.

    Parameters
    ----------
    surfaces : mapping of str to mapping of str to Surface
        By study and solver.
    designs : mapping of str to DataFrame
        Design tables by study: the given values, and how many cases there should be.
    qualities : DataFrame
        `nptcs.tables.analysis.surface.SurfaceQuality` of these surfaces.
    rules : sequence of str
        Averaging rules.
    near_tie_ratio : float
        `nptcs.config.studies.sensitivity.Sensitivity.near_tie_ratio`.

    Returns
    -------
    DataFrame
        The columns `COLUMNS` (and no rows without surfaces).
    """
    failed = qualities.set_index(["study", "solver"])["failed_cases"]
    tables = [
        _with_basis(
            impact(surface, rule), surface, designs[study], int(failed[study, solver])
        ).assign(solver=solver, study=study)
        for study, by_solver in surfaces.items()
        for solver, surface in by_solver.items()
        for rule in rules
    ]
    if not tables:
        return pd.DataFrame(columns=COLUMNS)
    table = pd.concat(tables, ignore_index=True)
    for _, rows in table.groupby("study"):
        ties = near_ties(rows, ["solver", "rule"], "factor", "impact", near_tie_ratio)
        table.loc[rows.index, "near_tie_with"] = ties
    return table[COLUMNS]


def _with_basis(
    table: pd.DataFrame, surface: Surface, design: pd.DataFrame, failed: int
) -> pd.DataFrame:
    """Add which values the index is computed in, and on how many cases it is based."""
    used = [
        np.isin(surface.x[:, axis].round(9), design[factor].to_numpy(float).round(9)).all()
        for axis, factor in enumerate(surface.factors)
    ]
    return table.assign(
        nominal_range=np.ptp(design[list(surface.factors)].to_numpy(float), axis=0),
        values_used=["given" if given else "realised" for given in used],
        cases=surface.points,
        failed_cases=failed,
    )
