"""Feet of spokes over their true width: the nodes that a foot covers, and their weights in it.

A foot presses on the band over its width. Where the ring's elements are shorter than a foot, its
motion (u_r, u_θ, φ) is that of the finite element tyre: u_r and u_θ are means over the width, φ is
∫ x u_r dx / ∫ x² dx with x along +θ from the foot's middle. Elsewhere a foot is its node.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nptcs.arrays import Array, Index
from nptcs.ring.nodes import RingNodes

# exact for the products of linear functions
POINTS, WEIGHTS = np.polynomial.legendre.leggauss(2)


@dataclass(frozen=True)
class WideFeet:
    """Feet that act over their width, in the order of their nodes.

    Parameters
    ----------
    place : array (spokes,)
        Row of each spoke in `nodes`; -1 for a foot that is one node.
    nodes : array (feet, nodes of a foot)
        In the order of θ.
    angle : array (nodes of a foot,)
        From the foot's middle, rad.
    mean, turn : arrays (nodes of a foot,)
        Weights of each node's displacement in u_r and u_θ, and in φ (1/mm).
    share : array (nodes of a foot, 3, 2)
        What the motion of the band's face at a node, outward and along in the node's own
        directions, contributes to (u_r, u_θ, φ) of the foot.
    """

    place: Index
    nodes: Index
    angle: Array
    mean: Array
    turn: Array
    share: Array


def wide_feet(nodes: RingNodes, radius_mm: float, width_mm: float) -> WideFeet:
    """Find the feet that are covered by elements of the smallest length.

    Parameters
    ----------
    nodes : RingNodes
    radius_mm : float
        Of the band's inner face.
    width_mm : float
        Of a foot along the circumference.

    Raises
    ------
    ValueError
        If the feet overlap.
    """
    pitch = 2.0 * np.pi / len(nodes.feet)
    half = 0.5 * width_mm / radius_mm
    if 2.0 * half >= pitch:
        raise ValueError(f"feet {width_mm:.2f} mm wide overlap on {len(nodes.feet)} spokes")
    count = len(nodes.theta)
    after = np.append(nodes.theta[1:], nodes.theta[0] + 2.0 * np.pi) - nodes.theta
    step = float(after.min())
    reach = int(np.ceil(half / step - 1e-9))
    offsets = np.arange(-reach, reach + 1)
    covered = nodes.feet[:, None] + offsets
    fine = np.abs(after[covered[:, :-1] % count] - step).max(axis=1) < 1e-9 * step
    # there are free nodes between two feet, and no foot extends beyond the first or the last node
    apart = pitch > (2 * reach + 1.5) * step
    own = np.flatnonzero(fine & apart & (covered[:, 0] >= 0) & (covered[:, -1] < count - 2))
    own = own[np.argsort(nodes.feet[own])]
    place = np.full(len(nodes.feet), -1, dtype=np.int64)
    place[own] = np.arange(len(own))
    angle: Array = step * offsets.astype(float)
    mean, turn = _weights(angle, half, radius_mm)
    return WideFeet(place, covered[own], angle, mean, turn, _share(angle, mean, turn))


def _weights(angle: Array, half: float, radius_mm: float) -> tuple[Array, Array]:
    """Weights of nodes at these angles in the mean over (-half, half), and in the rotation."""
    mean, turn = np.zeros_like(angle), np.zeros_like(angle)
    moment = 0.0
    for i in range(len(angle) - 1):
        low, high = np.clip(angle[i : i + 2], -half, half)
        at = 0.5 * (low + high) + 0.5 * (high - low) * POINTS
        weight = 0.5 * (high - low) * WEIGHTS
        arm = radius_mm * at
        part = (at - angle[i]) / (angle[i + 1] - angle[i])
        for node, shape in ((i, 1.0 - part), (i + 1, part)):
            mean[node] += float(weight @ shape)
            turn[node] += float(weight @ (arm * shape))
        moment += float(weight @ arm**2)
    return mean / (2.0 * half), turn / moment


def _share(angle: Array, mean: Array, turn: Array) -> Array:
    """Give `share` of `WideFeet`: the weights, with each node's directions turned to the foot's."""
    cos, sin = np.cos(angle), np.sin(angle)
    radial, along = np.stack([cos, -sin], axis=1), np.stack([sin, cos], axis=1)
    return np.stack([mean[:, None] * radial, mean[:, None] * along, turn[:, None] * radial], axis=1)
