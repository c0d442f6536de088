"""Nodes of the ring: each pitch in equal parts, with more of them near the contact.

They are numbered from opposite the contact, so that no foot near it reaches over the last node.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nptcs.arrays import Array, Index
from nptcs.config.solvers.ring import RingElements
from nptcs.ring.section import RingSection


@dataclass(frozen=True)
class RingNodes:
    """Nodes and elements; element i runs from node i to node i + 1, the last one to node 0.

    Parameters
    ----------
    theta : array (nodes,)
        Angle of each node before the load, rad, rising; 0 is down, positive anticlockwise.
    middle : array (nodes,)
        Angle of each element's middle, rad.
    length_mm : array (nodes,)
        Chord of each element.
    feet : array (spokes,)
        Node of each spoke's foot.
    """

    theta: Array
    middle: Array
    length_mm: Array
    feet: Index

    def positions(self, radius_mm: float) -> Array:
        """Positions (nodes, 2) before the load."""
        return radius_mm * np.stack([np.sin(self.theta), -np.cos(self.theta)], axis=1)


def ring_nodes(mesh: RingElements, section: RingSection, spoke_count: int) -> RingNodes:
    """Divide the ring: a node at each spoke's foot, equal elements between two of them.

    A pitch is finer if any part of it is within `refined_deg` of the contact's middle.
    """
    pitch = 2.0 * np.pi / spoke_count
    start = np.radians(mesh.first_spoke_deg)
    theta: list[Array] = []
    feet: list[int] = []
    # the spoke that is farthest behind θ = 0, and those after it
    first = int(np.ceil((-np.pi - start) / pitch - 1e-9))
    for spoke in range(first, first + spoke_count):
        low = start + spoke * pitch
        # the smallest |θ| in the pitch
        off = np.abs(np.angle(np.exp(1j * (low + 0.5 * pitch)))) - 0.5 * pitch
        near = off < np.radians(mesh.refined_deg) - 1e-9
        count = mesh.elements_per_pitch * (mesh.refinement if near else 1)
        feet.append(sum(map(len, theta)))
        theta.append(low + pitch * np.arange(count) / count)
    # what the first foot covers lies behind the first node
    behind = 2 * len(theta[-1]) // 5
    back = theta.pop()
    angle = np.concatenate(
        [back[len(back) - behind :] - 2.0 * np.pi, *theta, back[: len(back) - behind]]
    )
    step = np.diff(np.append(angle, angle[0] + 2.0 * np.pi))
    return RingNodes(
        theta=angle,
        middle=angle + 0.5 * step,
        length_mm=2.0 * section.radius_mm * np.sin(0.5 * step),
        feet=np.roll(np.array(feet, dtype=np.int64) + behind, first),
    )
