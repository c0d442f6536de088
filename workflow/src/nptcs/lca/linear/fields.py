"""State of the ring at any point of a solved design, in the scaled units of `scaling`."""

from __future__ import annotations

import numpy as np
from numpy.polynomial import chebyshev

from nptcs.arrays import Floating
from nptcs.lca.linear.contact import rule
from nptcs.lca.linear.scaling import ScaledRing
from nptcs.lca.linear.system import (
    COMPRESSION_UNKNOWNS,
    CONSTANT,
    TENSION,
    Arcs,
    Joined,
    compression_columns,
    tension_columns,
)


def compression_states(arcs: Arcs, joined: Joined, theta: Floating) -> Floating:
    """States (n, points, 6) in the compression arc at `theta` (n, points)."""
    n, points = theta.shape
    rows = np.repeat(np.arange(n), points)
    columns = compression_columns(
        arcs.compression.take(rows),
        theta.ravel(),
        joined.contact_angle[rows],
        joined.transition_angle[rows],
    )
    states = np.einsum("prc,pc->pr", columns, joined.unknowns[rows][:, COMPRESSION_UNKNOWNS])
    return states.reshape(n, points, 6)


def tension_states(arcs: Arcs, joined: Joined, theta: Floating) -> Floating:
    """States (n, points, 6) in the tension arc at `theta` (n, points)."""
    n, points = theta.shape
    rows = np.repeat(np.arange(n), points)
    columns = tension_columns(arcs.tension.take(rows), theta.ravel(), joined.transition_angle[rows])
    unknowns = joined.unknowns[rows][:, 5 : CONSTANT + 1]
    return np.einsum("prc,pc->pr", columns, unknowns).reshape(n, points, 6)


def radial_displacements(
    arcs: Arcs, joined: Joined, near: Floating, far: Floating
) -> tuple[Floating, Floating]:
    """u_r/R at angles `near` in the compression and `far` in the tension arc, (n, points) each.

    Quicker than the whole state, for checks on many points.
    """
    x = joined.unknowns
    start, end = joined.contact_angle[:, None], joined.transition_angle[:, None]
    constant = x[:, CONSTANT, None]
    u_near = arcs.compression.radial(near - start, x[:, 0:2])
    u_near += arcs.compression.radial(end - near, x[:, 2:4])
    u_near += constant * arcs.compression.constant[:, :1]
    u_far = arcs.tension.radial(far - end, x[:, TENSION] / 2)
    u_far += arcs.tension.radial(2 * np.pi - far - end, x[:, TENSION] / 2)
    u_far += constant * arcs.tension.constant[:, :1]
    return u_near, u_far


def contact_vertical(joined: Joined) -> Floating:
    """W/GA at the nodes of the contact region, shape (n, nodes)."""
    vertical = joined.contact.vertical
    return vertical[:, :, 3] + np.einsum("npc,nc->np", vertical[:, :, :3], joined.unknowns[:, 8:])


def ground_pressure(joined: Joined) -> Floating:
    """Pressure b R q/GA at the centre and at the nodes of the contact region."""
    slope = rule(joined.contact.vertical.shape[1]).slope_odd
    return np.asarray(contact_vertical(joined) @ slope.T / joined.contact_angle[:, None])


def contact_states(ring: ScaledRing, joined: Joined, theta: Floating) -> tuple[Floating, Floating]:
    """States (points, 6) and pressure b R q/GA in the contact region of a single design."""
    vertical = contact_vertical(joined)[0]
    r = rule(len(vertical))
    angle, eps, kappa2 = joined.contact_angle[0], ring.epsilon[0], ring.kappa2[0]
    m, h, delta = joined.unknowns[0, 8:]
    nodes, tau = angle * r.nodes, theta / angle
    sine, cosine = np.sin(theta), np.cos(theta)

    def integral(values: Floating, to_coefficients: Floating, times: int) -> Floating:
        coefficients = to_coefficients @ values
        for _ in range(times):
            coefficients = angle * chebyshev.chebint(coefficients, lbnd=0)
        return np.asarray(chebyshev.chebval(tau, coefficients))

    w = integral(vertical, r.to_odd, 0)
    shear = vertical * np.cos(nodes)
    centre = m - angle * (r.once_odd[-1] @ shear) - h * (1 - np.cos(angle))
    moment = centre + integral(shear, r.to_odd, 1) + h * (1 - cosine)
    phi = kappa2 * (centre * theta + integral(shear, r.to_odd, 2) + h * (theta - sine))
    slip = h * theta - integral(vertical * np.tan(nodes), r.to_even, 1)
    horizontal = np.arctanh(sine) - sine + eps * slip
    sunk = 2 * np.sin(theta / 2) ** 2 - delta
    state = [
        sunk * cosine + horizontal * sine,
        horizontal * cosine - sunk * sine,
        phi,
        h * cosine - w * sine,
        w * cosine + h * sine,
        moment,
    ]
    slope = chebyshev.chebval(tau, chebyshev.chebder(r.to_odd @ vertical)) / angle
    return np.stack(state, axis=-1), np.asarray(slope)
