"""One iterate of the ring with NumPy alone: all elements at once.

A call of NumPy costs more than the work on an iterate's few numbers. So what numba does number by
number, tangents above all, is written here for as few calls as possible; the rest are the formulas
of `elementwise`.
"""

from __future__ import annotations

import numpy as np

from nptcs.arrays import Array
from nptcs.ring.kernel.elementwise import band, ground
from nptcs.ring.kernel.elementwise.places import ALONG, OUTER, SLIP_STIFF, UNKNOWNS, VARIABLES
from nptcs.ring.kernel.numpy_solution import solve
from nptcs.ring.kernel.numpy_spokes import add_spokes
from nptcs.ring.kernel.system import NO_FEET, Ring, System

__all__ = ["anchors", "assemble", "element_variables", "solve"]


def assemble(
    ring: Ring, u: Array, rise: float, anchor: Array, squeezed: Array | None = None
) -> System:
    """Residual and tangent at unknowns u (nodes, 5), the ground's rise and the anchors (nodes,).

    `squeezed` is that of the iterate before, `System.squeezed`, if there is one.
    """
    mean, difference = element_variables(ring, u)
    sides, tangent = _band(ring, mean, difference)
    reaction = _add_ground(ring, mean, difference, rise, anchor, sides, tangent)
    force, slope, row = _sides_at_nodes(ring, sides)
    system = System(
        *_blocks(ring, tangent),
        force,
        slope,
        row,
        *reaction,
        coordinates=np.zeros((len(ring.feet), 3)),
        feet=NO_FEET,
        squeezed=np.zeros((0, 3)),
    )
    if len(ring.feet):
        add_spokes(ring, u, squeezed, system)
    return system


def anchors(ring: Ring, u: Array, rise: float, anchor: Array) -> Array:
    """Place (nodes,) of each element's surface without slip; off the ground its present place."""
    w = ring.dimensions
    mean, difference = element_variables(ring, u)
    x, y, _, _ = ground.surface_point(w, ring.middle, ring.length_mm, mean, difference)
    pressure, _, shear, _, _ = ground.traction(w, rise - w[OUTER] - y, x - anchor)
    placed: Array = x - np.where(pressure > 0.0, shear / w[SLIP_STIFF], 0.0)
    return placed


def element_variables(ring: Ring, u: Array) -> tuple[Array, Array]:
    """Means m (5, elements) and differences d (5, elements) of the elements."""
    before = u.T
    after = np.empty_like(before, order="C")
    after[:, :-1], after[:, -1] = before[:, 1:], before[:, 0]
    return 0.5 * (before + after), (after - before) / ring.length_mm


def _band(ring: Ring, mean: Array, difference: Array) -> tuple[Array, Array]:
    """Give the tangent (10, 10, elements) of `band.add_element`, and its sides (3, 10, elements).

    The sides are the residual, and zeros for the ground's `slope` and `row` of `System`.
    """
    c, length = ring.stiffness, ring.length_mm
    moved = band.strains(ring.middle, mean, difference)
    e, q, shear, tx, ty = moved
    stress, stiff = _along_tangent(ring, e, difference)
    # derivatives of e, q and γ with respect to (θ, ψ, s, Δu_x/L, Δu_y/L)
    by = np.zeros((3, 5, len(e)))
    by[0, 1], by[0, 3], by[0, 4] = q, tx, ty
    by[1, 1], by[1:, 3], by[1:, 4] = -1.0 - e, ty, -tx
    by[2, 0], by[2, 1] = -1.0, -e
    hold = np.empty((3, len(e)))
    hold[0], hold[1:] = length * stiff[0, 0], c[[4, 5], [4, 5], None] * length
    pull = hold * moved[:3]
    pull[0] = length * stress[0]
    link, across = length * stiff[0, 1:], pull[1] + pull[2]

    sides = np.zeros((3, VARIABLES, len(e)))
    force, tangent = sides[0], np.zeros((VARIABLES, VARIABLES, len(e)))
    force[2:7] = np.einsum("kin,kn->in", by, pull)
    force[4] = length * c[6, 6] * mean[4]
    force[7:] = length * stress[1:]
    middle = np.einsum("kin,kjn->ijn", hold[:, None] * by, by)
    middle[2, 2] = length * c[6, 6]
    bend_x, bend_y = pull[0] * ty - across * tx, -pull[0] * tx - across * ty
    middle[1, 1] -= pull[0] * (1.0 + e) + across * q
    middle[1, 3] += bend_x
    middle[3, 1] += bend_x
    middle[1, 4] += bend_y
    middle[4, 1] += bend_y
    tangent[2:7, 2:7] = middle
    tangent[2:7, 7:] = by[0][:, None] * link
    tangent[7:, 2:7] = tangent[2:7, 7:].swapaxes(0, 1)
    tangent[7:, 7:] = length * stiff[1:, 1:]
    return sides, tangent


def _along_tangent(ring: Ring, e: Array, difference: Array) -> tuple[Array, Array]:
    """Give derivatives (4, elements), (4, 4, elements) of the energy by (e, κs, κf, s').

    Those of `band.along_tangent` with `band.add_core_give`.
    """
    strains = np.empty((ALONG, len(e)))
    strains[0], strains[1:] = e, difference[2:]
    c, h = ring.stiffness[:ALONG, :ALONG, None], ring.hardening.reshape(ALONG**2, ALONG)
    by_stretch = (h @ strains).reshape(ALONG, ALONG, -1)
    stress, stiff = np.einsum("ijn,jn->in", c + 0.5 * by_stretch, strains), c + by_stretch
    pull, give, slope, curve = band.core_give(ring.core, e, difference)
    by = ring.core[:3, None]
    turn = slope * pull * by
    stress[:3] -= give * pull * by
    stiff[:3, :3] -= (by * by.T)[:, :, None] * give
    stiff[:3, 2] -= turn
    stiff[2, :3] -= turn
    square = 0.5 * pull * pull
    stress[2] -= slope * square
    stiff[2, 2] -= curve * square
    return stress, stiff


def _add_ground(
    ring: Ring,
    mean: Array,
    difference: Array,
    rise: float,
    anchor: Array,
    sides: Array,
    tangent: Array,
) -> tuple[float, float]:
    """Add the ground to `sides` and tangent; give the reaction and its derivative by the rise."""
    w = ring.dimensions
    surface = ground.surface_point(w, ring.middle, ring.length_mm, mean, difference)
    deep = rise - w[OUTER] - surface[1] > 0.0
    touching = np.flatnonzero(deep)
    if not len(touching):
        return 0.0, 0.0
    near = slice(touching[0], touching[-1] + 1)
    deep = deep[near]
    by_x, by_y, turned = np.zeros((3, VARIABLES, len(deep)))
    push, drag, steep, slide, cross = ground.forces(
        w,
        ring.middle[near],
        ring.length_mm[near],
        mean[:, near],
        [part[near] for part in surface],
        rise,
        anchor[near],
        by_x,
        by_y,
        turned,
    )
    # an element between two that touch has no pressure, and so no shear
    drag, slide = drag * deep, slide * deep
    force, slope, row = sides[:, :, near]
    force += drag * by_x - push * by_y
    row[:] = -steep * by_y
    slope[:] = row + cross * by_x
    own = tangent[:, :, near]
    own += by_x[:, None] * (slide * by_x - cross * by_y) - row[:, None] * by_y
    own[3] += turned
    own[:, 3] += turned
    return float(np.sum(push)), float(np.sum(steep))


def _sides_at_nodes(ring: Ring, sides: Array) -> Array:
    """Carry what acts on means and differences, (n, 10, elements), to the nodes: (n, nodes, 5)."""
    half, by = 0.5 * sides[:, :UNKNOWNS], sides[:, UNKNOWNS:] / ring.length_mm
    found = np.ascontiguousarray((half - by).swapaxes(1, 2))
    after = (half + by).swapaxes(1, 2)
    found[:, 1:] += after[:, :-1]
    found[:, 0] += after[:, -1]
    return found


def _blocks(ring: Ring, tangent: Array) -> tuple[Array, Array, Array]:
    """Carry the elements' tangents to the nodes: diagonal, upper and lower blocks (nodes, 5, 5)."""
    by, n = 1.0 / ring.length_mm, UNKNOWNS
    both, ends = 0.25 * tangent[:n, :n], (by * by) * tangent[n:, n:]
    mixed, back = (0.5 * by) * tangent[:n, n:], (0.5 * by) * tangent[n:, :n]
    even, odd = both + ends, mixed + back
    diagonal = _element_first(even - odd)
    after = (even + odd).transpose(2, 0, 1)
    diagonal[1:] += after[:-1]
    diagonal[0] += after[-1]
    even, odd = both - ends, mixed - back
    return diagonal, _element_first(even + odd), _element_first(even - odd)


def _element_first(part: Array) -> Array:
    return np.ascontiguousarray(part.transpose(2, 0, 1))
