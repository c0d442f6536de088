"""Weighted linear least squares that refuses what the data cannot determine."""

from __future__ import annotations

import numpy as np

from nptcs.arrays import Array

SMALLEST_SINGULAR = 1e-10


def solve_linear(design: Array, target: Array, weight: Array) -> tuple[Array, int]:
    """Minimise Σ w (X c - y)², columns scaled to equal length first.

    A singular value below `SMALLEST_SINGULAR` times the largest counts as zero: beyond that
    conditioning the coefficients would have fewer than about five correct digits.

    Parameters
    ----------
    design : ndarray, shape (n, k)
        X.
    target, weight : ndarray, shape (n,)
        y and the factor w of each squared residual.

    Returns
    -------
    coefficients : ndarray, shape (k,)
        Of minimum norm where the rank is below k: the caller decides what that means.
    rank : int
        Rank of the scaled design.

    Examples
    --------
    >>> import numpy as np
    >>> design = np.array([[1.0, 0.0], [1.0, 1.0], [1.0, 2.0]])
    >>> coefficients, rank = solve_linear(design, np.array([1.0, 3.0, 5.0]), np.ones(3))
    >>> coefficients.round(6).tolist(), rank
    ([1.0, 2.0], 2)
    """
    root = np.sqrt(weight)
    weighted = design * root[:, None]
    scale = np.linalg.norm(weighted, axis=0)
    scale = np.where(scale > 0, scale, 1.0)
    solution, _, rank, _ = np.linalg.lstsq(weighted / scale, target * root, rcond=SMALLEST_SINGULAR)
    return solution / scale, int(rank)


def robust_covariance(jacobian: Array, residual: Array, weight: Array) -> Array:
    """Covariance of weighted least-squares estimates, shape (k, k).

    n/(n-k) · B (Jᵀ W R² W J) B with B = (Jᵀ W J)⁻¹ and R the residuals: MacKinnon and White's
    HC1, valid even where the weights are not the inverse variances. NaN where n leaves no
    degree of freedom or the Jacobian is singular.
    """
    n, k = jacobian.shape
    scale = np.linalg.norm(jacobian * np.sqrt(weight)[:, None], axis=0)
    if n <= k or not (scale > 0).all():
        return np.full((k, k), np.nan)
    scaled = jacobian / scale
    normal = (scaled * weight[:, None]).T @ scaled
    if np.linalg.cond(normal) > 1e14:
        return np.full((k, k), np.nan)
    bread = np.linalg.inv(normal)
    score = scaled * (weight * residual)[:, None]
    covariance = n / (n - k) * bread @ (score.T @ score) @ bread
    return covariance / np.outer(scale, scale)
