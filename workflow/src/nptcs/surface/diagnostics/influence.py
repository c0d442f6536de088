"""Diagnostics of a polynomial: its terms, and what each case does to it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import linalg, stats

from nptcs.arrays import Array
from nptcs.surface.fit import Surface


@dataclass(frozen=True)
class TermTests:
    """Tests of the coded coefficients; arrays of shape (p,).

    Parameters
    ----------
    t_value, p_value : ndarray
        Coefficient over standard error, and the two-sided p-value.
    low, high : ndarray
        Confidence interval.
    vif : ndarray
        Variance inflation 1/(1 - R²) by the other coded terms; not a number for the intercept.
    """

    t_value: Array
    p_value: Array
    low: Array
    high: Array
    vif: Array


@dataclass(frozen=True)
class Influence:
    """What each case does to the fit; arrays of shape (m,).

    Parameters
    ----------
    residual : ndarray
        Response minus surface.
    leverage : ndarray
        Diagonal h of X(XᵀX)⁻¹Xᵀ.
    left_out : ndarray
        Leave-one-out residual e/(1 - h).
    standardised : ndarray
        Internally studentised residual e/(s √(1 - h)).
    studentised : ndarray
        Externally studentised residual: s without the case.
    cook : ndarray
        Cook's distance.
    """

    residual: Array
    leverage: Array
    left_out: Array
    standardised: Array
    studentised: Array
    cook: Array


def term_tests(surface: Surface, confidence: float = 0.95) -> TermTests:
    """Test the coded coefficients against zero.

    Where nothing is left over (a polynomial through all cases) t is infinite and p is 0.
    """
    error = surface.coded_standard_errors()
    df = surface.points - len(surface.polynomial)
    with np.errstate(divide="ignore", invalid="ignore"):
        t_value = np.nan_to_num(surface.coefficients_coded / error, nan=0.0, posinf=np.inf)
    half_width = stats.t.ppf(0.5 + confidence / 2, df) * error
    return TermTests(
        t_value=t_value,
        p_value=2 * stats.t.sf(np.abs(t_value), df),
        low=surface.coefficients_coded - half_width,
        high=surface.coefficients_coded + half_width,
        vif=variance_inflation(surface),
    )


def variance_inflation(surface: Surface) -> Array:
    """Return how much each term's variance grows by its correlation with the others, (p,)."""
    matrix = surface.polynomial.matrix(surface.coded(surface.x))
    intercept = np.array([not any(powers) for powers in surface.polynomial.exponents])
    columns = matrix[:, ~intercept]
    if intercept.any():
        columns = columns - columns.mean(axis=0)
    r = linalg.qr(columns / np.linalg.norm(columns, axis=0), mode="r")[0][: columns.shape[1]]
    inflation = np.full(len(intercept), np.nan)
    inflation[~intercept] = np.sum(linalg.inv(r) ** 2, axis=1)
    return inflation


def influence(surface: Surface) -> Influence:
    """Measure what each case does to the fit.

    A case with leverage 1 (the only one that carries a term) has no leave-one-out residual: not
    a number.
    """
    matrix = surface.polynomial.matrix(surface.coded(surface.x))
    q, _ = linalg.qr(matrix, mode="economic")
    leverage = np.einsum("ij,ij->i", q, q)
    free = np.where(1 - leverage > 1e-10, 1 - leverage, np.nan)
    residual = surface.y - surface.predict(surface.x)
    terms = len(surface.polynomial)
    df = surface.points - terms
    variance = surface.residual_sd**2
    with np.errstate(divide="ignore", invalid="ignore"):
        standardised = residual / np.sqrt(variance * free)
        without = (df * variance - residual**2 / free) / (df - 1)
        studentised = residual / np.sqrt(np.maximum(without, 0.0) * free)
    return Influence(
        residual=residual,
        leverage=leverage,
        left_out=residual / free,
        standardised=standardised,
        studentised=studentised,
        cook=standardised**2 * leverage / free / terms,
    )


def press(surface: Surface) -> tuple[float, float]:
    """Return PRESS and the predicted R², 1 - PRESS/total; not a number at leverage 1."""
    left_out = influence(surface).left_out
    y = surface.y
    total = y @ y if surface.through_origin else np.sum((y - y.mean()) ** 2)
    squares = float(np.sum(left_out**2))
    return squares, 1 - squares / float(total)
