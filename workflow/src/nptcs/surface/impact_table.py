"""Impact values of all surfaces by every averaging rule, as one table."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import pandas as pd

from nptcs.config.sensitivity import AveragingRule
from nptcs.surface.fit import Surface
from nptcs.surface.sensitivity import impact

COLUMNS = ["solver", "study", "factor", "rule", "gradient", "range", "impact"]


def impact_table(
    surfaces: Mapping[str, Mapping[str, Surface]],
    designs: Mapping[str, pd.DataFrame],
    rules: Sequence[AveragingRule],
) -> pd.DataFrame:
    """Take the impact values of every study, solver and rule.

    Parameters
    ----------
    surfaces : mapping of str to mapping of str to Surface
        By study and solver.
    designs : mapping of str to DataFrame
        Design tables by study.
    rules : sequence of str
        Averaging rules.

    Returns
    -------
    DataFrame
        The columns `COLUMNS` (and no rows without surfaces).
    """
    tables = [
        impact(surface, designs[study], rule).assign(solver=solver, study=study)
        for study, by_solver in surfaces.items()
        for solver, surface in by_solver.items()
        for rule in rules
    ]
    return pd.concat(tables) if tables else pd.DataFrame(columns=COLUMNS)
