"""One iterate of the ring, compiled by numba: the formulas of `elementwise`, element by element."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numba import njit

from nptcs.arrays import Array
from nptcs.provenance import code_hash
from nptcs.ring.kernel.compiled import OPTIONS
from nptcs.ring.kernel.cyclic_elimination import eliminate
from nptcs.ring.kernel.elementwise import band, ground
from nptcs.ring.kernel.elementwise.places import ALONG, OUTER, SLIP_STIFF, UNKNOWNS, VARIABLES
from nptcs.ring.kernel.numba_spokes import add_spokes
from nptcs.ring.kernel.system import NO_FEET, FootTangent, Ring, System, empty_system


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
                    for b in range(VARIABLES):
                        tangent[a, b] += (
                            slide * by_x[a] * by_x[b] - cross * by_x[a] * by_y[b]
                        ) - row[a] * by_y[b]
                for a in range(2, VARIABLES):
                    tangent[3, a] += turned[a]
                    tangent[a, 3] += turned[a]
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

    return elements, rest


_elements, _rest = _loops(code_hash(band.__name__, ground.__name__))
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
        add_spokes(ring, u, squeezed, system)
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
