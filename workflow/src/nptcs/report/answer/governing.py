"""What governs the stiffness? Impact of each factor, and its share of the variance."""

from __future__ import annotations

import pandas as pd

from nptcs.config.studies.study import Study
from nptcs.language import tr
from nptcs.report.answer.stiffness import leading_solver
from nptcs.report.blocks import Finding
from nptcs.report.data import Results
from nptcs.report.factor_labels import factor_labels
from nptcs.report.sketches import BarRow, bars
from nptcs.report.text import joined, number_text
from nptcs.tables.analysis.impact import Impact
from nptcs.tables.analysis.response_surfaces import ResponseImpact
from nptcs.tables.published.stiffness import STIFFNESS
from nptcs.tables.result_table import ReportSection

MOST_BARS = 6
NAMED = 3
"""Factors that the sentence names."""


def governing_finding(results: Results) -> Finding:
    """Rank the factors of all studies that one solver has solved, by their impact."""
    solver, table = _leading_impacts(results)
    if table.empty:
        return Finding(
            tr("What governs it?"),
            tr("Not assessed"),
            tr("No surface was fitted to the stiffness, so no factor has an impact value."),
            "impact.csv",
            ReportSection.SENSITIVITY,
            assessed=False,
        )
    names = [_label(results, row) for row in table.to_dict("records")]
    sizes = table["size"].to_list()
    ranges = [_range(results, row) for row in table.to_dict("records")]
    named = joined(
        f"{name} {number_text(size, 3)} N/mm ({range_})"
        for name, size, range_ in list(zip(names, sizes, ranges, strict=True))[:NAMED]
    )
    words = [
        tr(
            "Largest changes of the stiffness, each factor over its range in the study: {named}. "
            "Solver {solver}.",
            named=named,
            solver=solver,
        ),
        *_shares(results, solver),
    ]
    rows = [
        BarRow(name, size, f"{number_text(size, 3)} N/mm", tone="accent" if not place else "soft")
        for place, (name, size) in enumerate(zip(names, sizes, strict=True))
    ]
    return Finding(
        tr("What governs it?"),
        names[0][:1].upper() + names[0][1:],
        " ".join(words),
        "impact.csv, response_impact.csv",
        ReportSection.SENSITIVITY,
        bars(rows[:MOST_BARS], tr("Impact of each factor on the stiffness")),
        synthetic=any(
            results.study_is_synthetic(results.config.study(str(study)), solver)
            for study in table["study"].unique()
        ),
    )


def _leading_impacts(results: Results) -> tuple[str, pd.DataFrame]:
    """Return the impacts of the leading solver by the first rule, the largest first.

    A factor that several studies vary is taken from the first of them.
    """
    table = results.table(Impact)
    table = table[table["rule"] == results.config.sensitivity.rules[0]]
    if table.empty:
        return "", table
    study = next(one for one in results.config.studies if table["study"].eq(one.name).any())
    mine = table[table["study"] == study.name]
    solver = leading_solver(study, list(mine["solver"].unique()))
    places = {one.name: place for place, one in enumerate(results.config.studies)}
    of_solver = table[table["solver"] == solver].assign(size=table["impact"].abs())
    of_solver = of_solver.sort_values("study", key=lambda names: names.map(places), kind="stable")
    first = of_solver.drop_duplicates("factor")
    return solver, first.sort_values("size", ascending=False, kind="stable")


def _label(results: Results, row: dict[object, object]) -> str:
    return factor_labels(results.config.study(str(row["study"])))[str(row["factor"])].label


def _range(results: Results, row: dict[object, object]) -> str:
    """Write the range of a factor's levels with its unit."""
    study = results.config.study(str(row["study"]))
    unit = factor_labels(study)[str(row["factor"])].unit
    levels = results.designs[study.name][str(row["factor"])].astype(float)
    return tr(
        "{low} to {high} {unit}",
        low=number_text(levels.min(), 3),
        high=number_text(levels.max(), 3),
        unit=unit,
    )


def _shares(results: Results, solver: str) -> list[str]:
    """Say which share of the variance the first factor of each study has."""
    table = results.table(ResponseImpact)
    mine = table[(table["solver"] == solver) & (table["response"] == STIFFNESS)]
    said = []
    for study in results.config.studies:
        rows = mine[mine["study"] == study.name].dropna(subset=["total_index"])
        if len(rows) < 2:
            continue
        said.append(_share(study, rows.sort_values("total_index", ascending=False).iloc[0]))
    return said


def _share(study: Study, row: pd.Series) -> str:
    return tr(
        "Within the study “{study}”, {factor} causes {share} % of the variance (Sobol index, "
        "± {error}).",
        study=study.name,
        factor=factor_labels(study)[str(row["factor"])].label,
        share=f"{100 * row['total_index']:.0f}",
        error=f"{100 * row['total_confidence']:.0f}",
    )
