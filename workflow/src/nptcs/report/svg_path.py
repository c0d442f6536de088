"""Paths of an SVG: read, thinned to visible points, written in as few characters as possible."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

import numpy as np

from nptcs.arrays import Array

SEEN_PT = 0.07
"""A thinned polyline may deviate from the drawn one by this much (points): a tenth of a pixel."""

COMMAND = re.compile(r"([MLCQZz])([^MLCQZz]*)")
NO_POINTS = np.empty((0, 2))
NUMBERS_OF = {"M": 2, "L": 2, "Q": 4, "C": 6}


@dataclass(frozen=True)
class Stroke:
    """One piece of a path: pairs of a command and its points, and whether it is closed.

    Parameters
    ----------
    commands : str
        One of M, L, Q, C for each row of points.
    points : sequence of arrays of float, shape (k, 2)
        Points of each command, absolute, in points of the page.
    closed : bool
    """

    commands: str
    points: tuple[Array, ...]
    closed: bool = False


@lru_cache(maxsize=200)  # a mark is read again for each point
def read_path(text: str) -> tuple[Stroke, ...]:
    """Read the attribute ``d`` of a path with absolute commands, as Matplotlib writes it."""
    strokes: list[Stroke] = []
    commands = ""
    points: list[Array] = []
    for command, numbers in COMMAND.findall(text):
        if command in "Zz":
            strokes.append(Stroke(commands, tuple(points), True))
            commands, points = "", []
            continue
        if command == "M" and commands:
            strokes.append(Stroke(commands, tuple(points)))
            commands, points = "", []
        values = np.array(numbers.split(), float).reshape(-1, NUMBERS_OF[command] // 2, 2)
        commands += command * len(values)
        points += list(values)
    if commands:
        strokes.append(Stroke(commands, tuple(points)))
    return tuple(strokes)


def extent(strokes: Sequence[Stroke]) -> tuple[Array, Array]:
    """Return the lowest and the highest x and y of a path."""
    every = np.vstack([point for stroke in strokes for point in stroke.points])
    return every.min(axis=0), every.max(axis=0)


@lru_cache(maxsize=200)
def extent_of(text: str) -> tuple[list[float], list[float]]:
    """Return the lowest and the highest x and y of a path, given as its attribute ``d``."""
    low, high = extent(read_path(text))
    return low.tolist(), high.tolist()


def thinned(stroke: Stroke, tolerance: float = SEEN_PT) -> Stroke:
    """Leave out the points of a polyline that cannot be seen (Douglas and Peucker)."""
    if len(stroke.commands) < 4 or set(stroke.commands) != {"M", "L"}:
        return stroke
    line = np.vstack(stroke.points)
    kept = np.zeros(len(line), dtype=bool)
    kept[[0, -1]] = True
    if stroke.closed:
        kept[int(np.argmax(np.hypot(*(line - line[0]).T)))] = True
    spans = list(pairwise(np.flatnonzero(kept)))
    while spans:
        first, last = spans.pop()
        if last - first < 2:
            continue
        away = distance(line[first + 1 : last], line[first], line[last])
        if away.max() > tolerance:
            middle = first + 1 + int(away.argmax())
            kept[middle] = True
            spans += [(first, middle), (middle, last)]
    rest = tuple(line[place][None] for place in np.flatnonzero(kept))
    return Stroke("M" + "L" * (len(rest) - 1), rest, stroke.closed)


def distance(points: Array, start: Array, end: Array) -> Array:
    """Return the distances of points from the straight segment between two points."""
    along = end - start
    length = float(along @ along)
    place = np.clip((points - start) @ along / length, 0, 1) if length else np.zeros(len(points))
    return np.hypot(*(points - start - place[:, None] * along).T)


def write_path(strokes: Sequence[Stroke]) -> str:
    """Write a path with relative commands and hundredths of a point."""
    parts: list[str] = []
    for stroke in strokes:
        cents = np.rint(100 * np.concatenate([NO_POINTS, *stroke.points])).astype(int).tolist()
        here, before, done = [0, 0], "", 0
        for command, points in zip(stroke.commands, stroke.points, strict=True):
            rows = cents[done : done + len(points)]
            done += len(points)
            if command == "M":
                part, before = "M" + _numbers([cent for row in rows for cent in row]), "M"
            elif command == "L":
                part, before = _line(rows[-1][0] - here[0], rows[-1][1] - here[1], before)
            else:
                steps = [
                    cent - start for row in rows for cent, start in zip(row, here, strict=True)
                ]
                part, before = command.lower() + _numbers(steps), command
            parts.append(part)
            here = rows[-1]
        parts.append("z" * stroke.closed)
    return "".join(parts)


def _line(x: int, y: int, before: str) -> tuple[str, str]:
    """Write a straight step, without its command where the last one continues."""
    if y == 0 and x != 0:
        return "h" + short(x), "h"
    if x == 0 and y != 0:
        return "v" + short(y), "v"
    numbers = _numbers([x, y])
    if before != "l":
        return "l" + numbers, "l"
    return ("" if numbers.startswith("-") else " ") + numbers, "l"


def _numbers(cents: list[int]) -> str:
    """Write hundredths as numbers, with a blank only where two would run together."""
    text = ""
    for cent in cents:
        number = short(cent)
        text += number if not text or number.startswith("-") else " " + number
    return text


def short(cents: int) -> str:
    """Write hundredths as the shortest number.

    Examples
    --------
    >>> short(-50), short(1230), short(7)
    ('-.5', '12.3', '.07')
    """
    sign, whole, rest = "-" * (cents < 0), *divmod(abs(cents), 100)
    decimals = f"{rest:02d}".rstrip("0")
    return sign + (str(whole) if whole or not decimals else "") + (f".{decimals}" * bool(decimals))
