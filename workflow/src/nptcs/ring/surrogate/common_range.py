"""Energy tables of different ranges brought to one range, so that they can be interpolated.

A spoke that loses its stability in compression has a shorter table. A polynomial on a shorter range
is the same polynomial, since x(s) of one range is linear in that of another: its coefficients are
converted exactly.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.polynomial import chebyshev

from nptcs.arrays import Array, Index
from nptcs.fe.spoke.coordinates import elongations_at, unit_elongation
from nptcs.fe.spoke.energy_table import SpokeEnergyTable, side_part


def on_common_range(tables: Sequence[SpokeEnergyTable]) -> list[SpokeEnergyTable]:
    """Return the same energies on the shortest of the ranges of s, with the same terms.

    Parameters
    ----------
    tables : sequence of SpokeEnergyTable
        Sampled with the same options, so that their ranges of β and φ at s ≥ 0 agree.
    """
    lowest = max(float(table.low[0]) for table in tables)
    exponents = np.unique(np.concatenate([table.exponents for table in tables]), axis=0)
    return [_restricted(table, lowest, exponents) for table in tables]


def _restricted(table: SpokeEnergyTable, lowest: float, exponents: Index) -> SpokeEnergyTable:
    sides, place = np.unique(table.exponents[:, 1:], axis=0, return_inverse=True)
    dense = np.zeros((int(exponents[:, 0].max()) + 1, len(sides)))
    dense[table.exponents[:, 0], place.ravel()] = table.coefficients
    limits = float(table.low[0]), float(table.high[0])
    carried = _carried(dense, limits, table.straight_mm, lowest)
    number = {tuple(side): column for column, side in enumerate(sides.tolist())}
    coefficients = np.array(
        [carried[i, number[j, k]] if (j, k) in number else 0.0 for i, j, k in exponents.tolist()]
    )
    low = table.low.copy()
    part = side_part(np.array([lowest]), float(low[0]), table.narrowing)
    low[0] = lowest
    return replace(
        table,
        low=low,
        exponents=exponents,
        coefficients=coefficients,
        narrowing=float(part[0]),
    )


def _carried(
    coefficients: Array, limits: tuple[float, float], straight_mm: float, lowest: float
) -> Array:
    """Chebyshev coefficients (degrees, columns) on [lowest, high] of those on [low, high]."""
    degree = len(coefficients) - 1
    unit = -np.cos(np.pi * (np.arange(degree + 1) + 0.5) / (degree + 1))
    s = elongations_at(unit, (lowest, limits[1]), straight_mm)
    local = unit_elongation(s, limits, straight_mm)[0]
    values = chebyshev.chebvander(local, degree) @ coefficients
    found: Array = np.asarray(np.linalg.solve(chebyshev.chebvander(unit, degree), values), float)
    return found
