"""Tables of cases, for solvers that have no faster way than one case after another."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from typing import Any

import pandas as pd

from nptcs.errors import InputError
from nptcs.solvers.contract import (
    TYRE_RESPONSES,
    CaseInputs,
    SolverResult,
    Status,
    TableInputs,
)
from nptcs.tables.tyres.cases import realised_column

TableFunction = Callable[[TableInputs], pd.DataFrame]
CURVE = "curve_"
"""Prefix of the columns with the points of a load–displacement curve."""
POINT = re.compile(rf"{CURVE}(?P<name>\w+)_(?P<number>\d+)")


def one_by_one(solve: Callable[[CaseInputs], SolverResult]) -> TableFunction:
    """Make a table function of a solver's function for one case.

    It saves a process and a file per case, and the solver can keep its caches between cases. A
    case with bad input is a row with its message; any other exception is left to the campaign.
    """

    def solve_table(inputs: TableInputs) -> pd.DataFrame:
        return pd.DataFrame([_row(solve, inputs, row) for row in range(len(inputs.cases))])

    return solve_table


def _row(
    solve: Callable[[CaseInputs], SolverResult], inputs: TableInputs, row: int
) -> dict[str, Any]:
    try:
        result = solve(inputs.case(row))
    except InputError as error:
        return {"status": Status.ERROR.value, "message": str(error)}
    return {
        "status": result.status.value,
        "message": result.message,
        **{name: getattr(result, name) for name in TYRE_RESPONSES},
        **result.extra,
        **_curve_columns(result.curve),
        **{realised_column(name): value for name, value in result.realised.items()},
    }


def _curve_columns(curve: Mapping[str, list[float]] | None) -> dict[str, float]:
    return {
        f"{CURVE}{name}_{number}": value
        for name, values in (curve or {}).items()
        for number, value in enumerate(values)
    }


def curve_of(row: Mapping[str, Any]) -> dict[str, list[float]] | None:
    """Take the load–displacement curve out of a row of results.

    Parameters
    ----------
    row : mapping
        Name of the column → value; ``curve_force_n_3`` is the fourth point of ``force_n``. Other
        columns are ignored, and so is a point without a number.

    Returns
    -------
    dict of str to list of float, or None
        As `SolverResult.curve`; None for a row without one.

    Examples
    --------
    >>> curve_of({"curve_force_n_0": 0.0, "curve_force_n_1": 250.0, "status": "ok"})
    {'force_n': [0.0, 250.0]}
    """
    points: dict[str, dict[int, float]] = {}
    for column, value in row.items():
        found = POINT.fullmatch(column)
        if found and not math.isnan(value):
            points.setdefault(found["name"], {})[int(found["number"])] = float(value)
    return {name: [of[n] for n in sorted(of)] for name, of in points.items()} or None
