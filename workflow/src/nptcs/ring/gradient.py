"""How a displacement changes with the design: the adjoint of the whole load path.

Friction depends on the history, so a displacement depends on all states before it. Every state is
an equilibrium R(u, δ, a; p) = 0 under a load P(u, δ; p) = F, with the anchors a that the state
before it left, a' = x - τ/ε_t. The adjoints run backwards along the path with one transposed
solution for each state; the derivatives of R, P and a' with respect to the parameters are central
differences of one assembly at frozen states, exact except for rounding where the parameter enters
linearly, as those of rubbers and spokes do.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from nptcs.arrays import Array
from nptcs.ring.kernel.elementwise import ground
from nptcs.ring.kernel.elementwise.places import OUTER, SLIP_STIFF, UNKNOWNS, VARIABLES
from nptcs.ring.kernel.numpy_kernel import element_variables
from nptcs.ring.kernel.system import System
from nptcs.ring.solution import RingState, press_through_loads
from nptcs.ring.tyre import RingTyre

# far below the depth over which the ground's pressure sets in, far above rounding
RELATIVE_STEP = 2e-7


@dataclass(frozen=True)
class Gradient:
    """Displacement and secant stiffness at the last load, and the stiffness's derivatives.

    Parameters
    ----------
    displacement_mm, stiffness_n_per_mm : float
    stiffness_slope : array (parameters,)
        Derivatives with respect to the parameters, N/mm per unit of the parameter.
    """

    displacement_mm: float
    stiffness_n_per_mm: float
    stiffness_slope: Array


def stiffness_gradient(
    build: Callable[[Array], RingTyre], parameters: Sequence[float], loads_n: Sequence[float]
) -> Gradient:
    """Solve a tyre and differentiate its stiffness at the last load.

    Parameters
    ----------
    build : callable
        Builds a tyre from parameters (n,); the number of its nodes must not depend on them.
    parameters : sequence of float
        For example the band's C10, a factor of the spokes' energy, a thickness.
    loads_n : sequence of float
        As in `press_through_loads`.

    Raises
    ------
    RingError
        As `press_through_loads`.
    """
    values = np.asarray(parameters, dtype=float)
    tyre = build(values)
    states = press_through_loads(tyre, loads_n)
    slopes = displacement_slopes(tyre, _neighbours(build, values), states)
    rise, force = states[-1].rise_mm, states[-1].force_n
    return Gradient(rise, force / rise, -force / rise**2 * slopes)


def _neighbours(
    build: Callable[[Array], RingTyre], values: Array
) -> list[tuple[RingTyre, RingTyre, float]]:
    """For each parameter: the tyre below, the tyre above, and the distance between them."""
    found = []
    for place, value in enumerate(values):
        step = RELATIVE_STEP * (abs(value) or 1.0)
        low, high = values.copy(), values.copy()
        low[place], high[place] = value - step, value + step
        found.append((build(low), build(high), high[place] - low[place]))
    return found


def displacement_slopes(
    tyre: RingTyre,
    neighbours: Sequence[tuple[RingTyre, RingTyre, float]],
    states: Sequence[RingState],
) -> Array:
    """Give the derivatives (parameters,) of the last state's displacement.

    Parameters
    ----------
    tyre : RingTyre
    neighbours : sequence of (below, above, distance)
        Two tyres for each parameter.
    states : sequence of RingState
        The whole path, as `press_through_loads` returned it.
    """
    slopes = np.zeros(len(neighbours))
    count = len(tyre.nodes.theta)
    by_u, by_rise, by_anchor = np.zeros((count, UNKNOWNS)), 1.0, np.zeros(count)
    for number in range(len(states) - 1, -1, -1):
        state = states[number]
        system = tyre.kernel.assemble(tyre.ring, state.u, state.rise_mm, state.anchor_before)
        contact = _Contact.of(tyre, state)
        more_u, more_rise, anchor_back = contact.anchors_back(tyre, by_anchor)
        # the first touch is at a given rise, which no parameter changes
        held = number == 0
        push, weight = _adjoint(tyre, system, by_u + more_u, by_rise + more_rise, held)
        slopes += _explicit(neighbours, state, push, weight, by_anchor)
        # the residual contains -slide by_x for each millimetre of the anchor
        by_anchor = anchor_back + contact.slide * contact.along(tyre, push)
        by_u, by_rise = np.zeros((count, UNKNOWNS)), 0.0
    rest = np.zeros((count, UNKNOWNS))
    for place, (low, high, distance) in enumerate(neighbours):
        moved = (high.surface(rest)[0] - low.surface(rest)[0]) / distance
        slopes[place] += float(by_anchor @ moved)
    return slopes


def _adjoint(
    tyre: RingTyre, system: System, by_u: Array, by_rise: float, held: bool
) -> tuple[Array, float]:
    """Multipliers λ (nodes, 5) of the residual and µ of the load."""
    rhs = np.stack([by_u, system.row], axis=2)
    solved = tyre.kernel.solve(*system.transposed(), rhs, system.feet)
    own, follow = solved[:, :, 0], solved[:, :, 1]
    if held:
        return own, 0.0
    weight = (by_rise - float(np.sum(system.slope * own))) / (
        system.reaction_slope - float(np.sum(system.slope * follow))
    )
    return own - weight * follow, weight


def _explicit(
    neighbours: Sequence[tuple[RingTyre, RingTyre, float]],
    state: RingState,
    push: Array,
    weight: float,
    by_anchor: Array,
) -> Array:
    """-λ ∂R/∂p - µ ∂P/∂p + ā ∂a'/∂p of one state, for each parameter."""
    slopes = np.empty(len(neighbours))
    for place, (low, high, distance) in enumerate(neighbours):
        totals = []
        for tyre in (low, high):
            system = tyre.kernel.assemble(tyre.ring, state.u, state.rise_mm, state.anchor_before)
            anchor = tyre.anchors(state.u, state.rise_mm, state.anchor_before)
            totals.append(
                float(np.sum(by_anchor * anchor))
                - float(np.sum(push * system.force))
                - weight * system.reaction_n
            )
        slopes[place] = (totals[1] - totals[0]) / distance
    return slopes


@dataclass(frozen=True)
class _Contact:
    """Derivatives of the ground's forces on all elements, and of their surface by 10 variables."""

    by_x: Array
    by_y: Array
    slide: Array
    touching: Array
    slide_part: Array
    cross_part: Array

    @classmethod
    def of(cls, tyre: RingTyre, state: RingState) -> _Contact:
        """Evaluate at a state."""
        ring = tyre.ring
        count = len(ring.theta)
        mean, difference = element_variables(ring, state.u)
        surface = ground.surface_point(
            ring.dimensions, ring.middle, ring.length_mm, mean, difference
        )
        by_x, by_y, turned = np.zeros((3, VARIABLES, count))
        ground.forces(
            ring.dimensions,
            ring.middle,
            ring.length_mm,
            mean,
            surface,
            state.rise_mm,
            state.anchor_before,
            by_x,
            by_y,
            turned,
        )
        depth = state.rise_mm - ring.dimensions[OUTER] - surface[1]
        pressure, _, _, slide, cross = ground.traction(
            ring.dimensions, depth, surface[0] - state.anchor_before
        )
        touching = (pressure > 0.0).astype(float)
        stiff = ring.dimensions[SLIP_STIFF]
        area = tyre.areas_mm2()
        return cls(
            by_x, by_y, area * slide * touching, touching, touching * slide / stiff, cross / stiff
        )

    def along(self, tyre: RingTyre, push: Array) -> Array:
        """Product of the multipliers (nodes, 5) with ∂x of each element."""
        mean, difference = element_variables(tyre.ring, push)
        return np.sum(self.by_x * np.concatenate([mean, difference]), axis=0)

    def anchors_back(self, tyre: RingTyre, by_anchor: Array) -> tuple[Array, float, Array]:
        """Carry adjoints of the new anchors to the unknowns, the rise and the previous anchors.

        a' = x - τ/ε_t where the surface touches, x elsewhere.
        """
        by_place = by_anchor * (1.0 - self.slide_part)
        by_depth = -by_anchor * self.touching * self.cross_part
        by_variable = by_place * self.by_x - by_depth * self.by_y
        half = 0.5 * by_variable[:UNKNOWNS]
        by = by_variable[UNKNOWNS:] / tyre.nodes.length_mm
        by_u = (half - by).T + np.roll((half + by).T, 1, axis=0)
        return by_u, float(np.sum(by_depth)), by_anchor * self.slide_part
