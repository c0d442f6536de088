"""Linear least squares to full double precision: QR with iterative refinement."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import linalg

from nptcs.arrays import Array

LongArray = NDArray[np.longdouble]
REFINEMENTS = 3


def solve(matrix: LongArray, y: Array) -> tuple[LongArray, Array]:
    """Solve min ‖y - A b‖ and return b with the inverse of R of A = Q R.

    Refinement of the augmented system r + A b = y, Aᵀ r = 0 with residuals in long double
    (Björck, BIT 7, 1967, 257): where long double is no wider than double (some compilers) the
    steps still remove the error that the residual's size brings in.

    Parameters
    ----------
    matrix : ndarray of shape (m, p), long double
        Of full rank.
    y : ndarray of shape (m,)

    Returns
    -------
    coefficients : ndarray of shape (p,), long double
    inverse : ndarray of shape (p, p)
        R⁻¹; (AᵀA)⁻¹ is R⁻¹R⁻ᵀ.
    """
    q, r = linalg.qr(matrix.astype(np.float64), mode="economic")
    wide = y.astype(np.longdouble)
    coefficients = np.zeros(matrix.shape[1], np.longdouble)
    residual = np.zeros(len(y), np.longdouble)
    for _ in range(1 + REFINEMENTS):
        first = (wide - residual - matrix @ coefficients).astype(np.float64)
        second = (-(matrix.T @ residual)).astype(np.float64)
        projected = q.T @ first
        lifted = linalg.solve_triangular(r, second, trans="T")
        coefficients += linalg.solve_triangular(r, projected - lifted)
        residual += first - q @ projected + q @ lifted
    return coefficients, linalg.solve_triangular(r, np.eye(matrix.shape[1]))
