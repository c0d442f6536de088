"""The numbers that most readers of a section look for first, at its beginning."""

from __future__ import annotations

from nptcs.language import tr
from nptcs.report.blocks import Fact, Facts, PageBlock
from nptcs.report.data import Results
from nptcs.report.factor_labels import factor_labels
from nptcs.report.figures.impact import ranked
from nptcs.report.figures.lca import DIFFERENCES, SECTION_NAMES
from nptcs.report.tables.headings import words
from nptcs.report.text import with_error
from nptcs.tables.analysis.impact import Impact
from nptcs.tables.analysis.surface import SurfaceQuality
from nptcs.tables.published.lca_validation import LcaValidation
from nptcs.tables.published.stiffness import StiffnessErrors


def material_facts(results: Results) -> tuple[PageBlock, ...]:
    """Give the measured constants with their standard errors."""
    rows = []
    for card in results.cards:
        constants = []
        for name, quantity in card.constants.items():
            if quantity.origin == "measured":
                text = with_error(quantity.value, quantity.standard_error, quantity.unit)
                constants.append(f"{words(name.removesuffix('_mpa'))} = {text}")
        badge = tr(" (SYNTHETIC data)") if card.synthetic else ""
        rows.append(
            Fact(
                tr(
                    "Measured constants of {name}{badge}, ± standard error",
                    name=card.name,
                    badge=badge,
                ),
                "; ".join(constants),
                "material_card.json",
            )
        )
    return _facts(rows)


def surface_facts(results: Results) -> tuple[PageBlock, ...]:
    """Say how well each polynomial follows its cases."""
    return _facts(
        [
            Fact(
                tr(
                    "Response surface of {study}, solver {solver}",
                    study=row.study,
                    solver=row.solver,
                )
                + _badge(results, [str(row.study)], str(row.solver)),
                tr(
                    "R² = {r_squared:.5f}, leave-one-out R² = {leave_one_out_r_squared:.5f}, "
                    "largest residual {largest_residual:.3g} N/mm, {points} cases",
                    r_squared=row.r_squared,
                    leave_one_out_r_squared=row.leave_one_out_r_squared,
                    largest_residual=row.largest_residual,
                    points=row.points,
                ),
                "surface_quality.csv",
            )
            for row in results.table(SurfaceQuality).itertuples()
        ]
    )


def ranking_facts(results: Results) -> tuple[PageBlock, ...]:
    """Rank the factors of each solver by the first rule."""
    rule = results.config.sensitivity.rules[0]
    labels = {
        (study.name, name): label.label
        for study in results.config.studies
        for name, label in factor_labels(study).items()
    }
    rows = []
    for solver, table in results.table(Impact).groupby("solver", sort=True):
        order = [f"{labels[key]} ({key[0]})" for key in ranked(table, rule)]
        rows.append(
            Fact(
                tr("Ranking by impact, solver {solver}, {rule}", solver=solver, rule=words(rule))
                + _badge(results, sorted(set(table["study"])), str(solver)),
                " > ".join(order),
                "impact.csv",
            )
        )
    return _facts(rows)


def published_facts(results: Results) -> tuple[PageBlock, ...]:
    """Summarise how far the computed stiffness is from the published one."""
    facts = []
    for row in results.table(StiffnessErrors).itertuples():
        kind = tr("blind") if row.group == "blind" else tr("used for calibration")
        text = tr("{compared} of {cases} cases compared", compared=row.compared, cases=row.cases)
        if row.compared:
            text += tr(
                ", mean {mean_percent:+.2f} %, mean absolute {mean_absolute_percent:.2f} "
                "%, largest {largest_percent:+.2f} % ({largest_case_id})",
                mean_percent=row.mean_percent,
                mean_absolute_percent=row.mean_absolute_percent,
                largest_percent=row.largest_percent,
                largest_case_id=row.largest_case_id,
            )
        name = tr(
            "Stiffness of {study}, solver {solver}, against the published, {kind}",
            study=row.study,
            solver=row.solver,
            kind=kind,
        )
        badge = _badge(results, [str(row.study)], str(row.solver))
        facts.append(Fact(name + badge, text, "stiffness_errors.csv"))
    return _facts(facts)


def lca_facts(results: Results) -> tuple[PageBlock, ...]:
    """Give the smallest and the largest difference from table 11, section by section."""
    facts = []
    for section, table in results.table(LcaValidation).groupby("section", sort=False):
        spans = [
            f"{tr(label)} {table[column].min():+.2f} … {table[column].max():+.2f} %"
            for column, label in DIFFERENCES.items()
        ]
        facts.append(
            Fact(
                tr(
                    "LCA, {section}, difference from the printed table 11",
                    section=tr(SECTION_NAMES[str(section)]),
                ),
                "; ".join(spans),
                "lca_validation.csv",
            )
        )
    return _facts(facts)


def _badge(results: Results, studies: list[str], solver: str) -> str:
    """Say so where a row rests on synthetic specimens."""
    config = results.config
    synthetic = any(results.study_is_synthetic(config.study(name), solver) for name in studies)
    return tr(" (SYNTHETIC data)") if synthetic else ""


def _facts(facts: list[Fact]) -> tuple[PageBlock, ...]:
    """Write facts as a block; none without facts."""
    return (Facts(tr("At a glance"), tuple(facts)),) if facts else ()
