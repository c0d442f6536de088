"""Band, wires and tread: strains, energy, residual and tangent of an element."""

from __future__ import annotations

import numpy as np

from nptcs.ring.kernel.compiled import compilable
from nptcs.ring.kernel.elementwise.places import (
    ALONG,
    CORE_COMPLIANCE,
    CURVATURE,
    WIRES_STIFF,
    Value,
)


@compilable
def strains(angle: Value, m: Value, d: Value) -> Value:
    """Give e, q and γ of an element, and the directions t(ψ) and n(ψ)."""
    alpha = angle - m[3]
    tx, ty = np.cos(alpha), np.sin(alpha)
    gx, gy = np.cos(angle) + d[0], np.sin(angle) + d[1]
    across = gx * ty - gy * tx
    return gx * tx + gy * ty - 1.0, across, across + m[3] - m[2], tx, ty


@compilable
def energy(
    c: Value, h: Value, core: Value, angle: Value, length: Value, m: Value, d: Value
) -> Value:
    """Energy of an element, L (½ C_ij v_i v_j + ⅙ D_ijk v_i v_j v_k - ½ g D² of `core_give`)."""
    e, q, shear, _, _ = strains(angle, m, d)
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
    turn = core[CURVATURE] - d[3]
    square = turn * turn
    held = soft * core[WIRES_STIFF] * square
    left = 1.0 / (1.0 + held)
    twice = 2.0 * soft * left * left
    give, slope, curve = soft * square * left, -twice * turn, twice * left * (1.0 - 3.0 * held)
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
def add_element(
    c: Value,
    length: Value,
    m: Value,
    moved: Value,
    stress: Value,
    stiff: Value,
    force: Value,
    tangent: Value,
) -> None:
    """Add residual and tangent of an element of band, wires and tread.

    `moved` are the strains of `strains`; `stress` (4) and `stiff` (4, 4) those of `along_tangent`
    with `add_core_give`.
    """
    e, q, shear, tx, ty = moved
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
