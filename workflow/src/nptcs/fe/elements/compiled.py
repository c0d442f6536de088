"""Forces and tangents of elements, one after another, compiled by numba.

An element's gradients come as `columns`, array (points × directions, nodes): their products with
displacements are deformations, those of their transpose with stresses are forces. The tangent is

    K_aibj = Σ_points ∂N_a/∂X_J  A_iJjL  ∂N_b/∂X_L dV,    A = ∂P/∂F,

one product of `columns` and columns weighted by the moduli for the pairs i ≤ j; the others follow
by symmetry.
"""

from __future__ import annotations

import numpy as np

from nptcs.arrays import Array, Index
from nptcs.fe.elements.kinematics import COLUMNS, ROWS
from nptcs.machine_code import compiled


@compiled
def _local(nodes: Index, displacement: Array, local: Array) -> None:
    """Displacements (nodes, dim) of an element's nodes."""
    for a in range(local.shape[0]):
        for i in range(local.shape[1]):
            local[a, i] = displacement[nodes[a], i]


@compiled
def _spread(moduli: Array, columns: Array, first: int, spread: Array) -> None:
    """Σ_L A_iJjL ∂N_b/∂X_L at a point, for pairs i ≤ j: rows first + J of spread (…, pairs, b)."""
    pairs, directions, count = moduli.shape[0], moduli.shape[1], columns.shape[1]
    one, two = columns[first], columns[first + 1]
    for k in range(directions):
        for pair in range(pairs):
            if directions == 3:
                three = columns[first + 2]
                for b in range(count):
                    spread[first + k, pair, b] = (
                        moduli[pair, k, 0] * one[b]
                        + moduli[pair, k, 1] * two[b]
                        + moduli[pair, k, 2] * three[b]
                    )
            else:
                for b in range(count):
                    spread[first + k, pair, b] = (
                        moduli[pair, k, 0] * one[b] + moduli[pair, k, 1] * two[b]
                    )


@compiled
def _add_product(product: Array, tangent: Array) -> None:
    """Add the pairs' products (a, pairs, b) to a tangent (a × dim, b × dim), and their mirrors."""
    count = product.shape[0]
    dim = tangent.shape[0] // count
    pair = 0
    for i in range(dim):
        for j in range(i, dim):
            for a in range(count):
                for b in range(count):
                    value = product[a, pair, b]
                    tangent[dim * a + i, dim * b + j] += value
                    if i < j:
                        tangent[dim * b + j, dim * a + i] += value
            pair += 1


@compiled
def _cofactors(matrix: Array, found: Array) -> float:
    """Cofactors det M M⁻ᵀ of a matrix (3, 3), and its determinant."""
    for i in range(3):
        k, m = (i + 1) % 3, (i + 2) % 3
        for j in range(3):
            n, o = (j + 1) % 3, (j + 2) % 3
            found[i, j] = matrix[k, n] * matrix[m, o] - matrix[k, o] * matrix[m, n]
    determinant: float = (
        matrix[0, 0] * found[0, 0] + matrix[0, 1] * found[0, 1] + matrix[0, 2] * found[0, 2]
    )
    return determinant


@compiled
def neo_hooke(
    c10: float, deformation: Array, pressure: float, inverse: Array
) -> tuple[float, float, float, float, float]:
    """Evaluate the law at one point (`neo_hooke.NeoHooke`): J, a, a I1/3, p J, C10 (Ī1 - 3).

    `inverse` takes G = F⁻ᵀ. Where J is not positive, only J is meaningful.
    """
    volume = _cofactors(deformation, inverse)
    if not volume > 0.0:
        return volume, 0.0, 0.0, 0.0, 0.0
    trace = 0.0
    for i in range(3):
        for j in range(3):
            inverse[i, j] /= volume
            trace += deformation[i, j] ** 2
    unit = volume ** (-2.0 / 3.0)
    scale = 2.0 * c10 * unit
    return volume, scale, scale * trace / 3.0, pressure * volume, c10 * (unit * trace - 3.0)


@compiled
def neo_hooke_at(
    c10: float, deformation: Array, pressure: Array, inverse: Array, values: Array
) -> None:
    """Evaluate the law at points (n, …): `inverse` (n, 3, 3) and its five values (5, n)."""
    for q in range(len(pressure)):
        found = neo_hooke(c10, deformation[q], pressure[q], inverse[q])
        for place in range(5):
            values[place, q] = found[place]


@compiled
def _rubber_moduli(
    f: Array, g: Array, scale: float, third: float, pull: float, moduli: Array
) -> None:
    """∂P_iJ/∂F_jL of the law for pairs i ≤ j, array (pairs, J, L); the factors carry the weight."""
    directions = moduli.shape[1]
    dim = 3 if moduli.shape[0] == 6 else 2
    cross, both, turned = -2.0 / 3.0 * scale, 2.0 / 3.0 * third + pull, third - pull
    pair = 0
    for i in range(dim):
        for j in range(i, dim):
            for k in range(directions):
                for m in range(directions):
                    moduli[pair, k, m] = (
                        cross * (f[i, k] * g[j, m] + g[i, k] * f[j, m])
                        + both * g[i, k] * g[j, m]
                        + turned * g[i, m] * g[j, k]
                    )
                if i == j:
                    moduli[pair, k, k] += scale
            pair += 1


@compiled
def rubber(
    nodes: Index,
    columns: Array,
    weight: Array,
    shape: Array,
    mass: Array,
    inverse_mass: Array,
    law: tuple[float, float],
    displacement: Array,
    pressure: Array,
    whole: bool,
    mismatch: Array,
    coupling: Array,
    lift: Array,
    force: Array,
    tangent: Array,
) -> float:
    """Energy and forces of elements of rubber, and their tangents.

    Parameters
    ----------
    nodes : array (elements, nodes)
    columns : array (elements, points × directions, nodes)
    weight : array (elements, points)
    shape : array (points, modes)
        Pressure basis.
    mass, inverse_mass : arrays (elements, modes, modes)
        ∫ ψψ dV and κ times its inverse.
    law : tuple
        C10 and κ, MPa.
    displacement : array (all nodes, dim)
    pressure : array (elements, modes)
    whole : bool
        Whether `coupling`, `lift` (elements, nodes × dim, modes) and `tangent` are filled;
        otherwise pressures are eliminated with the given `lift`.
    mismatch : array (elements, modes)
        Filled: ∫ ψ (J - 1 - p/κ) dV.
    force : array (elements, nodes, dim)
        Filled.
    tangent : array (elements, nodes × dim, nodes × dim)

    Raises
    ------
    FloatingPointError
        If a volume is not positive.
    """
    c10, bulk = law
    elements, points = weight.shape
    count, dim, modes = nodes.shape[1], displacement.shape[1], shape.shape[1]
    directions = columns.shape[1] // points
    pairs = dim * (dim + 1) // 2
    local, slope = np.empty((count, dim)), np.empty((points * directions, dim))
    pushed = np.empty((points * directions, dim))
    opening = np.empty((points * directions, dim, modes))
    moduli = np.empty((pairs, directions, directions))
    spread, product = np.empty((points * directions, pairs, count)), np.empty((count, pairs, count))
    f, g, opened = np.eye(3), np.empty((3, 3)), np.empty(modes)
    energy = 0.0
    for e in range(elements):
        _local(nodes[e], displacement, local)
        np.dot(columns[e], local, slope)
        opened[:] = 0.0
        for q in range(points):
            first, w = q * directions, weight[e, q]
            p = 0.0
            for m in range(modes):
                p += shape[q, m] * pressure[e, m]
            for k in range(directions):
                for i in range(dim):
                    f[i, k] = slope[first + k, i]
                f[k, k] += 1.0
            volume, scale, third, pull, density = neo_hooke(c10, f, p, g)
            if not volume > 0.0:
                raise FloatingPointError("an element of rubber has turned inside out")
            energy += w * density
            scale, third, pull = w * scale, w * third, w * pull
            for m in range(modes):
                opened[m] += w * (volume - 1.0) * shape[q, m]
            for k in range(directions):
                for i in range(dim):
                    pushed[first + k, i] = scale * f[i, k] + (pull - third) * g[i, k]
            if whole:
                for k in range(directions):
                    for i in range(dim):
                        for m in range(modes):
                            opening[first + k, i, m] = w * volume * g[i, k] * shape[q, m]
                _rubber_moduli(f, g, scale, third, pull, moduli)
                _spread(moduli, columns[e], first, spread)
        for m in range(modes):
            taken = 0.0
            for k in range(modes):
                taken += mass[e, m, k] * pressure[e, k] / bulk
            mismatch[e, m] = opened[m] - taken
            energy += pressure[e, m] * (opened[m] - 0.5 * taken)
        across = columns[e].T
        np.dot(across, pushed, force[e])
        if whole:
            wide = coupling[e].reshape(count, dim * modes)
            np.dot(across, opening.reshape(points * directions, dim * modes), wide)
            np.dot(coupling[e], inverse_mass[e], lift[e])
            np.dot(lift[e], coupling[e].T, tangent[e])
            flat = spread.reshape(points * directions, pairs * count)
            np.dot(across, flat, product.reshape(count, pairs * count))
            _add_product(product, tangent[e])
        for a in range(count):
            for i in range(dim):
                for m in range(modes):
                    force[e, a, i] += lift[e, dim * a + i, m] * mismatch[e, m]
    return energy


@compiled
def _strain_slopes(f: Array, active: Index, slopes: Array) -> None:
    """∂E_r/∂F_iJ of the active Green–Lagrange strains, array (i, J, active)."""
    dim, directions = slopes.shape[0], slopes.shape[1]
    for place in range(len(active)):
        row, column = ROWS[active[place]], COLUMNS[active[place]]
        for i in range(dim):
            for k in range(directions):
                value = 0.0
                if k == row:
                    value += f[i, column]
                if k == column and row != column:
                    value += f[i, row]
                slopes[i, k, place] = value


@compiled
def _strains(f: Array, active: Index, strain: Array) -> None:
    """Active Green–Lagrange strains of a deformation gradient, the shears as angles."""
    for place in range(len(active)):
        row, column = ROWS[active[place]], COLUMNS[active[place]]
        value = f[0, row] * f[0, column] + f[1, row] * f[1, column] + f[2, row] * f[2, column]
        strain[active[place]] = 0.5 * (value - 1.0) if row == column else value


@compiled
def _linear_moduli(
    slopes: Array, weight: float, stiffness: Array, carried: Array, moduli: Array
) -> None:
    """∂P_iJ/∂F_jL for pairs i ≤ j with the stress `carried` (3, 3), array (pairs, J, L)."""
    dim, directions, active = slopes.shape
    pair = 0
    for i in range(dim):
        for j in range(i, dim):
            for k in range(directions):
                for m in range(directions):
                    value = carried[k, m] if i == j else 0.0
                    for r in range(active):
                        for s in range(active):
                            value += slopes[i, k, r] * stiffness[r, s] * slopes[j, m, s]
                    moduli[pair, k, m] = weight * value
            pair += 1


@compiled
def linear(
    nodes: Index,
    columns: Array,
    weight: Array,
    stiffness: Array,
    active: Index,
    frame: Array,
    displacement: Array,
    carried: Array,
    own: bool,
    whole: bool,
    last: Array,
    strain: Array,
    force: Array,
    tangent: Array,
) -> float:
    """Energy and forces of elements of Saint-Venant–Kirchhoff material, and their tangents.

    Parameters
    ----------
    nodes : array (elements, nodes)
    columns : array (elements, points × directions, nodes)
    weight : array (elements, points)
    stiffness : array (points, active, active)
        Of the strain components that carry stress.
    active : array (active,)
        Their places in Voigt order.
    frame : array (elements, points, 3, 3)
    displacement : array (all nodes, dim)
    carried : array (elements, points, 6)
        Stresses that the last step led to.
    own : bool
        Whether `carried` is used; otherwise the stresses of the displacements are.
    whole : bool
        Whether `tangent` and `last`, the deformation gradients of this state, are filled.
    last : array (elements, points, 3, 3)
    strain : array (elements, points, 6)
        Filled where active.
    force : array (elements, nodes, dim)
        Filled.
    tangent : array (elements, nodes × dim, nodes × dim)
    """
    elements, points = weight.shape
    count, dim, strains = nodes.shape[1], displacement.shape[1], len(active)
    directions = columns.shape[1] // points
    pairs = dim * (dim + 1) // 2
    local, slope = np.empty((count, dim)), np.empty((points * directions, dim))
    pushed = np.empty((points * directions, dim))
    moduli = np.empty((pairs, directions, directions))
    spread, product = np.empty((points * directions, pairs, count)), np.empty((count, pairs, count))
    f, slopes = np.empty((3, 3)), np.empty((dim, directions, strains))
    taken, rest = np.zeros((3, 3)), np.zeros((3, 3))
    energy = 0.0
    for e in range(elements):
        _local(nodes[e], displacement, local)
        np.dot(columns[e], local, slope)
        for q in range(points):
            first, w = q * directions, weight[e, q]
            f[:] = frame[e, q]
            for k in range(directions):
                for i in range(dim):
                    f[i, k] += slope[first + k, i]
            if whole:
                last[e, q] = f
            _strains(f, active, strain[e, q])
            for r in range(strains):
                stress = 0.0
                for s in range(strains):
                    stress += stiffness[q, r, s] * strain[e, q, active[s]]
                energy += 0.5 * w * stress * strain[e, q, active[r]]
                part = carried[e, q, active[r]] if own else stress
                row, column = ROWS[active[r]], COLUMNS[active[r]]
                taken[row, column] = taken[column, row] = part
                rest[row, column] = rest[column, row] = stress - part
            for k in range(directions):
                for i in range(dim):
                    value = 0.0
                    for m in range(3):
                        value += f[i, m] * taken[m, k] + last[e, q, i, m] * rest[m, k]
                    pushed[first + k, i] = w * value
            if whole:
                _strain_slopes(f, active, slopes)
                _linear_moduli(slopes, w, stiffness[q], taken, moduli)
                _spread(moduli, columns[e], first, spread)
        across = columns[e].T
        np.dot(across, pushed, force[e])
        if whole:
            flat = spread.reshape(points * directions, pairs * count)
            np.dot(across, flat, product.reshape(count, pairs * count))
            tangent[e] = 0.0
            _add_product(product, tangent[e])
    return energy


@compiled
def added_strain(
    nodes: Index, columns: Array, active: Index, last: Array, step: Array, added: Array
) -> None:
    """Active strains (elements, points, 6) that a step adds to first order, at `last`."""
    elements, points = last.shape[0], last.shape[1]
    count, dim = nodes.shape[1], step.shape[1]
    directions = columns.shape[1] // points
    local, slope = np.empty((count, dim)), np.empty((points * directions, dim))
    slopes = np.empty((dim, directions, len(active)))
    for e in range(elements):
        _local(nodes[e], step, local)
        np.dot(columns[e], local, slope)
        for q in range(points):
            _strain_slopes(last[e, q], active, slopes)
            for r in range(len(active)):
                value = 0.0
                for i in range(dim):
                    for k in range(directions):
                        value += slopes[i, k, r] * slope[q * directions + k, i]
                added[e, q, active[r]] = value
