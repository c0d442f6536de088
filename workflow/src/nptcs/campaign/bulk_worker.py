"""A part of a table of cases, solved in its own process."""

from __future__ import annotations

import math
import time
from collections.abc import Mapping
from dataclasses import replace
from multiprocessing.connection import Connection
from typing import Any

import numpy as np
import pandas as pd

from nptcs.campaign.worker import begin_in, message_of, of_the_machine
from nptcs.solvers.contract import TYRE_RESPONSES, Solver, Status, TableInputs
from nptcs.solvers.registry import load_solver, read_options
from nptcs.tables.status import has_result
from nptcs.tables.tyres.cases import realised_column

DIED = "died"
"""Column: 1 where a case ended for a reason outside it, killed or out of memory."""


def run(
    module: str, options: Mapping[str, Any], inputs: TableInputs, channel: Connection, folder: str
) -> None:
    """Solve a part and send ``(results, wall time in s)`` back through the pipe.

    The options come as plain values: their class may be defined in a solver's own file, which a
    new process does not know before it loads it.
    """
    begin_in(folder)
    start = time.perf_counter()
    solver = load_solver(module)
    results = solve_part(solver, replace(inputs, options=read_options(solver, options)))
    channel.send((results, time.perf_counter() - start))
    channel.close()


def solve_part(solver: Solver, inputs: TableInputs) -> pd.DataFrame:
    """Solve cases; where the solver raises, its table is halved until the cases at fault are found.

    Parameters
    ----------
    solver : Solver
        With a table function.
    inputs : TableInputs

    Returns
    -------
    DataFrame
        One row per case: ``status``, ``message``, `TYRE_RESPONSES` and whatever else the solver
        reports; a case that raises has the status ``error`` and no numbers. `DIED` is 1 for a case
        that failed for want of memory, disk space or open files.
    """
    number = len(inputs.cases)
    assert solver.solve_table is not None
    try:
        return _checked(solver, inputs, solver.solve_table(inputs))
    except MemoryError as error:
        if number == 1:
            return failed_row(Status.ERROR, f"out of memory: {error}", died=True)
    except Exception as error:  # noqa: BLE001 - any fault of a solver is a row, not a crash
        if number == 1:
            return failed_row(Status.ERROR, message_of(error), died=of_the_machine(error))
    half = number // 2
    parts = [inputs.rows(0, half), inputs.rows(half, number)]
    return pd.concat([solve_part(solver, part) for part in parts], ignore_index=True)


def failed_row(status: Status, message: str, died: bool = False) -> pd.DataFrame:
    """Return the row of one case that has no result."""
    numbers = {**dict.fromkeys(TYRE_RESPONSES, math.nan), DIED: float(died)}
    return pd.DataFrame([{"status": status.value, "message": message, **numbers}])


def _checked(solver: Solver, inputs: TableInputs, results: pd.DataFrame) -> pd.DataFrame:
    """Check a table against the contract: a case with status ok has finite responses."""
    if len(results) != len(inputs.cases):
        raise ValueError(
            f"solver '{solver.name}' gives {len(results)} rows for {len(inputs.cases)} cases"
        )
    table = results.reset_index(drop=True).copy()
    names = [str(name) for name in table if name not in ("status", "message")]
    numbers = list(dict.fromkeys([*TYRE_RESPONSES, *names]))
    table = table.reindex(columns=["status", "message", *numbers])
    table["status"] = [Status(status).value for status in table["status"]]
    table["message"] = table["message"].fillna("").astype(str)
    table[numbers] = table[numbers].astype(float)
    table[DIED] = 0.0
    ok = has_result(table["status"]).to_numpy()
    lacking = ok & ~np.isfinite(table[list(TYRE_RESPONSES)].to_numpy()).all(axis=1)
    table.loc[lacking, "message"] = f"solver '{solver.name}' says ok but gives no result"
    table.loc[lacking, "status"] = Status.ERROR.value
    table.loc[~has_result(table["status"]), numbers] = math.nan
    if solver.realise is not None:
        _add_realised(solver, inputs, table)
    return table


def _add_realised(solver: Solver, inputs: TableInputs, table: pd.DataFrame) -> None:
    """Add the values that the solver really used for the solved cases."""
    assert solver.realise is not None
    values = inputs.cases.drop(columns="case_id").astype(float).to_dict("records")
    for row in np.flatnonzero(has_result(table["status"])):
        given = {str(name): value for name, value in values[row].items()}
        for factor, value in solver.realise(given, inputs.tyre).items():
            column = realised_column(factor)
            if column not in table:
                table[column] = math.nan
            table.loc[row, column] = value
