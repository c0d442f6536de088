"""Comprehensive impact values compared with table 9 of the paper."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np
import pandas as pd

from nptcs.tables.analysis.impact import Impact


def with_published(
    impact: pd.DataFrame, published: pd.DataFrame, refused: Collection[str] = ()
) -> pd.DataFrame:
    """Join the published values of table 9.

    Parameters
    ----------
    impact : DataFrame
        ``solver, study, factor, rule, gradient, range, impact, nominal_range, values_used, cases,
        failed_cases``.
    published : DataFrame
        ``study, factor, gradient, range, impact`` as printed; may be empty.
    refused : collection of str
        Studies that are not under the conditions of table 9 (`nptcs.compare.conditions`).

    Returns
    -------
    DataFrame
        As `Impact`. A published value is given only where the range of the levels is the same;
        only these factors are ranked, over all studies, for each solver and rule.
    """
    table_9 = published[~published["study"].isin(list(refused))].rename(
        columns={"gradient": "published_gradient", "impact": "published_impact"}
    )
    table = impact.merge(table_9, how="left", on=["study", "factor"], suffixes=("", "_published"))
    other_range = ~np.isclose(table["nominal_range"], table.pop("range_published").astype(float))
    table.loc[other_range, ["published_gradient", "published_impact"]] = np.nan
    table["difference_percent"] = 100 * (table["impact"].abs() / table["published_impact"] - 1)
    size = pd.DataFrame(
        {
            "rank": table["impact"].abs().where(table["published_impact"].notna()),
            "published_rank": table["published_impact"],
        }
    )
    ranks = size.groupby([table["solver"], table["rule"]]).rank(ascending=False, method="min")
    for name in ("rank", "published_rank"):
        table[name] = ranks[name].astype("Int64")
    return table[list(Impact.to_schema().columns)]
