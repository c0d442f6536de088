"""Coordinates of the band's motion in which the spoke's symmetry shows.

The spoke is the same after a half turn about the circumferential line at its mid-height: rim and
band change places, and the plies [+A/-A] are unchanged. Its energy depends on the place of one foot
relative to the other, which is given by

    s = |line| - height,    β = (inclination of the line) + φ/2,    φ,

where the line runs from the rim's foot to the band's and its inclination is positive along +u_θ.
The half turn takes β to -β and leaves s and φ unchanged: E(s, β, φ) = E(s, -β, φ).

Two straight legs that are hinged at mid-height rotate by angles proportional to √(a - s), where a
is the elongation at which they are in line: their stiffness along the line grows without bound as s
approaches a. A polynomial in s that follows this oscillates along the whole range (by 5 % of the
stiffness with degree 13 on -40 … 8 mm); one in √(a - s) does not.
"""

from __future__ import annotations

import numpy as np

from nptcs.arrays import Array

# least distance from a table's range to the elongation at which the legs are in line, as a fraction
# of the range's upper end: a spoke whose legs are steeper stretches rather than straightens
LEAST_ROOM = 0.5

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


def straight_elongation_mm(height_mm: float, leg_angle_deg: float, highest_mm: float) -> float:
    """Elongation at which the legs are in line, H (1/cos α - 1), or beyond the table's end."""
    straight = height_mm * (1.0 / float(np.cos(np.radians(leg_angle_deg))) - 1.0)
    return max(straight, (1.0 + LEAST_ROOM) * highest_mm)


def unit_elongation(
    elongation_mm: Array, limits_mm: tuple[float, float], straight_mm: float
) -> tuple[Array, Array, Array]:
    """Give x, from -1 to 1 along a range of s and linear in √(a - s), and dx/ds and d²x/ds².

    Beyond the range's upper end it continues as a parabola.

    Parameters
    ----------
    elongation_mm : array (n,)
        s.
    limits_mm : tuple of float
        Range of s.
    straight_mm : float
        a, above the range.
    """
    low, high = limits_mm
    below, above = np.sqrt(straight_mm - low), np.sqrt(straight_mm - high)
    inside = np.minimum(elongation_mm, high)
    root = np.sqrt(straight_mm - inside)
    # a difference of roots is this quotient, without cancellation
    x = 2.0 * (inside - low) / (high - low) * (below + above) / (below + root) - 1.0
    slope = (below + above) / (high - low) / root
    curve = slope / (2.0 * root**2)
    beyond = elongation_mm - inside
    return x + (slope + 0.5 * curve * beyond) * beyond, slope + curve * beyond, curve


def elongations_at(x: Array, limits_mm: tuple[float, float], straight_mm: float) -> Array:
    """Elongations (n,) in mm at values of x, see `unit_elongation`."""
    low, high = limits_mm
    below, above = np.sqrt(straight_mm - low), np.sqrt(straight_mm - high)
    part = 0.5 * (x + 1.0) * (high - low) / (below + above)
    found: Array = low + part * (2.0 * below - part)
    return found
