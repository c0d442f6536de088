"""The spoke: its response to the band's motion (u_r, u_θ, φ) with the rim clamped."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from nptcs.arrays import Array
from nptcs.fe.elements.groups import ElementResponse
from nptcs.fe.matrices.block_tridiagonal import BlockCholesky
from nptcs.fe.spoke.period import SpokeDesign, SpokePeriod

MAX_ITERATIONS = 14
SMALLEST_CUT = 1.0 / 16.0
LARGEST_STEP_MM = 30.0
# accepted work of the remaining step, as a fraction of the energy, unless another value is given
STRICT_WORK = 1e-9
# an older matrix is reused while each step leaves less than this fraction of the last one's work
FOLLOWED = 0.25
# work down to which an older matrix is reused, as a fraction of the accepted work, if the next step
# reduces it as much as the last one did: the state's own matrix, computed then, gives the tangent
# to first order in the remaining step
BELOW_ACCEPTED = 1e-2
# largest misfit between energy and work along a row of states on one equilibrium path, as a
# fraction of the energy
SAME_PATH = 0.05


class SpokeError(RuntimeError):
    """The spoke's equilibrium was not found; the message gives the last state that was."""


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
        Pressures of the rubber's groups.
    stresses : list of arrays
        Stresses of the plates' groups.
    """

    motion: Array
    displacement: Array
    energy: float
    force: Array
    tangent: Array
    sensitivity: Array
    pressures: list[Array]
    stresses: list[Array]


@dataclass(frozen=True)
class SpokeFields:
    """Displacements (nodes, 3) in mm, pressures of rubber and stresses of plates in MPa."""

    displacement: Array
    pressures: Sequence[Array]
    stresses: Sequence[Array]


def _joined(last: SpokeState, state: SpokeState) -> bool:
    """Whether one equilibrium path joins two states: their energies differ by the forces' work.

    A spoke that has buckled to the other side, or has passed a loss of stability, fails this.
    """
    way = state.motion - last.motion
    work = 0.5 * (last.force + state.force) @ way
    work += way @ (last.tangent - state.tangent) @ way / 12.0
    gained = state.energy - last.energy
    return bool(abs(gained - work) < SAME_PATH * max(abs(gained), state.energy))


class SpokeModel(SpokePeriod):
    """Finite elements of one period, solved for given motions of the band.

    Newton's method on displacements with the pressures condensed; a motion is approached in
    steps that are halved when an iteration fails.

    Parameters
    ----------
    design : SpokeDesign
    accepted_work : float
        A state is accepted when the work of the next Newton step is below this part of its energy.
        Energy and forces are then right to second order in that step, the tangent to first order.
    """

    def __init__(self, design: SpokeDesign, accepted_work: float = STRICT_WORK) -> None:
        super().__init__(design)
        self._accepted_work = accepted_work

    def rest(self) -> SpokeState:
        """Return the unloaded spoke: its energy and forces are exactly zero, without rounding."""
        unloaded, motion = np.zeros_like(self.mesh.positions), np.zeros(3)
        for group in self.mixed:
            group.release()
        responses, force = self._respond(unloaded)
        factor = self._factorised(responses)
        state = self._condense(motion, unloaded, responses, force, factor, 0.0)
        return replace(state, force=np.zeros(3))

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
                state = self.settle(target, self._linear_guess(state, target))
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
        """Go from an equilibrium through a row of motions (n, 3), and yield each state.

        Raises
        ------
        SpokeError
            As `move`.
        """
        before, last = None, start
        for motion in motions:
            before, last = last, self.next_state(before, last, motion)
            yield last

    def next_state(self, before: SpokeState | None, last: SpokeState, motion: Array) -> SpokeState:
        """Continue a row from its last two states.

        Newton's method begins at the cubic through them; if it does not converge, or leaves the
        equilibrium path, `move` continues from the last state.

        Raises
        ------
        SpokeError
            As `move`.
        """
        if before is not None:
            try:
                state = self.settle(motion, self._cubic_guess(before, last, motion))
                if _joined(last, state):
                    return state
            except (FloatingPointError, np.linalg.LinAlgError):
                pass
        return self.move(last, motion)

    def _linear_guess(self, state: SpokeState, motion: Array) -> SpokeFields:
        guess = state.displacement.copy()
        guess.reshape(-1)[self._free] += state.sensitivity @ (motion - state.motion)
        guess[self.mesh.top] = self.band_motion(motion)
        return SpokeFields(guess, state.pressures, state.stresses)

    def _cubic_guess(self, before: SpokeState, last: SpokeState, motion: Array) -> SpokeFields:
        """Extrapolate the cubic through two states on the parabola through the three motions.

        Pressures and stresses follow the line through those of the two states.
        """
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
        return SpokeFields(
            guess,
            [
                b + (t - 1.0) * (b - a)
                for a, b in zip(before.pressures, last.pressures, strict=True)
            ],
            [b + (t - 1.0) * (b - a) for a, b in zip(before.stresses, last.stresses, strict=True)],
        )

    def settle(self, motion: Array, guess: SpokeFields) -> SpokeState:
        """Newton's method at a fixed motion of the band.

        Each matrix is reused as long as its steps converge; such a step costs a seventh of one
        with a new matrix. The accepted state has its own matrix.

        Parameters
        ----------
        motion : array (3,)
        guess : SpokeFields
            Its nodes on the band already have this motion.

        Raises
        ------
        FloatingPointError
            If the iteration does not converge.
        numpy.linalg.LinAlgError
            If a state on the way is unstable.
        """
        displacement = guess.displacement
        for group, inner in zip(self.mixed, [*guess.pressures, *guess.stresses], strict=True):
            group.put_inner(inner)
        for count in range(MAX_ITERATIONS):
            responses, force = self._respond(displacement)
            factor = self._factorised(responses)
            step, work = self._step(factor, force)
            energy = sum(response.energy for response in responses)
            # the stresses are those of the displacements only after a step
            if count and work < self._accepted(energy):
                energy -= 0.5 * work
                return self._condense(motion, displacement, responses, force, factor, energy)
            displacement = self._followed(displacement, factor, step, work)
        raise FloatingPointError(f"no equilibrium in {MAX_ITERATIONS} iterations")

    def _step(self, factor: BlockCholesky, force: Array) -> tuple[Array, float]:
        """Newton step (nodes, 3) in mm for these forces, and its work, N mm."""
        free = force[self._free]
        step = np.zeros(self._count)
        step[self._free] = -factor.solve(free)
        work = -float(step[self._free] @ free)
        if not np.isfinite(work):
            raise FloatingPointError("the iteration has left the range of numbers")
        largest = float(np.abs(step).max())
        if largest > LARGEST_STEP_MM:
            raise FloatingPointError(f"an iteration moves a node by {largest:.0f} mm")
        return step.reshape(-1, 3), work

    def _accepted(self, energy: float) -> float:
        """Work of a step, N mm, below which a state of this energy is accepted."""
        return self._accepted_work * max(abs(energy), 1e-6)

    def _followed(
        self, displacement: Array, factor: BlockCholesky, step: Array, work: float
    ) -> Array:
        """Take a step, and more with the same matrix as long as the work shrinks."""
        while True:
            displacement = self._taken(displacement, step)
            before = work
            energy, force = self._forces(displacement)
            step, work = self._step(factor, force)
            if work > FOLLOWED * before:
                return displacement
            # a guess may store a thousand times the energy of the state that it leads to
            if work**2 <= before * BELOW_ACCEPTED * self._accepted(energy):
                return self._taken(displacement, step)

    def _taken(self, displacement: Array, step: Array) -> Array:
        """Displacements after a step, which the stresses of rubber and plates follow."""
        for group in self.mixed:
            group.follow(step)
        return displacement + step

    def _condense(
        self,
        motion: Array,
        displacement: Array,
        responses: list[ElementResponse],
        force: Array,
        factor: BlockCholesky,
        energy: float,
    ) -> SpokeState:
        """Condense onto the band: force and tangent of the three motions.

        The force is right to second order in the inner forces that the last step leaves.
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
            pressures=[group.pressure.copy() for group in self.rubbers],
            stresses=[group.inner() for group in self.plates],
        )
