"""Pressing a ring against the ground: Newton's method bordered by the load, along a load path."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from nptcs.arrays import Array
from nptcs.ring.kernel.elementwise.places import UNKNOWNS
from nptcs.ring.kernel.system import System
from nptcs.ring.tyre import RingTyre

MAX_ITERATIONS = 30
# from this iteration on, steps that do not shrink are shortened
CALM_ITERATIONS = 6
LARGEST_STEP_MM = 6.0
SMALLEST_STEP_N = 2.0
FIRST_RISE_MM, SMALLEST_RISE_MM = 0.2, 0.01
# an iteration whose step is below this leaves an error of about the step's square
TOLERANCE_MM = 1e-5
BACKTRACKS = 6


class RingError(RuntimeError):
    """A load could not be reached; `states` are those that were."""

    def __init__(self, message: str, states: list[RingState]) -> None:
        # both in args, so that the exception can be pickled by a worker process
        super().__init__(message, states)
        self.states = states

    def __str__(self) -> str:
        return str(self.args[0])


class SpokeRangeError(RingError):
    """A spoke leaves the range of its energy table."""


class _NoEquilibrium(Exception):
    """No equilibrium with this step; `outside` says whether a spoke left its table."""

    def __init__(self, message: str, outside: bool = False) -> None:
        super().__init__(message)
        self.outside = outside


@dataclass(frozen=True)
class RingState:
    """An equilibrium on the path.

    Parameters
    ----------
    u : array (nodes, 5)
        u_x, u_y (mm), θ, ψ (rad), s (mm) of each node.
    rise_mm : float
        Displacement of the ground towards the wheel's centre: the tyre's deflection.
    force_n : float
        Vertical load.
    anchor : array (nodes,)
        Place x at which each element's surface rests after this state.
    anchor_before : array (nodes,)
        The same before this state, which was computed with it.
    iterations : int
    """

    u: Array
    rise_mm: float
    force_n: float
    anchor: Array
    anchor_before: Array
    iterations: int


def press_through_loads(tyre: RingTyre, loads_n: Sequence[float]) -> list[RingState]:
    """Press a tyre against the ground through a rising sequence of loads.

    Because of friction the states depend, a little, on the loads before them.

    Parameters
    ----------
    tyre : RingTyre
    loads_n : sequence of float
        Rising, above zero.

    Returns
    -------
    list of RingState
        All converged states: the first touch, the loads, and intermediate ones where a
        step had to be halved. The loads are met exactly.

    Raises
    ------
    RingError
        If a load is not reached even with steps of 2 N.
    SpokeRangeError
        If a spoke leaves its table.
    ValueError
        If the loads do not rise from above zero.
    """
    wanted = np.asarray(loads_n, dtype=float)
    if not (len(wanted) and np.all(np.isfinite(wanted)) and np.all(np.diff(wanted, prepend=0) > 0)):
        raise ValueError(f"loads must rise from above zero, got {list(loads_n)}")
    states: list[RingState] = []
    try:
        states.append(_first_touch(tyre, float(wanted[0])))
        for target in wanted:
            while states[-1].force_n < target:
                states.append(_next(tyre, states, float(target)))
    except _NoEquilibrium as error:
        reached = f"{states[-1].force_n:.1f} N at {states[-1].rise_mm:.3f} mm" if states else "none"
        kind = SpokeRangeError if error.outside else RingError
        raise kind(f"{error}; last converged: {reached}", states) from error
    return states


def _first_touch(tyre: RingTyre, first_load_n: float) -> RingState:
    """Equilibrium at a small rise, with a force below the first load."""
    count = len(tyre.nodes.theta)
    x, _ = tyre.surface(np.zeros((count, UNKNOWNS)))
    rest = RingState(np.zeros((count, UNKNOWNS)), 0.0, 0.0, x, x, 0)
    rise = FIRST_RISE_MM
    while True:
        try:
            state = _equilibrium(tyre, rest, rest.u, rise, None)
            if state.force_n <= 0.9 * first_load_n:
                return state
        except _NoEquilibrium:
            if rise < SMALLEST_RISE_MM:
                raise
        rise /= 2.0


def _next(tyre: RingTyre, states: list[RingState], target: float) -> RingState:
    """One load step from the last state, halved until it converges."""
    last = states[-1]
    step = target - last.force_n
    while True:
        goal = target if step >= target - last.force_n else last.force_n + step
        try:
            return _equilibrium(tyre, last, *_predicted(states, goal), goal)
        except _NoEquilibrium:
            step /= 2.0
            if step < SMALLEST_STEP_N:
                raise


def _predicted(states: list[RingState], goal: float) -> tuple[Array, float]:
    """Start (u, rise) for a load: on the line through the last two states."""
    last = states[-1]
    if len(states) < 2:
        return last.u, last.rise_mm
    before = states[-2]
    # no further than the last step: the path bends
    part = min((goal - last.force_n) / (last.force_n - before.force_n), 1.0)
    return last.u + part * (last.u - before.u), (1.0 + part) * last.rise_mm - part * before.rise_mm


def _equilibrium(
    tyre: RingTyre, last: RingState, u: Array, rise: float, load_n: float | None
) -> RingState:
    """Newton's method at a given load, or at the given rise if `load_n` is None."""
    count = 0
    # the spokes were inside their table before the last step, which is below the tolerance
    for moved, moved_rise in _iterates(tyre, last, u, rise, load_n):
        u, rise = moved, moved_rise
        count += 1
    force = load_n
    if force is None:
        pressure = tyre.traction(u, rise, last.anchor)[1]
        force = float(np.sum(pressure * tyre.areas_mm2()))
    return RingState(u, rise, force, tyre.anchors(u, rise, last.anchor), last.anchor, count)


def _iterates(
    tyre: RingTyre, last: RingState, u: Array, rise: float, load_n: float | None
) -> Iterator[tuple[Array, float]]:
    """Yield iterates (u, rise) until the last step is below the tolerance."""
    before, part, drawn_back = np.inf, 1.0, 0
    # the last iterate inside the table
    inside = last.u, rise if load_n is None else last.rise_mm
    squeezed = None
    for count in range(MAX_ITERATIONS):
        system = tyre.kernel.assemble(tyre.ring, u, rise, last.anchor, squeezed)
        squeezed = system.squeezed
        if outside := tyre.spokes.outside(system.coordinates):
            drawn_back += 1
            if drawn_back > BACKTRACKS:
                raise _NoEquilibrium(outside, outside=True)
            u, rise = 0.5 * (u + inside[0]), 0.5 * (rise + inside[1])
            continue
        step, change = _newton_step(tyre, system, load_n)
        # of lengths and of turns, which are smaller by what the ring measures in mm
        largest = float(np.abs(step).max())
        if not np.isfinite(largest):
            raise _NoEquilibrium("the iteration has left the range of numbers")
        if count >= CALM_ITERATIONS:
            # two contact states alternate: halve the step, and double it again once that helps
            part = max(part / 2.0, 0.1) if largest > 0.5 * before else min(2.0 * part, 1.0)
        before = largest
        damp = min(part, LARGEST_STEP_MM / max(largest, 1e-12))
        inside = u, rise
        u, rise = u + damp * step, rise + damp * change
        yield u, rise
        if largest < TOLERANCE_MM and abs(change) < TOLERANCE_MM:
            return
    raise _NoEquilibrium(f"no equilibrium in {MAX_ITERATIONS} iterations")


def _newton_step(tyre: RingTyre, system: System, load_n: float | None) -> tuple[Array, float]:
    rhs = np.empty((*system.force.shape, 2))
    rhs[:, :, 0], rhs[:, :, 1] = system.force, system.slope
    try:
        solved = tyre.kernel.solve(system.diagonal, system.upper, system.lower, rhs, system.feet)
    except (FloatingPointError, np.linalg.LinAlgError) as error:
        raise _NoEquilibrium(str(error)) from error
    step, follow = -solved[:, :, 0], -solved[:, :, 1]
    if load_n is None:
        return step, 0.0
    missing = load_n - system.reaction_n - float(np.vdot(system.row, step))
    change = missing / (system.reaction_slope + float(np.vdot(system.row, follow)))
    return step + change * follow, change


def tangent_stiffness(tyre: RingTyre, state: RingState) -> float:
    """dF/dδ at a state, N/mm, with the anchors of the ground's shear from the state before."""
    system = tyre.kernel.assemble(tyre.ring, state.u, state.rise_mm, state.anchor_before)
    rhs = system.slope[:, :, None]
    solved = tyre.kernel.solve(system.diagonal, system.upper, system.lower, rhs, system.feet)
    follow = -solved[:, :, 0]
    return system.reaction_slope + float(np.sum(system.row * follow))
