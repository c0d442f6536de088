"""Elimination of a cyclic chain of small blocks, written for the compiler.

Nodes are eliminated one after the other; the last one closes the circle, is coupled to all the
others and is eliminated last.
"""

from __future__ import annotations

import numpy as np

from nptcs.arrays import Array
from nptcs.ring.kernel.compiled import compiled_inline

# unknowns of a node and right-hand sides: constants let the compiler unroll the loops
M, N = 5, 2
WIDE = 2 * M + N
# a node's equations once its block is solved: columns of the next node, of the last one, of the
# right-hand sides
NEXT, LAST, SIDES = 0, M, 2 * M


def eliminate(diagonal: Array, upper: Array, lower: Array, rhs: Array) -> None:
    """Solve the cyclic block system; `rhs` (nodes, 5, 2) becomes the solution.

    Rows are exchanged within a block only: the tangent of a stable state is nearly symmetric and
    positive definite, and a singular block shows as numbers that are not finite.

    Parameters
    ----------
    diagonal : array (nodes, 5, 5)
        Overwritten.
    upper, lower : arrays (nodes, 5, 5)
        Of node i with node i + 1, and of node i + 1 with node i; those of the last node close the
        circle.
    rhs : array (nodes, 5, 2)
    """
    last = len(rhs) - 1
    carried = np.zeros((last, M, WIDE))
    # coupling of the next node to be eliminated with the last one, and of the last one with it
    to_last, from_last = lower[last].copy(), upper[last].copy()
    for i in range(last):
        own, closes = carried[i], i == last - 1
        _gather(own, upper[i], to_last, rhs[i], closes)
        _solve_block(diagonal[i], own)
        if closes:
            from_last += lower[i]
        _subtract_block(diagonal[last], from_last, own, LAST)
        _subtract_sides(rhs[last], from_last, own)
        if not closes:
            _subtract_block(diagonal[i + 1], lower[i], own, NEXT)
            _subtract_sides(rhs[i + 1], lower[i], own)
            to_last[:] = 0.0
            _subtract_block(to_last, lower[i], own, LAST)
            turned = np.zeros((M, M))
            _subtract_block(turned, from_last, own, NEXT)
            from_last[:] = turned
    rhs[last] = np.linalg.solve(diagonal[last], rhs[last])
    _substitute_back(carried, rhs)


@compiled_inline
def _gather(own: Array, upper: Array, to_last: Array, rhs: Array, closes: bool) -> None:
    """Write a node's couplings and right-hand sides; the node that closes has one coupling."""
    for a in range(M):
        for b in range(M):
            own[a, LAST + b] = to_last[a, b]
            if closes:
                own[a, LAST + b] += upper[a, b]
            else:
                own[a, NEXT + b] = upper[a, b]
        for b in range(N):
            own[a, SIDES + b] = rhs[a, b]


@compiled_inline
def _solve_block(block: Array, own: Array) -> None:
    """Solve a node's block (5, 5) for all columns of `own`, rows exchanged; both overwritten."""
    for pivot in range(M):
        _exchange(block, own, pivot)
        inverse = 1.0 / block[pivot, pivot]
        for a in range(pivot + 1, M):
            factor = block[a, pivot] * inverse
            for b in range(pivot + 1, M):
                block[a, b] -= factor * block[pivot, b]
            for b in range(WIDE):
                own[a, b] -= factor * own[pivot, b]
    for a in range(M - 1, -1, -1):
        inverse = 1.0 / block[a, a]
        for c in range(a + 1, M):
            for b in range(WIDE):
                own[a, b] -= block[a, c] * own[c, b]
        for b in range(WIDE):
            own[a, b] *= inverse


@compiled_inline
def _exchange(block: Array, own: Array, pivot: int) -> None:
    """Bring the row with the largest entry of the pivot's column, at or below it, to the pivot."""
    best = pivot
    for a in range(pivot + 1, M):
        if abs(block[a, pivot]) > abs(block[best, pivot]):
            best = a
    if best != pivot:
        for b in range(M):
            block[pivot, b], block[best, b] = block[best, b], block[pivot, b]
        for b in range(WIDE):
            own[pivot, b], own[best, b] = own[best, b], own[pivot, b]


@compiled_inline
def _subtract_block(into: Array, factors: Array, own: Array, first: int) -> None:
    """Subtract `factors` times the five columns of `own` from `first` on from `into` (5, 5)."""
    for a in range(M):
        for c in range(M):
            factor = factors[a, c]
            for b in range(M):
                into[a, b] -= factor * own[c, first + b]


@compiled_inline
def _subtract_sides(into: Array, factors: Array, own: Array) -> None:
    """Subtract `factors` times the right-hand sides of `own` from `into` (5, 2)."""
    for a in range(M):
        for c in range(M):
            factor = factors[a, c]
            for b in range(N):
                into[a, b] -= factor * own[c, SIDES + b]


@compiled_inline
def _substitute_back(carried: Array, rhs: Array) -> None:
    """Find the unknowns of all nodes but the last, from the one before it to the first."""
    last = len(rhs) - 1
    for i in range(last - 1, -1, -1):
        for a in range(M):
            for b in range(N):
                total = carried[i, a, SIDES + b]
                for c in range(M):
                    total -= carried[i, a, LAST + c] * rhs[last, c, b]
                    if i < last - 1:
                        total -= carried[i, a, NEXT + c] * rhs[i + 1, c, b]
                rhs[i, a, b] = total
