"""Length scales that the cases do not tell, and a process's variance without bias.

Cases at three levels of a factor hardly say how far a process reaches from one level to the next:
lengths that differ tenfold can be equally likely, and each promises another interval between the
levels. Predictions are then averaged over both ends of these lengths.
"""

from __future__ import annotations

from itertools import product

import numpy as np
from scipy.linalg import solve_triangular
from scipy.optimize import brentq

from nptcs.arrays import Array
from nptcs.surface.kinds.matern import MaternLikelihood

AS_LIKELY = 0.5
"""Fall of the log likelihood that is not evidence: that of one standard error of a length."""


def lengths_as_likely(likelihood: MaternLikelihood, best: Array, bounds: Array) -> Array:
    """Return the hyperparameters that a prediction is averaged over, (c, h); one row mostly.

    A length is not told where its lower bound, with which the process reaches no other level, is
    as likely as the best length. It is then taken at both ends of what is as likely (`AS_LIKELY`),
    in all combinations with the other such lengths, with equal weights.

    Parameters
    ----------
    likelihood : MaternLikelihood
        Of the cases in coded units, and of what the process follows, scaled.
    best : ndarray of shape (h,)
        The most likely hyperparameters: variance, n lengths, and what follows them.
    bounds : ndarray of shape (h, 2)
    """
    highest = likelihood.at_best_variance(best)

    def lack(value: float, axis: int) -> float:
        theta = best.copy()
        theta[axis] = value
        return highest - likelihood.at_best_variance(theta) - AS_LIKELY

    choices: list[tuple[float, ...]] = [(value,) for value in best]
    for axis in range(1, 1 + likelihood.factors):
        low, high = bounds[axis]
        if lack(low, axis) > 0.0:
            continue
        if lack(high, axis) > 0.0:
            high = brentq(lack, max(best[axis], low), high, args=(axis,), xtol=1e-3)
        choices[axis] = (low, high)
    return np.array(list(product(*choices)))


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
