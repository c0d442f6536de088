"""Groups of elements of the same kind: energy, forces and tangents of all of them at once.

Total Lagrangian, in terms of the deformation gradient F and the first Piola–Kirchhoff stress P.
Bodies of two dimensions are in plane strain (F33 = 1). The element tangent is

    K_aibj = Σ_points ∂N_a/∂X_J  A_iJjL  ∂N_b/∂X_L dV,    A = ∂P/∂F,

for plates one product of a constant matrix of gradients with a moduli-weighted one for each
element; for rubber, whose A is made of few products, products of gradients with F and F⁻ᵀ.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from nptcs.arrays import Array, Index
from nptcs.fe.elements.neo_hooke import neo_hookean

# Voigt order of strains and stresses: 11, 22, 33, 12, 23, 13, with engineering shear strains
VOIGT = np.array([[0, 3, 5], [3, 1, 4], [5, 4, 2]])
# rubber is worked on in parts whose arrays stay in a processor's cache: this halves the time when
# two processes run at once
CACHE_BYTES = 400_000
_I = np.array([0, 1, 2, 0, 1, 0])
_J = np.array([0, 1, 2, 1, 2, 2])


@dataclass
class Response:
    """What a group returns for one state: energy (N mm), forces (N) and tangents (N/mm)."""

    energy: float
    force: Array
    tangent: Array


class ElementGroup(Protocol):
    """Elements of one kind."""

    @property
    def nodes(self) -> Index:
        """Node numbers, array (elements, nodes)."""
        ...

    def respond(self, displacement: Array) -> Response:
        """Energy, forces and tangents for nodal displacements (nodes, dim)."""
        ...


def element_dofs(nodes: Index, dim: int) -> Index:
    """Degrees of freedom (elements, nodes × dim) of elements' nodes."""
    return (nodes[:, :, None] * dim + np.arange(dim)).reshape(len(nodes), -1)


def deformation_gradient(gradient: Array, displacement: Array, frame: Array | None) -> Array:
    """F = Q + Σ u_a ⊗ ∂N_a/∂X, array (elements, points, 3, 3).

    Parameters
    ----------
    gradient : array (elements, points, nodes, directions)
    displacement : array (elements, nodes, dim)
    frame : array (elements, points, 3, 3) or None
        Q: axes of the local frame in which `gradient` is given, as columns; none for the identity.
    """
    elements, points, nodes, directions = gradient.shape
    dim = displacement.shape[2]
    flat = gradient.transpose(0, 1, 3, 2).reshape(elements, -1, nodes)
    part = np.matmul(flat, displacement).reshape(elements, points, directions, dim)
    if frame is None:
        whole = np.zeros((elements, points, 3, 3))
        whole[..., [0, 1, 2], [0, 1, 2]] = 1.0
    else:
        whole = frame.copy()
    whole[..., :dim, :directions] += part.swapaxes(2, 3)
    return whole


def _by_node(gradient: Array) -> Array:
    """Gradients as (elements, nodes, points × directions): the constant factor of all products."""
    elements, _, nodes, _ = gradient.shape
    return np.ascontiguousarray(gradient.transpose(0, 2, 1, 3).reshape(elements, nodes, -1))


def _internal_force(left: Array, stress: Array) -> Array:
    """f_ai = Σ ∂N_a/∂X_J P_iJ: array (elements, nodes × dim); P carries the weights."""
    right = stress.swapaxes(2, 3).reshape(len(left), left.shape[2], -1)
    return np.matmul(left, right).reshape(len(left), -1)


def _tangent(left: Array, columns: Array, moduli: Array) -> Array:
    """K_aibj for moduli (elements, points, J, i, j, L) that carry the weights.

    `columns` are the gradients as (elements, points, directions, nodes).
    """
    elements, points, directions, nodes = columns.shape
    dim = moduli.shape[3]
    spread = np.matmul(moduli.reshape(elements, points, -1, directions), columns)
    spread = spread.reshape(elements, points * directions, dim * dim * nodes)
    product = np.matmul(left, spread).reshape(elements, nodes, dim, dim, nodes)
    return product.swapaxes(3, 4).reshape(elements, nodes * dim, nodes * dim)


def _products(gradient: Array, tensor: Array) -> Array:
    """∂N_a/∂X_J T_iJ, array (elements, points, nodes × dim)."""
    product: Array = np.matmul(gradient, tensor.swapaxes(-1, -2))
    return product.reshape(*product.shape[:2], -1)


def _add_crossed(tangent: Array, left: Array, right: Array, dim: int) -> None:
    """Add Σ left_aj right_bi to K_aibj; both (elements, points, nodes × dim)."""
    shape = (len(tangent), -1, dim, tangent.shape[2] // dim, dim)
    crossed = np.matmul(left.swapaxes(1, 2), right)
    target = tangent.reshape(shape)
    target += crossed.reshape(shape).swapaxes(2, 4)


def _add_isotropic(tangent: Array, left: Array, scale: Array, dim: int) -> None:
    """Add Σ a ∂N_a/∂X_J ∂N_b/∂X_J to K_aibi; a (elements, points × directions) weighted."""
    both = np.matmul(left * scale[:, None], left.swapaxes(1, 2))
    target = tangent.reshape(len(tangent), -1, dim, tangent.shape[2] // dim, dim)
    for i in range(dim):
        target[:, :, i, :, i] += both


def green_strain(deformation: Array) -> Array:
    """Green–Lagrange strain in Voigt order, array (…, 6)."""
    right = np.matmul(deformation.swapaxes(-1, -2), deformation)
    strain: Array = 0.5 * right[..., _I, _J]
    strain[..., :3] -= 0.5
    strain[..., 3:] *= 2.0
    return strain


@dataclass
class LinearGroup:
    """Saint-Venant–Kirchhoff material: S = C E in the local frame of each point.

    Parameters
    ----------
    nodes : array (elements, nodes)
    gradient : array (elements, points, nodes, directions)
        Derivatives with respect to the local frame's coordinates.
    weight : array (elements, points)
        Volume of each point, mm³.
    stiffness : array (points, 6, 6)
        MPa, Voigt order; rows of zeros for components that carry nothing.
    frame : array (elements, points, 3, 3) or None
        Local axes as columns.
    """

    nodes: Index
    gradient: Array
    weight: Array
    stiffness: Array
    frame: Array | None = None

    def __post_init__(self) -> None:
        self._left = _by_node(self.gradient)
        self._columns = np.ascontiguousarray(self.gradient.swapaxes(2, 3))
        directions = self.gradient.shape[3]
        material = self.stiffness[:, VOIGT[:, :, None, None], VOIGT[None, None]]
        self._material = material[:, :, :directions, :, :directions]

    def strain(self, displacement: Array) -> Array:
        """Green–Lagrange strain (elements, points, 6) in the local frame."""
        return green_strain(
            deformation_gradient(self.gradient, displacement[self.nodes], self.frame)
        )

    def respond(self, displacement: Array) -> Response:
        """Energy, forces and tangents for nodal displacements (nodes, dim)."""
        dim, directions = displacement.shape[1], self.gradient.shape[3]
        deformation = deformation_gradient(self.gradient, displacement[self.nodes], self.frame)
        strain = green_strain(deformation)
        stress = np.matmul(self.stiffness, strain[..., None])[..., 0] * self.weight[..., None]
        energy = 0.5 * float(np.sum(stress * strain))
        full = stress[..., VOIGT]
        piola = np.matmul(deformation, full)[..., :dim, :directions]
        # A_iJjL = F_iM C_MJNL F_jN + δ_ij S_JL, kept in the order J, i, j, L
        rows = deformation[..., :dim, :]
        half = np.einsum("egiM,gMJNL->egiJNL", rows, self._material)
        moduli = np.einsum("egiJNL,egjN->egJijL", half, rows, optimize=True)
        moduli *= self.weight[..., None, None, None, None]
        for i in range(dim):
            moduli[:, :, :, i, i, :] += full[..., :directions, :directions]
        tangent = _tangent(self._left, self._columns, moduli)
        return Response(energy, _internal_force(self._left, piola), tangent)


@dataclass
class RubberGroup:
    """Nearly incompressible neo-Hookean rubber, displacement and discontinuous pressure.

    Energy: ∫ C10 (Ī1 - 3) + p (J - 1) - p²/(2κ). The pressure lives in each element and is
    eliminated there (static condensation), so that only displacements reach the solver. Equation 1
    of the paper with 2/D1 = κ; its D1 = 0 is approached by a large κ.

    Parameters
    ----------
    nodes : array (elements, nodes)
    gradient : array (elements, points, nodes, directions)
    weight : array (elements, points)
        Volume of each point, mm³.
    pressure_shape : array (points, modes)
        Pressure basis at the points.
    c10_mpa : float
    bulk_mpa : float
        κ.
    """

    nodes: Index
    gradient: Array
    weight: Array
    pressure_shape: Array
    c10_mpa: float
    bulk_mpa: float
    pressure: Array = field(init=False)

    def __post_init__(self) -> None:
        self.pressure = np.zeros((len(self.nodes), self.pressure_shape.shape[1]))
        shape = self.pressure_shape
        self._mass = np.einsum("gm,gk,eg->emk", shape, shape, self.weight)
        self._inverse_mass = self.bulk_mpa * np.linalg.inv(self._mass)
        self._left = _by_node(self.gradient)

    def respond(self, displacement: Array) -> Response:
        """Energy, condensed forces and tangents for nodal displacements (nodes, dim)."""
        elements, points, nodes, _ = self.gradient.shape
        size, modes = nodes * displacement.shape[1], self.pressure.shape[1]
        self._coupling = np.empty((elements, size, modes))
        self._mismatch = np.empty((elements, modes))
        whole = Response(0.0, np.empty((elements, size)), np.empty((elements, size, size)))
        few = max(1, CACHE_BYTES // (8 * points * size))
        for first in range(0, elements, few):
            self._respond(slice(first, first + few), displacement, whole)
        return whole

    def _respond(self, part: slice, displacement: Array, whole: Response) -> None:
        """Fill in the response of some elements."""
        gradient, weight, own = self.gradient[part], self.weight[part], self.pressure[part]
        dim, directions = displacement.shape[1], gradient.shape[3]
        deformation = deformation_gradient(gradient, displacement[self.nodes[part]], None)
        law = neo_hookean(self.c10_mpa, deformation, own @ self.pressure_shape.T)
        turned = _products(gradient, law.inverse[..., :dim, :directions])
        moved = _products(gradient, deformation[..., :dim, :directions])
        # shared with the forces: P = a F + (p J - a I1/3) G, each with the points' weights
        weighted = weight * np.stack([law.scale, law.third, law.pull])
        scale, third, pull = weighted[..., None]
        modes = weight[..., None] * law.volume[..., None] * self.pressure_shape
        coupling = np.matmul(turned.swapaxes(1, 2), modes)
        opened = (weight * (law.volume - 1.0)) @ self.pressure_shape
        taken = np.einsum("emk,ek->em", self._mass[part], own) / self.bulk_mpa
        self._coupling[part], self._mismatch[part] = coupling, opened - taken
        whole.energy += float(np.sum(weight * law.energy))
        whole.energy += float(np.sum(own * (opened - 0.5 * taken)))
        lift = np.matmul(coupling, self._inverse_mass[part])
        force = np.sum(scale * moved + (pull - third) * turned, axis=1)
        whole.force[part] = force + np.einsum("enm,em->en", lift, opened - taken)
        # half of what is symmetric under the exchange of the two unknowns
        right = (third / 3.0 + pull / 2.0) * turned - (2.0 / 3.0 * scale) * moved
        left = np.concatenate([turned, 0.5 * lift.swapaxes(1, 2)], axis=1)
        right = np.concatenate([right, coupling.swapaxes(1, 2)], axis=1)
        half = np.matmul(left.swapaxes(1, 2), right)
        tangent = np.add(half, half.swapaxes(1, 2), out=whole.tangent[part])
        _add_crossed(tangent, (third - pull) * turned, turned, dim)
        along = np.repeat(weighted[0], directions, axis=1)
        _add_isotropic(tangent, self._left[part], along, dim)

    def update_pressure(self, step: Array, part: float = 1.0) -> None:
        """Follow part of a Newton step (nodes, dim) from the last state: κ M⁻¹ (r_p + Gᵀ du)."""
        local = step[self.nodes].reshape(len(self.nodes), -1)
        rhs = self._mismatch + np.einsum("enm,en->em", self._coupling, local)
        self.pressure = self.pressure + part * np.einsum("emk,ek->em", self._inverse_mass, rhs)
