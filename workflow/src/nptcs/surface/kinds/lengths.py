"""Length scales that the cases do not determine, and the unbiased variance of a process.

Cases at three levels of a factor hardly show how far a process reaches from one level to the next:
lengths that differ tenfold can be equally likely, and each gives a different interval between the
levels. Predictions are then averaged over both ends of the range of such lengths.
"""

from __future__ import annotations

from itertools import product

import numpy as np
from scipy.linalg import solve_triangular
from scipy.optimize import brentq

from nptcs.arrays import Array
from nptcs.surface.kinds.matern import MaternLikelihood

AS_LIKELY = 0.5
"""Fall of the log likelihood that does not rule a length out: that of one standard error."""


def lengths_as_likely(likelihood: MaternLikelihood, best: Array, bounds: Array) -> Array:
    """Return the hyperparameters that a prediction is averaged over, (c, h); mostly one row.

    A length is undetermined where its lower bound, at which the process reaches no other level, is
    as likely as the best length. It is then taken at both ends of the range that is as likely
    (`AS_LIKELY`), in all combinations with the other such lengths, with equal weights.

    Parameters
    ----------
    likelihood : MaternLikelihood
        Likelihood of the scaled values that the process follows, at the cases in coded units.
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
    """Factor that fits a process's covariance to the residuals of its mean.

    Sum of squares of what the mean's coefficients cannot fit, over m - p: not biased by their
    number (Patterson and Thompson, Biometrika 58, 1971, 545).

    Parameters
    ----------
    lower : ndarray of shape (m, m)
        Cholesky factor of the covariance.
    basis : ndarray of shape (m, p)
        Slopes of the mean with respect to its coefficients.
    residual : ndarray of shape (m,)
    """
    white = solve_triangular(lower, np.column_stack([residual, basis]), lower=True)
    q, _ = np.linalg.qr(white[:, 1:])
    rest = white[:, 0] - q @ (q.T @ white[:, 0])
    return float(rest @ rest) / (len(residual) - basis.shape[1])
