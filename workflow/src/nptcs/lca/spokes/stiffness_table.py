"""Stiffness of one spoke against the constant C10 of its rubber, as in table 10 of the paper."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import PchipInterpolator

from nptcs.arrays import Floating
from nptcs.errors import InputError
from nptcs.lca.checks import require_positive
from nptcs.lca.spokes.linear import LinearSpokes

COLUMNS = ("spoke_c10_mpa", "tension_stiffness_n_per_mm", "compression_stiffness_n_per_mm")


class OutOfRangeError(InputError):
    """A C10 for which the table has no spoke."""


@dataclass(frozen=True)
class SpokeStiffnessTable:
    """Stiffness in tension and compression at increasing C10; arrays of shape ``(n,)``.

    Examples
    --------
    >>> rows = [
    ...     {
    ...         "spoke_c10_mpa": c10,
    ...         "tension_stiffness_n_per_mm": 30 * c10,
    ...         "compression_stiffness_n_per_mm": 13 * c10,
    ...     }
    ...     for c10 in (1, 2, 3)
    ... ]
    >>> round(SpokeStiffnessTable.from_rows(rows).spokes(1.5, count=60).tension_n_per_mm, 6)
    45.0
    """

    c10_mpa: Floating
    tension_n_per_mm: Floating
    compression_n_per_mm: Floating

    @classmethod
    def from_rows(cls, rows: Sequence[Mapping[Any, Any]]) -> SpokeStiffnessTable:
        """Read the columns `COLUMNS` of a table, in any order of rows.

        Raises
        ------
        InputError
            A column or a number is missing, a value is not positive, a C10 is given twice, or
            there are fewer than two rows.
        """
        if len(rows) < 2:
            raise InputError(
                "needs at least two rows", remedy="give the stiffness at two values of C10"
            )
        table = np.array(
            # the first line of a file names the columns
            [[_number(row, name, line) for name in COLUMNS] for line, row in enumerate(rows, 2)]
        )
        table = table[np.argsort(table[:, 0])]
        if np.any(np.diff(table[:, 0]) == 0):
            raise InputError(
                "a C10 is given twice", remedy="keep one row per C10", column="spoke_c10_mpa"
            )
        return cls(table[:, 0], table[:, 1], table[:, 2])

    def spokes(self, c10_mpa: float, count: int) -> LinearSpokes:
        """Return the spokes of a rubber, by monotone cubic interpolation between the rows.

        Raises
        ------
        OutOfRangeError
            `c10_mpa` lies outside the table; it is not extrapolated.
        """
        low, high = float(self.c10_mpa[0]), float(self.c10_mpa[-1])
        if not low <= c10_mpa <= high:
            raise OutOfRangeError(
                f"the spoke stiffness table reaches from C10 = {low:g} to {high:g} MPa",
                remedy="stay within it, or extend the table; it is not extrapolated",
                column="spoke_c10_mpa",
                value=c10_mpa,
            )
        tension, compression = map(float, self.stiffness(c10_mpa))
        return LinearSpokes(tension, compression, count)

    def stiffness(self, c10_mpa: ArrayLike) -> tuple[Floating, Floating]:
        """Return the stiffness in tension and compression (N/mm) within the table's range."""
        tension, compression = (
            np.asarray(PchipInterpolator(self.c10_mpa, values)(c10_mpa), dtype=float)
            for values in (self.tension_n_per_mm, self.compression_n_per_mm)
        )
        return tension, compression


def _number(row: Mapping[Any, Any], column: str, line: int) -> float:
    """Read one positive number, or report where it is missing."""
    try:
        value = float(row[column])
    except (KeyError, TypeError, ValueError) as error:
        raise InputError(
            "a number is missing",
            remedy="give a column with numbers",
            line=line,
            column=column,
            value=row.get(column),
        ) from error
    try:
        require_positive(column, value)
    except InputError as error:
        error.line = line
        raise
    return value
