"""Small figures of the first screen as inline SVG: real text, colours of the page's style sheet."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from markupsafe import Markup, escape

from nptcs.report.text import text_width

WIDTH = 360.0
"""Width of a sketch, in pixels of a page of usual size."""
CHARACTER, GAP = 6.9, 9.0
"""Width of a character, on the wide side, and the gap between text and mark."""
LEAST_SPAN = 60.0
ROW, BAR = 24.0, 11.0
KEY = 15.0
"""Distance from the mark of a key to its text."""

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
class Share:
    """One part of a whole, by count."""

    name: str
    count: int
    tone: Tone


@dataclass(frozen=True)
class MarkPositions:
    """Where the marks are: between the names on the left and the values on the right."""

    left: float
    span: float

    @classmethod
    def of_rows(cls, rows: Sequence[IntervalRow | BarRow]) -> MarkPositions:
        """Leave room for the longest name and the longest value."""
        left, right = (
            GAP + CHARACTER * max(map(text_width, texts), default=0)
            for texts in ([row.name for row in rows], [row.text for row in rows])
        )
        left = min(left, WIDTH - right - LEAST_SPAN)
        return cls(left, WIDTH - left - right)


def intervals(
    rows: Sequence[IntervalRow], alt: str, band: tuple[float, float] | None = None
) -> Sketch:
    """Draw values with their intervals on one axis; a band shades the accepted values.

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

    columns = MarkPositions.of_rows(rows)

    def place(value: float) -> float:
        return columns.left + columns.span * (value - low) / (high - low)

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
        parts += _words(row.name, row.text, columns.left, middle)
    return _sketch(parts, ROW * len(rows), alt)


def bars(rows: Sequence[BarRow], alt: str) -> Sketch:
    """Draw bars from zero, each with its name and value."""
    longest = max((max(row.value, row.reach) for row in rows), default=0.0) or 1.0
    columns = MarkPositions.of_rows(rows)
    left, per_unit = columns.left, columns.span / longest
    parts = []
    for number, row in enumerate(rows):
        middle = ROW * (number + 0.5)
        if row.reach > row.value:
            parts.append(_line(left, left + per_unit * row.reach, middle, "soft"))
        length = max(per_unit * row.value, 1.0)
        parts.append(_rectangle(left, middle - BAR / 2, length, BAR, row.tone))
        parts += _words(row.name, row.text, left, middle)
    return _sketch(parts, ROW * len(rows), alt)


def bar_of_shares(parts_of_it: Sequence[Share], alt: str) -> Sketch:
    """Draw the parts of a whole as one bar, with a legend that gives the counts."""
    total = sum(part.count for part in parts_of_it) or 1
    drawn, left = [], 0.0
    x, y = 0.0, 38.0
    for part in parts_of_it:
        if not part.count:
            continue
        length = WIDTH * part.count / total
        drawn.append(_rectangle(left, 2, max(length - 1.5, 1.0), 16, part.tone))
        left += length
        text = f"{part.count} {part.name}"
        wide = KEY + CHARACTER * text_width(text)
        if x and x + wide > WIDTH:
            x, y = 0.0, y + 20
        drawn.append(_rectangle(x, y - 9, 10, 10, part.tone))
        drawn.append(_text(x + KEY, y, text, "start"))
        x += wide + GAP
    return _sketch(drawn, y + 8, alt)


def _words(name: str, text: str, left: float, middle: float) -> list[Markup]:
    return [
        _text(left - GAP + 2, middle + 4, name, "end"),
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
