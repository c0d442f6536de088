"""Pictures of the deformed tyre and its spokes."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import PolyCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.patches import Circle
from numpy.typing import NDArray

from nptcs.fe.spoke import SpokeModel
from nptcs.fe.tyre import TyreModel, TyreState

Array = NDArray[np.float64]
COLOURS = "viridis"


def section_cells(model: SpokeModel, displacement: Array) -> tuple[Array, Array]:
    """Deformed cells of the section through the middle of a plate, and their strain.

    Returns
    -------
    corners : array (cells, 4, 2)
        x and z, mm, rim at z = 0.
    strain : array (cells,)
        Largest principal Green–Lagrange strain at the cell's centre.
    """
    across = 2 * (model.design.mesh.plate_columns + model.design.mesh.gap_columns)
    shape = (-1, across, model.mesh.nodes_per_row // across, 3)
    plane = model.design.mesh.plate_columns
    here = model.mesh.positions.reshape(shape)[:, plane][..., [0, 2]]
    there = here + displacement.reshape(shape)[:, plane][..., [0, 2]]
    before, after = (
        np.stack([g[:-1, :-1], g[:-1, 1:], g[1:, 1:], g[1:, :-1]], axis=2).reshape(-1, 4, 2)
        for g in (here, there)
    )
    reference, current = (
        np.stack([cell[:, 1] + cell[:, 2], cell[:, 2] + cell[:, 3]], axis=2)
        - np.stack([cell[:, 0] + cell[:, 3], cell[:, 0] + cell[:, 1]], axis=2)
        for cell in (before, after)
    )
    gradient = current @ np.linalg.inv(reference)
    green = 0.5 * (gradient.swapaxes(1, 2) @ gradient - np.eye(2))
    return after, np.linalg.eigvalsh(green)[:, 1].astype(float)


def tyre_figure(tyre: TyreModel, state: TyreState, spoke: SpokeModel) -> Figure:
    """Draw the loaded tyre, every spoke solved again at its own motion.

    Colour: the largest principal strain in the section through a plate's middle.
    """
    cells, strains = [], []
    last = spoke.rest()
    inner = float(tyre.mesh.radii[0])
    height = spoke.design.geometry.height_mm
    for angle, motion in zip(tyre.mesh.spoke_angle, state.motion, strict=True):
        last = spoke.move(last, motion)
        corners, strain = section_cells(spoke, last.displacement)
        radius = corners[..., 1] + inner - height
        out = np.array([np.sin(angle), -np.cos(angle)])
        along = np.array([np.cos(angle), np.sin(angle)])
        cells.append(radius[..., None] * out + corners[..., :1] * along)
        strains.append(strain)
    shade = Normalize(0.0, float(np.quantile(np.concatenate(strains), 0.99)))
    figure = Figure(figsize=(13.0, 6.5), layout="constrained")
    whole, near = figure.subplots(1, 2)
    ring = _ring_cells(tyre, state)
    for axes in (whole, near):
        _draw(axes, np.concatenate(cells), np.concatenate(strains), ring, shade)
        ground = -float(tyre.mesh.radii[-1]) + state.rise_mm
        axes.axhline(ground, color="black", linewidth=1.0)
        axes.add_patch(Circle((0.0, 0.0), inner - height, fill=False, color="black"))
        axes.set_aspect("equal")
        axes.set_xlabel("x (mm)")
    whole.set_ylabel("y (mm)")
    near.set_xlim(-110.0, 110.0)
    near.set_ylim(ground - 5.0, ground + 140.0)
    load = state.path.force_n[-1]
    whole.set_title(f"{load:.0f} N, {state.rise_mm:.2f} mm")
    bar = figure.colorbar(ScalarMappable(shade, COLOURS), ax=[whole, near], shrink=0.8)
    bar.set_label("largest principal strain")
    return figure


def _ring_cells(tyre: TyreModel, state: TyreState) -> Array:
    moved = (tyre.mesh.positions + state.displacement).reshape(-1, len(tyre.mesh.radii), 2)
    ahead = np.roll(moved, -1, axis=0)
    cells: Array = np.stack(
        [moved[:, :-1], ahead[:, :-1], ahead[:, 1:], moved[:, 1:]], axis=2
    ).reshape(-1, 4, 2)
    return cells


def _draw(axes: Axes, cells: Array, strains: Array, ring: Array, shade: Normalize) -> None:
    spokes = PolyCollection(list(cells), array=strains, cmap=COLOURS, norm=shade, linewidths=0.0)
    axes.add_collection(spokes)
    axes.add_collection(
        PolyCollection(list(ring), facecolor="0.75", edgecolor="0.5", linewidth=0.2)
    )
    axes.autoscale_view()
