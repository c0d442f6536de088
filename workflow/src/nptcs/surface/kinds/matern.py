"""Covariance of a Matérn 5/2 process, its likelihood, and its slope in each hyperparameter.

They are those of scikit-learn's kernel ``ConstantKernel * Matern (+ WhiteKernel)``. A few dozen
cases are left out one by one, and each time the hyperparameters are searched again: scikit-learn's
general kernels would spend most of that time on copying and taking apart kernel objects.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import cholesky, solve_triangular
from scipy.linalg.lapack import dpotrf, dpotri, dpotrs
from scipy.spatial.distance import cdist

from nptcs.arrays import Array

ROWS = 512
"""Points whose covariances are computed at a time: they stay in the processor's cache."""


def covariance(theta: Array, points: Array, others: Array) -> Array:
    """Covariance of a process between points of shape (m, n) and others of shape (k, n) → (m, k).

    Rasmussen and Williams, 2006, equation 4.17.

    Parameters
    ----------
    theta : ndarray of shape (h,)
        Logarithms of variance and n lengths. A noise after them, which is independent for every
        case, is ignored.
    points, others : ndarray of shape (m, n) and (k, n)
    """
    lengths = np.exp(theta[1 : 1 + points.shape[1]])
    others = others / lengths
    found = np.empty((len(points), len(others)))
    for start in range(0, len(points), ROWS):
        reach = np.sqrt(5.0) * cdist(points[start : start + ROWS] / lengths, others)
        found[start : start + ROWS] = np.exp(theta[0] - reach) * (1.0 + reach + reach**2 / 3.0)
    return found


@dataclass(frozen=True)
class _Pairs:
    """A covariance by its p = m (m - 1)/2 pairs of points.

    Parameters
    ----------
    inverse_squares : ndarray of shape (n,)
        1/length² of each factor.
    reach, decay, smooth : ndarray of shape (p,)
        √5 times the scaled distance, variance times exp(-reach), covariance.
    variance, noise : float
    """

    inverse_squares: Array
    reach: Array
    decay: Array
    smooth: Array
    variance: float
    noise: float


class MaternLikelihood:
    """Minus the log marginal likelihood of values at points.

    A covariance is symmetric: only the pairs of different points are computed.

    Rasmussen and Williams, Gaussian Processes for Machine Learning, 2006, equations 2.30, 4.17
    and 5.9.

    Parameters
    ----------
    points : ndarray of shape (m, n)
    values : ndarray of shape (m,)
    nugget : float
        Added to the diagonal of the covariance.
    noisy : bool
        Whether the last hyperparameter is the variance of the noise.
    """

    def __init__(self, points: Array, values: Array, nugget: float, noisy: bool) -> None:
        self._first, self._second = np.triu_indices(len(points), 1)
        self._squares = ((points[self._first] - points[self._second]) ** 2).T.copy()
        self._place = self._first * len(points) + self._second
        self._values, self._nugget, self._noisy = values, nugget, noisy

    @property
    def factors(self) -> int:
        """Number of factors n, each with a length."""
        return len(self._squares)

    def __call__(self, theta: Array) -> tuple[float, Array]:
        """Evaluate at the logarithms of variance, n lengths and, if there is one, noise.

        Returns
        -------
        float, ndarray of shape (h,)
            The value and its slope; infinity with a slope of zero where the covariance is not
            positive definite.
        """
        pairs = self._pairs(theta)
        lower, failed = dpotrf(self._covariance(pairs), lower=1, clean=0, overwrite_a=1)
        if failed:
            return np.inf, np.zeros_like(theta)
        weights = dpotrs(lower, self._values, lower=1)[0]
        value = (
            0.5 * self._values @ weights
            + np.log(np.diag(lower)).sum()
            + 0.5 * len(weights) * np.log(2.0 * np.pi)
        )
        inverse = dpotri(lower, lower=1, overwrite_c=1)[0].T.ravel()
        pull = inverse[self._place] - weights[self._first] * weights[self._second]
        own_pull = 0.5 * (inverse[:: len(weights) + 1].sum() - weights @ weights)
        by_length = pull * pairs.decay * ((5.0 / 3.0) * (1.0 + pairs.reach))
        slope = [
            pull @ pairs.smooth + own_pull * pairs.variance,
            *(pairs.inverse_squares * (self._squares @ by_length)),
        ]
        if self._noisy:
            slope.append(pairs.noise * own_pull)
        return float(value), np.array(slope)

    def at_best_variance(self, theta: Array) -> float:
        """Log likelihood of the lengths at the best factor of the covariance, up to a constant."""
        lower = cholesky(self._covariance(self._pairs(theta)), lower=True)
        white = solve_triangular(lower, self._values, lower=True)
        count = len(white)
        return float(-0.5 * count * np.log(white @ white / count) - np.log(np.diag(lower)).sum())

    def _pairs(self, theta: Array) -> _Pairs:
        """Evaluate what depends on the pairs of points."""
        inverse_squares = np.exp(-2.0 * theta[1 : 1 + self.factors])
        reach = np.sqrt(5.0 * (inverse_squares @ self._squares))
        variance = float(np.exp(theta[0]))
        decay = variance * np.exp(-reach)
        smooth = decay * (1.0 + reach * (1.0 + reach / 3.0))
        noise = float(np.exp(theta[-1])) if self._noisy else 0.0
        return _Pairs(inverse_squares, reach, decay, smooth, variance, noise)

    def _covariance(self, pairs: _Pairs) -> Array:
        """Write the lower half of the covariance into a matrix as LAPACK takes it, (m, m)."""
        count = len(self._values)
        flat = np.zeros(count * count)
        flat[self._place] = pairs.smooth
        flat[:: count + 1] = pairs.variance + self._nugget + pairs.noise
        return flat.reshape(count, count).T
