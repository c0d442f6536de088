"""Deformation gradients of elements and their strains."""

from __future__ import annotations

import numpy as np

from nptcs.arrays import Array

# rows and columns of the tensors in Voigt's order 11, 22, 33, 12, 23, 13; shears are angles
ROWS = np.array([0, 1, 2, 0, 1, 0])
COLUMNS = np.array([0, 1, 2, 1, 2, 2])


def deformation_gradient(gradient: Array, displacement: Array, frame: Array | None) -> Array:
    """F = Q + Σ u_a ⊗ ∂N_a/∂X, array (elements, points, 3, 3).

    Parameters
    ----------
    gradient : array (elements, points, nodes, directions)
    displacement : array (elements, nodes, dim)
    frame : array (elements, points, 3, 3) or None
        Q: axes of the local frame in which `gradient` is given, as columns; None for the identity.
    """
    elements, points, _, directions = gradient.shape
    whole = np.empty((elements, points, 3, 3))
    whole[:] = np.eye(3) if frame is None else frame
    part = np.matmul(displacement[:, None].swapaxes(2, 3), gradient)
    whole[..., : displacement.shape[2], :directions] += part
    return whole


def green_strain(deformation: Array) -> Array:
    """Green–Lagrange strain in Voigt order, array (…, 6)."""
    right = np.matmul(deformation.swapaxes(-1, -2), deformation)
    strain: Array = 0.5 * right[..., ROWS, COLUMNS]
    strain[..., :3] -= 0.5
    strain[..., 3:] *= 2.0
    return strain
