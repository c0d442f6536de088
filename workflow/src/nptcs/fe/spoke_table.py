"""The spoke as a super-element: a polynomial energy of the band's motion (u_r, u_θ, φ).

The polynomial is fitted to energies, forces and condensed tangents of finite element states
together, so that forces and tangents in the tyre are exact derivatives of one energy.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from nptcs.config.fe import SpokeTableOptions
from nptcs.fe.spoke import SpokeModel, SpokeState

Array = NDArray[np.float64]

SECOND = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))
NAMES = ("u_r (mm)", "u_θ (mm)", "φ (rad)")


class TableRangeError(ValueError):
    """The tyre asks for a motion that the table does not cover."""


@dataclass(frozen=True)
class SpokeSamples:
    """States of a spoke: motion (n, 3), energy (n,), force (n, 3), tangent (n, 3, 3)."""

    motion: Array
    energy: Array
    force: Array
    tangent: Array


@dataclass(frozen=True)
class SpokeTable:
    """Energy of one spoke, E(u_r, u_θ, φ) in N mm.

    Parameters
    ----------
    low, high : arrays (3,)
        Range of u_r (mm), u_θ (mm), φ (rad).
    exponents : array (terms, 3)
        Chebyshev degree of each term in each direction.
    coefficients : array (terms,)
        N mm.
    force_residual_n : float
        Root mean square misfit of the radial force at the sampled states.
    """

    low: Array
    high: Array
    exponents: NDArray[np.int64]
    coefficients: Array
    force_residual_n: float

    def evaluate(self, motion: Array) -> tuple[Array, Array, Array]:
        """Energy (n,), forces (n, 3) and tangents (n, 3, 3) at motions (n, 3).

        Raises
        ------
        TableRangeError
            If a motion lies outside the table.
        """
        self._check(motion)
        scale = 2.0 / (self.high - self.low)
        local = (motion - self.low) * scale - 1.0
        lines = _lines(local, self.exponents)
        energy = _term(lines, (0, 0, 0)) @ self.coefficients
        force = np.empty((len(motion), 3))
        tangent = np.empty((len(motion), 3, 3))
        for i in range(3):
            force[:, i] = _term(lines, _order(i)) @ self.coefficients * scale[i]
        for i, j in SECOND:
            value = _term(lines, _order(i, j)) @ self.coefficients * scale[i] * scale[j]
            tangent[:, i, j] = tangent[:, j, i] = value
        return energy, force, tangent

    def _check(self, motion: Array) -> None:
        outside = (motion < self.low) | (motion > self.high) | ~np.isfinite(motion)
        if outside.any():
            spoke, axis = np.argwhere(outside)[0]
            raise TableRangeError(
                f"spoke {spoke}: {NAMES[axis]} = {motion[spoke, axis]:.4g} is outside the table's "
                f"range {self.low[axis]:g} … {self.high[axis]:g}"
            )


def _order(*axes: int) -> tuple[int, int, int]:
    counts = [0, 0, 0]
    for axis in axes:
        counts[axis] += 1
    return counts[0], counts[1], counts[2]


def _lines(local: Array, exponents: NDArray[np.int64]) -> list[list[Array]]:
    """Chebyshev polynomials of each direction and their first two derivatives, by term."""
    lines: list[list[Array]] = []
    for axis in range(3):
        degrees = exponents[:, axis]
        unit = np.eye(int(degrees.max()) + 1)
        axis_lines: list[Array] = []
        for order in range(3):
            derived = chebyshev.chebder(unit, order, axis=0) if order else unit
            values = chebyshev.chebval(local[:, axis], derived)
            axis_lines.append(np.atleast_2d(values).T[:, degrees].astype(float))
        lines.append(axis_lines)
    return lines


def _term(lines: list[list[Array]], orders: tuple[int, int, int]) -> Array:
    product_: Array = lines[0][orders[0]] * lines[1][orders[1]] * lines[2][orders[2]]
    return product_


def chebyshev_nodes(low: float, high: float, count: int) -> Array:
    """Chebyshev points of the second kind on [low, high], both ends with them."""
    unit = -np.cos(np.pi * np.arange(count) / (count - 1))
    return 0.5 * (low + high) + 0.5 * (high - low) * unit


def sample(model: SpokeModel, options: SpokeTableOptions) -> SpokeSamples:
    """Compute the spoke's states on the table's grid, walking from neighbour to neighbour."""
    states = list(_walk(model, options))
    return SpokeSamples(
        motion=np.array([state.motion for state in states]),
        energy=np.array([state.energy for state in states]),
        force=np.array([state.force for state in states]),
        tangent=np.array([state.tangent for state in states]),
    )


def _walk(model: SpokeModel, options: SpokeTableOptions) -> Iterator[SpokeState]:
    """For each (u_θ, φ): from u_r = 0 along u_r to both ends, guessing from the last two."""
    radial = chebyshev_nodes(*options.u_r_mm, options.samples[0])
    sides = [
        chebyshev_nodes(*limits, count)
        for limits, count in zip(
            (options.u_theta_mm, options.phi_rad), options.samples[1:], strict=True
        )
    ]
    rest = model.rest()
    for u_theta, phi in product(*sides):
        start = model.move(rest, np.array([0.0, u_theta, phi]))
        for heights in (radial[radial > 0.0], radial[radial < 0.0][::-1]):
            history = [start]
            for u_r in heights:
                history.append(model.follow(history, np.array([u_r, u_theta, phi])))
                yield history[-1]


def fit(samples: SpokeSamples, options: SpokeTableOptions) -> SpokeTable:
    """Fit the energy polynomial to energies, forces and tangents by least squares.

    All data enter in units of energy: forces times the half range, tangents times its square.
    """
    low, high = np.array([options.u_r_mm, options.u_theta_mm, options.phi_rad]).T
    half = 0.5 * (high - low)
    local = (samples.motion - low) / half - 1.0
    radial, side = options.degrees
    exponents = np.array(
        [(i, j, k) for i in range(radial + 1) for j in range(side + 1) for k in range(side + 1 - j)]
    )
    lines = _lines(local, exponents)
    design = [_term(lines, (0, 0, 0))]
    data = [samples.energy]
    for i in range(3):
        design.append(_term(lines, _order(i)))
        data.append(samples.force[:, i] * half[i])
    for i, j in SECOND:
        design.append(_term(lines, _order(i, j)))
        data.append(samples.tangent[:, i, j] * half[i] * half[j])
    matrix, target = np.concatenate(design), np.concatenate(data)
    coefficients, _, rank, _ = np.linalg.lstsq(matrix, target, rcond=1e-12)
    if rank < len(exponents):
        raise ValueError(
            f"{len(exponents)} terms cannot be found from {len(samples.motion)} states "
            f"(rank {rank}): lower degrees or take more samples"
        )
    force = _term(lines, _order(0)) @ coefficients / half[0]
    residual = float(np.sqrt(np.mean((force - samples.force[:, 0]) ** 2)))
    return SpokeTable(low, high, exponents, coefficients.astype(float), residual)
