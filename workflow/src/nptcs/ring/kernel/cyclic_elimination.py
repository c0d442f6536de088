"""Elimination of a cyclic chain of small blocks, written for the compiler.

Nodes are eliminated one after the other; the last one closes the circle, is coupled to all the
others and is eliminated last.
"""

from __future__ import annotations

import numpy as np

from nptcs.arrays import Array

# unknowns of a node and right-hand sides: constants let the compiler unroll the loops
M, N = 5, 2
WIDE = 2 * M + N


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
    count = len(rhs)
    last = count - 1
    # of node i: coupling to the next node and to the last one, and the right-hand sides
    carried = np.zeros((count, M, WIDE))
    # coupling of the next node to be eliminated with the last one, and of the last one with it
    to_last, from_last = lower[last].copy(), upper[last].copy()
    for i in range(last):
        own = carried[i]
        for a in range(M):
            for b in range(M):
                own[a, M + b] = to_last[a, b]
                if i < last - 1:
                    own[a, b] = upper[i, a, b]
                else:
                    own[a, M + b] += upper[i, a, b]
            for b in range(N):
                own[a, 2 * M + b] = rhs[i, a, b]
        block = diagonal[i]
        for pivot in range(M):
            best = pivot
            for a in range(pivot + 1, M):
                if abs(block[a, pivot]) > abs(block[best, pivot]):
                    best = a
            if best != pivot:
                for b in range(M):
                    block[pivot, b], block[best, b] = block[best, b], block[pivot, b]
                for b in range(WIDE):
                    own[pivot, b], own[best, b] = own[best, b], own[pivot, b]
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
        if i == last - 1:
            for a in range(M):
                for b in range(M):
                    from_last[a, b] += lower[i, a, b]
        for a in range(M):
            for c in range(M):
                factor = from_last[a, c]
                for b in range(M):
                    diagonal[last, a, b] -= factor * own[c, M + b]
                for b in range(N):
                    rhs[last, a, b] -= factor * own[c, 2 * M + b]
        if i < last - 1:
            to_last[:] = 0.0
            turned = np.zeros((M, M))
            for a in range(M):
                for c in range(M):
                    factor, back = lower[i, a, c], from_last[a, c]
                    for b in range(M):
                        diagonal[i + 1, a, b] -= factor * own[c, b]
                        to_last[a, b] -= factor * own[c, M + b]
                        turned[a, b] -= back * own[c, b]
                    for b in range(N):
                        rhs[i + 1, a, b] -= factor * own[c, 2 * M + b]
            from_last[:] = turned
    rhs[last] = np.linalg.solve(diagonal[last], rhs[last])
    for i in range(last - 1, -1, -1):
        after = i + 1 if i < last - 1 else last
        for a in range(M):
            for b in range(N):
                total = carried[i, a, 2 * M + b]
                for c in range(M):
                    total -= carried[i, a, M + c] * rhs[last, c, b]
                    if after != last:
                        total -= carried[i, a, c] * rhs[after, c, b]
                rhs[i, a, b] = total
