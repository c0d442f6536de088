"""An exact least-squares solution to compare with."""

from fractions import Fraction

import numpy as np
import pytest


@pytest.fixture
def exact_solution():
    return solve_exactly


def solve_exactly(rows, y):
    """Solve the normal equations in exact fractions."""
    size = len(rows[0])
    a = [[sum(row[i] * row[j] for row in rows) for j in range(size)] for i in range(size)]
    b = [sum(row[i] * value for row, value in zip(rows, y, strict=True)) for i in range(size)]
    for pivot in range(size):
        for row in range(pivot + 1, size):
            factor = a[row][pivot] / a[pivot][pivot]
            a[row] = [x - factor * p for x, p in zip(a[row], a[pivot], strict=True)]
            b[row] -= factor * b[pivot]
    solution = [Fraction(0)] * size
    for row in reversed(range(size)):
        rest = sum(a[row][k] * solution[k] for k in range(row + 1, size))
        solution[row] = (b[row] - rest) / a[row][row]
    return np.array([float(value) for value in solution])
