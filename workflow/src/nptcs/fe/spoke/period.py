"""Finite elements of one axial period of a spoke: what it is made of, and its forces."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import assert_never

import numpy as np

from nptcs.arrays import Array
from nptcs.config.solvers.fe import PlateCoupling, SpokeGeometry, SpokeMesh
from nptcs.fe.elements.groups import (
    ElementGroup,
    ElementResponse,
    MixedGroup,
    element_dofs,
    empty_tangents,
)
from nptcs.fe.matrices.block_tridiagonal import BlockCholesky, BlockPattern
from nptcs.fe.spoke.element_groups import plate_groups, rubber_group
from nptcs.fe.spoke.embedded_plates import straight_group
from nptcs.fe.spoke.mesh import LAYER_ORDERS, RUBBER_ORDERS, build_period


@dataclass(frozen=True)
class SpokeDesign:
    """What makes one spoke differ from another; two equal designs share their results.

    The width is shared out evenly: `plates` periods of `pitch_mm`, with a plate in each.
    """

    geometry: SpokeGeometry
    mesh: SpokeMesh
    pitch_mm: float
    plate_width_mm: float
    thickness_mm: float
    angle_deg: float
    c10_mpa: float
    ply: Mapping[str, float]
    plates: int
    plate_coupling: PlateCoupling


class SpokePeriod:
    """Element groups of one period, with the rim's nodes clamped and the band's moved as one."""

    def __init__(self, design: SpokeDesign) -> None:
        self.design = design
        self.mesh = build_period(
            design.geometry, design.mesh, design.pitch_mm, design.plate_width_mm
        )
        bulk = design.mesh.bulk_to_shear_ratio * 2.0 * design.c10_mpa
        self.rubbers = [
            rubber_group(self.mesh.rubber, RUBBER_ORDERS, design.c10_mpa, bulk),
            rubber_group(self.mesh.layer, LAYER_ORDERS, design.c10_mpa, bulk),
        ]
        self.plates = plate_groups(
            self.mesh.plate,
            self.mesh.plate_axes,
            design.geometry.plate_layer_mm,
            design.ply,
            design.angle_deg,
            design.thickness_mm,
        )
        match design.plate_coupling:
            case "embedded":
                columns, e2_mpa = design.mesh.plate_columns, design.ply["e2_mpa"]
                self.embedding = [straight_group(self.mesh.plate, columns, e2_mpa)]
            case "conforming":
                self.embedding = []
            case _:
                assert_never(design.plate_coupling)
        self._dofs = [element_dofs(group.nodes, 3) for group in self.groups]
        row = 3 * self.mesh.nodes_per_row
        self._count = 3 * len(self.mesh.positions)
        self._free = slice(row, self._count - row)
        numbers = np.arange(self._count) - row
        numbers[:row] = -1
        numbers[self._count - row :] = -1
        self._pattern = BlockPattern([numbers[d] for d in self._dofs], row, self._count - 2 * row)
        self._top_dofs = np.arange(self._count - row, self._count)
        self._arm = self.mesh.positions[self.mesh.top, 0]
        self._edge = [np.flatnonzero((d >= self._count - row).any(axis=1)) for d in self._dofs]
        self.scale = float(design.plates)
        # allocated once: new arrays of megabytes cost fresh pages of memory each time
        self._tangents = [empty_tangents(g.nodes, self.mesh.positions) for g in self.mixed]
        self._entries = self._pattern.empty_entries()

    @property
    def mixed(self) -> list[MixedGroup]:
        """Element groups whose stresses are unknowns."""
        return [*self.rubbers, *self.plates]

    @property
    def groups(self) -> list[ElementGroup]:
        """All element groups, including the springs that hold the plates straight."""
        return [*self.rubbers, *self.plates, *self.embedding]

    def band_motion(self, motion: Array) -> Array:
        """Displacements (top nodes, 3) of the rigid foot, mm."""
        u_r, u_theta, phi = motion
        moved = np.zeros((len(self._arm), 3))
        moved[:, 0] = u_theta + self._arm * (np.cos(phi) - 1.0)
        moved[:, 2] = u_r + self._arm * np.sin(phi)
        return moved

    def band_motion_slope(self, phi: float) -> tuple[Array, Array]:
        """∂u/∂(u_r, u_θ, φ) (top dofs, 3) and ∂²u/∂φ² (top dofs,)."""
        slope = np.zeros((len(self._arm), 3, 3))
        slope[:, 2, 0] = 1.0
        slope[:, 0, 1] = 1.0
        slope[:, 0, 2] = -self._arm * np.sin(phi)
        slope[:, 2, 2] = self._arm * np.cos(phi)
        curve = np.zeros((len(self._arm), 3))
        curve[:, 0] = -self._arm * np.cos(phi)
        curve[:, 2] = -self._arm * np.sin(phi)
        return slope.reshape(-1, 3), curve.ravel()

    def _respond(self, displacement: Array) -> tuple[list[ElementResponse], Array]:
        """Responses of all groups, whose tangents the next call overwrites, and their forces."""
        kept = zip(self.mixed, self._tangents, strict=True)
        responses = [group.respond(displacement, out) for group, out in kept]
        responses += [group.respond(displacement) for group in self.embedding]
        return responses, self._summed([response.force for response in responses])

    def _factorised(self, responses: Sequence[ElementResponse]) -> BlockCholesky:
        """Factorise the matrix of these responses; the next call overwrites it."""
        tangents = [response.tangent for response in responses]
        return BlockCholesky(self._pattern.assemble(tangents, self._entries))

    def _forces(self, displacement: Array) -> tuple[float, Array]:
        """Energy, and forces on all dofs for a step with the tangents of the last response."""
        energies, forces = zip(*(group.forces(displacement) for group in self.groups), strict=True)
        return sum(energies), self._summed(forces)

    def _summed(self, forces: Sequence[Array]) -> Array:
        force = np.zeros(self._count)
        for dofs, part in zip(self._dofs, forces, strict=True):
            force += np.bincount(dofs.ravel(), part.ravel(), minlength=self._count)
        return force

    def _top_product(self, responses: list[ElementResponse], slope: Array) -> Array:
        """Tangent times displacements of the top nodes (top dofs, n): array (all dofs, n)."""
        whole = np.zeros((self._count, slope.shape[1]))
        whole[self._top_dofs] = slope
        product = np.zeros_like(whole)
        for dofs, edge, response in zip(self._dofs, self._edge, responses, strict=True):
            if len(edge):
                local = np.matmul(response.tangent[edge], whole[dofs[edge]])
                np.add.at(product, dofs[edge], local)
        return product
