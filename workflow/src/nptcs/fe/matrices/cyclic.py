"""The ring's matrix: element tangents gathered into diagonals, and the solution of its equations.

The matrix of a ring numbered from both of its sides at once is zero far from its diagonal:
LAPACK's banded factorisation beats a general sparse one there
(``docs/decisions/0003-fe-kernel.md``).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.linalg import solve_banded

from nptcs.arrays import Array, Index, Places


class BandedPattern:
    """Where each entry of the element tangents goes in a banded matrix.

    Parameters
    ----------
    dofs : sequence of arrays (elements, dofs of an element)
        Number of each unknown, or -1 where it is not solved for.
    size : int
        Number of unknowns.
    """

    def __init__(self, dofs: Sequence[Index], size: int) -> None:
        self.size = size
        self._keep: list[Places] = []
        rows: list[Index] = []
        columns: list[Index] = []
        for block in dofs:
            shape = (*block.shape, block.shape[1])
            row = np.broadcast_to(block[:, :, None], shape).ravel()
            column = np.broadcast_to(block[:, None, :], shape).ravel()
            keep = np.flatnonzero((row >= 0) & (column >= 0))
            self._keep.append(keep.astype(np.int32))
            rows.append(row[keep])
            columns.append(column[keep])
        distances = [row - column for row, column in zip(rows, columns, strict=True)]
        self.width = max(int(np.max(np.abs(distance), initial=0)) for distance in distances)
        self._targets = [
            ((distance + self.width) * size + column).astype(np.int32)
            for distance, column in zip(distances, columns, strict=True)
        ]

    def assemble(self, tangents: Sequence[Array]) -> Array:
        """Sum element tangents into LAPACK's band storage, diagonal after `width` rows."""
        from nptcs.fe.matrices.compiled import add_at

        diagonals = np.zeros((2 * self.width + 1, self.size))
        flat = diagonals.reshape(-1)
        for part, keep, targets in zip(tangents, self._keep, self._targets, strict=True):
            add_at(targets, keep, part.ravel(), flat)
        return diagonals

    def solve(self, diagonals: Array, rhs: Array) -> Array:
        """Solve for one or several right-hand sides (size, …).

        Raises
        ------
        numpy.linalg.LinAlgError
            If the matrix is singular.
        """
        solution: Array = solve_banded((self.width, self.width), diagonals, rhs, check_finite=False)
        return solution


def folded_order(columns: int) -> Index:
    """Give new places to a ring's columns, numbered from both sides at once (0, n-1, 1, n-2, …)."""
    order = np.empty(columns, dtype=np.int64)
    half = (columns + 1) // 2
    order[:half] = 2 * np.arange(half)
    order[half:] = 2 * (columns - 1 - np.arange(half, columns)) + 1
    return order
