"""Impact values and their order compared with table 9 of the paper, solver by solver."""

from __future__ import annotations

import pandas as pd

from nptcs.language import tr
from nptcs.report.blocks import Listing, PageBlock
from nptcs.report.data import Results
from nptcs.report.factor_labels import factor_labels
from nptcs.report.table_view import table_view
from nptcs.report.tables.entries import Entry
from nptcs.report.tables.headings import Heading, words
from nptcs.report.tables.names import factor_headings
from nptcs.report.text import joined
from nptcs.tables.analysis.impact import Impact

FILE = "results/tables/impact.csv"


def ranking_blocks(results: Results) -> list[PageBlock]:
    """Build the table of impact values next to table 9, and say whether the order is the same."""
    compared = results.table(Impact).dropna(subset=["published_impact"])
    if compared.empty:
        return []
    table, headings = published_ranking(compared)
    entry = Entry(
        "impact_ranking",
        tr("Table 9 and ours: impact values with their rank by every rule"),
        FILE,
        "sensitivity",
        tr("impact.csv, factors of table 9; ranks are among these factors"),
        headings,
    ).with_factors(factor_headings(results.config.studies))
    synthetic = any(
        results.study_is_synthetic(results.config.study(str(study)), str(solver))
        for solver, study in compared[["solver", "study"]].drop_duplicates().to_numpy()
    )
    return [
        Listing(
            tr("Is the ranking the same as in table 9?"),
            (
                *published_order(results, compared),
                *verdicts(results, compared),
                *near_tie_sentences(results, compared),
            ),
        ),
        table_view(table, entry, synthetic=synthetic),
    ]


def published_ranking(compared: pd.DataFrame) -> tuple[pd.DataFrame, dict[str, Heading]]:
    """Write |impact| and rank of each solver next to table 9, one row per rule and factor."""
    keys = ["rule", "study", "factor"]
    published = compared.drop_duplicates(keys)[[*keys, "published_impact"]]
    place = {rule: number for number, rule in enumerate(compared["rule"].unique())}
    published = published.assign(place=published["rule"].map(place))
    published = published.sort_values(["place", "published_impact"], ascending=[True, False])
    published = published.drop(columns="place")
    ranks = published.groupby("rule")["published_impact"].rank(ascending=False)
    headings = {
        "published_impact": Heading(tr("table 9, impact"), "N/mm"),
        "published_rank": Heading(tr("table 9, rank")),
    }
    table = published.assign(published_rank=ranks)
    for solver, rows in compared.groupby("solver", sort=True):
        computed = rows.set_index(keys)
        table = table.join(computed["impact"].abs().rename(f"impact_{solver}"), on=keys)
        table = table.join(computed["rank"].astype(float).rename(f"rank_{solver}"), on=keys)
        headings[f"impact_{solver}"] = Heading(tr("{solver}, impact", solver=solver), "N/mm")
        headings[f"rank_{solver}"] = Heading(tr("{solver}, rank", solver=solver))
    return table.reset_index(drop=True), headings


def near_tie_sentences(results: Results, compared: pd.DataFrame) -> list[str]:
    """Name the pairs of factors whose order is not settled."""
    labels = {
        (study.name, name): label.label
        for study in results.config.studies
        for name, label in factor_labels(study).items()
    }
    tied = compared[compared["near_tie_with"] != ""]
    pairs = {
        (str(study), *sorted((str(factor), partner)))
        for study, factor, partners in tied[["study", "factor", "near_tie_with"]].to_numpy()
        for partner in str(partners).split(", ")
    }
    return [
        tr(
            "{factor} and {partner} are a near tie: their order is not settled, because they are "
            "close or because rules or solvers disagree on it.",
            factor=labels[study, one],
            partner=labels[study, other],
        )
        for study, one, other in sorted(pairs)
    ]


def published_order(results: Results, compared: pd.DataFrame) -> list[str]:
    """Write the factors in the order of table 9, where one solver has all of them."""
    every = set(zip(compared["study"], compared["factor"], strict=True))
    for _, rows in compared.groupby(["solver", "rule"], sort=False):
        if set(zip(rows["study"], rows["factor"], strict=True)) == every and len(every) > 1:
            return [tr("Table 9: {order}.", order=_order(results, rows, "published_rank"))]
    return []


def verdicts(results: Results, compared: pd.DataFrame) -> list[str]:
    """Say for each solver by which rules its factors are ranked as in table 9, and by which not.

    Rules that give the same order share one sentence.
    """
    sentences, whole = [], published_order(results, compared)
    for solver, of_solver in compared.groupby("solver", sort=True):
        alike: dict[tuple[str, str], list[str]] = {}
        for rule, rows in of_solver.groupby("rule", sort=False):
            orders = (_order(results, rows, "rank"), _order(results, rows, "published_rank"))
            if len(rows) > 1:
                alike.setdefault(orders, []).append(words(str(rule)))
        for (computed, published), rules in alike.items():
            if computed == published:
                sentence = tr("{solver}, {rules}: {order}: the same as in table 9.")
            elif tr("Table 9: {order}.", order=published) in whole:
                sentence = tr("{solver}, {rules}: {order}: NOT the same as in table 9.")
            else:
                sentence = tr(
                    "{solver}, {rules}: {order}: NOT the same as in table 9 ({published})."
                )
            told = {"rules": joined(rules), "order": computed, "published": published}
            sentences.append(sentence.format(solver=solver, **told))
    return sentences


def _order(results: Results, rows: pd.DataFrame, by: str) -> str:
    """Write the factors of some rows in the order of a rank."""
    labels = {
        (study.name, name): label.label
        for study in results.config.studies
        for name, label in factor_labels(study).items()
    }
    ordered = rows.sort_values(by)[["study", "factor"]]
    return " > ".join(labels[key] for key in ordered.itertuples(index=False, name=None))
