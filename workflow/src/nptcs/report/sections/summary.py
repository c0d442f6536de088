"""The head of the report: what failed, before anything else, and what came out."""

from __future__ import annotations

from nptcs.report.blocks import Fact, Facts, Listing, PageBlock, Text
from nptcs.report.data import Results
from nptcs.report.factor_labels import factor_labels
from nptcs.report.figures.impact import ranked
from nptcs.report.figures.lca import DIFFERENCES, SECTION_NAMES
from nptcs.report.table_view import sheet_view
from nptcs.report.tables.headings import words
from nptcs.report.tables.sheets import Sheets
from nptcs.report.text import joined, with_error
from nptcs.tables.files import Files, FileStatus
from nptcs.tables.impact import Impact
from nptcs.tables.lca_validation import LcaValidation
from nptcs.tables.published_stiffness import StiffnessErrors
from nptcs.tables.result_table import ReportSection
from nptcs.tables.surface import SurfaceQuality

WARNING = "warning: "
"""Prefix of those checks of a material card that every reader must see."""


def summary_blocks(results: Results, sheets: Sheets) -> tuple[PageBlock, ...]:
    """Build the blocks above the first section."""
    sound, line = results.verdict()
    blocks: list[PageBlock] = [Text(line, "ok" if sound else "bad")]
    blocks += [
        sheet_view(sheet)
        for sheet in sheets.values()
        if sheet.section is ReportSection.SUMMARY and len(sheet.table)
    ]
    if remarks := _remarks(results):
        blocks.append(Listing("Worth knowing", remarks, "warn"))
    blocks.append(Facts("At a glance", glance(results)))
    return tuple(blocks)


def _remarks(results: Results) -> tuple[str, ...]:
    """Collect what is not a failure but must be seen."""
    remarks = []
    if results.any_synthetic:
        synthetic = [s.specimen for s in results.sheet if s.origin == "synthetic"]
        remarks.append(
            f"{len(synthetic)} of {len(results.sheet)} specimens are SYNTHETIC example data; "
            "everything made from them carries the badge."
        )
    for name, reason in results.left_out().items():
        remarks.append(f"Specimen {name} is left out by the sheet: {reason}")
    files = results.table(Files)
    stray = files[files["status"] == FileStatus.NOT_NAMED]
    if len(stray):
        remarks.append(
            "No row of the sheet names these files of the folder: " + joined(stray["file"])
        )
    remarks += [
        f"{card.name}: {check.removeprefix(WARNING)}"
        for card in results.cards
        for check in card.checks
        if check.startswith(WARNING)
    ]
    return tuple(remarks)


def glance(results: Results) -> tuple[Fact, ...]:
    """Select the numbers that most readers look for first."""
    return (
        *_materials(results),
        *_surfaces(results),
        *_rankings(results),
        *_published_differences(results),
        *_lca(results),
    )


def _materials(results: Results) -> list[Fact]:
    rows = []
    for card in results.cards:
        constants = []
        for name, quantity in card.constants.items():
            if quantity.origin == "measured":
                text = with_error(quantity.value, quantity.standard_error, quantity.unit)
                constants.append(f"{words(name.removesuffix('_mpa'))} = {text}")
        badge = " (SYNTHETIC data)" if card.synthetic else ""
        rows.append(
            Fact(
                f"Measured constants of {card.name}{badge}, ± standard error",
                "; ".join(constants),
                "material_card.json",
            )
        )
    return rows


def _surfaces(results: Results) -> list[Fact]:
    return [
        Fact(
            f"Response surface of {row.study}, solver {row.solver}"
            + _badge(results, [str(row.study)], str(row.solver)),
            f"R² = {row.r_squared:.5f}, leave-one-out R² = {row.leave_one_out_r_squared:.5f}, "
            f"largest residual {row.largest_residual:.3g} N/mm, {row.points} cases",
            "surface_quality.csv",
        )
        for row in results.table(SurfaceQuality).itertuples()
    ]


def _rankings(results: Results) -> list[Fact]:
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
                f"Ranking by impact, solver {solver}, {words(rule)}"
                + _badge(results, sorted(set(table["study"])), str(solver)),
                " > ".join(order),
                "impact.csv",
            )
        )
    return rows


def _published_differences(results: Results) -> list[Fact]:
    """Summarise how far the computed stiffness is from the published one."""
    facts = []
    for row in results.table(StiffnessErrors).itertuples():
        kind = "blind" if row.group == "blind" else "used for calibration"
        text = f"{row.compared} of {row.cases} cases compared"
        if row.compared:
            text += (
                f", mean {row.mean_percent:+.2f} %, mean absolute "
                f"{row.mean_absolute_percent:.2f} %, largest {row.largest_percent:+.2f} % "
                f"({row.largest_case_id})"
            )
        name = f"Stiffness of {row.study}, solver {row.solver}, against the published, {kind}"
        badge = _badge(results, [str(row.study)], str(row.solver))
        facts.append(Fact(name + badge, text, "stiffness_errors.csv"))
    return facts


def _lca(results: Results) -> list[Fact]:
    """Give the smallest and the largest difference from table 11, section by section."""
    facts = []
    for section, table in results.table(LcaValidation).groupby("section", sort=False):
        spans = [
            f"{label} {table[column].min():+.2f} … {table[column].max():+.2f} %"
            for column, label in DIFFERENCES.items()
        ]
        facts.append(
            Fact(
                f"LCA, {SECTION_NAMES[str(section)]}, difference from the printed table 11",
                "; ".join(spans),
                "lca_validation.csv",
            )
        )
    return facts


def _badge(results: Results, studies: list[str], solver: str) -> str:
    """Say so where a row rests on synthetic specimens."""
    config = results.config
    synthetic = any(results.study_is_synthetic(config.study(name), solver) for name in studies)
    return " (SYNTHETIC data)" if synthetic else ""
