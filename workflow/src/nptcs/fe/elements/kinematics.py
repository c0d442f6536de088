"""Deformation of elements, and the products of gradients that make forces and tangents."""

from __future__ import annotations

import numpy as np

from nptcs.arrays import Array

# Voigt order of strains and stresses: 11, 22, 33, 12, 23, 13, with engineering shear strains
VOIGT = np.array([[0, 3, 5], [3, 1, 4], [5, 4, 2]])
# rows and columns of the tensors in that order
ROWS = np.array([0, 1, 2, 0, 1, 0])
COLUMNS = np.array([0, 1, 2, 1, 2, 2])


def deformation_gradient(gradient: Array, displacement: Array, frame: Array | None) -> Array:
    """F = Q + Σ u_a ⊗ ∂N_a/∂X, array (elements, points, 3, 3).

    Parameters
    ----------
    gradient : array (elements, points, nodes, directions)
    displacement : array (elements, nodes, dim)
    frame : array (elements, points, 3, 3) or None
        Q: axes of the local frame in which `gradient` is given, as columns; none for the identity.
    """
    return deformation_by_node(gradients_by_node(gradient), gradient.shape[3], displacement, frame)


def deformation_by_node(
    left: Array, directions: int, displacement: Array, frame: Array | None
) -> Array:
    """`deformation_gradient` from the gradients by node."""
    part = displacement_gradient(left, directions, displacement)
    dim = part.shape[2]
    if frame is None:
        whole = np.zeros((*part.shape[:2], 3, 3))
        whole[..., [0, 1, 2], [0, 1, 2]] = 1.0
    else:
        whole = frame.copy()
    whole[..., :dim, :directions] += part
    return whole


def displacement_gradient(left: Array, directions: int, displacement: Array) -> Array:
    """Σ u_a ⊗ ∂N_a/∂X, array (elements, points, dim, directions)."""
    elements, _, dim = displacement.shape
    part = np.matmul(displacement.swapaxes(1, 2), left).reshape(elements, dim, -1, directions)
    return part.swapaxes(1, 2)


def gradients_by_node(gradient: Array) -> Array:
    """Gradients as (elements, nodes, points × directions): the constant factor of all products."""
    elements, _, nodes, _ = gradient.shape
    return np.ascontiguousarray(gradient.transpose(0, 2, 1, 3).reshape(elements, nodes, -1))


def internal_force(left: Array, stress: Array) -> Array:
    """f_ai = Σ ∂N_a/∂X_J P_iJ: array (elements, nodes × dim); P carries the weights."""
    right = stress.swapaxes(2, 3).reshape(len(left), left.shape[2], -1)
    return np.matmul(left, right).reshape(len(left), -1)


def moduli_tangent(left: Array, columns: Array, moduli: Array) -> Array:
    """K_aibj for moduli (elements, points, J, i, j, L) that carry the weights.

    `columns` are the gradients as (elements, points, directions, nodes).
    """
    elements, points, directions, nodes = columns.shape
    dim = moduli.shape[3]
    spread = np.matmul(moduli.reshape(elements, points, -1, directions), columns)
    spread = spread.reshape(elements, points * directions, dim * dim * nodes)
    product = np.matmul(left, spread).reshape(elements, nodes, dim, dim, nodes)
    return product.swapaxes(3, 4).reshape(elements, nodes * dim, nodes * dim)


def gradient_products(gradient: Array, tensor: Array) -> Array:
    """∂N_a/∂X_J T_iJ, array (elements, points, nodes × dim)."""
    product: Array = np.matmul(gradient, tensor.swapaxes(-1, -2))
    return product.reshape(*product.shape[:2], -1)


def add_crossed(tangent: Array, left: Array, right: Array, dim: int) -> None:
    """Add Σ left_aj right_bi to K_aibj; both (elements, points, nodes × dim)."""
    shape = (len(tangent), -1, dim, tangent.shape[2] // dim, dim)
    crossed = np.matmul(left.swapaxes(1, 2), right)
    target = tangent.reshape(shape)
    target += crossed.reshape(shape).swapaxes(2, 4)


def add_isotropic(tangent: Array, left: Array, scale: Array, dim: int) -> None:
    """Add Σ a ∂N_a/∂X_J ∂N_b/∂X_J to K_aibi; a (elements, points × directions) weighted."""
    both = np.matmul(left * scale[:, None], left.swapaxes(1, 2))
    target = tangent.reshape(len(tangent), -1, dim, tangent.shape[2] // dim, dim)
    for i in range(dim):
        target[:, :, i, :, i] += both


def green_strain(deformation: Array) -> Array:
    """Green–Lagrange strain in Voigt order, array (…, 6)."""
    right = np.matmul(deformation.swapaxes(-1, -2), deformation)
    strain: Array = 0.5 * right[..., ROWS, COLUMNS]
    strain[..., :3] -= 0.5
    strain[..., 3:] *= 2.0
    return strain
