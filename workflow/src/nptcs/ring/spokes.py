"""The spokes' energy polynomial, arranged for many evaluations."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nptcs.arrays import Array, Index
from nptcs.fe.spoke.energy_table import NAMES, SpokeEnergyTable

# places of the derivatives of E by the coordinates, and how often by each
ORDERS = (
    (0, 0, 0),
    (1, 0, 0),
    (0, 1, 0),
    (0, 0, 1),
    (2, 0, 0),
    (0, 2, 0),
    (0, 0, 2),
    (1, 1, 0),
    (0, 1, 1),
    (1, 0, 1),
)


@dataclass(frozen=True)
class SpokePolynomial:
    """E(s, β, φ) = Σ a_im T_i(s) T_j(m)(β) T_k(m)(φ) on the table's range.

    Parameters
    ----------
    height_mm : float
    low, high : arrays (3,)
        Range of s (mm), β and φ (rad) at s ≥ 0.
    narrowing : float
        Part of the ranges of β and φ at the lowest s, linear from s = 0.
    coefficients : array (degrees of s, side terms)
        N mm.
    sides : array (side terms, 2)
        Degrees j and k of each side term.
    """

    height_mm: float
    low: Array
    high: Array
    narrowing: float
    coefficients: Array
    sides: Index

    @classmethod
    def of_table(cls, table: SpokeEnergyTable, factor: float = 1.0) -> SpokePolynomial:
        """Arrange a table's terms; `factor` multiplies the energy."""
        sides, place = np.unique(table.exponents[:, 1:], axis=0, return_inverse=True)
        dense = np.zeros((int(table.exponents[:, 0].max()) + 1, len(sides)))
        dense[table.exponents[:, 0], place.ravel()] = factor * table.coefficients
        return cls(table.height_mm, table.low, table.high, table.narrowing, dense, sides)

    def outside(self, coordinates: Array) -> str:
        """Say which coordinate (spokes, 3) lies outside the range; empty if none does."""
        part = 1.0 - (1.0 - self.narrowing) * np.clip(coordinates[:, 0] / self.low[0], 0.0, 1.0)
        shrink = np.stack([np.ones_like(part), part, part], axis=1)
        low, high = self.low * shrink, self.high * shrink
        room = 1e-9 * (self.high - self.low)
        out = ~((coordinates >= low - room) & (coordinates <= high + room))
        if not out.any():
            return ""
        spoke, axis = np.argwhere(out)[0]
        return (
            f"spoke {spoke}: {NAMES[axis]} = {coordinates[spoke, axis]:.4g} is outside the "
            f"table's range {low[spoke, axis]:.4g} … {high[spoke, axis]:.4g} there"
        )

    def evaluate(self, coordinates: Array) -> Array:
        """Energy and derivatives (10, spokes) in the order of `ORDERS` at (spokes, 3)."""
        scale = 2.0 / (self.high - self.low)
        local = (coordinates - self.low) * scale - 1.0
        counts = (len(self.coefficients), *(self.sides.max(axis=0) + 1))
        lines = [
            [order * scale[axis] ** number for number, order in enumerate(chain)]
            for axis in range(3)
            for chain in [chebyshev_chain(local[:, axis], int(counts[axis]))]
        ]
        radial = [line.T @ self.coefficients for line in lines[0]]
        beta = [line.T[:, self.sides[:, 0]] for line in lines[1]]
        phi = [line.T[:, self.sides[:, 1]] for line in lines[2]]
        return np.stack([np.sum(radial[i] * beta[j] * phi[k], axis=1) for i, j, k in ORDERS])


def chebyshev_chain(x: Array, count: int) -> tuple[Array, Array, Array]:
    """Chebyshev polynomials (count, n) at x (n,) and their first two derivatives."""
    value, first, second = (np.zeros((count, len(x))) for _ in range(3))
    value[0] = 1.0
    if count > 1:
        value[1], first[1] = x, 1.0
    for i in range(2, count):
        value[i] = 2.0 * x * value[i - 1] - value[i - 2]
        first[i] = 2.0 * value[i - 1] + 2.0 * x * first[i - 1] - first[i - 2]
        second[i] = 4.0 * first[i - 1] + 2.0 * x * second[i - 1] - second[i - 2]
    return value, first, second
