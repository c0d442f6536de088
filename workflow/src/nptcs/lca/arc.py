"""The free arcs of the ring, exactly: exponentials of the characteristic roots.

N + M = C is constant on a free arc, and the bending moment obeys

    (D² + 1)² M - a D² M + a (ε + κ²) M = C (1 + a ε),   D = d/dθ

so that M = C (1 + a ε)/(1 + c) + Σ A_i exp(λ_i θ) with c = a (ε + κ²) and λ² = s the roots of
s² + (2 - a) s + 1 + c = 0. All other quantities follow from M.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nptcs.lca.scaling import Array

ComplexArray = NDArray[np.complex128]
STATE = ("u", "v", "phi", "n", "v_shear", "m")
"""Rows of every state vector: u_r/R, u_θ/R, Φ, N/GA, V/GA, M/(GA R)."""
_CLOSEST_ROOTS = 1e-6
"""Closest relative distance of two roots: moving them apart by so little changes the solution
by its square, while a smaller distance would lose digits."""


@dataclass(frozen=True)
class Foundation:
    """Roots and constant solution of an arc on a foundation `a`; fields have shape ``(n,)``."""

    a: Array
    epsilon: Array
    kappa2: Array
    roots: tuple[ComplexArray, ComplexArray]
    shifted: tuple[ComplexArray, ComplexArray]
    oscillating: NDArray[np.bool_]
    constant: Array

    @classmethod
    def of(cls, a: Array, epsilon: Array, kappa2: Array) -> Foundation:
        """Solve the characteristic equation in r = λ² + 1: r² - a r + a + c = 0."""
        c = a * (epsilon + kappa2)
        discriminant = a * a / 4 - a - c
        floor = _CLOSEST_ROOTS**2 * np.maximum(a * a / 4, a + c)
        close = np.abs(discriminant) < floor
        discriminant = np.where(close, np.copysign(floor, discriminant), discriminant)
        r1 = a / 2 + np.sqrt(discriminant.astype(complex))
        r2 = (a + c) / r1
        s1 = r1 - 1
        s2 = (1 + c) / s1
        constant = np.zeros((*a.shape, 6))
        constant[..., 0] = -kappa2 / (1 + c)
        constant[..., 3] = a * kappa2 / (1 + c)
        constant[..., 5] = (1 + a * epsilon) / (1 + c)
        return cls(
            a, epsilon, kappa2, (np.sqrt(s1), np.sqrt(s2)), (r1, r2), discriminant < 0, constant
        )

    def take(self, rows: NDArray[np.intp]) -> Foundation:
        """Return the foundations of some rows."""
        return Foundation(
            self.a[rows],
            self.epsilon[rows],
            self.kappa2[rows],
            (self.roots[0][rows], self.roots[1][rows]),
            (self.shifted[0][rows], self.shifted[1][rows]),
            self.oscillating[rows],
            self.constant[rows],
        )

    def _pair(self, first: ComplexArray, second: ComplexArray) -> Array:
        """Two real columns that span the modes of both roots, shape ``(n, 6, 2)``."""
        other = np.where(self.oscillating[..., None], first.imag, second.real)
        return np.stack([first.real, other], axis=-1)

    def decaying(self, distance: Array, sign: int) -> Array:
        """Modes exp(-λ x), x the distance from one end, shape ``(n, 6, 2)``.

        Parameters
        ----------
        distance : array, shape (n,)
            x ≥ 0 from the end at which the mode is one.
        sign : {-1, 1}
            Direction in which x falls with θ: -1 if x grows with θ.
        """
        states = [
            self._mode(np.exp(-root * distance), sign * root, r)
            for root, r in zip(self.roots, self.shifted, strict=True)
        ]
        return self._pair(*states)

    def _mode(self, e: ComplexArray, root: ComplexArray, r: ComplexArray) -> ComplexArray:
        """State of M = e with e' = λ e."""
        u = r / self.a * e
        return np.stack(
            [u, -(self.epsilon * e + u) / root, self.kappa2 * e / root, -e, root * e, e], axis=-1
        )

    def symmetric(self, z: Array, length: Array) -> Array:
        """Modes cosh(λ z) exp(-λ L) of the arc that is symmetric about the top, z = π - θ."""
        states = []
        for root, r in zip(self.roots, self.shifted, strict=True):
            falling, rising = np.exp(-root * (length - z)), np.exp(-root * (length + z))
            ch, sh = (falling + rising) / 2, (falling - rising) / 2
            u = r / self.a * ch
            v = (self.epsilon + r / self.a) * sh / root
            phi = -self.kappa2 * sh / root
            states.append(np.stack([u, v, phi, -ch, -root * sh, ch], axis=-1))
        return self._pair(*states)

    def uniform(self, angle: Array) -> Array:
        """State for C = 1 whose rotation is zero where `angle` is zero, shape ``(n, 6)``."""
        state = self.constant.copy()
        rotation = self.kappa2 * self.constant[..., 5] * angle
        state[..., 1] += rotation
        state[..., 2] += rotation
        return state
