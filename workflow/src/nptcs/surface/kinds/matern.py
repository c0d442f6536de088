"""Likelihood of a Matérn 5/2 process, and its slope by the hyperparameters.

A few dozen cases are left out one by one, and each time the hyperparameters are searched again: the
general kernels of scikit-learn spend most of that time on taking themselves apart. Value and slope
are those of scikit-learn's kernel ``ConstantKernel * Matern (+ WhiteKernel)``, which stays the
process's own.
"""

from __future__ import annotations

import numpy as np
from scipy.linalg import cho_factor, cho_solve
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
        Whether the last hyperparameter is the variance of a noise.
    """

    def __init__(self, points: Array, values: Array, nugget: float, noisy: bool) -> None:
        columns = points.T
        self._squares = (columns[:, :, None] - columns[:, None, :]) ** 2
        self._values, self._nugget, self._noisy = values, nugget, noisy

    def __call__(self, theta: Array) -> tuple[float, Array]:
        """Evaluate at the logarithms of variance, n lengths and, if there is one, noise.

        Returns
        -------
        float, ndarray of shape (h,)
            The value and its slope. Where the covariance is not positive definite, no likelihood:
            infinity, without a slope.
        """
        count, factors = len(self._values), len(self._squares)
        variance, lengths = np.exp(theta[0]), np.exp(theta[1 : 1 + factors])
        noise = float(np.exp(theta[-1])) if self._noisy else 0.0
        scaled = self._squares / lengths[:, None, None] ** 2
        reach = np.sqrt(5.0 * scaled.sum(axis=0))
        decay = variance * np.exp(-reach)
        smooth = decay * (1.0 + reach + reach**2 / 3.0)
        covariance = smooth.copy()
        covariance[np.diag_indices(count)] += self._nugget + noise
        try:
            factor = cho_factor(covariance, lower=True)
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
        by_length = pull * decay * (5.0 / 3.0) * (1.0 + reach)
        slope = [np.vdot(pull, smooth), *np.einsum("kij,ij->k", scaled, by_length)]
        if self._noisy:
            slope.append(noise * np.trace(pull))
        return float(value), np.array(slope)
