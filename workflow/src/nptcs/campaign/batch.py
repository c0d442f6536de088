"""One batch of cases of a study, solved by one solver."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pandas as pd

from nptcs.campaign.jobs import make_jobs
from nptcs.campaign.progress import ProgressWriter
from nptcs.campaign.record import CaseRecord, RecordStore
from nptcs.campaign.runner import run_cases
from nptcs.campaign.schedule import cases_side_by_side
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.config.studies.study import Study
from nptcs.solvers.registry import load_solver, module_of, read_options


def solve_batch(
    job: Mapping[str, Any],
    design: pd.DataFrame,
    ply: Mapping[str, float] | None,
    store: RecordStore,
    cores: int,
    tokens: int,
    log: str | Path,
) -> list[CaseRecord]:
    """Solve every n-th case of a design, starting at the batch's own number.

    Parameters
    ----------
    job : mapping
        Plain values: ``study`` (`Study.case_definition`), ``solver``, ``options``, ``tyre``,
        ``batch`` (from 1) and ``batches``.
    design : DataFrame
        `nptcs.tables.tyres.cases.DesignTable` of the study.
    ply : mapping of str to float or None
        Ply constants, for a solver that needs them.
    store : RecordStore
        Cases that were solved before are taken from it, those solved now are kept in it.
    cores, tokens : int
        Cores and licence tokens that the batch was given; they decide how many cases run at a time.
    log : str or Path
        Gets a line for each case; next to it a file says how far the batch is.

    Returns
    -------
    list of CaseRecord
        One per case, failed ones included.
    """
    study, tyre = Study.model_validate(job["study"]), TyreGeometry.model_validate(job["tyre"])
    cases = design.iloc[job["batch"] - 1 :: job["batches"]]
    jobs = make_jobs(study, job["solver"], job["options"], tyre, cases, ply)
    options = read_options(load_solver(module_of(job["solver"], job["options"])), job["options"])
    at_a_time = cases_side_by_side(cores, tokens, options)
    progress = ProgressWriter(log, study.name, job["solver"], at_a_time)
    return run_cases(jobs, store, at_a_time, progress.case)
