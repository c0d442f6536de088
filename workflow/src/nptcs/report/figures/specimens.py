"""Figures of tested specimens: figures 2 and 4 of the paper."""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd

from nptcs.language import tr, translatable
from nptcs.report.figures.style import DASHES, mark_synthetic, panel, styled
from nptcs.report.figures.theme import COLOURS, GREY, INK
from nptcs.report.text import text_width

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

DRAWN_POINTS = 200
"""Readings of a curve that are drawn; the curve files contain all of them."""

LEGEND_CHARACTERS = 72
"""Characters of the names of curves that fit on one line below a panel."""

SIGN_CHARACTERS = 8
"""Space that the legend mark of a curve takes there, in characters."""

MOST_NAMED = 8
"""Specimens of a panel beyond which they are not named one by one."""


@dataclass(frozen=True)
class Axis:
    """The two quantities that a curve is drawn in: names of columns, and labels.

    Parameters
    ----------
    strain, stress : str
        Columns of the curves.
    strain_words, stress_words : str
        Labels with units; strain is drawn in percent.
    """

    strain: str
    stress: str
    strain_words: str
    stress_words: str


NORMAL = Axis(
    "strain_axial",
    "stress_mpa",
    translatable("nominal strain [%]"),
    translatable("nominal stress [MPa]"),
)
SHEAR = Axis(
    "shear_strain",
    "shear_stress_mpa",
    translatable("shear strain γ12 [%]"),
    translatable("shear stress τ12 [MPa]"),
)


@dataclass(frozen=True)
class Moduli:
    """Moduli that a panel draws over its curves.

    Parameters
    ----------
    chords : DataFrame
        ``specimen, value, range_low, range_high``: rows of ``specimens.csv``.
    mean_mpa : float
        Mean of the group; NaN for none.
    published_mpa : float
        The paper's modulus; NaN for none.
    symbol : str
        Such as E1.
    sign : int
        -1 for compression, whose curves are negative and whose moduli are not.
    """

    chords: pd.DataFrame
    mean_mpa: float
    published_mpa: float
    symbol: str
    sign: int = 1


def evenly_spaced(curve: pd.DataFrame, axis: Axis = NORMAL) -> pd.DataFrame:
    """Take evenly spaced readings that have a strain, and the one with the largest stress."""
    curve = curve[curve[axis.strain].notna()]
    if len(curve) <= DRAWN_POINTS:
        return curve
    rows = np.linspace(0, len(curve) - 1, DRAWN_POINTS).round().astype(int)
    largest = int(np.argmax(np.abs(curve[axis.stress].to_numpy())))
    return curve.iloc[np.union1d(rows, [largest])]


@styled
def stress_strain(
    title: str,
    curves: Mapping[str, pd.DataFrame],
    left_out: Sequence[str],
    synthetic: bool = False,
    moduli: Moduli | None = None,
    axis: Axis = NORMAL,
) -> Figure:
    """Draw the curves of one series, with the chord of each modulus, figure 2 of the paper.

    Specimens that the sheet leaves out are dashed grey. A chord is a bold line in its curve's
    colour between the strains that the standard names; lines through the origin have the slope of
    the mean and of the paper's modulus.

    Parameters
    ----------
    title : str
        Name of the series.
    curves : mapping of str to DataFrame
        Curves with the columns of `axis` by specimen.
    left_out : sequence of str
        Specimens that enter no result.
    synthetic : bool
        Whether any of them is synthetic.
    moduli : Moduli, optional
        The chords, and the slopes drawn through the origin.
    axis : Axis
        Axial stress over axial strain, or shear stress over shear strain.
    """
    figure, axes = panel(title, axis.strain_words, axis.stress_words)
    parts: list[pd.DataFrame] = []
    colours: dict[str, str] = {}
    for specimen, curve in curves.items():
        drawn = evenly_spaced(curve, axis)
        if drawn.empty:
            continue
        _draw_curve(axes, specimen, drawn, axis, colours, specimen in left_out)
        parts.append(drawn[[axis.strain, axis.stress]].assign(specimen=specimen, what="curve"))
    if moduli is not None:
        parts += _draw_moduli(axes, moduli, curves, axis, colours)
    _name_lines(axes, len(colours))
    if parts:
        columns = ["specimen", "what", axis.strain, axis.stress]
        figure.data = pd.concat(parts, ignore_index=True)[columns]
    mark_synthetic(figure, synthetic)
    return figure


def _name_lines(axes: Axes, specimens: int) -> None:
    """Name the curves below the axes, where few enough, and the slopes in their empty corner."""
    lines, labels = axes.get_legend_handles_labels()
    if lines[specimens:]:
        axes.legend(lines[specimens:], labels[specimens:], loc="lower right", fontsize=7)
    if 0 < specimens <= MOST_NAMED:
        longest = max(map(text_width, labels[:specimens]))
        axes.figure.legend(
            lines[:specimens],
            labels[:specimens],
            loc="outside lower center",
            ncols=max(1, int(LEGEND_CHARACTERS / (longest + SIGN_CHARACTERS))),
            fontsize=7,
        )


def _draw_curve(
    axes: Axes,
    specimen: str,
    drawn: pd.DataFrame,
    axis: Axis,
    colours: dict[str, str],
    out: bool,
) -> None:
    """Draw one curve; its end is marked if it is left out."""
    used = len([colour for colour in colours.values() if colour != GREY])
    colours[specimen] = GREY if out else COLOURS[used % len(COLOURS)]
    again = (used // len(COLOURS)) % len(DASHES)
    axes.plot(
        100 * drawn[axis.strain],
        drawn[axis.stress],
        color=colours[specimen],
        linestyle="--" if out else DASHES[again],
        linewidth=1.6 if out else 1.0,
        marker="x" if out else None,
        markevery=[len(drawn) - 1],
        markersize=7,
        zorder=3 if out else 2,
        label=tr("{specimen} (left out)", specimen=specimen) if out else specimen,
    )


def _draw_moduli(
    axes: Axes,
    moduli: Moduli,
    curves: Mapping[str, pd.DataFrame],
    axis: Axis,
    colours: Mapping[str, str],
) -> list[pd.DataFrame]:
    """Draw the chords and the slopes through the origin; return their ends."""
    sign, parts = moduli.sign, []
    for row in moduli.chords.to_dict("records"):
        if row["specimen"] not in colours:
            continue
        ends = chord_ends(curves[str(row["specimen"])], row, axis, sign)
        strain, stress = ends[axis.strain], ends[axis.stress]
        look: dict[str, Any] = {
            "color": colours[row["specimen"]],
            "linewidth": 3.2,
            "solid_capstyle": "butt",
        }
        axes.plot(100 * strain, stress, zorder=4, **look)
        parts.append(ends.assign(specimen=row["specimen"], what="chord"))
    lines = axes.get_lines()
    largest = max((np.abs(line.get_ydata()).max() for line in lines), default=1.0)
    for value, words, dash in (
        (moduli.mean_mpa, translatable("mean of the chords"), "-."),
        (moduli.published_mpa, translatable("paper, table 2"), (0, (1.2, 1.6))),
    ):
        if np.isfinite(value):
            end = sign * np.array([0.0, 0.62 * largest])
            label = f"{tr(words)}: {moduli.symbol} {value / 1000:.4g} GPa"
            line: dict[str, Any] = {"color": INK, "linewidth": 1.1, "linestyle": dash, "zorder": 5}
            axes.plot(100 * end / value, end, label=label, **line)
            ends = pd.DataFrame({axis.strain: end / value, axis.stress: end})
            parts.append(ends.assign(specimen="", what=words))
    return parts


def chord_ends(
    curve: pd.DataFrame, chord: Mapping[Hashable, Any], axis: Axis, sign: int = 1
) -> pd.DataFrame:
    """Return the ends of a chord: its slope through the middle of the curve over its range."""
    known = curve[[axis.strain, axis.stress]].dropna().sort_values(axis.strain)
    strain = sign * np.array([chord["range_low"], chord["range_high"]])
    level = np.interp(strain, known[axis.strain], known[axis.stress]).mean()
    stress = level + chord["value"] * (strain - strain.mean())
    return pd.DataFrame({axis.strain: strain, axis.stress: stress})


@styled
def rubber_curves(
    curves: Mapping[str, Mapping[str, pd.DataFrame]], synthetic: bool = False
) -> Figure:
    """Draw the tests of all rubbers in one panel, figure 4 of the paper.

    Parameters
    ----------
    curves : mapping of str to a mapping of str to DataFrame
        Curves (``strain_axial, stress_mpa``) by rubber and specimen.
    synthetic : bool
        Whether any of them is synthetic.
    """
    figure, axes = panel(tr("Rubbers in tension"), NORMAL.strain_words, NORMAL.stress_words)
    parts = []
    for number, (rubber, tests) in enumerate(curves.items()):
        for place, (specimen, curve) in enumerate(tests.items()):
            drawn = evenly_spaced(curve)
            axes.plot(
                100 * drawn["strain_axial"],
                drawn["stress_mpa"],
                color=COLOURS[number % len(COLOURS)],
                linestyle=DASHES[number % len(DASHES)],
                linewidth=1.1,
                label=tr("{rubber}, {count} specimens", rubber=rubber, count=len(tests))
                if place == 0
                else None,
            )
            columns = drawn[["strain_axial", "stress_mpa"]]
            parts.append(columns.assign(rubber=rubber, specimen=specimen))
    axes.set_xlim(left=0)
    axes.set_ylim(bottom=0)
    axes.legend(loc="upper left")
    names = ["rubber", "specimen", "strain_axial", "stress_mpa"]
    figure.data = pd.concat(parts, ignore_index=True)[names]
    mark_synthetic(figure, synthetic)
    return figure
