"""Energies of the ring's parts: residuals and tangents, written once for NumPy and for numba.

Each function takes its unknowns by component: `m[3]` is ψ, a number where numba compiles the
function and calls it element by element, an array over all elements where NumPy runs it. So no
branch may depend on a value. Results are added into `force` and `tangent`, first axes as in the
unknowns.

An element's variables are the means m = (u_x, u_y, θ, ψ, s) of its two nodes' unknowns and their
differences over its length, d = (Δu_x, Δu_y, Δθ, Δψ, Δs)/L; force and tangent have ten components,
m before d. θ and ψ turn the tangent t towards the outward normal n:

    t(ψ) = (cos α, sin α),  n(ψ) = (sin α, -cos α),  α = Θ - ψ,  Θ the element's angle.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from nptcs.fe.spoke import coordinates
from nptcs.ring.kernel.compiled import compilable

# numbers where numba compiles, arrays where NumPy runs
Value = Any

UNKNOWNS = 5
# number of strains that stretch the rubber along the ring
ALONG = 4
VARIABLES = 10
# places of a ring's constants that the functions below read
HALF, SURFACE, FOOT, OUTER, AREA_PER_LENGTH = 0, 1, 2, 3, 4
GROW_SECTION, GROW_FACE, GROW_SHEAR = 5, 6, 7
STIFF, SMOOTH, SLIP_STIFF, FRICTION, COMPLIANCE = 8, 9, 10, 11, 12
DIMENSIONS = 13
# places of the core's constants after the three of the wires' pull
CORE_COMPLIANCE, WIRES_STIFF, CURVATURE = 3, 4, 5
# tanh is 1 to rounding beyond this
RATIO_CAP = 20.0
LEAST_SHEAR_MPA = 1e-9

unit_elongation = compilable(coordinates.unit_elongation)


@compilable
def band_strains(angle: Value, m: Value, d: Value) -> Value:
    """Give e, q and γ of an element, and the directions t(ψ) and n(ψ)."""
    alpha = angle - m[3]
    tx, ty = np.cos(alpha), np.sin(alpha)
    gx, gy = np.cos(angle) + d[0], np.sin(angle) + d[1]
    across = gx * ty - gy * tx
    return gx * tx + gy * ty - 1.0, across, across + m[3] - m[2], tx, ty


@compilable
def band_energy(
    c: Value, h: Value, core: Value, angle: Value, length: Value, m: Value, d: Value
) -> Value:
    """Energy of an element, L (½ C_ij v_i v_j + ⅙ D_ijk v_i v_j v_k - ½ g D² of `core_give`)."""
    e, q, shear, _, _ = band_strains(angle, m, d)
    v = (e, d[2], d[3], d[4])
    total = c[4, 4] * q * q + c[5, 5] * shear * shear + c[6, 6] * m[4] * m[4]
    for i in range(ALONG):
        for j in range(ALONG):
            stiff = c[i, j] + 0.0 * e
            for k in range(ALONG):
                stiff = stiff + h[i, j, k] * v[k] / 3.0
            total = total + stiff * v[i] * v[j]
    pull, give, _, _ = core_give(core, e, d)
    return 0.5 * length * (total - give * pull * pull)


@compilable
def core_give(core: Value, e: Value, d: Value) -> Value:
    """Pull of the wires on the core's thickness, and how far the core gives way to it.

    Where the ring is bent, the outer wires are in tension and the inner ones in compression by the
    same force, or the reverse: on a circle of curvature χ = 1/R - κf they press on the core, or
    pull it apart, by χ times their force. With D = N_outer - N_inner, k the wires' stiffness and a
    the core's compliance, the core's faces move by δ = -a χ D/(1 + a k χ²), which lowers the energy
    by ½ g D², g = a χ²/(1 + a k χ²).

    Returns
    -------
    tuple
        D, g, ∂g/∂κf and ∂²g/∂κf².
    """
    pull = core[0] * e + core[1] * d[2] + core[2] * d[3]
    soft = core[CORE_COMPLIANCE]
    held = soft * core[WIRES_STIFF]
    turn = core[CURVATURE] - d[3]
    left = 1.0 / (1.0 + held * turn * turn)
    give = soft * turn * turn * left
    slope = -2.0 * soft * turn * left * left
    curve = 2.0 * soft * (1.0 - 3.0 * held * turn * turn) * left * left * left
    return pull, give, slope, curve


@compilable
def add_core_give(core: Value, e: Value, d: Value, stress: Value, stiff: Value) -> None:
    """Add the derivatives of -½ g D² with respect to (e, κs, κf, s')."""
    pull, give, slope, curve = core_give(core, e, d)
    for i in range(3):
        stress[i] += -give * pull * core[i]
        for j in range(3):
            stiff[i, j] += -give * core[i] * core[j]
        stiff[i, 2] += -slope * pull * core[i]
        stiff[2, i] += -slope * pull * core[i]
    stress[2] += -0.5 * slope * pull * pull
    stiff[2, 2] += -0.5 * curve * pull * pull


@compilable
def along_tangent(c: Value, h: Value, e: Value, d: Value, stress: Value, stiff: Value) -> None:
    """Set the derivatives (4) and (4, 4) of the energy per length with respect to (e, κs, κf, s').

    c and h are symmetric under any exchange of their indices.
    """
    for i in range(ALONG):
        stress[i] = 0.0
    for i in range(ALONG):
        own = e if i == 0 else d[i + 1]
        for j in range(i, ALONG):
            by_stretch = h[i, j, 0] * e
            for k in range(1, ALONG):
                by_stretch = by_stretch + h[i, j, k] * d[k + 1]
            stiff[i, j] = c[i, j] + by_stretch
            stiff[j, i] = stiff[i, j]
            secant = c[i, j] + 0.5 * by_stretch
            stress[i] += secant * (e if j == 0 else d[j + 1])
            if j > i:
                stress[j] += secant * own


@compilable
def band(
    c: Value,
    length: Value,
    m: Value,
    strains: Value,
    stress: Value,
    stiff: Value,
    force: Value,
    tangent: Value,
) -> None:
    """Add residual and tangent of an element of band, wires and tread.

    `strains` are those of `band_strains`; `stress` (4) and `stiff` (4, 4) those of `along_tangent`
    with `add_core_give`.
    """
    e, q, shear, tx, ty = strains
    nx, ny = ty, -tx
    stretch = length * stress[0]
    sheared = length * c[5, 5] * shear
    # the core shears by q, too: its faces are the wires' axes, not their sections
    across = length * c[4, 4] * q + sheared
    force[2] += -sheared
    force[3] += stretch * q - across * (1.0 + e) + sheared
    force[4] += length * c[6, 6] * m[4]
    force[5] += stretch * tx + across * nx
    force[6] += stretch * ty + across * ny
    for i in range(3):
        force[7 + i] += length * stress[i + 1]
    slip = length * c[5, 5]
    along, hold = length * stiff[0, 0], length * c[4, 4] + slip
    tangent[2, 2] += slip
    # q falls by (1 + e) with ψ, the core's shear by e
    tangent[2, 3] += slip * e
    tangent[3, 2] += slip * e
    tangent[3, 3] += (
        along * q * q
        + length * c[4, 4] * (1.0 + e) * (1.0 + e)
        + slip * e * e
        - stretch * (1.0 + e)
        - across * q
    )
    # the core's shear by θ and the difference
    tangent[2, 5] += -slip * nx
    tangent[5, 2] += -slip * nx
    tangent[2, 6] += -slip * ny
    tangent[6, 2] += -slip * ny
    tangent[4, 4] += length * c[6, 6]
    tangent[5, 5] += along * tx * tx + hold * nx * nx
    tangent[5, 6] += along * tx * ty + hold * nx * ny
    tangent[6, 5] += along * tx * ty + hold * nx * ny
    tangent[6, 6] += along * ty * ty + hold * ny * ny
    held = stretch - length * c[4, 4] * (1.0 + e) - slip * e
    turn_x = (along * q - across) * tx + held * nx
    turn_y = (along * q - across) * ty + held * ny
    tangent[3, 5] += turn_x
    tangent[5, 3] += turn_x
    tangent[3, 6] += turn_y
    tangent[6, 3] += turn_y
    for i in range(3):
        link = length * stiff[0, i + 1]
        tangent[3, 7 + i] += link * q
        tangent[7 + i, 3] += link * q
        tangent[5, 7 + i] += link * tx
        tangent[7 + i, 5] += link * tx
        tangent[6, 7 + i] += link * ty
        tangent[7 + i, 6] += link * ty
        for j in range(3):
            tangent[7 + i, 7 + j] += length * stiff[i + 1, j + 1]


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
def ground(
    w: Value,
    angle: Value,
    length: Value,
    m: Value,
    d: Value,
    rise: Value,
    anchor: Value,
    by_x: Value,
    by_y: Value,
    tangent: Value,
) -> tuple[Value, Value, Value, Value, Value]:
    """Add the curvature of the surface's place to the tangent of an element on the ground.

    Its residual is ``drag by_x - push by_y``; to the tangent the caller adds
    ``slide by_x by_xᵀ - cross by_x by_yᵀ + steep by_y by_yᵀ``.

    Parameters
    ----------
    w, angle, length, m, d
        As in `surface_point`.
    rise : number
        Of the ground, mm, from where it touches the unloaded tyre.
    anchor : number or array
        Place x at which the surface came to rest.
    by_x, by_y
        Set to the derivatives of the surface's place with respect to the ten variables.
    tangent
        Added to.

    Returns
    -------
    tuple
        push and drag (N), steep, slide and cross (N/mm).
    """
    x, y, reach, shift = surface_point(w, angle, length, m, d)
    pressure, steep, shear, slide, cross = traction(w, rise - w[OUTER] - y, x - anchor)
    area = w[AREA_PER_LENGTH] * length
    push, drag = area * pressure, area * shear
    tx, ty = np.cos(angle - m[3]), np.sin(angle - m[3])
    half = w[HALF]
    grow_face = w[GROW_FACE] - length * length / 8.0
    for i in range(VARIABLES):
        by_x[i] = 0.0
        by_y[i] = 0.0
    by_x[0] = 1.0
    by_y[1] = 1.0
    # n = (ty, -tx); the derivatives by ψ are t' = n and n' = -t
    by_x[2], by_y[2] = -half * tx, -half * ty
    by_x[3], by_y[3] = (half - reach) * tx + shift * ty, (half - reach) * ty - shift * tx
    by_x[4], by_y[4] = tx, ty
    by_x[7], by_y[7] = w[GROW_SECTION] * ty, -w[GROW_SECTION] * tx
    by_x[8], by_y[8] = grow_face * ty, -grow_face * tx
    by_x[9], by_y[9] = w[GROW_SHEAR] * ty, -w[GROW_SHEAR] * tx
    tangent[3, 3] += drag * ((2.0 * half - reach) * ty - shift * tx)
    tangent[3, 3] += -push * ((reach - 2.0 * half) * tx - shift * ty)
    turn_section = -half * (drag * ty + push * tx)
    tangent[2, 3] += turn_section
    tangent[3, 2] += turn_section
    # s carries n, the thickness -t
    turn_s = drag * ty + push * tx
    turn_reach = -drag * tx + push * ty
    tangent[3, 4] += turn_s
    tangent[4, 3] += turn_s
    tangent[3, 7] += turn_reach * w[GROW_SECTION]
    tangent[7, 3] += turn_reach * w[GROW_SECTION]
    tangent[3, 8] += turn_reach * grow_face
    tangent[8, 3] += turn_reach * grow_face
    tangent[3, 9] += turn_reach * w[GROW_SHEAR]
    tangent[9, 3] += turn_reach * w[GROW_SHEAR]
    return push, drag, area * steep, area * slide, area * cross


@compilable
def foot_motion(w: Value, angle: Value, u: Value) -> tuple[Value, Value, Value]:
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
def foot(w: Value, angle: Value, u: Value, push: Value, by: Value, tangent: Value) -> None:
    """Add the curvature of a foot's motion to its node's tangent.

    Parameters
    ----------
    w, angle, u
        As in `foot_motion`.
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


@compilable
def foot_share(
    cos: Value, sin: Value, mean: Value, turn: Value, outward: Value, along: Value
) -> tuple[Value, Value, Value]:
    """Contribution of a node's motion to (u_r, u_θ, φ) of the wide foot that covers it.

    Parameters
    ----------
    cos, sin
        Of the node's angle from the foot's middle.
    mean, turn
        Weights of `ring.feet.WideFeet`.
    outward, along
        Of the band's face at the node, in the node's own directions; or their derivatives.
    """
    radial = cos * outward - sin * along
    return mean * radial, mean * (sin * outward + cos * along), turn * radial


@compilable
def node_push(cos: Value, sin: Value, mean: Value, turn: Value, push: Value) -> tuple[Value, Value]:
    """Give a node's part, outward and along in its own directions, of a wide foot's forces."""
    radial, level = mean * push[0] + turn * push[2], mean * push[1]
    return cos * radial + sin * level, cos * level - sin * radial


@compilable
def squeeze_step(
    soft_r: Value, soft_turn: Value, stiff: Value, gap_r: Value, gap_turn: Value
) -> tuple[Value, Value]:
    """Solve (1 + C K) x = gap for u_r and φ; C has the squeeze of the band under a foot."""
    a, b = 1.0 + soft_r * stiff[0, 0], soft_r * stiff[0, 2]
    c, d = soft_turn * stiff[2, 0], 1.0 + soft_turn * stiff[2, 2]
    inverse = 1.0 / (a * d - b * c)
    return inverse * (d * gap_r - b * gap_turn), inverse * (a * gap_turn - c * gap_r)


@compilable
def squeezed_stiffness(soft_r: Value, soft_turn: Value, stiff: Value, hold: Value) -> None:
    """Set `hold` (3, 3) to K (1 + C K)⁻¹, K the stiffness of a spoke."""
    for j in range(3):
        by_r, by_turn = squeeze_step(
            soft_r, soft_turn, stiff, soft_r * stiff[0, j], soft_turn * stiff[2, j]
        )
        for i in range(3):
            hold[i, j] = stiff[i, j] - stiff[i, 0] * by_r - stiff[i, 2] * by_turn


@compilable
def line_coordinates(
    height: Value, motion: Value
) -> tuple[Value, Value, Value, Value, Value, Value]:
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
