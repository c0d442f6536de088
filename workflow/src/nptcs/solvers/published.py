"""The published finite element results, as a solver that looks up a case.

Tables 5 and 7 of Sun et al., Machines 2024, 12, 358: Abaqus results of the authors, at 5000 N.
They let the whole analysis run on real finite element data without a licence.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
import pandas as pd
from pydantic import Field

from nptcs.solvers.contract import (
    CASE_S,
    CaseInputs,
    Solver,
    SolverOptions,
    SolverResult,
    Status,
    TableInputs,
)

RESPONSE = "stiffness_n_per_mm"
FACTORS = frozenset(
    {"spacing_mm", "thickness_mm", "angle_deg", "shear_band_c10_mpa", "spoke_c10_mpa"}
)


class PublishedOptions(SolverOptions):
    """Options of the solver ``published``."""

    case_s: float = Field(0.05, gt=0, description=CASE_S)
    archive: str = Field(description="CSV: case, the factors, stiffness_n_per_mm")
    archive_load_n: float = Field(5000.0, gt=0, description="Load at which the archive was made")

    def tables(self) -> Mapping[str, str]:
        """Name the archive as the one table that is read."""
        return {"archive": self.archive}

    def load_fault(self, load_n: float) -> str:
        """Name the only load of the archive if another one is requested."""
        if math.isclose(load_n, self.archive_load_n):
            return ""
        return f"the archive holds results at {self.archive_load_n:g} N, not at {load_n:g} N"


def solve(inputs: CaseInputs) -> SolverResult:
    """Look up the case in the archive; a case that is not there is an error, never a guess."""
    options: PublishedOptions = inputs.options
    if fault := options.load_fault(inputs.load_n):
        return SolverResult(status=Status.ERROR, message=fault)
    rows = inputs.tables["archive"]
    factors = [column for column in rows[0] if column not in ("case", RESPONSE)]
    wanted = {name: inputs.values[name] for name in factors if name in inputs.values}
    place = ", ".join(f"{name} = {inputs.values.get(name, math.nan):g}" for name in factors)
    found = [
        row
        for row in rows
        if len(wanted) == len(factors)
        and all(math.isclose(row[name], value) for name, value in wanted.items())
    ]
    if len(found) != 1:
        how_many = f"{len(found)} rows" if found else "no case"
        return SolverResult(
            status=Status.ERROR, message=f"{options.archive} holds {how_many} with {place}"
        )
    stiffness = float(found[0][RESPONSE])
    return SolverResult(
        status=Status.OK,
        message=f"row {found[0]['case']:g} of {options.archive}",
        vertical_stiffness_n_per_mm=stiffness,
        displacement_mm=inputs.load_n / stiffness,
    )


def solve_table(inputs: TableInputs) -> pd.DataFrame:
    """Look many cases up at once; messages and numbers as `solve` gives them."""
    options: PublishedOptions = inputs.options
    rows = inputs.tables["archive"]
    factors = [column for column in rows[0] if column not in ("case", RESPONSE)]
    given = inputs.cases.reindex(columns=factors).to_numpy(float)
    archive = np.array([[float(row[name]) for name in factors] for row in rows])
    nearest = np.maximum(np.abs(given)[:, None], np.abs(archive)[None])
    # as math.isclose: relative to the larger of the two
    same = (np.abs(given[:, None] - archive[None]) <= 1e-9 * nearest).all(axis=2)
    found = same.sum(axis=1) == 1
    if options.load_fault(inputs.load_n):
        found[:] = False
    place = same.argmax(axis=1)
    stiffness = np.array([float(row[RESPONSE]) for row in rows])[place]
    table = pd.DataFrame(
        {
            "status": np.where(found, Status.OK.value, Status.ERROR.value),
            "message": [f"row {rows[index]['case']:g} of {options.archive}" for index in place],
            "vertical_stiffness_n_per_mm": np.where(found, stiffness, np.nan),
            "displacement_mm": np.where(found, inputs.load_n / stiffness, np.nan),
        }
    )
    for row in np.flatnonzero(~found):
        table.loc[row, "message"] = solve(inputs.case(int(row))).message
    return table


SOLVER = Solver(
    name="published",
    version="1",
    solve=solve,
    factors=FACTORS,
    about="the published finite element results, looked up case by case",
    options=PublishedOptions,
    solve_table=solve_table,
    table_case_s=1e-4,
)
