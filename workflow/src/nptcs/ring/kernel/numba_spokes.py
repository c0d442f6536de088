"""The spokes of an iterate, compiled by numba: spoke by spoke."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numba import njit

from nptcs.arrays import Array
from nptcs.provenance import code_hash
from nptcs.ring.kernel.compiled import OPTIONS
from nptcs.ring.kernel.elementwise import foot, spoke_line, wide_foot
from nptcs.ring.kernel.elementwise.places import UNKNOWNS
from nptcs.ring.kernel.system import Ring, System


def _loops(formulas: str) -> Callable[..., Any]:
    """Compile the loops; `formulas` as in `numba_kernel`."""

    @njit(**OPTIONS)
    def spoke(table, chains, radial, motion, point, push, stiff):  # type: ignore[no-untyped-def]
        """Set (s, β, φ), forces and stiffness of a spoke at a motion."""
        assert formulas != ""
        height, straight, low, high, coefficients, sides, degrees = table
        limits = (low[0], high[0])
        count, terms = coefficients.shape
        first, second = np.zeros(3), np.zeros((3, 3))
        s, beta, phi, length, cos, sin = spoke_line.coordinates(height, motion)
        point[0], point[1], point[2] = s, beta, phi
        for axis in range(3):
            scale = 2.0 / (high[axis] - low[axis])
            x, bend = (point[axis] - low[axis]) * scale - 1.0, 0.0
            if axis == 0:
                # the formula is written for arrays and also takes numbers
                x, scale, bend = spoke_line.unit_elongation(s, limits, straight)  # type: ignore[assignment]
            value, once, twice = chains[axis, 0], chains[axis, 1], chains[axis, 2]
            value[0], value[1] = 1.0, x
            once[0], once[1] = 0.0, scale
            twice[0], twice[1] = 0.0, bend
            for i in range(2, degrees[axis]):
                value[i] = 2.0 * x * value[i - 1] - value[i - 2]
                once[i] = 2.0 * scale * value[i - 1] + 2.0 * x * once[i - 1] - once[i - 2]
                twice[i] = (
                    2.0 * bend * value[i - 1]
                    + 4.0 * scale * once[i - 1]
                    + 2.0 * x * twice[i - 1]
                    - twice[i - 2]
                )
        radial[:] = 0.0
        for i in range(count):
            for order in range(3):
                for term in range(terms):
                    radial[order, term] += coefficients[i, term] * chains[0, order, i]
        for term in range(terms):
            r0, r1, r2 = radial[0, term], radial[1, term], radial[2, term]
            j, n = sides[term]
            b0, b1, b2 = chains[1, 0, j], chains[1, 1, j], chains[1, 2, j]
            p0, p1, p2 = chains[2, 0, n], chains[2, 1, n], chains[2, 2, n]
            first[0] += r1 * b0 * p0
            first[1] += r0 * b1 * p0
            first[2] += r0 * b0 * p1
            second[0, 0] += r2 * b0 * p0
            second[1, 1] += r0 * b2 * p0
            second[2, 2] += r0 * b0 * p2
            second[0, 1] += r1 * b1 * p0
            second[1, 2] += r0 * b1 * p1
            second[0, 2] += r1 * b0 * p1
        second[1, 0], second[2, 1], second[2, 0] = second[0, 1], second[1, 2], second[0, 2]
        spoke_line.carry_to_motion(length, cos, sin, first, second, push, stiff)

    @njit(**OPTIONS)
    def spokes(ring, wide, u, coordinates, diagonal, force, lever, hold):  # type: ignore[no-untyped-def]
        """Add all spokes."""
        assert formulas != ""
        w, theta, feet, height, straight, low, high, coefficients, sides = ring
        place, covered, share, squeeze, known, squeezed = wide
        count, terms = coefficients.shape
        degrees = (count, sides[:, 0].max() + 1, sides[:, 1].max() + 1)
        table = height, straight, low, high, coefficients, sides, degrees
        chains = np.zeros((3, 3, max(count, sides.max() + 1)))
        radial = np.empty((3, terms))
        push, felt, face = np.empty(3), np.empty(3), np.zeros(3)
        stiff = np.empty((3, 3))
        by = np.zeros((3, UNKNOWNS))
        for k in range(len(feet)):
            point = coordinates[k]
            if place[k] < 0:
                node = feet[k]
                motion = foot.motion(w, theta[node], u[node])
                spoke(table, chains, radial, motion, point, push, stiff)
                foot.lever(w, theta[node], u[node], push, by, diagonal[node])
                for a in range(UNKNOWNS):
                    for i in range(3):
                        force[node, a] += push[i] * by[i, a]
                        for j in range(3):
                            for b in range(UNKNOWNS):
                                diagonal[node, a, b] += by[i, a] * stiff[i, j] * by[j, b]
                continue
            own = place[k]
            felt[:] = 0.0
            for p in range(len(share)):
                node = covered[own, p]
                outward, along, _ = foot.motion(w, theta[node], u[node])
                for i in range(3):
                    felt[i] += share[p, i, 0] * outward + share[p, i, 1] * along
            # the spoke under the squeeze: as in `numpy_spokes.spoke_states`
            soft_r, soft_turn = squeeze
            give = squeezed[own]
            if not known:
                motion = (felt[0], felt[1], felt[2])
                spoke(table, chains, radial, motion, point, push, stiff)
                give[0], give[2] = wide_foot.squeeze_step(
                    soft_r, soft_turn, stiff, soft_r * push[0], soft_turn * push[2]
                )
            motion = (felt[0] - give[0], felt[1], felt[2] - give[2])
            spoke(table, chains, radial, motion, point, push, stiff)
            by_r, by_turn = wide_foot.squeeze_step(
                soft_r, soft_turn, stiff, soft_r * push[0] - give[0], soft_turn * push[2] - give[2]
            )
            give[0] += by_r
            give[2] += by_turn
            for i in range(3):
                push[i] -= stiff[i, 0] * by_r + stiff[i, 2] * by_turn
            wide_foot.squeezed_stiffness(soft_r, soft_turn, stiff, hold[own])
            for p in range(len(share)):
                node = covered[own, p]
                face[0], face[1] = 0.0, 0.0
                for i in range(3):
                    face[0] += share[p, i, 0] * push[i]
                    face[1] += share[p, i, 1] * push[i]
                foot.lever(w, theta[node], u[node], face, by, diagonal[node])
                for a in range(UNKNOWNS):
                    force[node, a] += face[0] * by[0, a] + face[1] * by[1, a]
                    for i in range(3):
                        lever[own, p, i, a] = share[p, i, 0] * by[0, a] + share[p, i, 1] * by[1, a]

    return spokes


_spokes = _loops(code_hash(foot.__name__, spoke_line.__name__, wide_foot.__name__))


def add_spokes(ring: Ring, u: Array, squeezed: Array | None, system: System) -> None:
    """Add all spokes to residual and tangent; set their coordinates, wide feet and squeeze."""
    spokes = (
        ring.dimensions,
        ring.theta,
        ring.feet,
        ring.height_mm,
        ring.straight_mm,
        ring.low,
        ring.high,
        ring.coefficients,
        ring.sides,
    )
    wide, known = ring.wide, squeezed is not None
    if squeezed is not None:
        system.squeezed[:] = squeezed
    _spokes(
        spokes,
        (wide.place, wide.nodes, wide.share, ring.squeeze, known, system.squeezed),
        u,
        system.coordinates,
        system.diagonal,
        system.force,
        system.feet.lever,
        system.feet.hold,
    )
