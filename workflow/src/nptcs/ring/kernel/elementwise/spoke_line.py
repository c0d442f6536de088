"""The line of a spoke: its coordinates, and the energy's derivatives by the foot's motion."""

from __future__ import annotations

import numpy as np

from nptcs.fe.spoke import coordinates as table_coordinates
from nptcs.ring.kernel.compiled import compilable
from nptcs.ring.kernel.elementwise.places import Value

unit_elongation = compilable(table_coordinates.unit_elongation)


@compilable
def coordinates(height: Value, motion: Value) -> tuple[Value, Value, Value, Value, Value, Value]:
    """Give (s, β, φ) of `fe.spoke.coordinates`, and the line's length, cosine and sine."""
    radial, along = height + motion[0], motion[1]
    length = np.sqrt(radial * radial + along * along)
    inclination = np.arctan2(along, radial) + 0.5 * motion[2]
    return length - height, inclination, motion[2], length, radial / length, along / length


@compilable
def carry_to_motion(
    length: Value, cos: Value, sin: Value, first: Value, second: Value, push: Value, stiff: Value
) -> None:
    """Transform E's derivatives from (s, β, φ), `first` (3) and `second` (3, 3), to the motion.

    Sets `push` (3) and `stiff` (3, 3).
    """
    sr, sa = cos, sin
    br, ba = -sin / length, cos / length
    push[0] = first[0] * sr + first[1] * br
    push[1] = first[0] * sa + first[1] * ba
    push[2] = 0.5 * first[1] + first[2]
    by_s = (second[0, 0] * sr + second[0, 1] * br, second[0, 0] * sa + second[0, 1] * ba)
    by_b = (second[1, 0] * sr + second[1, 1] * br, second[1, 0] * sa + second[1, 1] * ba)
    bend_s, bend_b = first[0] / length, first[1] / (length * length)
    stiff[0, 0] = sr * by_s[0] + br * by_b[0] + bend_s * sin * sin + 2.0 * bend_b * sin * cos
    stiff[1, 1] = sa * by_s[1] + ba * by_b[1] + bend_s * cos * cos - 2.0 * bend_b * sin * cos
    stiff[0, 1] = sr * by_s[1] + br * by_b[1] - bend_s * sin * cos + bend_b * (sin**2 - cos**2)
    stiff[1, 0] = stiff[0, 1]
    turn_s = 0.5 * second[0, 1] + second[0, 2]
    turn_b = 0.5 * second[1, 1] + second[1, 2]
    stiff[0, 2] = sr * turn_s + br * turn_b
    stiff[1, 2] = sa * turn_s + ba * turn_b
    stiff[2, 0] = stiff[0, 2]
    stiff[2, 1] = stiff[1, 2]
    stiff[2, 2] = 0.25 * second[1, 1] + second[1, 2] + second[2, 2]
