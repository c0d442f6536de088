"""Gauss collocation of the ring's equations on short elements, each reduced to a linear map.

State rows are those of `nptcs.lca.linear.arc.STATE`, y = (u, v, Φ, N, V, M). On a free arc

    u' = V + v - Φ,  v' = ε N - u,  Φ' = κ² M,  N' = -V,  V' = N + s,  M' = V

with s the spokes' force; on flat ground the vertical pressure q joins in,

    N' = -V - q sin θ,  V' = N + s + q cos θ,

and is eliminated by flatness, V = Φ + tan θ (1 + ε N), differentiated once.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.polynomial import legendre

from nptcs.arrays import Floating

STAGES = 6
"""Gauss points per element: the order at the ends of the elements is 12."""


@dataclass(frozen=True)
class Tableau:
    """Collocation at Gauss points on 0…1."""

    nodes: Floating
    inner: Floating
    weights: Floating


@lru_cache(maxsize=2)
def gauss_tableau(stages: int = STAGES) -> Tableau:
    """Return nodes c, the matrix a of integrals from 0 to c, and the weights."""
    roots, weights = legendre.leggauss(stages)
    to_coefficients = np.linalg.inv(legendre.legvander(roots, stages - 1))
    integrals = legendre.legint(np.eye(stages), lbnd=-1, axis=0)
    inner = legendre.legvander(roots, stages) @ integrals @ to_coefficients / 2
    return Tableau((roots + 1) / 2, inner, weights / 2)


def free_matrix(theta: Floating, slope: Floating, epsilon: float, kappa2: float) -> Floating:
    """Matrix of y' = A y + b on a free arc, ``theta.shape + (6, 6)``; s = slope u + …."""
    matrix = np.zeros((*theta.shape, 6, 6))
    matrix[..., 0, 1] = 1
    matrix[..., 0, 2] = -1
    matrix[..., 0, 4] = 1
    matrix[..., 1, 0] = -1
    matrix[..., 1, 3] = epsilon
    matrix[..., 2, 5] = kappa2
    matrix[..., 3, 4] = -1
    matrix[..., 4, 3] = 1
    matrix[..., 4, 0] = slope
    matrix[..., 5, 4] = 1
    return matrix


def contact_system(
    theta: Floating, slope: Floating, offset: Floating, epsilon: float, kappa2: float
) -> tuple[Floating, Floating]:
    """Matrix and vector of y' = A y + b on flat ground with s = slope u + offset.

    From flatness, with t = tan θ and g = 1 + ε t²:
    N' = {-V - t [(1 + t²)(1 + ε N) + κ² M - N - s]}/g, V' = (1 + t²)(1 + ε N) + ε t N' + κ² M.
    """
    matrix = free_matrix(theta, slope, epsilon, kappa2)
    vector = np.zeros((*theta.shape, 6))
    t = np.tan(theta)
    secant2 = 1 + t * t
    g = 1 + epsilon * t * t
    row = np.zeros((*theta.shape, 6))
    row[..., 0] = t * slope
    row[..., 3] = -t * (secant2 * epsilon - 1)
    row[..., 4] = -1
    row[..., 5] = -t * kappa2
    row /= g[..., None]
    constant = -t * (secant2 - offset) / g
    matrix[..., 3, :] = row
    vector[..., 3] = constant
    matrix[..., 4, :] = (epsilon * t)[..., None] * row
    matrix[..., 4, 3] += secant2 * epsilon
    matrix[..., 4, 5] += kappa2
    vector[..., 4] = secant2 + epsilon * t * constant
    return matrix, vector


@dataclass(frozen=True)
class Elements:
    """Linear maps of n elements: y at the stages and at the end from y at the start.

    Parameters
    ----------
    stage_map, stage_vector : array, shapes (n, stages, 6, 6) and (n, stages, 6)
        y(stage) = map y(start) + vector.
    end_map, end_vector : array, shapes (n, 6, 6) and (n, 6)
        y(end) = map y(start) + vector.
    """

    stage_map: Floating
    stage_vector: Floating
    end_map: Floating
    end_vector: Floating


def condense(width: Floating, matrix: Floating, vector: Floating) -> Elements:
    """Eliminate the stages of n elements.

    Parameters
    ----------
    width : array, shape (n,)
        Widths of the elements.
    matrix, vector : array, shapes (n, stages, 6, 6) and (n, stages, 6)
        y' = A y + b at the stages.
    """
    n, stages = matrix.shape[:2]
    tableau = gauss_tableau(stages)
    h = width[:, None, None, None, None]
    block = h * tableau.inner[None, :, None, :, None] * matrix.swapaxes(1, 2)[:, None]
    system = np.eye(6 * stages) - block.reshape(n, 6 * stages, 6 * stages)
    right = np.empty((n, stages, 6, 7))
    right[..., :6] = np.eye(6)
    right[..., 6] = width[:, None, None] * np.einsum("ij,njk->nik", tableau.inner, vector)
    solved = np.linalg.solve(system, right.reshape(n, 6 * stages, 7)).reshape(n, stages, 6, 7)
    rates = np.einsum("nsij,nsjk->nsik", matrix, solved)
    rates[..., 6] += vector
    end = width[:, None, None] * np.einsum("s,nsik->nik", tableau.weights, rates)
    end[:, :, :6] += np.eye(6)
    return Elements(solved[..., :6], solved[..., 6], end[..., :6], end[..., 6])
