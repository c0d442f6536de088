"""Element groups of the spoke: its rubber, and the plates as laminates of true thickness."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from nptcs.arrays import Array
from nptcs.fe.elements.groups import LinearGroup, RubberGroup
from nptcs.fe.elements.lagrange import QuadratureRule, gauss, jacobians, tensor_rule, tensor_shape
from nptcs.fe.spoke.mesh import LAYER_ORDERS, ElementSet
from nptcs.laminate import rotated_stiffness, transverse_shear

SHEAR_CORRECTION = 5.0 / 6.0


def rubber_group(
    elements: ElementSet, orders: tuple[int, int, int], c10_mpa: float, bulk_mpa: float
) -> RubberGroup:
    """Rubber elements with a linear pressure; a constant one where they are linear in a direction.

    An element that is linear through its thickness has too few displacements for a linear
    pressure: with one, pressures oscillated by ±16 MPa and a false instability appeared.
    """
    points, weights = gauss([order + 1 for order in orders])
    _, slope = tensor_shape(orders, points)
    gradient, volume = jacobians(slope, elements.corners)
    modes = np.ones((len(points), 1))
    if min(orders) > 1:
        modes = np.column_stack([modes, points])
    return RubberGroup(elements.nodes, gradient, volume * weights, modes, c10_mpa, bulk_mpa)


def plate_groups(
    elements: ElementSet,
    axes: Array,
    layer_mm: float,
    ply: Mapping[str, float],
    angle_deg: float,
    thickness_mm: float,
) -> list[LinearGroup]:
    """Laminate [+A/-A] in a layer of solid elements that are linear through their thickness.

    The in-plane strains of the layer vary linearly through it; they are read at the plies' true
    distances from the mid-surface, which may lie inside or outside the layer, with plane-stress
    stiffness. So membrane, coupling and bending stiffness are those of classical lamination
    theory whatever the layer's thickness, and large rotations are those of the solid. Stretch
    through the thickness and transverse shear (factor 5/6, under-integrated along the plate against
    locking) hold the two faces together.

    Parameters
    ----------
    elements : ElementSet
        Elements of order 1 × 2 × 2, the thickness first.
    axes : array (legs, 3, 3)
        Local axes of each leg: along, across, normal, as columns.
    layer_mm : float
        Thickness of the layer of elements.
    ply : mapping
        Ply constants.
    angle_deg, thickness_mm : float
        Fibre angle from the plate's length, and thickness of the whole plate.
    """
    ratio = thickness_mm / layer_mm
    two = np.polynomial.legendre.leggauss(2)
    three = np.polynomial.legendre.leggauss(3)
    through = (
        ratio * np.concatenate([0.5 * two[0] - 0.5, 0.5 * two[0] + 0.5]),
        ratio * 0.5 * np.tile(two[1], 2),
    )
    middle = (np.zeros(1), np.full(1, 2.0 * ratio))
    both = (angle_deg, -angle_deg)
    in_plane = np.zeros((2, 6, 6))
    in_plane[np.ix_([0, 1], [0, 1, 3], [0, 1, 3])] = [rotated_stiffness(ply, a) for a in both]
    stretch, shear = np.zeros((1, 6, 6)), np.zeros((1, 6, 6))
    stretch[0, 2, 2] = ply["e3_mpa"]
    # components 13 and 23 are the Voigt places 5 and 4
    mean = sum(transverse_shear(ply, a) for a in both) / 2.0
    shear[0][np.ix_([5, 4], [5, 4])] = SHEAR_CORRECTION * mean
    return [
        _plate_group(elements, axes, tensor_rule(rule), stiffness)
        for rule, stiffness in (
            ((through, three, three), np.repeat(in_plane, 18, axis=0)),
            ((middle, three, three), np.repeat(stretch, 9, axis=0)),
            ((middle, three, two), np.repeat(shear, 6, axis=0)),
        )
    ]


def _plate_group(
    elements: ElementSet, axes: Array, rule: QuadratureRule, stiffness: Array
) -> LinearGroup:
    points, weights = rule
    _, slope = tensor_shape(LAYER_ORDERS, points)
    gradient, volume = jacobians(slope, elements.corners)
    frames = axes[elements.leg]
    local = np.einsum("egni,eij->egnj", gradient, frames)
    frame = np.repeat(frames[:, None], len(points), axis=1)
    return LinearGroup(elements.nodes, local, volume * weights, stiffness, frame)
