"""All three regions joined, for given contact and transition angles: eleven linear equations.

Unknowns: four modes and the rotation of the compression arc, two modes of the tension arc, the
constant C = N + M that both arcs share, and the contact region's edge moment m, horizontal force H
and sinking δ.
Equations: u, v, Φ, V, M continuous at θt (N then is), u, v, Φ, N, V, M continuous at θc.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nptcs.arrays import Floating, Rows
from nptcs.lca.linear.arc import Foundation
from nptcs.lca.linear.contact import Contact, solve_contact
from nptcs.lca.linear.scaling import ScaledRing

UNKNOWNS = 11
COMPRESSION, ROTATION, TENSION, CONSTANT = slice(0, 4), 4, slice(5, 7), 7
EDGE_MOMENT, HORIZONTAL, SINKING = 8, 9, 10
_TRANSITION_ROWS = [0, 1, 2, 4, 5]
COMPRESSION_UNKNOWNS = [0, 1, 2, 3, 4, 7]


@dataclass(frozen=True)
class Arcs:
    """Foundations of the two free arcs; they do not depend on the angles."""

    compression: Foundation
    tension: Foundation

    @classmethod
    def of(cls, ring: ScaledRing) -> Arcs:
        """Solve the characteristic equations of both arcs."""
        return cls(
            Foundation.of(ring.compression, ring.epsilon, ring.kappa2),
            Foundation.of(ring.tension, ring.epsilon, ring.kappa2),
        )

    def take(self, rows: Rows) -> Arcs:
        """Return the arcs of some rows."""
        return Arcs(self.compression.take(rows), self.tension.take(rows))


@dataclass(frozen=True)
class Joined:
    """Solution for given angles and its derivatives with respect to them; n designs.

    Parameters
    ----------
    contact_angle, transition_angle : array, shape (n,)
        θc and θt (radians).
    contact : Contact
        Solutions of the contact region.
    unknowns : array, shape (n, 11)
        Coefficients of all columns.
    sinking, force : array, shape (n, 3)
        δ/R and F/GA, each with its derivatives with respect to θc and θt.
    transition : array, shape (n, 3)
        u_r/R at θt, with the derivatives with respect to θc and θt.
    """

    contact_angle: Floating
    transition_angle: Floating
    contact: Contact
    unknowns: Floating
    sinking: Floating
    force: Floating
    transition: Floating


def compression_columns(
    arc: Foundation, theta: Floating, start: Floating, end: Floating
) -> Floating:
    """Columns of the unknowns 0…4 and 7 in the compression arc, shape ``(n, 6, 6)``."""
    columns = np.zeros((len(theta), 6, 6))
    columns[:, :, 0:2] = arc.falling(theta - start)
    columns[:, :, 2:4] = arc.growing(end - theta)
    columns[:, 1:3, 4] = 1
    columns[:, :, 5] = arc.uniform(theta - end)
    return columns


def tension_columns(arc: Foundation, theta: Floating, start: Floating) -> Floating:
    """Columns of the unknowns 5…7 in the tension arc, shape ``(n, 6, 3)``."""
    columns = np.empty((len(theta), 6, 3))
    columns[:, :, :2] = arc.symmetric(np.pi - theta, np.pi - start)
    columns[:, :, 2] = arc.uniform(theta - np.pi)
    return columns


def _assemble(
    contact: Contact, at_t: Floating, beyond: Floating, at_c: Floating
) -> tuple[Floating, Floating]:
    """Matrix and right-hand sides: the load, and unit jumps of N', V' at θc and of V' at θt."""
    n = len(at_t)
    matrix = np.zeros((n, UNKNOWNS, UNKNOWNS))
    matrix[:, :5, :5] = at_t[:, _TRANSITION_ROWS, :5]
    matrix[:, :5, 5:7] = -beyond[:, _TRANSITION_ROWS, :2]
    matrix[:, :5, 7] = at_t[:, _TRANSITION_ROWS, 5] - beyond[:, _TRANSITION_ROWS, 2]
    matrix[:, 5:, :5] = at_c[:, :, :5]
    matrix[:, 5:, 7] = at_c[:, :, 5]
    matrix[:, 5:, 8:] = -contact.edge[:, :, :3]
    right = np.zeros((n, UNKNOWNS, 4))
    right[:, 5:, 0] = contact.edge[:, :, 3]
    right[:, [8, 9, 3], [1, 2, 3]] = -1
    scale = 1 / np.abs(matrix).max(axis=2, keepdims=True)
    return matrix * scale, right * scale


def _dot(columns: Floating, coefficients: Floating) -> Floating:
    """Sum over the columns, the last axis of both."""
    return np.einsum("...c,...c->...", columns, coefficients)


def join_regions(
    ring: ScaledRing, arcs: Arcs, theta_c: Floating, theta_t: Floating, points: int | None = None
) -> Joined:
    """Solve n designs for given angles θc < θt (radians), with derivatives with respect to both.

    Moving a boundary changes only the loads, so the derivative of the solution is its response to
    a jump of N' and V' at θc, or of V' at θt; the latter is (a_j - a_k) u(θt), which is zero at
    the solution.
    """
    contact = solve_contact(ring.epsilon, ring.kappa2, theta_c, points)
    at_t = compression_columns(arcs.compression, theta_t, theta_c, theta_t)
    at_c = compression_columns(arcs.compression, theta_c, theta_c, theta_t)
    beyond = tension_columns(arcs.tension, theta_t, theta_t)
    solved = np.linalg.solve(*_assemble(contact, at_t, beyond, at_c))
    x = solved[..., 0]
    edge_u = contact.edge[:, 0, 3] + _dot(contact.edge[:, 0, :3], x[:, 8:])
    pressure = contact.pressure[:, 3] + _dot(contact.pressure[:, :3], x[:, 8:])
    state_t = np.einsum("nrc,nc->nr", at_t, x[:, COMPRESSION_UNKNOWNS])
    jump_v = ring.compression * edge_u - pressure * np.cos(theta_c)
    by_c = solved[..., 1] * (pressure * np.sin(theta_c))[:, None] + solved[..., 2] * jump_v[:, None]
    by_t = solved[..., 3] * ((ring.compression - ring.tension) * state_t[:, 0])[:, None]
    x_all = np.stack([x, by_c, by_t], axis=1)
    transition = _dot(at_t[:, None, 0], x_all[..., COMPRESSION_UNKNOWNS])
    transition[:, 2] += state_t[:, 4] + state_t[:, 1] - state_t[:, 2]
    end = contact.vertical[:, -1]
    resultant = _dot(end[:, None, :3], x_all[..., 8:])
    resultant[:, 0] += end[:, 3]
    resultant[:, 1] += pressure
    sinking = x_all[..., SINKING]
    spokes = sinking * theta_c[:, None]
    spokes[:, 1] += sinking[:, 0]
    force = 2 * (resultant + ring.compression[:, None] * spokes)
    return Joined(theta_c, theta_t, contact, x, sinking, force, transition)
