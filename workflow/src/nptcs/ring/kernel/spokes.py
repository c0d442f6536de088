"""The spokes' energy polynomial, arranged for many evaluations."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.polynomial import chebyshev

from nptcs.arrays import Array, Index
from nptcs.fe.spoke.coordinates import unit_elongation
from nptcs.fe.spoke.energy_table import NAMES, SpokeEnergyTable

# derivatives of E in the order of `evaluate`: how often with respect to each coordinate
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
# those by β and φ, and where each of `ORDERS` is among orders of s and these
SIDE_ORDERS = tuple(dict.fromkeys(order[1:] for order in ORDERS))
PLACES = tuple(
    np.array(places)
    for places in zip(*((i, SIDE_ORDERS.index((j, k))) for i, j, k in ORDERS), strict=True)
)
# those by s once, ∂E/∂s first, and the one by s twice
ALONG_ONCE, ALONG_TWICE = np.array([1, 7, 9]), 4


@dataclass(frozen=True)
class SpokePolynomial:
    """E(s, β, φ) = Σ a_im T_i(x(s)) T_j(m)(β) T_k(m)(φ) on the table's range.

    Parameters
    ----------
    height_mm, straight_mm : float
        As in the table; x(s) is `fe.spoke.coordinates.unit_elongation`.
    low, high : arrays (3,)
        Range of s (mm), β and φ (rad) at s ≥ 0.
    narrowing : float
        Fraction of the ranges of β and φ at the lowest s, linear from s = 0.
    coefficients : array (degrees of s, side terms)
        N mm.
    sides : array (side terms, 2)
        Degrees j and k of each side term.
    """

    height_mm: float
    straight_mm: float
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
        return cls(
            height_mm=table.height_mm,
            straight_mm=table.straight_mm,
            low=table.low,
            high=table.high,
            narrowing=table.narrowing,
            coefficients=dense,
            sides=sides,
        )

    def outside(self, coordinates: Array) -> str:
        """Say which coordinate (spokes, 3) is outside the range; empty if none is."""
        low_box, high_box = self._always_inside
        least, most = coordinates.min(axis=0), coordinates.max(axis=0)
        if (least >= low_box).all() and (most <= high_box).all():
            return ""
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
        local = self._scale[:, None] * (coordinates.T - self.low[:, None]) - 1.0
        limits = float(self.low[0]), float(self.high[0])
        local[0], slope, curve = unit_elongation(coordinates[:, 0], limits, self.straight_mm)
        degrees = [len(matrix) for matrix in self._derivatives]
        values = chebyshev_values(local, max(degrees))
        along, beta, phi = (
            (values[:degree, axis].T @ matrix).reshape(len(coordinates), -1, len(self.sides))
            for axis, (degree, matrix) in enumerate(zip(degrees, self._derivatives, strict=True))
        )
        products = along @ (beta * phi).swapaxes(1, 2)
        found: Array = products.transpose(1, 2, 0)[PLACES]
        # from x to s
        found[ALONG_TWICE] = slope**2 * found[ALONG_TWICE] + curve * found[ALONG_ONCE[0]]
        found[ALONG_ONCE] *= slope
        return found

    @cached_property
    def _always_inside(self) -> tuple[Array, Array]:
        """Give the box that is inside the range at every s."""
        shrink = np.array([1.0, min(self.narrowing, 1.0), min(self.narrowing, 1.0)])
        return self.low * shrink, self.high * shrink

    @cached_property
    def _scale(self) -> Array:
        scale: Array = 2.0 / (self.high - self.low)
        return scale

    @cached_property
    def _derivatives(self) -> list[Array]:
        """Matrices that multiply Chebyshev values of x, β and φ: arrays (degrees, orders × terms).

        Each has the derivatives of the factor of each side term, by x three, by β and φ those of
        `SIDE_ORDERS`.
        """
        scale = np.array([1.0, *self._scale[1:]])
        sides = [np.eye(own.max() + 1)[:, own] for own in self.sides.T]
        orders = [(0, 1, 2), *zip(*SIDE_ORDERS, strict=True)]
        return [
            np.concatenate(
                [scale[axis] ** order * differentiated(factor, order) for order in orders[axis]],
                axis=1,
            )
            for axis, factor in enumerate([self.coefficients, *sides])
        ]


def differentiated(series: Array, order: int) -> Array:
    """Chebyshev series (degrees, n) differentiated, with as many degrees as before."""
    found = np.zeros_like(series)
    if len(series) > order:
        found[: len(series) - order] = chebyshev.chebder(series, order)
    return found


def chebyshev_values(x: Array, count: int) -> Array:
    """Chebyshev polynomials T_0 to T_(count-1) at x, array (count, …)."""
    values = np.empty((count, *x.shape))
    values[0] = 1.0
    if count > 1:
        values[1] = x
    known = 2
    while known < count:
        # T_(m+n) = 2 T_m T_n - T_(m-n) doubles their number
        last = known - 1
        more = min(last, count - known)
        np.multiply(2.0 * values[last], values[1 : more + 1], out=values[known : known + more])
        values[known : known + more] -= values[last - 1 :: -1][:more]
        known += more
    return values
