"""Element groups of the ring: rubber of band and tread, and the wire layers."""

from __future__ import annotations

import numpy as np

from nptcs.arrays import Index
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.fe.elements.groups import LinearGroup, RubberGroup
from nptcs.fe.elements.lagrange import QuadratureRule, gauss, jacobians, tensor_rule, tensor_shape
from nptcs.fe.tyre.mesh import MEMBRANES, Orders, RingMesh

# of a circular section (Cowper 1966, Poisson's ratio 0.3)
SHEAR_CORRECTION = 0.886
# Voigt places of the strains along and across the wires and of their transverse shear
ALONG, ACROSS, SHEAR = 0, 1, 3


def ring_rubbers(
    ring: RingMesh, width_mm: float, c10_mpa: float, bulk_to_shear_ratio: float
) -> list[RubberGroup]:
    """Rubber of all elements in plane strain: linear pressure in biquadratic ones, else constant.

    Elements of four nodes with one pressure are those of mean dilatation (Q1P0).
    """
    groups = []
    for orders, nodes in ring.rubber:
        points, weights = gauss([order + 1 for order in orders])
        _, slope = tensor_shape(orders, points)
        gradient, area = jacobians(slope, ring.positions[nodes])
        modes = np.ones((len(points), 1))
        if min(orders) > 1:
            modes = np.column_stack([modes, points])
        weight = area * weights * width_mm
        bulk = 2.0 * c10_mpa * bulk_to_shear_ratio
        groups.append(RubberGroup(nodes, gradient, weight, modes, c10_mpa, bulk))
    return groups


def wire_groups(ring: RingMesh, tyre: TyreGeometry) -> list[LinearGroup]:
    """Wires in their elements: beams where these are separate rows, else membranes."""
    area = np.pi / 4.0 * tyre.wire_diameter_mm**2
    area *= tyre.tread_width_mm / tyre.wire_pitch_mm * tyre.wire_layers / 2.0
    return [
        group
        for nodes, place in zip(ring.wire_elements, ring.wire_places, strict=True)
        for group in (
            _membrane(ring, nodes, place, tyre.wire_modulus_mpa, area)
            if ring.wire_orders == MEMBRANES
            else _beam(ring, nodes, tyre, area)
        )
    ]


def _membrane(
    ring: RingMesh, nodes: Index, place: float, modulus: float, area_mm2: float
) -> list[LinearGroup]:
    """Wires without bending stiffness, embedded in elements: they only stretch.

    One point, since the strain of a straight wire between two sides of an element is uniform. A
    compressed layer of them buckles at the length of the elements, however short they are.
    """
    rule = tensor_rule([(np.array([place]), np.ones(1)), (np.zeros(1), np.full(1, 2.0))])
    return [_line(ring, nodes, ring.wire_orders, rule, ALONG, modulus, area_mm2)]


def _beam(ring: RingMesh, nodes: Index, tyre: TyreGeometry, area_mm2: float) -> list[LinearGroup]:
    """Wires as beams in the middle of thin elements.

    Two points at a quarter of the diameter from the wire's axis have the area and the moment of
    inertia of the round wire, whatever the thin elements' depth. The transverse shear stiffness
    holds the faces of the thin elements square to the wire, the stiffness across it holds them
    apart: without it the points, which lie outside the thin elements, would buckle in the
    compressed layer. Both are under-integrated along the wire against locking.
    """
    modulus = tyre.wire_modulus_mpa
    shear = SHEAR_CORRECTION * modulus / 2.0 / (1.0 + tyre.wire_poisson_ratio)
    corners = ring.positions[nodes[0, [0, ring.wire_orders[1] + 1]]]
    depth = float(np.linalg.norm(corners[1] - corners[0]))
    offset = tyre.wire_diameter_mm / 4.0 / (depth / 2.0)
    fibres = np.array([-offset, offset]), np.full(2, 0.5)
    middle = np.zeros(1), np.ones(1)
    two, three = (np.polynomial.legendre.leggauss(count) for count in (2, 3))
    return [
        _line(ring, nodes, ring.wire_orders, tensor_rule(rule), component, stiffness, area_mm2)
        for rule, component, stiffness in (
            ((fibres, three), ALONG, modulus),
            ((middle, two), ACROSS, modulus),
            ((middle, two), SHEAR, shear),
        )
    ]


def _line(
    ring: RingMesh,
    nodes: Index,
    orders: Orders,
    rule: QuadratureRule,
    component: int,
    modulus: float,
    area_mm2: float,
) -> LinearGroup:
    """Stiffness of one strain component (Voigt place) along the wires; local axis 1 is theirs."""
    points, weights = rule
    _, slope = tensor_shape(orders, points)
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
