"""One iterate of the ring with NumPy alone: all elements at once."""

from __future__ import annotations

import numpy as np
from scipy.linalg.lapack import dgbsv

from nptcs.arrays import Array, Index
from nptcs.fe.matrices.cyclic import folded_order
from nptcs.ring.kernel import elementwise
from nptcs.ring.kernel.elementwise import ALONG, OUTER, UNKNOWNS, VARIABLES
from nptcs.ring.kernel.system import Ring, System, empty_system

# neighbours in folded order are two nodes apart
BAND = 3 * UNKNOWNS - 1


def assemble(ring: Ring, u: Array, rise: float, anchor: Array) -> System:
    """Residual and tangent at unknowns u (nodes, 5), the ground's rise and the anchors (nodes,)."""
    count = len(u)
    system = empty_system(count, len(ring.feet))
    mean, difference = element_variables(ring, u)
    force = np.zeros((VARIABLES, count))
    tangent = np.zeros((VARIABLES, VARIABLES, count))
    elementwise.band(
        ring.stiffness,
        ring.hardening,
        ring.core,
        ring.middle,
        ring.length_mm,
        mean,
        difference,
        force,
        tangent,
        np.empty((ALONG, count)),
        np.empty((ALONG, ALONG, count)),
    )
    _add_ground(ring, mean, difference, rise, anchor, force, tangent, system)
    _scatter(ring, force, tangent, system)
    _add_spokes(ring, u, system)
    return system


def element_variables(ring: Ring, u: Array) -> tuple[Array, Array]:
    """Means m (5, elements) and differences d (5, elements) of the elements."""
    after = np.roll(u, -1, axis=0)
    return 0.5 * (u + after).T, ((after - u) / ring.length_mm[:, None]).T


def _add_ground(
    ring: Ring,
    mean: Array,
    difference: Array,
    rise: float,
    anchor: Array,
    force: Array,
    tangent: Array,
    system: System,
) -> None:
    w = ring.dimensions
    y = elementwise.surface_point(w, ring.middle, ring.length_mm, mean, difference)[1]
    near = np.flatnonzero(rise - w[OUTER] - y > 0.0)
    if not len(near):
        return
    own = tangent[:, :, near]
    by_x, by_y = np.zeros((2, VARIABLES, len(near)))
    push, drag, steep, slide, cross = elementwise.ground(
        w,
        ring.middle[near],
        ring.length_mm[near],
        mean[:, near],
        difference[:, near],
        rise,
        anchor[near],
        by_x,
        by_y,
        own,
    )
    force[:, near] += drag * by_x - push * by_y
    own += (slide * by_x)[:, None] * by_x - (cross * by_x)[:, None] * by_y
    tangent[:, :, near] = own + (steep * by_y)[:, None] * by_y
    row = -steep * by_y
    slope = row + cross * by_x
    system.reaction_n, system.reaction_slope = float(np.sum(push)), float(np.sum(steep))
    after = (near + 1) % len(ring.theta)
    for target, part in ((system.slope, slope), (system.row, row)):
        half, by = 0.5 * part[:UNKNOWNS], part[UNKNOWNS:] / ring.length_mm[near]
        target[near] += (half - by).T
        target[after] += (half + by).T


def _scatter(ring: Ring, force: Array, tangent: Array, system: System) -> None:
    """Carry means and differences to the two nodes of each element."""
    length = ring.length_mm
    half, by = 0.5 * force[:UNKNOWNS], force[UNKNOWNS:] / length
    system.force += (half - by).T + np.roll((half + by).T, 1, axis=0)
    n = UNKNOWNS
    both = 0.25 * tangent[:n, :n]
    ends = tangent[n:, n:] / length**2
    mixed, turned = 0.5 * tangent[:n, n:] / length, 0.5 * tangent[n:, :n] / length
    first = np.moveaxis(both - mixed - turned + ends, 2, 0)
    second = np.moveaxis(both + mixed + turned + ends, 2, 0)
    system.diagonal += first + np.roll(second, 1, axis=0)
    system.upper += np.moveaxis(both + mixed - turned - ends, 2, 0)
    system.lower += np.moveaxis(both - mixed + turned - ends, 2, 0)


def spoke_coordinates(ring: Ring, u: Array) -> Array:
    """(s, β, φ) of all spokes, array (spokes, 3)."""
    motion = elementwise.foot_motion(ring.dimensions, ring.theta[ring.feet], u[ring.feet].T)
    return np.stack(elementwise.line_coordinates(ring.height_mm, motion)[:3], axis=1)


def spoke_derivatives(ring: Ring, coordinates: Array) -> Array:
    """Energy and derivatives (10, spokes) as `SpokePolynomial.evaluate` gives them."""
    return ring.polynomial.evaluate(coordinates)


def _add_spokes(ring: Ring, u: Array, system: System) -> None:
    if not len(ring.feet):
        return
    angle, own = ring.theta[ring.feet], u[ring.feet].T
    motion = elementwise.foot_motion(ring.dimensions, angle, own)
    s, beta, phi, length, cos, sin = elementwise.line_coordinates(ring.height_mm, motion)
    system.coordinates[:] = np.stack([s, beta, phi], axis=1)
    values = spoke_derivatives(ring, system.coordinates)
    second = np.array(
        [
            [values[4], values[7], values[9]],
            [values[7], values[5], values[8]],
            [values[9], values[8], values[6]],
        ]
    )
    push, stiff = np.zeros((3, len(s))), np.zeros((3, 3, len(s)))
    elementwise.carry_to_motion(length, cos, sin, values[1:4], second, push, stiff)
    by = np.zeros((3, UNKNOWNS, len(s)))
    tangent = np.zeros((UNKNOWNS, UNKNOWNS, len(s)))
    elementwise.foot(ring.dimensions, angle, own, push, by, tangent)
    lever = np.moveaxis(by, 2, 0)
    lift = lever.swapaxes(1, 2)
    system.force[ring.feet] += (lift @ push.T[:, :, None])[:, :, 0]
    curvature = np.moveaxis(tangent, 2, 0)
    system.diagonal[ring.feet] += curvature + lift @ np.moveaxis(stiff, 2, 0) @ lever


_PLACES: dict[int, tuple[Index, Index]] = {}


def _places(count: int) -> tuple[Index, Index]:
    """Place of each unknown in folded order, and of each block entry in the band's storage."""
    if count not in _PLACES:
        node = folded_order(count)
        dofs = node[:, None] * UNKNOWNS + np.arange(UNKNOWNS)
        after = np.roll(dofs, -1, axis=0)
        size = count * UNKNOWNS
        places = [
            ((2 * BAND + row[:, :, None] - column[:, None, :]) * size + column[:, None, :]).ravel()
            for row, column in ((dofs, dofs), (dofs, after), (after, dofs))
        ]
        _PLACES[count] = dofs.ravel(), np.concatenate(places)
    return _PLACES[count]


def solve(diagonal: Array, upper: Array, lower: Array, rhs: Array) -> Array:
    """Solve the cyclic system for right-hand sides (nodes, 5, n).

    Raises
    ------
    FloatingPointError
        If the matrix is singular.
    """
    count = len(diagonal)
    order, place = _places(count)
    band = np.zeros((3 * BAND + 1) * count * UNKNOWNS)
    band[place] = np.concatenate([diagonal.ravel(), upper.ravel(), lower.ravel()])
    folded = np.empty((count * UNKNOWNS, rhs.shape[2]), order="F")
    folded[order] = rhs.reshape(-1, rhs.shape[2])
    _, _, solution, failed = dgbsv(
        BAND, BAND, band.reshape(-1, count * UNKNOWNS), folded, overwrite_ab=1, overwrite_b=1
    )
    if failed:
        raise FloatingPointError("the tangent is singular")
    found: Array = solution[order].reshape(rhs.shape)
    return found
