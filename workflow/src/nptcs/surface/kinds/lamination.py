"""The lamination form: a response surface built on the mechanics of plates in rubber.

The compliance of the tyre is that of ring and rubber plus that of the plates' bending,

    1/K = c0 + 15 c1 (S/15)^m + c2 (S/15)^n d(T, A),
    d(T, A) = [(ABD + diag(0, 0, r, a, p, 0))⁻¹]_44,

with the laminate stiffness ABD of the plate [+A/-A] of thickness T. The rubber around a plate adds
r to A66, a to D11 and p to D22; a twist spring has no effect, because D16 = 0. Fitted by least
squares on K.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations, product
from typing import Any

import numpy as np
from scipy.optimize import least_squares
from scipy.special import stdtrit

from nptcs.arrays import Array
from nptcs.errors import InputError
from nptcs.laminate import abd
from nptcs.surface.response_surface import Groups, Outside, refuse_unusable, single_cases

FACTORS = ("spacing_mm", "thickness_mm", "angle_deg")
REFERENCE_SPACING_MM = 15.0
"""Spacing at which the two exponents have no effect: the fiducial one."""

FIXED_SHAPE = ("n", "log_p")
OPTIONAL_SHAPE = ("log_r", "log_a", "m")
"""Shape parameters of which forms with fewer than eight coefficients leave out one or two."""

ABSENT = {"log_r": -np.inf, "log_a": -np.inf, "m": 1.0}
"""Value of a shape parameter that is left out: nothing added, or a linear effect of S."""

RUBBER_PLACE = {"log_r": 2, "log_a": 3, "log_p": 4}
"""Where the rubber adds to the diagonal of ABD: A66, D11, D22."""

BENDING = np.eye(6)[3]
"""The bending moment about the plate's axis, in the order of ABD."""

LARGEST_LOGARITHM = 50.0

UNDETERMINED = 1e-9
"""Ratio of the smallest to the largest singular value of the slopes (columns of unit length) up to
which the cases do not determine a combination of the parameters."""

FITS_REMEMBERED = 512
"""A form is fitted to the same cases as a surface and as the mean of a process, and again for both
without each case."""

STARTS = {"n": (0.2,), "log_p": (5.0, 8.0), "log_r": (8.0, 11.0), "log_a": (3.0, 6.0), "m": (1.0,)}
"""Shapes from which a first fit starts, all combined; moduli in N/mm and N mm."""


@dataclass(frozen=True)
class Lamination:
    """A fitted lamination form.

    Parameters
    ----------
    x, y : ndarray of shape (m, 3) and (m,)
        Cases: spacing and thickness in mm, angle in degrees; stiffness in N/mm.
    ply : mapping of str to float
        ``e1_mpa, e2_mpa, nu12, g12_mpa`` of the plates' ply.
    shape : tuple of str
        Fitted shape parameters, from `FIXED_SHAPE` and `OPTIONAL_SHAPE`.
    parameters : ndarray of shape (p,)
        c0 in mm/N, c1 in 1/N, c2 in 1/mm², then the shape parameters.
    covariance : ndarray of shape (p, p)
        s² (JᵀJ)⁻¹ with the Jacobian J of K.
    residual_sd : float
        s, N/mm.
    """

    x: Array
    y: Array
    ply: Mapping[str, float]
    shape: tuple[str, ...]
    parameters: Array
    covariance: Array
    residual_sd: float
    outside = Outside.FLAGGED

    @property
    def factors(self) -> tuple[str, ...]:
        """Names of the factors."""
        return FACTORS

    @property
    def coefficients(self) -> int:
        """Fitted coefficients."""
        return len(self.parameters)

    def predict(self, x: Array) -> Array:
        """Evaluate the stiffness at points of shape (m, 3) → (m,), N/mm."""
        return _stiffness(self.parameters, self.shape, x, laminates(x, self.ply))

    def predict_with(self, x: Array, ply: Mapping[str, float | Array]) -> Array:
        """Evaluate the stiffness with plates of another ply, shape (m, 3) → (m,), N/mm.

        The fitted coefficients are kept; a constant of the ply is one value or an array of m.
        """
        return _stiffness(self.parameters, self.shape, x, laminates(x, ply))

    def slopes(self, x: Array) -> Array:
        """Differentiate the stiffness with respect to the parameters, shape (m, 3) → (m, p)."""
        return _jacobian(self.parameters, self.shape, x, laminates(x, self.ply))

    def interval(self, x: Array, confidence: float = 0.95) -> tuple[Array, Array]:
        """Bounds of the prediction interval, linear in the parameters: two of shape (m,)."""
        jacobian = self.slopes(x)
        variance = np.einsum("ij,jk,ik->i", jacobian, self.covariance, jacobian)
        quantile = stdtrit(len(self.y) - self.coefficients, 0.5 + confidence / 2)
        half_width = quantile * np.sqrt(variance + self.residual_sd**2)
        value = self.predict(x)
        return value - half_width, value + half_width

    def refit(self, x: Array, y: Array) -> Lamination:
        """Fit the same form to other cases, from the parameters found here."""
        return _best(x, y, self.ply, {self.shape: [self.parameters]})

    def groups(self) -> Groups:
        """Tell which cases are left out together: each alone."""
        return single_cases(self.y)

    def content(self) -> dict[str, Any]:
        """Everything that defines the surface, as plain values."""
        return {
            "x": self.x.tolist(),
            "y": self.y.tolist(),
            "ply": dict(self.ply),
            "shape": self.shape,
            "parameters": self.parameters.tolist(),
            "covariance": self.covariance.tolist(),
            "residual_sd": self.residual_sd,
        }


def fit_lamination(
    x: Array,
    y: Array,
    factors: Sequence[str],
    ply: Mapping[str, float] | None,
    coefficients: int,
) -> Lamination:
    """Fit the lamination form from several starts.

    Parameters
    ----------
    x, y : ndarray of shape (m, n) and (m,)
        Cases in the order of `factors`, natural units; stiffness in N/mm.
    factors : sequence of str
        Must be spacing, thickness and angle, in any order.
    ply : mapping of str to float or None
        Constants of the plates' ply.
    coefficients : int
        6, 7 or 8. Of the forms with that number, the one with the smallest sum of squares is taken.

    Returns
    -------
    Lamination

    Raises
    ------
    InputError
        For other factors, a ply that is missing, a response that is not positive, or cases that
        do not determine that number of coefficients.
    """
    if sorted(factors) != sorted(FACTORS):
        raise InputError(
            f"the lamination form has the factors {', '.join(FACTORS)}",
            column="surfaces",
            value=", ".join(factors),
            remedy="leave the lamination form out of this study",
        )
    if ply is None:
        raise InputError(
            "the lamination form needs the constants of the plates' ply",
            column="surfaces",
            remedy="give the specimens of a ply, or leave the lamination form out",
        )
    ordered = x[:, [list(factors).index(name) for name in FACTORS]]
    refuse_unusable(ordered, y, FACTORS, coefficients)
    if (y <= 0).any() or (ordered[:, :2] <= 0).any():
        raise InputError(
            "the lamination form needs positive stiffness, spacing and thickness",
            column="surfaces",
            value=float(min(y.min(), ordered[:, :2].min())),
            remedy="correct the cases",
        )
    optional = combinations(OPTIONAL_SHAPE, coefficients - 3 - len(FIXED_SHAPE))
    stiffness = laminates(ordered, ply)
    starts = {
        (*FIXED_SHAPE, *chosen): _starts((*FIXED_SHAPE, *chosen), ordered, y, stiffness)
        for chosen in optional
    }
    return _best(ordered, y, ply, starts)


def laminates(x: Array, ply: Mapping[str, float | Array]) -> Array:
    """Laminate stiffness ABD of the plates of each case, shape (m, 6, 6), in N and mm."""
    return abd(ply, x[:, 2], x[:, 1])


def _best(
    x: Array, y: Array, ply: Mapping[str, float], starts: Mapping[tuple[str, ...], list[Array]]
) -> Lamination:
    """Fit each form from each of its starts and keep the one with the smallest sum of squares."""
    from_starts = [
        (shape, tuple(start.tobytes() for start in given)) for shape, given in starts.items()
    ]
    return _best_of(x.tobytes(), y.tobytes(), tuple(ply.items()), tuple(from_starts))


@lru_cache(maxsize=FITS_REMEMBERED)
def _best_of(
    x_bytes: bytes,
    y_bytes: bytes,
    constants: tuple[tuple[str, float], ...],
    starts: tuple[tuple[tuple[str, ...], tuple[bytes, ...]], ...],
) -> Lamination:
    """Fit as `_best` does, unless it was fitted to the same numbers before."""
    x, y = np.frombuffer(x_bytes).reshape(-1, len(FACTORS)), np.frombuffer(y_bytes)
    ply = dict(constants)
    stiffness = laminates(x, ply)
    rivals = {
        shape: min(
            (_fitted(np.frombuffer(start), shape, x, y, stiffness) for start in given),
            key=lambda f: f[0],
        )
        for shape, given in starts
    }
    shape = min(rivals, key=lambda name: rivals[name][0])
    sum_of_squares, parameters = rivals[shape]
    variance = sum_of_squares / (len(y) - len(parameters))
    jacobian = _jacobian(parameters, shape, x, stiffness)
    scale = np.linalg.norm(jacobian, axis=0)
    scale[scale == 0] = 1.0
    values, right = np.linalg.svd(jacobian / scale, full_matrices=False)[1:]
    if values[-1] <= UNDETERMINED * values[0]:
        raise _undetermined(len(parameters), x)
    inverse = (right.T / values**2) @ right
    return Lamination(
        x=x,
        y=y,
        ply={name: ply[name] for name in ("e1_mpa", "e2_mpa", "nu12", "g12_mpa")},
        shape=shape,
        parameters=parameters,
        covariance=variance * inverse / np.outer(scale, scale),
        residual_sd=float(np.sqrt(variance)),
    )


def _undetermined(coefficients: int, x: Array) -> InputError:
    """Say that K stays the same along a combination of the parameters, and which values there are.

    Two spacings, for example, do not determine an exponent of the spacing: the parameters would
    depend on the start.
    """
    levels = [f"{len(np.unique(c))} of {name}" for name, c in zip(FACTORS, x.T, strict=True)]
    return InputError(
        f"these cases do not determine the {coefficients} coefficients of the lamination form",
        column="surfaces",
        value=f"different values: {', '.join(levels)}",
        remedy="solve cases at more levels, or ask for fewer coefficients",
    )


def _fitted(
    start: Array, shape: tuple[str, ...], x: Array, y: Array, stiffness: Array
) -> tuple[float, Array]:
    """Return the sum of squares and the parameters of one fit."""
    scale = np.where(np.arange(len(start)) < 3, np.abs(start) + 1e-12, 1.0)
    found = least_squares(
        lambda parameters: _stiffness(parameters, shape, x, stiffness) - y,
        start,
        jac=lambda parameters: _jacobian(parameters, shape, x, stiffness),
        x_scale=scale,
        max_nfev=300,
    )
    return 2 * float(found.cost), found.x


def _starts(shape: tuple[str, ...], x: Array, y: Array, stiffness: Array) -> list[Array]:
    """Combine the starting shapes, each with its best c0, c1, c2 (linear least squares on 1/K)."""
    starts = []
    for values in product(*(STARTS[name] for name in shape)):
        terms = _terms(np.array(values), shape, x, stiffness)
        matrix = np.column_stack([np.ones(len(y)), terms.spacing, terms.plates])
        weights = y**2  # dK = -K² d(1/K)
        linear = np.linalg.lstsq(matrix * weights[:, None], weights / y)[0]
        starts.append(np.concatenate([linear, values]))
    return starts


@dataclass(frozen=True)
class _Terms:
    """Factors of c1 and c2 at each case; slopes of c2's with respect to log rubber moduli, (m,)."""

    spacing: Array
    plates: Array
    plates_by: Mapping[str, Array]


def _terms(values: Array, shape: tuple[str, ...], x: Array, stiffness: Array) -> _Terms:
    """Evaluate the factors; with M⁻¹ e₄ = w, ∂(M⁻¹)₄₄/∂M_ii = -w_i²."""
    chosen = {**ABSENT, **dict(zip(shape, values, strict=True))}
    held = stiffness.copy()
    for name, place in RUBBER_PLACE.items():
        held[:, place, place] += _modulus(chosen[name])
    column = np.linalg.solve(held, BENDING[:, None])[:, :, 0]
    ratio = x[:, 0] / REFERENCE_SPACING_MM
    by_spacing = ratio ** chosen["n"]
    return _Terms(
        REFERENCE_SPACING_MM * ratio ** chosen["m"],
        by_spacing * column[:, 3],
        {
            name: -by_spacing * column[:, place] ** 2 * _modulus_slope(chosen[name])
            for name, place in RUBBER_PLACE.items()
        },
    )


def _modulus(logarithm: float) -> float:
    """Stiffness that the rubber adds, N/mm or N mm; above e⁵⁰ the plate is rigid anyway."""
    return float(np.exp(min(logarithm, LARGEST_LOGARITHM)))


def _modulus_slope(logarithm: float) -> float:
    """Slope of `_modulus` with respect to the logarithm."""
    return _modulus(logarithm) if logarithm < LARGEST_LOGARITHM else 0.0


def _stiffness(parameters: Array, shape: tuple[str, ...], x: Array, stiffness: Array) -> Array:
    terms = _terms(parameters[3:], shape, x, stiffness)
    return 1 / (parameters[0] + parameters[1] * terms.spacing + parameters[2] * terms.plates)


def _jacobian(parameters: Array, shape: tuple[str, ...], x: Array, stiffness: Array) -> Array:
    """Differentiate K with respect to each parameter, shape (m, p): ∂K = -K² ∂(1/K)."""
    terms = _terms(parameters[3:], shape, x, stiffness)
    c0, c1, c2 = parameters[:3]
    by_spacing = np.log(x[:, 0] / REFERENCE_SPACING_MM)
    of_compliance = {
        "m": c1 * terms.spacing * by_spacing,
        "n": c2 * terms.plates * by_spacing,
        **{name: c2 * slope for name, slope in terms.plates_by.items()},
    }
    linear = [np.ones(len(x)), terms.spacing, terms.plates]
    compliance = c0 + c1 * terms.spacing + c2 * terms.plates
    columns = np.column_stack([*linear, *(of_compliance[name] for name in shape)])
    return -columns / compliance[:, None] ** 2
