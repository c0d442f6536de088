"""Write a table for the page: digits, headings, row classes; nothing is computed."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

from nptcs.language import tr
from nptcs.report.blocks import LONG, Cell, TableView
from nptcs.report.tables.column_words import column_words
from nptcs.report.tables.entries import Entry
from nptcs.report.tables.headings import heading
from nptcs.report.tables.names import in_headings, in_symbols, in_words, known_in_words
from nptcs.report.tables.row_classes import RowClass, no_row
from nptcs.report.tables.sheets import Sheet
from nptcs.report.text import DIGITS, number_text, rounded

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
"""Significant digits of columns in which more would mean nothing."""

PERCENTS = ("difference_percent", "change_percent")
"""Endings of the names of further columns that get three digits."""


TERMS = ("dropped", "form", "not_fitted", "source", "term")
"""Columns that hold terms of polynomials: the page writes them with the factors' symbols."""

UNCERTAIN_BY = {
    "standard_error": ("value",),
    "standard_error_mpa": ("c10_mpa",),
    "standard_deviation": ("mean", "median", "ci95_low", "ci95_high", "b_basis"),
    "sd": ("nominal", "mean", "low", "high"),
}
"""Column of an uncertainty, and the columns written to its second significant digit."""

WITH_NAMES = frozenset(
    {
        *("design", "factor", "factors", "goal", "goals", "held", "near_tie_with", "partner"),
        *("point", "property", "properties", "quantities", "realised_factors", "response", "rule"),
        "level_out_not_fitted",
    }
)
"""Columns that hold names of factors, properties, responses and rules, alone or in a text."""

COLUMN_NAMES = "names of columns"
"""Kind of a column that holds names of columns with commas between them."""

SENTENCE = "sentence"
"""Kind of a column that holds sentences which may name factors, and files and specimens too."""

WRITERS = {
    **dict.fromkeys(WITH_NAMES, in_words),
    **dict.fromkeys(TERMS, in_symbols),
    COLUMN_NAMES: in_headings,
    SENTENCE: known_in_words,
}
"""How the names in a column are written, by the kind of the column."""

Kind = Callable[[str, Mapping[str, object]], str]


def own_kind(column: str, record: Mapping[str, object]) -> str:
    """Return the kind of a column of the report: its name."""
    return column


WHOLE_ROWS = 24
"""Rows of the longest table that the page shows in full; the CSV file has all rows."""

PAGE_ROWS = 12
"""Rows of a longer table that the page shows."""

MOST_MARKED = 3000
"""Rows of a long table that are searched for marks."""


def table_view(
    table: pd.DataFrame,
    entry: Entry,
    caption: str = "",
    columns: Sequence[str] | None = None,
    given_digits: Mapping[str, int] | None = None,
    mark: RowClass = no_row,
    synthetic: bool = False,
    whole: bool = False,
    kind: Kind = own_kind,
) -> TableView:
    """Write a table for the page.

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
    whole : bool
        Whether all rows are shown, of a long table too.
    kind : callable
        Names, for a column and a row, the column of the report whose words it holds.
    """
    filled = [name for name in columns or map(str, table.columns) if not _is_empty(table[name])]
    shared = [name for name in filled if _is_one_text(table[name])]
    shown = _columns(table, [name for name in filled if name not in shared], given_digits or {})
    rows = []
    for record in (table if whole else on_page(table, mark)).to_dict("records"):
        named = {str(key): value for key, value in record.items()}
        cells = (_written(one, named, entry, kind(one.name, named)) for one in shown)
        rows.append((mark(named), tuple(cells)))
    return TableView(
        entry,
        caption or tr(entry.title),
        tuple(heading(column.name, entry.headings) for column in shown),
        tuple(column.is_number for column in shown),
        tuple(rows),
        synthetic,
        len(table),
        tuple(column.name for column in shown),
        notes=tuple(_note(name, table, entry, kind) for name in shared),
    )


@dataclass(frozen=True)
class _Column:
    """How one column is written; `error` names the column with the uncertainty of its values."""

    name: str
    is_number: bool
    digits: int
    error: str


def _columns(
    table: pd.DataFrame, names: Sequence[str], given_digits: Mapping[str, int]
) -> list[_Column]:
    """Decide how each of these columns is written."""
    percents = {name: 3 for name in names if name.endswith(PERCENTS)}
    digits = {**FEWER_DIGITS, **percents, **given_digits}
    return [
        _Column(
            name,
            _is_numeric(table[name]),
            digits.get(name, DIGITS),
            "" if name in digits else _error_column(name, table),
        )
        for name in names
    ]


def _written(column: _Column, record: Mapping[str, object], entry: Entry, kind: str) -> Cell:
    """Write one cell: a name in words, or a value."""
    value = record[column.name]
    if kind in WRITERS and not column.is_number:
        return _named(kind, value, entry)
    error = record.get(column.error)
    return _cell(column_words(kind, value), column.digits, column.is_number, error)


def _note(column: str, table: pd.DataFrame, entry: Entry, kind: Kind) -> str:
    """Write the text that all rows of a column share."""
    record = {str(name): value for name, value in table.iloc[0].items()}
    of_kind = kind(column, record)
    cell = _written(_Column(column, False, DIGITS, ""), record, entry, of_kind)
    return f"{heading(column, entry.headings).name}: {cell.text}"


def on_page(table: pd.DataFrame, mark: RowClass) -> pd.DataFrame:
    """Select the rows of a table that the page shows: all, or the first ones and those that failed.

    Of a table with more than `WHOLE_ROWS` rows these are the first `PAGE_ROWS`, then at most as
    many others that are marked as bad or flagged.
    """
    if len(table) <= WHOLE_ROWS:
        return table
    first, rest = table.iloc[:PAGE_ROWS], table.iloc[PAGE_ROWS:]
    if "status" in rest:
        rest = rest[rest["status"] != "ok"]
    records = rest.iloc[:MOST_MARKED].to_dict("records")
    marked = [
        place
        for place, record in enumerate(records)
        if mark({str(key): value for key, value in record.items()}) in ("bad", "warn")
    ]
    return pd.concat([first, rest.iloc[marked[:PAGE_ROWS]]])


def sheet_view(
    sheet: Sheet,
    columns: Sequence[str] | None = None,
    given_digits: Mapping[str, int] | None = None,
    whole: bool = False,
) -> TableView:
    """Write one of the workbook's tables for the page; arguments as in `table_view`."""
    return table_view(
        sheet.table,
        sheet.entry,
        columns=columns,
        given_digits=given_digits,
        mark=sheet.mark,
        synthetic=sheet.synthetic,
        whole=whole,
    )


def _is_numeric(column: pd.Series) -> bool:
    """Tell whether a column contains numbers, not truth values."""
    types = pd.api.types
    return types.is_numeric_dtype(column) and not types.is_bool_dtype(column)


def _is_empty(column: pd.Series) -> bool:
    """Tell whether a column of a table with rows has no value at all."""
    if not len(column) or not (pd.isna(column.iloc[0]) or column.iloc[0] == ""):
        return False
    return bool((column.isna() | (column == "")).all())


def _is_one_text(column: pd.Series) -> bool:
    """Tell whether all rows of a column have the same long text, which is then written once."""
    if len(column) < 2 or _is_numeric(column) or not isinstance(column.iloc[0], str):
        return False
    return len(column.iloc[0]) > LONG and bool(column.eq(column.iloc[0]).all())


def _error_column(name: str, table: pd.DataFrame) -> str:
    """Name the column that says how uncertain another one is; empty where none does."""
    found = [error for error, values in UNCERTAIN_BY.items() if name in values and error in table]
    return found[0] if found else ""


def _named(kind: str, value: object, entry: Entry) -> Cell:
    """Write a text with the names that people use; the names in the file come on hover."""
    text = "" if value is None or value is pd.NA else str(column_words(kind, value))
    words_of_it = WRITERS[kind](text, entry.factors)
    return Cell(words_of_it, name_in_file="" if words_of_it == text else text)


def _cell(value: object, digits: int, is_number: bool, error: object = None) -> Cell:
    """Write one value.

    `is_number` tells whether its column holds numbers, `error` how uncertain the value is.
    """
    if value is None or value is pd.NA:
        return Cell("–" if is_number else "")
    if isinstance(value, bool | np.bool_):
        return Cell(tr("yes") if value else tr("no"))
    if isinstance(value, int | float | np.integer | np.floating):
        number = float(value)
        if isinstance(error, float) and 0 < error < math.inf and math.isfinite(number):
            return Cell(rounded(number, error), repr(number))
        return Cell(number_text(number, digits), "" if math.isnan(number) else repr(number))
    return Cell(str(value))
