"""The comparison of two runs as one HTML page that needs no network and no other file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from importlib import resources

import pandas as pd
from markupsafe import Markup

from nptcs.language import current_language, tr
from nptcs.report.blocks import TableView
from nptcs.report.comparison.parts import TITLE, cell_kind, mark_row, part_sheet
from nptcs.report.page_templates import page_environment
from nptcs.report.table_view import table_view
from nptcs.report.tables.headings import heading
from nptcs.report.tables.names import known_in_words
from nptcs.runs.compare import ComparedRuns
from nptcs.runs.part import Part
from nptcs.tables.result_table import Heading

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
            parts=[(part, differing(part, done.synthetic, done.factors)) for part in done.parts],
            in_words=partial(known_in_words, labels=names_in_sentences(done)),
            style=_resource("report.css"),
            script=_resource("page.js"),
        )
    )


def names_in_sentences(done: ComparedRuns) -> dict[str, Heading]:
    """Return how factors and material constants are written in a sentence."""
    constants = done.part("constants").table["constant"]
    return {**{name: heading(name) for name in constants}, **done.factors}


def differing(part: Part, synthetic: bool, factors: Mapping[str, Heading]) -> TableView | None:
    """Return the rows of a part that differ, with the factors' labels; none if there are none."""
    sheet = part_sheet(part, synthetic)
    rows = sheet.table.loc[part.differences.index]
    if rows.empty:
        return None
    shown = shortened(rows.iloc[:MOST_ROWS])
    entry = sheet.entry.with_factors(factors)
    view = table_view(shown, entry, mark=mark_row, whole=True, kind=cell_kind)
    return replace(view, synthetic=synthetic, all_rows=len(rows))


def shortened(rows: pd.DataFrame) -> pd.DataFrame:
    """Cut checksums to their first digits, which tell files apart; the workbook has all of them."""
    checksums = [name for name in rows.columns if name.startswith("sha256")]
    return rows.assign(**{name: rows[name].str[:CHECKSUM_DIGITS] for name in checksums})


def _resource(name: str) -> Markup:
    return Markup(resources.files("nptcs.report").joinpath("templates", name).read_text("utf-8"))
