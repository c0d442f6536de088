"""Section of the report on computed against published stiffness: tables 5 and 7, figure 14."""

from __future__ import annotations

from nptcs.config.studies.study import Study
from nptcs.language import tr
from nptcs.report.blocks import (
    Facts,
    PageBlock,
    Plot,
    Plots,
    Section,
    TableView,
    Text,
)
from nptcs.report.data import Results
from nptcs.report.factor_labels import factor_labels
from nptcs.report.figures.published_stiffness import (
    BANDS_PERCENT,
    level_differences,
    main_effect,
    parity,
)
from nptcs.report.plots import plot
from nptcs.report.sections.key_facts import published_facts
from nptcs.report.sections.ply import ply_words
from nptcs.report.sections.stiffness.compared_cases import (
    case_comparison,
    rests_on_synthetic,
    solver_order,
)
from nptcs.report.sections.stiffness.facts import level_facts, spoke_facts
from nptcs.report.sections.stiffness.neutral_lines import line_blocks
from nptcs.report.sections.stiffness.rings import ring_blocks
from nptcs.report.table_view import sheet_view, table_view
from nptcs.report.tables.sheets import Sheets, sheet_of
from nptcs.report.text import joined
from nptcs.tables.published.stiffness import (
    StiffnessAgainstPublished,
    StiffnessByLevel,
    StiffnessErrors,
)
from nptcs.tables.result_table import ReportSection
from nptcs.tables.tyres.spoke_stiffness import SpokeLines
from nptcs.tables.tyres.tyre_responses import TyreResponses


def published_stiffness_section(results: Results, sheets: Sheets) -> Section:
    """Build the section."""
    title = tr("Computed stiffness against the paper's finite elements")
    blocks = [*_stiffness_blocks(results, sheets), *line_blocks(results)]
    if not blocks:
        nothing = tr("No study of the configuration has both published and computed results.")
        return Section(ReportSection.PUBLISHED_STIFFNESS, title, (Text(nothing),))
    synthetic = sheet_of(sheets, StiffnessAgainstPublished).synthetic
    return Section(ReportSection.PUBLISHED_STIFFNESS, title, tuple(blocks), synthetic)


def _stiffness_blocks(results: Results, sheets: Sheets) -> list[PageBlock]:
    table = results.table(StiffnessAgainstPublished)
    if table.empty:
        return []
    studies = [results.config.study(name) for name in table["study"].unique()]
    bands = joined(f"±{percent:g} %" for percent in BANDS_PERCENT)
    return [
        Text(
            tr(
                "Differences are (computed − published) / published. Cases that a solver "
                "was calibrated on are named in the configuration and summarised "
                "separately; all others are blind. "
            )
            + ("" if len(results.table(TyreResponses)) else ply_words(results))
        ),
        *published_facts(results),
        sheet_view(sheet_of(sheets, StiffnessErrors)),
        *ring_blocks(results),
        Plots(
            tr(
                "Computed against published stiffness; the lines are equality and "
                "{bands}. Hollow marks are cases that the solver was calibrated on.",
                bands=bands,
            ),
            tuple(_parity(results, study) for study in studies),
        ),
        Facts(
            tr("Where the differences lie, as means at each level"),
            (*level_facts(results), *spoke_facts(results.table(SpokeLines))),
        ),
        Plots(
            tr("Main effects: mean stiffness over the cases at a level, published and computed."),
            tuple(_effects(results, studies, differences=False)),
        ),
        Plots(
            tr("Mean difference at each level; bars reach from the lowest to the highest case."),
            tuple(_effects(results, studies, differences=True)),
            shown=0,
        ),
        sheet_view(sheet_of(sheets, StiffnessByLevel)),
        *(_case_comparison(results, sheets, study) for study in studies),
    ]


def _parity(results: Results, study: Study) -> Plot:
    table = results.table(StiffnessAgainstPublished)
    rows = table[table["study"] == study.name]
    synthetic = rests_on_synthetic(results, study, rows)
    alt = tr("Computed against published stiffness of the study {name}", name=study.name)
    given = (
        rows,
        tr("Stiffness against the paper's,\nstudy {name}", name=study.name),
        solver_order(results),
        synthetic,
    )
    return plot(alt, synthetic, parity, *given)


def _effects(results: Results, studies: list[Study], *, differences: bool) -> list[Plot]:
    plots = []
    table = results.table(StiffnessByLevel)
    for study in studies:
        for name, label in factor_labels(study).items():
            rows = table[(table["study"] == study.name) & (table["factor"] == name)]
            if rows.empty:
                continue
            synthetic = rests_on_synthetic(results, study, rows)
            draw = level_differences if differences else main_effect
            what = (
                tr("Mean difference from the published stiffness")
                if differences
                else tr("Mean stiffness")
            )
            alt = tr(
                "{what} by {label}, study {name}", what=what, label=label.label, name=study.name
            )
            given = (rows, label, solver_order(results), synthetic)
            plots.append(plot(alt, synthetic, draw, *given))
    return plots


def _case_comparison(results: Results, sheets: Sheets, study: Study) -> TableView:
    """Show the cases of one study, the solvers next to each other."""
    table = results.table(StiffnessAgainstPublished)
    rows = table[table["study"] == study.name]
    view, headings = case_comparison(rows, [factor.name for factor in study.factors])
    entry = sheet_of(sheets, StiffnessAgainstPublished).entry.with_headings(headings)
    return table_view(
        view,
        entry,
        tr(
            "Cases of the study {name}, published and computed: {title}",
            name=study.name,
            title=tr(study.title),
        ),
        mark=lambda row: "bad" if row["failed"] else "out" if row["calibrated_on"] else "",
        synthetic=rests_on_synthetic(results, study, rows),
    )
