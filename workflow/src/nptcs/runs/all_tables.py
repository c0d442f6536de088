"""Every table of two runs: columns, rows and values, also of tables that no other part shows.

Rows are matched by the keys of the table's contract if it has any, and otherwise by their
order. Columns that belong to the run and to the code (`OF_THE_RUN`) are not compared.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd
import pandera.pandas as pa

from nptcs.language import tr
from nptcs.runs.finished import FinishedRun
from nptcs.runs.part import RESULT, Found, Part, part_table, presence
from nptcs.tables.catalogue import result_files
from nptcs.tables.result_table import Heading
from nptcs.tables.run_columns import OF_THE_RUN

COLUMNS = (
    "file",
    "rows_a",
    "rows_b",
    "rows_only_a",
    "rows_only_b",
    "largest_relative_difference",
    "largest_in",
    "numbers_missing_in_one",
    "texts_that_differ",
    "columns_only_a",
    "columns_only_b",
    "note",
)
HEADINGS = {"largest_relative_difference": Heading("largest relative difference")}


def compare_tables(a: FinishedRun, b: FinishedRun, within: float) -> Part:
    """Compare all tables of two runs, one row per table of either."""
    contracts = {**_contracts(a), **_contracts(b)}
    rows = [
        {"file": file, **_compare(a.table(file), b.table(file), contracts.get(file), within)}
        for file in sorted({*a.tables, *b.tables})
    ]
    return Part(
        "all_tables",
        tr("Every table"),
        tr(
            "Largest |B − A| / max(|A|, |B|) of any number; columns in which a number is missing "
            "in only one of the runs are named. Not compared: {columns}.",
            columns=", ".join(OF_THE_RUN),
        ),
        part_table(rows, COLUMNS),
        headings=dict(HEADINGS),
    )


def _contracts(run: FinishedRun) -> dict[str, type[pa.DataFrameModel]]:
    studies = [name for name, study in run.studies.items() if study.get("terms")]
    return {file: row.contract for file, row, _ in result_files(studies)}


def _compare(
    one: pd.DataFrame | None,
    two: pd.DataFrame | None,
    contract: type[pa.DataFrameModel] | None,
    within: float,
) -> dict[str, object]:
    row: dict[str, object] = {
        "rows_a": None if one is None else len(one),
        "rows_b": None if two is None else len(two),
    }
    if one is None or two is None:
        return {**row, RESULT: presence(one is not None, two is not None)}
    tables = [table.drop(columns=list(OF_THE_RUN), errors="ignore") for table in (one, two)]
    return {**row, **_compare_both(tables[0], tables[1], contract, within)}


def _compare_both(
    one: pd.DataFrame,
    two: pd.DataFrame,
    contract: type[pa.DataFrameModel] | None,
    within: float,
) -> dict[str, object]:
    """Compare a table that both runs have: its columns, its rows, and the values they share."""
    shared = [name for name in one if name in two]
    pair, alone, note = _aligned(one[shared], two[shared], _keys(contract, shared))
    row: dict[str, object] = {
        "columns_only_a": ", ".join(str(name) for name in one if name not in two),
        "columns_only_b": ", ".join(str(name) for name in two if name not in one),
        "rows_only_a": alone[0],
        "rows_only_b": alone[1],
        "note": note,
    }
    if pair is None:
        return {**row, RESULT: Found.NOT_COMPARED}
    largest, place, missing, texts = _values(*pair)
    row |= {"largest_relative_difference": largest, "largest_in": place}
    row |= {"numbers_missing_in_one": ", ".join(missing), "texts_that_differ": ", ".join(texts)}
    stray = len(shared) < max(one.shape[1], two.shape[1])
    differs = largest > within or missing or texts or any(alone) or stray
    return {**row, RESULT: Found.DIFFERENT if differs else Found.SAME}


def _keys(contract: type[pa.DataFrameModel] | None, shared: list[Any]) -> list[str]:
    """Return the columns that tell the rows of a table apart; none if the contract has none."""
    if contract is None:
        return []
    schema = contract.to_schema()
    unique = schema.unique or [name for name, col in schema.columns.items() if col.unique][:1]
    return list(unique) if set(unique) <= set(shared) else []


Pair = tuple[pd.DataFrame, pd.DataFrame]


def _aligned(
    one: pd.DataFrame, two: pd.DataFrame, keys: list[str]
) -> tuple[Pair | None, tuple[int, int], str]:
    """Match the rows of two tables; return the matched rows and how many have no partner."""
    if keys:
        first, second = (_indexed(table, keys) for table in (one, two))
        if first.index.is_unique and second.index.is_unique:
            both = first.index.intersection(second.index, sort=False)
            alone = len(first) - len(both), len(second) - len(both)
            return (first.loc[both], second.loc[both]), alone, ""
    if len(one) == len(two):
        rows = one.reset_index(drop=True), two.reset_index(drop=True)
        return rows, (0, 0), tr("rows matched by their order")
    for count in range(1, len(one.columns) + 1):
        leading = [str(name) for name in one.columns[:count]]
        first, second = (_indexed(table, leading) for table in (one, two))
        if first.index.is_unique and second.index.is_unique:
            pair, alone, _ = _aligned(one, two, leading)
            return pair, alone, tr("rows matched by {columns}", columns=", ".join(leading))
    return None, (0, 0), tr("equal rows cannot be told apart, and their counts differ")


def _indexed(table: pd.DataFrame, keys: list[str]) -> pd.DataFrame:
    index = pd.MultiIndex.from_frame(table[keys].astype(str))
    return table.set_axis(index, axis=0)


def _values(one: pd.DataFrame, two: pd.DataFrame) -> tuple[float, str, list[str], list[str]]:
    """Return the largest relative difference of numbers and its column, and two lists of columns.

    Those in which a number is missing in only one table, and those whose texts differ.
    """
    largest, place = 0.0, ""
    missing: list[str] = []
    texts: list[str] = []
    for name in map(str, one.columns):
        first, second = one[name], two[name]
        if _is_number(first) and _is_number(second):
            numbers = first.to_numpy(float), second.to_numpy(float)
            if (np.isnan(numbers[0]) != np.isnan(numbers[1])).any():
                missing.append(name)
            if (found := largest_difference(*numbers)) > largest:
                largest, place = found, name
        elif _texts(first) != _texts(second):
            texts.append(name)
    return largest, place, missing, texts


def _texts(column: pd.Series[Any]) -> list[str]:
    """Return the values of a column as text; a missing value is an empty text."""
    return ["" if pd.isna(value) else str(value) for value in column]


def largest_difference(one: Any, two: Any) -> float:
    """Return the largest relative difference of two arrays of shape (m,), where both have numbers.

    Examples
    --------
    >>> import numpy as np
    >>> largest_difference(np.array([1.0, 2.0, np.nan]), np.array([1.0, 4.0, 3.0]))
    0.5
    """
    scale = np.maximum(np.abs(one), np.abs(two))
    with np.errstate(invalid="ignore", divide="ignore"):
        difference = np.where(one == two, 0.0, np.abs(one - two) / scale)
    return float(np.nan_to_num(difference, nan=0.0).max(initial=0.0))


def _is_number(column: pd.Series[Any]) -> bool:
    return pd.api.types.is_numeric_dtype(column) and column.dtype != bool


def described(part: Part) -> Mapping[str, str]:
    """Say how each table differs, by its file."""
    found = {}
    for row in part.differences.to_dict("records"):
        if row[RESULT] != Found.DIFFERENT:
            found[str(row["file"])] = str(row[RESULT])
            continue
        words = [
            f"numbers by up to {row['largest_relative_difference']:.1e} ({row['largest_in']})"
            if row["largest_in"]
            else "",
            f"text of {row['texts_that_differ']}" if row["texts_that_differ"] else "",
            f"numbers missing in one run: {row['numbers_missing_in_one']}"
            if row["numbers_missing_in_one"]
            else "",
            f"rows only in A: {row['rows_only_a']:.0f}" if row["rows_only_a"] else "",
            f"rows only in B: {row['rows_only_b']:.0f}" if row["rows_only_b"] else "",
            f"columns only in A: {row['columns_only_a']}" if row["columns_only_a"] else "",
            f"columns only in B: {row['columns_only_b']}" if row["columns_only_b"] else "",
        ]
        found[str(row["file"])] = "; ".join(filter(None, words))
    return found
