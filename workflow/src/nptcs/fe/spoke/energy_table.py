"""The spoke as a super-element: a polynomial energy of the band's motion (u_r, u_θ, φ).

The polynomial is fitted to energies, forces and condensed tangents of finite element states
together, so that forces and tangents in the tyre are exact derivatives of one energy. Its variables
are those of `coordinates`, with √(a - s) in place of s: it is even in β, and only states with β ≥ 0
are computed.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nptcs.arrays import Array, Index
from nptcs.config.solvers.fe import EnergyTableOptions, SpokeGeometry
from nptcs.fe.spoke.coordinates import (
    carried,
    coordinates_of,
    straight_elongation_mm,
    unit_elongation,
)

SECOND = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))
# what rounding in `coordinates_of` may add to a state on the table's edge, as a fraction of the
# range: motions are differences of lengths of a hundred millimetres, known to 1e-14
EDGE = 1e-12
# fraction of the largest energy that is added to each state's own to weight its data
FLOOR = 0.1
NAMES = ("elongation (mm)", "inclination β (rad)", "φ (rad)")


class TableRangeError(ValueError):
    """The tyre needs a motion that the table does not cover."""


@dataclass(frozen=True)
class SpokeSamples:
    """States of a spoke at coordinates (n, 3): energy (n,), derivatives (n, 3) and (n, 3, 3)."""

    coordinates: Array
    energy: Array
    force: Array
    tangent: Array


@dataclass(frozen=True)
class SpokeEnergyTable:
    """Energy of one spoke, E(s, β, φ) in N mm.

    Parameters
    ----------
    height_mm : float
        Distance between the spoke's two feet before the load.
    straight_mm : float
        a, above the range of s.
    low, high : arrays (3,)
        Range of s (mm), β (rad), φ (rad).
    exponents : array (terms, 3)
        Chebyshev degree of each term in x(s) (`coordinates.unit_elongation`), β and φ.
    coefficients : array (terms,)
        N mm.
    narrowing : float
        Fraction of the ranges of β and φ that remains at the lowest s, linear from s = 0.
    force_residual_n : float
        Root mean square misfit of the force along the line between the feet at the sampled states.
    """

    height_mm: float
    straight_mm: float
    low: Array
    high: Array
    exponents: Index
    coefficients: Array
    narrowing: float
    force_residual_n: float

    def evaluate(self, motion: Array) -> tuple[Array, Array, Array]:
        """Energy (n,), forces (n, 3) and tangents (n, 3, 3) at motions (n, 3).

        Raises
        ------
        TableRangeError
            If a motion lies outside the table.
        """
        coordinates, first, second = coordinates_of(motion, self.height_mm)
        self._check(coordinates)
        local = _local(coordinates, self.low, self.high, self.straight_mm)
        lines = _lines(*local, self.exponents)
        energy = _term(lines, (0, 0, 0)) @ self.coefficients
        force = np.empty((len(motion), 3))
        tangent = np.empty((len(motion), 3, 3))
        for i in range(3):
            force[:, i] = _term(lines, _order(i)) @ self.coefficients
        for i, j in SECOND:
            value = _term(lines, _order(i, j)) @ self.coefficients
            tangent[:, i, j] = tangent[:, j, i] = value
        return energy, *carried(force, tangent, first, second)

    def _check(self, coordinates: Array) -> None:
        part = side_part(coordinates[:, 0], self.low[0], self.narrowing)
        shrink = np.stack([np.ones_like(part), part, part], axis=1)
        low, high = self.low * shrink, self.high * shrink
        rounding = EDGE * (self.high - self.low)
        outside = ~((coordinates >= low - rounding) & (coordinates <= high + rounding))
        if outside.any():
            spoke, axis = np.argwhere(outside)[0]
            raise TableRangeError(
                f"spoke {spoke}: {NAMES[axis]} = {coordinates[spoke, axis]:.4g} is outside the "
                f"table's range {low[spoke, axis]:.4g} … {high[spoke, axis]:.4g} there"
            )


def _order(*axes: int) -> tuple[int, int, int]:
    counts = [0, 0, 0]
    for axis in axes:
        counts[axis] += 1
    return counts[0], counts[1], counts[2]


def _local(
    coordinates: Array, low: Array, high: Array, straight_mm: float
) -> tuple[Array, Array, Array]:
    """Give the polynomials' variables, from -1 to 1, and their derivatives: arrays (n, 3)."""
    slope = np.broadcast_to(2.0 / (high - low), coordinates.shape).copy()
    values, curve = (coordinates - low) * slope - 1.0, np.zeros_like(coordinates)
    limits = float(low[0]), float(high[0])
    along = unit_elongation(coordinates[:, 0], limits, straight_mm)
    values[:, 0], slope[:, 0], curve[:, 0] = along
    return values, slope, curve


def _lines(local: Array, slope: Array, curve: Array, exponents: Index) -> list[list[Array]]:
    """Chebyshev polynomials of each direction and their first two derivatives, by term."""
    lines: list[list[Array]] = []
    for axis in range(3):
        degrees = exponents[:, axis]
        value, once, twice = _polynomials(local[:, axis], int(degrees.max()))
        along, bend = slope[:, axis, None], curve[:, axis, None]
        orders = value, along * once, along**2 * twice + bend * once
        lines.append([order[:, degrees] for order in orders])
    return lines


def _polynomials(x: Array, degree: int) -> Array:
    """Chebyshev polynomials T_n and their first two derivatives, array (3, points, degree + 1).

    T_{n+1} = 2 x T_n - T_{n-1}, differentiated once and twice.
    """
    values = np.zeros((degree + 1, 3, len(x)))
    values[0, 0] = 1.0
    if degree:
        values[1, 0], values[1, 1] = x, 1.0
    for n in range(1, degree):
        values[n + 1] = 2.0 * x * values[n] - values[n - 1]
        values[n + 1, 1] += 2.0 * values[n, 0]
        values[n + 1, 2] += 4.0 * values[n, 1]
    return np.moveaxis(values, 0, 2)


def _term(lines: list[list[Array]], orders: tuple[int, int, int]) -> Array:
    product_: Array = lines[0][orders[0]] * lines[1][orders[1]] * lines[2][orders[2]]
    return product_


def chebyshev_nodes(low: float, high: float, count: int) -> Array:
    """Chebyshev points of the second kind on [low, high], including both ends."""
    unit = -np.cos(np.pi * np.arange(count) / (count - 1))
    return 0.5 * (low + high) + 0.5 * (high - low) * unit


def side_part(s: Array, lowest: float, narrowing: float) -> Array:
    """Fraction of the ranges of β and φ that the table covers at these s."""
    part: Array = 1.0 - (1.0 - narrowing) * np.clip(s / lowest, 0.0, 1.0)
    return part


def fit_energy(
    samples: SpokeSamples, options: EnergyTableOptions, geometry: SpokeGeometry
) -> SpokeEnergyTable:
    """Fit the energy polynomial to energies, forces and tangents by least squares.

    All data enter in units of energy, as derivatives with respect to the polynomials' variables;
    those of a state are divided by its energy plus a tenth of the largest, so that small loads are
    fitted as well as large ones. A table that ends early has fewer levels of s, and so a lower
    degree in s.

    Raises
    ------
    ValueError
        If the states do not determine the terms of the polynomial.
    """
    sides = (-options.inclination_rad, options.inclination_rad)
    low, high = np.array([options.elongation_mm, sides, options.phi_rad]).T
    low[0] = samples.coordinates[:, 0].min()
    narrowing = float(side_part(low[:1], options.elongation_mm[0], options.narrowing)[0])
    straight = straight_elongation_mm(geometry.height_mm, geometry.leg_angle_deg, float(high[0]))
    local, slope, curve = _local(samples.coordinates, low, high, straight)
    radial, side = options.degrees
    radial = min(radial, 2 * len(np.unique(samples.coordinates[:, 0].round(6))) - 2)
    exponents = np.array(
        [
            (i, j, k)
            for i in range(radial + 1)
            for j in range(0, side + 1, 2)
            for k in range(side + 1 - j)
        ]
    )
    lines = _lines(local, np.ones_like(slope), np.zeros_like(curve), exponents)
    design = [_term(lines, (0, 0, 0))]
    data = [samples.energy]
    force = samples.force / slope
    for i in range(3):
        design.append(_term(lines, _order(i)))
        data.append(force[:, i])
    for i, j in SECOND:
        design.append(_term(lines, _order(i, j)))
        bend = force[:, i] * curve[:, i] if i == j else 0.0
        data.append((samples.tangent[:, i, j] - bend) / (slope[:, i] * slope[:, j]))
    matrix, target = np.concatenate(design), np.concatenate(data)
    weight = 1.0 / (FLOOR + samples.energy / samples.energy.max())
    weight = np.tile(weight, len(data))
    weighted = matrix * weight[:, None], target * weight
    coefficients, _, rank, _ = np.linalg.lstsq(*weighted, rcond=1e-12)
    if rank < len(exponents):
        raise ValueError(
            f"{len(exponents)} terms cannot be determined from {len(samples.coordinates)} states "
            f"(rank {rank}): lower the degrees or take more samples"
        )
    along = _term(lines, _order(0)) @ coefficients * slope[:, 0]
    residual = float(np.sqrt(np.mean((along - samples.force[:, 0]) ** 2)))
    return SpokeEnergyTable(
        geometry.height_mm,
        straight,
        low,
        high,
        exponents,
        coefficients.astype(float),
        narrowing,
        residual,
    )
