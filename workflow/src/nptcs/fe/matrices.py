"""Element tangents gathered into a banded matrix, and its factorisation.

A spoke numbered row by row, and a ring numbered from both of its sides at once, have narrow bands:
LAPACK's banded factorisations beat a general sparse one there
(``docs/decisions/0003-fe-kernel.md``).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_solve_banded, cholesky_banded, solve_banded

Array = NDArray[np.float64]
Index = NDArray[np.int64]


def element_dofs(nodes: Index, dim: int) -> Index:
    """Degrees of freedom (elements, nodes × dim) of elements' nodes."""
    return (nodes[:, :, None] * dim + np.arange(dim)).reshape(len(nodes), -1)


class BandedPattern:
    """Where each entry of the element tangents goes in a banded matrix.

    Parameters
    ----------
    dofs : sequence of arrays (elements, dofs of an element)
        Number of each unknown, or -1 where it is not solved for.
    size : int
        Number of unknowns.
    symmetric : bool
        Whether only the lower band is kept.
    """

    def __init__(self, dofs: Sequence[Index], size: int, symmetric: bool) -> None:
        self.size = size
        self._keep: list[Index] = []
        rows: list[Index] = []
        columns: list[Index] = []
        for block in dofs:
            shape = (*block.shape, block.shape[1])
            row = np.broadcast_to(block[:, :, None], shape).ravel()
            column = np.broadcast_to(block[:, None, :], shape).ravel()
            wanted = (row >= 0) & (column >= 0)
            keep = np.flatnonzero(wanted & (row >= column) if symmetric else wanted)
            self._keep.append(keep)
            rows.append(row[keep])
            columns.append(column[keep])
        distance = np.concatenate(rows) - np.concatenate(columns)
        self.width = int(np.max(np.abs(distance)))
        self.above = 0 if symmetric else self.width
        self._target = (distance + self.above) * size + np.concatenate(columns)

    def assemble(self, tangents: Sequence[Array]) -> Array:
        """Sum element tangents into LAPACK's band storage, diagonal after `above` rows."""
        values = np.concatenate(
            [block.ravel()[keep] for block, keep in zip(tangents, self._keep, strict=True)]
        )
        count = (self.above + self.width + 1) * self.size
        band: Array = np.bincount(self._target, values, minlength=count).astype(float)
        return band.reshape(-1, self.size)

    def solve(self, band: Array, rhs: Array) -> Array:
        """Solve with an unsymmetric band for one or several right-hand sides (size, …).

        Raises
        ------
        numpy.linalg.LinAlgError
            If the matrix is singular.
        """
        solution: Array = solve_banded((self.width, self.above), band, rhs, check_finite=False)
        return solution


def folded_order(columns: int) -> Index:
    """Give new places to a ring's columns, numbered from both sides at once (0, n-1, 1, n-2, …)."""
    order = np.empty(columns, dtype=np.int64)
    half = (columns + 1) // 2
    order[:half] = 2 * np.arange(half)
    order[half:] = 2 * (columns - 1 - np.arange(half, columns)) + 1
    return order


def solve_indefinite(band: Array, rhs: Array) -> Array:
    """Solve with a symmetric lower band that need not be positive definite.

    Raises
    ------
    numpy.linalg.LinAlgError
        If the matrix is singular.
    """
    width, size = len(band) - 1, band.shape[1]
    upper = np.zeros((width, size))
    for distance in range(1, width + 1):
        upper[width - distance, distance:] = band[distance, : size - distance]
    whole = np.concatenate([upper, band])
    solution: Array = solve_banded((width, width), whole, rhs, check_finite=False)
    return solution


class BandedCholesky:
    """Factorisation of a symmetric positive definite banded matrix (lower band).

    Raises
    ------
    numpy.linalg.LinAlgError
        If the matrix is not positive definite: the state is unstable.
    """

    def __init__(self, band: Array) -> None:
        self._factor = cholesky_banded(band, lower=True, check_finite=False)

    def solve(self, rhs: Array) -> Array:
        """Solve for one or several right-hand sides (size, …)."""
        solution: Array = cho_solve_banded((self._factor, True), rhs, check_finite=False)
        return solution
