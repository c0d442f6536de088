"""Mesh of one axial period of the spoke: quadratic hexahedra in horizontal rows.

Axes: x along the circumference, y along the tyre's axis, z along the radius from rim to band. One
plate lies in y within ± half its width; the period repeats at the pitch, which is the tyre's width
divided by the number of plates and not their spacing. Nodes are numbered row by row, so that the
stiffness matrix is a chain of dense blocks (`nptcs.fe.matrices.block_tridiagonal`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from nptcs.arrays import Array, Index
from nptcs.config.solvers.fe import SpokeGeometry, SpokeMesh

RUBBER_ORDERS = (2, 2, 2)
LAYER_ORDERS = (1, 2, 2)


@dataclass(frozen=True)
class ElementSet:
    """Elements of one kind: node numbers, positions of their nodes (mm) and their leg (0, 1)."""

    nodes: Index
    corners: Array
    leg: Index


@dataclass(frozen=True)
class PeriodMesh:
    """One axial period of a spoke.

    Parameters
    ----------
    positions : array (nodes, 3)
        Reference positions, mm.
    rubber, layer, plate : ElementSet
        Rubber next to the plate's layer, rubber in that layer, and the plate itself.
    nodes_per_row : int
    plate_axes : array (2, 3, 3)
        Local axes of the plates of the lower and the upper leg, as columns: along the leg, along
        the axis, normal.
    """

    positions: Array
    rubber: ElementSet
    layer: ElementSet
    plate: ElementSet
    nodes_per_row: int
    plate_axes: Array

    @property
    def bottom(self) -> Index:
        """Nodes on the rim."""
        return np.arange(self.nodes_per_row)

    @property
    def top(self) -> Index:
        """Nodes on the band."""
        return np.arange(len(self.positions) - self.nodes_per_row, len(self.positions))


def subdivide(breaks: Sequence[float], counts: Sequence[int]) -> Array:
    """Divide each interval between two breaks into equal parts; return all edges, array (edges,).

    Raises
    ------
    ValueError
        If there is not one count for each interval.
    """
    parts = [
        np.linspace(low, high, count, endpoint=False)
        for low, high, count in zip(breaks[:-1], breaks[1:], counts, strict=True)
    ]
    return np.concatenate([*parts, breaks[-1:]])


def _midpoints(edges: Array) -> Array:
    """Insert the middle of each interval: the nodes of quadratic elements."""
    nodes = np.empty(2 * len(edges) - 1)
    nodes[::2] = edges
    nodes[1::2] = 0.5 * (edges[:-1] + edges[1:])
    return nodes


def section_grid(geometry: SpokeGeometry, mesh: SpokeMesh) -> tuple[Array, Array, Array]:
    """Place the nodes of the section.

    Returns
    -------
    rows : array (rows,)
        Heights of the node rows, mm.
    x : array (rows, columns)
        Circumferential positions of the nodes, mm; the plate's layer lies between the two middle
        columns.
    has_plate : array (element rows,) of bool
    """
    heights, thickness = geometry.section()
    lower = subdivide(heights, mesh.rows)
    edges = np.concatenate([lower, geometry.height_mm - lower[-2::-1]])
    rows = _midpoints(edges)
    half = geometry.height_mm / 2.0
    from_end = np.minimum(rows, geometry.height_mm - rows)
    slope = np.radians(geometry.leg_angle_deg)
    centre = -from_end * np.tan(slope)
    wide = np.interp(from_end, heights, thickness) / np.cos(slope) / 2.0
    layer = geometry.plate_layer_mm / np.cos(slope) / 2.0
    side = np.linspace(0.0, 1.0, 2 * mesh.columns + 1)
    left = -wide[:, None] + (wide - layer)[:, None] * side
    offsets = np.concatenate([left, -left[:, ::-1]], axis=1)
    middle = 0.5 * (edges[:-1] + edges[1:])
    middle = np.minimum(middle, geometry.height_mm - middle)
    has_plate = (middle > geometry.plate_foot_gap_mm) & (middle < half - geometry.plate_mid_gap_mm)
    return rows, centre[:, None] + offsets, has_plate


def axial_grid(mesh: SpokeMesh, pitch_mm: float, plate_width_mm: float) -> Array:
    """Axial positions of the node planes, from one edge of a plate to the same edge of the next."""
    half = plate_width_mm / 2.0
    breaks = (-half, half, pitch_mm - half)
    return _midpoints(subdivide(breaks, (mesh.plate_columns, mesh.gap_columns)))


def build_period(
    geometry: SpokeGeometry, mesh: SpokeMesh, pitch_mm: float, plate_width_mm: float
) -> PeriodMesh:
    """Mesh one axial period of a spoke.

    Parameters
    ----------
    geometry : SpokeGeometry
    mesh : SpokeMesh
    pitch_mm : float
        Axial distance from plate to plate.
    plate_width_mm : float

    Raises
    ------
    ValueError
        If the plates touch.
    """
    if pitch_mm <= plate_width_mm:
        raise ValueError(
            f"a pitch of {pitch_mm:g} mm leaves no rubber between plates {plate_width_mm} mm wide"
        )
    rows, x, has_plate = section_grid(geometry, mesh)
    y = axial_grid(mesh, pitch_mm, plate_width_mm)
    across = len(y) - 1
    columns = x.shape[1]
    positions = np.empty((len(rows), across, columns, 3))
    positions[..., 0] = x[:, None, :]
    positions[..., 1] = y[None, :-1, None]
    positions[..., 2] = rows[:, None, None]
    grid = _Grid(rows, y, x)
    inner = 2 * mesh.columns
    starts = [*range(0, inner, 2), *range(inner + 1, columns - 1, 2)]
    every = range(len(has_plate))
    strips = range(across // 2)
    plated = [strip < mesh.plate_columns for strip in strips]
    layer_all = [(r, s) for r in every for s in strips if not (has_plate[r] and plated[s])]
    plate_all = [(r, s) for r in every for s in strips if has_plate[r] and plated[s]]
    slope = np.radians(geometry.leg_angle_deg)
    return PeriodMesh(
        positions=positions.reshape(-1, 3),
        rubber=grid.elements([(r, s, c) for r in every for s in strips for c in starts], 3),
        layer=grid.elements([(r, s, inner) for r, s in layer_all], 2),
        plate=grid.elements([(r, s, inner) for r, s in plate_all], 2),
        nodes_per_row=across * columns,
        plate_axes=np.stack([_leg_axes(-slope), _leg_axes(slope)]),
    )


def _leg_axes(slope: float) -> Array:
    along = np.array([np.sin(slope), 0.0, np.cos(slope)])
    axial = np.array([0.0, 1.0, 0.0])
    return np.stack([along, axial, np.cross(along, axial)], axis=1)


@dataclass(frozen=True)
class _Grid:
    """Node numbers and positions by row, axial place (periodic) and column."""

    rows: Array
    y: Array
    x: Array

    def elements(self, places: list[tuple[int, int, int]], wide: int) -> ElementSet:
        """Elements that start at (element row, element strip, node column), `wide` nodes wide."""
        row, strip, column = np.array(places).T
        c, s, r = (
            part.ravel()
            for part in np.meshgrid(np.arange(wide), np.arange(3), np.arange(3), indexing="ij")
        )
        rows = 2 * row[:, None] + r
        strips = 2 * strip[:, None] + s
        columns = column[:, None] + c
        across = len(self.y) - 1
        nodes = (rows * across + strips % across) * self.x.shape[1] + columns
        corners = np.stack([self.x[rows, columns], self.y[strips], self.rows[rows]], axis=2)
        return ElementSet(nodes, corners, (row >= (len(self.rows) - 1) // 4).astype(np.int64))
