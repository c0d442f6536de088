"""Picture of the deformed tyre with all its spokes and the stress of its rubber."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import PolyCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from nptcs.arrays import Array
from nptcs.fe.elements.lagrange import tensor_shape
from nptcs.fe.output.bricks import RING_ORDERS
from nptcs.fe.output.fields import lattice, rubber_at
from nptcs.fe.output.spoke_picture import COLOURS, corners, section_stress
from nptcs.fe.spoke.equilibrium import SpokeModel
from nptcs.fe.tyre.equilibrium import TyreModel, TyreState

# drawn cells along each side of an element
FINE = 4


def ring_stress(tyre: TyreModel, state: TyreState) -> tuple[Array, Array]:
    """Deformed cells (cells, 4, 2) of band and tread, mm, and their von Mises stress, MPa."""
    points = lattice(FINE + 1, 2)
    quads, stresses = [], []
    for group in tyre.rubbers:
        orders = RING_ORDERS[group.nodes.shape[1]]
        shape, _ = tensor_shape(orders, points)
        position = tyre.mesh.positions[group.nodes]
        moved = position + state.displacement[group.nodes]
        fields = rubber_at(group, orders, position, state.displacement, points)
        quads.append(corners(np.einsum("gn,eni->egi", shape, moved)).reshape(-1, 4, 2))
        stresses.append(corners(fields.mises).mean(axis=2).ravel())
    return np.concatenate(quads), np.concatenate(stresses)


def tyre_figure(tyre: TyreModel, state: TyreState, spoke: SpokeModel) -> Figure:
    """Draw the loaded tyre, every spoke solved again at its own motion.

    Colour: von Mises stress of the rubber, the spokes in the section through a plate's middle.
    """
    cells: list[Array] = []
    plates: list[Array] = []
    stresses = []
    last = spoke.rest()
    inner = float(tyre.mesh.radii[0])
    height = spoke.design.geometry.height_mm
    for angle, motion in zip(tyre.mesh.spoke_angle, state.motion, strict=True):
        last = spoke.move(last, motion)
        section = section_stress(spoke, last, FINE)
        out = np.array([np.sin(angle), -np.cos(angle)])
        along = np.array([np.cos(angle), np.sin(angle)])
        for quads, kept in ((section.rubber, cells), (section.plate, plates)):
            kept.append((quads[..., 1:] + inner - height) * out + quads[..., :1] * along)
        stresses.append(section.mises_mpa)
    spokes = np.concatenate(stresses)
    ring, band = ring_stress(tyre, state)
    shade = Normalize(0.0, float(np.quantile(spokes, 0.995)))
    figure = Figure(figsize=(15.0, 6.5), layout="constrained")
    whole, near = figure.subplots(1, 2, width_ratios=(1.0, 1.35))
    for axes in (whole, near):
        _draw(axes, np.concatenate([*cells, ring]), np.concatenate([spokes, band]), shade)
        dark = PolyCollection(list(np.concatenate(plates)), color="0.15", linewidths=0.2)
        axes.add_collection(dark)
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
    bar = figure.colorbar(ScalarMappable(shade, COLOURS), ax=[whole, near], extend="max")
    bar.set_label("rubber: von Mises stress (MPa); plates dark")
    return figure


def _draw(axes: Axes, cells: Array, stresses: Array, shade: Normalize) -> None:
    axes.add_collection(
        PolyCollection(
            list(cells),
            array=stresses,
            cmap=COLOURS,
            norm=shade,
            edgecolors="face",
            linewidths=0.2,
        )
    )
    axes.autoscale_view()
