"""Likelihood of a Matérn 5/2 process, and its slope with respect to the hyperparameters.

A few dozen cases are left out one by one, and each time the hyperparameters are searched again:
scikit-learn's general kernels would spend most of that time on copying and taking apart kernel
objects. Value and slope are those of scikit-learn's kernel ``ConstantKernel * Matern
(+ WhiteKernel)``, which the process itself uses.
"""

from __future__ import annotations

import numpy as np
from scipy.linalg import cho_factor, cho_solve, cholesky, solve_triangular
from scipy.linalg.lapack import dpotri

from nptcs.arrays import Array


class MaternLikelihood:
    """Minus the log marginal likelihood of values at points.

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
        columns = points.T
        self._squares = (columns[:, :, None] - columns[:, None, :]) ** 2
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
        count = len(self._values)
        scaled, reach, smooth, noise = self._parts(theta)
        try:
            factor = cho_factor(self._covariance(smooth, noise), lower=True)
        except np.linalg.LinAlgError:
            return np.inf, np.zeros_like(theta)
        weights = cho_solve(factor, self._values)
        lower = dpotri(factor[0], lower=1)[0]
        inverse = np.tril(lower) + np.tril(lower, -1).T
        value = (
            0.5 * self._values @ weights
            + np.log(np.diag(factor[0])).sum()
            + 0.5 * count * np.log(2.0 * np.pi)
        )
        pull = 0.5 * (inverse - np.outer(weights, weights))
        by_length = pull * np.exp(theta[0] - reach) * (5.0 / 3.0) * (1.0 + reach)
        slope = [np.vdot(pull, smooth), *np.einsum("kij,ij->k", scaled, by_length)]
        if self._noisy:
            slope.append(noise * np.trace(pull))
        return float(value), np.array(slope)

    def at_best_variance(self, theta: Array) -> float:
        """Log likelihood of the lengths at the best factor of the covariance, up to a constant."""
        _, _, smooth, noise = self._parts(theta)
        lower = cholesky(self._covariance(smooth, noise), lower=True)
        white = solve_triangular(lower, self._values, lower=True)
        count = len(white)
        return float(-0.5 * count * np.log(white @ white / count) - np.log(np.diag(lower)).sum())

    def _parts(self, theta: Array) -> tuple[Array, Array, Array, float]:
        """Squares of scaled distances by factor, √5 times the distances, covariance, noise."""
        lengths = np.exp(theta[1 : 1 + self.factors])
        scaled = self._squares / lengths[:, None, None] ** 2
        reach = np.sqrt(5.0 * scaled.sum(axis=0))
        smooth = np.exp(theta[0] - reach) * (1.0 + reach + reach**2 / 3.0)
        return scaled, reach, smooth, float(np.exp(theta[-1])) if self._noisy else 0.0

    def _covariance(self, smooth: Array, noise: float) -> Array:
        covariance = smooth.copy()
        covariance[np.diag_indices_from(covariance)] += self._nugget + noise
        return covariance
