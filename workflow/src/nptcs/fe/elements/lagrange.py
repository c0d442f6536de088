"""Tensor-product Lagrange elements and Gauss rules of any order in each direction."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from nptcs.arrays import Array

QuadratureRule = tuple[Array, Array]
"""Points, one row each where there are several directions, and weights."""


def line_shape(order: int, xi: Array) -> tuple[Array, Array]:
    """Lagrange polynomials on equally spaced nodes of [-1, 1].

    Parameters
    ----------
    order : int
        Polynomial order, 1 or more.
    xi : array (points,)
        Where to evaluate; points outside [-1, 1] extrapolate the polynomial.

    Returns
    -------
    value, slope : arrays (points, order + 1)
    """
    nodes = np.linspace(-1.0, 1.0, order + 1)
    value = np.ones((len(xi), order + 1))
    slope = np.zeros((len(xi), order + 1))
    for a, node in enumerate(nodes):
        roots = np.delete(nodes, a)
        scale = np.prod(node - roots)
        value[:, a] = np.prod(xi[:, None] - roots, axis=1) / scale
        for k in range(order):
            slope[:, a] += np.prod(xi[:, None] - np.delete(roots, k), axis=1) / scale
    return value, slope


def tensor_shape(orders: Sequence[int], points: Array) -> tuple[Array, Array]:
    """Shape functions of a tensor-product element; the last direction runs fastest.

    Parameters
    ----------
    orders : sequence of int
        Polynomial order in each direction.
    points : array (points, directions)
        Local coordinates.

    Returns
    -------
    value : array (points, nodes)
    slope : array (points, nodes, directions)
        Derivatives with respect to the local coordinates.
    """
    lines = [line_shape(order, points[:, i]) for i, order in enumerate(orders)]
    count = len(points)
    value = np.ones((count, 1))
    for shape, _ in lines:
        value = (value[:, :, None] * shape[:, None, :]).reshape(count, -1)
    slopes = []
    for direction in range(len(orders)):
        product = np.ones((count, 1))
        for i, (shape, derivative) in enumerate(lines):
            factor = derivative if i == direction else shape
            product = (product[:, :, None] * factor[:, None, :]).reshape(count, -1)
        slopes.append(product)
    return value, np.stack(slopes, axis=2)


def gauss(counts: Sequence[int]) -> QuadratureRule:
    """Gauss points and weights on the cube [-1, 1]^n; the last direction runs fastest."""
    return tensor_rule([np.polynomial.legendre.leggauss(n) for n in counts])


def tensor_rule(lines: Sequence[QuadratureRule]) -> QuadratureRule:
    """Join one-dimensional rules (points, weights) into a rule on their product."""
    grids = np.meshgrid(*[points for points, _ in lines], indexing="ij")
    weights = np.meshgrid(*[weight for _, weight in lines], indexing="ij")
    points = np.stack([grid.ravel() for grid in grids], axis=1)
    return points, np.prod([weight.ravel() for weight in weights], axis=0)


def jacobians(slope: Array, corners: Array) -> tuple[Array, Array]:
    """Map local derivatives to derivatives with respect to position.

    Parameters
    ----------
    slope : array (points, nodes, directions)
    corners : array (elements, nodes, directions)
        Reference positions of the nodes, mm.

    Returns
    -------
    gradient : array (elements, points, nodes, directions)
    determinant : array (elements, points)
        Volume (area) per unit of local volume.

    Raises
    ------
    ValueError
        If an element is inverted.
    """
    jacobian = np.einsum("gnk,eni->egik", slope, corners)
    determinant = np.linalg.det(jacobian)
    if np.any(determinant <= 0.0):
        bad = int(np.argmin(determinant.min(axis=1)))
        raise ValueError(f"element {bad} is inverted: smallest determinant {determinant.min():.3g}")
    gradient = np.einsum("gnk,egki->egni", slope, np.linalg.inv(jacobian))
    return gradient, determinant
