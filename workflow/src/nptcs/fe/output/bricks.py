"""Finite element states as 27-node bricks with fields, whatever elements they came from."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nptcs.arrays import Array, Index
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.fe.elements.groups import RubberGroup
from nptcs.fe.elements.lagrange import tensor_shape
from nptcs.fe.output.fields import (
    at_points,
    extreme,
    fibre_stress,
    lattice,
    linear_energy,
    rubber_at,
    rubber_energy,
)
from nptcs.fe.spoke.equilibrium import SpokeModel, SpokeState
from nptcs.fe.spoke.mesh import LAYER_ORDERS, RUBBER_ORDERS
from nptcs.fe.tyre.equilibrium import TyreModel, TyreState
from nptcs.fe.tyre.mesh import band_radii

MATERIALS = {"spoke rubber": 1, "plate": 2, "band rubber": 3, "tread rubber": 4}
BRICK_NODES = 27
# orders of the ring's elements, by their number of nodes
RING_ORDERS = {9: (2, 2), 6: (1, 2), 4: (1, 1)}


@dataclass(frozen=True)
class Bricks:
    """Bricks of 3 × 3 × 3 nodes, the last local direction fastest.

    Parameters
    ----------
    position : array (bricks, 27, 3)
        Reference positions, mm.
    displacement : array (bricks, 27, 3)
        mm.
    cell : mapping of arrays (bricks,)
        One value per brick.
    point : mapping of arrays (bricks, 27)
        Values at the nodes, NaN where a field has no meaning.
    """

    position: Array
    displacement: Array
    cell: dict[str, Array]
    point: dict[str, Array]

    def moved(self, axes: Array, origin: Array) -> Bricks:
        """Put local positions and displacements on global axes (3, 3), given as columns."""
        return Bricks(
            self.position @ axes.T + origin, self.displacement @ axes.T, self.cell, self.point
        )


def join_bricks(parts: list[Bricks]) -> Bricks:
    """Join several sets of bricks with the same fields."""
    return Bricks(
        np.concatenate([part.position for part in parts]),
        np.concatenate([part.displacement for part in parts]),
        {name: np.concatenate([part.cell[name] for part in parts]) for name in parts[0].cell},
        {name: np.concatenate([part.point[name] for part in parts]) for name in parts[0].point},
    )


def spoke_bricks(model: SpokeModel, state: SpokeState, spoke: int = 0) -> Bricks:
    """One period of a spoke: its rubber, and the plates as the layer that carries them.

    Parameters
    ----------
    model : SpokeModel
        Its groups are given the pressures of the state.
    state : SpokeState
    spoke : int
        Number of the spoke, a field of the bricks.
    """
    for group, pressure in zip(model.rubbers, state.pressures, strict=True):
        group.pressure = pressure
    mesh, parts = model.mesh, []
    points = lattice(3, 3)
    for group, elements, orders in zip(
        model.rubbers, (mesh.rubber, mesh.layer), (RUBBER_ORDERS, LAYER_ORDERS), strict=True
    ):
        volume = group.weight.sum(axis=1)
        position, moved = at_points(elements, orders, state.displacement, points)
        fields = rubber_at(group, orders, elements.corners, state.displacement, points)
        nothing = np.full(len(volume), np.nan)
        density = rubber_energy(group, state.displacement) / volume
        parts.append(
            Bricks(
                position,
                moved,
                _cells("spoke rubber", elements.leg, spoke, volume, density, nothing, nothing),
                {"mises_mpa": fields.mises, "pressure_mpa": fields.pressure},
            )
        )
    parts.append(_plate_bricks(model, state, spoke))
    return join_bricks(parts)


def _plate_bricks(model: SpokeModel, state: SpokeState, spoke: int) -> Bricks:
    elements = model.mesh.plate
    position, moved = at_points(elements, LAYER_ORDERS, state.displacement, lattice(3, 3))
    # the stretch group has the volume of the plies; the bricks show the layer that carries them
    ratio = model.design.thickness_mm / model.design.geometry.plate_layer_mm
    volume = model.plates[1].weight.sum(axis=1) / ratio
    energy = np.sum([linear_energy(group, state.displacement) for group in model.plates], axis=0)
    columns = model.design.mesh.plate_columns
    for group in model.embedding:
        energy += np.repeat(group.energies(state.displacement) / columns, columns)
    fibres = fibre_stress(model.plates[0], state.displacement, model.design.angle_deg)
    plies = [extreme(ply) for ply in np.split(fibres, 2, axis=1)]
    nothing = np.full(position.shape[:2], np.nan)
    return Bricks(
        position,
        moved,
        _cells("plate", elements.leg, spoke, volume, energy / volume, *plies),
        {"mises_mpa": nothing, "pressure_mpa": nothing},
    )


def _cells(
    material: str | Array,
    leg: Index,
    spoke: int,
    volume: Array,
    density: Array,
    plus: Array,
    minus: Array,
) -> dict[str, Array]:
    if isinstance(material, str):
        material = np.full(len(volume), MATERIALS[material])
    return {
        "material": material.astype(np.int32),
        "leg": leg.astype(np.int32),
        "spoke": np.full(len(volume), spoke, np.int32),
        "reference_volume_mm3": volume,
        "strain_energy_density_mpa": density,
        "fibre_stress_plus_mpa": plus,
        "fibre_stress_minus_mpa": minus,
    }


def ring_bricks(
    tyre: TyreModel, dimensions: TyreGeometry, state: TyreState, low_mm: float, high_mm: float
) -> Bricks:
    """Band and tread, drawn between two axial positions; the energy includes the wires'."""
    energies: dict[tuple[int, ...], float] = {}
    for wire in tyre.wires:
        for nodes, energy in zip(
            wire.nodes.tolist(), linear_energy(wire, state.displacement), strict=True
        ):
            energies[tuple(nodes)] = energies.get(tuple(nodes), 0.0) + float(energy)
    axial, parts = np.linspace(low_mm, high_mm, 3), []
    for group in tyre.rubbers:
        own = np.array([energies.get(tuple(nodes), 0.0) for nodes in group.nodes.tolist()])
        energy = rubber_energy(group, state.displacement) + own
        corners = tyre.mesh.positions[group.nodes]
        inside = np.linalg.norm(corners.mean(axis=1), axis=1) < band_radii(dimensions)[1]
        whole = group.weight.sum(axis=1)
        nothing, outside = np.full(len(whole), np.nan), np.full(len(whole), -1)
        cells = _cells(
            np.where(inside, MATERIALS["band rubber"], MATERIALS["tread rubber"]),
            outside,
            -1,
            whole * (high_mm - low_mm) / dimensions.tread_width_mm,
            energy / whole,
            nothing,
            nothing,
        )
        parts.append(_extruded(group, corners, state.displacement, axial, cells))
    return join_bricks(parts)


def _extruded(
    group: RubberGroup, corners: Array, displacement: Array, axial: Array, cells: dict[str, Array]
) -> Bricks:
    """Plane elements as bricks with their three nodes across at the axial places."""
    orders, points = RING_ORDERS[group.nodes.shape[1]], lattice(3, 2)
    shape, _ = tensor_shape(orders, points)
    fields = rubber_at(group, orders, corners, displacement, points)
    position, moved = np.zeros((2, len(corners), 9, 3, 3))
    position[..., :2] = np.einsum("gn,eni->egi", shape, corners)[:, :, None]
    position[..., 2] = axial
    moved[..., :2] = np.einsum("gn,eni->egi", shape, displacement[group.nodes])[:, :, None]
    return Bricks(
        position.reshape(-1, BRICK_NODES, 3),
        moved.reshape(-1, BRICK_NODES, 3),
        cells,
        {
            "mises_mpa": np.repeat(fields.mises, 3, axis=1),
            "pressure_mpa": np.repeat(fields.pressure, 3, axis=1),
        },
    )


def tyre_bricks(
    tyre: TyreModel, dimensions: TyreGeometry, state: TyreState, spoke: SpokeModel
) -> Bricks:
    """One axial period of the tyre, every spoke solved again at its own motion.

    Axes: x and y as in `tyre_mesh`, z along the tyre's axis.

    Raises
    ------
    SpokeError
        If a spoke has no equilibrium there.
    """
    first = -spoke.design.plate_width_mm / 2.0
    parts = [ring_bricks(tyre, dimensions, state, first, first + spoke.design.pitch_mm)]
    rim = float(tyre.mesh.radii[0]) - spoke.design.geometry.height_mm
    last = spoke.rest()
    for number, (angle, motion) in enumerate(zip(tyre.mesh.spoke_angle, state.motion, strict=True)):
        last = spoke.move(last, motion)
        out = np.array([np.sin(angle), -np.cos(angle), 0.0])
        along = np.array([np.cos(angle), np.sin(angle), 0.0])
        axes = np.stack([along, [0.0, 0.0, 1.0], out], axis=1)
        parts.append(spoke_bricks(spoke, last, number).moved(axes, rim * out))
    return join_bricks(parts)
