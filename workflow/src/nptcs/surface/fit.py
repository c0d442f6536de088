"""Least-squares fit of a response surface, in coded units, reported in both."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd
from scipy import linalg, stats

from nptcs.arrays import Array
from nptcs.errors import InputError
from nptcs.surface.terms import Polynomial, coded_to_natural, parse

RANK_TOLERANCE = 1e-9
"""Share of a coded column, outside the space of those before it, below which it is aliased."""


@dataclass(frozen=True)
class Surface:
    """A fitted response surface.

    Parameters
    ----------
    polynomial : Polynomial
        Terms, in n factors.
    lower, upper : ndarray of shape (n,)
        Range of validity: the smallest and largest level of each factor.
    coefficients_coded, coefficients_natural : ndarray of shape (p,)
        For c = (x - centre)/half range, and for x itself.
    covariance_coded : ndarray of shape (p, p)
        s² (XᵀX)⁻¹ in coded units. For results of a solver, which have no noise, s² measures what
        the polynomial cannot follow (lack of fit).
    points : int
        Cases that it was fitted to.
    residual_sd : float
        s = √(SSE / (points - p)), in the unit of the response.
    """

    polynomial: Polynomial
    lower: Array
    upper: Array
    coefficients_coded: Array
    coefficients_natural: Array
    covariance_coded: Array
    points: int
    residual_sd: float

    def coded(self, x: Array) -> Array:
        """Map natural units, shape (m, n), to coded units in [-1, 1]."""
        return (x - (self.upper + self.lower) / 2) / ((self.upper - self.lower) / 2)

    def predict(self, x: Array) -> Array:
        """Evaluate the surface at points in natural units, shape (m, n) → (m,)."""
        return self.polynomial.matrix(self.coded(x)) @ self.coefficients_coded

    def gradient(self, x: Array, factor: str) -> Array:
        """Evaluate ∂f/∂(factor) in natural units at points of shape (m, n) → (m,)."""
        axis = self.polynomial.factors.index(factor)
        half = (self.upper[axis] - self.lower[axis]) / 2
        matrix = self.polynomial.derivative_matrix(self.coded(x), factor)
        return matrix @ self.coefficients_coded / half

    def prediction_half_width(self, x: Array, confidence: float = 0.95) -> Array:
        """Half width of the prediction interval t·s·√(1 + x₀ᵀ(XᵀX)⁻¹x₀), shape (m, n) → (m,)."""
        matrix = self.polynomial.matrix(self.coded(x))
        variance = np.einsum("ij,jk,ik->i", matrix, self.covariance_coded, matrix)
        factor = stats.t.ppf(0.5 + confidence / 2, self.points - len(self.polynomial))
        return factor * np.sqrt(variance + self.residual_sd**2)

    def coded_standard_errors(self) -> Array:
        """Return the standard errors of the coded coefficients, shape (p,)."""
        return np.sqrt(np.diag(self.covariance_coded))

    def natural_standard_errors(self) -> Array:
        """Return the standard errors of the natural coefficients, shape (p,)."""
        middle, half = (self.upper + self.lower) / 2, (self.upper - self.lower) / 2
        to_natural = coded_to_natural(self.polynomial, middle, half)
        return np.sqrt(np.diag(to_natural @ self.covariance_coded @ to_natural.T))


def fit(
    design: pd.DataFrame, response: pd.Series, factors: Sequence[str], terms: Sequence[str]
) -> Surface:
    """Fit a response surface by ordinary least squares.

    Parameters
    ----------
    design : DataFrame
        One row per case, one column per factor, natural units.
    response : Series
        The response of each case, without gaps.
    factors : sequence of str
        Columns of `design` that are factors.
    terms : sequence of str
        See `nptcs.surface.terms.parse`.

    Returns
    -------
    Surface

    Raises
    ------
    InputError
        When there are no more cases than terms, when the response has gaps or does not vary, or
        when the design cannot tell terms apart: the aliased terms are named, never fitted by a
        minimum-norm solution.
    """
    polynomial = parse(terms, factors)
    x = design[list(factors)].to_numpy(float)
    y = response.to_numpy(float)
    if len(y) <= len(polynomial):
        raise InputError(
            f"{len(y)} solved cases cannot carry {len(polynomial)} terms",
            column="terms",
            remedy="solve more cases or fit fewer terms",
        )
    if not np.isfinite(y).all():
        raise InputError(
            "solved cases have no response to fit",
            value=f"{int(np.sum(~np.isfinite(y)))} of {len(y)}",
            remedy="fit surfaces to solvers that give the vertical stiffness",
        )
    if np.ptp(y) == 0:
        raise InputError(
            "the response is the same in all cases",
            value=y[0],
            remedy="check that the solver sees the factors of this study",
        )
    lower, upper = x.min(axis=0), x.max(axis=0)
    if (lower == upper).any():
        constant = [name for name, same in zip(factors, lower == upper, strict=True) if same]
        raise InputError(
            "only one level of a factor has results",
            column=", ".join(constant),
            remedy="solve cases at two levels or more, or leave the factor out",
        )
    middle, half = (upper + lower) / 2, (upper - lower) / 2
    matrix = polynomial.matrix((x - middle) / half)
    refuse_aliased(matrix, polynomial.names)
    q, r = linalg.qr(matrix, mode="economic")
    coded = linalg.solve_triangular(r, q.T @ y)
    inverse = linalg.solve_triangular(r, np.eye(len(polynomial)))
    residual = y - matrix @ coded
    residual_sd = float(np.sqrt(residual @ residual / (len(y) - len(polynomial))))
    return Surface(
        polynomial=polynomial,
        lower=lower,
        upper=upper,
        coefficients_coded=coded,
        coefficients_natural=coded_to_natural(polynomial, middle, half) @ coded,
        covariance_coded=residual_sd**2 * inverse @ inverse.T,
        points=len(y),
        residual_sd=residual_sd,
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
