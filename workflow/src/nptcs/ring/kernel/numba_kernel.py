"""One iterate of the ring, compiled by numba: the formulas of `elementwise`, element by element."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numba import njit

from nptcs.arrays import Array
from nptcs.provenance import code_hash
from nptcs.ring.kernel.cyclic_elimination import eliminate
from nptcs.ring.kernel.elementwise import band, foot, ground, spoke_line, wide_foot
from nptcs.ring.kernel.elementwise.places import ALONG, OUTER, SLIP_STIFF, UNKNOWNS, VARIABLES
from nptcs.ring.kernel.system import NO_FEET, FootTangent, Ring, System, empty_system

OPTIONS: dict[str, Any] = {"cache": True, "nogil": True, "error_model": "numpy"}


def _loops(formulas: str) -> tuple[Callable[..., Any], ...]:
    """Compile the loops.

    numba's cache depends on the text of a function, not on that of the functions it calls: the
    hash `formulas`, which the loops close over, makes it compile again when one of these changes.
    """

    @njit(**OPTIONS)
    def elements(stiffness, hardening, core, w, middle, length, u, rise, anchor, out):  # type: ignore[no-untyped-def]
        """Add all elements, and the ground where they touch it."""
        assert formulas != ""
        diagonal, upper, lower, force_out, slope_out, row_out = out
        count = len(u)
        m, d = np.empty(UNKNOWNS), np.empty(UNKNOWNS)
        by_x, by_y, turned = np.zeros(VARIABLES), np.zeros(VARIABLES), np.zeros(VARIABLES)
        slope, row = np.empty(VARIABLES), np.empty(VARIABLES)
        force, tangent = np.empty(VARIABLES), np.empty((VARIABLES, VARIABLES))
        stress, stiff = np.empty(ALONG), np.empty((ALONG, ALONG))
        reaction, reaction_slope = 0.0, 0.0
        for i in range(count):
            after = i + 1 if i + 1 < count else 0
            by = 1.0 / length[i]
            for a in range(UNKNOWNS):
                m[a] = 0.5 * (u[i, a] + u[after, a])
                d[a] = (u[after, a] - u[i, a]) * by
            force[:] = 0.0
            tangent[:] = 0.0
            moved = band.strains(middle[i], m, d)
            band.along_tangent(stiffness, hardening, moved[0], d, stress, stiff)
            band.add_core_give(core, moved[0], d, stress, stiff)
            band.add_element(stiffness, length[i], m, moved, stress, stiff, force, tangent)
            surface = ground.surface_point(w, middle[i], length[i], m, d)
            if rise - w[OUTER] - surface[1] > 0.0:
                push, drag, steep, slide, cross = ground.forces(
                    w, middle[i], length[i], m, surface, rise, anchor[i], by_x, by_y, turned
                )
                reaction += push
                reaction_slope += steep
                for a in range(VARIABLES):
                    force[a] += drag * by_x[a] - push * by_y[a]
                    row[a] = -steep * by_y[a]
                    slope[a] = row[a] + cross * by_x[a]
                    tangent[3, a] += turned[a]
                    tangent[a, 3] += turned[a]
                    for b in range(VARIABLES):
                        tangent[a, b] += (
                            slide * by_x[a] * by_x[b] - cross * by_x[a] * by_y[b]
                        ) - row[a] * by_y[b]
                for a in range(UNKNOWNS):
                    b = a + UNKNOWNS
                    slope_out[i, a] += 0.5 * slope[a] - slope[b] * by
                    slope_out[after, a] += 0.5 * slope[a] + slope[b] * by
                    row_out[i, a] += 0.5 * row[a] - row[b] * by
                    row_out[after, a] += 0.5 * row[a] + row[b] * by
            for a in range(UNKNOWNS):
                force_out[i, a] += 0.5 * force[a] - force[a + UNKNOWNS] * by
                force_out[after, a] += 0.5 * force[a] + force[a + UNKNOWNS] * by
                for b in range(UNKNOWNS):
                    both = 0.25 * tangent[a, b]
                    ends = tangent[a + UNKNOWNS, b + UNKNOWNS] * by * by
                    mixed = 0.5 * tangent[a, b + UNKNOWNS] * by
                    back = 0.5 * tangent[a + UNKNOWNS, b] * by
                    diagonal[i, a, b] += both - mixed - back + ends
                    diagonal[after, a, b] += both + mixed + back + ends
                    upper[i, a, b] += both + mixed - back - ends
                    lower[i, a, b] += both - mixed + back - ends
        return reaction, reaction_slope

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

    @njit(**OPTIONS)
    def rest(w, middle, length, u, rise, anchor):  # type: ignore[no-untyped-def]
        """Place at which each element's surface rests."""
        assert formulas != ""
        count = len(u)
        m, d = np.empty(UNKNOWNS), np.empty(UNKNOWNS)
        placed = np.empty(count)
        for i in range(count):
            after = i + 1 if i + 1 < count else 0
            for a in range(UNKNOWNS):
                m[a] = 0.5 * (u[i, a] + u[after, a])
                d[a] = (u[after, a] - u[i, a]) / length[i]
            x, y, _, _ = ground.surface_point(w, middle[i], length[i], m, d)
            placed[i] = x
            depth = rise - w[OUTER] - y
            if depth > 0.0:
                placed[i] -= ground.traction(w, depth, x - anchor[i])[2] / w[SLIP_STIFF]
        return placed

    return elements, spokes, rest


_elements, _spokes, _rest = _loops(
    code_hash(*(module.__name__ for module in (band, foot, ground, spoke_line, wide_foot)))
)
_eliminate = njit(**OPTIONS)(eliminate)


def assemble(
    ring: Ring, u: Array, rise: float, anchor: Array, squeezed: Array | None = None
) -> System:
    """Residual and tangent at unknowns u (nodes, 5), the ground's rise and the anchors (nodes,).

    `squeezed` is that of the iterate before, `System.squeezed`, if there is one.
    """
    system = empty_system(ring)
    out = (
        system.diagonal,
        system.upper,
        system.lower,
        system.force,
        system.slope,
        system.row,
    )
    system.reaction_n, system.reaction_slope = _elements(
        ring.stiffness,
        ring.hardening,
        ring.core,
        ring.dimensions,
        ring.middle,
        ring.length_mm,
        u,
        rise,
        anchor,
        out,
    )
    if len(ring.feet):
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
    return system


def anchors(ring: Ring, u: Array, rise: float, anchor: Array) -> Array:
    """Place (nodes,) at which each element's surface rests; off the ground it is where it is."""
    placed: Array = _rest(ring.dimensions, ring.middle, ring.length_mm, u, rise, anchor)
    return placed


def solve(
    diagonal: Array, upper: Array, lower: Array, rhs: Array, feet: FootTangent = NO_FEET
) -> Array:
    """Solve the cyclic system for one or two right-hand sides (nodes, 5, n).

    Raises
    ------
    FloatingPointError
        If the matrix is singular.
    """
    found = np.zeros((len(rhs), UNKNOWNS, 2))
    found[:, :, : rhs.shape[2]] = rhs
    _eliminate(diagonal.copy(), upper, lower, found, feet.nodes, feet.lever, feet.hold)
    if not np.isfinite(found).all():
        raise FloatingPointError("the tangent is singular")
    return found[:, :, : rhs.shape[2]]
