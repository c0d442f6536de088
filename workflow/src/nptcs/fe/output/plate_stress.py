"""Stress of the plates at their faces, and the strain of a spoke's rubber."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nptcs.arrays import Array, Index
from nptcs.fe.elements.groups import LinearGroup
from nptcs.fe.elements.kinematics import deformation_gradient
from nptcs.fe.elements.lagrange import jacobians, tensor_shape
from nptcs.fe.output.fields import rubber_fields
from nptcs.fe.spoke.equilibrium import SpokeModel, SpokeState
from nptcs.fe.spoke.mesh import LAYER_ORDERS
from nptcs.laminate import rotated_stiffness

# sides of the plate in the elements' first coordinate, along x: the ply +A comes first, then -A
SIDES = (-1.0, 1.0)
IN_PLANE = [0, 1, 3]


@dataclass(frozen=True)
class FaceStress:
    """Stress at the two faces of each plate element, at its centre and as its mean.

    Arrays (faces,): first the faces at the ply +A, then those of the same elements at -A. Second
    Piola–Kirchhoff stress in axes that turn with the plate, whose strains are small.

    Parameters
    ----------
    leg : array of int
        0 for the leg at the rim, 1 for the one at the band.
    face : array of int
        0 for the face at the ply +A, 1 for that at the ply -A.
    height_mm : array
        Unloaded height of the element's centre above the rim.
    ply_deg : array
        Fibre angle of the ply at this face.
    along_mpa, across_mpa, shear_mpa : arrays
        σ1, σ2 and τ12 in the fibre axes of that ply, at the centre.
    mises_mpa, mean_mises_mpa : arrays
        Von Mises stress in the plane of the plate: at the centre, where a reduced-integration
        shell has its only point, and of the mean stress of the element's face.
    """

    leg: Index
    face: Index
    height_mm: Array
    ply_deg: Array
    along_mpa: Array
    across_mpa: Array
    shear_mpa: Array
    mises_mpa: Array
    mean_mises_mpa: Array


def face_stress(model: SpokeModel, state: SpokeState) -> FaceStress:
    """Stress of the plates at their faces for one state of the spoke."""
    design, plate = model.design, model.mesh.plate
    ratio = design.thickness_mm / design.geometry.plate_layer_mm
    points, weights = np.polynomial.legendre.leggauss(3)
    across, along = (grid.ravel() for grid in np.meshgrid(points, points, indexing="ij"))
    share = np.outer(weights, weights).ravel() / 4.0
    parts = []
    for face, (side, angle) in enumerate(
        zip(SIDES, (design.angle_deg, -design.angle_deg), strict=True)
    ):
        stiffness = rotated_stiffness(design.ply, angle)
        place = np.stack([np.full(10, side * ratio), [0.0, *across], [0.0, *along]], axis=1)
        stress = _strain(model, state, place) @ stiffness
        centre, mean = stress[:, 0], np.einsum("g,egk->ek", share, stress[:, 1:])
        height = 0.5 * (plate.corners[..., 2].min(axis=1) + plate.corners[..., 2].max(axis=1))
        parts.append(
            (
                plate.leg,
                np.full_like(plate.leg, face),
                height,
                np.full(len(height), angle),
                *fibre_axes(centre, angle).T,
                mises_in_plane(centre),
                mises_in_plane(mean),
            )
        )
    return FaceStress(*(np.concatenate(columns) for columns in zip(*parts, strict=True)))


def _strain(model: SpokeModel, state: SpokeState, points: Array) -> Array:
    """Green–Lagrange strains 11, 22, 12 (elements, points, 3) in the plate's axes."""
    plate = model.mesh.plate
    _, slope = tensor_shape(LAYER_ORDERS, points)
    gradient, _ = jacobians(slope, plate.corners)
    frames = model.mesh.plate_axes[plate.leg]
    local = np.einsum("egni,eij->egnj", gradient, frames)
    frame = np.repeat(frames[:, None], len(points), axis=1)
    stiffness = np.zeros((len(points), 6, 6))
    group = LinearGroup(plate.nodes, local, np.ones(local.shape[:2]), stiffness, frame)
    strain: Array = group.strain(state.displacement)[..., IN_PLANE]
    return strain


def mises_in_plane(stress: Array) -> Array:
    """Von Mises stress of plane stresses 11, 22, 12 (…, 3), MPa."""
    first, second, shear = np.moveaxis(stress, -1, 0)
    found: Array = np.sqrt(first**2 - first * second + second**2 + 3.0 * shear**2)
    return found


def fibre_axes(stress: Array, angle_deg: float) -> Array:
    """Turn plane stresses 11, 22, 12 (…, 3) of the plate's axes to those of fibres at an angle."""
    c, s = np.cos(np.radians(angle_deg)), np.sin(np.radians(angle_deg))
    turn = np.array(
        [[c * c, s * s, 2 * c * s], [s * s, c * c, -2 * c * s], [-c * s, c * s, c * c - s * s]]
    )
    turned: Array = stress @ turn.T
    return turned


def rubber_extremes(model: SpokeModel, state: SpokeState) -> tuple[float, float]:
    """Largest principal strain (nominal, λ - 1) and strain energy density (MPa) of the rubber.

    At the integration points, where the elements' fields are most accurate; at the plates' ends
    both grow as the mesh is refined.
    """
    strain, density = 0.0, 0.0
    for group, pressure in zip(model.rubbers, state.pressures, strict=True):
        group.pressure = pressure
        local = state.displacement[group.nodes]
        deformation = deformation_gradient(group.gradient, local, None)
        squares = np.linalg.eigvalsh(deformation.swapaxes(-1, -2) @ deformation)
        strain = max(strain, float(np.sqrt(squares[..., -1].max()) - 1.0))
        fields = rubber_fields(group, state.displacement)
        density = max(density, float(fields.energy_density.max()))
    return strain, density
