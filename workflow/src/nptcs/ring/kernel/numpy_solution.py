"""The linear system of an iterate by LAPACK's factorisation of a band."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from scipy.linalg.lapack import dgbtrf, dgbtrs

from nptcs.arrays import Array, Index
from nptcs.fe.matrices.cyclic import folded_order
from nptcs.ring.kernel.elementwise.places import UNKNOWNS
from nptcs.ring.kernel.system import NO_FEET, FootTangent

# neighbours in folded order are two nodes apart
BAND = 3 * UNKNOWNS - 1
# rows of the band's storage: room for exchanged rows above the band itself
ROWS = 3 * BAND + 1
# Equations of the turns in 1/16: entries (N, N mm) are then of one size, and LAPACK exchanges few
# rows, which takes a third of its time. A power of two adds no rounding.
UNITS = np.array([1.0, 1.0, 0.0625, 0.0625, 1.0])


def solve(
    diagonal: Array, upper: Array, lower: Array, rhs: Array, feet: FootTangent = NO_FEET
) -> Array:
    """Solve the cyclic system for right-hand sides (nodes, 5, n).

    Raises
    ------
    FloatingPointError
        If the matrix is singular.
    """
    factors = _Factors.of(diagonal, upper, lower)
    folded = np.empty((factors.size, rhs.shape[2]), order="F")
    folded[factors.order] = rhs.reshape(factors.size, -1)
    found = factors.solved(folded)
    if len(feet.nodes):
        found -= _held_back(factors, found, feet)
    return found[factors.order].reshape(rhs.shape)


def _held_back(factors: _Factors, free: Array, feet: FootTangent) -> Array:
    """Give what the wide feet take from the solution without them, both in folded order.

    The feet are a change of low rank: with B their levers and S their stiffness,
    (A + B S Bᵀ)⁻¹ = A⁻¹ - A⁻¹ B (1 + S Bᵀ A⁻¹ B)⁻¹ S Bᵀ A⁻¹.
    """
    wide = len(feet.nodes)
    dofs = factors.order.reshape(-1, UNKNOWNS)[feet.nodes]
    # rows are exchanged over the width of the band at most
    first = max(int(dofs.min()) - BAND, 0)
    levers = np.zeros((factors.size - first, 3 * wide), order="F")
    columns = np.arange(3 * wide).reshape(wide, 1, 3, 1)
    levers[dofs[:, :, None] - first, columns] = feet.lever
    moved = levers.T @ factors.solved(levers, first)
    felt = np.concatenate([moved, levers.T @ free[first:]], axis=1)
    held = (feet.hold @ felt.reshape(wide, 3, -1)).reshape(3 * wide, -1)
    forces = np.linalg.solve(np.eye(3 * wide) + held[:, : 3 * wide], held[:, 3 * wide :])
    sides = np.zeros_like(free)
    sides[first:] = levers @ forces
    return factors.solved(sides)


@dataclass(frozen=True)
class _Factors:
    """Factors of a cyclic matrix in folded order.

    Parameters
    ----------
    order : array (unknowns,)
        Place of each unknown in folded order.
    units : array (unknowns,)
        `UNITS` of the equations.
    band : array (ROWS, unknowns)
    exchanged : array (unknowns,)
        Row with which each was exchanged, as LAPACK counts them.
    """

    order: Index
    units: Array
    band: Array
    exchanged: Index

    @classmethod
    def of(cls, diagonal: Array, upper: Array, lower: Array) -> _Factors:
        """Factorise; FloatingPointError if the matrix is singular."""
        order, units, place = _places(len(diagonal))
        stored = np.zeros(len(order) * ROWS)
        blocks = [(UNITS[:, None] * part).ravel() for part in (diagonal, upper, lower)]
        stored[place] = np.concatenate(blocks)
        band, exchanged, failed = dgbtrf(stored.reshape(-1, ROWS).T, BAND, BAND, overwrite_ab=1)
        if failed:
            raise FloatingPointError("the tangent is singular")
        return cls(order, units, band, exchanged)

    @property
    def size(self) -> int:
        """Number of unknowns."""
        return len(self.order)

    def solved(self, sides: Array, first: int = 0) -> Array:
        """Solve for right-hand sides (unknowns, n), or for those from `first` on.

        What is eliminated before `first` leaves right-hand sides alone that are zero up to
        `BAND` rows after it: these need only the last part of the factors.
        """
        found: Array = dgbtrs(
            self.band[:, first:],
            BAND,
            BAND,
            self.units[first:, None] * sides,
            self.exchanged[first:] - first,
            overwrite_b=1,
        )[0]
        return found


@cache
def _places(count: int) -> tuple[Index, Array, Index]:
    """Give `order` and `units` of `_Factors`, and the place of each block entry in its `band`."""
    node = folded_order(count)
    dofs = node[:, None] * UNKNOWNS + np.arange(UNKNOWNS)
    after = np.roll(dofs, -1, axis=0)
    places = [
        (column[:, None, :] * ROWS + 2 * BAND + row[:, :, None] - column[:, None, :]).ravel()
        for row, column in ((dofs, dofs), (dofs, after), (after, dofs))
    ]
    return dofs.ravel(), np.tile(UNITS, count), np.concatenate(places)
