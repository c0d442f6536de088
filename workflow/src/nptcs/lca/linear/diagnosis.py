"""Whether a solution is valid: vertical balance, and the model's own assumptions about signs."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from nptcs.arrays import Floating
from nptcs.lca.linear.fields import ground_pressure, radial_displacements
from nptcs.lca.linear.scaling import ScaledRing
from nptcs.lca.linear.system import SINKING, Arcs, Joined

_COMPRESSION_POINTS, _TENSION_POINTS = 20, 48
_SIGN_TOLERANCE = 1e-9
LARGEST_RESIDUAL = 1e-9
"""Largest misfit of the vertical balance, relative to the load, in a solution."""


@dataclass(frozen=True)
class Diagnosis:
    """Checks of n solved designs; each field has shape ``(n,)``.

    Parameters
    ----------
    balance_residual : array
        Force of the ground on the ring less the vertical sum of the spoke forces outside the
        contact region, over the whole force.
    tension_in_compression : array
        Largest elongation of a spoke that the model takes as compressed, over δ.
    compression_in_tension : array
        Largest shortening of a spoke that the model takes as stretched, over δ.
    lowest_pressure : array
        Lowest contact pressure, ring and spokes together, over the mean one.
    """

    balance_residual: Floating
    tension_in_compression: Floating
    compression_in_tension: Floating
    lowest_pressure: Floating


def diagnose(ring: ScaledRing, arcs: Arcs, joined: Joined) -> Diagnosis:
    """Check n solved designs by Gauss quadrature of the spoke forces."""
    theta_c, theta_t = joined.contact_angle, joined.transition_angle
    near, near_weights = _gauss(theta_c, theta_t, _COMPRESSION_POINTS)
    far, far_weights = _gauss(theta_t, np.full_like(theta_t, np.pi), _TENSION_POINTS)
    u_near, u_far = radial_displacements(arcs, joined, near, far)
    spokes = ring.compression * np.sum(near_weights * u_near * np.cos(near), axis=1)
    spokes += ring.tension * np.sum(far_weights * u_far * np.cos(far), axis=1)
    sinking, force = joined.unknowns[:, SINKING], joined.force[:, 0]
    contact_spokes = 2 * ring.compression * sinking * theta_c
    residual = (force - contact_spokes + 2 * spokes) / force
    pressure = ground_pressure(joined).min(axis=1) + ring.compression * sinking
    return Diagnosis(
        residual,
        np.maximum(u_near.max(axis=1) / sinking, 0),
        np.maximum(-u_far.min(axis=1) / sinking, 0),
        pressure * 2 * theta_c / force,
    )


def _gauss(start: Floating, end: Floating, points: int) -> tuple[Floating, Floating]:
    """Gauss points and weights on start…end, shapes (n, points)."""
    nodes, weights = _unit_gauss(points)
    half = ((end - start) / 2)[:, None]
    return start[:, None] + half * (nodes + 1), half * weights


@lru_cache(maxsize=4)
def _unit_gauss(points: int) -> tuple[Floating, Floating]:
    """Gauss points and weights on -1…1."""
    nodes, weights = np.polynomial.legendre.leggauss(points)
    return nodes, weights


def doubts(diagnosis: Diagnosis) -> list[str]:
    """One text per design: which assumption of the model its solution breaks; empty if none."""
    texts = [""] * len(diagnosis.balance_residual)
    checks = (
        (
            diagnosis.tension_in_compression > _SIGN_TOLERANCE,
            diagnosis.tension_in_compression,
            "spokes taken as compressed are stretched by up to {:.2g} of the displacement",
        ),
        (
            diagnosis.compression_in_tension > _SIGN_TOLERANCE,
            diagnosis.compression_in_tension,
            "spokes taken as stretched are compressed by up to {:.2g} of the displacement",
        ),
        (
            diagnosis.lowest_pressure < 0,
            diagnosis.lowest_pressure,
            "the ground would have to pull: lowest contact pressure {:.2g} of the mean",
        ),
    )
    for broken, amount, text in checks:
        for row in np.flatnonzero(broken):
            texts[row] += ("; " if texts[row] else "") + text.format(amount[row])
    return texts
