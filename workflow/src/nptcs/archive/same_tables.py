"""Compare the tables of two runs of the same study."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd

from nptcs.tables.run_columns import OF_THE_RUN


@dataclass(frozen=True)
class TableDifference:
    """What differs between two tables: `fault` if they cannot be compared."""

    file: str
    rows: int = 0
    largest: float = 0.0
    texts: tuple[str, ...] = ()
    fault: str = ""

    def same(self, within: float) -> bool:
        """Tell whether all texts are equal, and all numbers within a relative difference."""
        return not self.fault and not self.texts and self.largest <= within

    def __str__(self) -> str:
        """Say it in one line."""
        if self.fault:
            return f"{self.file:36} {self.fault}"
        words = "".join(f", text of {name} differs" for name in self.texts)
        return f"{self.file:36} {self.rows:6d} rows, numbers differ by {self.largest:.1e}{words}"


def table_difference(before: pd.DataFrame, after: pd.DataFrame) -> tuple[float, tuple[str, ...]]:
    """Return the largest relative difference of the numbers, and the columns whose text differs.

    Examples
    --------
    >>> one = pd.DataFrame({"a": [1.0, 2.0], "b": ["x", "y"]})
    >>> table_difference(one, one.assign(a=[1.0, 4.0], b=["x", "z"]))
    (0.5, ('b',))
    """
    largest = 0.0
    texts: list[str] = []
    for name in before.columns:
        if _is_number(before[name]) and _is_number(after[name]):
            one, two = (table[name].to_numpy(float) for table in (before, after))
            if (np.isnan(one) != np.isnan(two)).any():
                return np.inf, tuple(texts)
            scale = np.maximum(np.abs(one), np.abs(two))
            with np.errstate(invalid="ignore", divide="ignore"):
                difference = np.where(one == two, 0.0, np.abs(one - two) / scale)
            largest = max(largest, float(np.nan_to_num(difference).max(initial=0.0)))
        elif not before[name].fillna("").equals(after[name].fillna("")):
            texts.append(str(name))
    return largest, tuple(texts)


def _is_number(column: pd.Series[float]) -> bool:
    return pd.api.types.is_numeric_dtype(column) and column.dtype != bool


def compare_folders(
    before: Path,
    after: Path,
    renamed: Mapping[str, str] | None = None,
    columns: Mapping[str, str] | None = None,
    ignored: Collection[str] = OF_THE_RUN,
) -> list[TableDifference]:
    """Compare all CSV tables of two folders, table by table.

    Parameters
    ----------
    before, after : Path
        Folders with tables.
    renamed : mapping of str to str, optional
        Names of tables in `before` that have another name in `after`.
    columns : mapping of str to str, optional
        The same for columns.
    ignored : collection of str
        Columns that are not compared.

    Returns
    -------
    list of TableDifference
        One per table of either folder.
    """
    renamed = renamed or {}
    first = {file.name: file for file in before.glob("*.csv")}
    second = {file.name: file for file in after.glob("*.csv")}
    found = []
    for name in sorted(first):
        other = second.pop(renamed.get(name, name), None)
        if other is None:
            found.append(TableDifference(name, fault=f"is missing in {after}"))
            continue
        tables = [pd.read_csv(path, comment="#") for path in (first[name], other)]
        tables[0] = tables[0].rename(columns=dict(columns or {}))
        one, two = (table.drop(columns=list(ignored), errors="ignore") for table in tables)
        if list(one) != list(two) or len(one) != len(two):
            stray = sorted(map(str, set(one) ^ set(two)))
            found.append(TableDifference(name, fault=f"different columns or rows: {stray}"))
            continue
        found.append(TableDifference(name, len(one), *table_difference(one, two)))
    found += [TableDifference(name, fault=f"is missing in {before}") for name in sorted(second)]
    return found
