"""Motion that the ring gives to the spokes: the mean of each foot over its width."""

from __future__ import annotations

import numpy as np

from nptcs.arrays import Array, Index
from nptcs.fe.elements.lagrange import line_shape
from nptcs.fe.tyre.mesh import RingMesh

POINTS = 3


def foot_operators(ring: RingMesh) -> Array:
    """Mean motion of each foot: (u_r, u_θ, φ) = L u, array (spokes, 3, 2 × nodes of a foot).

    u_r and u_θ are means over the foot, φ = ∫ s u_r ds / ∫ s² ds with s along +θ from its middle.
    A foot may begin and end inside an edge of the ring.
    """
    outward = np.stack([np.sin(ring.spoke_angle), -np.cos(ring.spoke_angle)], axis=1)
    along = np.stack([np.cos(ring.spoke_angle), np.sin(ring.spoke_angle)], axis=1)
    order = ring.tread_edges.shape[1] - 1
    starts = range(0, ring.feet.shape[1] - 1, order)
    parts = [_edge(ring, slice(start, start + order + 1), along) for start in starts]
    length = sum(stretch.sum(axis=1) for _, stretch, _ in parts)
    middle = sum(np.sum(stretch * arm, axis=1) for _, stretch, arm in parts) / length
    moment = np.zeros(len(ring.feet))
    operators = np.zeros((len(ring.feet), 3, ring.feet.shape[1], 2))
    for start, (shape, stretch, reach) in zip(starts, parts, strict=True):
        local, arm = slice(start, start + order + 1), reach - middle[:, None]
        mean = np.einsum("sgn,sg->sn", shape, stretch)
        turning = np.einsum("sgn,sg->sn", shape, stretch * arm)
        moment += np.sum(stretch * arm**2, axis=1)
        operators[:, 0, local] += mean[..., None] * outward[:, None]
        operators[:, 1, local] += mean[..., None] * along[:, None]
        operators[:, 2, local] += turning[..., None] * outward[:, None]
    operators[:, :2] /= length[:, None, None, None]
    operators[:, 2] /= moment[:, None, None]
    return operators.reshape(len(ring.feet), 3, -1)


def _edge(ring: RingMesh, local: slice, along: Array) -> tuple[Array, Array, Array]:
    """Shape functions, lengths and arms at points of the part of one edge that a foot covers.

    Arrays (spokes, points, nodes of the edge), (spokes, points), (spokes, points), for one edge of
    each foot; the arms are lengths along +θ from the foot's direction.
    """
    nodes = ring.feet[:, local]
    low, high = _covered(ring, nodes)
    points, weights = np.polynomial.legendre.leggauss(POINTS)
    places = (low + high)[:, None] / 2.0 + (high - low)[:, None] / 2.0 * points
    shape, slope = (
        part.reshape(*places.shape, -1) for part in line_shape(nodes.shape[1] - 1, places.ravel())
    )
    corner = ring.positions[nodes]
    stretch = np.linalg.norm(np.einsum("sgn,sni->sgi", slope, corner), axis=2)
    stretch = stretch * weights * (high - low)[:, None] / 2.0
    return shape, stretch, np.einsum("sgn,sni,si->sg", shape, corner, along)


def _covered(ring: RingMesh, nodes: Index) -> tuple[Array, Array]:
    """Local coordinates, from -1 to 1, between which a foot covers its edge; equal: not at all."""
    x, y = ring.positions[nodes[:, [0, -1]]].transpose(2, 0, 1)
    ends = np.arctan2(x, -y) - ring.spoke_angle[:, None]
    ends = (ends + np.pi) % (2.0 * np.pi) - np.pi
    middle, reach = ends.mean(axis=1), np.ptp(ends, axis=1) / 2.0
    # on a chord of angle 2 reach, the ray at an angle from its middle
    low, high = (
        np.clip(np.tan(side * ring.foot_half_angle - middle) / np.tan(reach), -1.0, 1.0)
        for side in (-1.0, 1.0)
    )
    return low, high
