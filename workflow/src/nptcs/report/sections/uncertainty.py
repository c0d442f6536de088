"""Uncertainty of the responses of reference and chosen designs, and its sources."""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from typing import Any

import pandas as pd

from nptcs.language import tr
from nptcs.report.blocks import Fact, Facts, PageBlock, Plot, Plots, Section, Text
from nptcs.report.data import Results
from nptcs.report.figures.uncertainty import share_bars
from nptcs.report.plots import plot
from nptcs.report.table_view import sheet_view
from nptcs.report.tables.headings import words
from nptcs.report.tables.names import factor_headings, in_words
from nptcs.report.tables.sheets import Sheets, sheet_of
from nptcs.report.text import rounded, with_error
from nptcs.tables.analysis.uncertainty import ResponseUncertainty, UncertaintyShares
from nptcs.tables.result_table import Heading, ReportSection

KEYS = ["study", "solver", "design", "response", "at"]
LARGEST = 3
"""Sources that the sentence on a response names."""

SMALLEST_PERCENT = 0.5
"""Share of the variance below which a source is not named: it would read as 0 %."""


def uncertainty_section(results: Results, sheets: Sheets) -> Section:
    """Build the section on the uncertainty of responses."""
    table, shares = results.table(ResponseUncertainty), results.table(UncertaintyShares)
    if table.empty:
        return Section(ReportSection.UNCERTAINTY, tr("Uncertainty"), ())
    blocks: list[PageBlock] = [
        Text(
            tr(
                "What is not known exactly is propagated through the surfaces: the tests behind "
                "the material card, stated rubbers, manufacturing tolerances and the surface's "
                "own error. A large share shows which test to repeat or which tolerance to "
                "tighten. The difference of the solver from the published stiffness (bias) is "
                "next to the interval and not part of it."
            )
        ),
        Facts(tr("How certain each response is"), tuple(_facts(results, table, shares))),
        Plots(tr("Shares of the variance by source."), tuple(_plots(results, shares)), shown=2),
        sheet_view(sheet_of(sheets, ResponseUncertainty)),
        sheet_view(sheet_of(sheets, UncertaintyShares)),
    ]
    return Section(
        ReportSection.UNCERTAINTY,
        tr("Uncertainty"),
        tuple(blocks),
        results.table_is_synthetic(table),
    )


def _facts(results: Results, table: pd.DataFrame, shares: pd.DataFrame) -> list[Fact]:
    facts = []
    factors = factor_headings(results.config.studies)
    parts = {key: rows for key, rows in shares.groupby(KEYS, sort=False)}
    for row in table.to_dict("records"):
        rows = parts[tuple(row[key] for key in KEYS)].dropna(subset=["share_percent"])
        largest = "; ".join(
            f"{_short(one, factors)} {one['share_percent']:.0f} %"
            for one in rows.head(LARGEST).to_dict("records")
            if one["share_percent"] >= SMALLEST_PERCENT
        )
        text = tr(
            "{value} (SD), {percent:.0f} % interval {low} to {high}; {largest}",
            value=with_error(row["mean"], row["sd"], row["unit"]),
            percent=row["confidence_percent"],
            low=rounded(row["low"], row["sd"]),
            high=rounded(row["high"], row["sd"]),
            largest=largest,
        )
        if pd.notna(row["bias_mean_percent"]):
            text += tr(
                ". Bias, not in the interval: {bias_mean_percent:+.2f} % mean, "
                "{bias_largest_percent:+.2f} % at most, {blind_cases} blind cases",
                bias_mean_percent=row["bias_mean_percent"],
                bias_largest_percent=row["bias_largest_percent"],
                blind_cases=row["blind_cases"],
            )
        at = tr(" at {at}", at=row["at"]) if row["at"] else ""
        what = tr(
            "{response}{at}, {design}, study {study}, solver {solver}",
            response=_title(str(row["response"])),
            at=at,
            design=tr(row["design"]),
            study=row["study"],
            solver=row["solver"],
        )
        facts.append(Fact(what, text, "uncertainty.csv"))
    return facts


def _title(response: str) -> str:
    """Name a response at the beginning of a line."""
    text = words(response)
    return text[:1].upper() + text[1:]


def _short(row: Mapping[Hashable, Any], factors: Mapping[str, Heading]) -> str:
    """Name a source without its standard deviation."""
    return in_words(str(row["quantities"]).split(" ± ")[0], factors)


def _plots(results: Results, shares: pd.DataFrame) -> list[Plot]:
    """Draw the stiffness of each reference and chosen design."""
    plots = []
    stiffness = shares[shares["response"] == "secant_stiffness"]
    for key, rows in stiffness.dropna(subset=["share_percent"]).groupby(KEYS, sort=False):
        study, solver, design, _, at = map(str, key)
        synthetic = results.study_is_synthetic(results.config.study(study), solver)
        given = (rows, f"{tr(design)}, {at}\n{solver}", synthetic)
        alt = tr(
            "Shares of the variance of the stiffness at {at}, {design} of {study}, {solver}",
            at=at,
            design=tr(design),
            study=study,
            solver=solver,
        )
        plots.append(plot(alt, synthetic, share_bars, *given))
    return plots
