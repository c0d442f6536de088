"""One iterate of the ring with NumPy alone: all elements at once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg.lapack import dgbsv

from nptcs.arrays import Array, Index
from nptcs.fe.matrices.cyclic import folded_order
from nptcs.ring.kernel import elementwise
from nptcs.ring.kernel.elementwise import ALONG, OUTER, SLIP_STIFF, UNKNOWNS, VARIABLES
from nptcs.ring.kernel.system import NO_FEET, FootTangent, Ring, System, empty_system

# neighbours in folded order are two nodes apart
BAND = 3 * UNKNOWNS - 1


def assemble(ring: Ring, u: Array, rise: float, anchor: Array) -> System:
    """Residual and tangent at unknowns u (nodes, 5), the ground's rise and the anchors (nodes,)."""
    count = len(u)
    system = empty_system(ring)
    mean, difference = element_variables(ring, u)
    force = np.zeros((VARIABLES, count))
    tangent = np.zeros((VARIABLES, VARIABLES, count))
    strains = elementwise.band_strains(ring.middle, mean, difference)
    stress, stiff = _along_tangent(ring, strains[0], difference)
    elementwise.add_core_give(ring.core, strains[0], difference, stress, stiff)
    elementwise.band(ring.stiffness, ring.length_mm, mean, strains, stress, stiff, force, tangent)
    _add_ground(ring, mean, difference, rise, anchor, force, tangent, system)
    _scatter(ring, force, tangent, system)
    _add_spokes(ring, u, system)
    return system


def anchors(ring: Ring, u: Array, rise: float, anchor: Array) -> Array:
    """Place (nodes,) of each element's surface without slip; off the ground its present place."""
    w = ring.dimensions
    mean, difference = element_variables(ring, u)
    x, y, _, _ = elementwise.surface_point(w, ring.middle, ring.length_mm, mean, difference)
    pressure, _, shear, _, _ = elementwise.traction(w, rise - w[OUTER] - y, x - anchor)
    placed: Array = x - np.where(pressure > 0.0, shear / w[SLIP_STIFF], 0.0)
    return placed


def element_variables(ring: Ring, u: Array) -> tuple[Array, Array]:
    """Means m (5, elements) and differences d (5, elements) of the elements."""
    after = np.roll(u, -1, axis=0)
    return 0.5 * (u + after).T, ((after - u) / ring.length_mm[:, None]).T


def _along_tangent(ring: Ring, e: Array, difference: Array) -> tuple[Array, Array]:
    """Give derivatives (4, elements), (4, 4, elements) as `elementwise.along_tangent` sets them."""
    strains = np.concatenate([e[None], difference[2:]])
    c, h = ring.stiffness[:ALONG, :ALONG, None], ring.hardening.reshape(ALONG**2, ALONG)
    by_stretch = (h @ strains).reshape(ALONG, ALONG, -1)
    return np.einsum("ijn,jn->in", c + 0.5 * by_stretch, strains), c + by_stretch


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
    first = (both - mixed - turned + ends).transpose(2, 0, 1)
    second = (both + mixed + turned + ends).transpose(2, 0, 1)
    system.diagonal += first + np.roll(second, 1, axis=0)
    system.upper += (both + mixed - turned - ends).transpose(2, 0, 1)
    system.lower += (both - mixed + turned - ends).transpose(2, 0, 1)


@dataclass(frozen=True)
class SpokeStates:
    """Motions (3, spokes), (s, β, φ), energies, forces (3, spokes) and stiffness (3, 3, spokes)."""

    motion: Array
    coordinates: Array
    energy: Array
    push: Array
    stiff: Array

    @classmethod
    def of(cls, ring: Ring, motion: Array) -> SpokeStates:
        """Evaluate the spokes' energy."""
        s, beta, phi, length, cos, sin = elementwise.line_coordinates(ring.height_mm, motion)
        coordinates = np.stack([s, beta, phi], axis=1)
        values = ring.polynomial.evaluate(coordinates)
        # `elementwise.carry_to_motion` in fewer and larger steps
        by = np.zeros((len(s), 3, 3))
        by[:, 0, 0], by[:, 0, 1] = cos, sin
        by[:, 1, 0], by[:, 1, 1] = -sin / length, cos / length
        by[:, 1, 2], by[:, 2, 2] = 0.5, 1.0
        first = np.ascontiguousarray(values[1:4].T)
        second = values[[[4, 7, 9], [7, 5, 8], [9, 8, 6]]].transpose(2, 0, 1)
        push = (first[:, None] @ by)[:, 0].T
        stiff = (by.swapaxes(1, 2) @ second @ by).transpose(1, 2, 0)
        bend_s, bend_b, cross = values[1] / length, values[2] / length**2, sin * cos
        stiff[0, 0] += bend_s * sin**2 + 2.0 * bend_b * cross
        stiff[1, 1] += bend_s * cos**2 - 2.0 * bend_b * cross
        turn = bend_b * (sin**2 - cos**2) - bend_s * cross
        stiff[0, 1] += turn
        stiff[1, 0] += turn
        return cls(motion, coordinates, values[0], push, stiff)


def spoke_states(ring: Ring, u: Array) -> SpokeStates:
    """Evaluate all spokes; the motions of wide feet are those of the spokes under the squeeze.

    The spoke's motion z follows from that of the foot, m, by z = m - C E'(z). One step of Newton's
    method from m solves this to a millionth of the squeeze; the forces take the same linear step.
    """
    motion = np.stack(
        elementwise.foot_motion(ring.dimensions, ring.theta[ring.feet], u[ring.feet].T)
    )
    wide = ring.wide
    own = np.flatnonzero(wide.place >= 0)
    if not len(own):
        return SpokeStates.of(ring, motion)
    own = own[np.argsort(wide.place[own])]
    face = elementwise.foot_motion(
        ring.dimensions, ring.theta[wide.nodes], u[wide.nodes].transpose(2, 0, 1)
    )
    shares = elementwise.foot_share(
        np.cos(wide.angle), np.sin(wide.angle), wide.mean, wide.turn, face[0], face[1]
    )
    felt = np.stack([share.sum(axis=1) for share in shares])
    soft_r, soft_turn = ring.squeeze
    first = SpokeStates.of(ring, felt)
    moved = felt.copy()
    by_r, by_turn = elementwise.squeeze_step(
        soft_r, soft_turn, first.stiff, soft_r * first.push[0], soft_turn * first.push[2]
    )
    moved[0] -= by_r
    moved[2] -= by_turn
    motion[:, own] = moved
    found = SpokeStates.of(ring, motion)
    stiff, push = found.stiff[:, :, own], found.push[:, own]
    by_r, by_turn = elementwise.squeeze_step(
        soft_r,
        soft_turn,
        stiff,
        moved[0] - felt[0] + soft_r * push[0],
        moved[2] - felt[2] + soft_turn * push[2],
    )
    found.push[:, own] = push - stiff[:, 0] * by_r - stiff[:, 2] * by_turn
    hold = np.zeros_like(stiff)
    elementwise.squeezed_stiffness(soft_r, soft_turn, stiff, hold)
    found.stiff[:, :, own] = hold
    found.energy[own] += 0.5 * (soft_r * push[0] ** 2 + soft_turn * push[2] ** 2)
    return found


def _add_spokes(ring: Ring, u: Array, system: System) -> None:
    if not len(ring.feet):
        return
    spokes = spoke_states(ring, u)
    system.coordinates[:] = spokes.coordinates
    single = np.flatnonzero(ring.wide.place < 0)
    feet, push = ring.feet[single], spokes.push[:, single]
    lever, curvature = _levers(ring, u, feet, push)
    lift = lever.swapaxes(1, 2)
    system.force[feet] += (lift @ push.T[:, :, None])[:, :, 0]
    stiff = spokes.stiff[:, :, single].transpose(2, 0, 1)
    system.diagonal[feet] += curvature + lift @ stiff @ lever
    if len(single) < len(ring.feet):
        _add_wide_feet(ring, u, spokes, system)


def _add_wide_feet(ring: Ring, u: Array, spokes: SpokeStates, system: System) -> None:
    wide = ring.wide
    count, reach = wide.nodes.shape
    own = np.flatnonzero(wide.place >= 0)
    own = own[np.argsort(wide.place[own])]
    nodes, push = wide.nodes.ravel(), spokes.push[:, own]
    cos, sin = np.cos(wide.angle), np.sin(wide.angle)
    forces = elementwise.node_push(cos, sin, wide.mean, wide.turn, push[:, :, None])
    face = np.stack([*forces, 0.0 * forces[0]]).reshape(3, -1)
    by, curvature = _levers(ring, u, nodes, face)
    system.force[nodes] += (by.swapaxes(1, 2) @ face.T[:, :, None])[:, :, 0]
    system.diagonal[nodes] += curvature
    by = by.reshape(count, reach, 3, UNKNOWNS)
    shares = elementwise.foot_share(
        cos[:, None],
        sin[:, None],
        wide.mean[:, None],
        wide.turn[:, None],
        by[:, :, 0],
        by[:, :, 1],
    )
    system.feet.lever[:] = np.stack(shares, axis=2)
    system.feet.hold[:] = spokes.stiff[:, :, own].transpose(2, 0, 1)


def _levers(ring: Ring, u: Array, nodes: Index, push: Array) -> tuple[Array, Array]:
    """Give derivatives (n, 3, 5) of the face at nodes, and their curvature (n, 5, 5) by `push`."""
    by = np.zeros((3, UNKNOWNS, len(nodes)))
    tangent = np.zeros((UNKNOWNS, UNKNOWNS, len(nodes)))
    elementwise.foot(ring.dimensions, ring.theta[nodes], u[nodes].T, push, by, tangent)
    return by.transpose(2, 0, 1), tangent.transpose(2, 0, 1)


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


def solve(
    diagonal: Array, upper: Array, lower: Array, rhs: Array, feet: FootTangent = NO_FEET
) -> Array:
    """Solve the cyclic system for right-hand sides (nodes, 5, n).

    The wide feet are a change of low rank: with B their levers and S their stiffness,
    (A + B S Bᵀ)⁻¹ = A⁻¹ - A⁻¹ B (1 + S Bᵀ A⁻¹ B)⁻¹ S Bᵀ A⁻¹.

    Raises
    ------
    FloatingPointError
        If the matrix is singular.
    """
    wide = len(feet.nodes)
    if wide:
        sides = rhs.shape[2]
        levers = np.zeros((*rhs.shape[:2], 3 * wide))
        for own, (nodes, lever) in enumerate(zip(feet.nodes, feet.lever, strict=True)):
            levers[nodes, :, 3 * own : 3 * own + 3] = lever.swapaxes(1, 2)
        both = _solve_blocks(diagonal, upper, lower, np.concatenate([rhs, levers], axis=2))
        felt = np.einsum("wpia,wpas->wis", feet.lever, both[feet.nodes])
        held = (feet.hold @ felt).reshape(3 * wide, -1)
        forces = np.linalg.solve(np.eye(3 * wide) + held[:, sides:], held[:, :sides])
        found: Array = both[:, :, :sides] - both[:, :, sides:] @ forces
        return found
    return _solve_blocks(diagonal, upper, lower, rhs)


def _solve_blocks(diagonal: Array, upper: Array, lower: Array, rhs: Array) -> Array:
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
