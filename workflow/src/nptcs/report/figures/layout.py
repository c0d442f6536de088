"""Room around the axes of a panel for its words: measured once.

A panel has one pair of axes, at most one colour bar beside them, and legends below. For that,
Matplotlib's constrained layout solves a system of constraints and measures every text nine times,
which took two fifths of the time of a figure. Here the words around the axes are measured once, and
the axes get what is left of the figure.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.backend_bases import RendererBase
from matplotlib.figure import Figure
from matplotlib.layout_engine import LayoutEngine
from matplotlib.legend import Legend
from matplotlib.text import Text
from matplotlib.transforms import Bbox, IdentityTransform, blended_transform_factory

PAD = 3.0
"""Least distance between words and the edge of the figure, in points."""

LEGEND_PAD = 6.0
"""Distance between the words below the axes and a legend, in points."""

LEAST = 7.0
"""Least room beside the axes, in points: marks at their edge reach over it."""

BAR_PAD, BAR_SLIMNESS = 9.0, 20.0
"""Distance of a colour bar from the axes, in points, and its height over its width."""


class Chart(Figure):
    """A figure together with the numbers that it shows."""

    data: pd.DataFrame | None = None


class Room(NamedTuple):
    """How far the words around a pair of axes reach beyond them, in points."""

    left: float
    bottom: float
    right: float
    top: float


class PanelLayout(LayoutEngine):
    """Gives the axes of a panel what their words, a colour bar and the legends below leave."""

    _adjust_compatible = False
    _colorbar_gridspec = False

    def execute(self, fig: Any) -> None:
        """Place axes, colour bar and the labels of their axes."""
        renderer = fig.canvas.get_renderer()
        width, height = fig.bbox.size
        axes, *bars = fig.axes
        axes.apply_aspect()
        titles = words_of(axes) - set(axes.texts)
        for title in titles:
            title.set_y(1)
        ticks = {axis: tick_room(axis, renderer) for one in fig.axes for axis in axes_of(one)}
        room = around(axes, ticks, renderer)
        below = max((legend_height(one, renderer) for one in fig.legends), default=0.0)
        lift = power_height(axes.yaxis, renderer)
        left, bottom = PAD + max(room.left, LEAST), PAD + room.bottom + below
        right, top = PAD + max(room.right, LEAST), PAD + max(room.top + lift, LEAST)
        tall = height - bottom - top
        beside = 0.0
        for bar in bars:
            beside = BAR_PAD + tall / BAR_SLIMNESS + around(bar, ticks, renderer).right - LEAST
        wide = width - left - right - beside
        place(axes, (left, bottom, wide, tall))
        for bar in bars:
            place(bar, (left + wide + BAR_PAD, bottom, tall / BAR_SLIMNESS, tall))
        for axis, reach in ticks.items():
            place_label(axis, reach)
        for title in titles:
            title.set_y(1 + lift / axes.bbox.height)


def axes_of(axes: Axes) -> tuple[Axis, Axis]:
    """Return both axes of a pair."""
    return axes.xaxis, axes.yaxis


def tick_room(axis: Axis, renderer: RendererBase) -> Room:
    """Measure how far the labels of the ticks that are drawn reach beyond the axes."""
    axis.get_ticklabels()  # brings them up to date
    low, high = sorted(axis.get_view_interval())
    margin = 1e-9 * (high - low)
    boxes = [
        label.get_window_extent(renderer)
        for tick in axis.get_major_ticks()
        if low - margin <= tick.get_loc() <= high + margin
        for label in (tick.label1, tick.label2)
        if label.get_visible() and label.get_text()
    ]
    return beyond(axis.axes, boxes)


def beyond(axes: Axes, boxes: list[Bbox]) -> Room:
    """Measure how far boxes reach beyond axes."""
    inner = axes.bbox
    outer = Bbox.union([inner, *boxes])
    return Room(inner.x0 - outer.x0, inner.y0 - outer.y0, outer.x1 - inner.x1, outer.y1 - inner.y1)


def around(axes: Axes, ticks: dict[Axis, Room], renderer: RendererBase) -> Room:
    """Measure the room that axes need on each side: ticks, labels of the axes, title, notes.

    A title or label may be longer than the axes without taking room from them.
    """
    x, y = (ticks[axis] for axis in axes_of(axes))
    boxes = {text: text.get_window_extent(renderer) for text in words_of(axes)}
    notes = beyond(axes, [box for text, box in boxes.items() if text in axes.texts])
    above = beyond(axes, list(boxes.values()))
    sides = [max(three) for three in zip(x, y, notes, strict=True)]
    left, bottom, right, _ = sides
    bottom += label_size(axes.xaxis, renderer)
    if axes.yaxis.get_label_position() == "left":
        left += label_size(axes.yaxis, renderer)
    else:
        right += label_size(axes.yaxis, renderer)
    return Room(left, bottom, right, max(x.top, y.top, above.top))


def words_of(axes: Axes) -> set[Text]:
    """Return the title of axes and the notes in them."""
    texts = [one for one in axes.get_children() if isinstance(one, Text)]
    return {text for text in texts if text.get_text() and text.get_visible()}


def power_height(axis: Axis, renderer: RendererBase) -> float:
    """Return the height of the power of ten above a y axis, which a title must not cover."""
    power = axis.get_offset_text()
    power.set_text(axis.get_major_formatter().get_offset())
    if not power.get_text():
        return 0.0
    return power.get_window_extent(renderer).height + axis.OFFSETTEXTPAD


def label_size(axis: Axis, renderer: RendererBase) -> float:
    """Return the height of the label of an axis across it, with its distance from the ticks."""
    if not axis.label.get_text():
        return 0.0
    box = axis.label.get_window_extent(renderer)
    return axis.labelpad + (box.height if axis is axis.axes.xaxis else box.width)


def legend_height(legend: Legend, renderer: RendererBase) -> float:
    """Return the height of a legend with its distance from the words above it."""
    return legend.get_window_extent(renderer).height + LEGEND_PAD


def place(axes: Axes, points: tuple[float, float, float, float]) -> None:
    """Put axes at left, bottom, width, height in points of the figure."""
    figure: Figure = axes.figure  # type: ignore[assignment]
    width, height = figure.bbox.size
    left, bottom, wide, tall = points
    axes.set_position((left / width, bottom / height, wide / width, tall / height))
    axes.apply_aspect()


def place_label(axis: Axis, ticks: Room) -> None:
    """Put the label of an axis beyond its ticks."""
    axes = axis.axes
    points = IdentityTransform()
    if axis is axes.xaxis:
        below = axes.bbox.y0 - ticks.bottom - axis.labelpad
        axis.set_label_coords(0.5, below, blended_transform_factory(axes.transAxes, points))
        return
    if axis.get_label_position() == "left":
        beside = axes.bbox.x0 - ticks.left - axis.labelpad
    else:
        beside = axes.bbox.x1 + ticks.right + axis.labelpad
    axis.set_label_coords(beside, 0.5, blended_transform_factory(points, axes.transAxes))
