"""Ogden's model, incompressible, in Abaqus' convention.

W = Σ 2μ_i/α_i² (λ1^α_i + λ2^α_i + λ3^α_i - 3), μ0 = Σ μ_i, and the nominal stress

    P = Σ 2μ_i/α_i (λ^(α_i - 1) - λ^(-r α_i - 1)),  r = 1/2, 2, 1

in uniaxial tension, equibiaxial tension and pure shear. Ogden's own μ_i is 2μ_i/α_i here.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from nptcs.arrays import Array
from nptcs.calibrate.linear import solve_linear
from nptcs.calibrate.observations import Observation, undetermined

RATIO = {
    "rubber_tension": 0.5,
    "rubber_equibiaxial": 2.0,
    "rubber_pure_shear": 1.0,
    "rubber_compression": 0.5,
}
LARGEST_EXPONENT = 30.0
# exponents of published rubbers: the starts of the search, tried one after the other
STARTS = {
    1: ((2.0,), (-2.0,), (5.0,)),
    2: ((1.3, 5.0), (2.0, -2.0), (1.0, 10.0), (2.0, 8.0), (-1.0, 4.0)),
    3: ((1.3, 5.0, -2.0), (2.0, 8.0, -2.0), (1.0, 4.0, -4.0)),
}


@dataclass(frozen=True)
class OgdenModel:
    """Ogden's model with a number of terms; constants are μ1, α1, μ2, α2 and so on."""

    terms: int
    name: str = "ogden"

    @property
    def constants(self) -> tuple[str, ...]:
        """Names of the constants."""
        return tuple(n for i in range(1, self.terms + 1) for n in (f"mu{i}_mpa", f"alpha{i}"))

    def stress(self, mode: str, stretch: Array, constants: Array) -> Array:
        """Nominal stress P (MPa), shape (n,)."""
        mu, alpha = np.asarray(constants)[0::2], np.asarray(constants)[1::2]
        return _basis(mode, stretch, alpha) @ mu

    def energy(self, l1: Array, l2: Array, constants: Array) -> Array:
        """Strain energy density (MJ/m³) at λ1, λ2 and λ3 = 1/(λ1 λ2)."""
        mu, a = np.asarray(constants)[0::2], np.asarray(constants)[1::2]
        l1, l2 = np.asarray(l1)[..., None], np.asarray(l2)[..., None]
        return (l1**a + l2**a + (l1 * l2) ** -a - 3.0) @ (2 * mu / a**2)

    def jacobian(self, mode: str, stretch: Array, constants: Array) -> Array:
        """∂P/∂(μ1, α1, …), shape (n, k)."""
        mu, a = np.asarray(constants)[0::2], np.asarray(constants)[1::2]
        basis = _basis(mode, stretch, a)
        lam, r = np.asarray(stretch)[:, None], RATIO[mode]
        slope = 2 / a * np.log(lam) * (lam ** (a - 1) + r * lam ** (-r * a - 1)) - basis / a
        columns = np.empty((len(lam), 2 * self.terms))
        columns[:, 0::2], columns[:, 1::2] = basis, mu * slope
        return columns

    def tangent(self, l1: Array, l2: Array, constants: Array) -> Array:
        """Hessian of the energy in the logarithmic strains e1, e2, shape (n, 2, 2)."""
        mu, a = np.asarray(constants)[0::2], np.asarray(constants)[1::2]
        p1, p2 = np.asarray(l1)[..., None] ** a, np.asarray(l2)[..., None] ** a
        p3 = 1.0 / (p1 * p2)
        d11, d22, d12 = ((2 * mu * p).sum(-1) for p in (p1 + p3, p2 + p3, p3))
        return np.stack([np.stack([d11, d12], axis=-1), np.stack([d12, d22], axis=-1)], axis=-2)

    def initial_shear_modulus(self, constants: Array) -> float:
        """μ0 = Σ μ_i (MPa)."""
        return float(np.asarray(constants)[0::2].sum())

    def remarks(self, constants: Array) -> list[str]:
        """Name the exponents that the search has driven to its bound."""
        bound = 0.999 * LARGEST_EXPONENT
        at_bound = [
            f"{name} at the bound {LARGEST_EXPONENT:g} of the search"
            for name, alpha in zip(self.constants[1::2], constants[1::2], strict=True)
            if abs(alpha) >= bound
        ]
        return [f"constants not determined: {', '.join(at_bound)}"] if at_bound else []

    def solve(self, data: Sequence[Observation], start: Array | None = None) -> Array:
        """Constants of the weighted least-squares fit.

        The μ_i are linear once the α_i are given, so the search runs over the α_i alone
        (variable projection, Golub and Pereyra 1973), from each of a fixed set of starts, or
        from `start` alone; the best result is taken, with the terms in the order of |α|.

        Raises
        ------
        InputError
            If there are not more points than constants.
        """
        points = sum(len(o.stress) for o in data)
        if points <= 2 * self.terms:
            raise undetermined(self.name, 2 * self.terms, points, data)
        starts = STARTS[self.terms] if start is None else (tuple(start[1::2]),)
        ends = [_search(data, np.array(alphas)) for alphas in starts]
        alpha = min(ends, key=lambda end: end[1])[0]
        alpha = alpha[np.argsort(np.abs(alpha))]
        constants = np.empty(2 * self.terms)
        constants[0::2], constants[1::2] = _linear(data, alpha), alpha
        return constants


def ogden(terms: int) -> OgdenModel:
    """Ogden's model with 1, 2 or 3 terms."""
    return OgdenModel(terms)


def _basis(mode: str, stretch: Array, alpha: Array) -> Array:
    """Nominal stress of each term at μ = 1 MPa, shape (n, terms)."""
    lam, r = np.asarray(stretch)[:, None], RATIO[mode]
    return 2 / alpha * (lam ** (alpha - 1) - lam ** (-r * alpha - 1))


def _stacked(data: Sequence[Observation], alpha: Array) -> tuple[Array, Array, Array]:
    design = np.concatenate([_basis(o.mode, o.stretch, alpha) for o in data])
    stress = np.concatenate([o.stress for o in data])
    return design, stress, np.concatenate([o.weight for o in data])


def _linear(data: Sequence[Observation], alpha: Array) -> Array:
    return solve_linear(*_stacked(data, alpha))[0]


def _search(data: Sequence[Observation], start: Array) -> tuple[Array, float]:
    """Exponents from one start, and the weighted sum of squares there."""

    def residual(alpha: Array) -> Array:
        design, stress, weight = _stacked(data, alpha)
        return np.sqrt(weight) * (design @ solve_linear(design, stress, weight)[0] - stress)

    bounds = (-LARGEST_EXPONENT, LARGEST_EXPONENT)
    solution = least_squares(residual, start, bounds=bounds, xtol=1e-10, ftol=1e-12, gtol=1e-12)
    return solution.x, float(solution.cost)
