"""Force–displacement curves of one spoke for several rubbers, interpolated in C10."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from nptcs.errors import InputError
from nptcs.lca.spokes.law import SpokeLaw
from nptcs.lca.spokes.stiffness_table import OutOfRangeError

COLUMNS = ("spoke_c10_mpa", "elongation_mm", "force_n")


@dataclass(frozen=True)
class SpokeLawTable:
    """Laws of the tabulated rubbers, by increasing C10 (MPa)."""

    laws: dict[float, SpokeLaw]

    @classmethod
    def from_rows(cls, rows: Sequence[Mapping[Any, Any]], count: int) -> SpokeLawTable:
        """Read the columns `COLUMNS`: the points of all curves, tension positive.

        Parameters
        ----------
        rows : sequence of mapping
            Rows of the table, in any order.
        count : int
            Number of spokes.

        Raises
        ------
        InputError
            A number is missing, or a curve is not valid (see `SpokeLaw`).
        """
        try:
            points = np.array([[float(row[name]) for name in COLUMNS] for row in rows])
        except (KeyError, TypeError, ValueError) as error:
            raise InputError(
                f"a number is missing: {error}",
                remedy=f"give the columns {', '.join(COLUMNS)} with a number in each cell",
            ) from error
        if len(points) == 0:
            raise InputError("the table of spoke curves has no rows", remedy="give a curve")
        c10, elongation, force = points[np.lexsort((points[:, 1], points[:, 0]))].T
        return cls(
            {
                float(value): SpokeLaw(elongation[c10 == value], force[c10 == value], count)
                for value in np.unique(c10)
            }
        )

    def law(self, c10_mpa: float) -> SpokeLaw:
        """Return the law of a rubber: tabulated, or interpolated between its two neighbours.

        Between two rubbers the curve has the points of both, within the range of both.

        Raises
        ------
        OutOfRangeError
            `c10_mpa` lies outside the table; it is not extrapolated.
        """
        known = np.array(list(self.laws))
        if c10_mpa in self.laws:
            return self.laws[c10_mpa]
        if not known[0] < c10_mpa < known[-1]:
            raise OutOfRangeError(
                f"the table of spoke curves reaches from C10 = {known[0]:g} to {known[-1]:g} MPa",
                remedy="stay within it, or extend the table; it is not extrapolated",
                column="spoke_c10_mpa",
                value=c10_mpa,
            )
        place = int(np.searchsorted(known, c10_mpa))
        low, high = (self.laws[float(known[i])] for i in (place - 1, place))
        share = (c10_mpa - known[place - 1]) / (known[place] - known[place - 1])
        points = np.union1d(low.elongation_mm, high.elongation_mm)
        ranges = np.array([low.range_mm, high.range_mm])
        points = points[(points >= ranges[:, 0].max()) & (points <= ranges[:, 1].min())]
        force = (1 - share) * low.evaluate(points)[0] + share * high.evaluate(points)[0]
        return SpokeLaw(points, force, low.count)
