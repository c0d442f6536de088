"""The free arcs of the ring, exactly: exponentials of the characteristic roots.

N + M = C is constant on a free arc, and the bending moment obeys

    (D² + 1)² M - a D² M + a (ε + κ²) M = C (1 + a ε),   D = d/dθ

so that M = C (1 + a ε)/(1 + c) + Σ A_i exp(λ_i θ) with c = a (ε + κ²) and λ² = s the roots of
s² + (2 - a) s + 1 + c = 0. All other quantities follow from M.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nptcs.arrays import ComplexArray, Floating, Mask, Rows

STATE = ("u", "v", "phi", "n", "v_shear", "m")
"""Rows of every state vector: u_r/R, u_θ/R, Φ, N/GA, V/GA, M/(GA R)."""
_ODD = np.array([False, True, True, False, True, False])
"""Rows that change their sign when the direction of θ does."""
_CLOSEST = 1e-11
"""Relative discriminant below which two real roots are replaced by a conjugate pair just as
close. The solution changes just as little; two real modes so close would lose digits, but the real
and imaginary parts of one complex mode do not."""


@dataclass(frozen=True)
class Foundation:
    """Arcs on foundations `a`, one per design.

    Parameters
    ----------
    roots : complex array, shape (n, 2)
        λ₁ and λ₂, with real parts not below zero.
    modes : complex array, shape (n, 6, 2)
        State of M = exp(λ θ) at θ = 0, for both roots.
    oscillating : bool array, shape (n,)
        Whether the roots are conjugate; else both are real.
    constant : array, shape (n, 6)
        State of C = 1 without rotation.
    rotation : array, shape (n,)
        Growth of Φ and v with θ for C = 1.
    """

    roots: ComplexArray
    modes: ComplexArray
    oscillating: Mask
    constant: Floating
    rotation: Floating

    @classmethod
    def of(cls, a: Floating, epsilon: Floating, kappa2: Floating) -> Foundation:
        """Solve the characteristic equation in r = λ² + 1: r² - a r + a + c = 0."""
        c = a * (epsilon + kappa2)
        discriminant = a * a / 4 - a - c
        floor = _CLOSEST * np.maximum(a * a / 4, a + c)
        discriminant = np.where(np.abs(discriminant) < floor, -floor, discriminant)
        r1 = a / 2 + np.sqrt(discriminant.astype(complex))
        r = np.stack([r1, (a + c) / r1], axis=-1)
        roots = np.sqrt(np.stack([r1 - 1, (1 + c) / (r1 - 1)], axis=-1))
        u = r / a[:, None]
        modes = np.empty((len(a), 6, 2), dtype=complex)
        modes[:, 0] = u
        modes[:, 1] = -(epsilon[:, None] + u) / roots
        modes[:, 2] = kappa2[:, None] / roots
        modes[:, 3] = -1
        modes[:, 4] = roots
        modes[:, 5] = 1
        constant = np.zeros((len(a), 6))
        constant[:, 0] = -kappa2 / (1 + c)
        constant[:, 3] = a * kappa2 / (1 + c)
        constant[:, 5] = (1 + a * epsilon) / (1 + c)
        return cls(roots, modes, discriminant < 0, constant, kappa2 * constant[:, 5])

    def take(self, rows: Rows) -> Foundation:
        """Return the foundations of some rows."""
        return Foundation(*(values[rows] for values in vars(self).values()))

    def _real(self, states: ComplexArray) -> Floating:
        """Real columns that span both roots' modes: real and imaginary part, or one each."""
        columns = states.real.copy()
        oscillating = self.oscillating
        columns[oscillating, :, 1] = states.imag[oscillating, :, 0]
        return columns

    def growing(self, distance: Floating | None = None) -> Floating:
        """Modes exp(-λ x), x the distance to the end ahead, shape ``(n, 6, 2)``.

        Parameters
        ----------
        distance : array, shape (n,), optional
            x ≥ 0; by default the end itself.
        """
        return self._real(self.modes if distance is None else self._scaled(distance))

    def falling(self, distance: Floating | None = None) -> Floating:
        """Modes exp(-λ x), x the distance from the end behind, shape ``(n, 6, 2)``."""
        columns = self.growing(distance)
        columns[:, _ODD] *= -1
        return columns

    def _scaled(self, distance: Floating) -> ComplexArray:
        return np.asarray(self.modes * np.exp(-self.roots * distance[:, None])[:, None, :])

    def symmetric(self, z: Floating, length: Floating) -> Floating:
        """Modes cosh(λ z) exp(-λ L) of the arc that is symmetric about the top, z = π - θ."""
        down = np.exp(-self.roots * (length - z)[:, None])
        up = np.exp(-self.roots * (length + z)[:, None])
        hyperbolic = np.where(_ODD[:, None], (up - down)[:, None], (up + down)[:, None]) / 2
        return self._real(self.modes * hyperbolic)

    def uniform(self, angle: Floating) -> Floating:
        """State for C = 1 whose rotation is zero where `angle` is zero, shape ``(n, 6)``."""
        state = self.constant.copy()
        state[:, 1:3] += (self.rotation * angle)[:, None]
        return state

    def radial(self, distance: Floating, coefficients: Floating) -> Floating:
        """Radial displacement of modes exp(-λ x) with given coefficients.

        Parameters
        ----------
        distance : array, shape (n, points)
            x.
        coefficients : array, shape (n, 2)
            Coefficients of the two real columns.
        """
        oscillating = self.oscillating
        amplitude = coefficients.astype(complex)
        amplitude[oscillating, 0] -= 1j * coefficients[oscillating, 1]
        amplitude[oscillating, 1] = 0
        amplitude *= self.modes[:, 0]
        first = amplitude[:, :1] * np.exp(-self.roots[:, :1] * distance)
        u = first.real
        real = np.flatnonzero(~oscillating)
        if len(real):
            rate = self.roots[real, 1:].real
            u[real] += amplitude[real, 1:].real * np.exp(-rate * distance[real])
        return u
