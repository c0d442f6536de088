"""Section of the report on computed stiffness beside the published one: tables 5, 7, figure 14."""

from __future__ import annotations

from collections.abc import Mapping

import pandas as pd

from nptcs.config.study import Study
from nptcs.report.data import Results, factor_labels
from nptcs.report.figures.published_stiffness import (
    BANDS_PERCENT,
    DISPLACEMENTS,
    level_differences,
    main_effect,
    neutral_lines,
    parity,
)
from nptcs.report.sections.ply import ply_words
from nptcs.report.tables import catalogue
from nptcs.report.tables.headings import Heading
from nptcs.report.tables.sheets import Sheets
from nptcs.report.view import (
    Fact,
    Facts,
    Listing,
    PageBlock,
    Plot,
    Plots,
    Section,
    TableView,
    Text,
    joined,
    plot,
    sheet_view,
    table_view,
)
from nptcs.tables.published_stiffness import (
    COMPUTED_STIFFNESS,
    DIFFERENCE,
    PUBLISHED,
    PUBLISHED_STIFFNESS,
)
from nptcs.tables.spoke_stiffness import DIRECTIONS


def published_stiffness_section(results: Results, sheets: Sheets) -> Section:
    """Build the section."""
    title = "Computed stiffness against the paper's finite elements"
    blocks = [*_stiffness_blocks(results, sheets), *_line_blocks(results)]
    if not blocks:
        nothing = "No study of the configuration has published results beside computed ones."
        return Section("against", title, (Text(nothing),))
    synthetic = sheets[catalogue.STIFFNESS_AGAINST_PUBLISHED.sheet].synthetic
    return Section("against", title, tuple(blocks), synthetic)


def _stiffness_blocks(results: Results, sheets: Sheets) -> list[PageBlock]:
    if results.compare_published.empty:
        return []
    studies = [results.config.study(name) for name in results.compare_published["study"].unique()]
    bands = joined(f"±{percent:g} %" for percent in BANDS_PERCENT)
    return [
        Text(
            "Differences are (computed − published) / published. Cases that a solver was "
            "calibrated on are named by the configuration and summed up apart; all others are "
            "blind. " + ply_words(results)
        ),
        sheet_view(sheets[catalogue.STIFFNESS_ERRORS.sheet]),
        Plots(
            f"Computed against published stiffness; the lines are equality and {bands}. Hollow "
            "marks are cases that the solver was calibrated on.",
            tuple(_parity(results, study) for study in studies),
        ),
        Facts(
            "Where the differences lie, as means at each level",
            (*level_facts(results), *spoke_facts(results.spoke_stiffness)),
        ),
        Plots(
            "Main effects: mean stiffness over the cases at a level, published and computed.",
            tuple(_effects(results, studies, differences=False)),
        ),
        Plots(
            "Mean difference at each level; bars reach from the lowest to the highest case.",
            tuple(_effects(results, studies, differences=True)),
        ),
        sheet_view(sheets[catalogue.STIFFNESS_BY_LEVEL.sheet]),
        *(_case_comparison(results, study) for study in studies),
    ]


def _synthetic(results: Results, study: Study, table: pd.DataFrame) -> bool:
    return any(results.study_is_synthetic(study, str(name)) for name in table["solver"].unique())


def _order(results: Results) -> list[str]:
    """List the solvers in an order that does not change from figure to figure."""
    return sorted(name for name in results.solvers if name != PUBLISHED)


def _parity(results: Results, study: Study) -> Plot:
    table = results.compare_published
    rows = table[table["study"] == study.name]
    synthetic = _synthetic(results, study, rows)
    alt = f"Computed against published stiffness of the study {study.name}"
    return plot(parity(rows, f"study {study.name}", _order(results), synthetic), alt, synthetic)


def _effects(results: Results, studies: list[Study], *, differences: bool) -> list[Plot]:
    plots = []
    table = results.stiffness_by_level
    for study in studies:
        for name, label in factor_labels(study).items():
            rows = table[(table["study"] == study.name) & (table["factor"] == name)]
            if rows.empty:
                continue
            synthetic = _synthetic(results, study, rows)
            draw = level_differences if differences else main_effect
            what = (
                "Mean difference from the published stiffness" if differences else "Mean stiffness"
            )
            alt = f"{what} by {label.label}, study {study.name}"
            figure = draw(rows, label, _order(results), synthetic)
            plots.append(plot(figure, alt, synthetic))
    return plots


def level_facts(results: Results) -> list[Fact]:
    """Say how the signed difference runs with each factor, and which steps go the other way."""
    facts = []
    for study in results.config.studies:
        labels = factor_labels(study)
        table = results.stiffness_by_level
        rows = table[table["study"] == study.name]
        for (solver, factor), levels in rows.groupby(["solver", "factor"], sort=False):
            label = labels[str(factor)]
            means = ", ".join(
                f"{row.mean_difference_percent:+.1f} % at {row.level:g}"
                for row in levels.itertuples()
            )
            what = f"{label.label} [{label.unit}], study {study.name}, solver {solver}"
            facts.append(Fact(what, f"{means}; {_trend(levels)}", "stiffness_by_level.csv"))
    return facts


def spoke_facts(lines: pd.DataFrame) -> list[Fact]:
    """Say how single spokes differ from table 10: what a tyre of such spokes starts from."""
    compared = lines.dropna(subset=[f"{name}_difference_percent" for name in DIRECTIONS])
    facts = []
    for (study, solver), rows in compared.groupby(["study", "solver"], sort=False):
        parts = [
            f"{name} "
            + ", ".join(
                f"{difference:+.1f} % at {c10:g}"
                for difference, c10 in zip(
                    rows[f"{name}_difference_percent"], rows["spoke_c10_mpa"], strict=True
                )
            )
            for name in DIRECTIONS
        ]
        what = (
            f"Beside this, single spokes against table 10, by spoke C10 [MPa], study {study}, "
            f"solver {solver}"
        )
        facts.append(Fact(what, "; ".join(parts), "spoke_stiffness.csv"))
    return facts


def _trend(levels: pd.DataFrame) -> str:
    """Compare the direction of the step from each level to the next."""
    ours, theirs = (
        levels[f"{kind}_mean_n_per_mm"].to_numpy(float) for kind in ("computed", "published")
    )
    level = levels["level"].to_numpy(float)
    steps = range(len(level) - 1)
    against = [
        f"{level[step]:g} to {level[step + 1]:g} ({ours[step + 1] - ours[step]:+.2f} N/mm, "
        f"published {theirs[step + 1] - theirs[step]:+.2f})"
        for step in steps
        if (ours[step + 1] - ours[step]) * (theirs[step + 1] - theirs[step]) < 0
    ]
    change = (
        f"mean stiffness from lowest to highest level "
        f"{levels['computed_change_percent'].iloc[-1]:+.1f} %, published "
        f"{levels['published_change_percent'].iloc[-1]:+.1f} %"
    )
    if against:
        return f"{change}; steps in the other direction than published: {joined(against)}"
    return f"{change}; every step has the published direction"


def _case_comparison(results: Results, study: Study) -> TableView:
    """Lay the cases of one study out, the solvers beside each other."""
    table = results.compare_published
    rows = table[table["study"] == study.name]
    view, headings = case_comparison(rows, [factor.name for factor in study.factors])
    entry = catalogue.STIFFNESS_AGAINST_PUBLISHED.with_headings(headings)
    return table_view(
        view,
        entry,
        f"Cases of the study {study.name}, published and computed: {study.title}",
        mark=lambda row: "bad" if row["failed"] else "out" if row["calibrated_on"] else "",
        synthetic=_synthetic(results, study, rows),
    )


def case_comparison(
    rows: pd.DataFrame, factors: list[str]
) -> tuple[pd.DataFrame, Mapping[str, Heading]]:
    """Lay one study of ``stiffness_against_published.csv`` out with a row a case.

    Returns
    -------
    table : DataFrame
        The case, its factors and published stiffness; stiffness and difference of each solver;
        ``failed`` and ``calibrated_on`` name solvers.
    headings : mapping of str to Heading
    """
    table = rows.drop_duplicates("case_id").set_index("case_id")[[*factors, PUBLISHED_STIFFNESS]]
    headings = {PUBLISHED_STIFFNESS: Heading("published", "N/mm")}
    failed, calibrated = (pd.Series("", index=table.index) for _ in range(2))
    for solver, of_solver in rows.groupby("solver", sort=False):
        case = of_solver.set_index("case_id")
        table[f"{solver}_computed"] = case[COMPUTED_STIFFNESS]
        table[f"{solver}_{DIFFERENCE}"] = case[DIFFERENCE]
        headings[f"{solver}_computed"] = Heading(str(solver), "N/mm")
        headings[f"{solver}_{DIFFERENCE}"] = Heading(f"{solver} − published", "%")
        failed += (f"{solver}: " + case["status"] + " ").where(case["status"] != "ok", "")
        calibrated += pd.Series(f"{solver} ", case.index).where(case["used_for_calibration"], "")
    table["failed"], table["calibrated_on"] = failed.str.strip(), calibrated.str.strip()
    return table.reset_index(), headings


def _line_blocks(results: Results) -> list[PageBlock]:
    lines = results.neutral_line
    missing = [case_id for case_id in _line_cases(results) if case_id not in set(lines["case_id"])]
    blocks: list[PageBlock] = []
    if missing:
        blocks.append(Text(f"No solver gave a neutral line of {joined(missing)}."))
    return blocks if lines.empty else [*blocks, *_drawn_lines(results)]


def _line_cases(results: Results) -> list[str]:
    """Name the cases whose neutral lines the configuration asks for."""
    return [
        str(row.case_id)
        for study in results.config.studies
        for row in results.designs[study.name].itertuples()
        if row.case in study.neutral_line_cases
    ]


def _drawn_lines(results: Results) -> list[PageBlock]:
    lines = results.neutral_line
    tyre = results.config.tyre
    middle = (tyre.inner_wire_diameter_mm + tyre.outer_wire_diameter_mm) / 4
    plots: list[Plot] = []
    sentences: list[str] = []
    for (study, case_id), rows in lines.groupby(["study", "case_id"], sort=False):
        synthetic = _synthetic(results, results.config.study(str(study)), rows)
        title = f"{case_id}, {rows['load_n'].iloc[0]:g} N"
        for column, label in DISPLACEMENTS.items():
            figure = neutral_lines(rows, column, title, _order(results), synthetic)
            plots.append(plot(figure, f"{label} of {case_id} against θ", synthetic))
        sentences += line_words(rows)
    return [
        Plots(
            "Displacement of the band's neutral line relative to the rim (figure 14 of the "
            "paper), by every solver that computes it. Finite elements: the middle between the "
            f"wire layers, radius {middle:g} mm, all spokes point one way, so that the two sides "
            f"differ; load-bearing model: the ring of radius {tyre.band_radius_mm:g} mm, the same "
            "on both sides.",
            tuple(plots),
        ),
        Listing("What the neutral lines show", tuple(sentences)),
    ]


def line_words(rows: pd.DataFrame) -> list[str]:
    """Say for each solver how deep, how far out and how far along the neutral line goes."""
    sentences = []
    for solver, line in rows.groupby("solver", sort=False):
        inward, outward = (
            line.iloc[place] for place in (line["radial_mm"].argmin(), line["radial_mm"].argmax())
        )
        along = line["tangential_mm"]
        sentences.append(
            f"{solver}, {line['case_id'].iloc[0]}: radially from {inward['radial_mm']:+.2f} mm at "
            f"θ = {inward['theta_deg']:.1f}° to {outward['radial_mm']:+.2f} mm at "
            f"θ = {outward['theta_deg']:.1f}°; tangentially from {along.min():+.2f} to "
            f"{along.max():+.2f} mm."
        )
    return sentences
