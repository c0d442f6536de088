"""The goals of a decision, its answer, and whether a solved case confirms it."""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from typing import Any

from nptcs.config.studies.decisions import Decision
from nptcs.language import tr
from nptcs.report.blocks import Fact, Facts, PageBlock, Plot, Plots, Section, Text
from nptcs.report.data import Results
from nptcs.report.figures.decision import goal_intervals
from nptcs.report.plots import plot
from nptcs.report.table_view import sheet_view
from nptcs.report.tables.names import factor_headings, in_words
from nptcs.report.tables.sheets import Sheets, sheet_of
from nptcs.tables.analysis.decisions import (
    DecisionConfirmation,
    DecisionDesigns,
    DecisionFront,
    Decisions,
)
from nptcs.tables.result_table import ReportSection

Row = Mapping[Hashable, Any]


def decision_section(results: Results, sheets: Sheets) -> Section:
    """Build the section on the decisions."""
    table = results.table(Decisions)
    if table.empty:
        return Section(ReportSection.DECISION, tr("Decision"), ())
    blocks: list[PageBlock] = []
    for row in table.to_dict("records"):
        blocks.append(Text(_title(results, row), "heading"))
        blocks.append(Text(_answer(results, row), "ok" if row["status"] == "feasible" else "bad"))
        blocks += _confirmation(results, str(row["decision"]))
        blocks += _figures(results, row)
    shown = (Decisions, DecisionDesigns, DecisionFront, DecisionConfirmation)
    blocks += [sheet_view(sheet_of(sheets, one)) for one in shown if len(results.table(one))]
    return Section(
        ReportSection.DECISION, tr("Decision"), tuple(blocks), results.table_is_synthetic(table)
    )


def _decision(results: Results, name: str) -> Decision:
    return next(one for one in results.config.decisions if one.name == name)


def _title(results: Results, row: Row) -> str:
    return tr(_decision(results, str(row["decision"])).title) or str(row["goals"])


def _answer(results: Results, row: Row) -> str:
    names = factor_headings([results.config.study(str(row["study"]))])
    design = in_words(str(row["design"]), names)
    asked = tr(
        "Goals for study {study}, solver {solver}: {goals}",
        study=row["study"],
        solver=row["solver"],
        goals=in_words(str(row["goals"]), names),
    )
    if row["status"] == "refused":
        return tr("{asked}. No answer: {message}", asked=asked, message=row["message"])
    probability = tr(
        "with probability {with_probability:g}", with_probability=row["with_probability"]
    )
    if row["status"] == "infeasible":
        return tr(
            "{asked}, {probability}. {message}. Nearest design: {design}.",
            asked=asked,
            probability=probability,
            message=row["message"],
            design=design,
        )
    return tr(
        "{asked}, {probability}. Chosen: {design}; it meets all targets and "
        "bounds with probability {probability_2:.2f}. {feasible_percent:.2g} % "
        "of {candidates} candidates do.",
        asked=asked,
        probability=probability,
        design=design,
        probability_2=row["probability"],
        feasible_percent=row["feasible_percent"],
        candidates=row["candidates"],
    )


def _confirmation(results: Results, decision: str) -> list[PageBlock]:
    """State the results of the solved designs."""
    rows = results.table(DecisionConfirmation)
    names = factor_headings([results.config.study(_decision(results, decision).study)])
    facts = []
    for row in rows[rows["decision"] == decision].to_dict("records"):
        at = tr(" at {at}", at=row["at"]) if row["at"] else ""
        what = tr(
            "Round {round}: {response}{at} of {design}",
            round=row["round"],
            response=in_words(str(row["response"]), names),
            at=at,
            design=in_words(str(row["design"]), names),
        )
        if row["result"] == "not solved":
            text = tr("not solved: {message}", message=row["message"])
        else:
            text = tr(
                "solved {solved:.6g} {unit}, predicted {predicted:.6g} ({low:.6g} to "
                "{high:.6g}): {result}",
                solved=row["solved"],
                unit=row["unit"],
                predicted=row["predicted"],
                low=row["low"],
                high=row["high"],
                result=tr(row["result"]),
            )
        if row["added"]:
            text += tr("; the case was added to the surfaces, and the choice was made again")
        facts.append(Fact(what, text, "decision_confirmation.csv"))
    return [Facts(tr("Confirmation by a solved case"), tuple(facts))] if facts else []


def _figures(results: Results, row: Row) -> list[PageBlock]:
    decision = _decision(results, str(row["decision"]))
    designs = results.table(DecisionDesigns)
    designs = designs[designs["decision"] == decision.name]
    study = results.config.study(decision.study)
    synthetic = results.study_is_synthetic(study, decision.solver)
    plots: list[Plot] = []
    for goal, rows in designs.groupby("goal", sort=False):
        alt = tr(
            "{goal}: best designs of the decision {name} with their intervals",
            goal=goal,
            name=decision.name,
        )
        plots.append(plot(alt, synthetic, goal_intervals, rows, synthetic))
    if not plots:
        return []
    return [Plots(tr("The best designs: mean and interval of each response."), tuple(plots))]
