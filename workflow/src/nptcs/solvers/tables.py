"""Tables of cases, for solvers that have no faster way than one case after the other."""

from __future__ import annotations

from collections.abc import Callable
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
from nptcs.tables.cases import realised_column

TableFunction = Callable[[TableInputs], pd.DataFrame]


def one_by_one(solve: Callable[[CaseInputs], SolverResult]) -> TableFunction:
    """Make a table function of a solver's function for one case.

    It saves a process and a file per case, and whatever the solver keeps between cases. A case
    with bad input is a row with its message; any other exception is left to the campaign.
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
        **{realised_column(name): value for name, value in result.realised.items()},
    }
