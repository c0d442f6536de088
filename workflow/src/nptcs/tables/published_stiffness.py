"""Contracts of the computed stiffness beside the published one: tables 5 and 7 of the paper."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass

import numpy as np
import pandas as pd
import pandera.pandas as pa
from pandera.typing.pandas import Series

PUBLISHED = "published"
"""The solver whose results the others stand beside."""

STIFFNESS = "vertical_stiffness_n_per_mm"
COMPUTED_STIFFNESS, PUBLISHED_STIFFNESS, DIFFERENCE = (
    "computed_stiffness_n_per_mm",
    "published_stiffness_n_per_mm",
    "difference_percent",
)


class StiffnessAgainstPublished(pa.DataFrameModel):
    """Computed vertical stiffness beside the published one, a row a case and solver.

    Factors and fixed values stand to the right, as in ``cases.csv``. A case that failed is a row
    with its status and without a computed value.
    """

    study: Series[str]
    case_id: Series[str]
    case: Series[int] = pa.Field(ge=1, description="Number in the study")
    solver: Series[str]
    status: Series[str] = pa.Field(description="Of the computed case")
    computed_stiffness_n_per_mm: Series[float] = pa.Field(nullable=True, gt=0)
    published_stiffness_n_per_mm: Series[float] = pa.Field(nullable=True, gt=0)
    difference_percent: Series[float] = pa.Field(
        nullable=True, description="(computed - published) / published"
    )
    used_for_calibration: Series[bool] = pa.Field(
        description="Whether the solver was calibrated on this case (study key calibration_cases)"
    )

    class Config:
        """Factors differ from study to study."""

        strict = False
        coerce = True
        unique = ["solver", "case_id"]


class StiffnessErrors(pa.DataFrameModel):
    """Differences of ``stiffness_against_published.csv`` summed up for each study and solver.

    Blind cases stand apart from those on which the solver was calibrated.
    """

    study: Series[str]
    solver: Series[str]
    group: Series[str] = pa.Field(isin=["blind", "calibration"])
    cases: Series[int] = pa.Field(ge=1)
    compared: Series[int] = pa.Field(ge=0, description="Cases with both values")
    mean_percent: Series[float] = pa.Field(nullable=True, description="Signed mean")
    mean_absolute_percent: Series[float] = pa.Field(nullable=True, ge=0)
    largest_percent: Series[float] = pa.Field(
        nullable=True, description="The one of the largest magnitude, with its sign"
    )
    largest_case_id: Series[str] = pa.Field(description="Case of the largest difference")

    class Config:
        """Exactly these columns, in this order."""

        strict = True
        coerce = True
        ordered = True


class StiffnessByLevel(pa.DataFrameModel):
    """Main effects: means over the cases at one level of a factor, computed and published.

    All means of a factor are over the same combinations of the other factors: those at which
    every level has both values. Otherwise a case that failed would pose as a trend.
    """

    study: Series[str]
    solver: Series[str]
    factor: Series[str]
    level: Series[float] = pa.Field(description="In the unit of the factor")
    compared: Series[int] = pa.Field(ge=1, description="Cases that the means are over")
    computed_mean_n_per_mm: Series[float] = pa.Field(gt=0)
    published_mean_n_per_mm: Series[float] = pa.Field(gt=0)
    computed_change_percent: Series[float] = pa.Field(
        description="Of the computed mean, from the factor's lowest level"
    )
    published_change_percent: Series[float] = pa.Field(
        description="Of the published mean, from the factor's lowest level"
    )
    mean_difference_percent: Series[float] = pa.Field(description="Mean of the cases' differences")
    lowest_difference_percent: Series[float]
    highest_difference_percent: Series[float]

    class Config:
        """Exactly these columns, in this order."""

        strict = True
        coerce = True
        ordered = True


@dataclass(frozen=True)
class Comparison:
    """What the comparison must know of a study.

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
    """Set each computed stiffness beside the published one, as `StiffnessAgainstPublished`.

    Parameters
    ----------
    cases : DataFrame
        `nptcs.tables.cases.Cases` of all studies and solvers.
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
    """Sum the differences of `StiffnessAgainstPublished` up, as `StiffnessErrors`."""
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
