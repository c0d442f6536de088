"""The spokes of an iterate with NumPy: all spokes at once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nptcs.arrays import Array
from nptcs.ring.kernel.elementwise import foot, spoke_line
from nptcs.ring.kernel.elementwise.places import UNKNOWNS
from nptcs.ring.kernel.system import FootTangent, Ring, System

# second derivatives by (s, β, φ) among those of `SpokePolynomial.evaluate`
SECOND = np.array([[4, 7, 9], [7, 5, 8], [9, 8, 6]])


@dataclass(frozen=True)
class SpokeStates:
    """Motions (3, spokes), (s, β, φ), energies, forces (3, spokes) and stiffness (spokes, 3, 3)."""

    motion: Array
    coordinates: Array
    energy: Array
    push: Array
    stiff: Array

    @classmethod
    def of(cls, ring: Ring, motion: Array) -> SpokeStates:
        """Evaluate the spokes' energy."""
        s, beta, phi, length, cos, sin = spoke_line.coordinates(ring.height_mm, motion)
        coordinates = np.empty((len(s), 3))
        coordinates[:, 0], coordinates[:, 1], coordinates[:, 2] = s, beta, phi
        values = ring.polynomial.evaluate(coordinates)
        # `spoke_line.carry_to_motion` in fewer and larger steps
        by = np.zeros((len(s), 3, 3))
        by[:, 0, 0], by[:, 0, 1] = cos, sin
        by[:, 1, 0], by[:, 1, 1] = -sin / length, cos / length
        by[:, 1, 2], by[:, 2, 2] = 0.5, 1.0
        second = values[SECOND].transpose(2, 0, 1)
        push = (values[1:4].T[:, None] @ by)[:, 0].T
        stiff = by.swapaxes(1, 2) @ second @ by
        bend_s, bend_b = values[1] / length, values[2] / length**2
        sin_sin, sin_cos, cos_cos = sin * sin, sin * cos, cos * cos
        twist = 2.0 * bend_b * sin_cos
        stiff[:, 0, 0] += bend_s * sin_sin + twist
        stiff[:, 1, 1] += bend_s * cos_cos - twist
        turn = bend_b * (sin_sin - cos_cos) - bend_s * sin_cos
        stiff[:, 0, 1] += turn
        stiff[:, 1, 0] += turn
        return cls(motion, coordinates, values[0], push, stiff)


def spoke_states(ring: Ring, u: Array) -> SpokeStates:
    """Evaluate all spokes; the motions of wide feet are those of the spokes under the squeeze."""
    faces = ring.faces
    return _states(ring, foot.motion(ring.dimensions, faces.angle, u[faces.nodes].T))[0]


def _states(
    ring: Ring, face: tuple[Array, Array, Array], squeezed: Array | None = None
) -> tuple[SpokeStates, Array]:
    """Evaluate the spokes at motions of the band's face over `Ring.faces`; give the squeeze, too.

    The motion z of a spoke with a wide foot follows from that of the foot, m, by z = m - C E'(z).
    Newton's method starts from the squeeze m - z of the iterate before or, without one, from a
    step at z = m, which finds the squeeze to a millionth; the forces take the last step, too.
    """
    single, wide = ring.faces.single, ring.faces.wide
    moved = np.stack(face)
    motion = np.empty((3, len(ring.feet)))
    motion[:, single] = moved[:, : len(single)]
    if not len(wide):
        return SpokeStates.of(ring, motion), np.zeros((0, 3))
    covered = moved[:2, len(single) :].reshape(2, *ring.wide.nodes.shape)
    felt = np.einsum("pic,cwp->wi", ring.wide.share, covered)
    soft = np.array([ring.squeeze[0], 0.0, ring.squeeze[1]])
    if squeezed is None:
        first = SpokeStates.of(ring, felt.T)
        gap = soft * first.push.T
        squeezed = (_softened(soft, first.stiff) @ gap[:, :, None])[:, :, 0]
    motion[:, wide] = (felt - squeezed).T
    found = SpokeStates.of(ring, motion)
    stiff, push = found.stiff[wide], found.push[:, wide].T
    softened = _softened(soft, stiff)
    more = softened @ (soft * push - squeezed)[:, :, None]
    found.energy[wide] += 0.5 * (push**2 @ soft)
    found.push[:, wide] = (push - (stiff @ more)[:, :, 0]).T
    found.stiff[wide] = stiff @ softened
    return found, squeezed + more[:, :, 0]


def _softened(soft: Array, stiff: Array) -> Array:
    """(1 + C K)⁻¹ of each spoke; C has the squeeze of the band, K is the spoke's stiffness."""
    found: Array = np.eye(3) + soft[:, None] * stiff
    found[:] = np.linalg.inv(found)
    return found


def add_spokes(ring: Ring, u: Array, squeezed: Array | None, system: System) -> None:
    """Add all spokes to residual and tangent; set their coordinates, wide feet and squeeze."""
    faces, share = ring.faces, ring.wide.share
    at, count, single = u[faces.nodes].T, len(faces.nodes), len(faces.single)
    face = foot.motion(ring.dimensions, faces.angle, at)
    spokes, system.squeezed = _states(ring, face, squeezed)
    system.coordinates = spokes.coordinates
    push = np.zeros((3, count))
    push[:, :single] = spokes.push[:, faces.single]
    push[:2, single:] = np.einsum("pic,iw->cwp", share, spokes.push[:, faces.wide]).reshape(2, -1)
    by, tangent = np.zeros((count, 3, UNKNOWNS)), np.zeros((count, UNKNOWNS, UNKNOWNS))
    foot.lever(
        ring.dimensions, faces.angle, at, push, by.transpose(1, 2, 0), tangent.transpose(1, 2, 0)
    )
    own, covered = by[:single], by[single:].reshape(*ring.wide.nodes.shape, 3, UNKNOWNS)
    tangent[:single] += own.swapaxes(1, 2) @ spokes.stiff[faces.single] @ own
    system.force[faces.nodes] += (push.T[:, None] @ by)[:, 0]
    system.diagonal[faces.nodes] += tangent
    lever = np.einsum("pic,wpca->wpia", share, covered[:, :, :2])
    system.feet = FootTangent(ring.wide.nodes, lever, spokes.stiff[faces.wide])
