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
from nptcs.fe.elements.kinematics import (
    COLUMNS,
    ROWS,
    VOIGT,
    add_crossed,
    add_isotropic,
    deformation_by_node,
    displacement_gradient,
    gradient_products,
    gradients_by_node,
    green_strain,
    internal_force,
    moduli_tangent,
)
from nptcs.fe.elements.neo_hooke import neo_hookean

# rubber is worked on in parts whose arrays stay in a processor's cache: this halves the time when
# two processes run at once
CACHE_BYTES = 400_000


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
    stress : array (elements, points, 6) or None
        Second Piola–Kirchhoff stress that the last Newton step led to (`follow`), MPa: the tangent
        takes it, forces do not. None before the first step: that of the displacements.
    """

    nodes: Index
    gradient: Array
    weight: Array
    stiffness: Array
    frame: Array | None = None
    stress: Array | None = field(init=False, default=None)

    def __post_init__(self) -> None:
        self._left = gradients_by_node(self.gradient)
        self._columns = np.ascontiguousarray(self.gradient.swapaxes(2, 3))
        directions = self.gradient.shape[3]
        material = self.stiffness[:, VOIGT[:, :, None, None], VOIGT[None, None]]
        self._material = material[:, :, :directions, :, :directions]

    def strain(self, displacement: Array) -> Array:
        """Green–Lagrange strain (elements, points, 6) in the local frame."""
        return green_strain(self._deformed(displacement))

    def _deformed(self, displacement: Array) -> Array:
        directions = self.gradient.shape[3]
        return deformation_by_node(self._left, directions, displacement[self.nodes], self.frame)

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
        force = internal_force(self._left, piola[..., :dim, :directions])
        # A_iJjL = F_iM C_MJNL F_jN + δ_ij S_JL, kept in the order J, i, j, L
        rows = self._last[..., :dim, :]
        half = np.einsum("egiM,gMJNL->egiJNL", rows, self._material)
        moduli = np.einsum("egiJNL,egjN->egJijL", half, rows, optimize=True)
        carried = (stress if self.stress is None else self.stress)[..., VOIGT]
        for i in range(dim):
            moduli[:, :, :, i, i, :] += carried[..., :directions, :directions]
        moduli *= weight[..., None, None]
        return Response(energy, force, moduli_tangent(self._left, self._columns, moduli))

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
        return energy, internal_force(self._left, piola[..., :dim, :directions])

    def follow(self, step: Array, part: float = 1.0) -> None:
        """Follow part of a Newton step (nodes, dim) from the last state: S = C (E + B du)."""
        directions = self.gradient.shape[3]
        change = displacement_gradient(self._left, directions, step[self.nodes])
        dim = change.shape[2]
        both = np.matmul(self._last[..., :dim, :].swapaxes(-1, -2), change)
        added = np.zeros_like(self._strain)
        for place, (i, j) in enumerate(zip(ROWS, COLUMNS, strict=True)):
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
        self._left = gradients_by_node(self.gradient)

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
        deformation = deformation_by_node(self._left, directions, displacement[self.nodes], None)
        law = neo_hookean(self.c10_mpa, deformation, self.pressure @ self.pressure_shape.T)
        opened = (self.weight * (law.volume - 1.0)) @ self.pressure_shape
        taken = np.einsum("emk,ek->em", self._mass, self.pressure) / self.bulk_mpa
        self._mismatch = opened - taken
        energy = float(np.sum(self.weight * law.energy))
        energy += float(np.sum(self.pressure * (opened - 0.5 * taken)))
        scale, across = self.weight * law.scale, self.weight * (law.pull - law.third)
        stress = scale[..., None, None] * deformation + across[..., None, None] * law.inverse
        force = internal_force(self._left, stress[..., :dim, :directions])
        return energy, force + np.matmul(self._lift, self._mismatch[..., None])[..., 0]

    def _respond(self, part: slice, displacement: Array, whole: Response) -> None:
        """Fill in the response of some elements."""
        gradient, weight, own = self.gradient[part], self.weight[part], self.pressure[part]
        dim, directions = displacement.shape[1], gradient.shape[3]
        local = displacement[self.nodes[part]]
        deformation = deformation_by_node(self._left[part], directions, local, None)
        law = neo_hookean(self.c10_mpa, deformation, own @ self.pressure_shape.T)
        turned = gradient_products(gradient, law.inverse[..., :dim, :directions])
        moved = gradient_products(gradient, deformation[..., :dim, :directions])
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
        add_crossed(tangent, (third - pull) * turned, turned, dim)
        along = np.repeat(weighted[0], directions, axis=1)
        add_isotropic(tangent, self._left[part], along, dim)

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
