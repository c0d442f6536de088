"""The two angles of each design: Newton's method, and brackets where it does not converge.

For a given θc the transition angle is the root of U(θt) = u_r(θt; θc, θt), which is negative
before it and positive beyond; displacement and force then grow with θc. Both facts hold over the
whole range of the robustness sweep and serve as brackets.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, assert_never

import numpy as np

from nptcs.arrays import Floating, Mask
from nptcs.lca.linear.scaling import ScaledRing
from nptcs.lca.linear.system import Arcs, Joined, join_regions

Target = Literal["force", "sinking", "contact_angle"]
STEP = 1e-7
"""Relative step of θc and step of θt (radians) after which Newton's method, whose error is of the
order of the step's square, has converged."""
MISFIT = 1e-9
"""Largest relative misfit of the target, and of u(θt) to δ, in a solution."""
LARGEST_CONTACT = np.radians(85)
"""No tyre has larger contact angles; the flat constraint is singular at 90°."""
NEWTON_STEPS, BRACKET_STEPS = 20, 80
BRACKET_STEP = 1e-10
"""Relative step after which a bracketed search, whose last steps are Newton's, has converged."""


@dataclass(frozen=True)
class Angles:
    """θc and θt (radians) of n designs, and whether they were found."""

    contact: Floating
    transition: Floating
    found: Mask


def first_guess(ring: ScaledRing, force: Floating) -> Floating:
    """Contact angle at which the ring alone carries most of the force F/GA."""
    return np.asarray(np.arctan(force / 2 * (1 + ring.compression * force) ** -0.25))


def _first_transition(ring: ScaledRing, theta_c: Floating) -> Floating:
    """Transition angle to start from; near the bending length of the foundation."""
    stiffness = (1 + ring.tension) * (1 + ring.compression)
    return np.minimum(theta_c + 1.35 * stiffness**-0.18, 0.5 * (np.pi + theta_c))


def _misfit(joined: Joined, target: Target, value: Floating) -> Floating:
    """Quantity minus its target, with derivatives with respect to θc and θt, (n, 3)."""
    match target:
        case "contact_angle":
            error = joined.contact_angle - value
            return np.stack([error, np.ones_like(error), np.zeros_like(error)], axis=1)
        case "force":
            misfit = joined.force.copy()
        case "sinking":
            misfit = joined.sinking.copy()
        case _:
            assert_never(target)
    misfit[:, 0] -= value
    return misfit


def _step(joined: Joined, misfit: Floating) -> tuple[Floating, Floating]:
    """Newton's step for both angles, kept inside 0 < θc < θt < π and in U's direction."""
    theta_c, theta_t = joined.contact_angle, joined.transition_angle
    (m, m_c, m_t), (u, u_c, u_t) = misfit.T, joined.transition.T
    determinant = m_c * u_t - m_t * u_c
    by_c = (u * m_t - m * u_t) / determinant
    by_t = (m * u_c - u * m_c) / determinant
    astray = (u * by_t > 0) | (u_t <= 0)
    retreat, advance = -0.4 * (theta_t - theta_c), 0.3 * (np.pi - theta_t)
    by_t = np.where(astray, np.where(u > 0, retreat, advance), by_t)
    by_c = np.where(astray, -m / m_c, by_c)
    by_c = np.clip(by_c, -0.5 * theta_c, np.minimum(theta_c, 0.3 * (np.pi / 2 - theta_c)))
    return by_c, np.clip(by_t, -0.5 * (theta_t - theta_c), 0.5 * (np.pi - theta_t))


def newton(
    ring: ScaledRing, arcs: Arcs, target: Target, value: Floating, theta_c: Floating
) -> Angles:
    """Run Newton's method on all designs; those that have converged leave the set.

    Parameters
    ----------
    ring, arcs : ScaledRing, Arcs
        n designs.
    target : {"force", "sinking", "contact_angle"}
        What is given: F/GA, δ/R or θc (radians).
    value : array, shape (n,)
        Its value.
    theta_c : array, shape (n,)
        Contact angles to start from.
    """
    angles = Angles(
        theta_c.copy(), _first_transition(ring, theta_c), np.zeros(len(theta_c), dtype=bool)
    )
    open_rows = np.arange(len(theta_c))
    for _ in range(NEWTON_STEPS):
        here_c, here_t = angles.contact[open_rows], angles.transition[open_rows]
        joined = join_regions(ring, arcs, here_c, here_t)
        by_c, by_t = _step(joined, _misfit(joined, target, value))
        new_c = here_c + by_c
        angles.contact[open_rows] = new_c
        angles.transition[open_rows] = np.maximum(here_t + by_t, new_c * (1 + 1e-6))
        done = (np.abs(by_c) < STEP * here_c) & (np.abs(by_t) < STEP)
        if done.any():
            angles.found[open_rows[done]] = True
            left = np.flatnonzero(~done)
            if len(left) == 0:
                break
            open_rows, value = open_rows[left], value[left]
            ring, arcs = ring.take(left), arcs.take(left)
    return angles


def _bracketed(
    function: Callable[[Floating], tuple[Floating, Floating]],
    low: Floating,
    high: Floating,
    start: Floating,
) -> Floating:
    """Root of an increasing function on low…high: Newton's step, or half the bracket."""
    low, high, x = low.copy(), high.copy(), start.copy()
    for _ in range(BRACKET_STEPS):
        value, slope = function(x)
        low, high = np.where(value < 0, x, low), np.where(value < 0, high, x)
        rising = slope > 0
        new = x - value / np.where(rising, slope, 1.0)
        new = np.where(rising & (new > low) & (new < high), new, (low + high) / 2)
        moved = np.abs(new - x)
        x = new
        if np.all(moved <= BRACKET_STEP * x):
            break
    return x


def transition_for(ring: ScaledRing, arcs: Arcs, theta_c: Floating) -> Floating:
    """θt of given contact angles, by brackets."""

    def function(theta_t: Floating) -> tuple[Floating, Floating]:
        joined = join_regions(ring, arcs, theta_c, theta_t)
        return joined.transition[:, 0], joined.transition[:, 2]

    low, high = theta_c * (1 + 1e-6), np.full_like(theta_c, np.pi - 1e-9)
    return _bracketed(function, low, high, _first_transition(ring, theta_c))


def by_brackets(
    ring: ScaledRing, arcs: Arcs, target: Target, value: Floating
) -> tuple[Floating, Floating]:
    """Find θc and θt with nested brackets; slow but safe, for the few that need it."""
    match target:
        case "contact_angle":
            return value.copy(), transition_for(ring, arcs, value)
        case "force" | "sinking":
            low, high = np.full_like(value, 1e-9), np.full_like(value, LARGEST_CONTACT)
        case _:
            assert_never(target)

    def function(theta_c: Floating) -> tuple[Floating, Floating]:
        joined = join_regions(ring, arcs, theta_c, transition_for(ring, arcs, theta_c))
        misfit = _misfit(joined, target, value)
        return misfit[:, 0], misfit[:, 1]

    theta_c = _bracketed(function, low, high, start_angle(ring, target, value))
    return theta_c, transition_for(ring, arcs, theta_c)


def start_angle(ring: ScaledRing, target: Target, value: Floating) -> Floating:
    """Contact angle to start from for a given target."""
    match target:
        case "contact_angle":
            return value.copy()
        case "force":
            return np.minimum(first_guess(ring, value), 1.2)
        case "sinking":
            # a ring on spokes sinks by roughly a third of what it carries, in these units
            return np.minimum(first_guess(ring, 3 * value), 1.2)
        case _:
            assert_never(target)


def is_solution(joined: Joined, target: Target, value: Floating) -> Mask:
    """Whether the target is met and u_r changes its sign at θt, to rounding."""
    misfit = np.abs(_misfit(joined, target, value)[:, 0])
    crossing = np.abs(joined.transition[:, 0])
    return (misfit <= MISFIT * value) & (crossing <= MISFIT * np.abs(joined.sinking[:, 0]))
