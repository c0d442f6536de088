"""One solved tyre, solved again for the outlines of its spokes: figure 10 a of the paper."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pandas as pd

from nptcs.campaign.record import CaseRecord
from nptcs.config.root import Config
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.fe.outline_cache import DrawnCase, shared_outlines
from nptcs.fe.spoke.equilibrium import SpokeError
from nptcs.fe.tyre.equilibrium import TyreError
from nptcs.solvers.contract import SolverOptions
from nptcs.solvers.fe_tyre import FeTyreOptions
from nptcs.solvers.registry import load_solver, module_of, read_options
from nptcs.tables.tyres.deformed_tyre import DeformedTyre


def outlines_of_study(
    config: Config,
    study: str,
    solver: str,
    records: Sequence[CaseRecord],
    design: pd.DataFrame,
    ply: Mapping[str, float],
    store: Path,
) -> pd.DataFrame:
    """Draw the first solved case among those whose neutral line a study requests.

    Parameters
    ----------
    config : Config
    study, solver : str
        Names.
    records : sequence of CaseRecord
        Of this study and solver.
    design : DataFrame
        The study's `nptcs.tables.tyres.cases.DesignTable`.
    ply : mapping
        The nine ply constants.
    store : Path
        Folder of outlines that were drawn before.

    Returns
    -------
    DataFrame
        As `deformed_tyre`.
    """
    options = config.options_of(study, solver)
    case_ids = design.set_index("case")["case_id"]
    asked = config.study(study).neutral_line_cases
    return deformed_tyre(
        records,
        [case_ids[number] for number in asked if number in case_ids],
        read_options(load_solver(module_of(solver, options)), options),
        config.tyre,
        ply,
        store,
    )


def deformed_tyre(
    records: Sequence[CaseRecord],
    case_ids: Sequence[str],
    options: SolverOptions,
    tyre: TyreGeometry,
    ply: Mapping[str, float],
    store: Path,
) -> pd.DataFrame:
    """Draw the outlines of the first of some cases that was solved, as `DeformedTyre`.

    Records do not contain motions of the spokes: the case is solved again, from the same inputs,
    unless its outlines are stored.

    Parameters
    ----------
    records : sequence of CaseRecord
        Of one study and FE solver.
    case_ids : sequence of str
        Cases that may be drawn, the preferred one first.
    options : SolverOptions
        The solver's options; a solver that has no `FeTyreOptions` gives no outlines.
    tyre : TyreGeometry
    ply : mapping
        The nine ply constants.
    store : Path
        Folder of outlines that were drawn before.

    Returns
    -------
    DataFrame
        No rows if none of the cases was solved, or if solving it again fails.
    """
    columns = list(DeformedTyre.to_schema().columns)
    solved = {r.case_id: r for r in records if r.result.displacement_mm is not None and r.load_n}
    named = [solved[case_id] for case_id in case_ids if case_id in solved]
    if not named or not isinstance(options, FeTyreOptions):
        return pd.DataFrame(columns=columns)
    record = named[0]
    load_n = float(record.load_n or 0.0)
    case = DrawnCase(record.key, record.values, load_n, options, tyre, ply)
    try:
        rows = shared_outlines(case, store, options.spoke_cache)
    except (SpokeError, TyreError):
        return pd.DataFrame(columns=columns)
    about: dict[str, Any] = {
        "study": record.study,
        "case_id": record.case_id,
        "solver": record.solver,
        "load_n": load_n,
    }
    return rows.assign(**about)[columns].reset_index(drop=True)
