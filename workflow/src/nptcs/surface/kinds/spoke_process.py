"""A surface for spokes that carry several rings: polynomials of the ring, processes of the spoke.

A study in which each spoke is solved with several rubbers of the shear band has cases in groups. On
one spoke the logarithm of a response is a polynomial of low degree in the logarithms of the other
factors (the shear band's C10); its coefficients, in principal components, are Gaussian processes
over the spoke's `spoke_features`, in which its stiffness is smooth. The stated error covers spokes
that were not solved, and the surface is tested by leaving out whole spokes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.special import ndtri

from nptcs.arrays import Array, Index
from nptcs.errors import InputError
from nptcs.likelihood import SearchError, bounds_are_answers, left_out_inflation, maximise
from nptcs.spoke_features import spoke_features
from nptcs.surface.response_surface import Groups, Outside, refuse_unusable

if TYPE_CHECKING:
    from sklearn.gaussian_process import GaussianProcessRegressor
    from sklearn.gaussian_process.kernels import Kernel

SPOKE = ("spacing_mm", "thickness_mm", "angle_deg", "spoke_c10_mpa")
FEWEST_SPOKES = 20
SHARE_KEPT = 1e-7
"""Principal components below this share of the largest singular value are rounding."""

STARTS = (1.0, 5.0, 30.0)
"""Lengths from which the search for hyperparameters starts: the likelihood has local maxima."""

LENGTH_BOUNDS = (0.1, 1e4)
"""Length scales, in standard deviations of a feature."""

VARIANCE_BOUNDS = (1e-3, 1e8)
NOISE_BOUNDS = (1e-12, 1e-2)
"""Noise of a component as a share of its variance: the tables' own misfit."""


@dataclass(frozen=True)
class ComponentWeights:
    """What one principal component of the spokes is predicted with.

    Parameters
    ----------
    weights : ndarray of shape (g,)
        Weights of the covariance with each spoke, in units of `spread`.
    middle, spread : float
        Mean and standard deviation of the component over the spokes.
    inflation : float
        Factor of its standard error.
    nugget : float
        Added to the diagonal of the covariance.
    """

    weights: Array
    middle: float
    spread: float
    inflation: float
    nugget: float


@dataclass(frozen=True)
class SpokeParts:
    """What a fitted `SpokeProcess` predicts with; g spokes, k terms on one spoke, c components.

    Parameters
    ----------
    ring_columns : sequence of int
        Columns of the ring's factors.
    exponents : sequence of tuple of int
        Degrees of the Legendre products on one spoke.
    low, high : ndarray
        Logarithms that are coded to -1 and 1.
    mean, directions : ndarray of shape (k,) and (c, k)
        Mean and principal directions of the coefficients on one spoke.
    misfit : float
        Root mean square misfit on the spokes.
    middle, spread : ndarray of shape (f,)
        Scaling of the spokes' features.
    unit : ndarray of shape (g, f)
        Scaled features of the spokes.
    processes : tuple of ComponentWeights
    """

    ring_columns: Sequence[int]
    exponents: Sequence[tuple[int, ...]]
    low: Array
    high: Array
    mean: Array
    directions: Array
    misfit: float
    middle: Array
    spread: Array
    unit: Array
    processes: tuple[ComponentWeights, ...]


@dataclass(frozen=True)
class SpokeProcess:
    """A fitted surface of spokes and rings.

    Parameters
    ----------
    factor_names : tuple of str
        Names of the n factors; the four of `SPOKE` and at least one more.
    x, y : ndarray of shape (m, n) and (m,)
        Cases, natural units. Cases that share a spoke agree in the factors of `SPOKE`.
    ply : mapping of str to float
        ``e1_mpa, e2_mpa, nu12, g12_mpa`` of the plates' ply.
    degree : int
        Total degree of the polynomial on one spoke.
    theta : ndarray of shape (components, hyperparameters)
        Logarithms of the hyperparameters: variance, a length for each feature, noise.
    """

    factor_names: tuple[str, ...]
    x: Array
    y: Array
    ply: Mapping[str, float]
    degree: int
    theta: Array
    outside = Outside.REFUSED

    @property
    def factors(self) -> tuple[str, ...]:
        """Names of the factors."""
        return self.factor_names

    @property
    def coefficients(self) -> int:
        """Coefficients of the polynomial on one spoke."""
        return len(self._exponents)

    @property
    def logarithmic(self) -> bool:
        """Whether the logarithm of the response is modelled: where all responses are positive."""
        return bool((self.y > 0).all())

    def predict(self, x: Array) -> Array:
        """Evaluate the surface at points of shape (m, n) → (m,)."""
        mean = self._moments(x, errors=False)[0]
        return np.exp(mean) if self.logarithmic else mean

    def interval(self, x: Array, confidence: float = 0.95) -> tuple[Array, Array]:
        """Bounds of the prediction interval, two of shape (m,): processes and misfit."""
        mean, deviation = self._moments(x, errors=True)
        half_width = ndtri(0.5 + confidence / 2) * deviation
        low, high = mean - half_width, mean + half_width
        return (np.exp(low), np.exp(high)) if self.logarithmic else (low, high)

    def refit(self, x: Array, y: Array) -> SpokeProcess:
        """Fit to other cases; the hyperparameters are kept, all else is fitted again."""
        other = SpokeProcess(self.factor_names, x, y, self.ply, self.degree, self.theta)
        return other.checked()

    def groups(self) -> Groups:
        """Tell which cases are left out together: those that share a spoke."""
        return Groups(self._spokes[1], "all cases that share a spoke")

    def content(self) -> dict[str, Any]:
        """Everything that defines the surface, as plain values."""
        return {
            "factor_names": self.factor_names,
            "x": self.x.tolist(),
            "y": self.y.tolist(),
            "ply": dict(self.ply),
            "degree": self.degree,
            "theta": self.theta.tolist(),
        }

    def checked(self) -> SpokeProcess:
        """Return the surface itself, or refuse cases to which it cannot be fitted.

        Raises
        ------
        InputError
            If there are too few spokes, or a spoke has too few cases for its polynomial.
        """
        designs, spoke = self._spokes
        if len(designs) < FEWEST_SPOKES:
            raise InputError(
                f"{len(designs)} spokes are too few for a surface over spokes",
                column="surfaces",
                remedy=f"solve {FEWEST_SPOKES} spokes or more (design split_plot)",
            )
        matrix = self._ring_matrix(self.x)
        for number, design in enumerate(designs):
            own = matrix[spoke == number]
            if np.linalg.matrix_rank(own) < own.shape[1]:
                values = ", ".join(
                    f"{name} {value:.6g}" for name, value in zip(SPOKE, design, strict=True)
                )
                raise InputError(
                    f"a spoke has {len(own)} solved cases, which cannot determine the "
                    f"{own.shape[1]} terms of its polynomial",
                    column="surfaces",
                    specimen=values,
                    remedy="solve more cases on each spoke, lower the degree, or narrow the range "
                    "of the factors until no case fails",
                )
        return self

    def parts(self) -> SpokeParts:
        """Return what a program needs to evaluate the surface without this package."""
        logarithms = np.log(self.x[:, self._ring_columns])
        mean, directions = self._components
        middle, spread = self._scaling
        processes = tuple(
            ComponentWeights(
                weights=np.ravel(process.alpha_),
                middle=float(np.ravel(process._y_train_mean)[0]),
                spread=float(np.ravel(process._y_train_std)[0]),
                inflation=inflation,
                nugget=float(process.alpha),
            )
            for process, inflation in zip(self._processes, self._inflation, strict=True)
        )
        return SpokeParts(
            ring_columns=self._ring_columns,
            exponents=self._exponents,
            low=logarithms.min(axis=0),
            high=logarithms.max(axis=0),
            mean=mean,
            directions=directions,
            misfit=self._on_spokes[1],
            middle=middle,
            spread=spread,
            unit=self._unit(self._spokes[0]),
            processes=processes,
        )

    def _columns(self, names: Sequence[str]) -> list[int]:
        return [self.factor_names.index(name) for name in names]

    @cached_property
    def _ring_columns(self) -> list[int]:
        return self._columns([name for name in self.factor_names if name not in SPOKE])

    @cached_property
    def _exponents(self) -> list[tuple[int, ...]]:
        powers = product(range(self.degree + 1), repeat=len(self._ring_columns))
        return [each for each in powers if sum(each) <= self.degree]

    @cached_property
    def _spokes(self) -> tuple[Array, Index]:
        """Designs (g, 4) of the spokes, and the number of each case's spoke (m,)."""
        designs, spoke = np.unique(
            self.x[:, self._columns(SPOKE)].round(9), axis=0, return_inverse=True
        )
        return designs, np.asarray(spoke).ravel()

    def _ring_matrix(self, x: Array) -> Array:
        """Legendre products (m, terms) of the ring's factors, logarithms coded to [-1, 1]."""
        logarithm = np.log(x[:, self._ring_columns])
        ends = np.log(self.x[:, self._ring_columns])
        low, high = ends.min(axis=0), ends.max(axis=0)
        coded = (2 * logarithm - low - high) / (high - low)
        lines = np.polynomial.legendre.legvander(coded, self.degree)
        return np.stack(
            [
                np.prod([lines[:, axis, power] for axis, power in enumerate(powers)], axis=0)
                for powers in self._exponents
            ],
            axis=1,
        )

    @cached_property
    def _on_spokes(self) -> tuple[Array, float]:
        """Coefficients (g, terms) of each spoke, and the rms misfit of all cases."""
        designs, spoke = self._spokes
        target = np.log(self.y) if self.logarithmic else self.y
        matrix = self._ring_matrix(self.x)
        found, squares = [], 0.0
        for number in range(len(designs)):
            own, y = matrix[spoke == number], target[spoke == number]
            coefficients = np.linalg.lstsq(own, y)[0]
            squares += float(np.sum((y - own @ coefficients) ** 2))
            found.append(coefficients)
        freedom = max(len(self.y) - len(found) * matrix.shape[1], 1)
        return np.array(found), float(np.sqrt(squares / freedom))

    @cached_property
    def _components(self) -> tuple[Array, Array]:
        """Mean (terms,) of the coefficients and their principal directions (components, terms)."""
        coefficients = self._on_spokes[0]
        mean = coefficients.mean(axis=0)
        _, sizes, directions = np.linalg.svd(coefficients - mean, full_matrices=False)
        count = len(self.theta) or int(np.sum(sizes > SHARE_KEPT * sizes[0]))
        return mean, directions[:count]

    @cached_property
    def _scaling(self) -> tuple[Array, Array]:
        features = _features(self._spokes[0], self.ply)
        spread = features.std(axis=0)
        return features.mean(axis=0), np.where(spread > 0, spread, 1.0)

    def _unit(self, designs: Array) -> Array:
        middle, spread = self._scaling
        return (_features(designs, self.ply) - middle) / spread

    def _scores(self) -> Array:
        """Principal components (g, components) of the spokes."""
        mean, directions = self._components
        return (self._on_spokes[0] - mean) @ directions.T

    @cached_property
    def _processes(self) -> list[GaussianProcessRegressor]:
        from sklearn.gaussian_process import GaussianProcessRegressor

        unit, scores = self._unit(self._spokes[0]), self._scores()
        kernels = [_kernel(unit.shape[1]).clone_with_theta(theta) for theta in self.theta]
        return [
            GaussianProcessRegressor(kernel, optimizer=None, normalize_y=True).fit(unit, score)
            for kernel, score in zip(kernels, scores.T, strict=True)
        ]

    @cached_property
    def _inflation(self) -> list[float]:
        """Factor of each process's standard error that left-out spokes require."""
        return [left_out_inflation(process) for process in self._processes]

    def _moments(self, x: Array, errors: bool) -> tuple[Array, Array]:
        """Mean and standard deviation of the (logarithm of the) response at points (m, n)."""
        designs, place = np.unique(x[:, self._columns(SPOKE)], axis=0, return_inverse=True)
        unit, ring = self._unit(designs), self._ring_matrix(x)
        mean, directions = self._components
        weights = ring @ directions.T
        value, variance = ring @ mean, np.full(len(x), self._on_spokes[1] ** 2)
        for process, weight, factor in zip(
            self._processes, weights.T, self._inflation, strict=True
        ):
            if errors:
                score, deviation = process.predict(unit, return_std=True)
                variance += (factor * weight * deviation[place.ravel()]) ** 2
            else:
                score = process.predict(unit)
            value += weight * score[place.ravel()]
        return value, np.sqrt(variance)


def fit_spoke_process(
    x: Array, y: Array, factors: Sequence[str], ply: Mapping[str, float] | None, degree: int
) -> SpokeProcess:
    """Fit the surface; the processes' hyperparameters maximise the likelihood.

    Parameters
    ----------
    x, y : ndarray of shape (m, n) and (m,)
        Cases in the order of `factors`, natural units.
    factors : sequence of str
        The four of `SPOKE` and others, in any order.
    ply : mapping of str to float or None
        Constants of the plates' ply.
    degree : int
        Degree of the polynomial on one spoke.

    Raises
    ------
    InputError
        For other factors, a ply that is missing, values that are not positive, or cases to which
        it cannot be fitted.
    """
    others = [name for name in factors if name not in SPOKE]
    if not set(SPOKE) <= set(factors) or not others:
        raise InputError(
            f"a surface over spokes has the factors {', '.join(SPOKE)} and at least one of the "
            "ring, such as shear_band_c10_mpa",
            column="surfaces",
            value=", ".join(factors),
            remedy="leave it out of this study",
        )
    if ply is None:
        raise InputError(
            "a surface over spokes needs the constants of the plates' ply",
            column="surfaces",
            remedy="give the specimens of a ply, or leave the surface out",
        )
    refuse_unusable(x, y, factors, degree + 1)
    positive = [name for name in factors if name != "angle_deg"]
    columns = [list(factors).index(name) for name in positive]
    if (x[:, columns] <= 0).any():
        raise InputError(
            "a surface over spokes needs positive factors",
            column=", ".join(positive),
            value=float(x[:, columns].min()),
            remedy="correct the cases",
        )
    own_ply = {name: ply[name] for name in ("e1_mpa", "e2_mpa", "nu12", "g12_mpa")}
    draft = SpokeProcess(tuple(factors), x, y, own_ply, degree, np.empty((0, 0))).checked()
    unit, scores = draft._unit(draft._spokes[0]), draft._scores()
    theta = np.array([_fitted_theta(unit, score) for score in scores.T])
    return SpokeProcess(tuple(factors), x, y, own_ply, degree, theta)


def _features(designs: Array, ply: Mapping[str, float]) -> Array:
    """`spoke_features` of designs (g, 4); the number of plates grows as 1/spacing does."""
    plates = 1.0 / designs[:, :1]
    return spoke_features(np.hstack([plates, designs[:, 1:]]), ply)


def _kernel(features: int, length: float = 1.0) -> Kernel:
    from sklearn.gaussian_process.kernels import RBF, ConstantKernel, WhiteKernel

    smooth = ConstantKernel(1.0, VARIANCE_BOUNDS) * RBF(np.full(features, length), LENGTH_BOUNDS)
    return smooth + WhiteKernel(1e-6, NOISE_BOUNDS)


def _fitted_theta(unit: Array, score: Array) -> Array:
    """Hyperparameters with the largest likelihood that the searches from all starts find."""
    from sklearn.gaussian_process import GaussianProcessRegressor

    found: list[tuple[float, Array]] = []
    fault = ""
    for length in STARTS:
        process = GaussianProcessRegressor(
            _kernel(unit.shape[1], length), optimizer=maximise, normalize_y=True
        )
        try:
            with bounds_are_answers():
                process.fit(unit, score)
        except SearchError as error:
            fault = str(error)
            continue
        found.append((process.log_marginal_likelihood_value_, process.kernel_.theta))
    if not found:
        raise InputError(
            fault, column="surfaces", remedy="leave this surface out, or solve more spokes"
        )
    return np.asarray(max(found, key=lambda one: one[0])[1])
