"""Stresses and energy densities of finite element states, at points and as means of elements."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from nptcs.arrays import Array
from nptcs.fe.elements.groups import LinearGroup, RubberGroup
from nptcs.fe.elements.kinematics import deformation_gradient
from nptcs.fe.elements.lagrange import jacobians, tensor_shape
from nptcs.fe.elements.neo_hooke import neo_hookean
from nptcs.fe.spoke.mesh import ElementSet


@dataclass(frozen=True)
class RubberFields:
    """Rubber at points of its elements, arrays (elements, points).

    Parameters
    ----------
    energy_density : array
        Strain energy per unit of reference volume, MPa.
    mises : array
        Von Mises equivalent of the Cauchy stress, MPa.
    pressure : array
        Minus the mean Cauchy stress, MPa: positive in compression.
    """

    energy_density: Array
    mises: Array
    pressure: Array


def rubber_fields(group: RubberGroup, displacement: Array) -> RubberFields:
    """Fields at the Gauss points of a group, at its current pressures."""
    local = displacement[group.nodes]
    return _law(group, deformation_gradient(group.gradient, local, None), group.pressure_shape)


def rubber_at(
    group: RubberGroup,
    orders: Sequence[int],
    corners: Array,
    displacement: Array,
    points: Array,
) -> RubberFields:
    """Fields of a group at any local points, not smoothed between elements.

    Parameters
    ----------
    group : RubberGroup
    orders : sequence of int
        Polynomial orders of its elements.
    corners : array (elements, nodes, directions)
        Reference positions, mm.
    displacement : array (nodes, directions)
        mm.
    points : array (points, directions)
        Local coordinates.
    """
    _, slope = tensor_shape(orders, points)
    gradient, _ = jacobians(slope, corners)
    modes = np.column_stack([np.ones(len(points)), points])
    modes = modes[:, : group.pressure.shape[1]]
    return _law(group, deformation_gradient(gradient, displacement[group.nodes], None), modes)


def _law(group: RubberGroup, deformation: Array, modes: Array) -> RubberFields:
    mean = group.pressure @ modes.T
    law = neo_hookean(group.c10_mpa, deformation, mean)
    # σ - p = (a F Fᵀ - a I1/3) / J
    deviator = law.scale[..., None, None] * (deformation @ deformation.swapaxes(-1, -2))
    deviator -= law.third[..., None, None] * np.eye(3)
    deviator /= law.volume[..., None, None]
    return RubberFields(
        energy_density=law.energy + mean * (law.volume - 1.0) - mean**2 / (2.0 * group.bulk_mpa),
        mises=np.sqrt(1.5 * np.sum(deviator**2, axis=(-1, -2))),
        pressure=-mean,
    )


def rubber_energy(group: RubberGroup, displacement: Array) -> Array:
    """Strain energy of each element of a group, N mm."""
    energy: Array = np.sum(group.weight * rubber_fields(group, displacement).energy_density, axis=1)
    return energy


def linear_energy(group: LinearGroup, displacement: Array) -> Array:
    """Strain energy of each element of a linear group, N mm."""
    strain = group.strain(displacement)
    stress = np.matmul(group.stiffness, strain[..., None])[..., 0]
    energy: Array = 0.5 * np.sum(group.weight * np.sum(stress * strain, axis=2), axis=1)
    return energy


def fibre_stress(group: LinearGroup, displacement: Array, angle_deg: float) -> Array:
    """Stress along the fibres at a plate's points, MPa, array (elements, points).

    Second Piola–Kirchhoff stress in axes that turn with the plate, whose strains are small.

    Parameters
    ----------
    group : LinearGroup
        The plates' in-plane group; the first half of its points lies in the ply +A, the second
        in the ply -A.
    displacement : array (nodes, 3)
        mm.
    angle_deg : float
        A.
    """
    stress = np.matmul(group.stiffness, group.strain(displacement)[..., None])[..., 0]
    angles = np.radians(np.repeat([angle_deg, -angle_deg], stress.shape[1] // 2))
    c, s = np.cos(angles), np.sin(angles)
    along: Array = c * c * stress[..., 0] + s * s * stress[..., 1] + 2.0 * c * s * stress[..., 3]
    return along


def extreme(values: Array) -> Array:
    """Value of largest size in each row."""
    largest: Array = np.take_along_axis(values, np.abs(values).argmax(axis=1)[:, None], axis=1)
    return largest[:, 0]


def lattice(count: int, directions: int) -> Array:
    """Evenly spaced local points (count^directions, directions); the last runs fastest."""
    line = np.linspace(-1.0, 1.0, count)
    grid = np.meshgrid(*[line] * directions, indexing="ij")
    return np.stack([part.ravel() for part in grid], axis=1)


def at_points(
    elements: ElementSet, orders: Sequence[int], displacement: Array, points: Array
) -> tuple[Array, Array]:
    """Give reference positions and displacements (elements, points, 3) at local points, mm."""
    shape, _ = tensor_shape(orders, points)
    return (
        np.einsum("gn,eni->egi", shape, elements.corners),
        np.einsum("gn,eni->egi", shape, displacement[elements.nodes]),
    )
