"""The tyre with every spoke meshed: the direct model that the reduced tyre is checked against.

The same ring, contact and load control as `TyreModel`; in place of the energy table each spoke is
its own finite element mesh. Each Newton iteration linearises ring and spokes together. The inner
displacements of each spoke are condensed onto its foot before the ring is solved, and recovered
before the next linearisation; this elimination changes no step of Newton's method for the whole
system.
"""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from nptcs.arrays import Array
from nptcs.config.solvers.fe import FeModel
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.fe.elements.groups import ElementResponse, RubberGroup
from nptcs.fe.elements.lagrange import line_shape
from nptcs.fe.matrices.block_tridiagonal import BlockCholesky, solve_indefinite
from nptcs.fe.spoke.energy_table import SpokeEnergyTable
from nptcs.fe.spoke.equilibrium import SpokeModel
from nptcs.fe.spoke.period import SpokeDesign
from nptcs.fe.tyre.equilibrium import MAX_ITERATIONS, LoadPath, TyreModel, TyreState
from nptcs.fe.tyre.feet import foot_operators
from nptcs.fe.tyre.mesh import RingMesh
from nptcs.fe.tyre.path import LoadPoint


class Foot(Protocol):
    """How a spoke's top nodes follow its coordinates q.

    Attributes
    ----------
    operators : array (spokes, coordinates, unknowns of a foot on the ring)
        q = operators · displacements of the ring's nodes under the foot.
    """

    operators: Array

    def move(self, q: Array) -> tuple[Array, Array]:
        """Displacements (top nodes, 3) and their derivatives (top dofs, coordinates)."""

    def bend(self, q: Array, reaction: Array) -> Array:
        """Σ reaction · ∂²u/∂q∂q, array (coordinates, coordinates)."""


class ConformingFoot:
    """The top nodes move as the ring's edge does at their place; q are its nodes' u_θ, u_r."""

    def __init__(self, model: SpokeModel, ring: RingMesh) -> None:
        count = ring.feet.shape[1]
        turned = np.zeros((len(ring.feet), count, 2, count, 2))
        for i in range(count):
            turned[:, i, 0, i] = np.stack([np.cos(ring.spoke_angle), np.sin(ring.spoke_angle)], 1)
            turned[:, i, 1, i] = np.stack([np.sin(ring.spoke_angle), -np.cos(ring.spoke_angle)], 1)
        self.operators = turned.reshape(len(ring.feet), 2 * count, 2 * count)
        x, y = ring.positions[ring.feet[0]].T
        along = float(ring.radii[0]) * (np.unwrap(np.arctan2(x, -y)) - ring.spoke_angle[0])
        shape = edge_shape(along, model.mesh.positions[model.mesh.top, 0])
        slope = np.zeros((len(shape), 3, count, 2))
        slope[:, 0, :, 0] = shape
        slope[:, 2, :, 1] = shape
        self._slope = slope.reshape(3 * len(shape), 2 * count)

    def move(self, q: Array) -> tuple[Array, Array]:
        """Displacements and derivatives of the top nodes."""
        return (self._slope @ q).reshape(-1, 3), self._slope

    def bend(self, q: Array, reaction: Array) -> Array:
        """No second derivatives."""
        return np.zeros((len(q), len(q)))


class RigidFoot:
    """The top nodes move as a rigid body, as for the energy table; q is (u_r, u_θ, φ)."""

    def __init__(self, model: SpokeModel, ring: RingMesh) -> None:
        self.operators = foot_operators(ring)
        self._model = model

    def move(self, q: Array) -> tuple[Array, Array]:
        """Displacements and derivatives of the top nodes."""
        return self._model.band_motion(q), self._model.band_motion_slope(float(q[2]))[0]

    def bend(self, q: Array, reaction: Array) -> Array:
        """Only the rotation has a second derivative."""
        curvature = np.zeros((3, 3))
        curvature[2, 2] = reaction @ self._model.band_motion_slope(float(q[2]))[1]
        return curvature


def edge_shape(nodes: Array, places: Array) -> Array:
    """Quadratic shape functions (places, nodes) of a row of edges at places along it.

    Raises
    ------
    ValueError
        If a place lies beyond the row's ends.
    """
    slack = 1e-6 * float(np.ptp(nodes))
    if places.min() < nodes[0] - slack or places.max() > nodes[-1] + slack:
        raise ValueError("the spoke's foot is wider than the ring's")
    corners = nodes[::2]
    edge = np.clip(np.searchsorted(corners, places) - 1, 0, len(corners) - 2)
    value, _ = line_shape(
        2, 2.0 * (places - corners[edge]) / (corners[edge + 1] - corners[edge]) - 1.0
    )
    shape = np.zeros((len(places), len(nodes)))
    np.put_along_axis(shape, 2 * edge[:, None] + np.arange(3), value, axis=1)
    return shape


@dataclass(frozen=True)
class Linearised:
    """A spoke at one iterate, condensed onto its foot's coordinates; energies of the whole spoke.

    Parameters
    ----------
    q : array (coordinates,)
    displacement : array (nodes, 3)
    rubbers : list of RubberGroup
        With this iterate's pressures and linearisation.
    energy, force, tangent : float, array (coordinates,), array (coordinates, coordinates)
    step : array (free unknowns,)
        Newton step of the inner displacements at fixed q.
    sensitivity : array (free unknowns, coordinates)
    stable : bool
        Whether the matrix at fixed q is positive definite.
    """

    q: Array
    displacement: Array
    rubbers: list[RubberGroup]
    energy: float
    force: Array
    tangent: Array
    step: Array
    sensitivity: Array
    stable: bool


class MeshedSpoke(SpokeModel):
    """A spoke that is linearised about any iterate, in equilibrium or not."""

    @property
    def unknowns(self) -> int:
        """Inner displacements."""
        return self._pattern.size

    def at_rest(self, foot: Foot) -> Linearised:
        """Return the unloaded spoke on a foot."""
        q = np.zeros(foot.operators.shape[1])
        rubbers = [copy(group) for group in self.rubbers]
        for group in rubbers:
            group.pressure = np.zeros_like(group.pressure)
        return self._linearise(q, np.zeros_like(self.mesh.positions), rubbers, foot)

    def follow_foot(self, last: Linearised, q: Array, foot: Foot) -> Linearised:
        """Take the Newton step of the inner displacements that goes with a step of the foot.

        Raises
        ------
        FloatingPointError
            If an element turns inside out.
        """
        displacement = last.displacement.copy()
        displacement[self.mesh.top] = foot.move(q)[0]
        displacement.reshape(-1)[self._free] += last.step + last.sensitivity @ (q - last.q)
        rubbers = [copy(group) for group in last.rubbers]
        for group in rubbers:
            group.follow(displacement - last.displacement)
        return self._linearise(q, displacement, rubbers, foot)

    def _linearise(
        self, q: Array, displacement: Array, rubbers: list[RubberGroup], foot: Foot
    ) -> Linearised:
        self.rubbers = rubbers
        responses, force = self._respond(displacement)
        _, slope = foot.move(q)
        product = self._top_product(responses, slope)
        rhs = -np.column_stack([force[self._free], product[self._free]])
        tangents = [r.tangent for r in responses]
        stable = True
        try:
            solved = BlockCholesky(self._pattern.assemble(tangents)).solve(rhs)
        except np.linalg.LinAlgError:
            stable = False
            solved = solve_indefinite(self._pattern.assemble(tangents), rhs)
        step, sensitivity = solved[:, 0], solved[:, 1:]
        reaction = force[self._top_dofs]
        inner = product[self._free]
        condensed = slope.T @ reaction + inner.T @ step
        tangent = slope.T @ product[self._top_dofs] + inner.T @ sensitivity
        tangent += foot.bend(q, reaction)
        return Linearised(
            q=q,
            displacement=displacement,
            rubbers=rubbers,
            energy=self.scale * sum(r.energy for r in responses),
            force=self.scale * condensed,
            tangent=self.scale * 0.5 * (tangent + tangent.T),
            step=step,
            sensitivity=sensitivity,
            stable=stable,
        )


class DirectTyre(TyreModel):
    """A tyre of meshed spokes.

    Parameters
    ----------
    model : FeModel
    tyre : TyreGeometry
    design : SpokeDesign
    table : SpokeEnergyTable
        Not used in the solution; the base class needs it.
    band_c10_mpa : float
    rigid_foot : bool
        Spokes' feet as rigid bodies, as for the energy table, instead of conforming to the band.
    """

    def __init__(
        self,
        model: FeModel,
        tyre: TyreGeometry,
        design: SpokeDesign,
        table: SpokeEnergyTable,
        band_c10_mpa: float,
        rigid_foot: bool = False,
    ) -> None:
        super().__init__(
            tyre,
            table,
            model.geometry.foot_width_mm(),
            band_c10_mpa,
            model.band_bulk_to_shear(),
            model.tyre_mesh,
            model.contact,
        )
        self.spoke = MeshedSpoke(design)
        kind = RigidFoot if rigid_foot else ConformingFoot
        self.foot: Foot = kind(self.spoke, self.mesh)
        self.spokes: list[Linearised] = []

    @property
    def unknowns(self) -> int:
        """Displacements of ring and spokes."""
        return self._count + len(self.mesh.feet) * self.spoke.unknowns

    def spoke_response(self, displacement: Array) -> ElementResponse:
        """Linearise all spokes at the ring's displacement, condensed onto their feet."""
        local = displacement[self.mesh.feet].reshape(len(self.mesh.feet), -1)
        coordinates = np.einsum("skn,sn->sk", self.foot.operators, local)
        self.spokes = [
            self.spoke.follow_foot(last, q, self.foot)
            for last, q in zip(self.spokes, coordinates, strict=True)
        ]
        lift = self.foot.operators.transpose(0, 2, 1)
        push = np.stack([spoke.force for spoke in self.spokes])
        stiff = np.stack([spoke.tangent for spoke in self.spokes])
        return ElementResponse(
            sum(spoke.energy for spoke in self.spokes),
            np.matmul(lift, push[..., None])[..., 0],
            np.matmul(lift, np.matmul(stiff, self.foot.operators)),
        )

    def load(self, loads_n: Sequence[float]) -> TyreState:
        """Press the unloaded tyre on the ground through a rising sequence of loads."""
        self.spokes = [self.spoke.at_rest(self.foot)] * len(self.mesh.feet)
        return super().load(loads_n)

    def _newton(
        self, start: LoadPoint, load: float | None, path: LoadPath, most: int = MAX_ITERATIONS
    ) -> tuple[Array, float]:
        """Solve as the reduced tyre does; where it fails, spokes return to where they were."""
        before = self.spokes
        try:
            return super()._newton(start, load, path, most)
        except (FloatingPointError, np.linalg.LinAlgError) as error:
            self.spokes = before
            raise FloatingPointError(str(error)) from error
