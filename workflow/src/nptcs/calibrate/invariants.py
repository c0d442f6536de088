"""Hyperelastic models in the invariants, incompressible, linear in their constants.

Strain energy W(I1, I2) per unit volume; λ is the stretch in the loading direction, P the
nominal stress. With W1 = ∂W/∂I1 and W2 = ∂W/∂I2 (Rivlin; Treloar, The Physics of Rubber
Elasticity, chapter 10):

    uniaxial      P = 2 (λ - λ⁻²) (W1 + W2/λ)
    equibiaxial   P = 2 (λ - λ⁻⁵) (W1 + λ² W2)
    pure shear    P = 2 (λ - λ⁻³) (W1 + W2)

Compression of a lubricated disc is uniaxial with λ < 1 and P < 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from nptcs.arrays import Array
from nptcs.calibrate.linear import solve_linear
from nptcs.calibrate.observations import Observation, undetermined

MODES = ("rubber_tension", "rubber_equibiaxial", "rubber_pure_shear", "rubber_compression")
# λ2 = λ^a in each mode, and λ3 = 1/(λ λ2)
SECOND_STRETCH = {
    "rubber_tension": -0.5,
    "rubber_equibiaxial": 1.0,
    "rubber_pure_shear": 0.0,
    "rubber_compression": -0.5,
}
# P = 2 (λ - λ^b)(W1 + λ^c W2)
EXPONENTS = {
    "rubber_tension": (-2.0, -1.0),
    "rubber_equibiaxial": (-5.0, 2.0),
    "rubber_pure_shear": (-3.0, 0.0),
    "rubber_compression": (-2.0, -1.0),
}


def stretches(mode: str, stretch: Array) -> tuple[Array, Array, Array]:
    """Principal stretches (λ1, λ2, λ3) of a mode; λ1 is in the loading direction.

    Examples
    --------
    An equibiaxial stretch of 2 thins the sheet to a quarter:

    >>> import numpy as np
    >>> stretches("rubber_equibiaxial", np.array(2.0))[2].item()
    0.25
    """
    second = stretch ** SECOND_STRETCH[mode]
    return stretch, second, 1.0 / (stretch * second)


@dataclass(frozen=True)
class InvariantModel:
    """A model W = Σ c_k (I1 - 3)^p_k (I2 - 3)^q_k with only p or q different from zero.

    Parameters
    ----------
    name : str
        Name in tables and configuration.
    constants : tuple of str
        Names of the constants c_k, MPa.
    powers : tuple of (int, int)
        (p_k, q_k) of each term.

    Examples
    --------
    P = 2 C10 (λ - λ⁻²) at 15 % strain, with the paper's C10 of rubber 75A:

    >>> import numpy as np
    >>> stress = NEO_HOOKEAN.stress("rubber_tension", np.array([1.15]), np.array([1.18]))
    >>> stress.round(4).tolist()
    [0.9295]
    >>> NEO_HOOKEAN.initial_shear_modulus(np.array([1.18]))
    2.36
    """

    name: str
    constants: tuple[str, ...]
    powers: tuple[tuple[int, int], ...]

    def basis(self, mode: str, stretch: Array) -> Array:
        """Nominal stress that each constant gives at 1 MPa, shape (n, k)."""
        l1, l2, l3 = stretches(mode, np.asarray(stretch, dtype=float))
        i1, i2 = _invariants(l1, l2, l3)
        unloading, second = EXPONENTS[mode]
        factor = 2.0 * (l1 - l1**unloading)
        columns = [factor * (_slope(i1, p) + l1**second * _slope(i2, q)) for p, q in self.powers]
        return np.stack(columns, axis=-1)

    def stress(self, mode: str, stretch: Array, constants: Array) -> Array:
        """Nominal stress P (MPa), shape (n,)."""
        return self.basis(mode, stretch) @ np.asarray(constants)

    def energy(self, l1: Array, l2: Array, constants: Array) -> Array:
        """Strain energy density (MJ/m³) at λ1, λ2 and λ3 = 1/(λ1 λ2)."""
        i1, i2 = _invariants(l1, l2, 1.0 / (l1 * l2))
        terms = [(i1 - 3) ** p * (i2 - 3) ** q for p, q in self.powers]
        return np.stack(terms, axis=-1) @ np.asarray(constants)

    def tangent(self, l1: Array, l2: Array, constants: Array) -> Array:
        """∂²W/∂e_i∂e_j in the logarithmic strains e1, e2 at e1 + e2 + e3 = 0, shape (n, 2, 2).

        Positive definite where the material is stable in Drucker's sense.
        """
        l3 = 1.0 / (l1 * l2)
        i1, i2 = _invariants(l1, l2, l3)
        total = np.zeros((*np.shape(l1), 2, 2))
        for c, (p, q) in zip(constants, self.powers, strict=True):
            invariant, power, sign = (i1, p, 2.0) if p else (i2, q, -2.0)
            gradient, hessian = _log_derivatives(l1**sign, l2**sign, l3**sign, sign)
            outer = gradient[..., :, None] * gradient[..., None, :]
            total += c * (
                _slope(invariant, power)[..., None, None] * hessian
                + _curvature(invariant, power)[..., None, None] * outer
            )
        return total

    def solve(self, data: Sequence[Observation], start: Array | None = None) -> Array:
        """Constants that minimise Σ w (P_model - P)², in closed form.

        For the neo-Hookean model: C10 = Σ w f P/Σ w f² with f = 2(λ - λ⁻²) in uniaxial
        tension. `start` is not needed.

        Raises
        ------
        InputError
            If the data cannot tell the constants apart.
        """
        design = np.concatenate([self.basis(o.mode, o.stretch) for o in data])
        target = np.concatenate([o.stress for o in data])
        weight = np.concatenate([o.weight for o in data])
        constants, rank = solve_linear(design, target, weight)
        if rank < len(self.constants):
            raise undetermined(self.name, len(self.constants), rank, data)
        return constants

    def jacobian(self, mode: str, stretch: Array, constants: Array) -> Array:
        """∂P/∂c, shape (n, k)."""
        return self.basis(mode, stretch)

    def initial_shear_modulus(self, constants: Array) -> float:
        """μ0 = 2 (W1 + W2) at the undeformed state (MPa)."""
        return 2.0 * float(
            sum(c for c, (p, q) in zip(constants, self.powers, strict=True) if p + q == 1)
        )

    def remarks(self, constants: Array) -> list[str]:
        """Nothing: the constants are the closed solution of a linear problem."""
        return []


def _invariants(l1: Array, l2: Array, l3: Array) -> tuple[Array, Array]:
    return l1**2 + l2**2 + l3**2, l1**-2.0 + l2**-2.0 + l3**-2.0


def _slope(invariant: Array, power: int) -> Array:
    """d(I - 3)^p/dI, zero for a term without this invariant."""
    if power == 0:
        return np.zeros_like(invariant)
    return power * (invariant - 3.0) ** (power - 1)


def _curvature(invariant: Array, power: int) -> Array:
    """d²(I - 3)^p/dI²."""
    if power < 2:
        return np.zeros_like(invariant)
    return power * (power - 1) * (invariant - 3.0) ** (power - 2)


def _log_derivatives(a1: Array, a2: Array, a3: Array, sign: float) -> tuple[Array, Array]:
    """Gradient and Hessian of Σ λ_i^m in (e1, e2), with a_i = λ_i^m and m = `sign`."""
    gradient = sign * np.stack([a1 - a3, a2 - a3], axis=-1)
    hessian = sign**2 * np.stack(
        [np.stack([a1 + a3, a3], axis=-1), np.stack([a3, a2 + a3], axis=-1)], axis=-2
    )
    return gradient, hessian


NEO_HOOKEAN = InvariantModel("neo_hookean", ("c10_mpa",), ((1, 0),))
MOONEY_RIVLIN = InvariantModel("mooney_rivlin", ("c10_mpa", "c01_mpa"), ((1, 0), (0, 1)))
YEOH = InvariantModel("yeoh", ("c10_mpa", "c20_mpa", "c30_mpa"), ((1, 0), (2, 0), (3, 0)))
