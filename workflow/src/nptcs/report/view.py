"""What the page template is handed: tables of finished text, figures as data URIs."""

from __future__ import annotations

import base64
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from nptcs.report import marks
from nptcs.report.catalogue import Entry
from nptcs.report.marks import RowClass
from nptcs.report.sheets import Sheet
from nptcs.report.style import to_svg
from nptcs.report.units import Heading, heading

DIGITS = 6
"""Significant digits of numbers in the report; the CSV files and the workbook have all."""


@dataclass(frozen=True)
class Cell:
    """One cell: its text, and the full number behind it for sorting."""

    text: str
    number: str = ""


@dataclass(frozen=True)
class TableView:
    """One table of the page."""

    entry: Entry
    caption: str
    headings: tuple[Heading, ...]
    numeric: tuple[bool, ...]
    rows: tuple[tuple[str, tuple[Cell, ...]], ...]
    synthetic: bool = False


@dataclass(frozen=True)
class Plot:
    """One figure of the page, as a data URI, with words for those who cannot see it."""

    uri: str
    alt: str
    width_px: int
    height_px: int
    synthetic: bool = False


@dataclass(frozen=True)
class Plots:
    """Figures side by side under one caption."""

    caption: str
    plots: tuple[Plot, ...]

    @property
    def synthetic(self) -> bool:
        """True if any of them shows synthetic data."""
        return any(plot.synthetic for plot in self.plots)


@dataclass(frozen=True)
class Text:
    """A paragraph; `kind` is empty or one of ok, bad, warn, head."""

    text: str
    kind: str = ""


@dataclass(frozen=True)
class Listing:
    """A list of remarks under a line of words."""

    lead: str
    items: tuple[str, ...]
    kind: str = ""


@dataclass(frozen=True)
class Folded:
    """Long text that opens on demand, such as the configuration."""

    title: str
    text: str


Block = TableView | Plots | Text | Listing | Folded


@dataclass(frozen=True)
class Section:
    """One numbered section of the page."""

    identifier: str
    title: str
    blocks: tuple[Block, ...]
    synthetic: bool = False


def number_text(value: float, digits: int = DIGITS) -> str:
    """Write a number to some significant digits; whole numbers in full, no value as a dash."""
    if not math.isfinite(value):
        return "–" if math.isnan(value) else str(value)
    if float(value).is_integer() and abs(value) < 1e15:
        return str(int(value))
    return f"{value:.{digits}g}"


def table_view(
    table: pd.DataFrame,
    entry: Entry,
    caption: str = "",
    columns: Sequence[str] | None = None,
    digits: Mapping[str, int] | None = None,
    mark: RowClass = marks.nothing,
    synthetic: bool = False,
) -> TableView:
    """Lay a table out for the page.

    Parameters
    ----------
    table : DataFrame
        Finished values.
    entry : Entry
        Where the table is kept and which rule made it.
    caption : str
        Words above the table; the entry's title by default.
    columns : sequence of str, optional
        Columns that are shown, all by default.
    digits : mapping of str to int, optional
        Significant digits of columns that need other than `DIGITS`.
    mark : callable
        Gives a row's CSS class, such as ``bad`` or ``out``.
    synthetic : bool
        Whether it shows synthetic data.
    """
    shown = list(columns or table.columns)
    table = table[shown].reset_index(drop=True)
    digits = digits or {}
    numeric = tuple(pd.api.types.is_numeric_dtype(table[name]) for name in shown)
    rows = []
    for record in table.to_dict("records"):
        cells = tuple(_cell(record[name], digits.get(name, DIGITS)) for name in shown)
        rows.append((mark({str(key): value for key, value in record.items()}), cells))
    return TableView(
        entry,
        caption or entry.title,
        tuple(heading(name, entry.headings) for name in shown),
        numeric,
        tuple(rows),
        synthetic,
    )


def sheet_view(
    sheet: Sheet, columns: Sequence[str] | None = None, digits: Mapping[str, int] | None = None
) -> TableView:
    """Lay one of the workbook's tables out for the page; arguments as in `table_view`."""
    return table_view(
        sheet.table,
        sheet.entry,
        columns=columns,
        digits=digits,
        mark=sheet.mark,
        synthetic=sheet.synthetic,
    )


def _cell(value: object, digits: int) -> Cell:
    """Write one value."""
    if isinstance(value, bool | np.bool_):
        return Cell("yes" if value else "no")
    if isinstance(value, int | float | np.integer | np.floating):
        number = float(value)
        return Cell(number_text(number, digits), "" if math.isnan(number) else repr(number))
    return Cell("" if value is None else str(value))


def plot(figure: Figure, alt: str, synthetic: bool = False) -> Plot:
    """Turn a figure into a data URI."""
    width, height = figure.get_size_inches()
    data = base64.b64encode(to_svg(figure).encode("utf-8")).decode("ascii")
    return Plot(
        f"data:image/svg+xml;base64,{data}", alt, round(96 * width), round(96 * height), synthetic
    )


def joined(words: Iterable[str]) -> str:
    """Join words as ``a, b and c``."""
    parts = list(words)
    if len(parts) < 2:
        return "".join(parts)
    return ", ".join(parts[:-1]) + " and " + parts[-1]
