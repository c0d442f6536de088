"""Elimination of a cyclic chain of small blocks, written for the compiler.

Node after node is eliminated; the last one, which closes the circle, meets all others and waits.
"""

from __future__ import annotations


import numpy as np

from nptcs.arrays import Array


def eliminate(diagonal: Array, upper: Array, lower: Array, rhs: Array) -> None:
    """Solve the cyclic block system; `rhs` (nodes, m, n) becomes the solution.

    Rows are exchanged within a block only: the tangent of a stable state is near to symmetric and
    positive definite, and a singular block shows as numbers that are not finite.

    Parameters
    ----------
    diagonal : array (nodes, m, m)
        Overwritten.
    upper, lower : arrays (nodes, m, m)
        Of node i with node i + 1, and of node i + 1 with node i; those of the last node close the
        circle.
    rhs : array (nodes, m, n)
    """
    count, m, n = rhs.shape
    last = count - 1
    # of node i: by the next node, by the last one, and the right-hand sides
    carried = np.zeros((count, m, 2 * m + n))
    # the next node to eliminate with the last one, and the last one with it
    to_last, from_last = lower[last].copy(), upper[last].copy()
    for i in range(last):
        own = carried[i]
        for a in range(m):
            for b in range(m):
                own[a, m + b] = to_last[a, b]
                if i < last - 1:
                    own[a, b] = upper[i, a, b]
                else:
                    own[a, m + b] += upper[i, a, b]
            for b in range(n):
                own[a, 2 * m + b] = rhs[i, a, b]
        block = diagonal[i]
        for pivot in range(m):
            best = pivot
            for a in range(pivot + 1, m):
                if abs(block[a, pivot]) > abs(block[best, pivot]):
                    best = a
            if best != pivot:
                for b in range(m):
                    block[pivot, b], block[best, b] = block[best, b], block[pivot, b]
                for b in range(2 * m + n):
                    own[pivot, b], own[best, b] = own[best, b], own[pivot, b]
            inverse = 1.0 / block[pivot, pivot]
            for a in range(pivot + 1, m):
                factor = block[a, pivot] * inverse
                for b in range(pivot + 1, m):
                    block[a, b] -= factor * block[pivot, b]
                for b in range(2 * m + n):
                    own[a, b] -= factor * own[pivot, b]
        for a in range(m - 1, -1, -1):
            inverse = 1.0 / block[a, a]
            for c in range(a + 1, m):
                for b in range(2 * m + n):
                    own[a, b] -= block[a, c] * own[c, b]
            for b in range(2 * m + n):
                own[a, b] *= inverse
        if i == last - 1:
            for a in range(m):
                for b in range(m):
                    from_last[a, b] += lower[i, a, b]
        for a in range(m):
            for c in range(m):
                factor = from_last[a, c]
                for b in range(m):
                    diagonal[last, a, b] -= factor * own[c, m + b]
                for b in range(n):
                    rhs[last, a, b] -= factor * own[c, 2 * m + b]
        if i < last - 1:
            to_last[:] = 0.0
            turned = np.zeros((m, m))
            for a in range(m):
                for c in range(m):
                    factor, back = lower[i, a, c], from_last[a, c]
                    for b in range(m):
                        diagonal[i + 1, a, b] -= factor * own[c, b]
                        to_last[a, b] -= factor * own[c, m + b]
                        turned[a, b] -= back * own[c, b]
                    for b in range(n):
                        rhs[i + 1, a, b] -= factor * own[c, 2 * m + b]
            from_last[:] = turned
    rhs[last] = np.linalg.solve(diagonal[last], rhs[last])
    for i in range(last - 1, -1, -1):
        after = i + 1 if i < last - 1 else last
        for a in range(m):
            for b in range(n):
                total = carried[i, a, 2 * m + b]
                for c in range(m):
                    total -= carried[i, a, m + c] * rhs[last, c, b]
                    if after != last:
                        total -= carried[i, a, c] * rhs[after, c, b]
                rhs[i, a, b] = total
