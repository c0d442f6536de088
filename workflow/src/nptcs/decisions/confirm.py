"""Solve the chosen design: inside or outside its prediction, and what follows from it."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd

from nptcs.campaign.cases import cases_table
from nptcs.campaign.jobs import make_jobs
from nptcs.campaign.record import CaseRecord, RecordStore
from nptcs.campaign.runner import run_cases
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.config.studies.decisions import Decision
from nptcs.config.studies.goals import ResponseName
from nptcs.config.studies.responses import TyreResponseSettings
from nptcs.decisions.decide import Outcome, decide
from nptcs.errors import InputError
from nptcs.responses.strength import PlyStrengths
from nptcs.responses.table import tyre_curves, tyre_responses
from nptcs.uncertainty.propagate import moments
from nptcs.uncertainty.response_model import normal_half_width
from nptcs.uncertainty.source import Source
from nptcs.uncertainty.study_results import StudyResults

ROUNDING = 1e-12
"""Share of a value below which a difference between two results of one formula is rounding."""


@dataclass(frozen=True)
class Compared:
    """One response of a chosen design, predicted and solved; not a number where unknown."""

    predicted: float
    low: float
    high: float
    solved: float

    @property
    def result(self) -> str:
        """Say whether the solved value is in the prediction interval."""
        if not np.isfinite(self.solved):
            return "not solved"
        return "inside" if self.low <= self.solved <= self.high else "outside"

    @property
    def difference(self) -> float:
        """Predicted minus solved; 0 where the difference is only rounding, as for a mass."""
        found = self.predicted - self.solved
        return 0.0 if abs(found) < ROUNDING * abs(self.solved) else found


@dataclass(frozen=True)
class ConfirmationRound:
    """A chosen design that was solved.

    Parameters
    ----------
    outcome : Outcome
        The decision that chose it.
    record : CaseRecord
    compared : mapping of ResponseName to Compared
    added : bool
        Whether the case went into the surfaces, and the choice was made again.
    """

    outcome: Outcome
    record: CaseRecord
    compared: Mapping[ResponseName, Compared]
    added: bool = False

    @property
    def result(self) -> str:
        """Return the worst result of its responses."""
        found = {one.result for one in self.compared.values()}
        return next(word for word in ("not solved", "outside", "inside") if word in found)


@dataclass(frozen=True)
class SolverRun:
    """How designs of a study are solved.

    Parameters
    ----------
    options : mapping
        Options of the solver.
    tyre : TyreGeometry
    store : RecordStore
        Designs that were solved before are taken from it.
    cores : int
    responses : TyreResponseSettings
    strengths : PlyStrengths
    """

    options: Mapping[str, object]
    tyre: TyreGeometry
    store: RecordStore
    cores: int
    responses: TyreResponseSettings
    strengths: PlyStrengths

    def solve(self, source: Source, designs: pd.DataFrame) -> tuple[list[CaseRecord], StudyResults]:
        """Solve designs with a ``case_id`` and the study's factors; return records and results."""
        results = source.results
        solved = results.solved
        fixed = {name: float(solved[name].iloc[0]) for name in results.study.fixed}
        ply = source.materials.ply.values() if source.materials.ply is not None else None
        table = designs.assign(**fixed)
        jobs = make_jobs(results.study, results.solver, self.options, self.tyre, table, ply)
        records = run_cases(jobs, self.store, self.cores, say)
        return records, replace(
            results,
            cases=cases_table(records),
            responses=tyre_responses(records, self.responses, self.strengths),
            curves=tyre_curves(records),
        )


def confirmed(
    decision: Decision, source: Source, run: SolverRun
) -> tuple[Outcome, list[ConfirmationRound], Source]:
    """Decide, solve the choice, and choose again with that case while it is outside the interval.

    Parameters
    ----------
    decision : Decision
        Its goals, and the largest number of rounds.
    source : Source
    run : SolverRun

    Returns
    -------
    outcome : Outcome
        The last choice.
    rounds : list of ConfirmationRound
        One per solved design; empty where no design was acceptable.
    source : Source
        The source with the cases that were added.
    """
    rounds: list[ConfirmationRound] = []
    outcome = decide(decision, source)
    while outcome.found.feasible and len(rounds) < decision.rounds:
        case_id = f"{decision.name}_{len(rounds) + 1}"
        design = pd.DataFrame([{"case_id": case_id, **outcome.design(outcome.choice)}])
        (record,), results = run.solve(source, design)
        done = ConfirmationRound(outcome, record, compare(outcome, results))
        again = done.result == "outside" and len(rounds) + 1 < decision.rounds
        rounds.append(replace(done, added=again))
        if not again:
            break
        source = replace(source, results=source.results.with_cases(results))
        outcome = decide(decision, source)
    return outcome, rounds, source


def compare(outcome: Outcome, results: StudyResults) -> dict[ResponseName, Compared]:
    """Compare the predictions of the chosen design with the solved responses.

    The interval is that of the surface alone, at the nominal materials: the solver has no
    tolerances.
    """
    point = outcome.found.designs.x[[outcome.choice]]
    half = normal_half_width(0.95)
    compared = {}
    for name, fitted in outcome.problem.fitted.items():
        value = float(moments(fitted.model, (), point).nominal[0])
        error = half * float(fitted.model.own_sd(point)[0])
        slack = error + 1e-9 * abs(value)
        try:
            solved = float(results.values(name)[0])
        except (InputError, IndexError):
            solved = np.nan
        compared[name] = Compared(value, value - slack, value + slack, solved)
    return compared


def say(record: CaseRecord, reused: bool, done: int, total: int) -> None:
    """Write one line per solved design to the screen or the log."""
    how = "known" if reused else f"{record.wall_time_s:.1f} s"
    line = f"{record.solver} {done}/{total} {record.case_id} {record.result.status.value} ({how})"
    print(line, file=sys.stderr, flush=True)
