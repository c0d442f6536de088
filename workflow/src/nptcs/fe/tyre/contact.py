"""Contact of the tread with a rigid plane that rises by δ: smoothed penalty, Coulomb friction."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nptcs.arrays import Array, Index
from nptcs.config.solvers.fe import GroundContact
from nptcs.fe.elements.lagrange import line_shape

# MPa/mm and mm of the soft ground: it gives way by a few hundredths of a millimetre
SOFT = 50.0, 0.1
# tanh is 1 to rounding beyond this
RATIO_CAP = 20.0
LEAST_SHEAR_MPA = 1e-9


@dataclass
class ContactResponse:
    """Forces and tangents of the tread's edges, and the ground's reaction.

    Parameters
    ----------
    force : array (edges, unknowns of an edge)
        Residual (internal minus external) at the edge's nodes, N.
    tangent : array (edges, unknowns of an edge, unknowns of an edge)
    force_slope : array (edges, unknowns of an edge)
        Derivative of `force` with respect to the ground's rise, N/mm.
    reaction_n : float
        Vertical force on the ground.
    reaction_slope : float
        Its derivative with respect to the ground's rise, N/mm.
    """

    force: Array
    tangent: Array
    force_slope: Array
    reaction_n: float
    reaction_slope: float


@dataclass(frozen=True)
class ContactCells:
    """Parts of the tread, each with the pressure of its contact point.

    Parameters
    ----------
    low_mm, high_mm : arrays (cells,)
        Where each part begins and ends along the ground.
    pressure_mpa : array (cells,)
    length_mm : array (cells,)
        Unloaded length, on which the pressure acts.
    """

    low_mm: Array
    high_mm: Array
    pressure_mpa: Array
    length_mm: Array


class Ground:
    """The rigid plane y = -R + δ under the tread's outer edges.

    The normal pressure is p(g) = ε g²/2d up to a penetration d, ε (g - d/2) beyond: its slope does
    not jump, so Newton's method does not chatter. The shear traction is µ p tanh(ε_t s / µ p)
    with the slip s from an anchor, which each converged step moves.

    Parameters
    ----------
    positions : array (nodes, 2)
    edges : array (edges, nodes of an edge)
    rule : pair of arrays (points,)
        Contact points on an edge, from -1 to 1, and their weights.
    width_mm : float
        Axial width of the tread.
    options : GroundContact
    """

    def __init__(
        self,
        positions: Array,
        edges: Index,
        rule: tuple[Array, Array],
        width_mm: float,
        options: GroundContact,
    ) -> None:
        points, weights = rule
        self._shape, slope = line_shape(edges.shape[1] - 1, points)
        tangent = np.einsum("gn,eni->egi", slope, positions[edges])
        length = np.linalg.norm(tangent, axis=2) * weights
        self._length = length
        # where the parts of an edge that its points represent begin and end
        ends = np.clip(np.cumsum([-1.0, *weights]), -1.0, 1.0)
        self._end_shape, _ = line_shape(edges.shape[1] - 1, ends)
        self._at_nodes = np.array_equal(points, [-1.0, 1.0])
        self._positions = positions
        self._area = length * width_mm
        self._edges = edges
        self._options = options
        self._place = np.einsum("gn,eni->egi", self._shape, positions[edges])
        self._radius = float(np.linalg.norm(positions[edges], axis=2).max())
        self.release()
        self._law = options.penalty_mpa_per_mm, options.smoothing_mm

    @property
    def soft(self) -> bool:
        """Whether the ground is softer than its options say."""
        return self._law[1] > self._options.smoothing_mm

    def soften(self) -> None:
        """Use the pressure of a soft ground, on which Newton's method finds the contact."""
        stiff, smooth = self._options.penalty_mpa_per_mm, self._options.smoothing_mm
        self._law = min(stiff, SOFT[0]), max(smooth, SOFT[1])

    def harden(self) -> None:
        """Return to the pressure of the options."""
        self._law = self._options.penalty_mpa_per_mm, self._options.smoothing_mm

    def _pressure(self, depth: Array) -> tuple[Array, Array]:
        stiff, smooth = self._law
        inside = np.clip(depth, 0.0, None)
        pressure = np.where(
            inside < smooth, stiff * inside**2 / (2.0 * smooth), stiff * (inside - smooth / 2.0)
        )
        return pressure, stiff * np.clip(inside / smooth, 0.0, 1.0)

    def _state(self, displacement: Array, rise_mm: float) -> tuple[Array, ...]:
        moved = np.einsum("gn,eni->egi", self._shape, displacement[self._edges])
        depth = rise_mm - self._radius - (self._place[..., 1] + moved[..., 1])
        pressure, slope = self._pressure(depth)
        stiff, friction = self._options.tangential_mpa_per_mm, self._options.friction
        limit = np.maximum(friction * pressure, LEAST_SHEAR_MPA)
        ratio = np.clip(stiff * (moved[..., 0] - self._anchor) / limit, -RATIO_CAP, RATIO_CAP)
        level = np.tanh(ratio)
        shear = limit * level
        shear_slope = stiff * (1.0 - level**2)
        # at a fixed slip, a higher pressure carries more shear
        cross = friction * slope * (level - ratio * (1.0 - level**2))
        return moved[..., 0], pressure, slope, shear, shear_slope, cross

    def respond(self, displacement: Array, rise_mm: float) -> ContactResponse:
        """Compute forces and tangents for nodal displacements and the ground's rise δ."""
        _, pressure, slope, shear, shear_slope, cross = self._state(displacement, rise_mm)
        shape, area = self._shape, self._area
        count, nodes = self._edges.shape
        force = np.zeros((count, nodes, 2))
        force[..., 1] = -np.einsum("gn,eg->en", shape, area * pressure)
        force[..., 0] = np.einsum("gn,eg->en", shape, area * shear)
        tangent = np.zeros((count, nodes, 2, nodes, 2))
        tangent[:, :, 1, :, 1] = np.einsum("gn,gm,eg->enm", shape, shape, area * slope)
        tangent[:, :, 0, :, 0] = np.einsum("gn,gm,eg->enm", shape, shape, area * shear_slope)
        # depth falls with u_y: sliding friction couples the shear to the pressure
        tangent[:, :, 0, :, 1] = -np.einsum("gn,gm,eg->enm", shape, shape, area * cross)
        force_slope = np.zeros((count, nodes, 2))
        force_slope[..., 1] = -np.einsum("gn,eg->en", shape, area * slope)
        force_slope[..., 0] = np.einsum("gn,eg->en", shape, area * cross)
        return ContactResponse(
            force.reshape(count, -1),
            tangent.reshape(count, 2 * nodes, 2 * nodes),
            force_slope.reshape(count, -1),
            float(np.sum(area * pressure)),
            float(np.sum(area * slope)),
        )

    def release(self) -> None:
        """Forget all slip: the tyre is off the ground again."""
        self._anchor = np.zeros(self._area.shape)

    def advance(self, displacement: Array, rise_mm: float) -> None:
        """Store the slip of a converged step; points off the ground lose theirs."""
        along, pressure, _, shear, _, _ = self._state(displacement, rise_mm)
        self._anchor = along - np.where(
            pressure > 0.0, shear / self._options.tangential_mpa_per_mm, 0.0
        )

    def pressure_profile(self, displacement: Array, rise_mm: float) -> tuple[Array, Array]:
        """Place x (mm) and pressure (MPa) of all contact points, in the order of θ."""
        along, pressure, *_ = self._state(displacement, rise_mm)
        return (self._place[..., 0] + along).ravel(), pressure.ravel()

    def cells(self, displacement: Array, rise_mm: float) -> ContactCells:
        """Parts of the tread that the contact points represent, in the order of θ."""
        x = (self._positions + displacement)[self._edges][..., 0]
        ends = np.einsum("gn,en->eg", self._end_shape, x)
        _, pressure, *_ = self._state(displacement, rise_mm)
        if self._at_nodes:
            # a node represents half of the edge on either side of it
            half, length = ends[:, 1], self._length
            return ContactCells(
                half, np.roll(half, -1), pressure[:, 1], length[:, 1] + np.roll(length[:, 0], -1)
            )
        return ContactCells(
            ends[:, :-1].ravel(), ends[:, 1:].ravel(), pressure.ravel(), self._length.ravel()
        )

    def energy(self, displacement: Array, rise_mm: float) -> float:
        """Energy stored in the normal penalty, N mm."""
        moved = np.einsum("gn,eni->egi", self._shape, displacement[self._edges])
        depth = rise_mm - self._radius - (self._place[..., 1] + moved[..., 1])
        stiff, smooth = self._law
        inside = np.clip(depth, 0.0, None)
        low = stiff * inside**3 / (6.0 * smooth)
        high = stiff * (0.5 * inside**2 - 0.5 * smooth * inside + smooth**2 / 6.0)
        return float(np.sum(self._area * np.where(inside < smooth, low, high)))
