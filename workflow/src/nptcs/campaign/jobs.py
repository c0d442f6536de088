"""From a design table to the jobs of a solver."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import pandas as pd

from nptcs.campaign.record import CaseJob, read_solver_tables
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.config.studies.study import Study
from nptcs.provenance import code_hash
from nptcs.solvers.registry import load_solver, module_of, read_options


def make_jobs(
    study: Study,
    solver_name: str,
    options: Mapping[str, Any],
    tyre: TyreGeometry,
    design: pd.DataFrame,
    ply: Mapping[str, float] | None,
) -> list[CaseJob]:
    """Join the cases of a study with everything that a solver may look at.

    Parameters
    ----------
    study : Study
        Its name and load.
    solver_name : str
        Solver of the cases.
    options : mapping
        Options of that solver.
    tyre : TyreGeometry
        Dimensions of the tyre.
    design : DataFrame
        ``case_id``, ``case`` and the values of each case (`nptcs.design.full_factorial`).
    ply : mapping of str to float or None
        Ply constants, for a solver that needs them.

    Returns
    -------
    list of CaseJob
        One per row of `design`.
    """
    module = module_of(solver_name, options)
    solver = load_solver(module)
    checked = read_options(solver, options)
    tables = read_solver_tables(checked.tables())
    code = code_hash(module)
    return [
        CaseJob(
            study=study.name,
            case_id=str(row.pop("case_id")),
            solver=solver.name,
            solver_version=solver.version,
            module=module,
            code=code,
            values={str(k): float(v) for k, v in row.items() if k != "case"},
            load_n=study.load_n if solver.loads_tyre else None,
            tyre=tyre.model_dump(),
            ply=dict(ply) if solver.needs_ply and ply is not None else None,
            options=checked.model_dump(mode="json"),
            without_effect=tuple(sorted(checked.without_effect)),
            tables=tables,
        )
        for row in design.to_dict("records")
    ]
