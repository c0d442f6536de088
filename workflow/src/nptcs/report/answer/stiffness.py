"""How stiff is the tyre? The reference design of the first study that has one."""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from typing import Any

import numpy as np
import pandas as pd

from nptcs.config.studies.study import Study
from nptcs.language import tr
from nptcs.report.blocks import Finding
from nptcs.report.data import Results
from nptcs.report.sketches import IntervalRow, intervals
from nptcs.report.tables.names import factor_headings, in_words
from nptcs.report.text import number_text, rounded, with_error
from nptcs.tables.analysis.uncertainty import ResponseUncertainty
from nptcs.tables.published.stiffness import PUBLISHED, STIFFNESS
from nptcs.tables.result_table import ReportSection
from nptcs.tables.status import has_result
from nptcs.tables.tyres.cases import Cases

Row = Mapping[Hashable, Any]
REFERENCE, RESPONSE = "reference", "secant_stiffness"
MOST_ROWS = 5
"""Solvers that the sketch shows."""


def stiffness_finding(results: Results) -> Finding:
    """Answer from the uncertainty, else from a solved case, else from all cases."""
    for study in results.config.studies:
        if rows := _uncertain(results, study):
            return _with_uncertainty(results, study, rows)
    for study in results.config.studies:
        solved = _solved_reference(results, study)
        if len(solved):
            return _without_uncertainty(results, study, solved)
    return _over_all_cases(results)


def leading_solver(study: Study, solvers: list[str]) -> str:
    """Choose the solver whose results come first: that of a decision, else a computing one."""
    asked = [decision.solver for decision in study.decisions if decision.solver in solvers]
    computing = [name for name in study.solvers if name in solvers and name != PUBLISHED]
    return [*asked, *computing, *solvers][0]


def _question() -> str:
    return tr("How stiff is the tyre?")


def _uncertain(results: Results, study: Study) -> dict[str, Row]:
    """Return the uncertain stiffness of the reference design at the study's load, by solver."""
    table = results.table(ResponseUncertainty)
    mine = table[
        table["study"].eq(study.name)
        & table["design"].eq(REFERENCE)
        & table["response"].eq(RESPONSE)
        & table["at"].eq(f"{study.load_n:g} N")
    ]
    return {str(row["solver"]): row for row in mine.to_dict("records")}


def _with_uncertainty(results: Results, study: Study, rows: Mapping[str, Row]) -> Finding:
    solver = leading_solver(study, list(rows))
    row = rows[solver]
    words = tr(
        "Reference design of the study “{study}”: {design}. ± is one standard deviation from "
        "materials, tolerances and surface; {percent} % of the distribution lies between {low} "
        "and {high} {unit}. Solver {solver}.",
        study=study.name,
        design=in_words(row["factors"], factor_headings([study])),
        percent=f"{row['confidence_percent']:g}",
        low=rounded(row["low"], row["sd"]),
        high=rounded(row["high"], row["sd"]),
        unit=row["unit"],
        solver=solver,
    )
    order = [solver, *(name for name in rows if name != solver)][:MOST_ROWS]
    shown = [
        IntervalRow(
            name,
            rows[name]["mean"],
            with_error(rows[name]["mean"], rows[name]["sd"]),
            rows[name]["low"],
            rows[name]["high"],
            "accent" if name == solver else "soft",
        )
        for name in order
    ]
    return Finding(
        _question(),
        tr(
            "{value} at {load} N",
            value=with_error(row["mean"], row["sd"], row["unit"]),
            load=f"{study.load_n:g}",
        ),
        words,
        "uncertainty.csv",
        ReportSection.UNCERTAINTY,
        intervals(shown, tr("Stiffness of the reference design with its interval, by solver")),
        synthetic=results.study_is_synthetic(study, solver),
    )


def _solved_reference(results: Results, study: Study) -> pd.DataFrame:
    """Return the solved cases at the reference design; no rows if there are none."""
    cases = _stiff_cases(results, study.name)
    if not study.reference or not set(study.reference) <= set(cases):
        return cases[:0]
    same = [np.isclose(cases[name].astype(float), value) for name, value in study.reference.items()]
    return cases[np.logical_and.reduce(same)]


def _without_uncertainty(results: Results, study: Study, solved: pd.DataFrame) -> Finding:
    by_solver = dict(zip(solved["solver"], solved[STIFFNESS], strict=True))
    solver = leading_solver(study, list(by_solver))
    value = f"{number_text(by_solver[solver], 4)} N/mm"
    design = ", ".join(f"{name} {value:g}" for name, value in study.reference.items())
    rows = [
        IntervalRow(
            name, number, number_text(number, 4), tone="accent" if name == solver else "soft"
        )
        for name, number in list(by_solver.items())[:MOST_ROWS]
    ]
    return Finding(
        _question(),
        tr("{value} at {load} N", value=value, load=f"{study.load_n:g}"),
        tr(
            "The reference design of the study “{study}” ({design}) was solved with {solver}. "
            "The uncertainty of its stiffness was not assessed.",
            study=study.name,
            design=in_words(design, factor_headings([study])),
            solver=solver,
        ),
        "cases.csv",
        ReportSection.CASES,
        intervals(rows, tr("Stiffness of the reference design, by solver")),
        synthetic=results.study_is_synthetic(study, solver),
    )


def _over_all_cases(results: Results) -> Finding:
    for study in results.config.studies:
        cases = _stiff_cases(results, study.name)
        if cases.empty:
            continue
        solver = leading_solver(study, list(cases["solver"].unique()))
        mine = cases.loc[cases["solver"] == solver, STIFFNESS]
        low, high = (number_text(end, 4) for end in (mine.min(), mine.max()))
        why = (
            tr("The reference design gave no stiffness")
            if study.reference
            else tr("The configuration names no reference design")
        )
        row = IntervalRow(solver, mine.median(), f"{low}–{high}", mine.min(), mine.max())
        return Finding(
            _question(),
            tr("{low} to {high} N/mm at {load} N", low=low, high=high, load=f"{study.load_n:g}"),
            tr(
                "Over {count} solved cases of the study “{study}”, solver {solver}. {why}, so no "
                "single stiffness is given and its uncertainty was not assessed.",
                count=len(mine),
                study=study.name,
                solver=solver,
                why=why,
            ),
            "cases.csv",
            ReportSection.CASES,
            intervals([row], tr("Lowest, middle and highest stiffness of the solved cases")),
            synthetic=results.study_is_synthetic(study, solver),
        )
    return Finding(
        _question(),
        tr("Not assessed"),
        tr("No case of this run has a vertical stiffness."),
        "cases.csv",
        ReportSection.CASES,
        assessed=False,
    )


def _stiff_cases(results: Results, study: str) -> pd.DataFrame:
    """Return the cases of a study that have a vertical stiffness."""
    cases = results.table(Cases)
    mine = cases[cases["study"].eq(study) & has_result(cases["status"])]
    return mine.dropna(subset=[STIFFNESS])
