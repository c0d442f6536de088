"""Length scales that the cases do not tell, and a process's variance without bias.

Cases at three levels of a factor hardly say how far a process reaches from one level to the next:
lengths that differ tenfold can be equally likely, and each promises another interval between the
levels. Predictions are then averaged over both ends of these lengths.
"""

from __future__ import annotations

from itertools import product

import numpy as np
from scipy.linalg import cholesky, solve_triangular
from scipy.optimize import brentq
from sklearn.gaussian_process.kernels import Kernel

from nptcs.arrays import Array

AS_LIKELY = 0.5
"""Fall of the log likelihood that is not evidence: that of one standard error of a length."""


def lengths_as_likely(kernel: Kernel, points: Array, residual: Array, nugget: float) -> Array:
    """Return the hyperparameters that a prediction is averaged over, (c, h); one row mostly.

    A length is not told where its lower bound, with which the process reaches no other level, is
    as likely as the best length. It is then taken at both ends of what is as likely (`AS_LIKELY`),
    in all combinations with the other such lengths, with equal weights.

    Parameters
    ----------
    kernel : Kernel
        With the most likely hyperparameters: variance, n lengths, and what follows them.
    points, residual : ndarray of shape (m, n) and (m,)
        Cases in coded units, and what the process follows, scaled.
    nugget : float
        Added to the diagonal of the covariance.
    """
    best, bounds = kernel.theta, kernel.bounds
    highest = log_likelihood(kernel, points, residual, nugget)

    def lack(value: float, axis: int) -> float:
        theta = best.copy()
        theta[axis] = value
        there = log_likelihood(kernel.clone_with_theta(theta), points, residual, nugget)
        return highest - there - AS_LIKELY

    choices: list[tuple[float, ...]] = [(value,) for value in best]
    for axis in range(1, 1 + points.shape[1]):
        low, high = bounds[axis]
        if lack(low, axis) > 0.0:
            continue
        if lack(high, axis) > 0.0:
            high = brentq(lack, max(best[axis], low), high, args=(axis,), xtol=1e-3)
        choices[axis] = (low, high)
    return np.array(list(product(*choices)))


def log_likelihood(kernel: Kernel, points: Array, residual: Array, nugget: float) -> float:
    """Log likelihood of a kernel's lengths at the best variance for them, up to a constant."""
    covariance = kernel(points)
    covariance[np.diag_indices_from(covariance)] += nugget
    lower = cholesky(covariance, lower=True)
    white = solve_triangular(lower, residual, lower=True)
    m = len(residual)
    return float(-0.5 * m * np.log(white @ white / m) - np.log(np.diag(lower)).sum())


def restricted_variance(lower: Array, basis: Array, residual: Array) -> float:
    """Factor of a process's covariance that the residuals of its mean ask for.

    Sum of squares of what the mean's coefficients cannot take up, over m - p: without bias by their
    number (Patterson and Thompson, Biometrika 58, 1971, 545).

    Parameters
    ----------
    lower : ndarray of shape (m, m)
        Cholesky factor of the covariance.
    basis : ndarray of shape (m, p)
        Slopes of the mean by its coefficients.
    residual : ndarray of shape (m,)
    """
    white = solve_triangular(lower, np.column_stack([residual, basis]), lower=True)
    q, _ = np.linalg.qr(white[:, 1:])
    rest = white[:, 0] - q @ (q.T @ white[:, 0])
    return float(rest @ rest) / (len(residual) - basis.shape[1])
