"""The comparison of two runs as one HTML page that needs no network and no other file."""

from __future__ import annotations

from dataclasses import replace
from importlib import resources

import pandas as pd
from markupsafe import Markup

from nptcs.language import current_language, tr
from nptcs.report.blocks import TableView
from nptcs.report.comparison.parts import TITLE, mark_row, part_sheet
from nptcs.report.page_templates import page_environment
from nptcs.report.table_view import table_view
from nptcs.runs.compare import ComparedRuns
from nptcs.runs.part import Part

MOST_ROWS = 200
"""Rows of a table that the page shows."""
CHECKSUM_DIGITS = 12
"""Digits of a checksum that the page shows, as of the identity of a run."""


def comparison_page(done: ComparedRuns) -> str:
    """Write the comparison of two runs as one HTML page.

    Parameters
    ----------
    done : ComparedRuns

    Returns
    -------
    str
        HTML text in the style of the report and in the current language, which is that of the
        comparison's sentences; the same comparison gives the same page.
    """
    return (
        page_environment()
        .get_template("comparison.html.j2")
        .render(
            title=tr(TITLE),
            language=current_language(),
            done=done,
            parts=[(part, differing(part, done.synthetic)) for part in done.parts],
            style=_resource("report.css"),
            script=_resource("page.js"),
        )
    )


def differing(part: Part, synthetic: bool) -> TableView | None:
    """Return the rows of a part that differ; none if there are none."""
    sheet = part_sheet(part, synthetic)
    rows = sheet.table.loc[part.differences.index]
    if rows.empty:
        return None
    shown = shortened(rows.iloc[:MOST_ROWS])
    view = table_view(shown, sheet.entry, mark=mark_row, whole=True)
    return replace(view, synthetic=synthetic, all_rows=len(rows))


def shortened(rows: pd.DataFrame) -> pd.DataFrame:
    """Cut checksums to their first digits, which tell files apart; the workbook has all of them."""
    checksums = [name for name in rows.columns if name.startswith("sha256")]
    return rows.assign(**{name: rows[name].str[:CHECKSUM_DIGITS] for name in checksums})


def _resource(name: str) -> Markup:
    return Markup(resources.files("nptcs.report").joinpath("templates", name).read_text("utf-8"))
