"""Paths of an SVG: read, thinned to what can be seen, written in as few characters as possible."""

from __future__ import annotations

import re
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from nptcs.arrays import Array

SEEN_PT = 0.07
"""A polyline may leave the drawn one by this much (points): a tenth of a pixel."""

COMMAND = re.compile(r"([MLCQZz])([^MLCQZz]*)")
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


def read_path(text: str) -> list[Stroke]:
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
    return strokes


def extent(strokes: list[Stroke]) -> tuple[Array, Array]:
    """Return the lowest and the highest x and y of a path."""
    every = np.vstack([point for stroke in strokes for point in stroke.points])
    return every.min(axis=0), every.max(axis=0)


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
    """Return the distances of points from the straight piece between two points."""
    along = end - start
    length = float(along @ along)
    place = np.clip((points - start) @ along / length, 0, 1) if length else np.zeros(len(points))
    return np.hypot(*(points - start - place[:, None] * along).T)


def write_path(strokes: list[Stroke]) -> str:
    """Write a path with relative commands and hundredths of a point."""
    text = ""
    for stroke in strokes:
        here = np.zeros(2, dtype=int)
        before = ""
        for command, points in zip(stroke.commands, stroke.points, strict=True):
            cents = np.rint(100 * points).astype(int)
            if command == "M":
                text, before = text + "M" + _numbers(cents.ravel()), "M"
            elif command == "L":
                text, before = _line(text, cents[-1] - here, before)
            else:
                text, before = text + command.lower() + _numbers((cents - here).ravel()), command
            here = cents[-1]
        text += "z" * stroke.closed
    return text


def _line(text: str, step: Array, before: str) -> tuple[str, str]:
    """Add a straight step, without its command where the last one goes on."""
    if step[1] == 0 and step[0] != 0:
        return text + "h" + _numbers(step[:1]), "h"
    if step[0] == 0 and step[1] != 0:
        return text + "v" + _numbers(step[1:]), "v"
    numbers = _numbers(step)
    if before != "l":
        return text + "l" + numbers, "l"
    return text + ("" if numbers.startswith("-") else " ") + numbers, "l"


def _numbers(cents: Array) -> str:
    """Write hundredths as numbers, with a blank only where two would run together."""
    text = ""
    for cent in cents:
        number = short(int(cent))
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
