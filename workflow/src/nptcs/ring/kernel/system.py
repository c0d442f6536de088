"""The linear system of one iterate, block by block around the ring."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from nptcs.arrays import Array, Index
from nptcs.ring.feet import WideFeet
from nptcs.ring.kernel.elementwise.places import UNKNOWNS
from nptcs.ring.kernel.spokes import SpokePolynomial


@dataclass(frozen=True)
class FootTangent:
    """Tangent of the wide feet, lever^T hold lever over the nodes of each.

    Parameters
    ----------
    nodes : array (feet, nodes of a foot)
    lever : array (feet, nodes of a foot, 3, 5)
        Derivatives of (u_r, u_θ, φ) with respect to the nodes' unknowns.
    hold : array (feet, 3, 3)
        Stiffness of each spoke under the squeeze of the band; symmetric.
    """

    nodes: Index
    lever: Array
    hold: Array


NO_FEET = FootTangent(
    np.zeros((0, 1), dtype=np.int64), np.zeros((0, 1, 3, UNKNOWNS)), np.zeros((0, 3, 3))
)


@dataclass(frozen=True)
class Faces:
    """Nodes under which a foot presses on the band's inner face.

    Parameters
    ----------
    single : array (spokes with a foot of one node,)
    wide : array (spokes with a wide foot,)
        In the order of `WideFeet.nodes`.
    nodes : array (nodes,)
        Those of `single`, then those of the wide feet.
    angle : array (nodes,)
    """

    single: Index
    wide: Index
    nodes: Index
    angle: Array

    @classmethod
    def of(cls, theta: Array, feet: Index, wide: WideFeet) -> Faces:
        """Sort the spokes."""
        single, own = np.flatnonzero(wide.place < 0), np.flatnonzero(wide.place >= 0)
        own = own[np.argsort(wide.place[own])]
        nodes = np.concatenate([feet[single], wide.nodes.ravel()])
        return cls(single, own, nodes, theta[nodes])


@dataclass(frozen=True)
class Ring:
    """Everything about a ring that the kernels read.

    Parameters
    ----------
    stiffness : array (7, 7)
        C of the section.
    hardening : array (4, 4, 4)
        D of the section.
    core : array (6,)
        Pull of the wires on the core by (e, κs, κf), the core's compliance a, the wires'
        stiffness k and the curvature 1/R (see `elementwise.band.core_give`).
    dimensions : array (13,)
        Constants of the section and the ground, places as in `elementwise.places`.
    theta, middle, length_mm : arrays (nodes,)
    feet : array (spokes,)
        Node of each spoke.
    wide : WideFeet
        Feet that act over their width.
    squeeze : array (2,)
        Compliance of the band under a wide foot: u_r per force (mm/N), φ per moment (1/(N mm)).
    height_mm, straight_mm, narrowing : float
        Of the spokes' table.
    low, high : arrays (3,)
    coefficients : array (degrees, side terms)
    sides : array (side terms, 2)
    """

    stiffness: Array
    hardening: Array
    core: Array
    dimensions: Array
    theta: Array
    middle: Array
    length_mm: Array
    feet: Index
    wide: WideFeet
    squeeze: Array
    height_mm: float
    straight_mm: float
    narrowing: float
    low: Array
    high: Array
    coefficients: Array
    sides: Index

    @cached_property
    def faces(self) -> Faces:
        """Where the spokes press on the band."""
        return Faces.of(self.theta, self.feet, self.wide)

    @cached_property
    def polynomial(self) -> SpokePolynomial:
        """The spokes' energy."""
        return SpokePolynomial(
            height_mm=self.height_mm,
            straight_mm=self.straight_mm,
            low=self.low,
            high=self.high,
            narrowing=self.narrowing,
            coefficients=self.coefficients,
            sides=self.sides,
        )


@dataclass
class System:
    """Residual and tangent of an iterate of n nodes.

    Parameters
    ----------
    diagonal, upper, lower : arrays (n, 5, 5)
        Blocks of node i with itself, with node i + 1, and of node i + 1 with node i; cyclic.
    force : array (n, 5)
        Residual, internal minus external.
    slope : array (n, 5)
        Its derivative with respect to the ground's rise.
    row : array (n, 5)
        Derivative of the reaction with respect to the unknowns.
    reaction_n, reaction_slope : float
        Vertical force on the ground and its derivative with respect to the rise.
    coordinates : array (spokes, 3)
        (s, β, φ) of the spokes.
    feet : FootTangent
        Of the wide feet, which the blocks do not hold.
    squeezed : array (feet, 3)
        How far (u_r, u_θ, φ) the band gives way under each wide foot.
    """

    diagonal: Array
    upper: Array
    lower: Array
    force: Array
    slope: Array
    row: Array
    reaction_n: float
    reaction_slope: float
    coordinates: Array
    feet: FootTangent
    squeezed: Array

    def transposed(self) -> tuple[Array, Array, Array]:
        """Blocks of the transposed matrix: diagonal, upper, lower."""
        diagonal, upper, lower = (
            np.ascontiguousarray(block.swapaxes(1, 2))
            for block in (self.diagonal, self.lower, self.upper)
        )
        return diagonal, upper, lower


def empty_system(ring: Ring) -> System:
    """Return a system of zeros."""
    nodes, wide = len(ring.theta), ring.wide.nodes
    diagonal, upper, lower = (np.zeros((nodes, UNKNOWNS, UNKNOWNS)) for _ in range(3))
    force, slope, row = (np.zeros((nodes, UNKNOWNS)) for _ in range(3))
    coordinates = np.zeros((len(ring.feet), 3))
    feet = FootTangent(wide, np.zeros((*wide.shape, 3, UNKNOWNS)), np.zeros((len(wide), 3, 3)))
    squeezed = np.zeros((len(wide), 3))
    return System(diagonal, upper, lower, force, slope, row, 0.0, 0.0, coordinates, feet, squeezed)
