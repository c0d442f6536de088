"""Does it agree with what is published? Errors of the blind cases, solver by solver."""

from __future__ import annotations

import pandas as pd

from nptcs.language import tr
from nptcs.report.answer.stiffness import leading_solver
from nptcs.report.blocks import Finding
from nptcs.report.data import Results
from nptcs.report.sketches import BarRow, bars
from nptcs.tables.analysis.surface import SurfaceComparison
from nptcs.tables.analysis.uncertainty import ResponseUncertainty
from nptcs.tables.published.stiffness import StiffnessErrors
from nptcs.tables.result_table import ReportSection

MOST_BARS = 6


def agreement_finding(results: Results) -> Finding:
    """Say how far the leading solver is from the published stiffness at cases it has not seen."""
    errors = results.table(StiffnessErrors)
    blind = errors[errors["group"].eq("blind") & errors["compared"].gt(0)]
    if blind.empty:
        return Finding(
            tr("Does it agree with the published tyre?"),
            tr("Not assessed"),
            tr("No study of this run has both published and computed stiffness.")
            + _left_out(results),
            "stiffness_errors.csv",
            ReportSection.PUBLISHED_STIFFNESS,
            assessed=False,
        )
    study = next(one for one in results.config.studies if blind["study"].eq(one.name).any())
    mine = blind[blind["study"] == study.name]
    solver = leading_solver(study, list(mine["solver"]))
    row = mine[mine["solver"] == solver].iloc[0]
    words = tr(
        "At {count} cases of the study “{study}” that {solver} was not calibrated on, its "
        "stiffness differs from the published one by {mean} % on average and by {largest} % at "
        "most ({case}).",
        count=row["compared"],
        study=study.name,
        solver=solver,
        mean=f"{row['mean_absolute_percent']:.2g}",
        largest=f"{row['largest_percent']:+.2g}",
        case=row["largest_case_id"],
    )
    others = len(blind) > 1
    if others:
        words += " " + tr("The line reaches to the largest difference.")
    return Finding(
        tr("Does it agree with the published tyre?"),
        tr(
            "{percent} % mean difference at {count} blind cases",
            percent=f"{row['mean_absolute_percent']:.2g}",
            count=row["compared"],
        ),
        words + _left_out(results),
        "stiffness_errors.csv, surface_comparison.csv",
        ReportSection.PUBLISHED_STIFFNESS,
        bars(
            [_bar(one, one is row) for one in [row, *_others(blind, row)]][:MOST_BARS],
            tr("Mean absolute difference from the published stiffness, by study and solver"),
        ),
        synthetic=results.study_is_synthetic(study, solver),
    )


def _others(blind: pd.DataFrame, row: pd.Series) -> list[pd.Series]:
    return [one for place, one in blind.iterrows() if place != row.name]


def _bar(row: pd.Series, first: bool) -> BarRow:
    mean, largest = row["mean_absolute_percent"], row["largest_percent"]
    return BarRow(
        f"{row['study']}, {row['solver']}",
        mean,
        f"{mean:.2g} ({largest:+.2g}) %",
        abs(largest),
        "accent" if first else "soft",
    )


def _left_out(results: Results) -> str:
    """Say how well the surface behind the leading numbers predicts cases that were left out."""
    said = results.table(ResponseUncertainty)
    said = said.loc[said["response"] == "secant_stiffness", ["study", "solver", "surface"]]
    said = said.drop_duplicates()
    table = results.table(SurfaceComparison).merge(said, on=["study", "solver", "surface"])
    table = table[table["leave_one_out_rms"].notna()]
    for study in results.config.studies:
        mine = table[table["study"] == study.name]
        if mine.empty:
            continue
        solver = leading_solver(study, list(mine["solver"].unique()))
        row = mine[mine["solver"] == solver].iloc[0]
        return " " + tr(
            "The surface predicts cases that were left out of its fit within {rms} N/mm (rms), "
            "{largest} N/mm at most.",
            rms=f"{row['leave_one_out_rms']:.2g}",
            largest=f"{row['leave_one_out_largest']:.2g}",
        )
    return ""
