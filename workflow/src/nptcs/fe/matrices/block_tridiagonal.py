"""The spoke's symmetric matrix as a chain of dense blocks, and its factorisations.

Unknowns come in rows of equal length, and an element joins three consecutive rows, beginning with
an even one (its lower corners). A block holds an odd row and the even one after it; only the last
row of a block is coupled to the next block. Dense LAPACK on these blocks does half the work of a
banded factorisation, which treats every row as if it were coupled to the next three
(``docs/decisions/0003-fe-kernel.md``).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg.blas import dsyrk, dtrsm, dtrsv
from scipy.linalg.lapack import dpotrf

from nptcs.arrays import Array, Index, Places


@dataclass
class BlockMatrix:
    """Lower half of a symmetric block-tridiagonal matrix, every block transposed.

    Parameters
    ----------
    diagonal : array (blocks, 2 row, 2 row)
        Upper triangles: their transposes are what LAPACK calls lower.
    below : array (blocks - 1, row, 2 row)
        Second row of each block by all of the next block.
    size : int
        Unknowns; the last block is padded with ones on the diagonal.
    """

    diagonal: Array
    below: Array
    size: int


class BlockPattern:
    """Where each entry of the element tangents goes.

    Parameters
    ----------
    dofs : sequence of arrays (elements, dofs of an element)
        Number of each unknown, or -1 where it is not solved for.
    row : int
        Unknowns of one row.
    size : int
        Number of unknowns.
    """

    def __init__(self, dofs: Sequence[Index], row: int, size: int) -> None:
        self.row, self.size = row, size
        self._wide = 2 * row
        self._blocks = -(-size // self._wide)
        self._keep: list[Places] = []
        self._targets: list[Places] = []
        for block in dofs:
            shape = (*block.shape, block.shape[1])
            low = np.broadcast_to(block[:, :, None], shape).ravel()
            high = np.broadcast_to(block[:, None, :], shape).ravel()
            keep = np.flatnonzero((high >= 0) & (low >= high))
            self._keep.append(keep.astype(np.int32))
            self._targets.append(self._target(low[keep], high[keep]).astype(np.int32))

    def _target(self, low: Index, high: Index) -> Index:
        """Place of entry (low, high), low ≥ high, in the diagonal blocks and those below."""
        block, column = np.divmod(high, self._wide)
        lower, line = np.divmod(low, self._wide)
        beside = lower - block
        if np.any((beside > 1) | ((beside == 1) & (column < self.row))):
            raise ValueError("an element joins rows of blocks that are not neighbours")
        inside = (block * self._wide + column) * self._wide + line
        outside = (block * self.row + column - self.row) * self._wide + line
        target: Index = np.where(beside == 0, inside, self._blocks * self._wide**2 + outside)
        return target

    def empty_entries(self) -> Array:
        """Return an array that takes the entries of one matrix."""
        wide, blocks = self._wide, self._blocks
        return np.empty(blocks * wide**2 + (blocks - 1) * self.row * wide)

    def assemble(self, tangents: Sequence[Array], out: Array | None = None) -> BlockMatrix:
        """Sum element tangents (elements, dofs, dofs).

        With `out`, an array of `empty_entries`, the matrix is written there and overwrites an older
        matrix or its factorisation.
        """
        from nptcs.fe.matrices.compiled import add_at

        wide, blocks = self._wide, self._blocks
        start = blocks * wide**2
        whole = self.empty_entries() if out is None else out
        whole[:] = 0.0
        for part, keep, targets in zip(tangents, self._keep, self._targets, strict=True):
            add_at(targets, keep, part.ravel(), whole)
        diagonal = whole[:start].reshape(blocks, wide, wide)
        fill = np.arange(self.size - (blocks - 1) * wide, wide)
        diagonal[-1, fill, fill] = 1.0
        return BlockMatrix(diagonal, whole[start:].reshape(-1, self.row, wide), self.size)


class BlockCholesky:
    """Factorisation of a positive definite block-tridiagonal matrix, which it overwrites.

    Raises
    ------
    numpy.linalg.LinAlgError
        If the matrix is not positive definite: the state is unstable.
    """

    def __init__(self, matrix: BlockMatrix) -> None:
        row = matrix.below.shape[1]
        self._size = matrix.size
        self._own: list[Array] = []
        self._next: list[Array] = []
        for number, block in enumerate(matrix.diagonal):
            if number:
                corner = self._own[-1][row:, row:]
                link = matrix.below[number - 1].T
                link = dtrsm(1.0, corner, link, side=1, lower=1, trans_a=1, overwrite_b=1)
                block = dsyrk(-1.0, link, beta=1.0, c=block.T, lower=1, overwrite_c=1)
                self._next.append(link)
            else:
                block = block.T
            factor, failed = dpotrf(block, lower=1, clean=0, overwrite_a=1)
            if failed:
                raise np.linalg.LinAlgError("the matrix is not positive definite")
            self._own.append(factor)

    def solve(self, rhs: Array) -> Array:
        """Solve for one or several right-hand sides (size, …)."""
        parts = _split(rhs, len(self._own), len(self._own[0]))
        row = len(self._own[0]) // 2
        for number, factor in enumerate(self._own):
            if number:
                parts[number] = parts[number] - self._next[number - 1] @ parts[number - 1][row:]
            parts[number] = _triangle(factor, parts[number], transposed=False)
        for number in range(len(parts) - 1, -1, -1):
            if number < len(parts) - 1:
                parts[number][row:] -= self._next[number].T @ parts[number + 1]
            parts[number] = _triangle(self._own[number], parts[number], transposed=True)
        return np.concatenate(parts)[: self._size].reshape(rhs.shape)


def _triangle(factor: Array, rhs: Array, transposed: bool) -> Array:
    """Solve with a lower triangle, or its transpose, for right-hand sides (n, m)."""
    if rhs.shape[1] == 1:
        # dtrsm copies the triangle, which takes longer than solving for one right-hand side
        line: Array = dtrsv(factor, rhs[:, 0], lower=1, trans=transposed)
        return line[:, None]
    found: Array = dtrsm(1.0, factor, rhs, lower=1, trans_a=transposed)
    return found


def solve_indefinite(matrix: BlockMatrix, rhs: Array) -> Array:
    """Solve with a symmetric matrix that need not be positive definite.

    Raises
    ------
    numpy.linalg.LinAlgError
        If a block is singular once those before it are eliminated.
    """
    wide = matrix.diagonal.shape[1]
    row = wide // 2
    parts = _split(rhs, len(matrix.diagonal), wide)
    whole = [np.triu(block) + np.triu(block, 1).T for block in matrix.diagonal]
    links = [link.T for link in matrix.below]
    lifted: list[Array] = []
    for number, link in enumerate(links):
        spread = np.zeros((wide, wide))
        spread[:, row:] = link
        lift = np.linalg.solve(whole[number], spread.T).T
        whole[number + 1] -= lift[:, row:] @ link.T
        parts[number + 1] = parts[number + 1] - lift @ parts[number]
        lifted.append(lift)
    parts[-1] = np.linalg.solve(whole[-1], parts[-1])
    for number in range(len(links) - 1, -1, -1):
        parts[number] = np.linalg.solve(whole[number], parts[number])
        parts[number] -= lifted[number].T @ parts[number + 1]
    return np.concatenate(parts)[: matrix.size].reshape(rhs.shape)


def _split(rhs: Array, blocks: int, wide: int) -> list[Array]:
    """Right-hand sides (size, …) in pieces (2 row, n), padded with zeros."""
    flat = rhs.reshape(len(rhs), -1)
    padded = np.zeros((blocks * wide, flat.shape[1]))
    padded[: len(flat)] = flat
    return list(padded.reshape(blocks, wide, -1))
