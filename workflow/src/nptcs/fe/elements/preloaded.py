"""Compiled functions made ready when this module is imported, in a process that others fork from.

The campaign starts each case as a copy of one process. That process imports and compiles, or reads
numba's copies from disk (0.5 s), once for all cases.
"""

from __future__ import annotations

import numpy as np

from nptcs.fe.elements.groups import LinearGroup, MixedGroup, RubberGroup, element_dofs
from nptcs.fe.elements.lagrange import gauss, jacobians, tensor_shape
from nptcs.fe.matrices.block_tridiagonal import BlockPattern

ORDERS = (2, 2, 2)


def make_ready() -> None:
    """Compile what elements and matrices need, on one element of each kind."""
    points, weights = gauss([order + 1 for order in ORDERS])
    corners = np.stack(np.meshgrid(*[np.arange(3.0)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    gradient, volume = jacobians(tensor_shape(ORDERS, points)[1], corners[None])
    nodes, weight = np.arange(len(corners))[None], volume * weights
    stiffness = np.repeat(np.eye(6)[None], len(points), axis=0)
    groups: list[MixedGroup] = [
        RubberGroup(nodes, gradient, weight, np.ones((len(points), 1)), 1.0, 1.0),
        LinearGroup(nodes, gradient, weight, stiffness),
    ]
    rest = np.zeros_like(corners)
    dofs = element_dofs(nodes, 3)
    pattern = BlockPattern([dofs], dofs.size, dofs.size)
    for group in groups:
        pattern.assemble([group.respond(rest).tangent])
        group.follow(rest)
        group.forces(rest)


make_ready()
