"""Element blocks of the ring: rubber of band and tread, and the wire layers as plane beams."""

from __future__ import annotations

import numpy as np

from nptcs.arrays import Array, Index
from nptcs.config.tyre import TyreGeometry
from nptcs.fe.elements.groups import LinearGroup, RubberGroup
from nptcs.fe.elements.lagrange import gauss, jacobians, tensor_rule, tensor_shape
from nptcs.fe.tyre.mesh import RingMesh

Rule = tuple[Array, Array]

THICK, THIN = (2, 2), (1, 2)
# of a circular section (Cowper 1966, Poisson's ratio 0.3)
SHEAR_CORRECTION = 0.886


def ring_rubbers(
    ring: RingMesh, width_mm: float, c10_mpa: float, bulk_to_shear_ratio: float
) -> list[RubberGroup]:
    """Rubber of the thick elements and of the thin ones around the wires, in plane strain."""
    thin = np.concatenate(list(ring.wire_elements))
    return [
        _rubber(ring, nodes, orders, width_mm, c10_mpa, bulk_to_shear_ratio)
        for nodes, orders in ((ring.elements, THICK), (thin, THIN))
    ]


def _rubber(
    ring: RingMesh,
    nodes: Index,
    orders: tuple[int, int],
    width_mm: float,
    c10_mpa: float,
    ratio: float,
) -> RubberGroup:
    points, weights = gauss([order + 1 for order in orders])
    _, slope = tensor_shape(orders, points)
    gradient, area = jacobians(slope, ring.positions[nodes])
    modes = np.ones((len(points), 1))
    if min(orders) > 1:
        modes = np.column_stack([modes, points])
    weight = area * weights * width_mm
    return RubberGroup(nodes, gradient, weight, modes, c10_mpa, 2.0 * c10_mpa * ratio)


def wire_groups(ring: RingMesh, tyre: TyreGeometry) -> list[LinearGroup]:
    """Wires as beams in the middle of the thin elements.

    Two points at a quarter of the diameter from the wire's axis have the area and the moment of
    inertia of the round wire. The transverse shear stiffness holds the faces of the thin elements
    square to the wire; it is under-integrated along the wire against locking. Without bending
    stiffness a compressed layer buckles at the length of the elements, however short they are.
    """
    area = np.pi / 4.0 * tyre.wire_diameter_mm**2
    area *= tyre.tread_width_mm / tyre.wire_pitch_mm * tyre.wire_layers / 2.0
    modulus = tyre.wire_modulus_mpa
    shear = SHEAR_CORRECTION * modulus / 2.0 / (1.0 + tyre.wire_poisson_ratio)
    depth = float(ring.radii[1] - ring.radii[0])
    offset = tyre.wire_diameter_mm / 4.0 / (depth / 2.0)
    fibres = np.array([-offset, offset]), np.full(2, 0.5)
    middle = np.zeros(1), np.ones(1)
    two, three = (np.polynomial.legendre.leggauss(count) for count in (2, 3))
    return [
        _beam(ring, nodes, tensor_rule(rule), component, stiffness, area)
        for nodes in ring.wire_elements
        for rule, component, stiffness in (((fibres, three), 0, modulus), ((middle, two), 3, shear))
    ]


def _beam(
    ring: RingMesh, nodes: Index, rule: Rule, component: int, modulus: float, area_mm2: float
) -> LinearGroup:
    """Stiffness of one strain component (Voigt place) along the wires; local axis 1 is theirs."""
    points, weights = rule
    _, slope = tensor_shape(THIN, points)
    gradient, _ = jacobians(slope, ring.positions[nodes])
    along = np.einsum("gn,eni->egi", slope[..., 1], ring.positions[nodes])
    length = np.linalg.norm(along, axis=2)
    frame = np.zeros((*length.shape, 3, 3))
    frame[..., :2, 0] = along / length[..., None]
    frame[..., 0, 1] = -frame[..., 1, 0]
    frame[..., 1, 1] = frame[..., 0, 0]
    frame[..., 2, 2] = 1.0
    local = np.einsum("egni,egij->egnj", gradient, frame[..., :2, :2])
    stiffness = np.zeros((len(points), 6, 6))
    stiffness[:, component, component] = modulus
    return LinearGroup(nodes, local, length * weights * area_mm2, stiffness, frame)
