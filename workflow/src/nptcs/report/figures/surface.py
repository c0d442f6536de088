"""Figures of response surfaces: figures 11 and 12 of the paper."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from nptcs.arrays import Array
from nptcs.language import tr, translatable
from nptcs.report.factor_labels import FactorLabel
from nptcs.report.figures.style import (
    BAR_PLACE,
    DASHES,
    MAP,
    MARKERS,
    MOST_MARKS,
    mark_synthetic,
    note_sampled,
    panel,
    sampled,
    styled,
)
from nptcs.report.figures.theme import COLOURS
from nptcs.surface.fit import Surface

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.colors import BoundaryNorm
    from matplotlib.figure import Figure

STIFFNESS = "vertical_stiffness_n_per_mm"
STIFFNESS_LABEL = translatable("vertical stiffness [N/mm]")
GRID = 41
SPARSE = 4
"""Steps of the grid between the points of a surface that a figure carries as numbers."""
MOST_LINES = 7
LEVELS = 12
"""Steps of a colour scale, at most."""
ROUND = (1.0, 2.0, 2.5, 5.0, 10.0)
"""Round steps of a scale, in units of a power of ten."""
ROUNDING = 1e-9
"""Share of a step by which a level may be off only because of rounding."""
INNER = 0.8
"""Share of the width and the height of a panel inside which its lines are named."""
DARK = "#111111"
"""Lines and text on bright colours: black itself would turn white in dark mode."""
CLEAR = 0.12
"""Distance between the name of a line and a mark, as a share of the panel, that is enough."""
BRIGHT = 0.55
"""Brightness of a colour above which text on it is dark."""


def middle_level(levels: Sequence[float]) -> float:
    """Return the middle one of sorted levels (the lower one of two)."""
    ordered = sorted(set(levels))
    return ordered[(len(ordered) - 1) // 2]


def pairs(surface: Surface) -> list[tuple[str, str]]:
    """List the pairs of factors of a surface: each gives one panel."""
    return list(combinations(surface.polynomial.factors, 2))


def _grid(
    surface: Surface, cases: pd.DataFrame, x_name: str, y_name: str
) -> tuple[Array, Array, Array]:
    """Evaluate a surface over two factors, the others at their middle levels."""
    factors = list(surface.polynomial.factors)
    limits = dict(zip(factors, zip(surface.lower, surface.upper, strict=True), strict=True))
    x, y = np.meshgrid(np.linspace(*limits[x_name], GRID), np.linspace(*limits[y_name], GRID))
    columns = {name: np.full(x.size, middle_level(list(cases[name]))) for name in factors}
    columns |= {x_name: x.ravel(), y_name: y.ravel()}
    points = np.column_stack([columns[name] for name in factors])
    return x, y, surface.predict(points).reshape(x.shape)


def evenly(values: Sequence[float], most: int) -> list[float]:
    """Take at most `most` of some values, evenly spaced, with the first and the last.

    Examples
    --------
    >>> evenly([1, 2, 3, 4, 5, 6, 7], 3)
    [1, 4, 7]
    """
    if len(values) <= most:
        return list(values)
    places = np.linspace(0, len(values) - 1, most).round().astype(int)
    return [values[place] for place in places]


def drawn_cases(cases: pd.DataFrame, varied: Sequence[str]) -> pd.DataFrame:
    """Take the cases that a figure draws: all, or of very many those on evenly spaced levels.

    Cases that share no levels, such as those of a Latin hypercube, are taken in even steps.
    """
    if len(cases) <= MOST_MARKS:
        return cases
    per_factor = int(MOST_MARKS ** (1 / len(varied)))
    kept = np.ones(len(cases), dtype=bool)
    for name in varied:
        kept &= cases[name].isin(evenly(sorted(set(cases[name])), per_factor)).to_numpy()
    if kept.sum() >= MOST_MARKS / 4:
        return cases[kept]
    return sampled(cases)


def at_middle(
    surface: Surface, cases: pd.DataFrame, varied: Sequence[str]
) -> tuple[pd.DataFrame, dict[str, float]]:
    """Take the cases whose other factors are at their middle levels, and name these levels."""
    held = {
        name: middle_level(list(cases[name]))
        for name in surface.polynomial.factors
        if name not in varied
    }
    inside = np.ones(len(cases), dtype=bool)
    for name, level in held.items():
        inside &= np.isclose(cases[name], level)
    return cases[inside], held


def _title(solver: str, held: Mapping[str, float], labels: Mapping[str, FactorLabel]) -> str:
    """Name the solver and the levels of the factors that stay fixed."""
    levels = [
        f"{labels[name].label} {level:.4g} {labels[name].unit}".replace(" °", "°")
        for name, level in held.items()
    ]
    if not levels:
        return tr("Stiffness, {solver}", solver=solver)
    return tr("Stiffness, {solver}\nat {levels}", solver=solver, levels=", ".join(levels))


def common_levels(surfaces: Sequence[tuple[Surface, pd.DataFrame]]) -> list[float]:
    """Find the round levels that the figures of one response share, over all panels and solvers.

    Parameters
    ----------
    surfaces : sequence of (Surface, DataFrame)
        Each with its solved cases.
    """
    heights = [
        np.concatenate(
            [
                cases[STIFFNESS],
                *(_grid(surface, cases, *pair)[2].ravel() for pair in pairs(surface)),
            ]
        )
        for surface, cases in surfaces
    ]
    every = np.concatenate(heights)
    return round_levels(float(every.min()), float(every.max()), LEVELS)


def round_levels(low: float, high: float, most: int) -> list[float]:
    """Return round levels with equal steps that enclose a range, with about `most` steps in it.

    Examples
    --------
    >>> round_levels(217.0, 303.0, 12)
    [210.0, 220.0, 230.0, 240.0, 250.0, 260.0, 270.0, 280.0, 290.0, 300.0, 310.0]
    """
    least = (high - low) / most or abs(low) / most or 1.0
    unit = 10.0 ** math.floor(math.log10(least))
    step = next(unit * size for size in ROUND if unit * size >= least * (1 - ROUNDING))
    first = math.floor(low / step + ROUNDING)
    last = max(math.ceil(high / step - ROUNDING), first + 1)
    return [place * step for place in range(first, last + 1)]


@styled
def contours(
    surface: Surface,
    cases: pd.DataFrame,
    pair: tuple[str, str],
    labels: Mapping[str, FactorLabel],
    synthetic: bool = False,
    levels: Sequence[float] = (),
) -> Figure:
    """Draw a surface over two factors, and the cases at the same colour scale.

    A disc that differs from its surroundings is a case that the surface misses.

    Parameters
    ----------
    surface : Surface
        The fitted polynomial.
    cases : DataFrame
        The solved cases of one solver: ``solver``, a column for each factor, the stiffness.
    pair : tuple of str
        Factors on the x and y axis; the others stay at their middle levels.
    labels : mapping of str to FactorLabel
        Labels of the factors.
    synthetic : bool
        Whether the materials are synthetic.
    levels : sequence of float, optional
        Steps of the colour scale, as `common_levels` gives them; else those of this surface.
    """
    import matplotlib as mpl
    from matplotlib.colors import BoundaryNorm

    inside, held = at_middle(surface, cases, pair)
    shown = drawn_cases(inside, pair)
    x, y, z = _grid(surface, cases, *pair)
    title = _title(cases["solver"].iloc[0], held, labels)
    figure, axes = panel(title, str(labels[pair[0]]), str(labels[pair[1]]))
    steps = list(levels) or common_levels([(surface, cases)])
    norm = BoundaryNorm(steps, mpl.colormaps[MAP].N)
    filled = axes.contourf(x, y, z, levels=steps, cmap=MAP, norm=norm)
    _contour_lines(axes, (x, y, z), steps, norm, shown[list(pair)].to_numpy(float))
    axes.scatter(
        shown[pair[0]],
        shown[pair[1]],
        c=shown[STIFFNESS],
        cmap=MAP,
        norm=norm,
        s=42,
        edgecolors="white",
        linewidths=1.0,
        clip_on=False,
        zorder=5,
    )
    beside = figure.add_axes(BAR_PLACE)
    figure.colorbar(filled, beside, label=tr(STIFFNESS_LABEL), ticks=steps[::2], format="%g")
    beside.grid(visible=False)
    note_sampled(axes, len(shown), len(inside), tr("cases"))
    figure.data = _numbers(shown, (x, y, z), pair, held)
    axes.grid(visible=False)
    mark_synthetic(figure, synthetic)
    return figure


def _contour_lines(
    axes: Axes,
    grid: tuple[Array, Array, Array],
    steps: Sequence[float],
    norm: BoundaryNorm,
    marks: Array,
) -> None:
    """Draw the lines between the steps and name them, dark on bright colours and bright on dark.

    A line is named once, away from the marks of the cases (rows of x and y); one that only crosses
    a corner is not named, because its name would reach over the edge.
    """
    import matplotlib as mpl

    colours = [_readable_on(mpl.colormaps[MAP](norm(step))) for step in steps]
    lines = axes.contour(*grid, levels=steps, colors=colours, linewidths=0.6)
    places = []
    for pieces in lines.allsegs:
        longest = max(pieces, key=len, default=np.empty((0, 2)))
        inside = longest[np.all(np.abs(_in_axes(axes, longest) - 0.5) < INNER / 2, axis=1)]
        if len(inside):
            places.append(tuple(_off_marks(axes, inside, marks)))
    if places:
        axes.clabel(lines, fmt="%g", fontsize=7, manual=places)


def _off_marks(axes: Axes, points: Array, marks: Array) -> Array:
    """Choose the point nearest to the middle of a line among those farthest from all marks."""
    away = _in_axes(axes, points)[:, None] - _in_axes(axes, marks)[None]
    nearest = np.hypot(*away.transpose(2, 0, 1)).min(axis=1, initial=np.inf)
    clear = np.minimum(nearest, CLEAR)
    from_middle = np.abs(np.arange(len(points)) - len(points) // 2)
    return points[np.lexsort((from_middle, -clear))[0]]


def _in_axes(axes: Axes, points: Array) -> Array:
    """Return points as fractions of the axes' width and height."""
    low, high = np.array([axes.get_xlim(), axes.get_ylim()]).T
    return (points - low) / (high - low)


def _readable_on(colour: tuple[float, float, float, float]) -> str:
    """Choose dark or white for lines and text on a colour, by its brightness (ITU-R BT.709)."""
    brightness = float(np.dot(colour[:3], (0.2126, 0.7152, 0.0722)))
    return DARK if brightness > BRIGHT else "white"


def _numbers(
    shown: pd.DataFrame,
    grid: tuple[Array, Array, Array],
    pair: tuple[str, str],
    held: Mapping[str, float],
) -> pd.DataFrame:
    """Gather the cases of a panel, and the surface at every `SPARSE`-th point of its grid."""
    x, y, z = (part[::SPARSE, ::SPARSE].ravel() for part in grid)
    surface = pd.DataFrame({pair[0]: x, pair[1]: y, **held, STIFFNESS: z, "what": "surface"})
    return pd.concat([shown.assign(what="case")[list(surface)], surface], ignore_index=True)


def _line_levels(
    surface: Surface, shown: pd.DataFrame, varied: Sequence[str]
) -> Sequence[float | None]:
    """List the levels that get a line: those of the cases shown, else ends and middle."""
    if len(varied) == 1:
        return [None]
    if len(shown):
        return evenly(sorted(set(shown[varied[1]])), MOST_LINES)
    axis = surface.factors.index(varied[1])
    low, high = float(surface.lower[axis]), float(surface.upper[axis])
    return [low, (low + high) / 2, high]


@styled
def slices(
    surface: Surface,
    cases: pd.DataFrame,
    varied: Sequence[str],
    labels: Mapping[str, FactorLabel],
    synthetic: bool = False,
    limits: Sequence[float] = (),
) -> Figure:
    """Draw the stiffness over one factor, a line for each level of a second one if there is one.

    Lines are the surface, marks are the cases; the other factors are at their middle levels.

    Parameters
    ----------
    surface, cases, labels, synthetic
        As in `contours`.
    varied : sequence of str
        The factor on the x axis, then the one whose levels make the lines.
    limits : sequence of float, optional
        The first and the last of these levels end the axis of the stiffness, to compare solvers.
    """
    shown, held = at_middle(surface, cases, varied)
    title = _title(cases["solver"].iloc[0], held, labels)
    figure, axes = panel(title, str(labels[varied[0]]), STIFFNESS_LABEL)
    factors = list(surface.polynomial.factors)
    axis = factors.index(varied[0])
    x = np.linspace(surface.lower[axis], surface.upper[axis], GRID)
    levels = _line_levels(surface, shown, varied)
    parts = []
    for number, level in enumerate(levels):
        inside = shown if level is None else shown[shown[varied[1]] == level]
        at_level = drawn_cases(inside, varied[:1])
        fixed = held if level is None else {**held, varied[1]: level}
        points = np.column_stack(
            [x if name == varied[0] else np.full(GRID, fixed[name]) for name in factors]
        )
        colour = COLOURS[number % len(COLOURS)]
        height = surface.predict(points)
        axes.plot(x, height, color=colour, linestyle=DASHES[number % len(DASHES)])
        line = pd.DataFrame(points, columns=factors).assign(what="surface", **{STIFFNESS: height})
        parts += [at_level[[*factors, STIFFNESS]].assign(what="case"), line]
        axes.plot(
            at_level[varied[0]],
            at_level[STIFFNESS],
            linestyle="none",
            color=colour,
            marker=MARKERS[number % len(MARKERS)],
            label=tr("cases") if level is None else f"{level:.4g}",
        )
        note_sampled(axes, len(at_level), len(inside), tr("cases per line"))
    if len(limits):
        axes.set_ylim(limits[0], limits[-1])
    legend_title = str(labels[varied[1]]) if len(varied) > 1 else None
    figure.legend(title=legend_title, ncols=5, loc="outside lower center")
    figure.data = pd.concat(parts, ignore_index=True)[[*factors, STIFFNESS, "what"]]
    mark_synthetic(figure, synthetic)
    return figure
