"""Factors whose order of importance is not settled: near ties."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

import pandas as pd


def near_ties(
    table: pd.DataFrame, keys: Sequence[str], factor: str, size: str, ratio: float
) -> pd.Series:
    """Name for each row the factors that are a near tie with its factor.

    Two factors are a near tie where, in some ranking, the smaller effect is at least `ratio` times
    the larger, or where rankings disagree on their order.

    Parameters
    ----------
    table : DataFrame
        One row per ranking and factor.
    keys : sequence of str
        Columns that name a ranking.
    factor, size : str
        Columns with the factor and with its effect, by which it is ranked.
    ratio : float
        Between 0 and 1.

    Returns
    -------
    Series of str
        Names in alphabetical order, separated by commas; empty where there is none.
    """
    if table.empty:
        return pd.Series(dtype=str)
    sizes = table.assign(size=table[size].abs()).pivot_table(
        index=list(keys), columns=factor, values="size"
    )
    names = [str(name) for name in sizes]
    partners: dict[str, set[str]] = {name: set() for name in names}
    for one, other in combinations(names, 2):
        both = sizes[[one, other]].dropna()
        smaller, larger = both.min(axis=1), both.max(axis=1)
        close = bool((smaller >= ratio * larger).any())
        larger_first = both[one] > both[other]
        if close or (larger_first.any() and not larger_first.all()):
            partners[one].add(other)
            partners[other].add(one)
    return table[factor].map(lambda name: ", ".join(sorted(partners.get(name, ()))))
