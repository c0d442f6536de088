"""States of a spoke on the grid of its energy table."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import product

import numpy as np

from nptcs.arrays import Array
from nptcs.config.solvers.fe import EnergyTableOptions, SpokeGeometry
from nptcs.fe.spoke.coordinates import (
    carried,
    coordinates_of,
    elongations_at,
    motion_of,
    straight_elongation_mm,
)
from nptcs.fe.spoke.energy_table import (
    SpokeEnergyTable,
    SpokeSamples,
    chebyshev_nodes,
    fit_energy,
    side_part,
)
from nptcs.fe.spoke.equilibrium import SpokeError, SpokeModel, SpokeState
from nptcs.fe.spoke.period import SpokeDesign

# numbers of the row (β, φ) and of the level of s
Place = tuple[int, int]
# level of s = 0, where each row starts
START = -1
# fraction of the range of s
NEXT_TO_REST = 0.03


@dataclass(frozen=True)
class SampledRow:
    """States of equal β and φ (at full range), and the numbers of their levels in rising order."""

    number: int
    beta: float
    phi: float
    levels: tuple[int, ...]


class Grid:
    """Where a table is sampled: levels of s, and the rows of states across them.

    The row β = φ = 0 has a state at every level. The other rows have one at both ends and at every
    second level between them, alternating from row to row like the squares of a chessboard, unless
    the options ask for every state.

    Parameters
    ----------
    options : EnergyTableOptions
    geometry : SpokeGeometry
        Its height is the distance between the spoke's two feet before the load.
    """

    def __init__(self, options: EnergyTableOptions, geometry: SpokeGeometry) -> None:
        self._options, self._height_mm = options, geometry.height_mm
        low, high = options.elongation_mm
        straight = straight_elongation_mm(geometry.height_mm, geometry.leg_angle_deg, high)
        nodes = chebyshev_nodes(-1.0, 1.0, options.samples[0])
        self.lengths = elongations_at(nodes, (low, high), straight)
        self.lengths[[0, -1]] = low, high
        # a level next to s = 0 would repeat the rows' start
        zero = np.abs(self.lengths) < NEXT_TO_REST * np.ptp(self.lengths)
        self._levels = [int(level) for level in np.flatnonzero(~zero)]

    def rows(self) -> list[SampledRow]:
        """Rows with β ≥ 0, one after the other; the states with β < 0 follow by symmetry."""
        options = self._options
        turns = chebyshev_nodes(
            -options.inclination_rad, options.inclination_rad, options.samples[1]
        )
        rotations = chebyshev_nodes(*options.phi_rad, options.samples[2])
        turns = turns[turns > -1e-12]
        middle = (len(rotations) - 1) // 2
        return [
            SampledRow(
                number, turns[j], rotations[k], self._levels_of(j + k - middle, turns[j], phi)
            )
            for number, ((j, k), phi) in enumerate(
                (place, rotations[place[1]])
                for place in product(range(len(turns)), range(len(rotations)))
            )
        ]

    def _levels_of(self, colour: int, beta: float, phi: float) -> tuple[int, ...]:
        small = abs(beta) < 1e-12 and abs(phi) < 1e-12
        if small or self._options.side_states == "every":
            return tuple(self._levels)
        ends = self._levels[0], self._levels[-1]
        return tuple(level for level in self._levels if (level + colour) % 2 or level in ends)

    def motions(self, row: SampledRow, levels: Sequence[int]) -> Array:
        """Motions (n, 3) of a row at these levels."""
        s = np.array([0.0 if level == START else self.lengths[level] for level in levels])
        part = side_part(s, self._options.elongation_mm[0], self._options.narrowing)
        coordinates = np.stack([s, part * row.beta, part * row.phi], axis=1)
        return motion_of(coordinates, self._height_mm)[0]


def sampled_states(model: SpokeModel, options: EnergyTableOptions) -> dict[Place, SpokeState]:
    """Compute the spoke's states on the table's grid, walking from level to level.

    Where a row loses its stability in compression, the states of all rows end at its last level.

    Parameters
    ----------
    model : SpokeModel
    options : EnergyTableOptions

    Raises
    ------
    SpokeError
        If a state in tension or at the unloaded radius is not found.
    """
    grid = Grid(options, model.design.geometry)
    walk = _Walk(model, grid)
    rest, lowest = model.rest(), 0
    starts: dict[float, SpokeState] = {}
    for row in grid.rows():
        # start from the row of equal φ and the next smaller β
        start = starts[row.phi] = walk.begun(row, starts.get(row.phi, rest))
        up = [level for level in row.levels if grid.lengths[level] > 0.0]
        walk.along(row, start, up)
        try:
            down = [level for level in reversed(row.levels) if level not in up and level >= lowest]
            walk.along(row, start, down)
        except SpokeError:
            lowest = max(lowest, _last_level(model, grid, row, walk.found))
    return {at: state for at, state in walk.found.items() if not 0 <= at[1] < lowest}


@dataclass(frozen=True)
class _Walk:
    """Goes along rows and collects their states."""

    model: SpokeModel
    grid: Grid
    found: dict[Place, SpokeState] = field(default_factory=dict)

    def begun(self, row: SampledRow, near: SpokeState) -> SpokeState:
        """Go from a state to the start of a row, which may be that state itself."""
        if np.allclose(self.grid.motions(row, [START])[0], near.motion, rtol=0.0, atol=1e-12):
            self.found[row.number, START] = near
            return near
        return self.along(row, near, [START])

    def along(self, row: SampledRow, start: SpokeState, levels: Sequence[int]) -> SpokeState:
        """Go from a state through these levels of a row, and return the last state."""
        before, last = None, start
        for level, motion in zip(levels, self.grid.motions(row, levels), strict=True):
            before, last = last, self.model.next_state(before, last, motion)
            if level != START and self.grid.lengths[level] < 0.0:
                _check_stability(last)
            self.found[row.number, level] = last
        return last


def _check_stability(state: SpokeState) -> None:
    """Refuse a compressed state in which the foot on the band, if it were free, would turn.

    The spoke is about to snap there: its tangents change too fast for a polynomial to follow.

    Raises
    ------
    SpokeError
        If ∂²E/∂φ² is not positive.
    """
    if not state.tangent[2, 2] > 0.0:
        raise SpokeError(f"the foot turns by itself at u_r, u_θ, φ = {np.round(state.motion, 4)}")


def _last_level(
    model: SpokeModel, grid: Grid, row: SampledRow, found: dict[Place, SpokeState]
) -> int:
    """Lowest level that a row reaches, including the level it skips next to its last state."""
    inside = int(np.searchsorted(grid.lengths, 0.0))
    reached = [level for number, level in found if number == row.number and 0 <= level < inside]
    last = min(reached, default=START)
    between = (last if last >= 0 else inside) - 1
    if between in row.levels or between < 0:
        return between + 1
    try:
        motion = grid.motions(row, [between])[0]
        state = model.move(found[row.number, last], motion)
        _check_stability(state)
    except SpokeError:
        return between + 1
    found[row.number, between] = state
    return between


def samples_of(states: Mapping[Place, SpokeState], height_mm: float) -> SpokeSamples:
    """Energies of states and their derivatives with respect to the table's coordinates."""
    motion = np.array([state.motion for state in states.values()])
    force = np.array([state.force for state in states.values()])
    tangent = np.array([state.tangent for state in states.values()])
    coordinates = coordinates_of(motion, height_mm)[0]
    return SpokeSamples(
        coordinates,
        np.array([state.energy for state in states.values()]),
        *carried(force, tangent, *motion_of(coordinates, height_mm)[1:]),
    )


def sample_spoke(model: SpokeModel, options: EnergyTableOptions) -> SpokeSamples:
    """Sample a spoke for its table, see `sampled_states`."""
    return samples_of(sampled_states(model, options), model.design.geometry.height_mm)


def computed_table(design: SpokeDesign, options: EnergyTableOptions) -> SpokeEnergyTable:
    """Compute the energy table of one spoke."""
    samples = sample_spoke(SpokeModel(design, options.accepted_work), options)
    return fit_energy(samples, options, design.geometry)
