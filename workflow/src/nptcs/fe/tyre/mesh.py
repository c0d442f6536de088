"""Plane mesh of the band and tread, 360°, with the feet of the spokes.

θ = 0 points down to the ground and grows anticlockwise; x = r sin θ, y = -r cos θ, the wheel's
centre at the origin.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nptcs.arrays import Array, Index
from nptcs.config.fe import TyreMesh
from nptcs.config.tyre import TyreGeometry


@dataclass(frozen=True)
class RingMesh:
    """Band and tread.

    Parameters
    ----------
    positions : array (nodes, 2)
    elements : array (elements, 9)
        Quadratic elements, the radial direction first.
    wire_elements : array (2, elements, 6)
        Thin elements around the inner and the outer wire layers: linear along the radius, which
        comes first, and quadratic along the circumference.
    middle_row : int
        Row of nodes in the middle of the band.
    tread_edges : array (edges, 3)
        Nodes of the outer edges, in the order of θ.
    feet : array (spokes, nodes of a foot)
        Nodes on the inside of the band under each spoke, in the order of θ.
    spoke_angle : array (spokes,)
        θ of each foot's middle, rad.
    theta : array (columns,)
        θ of each column of nodes, rad.
    radii : array (rows,)
        Radius of each row of nodes, mm; node number = column × rows + row.
    """

    positions: Array
    elements: Index
    wire_elements: Index
    middle_row: int
    tread_edges: Index
    feet: Index
    spoke_angle: Array
    theta: Array
    radii: Array


def band_radii(tyre: TyreGeometry) -> tuple[float, float]:
    """Inner and outer radius of the shear band, centred on its wire layers."""
    middle = 0.25 * (tyre.inner_wire_diameter_mm + tyre.outer_wire_diameter_mm)
    half = tyre.shear_band_thickness_mm / 2.0
    return middle - half, middle + half


def build_ring(tyre: TyreGeometry, mesh: TyreMesh, foot_width_mm: float) -> RingMesh:
    """Mesh the band and tread of a tyre.

    Raises
    ------
    ValueError
        If the spokes' feet overlap, or the wires lie outside the band.
    """
    inner, outer = band_radii(tyre)
    pitch = 2.0 * np.pi / tyre.spoke_count
    foot = foot_width_mm / inner
    if foot >= pitch:
        raise ValueError(f"feet {foot_width_mm:.2f} mm wide overlap on {tyre.spoke_count} spokes")
    start = np.radians(mesh.first_spoke_deg) - foot / 2.0
    local = np.concatenate(
        [
            np.linspace(0.0, foot, 2 * mesh.foot_elements, endpoint=False),
            np.linspace(foot, pitch, 2 * mesh.gap_elements, endpoint=False),
        ]
    )
    theta = (start + pitch * np.arange(tyre.spoke_count)[:, None] + local).ravel()
    cover = tyre.inner_wire_diameter_mm - 2.0 * inner
    if cover <= tyre.wire_diameter_mm:
        raise ValueError(f"a band {outer - inner:g} mm thick does not cover its wires")
    outside = tyre.outer_diameter_mm / 2.0
    radii = np.concatenate(
        [
            [inner],
            np.linspace(inner + cover, outer - cover, 2 * mesh.band_rows + 1),
            np.linspace(outer, outside, 2 * mesh.tread_rows + 1),
        ]
    )
    rows, columns = len(radii), len(theta)
    radius, angle = np.tile(radii, columns), np.repeat(theta, rows)
    positions = np.stack([radius * np.sin(angle), -radius * np.cos(angle)], axis=1)
    tread = 2 * mesh.band_rows + 2
    starts = [*range(1, tread - 1, 2), *range(tread, rows - 1, 2)]
    edges = ((np.arange(0, columns, 2)[:, None] + np.arange(3)) % columns) * rows + rows - 1
    per_pitch = len(local)
    feet = np.arange(tyre.spoke_count)[:, None] * per_pitch
    feet = (feet + np.arange(2 * mesh.foot_elements + 1)) * rows
    return RingMesh(
        positions=positions,
        elements=_elements(rows, columns, starts, 3),
        wire_elements=np.stack([_elements(rows, columns, [i], 2) for i in (0, tread - 1)]),
        middle_row=1 + mesh.band_rows,
        tread_edges=edges,
        feet=feet,
        spoke_angle=start + foot / 2.0 + pitch * np.arange(tyre.spoke_count),
        theta=theta,
        radii=radii,
    )


def _elements(rows: int, columns: int, starts: list[int], high: int) -> Index:
    """Elements three columns long and `high` rows high that start at these rows."""
    first_column, first_row = (
        part.ravel() for part in np.meshgrid(np.arange(0, columns, 2), starts, indexing="ij")
    )
    i, j = (part.ravel() for part in np.meshgrid(range(high), range(3), indexing="ij"))
    nodes: Index = ((first_column[:, None] + j) % columns) * rows + first_row[:, None] + i
    return nodes
