"""The tyre: band and tread in plane strain on spoke super-elements, pressed against the ground."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from nptcs.arrays import Array
from nptcs.config.solvers.fe import GroundContact, PaperMesh, TyreMesh
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.fe.elements.groups import ElementResponse, MixedGroup, element_dofs
from nptcs.fe.matrices.cyclic import BandedPattern, folded_order
from nptcs.fe.spoke.energy_table import SpokeEnergyTable, TableRangeError
from nptcs.fe.tyre.contact import Ground
from nptcs.fe.tyre.element_groups import ring_rubbers, wire_groups
from nptcs.fe.tyre.feet import foot_operators
from nptcs.fe.tyre.mesh import build_ring
from nptcs.fe.tyre.path import LoadPoint, check_branch, extrapolated

MAX_ITERATIONS = 30
# from an extrapolated start, which needs more only if it lies in another contact state
MAX_ITERATIONS_AHEAD = 12
# from this iteration on, steps that do not shrink are shortened
CALM_ITERATIONS = 6
# a soft ground hardens when the steps are this small
SETTLED_MM = 0.05
LARGEST_STEP_MM = 6.0
# largest last step: the error after it is about its square
CONVERGED_MM = 1e-5
SMALLEST_STEP_N = 2.0
FIRST_RISE_MM = 0.5
SMALLEST_RISE_MM = 0.02


class TyreError(RuntimeError):
    """The load could not be reached; `path` has the points that were."""

    def __init__(self, message: str, path: LoadPath) -> None:
        # both in args, so that a worker process can pickle the exception
        super().__init__(message, path)
        self.path = path

    def __str__(self) -> str:
        return str(self.args[0])


@dataclass
class LoadPath:
    """Converged points of the load–displacement curve."""

    force_n: list[float] = field(default_factory=lambda: [0.0])
    rise_mm: list[float] = field(default_factory=lambda: [0.0])
    iterations: int = 0


@dataclass(frozen=True)
class TyreState:
    """The loaded tyre: ring displacements (nodes, 2) mm, ground's rise mm, spokes' motions."""

    displacement: Array
    rise_mm: float
    motion: Array
    path: LoadPath


@dataclass
class _Trial:
    """Residual and tangent of one iterate."""

    force: Array
    matrix: Array
    slope: Array
    reaction: float
    reaction_row: Array
    reaction_slope: float
    internal: Array


class TyreModel:
    """A tyre with one energy table for all spokes and one rubber for band and tread.

    Parameters
    ----------
    tyre : TyreGeometry
    table : SpokeEnergyTable
        Energy of one whole spoke.
    foot_width_mm : float
        Circumferential width of a spoke's foot on the band.
    c10_mpa : float
        Rubber of band and tread.
    bulk_to_shear_ratio : float
    mesh : TyreMesh or PaperMesh
    contact : GroundContact
    """

    def __init__(
        self,
        tyre: TyreGeometry,
        table: SpokeEnergyTable,
        foot_width_mm: float,
        c10_mpa: float,
        bulk_to_shear_ratio: float,
        mesh: TyreMesh | PaperMesh,
        contact: GroundContact,
    ) -> None:
        self.table = table
        self.mesh = build_ring(tyre, mesh, foot_width_mm)
        ring = self.mesh
        self.rubbers = ring_rubbers(ring, tyre.tread_width_mm, c10_mpa, bulk_to_shear_ratio)
        self.wires = wire_groups(ring, tyre)
        self._bodies: list[MixedGroup] = [*self.rubbers, *self.wires]
        self.ground = Ground(
            ring.positions, ring.tread_edges, ring.contact_rule, tyre.tread_width_mm, contact
        )
        self.foot_operator = foot_operators(ring)
        nodes = [*[group.nodes for group in self._bodies], ring.feet]
        self._dofs = [element_dofs(group, 2) for group in [*nodes, ring.tread_edges]]
        self._count = 2 * len(ring.positions)
        rows = len(ring.radii)
        column, row = np.divmod(np.arange(len(ring.positions)), rows)
        node = folded_order(len(ring.theta))[column] * rows + row
        self._place = (2 * node[:, None] + np.arange(2)).ravel()
        self._pattern = BandedPattern([self._place[d] for d in self._dofs], self._count)

    def spoke_motion(self, displacement: Array) -> Array:
        """(u_r, u_θ, φ) of each spoke's foot, array (spokes, 3)."""
        local = displacement[self.mesh.feet].reshape(len(self.mesh.feet), -1)
        motion: Array = np.einsum("skn,sn->sk", self.foot_operator, local)
        return motion

    def spoke_response(self, displacement: Array) -> ElementResponse:
        """Energy of the spokes, and their forces and tangents on the unknowns of their feet."""
        energy, push, stiff = self.table.evaluate(self.spoke_motion(displacement))
        lift = self.foot_operator.transpose(0, 2, 1)
        return ElementResponse(
            float(energy.sum()),
            np.matmul(lift, push[..., None])[..., 0],
            np.matmul(lift, np.matmul(stiff, self.foot_operator)),
        )

    def _trial(self, displacement: Array, rise: float) -> _Trial:
        responses = [group.respond(displacement) for group in self._bodies]
        spokes = self.spoke_response(displacement)
        ground = self.ground.respond(displacement, rise)
        forces = [*[r.force for r in responses], spokes.force]
        tangents = [*[r.tangent for r in responses], spokes.tangent, ground.tangent]
        internal = np.zeros(self._count)
        for dofs, part in zip(self._dofs[:-1], forces, strict=True):
            internal += np.bincount(dofs.ravel(), part.ravel(), minlength=self._count)
        edge = self._dofs[-1].ravel()
        slope = np.zeros(self._count)
        slope += np.bincount(edge, ground.force_slope.ravel(), minlength=self._count)
        row = np.zeros(self._count)
        row[1::2] = slope[1::2]
        return _Trial(
            force=internal + np.bincount(edge, ground.force.ravel(), minlength=self._count),
            matrix=self._pattern.assemble(tangents),
            slope=slope,
            reaction=ground.reaction_n,
            reaction_row=row,
            reaction_slope=ground.reaction_slope,
            internal=internal,
        )

    def _linear(self, trial: _Trial) -> Array:
        """Solve the iterate's equations for its residual and for the ground's rise."""
        rhs = np.empty((self._count, 2))
        rhs[self._place] = np.stack([trial.force, trial.slope], axis=1)
        return self._pattern.solve(trial.matrix, rhs)[self._place]

    def _newton(
        self, start: LoadPoint, load: float | None, path: LoadPath, most: int = MAX_ITERATIONS
    ) -> tuple[Array, float]:
        """Newton's method at a given load, or at a given rise if `load` is None.

        A soft ground hardens as soon as the steps are small.
        """
        displacement, rise = start.displacement, start.rise_mm
        for group, stresses in zip(self._bodies, start.stresses, strict=True):
            group.put_inner(stresses)
        before, part, calm = np.inf, 1.0, CALM_ITERATIONS
        for count in range(most):
            path.iterations += 1
            trial = self._trial(displacement, rise)
            solved = self._linear(trial)
            step, follow = -solved[:, 0], -solved[:, 1]
            change = 0.0
            if load is not None:
                missing = load - trial.reaction - trial.reaction_row @ step
                change = float(missing / (trial.reaction_slope + trial.reaction_row @ follow))
                step = step + change * follow
            largest = float(np.abs(step).max())
            if not np.isfinite(largest):
                raise FloatingPointError("the iteration has left the range of numbers")
            if count >= calm:
                # where two contact states alternate, go half-way, and further again once that helps
                part = max(part / 2.0, 0.1) if largest > 0.5 * before else min(2.0 * part, 1.0)
            before = largest
            damp = min(part, LARGEST_STEP_MM / max(largest, 1e-12))
            move = step.reshape(-1, 2)
            displacement = displacement + damp * move
            rise += damp * change
            for group in self._bodies:
                group.follow(move, damp)
            if self.ground.soft:
                if largest < SETTLED_MM:
                    self.ground.harden()
                    before, part, calm = np.inf, 1.0, count + CALM_ITERATIONS
            elif max(largest, abs(change)) < CONVERGED_MM:
                return displacement, rise
        raise FloatingPointError(f"no equilibrium in {most} iterations")

    def load(self, loads_n: Sequence[float]) -> TyreState:
        """Press the tyre against the ground through a rising sequence of loads.

        Raises
        ------
        TyreError
            If a load is not reached with steps down to 2 N, or a spoke leaves its table.
        """
        path = LoadPath()
        before: LoadPoint | None = None
        self.ground.release()
        try:
            last = self._first_touch(path)
            for load in loads_n:
                while last.force_n < load:
                    before, last = last, self._advance(before, last, load, path)
        except (FloatingPointError, TableRangeError) as error:
            end = f"last converged: {path.force_n[-1]:.1f} N at {path.rise_mm[-1]:.3f} mm"
            raise TyreError(f"{error}; {end}", path) from error
        motion = self.spoke_motion(last.displacement)
        return TyreState(last.displacement, last.rise_mm, motion, path)

    def _first_touch(self, path: LoadPath) -> LoadPoint:
        """Raise the ground a little under the unloaded tyre, by less if that does not converge."""
        rise = FIRST_RISE_MM
        while True:
            self.ground.soften()
            try:
                displacement, _ = self._newton(self._unloaded(rise), None, path)
            except FloatingPointError:
                rise /= 2.0
                if rise < SMALLEST_RISE_MM:
                    raise
                continue
            self.ground.advance(displacement, rise)
            reached = self.ground.respond(displacement, rise).reaction_n
            path.force_n.append(reached)
            path.rise_mm.append(rise)
            return self._point(reached, displacement, rise)

    def _unloaded(self, rise_mm: float) -> LoadPoint:
        """Return the tyre as it was before the ground rose."""
        displacement = np.zeros_like(self.mesh.positions)
        for group in self._bodies:
            group.release()
            group.respond(displacement)
        return self._point(0.0, displacement, rise_mm)

    def _point(self, force_n: float, displacement: Array, rise_mm: float) -> LoadPoint:
        stresses = [group.inner() for group in self._bodies]
        return LoadPoint(force_n, displacement, rise_mm, stresses)

    def _advance(
        self, before: LoadPoint | None, last: LoadPoint, load: float, path: LoadPath
    ) -> LoadPoint:
        """One load step from the last point, halved until it converges.

        Newton's method begins on the line through the last two points; if it does not converge
        from there, it begins at the last point.
        """
        step = load - last.force_n
        start = last if before is None else extrapolated(before, last, load)
        while True:
            target = load if step >= load - last.force_n else last.force_n + step
            most = MAX_ITERATIONS if start is last else MAX_ITERATIONS_AHEAD
            try:
                moved, rise = self._newton(start, target, path, most)
                check_branch(path.force_n, path.rise_mm, target, rise)
            except (FloatingPointError, TableRangeError):
                if start is last:
                    step /= 2.0
                    if step < SMALLEST_STEP_N:
                        raise
                start = last
                continue
            self.ground.advance(moved, rise)
            path.force_n.append(target)
            path.rise_mm.append(rise)
            return self._point(target, moved, rise)

    def energy(self, state: TyreState) -> dict[str, float]:
        """Energy of each part at a state, N mm."""
        return {
            "rubber": sum(group.respond(state.displacement).energy for group in self.rubbers),
            "wires": sum(wire.respond(state.displacement).energy for wire in self.wires),
            "spokes": self.spoke_response(state.displacement).energy,
            "contact": self.ground.energy(state.displacement, state.rise_mm),
        }

    def neutral_line(self, displacement: Array) -> Array:
        """Deformed positions (columns, 2) of the band's middle, x and y in mm."""
        moved = self.mesh.positions + displacement
        line: Array = moved[self.mesh.middle_row :: len(self.mesh.radii)]
        return line
