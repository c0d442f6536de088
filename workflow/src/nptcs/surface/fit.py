"""Least-squares fit of a response surface, in coded units, reported in coded and natural units."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd
from scipy.special import stdtrit

from nptcs.arrays import Array
from nptcs.errors import InputError
from nptcs.surface import least_squares
from nptcs.surface.response_surface import Groups, Outside, box, refuse_unusable, single_cases
from nptcs.terms import Polynomial, coded_to_natural, parse

RANK_TOLERANCE = 1e-9
"""Share of a coded column, outside the space of those before it, below which it is aliased."""


@dataclass(frozen=True)
class Surface:
    """A fitted polynomial.

    Parameters
    ----------
    polynomial : Polynomial
        Terms, in n factors.
    x, y : ndarray of shape (m, n) and (m,)
        The cases that it was fitted to, natural units; their box is its range of validity.
    coefficients_coded, coefficients_natural : ndarray of shape (p,)
        For c = (x - centre)/(half range), and for x itself.
    covariance_coded : ndarray of shape (p, p)
        s² (XᵀX)⁻¹ in coded units. For results of a solver, which have no noise, s² measures what
        the polynomial cannot follow (lack of fit).
    residual_sd : float
        s = √(SSE / (m - p)), in the unit of the response.
    through_origin : bool
        No intercept: c = x / largest |x|, so that the origin stays where it is.
    """

    polynomial: Polynomial
    x: Array
    y: Array
    coefficients_coded: Array
    coefficients_natural: Array
    covariance_coded: Array
    residual_sd: float
    through_origin: bool = False
    outside = Outside.REFUSED

    @property
    def factors(self) -> tuple[str, ...]:
        """Names of the factors."""
        return self.polynomial.factors

    @property
    def coefficients(self) -> int:
        """Number of terms."""
        return len(self.polynomial)

    @property
    def points(self) -> int:
        """Cases that it was fitted to."""
        return len(self.y)

    @property
    def lower(self) -> Array:
        """Smallest value of each factor, shape (n,)."""
        return box(self.x)[0]

    @property
    def upper(self) -> Array:
        """Largest value of each factor, shape (n,)."""
        return box(self.x)[1]

    def coding(self) -> tuple[Array, Array]:
        """Return centre and half range of the coded units, each of shape (n,)."""
        return coding(self.x, self.through_origin)

    def coded(self, x: Array) -> Array:
        """Map natural units, shape (m, n), to coded units, in [-1, 1] inside the box."""
        centre, half = self.coding()
        return (x - centre) / half

    def predict(self, x: Array) -> Array:
        """Evaluate the surface at points in natural units, shape (m, n) → (m,)."""
        return self.polynomial.matrix(self.coded(x)) @ self.coefficients_coded

    def slopes(self, x: Array) -> Array:
        """Differentiate the surface with respect to its coded coefficients, (m, n) → (m, p)."""
        return self.polynomial.matrix(self.coded(x)).astype(float)

    def gradient(self, x: Array, factor: str) -> Array:
        """Evaluate ∂f/∂(factor) in natural units at points of shape (m, n) → (m,)."""
        half = self.coding()[1][self.polynomial.factors.index(factor)]
        matrix = self.polynomial.derivative_matrix(self.coded(x), factor)
        return matrix @ self.coefficients_coded / half

    def prediction_half_width(self, x: Array, confidence: float = 0.95) -> Array:
        """Half width of the prediction interval t·s·√(1 + x₀ᵀ(XᵀX)⁻¹x₀), shape (m, n) → (m,)."""
        matrix = self.polynomial.matrix(self.coded(x))
        variance = np.einsum("ij,jk,ik->i", matrix, self.covariance_coded, matrix)
        factor = stdtrit(self.points - len(self.polynomial), 0.5 + confidence / 2)
        return factor * np.sqrt(variance + self.residual_sd**2)

    def interval(self, x: Array, confidence: float = 0.95) -> tuple[Array, Array]:
        """Bounds of the prediction interval, shape (m, n) → two of (m,)."""
        value, half_width = self.predict(x), self.prediction_half_width(x, confidence)
        return value - half_width, value + half_width

    def refit(self, x: Array, y: Array) -> Surface:
        """Fit the same terms to other cases."""
        return fit_points(x, y, self.polynomial, self.through_origin)

    def groups(self) -> Groups:
        """Tell which cases are left out together: each alone."""
        return single_cases(self.y)

    def content(self) -> dict[str, Any]:
        """Everything that defines the surface, as plain values."""
        return {
            "factors": self.polynomial.factors,
            "exponents": self.polynomial.exponents,
            "terms": self.polynomial.names,
            "x": self.x.tolist(),
            "y": self.y.tolist(),
            "coefficients_coded": self.coefficients_coded.tolist(),
            "coefficients_natural": self.coefficients_natural.tolist(),
            "covariance_coded": self.covariance_coded.tolist(),
            "residual_sd": self.residual_sd,
            "through_origin": self.through_origin,
        }

    def coded_standard_errors(self) -> Array:
        """Return the standard errors of the coded coefficients, shape (p,)."""
        return np.sqrt(np.diag(self.covariance_coded))

    def natural_standard_errors(self) -> Array:
        """Return the standard errors of the natural coefficients, shape (p,)."""
        to_natural = coded_to_natural(self.polynomial, *self.coding()).astype(float)
        return np.sqrt(np.diag(to_natural @ self.covariance_coded @ to_natural.T))


def coding(x: Array, through_origin: bool = False) -> tuple[Array, Array]:
    """Return centre and half range by which cases, shape (m, n), are coded; each of shape (n,)."""
    lower, upper = box(x)
    if through_origin:
        return np.zeros_like(lower), np.abs(x).max(axis=0)
    return (upper + lower) / 2, (upper - lower) / 2


def fit(
    design: pd.DataFrame,
    response: pd.Series,
    factors: Sequence[str],
    terms: Sequence[str],
    through_origin: bool = False,
) -> Surface:
    """Fit a polynomial by ordinary least squares.

    Parameters
    ----------
    design : DataFrame
        One row per case, one column per factor, natural units.
    response : Series
        The response of each case, without gaps.
    factors : sequence of str
        Columns of `design` that are factors.
    terms : sequence of str
        See `nptcs.terms.parse`.
    through_origin : bool
        Fit without an intercept.

    Returns
    -------
    Surface

    Raises
    ------
    InputError
        As `fit_points`, and for terms that cannot be read.

    Examples
    --------
    >>> import pandas as pd
    >>> design = pd.DataFrame({"spacing_mm": [10.0, 12.5, 15.0, 17.5, 20.0]})
    >>> stiffness = 300 - 2 * design["spacing_mm"] + 0.1 * design["spacing_mm"] ** 2
    >>> surface = fit(design, stiffness, ["spacing_mm"], ["1", "spacing_mm", "spacing_mm^2"])
    >>> surface.coefficients_natural.astype(float).round(6).tolist()
    [300.0, -2.0, 0.1]
    >>> surface.predict(np.array([[16.0]])).astype(float).round(6).tolist()
    [293.6]
    """
    polynomial = parse(terms, factors, through_origin)
    x = design[list(factors)].to_numpy(float)
    return fit_points(x, response.to_numpy(float), polynomial, through_origin)


def fit_points(x: Array, y: Array, polynomial: Polynomial, through_origin: bool = False) -> Surface:
    """Fit a polynomial to points of shape (m, n) with responses of shape (m,).

    Coded coefficients and their conversion to natural units are computed with more digits than
    double precision has.

    Raises
    ------
    InputError
        When there are no more cases than terms, when the response has gaps or does not vary, or
        when the design cannot tell terms apart: the aliased terms are named, never fitted by a
        minimum-norm solution.
    """
    refuse_unusable(x, y, polynomial.factors, len(polynomial))
    centre, half = (least_squares.widened(side) for side in coding(x, through_origin))
    matrix = polynomial.matrix((least_squares.widened(x) - centre) / half)
    refuse_aliased(matrix.astype(float), polynomial.names)
    coded, inverse = least_squares.solve(matrix, y)
    residual = (least_squares.widened(y) - matrix @ coded).astype(float)
    residual_sd = float(np.sqrt(residual @ residual / (len(y) - len(polynomial))))
    return Surface(
        polynomial=polynomial,
        x=x,
        y=y,
        coefficients_coded=coded.astype(float),
        coefficients_natural=(coded_to_natural(polynomial, centre, half) @ coded).astype(float),
        covariance_coded=residual_sd**2 * inverse @ inverse.T,
        residual_sd=residual_sd,
        through_origin=through_origin,
    )


def refuse_aliased(matrix: Array, names: Sequence[str]) -> None:
    """Refuse a design matrix, shape (m, p), whose columns depend on each other.

    Raises
    ------
    InputError
        Naming each aliased term with the terms that it cannot be told from.
    """
    kept: list[int] = []
    aliases = []
    for column in range(matrix.shape[1]):
        earlier = matrix[:, kept]
        weights = np.linalg.lstsq(earlier, matrix[:, column])[0]
        rest = matrix[:, column] - earlier @ weights
        if np.linalg.norm(rest) > RANK_TOLERANCE * np.linalg.norm(matrix[:, column]):
            kept.append(column)
            continue
        partners = [names[kept[i]] for i in np.flatnonzero(np.abs(weights) > 1e-6)]
        aliases.append(f"{names[column]} with {' + '.join(partners)}")
    if aliases:
        raise InputError(
            f"the design cannot estimate all {len(names)} terms (rank {len(kept)}); aliased: "
            + "; ".join(aliases),
            column="terms",
            remedy="drop the aliased terms, or give the factor one level more than its "
            "highest power",
        )
