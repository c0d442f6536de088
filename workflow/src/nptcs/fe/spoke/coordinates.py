"""Coordinates of the band's motion in which the spoke's symmetry shows.

The spoke is the same after a half turn about the circumferential line at its mid-height: rim and
band change places, and the plies [+A/-A] are unchanged. Its energy depends on the place of one foot
relative to the other, which is given by

    s = |line| - height,    β = (inclination of the line) + φ/2,    φ,

where the line runs from the rim's foot to the band's and its inclination is positive along +u_θ.
The half turn takes β to -β and leaves s and φ unchanged: E(s, β, φ) = E(s, -β, φ).
"""

from __future__ import annotations

import numpy as np

from nptcs.arrays import Array

# values (n, 3), first derivatives (n, 3, 3) and second derivatives (n, 3, 3, 3), the values' axis
# after that of the points
Map = tuple[Array, Array, Array]


def coordinates_of(motion: Array, height_mm: float) -> Map:
    """Give (s, β, φ) of motions (n, 3) (u_r, u_θ, φ), and the derivatives with respect to them."""
    along, radial = motion[:, 1], height_mm + motion[:, 0]
    length = np.hypot(along, radial)
    cos, sin = radial / length, along / length
    values = np.stack(
        [length - height_mm, np.arctan2(along, radial) + motion[:, 2] / 2.0, motion[:, 2]], axis=1
    )
    first, second = np.zeros((len(motion), 3, 3)), np.zeros((len(motion), 3, 3, 3))
    first[:, 0, 0], first[:, 0, 1] = cos, sin
    first[:, 1, 0], first[:, 1, 1], first[:, 1, 2] = -sin / length, cos / length, 0.5
    first[:, 2, 2] = 1.0
    second[:, 0, 0, 0], second[:, 0, 1, 1] = sin**2 / length, cos**2 / length
    second[:, 0, 0, 1] = second[:, 0, 1, 0] = -sin * cos / length
    second[:, 1, 0, 0] = 2.0 * sin * cos / length**2
    second[:, 1, 1, 1] = -second[:, 1, 0, 0]
    second[:, 1, 0, 1] = second[:, 1, 1, 0] = (sin**2 - cos**2) / length**2
    return values, first, second


def motion_of(coordinates: Array, height_mm: float) -> Map:
    """Give (u_r, u_θ, φ) at (s, β, φ), array (n, 3), and the derivatives with respect to these."""
    length, inclination = height_mm + coordinates[:, 0], coordinates[:, 1] - coordinates[:, 2] / 2.0
    cos, sin = np.cos(inclination), np.sin(inclination)
    values = np.stack([length * cos - height_mm, length * sin, coordinates[:, 2]], axis=1)
    # derivatives of the inclination with respect to (s, β, φ)
    turn = np.array([0.0, 1.0, -0.5])
    first, second = np.zeros((len(coordinates), 3, 3)), np.zeros((len(coordinates), 3, 3, 3))
    first[:, 0, 0], first[:, 1, 0], first[:, 2, 2] = cos, sin, 1.0
    first[:, 0] -= (length * sin)[:, None] * turn
    first[:, 1] += (length * cos)[:, None] * turn
    second[:, 0] = -(length * cos)[:, None, None] * np.outer(turn, turn)
    second[:, 1] = -(length * sin)[:, None, None] * np.outer(turn, turn)
    for row, slope in ((0, -sin), (1, cos)):
        second[:, row, 0] += slope[:, None] * turn
        second[:, row, :, 0] += slope[:, None] * turn
    return values, first, second


def carried(force: Array, tangent: Array, first: Array, second: Array) -> tuple[Array, Array]:
    """Transform an energy's derivatives from the values of a map to its variables.

    Parameters
    ----------
    force, tangent : arrays (n, 3), (n, 3, 3)
        ∂E/∂values and second derivatives.
    first, second : arrays (n, 3, 3), (n, 3, 3, 3)
        Of `coordinates_of` or `motion_of`.
    """
    new_force: Array = np.einsum("ni,nij->nj", force, first)
    new_tangent: Array = np.matmul(first.swapaxes(1, 2), np.matmul(tangent, first))
    new_tangent += np.einsum("ni,nijk->njk", force, second)
    return new_force, new_tangent
