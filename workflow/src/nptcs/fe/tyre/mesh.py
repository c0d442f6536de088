"""Plane meshes of the band and tread, 360°, with the feet of the spokes.

θ = 0 points down to the ground and grows anticlockwise; x = r sin θ, y = -r cos θ, the wheel's
centre at the origin.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import assert_never

import numpy as np

from nptcs.arrays import Array, Index
from nptcs.config.solvers.fe import PaperMesh, TyreMesh
from nptcs.config.solvers.tyre import TyreGeometry

Orders = tuple[int, int]
# of elements whose wires are membranes
MEMBRANES: Orders = (1, 1)
# points and weights on an edge of the tread, from -1 to 1
EdgeRule = tuple[Array, Array]


@dataclass(frozen=True)
class RingMesh:
    """Band and tread.

    Parameters
    ----------
    positions : array (nodes, 2)
    rubber : tuple of pairs (orders, array (elements, nodes of an element))
        Elements by their polynomial orders along the radius, which comes first, and along the
        circumference.
    wire_orders : pair of int
    wire_elements : array (2, elements, nodes of an element)
        Elements through which the inner and the outer wires run.
    wire_places : pair of float
        Local radial coordinate, from -1 to 1, of the wires in these elements.
    middle_row : int
        Row of nodes in the middle of the band.
    tread_edges : array (edges, nodes of an edge)
        Nodes of the outer edges, in the order of θ.
    contact_rule : pair of arrays
        Contact points on these edges, and their weights.
    feet : array (spokes, nodes)
        Nodes on the inside of the band that span the whole foot of each spoke, in the order of θ.
    foot_half_angle : float
        Half the angle of a foot, rad.
    spoke_angle : array (spokes,)
        θ of each foot's middle, rad.
    theta : array (columns,)
        θ of each column of nodes, rad.
    radii : array (rows,)
        Radius of each row of nodes, mm; node number = column × rows + row.
    """

    positions: Array
    rubber: tuple[tuple[Orders, Index], ...]
    wire_orders: Orders
    wire_elements: Index
    wire_places: tuple[float, float]
    middle_row: int
    tread_edges: Index
    contact_rule: EdgeRule
    feet: Index
    foot_half_angle: float
    spoke_angle: Array
    theta: Array
    radii: Array


def band_radii(tyre: TyreGeometry) -> tuple[float, float]:
    """Inner and outer radius of the shear band, centred on its wire layers."""
    middle = 0.25 * (tyre.inner_wire_diameter_mm + tyre.outer_wire_diameter_mm)
    half = tyre.shear_band_thickness_mm / 2.0
    return middle - half, middle + half


def build_ring(tyre: TyreGeometry, mesh: TyreMesh | PaperMesh, foot_width_mm: float) -> RingMesh:
    """Mesh the band and tread of a tyre.

    Raises
    ------
    ValueError
        If the spokes' feet overlap, or the wires lie outside the band.
    """
    inner, outer = band_radii(tyre)
    pitch = 2.0 * np.pi / tyre.spoke_count
    if foot_width_mm / inner >= pitch:
        raise ValueError(f"feet {foot_width_mm:.2f} mm wide overlap on {tyre.spoke_count} spokes")
    if tyre.inner_wire_diameter_mm - 2.0 * inner <= tyre.wire_diameter_mm:
        raise ValueError(f"a band {outer - inner:g} mm thick does not cover its wires")
    match mesh:
        case TyreMesh():
            return _converged_ring(tyre, mesh, foot_width_mm)
        case PaperMesh():
            return _paper_ring(tyre, mesh, foot_width_mm)
        case _:
            assert_never(mesh)


def _converged_ring(tyre: TyreGeometry, mesh: TyreMesh, foot_width_mm: float) -> RingMesh:
    """Quadratic elements that end at the feet; wires in the middle of separate thin rows."""
    inner, outer = band_radii(tyre)
    wires = tyre.inner_wire_diameter_mm / 2.0, tyre.outer_wire_diameter_mm / 2.0
    half, outside = mesh.wire_row_mm / 2.0, tyre.outer_diameter_mm / 2.0
    foot, pitch = foot_width_mm / inner, 2.0 * np.pi / tyre.spoke_count
    spoke_angle = np.radians(mesh.first_spoke_deg) + pitch * np.arange(tyre.spoke_count)
    under, between = 2 * mesh.foot_elements, 2 * mesh.gap_elements
    local = np.concatenate(
        [
            np.linspace(-foot / 2.0, foot / 2.0, under, endpoint=False),
            np.linspace(foot / 2.0, pitch - foot / 2.0, between, endpoint=False),
        ]
    )
    theta = (spoke_angle[:, None] + local).ravel()
    covers, core, tread = 2 * mesh.cover_rows, 2 * mesh.band_rows, 2 * mesh.tread_rows
    # the last node of each part is the first of the next
    radii = np.concatenate(
        [
            np.linspace(inner, wires[0] - half, covers, endpoint=False),
            [wires[0] - half],
            np.linspace(wires[0] + half, wires[1] - half, core, endpoint=False),
            [wires[1] - half],
            np.linspace(wires[1] + half, outer, covers, endpoint=False),
            np.linspace(outer, outside, tread + 1),
        ]
    )
    rows, columns = len(radii), len(theta)
    low, high = covers, covers + 1 + core
    thick = [*range(0, low, 2), *range(low + 1, high, 2), *range(high + 1, rows - 1, 2)]
    wire_rows = [_elements(rows, columns, [start], (1, 2)) for start in (low, high)]
    feet = np.arange(tyre.spoke_count)[:, None] * len(local) + np.arange(under + 1)
    return RingMesh(
        positions=_positions(radii, theta),
        rubber=(
            ((2, 2), _elements(rows, columns, thick, (2, 2))),
            ((1, 2), np.concatenate(wire_rows)),
        ),
        wire_orders=(1, 2),
        wire_elements=np.stack(wire_rows),
        wire_places=(0.0, 0.0),
        middle_row=low + 1 + mesh.band_rows,
        tread_edges=_edges(rows, columns, 2),
        contact_rule=np.polynomial.legendre.leggauss(CONTACT_POINTS),
        feet=feet % columns * rows,
        foot_half_angle=foot / 2.0,
        spoke_angle=spoke_angle,
        theta=theta,
        radii=radii,
    )


def _paper_ring(tyre: TyreGeometry, mesh: PaperMesh, foot_width_mm: float) -> RingMesh:
    """Equal four-node quads, two rows in the band and two in the tread; contact at nodes."""
    inner, outer = band_radii(tyre)
    outside, columns = tyre.outer_diameter_mm / 2.0, mesh.around
    radii = np.array([inner, (inner + outer) / 2.0, outer, (outer + outside) / 2.0, outside])
    theta: Array = 2.0 * np.pi / columns * np.arange(columns, dtype=float)
    rows = len(radii)
    spoke_angle = np.radians(mesh.first_spoke_deg)
    spoke_angle = spoke_angle + 2.0 * np.pi / tyre.spoke_count * np.arange(tyre.spoke_count)
    half = foot_width_mm / inner / 2.0
    first = np.floor((spoke_angle - half) / theta[1] + 1e-9).astype(np.int64)
    held = int(np.ceil(2.0 * half / theta[1])) + 2
    depth = radii[1] - radii[0]
    wires = tyre.inner_wire_diameter_mm / 2.0, tyre.outer_wire_diameter_mm / 2.0
    return RingMesh(
        positions=_positions(radii, theta),
        rubber=(((1, 1), _elements(rows, columns, range(rows - 1), (1, 1))),),
        wire_orders=MEMBRANES,
        wire_elements=np.stack([_elements(rows, columns, [start], (1, 1)) for start in (0, 1)]),
        wire_places=(
            2.0 * float((wires[0] - radii[0]) / depth) - 1.0,
            2.0 * float((wires[1] - radii[1]) / depth) - 1.0,
        ),
        middle_row=1,
        tread_edges=_edges(rows, columns, 1),
        contact_rule=(np.array([-1.0, 1.0]), np.ones(2)),
        feet=(first[:, None] + np.arange(held)) % columns * rows,
        foot_half_angle=half,
        spoke_angle=spoke_angle,
        theta=theta,
        radii=radii,
    )


CONTACT_POINTS = 4


def _positions(radii: Array, theta: Array) -> Array:
    radius, angle = np.tile(radii, len(theta)), np.repeat(theta, len(radii))
    positions: Array = np.stack([radius * np.sin(angle), -radius * np.cos(angle)], axis=1)
    return positions


def _edges(rows: int, columns: int, order: int) -> Index:
    """Outer edges of elements of an order along the circumference."""
    starts = np.arange(0, columns, order)[:, None]
    edges: Index = ((starts + np.arange(order + 1)) % columns) * rows + rows - 1
    return edges


def _elements(rows: int, columns: int, starts: Sequence[int], orders: Orders) -> Index:
    """Elements of these orders along radius and circumference that start at these rows."""
    first_column, first_row = (
        part.ravel()
        for part in np.meshgrid(np.arange(0, columns, orders[1]), starts, indexing="ij")
    )
    i, j = (
        part.ravel()
        for part in np.meshgrid(range(orders[0] + 1), range(orders[1] + 1), indexing="ij")
    )
    nodes: Index = ((first_column[:, None] + j) % columns) * rows + first_row[:, None] + i
    return nodes
