"""Meshes of the Abaqus tyre's parts: spoke, plates, band with tread, steel wires.

Axes: Z is the tyre's axis and Y points up. The spoke and its plates are drawn under the wheel's
centre, their feet's middle at X = 0; the angle around the tyre grows anticlockwise from there. So
the spoke's own axes of `nptcs.fe.spoke.mesh` (circumference, tyre's axis, radius) are X, Z, -Y.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nptcs.arrays import Array, Index
from nptcs.config.solvers.abaqus import AbaqusMesh
from nptcs.config.solvers.fe import SpokeGeometry
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.errors import InputError
from nptcs.fe.spoke.mesh import subdivide
from nptcs.fe.tyre.mesh import band_radii

# corners of a brick as steps along the three directions of its grid: C3D8's order
BRICK = np.array(
    [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]
)
QUAD = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])


@dataclass(frozen=True)
class DeckPart:
    """Nodes and elements of a part; all numbers from 1.

    Parameters
    ----------
    positions : array (nodes, 3)
        mm; node 1 first.
    elements : array (elements, nodes of one)
        Node numbers in Abaqus' order.
    node_sets, element_sets : dict of str to array
        Node and element numbers.
    """

    positions: Array
    elements: Index
    node_sets: dict[str, Index]
    element_sets: dict[str, Index]


def check_radii(geometry: SpokeGeometry, tyre: TyreGeometry) -> None:
    """Refuse a spoke that does not reach from the rim to the band.

    Raises
    ------
    InputError
        If the heights do not add up within the tie's tolerance.
    """
    room = band_radii(tyre)[0] - tyre.rim_diameter_mm / 2.0
    if abs(room - geometry.height_mm) > 0.1:
        raise InputError(
            f"the spoke is {geometry.height_mm:g} mm high, but rim and band are {room:g} mm apart",
            "give the spoke that height",
            column="geometry.height_mm",
            value=geometry.height_mm,
        )


def spoke_part(geometry: SpokeGeometry, mesh: AbaqusMesh, tyre: TyreGeometry) -> DeckPart:
    """Mesh the rubber of one spoke with bricks in rows of equal radius.

    Node set ``RIMFOOT``: the foot on the rim; element sets ``RUBBER`` and ``BANDFOOT``, the row
    whose faces S2 lie on the band.
    """
    heights, thickness = geometry.section()
    lower = subdivide(heights, mesh.rows)
    rows = np.concatenate([lower, geometry.height_mm - lower[-2::-1]])
    from_end = np.minimum(rows, geometry.height_mm - rows)
    slope = np.radians(geometry.leg_angle_deg)
    half = np.interp(from_end, heights, thickness) / np.cos(slope) / 2.0
    offsets = half[:, None] * np.linspace(-1.0, 1.0, mesh.columns + 1)
    x = -from_end[:, None] * np.tan(slope) + offsets
    z = np.linspace(-0.5, 0.5, mesh.spoke_axial + 1) * tyre.tread_width_mm
    shape = (mesh.columns + 1, len(z), len(rows))
    positions = np.empty((*shape, 3))
    positions[..., 0] = x.T[:, None, :]
    positions[..., 1] = -(tyre.rim_diameter_mm / 2.0 + rows)
    positions[..., 2] = z[:, None]
    numbers = _numbers(shape)
    bricks = _cells(numbers, BRICK)
    in_row = _numbers((mesh.columns, mesh.spoke_axial, len(rows) - 1))
    return DeckPart(
        positions=positions.reshape(-1, 3),
        elements=bricks,
        node_sets={"RIMFOOT": numbers[..., 0].ravel()},
        element_sets={"RUBBER": in_row.ravel(), "BANDFOOT": in_row[..., -1].ravel()},
    )


def plate_axes(geometry: SpokeGeometry) -> dict[str, Array]:
    """Return unit vectors along the plates of both legs, from the rim outwards."""
    slope = np.radians(geometry.leg_angle_deg)
    return {
        "LOWER": np.array([-np.sin(slope), -np.cos(slope), 0.0]),
        "UPPER": np.array([np.sin(slope), -np.cos(slope), 0.0]),
    }


def plates_part(
    geometry: SpokeGeometry, mesh: AbaqusMesh, tyre: TyreGeometry, spacing_mm: float
) -> DeckPart:
    """Mesh the plates of one spoke with shells along the middle of the legs.

    Element sets ``LOWER`` and ``UPPER``: the legs at rim and band. The shells' normal is the
    cross product of the direction along the plate and the tyre's axis.
    """
    low, high = geometry.plate_foot_gap_mm, geometry.height_mm / 2.0 - geometry.plate_mid_gap_mm
    along, across = mesh.plate
    slope = np.tan(np.radians(geometry.leg_angle_deg))
    count = tyre.plates_across(spacing_mm)
    middles = spacing_mm * (np.arange(count) - (count - 1) / 2.0)
    places = np.linspace(-0.5, 0.5, across + 1) * tyre.plate_width_mm
    heights = np.linspace(low, high, along + 1)
    from_rim = {"LOWER": heights, "UPPER": geometry.height_mm - heights[::-1]}
    positions: list[Array] = []
    elements: list[Index] = []
    for rows in from_rim.values():
        x = -np.minimum(rows, geometry.height_mm - rows) * slope
        for middle in middles:
            numbers = _numbers((along + 1, across + 1)) + len(positions) * (along + 1) * (
                across + 1
            )
            plate = np.empty((along + 1, across + 1, 3))
            plate[..., 0] = x[:, None]
            plate[..., 1] = -(tyre.rim_diameter_mm / 2.0 + rows)[:, None]
            plate[..., 2] = middle + places
            positions.append(plate.reshape(-1, 3))
            elements.append(_cells(numbers, QUAD))
    numbers = _numbers((2, count * along * across))
    return DeckPart(
        positions=np.concatenate(positions),
        elements=np.concatenate(elements),
        node_sets={},
        element_sets={"LOWER": numbers[0], "UPPER": numbers[1]},
    )


def band_part(mesh: AbaqusMesh, tyre: TyreGeometry) -> DeckPart:
    """Mesh the shear band and the tread with bricks; a row of nodes lies at the lowest point.

    Node set ``NEUTRAL``: the neutral line of the band, in the plane nearest to the middle of the
    tyre; element sets ``BAND`` and ``TREAD``, ``INSIDE`` and ``OUTSIDE``: the rows whose faces S1
    and S2 lie on the spokes and on the road.
    """
    inner, outer = band_radii(tyre)
    radii = subdivide(
        (inner, outer, tyre.outer_diameter_mm / 2.0), (mesh.band_rows, mesh.tread_rows)
    )
    z = np.linspace(-0.5, 0.5, mesh.band_axial + 1) * tyre.tread_width_mm
    positions = _ring(radii, z, mesh.around)
    numbers = _numbers(positions.shape[:3])
    closed = np.concatenate([numbers, numbers[:1]])
    in_row = _numbers((mesh.around, mesh.band_axial, mesh.band_rows + mesh.tread_rows))
    return DeckPart(
        positions=positions.reshape(-1, 3),
        elements=_cells(closed, BRICK),
        node_sets={"NEUTRAL": numbers[:, mesh.band_axial // 2, mesh.band_rows // 2].ravel()},
        element_sets={
            "BAND": in_row[..., : mesh.band_rows].ravel(),
            "TREAD": in_row[..., mesh.band_rows :].ravel(),
            "INSIDE": in_row[..., 0].ravel(),
            "OUTSIDE": in_row[..., -1].ravel(),
        },
    )


def wires_part(mesh: AbaqusMesh, tyre: TyreGeometry) -> DeckPart:
    """Mesh the two surfaces that carry the steel wires, at the same angles as the band.

    Element sets ``INNER`` and ``OUTER``.
    """
    radii = np.array([tyre.inner_wire_diameter_mm, tyre.outer_wire_diameter_mm]) / 2.0
    z = np.linspace(-0.5, 0.5, mesh.band_axial + 1) * tyre.tread_width_mm
    positions = _ring(radii, z, mesh.around)
    numbers = _numbers(positions.shape[:3])
    closed = np.concatenate([numbers, numbers[:1]])
    one = mesh.around * mesh.band_axial
    return DeckPart(
        positions=positions.reshape(-1, 3),
        elements=np.concatenate([_cells(closed[..., layer], QUAD) for layer in (0, 1)]),
        node_sets={},
        element_sets={"INNER": np.arange(1, one + 1), "OUTER": np.arange(one + 1, 2 * one + 1)},
    )


def _ring(radii: Array, z: Array, around: int) -> Array:
    """Positions (around, axial, radial, 3), the first angle at the lowest point."""
    theta = 2.0 * np.pi * np.arange(around) / around
    positions = np.empty((around, len(z), len(radii), 3))
    positions[..., 0] = np.sin(theta)[:, None, None] * radii
    positions[..., 1] = -np.cos(theta)[:, None, None] * radii
    positions[..., 2] = z[:, None]
    return positions


def _numbers(shape: tuple[int, ...]) -> Index:
    return np.arange(1, int(np.prod(shape)) + 1).reshape(shape)


def _cells(numbers: Index, corners: Index) -> Index:
    """Node numbers of all cells of a grid of nodes, array (cells, corners)."""
    cells = [size - 1 for size in numbers.shape]
    parts = [
        numbers[tuple(slice(step, step + size) for step, size in zip(corner, cells, strict=True))]
        for corner in corners
    ]
    return np.stack([part.ravel() for part in parts], axis=1)
