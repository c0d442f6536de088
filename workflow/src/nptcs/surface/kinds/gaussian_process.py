"""A Gaussian process on any mean; it passes through cases that have no noise."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from scipy.linalg import cho_solve, cholesky
from scipy.special import stdtrit

from nptcs.arrays import Array
from nptcs.errors import InputError
from nptcs.likelihood import SearchError, maximise
from nptcs.surface.fit import Surface, coding
from nptcs.surface.kinds.lamination import Lamination
from nptcs.surface.kinds.lengths import lengths_as_likely, restricted_variance
from nptcs.surface.kinds.linked import LinkedSurface
from nptcs.surface.kinds.matern import MaternLikelihood, covariance
from nptcs.surface.response_surface import Groups, Outside, refuse_unusable, single_cases

MeanSurface = Surface | LinkedSurface | Lamination
"""Surfaces that can be the mean of a process: they have slopes with respect to coefficients."""

NUGGET = 1e-8
"""Variance added to the diagonal, as a share of the residuals' variance, for rounded results."""

LENGTH_BOUNDS = (0.05, 50.0)
"""Length scales, in half ranges of a factor. A length far below the gap between two levels is a
valid answer: between them the surface follows its mean, and the interval has the full variance."""

NOISE_BOUNDS = (1e-8, 10.0)
VARIANCE_BOUNDS = (1e-3, 1e3)

FIRST_NOISE = 1e-2
"""Variance of the noise at which the first search starts; variance and lengths start from 1."""

SAME_RESPONSE = 1e-6
"""Difference between equal cases, as a share of the response's range, up to which there is no
noise."""

RESTARTS = 3
"""Searches from random hyperparameters, besides the one from lengths of a half range."""


@dataclass(frozen=True)
class Component:
    """A process with one choice of lengths; a prediction is the average over such components.

    Parameters
    ----------
    theta : ndarray of shape (h,)
        Logarithms of its hyperparameters; the variance is not biased by the fitted mean.
    lower : ndarray of shape (m, m)
        Cholesky factor of the covariance of the cases.
    weights : ndarray of shape (m,)
        K⁻¹ of the scaled residuals.
    mean_covariance : ndarray of shape (p, p)
        Covariance of the mean's coefficients, found by least squares from residuals that vary as
        the process does: B K Bᵀ with the pseudo-inverse B of the mean's slopes, in units of
        `scale`.
    """

    theta: Array
    lower: Array
    weights: Array
    mean_covariance: Array


@dataclass(frozen=True)
class Weights:
    """What a program needs to evaluate a process without this package.

    Parameters
    ----------
    centre, half : ndarray of shape (n,)
        Coding of the factors.
    components : tuple of Component
    scale : float
        Scale of weights and variances, in the unit of the response.
    factor : float
        Half width of the 95 % interval in standard deviations.
    """

    centre: Array
    half: Array
    components: tuple[Component, ...]
    scale: float
    factor: float


@dataclass(frozen=True)
class GaussianProcess:
    """A Matérn 5/2 process in coded units that follows the residuals of its mean.

    Its error has three parts: that of the process away from the cases, that of the mean's
    coefficients, and that of lengths that the cases do not determine (`lengths`).

    Parameters
    ----------
    factor_names : tuple of str
        Names of the n factors.
    x, y : ndarray of shape (m, n) and (m,)
        Cases, natural units.
    mean : Surface, LinkedSurface, Lamination or None
        Surface under the process; None: the mean of the responses.
    theta : ndarray of shape (h,)
        Logarithms of the most likely hyperparameters: variance, a length for each factor and,
        where cases are repeated with different responses, the noise.
    spread : ndarray of shape (c, h)
        Hyperparameters that predictions are averaged over, relative to `theta`.
    """

    factor_names: tuple[str, ...]
    x: Array
    y: Array
    mean: MeanSurface | None
    theta: Array
    spread: Array
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
        coded, points = self._coded(x), self._points
        rise = [covariance(one.theta, coded, points) @ one.weights for one in self._components]
        return self._scale * np.mean(rise, axis=0) + self._mean_at(x)

    def interval(self, x: Array, confidence: float = 0.95) -> tuple[Array, Array]:
        """Bounds of the prediction interval, at least as wide as left-out cases require."""
        coded, slopes = self._coded(x), self._slopes(x)
        found = [self._moments(one, coded, slopes) for one in self._components]
        means, variances = np.array([m for m, _ in found]), np.array([v for _, v in found])
        deviation = np.sqrt(variances.mean(axis=0) + means.var(axis=0))
        middle = self._scale * means.mean(axis=0) + self._mean_at(x)
        half = self._factor(confidence) * self._scale * deviation
        return middle - half, middle + half

    def refit(self, x: Array, y: Array) -> GaussianProcess:
        """Fit mean and hyperparameters to other cases, starting from those found here.

        The set of undetermined lengths and their range are kept.
        """
        mean = None
        if self.mean is not None:
            mean = self.mean.refit(x[:, self._mean_columns()], y)
        return _fitted(self.factor_names, x, y, mean, self.theta, self.spread)

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
            "spread": self.spread.tolist(),
        }

    def regressor(self) -> Weights:
        """Return what a program needs to evaluate the process without this package."""
        return Weights(*coding(self.x), self._components, self._scale, self._factor(0.95))

    def _factor(self, confidence: float) -> float:
        """Half width of the interval in standard deviations.

        Student's t, because the variance is estimated from the cases, times the factor that
        left-out cases require.
        """
        freedom = len(self.y) - self.coefficients
        return float(stdtrit(freedom, 0.5 + confidence / 2)) * self._inflation

    def _moments(self, one: Component, coded: Array, slopes: Array) -> tuple[Array, Array]:
        """Mean and variance of a component over the mean surface, scaled, two of shape (m,)."""
        near = covariance(one.theta, coded, self._points)
        solved = cho_solve((one.lower, True), near.T)
        own = np.exp(one.theta[0]) + self._noise(one.theta)
        alone = np.maximum(own - np.einsum("ij,ji->i", near, solved), 0.0)
        lever = slopes - solved.T @ self._basis
        by_mean = np.einsum("ij,jk,ik->i", lever, one.mean_covariance, lever)
        return near @ one.weights, alone + np.maximum(by_mean, 0.0)

    def _coded(self, x: Array) -> Array:
        centre, half = coding(self.x)
        return (x - centre) / half

    def _mean_at(self, x: Array) -> Array:
        if self.mean is None:
            return np.full(len(x), self.y.mean())
        return self.mean.predict(x[:, self._mean_columns()])

    def _slopes(self, x: Array) -> Array:
        if self.mean is None:
            return np.ones((len(x), 1))
        return self.mean.slopes(x[:, self._mean_columns()])

    def _mean_columns(self) -> list[int]:
        """Columns of the points in the order of the mean's factors."""
        factors = self.factor_names if self.mean is None else self.mean.factors
        return [self.factor_names.index(name) for name in factors]

    @cached_property
    def _points(self) -> Array:
        return self._coded(self.x)

    @cached_property
    def _basis(self) -> Array:
        """Slopes of the mean at the cases."""
        return self._slopes(self.x)

    @cached_property
    def _residual(self) -> Array:
        return self.y - self._mean_at(self.x)

    @cached_property
    def _scale(self) -> float:
        """Root mean square of the mean's residuals; 1 where there are none."""
        return float(np.sqrt(np.mean(self._residual**2))) or 1.0

    @cached_property
    def _components(self) -> tuple[Component, ...]:
        return tuple(self._component(self.theta + shift) for shift in self.spread)

    def _component(self, theta: Array) -> Component:
        factors, residual = self.x.shape[1], self._residual / self._scale
        theta = np.clip(theta, *bounds_of(factors, len(theta) > 1 + factors).T)
        theta = theta + np.log(
            restricted_variance(self._lower(theta), self._basis, residual)
        ) * _of_variance(theta, factors)
        lower = self._lower(theta)
        spread = self._basis_inverse @ lower
        return Component(theta, lower, cho_solve((lower, True), residual), spread @ spread.T)

    @cached_property
    def _basis_inverse(self) -> Array:
        """Pseudo-inverse of the mean's slopes, whose columns may differ in size."""
        sizes = np.linalg.norm(self._basis, axis=0)
        sizes[sizes == 0] = 1.0
        inverse: Array = np.linalg.pinv(self._basis / sizes, rcond=1e-12) / sizes[:, None]
        return inverse

    def _lower(self, theta: Array) -> Array:
        spread = covariance(theta, self._points, self._points)
        spread[np.diag_indices_from(spread)] += NUGGET + self._noise(theta)
        lower: Array = cholesky(spread, lower=True)
        return lower

    def _noise(self, theta: Array) -> float:
        """Variance of a case's own noise; zero where there is none."""
        return float(np.exp(theta[-1])) if len(theta) > 1 + self.x.shape[1] else 0.0

    @cached_property
    def _inflation(self) -> float:
        """Factor of the standard error that left-out cases require, at least 1.

        With the hyperparameters and the mean kept, the error at a left-out case in standard errors
        is (K⁻¹y)ᵢ/√(K⁻¹)ᵢᵢ (Rasmussen and Williams, 2006, section 5.4.2); its rms.
        """
        scores = []
        for one in self._components:
            inverse = cho_solve((one.lower, True), np.eye(len(one.lower)))
            scores.append(one.weights / np.sqrt(np.diag(inverse)))
        return max(1.0, float(np.sqrt(np.mean(np.square(scores)))))


def fit_process(
    x: Array,
    y: Array,
    factors: tuple[str, ...],
    fit_mean: Callable[[], MeanSurface] | None = None,
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
        When a factor has only one level, the response has gaps or does not vary, or the mean
        cannot be fitted.
    """
    refuse_unusable(x, y, factors, x.shape[1] + 1)
    mean = fit_mean() if fit_mean is not None else None
    return _fitted(factors, x, y, mean)


def bounds_of(factors: int, noisy: bool) -> Array:
    """Bounds of the logarithms of variance, a length for each factor and, if any, noise, (h, 2)."""
    return np.log([VARIANCE_BOUNDS, *[LENGTH_BOUNDS] * factors, *[NOISE_BOUNDS] * noisy])


def has_noise(x: Array, y: Array) -> bool:
    """Tell whether equal cases, of shape (m, n), differ in their responses of shape (m,)."""
    order = np.lexsort(x.T)
    same = (np.diff(x[order], axis=0) == 0).all(axis=1)
    if not same.any():
        return False
    starts = np.flatnonzero(np.concatenate([[True], ~same]))
    values = y[order]
    ranges = np.maximum.reduceat(values, starts) - np.minimum.reduceat(values, starts)
    return bool(ranges.max() > SAME_RESPONSE * np.ptp(y))


def _fitted(
    factors: tuple[str, ...],
    x: Array,
    y: Array,
    mean: MeanSurface | None,
    theta: Array | None = None,
    spread: Array | None = None,
) -> GaussianProcess:
    """Search for the most likely hyperparameters from given or random starts (fixed seed)."""
    noisy = has_noise(x, y)
    bounds = bounds_of(x.shape[1], noisy)
    first = np.log([1.0] * (1 + x.shape[1]) + [FIRST_NOISE] * noisy)
    given = theta is not None and len(theta) == len(first)
    start = theta if theta is not None and given else first
    draft = GaussianProcess(factors, x, y, mean, start, np.zeros((1, len(start))))
    points, residual = draft._points, draft._residual / draft._scale
    likelihood = MaternLikelihood(points, residual, NUGGET, noisy)
    generator = np.random.RandomState(0)
    starts: list[Array] = [start]
    if not given:
        starts += [np.asarray(generator.uniform(*bounds.T)) for _ in range(RESTARTS)]
    try:
        found = [maximise(likelihood, one, bounds) for one in starts]
    except SearchError as error:
        raise InputError(
            str(error), column="surfaces", remedy="leave this surface out, or change its mean"
        ) from None
    best = min(found, key=lambda one: one[1])[0]
    if spread is None or not given:
        spread = lengths_as_likely(likelihood, best, bounds) - best
    return GaussianProcess(factors, x, y, mean, best, spread)


def _of_variance(theta: Array, factors: int) -> Array:
    """One where a hyperparameter is a variance, zero where it is a length."""
    kind = np.ones_like(theta)
    kind[1 : 1 + factors] = 0.0
    return kind
