"""Decisions as tables: outcome, designs, front and confirmation."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

from nptcs.arrays import Array
from nptcs.config.studies.decisions import Decision
from nptcs.decisions.confirm import ConfirmationRound
from nptcs.decisions.decide import Outcome
from nptcs.decisions.evaluate import meets
from nptcs.doe.whole_plates import SPACING
from nptcs.tables.analysis.decisions import (
    DecisionConfirmation,
    DecisionDesigns,
    DecisionFront,
    Decisions,
)
from nptcs.uncertainty.tables import design_text


@dataclass(frozen=True)
class DecisionAnswer:
    """What became of one decision.

    Parameters
    ----------
    decision : Decision
    outcome : Outcome or None
        None where the question cannot be answered.
    rounds : tuple of ConfirmationRound
    cpu_s : float
        Processor time of fit and search; not a number without an outcome.
    refusal : str
        Why there is no outcome.
    """

    decision: Decision
    outcome: Outcome | None
    rounds: tuple[ConfirmationRound, ...] = ()
    cpu_s: float = float("nan")
    refusal: str = ""


@dataclass(frozen=True)
class DecisionTables:
    """`Decisions`, `DecisionDesigns`, `DecisionFront` and `DecisionConfirmation`."""

    decisions: pd.DataFrame
    designs: pd.DataFrame
    front: pd.DataFrame
    confirmation: pd.DataFrame


def decision_tables(answers: Sequence[DecisionAnswer]) -> DecisionTables:
    """Write the answers as tables."""
    outcomes = [answer.outcome for answer in answers if answer.outcome is not None]
    return DecisionTables(
        pd.DataFrame([_answer(a) for a in answers], columns=_columns(Decisions)),
        pd.DataFrame([r for o in outcomes for r in _designs(o)], columns=_columns(DecisionDesigns)),
        pd.DataFrame([r for o in outcomes for r in _front(o)], columns=_columns(DecisionFront)),
        pd.DataFrame(
            [row for answer in answers for row in _confirmation(answer)],
            columns=_columns(DecisionConfirmation),
        ),
    )


def plates_of(outcome: Outcome, point: Array) -> int | None:
    """Return the number of plates of a design; None where the solver does not use whole ones."""
    if not outcome.space.plates:
        return None
    spacing = point[outcome.space.factors.index(SPACING)]
    return round(outcome.space.tread_width_mm / spacing)


def words_of(outcome: Outcome, point: Array) -> str:
    """Write a design of an outcome for a reader."""
    return design_text(point, outcome.space.factors, plates_of(outcome, point))


def goals_text(decision: Decision) -> str:
    """Write the goals of a decision in one line."""
    return "; ".join(str(goal) for goal in decision.goals())


def _columns(contract: type) -> list[str]:
    return list(contract.to_schema().columns)  # type: ignore[attr-defined]


def _answer(answer: DecisionAnswer) -> dict[str, object]:
    decision, outcome = answer.decision, answer.outcome
    row: dict[str, object] = {
        "decision": decision.name,
        "study": decision.study,
        "solver": decision.solver,
        "goals": goals_text(decision),
        "with_probability": decision.with_probability,
        "status": "refused",
        "design": "",
        "plates": pd.NA,
        "probability": np.nan,
        "desirability": np.nan,
        "feasible_percent": np.nan,
        "candidates": pd.NA,
        "confirmation": "",
        "solved_designs": len(answer.rounds),
        "search_cpu_s": answer.cpu_s,
        "message": answer.refusal,
    }
    if outcome is None:
        return row
    place = outcome.choice
    point = outcome.found.designs.x[place]
    asked = answer.rounds[-1].result if answer.rounds else "not asked"
    return row | {
        "status": "feasible" if outcome.found.feasible else "infeasible",
        "design": words_of(outcome, point),
        "plates": plates_of(outcome, point) or pd.NA,
        "probability": outcome.sampled[place],
        "desirability": outcome.found.desirability[place],
        "feasible_percent": outcome.found.feasible_percent,
        "candidates": len(outcome.found.candidates.x),
        "confirmation": asked if outcome.found.feasible else "",
        "message": outcome.why,
    }


def _designs(outcome: Outcome) -> Iterator[dict[str, object]]:
    found, half = outcome.found, outcome.confidence / 2
    for place, point in enumerate(found.designs.x):
        for goal in outcome.problem.goals:
            values = outcome.samples[place][goal.response]
            low, high = np.quantile(values, [0.5 - half, 0.5 + half])
            accepted = [limit if np.isfinite(limit) else np.nan for limit in goal.limits]
            yield {
                "decision": outcome.decision.name,
                "rank": place + 1,
                "chosen": place == outcome.choice,
                "design": words_of(outcome, point),
                "plates": plates_of(outcome, point) or pd.NA,
                "probability": outcome.sampled[place],
                "desirability": found.desirability[place],
                "goal": str(goal),
                "response": goal.response.name,
                "at": goal.response.at,
                "unit": outcome.problem.fitted[goal.response].unit,
                "mean": values.mean(),
                "sd": values.std(ddof=1),
                "low": low,
                "high": high,
                "smallest_accepted": accepted[0],
                "largest_accepted": accepted[1],
                "goal_probability": meets(goal, values).mean() if goal.must_hold else np.nan,
            }


def _front(outcome: Outcome) -> Iterator[dict[str, object]]:
    front, objectives = outcome.found.front, outcome.problem.objectives
    if len(objectives) < 2:
        return
    order = np.argsort(front.mean[objectives[0].response], kind="stable")
    for number, place in enumerate(order, start=1):
        for goal in objectives:
            yield {
                "decision": outcome.decision.name,
                "point": number,
                "design": words_of(outcome, front.x[place]),
                "probability": front.probability[place],
                "goal": str(goal),
                "mean": front.mean[goal.response][place],
                "unit": outcome.problem.fitted[goal.response].unit,
            }


def _confirmation(answer: DecisionAnswer) -> Iterator[dict[str, object]]:
    for number, one in enumerate(answer.rounds, start=1):
        outcome = one.outcome
        for name, compared in one.compared.items():
            goals = [g for g in outcome.problem.must_hold if g.response == name]
            met = all(bool(meets(goal, np.array(compared.solved))) for goal in goals)
            solved = compared.result != "not solved"
            yield {
                "decision": answer.decision.name,
                "study": answer.decision.study,
                "solver": answer.decision.solver,
                "round": number,
                "design": words_of(outcome, outcome.found.designs.x[outcome.choice]),
                "response": name.name,
                "at": name.at,
                "unit": outcome.problem.fitted[name].unit,
                "predicted": compared.predicted,
                "low": compared.low,
                "high": compared.high,
                "solved": compared.solved,
                "difference": compared.difference,
                "result": compared.result,
                "goal_met": ("yes" if met else "no") if goals and solved else "",
                "added": one.added,
                "wall_time_s": one.record.wall_time_s,
                "message": one.record.result.message,
            }
