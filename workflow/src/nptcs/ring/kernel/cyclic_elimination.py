"""Elimination of a cyclic chain of small blocks, written for the compiler.

Nodes are eliminated one after the other; the last one closes the circle, is coupled to all the
others and is eliminated last. The force λ of a foot that covers several nodes is one more block,
λ - S Σ B_i x_i = 0. It is updated as the covered nodes are eliminated, and eliminated after them.
"""

from __future__ import annotations

import numpy as np

from nptcs.arrays import Array, Index
from nptcs.ring.kernel.compiled import compiled_inline

# unknowns of a node and right-hand sides: constants let the compiler unroll the loops
M, N = 5, 2
WIDE = 2 * M + N
# forces of a foot
K = 3
# a node's equations once its block is solved: columns of the next node, of the last one, of the
# right-hand sides
NEXT, LAST, SIDES, FOOT = 0, M, 2 * M, WIDE
COLUMNS = WIDE + K


def eliminate(
    diagonal: Array,
    upper: Array,
    lower: Array,
    rhs: Array,
    feet: Index,
    lever: Array,
    hold: Array,
) -> None:
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
    feet : array (feet, nodes of a foot)
        Neighbours in rising order; feet share no node, and none has one of the last two.
    lever : array (feet, nodes of a foot, 3, 5)
        B of each node.
    hold : array (feet, 3, 3)
        S of each foot.
    """
    last = len(rhs) - 1
    carried = np.zeros((last, M, COLUMNS))
    forces = np.zeros((len(feet), K, WIDE))
    # the foot that covers the node, and how many of its nodes are eliminated
    foot, place = 0, -1
    # the foot's block, its coupling to the next node and to the last, theirs to it, its right sides
    block, by_next, by_last, own_sides = (
        np.eye(K),
        np.zeros((K, M)),
        np.zeros((K, M)),
        np.zeros((K, N)),
    )
    next_by, last_by = np.zeros((M, K)), np.zeros((M, K))
    # coupling of the next node to be eliminated with the last one, and of the last one with it
    to_last, from_last = lower[last].copy(), upper[last].copy()
    for i in range(last):
        own, closes = carried[i], i == last - 1
        if place < 0 and foot < len(feet) and feet[foot, 0] == i:
            place = 0
            block[:] = np.eye(K)
            by_next[:], by_last[:], own_sides[:] = 0.0, 0.0, 0.0
            next_by[:], last_by[:] = 0.0, 0.0
        _gather(own, upper[i], to_last, rhs[i], closes)
        if place >= 0:
            _gather_foot(own, next_by, by_next, lever[foot, place], hold[foot])
        _solve_block(diagonal[i], own)
        if closes:
            from_last += lower[i]
        if place >= 0:
            _carry_foot(
                own, by_next, by_last, own_sides, block, next_by, last_by, lower[i], from_last
            )
            place += 1
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
        if place == feet.shape[1]:
            solved = forces[foot]
            solved[:, NEXT:LAST], solved[:, LAST:SIDES], solved[:, SIDES:] = (
                by_next,
                by_last,
                own_sides,
            )
            solved[:] = np.linalg.solve(block, solved)
            _subtract_foot(diagonal[i + 1], next_by, solved, NEXT)
            _subtract_foot(to_last, next_by, solved, LAST)
            _subtract_foot_sides(rhs[i + 1], next_by, solved)
            _subtract_foot(from_last, last_by, solved, NEXT)
            _subtract_foot(diagonal[last], last_by, solved, LAST)
            _subtract_foot_sides(rhs[last], last_by, solved)
            foot, place = foot + 1, -1
    rhs[last] = np.linalg.solve(diagonal[last], rhs[last])
    _substitute_back(carried, rhs, feet, forces)


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
            for b in range(COLUMNS):
                own[a, b] -= factor * own[pivot, b]
    for a in range(M - 1, -1, -1):
        inverse = 1.0 / block[a, a]
        for c in range(a + 1, M):
            for b in range(COLUMNS):
                own[a, b] -= block[a, c] * own[c, b]
        for b in range(COLUMNS):
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
        for b in range(COLUMNS):
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
def _gather_foot(own: Array, next_by: Array, by_next: Array, lever: Array, hold: Array) -> None:
    """Add a node's share in its foot: its column to `own`, the foot's row to `by_next`."""
    for a in range(M):
        for k in range(K):
            own[a, FOOT + k] = next_by[a, k] + lever[k, a]
    for k in range(K):
        for a in range(M):
            for c in range(K):
                by_next[k, a] -= hold[k, c] * lever[c, a]


@compiled_inline
def _carry_foot(
    own: Array,
    by_next: Array,
    by_last: Array,
    own_sides: Array,
    block: Array,
    next_by: Array,
    last_by: Array,
    lower: Array,
    from_last: Array,
) -> None:
    """Eliminate a solved node from its foot's row, and its foot from the next and last node's."""
    row = by_next.copy()
    by_next[:] = 0.0
    next_by[:] = 0.0
    for k in range(K):
        for c in range(M):
            factor = row[k, c]
            for b in range(M):
                by_next[k, b] -= factor * own[c, NEXT + b]
                by_last[k, b] -= factor * own[c, LAST + b]
            for b in range(N):
                own_sides[k, b] -= factor * own[c, SIDES + b]
            for b in range(K):
                block[k, b] -= factor * own[c, FOOT + b]
    for a in range(M):
        for c in range(M):
            for b in range(K):
                next_by[a, b] -= lower[a, c] * own[c, FOOT + b]
                last_by[a, b] -= from_last[a, c] * own[c, FOOT + b]


@compiled_inline
def _subtract_foot(into: Array, factors: Array, solved: Array, first: int) -> None:
    """Subtract `factors` (5, 3) times five columns of a foot's solved rows from `into` (5, 5)."""
    for a in range(M):
        for c in range(K):
            for b in range(M):
                into[a, b] -= factors[a, c] * solved[c, first + b]


@compiled_inline
def _subtract_foot_sides(into: Array, factors: Array, solved: Array) -> None:
    """Subtract `factors` (5, 3) times the right-hand sides of a foot from `into` (5, 2)."""
    for a in range(M):
        for c in range(K):
            for b in range(N):
                into[a, b] -= factors[a, c] * solved[c, SIDES + b]


@compiled_inline
def _substitute_back(carried: Array, rhs: Array, feet: Index, forces: Array) -> None:
    """Find the unknowns of all nodes but the last, from the one before it to the first."""
    last = len(rhs) - 1
    reach = feet.shape[1]
    foot = len(feet) - 1
    force = np.zeros((K, N))
    for i in range(last - 1, -1, -1):
        held = foot >= 0 and i <= feet[foot, reach - 1]
        if held and i == feet[foot, reach - 1]:
            for k in range(K):
                for b in range(N):
                    total = forces[foot, k, SIDES + b]
                    for c in range(M):
                        total -= forces[foot, k, LAST + c] * rhs[last, c, b]
                        total -= forces[foot, k, NEXT + c] * rhs[i + 1, c, b]
                    force[k, b] = total
        for a in range(M):
            for b in range(N):
                total = carried[i, a, SIDES + b]
                for c in range(M):
                    total -= carried[i, a, LAST + c] * rhs[last, c, b]
                    if i < last - 1:
                        total -= carried[i, a, NEXT + c] * rhs[i + 1, c, b]
                if held:
                    for k in range(K):
                        total -= carried[i, a, FOOT + k] * force[k, b]
                rhs[i, a, b] = total
        if held and i == feet[foot, 0]:
            foot -= 1
