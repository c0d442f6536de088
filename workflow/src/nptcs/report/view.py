"""What the page template is handed: tables of finished text, figures as data URIs."""

from __future__ import annotations

import base64
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from nptcs.report.figures.style import to_svg
from nptcs.report.tables import row_classes as marks
from nptcs.report.tables.catalogue import Entry
from nptcs.report.tables.headings import Heading, heading
from nptcs.report.tables.row_classes import RowClass
from nptcs.report.tables.sheets import Sheet

DIGITS = 5
"""Significant digits of numbers in the report; the CSV files and the workbook have all."""

LONG = 60
"""Characters beyond which a text may wrap."""

FEWER_DIGITS = {
    "standard_error": 3,
    "standard_error_mpa": 3,
    "standard_deviation": 3,
    "cv_percent": 3,
    "mnr": 4,
    "mnr_critical": 4,
    "rmse_mpa": 3,
    "largest_error_percent": 3,
    "balance_residual": 2,
    "condition_number_natural": 3,
    "condition_number_coded": 3,
    "wall_time_s": 3,
    "mean_percent": 3,
    "mean_absolute_percent": 3,
    "largest_percent": 3,
}
"""Columns whose digits beyond these mean nothing."""

PERCENTS = ("difference_percent", "change_percent")
"""Endings of columns that have three digits as well."""


@dataclass(frozen=True)
class Cell:
    """One cell: its text, the full number behind it for sorting, and its CSS class."""

    text: str
    number: str = ""

    @property
    def css(self) -> str:
        """Tell how the cell is set."""
        if self.number or self.text == "–":
            return "number"
        if len(self.text) == 64 and set(self.text) <= set("0123456789abcdef"):
            return "hash"
        return "long" if len(self.text) > LONG else ""


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

    @property
    def css(self) -> str:
        """Two panels a row where three would leave one alone."""
        return "panels two" if len(self.plots) in (2, 4) else "panels"


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
class Fact:
    """One result in words: what, the result, the table that holds it."""

    what: str
    result: str
    source: str


@dataclass(frozen=True)
class Facts:
    """Results in words, set so that a phone shows them whole."""

    title: str
    facts: tuple[Fact, ...]


@dataclass(frozen=True)
class Folded:
    """Long text that opens on demand, such as the configuration."""

    title: str
    text: str


PageBlock = TableView | Plots | Text | Listing | Facts | Folded


@dataclass(frozen=True)
class Section:
    """One numbered section of the page."""

    identifier: str
    title: str
    blocks: tuple[PageBlock, ...]
    synthetic: bool = False


def number_text(value: float, digits: int = DIGITS) -> str:
    """Write a number to some significant digits; digits before the point are never dropped."""
    if not math.isfinite(value):
        return "–" if math.isnan(value) else str(value)
    if float(value).is_integer() and abs(value) < 1e15:
        return str(int(value))
    text = f"{value:.{digits}g}"
    return f"{value:.0f}" if "e+" in text and abs(value) < 1e9 else text


def table_view(
    table: pd.DataFrame,
    entry: Entry,
    caption: str = "",
    columns: Sequence[str] | None = None,
    given_digits: Mapping[str, int] | None = None,
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
        Columns that are shown, all by default; a column without any value is not shown.
    given_digits : mapping of str to int, optional
        Significant digits of columns that need other than `DIGITS` and `FEWER_DIGITS`.
    mark : callable
        Gives a row's CSS class, such as ``bad`` or ``out``.
    synthetic : bool
        Whether it shows synthetic data.
    """
    shown = [name for name in columns or map(str, table.columns) if not _is_empty(table[name])]
    digits = {**FEWER_DIGITS, **{name: 3 for name in shown if name.endswith(PERCENTS)}}
    digits |= given_digits or {}
    numeric = tuple(_is_numeric(table[name]) for name in shown)
    rows = []
    for record in table.to_dict("records"):
        cells = tuple(
            _cell(record[name], digits.get(name, DIGITS), is_number)
            for name, is_number in zip(shown, numeric, strict=True)
        )
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
    sheet: Sheet,
    columns: Sequence[str] | None = None,
    given_digits: Mapping[str, int] | None = None,
) -> TableView:
    """Lay one of the workbook's tables out for the page; arguments as in `table_view`."""
    return table_view(
        sheet.table,
        sheet.entry,
        columns=columns,
        given_digits=given_digits,
        mark=sheet.mark,
        synthetic=sheet.synthetic,
    )


def _is_numeric(column: pd.Series) -> bool:
    """Tell whether a column holds numbers, and no truth values."""
    types = pd.api.types
    return types.is_numeric_dtype(column) and not types.is_bool_dtype(column)


def _is_empty(column: pd.Series) -> bool:
    """Tell whether a column of a table with rows has no value at all."""
    return len(column) > 0 and bool((column.isna() | (column.astype(str) == "")).all())


def _cell(value: object, digits: int, is_number: bool) -> Cell:
    """Write one value; `is_number` tells whether its column holds numbers."""
    if value is None or value is pd.NA:
        return Cell("–" if is_number else "")
    if isinstance(value, bool | np.bool_):
        return Cell("yes" if value else "no")
    if isinstance(value, int | float | np.integer | np.floating):
        number = float(value)
        return Cell(number_text(number, digits), "" if math.isnan(number) else repr(number))
    return Cell(str(value))


def plot(figure: Figure, alt: str, synthetic: bool = False) -> Plot:
    """Turn a figure into a data URI."""
    width, height = figure.get_size_inches()
    data = base64.b64encode(to_svg(figure).encode("utf-8")).decode("ascii")
    return Plot(
        f"data:image/svg+xml;base64,{data}", alt, round(96 * width), round(96 * height), synthetic
    )


def with_error(value: float, error: float | None, unit: str = "1") -> str:
    """Write a value and its standard error to the error's second significant digit."""
    suffix = "" if unit == "1" else f" {unit}"
    if error is None or not error > 0:
        return f"{value:.4g}{suffix}"
    decimals = 1 - math.floor(math.log10(error))
    shown = max(0, decimals)
    return f"{round(value, decimals):.{shown}f} ± {round(error, decimals):.{shown}f}{suffix}"


def joined(words: Iterable[str]) -> str:
    """Join words as ``a, b and c``."""
    parts = list(words)
    if len(parts) < 2:
        return "".join(parts)
    return ", ".join(parts[:-1]) + " and " + parts[-1]
