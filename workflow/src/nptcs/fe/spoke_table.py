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
from nptcs.fe.spoke import SpokeError, SpokeModel, SpokeState

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
    narrowing : float
        Part of the ranges of u_θ and φ that is left at the lowest u_r, linear from u_r = 0.
    force_residual_n : float
        Root mean square misfit of the radial force at the sampled states.
    """

    low: Array
    high: Array
    exponents: NDArray[np.int64]
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
        part = side_part(motion[:, 0], self.low[0], self.narrowing)
        shrink = np.stack([np.ones_like(part), part, part], axis=1)
        low, high = self.low * shrink, self.high * shrink
        outside = (motion < low) | (motion > high) | ~np.isfinite(motion)
        if outside.any():
            spoke, axis = np.argwhere(outside)[0]
            raise TableRangeError(
                f"spoke {spoke}: {NAMES[axis]} = {motion[spoke, axis]:.4g} is outside the table's "
                f"range {low[spoke, axis]:.4g} … {high[spoke, axis]:.4g} there"
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


def side_part(u_r: Array, lowest: float, narrowing: float) -> Array:
    """Part of the ranges of u_θ and φ that the table covers at these u_r."""
    part: Array = 1.0 - (1.0 - narrowing) * np.clip(u_r / lowest, 0.0, 1.0)
    return part


def sample(model: SpokeModel, options: SpokeTableOptions) -> SpokeSamples:
    """Compute the spoke's states on the table's grid, walking from neighbour to neighbour.

    Where a row loses its stability in compression, the samples of all rows end at its last level.

    Raises
    ------
    SpokeError
        If a state in tension or of the unloaded radius is not found.
    """
    rows = list(_rows(model, options))
    lowest = max(min(state.motion[0] for state in row) for row in rows)
    states = [state for row in rows for state in row if state.motion[0] >= lowest - 1e-9]
    return SpokeSamples(
        motion=np.array([state.motion for state in states]),
        energy=np.array([state.energy for state in states]),
        force=np.array([state.force for state in states]),
        tangent=np.array([state.tangent for state in states]),
    )


def _rows(model: SpokeModel, options: SpokeTableOptions) -> Iterator[list[SpokeState]]:
    """For each (u_θ, φ): straight rows from u_r = 0 to both ends, each state from the last two."""
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
        states = list(_row(model, options, start, radial[radial > 0.0]))
        try:
            for state in _row(model, options, start, radial[radial < 0.0][::-1]):
                states.append(state)
        except SpokeError:
            # the spoke buckles: `sample` ends the table at the last level that all rows reach
            pass
        yield states


def _row(
    model: SpokeModel, options: SpokeTableOptions, start: SpokeState, heights: Array
) -> Iterator[SpokeState]:
    history = [start]
    parts = side_part(heights, options.u_r_mm[0], options.narrowing)
    for u_r, part in zip(heights, parts, strict=True):
        motion = np.array([u_r, part * start.motion[1], part * start.motion[2]])
        history.append(model.follow(history, motion))
        yield history[-1]


def fit(samples: SpokeSamples, options: SpokeTableOptions) -> SpokeTable:
    """Fit the energy polynomial to energies, forces and tangents by least squares.

    All data enter in units of energy: forces times the half range, tangents times its square. A
    table that ends early has fewer levels of u_r, and for them a lower degree.
    """
    low, high = np.array([options.u_r_mm, options.u_theta_mm, options.phi_rad]).T
    low[0] = samples.motion[:, 0].min()
    narrowing = float(side_part(low[:1], options.u_r_mm[0], options.narrowing)[0])
    half = 0.5 * (high - low)
    local = (samples.motion - low) / half - 1.0
    radial, side = options.degrees
    radial = min(radial, 2 * len(np.unique(samples.motion[:, 0])) - 2)
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
    return SpokeTable(low, high, exponents, coefficients.astype(float), narrowing, residual)
