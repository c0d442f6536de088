"""Energies of the ring's parts: residuals and tangents, written once for arrays and for the compiler.

Each function takes its unknowns by component: `m[3]` is ψ, a number where numba compiles the
function and calls it element by element, an array over all elements where NumPy runs it. So no
branch may depend on a value. Results are added into `force` and `tangent`, first axes as in the
unknowns.

An element's variables are the means m = (u_x, u_y, θ, ψ, s) of its two nodes' unknowns and their
differences by its length, d = (Δu_x, Δu_y, Δθ, Δψ, Δs)/L; force and tangent have ten components,
m before d. θ and ψ turn the tangent t towards the outward normal n:

    t(ψ) = (cos α, sin α),  n(ψ) = (sin α, -cos α),  α = Θ - ψ,  Θ the element's angle.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from nptcs.ring.compiled import compilable

# numbers where numba compiles, arrays where NumPy runs
Value = Any

UNKNOWNS = 5
VARIABLES = 10
# constants of a ring that the functions below read, by place
HALF, SURFACE, FOOT, OUTER, AREA_PER_LENGTH = 0, 1, 2, 3, 4
GROW_SECTION, GROW_FACE, GROW_SHEAR = 5, 6, 7
STIFF, SMOOTH, SLIP_STIFF, FRICTION, COMPLIANCE = 8, 9, 10, 11, 12
DIMENSIONS = 13
# tanh is 1 to rounding beyond this
RATIO_CAP = 20.0
LEAST_SHEAR_MPA = 1e-9


@compilable
def band_strains(angle: Value, m: Value, d: Value) -> Value:
    """Give e, q and γ of an element, and the directions t(ψ) and n(ψ)."""
    alpha = angle - m[3]
    tx, ty = np.cos(alpha), np.sin(alpha)
    gx, gy = np.cos(angle) + d[0], np.sin(angle) + d[1]
    return gx * tx + gy * ty - 1.0, gx * ty - gy * tx, m[3] - m[2], tx, ty


@compilable
def band_energy(c: Value, angle: Value, length: Value, m: Value, d: Value) -> Value:
    """Energy of an element, ½ L vᵀ C v."""
    e, q, shear, _, _ = band_strains(angle, m, d)
    v = (e, d[2], d[3], d[4])
    total = c[4, 4] * q * q + c[5, 5] * shear * shear + c[6, 6] * m[4] * m[4]
    for i in range(4):
        for j in range(4):
            total = total + c[i, j] * v[i] * v[j]
    return 0.5 * length * total


@compilable
def band(
    c: Value, angle: Value, length: Value, m: Value, d: Value, force: Value, tangent: Value
) -> None:
    """Add residual and tangent of an element of band, wires and tread."""
    e, q, shear, tx, ty = band_strains(angle, m, d)
    nx, ny = ty, -tx
    stretch = length * (c[0, 0] * e + c[0, 1] * d[2] + c[0, 2] * d[3] + c[0, 3] * d[4])
    across = length * c[4, 4] * q
    core = length * c[5, 5] * shear
    force[2] += -core
    force[3] += stretch * q - across * (1.0 + e) + core
    force[4] += length * c[6, 6] * m[4]
    force[5] += stretch * tx + across * nx
    force[6] += stretch * ty + across * ny
    for i in range(3):
        force[7 + i] += length * (
            c[i + 1, 0] * e + c[i + 1, 1] * d[2] + c[i + 1, 2] * d[3] + c[i + 1, 3] * d[4]
        )
    along, hold = length * c[0, 0], length * c[4, 4]
    tangent[2, 2] += length * c[5, 5]
    tangent[2, 3] += -length * c[5, 5]
    tangent[3, 2] += -length * c[5, 5]
    tangent[3, 3] += (
        along * q * q
        + hold * (1.0 + e) * (1.0 + e)
        - stretch * (1.0 + e)
        - across * q
        + length * c[5, 5]
    )
    tangent[4, 4] += length * c[6, 6]
    tangent[5, 5] += along * tx * tx + hold * nx * nx
    tangent[5, 6] += along * tx * ty + hold * nx * ny
    tangent[6, 5] += along * tx * ty + hold * nx * ny
    tangent[6, 6] += along * ty * ty + hold * ny * ny
    turn_x = (along * q + -across) * tx + (stretch - hold * (1.0 + e)) * nx
    turn_y = (along * q + -across) * ty + (stretch - hold * (1.0 + e)) * ny
    tangent[3, 5] += turn_x
    tangent[5, 3] += turn_x
    tangent[3, 6] += turn_y
    tangent[6, 3] += turn_y
    for i in range(3):
        link = length * c[0, i + 1]
        tangent[3, 7 + i] += link * q
        tangent[7 + i, 3] += link * q
        tangent[5, 7 + i] += link * tx
        tangent[7 + i, 5] += link * tx
        tangent[6, 7 + i] += link * ty
        tangent[7 + i, 6] += link * ty
        for j in range(3):
            tangent[7 + i, 7 + j] += length * c[i + 1, j + 1]


@compilable
def surface_point(
    w: Value, angle: Value, length: Value, m: Value, d: Value
) -> tuple[Value, Value, Value]:
    """Place (x, y) of the tread's surface over an element's middle, and its distance from the wires.

    The thickness grows as the rubber's strains along the ring shrink, less the rise of the arc
    over the chord.
    """
    a, b = angle - m[2], angle - m[3]
    face = w[GROW_FACE] - length * length / 8.0
    reach = w[SURFACE] + w[GROW_SECTION] * d[2] + face * d[3] + w[GROW_SHEAR] * d[4]
    radius = w[OUTER] - w[HALF] - w[SURFACE]
    x = radius * np.sin(angle) + m[0] + w[HALF] * np.sin(a) + reach * np.sin(b) + m[4] * np.cos(b)
    y = -radius * np.cos(angle) + m[1] - w[HALF] * np.cos(a) - reach * np.cos(b) + m[4] * np.sin(b)
    return x, y, reach


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
    # penetration g: the depth that the compliance leaves, g + soft p(g) = depth
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
def ground(
    w: Value,
    angle: Value,
    length: Value,
    m: Value,
    d: Value,
    rise: Value,
    anchor: Value,
    force: Value,
    tangent: Value,
    slope: Value,
    row: Value,
) -> tuple[Value, Value]:
    """Add the ground's part of an element that touches it.

    Parameters
    ----------
    w, angle, length, m, d
        As in `surface_point`.
    rise : number
        Of the ground, mm, from where it touches the unloaded tyre.
    anchor : number or array
        Place x at which the surface came to rest.
    force, tangent
        Added to.
    slope, row
        Set to the derivatives of the residual by the rise and of the reaction by the variables.

    Returns
    -------
    tuple
        Reaction (N) and its derivative by the rise (N/mm).
    """
    x, y, reach = surface_point(w, angle, length, m, d)
    pressure, steep, shear, slide, cross = traction(w, rise - w[OUTER] - y, x - anchor)
    area = w[AREA_PER_LENGTH] * length
    push, drag = area * pressure, area * shear
    steep, slide, cross = area * steep, area * slide, area * cross
    a, b = angle - m[2], angle - m[3]
    tx, ty = np.cos(b), np.sin(b)
    half = w[HALF]
    face = w[GROW_FACE] - length * length / 8.0
    zero, one = 0.0 * x, 1.0 + 0.0 * x
    # ψ: d/dψ of reach n + s t is -reach t + s n
    by_x = (
        one,
        zero,
        -half * np.cos(a),
        -reach * tx + m[4] * ty,
        tx,
        zero,
        zero,
        w[GROW_SECTION] * ty,
        face * ty,
        w[GROW_SHEAR] * ty,
    )
    by_y = (
        zero,
        one,
        -half * np.sin(a),
        -reach * ty - m[4] * tx,
        ty,
        zero,
        zero,
        -w[GROW_SECTION] * tx,
        -face * tx,
        -w[GROW_SHEAR] * tx,
    )
    for i in range(VARIABLES):
        force[i] += drag * by_x[i] - push * by_y[i]
        row[i] = -steep * by_y[i]
        slope[i] = row[i] + cross * by_x[i]
        for j in range(VARIABLES):
            tangent[i, j] += (
                slide * by_x[i] * by_x[j] - cross * by_x[i] * by_y[j] + steep * by_y[i] * by_y[j]
            )
    tangent[2, 2] += half * (-drag * np.sin(a) - push * np.cos(a))
    tangent[3, 3] += drag * (-reach * ty - m[4] * tx) - push * (reach * tx - m[4] * ty)
    # s carries n, the thickness -t
    turn_s = drag * ty + push * tx
    turn_reach = -drag * tx + push * ty
    tangent[3, 4] += turn_s
    tangent[4, 3] += turn_s
    tangent[3, 7] += turn_reach * w[GROW_SECTION]
    tangent[7, 3] += turn_reach * w[GROW_SECTION]
    tangent[3, 8] += turn_reach * face
    tangent[8, 3] += turn_reach * face
    tangent[3, 9] += turn_reach * w[GROW_SHEAR]
    tangent[9, 3] += turn_reach * w[GROW_SHEAR]
    return push, steep


@compilable
def foot_motion(w: Value, angle: Value, u: Value) -> tuple[Value, Value, Value]:
    """Motion (u_r, u_θ, φ) of the spoke's foot under a node with unknowns u.

    The foot is at r - c n(θ) - foot n(ψ); φ is the slope of the band's inner face.
    """
    cos, sin = np.cos(angle), np.sin(angle)
    outward = u[0] * sin - u[1] * cos
    along = u[0] * cos + u[1] * sin
    outward = outward + w[HALF] * (1.0 - np.cos(u[2])) + w[FOOT] * (1.0 - np.cos(u[3]))
    along = along + w[HALF] * np.sin(u[2]) + w[FOOT] * np.sin(u[3])
    return outward, along, np.sin(u[3])


@compilable
def foot(
    w: Value, angle: Value, u: Value, push: Value, stiff: Value, force: Value, tangent: Value
) -> None:
    """Add a spoke's forces `push` (3) and tangent `stiff` (3, 3) on (u_r, u_θ, φ) to its node."""
    cos, sin = np.cos(angle), np.sin(angle)
    half, deep = w[HALF], w[FOOT]
    # derivatives of the motion by u_x, u_y, θ, ψ
    outward = (sin, -cos, half * np.sin(u[2]), deep * np.sin(u[3]))
    along = (cos, sin, half * np.cos(u[2]), deep * np.cos(u[3]))
    turn = np.cos(u[3])
    for i in range(4):
        force[i] += push[0] * outward[i] + push[1] * along[i]
        for j in range(4):
            tangent[i, j] += (
                outward[i] * (stiff[0, 0] * outward[j] + stiff[0, 1] * along[j])
                + along[i] * (stiff[1, 0] * outward[j] + stiff[1, 1] * along[j])
            )
        link = (stiff[0, 2] * outward[i] + stiff[1, 2] * along[i]) * turn
        tangent[i, 3] += link
        tangent[3, i] += link
    force[3] += push[2] * turn
    tangent[3, 3] += stiff[2, 2] * turn * turn
    tangent[2, 2] += half * (push[0] * np.cos(u[2]) - push[1] * np.sin(u[2]))
    tangent[3, 3] += deep * (push[0] * np.cos(u[3]) - push[1] * np.sin(u[3]))
    tangent[3, 3] += -push[2] * np.sin(u[3])


@compilable
def line_coordinates(height: Value, motion: Value) -> tuple[Value, Value, Value, Value, Value, Value]:
    """Give (s, β, φ) of `fe.spoke.coordinates`, and the line's length, cosine and sine."""
    radial, along = height + motion[0], motion[1]
    length = np.sqrt(radial * radial + along * along)
    inclination = np.arctan2(along, radial) + 0.5 * motion[2]
    return length - height, inclination, motion[2], length, radial / length, along / length


@compilable
def carry_to_motion(
    length: Value, cos: Value, sin: Value, first: Value, second: Value, push: Value, stiff: Value
) -> None:
    """Carry E's derivatives by (s, β, φ), `first` (3) and `second` (3, 3), to the motion.

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
