"""The ground under an element: place of the tread's surface, traction, residual and tangent."""

from __future__ import annotations

import numpy as np

from nptcs.ring.kernel.compiled import compilable
from nptcs.ring.kernel.elementwise.places import (
    AREA_PER_LENGTH,
    COMPLIANCE,
    FRICTION,
    GROW_FACE,
    GROW_SECTION,
    GROW_SHEAR,
    HALF,
    OUTER,
    SLIP_STIFF,
    SMOOTH,
    STIFF,
    SURFACE,
    Value,
)

# tanh is 1 to rounding beyond this
RATIO_CAP = 20.0
LEAST_SHEAR_MPA = 1e-9


@compilable
def surface_point(
    w: Value, angle: Value, length: Value, m: Value, d: Value
) -> tuple[Value, Value, Value, Value]:
    """Place (x, y) of the tread's surface over an element's middle: r + reach n(ψ) + shift t(ψ).

    The core's shear moves its upper face along by c (ψ - θ) and keeps the thickness, as simple
    shear does. The tread thickens where it is shortened along the ring; the arc rises above its
    chord.

    Returns
    -------
    tuple
        x, y, reach and shift, mm.
    """
    b = angle - m[3]
    face = w[GROW_FACE] - length * length / 8.0
    radius = w[OUTER] - w[HALF] - w[SURFACE]
    reach = w[OUTER] - radius + w[GROW_SECTION] * d[2] + face * d[3] + w[GROW_SHEAR] * d[4]
    shift = w[HALF] * (m[3] - m[2]) + m[4]
    x = radius * np.sin(angle) + m[0] + reach * np.sin(b) + shift * np.cos(b)
    y = -radius * np.cos(angle) + m[1] - reach * np.cos(b) + shift * np.sin(b)
    return x, y, reach, shift


@compilable
def traction(w: Value, depth: Value, slip: Value) -> Value:
    """Pressure p and shear of the ground, and their derivatives.

    The law is that of `fe_tyre`: p = ε g²/2d up to a penetration d, ε (g - d/2) beyond; shear
    µ p tanh(ε_t s/µ p). The tread under the pressure thins by p times `compliance`.

    Returns
    -------
    tuple
        p, ∂p/∂depth, shear, ∂shear/∂slip, ∂shear/∂depth.
    """
    stiff, smooth, soft = w[STIFF], w[SMOOTH], w[COMPLIANCE]
    open_depth = np.maximum(depth, 0.0)
    # penetration g: what the compliance leaves of the depth, g + soft p(g) = depth
    bend = soft * stiff / smooth
    low = 2.0 * open_depth / (1.0 + np.sqrt(1.0 + 2.0 * bend * open_depth))
    high = (open_depth + 0.5 * soft * stiff * smooth) / (1.0 + soft * stiff)
    inside = np.where(low < smooth, low, high)
    pressure = np.where(
        inside < smooth, 0.5 * stiff * inside * inside / smooth, stiff * (inside - 0.5 * smooth)
    )
    slope = stiff * np.minimum(inside / smooth, 1.0)
    slope = slope / (1.0 + soft * slope)
    limit = np.maximum(w[FRICTION] * pressure, LEAST_SHEAR_MPA)
    ratio = np.minimum(np.maximum(w[SLIP_STIFF] * slip / limit, -RATIO_CAP), RATIO_CAP)
    level = np.tanh(ratio)
    fade = 1.0 - level * level
    # at a fixed slip, a higher pressure carries more shear
    cross = w[FRICTION] * slope * (level - ratio * fade)
    return pressure, slope, limit * level, w[SLIP_STIFF] * fade, cross


@compilable
def forces(
    w: Value,
    angle: Value,
    length: Value,
    m: Value,
    surface: Value,
    rise: Value,
    anchor: Value,
    by_x: Value,
    by_y: Value,
    turned: Value,
) -> tuple[Value, Value, Value, Value, Value]:
    """Give the forces of the ground on an element, and how they change.

    The residual is ``drag by_x - push by_y``; the tangent
    ``slide by_x by_xᵀ - cross by_x by_yᵀ + steep by_y by_yᵀ`` with ``turned`` added to the row and
    to the column of ψ.

    Parameters
    ----------
    w, angle, length, m
        As in `surface_point`.
    surface
        What `surface_point` returns.
    rise : number
        Of the ground, mm, from where it touches the unloaded tyre.
    anchor : number or array
        Place x at which the surface came to rest.
    by_x, by_y
        Set to the derivatives of the surface's place with respect to the ten variables; they must
        be zero before the first call.
    turned
        Set to the forces times the derivatives of ``by_x`` and ``by_y`` with respect to ψ, half of
        it at ψ itself; zero before the first call.

    Returns
    -------
    tuple
        push and drag (N), steep, slide and cross (N/mm).
    """
    x, y, reach, shift = surface
    pressure, steep, shear, slide, cross = traction(w, rise - w[OUTER] - y, x - anchor)
    area = w[AREA_PER_LENGTH] * length
    push, drag = area * pressure, area * shear
    tx, ty = np.cos(angle - m[3]), np.sin(angle - m[3])
    half = w[HALF]
    by_x[0] = 1.0
    by_y[1] = 1.0
    # n = (ty, -tx); the derivatives by ψ are t' = n and n' = -t
    by_x[2], by_y[2] = -half * tx, -half * ty
    by_x[3], by_y[3] = (half - reach) * tx + shift * ty, (half - reach) * ty - shift * tx
    by_x[4], by_y[4] = tx, ty
    # s carries n, the thickness -t
    turn_s, turn_reach = drag * ty + push * tx, push * ty - drag * tx
    turned[2], turned[4] = -half * turn_s, turn_s
    turned[3] = 0.5 * ((2.0 * half - reach) * turn_s - shift * (drag * tx - push * ty))
    grow_face = w[GROW_FACE] - length * length / 8.0
    for place, grow in ((7, w[GROW_SECTION]), (8, grow_face), (9, w[GROW_SHEAR])):
        by_x[place], by_y[place] = grow * ty, -grow * tx
        turned[place] = grow * turn_reach
    return push, drag, area * steep, area * slide, area * cross
