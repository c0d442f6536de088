"""Small figures of the first screen as inline SVG: real text, colours of the page's style sheet."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from markupsafe import Markup, escape

WIDTH, LEFT, RIGHT = 360.0, 118.0, 86.0
"""Width of a sketch, of the column of names and of the column of values, in pixels."""
ROW, BAR = 24.0, 11.0
SPAN = WIDTH - LEFT - RIGHT
LEGEND_COLUMN = 180.0

Tone = Literal["accent", "soft", "good", "warn", "bad"]
"""Colours of a mark, each a variable of the style sheet."""


@dataclass(frozen=True)
class Sketch:
    """A finished sketch: its SVG and what it shows in words."""

    svg: Markup
    alt: str


@dataclass(frozen=True)
class IntervalRow:
    """A value on a common axis, with its interval if it has one."""

    name: str
    value: float
    text: str
    low: float | None = None
    high: float | None = None
    tone: Tone = "accent"


@dataclass(frozen=True)
class BarRow:
    """A bar from zero, and how far a thin line reaches beyond it."""

    name: str
    value: float
    text: str
    reach: float = 0.0
    tone: Tone = "accent"


@dataclass(frozen=True)
class Part:
    """One part of a whole, by count."""

    name: str
    count: int
    tone: Tone


def intervals(
    rows: Sequence[IntervalRow], alt: str, band: tuple[float, float] | None = None
) -> Sketch:
    """Draw values with their intervals on one axis; a band shades what is asked for.

    Parameters
    ----------
    rows : sequence of IntervalRow
        One line each.
    alt : str
        The sketch in words.
    band : (float, float), optional
        Accepted values.
    """
    ends = [end for row in rows for end in (row.value, row.low, row.high) if end is not None]
    ends += band or ()
    low, high = min(ends), max(ends)
    margin = 0.08 * (high - low) or 0.05 * abs(high) or 1.0
    low, high = low - margin, high + margin

    def place(value: float) -> float:
        return LEFT + SPAN * (value - low) / (high - low)

    parts = []
    if band is not None:
        left, right = map(place, band)
        parts.append(_rectangle(left, 0, right - left, ROW * len(rows), "band"))
    for number, row in enumerate(rows):
        middle = ROW * (number + 0.5)
        if row.low is not None and row.high is not None:
            parts.append(_line(place(row.low), place(row.high), middle, row.tone))
        parts.append(
            Markup('<circle class="{}" cx="{:.1f}" cy="{:.1f}" r="4.5"/>').format(
                row.tone, place(row.value), middle
            )
        )
        parts += _words(row.name, row.text, middle)
    return _sketch(parts, ROW * len(rows), alt)


def bars(rows: Sequence[BarRow], alt: str) -> Sketch:
    """Draw bars from zero, each with its name and value."""
    longest = max((max(row.value, row.reach) for row in rows), default=0.0) or 1.0
    parts = []
    for number, row in enumerate(rows):
        middle = ROW * (number + 0.5)
        if row.reach > row.value:
            parts.append(_line(LEFT, LEFT + SPAN * row.reach / longest, middle, "soft"))
        length = max(SPAN * row.value / longest, 1.0)
        parts.append(_rectangle(LEFT, middle - BAR / 2, length, BAR, row.tone))
        parts += _words(row.name, row.text, middle)
    return _sketch(parts, ROW * len(rows), alt)


def whole(parts_of_it: Sequence[Part], alt: str) -> Sketch:
    """Draw the parts of a whole as one bar, with a legend that gives the counts."""
    total = sum(part.count for part in parts_of_it) or 1
    drawn, left = [], 0.0
    shown = [part for part in parts_of_it if part.count]
    for number, part in enumerate(shown):
        length = WIDTH * part.count / total
        drawn.append(_rectangle(left, 2, max(length - 1.5, 1.0), 16, part.tone))
        x, y = LEGEND_COLUMN * (number % 2), 38 + 20 * (number // 2)
        drawn.append(_rectangle(x, y - 9, 10, 10, part.tone))
        drawn.append(_text(x + 15, y, f"{part.count} {part.name}", "start"))
        left += length
    return _sketch(drawn, 26 + 20 * ((len(shown) + 1) // 2), alt)


def _words(name: str, text: str, middle: float) -> list[Markup]:
    return [
        _text(LEFT - 8, middle + 4, name, "end"),
        _text(WIDTH, middle + 4, text, "end"),
    ]


def _text(x: float, y: float, text: str, anchor: str) -> Markup:
    return Markup('<text x="{:.1f}" y="{:.1f}" text-anchor="{}">{}</text>').format(
        x, y, anchor, text
    )


def _rectangle(x: float, y: float, width: float, height: float, css: str) -> Markup:
    return Markup(
        '<rect class="{}" x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" rx="2"/>'
    ).format(css, x, y, width, height)


def _line(left: float, right: float, y: float, css: str) -> Markup:
    return Markup('<path class="{}" d="M{:.1f} {:.1f}H{:.1f}"/>').format(css, left, y, right)


def _sketch(parts: Sequence[Markup], height: float, alt: str) -> Sketch:
    head = Markup('<svg class="sketch" viewBox="0 0 {:g} {:g}" role="img" aria-label="{}">')
    svg = head.format(WIDTH, height, escape(alt)) + Markup("").join(parts) + Markup("</svg>")
    return Sketch(svg, alt)
