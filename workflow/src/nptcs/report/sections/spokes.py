"""Section of the report on the single spoke: figure 13 and table 10 of the paper."""

from __future__ import annotations

import numpy as np
import pandas as pd

from nptcs.language import tr
from nptcs.report.blocks import PageBlock, Plot, Plots, Section, Text
from nptcs.report.data import Results
from nptcs.report.figures.spoke import force_displacement
from nptcs.report.plots import plot
from nptcs.report.sections.ply import ply_words
from nptcs.report.table_view import sheet_view
from nptcs.report.tables.sheets import Sheets, sheet_of
from nptcs.tables.result_table import ReportSection
from nptcs.tables.tyres.spoke_stiffness import DIRECTIONS, SpokeCurves, SpokeLines

SHOWN = [
    "case_id",
    "solver",
    "spoke_c10_mpa",
    "status",
    *(
        name
        for direction in DIRECTIONS
        for name in (
            f"{direction}_stiffness_n_per_mm",
            f"published_{direction}_stiffness_n_per_mm",
            f"{direction}_difference_percent",
            f"{direction}_r2_uncentred",
            f"{direction}_r2_centred",
            f"published_{direction}_r2",
        )
    ),
]


def spoke_section(results: Results, sheets: Sheets) -> Section:
    """Build the section."""
    lines = results.table(SpokeLines)
    if lines.empty:
        nothing = tr("No study of the configuration computes single spokes.")
        return Section(ReportSection.SPOKE, tr("Single spoke"), (Text(nothing),))
    sheet = sheet_of(sheets, SpokeLines)
    blocks: list[PageBlock] = [
        Text(
            tr(
                "One spoke, clamped at the rim; its foot at the band is moved along the radius "
                "and neither slides nor turns (section 4.3.1 of the paper). The stiffness is the "
                "slope of the line through the origin over all points of the curve. R² is given "
                "in both conventions, uncentred as software prints it for a line without "
                "intercept, and centred; the paper does not say which one it uses. "
            )
            + ply_words(results)
        ),
        *(Text(words) for words in what_differs(lines)),
        Plots(
            tr(
                "Force on one spoke against its displacement (figure 13 of the paper). "
                "Full lines are computed, dashed ones their lines through the origin; a "
                "hollow mark is where the line of table 10 ends. The paper draws its "
                "curves without numbers."
            ),
            tuple(_plots(results)),
        ),
        sheet_view(sheet, SHOWN),
    ]
    title = tr("Single spoke (section 4.3.1) against the paper")
    return Section(ReportSection.SPOKE, title, tuple(blocks), sheet.synthetic)


def _plots(results: Results) -> list[Plot]:
    plots = []
    for (study, solver), curves in results.table(SpokeCurves).groupby(
        ["study", "solver"], sort=False
    ):
        lines = results.table(SpokeLines)
        lines = lines[(lines["study"] == study) & (lines["solver"] == solver)]
        synthetic = results.study_is_synthetic(results.config.study(str(study)), str(solver))
        for direction in DIRECTIONS:
            alt = tr(
                "Force on a spoke in {direction} by {solver}, study {study}",
                direction=tr(direction),
                solver=solver,
                study=study,
            )
            given = (curves, lines, direction, synthetic)
            plots.append(plot(alt, synthetic, force_displacement, *given))
    return plots


def what_differs(lines: pd.DataFrame) -> list[str]:
    """Say in words how each solver's spokes differ from table 10."""
    compared = lines.dropna(subset=[f"{direction}_difference_percent" for direction in DIRECTIONS])
    return [
        tr("{solver} (study {study}) against table 10. ", solver=solver, study=study)
        + " ".join(_of_direction(rows.sort_values("spoke_c10_mpa"), name) for name in DIRECTIONS)
        for (study, solver), rows in compared.groupby(["study", "solver"], sort=False)
    ]


def _of_direction(rows: pd.DataFrame, direction: str) -> str:
    stiffness = f"{direction}_stiffness_n_per_mm"
    difference = rows[f"{direction}_difference_percent"]
    worst = rows.iloc[int(difference.abs().argmax())]
    text = tr(
        "The {direction} stiffness differs by {lowest:+.1f} to {highest:+.1f} %, "
        "most at C10 = {spoke_c10_mpa:g} MPa",
        direction=tr(direction),
        lowest=difference.min(),
        highest=difference.max(),
        spoke_c10_mpa=worst["spoke_c10_mpa"],
    )
    first, last = rows.iloc[0], rows.iloc[-1]
    if len(rows) > 1:
        text += tr(
            "; from C10 = {spoke_c10_mpa:g} to {spoke_c10_mpa_2:g} MPa it grows "
            "{last:.2f} times (table 10: {published:.2f} times)",
            spoke_c10_mpa=first["spoke_c10_mpa"],
            spoke_c10_mpa_2=last["spoke_c10_mpa"],
            last=last[stiffness] / first[stiffness],
            published=last[f"published_{stiffness}"] / first[f"published_{stiffness}"],
        )
    published = rows[f"published_{direction}_r2"]
    if published.isna().any():
        return text + "."
    computed = {kind: rows[f"{direction}_r2_{kind}"] for kind in ("uncentred", "centred")}
    nearer = min(computed, key=lambda kind: float(np.abs(computed[kind] - published).mean()))
    spans = ", ".join(f"{tr(kind)} {_span(values)}" for kind, values in computed.items())
    return tr(
        "{value}. R² is {spans}; printed {span}, nearer to the {nearer} one.",
        value=text,
        spans=spans,
        span=_span(published),
        nearer=tr(nearer),
    )


def _span(values: pd.Series[float]) -> str:
    low, high = f"{values.min():.4f}", f"{values.max():.4f}"
    return low if low == high else f"{low} … {high}"
