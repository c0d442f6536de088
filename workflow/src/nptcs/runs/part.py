"""One part of a comparison: a table with one row per item compared, and what is said about it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any, assert_never

import numpy as np
import pandas as pd

from nptcs.language import tr
from nptcs.tables.result_table import Heading

RESULT = "result"
"""Column that says what was found for each row."""


class Found(StrEnum):
    """What comparing one item of two runs has found."""

    SAME = "same"
    DIFFERENT = "different"
    ONLY_A = "only in A"
    ONLY_B = "only in B"
    NOT_COMPARED = "not comparable"


@dataclass(frozen=True)
class Part:
    """One part of a comparison.

    Parameters
    ----------
    name, title : str
        Name of its sheet, and its heading.
    about : str
        How it was compared: the rule, and what the columns mean.
    table : DataFrame
        One row per thing compared; the column `RESULT` contains a `Found`.
    remarks : tuple of str
        What could not be compared, and why.
    headings : mapping of str to Heading
        Headings of columns whose names do not state the unit.
    """

    name: str
    title: str
    about: str
    table: pd.DataFrame
    remarks: tuple[str, ...] = ()
    headings: dict[str, Heading] = field(default_factory=dict)

    @property
    def differences(self) -> pd.DataFrame:
        """The rows that are not the same in both runs, those with two values first."""
        rows = self.table[self.table[RESULT] != Found.SAME]
        order = rows[RESULT].map(list(Found).index)
        return rows.loc[order.sort_values(kind="stable").index] if len(rows) else rows

    @property
    def same(self) -> bool:
        """True if everything could be compared and nothing differs."""
        return self.differences.empty and not self.remarks

    def headline(self) -> str:
        """Say in a few words what was found."""
        if self.table.empty:
            return tr("nothing to compare")
        counts = self.table[RESULT].value_counts()
        words = [count_in_words(one, int(counts[one])) for one in Found if one in counts.index]
        return ", ".join(words)


def count_in_words(found: Found, count: int) -> str:
    """Say how often something was found.

    Examples
    --------
    >>> count_in_words(Found.ONLY_A, 3)
    '3 only in A'
    """
    match found:
        case Found.SAME:
            return tr("{count} same", count=count)
        case Found.DIFFERENT:
            return tr("{count} different", count=count)
        case Found.ONLY_A:
            return tr("{count} only in A", count=count)
        case Found.ONLY_B:
            return tr("{count} only in B", count=count)
        case Found.NOT_COMPARED:
            return tr("{count} not comparable", count=count)
        case _:
            assert_never(found)


def presence(in_a: bool, in_b: bool) -> Found | None:
    """Name the only run that has an item; None if both have it."""
    if in_a and in_b:
        return None
    return Found.ONLY_A if in_a else Found.ONLY_B


def numbers_equal(one: float, two: float, within: float) -> bool:
    """Tell whether two numbers are the same within a relative difference; two NaN are the same.

    Examples
    --------
    >>> nan = float("nan")
    >>> numbers_equal(1.0, 1.0 + 1e-12, 1e-9), numbers_equal(nan, nan, 1e-9)
    (True, True)
    >>> numbers_equal(nan, 1.0, 1e-9), numbers_equal(0.0, 1e-300, 1e-9)
    (False, False)
    """
    if np.isnan(one) or np.isnan(two):
        return bool(np.isnan(one) and np.isnan(two))
    return bool(one == two or abs(one - two) <= within * max(abs(one), abs(two)))


def compared(one: float, two: float, within: float) -> Found:
    """Say whether two numbers are the same."""
    return Found.SAME if numbers_equal(one, two, within) else Found.DIFFERENT


def percent(one: float, two: float) -> float:
    """Return the difference two - one in percent of one; NaN where there is none."""
    if not (np.isfinite(one) and np.isfinite(two)) or one == 0:
        return float("nan")
    return float((two - one) / abs(one) * 100.0)


def as_number(value: Any) -> float:
    """Return a number; NaN for nothing."""
    return float("nan") if value is None or pd.isna(value) else float(str(value))


def part_table(rows: Sequence[dict[str, object]], columns: Sequence[str]) -> pd.DataFrame:
    """Make the table of a part; a part without rows still has its columns."""
    return pd.DataFrame(list(rows), columns=[*columns, RESULT])
