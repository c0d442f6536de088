"""Computed stiffness compared with the published one: tables 5 and 7 of the paper."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass

import numpy as np
import pandas as pd

from nptcs.tables.published.stiffness import (
    COMPUTED_STIFFNESS,
    DIFFERENCE,
    PUBLISHED,
    PUBLISHED_STIFFNESS,
    STIFFNESS,
    StiffnessAgainstPublished,
    StiffnessByLevel,
    StiffnessErrors,
)


@dataclass(frozen=True)
class Comparison:
    """What the comparison must know about a study.

    Parameters
    ----------
    design : DataFrame
        ``case_id``, ``case``, the factors and fixed values.
    factors : tuple of str
        The factors that are varied.
    solvers : tuple of str
        Solvers that give a vertical stiffness, without `PUBLISHED`.
    calibration_cases : mapping of str to a collection of int
        Numbers of the cases that each solver was calibrated on.
    """

    design: pd.DataFrame
    factors: tuple[str, ...]
    solvers: tuple[str, ...]
    calibration_cases: Mapping[str, Collection[int]]


def compare_published(cases: pd.DataFrame, studies: Mapping[str, Comparison]) -> pd.DataFrame:
    """Compare each computed stiffness with the published one, as `StiffnessAgainstPublished`.

    Parameters
    ----------
    cases : DataFrame
        `nptcs.tables.tyres.cases.Cases` of all studies and solvers.
    studies : mapping of str to Comparison
        The studies that `PUBLISHED` answers.
    """
    columns = list(StiffnessAgainstPublished.to_schema().columns)
    tables = [
        _one_solver(cases[cases["study"] == study], comparison, solver).assign(study=study)
        for study, comparison in studies.items()
        for solver in comparison.solvers
    ]
    if not tables:
        return pd.DataFrame(columns=columns)
    table = pd.concat(tables, ignore_index=True)
    return table[[*columns, *(name for name in table if name not in columns)]]


def _one_solver(cases: pd.DataFrame, comparison: Comparison, solver: str) -> pd.DataFrame:
    by_solver = {
        name: cases[cases["solver"] == name].set_index("case_id") for name in (solver, PUBLISHED)
    }
    table = comparison.design.copy()
    names = table["case_id"]
    table["solver"] = solver
    table["status"] = by_solver[solver]["status"].loc[names].to_numpy()
    table[COMPUTED_STIFFNESS] = by_solver[solver][STIFFNESS].loc[names].to_numpy(float)
    table[PUBLISHED_STIFFNESS] = by_solver[PUBLISHED][STIFFNESS].loc[names].to_numpy(float)
    table[DIFFERENCE] = 100 * (table[COMPUTED_STIFFNESS] / table[PUBLISHED_STIFFNESS] - 1)
    calibrated = list(comparison.calibration_cases.get(solver, ()))
    table["used_for_calibration"] = table["case"].isin(calibrated)
    return table


def stiffness_errors(table: pd.DataFrame) -> pd.DataFrame:
    """Summarise the differences of `StiffnessAgainstPublished`, as `StiffnessErrors`."""
    rows = []
    groups = table.groupby(["study", "solver", "used_for_calibration"], sort=False)
    for (study, solver, calibrated), cases in groups:
        compared = cases.dropna(subset=[DIFFERENCE])
        difference = compared[DIFFERENCE].to_numpy(float)
        row = {
            "study": study,
            "solver": solver,
            "group": "calibration" if calibrated else "blind",
            "cases": len(cases),
            "compared": len(compared),
            "largest_case_id": "",
        }
        if len(compared):
            largest = int(np.argmax(np.abs(difference)))
            row |= {
                "mean_percent": difference.mean(),
                "mean_absolute_percent": np.abs(difference).mean(),
                "largest_percent": difference[largest],
                "largest_case_id": compared["case_id"].iloc[largest],
            }
        rows.append(row)
    errors = pd.DataFrame(rows, columns=list(StiffnessErrors.to_schema().columns))
    return errors.sort_values(["study", "solver", "group"], ignore_index=True)


def stiffness_by_level(table: pd.DataFrame, studies: Mapping[str, Comparison]) -> pd.DataFrame:
    """Average `StiffnessAgainstPublished` over the cases at each level, as `StiffnessByLevel`."""
    rows = []
    compared = table.dropna(subset=[DIFFERENCE])
    for (study, solver), cases in compared.groupby(["study", "solver"], sort=False):
        for factor in studies[str(study)].factors:
            first: pd.Series[float] | None = None
            for level, group in _balanced(cases, studies[str(study)], factor).groupby(factor):
                mean = group[[COMPUTED_STIFFNESS, PUBLISHED_STIFFNESS]].mean()
                first = mean if first is None else first
                change = 100 * (mean / first - 1)
                rows.append(
                    {
                        "study": study,
                        "solver": solver,
                        "factor": factor,
                        "level": level,
                        "compared": len(group),
                        "computed_mean_n_per_mm": mean[COMPUTED_STIFFNESS],
                        "published_mean_n_per_mm": mean[PUBLISHED_STIFFNESS],
                        "computed_change_percent": change[COMPUTED_STIFFNESS],
                        "published_change_percent": change[PUBLISHED_STIFFNESS],
                        "mean_difference_percent": group[DIFFERENCE].mean(),
                        "lowest_difference_percent": group[DIFFERENCE].min(),
                        "highest_difference_percent": group[DIFFERENCE].max(),
                    }
                )
    return pd.DataFrame(rows, columns=list(StiffnessByLevel.to_schema().columns))


def _balanced(cases: pd.DataFrame, study: Comparison, factor: str) -> pd.DataFrame:
    """Keep the combinations of the other factors at which every level was compared."""
    others = [name for name in study.factors if name != factor]
    levels = study.design[factor].nunique()
    if not others:
        return cases if len(cases) == levels else cases.iloc[:0]
    return cases[cases.groupby(others)[factor].transform("nunique") == levels]
