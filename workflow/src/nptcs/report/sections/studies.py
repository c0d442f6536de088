"""Sections of the report on designs, cases, response surfaces and sensitivity."""

from __future__ import annotations

import math
from collections.abc import Sequence

import pandas as pd

from nptcs.config.studies.study import Factor, MeasuredRubber, Study
from nptcs.language import tr, translatable
from nptcs.report.blocks import Fact, Facts, PageBlock, Plot, Plots, Section, TableView, Text
from nptcs.report.data import Results, SolverDescription
from nptcs.report.factor_labels import factor_labels
from nptcs.report.figures.impact import impact_bars
from nptcs.report.figures.residuals import residual_quantiles, residuals_over_value
from nptcs.report.figures.style import MOST_MARKS
from nptcs.report.figures.surface import common_levels, contours, pairs, slices
from nptcs.report.plots import plot
from nptcs.report.sections.key_facts import ranking_facts, surface_facts
from nptcs.report.sections.ranking import ranking_blocks
from nptcs.report.sections.refused import refused_blocks
from nptcs.report.table_view import sheet_view, table_view
from nptcs.report.tables import entries
from nptcs.report.tables.headings import heading, words
from nptcs.report.tables.names import factor_headings
from nptcs.report.tables.row_classes import by_status
from nptcs.report.tables.sheets import Sheets, sheet_of
from nptcs.report.text import joined
from nptcs.surface.cases import solved_cases
from nptcs.tables.analysis.diagnostics import SurfaceInfluence
from nptcs.tables.analysis.impact import Impact
from nptcs.tables.analysis.surface import SurfaceQuality, SurfaceTable
from nptcs.tables.result_table import ReportSection
from nptcs.tables.status import has_result
from nptcs.tables.tyres.cases import RESPONSES, Cases

COEFFICIENT_DIGITS = 10
"""Significant digits of coefficients: a reader can evaluate the surface from the page."""

FACTORS = entries.Entry(
    "factors",
    translatable("Factors, levels and fixed values of each study"),
    "results/4_design/*.csv",
    "design",
    translatable("the configuration; C10 of tested rubbers from the material card"),
)
COUNTS = entries.Entry(
    "case_counts",
    translatable("Cases by study, solver and status"),
    "results/tables/cases.csv",
    "cases",
    translatable("the case records, counted"),
)
SPANS = entries.Entry(
    "response_spans",
    translatable("Responses of the solved cases by study and solver"),
    "results/tables/cases.csv",
    "cases",
    translatable("the case records"),
)


def design_section(results: Results, sheets: Sheets) -> Section:
    """Build the section on the designs."""
    rows = [row for study in results.config.studies for row in _factor_rows(study, results)]
    columns = ["study", "title", "cases", "quantity", "unit", "levels", "load_n", "solvers"]
    view = table_view(pd.DataFrame(rows, columns=columns), FACTORS)
    return Section(ReportSection.DESIGN, tr("Design"), (view,))


def _factor_rows(study: Study, results: Results) -> list[tuple[object, ...]]:
    design = results.designs[study.name]
    loaded = any(results.solvers[name].loads_tyre for name in study.solvers)
    shared = (study.load_n if loaded else math.nan, ", ".join(study.solvers))
    labels, names = factor_labels(study), factor_headings(results.config.studies)
    rows: list[tuple[object, ...]] = [
        (
            study.name,
            tr(study.title),
            len(design),
            labels[factor.name].label,
            labels[factor.name].unit,
            _levels(factor, design),
        )
        + shared
        for factor in study.factors
    ]
    return rows + [
        (
            study.name,
            tr(study.title),
            len(design),
            tr("{name} (fixed)", name=heading(name, names).name),
            heading(name, names).unit,
            _fixed(value),
        )
        + shared
        for name, value in study.fixed.items()
    ]


def _fixed(value: object) -> str:
    return value.rubber if isinstance(value, MeasuredRubber) else f"{value:g}"


def _levels(factor: Factor, design: pd.DataFrame) -> str:
    """Write the levels as the design has them, with the rubber behind each measured one."""
    numbers = list(dict.fromkeys(design[factor.name]))
    if len(numbers) != len(factor.levels):
        return tr(
            "{lowest:g} to {highest:g}, {count} values",
            lowest=min(numbers),
            highest=max(numbers),
            count=len(numbers),
        )
    return ", ".join(
        f"{number:.5g} ({level.rubber})" if isinstance(level, MeasuredRubber) else f"{number:g}"
        for number, level in zip(numbers, factor.levels, strict=True)
    )


def cases_section(results: Results, sheets: Sheets) -> Section:
    """Build the section on the cases."""
    solvers = tuple(
        Fact(name, tr(facts.about) + _choices(facts), "") for name, facts in results.solvers.items()
    )
    blocks: list[PageBlock] = [
        Facts(tr("Solvers"), solvers),
        table_view(case_counts(results.table(Cases)), COUNTS, mark=by_status),
        table_view(response_spans(results.table(Cases)), SPANS),
    ]
    entry = sheet_of(sheets, Cases).entry
    blocks += [_cases_of(results, study, entry) for study in results.config.studies]
    return Section(ReportSection.CASES, tr("Cases"), tuple(blocks))


def _choices(facts: SolverDescription) -> str:
    """Name the models that the solver's options choose."""
    sets = [
        ", ".join(f"{words(name)}: {tr(choice)}" for name, choice in chosen.items())
        for chosen in facts.choices
    ]
    return f" ({tr(' or ').join(sets)})" if sets else ""


def _cases_of(results: Results, study: Study, entry: entries.Entry) -> TableView:
    """Show the cases of one study; the messages come last."""
    cases = results.table(Cases)[results.table(Cases)["study"] == study.name]
    names = [str(name) for name in cases if name not in ("study", "message", "key")]
    return table_view(
        cases,
        entry,
        tr("Cases of the study {name}: {title}", name=study.name, title=tr(study.title)),
        [*names, "message"],
        mark=by_status,
        synthetic=results.study_is_synthetic(study),
    )


def case_counts(cases: pd.DataFrame) -> pd.DataFrame:
    """Count the cases of each study and solver by status."""
    groups = cases.groupby(["study", "solver", "solver_version", "status"], sort=False)
    return groups.size().rename("cases").reset_index()


def response_spans(cases: pd.DataFrame) -> pd.DataFrame:
    """Find the lowest, the middle and the highest value of each response by study and solver."""
    solved = cases[has_result(cases["status"])]
    rows = []
    for (study, solver), group in solved.groupby(["study", "solver"], sort=False):
        for name in RESPONSES:
            values = group[name].dropna()
            if len(values):
                written = heading(name)
                span = (values.min(), values.median(), values.max())
                rows.append((study, solver, written.name, written.unit, len(values), *span))
    columns = ["study", "solver", "response", "unit", "cases", "lowest", "median", "highest"]
    return pd.DataFrame(rows, columns=columns)


def surfaces_section(results: Results, sheets: Sheets) -> Section:
    """Build the section on the response surfaces."""
    blocks: list[PageBlock] = [
        Text(
            tr(
                "Coefficients are fitted in coded units, each factor scaled to [−1, 1] over its "
                "range, and given in coded and natural units at full precision: a surface can be "
                "evaluated from this page. Published coefficients are next to them, rounded as "
                "in the paper."
            )
        ),
        *surface_facts(results),
        sheet_view(sheet_of(sheets, SurfaceQuality)),
    ]
    for study in results.config.studies:
        blocks += _surface_blocks(results, sheets, study)
    return Section(ReportSection.SURFACES, tr("Response surfaces"), tuple(blocks))


def _surface_blocks(results: Results, sheets: Sheets, study: Study) -> list[PageBlock]:
    """Build the coefficients and the figures of one study."""
    if not study.terms:
        asked = tr("This study has no terms, so no surface is fitted to it.")
        return [Text(tr(study.title), "heading"), Text(asked)]
    if not results.surfaces[study.name]:
        refused = tr(
            "No surface could be fitted to the study {name}; see the problems above.",
            name=study.name,
        )
        return [Text(tr(study.title), "heading"), Text(refused, "bad")]
    sheet = sheet_of(sheets, SurfaceTable, study.name)
    precise = dict.fromkeys(map(str, sheet.table.columns), COEFFICIENT_DIGITS)
    blocks: list[PageBlock] = [
        Text(tr(study.title), "heading"),
        *refused_blocks(study),
        sheet_view(sheet, given_digits=precise, whole=True),
    ]
    solved = {name: _solved(results, study, name) for name in results.surfaces[study.name]}
    levels = common_levels([(results.surfaces[study.name][name], solved[name]) for name in solved])
    plots = [
        drawn
        for solver, cases in solved.items()
        for drawn in _surface_plots(results, study, solver, cases, levels)
    ]
    first = len(plots) // len(solved)  # the panels of one solver
    many = len(results.designs[study.name]) > MOST_MARKS
    held = tr(" Factors that a panel does not show are at the middle level named in its title.")
    caption = tr(
        "{title}: each surface over two factors, the discs are the cases; one "
        "colour scale for all panels and solvers; and over one factor, the lines "
        "are the surface, the marks are the cases",
        title=tr(study.title),
    ) + (tr(", sampled, at most {most} per panel.", most=MOST_MARKS) if many else tr("."))
    blocks.append(Plots(caption + held * (len(study.factors) > 2), tuple(plots), shown=first))
    if residuals := _residual_plots(results, study):
        words_of_residuals = tr(
            "{title}: residuals of the polynomial at its cases, over its value (marks grow with "
            "the leverage) and against a normal distribution. The results of a solver have no "
            "noise: a pattern shows what the polynomial cannot follow.",
            title=tr(study.title),
        )
        blocks.append(Plots(words_of_residuals, tuple(residuals), shown=0))
    return blocks


def _residual_plots(results: Results, study: Study) -> list[Plot]:
    table = results.table(SurfaceInfluence)
    plots = []
    for solver, rows in table[table["study"] == study.name].groupby("solver", sort=False):
        synthetic = results.study_is_synthetic(study, str(solver))
        about = tr("study {name}, solver {solver}", name=study.name, solver=solver)
        given = (rows, tr("Residuals, {solver}", solver=solver), synthetic)
        alt = tr("Residuals over the value of the polynomial, {about}", about=about)
        plots.append(plot(alt, synthetic, residuals_over_value, *given))
        alt = tr("Residuals against normal quantiles, {about}", about=about)
        plots.append(plot(alt, synthetic, residual_quantiles, *given))
    return plots


def _solved(results: Results, study: Study, solver: str) -> pd.DataFrame:
    """Take the cases that the surface of a solver was fitted to."""
    cases, factors = results.table(Cases), results.surfaces[study.name][solver].factors
    return solved_cases(cases[cases["study"] == study.name], solver, factors).table


def _surface_plots(
    results: Results, study: Study, solver: str, solved: pd.DataFrame, levels: Sequence[float]
) -> list[Plot]:
    surface, labels = results.surfaces[study.name][solver], factor_labels(study)
    synthetic = results.study_is_synthetic(study, solver)
    about = tr("study {name}, solver {solver}", name=study.name, solver=solver)
    maps, lines = [], []
    for pair in pairs(surface):
        alt = tr(
            "Vertical stiffness over {names}, {about}",
            names=joined(labels[name].label for name in pair),
            about=about,
        )
        given = (surface, solved, pair, labels, synthetic, levels)
        maps.append(plot(alt, synthetic, contours, *given))
    drawn: Sequence[tuple[str, ...]] = pairs(surface) or [surface.polynomial.factors]
    for varied in drawn:
        # the factor with more levels is drawn along the axis
        by_levels = sorted(varied, key=lambda name: -solved[name].nunique())
        alt = tr(
            "Vertical stiffness over {label} as lines, {about}",
            label=labels[by_levels[0]].label,
            about=about,
        )
        lined = (surface, solved, by_levels, labels, synthetic, levels)
        lines.append(plot(alt, synthetic, slices, *lined))
    return maps + lines


def sensitivity_section(results: Results, sheets: Sheets) -> Section:
    """Build the section on the impact values."""
    rules = results.config.sensitivity.rules
    plots = [
        _impact_plot(results, str(solver), rows)
        for solver, rows in results.table(Impact).groupby("solver", sort=True)
    ]
    blocks: list[PageBlock] = [
        Text(
            tr(
                "Comprehensive impact value = average gradient × range of the factor (section "
                "4.2.3 of the paper). The paper does not state how it averages, and no single "
                "rule gives all its numbers, so every rule is given here. The ranking and the "
                "order of the bars are by {rules}.",
                rules=words(rules[0]),
            )
        ),
        *ranking_facts(results),
        Plots(tr("Impact of each factor on the vertical stiffness."), tuple(plots), shown=2),
        *(block for study in results.config.studies for block in refused_blocks(study)),
        *ranking_blocks(results),
        sheet_view(sheet_of(sheets, Impact)),
    ]
    return Section(ReportSection.SENSITIVITY, tr("Sensitivity"), tuple(blocks))


def _impact_plot(results: Results, solver: str, rows: pd.DataFrame) -> Plot:
    studies = [study for study in results.config.studies if study.name in set(rows["study"])]
    labels = {
        (study.name, name): f"{label.label}\n({study.name})"
        for study in studies
        for name, label in factor_labels(study).items()
    }
    synthetic = any(results.study_is_synthetic(study, solver) for study in studies)
    alt = tr("Impact values of solver {solver} by factor and rule", solver=solver)
    given = (rows, labels, results.config.sensitivity.rules, synthetic)
    return plot(alt, synthetic, impact_bars, *given)
