"""Outlines of the spokes, plates and band of a loaded tyre, as in figure 10 a of the paper."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pandas as pd

from nptcs.arrays import Array
from nptcs.fe.output.spoke_picture import section_stress
from nptcs.fe.spoke.equilibrium import SpokeModel
from nptcs.fe.tyre.equilibrium import TyreModel, TyreState

CELLS = 1
"""Drawn cells along each side of an element."""

SAME_MM = 1e-6
"""Corners of neighbouring cells that are no further apart than this are one point."""

RIM_POINTS = 180

COORDINATES = ["x_mm", "y_mm", "x_undeformed_mm", "y_undeformed_mm"]


def outlines(cells: Array) -> list[list[int]]:
    """Find the closed lines around a set of cells: the edges that belong to one cell only.

    Parameters
    ----------
    cells : array (cells, 4, 2)
        Corners of each cell in order around it, mm.

    Returns
    -------
    list of lists of int
        Indices of each line's points in the flattened corners, in order along it.

    Examples
    --------
    Two unit squares next to each other have one outline of six points:

    >>> square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    >>> [len(line) for line in outlines(np.array([square, square + [1.0, 0.0]]))]
    [6]
    """
    corners = cells.reshape(-1, 2)
    _, first, same = np.unique(
        np.rint(corners / SAME_MM).astype(np.int64), axis=0, return_index=True, return_inverse=True
    )
    loops = same.reshape(-1, 4)
    edges = np.stack([loops, np.roll(loops, -1, axis=1)], axis=-1).reshape(-1, 2)
    often = Counter(tuple(sorted(edge)) for edge in edges.tolist())
    outer = [edge for edge in edges.tolist() if often[tuple(sorted(edge))] == 1]
    return [first[line].tolist() for line in _chained(outer)]


def _chained(edges: list[list[int]]) -> list[list[int]]:
    """Join edges end to end until each line closes."""
    at: dict[int, list[int]] = {}
    for number, (start, end) in enumerate(edges):
        at.setdefault(start, []).append(number)
        at.setdefault(end, []).append(number)
    left, lines = set(range(len(edges))), []
    while left:
        start, here = edges[min(left)]
        left.discard(min(left))
        line = [start]
        while here != start:
            line.append(here)
            onward = [number for number in at[here] if number in left]
            if not onward:
                break
            left.discard(onward[0])
            here = sum(edges[onward[0]]) - here
        lines.append(line)
    return lines


def tyre_outlines(tyre: TyreModel, state: TyreState, spoke: SpokeModel) -> pd.DataFrame:
    """Draw the outlines of a loaded tyre, every spoke solved again at its own motion.

    Parameters
    ----------
    tyre : TyreModel
    state : TyreState
        Of this tyre.
    spoke : SpokeModel
        Of its spokes.

    Returns
    -------
    DataFrame
        ``part, outline, x_mm, y_mm, x_undeformed_mm, y_undeformed_mm``: the last columns of
        `nptcs.tables.tyres.deformed_tyre.DeformedTyre`.

    Raises
    ------
    SpokeError
        If a spoke has no equilibrium at its motion.
    """
    last = spoke.rest()
    rest = section_stress(spoke, last, CELLS)
    lines = [("spoke", line) for line in outlines(rest.rubber)]
    lines += [("plate", line) for line in outlines(rest.plate)]
    inner = float(tyre.mesh.radii[0])
    rim = inner - spoke.design.geometry.height_mm
    parts: list[tuple[str, Array, Array]] = []
    for angle, motion in zip(tyre.mesh.spoke_angle, state.motion, strict=True):
        last = spoke.move(last, motion)
        moved = section_stress(spoke, last, CELLS)
        for part, line in lines:
            before, after = (
                _placed(getattr(section, CELLS_OF[part]).reshape(-1, 2)[line], angle, rim)
                for section in (rest, moved)
            )
            parts.append((part, before, after))
    parts += _band(tyre, state)
    turn = np.linspace(0.0, 2.0 * np.pi, RIM_POINTS, endpoint=False)
    circle = rim * np.column_stack([np.sin(turn), -np.cos(turn)])
    parts.append(("rim", circle, circle))
    return pd.concat([_rows(number, *part) for number, part in enumerate(parts)], ignore_index=True)


CELLS_OF = {"spoke": "rubber", "plate": "plate"}
"""Cells of a section that make up each part."""


def _placed(points: Array, angle: float, rim_mm: float) -> Array:
    """Place points of a spoke's section (along the band, above the rim) in the tyre's plane."""
    out = np.array([np.sin(angle), -np.cos(angle)])
    along = np.array([np.cos(angle), np.sin(angle)])
    placed: Array = (points[:, 1:] + rim_mm) * out + points[:, :1] * along
    return placed


def _band(tyre: TyreModel, state: TyreState) -> list[tuple[str, Array, Array]]:
    """Inner and outer line of band and tread."""
    positions, rows = tyre.mesh.positions, len(tyre.mesh.radii)
    moved = positions + state.displacement
    return [("band", positions[row::rows], moved[row::rows]) for row in (0, rows - 1)]


def _rows(number: int, part: str, before: Array, after: Array) -> pd.DataFrame:
    columns = np.round(np.column_stack([after, before]), 3) + 0.0
    rows = pd.DataFrame(columns, columns=COORDINATES)
    rows.insert(0, "outline", number)
    rows.insert(0, "part", part)
    return rows
