"""The search for a Gaussian process's hyperparameters, whether it has converged, and its errors.

scikit-learn has one class of warning for two different things: a hyperparameter on its bound, which
is an answer (a factor without effect, no noise), and a search that stopped early, which is not.
Here such a search continues with another method, and one that does not converge is an error.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.linalg import cho_solve
from scipy.optimize import minimize

from nptcs.arrays import Array

if TYPE_CHECKING:
    from sklearn.gaussian_process import GaussianProcessRegressor

ARRIVED = 1e-3
"""Slope of the log likelihood that counts as zero, by the log of a hyperparameter off its bounds:
a change of a length by one per cent then changes the likelihood by 1e-5 of itself."""


class SearchError(RuntimeError):
    """No maximum of the likelihood was found."""


def maximise(objective: Callable[..., Any], start: Array, bounds: Array) -> tuple[Array, float]:
    """Minimise minus the log likelihood, as scikit-learn's `optimizer` does.

    Parameters
    ----------
    objective : callable
        Hyperparameters (n,) to the value and its slope (n,).
    start : ndarray of shape (n,)
    bounds : ndarray of shape (n, 2)

    Raises
    ------
    SearchError
        If two methods both stop away from a maximum.
    """
    best = minimize(objective, start, method="L-BFGS-B", jac=True, bounds=bounds)
    if not best.success:
        other = minimize(objective, best.x, method="TNC", jac=True, bounds=bounds)
        best = other if other.fun <= best.fun else best
    if not best.success and free_slope(objective, best.x, bounds) > ARRIVED * (1 + abs(best.fun)):
        raise SearchError(f"the search for hyperparameters stopped early: {best.message}")
    return best.x, float(best.fun)


def free_slope(objective: Callable[..., Any], theta: Array, bounds: Array) -> float:
    """Largest absolute slope at a point, without those that lead out of the bounds."""
    slope = np.asarray(objective(theta)[1], dtype=float)
    edge = 1e-8 * (bounds[:, 1] - bounds[:, 0])
    held = ((theta <= bounds[:, 0] + edge) & (slope > 0)) | (
        (theta >= bounds[:, 1] - edge) & (slope < 0)
    )
    return float(np.abs(np.where(held, 0.0, slope)).max())


def left_out_inflation(process: GaussianProcessRegressor) -> float:
    """Factor on a fitted process's standard error, from its errors at cases that are left out.

    With the hyperparameters kept, the error at a left-out case in standard errors is
    (K⁻¹y)ᵢ/√(K⁻¹)ᵢᵢ (Rasmussen and Williams, 2006, section 5.4.2); its rms, at least 1.
    """
    inverse = cho_solve((process.L_, True), np.eye(len(process.L_)))
    scores = np.ravel(process.alpha_) / np.sqrt(np.diag(inverse))
    return max(1.0, float(np.sqrt(np.mean(scores**2))))


@contextmanager
def bounds_are_answers() -> Iterator[None]:
    """Silence scikit-learn's remark that a hyperparameter lies on its bound, and nothing else."""
    from sklearn.exceptions import ConvergenceWarning

    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", "The optimal value found.*bound", ConvergenceWarning)
        yield
