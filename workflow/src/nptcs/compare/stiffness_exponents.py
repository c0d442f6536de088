"""Exponents of each modulus in the stiffness, computed and published."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np
import pandas as pd

from nptcs.arrays import Array
from nptcs.compare.published_stiffness import Comparison
from nptcs.tables.published.stiffness import (
    COMPUTED_STIFFNESS,
    DIFFERENCE,
    PUBLISHED_STIFFNESS,
    StiffnessExponents,
)

MODULUS = "_mpa"


def stiffness_exponents(table: pd.DataFrame, studies: Mapping[str, Comparison]) -> pd.DataFrame:
    """Find d ln K / d ln C10 of `StiffnessAgainstPublished`, as `StiffnessExponents`.

    Over all levels of a modulus it is the slope of the least-squares line through the logarithms.
    Factors that are not moduli have no exponent.

    Parameters
    ----------
    table : DataFrame
        Cases without both values do not count; a modulus with one level left gives no row.
    studies : mapping of str to Comparison
    """
    rows = []
    compared = table.dropna(subset=[DIFFERENCE])
    for (study, solver), cases in compared.groupby(["study", "solver"], sort=False):
        factors = studies[str(study)].factors
        for factor in (name for name in factors if name.endswith(MODULUS)):
            others = [name for name in factors if name != factor]
            for held, group in _groups(cases, others):
                who = {"study": study, "solver": solver, "factor": factor, "held": held}
                rows += [{**who, **row} for row in _exponents(group.sort_values(factor), factor)]
    return pd.DataFrame(rows, columns=list(StiffnessExponents.to_schema().columns))


def _groups(cases: pd.DataFrame, others: list[str]) -> Iterator[tuple[str, pd.DataFrame]]:
    """Yield the cases at each combination of the other factors, with its description."""
    if not others:
        yield "", cases
        return
    for levels, group in cases.groupby(others):
        pairs = zip(others, levels, strict=True)
        yield ", ".join(f"{name} {level:g}" for name, level in pairs), group


def _exponents(cases: pd.DataFrame, factor: str) -> Iterator[dict[str, float]]:
    """Exponent over all levels, then that of each step if there are several."""
    level = cases[factor].to_numpy(float)
    if len(level) > 1:
        yield _exponent(cases, level)
    if len(level) > 2:
        for step in range(len(level) - 1):
            part = slice(step, step + 2)
            yield _exponent(cases.iloc[part], level[part])


def _exponent(cases: pd.DataFrame, level: Array) -> dict[str, float]:
    computed, published = (
        float(np.polyfit(np.log(level), np.log(cases[name].to_numpy(float)), 1)[0])
        for name in (COMPUTED_STIFFNESS, PUBLISHED_STIFFNESS)
    )
    return {
        "low_mpa": level[0],
        "high_mpa": level[-1],
        "levels": len(level),
        "computed_exponent": computed,
        "published_exponent": published,
        "exponent_difference": computed - published,
    }
