"""Plane mesh of the band and tread, 360°, with the feet of the spokes.

θ = 0 points down to the ground and grows anticlockwise; x = r sin θ, y = -r cos θ, the wheel's
centre at the origin.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nptcs.config.fe import TyreMesh
from nptcs.config.tyre import TyreGeometry

Array = NDArray[np.float64]
Index = NDArray[np.int64]


@dataclass(frozen=True)
class RingMesh:
    """Band and tread.

    Parameters
    ----------
    positions : array (nodes, 2)
    elements : array (elements, 9)
        All quadratic elements, the radial direction first.
    band : array
        Numbers of the elements that lie in the shear band.
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
    band: Index
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
        If the spokes' feet overlap.
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
    radii = np.concatenate(
        [
            np.linspace(inner, outer, 2 * mesh.band_rows, endpoint=False),
            np.linspace(outer, tyre.outer_diameter_mm / 2.0, 2 * mesh.tread_rows + 1),
        ]
    )
    rows, columns = len(radii), len(theta)
    radius, angle = np.tile(radii, columns), np.repeat(theta, rows)
    positions = np.stack([radius * np.sin(angle), -radius * np.cos(angle)], axis=1)
    layers = mesh.band_rows + mesh.tread_rows
    first_column, first_row = (
        part.ravel()
        for part in np.meshgrid(
            np.arange(0, columns, 2), np.arange(0, 2 * layers, 2), indexing="ij"
        )
    )
    i, j = (part.ravel() for part in np.meshgrid(range(3), range(3), indexing="ij"))
    elements = ((first_column[:, None] + j) % columns) * rows + first_row[:, None] + i
    edges = ((np.arange(0, columns, 2)[:, None] + np.arange(3)) % columns) * rows + rows - 1
    per_pitch = len(local)
    feet = np.arange(tyre.spoke_count)[:, None] * per_pitch
    feet = (feet + np.arange(2 * mesh.foot_elements + 1)) * rows
    return RingMesh(
        positions=positions,
        elements=elements,
        band=np.flatnonzero(first_row < 2 * mesh.band_rows),
        tread_edges=edges,
        feet=feet,
        spoke_angle=start + foot / 2.0 + pitch * np.arange(tyre.spoke_count),
        theta=theta,
        radii=radii,
    )
