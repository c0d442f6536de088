"""Groups of elements of the same kind: energy, forces and tangents of all of them at once.

Total Lagrangian, in terms of the deformation gradient F and the first Piola–Kirchhoff stress P.
Bodies of two dimensions are in plane strain (F33 = 1). The loops over elements are in `compiled`.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from nptcs.arrays import Array, Index
from nptcs.fe.elements.kinematics import deformation_gradient, green_strain


@dataclass
class ElementResponse:
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

    def respond(self, displacement: Array) -> ElementResponse:
        """Energy, forces and tangents for nodal displacements (nodes, dim)."""
        ...

    def forces(self, displacement: Array) -> tuple[float, Array]:
        """Energy and forces alone, for a step with the tangents of the last `respond`."""
        ...


class MixedGroup(ElementGroup, Protocol):
    """Elements whose stresses are unknowns of Newton's method, eliminated in each element.

    They are pressures (elements, modes) of rubber, stresses (elements, points, 6) of stiff parts,
    MPa. A guess of displacements that stretches stiff parts then spoils neither the tangents nor
    the steps that follow.
    """

    def respond(self, displacement: Array, out: Array | None = None) -> ElementResponse:
        """As `ElementGroup.respond`; the tangents are written into `out` if it is given."""
        ...

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


def empty_tangents(nodes: Index, field: Array) -> Array:
    """Return an array for the tangents of elements whose nodes move as in a field (nodes, dim)."""
    elements, count = nodes.shape
    size = count * field.shape[1]
    return np.empty((elements, size, size))


def _columns(gradient: Array) -> Array:
    """Gradients as (elements, points × directions, nodes)."""
    elements, points, nodes, directions = gradient.shape
    columns = gradient.swapaxes(2, 3).reshape(elements, points * directions, nodes)
    return np.ascontiguousarray(columns)


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
        uses it, forces do not. None before the first step: the stress of the displacements.
    """

    nodes: Index
    gradient: Array
    weight: Array
    stiffness: Array
    frame: Array | None = None
    stress: Array | None = field(init=False, default=None)

    def __post_init__(self) -> None:
        points = self.gradient.shape[:2]
        # one layout of each array, for which the loops are compiled once
        self.nodes = np.ascontiguousarray(self.nodes)
        self.weight = np.ascontiguousarray(self.weight)
        self._columns = _columns(self.gradient)
        self._active = np.flatnonzero(self.stiffness.any(axis=(0, 1))).astype(np.int64)
        self._own_stiffness = np.ascontiguousarray(
            self.stiffness[:, self._active[:, None], self._active]
        )
        frame = np.eye(3) if self.frame is None else self.frame
        self._frame = np.array(np.broadcast_to(frame, (*points, 3, 3)), order="C")
        self._last = self._frame.copy()
        self._strain = np.zeros((*points, 6))

    def strain(self, displacement: Array) -> Array:
        """Green–Lagrange strain (elements, points, 6) in the local frame."""
        local = displacement[self.nodes]
        return green_strain(deformation_gradient(self.gradient, local, self.frame))

    def _of_strain(self, strain: Array) -> Array:
        return np.matmul(self.stiffness, strain[..., None])[..., 0]

    def respond(self, displacement: Array, out: Array | None = None) -> ElementResponse:
        """Energy, forces and tangents for nodal displacements (nodes, dim)."""
        tangent = empty_tangents(self.nodes, displacement) if out is None else out
        energy, force = self._response(displacement, tangent)
        return ElementResponse(energy, force, tangent)

    def forces(self, displacement: Array) -> tuple[float, Array]:
        """Energy and forces, the stresses eliminated as in the last `respond`."""
        return self._response(displacement, None)

    def _response(self, displacement: Array, tangent: Array | None) -> tuple[float, Array]:
        from nptcs.fe.elements import compiled

        force = np.empty((*self.nodes.shape, displacement.shape[1]))
        energy = compiled.linear(
            self.nodes,
            self._columns,
            self.weight,
            self._own_stiffness,
            self._active,
            self._frame,
            np.ascontiguousarray(displacement),
            self._strain if self.stress is None else self.stress,
            self.stress is not None,
            tangent is not None,
            self._last,
            self._strain,
            force,
            np.empty((0, 0, 0)) if tangent is None else tangent,
        )
        return energy, force.reshape(len(force), -1)

    def follow(self, step: Array, part: float = 1.0) -> None:
        """Follow part of a Newton step (nodes, dim) from the last state: S = C (E + B du)."""
        from nptcs.fe.elements import compiled

        added = np.zeros_like(self._strain)
        compiled.added_strain(self.nodes, self._columns, self._active, self._last, step, added)
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
        # one layout of each array, for which the loops are compiled once
        self.nodes = np.ascontiguousarray(self.nodes)
        self.weight = np.ascontiguousarray(self.weight)
        self.pressure_shape = np.ascontiguousarray(self.pressure_shape)
        elements, nodes = self.nodes.shape
        modes = self.pressure_shape.shape[1]
        size = nodes * self.gradient.shape[3]
        self.pressure = np.zeros((elements, modes))
        shape = self.pressure_shape
        mass = np.einsum("gm,gk,eg->emk", shape, shape, self.weight)
        self._mass = np.ascontiguousarray(mass)
        self._inverse_mass = self.bulk_mpa * np.linalg.inv(self._mass)
        self._columns = _columns(self.gradient)
        self._eliminated(size)

    def _eliminated(self, size: int) -> None:
        """Make new arrays for the pressure terms of the next response."""
        shape = self.pressure.shape
        self._mismatch = np.zeros(shape)
        self._coupling = np.zeros((shape[0], size, shape[1]))
        self._lift = np.zeros((shape[0], size, shape[1]))

    def respond(self, displacement: Array, out: Array | None = None) -> ElementResponse:
        """Energy, condensed forces and tangents for nodal displacements (nodes, dim)."""
        tangent = empty_tangents(self.nodes, displacement) if out is None else out
        # copies of this group keep theirs
        self._eliminated(tangent.shape[1])
        energy, force = self._response(displacement, tangent)
        return ElementResponse(energy, force, tangent)

    def forces(self, displacement: Array) -> tuple[float, Array]:
        """Energy and forces, the pressures eliminated as in the last `respond`.

        A step solved with the tangents of that `respond` goes with these forces: Newton's method
        with an older matrix, for displacements and pressures.
        """
        self._mismatch = np.empty_like(self._mismatch)
        return self._response(displacement, None)

    def _response(self, displacement: Array, tangent: Array | None) -> tuple[float, Array]:
        from nptcs.fe.elements import compiled

        force = np.empty((*self.nodes.shape, displacement.shape[1]))
        energy = compiled.rubber(
            self.nodes,
            self._columns,
            self.weight,
            self.pressure_shape,
            self._mass,
            self._inverse_mass,
            (float(self.c10_mpa), float(self.bulk_mpa)),
            np.ascontiguousarray(displacement),
            self.pressure,
            tangent is not None,
            self._mismatch,
            self._coupling,
            self._lift,
            force,
            np.empty((0, 0, 0)) if tangent is None else tangent,
        )
        return energy, force.reshape(len(force), -1)

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
