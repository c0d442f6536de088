"""A spoke's foot: the motion of the band's inner face over a node."""

from __future__ import annotations

import numpy as np

from nptcs.ring.kernel.compiled import compilable
from nptcs.ring.kernel.elementwise.places import FOOT, HALF, Value


@compilable
def motion(w: Value, angle: Value, u: Value) -> tuple[Value, Value, Value]:
    """Motion (u_r, u_θ, φ) of the spoke's foot under a node with unknowns u.

    The foot is at r - (c + foot) n(ψ) - c (ψ - θ) t(ψ); φ is the slope of the band's inner face.
    """
    cos, sin = np.cos(angle), np.sin(angle)
    cos_face, sin_face = np.cos(u[3]), np.sin(u[3])
    whole, shift = w[HALF] + w[FOOT], w[HALF] * (u[3] - u[2])
    outward = u[0] * sin - u[1] * cos + whole * (1.0 - cos_face) - shift * sin_face
    along = u[0] * cos + u[1] * sin + whole * sin_face - shift * cos_face
    return outward, along, sin_face


@compilable
def lever(w: Value, angle: Value, u: Value, push: Value, by: Value, tangent: Value) -> None:
    """Add the curvature of a foot's motion to its node's tangent.

    Parameters
    ----------
    w, angle, u
        As in `motion`.
    push : (3,)
        The spoke's forces on (u_r, u_θ, φ).
    by : (3, 5)
        Set to the derivatives of (u_r, u_θ, φ) with respect to u; it must be zero before the call.
    tangent : (5, 5)
        Added to.
    """
    cos, sin = np.cos(angle), np.sin(angle)
    half, deep = w[HALF], w[FOOT]
    cos_face, sin_face = np.cos(u[3]), np.sin(u[3])
    shift = half * (u[3] - u[2])
    by[0, 0], by[0, 1], by[0, 2] = sin, -cos, half * sin_face
    by[1, 0], by[1, 1], by[1, 2] = cos, sin, half * cos_face
    by[0, 3] = deep * sin_face - shift * cos_face
    by[1, 3] = deep * cos_face + shift * sin_face
    by[2, 3] = cos_face
    turn_section = half * (push[0] * cos_face - push[1] * sin_face)
    tangent[2, 3] += turn_section
    tangent[3, 2] += turn_section
    tangent[3, 3] += push[0] * ((deep - half) * cos_face + shift * sin_face)
    tangent[3, 3] += push[1] * ((half - deep) * sin_face + shift * cos_face)
    tangent[3, 3] += -push[2] * sin_face
