"""Which design is recommended, and does a solved case confirm it? One finding per decision."""

from __future__ import annotations

import math
from collections.abc import Hashable, Mapping
from typing import Any, assert_never

import pandas as pd

from nptcs.config.studies.decisions import Decision
from nptcs.language import tr
from nptcs.report.blocks import Finding
from nptcs.report.data import Results
from nptcs.report.sketches import IntervalRow, Sketch, intervals
from nptcs.report.tables.names import factor_headings, in_words
from nptcs.report.text import with_error
from nptcs.report.words.messages import message_text
from nptcs.tables.analysis.decisions import (
    Confirmation,
    DecisionConfirmation,
    DecisionDesigns,
    Decisions,
    DecisionStatus,
)
from nptcs.tables.result_table import ReportSection

Row = Mapping[Hashable, Any]


def recommended_findings(results: Results) -> list[Finding]:
    """Write one finding for each decision, or one that says that there is none."""
    rows = results.table(Decisions).to_dict("records")
    if not rows:
        return [
            Finding(
                _question(),
                tr("Not requested"),
                tr("The configuration has no decision, so no design is recommended."),
                "decisions.csv",
                ReportSection.DECISION,
                assessed=False,
            )
        ]
    return [_finding(results, row) for row in rows]


def _question() -> str:
    return tr("Which design is recommended?")


def _finding(results: Results, row: Row) -> Finding:
    study = results.config.study(str(row["study"]))
    labels = factor_headings([study])
    asked = tr(_decision(results, row).title) or in_words(str(row["goals"]), labels)
    design = in_words(str(row["design"]), labels)
    outcome: DecisionStatus = row["status"]
    match outcome:
        case "feasible":
            answer, sentence = design, _chosen(results, row, asked)
        case "infeasible":
            answer = tr("No design meets the goals")
            sentence = tr(
                "Goals: {asked}. {message}. Nearest design: {design}.",
                asked=asked,
                message=message_text(row["message"]),
                design=design,
            )
        case "refused":
            answer = tr("Not assessed")
            sentence = tr(
                "Goals: {asked}. {message}.", asked=asked, message=message_text(row["message"])
            )
        case _:
            assert_never(outcome)
    return Finding(
        _question(),
        answer,
        sentence,
        "decisions.csv, decision_confirmation.csv",
        ReportSection.DECISION,
        _sketch(results, str(row["decision"])),
        row["status"] == "feasible",
        results.study_is_synthetic(study, str(row["solver"])),
    )


def _decision(results: Results, row: Row) -> Decision:
    return next(one for one in results.config.decisions if one.name == row["decision"])


def _chosen(results: Results, row: Row, asked: str) -> str:
    """State the goals, how probably the design meets them, and the result of the solved case."""
    probability = tr(
        "Goals: {asked}. With the scatter of materials and tolerances, the design meets every "
        "target with a probability of {percent} %.",
        asked=asked,
        percent=f"{100 * row['probability']:.0f}",
    )
    return f"{probability} {_confirmed(results, row)}"


def _confirmed(results: Results, row: Row) -> str:
    solver = row["solver"]
    confirmation: Confirmation = row["confirmation"]
    match confirmation:
        case "inside":
            said = tr(
                "Solving it with {solver} confirms the prediction: the result lies inside the "
                "surface's prediction interval.",
                solver=solver,
            )
        case "outside":
            said = tr(
                "Solving it with {solver} does NOT confirm the prediction: the result lies outside "
                "the surface's prediction interval.",
                solver=solver,
            )
        case "not solved":
            said = tr("It could not be solved with {solver}: not confirmed.", solver=solver)
        case "not asked" | "":
            return tr("No confirmation by a solved case was requested: not confirmed.")
        case _:
            assert_never(confirmation)
    missed = _last_round(results, str(row["decision"]))
    if missed["goal_met"].eq("no").any():
        return f"{said} {tr('The solved case misses a goal.')}"
    return said


def _last_round(results: Results, decision: str) -> pd.DataFrame:
    rows = results.table(DecisionConfirmation)
    mine = rows[rows["decision"] == decision]
    return mine[mine["round"] == mine["round"].max()]


def _sketch(results: Results, decision: str) -> Sketch | None:
    """Draw the first target: the accepted values, the predicted ones, the solved one."""
    designs = results.table(DecisionDesigns)
    chosen = designs[designs["decision"].eq(decision) & designs["chosen"]]
    accepted = chosen[["smallest_accepted", "largest_accepted"]].notna().any(axis=1)
    if not accepted.any():
        return None
    goal: Row = chosen[accepted].iloc[0].to_dict()
    unit = "" if goal["unit"] == "1" else str(goal["unit"])
    rows = [
        IntervalRow(
            tr("predicted"),
            goal["mean"],
            with_error(goal["mean"], goal["sd"]),
            goal["low"],
            goal["high"],
        )
    ]
    solved = _last_round(results, decision)
    solved = solved[solved["response"].eq(goal["response"]) & solved["at"].eq(goal["at"])]
    for value in solved["solved"].dropna():
        rows.append(IntervalRow(tr("solved"), value, f"{value:.5g} {unit}".strip(), tone="good"))
    alt = tr(
        "{goal}: accepted values shaded, predicted value with interval, solved value",
        goal=goal["goal"],
    )
    return intervals(rows, alt, _band(goal))


def _band(goal: Row) -> tuple[float, float]:
    """Return the accepted values; an open end goes as far as the interval."""
    low, high = goal["smallest_accepted"], goal["largest_accepted"]
    return (
        min(goal["low"], high) if math.isnan(low) else low,
        max(goal["high"], low) if math.isnan(high) else high,
    )
