"""Plates as shells embedded in bricks: their mid-surface stays straight across their width.

An embedded shell node moves with the linear brick around it. The paper's 3612 bricks per spoke
(table 4) are 84 times 43, and 43 across the width of 215 mm are 5 mm each, as wide as a plate. The
plate can stretch and twist and its sections can turn, but its mid-surface cannot bow across the
width, which suppresses part of the curvature that bending at the fibres' angle would give it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nptcs.arrays import Array, Index
from nptcs.fe.elements.groups import ElementResponse
from nptcs.fe.spoke.mesh import ElementSet

# stiffness of the springs along each line of nodes, as a multiple of the ply's transverse modulus:
# a hundred times this changes a spoke's stiffness by less than 0.01 % and adds rounding errors
HELD = 100.0
SIMPSON = np.array([1.0, 4.0, 1.0]) / 6.0


@dataclass(frozen=True)
class StraightGroup:
    """Springs from the mid-surface to the straight line between the plate's edges.

    Energy: ½ Σ k |m_j - (1 - t_j) m_0 - t_j m_1|² over the nodes inside the plate's width, m the
    mean of its two faces. It does not change under rigid motions, however large.

    Parameters
    ----------
    nodes : array (rows of elements, nodes of a row)
    bow : array (springs of a row, nodes of a row)
        How far each node inside is from the line, as a sum over the nodes of its row.
    spring : array (rows of elements, springs of a row)
        k, N/mm.
    """

    nodes: Index
    bow: Array
    spring: Array

    def energies(self, displacement: Array) -> Array:
        """Energy of each row of elements, N mm, array (rows,)."""
        bowed = np.matmul(self.bow, displacement[self.nodes])
        energy: Array = 0.5 * np.einsum("rb,rbi->r", self.spring, bowed**2)
        return energy

    def forces(self, displacement: Array) -> tuple[float, Array]:
        """Energy and forces for nodal displacements (nodes, 3)."""
        pull = self.spring[..., None] * np.matmul(self.bow, displacement[self.nodes])
        force = np.matmul(self.bow.T, pull).reshape(len(self.nodes), -1)
        return float(np.sum(self.energies(displacement))), force

    def respond(self, displacement: Array) -> ElementResponse:
        """Energy, forces and tangents for nodal displacements (nodes, 3)."""
        stiffness = np.matmul(self.bow.T, self.spring[..., None] * self.bow)
        rows, count = self.nodes.shape
        tangent = np.zeros((rows, count, 3, count, 3))
        for axis in range(3):
            tangent[:, :, axis, :, axis] = stiffness
        return ElementResponse(
            *self.forces(displacement), tangent.reshape(rows, 3 * count, 3 * count)
        )


def straight_group(plate: ElementSet, plate_columns: int, e2_mpa: float) -> StraightGroup:
    """Springs of all plates of a mesh.

    Parameters
    ----------
    plate : ElementSet
        Elements of order 1 × 2 × 2 (thickness, width, length), those across a plate's width
        following each other.
    plate_columns : int
        Elements across a plate's width.
    e2_mpa : float
        Transverse modulus of the ply.
    """
    corners = plate.corners.reshape(-1, plate_columns, 2, 3, 3, 3)[:, 0, 0, 0]
    length = np.linalg.norm(corners[:, 2] - corners[:, 0], axis=1)
    lines = 2 * plate_columns
    part = np.arange(1, lines) / lines
    across = np.zeros((lines - 1, lines + 1))
    across[:, 0], across[:, -1] = part - 1.0, -part
    across[np.arange(lines - 1), np.arange(1, lines)] = 1.0
    # springs by line and height; nodes by face, line and height
    bow = np.kron(np.kron(np.array([[0.5, 0.5]]), across), np.eye(3)).astype(np.float64)
    spring = HELD * e2_mpa * length[:, None] * np.tile(SIMPSON, lines - 1)
    return StraightGroup(_rows(plate.nodes, plate_columns), bow, spring)


def _rows(nodes: Index, plate_columns: int) -> Index:
    """Nodes of each row of elements across a plate: array (rows, 2 faces × lines × 3)."""
    parts = nodes.reshape(-1, plate_columns, 2, 3, 3)
    inner = [parts[:, column, :, 1:] for column in range(plate_columns)]
    whole = np.concatenate([parts[:, 0, :, :1], *inner], axis=2)
    return whole.reshape(len(whole), -1)
