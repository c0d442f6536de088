"""Picture of the single spoke, pulled and compressed, with the stress of rubber and fibres."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import PolyCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from nptcs.arrays import Array, Mask
from nptcs.fe.output.fields import at_points, fibre_stress, rubber_at
from nptcs.fe.spoke.equilibrium import SpokeModel, SpokeState
from nptcs.fe.spoke.mesh import LAYER_ORDERS, RUBBER_ORDERS, ElementSet
from nptcs.fe.spoke.pull import COMPRESSION_MM, TENSION_MM, walk

COLOURS = "viridis"
# points of the plates' rule across and along them
GAUSS = 3


@dataclass(frozen=True)
class SectionStress:
    """The deformed section through the middle of a plate.

    Parameters
    ----------
    rubber, plate : arrays (cells, 4, 2)
        Corners of drawn cells, x and z in mm.
    mises_mpa : array (cells of rubber,)
    height_mm : array (points,)
        Unloaded height of points along the plates, rising.
    fibre_mpa : array (points, 2)
        Stress along the fibres near the faces of the plies +A and -A.
    """

    rubber: Array
    mises_mpa: Array
    plate: Array
    height_mm: Array
    fibre_mpa: Array


def section_stress(model: SpokeModel, state: SpokeState, fine: int = 12) -> SectionStress:
    """Stress in the section through the middle of a plate.

    Parameters
    ----------
    model : SpokeModel
        Its groups are given the pressures of the state.
    state : SpokeState
    fine : int
        Drawn cells along each side of an element.
    """
    quads, stresses = [], []
    for group, pressure, elements, orders in zip(
        model.rubbers,
        state.pressures,
        (model.mesh.rubber, model.mesh.layer),
        (RUBBER_ORDERS, LAYER_ORDERS),
        strict=True,
    ):
        group.pressure = pressure
        cut, points = _cut(elements, fine)
        if not cut.any():
            continue
        quads.append(_quads(elements, cut, orders, state.displacement, points))
        fields = rubber_at(group, orders, elements.corners, state.displacement, points)
        stresses.append(corners(fields.mises[cut]).mean(axis=2).ravel())
    plate = model.mesh.plate
    cut, points = _cut(plate, fine)
    height, fibre = _profile(model, state, cut, points[0, 1])
    return SectionStress(
        np.concatenate(quads),
        np.concatenate(stresses),
        _quads(plate, cut, LAYER_ORDERS, state.displacement, points),
        height,
        fibre,
    )


def _profile(model: SpokeModel, state: SpokeState, cut: Mask, across: float) -> tuple[Array, Array]:
    """Heights and fibre stress of the Gauss points nearest to the section and to the faces."""
    fibres = fibre_stress(model.plates[0], state.displacement, model.design.angle_deg)
    line = np.polynomial.legendre.leggauss(GAUSS)[0]
    # points: through both plies, across, along
    fibres = fibres.reshape(len(fibres), -1, GAUSS, GAUSS)[cut]
    faces = fibres[:, [0, -1], int(np.abs(line - across).argmin())]
    low, high = (f(model.mesh.plate.corners[cut][..., 2], axis=1) for f in (np.min, np.max))
    height = 0.5 * (low + high)[:, None] + 0.5 * (high - low)[:, None] * line
    order = np.argsort(height.ravel())
    return height.ravel()[order], faces.swapaxes(1, 2).reshape(-1, 2)[order]


def _cut(elements: ElementSet, fine: int) -> tuple[Mask, Array]:
    """Elements that the plane y = 0 cuts, and local points in it, the same for all of them."""
    low, high = elements.corners[..., 1].min(axis=1), elements.corners[..., 1].max(axis=1)
    cut = (low <= 0.0) & (high > 0.0)
    line = np.linspace(-1.0, 1.0, fine + 1)
    across = -1.0 - 2.0 * low[cut][0] / (high - low)[cut][0] if cut.any() else 0.0
    c, r = (part.ravel() for part in np.meshgrid(line, line, indexing="ij"))
    return cut, np.stack([c, np.full(len(c), across), r], axis=1)


def corners(values: Array) -> Array:
    """Values at the four corners of the cells between the points of a square grid.

    Parameters
    ----------
    values : array (elements, n², …)

    Returns
    -------
    array (elements, (n - 1)², 4, …)
    """
    side = round(values.shape[1] ** 0.5)
    grid = values.reshape(len(values), side, side, *values.shape[2:])
    four = [grid[:, :-1, :-1], grid[:, 1:, :-1], grid[:, 1:, 1:], grid[:, :-1, 1:]]
    return np.stack(four, axis=3).reshape(len(values), -1, 4, *values.shape[2:])


def _quads(
    elements: ElementSet,
    cut: Mask,
    orders: tuple[int, int, int],
    displacement: Array,
    points: Array,
) -> Array:
    position, moved = at_points(elements, orders, displacement, points)
    quads: Array = corners((position + moved)[cut][..., [0, 2]]).reshape(-1, 4, 2)
    return quads


def spoke_figure(model: SpokeModel) -> Figure:
    """Draw the spoke pulled by 4 mm and compressed by 20 mm, the ends of figure 13's curves.

    The band does not turn.

    Colour: von Mises stress of the rubber, the plates dark. Next to it the stress along the fibres
    near the faces of both plies.
    """
    ends = [walk(model, TENSION_MM, 4)[-1], walk(model, -COMPRESSION_MM, 10)[-1]]
    rest = section_stress(model, model.rest())
    figure = Figure(figsize=(12.0, 6.5), layout="constrained")
    panels = figure.subplots(1, 3, sharey=True, width_ratios=(0.8, 1.1, 1.0))
    for axes, state, colour in zip(panels[:2], ends, ("tab:red", "tab:blue"), strict=True):
        section = section_stress(model, state)
        _draw(axes, rest, section)
        label = f"{state.motion[0]:+g} mm"
        axes.set_title(f"{label}, {state.force[0]:+.0f} N per spoke")
        for ply, style in enumerate(("-", "--")):
            panels[2].plot(
                *_broken(section.fibre_mpa[:, ply], section.height_mm, model),
                style,
                marker=".",
                color=colour,
                label=f"{label}, ply {'+-'[ply]}{model.design.angle_deg:g}°",
            )
    panels[0].set_ylabel("z, from the rim (mm)")
    panels[2].set_xlabel("stress along the fibres (MPa)")
    panels[2].set_title("plates, by unloaded z")
    panels[2].axvline(0.0, color="0.7", linewidth=0.8)
    figure.legend(loc="outside lower right", ncols=4)
    return figure


def _broken(stress: Array, height: Array, model: SpokeModel) -> tuple[Array, Array]:
    """Break the line between the two plates."""
    place = int(np.searchsorted(height, model.design.geometry.height_mm / 2.0))
    return np.insert(stress, place, np.nan), np.insert(height, place, np.nan)


def _draw(axes: Axes, rest: SectionStress, section: SectionStress) -> None:
    """Draw a section over the pale unloaded one."""
    for quads in (rest.rubber, rest.plate):
        axes.add_collection(PolyCollection(list(quads), color="0.9", linewidths=0.2))
    norm = Normalize(0.0, float(np.quantile(section.mises_mpa, 0.995)))
    axes.add_collection(
        PolyCollection(
            list(section.rubber),
            array=section.mises_mpa,
            cmap=COLOURS,
            norm=norm,
            edgecolors="face",
            linewidths=0.2,
        )
    )
    axes.add_collection(PolyCollection(list(section.plate), color="0.15", linewidths=0.2))
    bar = axes.figure.colorbar(ScalarMappable(norm, COLOURS), ax=axes, shrink=0.8, extend="max")
    bar.set_label("rubber: von Mises (MPa)")
    axes.autoscale_view()
    axes.set_aspect("equal")
    axes.set_xlabel("x, circumference (mm)")
