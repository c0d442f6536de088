"""Linear least squares to full double precision: QR with iterative refinement."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import linalg

from nptcs.arrays import Array

WideArray = NDArray[Any]
"""Numbers with more digits than double: long double, or exact fractions where that is double."""

REFINEMENTS = 3


def widened(values: Array) -> WideArray:
    """Return the same numbers in a type with more digits than double.

    That is long double where the compiler makes it wider than double; elsewhere (MSVC, Apple's
    ARM) exact fractions, which are slower but serve equally well.
    """
    if np.finfo(np.longdouble).eps < np.finfo(np.float64).eps:
        return values.astype(np.longdouble)
    exact = np.empty(values.shape, dtype=object)
    exact.ravel()[:] = [Fraction(float(value)) for value in values.ravel()]
    return exact


def solve(matrix: WideArray, y: Array) -> tuple[WideArray, Array]:
    """Solve min ‖y - A b‖ and return b with the inverse of R of A = Q R.

    Refinement of the augmented system r + A b = y, Aᵀ r = 0 with residuals in more digits than
    double (Björck, BIT 7, 1967, 257).

    Parameters
    ----------
    matrix : ndarray of shape (m, p)
        Of full rank, in the type that `widened` returns.
    y : ndarray of shape (m,)

    Returns
    -------
    coefficients : ndarray of shape (p,)
        In the type of `matrix`.
    inverse : ndarray of shape (p, p)
        R⁻¹; (AᵀA)⁻¹ is R⁻¹R⁻ᵀ.
    """
    q, r = linalg.qr(matrix.astype(np.float64), mode="economic")
    wide = widened(y)
    coefficients = widened(np.zeros(matrix.shape[1]))
    residual = widened(np.zeros(len(y)))
    for _ in range(1 + REFINEMENTS):
        first = (wide - residual - matrix @ coefficients).astype(np.float64)
        second = (-(matrix.T @ residual)).astype(np.float64)
        projected = q.T @ first
        lifted = linalg.solve_triangular(r, second, trans="T")
        coefficients = coefficients + widened(linalg.solve_triangular(r, projected - lifted))
        residual = residual + widened(first - q @ projected + q @ lifted)
    return coefficients, linalg.solve_triangular(r, np.eye(matrix.shape[1]))
