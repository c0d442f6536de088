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

    def forces(self, displacement: Array) -> tuple[float, Array]:
        """Energy and forces alone, for a step with the tangents of the last `respond`."""
        ...


class MixedGroup(ElementGroup, Protocol):
    """Elements whose stresses are unknowns of Newton's method, eliminated in each element.

    They are pressures (elements, modes) of rubber, stresses (elements, points, 6) of stiff parts,
    MPa. A guess of displacements that stretches what is stiff then spoils neither the tangents nor
    the steps that follow.
    """

    def follow(self, step: Array, part: float = 1.0) -> None:
        """Follow part of a Newton step (nodes, dim) from the last state."""
        ...

    def inner(self) -> Array:
        """Return the stresses."""
        ...

    def put_inner(self, stresses: Array) -> None:
        """Take stresses that `inner` returned."""
        ...

    def release(self) -> None:
        """Forget the stresses: the body is unloaded again."""
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
    return _deformation(_by_node(gradient), gradient.shape[3], displacement, frame)


def _deformation(left: Array, directions: int, displacement: Array, frame: Array | None) -> Array:
    """`deformation_gradient` from the gradients by node."""
    part = _gradients(left, directions, displacement)
    dim = part.shape[2]
    if frame is None:
        whole = np.zeros((*part.shape[:2], 3, 3))
        whole[..., [0, 1, 2], [0, 1, 2]] = 1.0
    else:
        whole = frame.copy()
    whole[..., :dim, :directions] += part
    return whole


def _gradients(left: Array, directions: int, displacement: Array) -> Array:
    """Σ u_a ⊗ ∂N_a/∂X, array (elements, points, dim, directions)."""
    elements, _, dim = displacement.shape
    part = np.matmul(displacement.swapaxes(1, 2), left).reshape(elements, dim, -1, directions)
    return part.swapaxes(1, 2)


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
    stress: Array | None = field(init=False, default=None)

    def __post_init__(self) -> None:
        self._left = _by_node(self.gradient)
        self._columns = np.ascontiguousarray(self.gradient.swapaxes(2, 3))
        directions = self.gradient.shape[3]
        material = self.stiffness[:, VOIGT[:, :, None, None], VOIGT[None, None]]
        self._material = material[:, :, :directions, :, :directions]

    def strain(self, displacement: Array) -> Array:
        """Green–Lagrange strain (elements, points, 6) in the local frame."""
        return green_strain(self._deformed(displacement))

    def _deformed(self, displacement: Array) -> Array:
        directions = self.gradient.shape[3]
        return _deformation(self._left, directions, displacement[self.nodes], self.frame)

    def _of_strain(self, strain: Array) -> Array:
        return np.matmul(self.stiffness, strain[..., None])[..., 0]

    def respond(self, displacement: Array) -> Response:
        """Energy, forces and tangents for nodal displacements (nodes, dim)."""
        dim, directions = displacement.shape[1], self.gradient.shape[3]
        self._last = self._deformed(displacement)
        self._strain = green_strain(self._last)
        weight = self.weight[..., None, None]
        stress = self._of_strain(self._strain)
        energy = 0.5 * float(np.sum(self.weight[..., None] * stress * self._strain))
        piola = weight * np.matmul(self._last, stress[..., VOIGT])
        force = _internal_force(self._left, piola[..., :dim, :directions])
        # A_iJjL = F_iM C_MJNL F_jN + δ_ij S_JL, kept in the order J, i, j, L
        rows = self._last[..., :dim, :]
        half = np.einsum("egiM,gMJNL->egiJNL", rows, self._material)
        moduli = np.einsum("egiJNL,egjN->egJijL", half, rows, optimize=True)
        carried = (stress if self.stress is None else self.stress)[..., VOIGT]
        for i in range(dim):
            moduli[:, :, :, i, i, :] += carried[..., :directions, :directions]
        moduli *= weight[..., None, None]
        return Response(energy, force, _tangent(self._left, self._columns, moduli))

    def forces(self, displacement: Array) -> tuple[float, Array]:
        """Energy and forces, the stresses eliminated as in the last `respond`."""
        dim, directions = displacement.shape[1], self.gradient.shape[3]
        deformation = self._deformed(displacement)
        self._strain = green_strain(deformation)
        stress = self._of_strain(self._strain)
        energy = 0.5 * float(np.sum(self.weight[..., None] * stress * self._strain))
        own = stress if self.stress is None else self.stress
        piola = np.matmul(deformation, own[..., VOIGT])
        piola += np.matmul(self._last, (stress - own)[..., VOIGT])
        piola *= self.weight[..., None, None]
        return energy, _internal_force(self._left, piola[..., :dim, :directions])

    def follow(self, step: Array, part: float = 1.0) -> None:
        """Follow part of a Newton step (nodes, dim) from the last state: S = C (E + B du)."""
        directions = self.gradient.shape[3]
        change = _gradients(self._left, directions, step[self.nodes])
        dim = change.shape[2]
        both = np.matmul(self._last[..., :dim, :].swapaxes(-1, -2), change)
        added = np.zeros_like(self._strain)
        for place, (i, j) in enumerate(zip(_I, _J, strict=True)):
            if j < directions:
                added[..., place] += both[..., i, j]
                if i != j:
                    added[..., place] += both[..., j, i]
        reached = self._of_strain(self._strain + added)
        own = self.inner()
        self.stress = own + part * (reached - own)

    def inner(self) -> Array:
        """Return the stresses of the points, MPa; before a step those of the displacements."""
        return self._of_strain(self._strain) if self.stress is None else self.stress

    def put_inner(self, stresses: Array) -> None:
        """Take stresses that `inner` returned."""
        self.stress = stresses

    def release(self) -> None:
        """Forget the stresses: they are those of the displacements again."""
        self.stress = None


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
        self._lift = np.empty((elements, size, modes))
        self._mismatch = np.empty((elements, modes))
        whole = Response(0.0, np.empty((elements, size)), np.empty((elements, size, size)))
        few = max(1, CACHE_BYTES // (8 * points * size))
        for first in range(0, elements, few):
            self._respond(slice(first, first + few), displacement, whole)
        return whole

    def forces(self, displacement: Array) -> tuple[float, Array]:
        """Energy and forces, the pressures eliminated as in the last `respond`.

        A step solved with the tangents of that `respond` goes with these forces: Newton's method
        with an older matrix, for displacements and pressures.
        """
        dim, directions = displacement.shape[1], self.gradient.shape[3]
        deformation = _deformation(self._left, directions, displacement[self.nodes], None)
        law = neo_hookean(self.c10_mpa, deformation, self.pressure @ self.pressure_shape.T)
        opened = (self.weight * (law.volume - 1.0)) @ self.pressure_shape
        taken = np.einsum("emk,ek->em", self._mass, self.pressure) / self.bulk_mpa
        self._mismatch = opened - taken
        energy = float(np.sum(self.weight * law.energy))
        energy += float(np.sum(self.pressure * (opened - 0.5 * taken)))
        scale, across = self.weight * law.scale, self.weight * (law.pull - law.third)
        stress = scale[..., None, None] * deformation + across[..., None, None] * law.inverse
        force = _internal_force(self._left, stress[..., :dim, :directions])
        return energy, force + np.matmul(self._lift, self._mismatch[..., None])[..., 0]

    def _respond(self, part: slice, displacement: Array, whole: Response) -> None:
        """Fill in the response of some elements."""
        gradient, weight, own = self.gradient[part], self.weight[part], self.pressure[part]
        dim, directions = displacement.shape[1], gradient.shape[3]
        local = displacement[self.nodes[part]]
        deformation = _deformation(self._left[part], directions, local, None)
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
        lift = np.matmul(coupling, self._inverse_mass[part], out=self._lift[part])
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

    def follow(self, step: Array, part: float = 1.0) -> None:
        """Follow part of a Newton step (nodes, dim) from the last state: κ M⁻¹ (r_p + Gᵀ du)."""
        local = step[self.nodes].reshape(len(self.nodes), -1)
        rhs = self._mismatch + np.einsum("enm,en->em", self._coupling, local)
        self.pressure = self.pressure + part * np.einsum("emk,ek->em", self._inverse_mass, rhs)

    def inner(self) -> Array:
        """Return the pressures."""
        return self.pressure

    def put_inner(self, stresses: Array) -> None:
        """Take pressures that `inner` returned."""
        self.pressure = stresses

    def release(self) -> None:
        """Forget the pressures."""
        self.pressure = np.zeros_like(self.pressure)
