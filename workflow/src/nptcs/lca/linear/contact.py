"""The contact region, made flat by a small spectral system instead of a series of cosines.

The ground's pressure is vertical, so the horizontal resultant H = N cos θ + V sin θ is constant
and the vertical one, W = V cos θ - N sin θ, is half the ground's force on |θ| ≤ θ: W' = b R q/GA.
Flatness, u cos θ - v sin θ = 1 - cos θ - δ, leaves

    (cos² θ + ε sin² θ) W = cos θ [Φ - H (1 - ε) sin θ] + sin θ,
    Φ = κ² ∫₀^θ M,  M = m - ∫_θ^θc V,  V = W cos θ + H sin θ

for W, an odd function of θ. It is solved at Chebyshev points by exact integration of the odd
polynomial through them; m, the moment at θc, H and δ stay free. (The moment at the centre would
do as well on paper; but then W grows as exp κθ and digits are lost.)
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.polynomial import chebyshev

from nptcs.arrays import Floating

_POINTS = ((0.5, 8), (1.25, 16), (13.0, 40), (np.inf, 64))
"""Largest max(θc, κθc/6) and the points on 0 < θ ≤ θc that resolve it to 1e-12."""
LARGEST_KAPPA_ANGLE = 200.0
"""Largest κθc that the most points resolve."""
COLUMNS = ("m", "h", "delta", "one")
"""Columns of the contact states: moment at θc, H, δ, and what does not depend on these."""


@dataclass(frozen=True)
class IntegrationRule:
    """Spectral integration on 0…1 for functions known at `nodes`, the last of which is 1."""

    nodes: Floating
    to_odd: Floating
    to_even: Floating
    once_odd: Floating
    rotation_odd: Floating
    end_even: Floating
    slope_odd: Floating


@lru_cache(maxsize=8)
def rule(points: int) -> IntegrationRule:
    """Return integration matrices, all from 0.

    ``once_odd`` integrates an odd function V to the nodes, ``rotation_odd`` integrates
    -∫_τ^1 V from 0 to the nodes, ``end_even`` integrates an even function to 1,
    ``slope_odd`` differentiates an odd one at 0 and at the nodes, ``to_odd`` and ``to_even``
    give Chebyshev coefficients.
    """
    nodes = np.cos(np.pi * np.arange(points - 1, -1, -1) / (2 * points - 1))
    size = 2 * points
    odd, even = np.eye(size)[1::2], np.eye(size)[0::2]

    def values(coefficients: Floating) -> Floating:
        return np.asarray(chebyshev.chebval(nodes, coefficients.T)).T

    to_odd = np.linalg.inv(values(odd))
    to_even = np.linalg.inv(values(even))
    once = chebyshev.chebint(odd, lbnd=0, axis=1)
    twice = chebyshev.chebint(once, lbnd=0, axis=1)
    end = np.asarray(chebyshev.chebval(1.0, chebyshev.chebint(even, lbnd=0, axis=1).T))
    slopes = chebyshev.chebder(odd, axis=1).T
    slope = np.asarray(chebyshev.chebval(np.append(0.0, nodes), slopes)).T
    return IntegrationRule(
        nodes,
        odd.T @ to_odd,
        even.T @ to_even,
        values(once) @ to_odd,
        values(twice) @ to_odd - np.outer(nodes, (values(once) @ to_odd)[-1]),
        to_even.T @ end,
        slope @ to_odd,
    )


@dataclass(frozen=True)
class Contact:
    """Solutions of the contact region of n designs, by the columns of `COLUMNS`.

    Parameters
    ----------
    angle : array, shape (n,)
        Contact angle θc.
    vertical : array, shape (n, points, 4)
        W/GA at the nodes.
    edge : array, shape (n, 6, 4)
        State at θc, rows as `nptcs.lca.linear.arc.STATE`.
    pressure : array, shape (n, 4)
        b R q/GA at θc.
    """

    angle: Floating
    vertical: Floating
    edge: Floating
    pressure: Floating


def hardness(kappa2: Floating, angle: Floating) -> Floating:
    """Return what decides the number of points, max(θc, κθc/6)."""
    return np.asarray(np.maximum(angle, np.sqrt(kappa2) * angle / 6))


def points_for(kappa2: Floating, angle: Floating) -> int:
    """Return the number of points that resolves all of n designs."""
    hardest = float(hardness(kappa2, angle).max(initial=0.0))
    return next(points for limit, points in _POINTS if hardest <= limit)


def _forcing(
    theta: Floating, epsilon: Floating, kappa2: Floating, angle: Floating, r: IntegrationRule
) -> Floating:
    """Right-hand side of the system for W, by the columns of `COLUMNS`."""
    sine, cosine = np.sin(theta), np.cos(theta)
    force = np.zeros((*theta.shape, 4))
    force[..., 0] = cosine * kappa2[:, None] * theta
    bending = (kappa2 * angle**2)[:, None] * (sine @ r.rotation_odd.T)
    force[..., 1] = cosine * (bending - sine * (1 - epsilon)[:, None])
    force[..., 3] = sine
    return force


def solve_contact(
    epsilon: Floating, kappa2: Floating, angle: Floating, points: int | None = None
) -> Contact:
    """Solve the contact region of n designs for given contact angles.

    Parameters
    ----------
    epsilon, kappa2, angle : array, shape (n,)
        ε = GA/EA, κ² = GA R²/EI and θc in radians, 0 < θc < π/2.
    points : int, optional
        Points of the spectral system; by default those of `points_for`.
    """
    points = points_for(kappa2, angle) if points is None else points
    r = rule(points)
    theta = angle[:, None] * r.nodes
    sine, cosine = np.sin(theta), np.cos(theta)
    weight = (kappa2 * angle**2)[:, None] * cosine
    matrix = -weight[:, :, None] * r.rotation_odd * cosine[:, None, :]
    diagonal = np.arange(points)
    matrix[:, diagonal, diagonal] += cosine**2 + epsilon[:, None] * sine**2
    vertical = np.linalg.solve(matrix, _forcing(theta, epsilon, kappa2, angle, r))
    edge = _edge_states(theta, vertical, epsilon, kappa2, angle, r)
    return Contact(angle, vertical, edge, _edge_pressure(edge, epsilon, kappa2, angle, vertical))


def _edge_states(
    theta: Floating,
    vertical: Floating,
    epsilon: Floating,
    kappa2: Floating,
    angle: Floating,
    r: IntegrationRule,
) -> Floating:
    """State at θc from W at the nodes, shape (n, 6, 4)."""
    sine, cosine, tangent = np.sin(theta), np.cos(theta), np.tan(theta)
    shear = vertical * cosine[..., None]
    shear[..., 1] += sine
    moment = np.zeros_like(shear[:, 0])
    moment[:, 0] = 1
    phi = (kappa2 * angle**2)[:, None] * np.einsum("p,npc->nc", r.rotation_odd[-1], shear)
    phi[:, 0] += kappa2 * angle
    slip = -np.einsum("np,npc->nc", angle[:, None] * r.end_even * tangent, vertical)
    slip[:, 1] += angle
    horizontal = epsilon[:, None] * slip
    end, s, c = vertical[:, -1], sine[:, -1], cosine[:, -1]
    horizontal[:, 3] += np.arctanh(s) - s
    sinking = np.zeros_like(horizontal)
    sinking[:, 2] = -1
    sinking[:, 3] = 2 * np.sin(angle / 2) ** 2
    s, c = s[:, None], c[:, None]
    axial = -end * s
    axial[:, 1] += c[:, 0]
    radial, tangential = sinking * c + horizontal * s, horizontal * c - sinking * s
    return np.stack([radial, tangential, phi, axial, shear[:, -1], moment], axis=1)


def _edge_pressure(
    edge: Floating, epsilon: Floating, kappa2: Floating, angle: Floating, vertical: Floating
) -> Floating:
    """W' at θc, from the derivative of the equation for W."""
    s, c = np.sin(angle)[:, None], np.cos(angle)[:, None]
    eps = epsilon[:, None]
    phi, moment, end = edge[:, 2], edge[:, 5], vertical[:, -1]
    slope = c * kappa2[:, None] * moment - s * phi + 2 * (1 - eps) * s * c * end
    slope[:, 1] -= ((1 - eps) * (c * c - s * s))[:, 0]
    slope[:, 3] += c[:, 0]
    return np.asarray(slope / (c * c + eps * s * s))
