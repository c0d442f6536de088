"""The spoke: its response to the band's motion (u_r, u_θ, φ), the rim being clamped."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import assert_never

import numpy as np

from nptcs.arrays import Array
from nptcs.config.fe import PlateCoupling, SpokeGeometry, SpokeMesh
from nptcs.fe.elements.groups import ElementGroup, Response, element_dofs
from nptcs.fe.matrices.block_tridiagonal import BlockCholesky, BlockPattern
from nptcs.fe.spoke.element_groups import plate_blocks, rubber_block
from nptcs.fe.spoke.embedded_plates import straight_block
from nptcs.fe.spoke.mesh import LAYER_ORDERS, RUBBER_ORDERS, build_period

MAX_ITERATIONS = 14
SMALLEST_CUT = 1.0 / 16.0


class SpokeError(RuntimeError):
    """The spoke's equilibrium was not found, with the last state that was."""


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


@dataclass
class SpokeState:
    """An equilibrium of the whole spoke.

    Parameters
    ----------
    motion : array (3,)
        u_r mm, u_θ mm, φ rad of the foot on the band.
    displacement : array (nodes, 3)
        Nodal displacements of the period, mm.
    energy : float
        N mm.
    force : array (3,)
        ∂E/∂(u_r, u_θ, φ): N, N, N mm.
    tangent : array (3, 3)
        Second derivatives, by static condensation.
    sensitivity : array (free unknowns, 3)
        Derivatives of the inner displacements with respect to the motion.
    pressures : list of arrays
        Pressures of the rubber's blocks.
    """

    motion: Array
    displacement: Array
    energy: float
    force: Array
    tangent: Array
    sensitivity: Array
    pressures: list[Array]


class SpokeModel:
    """Finite elements of one period, solved for given motions of the band.

    Newton's method on displacements with the pressures condensed; a motion is approached in
    steps that are halved when an iteration fails.
    """

    def __init__(self, design: SpokeDesign) -> None:
        self.design = design
        self.mesh = build_period(
            design.geometry, design.mesh, design.pitch_mm, design.plate_width_mm
        )
        bulk = design.mesh.bulk_to_shear_ratio * 2.0 * design.c10_mpa
        self.rubbers = [
            rubber_block(self.mesh.rubber, RUBBER_ORDERS, design.c10_mpa, bulk),
            rubber_block(self.mesh.layer, LAYER_ORDERS, design.c10_mpa, bulk),
        ]
        self.plates = plate_blocks(
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
                self.embedding = [straight_block(self.mesh.plate, columns, e2_mpa)]
            case "conforming":
                self.embedding = []
            case _:
                assert_never(design.plate_coupling)
        self._dofs = [element_dofs(block.nodes, 3) for block in self.blocks]
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

    @property
    def blocks(self) -> list[ElementGroup]:
        """All element blocks, and what holds the plates straight."""
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

    def _respond(self, displacement: Array) -> tuple[list[Response], Array]:
        responses = [block.respond(displacement) for block in self.blocks]
        force = np.zeros(self._count)
        for dofs, response in zip(self._dofs, responses, strict=True):
            force += np.bincount(dofs.ravel(), response.force.ravel(), minlength=self._count)
        return responses, force

    def rest(self) -> SpokeState:
        """Return the unloaded spoke: no energy and no force, not even of rounding."""
        state = self._equilibrium(np.zeros(3), np.zeros_like(self.mesh.positions), None)
        return replace(state, energy=0.0, force=np.zeros(3))

    def move(self, state: SpokeState, motion: Array) -> SpokeState:
        """Go from an equilibrium to another motion of the band.

        Raises
        ------
        SpokeError
            If steps of 1/16 of the way still fail; the message gives the last motion reached.
        """
        done, step = 0.0, 1.0
        start = state.motion
        while done < 1.0:
            target = start + min(done + step, 1.0) * (motion - start)
            try:
                state = self._equilibrium(target, self._linear_guess(state, target), state)
            except (FloatingPointError, np.linalg.LinAlgError) as error:
                step /= 2.0
                if step < SMALLEST_CUT:
                    raise SpokeError(
                        f"no equilibrium beyond u_r, u_θ, φ = {np.round(state.motion, 4)}: {error}"
                    ) from error
                continue
            done = min(done + step, 1.0)
        return state

    def walk(self, start: SpokeState, motions: Array) -> Iterator[SpokeState]:
        """Go from an equilibrium through a row of motions (n, 3), and give each state.

        The guess extrapolates the cubic through the last two states and their derivatives; where
        it does not converge, `move` goes on from the last state.

        Raises
        ------
        SpokeError
            As `move`.
        """
        before, last = None, start
        for motion in motions:
            state = None if before is None else self._follow(before, last, motion)
            before, last = last, state or self.move(last, motion)
            yield last

    def _follow(self, before: SpokeState, last: SpokeState, motion: Array) -> SpokeState | None:
        """Go on along the last two states, or None where the iteration from there fails."""
        try:
            return self._equilibrium(motion, self._cubic_guess(before, last, motion), last)
        except (FloatingPointError, np.linalg.LinAlgError):
            return None

    def _linear_guess(self, state: SpokeState, motion: Array) -> Array:
        guess = state.displacement.copy()
        guess.reshape(-1)[self._free] += state.sensitivity @ (motion - state.motion)
        guess[self.mesh.top] = self.band_motion(motion)
        return guess

    def _cubic_guess(self, before: SpokeState, last: SpokeState, motion: Array) -> Array:
        """Extrapolate the cubic through two states on the parabola through the three motions."""
        way, whole = last.motion - before.motion, motion - before.motion
        t = float(whole @ way / (way @ way))
        bend = (whole - t * way) / (t * (t - 1.0))
        values = (1.0 - t) ** 2 * (1.0 + 2.0 * t), t * t * (3.0 - 2.0 * t)
        slopes = t * (1.0 - t) ** 2, t * t * (t - 1.0)
        guess = values[0] * before.displacement + values[1] * last.displacement
        inner = guess.reshape(-1)[self._free]
        inner += slopes[0] * (before.sensitivity @ (way - bend))
        inner += slopes[1] * (last.sensitivity @ (way + bend))
        guess[self.mesh.top] = self.band_motion(motion)
        return guess

    def _equilibrium(
        self, motion: Array, displacement: Array, near: SpokeState | None
    ) -> SpokeState:
        """Newton's method at a fixed motion of the band, from the pressures of a state near by."""
        for i, block in enumerate(self.rubbers):
            block.pressure = np.zeros_like(block.pressure) if near is None else near.pressures[i]
        for _ in range(MAX_ITERATIONS):
            responses, force = self._respond(displacement)
            factor = BlockCholesky(self._pattern.assemble([r.tangent for r in responses]))
            free = force[self._free]
            step = np.zeros_like(displacement)
            step.reshape(-1)[self._free] = -factor.solve(free)
            work = -float(step.reshape(-1)[self._free] @ free)
            energy = sum(response.energy for response in responses)
            if not np.isfinite(work):
                raise FloatingPointError("the iteration has left the range of numbers")
            if work < 1e-9 * max(abs(energy), 1e-6):
                energy -= 0.5 * work
                return self._condense(motion, displacement, responses, force, factor, energy)
            largest = float(np.abs(step).max())
            if largest > 30.0:
                raise FloatingPointError(f"an iteration moves a node by {largest:.0f} mm")
            displacement = displacement + step
            for block in self.rubbers:
                block.update_pressure(step)
        raise FloatingPointError(f"no equilibrium in {MAX_ITERATIONS} iterations")

    def _top_product(self, responses: list[Response], slope: Array) -> Array:
        """Tangent times displacements of the top nodes (top dofs, n): array (all dofs, n)."""
        whole = np.zeros((self._count, slope.shape[1]))
        whole[self._top_dofs] = slope
        product = np.zeros_like(whole)
        for dofs, edge, response in zip(self._dofs, self._edge, responses, strict=True):
            if len(edge):
                local = np.matmul(response.tangent[edge], whole[dofs[edge]])
                np.add.at(product, dofs[edge], local)
        return product

    def _condense(
        self,
        motion: Array,
        displacement: Array,
        responses: list[Response],
        force: Array,
        factor: BlockCholesky,
        energy: float,
    ) -> SpokeState:
        """Condense onto the band: force and tangent of the three motions.

        The force is right to second order in what the last step leaves of the inner forces.
        """
        slope, curve = self.band_motion_slope(float(motion[2]))
        product = self._top_product(responses, slope)
        sensitivity = -factor.solve(product[self._free])
        reaction = force[self._top_dofs]
        tangent = slope.T @ product[self._top_dofs] + product[self._free].T @ sensitivity
        tangent[2, 2] += reaction @ curve
        return SpokeState(
            motion=np.array(motion, dtype=float),
            displacement=displacement,
            energy=self.scale * energy,
            force=self.scale * (slope.T @ reaction + sensitivity.T @ force[self._free]),
            tangent=self.scale * 0.5 * (tangent + tangent.T),
            sensitivity=sensitivity,
            pressures=[block.pressure.copy() for block in self.rubbers],
        )
