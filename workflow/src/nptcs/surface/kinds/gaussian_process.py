"""A Gaussian process on any mean; it passes through cases that have no noise."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from scipy import stats
from sklearn.gaussian_process import GaussianProcessRegressor
from sklearn.gaussian_process.kernels import ConstantKernel, Kernel, Matern, WhiteKernel

from nptcs.arrays import Array
from nptcs.errors import InputError
from nptcs.likelihood import SearchError, bounds_are_answers, left_out_inflation, maximise
from nptcs.surface.fit import coding
from nptcs.surface.response_surface import (
    Groups,
    Outside,
    ResponseSurface,
    refuse_unusable,
    single_cases,
)

NUGGET = 1e-8
"""Variance added to the diagonal, as a share of the residuals' variance: rounding of results."""

LENGTH_BOUNDS = (0.05, 50.0)
"""Length scales, in half ranges of a factor. A length far below the gap between two levels is an
answer, too: the mean carries the surface between them, and the interval has its whole variance."""

NOISE_BOUNDS = (1e-8, 10.0)
VARIANCE_BOUNDS = (1e-3, 1e3)


@dataclass(frozen=True)
class Weights:
    """What the mean of a fitted process is made of.

    Parameters
    ----------
    centre, half : ndarray of shape (n,)
        Coding of the factors.
    weights : ndarray of shape (m,)
        Of the covariance with each case, in units of `scale`: K⁻¹ residual/scale.
    scale : float
        In the unit of the response.
    inflation : float
        Factor of the standard error.
    """

    centre: Array
    half: Array
    weights: Array
    scale: float
    inflation: float


@dataclass(frozen=True)
class GaussianProcess:
    """A Matérn 5/2 process in coded units that follows the residuals of its mean.

    Parameters
    ----------
    factor_names : tuple of str
        Names of the n factors.
    x, y : ndarray of shape (m, n) and (m,)
        Cases, natural units.
    mean : ResponseSurface or None
        Surface under the process; None: the mean of the responses.
    theta : ndarray
        Logarithms of the hyperparameters: variance, a length for each factor and, where cases
        are repeated with different responses, the noise. Maximum of the likelihood.
    """

    factor_names: tuple[str, ...]
    x: Array
    y: Array
    mean: ResponseSurface | None
    theta: Array
    outside = Outside.REFUSED

    @property
    def factors(self) -> tuple[str, ...]:
        """Names of the factors."""
        return self.factor_names

    @property
    def coefficients(self) -> int:
        """Coefficients of the mean."""
        return self.mean.coefficients if self.mean is not None else 1

    def predict(self, x: Array) -> Array:
        """Evaluate the process at points of shape (m, n) → (m,)."""
        value: Array = self._process.predict(self._coded(x))
        return value * self._scale + self._mean_at(x)

    def interval(self, x: Array, confidence: float = 0.95) -> tuple[Array, Array]:
        """Bounds of the interval of the process, at least as wide as left-out cases ask for."""
        value, deviation = self._process.predict(self._coded(x), return_std=True)
        middle = value * self._scale + self._mean_at(x)
        factor = stats.norm.ppf(0.5 + confidence / 2) * self._scale * self._inflation
        return middle - factor * deviation, middle + factor * deviation

    def refit(self, x: Array, y: Array) -> GaussianProcess:
        """Fit mean and hyperparameters to other cases, from those found here."""
        mean = None
        if self.mean is not None:
            mean = self.mean.refit(x[:, self._mean_columns()], y)
        return _fitted(self.factor_names, x, y, mean, self.theta, restarts=0)

    def groups(self) -> Groups:
        """Tell which cases are left out together: each alone."""
        return single_cases(self.y)

    def content(self) -> dict[str, Any]:
        """Everything that defines the surface except its mean, as plain values."""
        return {
            "factor_names": self.factor_names,
            "x": self.x.tolist(),
            "y": self.y.tolist(),
            "theta": self.theta.tolist(),
        }

    def regressor(self) -> Weights:
        """Return what a program needs that evaluates the process without this package."""
        weights = np.ravel(self._process.alpha_)
        return Weights(*coding(self.x), weights, self._scale, self._inflation)

    def _coded(self, x: Array) -> Array:
        centre, half = coding(self.x)
        return (x - centre) / half

    def _mean_at(self, x: Array) -> Array:
        if self.mean is None:
            return np.full(len(x), self.y.mean())
        return self.mean.predict(x[:, self._mean_columns()])

    def _mean_columns(self) -> list[int]:
        """Columns of the points in the order of the mean's factors."""
        factors = self.factor_names if self.mean is None else self.mean.factors
        return [self.factor_names.index(name) for name in factors]

    @cached_property
    def _residual(self) -> Array:
        return self.y - self._mean_at(self.x)

    @cached_property
    def _scale(self) -> float:
        """Root mean square of the mean's residuals; 1 where there are none."""
        return float(np.sqrt(np.mean(self._residual**2))) or 1.0

    @cached_property
    def _inflation(self) -> float:
        """Factor of the standard error: what cases that are left out show of it, at least 1."""
        return left_out_inflation(self._process)

    @cached_property
    def _process(self) -> GaussianProcessRegressor:
        kernel = kernel_of(self.x, self.y).clone_with_theta(self.theta)
        process = GaussianProcessRegressor(kernel, alpha=NUGGET, optimizer=None)
        return process.fit(self._coded(self.x), self._residual / self._scale)


def fit_process(
    x: Array,
    y: Array,
    factors: tuple[str, ...],
    fit_mean: Callable[[], ResponseSurface] | None = None,
) -> GaussianProcess:
    """Fit a Gaussian process to points of shape (m, n) with responses of shape (m,).

    Parameters
    ----------
    x, y, factors
        Cases and the names of the columns of `x`.
    fit_mean : callable, optional
        Fits the surface under the process to the same cases.

    Raises
    ------
    InputError
        When a factor has one level only or the response has gaps or does not vary, and as the
        mean does.
    """
    refuse_unusable(x, y, factors, x.shape[1] + 1)
    mean = fit_mean() if fit_mean is not None else None
    return _fitted(factors, x, y, mean, kernel_of(x, y).theta, restarts=3)


def kernel_of(x: Array, y: Array) -> Kernel:
    """Matérn 5/2 with a length for each factor, and noise if equal cases differ in response."""
    kernel = ConstantKernel(1.0, VARIANCE_BOUNDS) * Matern(np.ones(x.shape[1]), LENGTH_BOUNDS, 2.5)
    places, place = np.unique(x, axis=0, return_inverse=True)
    spread = [np.ptp(y[place.ravel() == number]) for number in range(len(places))]
    noisy = max(spread) > 1e-6 * np.ptp(y)
    return kernel + WhiteKernel(1e-2, NOISE_BOUNDS) if noisy else kernel


def _fitted(
    factors: tuple[str, ...],
    x: Array,
    y: Array,
    mean: ResponseSurface | None,
    theta: Array,
    restarts: int,
) -> GaussianProcess:
    """Maximise the likelihood from given hyperparameters and from random ones (fixed seed)."""
    kernel = kernel_of(x, y)
    start = theta if len(theta) == len(kernel.theta) else kernel.theta
    draft = GaussianProcess(factors, x, y, mean, start)
    process = GaussianProcessRegressor(
        kernel.clone_with_theta(start),
        alpha=NUGGET,
        optimizer=maximise,
        n_restarts_optimizer=restarts,
        random_state=0,
    )
    try:
        with bounds_are_answers():
            process.fit(draft._coded(x), draft._residual / draft._scale)
    except SearchError as error:
        raise InputError(
            str(error), column="surfaces", remedy="leave this surface out, or change its mean"
        ) from None
    return GaussianProcess(factors, x, y, mean, np.asarray(process.kernel_.theta))
